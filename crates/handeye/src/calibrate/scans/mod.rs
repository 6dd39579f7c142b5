//! What the scans say of the board, and whether images and scans agree.

mod scan_offset;
pub(crate) mod sources;

use nalgebra::{Matrix3, Vector3};

use crate::{
    Camera, Observation, Pose, SurfaceCorner, Target, TargetModel, Warning,
    calibrate::{
        captures::residuals::relabelling,
        optics,
        result::{
            BoardDeviation, Calibration, CaptureFlatness, FlatnessResult, FramesResult, ScanResult,
        },
    },
    detect,
    findings::{FramesFinding, TargetFinding, frames::OfAxes},
    mistakes::{
        flatness::{Bend, Flatness, ScanCorner, flatness},
        frames::{Frames, Part, TwoPlanes, frames, plane_of_points, plane_of_pose},
    },
    model::session::Session,
};

/// One capture with its scan's corners under the names that the chosen reading gives them.
struct Seen<'a> {
    id: &'a str,
    observation: &'a Observation,
    pose: Pose<Camera, Target>,
    names: Vec<u32>,
    surface: Vec<SurfaceCorner>,
}

/// What the scans say beside the answer.
#[derive(Default)]
pub(crate) struct OfScans {
    pub result: Option<ScanResult>,
    /// Whether the target is bent.
    pub is_bent: bool,
    pub warnings: Vec<Warning>,
}

/// What the scans say of board and frames, under an answer.
pub(crate) fn of_scans(session: &Session, answer: &Calibration) -> OfScans {
    let none = OfScans::default();
    let Some(target) = session.target.as_ref().filter(|t| !t.is_empty()) else { return none };
    let seen = seen(session, target, answer);
    if seen.is_empty() {
        return none;
    }
    let flatness = flat(&seen, target);
    let is_bent = flatness.as_ref().is_some_and(|f| f.is_bent(target));
    let not_flat = flatness.as_ref().filter(|_| is_bent).map(|f| not_flat(&f.board, seen.len()));
    let (frames, apart) = agreement(session, &seen, target);
    let result = ScanResult {
        colour_step: None,
        flatness: flatness.map(|f| as_result(&f, &seen)),
        frames,
        scene: None,
    };
    let warnings = not_flat.into_iter().chain(apart.into_iter().map(Warning::from)).collect();
    OfScans { result: Some(result), is_bent, warnings }
}

fn seen<'a>(session: &'a Session, target: &TargetModel, result: &Calibration) -> Vec<Seen<'a>> {
    let one = |(o, c): (&'a Observation, &crate::calibrate::result::CaptureResult)| {
        let pose = c.camera_from_target.filter(|_| c.used && !o.surface.is_empty())?;
        let names = relabelling(o, &pose, target);
        let renamed =
            |c: &SurfaceCorner| Some(SurfaceCorner { id: *names.get(c.id as usize)?, ..*c });
        let surface = o.surface.iter().filter_map(renamed).collect();
        Some(Seen { id: &o.capture, observation: o, pose, names, surface })
    };
    session.observations.iter().zip(&result.captures).filter_map(one).collect()
}

fn flat(seen: &[Seen], target: &TargetModel) -> Option<Flatness> {
    let corners = |s: &Seen| -> Vec<ScanCorner> {
        let one = |c: &SurfaceCorner| {
            Some((target.corner(c.id)?.vector().xy(), c.in_camera.vector(), c.covariance))
        };
        s.surface.iter().filter_map(one).collect()
    };
    flatness(&seen.iter().map(corners).collect::<Vec<_>>())
}

fn not_flat(bend: &Bend, captures: usize) -> Warning {
    let (peak_to_valley_mm, sigma_mm) = (bend.peak_to_valley_m * 1e3, bend.sigma_m * 1e3);
    TargetFinding::NotFlat { captures, peak_to_valley_mm, sigma_mm }.into()
}

fn as_result(found: &Flatness, seen: &[Seen]) -> FlatnessResult {
    let own = |(s, bend): (&Seen, &Option<Bend>)| {
        let bend = bend.as_ref()?;
        Some(CaptureFlatness {
            id: s.id.to_owned(),
            rms_mm: bend.rms_m * 1e3,
            peak_to_valley_mm: bend.peak_to_valley_m * 1e3,
            sigma_mm: bend.sigma_m * 1e3,
            chance: bend.chance,
        })
    };
    let place = |d: &crate::mistakes::flatness::Deviation| BoardDeviation {
        x_mm: d.at.x * 1e3,
        y_mm: d.at.y * 1e3,
        deviation_mm: d.height_m * 1e3,
        sigma_mm: d.sigma_m * 1e3,
    };
    FlatnessResult {
        rms_mm: found.board.rms_m * 1e3,
        peak_to_valley_mm: found.board.peak_to_valley_m * 1e3,
        sigma_mm: found.board.sigma_m * 1e3,
        chance: found.board.chance,
        map: found.map.iter().map(place).collect(),
        captures: seen.iter().zip(&found.captures).filter_map(own).collect(),
    }
}

