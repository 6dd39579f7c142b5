//! Joint values that bring the flange somewhere, by damped Newton steps from values that are near.

use nalgebra::{DMatrix, DVector, Matrix6, Vector6};

use super::Arm;
use crate::{Base, Flange, Pose};

/// Most steps.
const MOST_STEPS: usize = 60;
/// The flange is there when it is off by less (rad, m).
const THERE: f64 = 1e-10;
/// Near a singular place steps are held back by this, as part of the largest singular value.
const DAMPING: f64 = 1e-6;
/// Longest step of one joint, rad or m.
const LONGEST: f64 = 0.3;

impl Arm {
    /// Joint values near `start` that bring the flange to `there`; `None` where it cannot reach
    /// that, or not from there.
    pub fn inverse(&self, there: &Pose<Base, Flange>, start: &[f64]) -> Option<Vec<f64>> {
        self.inverse_in(there, start, MOST_STEPS)
    }

    /// The same in no more than so many steps.
    pub fn inverse_in(
        &self,
        there: &Pose<Base, Flange>,
        start: &[f64],
        most_steps: usize,
    ) -> Option<Vec<f64>> {
        let mut values: DVector<f64> =
            DVector::from_iterator(self.joints.len(), super::padded(start).take(self.joints.len()));
        for _ in 0..most_steps {
            let rest = self.base_from_flange(values.as_slice()).local(there);
            if rest.norm() < THERE {
                return Some(values.as_slice().to_vec());
            }
            let step = step(&self.by_joints(values.as_slice()), &rest)?;
            let longest = step.amax().max(f64::MIN_POSITIVE);
            values += step * (LONGEST / longest).min(1.0);
        }
        None
    }
}

/// `Jᵀ (J Jᵀ + λ I)⁻¹ r`.
fn step(j: &DMatrix<f64>, rest: &Vector6<f64>) -> Option<DVector<f64>> {
    let squared = j * j.transpose();
    let damping = DAMPING * squared.diagonal().max() * rest.norm().min(1.0);
    let squared: Matrix6<f64> = squared.fixed_view::<6, 6>(0, 0) + Matrix6::identity() * damping;
    let solved = squared.cholesky()?.solve(rest);
    Some(j.transpose() * solved)
}

#[cfg(test)]
mod tests {
    use super::super::{DhConvention, tests::arm};
    use crate::{Pose, math::random::Random};

    #[test]
    fn the_flange_comes_back_to_where_joint_values_near_by_put_it() {
        let mut random = Random::new(5);
        for convention in [DhConvention::Standard, DhConvention::Modified] {
            let arm = arm(convention);
            for _ in 0..50 {
                let q: Vec<f64> = [0.1, -1.2, 1.5, -1.0, -1.4, 0.3]
                    .iter()
                    .map(|c| c + random.between(-0.5, 0.5))
                    .collect();
                let start: Vec<f64> = q.iter().map(|c| c + random.between(-0.1, 0.1)).collect();
                let there = arm.base_from_flange(&q);
                let found = arm.inverse(&there, &start).unwrap();
                let back = arm.base_from_flange(&found);
                assert!(there.local(&back).norm() < 1e-9);
            }
        }
    }

    #[test]
    fn a_place_out_of_reach_has_no_joint_values() {
        let there = Pose::from_parts(&nalgebra::Matrix3::identity(), nalgebra::Vector3::x() * 5.0);
        assert!(arm(DhConvention::Standard).inverse(&there, &[0.1; 6]).is_none());
    }
}
