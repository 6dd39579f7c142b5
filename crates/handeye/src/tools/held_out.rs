//! Views that a calibration was not made with: does it predict them as well as its own captures?
//!
//! ```text
//! e_k = |C_k c - X⁻¹ A_k⁻¹ Y c|        F = mean e_k² / (n/(n - 2) mean e_i² + TRE²)
//! ```
//!
//! with `C_k` the target's pose in view `k`, in the reading that is nearest to what is predicted, `X = mount_from_camera`,
//! `Y = anchor_from_target`, `A_k` the robot's pose and `c` the middle of the target. The `e_i` are those of the `n` captures
//! that the answer was made with, whose mean square it has made smaller; `TRE` is the error that it states of itself.
//! Where the answer holds, `F` follows an F distribution. Each view counts as two degrees of freedom: the errors of a robot
//! and of a view's pose are neither in one direction nor in all alike.

use nalgebra::Vector3;
use serde::Serialize;

use crate::{
    Base, Calibration, Camera, Flange, Observation, Point, Pose, Target, TargetModel,
    math::statistics,
};

/// Chance below which views contradict what the calibration says of itself.
pub const LEAST_CHANCE: f64 = 0.01;

/// Fewer captures say nothing of how well they are predicted.
const FEWEST: usize = 4;
/// Degrees of freedom of a view.
const OF_A_VIEW: f64 = 2.0;

/// A view that the calibration was not made with, and how far it is from the prediction.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HeldOutView {
    /// Its name.
    pub id: String,
    /// Distance of the target's middle to where it was predicted, mm.
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
    /// Chance that views are as far off or farther where the calibration holds: the least of all together and of the worst
    /// one alone, as one of so many.
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

/// Tests a calibration by views that it was not made with. Their candidates are poses of the target as the calibration's
/// own camera sees it. `None` without a transform, without a view that shows the target, or with too few captures.
pub fn test(
    calibration: &Calibration,
    target: Option<&TargetModel>,
    views: &[Observation],
) -> Option<HeldOutTest> {
    let predicted = Predicted::of(calibration, target)?;
    let own: Vec<f64> = calibration
        .captures
        .iter()
        .filter(|c| c.used)
        .filter_map(|c| Some(predicted.off(&c.base_from_flange, &c.camera_from_target?).0))
        .collect();
    if own.len() < FEWEST {
        return None;
    }
    let all: Vec<HeldOutView> = views.iter().filter_map(|view| predicted.view(view)).collect();
    let n = own.len() as f64;
    let stated_mm = calibration.predicted_tre_mm.as_ref().map_or(0.0, |tre| tre.rms);
    let expected = mean_square(&own) * n / (n - 2.0) + stated_mm.powi(2);
    let off: Vec<f64> = all.iter().map(|view| view.distance_mm).collect();
    let worst = off.iter().copied().reduce(f64::max)?;
    let of_captures = OF_A_VIEW * n;
    let chance = |square: f64, views: f64| {
        statistics::of_f(square / expected, (OF_A_VIEW * views, of_captures))
    };
    let count = all.len() as f64;
    let together = chance(mean_square(&off), count);
    let alone = chance(worst.powi(2), 1.0) * count;
    Some(HeldOutTest {
        views: all,
        rms_mm: mean_square(&off).sqrt(),
        expected_mm: expected.sqrt(),
        chance: together.min(alone).min(1.0),
    })
}

fn mean_square(all: &[f64]) -> f64 {
    all.iter().map(|mm| mm * mm).sum::<f64>() / all.len() as f64
}

/// Where a calibration puts the target.
struct Predicted<'a> {
    calibration: &'a Calibration,
    hand_eye: crate::HandEye,
    middle: Point<Target>,
}

impl<'a> Predicted<'a> {
    fn of(calibration: &'a Calibration, target: Option<&TargetModel>) -> Option<Self> {
        let corners = target.map_or(vec![], TargetModel::corners);
        let sum: Vector3<f64> = corners.iter().map(Point::vector).sum();
        let size = calibration.target_scale.filter(|s| s.used).map_or(1.0, |s| s.value);
        let middle = Point::from_vector(sum * size / corners.len().max(1) as f64);
        Some(Self { calibration, hand_eye: calibration.hand_eye.hand_eye()?, middle })
    }

