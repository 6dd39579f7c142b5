//! The exported joint, read by the checker of the URDF library itself.

use std::process::Command;

use handeye::Setup;
use handeye_io::export::{CameraPose, Format, render};
use nalgebra::{Isometry3, Vector3};

#[test]
fn check_urdf_reads_the_joint() {
    if Command::new("check_urdf").output().is_err() {
        println!("SKIPPED: check_urdf (liburdfdom-tools) is not installed");
        return;
    }
    let pose = Isometry3::new(Vector3::new(0.1, -0.2, 0.3), Vector3::new(0.4, 1.5, -2.0));
    let camera = CameraPose {
        name: "base_from_camera",
        parent_from_child: pose,
        parent: "base",
        child: "camera",
        setup: Setup::EyeToHand,
    };
    let joint = String::from_utf8(render(&camera, &Format::named("urdf").unwrap())).unwrap();
    let joint = joint.split("?>").last().unwrap();
    let robot = format!(
        "<?xml version=\"1.0\"?><robot name=\"cell\"><link name=\"base\"/><link name=\"camera\"/>{joint}</robot>"
    );
    let path = std::env::temp_dir().join(format!("handeye-urdf-{}.urdf", std::process::id()));
    std::fs::write(&path, robot).unwrap();
    let output = Command::new("check_urdf").arg(&path).output().unwrap();
    std::fs::remove_file(&path).unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
    assert!(said.contains("root Link: base has 1 child"), "{said}");
    assert!(said.contains("child(1):  camera"), "{said}");
}
