//! What other programs recorded or found, taken over: measured sets to an accepted calibration, results to a verified and
//! exported pose. Measured data lie outside of the project; without them these tests say so and pass.

use std::path::{Path, PathBuf};

use handeye::{Calibration, Verdict};
use nalgebra::{Isometry3, Vector3};
use serde_json::{Value, json};

use crate::folder::{Folder, Run, handeye};

fn data(set: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let root = std::env::var_os("HANDEYE_TEST_DATA").map_or(root, PathBuf::from);
    let folder = root.join(set);
    if folder.is_dir() {
        return Some(folder.canonicalize().unwrap());
    }
    println!("SKIPPED: no measured data at {}; set HANDEYE_TEST_DATA", folder.display());
    None
}

#[track_caller]
fn ends(run: &Run, code: i32) -> &Run {
    assert_eq!(run.code, code, "{}{}", run.stdout, run.stderr);
    run
}

#[track_caller]
fn accepted(run: &Run, left_out_mm: f64) -> Calibration {
    let found: Calibration = serde_json::from_str(&ends(run, 0).stdout).unwrap();
    assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
    let mm = found.held_out.translation_rms_mm.unwrap();
    assert!(mm <= left_out_mm, "{mm} mm left out");
    found
}

#[test]
fn trajectories_of_ethz_asl_are_calibrated_and_their_direction_is_proven() {
    let sets = [
        ("robot_arm_w_color_camera_real/robot_arm", 3.2),
        ("prime_sense_color_w_vicon_2/prime_sense_2", 7.2),
    ];
    for (set, left_out_mm) in sets {
        let Some(source) = data(&format!("ethz_handeye/{set}")) else { return };
        let (folder, source) = (Folder::new(), source.to_string_lossy().into_owned());
        let import = [
            "import",
            &source,
            "--setup",
            "eye-in-hand",
            "--direction",
            "base_from_flange",
            "--out",
            "pairs.json",
        ];
        let told = handeye(&folder, &[&import[..], &["--json"]].concat());
        let proof = ends(&told, 0).json()["notes"][2].as_str().unwrap().to_owned();
        assert!(proof.starts_with("proven: as target_from_camera"), "{proof}");
        accepted(&handeye(&folder, &["solve", "pairs.json", "--json", "--quiet"]), left_out_mm);
    }
    let Some(empty) = data("ethz_handeye/1_falcon") else { return };
    let file = |end: &str| {
        let mut all = std::fs::read_dir(&empty).unwrap().map(|e| e.unwrap().path());
        all.find(|p| p.to_string_lossy().ends_with(end)).unwrap().to_string_lossy().into_owned()
    };
    let args = [
        "import",
        &file("vicon.csv"),
        &file("W_d.csv"),
        "--setup",
        "eye-in-hand",
        "--direction",
        "base_from_flange",
    ];
    let run = handeye(&Folder::new(), &args);
    assert!(ends(&run, 1).error().contains("W_d.csv: the file is empty"), "{}", run.stderr);
}

/// Copies whatever lies in a folder into another.
fn copied_into(from: &Path, into: &Folder) {
    for entry in std::fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let to = into.0.join(path.file_name().unwrap());
        copied(&path, &to);
    }
}

fn copied(from: &Path, to: &Path) {
    if !from.is_dir() {
        std::fs::copy(from, to).unwrap();
        return;
    }
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        copied(&path, &to.join(path.file_name().unwrap()));
    }
}

#[test]
fn a_manifest_of_calibration_rs_describes_measured_pictures() {
    let Some(source) = data("tabb_ds1") else { return };
    let folder = Folder::new();
    copied_into(&source, &folder);
    let manifest = json!({
        "version": 1,
        "topology": "single_cam_handeye",
        "cameras": [{ "id": "cam0", "images": { "kind": "glob", "pattern": "images/camera0/image*.png" } }],
        "target": { "kind": "chessboard", "rows": 6, "cols": 8, "square_size_m": 0.0285 },
        "robot_poses": { "path": "robot_cali.txt", "format": "counted4x4" },
        "pose_pairing": { "kind": "by_index" },
        "pose_convention": {
            "transform": "t_tcp_base", "rotation_format": "matrix4x4_row_major", "translation_units": "mm"
        }
    });
    folder.put("dataset.json", &manifest.to_string());
    let run = handeye(&folder, &["import", "dataset.json", "--setup", "eye-in-hand", "--json"]);
    assert_eq!(ends(&run, 0).json()["questions"], json!([]));
    accepted(&handeye(&folder, &["calibrate", ".", "--json", "--quiet"]), 4.43);
}