/// The board's plane in image and scan of every capture that has both, whatever the robot says.
pub(crate) fn seen_planes(session: &Session) -> Vec<TwoPlanes> {
    let (Some(target), Some(camera)) = (&session.target, &session.camera) else { return vec![] };
    let excess = optics::excess(session, target, camera);
    let of = |o: &Observation| {
        let points: Vec<(Vector3<f64>, Matrix3<f64>)> =
            o.surface.iter().map(|c| (c.in_camera.vector(), c.covariance)).collect();
        let scan = plane_of_points(&points)?;
        // of the two poses of a board that is far away, the one that the scan is nearer to
        let image = |c: &crate::TargetPose| {
            let start = &c.camera_from_target;
            let (posed, _) = detect::sighted(&o.corners, &[], target, camera, excess, start)?;
            plane_of_pose(&posed.pose)
        };
        let images = o.candidates.iter().filter_map(image);
        let image =
            images.min_by(|a, b| (a.0 - scan.0).norm().total_cmp(&(b.0 - scan.0).norm()))?;
        Some(TwoPlanes { image, scan })
    };
    session.observations.iter().filter(|o| !o.corners.is_empty()).filter_map(of).collect()
}

/// Differences between image and scan that no answer notices are not worth a word: scale, rad, m.
const LEAST: (f64, f64, f64) = (5e-4, 5e-4, 2e-4);

fn agreement(
    session: &Session,
    seen: &[Seen],
    target: &TargetModel,
) -> (Option<FramesResult>, Vec<FramesFinding>) {
    let Some(found) = compared(session, seen, target) else { return (None, vec![]) };
    let worth = |part: Part| match part {
        Part::Scale => found.values[0].abs() > LEAST.0,
        Part::Tilt => found.values.fixed_rows::<3>(1).norm() > LEAST.1,
        Part::Shift => found.values.fixed_rows::<3>(4).norm() > LEAST.2,
    };
    if !found.separable {
        // numbers for parts that the captures do not tell apart would be wrong by more than they say
        return (None, vec![FramesFinding::NotSeparable]);
    }
    let named = found.proven.iter().filter(|p| worth(**p));
    (Some(frames_result(&found)), named.map(|p| disagreement(*p, &found)).collect())
}

/// The frames of images and scans, over all captures.
fn compared(session: &Session, seen: &[Seen], target: &TargetModel) -> Option<Frames> {
    let camera = session.camera.as_ref()?;
    let excess = optics::excess(session, target, camera);
    let planes = |s: &Seen| {
        let corners = detect::relabelled(&s.observation.corners, &s.names);
        let (posed, _) = detect::sighted(&corners, &[], target, camera, excess, &s.pose)?;
        let points: Vec<(Vector3<f64>, Matrix3<f64>)> =
            s.surface.iter().map(|c| (c.in_camera.vector(), c.covariance)).collect();
        Some(TwoPlanes { image: plane_of_pose(&posed.pose)?, scan: plane_of_points(&points)? })
    };
    frames(&seen.iter().filter_map(planes).collect::<Vec<_>>())
}

fn frames_result(found: &Frames) -> FramesResult {
    let word = |p: &Part| match p {
        Part::Scale => "scale".to_owned(),
        Part::Tilt => "tilt".to_owned(),
        Part::Shift => "shift".to_owned(),
    };
    let three = |v: &nalgebra::SVector<f64, 7>, first: usize, unit: f64| {
        [v[first] * unit, v[first + 1] * unit, v[first + 2] * unit]
    };
    let (v, s) = (&found.values, &found.sigmas);
    let degrees = 1f64.to_degrees();
    FramesResult {
        scale: v[0],
        sigma_scale: s[0],
        tilt_deg: three(v, 1, degrees),
        sigma_tilt_deg: three(s, 1, degrees),
        shift_mm: three(v, 4, 1e3),
        sigma_shift_mm: three(s, 4, 1e3),
        proven: found.proven.iter().map(word).collect(),
        chance: found.chance,
    }
}

fn disagreement(part: Part, found: &Frames) -> FramesFinding {
    let (v, s) = (&found.values, &found.sigmas);
    let axes = |first: usize, unit: f64| OfAxes {
        values: std::array::from_fn(|k| v[first + k] * unit),
        sigmas: std::array::from_fn(|k| s[first + k] * unit),
    };
    match part {
        Part::Scale => FramesFinding::Scale { value: v[0], sigma: s[0] },
        Part::Tilt => FramesFinding::Tilt(axes(1, 1f64.to_degrees())),
        Part::Shift => FramesFinding::Shift(axes(4, 1e3)),
    }
}
