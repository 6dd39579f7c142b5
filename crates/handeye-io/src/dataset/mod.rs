//! A folder of captures: its manifest `handeye.toml`, checked and put together.

mod answers;
mod conditions;
mod corners;
mod draft;
mod in_memory;
mod inputs;
mod joints_beside;
pub(crate) mod manifest;
mod motion;
mod opening;
mod pairing;
mod poses;
mod rereading;
mod robot_file;
pub(crate) mod shapes;
mod touches;

use std::path::{Path, PathBuf};

use handeye::{
    AnswerFrame, Base, Camera, Correspondence, Flange, GrayImage, ImageCorner, Intrinsics,
    LensSigma, Motion, Mount, Observation, Pose, Scan, Session, Setup, Target, TargetModel,
    TargetSize, Touch, Warning, Workspace,
    calibrate::result::{Equipment, FrameNames},
    intrinsics::LensModel,
    model::{kinematics::Arm, session::KnownPosition},
    tools::plan::GuessSigma,
};
use serde::{Deserialize, Serialize};

use crate::{
    bag,
    error::{Error, unusable},
    files, image,
    robot::Urdf,
    scan::{self, ScanOptions},
};
pub use answers::{OpenKey, OpenQuestion, answered_with, open_questions};
pub use draft::Question;
pub(crate) use draft::{Draft, EXAMPLE_TARGET};
pub use in_memory::{ImageSource, MemoryCapture, MemoryCell};
pub use manifest::PixelOrigin;
pub(crate) use manifest::{Manifest, Source};
pub(crate) use motion::TIMES;
use opening::Opening;
pub use poses::Writing;
pub(crate) use rereading::{Rereading, rereadings};
pub use robot_file::{RobotFile, RobotPoses, columns, read_robot_poses};
pub use shapes::Shape;
pub use touches::FIXED_BOARD;
pub(crate) use touches::without_labels;

/// Name of the manifest in a folder.
pub const MANIFEST: &str = "handeye.toml";

/// Everything a calibration needs; images and scans stay on disk until they are asked for.
#[derive(Debug, Clone)]
pub struct Dataset {
    /// The manifest's file.
    pub manifest: PathBuf,
    /// Where the camera is.
    pub setup: Setup,
    /// What the camera looks at; `None` with poses of the board, point pairs alone, or a shape.
    pub target: Option<TargetModel>,
    /// How well its size is known.
    pub target_size: TargetSize,
    /// In which frame the answer is wanted, where images and scans do not agree.
    pub answer_frame: Option<AnswerFrame>,
    /// What its frames are called elsewhere.
    pub frames: Option<FrameNames>,
    /// What stands in the cell.
    pub equipment: Equipment,
    /// All files that it names, and the manifest.
    pub inputs: Vec<PathBuf>,
    /// What takes a board's place, where scans are brought together by their shape.
    pub shape: Option<Shape>,
    /// What else the images may show, and is not used.
    pub other_targets: Vec<TargetModel>,
    /// The camera's intrinsics; `None` when they are to be calibrated from the views.
    pub intrinsics: Option<Intrinsics>,
    /// How well they are known, where that was stated.
    pub lens_sigma: Option<LensSigma>,
    /// The model of the lens to be calibrated from the views; beside given intrinsics, to check them.
    pub lens: Option<LensModel>,
    /// Width and height of the images (px) as the manifest has them.
    pub picture: Option<(u32, u32)>,
    /// Where corners of another program count their pixels from, as declared.
    pub pixel_origin: Option<PixelOrigin>,
    /// The captures, in order.
    pub captures: Vec<CaptureSource>,
    /// Where robot and captures were when, where the robot did not stop for them.
    pub motion: Option<Motion>,
    /// Boards that lay still and were touched.
    pub placements: Vec<PlacementSource>,
    /// Corners the robot touched.
    pub touches: Vec<Touch>,
    /// Points that camera and robot both know.
    pub correspondences: Vec<Correspondence>,
    /// The box in which the robot will work.
    pub workspace: Option<WorkspaceBox>,
    /// What is known of the camera's place on the mount.
    pub known_position: Option<KnownPosition>,
    /// Roughly where the camera sits, and how well that is known.
    pub guess: Option<Guess>,
    /// The robot's arm, where its poses come from joint values or a URDF is given.
    pub arm: Option<Arm>,
    /// The file that describes it, where that is a URDF.
    pub urdf: Option<Urdf>,
    /// What the manifest says of the noise.
    pub noise: Noise,
    /// What the job tolerates.
    pub limits: Limits,
    /// The notation of the robot's poses, which the user knows best.
    pub notation: Option<String>,
    /// What looked suspicious.
    pub warnings: Vec<Warning>,
    /// What names in the manifest are relative to.
    pub(crate) root: PathBuf,
    bit_depth: Option<u32>,
    scan_options: ScanOptions,
    /// Where images and scans come from, if not from files.
    memory: Option<in_memory::Memory>,
}

