//! The joint candidate: images and touches in one fit, and a systematic difference between the two where the data show
//! one. Touches that are outliers are rejected here one by one, each by a fit of everything else; `touch_outliers.rs` has
//! rejected those of other corners before.

use nalgebra::{DMatrix, DVector, Vector3};

use super::touched_boards::Boards;
use crate::{
    Config, TargetModel,
    calibrate::{
        flow::{
            notes::Notes,
            views::{Views, views_problem},
        },
        optics::{
            alternatives::{Alternatives, Averaged},
            prior::Declared,
        },
        result::TipResult,
    },
    estimate::{
        Extra, ExtraKind, JointFit, KnownNoise, Problem, TouchedBoard,
        evaluate::{self, HeldOut},
        extra::{SYSTEMATIC, TIP_PRIOR, systematic, tip},
        joint,
    },
    findings::TouchFinding,
    math::{linalg::root_mean, parallel, statistics},
    model::residual::Residual,
    solve::View,
};

/// What views and touches say together.
pub(crate) struct Joint {
    pub problem: Problem,
    pub fit: JointFit,
    /// Which touches of the session were used.
    pub used: Vec<usize>,
    /// Touches left out, and the chance of one as far off.
    pub left_out: Vec<(usize, f64)>,
    /// The conflict of views and touches.
    pub conflict: Option<Conflict>,
    /// A tool tip that is wrong.
    pub wrong_tip: Option<WrongTip>,
    /// Posterior probabilities that size and depth are as declared.
    pub as_declared: Declared<f64>,
}

/// How far views and touches are from agreeing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Conflict {
    /// Chance of a disagreement as large when there is none.
    pub p_value: f64,
    /// Strength of the systematic difference that explains it best, in its own units; zero where
    /// none is needed.
    pub strength: f64,
}

/// Fits views and touches together; `extras` are free beside the tip.
pub(crate) fn fit(
    views: &Views,
    boards: &Boards,
    extras: &[Extra],
    start: &JointFit,
    known: &KnownNoise,
) -> Option<Joint> {
    let mut problem = Problem {
        boards: boards.boards.clone(),
        ..views_problem(views.session, &views.views, &[extras, &tip_with_prior(known)].concat())
    };
    if problem.boards.is_empty() {
        return None;
    }
    let mut touches = boards.touches.clone();
    let alternatives = Alternatives::of(views.session);
    let first = alternatives.fit(&problem, &start.hand_eye, known).ok()?;
    // what follows looks for other mistakes under the likeliest size
    problem = first.problem;
    let mut fit = joint::refit(&problem, &first.fit, known);
    let left_out = reject_outliers(&mut problem, &mut touches, &mut fit, known);
    let wrong_tip = free_wrong_tip(&mut problem, &mut fit, known);
    let conflict = conflict(&problem, &fit, wrong_tip.is_some());
    if let Some(conflict) = conflict
        && conflict.strength > 0.0
    {
        problem.extras.extend(systematic(conflict.strength));
        fit = joint::refit(&problem, &fit, known);
    }
    let Averaged { problem, fit, as_declared } = alternatives.refit(&problem, &fit, known);
    Some(Joint { problem, fit, used: touches.concat(), left_out, conflict, wrong_tip, as_declared })
}

/// The tip as free as the user's knowledge of it leaves it.
fn tip_with_prior(known: &KnownNoise) -> [Extra; 3] {
    tip(known.tip_m.unwrap_or(TIP_PRIOR))
}

/// Prior standard deviation of a tip that is known to be wrong, m per axis.
const WRONG_TIP_PRIOR: f64 = 20e-3;

