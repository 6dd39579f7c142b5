//! A simulated cell as a folder of captures, with its truth beside it.
//!
//! The folder is what a user would have recorded: manifest, images or corners, scans, robot
//! poses, touches. `truth.json` holds what nobody would know, and the list of all files with their
//! fingerprints, by which a later run knows its own folder again. Everything is written aside first,
//! and moved into its place when it is complete.

mod manifest;
mod pictures;

use std::{
    fmt::Write as _,
    fs,
    path::{Component, Path, PathBuf},
};

use handeye::{
    Base, Camera, Flange, ImageCorner, Pose, Target,
    simulate::{Recording, cell::placement_name},
};
use serde_json::{Map, Value, json};

use crate::{
    Error, MANIFEST,
    files::{process, write_atomically},
    hash::Hash,
    robot::arm_file,
};

pub(crate) use manifest::camera;
pub use pictures::{cloud, picture};

/// Name of the file with the truth.
pub const TRUTH: &str = "truth.json";
/// Version of its format.
const FORMAT: &str = "handeye-simulation-1";
/// Name of the arm's model.
const ARM: &str = "arm.json";

/// What a dataset is written as.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Writing {
    /// Images and scans; otherwise lists of corners.
    pub images: bool,
    /// Format of the scans.
    pub scans: ScanFormat,
}

/// How scans are written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ScanFormat {
    /// Depth images of 16 bits.
    DepthPng,
    /// Organised PLY, binary, metres.
    Ply,
    /// Organised PCD, binary, metres.
    Pcd,
}

impl ScanFormat {
    fn ending(self) -> &'static str {
        match self {
            ScanFormat::DepthPng => "png",
            ScanFormat::Ply => "ply",
            ScanFormat::Pcd => "pcd",
        }
    }
}

/// Writes everything into a folder, made if need be, in place of an earlier simulation, and returns
/// the names of the files; one image at a time is in memory.
///
/// # Errors
/// What cannot be written; an earlier simulation stays until all of the new one is written.
pub fn write(recording: &Recording, out: &Path, writing: Writing) -> Result<Vec<String>, Error> {
    let is_new = !out.exists();
    let aside = out.join(format!(".simulation.{}.part", process()));
    let written = write_aside(recording, &aside, writing).and_then(|names| {
        clear(out)?;
        names.iter().try_for_each(|name| move_file(&aside, out, name))?;
        Ok(names)
    });
    fs::remove_dir_all(&aside).ok();
    if is_new && written.is_err() {
        fs::remove_dir(out).ok();
    }
    written
}

fn move_file(from: &Path, to: &Path, name: &str) -> Result<(), Error> {
    let path = to.join(name);
    let write = |source| Error::Write { path: path.clone(), source };
    fs::create_dir_all(path.parent().unwrap_or(to)).map_err(write)?;
    fs::rename(from.join(name), &path).map_err(write)
}

fn write_aside(
    recording: &Recording,
    aside: &Path,
    writing: Writing,
) -> Result<Vec<String>, Error> {
    let cell = recording.cell;
    let mut folder = Folder { out: aside, names: vec![], fingerprints: Map::new() };
    folder.add(MANIFEST, manifest::manifest(recording, writing).as_bytes())?;
    folder.add("robot.csv", robot(recording).as_bytes())?;
    if let Some(arm) = cell.built_arm() {
        folder.add(ARM, arm_file(&arm.model).as_bytes())?;
    }
    if !recording.touches.is_empty() {
        folder.add("touches.csv", touches(recording).as_bytes())?;
    }
    for k in 0..cell.captures + cell.placements {
        let name = name(recording, k);
        if !writing.images {
            let corners = corners(&recording.corners(k));
            folder.add(&format!("corners/{name}.csv"), corners.as_bytes())?;
            continue;
        }
        if !cell.target.is_empty() {
            folder.add(&format!("images/{name}.png"), &pictures::picture(&recording.picture(k)))?;
        }
        if let Some(scan) = recording.scan(k) {
            let file = format!("scans/{name}.{}", writing.scans.ending());
            folder.add(&file, &pictures::scan(&scan, writing.scans))?;
        }
    }
    let truth = format!("{:#}\n", truth(recording, &folder));
    folder.add(TRUTH, truth.as_bytes())?; // last: the folder is complete
    Ok(folder.names)
}

