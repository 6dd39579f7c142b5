//! Findings about captures that do not count, and whether those that do are enough.

use super::{Found, row::Row};

/// What is found about captures.
#[derive(Debug, Clone, PartialEq)]
pub enum CaptureFinding {
    /// One does not agree with the others.
    Rejected {
        /// Its name.
        capture: String,
        /// Why, as far as that is known.
        cause: Cause,
    },
    /// Many do not agree with the others.
    ManyRejected {
        /// Their names.
        captures: Vec<String>,
        /// All captures.
        of: usize,
    },
    /// Too few to notice a wrong one.
    Few {
        /// How many agree.
        used: usize,
        /// Whether they show a ball.
        of_a_ball: bool,
    },
    /// Some repeat others.
    Repeated {
        /// Their names.
        captures: Vec<String>,
    },
    /// Some were taken beside others, and the robot errs by place.
    OfOnePlace {
        /// Their names.
        captures: Vec<String>,
    },
    /// In one other order of all robot poses captures agree.
    OutOfOrder {
        /// Which.
        order: ListedOrder,
        /// A capture whose image belongs to the robot pose of the other one.
        example: [String; 2],
        /// Captures that agree then.
        agreeing: usize,
        /// All captures.
        of: usize,
        /// Within how much, mm.
        within_mm: f64,
    },
    /// The images of some were exchanged, in pairs.
    ImagesExchanged {
        /// Their names, pair by pair.
        captures: Vec<String>,
    },
    /// Some have one robot pose, though the camera saw the target move.
    RobotStill {
        /// Their names.
        captures: Vec<String>,
    },
    /// Some show the target in the same position, though the robot moved.
    CameraStill {
        /// Their names.
        captures: Vec<String>,
    },
    /// Some agree with no others, and nothing known explains them.
    Disagreeing {
        /// Their names.
        captures: Vec<String>,
    },
    /// Too few agree to outvote the others.
    NoMajority {
        /// How many agree.
        used: usize,
        /// All that show the target.
        of: usize,
    },
    /// Others agree on another answer.
    TwoAnswers {
        /// How many agree on the first.
        used: usize,
        /// How many on the second.
        others: usize,
        /// All that do not agree on the first.
        rest: usize,
    },
    /// Most captures do not show what they are of.
    MostMissing(MostMissing),
    /// A method that needs rotations, for captures of a ball.
    MethodNotForBalls {
        /// The method's name.
        method: &'static str,
    },
}

/// Captures that do not show what they are of.
#[derive(Debug, Clone, PartialEq)]
pub struct MostMissing {
    /// What they are of.
    pub shown: Shown,
    /// How many do not show it.
    pub missing: usize,
    /// All captures.
    pub of: usize,
    /// One of them.
    pub capture: String,
    /// What is known of that one.
    pub reason: String,
}

/// What captures are of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// A target, in images.
    Target,
    /// A still scene, in scans.
    Scene,
    /// An object of known shape, in scans.
    Object,
}

impl MostMissing {
    fn message(&self) -> String {
        let Self { missing, of, capture, reason, .. } = self;
        match self.shown {
            Shown::Target => format!(
                "the target was not found in {missing} images of {of} captures ({capture}: {reason}): check [target]"
            ),
            Shown::Scene => format!(
                "{missing} of {of} scans could not be registered to the scene ({capture}: {reason}): scan a scene with shape on \
                 all sides, from poses with large overlap"
            ),
            Shown::Object => format!(
                "{missing} of {of} scans do not show the object ({capture}: {reason}): check [object]"
            ),
        }
    }
}

/// Another order of robot poses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ListedOrder {
    /// The opposite one.
    Reversed,
    /// So many places before.
    Before(usize),
    /// So many places after.
    After(usize),
}

