//! The manifest of a session's folder.

use handeye::{Camera, Intrinsics, Mount, Pose, Setup, TargetModel};
use serde::{Deserialize, Serialize};

use super::StoredPlacement;
use crate::{
    camera::CameraSpec,
    dataset::{
        Draft,
        manifest::{
            GuessSpec, ImagesSpec, LimitsSpec, Pairing, PlacementSpec, RobotDirection, RobotSpec,
            ScansSpec, TipSpec, TouchKind, TouchesSpec,
        },
    },
    robot::{Notation, UrdfSpec},
    units::LengthUnit,
};

/// What is known of a cell before its captures are taken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CellSettings {
    /// Who carries the camera.
    pub setup: Setup,
    /// What it looks at.
    pub target: TargetModel,
    /// The camera; without intrinsics they are calibrated from the views.
    pub intrinsics: Option<Intrinsics>,
    /// Error that is tolerated (95 %), mm.
    pub tolerance_mm: f64,
    /// How poses are typed and shown, a name of a robot's notation.
    pub notation: String,
    /// Roughly where the camera sits, with standard deviations (mm, degrees).
    pub guess: Option<CameraGuess>,
    /// Where the tip of the tool that touches corners is in the flange, mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip_mm: Option<[f64; 3]>,
    /// How the scans are read that come with the images; `None` where none come, or their files are metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scans: Option<ScanSettings>,
    /// The robot's model, a URDF in the folder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arm: Option<ArmLinks>,
}

/// The links of a URDF between which the arm is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ArmLinks {
    /// The link that is the robot's base.
    pub base: String,
    /// The link that is its flange.
    pub flange: String,
}

/// What the files of scans do not say.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ScanSettings {
    /// Unit of the coordinates of points, where the file or its format does not say it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length_unit: Option<LengthUnit>,
    /// Metres per unit of depth images.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth_scale: Option<f64>,
}

impl ScanSettings {
    /// Points in metres.
    pub const METRES: Self = Self { length_unit: Some(LengthUnit::Metre), depth_scale: None };
}

impl CellSettings {
    /// Whether captures of the one are captures of the other: all but what is tolerated, how poses are written, the
    /// tool that touches corners, and the robot's model.
    pub fn is_of_same_cell(&self, other: &Self) -> bool {
        let metres = |of: &Self| Some(of.scans.unwrap_or(ScanSettings::METRES));
        let Self { tolerance_mm, notation, tip_mm, arm, .. } = self.clone();
        let (own, of_other) = (metres(self), metres(other));
        Self { scans: own, ..self.clone() }
            == Self { tolerance_mm, notation, tip_mm, arm, scans: of_other, ..other.clone() }
    }
}

/// Roughly where a camera sits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CameraGuess {
    /// In the flange or the base.
    pub mount_from_camera: Pose<Mount, Camera>,
    /// How well its position is known, along each axis, mm.
    pub sigma_mm: f64,
    /// How well its direction is known, about each axis, degrees.
    pub sigma_deg: f64,
}

/// What a session's folder holds beside images and poses.
pub(super) struct Held<'a> {
    pub(super) has_scans: bool,
    pub(super) has_touches: bool,
    pub(super) placements: Vec<&'a StoredPlacement>,
    /// Whether joint values stand beside the poses.
    pub(super) has_joints: bool,
}

/// The text of the manifest.
pub(super) fn text(settings: &CellSettings, held: &Held) -> String {
    let mut draft = Draft::new();
    draft.head("The captures of a session; `handeye session` goes on with it, `handeye calibrate` calibrates it.");
    draft.set_target(settings.target.clone());
    let units = Notation::named(&settings.notation).ok().map(|notation| notation.own_units());
    let m = &mut draft.manifest;
    m.setup = settings.setup;
    m.camera = Some(camera(settings.intrinsics.as_ref()));
    m.robot = Some(RobotSpec {
        poses: "robot.csv".into(),
        direction: Some(RobotDirection::BaseFromFlange),
        notation: Some(settings.notation.clone()),
        length_unit: units.map(|units| units.length),
        angle_unit: units.filter(|_| held.has_joints).map(|units| units.angle),
        urdf: settings.arm.as_ref().map(|links| UrdfSpec {
            file: super::URDF.into(),
            base: links.base.clone(),
            flange: links.flange.clone(),
        }),
        ..RobotSpec::default()
    });
    // both are paired by the number in their names: a capture that is half there is not used
    m.captures.pairing = Pairing::Number;
    m.images = Some(ImagesSpec::of("images/*"));
    m.touches = settings.tip_mm.filter(|_| held.has_touches).map(|in_flange_mm| TouchesSpec {
        file: Some(super::TOUCHES.into()),
        kind: Some(TouchKind::FlangePose),
        tip: Some(TipSpec { in_flange_mm }),
        ..TouchesSpec::default()
    });
    let ScanSettings { length_unit, depth_scale } = settings.scans.unwrap_or(ScanSettings::METRES);
    m.placements = held.placements.iter().map(|placement| placement_keys(placement)).collect();
    m.scans = held.has_scans.then(|| ScansSpec {
        files: "scans/*".into(),
        length_unit,
        depth_scale,
        ..ScansSpec::default()
    });
    m.limits = LimitsSpec { max_error_mm: Some(settings.tolerance_mm) };
    m.guess = settings.guess.map(|guess| guess_keys(&guess));
    draft.written().0
}

fn camera(intrinsics: Option<&Intrinsics>) -> CameraSpec {
    match intrinsics {
        Some(camera) => crate::simulated::camera(camera),
        None => CameraSpec {
            calibrate: Some(handeye::intrinsics::LensModel::default()),
            ..CameraSpec::default()
        },
    }
}

fn placement_keys(placement: &StoredPlacement) -> PlacementSpec {
    PlacementSpec {
        id: placement.id.clone(),
        image: placement.image.clone(),
        scan: placement.scan.clone(),
        ..PlacementSpec::default()
    }
}

fn guess_keys(guess: &CameraGuess) -> GuessSpec {
    let pose = guess.mount_from_camera;
    let rotation = pose.rotation();
    GuessSpec {
        translation_mm: (pose.translation() * 1e3).into(),
        optical_axis: rotation.column(2).into_owned().into(),
        image_x: rotation.column(0).into_owned().into(),
        sigma_mm: Some(guess.sigma_mm),
        sigma_deg: Some(guess.sigma_deg),
    }
}
