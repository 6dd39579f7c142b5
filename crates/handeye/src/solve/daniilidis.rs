//! Hand-eye calibration by dual quaternions.
//!
//! A motion is a unit dual quaternion `q + ε q'`; `A X = X B` becomes, for the vector parts
//! `a, a'` and `b, b'` of both motions,
//!
//! ```text
//! [ a - b    [a + b]ₓ    0        0      ] [ q  ]
//! [ a'- b'   [a'+ b']ₓ   a - b    [a + b]ₓ ] [ q' ] = 0
//! ```
//!
//! The 8-vector lies in the two-dimensional null space of all these rows; the two conditions of a
//! unit dual quaternion, `qᵀq = 1` and `qᵀq' = 0`, pick it out by a quadratic equation.
//!
//! K. Daniilidis, *Hand-eye calibration using dual quaternions*, IJRR 18(3), 1999.

use nalgebra::{
    DMatrix, Isometry3, Quaternion, SMatrix, SVector, UnitQuaternion, Vector3, Vector4,
};

use super::{motions, place_target};
use crate::{Error, HandEye, Pose, PosePair, linalg};

/// The signs of both quaternions of a motion are chosen by their scalar parts, which noise decides
/// near a half turn: motions above 165 degrees are left out.
const MOST_ANGLE: f64 = 2.88;

/// Scalar part first: `(q, q')` of a motion, with a non-negative scalar part.
fn dual(m: &Isometry3<f64>) -> (Vector4<f64>, Vector4<f64>) {
    let q = m.rotation.quaternion();
    let q = if q.w < 0.0 { -*q } else { *q };
    let t = Quaternion::from_imag(m.translation.vector);
    let scalar_first = |q: Quaternion<f64>| Vector4::new(q.w, q.i, q.j, q.k);
    (scalar_first(q), scalar_first(t * q * 0.5))
}

fn rows(m: &motions::Motion) -> SMatrix<f64, 6, 8> {
    let ((a, a_), (b, b_)) = (dual(&m.a), dual(&m.b));
    let vector = |v: &Vector4<f64>| Vector3::new(v[1], v[2], v[3]);
    let block = |x: Vector3<f64>, y: Vector3<f64>| {
        let mut s = SMatrix::<f64, 3, 4>::zeros();
        s.set_column(0, &(x - y));
        s.fixed_view_mut::<3, 3>(0, 1).copy_from(&(x + y).cross_matrix());
        s
    };
    let (top, low) = (block(vector(&a), vector(&b)), block(vector(&a_), vector(&b_)));
    let mut s = SMatrix::<f64, 6, 8>::zeros();
    s.fixed_view_mut::<3, 4>(0, 0).copy_from(&top);
    s.fixed_view_mut::<3, 4>(3, 0).copy_from(&low);
    s.fixed_view_mut::<3, 4>(3, 4).copy_from(&top);
    s
}

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = motions::motions(pairs);
    let used: Vec<_> = all
        .iter()
        .filter(|m| m.a.rotation.angle() < MOST_ANGLE && m.b.rotation.angle() < MOST_ANGLE)
        .collect();
    let mut stacked = DMatrix::zeros(6 * used.len().max(2), 8);
    for (k, m) in used.iter().enumerate() {
        stacked.fixed_view_mut::<6, 8>(6 * k, 0).copy_from(&rows(m));
    }
    let svd = linalg::svd(&stacked);
    let column =
        |k: usize| SVector::<f64, 8>::from_column_slice(svd.v.column(k).into_owned().as_slice());
    let (v7, v8) = (column(6), column(7));
    let x = combine(&v7, &v8).ok_or(Error::NotDetermined {
        what: "the dual quaternion equations have no real solution; the motions are too alike or \
               too noisy for this method"
            .into(),
    })?;
    Ok(place_target(pairs, &Pose::claim(x)))
}

/// `λ₁ v₇ + λ₂ v₈` with `qᵀq' = 0` and `qᵀq = 1`.
fn combine(v7: &SVector<f64, 8>, v8: &SVector<f64, 8>) -> Option<Isometry3<f64>> {
    let half = |v: &SVector<f64, 8>, k: usize| Vector4::from_fn(|i, _| v[k + i]);
    let (u1, w1, u2, w2) = (half(v7, 0), half(v7, 4), half(v8, 0), half(v8, 4));
    // a λ₁² + b λ₁ λ₂ + c λ₂² = 0, homogeneous: solved for whichever ratio is well conditioned
    let (a, b, c) = (u1.dot(&w1), u1.dot(&w2) + u2.dot(&w1), u2.dot(&w2));
    let root = (b * b - 4.0 * a * c).max(0.0).sqrt();
    let p = -0.5 * (b + root.copysign(if b == 0.0 { 1.0 } else { b }));
    let pairs = [(p, a), (c, p)]; // λ₁ : λ₂
    let (l1, l2) = pairs
        .into_iter()
        .filter(|(x, y)| x.hypot(*y) > 0.0)
        .map(|(x, y)| (x / x.hypot(y), y / x.hypot(y)))
        .max_by(|l, r| {
            let norm = |(x, y): (f64, f64)| (u1 * x + u2 * y).norm_squared();
            norm(*l).total_cmp(&norm(*r))
        })
        .unwrap_or((1.0, 0.0));
    let (q, q_) = (u1 * l1 + u2 * l2, w1 * l1 + w2 * l2);
    let scale = q.norm();
    if !(scale > 1e-9) {
        return None;
    }
    let quaternion = |v: Vector4<f64>| Quaternion::new(v[0], v[1], v[2], v[3]);
    let (q, q_) = (quaternion(q / scale), quaternion(q_ / scale));
    let t = (q_ * q.conjugate()).imag() * 2.0;
    Some(Isometry3::from_parts(t.into(), UnitQuaternion::new_normalize(q)))
}
