//! An arm out of a URDF (wiki.ros.org/urdf/XML): the chain of joints from one link to another.
//!
//! `<origin xyz rpy>` places a joint in its parent link, `R = Rz(yaw) Ry(pitch) Rx(roll)`; the joint turns or slides
//! about its `<axis>`, given in its own frame.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use handeye::{
    Base, Flange, Pose,
    model::kinematics::{Arm, Axis, MOST_JOINTS},
};
use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};
use roxmltree::{Document, Node, ParsingOptions};
use serde::{Deserialize, Serialize};

use crate::{
    error::{Error, Place, malformed, nearest},
    files,
};

/// A model of an arm as a manifest names it.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct UrdfSpec {
    /// The robot's URDF.
    pub(crate) file: String,
    /// The link that is the robot's base.
    pub(crate) base: String,
    /// The link that is its flange.
    pub(crate) flange: String,
}

/// The joints between two links of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct Urdf {
    arm: Arm,
    joints: Vec<String>,
    origins: Vec<Origin>,
    limits: Vec<(f64, f64)>,
    text: String,
    path: PathBuf,
    links: (String, String),
}

/// Where a joint that moves stands, all joint values zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Origin {
    pub(crate) base_from_joint: Isometry3<f64>,
    /// As the file has it.
    pub(crate) parent_from_joint: Isometry3<f64>,
}

/// A link, and what moves it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Body {
    pub(crate) link: String,
    /// The number of the arm's joint nearest to it.
    pub(crate) joint: Option<usize>,
    /// Where it is while all joint values are zero.
    pub(crate) base_from_link: Isometry3<f64>,
}

/// A joint as the file has it.
struct Joint {
    name: String,
    kind: String,
    parent: String,
    parent_from_joint: Isometry3<f64>,
    axis: Vector3<f64>,
    limits: (f64, f64),
    mimics: bool,
    line: usize,
}

/// A joint without limits turns once either way: cables do not like more.
const FREE_TURN: f64 = std::f64::consts::TAU;

/// By the child link.
type Joints = BTreeMap<String, Joint>;

impl Urdf {
    /// Reads the chain from the link `base` to the link `flange`.
    ///
    /// # Errors
    /// What is no URDF, links that it does not have or that no chain joins, joints that move in more than one way.
    pub fn read(path: &Path, base: &str, flange: &str) -> Result<Urdf, Error> {
        Self::parse(&files::text(path)?, path, base, flange)
    }

    /// The same of its text; errors call it by this name.
    ///
    /// # Errors
    /// As [`Urdf::read`].
    pub fn parse(text: &str, path: &Path, base: &str, flange: &str) -> Result<Urdf, Error> {
        let joints = joints_of(text, path)?;
        let (start, chain) = chain(&joints, base, flange, path)?;
        let limits = chain.iter().filter(|j| j.kind != "fixed").map(|j| j.limits).collect();
        let (arm, joints, origins) = arm(start, &chain, path)?;
        let links = (base.to_owned(), flange.to_owned());
        Ok(Urdf { arm, joints, origins, limits, text: text.into(), path: path.into(), links })
    }

    /// The arm; joint values are in rad and m.
    pub fn arm(&self) -> &Arm {
        &self.arm
    }

    /// The names of its joints, from the base outwards.
    pub fn joint_names(&self) -> &[String] {
        &self.joints
    }

    /// Lowest and highest value of each joint, rad or m.
    pub fn limits(&self) -> &[(f64, f64)] {
        &self.limits
    }

    /// Which of its joints are prismatic.
    pub fn prismatic(&self) -> Vec<bool> {
        self.arm.joints.iter().map(|joint| joint.prismatic).collect()
    }

    /// Where base, joints and flange are for joint values (rad, m), in the base, m.
    pub fn points(&self, values: &[f64]) -> Vec<Vector3<f64>> {
        let (zero, moved) = (self.arm.link_frames(&[]), self.arm.link_frames(values));
        let mut points = vec![Vector3::zeros()];
        for (k, origin) in self.origins.iter().enumerate() {
            let at = Point3::from(origin.base_from_joint.translation.vector);
            // what the joint before it moves
            let by = k.checked_sub(1).map(|before| moved[before] * zero[before].inverse());
            points.push(by.map_or(at, |by| by * at).coords);
        }
        points.push(self.arm.base_from_flange(values).translation());
        points
    }

