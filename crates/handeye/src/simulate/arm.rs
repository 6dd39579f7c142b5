//! An arm that was not built as its model says: links, joint zeros, gears and bending.
//!
//! A gear of joint `j` turns it too far by `Σ c_jk sin(k q_j + φ_jk)`, `k = 1, 2`, and the weight of
//! what is farther out bends shoulder and elbow by an angle that grows with the horizontal distance
//! to the flange.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::Vector3;

use crate::{
    Base, Flange, Pose,
    math::random::Random,
    model::kinematics::{Arm, DhConvention, Joint},
};

/// How wrong an arm is, standard deviations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmErrors {
    /// Lengths of the links, m.
    pub length_m: f64,
    /// Angles of the links and zeros of the joints, rad.
    pub angle_rad: f64,
    /// Waves of the gears, rad.
    pub gear_rad: f64,
    /// Bending of shoulder and elbow for a horizontal distance of 1 m, rad.
    pub bending_rad: f64,
}

impl ArmErrors {
    /// An arm as its model says.
    pub const NONE: Self = Self { length_m: 0.0, angle_rad: 0.0, gear_rad: 0.0, bending_rad: 0.0 };
}

impl Default for ArmErrors {
    /// Half a millimetre at the flange, once base and flange are fitted.
    fn default() -> Self {
        Self { length_m: 0.25e-3, angle_rad: 4e-4, gear_rad: 4e-5, bending_rad: 2e-4 }
    }
}

/// An arm, and the model that its controller computes with.
#[derive(Debug, Clone, PartialEq)]
pub struct BuiltArm {
    /// What the controller believes.
    pub model: Arm,
    /// Its links as they are.
    pub links: Arm,
    /// Per joint: size and phase of the first and second wave, rad.
    pub gears: Vec<[(f64, f64); 2]>,
    /// Bending of shoulder and elbow for a horizontal distance of 1 m, rad.
    pub bending: [f64; 2],
}

/// Rounds in which waves and bending follow the joint values; each shrinks the rest by 1e-3.
const ROUNDS: usize = 8;
/// Starts of the search for joint values, as changes of shoulder, elbow and wrist.
const STARTS: [f64; 5] = [0.0, 0.6, -0.6, 1.2, -1.2];

/// A usual industrial arm: six joints, 1.4 m of reach, a wrist whose axes meet.
pub(crate) fn usual_arm() -> Arm {
    let joint = |a, alpha, d, theta_offset| Joint { a, alpha, d, theta_offset, ..Joint::default() };
    let joints = vec![
        joint(0.15, -FRAC_PI_2, 0.45, 0.0),
        joint(0.60, 0.0, 0.0, -FRAC_PI_2),
        joint(0.12, -FRAC_PI_2, 0.0, 0.0),
        joint(0.0, FRAC_PI_2, 0.64, 0.0),
        joint(0.0, -FRAC_PI_2, 0.0, 0.0),
        joint(0.0, 0.0, 0.10, 0.0),
    ];
    Arm::new(DhConvention::Standard, joints)
}

impl BuiltArm {
    /// An arm of this model, with errors that `random` decides on.
    pub fn draw(model: Arm, errors: &ArmErrors, random: &mut Random) -> Self {
        let mut links = model.clone();
        for joint in &mut links.joints {
            joint.a += random.normal() * errors.length_m;
            joint.d += random.normal() * errors.length_m;
            joint.alpha += random.normal() * errors.angle_rad;
            joint.beta += random.normal() * errors.angle_rad;
            joint.theta_offset += random.normal() * errors.angle_rad;
        }
        let mut wave = || (random.normal() * errors.gear_rad, random.between(0.0, TAU));
        let gears = model.joints.iter().map(|_| [wave(), wave()]).collect();
        let bending = [errors.bending_rad * random.unit(), errors.bending_rad * random.unit()];
        Self { model, links, gears, bending }
    }

    /// Where the flange really is.
    pub fn base_from_flange(&self, joints: &[f64]) -> Pose<Base, Flange> {
        self.links.base_from_flange(&self.turned(joints))
    }

