//! The rotation that turns one set of directions into another best.
//!
//! `max tr(Rᵀ H)` over rotations, with `H = Σ w q pᵀ`. Horn's quaternion is the eigenvector of the
//! largest eigenvalue of a symmetric 4 x 4 matrix `K(H)`; Newton's method finds that eigenvalue from
//! above, as a root of the characteristic polynomial (Theobald), and the adjugate of `K - λ` its
//! vector. Squaring has cost half the digits by then where `H` is nearly singular, so Newton steps on
//! the rotation itself follow: with `S = Rᵀ H`, `a = Σ eᵢ × S eᵢ` and `R exp(δ)`,
//!
//! ```text
//! tr(exp(-[δ]ₓ) S) = tr S + a·δ - ½ δᵀ (tr(S) I - S) δ + O(δ³)
//! ```
//!
//! At the answer `S` is symmetric, with the singular values of `H` as eigenvalues, the last one with the
//! sign of `det H`. Where these steps do not settle, the decomposition by rotations of columns answers.
//!
//! B. Horn, J. Opt. Soc. Am. A 4(4), 1987; D. Theobald, *Rapid calculation of RMSDs using a
//! quaternion-based characteristic polynomial*, Acta Cryst. A61, 2005.

use nalgebra::{Matrix3, Matrix4, Quaternion, UnitQuaternion, Vector3, Vector4};

use crate::math::jacobi;

/// Most steps to the largest eigenvalue: a simple root takes six.
const MOST_ROOT_STEPS: usize = 30;
/// The largest eigenvalue is known to this share of itself before the rotation is improved.
const ROOT_ACCURACY: f64 = 1e-9;
/// Most steps of the rotation: two are usual.
const MOST_STEPS: usize = 8;
/// The rotation has settled when a step turns it by less than this, rad.
const SETTLED_RAD: f64 = 1e-9;
/// Bounds the sum of the lesser two singular values from below, see [`spread_is_clear`].
const CLEAR: f64 = 0.01;

/// `H = R S`, `S` symmetric: the best rotation, and how well `H` determines it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Alignment {
    pub rotation: UnitQuaternion<f64>,
    pub stretch: Matrix3<f64>,
}

impl Alignment {
    fn of(rotation: UnitQuaternion<f64>, h: &Matrix3<f64>) -> Self {
        Self { rotation, stretch: rotation.to_rotation_matrix().matrix().transpose() * h }
    }

    /// Singular values of `H`, largest first; the last one has the sign of its determinant.
    pub(crate) fn singular(&self) -> Vector3<f64> {
        eigenvalues(&self.stretch)
    }

    /// Whether all turns but small ones are surely worse, see [`spread_is_clear`].
    pub(crate) fn is_clear(&self) -> bool {
        spread_is_clear(&self.stretch)
    }
}

/// Whether `σ₂ + σ₃` is surely above 0.5 % of `σ₁`, of the eigenvalues of a symmetric matrix: with
/// `s = σ₁ + σ₂ + σ₃` it is at least `det(s I - S) / 2 s²`.
pub(crate) fn spread_is_clear(s: &Matrix3<f64>) -> bool {
    let sum = s.trace();
    (Matrix3::identity() * sum - s).determinant() > CLEAR * sum.powi(3)
}

/// With an upper bound of the sum of the singular values, as near as it is to be had. `None` of what is
/// not finite, and of nothing.
pub fn align(h: &Matrix3<f64>, bound: f64) -> Option<Alignment> {
    let size = h.amax();
    if !(size.is_finite() && size > 0.0) {
        return None;
    }
    let scaled = h / size;
    let found = by_polynomial(&scaled, bound / size).or_else(|| by_columns(&scaled))?;
    Some(Alignment { stretch: found.stretch * size, ..found })
}

fn by_polynomial(h: &Matrix3<f64>, bound: f64) -> Option<Alignment> {
    let k = horn(h);
    let root = largest_root(h, &k, bound)?;
    let start = null_vector(&(k - Matrix4::identity() * root))?;
    let mut found = Alignment::of(unit(start), h);
    for _ in 0..MOST_STEPS {
        let step = newton(&found.stretch)?;
        let turn = unit(Vector4::new(1.0, 0.5 * step.x, 0.5 * step.y, 0.5 * step.z));
        found = Alignment::of(found.rotation * turn, h);
        if step.norm_squared() < SETTLED_RAD * SETTLED_RAD {
            return found.is_clear().then_some(found);
        }
    }
    None
}

