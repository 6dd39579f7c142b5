//! What is exported for ROS, HALCON and robots, read by others than we are: Python's XML and AST, SciPy's rotations. They
//! read by each format's own definition, and must find the pose. `HANDEYE_TEST_PYTHON` names the interpreter (default
//! `python3`). NumPy, OpenCV and PyYAML are in `python_oracles`, the URDF library is in `urdf`.

use std::{path::PathBuf, process::Command};

use handeye::Setup;
use handeye_io::export::{CameraPose, Format, render};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

fn pose() -> CameraPose<'static> {
    CameraPose {
        name: "base_from_camera",
        parent_from_child: Isometry3::from_parts(
            Translation3::new(0.5125, 1e-7, -0.3),
            UnitQuaternion::new(Vector3::new(0.4, 1.3, -0.7)),
        ),
        parent: "base_link",
        child: "camera_optical_frame",
        setup: Setup::EyeToHand,
    }
}

fn python() -> String {
    std::env::var("HANDEYE_TEST_PYTHON").unwrap_or_else(|_| "python3".into())
}

fn has(module: &str) -> bool {
    let import = Command::new(python()).args(["-c", &format!("import {module}")]).output();
    let has = import.is_ok_and(|o| o.status.success());
    if !has {
        println!("SKIPPED: {} has no module {module}", python());
    }
    has
}

/// The matrices that scripts find in exports, each in its own.
fn found(scripts: &[(String, String)]) -> Vec<Vec<f64>> {
    let read = |(format, script): &(String, String)| {
        let path = written(format);
        format!("\ntext = open(r'{}').read()\n{script}\n{PRINT}\n", path.display())
    };
    let program = HEAD.to_owned() + &scripts.iter().map(read).collect::<String>();
    let run = Command::new(python()).args(["-c", &program]).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let numbers = |line: &str| line.split_whitespace().map(|w| w.parse().unwrap()).collect();
    String::from_utf8(run.stdout).unwrap().lines().map(numbers).collect()
}

