//! The rigid answer for a robot that errs by place.
//!
//! `X` and `Y` of a fit with errors by place are those of errors whose mean over all places is zero. No robot works
//! at all places, and a controller that moves by one transform needs the one that fits best where it works: there
//! errors have a mean, a slope, a turn, and these belong into the answer. Of residuals without noise,
//! `r_w = J_w (δ' - δ) - G_w b` at poses `w`, the best answer is
//!
//! ```text
//! δ* = δ + Γ b        Γ = (Σ J_wᵀ W J_w)⁻¹ Σ J_wᵀ W G_w        W = mean over the points of the target
//! ```
//!
//! linear in the unknowns of the fit, so that mean and covariance follow from theirs. What no rigid answer takes away,
//! `e_w = (J_w Γ - G_w) b`, is how far the robot misses at each pose. Where only the captures say where the robot
//! works, they are a sample of it, and the best answer of another sample differs by
//!
//! ```text
//! H (Σ s_w s_wᵀ) H        s_w = J_wᵀ W (1 - h_w)⁻¹ e_w,   h_w = J_w H J_wᵀ W,   H = (Σ J_wᵀ W J_w)⁻¹
//! ```
//!
//! M. Kennedy and A. O'Hagan, *Bayesian calibration of computer models*, JRSS B 63, 2001; R. Tuo and C. Wu, *Efficient
//! calibration for imperfect computer models*, Annals of Statistics 43, 2015; the last is HC3 of J. MacKinnon and
//! H. White, Journal of Econometrics 29, 1985.

use nalgebra::{DMatrix, DVector, Matrix6, SMatrix, Vector3, Vector6};

use super::{JointFit, Problem, Source};
use crate::{
    HandEye,
    math::{lie, linalg},
    solve::least_squares::{self, Matrix12, Vector12, residual_with_jacobian},
};

type Matrix6x12 = SMatrix<f64, 6, 12>;

/// The rigid answer beside a fit with errors by place.
pub(crate) struct Projection {
    /// `Γ`, a column for each extra of the fit; zero for all but those of the robot.
    pub carry: DMatrix<f64>,
    /// `Γ b`: the step from the fit to the rigid answer.
    pub step: Vector12,
    /// Covariance that comes from the captures' being a sample.
    pub sampling: Matrix12,
    /// Mean square (m², per axis) of what the robot misses at a capture, with the rigid answer.
    pub missed: f64,
}

/// What a residual costs: the mean square over points of the target that it moves.
pub(crate) fn metric(points: &[Vector3<f64>]) -> Matrix6<f64> {
    let one = |p: &Vector3<f64>| {
        let mut j = nalgebra::Matrix3x6::zeros();
        j.fixed_view_mut::<3, 3>(0, 0).copy_from(&-lie::hat(p));
        j.fixed_view_mut::<3, 3>(0, 3).fill_with_identity();
        j.transpose() * j
    };
    points.iter().map(one).sum::<Matrix6<f64>>() / points.len().max(1) as f64
}

/// A view's part: how its residual moves with both poses, and with the extras.
struct Row {
    j: Matrix6x12,
    by_extras: DMatrix<f64>,
}

impl Projection {
    /// For the views `at` which the robot works. `values` are those of the fit's extras; of an arm about which the fit is
    /// linear, whole ones. `None` where these views do not determine an answer.
    pub fn new(
        (problem, fit): (&Problem, &JointFit),
        values: &DVector<f64>,
        metric: &Matrix6<f64>,
        at: &[usize],
    ) -> Option<Self> {
        let n = problem.extras.len();
        let rows: Vec<Row> = at.iter().map(|&i| row(problem, fit, i)).collect();
        let (carry, inverse) = carry(rows.iter(), n, metric)?;
        let step = &carry * values;
        let covariance = fit.covariance.as_ref()?;
        let own = covariance.view((12, 12), (n, n));
        let (mut sum, mut missed) = (Matrix12::zeros(), 0.0);
        for row in &rows {
            let left = row.j * &carry - &row.by_extras;
            let e: Vector6<f64> = Vector6::from_iterator((&left * values).iter().copied());
            let open = &left * own * left.transpose();
            missed += e.dot(&(metric * e)) + (metric * open).trace();
            let leverage = row.j * inverse * row.j.transpose() * metric;
            let alone = (Matrix6::identity() - leverage).try_inverse().unwrap_or_default() * e;
            let s = row.j.transpose() * (metric * alone);
            sum += s * s.transpose();
        }
        let step = Vector12::from_iterator(step.iter().copied());
        let missed = missed / (3.0 * rows.len() as f64);
        Some(Self { carry, step, sampling: inverse * sum * inverse, missed })
    }

