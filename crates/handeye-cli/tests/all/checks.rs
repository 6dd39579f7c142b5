//! `check`, `tcp` and `verify`: what they promise, and what they refuse.

use std::fmt::Write as _;

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use crate::folder::{Folder, Run, handeye};

fn pose(rotation: [f64; 3], translation: [f64; 3]) -> Isometry3<f64> {
    Isometry3::from_parts(
        Vector3::from(translation).into(),
        UnitQuaternion::from_scaled_axis(Vector3::from(rotation)),
    )
}

/// A cell whose manifest has `wrong` in place of `right`.
fn cell(right: &str, wrong: &str) -> Folder {
    let folder = Folder::new();
    let made = handeye(&folder, &["simulate", "cell", "--no-images", "--touches", "0", "--quiet"]);
    assert_eq!(made.code, 0, "{}", made.stderr);
    let manifest = folder.read("cell/handeye.toml");
    assert!(manifest.contains(right), "{manifest}");
    folder.put("cell/handeye.toml", &manifest.replace(right, wrong));
    folder
}

fn check(folder: &Folder, more: &[&str]) -> Run {
    handeye(folder, &[&["check", "cell", "--json", "--quiet"], more].concat())
}

#[test]
fn a_cell_in_order_raises_no_alarm() {
    let folder = cell("", "");
    let run = check(&folder, &["--apply"]);
    let found = run.json();
    assert_eq!((run.code, found["ok"].as_bool()), (0, Some(true)), "{found}");
    assert!(found["applied"].is_null() && found["declared"]["agree"] == 15, "{found}");
    assert!(!folder.list("cell").contains(&"handeye.toml.bak".to_owned()));
}

#[test]
fn one_explanation_is_applied_and_comments_stay() {
    let folder = cell("length_unit = \"m\"", "length_unit = \"mm\" # guessed");
    let (before, measured) = (folder.read("cell/handeye.toml"), folder.read("cell/robot.csv"));
    let told = check(&folder, &[]);
    let found = told.json();
    assert_eq!((told.code, &found["alike"]), (3, &1.into()), "{found}");
    let (first, declared) = (&found["explanations"][0], &found["declared"]);
    assert!(first["after"]["score"].as_f64() < declared["score"].as_f64().or(Some(1e9)), "{found}");
    assert!(found["runner_up"]["after"]["score"].is_number(), "{found}");
    assert_eq!(folder.read("cell/handeye.toml"), before, "nothing is written unasked");
    assert_eq!(check(&folder, &["--apply"]).json()["applied"]["explanation"], 1);
    let after = folder.read("cell/handeye.toml");
    assert!(after.contains("length_unit = \"m\"  # guessed"), "{after}");
    assert!(after.starts_with("# A simulated cell"), "{after}");
    assert_eq!(folder.read("cell/handeye.toml.bak"), before);
    assert_eq!(folder.read("cell/robot.csv"), measured);
    assert_eq!(check(&folder, &[]).code, 0);
}

#[test]
fn a_wrong_unit_is_found_on_a_robot_of_one_axis() {
    for seed in ["2", "3"] {
        let folder = Folder::new();
        let how =
            ["--no-images", "--touches", "0", "--captures", "12", "--tilt-deg", "0", "--quiet"];
        let made = handeye(&folder, &[&["simulate", "cell", "--seed", seed], &how[..]].concat());
        assert_eq!(made.code, 0, "{}", made.stderr);
        let manifest = folder.read("cell/handeye.toml");
        let wrong = manifest.replacen("length_unit = \"m\"", "length_unit = \"cm\"", 1);
        folder.put("cell/handeye.toml", &wrong);
        let found = check(&folder, &["--apply"]).json();
        assert_eq!(found["declared"]["agree"], 0, "{found}");
        assert_eq!(found["applied"]["explanation"], 1, "{found}");
        assert_eq!(folder.read("cell/handeye.toml"), manifest);
    }
}