    /// The links as base and flange between which the same joints bring the flange to a pose, where those that were chosen
    /// do not: `base` and `tool0`, for example.
    pub fn links_that_agree(
        &self,
        values: &[f64],
        agree: impl Fn(&Pose<Base, Flange>) -> bool,
    ) -> Option<(String, String)> {
        let bodies = self.bodies();
        let moved_by = |joint: Option<usize>| bodies.iter().filter(move |body| body.joint == joint);
        let last = self.joints.len().checked_sub(1);
        moved_by(None).flat_map(|base| moved_by(last).map(move |flange| (base, flange))).find_map(
            |(base, flange)| {
                let other = Self::parse(&self.text, &self.path, &base.link, &flange.link).ok()?;
                let is_same_chain = other.joints == self.joints;
                (is_same_chain && agree(&other.arm.base_from_flange(values)))
                    .then(|| (base.link.clone(), flange.link.clone()))
            },
        )
    }

    /// Its file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// All links with what moves them, all joint values zero: which joint of the arm, or none, and where they are in the
    /// base.
    pub(crate) fn bodies(&self) -> Vec<Body> {
        let Ok(joints) = joints_of(&self.text, Path::new("")) else { return vec![] };
        let from_root = |link: &str| {
            let (mut pose, mut here, mut by) = (Isometry3::identity(), link, None);
            for _ in 0..=joints.len() {
                let Some(joint) = joints.get(here) else { break };
                by = by.or_else(|| self.joints.iter().position(|name| *name == joint.name));
                pose = joint.parent_from_joint * pose;
                here = &joint.parent;
            }
            (pose, by)
        };
        let root_from_base = from_root(&self.links.0).0;
        let body = |link: &str| {
            let (root_from_link, joint) = from_root(link);
            let base_from_link = root_from_base.inverse() * root_from_link;
            Body { link: link.into(), joint, base_from_link }
        };
        let roots = joints.values().map(|j| j.parent.as_str()).filter(|l| !joints.contains_key(*l));
        let all: std::collections::BTreeSet<&str> =
            joints.keys().map(String::as_str).chain(roots).collect();
        all.into_iter().map(body).collect()
    }

    /// Where its joints stand, in their order.
    pub(crate) fn origins(&self) -> &[Origin] {
        &self.origins
    }

    /// The file's text.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// Base and flange.
    pub(crate) fn links(&self) -> (&str, &str) {
        (&self.links.0, &self.links.1)
    }
}

/// Where the link `inner` lies in the link `outer`, between which only fixed joints lie: `outer_from_inner`.
///
/// # Errors
/// As [`Urdf::read`]; a joint between the two that moves.
pub(crate) fn rigid(path: &Path, outer: &str, inner: &str) -> Result<Isometry3<f64>, Error> {
    let joints = joints_of(&files::text(path)?, path)?;
    let (start, chain) = chain(&joints, outer, inner, path)?;
    if let Some(joint) = chain.iter().find(|joint| joint.kind != "fixed") {
        let what = format!("the joint {} between {outer} and {inner} moves", joint.name);
        let advice = "choose two links of the camera, which only fixed joints connect";
        return Err(malformed(Place::line(path, joint.line), what, advice));
    }
    Ok(chain.iter().fold(start, |pose, joint| pose * joint.parent_from_joint))
}

/// All joints of a URDF's text.
fn joints_of(text: &str, path: &Path) -> Result<Joints, Error> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|e| {
        let place = Place::line(path, e.pos().row as usize);
        malformed(place, format!("is not XML: {e}"), "give the URDF of the robot")
    })?;
    let root = document.root_element();
    if !root.has_tag_name("robot") {
        let what = format!("is no URDF: its root is <{}>, not <robot>", root.tag_name().name());
        return Err(malformed(Place::file(path), what, "give the URDF of the robot"));
    }
    if root.children().any(|c| c.tag_name().namespace().is_some_and(|n| n.contains("xacro"))) {
        let advice = "expand it first: xacro robot.urdf.xacro > robot.urdf";
        return Err(malformed(Place::file(path), "is a xacro, not a URDF", advice));
    }
    joints(&root, path)
}

fn joints(root: &Node, path: &Path) -> Result<Joints, Error> {
    let mut all = Joints::new();
    for node in root.children().filter(|c| c.has_tag_name("joint")) {
        let line = root.document().text_pos_at(node.range().start).row as usize;
        let (child, joint) = joint(&node, line, path)?;
        if let Some(other) = all.get(&child) {
            let what =
                format!("the link {child} hangs on two joints, {} and {}", other.name, joint.name);
            return Err(malformed(Place::line(path, line), what, "correct the model"));
        }
        all.insert(child, joint);
    }
    Ok(all)
}

