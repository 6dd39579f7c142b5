//! Corners of another program that count pixels from elsewhere than the camera's parameters do.
//!
//! With (0, 0) at the corner of the first pixel instead of its centre, all corners lie half a pixel
//! too far right and down: to the camera, its principal point has moved. Each view has its own pose,
//! which takes up nearly all of that; what is left shows in perspective and distortion:
//!
//! ```text
//! min Σᵢⱼ wᵢⱼ |π(k + c, Tᵢ pⱼ) - uᵢⱼ|² + Σₗ (cₗ/σₗ)²,      s = (c_cx, c_cy)
//! ```
//!
//! over poses `Tᵢ` and deviations `c` of the camera's parameters from the given `k`: focal lengths
//! and distortion may be a little off, the principal point by anything. The covariance of `s` is the
//! larger of that of the corners' noise and of that which the views' contradictions show (the
//! "sandwich", with views as clusters).
//!
//! Three explanations of `s` compete: nothing is wrong, `s ~ N(0, Σ)`; half a pixel,
//! `s ~ N(±½, Σ)`; the given principal point is off, `s ~ N(0, Σ + τ² I)`.
//!
//! B. Triggs et al., *Bundle adjustment: a modern synthesis*, 2000; K.-Y. Liang and S. Zeger,
//! *Longitudinal data analysis using generalized linear models*, 1986.

use nalgebra::{Isometry3, Matrix2, Matrix6, SMatrix, SVector, Vector2, Vector3, Vector6};

use crate::{
    Distortion, ImageCorner, Intrinsics, TargetModel,
    detect::{planar_pose::moved, target_poses},
    math::{lie, linalg::median},
    model::camera::LENS_PARAMETERS,
};

/// How far all corners lie from where the given camera has them.
#[derive(Debug, Clone, Copy)]
pub struct Shift {
    /// px; right and down.
    pub shift: Vector2<f64>,
    /// Its covariance, px².
    pub covariance: Matrix2<f64>,
    /// Views that tell it.
    pub views: usize,
}

/// Fewer views do not tell how much they contradict each other.
const FEWEST_VIEWS: usize = 5;
/// A pose takes six numbers of a view's corners.
const FEWEST_CORNERS: usize = 6;
/// Given focal lengths may be off by this share.
const FOCAL_SIGMA: f64 = 0.01;
/// The given principal point by anything, px.
const CENTRE_SIGMA: f64 = 100.0;
/// The radial coefficients of a lens, for r² and r⁴.
const RADIAL_SIGMA: (f64, f64) = (0.01, 0.03);
/// The tangential ones.
const TANGENTIAL_SIGMA: f64 = 1e-4;
/// All others are as given.
const AS_GIVEN: f64 = 1e-9;
/// Steps; the problem is nearly linear.
const STEPS: usize = 4;
/// Huber's bound, standard deviations.
const HUBER: f64 = 1.5;
/// Half of all squared lengths of a 2-vector of unit normal deviates are below this.
const CHI2_2_MEDIAN: f64 = 1.386_294_361;
/// Corners are not more exact than this, px.
const EXACT_PX: f64 = 1e-3;

/// Half a pixel must be likelier than none by this difference of χ²: five standard deviations.
const CLEARLY: f64 = 25.0;
/// It must not be farther off than this χ² of two degrees: three standard deviations.
const CONSISTENT: f64 = 11.8;
/// How far given principal points are off otherwise, px.
const CENTRE_ERROR: f64 = 1.0;
/// Half a pixel must be likelier than that by this factor.
const LIKELIER: f64 = 10.0;

impl Shift {
    /// The half pixel that explains the shift clearly better than any other cause: 0.5 or -0.5 px in
    /// both x and y.
    pub fn half_pixel(&self) -> Option<f64> {
        [0.5, -0.5].into_iter().find(|offset| self.is(*offset) == Some(true))
    }

