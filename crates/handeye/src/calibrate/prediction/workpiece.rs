//! How far off points will be where the answer is used.

use nalgebra::{DMatrix, Matrix3, Matrix6, Vector3};

use super::reach::Reach;
use crate::{
    Camera, HandEye, Mount, Pose, Setup, Target, Workspace,
    calibrate::{
        flow::views::{Views, pairs_of},
        optics::{self, MeasuredBy},
    },
    estimate::{
        JointFit, Source,
        predict::{self, PredictedTre, Volume},
        touch_pairs,
    },
    mistakes,
};

/// Share of the equations that tell the noise on which an answer rests: rotations tell nothing of
/// how exact positions are, nor positions of rotations.
const OF_ONE_NOISE: f64 = 0.5;

/// Factor on covariances, for noise estimated from few captures and for residual.
pub(crate) fn inflation(fit: &JointFit) -> Option<f64> {
    let dof = fit.degrees_of_freedom;
    let residual = if dof > 0.0 { (fit.chi_squared / dof).max(1.0) } else { 1.0 };
    let factor = residual * touch_pairs::small_sample(OF_ONE_NOISE * dof);
    factor.is_finite().then_some(factor)
}

/// Where the answer will be used, in the camera frame.
pub(crate) fn volume(views: &Views, fit: &JointFit) -> Option<Volume> {
    if let Some(w) = &views.session.workspace {
        return Some(workspace_volume(views.session.setup, w, &fit.hand_eye.mount_from_camera));
    }
    let Some(target) = &views.session.target else {
        let origin = [crate::Point::new(0.0, 0.0, 0.0)];
        let name = "the box around the target's origin in all poses";
        return mistakes::seen_volume(&pairs_of(views), &origin, name);
    };
    let corners: Vec<crate::Point<Target>> =
        target.corners().iter().map(|c| views.target_from_corner.inverse() * *c).collect();
    let name = "the box in which the camera saw the target";
    let mut volume = mistakes::seen_volume(&pairs_of(views), &corners, name)?;
    if let Some(camera) = &views.session.camera {
        let seen: Vec<_> =
            volume.points.iter().copied().filter(|p| optics::in_picture(camera, p)).collect();
        if !seen.is_empty() {
            volume.points = seen;
        }
    }
    Some(volume)
}

pub(crate) fn workspace_volume(setup: Setup, w: &Workspace, x: &Pose<Mount, Camera>) -> Volume {
    let volume = Volume::of_box(&w.minimum, &w.maximum, "the workspace box of the manifest");
    match setup {
        Setup::EyeInHand => volume, // declared in the camera frame
        Setup::EyeToHand => volume.seen_from(&x.iso().inverse(), setup.mount()),
    }
}

/// Where the answer is used, and the best answer there.
pub(crate) struct Workpiece<'a> {
    views: &'a Views<'a>,
    volume: &'a Volume,
    best: &'a JointFit,
    measured: MeasuredBy,
    /// How a robot reaches it that does not know of its arm's deviations.
    reach: Option<&'a dyn Reach>,
    /// Covariance of each point of the volume under the best answer, m².
    spread: Option<Vec<Matrix3<f64>>>,
    /// The answer for a robot that does not know of its arm's deviations, and its covariance.
    rigid: Option<(Pose<Mount, Camera>, Matrix6<f64>)>,
}

impl<'a> Workpiece<'a> {
    pub fn new(
        views: &'a Views<'a>,
        volume: &'a Volume,
        best: &'a JointFit,
        measured: MeasuredBy,
        reach: Option<&'a dyn Reach>,
    ) -> Self {
        let (spread, rigid) = (None, None);
        let mut workpiece = Self { views, volume, best, measured, reach, spread, rigid };
        workpiece.rigid = workpiece.find_rigid();
        workpiece.spread = best.covariance.as_ref().and_then(|c| workpiece.spread_of(c));
        workpiece
    }

    /// Covariance (m²) of where a point of the camera lands, for a covariance of all unknowns.
    fn spread_at(&self, covariance: &DMatrix<f64>, p: &Vector3<f64>) -> Option<Matrix3<f64>> {
        let more = self.reach.map_or_else(Vec::new, |r| r.by_unknowns(p));
        let covariance = covariance * inflation(self.best)?;
        optics::spread((self.views, self.measured), &self.best.extras, &covariance, p, more)
    }

    fn spread_of(&self, covariance: &DMatrix<f64>) -> Option<Vec<Matrix3<f64>>> {
        self.volume.points.iter().map(|p| self.spread_at(covariance, p)).collect()
    }

    /// Root mean square error (mm) over the volume, for a covariance of all unknowns.
    pub fn rms_mm(&self, covariance: &DMatrix<f64>) -> Option<f64> {
        let spread = self.spread_of(covariance)?;
        let sum: f64 = spread.iter().map(|s| s.trace()).sum();
        Some((sum / spread.len().max(1) as f64).max(0.0).sqrt() * 1e3)
    }

