//! Findings about the robot's poses, its arm, and what the user says of the camera's position.

use super::{Found, row::Row};

/// What is found about the robot.
#[derive(Debug, Clone, PartialEq)]
pub enum RobotFinding {
    /// Poses look inverted.
    Inverted {
        /// Which.
        which: Inverted,
        /// Median residual as declared (mm); `None` where nothing agrees at all.
        before_mm: Option<f64>,
        /// Median residual the other way, mm.
        after_mm: f64,
    },
    /// Its numbers mean something else than declared.
    OtherConvention {
        /// What they are, and what they are declared to be.
        words: String,
    },
    /// It moves farther or less far than it says, where the target's size is right.
    Scale {
        /// True over stated distances.
        value: f64,
        /// Its standard deviation.
        sigma: f64,
    },
    /// Robot poses beyond any robot's reach.
    LengthUnit {
        /// The farthest from the base, m.
        farthest_m: f64,
    },
    /// Target poses beyond any camera's sight.
    TargetLengthUnit {
        /// Their median distance from the camera, m.
        distance_m: f64,
    },
    /// The arm is not as its model says.
    ArmDeviates {
        /// Parameters that were corrected.
        parameters: usize,
        /// Error of the robot's position per axis with the given model, mm.
        before_mm: f64,
        /// With the corrected one, mm.
        after_mm: f64,
    },
    /// It errs alike at places near one another.
    ErrsByPlace {
        /// How far its position is off at a place, mm.
        position_mm: f64,
        /// How far its rotation is off, degrees.
        rotation_deg: f64,
        /// What it misses at the captures with the best rigid transform, mm.
        missed_mm: f64,
        /// By how much the logarithm of the likelihood gains.
        gain: f64,
        /// What captures miss that are left out in blocks (mm), with poses corrected and without, where that is offered.
        corrected: Option<(f64, f64)>,
    },
    /// Whether it errs by place is open, and that is much of the predicted error.
    MayErrByPlace {
        /// How likely it is, of 1.
        probability: f64,
        /// The predicted error (root mean square) with that in it, mm.
        predicted_mm: f64,
        /// The same if its errors are independent from pose to pose, mm.
        independent_mm: f64,
    },
    /// Joint values do not lead to the flange pose beside them.
    JointsAndPosesDiffer {
        /// Where, in words.
        at: String,
    },
    /// Something rests on the position that the user gave alone.
    DeterminedByKnownPosition {
        /// What, in words.
        what: String,
        /// The position, mm.
        given_mm: f64,
    },
    /// The data contradict the position that the user gave.
    KnownPositionDisagrees {
        /// As given, mm.
        given_mm: f64,
        /// As the data have it, mm.
        found_mm: f64,
    },
}

/// Poses that look inverted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Inverted {
    /// Those of the robot, or the setup is the other one.
    Robot,
    /// Either of them.
    Either,
}

impl Inverted {
    fn in_words(self) -> &'static str {
        match self {
            Self::Either => {
                "either the robot poses look inverted (flange_from_base), or the target poses (target_from_camera), or \
                 `setup` is declared wrongly (eye-in-hand or eye-to-hand); the data cannot tell between these"
            }
            Self::Robot => {
                "the robot poses look inverted (flange_from_base), or `setup` is declared wrongly (eye-in-hand or \
                 eye-to-hand)"
            }
        }
    }
}

