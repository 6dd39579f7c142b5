//! `handeye detect`: the target's corners in images.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye::{
    GrayImage, ImageCorner, Intrinsics, detect,
    detect::{NotFound, residuals},
};
use handeye_io::{
    Targets,
    drawing::{self, Marks},
    image_size, parallel, read_image, read_intrinsics, read_targets, write_atomically,
};
use nalgebra::Vector2;
use serde::Serialize;
use serde_json::Value;

use crate::{
    args::{DetectArgs, GlobalArgs},
    failure::Failure,
    output,
    progress::Progress,
};

#[derive(Serialize)]
struct Found {
    path: PathBuf,
    found: bool,
    /// Why the image shows no target.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// Why the file cannot be used at all.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
    /// How far corners lie from where the board has them, by the smoothest view that fits.
    #[serde(skip_serializing_if = "Option::is_none")]
    residual_rms_px: Option<f64>,
    /// One by one, where several targets are looked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    targets: Vec<FoundTarget>,
    corners: Vec<Corner>,
}

/// What an image shows of one of several targets.
#[derive(Serialize)]
struct FoundTarget {
    name: String,
    found: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    residual_rms_px: Option<f64>,
    corners: usize,
}

#[derive(Serialize)]
struct Corner {
    /// Which of several targets it belongs to.
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<String>,
    id: u32,
    x_px: f64,
    y_px: f64,
    covariance_px2: [[f64; 2]; 2],
}

#[derive(Serialize)]
struct Answer {
    images: Vec<Found>,
    /// The first file that cannot be used.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Value>,
}

pub fn run(args: &DetectArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let targets = read_targets(&args.target)?;
    let camera = camera(args)?;
    let drawings = drawings(args)?;
    let search = Search { targets: &targets, camera: camera.as_ref() };
    let progress = Progress::new("looking at images", global);
    let threads = parallel::threads(args.images.iter().map(PathBuf::as_path));
    let tell = |done, count| progress.tell(done, count);
    let looked = parallel::in_order_told(args.images.len(), threads, &tell, |k| {
        search.look_at(&args.images[k], drawings.get(k))
    });
    drop(progress);
    let failures: Vec<&Failure> = looked.iter().filter_map(|l| l.as_ref().err()).collect();
    let (error, code) = (failures.first().map(|f| f.json()), failures.first().map(|_| 1));
    failures.iter().for_each(|failure| failure.tell(false));
    let images = args.images.iter().zip(looked);
    let images: Vec<Found> =
        images.map(|(path, l)| l.unwrap_or_else(|f| unusable(path, &f))).collect();
    let nothing = if images.iter().any(|i| i.found) { 0 } else { 3 };
    let answer = Answer { images, error };
    if global.json {
        output::json(&answer);
    } else {
        output::print(&table(&answer, &targets));
    }
    Ok(code.unwrap_or(nothing))
}

fn unusable(path: &Path, failure: &Failure) -> Found {
    let (path, error) = (path.to_path_buf(), Some(failure.to_string()));
    let (reason, residual_rms_px) = (None, None);
    let (targets, corners) = (vec![], vec![]);
    Found { path, found: false, reason, error, residual_rms_px, targets, corners }
}

/// The camera of `--camera`; a file that does not say its images' size has that of the first one.
fn camera(args: &DetectArgs) -> Result<Option<Intrinsics>, Failure> {
    let Some(file) = &args.camera else { return Ok(None) };
    let name = args.camera_name.as_deref();
    if let Ok(camera) = read_intrinsics(file, name, None) {
        return Ok(Some(camera));
    }
    let size = args.images.iter().find_map(|image| image_size(image).ok());
    Ok(Some(read_intrinsics(file, name, size)?))
}

/// What is looked for, and with which camera.
struct Search<'a> {
    targets: &'a Targets,
    camera: Option<&'a Intrinsics>,
}

