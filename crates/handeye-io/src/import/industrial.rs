//! robot_cal_tools and industrial_calibration: a list of `{pose, image}`, a target finder, guesses.
//!
//! Lengths are metres, poses `x y z qx qy qz qw`. A guess for `base_to_camera` says that the camera stands still, one
//! for `wrist_to_camera` that the robot carries it. Focal lengths without distortion are not taken: the views tell more.

use std::{collections::BTreeSet, path::Path};

use handeye::{Setup, TargetModel};

use super::{Declared, Described};
use crate::{
    Error, Place,
    dataset::{
        Draft,
        manifest::{ImagesSpec, RobotDirection, RobotSpec},
    },
    error::unusable,
    files,
    tree::Tree,
    units::LengthUnit,
};

/// OpenCV's dictionaries by their numbers.
const DICTIONARIES: [&str; 17] = [
    "DICT_4X4_50",
    "DICT_4X4_100",
    "DICT_4X4_250",
    "DICT_4X4_1000",
    "DICT_5X5_50",
    "DICT_5X5_100",
    "DICT_5X5_250",
    "DICT_5X5_1000",
    "DICT_6X6_50",
    "DICT_6X6_100",
    "DICT_6X6_250",
    "DICT_6X6_1000",
    "DICT_7X7_50",
    "DICT_7X7_100",
    "DICT_7X7_250",
    "DICT_7X7_1000",
    "DICT_ARUCO_ORIGINAL",
];

/// Of focal lengths.
const NOT_TAKEN: &str = "the intrinsics beside it have no distortion and are not taken: the camera is calibrated from \
                         the pictures. To have them all the same, add [camera] with width, height, fx, fy, cx and cy";

pub(super) fn describe(source: &Path, _: &Declared) -> Result<Option<Described>, Error> {
    let file = if source.is_dir() { source.join("cal_data.yaml") } else { source.to_path_buf() };
    if !file.is_file() || !["yaml", "yml"].contains(&files::extension(&file).as_str()) {
        return Ok(None);
    }
    let tree = Tree::read(&file)?;
    let list = tree.get("data").unwrap_or(&tree);
    let Some(pairs) = listed(list) else { return Ok(None) };
    let (folder, _) = super::split(&file);
    let poses = pattern(pairs.iter().map(|p| p.0.as_str()), &file)?;
    let images = pattern(pairs.iter().map(|p| p.1.as_str()), &file)?;
    check_names(&pairs, &file)?;
    let exclude = not_listed(&pairs, [&poses, &images], &file)?;
    let others = ["target.yaml", "pose_guesses.yaml"].map(|name| folder.join(name));
    let beside: Vec<Tree> =
        others.iter().filter(|f| f.is_file()).map(|f| Tree::read(f)).collect::<Result<_, _>>()?;
    let all = || std::iter::once(&tree).chain(&beside);
    let mut questions = vec![];
    let mut draft = Draft::new();
    match all().find_map(|t| t.get("target_finder")).and_then(target) {
        Some(model) => draft.set_target(model),
        None => {
            let what = "which target is in the images?";
            questions.push(what.into());
            draft.ask_target(what);
        }
    }
    draft.manifest.robot = Some(RobotSpec {
        poses,
        notation: Some("quaternion-xyzw".into()),
        length_unit: Some(LengthUnit::Metre),
        direction: Some(RobotDirection::BaseFromFlange),
        ..RobotSpec::default()
    });
    draft.manifest.images = Some(ImagesSpec::of(images));
    draft.note("captures.exclude", format!("not in {}", super::split(&file).1));
    draft.manifest.captures.exclude = exclude;
    let layout =
        if tree.get("data").is_some() { "industrial_calibration" } else { "robot_cal_tools" };
    let beside = files::expand(&folder, "camera_intr*.yaml", &Place::file(&file)).is_ok();
    let has_intrinsics = beside || all().any(|t| t.get("intrinsics").is_some());
    let notes = if has_intrinsics { vec![NOT_TAKEN.into()] } else { vec![] };
    Ok(Some(Described { layout, folder, setup: all().find_map(setup), draft, questions, notes }))
}

