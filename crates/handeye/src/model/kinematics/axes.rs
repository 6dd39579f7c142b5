//! An arm out of the lines its joints turn about: Denavit-Hartenberg parameters of any chain.
//!
//! A frame lies on each joint's axis, z along it. From one axis to the next lead four parameters: `θ` and `d` about and
//! along z, to the common perpendicular of the two, `a` along that and `α` about it. Axes that are nearly parallel have
//! their perpendicular far away; there the next frame is where the next axis comes through the plane `d = 0`, and `β`
//! takes the place of `d` (S. Hayati and M. Mirmirani, *Improving the absolute positioning accuracy of robot
//! manipulators*, J. Robotic Systems 2, 1985):
//!
//! ```text
//! Rz(θ) Tz(d) Tx(a) Rx(α) Ry(β)
//! ```

use nalgebra::{Isometry3, Point3, Rotation3, Unit, UnitQuaternion, Vector3};

use super::{Arm, DhConvention, Joint, PARALLEL};
use crate::{Base, Flange, Pose};

/// The axis of a joint where all joint values are zero, in the base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// A point on it, m.
    pub through: Point3<f64>,
    /// About what the joint turns, or along what it slides.
    pub direction: Unit<Vector3<f64>>,
    /// Whether it slides.
    pub prismatic: bool,
}

/// Common perpendiculars shorter than this (m) have no direction of their own.
const MEETING: f64 = 1e-12;

impl Arm {
    /// The arm with these axes, from the base outwards, and this flange at zero.
    pub fn of_axes(axes: &[Axis], base_from_flange: &Pose<Base, Flange>) -> Arm {
        let Some(first) = axes.first() else { return Arm::new(DhConvention::Standard, vec![]) };
        let start = on(first);
        let (mut here, mut joints) = (start, vec![]);
        for pair in axes.windows(2) {
            let joint = Joint { prismatic: pair[0].prismatic, ..to_next(&here, &pair[1]) };
            here *= joint.turn(0.0) * joint.link();
            joints.push(joint);
        }
        joints.push(Joint { prismatic: axes[axes.len() - 1].prismatic, ..Joint::default() });
        Arm {
            base_from_first_joint: Pose::claim(start),
            last_link_from_flange: Pose::claim(here.inv_mul(base_from_flange.iso())),
            ..Arm::new(DhConvention::Standard, joints)
        }
    }
}

/// A frame on an axis, z along it.
fn on(axis: &Axis) -> Isometry3<f64> {
    let z = Vector3::z_axis();
    let turn = UnitQuaternion::rotation_between_axis(&z, &axis.direction).unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    });
    Isometry3::from_parts(axis.through.coords.into(), turn)
}

/// The parameters that lead from a frame, z on its joint's axis, to one on the next axis.
fn to_next(here: &Isometry3<f64>, next: &Axis) -> Joint {
    let (p, v) = (
        here.inverse_transform_point(&next.through),
        here.inverse_transform_vector(&next.direction),
    );
    let across = Vector3::z().cross(&v);
    if across.norm() < PARALLEL { nearly_parallel(p, v) } else { askew(p, v, across) }
}

/// By the common perpendicular: `s z + a x = p + t v`.
fn askew(p: Point3<f64>, v: Vector3<f64>, across: Vector3<f64>) -> Joint {
    let x = across.normalize();
    let a = p.coords.dot(&x);
    // x may point either way; it points towards the next axis, so that no length is negative
    let (x, a) = if a < 0.0 { (-x, -a) } else { (x, a) };
    let y = Vector3::z().cross(&x);
    // along y the next axis is reached by going along v alone
    let t = -p.coords.dot(&y) / v.dot(&y);
    let d = p.z + t * v.z;
    let alpha = (-v.dot(&y)).atan2(v.z);
    Joint { a, alpha, d, theta_offset: x.y.atan2(x.x), ..Joint::default() }
}

/// By where the next axis comes through the plane of this frame.
fn nearly_parallel(p: Point3<f64>, v: Vector3<f64>) -> Joint {
    let through = p.coords - v * (p.z / v.z);
    let a = through.norm();
    let theta_offset = if a > MEETING { through.y.atan2(through.x) } else { 0.0 };
    let v = Rotation3::from_axis_angle(&Vector3::z_axis(), -theta_offset) * v;
    // Rx(α) Ry(β) z = (sin β, -sin α cos β, cos α cos β)
    let (alpha, beta) = ((-v.y).atan2(v.z), v.x.atan2(v.y.hypot(v.z)));
    Joint { a: if a > MEETING { a } else { 0.0 }, alpha, theta_offset, beta, ..Joint::default() }
}

#[cfg(test)]
mod tests {
    use nalgebra::Translation3;

    use super::*;
    use crate::math::random::Random;

    fn turned(axis: &Axis, value: f64) -> Isometry3<f64> {
        let direction = axis.direction.into_inner();
        if axis.prismatic {
            return Translation3::from(direction * value).into();
        }
        let there = Translation3::from(axis.through.coords);
        there * UnitQuaternion::from_scaled_axis(direction * value) * there.inverse()
    }

    /// The product of exponentials, an independent way to the same flange.
    fn flange(axes: &[Axis], at_zero: &Isometry3<f64>, values: &[f64]) -> Isometry3<f64> {
        axes.iter().zip(values).fold(Isometry3::identity(), |all, (a, v)| all * turned(a, *v))
            * at_zero
    }

    fn random_vector(random: &mut Random) -> Vector3<f64> {
        Vector3::from_fn(|_, _| random.between(-1.0, 1.0))
    }

    #[test]
    fn an_arm_of_any_axes_brings_the_flange_where_the_axes_do() {
        let mut random = Random::new(7);
        for k in 0..300 {
            let mut axes: Vec<Axis> = (0..7)
                .map(|j| Axis {
                    through: random_vector(&mut random).into(),
                    direction: Unit::new_normalize(random_vector(&mut random)),
                    prismatic: (k + j) % 9 == 0,
                })
                .collect();
            // parallel, nearly parallel, opposite and meeting axes, and the same twice
            axes[2].direction = axes[1].direction;
            axes[3].direction = Unit::new_normalize(
                -axes[2].direction.into_inner() + random_vector(&mut random) * 1e-4,
            );
            axes[5].through = axes[4].through + axes[4].direction.into_inner() * 0.3;
            axes[6] = axes[5];
            let at_zero = Isometry3::new(random_vector(&mut random), random_vector(&mut random));
            let arm = Arm::of_axes(&axes, &Pose::claim(at_zero));
            let values: Vec<f64> = (0..7).map(|_| random.between(-3.0, 3.0)).collect();
            let (found, wanted) = (arm.base_from_flange(&values), flange(&axes, &at_zero, &values));
            let off = crate::math::lie::log(&wanted.inv_mul(found.iso())).norm();
            assert!(off < 1e-10, "{k}: {off}");
            let farthest = arm.joints.iter().map(|j| j.a.abs().max(j.d.abs())).fold(0.0, f64::max);
            assert!(farthest < 50.0, "{farthest}");
        }
    }
}