#[test]
fn of_explanations_that_fit_alike_none_is_applied_unasked() {
    let folder = cell("\"base_from_flange\"", "\"flange_from_base\"");
    let before = folder.read("cell/handeye.toml");
    let run = check(&folder, &["--apply"]);
    let found = run.json();
    assert_eq!((run.code, &found["alike"]), (3, &2.into()), "{found}");
    assert!(found["applied"].is_null(), "{found}");
    assert_eq!(folder.read("cell/handeye.toml"), before);
    let text = handeye(&folder, &["check", "cell"]).stdout;
    assert!(text.contains("Cannot tell between these 2"), "{text}");
    assert_eq!(check(&folder, &["--apply=3"]).code, 2);
    assert_eq!(check(&folder, &["--apply=1"]).json()["applied"]["explanation"], 1);
    assert_eq!(check(&folder, &[]).code, 0);
}

/// Rewrites the robot's poses, line by line.
fn rewrite(folder: &Folder, change: impl Fn(&[Vec<String>], usize) -> Vec<String>) {
    let text = folder.read("cell/robot.csv");
    let (header, rest) = text.split_once('\n').unwrap();
    let lines: Vec<Vec<String>> =
        rest.lines().map(|l| l.split(',').map(String::from).collect()).collect();
    let changed: Vec<String> = (0..lines.len()).map(|k| change(&lines, k).join(",")).collect();
    folder.put("cell/robot.csv", &format!("{header}\n{}\n", changed.join("\n")));
}

#[test]
fn a_notation_is_corrected_with_its_columns() {
    let folder = cell("", "");
    rewrite(&folder, |lines, k| {
        let line = &lines[k];
        [&line[..4], &line[7..], &line[4..7]].concat()
    });
    let found = check(&folder, &["--apply"]).json();
    assert_eq!(found["applied"]["explanation"], 1, "{found}");
    let manifest = folder.read("cell/handeye.toml");
    assert!(manifest.contains("notation = \"quaternion-wxyz\""), "{manifest}");
    assert!(manifest.contains("columns = [\"x\", \"y\", \"z\", \"qx\""), "{manifest}");
    assert_eq!(check(&folder, &[]).code, 0);
    assert_eq!(handeye(&folder, &["calibrate", "cell", "--quiet"]).code, 0);
}

#[test]
fn captures_that_do_not_belong_are_left_out_by_the_manifest() {
    let folder = cell("", "");
    rewrite(&folder, |lines, k| {
        let from = if (5..8).contains(&k) { 5 } else { k };
        [&lines[k][..1], &lines[from][1..]].concat()
    });
    let found = check(&folder, &["--apply"]).json();
    assert_eq!(found["explanations"][0]["code"], "robot-pose-frozen", "{found}");
    let manifest = folder.read("cell/handeye.toml");
    assert!(manifest.contains("[captures]\nexclude = [\"006\", \"007\", \"008\"]"), "{manifest}");
    assert_eq!(check(&folder, &[]).code, 0);
    let folder = cell("", "");
    rewrite(&folder, |lines, k| [&lines[k][..1], &lines[3][1..]].concat());
    let found = check(&folder, &["--apply"]).json();
    assert!(found["applied"].is_null(), "none would be left: {found}");
    let by_hand = found["explanations"][0]["by_hand"].to_string();
    assert!(by_hand.contains("only 0 captures would be left"), "{found}");
}

#[test]
fn what_no_manifest_corrects_is_said_with_what_to_do() {
    let folder = cell("", "");
    rewrite(&folder, |lines, k| [&lines[k][..1], &lines[(k + 1) % lines.len()][1..]].concat());
    let before = folder.read("cell/handeye.toml");
    let run = handeye(&folder, &["check", "cell", "--apply", "--quiet"]);
    let text = run.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(run.code, 3, "{text}");
    assert!(text.contains("1 capture back") && !text.contains("14 captures"), "{text}");
    assert!(text.contains("nothing applied: a manifest cannot shift one list"), "{text}");
    assert_eq!(folder.read("cell/handeye.toml"), before);
}

