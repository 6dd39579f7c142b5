//! Multipliers that prove a minimum global, by Lagrange duality.
//!
//! Every pair of rotations satisfies `zᵀ A_k z = 0` for the matrices of [`constraints`] (columns
//! and rows orthonormal, columns right-handed) and `|z|² = 7`. So for any multipliers
//!
//! ```text
//! zᵀ Q z = γ + zᵀ M z >= γ + 7 min(λ_min(M), 0)        M = Q - Σ λ_k A_k - γ E,  E = e eᵀ, e = (0, 1)
//! ```
//!
//! With `γ` the cost at a stationary `z*`, multipliers with `M z* = 0` exist (the stationarity
//! conditions); where the constraints are redundant they form a plane, and within it the smallest
//! eigenvalue of `M` across `z*` is raised as far as it goes, by Newton steps on
//!
//! ```text
//! maximise  τ s + ln det(Wᵀ M W - s I)        W spans what is orthogonal to z*
//! ```
//!
//! for growing `τ`. If it reaches zero the bound meets the cost.
//!
//! M. Giamou et al., *Certifiably globally optimal extrinsic calibration from per-sensor
//! egomotion*, IEEE RA-L 4(2), 2019 (arXiv 1809.03554); E. Wise et al., *Certifiably optimal
//! monocular hand-eye calibration*, MFI 2020 (arXiv 2005.08298); S. Boyd and L. Vandenberghe, *Convex
//! Optimization*, chapter 11 (barrier).

use nalgebra::{Cholesky, DMatrix, DVector, SMatrix};

use super::quadratic::{Form, N, Z};
use crate::math::linalg;

const ACROSS: usize = N - 1;
type Across = SMatrix<f64, ACROSS, ACROSS>;

/// `|z|²` of every pair of rotations: three for each, and one.
const LENGTH: f64 = 7.0;
/// Part of the largest below which a singular value is rounding.
const ROUNDING: f64 = 1e-10;
/// First and last weight of the eigenvalue against the barrier, and the step between, for forms of
/// mean eigenvalue one: at the last the eigenvalue is within 2e-9 of its most.
const WEIGHTS: (f64, f64, f64) = (1.0, 1e10, 10.0);
/// Newton steps for one weight; few are needed, the weights being close.
const STEPS: usize = 30;

/// The proof, as far as it goes.
pub(super) struct Bound {
    /// No pair of rotations costs less than this.
    pub least_cost: f64,
    /// Smallest eigenvalue of `M` over the mean eigenvalue of `Q`.
    pub min_eigenvalue: f64,
}

/// The best lower bound on the cost that multipliers at `z` give.
pub(super) fn bound(q: &Form, z: &Z) -> Bound {
    let unit = (q.trace() / N as f64).max(f64::MIN_POSITIVE);
    let q = q / unit;
    let cost = z.dot(&(q * z));
    let mut e = Form::zeros();
    e[(ACROSS, ACROSS)] = cost;
    let basis = basis();
    let (particular, free) = stationary(&basis, &(q * z - e * z), z);
    let mut m = q - e - combined(&basis, &particular);
    if let Some(w) = across(z) {
        let free: Vec<Form> = free.iter().map(|f| combined(&basis, f)).collect();
        m -= raise(&m, &free, &w);
    }
    let m = 0.5 * (m + m.transpose());
    let least = m.symmetric_eigenvalues().min();
    // rounding of the eigenvalues themselves is far below what is tolerated of the gap
    let least_cost = unit * (cost + LENGTH * least.min(0.0));
    Bound { least_cost, min_eigenvalue: least }
}

/// `A_k` of both rotations.
fn constraints() -> Vec<Form> {
    let mut all = vec![];
    for block in [0, 9] {
        // entry (row, column) of the rotation
        let at = |row: usize, column: usize| block + 3 * column + row;
        for i in 0..3 {
            for j in i..3 {
                let mut columns = Form::zeros();
                let mut rows = Form::zeros();
                for k in 0..3 {
                    add(&mut columns, at(k, i), at(k, j), 1.0);
                    add(&mut rows, at(i, k), at(j, k), 1.0);
                }
                if i == j {
                    add(&mut columns, ACROSS, ACROSS, -1.0);
                    add(&mut rows, ACROSS, ACROSS, -1.0);
                }
                all.extend([columns, rows]);
            }
        }
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            for (a, b, c) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
                // component c of column i x column j - column k
                let mut right_handed = Form::zeros();
                add(&mut right_handed, at(a, i), at(b, j), 1.0);
                add(&mut right_handed, at(b, i), at(a, j), -1.0);
                add(&mut right_handed, at(c, k), ACROSS, -1.0);
                all.push(right_handed);
            }
        }
    }
    all
}

/// Adds `value z_i z_j` to a form.
fn add(form: &mut Form, i: usize, j: usize, value: f64) {
    form[(i, j)] += 0.5 * value;
    form[(j, i)] += 0.5 * value;
}

/// Orthonormal forms that span the constraints.
fn basis() -> Vec<Form> {
    let all = constraints();
    let columns: Vec<DVector<f64>> =
        all.iter().map(|a| DVector::from_column_slice(a.as_slice())).collect();
    let svd = linalg::svd(&DMatrix::from_columns(&columns));
    (0..all.len())
        .filter(|&k| svd.s[k] > ROUNDING * svd.s[0])
        .map(|k| Form::from_iterator(svd.u.column(k).iter().copied()))
        .collect()
}

