//! Touched corners of boards, against where images show those boards.

use nalgebra::{Matrix3, Matrix6, Vector6};

use super::{ByPose, Sighting, Test, Touched, by_board, by_mount};
use crate::{
    Base, Calibration, Camera, Flange, ImageCorner, Intrinsics, Mount, Observation, Placement,
    Pose, Session, Setup, SurfaceCorner, Target, TargetModel, TargetPose, calibrate::result,
    detect,
};

/// What the robot's position misses from place to place, m, each axis: by the error of its reports, or by errors that it
/// does not know of, of its arm or by place.
pub fn place_sigma(calibration: &Calibration) -> f64 {
    let tre = calibration.predicted_tre_mm.as_ref().map_or(0.0, |tre| tre.rms * 1e-3);
    let missed = calibration.robot_errors().map_or(0.0, |_| tre / 3.0f64.sqrt());
    calibration.robot_noise().distance.max(missed)
}

/// Covariance (rad², m²) of a flange pose as the robot reports it.
pub fn robot_covariance(calibration: &Calibration) -> Matrix6<f64> {
    let noise = calibration.robot_noise();
    let (r, t) = (noise.angle.powi(2), noise.distance.powi(2));
    Matrix6::from_diagonal(&Vector6::new(r, r, r, t, t, t))
}

/// A test of a calibration that nothing has been touched for yet; a touch alone has a standard deviation of `touch_sigma` (m,
/// each axis), to which comes what the robot misses. `None` where the calibration has no transform.
pub fn of_calibration(calibration: &Calibration, touch_sigma: f64) -> Option<Test> {
    Some(Test {
        mount_from_camera: calibration.hand_eye.mount_from_camera?,
        covariance: calibration.hand_eye.covariance.mount_from_camera.as_ref().map(result::matrix),
        poses: vec![],
        touch_sigma: touch_sigma.hypot(place_sigma(calibration)),
        touches: vec![],
    })
}

/// Takes the touches of a session into a test: of the boards that lie in the view (eye-to-hand), or of the one that all views
/// show (eye-in-hand). Camera and size of the board are those that the calibration has found.
pub fn add_boards(test: &mut Test, calibration: &Calibration, session: &Session) {
    let Some(target) = &session.target else { return };
    let size = calibration.target_scale.filter(|s| s.used).map_or(1.0, |s| s.value);
    let boards = Boards { calibration, session, target: target.resized(size) };
    let first = test.touches.len();
    test.touches.extend(session.touches.iter().map(|t| Touched {
        id: format!("{} {}", t.placement, t.corner),
        in_base: t.in_base,
        sightings: vec![],
    }));
    for view in boards.views() {
        boards.see(test, first, &view);
    }
}

/// A look at a board.
struct BoardView {
    /// The placement that is looked at.
    placement: String,
    base_from_mount: Pose<Base, Mount>,
    /// The board's possible poses.
    candidates: Vec<TargetPose>,
}

struct Boards<'a> {
    calibration: &'a Calibration,
    session: &'a Session,
    /// In the size that the calibration has found.
    target: TargetModel,
}

impl Boards<'_> {
    fn views(&self) -> Vec<BoardView> {
        let placed = |p: &Placement| BoardView {
            placement: p.id.clone(),
            base_from_mount: Pose::identity(),
            candidates: self.poses((&p.corners, &p.surface), &p.candidates),
        };
        let touches = self.session.touches.iter();
        let only = touches.map(|t| &t.placement).next().cloned().unwrap_or_default();
        let view = |o: &Observation| BoardView {
            placement: only.clone(),
            base_from_mount: o.base_from_flange.rename(),
            candidates: self.poses((&o.corners, &o.surface), &o.candidates),
        };
        match self.session.setup {
            Setup::EyeToHand => self.session.placements.iter().map(placed).collect(),
            Setup::EyeInHand => self.session.observations.iter().map(view).collect(),
        }
    }

    /// Poses of a board as measured, or anew where the calibration has found another camera or size.
    fn poses(
        &self,
        (corners, surface): (&[ImageCorner], &[SurfaceCorner]),
        measured: &[TargetPose],
    ) -> Vec<TargetPose> {
        let declared = self.session.camera;
        let same_image =
            |c: &Intrinsics| declared.is_none_or(|d| (d.width, d.height) == (c.width, c.height));
        let found = self.calibration.camera.as_ref().map(|c| c.intrinsics).filter(same_image);
        let camera = found.or(declared);
        let is_as_measured =
            camera == declared && Some(&self.target) == self.session.target.as_ref();
        let again = camera.filter(|_| !is_as_measured && !corners.is_empty()).and_then(|camera| {
            let poses = detect::target_poses(corners, surface, &self.target, &camera).ok()?;
            Some(detect::with_symmetries(&poses, &self.target))
        });
        again.unwrap_or_else(|| measured.to_vec())
    }

    /// Adds one view of a board to the touches of it, in the reading that fits them best.
    fn see(&self, test: &mut Test, first: usize, view: &BoardView) {
        let touches = &self.session.touches;
        let base_from_camera: Pose<Base, Camera> = view.base_from_mount * test.mount_from_camera;
        let touched: Vec<usize> =
            (0..touches.len()).filter(|&k| touches[k].placement == view.placement).collect();
        let corner = |k: usize| self.target.corner(touches[k].corner);
        let distance = |pose: &Pose<Camera, Target>| -> f64 {
            let of = |&k: &usize| {
                let there = base_from_camera * *pose * corner(k)?;
                Some((there.vector() - touches[k].in_base.vector()).norm())
            };
            touched.iter().filter_map(of).sum()
        };
        let best = view.candidates.iter().min_by(|a, b| {
            distance(&a.camera_from_target).total_cmp(&distance(&b.camera_from_target))
        });
        let Some(pose) = best.filter(|_| !touched.is_empty()) else { return };
        let board = test.poses.len();
        test.poses.push(pose.covariance.unwrap_or_else(Matrix6::zeros));
        let flange = (self.session.setup == Setup::EyeInHand).then(|| {
            test.poses.push(robot_covariance(self.calibration));
            board + 1
        });
        for k in touched {
            let Some(on_board) = corner(k) else { continue };
            let in_camera = pose.camera_from_target * on_board;
            let of_board: ByPose = by_board(&base_from_camera, &pose.camera_from_target, &on_board);
            let in_mount = test.mount_from_camera * in_camera;
            let of_flange = flange.map(|f| (f, by_mount(&view.base_from_mount, &in_mount)));
            test.touches[first + k].sightings.push(Sighting {
                base_from_mount: view.base_from_mount,
                in_camera,
                covariance: Matrix3::zeros(),
                shared: [(board, of_board)].into_iter().chain(of_flange).collect(),
            });
        }
    }
}

/// The error of a flange pose, one for all that was seen from it.
pub fn shared_flange(
    test: &mut Test,
    flange: Pose<Base, Flange>,
    calibration: &Calibration,
) -> usize {
    let same = |t: &Touched| {
        let s = t.sightings.iter().find(|s| s.base_from_mount.rename::<_, Flange>() == flange)?;
        s.shared.first().map(|(number, _)| *number)
    };
    test.touches.iter().find_map(same).unwrap_or_else(|| {
        test.poses.push(robot_covariance(calibration));
        test.poses.len() - 1
    })
}
