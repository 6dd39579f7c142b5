//! The equations of one view.

use nalgebra::{Matrix6, Vector6};

use super::super::{
    Problem,
    extra::{self, Extra, ExtraKind},
    noise::{self},
    touch_residual,
};
use crate::{
    HandEye, Setup,
    estimate::{
        noise::Variances,
        system::state::{State, System, ViewNoise},
    },
    math::lie,
    solve::least_squares::{self, View},
};

impl System {
    /// Writes the equations of one view.
    pub(super) fn fill(
        &mut self,
        row: usize,
        view: &View,
        problem: &Problem,
        state: &State,
        seen: &SeenMount,
        variances: &Variances,
    ) -> ViewNoise {
        let pair = view.with(&problem.extras, &state.values);
        let (r, j) = least_squares::residual_with_jacobian(&seen.hand_eye, &pair);
        let mut factor = noise::factor(view, &pair, &seen.hand_eye, problem.setup);
        let columns = noise::columns(view);
        let covariance = noise::covariance(&factor, &columns, variances);
        let root = covariance.cholesky().map_or_else(Matrix6::identity, |c| c.l());
        self.residual.fixed_rows_mut::<6>(row).copy_from(&r);
        self.jacobian.fixed_view_mut::<6, 12>(row, 0).copy_from(&j);
        if !problem.extras.is_empty() {
            let by_x: Matrix6<f64> = j.fixed_view::<6, 6>(0, 0).into_owned();
            let by_c = -lie::left_jacobian_inverse(&r);
            // a step of the robot on the right of A is one of X, carried over
            let camera_from_mount = lie::adjoint(seen.hand_eye.mount_from_camera.inverse().iso());
            for (k, extra) in problem.extras.iter().enumerate() {
                let column = match (extra.kind, &seen.carry) {
                    (ExtraKind::Camera(which), _) => by_c * view.by_camera(which),
                    // to first order: the derivative of exp(carry δ) differs by the square of δ
                    (ExtraKind::Systematic(axis), Some(carry)) => by_x * carry.column(axis),
                    (kind, _) => match kind.of_robot() {
                        Some(which) => by_x * (camera_from_mount * view.by_robot(which)),
                        None => continue,
                    },
                };
                self.jacobian.fixed_view_mut::<6, 1>(row, 12 + k).copy_from(&column);
            }
        }
        let rows = self.jacobian.nrows();
        divide(&root, &mut self.residual.as_mut_slice()[row..row + 6]);
        for column in self.jacobian.as_mut_slice().chunks_exact_mut(rows) {
            divide(&root, &mut column[row..row + 6]);
        }
        factor.as_mut_slice().chunks_exact_mut(6).for_each(|column| divide(&root, column));
        ViewNoise { factor, columns, root }
    }
}

fn systematic_in_camera(problem: &Problem, state: &State) -> Option<Matrix6<f64>> {
    let systematic = |e: &Extra| matches!(e.kind, ExtraKind::Systematic(_));
    if problem.setup == Setup::EyeInHand || !problem.extras.iter().any(systematic) {
        return None;
    }
    let (mut sum, mut count) = (nalgebra::Vector3::zeros(), 0.0);
    for board in &problem.boards {
        let Some(seen) = &board.seen else { continue };
        let c = seen.with(&problem.extras, &state.values).camera_from_target;
        for corner in &board.corners {
            sum += c.iso().transform_vector(&corner.in_target) + c.translation();
            count += 1.0;
        }
    }
    Some(touch_residual::systematic_carry(&(sum / f64::max(count, 1.0))))
}

/// `X` as the views see it: with the systematic difference, where the mount is the base.
pub(super) struct SeenMount {
    pub hand_eye: HandEye,
    /// How the systematic difference moves `X`.
    pub carry: Option<Matrix6<f64>>,
}

impl SeenMount {
    pub fn of(problem: &Problem, state: &State) -> Self {
        let Some(carry) = systematic_in_camera(problem, state) else {
            return Self { hand_eye: state.hand_eye, carry: None };
        };
        let at = |k| extra::value(&problem.extras, &state.values, ExtraKind::Systematic(k));
        let delta = carry * Vector6::from_fn(|k, _| at(k));
        let mount_from_camera = state.hand_eye.mount_from_camera.retract(&delta);
        Self { hand_eye: HandEye { mount_from_camera, ..state.hand_eye }, carry: Some(carry) }
    }
}

/// `L⁻¹ x` in place.
pub(super) fn divide(root: &Matrix6<f64>, x: &mut [f64]) {
    for i in 0..6 {
        let known: f64 = (0..i).map(|k| root[(i, k)] * x[k]).sum();
        x[i] = (x[i] - known) / root[(i, i)];
    }
}