    /// The root mean square of [`Self::tre`], mm.
    pub fn predicted_rms_mm(&self, x: &Pose<Mount, Camera>) -> Option<f64> {
        let offset = self.offset(x);
        let square = |(s, p): (&Matrix3<f64>, &Vector3<f64>)| {
            (s + self.scatter(p)).trace() + offset(p).norm_squared()
        };
        let all = self.spread.as_ref()?.iter().zip(&self.volume.points).map(square);
        Some((all.sum::<f64>() / self.volume.points.len().max(1) as f64).sqrt() * 1e3)
    }

    /// Predicted error of an answer: that of the best one, and in full the distance of the two.
    /// Given all that was measured, that is its expected error.
    pub fn tre(&self, x: &Pose<Mount, Camera>) -> Option<PredictedTre> {
        let own = self.spread.as_ref()?.iter().zip(&self.volume.points);
        let spread: Vec<Matrix3<f64>> = own.map(|(s, p)| s + self.scatter(p)).collect();
        let of_robot = self.volume.points.iter().map(|p| Matrix3::identity() * self.once(p));
        let once: Vec<Matrix3<f64>> = spread.iter().zip(of_robot).map(|(s, o)| s + o).collect();
        let at_task = predict::tre_of_points(self.volume, &once, self.offset(x));
        let tre = predict::tre_of_points(self.volume, &spread, self.offset(x));
        Some(PredictedTre { at_task_p95: Some(at_task.p95), ..tre })
    }

    /// Variance per axis (m²) of what the robot errs from pose to pose, where it goes to a point once, as far as it is
    /// not in the scatter. Tools are about as far from the flange as target and camera are.
    fn once(&self, p: &Vector3<f64>) -> f64 {
        let of = |source| self.best.noise.sigma(source).unwrap_or(0.0).powi(2);
        let (turn, shift) = (of(Source::RobotRotation), of(Source::RobotPosition));
        let HandEye { mount_from_camera: x, anchor_from_target: y } = &self.best.hand_eye;
        // two of three axes turn a point
        let by_turn = |lever: f64| turn * lever * 2.0 / 3.0;
        let variance = match self.views.session.setup {
            Setup::EyeToHand => shift + by_turn(y.translation().norm_squared()),
            // the camera looks from one pose, and the tool goes to another one
            Setup::EyeInHand => {
                let (seen, tool) = (x.rotation() * p + x.translation(), x.translation());
                2.0 * shift + by_turn(seen.norm_squared() + tool.norm_squared())
            }
        };
        variance * (1.0 - self.reach.map_or(0.0, Reach::share_of_noise))
    }

    fn scatter(&self, p: &Vector3<f64>) -> Matrix3<f64> {
        self.reach.map_or_else(Matrix3::zeros, |r| r.scatter(p))
    }

    /// Root mean square (mm) over the volume of the robot's errors that no fixed transform corrects, and of what is uncertain
    /// about them: they add to the error, whatever the covariance.
    pub fn uncorrectable_rms_mm(&self) -> f64 {
        let sum: f64 = self.volume.points.iter().map(|p| self.scatter(p).trace()).sum();
        (sum / self.volume.points.len().max(1) as f64).max(0.0).sqrt() * 1e3
    }

    /// Where an answer sends the robot, minus where it should go.
    fn offset(&self, x: &Pose<Mount, Camera>) -> impl Fn(&Vector3<f64>) -> Vector3<f64> {
        let rigid = predict::difference(&self.best.hand_eye.mount_from_camera, x);
        move |p| rigid(p) - self.reach.map_or_else(Vector3::zeros, |r| r.shift(p))
    }

    /// Predicted error (root mean square, mm) of a robot that knows of its arm's deviations.
    pub fn rms_of_best_mm(&self) -> Option<f64> {
        let spread = self.spread.as_ref()?;
        Some(predict::tre_of_points(self.volume, spread, |_| Vector3::zeros()).rms)
    }

    /// The answer for a robot that does not, and its covariance.
    pub fn rigid(&self) -> Option<(Pose<Mount, Camera>, Matrix6<f64>)> {
        self.rigid
    }

    fn find_rigid(&self) -> Option<(Pose<Mount, Camera>, Matrix6<f64>)> {
        let covariance = self.best.covariance.as_ref()? * inflation(self.best)?;
        self.reach?.rigid(&covariance)
    }

    /// The same in slices through the volume, where the camera sees.
    pub fn map(&self, x: &Pose<Mount, Camera>) -> Option<predict::TreMap> {
        let covariance = self.best.covariance.as_ref()?;
        let camera = self.views.session.camera.as_ref();
        let seen = |p: &Vector3<f64>| {
            let hidden = camera.is_some_and(|c| !optics::in_picture(c, p));
            if hidden { None } else { Some(self.spread_at(covariance, p)? + self.scatter(p)) }
        };
        Some(predict::map(self.volume, seen, self.offset(x)))
    }
}
