mod results;
mod sets;
mod trajectories;

use std::{env, fs};

use super::*;
use crate::Dataset;

/// A folder of its own for a test.
fn folder(name: &str) -> PathBuf {
    let folder = env::temp_dir().join(format!("handeye-import-{name}-{}", std::process::id()));
    fs::remove_dir_all(&folder).ok();
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn of(setup: Setup) -> Declared {
    Declared { setup: Some(setup), ..Declared::default() }
}

/// The manifest, written and opened.
fn opened(imported: &Imported) -> Dataset {
    let manifest = imported.folder.join(&imported.name);
    fs::write(&manifest, &imported.text).unwrap();
    Dataset::open(&manifest).unwrap_or_else(|e| panic!("{e}\n{}", imported.text))
}

fn easy_handeye(kind: &str) -> String {
    let pose = |x: f64| {
        format!(
            "{{translation: {{x: {x}, y: 0.2, z: 0.3}}, rotation: {{x: 0.0, y: 0.0, z: 0.6, w: 0.8}}}}"
        )
    };
    let sample = |k: i32| {
        let x = 0.1 * f64::from(k);
        format!("- robot: {}\n  tracking: {}\n", pose(x), pose(0.5))
    };
    let samples: String = (1..4).map(sample).collect();
    format!("parameters:\n  name: cell\n  calibration_type: {kind}\nsamples:\n{samples}")
}

#[test]
fn samples_of_easy_handeye_are_read_in_their_own_direction() {
    for (kind, setup) in [("eye_in_hand", Setup::EyeInHand), ("eye_on_base", Setup::EyeToHand)] {
        let folder = folder(kind);
        let file = folder.join("cell.samples.yaml");
        fs::write(&file, easy_handeye(kind)).unwrap();
        let set = opened(&import(&file, &Declared::default()).unwrap());
        assert_eq!((set.setup, set.captures.len()), (setup, 3));
        let first = set.captures[0].base_from_flange.iso();
        let reported = if setup == Setup::EyeInHand { *first } else { first.inverse() };
        let t = reported.translation.vector;
        assert!((t - nalgebra::Vector3::new(0.1, 0.2, 0.3)).norm() < 1e-12, "{kind}: {t}");
        let seen = set.captures[0].camera_from_target.unwrap();
        assert!((seen.translation().x - 0.5).abs() < 1e-12);
        fs::remove_dir_all(folder).ok();
    }
}

#[test]
fn a_setup_that_contradicts_the_samples_is_refused() {
    let folder = folder("contradiction");
    let file = folder.join("cell.yaml");
    fs::write(&file, easy_handeye("eye_in_hand")).unwrap();
    let error = import(&file, &of(Setup::EyeToHand)).unwrap_err().to_string();
    assert!(error.contains("says that it is eye-in-hand"), "{error}");
    fs::write(&file, easy_handeye("eye_on_nothing")).unwrap();
    let error = import(&file, &Declared::default()).unwrap_err().to_string();
    assert!(error.contains("calibration_type"), "{error}");
    fs::remove_dir_all(folder).ok();
}

#[test]
fn samples_without_parameters_need_a_setup_that_is_declared() {
    let folder = folder("bare-samples");
    let file = folder.join("cell.samples");
    let whole = easy_handeye("eye_on_base");
    fs::write(&file, &whole[whole.find("samples:").unwrap()..]).unwrap();
    let error = import(&file, &Declared::default()).unwrap_err().to_string();
    assert!(error.contains("--setup is missing; who carries the camera"), "{error}");
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let set = opened(&import(&file, &of(setup)).unwrap());
        let first = set.captures[0].base_from_flange.iso();
        let as_it_stands = if setup == Setup::EyeInHand { *first } else { first.inverse() };
        assert!((as_it_stands.translation.vector.x - 0.1).abs() < 1e-12);
    }
    fs::remove_dir_all(folder).ok();
}

#[test]
fn samples_of_moveit_calibration_ask_who_carries_the_camera() {
    let folder = folder("moveit");
    let matrix = "[1, 0, 0, 0.1, 0, 1, 0, 0.2, 0, 0, 1, 0.3, 0, 0, 0, 1]";
    let sample = format!("- effector_wrt_world: {matrix}\n  object_wrt_sensor: {matrix}\n");
    let rows = "[[1, 0, 0, 0.1], [0, 1, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1]]";
    let files = [
        ("samples.yaml", sample.repeat(3)),
        ("samples.json", format!("[[{rows}, {rows}], [{rows}, {rows}], [{rows}, {rows}]]")),
    ];
    for (name, text) in files {
        let file = folder.join(name);
        fs::write(&file, text).unwrap();
        let asked = import(&file, &Declared::default()).unwrap();
        assert!(asked.questions[0].contains("who carries the camera"), "{:?}", asked.questions);
        let answered = import(&file, &of(Setup::EyeToHand)).unwrap();
        assert!(answered.questions.is_empty());
        assert_eq!(opened(&answered).captures.len(), 3, "{name}");
    }
    fs::remove_dir_all(folder).ok();
}

