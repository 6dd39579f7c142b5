//! The size of the target as the robot's motions see it.

use nalgebra::{DMatrix, DVector, Matrix3};

use super::{TargetScale, strays::same_robot};
use crate::{
    HandEye, PosePair, TargetModel,
    findings::{
        TargetFinding,
        target::{Size, SizeOfAnswer},
    },
    math::{linalg, statistics},
    mistakes::score::{FEWEST, Fault, Finding, REACH, Score, pair, reach, scored},
    solve::{
        self, Method,
        consensus::{self, Consensus, Readings},
    },
};

/// Wrong size below this part is within what printers and lenses do.
const LEAST_SCALE_ERROR: f64 = 0.005;
/// Chance of such a size when the declared one is right, below which it is called wrong.
const IMPROBABLE: f64 = 1e-3;
/// The spread of positions must be known this well: a size that is uncertain by more tells nothing.
const MOST_UNCERTAIN: f64 = 0.1;
/// Captures that agree once the size is right, of all.
const MOST_AGREE: f64 = 0.6;

pub(super) fn wrong_size(
    captures: &[Readings],
    declared: Option<&(Score, Consensus)>,
) -> Option<Finding> {
    if !(REACH.0..REACH.1).contains(&reach(captures)) {
        return None; // it is the robot's unit that is wrong
    }
    let scale = size(&distinct(captures))?;
    let off = (scale.value - 1.0).abs();
    let uncertain = scale.sigma / scale.value;
    if off < LEAST_SCALE_ERROR || scale.p_value > IMPROBABLE || uncertain > MOST_UNCERTAIN {
        return None;
    }
    let (after, _) = scored(&rescaled(captures, scale.value))?;
    let before = declared.map_or(f64::INFINITY, |(s, _)| s.score);
    let agrees = after.agree as f64 >= MOST_AGREE * captures.len() as f64;
    (after.score < before && agrees)
        .then_some(Finding { fault: Fault::Scale(scale), after: Some(after) })
}

/// Captures without those that repeat another: they would lend a size certainty it has not.
fn distinct(captures: &[Readings]) -> Vec<Readings> {
    let mut all: Vec<Readings> = Vec::with_capacity(captures.len());
    for capture in captures {
        if !all.iter().any(|c| same_robot(c, capture)) {
            all.push(capture.clone());
        }
    }
    all
}

/// Captures as they would be with a target `s` times as large.
pub fn rescaled(captures: &[Readings], s: f64) -> Vec<Readings> {
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
pub fn size(captures: &[Readings]) -> Option<TargetScale> {
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
    let agrees = |i: &usize| found.agrees[*i] && !captures[*i].camera_from_target.is_empty();
    let used: Vec<usize> = (0..captures.len()).filter(agrees).collect();
    if used.len() as f64 >= MOST_AGREE * captures.len() as f64 && used.len() >= FEWEST {
        let pairs: Vec<_> = used.iter().map(|&i| pair(&captures[i], found.reading[i])).collect();
        return closed_form(pairs);
    }
    let readable = (0..captures.len()).filter(|&i| !captures[i].camera_from_target.is_empty());
    closed_form(readable.map(|i| pair(&captures[i], found.reading[i])).collect())
}

fn closed_form(pairs: Vec<PosePair>) -> Option<(Vec<PosePair>, HandEye)> {
    let hand_eye = solve::solve(&pairs, Method::Shah).ok()?;
    (pairs.len() >= FEWEST).then_some((pairs, hand_eye))
}

/// A size is a known factor away from the declared one within this share.
const LIKE_FACTOR: f64 = 0.01;

/// The usual mistake that makes a target so many times as large as declared, in words.
pub fn cause_of_size(value: f64, target: &TargetModel) -> Option<String> {
    let is = |factor: f64| (value / factor - 1.0).abs() < LIKE_FACTOR;
    let units = [
        (10.0, "the length was given in centimetres and counts as millimetres"),
        (0.1, "the declared length is ten times too large: millimetres were taken for centimetres"),
        (1e3, "the length was given in metres and counts as millimetres"),
        (
            1e-3,
            "the declared length is a thousand times too large: micrometres, or millimetres taken for metres",
        ),
        (25.4, "the length was given in inches and counts as millimetres"),
        (
            1.0 / 25.4,
            "the declared length is 25.4 times too large: millimetres were taken for inches",
        ),
        (2.0, "half of the length was given"),
        (0.5, "twice the length was given: that of two squares, or of a circle grid's other pitch"),
    ];
    if let Some((_, words)) = units.into_iter().find(|(factor, _)| is(*factor)) {
        return Some(words.into());
    }
    let (columns, rows) = target.grid();
    [columns, rows].into_iter().filter(|n| *n > 2).find_map(|n| {
        let n = f64::from(n);
        // the whole width of n + 1 squares, divided by n corners; that of n - 1 squares between corners likewise
        let wrong = [(n / (n + 1.0), n + 1.0, n), (n / (n - 1.0), n - 1.0, n)];
        wrong.into_iter().find(|(factor, ..)| is(*factor)).map(|(_, right, counted)| {
            format!(
                "a length of {right:.0} squares was divided by {counted:.0}: squares and corners were mixed up"
            )
        })
    })
}

/// A wrong size that explains captures which contradict one another otherwise, with the usual mistake that makes it.
pub fn size_finding(size: &TargetScale, target: &TargetModel) -> TargetFinding {
    let TargetScale { value, sigma, .. } = *size;
    TargetFinding::ExplainsAll(Size {
        value,
        sigma,
        declared_mm: (target.pitch_m() * 1e6).round() / 1e3,
        cause: cause_of_size(value, target),
        beyond_printing: false,
        answer: SizeOfAnswer::Declared,
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_usual_mistakes_about_sizes_have_names() {
        let board = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 };
        let cause = |value: f64| cause_of_size(value, &board).unwrap_or_default();
        assert!(cause(10.003).contains("centimetres"));
        assert!(cause(25.3).contains("inches"));
        assert!(cause(0.5).contains("two squares"));
        assert!(cause(9.0 / 8.0).contains("8 squares was divided by 9"));
        assert!(cause(6.0 / 7.0).contains("7 squares was divided by 6"));
        assert!(cause(0.0394).contains("taken for inches"));
        assert!(cause(1e-3).contains("thousand times"));
        assert_eq!(cause_of_size(1.05, &board), None);
        let size = TargetScale { value: 2.0, sigma: 0.001, p_value: 0.0 };
        let words = size_finding(&size, &board).message();
        assert!(words.contains("(60.000 mm instead of 30 mm): half of the length"), "{words}");
    }
}
