//! How far a robot is from where it says.
//!
//! Two parts: one that differs in every pose as if drawn anew, and one that belongs to the arm. The
//! latter, the trace of wrong link lengths and joint offsets, is smooth in the pose: each component
//! is `a sin(k·p + q·z + r·x + φ)` of the position `p` and of the flange's axes `z` and `x`, with
//! waves about as long as the arm. The constants belong to the cell, so that the same pose has the
//! same error again, as have neighbouring ones nearly.

use nalgebra::{Vector3, Vector6};

use super::{BuiltArm, CellNoise};
use crate::{
    Base, Flange, Pose,
    math::{lie, random::Random},
};

/// Shortest and longest wave of the error over the workspace, m.
const WAVE_M: (f64, f64) = (0.8, 2.0);
/// Most that the error's phase changes with an axis of the flange, rad.
const MOST_TURN_RAD: f64 = 1.0;

/// One component of the systematic error, of variance one.
struct Wave {
    of_position: Vector3<f64>,
    of_z: Vector3<f64>,
    of_x: Vector3<f64>,
    phase: f64,
}

impl Wave {
    fn draw(random: &mut Random) -> Self {
        let length = random.between(WAVE_M.0, WAVE_M.1);
        let mut towards = || random.normal3().normalize();
        let (k, q, r) = (towards(), towards(), towards());
        Wave {
            of_position: k * (std::f64::consts::TAU / length),
            of_z: q * MOST_TURN_RAD,
            of_x: r * MOST_TURN_RAD,
            phase: random.between(0.0, std::f64::consts::TAU),
        }
    }

    fn at(&self, pose: &Pose<Base, Flange>) -> f64 {
        let r = pose.rotation();
        let (x, z) = (r.column(0), r.column(2));
        let phase = self.of_position.dot(&pose.translation()) + self.of_z.dot(&z);
        2f64.sqrt() * (phase + self.of_x.dot(&x) + self.phase).sin()
    }
}

/// The arm's own error: the same for the same pose.
pub(super) struct SystematicError {
    turn: [Wave; 3],
    shift: [Wave; 3],
    size: (f64, f64),
}

impl SystematicError {
    /// Of an arm that `random` decides on.
    pub(super) fn draw(noise: &CellNoise, mut random: Random) -> Self {
        let mut three = || std::array::from_fn(|_| Wave::draw(&mut random));
        let (turn, shift) = (three(), three());
        let position = noise.robot_systematic_m / 3f64.sqrt();
        Self { turn, shift, size: (noise.robot_systematic_rad, position) }
    }

    fn at(&self, pose: &Pose<Base, Flange>) -> Vector6<f64> {
        let (rotation, position) = self.size;
        let all = |waves: &[Wave; 3]| Vector3::from_fn(|k, _| waves[k].at(pose));
        lie::tangent(&(all(&self.turn) * rotation), &(all(&self.shift) * position))
    }
}

/// What is wrong with a robot.
pub(super) struct Robot {
    pub systematic: SystematicError,
    pub arm: Option<BuiltArm>,
}

impl Robot {
    /// What the robot says when it is there, and its joint values where it has joints; `None` where
    /// these do not reach.
    pub(super) fn reported(
        &self,
        there: &Pose<Base, Flange>,
        noise: &CellNoise,
        random: &mut Random,
    ) -> Option<(Pose<Base, Flange>, Vec<f64>)> {
        let rotation = noise.robot_absolute_rad.hypot(noise.robot_repeatability_rad);
        let position = noise.robot_absolute_m.hypot(noise.robot_repeatability_m) / 3f64.sqrt();
        let (turn, shift) = (random.normal3() * rotation, random.normal3() * position);
        let believed = there.retract(&(lie::tangent(&turn, &shift) + self.systematic.at(there)));
        let Some(arm) = &self.arm else { return Some((believed, vec![])) };
        let joints = arm.joints_at(&believed)?;
        Some((arm.model.base_from_flange(&joints), joints))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn systematic() -> SystematicError {
        let noise = CellNoise { robot_systematic_m: 1e-3, ..CellNoise::NONE };
        SystematicError::draw(&noise, Random::new(8))
    }

    fn pose(random: &mut Random) -> Pose<Base, Flange> {
        let (turn, shift) = (random.normal3(), random.normal3() * 2.0);
        Pose::identity().retract(&lie::tangent(&turn, &shift))
    }

    #[test]
    fn far_poses_have_errors_of_the_size_that_was_asked_for() {
        let (error, mut random) = (systematic(), Random::new(1));
        let one = |_| lie::nu(&error.at(&pose(&mut random))).norm_squared();
        let mean = (0..20_000).map(one).sum::<f64>() / 20_000.0;
        assert!((mean.sqrt() - 1e-3).abs() < 0.05e-3, "{mean}");
    }

    #[test]
    fn neighbours_err_alike_and_the_same_pose_errs_the_same() {
        let (error, mut random) = (systematic(), Random::new(2));
        for _ in 0..100 {
            let here = pose(&mut random);
            let near = here.retract(&(Vector6::repeat(0.01)));
            assert!((error.at(&here) - error.at(&near)).norm() < 0.4e-3);
            assert_eq!(error.at(&here), systematic().at(&here));
        }
    }
}
