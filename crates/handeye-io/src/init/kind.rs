//! What files hold, proven from their content.

use std::{
    collections::HashSet,
    path::{Path, PathBuf},
};

use handeye::TargetModel;
use image::{ColorType, ImageDecoder, ImageReader};

use super::{
    fields::{Field, fields},
    groups::Group,
};
use crate::{
    camera::read_intrinsics,
    dataset::without_labels,
    image::image_size,
    robot,
    table::{self, Cell, Layout, Record},
    target_file::read_target,
    tree::Tree,
    units::LengthUnit,
};

/// What a group of files holds.
#[derive(Debug, Clone)]
pub(super) enum Kind {
    Pictures,
    Depth,
    Clouds,
    Corners,
    Poses(Poses),
    Touches(Touches),
    Camera,
    Target(TargetModel),
    /// A table or document of numbers that is none of these, as far as its content tells; where in
    /// it poses may stand.
    Table(Vec<Field>),
    Nothing,
}

/// Poses of something, and what their numbers prove.
#[derive(Debug, Clone)]
pub(super) struct Poses {
    pub(super) count: usize,
    pub(super) notation: Notation,
    /// Makers' notations whose numbers are called as in the file's header.
    pub(super) called_as: Vec<&'static str>,
    /// The unit of the positions and why it must be that.
    pub(super) unit: Option<(LengthUnit, String)>,
}

/// The notation, as far as the numbers prove it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Notation {
    /// Proven.
    Is(&'static str),
    /// A position and a unit quaternion without names.
    SomeQuaternion,
    /// A position and three more numbers.
    SomeAngles {
        /// Some number is too large for radians.
        degrees: bool,
    },
    Joints,
}

/// Touched corners.
#[derive(Debug, Clone)]
pub(super) struct Touches {
    pub(super) count: usize,
    pub(super) placements: Vec<String>,
    /// Poses of the flange; otherwise points of the tip.
    pub(super) poses: Option<Poses>,
    pub(super) unit: Option<(LengthUnit, String)>,
}

const PICTURES: [&str; 6] = ["png", "jpg", "jpeg", "bmp", "tif", "tiff"];
const CLOUDS: [&str; 7] = ["ply", "pcd", "e57", "zdf", "xyz", "asc", "pts"];
const TABLES: [&str; 13] =
    ["csv", "txt", "json", "yaml", "yml", "npy", "npz", "dat", "src", "mod", "prg", "ls", "jbi"];
const CAMERAS: [&str; 5] = ["yaml", "yml", "json", "xml", "npz"];
/// Words in names of depth images.
const DEPTH: [&str; 5] = ["depth", "scan", "range", "disp", "xyz"];
/// Most files of one group that may each be a camera's calibration.
const MOST_CAMERAS: usize = 8;
/// An array of more rows and columns than this is an image of depths, no table.
const LARGEST_TABLE: usize = 64;
/// So many lines of three numbers are the points of a scan.
const FEWEST_POINTS: usize = 1000;
/// Larger tables are not looked into.
const MOST_BYTES: u64 = 16 << 20;

/// What a group holds.
pub(super) fn kind(group: &Group, root: &Path) -> Kind {
    let extension = group.extension();
    let is = |kinds: &[&str]| kinds.contains(&extension.as_str());
    let first = root.join(&group.members[0]);
    match () {
        () if is(&PICTURES) && group.is_called(&DEPTH) && is_depth(&first) => Kind::Depth,
        () if is(&PICTURES) => Kind::Pictures,
        () if is(&CLOUDS) => Kind::Clouds,
        () if is(&["toml"]) => read_target(&first).map_or(Kind::Nothing, Kind::Target),
        () if is(&CAMERAS) && is_camera(group, root) => Kind::Camera,
        () if is(&TABLES) => table(group, root),
        () => Kind::Nothing,
    }
}

/// Grey with more than 8 bits.
fn is_depth(path: &Path) -> bool {
    let reader = ImageReader::open(path).ok().and_then(|r| r.with_guessed_format().ok());
    let colour = reader.and_then(|r| r.into_decoder().ok()).map(|d| d.color_type());
    colour.is_none_or(|c| c == ColorType::L16) // TIFF of floats has no colour here
}

fn is_camera(group: &Group, root: &Path) -> bool {
    // a size that the file leaves open comes from the images; any will do here
    let any_size = Some((640, 480));
    let reads = |p: &PathBuf| {
        let path = root.join(p);
        read_intrinsics(&path, None, None).or(read_intrinsics(&path, None, any_size)).is_ok()
    };
    group.members.len() <= MOST_CAMERAS && group.members.iter().all(reads)
}

/// Width and height of a group's images.
pub(super) fn size_of(group: &Group, root: &Path) -> Option<(u32, u32)> {
    image_size(&root.join(&group.members[0])).ok()
}

