//! What moves with the arm, what stands around it, and whether the two collide: at one pose, and on the path between two.
//!
//! Along a joint motion a point moves by no more than `Σ |Δq_j| r_j`, `r_j` its largest distance from axis `j`. So a
//! step may be as long as it takes to use up the free distance, and no obstacle is stepped over (conservative
//! advancement: B. Mirtich, *Impulse-based dynamic simulation of rigid body systems*, 1996).

use nalgebra::{Isometry3, UnitQuaternion};

use super::solids::{Capsule, Cuboid};
use crate::{Base, Error, Flange, Pose, math::random::halton, model::kinematics::Arm};

/// What a part is fixed to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum On {
    /// The robot's base: it stands still.
    Base,
    /// What the joint of this number moves; the first joint is 0.
    Joint(usize),
    /// The flange: tool, camera or board.
    Flange,
}

/// A part of the robot, or of what it carries.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// What it is called.
    pub name: String,
    /// What it is fixed to.
    pub on: On,
    /// Its shape, in the base, in the frame behind the joint ([`Arm::link_frames`]), or in the flange.
    pub shape: Capsule,
}

/// Something that stands in the cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    /// What it is called.
    pub name: String,
    /// Where it stands, in the base.
    pub shape: Cuboid,
}

/// All bodies that may collide.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Surroundings {
    /// The robot and what it carries.
    pub parts: Vec<Part>,
    /// What stands in the cell.
    pub obstacles: Vec<Obstacle>,
    /// What everything keeps from everything, m.
    pub clearance_m: f64,
    /// Pairs of parts that are not looked at: neighbours, which always overlap. Lower number first.
    pub ignored: Vec<(usize, usize)>,
}

/// Two bodies that collide.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Collision {
    /// A part of the robot, or of what it carries.
    pub part: String,
    /// Another part, or an obstacle.
    pub with: String,
}

/// Nothing is further away than this, m.
const FAR: f64 = 1e3;
/// Joint values that are drawn to see what always overlaps, and in how many of them it does.
const DRAWN: usize = 100;
const NEARLY_ALL: usize = 95;
/// A way is looked at in no finer steps than this share of it.
const FINEST: f64 = 1e-4;
/// Steps without an arm, whose ways are straight: m, and rad at a metre's distance.
const STRAIGHT_STEP: f64 = 0.01;

impl Surroundings {
    /// # Errors
    /// Shapes that are none.
    pub fn check(&self) -> Result<(), Error> {
        self.parts.iter().try_for_each(|part| part.shape.check())?;
        self.obstacles.iter().try_for_each(|obstacle| obstacle.shape.check())?;
        match self.clearance_m.is_finite() && self.clearance_m >= 0.0 {
            true => Ok(()),
            false => Err(Error::Invalid("the clearance must be zero or more".into())),
        }
    }

    /// Does not look any more at parts on neighbouring links, at those that overlap nearly whatever the joints do, and at
    /// those that overlap in a pose that the robot has stood in: of these the shapes are too large.
    pub fn ignoring_neighbours(
        mut self,
        arm: &Arm,
        limits: &[(f64, f64)],
        stood: &[Vec<f64>],
    ) -> Surroundings {
        let last = arm.joints.len();
        let link = |on: On| match on {
            On::Base => 0,
            On::Joint(k) => k + 1,
            On::Flange => last,
        };
        let count = self.parts.len();
        let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
        let is_near =
            |a: usize, b: usize| link(self.parts[a].on).abs_diff(link(self.parts[b].on)) <= 1;
        let drawn = |k: usize| -> Vec<f64> {
            let value = |((low, high), share): (&(f64, f64), f64)| low + (high - low) * share;
            limits.iter().zip(halton(k, limits.len())).map(value).collect()
        };
        let overlapping = |all: &[Vec<Capsule>], a: usize, b: usize| {
            all.iter().filter(|all| all[a].apart_from(&all[b]) < self.clearance_m).count()
        };
        let stood: Vec<Vec<Capsule>> = stood.iter().map(|q| self.placed(arm, q)).collect();
        let drawn: Vec<Vec<Capsule>> = (0..DRAWN).map(|k| self.placed(arm, &drawn(k))).collect();
        let overlap = |a: usize, b: usize| {
            overlapping(&stood, a, b) > 0 || overlapping(&drawn, a, b) >= NEARLY_ALL
        };
        let ignored = pairs.filter(|(a, b)| is_near(*a, *b) || overlap(*a, *b)).collect();
        self.ignored = ignored;
        self
    }

