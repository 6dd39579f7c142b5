//! `handeye view`: a page that shows scans, calibrations and registrations in 3D.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use handeye::{Calibration, Scan, Setup, TriangleMesh, Verdict, Warning};
use handeye_io::{
    Dataset, is_mesh, read_result,
    report::{CellData, Shown, Thing, ThingCount, base_from_camera, shown_html},
    write_atomically,
};
use nalgebra::Isometry3;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::{
    args::{GlobalArgs, Reading, ViewArgs},
    failure::Failure,
    output, register,
};

/// Files of scans; of the others, meshes are told by themselves.
const SCANS: [&str; 14] = [
    "ply", "pcd", "e57", "zdf", "xyz", "txt", "csv", "asc", "pts", "npy", "npz", "png", "tif",
    "tiff",
];
/// What other files are told.
const KINDS: &str = "what can be viewed is scans (PLY, PCD, E57, ZDF, XYZ, TXT, CSV, ASC, PTS, NPY, NPZ, depth in \
                     PNG and TIFF), meshes (STL, OBJ, PLY with faces), the calibration.json of `handeye \
                     calibrate`, the folder of a dataset beside it, and an answer of `handeye register --json`";

/// What a file, or the folder of a result, holds.
enum Content {
    Scan(Scan),
    Mesh(TriangleMesh),
    Calibration(Box<Calibration>),
    Registration(Found),
    Dataset(Box<Dataset>),
}

/// The part of an answer of `register` that moves a scan.
struct Found {
    target_from_source: Isometry3<f64>,
    judged: Option<Judged>,
}

#[derive(Deserialize)]
struct Judged {
    verdict: Verdict,
    reasons: Vec<String>,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Told<'a> {
    page: &'a Path,
    layers: Vec<Layer>,
    notes: &'a [String],
    warnings: &'a [Warning],
}

#[derive(Serialize)]
struct Layer {
    name: String,
    what: &'static str,
    of: usize,
    shown: usize,
}

pub fn run(args: &ViewArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    register::is_no_input(&args.out, args.files.iter())?;
    let (mut contents, mut warnings) = (vec![], vec![]);
    for path in &args.files {
        contents.push(read(path, &args.reading, &mut warnings)?);
    }
    let mut data = cell_data(&contents)?;
    let frames = Frames::of(&args.files, &contents)?;
    let names = names(&args.files);
    let mut things = vec![];
    for (name, content) in names.iter().zip(&contents) {
        let name = name.clone();
        match content {
            Content::Scan(scan) => {
                let place = frames.place(&name, things.iter().all(is_calibration));
                things.push(Thing::Cloud { name, points: scan.points(), place });
            }
            Content::Mesh(mesh) => {
                let place = frames.place(&name, things.iter().all(is_calibration));
                let (vertices, triangles) = (mesh.vertices(), mesh.triangles());
                things.push(Thing::Mesh { name, vertices, triangles, place });
            }
            Content::Calibration(calibration) => {
                let data = data.take().unwrap_or_else(|| CellData {
                    camera: calibration.camera.as_ref().map(|c| c.intrinsics),
                    ..CellData::default()
                });
                things.push(Thing::Calibration { name, calibration, data });
            }
            Content::Registration(_) | Content::Dataset(_) => {}
        }
    }
    let (title, notes) = (names.join(", "), frames.notes);
    let is_in_base = frames.is_in_base;
    let (page, counts) =
        shown_html(&Shown { title, things, is_in_base, notes: &notes, warnings: &warnings });
    write_atomically(&args.out, page.as_bytes())?;
    let layer = |c: ThingCount| Layer { name: c.name, what: c.what, of: c.of, shown: c.shown };
    let layers = counts.into_iter().map(layer).collect();
    tell(&Told { page: &args.out, layers, notes: &notes, warnings: &warnings }, global);
    Ok(0)
}

/// What a dataset adds to the one calibration beside it, with all its scans.
fn cell_data(contents: &[Content]) -> Result<Option<CellData>, Failure> {
    let (mut datasets, mut calibrations) = (vec![], vec![]);
    for content in contents {
        match content {
            Content::Dataset(dataset) => datasets.push(dataset),
            Content::Calibration(calibration) => calibrations.push(calibration),
            _ => {}
        }
    }
    match (&datasets[..], &calibrations[..]) {
        ([], _) => Ok(None),
        ([dataset], [calibration]) => {
            Ok(Some(CellData::of(dataset, calibration).with_scans(dataset, calibration)?))
        }
        _ => {
            let what = "a dataset is shown with its result: name one dataset and one calibration.json, or the folder \
                        of the result";
            Err(Failure::Usage(what.into()))
        }
    }
}

