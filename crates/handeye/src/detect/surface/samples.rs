//! The points of a scan around the corners of an image.

use std::collections::BTreeMap;

use nalgebra::{Vector2, Vector3};

use super::{
    Reason,
    plane::{Plane, inflation},
};
use crate::{ImageCorner, Intrinsics, Scan, detect::surface::plane::Sample};

/// Limits of the radius, scan pixels.
const RADIUS: (f64, f64) = (2.5, 20.0);
/// Distance to the next corner (scan px) that is assumed for a corner alone.
const LONELY: f64 = 16.0;
/// The window's radius, as a share of the distance to the nearest corner.
const REACH: f64 = 0.5;
/// Fewer points do not make a plane with a measured scatter.
pub(super) const FEWEST_POINTS: usize = 12;
/// Less than this share of the window measured is a hole.
const HOLE: f64 = 0.5;
/// Sizes of image and scan that agree in ratio to this are aligned pixel by pixel.
const SAME_RATIO: f64 = 0.01;
/// Side of the buckets (px) that sort an unorganised scan.
const BUCKET_PX: f64 = 16.0;

/// Unknowns of a plane.
const PLANE: f64 = 3.0;

/// The points around one corner.
pub(super) struct Window {
    pub samples: Vec<Sample>,
    /// The corner, scan px.
    pub centre: Vector2<f64>,
    /// Of the window, scan px.
    pub radius: f64,
    /// Scan pixels per image pixel.
    pub scale: f64,
    /// Whether neighbours in the scan are known.
    is_grid: bool,
}

impl Window {
    /// By how much fewer independent points there are than points.
    pub(crate) fn inflation(&self, samples: &[Sample], plane: &Plane) -> f64 {
        if self.is_grid { inflation(&plane.placed_residuals(samples), PLANE) } else { 1.0 }
    }
}

/// Points with their pixels, in buckets.
type Buckets = BTreeMap<(i64, i64), Vec<(Vector2<f64>, Vector3<f64>)>>;

/// Where the points around a pixel come from.
pub(super) enum Source<'a> {
    /// One point per scan pixel; scan pixels per image pixel.
    Grid(&'a Scan, f64),
    /// Points with their pixels, in buckets.
    Cloud(Buckets),
}

impl<'a> Source<'a> {
    pub fn of(
        scan: &'a Scan,
        image: (usize, usize),
        intrinsics: Option<&Intrinsics>,
    ) -> Option<Self> {
        let (x, y) = (scan.width() as f64 / image.0 as f64, scan.height() as f64 / image.1 as f64);
        if scan.is_organised() && (x / y - 1.0).abs() < SAME_RATIO {
            return Some(Self::Grid(scan, x));
        }
        let camera = intrinsics?;
        let mut buckets = Buckets::new();
        for p in scan.points() {
            let point = Vector3::new(p[0].into(), p[1].into(), p[2].into());
            let finite = point.iter().all(|x: &f64| x.is_finite());
            if let Some(pixel) = camera.project(&point).filter(|_| finite) {
                buckets.entry(bucket(&pixel)).or_default().push((pixel, point));
            }
        }
        Some(Self::Cloud(buckets))
    }

    /// Everything measured around a corner; `spacing` is the distance to the next one, image px.
    pub fn window(&self, corner: &ImageCorner, spacing: f64) -> Result<Window, Reason> {
        let scale = if let Self::Grid(_, scale) = self { *scale } else { 1.0 };
        let centre = corner.pixel.add_scalar(0.5) * scale - Vector2::repeat(0.5);
        let spacing = if spacing.is_finite() { spacing * scale } else { LONELY };
        let radius = (REACH * spacing).clamp(RADIUS.0, RADIUS.1);
        let samples = self.around(&centre, radius)?;
        let is_grid = matches!(self, Self::Grid(..));
        Ok(Window { samples, centre, radius, scale, is_grid })
    }

    fn around(&self, centre: &Vector2<f64>, radius: f64) -> Result<Vec<Sample>, Reason> {
        match self {
            Self::Grid(scan, _) => grid_samples(scan, centre, radius),
            Self::Cloud(buckets) => cloud_samples(buckets, centre, radius),
        }
    }
}

fn bucket(pixel: &Vector2<f64>) -> (i64, i64) {
    ((pixel.x / BUCKET_PX).floor() as i64, (pixel.y / BUCKET_PX).floor() as i64)
}

fn grid_samples(scan: &Scan, centre: &Vector2<f64>, radius: f64) -> Result<Vec<Sample>, Reason> {
    let (right, bottom) = (scan.width() as f64 - 1.0, scan.height() as f64 - 1.0);
    let inside = (0.0..=right).contains(&centre.x) && (0.0..=bottom).contains(&centre.y);
    if !inside {
        return Err(Reason::Outside);
    }
    let (mut samples, mut window) = (vec![], 0);
    let span = |c: f64, last: f64| {
        ((c - radius).ceil().max(0.0) as usize)..=((c + radius).floor().min(last) as usize)
    };
    for y in span(centre.y, bottom) {
        for x in span(centre.x, right) {
            let at = Vector2::new(x as f64, y as f64) - centre;
            if at.norm() > radius {
                continue;
            }
            window += 1;
            if let Some(point) = scan.at(x, y).filter(|p| p.z > 0.0) {
                samples.push(Sample { at, point, cell: (x as i64, y as i64) });
            }
        }
    }
    let points = samples.len();
    if points < FEWEST_POINTS || (points as f64) < HOLE * window as f64 {
        return Err(Reason::Hole { points, window });
    }
    Ok(samples)
}

fn cloud_samples(
    buckets: &Buckets,
    centre: &Vector2<f64>,
    radius: f64,
) -> Result<Vec<Sample>, Reason> {
    let (low, high) = (bucket(&centre.add_scalar(-radius)), bucket(&centre.add_scalar(radius)));
    let cells = (low.0..=high.0).flat_map(|i| (low.1..=high.1).map(move |j| (i, j)));
    let near = cells.filter_map(|cell| buckets.get(&cell)).flatten();
    let samples: Vec<Sample> = near
        .map(|(pixel, point)| Sample { at: pixel - centre, point: *point, cell: (0, 0) })
        .filter(|s| s.at.norm() <= radius)
        .collect();
    match samples.len() {
        0 => Err(Reason::Outside),
        points if points < FEWEST_POINTS => Err(Reason::Hole { points, window: FEWEST_POINTS }),
        _ => Ok(samples),
    }
}
