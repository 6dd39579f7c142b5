//! One linear fit for each way in which something may have moved, weighed by their restricted likelihood.

use nalgebra::{Cholesky, Matrix6, SMatrix, SVector, Vector3, Vector6};

use crate::calibrate::flow::limits::VERY_MANY;

/// Fewest captures on either side of a step.
const FEWEST_BESIDE: usize = 3;
/// Prior probability that something moves in a session.
pub(in super::super) const PRIOR: f64 = 0.2;
/// Standard deviations of a movement, per axis: rad and m alike. Small and large ones are equally probable beforehand.
const SIZES: [f64; 3] = [0.5e-3, 1.5e-3, 5e-3];
/// The side that moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Camera,
    Target,
}

pub(super) const SIDES: [Side; 2] = [Side::Camera, Side::Target];

/// One capture, linearised at the answer and whitened.
pub(crate) struct Row {
    pub residual: Vector6<f64>,
    /// By both poses.
    pub jacobian: SMatrix<f64, 6, 12>,
    /// Where it saw the target, in the camera frame.
    pub seen: Vector3<f64>,
}

impl Row {
    pub(super) fn by(&self, side: Side) -> Matrix6<f64> {
        let first = if side == Side::Camera { 0 } else { 6 };
        self.jacobian.fixed_columns::<6>(first).into_owned()
    }
}

/// One way in which something may have moved.
#[derive(Clone, Copy)]
pub(super) struct Hypothesis {
    pub side: Side,
    /// The first capture after a step; `None` for a slip.
    pub step: Option<usize>,
    /// Standard deviation of the movement, per axis (rad, m).
    pub size: f64,
}

impl Hypothesis {
    /// Half of the prior probability goes to slips, half to steps.
    fn log_prior(&self, steps: usize) -> f64 {
        let of = if self.step.is_some() { steps as f64 } else { 1.0 };
        (PRIOR / (2.0 * (SIDES.len() * SIZES.len()) as f64 * of)).ln()
    }
}

/// Sums over captures, of their equations for rotations and for positions, all that a linear fit needs.
#[derive(Clone, Copy, Default)]
pub(super) struct Sums([Normal; 2]);

/// Sums of `JᵀJ`, `Jᵀr` and `r²`.
#[derive(Clone, Copy, Default)]
pub(super) struct Normal {
    matrix: SMatrix<f64, 12, 12>,
    right: SVector<f64, 12>,
    square: f64,
}

impl Sums {
    fn add(&mut self, row: &Row, share: f64) {
        for (k, sums) in self.0.iter_mut().enumerate() {
            let j = row.jacobian.fixed_rows::<3>(3 * k);
            let r = row.residual.fixed_rows::<3>(3 * k);
            sums.matrix += j.tr_mul(&j) * share;
            sums.right += j.tr_mul(&r) * share;
            sums.square += r.norm_squared() * share;
        }
    }

    pub fn of(rows: &[Used], share: impl Fn(usize) -> f64) -> Self {
        let mut sums = Self::default();
        for (k, (_, row)) in rows.iter().enumerate() {
            sums.add(row, share(k));
        }
        sums
    }
}

/// The sums in which a movement is: with the share of each capture, and with its square.
pub(super) struct Displaced<'a> {
    by: &'a Hypothesis,
    once: &'a Sums,
    twice: &'a Sums,
}

/// One linear fit.
pub(super) struct Linear {
    pub solution: SVector<f64, UNKNOWNS>,
    log_evidence: f64,
    /// Squares that are left, of rotations and of positions.
    left: [f64; 2],
}

/// A capture that agrees: which of the session, and its equations.
pub(super) type Used<'a> = (usize, &'a Row);

/// A way in which something may have moved, its logarithm of the likelihood, and the fit under it.
pub(super) type Weighed = (f64, Hypothesis, Linear);

/// Every way of moving, with its likelihood beside that of standing still.
pub(super) fn weighed(rows: &[Used], all: &Sums, still: &Linear) -> Vec<Weighed> {
    let n = rows.len();
    let apart = n.div_ceil(VERY_MANY);
    let steps: Vec<usize> = (FEWEST_BESIDE..=n - FEWEST_BESIDE).step_by(apart).collect();
    let mut found = vec![];
    let mut look = |step: Option<usize>, once: &Sums, twice: &Sums| {
        let sizes = SIZES.into_iter().flat_map(|size| SIDES.map(|side| (side, size)));
        found.extend(sizes.filter_map(|(side, size)| {
            let by = Hypothesis { side, step, size };
            let fit = linear(n, all, Some(Displaced { by: &by, once, twice }))?;
            Some((by.log_prior(steps.len()) + fit.log_evidence - still.log_evidence, by, fit))
        }));
    };
    let (mut before, mut counted) = (Sums::default(), 0);
    for &step in &steps {
        for (_, row) in &rows[counted..step] {
            before.add(row, 1.0);
        }
        counted = step;
        look(Some(step), &before, &before);
    }
    let share = |k: usize| 1.0 - k as f64 / (n - 1) as f64;
    look(None, &Sums::of(rows, share), &Sums::of(rows, |k| share(k).powi(2)));
    found
}

