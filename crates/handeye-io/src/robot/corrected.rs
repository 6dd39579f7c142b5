//! A corrected arm in the words of the file it came from: a URDF in which the origins of joints are others, and the
//! `kinematics` that Universal Robots' description package reads.
//!
//! With all joint values zero let `D_i` be the frame of joint `i` in the Denavit-Hartenberg chain, `U_i` that of the URDF,
//! both in the base. `S_i = D_i⁻¹ U_i` only turns about and slides along the joint's axis and where it begins: it stays
//! when the chain is corrected to `D'_i`. With `U'_i = D'_i S_i` the arm is the product of the motions about the corrected
//! axes again, and the joint's origin `O_i` in its parent becomes
//!
//! ```text
//! O'_i = O_i (U_(i-1)⁻¹ U_i)⁻¹ (U'_(i-1)⁻¹ U'_i)
//! ```
//!
//! The base, the first joint and what is behind the last one stay as they are: their errors are those of camera and tool.

use std::fmt::Write;

use handeye::model::kinematics::Arm;
use nalgebra::Isometry3;
use roxmltree::{Document, Node, ParsingOptions};

use super::Urdf;
use crate::hash::Hash;

/// Origins of the joints in their parents, in order; `None` where the arm is another one.
fn origins(urdf: &Urdf, corrected: &Arm) -> Option<Vec<Isometry3<f64>>> {
    let (given, now) = (urdf.arm().joint_frames(), corrected.joint_frames());
    if now.len() != urdf.origins().len() || corrected.convention != urdf.arm().convention {
        return None;
    }
    let frames = given.iter().zip(&now).zip(urdf.origins());
    let moved: Vec<Isometry3<f64>> =
        frames.map(|((d, now), o)| now * d.inverse() * o.base_from_joint).collect();
    let mut all: Vec<Isometry3<f64>> = vec![];
    for (i, origin) in urdf.origins().iter().enumerate() {
        let step = |u: &dyn Fn(usize) -> Isometry3<f64>| match i {
            0 => u(0),
            i => u(i - 1).inverse() * u(i),
        };
        let given = step(&|k| urdf.origins()[k].base_from_joint);
        all.push(origin.parent_from_joint * given.inverse() * step(&|k| moved[k]));
    }
    Some(all)
}

/// The URDF of the corrected arm: names, links and all else as they were. `None` where the arm is another one.
pub(crate) fn urdf(given: &Urdf, corrected: &Arm) -> Option<String> {
    let origins = origins(given, corrected)?;
    let text = given.text();
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).ok()?;
    let is_joint = |n: &Node| n.has_tag_name("joint");
    let mut pieces: Vec<(std::ops::Range<usize>, String)> = vec![];
    for (name, origin) in given.joint_names().iter().zip(&origins) {
        let mut joints = document.root_element().children().filter(is_joint);
        let joint = joints.find(|n| n.attribute("name") == Some(name))?;
        let (x, r) = (origin.translation.vector, origin.rotation.euler_angles());
        let element = format!(
            "<origin xyz=\"{:?} {:?} {:?}\" rpy=\"{:?} {:?} {:?}\"/>",
            x.x, x.y, x.z, r.0, r.1, r.2
        );
        let own = joint.children().find(|c| c.has_tag_name("origin"));
        let place = match own {
            Some(own) => own.range(),
            None => {
                let first = joint.first_child()?.range().start;
                first..first
            }
        };
        pieces.push((place, element));
    }
    pieces.sort_by_key(|(place, _)| place.start);
    let mut all = text.to_owned();
    for (place, element) in pieces.into_iter().rev() {
        all.replace_range(place, &element);
    }
    Some(all)
}

/// The joints of Universal Robots' description, and what their file of `kinematics` calls the links behind them.
const LINKS: [(&str, &str); 6] = [
    ("shoulder_pan_joint", "shoulder"),
    ("shoulder_lift_joint", "upper_arm"),
    ("elbow_joint", "forearm"),
    ("wrist_1_joint", "wrist_1"),
    ("wrist_2_joint", "wrist_2"),
    ("wrist_3_joint", "wrist_3"),
];

