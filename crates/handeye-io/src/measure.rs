//! From a dataset's files to measurements: corners, their points in 3D, poses of the target.
//!
//! Captures are read, measured and dropped one by one on a few threads, so that memory holds no
//! more than a handful of images however many there are.

mod depth;

use std::{collections::HashMap, path::PathBuf, time::SystemTime};

use handeye::{
    Camera, GrayImage, ImageCorner, Intrinsics, Observation, Placement, Pose, Session,
    SurfaceCorner, Target, TargetModel, TargetPose, Warning,
    calibrate::beside::Measuring,
    detect::{self, NotFound, sphere, surface},
    findings::{CameraFinding, camera::FromViews},
    intrinsics::{self, lens},
    math::linalg::median,
};

use crate::{
    CaptureSource, Dataset, Error, Place, PlacementSource, error::malformed, parallel,
    pixel_origin, shapes,
};

/// What was measured, and what is worth knowing of how.
pub struct Measured {
    /// Input of the calibration.
    pub session: Session,
    /// Calibration of the camera from the views, where the dataset gave none.
    pub camera_rms_px: Option<f64>,
    /// What was noticed on the way.
    pub noticed: Measuring,
}

/// One capture's files.
struct Shot<'a> {
    id: &'a str,
    image: Option<&'a PathBuf>,
    scan: Option<&'a PathBuf>,
    corners: Option<&'a [ImageCorner]>,
    pose: Option<Pose<Camera, Target>>,
}

impl<'a> From<&'a CaptureSource> for Shot<'a> {
    fn from(c: &'a CaptureSource) -> Self {
        let corners = c.corners.as_deref();
        let pose = c.camera_from_target;
        Shot { id: &c.id, image: c.image.as_ref(), scan: c.scan.as_ref(), corners, pose }
    }
}

impl<'a> From<&'a PlacementSource> for Shot<'a> {
    fn from(c: &'a PlacementSource) -> Self {
        let corners = c.corners.as_deref();
        let pose = c.camera_from_target;
        Shot { id: &c.id, image: c.image.as_ref(), scan: c.scan.as_ref(), corners, pose }
    }
}

/// What one capture shows.
#[derive(Clone, Default)]
struct Seen {
    corners: Vec<ImageCorner>,
    surface: Vec<SurfaceCorner>,
    missing: Vec<surface::Missing>,
    lifted: surface::Lifted,
    ball: Option<sphere::Ball>,
    size: Option<(usize, usize)>,
    not_found: Option<String>,
}

