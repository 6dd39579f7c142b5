//! The size of the target as the robot's motions see it.
//!
//! With the rotations of a fit, `R_A t_X + t_A = s R_Y t_B + t_Y` is linear in `t_X`, `t_Y` and the size `s` over the
//! declared one (N. Andreff, R. Horaud and B. Espiau, *Robot hand-eye calibration using structure from motion*, IJRR 20(3),
//! 2001). It finds sizes that are wrong by any factor. A size near the declared one is fitted with everything else
//! ([`target_scale`]).

use nalgebra::{DMatrix, DVector, Matrix3, SMatrix};

use super::{
    evidence::{Evidence, Explanation},
    frozen::is_same_robot,
    score::{Score, agreeing, scored},
    size_cause::cause_of_size,
    thresholds::{FEWEST, IMPROBABLE_SIZE, LEAST_SIZE_ERROR, MOST_AGREE, MOST_UNCERTAIN, REACH},
};
use crate::{
    HandEye, PosePair, Setup,
    detect::sight::{CAMERA, Sight, TARGET_SCALE},
    estimate::{self, Extra, ExtraKind, JointFit, Problem, noise::KnownNoise},
    findings::{
        TargetFinding,
        target::{Size, SizeOfAnswer},
    },
    math::{linalg, statistics},
    solve::{
        self, Method, View,
        consensus::{self, Consensus, Readings},
    },
};

/// Size of the target as the robot's motions see it, over the declared one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetScale {
    /// The factor on the measured distances that fits best.
    pub value: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// Chance of a factor as far from one when the declared size is right.
    pub p_value: f64,
}

/// A size that is wrong by more than printers do, proven by the captures, under which most of them agree.
pub(super) fn wrong_size(
    evidence: &Evidence,
    declared: Option<&(Score, Consensus)>,
) -> Option<Explanation> {
    let captures = &evidence.declared;
    let reach = captures.iter().map(|c| c.anchor_from_mount.translation().norm());
    if !(REACH.0..REACH.1).contains(&reach.fold(0.0, f64::max)) {
        return None; // it is the robot's unit that is wrong
    }
    let size = size(&distinct(captures))?;
    let is_within_printing = (size.value - 1.0).abs() < LEAST_SIZE_ERROR;
    let is_uncertain = size.sigma / size.value > MOST_UNCERTAIN;
    if is_within_printing || is_uncertain || size.p_value > IMPROBABLE_SIZE {
        return None;
    }
    let (after, _) = scored(&rescaled(captures, size.value))?;
    let before = declared.map_or(f64::INFINITY, |(score, _)| score.score);
    let do_agree = after.agree as f64 >= MOST_AGREE * captures.len() as f64;
    (after.score < before && do_agree).then(|| Explanation {
        p_value: Some(size.p_value),
        ..Explanation::new(finding(evidence, &size), Some(after))
    })
}

fn finding(evidence: &Evidence, size: &TargetScale) -> TargetFinding {
    let TargetScale { value, sigma, .. } = *size;
    let Some(target) = &evidence.target else {
        return TargetFinding::Distances { value, sigma };
    };
    TargetFinding::ExplainsAll(Size {
        value,
        sigma,
        declared_mm: (target.pitch_m() * 1e6).round() / 1e3,
        cause: cause_of_size(value, target),
        beyond_printing: false,
        answer: SizeOfAnswer::Declared,
    })
}

/// Captures without those that repeat another: they would lend a size certainty it has not.
fn distinct(captures: &[Readings]) -> Vec<Readings> {
    let mut all: Vec<Readings> = Vec::with_capacity(captures.len());
    for capture in captures {
        if !all.iter().any(|c| is_same_robot(c, capture)) {
            all.push(capture.clone());
        }
    }
    all
}

/// Captures as they would be with a target `s` times as large.
pub(super) fn rescaled(captures: &[Readings], s: f64) -> Vec<Readings> {
    let one = |c: &Readings| Readings {
        anchor_from_mount: c.anchor_from_mount,
        camera_from_target: c.camera_from_target.iter().map(|p| p.farther(s)).collect(),
    };
    captures.iter().map(one).collect()
}

/// Rounds in which the fit and the size are found in turn.
const SIZE_ROUNDS: usize = 4;

/// Size of the target as the robot sees it: the linear system `R_A t_X + t_A = s R_Y t_B + t_Y` in
/// `t_X`, `t_Y` and `s`, with rotations of a fit at the size found before.
fn size(captures: &[Readings]) -> Option<TargetScale> {
    let mut at = 1.0;
    let mut last = None;
    for _ in 0..SIZE_ROUNDS {
        let resized = rescaled(captures, at);
        let (pairs, hand_eye) = fitted(&resized)?;
        let found = size_of(&pairs, &hand_eye)?;
        if !(found.value > 1e-4 && found.value < 1e4) {
            return None;
        }
        at *= found.value;
        let relative = found.sigma * at / found.value;
        let done = (found.value - 1.0).abs() < 0.1 * found.sigma;
        last = Some((relative, pairs.len()));
        if done {
            break;
        }
    }
    let (sigma, count) = last?;
    let dof = 3.0 * count as f64 - 7.0;
    let f = ((at - 1.0) / sigma).powi(2);
    let p_value = statistics::of_f(f, (1.0, dof));
    Some(TargetScale { value: at, sigma, p_value })
}

