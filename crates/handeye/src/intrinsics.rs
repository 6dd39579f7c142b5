//! The camera's own parameters, from pictures of a flat target.
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

use serde::{Deserialize, Serialize};

use nalgebra::{
    DMatrix, DVector, Isometry3, Matrix3, Matrix6, SMatrix, SVector, Vector2, Vector3, Vector6,
};

use crate::camera::LENS_PARAMETERS;
use crate::chance;
use crate::detect::{homography, target_poses};
use crate::lie::{self, hat};
use crate::linalg::median;
use crate::{
    Camera, Distortion, Error, ImageCorner, Intrinsics, Pose, Target, TargetModel, Warning,
};

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

/// The model of a lens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LensModel {
    /// Brown-Conrady's `k1 k2 p1 p2 k3`, of them what pays.
    #[default]
    BrownConrady,
    /// The same and `k4 k5 k6`, the polynomial below it.
    Rational,
    /// The same and `s1 s2 s3 s4`, for lenses that are tilted.
    ThinPrism,
    /// Kannala-Brandt's `k1 k2 k3 k4`: fisheye.
    KannalaBrandt,
}

/// The first parameter of a thin prism.
const PRISM: usize = 12;
const NAMES: [&str; LENS_PARAMETERS] = [
    "fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4",
];

/// Parameters that are fitted: leading ones, and the thin prism's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Free {
    leading: usize,
    prism: bool,
}

impl Free {
    const PINHOLE: Self = Self::leading(4);

    const fn leading(leading: usize) -> Self {
        Self { leading, prism: false }
    }

    const fn with_prism(leading: usize) -> Self {
        Self { leading, prism: true }
    }

    /// In the order of [`Intrinsics::by_lens`].
    fn parameters(self) -> Vec<usize> {
        let prism = if self.prism { PRISM } else { LENS_PARAMETERS };
        (0..self.leading).chain(prism..LENS_PARAMETERS).collect()
    }
}

impl LensModel {
    /// What is tried, from the pinhole on.
    fn ladder(self) -> Vec<Free> {
        let (leading, more): (&[usize], &[Free]) = match self {
            Self::BrownConrady => (&[4, 5, 6, 8, 9], &[]),
            Self::Rational => (&[4, 5, 6, 8, 9, 12], &[]),
            Self::ThinPrism => {
                (&[4, 5, 6, 8, 9], &[Free::with_prism(9), Free::leading(12), Free::with_prism(12)])
            }
            Self::KannalaBrandt => (&[4, 5, 6, 7, 8], &[]),
        };
        leading.iter().map(|n| Free::leading(*n)).chain(more.iter().copied()).collect()
    }

    /// Without any distortion of its own.
    fn plain(self) -> Distortion {
        match self {
            Self::KannalaBrandt => Distortion::KannalaBrandt([0.0; 4]),
            _ => Distortion::BrownConrady([0.0; 12]),
        }
    }
}
/// Fewer views do not determine the parameters.
const FEWEST_VIEWS: usize = 3;
/// k3 needs at least this many views to be told from k1 and k2.
const FEWEST_VIEWS_FOR_K3: usize = 6;
/// Fewer corners do not help: a pose takes six numbers of theirs.
const FEWEST_CORNERS: usize = 6;
/// Focal length of a common lens, in picture widths: the start when there is no closed one.
const COMMON_FOCAL: f64 = 1.2;
/// Focal lengths of lenses that see more and more, in picture widths.
const FISHEYE_FOCALS: [f64; 3] = [0.5, 0.33, 0.8];
/// Focal lengths outside of this range, in picture widths, are no start.
const FOCAL_RANGE: (f64, f64) = (0.3, 10.0);
/// A focal length less sure than this share of it is not determined by the views.
const FOCAL_UNSURE: f64 = 0.05;
/// Residuals beyond this many standard deviations are outliers.
const FARTHEST: f64 = 5.0;
/// Huber's bound, standard deviations.
const HUBER: f64 = 1.5;
/// A distortion term must raise the log-likelihood by this multiple of Schwarz's price: residuals
/// of neighbouring corners are not independent.
pub(crate) const PRICE: f64 = 4.0;
/// Rounds of re-weighting.
const ROUNDS: usize = 3;
/// Most steps of one adjustment.
const MOST_STEPS: usize = 60;
/// The adjustment ends when the cost falls by less than this share.
const CONVERGED: f64 = 1e-10;
/// Half of all squared lengths of a 2-vector of unit normal deviates are below this.
const CHI2_2_MEDIAN: f64 = 1.386_294_361;
/// A picture whose rms exceeds this multiple of the others' median is worth a warning.
const CONSPICUOUS: f64 = 3.0;