#[test]
fn what_cannot_be_checked_is_refused() {
    let folder = cell("setup = \"eye-in-hand\"", "setup = 7");
    let run = check(&folder, &[]);
    assert_eq!(run.code, 1);
    let message = run.json()["error"]["message"].to_string();
    assert!(message.contains("handeye.toml:2"), "{message}");
    assert_eq!(handeye(&folder, &["check", "nowhere", "--quiet"]).code, 1);
}

const TIP: [f64; 3] = [0.012, -0.034, 0.207];

/// Flange poses that hold the tip on a point, turned by so much; metres and a rotation vector.
fn pivot(count: usize, turn: f64) -> String {
    (0..count).fold(String::new(), |mut text, k| {
        let wave = |n: f64| turn * (k as f64 * n + 0.4 * n * n).sin();
        let rotation = [3.0 + wave(1.3), wave(2.1), wave(3.4)];
        let lever = pose(rotation, [0.0; 3]).rotation * Vector3::from(TIP);
        let t = Vector3::new(0.5, 0.1, 0.05) - lever;
        let [a, b, c] = rotation;
        let _ = writeln!(text, "{:.6},{:.6},{:.6},{a:.6},{b:.6},{c:.6}", t.x, t.y, t.z);
        text
    })
}

fn tcp(folder: &Folder, file: &str) -> Run {
    let how = ["--notation", "rotation-vector", "--length-unit", "m"];
    let rest = ["--direction", "base_from_flange", "--json", "--quiet"];
    handeye(folder, &[&["tcp", file], &how[..], &rest[..]].concat())
}

#[test]
fn a_pivot_tells_the_tip_with_its_covariance() {
    let folder = Folder::new();
    folder.put("good.csv", &pivot(8, 0.6));
    let run = tcp(&folder, "good.csv");
    let found = run.json();
    assert_eq!((run.code, &found["verdict"]), (0, &"accepted".into()), "{found}");
    for k in 0..3 {
        assert!((found["tip_in_flange_m"][k].as_f64().unwrap() - TIP[k]).abs() < 1e-5, "{found}");
        assert!(found["covariance"][k][k].as_f64().unwrap() > 0.0, "{found}");
    }
}

#[test]
fn poor_pivots_are_refused_with_their_file() {
    let folder = Folder::new();
    folder.put("few.csv", &pivot(3, 0.6));
    folder.put("nan.csv", &pivot(6, 0.6).replacen("0.", "nan", 1));
    folder.put("empty.csv", "");
    for (name, far) in [("far.csv", "1e200"), ("farther.csv", "1e308")] {
        folder.put(name, &(pivot(3, 0.6) + far + ",0,0,0,0,0\n" + &pivot(8, 0.6)));
    }
    for (file, code) in [
        ("far.csv", "malformed"),
        ("farther.csv", "malformed"),
        ("few.csv", "too-few-data"),
        ("nan.csv", "malformed"),
        ("empty.csv", "malformed"),
        ("none.csv", "cannot-read"),
    ] {
        let run = tcp(&folder, file);
        let error = run.json()["error"].clone();
        assert_eq!((run.code, &error["code"]), (1, &code.into()), "{file}: {error}");
        assert!(error["message"].to_string().contains(file), "{error}");
    }
    let far = tcp(&folder, "far.csv").json()["error"].clone();
    assert_eq!(far["line"], 4, "{far}");
    assert!(far["message"].to_string().contains("beyond any robot"), "{far}");
    folder.put("same.csv", &pivot(6, 0.0));
    let run = tcp(&folder, "same.csv");
    let found = run.json();
    assert_eq!((run.code, &found["verdict"]), (3, &"undetermined".into()), "{found}");
    assert!(found["tip_in_flange_m"][0].is_null() && !found["undetermined"][0].is_null());
    assert_eq!(handeye(&folder, &["tcp", "few.csv"]).code, 2);
}

/// A calibrated cell in a folder of its own.
fn calibrated() -> Folder {
    let folder = cell("", "");
    let how = ["--setup", "eye-to-hand", "--touches", "0", "--quiet", "--no-images"];
    assert_eq!(handeye(&folder, &[&["simulate", "hand"], &how[..]].concat()).code, 0);
    let run = handeye(&folder, &["calibrate", "hand", "--out", "result", "--json", "--quiet"]);
    assert_eq!(run.code, 0, "{}", run.stdout);
    folder
}

