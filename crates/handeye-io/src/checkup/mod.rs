//! What is wrong with a dataset: the mistakes that explain it ([`handeye::mistakes`]), and which keys of its manifest
//! correct them.

mod amend;
mod explained;
mod judged;
mod layout;
mod scan_unit;

use std::path::Path;

use handeye::{
    Base, Flange, Pose, Session, Target, TargetModel, Warning,
    mistakes::{self, Convention, Diagnosis, Evidence, score::Score},
    solve::consensus::Readings,
};
use nalgebra::{Isometry3, Vector3};
use serde::Serialize;

use explained::Case;
use judged::Judged;

pub use amend::apply;

use crate::{
    Dataset, Error, Place, Shape,
    dataset::{Rereading, rereadings},
    error::malformed,
    measure::{self, Measured},
};

/// A value of the manifest to change.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Change {
    /// Table of the manifest; empty for keys before the first table.
    pub table: &'static str,
    /// Key in it.
    pub key: String,
    /// Its new value, as TOML.
    pub value: String,
}

/// A mistake, and what speaks for it.
#[derive(Debug, Clone, Serialize)]
pub struct Explanation {
    /// For programs.
    pub code: &'static str,
    /// For people.
    pub message: String,
    /// The captures with it corrected; `None` where that needs new captures.
    pub after: Option<Score>,
    /// Chance of evidence as strong when nothing is wrong; `None` where the scores say it.
    pub p_value: Option<f64>,
    /// Captures concerned; empty where all are.
    pub captures: Vec<String>,
    /// Changes of the manifest that correct it; empty where none can.
    pub changes: Vec<Change>,
    /// What the user has to do where no value of the manifest corrects it.
    pub by_hand: Option<String>,
    /// It says what is wrong, and not only that something is.
    #[serde(skip)]
    pub(crate) is_cause: bool,
}

impl Explanation {
    /// A mistake with what corrects it, for which no score speaks.
    fn new(code: &'static str, message: String, changes: Vec<Change>) -> Self {
        let (after, p_value, captures, by_hand) = (None, None, vec![], None);
        Self { code, message, after, p_value, captures, changes, by_hand, is_cause: true }
    }

    /// The mistake with the keys that correct it.
    pub(crate) fn sentence(&self) -> String {
        let key = |c: &Change| match c.table {
            "" => format!("{} = {}", c.key, c.value),
            table => format!("[{table}] {} = {}", c.key, c.value),
        };
        let keys: Vec<String> = self.changes.iter().map(key).collect();
        let correction =
            if keys.is_empty() { String::new() } else { format!(": {}", keys.join(", ")) };
        format!("{}{correction}", self.message)
    }
}

/// The best convention that does not explain the captures.
#[derive(Debug, Clone, Serialize)]
pub struct RunnerUp {
    /// For people.
    pub message: String,
    /// How well the captures would agree.
    pub after: Score,
}

/// What was found.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Checkup {
    /// Nothing is wrong that captures can tell.
    pub ok: bool,
    /// The captures as declared; `None` when they agree on nothing at all.
    pub declared: Option<Score>,
    /// Mistakes, best explanation first.
    pub explanations: Vec<Explanation>,
    /// How many of the first explanations the data cannot tell apart.
    pub alike: usize,
    /// The best convention that does not explain.
    pub runner_up: Option<RunnerUp>,
    /// Captures that show the target.
    pub captures: usize,
    /// Captures that do not.
    pub not_seen: Vec<String>,
    /// Other conventions of the same numbers that were tried.
    pub readings_tried: usize,
    /// What looked suspicious when the files were read.
    pub warnings: Vec<Warning>,
}

impl Checkup {
    /// The one explanation that the data single out, where a manifest can express it.
    pub fn decided(&self) -> Option<&Explanation> {
        let first = self.explanations.first()?;
        (self.alike == 1 && !first.changes.is_empty()).then_some(first)
    }
}