type Shared = SVector<f64, LENS_PARAMETERS>;
type SharedNormal = SMatrix<f64, LENS_PARAMETERS, LENS_PARAMETERS>;
type Cross = SMatrix<f64, LENS_PARAMETERS, 6>;

/// Calibrates a camera from the target's corners in several pictures of `width x height` pixels.
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
            advice: "take pictures of the board from more directions".into(),
        });
    }
    let mut adjusted: Option<Adjustment> = None;
    for start in starts(views, target, width, height, lens) {
        let next = Adjustment::new(views, target, start).and_then(|start| climb(start, lens));
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
    let chance = chance::of_chi_square(off.dot(&inverse.solve(&off)), free.len());
    let sigma = |i: usize| found.covariance[(i, i)].sqrt();
    let share = |i: usize| off[i].abs() / sigma(i);
    let most = (0..free.len()).max_by(|a, b| share(*a).total_cmp(&share(*b))).unwrap_or(0);
    let k = free[most];
    let farthest = (found.parameters[most], given.values()[k], values[k], sigma(most));
    Ok(CrossCheck { found, chance, rms_given_px, farthest })
}

/// The parameters that a camera has.
fn free_in(camera: &Intrinsics) -> Free {
    match camera.distortion {
        Distortion::None => Free::PINHOLE,
        Distortion::KannalaBrandt(_) => Free::leading(8),
        Distortion::BrownConrady(k) => {
            let some = |range: std::ops::Range<usize>| k[range].iter().any(|k| *k != 0.0);
            let leading = if some(5..8) { 12 } else { 4 + if some(0..5) { 5 } else { 0 } };
            Free { leading, prism: some(8..12) }
        }
    }
}

/// Below this rms (px) the first start was good enough.
const GOOD_RMS_PX: f64 = 1.0;

fn undetermined() -> Error {
    Error::NotDetermined {
        what: "the focal length: all views of the board are nearly parallel; tilt it by 20 to 40 \
               degrees in different directions"
            .into(),
    }
}

/// Zhang's closed form, if it gives a camera, and a common lens.
fn starts(
    views: &[Vec<ImageCorner>],
    target: &TargetModel,
    width: u32,
    height: u32,
    lens: LensModel,
) -> Vec<Intrinsics> {
    let (w, h) = (f64::from(width), f64::from(height));
    let centre = Vector2::new(0.5 * (w - 1.0), 0.5 * (h - 1.0));
    let homographies: Vec<_> =
        views.iter().filter_map(|view| view_homography(view, target, &centre, w)).collect();
    let common = COMMON_FOCAL * w.max(h);
    let plain =
        |fx: f64, fy: f64, c: Vector2<f64>| Intrinsics::pinhole(width, height, fx, fy, c.x, c.y);
    let closed = zhang(&homographies).map(|(fx, fy, c)| plain(fx * w, fy * w, c * w + centre));
    let plausible = |c: &Intrinsics| {
        let range = FOCAL_RANGE.0 * w..FOCAL_RANGE.1 * w;
        range.contains(&c.fx)
            && range.contains(&c.fy)
            && (0.0..w).contains(&c.cx)
            && (0.0..h).contains(&c.cy)
    };
    let wide = FISHEYE_FOCALS.map(|share| plain(share * w, share * w, centre));
    let fisheye = wide.into_iter().filter(|_| lens == LensModel::KannalaBrandt);
    let of_lens = |camera: Intrinsics| Intrinsics { distortion: lens.plain(), ..camera };
    let all = closed.filter(plausible).into_iter().chain([plain(common, common, centre)]);
    fisheye.chain(all).map(of_lens).collect()
}

/// Homography from the target to pixels from the centre, in picture widths.
fn view_homography(
    view: &[ImageCorner],
    target: &TargetModel,
    centre: &Vector2<f64>,
    width: f64,
) -> Option<Matrix3<f64>> {
    let pairs: Vec<(Vector2<f64>, Vector2<f64>)> = view
        .iter()
        .filter_map(|c| Some((target.corner(c.id)?.vector().xy(), (c.pixel - centre) / width)))
        .collect();
    let (from, to): (Vec<_>, Vec<_>) = pairs.into_iter().unzip();
    homography::fit(&from, &to)
}

