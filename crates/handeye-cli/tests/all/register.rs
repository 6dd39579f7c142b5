//! `handeye register`: two scans of a room from different places.

use std::fmt::Write;

use handeye::{
    Intrinsics, Scan,
    math::{lie, random::Random},
    simulate::{Room, Solid, Thing},
};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use serde_json::{Value, json};

use crate::folder::{Folder, handeye};

const PI: f64 = std::f64::consts::PI;

fn camera() -> Intrinsics {
    Intrinsics::pinhole(240, 180, 240.0, 240.0, 119.5, 89.5)
}

/// Two scans, and where the first lies in the second.
fn scans(room: &Room) -> (Scan, Scan, Isometry3<f64>) {
    let above = |x: f64, y: f64, turn: [f64; 3]| {
        Isometry3::new([x, y, 0.8].into(), [PI, 0.0, 0.0].into())
            * Isometry3::new(Vector3::zeros(), turn.into())
    };
    let one = above(0.02, -0.03, [0.1, 0.05, 0.05]);
    let other = above(0.0, 0.0, [0.08, 0.06, 0.03]);
    let mut random = Random::new(11);
    let source = room.scan(&one, &camera(), 4e-4, &mut random);
    let target = room.scan(&other, &camera(), 4e-4, &mut random);
    (source, target, other.inv_mul(&one))
}

fn cell() -> Room {
    Room::of_a_cell(&mut Random::new(1))
}

/// Text, with coordinates times a factor; organised or not.
fn pcd(scan: &Scan, factor: f32, organised: bool) -> String {
    let points: Vec<_> = scan.points().iter().filter(|p| organised || p[0].is_finite()).collect();
    let (width, height) = if organised { (scan.width(), scan.height()) } else { (points.len(), 1) };
    let mut text = format!(
        "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {width}\nHEIGHT \
         {height}\nPOINTS {}\nDATA ascii\n",
        points.len()
    );
    for p in points {
        let [x, y, z] = p.map(|x| x * factor);
        writeln!(text, "{x} {y} {z}").unwrap();
    }
    text
}

fn found(answer: &Value) -> Isometry3<f64> {
    let pose = &answer["target_from_source"];
    let number = |key: &str, k: usize| pose[key][k].as_f64().unwrap();
    let t = Vector3::from_fn(|k, _| number("translation_m", k));
    let [x, y, z, w] = [0, 1, 2, 3].map(|k| number("rotation_xyzw", k));
    let q = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    Isometry3::from_parts(Translation3::from(t), q)
}

/// Degrees, and mm at the middle of the room.
fn errors(truth: &Isometry3<f64>, found: &Isometry3<f64>) -> (f64, f64) {
    let middle = Vector3::new(0.0, 0.0, 0.8).into();
    let apart = (truth.transform_point(&middle) - found.transform_point(&middle)).norm();
    (lie::angle(&truth.rotation, &found.rotation).to_degrees(), 1e3 * apart)
}

#[test]
fn scans_are_registered_whatever_their_kind_and_unit() {
    let (source, target, truth) = scans(&cell());
    let folder = Folder::new();
    folder.put("source.pcd", &pcd(&source, 1.0, true));
    folder.put("target.pcd", &pcd(&target, 1.0, true));
    folder.put("cloud.pcd", &pcd(&source, 1000.0, false));
    for (source, unit_is_assumed) in [("source.pcd", false), ("cloud.pcd", true)] {
        let run = handeye(&folder, &["register", source, "target.pcd", "--json"]);
        assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
        let answer = run.json();
        assert_eq!(answer["verdict"], "accepted");
        assert_eq!(answer["undetermined"], json!([]));
        let (degrees, mm) = errors(&truth, &found(&answer));
        assert!(degrees < 0.1 && mm < 0.4, "{source}: {degrees} deg, {mm} mm");
        assert_eq!(answer["covariance"].as_array().unwrap().len(), 6);
        assert!(answer["inlier_fraction"].as_f64().unwrap() > 0.5);
        assert!(answer["rms_mm"].as_f64().unwrap() < 1.0);
        assert!(answer["iterations"].as_u64().unwrap() > 2);
        for key in ["read", "prepare", "iterate"] {
            assert!(answer["seconds"][key].as_f64().unwrap() >= 0.0);
        }
        let warned = answer["warnings"].as_array().unwrap();
        assert_eq!(warned.iter().any(|w| w["code"] == "unit-assumed"), unit_is_assumed);
    }
    let run = handeye(&folder, &["register", "source.pcd", "target.pcd"]);
    assert_eq!(run.code, 0);
    assert!(run.stdout.contains("ACCEPTED") && run.stdout.contains("one sigma"), "{}", run.stdout);
    assert!(run.stdout.lines().all(|line| line.chars().count() <= 80), "{}", run.stdout);
}

