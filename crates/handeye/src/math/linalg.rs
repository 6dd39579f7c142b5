//! The few decompositions that nalgebra does not do reliably, and small helpers on rotations.
//!
//! Hand-eye systems are rank-deficient by construction; nalgebra's Golub-Kahan iteration returns
//! wrong factors on some of them (dimforge/nalgebra#1172). One-sided Jacobi does not: it rotates
//! the columns of `A` until all are orthogonal, and then `A V = U Σ`.
//!
//! G. Golub and C. Van Loan, *Matrix Computations*, 4th ed. 2013, section 8.6.3.

use nalgebra::{
    DMatrix, DVector, Matrix3, Matrix4, SMatrix, SVector, UnitQuaternion, Vector3, Vector4,
};

/// `A = U diag(s) Vᵀ`, singular values in falling order; thin: `U` is m x n for m >= n.
pub struct Svd {
    /// Left singular vectors; columns of zero singular values are zero.
    pub u: DMatrix<f64>,
    /// Singular values, largest first.
    pub s: DVector<f64>,
    /// Right singular vectors.
    pub v: DMatrix<f64>,
}

/// Columns are orthogonal once their cosine is below this.
const ORTHOGONAL: f64 = 1e-15;
/// Sweeps of a one-sided Jacobi iteration; ten are plenty in double precision.
const MOST_SWEEPS: usize = 60;

/// Singular value decomposition of a matrix with at least as many rows as columns; wider ones are
/// padded with zero rows.
pub fn svd(a: &DMatrix<f64>) -> Svd {
    let n = a.ncols();
    let mut u = a.clone().resize_vertically(a.nrows().max(n), 0.0);
    if u.nrows() > 2 * n {
        u = u.qr().unpack_r(); // same Σ and V, far fewer rows
        let mut svd = svd(&u);
        let scaled =
            DMatrix::from_fn(
                n,
                n,
                |i, j| {
                    if svd.s[j] > 0.0 { svd.v[(i, j)] / svd.s[j] } else { 0.0 }
                },
            );
        svd.u = a * scaled;
        return svd;
    }
    let mut v = DMatrix::identity(n, n);
    for _ in 0..MOST_SWEEPS {
        if !sweep(&mut u, &mut v) {
            break;
        }
    }
    sorted(u, v)
}

/// Rotates every pair of columns into orthogonality; says whether anything turned.
fn sweep(u: &mut DMatrix<f64>, v: &mut DMatrix<f64>) -> bool {
    let mut turned = false;
    for p in 0..u.ncols() {
        for q in p + 1..u.ncols() {
            let (alpha, beta) = (u.column(p).norm_squared(), u.column(q).norm_squared());
            let gamma = u.column(p).dot(&u.column(q));
            if gamma.abs() <= ORTHOGONAL * (alpha * beta).sqrt() || gamma == 0.0 {
                continue;
            }
            turned = true;
            let zeta = (beta - alpha) / (2.0 * gamma);
            let t = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
            let c = 1.0 / (1.0 + t * t).sqrt();
            rotate(u, p, q, c, c * t);
            rotate(v, p, q, c, c * t);
        }
    }
    turned
}

fn rotate(m: &mut DMatrix<f64>, p: usize, q: usize, c: f64, s: f64) {
    for i in 0..m.nrows() {
        let (x, y) = (m[(i, p)], m[(i, q)]);
        m[(i, p)] = c * x - s * y;
        m[(i, q)] = s * x + c * y;
    }
}

