//! Images as grey values from 0 to 255.

use std::{io::Cursor, path::Path};

use handeye::GrayImage;
use image::{DynamicImage, ImageReader, Limits};

use crate::{
    error::{Error, Place, malformed},
    files,
};

/// Largest image that is decoded, in pixels.
pub(crate) const MOST_PIXELS: u64 = 64_000_000;
/// Smallest side of an image that can show anything.
const SMALLEST_SIDE: u32 = 8;
/// Memory one image may take while it is decoded: 64 MP of four 16-bit channels.
const MOST_MEMORY: u64 = 8 * MOST_PIXELS;

/// Reads a PNG, JPEG, TIFF or BMP image of 8 or 16 bits, grey or colour (Rec. 601 luma).
///
/// A 16-bit image is scaled by its full range, or by `bit_depth` bits where the camera used fewer.
///
/// # Errors
/// What is no image, cut short, larger than 64 megapixels, or brighter than `bit_depth` says.
pub fn read_image(path: &Path, bit_depth: Option<u32>) -> Result<GrayImage, Error> {
    let picture = decode(path)?;
    gray(&picture, bit_depth, path)
}

/// The same of an image's bytes; and the ending of a file of its format. `name` is what errors call it.
///
/// # Errors
/// As [`read_image`].
pub fn read_image_bytes(bytes: &[u8], name: &str) -> Result<(GrayImage, &'static str), Error> {
    let path = Path::new(name);
    let format = reader(bytes, path)?.format();
    let ending = format.and_then(|f| f.extensions_str().first().copied()).unwrap_or("png");
    Ok((gray(&decode_bytes(bytes, path)?, None, path)?, ending))
}

/// Width and height, from the header alone.
///
/// # Errors
/// As [`read_image`], as far as the header shows it.
pub fn image_size(path: &Path) -> Result<(u32, u32), Error> {
    size_of(&files::bytes(path)?, path)
}

fn size_of(bytes: &[u8], path: &Path) -> Result<(u32, u32), Error> {
    let (width, height) = reader(bytes, path)?.into_dimensions().map_err(|e| broken(&e, path))?;
    check_size(width.into(), height.into(), path)?;
    if width.min(height) < SMALLEST_SIDE {
        return Err(malformed(
            Place::file(path),
            format!("the image is only {width} x {height} pixels"),
            "is it the right file?",
        ));
    }
    Ok((width, height))
}

/// Refuses more pixels than are decoded.
pub(crate) fn check_size(width: u64, height: u64, path: &Path) -> Result<(), Error> {
    match width.checked_mul(height) {
        Some(pixels) if pixels <= MOST_PIXELS => Ok(()),
        pixels => Err(Error::TooLarge {
            place: Place::file(path),
            what: format!("the number of pixels ({width} x {height})"),
            found: pixels.unwrap_or(u64::MAX),
            limit: MOST_PIXELS,
            advice: "is the file damaged?".into(),
        }),
    }
}

fn reader<'a>(bytes: &'a [u8], path: &Path) -> Result<ImageReader<Cursor<&'a [u8]>>, Error> {
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|source| Error::Read { path: path.into(), source })?;
    if reader.format().is_none() {
        return Err(malformed(
            Place::file(path),
            "is not an image",
            "PNG, JPEG, TIFF and BMP can be read",
        ));
    }
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MOST_MEMORY);
    reader.limits(limits);
    Ok(reader)
}

/// The decoded image, its size checked first.
pub(crate) fn decode(path: &Path) -> Result<DynamicImage, Error> {
    decode_bytes(&files::bytes(path)?, path)
}

fn decode_bytes(bytes: &[u8], path: &Path) -> Result<DynamicImage, Error> {
    size_of(bytes, path)?;
    reader(bytes, path)?.decode().map_err(|e| broken(&e, path))
}

fn broken(error: &image::ImageError, path: &Path) -> Error {
    malformed(
        Place::file(path),
        format!("the image cannot be decoded ({error})"),
        "copy or record it again",
    )
}