#[test]
fn a_start_is_looked_for_where_it_is_asked_for() {
    let (source, target, truth) = scans(&cell());
    let away = Isometry3::new([0.4, -0.3, 0.2].into(), [0.2, -0.1, 1.9].into());
    let moved = |p: &[f32; 3]| {
        away.transform_point(&p.map(f64::from).into()).coords.map(|x| x as f32).into()
    };
    let points = source.points().iter().map(moved).collect();
    let moved = Scan::new(source.width(), source.height(), points).unwrap();
    let folder = Folder::new();
    folder.put("source.pcd", &pcd(&moved, 1.0, false));
    folder.put("target.pcd", &pcd(&target, 1.0, true));
    let lost = handeye(&folder, &["register", "source.pcd", "target.pcd"]);
    assert_eq!(lost.code, 3);
    assert!(lost.stderr.contains("search with --global"), "{}", lost.stderr);
    let run = handeye(&folder, &["register", "source.pcd", "target.pcd", "--global", "--json"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let (degrees, mm) = errors(&truth, &(found(&run.json()) * away));
    assert!(degrees < 0.2 && mm < 0.6, "{degrees} deg, {mm} mm");
}

/// A camera matrix alone does not say of which size its images are: the depth image does.
#[test]
fn depth_images_are_registered_with_their_intrinsics() {
    let (source, target, truth) = scans(&cell());
    let folder = Folder::new();
    for (name, scan) in [("source.png", source), ("target.png", target)] {
        let depth = |p: &[f32; 3]| if p[2] > 0.0 { (p[2] * 1e4).round() as u16 } else { 0 };
        let values = scan.points().iter().map(depth).collect();
        image::ImageBuffer::<image::Luma<u16>, Vec<u16>>::from_raw(240, 180, values)
            .unwrap()
            .save(folder.0.join(name))
            .unwrap();
    }
    folder.put(
        "camera.json",
        "{\"camera_matrix\": [[240, 0, 119.5], [0, 240, 89.5], [0, 0, 1]], \
         \"dist_coeffs\": [0, 0, 0, 0, 0]}",
    );
    let missing = handeye(&folder, &["register", "source.png", "target.png"]);
    assert_eq!(missing.code, 1);
    assert!(missing.stderr.contains("--camera is missing"), "{}", missing.stderr);
    let mut arguments = vec!["register", "source.png", "target.png", "--camera", "camera.json"];
    let missing = handeye(&folder, &arguments);
    assert!(missing.stderr.contains("--depth-scale is missing"), "{}", missing.stderr);
    arguments.extend(["--depth-scale", "0.0001", "--json"]);
    let run = handeye(&folder, &arguments);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let (degrees, mm) = errors(&truth, &found(&run.json()));
    assert!(degrees < 0.1 && mm < 0.4, "{degrees} deg, {mm} mm");
}

#[test]
fn an_answer_serves_as_the_start_of_another() {
    let (source, target, truth) = scans(&cell());
    let folder = Folder::new();
    folder.put("source.pcd", &pcd(&source, 1.0, true));
    folder.put("target.pcd", &pcd(&target, 1.0, true));
    let run = |arguments: &[&str]| {
        let mut all = vec!["register", "source.pcd", "target.pcd", "--json"];
        all.extend(arguments);
        handeye(&folder, &all)
    };
    folder.put("first.json", &run(&[]).stdout);
    let m = truth.to_homogeneous();
    let rows: Vec<Vec<f64>> = (0..4).map(|i| (0..4).map(|j| m[(i, j)]).collect()).collect();
    folder.put("matrix.json", &json!(rows).to_string());
    for (start, method, mm) in [
        ("first.json", "auto", 0.4),
        ("matrix.json", "symmetric", 0.4),
        ("matrix.json", "point-to-plane", 0.5),
        ("matrix.json", "gicp", 1.5),
    ] {
        let found_there = run(&["--initial", start, "--method", method, "--max-distance-mm", "20"]);
        let answer = found_there.json();
        let name = if method == "auto" { "symmetric" } else { method }; // its first name
        assert_eq!(answer["method"], name);
        let (_, off) = errors(&truth, &found(&answer));
        assert!(off < mm, "{start} {method}: {off} mm\n{}", found_there.stdout);
    }
}

#[test]
fn a_plane_alone_is_undetermined_and_says_so() {
    let table = Thing {
        solid: Solid::Block { half: [2.0, 2.0, 0.01] },
        room_from_thing: Isometry3::identity(),
    };
    let (source, target, _) = scans(&Room { things: vec![table] });
    let folder = Folder::new();
    folder.put("source.pcd", &pcd(&source, 1.0, true));
    folder.put("target.pcd", &pcd(&target, 1.0, true));
    let run = handeye(&folder, &["register", "source.pcd", "target.pcd", "--json"]);
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    let answer = run.json();
    assert_eq!(answer["verdict"], "undetermined");
    assert_eq!(answer["undetermined"].as_array().unwrap().len(), 3);
    assert_eq!(answer["covariance"], Value::Null);
}

#[test]
fn a_start_that_is_far_off_is_rejected() {
    let (source, target, _) = scans(&cell());
    let folder = Folder::new();
    folder.put("source.pcd", &pcd(&source, 1.0, true));
    folder.put("target.pcd", &pcd(&target, 1.0, true));
    folder.put("far.json", "{\"translation_m\": [0, 0, 3], \"rotation_xyzw\": [0, 0, 0, 1]}");
    let arguments = ["register", "source.pcd", "target.pcd", "--initial", "far.json", "--json"];
    let run = handeye(&folder, &arguments);
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    let answer = run.json();
    assert_eq!(answer["verdict"], "rejected");
    assert_eq!(answer["stop"], "no-matches");
    assert_eq!(answer["rms_mm"], Value::Null);
    assert!(answer["reasons"][0].as_str().unwrap().contains("better start"));
    let run = handeye(&folder, &arguments[..5]);
    assert!(run.stdout.contains("REJECTED"), "{}", run.stdout);
}

#[test]
fn what_cannot_be_used_is_named() {
    let (source, _, _) = scans(&cell());
    let folder = Folder::new();
    folder.put("source.pcd", &pcd(&source, 1.0, true));
    folder.put(
        "three.pcd",
        &pcd(&Scan::new(3, 1, source.points()[..3].to_vec()).unwrap(), 1.0, true),
    );
    folder.put("turned.json", "{\"translation_m\": [0, 0, 0], \"rotation_xyzw\": [1, 1, 0, 0]}");
    folder.put("mirror.json", "[[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]");
    folder.put("word.json", "{\"pose\": 3}");
    let cases: [(&[&str], i32, &str); 9] = [
        (&["source.pcd", "nowhere.pcd"], 1, "nowhere.pcd"),
        (&["source.pcd", "three.pcd"], 1, "shows no surface"),
        (&["source.pcd", "source.pcd", "--initial", "turned.json"], 1, "quaternion"),
        (&["source.pcd", "source.pcd", "--initial", "mirror.json"], 1, "rigid"),
        (&["source.pcd", "source.pcd", "--initial", "word.json"], 1, "word.json"),
        (&["source.pcd", "source.pcd", "--initial", "none.json"], 1, "none.json"),
        (&["source.pcd", "source.pcd", "--method", "magic"], 2, "magic"),
        (&["source.pcd", "source.pcd", "--max-distance-mm", "0"], 2, "positive"),
        (&["source.pcd", "source.pcd", "--max-iterations", "0"], 2, "positive"),
    ];
    for (arguments, code, named) in cases {
        let mut all = vec!["register"];
        all.extend(arguments);
        let run = handeye(&folder, &all);
        assert_eq!(run.code, code, "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains(named), "{arguments:?}: {}", run.stderr);
    }
}

/// Blocks on a table: what a drawing of a part has.
fn blocks() -> Room {
    let block = |half: [f64; 3], place: [f64; 3], turn: [f64; 3]| Thing {
        solid: Solid::Block { half },
        room_from_thing: Isometry3::new(place.into(), turn.into()),
    };
    Room {
        things: vec![
            block([0.3, 0.25, 0.01], [0.0, 0.0, -0.01], [0.0; 3]),
            block([0.06, 0.03, 0.04], [-0.1, 0.05, 0.04], [0.0, 0.0, 0.4]),
            block([0.04, 0.07, 0.06], [0.12, -0.06, 0.05], [0.2, 0.1, -0.5]),
            block([0.03, 0.03, 0.09], [0.05, 0.13, 0.08], [0.1, -0.3, 0.2]),
        ],
    }
}

/// The sides of all blocks, as two triangles each, in STL (text), mm.
fn stl(room: &Room) -> String {
    let mut text = "solid part\n".to_owned();
    for thing in &room.things {
        let Solid::Block { half } = thing.solid else { panic!("only blocks") };
        for (axis, side) in (0..3).flat_map(|axis| [(axis, -1.0), (axis, 1.0)]) {
            let corner = |(a, b): (f64, f64)| {
                let mut p = Vector3::zeros();
                p[axis] = side * half[axis];
                p[(axis + 1) % 3] = a * half[(axis + 1) % 3];
                p[(axis + 2) % 3] = b * half[(axis + 2) % 3];
                thing.room_from_thing.transform_point(&p.into()) * 1000.0
            };
            let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner);
            for k in [[0, 1, 2], [0, 2, 3]] {
                text += "facet normal 0 0 0\nouter loop\n";
                for c in k.map(|k| corners[k]) {
                    writeln!(text, "vertex {} {} {}", c.x, c.y, c.z).unwrap();
                }
                text += "endloop\nendfacet\n";
            }
        }
    }
    text + "endsolid part\n"
}

#[test]
fn a_scan_is_registered_to_a_mesh_of_what_it_shows() {
    let room = blocks();
    let place = Isometry3::new([0.02, -0.03, 0.8].into(), [PI, 0.0, 0.0].into())
        * Isometry3::new(Vector3::zeros(), [0.1, 0.2, 0.05].into());
    let camera = Intrinsics::pinhole(480, 360, 480.0, 480.0, 239.5, 179.5);
    let scan = room.scan(&place, &camera, 2e-4, &mut Random::new(5));
    let folder = Folder::new();
    folder.put("part.stl", &stl(&room));
    folder.put("scan.pcd", &pcd(&scan, 1.0, true));
    let seen = scan.points().iter().filter(|p| p[0].is_finite());
    let lines: String = seen.map(|p| format!("{};{};{}\n", p[0], p[1], p[2])).collect();
    folder.put("scan.csv", &format!("x_m;y_m;z_m\n{lines}"));
    let guess = place * Isometry3::new([0.01, -0.008, 0.012].into(), [0.02, -0.03, 0.02].into());
    let m = guess.to_homogeneous();
    let rows: Vec<Vec<f64>> = (0..4).map(|i| (0..4).map(|j| m[(i, j)]).collect()).collect();
    folder.put("guess.json", &json!(rows).to_string());
    for (scan, unit) in [("scan.pcd", None), ("scan.csv", Some("mm"))] {
        let mut arguments = vec!["register", scan, "part.stl", "--initial", "guess.json", "--json"];
        arguments.extend(unit.map(|unit| ["--length-unit", unit]).into_iter().flatten());
        let run = handeye(&folder, &arguments);
        assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
        let answer = run.json();
        let (degrees, mm) = errors(&place, &found(&answer));
        assert!(degrees < 0.05 && mm < 0.3, "{scan}: {degrees} deg, {mm} mm");
        let warned = answer["warnings"].as_array().unwrap();
        assert_eq!(warned.iter().any(|w| w["code"] == "unit-assumed"), unit.is_none());
        let points = answer["points"][1].as_u64().unwrap();
        assert!((200_000..=300_000).contains(&points), "{points}");
    }
    // the other way round
    let back: Vec<Vec<f64>> = {
        let m = guess.inverse().to_homogeneous();
        (0..4).map(|i| (0..4).map(|j| m[(i, j)]).collect()).collect()
    };
    folder.put("back.json", &json!(back).to_string());
    let arguments = ["register", "part.stl", "scan.pcd", "--initial", "back.json", "--json"];
    let answer = handeye(&folder, &arguments).json();
    let (degrees, mm) = errors(&place, &found(&answer).inverse());
    assert!(degrees < 0.05 && mm < 0.3, "{degrees} deg, {mm} mm");
}

#[test]
fn a_mesh_that_cannot_be_sampled_is_named() {
    let folder = Folder::new();
    folder.put("cut.stl", "solid part\nfacet normal 0 0 1\n");
    folder.put("point.obj", "v 1 1 1\nf 1 1 1\n");
    for (name, expected) in
        [("cut.stl", "cut.stl: is cut short"), ("point.obj", "point.obj: shows no surface")]
    {
        let run = handeye(&folder, &["register", name, name]);
        assert_eq!(run.code, 1, "{}", run.stdout);
        assert!(run.stderr.contains(expected), "{}", run.stderr);
    }
}
