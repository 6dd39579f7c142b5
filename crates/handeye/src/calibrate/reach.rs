//! What a robot does that does not know of its arm's deviations.
//!
//! The camera sees a point `p`; it really lies at `X p`. The robot is asked for `m` instead, such
//! that the arm as it is brings its tool there: the tool is held as it was in the nearest touches
//! (without touches: as the target was in the nearest captures), the joint values that reach `X p`
//! follow from the corrected arm, and `m` is where the arm as it was given puts the tool for these.
//! `m` is not a rigid motion of `p`; the answer for the robot as it is comes nearest to it over the
//! volume, and what is left adds to its error.

use nalgebra::{DMatrix, Isometry3, Matrix3, Matrix6, Vector3};

use super::arm::ArmFit;
use crate::{
    Camera, Flange, Mount, Pose, Setup,
    calibrate::views::Views,
    estimate::{ExtraKind, predict::Volume},
    model::kinematics::Arm,
    register::rigid_fit::{point_jacobian, rigid_fit},
};

/// Where a robot that does not know of its own errors must be sent, and what it misses then.
pub(super) trait Reach {
    /// Where the robot must be asked to go for a point, minus where it lies; camera axes, m.
    fn shift(&self, p: &Vector3<f64>) -> Vector3<f64>;

    /// How far that differs from way to way, m².
    fn scatter(&self, p: &Vector3<f64>) -> Matrix3<f64>;

    /// Which share of what the robot errs from pose to pose is in that already.
    fn share_of_noise(&self) -> f64 {
        0.0
    }

    /// How that moves with the unknowns of the robot, by their number among all.
    fn by_unknowns(&self, p: &Vector3<f64>) -> Vec<(usize, Vector3<f64>)>;

    /// The answer that comes nearest, and its covariance for one of all unknowns.
    fn rigid(&self, covariance: &DMatrix<f64>) -> Option<(Pose<Mount, Camera>, Matrix6<f64>)>;
}

/// A point of the volume.
struct Place {
    /// In the camera.
    p: Vector3<f64>,
    /// `m - X p`, in camera axes, mean and scatter over the ways to go there.
    shift: Vector3<f64>,
    scatter: Matrix3<f64>,
    /// How `m` moves with each deviation of the arm, in camera axes.
    by_arm: Vec<Vector3<f64>>,
}

/// The volume as the robot reaches it.
pub(super) struct ArmReach {
    places: Vec<Place>,
    /// Where the deviations stand among the unknowns.
    columns: Vec<usize>,
    x: Pose<Mount, Camera>,
}

/// A tool held somewhere.
struct Held {
    joints: Vec<f64>,
    /// The flange there, by the corrected arm.
    rotation: Matrix3<f64>,
    /// The tool in the flange, and where it was.
    tool: Vector3<f64>,
    at: Vector3<f64>,
}

/// So many of the nearest ways to hold the tool are looked at.
const NEAREST: usize = 3;
/// So many captures stand for all from which the camera looks (eye-in-hand).
const VIEWS: usize = 4;

impl ArmReach {
    /// `None` where the arm reaches no point of the volume.
    pub fn new(views: &Views, found: &ArmFit, volume: &Volume) -> Option<Self> {
        let work = Work::new(views, found)?;
        let known: Vec<Option<Place>> = volume.points.iter().map(|p| work.place(p)).collect();
        let near = |p: &Vector3<f64>| {
            let reached = known.iter().flatten();
            reached.min_by(|a, b| (a.p - p).norm().total_cmp(&(b.p - p).norm()))
        };
        let one =
            |p: &Vector3<f64>| near(p).map(|k| Place { p: *p, by_arm: k.by_arm.clone(), ..*k });
        let places = volume.points.iter().map(one).collect::<Option<Vec<_>>>()?;
        let extras = found.fit.extras.iter().enumerate();
        let columns =
            extras.filter(|(_, e)| matches!(e.kind, ExtraKind::Arm(_))).map(|(k, _)| 12 + k);
        Some(Self { places, columns: columns.collect(), x: found.fit.hand_eye.mount_from_camera })
    }

