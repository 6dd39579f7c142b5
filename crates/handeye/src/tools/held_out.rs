//! Views that a calibration was not made with: does it predict them as well as its own captures?
//!
//! ```text
//! e_k² = mean over corners |C_k c - X⁻¹ A_k⁻¹ Y c|²        F = mean e_k² / (n/(n - 2) mean e_i² + TRE²)
//! ```
//!
//! with `C_k` the target's pose in view `k`, in the reading that is nearest to what is predicted, `X = mount_from_camera`,
//! `Y = anchor_from_target`, `A_k` the robot's pose and `c` the corners of the target. The `e_i` are those of the `n` captures
//! that the answer was made with, whose mean square it has made smaller; `TRE` is the error that it states of itself. Poses
//! of both are computed alike, with the camera and the size of the target that the answer has found, and `Y` is the mean of
//! where such poses of the captures put the target. Where the answer holds,
//! `F` follows an F distribution; each view has as many degrees of freedom as there are directions in which the captures'
//! errors scatter.

use nalgebra::{Matrix3, Vector3, Vector6};
use serde::Serialize;

use crate::{
    Anchor, Calibration, Camera, HandEye, Observation, Point, Pose, Session, Target,
    calibrate::readings, math::statistics,
};

/// Chance below which views contradict what the calibration says of itself.
pub const LEAST_CHANCE: f64 = 0.01;

/// Rounds in which the target's mean pose settles.
const ROUNDS: usize = 3;
/// Fewer captures say nothing of how well they are predicted.
const FEWEST: usize = 4;

/// A view that the calibration was not made with, and how far it is from the prediction.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HeldOutView {
    /// Its name.
    pub id: String,
    /// Distance of the target's corners to where they were predicted, RMS, mm.
    pub distance_mm: f64,
    /// Angle between the target and the predicted one, degrees.
    pub angle_deg: f64,
}

/// Whether a calibration predicts views that it was not made with.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HeldOutTest {
    /// The views that show the target.
    pub views: Vec<HeldOutView>,
    /// RMS of their distances, mm.
    pub rms_mm: f64,
    /// What was expected of it, by the captures and by the stated error, mm.
    pub expected_mm: f64,
    /// Chance that views are as far off or farther where the calibration holds: of all together, and of the worst one as one
    /// of so many.
    pub chance: f64,
}

impl HeldOutTest {
    /// Whether the views agree with the calibration.
    pub fn agrees(&self) -> bool {
        self.chance >= LEAST_CHANCE
    }

    /// The view that is farthest off.
    pub fn worst(&self) -> Option<&HeldOutView> {
        self.views.iter().max_by(|a, b| a.distance_mm.total_cmp(&b.distance_mm))
    }
}

/// Tests a calibration of a session by views that it was not made with. `None` without a transform, without a view that shows
/// the target, or with too few captures.
pub fn test(
    calibration: &Calibration,
    session: &Session,
    views: &[Observation],
) -> Option<HeldOutTest> {
    let is_used =
        |o: &&Observation| calibration.captures.iter().any(|c| c.used && c.id == o.capture);
    let captures: Vec<&Observation> = session.observations.iter().filter(is_used).collect();
    let predicted = Predicted::of(calibration, session)?.settled(&captures);
    let own: Vec<Off> = captures.iter().filter_map(|o| predicted.off(o)).collect();
    if own.len() < FEWEST {
        return None;
    }
    let off = views.iter().filter_map(|view| Some((view, predicted.off(view)?)));
    let all: Vec<HeldOutView> = off
        .map(|(view, off)| HeldOutView {
            id: view.capture.clone(),
            distance_mm: off.square_mm2.sqrt(),
            angle_deg: off.angle_deg,
        })
        .collect();
    let n = own.len() as f64;
    let stated_mm = calibration.predicted_tre_mm.as_ref().map_or(0.0, |tre| tre.rms);
    let of_captures = own.iter().map(|off| off.square_mm2).sum::<f64>() / (n - 2.0);
    let expected = of_captures + stated_mm.powi(2);
    let degrees = directions(&own);
    let chance = |square: f64, views: f64| {
        statistics::of_f(square / expected, (degrees * views, degrees * n))
    };
    let squares: Vec<f64> = all.iter().map(|view| view.distance_mm.powi(2)).collect();
    let worst = squares.iter().copied().reduce(f64::max)?;
    let count = all.len() as f64;
    let mean = squares.iter().sum::<f64>() / count;
    // all together, or one of so many alone: two tests, but of one view
    let tests = if all.len() > 1 { 2.0 } else { 1.0 };
    let least = chance(mean, count).min(count * chance(worst, 1.0));
    Some(HeldOutTest {
        views: all,
        rms_mm: mean.sqrt(),
        expected_mm: expected.sqrt(),
        chance: (tests * least).min(1.0),
    })
}