fn is_calibration(thing: &Thing) -> bool {
    matches!(thing, Thing::Calibration { .. })
}

fn tell(told: &Told, global: &GlobalArgs) {
    if global.json {
        return output::json(told);
    }
    output::warn(told.warnings, global);
    let mut text = String::new();
    for layer in &told.layers {
        let shown = match layer.shown == layer.of {
            true => String::new(),
            false => format!("{} of ", layer.shown),
        };
        text += &format!("{}: {shown}{} {}\n", layer.name, layer.of, layer.what);
    }
    text += &told.notes.iter().map(|note| output::wrapped("", note)).collect::<String>();
    output::print(&format!("{text}page: {}\n", told.page.display()));
}

fn read(path: &Path, reading: &Reading, warnings: &mut Vec<Warning>) -> Result<Content, Failure> {
    let result = path.join("calibration.json");
    if result.is_file() {
        return read_json(&result);
    }
    if path.is_dir() {
        return Ok(Content::Dataset(Box::new(Dataset::open(path)?)));
    }
    let kind = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if kind == "json" {
        return read_json(path);
    }
    if is_mesh(path) {
        return register::read_triangles(path, reading, warnings).map(Content::Mesh);
    }
    if !SCANS.contains(&kind.as_str()) {
        return Err(Failure::input(
            path,
            format!("files of kind {kind:?} cannot be viewed; {KINDS}"),
        ));
    }
    register::read_points(path, reading, warnings).map(Content::Scan)
}

/// A result of this program, told by its keys.
fn read_json(path: &Path) -> Result<Content, Failure> {
    let text = fs::read_to_string(path).map_err(|error| Failure::unreadable(path, &error))?;
    let value: Value =
        serde_json::from_str(&text).map_err(|error| Failure::in_json(path, &error, ""))?;
    if value.get("target_from_source").is_some() {
        let target_from_source = register::initial(path)?;
        let judged = serde_json::from_value(value).ok();
        return Ok(Content::Registration(Found { target_from_source, judged }));
    }
    if value.get("hand_eye").is_none() && value.get("translation_m").is_none() {
        return Err(Failure::input(
            path,
            format!("is neither a calibration nor a registration; {KINDS}"),
        ));
    }
    let calibration = read_result(path)?;
    if calibration.hand_eye.mount_from_camera.is_none() {
        let what = "holds no transform: the data did not determine it; nothing of it can be drawn";
        return Err(Failure::input(path, what));
    }
    Ok(Content::Calibration(Box::new(calibration)))
}

/// Names without folders, where these are enough to tell files apart.
fn names(files: &[PathBuf]) -> Vec<String> {
    let short: Vec<String> = files.iter().map(|path| register::name_of(path)).collect();
    let is_single = |name: &String| short.iter().filter(|other| *other == name).count() == 1;
    if short.iter().all(is_single) {
        return short;
    }
    files.iter().map(|path| path.display().to_string()).collect()
}

/// Where scans are drawn.
struct Frames {
    /// Of the first scan.
    target_from_source: Isometry3<f64>,
    /// Of all scans.
    base_from_camera: Isometry3<f64>,
    /// Of each scan by its name, where the robot carried the camera.
    base_from_moving: BTreeMap<String, Isometry3<f64>>,
    /// Whether the view is that of a robot's base.
    is_in_base: bool,
    /// What was moved where.
    notes: Vec<String>,
}

impl Frames {
    fn of(files: &[PathBuf], contents: &[Content]) -> Result<Self, Failure> {
        let mut frames = Self {
            target_from_source: Isometry3::identity(),
            base_from_camera: Isometry3::identity(),
            base_from_moving: BTreeMap::new(),
            is_in_base: false,
            notes: vec![],
        };
        let names = names(files);
        let named = || names.iter().zip(contents);
        let scans: Vec<&String> = named()
            .filter(|(_, c)| matches!(c, Content::Scan(_) | Content::Mesh(_)))
            .map(|(name, _)| name)
            .collect();
        let found: Vec<(&String, &Found)> = named()
            .filter_map(|(name, c)| match c {
                Content::Registration(found) => Some((name, found)),
                _ => None,
            })
            .collect();
        let calibrations: Vec<(&String, &Calibration)> = named()
            .filter_map(|(name, c)| match c {
                Content::Calibration(calibration) => Some((name, &**calibration)),
                _ => None,
            })
            .collect();
        frames.register(&found, &scans)?;
        let has_mesh = contents.iter().any(|c| matches!(c, Content::Mesh(_)));
        frames.calibrate(&calibrations, &scans, has_mesh);
        if frames.notes.is_empty() && scans.len() > 1 {
            frames.notes.push(
                "every scan lies in its own frame: they show one scene only where the camera stood still, or \
                 where they were brought into one frame before"
                    .into(),
            );
        }
        Ok(frames)
    }

