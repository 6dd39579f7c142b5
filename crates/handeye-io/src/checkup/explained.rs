//! A mistake as changes of the manifest: which key corrects it, and what the user has to do where none does.

use handeye::{
    Setup,
    findings::{CaptureFinding, Finding, RobotFinding, TargetFinding, target::Size},
    mistakes::{self, Evidence, score},
};

use super::{Change, Explanation, amend};
use crate::dataset::{self, Rereading};

/// What was measured, and the manifest that declares it.
pub(super) struct Case {
    /// The text of the manifest.
    pub text: String,
    /// Poses of the board come from elsewhere: nobody knows their direction.
    pub bare: bool,
    /// How else the robot's numbers may be read, as the conventions of the evidence.
    pub robot: Vec<Rereading>,
    pub evidence: Evidence,
}

/// No arm is wrong in length by more than this; a printed target may be. Of the length.
const MOST_ROBOT_SCALE: f64 = 0.05;

/// A mistake, and what amounts to the same in the data.
pub(super) fn explained(case: &Case, found: &mistakes::Explanation) -> Vec<Explanation> {
    let own = Explanation {
        after: found.after,
        p_value: found.p_value,
        captures: case.evidence.named(&found.captures),
        is_cause: is_cause(&found.finding),
        ..Explanation::new(code(&found.finding), found.finding.message(), vec![])
    };
    let left = case.evidence.names.len() - found.obsolete.len();
    let mut all = match &found.finding {
        Finding::Robot(RobotFinding::OtherConvention { .. }) => conventions(case, own, found),
        Finding::Target(finding) => sizes(case, own, finding),
        _ if !found.obsolete.is_empty() && left >= mistakes::FEWEST => {
            let obsolete = case.evidence.named(&found.obsolete);
            vec![Explanation { changes: amend::excluding(&case.text, &obsolete), ..own }]
        }
        _ => vec![own],
    };
    for e in all.iter_mut().filter(|e| e.changes.is_empty()) {
        e.by_hand = Some(by_hand(&found.finding, &e.captures, left));
    }
    all
}

/// Whether a finding says what is wrong, and not only that something is.
fn is_cause(finding: &Finding) -> bool {
    !matches!(
        finding,
        Finding::Captures(CaptureFinding::Disagreeing { .. } | CaptureFinding::Repeated { .. })
    )
}

/// The code of a mistake; two have had a name of their own in a check, and programs know it.
fn code(finding: &Finding) -> &'static str {
    match finding {
        Finding::Captures(CaptureFinding::OutOfOrder { .. }) => "order",
        Finding::Target(_) => "target-size",
        other => other.code(),
    }
}

/// Another size of the target, or of the robot where it may be that.
fn sizes(case: &Case, own: Explanation, finding: &TargetFinding) -> Vec<Explanation> {
    let (TargetFinding::ExplainsAll(Size { value, sigma, .. })
    | TargetFinding::Distances { value, sigma }) = finding
    else {
        return vec![own];
    };
    let target = Explanation { changes: amend::resized(&case.text, *value), ..own };
    if (value - 1.0).abs() > MOST_ROBOT_SCALE {
        return vec![target];
    }
    let robot = RobotFinding::Scale { value: 1.0 / value, sigma: sigma / value.powi(2) };
    let robot = Finding::from(robot);
    let robot = Explanation {
        code: robot.code(),
        message: robot.message(),
        changes: vec![],
        ..target.clone()
    };
    vec![target, robot]
}

fn change(table: &'static str, key: &str, value: &str) -> Change {
    Change { table, key: key.into(), value: format!("\"{value}\"") }
}

/// Another convention of the robot's numbers; where their direction is another one, all that amounts to the same.
fn conventions(case: &Case, own: Explanation, found: &mistakes::Explanation) -> Vec<Explanation> {
    let Some(k) = found.convention else { return vec![own] };
    let robot = &case.robot[k];
    let changes = robot.changes.iter().map(|(key, value)| change("robot", key, value));
    let mut own = Explanation { changes: changes.collect(), ..own };
    if !robot.columns.is_empty() {
        let value = dataset::columns(&robot.columns).to_string();
        own.changes.push(Change { table: "robot", key: "columns".into(), value });
    }
    let is_inverted = own.changes.iter().any(|c| c.key == "direction");
    if is_inverted { directions(case, own, k) } else { vec![own] }
}

/// A part that rides on a flange sits nearer than this, m; the longest booms reach half as far.
const MOST_AT_FLANGE: f64 = 1.0;