/// Tests whether the tip is where the robot has it; if not, estimates it with a wide prior.
fn free_wrong_tip(
    problem: &mut Problem,
    fit: &mut JointFit,
    known: &KnownNoise,
) -> Option<WrongTip> {
    let others: Vec<Extra> =
        problem.extras.iter().filter(|e| !matches!(e.kind, ExtraKind::Tip(_))).copied().collect();
    let without = Problem { extras: others.clone(), ..problem.clone() };
    let fixed = joint::refit(&without, fit, known);
    let (h, g) = score(&without, &fixed, &tip(TIP_PRIOR))?;
    let (d2, rank) = significance(&h, &g);
    let p_value = statistics::of_chi_square(d2, rank);
    let (h_systematic, g_systematic) = score(&without, &fixed, &systematic(1.0))?;
    let as_systematic = most_gain(&h_systematic, &g_systematic, &STRENGTHS);
    if p_value > WRONG_TIP || most_gain(&h, &g, &TIP_SIZES) < as_systematic {
        return None;
    }
    problem.extras = [others.as_slice(), &tip(WRONG_TIP_PRIOR)].concat();
    *fit = joint::refit(problem, fit, known);
    let offset = Vector3::from_fn(|k, _| fit.extra(ExtraKind::Tip(k)).map_or(0.0, |e| e.0));
    let in_flange =
        problem.boards.iter().flat_map(|b| &b.corners).all(|c| c.base_from_flange.is_some());
    Some(WrongTip { offset, in_flange, p_value })
}

/// `gᵀ H⁺ g` and the rank of `H`.
fn significance(h: &DMatrix<f64>, g: &DVector<f64>) -> (f64, usize) {
    let eigen = h.clone().symmetric_eigen();
    let most = eigen.eigenvalues.max();
    let (mut d2, mut rank) = (0.0, 0);
    for (k, value) in eigen.eigenvalues.iter().enumerate() {
        // directions in which a unit difference would not be seen at all say nothing
        if *value > 1e-6 * most {
            d2 += eigen.eigenvectors.column(k).dot(g).powi(2) / value;
            rank += 1;
        }
    }
    (d2, rank)
}

/// Chance of a touch as far off as it is below which it is left out.
const IMPROBABLE_TOUCH: f64 = 1e-4;

/// Rejects, one by one, touches that are outliers to a fit made without them.
fn reject_outliers(
    problem: &mut Problem,
    touches: &mut [Vec<usize>],
    fit: &mut JointFit,
    known: &KnownNoise,
) -> Vec<(usize, f64)> {
    let mut left_out = vec![];
    loop {
        let count: usize = problem.boards.iter().map(|b| b.corners.len()).sum();
        if count < 4 || left_out.len() * 3 > count {
            return left_out;
        }
        let Some((board, corner)) = worst_touch(problem, fit) else { return left_out };
        let mut without = problem.clone();
        let removed = without.boards[board].corners.remove(corner);
        let alone = TouchedBoard { corners: vec![removed], ..problem.boards[board].clone() };
        let refitted = joint::refit(&without, fit, known);
        let Some(d2) = refitted.squared_mahalanobis_of_touch(&without, &alone) else {
            return left_out;
        };
        let dof = 3.0 * (count as f64 - 1.0);
        let p = statistics::of_f(d2 / 3.0, (3.0, dof));
        if p * count as f64 > IMPROBABLE_TOUCH {
            return left_out;
        }
        left_out.push((touches[board].remove(corner), p));
        (*problem, *fit) = (without, refitted);
    }
}

/// The touch whose removal promises most: the largest residual in units of the noise.
fn worst_touch(problem: &Problem, fit: &JointFit) -> Option<(usize, usize)> {
    let mut worst: Option<(f64, (usize, usize))> = None;
    for (b, board) in problem.boards.iter().enumerate() {
        for (k, corner) in board.corners.iter().enumerate() {
            let alone = TouchedBoard { corners: vec![corner.clone()], ..board.clone() };
            let size = fit.squared_residual_over_noise(problem, &alone)?;
            if worst.is_none_or(|(most, _)| size > most) {
                worst = Some((size, (b, k)));
            }
        }
    }
    worst.map(|(_, place)| place)
}

/// Strengths of a systematic difference that are tried.
const STRENGTHS: [f64; 6] = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0];
/// A systematic difference is part of the model when one of a usual strength raises the logarithm
/// of the likelihood by more than this. A lower bar would find more of those there are, but costs an
/// exact robot that has none half of its accuracy.
const NOTICED_GAIN: f64 = 1.0;
const USUAL_STRENGTH: f64 = 0.75;
/// Beside a wrong tip, it must raise the logarithm of the likelihood by more.
const EXPLAINED_GAIN: f64 = 3.0;
/// Sizes of a tip's error that are tried, m.
const TIP_SIZES: [f64; 6] = [0.25e-3, 0.5e-3, 1e-3, 2e-3, 5e-3, 20e-3];