fn written(format: &str) -> PathBuf {
    let format = Format::named(format).unwrap();
    let folder = std::env::temp_dir().join(format!("handeye-read-back-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(format.file_name("pose"));
    std::fs::write(&path, render(&pose(), &format)).unwrap();
    path
}

const HEAD: &str = "
import sys, re, types, numpy as np
import xml.etree.ElementTree as xml
from scipy.spatial.transform import Rotation as R
def matrix(p, r):
    m = np.eye(4); m[:3, :3] = r.as_matrix(); m[:3, 3] = p
    return m
def numbers(s):
    return [float(w) for w in re.findall(r'[-+]?[0-9.]+(?:e[-+]?[0-9]+)?', s)]
";

const PRINT: &str = "print(*[repr(float(v)) for v in m.ravel()])";

#[track_caller]
fn is_the_pose(format: &str, script: &str, within: f64) {
    are_the_pose(&[(format.into(), script.into())], within);
}

#[track_caller]
fn are_the_pose(scripts: &[(String, String)], within: f64) {
    if !has("scipy.spatial.transform") {
        return;
    }
    let all = found(scripts);
    assert_eq!(all.len(), scripts.len());
    let matrix = pose().parent_from_child.to_homogeneous().transpose();
    for ((format, _), values) in scripts.iter().zip(all) {
        let apart = matrix.iter().zip(&values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(values.len() == 16 && apart < within, "{format}: {apart} in {values:?}");
    }
}

#[test]
fn the_ros_2_launch_file_starts_a_publisher_of_the_pose() {
    let script = "
launch, actions = types.ModuleType('launch'), types.ModuleType('launch_ros.actions')
launch.LaunchDescription, actions.Node = list, dict
sys.modules.update({'launch': launch, 'launch_ros': types.ModuleType('launch_ros'), 'launch_ros.actions': actions})
space = {}
exec(text, space)
(node,) = space['generate_launch_description']()
assert (node['package'], node['executable']) == ('tf2_ros', 'static_transform_publisher')
a = dict(zip(node['arguments'][::2], node['arguments'][1::2]))
assert (a['--frame-id'], a['--child-frame-id']) == ('base_link', 'camera_optical_frame')
m = matrix([float(a[k]) for k in ('--x', '--y', '--z')], R.from_quat([float(a['--q' + k]) for k in 'xyzw']))";
    is_the_pose("ros2-launch", script, 1e-11);
}

#[test]
fn the_urdf_joint_holds_the_pose() {
    let script = "
joint = xml.fromstring(text)
assert (joint.find('parent').get('link'), joint.find('child').get('link')) == ('base_link', 'camera_optical_frame')
origin = joint.find('origin')
# fixed axes: roll about x, then pitch about y, then yaw about z
m = matrix(numbers(origin.get('xyz')), R.from_euler('xyz', numbers(origin.get('rpy'))))";
    is_the_pose("urdf", script, 1e-11);
}

#[test]
fn the_launch_file_of_moveit_holds_the_pose_twice() {
    let arguments = "
node = xml.fromstring(text).find('node')
words = node.get('args').split()
assert words[7:] == ['base_link', 'camera_optical_frame']
m = matrix([float(w) for w in words[:3]], R.from_quat([float(w) for w in words[3:7]]))";
    is_the_pose("moveit", arguments, 1e-11);
    let comment = "
xyz, rpy = re.search(r'xyz=\"([^\"]*)\" rpy=\"([^\"]*)\"', text).groups()
m = matrix(numbers(xyz), R.from_euler('xyz', numbers(rpy)))";
    is_the_pose("moveit", comment, 1e-11);
}

#[test]
fn halcons_pose_is_the_base_in_the_camera() {
    let script = "
line = {l.split()[0]: l.split()[1:] for l in text.splitlines() if l and not l.startswith('#')}
assert line['f'] == ['0'] # Rp+T, gba, point: rotations about the moving axes x, y, z
r = R.from_euler('XYZ', [float(w) for w in line['r']], degrees=True)
m = np.linalg.inv(matrix([float(w) for w in line['t']], r))";
    is_the_pose("halcon", script, 1e-9);
}

#[test]
fn easy_handeye_and_zivid_hold_the_pose_in_their_units() {
    let script = "
import yaml
t = yaml.safe_load(text)['transform']
m = matrix([t['translation'][k] for k in 'xyz'], R.from_quat([t['rotation'][k] for k in 'xyzw']))";
    if has("yaml") {
        is_the_pose("easy-handeye2", script, 1e-11);
        let script = "
import yaml
m = np.array(yaml.safe_load(text)['FloatMatrix']['Data'])
m[:3, 3] /= 1000";
        is_the_pose("zivid-yaml", script, 1e-11);
    }
}

/// Each maker's notation: how SciPy makes a rotation of the numbers behind the position, and millimetres or metres.
const ROBOTS: [(&str, &str, f64); 13] = [
    ("ur", "R.from_rotvec(n)", 1.0),
    ("ur-rpy", "R.from_euler('xyz', n)", 1.0),
    ("kuka", "R.from_euler('ZYX', n, degrees=True)", 1e-3),
    ("fanuc", "R.from_euler('xyz', n, degrees=True)", 1e-3),
    ("abb", "R.from_quat(n, scalar_first=True)", 1e-3),
    ("yaskawa", "R.from_euler('xyz', n, degrees=True)", 1e-3),
    ("kawasaki", "R.from_euler('ZYZ', n, degrees=True)", 1e-3),
    ("staubli", "R.from_euler('XYZ', n, degrees=True)", 1e-3),
    ("doosan", "R.from_euler('ZYZ', n, degrees=True)", 1e-3),
    ("denso", "R.from_euler('xyz', n, degrees=True)", 1e-3),
    ("quaternion-xyzw", "R.from_quat(n)", 1.0),
    ("quaternion-wxyz", "R.from_quat(n, scalar_first=True)", 1.0),
    ("rotation-vector", "R.from_rotvec(n)", 1.0),
];

#[test]
fn every_robots_notation_turns_as_its_maker_says() {
    let left: Vec<&str> = Format::names()
        .into_iter()
        .filter(|name| !ROBOTS.iter().any(|(robot, ..)| robot == name))
        .collect();
    let elsewhere = [
        "ros2-launch",
        "urdf",
        "easy-handeye2",
        "moveit",
        "opencv-yaml",
        "zivid-yaml",
        "halcon",
        "npy",
        "matrix4x4",
    ];
    assert_eq!(left, elsewhere, "a format that nobody reads back");
    let script = |(name, rotation, metres): (&str, &str, f64)| {
        let numbers = "v = numbers(text.splitlines()[1])\nn = v[3:]";
        (name.into(), format!("{numbers}\nm = matrix(np.array(v[:3]) * {metres}, {rotation})"))
    };
    are_the_pose(&ROBOTS.map(script), 1e-9);
}

#[test]
fn all_orders_of_euler_angles_turn_as_they_are_called() {
    let axes = ["xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"];
    let script = |sense: &str, order: &str, own: &str| {
        let turn = format!("R.from_euler('{own}', v[3:], degrees=True)");
        let script = format!("v = numbers(text.splitlines()[1])\nm = matrix(v[:3], {turn})");
        (format!("euler-{order}-{sense}"), script)
    };
    let both = |order: &&str| {
        [script("extrinsic", order, order), script("intrinsic", order, &order.to_uppercase())]
    };
    are_the_pose(&axes.iter().flat_map(both).collect::<Vec<_>>(), 1e-9);
}
