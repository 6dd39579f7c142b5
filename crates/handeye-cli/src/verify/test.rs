//! What is tested: the touches of a file or a dataset, with all that makes them uncertain.

use std::path::Path;

use handeye::{
    Calibration, Flange, Mount, Pose, Session, Setup, TargetPose, Warning,
    calibrate::result,
    estimate::touch_pairs,
    tools::verify::{self, ByPose, Sighting, Test, Touched},
};
use handeye_io::{Dataset, MANIFEST, TouchedPoint, measure, read_touched_points};
use nalgebra::{Matrix3, Matrix6, Vector6};

use crate::{
    args::{GlobalArgs, VerifyArgs},
    failure::Failure,
    progress::Progress,
};

/// What the robot's position misses from place to place, m, each axis: by the error of its reports, or by errors that it
/// does not know of, of its arm or by place.
fn place_sigma(calibration: &Calibration) -> f64 {
    let tre = calibration.predicted_tre_mm.as_ref().map_or(0.0, |tre| tre.rms * 1e-3);
    let missed = calibration.robot_errors().map_or(0.0, |_| tre / 3.0f64.sqrt());
    calibration.robot_noise().distance.max(missed)
}

/// The test of a calibration, and what to know about its touches.
pub(super) fn test(
    args: &VerifyArgs,
    calibration: &Calibration,
    path: &Path,
    global: &GlobalArgs,
) -> Result<(Test, Vec<Warning>), Failure> {
    let Some(mount_from_camera) = calibration.hand_eye.mount_from_camera else {
        let what = "holds no transform (the data did not determine it): there is nothing to test";
        return Err(Failure::input(path, what));
    };
    let mut test = Test {
        mount_from_camera,
        covariance: calibration.hand_eye.covariance.mount_from_camera.as_ref().map(result::matrix),
        poses: vec![],
        touch_sigma: (args.touch_noise_mm * 1e-3).hypot(place_sigma(calibration)),
        touches: vec![],
    };
    let is_dataset = args.touches.is_dir() || args.touches.extension().is_some_and(|e| e == "toml");
    let warnings = match is_dataset {
        true => from_dataset(&args.touches, calibration, &mut test, global)?,
        false => from_file(&args.touches, args.camera_noise_mm * 1e-3, calibration, &mut test)?,
    };
    Ok((test, warnings))
}

fn from_file(
    path: &Path,
    sigma: f64,
    calibration: &Calibration,
    test: &mut Test,
) -> Result<Vec<Warning>, Failure> {
    let (points, warnings) = each_once(read_touched_points(path)?);
    for point in points {
        let base_from_mount = match (calibration.setup, point.base_from_flange) {
            (Setup::EyeToHand, _) => Pose::identity(),
            (Setup::EyeInHand, Some(flange)) => flange.rename(),
            (Setup::EyeInHand, None) => {
                let what = format!(
                    "touch {}: the camera is on the flange: say where the flange was when it \
                     measured (flange_x_mm ... flange_qw)",
                    point.id
                );
                return Err(Failure::input(path, what));
            }
        };
        let mut sighting = Sighting {
            base_from_mount,
            in_camera: point.in_camera,
            covariance: Matrix3::identity() * sigma.powi(2),
            shared: vec![],
        };
        if calibration.setup == Setup::EyeInHand {
            let flange = shared_flange(test, base_from_mount.rename(), calibration);
            let in_mount = test.mount_from_camera * point.in_camera;
            sighting.shared.push((flange, verify::by_mount(&base_from_mount, &in_mount)));
        }
        test.touches.push(Touched {
            id: point.id,
            in_base: point.in_base,
            sightings: vec![sighting],
        });
    }
    Ok(warnings)
}

/// Touches without those that repeat another number by number: these are no second measurement.
fn each_once(points: Vec<TouchedPoint>) -> (Vec<TouchedPoint>, Vec<Warning>) {
    let (mut kept, mut warnings) = (Vec::<TouchedPoint>::new(), Vec::new());
    for point in points {
        let numbers = |p: &TouchedPoint| (p.in_camera, p.in_base, p.base_from_flange);
        let id = &point.id;
        if let Some(first) = kept.iter().find(|p| numbers(p) == numbers(&point)) {
            let message = format!(
                "touch {id} repeats touch {} number by number and is not counted again: touch the \
                 point anew for a second measurement",
                first.id
            );
            warnings.push(Warning::new("touch-repeated", message));
            continue;
        }
        if kept.iter().any(|p| p.id == *id) {
            let message = format!(
                "two touches are called {id}, with different numbers; both are counted: give each \
                 a name of its own"
            );
            warnings.push(Warning::new("touch-name-repeated", message));
        }
        kept.push(point);
    }
    (kept, warnings)
}