/// Why a capture does not agree. `seen` is what poses come from: `image` or `target pose`.
#[derive(Debug, Clone, PartialEq)]
pub enum Cause {
    /// It fits with the target rotated in its plane.
    TargetRotated {
        /// By how many degrees.
        degrees: u32,
        /// About which point of its plane (mm), where that is not the middle of its corners.
        about_mm: Option<[f64; 2]>,
        /// Whether its corners were detected; poses came from elsewhere otherwise.
        has_corners: bool,
    },
    /// What it shows and that of another one look exchanged.
    Exchanged {
        /// What poses come from.
        seen: &'static str,
        /// The other one's name.
        with: String,
    },
    /// What it shows fits the robot pose of another one.
    FitsPoseOf {
        /// What poses come from.
        seen: &'static str,
        /// The other one.
        other: Other,
    },
    /// Its robot pose belongs to what another one shows.
    HasPoseOf {
        /// What poses come from.
        seen: &'static str,
        /// The other one.
        other: Other,
    },
    /// It disagrees, and nothing known restores it.
    Disagrees {
        /// By how much, mm.
        distance_mm: f64,
        /// By which angle, degrees.
        angle_deg: f64,
        /// Distance of its robot pose from the base (m), where no robot reaches that far.
        out_of_reach_m: Option<f64>,
    },
}

/// Another capture, as seen from one.
#[derive(Debug, Clone, PartialEq)]
pub struct Other {
    /// Its name.
    pub name: String,
    /// Where it stands.
    pub stands: Stands,
}

/// Where another capture stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stands {
    /// Right before.
    Before,
    /// Right after.
    After,
    /// Elsewhere.
    Elsewhere,
}

impl Other {
    fn in_words(&self) -> String {
        match self.stands {
            Stands::After => format!("the next capture, {}", self.name),
            Stands::Before => format!("the previous capture, {}", self.name),
            Stands::Elsewhere => format!("capture {}", self.name),
        }
    }
}

impl Cause {
    fn row(&self) -> &'static Row {
        match self {
            Self::TargetRotated { .. } => &TARGET_TURNED,
            Self::Exchanged { .. } => &CAPTURES_EXCHANGED,
            Self::FitsPoseOf { other, .. } => match other.stands {
                Stands::Elsewhere => &CAPTURES_EXCHANGED,
                _ => &ORDER_SHIFTED,
            },
            Self::HasPoseOf { other, .. } => match other.stands {
                Stands::After => &ORDER_SHIFTED,
                _ => &STALE_ROBOT_POSE,
            },
            Self::Disagrees { .. } => &CAPTURE_REJECTED,
        }
    }

    /// Why, in words.
    pub fn in_words(&self) -> String {
        match self {
            Self::TargetRotated { degrees, about_mm, has_corners } => format!(
                "it fits with the target rotated by {degrees} degrees{}: {}",
                about_mm.map_or(String::new(), |[x, y]| {
                    format!(" about ({x:.0}, {y:.0}) mm of its own plane")
                }),
                if *has_corners {
                    "its corners are numbered from another end than in the other images; detect it again, or renumber them"
                } else {
                    "its pose was found flipped against the other captures"
                }
            ),
            Self::Exchanged { seen, with } => format!(
                "its {seen} and that of capture {with} look exchanged; if they are, exchange them in the data"
            ),
            Self::FitsPoseOf { seen, other } => {
                let fits = format!("its {seen} fits the robot pose of {}", other.in_words());
                match other.stands {
                    Stands::Elsewhere => fits,
                    _ => {
                        fits + ": from here on images and robot poses seem shifted by one capture; if so, correct the order"
                    }
                }
            }
            Self::HasPoseOf { seen, other } => match other.stands {
                Stands::After => format!(
                    "its robot pose belongs to the {seen} of {}; its own is missing",
                    other.in_words()
                ),
                _ => format!(
                    "its robot pose equals that of {}, but its {seen} differs: the pose was read before the robot moved; \
                     its own pose is missing",
                    other.in_words()
                ),
            },
            Self::Disagrees { distance_mm, angle_deg, out_of_reach_m } => format!(
                "it disagrees with the others by {distance_mm:.1} mm and {angle_deg:.2} degrees: {}",
                out_of_reach_m.map_or(
                    "a robot pose of another moment, a moved target, or a wrong detection".into(),
                    |m| format!("its robot pose lies {m:.0} m from the base: were millimetres read as metres?")
                )
            ),
        }
    }
}

