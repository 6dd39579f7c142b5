//! Datasets made wrong on purpose, and what `check` and `calibrate` say of them; beside each a right one, of which they
//! say nothing.

use std::fs;

use handeye::{Intrinsics, Setup, TargetModel, model::target::AprilTagFamily, simulate::Cell};
use handeye_io::simulated::{self, ScanFormat, Writing};
use serde_json::Value;

use crate::folder::{self, Folder, Run, handeye};

const SETUPS: [&str; 2] = ["eye-in-hand", "eye-to-hand"];
/// Small images are enough where they are not measured.
const SMALL: [&str; 6] = ["--captures", "8", "--width", "800", "--height", "500"];

/// A simulated cell in the folder `cell`.
fn simulated_cell(options: &[&str]) -> Folder {
    let folder = Folder::new();
    let made = handeye(&folder, &[&["simulate", "cell", "--quiet"], options].concat());
    assert_eq!(made.code, 0, "{}", made.stderr);
    folder
}

fn check(folder: &Folder, more: &[&str]) -> Run {
    handeye(folder, &[&["check", "cell", "--json", "--quiet"], more].concat())
}

fn calibrate(folder: &Folder) -> Run {
    handeye(folder, &["calibrate", "cell", "--json", "--quiet"])
}

/// Replaces the last place of a text in the manifest.
fn declare(folder: &Folder, right: &str, wrong: &str) {
    let manifest = folder.read("cell/handeye.toml");
    let at = manifest.rfind(right).unwrap_or_else(|| panic!("{right}: {manifest}"));
    let text = [&manifest[..at], wrong, &manifest[at + right.len()..]].concat();
    folder.put("cell/handeye.toml", &text);
}

/// Rewrites the lines of a table behind its header.
fn rewrite(folder: &Folder, file: &str, change: impl Fn(Vec<String>) -> Option<Vec<String>>) {
    let text = folder.read(file);
    let (header, rest) = text.split_once('\n').unwrap();
    let lines = rest.lines().map(|l| l.split(',').map(String::from).collect());
    let changed: Vec<String> = lines.filter_map(&change).map(|l| l.join(",")).collect();
    folder.put(file, &format!("{header}\n{}\n", changed.join("\n")));
}

/// Rewrites the corner ids of the touches; those without a new id are left out.
fn rename_touches(folder: &Folder, new: impl Fn(u32) -> Option<u32>) {
    rewrite(folder, "cell/touches.csv", |mut line| {
        line[1] = new(line[1].parse().unwrap())?.to_string();
        Some(line)
    });
}

/// A dataset in which nothing is wrong raises no alarm, by either command.
fn is_in_order(folder: &Folder) {
    let found = check(folder, &[]);
    assert_eq!(found.code, 0, "{}", found.stdout);
    let answer = calibrate(folder).json();
    assert_eq!(answer["verdict"], "accepted", "{}", answer["reasons"]);
}

/// `check` names the mistake first, and `calibrate` rejects the data with the same words.
fn is_named(folder: &Folder, code: &str, words: &str) -> Value {
    let run = check(folder, &[]);
    let found = run.json();
    let first = &found["explanations"][0];
    assert_eq!((run.code, first["code"].as_str()), (3, Some(code)), "{found}");
    assert!(first["message"].to_string().contains(words), "{found}");
    let run = calibrate(folder);
    let answer = run.json();
    assert_eq!(run.code, 3, "{answer}");
    assert!(answer["reasons"][0].to_string().contains(words), "{}", answer["reasons"]);
    found
}

/// Corrects the manifest as `check` proposes; then nothing is wrong any more.
fn is_corrected(folder: &Folder) {
    let run = check(folder, &["--apply"]);
    assert_eq!(run.json()["applied"]["explanation"], 1, "{}", run.stdout);
    assert_eq!(check(folder, &[]).code, 0);
}

