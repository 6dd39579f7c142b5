//! A small image with its corners and residuals drawn over it.

use std::fmt::Write;

use handeye::GrayImage;

use super::{base64::base64, escape, section};

/// A corner to draw, in pixels of the full image.
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

/// A small copy of a capture's image.
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
/// A residual of so many times the typical one is no noise.
const FAR: f64 = 3.0;
/// Length of the scale bar, px of the small copy.
const BAR_PX: f64 = 40.0;

/// All of them, with one magnification.
pub(super) fn pictures(pictures: &[Picture]) -> String {
    if pictures.is_empty() {
        return String::new();
    }
    let magnified = magnification(pictures);
    let all = || pictures.iter().flat_map(|p| &p.corners).map(|c| c.dx.hypot(c.dy));
    let rms = (all().map(|d| d * d).sum::<f64>() / all().count().max(1) as f64).sqrt();
    let figures: String = pictures.iter().map(|p| p.figure(magnified, FAR * rms)).collect();
    let content = format!(
        "<p class=\"note\">Detected corners (blue) and residuals against the target seen from its own best pose, red where \
         they are more than {FAR} times the typical one, magnified {magnified:.0} times: an arrow as long as the bar in the corner is {:.2} px.</p><div class=\"pictures\">{figures}</div>",
        BAR_PX / magnified
    );
    section("Pictures", "long", &content)
}

impl Picture {
    /// Shrinks an image (area average) and keeps its corners.
    pub fn new(
        id: &str,
        caption: String,
        used: bool,
        image: &GrayImage,
        corners: Vec<MarkedCorner>,
    ) -> Option<Self> {
        let (jpeg, size, factor) = crate::image::small_jpeg(image, WIDTH)?;
        let shrink = 1.0 / factor as f64;
        Some(Self { id: id.into(), caption, used, jpeg, size, shrink, corners })
    }

    /// Its figure, residuals magnified; those beyond `far` (px) stand out.
    fn figure(&self, magnified: f64, far: f64) -> String {
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
                "<line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{ex:.1}\" y2=\"{ey:.1}\" stroke=\"{}\" stroke-width=\"1.3\"/>",
                if c.dx.hypot(c.dy) > far { "#ff2d1a" } else { "#e8c9a0" }
            );
        }
        let _ = write!(
            svg,
            "<rect x=\"6\" y=\"{:.0}\" width=\"{BAR_PX}\" height=\"4\" fill=\"#e8c9a0\" stroke=\"#555\"/></svg>",
            h as f64 - 12.0
        );
        let class = if self.used { "" } else { "out" };
        format!(
            "<figure class=\"{class}\" data-capture=\"{id}\">{svg}<figcaption><b>{id}</b> {}</figcaption></figure>",
            escape(&self.caption),
            id = escape(&self.id)
        )
    }
}

/// How much longer residuals are drawn than they are: the 90 % one becomes half the scale bar; a
/// round number.
fn magnification(pictures: &[Picture]) -> f64 {
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
