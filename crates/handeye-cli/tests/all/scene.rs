//! `calibrate` without a board: scans of a still scene, and of an object of known shape.

use std::fmt::Write;

use handeye::{
    Intrinsics, Scan,
    math::{lie, random::Random},
    simulate::{Room, Solid, Thing},
};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3, Vector6};
use serde_json::{Value, json};

use crate::folder::{Folder, Run, handeye};

const PI: f64 = std::f64::consts::PI;
/// Of a range, m.
const NOISE_M: f64 = 4e-4;
/// Of a robot pose, m and rad.
const ROBOT: f64 = 1e-4;

fn camera() -> Intrinsics {
    Intrinsics::pinhole(200, 150, 200.0, 200.0, 99.5, 74.5)
}

fn flange_from_camera() -> Isometry3<f64> {
    Isometry3::new([0.05, -0.03, 0.08].into(), [0.02, -0.03, 1.5].into())
}

/// A camera above the origin that looks down, tilted and turned by chance.
fn above(height: f64, turn: f64, random: &mut Random) -> Isometry3<f64> {
    let mut some = |s: f64| random.between(-s, s);
    let at = [some(0.12), some(0.12), height + some(0.1)];
    let turn = [some(0.3), some(0.3), some(turn)];
    Isometry3::new(at.into(), [PI, 0.0, 0.0].into()) * Isometry3::new(Vector3::zeros(), turn.into())
}

/// A camera that looks at the origin, from above and aslant, turned by chance.
fn aimed(distance: f64, random: &mut Random) -> Isometry3<f64> {
    let mut some = |s: f64| random.between(-s, s);
    let turn = Isometry3::rotation([some(0.5), some(0.5), some(1.5)].into());
    let at = [some(0.03), some(0.03), distance + some(0.05)];
    turn * Isometry3::new(at.into(), [PI, 0.0, 0.0].into())
}

fn reported(pose: &Isometry3<f64>, random: &mut Random) -> Isometry3<f64> {
    let (w, v) = (random.normal3() * ROBOT, random.normal3() * ROBOT);
    pose * lie::exp(&Vector6::new(w.x, w.y, w.z, v.x, v.y, v.z))
}

/// Text of an organised cloud, in millimetres.
fn pcd(scan: &Scan) -> String {
    let mut text = format!(
        "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {}\nHEIGHT {}\nPOINTS \
         {}\nDATA ascii\n",
        scan.width(),
        scan.height(),
        scan.points().len()
    );
    for p in scan.points() {
        let [x, y, z] = p.map(|x| x * 1e3);
        writeln!(text, "{x} {y} {z}").unwrap();
    }
    text
}

fn csv(poses: &[Isometry3<f64>]) -> String {
    let row = |p: &Isometry3<f64>| {
        let (t, q) = (p.translation, p.rotation.coords);
        format!("{},{},{},{},{},{},{}\n", t.x, t.y, t.z, q.x, q.y, q.z, q.w)
    };
    poses.iter().map(row).collect()
}

const TABLES: &str = "[robot]\nposes = \"poses.csv\"\nnotation = \"quaternion-xyzw\"\nlength_unit = \"m\"\n\
                      direction = \"base_from_flange\"\n[scans]\nfiles = \"scan_*.pcd\"\nlength_unit = \"mm\"\n";

fn manifest(setup: &str, target: &str, more: &str) -> String {
    format!("setup = \"{setup}\"\ntarget = \"{target}\"\n{more}{TABLES}")
}

fn put_scans(folder: &Folder, scans: &[Scan], poses: &[Isometry3<f64>]) {
    for (k, scan) in scans.iter().enumerate() {
        folder.put(&format!("scan_{k:02}.pcd"), &pcd(scan));
    }
    folder.put("poses.csv", &csv(poses));
}

/// A room as a camera on the flange sees it from several places.
fn seen_in_hand(folder: &Folder, room: &Room, count: usize, seed: u64) {
    let mut random = Random::new(seed);
    let (mut scans, mut poses) = (vec![], vec![]);
    for _ in 0..count {
        let base_from_camera = above(0.75, 0.6, &mut random);
        scans.push(room.scan(&base_from_camera, &camera(), NOISE_M, &mut random));
        let flange = base_from_camera * flange_from_camera().inverse();
        poses.push(reported(&flange, &mut random));
    }
    put_scans(folder, &scans, &poses);
}