fn joint(node: &Node, line: usize, path: &Path) -> Result<(String, Joint), Error> {
    let name = node.attribute("name").unwrap_or("?").to_owned();
    let wrong = |what: &str| {
        malformed(Place::line(path, line), format!("joint {name}: {what}"), "correct the model")
    };
    let part = |tag: &str| node.children().find(|c| c.has_tag_name(tag));
    let link = |tag: &str| part(tag).and_then(|c| c.attribute("link")).map(str::to_owned);
    let parent = link("parent").ok_or_else(|| wrong("has no <parent link=...>"))?;
    let child = link("child").ok_or_else(|| wrong("has no <child link=...>"))?;
    let vector = |tag: &str, key: &str, otherwise: [f64; 3]| -> Result<Vector3<f64>, Error> {
        let Some(text) = part(tag).and_then(|c| c.attribute(key)) else {
            return Ok(otherwise.into());
        };
        three(text).ok_or_else(|| wrong(&format!("{key} = \"{text}\" are not three numbers")))
    };
    let (xyz, rpy) = (vector("origin", "xyz", [0.0; 3])?, vector("origin", "rpy", [0.0; 3])?);
    let limit = |key: &str, otherwise: f64| -> Result<f64, Error> {
        let Some(text) = part("limit").and_then(|c| c.attribute(key)) else { return Ok(otherwise) };
        let number = text.trim().parse().ok().filter(|x: &f64| x.is_finite());
        number.ok_or_else(|| wrong(&format!("{key} = \"{text}\" is no limit")))
    };
    let kind = node.attribute("type").unwrap_or_default();
    let limits = match kind {
        "continuous" => (-FREE_TURN, FREE_TURN),
        // a limit that is left out is zero (wiki.ros.org/urdf/XML/joint)
        _ if part("limit").is_some() => (limit("lower", 0.0)?, limit("upper", 0.0)?),
        _ => (-FREE_TURN, FREE_TURN),
    };
    let joint = Joint {
        limits,
        kind: kind.into(),
        parent,
        parent_from_joint: Isometry3::from_parts(
            Translation3::from(xyz),
            UnitQuaternion::from_euler_angles(rpy.x, rpy.y, rpy.z),
        ),
        axis: vector("axis", "xyz", [1.0, 0.0, 0.0])?,
        mimics: part("mimic").is_some(),
        line,
        name,
    };
    Ok((child, joint))
}

pub(super) fn three(text: &str) -> Option<Vector3<f64>> {
    let numbers: Option<Vec<f64>> = text.split_whitespace().map(|w| w.parse().ok()).collect();
    match numbers?[..] {
        [x, y, z] if [x, y, z].iter().all(|v: &f64| v.is_finite()) => Some(Vector3::new(x, y, z)),
        _ => None,
    }
}

/// Where the chain begins, and its joints from there outwards.
fn chain<'a>(
    joints: &'a Joints,
    base: &str,
    flange: &str,
    path: &Path,
) -> Result<(Isometry3<f64>, Vec<&'a Joint>), Error> {
    let links = || joints.iter().flat_map(|(child, joint)| [child.as_str(), joint.parent.as_str()]);
    for link in [base, flange] {
        if !links().any(|l| l == link) {
            let advice = match nearest(link, links()) {
                Some(near) => format!("did you mean {near}?"),
                None => format!("its links: {}", in_order(links())),
            };
            return Err(malformed(Place::file(path), format!("there is no link {link}"), advice));
        }
    }
    // a base that hangs on the trunk by joints that do not move, as UR's `base` on its `base_link`
    let (mut trunk, mut base_from_trunk) =
        (vec![(base, Isometry3::identity())], Isometry3::identity());
    let mut below = base;
    while let Some(joint) =
        joints.get(below).filter(|j| j.kind == "fixed" && trunk.len() <= joints.len())
    {
        base_from_trunk *= joint.parent_from_joint.inverse();
        below = &joint.parent;
        trunk.push((below, base_from_trunk));
    }
    let (mut all, mut here) = (vec![], flange);
    loop {
        if let Some((_, base_from_here)) = trunk.iter().find(|(link, _)| *link == here) {
            all.reverse();
            return Ok((*base_from_here, all));
        }
        let Some(joint) = joints.get(here).filter(|_| all.len() <= joints.len()) else {
            let what = format!("no chain of joints leads from {base} out to {flange}");
            let advice = "base is the link nearer to the ground, flange the one at the far end";
            return Err(malformed(Place::file(path), what, advice));
        };
        all.push(joint);
        here = &joint.parent;
    }
}

