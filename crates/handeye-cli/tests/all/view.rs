//! `handeye view` and the page of `handeye register`.

use std::fmt::Write;

use handeye::{Intrinsics, Scan, math::random::Random, simulate::Room};
use nalgebra::{Isometry3, Vector3};
use serde_json::{Value, json};

use crate::folder::{Folder, handeye};

/// Two scans of a cell, the second from 3 mm farther away.
fn scans() -> (Scan, Scan) {
    let mut random = Random::new(1);
    let room = Room::of_a_cell(&mut random);
    let camera = Intrinsics::pinhole(240, 180, 240.0, 240.0, 119.5, 89.5);
    let above =
        |z: f64| Isometry3::new([0.0, 0.0, z].into(), Vector3::new(std::f64::consts::PI, 0.0, 0.0));
    let source = room.scan(&above(0.8), &camera, 3e-4, &mut random);
    (source, room.scan(&above(0.803), &camera, 3e-4, &mut random))
}

fn pcd(scan: &Scan) -> String {
    let points: Vec<_> = scan.points().iter().filter(|p| p[0].is_finite()).collect();
    let mut text = format!(
        "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {0}\nHEIGHT 1\nPOINTS {0}\n\
         DATA ascii\n",
        points.len()
    );
    for [x, y, z] in points {
        writeln!(text, "{x} {y} {z}").unwrap();
    }
    text
}

fn folder() -> Folder {
    let (source, target) = scans();
    let folder = Folder::new();
    folder.put("source.pcd", &pcd(&source));
    folder.put("target.pcd", &pcd(&target));
    folder
}

