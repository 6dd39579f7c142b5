//! An image with the corners that were found in it, and how far each is from where the board has
//! it.
//!
//! Where corners are close together the image is enlarged, so that crosses, ids and arrows do not
//! hide each other. Arrows begin at the corners and are residuals (detected minus predicted), all
//! magnified by the factor that the line below the image tells.

use std::io::Cursor;

use handeye::{GrayImage, ImageCorner, detect::residuals::rms};
use image::{ImageFormat, Rgb, RgbImage};
use nalgebra::Vector2;

use super::letters::{self, Pen, square};

const CROSS: Rgb<u8> = Rgb([255, 40, 40]);
const FIRST: Rgb<u8> = Rgb([40, 140, 255]);
const ARROW: Rgb<u8> = Rgb([255, 200, 0]);
const DIGITS: Rgb<u8> = Rgb([90, 255, 130]);
const RIM: Rgb<u8> = Rgb([0, 0, 0]);
const LEGEND: Rgb<u8> = Rgb([255, 255, 255]);

/// Corners should be this far apart in the drawing, px.
const APART: f64 = 72.0;
/// Lines are wider by a pixel for every so many between corners.
const APART_PER_LINE: f64 = 36.0;
const WIDEST_LINE: f64 = 6.0;
/// The drawing is not enlarged beyond this, px, and not by more than the factor.
const LONGEST: f64 = 4000.0;
const MOST_ENLARGED: u32 = 6;
/// Most residuals (this quantile) become arrows no longer than this share of the corners' distance.
const QUANTILE: f64 = 0.9;
const ARROW_SHARE: f64 = 0.45;
/// Residuals are magnified by these times powers of ten.
const STEPS: [f64; 3] = [5.0, 2.0, 1.0];
/// Not more: rounding is no residual.
const MOST_MAGNIFIED: f64 = 1e5;

/// What was found of one target.
#[derive(Debug, Clone, Copy)]
pub struct Marks<'a> {
    /// What the target is called, where there are several.
    pub name: Option<&'a str>,
    /// Its corners.
    pub corners: &'a [ImageCorner],
    /// Detected minus predicted place of each corner, px.
    pub residuals: Option<&'a [Vector2<f64>]>,
}

/// The image as PNG: a cross on each corner, blue on corner 0, its id beside it, and its residual
/// as an arrow. The name of a target stands before the first id.
pub fn marked(image: &GrayImage, targets: &[Marks]) -> Vec<u8> {
    let all: Vec<Mark> = targets.iter().flat_map(marks).collect();
    let sheet = Sheet::new(image, &all);
    let mut picture = sheet.enlarged(image);
    all.iter().for_each(|mark| sheet.cross(&mut picture, mark));
    all.iter().for_each(|mark| sheet.arrow(&mut picture, mark));
    all.iter().for_each(|mark| sheet.id(&mut picture, mark));
    sheet.legend(&mut picture, &all);
    let mut bytes = Cursor::new(Vec::new());
    // into memory, from a buffer of its own size: this cannot fail
    let _ = picture.write_to(&mut bytes, ImageFormat::Png);
    bytes.into_inner()
}

/// One corner.
struct Mark {
    id: u32,
    text: String,
    pixel: Vector2<f64>,
    residual: Option<Vector2<f64>>,
}

fn marks(target: &Marks) -> Vec<Mark> {
    let one = |(k, corner): (usize, &ImageCorner)| Mark {
        id: corner.id,
        text: match target.name {
            // there are small letters only
            Some(name) if k == 0 => format!("{} {}", name.to_lowercase(), corner.id),
            _ => corner.id.to_string(),
        },
        pixel: corner.pixel,
        residual: target.residuals.and_then(|r| r.get(k)).copied(),
    };
    target.corners.iter().enumerate().map(one).collect()
}

fn residuals(marks: &[Mark]) -> Vec<Vector2<f64>> {
    marks.iter().filter_map(|mark| mark.residual).collect()
}

/// How an image is drawn.
struct Sheet {
    /// Pixels of the drawing for one of the image.
    enlarged: u32,
    /// Arrows are longer than residuals by this factor.
    magnified: f64,
    /// Size of the image in the drawing, px.
    width: i64,
    height: i64,
    /// Width of lines, and side of the letters' dots, px.
    line: i64,
}

