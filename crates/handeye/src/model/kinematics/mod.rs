//! An arm as a chain of joints: where its flange is, and how that moves with what is wrong in it.
//!
//! Standard (J. Denavit and R. Hartenberg, 1955) and modified (J. Craig, *Introduction to Robotics*)
//! parameters, each with one more turn `β` about y. Between parallel axes `d` of the one joint and
//! of the next do the same, and the axes' being not quite parallel is not in the parameters at all;
//! there `β` stands for `d` (S. Hayati and M. Mirmirani, *Improving the absolute positioning
//! accuracy of robot manipulators*, J. Robotic Systems 2, 1985):
//!
//! ```text
//! standard  Rz(θ) Tz(d) Tx(a) Rx(α) Ry(β)        modified  Tx(a) Rx(α) Ry(β) Rz(θ) Tz(d)
//! ```

mod axes;
mod inverse;

pub use axes::Axis;

use nalgebra::{DMatrix, Isometry3, Translation3, UnitQuaternion, Vector3, Vector6};
use serde::{Deserialize, Serialize};

use crate::{
    Base, Error, Flange, Pose,
    frame::{FirstJoint, LastLink},
    math::lie,
    model::residual::Residual,
};

/// Which of a link's transforms comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum DhConvention {
    /// The joint, then the link.
    Standard,
    /// The link, then the joint.
    Modified,
}

/// One joint and its link, in metres and radians.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Joint {
    /// Length of the link along x.
    pub a: f64,
    /// Turn of the link about x.
    pub alpha: f64,
    /// Offset along the joint's axis.
    pub d: f64,
    /// What is added to the joint's value.
    pub theta_offset: f64,
    /// Turn of the link about y; zero in most models.
    pub beta: f64,
    /// Whether the joint slides along z, and adds to `d`, instead of turning.
    pub prismatic: bool,
}

/// A chain of joints from the base to the flange.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Arm {
    /// How the parameters are meant.
    pub convention: DhConvention,
    /// From the base outwards.
    pub joints: Vec<Joint>,
    /// Where the first joint's frame is; in the base itself, in most models.
    #[serde(default = "Pose::identity", skip_serializing_if = "is_nothing")]
    pub base_from_first_joint: Pose<Base, FirstJoint>,
    /// Where the flange is behind the last joint; the last link itself, in most models.
    #[serde(default = "Pose::identity", skip_serializing_if = "is_nothing")]
    pub last_link_from_flange: Pose<LastLink, Flange>,
}

fn is_nothing<A, B>(pose: &Pose<A, B>) -> bool {
    *pose.iso() == Isometry3::identity()
}

/// Which parameter of a joint deviates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Parameter {
    /// The joint's zero.
    ThetaOffset,
    /// Length along the axis.
    D,
    /// Length of the link.
    A,
    /// Turn of the link about x.
    Alpha,
    /// Turn of the link about y.
    Beta,
}

impl Parameter {
    /// Whether it is an angle.
    pub fn is_angle(self) -> bool {
        !matches!(self, Parameter::D | Parameter::A)
    }

    /// Its twist where it acts.
    fn twist(self) -> Vector6<f64> {
        let (zero, x, y, z) = (Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z());
        match self {
            Parameter::ThetaOffset => lie::tangent(&z, &zero),
            Parameter::D => lie::tangent(&zero, &z),
            Parameter::A => lie::tangent(&zero, &x),
            Parameter::Alpha => lie::tangent(&x, &zero),
            Parameter::Beta => lie::tangent(&y, &zero),
        }
    }
}

/// A parameter of one joint that may deviate from the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Deviation {
    /// The joint's number; the first one is 0.
    pub joint: usize,
    /// Which of its parameters.
    pub parameter: Parameter,
}

/// Most joints of an arm.
pub const MOST_JOINTS: usize = 32;
/// A flange that is farther from where the model puts it belongs to other joint values, or to another arm.
pub const CONSISTENT: Residual = Residual { angle: 0.03, distance: 20e-3 };
/// Axes that differ less in direction count as parallel, rad.
const PARALLEL: f64 = 0.1;

impl Joint {
    fn turn(&self, value: f64) -> Isometry3<f64> {
        let (turn, slide) = if self.prismatic { (0.0, value) } else { (value, 0.0) };
        about(Vector3::z(), self.d + slide, self.theta_offset + turn)
    }

    fn link(&self) -> Isometry3<f64> {
        about(Vector3::x(), self.a, self.alpha) * about(Vector3::y(), 0.0, self.beta)
    }

