//! `handeye check`: what is wrong with a dataset? The mistake that explains it best, with evidence.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye::{
    Pose, Session, Setup, Target, TargetModel,
    diagnose::explain::{self, Diagnosis, Fault, Finding, Order, Score},
    solve::consensus::Readings,
};
use handeye_io::{Dataset, MANIFEST, Rereading, amended, measure, rereadings, write_atomically};
use nalgebra::{Isometry3, Vector3};
use serde::Serialize;

use crate::{
    args::{CheckArgs, Manners},
    failure::Failure,
    output,
    progress::Progress,
};

/// A value of the manifest to change.
#[derive(Serialize, Clone, PartialEq)]
struct Change {
    table: &'static str,
    key: String,
    /// As TOML.
    value: String,
}

#[derive(Serialize)]
struct Explanation {
    code: &'static str,
    message: String,
    before: Option<Score>,
    after: Option<Score>,
    captures: Vec<String>,
    changes: Vec<Change>,
}

#[derive(Serialize)]
struct RunnerUp {
    message: String,
    after: Score,
}

#[derive(Serialize)]
struct Answer {
    ok: bool,
    declared: Option<Score>,
    explanations: Vec<Explanation>,
    /// How many of the first explanations the data cannot tell apart.
    alike: usize,
    runner_up: Option<RunnerUp>,
    captures: usize,
    not_seen: Vec<String>,
    readings_tried: usize,
    applied: Option<PathBuf>,
}

/// The dataset and all that is known of it.
struct Case {
    dataset: Dataset,
    names: Vec<String>,
    robot: Vec<Rereading>,
    /// Readings beyond the robot's: what they say, and the change.
    others: Vec<(String, Vec<Change>)>,
    declared: Vec<Readings>,
    readings: Vec<Vec<Readings>>,
    not_seen: Vec<String>,
}

pub fn run(args: &CheckArgs, manners: &Manners) -> Result<u8, Failure> {
    let manifest = match args.dataset.is_dir() {
        true => args.dataset.join(MANIFEST),
        false => args.dataset.clone(),
    };
    let root = args.root.clone().or_else(|| manifest.parent().map(PathBuf::from));
    let case = case(&manifest, &root.unwrap_or_default(), manners)?;
    if !explain::is_enough(&case.declared) {
        let what = format!(
            "the target was seen in {} captures, {} are needed to contradict anything: {}",
            case.declared.iter().filter(|c| !c.camera_from_target.is_empty()).count(),
            explain::FEWEST,
            if case.not_seen.is_empty() { "add captures" } else { "check [target]" }
        );
        return Err(Failure::input(manifest, what));
    }
    let found = explain::explain(&case.declared, &case.readings);
    let mut answer = answer(&case, &found);
    if args.apply {
        answer.applied = apply(&manifest, &answer)?;
    }
    if manners.json {
        output::json(&answer);
    } else {
        output::print(&text(&answer, args.apply));
    }
    Ok(if answer.ok { 0 } else { 3 })
}

fn case(manifest: &Path, root: &Path, manners: &Manners) -> Result<Case, Failure> {
    let dataset = Dataset::open_with_root(manifest, root)?;
    let progress = Progress::new("reading captures", manners);
    let session = measure::measure(&dataset, &|done, all| progress.tell(done, all))?.session;
    drop(progress);
    let robot = rereadings(manifest, root, &dataset)?;
    let seen: Vec<usize> = (0..session.observations.len())
        .filter(|&i| !session.observations[i].candidates.is_empty())
        .collect();
    let name = |&i: &usize| session.observations[i].capture.clone();
    let declared = of_session(&session, &seen, |i| session.observations[i].base_from_flange);
    let mut readings: Vec<Vec<Readings>> =
        robot.iter().map(|r| of_session(&session, &seen, |i| r.base_from_flange[i])).collect();
    let mut others = Vec::new();
    let bare = session.observations.iter().all(|o| o.corners.is_empty());
    if bare {
        readings.push(board_inverted(&declared));
        others.push((
            "the board poses are inverted ([board_poses] direction)".to_owned(),
            board_direction(manifest)?,
        ));
    }
    Ok(Case {
        names: seen.iter().map(name).collect(),
        not_seen: (0..session.observations.len())
            .filter(|i| !seen.contains(i))
            .map(|i| name(&i))
            .collect(),
        dataset,
        robot,
        others,
        declared,
        readings,
    })
}