    /// Variance per axis (m²) of what the robot misses where it goes once, with the rigid answer: its errors from pose to
    /// pose are in it.
    pub fn missed_once(&self, fit: &JointFit, metric: &Matrix6<f64>) -> f64 {
        let of = |source| fit.noise.sigma(source).unwrap_or(0.0).powi(2);
        let lever = metric.fixed_view::<3, 3>(0, 0).trace() / 3.0;
        self.missed + of(Source::RobotPosition) + of(Source::RobotRotation) * lever
    }

    /// Covariance of the rigid answer, for one of all unknowns of the fit.
    pub fn covariance(&self, of_fit: &DMatrix<f64>) -> Matrix12 {
        let n = self.carry.ncols();
        let mut by_all = DMatrix::identity(12, 12 + n);
        by_all.view_mut((0, 12), (12, n)).copy_from(&self.carry);
        let own = &by_all * of_fit * by_all.transpose();
        Matrix12::from_iterator(own.iter().copied()) + self.sampling
    }
}

/// `Γ` over these rows, and `(Σ JᵀWJ)⁻¹`; `n` extras.
fn carry<'a>(
    rows: impl Iterator<Item = &'a Row>,
    n: usize,
    metric: &Matrix6<f64>,
) -> Option<(DMatrix<f64>, Matrix12)> {
    let (mut squares, mut mixed) = (DMatrix::zeros(12, 12), DMatrix::zeros(12, n));
    for row in rows {
        let jw = row.j.transpose() * metric;
        squares += jw * row.j;
        mixed += jw * &row.by_extras;
    }
    let inverse = linalg::inverse_spd(&squares)?;
    // by_extras is ∂r/∂b, and r = J (δ' - δ) - (∂r/∂b) b without noise
    let carry = &inverse * mixed;
    Some((carry, Matrix12::from_iterator(inverse.iter().copied())))
}

/// Which answer is asked for what it misses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Asked {
    /// The rigid one.
    Rigid,
    /// The fit's, errors by place taken away as it tells them.
    Whole,
}

/// What views miss (m, root mean square over points of the target) that are left out in groups, with the noise as it
/// is.
pub(crate) fn missed_without(
    problem: &Problem,
    fit: &JointFit,
    (asked, metric): (Asked, &Matrix6<f64>),
    groups: &[Vec<usize>],
) -> Option<f64> {
    let n = problem.extras.len();
    let rows: Vec<Row> = (0..problem.views.len()).map(|i| row(problem, fit, i)).collect();
    let (mut sum, mut count) = (0.0, 0.0);
    for (group, step) in groups.iter().zip(fit.steps_without(problem, groups)?) {
        let mut values = &fit.values + step.by_others.rows(12, n);
        let mut own = step.by_others.rows(0, 12).into_owned();
        if asked == Asked::Rigid {
            let others = rows.iter().enumerate().filter(|(i, _)| !group.contains(i));
            own += carry(others.map(|(_, row)| row), n, metric)?.0 * &values;
            let by_place = fit.extras.iter().map(|e| e.kind.level().is_some());
            values.iter_mut().zip(by_place).for_each(|(v, is)| *v = if is { 0.0 } else { *v });
        }
        let answer = moved(&fit.hand_eye, &own);
        for &i in group {
            let pair = problem.views[i].with(&fit.extras, &values);
            let r = least_squares::residual(&answer, &pair);
            sum += r.dot(&(metric * r));
            count += 1.0;
        }
    }
    Some(f64::sqrt(sum / count))
}

fn moved(at: &HandEye, step: &DVector<f64>) -> HandEye {
    HandEye {
        mount_from_camera: at.mount_from_camera.retract(&step.fixed_rows::<6>(0).into_owned()),
        anchor_from_target: at.anchor_from_target.retract(&step.fixed_rows::<6>(6).into_owned()),
    }
}

fn row(problem: &Problem, fit: &JointFit, i: usize) -> Row {
    let view = &problem.views[i];
    let (_, j) = residual_with_jacobian(&fit.hand_eye, &view.with(&fit.extras, &fit.values));
    let by_x: Matrix6<f64> = j.fixed_view::<6, 6>(0, 0).into_owned();
    let carried = by_x * lie::adjoint(fit.hand_eye.mount_from_camera.inverse().iso());
    let mut by_extras = DMatrix::zeros(6, problem.extras.len());
    for (k, extra) in problem.extras.iter().enumerate() {
        if let Some(which) = extra.kind.of_robot() {
            by_extras.set_column(k, &(carried * view.by_robot(which)));
        }
    }
    Row { j, by_extras }
}