#[test]
fn touches_under_other_ids_are_named_with_the_way_of_counting() {
    for setup in SETUPS {
        let clean = || {
            let folder = simulated_cell(&["--setup", setup, "--no-images", "--touches", "12"]);
            rename_touches(&folder, |id| Some(id).filter(|id| *id < 53));
            folder
        };
        is_in_order(&clean());
        let folder = clean();
        rename_touches(&folder, |id| Some(id + 1));
        is_named(&folder, "touches-misread", "counted from 1");
        let folder = clean();
        rename_touches(&folder, |id| Some(id % 9 * 6 + id / 9));
        is_named(&folder, "touches-misread", "counted column by column");
        let folder = clean();
        declare(&folder, "length_unit = \"m\"", "length_unit = \"mm\"");
        is_named(&folder, "touches-misread", "the touches agree if their unit is m, not mm");
    }
}

#[test]
fn a_touch_beyond_the_board_is_refused_with_the_way_of_counting() {
    let folder = simulated_cell(&["--no-images", "--touches", "4"]);
    rename_touches(&folder, |id| Some(id + 1));
    for command in ["check", "calibrate"] {
        let run = handeye(&folder, &[command, "cell", "--quiet"]);
        assert_eq!(run.code, 1);
        assert!(
            run.error().contains("touches.csv:3: the target has no corner 54"),
            "{}",
            run.error()
        );
        assert!(run.error().contains("counted from 1"), "{}", run.error());
    }
}

#[test]
fn a_tip_that_is_off_by_one_square_is_said_to_be() {
    for setup in SETUPS {
        let folder = simulated_cell(&["--setup", setup, "--no-images", "--touches", "12"]);
        is_in_order(&folder);
        declare(&folder, "in_flange_mm = [4.0", "in_flange_mm = [34.0");
        let found = check(&folder, &[]).json();
        let first = &found["explanations"][0];
        assert_eq!(first["code"], "tip-off", "{found}");
        assert!(first["message"].to_string().contains("is one square of the board"), "{found}");
        let run = handeye(&folder, &["calibrate", "cell"]);
        assert_eq!(run.code, 0, "{}", run.stdout);
        assert!(
            run.stdout.contains("Accepted, but: the answer corrects the tool's tip"),
            "{}",
            run.stdout
        );
        let answer = calibrate(&folder).json();
        assert_eq!(answer["findings"][0]["code"], "tip-off", "{}", answer["findings"]);
        assert_eq!(answer["findings"][0]["severity"], "changes-answer");
        assert_eq!(answer["findings"][0]["message"], answer["warnings"][0]["message"]);
    }
}

#[test]
fn scans_in_another_unit_are_no_worn_scanner() {
    for (setup, read, meant) in
        [("eye-in-hand", "mm", "m"), ("eye-to-hand", "mm", "m"), ("eye-in-hand", "cm", "m")]
    {
        let scans = ["--setup", setup, "--touches", "0", "--scans", "--scan-format", "ply"];
        let folder = simulated_cell(&[&SMALL[..], &scans].concat());
        is_in_order(&folder);
        declare(&folder, "length_unit = \"m\"", &format!("length_unit = \"{read}\""));
        let words = format!("their points are in {meant}, not {read}");
        is_named(&folder, "scan-unit", &words);
        is_corrected(&folder);
    }
}

#[test]
fn a_depth_image_of_another_scale_is_a_unit_too() {
    let folder = simulated_cell(&[&SMALL[..], &["--touches", "0", "--scans"]].concat());
    is_in_order(&folder);
    declare(&folder, "depth_scale = 0.0001", "depth_scale = 0.1");
    is_named(&folder, "scan-unit", "depth_scale is wrong by a factor of 1000");
    is_corrected(&folder);
}

#[test]
fn squares_are_no_inner_corners() {
    let folder = simulated_cell(&[&SMALL[..], &["--touches", "0"]].concat());
    is_in_order(&folder);
    declare(&folder, "columns = 9", "columns = 10");
    declare(&folder, "rows = 6", "rows = 7");
    let words = "the images show 9 x 6 inner corners, not 10 x 7 as declared: count inner corners, not squares";
    is_named(&folder, "target-layout", words);
    is_corrected(&folder);
}

