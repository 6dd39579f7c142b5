//! The manifest `handeye.toml`, key by key, and where each key stands.

use std::path::PathBuf;

use handeye::{
    AnswerFrame, Setup,
    calibrate::result::{Equipment, FrameNames},
};
#[cfg(test)]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::de::{DeTable, DeValue};

use super::{
    WorkspaceFrame, answers,
    draft::QUESTION,
    shapes::{ObjectSpec, SceneSpec, TargetSpec},
};
use crate::{
    camera::CameraSpec,
    error::{Error, Place, malformed, nearest},
    robot::{DhSpec, UrdfSpec},
    table::{Column, Layout},
    target_file::{self, in_words},
    units::{AngleUnit, LengthUnit},
};

#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct Manifest {
    /// Whether the robot carries the camera or the target.
    pub(crate) setup: Setup,
    /// Folder that all names of files are relative to, where it is not that of the manifest; relative to that.
    pub(crate) root: Option<String>,
    /// What the camera looks at; lengths in millimetres. Several, each with a name, where images show more than one;
    /// captures.target says which of them the calibration uses. Without a board: "scene", a still scene (eye-in-hand),
    /// or "object", an object of known shape, in scans.
    pub(crate) target: Option<TargetSpec>,
    /// Belongs to target = "scene"; optional.
    pub(crate) scene: Option<SceneSpec>,
    /// Belongs to target = "object".
    pub(crate) object: Option<ObjectSpec>,
    /// Intrinsics; without them they are calibrated from the views.
    pub(crate) camera: Option<CameraSpec>,
    /// What the robot reported at every capture.
    pub(crate) robot: Option<RobotSpec>,
    /// Images of the captures.
    pub(crate) images: Option<ImagesSpec>,
    /// Scans of the captures: point clouds or depth images.
    pub(crate) scans: Option<ScansSpec>,
    /// Poses of the board that another program found.
    pub(crate) board_poses: Option<BoardPosesSpec>,
    /// Corners that another program found.
    pub(crate) corners: Option<CornersSpec>,
    /// Points that both camera and robot measured.
    pub(crate) point_pairs: Option<PointPairsSpec>,
    /// Which files belong together, and which captures are used.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) captures: CapturesSpec,
    /// The robot did not stop for its captures; the offset of the two clocks is estimated.
    pub(crate) motion: Option<MotionSpec>,
    /// Boards that lay still and were touched.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) placements: Vec<PlacementSpec>,
    /// Corners that the robot touched.
    pub(crate) touches: Option<TouchesSpec>,
    /// The box in which the robot will work.
    pub(crate) workspace: Option<WorkspaceSpec>,
    /// The camera's position along one direction of the base (eye-to-hand) or flange (eye-in-hand).
    pub(crate) known_position: Option<KnownPositionSpec>,
    /// Roughly where the camera sits: for plans, before captures determine it.
    pub(crate) guess: Option<GuessSpec>,
    /// Standard deviations; those not given are estimated.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) noise: NoiseSpec,
    /// What the job tolerates.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) limits: LimitsSpec,
    /// What the answer is for.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) answer: AnswerSpec,
    /// What the frames are called in ROS and the like: for exports.
    pub(crate) frames: Option<FrameNames>,
    /// What stands in the cell: for those who ask years later which camera and robot a result is of.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) equipment: Equipment,
}

/// Whether a key has its default value.
fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// One name or several.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(untagged)]
pub(crate) enum Fields {
    One(String),
    Several(Vec<String>),
}