    /// How far a pose of the target is from the predicted one: mm and degrees.
    fn off(&self, robot: &Pose<Base, Flange>, seen: &Pose<Camera, Target>) -> (f64, f64) {
        let anchor_from_mount = self.calibration.setup.anchor_from_mount(*robot);
        let anchor_from_camera = anchor_from_mount * self.hand_eye.mount_from_camera;
        let there = anchor_from_camera.inverse() * self.hand_eye.anchor_from_target;
        let apart = (*seen * self.middle).vector() - (there * self.middle).vector();
        (apart.norm() * 1e3, there.angle_to(seen).to_degrees())
    }

    fn view(&self, view: &Observation) -> Option<HeldOutView> {
        let readings = view.candidates.iter();
        let off = readings.map(|c| self.off(&view.base_from_flange, &c.camera_from_target));
        // boards that look alike when they are turned have several readings
        let (distance_mm, angle_deg) = off.min_by(|a, b| (a.1 + a.0).total_cmp(&(b.1 + b.0)))?;
        Some(HeldOutView { id: view.capture.clone(), distance_mm, angle_deg })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::*;
    use crate::{Config, Session, Setup, calibrate, simulate::Cell};
    use nalgebra::{Isometry3, Vector3};

    const CAPTURES: usize = 12;

    /// A calibration from some captures of a cell, and the others.
    fn split(setup: Setup, seed: u64) -> (Calibration, Session, Vec<Observation>) {
        let cell = Cell { captures: CAPTURES + 4, touches: 0, ..Cell::new(setup, seed) };
        let (mut session, _) = cell.session(seed).unwrap();
        let views = session.observations.split_off(CAPTURES);
        (calibrate(&session, &Config::default()).unwrap(), session, views)
    }

    #[test]
    fn views_of_the_same_cell_agree() {
        let mut refused = 0;
        for seed in 0..30 {
            let setup = if seed % 2 == 0 { Setup::EyeInHand } else { Setup::EyeToHand };
            let (calibration, session, views) = split(setup, seed);
            let found = test(&calibration, session.target.as_ref(), &views).unwrap();
            assert_eq!(found.views.len(), 4);
            assert!(found.rms_mm > 0.0 && found.expected_mm > 0.0);
            refused += usize::from(!found.agrees());
        }
        assert!(refused <= 1, "{refused} of 30");
    }

    #[test]
    fn a_camera_that_was_knocked_is_seen_by_one_view() {
        for (setup, seed) in [(Setup::EyeInHand, 1), (Setup::EyeToHand, 2)] {
            let (calibration, session, mut views) = split(setup, seed);
            let knock = Isometry3::new(Vector3::new(3e-3, -2e-3, 2e-3), Vector3::zeros());
            for view in &mut views[3..] {
                for candidate in &mut view.candidates {
                    let moved = knock * candidate.camera_from_target.iso();
                    candidate.camera_from_target = Pose::claim(moved);
                }
            }
            let before = test(&calibration, session.target.as_ref(), &views[..3]).unwrap();
            let after = test(&calibration, session.target.as_ref(), &views).unwrap();
            assert!(before.agrees() && !after.agrees(), "{before:?} {after:?}");
            let worst = after.worst().unwrap();
            assert_eq!(worst.id, views[3].capture);
            assert!((worst.distance_mm - 4.1).abs() < 1.0, "{}", worst.distance_mm);
        }
    }

    #[test]
    fn without_a_view_or_an_answer_there_is_no_test() {
        let (calibration, session, views) = split(Setup::EyeInHand, 5);
        let target = session.target.as_ref();
        assert_eq!(test(&calibration, target, &[]), None);
        let unseen = Observation { candidates: vec![], ..views[0].clone() };
        assert_eq!(test(&calibration, target, &[unseen]), None);
        let open = Calibration { hand_eye: Default::default(), ..calibration };
        assert_eq!(test(&open, target, &views), None);
    }
}
