//! `handeye solve`: streams by two clocks, unknown scale, certificate, and what it says of bad files.

use nalgebra::{Isometry3, Quaternion, UnitQuaternion, Vector3};
use serde_json::{Value, json};

use crate::folder::{Folder, handeye};

fn pose(rotation: [f64; 3], translation: [f64; 3]) -> Isometry3<f64> {
    Isometry3::new(Vector3::from(translation), Vector3::from(rotation))
}

fn stored(pose: &Isometry3<f64>, scale: f64) -> Value {
    let (t, q) = (pose.translation.vector * scale, pose.rotation.coords);
    json!({ "translation_m": [t.x, t.y, t.z], "rotation_xyzw": [q.x, q.y, q.z, q.w] })
}

const CAMERA: [f64; 3] = [0.03, -0.06, 0.09];

fn robot(t: f64) -> Isometry3<f64> {
    pose(
        [0.2 + 0.5 * (0.9 * t).sin(), 2.9 + 0.4 * (0.63 * t).cos(), 0.6 * (0.41 * t).sin()],
        [0.5 + 0.15 * (0.77 * t).sin(), 0.2 * (0.53 * t).cos(), 0.6 + 0.1 * (1.1 * t).sin()],
    )
}

fn seen(t: f64, scale: f64) -> Value {
    let noise = |n: f64| 1e-4 * (t * 1e3 * n + n).sin();
    let error = pose([noise(1.1), noise(2.3), noise(3.7)], [noise(4.1), noise(5.3), noise(6.7)]);
    let camera = robot(t) * pose([0.1, -0.2, 1.5], CAMERA);
    stored(&(camera.inverse() * pose([0.1, 3.0, 0.1], [0.6, 0.1, 0.02]) * error), scale)
}

fn streams(offset: f64) -> Value {
    let at_robot = |k: u32| f64::from(k) * 0.01;
    let at_camera = |k: u32| 0.004 + f64::from(k) * 0.05;
    json!({
        "setup": "eye-in-hand",
        "robot": (0..1000).map(at_robot).map(|t| {
            json!({ "time_s": t, "base_from_flange": stored(&robot(t), 1.0) })
        }).collect::<Vec<_>>(),
        "camera": (0..200).map(at_camera).map(|t| {
            json!({ "time_s": t + offset, "camera_from_target": seen(t, 1.0) })
        }).collect::<Vec<_>>(),
    })
}

fn pairs(scale: f64) -> Value {
    let pairs: Vec<Value> = (0..15)
        .map(|k| f64::from(k) * 0.7)
        .map(|t| {
            json!({ "base_from_flange": stored(&robot(t), 1.0), "camera_from_target": seen(t, scale) })
        })
        .collect();
    json!({ "setup": "eye-in-hand", "pairs": pairs })
}

fn position(answer: &Value) -> Vector3<f64> {
    let t = answer["hand_eye"]["mount_from_camera"]["translation_m"].as_array().unwrap();
    Vector3::from_fn(|k, _| t[k].as_f64().unwrap())
}

