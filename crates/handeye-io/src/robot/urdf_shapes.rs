//! The shapes of a URDF's links (`<collision>`: boxes, cylinders, spheres and meshes) as capsules that hold them.
//!
//! A capsule about a cylinder has its axis and radius, and is longer by a cap at both ends: what is kept apart from it, is
//! apart from the link.

use std::{
    collections::BTreeSet,
    path::{Component, Path, PathBuf},
};

use handeye::tools::plan::{Capsule, Cuboid, On, Part};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use roxmltree::{Document, Node, ParsingOptions};

use super::urdf::{Body, Urdf, three};
use crate::mesh;

/// Radius of a link of which no shape is known, m.
const USUAL_RADIUS: f64 = 0.07;
/// How many folders above the URDF's own a mesh is looked for in.
const FOLDERS_ABOVE: usize = 4;

/// The meshes of its links' shapes that are found: what the URDF calls them, below its own folder, and where they are.
pub(crate) fn meshes(urdf: &Urdf) -> Vec<(PathBuf, PathBuf)> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let Ok(document) = Document::parse_with_options(urdf.text(), options) else { return vec![] };
    let is_shape = |node: &Node| node.ancestors().any(|a| a.has_tag_name("collision"));
    let nodes = document.descendants().filter(|n| n.has_tag_name("mesh") && is_shape(n));
    let names: BTreeSet<&str> = nodes.filter_map(|node| node.attribute("filename")).collect();
    let is_below = |path: &Path| path.components().all(|part| matches!(part, Component::Normal(_)));
    let one = |name: &str| {
        let below = PathBuf::from(bare(name));
        is_below(&below).then_some(())?;
        Some((below, found(name, urdf.path())?))
    };
    names.into_iter().filter_map(one).collect()
}

/// The parts of a robot, and what is to be known of how they were found.
pub fn parts(urdf: &Urdf, file: &Path) -> (Vec<Part>, Vec<String>) {
    let (mut parts, mut notes, mut unread) = (vec![], vec![], vec![]);
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(urdf.text(), options);
    let bodies = urdf.bodies();
    if let Ok(document) = &document {
        for link in document.root_element().children().filter(|c| c.has_tag_name("link")) {
            let name = link.attribute("name").unwrap_or_default();
            let Some(body) = bodies.iter().find(|body| body.link == name) else { continue };
            for node in link.children().filter(|c| c.has_tag_name("collision")) {
                match shape(&node, file) {
                    Ok(shape) => parts.push(placed(urdf, body, &shape)),
                    Err(why) => {
                        notes.push(format!("link {name}: {why}"));
                        unread.extend(body.joint);
                    }
                }
            }
        }
    }
    stand_ins(urdf, &unread, &mut parts, &mut notes);
    (parts, notes)
}

/// A shape where the joint that moves it has it.
fn placed(urdf: &Urdf, body: &Body, shape: &Capsule) -> Part {
    let in_base = shape.placed(&body.base_from_link);
    let zeros = vec![0.0; urdf.joint_names().len()];
    let frames = urdf.arm().link_frames(&zeros);
    let (on, shape) = match body.joint {
        None => (On::Base, in_base),
        Some(joint) => (On::Joint(joint), in_base.placed(&frames[joint].inverse())),
    };
    Part { name: body.link.clone(), on, shape }
}

/// Links without a shape of their own, and those with one that cannot be read, are as thick as those of many arms.
fn stand_ins(urdf: &Urdf, unread: &[usize], parts: &mut Vec<Part>, notes: &mut Vec<String>) {
    let zeros = vec![0.0; urdf.joint_names().len()];
    let frames = urdf.arm().link_frames(&zeros);
    let joints: Vec<Vector3<f64>> =
        urdf.origins().iter().map(|o| o.base_from_joint.translation.vector).collect();
    let flange = urdf.arm().base_from_flange(&zeros).translation();
    for (k, from) in joints.iter().enumerate() {
        if !unread.contains(&k) && parts.iter().any(|part| part.on == On::Joint(k)) {
            continue;
        }
        let name = format!("what {} moves", urdf.joint_names()[k]);
        if k == 0 {
            // it turns above the base: a capsule would always touch what the base stands on
            notes.push(format!("{name} has no shape: nothing is kept away from it"));
            continue;
        }
        let to = joints.get(k + 1).copied().unwrap_or(flange);
        let link = Capsule { from: *from, to, radius: USUAL_RADIUS };
        notes.push(format!(
            "{name} has no shape that can be read: taken to be {:.0} mm thick",
            2e3 * USUAL_RADIUS
        ));
        parts.push(Part { name, on: On::Joint(k), shape: link.placed(&frames[k].inverse()) });
    }
}