    /// Moves the first scan.
    fn register(&mut self, found: &[(&String, &Found)], scans: &[&String]) -> Result<(), Failure> {
        let (name, found) = match found {
            [] => return Ok(()),
            [one] => *one,
            _ => {
                return Err(Failure::Usage(
                    "one registration can be shown at a time: it moves the first scan into the second".into(),
                ));
            }
        };
        let [first, second, ..] = scans else {
            return Err(Failure::Usage(format!(
                "{name} is a registration: name the scan that it moves and the one that stays as well"
            )));
        };
        self.target_from_source = found.target_from_source;
        self.notes.push(format!(
            "{first} was moved by target_from_source of {name}, into the frame of {second}{}",
            found.judged.as_ref().map_or(String::new(), |j| doubt(j.verdict, &j.reasons))
        ));
        Ok(())
    }

    /// Moves all scans, where it is known whereto.
    fn calibrate(
        &mut self,
        calibrations: &[(&String, &Calibration)],
        scans: &[&String],
        has_mesh: bool,
    ) {
        self.is_in_base = !calibrations.is_empty();
        for (name, c) in calibrations.iter().filter(|(_, c)| c.verdict != Verdict::Accepted) {
            self.notes.push(format!("{name} is shown{}", doubt(c.verdict, &c.reasons)));
        }
        if scans.is_empty() || calibrations.is_empty() {
            return;
        }
        match calibrations {
            _ if has_mesh => self.notes.push(
                "a mesh lies in a frame of its own, which is not the camera's: nothing was moved into the frame of \
                 the robot's base, and how meshes and scans lie to the calibration means nothing"
                    .into(),
            ),
            [(name, c)] if c.setup == Setup::EyeToHand => {
                if let Some(pose) = &c.hand_eye.mount_from_camera {
                    self.base_from_camera = *pose.iso();
                }
                self.notes.push(format!(
                    "scans were moved from the frame of the camera into that of the robot's base, by {name}"
                ));
            }
            [(name, c)] if self.move_by_captures(c, scans) => self.notes.push(format!(
                "each scan was moved into the frame of the robot's base by {name} and the robot pose of its capture \
                 of the same name: this holds for scans of the dataset of {name} only"
            )),
            _ => self.notes.push(
                "scans lie in their own frame, calibrations in that of the robot's base: how they lie to one \
                 another means nothing. One eye-to-hand calibration moves them; one of a camera on the \
                 flange does where the scans are named as its captures are, which tell where the robot was"
                    .into(),
            ),
        }
    }

    /// Whether all scans have the names of captures, and are then moved to where the robot held the camera.
    fn move_by_captures(&mut self, c: &Calibration, scans: &[&String]) -> bool {
        let place = |name: &&String| {
            let stem = Path::new(name.as_str()).file_stem()?.to_str()?;
            let capture = c.captures.iter().find(|k| k.id == stem)?;
            let mount_from_camera = c.hand_eye.mount_from_camera?;
            let pose = base_from_camera(c.setup, mount_from_camera.iso(), capture);
            Some((name.to_string(), *pose.iso()))
        };
        match scans.iter().map(place).collect() {
            Some(all) => self.base_from_moving = all,
            None => return false,
        }
        true
    }

    fn place(&self, name: &str, is_first: bool) -> Isometry3<f64> {
        let base_from_camera = self.base_from_moving.get(name).unwrap_or(&self.base_from_camera);
        if is_first { base_from_camera * self.target_from_source } else { *base_from_camera }
    }
}

/// Said of what was not accepted.
fn doubt(verdict: Verdict, reasons: &[String]) -> String {
    let word = match verdict {
        Verdict::Accepted => return String::new(),
        Verdict::Rejected => "rejected",
        Verdict::Undetermined => "undetermined",
    };
    let why = reasons.first().map_or(String::new(), |reason| format!(" ({reason})"));
    format!(", although its verdict is {word}{why}")
}