#[test]
fn streams_are_solved_with_their_offset() {
    let folder = Folder::new();
    folder.put("streams.json", &streams(0.137).to_string());
    let run = handeye(&folder, &["solve", "streams.json", "--json"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let answer = run.json();
    let (offset, sigma) = (
        answer["time_offset_s"].as_f64().unwrap(),
        answer["time_offset_sigma_s"].as_f64().unwrap(),
    );
    assert!((offset - 0.137).abs() < 5.0 * sigma && sigma < 1e-3, "{offset} {sigma}");
    assert!((position(&answer) - Vector3::from(CAMERA)).norm() < 1e-3);
    assert_eq!(answer["warnings"][0]["code"], "time-offset");
    let text = handeye(&folder, &["solve", "streams.json"]);
    assert!(text.stdout.contains("time offset     0.137"), "{}", text.stdout);
    assert!(text.stderr.contains("camera time = robot time + offset"), "{}", text.stderr);
}

#[test]
fn an_unknown_scale_is_found_and_the_answer_is_metric() {
    let folder = Folder::new();
    let mut file = pairs(0.25);
    file["unknown_scale"] = true.into();
    file["noise"] = json!({ "robot_position_mm": 0.1, "robot_rotation_deg": 0.01 });
    folder.put("pairs.json", &file.to_string());
    let run = handeye(&folder, &["solve", "pairs.json", "--json"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let answer = run.json();
    let (scale, sigma) =
        (answer["scale"].as_f64().unwrap(), answer["scale_sigma"].as_f64().unwrap());
    assert!((scale - 0.25).abs() < 5.0 * sigma && sigma < 1e-3, "{scale} {sigma}");
    assert!((position(&answer) - Vector3::from(CAMERA)).norm() < 1e-3);
    let text = handeye(&folder, &["solve", "pairs.json"]).stdout;
    assert!(text.contains("measured over metric"), "{text}");
}

#[test]
fn the_least_squares_fit_is_certified() {
    let folder = Folder::new();
    folder.put("pairs.json", &pairs(1.0).to_string());
    let answer = handeye(&folder, &["solve", "pairs.json", "--certify", "--json"]).json();
    let certificate = &answer["certificate"];
    assert_eq!(certificate["certified"], true, "{certificate}");
    assert!(certificate["gap"].as_f64().unwrap() < 1e-6);
    assert!(certificate["min_eigenvalue"].as_f64().unwrap() > -1e-9);
    assert!(certificate["translation_to_answer_mm"].as_f64().unwrap() < 1.0);
    let text = handeye(&folder, &["solve", "pairs.json", "--certify"]).stdout;
    assert!(text.contains("certificate: no other pair of poses fits better"), "{text}");
    let plain = handeye(&folder, &["solve", "pairs.json", "--json"]).json();
    assert!(plain.get("certificate").is_none() && plain.get("scale_sigma").is_none());
    assert_eq!((&plain["scale"], &plain["time_offset_s"]), (&1.0.into(), &0.0.into()));
}

#[test]
fn what_has_no_answer_is_not_certified() {
    let folder = Folder::new();
    let pair = |k: u32| {
        let s = f64::from(k);
        let flange = pose([3.0, 0.1, 0.2], [0.6 + 0.1 * s.sin(), 0.15 * (1.7 * s).cos(), 0.5])
            * pose([0.0, 0.0, 0.4 * s - 1.0], [0.0; 3]);
        let camera = flange * pose([0.1, -0.2, 1.5], CAMERA);
        let seen = camera.inverse() * pose([0.1, 3.0, 0.1], [0.6, 0.1, 0.02]);
        json!({ "base_from_flange": stored(&flange, 1.0), "camera_from_target": stored(&seen, 1.0) })
    };
    let file = json!({ "setup": "eye-in-hand", "pairs": (0..15).map(pair).collect::<Vec<_>>() });
    folder.put("pairs.json", &file.to_string());
    let run = handeye(&folder, &["solve", "pairs.json", "--certify", "--json"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    let answer = run.json();
    assert_eq!(answer["verdict"], "undetermined");
    assert_eq!(answer["undetermined"], json!(["translation along the rotation axis z of flange"]));
    assert!(answer["hand_eye"]["mount_from_camera"].is_null());
    assert!(answer["certificate"].is_null());
    let warnings = answer["warnings"].as_array().unwrap();
    assert!(warnings.iter().any(|w| w["code"] == "not-certified"), "{warnings:?}");
}

#[test]
fn a_byte_order_mark_does_not_matter() {
    let folder = Folder::new();
    folder.put("plain.json", &pairs(1.0).to_string());
    folder.put("marked.json", &format!("\u{feff}{}", pairs(1.0)));
    let solved = |name| handeye(&folder, &["solve", name, "--json"]);
    assert_eq!(solved("marked.json").code, 0, "{}", solved("marked.json").stderr);
    let answer = |name| solved(name).json()["hand_eye"].take();
    assert_eq!(answer("marked.json"), answer("plain.json"));
    // lines and columns are those that an editor shows
    folder.put("marked.json", "\u{feff}{\"setup\": 1}");
    let said = solved("marked.json");
    assert!(said.error().starts_with("marked.json:1: "), "{}", said.stderr);
}

#[test]
fn one_capture_in_another_unit_is_left_out_and_no_more() {
    let folder = Folder::new();
    let mut file = pairs(1.0);
    for k in 0..3 {
        let t = &mut file["pairs"][3]["base_from_flange"]["translation_m"][k];
        *t = (1e3 * t.as_f64().unwrap()).into();
    }
    folder.put("pairs.json", &file.to_string());
    let run = handeye(&folder, &["solve", "pairs.json", "--json", "--quiet"]);
    let answer = run.json();
    assert_eq!((run.code, &answer["rejected"]), (0, &json!(["4"])), "{answer}");
    assert!(answer["warnings"][0].to_string().contains("millimetres read as metres"), "{answer}");
    for pair in file["pairs"].as_array_mut().unwrap() {
        for k in 0..3 {
            let t = &mut pair["base_from_flange"]["translation_m"][k];
            *t = (1e3 * t.as_f64().unwrap()).into();
        }
    }
    folder.put("pairs.json", &file.to_string());
    let all = handeye(&folder, &["solve", "pairs.json", "--json", "--quiet"]).json();
    assert_eq!(all["verdict"], "rejected");
    assert!(all["reasons"].to_string().contains("millimetres read as metres"), "{all}");
}

/// The board lay as ever, but its detector began at the other end: about the board's middle, which
/// the target poses do not tell.
#[test]
fn target_poses_turned_by_half_a_turn_are_named() {
    let folder = Folder::new();
    for (which, about) in [(&[5][..], [0.2, 0.15]), (&[1, 4, 6, 9, 12], [0.0, 0.0])] {
        let mut file = pairs(1.0);
        let turn = pose([0.0, 0.0, std::f64::consts::PI], [about[0], about[1], 0.0]);
        for &k in which {
            let seen = &file["pairs"][k]["camera_from_target"];
            let number = |key: &str, i: usize| seen[key][i].as_f64().unwrap();
            let q = Quaternion::from(std::array::from_fn(|i| number("rotation_xyzw", i)));
            let t = Vector3::from_fn(|i, _| number("translation_m", i));
            let there = Isometry3::from_parts(t.into(), UnitQuaternion::from_quaternion(q));
            let turned = there * turn;
            file["pairs"][k]["camera_from_target"] = stored(&turned, 1.0);
        }
        folder.put("pairs.json", &file.to_string());
        let run = handeye(&folder, &["solve", "pairs.json", "--json", "--quiet"]);
        let answer = run.json();
        assert_eq!(run.code, 0, "{answer}");
        assert_eq!(answer["rejected"].as_array().unwrap().len(), which.len());
        let warnings = answer["warnings"].as_array().unwrap();
        let turned: Vec<_> = warnings.iter().filter(|w| w["code"] == "target-turned").collect();
        assert_eq!(turned.len(), which.len(), "{answer}");
        let centre = format!("({:.0}, {:.0}) mm", about[0] * 500.0, about[1] * 500.0);
        let message = turned[0]["message"].to_string();
        assert!(about[0] == 0.0 || message.contains(&centre), "{centre}: {message}");
    }
}

#[test]
fn bad_files_are_refused_with_the_place_and_what_to_do() {
    let folder = Folder::new();
    let text = |value: Value| serde_json::to_string_pretty(&value).unwrap();
    let mut empty = streams(0.0);
    empty["camera"] = json!([]);
    let mut half = streams(0.0);
    half.as_object_mut().unwrap().remove("robot");
    let mut both = streams(0.0);
    both["pairs"] = pairs(1.0)["pairs"].clone();
    let mut turned = streams(0.0);
    turned["robot"][2]["base_from_flange"]["rotation_xyzw"] = json!([0, 0, 0, 2]);
    let mut no_time = streams(0.0);
    no_time["camera"][1].as_object_mut().unwrap().remove("time_s");
    let mut far = pairs(1.0);
    far["pairs"][3]["base_from_flange"]["translation_m"][0] = 1e300.into();
    let mut noise = pairs(1.0);
    noise["noise"] = json!({ "robot_position_mm": -1.0 });
    let comma = "{\"setup\": \"eye-in-hand\",\n \"pairs\": [\n ],\n}".to_owned();
    for (content, said) in [
        (comma, "p.json:4: trailing comma (column 1): JSON knows no NaN, no comments and no comma"),
        (
            "{\"setup\": ".into(),
            "p.json:1: EOF while parsing a value (column 10): the file ends too early",
        ),
        (text(empty), "p.json: the stream `camera` is empty: record both"),
        (
            text(json!({ "setup": "eye-in-hand", "pairs": [] })),
            "p.json: `pairs` is empty: at least 3 are needed, better 10 to 15",
        ),
        (
            "[]".into(),
            "p.json: the file must hold one JSON object, with `setup` and either `pairs`",
        ),
        ("\"pairs\"".into(), "p.json: the file must hold one JSON object"),
        (
            text(json!({ "setup": "eye-in-hand", "pairs": [[]] })),
            ": pair 1: invalid length 1, expected an object with `base_from_flange`",
        ),
        (text(half), "p.json: the stream `robot` is missing beside the other"),
        (text(both), "p.json: `pairs` and streams: give `pairs`"),
        (text(json!({ "setup": "eye-in-hand" })), "p.json: neither `pairs`, nor `motions`"),
        (text(turned), ": robot sample 3 (time_s 0.02): rotation_xyzw has length 2, not 1"),
        (text(no_time), ": camera sample 2: missing field `time_s` (column "),
        (text(far), ": pair 4: base_from_flange lies 1.0e300 m away, beyond any robot: correct"),
        (text(noise), "p.json: noise.robot_position_mm must be positive"),
    ] {
        folder.put("p.json", &content);
        let run = handeye(&folder, &["solve", "p.json", "--json"]);
        assert_eq!(run.code, 1, "{said}: {}", run.stderr);
        assert!(run.error().contains(said), "{said}: {}", run.stderr);
        assert!(run.error().starts_with("p.json:"), "{}", run.stderr);
    }
    let broken = "{\"setup\": \"eye-in-hand\",\n \"robot\": [],\n \"camera\": [\n  {\"camera_from_target\": {}}]}";
    folder.put("p.json", broken);
    let run = handeye(&folder, &["solve", "p.json", "--json"]);
    assert_eq!(run.error(), "p.json:4: camera sample 1: missing field `translation_m` (column 27)");
    assert_eq!(run.json()["error"]["line"], 4);
}

#[test]
fn streams_of_two_samples_end_with_a_verdict() {
    let folder = Folder::new();
    let mut short = streams(0.0);
    short["camera"].as_array_mut().unwrap().truncate(2);
    folder.put("short.json", &short.to_string());
    for more in [vec![], vec!["--certify"]] {
        let run = handeye(&folder, &[vec!["solve", "short.json", "--json"], more].concat());
        assert_eq!(run.code, 3, "{}", run.stderr);
        let answer = run.json();
        assert_eq!(answer["verdict"], "undetermined");
        assert!(answer["time_offset_s"].is_null());
        assert!(answer["hand_eye"]["mount_from_camera"].is_null());
        let reason = answer["reasons"][0].as_str().unwrap();
        assert!(reason.starts_with("of the camera stream 2 samples"), "{reason}");
    }
    let text = handeye(&folder, &["solve", "short.json"]);
    assert!(text.stdout.contains("UNDETERMINED"), "{}", text.stdout);
}

#[test]
fn streams_that_do_not_move_end_with_a_verdict() {
    let folder = Folder::new();
    let mut still = streams(0.0);
    for sample in still["robot"].as_array_mut().unwrap() {
        sample["base_from_flange"] = stored(&robot(1.0), 1.0);
    }
    for sample in still["camera"].as_array_mut().unwrap() {
        sample["camera_from_target"] = seen(1.0, 1.0);
    }
    folder.put("still.json", &still.to_string());
    let run = handeye(&folder, &["solve", "still.json", "--json"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    let answer = run.json();
    assert_eq!(answer["verdict"], "undetermined");
    assert!(answer["time_offset_s"].is_null());
    let named = answer["undetermined"].as_array().unwrap();
    assert!(named.contains(&"time offset between camera and robot".into()), "{named:?}");
}

/// Motions between the moments of a robot that sees the target, each with noise of its own.
fn motions(setup: &str) -> Vec<(Isometry3<f64>, Isometry3<f64>)> {
    let x = pose([0.1, -0.2, 1.5], CAMERA);
    (0..12)
        .map(|k| f64::from(k) * 1.3)
        .map(|t| {
            let (from, to) = (robot(t), robot(t + 0.9));
            let mount =
                if setup == "eye-in-hand" { from.inverse() * to } else { from * to.inverse() };
            let noise = |n: f64| 1e-4 * (t * 1e3 * n + n).sin();
            let error =
                pose([noise(1.1), noise(2.3), noise(3.7)], [noise(4.1), noise(5.3), noise(6.7)]);
            (mount, x.inverse() * mount * x * error)
        })
        .collect()
}

#[test]
fn relative_motions_are_solved_in_both_setups_from_json_and_tables() {
    for setup in ["eye-in-hand", "eye-to-hand"] {
        let folder = Folder::new();
        let all = motions(setup);
        let entry = |(a, b): &(_, _)| json!({ "A": stored(a, 1.0), "B": stored(b, 1.0) });
        let document =
            json!({ "setup": setup, "motions": all.iter().map(entry).collect::<Vec<_>>() });
        folder.put("motions.json", &document.to_string());
        let run = handeye(&folder, &["solve", "motions.json", "--json"]);
        assert_eq!(run.code, 0, "{}", run.stderr);
        let answer = run.json();
        let off = (position(&answer) - Vector3::from(CAMERA)).norm();
        assert!(off < 1e-3, "{setup}: {off}");
        assert!(answer["predicted_tre_mm"]["p95"].as_f64().unwrap() < 1.5, "{answer}");
        let row = |pose: &Isometry3<f64>| {
            let (t, q) = (pose.translation.vector, pose.rotation.coords);
            format!("{},{},{},{},{},{},{}", t.x, t.y, t.z, q.x, q.y, q.z, q.w)
        };
        let table: Vec<String> =
            all.iter().map(|(a, b)| format!("{},{}", row(a), row(b))).collect();
        folder.put("motions.csv", &table.join("\n"));
        let run =
            handeye(&folder, &["solve", "motions.csv", "--motions", "--setup", setup, "--json"]);
        assert!((position(&run.json()) - position(&answer)).norm() < 1e-9, "{}", run.stderr);
    }
}

#[test]
fn motions_that_cannot_be_used_are_named() {
    let folder = Folder::new();
    let said = |document: Value| {
        folder.put("motions.json", &document.to_string());
        let run = handeye(&folder, &["solve", "motions.json"]);
        assert_eq!(run.code, 1, "{}", run.stdout);
        run.stderr
    };
    let one = stored(&robot(0.0), 1.0);
    let setup = "eye-in-hand";
    let half = said(json!({ "setup": setup, "motions": [{ "A": one }] }));
    assert!(half.contains("motion 1") && half.contains("`B`"), "{half}");
    let named = json!({ "id": "start", "A": one, "B": one });
    let start = said(json!({ "setup": setup, "motions": [named] }));
    assert!(start.contains("is that of the pose from which all begin"), "{start}");
    let with = said(json!({ "setup": setup, "motions": [], "pairs": [] }));
    assert!(with.contains("`motions` stand alone"), "{with}");
    let near = json!({ "setup": setup, "distance_m": -1.0, "motions": [{ "A": one, "B": one }] });
    assert!(said(near).contains("`distance_m` must be positive"));
    let run = handeye(&folder, &["solve", "motions.json", "--motions"]);
    assert!(run.stderr.contains("a JSON file has `motions`"), "{}", run.stderr);
}
