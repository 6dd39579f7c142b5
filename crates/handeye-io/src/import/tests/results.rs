use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::*;
use crate::{
    export::{CameraPose, Format, render},
    result_file::read_result,
};

fn truth() -> Isometry3<f64> {
    let turn = UnitQuaternion::new(Vector3::new(0.3, -2.0, 0.7));
    Isometry3::from_parts(Translation3::new(0.5, -0.25, 0.7), turn)
}

fn directed(name: &str) -> Declared {
    Declared { directions: vec![Direction::named(name).unwrap()], ..Declared::default() }
}

/// The setup and pose that a file is imported as.
fn imported(folder: &Path, name: &str, text: &str, declared: &Declared) -> (Setup, Isometry3<f64>) {
    let file = folder.join(name);
    fs::write(&file, text).unwrap();
    let imported = import(&file, declared).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let path = folder.join(&imported.name);
    fs::write(&path, &imported.text).unwrap();
    let result = read_result(&path).unwrap();
    assert!(result.is_unjudged() && result.hand_eye.covariance.mount_from_camera.is_none());
    (result.setup, *result.hand_eye.mount_from_camera.unwrap().iso())
}

fn refused(folder: &Path, name: &str, text: &str, declared: &Declared) -> String {
    let file = folder.join(name);
    fs::write(&file, text).unwrap();
    import(&file, declared).unwrap_err().to_string()
}

fn same(a: &Isometry3<f64>, b: &Isometry3<f64>, what: &str) {
    let apart = a.inverse() * b;
    assert!(
        apart.translation.vector.norm() < 1e-9 && apart.rotation.angle() < 1e-7,
        "{what}: {apart}"
    );
}

#[test]
fn what_is_exported_comes_back_as_it_was() {
    let folder = folder("back");
    let programs =
        ["ros2-launch", "easy-handeye2", "moveit", "opencv-yaml", "zivid-yaml", "halcon"];
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let name = format!("{}_from_camera", setup.mount());
        let pose = CameraPose {
            name: &name,
            parent_from_child: truth(),
            parent: "body",
            child: "camera_optical",
            setup,
        };
        for program in programs {
            let format = Format::named(program).unwrap();
            let text = String::from_utf8(render(&pose, &format)).unwrap();
            let (own, found) = imported(&folder, &format.file_name("result"), &text, &of(setup));
            assert_eq!(own, setup, "{program}");
            same(&found, &truth(), program);
        }
    }
    fs::remove_dir_all(folder).ok();
}

#[test]
fn easy_handeye_of_ros_1_says_who_carries_the_camera() {
    let folder = folder("easy1");
    let text = |on_hand: bool| {
        format!(
            "parameters:\n  eye_on_hand: {on_hand}\n  tracking_base_frame: camera_link\n\
             transformation: {{x: 0.5, y: -0.25, z: 0.7, qx: 0.6, qy: 0.0, qz: 0.8, qw: 0.0}}\n"
        )
    };
    for (on_hand, setup) in [(true, Setup::EyeInHand), (false, Setup::EyeToHand)] {
        let (found, pose) = imported(&folder, "cell.yaml", &text(on_hand), &Declared::default());
        assert_eq!(found, setup);
        assert_eq!(pose.translation.vector, Vector3::new(0.5, -0.25, 0.7));
        assert_eq!(pose.rotation.k, 0.8);
    }
    let file = folder.join("cell.yaml");
    let notes = import(&file, &Declared::default()).unwrap().notes;
    assert!(notes[0].contains("camera_link is taken as the camera's optical frame"), "{notes:?}");
    let error = refused(&folder, "cell.yaml", &text(true), &of(Setup::EyeToHand));
    assert!(error.contains("says that it is eye-in-hand"), "{error}");
    let error = refused(
        &folder,
        "cell.yaml",
        &text(true).replace("qw: 0.0", "qw: 0.9"),
        &Declared::default(),
    );
    assert!(error.contains("length"), "{error}");
    fs::remove_dir_all(folder).ok();
}

