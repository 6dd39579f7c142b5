//! A ball in a scan: its centre, how sure that is, and its diameter where nobody told it.
//!
//! The ball is found without a start. The scan is thinned out and sorted into cells; the points
//! around each cell get a sphere by linear least squares, `|p|² = 2 c·p + k`, and what has the right
//! size and curves towards the camera is a candidate. A ball is solid: rays that meet it end on it,
//! or before it where something hides it, but not inside or behind it (`candidates`).
//!
//! The centre is then fitted to all points of the scan along their rays. The unit ray `u` meets the
//! ball of radius `r` about `c` at
//!
//! ```text
//! t = u·c - √(r² - |c|² + (u·c)²)         e = |p| - t
//! ```
//!
//! so the noise, which is along the ray, is the residual `e` itself, and no point is favoured for
//! its noise. Tukey's weights keep out what is not the ball. Neighbouring pixels share a part of
//! their noise; the covariance grows by it, as that of corners on a scan.
//!
//! The least-squares sphere: I. Coope, *Circle fitting by linear and nonlinear least squares*,
//! J. Optimization Theory and Applications 76, 1993.

mod candidates;
mod fit;
#[cfg(test)]
mod tests;

use nalgebra::Matrix3;

use crate::{Camera, Point, Scan};
use fit::{Fit, Size};

/// A ball that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// Its centre.
    pub centre: Point<Camera>,
    /// Covariance of the centre, m².
    pub covariance: Matrix3<f64>,
    /// Its diameter, m: given, or found.
    pub diameter_m: f64,
    /// Its standard deviation, m; zero where it was given.
    pub sigma_diameter_m: f64,
    /// Points of the scan on it.
    pub points: usize,
    /// RMS distance of these points from it along their rays, m.
    pub rms_m: f64,
}

/// Why no ball was found.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoBall {
    /// The scan holds too little.
    #[error("the scan holds only {0} points")]
    Empty(usize),
    /// Nothing in it is a ball.
    #[error("no ball in the scan")]
    None,
    /// Too little of it was measured.
    #[error("only {points} points on the ball; it takes {FEWEST}: move nearer or free its view")]
    TooFew {
        /// Points on it.
        points: usize,
    },
    /// A ball of another size.
    #[error("no ball of {wanted_mm} mm: a ball of {found_mm:.1} mm is there")]
    OtherSize {
        /// The diameter that was declared, mm.
        wanted_mm: f64,
        /// The diameter of the ball that is there, mm.
        found_mm: f64,
    },
}

/// Fewer points do not make a ball with a measured scatter.
const FEWEST: usize = 40;
/// A diameter that differs by more than this part, and by [`SURELY`] standard deviations, is another
/// ball's.
const OTHER_SIZE: f64 = 0.02;
/// Standard deviations.
const SURELY: f64 = 5.0;

/// Finds the ball in a scan. `diameter_m` is its diameter, where it is known.
///
/// # Errors
/// Why there is none.
pub fn find(scan: &Scan, diameter_m: Option<f64>) -> Result<Ball, NoBall> {
    let thin = candidates::thinned(scan);
    if thin.len() < FEWEST {
        return Err(NoBall::Empty(thin.len()));
    }
    let Some(diameter_m) = diameter_m else { return of_any_size(scan, &thin) };
    let start = candidates::best(&thin, Some(0.5 * diameter_m));
    let other =
        |found_m: f64| NoBall::OtherSize { wanted_mm: diameter_m * 1e3, found_mm: found_m * 1e3 };
    let Some(start) = start else {
        return match of_any_size(scan, &thin) {
            Ok(ball) => Err(other(ball.diameter_m)),
            Err(reason) => Err(reason),
        };
    };
    let free = Fit::of(scan, &start, Size::Free)?.ball();
    let off = (free.diameter_m - diameter_m).abs();
    if off > OTHER_SIZE * diameter_m && off > SURELY * free.sigma_diameter_m {
        return Err(other(free.diameter_m));
    }
    let start = candidates::Candidate { centre: free.centre.vector(), radius: 0.5 * diameter_m };
    Ok(Fit::of(scan, &start, Size::Given)?.ball())
}

fn of_any_size(scan: &Scan, thin: &[nalgebra::Vector3<f64>]) -> Result<Ball, NoBall> {
    let start = candidates::best(thin, None).ok_or(NoBall::None)?;
    Ok(Fit::of(scan, &start, Size::Free)?.ball())
}
