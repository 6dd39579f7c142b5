//! What the robot can reach: joint values within limits where the arm is known; elsewhere poses near those in which it has
//! stood.

use nalgebra::Vector3;

use super::collision::{Collision, Surroundings};
use crate::{
    Base, Error, Flange, Pose,
    math::random::halton,
    model::{kinematics::Arm, residual::Residual},
};

/// How it is known what the robot reaches.
#[derive(Debug, Clone, PartialEq)]
pub enum Reach {
    /// The arm and its limits.
    Arm(ArmReach),
    /// Poses near those in which it has stood.
    Near(NearReach),
}

/// An arm, the limits of its joints, and where they stand.
#[derive(Debug, Clone, PartialEq)]
pub struct ArmReach {
    /// The arm.
    pub arm: Arm,
    /// Lowest and highest value of each joint, rad or m.
    pub limits: Vec<(f64, f64)>,
    /// Joint values now, rad or m: the way begins here.
    pub now: Vec<f64>,
    /// What may collide.
    pub surroundings: Surroundings,
}

/// Poses in which the robot has stood.
#[derive(Debug, Clone, PartialEq)]
pub struct NearReach {
    /// The poses; the last one is where it stands now.
    pub stood: Vec<Pose<Base, Flange>>,
    /// How far from one of them it may go.
    pub within: Residual,
    /// What may collide: what the flange carries, and what stands in the cell.
    pub surroundings: Surroundings,
}

/// A pose that is reached, and where the robot is then.
#[derive(Debug, Clone, PartialEq)]
pub struct Station {
    /// Where the flange is.
    pub base_from_flange: Pose<Base, Flange>,
    /// Joint values, where the arm is known.
    pub joints: Option<Vec<f64>>,
}

/// Why a pose is not reached.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Unreached {
    /// No joint values within the limits lead there, or it is far from all poses that were reached.
    TooFar,
    /// Two bodies collide there, or on the path to it.
    Collides(Collision),
}

/// Joints keep from their limits by this, rad or m.
const FROM_LIMITS: f64 = 0.01;
/// Places in which a search for joint values begins that knows nothing.
const STARTS: usize = 200;
/// Steps of the search for joint values.
const STEPS: usize = 25;
/// Those of the search for joint values of a candidate: there are others.
const STEPS_OF_CANDIDATE: usize = 6;
/// A robot that has reached a pose reaches others within these.
pub const USUALLY_NEAR: Residual = Residual { angle: 0.8, distance: 0.3 };

impl ArmReach {
    /// # Errors
    /// Numbers of limits or values that are not those of the joints; shapes that are none.
    pub fn check(&self) -> Result<(), Error> {
        self.arm.check()?;
        self.surroundings.check()?;
        let joints = self.arm.joints.len();
        for (what, count) in [("limits", self.limits.len()), ("joint values", self.now.len())] {
            if count != joints {
                return Err(Error::Invalid(format!("{count} {what} for {joints} joints")));
            }
        }
        let numbers = self.limits.iter().flat_map(|(low, high)| [low, high]).chain(&self.now);
        if !numbers.copied().all(f64::is_finite) {
            return Err(Error::NotFinite { what: "a joint's limit or value".into() });
        }
        match self.surroundings.collision(&self.arm, &self.now) {
            None => Ok(()),
            Some(Collision { part, with }) => Err(Error::Invalid(format!(
                "where the robot stands now, {part} collides with {with}: correct the shapes, or the joint values"
            ))),
        }
    }

    /// Joint values within limits that lead to a pose, the search beginning at many places; `None` where none do.
    pub fn joints_somewhere(
        arm: &Arm,
        limits: &[(f64, f64)],
        there: &Pose<Base, Flange>,
    ) -> Option<Vec<f64>> {
        let middle = limits.iter().map(|(low, high)| 0.5 * (low + high)).collect();
        let surroundings = Surroundings::default();
        let reach =
            ArmReach { arm: arm.clone(), limits: limits.to_vec(), now: middle, surroundings };
        let mut starts =
            std::iter::once(reach.now.clone()).chain((0..STARTS).map(|k| reach.drawn(k)));
        starts.find_map(|start| reach.joints_at(there, &[start]).ok())
    }

    fn keeps_limits(&self, values: &[f64]) -> bool {
        let keeps = |(value, (low, high)): (&f64, &(f64, f64))| {
            *value >= low + FROM_LIMITS && *value <= high - FROM_LIMITS
        };
        values.iter().zip(&self.limits).all(keeps)
    }

    /// Turned by whole turns so that it is within its limits and as near to where it stands as it can be.
    fn unwound(&self, mut values: Vec<f64>, near: &[f64]) -> Vec<f64> {
        let turn = std::f64::consts::TAU;
        for (k, value) in values.iter_mut().enumerate() {
            if self.arm.joints[k].prismatic {
                continue;
            }
            *value -= turn * ((*value - near[k]) / turn).round();
            let (low, high) = self.limits[k];
            if *value < low + FROM_LIMITS {
                *value += turn;
            } else if *value > high - FROM_LIMITS {
                *value -= turn;
            }
        }
        values
    }