/// As HALCON writes a pose, by a vector whose length is the tangent of half the angle.
fn halcon(pose: &Isometry3<f64>) -> String {
    let (t, q) = (pose.translation.vector, pose.rotation);
    let r = Vector3::new(q.i, q.j, q.k) / q.w;
    format!(
        "#\n# 3D POSE PARAMETERS: rotation and translation\n#\n\n# Used representation type:\nf 4\n\n\
         # Rotation angles [deg] or Rodriguez-vector:\nr {:e} {:e} {:e}\n\n\
         # Translational vector (x y z [m]):\nt {} {} {}\n",
        r.x, r.y, r.z, t.x, t.y, t.z
    )
}

#[test]
fn poses_of_halcon_are_calibrated_as_the_samples_they_were_made_from() {
    let Some(source) = data("moveit_samples") else { return };
    let samples: Value =
        serde_json::from_slice(&std::fs::read(source.join("pose_samples.json")).unwrap()).unwrap();
    let folder = Folder::new();
    let pose = |rows: &Value| {
        let entry = |i: usize, j: usize| rows[i][j].as_f64().unwrap();
        let m = nalgebra::Matrix3::from_fn(entry);
        let rotation = nalgebra::UnitQuaternion::from_matrix(&m);
        let place = nalgebra::Translation3::new(entry(0, 3), entry(1, 3), entry(2, 3));
        Isometry3::from_parts(place, rotation)
    };
    for (k, sample) in samples.as_array().unwrap().iter().enumerate() {
        folder.put(&format!("base_in_tool_{k:02}.dat"), &halcon(&pose(&sample[0]).inverse()));
        folder.put(&format!("obj_in_cam_{k:02}.dat"), &halcon(&pose(&sample[1])));
    }
    let run = handeye(&folder, &["import", ".", "--setup", "eye-to-hand", "--json"]);
    assert_eq!(ends(&run, 0).json()["questions"], json!([]));
    let found = accepted(&handeye(&folder, &["calibrate", ".", "--json", "--quiet"]), 4.8);
    assert_eq!(found.captures.len(), 50);
}

const OLD: &str = "parameters:\n  name: cell\n  calibration_type: eye_on_base\n  \
                   tracking_base_frame: camera_color_optical_frame\ntransform:\n  \
                   translation: {x: 0.5, y: -0.25, z: 0.7}\n  rotation: {x: 0.6, y: 0.0, z: 0.8, w: 0.0}\n";

/// Points before the camera, and where the tip is led to them, `off` millimetres beside.
fn touches(off: f64) -> String {
    let turn = nalgebra::Quaternion::new(0.0, 0.6, 0.0, 0.8);
    let camera = Isometry3::from_parts(
        nalgebra::Translation3::new(0.5, -0.25, 0.7),
        nalgebra::UnitQuaternion::from_quaternion(turn),
    );
    let mut text =
        "id,camera_x_mm,camera_y_mm,camera_z_mm,touched_x_mm,touched_y_mm,touched_z_mm\n"
            .to_owned();
    for k in 0..8 {
        let wave = |n: f64| (f64::from(k) * n).sin();
        let seen = Vector3::new(150.0 * wave(1.3), 120.0 * wave(2.1), 600.0 + 80.0 * wave(0.7));
        let touched = camera * nalgebra::Point3::from(seen * 1e-3);
        let t = touched.coords * 1e3
            + Vector3::new(off + 0.1 * wave(3.1), 0.1 * wave(4.3), 0.1 * wave(5.7));
        text += &format!("{k},{},{},{},{},{},{}\n", seen.x, seen.y, seen.z, t.x, t.y, t.z);
    }
    text
}

