use handeye::{Config, Verdict};
use nalgebra::{Isometry3, Vector3};

use super::*;
use crate::read_poses;

/// Where the camera sits on the flange.
fn flange_from_camera() -> Isometry3<f64> {
    Isometry3::new(Vector3::new(0.05, -0.02, 0.1), Vector3::new(0.1, 0.2, 1.5))
}

fn base_from_flange(t: f64) -> Isometry3<f64> {
    let place = Vector3::new(
        0.4 + 0.2 * (0.9 * t).sin(),
        0.2 * (0.7 * t).cos(),
        0.5 + 0.1 * (1.1 * t).sin(),
    );
    Isometry3::new(
        place,
        Vector3::new(2.8 + 0.4 * (0.8 * t).sin(), 0.5 * (0.6 * t).cos(), 0.6 * (0.5 * t).sin()),
    )
}

fn camera_from_target(t: f64) -> Isometry3<f64> {
    let base_from_target = Isometry3::new(Vector3::new(0.5, 0.1, 0.0), Vector3::new(0.0, 0.1, 0.3));
    (base_from_flange(t) * flange_from_camera()).inverse() * base_from_target
}

fn lines(
    header: &str,
    separator: &str,
    poses: impl Iterator<Item = (f64, Isometry3<f64>)>,
) -> String {
    let line = |(time, pose): (f64, Isometry3<f64>)| {
        let (p, q) = (pose.translation.vector, pose.rotation.coords);
        let numbers = [time, p.x, p.y, p.z, q.x, q.y, q.z, q.w].map(|x| format!("{x:.9}"));
        numbers.join(separator) + "\n"
    };
    header.to_string() + &poses.map(line).collect::<String>()
}

const OFFSET: f64 = 3.25;

/// A robot's file as ethz-asl writes it, a camera's as TUM; the camera's clock is ahead.
fn write(folder: &Path) {
    let robot = (0..600).map(|k| f64::from(k) * 0.02).map(|t| (t, base_from_flange(t)));
    fs::write(
        folder.join("hand_poses.csv"),
        lines("t, x, y, z, q_x, q_y, q_z, q_w\n", ", ", robot),
    )
    .unwrap();
    let camera = (5..55).map(|k| f64::from(k) * 0.21).map(|t| (t + OFFSET, camera_from_target(t)));
    fs::write(
        folder.join("target_poses.txt"),
        lines("# timestamp tx ty tz qx qy qz qw\n", " ", camera),
    )
    .unwrap();
}

fn directed(setup: Setup, names: &[&str]) -> Declared {
    let directions = names.iter().map(|name| Direction::named(name).unwrap()).collect();
    Declared { directions, ..of(setup) }
}

#[test]
fn two_trajectories_become_streams_that_are_calibrated() {
    let folder = folder("trajectories");
    write(&folder);
    let declared = directed(Setup::EyeInHand, &["base_from_flange"]);
    let imported = import(&folder, &declared).unwrap();
    assert!(imported.notes[2].starts_with("proven: as camera_from_target"), "{:?}", imported.notes);
    let path = folder.join(&imported.name);
    fs::write(&path, &imported.text).unwrap();
    let found = read_poses(&path).unwrap().calibrate(&Config::default()).unwrap();
    assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
    let apart = found.hand_eye.mount_from_camera.unwrap().iso().inverse() * flange_from_camera();
    assert!(apart.translation.vector.norm() < 1e-3 && apart.rotation.angle() < 1e-3, "{apart}");
    assert!((found.time_offset_s.unwrap() - OFFSET).abs() < 1e-3);
    fs::remove_dir_all(folder).ok();
}

#[test]
fn nanoseconds_and_scalars_in_front_are_understood() {
    let folder = folder("trajectories-euroc");
    write(&folder);
    let declared = directed(Setup::EyeInHand, &["base_from_flange", "camera_from_target"]);
    let usual = import(&folder, &declared).unwrap();
    let names = "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n";
    let robot = fs::read_to_string(folder.join("hand_poses.csv")).unwrap();
    let camera = fs::read_to_string(folder.join("target_poses.txt")).unwrap();
    let moved = |text: &str, by: char, since: i64| -> String {
        let line = |line: &str| {
            let mut cells: Vec<&str> = line.split(by).map(str::trim).collect();
            let time = (cells[0].parse::<f64>().unwrap() * 1e9).round() as i64 + since;
            let scalar = cells.pop().unwrap();
            cells.insert(4, scalar);
            format!("{time},{}\n", cells[1..].join(","))
        };
        text.lines().skip(1).map(line).collect()
    };
    let write = |robot: String, camera: String| {
        fs::write(folder.join("hand_poses.csv"), robot).unwrap();
        fs::write(folder.join("target_poses.txt"), camera).unwrap();
    };
    let solved = |imported: &Imported| {
        let path = folder.join(&imported.name);
        fs::write(&path, &imported.text).unwrap();
        read_poses(&path).unwrap().calibrate(&Config::default()).unwrap()
    };
    let expected = solved(&usual).hand_eye.mount_from_camera.unwrap();
    for since in [0, 1_403_636_580_838_555_648] {
        let texts = [moved(&robot, ',', since), moved(&camera, ' ', since)];
        write(format!("{names}{}", texts[0]), format!("{names}{}", texts[1]));
        let found = solved(&import(&folder, &declared).unwrap());
        assert!((found.time_offset_s.unwrap() - OFFSET).abs() < 1e-3);
        let apart = expected.iso().inverse() * found.hand_eye.mount_from_camera.unwrap().iso();
        assert!(apart.translation.vector.norm() < 1e-4, "{since}: {apart}");
    }
    let nameless = |text: &str| {
        text.lines()
            .skip(1)
            .map(|line| {
                let (time, rest) = line.split_once([',', ' ']).unwrap();
                format!("{} {}\n", 1e9 * time.parse::<f64>().unwrap(), rest.replace(',', " "))
            })
            .collect::<String>()
    };
    write(nameless(&robot), nameless(&camera));
    let error = import(&folder, &declared).unwrap_err().to_string();
    assert!(error.contains("hand_poses.csv: poses 20000000 s apart"), "{error}");
    fs::remove_dir_all(folder).ok();
}

