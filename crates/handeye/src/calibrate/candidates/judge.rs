//! What every candidate is judged by.

use nalgebra::Matrix6;

use crate::{
    Camera, Config, Mount, Pose,
    calibrate::{
        flow::{
            evidence::{RestsOn, Seen},
            views::Views,
        },
        prediction::workpiece::Workpiece,
        result::{Candidate, RobotErrorKind},
    },
    estimate::{evaluate::HeldOut, touch_pairs::TouchPairs},
};

/// What every candidate is judged by.
pub(super) struct Judge<'a> {
    pub(super) views: &'a Views<'a>,
    pub(super) paired: &'a [TouchPairs],
    pub(super) config: &'a Config,
    pub(super) workpiece: &'a Workpiece<'a>,
    /// Errors of the robot, beside noise, for which there is a candidate.
    pub(super) of_robot: Option<RobotErrorKind>,
}

/// A candidate with what its choice needs.
pub(super) struct Judged {
    pub(super) rests_on: RestsOn,
    pub(super) candidate: Candidate,
    /// Residual of each capture when it was left out.
    pub(super) held_out: HeldOut,
    /// The captures as it sees them, where that is not as they were read.
    pub(super) seen: Option<Seen>,
}

impl Judge<'_> {
    /// Covariance of an answer for the camera. Where the arm deviates, every answer misses what the best one does, and
    /// its distance from that one.
    pub(super) fn of_camera(&self, own: Matrix6<f64>, x: &Pose<Mount, Camera>) -> Matrix6<f64> {
        let Some((best, covariance)) = self.workpiece.rigid() else { return own };
        let off = best.local(x);
        covariance + off * off.transpose()
    }
}
