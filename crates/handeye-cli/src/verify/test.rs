//! What is tested: the touches of a file or a dataset, with all that makes them uncertain.

use std::path::Path;

use handeye::{
    Calibration, Pose, Setup, Warning,
    estimate::touch_pairs,
    tools::verify::{self, Sighting, Test, Touched},
};
use handeye_io::{Dataset, MANIFEST, TouchedPoint, measure, read_touched_points};
use nalgebra::Matrix3;

use crate::{
    args::{GlobalArgs, VerifyArgs},
    failure::Failure,
    progress::Progress,
};

/// The test of a calibration, and what to know about its touches.
pub(super) fn test(
    args: &VerifyArgs,
    calibration: &Calibration,
    path: &Path,
    global: &GlobalArgs,
) -> Result<(Test, Vec<Warning>), Failure> {
    let Some(mut test) = verify::of_calibration(calibration, args.touch_noise_mm * 1e-3) else {
        let what = "holds no transform (the data did not determine it): there is nothing to test";
        return Err(Failure::input(path, what));
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
            let flange = verify::shared_flange(test, base_from_mount.rename(), calibration);
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
    verify::add_boards(test, calibration, &session);
    Ok(warnings.into_iter().map(Warning::from).collect())
}
