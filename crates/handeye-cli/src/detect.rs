//! `handeye detect`: the target's corners in pictures.

use std::{
    fs,
    path::{Path, PathBuf},
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
};

use handeye::{ImageCorner, TargetModel, detect};
use handeye_io::{drawing, image_size, read_image, read_target, write_atomically};
use serde::Serialize;
use serde_json::Value;

use crate::{
    args::{DetectArgs, Manners},
    failure::Failure,
    output,
    progress::Progress,
};

#[derive(Serialize)]
struct Found {
    path: PathBuf,
    found: bool,
    /// Why the picture shows no target.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// Why the file cannot be used at all.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
    corners: Vec<Corner>,
}

#[derive(Serialize)]
struct Corner {
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

pub fn run(args: &DetectArgs, manners: &Manners) -> Result<u8, Failure> {
    let target = read_target(&args.target)?;
    let drawings = drawings(args)?;
    let progress = Progress::new("looking at pictures", manners);
    let done = AtomicUsize::new(0);
    let looked = in_parallel(args.images.len(), threads(&args.images), |k| {
        let found = look_at(&args.images[k], &target, drawings.get(k));
        progress.tell(done.fetch_add(1, Ordering::Relaxed) + 1, args.images.len());
        found
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
    if manners.json {
        output::json(&answer);
    } else {
        output::print(&table(&answer, target.len()));
    }
    Ok(code.unwrap_or(nothing))
}

fn unusable(path: &Path, failure: &Failure) -> Found {
    let (path, error) = (path.to_path_buf(), Some(failure.to_string()));
    Found { path, found: false, reason: None, error, corners: vec![] }
}

/// Pictures larger than this (pixels) are worked on by two threads at most.
const LARGE_PICTURE: u64 = 6_000_000;
/// More threads than this only fight for memory.
const MOST_THREADS: usize = 8;

fn threads(images: &[PathBuf]) -> usize {
    let cores = std::thread::available_parallelism().map_or(1, usize::from).min(MOST_THREADS);
    let sizes = images.iter().filter_map(|i| image_size(i).ok());
    let large = sizes.map(|(w, h)| u64::from(w) * u64::from(h)).any(|n| n > LARGE_PICTURE);
    if large { cores.min(2) } else { cores }
}

/// `work(0), work(1) ...`, whatever order they were made in.
fn in_parallel<T: Send>(count: usize, threads: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let slots: Vec<Mutex<Option<T>>> = (0..count).map(|_| Mutex::new(None)).collect();
    let take = || {
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            let Some(slot) = slots.get(k) else { break };
            let result = work(k);
            if let Ok(mut slot) = slot.lock() {
                *slot = Some(result);
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.min(count) {
            scope.spawn(take);
        }
        take();
    });
    slots.into_iter().filter_map(|slot| slot.into_inner().ok().flatten()).collect()
}

fn look_at(path: &Path, target: &TargetModel, drawing: Option<&PathBuf>) -> Result<Found, Failure> {
    let image = read_image(path, None)?;
    let (corners, reason) = match detect::detect(&image, target) {
        Ok(corners) => (corners, None),
        Err(reason) => (vec![], Some(reason.to_string())),
    };
    if let Some(drawing) = drawing {
        write_atomically(drawing, &drawing::marked(&image, &corners))?;
    }
    Ok(Found {
        path: path.to_path_buf(),
        found: reason.is_none(),
        reason,
        error: None,
        corners: corners.iter().map(corner).collect(),
    })
}

fn corner(c: &ImageCorner) -> Corner {
    let s = &c.covariance;
    Corner {
        id: c.id,
        x_px: c.pixel.x,
        y_px: c.pixel.y,
        covariance_px2: [[s[(0, 0)], s[(0, 1)]], [s[(1, 0)], s[(1, 1)]]],
    }
}

/// Where each picture is drawn to: none without `--draw`.
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

fn table(answer: &Answer, all: usize) -> String {
    let line = |image: &Found| match (&image.reason, &image.error) {
        (Some(reason), _) => format!("    - {}: {reason}\n", image.path.display()),
        (_, Some(error)) => format!("    ! {error}\n"),
        _ => {
            format!("{:>5} of {all} corners  {}\n", image.corners.len(), image.path.display())
        }
    };
    let found = answer.images.iter().filter(|i| i.found).count();
    let lines: String = answer.images.iter().map(line).collect();
    format!("{lines}target found in {found} of {} pictures\n", answer.images.len())
}
