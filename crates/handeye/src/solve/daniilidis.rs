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
//! unit dual quaternion, `qᵀq = 1` and `qᵀq' = 0`, pick it out by a quadratic equation. The rows of
//! all motions enter through moments: dual quaternions of motions are bilinear in those of the
//! captures too, `a' = a_j'* a_i + a_j* a_i'`.
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone; then there are more
//! null vectors than two. Noise can leave the quadratic equation without a real root; the nearest
//! real one, of discriminant zero, is taken.
//!
//! K. Daniilidis, *Hand-eye calibration using dual quaternions*, IJRR 18(3), 1999.

use nalgebra::{Isometry3, Matrix3, Matrix4, SMatrix, SVector, Vector3, Vector4};

use super::{
    moments,
    moments::{Seen, product},
    shared::{open, place},
};
use crate::{Error, HandEye, PosePair, math::jacobi};

/// Sixth over largest eigenvalue of the rows' moments below which a third null vector is there.
const NO_ROW: f64 = 1e-14;
/// Length below which the real part of an eight-vector of unit length holds no rotation.
const NO_ROTATION: f64 = 1e-9;

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = moments::seen(pairs)?;
    let (values, vectors) = jacobi::eigen(&Products::new(&all).rows());
    if !(values[5] > NO_ROW * values[0]) {
        return Err(open("the motions leave more than the two null vectors of this method"));
    }
    let (v7, v8) = (vectors.column(6).into_owned(), vectors.column(7).into_owned());
    let x = combine(&v7, &v8).ok_or_else(|| {
        open(
            "the dual quaternion equations have no real solution; the motions are too alike or \
             too noisy for this method",
        )
    })?;
    Ok(place(pairs, x))
}

/// Sums over all motions of the products of `d = a - b`, `s = a + b`, and their dual parts.
pub(super) struct Products {
    real: Block,
    dual: Block,
    /// Dual part on the left, real part on the right.
    mixed: Block,
}

/// `Σ p q ᵀ` of the vectors of two blocks `[d_p  [s_p]ₓ]` and `[d_q  [s_q]ₓ]`.
struct Block {
    dd: Matrix3<f64>,
    ds: Matrix3<f64>,
    sd: Matrix3<f64>,
    ss: Matrix3<f64>,
}

impl Block {
    /// From `Σ a_p a_qᵀ`, `Σ a_p b_qᵀ`, `Σ b_p a_qᵀ` and `Σ b_p b_qᵀ`.
    fn new(aa: Matrix3<f64>, ab: Matrix3<f64>, ba: Matrix3<f64>, bb: Matrix3<f64>) -> Self {
        Self {
            dd: aa - ab - ba + bb,
            ds: aa + ab - ba - bb,
            sd: aa - ab + ba - bb,
            ss: aa + ab + ba + bb,
        }
    }

    /// `Σ [d_p [s_p]ₓ]ᵀ [d_q [s_q]ₓ]`.
    fn gram(&self) -> Matrix4<f64> {
        let mut gram = Matrix4::zeros();
        gram[(0, 0)] = self.dd.trace();
        gram.fixed_view_mut::<1, 3>(0, 1).copy_from(&cross(&self.ds).transpose());
        gram.fixed_view_mut::<3, 1>(1, 0).copy_from(&-cross(&self.sd));
        let low = Matrix3::identity() * self.ss.trace() - self.ss.transpose();
        gram.fixed_view_mut::<3, 3>(1, 1).copy_from(&low);
        gram
    }
}

/// `Σ p × q` from `Σ p qᵀ`.
fn cross(m: &Matrix3<f64>) -> Vector3<f64> {
    Vector3::new(m[(1, 2)] - m[(2, 1)], m[(2, 0)] - m[(0, 2)], m[(0, 1)] - m[(1, 0)])
}

impl Products {
    pub fn new(all: &[Seen]) -> Self {
        // Σ z zᵀ of z = (a, a', b, b')
        let mut z = [[Matrix4::<f64>::zeros(); 4]; 4];
        for s in all {
            let dual = |t: &Vector3<f64>, q| product(&Vector4::new(0.0, t.x, t.y, t.z), q) * 0.5;
            let parts = [s.a, dual(&s.t_a, &s.a), s.b, dual(&s.t_b, &s.b)];
            for p in 0..4 {
                for q in p..4 {
                    z[p][q] += parts[p] * parts[q].transpose();
                }
            }
        }
        let one = moments::over_motions;
        let two = moments::over_motions_of_two;
        let [aa, aa_, ab, ab_] = z[0];
        let [_, a_a_, a_b, a_b_] = z[1];
        let [_, _, bb, bb_] = z[2];
        let b_b_ = z[3][3];
        let (real_ab, dual_ab) = (one(&ab), two(&ab, &a_b_) + two(&ab_, &a_b));
        Self {
            real: Block::new(one(&aa), real_ab, real_ab.transpose(), one(&bb)),
            dual: Block::new(
                two(&aa, &a_a_) + two(&aa_, &aa_.transpose()),
                dual_ab,
                dual_ab.transpose(),
                two(&bb, &b_b_) + two(&bb_, &bb_.transpose()),
            ),
            mixed: Block::new(
                two(&aa, &aa_.transpose()),
                two(&ab, &a_b),
                two(&ab.transpose(), &ab_.transpose()),
                two(&bb, &bb_.transpose()),
            ),
        }
    }

    /// `Σ SᵀS` of the six rows of each motion.
    fn rows(&self) -> SMatrix<f64, 8, 8> {
        assemble(&self.real.gram(), &self.dual.gram(), &self.mixed.gram())
    }

    /// `Σ SᵀS` of eight rows of each motion, the scalar equations `(a - b)·q = 0` included.
    pub(crate) fn all_rows(&self) -> SMatrix<f64, 8, 8> {
        let with_scalar = |block: &Block| {
            let mut gram = block.gram();
            let mut view = gram.fixed_view_mut::<3, 3>(1, 1);
            view += block.dd;
            gram
        };
        assemble(&with_scalar(&self.real), &with_scalar(&self.dual), &with_scalar(&self.mixed))
    }
}

fn assemble(real: &Matrix4<f64>, dual: &Matrix4<f64>, mixed: &Matrix4<f64>) -> SMatrix<f64, 8, 8> {
    let mut m = SMatrix::<f64, 8, 8>::zeros();
    m.fixed_view_mut::<4, 4>(0, 0).copy_from(&(real + dual));
    m.fixed_view_mut::<4, 4>(0, 4).copy_from(mixed);
    m.fixed_view_mut::<4, 4>(4, 0).copy_from(&mixed.transpose());
    m.fixed_view_mut::<4, 4>(4, 4).copy_from(real);
    m
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
    (q.norm() > NO_ROTATION).then(|| from_dual(&q, &q_))
}

/// The transform of a dual quaternion `q + ε q'` of any length.
pub(super) fn from_dual(q: &Vector4<f64>, q_: &Vector4<f64>) -> Isometry3<f64> {
    let conjugate = Vector4::new(q[0], -q[1], -q[2], -q[3]);
    let t = moments::vector(&product(q_, &conjugate)) * (2.0 / q.norm_squared());
    Isometry3::from_parts(t.into(), jacobi::rotation_of(q))
}