impl Sheet {
    fn new(image: &GrayImage, marks: &[Mark]) -> Self {
        let distance = distance(marks);
        let longer = image.width().max(image.height()) as f64;
        let most = (LONGEST / longer).clamp(1.0, f64::from(MOST_ENLARGED)) as u32;
        let wanted = distance.map_or(1.0, |d| (APART / d).ceil());
        let enlarged = (wanted as u32).clamp(1, most);
        let drawn = |n: usize| n as i64 * i64::from(enlarged);
        let apart = distance.unwrap_or(APART) * f64::from(enlarged);
        Self {
            enlarged,
            magnified: magnification(&residuals(marks), distance.unwrap_or(APART)),
            width: drawn(image.width()),
            height: drawn(image.height()),
            line: (apart / APART_PER_LINE).round().clamp(1.0, WIDEST_LINE) as i64,
        }
    }

    /// The image with room for the legend.
    fn enlarged(&self, image: &GrayImage) -> RgbImage {
        let grey = image.to_u8();
        let factor = i64::from(self.enlarged);
        let (width, height) = (self.width as u32, (self.height + self.legend_height()) as u32);
        RgbImage::from_fn(width, height, |x, y| {
            let (x, y) = (i64::from(x), i64::from(y));
            if y >= self.height {
                return RIM;
            }
            let at = (y / factor) as usize * image.width() + (x / factor) as usize;
            Rgb([grey.get(at).copied().unwrap_or_default(); 3])
        })
    }

    fn legend_dot(&self) -> i64 {
        (self.width / 400).clamp(1, 5)
    }

    fn legend_height(&self) -> i64 {
        (letters::ROWS + 6) * self.legend_dot()
    }

    fn legend(&self, picture: &mut RgbImage, marks: &[Mark]) {
        let dot = self.legend_dot();
        let pen = Pen { dot, colour: LEGEND, rim: None };
        let corners = marks.len();
        let text = match &residuals(marks)[..] {
            [] => format!("{corners} corners, no residuals"),
            some => {
                let (by, rms) = (self.magnified, rms(some));
                format!("{corners} corners, residuals x {by}, rms {rms:.3} px")
            }
        };
        letters::write(picture, (4 * dot, self.height + 4 * dot), &text, pen);
    }

    /// Centre of a pixel of the image, in the drawing.
    fn at(&self, pixel: &Vector2<f64>) -> Vector2<f64> {
        (pixel.add_scalar(0.5) * f64::from(self.enlarged)).add_scalar(-0.5)
    }

    /// A cross that leaves its middle free.
    fn cross(&self, picture: &mut RgbImage, mark: &Mark) {
        let at = self.at(&mark.pixel);
        let colour = if mark.id == 0 { FIRST } else { CROSS };
        for (dx, dy) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            let along = Vector2::new(dx, dy) * self.line as f64;
            self.stroke(picture, at + along * 2.0, at + along * 6.0, self.line, colour);
        }
    }

    fn arrow(&self, picture: &mut RgbImage, mark: &Mark) {
        let Some(residual) = mark.residual else { return };
        let longest = (self.width + self.height) as f64;
        let drawn = residual * (self.magnified * f64::from(self.enlarged));
        let drawn = drawn * (longest / drawn.norm().max(longest));
        let (from, to) = (self.at(&mark.pixel), self.at(&mark.pixel) + drawn);
        let head = drawn * (4.0 * self.line as f64 / drawn.norm().max(1.0)).min(0.5);
        let barb = |side: f64| to - head + side * 0.6 * Vector2::new(-head.y, head.x);
        for (width, colour) in [(self.line + 2, RIM), (self.line, ARROW)] {
            for (a, b) in [(from, to), (to, barb(1.0)), (to, barb(-1.0))] {
                self.stroke(picture, a, b, width, colour);
            }
        }
    }

    /// The id, diagonally beside the corner, where its arrow does not go.
    fn id(&self, picture: &mut RgbImage, mark: &Mark) {
        let (at, text) = (self.at(&mark.pixel), &mark.text);
        let side = |r: f64| if r > 0.0 { -1.0 } else { 1.0 };
        let towards = mark.residual.map_or(Vector2::new(1.0, 1.0), |r| r.map(side));
        let gap = 5.0 * self.line as f64;
        // digits have no rows below the line
        let size = Vector2::new(letters::width(text), letters::ROWS - 2).cast::<f64>();
        let middle = at + towards.component_mul(&(size * (0.5 * self.line as f64)).add_scalar(gap));
        let corner = middle - size * (0.5 * self.line as f64);
        let pen = Pen { dot: self.line, colour: DIGITS, rim: Some(RIM) };
        letters::write(picture, (corner.x.round() as i64, corner.y.round() as i64), text, pen);
    }

    /// A straight line; what is outside of the image is left out.
    fn stroke(
        &self,
        picture: &mut RgbImage,
        from: Vector2<f64>,
        to: Vector2<f64>,
        width: i64,
        colour: Rgb<u8>,
    ) {
        let steps = (to - from).amax().ceil().max(1.0) as usize;
        for k in 0..=steps {
            let at = from.lerp(&to, k as f64 / steps as f64);
            let corner = |v: f64| v.round() as i64 - width / 2;
            square(picture, (corner(at.x), corner(at.y)), width, colour);
        }
    }
}

