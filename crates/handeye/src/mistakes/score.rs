//! How well a reading of the captures fits, and what is found wrong with them.

use crate::{
    HandEye, PosePair,
    mistakes::{TargetScale, median},
    solve::{
        consensus,
        consensus::{Consensus, Readings},
    },
};

/// Rotation that counts as one unit of misfit, rad.
pub(crate) const UNIT_ANGLE: f64 = 0.05 / 180.0 * std::f64::consts::PI;

/// Distance that counts as one unit of misfit, m.
pub(crate) const UNIT_DISTANCE: f64 = 0.7e-3;

/// Fewest captures that contradict a wrong reading.
pub const FEWEST: usize = 4;

/// Flanges nearer to the base than this in all captures, or farther, are no robot's. m.
pub const REACH: (f64, f64) = (0.05, 6.0);

/// How well the captures agree under one reading.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Score {
    /// Combined misfit, in units of an industrial robot's error.
    pub score: f64,
    /// Median misfit of all captures, degrees.
    pub rotation_deg: f64,
    /// Median misfit of all captures, mm.
    pub translation_mm: f64,
    /// Captures that agree; none where the median misfit is beyond [`BELIEVABLE`].
    pub agree: usize,
}

/// A mistake.
#[derive(Debug, Clone, PartialEq)]
pub enum Fault {
    /// The numbers mean another thing: which of the readings on offer.
    Reading(usize),
    /// Pictures and robot poses are in different orders.
    Order(Order),
    /// Captures whose pictures were exchanged, in pairs.
    Exchanged(Vec<(usize, usize)>),
    /// The target has another size than declared, or the robot another scale.
    Scale(TargetScale),
    /// From the first to the last of these captures the target lay elsewhere.
    TargetMoved(usize, usize),
    /// From the first to the last of these captures the camera sat elsewhere on its mount.
    CameraMoved(usize, usize),
    /// The robot pose stood still while the camera moved: captures that share a pose.
    RobotStill(Vec<usize>),
    /// The camera saw the same while the robot moved.
    CameraStill(Vec<usize>),
    /// Captures that repeat one another.
    Repeated(Vec<usize>),
    /// Captures that agree with no others, too many to be strays.
    Disagreeing(Vec<usize>),
}

/// A mistake with its evidence.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Which.
    pub fault: Fault,
    /// The captures with it corrected; `None` where correcting needs new captures.
    pub after: Option<Score>,
}

/// The score of captures, and what they agree on.
pub fn scored(captures: &[Readings]) -> Option<(Score, Consensus)> {
    let found = consensus::consensus(captures).ok()?;
    Some((score(captures, &found.hand_eye, &found), found))
}

pub(crate) fn pair(capture: &Readings, reading: usize) -> PosePair {
    PosePair {
        anchor_from_mount: capture.anchor_from_mount,
        camera_from_target: capture.camera_from_target[reading],
    }
}

pub(crate) fn score(captures: &[Readings], hand_eye: &HandEye, found: &Consensus) -> Score {
    let errors: Vec<(f64, f64)> = (0..captures.len())
        .filter(|&i| !captures[i].camera_from_target.is_empty())
        .map(|i| {
            let e = hand_eye.loop_error(&pair(&captures[i], found.reading[i]));
            (e.iso().rotation.angle(), e.translation().norm())
        })
        .collect();
    let rotation_deg = median(errors.iter().map(|e| e.0)).to_degrees();
    let translation_mm = median(errors.iter().map(|e| e.1)) * 1e3;
    // the consensus compares captures with one another: bad ones that are alike would agree
    let believable = rotation_deg < BELIEVABLE.0 && translation_mm < BELIEVABLE.1;
    let agree = if believable { found.agrees.iter().filter(|a| **a).count() } else { 0 };
    Score { score: combined(&errors), rotation_deg, translation_mm, agree }
}

pub(crate) fn combined(errors: &[(f64, f64)]) -> f64 {
    let log =
        |&(r, t): &(f64, f64)| ((r / UNIT_ANGLE).powi(2) + (t / UNIT_DISTANCE).powi(2)).ln_1p();
    (errors.iter().map(log).sum::<f64>() / errors.len().max(1) as f64).exp_m1().sqrt()
}

/// The largest distance between base and flange, m.
pub fn reach(captures: &[Readings]) -> f64 {
    captures.iter().map(|c| c.anchor_from_mount.translation().norm()).fold(0.0, f64::max)
}

/// How the order of one list against the other is wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// Picture `i` belongs to robot pose `i + k`, counted round.
    Shifted(usize),
    /// The last picture belongs to the first robot pose.
    Reversed,
}

impl Order {
    /// Robot pose of picture `i` of `n`.
    pub fn robot_of(self, i: usize, n: usize) -> usize {
        match self {
            Order::Shifted(k) => (i + k) % n,
            Order::Reversed => n - 1 - i,
        }
    }
}

/// Median misfit beyond which captures agree on nothing: twice that of the poorest measured cell that is
/// known to be in order. degrees and mm.
pub const BELIEVABLE: (f64, f64) = (2.5, 15.0);