    fn near(&self, p: &Vector3<f64>) -> Option<&Place> {
        let far = |k: &Place| (k.p - p).norm();
        self.places.iter().min_by(|a, b| far(a).total_cmp(&far(b)))
    }

    /// A covariance that predicts what the robot misses all over the volume, where it is sent by a rigid motion;
    /// `squares` are `Σ JᵀJ` over it.
    fn missed(&self, motion: &Isometry3<f64>, squares: &Matrix6<f64>) -> Option<Matrix6<f64>> {
        let mut sum = Matrix6::zeros();
        for place in &self.places {
            let off = motion.transform_vector(&place.p) + motion.translation.vector
                - (place.p + place.shift);
            let j = point_jacobian(&place.p);
            sum += j.transpose() * (off * off.transpose() + place.scatter) * j;
        }
        let inverse = squares.try_inverse()?;
        // a pose of six unknowns carries each of them to points of three: half of it is their share
        Some(inverse * sum * inverse * (0.5 * self.places.len() as f64))
    }
}

impl Reach for ArmReach {
    fn shift(&self, p: &Vector3<f64>) -> Vector3<f64> {
        self.near(p).map_or_else(Vector3::zeros, |k| k.shift)
    }

    fn scatter(&self, p: &Vector3<f64>) -> Matrix3<f64> {
        self.near(p).map_or_else(Matrix3::zeros, |k| k.scatter)
    }

    fn by_unknowns(&self, p: &Vector3<f64>) -> Vec<(usize, Vector3<f64>)> {
        let of = |k: &Place| self.columns.iter().copied().zip(k.by_arm.iter().copied()).collect();
        self.near(p).map_or_else(Vec::new, of)
    }

    /// That no rigid motion comes nearer is in the covariance: as if the answer were another one at every place, by as
    /// much as the robot misses it there.
    fn rigid(&self, covariance: &DMatrix<f64>) -> Option<(Pose<Mount, Camera>, Matrix6<f64>)> {
        let from: Vec<Vector3<f64>> = self.places.iter().map(|k| k.p).collect();
        let to: Vec<Vector3<f64>> = self.places.iter().map(|k| k.p + k.shift).collect();
        let fit = rigid_fit(&from, &to).ok()?;
        let x = Pose::claim(self.x.iso() * fit.target_from_source);
        let mut squares = Matrix6::zeros();
        let mut by_all = DMatrix::zeros(6, covariance.nrows());
        for place in &self.places {
            let j = point_jacobian(&place.p);
            squares += j.transpose() * j;
            for (k, column) in self.columns.iter().zip(&place.by_arm) {
                let mut sum = by_all.column_mut(*k);
                sum += j.transpose() * column;
            }
        }
        by_all.view_mut((0, 0), (6, 6)).copy_from(&squares);
        let carry = DMatrix::from_column_slice(6, 6, squares.try_inverse()?.as_slice()) * by_all;
        let own = &carry * covariance * carry.transpose();
        let missed = self.missed(&fit.target_from_source, &squares)?;
        Some((x, own.fixed_view::<6, 6>(0, 0) + missed))
    }
}

/// A shift, and how it moves with the deviations.
type Sample = (Vector3<f64>, Vec<Vector3<f64>>);

/// Both arms, and how the tool was held.
struct Work<'a> {
    found: &'a ArmFit,
    setup: Setup,
    x: Pose<Mount, Camera>,
    model: &'a Arm,
    real: Arm,
    held: Vec<Held>,
    /// Joint values from which the camera looks; none of them matter where it stands still.
    views: Vec<Vec<f64>>,
}

