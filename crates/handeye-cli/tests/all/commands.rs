//! What the commands promise: exit codes, help with examples, one JSON document, whole files.

use std::fs::OpenOptions;

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use serde_json::{Value, json};

use crate::folder::{Folder, command, handeye};

fn pose(rotation: [f64; 3], translation: [f64; 3]) -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(rotation));
    Isometry3::from_parts(Translation3::from(Vector3::from(translation)), rotation)
}

fn stored(pose: &Isometry3<f64>) -> Value {
    let (t, q) = (pose.translation.vector, pose.rotation.coords);
    json!({ "translation_m": [t.x, t.y, t.z], "rotation_xyzw": [q.x, q.y, q.z, q.w] })
}

/// Fifteen pairs of a camera on a flange, a tenth of a millimetre and a few hundredths of a degree off;
/// `shift` moves the noise.
fn pairs(setup: &str, shift: f64) -> String {
    let flange_from_camera = pose([0.1, -0.2, 1.5], [0.03, -0.06, 0.09]);
    let base_from_target = pose([0.1, 3.0, 0.1], [0.6, 0.1, 0.02]);
    let one = |k: usize| {
        let wave = |n: f64| (k as f64 * n + 0.3 * n * n).sin();
        let noise = |n: f64| (k as f64 * 12.9898 * n + 78.233 * n + shift).sin();
        let base_from_flange = pose(
            [0.2 + 0.6 * wave(1.1), 2.9 + 0.5 * wave(2.3), 0.7 * wave(3.7)],
            [0.5 + 0.2 * wave(1.7), 0.2 * wave(2.9), 0.5 + 0.1 * wave(4.3)],
        );
        let error = pose(
            [3e-4 * noise(1.0), 3e-4 * noise(2.0), 3e-4 * noise(3.0)],
            [1e-4 * noise(4.0), 1e-4 * noise(5.0), 1e-4 * noise(6.0)],
        );
        let camera_from_target =
            (base_from_flange * flange_from_camera).inverse() * base_from_target * error;
        json!({
            "base_from_flange": stored(&base_from_flange),
            "camera_from_target": stored(&camera_from_target)
        })
    };
    let pairs: Vec<Value> = (0..15).map(one).collect();
    json!({ "setup": setup, "pairs": pairs }).to_string()
}

