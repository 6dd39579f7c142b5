//! A small picture with its corners and residuals drawn over it.

use std::fmt::Write;

use handeye::GrayImage;

use super::escape;

/// A corner to draw, in pixels of the full picture.
#[derive(Debug, Clone, Copy)]
pub struct MarkedCorner {
    /// Where it was found.
    pub x: f64,
    /// Where it was found.
    pub y: f64,
    /// Found minus predicted.
    pub dx: f64,
    /// Found minus predicted.
    pub dy: f64,
}

/// A small copy of a capture's picture.
pub struct Picture {
    id: String,
    caption: String,
    used: bool,
    jpeg: Vec<u8>,
    size: (usize, usize),
    shrink: f64,
    corners: Vec<MarkedCorner>,
}

/// Width of the small copy, px.
const WIDTH: usize = 480;
/// Length of the scale bar, px of the small copy.
pub const BAR_PX: f64 = 40.0;

impl Picture {
    /// Shrinks a picture (area average) and keeps its corners.
    pub fn new(
        id: &str,
        caption: String,
        used: bool,
        image: &GrayImage,
        corners: Vec<MarkedCorner>,
    ) -> Option<Self> {
        let factor = image.width().div_ceil(WIDTH).max(1);
        let (w, h) = (image.width() / factor, image.height() / factor);
        let mut small = Vec::with_capacity(w * h);
        for y in 0..h {
            for x in 0..w {
                small.push(average(image, x * factor, y * factor, factor));
            }
        }
        let mut jpeg = Vec::new();
        ::image::codecs::jpeg::JpegEncoder::new_with_quality(&mut jpeg, 72)
            .encode(
                &small,
                u32::try_from(w).ok()?,
                u32::try_from(h).ok()?,
                ::image::ExtendedColorType::L8,
            )
            .ok()?;
        let shrink = 1.0 / factor as f64;
        Some(Self { id: id.into(), caption, used, jpeg, size: (w, h), shrink, corners })
    }

    /// Its figure, residuals magnified.
    pub(super) fn figure(&self, magnified: f64) -> String {
        let (w, h) = self.size;
        let mut svg = format!(
            "<svg viewBox=\"0 0 {w} {h}\"><image width=\"{w}\" height=\"{h}\" href=\"data:image/jpeg;base64,{}\"/>",
            base64(&self.jpeg)
        );
        for c in &self.corners {
            let at = |v: f64| (v + 0.5) * self.shrink;
            let (x, y) = (at(c.x), at(c.y));
            let _ = write!(
                svg,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.2\" fill=\"none\" stroke=\"#2b8be0\" stroke-width=\"1\"/>"
            );
            let (ex, ey) = (x + c.dx * magnified, y + c.dy * magnified);
            let _ = write!(
                svg,
                "<line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{ex:.1}\" y2=\"{ey:.1}\" stroke=\"#ff2d1a\" stroke-width=\"1.3\"/>"
            );
        }
        let _ = write!(
            svg,
            "<rect x=\"6\" y=\"{:.0}\" width=\"{BAR_PX}\" height=\"4\" fill=\"#ff2d1a\" stroke=\"#fff\"/></svg>",
            h as f64 - 12.0
        );
        let class = if self.used { "" } else { "out" };
        format!(
            "<figure class=\"{class}\">{svg}<figcaption><b>{}</b> {}</figcaption></figure>",
            escape(&self.id),
            escape(&self.caption)
        )
    }
}

fn average(image: &GrayImage, x: usize, y: usize, n: usize) -> u8 {
    let sum: f32 =
        (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).map(|(i, j)| image.at(x + i, y + j)).sum();
    (sum / (n * n) as f32).round().clamp(0.0, 255.0) as u8
}

/// How much longer residuals are drawn than they are: the 90 % one becomes half the scale bar; a
/// round number.
pub(super) fn magnification(pictures: &[Picture]) -> f64 {
    let mut lengths: Vec<f64> =
        pictures.iter().flat_map(|p| &p.corners).map(|c| c.dx.hypot(c.dy)).collect();
    lengths.sort_by(f64::total_cmp);
    let typical = lengths.get(lengths.len() * 9 / 10).copied().unwrap_or(0.0).max(1e-3);
    let wanted = 0.5 * BAR_PX / typical;
    [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0]
        .into_iter()
        .rfind(|m| *m <= wanted)
        .unwrap_or(1.0)
}

/// Base64 of RFC 4648, for data URLs.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let b = [chunk[0], *chunk.get(1).unwrap_or(&0), *chunk.get(2).unwrap_or(&0)];
        let n = u32::from(b[0]) << 16 | u32::from(b[1]) << 8 | u32::from(b[2]);
        for k in 0..4 {
            let letter = LETTERS[(n >> (18 - 6 * k)) as usize & 63] as char;
            text.push(if k <= chunk.len() { letter } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_pads_as_the_standard_says() {
        assert_eq!(base64(b"f"), "Zg==");
        assert_eq!(base64(b"fo"), "Zm8=");
        assert_eq!(base64(b"foobar"), "Zm9vYmFy");
    }
}