impl Search<'_> {
    fn look_at(&self, path: &Path, drawing: Option<&PathBuf>) -> Result<Found, Failure> {
        let image = read_image(path, None)?;
        let size = (image.width(), image.height());
        self.check_size(path, size)?;
        let seen = self.seen(&image);
        if let Some(drawing) = drawing {
            let marks: Vec<Marks> = seen.iter().map(Seen::marks).collect();
            write_atomically(drawing, &drawing::marked(&image, &marks))?;
        }
        let residuals: Vec<_> =
            seen.iter().filter_map(|s| s.residuals.as_deref()).flatten().copied().collect();
        let reason = match &seen[..] {
            [one] => one.reason.clone(),
            all if all.iter().all(|s| s.reason.is_some()) => Some("none of the targets".into()),
            _ => None,
        };
        Ok(Found {
            path: path.to_path_buf(),
            found: reason.is_none(),
            reason,
            error: None,
            residual_rms_px: (!residuals.is_empty()).then(|| residuals::rms(&residuals)),
            targets: seen.iter().filter_map(Seen::summary).collect(),
            corners: seen.iter().flat_map(Seen::listed).collect(),
        })
    }

    /// What the image shows of each target.
    fn seen(&self, image: &GrayImage) -> Vec<Seen<'_>> {
        let models = self.targets.models();
        let outcomes = match &models[..] {
            [one] => vec![detect::detect_with(image, one, self.camera)],
            several => detect::detect_several(image, several, self.camera),
        };
        let size = (image.width(), image.height());
        let seen = |(k, outcome): (usize, Result<Vec<ImageCorner>, NotFound>)| {
            let (corners, reason) = match outcome {
                Ok(corners) => (corners, None),
                Err(reason) => (vec![], Some(reason.to_string())),
            };
            let residuals = residuals::residuals(&corners, models[k], size, self.camera);
            Seen { name: self.targets.name(k), corners, residuals, reason }
        };
        outcomes.into_iter().enumerate().map(seen).collect()
    }

    fn check_size(&self, path: &Path, (width, height): (usize, usize)) -> Result<(), Failure> {
        let Some(camera) = self.camera else { return Ok(()) };
        if (camera.width as usize, camera.height as usize) == (width, height) {
            return Ok(());
        }
        let (calibrated_width, calibrated_height) = (camera.width, camera.height);
        let what = format!(
            "the image is {width} x {height} pixels, the camera was calibrated at \
             {calibrated_width} x {calibrated_height}; give intrinsics for this size"
        );
        Err(Failure::input(path, what))
    }
}

/// What an image shows of a target.
struct Seen<'a> {
    name: Option<&'a str>,
    corners: Vec<ImageCorner>,
    residuals: Option<Vec<Vector2<f64>>>,
    reason: Option<String>,
}

impl Seen<'_> {
    fn marks(&self) -> Marks<'_> {
        let residuals = self.residuals.as_deref();
        Marks { name: self.name, corners: &self.corners, residuals }
    }

    /// `None` where there is only one target.
    fn summary(&self) -> Option<FoundTarget> {
        Some(FoundTarget {
            name: self.name?.into(),
            found: self.reason.is_none(),
            reason: self.reason.clone(),
            residual_rms_px: self.residuals.as_deref().map(residuals::rms),
            corners: self.corners.len(),
        })
    }

    fn listed(&self) -> impl Iterator<Item = Corner> {
        self.corners.iter().map(|c| corner(c, self.name))
    }
}

fn corner(c: &ImageCorner, target: Option<&str>) -> Corner {
    let s = &c.covariance;
    Corner {
        target: target.map(String::from),
        id: c.id,
        x_px: c.pixel.x,
        y_px: c.pixel.y,
        covariance_px2: [[s[(0, 0)], s[(0, 1)]], [s[(1, 0)], s[(1, 1)]]],
    }
}

/// Where each image is drawn to: none without `--draw`.
fn drawings(args: &DetectArgs) -> Result<Vec<PathBuf>, Failure> {
    let Some(folder) = &args.draw else { return Ok(vec![]) };
    fs::create_dir_all(folder).map_err(|e| Failure::no_folder(folder, e))?;
    let mut taken: Vec<PathBuf> = vec![];
    for image in &args.images {
        let stem = image.file_stem().unwrap_or_default().to_string_lossy();
        let mut file = folder.join(format!("{stem}_corners.png"));
        if taken.contains(&file) {
            file = folder.join(format!("{stem}_corners_{}.png", taken.len() + 1));
        }
        taken.push(file);
    }
    Ok(taken)
}

fn table(answer: &Answer, targets: &Targets) -> String {
    let all: usize = targets.models().iter().map(|t| t.len()).sum();
    let line = |image: &Found| match (&image.reason, &image.error) {
        (Some(reason), _) => format!("    - {}: {reason}\n", image.path.display()),
        (_, Some(error)) => format!("    ! {error}\n"),
        _ => {
            let rms = image.residual_rms_px.map(|rms| format!("rms {rms:.3} px"));
            let targets: String = image.targets.iter().map(line_of_target).collect();
            format!(
                "{:>5} of {all} corners  {:<13}  {}\n{targets}",
                image.corners.len(),
                rms.unwrap_or_default(),
                image.path.display()
            )
        }
    };
    let found = answer.images.iter().filter(|i| i.found).count();
    let of_each = per_target(answer, targets);
    let lines: String = answer.images.iter().map(line).collect();
    let count = answer.images.len();
    match targets {
        Targets::One(..) => format!("{lines}target found in {found} of {count} images\n"),
        Targets::Several(_) => format!("{lines}targets found in {count} images: {of_each}\n"),
    }
}

/// The line of one of several targets, below its image's.
fn line_of_target(target: &FoundTarget) -> String {
    match &target.reason {
        Some(reason) => format!("        - {}: {reason}\n", target.name),
        None => format!("        {:>5} of {}\n", target.corners, target.name),
    }
}

fn per_target(answer: &Answer, targets: &Targets) -> String {
    let count = |name: &str| {
        let all = answer.images.iter().flat_map(|i| &i.targets);
        all.filter(|t| t.found && t.name == name).count()
    };
    let names = (0..targets.models().len()).filter_map(|k| targets.name(k));
    let each: Vec<String> = names.map(|name| format!("{name} {}", count(name))).collect();
    each.join(", ")
}
