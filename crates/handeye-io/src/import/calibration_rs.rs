//! Manifests of calibration-rs, TOML or JSON: cameras, a target, robot poses and their convention. What it marks as
//! `_unresolved` is asked; who carries the camera it does not say.

use std::path::Path;

use handeye::TargetModel;

use super::{Declared, Described, industrial, split};
use crate::{
    Error, Place,
    dataset::{
        Draft,
        manifest::{Fields, ImagesSpec, Pairing, RobotDirection, RobotSpec},
    },
    error::{malformed, unusable},
    files,
    table::Column,
    tree::Tree,
    units::{AngleUnit, LengthUnit},
};

const LAYOUT: &str = "calibration-rs";

pub(super) fn describe(source: &Path, _: &Declared) -> Result<Option<Described>, Error> {
    let Some(tree) = tree(source)? else { return Ok(None) };
    let Some(Tree::List(cameras)) = tree.get("cameras") else { return Ok(None) };
    let (Some(camera), Some(_)) = (cameras.first(), tree.get("topology")) else { return Ok(None) };
    let Some(robot) = tree.get("robot_poses") else {
        let what = "is a manifest of calibration-rs without robot_poses: there is no hand-eye set to calibrate";
        return Err(unusable(source, what));
    };
    let open = unresolved(&tree);
    let mut set = Set { source, open, draft: Draft::new(), questions: vec![] };
    set.questions = set
        .open
        .iter()
        .map(|key| format!("{key} is marked as _unresolved: which is it?"))
        .collect();
    if cameras.len() > 1 {
        let what = format!(
            "only the camera {} is described: one manifest for each camera",
            text(camera, "id")
        );
        set.questions.push(what);
    }
    if camera.get("roi_xywh").is_some_and(|roi| *roi != Tree::Null) {
        set.questions.push("its roi_xywh is not cut out: are the images whole?".into());
    }
    set.target(tree.get("target"));
    set.robot(robot, tree.get("pose_convention"))?;
    set.draft.manifest.images = Some(ImagesSpec::of(set.images(camera)?));
    if tree.get("pose_pairing").map(|p| text(p, "kind")) == Some("shared_filename_token") {
        set.draft.manifest.captures.pairing = Pairing::Number;
    }
    Ok(Some(Described {
        layout: LAYOUT,
        folder: split(source).0,
        setup: None,
        draft: set.draft,
        questions: set.questions,
        notes: vec![],
    }))
}

fn tree(source: &Path) -> Result<Option<Tree>, Error> {
    match files::extension(source).as_str() {
        "json" if source.is_file() => Tree::read(source).map(Some),
        "toml" if source.is_file() => {
            toml::from_str(&files::text(source)?).map(Some).map_err(|e| {
                let what = e.message().trim().replace('\n', " ");
                malformed(Place::file(source), format!("is not TOML: {what}"), "correct the file")
            })
        }
        _ => Ok(None),
    }
}

/// The text under a key, empty where there is none.
fn text<'a>(tree: &'a Tree, key: &str) -> &'a str {
    tree.get(key).and_then(Tree::text).unwrap_or_default()
}

/// What nobody could say when the manifest was written.
fn unresolved(tree: &Tree) -> Vec<String> {
    match tree.get("_unresolved") {
        Some(Tree::List(keys)) => keys.iter().filter_map(|k| k.text().map(String::from)).collect(),
        _ => vec![],
    }
}

/// What is described so far.
struct Set<'a> {
    source: &'a Path,
    open: Vec<String>,
    draft: Draft,
    questions: Vec<String>,
}

