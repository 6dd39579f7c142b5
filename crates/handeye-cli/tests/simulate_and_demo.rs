//! The commands that need no data of the user.

#![allow(clippy::unwrap_used, reason = "a test fails loudly")]

use std::{fs, path::PathBuf, process::Command};

use serde_json::Value;

/// Exit code, standard output and standard error.
fn handeye(arguments: &[&str]) -> (i32, String, String) {
    let out = Command::new(env!("CARGO_BIN_EXE_handeye")).args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (out.status.code().unwrap(), text(out.stdout), text(out.stderr))
}

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("handeye-cli-{name}-{}", std::process::id()));
    fs::remove_dir_all(&folder).ok();
    folder
}

#[test]
fn the_demo_finds_the_truth_and_says_so() {
    let out = folder("demo");
    let (code, json, _) = handeye(&["demo", "--json", "--out", out.to_str().unwrap()]);
    let told: Value = serde_json::from_str(&json).unwrap();
    assert_eq!((code, &told["verdict"]), (0, &Value::from("accepted")));
    assert!(told["off"]["translation_mm"].as_f64().unwrap() < 0.5, "{}", told["off"]);
    assert!(out.join("report.html").is_file() && out.join("calibration.json").is_file());
    let (_, text, _) = handeye(&["demo", "--out", out.to_str().unwrap()]);
    assert!(text.contains("the truth is known here: off by 0."), "{text}");
    fs::remove_dir_all(out).unwrap();
}

#[test]
fn a_simulation_does_not_overwrite_what_is_not_its_own() {
    let out = folder("foreign");
    fs::create_dir_all(&out).unwrap();
    fs::write(out.join("mine.txt"), "keep").unwrap();
    let name = out.to_str().unwrap();
    let (code, _, said) = handeye(&["simulate", name, "--no-images"]);
    assert!(code == 1 && said.contains("not the output of an earlier simulation"), "{said}");
    assert_eq!(handeye(&["simulate", name, "--no-images", "--force"]).0, 0);
    assert_eq!(handeye(&["simulate", name, "--no-images", "--captures", "9"]).0, 0);
    assert_eq!(fs::read_dir(out.join("corners")).unwrap().count(), 9);
    let (code, json, _) = handeye(&["calibrate", name, "--json"]);
    let told: Value = serde_json::from_str(&json).unwrap();
    assert_eq!((code, &told["verdict"]), (0, &Value::from("accepted")));
    assert!(out.join("mine.txt").exists());
    fs::remove_dir_all(out).unwrap();
}

#[test]
fn impossible_cells_are_refused_with_a_reason() {
    let out = folder("impossible");
    let name = out.to_str().unwrap();
    for wrong in [
        &["--width", "64", "--height", "48", "--focal-px", "1800"][..],
        &["--captures", "0"],
        &["--robot-mm", "-1"],
        &["--checkerboard", "9"],
        &["--dictionary", "DICT_1X1"],
    ] {
        let all: Vec<&str> = ["simulate", name].iter().chain(wrong).copied().collect();
        let (code, _, said) = handeye(&all);
        assert!(code == 2 && said.starts_with("error: "), "{wrong:?}: {code} {said}");
        assert!(!out.exists(), "{wrong:?}");
    }
}
