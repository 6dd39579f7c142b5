//! A first manifest for a folder: what its files prove is filled in, the rest is asked.

use std::{
    fs,
    path::{Path, PathBuf},
};

use crate::{
    error::Error,
    files::{extension, natural},
};

/// Folders deeper than this are not looked into.
const DEEPEST: usize = 3;
/// Most files that are looked at.
const MOST_FILES: usize = 20_000;

const IMAGES: [&str; 6] = ["png", "jpg", "jpeg", "bmp", "tif", "tiff"];
const CLOUDS: [&str; 2] = ["ply", "pcd"];
const TABLES: [&str; 7] = ["csv", "txt", "json", "yaml", "yml", "npy", "npz"];

/// Files of one folder and one kind.
struct Group {
    pattern: String,
    count: usize,
}

/// The text of a manifest for a folder; lines with `QUESTION` wait for an answer.
///
/// # Errors
/// [`Error::Read`] if the folder cannot be listed.
pub fn handeye_init(folder: &Path) -> Result<String, Error> {
    let mut paths = Vec::new();
    list(folder, folder, 0, &mut paths)?;
    let is_camera = |p: &Path| camera_name(p);
    let (cameras, paths): (Vec<PathBuf>, Vec<PathBuf>) =
        paths.into_iter().partition(|p| is_camera(p));
    let parts = [
        "# What the files prove is filled in. Answer every QUESTION and remove its #.\n".into(),
        SETUP.into(),
        TARGET.into(),
        camera_section(&cameras),
        robot_section(&groups(&paths, &TABLES)),
        files_section("images", &groups(&paths, &IMAGES)),
        scans_section(&groups(&paths, &CLOUDS)),
    ];
    Ok(parts.into_iter().filter(|p: &String| !p.is_empty()).collect::<Vec<_>>().join("\n"))
}

const SETUP: &str = "\
# setup = \"eye-in-hand\"  # QUESTION: does the robot carry the camera (\"eye-in-hand\"), or the board (\"eye-to-hand\")?
";

const TARGET: &str = "\
[target]
# kind = \"checkerboard\"  # QUESTION: which board? checkerboard, charuco, tag or circle-grid
# columns = 11           # QUESTION: how many INNER corners along x?
# rows = 8               # QUESTION: and along y?
# square_mm = 30.0       # QUESTION: how long is the side of a square? Measure the print over many squares
";

fn list(folder: &Path, root: &Path, depth: usize, into: &mut Vec<PathBuf>) -> Result<(), Error> {
    let read = |source| Error::Read { path: folder.into(), source };
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).map_err(read)?.flatten().map(|e| e.path()).collect();
    entries.sort_by(|a, b| natural(&a.to_string_lossy(), &b.to_string_lossy()));
    for path in entries {
        if path.is_dir() && depth < DEEPEST {
            list(&path, root, depth + 1, into)?;
        } else if path.is_file() && into.len() < MOST_FILES {
            into.push(path.strip_prefix(root).unwrap_or(&path).to_path_buf());
        }
    }
    Ok(())
}

/// Calibration files give themselves away by their names.
fn camera_name(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let named = ["camera", "intrin", "camchain", "calib"].iter().any(|word| name.contains(word));
    named && ["yaml", "yml", "json", "xml", "npz"].contains(&extension(path).as_str())
}

/// Files of the given kinds, one pattern for each folder and kind; the largest first.
fn groups(paths: &[PathBuf], kinds: &[&str]) -> Vec<Group> {
    let mut groups: Vec<(PathBuf, String, Vec<&PathBuf>)> = Vec::new();
    for path in paths.iter().filter(|p| kinds.contains(&extension(p).as_str())) {
        let (folder, kind) =
            (path.parent().unwrap_or(Path::new("")).to_path_buf(), extension(path));
        match groups.iter_mut().find(|(f, k, _)| *f == folder && *k == kind) {
            Some((_, _, members)) => members.push(path),
            None => groups.push((folder, kind, vec![path])),
        }
    }
    let mut groups: Vec<Group> =
        groups.iter().map(|(folder, kind, members)| group(folder, kind, members)).collect();
    groups.sort_by_key(|g| std::cmp::Reverse(g.count));
    groups
}

fn group(folder: &Path, kind: &str, members: &[&PathBuf]) -> Group {
    let slashed = |p: &Path| p.to_string_lossy().replace('\\', "/");
    let pattern = match members {
        [only] => slashed(only),
        many => {
            let names: Vec<String> = many.iter().map(|p| crate::files::stem(p)).collect();
            slashed(&folder.join(format!("{}*.{kind}", common_start(&names))))
        }
    };
    Group { pattern, count: members.len() }
}

/// What all names begin with, without digits at its end.
fn common_start(names: &[String]) -> String {
    let first: Vec<char> = names[0].chars().collect();
    let same = |n: usize| names.iter().all(|name| name.chars().nth(n) == Some(first[n]));
    let length = (0..first.len()).take_while(|n| same(*n)).count();
    let start: String = first[..length].iter().collect();
    start.trim_end_matches(|c: char| c.is_ascii_digit()).to_string()
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.into()).to_string()
}

fn others(groups: &[Group]) -> String {
    groups
        .iter()
        .skip(1)
        .take(5)
        .map(|g| format!("# or {} ({} files)?\n", quoted(&g.pattern), g.count))
        .collect()
}

fn files_section(table: &str, groups: &[Group]) -> String {
    let Some(first) = groups.first() else { return String::new() };
    format!(
        "[{table}]\nfiles = {}  # {} files\n{}",
        quoted(&first.pattern),
        first.count,
        others(groups)
    )
}

fn scans_section(groups: &[Group]) -> String {
    if groups.is_empty() {
        return String::new();
    }
    let files = files_section("scans", groups);
    format!("{files}# length_unit = \"mm\"  # QUESTION: are the points in \"m\" or in \"mm\"?\n")
}

fn camera_section(cameras: &[PathBuf]) -> String {
    match cameras {
        [] => {
            "# [camera]  # no calibration file was found: the camera is calibrated from the views\n"
                .into()
        }
        [only] => format!("[camera]\nfile = {}\n", quoted(&only.to_string_lossy())),
        several => {
            let lines: String = several
                .iter()
                .map(|p| format!("# file = {}\n", quoted(&p.to_string_lossy())))
                .collect();
            format!("[camera]\n# QUESTION: which of these is the camera's calibration?\n{lines}")
        }
    }
}

fn robot_section(groups: &[Group]) -> String {
    let poses = match groups.first() {
        Some(first) => format!(
            "poses = {}  # {} files\n{}",
            quoted(&first.pattern),
            first.count,
            others(groups)
        ),
        None => "# poses = \"poses.csv\"  # QUESTION: where are the robot's poses?\n".into(),
    };
    format!(
        "[robot]\n{poses}\
         # notation = \"ur\"  # QUESTION: how are they written? ur, kuka, fanuc, abb, yaskawa, kawasaki, staubli,\n\
         #   doosan, denso, matrix4x4, quaternion-xyzw, quaternion-wxyz, rotation-vector, euler-zyx-intrinsic, joints ...\n\
         # length_unit = \"mm\"  # QUESTION: m or mm? (needed for notations of no maker)\n\
         # direction = \"base_from_flange\"  # QUESTION: do your robot poses take flange points into the base\n\
         #   (\"base_from_flange\": where the flange is, what controllers show), or the other way (\"flange_from_base\")?\n"
    )
}