/// The answer of `solve` on exact pairs, which is a calibration.
fn calibration(folder: &Folder, setup: &str) -> String {
    let x = Isometry3::new([0.5, 0.1, 1.2].into(), [3.0, 0.1, 0.2].into());
    let y = Isometry3::new([0.02, 0.01, 0.1].into(), [0.0, 0.3, 0.1].into());
    let pose = |p: &Isometry3<f64>| {
        let (t, q) = (p.translation.vector, p.rotation.coords);
        json!({"translation_m": [t.x, t.y, t.z], "rotation_xyzw": [q.x, q.y, q.z, q.w]})
    };
    let mut random = Random::new(4);
    let pair = |k: usize| {
        let turn = random.normal3() * 0.5;
        let base_from_flange = Isometry3::new(Vector3::new(0.4, 0.1 * k as f64, 0.5), turn);
        let anchor_from_mount = match setup {
            "eye-to-hand" => base_from_flange.inverse(),
            _ => base_from_flange,
        };
        let camera_from_target = (anchor_from_mount * x).inv_mul(&y);
        json!({"id": k.to_string(), "base_from_flange": pose(&base_from_flange),
               "camera_from_target": pose(&camera_from_target)})
    };
    let pairs: Vec<Value> = (0..12).map(pair).collect();
    folder.put("pairs.json", &json!({"setup": setup, "pairs": pairs}).to_string());
    let run = handeye(folder, &["solve", "pairs.json", "--json"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    run.stdout
}

#[test]
fn a_registration_is_reported_with_its_distances_and_answers_as_without() {
    let folder = folder();
    let plain = ["register", "source.pcd", "target.pcd", "--json"];
    let mut reported = plain.to_vec();
    reported.extend(["--report", "page.html"]);
    let (without, with) = (handeye(&folder, &plain), handeye(&folder, &reported));
    assert_eq!((without.code, with.code), (0, 0), "{}", with.stderr);
    assert_eq!(with.json()["target_from_source"], without.json()["target_from_source"]);
    assert!(with.stderr.contains("report: page.html"), "{}", with.stderr);
    let page = folder.read("page.html");
    for words in
        ["Accepted", "source: source.pcd", "target: target.pcd", "before", "points of the source"]
    {
        assert!(page.contains(words), "{words}");
    }
    // the scans lie 3 mm apart before, and less than half a millimetre after
    let median = |state: &str| -> f64 {
        let row = page.split(&format!("<tr><td>{state}</td><td>")).nth(1).unwrap();
        row.split('<').next().unwrap().parse().unwrap()
    };
    assert!((median("before") - 3.0).abs() < 0.2, "{}", median("before"));
    assert!(median("after") < 0.4, "{}", median("after"));
    assert_eq!(folder.list(".").iter().filter(|name| name.ends_with(".part")).count(), 0);
}

#[test]
fn a_rejected_registration_is_reported_as_well() {
    let folder = folder();
    folder.put("far.json", "{\"translation_m\": [0, 0, 3], \"rotation_xyzw\": [0, 0, 0, 1]}");
    let run = handeye(
        &folder,
        &["register", "source.pcd", "target.pcd", "--initial", "far.json", "--report", "page.html"],
    );
    assert_eq!(run.code, 3);
    assert!(folder.read("page.html").contains("class=\"word\">Rejected"));
    let run =
        handeye(&folder, &["register", "source.pcd", "target.pcd", "--report", "no/page.html"]);
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("page.html"), "{}", run.stderr);
}

#[test]
fn scans_are_viewed_each_as_a_layer_and_the_page_is_the_same_again() {
    let folder = folder();
    let run = handeye(&folder, &["view", "source.pcd", "target.pcd", "--json"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let told = run.json();
    assert_eq!(
        (told["page"].as_str(), told["layers"][1]["name"].as_str()),
        (Some("view.html"), Some("target.pcd"))
    );
    assert_eq!(told["layers"][0]["of"], told["layers"][0]["shown"]);
    assert!(told["notes"][0].as_str().unwrap().contains("own frame"));
    let page = folder.read("view.html");
    assert!(page.contains("source.pcd") && page.contains("class=\"scene\""));
    let run = handeye(&folder, &["view", "source.pcd", "target.pcd", "--out", "again.html"]);
    assert!(run.stdout.contains("page: again.html"), "{}", run.stdout);
    assert!(page == folder.read("again.html"));
}

#[test]
fn a_registration_moves_the_first_scan_and_an_eye_to_hand_calibration_all() {
    let folder = folder();
    let register = ["register", "source.pcd", "target.pcd", "--json"];
    folder.put("found.json", &handeye(&folder, &register).stdout);
    folder.put("calibration.json", &calibration(&folder, "eye-to-hand"));
    let notes = |files: &[&str]| {
        let mut all = vec!["view"];
        all.extend(files);
        all.push("--json");
        let run = handeye(&folder, &all);
        assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
        run.json()["notes"].to_string()
    };
    let moved = notes(&["source.pcd", "target.pcd", "found.json"]);
    assert!(moved.contains("source.pcd was moved by target_from_source of found.json"), "{moved}");
    let moved = notes(&["source.pcd", "target.pcd", "found.json", "calibration.json"]);
    assert!(moved.contains("target_from_source") && moved.contains("robot's base, by"), "{moved}");
    let page = folder.read("view.html");
    assert!(page.contains("robot base") && page.contains("flange poses"));
    folder.put("in-hand.json", &calibration(&folder, "eye-in-hand"));
    let apart = notes(&["source.pcd", "in-hand.json"]);
    assert!(apart.contains("means nothing"), "{apart}");
    assert_eq!(notes(&["in-hand.json"]), "[]");
}

/// A small simulated dataset with scans, and its result.
fn with_result(setup: &str) -> Folder {
    let folder = Folder::new();
    let size = ["--captures", "8", "--width", "640", "--height", "400", "--scans"];
    let mut simulate = vec!["simulate", "cell", "--setup", setup, "--scan-format", "ply"];
    simulate.extend(size);
    assert_eq!(handeye(&folder, &simulate).code, 0);
    let run = handeye(&folder, &["calibrate", "cell", "--out", "result"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    folder
}

#[test]
fn a_dataset_is_viewed_with_its_result_and_its_scans_in_the_base_frame() {
    for setup in ["eye-in-hand", "eye-to-hand"] {
        let folder = with_result(setup);
        let run = handeye(&folder, &["view", "cell", "result", "--json"]);
        assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
        let page = folder.read("view.html");
        assert_eq!(page.matches("scans, brought together by the result").count(), 1);
        assert!(page.contains("board by the result") && page.contains("residual of a capture"));
        assert!(page.len() < 8_000_000, "{}", page.len());
        handeye(&folder, &["view", "cell", "result", "--out", "again.html"]);
        assert!(page == folder.read("again.html"), "the same page again");
        let report = folder.read("result/report.html");
        assert!(report.contains("scans, brought together by the result"));
        assert!(report.contains("<tr class=\"\" data-capture=\""), "rows name their captures");
    }
}

#[test]
fn scans_with_the_names_of_captures_are_moved_to_where_the_robot_held_the_camera() {
    let folder = with_result("eye-in-hand");
    let files = ["view", "cell/scans/001.ply", "cell/scans/002.ply", "result", "--json"];
    let run = handeye(&folder, &files);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let notes = run.json()["notes"].to_string();
    assert!(notes.contains("robot pose of its capture of the same name"), "{notes}");
}

#[test]
fn a_dataset_without_its_result_is_refused() {
    let folder = with_result("eye-in-hand");
    for files in [&["view", "cell"][..], &["view", "cell", "cell", "result"]] {
        let run = handeye(&folder, files);
        assert_eq!(run.code, 2, "{}", run.stderr);
        assert!(run.stderr.contains("one dataset and one calibration.json"), "{}", run.stderr);
    }
}

#[test]
fn a_mesh_is_viewed_as_triangles_in_the_unit_that_was_said() {
    let folder = Folder::new();
    folder
        .put("part.obj", "v 0 0 500\nv 100 0 500\nv 0 100 500\nv 100 100 510\nf 1 2 3\nf 2 4 3\n");
    let run = handeye(&folder, &["view", "part.obj", "--json", "--quiet"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let told = run.json();
    assert_eq!(
        told["layers"],
        json!([{"name": "part.obj", "what": "triangles", "of": 2, "shown": 2}])
    );
    assert_eq!(told["warnings"][0]["code"], "unit-assumed");
    assert!(folder.read("view.html").contains("2 triangles"));
    folder.put("calibration.json", &calibration(&folder, "eye-to-hand"));
    let run = handeye(&folder, &["view", "part.obj", "calibration.json", "--json"]);
    assert!(
        run.json()["notes"][0].as_str().unwrap().contains("nothing was moved"),
        "{}",
        run.stdout
    );
    let run = handeye(&folder, &["view", "part.obj", "--length-unit", "mm"]);
    assert!(
        run.stdout.contains("part.obj: 2 triangles") && run.stderr.is_empty(),
        "{}",
        run.stderr
    );
}

#[test]
fn no_page_takes_the_place_of_what_it_shows() {
    let folder = folder();
    let before = folder.read("source.pcd");
    for command in [
        ["view", "source.pcd", "target.pcd", "--out", "./source.pcd"],
        ["register", "source.pcd", "target.pcd", "--report", "./source.pcd"],
    ] {
        let run = handeye(&folder, &command);
        assert_eq!(run.code, 2, "{command:?}: {}", run.stderr);
        assert!(run.stderr.contains("would be written over"), "{}", run.stderr);
    }
    assert!(before == folder.read("source.pcd"));
}

#[test]
fn a_depth_image_is_viewed_with_its_intrinsics() {
    let folder = Folder::new();
    let depth = vec![8000u16; 240 * 180];
    image::ImageBuffer::<image::Luma<u16>, Vec<u16>>::from_raw(240, 180, depth)
        .unwrap()
        .save(folder.0.join("depth.png"))
        .unwrap();
    folder.put(
        "camera.json",
        "{\"camera_matrix\": [[240, 0, 119.5], [0, 240, 89.5], [0, 0, 1]], \"dist_coeffs\": [0, 0, 0, 0, 0]}",
    );
    let missing = handeye(&folder, &["view", "depth.png"]);
    assert_eq!(missing.code, 1);
    assert!(missing.stderr.contains("--camera is missing"), "{}", missing.stderr);
    let run = handeye(
        &folder,
        &["view", "depth.png", "--camera", "camera.json", "--depth-scale", "0.0001", "--json"],
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(run.json()["layers"][0]["of"], 240 * 180);
}

#[test]
fn what_cannot_be_viewed_is_told_what_can() {
    let folder = folder();
    folder.put("notes.doc", "hello");
    folder.put("other.json", "{\"a\": 1}");
    folder.put("broken.json", "{\"a\": ");
    folder.put(
        "found.json",
        "{\"target_from_source\": {\"translation_m\": [0, 0, 0], \"rotation_xyzw\": [0, 0, 0, 1]}}",
    );
    folder.put(
        "turned.json",
        "{\"target_from_source\": {\"translation_m\": [0, 0, 0], \"rotation_xyzw\": [1, 1, 0, 1]}}",
    );
    let cases: [(&[&str], i32, &str); 8] = [
        (&["notes.doc"], 1, "what can be viewed is scans"),
        (&["other.json"], 1, "neither a calibration nor a registration"),
        (&["broken.json"], 1, "broken.json"),
        (&["nowhere.pcd"], 1, "nowhere.pcd"),
        (&["source.pcd", "found.json"], 2, "the one that stays"),
        (&["source.pcd", "target.pcd", "found.json", "found.json"], 2, "one registration"),
        (&["source.pcd", "target.pcd", "turned.json"], 1, "quaternion"),
        (&[], 2, "required"),
    ];
    for (files, code, named) in cases {
        let mut all = vec!["view"];
        all.extend(files);
        let run = handeye(&folder, &all);
        assert_eq!(run.code, code, "{files:?}: {}", run.stderr);
        assert!(run.stderr.contains(named), "{files:?}: {}", run.stderr);
        assert!(folder.list(".").iter().all(|name| name != "view.html"), "{files:?}");
    }
}
