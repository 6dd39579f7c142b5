//! Residual of touches: the tip against the corner, in the base.
//!
//! ```text
//! e_k = b_k + F_k Δτ - q_k       q_k = X C P_k  (eye-to-hand)      q_k = Y P_k  (eye-in-hand)
//! ∂q/∂X = R_X [-[C P]ₓ, I]       ∂q/∂Y = R_Y [-[P]ₓ, I]            ∂q/∂C = R_X R_C [-[P]ₓ, I]
//! ```
//!
//! with `b_k` where the tip was, `Δτ` what the robot does not know of it, and `C` where the camera
//! saw the board. All touches of one board share the error of `C`: their covariance is
//!
//! ```text
//! V = θ_touch I + θ_position I + θ_rotation diag([l_k]ₓ[l_k]ₓᵀ) + θ_picture G S_C Gᵀ
//! ```
//!
//! with `l_k` the lever from the flange to the tip.

use std::sync::Arc;

use nalgebra::{
    DMatrix, DVector, Isometry3, Matrix3, Matrix3x6, Matrix3xX, Matrix6, SMatrix, SVector, Vector3,
    Vector6,
};

use super::{
    extra::{Extra, ExtraKind, SYSTEMATIC},
    noise::{self, LEAST_POSITION, Source},
};
use crate::{
    Base, Flange, HandEye, Pose, Setup,
    detect::sight::{PRINT, SHAPES, TARGET_SCALE},
    math::lie,
    model::residual::Residual,
    solve::View,
};

/// A touched corner.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchedCorner {
    /// Where the tip was, in the base, as far as the robot knows its tip (m).
    pub in_base: Vector3<f64>,
    /// Where the flange was, if it was recorded.
    pub base_from_flange: Option<Pose<Base, Flange>>,
    /// How the flange moved with the arm's deviations: 6 rows, rotation first, perturbed on the
    /// right; it carries the tip along.
    pub by_robot: Option<Arc<DMatrix<f64>>>,
    /// The corner, about the point at which views state their residual (m).
    pub in_target: Vector3<f64>,
    /// How it moves with the deviations of the target's shape.
    pub by_shape: SMatrix<f64, 3, SHAPES>,
}

impl TouchedCorner {
    /// Where it is on a target of another size and shape.
    fn deviating(&self, extras: &[Extra], values: &DVector<f64>) -> Vector3<f64> {
        let value = |kind| super::extra::value(extras, values, kind);
        let shape = SVector::from_fn(|k, _| value(ExtraKind::Camera(PRINT + k)));
        self.in_target * (1.0 + value(SIZE)) + self.by_shape * shape
    }

    /// Rotation of the flange and place of the tip (in the base) where the arm deviates, and how
    /// that place moves with each deviation.
    fn by_robot_at(
        &self,
        tip_error: &Vector3<f64>,
        extras: &[Extra],
        values: &DVector<f64>,
    ) -> (Matrix3<f64>, Vector3<f64>, Option<Matrix3xX<f64>>) {
        let Some(flange) = self.base_from_flange else {
            return (Matrix3::identity(), self.in_base, None);
        };
        let Some(by_robot) = &self.by_robot else { return (flange.rotation(), self.in_base, None) };
        let mut step = Vector6::zeros();
        for (extra, value) in extras.iter().zip(values) {
            if let Some(which) = extra.kind.of_robot()
                && which < by_robot.ncols()
            {
                step += by_robot.column(which) * *value;
            }
        }
        let tip = flange.rotation().transpose() * (self.in_base - flange.translation());
        let moved = flange.retract(&step);
        let rotation = moved.rotation();
        let place = rotation * tip + moved.translation();
        (rotation, place, Some(carried(&rotation, &(tip + tip_error)) * &**by_robot))
    }
}

/// A board that was touched.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchedBoard {
    /// Where the camera saw it lie (eye-to-hand); `None` where the board is the views' own
    /// (eye-in-hand). The robot's pose in it has no meaning.
    pub seen: Option<View>,
    /// What was touched.
    pub corners: Vec<TouchedCorner>,
}