fn table(group: &Group, root: &Path) -> Kind {
    let paths: Vec<PathBuf> = group.members.iter().map(|m| root.join(m)).collect();
    if std::fs::metadata(&paths[0]).is_ok_and(|m| m.len() > MOST_BYTES) {
        return Kind::Nothing;
    }
    let alone = table::records(&paths[0], &Layout::default()).unwrap_or_default();
    let wide = |r: &Record| r.cells.len() >= LARGEST_TABLE;
    if alone.len() >= LARGEST_TABLE && alone.iter().all(wide) {
        return Kind::Depth;
    }
    let of_a_point = |r: &Record| r.cells.len() == 3 && numbers(r).len() == 3;
    let is_text = ["csv", "txt"].contains(&group.extension().as_str());
    if is_text && alone.len() >= FEWEST_POINTS && alone.iter().all(of_a_point) {
        return Kind::Clouds;
    }
    if is_list_of_corners(&alone) {
        return Kind::Corners;
    }
    if let Some(touches) = touches(&alone, group) {
        return Kind::Touches(touches);
    }
    if let Some(poses) = poses_in(&paths) {
        return Kind::Poses(poses);
    }
    if group.is_called(&["readme", "license", "package.json"]) {
        return Kind::Nothing;
    }
    if ["json", "yaml", "yml"].contains(&group.extension().as_str()) {
        let fields = Tree::read(&paths[0]).map(|tree| fields(&tree)).unwrap_or_default();
        return if fields.is_empty() { Kind::Nothing } else { Kind::Table(fields) };
    }
    let of_a_pose = |r: &Record| numbers(r).len() >= LEAST_NUMBERS;
    let table = !alone.is_empty() && alone.iter().all(of_a_pose);
    if table { Kind::Table(vec![]) } else { Kind::Nothing }
}

/// A pose has no fewer numbers.
const LEAST_NUMBERS: usize = 6;

fn poses_in(paths: &[PathBuf]) -> Option<Poses> {
    for matrices in [false, true] {
        let layout = Layout { matrices, ..Layout::default() };
        for field in ["", "data"] {
            let fields = if field.is_empty() { vec![] } else { vec![field.into()] };
            let layout = Layout { fields, ..layout.clone() };
            let records = match paths {
                [only] => table::records(only, &layout),
                several => table::record_per_file(several, &layout),
            };
            if let Some(poses) = records.ok().and_then(|r| poses(&r)) {
                return Some(as_program(poses, paths));
            }
        }
    }
    None
}

/// Poses in a program are written as its language has it.
fn as_program(poses: Poses, paths: &[PathBuf]) -> Poses {
    let program = paths.first().and_then(|path| table::program(path).ok().flatten());
    match program {
        Some((language, _)) => {
            Poses { notation: Notation::Is(language.notation()), unit: None, ..poses }
        }
        None => poses,
    }
}

// ---------------------------------------------------------------- corners, touches

fn has(record: &Record, name: &str) -> bool {
    record.named(&[name]).is_some()
}

fn all_named(record: &Record, names: &[&str]) -> bool {
    names.iter().all(|name| has(record, name))
}

/// Columns id, x, y and nothing in depth.
fn is_list_of_corners(records: &[Record]) -> bool {
    let corner = |r: &Record| {
        (has(r, "id") || has(r, "corner")) && all_named(r, &["x", "y"]) && !has(r, "z")
    };
    !records.is_empty() && records.iter().all(corner)
}

fn touches(records: &[Record], group: &Group) -> Option<Touches> {
    let first = records.first()?;
    let corner = ["corner", "corner_id"].iter().any(|n| has(first, n));
    let labelled = corner || all_named(first, &["row", "column"]);
    let numbers = first.cells.iter().filter(|c| matches!(c, Cell::Number(_))).count();
    if !(labelled || group.is_called(&["touch"])) || numbers < 3 {
        return None;
    }
    let mut seen = HashSet::new();
    let placements = records.iter().filter_map(|r| r.text_named(&["placement"]));
    let placements = placements.filter(|p| seen.insert(p.clone())).collect();
    let values: Vec<Record> = records.iter().map(without_labels).collect();
    let poses = poses(&values);
    let unit = unit(&values);
    Some(Touches { count: records.len(), placements, poses, unit })
}

// ---------------------------------------------------------------- poses

fn numbers(record: &Record) -> Vec<f64> {
    let number = |c: &Cell| match c {
        Cell::Number(x) => Some(*x),
        Cell::Text(_) => None,
    };
    record.cells.iter().filter_map(number).collect()
}

/// Records that can be poses, all of one kind.
fn poses(records: &[Record]) -> Option<Poses> {
    let first = notation(records.first()?)?;
    let same = |r: &Record| match (notation(r), first) {
        (Some(Notation::SomeAngles { .. }), Notation::SomeAngles { .. }) => true,
        (found, first) => found == Some(first),
    };
    if !records.iter().all(same) {
        return None;
    }
    let any_degrees =
        records.iter().any(|r| notation(r) == Some(Notation::SomeAngles { degrees: true }));
    let notation = match first {
        Notation::SomeAngles { .. } => Notation::SomeAngles { degrees: any_degrees },
        other => other,
    };
    let unit = match notation {
        Notation::Is("matrix4x4") => unit_at(records, |r| {
            let n = numbers(r);
            [n[3], n[7], n[11]]
        }),
        Notation::Is(_) | Notation::SomeQuaternion => unit(records),
        Notation::SomeAngles { .. } if all_named(&records[0], &["x", "y", "z"]) => unit(records),
        _ => None,
    };
    let called_as = robot::notations_called(&records[0]);
    Some(Poses { count: records.len(), notation, called_as, unit })
}