    fn placed(&self, arm: &Arm, values: &[f64]) -> Vec<Capsule> {
        let (links, flange) = (arm.link_frames(values), *arm.base_from_flange(values).iso());
        let at = |on: On| match on {
            On::Base => Isometry3::identity(),
            On::Joint(k) => links.get(k).copied().unwrap_or(flange),
            On::Flange => flange,
        };
        self.parts.iter().map(|part| part.shape.placed(&at(part.on))).collect()
    }

    /// What comes nearest, and its distance less the clearance.
    fn nearest(&self, placed: &[Capsule]) -> (f64, Option<Collision>) {
        let mut nearest = (FAR, None);
        let mut see = |apart: f64, a: usize, with: &str| {
            if apart < nearest.0 {
                nearest = (apart, Some((a, with.to_owned())));
            }
        };
        for (a, shape) in placed.iter().enumerate() {
            if self.parts[a].on != On::Base {
                for obstacle in &self.obstacles {
                    see(shape.apart_from_box(&obstacle.shape), a, &obstacle.name);
                }
            }
            for (b, other) in placed.iter().enumerate().skip(a + 1) {
                if self.parts[a].on != self.parts[b].on && !self.ignored.contains(&(a, b)) {
                    see(shape.apart_from(other), a, &self.parts[b].name);
                }
            }
        }
        let collision =
            |(a, with): (usize, String)| Collision { part: self.parts[a].name.clone(), with };
        (nearest.0 - self.clearance_m, nearest.1.map(collision))
    }

    /// The collision at these joint values.
    pub fn collision(&self, arm: &Arm, values: &[f64]) -> Option<Collision> {
        let (apart, with) = self.nearest(&self.placed(arm, values));
        with.filter(|_| apart < 0.0)
    }

    /// The first collision on the path between joint values, all joints moving from the one to the other at once.
    pub fn collision_between(&self, arm: &Arm, from: &[f64], to: &[f64]) -> Option<Collision> {
        let motion = self.most_motion(arm, from, to);
        let at =
            |t: f64| -> Vec<f64> { from.iter().zip(to).map(|(a, b)| a + (b - a) * t).collect() };
        let mut t = 0.0;
        loop {
            let (apart, with) = self.nearest(&self.placed(arm, &at(t)));
            if apart < 0.0 {
                return with;
            }
            if t >= 1.0 {
                return None;
            }
            t = (t + (apart / motion.max(f64::MIN_POSITIVE)).max(FINEST)).min(1.0);
        }
    }

    /// How far two points may come nearer on the way: no part is farther from the axis of a joint than the arm is long,
    /// with what joints slide and what the farthest link carries.
    fn most_motion(&self, arm: &Arm, from: &[f64], to: &[f64]) -> f64 {
        let size =
            |part: &Part| part.shape.from.norm().max(part.shape.to.norm()) + part.shape.radius;
        let joints = || arm.joints.iter().zip(from.iter().zip(to));
        let slides = joints().filter(|(joint, _)| joint.prismatic);
        let reach = arm.length()
            + slides.map(|(_, (a, b))| a.abs().max(b.abs())).sum::<f64>()
            + self.parts.iter().map(size).fold(0.0, f64::max);
        joints().map(|(j, (a, b))| (b - a).abs() * if j.prismatic { 1.0 } else { reach }).sum()
    }

    /// The first collision of what the flange carries on a straight path, for a robot whose arm is not known.
    pub fn collision_on_straight_path(
        &self,
        from: &Pose<Base, Flange>,
        to: &Pose<Base, Flange>,
    ) -> Option<Collision> {
        let far = from.distance_to(to) + from.angle_to(to);
        let steps = (far / STRAIGHT_STEP).ceil().max(1.0) as usize;
        let fixed_to = |on: On| self.parts.iter().filter(move |part| part.on == on);
        (0..=steps).find_map(|k| {
            let at = straight(from, to, k as f64 / steps as f64);
            fixed_to(On::Flange).find_map(|part| {
                let shape = part.shape.placed(&at);
                let collides = |apart: f64| apart < self.clearance_m;
                let obstacle =
                    self.obstacles.iter().find(|o| collides(shape.apart_from_box(&o.shape)));
                let standing = fixed_to(On::Base).find(|s| collides(shape.apart_from(&s.shape)));
                let with = obstacle.map(|o| &o.name).or(standing.map(|s| &s.name))?;
                Some(Collision { part: part.name.clone(), with: with.clone() })
            })
        })
    }
}

