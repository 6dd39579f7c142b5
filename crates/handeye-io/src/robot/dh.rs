//! The flange's pose from joint values, by Denavit-Hartenberg parameters.
//!
//! What the parameters mean is told in [`handeye::model::kinematics`].

use std::path::Path;

use handeye::{
    Base, FirstJoint, Flange, Frame, LastLink, Pose,
    model::kinematics::{Arm, DhConvention, Joint},
};
use serde::{Deserialize, Serialize, de::IgnoredAny};

use crate::{
    error::{Error, Place, malformed},
    files,
    robot::Urdf,
    table::Record,
    units::{AngleUnit, LengthUnit},
};

/// Denavit-Hartenberg parameters as a manifest or a JSON file holds them.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct DhSpec {
    /// Which of the two conventions the parameters follow.
    #[serde(alias = "dh_convention")]
    convention: DhConvention,
    /// Unit of a and d.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    length_unit: Option<LengthUnit>,
    /// Unit of alpha, theta_offset and beta.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    angle_unit: Option<AngleUnit>,
    /// The units, in place of length_unit and angle_unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    units: Option<DhUnits>,
    /// The joints, from the base outwards.
    #[cfg_attr(test, schemars(length(min = 1)))]
    joints: Vec<DhJoint>,
    /// Pose of the first joint's frame in the base; by default the base itself.
    #[serde(default = "Pose::<Base, FirstJoint>::identity", skip_serializing_if = "is_identity")]
    base_from_first_joint: Pose<Base, FirstJoint>,
    /// Pose of the flange in the last link's frame; by default that frame itself.
    #[serde(default = "Pose::<LastLink, Flange>::identity", skip_serializing_if = "is_identity")]
    last_link_from_flange: Pose<LastLink, Flange>,
    #[serde(default, rename = "robot_name", skip_serializing)]
    #[cfg_attr(test, schemars(with = "String"))]
    _robot_name: IgnoredAny,
    #[serde(default, rename = "manufacturer", skip_serializing)]
    #[cfg_attr(test, schemars(with = "String"))]
    _manufacturer: IgnoredAny,
    #[serde(default, rename = "degrees_of_freedom", skip_serializing)]
    #[cfg_attr(test, schemars(with = "u32"))]
    _degrees_of_freedom: IgnoredAny,
    #[serde(default, rename = "joint_order", skip_serializing)]
    #[cfg_attr(test, schemars(with = "Vec<String>"))]
    _joint_order: IgnoredAny,
}

/// The units of Denavit-Hartenberg parameters.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct DhUnits {
    length: LengthUnit,
    angle: AngleUnit,
}

/// The parameters of one joint.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct DhJoint {
    a: f64,
    alpha: f64,
    d: f64,
    /// What is added to the joint's value.
    #[serde(default, alias = "theta", alias = "offset")]
    theta_offset: f64,
    /// Rotation about y, of Hayati's parameters for parallel axes.
    #[serde(default)]
    beta: f64,
    /// Whether the joint is prismatic.
    #[serde(default)]
    prismatic: bool,
    #[serde(default, rename = "joint_id", alias = "name", skip_serializing)]
    #[cfg_attr(test, schemars(with = "String"))]
    _name: IgnoredAny,
}

fn is_identity<A: Frame, B: Frame>(pose: &Pose<A, B>) -> bool {
    *pose == Pose::identity()
}

/// An arm, how its joints are called where they have names, and the unit of the values of those that slide.
#[derive(Debug, Clone)]
pub(crate) struct ArmModel {
    pub(crate) arm: Arm,
    names: Vec<String>,
    length: LengthUnit,
}

impl ArmModel {
    /// The arm of a URDF: its joints slide in metres.
    pub(crate) fn of_urdf(urdf: &Urdf) -> ArmModel {
        ArmModel {
            arm: urdf.arm().clone(),
            names: urdf.joint_names().to_vec(),
            length: LengthUnit::Metre,
        }
    }

    /// Reads a JSON file of Denavit-Hartenberg parameters.
    pub(crate) fn read(path: &Path) -> Result<ArmModel, Error> {
        let text = files::text(path)?;
        let spec: DhSpec = serde_json::from_str(&text).map_err(|e| {
            let place = Place::line(path, e.line());
            malformed(place, format!("is no Denavit-Hartenberg model: {e}"), "correct the file")
        })?;
        Self::from_spec(&spec, &Place::file(path))
    }

    /// Converts to metres and radians; the units must be said.
    pub(crate) fn from_spec(spec: &DhSpec, place: &Place) -> Result<ArmModel, Error> {
        let missing = |key: &str, question: &str| Error::Undeclared {
            place: place.clone(),
            key: key.into(),
            question: question.into(),
        };
        let units = spec.units.as_ref();
        let length = spec.length_unit.or(units.map(|u| u.length)).ok_or_else(|| {
            missing("length_unit", "are a and d of the joints in \"m\" or in \"mm\"?")
        })?;
        let angle = spec.angle_unit.or(units.map(|u| u.angle)).ok_or_else(|| {
            missing("angle_unit", "are alpha and theta of the joints in \"rad\" or in \"deg\"?")
        })?;
        let joints = spec.joints.iter().map(|j| j.in_si(length, angle)).collect();
        let arm = Arm {
            base_from_first_joint: spec.base_from_first_joint,
            last_link_from_flange: spec.last_link_from_flange,
            ..Arm::new(spec.convention, joints)
        };
        arm.check().map_err(|source| Error::Values { place: place.clone(), source })?;
        Ok(ArmModel { arm, names: vec![], length })
    }