impl CaptureFinding {
    /// Whether images and robot poses are out of order.
    pub(crate) fn says_out_of_order(&self) -> bool {
        match self {
            Self::OutOfOrder { .. } => true,
            Self::Rejected { cause: Cause::FitsPoseOf { other, .. }, .. } => {
                other.stands != Stands::Elsewhere
            }
            Self::Rejected { cause: Cause::HasPoseOf { other, .. }, .. } => {
                other.stands == Stands::After
            }
            _ => false,
        }
    }

    /// What was seen and where, with its numbers.
    pub(crate) fn message(&self) -> String {
        match self {
            Self::Rejected { capture, cause } => {
                format!("capture {capture} rejected: {}", cause.in_words())
            }
            Self::ManyRejected { captures, of } => format!(
                "{} of {of} captures disagree with the others and are rejected: {}",
                captures.len(),
                captures.join(", ")
            ),
            Self::Few { used, of_a_ball } => few(*used, *of_a_ball),
            Self::Repeated { captures } => format!(
                "captures {} repeat others (same robot pose, same view): the robot's error is the same in all of them, so one capture of each pose counts",
                first_of(captures)
            ),
            Self::OfOnePlace { captures } => format!(
                "captures {} were taken within 6 mm and 0.6 degrees of others, and the robot's error there is the same \
                 in all of them: one capture of each position counts. Spread the captures over the workspace",
                first_of(captures)
            ),
            Self::OutOfOrder { order, example, agreeing, of, within_mm } => {
                let paired = format!(
                    ": paired so, {agreeing} of {of} captures agree, within {within_mm:.1} mm"
                );
                let paired = if 2 * agreeing > *of { paired } else { String::new() };
                format!("{}{paired}; correct the order of the files", order.in_words(example))
            }
            Self::ImagesExchanged { captures } => format!(
                "the images of these captures are exchanged: {}; exchange the files, or leave them out",
                captures.join(", ")
            ),
            Self::RobotStill { captures } => format!(
                "these captures have one and the same robot pose, but the camera saw the target move: the pose was not \
                 read anew; leave them out: {}",
                captures.join(", ")
            ),
            Self::CameraStill { captures } => format!(
                "these captures show the target in the same place, but the robot moved: images were stored twice, or \
                 target and camera are mounted on the same body: {}",
                captures.join(", ")
            ),
            Self::Disagreeing { captures } => format!(
                "these captures agree with no others, and no single mistake explains them; look at their images and \
                 robot poses, or leave them out: {}",
                captures.join(", ")
            ),
            Self::NoMajority { used, of } => format!(
                "only {used} of {of} captures agree: too few to outvote the others; take more captures, or find out \
                 what was wrong with these"
            ),
            Self::TwoAnswers { used, others, rest } => format!(
                "{used} captures agree on one answer and {others} of the other {rest} on another one: the data cannot \
                 tell which is right; check what changed between them"
            ),
            Self::MostMissing(missing) => missing.message(),
            Self::MethodNotForBalls { method } => {
                format!("a ball shows no rotation: the method {method} cannot use it")
            }
        }
    }
}

fn few(used: usize, of_a_ball: bool) -> String {
    if of_a_ball {
        return format!("only {used} captures agree: too few to estimate the noise well");
    }
    format!(
        "only {used} captures: too few to notice a wrong one or to estimate the noise well; take 10 to 15"
    )
}

