//! Gathers what the report of a dataset shows.

use handeye::{
    Calibration, Observation, Session,
    calibrate::{relabelling, result::CaptureResult},
    model::names::natural,
};

use super::{CellData, MarkedCorner, Picture, Report, html};
use crate::{
    CaptureSource, Dataset,
    export::{self, CameraPose, Format},
};

/// Most images in a report; of more captures, those left out come first, then the others evenly.
const MOST_PICTURES: usize = 36;

/// The whole page of a calibrated dataset.
pub fn dataset_html(dataset: &Dataset, calibration: &Calibration, session: &Session) -> String {
    html(&Report {
        title: dataset.title(),
        calibration,
        camera: session.camera.as_ref(),
        cell: cell(dataset, calibration, session),
        notations: notations(dataset.notation.as_deref(), calibration),
        pictures: pictures(dataset, calibration, session),
        corners: corners(calibration, session),
    })
}

/// The page of a result without its dataset: no images, no touched places.
pub fn calibration_html(title: &str, calibration: &Calibration) -> String {
    html(&Report {
        title: title.into(),
        calibration,
        camera: None,
        cell: CellData::default(),
        notations: notations(None, calibration),
        pictures: vec![],
        corners: vec![],
    })
}

/// The cell with the target and the camera that the calibration used, and with its scans if they can be read again.
fn cell(dataset: &Dataset, calibration: &Calibration, session: &Session) -> CellData {
    let bare = || CellData {
        target: session.target.clone(),
        camera: session.camera,
        ..CellData::of(dataset, calibration)
    };
    bare().with_scans(dataset, calibration).unwrap_or_else(|_| bare())
}

/// Notations of the transform, those that most programs read first.
const ALL: [&str; 16] = [
    "quaternion-xyzw",
    "quaternion-wxyz",
    "rotation-vector",
    "matrix4x4",
    "ur",
    "ur-rpy",
    "kuka",
    "fanuc",
    "abb",
    "yaskawa",
    "kawasaki",
    "staubli",
    "doosan",
    "denso",
    "urdf",
    "ros2-launch",
];

/// The transform in the dataset's own notation and in all others.
fn notations(own: Option<&str>, calibration: &Calibration) -> Vec<(String, String)> {
    let Ok(Some(camera)) = CameraPose::of(calibration, None, None, &[]) else { return vec![] };
    let own = own.filter(|n| ALL.contains(n));
    let names = own.into_iter().chain(ALL.into_iter().filter(|n| Some(*n) != own));
    names
        .filter_map(|name| {
            let text = export::render(&camera, &Format::named(name).ok()?);
            Some((name.to_owned(), String::from_utf8(text).ok()?.trim_end().to_owned()))
        })
        .collect()
}

fn pictures(dataset: &Dataset, calibration: &Calibration, session: &Session) -> Vec<Picture> {
    let mut chosen: Vec<&CaptureSource> =
        dataset.captures.iter().filter(|c| c.image.is_some()).collect();
    let used = |c: &CaptureSource| calibration.captures.iter().any(|k| k.id == c.id && k.used);
    if chosen.len() > MOST_PICTURES {
        let (good, bad): (Vec<_>, Vec<_>) = chosen.into_iter().partition(|c| used(c));
        let room = MOST_PICTURES.saturating_sub(bad.len()).max(1);
        let step = good.len().div_ceil(room).max(1);
        chosen =
            bad.into_iter().take(MOST_PICTURES).chain(good.into_iter().step_by(step)).collect();
        chosen.truncate(MOST_PICTURES);
        chosen.sort_by(|a, b| natural(&a.id, &b.id));
    }
    chosen.into_iter().filter_map(|c| picture(dataset, calibration, session, c)).collect()
}

fn picture(
    dataset: &Dataset,
    calibration: &Calibration,
    session: &Session,
    source: &CaptureSource,
) -> Option<Picture> {
    let image = dataset.image(source.image.as_ref()?).ok()?;
    let result = calibration.captures.iter().find(|c| c.id == source.id)?;
    let observation = session.observations.iter().find(|o| o.capture == source.id)?;
    let corners = marked(session, observation, result);
    Picture::new(&source.id, caption(result), result.used, &image, corners)
}

fn caption(c: &CaptureResult) -> String {
    match (&c.reason, c.residual_px) {
        (Some(reason), _) => reason.clone(),
        (None, Some(px)) => format!("{} corners, {px:.3} px", c.corners),
        (None, None) => format!("{} corners", c.corners),
    }
}

/// Those of all captures that are used.
fn corners(calibration: &Calibration, session: &Session) -> Vec<MarkedCorner> {
    let used = calibration.captures.iter().filter(|c| c.used);
    let with_result = used.filter_map(|result| {
        let o = session.observations.iter().find(|o| o.capture == result.id)?;
        Some(marked(session, o, result))
    });
    with_result.flatten().collect()
}

/// Corners with their residuals against the target seen from the image's own pose.
fn marked(session: &Session, o: &Observation, result: &CaptureResult) -> Vec<MarkedCorner> {
    let predicted = |id: u32| {
        let (target, camera) = (session.target.as_ref()?, session.camera.as_ref()?);
        let pose = result.camera_from_target?;
        let map = relabelling(o, &pose, target);
        let corner = target.corner(*map.get(id as usize)?)?;
        camera.project(&(pose * corner).vector())
    };
    o.corners
        .iter()
        .map(|c| {
            let d = predicted(c.id).map_or(nalgebra::Vector2::zeros(), |p| c.pixel - p);
            MarkedCorner { x: c.pixel.x, y: c.pixel.y, dx: d.x, dy: d.y }
        })
        .collect()
}