fn of_session(
    session: &Session,
    seen: &[usize],
    robot: impl Fn(usize) -> Pose<handeye::Base, handeye::Flange>,
) -> Vec<Readings> {
    let shift = session.target.as_ref().map_or(Vector3::zeros(), |t| t.reference().vector());
    let corner: Pose<Target, Target> =
        Pose::claim(Isometry3::translation(shift.x, shift.y, shift.z));
    let one = |&i: &usize| Readings {
        anchor_from_mount: session.setup.anchor_from_mount(robot(i)),
        camera_from_target: session.observations[i]
            .candidates
            .iter()
            .map(|c| c.camera_from_target * corner)
            .collect(),
    };
    seen.iter().map(one).collect()
}

fn board_inverted(captures: &[Readings]) -> Vec<Readings> {
    let mut all = captures.to_vec();
    for capture in &mut all {
        capture.camera_from_target.iter_mut().for_each(|c| *c = c.inverse().rename());
    }
    all
}

/// The other direction of the board poses than the manifest's.
fn board_direction(manifest: &Path) -> Result<Vec<Change>, Failure> {
    let text = fs::read_to_string(manifest).map_err(|e| Failure::unreadable(manifest, &e))?;
    let turned = text
        .lines()
        .any(|l| l.split('#').next().unwrap_or_default().contains("\"target_from_camera\""));
    let value = if turned { "camera_from_target" } else { "target_from_camera" };
    Ok(vec![Change {
        table: "board_poses",
        key: "direction".into(),
        value: format!("\"{value}\""),
    }])
}

fn answer(case: &Case, found: &Diagnosis) -> Answer {
    let explanation = |f: &Finding| Explanation {
        code: code(&f.fault),
        message: message(case, &f.fault),
        before: found.declared,
        after: f.after,
        captures: captures(case, &f.fault),
        changes: changes(case, &f.fault),
    };
    let runner_up = found
        .runner_up
        .as_ref()
        .map(|(fault, after)| RunnerUp { message: message(case, fault), after: *after });
    Answer {
        ok: found.findings.is_empty() && found.declared.is_some_and(|d| agrees(&d, case)),
        declared: found.declared,
        explanations: found.findings.iter().map(explanation).collect(),
        alike: found.alike,
        runner_up,
        captures: case.names.len(),
        not_seen: case.not_seen.clone(),
        readings_tried: case.readings.len(),
        applied: None,
    }
}

/// Whether half of the captures agree, to what cells in working order reach.
fn agrees(score: &Score, case: &Case) -> bool {
    const MOST: (f64, f64) = (2.5, 15.0);
    2 * score.agree > case.names.len()
        && score.rotation_deg < MOST.0
        && score.translation_mm < MOST.1
}

fn code(fault: &Fault) -> &'static str {
    match fault {
        Fault::Reading(_) => "reading",
        Fault::Order(_) => "order",
        Fault::Exchanged(_) => "captures-exchanged",
        Fault::Scale(_) => "size",
        Fault::TargetMoved(..) => "target-moved",
        Fault::CameraMoved(..) => "camera-moved",
        Fault::RobotStill(_) => "robot-pose-frozen",
        Fault::CameraStill(_) => "camera-still",
        Fault::Repeated(_) => "captures-repeated",
    }
}

