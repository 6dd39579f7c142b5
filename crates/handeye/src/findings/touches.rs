//! Findings about touches, point pairs and the tool's tip.

use super::{Found, row::Row};

/// What is found about touches.
#[derive(Debug, Clone, PartialEq)]
pub enum TouchFinding {
    /// One is too far from where all other data put its corner.
    Outlier {
        /// The corner's id.
        corner: u32,
        /// The placement of the board.
        placement: String,
        /// Chance of a distance as large.
        p_value: f64,
    },
    /// One is too far from where views and the other touches put its corner.
    Misplaced {
        /// The corner's id.
        corner: u32,
        /// The placement of the board.
        placement: String,
        /// How far, mm.
        off_mm: f64,
        /// The corner with whose touch it looks exchanged.
        exchanged_with: Option<u32>,
    },
    /// Most of them contradict the views.
    Misread {
        /// What would explain it, or what to check.
        answer: String,
        /// Touches that agree with one tip.
        agreeing: usize,
        /// All touches.
        of: usize,
        /// Median distance from where the views put their corners, mm.
        off_mm: f64,
    },
    /// The tool's tip is not where the robot has it.
    TipOff {
        /// Its best estimate minus what was given, mm.
        offset_mm: [f64; 3],
        /// Whether that is in the frame of the flange; in that of the base otherwise.
        in_flange: bool,
        /// Chance of an estimate as large when the tip is right.
        p_value: f64,
        /// As many squares of the board as the offset is long.
        squares: Option<u32>,
    },
    /// Views and touches disagree, and no tip explains it.
    ViewsDisagree {
        /// Chance of a difference as large.
        p_value: f64,
    },
    /// Too few for a candidate.
    NotEnough {
        /// Its name.
        candidate: String,
        /// Why.
        error: String,
    },
    /// No view shows the touched corners.
    WithoutView {
        /// The placement of the board.
        placement: String,
        /// Ids of the touched corners.
        corners: Vec<u32>,
        /// Why.
        unseen: Unseen,
    },
    /// The same touch is listed several times.
    Repeated {
        /// The corner's id.
        corner: u32,
        /// The placement of the board.
        placement: String,
        /// How often.
        count: usize,
    },
    /// A ball has no corners to touch.
    OfABall,
    /// Point pairs lie nearly on a line.
    NearlyCollinear {
        /// Spread across the line over that along it.
        ratio: f64,
    },
    /// They name placements, where the one board of the views was touched (eye-in-hand).
    PlacementsIgnored {
        /// The placements.
        names: Vec<String>,
    },
    /// They alone determine what views do not.
    AloneDetermine {
        /// What, in words.
        what: String,
    },
}

/// Why no view shows touched corners.
#[derive(Debug, Clone, PartialEq)]
pub enum Unseen {
    /// The placement's image does not show the target, for this reason.
    NotFound(String),
    /// The placement has neither image nor corners.
    NothingSeen,
    /// There is no such placement.
    NoPlacement,
}