/// A name of a file, or the content itself.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(untagged)]
pub(crate) enum FileOr<T> {
    File(String),
    Inline(T),
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum RobotDirection {
    BaseFromFlange,
    FlangeFromBase,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum BoardDirection {
    CameraFromTarget,
    TargetFromCamera,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "lowercase")]
pub(crate) enum PoseFrame {
    #[default]
    Flange,
    Tool,
}

/// The robot's poses: where they stand, and how they are written.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct RobotSpec {
    /// A file of poses, or a pattern of files with one pose each.
    pub(crate) poses: String,
    /// Path of the values in a JSON or YAML document, such as poses.*.tcp; several are joined.
    pub(crate) field: Option<Fields>,
    /// How the poses are written, a name of [`crate::robot`].
    #[cfg_attr(test, schemars(required, description = notations()))]
    pub(crate) notation: Option<String>,
    /// Unit of lengths; needed for notations of no maker.
    pub(crate) length_unit: Option<LengthUnit>,
    /// Unit of angles; the notation's own unless said.
    pub(crate) angle_unit: Option<AngleUnit>,
    /// First and last record, from 1, both included.
    #[cfg_attr(test, schemars(regex(pattern = r"^\s*\d+\s*\.\.=?\s*\d+\s*$")))]
    pub(crate) rows: Option<String>,
    /// The columns in the notation's order, by number from 1 or by name.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) columns: Vec<Column>,
    /// Lines before the table.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) skip_header: usize,
    /// What the poses take to what.
    #[cfg_attr(test, schemars(required))]
    pub(crate) direction: Option<RobotDirection>,
    /// Whether the poses are of the flange (unless said) or of the tool.
    pub(crate) frame: Option<PoseFrame>,
    /// flange_from_tool
    pub(crate) tool: Option<ToolSpec>,
    /// The arm that joint values are of: Denavit-Hartenberg parameters, or a file of them.
    pub(crate) dh: Option<FileOr<DhSpec>>,
    /// The arm that joint values are of, in place of dh; or, with poses, the arm that has them: a table of poses may have its
    /// joint values beside them, in columns that are called as the joints.
    pub(crate) urdf: Option<UrdfSpec>,
}

/// What the schema says of a notation.
#[cfg(test)]
fn notations() -> String {
    format!("How the poses are written: {}.", crate::robot::names_in_words())
}

/// Poses of the board: where they stand, and how they are written.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct BoardPosesSpec {
    /// A file of poses, or a pattern of files with one pose each.
    pub(crate) poses: String,
    /// Path of the values in a JSON or YAML document, such as poses.*.tcp; several are joined.
    pub(crate) field: Option<Fields>,
    /// How the poses are written, a name of [`crate::robot`].
    #[cfg_attr(test, schemars(required, description = notations()))]
    pub(crate) notation: Option<String>,
    /// Unit of lengths; needed for notations of no maker.
    pub(crate) length_unit: Option<LengthUnit>,
    /// Unit of angles; the notation's own unless said.
    pub(crate) angle_unit: Option<AngleUnit>,
    /// First and last record, from 1, both included.
    #[cfg_attr(test, schemars(regex(pattern = r"^\s*\d+\s*\.\.=?\s*\d+\s*$")))]
    pub(crate) rows: Option<String>,
    /// The columns in the notation's order, by number from 1 or by name.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) columns: Vec<Column>,
    /// Lines before the table.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) skip_header: usize,
    /// What the poses take to what.
    #[cfg_attr(test, schemars(required))]
    pub(crate) direction: Option<BoardDirection>,
}

/// A table of poses: the keys that [robot] and [board_poses] share, and the arm.
#[derive(Debug, Clone, Default)]
pub(super) struct PoseTable {
    pub(super) field: Option<Fields>,
    pub(super) poses: String,
    pub(super) notation: Option<String>,
    pub(super) length_unit: Option<LengthUnit>,
    pub(super) angle_unit: Option<AngleUnit>,
    pub(super) rows: Option<String>,
    pub(super) columns: Vec<Column>,
    pub(super) skip_header: usize,
    pub(super) arm: Option<ArmSpec>,
}

/// The model of the arm that joint values are of.
#[derive(Debug, Clone)]
pub(super) enum ArmSpec {
    Dh(FileOr<DhSpec>),
    Urdf(UrdfSpec),
}

impl BoardPosesSpec {
    pub(super) fn table(&self) -> PoseTable {
        PoseTable {
            poses: self.poses.clone(),
            field: self.field.clone(),
            notation: self.notation.clone(),
            length_unit: self.length_unit,
            angle_unit: self.angle_unit,
            rows: self.rows.clone(),
            columns: self.columns.clone(),
            skip_header: self.skip_header,
            arm: None,
        }
    }
}

impl RobotSpec {
    pub(super) fn table(&self) -> PoseTable {
        PoseTable {
            poses: self.poses.clone(),
            field: self.field.clone(),
            notation: self.notation.clone(),
            length_unit: self.length_unit,
            angle_unit: self.angle_unit,
            rows: self.rows.clone(),
            columns: self.columns.clone(),
            skip_header: self.skip_header,
            arm: None,
        }
    }

    /// The table with the model of the arm; a manifest names one, not two.
    pub(super) fn with_arm(&self, source: &Source) -> Result<PoseTable, Error> {
        let arm = match (&self.dh, &self.urdf) {
            (Some(_), Some(_)) => {
                let what = "two models of the arm, dh and urdf";
                return Err(malformed(source.place("robot.urdf"), what, "leave one of them out"));
            }
            (Some(dh), None) => Some(ArmSpec::Dh(dh.clone())),
            (None, urdf) => urdf.clone().map(ArmSpec::Urdf),
        };
        Ok(PoseTable { arm, ..self.table() })
    }
}

