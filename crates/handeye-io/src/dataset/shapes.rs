//! What takes a board's place in a manifest: a still scene, or an object of known shape, in scans alone.

use std::{
    fmt,
    path::{Path, PathBuf},
};

use handeye::{Camera, Mount, Pose, Scan, Setup, Warning};
use serde::{
    Deserialize, Deserializer, Serialize, Serializer,
    de::{Error as _, MapAccess, SeqAccess, Visitor},
};

use super::{Dataset, opening::Opening};
use crate::{
    error::{Error, Place, malformed},
    mesh,
    result_file::read_result,
    scan::{self, ScanOptions},
    target_file::{Targets, TargetsVisitor},
    units::LengthUnit,
};

/// What the scans show instead of a board.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A scene that stands still: scans are brought together by what they have in common.
    Scene {
        /// A first estimate of the camera pose, by an earlier calibration.
        guess: Option<Pose<Mount, Camera>>,
    },
    /// A rigid object whose shape is known.
    Object {
        /// Its mesh, or a scan of it.
        model: PathBuf,
        /// Unit of that file, where the file does not say it.
        length_unit: Option<LengthUnit>,
    },
}

impl Shape {
    /// The manifest's word for it, which is also the name of its table.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Scene { .. } => SCENE,
            Self::Object { .. } => OBJECT,
        }
    }
}

const SCENE: &str = "scene";
const OBJECT: &str = "object";

/// What stands under `target`: boards, or a word for what takes their place.
#[derive(Debug, Clone)]
pub(crate) enum TargetSpec {
    Boards(Targets),
    Scene,
    Object,
}

impl TargetSpec {
    pub(super) fn boards(&self) -> Option<&Targets> {
        match self {
            Self::Boards(targets) => Some(targets),
            Self::Scene | Self::Object => None,
        }
    }
}

impl<'de> Deserialize<'de> for TargetSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TargetVisitor)
    }
}

impl Serialize for TargetSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Boards(targets) => targets.serialize(serializer),
            Self::Scene => SCENE.serialize(serializer),
            Self::Object => OBJECT.serialize(serializer),
        }
    }
}

struct TargetVisitor;

impl<'de> Visitor<'de> for TargetVisitor {
    type Value = TargetSpec;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        TargetsVisitor.expecting(f)?;
        f.write_str(", or target = \"scene\" or \"object\"")
    }

    fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<TargetSpec, E> {
        match word {
            SCENE => Ok(TargetSpec::Scene),
            OBJECT => Ok(TargetSpec::Object),
            _ => Err(E::custom(format!(
                "target = {word:?} is neither \"scene\" nor \"object\", and a board is described in a table \
                 [target]"
            ))),
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<TargetSpec, A::Error> {
        TargetsVisitor.visit_map(map).map(TargetSpec::Boards)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<TargetSpec, A::Error> {
        TargetsVisitor.visit_seq(seq).map(TargetSpec::Boards).map_err(A::Error::custom)
    }
}

/// A still scene that the scans show.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneSpec {
    /// calibration.json of an earlier calibration: a first estimate of the camera pose on the flange.
    initial: Option<String>,
}

/// An object of known shape that the scans show.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ObjectSpec {
    /// Mesh of the object (STL, OBJ, PLY with faces), or a scan of it in any format that scans have.
    model: String,
    /// Unit of the model, where its file does not say it.
    length_unit: Option<LengthUnit>,
}

impl Opening {
    /// What takes the board's place; everything that only a board has is refused then.
    pub(super) fn shape(&self, warnings: &mut Vec<Warning>) -> Result<Option<Shape>, Error> {
        self.check_tables()?;
        let shape = match self.manifest.target {
            Some(TargetSpec::Scene) => self.scene()?,
            Some(TargetSpec::Object) => self.object()?,
            Some(TargetSpec::Boards(_)) | None => return Ok(None),
        };
        self.check_scans(&shape)?;
        self.check_boards_keys(&shape)?;
        if self.manifest.images.is_some() {
            warnings.push(Warning::new(
                "images-not-used",
                format!("target = {:?} is seen in scans alone: [images] is not used", shape.word()),
            ));
        }
        Ok(Some(shape))
    }