/// Zhang's closed form without skew: focal lengths and principal point.
fn zhang(homographies: &[Matrix3<f64>]) -> Option<(f64, f64, Vector2<f64>)> {
    // B11 B22 B13 B23 B33; B12 = 0
    let row = |h: &Matrix3<f64>, i: usize, j: usize| {
        SVector::<f64, 5>::new(
            h[(0, i)] * h[(0, j)],
            h[(1, i)] * h[(1, j)],
            h[(2, i)] * h[(0, j)] + h[(0, i)] * h[(2, j)],
            h[(2, i)] * h[(1, j)] + h[(1, i)] * h[(2, j)],
            h[(2, i)] * h[(2, j)],
        )
    };
    let mut normal = SMatrix::<f64, 5, 5>::zeros();
    for h in homographies {
        let h = h / h.column(0).norm();
        for v in [row(&h, 0, 1), row(&h, 0, 0) - row(&h, 1, 1)] {
            normal += v * v.transpose();
        }
    }
    let eigen = normal.symmetric_eigen();
    let b = eigen.eigenvectors.column(eigen.eigenvalues.imin());
    let b = b * b[0].signum();
    let [b11, b22, b13, b23, b33] = [b[0], b[1], b[2], b[3], b[4]];
    let (cx, cy) = (-b13 / b11, -b23 / b22);
    let lambda = b33 - b13 * b13 / b11 - b23 * b23 / b22;
    let (fx, fy) = ((lambda / b11).sqrt(), (lambda / b22).sqrt());
    (fx.is_finite() && fy.is_finite()).then(|| (fx, fy, Vector2::new(cx, cy)))
}