#[test]
fn launch_files_are_read_in_all_their_notations() {
    let folder = folder("launch");
    let xml = |program: &str, args: &str| {
        format!(
            "<launch><node pkg=\"tf2_ros\" {program}=\"static_transform_publisher\" args=\"{args}\"/></launch>"
        )
    };
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let flags = format!("--x 1 --qz {half} --qw {half} --frame-id a --child-frame-id b");
    let ways = [
        ("type", format!("1 0 0  0 0 {half} {half} a b")),
        ("type", format!("1 0 0  {} 0 0 a b 100", std::f64::consts::FRAC_PI_2)),
        ("exec", flags),
        (
            "exec",
            format!("--x 1 --yaw {} --frame-id a --child-frame-id b", std::f64::consts::FRAC_PI_2),
        ),
    ];
    let expected = Isometry3::new(Vector3::x(), Vector3::z() * std::f64::consts::FRAC_PI_2);
    for (program, args) in ways {
        let (_, pose) = imported(&folder, "a.launch", &xml(program, &args), &of(Setup::EyeToHand));
        same(&pose, &expected, &args);
    }
    let error = refused(&folder, "a.launch", &xml("type", "1 2 3 a b"), &of(Setup::EyeToHand));
    assert!(error.contains("PARENT CHILD"), "{error}");
    let error =
        refused(&folder, "a.launch", &xml("type", "1 0 0 0 0 0 1 a b"), &Declared::default());
    assert!(error.contains("--setup is missing; who carries the camera"), "{error}");
    let two = xml("type", "0 0 0 0 0 0 1 a b").replace("</launch>", &xml("type", ""));
    let error = refused(&folder, "a.launch", &(two + "</launch>"), &of(Setup::EyeToHand));
    assert!(error.contains("more than one"), "{error}");
    fs::remove_dir_all(folder).ok();
}

#[test]
fn a_launch_file_whose_parent_is_the_camera_is_turned_around() {
    let folder = folder("launch-inverse");
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let text = |frames: &str| {
        format!(
            "<launch><node exec=\"static_transform_publisher\" args=\"0.5 0 0 0 0 {half} {half} {frames}\"/></launch>"
        )
    };
    let published = Isometry3::new(0.5 * Vector3::x(), Vector3::z() * std::f64::consts::FRAC_PI_2);
    let ways = [
        ("tool0 camera_color_optical_frame", published),
        ("camera_color_optical_frame tool0", published.inverse()),
        ("camera_link camera_optical_frame", published),
    ];
    for (frames, expected) in ways {
        let (_, pose) = imported(&folder, "a.launch", &text(frames), &of(Setup::EyeInHand));
        same(&pose, &expected, frames);
    }
    fs::remove_dir_all(folder).ok();
}

#[test]
fn what_no_camera_can_be_is_refused() {
    let folder = folder("impossible");
    let timeout = "ExtrinsicParameters:\n0,0,0,1,0,0,0\n";
    let error = refused(&folder, "a.txt", timeout, &of(Setup::EyeToHand));
    assert!(error.contains("exactly into the base: programs write this"), "{error}");
    let far = "ExtrinsicParameters:\n500,0,700,1,0,0,0\n";
    let in_m = |setup| Declared { length_unit: Some(crate::units::LengthUnit::Metre), ..of(setup) };
    let error = refused(&folder, "a.txt", far, &in_m(Setup::EyeInHand));
    assert!(
        error.contains("860.2 m away from the flange") && error.contains("--length-unit"),
        "{error}"
    );
    fs::remove_dir_all(folder).ok();
}

