//! The camera's own parameters, from images of a flat target.
//!
//! The start is closed: with `B = K⁻ᵀ K⁻¹`, each view's homography `H = (h₁ h₂ h₃)` gives
//! `h₁ᵀ B h₂ = 0` and `h₁ᵀ B h₁ = h₂ᵀ B h₂`, linear in `B`. Then all views' poses and the parameters
//! are adjusted together,
//!
//! ```text
//! min Σᵢⱼ wᵢⱼ |π(k, Tᵢ pⱼ) - uᵢⱼ|²,      k = (fx, fy, cx, cy, k1, k2, p1, p2, k3 ...)
//! ```
//!
//! by Levenberg-Marquardt; the normal equations have the shape of an arrow, so each pose is
//! eliminated from them (Schur complement). Weights hold the corners' covariances, what the model
//! leaves beyond them, and Huber's function. Distortion terms are added one by one while the
//! residuals pay for them.
//!
//! Z. Zhang, *A flexible new technique for camera calibration*, IEEE TPAMI 22(11), 2000;
//! B. Triggs et al., *Bundle adjustment: a modern synthesis*, 2000; G. Schwarz, *Estimating the
//! dimension of a model*, 1978.

mod adjustment;
pub mod lens;
mod lens_model;
pub mod pixel_origin;
mod start;
#[cfg(test)]
mod tests;

use nalgebra::{DMatrix, DVector};

pub use lens_model::LensModel;

use crate::{
    Camera, Error, ImageCorner, Intrinsics, Pose, Target, TargetModel, Warning, math::statistics,
};
use adjustment::Adjustment;
use lens_model::free_in;
use start::starts;

/// A calibrated camera.
#[derive(Debug, Clone)]
pub struct CameraCalibration {
    /// The parameters.
    pub intrinsics: Intrinsics,
    /// Names of the parameters that were fitted, in the order of the covariance.
    pub parameters: Vec<&'static str>,
    /// Their covariance: px² for `fx fy cx cy`, none for the distortion coefficients.
    pub covariance: DMatrix<f64>,
    /// Root of the mean squared distance between corners and model, px.
    pub rms_px: f64,
    /// One entry per given view, in the same order.
    pub views: Vec<ViewFit>,
    /// What the user should know.
    pub warnings: Vec<Warning>,
}

/// How a view fits.
#[derive(Debug, Clone)]
pub struct ViewFit {
    /// The target in this view; `None` if the view was left out.
    pub camera_from_target: Option<Pose<Camera, Target>>,
    /// Root of the mean squared distance between its used corners and the model, px.
    pub rms_px: f64,
    /// Corners that do not fit and were left out.
    pub left_out: Vec<u32>,
}

/// Fewer views do not determine the parameters.
const FEWEST_VIEWS: usize = 3;
/// k3 needs at least this many views to be told from k1 and k2.
const FEWEST_VIEWS_FOR_K3: usize = 6;
/// Fewer corners do not help: a pose takes six numbers of theirs.
const FEWEST_CORNERS: usize = 6;
/// A distortion term must raise the log-likelihood by this multiple of Schwarz's price: residuals
/// of neighbouring corners are not independent.
pub(crate) const PRICE: f64 = 4.0;
/// Below this rms (px) the first start was good enough.
const GOOD_RMS_PX: f64 = 1.0;

/// Calibrates a camera from the target's corners in several images of `width x height` pixels.
///
/// Of `lens` those terms are used that the views pay for. The labelling of a symmetric board does
/// not matter.
///
/// # Errors
/// Fewer than three usable views; views that leave the focal length open (all parallel to each
/// other).
pub fn calibrate(
    views: &[Vec<ImageCorner>],
    target: &TargetModel,
    width: u32,
    height: u32,
    lens: LensModel,
) -> Result<CameraCalibration, Error> {
    let usable = views.iter().filter(|v| v.len() >= FEWEST_CORNERS).count();
    if usable < FEWEST_VIEWS {
        return Err(Error::TooFewPoses {
            found: usable,
            needed: FEWEST_VIEWS,
            advice: "take images of the board from more directions".into(),
        });
    }
    let mut adjusted: Option<Adjustment> = None;
    for start in starts(views, target, width, height, lens) {
        let next = Adjustment::new(views, target, start)
            .and_then(|start| with_terms_that_pay(start, lens));
        let is_better = |a: &Adjustment| adjusted.as_ref().is_none_or(|b| a.rms() < b.rms());
        if let Some(next) = next.filter(is_better) {
            adjusted = Some(next);
        }
        if adjusted.as_ref().is_some_and(|a| a.rms() < GOOD_RMS_PX) {
            break;
        }
    }
    adjusted.ok_or_else(undetermined)?.finish(views)
}

/// How a camera that was given compares with what the views show of it.
#[derive(Debug, Clone)]
pub struct CrossCheck {
    /// The camera of the given one's model that fits the views best.
    pub found: CameraCalibration,
    /// How often, if the given camera were right, the views would differ from it as much.
    pub chance: f64,
    /// Root of the mean squared distance between corners and the given camera's model, px.
    pub rms_given_px: f64,
    /// The parameter that differs most: its name, the given value, the views', and the views'
    /// standard deviation.
    pub farthest: (&'static str, f64, f64, f64),
}

/// Fits all parameters that `given` has to the views, and compares.
///
/// # Errors
/// As [`calibrate`].
pub fn cross_check(
    views: &[Vec<ImageCorner>],
    target: &TargetModel,
    given: &Intrinsics,
) -> Result<CrossCheck, Error> {
    let mut adjustment = Adjustment::new(views, target, *given).ok_or_else(undetermined)?;
    let rms_given_px = adjustment.rms();
    adjustment.free = free_in(given);
    let free = adjustment.free.parameters();
    adjustment.settle().and_then(|()| adjustment.trim()).ok_or_else(undetermined)?;
    let values = adjustment.camera.values();
    let found = adjustment.finish(views)?;
    let off = free.iter().map(|k| values[*k] - given.values()[*k]);
    let off = DVector::from_iterator(free.len(), off);
    let inverse = found.covariance.clone().cholesky().ok_or_else(undetermined)?;
    let chance = statistics::of_chi_square(off.dot(&inverse.solve(&off)), free.len());
    let sigma = |i: usize| found.covariance[(i, i)].sqrt();
    let share = |i: usize| off[i].abs() / sigma(i);
    let most = (0..free.len()).max_by(|a, b| share(*a).total_cmp(&share(*b))).unwrap_or(0);
    let k = free[most];
    let farthest = (found.parameters[most], given.values()[k], values[k], sigma(most));
    Ok(CrossCheck { found, chance, rms_given_px, farthest })
}

fn undetermined() -> Error {
    Error::NotDetermined {
        what: "the focal length: all views of the board are nearly parallel; tilt it by 20 to 40 \
               degrees in different directions"
            .into(),
    }
}

/// Adds distortion terms while they pay.
fn with_terms_that_pay(mut adjustment: Adjustment, lens: LensModel) -> Option<Adjustment> {
    let mut best: Option<(f64, Adjustment)> = None;
    for free in lens.ladder() {
        if free.leading >= 9 && adjustment.views.len() < FEWEST_VIEWS_FOR_K3 {
            break;
        }
        let mut next = Adjustment { free, ..adjustment.clone() };
        if next.settle().is_none() || !next.is_sound() {
            continue; // with more terms it may be
        }
        let price = next.price();
        if best.as_ref().is_none_or(|(least, _)| price < *least) {
            best = Some((price, next.clone()));
        }
        adjustment = next;
    }
    let (_, mut best) = best?;
    best.trim()?;
    Some(best)
}