/// Adds distortion terms while they pay.
fn climb(mut adjustment: Adjustment, lens: LensModel) -> Option<Adjustment> {
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

#[derive(Clone)]
struct Corner {
    id: u32,
    in_target: Vector3<f64>,
    pixel: Vector2<f64>,
    /// Variance per axis, px².
    variance: f64,
    weight: f64,
}

#[derive(Clone)]
struct View {
    /// Its place among the given views.
    index: usize,
    pose: Isometry3<f64>,
    corners: Vec<Corner>,
}

#[derive(Clone)]
struct Adjustment {
    camera: Intrinsics,
    views: Vec<View>,
    free: Free,
}

/// Normal equations of one view.
struct Block {
    pose: Matrix6<f64>,
    cross: Cross,
    gradient: Vector6<f64>,
}

struct Normals {
    shared: SharedNormal,
    gradient: Shared,
    blocks: Vec<Block>,
    cost: f64,
}

impl Adjustment {
    fn new(views: &[Vec<ImageCorner>], target: &TargetModel, camera: Intrinsics) -> Option<Self> {
        let one = |(index, corners): (usize, &Vec<ImageCorner>)| {
            let poses = target_poses(corners, &[], target, &camera).ok()?;
            let corner = |c: &ImageCorner| {
                let variance = 0.5 * c.covariance.trace();
                let in_target = target.corner(c.id)?.vector();
                Some(Corner { id: c.id, in_target, pixel: c.pixel, variance, weight: 1.0 })
            };
            let pose = *poses.first()?.pose.camera_from_target.iso();
            let corners: Vec<Corner> = corners.iter().filter_map(corner).collect();
            (corners.len() >= FEWEST_CORNERS).then_some(View { index, pose, corners })
        };
        let views: Vec<View> = views.iter().enumerate().filter_map(one).collect();
        (views.len() >= FEWEST_VIEWS).then_some(Self { camera, views, free: Free::PINHOLE })
    }

    /// Minimises, with weights that follow the residuals.
    fn settle(&mut self) -> Option<()> {
        for _ in 0..ROUNDS {
            self.reweight(|d| (HUBER / d).min(1.0));
            self.minimise()?;
        }
        Some(())
    }

    /// Leaves outliers out for good, and minimises without Huber's function.
    fn trim(&mut self) -> Option<()> {
        for _ in 0..2 {
            self.reweight(|d| if d < FARTHEST { 1.0 } else { 0.0 });
            self.views.retain(|view| {
                2 * view.corners.iter().filter(|c| c.weight > 0.0).count() > view.corners.len()
            });
            if self.views.len() < FEWEST_VIEWS {
                return None;
            }
            self.minimise()?;
        }
        Some(())
    }

    fn reweight(&mut self, weight: impl Fn(f64) -> f64) {
        let excess = self.excess();
        let camera = self.camera;
        for view in &mut self.views {
            for corner in &mut view.corners {
                let variance = corner.variance + excess;
                let d2 = residual(&camera, &view.pose, corner).map(|r| r.norm_squared() / variance);
                let d = d2.map_or(f64::INFINITY, f64::sqrt).max(1e-9);
                corner.weight = weight(d) / variance;
            }
        }
    }

    /// What the model leaves beyond the corners' variances, px² per axis, by the median.
    fn excess(&self) -> f64 {
        let residuals = median(self.squares(|_| true)) / CHI2_2_MEDIAN;
        let own = median(self.views.iter().flat_map(|v| v.corners.iter().map(|c| c.variance)));
        (residuals - own).max(0.0)
    }

    /// Squared residuals (px²) of the chosen corners.
    fn squares(&self, chosen: impl Fn(&Corner) -> bool) -> Vec<f64> {
        let of_view = |view: &View| -> Vec<f64> {
            let corners = view.corners.iter().filter(|c| chosen(c));
            corners
                .map(|c| residual(&self.camera, &view.pose, c).map_or(1e9, |r| r.norm_squared()))
                .collect()
        };
        self.views.iter().flat_map(of_view).collect()
    }

    fn rms(&self) -> f64 {
        root_mean(&self.squares(|c| c.weight > 0.0))
    }

    /// Schwarz's criterion on the best 95 % of the residuals.
    fn price(&self) -> f64 {
        let mut squares = self.squares(|_| true);
        squares.sort_by(f64::total_cmp);
        let n = squares.len() as f64;
        squares.truncate((0.95 * n).ceil() as usize);
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        n * mean.max(1e-18).ln() + PRICE * self.free.parameters().len() as f64 * n.ln()
    }

    /// The distortion does not fold over where the corners are.
    fn is_sound(&self) -> bool {
        let mut corners = self.views.iter().flat_map(|v| &v.corners);
        self.camera.check().is_ok() && corners.all(|c| self.camera.undistort(&c.pixel).is_some())
    }

    fn minimise(&mut self) -> Option<()> {
        let mut normals = self.normals();
        let mut damping = 1e-4;
        for _ in 0..MOST_STEPS {
            let Some(next) = self.step(&normals, damping) else {
                damping *= 10.0;
                if damping > 1e8 {
                    return None;
                }
                continue;
            };
            let after = next.normals();
            if after.cost <= normals.cost {
                let fallen = normals.cost - after.cost;
                let done = fallen <= CONVERGED * normals.cost;
                (*self, normals) = (next, after);
                damping = (damping * 0.1f64).max(1e-12);
                if done {
                    break;
                }
            } else {
                damping *= 10.0;
                if damping > 1e8 {
                    break;
                }
            }
        }
        normals.cost.is_finite().then_some(())
    }

    /// One damped step of all parameters.
    fn step(&self, normals: &Normals, damping: f64) -> Option<Self> {
        let grow = 1.0 + damping;
        let (mut reduced, mut right) = (normals.shared, -normals.gradient);
        (0..LENS_PARAMETERS).for_each(|k| reduced[(k, k)] *= grow);
        let mut inverses = Vec::with_capacity(normals.blocks.len());
        for block in &normals.blocks {
            let mut pose = block.pose;
            (0..6).for_each(|k| pose[(k, k)] *= grow);
            let inverse = pose.cholesky()?.inverse();
            let carried = block.cross * inverse;
            reduced -= carried * block.cross.transpose();
            right += carried * block.gradient;
            inverses.push(inverse);
        }
        self.fix(&mut reduced, &mut right);
        let shared = reduced.cholesky()?.solve(&right);
        let mut next = self.clone();
        next.camera = self.camera.moved_lens(&shared);
        for ((view, block), inverse) in next.views.iter_mut().zip(&normals.blocks).zip(inverses) {
            let delta = -inverse * (block.gradient + block.cross.transpose() * shared);
            view.pose *= lie::exp(&delta);
        }
        Some(next)
    }

    /// Takes the parameters that are not fitted out of the equations.
    fn fix(&self, normal: &mut SharedNormal, right: &mut Shared) {
        let free = self.free.parameters();
        for k in (0..LENS_PARAMETERS).filter(|k| !free.contains(k)) {
            normal.row_mut(k).fill(0.0);
            normal.column_mut(k).fill(0.0);
            normal[(k, k)] = 1.0;
            right[k] = 0.0;
        }
    }

    fn normals(&self) -> Normals {
        let mut all = Normals {
            shared: SharedNormal::zeros(),
            gradient: Shared::zeros(),
            blocks: Vec::with_capacity(self.views.len()),
            cost: 0.0,
        };
        for view in &self.views {
            let mut block =
                Block { pose: Matrix6::zeros(), cross: Cross::zeros(), gradient: Vector6::zeros() };
            for corner in view.corners.iter().filter(|c| c.weight > 0.0) {
                let Some((r, by_shared, by_pose)) = linearised(&self.camera, &view.pose, corner)
                else {
                    all.cost = f64::INFINITY;
                    continue;
                };
                let w = corner.weight;
                all.shared += by_shared.transpose() * by_shared * w;
                all.gradient += by_shared.transpose() * r * w;
                all.cost += w * r.norm_squared();
                block.pose += by_pose.transpose() * by_pose * w;
                block.cross += by_shared.transpose() * by_pose * w;
                block.gradient += by_pose.transpose() * r * w;
            }
            all.blocks.push(block);
        }
        all
    }

    /// Covariance of the fitted parameters: the inverse Schur complement, widened if the residuals
    /// are larger than the weights say.
    fn covariance(&self) -> Option<DMatrix<f64>> {
        let normals = self.normals();
        let mut reduced = normals.shared;
        for block in &normals.blocks {
            reduced -= block.cross * block.pose.cholesky()?.inverse() * block.cross.transpose();
        }
        self.fix(&mut reduced, &mut Shared::zeros());
        let inverse = reduced.cholesky()?.inverse();
        let used = self.squares(|c| c.weight > 0.0).len() as f64;
        let free = self.free.parameters();
        let freedom = 2.0 * used - (free.len() + 6 * self.views.len()) as f64;
        let scale = (normals.cost / freedom.max(1.0)).max(1.0);
        let at = |i: usize, j: usize| inverse[(free[i], free[j])] * scale;
        let covariance = DMatrix::from_fn(free.len(), free.len(), at);
        covariance.iter().all(|x| x.is_finite()).then_some(covariance)
    }

    fn finish(self, given: &[Vec<ImageCorner>]) -> Result<CameraCalibration, Error> {
        let covariance = self.covariance().ok_or_else(undetermined)?;
        let unsure = (covariance[(0, 0)].sqrt() / self.camera.fx)
            .max(covariance[(1, 1)].sqrt() / self.camera.fy);
        if unsure.is_nan() || unsure >= FOCAL_UNSURE {
            return Err(undetermined());
        }
        let mut views: Vec<ViewFit> = given
            .iter()
            .map(|v| ViewFit {
                camera_from_target: None,
                rms_px: f64::NAN,
                left_out: v.iter().map(|c| c.id).collect(),
            })
            .collect();
        for view in &self.views {
            views[view.index] = self.view_fit(view);
        }
        let warnings = warnings(&views);
        Ok(CameraCalibration {
            intrinsics: self.plain_camera(),
            parameters: self.names(),
            covariance,
            rms_px: self.rms(),
            views,
            warnings,
        })
    }

    fn view_fit(&self, view: &View) -> ViewFit {
        let used = view.corners.iter().filter(|c| c.weight > 0.0);
        let squares: Vec<f64> = used
            .filter_map(|c| residual(&self.camera, &view.pose, c))
            .map(|r| r.norm_squared())
            .collect();
        ViewFit {
            camera_from_target: Some(Pose::claim(view.pose)),
            rms_px: root_mean(&squares),
            left_out: view.corners.iter().filter(|c| c.weight <= 0.0).map(|c| c.id).collect(),
        }
    }

    fn names(&self) -> Vec<&'static str> {
        let fisheye = ["fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4"];
        let free = self.free.parameters();
        match self.camera.distortion {
            Distortion::KannalaBrandt(_) => free.iter().map(|k| fisheye[*k]).collect(),
            _ => free.iter().map(|k| NAMES[*k]).collect(),
        }
    }

    fn plain_camera(&self) -> Intrinsics {
        let pinhole = self.free == Free::PINHOLE
            && matches!(self.camera.distortion, Distortion::BrownConrady(_));
        let distortion = if pinhole { Distortion::None } else { self.camera.distortion };
        Intrinsics { distortion, ..self.camera }
    }
}

