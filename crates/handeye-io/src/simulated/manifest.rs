//! The manifest of a simulated cell.

use handeye::{
    Distortion, Intrinsics,
    simulate::{Cell, Recording, cell::placement_name},
};

use super::{ARM, ScanFormat, TRUTH, Writing, pictures::DEPTH_SCALE};
use crate::{
    PixelOrigin,
    camera::CameraSpec,
    dataset::{
        Draft,
        manifest::{
            CornersSpec, FileOr, ImagesSpec, NoiseSpec, PlacementSpec, RobotDirection, RobotSpec,
            ScansSpec, TipSpec, TouchKind, TouchesSpec,
        },
    },
    units::{AngleUnit, LengthUnit},
};

/// The text of `handeye.toml`. Captures have names of three digits, placements have others.
pub(super) fn manifest(recording: &Recording, writing: Writing) -> String {
    let (cell, with_images) = (recording.cell, writing.images);
    let mut draft = Draft::new();
    draft.head(format!("A simulated cell; its truth is in {TRUTH}."));
    draft.set_target(cell.target.clone());
    let has_scans = with_images && cell.depth.is_some();
    let m = &mut draft.manifest;
    m.setup = cell.setup;
    m.camera = Some(camera(&cell.intrinsics));
    m.robot = Some(robot(cell));
    // a ball is seen in scans alone
    let has_corners = !cell.target.is_empty();
    m.images = (has_corners && with_images).then(|| ImagesSpec::of("images/???.png"));
    m.corners = (has_corners && !with_images).then(|| CornersSpec {
        files: "corners/???.csv".into(),
        pixel_origin: Some(PixelOrigin::Centre),
    });
    m.scans = has_scans.then(|| scans(cell, writing.scans));
    if !with_images && cell.noise.corner_px > 0.0 {
        m.noise = NoiseSpec { image_px: Some(cell.noise.corner_px), ..NoiseSpec::default() };
    }
    let format = has_scans.then_some(writing.scans);
    let names = (0..cell.placements).map(placement_name);
    m.placements = names.map(|id| placement(id, with_images, format)).collect();
    m.touches = touches(recording);
    draft.written().0
}

fn robot(cell: &Cell) -> RobotSpec {
    let is_joints = cell.arm.is_some();
    RobotSpec {
        poses: "robot.csv".into(),
        direction: Some(RobotDirection::BaseFromFlange),
        notation: Some(if is_joints { "joints" } else { "quaternion-xyzw" }.into()),
        length_unit: (!is_joints).then_some(LengthUnit::Metre),
        angle_unit: is_joints.then_some(AngleUnit::Degree),
        dh: is_joints.then(|| FileOr::File(ARM.into())),
        ..RobotSpec::default()
    }
}

fn scans(cell: &Cell, format: ScanFormat) -> ScansSpec {
    let is_depth = format == ScanFormat::DepthPng;
    ScansSpec {
        files: format!("scans/???.{}", format.ending()),
        length_unit: (!is_depth).then_some(LengthUnit::Metre),
        depth_scale: is_depth.then_some(DEPTH_SCALE),
        camera: is_depth.then(|| camera(&cell.scan_intrinsics())),
        ..ScansSpec::default()
    }
}

fn placement(id: String, with_images: bool, scans: Option<ScanFormat>) -> PlacementSpec {
    PlacementSpec {
        image: with_images.then(|| format!("images/{id}.png")),
        corners: (!with_images).then(|| format!("corners/{id}.csv")),
        scan: scans.map(|format| format!("scans/{id}.{}", format.ending())),
        id,
        ..PlacementSpec::default()
    }
}

fn touches(recording: &Recording) -> Option<TouchesSpec> {
    if recording.touches.is_empty() {
        return None;
    }
    let is_joints = recording.cell.arm.is_some();
    let tip = recording.believed_tip().vector() * 1e3;
    Some(TouchesSpec {
        file: Some("touches.csv".into()),
        kind: Some(if is_joints { TouchKind::Joints } else { TouchKind::FlangePose }),
        notation: (!is_joints).then(|| "quaternion-xyzw".into()),
        length_unit: (!is_joints).then_some(LengthUnit::Metre),
        tip: Some(TipSpec { in_flange_mm: tip.into() }),
        ..TouchesSpec::default()
    })
}

/// A camera's keys.
pub(crate) fn camera(c: &Intrinsics) -> CameraSpec {
    let model = match c.distortion {
        Distortion::None => "none",
        Distortion::BrownConrady(_) => "brown-conrady",
        Distortion::KannalaBrandt(_) => "kannala-brandt",
    };
    let is_distorted = c.distortion != Distortion::None;
    CameraSpec {
        width: Some(c.width),
        height: Some(c.height),
        fx: Some(c.fx),
        fy: Some(c.fy),
        cx: Some(c.cx),
        cy: Some(c.cy),
        distortion_model: Some(model.into()),
        distortion: is_distorted.then(|| c.coefficients().to_vec()),
        ..CameraSpec::default()
    }
}