/// Typical distance of a corner to its nearest neighbour, px.
fn distance(marks: &[Mark]) -> Option<f64> {
    let nearest = |a: &Mark| {
        let all = marks.iter().map(|b| (b.pixel - a.pixel).norm());
        all.filter(|d| *d > 0.0).fold(f64::INFINITY, f64::min)
    };
    quantile(marks.iter().map(nearest).filter(|d| d.is_finite() && *d > 0.0), 0.25)
}

/// The largest 1, 2 or 5 times a power of ten at which most arrows stay near their corners.
fn magnification(residuals: &[Vector2<f64>], distance: f64) -> f64 {
    let usual = quantile(residuals.iter().map(|r| r.norm()), QUANTILE).unwrap_or(0.0);
    let most = (ARROW_SHARE * distance / usual).clamp(1.0, MOST_MAGNIFIED);
    let power = 10.0_f64.powf(most.log10().floor());
    STEPS.iter().map(|step| step * power).find(|m| *m <= most * (1.0 + 1e-9)).unwrap_or(1.0)
}

fn quantile(values: impl Iterator<Item = f64>, share: f64) -> Option<f64> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    sorted.get((share * last as f64).round() as usize).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix2;
    use std::ops::Range;

    fn corner(id: u32, x: f64, y: f64) -> ImageCorner {
        ImageCorner { id, pixel: Vector2::new(x, y), covariance: Matrix2::zeros() }
    }

    fn drawn(corners: &[ImageCorner], residuals: Option<&[Vector2<f64>]>) -> RgbImage {
        let image = GrayImage::new(200, 100, vec![200.0; 20_000]).unwrap();
        let marks = [Marks { name: None, corners, residuals }];
        image::load_from_memory(&marked(&image, &marks)).unwrap().to_rgb8()
    }

    fn has(picture: &RgbImage, colour: Rgb<u8>, x: Range<u32>, mut y: Range<u32>) -> bool {
        y.any(|y| x.clone().any(|x| *picture.get_pixel(x, y) == colour))
    }

    #[test]
    fn corners_at_the_rim_are_drawn_as_far_as_they_go() {
        let corners = [corner(0, 0.2, 0.4), corner(117, 198.6, 99.0)];
        let picture = drawn(&corners, None);
        assert_eq!(picture.width(), 200, "nothing to enlarge");
        assert!(has(&picture, FIRST, 0..40, 0..40));
        assert!(has(&picture, CROSS, 160..200, 60..100));
        assert_eq!(*picture.get_pixel(100, 50), Rgb([200, 200, 200]));
        let far = [Vector2::new(1e30, -1e30), Vector2::new(f64::MIN_POSITIVE, 0.0)];
        assert_eq!(drawn(&corners, Some(&far)).width(), 200);
    }

    #[test]
    fn arrows_point_from_the_prediction_to_the_corner() {
        let corners = [corner(1, 50.0, 50.0), corner(2, 150.0, 50.0)];
        let residuals = [Vector2::new(0.1, 0.0), Vector2::new(0.0, -0.1)];
        let picture = drawn(&corners, Some(&residuals));
        // 0.45 of 100 px is 450 times 0.1 px: magnified by 200
        assert!(has(&picture, ARROW, 68..71, 50..51) && !has(&picture, ARROW, 74..100, 0..100));
        assert!(has(&picture, ARROW, 150..151, 29..33) && !has(&picture, ARROW, 120..180, 0..28));
        assert!(!has(&picture, ARROW, 0..46, 0..100) && !has(&picture, ARROW, 120..180, 54..100));
    }

    #[test]
    fn crowded_corners_enlarge_the_picture() {
        let picture = drawn(&[corner(1, 50.0, 50.0), corner(2, 70.0, 50.0)], None);
        assert_eq!(picture.width(), 800);
    }

    #[test]
    fn magnifications_are_round_and_make_arrows_readable() {
        let of = |px: f64| magnification(&[Vector2::new(px, 0.0); 10], 40.0);
        assert_eq!([0.018, 0.0181, 0.1, 0.2, 30.0].map(of), [1000.0, 500.0, 100.0, 50.0, 1.0]);
        assert_eq!(of(0.0), MOST_MAGNIFIED);
        assert_eq!(magnification(&[], 40.0), MOST_MAGNIFIED);
    }
}