#[test]
fn a_pose_of_halcon_is_read_in_the_direction_that_is_said() {
    let folder = folder("halcon-pose");
    let dat = "f 0\nr 0 0 90\nt 1 0 0\n";
    let error = refused(&folder, "pose.dat", dat, &of(Setup::EyeInHand));
    assert!(
        error.contains("is the pose flange_from_camera") && error.contains("calibrate_hand_eye"),
        "{error}"
    );
    let camera = Isometry3::new(Vector3::x(), Vector3::z() * std::f64::consts::FRAC_PI_2);
    let ways = [
        ("pose.dat", "flange_from_camera", Setup::EyeInHand, camera),
        ("pose.dat", "camera_from_flange", Setup::EyeInHand, camera.inverse()),
        ("pose.dat", "camera_from_base", Setup::EyeToHand, camera.inverse()),
    ];
    for (name, direction, setup, expected) in ways {
        let (found, pose) = imported(&folder, name, dat, &directed(direction));
        assert_eq!(found, setup, "{direction}");
        same(&pose, &expected, direction);
    }
    let (setup, pose) = imported(&folder, "base_in_cam_pose.dat", dat, &Declared::default());
    assert_eq!(setup, Setup::EyeToHand);
    same(&pose, &camera.inverse(), "by its name");
    let error = refused(&folder, "ToolInCamPose.dat", dat, &directed("flange_from_camera"));
    assert!(error.contains("other direction"), "{error}");
    fs::remove_dir_all(folder).ok();
}

#[test]
fn mech_mind_and_zivid_count_in_millimetres() {
    let folder = folder("mm");
    let texts = [
        ("ExtrinsicParameters20260101.txt", "ExtrinsicParameters:\n500,-250,700,0.0,0.6,0.0,0.8\n"),
        (
            "extrinsic.txt",
            "ExtrinsicParameters:\nx: 500 y: -250 z: 700 qx: 0.6 qy: 0 qz: 0.8 qw: 0\n",
        ),
        (
            "pos.yaml",
            "%YAML:1.0\n---\nPoseState: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [ \
             -0.28, 0., 0.96, 500., 0., -1., 0., -250., 0.96, 0., 0.28, 700., 0., 0., 0., 1. ]\n",
        ),
        (
            "transform.yaml",
            "__version__:\n  serializer: 1\n  data: 1\nFloatMatrix:\n  Data:\n    [[-0.28, 0, 0.96, 500], \
             [0, -1, 0, -250], [0.96, 0, 0.28, 700], [0, 0, 0, 1]]\n",
        ),
    ];
    let turn = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(0.0, 0.6, 0.0, 0.8));
    let expected = Isometry3::from_parts(Translation3::new(0.5, -0.25, 0.7), turn);
    for (name, text) in texts {
        let (_, pose) = imported(&folder, name, text, &of(Setup::EyeToHand));
        same(&pose, &expected, name);
    }
    let error = refused(&folder, "e.txt", "ExtrinsicParameters:\n1 2 3\n", &of(Setup::EyeToHand));
    assert!(error.contains("3 numbers behind ExtrinsicParameters:"), "{error}");
    let foreign = texts[2].1.replace("PoseState", "X");
    let error = refused(&folder, "x.yaml", &foreign, &of(Setup::EyeToHand));
    assert!(error.contains("--length-unit is missing"), "{error}");
    let millimetres = Declared {
        length_unit: Some(crate::units::LengthUnit::Millimetre),
        ..directed("camera_from_base")
    };
    let (_, pose) = imported(&folder, "x.yaml", &foreign, &millimetres);
    same(&pose, &expected.inverse(), "as declared");
    fs::remove_dir_all(folder).ok();
}