/// Captures that agree and what they agree on; all of them in a closed form, whose rotations do not
/// depend on the size, where fewer than most do.
fn fitted(captures: &[Readings]) -> Option<(Vec<PosePair>, HandEye)> {
    let found = consensus::consensus(captures).ok()?;
    let used = agreeing(&found);
    if used.len() as f64 >= MOST_AGREE * captures.len() as f64 && used.len() >= FEWEST {
        let pairs: Vec<_> = used.iter().map(|&i| captures[i].pair(found.reading[i])).collect();
        return closed_form(pairs);
    }
    let readable = (0..captures.len()).filter(|&i| !captures[i].camera_from_target.is_empty());
    closed_form(readable.map(|i| captures[i].pair(found.reading[i])).collect())
}

fn closed_form(pairs: Vec<PosePair>) -> Option<(Vec<PosePair>, HandEye)> {
    let hand_eye = solve::solve(&pairs, Method::Shah).ok()?;
    (pairs.len() >= FEWEST).then_some((pairs, hand_eye))
}

fn size_of(pairs: &[PosePair], at: &HandEye) -> Option<TargetScale> {
    let n = pairs.len();
    let (mut j, mut right) = (DMatrix::zeros(3 * n, 7), DVector::zeros(3 * n));
    let r_y = at.anchor_from_target.rotation();
    for (k, p) in pairs.iter().enumerate() {
        j.fixed_view_mut::<3, 3>(3 * k, 0).copy_from(&p.r_a());
        j.fixed_view_mut::<3, 3>(3 * k, 3).copy_from(&-Matrix3::identity());
        j.fixed_view_mut::<3, 1>(3 * k, 6).copy_from(&-(r_y * p.t_b()));
        right.fixed_rows_mut::<3>(3 * k).copy_from(&-p.t_a());
    }
    let inverse = linalg::inverse_spd(&(j.transpose() * &j))?;
    let solution = &inverse * (j.transpose() * &right);
    let rest = (&j * &solution - &right).norm_squared().max(n as f64 * 1e-16);
    let dof = 3.0 * n as f64 - 7.0;
    let sigma = (inverse[(6, 6)] * rest / dof).sqrt();
    Some(TargetScale { value: solution[6], sigma, p_value: f64::NAN })
}

/// Finds the size of the target that fits best. The noise is estimated again at that size: a wrong
/// size would otherwise pass for noise and hide itself.
pub fn target_scale(
    views: &[View],
    at: &JointFit,
    known: &KnownNoise,
    setup: Setup,
) -> Option<TargetScale> {
    let size = Extra::about_zero(ExtraKind::Camera(TARGET_SCALE), 1.0);
    let problem = |views: &[View]| {
        let views = views.iter().map(of_any_size).collect();
        Problem { setup, views, boards: vec![], extras: vec![size], known_position: None }
    };
    let coarse = estimate::fit_joint(&problem(views), &at.hand_eye, known).ok()?;
    let first = 1.0 + coarse.extra(size.kind)?.0;
    if !(SCALES.0..SCALES.1).contains(&first) {
        return None;
    }
    let rescaled = problem(&views_rescaled(views, first));
    let fit = estimate::fit_joint(&rescaled, &coarse.hand_eye, known).ok()?;
    let (more, sigma) = fit.extra(size.kind)?;
    let (value, sigma) = (first * (1.0 + more), first * sigma);
    let dof = fit.degrees_of_freedom - 1.0;
    let p_value = statistics::of_f(((value - 1.0) / sigma).powi(2), (1.0, dof));
    Some(TargetScale { value, sigma, p_value })
}

/// Sizes of the target, over the declared one, that are worth a second look.
const SCALES: (f64, f64) = (0.2, 5.0);

/// Views as they would be with a target `s` times as large.
pub fn views_rescaled(views: &[View], s: f64) -> Vec<View> {
    let mut all = views.to_vec();
    for view in &mut all {
        view.pair.camera_from_target = view.pair.camera_from_target.farther(s);
    }
    all
}

/// A view of which the size of its target is open.
fn of_any_size(view: &View) -> View {
    let mut by = SMatrix::<f64, 6, CAMERA>::zeros();
    by.set_column(TARGET_SCALE, &Sight::by_size(&view.pair.camera_from_target));
    View { sight: Some(Sight::moving(by).into()), ..view.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::findings::Finding;
    use crate::mistakes::{score::scored, tests::in_order};

    /// The size that is found of boards that are declared `declared` times as large as they are.
    fn found(declared: f64, seed: u64) -> Option<f64> {
        let right = in_order(15, seed);
        let wrong = Evidence { declared: rescaled(&right.declared, declared), ..right };
        let found = wrong_size(&wrong, scored(&wrong.declared).as_ref())?;
        let Finding::Target(TargetFinding::ExplainsAll(size)) = found.finding else { return None };
        assert!((size.value - 1.0 / declared).abs() < 5.0 * size.sigma, "{size:?}");
        Some(size.value)
    }

    #[test]
    fn a_size_is_found_from_hundredfold_down_to_what_printers_do() {
        for declared in [0.01, 0.5, 1.1, 10.0, 100.0] {
            assert!(found(declared, 3).is_some(), "{declared}");
        }
        assert!(found(1.02, 3).is_some());
        assert_eq!(found(1.004, 3), None);
        assert_eq!(found(1.0, 3), None);
    }

    #[test]
    fn robot_positions_in_another_unit_are_no_size() {
        let right = in_order(15, 4);
        let in_millimetres =
            crate::mistakes::tests::with_robot(&right, |_, c| c.anchor_from_mount.farther(1e3));
        assert_eq!(wrong_size(&in_millimetres, None), None);
    }
}