fn unit(q: Vector4<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(q[0], q[1], q[2], q[3]))
}

fn by_columns(h: &Matrix3<f64>) -> Option<Alignment> {
    let rotation = jacobi::nearest_rotation(h).unwrap_or_else(UnitQuaternion::identity);
    Some(Alignment::of(rotation, h))
}

/// `K(H)`, for quaternions written `(w, x, y, z)`.
fn horn(h: &Matrix3<f64>) -> Matrix4<f64> {
    let [xx, yx, zx] = [h[(0, 0)], h[(0, 1)], h[(0, 2)]]; // of q's x
    let [xy, yy, zy] = [h[(1, 0)], h[(1, 1)], h[(1, 2)]];
    let [xz, yz, zz] = [h[(2, 0)], h[(2, 1)], h[(2, 2)]];
    #[rustfmt::skip]
    let k = Matrix4::new(
        xx + yy + zz, yz - zy,       zx - xz,       xy - yx,
        yz - zy,      xx - yy - zz,  xy + yx,       zx + xz,
        zx - xz,      xy + yx,       yy - xx - zz,  yz + zy,
        xy - yx,      zx + xz,       yz + zy,       zz - xx - yy,
    );
    k
}

/// Of `λ⁴ - 2 |H|² λ² - 8 det(H) λ + det K`, from above, where all is convex.
fn largest_root(h: &Matrix3<f64>, k: &Matrix4<f64>, bound: f64) -> Option<f64> {
    let (square, linear, constant) =
        (-2.0 * h.norm_squared(), -8.0 * h.determinant(), determinant(k));
    // σ₁ + σ₂ + σ₃ is at most √3 times the norm
    let mut root = bound.min((3.0 * h.norm_squared()).sqrt());
    for _ in 0..MOST_ROOT_STEPS {
        let squared = root * root;
        let slope = (4.0 * squared + 2.0 * square) * root + linear;
        let step = ((squared + square) * squared + linear * root + constant) / slope;
        root -= step;
        if !root.is_finite() {
            return None;
        }
        if step.abs() < ROOT_ACCURACY * root {
            return Some(root);
        }
    }
    None
}

/// Determinants of pairs of columns `01 02 03 12 13 23` of rows `r` and `r + 1`.
fn minors(m: &Matrix4<f64>, r: usize) -> [f64; 6] {
    let minor = |a: usize, b: usize| m[(r, a)] * m[(r + 1, b)] - m[(r, b)] * m[(r + 1, a)];
    [minor(0, 1), minor(0, 2), minor(0, 3), minor(1, 2), minor(1, 3), minor(2, 3)]
}

fn determinant(m: &Matrix4<f64>) -> f64 {
    let (high, low) = (minors(m, 0), minors(m, 2));
    high[0] * low[5] - high[1] * low[4] + high[2] * low[3] + high[3] * low[2] - high[4] * low[1]
        + high[5] * low[0]
}

/// The longest column of the adjugate of a singular symmetric matrix.
fn null_vector(m: &Matrix4<f64>) -> Option<Vector4<f64>> {
    let cofactors = |r: usize, [s01, s02, s03, s12, s13, s23]: [f64; 6]| {
        Vector4::new(
            m[(r, 1)] * s23 - m[(r, 2)] * s13 + m[(r, 3)] * s12,
            m[(r, 2)] * s03 - m[(r, 0)] * s23 - m[(r, 3)] * s02,
            m[(r, 0)] * s13 - m[(r, 1)] * s03 + m[(r, 3)] * s01,
            m[(r, 1)] * s02 - m[(r, 0)] * s12 - m[(r, 2)] * s01,
        )
    };
    let (high, low) = (minors(m, 0), minors(m, 2));
    let columns = [cofactors(0, low), cofactors(1, low), cofactors(2, high), cofactors(3, high)];
    let lengths = columns.map(|column| column.norm_squared());
    let longest = (0..4).fold(0, |best, k| if lengths[k] > lengths[best] { k } else { best });
    (lengths[longest] > 0.0).then(|| columns[longest].normalize())
}