impl RobotFinding {
    /// What was seen and where, with its numbers.
    pub(crate) fn message(&self) -> String {
        match self {
            Self::Inverted { which, before_mm, after_mm } => format!(
                "{}: with that the median residual falls from {} to {after_mm:.1} mm; check `direction` and `setup`",
                which.in_words(),
                before_mm.map_or("no agreement at all".into(), |mm| format!("{mm:.1} mm"))
            ),
            Self::OtherConvention { words } => words.clone(),
            Self::Scale { value, sigma } => format!(
                "the robot moves {value:.4} +- {sigma:.4} times as far as it says, and the target is as declared"
            ),
            Self::LengthUnit { farthest_m } => format!(
                "the robot poses lie up to {farthest_m:.0} m from the base: were millimetres read as metres? check the \
                 length unit"
            ),
            Self::TargetLengthUnit { distance_m } => format!(
                "the target poses lie {distance_m:.0} m from the camera: were millimetres read as metres? check the \
                 length unit"
            ),
            Self::ArmDeviates { parameters, before_mm, after_mm } => format!(
                "the arm differs from its model: with {parameters} parameters corrected, the error of the robot's position is {after_mm:.2} mm per axis instead of {before_mm:.2} mm. The result contains the corrected model (key `arm`), and the camera's pose for a robot that uses it; the answer itself is for the robot as it is"
            ),
            Self::ErrsByPlace { position_mm, rotation_deg, missed_mm, corrected, .. } => format!(
                "the robot's error depends on its pose: this robot errs by {position_mm:.2} mm{} from place to place, and the best fixed transform leaves {missed_mm:.2} mm RMS at the captures. More captures do not reduce that; {}",
                if *rotation_deg < 5e-4 {
                    String::new()
                } else {
                    format!(" and {rotation_deg:.3} degrees")
                },
                match corrected {
                    Some((with, without)) => format!(
                        "robot poses corrected with `handeye compensate` do: held-out captures then have {with:.2} mm RMS instead of {without:.2} mm"
                    ),
                    None =>
                        "a calibration of the robot's kinematics does, or captures in its work area only"
                            .into(),
                }
            ),
            Self::MayErrByPlace { probability, predicted_mm, independent_mm } => format!(
                "whether the robot's error depends on its pose is open: with a probability of {:.0} % it does, so the predicted error is {predicted_mm:.2} mm RMS instead of {independent_mm:.2} mm. Joint values and a model of the arm decide it; touches where the robot works verify the result",
                100.0 * probability
            ),
            Self::JointsAndPosesDiffer { at } => format!(
                "{at}: forward kinematics of the joint values does not give the flange pose of the same capture; check the \
                 arm's parameters, their units, and the order of the joints. The arm was not calibrated"
            ),
            Self::DeterminedByKnownPosition { what, given_mm } => format!(
                "the data do not determine {what}: it rests on `known_position` ({given_mm:.1} mm) alone, and nothing checks that; touch a corner, or tilt the robot"
            ),
            Self::KnownPositionDisagrees { given_mm, found_mm } => format!(
                "`known_position` says {given_mm:.1} mm, the data {found_mm:.1} mm: measure it again, or leave it out"
            ),
        }
    }
}

const POSES_INVERTED: Row = Row::rejects("poses-inverted", "correct `direction` or `setup`");
const ROBOT_POSES_INVERTED: Row =
    Row::rejects("robot-poses-inverted", "correct `direction` or `setup`");
const READING: Row = Row::info("reading");
const ROBOT_SCALE: Row = Row::info("robot-scale");
const ROBOT_LENGTH_UNIT: Row = Row::rejects("robot-length-unit", "correct `length_unit`");
const TARGET_LENGTH_UNIT: Row =
    Row::rejects("target-length-unit", "give robot and camera in the same unit");
const ARM_DEVIATES: Row = Row::changes(
    "arm-deviates",
    "the arm is not built as its model says, and the answer takes that into account",
    "use the corrected arm in programs that compute positions themselves",
);
const ROBOT_ERRS_BY_PLACE: Row = Row::changes(
    "robot-errs-by-place",
    "the robot's error depends on its pose, and no fixed transform is exact everywhere",
    "take captures in the work area, with the tool oriented as at work; have the robot's kinematics calibrated",
);
const ROBOT_MAY_ERR_BY_PLACE: Row = Row::info("robot-may-err-by-place");
const JOINTS_AND_POSES_DIFFER: Row = Row::info("joints-and-poses-differ");
const DETERMINED_BY_KNOWN_POSITION: Row = Row::info("determined-by-known-position");
const KNOWN_POSITION_DISAGREES: Row = Row::changes(
    "known-position-disagrees",
    "the data contradict the position that was given",
    "measure it again, or leave it out",
);

