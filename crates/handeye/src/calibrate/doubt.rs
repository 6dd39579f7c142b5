//! Whether the captures that agree are the right ones: no clear majority is no answer.

use crate::{
    HandEye, PosePair, TargetModel,
    calibrate::{
        result::{Calibration, Scale},
        views::Captures,
    },
    findings::{CaptureFinding, captures::ListedOrder},
    math::linalg::median,
    mistakes::{
        self, TargetScale,
        explain::{self},
        score,
        score::{Fault, Order},
    },
    model::verdict::Verdict,
    solve::consensus::{self, Consensus, Readings},
};

/// Fewest captures of which a part may be left out: three determine an answer and confirm nothing.
const FEWEST_CONFIRMED: usize = 4;
/// A second agreement with this share of the captures of the first leaves the question open.
const NEARLY_AS_MANY: f64 = 0.75;
/// Answers this close are the same: rad and m. A second group in which only the target lay
/// elsewhere, or was read turned, says the same of the camera.
const SAME_ANSWER: (f64, f64) = (0.035, 0.02);

/// Rejects an answer that too few captures confirm, or against which nearly as many stand.
pub(super) fn doubt(
    captures: &Captures,
    found: &Consensus,
    wrong: &[usize],
    result: &mut Calibration,
) {
    let used = found.agrees.iter().filter(|a| **a).count();
    let (seen, out) = (used + wrong.len(), wrong.len());
    let finding = if out > 0 && (used < FEWEST_CONFIRMED || 2 * used == seen) {
        CaptureFinding::NoMajority { used, of: seen }
    } else if let Some(others) = second_agreement(captures, found, wrong, used) {
        CaptureFinding::TwoAnswers { used, others, rest: out }
    } else {
        return;
    };
    result.reasons.push(finding.message());
    result.warnings.push(finding.into());
    result.verdict = Verdict::Rejected;
}

/// How many of the captures left out agree on another place of the camera, if nearly as many.
fn second_agreement(
    captures: &Captures,
    found: &Consensus,
    wrong: &[usize],
    used: usize,
) -> Option<usize> {
    let enough = (NEARLY_AS_MANY * used as f64).max(FEWEST_CONFIRMED as f64);
    if (wrong.len() as f64) < enough {
        return None;
    }
    let rest: Vec<Readings> = wrong.iter().map(|&i| captures.readings[i].clone()).collect();
    let second = consensus::consensus(&rest).ok()?;
    let count = second.agrees.iter().filter(|a| **a).count();
    (count as f64 >= enough && !same_answer(&found.hand_eye, &second.hand_eye)).then_some(count)
}

fn same_answer(a: &HandEye, b: &HandEye) -> bool {
    let (a, b) = (&a.mount_from_camera, &b.mount_from_camera);
    a.angle_to(b) < SAME_ANSWER.0 && a.distance_to(b) < SAME_ANSWER.1
}

/// Captures that agree within this are taken to be in order. mm and degrees.
const IN_ORDER: (f64, f64) = (15.0, 2.5);

/// Looks for one order of all robot poses in which most captures agree, where as declared they do
/// not; whether there is one.
pub(super) fn suspect_order(
    readings: &[Readings],
    found: Option<&Consensus>,
    result: &mut Calibration,
) -> bool {
    let n = readings.len();
    if found.is_some_and(|f| agrees_well(readings, f)) {
        return false;
    }
    let in_order = |s: &score::Score| {
        2 * s.agree > n && s.translation_mm < IN_ORDER.0 && s.rotation_deg < IN_ORDER.1
    };
    let diagnosis = explain::explain(readings, &[]);
    let order = diagnosis.findings.iter().find_map(|f| match (&f.fault, f.after) {
        (Fault::Order(order), Some(after)) if in_order(&after) => Some((*order, after)),
        _ => None,
    });
    let Some((order, after)) = order else { return false };
    let finding = CaptureFinding::OutOfOrder {
        order: match order {
            Order::Reversed => ListedOrder::Reversed,
            Order::Shifted(k) if 2 * k > n => ListedOrder::Before(n - k),
            Order::Shifted(k) => ListedOrder::After(k),
        },
        agreeing: after.agree,
        of: n,
        within_mm: after.translation_mm,
    };
    result.reasons.insert(0, finding.message());
    result.warnings.insert(0, finding.into());
    result.verdict = Verdict::Rejected;
    true
}

/// Captures that agree under a target of another size are far nearer than under the declared one.
const EXPLAINED_BY_SIZE: f64 = 0.2;

/// Looks for one size of the target under which most captures agree, where under the declared one they do not;
/// whether there is one.
pub(super) fn suspect_size(
    readings: &[Readings],
    target: Option<&TargetModel>,
    found: Option<&Consensus>,
    result: &mut Calibration,
) -> bool {
    let Some(target) = target else { return false };
    if found.is_some_and(|f| agrees_well(readings, f)) {
        return false;
    }
    let diagnosis = explain::explain(readings, &[]);
    let before = diagnosis.declared.map_or(f64::INFINITY, |s| s.translation_mm);
    let size = diagnosis.findings.iter().find_map(|f| match (&f.fault, f.after) {
        (Fault::Scale(size), Some(after)) if after.translation_mm < EXPLAINED_BY_SIZE * before => {
            Some(*size)
        }
        _ => None,
    });
    let Some(size) = size else { return false };
    let finding = mistakes::size_finding(&size, target);
    let TargetScale { value, sigma, .. } = size;
    result.target_scale = Some(Scale { value, sigma, used: false });
    result.reasons.insert(0, finding.message());
    result.warnings.insert(0, finding.into());
    result.verdict = Verdict::Rejected;
    true
}

/// Whether most captures agree, within what robots and cameras in order do.
fn agrees_well(readings: &[Readings], found: &Consensus) -> bool {
    let used = (0..readings.len()).filter(|&i| found.agrees[i]);
    let (angles, distances): (Vec<f64>, Vec<f64>) = used
        .map(|i| {
            let anchor_from_mount = readings[i].anchor_from_mount;
            let camera_from_target = readings[i].camera_from_target[found.reading[i]];
            let pair = PosePair { anchor_from_mount, camera_from_target };
            found.hand_eye.loop_misfit(&pair)
        })
        .unzip();
    2 * angles.len() > readings.len()
        && median(distances) * 1e3 < IN_ORDER.0
        && median(angles).to_degrees() < IN_ORDER.1
}