    fn parameter(&mut self, which: Parameter) -> &mut f64 {
        match which {
            Parameter::ThetaOffset => &mut self.theta_offset,
            Parameter::D => &mut self.d,
            Parameter::A => &mut self.a,
            Parameter::Alpha => &mut self.alpha,
            Parameter::Beta => &mut self.beta,
        }
    }

    /// Whether the axes on both sides of the link are parallel.
    fn keeps_direction(&self) -> bool {
        self.alpha.sin().abs() < PARALLEL && self.beta.sin().abs() < PARALLEL
    }
}

fn about(axis: Vector3<f64>, along: f64, angle: f64) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::from(axis * along), UnitQuaternion::new(axis * angle))
}

impl Arm {
    /// An arm whose joints begin in the base and end in the flange.
    pub fn new(convention: DhConvention, joints: Vec<Joint>) -> Arm {
        Arm {
            convention,
            joints,
            base_from_first_joint: Pose::identity(),
            last_link_from_flange: Pose::identity(),
        }
    }

    /// # Errors
    /// [`Error::Invalid`] without joints, with more than [`MOST_JOINTS`], or with a parameter that
    /// is not finite.
    pub fn check(&self) -> Result<(), Error> {
        let finite =
            |j: &Joint| [j.a, j.alpha, j.d, j.theta_offset, j.beta].iter().all(|x| x.is_finite());
        if self.joints.is_empty() || self.joints.len() > MOST_JOINTS {
            return Err(Error::Invalid(format!(
                "an arm has 1 to {MOST_JOINTS} joints, not {}",
                self.joints.len()
            )));
        }
        match self.joints.iter().position(|j| !finite(j)) {
            Some(k) => Err(Error::Invalid(format!(
                "a parameter of joint {} is not a finite number",
                k + 1
            ))),
            None => Ok(()),
        }
    }

    /// Where the flange is for joint values in rad, or m for those that slide; values beyond the
    /// last joint are not looked at, missing ones count as zero.
    pub fn base_from_flange(&self, values: &[f64]) -> Pose<Base, Flange> {
        let steps =
            self.joints.iter().zip(padded(values)).map(|(joint, value)| match self.convention {
                DhConvention::Standard => joint.turn(value) * joint.link(),
                DhConvention::Modified => joint.link() * joint.turn(value),
            });
        let first_from_last = steps.fold(Isometry3::identity(), |chain, step| chain * step);
        let first_from_last = Pose::<FirstJoint, LastLink>::claim(first_from_last);
        self.base_from_first_joint * first_from_last * self.last_link_from_flange
    }

    /// How the flange moves with each of these parameters: a column each, rotation first, perturbed
    /// on the right (in the flange).
    pub fn by_deviations(&self, values: &[f64], which: &[Deviation]) -> DMatrix<f64> {
        let places = self.places(values);
        let base_from_flange = *self.base_from_flange(values).iso();
        let mut all = DMatrix::zeros(6, which.len());
        for (k, deviation) in which.iter().enumerate() {
            let Some(place) = places.get(deviation.joint) else { continue };
            let here = place.of(deviation.parameter);
            let flange_from_here = base_from_flange.inverse() * here;
            let column = lie::adjoint(&flange_from_here) * deviation.parameter.twist();
            all.column_mut(k).copy_from(&column);
        }
        all
    }

    /// How the flange moves with the joints' values, as [`Self::by_deviations`].
    pub(crate) fn by_joints(&self, values: &[f64]) -> DMatrix<f64> {
        let motion = |(joint, j): (usize, &Joint)| Deviation {
            joint,
            parameter: if j.prismatic { Parameter::D } else { Parameter::ThetaOffset },
        };
        let all: Vec<Deviation> = self.joints.iter().enumerate().map(motion).collect();
        self.by_deviations(values, &all)
    }

    /// Frames in the base in which the parameters of each joint act.
    fn places(&self, values: &[f64]) -> Vec<Place> {
        self.places_and_flange(values).0
    }

    /// The same, and where the flange is.
    fn places_and_flange(&self, values: &[f64]) -> (Vec<Place>, Pose<Base, Flange>) {
        let mut chain = *self.base_from_first_joint.iso();
        let mut all = Vec::with_capacity(self.joints.len());
        for (joint, value) in self.joints.iter().zip(padded(values)) {
            let (turn, link) = (joint.turn(value), joint.link());
            let place = match self.convention {
                DhConvention::Standard => {
                    Place { turning: chain, linking: chain * turn, linked: chain * turn * link }
                }
                DhConvention::Modified => {
                    Place { turning: chain * link, linking: chain, linked: chain * link }
                }
            };
            chain = match self.convention {
                DhConvention::Standard => place.linked,
                DhConvention::Modified => place.turning * turn,
            };
            all.push(place);
        }
        let base_from_last_link = Pose::<Base, LastLink>::claim(chain);
        (all, base_from_last_link * self.last_link_from_flange)
    }

