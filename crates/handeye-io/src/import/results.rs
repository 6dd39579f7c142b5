//! Results of other programs: the pose of the camera, as JSON that `verify`, `export`, `repeat`, `view` and
//! `register --initial` take. Programs do not keep how sure a result is, so nothing is said of that.

use std::path::Path;

use handeye::{Pose, Setup};
use nalgebra::Isometry3;

use super::{
    Declared, Direction, Imported,
    declared::{self, WHO_CARRIES},
    ros, split, vision,
};
use crate::{
    Error, Place,
    error::{malformed, undeclared, unusable},
    result_file::pose_file,
    robot::{Notation, Units},
    units::{AngleUnit, LengthUnit, farthest, too_far},
};

/// A pose between the camera and the body that carries it, as a file has it.
pub(super) struct Found {
    pub(super) layout: &'static str,
    pub(super) pose: Isometry3<f64>,
    /// Who carries the camera, where the file says so.
    pub(super) setup: Option<Setup>,
    /// Whether it is the camera's pose, or that of the body in the camera; `None` where the file does not say.
    pub(super) is_cameras: Option<bool>,
    /// What was taken for granted.
    pub(super) notes: Vec<String>,
}

/// Reads a result whose form it knows.
type Reader = fn(&Path, &Declared) -> Result<Option<Found>, Error>;

const READERS: [Reader; 6] = [
    ros::easy_handeye,
    ros::launch_xml,
    ros::launch_python,
    vision::zivid_or_opencv,
    vision::halcon,
    vision::mech_mind,
];

pub(super) fn import(source: &Path, declared: &Declared) -> Result<Option<Imported>, Error> {
    if !source.is_file() {
        return Ok(None);
    }
    for reader in READERS {
        if let Some(found) = reader(source, declared)? {
            return resolved(found, source, declared).map(Some);
        }
    }
    Ok(None)
}

/// The pose of the camera, with all that was declared of it.
fn resolved(found: Found, source: &Path, declared: &Declared) -> Result<Imported, Error> {
    let said = direction(source, declared)?;
    let given = declared::setup(said.and_then(Direction::setup), declared.setup, source)?;
    let setup = declared::setup(found.setup, given, source)?;
    let is_cameras = found.is_cameras.or(said.map(|d| d.from == "camera"));
    if let (Some(own), Some(said)) = (found.is_cameras, said)
        && own != (said.from == "camera")
    {
        let what = format!("says that its pose has the other direction than {}", said.name());
        return Err(unusable(source, what));
    }
    let setup = setup.ok_or_else(|| undeclared(source, "--setup", WHO_CARRIES))?;
    let wanted = if setup == Setup::EyeToHand { IN_BASE } else { ON_FLANGE };
    let is_cameras = is_cameras.ok_or_else(|| {
        let question = format!(
            "is the pose {} (pose of the camera), or {} (as HALCON's calibrate_hand_eye has it)?",
            wanted.name(),
            wanted.inverse().name()
        );
        undeclared(source, "--direction", &question)
    })?;
    let pose = if is_cameras { found.pose } else { found.pose.inverse() };
    let place = Place::file(source);
    let refused = |what: String, advice: &str| Err(malformed(place, what, advice));
    if let Some(far) = farthest(pose.translation.vector.as_slice()) {
        return refused(too_far(far), "is the unit right? (--length-unit)");
    }
    let (body, most) = match setup {
        Setup::EyeInHand => ("flange", FARTHEST_IN_HAND_M),
        Setup::EyeToHand => ("base", FARTHEST_M),
    };
    let far = pose.translation.vector.norm();
    if far > most {
        let what = format!("puts the camera {far:.1} m away from the {body}");
        return refused(
            what,
            "is its position in another unit? (--length-unit), or correct the file",
        );
    }
    if far < SAME_PLACE && pose.rotation.angle() < SAME_PLACE {
        let what = format!(
            "puts the camera exactly into the {body}: programs write this where nothing was found"
        );
        return refused(what, "calibrate anew");
    }
    Ok(Imported {
        layout: found.layout,
        folder: split(source).0,
        name: format!("{}.json", wanted.name()),
        text: pose_file(setup, &Pose::claim(pose), None),
        questions: vec![],
        notes: found.notes,
        next: "handeye verify {} touches.csv --tolerance-mm 1",
    })
}

/// Cameras are mounted nearer than this, m.
const FARTHEST_IN_HAND_M: f64 = 3.0;
const FARTHEST_M: f64 = 30.0;
/// No camera is so near, m and rad.
const SAME_PLACE: f64 = 1e-9;

const IN_BASE: Direction = Direction::of("base", "camera");
const ON_FLANGE: Direction = Direction::of("flange", "camera");

/// What was declared of the camera's pose.
fn direction(source: &Path, declared: &Declared) -> Result<Option<Direction>, Error> {
    let in_base = declared.between(IN_BASE, source)?;
    let on_flange = declared.between(ON_FLANGE, source)?;
    match (in_base, on_flange) {
        (Some(one), Some(other)) => {
            let what = format!("is read as {} or as {}, not as both", one.name(), other.name());
            Err(unusable(source, what))
        }
        (one, other) => Ok(one.or(other)),
    }
}

/// The pose of numbers in a notation.
pub(super) fn pose(
    numbers: &[f64],
    notation: &str,
    length: LengthUnit,
    source: &Path,
) -> Result<Isometry3<f64>, Error> {
    let refuse = |what: String| malformed(Place::file(source), what, "correct the file");
    let notation = Notation::named(notation).map_err(refuse)?;
    notation.pose(numbers, Units { length, angle: AngleUnit::Radian }).map_err(refuse)
}