/// Roughly where the camera sits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guess {
    /// In the flange or the base.
    pub mount_from_camera: Pose<Mount, Camera>,
    /// How well it is known.
    pub sigma: GuessSigma,
}

/// One robot pose and the files of what the camera saw.
#[derive(Debug, Clone)]
pub struct CaptureSource {
    /// Name of the capture.
    pub id: String,
    /// What the robot reported.
    pub base_from_flange: Pose<Base, Flange>,
    /// Its joint values (rad, m), where it gave those.
    pub joints: Vec<f64>,
    /// When it was taken, by the camera's clock, s, where the robot did not stop for it.
    pub time_s: Option<f64>,
    /// The image's file.
    pub image: Option<PathBuf>,
    /// The scan's file.
    pub scan: Option<PathBuf>,
    /// Corners found by another program.
    pub corners: Option<Vec<ImageCorner>>,
    /// The board's pose found by another program.
    pub camera_from_target: Option<Pose<Camera, Target>>,
    /// Which record of the robot's file.
    pub(crate) robot_record: usize,
}

impl CaptureSource {
    /// What is known of it before its files are looked at.
    pub(crate) fn observation(&self) -> Observation {
        let bare = Observation::bare(self.id.clone(), self.base_from_flange, Pose::identity());
        let (joints, time_s) = (self.joints.clone(), self.time_s);
        Observation { joints, time_s, candidates: vec![], ..bare }
    }
}

impl Dataset {
    /// The session of these captures, with what the manifest says of cell and arm.
    pub(crate) fn session(&self, observations: Vec<Observation>) -> Session {
        Session {
            workspace: self.workspace.map(|w| w.corners),
            known_position: self.known_position,
            arm: self.arm.clone(),
            motion: self.motion.clone(),
            ..Session::of_captures(self.setup, observations)
        }
    }
}

/// A board lying still, and the files of what the camera saw of it.
#[derive(Debug, Clone)]
pub struct PlacementSource {
    /// Its name.
    pub id: String,
    /// The image's file.
    pub image: Option<PathBuf>,
    /// The scan's file.
    pub scan: Option<PathBuf>,
    /// Corners found by another program.
    pub corners: Option<Vec<ImageCorner>>,
    /// The board's pose found by another program.
    pub camera_from_target: Option<Pose<Camera, Target>>,
}

/// The frame a workspace box is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum WorkspaceFrame {
    /// The robot's base.
    Base,
    /// The camera.
    Camera,
}

/// The box in which the robot will work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorkspaceBox {
    /// The frame of its corners.
    pub frame: WorkspaceFrame,
    /// Its corners, m.
    pub corners: Workspace,
}

/// Standard deviations that the manifest declares; `None` is to be estimated.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Noise {
    /// Of a corner in the image, px.
    pub image_px: Option<f64>,
    /// Of the robot's position, m.
    pub robot_position: Option<f64>,
    /// Of the robot's rotation, rad.
    pub robot_rotation: Option<f64>,
    /// Of a point of a scan along the ray, m.
    pub depth: Option<f64>,
    /// Of a touch, m.
    pub touch: Option<f64>,
    /// Of the tool tip that the robot believes, m per axis.
    pub tip: Option<f64>,
}

/// What the job tolerates.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Limits {
    /// Largest error in the workspace, m.
    pub max_error: Option<f64>,
}

