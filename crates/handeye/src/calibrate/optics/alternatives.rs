//! Priors that allow for a mistake: the declared value is right, or it is not, and then it is anywhere near.
//!
//! Such a prior is a mixture of normal distributions about what was declared, narrow ones and wide ones,
//!
//! ```text
//! p(x) = Σ_m π_m N(x; declared, σ_m²)        w_m ∝ π_m p(data | m)
//! ```
//!
//! Each component is one fit, and its evidence `p(data | m)` the restricted likelihood with the prior's determinant
//! in it (Laplace's approximation). The answer has the mean and the covariance of the posterior mixture,
//!
//! ```text
//! x̄ = Σ w_m x_m        C = Σ w_m (C_m + (x_m - x̄)(x_m - x̄)ᵀ)
//! ```
//!
//! so that it follows the declared value where the data do not contradict it, the data where they do, and is as
//! uncertain as the choice between them.
//!
//! J. Hoeting, D. Madigan, A. Raftery and C. Volinsky, *Bayesian model averaging: a tutorial*, Statistical Science
//! 14(4), 1999.

use nalgebra::{DMatrix, DVector};

use super::{
    cluster_variance,
    prior::{self, Component, Declared, is_shared},
};
use crate::{
    Error, HandEye,
    estimate::{self, JointFit, KnownNoise, Problem},
    model::session::Session,
};

/// A component of less weight than this changes neither mean nor covariance.
const NEGLIGIBLE: f64 = 1e-4;

/// The prior of what was declared of the target; without components that of the extras themselves.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Alternatives(Vec<Component>);

/// A fit under all components.
pub(crate) struct Averaged {
    /// The problem with the likeliest component as its prior.
    pub problem: Problem,
    /// Mean and covariance over all components.
    pub fit: JointFit,
    /// Posterior probabilities that what was declared is right.
    pub as_declared: Declared<f64>,
}

/// What was declared is not in question.
const NO_DOUBT: Declared<f64> = Declared { size: 1.0, shape: 1.0, depth: 1.0, lens: 1.0 };

impl Alternatives {
    /// What the user said, and what is known of prints, scans and lenses.
    pub(crate) fn of(session: &Session) -> Self {
        Self(prior::components(session))
    }

    /// The components, where the problem has unknowns that they concern.
    fn components(&self, problem: &Problem) -> &[Component] {
        if problem.extras.iter().any(|e| is_shared(e.kind)) { &self.0 } else { &[] }
    }

    /// Fits the problem under every component.
    ///
    /// # Errors
    /// As [`estimate::fit_joint`].
    pub(crate) fn fit(
        &self,
        problem: &Problem,
        start: &HandEye,
        known: &KnownNoise,
    ) -> Result<Averaged, Error> {
        self.average(problem, |problem| estimate::fit_joint(problem, start, known))
    }

    /// The same from an answer that is near.
    pub(crate) fn refit(&self, problem: &Problem, near: &JointFit, known: &KnownNoise) -> Averaged {
        let fitted = |p: &Problem| Ok(estimate::joint::refit(p, near, known));
        self.average(problem, fitted).unwrap_or_else(|_: Error| Averaged {
            problem: problem.clone(),
            fit: estimate::joint::refit(problem, near, known),
            as_declared: NO_DOUBT,
        })
    }

    fn average(
        &self,
        problem: &Problem,
        fit: impl Fn(&Problem) -> Result<JointFit, Error>,
    ) -> Result<Averaged, Error> {
        let components = self.components(problem);
        if components.is_empty() {
            return Ok(Averaged {
                problem: problem.clone(),
                fit: fit(problem)?,
                as_declared: NO_DOUBT,
            });
        }
        // the noise is that of the widest prior: a mistake would otherwise pass for noise, and likelihoods under
        // different noise do not compare
        let widest = components.last().map_or_else(|| problem.clone(), |c| c.applied(problem));
        let reference = fit(&widest)?;
        let excess = cluster_variance::excess(&widest, &reference, is_shared);
        let mut all = Vec::with_capacity(components.len());
        for component in components {
            // what is as good as `excess` times less data is, in the unknowns, a prior that much tighter
            let tight = component.tightened(excess).applied(problem);
            let mut found = estimate::joint::refit_under_noise_of(&tight, &reference);
            let evidence = found.log_likelihood + for_unknown_noise(&found, &reference, excess);
            let problem = component.applied(problem);
            found.extras.clone_from(&problem.extras);
            widen(&mut found, excess);
            all.push((component.log_probability + evidence, problem, found));
        }
        let declared = |which: fn(&Declared<bool>) -> bool, weights: &[f64]| {
            let narrow = components.iter().zip(weights).filter(|(c, _)| which(&c.declared));
            narrow.map(|(_, w)| w).sum::<f64>()
        };
        let most = all.iter().map(|a| a.0).fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = all.iter().map(|a| (a.0 - most).exp()).sum();
        let weights: Vec<f64> = all.iter().map(|a| (a.0 - most).exp() / sum).collect();
        let best = (0..all.len()).max_by(|&i, &j| all[i].0.total_cmp(&all[j].0)).unwrap_or(0);
        let fits: Vec<(f64, &JointFit)> =
            weights.iter().copied().zip(all.iter().map(|a| &a.2)).collect();
        let fit = mixture(&fits, best);
        let as_declared = Declared {
            size: declared(|d| d.size, &weights),
            shape: declared(|d| d.shape, &weights),
            depth: declared(|d| d.depth, &weights),
            lens: declared(|d| d.lens, &weights),
        };
        Ok(Averaged { problem: all[best].1.clone(), fit, as_declared })
    }
}

