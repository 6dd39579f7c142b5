//! Eigenvectors of small symmetric matrices, and rotations from them, without allocation.
//!
//! Jacobi's method turns one pair of axes after the other until the matrix is diagonal:
//! `Jᵀ M J = Λ`. It finds small eigenvalues of rank-deficient matrices to full absolute accuracy.
//!
//! G. Golub and C. Van Loan, *Matrix Computations*, 4th ed. 2013, section 8.5;
//! B. Horn, *Closed-form solution of absolute orientation using unit quaternions*, JOSA A 4(4),
//! 1987 (the rotation nearest to a matrix).

use nalgebra::{Matrix3, Matrix4, Quaternion, SMatrix, SVector, UnitQuaternion, Vector4};

/// Sweeps over all pairs of axes; six are usual in double precision.
const MOST_SWEEPS: usize = 40;
/// Off-diagonal entries this small beside their diagonal ones count as zero.
const ZERO: f64 = 1e-17;

/// Eigenvalues, largest first, and the eigenvectors as columns in the same order.
pub(crate) fn eigen<const N: usize>(
    m: &SMatrix<f64, N, N>,
) -> (SVector<f64, N>, SMatrix<f64, N, N>) {
    let (mut m, mut v) = (*m, SMatrix::<f64, N, N>::identity());
    let scale = m.norm();
    for _ in 0..MOST_SWEEPS {
        let mut turned = false;
        for p in 0..N {
            for q in p + 1..N {
                if m[(p, q)].abs() > ZERO * scale {
                    turn(&mut m, &mut v, p, q);
                    turned = true;
                }
            }
        }
        if !turned {
            break;
        }
    }
    sorted(&m, &v)
}

/// Turns axes `p` and `q` so that `m[(p, q)]` vanishes.
fn turn<const N: usize>(
    m: &mut SMatrix<f64, N, N>,
    v: &mut SMatrix<f64, N, N>,
    p: usize,
    q: usize,
) {
    let zeta = (m[(q, q)] - m[(p, p)]) / (2.0 * m[(p, q)]);
    let t = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
    let c = 1.0 / (1.0 + t * t).sqrt();
    let s = c * t;
    for k in 0..N {
        let (x, y) = (m[(k, p)], m[(k, q)]);
        (m[(k, p)], m[(k, q)]) = (c * x - s * y, s * x + c * y);
        let (x, y) = (v[(k, p)], v[(k, q)]);
        (v[(k, p)], v[(k, q)]) = (c * x - s * y, s * x + c * y);
    }
    for k in 0..N {
        let (x, y) = (m[(p, k)], m[(q, k)]);
        (m[(p, k)], m[(q, k)]) = (c * x - s * y, s * x + c * y);
    }
    (m[(p, q)], m[(q, p)]) = (0.0, 0.0);
}

fn sorted<const N: usize>(
    m: &SMatrix<f64, N, N>,
    v: &SMatrix<f64, N, N>,
) -> (SVector<f64, N>, SMatrix<f64, N, N>) {
    let mut order: [usize; N] = std::array::from_fn(|k| k);
    order.sort_by(|&i, &j| m[(j, j)].total_cmp(&m[(i, i)]));
    let values = SVector::from_fn(|k, _| m[(order[k], order[k])]);
    (values, SMatrix::from_fn(|i, k| v[(i, order[k])]))
}

/// Gap between two eigenvalues, as a share of the largest of all, below which they count as equal
/// and their eigenvectors as free.
pub(crate) const NO_GAP: f64 = 1e-13;

/// The leading eigenvector; `None` when two are as good.
pub(crate) fn leading<const N: usize>(m: &SMatrix<f64, N, N>) -> Option<SVector<f64, N>> {
    let (values, vectors) = eigen(m);
    (values[0] - values[1] > NO_GAP * values[0].abs()).then(|| vectors.column(0).into_owned())
}

/// The rotation nearest to `m` in the Frobenius norm, also where `m` mirrors; `None` when several
/// are as near.
pub fn nearest_rotation(m: &Matrix3<f64>) -> Option<UnitQuaternion<f64>> {
    let (xx, yy, zz) = (m[(0, 0)], m[(1, 1)], m[(2, 2)]);
    let turn = (m[(2, 1)] - m[(1, 2)], m[(0, 2)] - m[(2, 0)], m[(1, 0)] - m[(0, 1)]);
    let both = (m[(0, 1)] + m[(1, 0)], m[(0, 2)] + m[(2, 0)], m[(1, 2)] + m[(2, 1)]);
    // qᵀ H q = tr(R(q)ᵀ m), scalar first
    #[rustfmt::skip]
    let h = Matrix4::new(
        xx + yy + zz, turn.0, turn.1, turn.2,
        turn.0, xx - yy - zz, both.0, both.1,
        turn.1, both.0, yy - xx - zz, both.2,
        turn.2, both.1, both.2, zz - xx - yy,
    );
    if !h.iter().all(|x| x.is_finite()) {
        return None;
    }
    leading(&h).map(|q| rotation_of(&q))
}

/// The rotation of a quaternion written scalar first, of any length.
pub(crate) fn rotation_of(q: &Vector4<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(q[0], q[1], q[2], q[3]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn eigenvectors_make_the_matrix_diagonal() {
        let a = SMatrix::<f64, 8, 6>::from_fn(|i, j| ((3 * i + 5 * j) as f64 * 1.7).sin());
        let m = a * a.transpose(); // rank six
        let (values, vectors) = eigen(&m);
        let again = vectors * SMatrix::from_diagonal(&values) * vectors.transpose();
        assert!((again - m).norm() < 1e-14 * m.norm());
        assert!(values[6].abs() < 1e-14 * values[0] && values[7].abs() < 1e-14 * values[0]);
    }

    #[test]
    fn the_nearest_rotation_of_a_rotation_is_itself() {
        for axis_angle in [Vector3::new(0.3, -2.0, 1.0), Vector3::x() * std::f64::consts::PI] {
            let q = UnitQuaternion::from_scaled_axis(axis_angle);
            let found = nearest_rotation(&(q.to_rotation_matrix().into_inner() * 3.0)).unwrap();
            assert!(crate::math::lie::angle(&found, &q) < 1e-14);
        }
    }

    #[test]
    fn a_reflection_gives_a_rotation_and_rank_one_gives_none() {
        let mirror = Matrix3::from_diagonal(&Vector3::new(1.0, 0.9, -0.1));
        assert!(nearest_rotation(&mirror).unwrap().angle() < 1e-14);
        assert!(nearest_rotation(&(Vector3::x() * Vector3::y().transpose())).is_none());
        assert!(nearest_rotation(&-Matrix3::identity()).is_none());
    }
}