fn thing(solid: Solid, at: [f64; 3], turn: [f64; 3]) -> Thing {
    Thing { solid, room_from_thing: Isometry3::new(at.into(), turn.into()) }
}

/// An L of two blocks, with a wedge of a third one across it.
fn part() -> Vec<Thing> {
    let block = |half| Solid::Block { half };
    vec![
        thing(block([0.12, 0.08, 0.02]), [0.0; 3], [0.0; 3]),
        thing(block([0.02, 0.08, 0.06]), [-0.10, 0.0, 0.08], [0.0; 3]),
        thing(block([0.05, 0.02, 0.03]), [0.04, 0.02, 0.035], [0.0, 0.3, 0.5]),
    ]
}

/// The blocks' triangles, in millimetres.
fn stl(things: &[Thing]) -> String {
    let mut text = String::from("solid part\n");
    for thing in things {
        let Solid::Block { half } = thing.solid else { panic!("no block") };
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                let corner = |a: f64, b: f64| {
                    let mut p = Vector3::zeros();
                    (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, a * side, b);
                    let p = p.component_mul(&Vector3::from(half));
                    1e3 * (thing.room_from_thing * nalgebra::Point3::from(p)).coords
                };
                let square =
                    [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
                for corners in [[0, 1, 2], [0, 2, 3]] {
                    text += "facet normal 0 0 0\nouter loop\n";
                    for k in corners {
                        let p: Vector3<f64> = square[k];
                        writeln!(text, "vertex {} {} {}", p.x, p.y, p.z).unwrap();
                    }
                    text += "endloop\nendfacet\n";
                }
            }
        }
    }
    text + "endsolid part\n"
}

/// Where the calibration put the camera.
fn found(answer: &Value) -> Isometry3<f64> {
    let pose = &answer["hand_eye"]["mount_from_camera"];
    let number = |key: &str, k: usize| {
        pose[key][k].as_f64().unwrap_or_else(|| panic!("{pose} has no {key}"))
    };
    let t = Vector3::from_fn(|k, _| number("translation_m", k));
    let [x, y, z, w] = [0, 1, 2, 3].map(|k| number("rotation_xyzw", k));
    let q = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    Isometry3::from_parts(Translation3::from(t), q)
}

fn assert_right(answer: &Value, truth: &Isometry3<f64>) {
    let off = lie::log(&truth.inv_mul(&found(answer)));
    let (deg, mm) = (lie::omega(&off).norm().to_degrees(), 1e3 * lie::nu(&off).norm());
    println!("{deg:.3} deg, {mm:.2} mm");
    assert!(deg < 0.1 && mm < 1.0, "{deg} deg, {mm} mm");
}

fn accepted(run: &Run) {
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
}