#[test]
fn lists_of_corners_tell_the_layout_as_images_do() {
    // columns and rows as declared, of a board of 9 x 6
    for (columns, rows, advice) in [(10, 7, ": count inner corners, not squares"), (6, 9, "")] {
        let folder = simulated_cell(&["--captures", "8", "--no-images", "--touches", "0"]);
        is_in_order(&folder);
        declare(&folder, "columns = 9", &format!("columns = {columns}"));
        declare(&folder, "rows = 6", &format!("rows = {rows}"));
        let words =
            format!("show 9 x 6 inner corners, not {columns} x {rows} as declared{advice} (");
        is_named(&folder, "target-layout", &words);
        is_corrected(&folder);
    }
}

#[test]
fn a_charuco_board_whose_sides_are_exchanged_is_named() {
    for (setup, x, y) in SETUPS.iter().flat_map(|s| [(s, 9, 6), (s, 12, 9)]) {
        let size = format!("{x}x{y}");
        let board = ["--setup", setup, "--touches", "0", "--charuco", &size];
        let folder = simulated_cell(&[&SMALL[..], &board].concat());
        is_in_order(&folder);
        declare(&folder, &format!("squares_x = {x}"), &format!("squares_x = {y}"));
        declare(&folder, &format!("squares_y = {y}"), &format!("squares_y = {x}"));
        is_named(&folder, "target-layout", "squares_x and squares_y are exchanged");
        is_corrected(&folder);
    }
}

#[test]
fn an_aprilgrid_whose_ids_contradict_its_layout_is_named() {
    let folder = Folder::new();
    let grid = TargetModel::Aprilgrid {
        tags_x: 6,
        tags_y: 4,
        tag_mm: 30.0,
        spacing: 0.3,
        family: AprilTagFamily::Tag36h11,
        first_id: 0,
        corner_squares: true,
        border_bits: 1,
    };
    let cell = Cell {
        target: grid,
        intrinsics: Intrinsics::pinhole(960, 600, 900.0, 900.0, 479.5, 299.5),
        captures: 6,
        touches: 0,
        ..Cell::new(Setup::EyeInHand, 3)
    };
    let recording = cell.record(3).unwrap();
    let writing = Writing { images: true, scans: ScanFormat::DepthPng };
    simulated::write(&recording, &folder.0.join("cell"), writing).unwrap();
    is_in_order(&folder);
    declare(&folder, "tags_x = 6", "tags_x = 4");
    declare(&folder, "tags_y = 4", "tags_y = 6");
    let words =
        "the images show 6 x 4 tags, not 4 x 6 as declared: tags_x and tags_y are exchanged";
    is_named(&folder, "target-layout", words);
    is_corrected(&folder);
}

#[test]
fn after_a_bump_the_captures_before_it_are_left_out_by_check_and_calibrate_alike() {
    let folder = simulated_cell(&["--captures", "16", "--no-images", "--touches", "0"]);
    is_in_order(&folder);
    // a camera that moves on its flange is the same as a flange that moves the other way
    rewrite(&folder, "cell/robot.csv", |mut line| {
        if line[0].parse::<u32>().unwrap() >= 10 {
            let numbers: Vec<f64> = line[1..].iter().map(|n| n.parse().unwrap()).collect();
            let moved = rotation(&numbers) * nalgebra::Vector3::x() * 0.008;
            (0..3).for_each(|k| line[1 + k] = (numbers[k] - moved[k]).to_string());
        }
        Some(line)
    });
    let run = check(&folder, &[]);
    let found: Value = serde_json::from_str(&run.stdout).unwrap();
    let first = &found["explanations"][0];
    let message = first["message"].as_str().unwrap();
    assert_eq!((run.code, first["code"].as_str()), (3, Some("camera-moved")), "{message}");
    assert!(message.contains("was moved on the flange before capture 010"), "{message}");
    let earlier: Vec<String> = (1..=9).map(|k| format!("\"{k:03}\"")).collect();
    assert_eq!(first["changes"][0]["value"], format!("[{}]", earlier.join(", ")));
    let found: Value = serde_json::from_str(&calibrate(&folder).stdout).unwrap();
    let moved = found["warnings"].to_string();
    assert!(moved.contains("the camera's pose from capture 010 on"), "{moved}");
    is_corrected(&folder);
}

