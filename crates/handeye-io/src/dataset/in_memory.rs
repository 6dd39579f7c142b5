//! Captures whose images and scans stand in memory.

use std::{
    fmt,
    path::{Path, PathBuf},
    sync::Arc,
};

use handeye::{
    Base, Flange, GrayImage, Pose, Scan, Setup, TargetModel, estimate::noise::KnownNoise,
};

use super::{CaptureSource, Dataset, Limits, Noise};
use crate::{
    camera::{self, CameraSpec},
    error::{Error, Place, malformed},
    scan::ScanOptions,
};

/// Gives the images and scans of captures by the name of the capture, whenever they are asked for and from any thread.
pub trait ImageSource: Send + Sync {
    /// The capture's image.
    ///
    /// # Errors
    /// What was given is no image.
    fn image(&self, capture: &str) -> Result<GrayImage, Error>;

    /// The capture's scan, m.
    ///
    /// # Errors
    /// What was given is no scan.
    fn scan(&self, capture: &str) -> Result<Scan, Error>;
}

/// Where a dataset's images and scans come from, if not from files.
#[derive(Clone)]
pub(super) struct Memory(Arc<dyn ImageSource>);

impl fmt::Debug for Memory {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("Memory")
    }
}

impl Memory {
    pub(super) fn image(&self, capture: &Path) -> Result<GrayImage, Error> {
        self.0.image(&capture.to_string_lossy())
    }

    /// Width and height of the first image, if there is one.
    fn image_size(&self, captures: &[CaptureSource]) -> Result<Option<(u32, u32)>, Error> {
        let Some(first) = captures.iter().find(|c| c.image.is_some()) else { return Ok(None) };
        let image = self.0.image(&first.id).map_err(|e| e.in_capture(&first.id))?;
        Ok(Some((image.width() as u32, image.height() as u32)))
    }

    pub(super) fn scan(&self, capture: &Path) -> Result<Scan, Error> {
        self.0.scan(&capture.to_string_lossy())
    }
}

/// A capture in memory.
#[derive(Debug, Clone)]
pub struct MemoryCapture {
    /// Its name.
    pub id: String,
    /// What the robot reported.
    pub base_from_flange: Pose<Base, Flange>,
    /// Whether there is an image of it.
    pub has_image: bool,
    /// Whether there is a scan of it.
    pub has_scan: bool,
}

/// What is known of a cell whose captures stand in memory.
#[derive(Debug, Clone)]
pub struct MemoryCell<'a> {
    /// Where the camera is.
    pub setup: Setup,
    /// What it looks at.
    pub target: TargetModel,
    /// The keys of `[camera]` of a manifest, as JSON; without it the intrinsics are calibrated from the views.
    pub camera_json: Option<&'a str>,
    /// Noise that is known.
    pub noise: KnownNoise,
    /// What the job tolerates.
    pub limits: Limits,
}

/// Stands where a manifest would be named.
pub(super) const NAME: &str = "captures in memory";

impl Dataset {
    /// Captures in memory in place of a folder; names are those of captures where files would be named.
    ///
    /// # Errors
    /// A camera that is none, a target that is none, an image that cannot be used.
    pub fn in_memory(
        cell: MemoryCell,
        captures: Vec<MemoryCapture>,
        images: Arc<dyn ImageSource>,
    ) -> Result<Self, Error> {
        let memory = Memory(images);
        let captures: Vec<CaptureSource> = captures.into_iter().enumerate().map(source).collect();
        let Some(text) = cell.camera_json else {
            return Ok(Self { captures, ..Self::without_files(cell, memory) });
        };
        let place = Place::field(Path::new(NAME), "camera");
        let spec: CameraSpec = serde_json::from_str(text).map_err(|e| {
            let advice = "give the keys of [camera] of a manifest, such as fx, fy, cx, cy";
            malformed(place.clone(), format!("no intrinsics: {e}"), advice)
        })?;
        let size = memory.image_size(&captures)?;
        let given = Some(&spec).filter(|spec| !spec.is_open());
        let intrinsics = given.map(|s| camera::read(s, Path::new(""), &place, size)).transpose()?;
        let lens_sigma =
            spec.sigma().map_err(|what| malformed(place, what, "give it in pixels"))?;
        Ok(Self {
            captures,
            intrinsics,
            lens_sigma,
            lens: spec.calibrate,
            ..Self::without_files(cell, memory)
        })
    }

    /// Without captures and without a camera.
    fn without_files(cell: MemoryCell, memory: Memory) -> Self {
        let MemoryCell { setup, target, noise: known, limits, .. } = cell;
        let noise = Noise {
            robot_position: known.robot_position_m,
            robot_rotation: known.robot_rotation_rad,
            touch: known.touch_m,
            tip: known.tip_m,
            ..Noise::default()
        };
        Self {
            manifest: PathBuf::from(NAME),
            setup,
            target: Some(target),
            target_size: Default::default(),
            answer_frame: None,
            frames: None,
            equipment: Default::default(),
            inputs: vec![],
            shape: None,
            other_targets: vec![],
            intrinsics: None,
            lens_sigma: None,
            lens: None,
            picture: None,
            pixel_origin: None,
            captures: vec![],
            motion: None,
            placements: vec![],
            touches: vec![],
            correspondences: vec![],
            workspace: None,
            known_position: None,
            guess: None,
            arm: None,
            urdf: None,
            noise,
            limits,
            notation: None,
            warnings: vec![],
            root: PathBuf::new(),
            bit_depth: None,
            scan_options: ScanOptions::default(),
            memory: Some(memory),
        }
    }

    /// Whether it names no files, its manifest included.
    pub(crate) fn is_in_memory(&self) -> bool {
        self.memory.is_some()
    }
}

fn source((robot_record, capture): (usize, MemoryCapture)) -> CaptureSource {
    let MemoryCapture { id, base_from_flange, has_image, has_scan } = capture;
    CaptureSource {
        image: has_image.then(|| PathBuf::from(&id)),
        scan: has_scan.then(|| PathBuf::from(&id)),
        id,
        base_from_flange,
        joints: vec![],
        time_s: None,
        corners: None,
        camera_from_target: None,
        robot_record,
    }
}