/// A place on the straight way, turned as much as it is shifted.
fn straight(from: &Pose<Base, Flange>, to: &Pose<Base, Flange>, share: f64) -> Isometry3<f64> {
    let turn = (from.iso().rotation.inverse() * to.iso().rotation).scaled_axis() * share;
    let at = from.translation().lerp(&to.translation(), share);
    Isometry3::from_parts(at.into(), from.iso().rotation * UnitQuaternion::new(turn))
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::{
        math::random::Random,
        model::kinematics::{DhConvention, tests::arm},
    };

    /// The arm with a rod along every link, and a box that it may collide with.
    fn robot(middle: Vector3<f64>) -> (Arm, Surroundings) {
        let arm = arm(DhConvention::Standard);
        let rod = |k: usize| {
            let (frames, values) = (arm.link_frames(&[0.0; 6]), [0.0; 6]);
            let before = if k == 0 { Isometry3::identity() } else { frames[k - 1] };
            let to = (frames[k].inverse() * before).translation.vector;
            assert!(values.len() == 6);
            let shape = Capsule { from: Vector3::zeros(), to, radius: 0.05 };
            Part { name: format!("link {}", k + 1), on: On::Joint(k), shape }
        };
        let parts = (0..6).map(rod).collect();
        let shape = Cuboid {
            middle: Isometry3::translation(middle.x, middle.y, middle.z),
            half: Vector3::repeat(0.1),
        };
        let obstacles = vec![Obstacle { name: "post".into(), shape }];
        (arm, Surroundings { parts, obstacles, clearance_m: 0.01, ignored: vec![] })
    }

    #[test]
    fn no_collision_on_the_path_is_stepped_over() {
        let mut random = Random::new(4);
        let (mut met, mut free) = (0, 0);
        for _ in 0..120 {
            let (arm, around) = robot(random.normal3() * 0.4);
            let around = around.ignoring_neighbours(
                &arm,
                &[(-3.0, 3.0); 6],
                &[vec![0.1, -1.2, 1.5, -1.0, -1.4, 0.3]],
            );
            let mut values = || -> Vec<f64> { (0..6).map(|_| random.between(-1.5, 1.5)).collect() };
            let (from, to) = (values(), values());
            let at = |t: f64| -> Vec<f64> {
                from.iter().zip(&to).map(|(a, b)| a + (b - a) * t).collect()
            };
            let tried = (0..=2000).find_map(|k| around.collision(&arm, &at(f64::from(k) / 2000.0)));
            let found = around.collision_between(&arm, &from, &to);
            // a graze between two steps of the trial may be missed by it, never by the other
            assert!(tried.is_none() || found.is_some(), "{tried:?}");
            (met, free) = if found.is_some() { (met + 1, free) } else { (met, free + 1) };
        }
        assert!(met > 20 && free > 10, "{met} {free}");
    }

    #[test]
    fn a_collision_names_both() {
        let (arm, around) = robot(Vector3::zeros());
        let around = Surroundings { parts: around.parts[..1].to_vec(), ..around };
        let collision = around.collision(&arm, &[0.0; 6]).unwrap();
        assert_eq!((&collision.part[..], &collision.with[..]), ("link 1", "post"));
    }

    #[test]
    fn what_the_flange_carries_collides_with_a_post_on_a_straight_path() {
        let ball = Capsule { from: Vector3::z() * 0.1, to: Vector3::z() * 0.2, radius: 0.02 };
        let part = Part { name: "camera".into(), on: On::Flange, shape: ball };
        let (_, around) = robot(Vector3::new(0.5, 0.0, 0.15));
        let around = Surroundings { parts: vec![part], ..around };
        let at = |x: f64, y: f64| {
            Pose::from_parts(&nalgebra::Matrix3::identity(), Vector3::new(x, y, 0.0))
        };
        let through = around.collision_on_straight_path(&at(0.0, 0.0), &at(1.0, 0.0)).unwrap();
        assert_eq!(through, Collision { part: "camera".into(), with: "post".into() });
        assert!(around.collision_on_straight_path(&at(0.0, 0.3), &at(1.0, 0.3)).is_none());
        // turned half around there is no shortest way, and still one
        let turned = at(0.0, 0.3).retract(&nalgebra::Vector6::new(
            0.0,
            0.0,
            std::f64::consts::PI,
            0.0,
            0.0,
            0.0,
        ));
        assert!(around.collision_on_straight_path(&at(0.0, 0.3), &turned).is_none());
    }
}