/// Measures every capture and placement; `progress` is told how many of how many are done.
///
/// # Errors
/// A file that cannot be read or used. An image without the target is not an error.
pub fn measure(
    dataset: &Dataset,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Measured, Error> {
    measure_again(dataset, &mut Measurements::default(), progress)
}

/// What was found in the files of captures, for a dataset that grows: files that are as they were are not read again.
#[derive(Default)]
pub struct Measurements {
    /// Of which target and camera, and how files are read.
    of: String,
    seen: HashMap<FileStates, Seen>,
}

/// A capture's files as they were: name, size, time of the last change.
type FileStates = Vec<(PathBuf, u64, Option<SystemTime>)>;

impl Measurements {
    /// Forgets what was found with another target or camera.
    fn renew(&mut self, dataset: &Dataset) {
        let of = dataset.reading();
        if self.of != of {
            *self = Self { of, seen: HashMap::new() };
        }
    }

    fn of_shot(&self, shot: &Shot) -> Option<Seen> {
        self.seen.get(&file_states(shot)?).cloned()
    }

    /// Keeps what these captures show, and nothing of others.
    fn keep(&mut self, shots: &[Shot], seen: &[Seen]) {
        let states = shots.iter().zip(seen).filter_map(|(s, seen)| Some((file_states(s)?, seen)));
        self.seen = states.map(|(state, seen)| (state, seen.clone())).collect();
    }
}

/// None of a capture whose files cannot be asked, or that has none.
fn file_states(shot: &Shot) -> Option<FileStates> {
    let state = |path: &PathBuf| {
        let file = path.metadata().ok()?;
        Some((path.clone(), file.len(), file.modified().ok()))
    };
    let files: Vec<&PathBuf> = [shot.image, shot.scan].into_iter().flatten().collect();
    if shot.corners.is_some() || files.is_empty() {
        return None;
    }
    files.into_iter().map(state).collect()
}

/// As [`measure`], without reading again what was measured before.
///
/// # Errors
/// As [`measure`].
pub fn measure_again(
    dataset: &Dataset,
    before: &mut Measurements,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Measured, Error> {
    if let Some(shape) = &dataset.shape {
        return shapes::measure(dataset, shape, progress);
    }
    let shots: Vec<Shot> = dataset
        .captures
        .iter()
        .map(Shot::from)
        .chain(dataset.placements.iter().map(Shot::from))
        .collect();
    before.renew(dataset);
    let mut seen = look_at_all(dataset, &shots, before, progress)?;
    before.keep(&shots, &seen);
    let mut warnings = dataset.warnings.clone();
    let colour_step = depth::settle_step(&shots, &mut seen, &mut warnings);
    tell_diameter(dataset, &seen, &mut warnings);
    let (mut camera, camera_rms_px) = camera(dataset, &shots, &seen, &mut warnings)?;
    let excess = settle_lens(dataset, &seen, &mut camera, &mut warnings);
    shots.iter().zip(&seen).for_each(|(shot, s)| depth::warn_missing(shot, s, &mut warnings));
    let poses = poses_of_targets(dataset, &shots, &mut seen, camera.as_ref(), excess);
    let captures = dataset.captures.iter().zip(&seen);
    let not_found = captures.filter_map(|(c, s)| Some((c.id.clone(), s.not_found.clone()?)));
    let not_found = not_found.collect();
    let session = session(dataset, seen, poses, camera);
    let noticed = Measuring { warnings, not_found, colour_step, scene: None };
    Ok(Measured { session, camera_rms_px, noticed })
}

fn look_at_all(
    dataset: &Dataset,
    shots: &[Shot],
    before: &Measurements,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<Seen>, Error> {
    let pictures = shots.iter().filter_map(|s| s.image.map(PathBuf::as_path));
    let look = |k: usize| {
        let shot = &shots[k];
        let again = || look_at(dataset, shot).map_err(|e| of_capture(shot, e));
        before.of_shot(shot).map_or_else(again, Ok)
    };
    let threads = parallel::threads(pictures);
    // results, and the first error, in the order of the captures
    parallel::in_order_told(shots.len(), threads, progress, look).into_iter().collect()
}

fn of_capture(shot: &Shot, source: Error) -> Error {
    Error::Capture { id: shot.id.to_owned(), source: Box::new(source) }
}

fn look_at(dataset: &Dataset, shot: &Shot) -> Result<Seen, Error> {
    let Some(target) = &dataset.target else { return Ok(Seen::default()) };
    if let TargetModel::Sphere { diameter_mm } = target {
        return look_for_ball(dataset, shot, *diameter_mm);
    }
    let mut seen = Seen::default();
    if let Some(corners) = shot.corners {
        seen.corners = corners.to_vec();
        let given = dataset.intrinsics.map(|k| (k.width, k.height)).or(dataset.picture);
        seen.size = given.map(|(width, height)| (width as usize, height as usize));
    } else if let Some(path) = shot.image {
        let image = dataset.image(path)?;
        seen.size = Some((image.width(), image.height()));
        match detected(dataset, &image, target) {
            Ok(corners) => seen.corners = corners,
            Err(reason) => seen.not_found = Some(reason.to_string()),
        }
    }
    if let (Some(path), Some(size), false) = (shot.scan, seen.size, seen.corners.is_empty()) {
        let scan = dataset.scan(path)?;
        let camera = dataset.intrinsics.as_ref();
        seen.lifted = surface::lift_coloured(&seen.corners, size, &scan, camera, target);
    }
    Ok(seen)
}

/// The target's corners; what belongs to the manifest's other targets is none of them.
fn detected(
    dataset: &Dataset,
    image: &GrayImage,
    target: &TargetModel,
) -> Result<Vec<ImageCorner>, NotFound> {
    let camera = dataset.intrinsics.as_ref();
    let others: Vec<&TargetModel> =
        dataset.other_targets.iter().filter(|t| !t.is_empty()).collect();
    if others.is_empty() {
        return detect::detect_with(image, target, camera);
    }
    detect::detect_several(image, &[&[target], &others[..]].concat(), camera).swap_remove(0)
}

/// The centre of a ball, as the one corner of its scan.
fn look_for_ball(dataset: &Dataset, shot: &Shot, diameter_mm: Option<f64>) -> Result<Seen, Error> {
    let mut seen = Seen::default();
    let Some(path) = shot.scan else {
        seen.not_found = Some("a ball is found in scans, and there is none".into());
        return Ok(seen);
    };
    match sphere::find(&dataset.scan(path)?, diameter_mm.map(|mm| mm * 1e-3)) {
        Ok(ball) => {
            let (in_camera, covariance) = (ball.centre, ball.covariance);
            seen.surface = vec![SurfaceCorner { id: 0, in_camera, covariance }];
            seen.ball = Some(ball);
        }
        Err(reason) => seen.not_found = Some(reason.to_string()),
    }
    Ok(seen)
}

/// Tells the diameter that the scans find, where none was given.
fn tell_diameter(dataset: &Dataset, seen: &[Seen], warnings: &mut Vec<Warning>) {
    let unknown = matches!(dataset.target, Some(TargetModel::Sphere { diameter_mm: None }));
    let all: Vec<f64> =
        seen.iter().filter_map(|s| Some(s.ball.as_ref()?.diameter_m * 1e3)).collect();
    let fold = |f: fn(f64, f64) -> f64| all.iter().copied().reduce(f);
    let (Some(least), Some(most), true) = (fold(f64::min), fold(f64::max), unknown) else { return };
    warnings.push(Warning::new(
        "ball-diameter-found",
        format!(
            "no diameter_mm given: {} scans find {:.2} mm (median, from {least:.2} to {most:.2}); \
             set `target.diameter_mm` to the measured value for more accurate centres",
            all.len(),
            median(all.iter().copied())
        ),
    ));
}

/// The camera that the dataset gives, or one calibrated from its views.
fn camera(
    dataset: &Dataset,
    shots: &[Shot],
    seen: &[Seen],
    warnings: &mut Vec<Warning>,
) -> Result<(Option<Intrinsics>, Option<f64>), Error> {
    if let Some(given) = dataset.intrinsics {
        check_size(&given, shots, seen)?;
        warnings.extend(cross_checked(&given, dataset, seen));
        warnings.extend(shifted(&given, dataset, shots, seen));
        return Ok((Some(given), None));
    }
    let Some(target) = &dataset.target else { return Ok((None, None)) };
    let views: Vec<Vec<ImageCorner>> =
        seen.iter().map(|s| s.corners.clone()).filter(|c| !c.is_empty()).collect();
    let Some((width, height)) = seen.iter().find_map(|s| s.size) else { return Ok((None, None)) };
    if views.is_empty() {
        return Ok((None, None));
    }
    // others are of another camera, or of another part of its sensor
    let other = format!("those before it are {width} x {height}");
    let advice = "leave images of another size out, or give the intrinsics in [camera]";
    all_of_size((width, height), (&other, advice), shots, seen)?;
    let found = intrinsics::calibrate(
        &views,
        target,
        width as u32,
        height as u32,
        dataset.lens.unwrap_or_default(),
    )
    .map_err(|e| uncalibrated(dataset, &e))?;
    let calibrated = FromViews {
        views: views.len(),
        rms_px: found.rms_px,
        focal_px: [found.intrinsics.fx, found.intrinsics.fy],
    };
    warnings.push(CameraFinding::CalibratedFromViews { calibrated, used: None }.into());
    warnings.extend(found.warnings);
    Ok((Some(found.intrinsics), Some(found.rms_px)))
}

/// Views that differ from a right camera as much are rarer than this.
const DISAGREEING: f64 = 1e-3;

/// Where the manifest asks for it: whether the views agree with the camera that is given.
fn cross_checked(given: &Intrinsics, dataset: &Dataset, seen: &[Seen]) -> Option<Warning> {
    let (target, _) = (dataset.target.as_ref()?, dataset.lens?);
    let views: Vec<Vec<ImageCorner>> =
        seen.iter().map(|s| s.corners.clone()).filter(|c| !c.is_empty()).collect();
    let check = match intrinsics::cross_check(&views, target, given) {
        Ok(check) => check,
        Err(error) => {
            let text = format!("the given camera cannot be checked by the views: {error}");
            return Some(Warning::new("camera-not-checked", text));
        }
    };
    let (name, value, views_value, sigma) = check.farthest;
    let (rms, own) = (check.rms_given_px, check.found.rms_px);
    (check.chance < DISAGREEING).then(|| {
        Warning::new(
            "camera-disagrees",
            format!(
                "the camera as given and what the views show of it differ by more than their \
                 uncertainty (chance {:.0e}): {name} is given as {value:.5}, the views have \
                 {views_value:.5} +- {sigma:.5}; corners fit to {rms:.3} px as given, to {own:.3} px \
                 with the views' own; is it this camera, at this resolution and focus?",
                check.chance
            ),
        )
    })
}

/// Whether corners of another program count their pixels from elsewhere than the camera does.
fn shifted(
    given: &Intrinsics,
    dataset: &Dataset,
    shots: &[Shot],
    seen: &[Seen],
) -> Option<Warning> {
    let (target, origin) = (dataset.target.as_ref()?, dataset.pixel_origin?);
    let imported = shots.iter().zip(seen).filter(|(shot, _)| shot.corners.is_some());
    let views: Vec<Vec<ImageCorner>> = imported.map(|(_, s)| s.corners.clone()).collect();
    pixel_origin::half_pixel(&views, target, given, origin)
}

/// Gives a camera that was given without distortion the radial distortion that the corners prove; those of a bent board prove
/// none. Returns what lens model and print then typically leave in a corner, px.
fn settle_lens(
    dataset: &Dataset,
    seen: &[Seen],
    camera: &mut Option<Intrinsics>,
    warnings: &mut Vec<Warning>,
) -> Option<f64> {
    let (target, straight) = (dataset.target.as_ref()?, (*camera)?);
    let views: Vec<&[ImageCorner]> = seen.iter().map(|s| &s.corners[..]).collect();
    let posed = |camera| detect::best_poses(&views, target, camera, parallel::threads([]));
    let mut poses = posed(&straight);
    let is_given = dataset.intrinsics.is_some();
    if is_given
        && !depth::is_bent(seen, target)
        && let Some(bend) = lens::bend(&views, &poses, target, &straight)
    {
        let finding = CameraFinding::Bends {
            k1: bend.k1,
            sigma: bend.sigma,
            rms_given_px: bend.rms_given_px,
            rms_px: bend.rms_px,
        };
        warnings.push(finding.into());
        poses = posed(&bend.intrinsics);
        *camera = Some(bend.intrinsics);
    }
    detect::typical_excess(poses.iter().flatten())
}

fn uncalibrated(dataset: &Dataset, error: &handeye::Error) -> Error {
    let what = format!("no intrinsics given, and the views do not give them either: {error}");
    malformed(Place::file(&dataset.manifest), what, "add the camera's intrinsics to the manifest")
}

/// Images must have the size that the camera was calibrated at.
fn check_size(camera: &Intrinsics, shots: &[Shot], seen: &[Seen]) -> Result<(), Error> {
    let (width, height) = (camera.width as usize, camera.height as usize);
    if width == 0 {
        return Ok(());
    }
    let other = format!("the camera was calibrated at {width} x {height}");
    let advice = "give `resized` in [camera], or intrinsics for this size";
    all_of_size((width, height), (&other, advice), shots, seen)
}

/// Refuses the first image of another size, with what has this one, and what to do.
fn all_of_size(
    size: (usize, usize),
    (other, advice): (&str, &str),
    shots: &[Shot],
    seen: &[Seen],
) -> Result<(), Error> {
    for (shot, s) in shots.iter().zip(seen) {
        let (Some((w, h)), Some(path)) = (s.size, shot.image) else { continue };
        if (w, h) != size {
            let what = format!("the image is {w} x {h} pixels, {other}");
            return Err(of_capture(shot, malformed(Place::file(path), what, advice)));
        }
    }
    Ok(())
}

/// Poses of the target in every capture and placement; where the corners give none, the capture says why.
fn poses_of_targets(
    dataset: &Dataset,
    shots: &[Shot],
    seen: &mut [Seen],
    camera: Option<&Intrinsics>,
    excess: Option<f64>,
) -> Vec<Vec<TargetPose>> {
    let of = |k: usize| target_poses(dataset, &shots[k], &seen[k], camera, excess);
    let all = parallel::in_order(shots.len(), parallel::threads([]), of);
    let or_why = |(found, s): (Result<Vec<TargetPose>, handeye::Error>, &mut Seen)| {
        found.unwrap_or_else(|error| {
            s.not_found = Some(error.to_string());
            vec![]
        })
    };
    all.into_iter().zip(seen).map(or_why).collect()
}

fn target_poses(
    dataset: &Dataset,
    shot: &Shot,
    seen: &Seen,
    camera: Option<&Intrinsics>,
    excess: Option<f64>,
) -> Result<Vec<TargetPose>, handeye::Error> {
    if let Some(camera_from_target) = shot.pose {
        return Ok(vec![TargetPose { camera_from_target, covariance: None }]);
    }
    let (Some(target), Some(camera), false) = (&dataset.target, camera, seen.corners.is_empty())
    else {
        return Ok(vec![]);
    };
    let poses = detect::target_poses_with(&seen.corners, &seen.surface, target, camera, excess)?;
    Ok(detect::with_symmetries(&poses, target))
}

fn session(
    dataset: &Dataset,
    seen: Vec<Seen>,
    poses: Vec<Vec<TargetPose>>,
    camera: Option<Intrinsics>,
) -> Session {
    let mut all = seen.into_iter().zip(poses);
    let observations = dataset
        .captures
        .iter()
        .zip(all.by_ref())
        .map(|(c, (s, candidates))| observation(c, s, candidates))
        .collect();
    let placements = dataset
        .placements
        .iter()
        .zip(all)
        .map(|(p, (s, candidates))| Placement {
            id: p.id.clone(),
            corners: s.corners,
            surface: s.surface,
            candidates,
            not_seen: s.not_found,
        })
        .collect();
    Session {
        camera_from_views: dataset.intrinsics.is_none(),
        target: dataset.target.clone(),
        target_size: dataset.target_size,
        camera,
        lens_sigma: dataset.lens_sigma,
        placements,
        touches: dataset.touches.clone(),
        correspondences: dataset.correspondences.clone(),
        ..dataset.session(observations)
    }
}

fn observation(c: &CaptureSource, seen: Seen, candidates: Vec<TargetPose>) -> Observation {
    let Seen { corners, surface, .. } = seen;
    Observation { corners, surface, candidates, ..c.observation() }
}