/// A file that no simulation wrote, or that was edited since: where there is one, `write` takes
/// somebody's work away or mixes with it.
pub fn foreign(out: &Path) -> Option<PathBuf> {
    let own = earlier(out).unwrap_or_default();
    let is_own = |path: &PathBuf| {
        let name = path.strip_prefix(out).unwrap_or(path);
        own.iter().any(|(own, print)| {
            let same = || fs::read(path).is_ok_and(|content| fingerprint(&content) == *print);
            own == name && (own == Path::new(TRUTH) || same())
        })
    };
    all_files(out).into_iter().find(|path| !is_own(path))
}

fn all_files(folder: &Path) -> Vec<PathBuf> {
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path()).collect();
    entries.sort();
    let below = |path: PathBuf| if path.is_dir() { all_files(&path) } else { vec![path] };
    entries.into_iter().flat_map(below).collect()
}

/// Removes what an earlier simulation wrote into a folder; says whether there was one.
///
/// # Errors
/// What cannot be removed.
pub fn clear(out: &Path) -> Result<bool, Error> {
    let Some(names) = earlier(out) else { return Ok(false) };
    for path in names.iter().map(|(name, _)| out.join(name)).filter(|path| path.is_file()) {
        fs::remove_file(&path).map_err(|source| Error::Write { path, source })?;
    }
    Ok(true)
}

/// The files of an earlier simulation with their fingerprints; only names inside the folder count.
fn earlier(out: &Path) -> Option<Vec<(PathBuf, String)>> {
    let truth: Value = serde_json::from_slice(&fs::read(out.join(TRUTH)).ok()?).ok()?;
    let own = truth["format"] == FORMAT;
    let names = truth["files"].as_array().filter(|_| own)?;
    let print = |name: &str| truth["fingerprints"][name].as_str().unwrap_or_default().to_owned();
    let inside = |p: &Path| p.components().all(|c| matches!(c, Component::Normal(_)));
    let named = names.iter().filter_map(Value::as_str).filter(|name| inside(Path::new(name)));
    Some(named.map(|name| (PathBuf::from(name), print(name))).collect())
}

/// Enough to notice an edit.
fn fingerprint(content: &[u8]) -> String {
    Hash::of(content).to_string()
}

struct Folder<'a> {
    out: &'a Path,
    names: Vec<String>,
    fingerprints: Map<String, Value>,
}

impl Folder<'_> {
    fn add(&mut self, name: &str, content: &[u8]) -> Result<(), Error> {
        let path = self.out.join(name);
        if let Some(parent) = path.parent() {
            let write = |source| Error::Write { path: parent.into(), source };
            fs::create_dir_all(parent).map_err(write)?;
        }
        write_atomically(&path, content)?;
        self.names.push(name.into());
        self.fingerprints.insert(name.into(), fingerprint(content).into());
        Ok(())
    }
}

fn name(recording: &Recording, k: usize) -> String {
    let captures = recording.cell.captures;
    if k < captures { format!("{:03}", k + 1) } else { placement_name(k - captures) }
}

// ---------------------------------------------------------------- tables

const POSE: &str = "x,y,z,qx,qy,qz,qw";

fn pose(p: &Pose<Base, Flange>) -> String {
    let (t, q) = (p.translation(), p.iso().rotation.coords);
    format!("{},{},{},{},{},{},{}", t.x, t.y, t.z, q.x, q.y, q.z, q.w)
}

/// A table with the columns of a pose, or of joint values.
struct PoseTable {
    columns: String,
}

impl PoseTable {
    fn new(recording: &Recording) -> Self {
        let joints = recording.joints.first().map_or(0, Vec::len);
        let names: Vec<String> = (1..=joints).map(|k| format!("joint_{k}")).collect();
        Self { columns: if joints == 0 { POSE.to_owned() } else { names.join(",") } }
    }