#[test]
fn an_old_result_is_tested_by_touches_and_exported_anew() {
    let folder = Folder::new();
    folder.put("old.calib", OLD);
    folder.put("touches.csv", &touches(0.0));
    folder.put("far.csv", &touches(5.0));
    let run = handeye(&folder, &["import", "old.calib"]);
    assert!(ends(&run, 0).stdout.contains("next: handeye verify"), "{}", run.stdout);
    let pose: Value = serde_json::from_str(&folder.read("base_from_camera.json")).unwrap();
    assert_eq!((&pose["to"], &pose["from"]), (&json!("base"), &json!("camera")));

    let passed = handeye(
        &folder,
        &["verify", "base_from_camera.json", "touches.csv", "--tolerance-mm", "1", "--json"],
    );
    let answer = ends(&passed, 0).json();
    assert_eq!((&answer["verdict"], &answer["agreement"]), (&json!("accepted"), &Value::Null));
    assert_eq!(answer["warnings"][0]["code"], json!("not-judged"));
    let failed = handeye(
        &folder,
        &["verify", "base_from_camera.json", "far.csv", "--tolerance-mm", "1", "--json"],
    );
    assert_eq!(ends(&failed, 3).json()["verdict"], json!("rejected"));
    let open = handeye(&folder, &["verify", "base_from_camera.json", "touches.csv", "--json"]);
    assert_eq!(
        ends(&open, 3).json()["verdict"],
        json!("undetermined"),
        "no uncertainty is made up"
    );

    let exported = handeye(&folder, &["export", "base_from_camera.json", "-f", "ur"]);
    assert!(
        ends(&exported, 0).stdout.contains("p[0.5, -0.25, 0.7, 1.88495"),
        "{}",
        exported.stdout
    );
    assert!(exported.stderr.contains("[not-judged]"), "{}", exported.stderr);
    let spaced = handeye(&folder, &["import", "old.calib", "--out", "an old one.json"]);
    let next = "next: handeye verify 'an old one.json' touches.csv";
    assert!(ends(&spaced, 0).stdout.contains(next), "{}", spaced.stdout);
    let again = handeye(&folder, &["import", "old.calib"]);
    assert!(ends(&again, 1).error().contains("is there already"), "{}", again.stderr);
}

#[test]
fn old_results_are_compared_and_start_a_registration() {
    let folder = Folder::new();
    folder.put("old.calib", OLD);
    folder.put("new.calib", &OLD.replace("x: 0.5", "x: 0.502"));
    for (source, out) in [("old.calib", "a.json"), ("new.calib", "b.json")] {
        ends(&handeye(&folder, &["import", source, "--out", out]), 0);
    }
    let run = handeye(&folder, &["repeat", "a.json", "b.json", "--json"]);
    let answer = ends(&run, 3).json();
    assert_eq!(answer["agree"], Value::Null, "without covariances nothing is tested");
    let apart = answer["pairs"][0]["camera_origin_mm"].as_f64().unwrap();
    assert!((apart - 2.0).abs() < 1e-6, "{apart}");
    let run = handeye(&folder, &["register", "none.ply", "none.ply", "--initial", "a.json"]);
    assert!(ends(&run, 1).error().starts_with("none.ply"), "the start was read: {}", run.stderr);
}

#[test]
fn questions_and_wrong_directions_end_with_what_to_do() {
    let folder = Folder::new();
    folder.put("pose.dat", "f 0\nr 0 0 90\nt 0.1 0 0\n");
    for (args, code, complaint) in [
        (&["import", "pose.dat"][..], 1, "--setup is missing; who carries the camera"),
        (
            &["import", "pose.dat", "--direction", "camera_from_flang"],
            2,
            "did you mean camera_from_flange?",
        ),
        (
            &["import", "pose.dat", "--direction", "flange_from_camera,base_from_camera"],
            1,
            "not as both",
        ),
        (
            &["import", "pose.dat", "--setup", "eye-to-hand", "--direction", "flange_from_camera"],
            1,
            "eye-to-hand was asked for",
        ),
        (&["import", "gone.dat"], 1, "does not exist"),
    ] {
        let run = handeye(&folder, args);
        assert_eq!(run.code, code, "{args:?}: {}", run.stderr);
        assert!(run.stderr.contains(complaint), "{args:?}: {}", run.stderr);
    }
    assert_eq!(folder.list("."), ["pose.dat"], "nothing was written");
}