const TARGET_TURNED: Row = Row::info("target-turned");
const CAPTURES_EXCHANGED: Row = Row::info("captures-exchanged");
const ORDER_SHIFTED: Row = Row::changes(
    "order-shifted",
    "captures were rejected because images and robot poses are out of order",
    "correct the order of the files or lines",
);
const STALE_ROBOT_POSE: Row = Row::info("stale-robot-pose");
const CAPTURE_REJECTED: Row = Row::info("capture-rejected");
const CAPTURES_REJECTED: Row = Row::changes(
    "captures-rejected",
    "many captures were rejected as outliers",
    "find out what they have in common: something moved, or the robot errs there",
);
const FEW_CAPTURES: Row = Row::info("few-captures");
const CAPTURES_REPEATED: Row = Row::info("captures-repeated");
const CAPTURES_OF_ONE_PLACE: Row = Row::info("captures-of-one-place");
const ROBOT_POSE_FROZEN: Row = Row::info("robot-pose-frozen");
const CAMERA_STILL: Row = Row::info("camera-still");
const CAPTURES_DISAGREE: Row = Row::info("captures-disagree");
const NO_CLEAR_MAJORITY: Row =
    Row::rejects("no-clear-majority", "find out what changed in the session, and take it again");
const SCANS_NOT_PLACED: Row = Row::info("scans-not-placed");
const TARGET_NOT_FOUND: Row = Row::info("target-not-found");
const METHOD_NOT_FOR_BALLS: Row = Row::info("method-not-for-balls");

/// All codes of this subject.
pub(super) const ROWS: &[&Row] = &[
    &TARGET_TURNED,
    &CAPTURES_EXCHANGED,
    &ORDER_SHIFTED,
    &STALE_ROBOT_POSE,
    &CAPTURE_REJECTED,
    &CAPTURES_REJECTED,
    &FEW_CAPTURES,
    &CAPTURES_REPEATED,
    &CAPTURES_OF_ONE_PLACE,
    &ROBOT_POSE_FROZEN,
    &CAMERA_STILL,
    &CAPTURES_DISAGREE,
    &NO_CLEAR_MAJORITY,
    &SCANS_NOT_PLACED,
    &TARGET_NOT_FOUND,
    &METHOD_NOT_FOR_BALLS,
];

impl Found for CaptureFinding {
    fn row(&self) -> &'static Row {
        match self {
            Self::Rejected { cause, .. } => cause.row(),
            Self::ManyRejected { .. } => &CAPTURES_REJECTED,
            Self::Few { .. } => &FEW_CAPTURES,
            Self::Repeated { .. } => &CAPTURES_REPEATED,
            Self::OfOnePlace { .. } => &CAPTURES_OF_ONE_PLACE,
            Self::OutOfOrder { .. } => &ORDER_SHIFTED,
            Self::ImagesExchanged { .. } => &CAPTURES_EXCHANGED,
            Self::RobotStill { .. } => &ROBOT_POSE_FROZEN,
            Self::CameraStill { .. } => &CAMERA_STILL,
            Self::Disagreeing { .. } => &CAPTURES_DISAGREE,
            Self::NoMajority { .. } | Self::TwoAnswers { .. } => &NO_CLEAR_MAJORITY,
            Self::MostMissing(MostMissing { shown: Shown::Scene, .. }) => &SCANS_NOT_PLACED,
            Self::MostMissing(_) => &TARGET_NOT_FOUND,
            Self::MethodNotForBalls { .. } => &METHOD_NOT_FOR_BALLS,
        }
    }

    fn message(&self) -> String {
        CaptureFinding::message(self)
    }

    fn data(&self) -> Vec<(&'static str, f64)> {
        let count = |n: &usize| *n as f64;
        match self {
            Self::Rejected { cause: Cause::Disagrees { distance_mm, angle_deg, .. }, .. } => {
                vec![("distance_mm", *distance_mm), ("angle_deg", *angle_deg)]
            }
            Self::ManyRejected { captures, of } => {
                vec![("rejected", captures.len() as f64), ("of", count(of))]
            }
            Self::Few { used, .. } => vec![("used", count(used))],
            Self::Repeated { captures }
            | Self::OfOnePlace { captures }
            | Self::ImagesExchanged { captures }
            | Self::RobotStill { captures }
            | Self::CameraStill { captures }
            | Self::Disagreeing { captures } => vec![("captures", captures.len() as f64)],
            Self::OutOfOrder { agreeing, of, within_mm, .. } => {
                vec![("agreeing", count(agreeing)), ("of", count(of)), ("within_mm", *within_mm)]
            }
            Self::NoMajority { used, of } => vec![("used", count(used)), ("of", count(of))],
            Self::TwoAnswers { used, others, rest } => {
                vec![("used", count(used)), ("others", count(others)), ("rest", count(rest))]
            }
            Self::MostMissing(found) => {
                vec![("missing", count(&found.missing)), ("of", count(&found.of))]
            }
            Self::Rejected { .. } | Self::MethodNotForBalls { .. } => vec![],
        }
    }
}