/// Robot poses written in another way: 12 or 16 numbers of a matrix, or six with angles.
fn write_poses(folder: &Folder, keys: &str, write: impl Fn(&[f64]) -> Vec<f64>) {
    let text = folder.read("cell/robot.csv");
    let line = |line: &str| {
        let (_, numbers) = line.split_once(',').unwrap();
        let numbers: Vec<f64> = numbers.split(',').map(|n| n.parse().unwrap()).collect();
        let written: Vec<String> = write(&numbers).iter().map(f64::to_string).collect();
        format!("{}\n", written.join(","))
    };
    let lines: String = text.lines().skip(1).map(line).collect();
    folder.put("cell/robot.csv", &lines);
    declare(folder, "notation = \"quaternion-xyzw\"\nlength_unit = \"m\"", keys);
}

fn rotation(numbers: &[f64]) -> nalgebra::Matrix3<f64> {
    let q = nalgebra::Quaternion::new(numbers[6], numbers[3], numbers[4], numbers[5]);
    nalgebra::UnitQuaternion::from_quaternion(q).to_rotation_matrix().into_inner()
}

/// The 4 x 4 matrix of a pose, row by row.
fn matrix(numbers: &[f64], r: &nalgebra::Matrix3<f64>) -> Vec<f64> {
    let row = |i: usize| [r[(i, 0)], r[(i, 1)], r[(i, 2)], numbers[i]];
    [&row(0)[..], &row(1), &row(2), &[0.0, 0.0, 0.0, 1.0]].concat()
}

const MATRICES: &str = "notation = \"matrix4x4\"\nlength_unit = \"m\"";

#[test]
fn transposed_matrices_are_named() {
    for setup in SETUPS {
        let cell = || simulated_cell(&["--setup", setup, "--no-images", "--touches", "0"]);
        let folder = cell();
        write_poses(&folder, MATRICES, |n| matrix(n, &rotation(n)));
        is_in_order(&folder);
        let folder = cell();
        write_poses(&folder, MATRICES, |n| matrix(n, &rotation(n).transpose()));
        is_named(&folder, "reading", "they are transposed");
        // the whole matrix, column by column
        let folder = cell();
        write_poses(&folder, MATRICES, |n| {
            let m = matrix(n, &rotation(n));
            (0..16).map(|k| m[k % 4 * 4 + k / 4]).collect()
        });
        for command in ["check", "calibrate"] {
            let run = handeye(&folder, &[command, "cell", "--quiet"]);
            assert_eq!(run.code, 1);
            assert!(run.error().contains("the matrix is transposed"), "{}", run.error());
        }
    }
}

const ANGLES: &str = "notation = \"rotation-vector\"\nlength_unit = \"m\"\nangle_unit = \"rad\"";

#[test]
fn angles_before_positions_are_named() {
    for setup in SETUPS {
        let cell = || simulated_cell(&["--setup", setup, "--no-images", "--touches", "0"]);
        let vector = |n: &[f64]| {
            let r = nalgebra::Rotation3::from_matrix_unchecked(rotation(n)).scaled_axis();
            (n[..3].to_vec(), vec![r.x, r.y, r.z])
        };
        let folder = cell();
        write_poses(&folder, ANGLES, |n| [vector(n).0, vector(n).1].concat());
        is_in_order(&folder);
        let folder = cell();
        write_poses(&folder, ANGLES, |n| [vector(n).1, vector(n).0].concat());
        let words = "the angles stand before the positions in the robot poses";
        is_named(&folder, "reading", words);
        is_corrected(&folder);
        assert!(folder.read("cell/handeye.toml").contains("columns = [4, 5, 6, 1, 2, 3]"));
        // a quaternion before the position is no pose at all
        let folder = cell();
        let keys = "notation = \"quaternion-xyzw\"\nlength_unit = \"m\"";
        write_poses(&folder, keys, |n| [&n[3..], &n[..3]].concat());
        let error = handeye(&folder, &["calibrate", "cell", "--quiet"]).error();
        assert!(error.contains("the rotation stands before the position"), "{error}");
    }
}

