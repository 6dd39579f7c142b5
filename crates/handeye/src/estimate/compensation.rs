//! What corrects a robot that errs by place: the errors that the fit found, carried to other poses.
//!
//! At a pose `A` that the robot reports, its flange is at `A exp(M e)`, where `e` is a twist along the axes of the base
//! and `M` turns it into those of the flange. `e` is a sum of waves ([`super::place`]): its value anywhere follows from
//! their strengths, which have mean and covariance after the fit. Corrected poses go with the camera's pose of that
//! fit, and not with the rigid answer, which has the mean of the errors in itself: both are exchanged here, so that
//! whoever computes with the rigid answer gets poses that are right with it.

use nalgebra::{DMatrix, DVector, Matrix6, Vector6};
use serde::{Deserialize, Serialize};

use super::place::{self, Kernel, Place};
use crate::{
    Anchor, Base, Camera, Flange, Mount, Pose, Setup, Target,
    math::lie,
    model::kinematics::{Arm, Deviation},
};

/// Errors of a robot, and what corrects them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Compensation {
    /// Who carries the camera.
    pub setup: Setup,
    /// The rigid answer, with which poses are computed.
    pub rigid: Pose<Mount, Camera>,
    /// Where the camera sits, for corrected poses.
    pub mount_from_camera: Pose<Mount, Camera>,
    /// Where the target sits, for corrected poses.
    pub anchor_from_target: Pose<Anchor, Target>,
    /// The robot's errors.
    pub errors: RobotErrors,
    /// Covariance of `mount_from_camera` (a step on the right, rotation first) and of what the errors are made of
    /// (strengths of waves, deviations of the arm): lower triangle, rows.
    pub covariance: Vec<f64>,
    /// What the robot errs beside, per axis: rad, m.
    pub robot: [f64; 2],
}

/// What a robot's errors are made of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RobotErrors {
    /// Waves over its poses, or over its joint values.
    ByPlace(ByPlace),
    /// An arm that is not as its model says.
    ByArm(ByArm),
}

/// Errors that go by the place where the robot is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ByPlace {
    /// How errors at two places go together.
    pub kernel: Kernel,
    /// The places that the waves are about.
    pub about: Vec<Place>,
    /// How much the correlation with each of those, a row, adds to each wave.
    pub waves: Vec<Vec<f64>>,
    /// Strength of each wave: rotation (rad), then position (m), along the axes of the base.
    pub strengths: Vec<[f64; 6]>,
    /// Size of the errors per axis, as they are before anything is known of a place: rad, m.
    pub level: [f64; 2],
    /// The arm, where errors go by its joints.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arm: Option<Arm>,
}

/// Errors that follow from the arm's joint values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ByArm {
    /// The arm as its controller believes it.
    pub given: Arm,
    /// The arm as it is.
    pub corrected: Arm,
    /// What may be otherwise still, in the order of the covariance.
    pub deviations: Vec<Deviation>,
    /// Where it was seen.
    pub seen: Vec<Place>,
}

/// A pose that was corrected.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Corrected {
    /// The pose.
    pub base_from_flange: Pose<Base, Flange>,
    /// Covariance of the flange there, rotation first, along its own axes: a step on the right.
    pub covariance: Matrix6<f64>,
    /// Share of the variance of errors here that goes with those at the captures; near zero where the robot was not seen.
    pub known: f64,
}

impl Corrected {
    /// Standard deviation of the position per axis, m.
    pub fn sigma_m(&self) -> f64 {
        (self.covariance.fixed_view::<3, 3>(3, 3).trace() / 3.0).max(0.0).sqrt()
    }

    /// Standard deviation of the rotation per axis, rad.
    pub fn sigma_rad(&self) -> f64 {
        (self.covariance.fixed_view::<3, 3>(0, 0).trace() / 3.0).max(0.0).sqrt()
    }

    /// Whether the robot was seen near there.
    pub fn is_inside(&self) -> bool {
        self.known > 1.0 - OUTSIDE
    }
}

/// A pose is outside of what was seen where more than this share of its error's variance is its own.
const OUTSIDE: f64 = 0.5;
/// Rounds until a command is found; each takes away all but a small part of what is left.
const ROUNDS: usize = 12;
/// A command is found when it changes by less than this (rad, m).
const STEP: f64 = 1e-12;

