//! The filter over residuals and Jacobian, and the pass back.

use nalgebra::{DMatrix, DVector, Matrix6, SMatrix, SVector, Vector6};

use super::super::{
    extra::ExtraKind,
    noise::{self, COLUMNS, Factor, Source},
};
use crate::{
    HandEye,
    detect::sight::Sight,
    estimate::drift::sequence::{Drift, EXTRAS, Levels, Sequence, Side, Slow},
    math::{
        lie,
        linalg::{self, FREE_SIGMA},
    },
    solve::least_squares,
};

/// Largest number of columns of the Jacobian.
pub(super) const WIDTH: usize = 12 + EXTRAS;
/// Residual and Jacobian side by side.
pub(super) const BOTH: usize = 1 + WIDTH;
/// Drift of the pose and of the unit.
pub(super) const STATE: usize = 7;

pub(super) type Rows = SMatrix<f64, 6, BOTH>;
pub(super) type Square = SMatrix<f64, STATE, STATE>;
type Gain = SMatrix<f64, STATE, 6>;
pub(super) type See = SMatrix<f64, 6, STATE>;

/// One view, about where the fit stands.
pub(super) struct Line {
    pub rows: Rows,
    pub factor: Factor,
    pub columns: [Source; COLUMNS],
    /// How a step in the axes of the camera moves the slow part of the residual.
    pub carry: Matrix6<f64>,
    /// Takes the axes of these equations to those of the target.
    pub to_target: Matrix6<f64>,
    pub see: See,
    pub after: f64,
    pub used: bool,
}

pub(super) fn lines(
    sequence: &Sequence,
    used: &[bool],
    hand_eye: &HandEye,
    values: &DVector<f64>,
) -> Vec<Line> {
    let one = |k: usize| {
        let view = &sequence.views[k];
        let pair = view.with(&sequence.extras, values);
        let (r, j) = least_squares::residual_with_jacobian(hand_eye, &pair);
        let by_c = -lie::left_jacobian_inverse(&r);
        let mut rows = Rows::zeros();
        rows.column_mut(0).copy_from(&r);
        rows.fixed_view_mut::<6, 12>(0, 1).copy_from(&j);
        for (e, extra) in sequence.extras.iter().enumerate() {
            if let ExtraKind::Camera(which) = extra.kind {
                rows.column_mut(13 + e).copy_from(&(by_c * view.by_camera(which)));
            }
        }
        let mut factor = noise::factor(view, &pair, hand_eye, sequence.setup);
        let mut by_size = Sight::by_size(&pair.camera_from_target);
        let target_from_camera = lie::adjoint(pair.camera_from_target.inverse().iso());
        let (carry, to_target) = match sequence.side {
            Side::Target => (target_from_camera, Matrix6::identity()),
            Side::Camera => {
                let turn = lie::adjoint(pair.camera_from_target.iso());
                (rows, factor, by_size) = (turn * rows, turn * factor, turn * by_size);
                (Matrix6::identity(), target_from_camera)
            }
        };
        let mut see = See::zeros();
        see.fixed_view_mut::<6, 6>(0, 0).fill_with_identity();
        see.column_mut(6).copy_from(&by_size);
        Line {
            rows,
            factor,
            columns: noise::columns(view),
            carry,
            to_target,
            see,
            after: if k == 0 { 0.0 } else { sequence.after[k] },
            used: used[k],
        }
    };
    (0..sequence.views.len()).map(one).collect()
}

/// What the filter leaves: residual and Jacobian whitened, squared and summed.
pub(super) struct Filtered {
    pub sum: SMatrix<f64, BOTH, BOTH>,
    log_determinant: f64,
}

/// Before one view: drift of residual and Jacobian, and its covariance.
struct Before {
    state: SMatrix<f64, STATE, BOTH>,
    spread: Square,
}

