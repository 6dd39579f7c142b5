//! Hand-eye calibration by one angle per motion.
//!
//! A motion with axes `k_A = R_X k_B` leaves one angle free, `R_X = Rot(k_A, β) R_P`, where `R_P`
//! is any rotation that takes `k_B` to `k_A`. Two motions must agree on `R_X`,
//!
//! ```text
//! Rot(k_A1, β₁) R_P1 = Rot(k_Ai, β_i) R_Pi
//! ```
//!
//! which is linear in the cosines and sines of the angles. The motions lead from each capture to
//! the next. As in the paper the answer turns about the axis of one motion exactly; it is the one
//! with the largest angle here. All other angles are eliminated one by one.
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone. A motion by a small
//! angle has no axis to speak of and is left out. The noise of the one axis goes into the answer
//! whole, however many captures there are.
//!
//! Y. Shiu and S. Ahmad, *Calibration of wrist-mounted robotic sensors by solving homogeneous
//! transform equations of the form AX = XB*, IEEE T-RA 5(1), 1989.

use nalgebra::{Matrix2, Matrix3, UnitQuaternion, Vector2, Vector3};

use super::{
    moments,
    moments::Translations,
    shared::{open, place},
};
use crate::{Error, HandEye, PosePair};

/// Motions whose half-angle has a sine below this share of the largest have no axis to speak of.
const SHORT: f64 = 0.02;

/// `Rot(k_A, β) R_P = fixed + cos β even + sin β odd`; `even` and `odd` have squared norm two and
/// are orthogonal.
struct Family {
    axis: Vector3<f64>,
    start: UnitQuaternion<f64>,
    fixed: Matrix3<f64>,
    even: Matrix3<f64>,
    odd: Matrix3<f64>,
}

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = moments::seen(pairs)?;
    let mut motions = Translations::zeros();
    let mut axes = Vec::with_capacity(all.len());
    for two in all.windows(2) {
        motions.add(&two[0], &two[1], 1.0);
        let vector = |q, p| moments::vector(&moments::between(q, p));
        axes.push((vector(&two[1].a, &two[0].a), vector(&two[1].b, &two[0].b)));
    }
    let free = || open("the rotations between captures do not fix the camera's rotation");
    let size = |(a, b): &(Vector3<f64>, Vector3<f64>)| a.norm().min(b.norm());
    let largest = axes.iter().map(size).fold(0.0, f64::max);
    let first = axes.iter().position(|m| size(m) == largest).ok_or_else(free)?;
    axes.swap(0, first);
    axes.retain(|m| size(m) > SHORT * largest);
    let families: Vec<Family> = axes.iter().map(|(a, b)| family(a, b)).collect();
    let rotation = agree(&families).ok_or_else(free)?;
    Ok(place(pairs, moments::with_position(rotation, &motions)?))
}

fn family(a: &Vector3<f64>, b: &Vector3<f64>) -> Family {
    let (axis, from) = (a.normalize(), b.normalize());
    let start = UnitQuaternion::rotation_between(&from, &axis).unwrap_or_else(|| {
        let aside = from.cross(&Vector3::ith(from.iamin(), 1.0)).normalize();
        UnitQuaternion::from_scaled_axis(aside * std::f64::consts::PI)
    });
    let r_p = start.to_rotation_matrix().into_inner();
    let fixed = axis * axis.transpose() * r_p;
    Family { axis, start, fixed, even: r_p - fixed, odd: axis.cross_matrix() * r_p }
}

/// The first family's angle on which all others agree best.
fn agree(families: &[Family]) -> Option<UnitQuaternion<f64>> {
    let (first, others) = families.split_first()?;
    let (mut normal, mut rhs) = (Matrix2::zeros(), Vector2::zeros());
    for other in others {
        // off the plane of `even` and `odd`, which the other's own angle takes up
        let off = |m: &Matrix3<f64>| {
            m - other.even * (0.5 * m.dot(&other.even)) - other.odd * (0.5 * m.dot(&other.odd))
        };
        let (even, odd) = (off(&first.even), off(&first.odd));
        let gap = off(&(other.fixed - first.fixed));
        let mixed = even.dot(&odd);
        normal += Matrix2::new(even.norm_squared(), mixed, mixed, odd.norm_squared());
        rhs += Vector2::new(even.dot(&gap), odd.dot(&gap));
    }
    let [cos, sin] = moments::solve_spd(&normal, &rhs)?.into();
    let angle = f64::atan2(sin, cos);
    Some(UnitQuaternion::from_scaled_axis(first.axis * angle) * first.start)
}
