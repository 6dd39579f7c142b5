//! Whether the touches are of the corners that they name, in the units and with the tip that are declared.
//!
//! The calibration itself judges them, with the uncertainty of the views; what it finds is told here as `check` tells
//! its findings.

use handeye::{Config, Session, calibrate};

use super::Explanation;

/// Findings of a calibration that are about its touches, and what to do where no key of the manifest corrects them.
const ABOUT_TOUCHES: [(&str, &str); 4] = [
    (
        "touches-misread",
        "correct the ids, the units or the placements of [touches], and check again",
    ),
    ("tip-off", "calibrate the tool again (`handeye tcp`), or correct the ids of the touches"),
    ("touch-rejected", "correct the id of that touch, touch the corner again, or remove the line"),
    (
        "views-and-touches-disagree",
        "check placements and frame of the touches; touch where the robot works",
    ),
];

/// What is wrong with the touches of a session whose captures agree.
pub(super) fn wrong_touches(session: &Session) -> Vec<Explanation> {
    if session.touches.is_empty() {
        return vec![];
    }
    let Ok(result) = calibrate(session, &Config::default()) else { return vec![] };
    let explained = |warning: &handeye::Warning| {
        let (code, by_hand) = ABOUT_TOUCHES.iter().find(|(code, _)| *code == warning.code)?;
        Some(Explanation {
            code,
            message: warning.message.clone(),
            after: None,
            p_value: None,
            captures: vec![],
            changes: vec![],
            by_hand: Some((*by_hand).to_owned()),
        })
    };
    result.warnings.iter().filter_map(explained).collect()
}