fn sorted(u: DMatrix<f64>, v: DMatrix<f64>) -> Svd {
    let norms: Vec<f64> = u.column_iter().map(|c| c.norm()).collect();
    let mut order: Vec<usize> = (0..norms.len()).collect();
    order.sort_by(|&i, &j| norms[j].total_cmp(&norms[i]));
    let unit = |j: usize| if norms[j] > 0.0 { u.column(j) / norms[j] } else { u.column(j) * 0.0 };
    Svd {
        u: DMatrix::from_columns(&order.iter().map(|&j| unit(j)).collect::<Vec<_>>()),
        s: DVector::from_iterator(order.len(), order.iter().map(|&j| norms[j])),
        v: DMatrix::from_columns(
            &order.iter().map(|&j| v.column(j).into_owned()).collect::<Vec<_>>(),
        ),
    }
}

/// SVD of a 3 x 3 matrix.
pub(crate) fn svd3(m: &Matrix3<f64>) -> (Matrix3<f64>, Vector3<f64>, Matrix3<f64>) {
    let svd = svd(&DMatrix::from_column_slice(3, 3, m.as_slice()));
    let fixed = |d: &DMatrix<f64>| Matrix3::from_column_slice(d.as_slice());
    (fixed(&svd.u), Vector3::from_column_slice(svd.s.as_slice()), fixed(&svd.v))
}

/// Mean of rotations in the chordal sense: the leading eigenvector of `Σ q qᵀ`.
pub(crate) fn mean_rotation<'a>(
    all: impl Iterator<Item = &'a UnitQuaternion<f64>>,
) -> UnitQuaternion<f64> {
    let moment: Matrix4<f64> = all.map(|q| q.coords * q.coords.transpose()).sum();
    let eigen = moment.symmetric_eigen();
    let q: Vector4<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
    UnitQuaternion::from_quaternion(nalgebra::Quaternion::from_vector(q))
}

/// Solution of a symmetric positive definite system, and its inverse; `None` when it is singular.
pub fn invert_spd<const N: usize>(m: &SMatrix<f64, N, N>) -> Option<SMatrix<f64, N, N>> {
    // scaled to unit diagonal first: units of rad and m differ by orders of magnitude
    let scale: SVector<f64, N> = m.diagonal().map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 });
    if scale.iter().any(|s| !(s.is_finite() && *s > 0.0)) {
        return None;
    }
    let scaled = SMatrix::<f64, N, N>::from_fn(|i, j| m[(i, j)] * scale[i] * scale[j]);
    let inverse =
        nalgebra::linalg::Cholesky::new(DMatrix::from_column_slice(N, N, scaled.as_slice()))?
            .inverse();
    Some(SMatrix::from_fn(|i, j| inverse[(i, j)] * scale[i] * scale[j]))
}

/// A symmetric matrix scaled to unit diagonal, and the scale; `None` where the diagonal is not
/// positive. Units of rad and m differ by orders of magnitude.
pub(crate) fn scaled(m: &DMatrix<f64>) -> Option<(DMatrix<f64>, DVector<f64>)> {
    let scale = m.diagonal().map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 });
    if scale.iter().any(|s| !(s.is_finite() && *s > 0.0)) {
        return None;
    }
    let n = m.nrows();
    Some((DMatrix::from_fn(n, n, |i, j| m[(i, j)] * scale[i] * scale[j]), scale))
}

/// Inverse of a symmetric positive definite matrix; `None` when it is singular.
pub(crate) fn inverse_spd(m: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    if m.is_empty() {
        return Some(m.clone());
    }
    let (scaled, scale) = scaled(m)?;
    let mut inverse = nalgebra::linalg::Cholesky::new(scaled)?.inverse();
    for ((i, j), value) in indices(m.nrows()).zip(inverse.iter_mut()) {
        *value *= scale[i] * scale[j];
    }
    Some(inverse)
}

/// Standard deviation (rad, m) of what nothing determines: far beyond any answer, and yet a number that the algebra can
/// work with. No measurement notices it.
pub(crate) const FREE_SIGMA: f64 = 10.0;

/// Inverse of an information matrix in which directions may be free: these get [`FREE_SIGMA`].
pub(crate) fn inverse_with_free(m: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    inverse_spd(m).or_else(|| inverse_by_eigenvalues(m))
}