/// Points seen by the camera, and touched so many millimetres beside them.
fn touches(folder: &Folder, off_mm: f64) -> String {
    let text = folder.read("result/calibration.json");
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    let x = &found["hand_eye"]["mount_from_camera"];
    let number = |key: &str, k: usize| x[key][k].as_f64().unwrap();
    let q = nalgebra::Quaternion::from(std::array::from_fn(|k| number("rotation_xyzw", k)));
    let rotation = UnitQuaternion::from_quaternion(q);
    let t = Vector3::from_fn(|k, _| number("translation_m", k));
    let mut text = String::from(
        "id,camera_x_mm,camera_y_mm,camera_z_mm,touched_x_mm,touched_y_mm,touched_z_mm\n",
    );
    for k in 0..8 {
        let wave = |n: f64| (f64::from(k) * n).sin();
        let seen = Vector3::new(0.15 * wave(1.1), 0.1 * wave(2.3), 0.9 + 0.05 * wave(3.1));
        let there = (rotation * seen + t) * 1e3 + Vector3::new(off_mm, 0.0, 0.0);
        let seen = seen * 1e3;
        let _ = writeln!(
            text,
            "t{k},{},{},{},{},{},{}",
            seen.x, seen.y, seen.z, there.x, there.y, there.z
        );
    }
    text
}

fn verify(folder: &Folder, file: &str, more: &[&str]) -> Run {
    handeye(folder, &[&["verify", "result", file, "--json", "--quiet"], more].concat())
}

#[test]
fn touches_pass_or_fail_for_the_tolerance_of_the_user() {
    let folder = calibrated();
    folder.put("near.csv", &touches(&folder, 0.3));
    folder.put("far.csv", &touches(&folder, 4.0));
    folder.put("nan.csv", &touches(&folder, 0.3).replacen("t1,", "t1,nan", 1));
    for (file, tolerance, code) in [("near.csv", "2", 0), ("far.csv", "2", 3), ("far.csv", "5", 0)]
    {
        let run = verify(&folder, file, &["--tolerance-mm", tolerance, "--out", "report"]);
        let found = run.json();
        assert_eq!(run.code, code, "{file} {tolerance}: {found}");
        assert_eq!(found["touches"].as_array().unwrap().len(), 8);
        assert!(folder.read("report/verify.html").contains("</html>"));
    }
    assert_eq!(verify(&folder, "near.csv", &[]).code, 0);
    let disagrees = verify(&folder, "far.csv", &[]);
    assert_eq!(disagrees.code, 3, "4 mm beside what is stated: {}", disagrees.stdout);
    for file in ["nan.csv", "none.csv"] {
        let run = verify(&folder, file, &[]);
        assert_eq!(run.code, 1, "{}", run.stdout);
        assert!(run.json()["error"]["message"].to_string().contains(file));
    }
    assert_eq!(verify(&folder, "near.csv", &["--tolerance-mm", "-1"]).code, 2);
}

#[test]
fn bad_touches_are_named_with_their_line() {
    let folder = calibrated();
    for far in ["1e300", "-4e11"] {
        let text =
            touches(&folder, 0.1).replacen("\nt3,", &format!("\nt3,{far},0,1,0,0,0\nt3,"), 1);
        folder.put("far.csv", &text);
        let run = verify(&folder, "far.csv", &[]);
        let error = run.json()["error"].clone();
        assert_eq!((run.code, &error["line"]), (1, &5.into()), "{error}");
        assert!(error["message"].to_string().contains("camera_x"), "{error}");
    }
}