fn child<'a, 'i>(node: &Node<'a, 'i>, tag: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|c| c.has_tag_name(tag))
}

fn shape(collision: &Node, file: &Path) -> Result<Capsule, String> {
    let geometry = child(collision, "geometry").ok_or("a collision without <geometry>")?;
    let origin = child(collision, "origin");
    let vector = |key: &str| {
        let text = origin.and_then(|o| o.attribute(key));
        text.map_or(Some(Vector3::zeros()), three)
            .ok_or_else(|| format!("{key} of an origin are not three numbers"))
    };
    let (xyz, rpy) = (vector("xyz")?, vector("rpy")?);
    let link_from_shape = Isometry3::from_parts(
        Translation3::from(xyz),
        UnitQuaternion::from_euler_angles(rpy.x, rpy.y, rpy.z),
    );
    let number = |node: &Node, key: &str| {
        let value = node.attribute(key).and_then(|text| text.trim().parse::<f64>().ok());
        value
            .filter(|x| x.is_finite() && *x > 0.0)
            .ok_or_else(|| format!("{key} of a shape is no length"))
    };
    let capsule = if let Some(cylinder) = child(&geometry, "cylinder") {
        let (radius, half) = (number(&cylinder, "radius")?, 0.5 * number(&cylinder, "length")?);
        Capsule { from: Vector3::z() * -half, to: Vector3::z() * half, radius }
    } else if let Some(sphere) = child(&geometry, "sphere") {
        let radius = number(&sphere, "radius")?;
        Capsule { from: Vector3::zeros(), to: Vector3::zeros(), radius }
    } else if let Some(cuboid) = child(&geometry, "box") {
        let size = cuboid
            .attribute("size")
            .and_then(three)
            .ok_or("size of a box are not three numbers")?;
        Capsule::around(&Cuboid { middle: Isometry3::identity(), half: size.abs() * 0.5 })
    } else if let Some(node) = child(&geometry, "mesh") {
        of_mesh(&node, file)?
    } else {
        return Err("a shape that is no box, cylinder, sphere or mesh".into());
    };
    Ok(capsule.placed(&link_from_shape))
}

/// A capsule that holds a mesh; URDF's meshes are in metres, unless they are scaled.
fn of_mesh(node: &Node, file: &Path) -> Result<Capsule, String> {
    let name = node.attribute("filename").ok_or("a mesh without a filename")?;
    let path =
        found(name, file).ok_or_else(|| format!("the mesh {name} is not found beside the URDF"))?;
    let scale = node.attribute("scale").map_or(Some(Vector3::repeat(1.0)), three);
    let scale = scale.ok_or("scale of a mesh are not three numbers")?;
    let mesh = mesh::read_mesh(&path, Some(crate::units::LengthUnit::Metre))
        .map_err(|e| e.to_string().lines().next().unwrap_or_default().to_owned())?;
    let points: Vec<Vector3<f64>> = mesh
        .vertices()
        .iter()
        .map(|p| {
            Vector3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2])).component_mul(&scale)
        })
        .collect();
    Capsule::holding(&points).ok_or_else(|| format!("{name} has no points"))
}

fn bare(name: &str) -> &str {
    name.strip_prefix("package://").or_else(|| name.strip_prefix("file://")).unwrap_or(name)
}

/// `package://robot/meshes/a.stl` in the URDF's folder, or in one of those above it.
fn found(name: &str, file: &Path) -> Option<PathBuf> {
    let bare = bare(name);
    let mut tails = vec![bare];
    if let Some((_, tail)) = bare.split_once('/') {
        tails.push(tail);
    }
    let folder = file.parent().unwrap_or(Path::new(""));
    let folders = folder.ancestors().take(FOLDERS_ABOVE + 1);
    folders
        .flat_map(|folder| tails.iter().map(move |tail| folder.join(tail)))
        .find(|path| path.is_file())
}