fn newton(s: &Matrix3<f64>) -> Option<Vector3<f64>> {
    let a = Vector3::new(s[(2, 1)] - s[(1, 2)], s[(0, 2)] - s[(2, 0)], s[(1, 0)] - s[(0, 1)]);
    let curvature = Matrix3::identity() * s.trace() - (s + s.transpose()) * 0.5;
    let inverse = curvature.try_inverse()?;
    // a maximum has a positive curvature, of which trace and determinant are two signs
    (curvature.trace() > 0.0 && curvature.determinant() > 0.0).then(|| inverse * a)
}

/// Eigenvalues of a matrix that is symmetric to rounding, largest first; of two equal ones half the
/// digits.
///
/// O. Smith, *Eigenvalues of a symmetric 3 x 3 matrix*, Comm. ACM 4(4), 1961.
pub fn eigenvalues(s: &Matrix3<f64>) -> Vector3<f64> {
    let mean = s.trace() / 3.0;
    let centred = (s + s.transpose()) * 0.5 - Matrix3::identity() * mean;
    let spread = (centred.norm_squared() / 6.0).sqrt();
    if spread <= f64::EPSILON * mean.abs() {
        return Vector3::repeat(mean);
    }
    let half = (0.5 * (centred / spread).determinant()).clamp(-1.0, 1.0);
    let angle = half.acos() / 3.0;
    let third = std::f64::consts::TAU / 3.0;
    let (largest, least) = (2.0 * angle.cos(), 2.0 * (angle + third).cos());
    Vector3::new(largest, -largest - least, least) * spread + Vector3::repeat(mean)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn random_matrix(random: &mut Random, spread: [f64; 3]) -> Matrix3<f64> {
        let rotation = |random: &mut Random| {
            *UnitQuaternion::from_scaled_axis(Vector3::from_fn(|_, _| 3.0 * random.normal()))
                .to_rotation_matrix()
                .matrix()
        };
        rotation(random) * Matrix3::from_diagonal(&Vector3::from(spread)) * rotation(random)
    }

    #[test]
    fn the_rotation_is_that_of_the_singular_value_decomposition() {
        let mut random = Random::new(1);
        let spreads = [
            [3.0, 2.0, 1.0],
            [1.0, 1.0, 1.0],
            [1.0, 1.0, 0.0],
            [1.0, 1e-3, 0.0],
            [1.0, 1e-6, 0.0],
            [5.0, 2.0, -1.0],
            [5.0, 2.0, -1.999],
            [1.0, 1e-3, -0.9e-3],
            [1e9, 2e8, 1e7],
            [1e-12, 2e-13, 1e-14],
        ];
        for spread in spreads {
            for _ in 0..200 {
                let h = random_matrix(&mut random, spread);
                let bound = random.between(1.0, 2.0) * spread.iter().sum::<f64>();
                let found = align(&h, bound).unwrap();
                let expected =
                    jacobi::nearest_rotation(&h).unwrap().to_rotation_matrix().into_inner();
                let clear = (spread[1] + spread[2]) / spread[0];
                let off = (found.rotation.to_rotation_matrix().matrix() - expected).norm();
                assert!(off < 1e-14 / clear, "{spread:?} {off}");
                for k in 0..3 {
                    let error = (found.singular()[k] - spread[k]).abs() / spread[0];
                    assert!(error < 1e-7, "{spread:?} {:?}", found.singular());
                }
            }
        }
    }

    #[test]
    fn nothing_and_what_is_not_finite_has_no_rotation() {
        assert!(align(&Matrix3::zeros(), 1.0).is_none());
        assert!(align(&Matrix3::repeat(f64::NAN), 1.0).is_none());
        assert!(align(&Matrix3::repeat(f64::INFINITY), 1.0).is_none());
    }

    #[test]
    fn a_half_turn_is_found() {
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            let half = UnitQuaternion::from_scaled_axis(axis * std::f64::consts::PI);
            let h = half.to_rotation_matrix().matrix()
                * Matrix3::from_diagonal(&Vector3::new(3.0, 2.0, 1.0));
            assert!(align(&h, 7.0).unwrap().rotation.angle_to(&half) < 1e-12);
        }
    }
}