/// The corrected arm as `kinematics_params` of `ur_description`; `None` where it is no arm of Universal Robots.
pub(crate) fn kinematics(given: &Urdf, corrected: &Arm) -> Option<String> {
    let is_one = |(name, (joint, _)): (&String, &(&str, &str))| name.ends_with(joint);
    let names = given.joint_names();
    if names.len() != LINKS.len() || !names.iter().zip(&LINKS).all(is_one) {
        return None;
    }
    let mut links = String::new();
    for ((_, link), origin) in LINKS.iter().zip(&origins(given, corrected)?) {
        let (x, r) = (origin.translation.vector, origin.rotation.euler_angles());
        let _ = write!(
            links,
            "  {link}:\n    x: {:?}\n    y: {:?}\n    z: {:?}\n    roll: {:?}\n    pitch: {:?}\n    yaw: {:?}\n",
            x.x, x.y, x.z, r.0, r.1, r.2
        );
    }
    Some(format!("kinematics:\n{links}  hash: calib_{}\n", Hash::of(links.as_bytes())))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use handeye::math::random::Random;

    use super::*;

    /// Six joints as Universal Robots names them; the third has no origin, the flange hangs behind a fixed one.
    fn arm() -> Urdf {
        let mut joints = String::new();
        let origins = [
            Some(("0 0 0.1625", "0 0 0")),
            Some(("0 0 0", "1.570796327 0 0")),
            None,
            Some(("-0.3922 0 0.1333", "0 0 0")),
            Some(("0 -0.0997 -2.044881182297852e-11", "1.570796327 0 0")),
            Some((
                "0 0.0996 -2.042830148012698e-11",
                "1.570796326589793 3.141592653589793 3.14159265",
            )),
        ];
        for (k, ((name, _), origin)) in LINKS.iter().zip(origins).enumerate() {
            let origin = origin.map_or(String::new(), |(xyz, rpy)| {
                format!("<origin rpy=\"{rpy}\" xyz=\"{xyz}\" />\n")
            });
            let _ = write!(
                joints,
                "<joint name=\"left_{name}\" type=\"revolute\">\n  <parent link=\"l{k}\"/>{origin}\
                 <child link=\"l{}\"/><axis xyz=\"0 0 1\"/></joint>\n<!-- {k} -->",
                k + 1
            );
        }
        let text = format!(
            "<robot name=\"r\">{joints}<joint name=\"end\" type=\"fixed\"><parent link=\"l6\"/><child \
             link=\"tool0\"/><origin xyz=\"0 0 0.1\" rpy=\"0.3 0 0.2\"/></joint></robot>"
        );
        Urdf::parse(&text, Path::new("arm.urdf"), "l0", "tool0").unwrap()
    }

    #[test]
    fn the_corrected_file_is_the_corrected_arm_at_any_joint_values() {
        let given = arm();
        let mut random = Random::new(3);
        let which = given.arm().deviations();
        let by: Vec<f64> = which.iter().map(|_| random.between(-0.01, 0.01)).collect();
        let corrected = given.arm().moved(&which, &by);
        let text = urdf(&given, &corrected).unwrap();
        let again = Urdf::parse(&text, Path::new("corrected.urdf"), "l0", "tool0").unwrap();
        assert_eq!(again.joint_names(), given.joint_names());
        for _ in 0..1000 {
            let q: Vec<f64> = (0..6).map(|_| random.between(-3.0, 3.0)).collect();
            let (a, b) = (corrected.base_from_flange(&q), again.arm().base_from_flange(&q));
            assert!(a.local(&b).amax() < 1e-9, "{}", a.local(&b));
        }
        // all else is as it was
        let left = |text: &str| text.lines().filter(|l| !l.contains("<origin")).count();
        assert!(left(&text) <= left(given.text()));
        assert!(text.contains("<!-- 3 -->") && text.contains("rpy=\"0.3 0 0.2\""));
    }

    #[test]
    fn an_arm_that_is_as_it_was_has_the_origins_that_it_had() {
        let given = arm();
        let yaml = kinematics(&given, given.arm()).unwrap();
        assert!(yaml.contains("  forearm:\n    x: "), "{yaml}");
        for (now, was) in origins(&given, given.arm()).unwrap().iter().zip(given.origins()) {
            let off = now.inverse() * was.parent_from_joint;
            assert!(off.translation.vector.norm() + off.rotation.angle() < 1e-9, "{off}");
        }
        let fewer = Arm { joints: given.arm().joints[..5].to_vec(), ..given.arm().clone() };
        assert!(urdf(&given, &fewer).is_none());
    }
}