/// Pose of the tool on the flange.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ToolSpec {
    /// Where it is on the flange.
    pub(crate) translation_mm: [f64; 3],
    /// Its rotation on the flange.
    pub(crate) rotation_xyzw: [f64; 4],
}

/// Images of the captures.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ImagesSpec {
    /// The files, by a pattern.
    pub(crate) files: String,
    /// Bits of a pixel that are used, where the file has more.
    pub(crate) bit_depth: Option<u32>,
}

impl ImagesSpec {
    /// All the images of a pattern.
    pub(crate) fn of(files: impl Into<String>) -> Self {
        Self { files: files.into(), bit_depth: None }
    }
}

/// Scans of the captures.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ScansSpec {
    /// The files, by a pattern.
    pub(crate) files: String,
    /// Unit of lengths, where the files do not say it.
    pub(crate) length_unit: Option<LengthUnit>,
    /// Metres per unit of depth.
    pub(crate) depth_scale: Option<f64>,
    /// Width and height of the grid that the points of a file are in.
    pub(crate) organised: Option<(usize, usize)>,
    /// Intrinsics of the depth images; by default those of the images.
    pub(crate) camera: Option<CameraSpec>,
}

/// What pixel (0, 0) is, to the program that found the corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum PixelOrigin {
    /// The centre of the first pixel: OpenCV's convention, and that of this program.
    Centre,
    /// The outer corner of the first pixel.
    Corner,
}

/// Corners that another program found.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct CornersSpec {
    /// The files, by a pattern: a table of corners for each capture.
    pub(crate) files: String,
    /// Where in the first pixel (0, 0) is. ChArUco corners of OpenCV 4.9 to 4.13: corner.
    #[cfg_attr(test, schemars(required))]
    pub(crate) pixel_origin: Option<PixelOrigin>,
}

/// Points that camera and robot both measured.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PointPairsSpec {
    /// The points as the camera measured them.
    pub(crate) camera: PointsSpec,
    /// The same points as the robot measured them.
    pub(crate) robot: PointsSpec,
}

/// A table of points.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PointsSpec {
    /// A table of points.
    pub(crate) file: String,
    /// Path of the values in a JSON or YAML document, such as poses.*.tcp; several are joined.
    pub(crate) field: Option<Fields>,
    /// Unit of the points.
    #[cfg_attr(test, schemars(required))]
    pub(crate) length_unit: Option<LengthUnit>,
    /// The columns of x, y and z, by number from 1 or by name.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) columns: Vec<Column>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "lowercase")]
pub(crate) enum Pairing {
    #[default]
    Order,
    Number,
}

/// Which files belong together, and which captures are used.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct CapturesSpec {
    /// Whether the n-th files belong together, or those of one number in their names.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) pairing: Pairing,
    /// The name of the target that the calibration uses, where there are several.
    pub(crate) target: Option<String>,
    /// Names of captures that are not used.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) exclude: Vec<String>,
}

/// A robot that did not stop for its captures.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct MotionSpec {
    /// Table with the columns image and time_s: when each capture was taken, by the camera's clock. The robot's poses
    /// have a column time_s of their own.
    pub(crate) times: String,
}

/// A board that lay still and was touched.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PlacementSpec {
    /// Its name.
    pub(crate) id: String,
    /// An image of the board there.
    pub(crate) image: Option<String>,
    /// A scan of the board there.
    pub(crate) scan: Option<String>,
    /// A table of its corners, found by another program.
    pub(crate) corners: Option<String>,
    /// Its pose, found by another program.
    pub(crate) board_pose: Option<Vec<f64>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub(crate) enum TouchKind {
    Tip,
    FlangePose,
    Joints,
}

/// Corners that the robot touched.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct TouchesSpec {
    /// A table of touches.
    pub(crate) file: Option<String>,
    /// Path of the values in a JSON or YAML document, such as poses.*.tcp; several are joined.
    pub(crate) field: Option<Fields>,
    /// What was recorded: the point of the tip, the pose of the flange, or joint values.
    #[cfg_attr(test, schemars(required))]
    pub(crate) kind: Option<TouchKind>,
    /// How the poses are written, as in [robot].
    pub(crate) notation: Option<String>,
    /// Unit of lengths.
    pub(crate) length_unit: Option<LengthUnit>,
    /// Unit of angles.
    pub(crate) angle_unit: Option<AngleUnit>,
    /// The tip of the touching tool.
    pub(crate) tip: Option<TipSpec>,
    /// The touches themselves, in place of a file.
    #[serde(default, skip_serializing_if = "is_default")]
    pub(crate) points: Vec<TouchPoint>,
}