#[test]
fn transforms_of_opencv_are_read_by_their_names() {
    let folder = folder("opencv");
    let matrix = |name: &str, rows: u32, cols: u32, data: &str| {
        format!(
            "{name}: !!opencv-matrix\n   rows: {rows}\n   cols: {cols}\n   dt: d\n   data: [ {data} ]\n"
        )
    };
    let file = |entries: &[String]| format!("%YAML:1.0\n---\n{}", entries.concat());
    let turn = "-0.28, 0., 0.96, 0., -1., 0., 0.96, 0., 0.28";
    let expected = Isometry3::from_parts(
        Translation3::new(0.5, -0.25, 0.7),
        UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(0.0, 0.6, 0.0, 0.8)),
    );
    let whole = "-0.28, 0., 0.96, 500., 0., -1., 0., -250., 0.96, 0., 0.28, 700., 0., 0., 0., 1.";
    let rows = whole.strip_suffix(", 0., 0., 0., 1.").unwrap();
    let other = "1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.";
    let [r, t] = [(3, 3, turn), (3, 1, "500., -250., 700.")];
    let both = |suffix: &str| {
        [("R", r), ("t", t)]
            .map(|(name, (rows, cols, data))| matrix(&format!("{name}{suffix}"), rows, cols, data))
            .concat()
    };
    let camera = matrix("camera_matrix", 3, 3, "900., 0., 320., 0., 900., 240., 0., 0., 1.");
    let in_mm =
        |declared| Declared { length_unit: Some(crate::units::LengthUnit::Millimetre), ..declared };
    let named = [
        (file(&[both("_cam2gripper")]), Setup::EyeInHand, false),
        (
            file(&[both("_cam2base"), camera, matrix("T_base2gripper", 4, 4, other)]),
            Setup::EyeToHand,
            false,
        ),
        (file(&[matrix("T_cam2base", 4, 4, whole)]), Setup::EyeToHand, false),
        (
            file(&[
                matrix("X", 3, 4, rows),
                matrix("dist", 1, 12, &("0.1, ".repeat(11) + "0.1")),
                matrix("cam2base", 3, 4, rows),
            ]),
            Setup::EyeToHand,
            false,
        ),
        (file(&[matrix("gripper2cam", 4, 4, whole)]), Setup::EyeInHand, true),
        (file(&[matrix("H_camera_to_base", 4, 4, whole)]), Setup::EyeToHand, false),
        (
            file(&[matrix("rvec_cam2base", 3, 1, "0., 0., 0."), both("_cam2gripper")]),
            Setup::EyeInHand,
            false,
        ),
    ];
    for (text, setup, is_inverse) in &named {
        let (found, pose) = imported(&folder, "cv.yaml", text, &in_mm(Declared::default()));
        assert_eq!(found, *setup, "{text}");
        let expected = if *is_inverse { expected.inverse() } else { expected };
        same(&pose, &expected, text);
    }
    let (_, pose) =
        imported(&folder, "cv.yaml", &file(&[both("")]), &in_mm(directed("base_from_camera")));
    same(&pose, &expected, "R and t alone");
    let error = refused(&folder, "cv.yaml", &named[0].0, &Declared::default());
    assert!(error.contains("--length-unit is missing; is the position in cam2gripper"), "{error}");
    let two = file(&[both(""), matrix("A", 4, 4, other)]);
    let error = refused(&folder, "cv.yaml", &two, &in_mm(of(Setup::EyeInHand)));
    assert!(error.contains("holds A, R and t: leave one in it"), "{error}");
    let stretched = named[2].0.replace("0.96", "1.96");
    let error = refused(&folder, "cv.yaml", &stretched, &in_mm(Declared::default()));
    assert!(error.contains("rotation") || error.contains("orthogonal"), "{error}");
    fs::remove_dir_all(folder).ok();
}

#[test]
fn a_pose_without_names_of_frames_is_no_result() {
    let folder = folder("nameless");
    let path = folder.join("pose.json");
    for (text, complaint) in [
        (r#"{"translation_m": [0, 0, 0], "rotation_xyzw": [0, 0, 0, 1]}"#, "\"to\" must be"),
        (
            r#"{"to": "base", "from": "tool", "translation_m": [0, 0, 0], "rotation_xyzw": [0, 0, 0, 1]}"#,
            "expected",
        ),
        (
            r#"{"to": "base", "from": "camera", "translation_m": [0, 0, 0], "rotation_xyzw": [0, 0, 0, 2]}"#,
            "length 2",
        ),
        ("[]", "is no calibration.json"),
    ] {
        fs::write(&path, text).unwrap();
        let error = read_result(&path).unwrap_err().to_string();
        assert!(error.contains(complaint), "{text}: {error}");
    }
    fs::remove_dir_all(folder).ok();
}
