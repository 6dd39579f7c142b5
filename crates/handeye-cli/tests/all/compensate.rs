//! Poses of a robot that errs from place to place, corrected: in every notation, and refused where that does not pay.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use serde_json::{Value, json};

use crate::folder::{Folder, handeye};

fn pose(rotation: [f64; 3], translation: [f64; 3]) -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(rotation));
    Isometry3::from_parts(Translation3::from(Vector3::from(translation)), rotation)
}

fn stored(pose: &Isometry3<f64>) -> Value {
    let (t, q) = (pose.translation.vector, pose.rotation.coords);
    json!({ "translation_m": [t.x, t.y, t.z], "rotation_xyzw": [q.x, q.y, q.z, q.w] })
}

/// What the robot reports, and what the camera on its flange sees, where it stands off by up to `size` (m), smoothly
/// from place to place.
fn capture(k: usize, size: f64) -> (Isometry3<f64>, Isometry3<f64>) {
    let flange_from_camera = pose([0.1, -0.2, 1.5], [0.03, -0.06, 0.09]);
    let base_from_target = pose([0.1, 3.0, 0.1], [0.6, 0.1, 0.02]);
    let wave = |n: f64| (k as f64 * n + 0.3 * n * n).sin();
    let really = pose(
        [0.2 + 0.6 * wave(1.1), 2.9 + 0.5 * wave(2.3), 0.7 * wave(3.7)],
        [0.5 + 0.2 * wave(1.7), 0.2 * wave(2.9), 0.5 + 0.15 * wave(4.3)],
    );
    let p = really.translation.vector;
    let off = Vector3::new((9.0 * p.y).sin(), (8.0 * p.z).sin(), (10.0 * p.x).cos()) * size;
    let reported = Translation3::from(off) * really;
    let noise = |n: f64| (k as f64 * 12.9898 * n + 78.233 * n).sin();
    let error = pose(
        [1e-4 * noise(1.0), 1e-4 * noise(2.0), 1e-4 * noise(3.0)],
        [3e-5 * noise(4.0), 3e-5 * noise(5.0), 3e-5 * noise(6.0)],
    );
    (reported, (really * flange_from_camera).inverse() * base_from_target * error)
}

/// The result of forty captures, in the folder `result`.
fn solved(folder: &Folder, size: f64) -> Value {
    let pair = |k: usize| {
        let (reported, seen) = capture(k, size);
        json!({ "base_from_flange": stored(&reported), "camera_from_target": stored(&seen) })
    };
    let pairs: Vec<Value> = (0..40).map(pair).collect();
    folder.put("pairs.json", &json!({ "setup": "eye-in-hand", "pairs": pairs }).to_string());
    let run = handeye(folder, &["solve", "pairs.json", "--json", "--quiet"]);
    folder.put("result/calibration.json", &run.stdout);
    run.json()
}

/// Reported poses of other captures, x y z in mm and a quaternion, as `poses.csv`.
fn put_more(folder: &Folder, size: f64) {
    let line = |k: usize| {
        let (reported, _) = capture(k, size);
        let (t, q) = (reported.translation.vector * 1e3, reported.rotation.coords);
        format!("c{k},{},{},{},{},{},{},{}\n", t.x, t.y, t.z, q.x, q.y, q.z, q.w)
    };
    let lines: String = (100..160).map(line).collect();
    folder.put("poses.csv", &format!("id,x,y,z,qx,qy,qz,qw\n{lines}"));
}

const POSES: [&str; 7] = [
    "compensate",
    "poses.csv",
    "--notation=quaternion-xyzw",
    "--length-unit=mm",
    "--direction=base_from_flange",
    "--result=result",
    "--quiet",
];

/// How far the target's place, seen from these poses of the flange, spreads (m, RMS).
fn spread(flanges: &[Isometry3<f64>], flange_from_camera: &Isometry3<f64>, size: f64) -> f64 {
    let at = |(k, flange): (usize, &Isometry3<f64>)| {
        (flange * flange_from_camera * capture(100 + k, size).1).translation.vector
    };
    let all: Vec<Vector3<f64>> = flanges.iter().enumerate().map(at).collect();
    let n = all.len() as f64;
    let mean = all.iter().sum::<Vector3<f64>>() / n;
    (all.iter().map(|p| (p - mean).norm_squared()).sum::<f64>() / n).sqrt()
}

fn read(value: &Value) -> Isometry3<f64> {
    let numbers = |key: &str| -> Vec<f64> { serde_json::from_value(value[key].clone()).unwrap() };
    let (t, q) = (numbers("translation_m"), numbers("rotation_xyzw"));
    let rotation =
        UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(q[3], q[0], q[1], q[2]));
    Isometry3::from_parts(Translation3::new(t[0], t[1], t[2]), rotation)
}

#[test]
fn reported_poses_are_put_where_the_flange_was() {
    let folder = Folder::new();
    let size = 1e-3;
    let calibration = solved(&folder, size);
    let found = &calibration["compensation"];
    assert!(found["model"].is_object(), "{found}");
    put_more(&folder, size);
    let run = handeye(&folder, &[&POSES[..], &["--reported", "--json"]].concat());
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let answer = run.json();
    let poses = answer["poses"].as_array().unwrap();
    let corrected: Vec<_> = poses.iter().map(|p| read(&p["base_from_flange"])).collect();
    let reported: Vec<_> = (100..160).map(|k| capture(k, size).0).collect();
    let x = read(&calibration["hand_eye"]["mount_from_camera"]);
    let (before, after) = (spread(&reported, &x, size), spread(&corrected, &x, size));
    assert!(after < 0.4 * before, "{after} instead of {before}");
    let inside = poses.iter().filter(|p| p["inside"] == true).count();
    assert!(inside > 50, "{inside}");
}

#[test]
fn what_is_sent_comes_back_as_it_was_reported_in_the_notation_it_had() {
    let folder = Folder::new();
    let _ = solved(&folder, 1e-3);
    put_more(&folder, 1e-3);
    // where it is sent to be there, and where it is when it reports that
    let run = handeye(&folder, &[&POSES[..], &["--out=sent.csv"]].concat());
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let numbers = |name: &str| -> Vec<Vec<f64>> {
        let text = folder.read(name);
        let line = |l: &str| l.split(',').skip(1).map(|x| x.parse().unwrap()).collect();
        text.lines().skip(1).map(line).collect()
    };
    let (asked, sent) = (numbers("poses.csv"), numbers("sent.csv"));
    assert_eq!(asked.len(), sent.len());
    let far =
        |(a, b): (&Vec<f64>, &Vec<f64>)| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
    let most = asked.iter().zip(&sent).map(far).fold(0.0, f64::max);
    assert!((0.3..4.0).contains(&most), "{most} mm");
}

#[test]
fn a_robot_that_is_exact_is_offered_no_correction() {
    let folder = Folder::new();
    let _ = solved(&folder, 0.0);
    put_more(&folder, 0.0);
    let run = handeye(&folder, &POSES);
    assert_eq!(run.code, 3, "{}", run.stdout);
    assert!(run.stderr.contains("result: "), "{}", run.stderr);
    let run = handeye(&folder, &[&POSES[..], &["--json"]].concat());
    assert_eq!((run.code, &run.json()["offered"]), (3, &json!(false)));
}
