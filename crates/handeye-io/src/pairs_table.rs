//! Pairs of poses in tables and arrays: what a spreadsheet, NumPy or MATLAB saves.
//!
//! A record holds `base_from_flange` and `camera_from_target`, each as a position (m) and a quaternion x y z w, or as a
//! matrix of 4 x 4, row by row. An archive holds two arrays with these names. Relative motions are written alike: `A`
//! and `B`.

use std::path::Path;

use handeye::{
    Base, Camera, Flange, Mount, Observation, Pose, RelativeMotion, Session, Setup, Target,
    estimate::KnownNoise,
};

use crate::{
    error::{Error, malformed, unusable},
    files,
    pairs_file::{MeasuredPoses, PosesFile, of_motions},
    robot::Notation,
    table::{self, Cell, Layout, Record, is_id_name, plain},
    units::{farthest, too_far},
};

/// What the two poses of a record are called.
const NAMES: [&str; 2] = ["base_from_flange", "camera_from_target"];
/// The same of two motions.
const MOTIONS: [&str; 2] = ["A", "B"];

/// Whether a file holds pairs as [`read_pairs_table`] reads them, by its name; a text that begins as JSON does not.
pub fn is_pairs_table(path: &Path) -> bool {
    match files::extension(path).as_str() {
        "csv" | "npy" | "npz" => true,
        "txt" => !files::text(path).is_ok_and(|text| text.trim_start().starts_with('{')),
        _ => false,
    }
}

/// Reads pairs from a CSV, TXT, NPY or NPZ file; `setup` is what it cannot say.
///
/// # Errors
/// Files that cannot be read, numbers that are no poses, ids that are there twice; with the line or row.
pub fn read_pairs_table(path: &Path, setup: Setup) -> Result<PosesFile, Error> {
    let [robot, camera] = both(path, NAMES)?;
    let mut seen = std::collections::HashSet::new();
    let mut observations = vec![];
    for (k, (robot, camera)) in robot.iter().zip(&camera).enumerate() {
        let capture = robot.id.clone().unwrap_or_else(|| (k + 1).to_string());
        if !seen.insert(capture.clone()) {
            return Err(robot.refuse(
                format!("the id {capture:?} is there twice"),
                "give each pair an id of its own",
            ));
        }
        let base_from_flange: Pose<Base, Flange> = pose(robot, NAMES[0])?;
        let camera_from_target: Pose<Camera, Target> = pose(camera, NAMES[1])?;
        observations.push(Observation::bare(capture, base_from_flange, camera_from_target));
    }
    let session = Session { in_sequence: true, ..Session::of_captures(setup, observations) };
    Ok(PosesFile {
        measured: MeasuredPoses::Pairs(Box::new(session)),
        noise: KnownNoise::default(),
    })
}

/// Reads relative motions from such a file: `A`, what carries the camera, and `B`, the camera.
///
/// # Errors
/// As [`read_pairs_table`].
pub fn read_motions_table(path: &Path, setup: Setup) -> Result<PosesFile, Error> {
    let [mounts, cameras] = both(path, MOTIONS)?;
    let motion = |(k, (a, b)): (usize, (&Record, &Record))| {
        let mount_motion: Pose<Mount, Mount> = pose(a, MOTIONS[0])?;
        let camera_motion: Pose<Camera, Camera> = pose(b, MOTIONS[1])?;
        let id = a.id.clone().unwrap_or_else(|| (k + 1).to_string());
        Ok(RelativeMotion { id, mount_motion, camera_motion })
    };
    let motions: Result<Vec<_>, Error> =
        mounts.iter().zip(&cameras).enumerate().map(motion).collect();
    let session = of_motions(setup, motions?, None, path)?;
    Ok(PosesFile {
        measured: MeasuredPoses::Pairs(Box::new(session)),
        noise: KnownNoise::default(),
    })
}

/// The first and the second poses of all records.
fn both(path: &Path, names: [&str; 2]) -> Result<[Vec<Record>; 2], Error> {
    match files::extension(path).as_str() {
        "npz" => apart(path, names),
        _ => halves(table::records(path, &Layout::default())?),
    }
}

