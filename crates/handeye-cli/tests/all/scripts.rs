//! What scripts, spreadsheets and ROS need: tables of pairs, several methods, one line for a log, exit codes, where a result
//! comes from, names of frames, manifests apart from their data.

use std::{fs, path::Path};

use serde_json::{Value, json};

use crate::folder::{Folder, Run, handeye};

#[track_caller]
fn ends(run: &Run, code: i32) -> &Run {
    assert_eq!(run.code, code, "{}{}", run.stdout, run.stderr);
    run
}

/// Pairs that `calibrate` found in a simulated cell, as JSON, and as CSV with another mark and decimal point.
fn pairs() -> Folder {
    let folder = Folder::new();
    let simulate =
        ["simulate", "cell", "--captures", "10", "--no-images", "--touches", "0", "--quiet"];
    ends(&handeye(&folder, &simulate), 0);
    let found = handeye(&folder, &["calibrate", "cell", "--json", "--quiet"]).json();
    let robot = folder.read("cell/robot.csv");
    let mut pairs = vec![];
    let mut table = String::new();
    for line in robot.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let id = cells[0];
        let n = |k: usize| cells[k].parse::<f64>().unwrap();
        let robot = json!({
            "translation_m": [n(1), n(2), n(3)], "rotation_xyzw": [n(4), n(5), n(6), n(7)]
        });
        let captures = found["captures"].as_array().unwrap();
        let seen = &captures.iter().find(|c| c["id"] == id).unwrap()["camera_from_target"];
        let numbers = |pose: &Value| {
            let of = |key: &str| pose[key].as_array().unwrap().clone();
            [of("translation_m"), of("rotation_xyzw")].concat()
        };
        let line: Vec<String> =
            [numbers(&robot), numbers(seen)].concat().iter().map(Value::to_string).collect();
        table += &format!("{id};{}\n", line.join(";").replace('.', ","));
        pairs.push(json!({ "id": id, "base_from_flange": robot, "camera_from_target": seen }));
    }
    let document = json!({ "setup": "eye-in-hand", "pairs": pairs });
    folder.put("pairs.json", &document.to_string());
    folder.put("PAIRS.CSV", &table);
    folder
}

fn translation(answer: &Value) -> Vec<f64> {
    let t = answer["hand_eye"]["mount_from_camera"]["translation_m"].as_array().unwrap();
    t.iter().map(|x| x.as_f64().unwrap()).collect()
}

#[test]
fn a_table_of_pairs_with_decimal_commas_gives_the_answer_of_the_json() {
    let folder = pairs();
    let json = handeye(&folder, &["solve", "pairs.json", "--json", "--quiet"]).json();
    let table =
        handeye(&folder, &["solve", "PAIRS.CSV", "--setup", "eye-in-hand", "--json", "--quiet"])
            .json();
    for (a, b) in translation(&json).into_iter().zip(translation(&table)) {
        assert!((a - b).abs() < 1e-9, "{a} and {b}");
    }
    let refused = handeye(&folder, &["solve", "PAIRS.CSV"]);
    assert!(ends(&refused, 2).error().starts_with("--setup is missing"), "{}", refused.stderr);
    let refused = handeye(&folder, &["solve", "pairs.json", "--setup", "eye-in-hand"]);
    assert!(ends(&refused, 2).error().contains("a JSON file says it"), "{}", refused.stderr);
}