/// Rounds in which the noise settles.
const ROUNDS: usize = 4;
/// Least part of the noise that may be left: a fit is not better than its instruments.
const LEAST_NOISE: f64 = 1e-2;

/// Unknowns of a fit: both poses, and a movement.
const UNKNOWNS: usize = 18;

/// The normal equations of rotations or of positions, by both poses and the movement where there is one.
struct OfKind {
    matrix: SMatrix<f64, UNKNOWNS, UNKNOWNS>,
    right: SVector<f64, UNKNOWNS>,
    square: f64,
}

/// Fits both poses, a movement where there is one, and how large the noise of rotations and of positions is then: what
/// moved in positions alone would otherwise be judged by a noise that it made itself.
pub(super) fn linear(captures: usize, all: &Sums, movement: Option<Displaced>) -> Option<Linear> {
    let equations = 3.0 * captures as f64;
    let of_kind = [0, 1].map(|kind| normal(kind, all, movement.as_ref()));
    let size = movement.map(|m| m.by.size);
    let mut variances = [1.0, 1.0];
    let mut fit = weighted(&of_kind, size, variances)?;
    for _ in 0..ROUNDS {
        variances = fit.left.map(|left| (left / (equations - 6.0)).max(LEAST_NOISE));
        fit = weighted(&of_kind, size, variances)?;
    }
    let of_noise = equations * (variances[0].ln() + variances[1].ln());
    let of_squares = fit.left[0] / variances[0] + fit.left[1] / variances[1];
    fit.log_evidence -= 0.5 * (of_noise + of_squares);
    Some(fit)
}

fn normal(kind: usize, all: &Sums, movement: Option<&Displaced>) -> OfKind {
    let sums = &all.0[kind];
    let mut matrix = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
    let mut right = SVector::<f64, UNKNOWNS>::zeros();
    matrix.fixed_view_mut::<12, 12>(0, 0).copy_from(&sums.matrix);
    right.fixed_rows_mut::<12>(0).copy_from(&sums.right);
    if let Some(Displaced { by, once, twice }) = movement {
        let first = if by.side == Side::Camera { 0 } else { 6 };
        let (once, twice) = (&once.0[kind], &twice.0[kind]);
        let beside = once.matrix.fixed_columns::<6>(first);
        matrix.fixed_view_mut::<12, 6>(0, 12).copy_from(&beside);
        matrix.fixed_view_mut::<6, 12>(12, 0).copy_from(&beside.transpose());
        let own = twice.matrix.fixed_view::<6, 6>(first, first);
        matrix.fixed_view_mut::<6, 6>(12, 12).copy_from(&own);
        right.fixed_rows_mut::<6>(12).copy_from(&once.right.fixed_rows::<6>(first));
    }
    OfKind { matrix, right, square: sums.square }
}