/// The two arrays of an archive.
fn apart(path: &Path, names: [&str; 2]) -> Result<[Vec<Record>; 2], Error> {
    let read = |name: &str| {
        table::records(path, &Layout { fields: vec![name.into()], ..Layout::default() })
    };
    let [robot, camera] = [read(names[0])?, read(names[1])?];
    if robot.len() == camera.len() {
        return Ok([robot, camera]);
    }
    let what =
        format!("holds {} of {} but {} of {}", robot.len(), names[0], camera.len(), names[1]);
    Err(unusable(path, format!("{what}: each pair needs both")))
}

/// Records of two poses each, in two.
fn halves(records: Vec<Record>) -> Result<[Vec<Record>; 2], Error> {
    let mut both = [vec![], vec![]];
    for record in records {
        let (id, numbers) = id_and_numbers(&record)?;
        for (half, cells) in both.iter_mut().zip(numbers.chunks(numbers.len() / 2)) {
            let (names, place) = (vec![], record.place.clone());
            half.push(Record {
                cells: cells.to_vec(),
                names,
                by_header: false,
                id: id.clone(),
                place,
            });
        }
    }
    Ok(both)
}

/// How many numbers two poses have: as quaternions, or as matrices.
const COUNTS: [usize; 2] = [14, 32];

/// What a record is called, and the numbers of its two poses.
fn id_and_numbers(record: &Record) -> Result<(Option<String>, Vec<Cell>), Error> {
    // an index before the numbers is a name, too
    let is_named = record.id.is_some() || COUNTS.contains(&(record.cells.len().max(1) - 1));
    let at = record.names.iter().position(|name| is_id_name(name)).or(is_named.then_some(0));
    let id = record.id.clone().or_else(|| record.first_as_text().filter(|_| is_named));
    let is_number = |(k, _): &(usize, &Cell)| Some(*k) != at;
    let numbers: Vec<Cell> =
        record.cells.iter().enumerate().filter(is_number).map(|(_, c)| c.clone()).collect();
    if !COUNTS.contains(&numbers.len()) {
        let what = format!("has {} numbers, but a pair has 14 or 32", numbers.len());
        return Err(record.refuse(what, ADVICE));
    }
    let names: Vec<&String> = record
        .names
        .iter()
        .enumerate()
        .filter(|(k, _)| Some(*k) != at)
        .map(|(_, name)| name)
        .collect();
    match contradiction(&names) {
        Some(name) => {
            Err(record
                .refuse(format!("the column \"{name}\" is not what stands at its place"), ADVICE))
        }
        None => Ok((id, numbers)),
    }
}

/// How a pair is written.
const ADVICE: &str = "write base_from_flange and camera_from_target, in this order, each as x y z (m) and quaternion x y z \
                      w, or as the 16 numbers of a matrix";

/// A name that says that its column is of the other pose, in another unit, or another number of its pose.
fn contradiction<'a>(names: &[&'a String]) -> Option<&'a String> {
    let order = ["x", "y", "z", "x", "y", "z", "w"];
    let begins = |name: &str, words: &[&str]| words.iter().any(|word| name.starts_with(word));
    let is_wrong = |(k, name): &(usize, &&String)| {
        let (bare, lower) = (plain(name), name.to_lowercase());
        let of_other = match *k < names.len() / 2 {
            true => begins(&lower, &["cam", "target", "board"]),
            false => begins(&lower, &["base", "robot", "flange", "gripper", "tool"]),
        };
        let end = bare.chars().last().filter(|c| "xyzw".contains(*c));
        let is_other = names.len() == 14 && end.is_some_and(|c| !order[k % 7].ends_with(c));
        let in_other_unit =
            ["_mm", "_cm", "[mm]", "[cm]", "(mm)"].iter().any(|unit| lower.ends_with(unit));
        of_other || is_other || in_other_unit
    };
    names.iter().enumerate().find(is_wrong).map(|(_, name)| *name)
}