fn in_order<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<std::collections::BTreeSet<_>>().into_iter().collect::<Vec<_>>().join(", ")
}

/// The arm of a chain, and the names and places of the joints that move.
fn arm(
    start: Isometry3<f64>,
    chain: &[&Joint],
    path: &Path,
) -> Result<(Arm, Vec<String>, Vec<Origin>), Error> {
    let (mut here, mut axes, mut names, mut origins) = (start, vec![], vec![], vec![]);
    for joint in chain {
        here *= joint.parent_from_joint;
        if joint.kind == "fixed" {
            continue;
        }
        axes.push(axis(joint, &here, path)?);
        names.push(joint.name.clone());
        let parent_from_joint = joint.parent_from_joint;
        origins.push(Origin { base_from_joint: here, parent_from_joint });
    }
    if axes.is_empty() || axes.len() > MOST_JOINTS {
        let what = format!("{} joints move between the two links", axes.len());
        return Err(malformed(Place::file(path), what, format!("an arm has 1 to {MOST_JOINTS}")));
    }
    let arm = Arm::of_axes(&axes, &Pose::claim(here));
    arm.check().map_err(|source| Error::Values { place: Place::file(path), source })?;
    Ok((arm, names, origins))
}

fn axis(joint: &Joint, base_from_joint: &Isometry3<f64>, path: &Path) -> Result<Axis, Error> {
    let wrong = |what: &str, advice: &str| {
        Err(malformed(
            Place::line(path, joint.line),
            format!("joint {}: {what}", joint.name),
            advice,
        ))
    };
    let prismatic = match joint.kind.as_str() {
        "revolute" | "continuous" => false,
        "prismatic" => true,
        other => {
            return wrong(
                &format!("the type \"{other}\" is no joint of an arm"),
                "choose links between which joints turn or slide",
            );
        }
    };
    if joint.mimics {
        return wrong(
            "follows another joint",
            "a chain with <mimic> is not read: give its poses instead",
        );
    }
    let Some(direction) = Unit::try_new(joint.axis, 1e-9) else {
        return wrong("its axis has no direction", "correct the model");
    };
    let direction = Unit::new_normalize(base_from_joint.rotation * direction.into_inner());
    Ok(Axis { through: Point3::from(base_from_joint.translation.vector), direction, prismatic })
}

#[cfg(test)]
mod tests {
    use super::*;

    const ARM: &str = r#"<robot name="r">
        <link name="world"/><link name="base_link"/><link name="one"/><link name="two"/><link name="tool0"/>
        <joint name="stand" type="fixed"><parent link="world"/><child link="base_link"/><origin xyz="0 0 1"/></joint>
        <joint name="pan" type="revolute"><parent link="base_link"/><child link="one"/>
          <origin xyz="0 0 0.5" rpy="0 0 0"/><axis xyz="0 0 1"/></joint>
        <joint name="slide" type="prismatic"><parent link="one"/><child link="two"/>
          <origin xyz="0.2 0 0" rpy="0 1.5707963267948966 0"/><axis xyz="0 0 2"/></joint>
        <joint name="end" type="fixed"><parent link="two"/><child link="tool0"/><origin xyz="0 0 0.1"/></joint>
      </robot>"#;

    fn read(text: &str, base: &str, flange: &str) -> Result<Urdf, String> {
        Urdf::parse(text, Path::new("arm.urdf"), base, flange).map_err(|e| e.to_string())
    }

    #[test]
    fn an_arm_reaches_where_a_ruler_says() {
        let urdf = read(ARM, "base_link", "tool0").unwrap();
        assert_eq!(urdf.joint_names(), ["pan", "slide"]);
        let pose = urdf.arm().base_from_flange(&[std::f64::consts::FRAC_PI_2, 0.3]);
        assert!((pose.translation() - Vector3::new(0.0, 0.6, 0.5)).norm() < 1e-12, "{pose:?}");
        let higher = read(ARM, "world", "tool0").unwrap().arm().base_from_flange(&[0.0, 0.0]);
        assert!((higher.translation() - Vector3::new(0.3, 0.0, 1.5)).norm() < 1e-12, "{higher:?}");
        let side = r#"<joint name="side" type="fixed"><parent link="base_link"/><child link="base"/>
          <origin xyz="0 0 0.2" rpy="0 0 3.141592653589793"/></joint></robot>"#;
        let turned = read(&ARM.replace("</robot>", side), "base", "tool0").unwrap();
        let pose = turned.arm().base_from_flange(&[std::f64::consts::FRAC_PI_2, 0.3]);
        assert!((pose.translation() - Vector3::new(0.0, -0.6, 0.3)).norm() < 1e-12, "{pose:?}");
    }

