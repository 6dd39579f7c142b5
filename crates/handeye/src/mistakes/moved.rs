//! A run of captures during which the target, or the camera on its mount, was somewhere else.
//!
//! The run agrees with itself, and one of its captures, the best, tells where the part was: `Y = A X C` where the target was
//! moved, `X = A⁻¹ Y C⁻¹` where the camera was.

use super::{
    evidence::{Evidence, Explanation},
    outliers::Outliers,
    residual::Residual,
    thresholds::{FEWEST, ONE_FOR_ALL},
};
use crate::{HandEye, PosePair, findings::MovementFinding};

/// Whether the outliers are one run that a moved target or camera explains.
pub(super) fn moved(evidence: &Evidence, outliers: &Outliers) -> Option<Explanation> {
    let n = evidence.names.len();
    let run: Vec<usize> = (0..n).filter(|&i| !outliers.found.agrees[i]).collect();
    let (first, last) = (*run.first()?, *run.last()?);
    // one capture is an outlier, not a run; most of them, and enough, must not have moved
    let rest = n - run.len();
    if run.len() < 2 || last - first + 1 != run.len() || rest <= run.len() || rest < FEWEST {
        return None;
    }
    let by_target = together(outliers, &run, target_there);
    let by_camera = together(outliers, &run, camera_there);
    let is_target = by_target <= by_camera;
    let is_now = last + 1 == n;
    // a camera that was bumped is to be calibrated where it is now
    let obsolete = if is_now && !is_target { (0..first).collect() } else { run.clone() };
    let finding = MovementFinding::Elsewhere {
        is_target,
        setup: evidence.setup,
        first: evidence.names[first].clone(),
        last: evidence.names[last].clone(),
        is_now,
    };
    (by_target.min(by_camera) < ONE_FOR_ALL).then(|| Explanation {
        captures: run,
        obsolete,
        ..Explanation::new(finding, None)
    })
}

/// Both poses with the target where one capture sees it.
fn target_there(at: &HandEye, p: &PosePair) -> HandEye {
    let there = p.anchor_from_mount * at.mount_from_camera * p.camera_from_target;
    HandEye { anchor_from_target: there, ..*at }
}

/// Both poses with the camera where one capture tells it to be.
fn camera_there(at: &HandEye, p: &PosePair) -> HandEye {
    let from_anchor = p.anchor_from_mount.inverse() * at.anchor_from_target;
    HandEye { mount_from_camera: from_anchor * p.camera_from_target.inverse(), ..*at }
}

/// Largest residual of a run in units of one that still agrees, where its best capture tells the place of what was moved.
fn together(outliers: &Outliers, run: &[usize], there: fn(&HandEye, &PosePair) -> HandEye) -> f64 {
    let views = run.iter().flat_map(|&i| &outliers.candidates[i]);
    let answers = views.map(|view| there(&outliers.found.hand_eye, &view.pair));
    answers.map(|answer| worst(outliers, run, &answer)).fold(f64::INFINITY, f64::min)
}

/// Largest residual of a run under an answer, each capture in its best pose candidate.
fn worst(outliers: &Outliers, run: &[usize], answer: &HandEye) -> f64 {
    let best = |&i: &usize| {
        let all = outliers.candidates[i]
            .iter()
            .map(|view| Residual::new(answer, &view.pair).over(outliers.typical));
        all.fold(f64::INFINITY, f64::min)
    };
    run.iter().map(best).fold(0.0, f64::max)
}