impl Dataset {
    /// Opens a folder with a manifest, or a manifest; names in it are relative to its folder.
    ///
    /// # Errors
    /// Whatever cannot be read, contradicts itself or leaves a convention open: see [`Error`].
    pub fn open(path: &Path) -> Result<Dataset, Error> {
        let manifest = if path.is_dir() { path.join(MANIFEST) } else { path.to_path_buf() };
        let root = manifest.parent().unwrap_or(Path::new("")).to_path_buf();
        Self::open_with_root(&manifest, &root)
    }

    /// Opens a manifest whose names are relative to another folder.
    ///
    /// # Errors
    /// As [`Dataset::open`].
    pub fn open_with_root(manifest: &Path, root: &Path) -> Result<Dataset, Error> {
        if manifest.is_file() && bag::is_bag(manifest) {
            return Err(unusable(manifest, bag::ADVICE));
        }
        let folder = manifest.parent().unwrap_or(Path::new(""));
        if manifest.file_name().is_some_and(|name| name == MANIFEST)
            && folder.is_dir()
            && !manifest.exists()
        {
            if bag::is_bag(folder) {
                return Err(unusable(folder, bag::ADVICE));
            }
            let name = folder.display();
            return Err(unusable(
                folder,
                format!("has no {MANIFEST} yet: `handeye init {name}` writes one"),
            ));
        }
        let source = Source { path: manifest.to_path_buf(), text: files::text(manifest)? };
        Self::of_source(source, root)
    }

    /// Opens the text of a manifest, wherever it stands.
    pub(crate) fn of_source(source: Source, root: &Path) -> Result<Dataset, Error> {
        Self::opening(source, root)?.dataset()
    }

    fn opening(source: Source, root: &Path) -> Result<Opening, Error> {
        let manifest = Manifest::parse(&source)?;
        // a folder that is given comes before that of the manifest
        let own = source.path.parent().unwrap_or(Path::new(""));
        let said = manifest.root.as_ref().filter(|_| root == own);
        let root = said.map_or_else(|| root.into(), |below| own.join(below));
        Ok(Opening { manifest, source, root })
    }

    /// What a manifest says of its cell, before there are captures.
    ///
    /// # Errors
    /// As [`Dataset::open`], but for files of captures, which may be missing.
    pub fn without_captures(manifest: &Path) -> Result<Dataset, Error> {
        let source = Source { path: manifest.to_path_buf(), text: files::text(manifest)? };
        Self::opening(source, manifest.parent().unwrap_or(Path::new("")))?.cell()
    }

    /// The text of its manifest; none of captures in memory.
    pub(crate) fn manifest_text(&self) -> Result<String, Error> {
        if self.is_in_memory() { Ok(String::new()) } else { files::text(&self.manifest) }
    }

    /// What it is called: its folder's name, or that of a manifest with a name of its own.
    pub fn title(&self) -> String {
        if self.is_in_memory() {
            return in_memory::NAME.into();
        }
        let whole = self.manifest.canonicalize().unwrap_or_else(|_| self.manifest.clone());
        let folder = whole.parent().and_then(|p| p.file_name());
        let file = self.manifest.file_stem();
        let name = if file.is_some_and(|f| f == "handeye") { folder.or(file) } else { file };
        name.map_or("dataset".into(), |n| n.to_string_lossy().into_owned())
    }

    /// On what depends what is found in the files of captures, as text.
    pub(crate) fn reading(&self) -> String {
        let Self { target, other_targets, intrinsics, bit_depth, scan_options, .. } = self;
        format!("{target:?} {other_targets:?} {intrinsics:?} {bit_depth:?} {scan_options:?}")
    }

    /// Reads a capture's or a placement's image.
    ///
    /// # Errors
    /// As [`crate::read_image`].
    pub fn image(&self, path: &Path) -> Result<GrayImage, Error> {
        match &self.memory {
            Some(memory) => memory.image(path),
            None => image::read_image(path, self.bit_depth),
        }
    }

    /// Reads a capture's or a placement's scan.
    ///
    /// # Errors
    /// As [`crate::read_scan`].
    pub fn scan(&self, path: &Path) -> Result<Scan, Error> {
        match &self.memory {
            Some(memory) => memory.scan(path),
            None => scan::read_scan(path, &self.scan_options),
        }
    }
}
