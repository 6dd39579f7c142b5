//! Datasets with everything a manifest can say.

use std::{fs, path::PathBuf};

use handeye::{Setup, Warning};
use handeye_io::{Dataset, FIXED_BOARD};
use nalgebra::Vector3;

/// A folder with a manifest and some files.
fn folder(name: &str, manifest: &str, files: &[(&str, &str)]) -> PathBuf {
    let path = std::env::temp_dir().join(format!("handeye-dataset-{}-{name}", std::process::id()));
    fs::create_dir_all(&path).unwrap();
    fs::write(path.join("handeye.toml"), manifest).unwrap();
    for (file, content) in files {
        fs::write(path.join(file), content).unwrap();
    }
    path
}

fn open(name: &str, manifest: &str, files: &[(&str, &str)]) -> Dataset {
    let path = folder(name, manifest, files);
    let dataset = Dataset::open(&path).unwrap_or_else(|e| panic!("{e}"));
    fs::remove_dir_all(path).unwrap();
    dataset
}

const TARGET: &str = "[target]\nkind = \"checkerboard\"\ncolumns = 3\nrows = 2\nsquare_mm = 20.0\n";
const CORNERS: &str = "capture,id,x,y\na,0,10.5,20.5\na,1,30,40\nb,5,1,2\n";

#[test]
fn corners_of_another_program_are_moved_to_our_pixel_origin() {
    let manifest = format!(
        "setup = \"eye-to-hand\"\n{TARGET}[robot]\nposes = \"poses.csv\"\nnotation = \"kuka\"\ndirection = \"base_from_flange\"\n\
         [corners]\nfiles = \"corners.csv\"\npixel_origin = \"corner\"\n[noise]\nimage_px = 0.3\nrobot_rotation_deg = 180.0\n"
    );
    let poses = "id;X;Y;Z;A;B;C\none;100;0;0;90;0;0\ntwo;0;100;0;0;0;0\n";
    let dataset = open("corners", &manifest, &[("poses.csv", poses), ("corners.csv", CORNERS)]);
    assert_eq!(dataset.captures.iter().map(|c| c.id.as_str()).collect::<Vec<_>>(), ["a", "b"]);
    let corners = dataset.captures[0].corners.as_ref().unwrap();
    assert_eq!((corners[0].pixel.x, corners[0].pixel.y, corners.len()), (10.0, 20.0, 2));
    assert!((corners[0].covariance[(0, 0)] - 0.09).abs() < 1e-15);
    assert_eq!(dataset.noise.robot_rotation, Some(std::f64::consts::PI));
    let turned = dataset.captures[0].base_from_flange.rotation() * Vector3::x();
    assert!((turned - Vector3::y()).norm() < 1e-15);
}

#[test]
fn a_tool_is_taken_off_the_recorded_poses() {
    let manifest = "setup = \"eye-in-hand\"\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\nframe = \"tool\"\n\
         tool = { translation_mm = [0.0, 0.0, 100.0], rotation_xyzw = [0.0, 0.0, 0.0, 1.0] }\n\
         [board_poses]\nposes = \"board.csv\"\nnotation = \"ur\"\ndirection = \"target_from_camera\"\n";
    let line = "0.5,0,0.5,0,3.141592653589793,0\n";
    let dataset = open("tool", manifest, &[("poses.csv", line), ("board.csv", "0,0,1,0,0,0\n")]);
    let capture = &dataset.captures[0];
    assert_eq!(capture.id, "01");
    let at = capture.base_from_flange.translation();
    assert!((at - Vector3::new(0.5, 0.0, 0.6)).norm() < 1e-12, "{at}");
    assert_eq!(capture.camera_from_target.unwrap().translation().z, -1.0);
}