impl Compensation {
    /// What the robot must be sent to, for the pose that its flange should have: one that was computed with the rigid
    /// answer.
    pub fn command(&self, wanted: &Pose<Base, Flange>) -> Corrected {
        let carried = match self.setup {
            // where the camera sees something is where it is, whoever looks
            Setup::EyeInHand => nalgebra::Isometry3::identity(),
            Setup::EyeToHand => *(self.mount_from_camera.rename::<Base, Camera>()
                * self.rigid.rename::<Base, Camera>().inverse())
            .iso(),
        };
        let wanted: Pose<Base, Flange> = Pose::claim(carried * wanted.iso());
        let found = self.errors.undone(&wanted);
        let command = found.unwrap_or(wanted);
        let of_camera = match self.setup {
            Setup::EyeInHand => Matrix6::zeros(),
            Setup::EyeToHand => -lie::adjoint((wanted.inverse() * self.on_base()).iso()),
        };
        let corrected = self.judged(&command, command, &of_camera);
        // where no joint values lead there, nothing is corrected
        Corrected { known: if found.is_some() { corrected.known } else { 0.0 }, ..corrected }
    }

    /// The pose that goes with the rigid answer, for one that the robot reported.
    pub fn actual(&self, reported: &Pose<Base, Flange>) -> Corrected {
        let really = reported.retract(&self.errors.at(reported));
        let exchanged = match self.setup {
            Setup::EyeInHand => {
                really.iso() * self.mount_from_camera.iso() * self.rigid.iso().inverse()
            }
            Setup::EyeToHand => {
                self.rigid.iso() * self.mount_from_camera.iso().inverse() * really.iso()
            }
        };
        let exchanged: Pose<Base, Flange> = Pose::claim(exchanged);
        let of_camera = match self.setup {
            Setup::EyeInHand => lie::adjoint(self.rigid.iso()),
            Setup::EyeToHand => -lie::adjoint((really.inverse() * self.on_base()).iso()),
        };
        self.judged(reported, exchanged, &of_camera)
    }

    /// Whether its numbers fit together: one that was read from a file may have been changed there.
    pub fn is_whole(&self) -> bool {
        let has_joints = |arm: &Arm, all: &[Place]| {
            arm.check().is_ok() && all.iter().all(|p| p.joints.len() == arm.joints.len())
        };
        let unknowns = match &self.errors {
            RobotErrors::ByPlace(ByPlace { about, waves, strengths, arm, .. }) => {
                let is_table = waves.len() == about.len()
                    && waves.iter().all(|row| row.len() == strengths.len());
                let by_joints = arm.as_ref().is_none_or(|arm| has_joints(arm, about));
                (is_table && by_joints).then_some(6 * strengths.len())
            }
            RobotErrors::ByArm(ByArm { given, corrected, deviations, seen }) => {
                let fits = has_joints(given, seen)
                    && has_joints(corrected, seen)
                    && deviations.iter().all(|d| d.joint < given.joints.len());
                (fits && !seen.is_empty()).then_some(deviations.len())
            }
        };
        let rows = |n: usize| (6 + n) * (7 + n) / 2;
        unknowns.is_some_and(|n| self.covariance.len() == rows(n))
    }

    /// The camera on the base, eye-to-hand.
    fn on_base(&self) -> Pose<Base, Camera> {
        self.mount_from_camera.rename()
    }

    /// With the covariance at the `place` that the robot reports there.
    fn judged(
        &self,
        place: &Pose<Base, Flange>,
        base_from_flange: Pose<Base, Flange>,
        of_camera: &Matrix6<f64>,
    ) -> Corrected {
        let by = self.errors.by_unknowns(place);
        let ([turn, shift], ByUnknowns { unknowns, known, .. }) = (by.rest(), by);
        let n = unknowns.ncols();
        let mut by_all = DMatrix::zeros(6, 6 + n);
        by_all.view_mut((0, 0), (6, 6)).copy_from(of_camera);
        by_all.view_mut((0, 6), (6, n)).copy_from(&unknowns);
        let own = &by_all * self.full_covariance(6 + n) * by_all.transpose();
        let (turn, shift) = (turn + self.robot[0].powi(2), shift + self.robot[1].powi(2));
        let rest = Vector6::new(turn, turn, turn, shift, shift, shift);
        let covariance = own.fixed_view::<6, 6>(0, 0) + Matrix6::from_diagonal(&rest);
        Corrected { base_from_flange, covariance, known }
    }

    fn full_covariance(&self, n: usize) -> DMatrix<f64> {
        let at = |i: usize, j: usize| self.covariance.get(i * (i + 1) / 2 + j).copied();
        DMatrix::from_fn(n, n, |i, j| at(i.max(j), i.min(j)).unwrap_or(0.0))
    }
}

/// How errors move with what they are made of.
pub(crate) struct ByUnknowns {
    /// A step on the right, for each.
    pub unknowns: DMatrix<f64>,
    /// Size of errors of which nothing is known: rad, m.
    level: [f64; 2],
    /// Share of their variance that is.
    known: f64,
}

