//! All views' poses and the camera's parameters, adjusted together: normal equations in the shape
//! of an arrow, from which each pose is eliminated.

use nalgebra::{DMatrix, Isometry3, Matrix6, SMatrix, SVector, Vector2, Vector3, Vector6};

use super::{
    CameraCalibration, FEWEST_CORNERS, FEWEST_VIEWS, PRICE, ViewFit,
    lens_model::{Free, NAMES},
    undetermined,
};
use crate::{
    Distortion, Error, ImageCorner, Intrinsics, Pose, TargetModel, Warning,
    detect::target_poses,
    math::{
        lie::{self, hat},
        linalg::{median, root_mean},
        optimize::{self, Damping, Problem, Rules, Singular, Stop, Tried},
    },
    model::camera::LENS_PARAMETERS,
};

/// A focal length less sure than this share of it is not determined by the views.
const FOCAL_UNSURE: f64 = 0.05;
/// Residuals beyond this many standard deviations are outliers.
const FARTHEST: f64 = 5.0;
/// Huber's bound, standard deviations.
const HUBER: f64 = 1.5;
/// Rounds of re-weighting.
const ROUNDS: usize = 3;
/// Of one adjustment with weights held still.
const RULES: Rules = Rules {
    most_steps: 60,
    damping: Damping { least: 1e-12, most: 1e7, ..Damping::from(1e-4) },
    slack: 0.0,
    singular: Singular::IsDamped,
};
/// The adjustment ends when the cost falls by less than this share.
const CONVERGED: f64 = 1e-10;
/// Half of all squared lengths of a 2-vector of unit normal deviates are below this.
const CHI2_2_MEDIAN: f64 = 1.386_294_361;
/// An image whose rms exceeds this multiple of the others' median is worth a warning.
const CONSPICUOUS: f64 = 3.0;

pub(super) type Shared = SVector<f64, LENS_PARAMETERS>;
type SharedNormal = SMatrix<f64, LENS_PARAMETERS, LENS_PARAMETERS>;
type Cross = SMatrix<f64, LENS_PARAMETERS, 6>;

#[derive(Clone)]
pub(super) struct Corner {
    pub id: u32,
    pub in_target: Vector3<f64>,
    pub pixel: Vector2<f64>,
    /// Variance per axis, px².
    pub variance: f64,
    pub weight: f64,
}

impl Corner {
    /// A corner that is here on the target.
    pub fn of(c: &ImageCorner, in_target: Vector3<f64>) -> Self {
        let variance = 0.5 * c.covariance.trace();
        Self { id: c.id, in_target, pixel: c.pixel, variance, weight: 1.0 }
    }
}

#[derive(Clone)]
pub(super) struct View {
    /// Its place among the given views.
    index: usize,
    pose: Isometry3<f64>,
    corners: Vec<Corner>,
}

#[derive(Clone)]
pub(super) struct Adjustment {
    pub camera: Intrinsics,
    pub views: Vec<View>,
    pub free: Free,
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

/// A change of all parameters.
struct Step {
    shared: Shared,
    poses: Vec<Vector6<f64>>,
}

/// The least squares of an adjustment, weights held still.
struct Arrow;

impl Problem for Arrow {
    type Point = Adjustment;
    type Equations = Normals;
    type Step = Step;

    fn equations(&self, at: &Adjustment) -> Option<Normals> {
        Some(at.normals())
    }

    fn cost(&self, here: &Normals) -> f64 {
        here.cost
    }

    fn step(&self, at: &Adjustment, here: &Normals, damping: f64) -> Option<Step> {
        at.step(here, damping)
    }

    fn moved(&self, at: &Adjustment, step: &Step) -> Adjustment {
        at.moved(step)
    }

    fn is_last(&self, tried: &Tried<Step>) -> bool {
        tried.is_taken && tried.before - tried.after <= CONVERGED * tried.before
    }
}

impl Adjustment {
    pub fn new(
        views: &[Vec<ImageCorner>],
        target: &TargetModel,
        camera: Intrinsics,
    ) -> Option<Self> {
        let one = |(index, corners): (usize, &Vec<ImageCorner>)| {
            let poses = target_poses(corners, &[], target, &camera).ok()?;
            let corner = |c: &ImageCorner| Some(Corner::of(c, target.corner(c.id)?.vector()));
            let pose = *poses.first()?.pose.camera_from_target.iso();
            let corners: Vec<Corner> = corners.iter().filter_map(corner).collect();
            (corners.len() >= FEWEST_CORNERS).then_some(View { index, pose, corners })
        };
        let views: Vec<View> = views.iter().enumerate().filter_map(one).collect();
        (views.len() >= FEWEST_VIEWS).then_some(Self { camera, views, free: Free::PINHOLE })
    }