fn pose<A: handeye::Frame, B: handeye::Frame>(
    record: &Record,
    name: &str,
) -> Result<Pose<A, B>, Error> {
    let notation = if record.cells.len() == 7 { "quaternion-xyzw" } else { "matrix4x4" };
    let refuse = |what: String| {
        malformed(
            record.place.clone(),
            format!("{name}: {what}"),
            "correct the numbers, or leave the pair out",
        )
    };
    let notation = Notation::named(notation).map_err(refuse)?;
    let pose = notation.pose(&notation.numbers(record)?, notation.own_units()).map_err(refuse)?;
    match farthest(pose.translation.vector.as_slice()) {
        Some(far) => Err(refuse(too_far(far))),
        None => Ok(Pose::claim(pose)),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn read(name: &str, content: impl AsRef<[u8]>) -> Result<PosesFile, String> {
        let path =
            std::env::temp_dir().join(format!("handeye-pairs-{}-{name}", std::process::id()));
        fs::write(&path, content).unwrap();
        let found = read_pairs_table(&path, Setup::EyeInHand);
        fs::remove_file(&path).unwrap();
        found.map_err(|e| e.to_string().replace(&path.display().to_string(), name))
    }

    fn session(file: PosesFile) -> Session {
        match file.measured {
            MeasuredPoses::Pairs(session) => *session,
            MeasuredPoses::Streams(_) => panic!("pairs were read"),
        }
    }

    #[test]
    fn a_line_holds_two_poses_with_or_without_an_id() {
        let line = "0.1,0.2,0.3,0,0,0,1,0.4,0.5,0.6,0,0,1,0";
        let bare = session(read("bare.csv", format!("{line}\n{line}\n")).unwrap());
        assert_eq!(bare.observations.iter().map(|o| &o.capture).collect::<Vec<_>>(), ["1", "2"]);
        let counted = session(read("counted.csv", format!("7,{line}\n8,{line}\n")).unwrap());
        assert_eq!(counted.observations[1].capture, "8");
        let named = session(read("named.csv", format!("a,{line}\nb,{line}\n")).unwrap());
        assert_eq!(named.observations[1].capture, "b");
        let found = &named.observations[0];
        assert_eq!(found.base_from_flange.translation().as_slice(), [0.1, 0.2, 0.3]);
        let camera_from_target = &found.candidates[0].camera_from_target;
        assert_eq!(camera_from_target.translation().as_slice(), [0.4, 0.5, 0.6]);
        assert!((camera_from_target.iso().rotation.angle() - std::f64::consts::PI).abs() < 1e-12);
    }

    #[test]
    fn arrays_hold_matrices() {
        let matrix =
            |x: f64| [1.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        let both: Vec<f64> = [1.0, 2.0, 3.0, 4.0].into_iter().flat_map(matrix).collect();
        let found = session(read("both.npy", crate::npy::encode(&[2, 2, 4, 4], &both)).unwrap());
        let x = |k: usize| {
            let o = &found.observations[k];
            [o.base_from_flange.translation().x, o.candidates[0].camera_from_target.translation().x]
        };
        assert_eq!([x(0), x(1)], [[1.0, 2.0], [3.0, 4.0]]);
    }

    #[test]
    fn what_is_no_pair_is_refused_with_its_line() {
        let line = "0.1,0.2,0.3,0,0,0,1,0.4,0.5,0.6,0,0,1,0";
        let of = |content: String| read("bad.csv", content).unwrap_err();
        let short = of("1,2,3\n".into());
        assert!(short.starts_with("bad.csv:1: has 3 numbers, but a pair has 14 or 32"), "{short}");
        let twice = of(format!("a,{line}\na,{line}\n"));
        assert!(twice.starts_with("bad.csv:2: the id \"a\" is there twice"), "{twice}");
        let header = |names: &str| of(format!("{names}\n{line}\n"));
        let scalar_first = header("x,y,z,qw,qx,qy,qz,x,y,z,qx,qy,qz,qw");
        assert!(scalar_first.contains("the column \"qw\" is not what stands"), "{scalar_first}");
        let exchanged = header("cam_x,b,c,d,e,f,g,h,i,j,k,l,m,n");
        assert!(exchanged.contains("the column \"cam_x\" is not what"), "{exchanged}");
        let in_mm = header("x_mm,y_mm,z_mm,qx,qy,qz,qw,x_mm,y_mm,z_mm,qx,qy,qz,qw");
        assert!(in_mm.contains("the column \"x_mm\" is not what"), "{in_mm}");
        let none = of(format!("{line}\n{}\n", line.replace("0,0,0,1", "0,0,0,0")));
        assert!(none.starts_with("bad.csv:2: base_from_flange: "), "{none}");
    }
}