fn warnings(views: &[ViewFit]) -> Vec<Warning> {
    let typical = median(views.iter().map(|v| v.rms_px).filter(|r| r.is_finite()));
    let one = |(index, view): (usize, &ViewFit)| {
        let number = index + 1;
        if view.camera_from_target.is_none() {
            let text = format!("view {number} does not fit the others and was left out");
            return Some(Warning::new("view-left-out", text));
        }
        (view.rms_px > CONSPICUOUS * typical).then(|| {
            let text = format!(
                "view {number} has {:.2} px rms, the others {typical:.2} px: is it blurred?",
                view.rms_px
            );
            Warning::new("view-conspicuous", text)
        })
    };
    views.iter().enumerate().filter_map(one).collect()
}

fn residual(camera: &Intrinsics, pose: &Isometry3<f64>, corner: &Corner) -> Option<Vector2<f64>> {
    let point = pose * nalgebra::Point3::from(corner.in_target);
    Some(camera.project(&point.coords)? - corner.pixel)
}

type Linearised = (Vector2<f64>, SMatrix<f64, 2, LENS_PARAMETERS>, SMatrix<f64, 2, 6>);

/// Residual and its derivatives by the camera's parameters and by `δ` of `T exp(δ)`.
fn linearised(camera: &Intrinsics, pose: &Isometry3<f64>, corner: &Corner) -> Option<Linearised> {
    let r = pose.rotation.to_rotation_matrix().into_inner();
    let point = r * corner.in_target + pose.translation.vector;
    let (pixel, by_point) = camera.project_with_jacobian(&point)?;
    let mut by_pose = SMatrix::<f64, 2, 6>::zeros();
    let turned = by_point * r;
    by_pose.fixed_view_mut::<2, 3>(0, 0).copy_from(&(-turned * hat(&corner.in_target)));
    by_pose.fixed_view_mut::<2, 3>(0, 3).copy_from(&turned);
    Some((pixel - corner.pixel, camera.by_lens(&point), by_pose))
}

