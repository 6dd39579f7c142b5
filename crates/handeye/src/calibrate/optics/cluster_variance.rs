//! Errors that captures share, and what they do to an unknown that all captures tell together.
//!
//! An arm errs by place: captures that lie near one another err alike, and a lens, or a size, that is found from
//! them is less sure than white noise has it. How much less is seen where captures of one place are left out in
//! turn. With `δ_g` the step that follows for the others, and `ε_g` the same with the information of all captures, the
//! variance of the unknown along `d` is
//!
//! ```text
//! v = Σ_g (dᵀ ε_g)(dᵀ δ_g)          λ = v / dᵀ C d
//! ```
//!
//! which is that of white noise where the noise is white, however much of the information one place has. Along the
//! direction in which the unknowns leave what was declared, so that it is the finding itself which must hold without
//! each place. Few groups tell little of a variance: [`BEFOREHAND`] stands beside them.
//!
//! R. Bell and D. McCaffrey, *Bias reduction in standard errors for linear regression with multi-stage samples*,
//! Survey Methodology 28(2), 2002; R. Holmes and S. Walker, *Assigning a value to a power likelihood in a general
//! Bayesian model*, Biometrika 104(2), 2017.

use nalgebra::{DMatrix, DVector};

use crate::{
    PosePair,
    estimate::{ExtraKind, JointFit, Problem},
};

/// What arms do to such a variance before anything is seen of one, and how many groups that is worth.
const BEFOREHAND: (f64, f64) = (2.0, 3.0);
/// Captures in a group, and the most groups.
const IN_A_GROUP: usize = 3;
const MOST_GROUPS: usize = 8;
/// A turn (rad) as far as this way (m): arms err with both.
pub(crate) const WAY_OF_A_TURN: f64 = 0.5;

/// Of unknowns of a fit: by which factor their variance exceeds what white noise says.
pub(crate) fn excess(problem: &Problem, fit: &JointFit, of: impl Fn(ExtraKind) -> bool) -> f64 {
    let (before, worth) = BEFOREHAND;
    let Some((seen, freedom)) = seen_by_groups(problem, fit, of) else { return before };
    ((worth * before + freedom * seen) / (worth + freedom)).max(1.0)
}

/// The factor as the groups have it, and their degrees of freedom.
fn seen_by_groups(
    problem: &Problem,
    fit: &JointFit,
    of: impl Fn(ExtraKind) -> bool,
) -> Option<(f64, f64)> {
    let which: Vec<usize> =
        (0..problem.extras.len()).filter(|k| of(problem.extras[*k].kind)).collect();
    let n = which.len();
    let all = fit.covariance.as_ref()?;
    let own = DMatrix::from_fn(n, n, |a, b| all[(12 + which[a], 12 + which[b])]);
    let away = |k: usize| fit.values[which[k]] - problem.extras[which[k]].prior_mean;
    let along = own.clone().cholesky()?.solve(&DVector::from_fn(n, |k, _| away(k)));
    let expected = along.dot(&(&own * &along));
    let places: Vec<PosePair> = problem.views.iter().map(|v| v.pair).collect();
    let groups = by_place(&places);
    if groups.len() < 2 || !(expected > 0.0) {
        return None;
    }
    let moved = |step: &DVector<f64>| (0..n).map(|k| along[k] * step[12 + which[k]]).sum::<f64>();
    let steps = fit.steps_without(problem, &groups)?;
    let variance: f64 = steps.iter().map(|s| moved(&s.by_all) * moved(&s.by_others)).sum();
    Some((variance.max(0.0) / expected, steps.len() as f64 - 1.0))
}