impl Set<'_> {
    /// The `[target]`, an example where ours has no such board.
    fn target(&mut self, target: Option<&Tree>) {
        let is_open = self.open.iter().any(|key| key.starts_with("target"));
        if let Some(model) = target.and_then(board).filter(|_| !is_open) {
            return self.draft.set_target(model);
        }
        let kind = target.map_or("", |t| text(t, "kind"));
        let what = format!("which target is in the images? (it says {kind:?})");
        self.draft.ask_target(&what);
        self.questions.push(what);
    }

    /// The `[robot]`; what is open is asked.
    fn robot(&mut self, robot: &Tree, convention: Option<&Tree>) -> Result<(), Error> {
        let (field, columns) = self.columns(robot, convention)?;
        let convention = |key: &str| convention.map_or("", |c| text(c, key));
        let rotation = convention("rotation_format");
        let angle_unit = rotation.starts_with("euler").then(|| match rotation.ends_with("_rad") {
            true => AngleUnit::Radian,
            false => AngleUnit::Degree,
        });
        let length_unit = match convention("translation_units") {
            "m" => Some(LengthUnit::Metre),
            "mm" => Some(LengthUnit::Millimetre),
            _ => None,
        };
        let direction = match convention("transform") {
            "t_base_tcp" | "t_world_tcp" => Some(RobotDirection::BaseFromFlange),
            "t_tcp_base" | "t_tcp_world" => Some(RobotDirection::FlangeFromBase),
            _ => None,
        };
        self.draft.manifest.robot = Some(RobotSpec {
            poses: text(robot, "path").into(),
            field,
            columns,
            notation: self.or_asked(
                "rotation_format",
                "notation",
                notation(rotation).map(String::from),
                "quaternion-xyzw".into(),
            ),
            angle_unit,
            length_unit: self.or_asked(
                "translation_units",
                "length_unit",
                length_unit,
                LengthUnit::Millimetre,
            ),
            direction: self.or_asked(
                "transform",
                "direction",
                direction,
                RobotDirection::BaseFromFlange,
            ),
            ..RobotSpec::default()
        });
        self.draft.note(
            "robot",
            "its poses are of the TCP: the answer is then the camera's place on the TCP",
        );
        Ok(())
    }

    /// The value of a key of `[robot]`, or an example and the question behind it.
    fn or_asked<T>(&mut self, theirs: &str, ours: &str, value: Option<T>, example: T) -> Option<T> {
        let is_open = self
            .open
            .iter()
            .any(|key| *key == format!("pose_convention.{theirs}") || key == "pose_convention");
        if value.is_some() && !is_open {
            return value;
        }
        let what = format!("[robot] {ours} is missing: pose_convention.{theirs} does not say it");
        self.draft.ask(&[&format!("robot.{ours}")], what.as_str());
        if !is_open {
            self.questions.push(what);
        }
        Some(example)
    }

    /// Where the numbers stand in the file of poses: under a key, or in columns.
    fn columns(
        &self,
        robot: &Tree,
        convention: Option<&Tree>,
    ) -> Result<(Option<Fields>, Vec<Column>), Error> {
        if text(robot, "format") == "jsonl" {
            let what =
                "robot_poses are lines of JSON, which are not read: put them into one JSON list";
            return Err(unusable(self.source, what));
        }
        if let Some(field) = robot.get("matrix_field").and_then(Tree::text) {
            return Ok((Some(Fields::One(format!("*.{field}"))), vec![]));
        }
        let Some(columns) = robot.get("columns").filter(|c| **c != Tree::Null) else {
            return Ok((None, vec![]));
        };
        let Some(Tree::List(rotation)) = columns.get("rotation") else {
            return Err(unusable(self.source, "robot_poses.columns has no list `rotation`"));
        };
        let place = ["tx", "ty", "tz"].map(|key| text(columns, key));
        let turn = rotation.iter().filter_map(Tree::text);
        let is_matrix =
            convention.is_some_and(|c| text(c, "rotation_format").starts_with("matrix"));
        let names = place.into_iter().filter(|_| !is_matrix).chain(turn);
        Ok((None, names.map(|name| Column::Name(name.into())).collect()))
    }

    /// The pattern of the images.
    fn images(&mut self, camera: &Tree) -> Result<String, Error> {
        let images = camera.get("images").unwrap_or(&Tree::Null);
        if let Some(pattern) = images.get("pattern").and_then(Tree::text) {
            if pattern.contains(['[', '{']) || pattern.contains("**") {
                let what =
                    format!("the pattern {pattern} has more than * and ?: which images are meant?");
                self.questions.push(what);
            }
            return Ok(pattern.into());
        }
        let Some(Tree::List(paths)) = images.get("paths") else {
            return Err(unusable(
                self.source,
                "the camera's images have neither pattern nor paths",
            ));
        };
        let pattern = industrial::pattern(paths.iter().filter_map(Tree::text), self.source)?;
        let found = files::expand(&split(self.source).0, &pattern, &Place::file(self.source))
            .map_or(0, |f| f.len());
        if found > paths.len() {
            let what = format!(
                "{pattern} are {found} images, and {} are listed: move the others away",
                paths.len()
            );
            self.questions.push(what);
        }
        Ok(pattern)
    }
}

fn notation(rotation_format: &str) -> Option<&'static str> {
    Some(match rotation_format {
        "quat_xyzw" => "quaternion-xyzw",
        "quat_wxyz" => "quaternion-wxyz",
        "euler_xyz_deg" | "euler_xyz_rad" => "euler-xyz-intrinsic",
        "euler_zyx_deg" | "euler_zyx_rad" => "euler-zyx-intrinsic",
        "axis_angle_rad" => "rotation-vector",
        "matrix4x4_row_major" => "matrix4x4",
        _ => return None,
    })
}

/// Its boards count inner corners of a chessboard, squares of a ChArUco board; sizes are metres.
fn board(target: &Tree) -> Option<TargetModel> {
    let count =
        |key: &str| target.get(key)?.number().filter(|n| (1.0..1e3).contains(n)).map(|n| n as u32);
    let mm = |key: &str| target.get(key)?.number().map(|m| (m * 1e9).round() * 1e-6);
    let (columns, rows) = (count("cols")?, count("rows")?);
    let model = match text(target, "kind") {
        "chessboard" => {
            TargetModel::Checkerboard { columns, rows, square_mm: mm("square_size_m")? }
        }
        "charuco" => TargetModel::Charuco {
            squares_x: columns,
            squares_y: rows,
            square_mm: mm("square_size_m")?,
            marker_mm: mm("marker_size_m")?,
            dictionary: text(target, "dictionary").into(),
            legacy: false,
            first_id: 0,
        },
        _ => return None,
    };
    model.check().ok().map(|()| model)
}
