//! Images, depth images and clouds out of messages, as files.

use std::io::Cursor;

use image::{ExtendedColorType, ImageEncoder, codecs::png};

use super::messages::{CompressedImage, Image, PointCloud, PointField};
use crate::{image::MOST_PIXELS, npy};

/// A file's ending and its bytes.
pub(super) type File = (&'static str, Vec<u8>);

/// How the bytes of a pixel are meant.
struct Pixels {
    channels: usize,
    /// Bytes of one channel.
    depth: usize,
    colour: ExtendedColorType,
    /// The order in which the file wants the channels.
    order: &'static [usize],
}

/// How images are encoded that are written as they are.
fn plain(encoding: &str) -> Option<Pixels> {
    use ExtendedColorType::{L8, L16, Rgb8, Rgb16};
    let (channels, depth, colour, order): (usize, usize, ExtendedColorType, &'static [usize]) =
        match encoding {
            "mono8" | "8UC1" => (1, 1, L8, &[0]),
            "mono16" | "16UC1" => (1, 2, L16, &[0]),
            "rgb8" => (3, 1, Rgb8, &[0, 1, 2]),
            "bgr8" | "8UC3" => (3, 1, Rgb8, &[2, 1, 0]),
            "rgba8" => (4, 1, Rgb8, &[0, 1, 2]),
            "bgra8" | "8UC4" => (4, 1, Rgb8, &[2, 1, 0]),
            "rgb16" => (3, 2, Rgb16, &[0, 1, 2]),
            "bgr16" => (3, 2, Rgb16, &[2, 1, 0]),
            // luminance alone: of each pair of bytes the second, or the first
            "uyvy" | "yuv422" => (2, 1, L8, &[1]),
            "yuyv" | "yuv422_yuy2" => (2, 1, L8, &[0]),
            _ => return None,
        };
    Some(Pixels { channels, depth, colour, order })
}

/// What is written of raw images.
const READ: &str =
    "mono8, mono16, rgb8, bgr8, rgba8, bgra8, rgb16, bgr16, bayer_*8, uyvy and yuyv are";

/// An image.
pub(super) fn picture(image: &Image) -> Result<File, String> {
    let size = checked(image.width, image.height)?;
    if let Some(pattern) = image.encoding.strip_prefix("bayer_").and_then(|e| e.strip_suffix('8')) {
        let rows = rows(image, size, 1)?;
        let grey = debayered(&rows, size, pattern)
            .ok_or_else(|| format!("is encoded as {}", image.encoding))?;
        return Ok(("png", png_of(&grey, size, ExtendedColorType::L8)));
    }
    let Some(pixels) = plain(&image.encoding) else {
        return Err(format!("is encoded as {}, which is not read; {READ}", image.encoding));
    };
    let rows = rows(image, size, pixels.channels * pixels.depth)?;
    let channels = rows.chunks_exact(pixels.channels * pixels.depth).flat_map(|pixel| {
        pixels.order.iter().flat_map(move |k| {
            let bytes = &pixel[k * pixels.depth..(k + 1) * pixels.depth];
            // the encoder wants numbers as the machine has them
            let value = match bytes {
                [a, b] if image.big_endian => u16::from_be_bytes([*a, *b]),
                [a, b] => u16::from_le_bytes([*a, *b]),
                _ => 0,
            };
            if bytes.len() == 1 { vec![bytes[0]] } else { value.to_ne_bytes().to_vec() }
        })
    });
    Ok(("png", png_of(&channels.collect::<Vec<u8>>(), size, pixels.colour)))
}

/// An image that was packed, as it is.
pub(super) fn packed(image: &CompressedImage) -> Result<File, String> {
    if image.data.starts_with(&[0x89, b'P', b'N', b'G']) {
        Ok(("png", image.data.to_vec()))
    } else if image.data.starts_with(&[0xff, 0xd8]) {
        Ok(("jpg", image.data.to_vec()))
    } else {
        Err(format!("is packed as \"{}\", which is neither PNG nor JPEG", image.format))
    }
}

/// Metres of one step of a depth image of whole numbers.
pub(super) const DEPTH_SCALE: f64 = 1e-3;
/// Bytes that stand before the PNG of a packed depth image.
const DEPTH_HEADER: usize = 12;

/// A depth image: whole millimetres, or metres.
pub(super) fn depth(image: &Image) -> Result<File, String> {
    let size = checked(image.width, image.height)?;
    match image.encoding.as_str() {
        "16UC1" | "mono16" => picture(image),
        "32FC1" => {
            let number = |b: &[u8]| {
                let raw = [b[0], b[1], b[2], b[3]];
                f64::from(if image.big_endian {
                    f32::from_be_bytes(raw)
                } else {
                    f32::from_le_bytes(raw)
                })
            };
            let values: Vec<f64> = rows(image, size, 4)?.chunks_exact(4).map(number).collect();
            Ok(("npy", npy::encode(&[size.1, size.0], &values)))
        }
        other => Err(format!("is encoded as {other}: depth is 16UC1 or 32FC1")),
    }
}

/// A depth image that was packed: 16 bits, as PNG behind a header.
pub(super) fn packed_depth(image: &CompressedImage) -> Result<File, String> {
    let bytes = image.data.get(DEPTH_HEADER..).unwrap_or_default();
    let is_png = |b: &[u8]| b.starts_with(&[0x89, b'P', b'N', b'G']);
    if image.format.starts_with("32FC1") {
        return Err(
            "packs depth as inverse values of 32 bits, which is not read: record it unpacked"
                .into(),
        );
    }
    match image.data {
        all if is_png(all) => Ok(("png", all.to_vec())),
        _ if is_png(bytes) => Ok(("png", bytes.to_vec())),
        _ => Err(format!("is packed as \"{}\", which is no PNG of 16 bits", image.format)),
    }
}

fn checked(width: u32, height: u32) -> Result<(usize, usize), String> {
    if width == 0 || height == 0 || u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(format!("has {width} x {height} pixels"));
    }
    Ok((width as usize, height as usize))
}

/// The rows without what pads them.
fn rows(image: &Image, (width, height): (usize, usize), pixel: usize) -> Result<Vec<u8>, String> {
    let (used, step) = (width * pixel, image.step as usize);
    if step < used || image.data.len() / step < height {
        return Err(format!(
            "has {} bytes, too few for {width} x {height} pixels of {} in rows of {step}",
            image.data.len(),
            image.encoding
        ));
    }
    Ok(image.data.chunks_exact(step).take(height).flat_map(|row| &row[..used]).copied().collect())
}

/// Brightness of each pixel: of the three colours around it, those that are missing from their neighbours.
fn debayered(mosaic: &[u8], (width, height): (usize, usize), pattern: &str) -> Option<Vec<u8>> {
    let colours: Vec<char> = pattern.chars().collect();
    if colours.len() != 4 || !colours.iter().all(|c| "rgb".contains(*c)) || width < 2 || height < 2
    {
        return None;
    }
    let colour = |x: usize, y: usize| colours[2 * (y % 2) + x % 2];
    // of a pixel's neighbourhood each colour is the mean of those that are of it
    let bright = |x: usize, y: usize| {
        let (mut sums, mut counts) = ([0.0; 3], [0.0; 3]);
        for j in y.saturating_sub(1)..(y + 2).min(height) {
            for i in x.saturating_sub(1)..(x + 2).min(width) {
                let (own, found) = (colour(x, y), colour(i, j));
                if found == own && (i, j) != (x, y) {
                    continue;
                }
                let k = "rgb".find(found).unwrap_or(0);
                sums[k] += f64::from(mosaic[j * width + i]);
                counts[k] += 1.0;
            }
        }
        let mean = |k: usize| sums[k] / f64::max(counts[k], 1.0);
        (0.299 * mean(0) + 0.587 * mean(1) + 0.114 * mean(2)).round() as u8
    };
    Some(
        (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| bright(x, y))
            .collect(),
    )
}

fn png_of(bytes: &[u8], (width, height): (usize, usize), colour: ExtendedColorType) -> Vec<u8> {
    let mut out = Cursor::new(Vec::new());
    let encoder = png::PngEncoder::new_with_quality(
        &mut out,
        png::CompressionType::Fast,
        png::FilterType::Adaptive,
    );
    let written = encoder.write_image(bytes, width as u32, height as u32, colour);
    written.expect("an image of the size of its bytes, into memory");
    out.into_inner()
}

/// Numbers of 32 and of 64 bits, as a field's datatype says.
const FLOAT: u8 = 7;
const DOUBLE: u8 = 8;

/// A cloud as PCD, x y z in metres, rows kept where it has them.
pub(super) fn cloud(cloud: &PointCloud) -> Result<File, String> {
    let (width, height) = checked(cloud.width, cloud.height)?;
    let field = |name: &str| {
        let found =
            cloud.fields.iter().find(|f| f.name == name && [FLOAT, DOUBLE].contains(&f.datatype));
        found.ok_or_else(|| format!("has no field {name} of floating-point numbers"))
    };
    let xyz = [field("x")?, field("y")?, field("z")?];
    let point = cloud.point_step as usize;
    let row = match cloud.row_step as usize {
        0 => width.saturating_mul(point), // some writers leave it out
        row => row,
    };
    let ends = |f: &&PointField| f.offset as usize + if f.datatype == FLOAT { 4 } else { 8 };
    let enough = xyz.iter().map(ends).max() <= Some(point)
        && row >= width.saturating_mul(point)
        && cloud.data.len() / row >= height;
    if !enough {
        return Err(format!(
            "has {} bytes, too few for {width} x {height} points of {point}",
            cloud.data.len()
        ));
    }
    let mut bytes = format!(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n\
         WIDTH {width}\nHEIGHT {height}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
        width * height
    )
    .into_bytes();
    for row in cloud.data.chunks_exact(row).take(height) {
        for point in row.chunks_exact(point).take(width) {
            let value =
                |f: &PointField| number(&point[f.offset as usize..], f.datatype, cloud.big_endian);
            bytes.extend(xyz.iter().flat_map(|f| value(f).to_le_bytes()));
        }
    }
    Ok(("pcd", bytes))
}

fn number(bytes: &[u8], datatype: u8, big_endian: bool) -> f32 {
    if datatype == FLOAT {
        let raw = [bytes[0], bytes[1], bytes[2], bytes[3]];
        return if big_endian { f32::from_be_bytes(raw) } else { f32::from_le_bytes(raw) };
    }
    let mut raw = [0; 8];
    raw.copy_from_slice(&bytes[..8]);
    (if big_endian { f64::from_be_bytes(raw) } else { f64::from_le_bytes(raw) }) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bag::messages::Header;

    fn image<'a>(encoding: &str, width: u32, height: u32, step: u32, data: &'a [u8]) -> Image<'a> {
        let header = Header { stamp: 0, frame: String::new() };
        Image { header, width, height, encoding: encoding.into(), big_endian: false, step, data }
    }

    fn read(file: File) -> image::DynamicImage {
        image::load_from_memory(&file.1).unwrap()
    }

    #[test]
    fn padded_rows_and_swapped_colours_are_put_right() {
        let data = [3, 2, 1, 6, 5, 4, 99, 99, 9, 8, 7, 12, 11, 10, 99, 99];
        let found = read(picture(&image("bgr8", 2, 2, 8, &data)).unwrap()).into_rgb8();
        assert_eq!(found.as_raw(), &(1..=12).collect::<Vec<u8>>());
    }

    #[test]
    fn sixteen_bits_of_either_byte_order_are_read() {
        let mut big = image("mono16", 1, 1, 2, &[1, 2]);
        assert_eq!(read(picture(&big).unwrap()).into_luma16().as_raw(), &[0x0201]);
        big.big_endian = true;
        assert_eq!(read(picture(&big).unwrap()).into_luma16().as_raw(), &[0x0102]);
    }

    #[test]
    fn a_mosaic_of_one_grey_is_that_grey() {
        let data = [77; 20];
        for pattern in ["bayer_rggb8", "bayer_bggr8", "bayer_gbrg8", "bayer_grbg8"] {
            let found = read(picture(&image(pattern, 5, 4, 5, &data)).unwrap()).into_luma8();
            assert!(found.as_raw().iter().all(|v| *v == 77), "{pattern}");
        }
        // green in rows of red and of blue: the brightness is that of the colour
        let data: Vec<u8> =
            (0..36).map(|k| if (k / 6) % 2 == 0 && k % 2 == 0 { 200 } else { 0 }).collect();
        let found = read(picture(&image("bayer_rggb8", 6, 6, 6, &data)).unwrap()).into_luma8();
        assert!((2..4).all(|k| found.get_pixel(k, 3).0 == [60]), "{found:?}");
    }

    #[test]
    fn what_is_too_short_or_unknown_is_said() {
        assert!(picture(&image("mono8", 4, 4, 4, &[0; 15])).unwrap_err().contains("too few"));
        assert!(picture(&image("mono8", 4, 4, 0, &[0; 16])).unwrap_err().contains("too few"));
        assert!(picture(&image("nv12", 4, 4, 4, &[0; 16])).unwrap_err().contains("nv12"));
        assert!(picture(&image("mono8", u32::MAX, u32::MAX, 4, &[])).is_err());
        assert!(depth(&image("rgb8", 1, 1, 3, &[0; 3])).unwrap_err().contains("depth is"));
    }

    #[test]
    fn clouds_keep_their_rows_and_lose_what_pads_them() {
        let field = |name: &str, offset| PointField { name: name.into(), offset, datatype: FLOAT };
        let mut data = vec![];
        for k in 0..4 {
            data.extend((k as f32).to_le_bytes());
            data.extend([0; 4]);
            data.extend((10.0 + k as f32).to_le_bytes());
            data.extend((20.0 + k as f32).to_le_bytes());
        }
        let header = Header { stamp: 0, frame: String::new() };
        let fields = vec![field("x", 0), field("y", 8), field("z", 12)];
        let mut found = PointCloud {
            header,
            width: 2,
            height: 2,
            fields,
            big_endian: false,
            point_step: 16,
            row_step: 32,
            data: &data,
        };
        let (ending, bytes) = cloud(&found).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        assert!(ending == "pcd" && text.contains("WIDTH 2\nHEIGHT 2"));
        let last = &bytes[bytes.len() - 12..];
        assert_eq!(last, [3f32, 13.0, 23.0].map(f32::to_le_bytes).concat());
        found.fields[2].offset = 13;
        assert!(cloud(&found).unwrap_err().contains("too few"));
    }
}
