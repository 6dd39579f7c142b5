//! The flange's pose from joint values, by Denavit-Hartenberg parameters.
//!
//! Standard: each joint is `Rz(θ) Tz(d) Tx(a) Rx(α)` (J. Denavit and R. Hartenberg, 1955);
//! modified: `Rx(α) Tx(a) Rz(θ) Tz(d)` (J. Craig, Introduction to Robotics). `θ` is the joint's
//! value plus its offset; a prismatic joint's value adds to `d`.

use std::path::Path;

use handeye::{Base, Flange, Pose};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use serde::{Deserialize, de::IgnoredAny};

use crate::{
    error::{Error, Place, malformed},
    files,
    table::Record,
    units::{AngleUnit, LengthUnit},
};

/// Denavit-Hartenberg parameters as a manifest or a JSON file holds them.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DhSpec {
    #[serde(alias = "dh_convention")]
    convention: Convention,
    #[serde(default)]
    length_unit: Option<LengthUnit>,
    #[serde(default)]
    angle_unit: Option<AngleUnit>,
    #[serde(default)]
    units: Option<DhUnits>,
    joints: Vec<DhJoint>,
    #[serde(default, rename = "robot_name")]
    _robot_name: IgnoredAny,
    #[serde(default, rename = "manufacturer")]
    _manufacturer: IgnoredAny,
    #[serde(default, rename = "degrees_of_freedom")]
    _degrees_of_freedom: IgnoredAny,
    #[serde(default, rename = "joint_order")]
    _joint_order: IgnoredAny,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct DhUnits {
    length: LengthUnit,
    angle: AngleUnit,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Convention {
    Standard,
    Modified,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct DhJoint {
    a: f64,
    alpha: f64,
    d: f64,
    #[serde(default, alias = "theta", alias = "offset")]
    theta_offset: f64,
    #[serde(default)]
    prismatic: bool,
    #[serde(default, rename = "joint_id", alias = "name")]
    _name: IgnoredAny,
}

/// Most joints a robot may have.
const MOST_JOINTS: usize = 32;

/// A chain of joints, in metres and radians.
#[derive(Debug, Clone)]
pub(crate) struct DhModel {
    convention: Convention,
    joints: Vec<DhJoint>,
    length: LengthUnit,
}

impl DhModel {
    /// Reads a JSON file of parameters.
    pub(crate) fn read(path: &Path) -> Result<DhModel, Error> {
        let text = files::text(path)?;
        let spec: DhSpec = serde_json::from_str(&text).map_err(|e| {
            let place = Place::line(path, e.line());
            malformed(place, format!("is no Denavit-Hartenberg model: {e}"), "correct the file")
        })?;
        Self::from_spec(&spec, &Place::file(path))
    }

    /// Converts to metres and radians; the units must be said.
    pub(crate) fn from_spec(spec: &DhSpec, place: &Place) -> Result<DhModel, Error> {
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
        let joints: Vec<DhJoint> = spec.joints.iter().map(|j| j.in_si(length, angle)).collect();
        let finite =
            |j: &DhJoint| [j.a, j.alpha, j.d, j.theta_offset].iter().all(|x| x.is_finite());
        if joints.is_empty() || joints.len() > MOST_JOINTS || !joints.iter().all(finite) {
            let what = format!("{} joints, or a value that is not finite", joints.len());
            return Err(malformed(place.clone(), what, "give the parameters of every joint"));
        }
        Ok(DhModel { convention: spec.convention, joints, length })
    }

    /// Where the flange is for these joint values, in the given unit of angle.
    pub(crate) fn base_from_flange(&self, values: &[f64], unit: AngleUnit) -> Pose<Base, Flange> {
        let steps = self.joints.iter().zip(values).map(|(joint, value)| {
            let value = if joint.prismatic {
                self.length.to_metres(*value)
            } else {
                unit.to_radians(*value)
            };
            joint.step(self.convention, value)
        });
        Pose::claim(steps.fold(Isometry3::identity(), |chain, step| chain * step))
    }

    /// The joint values of a record: in order, or by names that end in the joint's number.
    pub(crate) fn values(&self, record: &Record) -> Result<Vec<f64>, Error> {
        let names: Vec<Vec<String>> = (1..=self.joints.len()).map(joint_names).collect();
        let names: Vec<Vec<&str>> =
            names.iter().map(|n| n.iter().map(String::as_str).collect()).collect();
        let columns: Vec<&'static [&'static str]> = vec![&["a joint"]; names.len()];
        if record.names.is_empty() {
            return record.numbers(&columns, "the robot");
        }
        let value = |n: &Vec<&str>| match record.number_named(n) {
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
    fn in_si(&self, length: LengthUnit, angle: AngleUnit) -> DhJoint {
        DhJoint {
            a: length.to_metres(self.a),
            d: length.to_metres(self.d),
            alpha: angle.to_radians(self.alpha),
            theta_offset: angle.to_radians(self.theta_offset),
            ..self.clone()
        }
    }

    fn step(&self, convention: Convention, value: f64) -> Isometry3<f64> {
        let (turn, slide) = if self.prismatic { (0.0, value) } else { (value, 0.0) };
        let about = |axis: Vector3<f64>, along: f64, angle: f64| {
            Isometry3::from_parts(
                Translation3::from(axis * along),
                UnitQuaternion::new(axis * angle),
            )
        };
        let joint = about(Vector3::z(), self.d + slide, self.theta_offset + turn);
        let link = about(Vector3::x(), self.a, self.alpha);
        match convention {
            Convention::Standard => joint * link,
            Convention::Modified => link * joint,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn model(convention: &str) -> DhModel {
        let text = format!(
            r#"{{"convention": "{convention}", "units": {{"length": "mm", "angle": "deg"}},
                "joints": [{{"a": 0, "alpha": 90, "d": 100}}, {{"a": 200, "alpha": 0, "d": 0}}]}}"#
        );
        DhModel::from_spec(&serde_json::from_str(&text).unwrap(), &Place::default()).unwrap()
    }

    #[test]
    fn a_two_joint_arm_reaches_where_a_ruler_says() {
        let pose = model("standard").base_from_flange(&[90.0, 0.0], AngleUnit::Degree);
        assert!((pose.translation() - Vector3::new(0.0, 0.2, 0.1)).norm() < 1e-15);
        let up = model("standard").base_from_flange(&[0.0, 90.0], AngleUnit::Degree);
        assert!((up.translation() - Vector3::new(0.0, 0.0, 0.3)).norm() < 1e-15);
    }

    #[test]
    fn modified_parameters_turn_before_the_joint() {
        let pose = model("modified").base_from_flange(&[0.0, 0.0], AngleUnit::Degree);
        assert!((pose.translation() - Vector3::new(0.2, -0.1, 0.0)).norm() < 1e-15);
    }
}