    /// How far the joints really turn.
    fn turned(&self, joints: &[f64]) -> Vec<f64> {
        let flange = self.model.base_from_flange(joints).translation();
        let shoulder = Vector3::new(flange.x, flange.y, 0.0).norm();
        let wave =
            |q: f64, k: usize, (size, phase): (f64, f64)| size * ((k + 1) as f64 * q + phase).sin();
        let mut turned: Vec<f64> = joints
            .iter()
            .zip(&self.gears)
            .map(|(q, gear)| q + wave(*q, 0, gear[0]) + wave(*q, 1, gear[1]))
            .collect();
        for (k, bending) in self.bending.iter().enumerate() {
            if let Some(q) = turned.get_mut(k + 1) {
                *q += bending * shoulder;
            }
        }
        turned
    }

    /// Joint values that bring the flange there; `None` out of reach.
    pub fn joints_at(&self, there: &Pose<Base, Flange>) -> Option<Vec<f64>> {
        self.joints_near(there, &self.model_joints(there)?)
    }

    /// Such joint values near others.
    pub fn joints_near(&self, there: &Pose<Base, Flange>, start: &[f64]) -> Option<Vec<f64>> {
        let mut joints = self.model.inverse(there, start)?;
        for _ in 0..ROUNDS {
            let turned = self.turned(&joints);
            let wanted = self.links.inverse(there, &turned)?;
            joints.iter_mut().zip(wanted.iter().zip(&turned)).for_each(|(q, (w, t))| *q += w - t);
        }
        Some(joints)
    }

    /// The same by the model, from the first start that leads there.
    fn model_joints(&self, there: &Pose<Base, Flange>) -> Option<Vec<f64>> {
        let at = there.translation();
        let towards = at.y.atan2(at.x);
        let bends = STARTS.iter().flat_map(|a| STARTS.map(|b| (*a, b)));
        let wrists = [FRAC_PI_2, -FRAC_PI_2];
        bends
            .flat_map(|(a, b)| {
                let around = [0.0, 1.5, -1.5, 3.0];
                let start = move |w: f64, v: f64, u: f64| [towards, 0.3 + a, 0.4 + b, v, w, u];
                wrists.into_iter().flat_map(move |w| {
                    around.into_iter().flat_map(move |v| around.map(move |u| start(w, v, u)))
                })
            })
            .find_map(|start| self.model.inverse(there, &start))
            .map(|q| q.into_iter().map(principal).collect())
    }
}

/// The same angle within half a turn.
fn principal(angle: f64) -> f64 {
    angle - (angle / TAU).round() * TAU
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{math::lie, register::rigid_fit};

    #[test]
    fn joint_values_bring_the_real_flange_where_it_was_asked_for() {
        let mut random = Random::new(4);
        let arm = BuiltArm::draw(usual_arm(), &ArmErrors::default(), &mut random);
        for _ in 0..20 {
            let turn = nalgebra::Rotation3::new(random.normal3());
            let place = Vector3::new(0.65, 0.1, 0.5) + random.normal3() * 0.1;
            let there = Pose::from_parts(turn.matrix(), place);
            let Some(joints) = arm.joints_at(&there) else { panic!("{there:?} is out of reach") };
            assert!(
                lie::log(&(there.inverse().iso() * arm.base_from_flange(&joints).iso())).norm()
                    < 1e-9
            );
        }
    }

    #[test]
    fn the_usual_arm_errs_by_half_a_millimetre() {
        let (mut sum, mut count) = (0.0, 0.0);
        for seed in 0..20 {
            let mut random = Random::new(seed);
            let arm = BuiltArm::draw(usual_arm(), &ArmErrors::default(), &mut random);
            let (mut real, mut said) = (vec![], vec![]);
            for _ in 0..60 {
                let turn = nalgebra::Rotation3::new(random.normal3());
                let place = Vector3::new(0.65, 0.1, 0.4) + random.normal3() * 0.15;
                let Some(q) = arm.joints_at(&Pose::from_parts(turn.matrix(), place)) else {
                    continue;
                };
                real.push(arm.base_from_flange(&q).translation());
                said.push(arm.model.base_from_flange(&q).translation());
            }
            let fit = rigid_fit::rigid_fit(&real, &said).unwrap();
            for (a, b) in real.iter().zip(&said) {
                sum += (fit.target_from_source.transform_point(&(*a).into()).coords - b)
                    .norm_squared();
                count += 1.0;
            }
        }
        let rms = f64::sqrt(sum / count) * 1e3;
        assert!((0.3..0.7).contains(&rms), "{rms} mm");
    }
}