/// Looks for mistakes in the dataset of a manifest whose names are relative to `root`; `progress`
/// is told how many captures of how many are read.
///
/// # Errors
/// As [`Dataset::open`]; also when too few captures show the target.
pub fn check(
    manifest: &Path,
    root: &Path,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Checkup, Error> {
    let dataset = Dataset::open_with_root(manifest, root)?;
    cannot_be_checked(&dataset).map_or(Ok(()), Err)?;
    let measured = measure::measure(&dataset, progress)?;
    let judged = Judged::new(&dataset, &measured.session);
    let mut found = examine(&measured, &judged)?;
    if found.explanations.is_empty() {
        found.explanations = judged.findings();
        found.ok &= found.explanations.is_empty();
        found.alike = found.explanations.len().min(1);
    }
    Ok(found)
}

/// Whether mistakes in a dataset can be told apart at all.
pub fn can_be_checked(dataset: &Dataset) -> bool {
    cannot_be_checked(dataset).is_none()
}

/// Why nothing tells mistakes of a dataset apart.
fn cannot_be_checked(dataset: &Dataset) -> Option<Error> {
    let place = || Place::file(&dataset.manifest);
    if let Some(TargetModel::Sphere { .. }) = dataset.target {
        let what = "a ball shows no rotation, and that is what tells mistakes apart";
        return Some(malformed(place(), what, "take some captures of a board"));
    }
    if let Some(Shape::Scene { .. }) = dataset.shape {
        let what = "scans of a scene are brought together with the help of the robot poses, so they \
                    cannot tell what is wrong with those";
        let advice = "take some captures of a board, or of an object of known shape";
        return Some(malformed(place(), what, advice));
    }
    if dataset.motion.is_some() {
        let what = "the robot moved while these captures were taken, and only poses in which it stood \
                    still tell mistakes apart";
        let advice =
            "take some captures of a robot that stands still; `handeye calibrate` judges these";
        return Some(malformed(place(), what, advice));
    }
    None
}

/// Looks for mistakes in what was measured.
fn examine(measured: &Measured, judged: &Judged) -> Result<Checkup, Error> {
    let Judged { dataset, session, .. } = *judged;
    let text = dataset.manifest_text()?;
    let (seen, blind): (Vec<usize>, Vec<usize>) =
        (0..dataset.captures.len()).partition(|&i| !session.observations[i].candidates.is_empty());
    let name = |i: &usize| session.observations[*i].capture.clone();
    let basic = basic_mistake(dataset, measured)?;
    if seen.len() < mistakes::FEWEST && basic.is_none() {
        return Err(too_few(dataset, seen.len(), measured.noticed.not_found.first()));
    }
    let mut checkup = match basic {
        // with another target or unit everything else looks wrong as well
        Some(first) => Checkup {
            alike: 1,
            explanations: vec![first],
            captures: seen.len(),
            ..Checkup::default()
        },
        None => {
            let robot = match dataset.is_in_memory() {
                true => vec![],
                false => rereadings(&dataset.manifest, &dataset.root, dataset)?,
            };
            let case = case(dataset, session, text, &seen, robot);
            let mut found = checkup(&case, &mistakes::diagnose(&case.evidence));
            add_layout(&mut found, dataset);
            add_touches(&mut found, judged);
            found
        }
    };
    checkup.not_seen = blind.iter().map(name).collect();
    checkup.warnings = measured.noticed.warnings.clone();
    Ok(checkup)
}

fn case(
    dataset: &Dataset,
    session: &Session,
    text: String,
    seen: &[usize],
    robot: Vec<Rereading>,
) -> Case {
    let convention = |r: &Rereading| Convention {
        words: r.words.clone(),
        captures: of_session(session, seen, |i| r.base_from_flange[i]),
    };
    let evidence = Evidence {
        setup: dataset.setup,
        target: dataset.target.clone(),
        names: seen.iter().map(|i| session.observations[*i].capture.clone()).collect(),
        declared: of_session(session, seen, |i| session.observations[i].base_from_flange),
        conventions: robot.iter().map(convention).collect(),
    };
    let bare = session.observations.iter().all(|o| o.corners.is_empty());
    Case { text, bare, robot, evidence }
}

/// Another layout of the target, or scans in another unit: with these nothing else can be judged.
///
/// # Errors
/// A manifest that cannot be read.
pub(crate) fn basic_mistake(
    dataset: &Dataset,
    measured: &Measured,
) -> Result<Option<Explanation>, Error> {
    let layout = layout::layout_of_missing(dataset, measured);
    let text = dataset.manifest_text()?;
    Ok(layout.or_else(|| scan_unit::wrong_scan_unit(dataset, measured, &text)))
}

/// Another layout of the target, where the captures contradict one another and nothing explains it.
fn add_layout(found: &mut Checkup, dataset: &Dataset) {
    let most_agree = found.declared.is_some_and(|d| d.is_most(found.captures));
    if found.ok || most_agree || found.explanations.iter().any(|e| e.is_cause) {
        return;
    }
    if let Some(layout) = layout::layout_of_contradicting(dataset) {
        found.explanations.insert(0, layout);
        (found.alike, found.ok) = (1, false);
    }
}

/// Findings whose captures cannot judge touches: poses that are read wrongly as a whole.
fn is_wholesale(explanation: &Explanation) -> bool {
    explanation.captures.is_empty()
}

/// Adds what is wrong with the touches, where the captures themselves are in order.
fn add_touches(found: &mut Checkup, judged: &Judged) {
    if found.explanations.iter().any(is_wholesale) {
        return;
    }
    let touches = judged.wrong_touches();
    if touches.is_empty() {
        return;
    }
    if found.explanations.is_empty() {
        found.alike = 1;
    }
    found.ok = false;
    found.explanations.extend(touches);
}

/// An answer may be one of so many; more are no answer.
const MOST_ANSWERS: usize = 3;

/// What explains a dataset whose calibration was not accepted, in one sentence; `None` where that is not known.
pub(crate) fn diagnosis(dataset: &Dataset, measured: &Measured) -> Option<String> {
    if cannot_be_checked(dataset).is_some() {
        return None;
    }
    let found = examine(measured, &Judged::new(dataset, &measured.session)).ok()?;
    let first = found.explanations.get(..found.alike.max(1))?;
    if first.len() > MOST_ANSWERS || !first.iter().all(|e| e.is_cause) {
        return None;
    }
    let all: Vec<String> = first.iter().map(Explanation::sentence).collect();
    Some(match &all[..] {
        [only] => only.clone(),
        several => format!("either {}", several.join("; or ")),
    })
}

fn too_few(dataset: &Dataset, seen: usize, reason: Option<&(String, String)>) -> Error {
    let what = format!(
        "the target was seen in {seen} captures, {} are needed to contradict a mistake",
        mistakes::FEWEST
    );
    let advice = reason.map_or("add captures".into(), |(capture, why)| {
        let which = match dataset.shape {
            Some(_) => "[object] and the scans",
            None => "[target] and the images",
        };
        format!("check {which} (capture {capture}: {why})")
    });
    malformed(Place::file(&dataset.manifest), what, advice)
}

fn of_session(
    session: &Session,
    seen: &[usize],
    robot: impl Fn(usize) -> Pose<Base, Flange>,
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

fn checkup(case: &Case, found: &Diagnosis) -> Checkup {
    let of = |e: &mistakes::Explanation| explained::explained(case, e);
    let alike = found.explanations[..found.alike].iter().map(|e| of(e).len()).sum();
    let explanations: Vec<Explanation> = found.explanations.iter().flat_map(of).collect();
    let runner_up = found
        .runner_up
        .as_ref()
        .and_then(|other| Some(RunnerUp { message: other.finding.message(), after: other.after? }));
    let captures = case.evidence.names.len();
    Checkup {
        ok: explanations.is_empty() && found.declared.is_some_and(|d| d.is_most(captures)),
        declared: found.declared,
        explanations,
        alike,
        runner_up,
        captures,
        readings_tried: case.robot.len(),
        ..Checkup::default()
    }
}
