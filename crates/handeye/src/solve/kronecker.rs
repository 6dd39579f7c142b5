//! Sums of Kronecker products, the common ground of the methods that vectorise `R_A R_X = R_Y R_B`.
//!
//! `vec(R_Y) = (R_B ⊗ R_A) vec(R_X)`, columns stacked.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::{moments, shared::open};
use crate::{Error, PosePair, math::jacobi};

/// Adds `b ⊗ a`.
#[inline]
pub(super) fn add(sum: &mut SMatrix<f64, 9, 9>, b: &Matrix3<f64>, a: &Matrix3<f64>) {
    for (l, column) in sum.as_mut_slice().chunks_exact_mut(9).enumerate() {
        for (k, entry) in column.iter_mut().enumerate() {
            *entry += b[(k / 3, l / 3)] * a[(k % 3, l % 3)];
        }
    }
}

/// `P = Σ R_B ⊗ R_A`.
pub(super) fn sum(pairs: &[PosePair]) -> SMatrix<f64, 9, 9> {
    let mut p = SMatrix::zeros();
    for pair in pairs {
        add(&mut p, &pair.r_b(), &pair.r_a());
    }
    p
}

/// Sums of `R_A t_X - t_Y = R_Y t_B - t_A` over captures, less their means: so `t_Y` is gone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Centred {
    mean_r_a: Matrix3<f64>,
    mean_t_a: Vector3<f64>,
    mean_t_b: Vector3<f64>,
    /// `Σ R_Aᵀ R_A`.
    pub rr: Matrix3<f64>,
    /// `Σ t_B t_Bᵀ`.
    pub bb: Matrix3<f64>,
    /// `Σ t_A t_Bᵀ`.
    pub ab: Matrix3<f64>,
    /// `Σ t_B ⊗ R_A`.
    pub br: SMatrix<f64, 9, 3>,
    /// `Σ R_Aᵀ t_A`.
    pub ra: Vector3<f64>,
}

impl Centred {
    pub fn new(pairs: &[PosePair]) -> Self {
        let n = pairs.len().max(1) as f64;
        let all: Vec<_> = pairs.iter().map(|p| (p.r_a(), p.t_a(), p.t_b())).collect();
        let mut sums = Self {
            mean_r_a: all.iter().map(|p| p.0).sum::<Matrix3<f64>>() / n,
            mean_t_a: all.iter().map(|p| p.1).sum::<Vector3<f64>>() / n,
            mean_t_b: all.iter().map(|p| p.2).sum::<Vector3<f64>>() / n,
            rr: Matrix3::zeros(),
            bb: Matrix3::zeros(),
            ab: Matrix3::zeros(),
            br: SMatrix::zeros(),
            ra: Vector3::zeros(),
        };
        for (r_a, t_a, t_b) in all {
            sums.add(&(r_a - sums.mean_r_a), &(t_a - sums.mean_t_a), &(t_b - sums.mean_t_b));
        }
        sums
    }

    fn add(&mut self, r_a: &Matrix3<f64>, t_a: &Vector3<f64>, t_b: &Vector3<f64>) {
        self.rr += r_a.transpose() * r_a;
        self.bb += t_b * t_b.transpose();
        self.ab += t_a * t_b.transpose();
        self.ra += r_a.transpose() * t_a;
        for c in 0..3 {
            let mut block = self.br.fixed_view_mut::<3, 3>(3 * c, 0);
            block += r_a * t_b[c];
        }
    }

    /// `t_X` and `t_Y` of least squares for a given `R_Y`.
    pub fn positions(&self, r_y: &Matrix3<f64>) -> Result<(Vector3<f64>, Vector3<f64>), Error> {
        let y = SMatrix::<f64, 9, 1>::from_column_slice(r_y.as_slice());
        let rhs = self.br.transpose() * y - self.ra;
        let (values, vectors) = jacobi::eigen(&self.rr);
        if !(values[2] > moments::NO_LEVER * values[0]) {
            return Err(open("the motions do not fix the camera's position"));
        }
        let inverse = |v: Vector3<f64>| vectors * (vectors.transpose() * v).component_div(&values);
        let t = inverse(rhs);
        let t_x = t + inverse(rhs - self.rr * t);
        Ok((t_x, self.other(r_y, &t_x)))
    }

    /// `t_Y`, from the means.
    pub fn other(&self, r_y: &Matrix3<f64>, t_x: &Vector3<f64>) -> Vector3<f64> {
        self.mean_r_a * t_x + self.mean_t_a - r_y * self.mean_t_b
    }
}