/// In how many directions errors scatter: one where all lie along a line, three where they are alike in all (F.
/// Satterthwaite's degrees of freedom of one vector).
fn directions(all: &[Off]) -> f64 {
    let scatter: Matrix3<f64> =
        all.iter().map(|off| off.middle_mm * off.middle_mm.transpose()).sum();
    let squares = (scatter * scatter).trace();
    if squares > 0.0 { scatter.trace().powi(2) / squares } else { 1.0 }
}

/// How far a view is from where it was predicted.
struct Off {
    /// Where the target was seen.
    seen: Pose<Camera, Target>,
    /// Mean square over the target's corners.
    square_mm2: f64,
    /// The displacement of its middle, in the camera.
    middle_mm: Vector3<f64>,
    angle_deg: f64,
}

/// Where a calibration puts the target.
struct Predicted<'a> {
    calibration: &'a Calibration,
    session: &'a Session,
    hand_eye: HandEye,
    corners: Vec<Point<Target>>,
}

impl<'a> Predicted<'a> {
    fn of(calibration: &'a Calibration, session: &'a Session) -> Option<Self> {
        let size = calibration.target_scale.filter(|s| s.used).map_or(1.0, |s| s.value);
        let corners =
            session.target.as_ref().map_or(vec![], |target| target.resized(size).corners());
        let origin = || vec![Point::new(0.0, 0.0, 0.0)];
        let corners = if corners.is_empty() { origin() } else { corners };
        Some(Self { calibration, session, hand_eye: calibration.hand_eye.hand_eye()?, corners })
    }

    /// With the target where the captures put it on average, in poses that are computed as those of the views are.
    fn settled(mut self, captures: &[&Observation]) -> Self {
        for _ in 0..ROUNDS {
            let target = self.hand_eye.anchor_from_target;
            let local = captures.iter().filter_map(|o| {
                let off = self.off(o)?;
                Some(target.local(&(self.anchor_from_camera(o) * off.seen)))
            });
            let local: Vec<Vector6<f64>> = local.collect();
            if local.is_empty() {
                break;
            }
            let mean = local.iter().sum::<Vector6<f64>>() / local.len() as f64;
            self.hand_eye.anchor_from_target = target.retract(&mean);
        }
        self
    }

    fn anchor_from_camera(&self, view: &Observation) -> Pose<Anchor, Camera> {
        let anchor_from_mount = self.calibration.setup.anchor_from_mount(view.base_from_flange);
        anchor_from_mount * self.hand_eye.mount_from_camera
    }

    /// In the reading that is nearest to the prediction.
    fn off(&self, view: &Observation) -> Option<Off> {
        let there = self.anchor_from_camera(view).inverse() * self.hand_eye.anchor_from_target;
        let readings = readings(self.calibration, self.session, view);
        let all = readings.iter().map(|seen| self.between(seen, &there));
        all.min_by(|a, b| a.square_mm2.total_cmp(&b.square_mm2))
    }