impl TouchFinding {
    /// What was seen and where, with its numbers.
    pub(crate) fn message(&self) -> String {
        match self {
            Self::Outlier { corner, placement, p_value } => format!(
                "the touch of corner {corner} of {placement:?} is rejected: it is too far from where all other data put that corner (p = {p_value:.0e}): a wrong corner id, or the tip slipped. Check the id, and touch the corner again"
            ),
            Self::Misplaced { corner, placement, off_mm, exchanged_with } => format!(
                "the touch of corner {corner} of {placement:?} is rejected: it is {off_mm:.1} mm from where views and \
                 other touches put that corner{}",
                exchanged_with.map_or(": a wrong corner id, or the tip slipped. Check the id, and touch the corner again".into(), |other| {
                    format!("; it looks exchanged with that of corner {other}")
                })
            ),
            Self::Misread { answer, agreeing, of, off_mm } => format!(
                "images and touches contradict each other: {answer}. As declared, only {agreeing} of {of} touches fit one \
                 common tool tip, and half of the touches are more than {off_mm:.0} mm from where the images put their \
                 corners"
            ),
            Self::TipOff { offset_mm, in_flange, p_value, squares } => {
                tip_off(offset_mm, *in_flange, *p_value, *squares)
            }
            Self::ViewsDisagree { p_value } => format!(
                "images and touches disagree (p = {p_value:.1e}), and a wrong tool tip does not explain it. Possible causes: the robot's error where it touched differs from that at the captures; images and robot poses were not taken at the same time; images and scans are not aligned. The result is valid near the touched points only"
            ),
            Self::NotEnough { candidate, error } => format!("no {candidate} candidate: {error}"),
            Self::WithoutView { placement, corners, unseen } => {
                without_view(placement, corners, unseen)
            }
            Self::Repeated { corner, placement, count } => format!(
                "the touch of corner {corner} of {placement:?} is listed {count} times with the same numbers and \
                 counts once: touch the corner anew for a second measurement"
            ),
            Self::OfABall => "a ball has no corners: the touches are not used".into(),
            Self::NearlyCollinear { ratio } => format!(
                "the points lie nearly on one line (their spread across it is {:.0} % of that along it): the rotation about that line is poorly determined; add points away from it",
                ratio * 100.0
            ),
            Self::PlacementsIgnored { names } => format!(
                "with eye-in-hand, touches are of the one board that the views show, and placements ({}) are ignored: if \
                 another board was touched, leave its touches out",
                names.join(", ")
            ),
            Self::AloneDetermine { what } => format!(
                "the images do not determine {what}: only the touches do, and nothing checks them; tilt the robot \
                 about a second axis if it can"
            ),
        }
    }
}

const TOUCH_REJECTED: Row = Row::changes(
    "touch-rejected",
    "a touch was rejected as an outlier",
    "check the corner id of that touch, and touch it again",
);
const TOUCHES_MISREAD: Row = Row::info("touches-misread");
const TIP_OFF: Row = Row::changes(
    "tip-off",
    "the answer corrects the tool's tip",
    "calibrate the tool again (`handeye tcp`)",
);
const VIEWS_AND_TOUCHES_DISAGREE: Row = Row::changes(
    "views-and-touches-disagree",
    "images and touches disagree, and the result is valid near the touched points only",
    "touch corners in the work area, and check the alignment of images and scans and their time stamps",
);
const TOUCHES_NOT_ENOUGH: Row = Row::info("touches-not-enough");
const TOUCH_WITHOUT_VIEW: Row = Row::info("touch-without-view");
const TOUCH_REPEATED: Row = Row::info("touch-repeated");
const TOUCHES_WITHOUT_CORNERS: Row = Row::info("touches-without-corners");
const TOUCH_PLACEMENTS_IGNORED: Row = Row::info("touch-placements-ignored");
const POINTS_NEARLY_COLLINEAR: Row = Row::info("points-nearly-collinear");
const DETERMINED_BY_TOUCHES: Row = Row::info("determined-by-touches");

/// All codes of this subject.
pub(super) const ROWS: &[&Row] = &[
    &TOUCH_REJECTED,
    &TOUCHES_MISREAD,
    &TIP_OFF,
    &VIEWS_AND_TOUCHES_DISAGREE,
    &TOUCHES_NOT_ENOUGH,
    &TOUCH_WITHOUT_VIEW,
    &TOUCH_REPEATED,
    &TOUCHES_WITHOUT_CORNERS,
    &TOUCH_PLACEMENTS_IGNORED,
    &POINTS_NEARLY_COLLINEAR,
    &DETERMINED_BY_TOUCHES,
];