fn root_mean(squares: &[f64]) -> f64 {
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulate::Random;
    use nalgebra::Matrix2;

    const BROWN: [f64; 12] = [-0.28, 0.11, 6e-4, -4e-4, -0.02, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    const RATIONAL: [f64; 12] = [0.9, -0.2, 6e-4, -4e-4, 0.05, 1.1, 0.3, -0.1, 0.0, 0.0, 0.0, 0.0];
    const PRISM: [f64; 12] =
        [0.9, -0.2, 6e-4, -4e-4, 0.05, 1.1, 0.3, -0.1, 8e-3, -2e-3, -6e-3, 1e-3];

    fn board() -> TargetModel {
        TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 }
    }

    fn camera(k: [f64; 12]) -> Intrinsics {
        let pinhole = Intrinsics::pinhole(1280, 960, 1050.0, 1047.0, 652.0, 467.0);
        Intrinsics { distortion: Distortion::BrownConrady(k), ..pinhole }
    }

    /// The board all over the picture, tilted by up to `tilt` rad.
    fn views(
        n: usize,
        camera: &Intrinsics,
        tilt: f64,
        sigma: f64,
        seed: u64,
    ) -> Vec<Vec<ImageCorner>> {
        let mut random = Random::new(seed);
        let mut view = || loop {
            let z = random.between(0.35, 0.6);
            let at =
                Vector3::new(random.between(-0.35, 0.2) * z, random.between(-0.3, 0.15) * z, z);
            let turn = Vector3::from_fn(|_, _| random.between(-tilt, tilt));
            let turn = lie::tangent(&turn, &Vector3::zeros());
            let pose = Pose::<Camera, Target>::from_parts(&Matrix3::identity(), at).retract(&turn);
            let mut one = |(id, p): (usize, crate::Point<Target>)| {
                let pixel = camera.project(&(pose * p).vector())?;
                let inside = (0.0..1279.0).contains(&pixel.x) && (0.0..959.0).contains(&pixel.y);
                let noise = Vector2::new(random.normal(), random.normal()) * sigma;
                let covariance = Matrix2::identity() * sigma.max(1e-4).powi(2);
                inside.then(|| ImageCorner { id: id as u32, pixel: pixel + noise, covariance })
            };
            let all: Vec<_> =
                board().corners().into_iter().enumerate().filter_map(&mut one).collect();
            if all.len() == 54 {
                return all;
            }
        };
        (0..n).map(|_| view()).collect()
    }

    #[test]
    fn exact_corners_give_the_exact_camera() {
        let truth = camera(BROWN);
        let found =
            calibrate(&views(12, &truth, 0.6, 0.0, 1), &board(), 1280, 960, LensModel::default())
                .unwrap();
        assert_eq!(found.parameters.len(), 9);
        let c = found.intrinsics;
        assert!((c.fx - truth.fx).abs() < 1e-5 && (c.cy - truth.cy).abs() < 1e-5, "{c:?}");
        assert!((c.coefficients()[4] - BROWN[4]).abs() < 1e-5, "{c:?}");
    }

    #[test]
    fn errors_stay_inside_the_covariance() {
        let truth = camera(BROWN);
        let wanted = [
            truth.fx, truth.fy, truth.cx, truth.cy, BROWN[0], BROWN[1], BROWN[2], BROWN[3],
            BROWN[4],
        ];
        let (mut sum, mut count) = (0.0, 0.0);
        for seed in 0..12 {
            let found = calibrate(
                &views(12, &truth, 0.6, 0.1, seed),
                &board(),
                1280,
                960,
                LensModel::default(),
            )
            .unwrap();
            let c = found.intrinsics;
            let mut got = vec![c.fx, c.fy, c.cx, c.cy];
            got.extend(&c.coefficients()[..5]);
            if found.parameters.len() < 9 {
                continue; // k3 was not worth its price: then the model is wrong by that much
            }
            let e = nalgebra::DVector::from_fn(9, |i, _| got[i] - wanted[i]);
            sum += e.dot(&found.covariance.cholesky().unwrap().solve(&e)) / 9.0;
            count += 1.0;
        }
        let ratio = sum / f64::max(count, 1.0);
        assert!(count == 0.0 || (0.5..1.7).contains(&ratio), "{ratio} of {count}");
    }

    #[test]
    fn a_lens_without_distortion_gets_none() {
        let truth = Intrinsics::pinhole(1280, 960, 1050.0, 1047.0, 652.0, 467.0);
        let found =
            calibrate(&views(10, &truth, 0.6, 0.1, 3), &board(), 1280, 960, LensModel::default())
                .unwrap();
        assert_eq!(found.intrinsics.distortion, Distortion::None);
        assert!((found.intrinsics.fx - 1050.0).abs() < 2.0);
    }

    #[test]
    fn parallel_views_leave_the_focal_length_open() {
        let parallel = views(8, &camera(BROWN), 0.0, 0.1, 4);
        let error = calibrate(&parallel, &board(), 1280, 960, LensModel::default()).unwrap_err();
        assert!(error.to_string().contains("focal length"), "{error}");
    }

    /// Root of the mean squared distance (px) between the images of one ray in two cameras, where the
    /// board was seen.
    fn apart(truth: &Intrinsics, found: &Intrinsics, views: &[Vec<ImageCorner>]) -> f64 {
        let off = |corner: &ImageCorner| {
            let ray = truth.ray(&corner.pixel).unwrap();
            (found.project(&ray).unwrap() - corner.pixel).norm_squared()
        };
        root_mean(&views.iter().flatten().map(off).collect::<Vec<_>>())
    }

    #[test]
    fn every_model_of_a_lens_is_found() {
        let fisheye = Distortion::KannalaBrandt([-0.03, 0.01, -4e-3, 1e-3]);
        let fisheye = Intrinsics { fx: 520.0, fy: 519.0, distortion: fisheye, ..camera(BROWN) };
        for (lens, truth, parameters) in [
            (LensModel::BrownConrady, camera(BROWN), 9),
            (LensModel::Rational, camera(RATIONAL), 12),
            (LensModel::ThinPrism, camera(PRISM), 16),
            (LensModel::KannalaBrandt, fisheye, 8),
        ] {
            let all = views(20, &truth, 0.6, 0.02, 7);
            let found = calibrate(&all, &board(), 1280, 960, lens).unwrap();
            let off = apart(&truth, &found.intrinsics, &all);
            assert!(off < 0.3 && found.rms_px < 0.03, "{lens:?}: {off} {}", found.rms_px);
            assert!(found.parameters.len() <= parameters, "{:?}", found.parameters);
            assert!(found.covariance.clone().cholesky().is_some(), "{lens:?}");
        }
        let all = views(20, &fisheye, 0.6, 0.02, 7);
        let wrong = calibrate(&all, &board(), 1280, 960, LensModel::BrownConrady);
        assert!(!wrong.is_ok_and(|c| c.rms_px < 0.03), "a fisheye is not of Brown's model");
    }

    #[test]
    fn a_wrong_camera_is_told_from_a_right_one() {
        let truth = camera(BROWN);
        let mut chances = vec![];
        for seed in 0..12 {
            let all = views(12, &truth, 0.6, 0.1, seed);
            let right = cross_check(&all, &board(), &truth).unwrap();
            chances.push(right.chance);
            let given = Intrinsics { fx: truth.fx + 12.0, ..truth };
            let wrong = cross_check(&all, &board(), &given).unwrap();
            assert!(wrong.chance < 1e-6, "{}", wrong.chance);
            assert!(wrong.rms_given_px > 1.05 * wrong.found.rms_px);
        }
        // chances of a right camera are even
        let mean = chances.iter().sum::<f64>() / 12.0;
        assert!((0.2..0.8).contains(&mean) && chances.iter().all(|c| *c > 1e-3), "{chances:?}");
    }

    #[test]
    fn two_views_are_too_few() {
        let error = calibrate(
            &views(2, &camera(BROWN), 0.6, 0.1, 5),
            &board(),
            1280,
            960,
            LensModel::default(),
        );
        assert!(matches!(error, Err(Error::TooFewPoses { found: 2, needed: 3, .. })));
    }

    #[test]
    fn bad_corners_and_a_bad_view_are_left_out() {
        let truth = camera(BROWN);
        let mut all = views(12, &truth, 0.6, 0.1, 6);
        all[2][10].pixel.x += 8.0;
        all[4].iter_mut().for_each(|c| c.pixel.x += 30.0 * (0.7 * f64::from(c.id)).sin());
        let found = calibrate(&all, &board(), 1280, 960, LensModel::default()).unwrap();
        assert_eq!(found.views[2].left_out, vec![10]);
        assert!(found.views[4].camera_from_target.is_none());
        assert!((found.intrinsics.fx - truth.fx).abs() < 3.0, "{:?}", found.intrinsics);
    }

    #[test]
    fn jacobians_match_central_differences() {
        let camera = camera(BROWN);
        let pose = lie::exp(&Vector6::new(0.2, -0.3, 0.1, -0.1, 0.05, 0.5));
        let in_target = Vector3::new(0.12, 0.09, 0.0);
        let corner =
            Corner { id: 0, in_target, pixel: Vector2::zeros(), variance: 1.0, weight: 1.0 };
        let (_, by_shared, by_pose) = linearised(&camera, &pose, &corner).unwrap();
        for k in 0..LENS_PARAMETERS {
            let mut d = Shared::zeros();
            d[k] = 1e-5;
            let at = |d: Shared| residual(&camera.moved_lens(&d), &pose, &corner).unwrap();
            assert!(((at(d) - at(-d)) / 2e-5 - by_shared.column(k)).norm() < 1e-4, "{k}");
        }
        let fisheye = Distortion::KannalaBrandt([-0.03, 0.01, -4e-3, 1e-3]);
        let fisheye = Intrinsics { distortion: fisheye, ..camera };
        let (_, by_shared, _) = linearised(&fisheye, &pose, &corner).unwrap();
        for k in 0..8 {
            let mut d = Shared::zeros();
            d[k] = 1e-5;
            let at = |d: Shared| residual(&fisheye.moved_lens(&d), &pose, &corner).unwrap();
            assert!(((at(d) - at(-d)) / 2e-5 - by_shared.column(k)).norm() < 1e-4, "{k}");
        }
        for k in 0..6 {
            let mut d = Vector6::zeros();
            d[k] = 1e-6;
            let at = |d: Vector6<f64>| residual(&camera, &(pose * lie::exp(&d)), &corner).unwrap();
            assert!(((at(d) - at(-d)) / 2e-6 - by_pose.column(k)).norm() < 1e-3, "{k}");
        }
    }
}