    /// A table of a shape that `target` does not name says that something else was meant.
    fn check_tables(&self) -> Result<(), Error> {
        let m = &self.manifest;
        let misplaced = [
            (SCENE, m.scene.is_some() && !matches!(m.target, Some(TargetSpec::Scene))),
            (OBJECT, m.object.is_some() && !matches!(m.target, Some(TargetSpec::Object))),
        ];
        let Some((word, _)) = misplaced.into_iter().find(|(_, is_misplaced)| *is_misplaced) else {
            return Ok(());
        };
        let what = format!("[{word}] belongs to target = \"{word}\"");
        let advice = format!("write target = \"{word}\" above all tables, or remove [{word}]");
        Err(malformed(self.source.place(word), what, advice))
    }

    fn check_scans(&self, shape: &Shape) -> Result<(), Error> {
        if self.manifest.scans.is_some() {
            return Ok(());
        }
        let question =
            format!("in which scans is the {} seen? ([scans] files = ...)", shape.word());
        Err(self.source.undeclared("scans", &question))
    }

    fn check_boards_keys(&self, shape: &Shape) -> Result<(), Error> {
        let m = &self.manifest;
        let of_boards = [
            ("corners", m.corners.is_some()),
            ("board_poses", m.board_poses.is_some()),
            ("point_pairs", m.point_pairs.is_some()),
            ("touches", m.touches.is_some()),
            ("placements", !m.placements.is_empty()),
            ("captures.target", m.captures.target.is_some()),
        ];
        match of_boards.into_iter().find(|(_, is_there)| *is_there) {
            None => Ok(()),
            Some((key, _)) => {
                let what = format!("{key} belongs to a board, and target = {:?}", shape.word());
                Err(malformed(self.source.place(key), what, "remove it"))
            }
        }
    }

    fn scene(&self) -> Result<Shape, Error> {
        if self.manifest.setup == Setup::EyeToHand {
            return Err(malformed(
                self.source.place("target"),
                "a still scene tells nothing of a camera that stands still itself",
                "fix an object of known shape to the flange, and write target = \"object\"",
            ));
        }
        let initial = self.manifest.scene.as_ref().and_then(|spec| spec.initial.as_ref());
        let guess = initial.map(|name| guess(&self.root.join(name), self.manifest.setup));
        Ok(Shape::Scene { guess: guess.transpose()? })
    }

    fn object(&self) -> Result<Shape, Error> {
        let Some(spec) = &self.manifest.object else {
            let question = "which shape does the camera see? ([object] model = \"part.stl\")";
            return Err(self.source.undeclared("object", question));
        };
        Ok(Shape::Object { model: self.root.join(&spec.model), length_unit: spec.length_unit })
    }
}

/// Where an earlier calibration put the camera.
fn guess(path: &Path, setup: Setup) -> Result<Pose<Mount, Camera>, Error> {
    let refuse = |line: Option<usize>, what: String, advice: &str| {
        malformed(Place { line, ..Place::file(path) }, what, advice)
    };
    let earlier = read_result(path)?;
    if earlier.setup != setup {
        let what = "is the result of a camera that stands still (eye-to-hand)".to_owned();
        return Err(refuse(None, what, "name one of this camera on the flange (eye-in-hand)"));
    }
    earlier.hand_eye.mount_from_camera.ok_or_else(|| {
        let what = "holds no camera pose: its calibration has no answer".to_owned();
        refuse(None, what, "name one that was accepted, or leave `initial` out")
    })
}

impl Dataset {
    /// Points on the surface of the object that takes a board's place.
    pub(crate) fn object(&self, model: &Path, unit: Option<LengthUnit>) -> Result<Scan, Error> {
        if !mesh::is_mesh(model) {
            let length_unit = scan::scan_unit(model).or(unit);
            let options = ScanOptions { length_unit, organised: None, ..self.scan_options };
            return scan::read_scan(model, &options).map_err(of_object);
        }
        let mesh = mesh::read_mesh(model, unit).map_err(of_object)?;
        mesh::points_on(&mesh).map_err(|e| {
            malformed(Place::file(model), e.to_string(), "export the object alone, in its own unit")
        })
    }
}

/// Names the key of the manifest's table that the object's file leaves open.
fn of_object(error: Error) -> Error {
    match error {
        Error::Undeclared { place, key, question } if key == "length_unit" => {
            Error::Undeclared { place, key: format!("{OBJECT}.{key}"), question }
        }
        other => other,
    }
}