    fn line(&self, p: &Pose<Base, Flange>, joints: &[f64]) -> String {
        if joints.is_empty() {
            return pose(p);
        }
        joints.iter().map(|q| format!("{:?}", q.to_degrees())).collect::<Vec<_>>().join(",")
    }
}

fn robot(recording: &Recording) -> String {
    let table = PoseTable::new(recording);
    let mut text = format!("capture,{}\n", table.columns);
    for (k, (p, joints)) in recording.base_from_flange.iter().zip(&recording.joints).enumerate() {
        let _ = writeln!(text, "{:03},{}", k + 1, table.line(p, joints));
    }
    text
}

fn touches(recording: &Recording) -> String {
    let table = PoseTable::new(recording);
    let mut text = format!("placement,corner,{}\n", table.columns);
    for touch in &recording.touches {
        if let Some(p) = &touch.base_from_flange {
            let line = table.line(p, &touch.joints);
            let _ = writeln!(text, "{},{},{line}", touch.placement, touch.corner);
        }
    }
    text
}

fn corners(all: &[ImageCorner]) -> String {
    let line = |c: &ImageCorner| format!("{},{},{}\n", c.id, c.pixel.x, c.pixel.y);
    "id,x,y\n".to_owned() + &all.iter().map(line).collect::<String>()
}

// ---------------------------------------------------------------- truth

fn truth(recording: &Recording, folder: &Folder) -> Value {
    let (cell, truth) = (recording.cell, &recording.truth);
    let seen = |(k, p): (usize, &Pose<Camera, Target>)| {
        let place = truth.base_from_flange.get(k);
        json!({"id": name(recording, k), "camera_from_target": p, "base_from_flange": place})
    };
    let n = &cell.noise;
    let mut all = json!({
        "format": FORMAT,
        "seed": cell.seed,
        "setup": cell.setup,
        "mount_from_camera": truth.hand_eye.mount_from_camera,
        "anchor_from_target": truth.hand_eye.anchor_from_target,
        "tip_error_mm": (truth.tip_error * 1e3).as_slice(),
        "noise": {
            "robot_repeatability_mm": n.robot_repeatability_m * 1e3,
            "robot_repeatability_deg": n.robot_repeatability_rad.to_degrees(),
            "robot_absolute_mm": n.robot_absolute_m * 1e3,
            "robot_absolute_deg": n.robot_absolute_rad.to_degrees(),
            "robot_systematic_mm": n.robot_systematic_m * 1e3,
            "robot_systematic_deg": n.robot_systematic_rad.to_degrees(),
            "corner_px": n.corner_px,
            "touch_mm": n.touch_m * 1e3,
            "tip_mm": n.tip_m * 1e3,
            "depth_mm_at_1_m": cell.depth.map(|d| d.sigma_at_1m * 1e3),
            "black_step_mm": cell.depth.map(|d| d.black_step_m * 1e3),
            "scan_scale": cell.depth.map(|d| 1.0 + d.scale),
            "scan_tilt_deg": cell.depth.map(|d| d.turn_rad.map(f64::to_degrees)),
            "scan_shift_mm": cell.depth.map(|d| d.shift_m * 1e3),
            "bow_mm": cell.bow_mm,
            "print_scale": cell.print_scale,
            "picture_grey_values": cell.optics.noise,
            "picture_blur_px": cell.optics.blur_px,
        },
        "views": truth.camera_from_target.iter().enumerate().map(seen).collect::<Vec<_>>(),
        "files": folder.names.iter().map(String::as_str).chain([TRUTH]).collect::<Vec<_>>(),
        "fingerprints": folder.fingerprints,
    });
    if let Some(arm) = cell.built_arm() {
        all["arm"] = json!({
            "links": arm.links,
            "gears_rad": arm.gears,
            "bending_rad_per_m": arm.bending,
        });
    }
    all
}