fn notation(record: &Record) -> Option<Notation> {
    let all = |names: &[&str]| all_named(record, names);
    if all(&["x", "y", "z"]) {
        return match () {
            () if all(&["qx", "qy", "qz", "qw"]) => Some(Notation::Is("quaternion-xyzw")),
            () if all(&["q1", "q2", "q3", "q4"]) => Some(Notation::Is("abb")),
            () if all(&["w", "p", "r"]) => Some(Notation::Is("fanuc")),
            () if all(&["o", "a", "t"]) => Some(Notation::Is("kawasaki")),
            () if all(&["a", "b", "c"]) || all(&["rx", "ry", "rz"]) => some_angles(record),
            () if all(&["roll", "pitch", "yaw"]) => some_angles(record),
            () => None,
        };
    }
    if ["joint_1", "j1", "q1"].iter().any(|n| has(record, n)) {
        return Some(Notation::Joints);
    }
    let plain = record.names.iter().all(String::is_empty) || record.names.is_empty();
    if plain { of_numbers(&numbers(record)) } else { None }
}

/// Most of a quaternion's or a matrix row's distance from length one.
const UNIT_TOLERANCE: f64 = 1e-2;

fn of_numbers(n: &[f64]) -> Option<Notation> {
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let unit = |v: &[f64]| (length(v) - 1.0).abs() < UNIT_TOLERANCE;
    let rows = |n: &[f64]| [0, 4, 8].iter().all(|&k| unit(&n[k..k + 3]));
    match n.len() {
        6 => Some(Notation::SomeAngles { degrees: n[3..].iter().any(|a| too_large(*a)) }),
        7 if unit(&n[3..]) => Some(Notation::SomeQuaternion),
        12 if rows(n) => Some(Notation::Is("matrix4x4")),
        16 if rows(n) && n[12..] == [0.0, 0.0, 0.0, 1.0] => Some(Notation::Is("matrix4x4")),
        _ => None,
    }
}

/// Beyond a full turn in radians.
fn too_large(angle: f64) -> bool {
    angle.abs() > 2.0 * std::f64::consts::PI + UNIT_TOLERANCE
}

fn some_angles(record: &Record) -> Option<Notation> {
    let angles = ["a", "b", "c", "rx", "ry", "rz", "roll", "pitch", "yaw"];
    let says_so = |name: &String| {
        ["[°]", "[deg]", "(°)", "(deg)", "_deg"].iter().any(|unit| name.ends_with(unit))
    };
    let degrees = record.names.iter().any(says_so)
        || angles.iter().any(|n| record.number_named(&[n]).is_some_and(too_large));
    Some(Notation::SomeAngles { degrees })
}

/// No arm reaches so far in metres: they are millimetres.
const FARTHEST_M: f64 = 300.0;
/// Arms that work within such a distance of their base do not exist in millimetres.
const NEAREST_MM: f64 = 5.0;

/// The unit of x, y and z: said in the header, or proven by their size.
fn unit(records: &[Record]) -> Option<(LengthUnit, String)> {
    let named = |name: &str| records[0].names.iter().any(|n| n.to_lowercase() == name);
    for unit in [LengthUnit::Millimetre, LengthUnit::Metre] {
        let name = unit.name();
        if named(&format!("x_{name}")) || named(&format!("x [{name}]")) {
            return Some((unit, "as the header says".into()));
        }
    }
    unit_at(records, |r| {
        let xyz = ["x", "y", "z"].map(|n| r.number_named(&[n]).unwrap_or(f64::NAN));
        let in_order = numbers(r).get(..3).and_then(|n| n.try_into().ok());
        if has(r, "x") { xyz } else { in_order.unwrap_or([f64::NAN; 3]) }
    })
}

fn unit_at(
    records: &[Record],
    position: impl Fn(&Record) -> [f64; 3],
) -> Option<(LengthUnit, String)> {
    let reach = |r: &Record| position(r).iter().map(|x| x * x).sum::<f64>().sqrt();
    let all: Vec<f64> = records.iter().map(reach).collect();
    let far = all.iter().copied().fold(0.0, f64::max);
    let why = format!("positions reach {far:.3} units");
    match far {
        _ if all.iter().any(|r| !r.is_finite()) => None,
        far if far >= FARTHEST_M => Some((LengthUnit::Millimetre, why)),
        far if far > 0.0 && far <= NEAREST_MM => Some((LengthUnit::Metre, why)),
        _ => None,
    }
}