/// The target's size, which moves the corners on it.
const SIZE: ExtraKind = ExtraKind::Camera(TARGET_SCALE);

/// Equations of one board: residual, Jacobian by everything, covariance and its shapes.
pub(super) struct TouchRows {
    pub residual: DVector<f64>,
    pub jacobian: DMatrix<f64>,
    pub covariance: DMatrix<f64>,
    /// `∂V/∂θ` of every source that acts.
    pub shapes: Vec<(Source, DMatrix<f64>)>,
}

/// `R [-[p]ₓ, I]`: how a point moves with the pose that carries it.
fn carried(r: &Matrix3<f64>, p: &Vector3<f64>) -> Matrix3x6<f64> {
    let mut j = Matrix3x6::zeros();
    j.fixed_view_mut::<3, 3>(0, 0).copy_from(&(-r * lie::hat(p)));
    j.fixed_view_mut::<3, 3>(0, 3).copy_from(r);
    j
}

/// What carries the corners of a board to the base.
struct Carrier {
    base_from_board: Isometry3<f64>,
    /// `camera_from_board`, where the camera stands between.
    camera_from_board: Option<Isometry3<f64>>,
    /// The middle of the touched corners, in the frame that `SYSTEMATIC` perturbs.
    middle: Vector3<f64>,
}

fn carrier(
    board: &TouchedBoard,
    at: &HandEye,
    extras: &[Extra],
    values: &DVector<f64>,
    setup: Setup,
) -> Carrier {
    let n = board.corners.len().max(1) as f64;
    let on_board = board.corners.iter().map(|c| c.in_target).sum::<Vector3<f64>>() / n;
    match (setup, &board.seen) {
        (Setup::EyeToHand, Some(seen)) => {
            let c = *seen.with(extras, values).camera_from_target.iso();
            let middle = c.transform_vector(&on_board) + c.translation.vector;
            Carrier {
                base_from_board: at.mount_from_camera.iso() * c,
                camera_from_board: Some(c),
                middle,
            }
        }
        _ => Carrier {
            base_from_board: *at.anchor_from_target.iso(),
            camera_from_board: None,
            middle: on_board,
        },
    }
}

/// Columns of a unit systematic difference, for a perturbation on the right of a frame in which
/// the touched places lie about `middle`.
pub(super) fn systematic_carry(middle: &Vector3<f64>) -> Matrix6<f64> {
    let shift = Isometry3::translation(middle.x, middle.y, middle.z);
    let Residual { angle: turn, distance: step } = SYSTEMATIC;
    let size = nalgebra::Vector6::new(turn, turn, turn, step, step, step);
    lie::adjoint(&shift) * Matrix6::from_diagonal(&size)
}

/// The equations of one board.
pub(super) fn rows(
    board: &TouchedBoard,
    at: &HandEye,
    extras: &[Extra],
    values: &DVector<f64>,
    variances: &[f64; Source::ALL.len()],
    setup: Setup,
) -> TouchRows {
    let n = 3 * board.corners.len();
    let carrier = carrier(board, at, extras, values, setup);
    let mut residual = DVector::zeros(n);
    let mut jacobian = DMatrix::zeros(n, 12 + extras.len());
    for (k, corner) in board.corners.iter().enumerate() {
        fill(corner, 3 * k, &carrier, board, at, (extras, values), &mut residual, &mut jacobian);
    }
    let shapes = shapes(board, &carrier);
    let mut covariance = DMatrix::identity(n, n) * LEAST_POSITION.powi(2);
    for (source, shape) in &shapes {
        covariance += shape * variances[source.index()];
    }
    TouchRows { residual, jacobian, covariance, shapes }
}