#[test]
fn a_camera_is_calibrated_on_what_stands_about_and_again_from_there() {
    let folder = Folder::new();
    seen_in_hand(&folder, &Room::of_a_cell(&mut Random::new(51)), 10, 61);
    folder.put("handeye.toml", &manifest("eye-in-hand", "scene", ""));
    let run = handeye(&folder, &["calibrate", ".", "--out", "result"]);
    accepted(&run);
    assert!(run.stdout.contains("scans were brought together by"), "{}", run.stdout);
    assert!(run.stdout.lines().all(|line| line.chars().count() <= 80), "{}", run.stdout);
    let text = folder.read("result/calibration.json");
    let answer: Value = serde_json::from_str(&text).unwrap();
    assert_right(&answer, &flange_from_camera());
    for word in ["board", "corner", "picture", "image"] {
        let (reasons, warnings) = (&answer["reasons"], &answer["warnings"]);
        let said = format!("{reasons}{warnings}{}{}", answer["error_budget"], answer["advice"]);
        assert!(!said.contains(word), "{word}: {said}");
    }
    let scene = &answer["scans"]["scene"];
    assert_eq!(scene["kind"], "scene");
    println!("{}", run.stdout);
    assert!(scene["placed"].as_u64().unwrap() >= 7, "{scene}");
    let pairs = scene["pairs"].as_array().unwrap();
    assert!(pairs.iter().filter(|p| p["used"] == true).count() >= 9, "{scene}");
    assert!(pairs.iter().all(|p| p["used"] == true || p["reason"].is_string()), "{scene}");
    let page = folder.read("result/report.html");
    assert!(page.contains("<h2>Scene</h2>") && page.contains("Each pair"));

    let initial = "[scene]\ninitial = \"result/calibration.json\"\n";
    folder.put("handeye.toml", &manifest("eye-in-hand", "scene", initial));
    let run = handeye(&folder, &["calibrate", ".", "--json"]);
    accepted(&run);
    assert_right(&run.json(), &flange_from_camera());
    let run = handeye(&folder, &["check", "."]);
    assert_eq!(run.code, 1);
    assert!(run.error().contains("cannot tell what is wrong with those"), "{}", run.stderr);
}

#[test]
fn a_part_on_the_flange_calibrates_a_camera_that_stands() {
    let folder = Folder::new();
    let mut random = Random::new(5);
    let base_from_camera = Isometry3::new([0.4, 0.1, 1.2].into(), [PI, 0.1, 0.2].into());
    let flange_from_part = Isometry3::new([0.01, 0.02, 0.06].into(), [0.1, 0.2, 0.3].into());
    let (mut scans, mut poses) = (vec![], vec![]);
    for _ in 0..8 {
        let part_from_camera = aimed(0.5, &mut random);
        scans.push(Room { things: part() }.scan(
            &part_from_camera,
            &camera(),
            NOISE_M,
            &mut random,
        ));
        let base_from_part = base_from_camera * part_from_camera.inverse();
        poses.push(reported(&(base_from_part * flange_from_part.inverse()), &mut random));
    }
    put_scans(&folder, &scans, &poses);
    folder.put("part.stl", &stl(&part()));
    let object = "[object]\nmodel = \"part.stl\"\nlength_unit = \"mm\"\n";
    folder.put("handeye.toml", &manifest("eye-to-hand", "object", object));
    let run = handeye(&folder, &["calibrate", ".", "--out", "result"]);
    let answer: Value = serde_json::from_str(&folder.read("result/calibration.json")).unwrap();
    println!("{}", run.stdout);
    accepted(&run);
    assert!(run.stdout.contains("the object was found in"), "{}", run.stdout);
    assert_right(&answer, &base_from_camera);
    assert_eq!(answer["scans"]["scene"]["pairs"][0]["source"], "object");
    assert!(folder.read("result/report.html").contains("<h2>Object</h2>"));
    assert!(answer["scans"]["scene"]["placed"].as_u64().unwrap() >= 7, "{}", answer["scans"]);
    let run = handeye(&folder, &["check", ".", "--json"]);
    assert_eq!(run.json()["ok"], true, "{}{}", run.stdout, run.stderr);

    // a scan of the part is as good as its mesh, wherever it was made
    let fine = Intrinsics::pinhole(400, 300, 400.0, 400.0, 199.5, 149.5);
    let scan = Room { things: part() }.scan(&aimed(0.5, &mut random), &fine, 1e-4, &mut random);
    folder.put("part.pcd", &pcd(&scan));
    let object = "[object]\nmodel = \"part.pcd\"\nlength_unit = \"mm\"\n";
    folder.put("handeye.toml", &manifest("eye-to-hand", "object", object));
    let run = handeye(&folder, &["calibrate", ".", "--json"]);
    println!("{}", run.json()["scans"]["scene"]["placed"]);
    accepted(&run);
    assert_right(&run.json(), &base_from_camera);
}