/// The files of each pose and its image; `None` of a list of something else.
fn listed(list: &Tree) -> Option<Vec<(String, String)>> {
    let Tree::List(entries) = list else { return None };
    let entry = |entry: &Tree| {
        let text = |key: &str| entry.get(key)?.text().map(String::from);
        Some((text("pose")?, text("image")?))
    };
    let pairs: Vec<_> = entries.iter().map(entry).collect::<Option<_>>()?;
    (!pairs.is_empty()).then_some(pairs)
}

/// Refuses pairs whose files are not called alike.
fn check_names(pairs: &[(String, String)], file: &Path) -> Result<(), Error> {
    let unlike = pairs
        .iter()
        .find(|(pose, image)| files::stem(Path::new(pose)) != files::stem(Path::new(image)));
    if let Some((pose, image)) = unlike {
        let what = format!(
            "{pose} belongs to {image}: give both the same name, since files are paired by their names"
        );
        return Err(unusable(file, what));
    }
    Ok(())
}

/// The names of what lies in the folders, but is not in the list: samples that were deleted.
fn not_listed(
    pairs: &[(String, String)],
    patterns: [&str; 2],
    list: &Path,
) -> Result<Vec<String>, Error> {
    let (folder, _) = super::split(list);
    let listed = |which: fn(&(String, String)) -> &String| pairs.iter().map(which);
    let gone = listed(|p| &p.0).chain(listed(|p| &p.1)).find(|name| !folder.join(name).is_file());
    if let Some(name) = gone {
        return Err(unusable(list, format!("lists {name}, which is not there")));
    }
    let place = Place::file(list);
    let stems = |pattern: &str| -> Result<Vec<String>, Error> {
        let found = files::expand(&folder, pattern, &place)?;
        Ok(found.iter().map(|path| files::stem(path)).collect())
    };
    let pictures = stems(patterns[1])?;
    let names: BTreeSet<String> = pairs.iter().map(|p| files::stem(Path::new(&p.1))).collect();
    let others = stems(patterns[0])?.into_iter();
    Ok(others.filter(|name| pictures.contains(name) && !names.contains(name)).collect())
}

/// `poses/*.yaml` of `poses/0.yaml`, `poses/1.yaml` ...
pub(super) fn pattern<'a>(
    mut names: impl Iterator<Item = &'a str>,
    list: &Path,
) -> Result<String, Error> {
    let pattern = |name: &str| {
        let path = Path::new(name);
        let file = format!("*.{}", path.extension().unwrap_or_default().to_string_lossy());
        path.with_file_name(file).to_string_lossy().replace('\\', "/")
    };
    let first = names.next().map(pattern).unwrap_or_default();
    match names.find(|name| pattern(name) != first) {
        Some(other) => {
            let what = format!(
                "{other} does not lie where the others do ({first}): put them into one folder"
            );
            Err(unusable(list, what))
        }
        None => Ok(first),
    }
}

fn setup(tree: &Tree) -> Option<Setup> {
    let has = |keys: &[&str]| tree.any(keys).is_some();
    match tree.get("static_camera") {
        Some(Tree::Bool(true)) => return Some(Setup::EyeToHand),
        Some(Tree::Bool(false)) => return Some(Setup::EyeInHand),
        _ => {}
    }
    if has(&["base_to_camera_guess", "wrist_to_target_guess"]) {
        return Some(Setup::EyeToHand);
    }
    has(&["wrist_to_camera_guess", "base_to_target_guess"]).then_some(Setup::EyeInHand)
}

fn target(finder: &Tree) -> Option<TargetModel> {
    let number = |key: &str| finder.get(key)?.number();
    let count = |key: &str| number(key).filter(|n| (1.0..1e3).contains(n)).map(|n| n as u32);
    let mm = |key: &str| number(key).map(|m| (m * 1e9).round() * 1e-6);
    let kind = finder.get("type")?.text()?;
    let (columns, rows) = (count("cols")?, count("rows")?);
    let model = if kind.contains("Charuco") {
        TargetModel::Charuco {
            squares_x: columns,
            squares_y: rows,
            square_mm: mm("chessboard_dim")?,
            marker_mm: mm("aruco_marker_dim")?,
            dictionary: DICTIONARIES.get(number("dictionary")? as usize)?.to_string(),
            legacy: false,
            first_id: 0,
        }
    } else if kind.contains("ModifiedCircleGrid") {
        TargetModel::ModifiedCircleGrid { columns, rows, pitch_mm: mm("spacing")? }
    } else {
        return None;
    };
    model.check().ok().map(|()| model)
}
