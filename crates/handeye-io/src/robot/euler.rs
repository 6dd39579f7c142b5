//! Three turns about coordinate axes.
//!
//! Intrinsic `ijk` with angles (a, b, c) turns about the moving axes, `R = R_i(a) R_j(b) R_k(c)`;
//! extrinsic `ijk` about the fixed ones, `R = R_k(c) R_j(b) R_i(a)`. The way back, for all twelve
//! orders at once: E. Bernardes and S. Viollet, "Quaternion to Euler angles conversion: a direct,
//! general and computationally efficient method", PLoS ONE 17(11), 2022.

use nalgebra::{Unit, UnitQuaternion, Vector3};
use std::f64::consts::{FRAC_PI_2, PI};

/// Axes in order: 0 is x, 1 is y, 2 is z.
pub type Axes = [usize; 3];

/// Whether later turns are about the moved or the first axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// About the moving frame's axes.
    Intrinsic,
    /// About the fixed frame's axes.
    Extrinsic,
}

/// Sine and cosine this close to a gimbal lock leave only the sum of two angles.
const LOCKED: f64 = 1e-12;

/// The rotation of three angles (rad).
pub(super) fn rotation(axes: Axes, sense: Sense, angles: [f64; 3]) -> UnitQuaternion<f64> {
    let turn = |n: usize| {
        let axis = Unit::new_unchecked(Vector3::ith(axes[n], 1.0));
        UnitQuaternion::from_axis_angle(&axis, angles[n])
    };
    match sense {
        Sense::Intrinsic => turn(0) * turn(1) * turn(2),
        Sense::Extrinsic => turn(2) * turn(1) * turn(0),
    }
}

/// The three angles (rad) of a rotation; where two of them are one, the first takes it all.
pub(super) fn angles(axes: Axes, sense: Sense, rotation: &UnitQuaternion<f64>) -> [f64; 3] {
    match sense {
        Sense::Extrinsic => extrinsic(axes, rotation),
        Sense::Intrinsic => {
            let [k, j, i] = axes;
            let [c, b, a] = extrinsic([i, j, k], rotation);
            [a, b, c]
        }
    }
}

/// Bernardes and Viollet, algorithm 1.
fn extrinsic([i, j, last]: Axes, rotation: &UnitQuaternion<f64>) -> [f64; 3] {
    let symmetric = i == last;
    let k = if symmetric { 3 - i - j } else { last };
    let sign = if (j + 3 - i) % 3 == 1 { 1.0 } else { -1.0 };
    let (w, q) = (rotation.w, rotation.imag());
    let (a, b, c, d) = if symmetric {
        (w, q[i], q[j], sign * q[k])
    } else {
        (w - q[j], q[i] + sign * q[k], q[j] + w, sign * q[k] - q[i])
    };
    let middle = 2.0 * c.hypot(d).atan2(a.hypot(b));
    let (sum, difference) = (b.atan2(a), d.atan2(c));
    let (first, third) = if middle.abs() < LOCKED {
        (0.0, 2.0 * sum)
    } else if (middle - PI).abs() < LOCKED {
        (0.0, 2.0 * difference)
    } else {
        (sum - difference, sum + difference)
    };
    if symmetric {
        [wrapped(first), middle, wrapped(third)]
    } else {
        [wrapped(first), middle - FRAC_PI_2, wrapped(sign * third)]
    }
}

/// The same angle in -π to π.
fn wrapped(angle: f64) -> f64 {
    if angle > PI {
        angle - 2.0 * PI
    } else if angle < -PI {
        angle + 2.0 * PI
    } else {
        angle
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intrinsic_turns_are_about_the_moved_axes() {
        // after a quarter turn about z, the moved x is y: a quarter turn about it takes z to x
        let r = rotation([2, 1, 0], Sense::Intrinsic, [FRAC_PI_2, 0.0, FRAC_PI_2]);
        assert!((r * Vector3::z() - Vector3::x()).norm() < 1e-15);
    }

    #[test]
    fn small_angles_come_back_as_they_were() {
        for sense in [Sense::Intrinsic, Sense::Extrinsic] {
            for axes in [[0, 1, 2], [2, 1, 0], [2, 1, 2], [0, 2, 0], [1, 2, 0]] {
                let given = [0.3, 0.4, -0.5];
                let back = angles(axes, sense, &rotation(axes, sense, given));
                for n in 0..3 {
                    assert!((given[n] - back[n]).abs() < 1e-14, "{axes:?} {sense:?} {back:?}");
                }
            }
        }
    }
}