#[test]
fn a_robot_that_turns_about_one_axis_is_not_enough() {
    let folder = Folder::new();
    let mut random = Random::new(64);
    let room = Room::of_a_cell(&mut Random::new(51));
    let (mut scans, mut poses) = (vec![], vec![]);
    for k in 0..6 {
        let at = [random.between(-0.1, 0.1), random.between(-0.1, 0.1), 0.75];
        let turn = Isometry3::rotation([0.0, 0.0, 0.25 * f64::from(k)].into());
        let base_from_camera = Isometry3::new(at.into(), [PI, 0.0, 0.0].into()) * turn;
        scans.push(room.scan(&base_from_camera, &camera(), NOISE_M, &mut random));
        let flange = base_from_camera * flange_from_camera().inverse();
        poses.push(reported(&flange, &mut random));
    }
    put_scans(&folder, &scans, &poses);
    let images = "[images]\nfiles = \"image_*.png\"\n";
    (0..6).for_each(|k| folder.put(&format!("image_{k:02}.png"), "@png 8x8"));
    folder.put("handeye.toml", &manifest("eye-in-hand", "scene", images));
    let run = handeye(&folder, &["calibrate", ".", "--json"]);
    let answer = run.json();
    let reasons = answer["reasons"].to_string();
    println!("{:#}", answer["reasons"]);
    assert_eq!(run.code, 3, "{reasons}");
    assert!(answer["scans"]["scene"]["placed"].as_u64().unwrap() >= 3, "{}", answer["scans"]);
    assert!(["board", "corner", "touch"].iter().all(|word| !reasons.contains(word)), "{reasons}");
    let warnings = answer["warnings"].to_string();
    assert!(warnings.contains("target = \\\"scene\\\" is seen in scans alone"), "{warnings}");
}

#[test]
fn a_bare_table_is_not_enough_and_what_slides_is_said() {
    let folder = Folder::new();
    let table = thing(Solid::Block { half: [2.0, 2.0, 0.01] }, [0.0; 3], [0.0; 3]);
    seen_in_hand(&folder, &Room { things: vec![table] }, 4, 62);
    folder.put("handeye.toml", &manifest("eye-in-hand", "scene", ""));
    let run = handeye(&folder, &["calibrate", ".", "--out", "result"]);
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    let answer: Value = serde_json::from_str(&folder.read("result/calibration.json")).unwrap();
    println!("{}{:#}", run.stdout, answer["reasons"]);
    assert!(answer["hand_eye"]["mount_from_camera"].is_null());
    let first = answer["reasons"][0].as_str().unwrap();
    assert!(first.starts_with("4 of 4 scans could not be registered to the scene"), "{first}");
    assert!(first.contains("its surface does not constrain a shift"), "{first}");
    let off = lie::exp(&Vector6::new(0.005, -0.01, 0.005, 0.002, 0.003, -0.002));
    let guess = flange_from_camera() * off;
    let mut earlier = answer;
    let (t, q) = (guess.translation.vector, guess.rotation.coords);
    earlier["hand_eye"]["mount_from_camera"] = json!({
        "to": "mount", "from": "camera",
        "translation_m": [t.x, t.y, t.z], "rotation_xyzw": [q.x, q.y, q.z, q.w],
    });
    folder.put("earlier.json", &earlier.to_string());
    let initial = "[scene]\ninitial = \"earlier.json\"\n";
    folder.put("handeye.toml", &manifest("eye-in-hand", "scene", initial));
    let run = handeye(&folder, &["calibrate", ".", "--out", "result"]);
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    let answer: Value = serde_json::from_str(&folder.read("result/calibration.json")).unwrap();
    let reason = answer["captures"][0]["reason"].as_str().unwrap();
    assert!(reason.contains("not even its pair with"), "{reason}");
    assert!(reason.contains("the overlap does not constrain: a shift"), "{reason}");
    assert!(folder.read("result/report.html").contains("What is not determined"));
}