fn gray(picture: &DynamicImage, bit_depth: Option<u32>, path: &Path) -> Result<GrayImage, Error> {
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let values: Vec<f32> = match picture {
        DynamicImage::ImageLuma8(p) => p.as_raw().iter().map(|v| f32::from(*v)).collect(),
        DynamicImage::ImageLumaA8(_) | DynamicImage::ImageRgba8(_) | DynamicImage::ImageRgb8(_) => {
            picture.to_rgb8().pixels().map(|p| luma(p.0.map(f32::from))).collect()
        }
        DynamicImage::ImageLuma16(p) => {
            scaled(p.as_raw().iter().map(|v| f32::from(*v)), bit_depth, path)?
        }
        _ => {
            let rgb = picture.to_rgb16();
            scaled(rgb.pixels().map(|p| luma(p.0.map(f32::from))), bit_depth, path)?
        }
    };
    GrayImage::new(width, height, values)
        .ok_or_else(|| malformed(Place::file(path), "the image is incomplete", "copy it again"))
}

/// ITU-R BT.601.
fn luma([r, g, b]: [f32; 3]) -> f32 {
    if r == g && g == b { r } else { 0.299 * r + 0.587 * g + 0.114 * b }
}

fn scaled(
    values: impl Iterator<Item = f32>,
    bit_depth: Option<u32>,
    path: &Path,
) -> Result<Vec<f32>, Error> {
    let bits = bit_depth.unwrap_or(16);
    let white = (2.0_f32).powi(bits.clamp(1, 16) as i32) - 1.0;
    let values: Vec<f32> = values.collect();
    let brightest = values.iter().copied().fold(0.0, f32::max);
    if brightest > white + 0.5 {
        return Err(malformed(
            Place::file(path),
            format!("a pixel of {brightest} does not fit bit_depth = {bits}"),
            "correct or leave out bit_depth in [images]",
        ));
    }
    Ok(values.into_iter().map(|v| v * (255.0 / white)).collect())
}

/// Quality of small copies: what pages show.
const SMALL_QUALITY: u8 = 72;

/// A copy for pages, at most so wide (px): JPEG, its size, and pixels of the image for one of its own (area average).
pub fn small_jpeg(picture: &GrayImage, widest: usize) -> Option<(Vec<u8>, (usize, usize), usize)> {
    let factor = picture.width().div_ceil(widest).max(1);
    let (w, h) = (picture.width() / factor, picture.height() / factor);
    let mut small = Vec::with_capacity(w * h);
    for y in 0..h {
        for x in 0..w {
            small.push(average(picture, x * factor, y * factor, factor));
        }
    }
    let mut jpeg = Vec::new();
    image::codecs::jpeg::JpegEncoder::new_with_quality(&mut jpeg, SMALL_QUALITY)
        .encode(
            &small,
            u32::try_from(w).ok()?,
            u32::try_from(h).ok()?,
            image::ExtendedColorType::L8,
        )
        .ok()?;
    Some((jpeg, (w, h), factor))
}

fn average(image: &GrayImage, x: usize, y: usize, n: usize) -> u8 {
    let sum: f32 =
        (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).map(|(i, j)| image.at(x + i, y + j)).sum();
    (sum / (n * n) as f32).round().clamp(0.0, 255.0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ImageBuffer, Luma, Rgb};

    #[test]
    fn sixteen_bits_are_scaled_by_the_declared_depth_only() {
        let picture = DynamicImage::ImageLuma16(ImageBuffer::from_pixel(9, 9, Luma([4095u16])));
        let at = |depth| gray(&picture, depth, Path::new("a")).map(|g| g.at(0, 0));
        assert_eq!(at(Some(12)).unwrap(), 255.0);
        assert!((at(None).unwrap() - 15.93).abs() < 0.01);
        let message = at(Some(8)).unwrap_err().to_string();
        assert!(message.starts_with("a: a pixel of 4095 does not fit bit_depth = 8"), "{message}");
    }

    #[test]
    fn colours_become_luma() {
        let picture = DynamicImage::ImageRgb8(ImageBuffer::from_pixel(9, 9, Rgb([255u8, 0, 0])));
        assert!((gray(&picture, None, Path::new("a")).unwrap().at(3, 3) - 76.245).abs() < 1e-3);
    }
}