#[test]
fn methods_are_compared_with_the_answer_and_with_one_another() {
    let folder = pairs();
    let all =
        handeye(&folder, &["solve", "pairs.json", "--method", "all", "--json", "--quiet"]).json();
    let methods = all["methods"].as_array().unwrap();
    assert_eq!(methods.len(), handeye::Method::ALL.len());
    let of = |name: &str| methods.iter().find(|m| m["method"] == name).unwrap();
    assert!(of("shah")["time_us"].as_f64().unwrap() > 0.0);
    let apart = |name: &str| of(name)["difference"]["camera_origin_mm"].as_f64().unwrap();
    assert!(apart("shah") < 5.0 && apart("shah") > 0.0, "{}", apart("shah"));
    let alone =
        handeye(&folder, &["solve", "pairs.json", "--method", "shah", "--json", "--quiet"]).json();
    assert_eq!(alone["hand_eye"]["mount_from_camera"], of("shah")["mount_from_camera"]);
    let two = handeye(&folder, &["solve", "pairs.json", "--method", "li,wu"]);
    let text = &ends(&two, 0).stdout;
    assert!(
        text.contains("\n  li  ") && text.contains("\n  wu  ") && !text.contains("\n  shah"),
        "{text}"
    );
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    let unknown = handeye(&folder, &["solve", "pairs.json", "--method", "li,nobody"]);
    assert!(ends(&unknown, 2).error().starts_with("no method \"nobody\""), "{}", unknown.stderr);
}