    /// Joint values that lead to a pose, from one of those in which the search begins.
    fn joints_at(
        &self,
        there: &Pose<Base, Flange>,
        starts: &[Vec<f64>],
    ) -> Result<Vec<f64>, Unreached> {
        let mut why = Unreached::TooFar;
        for start in starts {
            let Some(values) = self.arm.inverse_in(there, start, STEPS) else { continue };
            let values = self.unwound(values, &self.now);
            if !self.keeps_limits(&values) {
                continue;
            }
            match self.surroundings.collision(&self.arm, &values) {
                None => return Ok(values),
                Some(collision) => why = Unreached::Collides(collision),
            }
        }
        Err(why)
    }

    /// The flange is never further from the base than this, m.
    fn longest(&self) -> f64 {
        let joints = self.arm.joints.iter().zip(&self.limits);
        let slides = joints.filter(|(joint, _)| joint.prismatic);
        self.arm.length() + slides.map(|(_, (low, high))| low.abs().max(high.abs())).sum::<f64>()
    }

    /// Joint values number `k` of those that are spread over all that the joints can do.
    fn drawn(&self, k: usize) -> Vec<f64> {
        self.within_limits(&halton(k, self.limits.len()))
    }

    /// Joint values at these shares of what each joint can do.
    pub(super) fn within_limits(&self, shares: &[f64]) -> Vec<f64> {
        let value = |((low, high), share): (&(f64, f64), &f64)| {
            low + FROM_LIMITS + (high - low - 2.0 * FROM_LIMITS) * share
        };
        self.limits.iter().zip(shares).map(value).collect()
    }

    /// Where the flange is when one of its points is led to a place in the base, m, from joint values where that begins;
    /// `None` where it does not come there.
    pub(super) fn leading(
        &self,
        point: &Vector3<f64>,
        place: &Vector3<f64>,
        start: &[f64],
    ) -> Option<Pose<Base, Flange>> {
        let values = self.arm.leading(point, place, start, STEPS_OF_CANDIDATE)?;
        let values = self.unwound(values, &self.now);
        self.keeps_limits(&values).then(|| self.arm.base_from_flange(&values))
    }
}

impl Reach {
    /// # Errors
    /// As [`ArmReach::check`].
    pub fn check(&self) -> Result<(), Error> {
        match self {
            Reach::Arm(arm) => arm.check(),
            Reach::Near(near) => near.surroundings.check(),
        }
    }

    /// What is reached at a pose, near one of `others` first.
    ///
    /// # Errors
    /// Why it is not reached.
    pub fn station(
        &self,
        there: &Pose<Base, Flange>,
        others: &[Station],
    ) -> Result<Station, Unreached> {
        match self {
            Reach::Arm(arm) => {
                let known = others.iter().rev().filter_map(|s| s.joints.clone());
                let mut starts: Vec<Vec<f64>> = vec![arm.now.clone()];
                starts.extend(known.take(2));
                let joints = arm.joints_at(there, &starts)?;
                // what the joint values really do
                let base_from_flange = arm.arm.base_from_flange(&joints);
                Ok(Station { base_from_flange, joints: Some(joints) })
            }
            Reach::Near(near) => near.station(there),
        }
    }

    /// Whether the flange cannot be turned as one likes.
    pub fn has_few_joints(&self) -> bool {
        matches!(self, Reach::Arm(arm) if arm.arm.joints.len() < 6)
    }

    /// Whether a pose is surely out of reach, without a search for joint values.
    pub(super) fn is_surely_too_far(&self, there: &Pose<Base, Flange>) -> bool {
        match self {
            Reach::Arm(arm) => there.translation().norm() > arm.longest(),
            Reach::Near(near) => !near.is_near(there),
        }
    }

    /// Where the robot stands now.
    pub fn now(&self) -> Option<Station> {
        match self {
            Reach::Arm(arm) => Some(Station {
                base_from_flange: arm.arm.base_from_flange(&arm.now),
                joints: Some(arm.now.clone()),
            }),
            Reach::Near(near) => {
                let last = near.stood.last()?;
                Some(Station { base_from_flange: *last, joints: None })
            }
        }
    }

    /// The first collision on the path from one pose to another.
    pub fn collision_between(&self, from: &Station, to: &Station) -> Option<Collision> {
        match (self, &from.joints, &to.joints) {
            (Reach::Arm(arm), Some(a), Some(b)) => {
                arm.surroundings.collision_between(&arm.arm, a, b)
            }
            (Reach::Arm(_), ..) => None,
            (Reach::Near(near), ..) => near
                .surroundings
                .collision_on_straight_path(&from.base_from_flange, &to.base_from_flange),
        }
    }
}

impl NearReach {
    fn is_near(&self, there: &Pose<Base, Flange>) -> bool {
        self.stood.iter().any(|stood| Residual::are_within(stood, there, self.within))
    }

    fn station(&self, there: &Pose<Base, Flange>) -> Result<Station, Unreached> {
        if !self.is_near(there) {
            return Err(Unreached::TooFar);
        }
        match self.surroundings.collision_on_straight_path(there, there) {
            Some(collision) => Err(Unreached::Collides(collision)),
            None => Ok(Station { base_from_flange: *there, joints: None }),
        }
    }
}

impl Station {
    /// How long the way to another one is: rad of all joints, or m and rad of the flange.
    pub fn way_to(&self, other: &Station) -> f64 {
        match (&self.joints, &other.joints) {
            (Some(a), Some(b)) => a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max),
            _ => {
                let (a, b) = (&self.base_from_flange, &other.base_from_flange);
                a.distance_to(b) + a.angle_to(b)
            }
        }
    }
}