/// Stationary covariance of the drift in the axes of this view, per unit of `1 - φ²`.
pub(super) fn spread(line: &Line, drift: &Drift) -> Square {
    let turn = drift.rotation.powi(2);
    let shift = drift.position.powi(2);
    let own = Vector6::new(turn, turn, turn, shift, shift, shift);
    let mut all = Square::zeros();
    let carried = line.carry * Matrix6::from_diagonal(&own) * line.carry.transpose();
    all.fixed_view_mut::<6, 6>(0, 0).copy_from(&carried);
    all[(6, 6)] = drift.scale.powi(2);
    all * (0.5 * drift.memory)
}

fn before(line: &Line, drift: &Drift, last: Option<Before>) -> Before {
    let own = spread(line, drift);
    match last {
        None => Before { state: SMatrix::zeros(), spread: own },
        Some(last) => {
            let phi = (-line.after / drift.memory).exp();
            // 1 - φ² without loss of digits
            let fresh = -(-2.0 * line.after / drift.memory).exp_m1();
            Before { state: last.state * phi, spread: last.spread * (phi * phi) + own * fresh }
        }
    }
}

/// Covariance of a view's residual under what came before, as root and inverse.
fn innovation(line: &Line, before: &Before, levels: &Levels) -> (Matrix6<f64>, Matrix6<f64>) {
    let own = noise::covariance(&line.factor, &line.columns, &levels.noise.variances());
    let all = own + line.see * before.spread * line.see.transpose();
    let root = all.cholesky();
    let inverse = root.as_ref().map_or_else(Matrix6::identity, |c| c.inverse());
    (root.map_or_else(Matrix6::identity, |c| c.l()), inverse)
}

pub(super) fn filter(lines: &[Line], levels: &Levels) -> Filtered {
    let mut out = Filtered { sum: SMatrix::zeros(), log_determinant: 0.0 };
    let mut last = None;
    for line in lines {
        let mut here = before(line, &levels.drift, last);
        if line.used {
            let (root, inverse) = innovation(line, &here, levels);
            let new = line.rows - line.see * here.state;
            let white = root.solve_lower_triangular(&new).unwrap_or(new);
            out.sum += white.tr_mul(&white);
            out.log_determinant += 2.0 * root.diagonal().iter().map(|d| d.ln()).sum::<f64>();
            let gain: Gain = here.spread * line.see.transpose() * inverse;
            here.state += gain * new;
            here.spread -= gain * line.see * here.spread;
            here.spread = 0.5 * (here.spread + here.spread.transpose());
        }
        last = Some(here);
    }
    out
}

impl Filtered {
    /// Information and gradient of `(X, Y, extras)`.
    pub fn normal(
        &self,
        sequence: &Sequence,
        values: &DVector<f64>,
    ) -> (DMatrix<f64>, DVector<f64>) {
        let p = 12 + sequence.extras.len();
        let mut h = DMatrix::from_fn(p, p, |i, j| self.sum[(1 + i, 1 + j)]);
        let mut g = DVector::from_fn(p, |i, _| self.sum[(1 + i, 0)]);
        (0..12).for_each(|k| h[(k, k)] += FREE_SIGMA.powi(-2));
        for (k, extra) in sequence.extras.iter().enumerate() {
            h[(12 + k, 12 + k)] += extra.prior_sigma.powi(-2);
            g[12 + k] += (values[k] - extra.prior_mean) / extra.prior_sigma.powi(2);
        }
        (h, g)
    }

    /// The step of Gauss and Newton, and its squared length in units of the information.
    pub fn step(&self, sequence: &Sequence, values: &DVector<f64>) -> Option<(DVector<f64>, f64)> {
        let (h, g) = self.normal(sequence, values);
        let step = -(covariance(&h)? * &g);
        let size = -step.dot(&g);
        step.iter().all(|s| s.is_finite()).then_some((step, size))
    }