#[test]
fn what_is_rejected_ends_with_the_next_command() {
    let folder = simulated_cell(&["--no-images", "--touches", "0"]);
    let accepted = handeye(&folder, &["calibrate", "cell", "--quiet"]);
    assert!(!accepted.stdout.contains("next:"), "{}", accepted.stdout);
    declare(&folder, "length_unit = \"m\"", "length_unit = \"cm\"");
    let run = handeye(&folder, &["calibrate", "cell", "--quiet", "--out", "result"]);
    assert_eq!(run.code, 3, "{}", run.stdout);
    let text = run.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("REJECTED the robot poses are in m, not cm"), "{text}");
    assert!(text.contains("[robot] length_unit = \"m\""), "{text}");
    assert!(text.ends_with("next: handeye check cell"), "{text}");
    // the page shows its numbers below the reasons, crossed out
    let page = folder.read("result/report.html");
    let at = |what: &str| page.find(what).unwrap_or_else(|| panic!("{what}"));
    assert!(at("he robot poses are in m") < at("class=\"refused\""));
    assert!(!page.contains("predicted error, 95 %"));
}

/// Runs at the same time into one folder: result and page are of one run.
#[test]
fn two_runs_into_one_folder_leave_one_result_with_its_page() {
    let folder = simulated_cell(&["--no-images", "--touches", "0"]);
    let other = ["simulate", "other", "--seed", "2", "--no-images", "--touches", "0", "--quiet"];
    assert_eq!(handeye(&folder, &other).code, 0);
    for _ in 0..3 {
        let start = |cell: &str| {
            let args = ["calibrate", cell, "--out", "result", "--quiet", "--format", "urdf"];
            folder::command(&folder, &args).stdout(std::process::Stdio::null()).spawn().unwrap()
        };
        let mut runs = [start("cell"), start("other"), start("cell"), start("other")];
        assert!(runs.iter_mut().all(|run| run.wait().unwrap().success()));
        let answer: Value = serde_json::from_str(&folder.read("result/calibration.json")).unwrap();
        let id = answer["run_id"].as_str().unwrap();
        assert!(folder.read("result/report.html").contains(&format!("Run {id}.")));
        let names = folder.list("result");
        assert_eq!(names.len(), 3, "{names:?}");
    }
    let again = |out: &str| {
        let run = handeye(&folder, &["calibrate", "cell", "--out", out, "--quiet"]);
        assert_eq!(run.code, 0);
        folder.read(&format!("{out}/calibration.json"))
    };
    assert_eq!(again("one"), again("two"), "the same input gives the same bytes and name");
}

#[test]
fn captures_without_the_target_and_rejected_ones_are_named() {
    let folder = simulated_cell(&[&SMALL[..], &["--touches", "0"]].concat());
    fs::remove_file(folder.0.join("cell/images/004.png")).unwrap();
    folder.put("cell/images/004.png", "@png 800x500");
    rewrite(&folder, "cell/robot.csv", |mut line| {
        if line[0] == "006" {
            line[1] = (line[1].parse::<f64>().unwrap() + 0.02).to_string();
        }
        Some(line)
    });
    let run = handeye(&folder, &["calibrate", "cell", "--quiet", "--out", "result"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    assert!(run.stdout.contains("6 of 8 captures used"), "{}", run.stdout);
    assert!(run.stdout.contains("rejected: 006"), "{}", run.stdout);
    assert!(run.stdout.contains("without target: 004"), "{}", run.stdout);
    let page = folder.read("result/report.html");
    assert!(page.contains("captures rejected") && page.contains("captures without target"));
}
