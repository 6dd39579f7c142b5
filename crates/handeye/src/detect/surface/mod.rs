//! Corners of the image as 3D points on the scan.
//!
//! Around a corner the board is flat, so the inverse depth and the ray are linear in the pixel,
//!
//! ```text
//! 1/Z = α + β u + γ v,        X/Z = aₓ + bₓ u + cₓ v,        Y/Z = a_y + b_y u + c_y v
//! ```
//!
//! with `(u, v)` counted from the corner: the point is `(aₓ, a_y, 1)/α`. The rays come from the
//! scan's own grid, so an organised scan needs no intrinsics. The plane is found by least median of
//! squares and polished with Tukey's weights: holes, edges and flying points do not pull. Its window
//! spans half a cell to each side, as many black as white pixels, so that a step between the
//! colours cancels; windows of neighbours do not overlap, so that their errors are independent. Where
//! such a step is proven, it is taken off the points first (`colours`, `step`).
//!
//! The covariance is that of the pixel, carried along the plane, plus that of `α`, carried along the
//! ray: the scatter about the plane over the number of independent points, which correlation among
//! neighbouring pixels makes smaller (G. Bayley and J. Hammersley 1946).
//!
//! P. Rousseeuw, *Least median of squares regression*, JASA 79, 1984; J. Tukey's biweight after
//! A. Beaton, Technometrics 16, 1974.

mod colours;
mod plane;
mod samples;
mod step;
#[cfg(test)]
mod tests;

pub(crate) use colours::{Coloured, ColouredCorner};
pub(crate) use step::OnScan;
pub use step::{PooledStep, Step, settle};

use crate::{ImageCorner, Intrinsics, Scan, SurfaceCorner, TargetModel};
use plane::{Plane, Rays};
pub(crate) use plane::{TUKEY, TUKEY_COST, inflation, tukey};
use samples::{Source, Window};

/// A corner that has no point on the scan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Missing {
    /// Which corner.
    pub id: u32,
    /// Why.
    pub reason: Reason,
}

/// Why a corner has no point on the scan.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Reason {
    /// The scan does not reach there.
    #[error("outside of the scan")]
    Outside,
    /// Too little was measured around it.
    #[error("a hole: only {points} points of {window} around it")]
    Hole {
        /// Points that were measured.
        points: usize,
        /// Points the window has room for.
        window: usize,
    },
    /// The points around it do not lie in one plane.
    #[error("a depth edge: only {share:.0} % of the points around it lie in one plane", share = 100.0 * .0)]
    Edge(f64),
    /// The points lie to one side, the corner beyond them.
    #[error("points on one side of it only")]
    OneSided,
    /// Too few points around it are away from the edges of the print.
    #[error("too few points away from the edges of the print: the scan is too coarse")]
    Mixed,
    /// An unorganised scan, and nobody told the intrinsics.
    #[error("the scan is not a grid as large as the image, and no intrinsics are known")]
    NoGrid,
}

/// Corners of one capture on its scan.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Lifted {
    /// The corners, as if all points were measured alike.
    pub found: Vec<SurfaceCorner>,
    /// Those without a point on the scan.
    pub missing: Vec<Missing>,
    /// What the two colours of the print say; `None` where they cannot be told apart.
    pub coloured: Option<Coloured>,
}

/// Lifts corners of an image of `width x height` pixels onto its scan.
///
/// An organised scan must be pixel-aligned with the image, as large or evenly scaled. An
/// unorganised one is projected with `intrinsics`. Points are in the camera frame, in metres.
pub fn lift(
    corners: &[ImageCorner],
    size: (usize, usize),
    scan: &Scan,
    intrinsics: Option<&Intrinsics>,
) -> OnScan {
    lift_plain(&windows(corners, size, scan, intrinsics))
}

/// As [`lift`], and what the print on the `target` says about depth on its two colours.
pub fn lift_coloured(
    corners: &[ImageCorner],
    size: (usize, usize),
    scan: &Scan,
    intrinsics: Option<&Intrinsics>,
    target: &TargetModel,
) -> Lifted {
    let windows = windows(corners, size, scan, intrinsics);
    let (found, missing) = lift_plain(&windows);
    Lifted { found, missing, coloured: colours::lift(corners, &windows, target) }
}

/// A corner of the image, and what the scan has around it.
type Windows<'a> = Vec<(&'a ImageCorner, Result<Window, Reason>)>;

fn windows<'a>(
    corners: &'a [ImageCorner],
    size: (usize, usize),
    scan: &Scan,
    intrinsics: Option<&Intrinsics>,
) -> Windows<'a> {
    let source = Source::of(scan, size, intrinsics);
    let one = |corner: &'a ImageCorner| {
        let window = match &source {
            Some(source) => source.window(corner, spacing(corner, corners)),
            None => Err(Reason::NoGrid),
        };
        (corner, window)
    };
    corners.iter().map(one).collect()
}

fn lift_plain(windows: &Windows) -> OnScan {
    lift_all(windows, |corner, window| {
        let plane = Plane::fit(&window.samples, corner.id.into())?;
        on_plane(corner, window, &window.samples, &plane)
    })
}

fn lift_all<T>(
    windows: &Windows,
    lift: impl Fn(&ImageCorner, &Window) -> Result<T, Reason>,
) -> (Vec<T>, Vec<Missing>) {
    let (mut found, mut missing) = (vec![], vec![]);
    for (corner, window) in windows {
        match window.as_ref().map_err(|reason| *reason).and_then(|w| lift(corner, w)) {
            Ok(corner) => found.push(corner),
            Err(reason) => missing.push(Missing { id: corner.id, reason }),
        }
    }
    (found, missing)
}

fn on_plane(
    corner: &ImageCorner,
    window: &Window,
    samples: &[plane::Sample],
    plane: &Plane,
) -> Result<SurfaceCorner, Reason> {
    plane.check(samples, window.radius)?;
    let rays = Rays::fit(samples, plane)?;
    let covariance = corner.covariance * (window.scale * window.scale);
    Ok(plane.corner(corner.id, &rays, &covariance, window.inflation(samples, plane)))
}

/// Distance to the nearest other corner, image px.
fn spacing(corner: &ImageCorner, corners: &[ImageCorner]) -> f64 {
    let others = corners.iter().filter(|c| c.id != corner.id);
    others.map(|c| (c.pixel - corner.pixel).norm()).fold(f64::INFINITY, f64::min)
}