fn robot_cal_tools(folder: &Path, names: [(&str, &str); 3]) {
    for sub in ["poses", "images"] {
        fs::create_dir_all(folder.join(sub)).unwrap();
    }
    let mut list = String::new();
    for (pose, image) in names {
        let text = "x: 0.1\ny: 0.2\nz: 0.3\nqx: 0.0\nqy: 0.0\nqz: 0.6\nqw: 0.8\n";
        fs::write(folder.join(pose), text).unwrap();
        fs::write(folder.join(image), "").unwrap();
        list += &format!("- pose: {pose}\n  image: {image}\n");
    }
    fs::write(folder.join("cal_data.yaml"), list).unwrap();
    let target = "target_finder:\n  type: rct_ros_tools::CharucoGridTargetFinderPlugin\n  rows: 7\n  cols: 5\n  \
                  chessboard_dim: 0.036195\n  aruco_marker_dim: 0.018256\n  dictionary: 10\n";
    fs::write(folder.join("target.yaml"), target).unwrap();
    fs::write(folder.join("pose_guesses.yaml"), "wrist_to_camera_guess:\n  x: 0.0\n").unwrap();
}

#[test]
fn robot_cal_tools_says_target_and_setup() {
    let folder = folder("rct");
    let pairs = ["0", "1", "2"].map(|k| (format!("poses/{k}.yaml"), format!("images/{k}.png")));
    robot_cal_tools(&folder, [0, 1, 2].map(|k| (pairs[k].0.as_str(), pairs[k].1.as_str())));
    let imported = import(&folder, &Declared::default()).unwrap();
    assert_eq!((imported.layout, imported.questions.len()), ("robot_cal_tools", 0));
    let set = opened(&imported);
    assert_eq!((set.setup, set.captures.len()), (Setup::EyeInHand, 3));
    assert!(imported.text.contains("DICT_6X6_250") && imported.text.contains("36.195"));
    assert!(imported.notes.is_empty());
    fs::write(folder.join("camera_intr.yaml"), "intrinsics:\n  fx: 500.0\n").unwrap();
    let imported = import(&folder, &Declared::default()).unwrap();
    assert!(imported.notes[0].contains("no distortion and are not taken"), "{:?}", imported.notes);
    // a sample that was deleted from the list, but not from the disk
    fs::copy(folder.join("poses/1.yaml"), folder.join("poses/7.yaml")).unwrap();
    fs::copy(folder.join("images/1.png"), folder.join("images/7.png")).unwrap();
    let set = opened(&import(&folder, &Declared::default()).unwrap());
    assert_eq!(set.captures.iter().map(|c| c.id.as_str()).collect::<Vec<_>>(), ["0", "1", "2"]);
    fs::remove_file(folder.join("images/1.png")).unwrap();
    let error = import(&folder, &Declared::default()).unwrap_err().to_string();
    assert!(error.contains("lists images/1.png, which is not there"), "{error}");
    let named = [
        ("poses/0.yaml", "images/0.png"),
        ("poses/1.yaml", "images/2.png"),
        ("poses/2.yaml", "images/1.png"),
    ];
    robot_cal_tools(&folder, named);
    let error = import(&folder, &Declared::default()).unwrap_err().to_string();
    assert!(error.contains("poses/1.yaml belongs to images/2.png"), "{error}");
    fs::remove_dir_all(folder).ok();
}

#[test]
fn what_is_not_known_is_told_what_is() {
    let folder = folder("unknown");
    fs::write(folder.join("notes.txt"), "nothing").unwrap();
    for source in [folder.clone(), folder.join("notes.txt")] {
        let error = import(&source, &Declared::default()).unwrap_err().to_string();
        assert!(error.contains("easy_handeye2") && error.contains("handeye init"), "{error}");
    }
    let error = import(&folder.join("gone"), &Declared::default()).unwrap_err();
    assert_eq!(error.code(), "cannot-read");
    fs::remove_dir_all(folder).ok();
}

#[test]
fn bags_have_a_command_of_their_own() {
    let folder = folder("bag");
    let bag = folder.join("session.mcap");
    fs::write(&bag, [0x89, b'M']).unwrap();
    for source in [&bag, &folder] {
        let error = import(source, &Declared::default()).unwrap_err().to_string();
        assert!(error.contains("`handeye bag`"), "{error}");
    }
    let error = crate::first_manifest(&folder, &crate::Known::default()).unwrap_err().to_string();
    assert!(error.contains("`handeye bag`"), "{error}");
}