/// All codes of this subject.
pub(super) const ROWS: &[&Row] = &[
    &POSES_INVERTED,
    &ROBOT_POSES_INVERTED,
    &READING,
    &ROBOT_SCALE,
    &ROBOT_LENGTH_UNIT,
    &TARGET_LENGTH_UNIT,
    &ARM_DEVIATES,
    &ROBOT_ERRS_BY_PLACE,
    &ROBOT_MAY_ERR_BY_PLACE,
    &JOINTS_AND_POSES_DIFFER,
    &DETERMINED_BY_KNOWN_POSITION,
    &KNOWN_POSITION_DISAGREES,
];

impl Found for RobotFinding {
    fn row(&self) -> &'static Row {
        match self {
            Self::Inverted { which: Inverted::Either, .. } => &POSES_INVERTED,
            Self::Inverted { which: Inverted::Robot, .. } => &ROBOT_POSES_INVERTED,
            Self::OtherConvention { .. } => &READING,
            Self::Scale { .. } => &ROBOT_SCALE,
            Self::LengthUnit { .. } => &ROBOT_LENGTH_UNIT,
            Self::TargetLengthUnit { .. } => &TARGET_LENGTH_UNIT,
            Self::ArmDeviates { .. } => &ARM_DEVIATES,
            Self::ErrsByPlace { .. } => &ROBOT_ERRS_BY_PLACE,
            Self::MayErrByPlace { .. } => &ROBOT_MAY_ERR_BY_PLACE,
            Self::JointsAndPosesDiffer { .. } => &JOINTS_AND_POSES_DIFFER,
            Self::DeterminedByKnownPosition { .. } => &DETERMINED_BY_KNOWN_POSITION,
            Self::KnownPositionDisagrees { .. } => &KNOWN_POSITION_DISAGREES,
        }
    }

    fn message(&self) -> String {
        RobotFinding::message(self)
    }

    fn headline(&self) -> Option<String> {
        let Self::ErrsByPlace { missed_mm, .. } = self else { return None };
        Some(format!(
            "the robot's error depends on its pose: the best fixed transform leaves {missed_mm:.2} mm RMS at the captures"
        ))
    }

    fn data(&self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Inverted { before_mm, after_mm, .. } => {
                let before = before_mm.map(|mm| ("before_mm", mm));
                before.into_iter().chain([("after_mm", *after_mm)]).collect()
            }
            Self::Scale { value, sigma } => vec![("value", *value), ("sigma", *sigma)],
            Self::LengthUnit { farthest_m } => vec![("farthest_m", *farthest_m)],
            Self::TargetLengthUnit { distance_m } => vec![("distance_m", *distance_m)],
            Self::ArmDeviates { before_mm, after_mm, .. } => {
                vec![("before_mm", *before_mm), ("after_mm", *after_mm)]
            }
            Self::ErrsByPlace { position_mm, rotation_deg, missed_mm, gain, corrected } => {
                let corrected = corrected.map(|(with, _)| ("corrected_mm", with));
                let own = [
                    ("position_mm", *position_mm),
                    ("rotation_deg", *rotation_deg),
                    ("missed_mm", *missed_mm),
                    ("log_likelihood_gain", *gain),
                ];
                own.into_iter().chain(corrected).collect()
            }
            Self::MayErrByPlace { probability, predicted_mm, independent_mm } => vec![
                ("probability", *probability),
                ("predicted_mm", *predicted_mm),
                ("independent_mm", *independent_mm),
            ],
            Self::OtherConvention { .. } | Self::JointsAndPosesDiffer { .. } => vec![],
            Self::DeterminedByKnownPosition { given_mm, .. } => vec![("given_mm", *given_mm)],
            Self::KnownPositionDisagrees { given_mm, found_mm } => {
                vec![("given_mm", *given_mm), ("found_mm", *found_mm)]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inversion_has_a_code_for_each_kind() {
        let of = |which| RobotFinding::Inverted { which, before_mm: None, after_mm: 0.5 };
        assert_eq!(of(Inverted::Robot).row().code, "robot-poses-inverted");
        let either = of(Inverted::Either);
        assert_eq!(either.row().code, "poses-inverted");
        assert!(either.message().contains("falls from no agreement at all to 0.5 mm"));
    }
}