#[test]
fn a_result_says_what_it_was_made_from() {
    let folder = pairs();
    ends(&handeye(&folder, &["solve", "pairs.json", "--out", "result", "--quiet"]), 0);
    let found: Value = serde_json::from_str(&folder.read("result/calibration.json")).unwrap();
    assert!(folder.list("result").contains(&"report.html".to_owned()));
    assert_eq!(found["inputs"][0]["path"], "pairs.json");
    assert_eq!(found["inputs"][0]["sha256"].as_str().unwrap().len(), 64);
    assert_eq!(found["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(found["dataset"], "pairs");
    let created = found["created"].as_str().unwrap();
    assert!(created.len() == 20 && created.ends_with('Z'), "{created}");

    let of_cell = handeye(&folder, &["calibrate", "cell", "--json", "--quiet"]).json();
    let inputs = of_cell["inputs"].as_array().unwrap();
    let paths: Vec<&str> = inputs.iter().map(|i| i["path"].as_str().unwrap()).collect();
    assert_eq!(paths[0], "handeye.toml");
    assert!(paths.contains(&"robot.csv") && paths.len() >= 12, "{paths:?}");
    assert_eq!(of_cell["dataset"], "cell");
    assert!(of_cell.get("equipment").is_none());
}

#[test]
fn a_result_says_which_camera_and_robot_it_is_of() {
    let folder = pairs();
    let numbers = "width = 1920\nheight = 1200\nfx = 1800.0\nfy = 1800.0\ncx = 959.5\ncy = 599.5\n";
    let manifest = folder.read("cell/handeye.toml").replace(numbers, "file = \"camera.yaml\"\n");
    let says = "\n[equipment]\nrobot = \"UR10e\"\nrobot_serial = \"2021-17\"\n";
    folder.put("cell/handeye.toml", &(manifest + says + "camera_serial = \"0042\"\n"));
    let intrinsics = numbers.replace(" =", ":");
    folder.put(
        "cell/camera.yaml",
        &(intrinsics.clone() + "camera_name: M130\nserial_number: 0042\n"),
    );
    ends(&handeye(&folder, &["calibrate", "cell", "--out", "result", "--quiet"]), 0);
    let found: Value = serde_json::from_str(&folder.read("result/calibration.json")).unwrap();
    let expected = json!({
        "camera": "M130", "camera_serial": "0042", "robot": "UR10e", "robot_serial": "2021-17"
    });
    assert_eq!(found["equipment"], expected);
    let page = folder.read("result/report.html");
    let words = "The cell: camera M130, serial number 0042; robot UR10e, serial number 2021-17.";
    assert!(page.contains(words), "no such sentence in the report");

    folder.put("cell/camera.yaml", &(intrinsics + "serial_number: 43\n"));
    let other = handeye(&folder, &["calibrate", "cell", "--quiet"]);
    assert!(
        ends(&other, 1).error().contains("0042, and camera.yaml holds the intrinsics of 43"),
        "{}",
        other.stderr
    );
}

#[test]
fn the_same_input_gives_the_same_bytes_at_the_same_time() {
    let folder = pairs();
    let once = || {
        let mut command =
            crate::folder::command(&folder, &["calibrate", "cell", "--json", "--quiet"]);
        command.env("SOURCE_DATE_EPOCH", "86400").output().unwrap().stdout
    };
    let first = once();
    assert!(String::from_utf8_lossy(&first).contains("\"created\": \"1970-01-02T00:00:00Z\""));
    assert_eq!(first, once());
}

#[test]
fn one_line_and_an_exit_code_tell_a_script_enough() {
    let folder = Folder::new();
    let simulate = ["simulate", "cell", "--touches", "0", "--no-images", "--seed", "3", "--quiet"];
    ends(&handeye(&folder, &simulate), 0);
    let plain = handeye(&folder, &["calibrate", "cell", "--oneline", "--strict", "--quiet"]);
    let line = &ends(&plain, 0).stdout;
    assert!(
        line.starts_with("ACCEPTED  ") && line.contains(" mm (95 %)  15 of 15 captures  cell  "),
        "{line}"
    );
    assert_eq!(line.lines().count(), 1);

    let manifest = folder.read("cell/handeye.toml");
    fs::write(
        folder.0.join("cell/handeye.toml"),
        manifest.replace("square_mm = 30.0", "square_mm = 30.6"),
    )
    .unwrap();
    let larger = ["calibrate", "cell", "--oneline", "--quiet"];
    let line = handeye(&folder, &larger);
    assert!(
        ends(&line, 0).stdout.contains("  but: the answer uses the estimated size"),
        "{}",
        line.stdout
    );
    ends(&handeye(&folder, &[&larger[..], &["--strict"]].concat()), 4);

    let strict = handeye(&folder, &[&larger[..], &["--max-error-mm", "0.01"]].concat());
    assert!(ends(&strict, 3).stdout.starts_with("REJECTED  "), "{}", strict.stdout);
    ends(&handeye(&folder, &[&larger[..], &["--max-error-mm", "0"]].concat()), 2);
}

#[test]
fn a_manifest_may_lie_apart_from_its_data() {
    let folder = pairs();
    fs::create_dir(folder.0.join("apart")).unwrap();
    let manifest = folder.read("cell/handeye.toml");
    folder.put("apart/handeye.toml", &format!("root = \"../cell\"\n{manifest}"));
    let there = handeye(&folder, &["calibrate", "cell", "--json", "--quiet"]).json();
    let apart = handeye(&folder, &["calibrate", "apart", "--json", "--quiet"]).json();
    assert_eq!(translation(&there), translation(&apart));
    assert_eq!(apart["inputs"][1]["sha256"], there["inputs"][1]["sha256"]);
}

/// A data set of easy_handeye2's layout.
fn samples(folder: &Folder) {
    let document: Value = serde_json::from_str(&folder.read("pairs.json")).unwrap();
    let mut text = "samples:\n".to_owned();
    for pair in document["pairs"].as_array().unwrap() {
        for (k, (ours, theirs)) in
            [("base_from_flange", "robot"), ("camera_from_target", "tracking")]
                .into_iter()
                .enumerate()
        {
            let n = |key: &str, k: usize| pair[ours][key][k].as_f64().unwrap();
            text += if k == 0 { "- " } else { "  " };
            text += &format!("{theirs}:\n    rotation:\n");
            for (axis, name) in ["x", "y", "z", "w"].into_iter().enumerate() {
                text += &format!("      {name}: {:e}\n", n("rotation_xyzw", axis));
            }
            text += "    translation:\n";
            for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
                text += &format!("      {name}: {:e}\n", n("translation_m", axis));
            }
        }
    }
    folder.put("theirs/cell.samples", &text);
}

#[test]
fn what_is_imported_elsewhere_can_be_calibrated_there() {
    let folder = pairs();
    fs::create_dir(folder.0.join("theirs")).unwrap();
    samples(&folder);
    let import = ["import", "theirs/cell.samples", "--setup", "eye-in-hand", "--out", "ours/here"];
    ends(&handeye(&folder, &import), 0);
    assert!(folder.read("ours/here/handeye.toml").starts_with("root = \"../../theirs\""));
    let found = handeye(&folder, &["calibrate", "ours/here", "--json", "--quiet"]);
    let own = handeye(&folder, &["solve", "pairs.json", "--json", "--quiet"]).json();
    for (a, b) in translation(&ends(&found, 0).json()).into_iter().zip(translation(&own)) {
        assert!((a - b).abs() < 1e-3, "{a} and {b}");
    }
}

#[test]
fn frames_have_the_names_of_the_manifest_and_bodies_their_own_pose() {
    let folder = pairs();
    let export = |more: &[&str]| {
        let command = ["export", "result", "--format", "urdf"];
        handeye(&folder, &[&command[..], more].concat())
    };
    ends(&handeye(&folder, &["calibrate", "cell", "--out", "result", "--quiet"]), 0);
    assert!(
        ends(&export(&[]), 0)
            .stdout
            .contains("<parent link=\"flange\"/>\n  <child link=\"camera\"/>")
    );
    let refused = export(&["--child", "front_camera_link"]);
    assert!(
        ends(&refused, 2).error().starts_with("front_camera_link is the name of a camera's body"),
        "{}",
        refused.stderr
    );

    // without names in the manifest, from the camera's URDF
    folder.put(
        "d435.urdf",
        "<robot name=\"d435\"><link name=\"camera_link\"/><link name=\"optical\"/>\n\
         <joint name=\"lens\" type=\"fixed\"><parent link=\"camera_link\"/><child link=\"optical\"/>\n\
         <origin xyz=\"0 0 0.25\"/></joint></robot>",
    );
    let of_urdf = ["--child", "camera_link", "--urdf", "d435.urdf"];
    let asked = export(&of_urdf);
    assert!(ends(&asked, 2).error().starts_with("which link of the URDF is"), "{}", asked.stderr);
    let nowhere = export(&[&of_urdf[..], &["--optical", "optica"]].concat());
    assert!(ends(&nowhere, 1).error().ends_with("did you mean optical?"), "{}", nowhere.stderr);
    let of_model = export(&[&of_urdf[..], &["--optical", "optical"]].concat()).stdout;

    let manifest = folder.read("cell/handeye.toml")
        + "\n[frames]\nmount = \"tool0\"\ncamera = \"optical\"\n[[frames.bodies]]\nname = \"camera_link\"\n\
           body_from_camera = { translation_m = [0.0, 0.0, 0.5], rotation_xyzw = [0.0, 0.0, 0.0, 1.0] }\n";
    folder.put("cell/handeye.toml", &manifest);
    ends(&handeye(&folder, &["calibrate", "cell", "--out", "result", "--quiet"]), 0);
    let optical = export(&[]).stdout;
    assert!(optical.contains("<parent link=\"tool0\"/>\n  <child link=\"optical\"/>"), "{optical}");
    let body = export(&["--child", "camera_link"]).stdout;
    assert!(body.contains("<child link=\"camera_link\"/>"), "{body}");
    let xyz = |text: &str| {
        let numbers = text.split("xyz=\"").nth(1).unwrap().split('"').next().unwrap();
        numbers.split(' ').map(|n| n.parse::<f64>().unwrap()).collect::<Vec<_>>()
    };
    // half a metre behind the camera, along its own axis
    let (optical, body) = (xyz(&optical), xyz(&body));
    for (body, behind) in [(body, 0.5), (xyz(&of_model), 0.25)] {
        let apart: f64 =
            optical.iter().zip(&body).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        assert!((apart - behind).abs() < 1e-6, "{apart}");
    }
}

#[test]
fn a_result_is_its_folder_wherever_one_is_meant() {
    let folder = pairs();
    ends(&handeye(&folder, &["calibrate", "cell", "--out", "a", "--quiet"]), 0);
    ends(&handeye(&folder, &["solve", "pairs.json", "--out", "b", "--quiet"]), 0);
    assert_ne!(handeye(&folder, &["compare", "a", "b"]).code, 1);
    ends(&handeye(&folder, &["export", "a", "--format", "kuka"]), 0);
    ends(&handeye(&folder, &["view", "a", "--out", "page.html"]), 0);
    assert!(Path::new(&folder.0).join("page.html").is_file());
}