    #[test]
    fn joints_stand_where_a_ruler_says() {
        let urdf = read(ARM, "base_link", "tool0").unwrap();
        let points = urdf.points(&[std::f64::consts::FRAC_PI_2, 0.3]);
        let expected = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.5], [0.0, 0.2, 0.5], [0.0, 0.6, 0.5]];
        assert_eq!(points.len(), expected.len());
        for (point, there) in points.iter().zip(expected) {
            assert!((point - Vector3::from(there)).norm() < 1e-12, "{points:?}");
        }
        assert_eq!(urdf.prismatic(), [false, true]);
    }

    #[test]
    fn links_are_found_between_which_the_model_agrees() {
        let urdf = read(ARM, "base_link", "tool0").unwrap();
        let values = [0.4, 0.1];
        let higher = read(ARM, "world", "tool0").unwrap().arm().base_from_flange(&values);
        let is_there = |pose: &Pose<Base, Flange>| pose.distance_to(&higher) < 1e-9;
        let found = urdf.links_that_agree(&values, is_there);
        assert_eq!(found, Some(("world".into(), "tool0".into())));
        assert_eq!(urdf.links_that_agree(&values, |_| false), None);
    }

    #[test]
    fn links_of_one_body_are_where_fixed_joints_put_them() {
        let camera = r#"<robot name="r"><link name="tool0"/><link name="camera_link"/><link name="lens"/><link name="optical"/>
          <joint name="wrist" type="revolute"><parent link="tool0"/><child link="camera_link"/><axis xyz="0 0 1"/></joint>
          <joint name="a" type="fixed"><parent link="camera_link"/><child link="lens"/><origin xyz="0 0.015 0"/></joint>
          <joint name="b" type="fixed"><parent link="lens"/><child link="optical"/>
            <origin rpy="-1.5707963267948966 0 -1.5707963267948966"/></joint></robot>"#;
        let file = std::env::temp_dir().join(format!("handeye-rigid-{}.urdf", std::process::id()));
        std::fs::write(&file, camera).unwrap();
        let found = rigid(&file, "camera_link", "optical").unwrap();
        // the camera looks along x of its body, the image's x is the body's -y
        assert!((found * Point3::new(0.0, 0.0, 1.0) - Point3::new(1.0, 0.015, 0.0)).norm() < 1e-15);
        assert!(
            (found * Point3::new(1.0, 0.0, 0.0) - Point3::new(0.0, -0.985, 0.0)).norm() < 1e-15
        );
        let moves = rigid(&file, "tool0", "optical").unwrap_err().to_string();
        std::fs::remove_file(&file).unwrap();
        assert!(moves.contains(":2: the joint wrist between tool0 and optical moves"), "{moves}");
    }

    #[test]
    fn wrong_links_and_joints_are_named_with_what_to_do() {
        let wrong = |text: &str, base: &str, flange: &str| read(text, base, flange).unwrap_err();
        assert!(
            wrong(ARM, "base_link", "tool").contains("there is no link tool; did you mean tool0?")
        );
        assert!(wrong(ARM, "tool0", "base_link").contains("no chain of joints leads from tool0"));
        assert!(wrong(ARM, "world", "base_link").contains("0 joints move"));
        let typed = format!("<!DOCTYPE robot>{}", ARM.trim_start());
        assert!(read(&typed, "base_link", "tool0").is_ok());
        let floating = ARM.replace("prismatic", "floating");
        assert!(
            wrong(&floating, "base_link", "tool0").starts_with("arm.urdf:6: joint slide: the type")
        );
        let crooked = ARM.replace("0.2 0 0", "0.2 0");
        assert!(wrong(&crooked, "base_link", "tool0").contains("are not three numbers"));
        assert!(wrong("<sdf/>", "a", "b").contains("its root is <sdf>"));
    }

    #[test]
    fn a_circle_of_links_is_no_chain() {
        let circle = r#"<robot><joint name="a" type="fixed"><parent link="x"/><child link="y"/></joint>
          <joint name="b" type="fixed"><parent link="y"/><child link="x"/></joint>
          <joint name="c" type="fixed"><parent link="z"/><child link="w"/></joint></robot>"#;
        assert!(read(circle, "z", "x").unwrap_err().contains("no chain"));
    }
}
