//! What was found beside the answer, by how much it matters: one table from code to severity, headline and advice.
//!
//! A finding is made of a warning, or of a reason against the answer. Its code decides what it does to the answer:
//! nothing (`info`), the answer is another one because of it (`changes-answer`), or there is no answer to use
//! (`rejects`). An answer that is accepted with a finding that changes it is neither green nor red: page and terminal
//! say first what changed. A new code needs one row of the table below; without one it is `info`.

use std::collections::BTreeMap;

use crate::{
    calibrate::result::{Calibration, Finding, Severity},
    model::verdict::Verdict,
};

/// What is known of a code.
struct Row {
    code: &'static str,
    severity: Severity,
    /// What it did to the answer, in a sentence for the top of a page; empty where the message is that short.
    headline: &'static str,
    advice: &'static str,
}

const fn changes(code: &'static str, headline: &'static str, advice: &'static str) -> Row {
    Row { code, severity: Severity::ChangesAnswer, headline, advice }
}

const fn rejects(code: &'static str, advice: &'static str) -> Row {
    Row { code, severity: Severity::Rejects, headline: "", advice }
}

/// Images and scans in different frames, and what that difference consists of: one headline is enough.
const DISAGREE: &str = "picture-and-scan-disagree";
const PARTS_OF_DISAGREE: [&str; 3] =
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
        "views and touches disagree, and the answer holds near the touched places only",
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
    rejects("target-poses-inverted", "correct `direction` of the board poses"),
    rejects("robot-length-unit", "correct `length_unit`"),
    rejects("target-length-unit", "give robot and camera in the same unit"),
    rejects("no-clear-majority", "find out what changed in the session, and take it again"),
];

/// A code that does something to an answer, as the table has it.
pub fn known(code: &str) -> Option<&'static str> {
    row(code).map(|row| row.code)
}

fn row(code: &str) -> Option<&'static Row> {
    TABLE.iter().find(|row| row.code == code)
}

/// What a code does to an answer of this verdict: in one that is accepted, nothing rejects; in one that is not,
/// nothing changes it.
fn severity(code: &str, verdict: Verdict) -> Severity {
    let of_code = row(code).map_or(Severity::Info, |row| row.severity);
    match (verdict, of_code) {
        (Verdict::Accepted, Severity::Rejects) => Severity::ChangesAnswer,
        (_, severity) => severity,
    }
}

/// All findings of a result: the reasons against it first, then its warnings in their order.
pub fn findings(result: &Calibration) -> Vec<Finding> {
    let accepted = result.verdict == Verdict::Accepted;
    let is_warning = |reason: &String| result.warnings.iter().any(|w| w.message == *reason);
    let code = if result.verdict == Verdict::Undetermined { "undetermined" } else { "rejected" };
    let reasons = result.reasons.iter().filter(|r| !accepted && !is_warning(r));
    let of_reason = |reason: &String| finding(code, Severity::Rejects, reason.clone());
    let of_warning = |w: &crate::Warning| {
        let is_reason = !accepted && result.reasons.contains(&w.message);
        let severity =
            if is_reason { Severity::Rejects } else { severity(&w.code, result.verdict) };
        finding(&w.code, severity, w.message.clone())
    };
    reasons.map(of_reason).chain(result.warnings.iter().map(of_warning)).collect()
}

fn finding(code: &str, severity: Severity, message: String) -> Finding {
    let advice = row(code).map(|row| row.advice.to_owned());
    Finding { code: code.to_owned(), severity, message, advice, data: BTreeMap::new() }
}

/// Writes the findings of a result into it; to be called whenever its warnings or reasons are complete.
pub fn record(result: &mut Calibration) {
    result.findings = findings(result);
}

/// Where a result is accepted with findings that change it: the sentence that says so first.
pub fn reservation(result: &Calibration) -> Option<String> {
    if result.verdict != Verdict::Accepted {
        return None;
    }
    let all = findings(result);
    let is_told = all.iter().any(|f| f.code == DISAGREE);
    let is_part = |code: &str| is_told && PARTS_OF_DISAGREE.contains(&code);
    let mut codes: Vec<String> = vec![];
    let mut headlines: Vec<String> = vec![];
    for f in all {
        let changes = f.severity == Severity::ChangesAnswer && !is_part(&f.code);
        if changes && !codes.contains(&f.code) {
            let headline = row(&f.code).map_or("", |row| row.headline);
            headlines.push(if headline.is_empty() { f.message } else { headline.to_owned() });
            codes.push(f.code);
        }
    }
    (!headlines.is_empty()).then(|| format!("Accepted, but: {}", headlines.join("; ")))
}