#[test]
fn positions_are_in_the_unit_that_their_columns_name() {
    let folder = folder("trajectories-mm");
    write(&folder);
    let declared = directed(Setup::EyeInHand, &["base_from_flange", "camera_from_target"]);
    let expected = import(&folder, &declared).unwrap().text;
    let robot = fs::read_to_string(folder.join("hand_poses.csv")).unwrap();
    let line = |line: &str| {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        let mm = |k: usize| 1e3 * cells[k].parse::<f64>().unwrap();
        format!("{},{:.6},{:.6},{:.6},{}\n", cells[0], mm(1), mm(2), mm(3), cells[4..].join(","))
    };
    for header in
        ["t,x_mm,y_mm,z_mm,qx,qy,qz,qw\n", "# time, x [mm], y [mm], z [mm], qx, qy, qz, qw\n"]
    {
        let text: String = robot.lines().skip(1).map(line).collect();
        fs::write(folder.join("hand_poses.csv"), header.to_owned() + &text).unwrap();
        let imported = import(&folder, &declared).unwrap();
        let number = |text: &str| -> f64 {
            let (_, at) = text.split_once("translation_m\":[").unwrap();
            at.split(',').next().unwrap().parse().unwrap()
        };
        assert!((number(&imported.text) - number(&expected)).abs() < 1e-9, "{header}");
    }
    fs::remove_dir_all(folder).ok();
}

#[test]
fn what_trajectories_do_not_say_is_asked() {
    let folder = folder("trajectories-asked");
    write(&folder);
    let error = |declared: &Declared| import(&folder, declared).unwrap_err().to_string();
    assert!(error(&Declared::default()).contains("--setup is missing"));
    assert!(error(&of(Setup::EyeInHand)).contains("base_from_flange: where the flange is"));
    let both = directed(Setup::EyeInHand, &["base_from_flange", "flange_from_base"]);
    assert!(error(&both).contains("not as both"));
    let alone = import(&folder.join("hand_poses.csv"), &of(Setup::EyeInHand)).unwrap_err();
    assert!(alone.to_string().contains("name the camera's behind"), "{alone}");
    fs::copy(folder.join("hand_poses.csv"), folder.join("third.csv")).unwrap();
    let third = directed(Setup::EyeInHand, &["base_from_flange", "camera_from_target"]);
    assert!(import(&folder, &third).is_ok(), "names tell robot and camera");
    fs::copy(folder.join("hand_poses.csv"), folder.join("robot.csv")).unwrap();
    assert!(error(&third).contains("name the robot's, and behind it the camera's"));
    fs::remove_dir_all(folder).ok();
}

#[test]
fn data_that_do_not_tell_the_direction_leave_it_open() {
    let folder = folder("trajectories-still");
    let still = |from: i32| (from..from + 60).map(|k| (f64::from(k) * 0.1, base_from_flange(1.0)));
    fs::write(folder.join("robot.txt"), lines("", " ", still(0))).unwrap();
    fs::write(folder.join("camera.txt"), lines("", " ", still(3))).unwrap();
    let declared = directed(Setup::EyeToHand, &["camera_from_target"]);
    let error = import(&folder, &declared).unwrap_err().to_string();
    assert!(
        error.contains("base_from_flange or flange_from_base? The data do not tell"),
        "{error}"
    );
    fs::remove_dir_all(folder).ok();
}

#[test]
fn broken_trajectories_are_refused_with_their_line() {
    let folder = folder("trajectories-broken");
    write(&folder);
    let camera = folder.join("camera.txt");
    let declared = Declared {
        camera: Some(camera.clone()),
        ..directed(Setup::EyeInHand, &["base_from_flange", "camera_from_target"])
    };
    for (line, complaint) in [
        ("1.0 0 0 0 0 0 0 2", "length"),
        ("1.0 0 0 0 0 0 1", "has 7 values"),
        ("1.0 0 0 NaN 0 0 0 1", "NaN"),
    ] {
        fs::write(&camera, format!("# t x y z\n0.5 0 0 0 0 0 0 1\n{line}\n")).unwrap();
        let error = import(&folder.join("hand_poses.csv"), &declared).unwrap_err().to_string();
        assert!(error.contains("camera.txt:3") && error.contains(complaint), "{line}: {error}");
    }
    fs::remove_dir_all(folder).ok();
}