/// The error of a flange pose, one for all that was seen from it.
fn shared_flange(
    test: &mut Test,
    flange: Pose<handeye::Base, Flange>,
    calibration: &Calibration,
) -> usize {
    let same = |t: &Touched| {
        let s = t.sightings.iter().find(|s| s.base_from_mount.rename::<_, Flange>() == flange)?;
        s.shared.first().map(|(number, _)| *number)
    };
    test.touches.iter().find_map(same).unwrap_or_else(|| {
        test.poses.push(robot_covariance(calibration));
        test.poses.len() - 1
    })
}

fn robot_covariance(calibration: &Calibration) -> Matrix6<f64> {
    let noise = calibration.robot_noise();
    let (r, t) = (noise.angle, noise.distance);
    let (r, t) = (r * r, t * t);
    Matrix6::from_diagonal(&Vector6::new(r, r, r, t, t, t))
}

fn from_dataset(
    path: &Path,
    calibration: &Calibration,
    test: &mut Test,
    global: &GlobalArgs,
) -> Result<Vec<Warning>, Failure> {
    let dataset = Dataset::open(path)?;
    let manifest = if path.is_dir() { path.join(MANIFEST) } else { path.into() };
    if dataset.setup != calibration.setup {
        return Err(Failure::input(manifest, "is of another setup than the calibration"));
    }
    if dataset.touches.is_empty() || dataset.target.is_none() {
        let what = "has no touches of a [target]: add [touches], or give a file of touched points";
        return Err(Failure::input(manifest, what));
    }
    let progress = Progress::new("reading captures", global);
    let mut session = measure::measure(&dataset, &|done, all| progress.tell(done, all))?.session;
    drop(progress);
    let warnings = touch_pairs::each_once(&mut session.touches);
    if let Some(sigma) = dataset.noise.touch {
        test.touch_sigma = sigma.hypot(calibration.robot_noise().distance);
    }
    test.touches = session
        .touches
        .iter()
        .map(|t| Touched {
            id: format!("{} {}", t.placement, t.corner),
            in_base: t.in_base,
            sightings: vec![],
        })
        .collect();
    for (name, base_from_mount, candidates) in views(&session) {
        see(test, &session, &name, base_from_mount, &candidates, calibration);
    }
    Ok(warnings.into_iter().map(Warning::from).collect())
}

/// Where a board was seen: its name, the mount, and the board's possible poses.
type BoardView = (String, Pose<handeye::Base, Mount>, Vec<TargetPose>);

fn views(session: &Session) -> Vec<BoardView> {
    let placed = session.placements.iter();
    match session.setup {
        Setup::EyeToHand => {
            placed.map(|p| (p.id.clone(), Pose::identity(), p.candidates.clone())).collect()
        }
        Setup::EyeInHand => {
            let name = session.touches.first().map(|t| t.placement.clone()).unwrap_or_default();
            let view = |o: &handeye::Observation| {
                (name.clone(), o.base_from_flange.rename(), o.candidates.clone())
            };
            session.observations.iter().map(view).collect()
        }
    }
}

/// Adds one view of a board to the touches of it, in the reading that fits them best.
fn see(
    test: &mut Test,
    session: &Session,
    name: &str,
    base_from_mount: Pose<handeye::Base, Mount>,
    candidates: &[TargetPose],
    calibration: &Calibration,
) {
    let Some(target) = &session.target else { return };
    let base_from_camera = base_from_mount * test.mount_from_camera;
    let touched: Vec<usize> =
        (0..session.touches.len()).filter(|&k| session.touches[k].placement == name).collect();
    let corner = |k: usize| target.corner(session.touches[k].corner);
    let residual = |pose: &TargetPose| -> f64 {
        let of = |&k: &usize| {
            let there = base_from_camera * pose.camera_from_target * corner(k)?;
            Some((there.vector() - session.touches[k].in_base.vector()).norm())
        };
        touched.iter().filter_map(of).sum()
    };
    let best = candidates.iter().min_by(|a, b| residual(a).total_cmp(&residual(b)));
    let Some(pose) = best else { return };
    let board = test.poses.len();
    test.poses.push(pose.covariance.unwrap_or_else(Matrix6::zeros));
    let flange = (session.setup == Setup::EyeInHand).then(|| {
        test.poses.push(robot_covariance(calibration));
        board + 1
    });
    for k in touched {
        let Some(on_board) = corner(k) else { continue };
        let in_camera = pose.camera_from_target * on_board;
        let by_board: ByPose =
            verify::by_board(&base_from_camera, &pose.camera_from_target, &on_board);
        let in_mount = test.mount_from_camera * in_camera;
        let by_flange = flange.map(|f| (f, verify::by_mount(&base_from_mount, &in_mount)));
        let shared = [(board, by_board)].into_iter().chain(by_flange).collect();
        test.touches[k].sightings.push(Sighting {
            base_from_mount,
            in_camera,
            covariance: Matrix3::zeros(),
            shared,
        });
    }
}