    fn between(&self, seen: &Pose<Camera, Target>, there: &Pose<Camera, Target>) -> Off {
        let apart = |c: &Point<Target>| ((*seen * *c).vector() - (*there * *c).vector()) * 1e3;
        let apart: Vec<Vector3<f64>> = self.corners.iter().map(apart).collect();
        let count = apart.len() as f64;
        Off {
            seen: *seen,
            square_mm2: apart.iter().map(Vector3::norm_squared).sum::<f64>() / count,
            middle_mm: apart.iter().sum::<Vector3<f64>>() / count,
            angle_deg: there.angle_to(seen).to_degrees(),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::*;
    use crate::{Config, Setup, calibrate, detect, simulate::Cell};
    use nalgebra::{Isometry3, Vector3};

    const CAPTURES: usize = 12;
    const SETUPS: [Setup; 2] = [Setup::EyeInHand, Setup::EyeToHand];

    /// A calibration from some captures of a cell whose board is declared so many times as large as it is, and the others.
    fn split(setup: Setup, seed: u64, declared: f64) -> (Calibration, Session, Vec<Observation>) {
        let cell = Cell { captures: CAPTURES + 4, touches: 0, ..Cell::new(setup, seed) };
        let (mut session, _) = cell.session(seed).unwrap();
        let target = session.target.unwrap().resized(declared);
        for o in &mut session.observations {
            let poses = detect::target_poses(&o.corners, &[], &target, &cell.intrinsics).unwrap();
            o.candidates = detect::with_symmetries(&poses, &target);
        }
        session.target = Some(target);
        let views = session.observations.split_off(CAPTURES);
        (calibrate(&session, &Config::default()).unwrap(), session, views)
    }

    /// The view after the camera was moved in its own frame: as if the robot had been elsewhere by as much.
    fn knocked(
        view: &Observation,
        calibration: &Calibration,
        knock: Isometry3<f64>,
    ) -> Observation {
        let x = *calibration.hand_eye.mount_from_camera.unwrap().iso();
        let by = x * knock.inverse() * x.inverse();
        let base_from_flange = match calibration.setup {
            Setup::EyeInHand => Pose::claim(view.base_from_flange.iso() * by),
            Setup::EyeToHand => Pose::claim(by.inverse() * view.base_from_flange.iso()),
        };
        Observation { base_from_flange, ..view.clone() }
    }

    #[test]
    fn views_of_the_same_cell_agree_whatever_the_size_of_the_board_was_declared_to_be() {
        let mut refused = 0;
        for seed in 0..24 {
            let declared = [1.0, 1.006, 0.98][seed as usize % 3];
            let (calibration, session, views) = split(SETUPS[seed as usize % 2], seed, declared);
            let found = test(&calibration, &session, &views).unwrap();
            assert_eq!(found.views.len(), 4);
            assert!(found.rms_mm > 0.0 && found.expected_mm < 3.0, "{declared}: {found:?}");
            refused += usize::from(!found.agrees());
        }
        assert!(refused <= 1, "{refused} of 24");
    }

    #[test]
    fn a_camera_that_was_pushed_or_turned_is_seen_by_one_view() {
        for (seed, declared) in [(1, 1.0), (2, 1.0), (3, 0.98), (4, 1.006)] {
            let (calibration, session, mut views) =
                split(SETUPS[seed as usize % 2], seed, declared);
            let before = test(&calibration, &session, &views).unwrap();
            assert!(before.agrees(), "{before:?}");
            let middle = views[3].candidates[0].camera_from_target.translation();
            let turn = Isometry3::rotation(Vector3::new(0.0, 0.0, 4.0f64.to_radians()));
            let about_the_board = Isometry3::translation(middle.x, middle.y, 0.0)
                * turn
                * Isometry3::translation(-middle.x, -middle.y, 0.0);
            let unmoved = views[3].clone();
            for knock in [Isometry3::translation(6e-3, -4e-3, 4e-3), about_the_board] {
                views[3] = knocked(&unmoved, &calibration, knock);
                let after = test(&calibration, &session, &views).unwrap();
                assert!(!after.agrees(), "{after:?}");
                assert_eq!(after.worst().unwrap().id, unmoved.capture);
            }
        }
    }

    #[test]
    fn errors_along_a_line_have_one_degree_of_freedom_and_alike_ones_three() {
        let off = |x: f64, y: f64, z: f64| Off {
            seen: Pose::identity(),
            square_mm2: 1.0,
            middle_mm: Vector3::new(x, y, z),
            angle_deg: 0.0,
        };
        assert!((directions(&[off(0.0, 0.0, 2.0), off(0.0, 0.0, -1.0)]) - 1.0).abs() < 1e-12);
        let alike = [off(1.0, 0.0, 0.0), off(0.0, 1.0, 0.0), off(0.0, 0.0, 1.0)];
        assert!((directions(&alike) - 3.0).abs() < 1e-12);
    }

    #[test]
    fn without_a_view_or_an_answer_there_is_no_test() {
        let (calibration, session, views) = split(Setup::EyeInHand, 5, 1.0);
        assert_eq!(test(&calibration, &session, &[]), None);
        let unseen = Observation { candidates: vec![], corners: vec![], ..views[0].clone() };
        assert_eq!(test(&calibration, &session, &[unseen]), None);
        let open = Calibration { hand_eye: Default::default(), ..calibration };
        assert_eq!(test(&open, &session, &views), None);
    }
}