fn combined(basis: &[Form], by: &DVector<f64>) -> Form {
    basis.iter().zip(by).map(|(a, x)| a * *x).sum()
}

/// Multipliers with `Σ λ_k A_k z = rhs` in the least-squares sense, and what changes nothing there.
fn stationary(basis: &[Form], rhs: &Z, z: &Z) -> (DVector<f64>, Vec<DVector<f64>>) {
    let columns: Vec<Z> = basis.iter().map(|a| a * z).collect();
    let matrix = DMatrix::from_fn(N, basis.len(), |i, k| columns[k][i]);
    let svd = linalg::svd(&matrix);
    let mut particular = DVector::zeros(basis.len());
    let mut free = vec![];
    for k in 0..basis.len() {
        let direction = svd.v.column(k).into_owned();
        if svd.s[k] > ROUNDING * svd.s[0] {
            let along: f64 = svd.u.column(k).iter().zip(rhs.iter()).map(|(u, r)| u * r).sum();
            particular += direction * (along / svd.s[k]);
        } else {
            free.push(direction);
        }
    }
    (particular, free)
}

/// Orthonormal columns across `z`.
fn across(z: &Z) -> Option<SMatrix<f64, N, ACROSS>> {
    // Householder's reflection of z onto the last axis
    let mut v = z / z.norm();
    v[ACROSS] += 1.0; // z's last entry is positive: no cancellation
    let h = Form::identity() - v * v.transpose() * (2.0 / v.norm_squared());
    h.iter().all(|x| x.is_finite()).then(|| h.fixed_columns::<ACROSS>(0).into_owned())
}

/// The combination of `free` whose removal from `m` raises its smallest eigenvalue most.
fn raise(m: &Form, free: &[Form], w: &SMatrix<f64, N, ACROSS>) -> Form {
    let start: Across = w.transpose() * m * w;
    let directions: Vec<Across> = free.iter().map(|f| w.transpose() * f * w).collect();
    let n = directions.len();
    let mut at = DVector::zeros(n + 1);
    at[n] = start.symmetric_eigenvalues().min() - 1.0;
    let mut weight = WEIGHTS.0;
    while weight <= WEIGHTS.1 {
        for _ in 0..STEPS {
            if !newton(&start, &directions, &mut at, weight) {
                break;
            }
        }
        weight *= WEIGHTS.2;
    }
    free.iter().zip(at.iter()).map(|(f, x)| f * *x).sum()
}

/// `Wᵀ M W - s I` at these multipliers, `s` the last.
fn slack(start: &Across, directions: &[Across], at: &DVector<f64>) -> Across {
    let n = directions.len();
    let moved: Across = directions.iter().zip(at.iter()).map(|(d, x)| d * *x).sum();
    start - moved - Across::identity() * at[n]
}

/// Squared Newton decrement below which a weight is done with.
const CENTRED: f64 = 1e-9;

/// One Newton step; whether it moved.
fn newton(start: &Across, directions: &[Across], at: &mut DVector<f64>, weight: f64) -> bool {
    let n = directions.len();
    let Some(here) = Cholesky::new(slack(start, directions, at)) else { return false };
    let inverse = here.inverse();
    // what each unknown takes from the slack, through its inverse
    let mut taken: Vec<Across> = directions.iter().map(|d| inverse * d).collect();
    taken.push(inverse);
    let mut gradient = DVector::from_fn(n + 1, |k, _| taken[k].trace());
    gradient[n] -= weight;
    let hessian = DMatrix::from_fn(n + 1, n + 1, |a, b| taken[a].dot(&taken[b].transpose()));
    let Some(inverse) = linalg::inverse_spd(&hessian) else { return false };
    let step = -(inverse * &gradient);
    let decrement = -step.dot(&gradient);
    if !(decrement > CENTRED) {
        return false;
    }
    let value = |c: &Cholesky<f64, nalgebra::Const<ACROSS>>, at: &DVector<f64>| {
        -weight * at[n] - 2.0 * c.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>()
    };
    let now = value(&here, at);
    let mut length = 1.0;
    while length > 1e-12 {
        let next = &*at + &step * length;
        let there = Cholesky::new(slack(start, directions, &next));
        if there.is_some_and(|c| value(&c, &next) <= now - 0.1 * length * decrement) {
            *at = next;
            return true;
        }
        length *= 0.5;
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, Vector3};

    fn some_z(k: f64) -> Z {
        let r = |a: f64| {
            Rotation3::new(Vector3::new((a + k).sin(), (2.0 * a - k).cos(), 2.0 * (a * k).sin()))
        };
        let (x, y) = (r(0.3), r(1.7));
        Z::from_iterator(x.matrix().iter().chain(y.matrix().iter()).copied().chain([1.0]))
    }

    #[test]
    fn rotations_satisfy_every_constraint() {
        for k in 0..20 {
            let z = some_z(f64::from(k));
            assert!(constraints().iter().all(|a| z.dot(&(a * z)).abs() < 1e-14));
            assert!((z.norm_squared() - LENGTH).abs() < 1e-14);
        }
        // 21 for each rotation, of which one follows from the others
        assert_eq!(basis().len(), 40);
    }

    #[test]
    fn what_is_across_is_orthonormal() {
        let z = some_z(2.0);
        let w = across(&z).unwrap();
        assert!((w.transpose() * w - Across::identity()).norm() < 1e-13);
        assert!((w.transpose() * z).norm() < 1e-13);
    }
}
