//! The pixels around a corner.

use std::ops::Range;

use nalgebra::{Matrix2, Vector2};

use super::{REACH, RoughCorner, Unfit};
use crate::{GrayImage, detect::saturated::is_saturated};

/// Fewer pixels than this do not determine nine parameters.
pub(super) const FEWEST_PIXELS: usize = 14;
/// Markers are cut out with this margin, px, for their blur.
const MARKER_MARGIN_PX: f64 = 2.0;

/// Pixels that are computed at once.
pub(super) const LANES: usize = 32;
pub(super) type Lane = [f32; LANES];

/// Pixels relative to the disc's centre; a weight of 0 fills up the last ones.
pub(super) struct Pixels<'a> {
    pub x: &'a Lane,
    pub y: &'a Lane,
    pub grey: &'a Lane,
    pub weight: &'a Lane,
}

/// The pixels around a corner, relative to its centre: a multiple of [`LANES`], the last ones with
/// a weight of 0.
pub(super) struct Disc {
    pub centre: Vector2<f64>,
    pub x: Vec<f32>,
    pub y: Vec<f32>,
    grey: Vec<f32>,
    weight: Vec<f32>,
    pub count: usize,
    /// Whether some pixels are as bright or as dark as can be.
    pub saturated: bool,
    pub light: Light,
}

impl Disc {
    pub(crate) fn gather(
        image: &GrayImage,
        rough: &RoughCorner,
        radius: f64,
    ) -> Result<Self, Unfit> {
        let centre = rough.pixel;
        let (low_x, low_y) = ((centre.x - radius).ceil(), (centre.y - radius).ceil());
        let (high_x, high_y) = ((centre.x + radius).floor(), (centre.y + radius).floor());
        let (right, bottom) = (image.width() as f64 - 1.0, image.height() as f64 - 1.0);
        if !(low_x >= 0.0 && low_y >= 0.0 && high_x <= right && high_y <= bottom) {
            return Err(Unfit::AtTheEdge);
        }
        let hidden = markers_around(rough)?;
        let mut disc = Self::with_room((4.0 * radius * radius) as usize + LANES, centre);
        for y in low_y as usize..=high_y as usize {
            let dy = y as f64 - centre.y;
            let half = (radius * radius - dy * dy).max(0.0).sqrt();
            let (first, last) = ((centre.x - half).ceil(), (centre.x + half).floor());
            let seen = first as usize..last as usize + 1;
            match &hidden {
                None => disc.push(image, y, seen),
                Some(hidden) => {
                    let clear = |x: &usize| !hidden(&Vector2::new(*x as f64 - centre.x, dy));
                    seen.filter(clear).for_each(|x| disc.push(image, y, x..x + 1));
                }
            }
        }
        if disc.count < FEWEST_PIXELS {
            return Err(Unfit::TooSmall(radius / REACH));
        }
        disc.fill_up();
        Ok(disc)
    }

    fn with_room(count: usize, centre: Vector2<f64>) -> Self {
        let room = || Vec::with_capacity(count);
        let (saturated, light) = (false, Light::Multiplies);
        let (x, y, grey, weight) = (room(), room(), room(), room());
        Self { centre, x, y, grey, weight, count: 0, saturated, light }
    }

    /// Adds a part of a row.
    fn push(&mut self, image: &GrayImage, y: usize, part: Range<usize>) {
        let row = y * image.width();
        self.count += part.len();
        self.grey.extend_from_slice(&image.values()[row + part.start..row + part.end]);
        self.y.resize(self.count, (y as f64 - self.centre.y) as f32);
        self.x.extend(part.map(|x| (x as f64 - self.centre.x) as f32));
    }

    fn fill_up(&mut self) {
        self.saturated = self.grey.iter().fold(false, |any, &grey| any | is_saturated(grey));
        let full = self.count.next_multiple_of(LANES);
        self.weight.resize(self.count, 1.0);
        for values in [&mut self.x, &mut self.y, &mut self.grey, &mut self.weight] {
            values.resize(full, 0.0);
        }
    }

    pub fn pixels(&self) -> impl Iterator<Item = Pixels<'_>> {
        fn lanes(values: &[f32]) -> std::slice::Iter<'_, Lane> {
            values.as_chunks().0.iter()
        }
        let all =
            lanes(&self.x).zip(lanes(&self.y)).zip(lanes(&self.grey)).zip(lanes(&self.weight));
        all.map(|(((x, y), grey), weight)| Pixels { x, y, grey, weight })
    }

    pub fn each(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let one = |k: usize| (f64::from(self.x[k]), f64::from(self.y[k]), f64::from(self.grey[k]));
        (0..self.count).map(one)
    }
}

/// Whether a place relative to a corner lies in a marker of the squares around it; `None` where there
/// are no markers.
fn markers_around(
    rough: &RoughCorner,
) -> Result<Option<impl Fn(&Vector2<f64>) -> bool + use<>>, Unfit> {
    if rough.clean >= 1.0 {
        return Ok(None);
    }
    let cells = Matrix2::from_columns(&[rough.along_x, rough.along_y]);
    let into_cells = cells.try_inverse().ok_or(Unfit::NoCorner)?;
    let margin = MARKER_MARGIN_PX / rough.along_x.norm().min(rough.along_y.norm());
    let clean = rough.clean - margin;
    let marker = rough.marker;
    Ok(Some(move |d: &Vector2<f64>| {
        let q = into_cells * d;
        match marker {
            Some([x, y]) => (x * q.x).min(y * q.y) > clean,
            None => q.x.abs().min(q.y.abs()) > clean,
        }
    }))
}

/// How the slope of the light gets into the image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Light {
    /// Black and white reflect it: lamps, vignetting.
    Multiplies,
    /// It lies over black and white alike: glare.
    Adds,
}