impl ByUnknowns {
    /// Errors that follow from their unknowns alone.
    pub fn wholly_known(unknowns: DMatrix<f64>) -> Self {
        Self { unknowns, level: [0.0; 2], known: 1.0 }
    }

    /// Variance per axis (rad², m²) of what that does not tell.
    pub fn rest(&self) -> [f64; 2] {
        self.level.map(|level| level.powi(2) * (1.0 - self.known))
    }
}

impl RobotErrors {
    /// The robot's error at a pose that it reports: a step on the right.
    fn at(&self, reported: &Pose<Base, Flange>) -> Vector6<f64> {
        match self {
            Self::ByPlace(place) => place.at(&place.place(reported)),
            Self::ByArm(arm) => {
                let really = arm.joints(reported).map(|q| arm.corrected.base_from_flange(&q));
                really.map_or_else(Vector6::zeros, |r| reported.local(&r))
            }
        }
    }

    /// The pose that the robot must report to be there; `None` where its arm does not reach.
    fn undone(&self, wanted: &Pose<Base, Flange>) -> Option<Pose<Base, Flange>> {
        if let Self::ByArm(arm) = self {
            let joints = arm.corrected.inverse(wanted, &nearest_joints(&arm.seen, wanted))?;
            return Some(arm.given.base_from_flange(&joints));
        }
        let mut command = *wanted;
        for _ in 0..ROUNDS {
            let next = wanted.retract(&-self.at(&command));
            let step = command.local(&next).amax();
            command = next;
            if step < STEP {
                break;
            }
        }
        Some(command)
    }

    fn by_unknowns(&self, reported: &Pose<Base, Flange>) -> ByUnknowns {
        match self {
            Self::ByPlace(place) => place.by_unknowns(&place.place(reported)),
            Self::ByArm(arm) => match arm.joints(reported) {
                Some(q) => {
                    ByUnknowns::wholly_known(arm.corrected.by_deviations(&q, &arm.deviations))
                }
                None => ByUnknowns { unknowns: DMatrix::zeros(6, 0), level: [0.0; 2], known: 0.0 },
            },
        }
    }
}

impl ByArm {
    fn joints(&self, reported: &Pose<Base, Flange>) -> Option<Vec<f64>> {
        self.given.inverse(reported, &nearest_joints(&self.seen, reported))
    }
}

impl ByPlace {
    /// The robot's error at a place: a step on the right.
    pub(crate) fn at(&self, place: &Place) -> Vector6<f64> {
        let waves = self.waves_at(place);
        let sum = waves.iter().zip(&self.strengths);
        let twist = sum.fold(Vector6::zeros(), |all, (wave, s)| all + Vector6::from(*s) * *wave);
        place::of_flange(&place.base_from_flange) * twist
    }

    /// How that moves with the strengths.
    pub(crate) fn by_unknowns(&self, place: &Place) -> ByUnknowns {
        let waves = self.waves_at(place);
        let m = place::of_flange(&place.base_from_flange);
        let mut unknowns = DMatrix::zeros(6, 6 * waves.len());
        for (k, wave) in waves.iter().enumerate() {
            unknowns.view_mut((0, 6 * k), (6, 6)).copy_from(&(m * *wave));
        }
        ByUnknowns { unknowns, level: self.level, known: waves.norm_squared().min(1.0) }
    }

    /// The place of a pose that the robot reports: joint values only where the arm is known.
    fn place(&self, flange: &Pose<Base, Flange>) -> Place {
        let joints = |arm: &Arm| arm.inverse(flange, &nearest_joints(&self.about, flange));
        Place::new(flange, &self.arm.as_ref().and_then(joints).unwrap_or_default())
    }

    fn waves_at(&self, place: &Place) -> DVector<f64> {
        let mut waves = DVector::zeros(self.strengths.len());
        for (about, row) in self.about.iter().zip(&self.waves) {
            let near = self.kernel.at(place, about);
            waves.iter_mut().zip(row).for_each(|(w, by)| *w += near * by);
        }
        waves
    }
}

/// The joint values of the place nearest to a pose.
fn nearest_joints(places: &[Place], flange: &Pose<Base, Flange>) -> Vec<f64> {
    let far = |p: &&Place| {
        let d = p.base_from_flange.local(flange);
        lie::nu(&d).norm() + ARM_LENGTH * lie::omega(&d).norm()
    };
    let near = places.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
    near.map(|p| p.joints.clone()).unwrap_or_default()
}

/// A turn of the flange counts as that of a point so far from it, m.
const ARM_LENGTH: f64 = 0.3;

/// The lower triangle of a symmetric matrix, row by row.
pub(crate) fn triangle(m: &DMatrix<f64>) -> Vec<f64> {
    (0..m.nrows()).flat_map(|i| (0..=i).map(move |j| m[(i, j)])).collect()
}
