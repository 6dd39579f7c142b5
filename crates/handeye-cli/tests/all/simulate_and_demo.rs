//! The commands that need no data of the user.

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
    assert!(out.join("calibration.json").is_file());
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert_eq!(told["method"], "joint-by-place");
    assert!(page.contains("Errors of the robot that depend on its pose"), "{page}");
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
    assert!(
        code == 1 && said.contains("mine.txt: was not written by `simulate`, or was edited since"),
        "{said}"
    );
    assert_eq!(handeye(&["simulate", name, "--no-images", "--force"]).0, 0);
    let fewer = ["simulate", name, "--no-images", "--captures", "9", "--force"];
    assert_eq!(handeye(&fewer).0, 0);
    assert_eq!(fs::read_dir(out.join("corners")).unwrap().count(), 9);
    let (code, json, _) = handeye(&["calibrate", name, "--json"]);
    let told: Value = serde_json::from_str(&json).unwrap();
    assert_eq!((code, &told["verdict"]), (0, &Value::from("accepted")));
    assert!(out.join("mine.txt").exists());
    fs::remove_dir_all(out).unwrap();
}

#[test]
fn an_edited_manifest_is_not_lost_to_another_simulation() {
    let out = folder("edited");
    let name = out.to_str().unwrap();
    assert_eq!(handeye(&["simulate", name, "--no-images"]).0, 0);
    assert_eq!(handeye(&["simulate", name, "--no-images"]).0, 0, "its own folder");
    fs::write(out.join("handeye.toml"), "# mine").unwrap();
    let (code, _, said) = handeye(&["simulate", name, "--no-images"]);
    assert!(code == 1 && said.contains("handeye.toml: was not written"), "{said}");
    assert_eq!(fs::read_to_string(out.join("handeye.toml")).unwrap(), "# mine");
    fs::remove_dir_all(out).unwrap();
}