fn captures(case: &Case, fault: &Fault) -> Vec<String> {
    let named = |i: &usize| case.names[*i].clone();
    match fault {
        Fault::Exchanged(pairs) => pairs.iter().flat_map(|(i, j)| [named(i), named(j)]).collect(),
        Fault::TargetMoved(i, j) | Fault::CameraMoved(i, j) => {
            (*i..=*j).map(|k| named(&k)).collect()
        }
        Fault::RobotStill(all) | Fault::CameraStill(all) | Fault::Repeated(all) => {
            all.iter().map(named).collect()
        }
        _ => vec![],
    }
}

fn message(case: &Case, fault: &Fault) -> String {
    let names = captures(case, fault).join(", ");
    let run = |i: usize, j: usize| format!("{} to {}", case.names[i], case.names[j]);
    match fault {
        Fault::Reading(k) => reading_message(case, *k),
        Fault::Order(Order::Shifted(k)) => format!(
            "pictures and robot poses are in different orders: each picture belongs to the robot \
             pose {k} further on, counted round (picture {} to robot pose {})",
            case.names[0],
            k + 1
        ),
        Fault::Order(Order::Reversed) => {
            "pictures and robot poses are in opposite orders: the first picture belongs to the \
             last robot pose"
                .into()
        }
        Fault::Exchanged(_) => format!("the pictures of these captures are exchanged: {names}"),
        Fault::Scale(s) => format!(
            "the target is {:.4} +- {:.4} times as large as declared{}, or the robot's positions \
             are {:.4} times too small: the data cannot tell which; measure the target",
            s.value,
            s.sigma,
            declared_size(case)
                .map_or(String::new(), |mm| format!(" ({:.3} mm, not {mm} mm)", mm * s.value)),
            1.0 / s.value,
        ),
        Fault::TargetMoved(i, j) => format!(
            "the target was somewhere else during captures {}: it was moved in the session",
            run(*i, *j)
        ),
        Fault::CameraMoved(i, j) => format!(
            "the camera sat elsewhere on the {} during captures {}: it was moved in the session",
            case.dataset.setup.mount(),
            run(*i, *j)
        ),
        Fault::RobotStill(_) => format!(
            "these captures have one and the same robot pose, but the camera moved: the pose was \
             not read anew: {names}"
        ),
        Fault::CameraStill(_) => format!(
            "these captures show the target in the same place, but the robot moved: pictures were \
             stored twice, or target and camera ride together: {names}"
        ),
        Fault::Repeated(_) => {
            format!("these captures repeat one another and add nothing new: {names}")
        }
    }
}

fn reading_message(case: &Case, k: usize) -> String {
    let Some(robot) = case.robot.get(k) else {
        return case.others[k - case.robot.len()].0.clone();
    };
    let other = match case.dataset.setup {
        Setup::EyeInHand => "eye-to-hand",
        Setup::EyeToHand => "eye-in-hand",
    };
    let turned = robot.changes.iter().any(|(key, _)| *key == "direction");
    match turned {
        true => format!(
            "{}; or the setup is {other} and the direction as declared: the numbers are the same \
             and no data can tell",
            robot.words
        ),
        false => robot.words.clone(),
    }
}

/// Sizes that a manifest may declare.
const SIZES: [&str; 5] = ["square_mm", "marker_mm", "tag_mm", "pitch_mm", "size_mm"];

fn declared_size(case: &Case) -> Option<f64> {
    case.dataset.target.as_ref().map(TargetModel::pitch_m).map(|m| (m * 1e6).round() / 1e3)
}

fn changes(case: &Case, fault: &Fault) -> Vec<Change> {
    match fault {
        Fault::Reading(k) => match case.robot.get(*k) {
            Some(robot) => robot
                .changes
                .iter()
                .map(|(key, value)| Change {
                    table: "robot",
                    key: (*key).into(),
                    value: format!("\"{value}\""),
                })
                .collect(),
            None => case.others[k - case.robot.len()].1.clone(),
        },
        Fault::Scale(s) if case.dataset.target.is_some() => resized(case, s.value),
        _ => vec![],
    }
}

