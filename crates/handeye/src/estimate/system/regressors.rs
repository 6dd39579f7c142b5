//! What the robot's own noise passes off as information: errors in variables.
//!
//! The equations of a view are those of `X` and `Y` about a robot pose that errs itself, by `a` in the
//! target's frame: `J_Y` is off by `ad(a)`. A robot that turns about one axis tilts by its noise, and a
//! step along that axis seems to be seen by
//!
//! ```text
//! S = Σ E[ad(a)ᵀ V⁻¹ ad(a)]
//! ```
//!
//! The likelihood of the robot's true poses has none of it: the noise that `V` expects changes with the
//! step just as the residual does. So information is believed only as far as it exceeds `S`.
//!
//! W. A. Fuller, *Measurement Error Models*, Wiley 1987, 3.1.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::{NoiseModel, views::divide};
use crate::{
    estimate::system::state::System,
    math::{
        lie,
        linalg::{self, FREE_SIGMA},
    },
};

/// Columns of a view's factor that are the robot's.
const OF_ROBOT: usize = 6;
/// How far noise may exceed `S` by chance, in standard deviations of about `1/√N` of it for `N` views;
/// the noise is an estimate, too.
const BY_CHANCE: f64 = 5.0;
/// Less than this part of the information needs no correction: the covariance changes by as much.
const NO_MATTER: f64 = 1e-3;

impl System {
    /// The covariance without what noise passes off as information; what it leaves free has
    /// [`FREE_SIGMA`].
    pub(super) fn believed(&self, covariance: DMatrix<f64>, noise: &NoiseModel) -> DMatrix<f64> {
        let passed_off = self.passed_off(noise) * self.most();
        let share = passed_off.component_mul(&covariance).sum();
        if share < NO_MATTER {
            return covariance;
        }
        self.reduced(&passed_off).unwrap_or(covariance)
    }

    /// `S` reaches this often by chance.
    fn most(&self) -> f64 {
        1.0 + BY_CHANCE / (self.views.len().max(1) as f64).sqrt()
    }

    /// `S`, of all unknowns.
    fn passed_off(&self, noise: &NoiseModel) -> DMatrix<f64> {
        let variances = noise.variances();
        let mut sum = DMatrix::zeros(self.h.nrows(), self.h.nrows());
        for view in &self.views {
            let robot = view.factor.column_iter().zip(&view.columns).take(OF_ROBOT);
            for (column, source) in robot {
                // the factor is divided by the root of the covariance
                let mut off = lie::ad(&(view.root * column));
                off.as_mut_slice().chunks_exact_mut(6).for_each(|c| divide(&view.root, c));
                let mut of_target = sum.fixed_view_mut::<6, 6>(6, 6);
                of_target += off.transpose() * off * variances[source.index()];
            }
        }
        sum
    }

    /// `(H - S)⁻¹`: with `H = L Lᵀ` and `L⁻¹ S L⁻ᵀ = U M Uᵀ` it is `L⁻ᵀ U (1 - M)⁻¹ Uᵀ L⁻¹`.
    fn reduced(&self, passed_off: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let (scaled, scale) = linalg::scaled(&self.h)?;
        let n = self.h.nrows();
        let root = Cholesky::new(scaled)?.l().solve_lower_triangular(&DMatrix::identity(n, n))?;
        let root = DMatrix::from_fn(n, n, |i, j| root[(i, j)] * scale[j]);
        let eigen = (&root * passed_off * root.transpose()).symmetric_eigen();
        let directions = root.tr_mul(&eigen.eigenvectors);
        let variance = |k: usize| {
            let free = FREE_SIGMA.powi(2) / directions.column(k).norm_squared();
            let left = 1.0 - eigen.eigenvalues[k];
            if left > 0.0 { (1.0 / left).min(free.max(1.0)) } else { free.max(1.0) }
        };
        let variances = DVector::from_fn(n, |k, _| variance(k));
        let spread = &directions * DMatrix::from_diagonal(&variances) * directions.transpose();
        spread.iter().all(|x| x.is_finite()).then_some(spread)
    }
}