    /// Frames in the base that move with each joint, for joint values: where the next joint begins.
    pub fn link_frames(&self, values: &[f64]) -> Vec<Isometry3<f64>> {
        let frame = |(place, (joint, value)): (Place, (&Joint, f64))| match self.convention {
            DhConvention::Standard => place.linked,
            DhConvention::Modified => place.turning * joint.turn(value),
        };
        let values = self.joints.iter().zip(padded(values));
        self.places(&values.clone().map(|(_, value)| value).collect::<Vec<_>>())
            .into_iter()
            .zip(values)
            .map(frame)
            .collect()
    }

    /// The flange is no further from the base than this and what joints slide, m.
    pub fn length(&self) -> f64 {
        let ends = [
            self.base_from_first_joint.translation().norm(),
            self.last_link_from_flange.translation().norm(),
        ];
        let links = self.joints.iter().map(|j| j.a.abs() + j.d.abs());
        ends.into_iter().chain(links).sum()
    }

    /// Frames in the base where all joint values are zero: each joint turns about, or slides along, the z axis of its own.
    pub fn joint_frames(&self) -> Vec<Isometry3<f64>> {
        self.places(&[]).iter().map(|place| place.turning).collect()
    }

    /// Points of the base along the links for joint values, from the base to the flange: along each axis, then
    /// along the link to the next one.
    pub fn along_links(&self, values: &[f64]) -> Vec<Vector3<f64>> {
        let mut all = vec![Vector3::zeros()];
        for place in self.places(values) {
            all.extend(
                match self.convention {
                    DhConvention::Standard => [&place.turning, &place.linking, &place.linked],
                    DhConvention::Modified => [&place.linking, &place.linked, &place.turning],
                }
                .map(|frame| frame.translation.vector),
            );
        }
        all.push(self.base_from_flange(values).translation());
        all
    }

    /// The same arm with these parameters larger by these values.
    pub fn moved(&self, which: &[Deviation], by: &[f64]) -> Arm {
        let mut arm = self.clone();
        for (deviation, by) in which.iter().zip(by) {
            if let Some(joint) = arm.joints.get_mut(deviation.joint) {
                *joint.parameter(deviation.parameter) += by;
            }
        }
        arm
    }

    /// Zeros of the joints that are not the same as turning the base or the flange.
    pub(crate) fn offsets(&self) -> Vec<Deviation> {
        let of = |joint| Deviation { joint, parameter: Parameter::ThetaOffset };
        let inner = 1..self.joints.len().saturating_sub(1);
        inner.filter(|&j| !self.joints[j].prismatic).map(of).collect()
    }

    /// All that may be wrong with the links and is not the same as another place of the base or the
    /// flange.
    pub fn deviations(&self) -> Vec<Deviation> {
        let last = self.joints.len().saturating_sub(1);
        let mut all = vec![];
        for (joint, j) in self.joints.iter().enumerate() {
            let linked = match self.convention {
                DhConvention::Standard => joint < last,
                DhConvention::Modified => joint > 0,
            };
            let mut add = |wanted: bool, parameter| {
                if wanted {
                    all.push(Deviation { joint, parameter });
                }
            };
            add(joint > 0 && joint < last && !j.prismatic, Parameter::ThetaOffset);
            add(self.slides(joint), Parameter::D);
            add(linked && j.keeps_direction(), Parameter::Beta);
            add(linked, Parameter::A);
            add(linked, Parameter::Alpha);
        }
        all
    }

    /// Whether the next axis outwards is parallel to this one.
    fn parallel_to_next(&self, joint: usize) -> bool {
        let link = match self.convention {
            DhConvention::Standard => joint,
            DhConvention::Modified => joint + 1,
        };
        joint + 1 < self.joints.len() && self.joints[link].keeps_direction()
    }

    /// Whether a length along this axis is one of its own: among parallel axes only the last one's
    /// is, and none where base or flange could move along them.
    fn slides(&self, joint: usize) -> bool {
        let mut first = joint;
        while first > 0 && self.parallel_to_next(first - 1) {
            first -= 1;
        }
        first > 0 && joint + 1 < self.joints.len() && !self.parallel_to_next(joint)
    }
}

/// The frames in which the parameters of one joint act.
struct Place {
    turning: Isometry3<f64>,
    linking: Isometry3<f64>,
    linked: Isometry3<f64>,
}

impl Place {
    fn of(&self, parameter: Parameter) -> Isometry3<f64> {
        match parameter {
            Parameter::ThetaOffset | Parameter::D => self.turning,
            Parameter::A | Parameter::Alpha => self.linking,
            Parameter::Beta => self.linked,
        }
    }
}