    pub(crate) fn log_likelihood(&self, sequence: &Sequence, values: &DVector<f64>) -> f64 {
        let (h, g) = self.normal(sequence, values);
        let Some((scaled, scale)) = linalg::scaled(&h) else { return f64::NEG_INFINITY };
        let Some(root) = nalgebra::Cholesky::new(scaled) else { return f64::NEG_INFINITY };
        let log = |d: &f64| d.ln();
        let log_h: f64 = 2.0 * root.l_dirty().diagonal().iter().map(log).sum::<f64>()
            - 2.0 * scale.iter().map(log).sum::<f64>();
        let scaled_g = g.component_mul(&scale);
        let least = self.sum[(0, 0)] - scaled_g.dot(&root.solve(&scaled_g));
        -0.5 * (self.log_determinant + log_h + least)
    }
}

pub(super) fn covariance(h: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    linalg::inverse_with_free(h)
}

/// One view on the way forward, for the way back.
struct Pass {
    state: SVector<f64, STATE>,
    spread: Square,
    inverse: Matrix6<f64>,
    /// Residual minus what was expected.
    new: Vector6<f64>,
}

/// What is known of every view by those before it.
fn forward(lines: &[Line], levels: &Levels) -> Vec<Pass> {
    let mut passes: Vec<Pass> = vec![];
    let mut last = None;
    for line in lines {
        let mut here = before(line, &levels.drift, last);
        let (_, inverse) = innovation(line, &here, levels);
        let new = line.rows - line.see * here.state;
        passes.push(Pass {
            state: here.state.column(0).into_owned(),
            spread: here.spread,
            inverse,
            new: new.column(0).into_owned(),
        });
        if line.used {
            let gain: Gain = here.spread * line.see.transpose() * inverse;
            here.state += gain * new;
            here.spread -= gain * line.see * here.spread;
            here.spread = 0.5 * (here.spread + here.spread.transpose());
        }
        last = Some(here);
    }
    passes
}

/// Drift of every view given all others, and what it then misses.
pub(super) fn smooth(lines: &[Line], levels: &Levels) -> Vec<Slow> {
    let passes = forward(lines, levels);
    let (mut rho, mut back) = (SVector::<f64, STATE>::zeros(), Square::zeros());
    let mut all = vec![];
    for k in (0..lines.len()).rev() {
        let (line, pass) = (&lines[k], &passes[k]);
        let phi = lines.get(k + 1).map_or(1.0, |l| (-l.after / levels.drift.memory).exp());
        let see = &line.see;
        // how the next state moves with this one, and with this residual
        let (next, gain) = if line.used {
            let gain: Gain = pass.spread * see.transpose() * pass.inverse * phi;
            (Square::identity() * phi - gain * see, gain)
        } else {
            (Square::identity() * phi, Gain::zeros())
        };
        let u = pass.inverse * pass.new - gain.transpose() * rho;
        let m = pass.inverse + gain.transpose() * back * gain;
        (rho, back) = if line.used {
            (
                see.transpose() * pass.inverse * pass.new + next.transpose() * rho,
                see.transpose() * pass.inverse * see + next.transpose() * back * next,
            )
        } else {
            (next.transpose() * rho, next.transpose() * back * next)
        };
        let drift = see * (pass.state + pass.spread * rho);
        let (left_out, spread) = if line.used {
            let spread = linalg::invert_spd(&m).unwrap_or_else(Matrix6::zeros);
            (spread * u, spread)
        } else {
            let own = noise::covariance(&line.factor, &line.columns, &levels.noise.variances());
            let smoothed = pass.spread - pass.spread * back * pass.spread;
            let residual: Vector6<f64> = line.rows.column(0).into_owned();
            (residual - drift, own + see * smoothed * see.transpose())
        };
        let weighted = linalg::invert_spd(&spread).map_or_else(Vector6::zeros, |w| w * left_out);
        let squared_mahalanobis = left_out.dot(&weighted);
        let (drift, left_out) = (line.to_target * drift, line.to_target * left_out);
        all.push(Slow { drift, left_out, squared_mahalanobis });
    }
    all.reverse();
    all
}