/// Share of the equations that tell the noise of one kind, of rotations or of positions.
const OF_ONE_NOISE: f64 = 0.5;

/// What the likelihood of a fit that costs `Δ` more gains where the noise is an estimate, of `ν` equations: integrated
/// over the noise, `exp(-Δ/2)` is `(1 + Δ/ν)^(-ν/2)`. Of both there is as much less as captures err alike.
fn for_unknown_noise(fit: &JointFit, reference: &JointFit, excess: f64) -> f64 {
    let more = (fit.cost - reference.cost).max(0.0);
    let equations = (OF_ONE_NOISE * reference.degrees_of_freedom).max(1.0);
    0.5 * more - 0.5 * equations * (more / excess / equations).ln_1p()
}

/// Widens the covariance of what all captures tell together, and of what depends on it:
/// `C + (λ-1) C_u C_uu⁻¹ C_uᵀ`.
fn widen(fit: &mut JointFit, excess: f64) {
    let which: Vec<usize> =
        (0..fit.extras.len()).filter(|k| is_shared(fit.extras[*k].kind)).map(|k| 12 + k).collect();
    let Some(covariance) = &mut fit.covariance else { return };
    let cross = covariance.select_columns(&which);
    let own = cross.select_rows(&which);
    if let Some(cholesky) = own.cholesky() {
        *covariance += &cross * cholesky.solve(&cross.transpose()) * (excess - 1.0);
    }
}

/// Mean and covariance of a mixture of answers, about the `best` of them.
fn mixture(fits: &[(f64, &JointFit)], best: usize) -> JointFit {
    let about = fits[best].1;
    let counts = |(w, f): &&(f64, &JointFit)| *w > NEGLIGIBLE && f.covariance.is_some();
    let parts: Vec<(f64, DVector<f64>, &DMatrix<f64>)> = fits
        .iter()
        .filter(counts)
        .filter_map(|(w, f)| Some((*w, difference(about, f), f.covariance.as_ref()?)))
        .collect();
    let total: f64 = parts.iter().map(|p| p.0).sum();
    if parts.len() < 2 || about.covariance.is_none() {
        return about.clone();
    }
    let n = parts[0].1.len();
    let mean = parts.iter().fold(DVector::zeros(n), |m, (w, d, _)| m + d * (w / total));
    let spread = |c: DMatrix<f64>, (w, d, own): &(f64, DVector<f64>, &DMatrix<f64>)| {
        let off = d - &mean;
        c + (*own + &off * off.transpose()) * (w / total)
    };
    let covariance = parts.iter().fold(DMatrix::zeros(n, n), spread);
    let mut averaged = about.clone();
    averaged.hand_eye = HandEye {
        mount_from_camera: about
            .hand_eye
            .mount_from_camera
            .retract(&mean.fixed_rows::<6>(0).into()),
        anchor_from_target: about
            .hand_eye
            .anchor_from_target
            .retract(&mean.fixed_rows::<6>(6).into()),
    };
    averaged.values += mean.rows(12, n - 12);
    averaged.covariance = Some(covariance);
    averaged
}

/// Tangent from one answer to another: both poses and the extras.
fn difference(from: &JointFit, to: &JointFit) -> DVector<f64> {
    let x = from.hand_eye.mount_from_camera.local(&to.hand_eye.mount_from_camera);
    let y = from.hand_eye.anchor_from_target.local(&to.hand_eye.anchor_from_target);
    let values = &to.values - &from.values;
    let all = x.iter().chain(y.iter()).chain(values.iter()).copied();
    DVector::from_iterator(12 + values.len(), all)
}
