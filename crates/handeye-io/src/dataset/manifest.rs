//! The manifest `handeye.toml`, key by key, and where each key stands.

use std::path::PathBuf;

use handeye::Setup;
use serde::Deserialize;
use toml::de::{DeTable, DeValue};

use super::shapes::{ObjectSpec, SceneSpec, TargetSpec};
use crate::{
    camera::CameraSpec,
    error::{Error, Place, malformed, nearest},
    init::QUESTION,
    robot::{DhSpec, UrdfSpec},
    table::{Column, Layout},
    target_file::{self, in_words},
    units::{AngleUnit, LengthUnit},
};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Manifest {
    pub(super) setup: Setup,
    pub(super) target: Option<TargetSpec>,
    pub(super) scene: Option<SceneSpec>,
    pub(super) object: Option<ObjectSpec>,
    pub(super) camera: Option<CameraSpec>,
    pub(super) robot: Option<RobotSpec>,
    pub(super) images: Option<ImagesSpec>,
    pub(super) scans: Option<ScansSpec>,
    pub(super) board_poses: Option<BoardPosesSpec>,
    pub(super) corners: Option<CornersSpec>,
    pub(super) point_pairs: Option<PointPairsSpec>,
    #[serde(default)]
    pub(super) captures: CapturesSpec,
    pub(super) motion: Option<MotionSpec>,
    #[serde(default)]
    pub(super) placements: Vec<PlacementSpec>,
    pub(super) touches: Option<TouchesSpec>,
    pub(super) workspace: Option<WorkspaceSpec>,
    pub(super) known_position: Option<KnownPositionSpec>,
    #[serde(default)]
    pub(super) noise: NoiseSpec,
    #[serde(default)]
    pub(super) limits: LimitsSpec,
    #[serde(default)]
    pub(super) answer: AnswerSpec,
}

/// One name or several.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub(super) enum Fields {
    One(String),
    Several(Vec<String>),
}

/// A name of a file, or the content itself.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub(super) enum FileOr<T> {
    File(String),
    Inline(T),
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum RobotDirection {
    BaseFromFlange,
    FlangeFromBase,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum BoardDirection {
    CameraFromTarget,
    TargetFromCamera,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum PoseFrame {
    #[default]
    Flange,
    Tool,
}

/// A table of poses: the keys that [robot] and [board_poses] share.
#[derive(Debug, Clone, Default)]
pub(super) struct PoseTable {
    pub(super) poses: String,
    pub(super) field: Option<Fields>,
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

macro_rules! pose_table { ($Spec:ident { $($field:ident: $Kind:ty,)* }) => {
    #[derive(Debug, Clone, Deserialize)]
    #[serde(deny_unknown_fields)]
    pub(super) struct $Spec {
        pub(super) poses: String,
        field: Option<Fields>,
        notation: Option<String>,
        length_unit: Option<LengthUnit>,
        angle_unit: Option<AngleUnit>,
        rows: Option<String>,
        #[serde(default)]
        columns: Vec<Column>,
        #[serde(default)]
        skip_header: usize,
        $(#[serde(default)] pub(super) $field: $Kind,)*
    }
    impl $Spec {
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
} }

pose_table!(RobotSpec {
    direction: Option<RobotDirection>,
    frame: PoseFrame,
    tool: Option<ToolSpec>,
    dh: Option<FileOr<DhSpec>>,
    urdf: Option<UrdfSpec>,
});
pose_table!(BoardPosesSpec {
    direction: Option<BoardDirection>,
});

impl RobotSpec {
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

/// Where the tool sits on the flange.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ToolSpec {
    pub(super) translation_mm: [f64; 3],
    pub(super) rotation_xyzw: [f64; 4],
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ImagesSpec {
    pub(super) files: String,
    pub(super) bit_depth: Option<u32>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ScansSpec {
    pub(super) files: String,
    pub(super) length_unit: Option<LengthUnit>,
    pub(super) depth_scale: Option<f64>,
    pub(super) organised: Option<(usize, usize)>,
    pub(super) camera: Option<CameraSpec>,
}

/// What pixel (0, 0) is, to the program that found the corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PixelOrigin {
    /// The centre of the first pixel: OpenCV's convention, and that of this program.
    Centre,
    /// The outer corner of the first pixel.
    Corner,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CornersSpec {
    pub(super) files: String,
    pub(super) pixel_origin: Option<PixelOrigin>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PointPairsSpec {
    pub(super) camera: PointsSpec,
    pub(super) robot: PointsSpec,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PointsSpec {
    pub(super) file: String,
    pub(super) field: Option<Fields>,
    pub(super) length_unit: Option<LengthUnit>,
    #[serde(default)]
    pub(super) columns: Vec<Column>,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Pairing {
    #[default]
    Order,
    Number,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CapturesSpec {
    #[serde(default)]
    pub(super) pairing: Pairing,
    pub(super) target: Option<String>,
    #[serde(default)]
    pub(super) exclude: Vec<String>,
}

/// A robot that did not stop for its captures.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MotionSpec {
    pub(super) times: String,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlacementSpec {
    pub(super) id: String,
    pub(super) image: Option<String>,
    pub(super) scan: Option<String>,
    pub(super) corners: Option<String>,
    pub(super) board_pose: Option<Vec<f64>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum TouchKind {
    Tip,
    FlangePose,
    Joints,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TouchesSpec {
    pub(super) file: Option<String>,
    pub(super) field: Option<Fields>,
    pub(super) kind: Option<TouchKind>,
    pub(super) notation: Option<String>,
    pub(super) length_unit: Option<LengthUnit>,
    pub(super) angle_unit: Option<AngleUnit>,
    pub(super) tip: Option<TipSpec>,
    #[serde(default)]
    pub(super) points: Vec<TouchPoint>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TipSpec {
    pub(super) in_flange_mm: [f64; 3],
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TouchPoint {
    pub(super) placement: Option<String>,
    pub(super) corner: Option<u32>,
    pub(super) row: Option<u32>,
    pub(super) column: Option<u32>,
    pub(super) values: Vec<f64>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WorkspaceSpec {
    pub(super) frame: super::WorkspaceFrame,
    pub(super) minimum_mm: [f64; 3],
    pub(super) maximum_mm: [f64; 3],
}

/// The camera's position along one direction of the base (eye-to-hand) or flange (eye-in-hand).
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct KnownPositionSpec {
    pub(super) axis: [f64; 3],
    pub(super) value_mm: f64,
    pub(super) sigma_mm: f64,
}

#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NoiseSpec {
    pub(super) image_px: Option<f64>,
    pub(super) robot_position_mm: Option<f64>,
    pub(super) robot_rotation_deg: Option<f64>,
    pub(super) depth_mm: Option<f64>,
    pub(super) touch_mm: Option<f64>,
    pub(super) tip_mm: Option<f64>,
}

#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LimitsSpec {
    pub(super) max_error_mm: Option<f64>,
}

/// What the answer is for.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AnswerSpec {
    pub(super) frame: Option<FrameSpec>,
    pub(super) max_error_mm: Option<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum FrameSpec {
    Scan,
    Image,
}

impl Manifest {
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
        Some("kind") => target_file::ADVICE.into(),
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