    fn is(&self, offset: f64) -> Option<bool> {
        let wide = self.covariance + Matrix2::identity() * CENTRE_ERROR.powi(2);
        let (narrow, wide) = (self.covariance.cholesky()?, wide.cholesky()?);
        let off = self.shift.add_scalar(-offset);
        let from_half = off.dot(&narrow.solve(&off));
        let from_none = self.shift.dot(&narrow.solve(&self.shift));
        let from_any = self.shift.dot(&wide.solve(&self.shift));
        let spreads = (wide.determinant() / narrow.determinant()).ln();
        let over_any = 0.5 * (from_any - from_half + spreads);
        let clearly = from_none - from_half > CLEARLY && over_any > LIKELIER.ln();
        Some(clearly && from_half < CONSISTENT)
    }
}

/// The shift that the views show against `given`; `None` where there are too few of them.
pub fn shift(
    views: &[Vec<ImageCorner>],
    target: &TargetModel,
    given: &Intrinsics,
) -> Option<Shift> {
    let views: Vec<View> = views.iter().filter_map(|v| View::new(v, target, given)).collect();
    if views.len() < FEWEST_VIEWS {
        return None;
    }
    let mut fit = Fit { camera: *given, views };
    let prior = prior(given);
    for _ in 0..STEPS {
        fit.step(&prior, given)?;
    }
    let covariance = fit.covariance(&prior)?;
    let shift = Vector2::new(fit.camera.cx - given.cx, fit.camera.cy - given.cy);
    let finite = shift.iter().chain(covariance.iter()).all(|x| x.is_finite());
    finite.then_some(Shift { shift, covariance, views: fit.views.len() })
}

type Shared = SVector<f64, LENS_PARAMETERS>;
type SharedNormal = SMatrix<f64, LENS_PARAMETERS, LENS_PARAMETERS>;
type Cross = SMatrix<f64, LENS_PARAMETERS, 6>;

/// Precision of what is known of the given parameters, in the order of [`Intrinsics::by_lens`].
fn prior(given: &Intrinsics) -> Shared {
    let mut sigmas = Shared::repeat(AS_GIVEN);
    (sigmas[0], sigmas[1]) = (FOCAL_SIGMA * given.fx, FOCAL_SIGMA * given.fy);
    (sigmas[2], sigmas[3]) = (CENTRE_SIGMA, CENTRE_SIGMA);
    (sigmas[4], sigmas[5]) = RADIAL_SIGMA;
    if !matches!(given.distortion, Distortion::KannalaBrandt(_)) {
        (sigmas[6], sigmas[7]) = (TANGENTIAL_SIGMA, TANGENTIAL_SIGMA);
    }
    sigmas.map(|sigma| sigma.powi(-2))
}

struct View {
    pose: Isometry3<f64>,
    /// Places on the target, and pixels.
    corners: Vec<(Vector3<f64>, Vector2<f64>)>,
}

impl View {
    fn new(corners: &[ImageCorner], target: &TargetModel, camera: &Intrinsics) -> Option<Self> {
        let posed = target_poses(corners, &[], target, camera).ok()?;
        let pose = *posed.first()?.pose.camera_from_target.iso();
        let place = |c: &ImageCorner| Some((target.corner(c.id)?.vector(), c.pixel));
        let corners: Vec<_> = corners.iter().filter_map(place).collect();
        (corners.len() >= FEWEST_CORNERS).then_some(Self { pose, corners })
    }

    fn residuals(&self, camera: &Intrinsics) -> impl Iterator<Item = Vector2<f64>> {
        self.corners.iter().filter_map(|(in_target, pixel)| {
            let point = self.pose * nalgebra::Point3::from(*in_target);
            Some(camera.project(&point.coords)? - pixel)
        })
    }
}

/// Normal equations of one view.
struct Block {
    shared: SharedNormal,
    by_shared: Shared,
    pose: Matrix6<f64>,
    by_pose: Vector6<f64>,
    cross: Cross,
}

