//! Other programs read what we write: PyYAML, NumPy and OpenCV, where Python has them.
//! `HANDEYE_TEST_PYTHON` names the interpreter (default `python3`).

use std::{path::PathBuf, process::Command};

use handeye::Setup;
use handeye_io::export::{CameraPose, Format, render};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

fn python() -> String {
    std::env::var("HANDEYE_TEST_PYTHON").unwrap_or_else(|_| "python3".into())
}

/// What a script prints, or `None` with a printed reason when Python lacks the module.
fn run(module: &str, script: &str, file: &PathBuf) -> Option<Vec<f64>> {
    let import = Command::new(python()).args(["-c", &format!("import {module}")]).output();
    if !import.is_ok_and(|o| o.status.success()) {
        println!("skipped: {} has no module {module}", python());
        return None;
    }
    let output = Command::new(python()).args(["-c", script]).arg(file).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(text.split_whitespace().map(|w| w.parse().unwrap()).collect())
}

fn pose() -> CameraPose<'static> {
    CameraPose {
        name: "flange_from_camera",
        parent_from_child: Isometry3::from_parts(
            Translation3::new(0.0125, 1e-7, -0.3),
            UnitQuaternion::new(Vector3::new(0.01, 3.0, 0.7)),
        ),
        parent: "tool0",
        child: "camera",
        setup: Setup::EyeInHand,
    }
}

fn written(format: &str) -> PathBuf {
    let format = Format::named(format).unwrap();
    let folder = std::env::temp_dir().join(format!("handeye-oracle-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(format.file_name("pose"));
    handeye_io::write_atomically(&path, &render(&pose(), &format)).unwrap();
    path
}

fn matrix() -> Vec<f64> {
    pose().parent_from_child.to_homogeneous().transpose().iter().copied().collect()
}

/// Equal but for the digits that texts leave out.
fn near(values: &[f64], exact: &[f64]) -> bool {
    values.len() == exact.len() && values.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-12)
}

#[test]
fn numpy_loads_our_array_and_our_text() {
    let npy =
        "import sys, numpy; print(*[repr(float(v)) for v in numpy.load(sys.argv[1]).ravel()])";
    if let Some(values) = run("numpy", npy, &written("npy")) {
        assert_eq!(values, matrix());
    }
    let text =
        "import sys, numpy; print(*[repr(float(v)) for v in numpy.loadtxt(sys.argv[1]).ravel()])";
    if let Some(values) = run("numpy", text, &written("matrix4x4")) {
        assert!(near(&values, &matrix()), "{values:?}");
    }
}

#[test]
fn pyyaml_reads_numbers_as_numbers() {
    let script = "import sys, yaml; t = yaml.safe_load(open(sys.argv[1]))['transform']; \
                  v = [t['translation'][k] for k in 'xyz'] + [t['rotation'][k] for k in 'xyzw']; \
                  assert all(isinstance(x, float) for x in v), v; print(*[repr(x) for x in v])";
    let Some(values) = run("yaml", script, &written("easy-handeye2")) else { return };
    let iso = pose().parent_from_child;
    assert!(near(&values[..3], iso.translation.vector.as_slice()), "{values:?}");
    assert!(near(&values[3..], iso.rotation.coords.as_slice()), "{values:?}");
    let script = "import sys, yaml; m = yaml.safe_load(open(sys.argv[1]))['FloatMatrix']['Data']; \
                  print(*[repr(float(x)) for row in m for x in row])";
    if let Some(values) = run("yaml", script, &written("zivid-yaml")) {
        assert_eq!(values[11], -300.0);
        assert!(near(&values[..1], &matrix()[..1]), "{values:?}");
    }
}

#[test]
fn opencv_reads_its_file_storage() {
    let script = "import sys, cv2; f = cv2.FileStorage(sys.argv[1], cv2.FILE_STORAGE_READ); \
                  m = f.getNode('flange_from_camera').mat(); \
                  print(*[repr(float(v)) for v in m.ravel()])";
    if let Some(values) = run("cv2", script, &written("opencv-yaml")) {
        assert!(near(&values, &matrix()), "{values:?}");
    }
}

#[test]
fn archives_of_numpy_are_read_packed_or_not() {
    for save in ["savez", "savez_compressed"] {
        let path = std::env::temp_dir().join(format!("handeye-{save}-{}.npz", std::process::id()));
        let script = format!(
            "import sys, numpy; numpy.{save}(sys.argv[1], dist=numpy.array([[0.1, 0, 0, 0, 0.5]]), \
             mtx=numpy.asfortranarray([[600., 0, 320], [0, 601, 240], [0, 0, 1]])); print(1)"
        );
        if run("numpy", &script, &path).is_none() {
            return;
        }
        let camera = handeye_io::read_intrinsics(&path, None, Some((640, 480))).unwrap();
        assert_eq!((camera.fx, camera.fy, camera.cx, camera.cy), (600.0, 601.0, 320.0, 240.0));
        assert_eq!(camera.coefficients()[4], 0.5);
        std::fs::remove_file(path).unwrap();
    }
}

#[test]
fn the_launch_file_is_valid_python() {
    let script = "import sys, ast; ast.parse(open(sys.argv[1]).read()); print(1)";
    if let Some(values) = run("ast", script, &written("ros2-launch")) {
        assert_eq!(values, [1.0]);
    }
}