/// A calibration.json of that name.
fn solved(folder: &Folder, name: &str, shift: f64) -> Value {
    folder.put("pairs.json", &pairs("eye-in-hand", shift));
    let run = handeye(folder, &["solve", "pairs.json", "--json", "--quiet"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    folder.put(name, &run.stdout);
    run.json()
}

#[test]
fn broken_pairs_are_refused() {
    let folder = Folder::new();
    let pose = r#"{"translation_m": [0, 0, 1], "rotation_xyzw": [0, 0, 0, 1]}"#;
    let with = |id: &str, robot: &str| {
        format!(r#"{{"id": "{id}", "base_from_flange": {robot}, "camera_from_target": {pose}}}"#)
    };
    let good = with("01", pose);
    let file =
        |pairs: &[&str]| format!(r#"{{"setup": "eye-in-hand", "pairs": [{}]}}"#, pairs.join(", "));
    let swapped = with("02", &pose.replace("0, 0, 0, 1", "1, 0, 0, 1"));
    let zero = with("02", &pose.replace("0, 0, 0, 1", "0, 0, 0, 0"));
    let inverse = with("02", &pose.replace('{', r#"{"to": "flange", "from": "base", "#));
    for (content, message) in [
        (file(&[&good, &good]), r#"p.json: pair 2: the id "01" is there twice"#),
        (
            file(&[&good, &zero]),
            r#"p.json:1: pair 2 ("02"): rotation_xyzw has length 0, not 1: is it a quaternion? (column "#,
        ),
        (file(&[&good, &swapped]), r#"p.json:1: pair 2 ("02"): rotation_xyzw has length 1.414"#),
        (
            file(&[&good, &inverse]),
            r#"p.json:1: pair 2 ("02"): expected base_from_flange, found flange_from_base"#,
        ),
        (file(&[&good]).replace("in-hand", "on-hand"), "p.json:1: unknown variant `eye-on-hand`"),
        (file(&[&good]).replace("1]", "NaN]"), "p.json:1: expected value"),
        ("{".into(), "p.json:1: EOF while parsing"),
        ("[]".into(), "p.json: the file must hold one JSON object"),
    ] {
        folder.put("p.json", &content);
        let run = handeye(&folder, &["solve", "p.json", "--json"]);
        assert_eq!(run.code, 1, "{content}: {}", run.stderr);
        assert!(run.error().starts_with(message), "{}", run.stderr);
        let error = &run.json()["error"];
        assert_eq!((&error["message"], &error["file"]), (&run.error().into(), &"p.json".into()));
    }
}

const COMMANDS: [&str; 10] = [
    "calibrate",
    "solve",
    "export",
    "init",
    "target",
    "compare",
    "detect",
    "simulate",
    "demo",
    "completions",
];

#[test]
fn the_first_name_of_compare_still_works() {
    let folder = Folder::new();
    let by_both = ["compare", "repeat"].map(|name| handeye(&folder, &[name, "--help"]).stdout);
    assert_eq!(by_both[0], by_both[1]);
}

#[test]
fn the_help_of_every_command_has_an_example_and_fits_the_screen() {
    let folder = Folder::new();
    for name in COMMANDS {
        let run = handeye(&folder, &[name, "--help"]);
        assert_eq!(run.code, 0, "{name}");
        let wide: Vec<&str> = run.stdout.lines().filter(|l| l.chars().count() > 80).collect();
        assert!(wide.is_empty(), "{name}: {wide:?}");
        let example = format!("  handeye {name} ");
        assert!(run.stdout.contains("Example") && run.stdout.contains(&example), "{name}");
        assert!(run.stdout.contains("--json") && run.stdout.contains("--quiet"), "{name}");
    }
}

#[test]
fn a_wrong_command_line_is_exit_code_two() {
    let folder = Folder::new();
    folder.put("c.json", "{}");
    for args in [
        &["calibrte"][..],
        &[],
        &["calibrate"],
        &["calibrate", ".", "--icp-epsilon", "-1"],
        &["solve", "pairs.json", "--method", "magic"],
        &["export", "c.json"],
        &["export", "c.json", "--format", "word"],
        &["export", "--format", "kuka"],
        &["repeat", "c.json"],
        &["detect", "--target", "t.toml"],
        &["target", "--out", "board.pdf"],
        &["target", "--checkerboard", "9x6", "--out", "board.pdf"],
        &["target", "--checkerboard", "9", "--square-mm", "20", "--out", "board.pdf"],
        &["target", "--checkerboard", "9x6", "--square-mm", "20", "--out", "board.png"],
        &["target", "--checkerboard", "9x1", "--square-mm", "20", "--out", "board.pdf"],
        &["target", "--checkerboard", "9x6", "--square-mm", "20", "--out", "b.pdf", "--paper", "b"],
    ] {
        let run = handeye(&folder, args);
        assert_eq!(run.code, 2, "{args:?}: {}", run.stderr);
        assert!(run.stdout.is_empty() && !run.stderr.is_empty(), "{args:?}");
    }
    assert_eq!(folder.list("."), ["c.json"]);
}

#[test]
fn every_published_method_runs_by_the_name_the_help_gives() {
    let folder = Folder::new();
    solved(&folder, "a.json", 0.0);
    let help = handeye(&folder, &["solve", "--help"]).stdout;
    for method in handeye::Method::ALL {
        let name = method.name();
        assert!(help.split([' ', ',', ':', ';', '.', '\n']).any(|word| word == name), "{name}");
        let run = handeye(&folder, &["solve", "pairs.json", "--method", name, "--json"]);
        let result: Value = serde_json::from_str(&run.stdout).expect(name);
        assert_eq!(result["method"], format!("closed-form-{name}"), "{}", run.stderr);
    }
}

#[test]
fn json_is_one_document_and_quiet_is_quiet() {
    let folder = Folder::new();
    solved(&folder, "a.json", 0.0);
    solved(&folder, "b.json", 1.0);
    folder.put("dark.png", "@png 320x240");
    for (args, code) in [
        (&["solve", "pairs.json"][..], 0),
        (&["export", "a.json", "--format", "kuka,urdf"], 0),
        (&["export", "a.json", "--format", "npy", "--out", "exports"], 0),
        (&["export", "--format", "list"], 0),
        (&["repeat", "a.json", "b.json"], 0),
        (&["target", "--checkerboard", "9x6", "--square-mm", "20", "--out", "board.pdf"], 0),
        (&["detect", "dark.png", "--target", "board.toml"], 3),
        (&["init", "."], 0),
    ] {
        let args: Vec<&str> = args.iter().copied().chain(["--json", "--quiet"]).collect();
        let run = handeye(&folder, &args);
        assert_eq!(run.code, code, "{args:?}: {}{}", run.stdout, run.stderr);
        assert!(run.json().is_object(), "{args:?}");
        assert!(run.stderr.is_empty(), "{args:?}: {}", run.stderr);
    }
}

#[test]
fn a_result_is_exported_where_it_is_wanted() {
    let folder = Folder::new();
    solved(&folder, "a.json", 0.0);
    let run = handeye(&folder, &["export", "a.json", "--format", "matrix4x4"]);
    assert_eq!((run.code, run.stdout.lines().count()), (0, 4), "{}", run.stdout);
    let run = handeye(&folder, &["export", "a.json", "--format", "npy"]);
    assert_eq!(run.code, 2, "no binary on a terminal");
    let run = handeye(&folder, &["export", "a.json", "--format", "urdf,zivid-yaml", "--out", "o"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(
        folder.list("o"),
        ["flange_from_camera.urdf.xacro", "flange_from_camera_zivid.yaml"]
    );
    let args = ["export", "a.json", "--format", "urdf", "--out", "x.urdf", "--parent", "tool0"];
    assert_eq!(handeye(&folder, &args).code, 0);
    assert!(folder.read("x.urdf").contains("tool0"));
}

#[test]
fn a_result_that_is_not_accepted_is_exported_only_by_force() {
    let folder = Folder::new();
    let mut result = solved(&folder, "a.json", 0.0);
    result["verdict"] = "rejected".into();
    folder.put("bad.json", &result.to_string());
    let run = handeye(&folder, &["export", "bad.json", "--format", "kuka", "--out", "o"]);
    assert_eq!(run.code, 1);
    assert!(run.error().starts_with("bad.json: the verdict is rejected ("), "{}", run.stderr);
    assert!(run.error().ends_with("to export it all the same: --force"), "{}", run.stderr);
    assert!(folder.list("o").is_empty());
    let run = handeye(&folder, &["export", "bad.json", "--format", "kuka", "--force"]);
    assert_eq!(run.code, 0);
    assert!(run.stderr.starts_with("warning [not-accepted]: bad.json:"), "{}", run.stderr);

    result["verdict"] = "undetermined".into();
    result["hand_eye"]["mount_from_camera"] = Value::Null;
    folder.put("none.json", &result.to_string());
    let run = handeye(&folder, &["export", "none.json", "--format", "kuka", "--force", "-q"]);
    assert_eq!(run.code, 1);
    assert!(
        run.error().starts_with("none.json: there is no transform to export; "),
        "{}",
        run.stderr
    );
}

#[test]
fn the_program_gives_its_name_and_version() {
    let run = handeye(&Folder::new(), &["--version"]);
    assert_eq!((run.code, run.stdout), (0, format!("handeye {}\n", env!("CARGO_PKG_VERSION"))));
}

#[test]
fn a_first_manifest_says_what_it_waits_for() {
    let folder = Folder::new();
    folder.put("cell/img_1.png", "@png 8x8");
    folder.put("cell/robot.csv", "x,y,z,qx,qy,qz,qw\n0.1,0.2,0.3,0,0,0,1\n");
    assert_eq!(handeye(&folder, &["init", "cell"]).code, 0);
    let asked: Vec<String> = (1..)
        .zip(folder.read("cell/handeye.toml").lines())
        .filter(|(_, line)| line.starts_with("# QUESTION: "))
        .map(|(number, _): (usize, _)| number.to_string())
        .collect();
    assert!(asked.len() > 1);
    let open = format!("QUESTIONs are open in lines {}: ", asked.join(", "));
    for command in ["calibrate", "check"] {
        let run = handeye(&folder, &[command, "cell"]);
        assert_eq!(run.code, 1);
        let error = run.error();
        assert!(error.starts_with("cell/handeye.toml:"), "{error}");
        assert!(error.contains("the target's kind is missing; write kind = "), "{error}");
        assert!(error.contains(&open), "{error}");
    }
}

#[test]
fn a_manifest_is_never_written_over_by_accident() {
    let folder = Folder::new();
    folder.put("cell/img_1.png", "@png 8x8");
    let run = handeye(&folder, &["init", "cell"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("does the robot carry the camera"), "{}", run.stdout);
    let run = handeye(&folder, &["init", "cell"]);
    assert_eq!(run.code, 1);
    assert_eq!(run.error(), "cell/handeye.toml: is there already; to write over it: --force");
    assert_eq!(handeye(&folder, &["init", "cell", "--force"]).code, 0);
    assert_eq!(handeye(&folder, &["init", "nowhere"]).code, 1);
}

#[test]
fn results_agree_until_one_is_moved() {
    let folder = Folder::new();
    solved(&folder, "a.json", 0.0);
    let mut moved = solved(&folder, "b.json", 1.0);
    let run = handeye(&folder, &["repeat", "a.json", "b.json"]);
    assert_eq!(run.code, 0, "{}", run.stdout);
    assert!(run.stdout.lines().all(|line| line.chars().count() <= 80), "{}", run.stdout);

    let x = &mut moved["hand_eye"]["mount_from_camera"]["translation_m"][0];
    *x = (x.as_f64().unwrap() + 0.01).into();
    folder.put("moved.json", &moved.to_string());
    let run = handeye(&folder, &["repeat", "a.json", "moved.json", "--json"]);
    assert_eq!(run.code, 3);
    assert_eq!(run.json()["agree"], Value::Bool(false));
    let apart = run.json()["pairs"][0]["camera_origin_mm"].as_f64().unwrap();
    assert!((apart - 10.0).abs() < 1.0, "{apart}");

    moved["hand_eye"]["covariance"]["mount_from_camera"] = Value::Null;
    folder.put("unsure.json", &moved.to_string());
    let run = handeye(&folder, &["repeat", "a.json", "unsure.json", "--json"]);
    assert_eq!((run.code, &run.json()["agree"]), (3, &Value::Null));
}

#[test]
fn the_odd_one_out_is_named_and_the_combined_result_is_a_result() {
    let folder = Folder::new();
    for (name, shift) in [("a.json", 0.0), ("b.json", 1.0), ("c.json", 2.0)] {
        solved(&folder, name, shift);
    }
    let mut moved = solved(&folder, "d.json", 3.0);
    let x = &mut moved["hand_eye"]["mount_from_camera"]["translation_m"][0];
    *x = (x.as_f64().unwrap() + 0.01).into();
    folder.put("d.json", &moved.to_string());
    let all = ["a.json", "b.json", "c.json", "d.json"];
    let run = handeye(&folder, &[&["compare"][..], &all, &["--json"]].concat());
    assert_eq!((run.code, &run.json()["odd_one_out"]), (3, &Value::from("d.json")));
    let printed = handeye(&folder, &[&["compare"][..], &all].concat());
    assert!(printed.stdout.contains("DISAGREE  d.json is the odd one out"), "{}", printed.stdout);
    let args = [&["compare"][..], &all[..3], &["--out", "combined.json", "--json"]].concat();
    let run = handeye(&folder, &args);
    assert_eq!((run.code, &run.json()["odd_one_out"]), (0, &Value::Null));
    // with its covariance, it is compared as any other result
    let again = handeye(&folder, &["compare", "combined.json", "a.json", "--json"]);
    assert_eq!((again.code, &again.json()["agree"]), (0, &Value::Bool(true)));
    assert!(again.json()["test"]["p_value"].as_f64().unwrap() > 0.01);
    let alone = handeye(&folder, &["compare", "a.json"]);
    assert_eq!(alone.code, 2);
    assert!(
        alone.stderr.contains("a.json: is one result: name another one, or"),
        "{}",
        alone.stderr
    );
}

#[test]
fn halves_of_one_dataset_are_compared() {
    let folder = Folder::new();
    let args = ["simulate", "cell", "--captures", "24", "--no-images", "--seed", "2", "--quiet"];
    assert_eq!(handeye(&folder, &args).code, 0);
    let run = handeye(&folder, &["compare", "cell", "--json"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let found = run.json();
    let ways: Vec<&str> =
        (0..3).map(|k| found["halves"][k]["division"].as_str().unwrap()).collect();
    assert_eq!(ways, ["alternating", "by-place", "in-time"]);
    assert_eq!(found["captures"], 24);
    let run = handeye(&folder, &["compare", "cell"]);
    assert!(run.stdout.contains("AGREE  halves of the captures"), "{}", run.stdout);
    assert!(run.stdout.lines().all(|line| line.chars().count() <= 80), "{}", run.stdout);
    let run = handeye(&folder, &["compare", "cell", "--out", "x.json"]);
    assert_eq!(run.code, 2, "{}", run.stderr);
}

#[test]
fn results_that_cannot_be_compared_are_refused() {
    let folder = Folder::new();
    let mut result = solved(&folder, "a.json", 0.0);
    result["setup"] = "eye-to-hand".into();
    result["name"] = "base_from_camera".into();
    folder.put("other.json", &result.to_string());
    folder.put("no.json", "{}");
    for (other, message) in [
        (
            "other.json",
            "other.json: is base_from_camera, but a.json is flange_from_camera; compare results of one cell",
        ),
        ("./a.json", "./a.json: is named twice; a result agrees with itself, which tells nothing"),
        ("no.json", "no.json:1: is no calibration.json of handeye: missing field"),
        ("none.json", "none.json: does not exist; check the name"),
    ] {
        let run = handeye(&folder, &["repeat", "a.json", other]);
        assert_eq!(run.code, 1, "{other}");
        assert!(run.error().starts_with(message), "{}", run.stderr);
    }
}

#[test]
fn a_target_is_drawn_with_its_description() {
    let folder = Folder::new();
    let board = ["target", "--checkerboard", "9x6", "--square-mm", "20"];
    for out in ["b.pdf", "b.svg"] {
        let args: Vec<&str> = board.iter().copied().chain(["--out", out]).collect();
        let run = handeye(&folder, &args);
        assert_eq!(run.code, 0, "{}", run.stderr);
    }
    assert_eq!(folder.list("."), ["b.pdf", "b.svg", "b.toml"]);
    let same = handeye(&folder, &["target", "b.toml", "--out", "b.pdf", "--paper", "a3"]);
    assert_eq!(same.code, 0, "{}", same.stderr);
    let args = ["target", "--checkerboard", "8x6", "--square-mm", "20", "--out", "b.pdf"];
    let run = handeye(&folder, &args);
    assert_eq!(run.code, 1);
    assert!(run.error().starts_with("b.toml: is there already and describes another target;"));
    let args = ["target", "--checkerboard", "9x6", "--square-mm", "40", "--out", "large.pdf"];
    let run = handeye(&folder, &args);
    assert_eq!(run.code, 1);
    assert!(run.error().ends_with("more than a4 has; a2 fits"), "{}", run.stderr);
    assert!(!folder.list(".").contains(&"large.pdf".to_string()));
}

/// A drawn 9 x 6 board, seen straight on.
fn board(folder: &Folder, name: &str) {
    let square = 40;
    let picture = image::GrayImage::from_fn(560, 440, |x, y| {
        let inside = (80..480).contains(&x) && (80..360).contains(&y);
        let black = ((x as i32 - 80) / square + (y as i32 - 80) / square) % 2 == 0;
        image::Luma([if inside && black { 30 } else { 220 }])
    });
    image::imageops::blur(&picture, 0.8).save(folder.0.join(name)).unwrap();
}

#[test]
fn corners_are_found_in_the_order_of_the_pictures() {
    let folder = Folder::new();
    board(&folder, "board.png");
    folder.put("dark.png", "@png 320x240");
    folder.put("board.toml", "kind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n");
    let args =
        ["detect", "dark.png", "board.png", "--target", "board.toml", "--json", "--draw", "d"];
    let run = handeye(&folder, &args);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let images = &run.json()["images"];
    assert_eq!(images[0]["path"], "dark.png");
    assert_eq!(images[0]["found"], Value::Bool(false));
    assert_eq!(images[0]["reason"], "no corners at all");
    let corners = images[1]["corners"].as_array().unwrap();
    assert_eq!(corners.len(), 54);
    let first = &corners[0];
    assert_eq!(first["id"], 0);
    for key in ["x_px", "y_px"] {
        assert!((first[key].as_f64().unwrap() - 119.5).abs() < 0.1, "{first}");
    }
    assert!(first["covariance_px2"][1][1].as_f64().unwrap() > 0.0);
    assert_eq!(folder.list("d"), ["board_corners.png", "dark_corners.png"]);
    assert!(images[0]["residual_rms_px"].is_null());
    assert!(images[1]["residual_rms_px"].as_f64().unwrap() < 0.1);
}

#[test]
fn several_targets_are_told_by_their_names() {
    let folder = Folder::new();
    board(&folder, "board.png");
    folder.put(
        "boards.toml",
        "[[target]]\nname = \"tag\"\nkind = \"tag\"\ndictionary = \"DICT_4X4_50\"\nid = 3\n\
         size_mm = 40\n[[target]]\nname = \"board\"\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\n\
         square_mm = 20.0\n",
    );
    let args = ["detect", "board.png", "--target", "boards.toml"];
    let run = handeye(&folder, &args);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("- tag: no tag 3 of DICT_4X4_50"), "{}", run.stdout);
    assert!(run.stdout.contains("targets found in 1 images: tag 0, board 1"), "{}", run.stdout);
    let json = [&args[..], &["--json", "--draw", "d"]].concat();
    let image = &handeye(&folder, &json).json()["images"][0];
    let targets = &image["targets"];
    assert_eq!((&targets[0]["name"], &targets[0]["found"]), (&"tag".into(), &false.into()));
    assert_eq!((&targets[1]["name"], &targets[1]["corners"]), (&"board".into(), &54.into()));
    let corners = image["corners"].as_array().unwrap();
    assert!(corners.len() == 54 && corners.iter().all(|c| c["target"] == "board"));
    assert_eq!(folder.list("d"), ["board_corners.png"]);
}

#[test]
fn corners_are_found_with_the_camera_that_is_given() {
    let folder = Folder::new();
    board(&folder, "board.png");
    folder.put("board.toml", "kind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n");
    let size = image::image_dimensions(folder.0.join("board.png")).unwrap();
    let camera = |width: u32| {
        format!(
            "image_width: {width}\nimage_height: {}\ncamera_matrix:\n  rows: 3\n  cols: 3\n  \
             data: [500, 0, 320, 0, 500, 240, 0, 0, 1]\ndistortion_model: plumb_bob\n\
             distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0, 0, 0, 0, 0]\n",
            size.1
        )
    };
    folder.put("camera.yaml", &camera(size.0));
    folder.put("other.yaml", &camera(size.0 + 100));
    let detect = |camera: &str| {
        let args = ["detect", "board.png", "--target", "board.toml", "--camera", camera];
        handeye(&folder, &args)
    };
    let run = detect("camera.yaml");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("54 of 54 corners  rms 0.0"), "{}", run.stdout);
    let run = detect("other.yaml");
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("give intrinsics for this size"), "{}", run.stderr);
    assert_eq!(detect("none.yaml").code, 1);
}

#[test]
fn a_file_that_is_no_picture_leaves_the_corners_of_the_others() {
    let folder = Folder::new();
    board(&folder, "board.png");
    folder.put("board.toml", "kind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n");
    folder.put("text.png", "not an image");
    let args = ["detect", "board.png", "text.png", "--target", "board.toml", "--json"];
    let run = handeye(&folder, &args);
    assert_eq!(run.code, 1);
    let message = "text.png: is not an image; PNG, JPEG, TIFF and BMP can be read";
    assert_eq!(run.error(), message);
    let answer = run.json();
    assert_eq!(answer["images"][0]["corners"].as_array().unwrap().len(), 54);
    let bad = json!({"path": "text.png", "found": false, "error": message, "corners": []});
    assert_eq!(answer["images"][1], bad);
    assert_eq!(answer["error"]["file"], "text.png");
}

#[test]
fn an_end_without_an_answer_is_one_document_of_the_published_schema() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../handeye-io/schema/error.schema.json");
    let schema: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let known = &schema["properties"]["error"]["properties"];
    let folder = Folder::new();
    folder.put("cell/handeye.toml", "setup = 1\n");
    folder.put("bad.json", "{");
    for (args, code, line) in [
        (&["calibrate", "cell"][..], 1, Some(1)),
        (&["calibrate", "nowhere"], 1, None),
        (&["solve", "bad.json"], 1, Some(1)),
        (&["solve", "none.json"], 1, None),
        (&["export", "bad.json", "--format", "kuka"], 1, Some(1)),
        (&["repeat", "bad.json", "none.json"], 1, Some(1)),
        (&["detect", "a.png", "--target", "none.toml"], 1, None),
        (&["target", "cell/handeye.toml", "--out", "b.pdf"], 1, None),
        (&["init", "nowhere"], 1, None),
        (&["simulate", "cell"], 1, None),
        (&["demo", "--out", "bad.json"], 1, None),
        (&["calibrate"], 2, None),
        (&["solve", "bad.json", "--method", "magic"], 2, None),
    ] {
        let args: Vec<&str> = args.iter().copied().chain(["--json"]).collect();
        let run = handeye(&folder, &args);
        assert_eq!(run.code, code, "{args:?}: {}", run.stderr);
        assert!(run.stderr.starts_with("error: "), "{args:?}: {}", run.stderr);
        let document = run.json();
        let error = document["error"].as_object().unwrap();
        assert!(error.keys().all(|key| known.get(key).is_some()), "{args:?}: {document}");
        let codes = known["code"]["enum"].as_array().unwrap();
        assert!(codes.contains(&error["code"]), "{args:?}: {document}");
        assert!(error["message"].as_str().is_some_and(|m| !m.is_empty()), "{args:?}");
        if line.is_some() {
            assert_eq!(error.get("line").and_then(Value::as_u64), line, "{args:?}: {document}");
        }
        assert_eq!(error.contains_key("file"), code == 1, "{args:?}: {document}");
    }
}

#[test]
fn a_picture_that_cannot_be_read_is_named_with_its_capture() {
    let folder = Folder::new();
    let args = ["simulate", "cell", "--width", "480", "--height", "320", "--captures", "3"];
    assert_eq!(handeye(&folder, &args).code, 0);
    folder.put("cell/images/002.png", "no image any more");
    let run = handeye(&folder, &["calibrate", "cell", "--json"]);
    assert_eq!(run.code, 1);
    let error = &run.json()["error"];
    assert_eq!((&error["capture"], &error["file"]), (&"002".into(), &"cell/images/002.png".into()));
}

#[test]
fn several_formats_do_not_make_a_folder_called_like_a_file() {
    let folder = Folder::new();
    solved(&folder, "a.json", 0.0);
    let run = handeye(&folder, &["export", "a.json", "--format", "urdf,kuka", "--out", "x.txt"]);
    assert_eq!(run.code, 2);
    assert!(run.error().starts_with("--out x.txt: 2 formats do not fit into one file"));
    assert!(!folder.0.join("x.txt").exists());
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_behind_standard_output_is_an_error_and_no_panic() {
    let folder = Folder::new();
    solved(&folder, "a.json", 0.0);
    for args in [
        &["export", "a.json", "--format", "kuka"][..],
        &["export", "--format", "list", "--json"],
        &["solve", "pairs.json", "--json"],
        &["completions", "bash"],
    ] {
        let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = command(&folder, args).stdout(full).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{args:?}: {stderr}");
        assert!(stderr.contains("error: standard output: "), "{args:?}: {stderr}");
        assert!(!stderr.contains("panicked"), "{args:?}: {stderr}");
    }
}

/// `handeye calibrate cell 2>&1 | head -1`: a reader that goes away early is no crash.
#[test]
#[cfg(unix)]
fn a_reader_of_the_messages_may_go_away() {
    let missing = std::env::temp_dir().join("handeye-there-is-no-such-folder");
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let status = std::process::Command::new(env!("CARGO_BIN_EXE_handeye"))
        .arg("calibrate")
        .arg(missing)
        .stdout(std::process::Stdio::null())
        .stderr(writer)
        .status()
        .unwrap();
    assert_eq!(status.code(), Some(1), "{status}");
}