#[test]
fn touches_of_all_kinds_give_the_same_point() {
    let base = format!(
        "setup = \"eye-to-hand\"\n{TARGET}[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n\
         [[placements]]\nid = \"A\"\ncorners = \"a.csv\"\n[[placements]]\nid = \"B\"\nboard_pose = [0, 0, 1, 0, 0, 0]\n\
         [corners]\nfiles = \"corners.csv\"\npixel_origin = \"centre\"\n\
         [workspace]\nframe = \"base\"\nminimum_mm = [0, 0, 0]\nmaximum_mm = [100, 200, 300]\n[limits]\nmax_error_mm = 0.5\n"
    );
    let base = base.replace("[0, 0, 1, 0, 0, 0]", "[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]");
    let base = base
        .replace("[0, 0, 0]", "[0.0, 0.0, 0.0]")
        .replace("[100, 200, 300]", "[100.0, 200.0, 300.0]");
    let files = [
        ("poses.csv", "0.1,0,0,0,0,0\n0.2,0,0,0,0,0\n"),
        ("corners.csv", CORNERS),
        ("a.csv", "id x y\n0 1 2\n3 5 6\n"),
        ("board.csv", "0,0,1,0,0,0\n0,0,1,0,0,0\n"),
        ("tips.csv", "placement,row,column,x_mm,y_mm,z_mm\nA,1,2,10,20,30\nB,0,1,1,2,3\n"),
        (
            "contact.csv",
            "placement,corner,x,y,z,rx,ry,rz\nA,5,0.01,0.02,0.13,3.141592653589793,0,0\n",
        ),
    ];
    let board = "[board_poses]\nposes = \"board.csv\"\nnotation = \"ur\"\ndirection = \"camera_from_target\"\n";
    let tip = "[touches]\nfile = \"tips.csv\"\nkind = \"tip\"\nlength_unit = \"mm\"\n";
    let contact = "[touches]\nfile = \"contact.csv\"\nkind = \"flange-pose\"\ntip = { in_flange_mm = [0.0, 0.0, 100.0] }\n";
    let by_tip = open("tip", &format!("{base}{board}{tip}"), &files);
    let by_contact = open("contact", &format!("{base}{board}{contact}"), &files);
    assert_eq!(
        (by_tip.setup, by_tip.touches.len(), by_tip.placements.len()),
        (Setup::EyeToHand, 2, 2)
    );
    let (a, b) = (&by_tip.touches[0], &by_contact.touches[0]);
    assert_eq!((a.placement.as_str(), a.corner, b.corner), ("A", 5, 5));
    assert!((a.in_base.vector() - b.in_base.vector()).norm() < 1e-12);
    assert!(a.base_from_flange.is_none() && b.base_from_flange.is_some());
    assert_eq!(by_tip.placements[0].corners.as_ref().map(Vec::len), Some(2));
    assert_eq!(by_tip.placements[1].camera_from_target.unwrap().translation().z, 1.0);
    assert_eq!(by_tip.workspace.unwrap().corners.maximum, Vector3::new(0.1, 0.2, 0.3));
    assert_eq!(by_tip.limits.max_error, Some(0.0005));
}

/// A touch of a robot whose poses are inverted and those of its tool, as `[robot]` says.
#[test]
fn touches_are_read_as_the_robots_poses_are() {
    let of = |name: &str, direction: &str, robot: &str, pose: &str| {
        let manifest = format!(
            "setup = \"eye-in-hand\"\n{TARGET}[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\n\
             direction = \"{direction}\"\n{robot}[corners]\nfiles = \"corners.csv\"\npixel_origin = \"centre\"\n\
             [touches]\nkind = \"flange-pose\"\ntip = {{ in_flange_mm = [0.0, 0.0, 100.0] }}\n\
             points = [{{ corner = 2, values = [{pose}] }}]\n"
        );
        let poses = "0.1,0,0,0,0,0\n0.2,0,0,0,0,0\n";
        let dataset = open(name, &manifest, &[("poses.csv", poses), ("corners.csv", CORNERS)]);
        dataset.touches[0].in_base.vector()
    };
    let turned = "0.0, 0.0, 1.5707963267948966";
    let flange = of("plain", "base_from_flange", "", &format!("0.1, 0.0, 0.5, {turned}"));
    assert!((flange - Vector3::new(0.1, 0.0, 0.6)).norm() < 1e-12);
    let back = "0.0, 0.0, -1.5707963267948966";
    let inverted = of("inverted", "flange_from_base", "", &format!("0.0, 0.1, -0.5, {back}"));
    assert!((inverted - flange).norm() < 1e-12, "{inverted}");
    let tool = "frame = \"tool\"\ntool = { translation_mm = [0.0, 0.0, 50.0], \
                rotation_xyzw = [0.0, 0.0, 0.0, 1.0] }\n";
    let of_tool = of("of-tool", "base_from_flange", tool, &format!("0.1, 0.0, 0.55, {turned}"));
    assert!((of_tool - flange).norm() < 1e-12, "{of_tool}");
}

#[test]
fn names_of_placements_keep_their_zeros() {
    let manifest = format!(
        "setup = \"eye-to-hand\"\n{TARGET}[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n\
         [[placements]]\nid = \"01\"\ncorners = \"a.csv\"\n[[placements]]\nid = \"1\"\ncorners = \"a.csv\"\n\
         [corners]\nfiles = \"corners.csv\"\npixel_origin = \"centre\"\n\
         [touches]\nfile = \"tips.csv\"\nkind = \"tip\"\nlength_unit = \"mm\"\n"
    );
    let files = [
        ("poses.csv", "0.1,0,0,0,0,0\n0.2,0,0,0,0,0\n"),
        ("corners.csv", CORNERS),
        ("a.csv", "id x y\n0 1 2\n3 5 6\n"),
        ("tips.csv", "placement,corner,x_mm,y_mm,z_mm\n01,05,10,20,30\n1,1,1,2,3\n"),
    ];
    let dataset = open("padded", &manifest, &files);
    let named = dataset.touches.iter().map(|t| (t.placement.as_str(), t.corner));
    assert_eq!(named.collect::<Vec<_>>(), [("01", 5), ("1", 1)]);
}