/// Robot poses inverted, the camera on the other body, the board's poses inverted: with any one of
/// them the same equation holds. Only a part that would ride too far from the flange decides.
fn directions(case: &Case, robot: Explanation, k: usize) -> Vec<Explanation> {
    let captures = &case.evidence.conventions[k].captures;
    let Some((_, found)) = score::scored(captures) else { return vec![robot] };
    let camera = found.hand_eye.mount_from_camera.translation().norm();
    let target = found.hand_eye.anchor_from_target.translation().norm();
    let own = case.evidence.setup;
    // what rides on the flange if the setup is as declared, and if it is the other one
    let (other, as_declared, turned) = match own {
        Setup::EyeInHand => (Setup::EyeToHand, camera, target),
        Setup::EyeToHand => (Setup::EyeInHand, target, camera),
    };
    let first = format!("{} {}", robot.message, on_flange(own, as_declared));
    let mut all = vec![(as_declared, Explanation { message: first, ..robot.clone() })];
    let mut instead = |code, what: String, setup, correction| {
        let others = robot.changes.iter().filter(|c| c.key != "direction").cloned();
        let besides = besides(&case.robot[k]);
        let message = format!("{what} {}{besides}", on_flange(setup, turned));
        let changes = others.chain([correction]).collect();
        all.push((turned, Explanation { code, message, changes, ..robot.clone() }));
    };
    let (name, other_name) = (own.name(), other.name());
    let what =
        format!("the setup is {other_name}, not {name}, and the robot poses are as declared");
    instead("setup", what, other, change("", "setup", other_name));
    if case.bare {
        let value = match amend::value(&case.text, "board_poses", "direction").as_deref() {
            Some("\"target_from_camera\"") => "camera_from_target",
            _ => "target_from_camera",
        };
        let what = format!("the board poses are {value}, and the robot poses as declared");
        instead("board-inverted", what, own, change("board_poses", "direction", value));
    }
    let is_near = |distance: f64| distance < 0.5 * MOST_AT_FLANGE;
    let is_possible =
        |distance: f64| distance < MOST_AT_FLANGE || !(is_near(as_declared) || is_near(turned));
    all.into_iter().filter(|(distance, _)| is_possible(*distance)).map(|(_, e)| e).collect()
}

/// What a direction says of the cell, for its user to judge; `distance` in m.
fn on_flange(setup: Setup, distance: f64) -> String {
    let what = match setup {
        Setup::EyeInHand => "camera",
        Setup::EyeToHand => "target",
    };
    format!("(the {what} is then {distance:.2} m from the flange)")
}

/// What else is wrong beside the direction.
fn besides(robot: &Rereading) -> String {
    match robot.words_without_direction.as_str() {
        "" => String::new(),
        words => format!("; but {words}"),
    }
}

/// What to do about a mistake that no value of a manifest corrects. Without the captures concerned, `left` remain.
fn by_hand(finding: &Finding, captures: &[String], left: usize) -> String {
    let names = captures.iter().map(|c| format!("{c:?}")).collect::<Vec<_>>().join(", ");
    let leaving_out = format!("[captures] exclude = [{names}]");
    match finding {
        Finding::Captures(CaptureFinding::OutOfOrder { .. }) => {
            "a manifest cannot shift one list against the other: put the files, or the lines of the robot's poses, into \
             the right order, and check again"
                .into()
        }
        Finding::Captures(CaptureFinding::ImagesExchanged { .. }) => format!(
            "a manifest cannot exchange images: exchange the files of each pair, or leave the captures out with \
             {leaving_out}"
        ),
        Finding::Captures(CaptureFinding::CameraStill { .. }) => {
            format!("take these captures again, or leave them out with {leaving_out}")
        }
        Finding::Captures(CaptureFinding::Repeated { .. }) => {
            "nothing needs correcting: a calibration uses one capture of each robot pose".into()
        }
        Finding::Captures(CaptureFinding::RobotStill { .. }) | Finding::Movement(_) => {
            format!("only {left} captures would be left: take them again")
        }
        Finding::Robot(_) => "no key of a manifest says so: correct the numbers in the file of the robot's poses".into(),
        Finding::Target(_) => "no value of the manifest stands for it alone: measure the target, and have the robot's own \
                               scale checked if the size is right"
            .into(),
        _ => format!(
            "which of these captures are wrong is for you to say: look at their images and robot poses first; \
             {leaving_out} leaves all of them out"
        ),
    }
}