impl<'a> Work<'a> {
    fn new(views: &Views, found: &'a ArmFit) -> Option<Self> {
        let (setup, x) = (views.session.setup, found.fit.hand_eye.mount_from_camera);
        let (model, real) = (&found.model, found.corrected());
        let tip = Vector3::from_fn(|k, _| {
            found.fit.extra(ExtraKind::Tip(k)).map_or(0.0, |t: (f64, f64)| t.0)
        });
        let hold = |joints: &Vec<f64>, tool: Vector3<f64>| {
            let flange = real.base_from_flange(joints);
            let at = flange.rotation() * tool + flange.translation();
            Held { joints: joints.clone(), rotation: flange.rotation(), tool, at }
        };
        let touched = views.session.touches.iter().filter_map(|t| {
            let flange = t.base_from_flange.filter(|_| t.joints.len() == model.joints.len())?;
            Some(hold(&t.joints, (flange.inverse() * t.in_base).vector() + tip))
        });
        let mut held: Vec<Held> = touched.collect();
        if held.is_empty() {
            // the target is the tool, or as long as the camera's place on the flange
            let tool = match setup {
                Setup::EyeToHand => found.fit.hand_eye.anchor_from_target.translation(),
                Setup::EyeInHand => x.translation(),
            };
            held = views.used.iter().map(|o| hold(&o.joints, tool)).collect();
        }
        let looking: Vec<Vec<f64>> = match setup {
            Setup::EyeToHand => vec![vec![]],
            Setup::EyeInHand => {
                let step = views.used.len().div_ceil(VIEWS).max(1);
                views.used.iter().step_by(step).map(|o| o.joints.clone()).collect()
            }
        };
        (!held.is_empty()).then_some(Self { found, setup, x, model, real, held, views: looking })
    }

    fn place(&self, p: &Vector3<f64>) -> Option<Place> {
        let mut all = vec![];
        for view in &self.views {
            let there = self.in_base(view, p);
            let mut near: Vec<&Held> = self.held.iter().collect();
            near.sort_by(|a, b| (a.at - there).norm().total_cmp(&(b.at - there).norm()));
            all.extend(near.iter().take(NEAREST).filter_map(|h| self.sample(view, h, p, &there)));
        }
        let n = all.len() as f64;
        let shift = all.iter().map(|s| s.0).sum::<Vector3<f64>>() / n;
        let off = |s: &Sample| (s.0 - shift) * (s.0 - shift).transpose();
        let scatter = all.iter().map(off).sum::<Matrix3<f64>>() / n;
        let by_arm = (0..all.first()?.1.len())
            .map(|k| all.iter().map(|s| s.1[k]).sum::<Vector3<f64>>() / n)
            .collect();
        Some(Place { p: *p, shift, scatter, by_arm })
    }

    fn in_base(&self, view: &[f64], p: &Vector3<f64>) -> Vector3<f64> {
        let on_mount = self.x.rotation() * p + self.x.translation();
        match self.setup {
            Setup::EyeToHand => on_mount,
            Setup::EyeInHand => carried(&self.real.base_from_flange(view), &on_mount),
        }
    }

    /// One way to go there: the shift, and how it moves with the deviations.
    fn sample(
        &self,
        view: &[f64],
        held: &Held,
        p: &Vector3<f64>,
        there: &Vector3<f64>,
    ) -> Option<Sample> {
        let flange = Pose::from_parts(&held.rotation, there - held.rotation * held.tool);
        let joints = self.real.inverse(&flange, &held.joints)?;
        let says = carried(&self.model.base_from_flange(&joints), &held.tool);
        let reached =
            held.rotation * point_jacobian(&held.tool) * self.found.by_deviations(&joints);
        let on_mount = self.x.rotation() * p + self.x.translation();
        let (m, by) = match self.setup {
            Setup::EyeToHand => (says, -reached),
            Setup::EyeInHand => {
                let (at, really) =
                    (self.model.base_from_flange(view), self.real.base_from_flange(view));
                let seen =
                    really.rotation() * point_jacobian(&on_mount) * self.found.by_deviations(view);
                let back = at.rotation().transpose();
                (back * (says - at.translation()), back * (seen - reached))
            }
        };
        let to_camera = self.x.rotation().transpose();
        let by = to_camera * by;
        Some((to_camera * (m - on_mount), by.column_iter().map(Into::into).collect()))
    }
}

fn carried<A>(pose: &Pose<A, Flange>, p: &Vector3<f64>) -> Vector3<f64> {
    pose.rotation() * p + pose.translation()
}