impl Block {
    /// What is left for the camera when the pose is free: information and gradient.
    fn reduced(&self) -> Option<(SharedNormal, Shared)> {
        let carried = self.cross * self.pose.cholesky()?.inverse();
        let information = self.shared - carried * self.cross.transpose();
        Some((information, self.by_shared - carried * self.by_pose))
    }
}

struct Fit {
    camera: Intrinsics,
    views: Vec<View>,
}

impl Fit {
    /// One step of Gauss and Newton.
    fn step(&mut self, prior: &Shared, given: &Intrinsics) -> Option<()> {
        let blocks = self.blocks()?;
        let mut normal = SharedNormal::from_diagonal(prior);
        let mut gradient = prior.component_mul(&(self.camera.values() - given.values()));
        for block in &blocks {
            let (information, own) = block.reduced()?;
            normal += information;
            gradient += own;
        }
        let step = -normal.cholesky()?.solve(&gradient);
        for (view, block) in self.views.iter_mut().zip(&blocks) {
            let right = block.by_pose + block.cross.transpose() * step;
            view.pose *= lie::exp(&-block.pose.cholesky()?.solve(&right));
        }
        self.camera = self.camera.moved_lens(&step);
        Some(())
    }

    fn blocks(&self) -> Option<Vec<Block>> {
        let sigma = self.noise();
        self.views.iter().map(|view| self.block(view, sigma)).collect()
    }

    /// Standard deviation of a corner per axis, px, as the residuals show it.
    fn noise(&self) -> f64 {
        let squares = self.views.iter().flat_map(|v| v.residuals(&self.camera));
        let squares: Vec<f64> = squares.map(|r| r.norm_squared()).collect();
        let numbers = 2.0 * squares.len() as f64;
        let free = (numbers - 6.0 * self.views.len() as f64).max(1.0);
        (median(squares) / CHI2_2_MEDIAN * numbers / free).sqrt().max(EXACT_PX)
    }

    fn block(&self, view: &View, sigma: f64) -> Option<Block> {
        let mut block = Block {
            shared: SharedNormal::zeros(),
            by_shared: Shared::zeros(),
            pose: Matrix6::zeros(),
            by_pose: Vector6::zeros(),
            cross: Cross::zeros(),
        };
        for (in_target, pixel) in &view.corners {
            let (point, by_pose) = moved(&view.pose, in_target);
            let (seen, by_point) = self.camera.project_with_jacobian(&point)?;
            let (r, by_pose) = (seen - pixel, by_point * by_pose);
            let by_shared = self.camera.by_lens(&point);
            let huber = (HUBER * sigma / r.norm().max(f64::MIN_POSITIVE)).min(1.0);
            let w = huber / (sigma * sigma);
            block.shared += by_shared.transpose() * by_shared * w;
            block.by_shared += by_shared.transpose() * r * w;
            block.pose += by_pose.transpose() * by_pose * w;
            block.by_pose += by_pose.transpose() * r * w;
            block.cross += by_shared.transpose() * by_pose * w;
        }
        Some(block)
    }

    /// Of the principal point: that of the corners' noise, widened where the views contradict each
    /// other by more.
    fn covariance(&self, prior: &Shared) -> Option<Matrix2<f64>> {
        let reduced: Option<Vec<_>> = self.blocks()?.iter().map(Block::reduced).collect();
        let reduced = reduced?;
        let normal = reduced.iter().fold(SharedNormal::from_diagonal(prior), |sum, r| sum + r.0);
        let inverse = normal.cholesky()?.inverse();
        let of_noise = inverse.fixed_view::<2, 2>(2, 2).into_owned();
        let pull = |own: &Shared| (inverse * own).fixed_rows::<2>(2).into_owned();
        let pulls = reduced.iter().map(|(_, own)| pull(own));
        let count = reduced.len() as f64;
        let of_views =
            pulls.map(|p| p * p.transpose()).sum::<Matrix2<f64>>() * count / (count - 1.0);
        let ratio = 0.5 * (of_noise.cholesky()?.solve(&of_views)).trace();
        Some(of_noise * ratio.max(1.0))
    }
}

#[cfg(test)]
mod tests;
