//! Several models of the robot's errors: their answers' mean, weighted by likelihood.

use nalgebra::{Matrix6, Vector6};

use crate::{Camera, Mount, Pose, calibrate::optics::cluster_variance::WAY_OF_A_TURN};

/// The camera's pose by one model.
#[derive(Clone, Copy)]
pub(super) struct Component {
    /// Logarithm of its likelihood, up to a constant.
    pub log_weight: f64,
    pub x: Pose<Mount, Camera>,
    pub covariance: Matrix6<f64>,
    /// Variance per axis (m²) of what the robot misses with it at one pose.
    pub missed: f64,
}

/// The mean over several models, beside the answer of one of them.
pub(super) struct Mixture {
    /// From its answer to the mean of all.
    pub step: Vector6<f64>,
    /// What all are less certain of than it.
    pub more: Matrix6<f64>,
    pub missed: f64,
    /// Weight of all but the first.
    pub share: f64,
}

impl Mixture {
    /// Mean and covariance of the mixture, beside the `base`, which counts with this covariance elsewhere.
    pub fn of(components: &[Component], base: usize, own: &Matrix6<f64>) -> Self {
        let most = components.iter().map(|c| c.log_weight).fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = components.iter().map(|c| (c.log_weight - most).exp()).sum();
        let weights = components.iter().map(|c| (c.log_weight - most).exp() / sum);
        let (mut mean, mut second, mut covariance) =
            (Vector6::zeros(), Matrix6::zeros(), Matrix6::zeros());
        let mut missed = 0.0;
        for (component, weight) in components.iter().zip(weights) {
            let d = components[base].x.local(&component.x);
            mean += d * weight;
            second += d * d.transpose() * weight;
            covariance += component.covariance * weight;
            missed += component.missed * weight;
        }
        let more = at_least_nothing(&(covariance - own));
        let share = 1.0 - (components[0].log_weight - most).exp() / sum;
        Self { step: mean, more: more + second - mean * mean.transpose(), missed, share }
    }
}

/// The part of a symmetric matrix that adds.
fn at_least_nothing(m: &Matrix6<f64>) -> Matrix6<f64> {
    // rotations and positions are of different size
    let scale = Matrix6::from_diagonal(
        &Vector6::new(1.0, 1.0, 1.0, WAY_OF_A_TURN, WAY_OF_A_TURN, WAY_OF_A_TURN).map(f64::recip),
    );
    let eigen = (scale * m * scale).symmetric_eigen();
    let values = Matrix6::from_diagonal(&eigen.eigenvalues.map(|v| v.max(0.0)));
    let back = scale.map(|x| if x == 0.0 { 0.0 } else { x.recip() });
    back * (eigen.eigenvectors * values * eigen.eigenvectors.transpose()) * back
}

#[cfg(test)]
mod tests {
    use super::*;

    fn component(log_weight: f64, x_mm: f64, sigma_mm: f64) -> Component {
        let step = Vector6::new(0.0, 0.0, 0.0, 1e-3 * x_mm, 0.0, 0.0);
        let covariance = Matrix6::identity() * (1e-3 * sigma_mm).powi(2);
        Component { log_weight, x: Pose::identity().retract(&step), covariance, missed: 0.0 }
    }

    #[test]
    fn equal_models_share_and_their_distance_is_uncertain() {
        let two = [component(0.0, 0.0, 1.0), component(0.0, 2.0, 1.0)];
        let found = Mixture::of(&two, 0, &two[0].covariance);
        assert!((found.step[3] - 1e-3).abs() < 1e-12 && (found.share - 0.5).abs() < 1e-12);
        // half of 2 mm, squared
        assert!((found.more[(3, 3)] - 1e-6).abs() < 1e-12 && found.more[(4, 4)].abs() < 1e-12);
        // about the other one the mean is the same
        let other = Mixture::of(&two, 1, &two[1].covariance);
        assert!((other.step[3] + 1e-3).abs() < 1e-12);
    }

    #[test]
    fn a_model_without_weight_counts_for_nothing_and_a_surer_one_takes_nothing_away() {
        let unlikely = [component(0.0, 0.0, 1.0), component(-40.0, 5.0, 9.0)];
        let found = Mixture::of(&unlikely, 0, &unlikely[0].covariance);
        assert!(found.step.amax() < 1e-12 && found.more.amax() < 1e-12);
        let surer = [component(0.0, 0.0, 1.0), component(0.0, 0.0, 0.1)];
        let found = Mixture::of(&surer, 0, &surer[0].covariance);
        assert!(found.more.amax() < 1e-15, "{}", found.more);
    }
}