/// The fit under noise of these variances, as shares of those that the rows are whitened by. Without a movement (of
/// `size`, rad and m per axis) its unknowns stay zero, and their prior of one says nothing.
fn weighted(of_kind: &[OfKind; 2], size: Option<f64>, variances: [f64; 2]) -> Option<Linear> {
    let mut whole = of_kind[0].matrix / variances[0] + of_kind[1].matrix / variances[1];
    let right = of_kind[0].right / variances[0] + of_kind[1].right / variances[1];
    let size = size.unwrap_or(1.0);
    (12..UNKNOWNS).for_each(|k| whole[(k, k)] += size.powi(-2));
    let of_prior = 2.0 * (UNKNOWNS - 12) as f64 * size.ln();
    let cholesky = Cholesky::new(whole)?;
    let solution = -cholesky.solve(&right);
    let log_determinant: f64 = cholesky.l_dirty().diagonal().iter().map(|d| 2.0 * d.ln()).sum();
    let left = of_kind.each_ref().map(|kind| {
        let by_solution = 2.0 * solution.dot(&kind.right) + solution.dot(&(kind.matrix * solution));
        (kind.square + by_solution).max(0.0)
    });
    let by_prior = solution.fixed_rows::<6>(12).norm_squared() / size.powi(2);
    let log_evidence = -0.5 * (log_determinant + of_prior + by_prior);
    Some(Linear { solution, log_evidence, left })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::*;
    use crate::math::random::Random;

    fn rows(count: usize, scale: f64) -> Vec<Row> {
        let mut random = Random::new(7);
        let mut one = || Row {
            residual: Vector6::from_fn(|_, _| random.normal()),
            jacobian: SMatrix::from_fn(|_, _| scale * random.normal()),
            seen: Vector3::zeros(),
        };
        (0..count).map(|_| one()).collect()
    }

    #[test]
    fn sums_leave_what_the_captures_one_by_one_leave() {
        let rows = rows(12, 100.0);
        let used: Vec<Used> = rows.iter().enumerate().collect();
        let all = Sums::of(&used, |_| 1.0);
        for which in [Some(5), None] {
            let share = |k: usize| match which {
                Some(step) => f64::from(u8::from(k < step)),
                None => 1.0 - k as f64 / 11.0,
            };
            for side in SIDES {
                let by = Hypothesis { side, step: which, size: 5e-3 };
                let (once, twice) = (Sums::of(&used, share), Sums::of(&used, |k| share(k).powi(2)));
                let movement = Displaced { by: &by, once: &once, twice: &twice };
                let of_kind = [0, 1].map(|kind| normal(kind, &all, Some(&movement)));
                let found = weighted(&of_kind, Some(by.size), [1.0, 1.0]).unwrap();
                let mut left = [0.0; 2];
                for (k, row) in rows.iter().enumerate() {
                    let poses = row.jacobian * found.solution.fixed_rows::<12>(0);
                    let moved = row.by(side) * found.solution.fixed_rows::<6>(12) * share(k);
                    let r = row.residual + poses + moved;
                    left[0] += r.fixed_rows::<3>(0).norm_squared();
                    left[1] += r.fixed_rows::<3>(3).norm_squared();
                }
                for kind in 0..2 {
                    assert!((left[kind] - found.left[kind]).abs() < 1e-9, "{left:?}");
                }
            }
        }
    }

    /// Six unknowns that nothing moves say nothing of the others, nor of the evidence.
    #[test]
    fn a_fit_without_movement_is_that_of_both_poses_alone() {
        let rows = rows(12, 100.0);
        let used: Vec<Used> = rows.iter().enumerate().collect();
        let all = Sums::of(&used, |_| 1.0);
        let of_kind = [0, 1].map(|kind| normal(kind, &all, None));
        let found = weighted(&of_kind, None, [1.0, 2.0]).unwrap();
        let whole = all.0[0].matrix + all.0[1].matrix / 2.0;
        let right = all.0[0].right + all.0[1].right / 2.0;
        let alone = Cholesky::new(whole).unwrap();
        let apart = found.solution.fixed_rows::<12>(0) + alone.solve(&right);
        assert!(apart.norm() < 1e-12 && found.solution.fixed_rows::<6>(12).norm() == 0.0);
        assert!((found.log_evidence + 0.5 * alone.determinant().ln()).abs() < 1e-9);
    }

    #[test]
    fn where_steps_are_looked_for_at_few_places_one_is_found_near_its_own() {
        let mut rows = rows(3 * VERY_MANY, 1e3);
        let delta = Vector6::new(1e-3, -1e-3, 2e-3, 3e-3, 1e-3, -2e-3);
        for row in &mut rows[..250] {
            row.residual -= row.by(Side::Target) * delta;
        }
        let used: Vec<Used> = rows.iter().enumerate().collect();
        let all = Sums::of(&used, |_| 1.0);
        let still = linear(used.len(), &all, None).unwrap();
        let found = weighed(&used, &all, &still);
        let best = found.iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        assert!(best.1.side == Side::Target && best.1.step.unwrap().abs_diff(250) <= 3);
        assert!((best.2.solution.fixed_rows::<6>(12) - delta).norm() < 2e-4);
    }

    #[test]
    fn prior_probabilities_of_all_movements_add_up() {
        let steps = 7;
        let one = |side, step, size| Hypothesis { side, step, size }.log_prior(steps).exp();
        let of = |(side, size)| one(side, None, size) + steps as f64 * one(side, Some(4), size);
        let all = SIZES.into_iter().flat_map(|size| SIDES.map(|side| (side, size)));
        assert!((all.map(of).sum::<f64>() - PRIOR).abs() < 1e-12);
    }
}
