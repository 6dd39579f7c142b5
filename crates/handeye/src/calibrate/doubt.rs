//! Whether the captures that agree are the right ones: no clear majority is no answer.

use crate::{
    HandEye, PosePair, TargetModel,
    calibrate::{notes::Notes, result::Scale, views::Captures},
    findings::{CaptureFinding, captures::ListedOrder},
    math::linalg::median,
    mistakes::{
        self, TargetScale,
        explain::{self, Diagnosis},
        score,
        score::{Fault, Order},
    },
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
pub(super) fn doubt(captures: &Captures, found: &Consensus, wrong: &[usize]) -> Notes {
    let used = found.agrees.iter().filter(|a| **a).count();
    let (seen, out) = (used + wrong.len(), wrong.len());
    let finding = if out > 0 && (used < FEWEST_CONFIRMED || 2 * used == seen) {
        CaptureFinding::NoMajority { used, of: seen }
    } else if let Some(others) = second_agreement(captures, found, wrong, used) {
        CaptureFinding::TwoAnswers { used, others, rest: out }
    } else {
        return Notes::default();
    };
    Notes::against(finding)
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

/// One mistake in all captures that explains why they do not agree well: a target of another size (and that size), or
/// robot poses in another order.
pub(super) fn suspect_whole(
    readings: &[Readings],
    target: Option<&TargetModel>,
    found: Option<&Consensus>,
) -> Option<(Notes, Option<Scale>)> {
    if found.is_some_and(|f| agrees_well(readings, f)) {
        return None;
    }
    let diagnosis = explain::explain(readings, &[]);
    let size = target.and_then(|target| suspect_size(&diagnosis, target));
    size.or_else(|| Some((suspect_order(readings.len(), &diagnosis)?, None)))
}

/// One order of all robot poses in which most captures agree.
fn suspect_order(n: usize, diagnosis: &Diagnosis) -> Option<Notes> {
    let in_order = |s: &score::Score| {
        2 * s.agree > n && s.translation_mm < IN_ORDER.0 && s.rotation_deg < IN_ORDER.1
    };
    let (order, after) = diagnosis.findings.iter().find_map(|f| match (&f.fault, f.after) {
        (Fault::Order(order), Some(after)) if in_order(&after) => Some((*order, after)),
        _ => None,
    })?;
    Some(Notes::against(CaptureFinding::OutOfOrder {
        order: match order {
            Order::Reversed => ListedOrder::Reversed,
            Order::Shifted(k) if 2 * k > n => ListedOrder::Before(n - k),
            Order::Shifted(k) => ListedOrder::After(k),
        },
        agreeing: after.agree,
        of: n,
        within_mm: after.translation_mm,
    }))
}

/// Captures that agree under a target of another size are far nearer than under the declared one.
const EXPLAINED_BY_SIZE: f64 = 0.2;

/// One size of the target under which most captures agree.
fn suspect_size(diagnosis: &Diagnosis, target: &TargetModel) -> Option<(Notes, Option<Scale>)> {
    let before = diagnosis.declared.map_or(f64::INFINITY, |s| s.translation_mm);
    let size = diagnosis.findings.iter().find_map(|f| match (&f.fault, f.after) {
        (Fault::Scale(size), Some(after)) if after.translation_mm < EXPLAINED_BY_SIZE * before => {
            Some(*size)
        }
        _ => None,
    })?;
    let finding = mistakes::size_finding(&size, target);
    let TargetScale { value, sigma, .. } = size;
    Some((Notes::against(finding), Some(Scale { value, sigma, used: false })))
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