fn padded(values: &[f64]) -> impl Iterator<Item = f64> + Clone {
    values.iter().copied().chain(std::iter::repeat(0.0))
}

#[cfg(test)]
pub(crate) mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::math::random::Random;

    /// An arm of the usual build: shoulder, elbow, and a wrist whose axes do not meet.
    pub(crate) fn arm(convention: DhConvention) -> Arm {
        let mut links = vec![
            (0.0, FRAC_PI_2),
            (-0.425, 0.0),
            (-0.39, 0.0),
            (0.0, FRAC_PI_2),
            (0.02, -FRAC_PI_2),
            (0.0, 0.0),
        ];
        if convention == DhConvention::Modified {
            links.rotate_right(1);
        }
        let along = [0.15, 0.0, 0.01, 0.13, 0.1, 0.09];
        let joint = |((a, alpha), d)| Joint { a, alpha, d, ..Joint::default() };
        Arm::new(convention, links.into_iter().zip(along).map(joint).collect())
    }

    fn values(random: &mut Random) -> Vec<f64> {
        (0..6).map(|_| random.between(-2.0, 2.0)).collect()
    }

    #[test]
    fn derivatives_match_central_differences() {
        let mut random = Random::new(1);
        for convention in [DhConvention::Standard, DhConvention::Modified] {
            let mut arm = arm(convention);
            arm.joints[2].beta = 0.2;
            arm.base_from_first_joint = Pose::claim(about(Vector3::x(), 0.3, 0.7));
            arm.last_link_from_flange = Pose::claim(about(Vector3::y(), 0.1, -0.4));
            let all: Vec<Deviation> = (0..6)
                .flat_map(|joint| {
                    use Parameter::*;
                    [ThetaOffset, D, A, Alpha, Beta].map(|parameter| Deviation { joint, parameter })
                })
                .collect();
            let q = values(&mut random);
            let j = arm.by_deviations(&q, &all);
            let at = |k: usize, by: f64| arm.moved(&all[k..=k], &[by]).base_from_flange(&q);
            for k in 0..all.len() {
                let numeric = at(k, -1e-6).local(&at(k, 1e-6)) / 2e-6;
                assert!((j.column(k) - numeric).norm() < 1e-7, "{:?} {convention:?}", all[k]);
            }
        }
    }

    #[test]
    fn no_deviation_is_the_same_as_another_place_of_base_or_flange() {
        // flange moves by J κ, and by Ad(flange⁻¹) b + f for moved base and flange
        for convention in [DhConvention::Standard, DhConvention::Modified] {
            let (arm, mut random) = (arm(convention), Random::new(2));
            let which = arm.deviations();
            let n = which.len() + 12;
            let mut information = DMatrix::zeros(n, n);
            for _ in 0..60 {
                let q = values(&mut random);
                let flange = arm.base_from_flange(&q);
                let mut j = DMatrix::zeros(6, n);
                j.columns_mut(0, n - 12).copy_from(&arm.by_deviations(&q, &which));
                j.view_mut((0, n - 12), (6, 6)).copy_from(&lie::adjoint(flange.inverse().iso()));
                j.view_mut((0, n - 6), (6, 6)).fill_with_identity();
                information += j.transpose() * j;
            }
            let eigen = information.symmetric_eigen().eigenvalues;
            assert!(eigen.min() > 1e-5 * eigen.max(), "{convention:?} {eigen}");
            assert_eq!(which.len(), 18, "{which:?}");
        }
    }

    #[test]
    fn links_lead_from_the_base_to_the_flange_in_steps_along_axes_and_links() {
        for convention in [DhConvention::Standard, DhConvention::Modified] {
            let (arm, q) = (arm(convention), values(&mut Random::new(3)));
            let path = arm.along_links(&q);
            let flange = arm.base_from_flange(&q).translation();
            assert!(path[0].norm() < 1e-12 && (path[path.len() - 1] - flange).norm() < 1e-12);
            let long: f64 = path.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
            let parts: f64 = arm.joints.iter().map(|j| j.a.abs() + j.d.abs()).sum();
            assert!((long - parts).abs() < 1e-9, "{convention:?} {long} {parts}");
        }
    }

    #[test]
    fn an_arm_of_nonsense_is_refused() {
        let none = Arm::new(DhConvention::Standard, vec![]);
        assert!(none.check().unwrap_err().to_string().contains("1 to 32 joints, not 0"));
        let mut broken = arm(DhConvention::Standard);
        broken.joints[3].a = f64::NAN;
        assert!(broken.check().unwrap_err().to_string().contains("joint 4"));
    }
}
