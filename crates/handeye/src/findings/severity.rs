//! What a code does to the answer: one table from code to severity, headline and advice.
//!
//! A code decides what its finding does to the answer: nothing (`info`), the answer is another one because of it
//! (`changes-answer`), or there is no answer to use (`rejects`). An answer that is accepted with a finding that changes
//! it is neither green nor red: page and terminal say first what changed. Without a row a code is `info`.

use serde::{Deserialize, Serialize};

/// What a finding does to the answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Severity {
    /// Worth knowing; the answer is as it would be without.
    Info,
    /// The answer is another one because of it: what was declared or measured was corrected or rejected.
    ChangesAnswer,
    /// There is no answer to use because of it.
    Rejects,
}
/// What is known of a code.
pub(crate) struct Row {
    code: &'static str,
    pub severity: Severity,
    /// What it did to the answer, in a sentence for the top of a page; empty where the message is that short.
    pub headline: &'static str,
    pub advice: &'static str,
}

const fn changes(code: &'static str, headline: &'static str, advice: &'static str) -> Row {
    Row { code, severity: Severity::ChangesAnswer, headline, advice }
}

const fn rejects(code: &'static str, advice: &'static str) -> Row {
    Row { code, severity: Severity::Rejects, headline: "", advice }
}

/// Images and scans in different frames, and what that difference consists of: one headline is enough.
pub(crate) const DISAGREE: &str = "picture-and-scan-disagree";
pub(crate) const PARTS_OF_DISAGREE: [&str; 3] =
    ["picture-and-scan-scale", "picture-and-scan-tilt", "picture-and-scan-shift"];

/// What codes mean; those that are not here are `info` without advice.
const TABLE: &[Row] = &[
    changes(
        "camera-refined",
        "the answer uses refined intrinsics, not the given ones",
        "use the intrinsics in `camera` for your images too, or calibrate the camera again",
    ),
    changes(
        "camera-bends",
        "the answer uses a distortion that was not given",
        "calibrate the camera's distortion",
    ),
    changes(
        "depth-off",
        "the answer corrects the depth of the scans",
        "correct the points of this camera as `depth` says, or have its depth calibrated",
    ),
    changes(
        "depth-by-colour",
        "depth on black was corrected to that on white",
        "take a board of matt grey and white",
    ),
    changes(
        "target-scale",
        "the answer uses the estimated size of the target, not the declared one",
        "measure the target and declare its size",
    ),
    changes(
        "target-size-contradicted",
        "the captures contradict the measured size of the target, which the answer uses",
        "measure the target again; if it is right, the focal length or the robot's own scale is wrong",
    ),
    changes(
        "board-uneven",
        "the answer uses a board that is longer or shorter along y, not the declared one",
        "measure the print along both sides, and print it again or have a plate made",
    ),
    changes(
        "board-bent",
        "the answer uses a bent board, not a flat one",
        "glue the board to a flat plate",
    ),
    changes(
        "touch-rejected",
        "a touch was rejected as an outlier",
        "check the corner id of that touch, and touch it again",
    ),
    changes(
        "tip-off",
        "the answer corrects the tool's tip",
        "calibrate the tool again (`handeye tcp`)",
    ),
    changes(
        "captures-rejected",
        "many captures were rejected as outliers",
        "find out what they have in common: something moved, or the robot errs there",
    ),
    changes(
        "camera-moved",
        "the camera moved during the session, and the answer is where it is now",
        "fasten the camera and the target, and take the captures again",
    ),
    changes(
        "captures-displaced",
        "captures were rejected one after the other and agree with one another",
        "find out whether something moved or the robot errs there",
    ),
    changes(
        "moved-during-session",
        "something moved during the session, and the stated error covers it",
        "tighten what gives way, and take the captures again",
    ),
    changes(
        "order-shifted",
        "captures were rejected because images and robot poses are out of order",
        "correct the order of the files or lines",
    ),
    changes(
        "views-and-touches-disagree",
        "views and touches disagree, and the result is valid near the touched positions only",
        "calibrate the robot where it works, or touch corners there",
    ),
    changes(
        DISAGREE,
        "images and scans disagree, and the answer is for the frame of one of them",
        "check the calibration between image and depth, and the frame of the points",
    ),
    changes(
        "picture-and-scan-scale",
        "images and scans disagree in scale",
        "check focal length, size of the target and scale of depth",
    ),
    changes(
        "picture-and-scan-tilt",
        "images and scans disagree in rotation",
        "take the cloud in the frame of the image's camera",
    ),
    changes(
        "picture-and-scan-shift",
        "images and scans disagree in position",
        "take the cloud in the frame of the image's camera",
    ),
    changes(
        "arm-deviates",
        "the arm is not built as its model says, and the answer takes that into account",
        "use the corrected arm in programs that compute positions themselves",
    ),
    changes(
        "robot-errs-by-place",
        "the robot errs from place to place, and no fixed transform is right everywhere",
        "take captures where the robot works, with the tool held as at work; have its joints calibrated",
    ),
    changes(
        "drift",
        "errors changed slowly during the session, and the answer takes that into account",
        "warm up, and look for something that gives way",
    ),
    changes(
        "known-position-disagrees",
        "the data contradict the position that was given",
        "measure it again, or leave it out",
    ),
    rejects(
        "picture-and-scan-differ",
        "show the target at several distances and tilts, and check the calibration between image and scan",
    ),
    rejects("poses-inverted", "correct `direction` or `setup`"),
    rejects("robot-poses-inverted", "correct `direction` or `setup`"),
    rejects("robot-length-unit", "correct `length_unit`"),
    rejects("target-length-unit", "give robot and camera in the same unit"),
    rejects("no-clear-majority", "find out what changed in the session, and take it again"),
];

/// A code that does something to an answer, as the table has it.
pub fn known(code: &str) -> Option<&'static str> {
    row(code).map(|row| row.code)
}

pub(crate) fn row(code: &str) -> Option<&'static Row> {
    TABLE.iter().find(|row| row.code == code)
}