fn resized(case: &Case, scale: f64) -> Vec<Change> {
    let text = fs::read_to_string(&case.dataset.manifest).unwrap_or_default();
    let size = |key: &&str| {
        let line =
            text.lines().find(|l| l.split_once('=').is_some_and(|(k, _)| k.trim() == *key))?;
        let value = line.split_once('=')?.1.split('#').next()?.trim().parse::<f64>().ok()?;
        let value = format!("{:?}", (value * scale * 1e4).round() / 1e4);
        Some(Change { table: "target", key: (*key).into(), value })
    };
    SIZES.iter().filter_map(size).collect()
}

/// Writes the corrected manifest and keeps the old one beside it.
fn apply(manifest: &Path, answer: &Answer) -> Result<Option<PathBuf>, Failure> {
    let Some(best) = answer.explanations.first() else { return Ok(None) };
    let decided = answer.explanations[..answer.alike].iter().all(|e| e.changes == best.changes);
    if best.changes.is_empty() || !decided {
        return Ok(None);
    }
    let text = fs::read_to_string(manifest).map_err(|e| Failure::unreadable(manifest, &e))?;
    let backup = (0..)
        .map(|k| if k == 0 { "toml.bak".to_owned() } else { format!("toml.bak{k}") })
        .map(|ending| manifest.with_extension(ending))
        .find(|p| !p.exists());
    let Some(backup) = backup else { return Ok(None) };
    write_atomically(&backup, text.as_bytes())?;
    let change = |text: String, c: &Change| amended(&text, c.table, &c.key, &c.value);
    let corrected = best.changes.iter().fold(text, change);
    write_atomically(manifest, corrected.as_bytes())?;
    Ok(Some(backup))
}

fn misfit(score: Option<&Score>) -> String {
    score.map_or("no agreement at all".into(), |s| {
        format!("{:.2} mm, {:.3} degrees, {} agree", s.translation_mm, s.rotation_deg, s.agree)
    })
}

/// For people, in 80 columns.
fn text(a: &Answer, apply: bool) -> String {
    let mut text = String::from("\n");
    text += &match (a.ok, a.explanations.is_empty()) {
        (true, _) => output::wrapped("", "Nothing is wrong that captures can tell."),
        (false, true) => output::wrapped(
            "",
            "The captures do not agree, and none of the usual mistakes explains it: check the \
             target, the lens, and that pictures and robot poses belong together.",
        ),
        (false, false) if a.alike > 1 => {
            output::wrapped("", "Several explanations fit alike; the data cannot tell which:")
        }
        (false, false) => String::new(),
    };
    text += &format!("\n  as declared, of {} captures\n", a.captures);
    text += &format!("    median misfit    {}\n", misfit(a.declared.as_ref()));
    for (k, e) in a.explanations.iter().enumerate() {
        text += "\n";
        text += &output::wrapped(&format!("{}  ", k + 1), &e.message);
        if let Some(after) = &e.after {
            text += &format!("    median misfit    {}\n", misfit(Some(after)));
            if let Some(before) = &e.before {
                let times = before.score / after.score;
                text += &format!("    evidence         {times:.1} times closer\n");
            }
        }
        for c in &e.changes {
            text += &format!("    [{}] {} = {}\n", c.table, c.key, c.value);
        }
    }
    if let Some(r) = &a.runner_up {
        let what = format!("next best of {} readings: {}", a.readings_tried, r.message);
        text += "\n";
        text += &output::wrapped("   ", &what);
        text += &format!("    median misfit    {}\n", misfit(Some(&r.after)));
    }
    if !a.not_seen.is_empty() {
        text += "\n";
        text += &output::wrapped("  the target was not found in: ", &a.not_seen.join(", "));
    }
    match &a.applied {
        Some(backup) => {
            text += &format!("\nmanifest corrected; the old one: {}\n", backup.display())
        }
        None if apply && !a.ok => {
            text += "\nnothing applied: no single explanation that a manifest can express\n";
        }
        None => {}
    }
    text
}