/// The tip of a touching tool.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct TipSpec {
    /// Where it is on the flange.
    pub(crate) in_flange_mm: [f64; 3],
}

/// One touch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct TouchPoint {
    /// Where the board lay.
    pub(crate) placement: Option<String>,
    /// Which corner.
    pub(crate) corner: Option<u32>,
    /// Its row, in place of corner.
    pub(crate) row: Option<u32>,
    /// Its column, in place of corner.
    pub(crate) column: Option<u32>,
    /// What the robot reported.
    pub(crate) values: Vec<f64>,
}

/// The box in which the robot will work.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct WorkspaceSpec {
    /// The frame of the box.
    pub(crate) frame: WorkspaceFrame,
    /// Least x, y and z.
    pub(crate) minimum_mm: [f64; 3],
    /// Largest x, y and z.
    pub(crate) maximum_mm: [f64; 3],
}

/// The camera's position along one direction of the base (eye-to-hand) or flange (eye-in-hand).
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct KnownPositionSpec {
    /// The direction.
    pub(crate) axis: [f64; 3],
    /// The position along it.
    pub(crate) value_mm: f64,
    /// Its standard deviation.
    pub(crate) sigma_mm: f64,
}

/// Roughly where the camera sits, in the frame of what carries it: the flange (eye-in-hand) or the base (eye-to-hand).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct GuessSpec {
    /// Its position.
    pub(crate) translation_mm: [f64; 3],
    /// The direction of its optical axis; [0, 0, 1] is along z.
    pub(crate) optical_axis: [f64; 3],
    /// The direction that is to the right in the image.
    pub(crate) image_x: [f64; 3],
    /// How well the position is known, along each axis; 30 unless said.
    pub(crate) sigma_mm: Option<f64>,
    /// How well the direction is known, about each axis; 6 unless said.
    pub(crate) sigma_deg: Option<f64>,
}

/// Standard deviations.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct NoiseSpec {
    /// Of a corner in an image.
    pub(crate) image_px: Option<f64>,
    /// Of the robot's position.
    pub(crate) robot_position_mm: Option<f64>,
    /// Of the robot's rotation.
    pub(crate) robot_rotation_deg: Option<f64>,
    /// Of a point of a scan.
    pub(crate) depth_mm: Option<f64>,
    /// Of a touch.
    pub(crate) touch_mm: Option<f64>,
    /// Of the tip's offset.
    pub(crate) tip_mm: Option<f64>,
}

/// What the job tolerates.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct LimitsSpec {
    /// Tolerated error, 95 %.
    pub(crate) max_error_mm: Option<f64>,
}

/// What the answer is for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct AnswerSpec {
    /// The frame of the camera, where images and scans do not agree: that of the scans, if there are any, or that of
    /// the images.
    pub(crate) frame: Option<FrameSpec>,
    /// Tolerated error, 95 %; as in limits.
    pub(crate) max_error_mm: Option<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(JsonSchema))]
#[serde(rename_all = "lowercase")]
pub(crate) enum FrameSpec {
    Scan,
    Image,
}

impl From<FrameSpec> for AnswerFrame {
    fn from(spec: FrameSpec) -> Self {
        match spec {
            FrameSpec::Image => Self::Image,
            FrameSpec::Scan => Self::Scan,
        }
    }
}

impl Manifest {
    /// A manifest that says nothing else.
    pub(crate) fn new(setup: Setup) -> Manifest {
        Manifest {
            setup,
            root: None,
            target: None,
            scene: None,
            object: None,
            camera: None,
            robot: None,
            images: None,
            scans: None,
            board_poses: None,
            corners: None,
            point_pairs: None,
            captures: CapturesSpec::default(),
            motion: None,
            placements: vec![],
            touches: None,
            workspace: None,
            known_position: None,
            guess: None,
            noise: NoiseSpec::default(),
            limits: LimitsSpec::default(),
            answer: AnswerSpec::default(),
            frames: None,
            equipment: Equipment::default(),
        }
    }

    /// Reads the text of a manifest; every error has its line.
    pub(crate) fn parse(source: &Source) -> Result<Manifest, Error> {
        toml::from_str(&source.text).map_err(|e| {
            let line = e.span().map(|span| source.line_at(span.start));
            let place = Place { line, ..Place::file(&source.path) };
            let what = in_words(e.message());
            let advice = advice(e.message()) + &open_questions(&source.text);
            malformed(place, what, advice)
        })
    }
}