/// By how much an unknown of the likeliest size raises the logarithm of the likelihood.
fn most_gain(h: &DMatrix<f64>, g: &DVector<f64>, sizes: &[f64]) -> f64 {
    sizes.iter().map(|s| gain(h, g, *s)).fold(f64::NEG_INFINITY, f64::max)
}

/// Tests whether views and touches agree, and finds the systematic difference that explains best
/// why not.
fn conflict(problem: &Problem, fit: &JointFit, explained: bool) -> Option<Conflict> {
    let (h, g) = score(problem, fit, &systematic(1.0))?;
    let (d2, rank) = significance(&h, &g);
    let p_value = statistics::of_chi_square(d2, rank);
    let gains = STRENGTHS.map(|s| gain(&h, &g, s));
    let best = (0..gains.len()).max_by(|&a, &b| gains[a].total_cmp(&gains[b]))?;
    // a tip that had to be found leaves little that could tell a second difference from noise
    let noticed = if explained {
        gains[best] > EXPLAINED_GAIN
    } else {
        gain(&h, &g, USUAL_STRENGTH) > NOTICED_GAIN
    };
    let strength = if noticed { STRENGTHS[best] } else { 0.0 };
    Some(Conflict { p_value, strength })
}

/// By how much a Gaussian unknown of this strength raises the logarithm of the likelihood.
fn gain(h: &DMatrix<f64>, g: &DVector<f64>, strength: f64) -> f64 {
    if strength == 0.0 {
        return 0.0;
    }
    let n = h.nrows();
    let with_prior = h + DMatrix::identity(n, n) * strength.powi(-2);
    let Some(cholesky) = with_prior.cholesky() else { return f64::NEG_INFINITY };
    let log_determinant: f64 = cholesky.l().diagonal().iter().map(|d| 2.0 * d.ln()).sum();
    let prior = 2.0 * n as f64 * strength.ln();
    0.5 * (g.dot(&cholesky.solve(g)) - log_determinant - prior)
}

/// Information and score of unknowns that are not free yet, marginal over those that are.
fn score(
    problem: &Problem,
    fit: &JointFit,
    more: &[Extra],
) -> Option<(DMatrix<f64>, DVector<f64>)> {
    let mut wider = problem.clone();
    wider.extras.extend_from_slice(more);
    let (h, g) = joint::normal_equations(&wider, fit);
    let p = fit.information.nrows();
    let n = more.len();
    let own = h.view((p, p), (n, n)).into_owned();
    // the prior of the new unknowns is not part of what the data say
    let prior = DVector::from_iterator(n, more.iter().map(|e| e.prior_sigma.powi(-2)));
    let own = own - DMatrix::from_diagonal(&prior);
    let cross = h.view((p, 0), (n, p)).into_owned();
    let through = &cross * fit.covariance.as_ref()?;
    let gradient = g.rows(p, n) - &through * g.rows(0, p);
    Some((own - &through * cross.transpose(), -gradient))
}

/// Chance of a disagreement between views and touches below which it is called systematic.
const CONFLICT: f64 = 1e-3;
/// A tip is named as wrong when the data say so with less than this chance of error.
const WRONG_TIP: f64 = 1e-3;

impl Joint {
    /// RMS distance of tip and corner over the touches that were used, tip corrected (m).
    pub(crate) fn touch_rms(&self) -> Option<f64> {
        let residuals =
            self.problem.boards.iter().flat_map(|b| self.fit.touch_residuals(&self.problem, b));
        root_mean(residuals.map(|e| e.norm_squared()))
    }

    /// RMS distance (m) of tip and corner over touches left out of the fit: one board at a time
    /// where there are several, one touch at a time otherwise.
    pub(crate) fn held_out_touches(&self, config: &Config) -> Option<f64> {
        let boards = &self.problem.boards;
        let first = boards.first()?;
        let of_board = |k: usize| {
            let mut without = self.problem.clone();
            let board = without.boards.remove(k);
            self.missed(&without, &board, &config.known)
        };
        let of_corner = |k: usize| {
            let mut without = self.problem.clone();
            let corner = without.boards[0].corners.remove(k);
            let alone = TouchedBoard { corners: vec![corner], ..first.clone() };
            self.missed(&without, &alone, &config.known)
        };
        let squares = match boards.len() {
            1 => parallel::in_order(first.corners.len(), config.threads, of_corner),
            count => parallel::in_order(count, config.threads, of_board),
        };
        root_mean(squares.into_iter().flatten())
    }