#[allow(clippy::too_many_arguments, reason = "one equation with its row in two matrices")]
fn fill(
    corner: &TouchedCorner,
    row: usize,
    carrier: &Carrier,
    board: &TouchedBoard,
    at: &HandEye,
    (extras, values): (&[Extra], &DVector<f64>),
    residual: &mut DVector<f64>,
    jacobian: &mut DMatrix<f64>,
) {
    let tip = Vector3::from_fn(|k, _| super::extra::value(extras, values, ExtraKind::Tip(k)));
    let (flange, touched, by_robot) = corner.by_robot_at(&tip, extras, values);
    let r = carrier.base_from_board.rotation.to_rotation_matrix().into_inner();
    let in_target = corner.deviating(extras, values);
    let in_base = r * in_target + carrier.base_from_board.translation.vector;
    let mut e = touched + flange * tip - in_base;
    let by_board = carried(&r, &in_target);
    let (first, by_pose, frame) = match carrier.camera_from_board {
        Some(c) => {
            let in_camera = c.transform_vector(&in_target) + c.translation.vector;
            (0, carried(&at.mount_from_camera.rotation(), &in_camera), None)
        }
        // the touched side carries the systematic difference where both share the target
        None => (6, by_board, Some(by_board * systematic_carry(&carrier.middle))),
    };
    jacobian.view_mut((row, first), (3, 6)).copy_from(&-by_pose);
    for (k, extra) in extras.iter().enumerate() {
        let column: Vector3<f64> = match extra.kind {
            ExtraKind::Tip(axis) => flange.column(axis).into(),
            ExtraKind::Arm(which) | ExtraKind::PlaceTurn(which) | ExtraKind::PlaceShift(which) => {
                by_robot.as_ref().map_or_else(Vector3::zeros, |m| m.column(which).into())
            }
            ExtraKind::Systematic(axis) => match &frame {
                Some(by_systematic) => {
                    e -= by_systematic.column(axis) * values[k];
                    -by_systematic.column(axis)
                }
                None => Vector3::zeros(),
            },
            ExtraKind::Camera(which) => {
                let by_view = match (&board.seen, carrier.camera_from_board) {
                    (Some(seen), Some(_)) => -by_board * seen.by_camera(which),
                    _ => Vector3::zeros(),
                };
                // the corner itself lies farther out on a larger board
                match which {
                    TARGET_SCALE => by_view - r * corner.in_target,
                    n if n >= PRINT => by_view - r * corner.by_shape.column(n - PRINT),
                    _ => by_view,
                }
            }
        };
        jacobian.view_mut((row, 12 + k), (3, 1)).copy_from(&column);
    }
    residual.rows_mut(row, 3).copy_from(&e);
}

fn shapes(board: &TouchedBoard, carrier: &Carrier) -> Vec<(Source, DMatrix<f64>)> {
    let n = 3 * board.corners.len();
    let mut rotation = DMatrix::zeros(n, n);
    let mut by_pose = DMatrix::zeros(n, 6);
    let r = carrier.base_from_board.rotation.to_rotation_matrix().into_inner();
    for (k, corner) in board.corners.iter().enumerate() {
        if let Some(flange) = &corner.base_from_flange {
            let lever = lie::hat(&(corner.in_base - flange.translation()));
            rotation.view_mut((3 * k, 3 * k), (3, 3)).copy_from(&(lever * lever.transpose()));
        }
        by_pose.view_mut((3 * k, 0), (3, 6)).copy_from(&carried(&r, &corner.in_target));
    }
    let mut all = vec![
        (Source::Touch, DMatrix::identity(n, n)),
        (Source::RobotPosition, DMatrix::identity(n, n)),
        (Source::RobotRotation, rotation),
    ];
    if let Some(seen) = &board.seen {
        let columns = noise::columns(seen);
        let b = by_pose * noise::camera_factor(seen);
        for source in Source::ALL {
            let own: Vec<usize> = (0..6).filter(|&k| columns[k + 6] == source).collect();
            if !own.is_empty() {
                let part = b.select_columns(&own);
                all.push((source, &part * part.transpose()));
            }
        }
    }
    all
}