#[test]
fn init_finds_everything_that_a_simulation_wrote() {
    let out = folder("init");
    let name = out.to_str().unwrap();
    let cell = ["simulate", name, "--setup", "eye-to-hand", "--no-images"];
    assert_eq!(handeye(&cell).0, 0);
    fs::remove_file(out.join("handeye.toml")).unwrap();
    let (code, told, _) = handeye(&["init", name]);
    assert_eq!(code, 0, "{told}");
    assert!(told.lines().skip(1).all(|line| line.chars().count() <= 80), "{told}");
    let text = fs::read_to_string(out.join("handeye.toml")).unwrap();
    for part in [
        "poses = \"robot.csv\"  # 15 poses",
        "notation = \"quaternion-xyzw\"\nlength_unit = \"m\"",
        "[corners]\nfiles = \"corners/???.csv\"  # 15 files",
        "[[placements]]\nid = \"place-2\"\ncorners = \"corners/place-2.csv\"",
        "[touches]\nfile = \"touches.csv\"  # 12 touches\nkind = \"flange-pose\"",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let answered = text.replace("# setup = \"eye-in-hand\"", "setup = \"eye-to-hand\"");
    let mut answered =
        answered.replace("# columns = 11", "columns = 9").replace("# rows = 8", "rows = 6");
    for line in [
        "kind = \"checkerboard\"",
        "square_mm",
        "direction",
        "frame",
        "pixel_origin",
        "[touches.tip]",
        "in_flange_mm",
    ] {
        answered = answered.replace(&format!("# {line}"), line);
    }
    fs::write(out.join("handeye.toml"), answered).unwrap();
    let (code, _, said) = handeye(&["calibrate", name, "--json"]);
    assert!(code != 1, "the answered manifest can be used: {said}");
    fs::remove_dir_all(out).unwrap();
}

#[test]
fn init_recognises_the_board_and_a_program_of_the_robot() {
    let out = folder("recognised");
    let name = out.to_str().unwrap();
    let cell = [
        "simulate",
        name,
        "--captures",
        "3",
        "--width",
        "800",
        "--height",
        "600",
        "--charuco",
        "9x6",
    ];
    assert_eq!(handeye(&cell).0, 0);
    for file in ["handeye.toml", "robot.csv", "touches.csv"] {
        fs::remove_file(out.join(file)).unwrap();
    }
    let points: String = (0..3)
        .map(|k| {
            format!("DECL E6POS XP{k}={{X {k}.5,Y -20.1,Z 700.0,A 90.0,B 0.5,C 180.0,S 2,T 10}}\n")
        })
        .collect();
    fs::write(out.join("points.dat"), format!("DEFDAT POINTS\n{points}ENDDAT\n")).unwrap();
    let (code, told, _) = handeye(&["init", name, "--setup", "eye-in-hand"]);
    assert_eq!(code, 0, "{told}");
    let text = fs::read_to_string(out.join("handeye.toml")).unwrap();
    for part in [
        "# seen in 3 of 3 images that were looked at: 9 x 6 squares with markers of\n",
        "kind = \"charuco\"\nsquares_x = 9\nsquares_y = 6\n# QUESTION: how long are the sides",
        "\n# square_mm = 30.0\n# marker_mm = ",
        "poses = \"points.dat\"  # 3 poses in 1 file\nnotation = \"kuka\"\ndirection = \"base_from_flange\"",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    // a table says its units in its header, and whose names these are
    fs::remove_file(out.join("points.dat")).unwrap();
    fs::remove_file(out.join("handeye.toml")).unwrap();
    let row = |k: u32| format!("{k};{k},5;-20,1;700;3;0,5;1,5\n");
    let table =
        format!("Punkt;X [mm];Y [mm];Z [mm];A [°];B [°];C [°]\n{}{}{}", row(1), row(2), row(3));
    fs::write(out.join("points.csv"), table).unwrap();
    let (_, told, _) = handeye(&["init", name, "--setup", "eye-in-hand"]);
    assert!(told.contains("called as \"kuka\" and \"doosan\" have them"), "{told}");
    let text = fs::read_to_string(out.join("handeye.toml")).unwrap();
    assert!(text.contains("length_unit = \"mm\"  # as the header says"), "{text}");
    let as_fanuc = text
        .replace("# notation = \"kuka\"", "notation = \"fanuc\"")
        .replace("length_unit = \"mm\"", "");
    let mut as_fanuc = as_fanuc.replace("30.0", "28.0");
    for line in ["square_mm", "marker_mm", "direction", "frame"] {
        as_fanuc = as_fanuc.replace(&format!("# {line} "), &format!("{line} "));
    }
    fs::write(out.join("handeye.toml"), as_fanuc).unwrap();
    let (_, _, said) = handeye(&["calibrate", name]);
    assert!(said.contains("are not those of fanuc, but those of kuka and of doosan"), "{said}");
    fs::remove_dir_all(out).unwrap();
}

/// An arm of Denavit-Hartenberg parameters as a URDF whose joints are counted from `first`: each joint turns in its own
/// frame, its link is a fixed joint.
fn as_urdf(arm: &Value, first: usize) -> String {
    let mut text = String::from("<robot name=\"arm\"><link name=\"link_0\"/>");
    let joints = arm["joints"].as_array().unwrap();
    for (k, joint) in joints.iter().enumerate() {
        let number = |key: &str| joint[key].as_f64().unwrap();
        let (a, d, alpha, theta) =
            (number("a"), number("d"), number("alpha"), number("theta_offset"));
        text += &format!(
            "<link name=\"turned_{k}\"/><link name=\"link_{}\"/><joint name=\"joint_{}\" type=\"revolute\"><parent \
             link=\"link_{k}\"/><child link=\"turned_{k}\"/><origin rpy=\"0 0 {theta}\"/><axis xyz=\"0 0 1\"/></joint>\
             <joint name=\"behind_{k}\" type=\"fixed\"><parent link=\"turned_{k}\"/><child link=\"link_{}\"/><origin \
             xyz=\"{a} 0 {d}\" rpy=\"{alpha} 0 0\"/></joint>",
            k + 1,
            k + first,
            k + 1
        );
    }
    text + "</robot>"
}

#[test]
fn an_arm_that_was_given_as_a_urdf_is_corrected_as_one() {
    let out = folder("urdf");
    let cell = out.join("cell");
    let simulate = ["simulate", cell.to_str().unwrap(), "--setup", "eye-to-hand", "--arm"];
    let more = ["--no-images", "--captures", "20", "--seed", "3"];
    assert_eq!(handeye(&[&simulate[..], &more].concat()).0, 0);
    let arm = serde_json::from_str(&fs::read_to_string(cell.join("arm.json")).unwrap()).unwrap();
    fs::write(cell.join("arm.urdf"), as_urdf(&arm, 0)).unwrap();
    let manifest = fs::read_to_string(cell.join("handeye.toml")).unwrap();
    let urdf = "urdf = { file = \"arm.urdf\", base = \"link_0\", flange = \"link_6\" }";
    let given = manifest.replace("dh = \"arm.json\"", urdf);
    assert_ne!(given, manifest);
    fs::write(cell.join("handeye.toml"), given).unwrap();
    let result = out.join("result");
    let calibrate = ["calibrate", cell.to_str().unwrap(), "--out", result.to_str().unwrap(), "-q"];
    // the file has joint_1 to joint_6: the joint after joint_0 does not take the first one's values
    let (code, _, said) = handeye(&calibrate);
    assert_eq!(code, 1);
    assert!(said.contains("there is no joint named joint_0"), "{said}");
    fs::write(cell.join("arm.urdf"), as_urdf(&arm, 1)).unwrap();
    let (code, _, said) = handeye(&calibrate);
    assert_eq!(code, 0, "{said}");
    // the corrected one is an arm that fits: calibrated with it, hardly anything is left to correct
    let corrected = fs::read_to_string(result.join("corrected_arm.urdf")).unwrap();
    assert!(corrected.contains("joint_6") && corrected != as_urdf(&arm, 1));
    assert!(!result.join("corrected_kinematics.yaml").exists(), "no arm of Universal Robots");
    fs::write(cell.join("arm.urdf"), corrected).unwrap();
    let again = ["calibrate", cell.to_str().unwrap(), "--json"];
    let (code, found, said) = handeye(&again);
    assert_eq!(code, 0, "{said}");
    let found: Value = serde_json::from_str(&found).unwrap();
    assert_ne!(found["method"], "joint-with-arm");
    fs::remove_dir_all(out).unwrap();
}

/// Joint values from files, of views and of touches; then another cell into the same folder.
#[test]
fn an_arm_that_is_not_as_its_model_says_is_corrected_from_files() {
    let out = folder("arm");
    let (cell, result) = (out.join("cell"), out.join("result"));
    let (cell, result) = (cell.to_str().unwrap(), result.to_str().unwrap());
    let simulate = ["simulate", cell, "--setup", "eye-to-hand", "--arm", "--no-images"];
    assert_eq!(handeye(&[&simulate[..], &["--captures", "20", "--seed", "3"]].concat()).0, 0);
    let answer = |found: &str| serde_json::from_str::<Value>(found).unwrap();
    let calibrate = ["calibrate", cell, "--out", result, "--json"];
    let (code, found, said) = handeye(&calibrate);
    assert_eq!(code, 0, "{said}");
    let found = answer(&found);
    assert_eq!(found["method"], "joint-with-arm");
    let [before, after] =
        ["robot_before_mm", "robot_after_mm"].map(|key| found["arm"][key].as_f64().unwrap());
    assert!(after < 0.4 * before, "{before} {after}");
    assert!(out.join("result/corrected_arm.json").exists());
    assert!(!out.join("result/corrected_arm.urdf").exists(), "it was not given as one");
    // what the arm goes on missing is in what the answer says of itself
    let (code, tested, said) = handeye(&["verify", result, cell, "--json"]);
    let tested = answer(&tested);
    assert_eq!((code, tested["verdict"].as_str()), (0, Some("accepted")), "{said}");
    assert!(tested["agreement"]["chi_square"].as_f64().unwrap() > 3.0, "{tested}");
    // a cell without joint values has no arm to correct, and nothing of the earlier run stays
    let plain = out.join("plain");
    let plain = plain.to_str().unwrap();
    let simulate = ["simulate", plain, "--setup", "eye-to-hand", "--no-images"];
    assert_eq!(handeye(&simulate).0, 0);
    let calibrate = ["calibrate", plain, "--out", result, "--json"];
    let (code, found, said) = handeye(&calibrate);
    assert_eq!(code, 0, "{said}");
    assert!(answer(&found)["arm"].is_null());
    assert!(!out.join("result/corrected_arm.json").exists());
    fs::remove_dir_all(out).unwrap();
}

#[test]
fn init_says_that_there_is_nothing() {
    let out = folder("nothing");
    fs::create_dir_all(&out).unwrap();
    fs::write(out.join("notes.txt"), "no numbers here").unwrap();
    let (code, told, said) = handeye(&["init", out.to_str().unwrap()]);
    assert!(code == 1 && told.is_empty() && said.contains("nothing found here that"), "{said}");
    assert!(!out.join("handeye.toml").exists());
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

/// Result of a small simulated cell with a 3D camera, and its report.
fn scanned(name: &str, options: &[&str]) -> (Value, String) {
    let out = folder(name);
    let cell = out.to_str().unwrap();
    let small = ["--width", "640", "--height", "480", "--captures", "9", "--touches", "0"];
    let arguments = [&["simulate", cell, "--quiet"], &small[..], options].concat();
    let (code, _, said) = handeye(&arguments);
    assert_eq!(code, 0, "{said}");
    let answer = out.join("answer");
    let (_, json, said) =
        handeye(&["calibrate", cell, "--out", answer.to_str().unwrap(), "--json"]);
    let told = serde_json::from_str(&json).unwrap_or_else(|e| panic!("{e}: {said}"));
    let page = fs::read_to_string(answer.join("report.html")).unwrap();
    fs::remove_dir_all(out).unwrap();
    (told, page)
}

fn warned(told: &Value) -> Vec<&str> {
    let all = told["warnings"].as_array().unwrap();
    all.iter().filter_map(|w| w["code"].as_str()).collect()
}

#[test]
fn what_is_wrong_with_scans_and_board_is_named() {
    let board = ["--scans", "--checkerboard", "9x6", "--square-mm", "25"];
    let told = |name, more: &[&str]| scanned(name, &[&board[..], more].concat());
    let number = |v: &Value| v.as_f64().unwrap();
    let (sound, _) = told("sound", &[]);
    let own = ["depth-by-colour", "board-not-flat", "picture-and-scan"];
    let any = |code: &&str| own.iter().any(|own| code.starts_with(own));
    assert!(!warned(&sound).iter().any(any), "{:?}", warned(&sound));

    let (step, page) = told("step", &["--black-step-mm", "0.6"]);
    let found = &step["scans"]["colour_step"];
    assert!(warned(&step).contains(&"depth-by-colour") && found["applied"] == true, "{found}");
    assert!((number(&found["black_minus_white_mm"]) - 0.6).abs() < 0.02, "{found}");
    assert!(page.contains("<h3>Black and white</h3>"));

    let (bow, page) = told("bow", &["--bow-mm", "0.8"]);
    let found = &bow["scans"]["flatness"]["peak_to_valley_mm"];
    assert!(warned(&bow).contains(&"board-not-flat") && (number(found) - 0.8).abs() < 0.03);
    assert!(page.contains("Mean deviation of every corner"), "the map");

    for (part, option, value) in [
        ("scale", "--scan-scale-percent", "0.8"),
        ("tilt", "--scan-tilt-deg", "0.5"),
        ("shift", "--scan-shift-mm", "3"),
    ] {
        let (frames, page) = told(part, &[option, value]);
        let code = format!("picture-and-scan-{part}");
        assert!(warned(&frames).contains(&code.as_str()), "{:?}", warned(&frames));
        let found = &frames["scans"]["frames"];
        assert_eq!(found["proven"], serde_json::json!([part]), "{found}");
        assert!(page.contains("<h3>Images against scans</h3>"));
    }
}

#[test]
fn a_ball_calibrates_a_3d_camera() {
    for setup in ["eye-in-hand", "eye-to-hand"] {
        let options = ["--sphere", "50", "--setup", setup, "--robot-mm", "0.1"];
        let (told, page) = scanned(setup, &options);
        assert_eq!(told["verdict"], "accepted", "{}", told["reasons"]);
        assert_eq!(told["method"], "ball-least-squares");
        assert!(told["predicted_tre_mm"]["rms"].as_f64().unwrap() < 1.0);
        assert!(told["held_out"]["translation_rms_mm"].as_f64().unwrap() < 2.0);
        assert!(page.contains("ball-least-squares"));
    }
    // cameras that only shift see nothing of what turns the camera about
    let still = ["--sphere", "50", "--tilt-deg", "0", "--spin-deg", "0"];
    let (told, _) = scanned("still", &still);
    assert_eq!(told["verdict"], "undetermined", "{}", told["reasons"]);
    assert!(told["hand_eye"]["mount_from_camera"].is_null());
}

#[test]
fn one_cause_is_told_and_not_its_effects() {
    for (options, codes) in [
        ("--width 960 --height 600 --bow-mm 1.5", vec!["board-not-flat"]),
        (
            "--width 960 --height 600 --bow-mm 1.5 --scan-shift-mm 8",
            vec!["picture-and-scan-disagree", "board-not-flat", "picture-and-scan-shift"],
        ),
        ("--width 960 --height 600 --scan-scale 0.25 --black-step-mm 1", vec!["depth-by-colour"]),
        ("--width 1280 --height 800 --scan-scale 0.15 --black-step-mm 1", vec!["depth-by-colour"]),
        ("--width 1280 --height 800 --scan-scale 0.15", vec![]),
    ] {
        let cell = folder("causes");
        let path = cell.to_str().unwrap();
        let how = ["simulate", path, "--scans", "--captures", "10", "--touches", "0", "--quiet"];
        let args: Vec<&str> = how.into_iter().chain(options.split_whitespace()).collect();
        assert_eq!(handeye(&args).0, 0);
        let (_, json, _) = handeye(&["calibrate", path, "--json", "--quiet"]);
        let told: Value = serde_json::from_str(&json).unwrap();
        assert_eq!(warned(&told), codes, "{options}");
        fs::remove_dir_all(cell).unwrap();
    }
}