/// Copied lines would narrow the bounds.
#[test]
fn touches_that_repeat_one_another_count_once() {
    let folder = calibrated();
    let text = touches(&folder, 0.1);
    folder.put("once.csv", &text);
    let t3 = text.lines().nth(4).unwrap().to_owned();
    folder.put("twice.csv", &format!("{text}{t3}\n{}\n", t3.replacen("t3,", "t9,", 1)));
    let (once, twice) =
        (verify(&folder, "once.csv", &[]).json(), verify(&folder, "twice.csv", &[]).json());
    for key in ["touches", "residual", "agreement"] {
        assert_eq!(once[key], twice[key], "{key}");
    }
    let warning =
        |k: usize| (twice["warnings"][k]["code"].clone(), twice["warnings"][k].to_string());
    assert_eq!((warning(0).0, warning(1).0), ("touch-repeated".into(), "touch-repeated".into()));
    assert!(warning(1).1.contains("touch t9 repeats touch t3"), "{}", warning(1).1);
    folder.put("names.csv", &text.replacen("t4,", "t3,", 1));
    let names = verify(&folder, "names.csv", &[]).json();
    assert_eq!(names["warnings"][0]["code"], "touch-name-repeated", "{names}");
    assert_eq!(names["touches"].as_array().unwrap().len(), 8);
}

#[test]
fn a_calibration_that_is_rejected_does_not_pass_by_its_touches() {
    let folder = calibrated();
    folder.put("near.csv", &touches(&folder, 0.0));
    let text = folder.read("result/calibration.json");
    let rejected = text.replacen("\"accepted\"", "\"rejected\"", 1);
    assert_ne!(text, rejected);
    folder.put("result/calibration.json", &rejected);
    for more in [&["--out", "report"][..], &["--tolerance-mm", "5"]] {
        let run = verify(&folder, "near.csv", more);
        let found = run.json();
        assert_eq!((run.code, &found["verdict"]), (3, &"undetermined".into()), "{found}");
        let reason = found["reasons"][0].to_string();
        assert!(reason.contains("own verdict is rejected"), "{found}");
        assert_eq!(found["warnings"][0]["code"], "calibration-not-accepted", "{found}");
    }
    let page = folder.read("report/verify.html");
    assert!(page.contains("own verdict is rejected"), "the report says so");
}

/// A cell that was simulated with these options, small enough to be quick; whether squares are declared 2 % too small.
fn small_cell(options: &[&str], is_wrong: bool) -> Folder {
    let folder = Folder::new();
    let usual =
        ["simulate", "cell", "--quiet", "--touches", "0", "--captures", "10", "--seed", "41"];
    let small = ["--width", "640", "--height", "400"];
    let made = handeye(&folder, &[&usual[..], &small[..], options].concat());
    assert_eq!(made.code, 0, "{}", made.stderr);
    if is_wrong {
        let manifest = folder.read("cell/handeye.toml");
        folder.put("cell/handeye.toml", &manifest.replace("square_mm = 30.0", "square_mm = 29.4"));
    }
    folder
}

#[test]
fn what_changes_an_answer_is_found_with_scans_too() {
    let codes = |folder: &Folder| {
        let run = check(folder, &[]);
        let found = run.json();
        let all = found["explanations"].as_array().unwrap();
        let codes: Vec<String> =
            all.iter().map(|e| e["code"].as_str().unwrap().to_owned()).collect();
        (run.code, codes)
    };
    let scans = ["--scans", "--scan-scale", "0.5"];
    assert_eq!(codes(&small_cell(&scans, false)), (0, vec![]));
    let (code, wrong_size) = codes(&small_cell(&scans, true));
    assert!(
        code == 3 && wrong_size.iter().any(|c| c.contains("size") || c == "target-scale"),
        "{wrong_size:?}"
    );
    let (code, shifted) =
        codes(&small_cell(&[&scans[..], &["--scan-shift-mm", "8"]].concat(), false));
    assert!(code == 3 && shifted.contains(&"picture-and-scan-disagree".to_owned()), "{shifted:?}");
}

#[test]
fn a_bent_board_is_found() {
    let folder = small_cell(&["--no-images", "--bow-mm", "4"], false);
    let run = check(&folder, &[]);
    let found = run.json();
    let all = found["explanations"].as_array().unwrap();
    assert!(run.code == 3 && all.iter().any(|e| e["code"] == "board-bent"), "{found}");
}