#[test]
fn point_pairs_of_eye_in_hand_are_moved_to_the_flange() {
    let manifest = "setup = \"eye-in-hand\"\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n\
         [point_pairs]\ncamera = { file = \"camera.csv\", length_unit = \"mm\" }\nrobot = { file = \"robot.csv\", length_unit = \"m\" }\n";
    let files = [
        ("poses.csv", "0.5,0,0,0,0,1.5707963267948966\n"),
        ("camera.csv", "1,2,3\n"),
        ("robot.csv", "0.5,1,0\n"),
    ];
    let dataset = open("pairs", manifest, &files);
    let pair = &dataset.correspondences[0];
    assert!((pair.in_mount.vector() - Vector3::x()).norm() < 1e-12, "{:?}", pair.in_mount);
    assert_eq!(pair.in_camera.vector(), Vector3::new(0.001, 0.002, 0.003));
}

#[test]
fn touches_without_placements_are_on_the_fixed_board() {
    let manifest = format!(
        "setup = \"eye-in-hand\"\n{TARGET}[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n\
         [corners]\nfiles = \"corners.csv\"\npixel_origin = \"centre\"\n\
         [touches]\nkind = \"tip\"\nlength_unit = \"m\"\npoints = [{{ corner = 2, values = [1.0, 2.0, 3.0] }}]\n"
    );
    let poses = "0.1,0,0,0,0,0\n0.2,0,0,0,0,0\n";
    let dataset = open("fixed", &manifest, &[("poses.csv", poses), ("corners.csv", CORNERS)]);
    assert_eq!(dataset.touches[0].placement, FIXED_BOARD);
    assert_eq!(dataset.touches[0].in_base.vector(), Vector3::new(1.0, 2.0, 3.0));
}

#[test]
fn what_cannot_be_meant_is_refused_and_what_is_said_twice_counts_once() {
    let robot = "setup = \"eye-to-hand\"\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n";
    let corners = "[corners]\nfiles = \"corners.csv\"\npixel_origin = \"centre\"\n";
    let board = "[board_poses]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"camera_from_target\"\n";
    let files = [
        ("poses.csv", "0.1,0,0,0,0,0\n0.2,0,0,0,0,0\n"),
        ("corners.csv", CORNERS),
        ("a1.csv", "id x y\n0 1 2\n"),
        ("a2.csv", "id x y\n0 1 2\n"),
        ("tips.csv", "row,column,x_mm,y_mm,z_mm\n1,2,10,20,30\n"),
    ];
    let refusal = |name: &str, more: &str| {
        let path = folder(name, &format!("{robot}{more}"), &files);
        let error = Dataset::open(&path).err().map(|e| e.to_string());
        fs::remove_dir_all(path).unwrap();
        error.unwrap_or_default()
    };
    let several = refusal(
        "several",
        &format!("{corners}{TARGET}[[placements]]\nid = \"A\"\ncorners = \"a*.csv\"\n"),
    );
    assert!(several.contains("\"a*.csv\" is 2 files, a placement has one"), "{several}");
    let touches = "[touches]\nfile = \"tips.csv\"\nkind = \"tip\"\nlength_unit = \"mm\"\n";
    let untold = refusal("untold", &format!("{board}{touches}"));
    assert!(untold.contains("no target is declared"), "{untold}");
    let ball =
        refusal("ball", &format!("{corners}[target]\nkind = \"sphere\"\ndiameter_mm = 50.0\n"));
    assert!(ball.contains("is a ball and has no corners"), "{ball}");
    let twice = format!("{robot}{corners}{TARGET}[captures]\nexclude = [\"b\", \"b\"]\n");
    assert_eq!(open("twice", &twice, &files).captures.len(), 1);
}

#[test]
fn suspicious_units_are_warned_of() {
    let manifest = format!(
        "setup = \"eye-in-hand\"\n{TARGET}[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n\
         [corners]\nfiles = \"corners.csv\"\npixel_origin = \"centre\"\n"
    );
    let poses = "300,0,0,180,0,0\n200,0,0,90,0,0\n";
    let dataset = open("units", &manifest, &[("poses.csv", poses), ("corners.csv", CORNERS)]);
    let codes: Vec<&str> = dataset.warnings.iter().map(|w: &Warning| w.code.as_str()).collect();
    assert_eq!(codes, ["length-unit-suspicious", "angle-unit-suspicious"]);
    assert!(
        dataset.warnings[0].message.contains("handeye.toml:8 [robot.poses]"),
        "{:?}",
        dataset.warnings
    );
}