    /// Joint values in rad, and m for those that slide, from the given unit of angle.
    pub(crate) fn in_si(&self, values: &[f64], unit: AngleUnit) -> Vec<f64> {
        let si = |(joint, value): (&Joint, &f64)| {
            if joint.prismatic { self.length.to_metres(*value) } else { unit.to_radians(*value) }
        };
        self.arm.joints.iter().zip(values).map(si).collect()
    }

    /// Where the flange is for these joint values, in the given unit of angle.
    pub(crate) fn base_from_flange(&self, values: &[f64], unit: AngleUnit) -> Pose<Base, Flange> {
        self.arm.base_from_flange(&self.in_si(values, unit))
    }

    /// The joint values of a record: in order, by the model's names, or by names that end in the joint's number.
    pub(crate) fn values(&self, record: &Record) -> Result<Vec<f64>, Error> {
        let numbered: Vec<Vec<String>> = (1..=self.arm.joints.len()).map(joint_names).collect();
        let own: Vec<Vec<String>> = self.names.iter().map(|name| vec![name.clone()]).collect();
        if record.names.is_empty() {
            let columns: Vec<&'static [&'static str]> = vec![&["a joint"]; numbered.len()];
            return record.numbers(&columns, "the robot");
        }
        // a model that counts from another number than the file would give a joint the value of its neighbour
        let by_own = self.names.iter().any(|name| record.number_named(&[name]).is_some());
        let names = if by_own { own } else { numbered };
        let value = |n: &Vec<String>| match record
            .number_named(&n.iter().map(String::as_str).collect::<Vec<_>>())
        {
            Some(x) if x.is_finite() => Ok(x),
            Some(x) => {
                Err(record.refuse(format!("{x} is not a finite number"), "exclude the capture"))
            }
            None => Err(record.refuse(
                format!(
                    "there is no joint named {}; the names are {}",
                    n[0],
                    record.names.join(", ")
                ),
                "say which columns = [..] hold the joints, from the base outwards",
            )),
        };
        names.iter().map(value).collect()
    }
}

fn joint_names(n: usize) -> Vec<String> {
    ["joint_", "j", "q", "a", "axis_", "theta_"].iter().map(|p| format!("{p}{n}")).collect()
}

impl DhJoint {
    fn of(joint: &Joint) -> Self {
        let Joint { a, alpha, d, theta_offset, beta, prismatic } = *joint;
        Self { a, alpha, d, theta_offset, beta, prismatic, _name: IgnoredAny }
    }

    fn in_si(&self, length: LengthUnit, angle: AngleUnit) -> Joint {
        Joint {
            a: length.to_metres(self.a),
            d: length.to_metres(self.d),
            alpha: angle.to_radians(self.alpha),
            theta_offset: angle.to_radians(self.theta_offset),
            beta: angle.to_radians(self.beta),
            prismatic: self.prismatic,
        }
    }
}

/// An arm as a file that `dh = "..."` of a manifest reads: metres and radians.
pub fn arm_file(arm: &Arm) -> String {
    let spec = DhSpec {
        convention: arm.convention,
        length_unit: Some(LengthUnit::Metre),
        angle_unit: Some(AngleUnit::Radian),
        units: None,
        joints: arm.joints.iter().map(DhJoint::of).collect(),
        base_from_first_joint: arm.base_from_first_joint,
        last_link_from_flange: arm.last_link_from_flange,
        _robot_name: IgnoredAny,
        _manufacturer: IgnoredAny,
        _degrees_of_freedom: IgnoredAny,
        _joint_order: IgnoredAny,
    };
    // numbers and short names: this cannot fail
    serde_json::to_string_pretty(&spec).unwrap_or_default() + "\n"
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Vector3};

    use super::*;

    fn model(convention: &str) -> ArmModel {
        let text = format!(
            r#"{{"convention": "{convention}", "units": {{"length": "mm", "angle": "deg"}},
                "joints": [{{"a": 0, "alpha": 90, "d": 100}}, {{"a": 200, "alpha": 0, "d": 0}}]}}"#
        );
        ArmModel::from_spec(&serde_json::from_str(&text).unwrap(), &Place::default()).unwrap()
    }

    #[test]
    fn a_two_joint_arm_reaches_where_a_ruler_says() {
        let pose = model("standard").base_from_flange(&[90.0, 0.0], AngleUnit::Degree);
        assert!((pose.translation() - Vector3::new(0.0, 0.2, 0.1)).norm() < 1e-15);
        let up = model("standard").base_from_flange(&[0.0, 90.0], AngleUnit::Degree);
        assert!((up.translation() - Vector3::new(0.0, 0.0, 0.3)).norm() < 1e-15);
    }

    #[test]
    fn an_arm_that_was_written_is_read_again() {
        let joint = |k: f64| Joint {
            a: 0.1 * k,
            alpha: 0.2,
            d: -0.3,
            theta_offset: k,
            beta: 1e-3,
            prismatic: k > 1.5,
        };
        let convention = DhConvention::Modified;
        let mut arm = Arm::new(convention, vec![joint(1.0), joint(2.0)]);
        arm.base_from_first_joint = Pose::claim(Isometry3::translation(0.1, 0.2, 0.3));
        arm.last_link_from_flange = Pose::claim(Isometry3::rotation(Vector3::z()));
        let spec: DhSpec = serde_json::from_str(&arm_file(&arm)).unwrap();
        assert_eq!(ArmModel::from_spec(&spec, &Place::default()).unwrap().arm, arm);
    }

    #[test]
    fn modified_parameters_turn_before_the_joint() {
        let pose = model("modified").base_from_flange(&[0.0, 0.0], AngleUnit::Degree);
        assert!((pose.translation() - Vector3::new(0.2, -0.1, 0.0)).norm() < 1e-15);
    }
}