fn inverse_by_eigenvalues(m: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let (scaled, scale) = scaled(m)?;
    let eigen = scaled.symmetric_eigen();
    let n = m.nrows();
    let mut inverse = DMatrix::zeros(n, n);
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        let direction = vector.component_mul(&scale);
        let free = FREE_SIGMA * FREE_SIGMA / direction.norm_squared();
        let variance = if *value > LEAST_EIGENVALUE { 1.0 / value } else { free };
        inverse.ger(variance, &direction, &direction, 1.0);
    }
    inverse.iter().all(|x| x.is_finite()).then_some(inverse)
}

/// Eigenvalues of a matrix of unit diagonal below this are zero but for rounding.
const LEAST_EIGENVALUE: f64 = 1e-13;

/// Row and column of every entry, in the order of storage.
fn indices(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |j| (0..n).map(move |i| (i, j)))
}

/// Root of the mean of squares; `None` of nothing.
pub fn root_mean(squares: impl IntoIterator<Item = f64>) -> Option<f64> {
    let (sum, count) = squares.into_iter().fold((0.0, 0.0), |(s, n), x| (s + x, n + 1.0));
    (count > 0.0).then(|| f64::sqrt(sum / count))
}

/// The middle value, the mean of the middle two of an even number; 0 of none.
pub fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    let mut all: Vec<f64> = values.into_iter().collect();
    if all.is_empty() {
        return 0.0;
    }
    let (middle, is_odd) = (all.len() / 2, all.len() % 2 == 1);
    let (below, &mut upper, _) = all.select_nth_unstable_by(middle, f64::total_cmp);
    let lower = below.iter().copied().max_by(f64::total_cmp).filter(|_| !is_odd);
    lower.map_or(upper, |lower| 0.5 * (lower + upper))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_of_an_even_number_lies_between_the_middle_two() {
        assert_eq!(median([]), 0.0);
        assert_eq!(median([3.0]), 3.0);
        assert_eq!(median([5.0, 1.0]), 3.0);
        assert_eq!(median([9.0, 1.0, 2.0]), 2.0);
        assert_eq!(median([9.0, 1.0, 4.0, 2.0]), 3.0);
        assert_eq!(median([1.0, f64::INFINITY, 2.0]), 2.0);
        assert_eq!(median([f64::INFINITY, 1.0]), f64::INFINITY);
    }

    /// Small deterministic generator for test matrices.
    fn noise(state: &mut u64) -> f64 {
        *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (*state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }

    #[test]
    fn rank_deficient_matrices_are_decomposed_exactly() {
        let mut state = 1;
        for (rows, columns, rank) in
            [(60, 8, 6), (3, 3, 2), (4, 4, 3), (9, 9, 8), (8, 8, 1), (3, 5, 3)]
        {
            for _ in 0..200 {
                let left = DMatrix::from_fn(rows, rank, |_, _| noise(&mut state));
                let right = DMatrix::from_fn(rank, columns, |_, _| noise(&mut state));
                let a = left * right;
                let svd = svd(&a);
                let again = &svd.u * DMatrix::from_diagonal(&svd.s) * svd.v.transpose();
                let again = again.rows(0, rows).into_owned();
                assert!((again - &a).norm() < 1e-13 * a.norm());
                let null = svd.v.column(columns - 1);
                if rank < columns {
                    assert!((&a * null).norm() < 1e-13 * a.norm());
                }
            }
        }
    }

    #[test]
    fn mixed_units_do_not_spoil_the_inverse() {
        let m = SMatrix::<f64, 2, 2>::new(1e12, 1e3, 1e3, 1e-3);
        let product = m * invert_spd(&m).unwrap();
        assert!((product - SMatrix::identity()).norm() < 1e-3);
        assert!(invert_spd(&SMatrix::<f64, 2, 2>::new(1.0, 1.0, 1.0, 1.0)).is_none());
    }
}