    fn missed(&self, without: &Problem, board: &TouchedBoard, known: &KnownNoise) -> Vec<f64> {
        let refitted = joint::refit(without, &self.fit, known);
        refitted.touch_residuals(without, board).iter().map(|e| e.norm_squared()).collect()
    }

    /// What to know about the fit.
    pub(crate) fn note(&self) -> Option<String> {
        let strength = self.conflict?.strength;
        (strength > 0.0).then(|| {
            let Residual { angle: turn, distance: step } = SYSTEMATIC;
            format!(
                "views and touches differ systematically; a difference of about {:.2} mm and {:.3} \
                 degrees per axis is part of the model",
                strength * step * 1e3,
                strength * turn.to_degrees()
            )
        })
    }

    /// A tip that is off, unless that is `explained` by something else, and what is said of it, of rejected touches and of
    /// a conflict of views and touches.
    pub(crate) fn findings(&self, views: &Views, explained: bool) -> (Option<TipResult>, Notes) {
        let outlier = |&(k, p_value): &(usize, f64)| {
            let touch = &views.session.touches[k];
            let (corner, placement) = (touch.corner, touch.placement.clone());
            TouchFinding::Outlier { corner, placement, p_value }
        };
        let mut notes = Notes::of(self.left_out.iter().map(outlier));
        let Some(conflict) = self.conflict else { return (None, notes) };
        let tip = self.wrong_tip.as_ref().filter(|_| !explained).map(|tip| {
            notes.note(TouchFinding::TipOff {
                offset_mm: (tip.offset * 1e3).into(),
                in_flange: tip.in_flange,
                p_value: tip.p_value,
                squares: squares(tip.offset.norm(), views.session.target.as_ref()),
            });
            let sigma = |k| self.fit.extra(ExtraKind::Tip(k)).map_or(0.0, |t| t.1 * 1e3);
            TipResult {
                offset_mm: (tip.offset * 1e3).into(),
                sigma_mm: std::array::from_fn(sigma),
                frame: if tip.in_flange { "flange" } else { "base" }.into(),
            }
        });
        if conflict.strength > 0.0 && conflict.p_value < CONFLICT {
            notes.note(TouchFinding::ViewsDisagree { p_value: conflict.p_value });
        }
        (tip, notes)
    }
}

/// An offset of the tip is that of squares within this part of their size.
const LIKE_SQUARES: f64 = 0.03;
/// Squares by which corners are miscounted, at most.
const MOST_SQUARES: u32 = 2;

/// One square or two, where an offset of the tip (m) is as large: then the corners may be miscounted instead.
fn squares(offset: f64, target: Option<&TargetModel>) -> Option<u32> {
    let pitch = target.filter(|t| t.len() > 4)?.pitch_m();
    let like = |n: &u32| (offset / (f64::from(*n) * pitch) - 1.0).abs() < LIKE_SQUARES;
    (1..=MOST_SQUARES).find(like)
}

/// A tool tip that is not where the robot believes it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WrongTip {
    /// Its best estimate minus what the robot believes (m).
    pub offset: Vector3<f64>,
    /// Whether that is in the flange frame; in the base where no flange pose was recorded.
    pub in_flange: bool,
    /// Chance of an estimate as large when the tip is right.
    pub p_value: f64,
}

/// Leave-one-out residual of every view.
pub(crate) fn held_out_views(problem: &Problem, fit: &JointFit, config: &Config) -> HeldOut {
    evaluate::each_left_out(&problem.views, config.threads, |rest, left_out| {
        let others = Problem { views: rest, ..problem.clone() };
        let refitted = joint::refit(&others, fit, &config.known);
        let missed = |view: &&View| {
            let pair = view.with(&refitted.extras, &refitted.values);
            refitted.hand_eye.loop_residual(&pair)
        };
        Some(left_out.iter().map(missed).collect())
    })
}