/// Captures in groups of those that lie near one another: about centres that are as far from each other as can be.
fn by_place(places: &[PosePair]) -> Vec<Vec<usize>> {
    let count = (places.len() / IN_A_GROUP).min(MOST_GROUPS);
    if count < 2 {
        return vec![];
    }
    let way = |a: usize, b: usize| {
        let d = places[a].anchor_from_mount.local(&places[b].anchor_from_mount);
        let (turn, step) = (d.fixed_rows::<3>(0).norm(), d.fixed_rows::<3>(3).norm());
        step.hypot(WAY_OF_A_TURN * turn)
    };
    let mut centres = vec![0];
    let mut nearest: Vec<(f64, usize)> = (0..places.len()).map(|i| (way(0, i), 0)).collect();
    while centres.len() < count {
        let farthest =
            |best: usize, i: usize| if nearest[i].0 > nearest[best].0 { i } else { best };
        let next = (0..places.len()).fold(0, farthest);
        for (i, (least, group)) in nearest.iter_mut().enumerate() {
            let d = way(next, i);
            if d < *least {
                (*least, *group) = (d, centres.len());
            }
        }
        centres.push(next);
    }
    let of = |g: usize| (0..places.len()).filter(|i| nearest[*i].1 == g).collect();
    (0..count).map(of).filter(|g: &Vec<usize>| !g.is_empty()).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::sync::Arc;

    use nalgebra::{Isometry3, SMatrix, Vector3};

    use super::*;
    use crate::{
        Anchor, Camera, HandEye, Mount, Pose, Setup, Target,
        calibrate::optics::prior::SIZE,
        detect::sight::{CAMERA, Sight, TARGET_SCALE},
        estimate::{self, Extra, KnownNoise},
        math::random::Random,
        solve::View,
    };

    const ROBOT: f64 = 3e-4;
    /// Turns (rad) of the five places.
    const PLACES: [[f64; 3]; 5] =
        [[0.5, 0.0, 0.0], [-0.5, 0.1, 0.0], [0.0, 0.5, 0.4], [0.1, -0.5, 0.3], [0.0, 0.1, -0.6]];

    /// Captures at five places, the robot's errors partly alike where captures are near.
    fn problem(alike: f64, seed: u64) -> (Problem, HandEye) {
        let mut random = Random::new(seed);
        let x = Pose::<Mount, Camera>::claim(Isometry3::new(
            Vector3::new(0.05, 0.02, 0.1),
            Vector3::new(0.1, 0.2, 0.3),
        ));
        let y = Pose::<Anchor, Target>::claim(Isometry3::new(
            Vector3::new(0.6, 0.0, 0.1),
            Vector3::zeros(),
        ));
        let mut views = vec![];
        for middle in PLACES {
            let middle = Vector3::from(middle);
            let common = random.normal3() * ROBOT * alike;
            for _ in 0..5 {
                let turn = middle + 0.06 * random.normal3();
                let at = Vector3::new(0.5, 0.0, 0.8) + 0.5 * middle + 0.02 * random.normal3();
                let a = Isometry3::new(at, turn);
                let b = x.iso().inverse() * a.inverse() * y.iso();
                let off = Isometry3::new(common + random.normal3() * ROBOT, Vector3::zeros());
                let camera_from_target = Pose::claim(b);
                let mut moves = SMatrix::<f64, 6, CAMERA>::zeros();
                moves.set_column(TARGET_SCALE, &Sight::by_size(&camera_from_target));
                let pair = PosePair { anchor_from_mount: Pose::claim(off * a), camera_from_target };
                views
                    .push(View { sight: Some(Arc::new(Sight::moving(moves))), ..View::bare(pair) });
            }
        }
        let problem = Problem {
            setup: Setup::EyeInHand,
            views,
            boards: vec![],
            extras: vec![Extra::about_zero(SIZE, 0.1)],
            known_position: None,
        };
        (problem, HandEye { mount_from_camera: x, anchor_from_target: y })
    }

    fn mean_excess(alike: f64) -> f64 {
        let of = |seed| {
            let (problem, start) = problem(alike, seed);
            let fit = estimate::fit_joint(&problem, &start, &KnownNoise::default()).unwrap();
            excess(&problem, &fit, |kind| kind == SIZE)
        };
        (0..30).map(of).sum::<f64>() / 30.0
    }

    #[test]
    fn errors_that_captures_share_make_an_unknown_less_sure() {
        let (white, alike) = (mean_excess(0.0), mean_excess(2.0));
        println!("{white:.2} of white noise, {alike:.2} of errors by place");
        assert!((1.0..2.0).contains(&white), "{white}");
        assert!(alike > 1.5 * white, "{alike} after {white}");
    }

    #[test]
    fn groups_hold_what_lies_together() {
        let (problem, _) = problem(0.0, 1);
        let places: Vec<PosePair> = problem.views.iter().map(|v| v.pair).collect();
        let groups = by_place(&places);
        assert_eq!(groups.iter().map(Vec::len).sum::<usize>(), places.len());
        // eight groups of five places: none has captures of two
        for group in &groups {
            let of: Vec<usize> = group.iter().map(|i| i / 5).collect();
            assert!(of.iter().all(|p| *p == of[0]), "{groups:?}");
        }
    }

    #[test]
    fn few_captures_say_nothing_of_it() {
        let (mut problem, start) = problem(0.0, 2);
        problem.views.truncate(5);
        let fit = estimate::fit_joint(&problem, &start, &KnownNoise::default()).unwrap();
        assert_eq!(excess(&problem, &fit, |kind| kind == SIZE), BEFOREHAND.0);
    }
}