impl Found for TouchFinding {
    fn row(&self) -> &'static Row {
        match self {
            Self::Outlier { .. } | Self::Misplaced { .. } => &TOUCH_REJECTED,
            Self::Misread { .. } => &TOUCHES_MISREAD,
            Self::TipOff { .. } => &TIP_OFF,
            Self::ViewsDisagree { .. } => &VIEWS_AND_TOUCHES_DISAGREE,
            Self::NotEnough { .. } => &TOUCHES_NOT_ENOUGH,
            Self::WithoutView { .. } => &TOUCH_WITHOUT_VIEW,
            Self::Repeated { .. } => &TOUCH_REPEATED,
            Self::OfABall => &TOUCHES_WITHOUT_CORNERS,
            Self::PlacementsIgnored { .. } => &TOUCH_PLACEMENTS_IGNORED,
            Self::NearlyCollinear { .. } => &POINTS_NEARLY_COLLINEAR,
            Self::AloneDetermine { .. } => &DETERMINED_BY_TOUCHES,
        }
    }

    fn message(&self) -> String {
        TouchFinding::message(self)
    }

    fn headline(&self) -> Option<String> {
        match self {
            Self::TipOff { offset_mm, .. } => {
                Some(format!("the answer corrects the tool's tip by {:.2} mm", length(offset_mm)))
            }
            Self::Outlier { corner, placement, .. } | Self::Misplaced { corner, placement, .. } => {
                let which = format!("corner {corner} of {placement:?}");
                Some(format!("the touch of {which} was rejected as an outlier"))
            }
            _ => None,
        }
    }

    fn data(&self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Outlier { corner, p_value, .. } => {
                vec![("corner", f64::from(*corner)), ("p_value", *p_value)]
            }
            Self::Misplaced { corner, off_mm, .. } => {
                vec![("corner", f64::from(*corner)), ("off_mm", *off_mm)]
            }
            Self::Misread { agreeing, of, off_mm, .. } => {
                vec![("agreeing", *agreeing as f64), ("of", *of as f64), ("off_mm", *off_mm)]
            }
            Self::TipOff { offset_mm: [x, y, z], p_value, .. } => {
                vec![("x_mm", *x), ("y_mm", *y), ("z_mm", *z), ("p_value", *p_value)]
            }
            Self::ViewsDisagree { p_value } => vec![("p_value", *p_value)],
            Self::Repeated { corner, count, .. } => {
                vec![("corner", f64::from(*corner)), ("count", *count as f64)]
            }
            Self::NearlyCollinear { ratio } => vec![("ratio", *ratio)],
            Self::NotEnough { .. }
            | Self::WithoutView { .. }
            | Self::OfABall
            | Self::PlacementsIgnored { .. }
            | Self::AloneDetermine { .. } => vec![],
        }
    }
}

fn length([x, y, z]: &[f64; 3]) -> f64 {
    x.hypot(*y).hypot(*z)
}

fn tip_off(offset_mm: &[f64; 3], in_flange: bool, p_value: f64, squares: Option<u32>) -> String {
    let [x, y, z] = offset_mm;
    let off = length(offset_mm);
    let miscounted = squares.map_or(String::new(), |n| {
        format!(
            ". But {off:.1} mm is {} of the board: if the corner ids start at another corner, correct the ids; the tip is \
             right then",
            if n == 1 { "one square".to_owned() } else { format!("{n} squares") }
        )
    });
    format!(
        "images and touches disagree by {off:.2} mm (p = {p_value:.1e}). The likeliest cause is a wrong tool tip: the true one is the declared one plus ({x:+.2}, {y:+.2}, {z:+.2}) mm in the {} frame. The result uses the corrected tip; calibrate the tool again{miscounted}",
        if in_flange { "flange" } else { "base" },
    )
}

fn without_view(placement: &str, corners: &[u32], unseen: &Unseen) -> String {
    let why = match unseen {
        Unseen::NotFound(reason) => {
            format!("its image shows no target ({reason}); take it again, or another one")
        }
        Unseen::NothingSeen => "it has no image, corners or pose; give it one of them".into(),
        Unseen::NoPlacement => "no view shows these corners; give the placement an image".into(),
    };
    let count = corners.len();
    let touches = if count == 1 { "1 touch".to_owned() } else { format!("{count} touches") };
    let corners = corners.iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
    format!("placement {placement}: {touches} not used (corner {corners}): {why}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tip_that_is_off_by_a_square_may_be_a_miscounted_corner() {
        let tip = |squares| TouchFinding::TipOff {
            offset_mm: [20.1, 0.0, 0.0],
            in_flange: true,
            p_value: 1e-9,
            squares,
        };
        let one = tip(Some(1)).message();
        assert!(one.contains("20.1 mm is one square of the board"), "{one}");
        assert!(!tip(None).message().contains("square"));
        let headline = tip(None).headline();
        assert_eq!(headline.as_deref(), Some("the answer corrects the tool's tip by 20.10 mm"));
    }
}