/// The key that was probably meant, out of a message that lists all of them.
fn advice(message: &str) -> String {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let near = match &quoted[..] {
        [wrong, known @ ..] if message.starts_with("unknown") => {
            nearest(wrong, known.iter().copied())
        }
        _ => None,
    };
    if let Some(key) = near {
        return format!("did you mean {key}?");
    }
    match message.strip_prefix("missing field ").map(|name| name.trim().trim_matches('`')) {
        Some("kind") => target_file::advice(),
        Some("setup") => "write setup = \"eye-in-hand\" where the robot carries the camera, or \
                          setup = \"eye-to-hand\" where it carries the target, above all tables"
            .into(),
        Some(key) => format!("write {key} = ... there"),
        None => "correct the manifest".into(),
    }
}

/// Where a first manifest still waits for answers: whatever is missing is asked there.
fn open_questions(text: &str) -> String {
    let asked = |line: &str| line.trim_start().starts_with(QUESTION);
    let lines: Vec<String> = (1..)
        .zip(text.lines())
        .filter(|(_, line)| asked(line))
        .map(|(number, _)| number.to_string())
        .collect();
    match &lines[..] {
        [] => String::new(),
        [one] => format!(
            ". A QUESTION is open in line {one}: correct what is below it, and remove the #"
        ),
        several => format!(
            ". QUESTIONs are open in lines {}: correct what is below each, and remove the #",
            several.join(", ")
        ),
    }
}

/// A manifest's text, for finding its lines.
pub(crate) struct Source {
    pub(crate) path: PathBuf,
    pub(crate) text: String,
}

impl Source {
    fn line_at(&self, byte: usize) -> usize {
        1 + self.text.as_bytes()[..byte.min(self.text.len())]
            .iter()
            .filter(|b| **b == b'\n')
            .count()
    }

    /// Where a key like `robot.length_unit` stands, or the nearest table around it.
    pub(super) fn place(&self, key: &str) -> Place {
        let byte = DeTable::parse(&self.text).ok().and_then(|table| position(table.get_ref(), key));
        Place {
            file: self.path.clone(),
            line: byte.map(|b| self.line_at(b)),
            field: Some(key.into()),
        }
    }

    /// Whether a key is commented out below a question that nobody has answered.
    pub(super) fn waits_for(&self, key: &str) -> bool {
        let open = answers::open_questions(&self.text);
        open.iter().flat_map(|question| &question.keys).any(|open| open.name == key)
    }

    /// An error about a key that is missing.
    pub(super) fn undeclared(&self, key: &str, question: &str) -> Error {
        let place = Place { field: None, ..self.place(key) };
        Error::Undeclared { place, key: key.into(), question: question.into() }
    }
}

fn position(table: &DeTable, key: &str) -> Option<usize> {
    let (first, rest) = key.split_once('.').unwrap_or((key, ""));
    let (found, value) = table.iter().find(|(k, _)| k.get_ref() == first)?;
    let inner = match value.get_ref() {
        DeValue::Table(inner) if !rest.is_empty() => position(inner, rest),
        _ => None,
    };
    inner.or(Some(found.span().start))
}

impl PoseTable {
    /// Which records and values of the files are meant; `at` is the manifest's table.
    pub(super) fn layout(
        &self,
        matrices: bool,
        at: &str,
        source: &Source,
    ) -> Result<Layout, Error> {
        let rows = self.rows.as_deref().map(|rows| row_range(rows, at, source)).transpose()?;
        Ok(Layout {
            fields: fields(&self.field),
            rows,
            columns: self.columns.clone(),
            skip_lines: self.skip_header,
            matrices,
        })
    }
}

pub(super) fn fields(field: &Option<Fields>) -> Vec<String> {
    match field {
        None => vec![],
        Some(Fields::One(one)) => vec![one.clone()],
        Some(Fields::Several(several)) => several.clone(),
    }
}

fn row_range(rows: &str, at: &str, source: &Source) -> Result<(usize, usize), Error> {
    let range = rows.split_once("..").and_then(|(first, last)| {
        Some((first.trim().parse().ok()?, last.trim_start_matches('=').trim().parse().ok()?))
    });
    range.ok_or_else(|| {
        let place = source.place(&format!("{at}.rows"));
        malformed(place, format!("rows = \"{rows}\" is no range"), "write rows = \"1..52\"")
    })
}