/// Manifests that contradict themselves, and what is said.
#[test]
fn manifests_that_cannot_be_meant_are_refused() {
    let folder = Folder::new();
    seen_in_hand(&folder, &Room::of_a_cell(&mut Random::new(7)), 1, 63);
    folder.put("poses.csv", &csv(&[Isometry3::identity()]));
    folder.put("part.stl", &stl(&part()));
    folder.put("line.xyz", "0 0 1\n0 0 2\n0 0 3\n");
    let object = "[object]\nmodel = \"part.stl\"\nlength_unit = \"mm\"\n";
    let result = |setup: &str| {
        let made =
            handeye(&folder, &["simulate", setup, "--setup", setup, "--no-images", "--quiet"]);
        assert_eq!(made.code, 0, "{}", made.stderr);
        let out = format!("{setup}/result");
        handeye(&folder, &["calibrate", setup, "--out", &out, "--quiet"]);
        format!("{out}/calibration.json")
    };
    let other = result("eye-to-hand");
    let answer =
        folder.read(&other).replace("\"setup\": \"eye-to-hand\"", "\"setup\": \"eye-in-hand\"");
    let mut none: Value = serde_json::from_str(&answer).unwrap();
    none["hand_eye"]["mount_from_camera"] = Value::Null;
    folder.put("none.json", &none.to_string());
    folder.put("text.json", "{}");
    let initial =
        |name: &str| manifest("eye-in-hand", "scene", &format!("[scene]\ninitial = \"{name}\"\n"));
    let in_hand = |target: &str, more: &str| manifest("eye-in-hand", target, more);
    let without_scans = |text: String| text.split("[scans]").next().unwrap().to_owned();
    let board = "[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n";
    let cases = [
        (
            in_hand("room", ""),
            "handeye.toml:2: target = \"room\" is neither \"scene\" nor \"object\", and a board is",
        ),
        (
            manifest("eye-to-hand", "scene", ""),
            "handeye.toml:2 [target]: a still scene tells nothing of a camera that stands still itself; fix \
             an object of known shape to the flange, and write target = \"object\"",
        ),
        (
            without_scans(in_hand("scene", "")),
            "scans is missing; in which scans is the scene seen?",
        ),
        (
            without_scans(in_hand("object", object)),
            "scans is missing; in which scans is the object seen?",
        ),
        (in_hand("object", ""), "object is missing; which shape does the camera see?"),
        (
            in_hand("scene", object),
            "handeye.toml:3 [object]: [object] belongs to target = \"object\"; write target",
        ),
        (
            in_hand("object", "[scene]\n"),
            "handeye.toml:3 [scene]: [scene] belongs to target = \"scene\"; write target",
        ),
        (
            format!("setup = \"eye-in-hand\"\n{board}[scene]\n{TABLES}"),
            "handeye.toml:7 [scene]: [scene] belongs to target = \"scene\"",
        ),
        (
            in_hand("scene", "[captures]\ntarget = \"left\"\n"),
            "handeye.toml:4 [captures.target]: captures.target belongs to a board",
        ),
        (
            in_hand("scene", "[touches]\nfile = \"t.csv\"\n"),
            "handeye.toml:3 [touches]: touches belongs to a board",
        ),
        (in_hand("scene", "[scene]\nintial = \"a\"\n"), "handeye.toml:4: unknown field `intial`"),
        (initial(&other), "is the result of a camera that stands still (eye-to-hand); name one"),
        (initial("none.json"), "holds no camera pose: its calibration has no answer"),
        (initial("text.json"), "text.json:1: is no calibration.json of handeye"),
        (initial("nothing.json"), "nothing.json"),
        (
            in_hand("object", "[object]\nmodel = \"part.stl\"\n"),
            "part.stl: object.length_unit is missing; are the vertices in",
        ),
        (
            in_hand("object", "[object]\nmodel = \"line.xyz\"\nlength_unit = \"m\"\n"),
            "line.xyz: shows no surface",
        ),
        (
            format!("setup = \"eye-in-hand\"\n{}{TABLES}", board.replace("rows", "row")),
            "handeye.toml:2: unknown field `row`",
        ),
    ];
    for (manifest, said) in cases {
        folder.put("handeye.toml", &manifest);
        let run = handeye(&folder, &["calibrate", "."]);
        assert_eq!(run.code, 1, "{manifest}{}{}", run.stdout, run.stderr);
        assert!(run.error().contains(said), "{manifest}{}", run.stderr);
    }
}
