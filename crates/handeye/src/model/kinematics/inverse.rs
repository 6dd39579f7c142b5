//! Joint values that bring the flange, or one of its points, somewhere: by damped Newton steps from values that are near.

use nalgebra::{Const, DVector, Dyn, Matrix3xX, OMatrix, SMatrix, SVector, Vector3};

use super::{Arm, Place};
use crate::{Base, Flange, Point, Pose};

/// Most steps.
const MOST_STEPS: usize = 60;
/// The flange is there when it is off by less (rad, m).
const THERE: f64 = 1e-10;
/// A point that only has to be about somewhere is there when it is off by less, m.
const LED: f64 = 1e-3;
/// Near a singular place steps are held back by this, as part of the largest singular value.
const DAMPING: f64 = 1e-6;
/// Longest step of one joint, rad or m.
const LONGEST: f64 = 0.3;
/// The same where it only has to be somewhere: larger ones are quicker.
const LONGEST_LED: f64 = 1.0;

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
        let to_there = |values: &[f64]| {
            let rest = self.base_from_flange(values).local(there);
            let by_joints = || self.by_joints(values).fixed_rows::<6>(0).into_owned();
            (rest.norm() >= THERE).then(|| (rest, by_joints()))
        };
        descend(self.started(start), (most_steps, LONGEST), to_there)
    }

    /// Joint values near `start` that bring a point of the flange to a place in the base, m, in no more than so many steps; of
    /// all that do those that are nearly nearest.
    pub(crate) fn leading(
        &self,
        point: &Vector3<f64>,
        place: &Vector3<f64>,
        start: &[f64],
        most_steps: usize,
    ) -> Option<Vec<f64>> {
        let point = Point::from_vector(*point);
        let to_place = |values: &[f64]| {
            let (places, base_from_flange) = self.places_and_flange(values);
            let at = (base_from_flange * point).vector();
            let rest = place - at;
            let by_joints = || self.point_by_joints(&places, &at);
            (rest.norm() > LED).then(|| (rest, by_joints()))
        };
        descend(self.started(start), (most_steps, LONGEST_LED), to_place)
    }

    /// How a point that moves with the flange, in the base, moves with the joints' values.
    fn point_by_joints(&self, places: &[Place], at: &Vector3<f64>) -> Matrix3xX<f64> {
        let mut all = Matrix3xX::zeros(self.joints.len());
        for (k, (joint, place)) in self.joints.iter().zip(places).enumerate() {
            let axis = place.turning.rotation * Vector3::z();
            let moves = match joint.prismatic {
                true => axis,
                false => axis.cross(&(at - place.turning.translation.vector)),
            };
            all.set_column(k, &moves);
        }
        all
    }

    fn started(&self, start: &[f64]) -> DVector<f64> {
        let joints = self.joints.len();
        DVector::from_iterator(joints, super::padded(start).take(joints))
    }
}

/// Steps until no rest is left, or not one more; a rest comes with how it moves with the joints' values.
fn descend<const M: usize>(
    mut values: DVector<f64>,
    (most_steps, longest_step): (usize, f64),
    rest: impl Fn(&[f64]) -> Option<(SVector<f64, M>, OMatrix<f64, Const<M>, Dyn>)>,
) -> Option<Vec<f64>> {
    for _ in 0..most_steps {
        let Some((rest, by_joints)) = rest(values.as_slice()) else {
            return Some(values.as_slice().to_vec());
        };
        let step = step(&by_joints, &rest)?;
        let longest = step.amax().max(f64::MIN_POSITIVE);
        values += step * (longest_step / longest).min(1.0);
    }
    None
}

/// The shortest step that takes the rest away: `Jᵀ (J Jᵀ + λ I)⁻¹ r`, or where there are fewer joints than numbers
/// `(Jᵀ J + λ I)⁻¹ Jᵀ r`.
fn step<const M: usize>(
    j: &OMatrix<f64, Const<M>, Dyn>,
    rest: &SVector<f64, M>,
) -> Option<DVector<f64>> {
    let squared: SMatrix<f64, M, M> = j * j.transpose();
    let damping = DAMPING * squared.diagonal().max() * rest.norm().min(1.0);
    if j.ncols() >= M {
        let squared = squared + SMatrix::<f64, M, M>::identity() * damping;
        return Some(j.transpose() * squared.cholesky()?.solve(rest));
    }
    let mut squared = j.transpose() * j;
    (0..j.ncols()).for_each(|k| squared[(k, k)] += damping);
    Some(squared.cholesky()?.solve(&(j.transpose() * rest)))
}

#[cfg(test)]
mod tests {
    use super::super::{DhConvention, tests::arm};
    use crate::{Point, Pose, math::random::Random};
    use nalgebra::Vector3;

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
    fn a_point_of_the_flange_is_led_to_a_place() {
        let mut random = Random::new(8);
        let mut short = arm(DhConvention::Standard);
        short.joints.truncate(4);
        for arm in [arm(DhConvention::Standard), short] {
            let joints = arm.joints.len();
            let mut draw = |s: f64| -> Vec<f64> {
                [0.1, -1.2, 1.5, -1.0, -1.4, 0.3]
                    .iter()
                    .take(joints)
                    .map(|c| c + random.between(-s, s))
                    .collect()
            };
            for _ in 0..50 {
                let (there, start) = (draw(0.5), draw(0.5));
                let point = Vector3::new(0.05, -0.02, 0.3);
                let at = |q: &[f64]| (arm.base_from_flange(q) * Point::from_vector(point)).vector();
                let found = arm.leading(&point, &at(&there), &start, 25).unwrap();
                assert!((at(&found) - at(&there)).norm() < 1e-3);
            }
            assert!(
                arm.leading(&Vector3::zeros(), &Vector3::repeat(5.0), &draw(0.5), 25).is_none()
            );
        }
    }

    #[test]
    fn fewer_joints_than_six_come_back_as_well() {
        let mut four = arm(DhConvention::Standard);
        four.joints.truncate(4);
        let mut random = Random::new(6);
        for _ in 0..50 {
            let q: Vec<f64> =
                [0.1, -1.2, 1.5, -1.0].iter().map(|c| c + random.between(-0.5, 0.5)).collect();
            let start: Vec<f64> = q.iter().map(|c| c + random.between(-0.2, 0.2)).collect();
            let there = four.base_from_flange(&q);
            let back = four.base_from_flange(&four.inverse(&there, &start).unwrap());
            assert!(there.local(&back).norm() < 1e-9);
        }
    }

    #[test]
    fn a_place_out_of_reach_has_no_joint_values() {
        let there = Pose::from_parts(&nalgebra::Matrix3::identity(), nalgebra::Vector3::x() * 5.0);
        assert!(arm(DhConvention::Standard).inverse(&there, &[0.1; 6]).is_none());
    }
}