    /// Minimises, with weights that follow the residuals.
    pub fn settle(&mut self) -> Option<()> {
        for _ in 0..ROUNDS {
            self.reweight(|d| (HUBER / d).min(1.0));
            self.minimise()?;
        }
        Some(())
    }

    /// Leaves outliers out for good, and minimises without Huber's function.
    pub fn trim(&mut self) -> Option<()> {
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

    pub fn rms(&self) -> f64 {
        root_mean(self.squares(|c| c.weight > 0.0)).unwrap_or(0.0)
    }

    /// Schwarz's criterion on the best 95 % of the residuals.
    pub(crate) fn price(&self) -> f64 {
        let mut squares = self.squares(|_| true);
        squares.sort_by(f64::total_cmp);
        let n = squares.len() as f64;
        squares.truncate((0.95 * n).ceil() as usize);
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        n * mean.max(1e-18).ln() + PRICE * self.free.parameters().len() as f64 * n.ln()
    }

    /// The distortion does not fold over where the corners are.
    pub(crate) fn is_sound(&self) -> bool {
        let mut corners = self.views.iter().flat_map(|v| &v.corners);
        self.camera.check().is_ok() && corners.all(|c| self.camera.undistort(&c.pixel).is_some())
    }

    fn minimise(&mut self) -> Option<()> {
        let here = self.normals();
        let end = optimize::descend(&Arrow, self, here, &RULES);
        (end.stop != Stop::Singular && end.there.cost.is_finite()).then_some(())
    }

    /// A damped step of the shared parameters, and one of each pose.
    fn step(&self, normals: &Normals, damping: f64) -> Option<Step> {
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
        let of_pose = |(block, inverse): (&Block, Matrix6<f64>)| {
            -inverse * (block.gradient + block.cross.transpose() * shared)
        };
        let poses = normals.blocks.iter().zip(inverses).map(of_pose).collect();
        Some(Step { shared, poses })
    }

    fn moved(&self, step: &Step) -> Self {
        let mut next = self.clone();
        next.camera = self.camera.moved_lens(&step.shared);
        for (view, delta) in next.views.iter_mut().zip(&step.poses) {
            view.pose *= lie::exp(delta);
        }
        next
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

    pub fn finish(self, given: &[Vec<ImageCorner>]) -> Result<CameraCalibration, Error> {
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
        let squares =
            used.filter_map(|c| residual(&self.camera, &view.pose, c)).map(|r| r.norm_squared());
        ViewFit {
            camera_from_target: Some(Pose::claim(view.pose)),
            rms_px: root_mean(squares).unwrap_or(0.0),
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
            let text = format!("view {number} does not fit the others and was rejected");
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

pub(super) fn residual(
    camera: &Intrinsics,
    pose: &Isometry3<f64>,
    corner: &Corner,
) -> Option<Vector2<f64>> {
    let point = pose * nalgebra::Point3::from(corner.in_target);
    Some(camera.project(&point.coords)? - corner.pixel)
}

pub(super) type Linearised = (Vector2<f64>, SMatrix<f64, 2, LENS_PARAMETERS>, SMatrix<f64, 2, 6>);

/// Residual and its derivatives by the camera's parameters and by `δ` of `T exp(δ)`.
pub(super) fn linearised(
    camera: &Intrinsics,
    pose: &Isometry3<f64>,
    corner: &Corner,
) -> Option<Linearised> {
    let r = pose.rotation.to_rotation_matrix().into_inner();
    let point = r * corner.in_target + pose.translation.vector;
    let (pixel, by_point) = camera.project_with_jacobian(&point)?;
    let mut by_pose = SMatrix::<f64, 2, 6>::zeros();
    let turned = by_point * r;
    by_pose.fixed_view_mut::<2, 3>(0, 0).copy_from(&(-turned * hat(&corner.in_target)));
    by_pose.fixed_view_mut::<2, 3>(0, 3).copy_from(&turned);
    Some((pixel - corner.pixel, camera.by_lens(&point), by_pose))
}