impl ListedOrder {
    fn in_words(self, [image, pose]: &[String; 2]) -> String {
        let captures = |count: usize| if count == 1 { "capture" } else { "captures" };
        let which = match self {
            Self::Reversed => {
                return "images and robot poses are in opposite orders: the first image belongs to the last robot pose"
                    .into();
            }
            Self::Before(count) => format!("{count} {} back", captures(count)),
            Self::After(count) => format!("{count} {} further on", captures(count)),
        };
        format!(
            "images and robot poses are in different orders: each image belongs to the robot pose {which}, \
             cyclic (the image of capture {image} to the robot pose of {pose})"
        )
    }
}

/// So many captures are named.
const NAMED: usize = 6;

fn first_of(captures: &[String]) -> String {
    let named = captures[..captures.len().min(NAMED)].join(", ");
    match captures.len().saturating_sub(NAMED) {
        0 => named,
        more => format!("{named} and {more} more"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_neighbour_means_a_shifted_order_and_another_one_an_exchange() {
        let of = |stands| Cause::FitsPoseOf {
            seen: "image",
            other: Other { name: "007".into(), stands },
        };
        assert_eq!(of(Stands::After).row().code, "order-shifted");
        assert!(of(Stands::After).in_words().contains("the next capture, 007: from here on"));
        assert_eq!(of(Stands::Elsewhere).row().code, "captures-exchanged");
        assert!(of(Stands::Elsewhere).in_words().ends_with("capture 007"));
    }

    #[test]
    fn a_shift_is_said_with_an_example_and_with_what_agrees_where_most_do() {
        let of = |order, agreeing| {
            CaptureFinding::OutOfOrder {
                order,
                example: ["002".into(), "001".into()],
                agreeing,
                of: 15,
                within_mm: 0.52,
            }
            .message()
        };
        assert_eq!(
            of(ListedOrder::Before(1), 14),
            "images and robot poses are in different orders: each image belongs to the robot pose 1 capture back, \
             cyclic (the image of capture 002 to the robot pose of 001): paired so, 14 of 15 captures agree, \
             within 0.5 mm; correct the order of the files"
        );
        let few = of(ListedOrder::After(2), 7);
        assert!(few.contains("2 captures further on") && !few.contains("agree"), "{few}");
        assert!(of(ListedOrder::Reversed, 0).contains("in opposite orders"));
    }

    #[test]
    fn six_captures_are_named_and_the_others_counted() {
        let captures: Vec<String> = (1..=8).map(|k| k.to_string()).collect();
        assert_eq!(first_of(&captures), "1, 2, 3, 4, 5, 6 and 2 more");
        assert_eq!(first_of(&captures[..6]), "1, 2, 3, 4, 5, 6");
    }
}
