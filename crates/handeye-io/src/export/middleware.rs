//! ROS: static transforms, URDF, easy_handeye2 and moveit_calibration.

use handeye::{Setup, quaternion_xyzw};

use super::{CameraPose, METRES, TURNS, number, numbers};
use crate::{robot::Notation, xml::escape};

/// Translation and quaternion, `x y z qx qy qz qw`.
fn seven(pose: &CameraPose) -> [String; 7] {
    let t = pose.parent_from_child.translation.vector;
    let [x, y, z] = [t.x, t.y, t.z].map(|v| number(v, METRES));
    let [qx, qy, qz, qw] =
        quaternion_xyzw(&pose.parent_from_child.rotation).map(|v| number(v, TURNS));
    [x, y, z, qx, qy, qz, qw]
}

/// Roll, pitch, yaw about the fixed axes (rad).
fn rpy(pose: &CameraPose) -> String {
    Notation::named("ur-rpy")
        .map(|n| numbers(&n.values(&pose.parent_from_child, n.own_units())[3..], TURNS, " "))
        .unwrap_or_default()
}

pub(super) fn ros2_launch(pose: &CameraPose) -> String {
    let flags = ["--x", "--y", "--z", "--qx", "--qy", "--qz", "--qw"];
    let arguments: String = flags
        .iter()
        .zip(seven(pose))
        .map(|(flag, v)| format!("                '{flag}', '{v}',\n"))
        .collect();
    format!(
        "from launch import LaunchDescription\n\
         from launch_ros.actions import Node\n\n\n\
         def generate_launch_description():\n    \
             return LaunchDescription([\n        \
                 Node(\n            \
                     package='tf2_ros',\n            \
                     executable='static_transform_publisher',\n            \
                     name='{}',\n            \
                     arguments=[\n{arguments}                \
                         '--frame-id', '{}',\n                \
                         '--child-frame-id', '{}',\n            \
                     ],\n        \
                 ),\n    \
             ])\n",
        in_python(pose.name),
        in_python(pose.parent),
        in_python(pose.child)
    )
}

/// Text inside single quotes of Python.
fn in_python(text: &str) -> String {
    text.replace('\\', "\\\\").replace('\'', "\\'").replace('\n', "\\n")
}

pub(super) fn urdf(pose: &CameraPose) -> String {
    format!(
        "<joint name=\"{}\" type=\"fixed\">\n  \
           <parent link=\"{}\"/>\n  \
           <child link=\"{}\"/>\n  \
           <origin xyz=\"{}\" rpy=\"{}\"/>\n\
         </joint>\n",
        escape(pose.name),
        escape(pose.parent),
        escape(pose.child),
        seven(pose)[..3].join(" "),
        rpy(pose),
    )
}

pub(super) fn easy_handeye(pose: &CameraPose) -> String {
    let (kind, base, effector) = match pose.setup {
        Setup::EyeInHand => ("eye_in_hand", "base_link".into(), in_yaml(pose.parent)),
        Setup::EyeToHand => ("eye_on_base", in_yaml(pose.parent), "tool0".into()),
    };
    let [x, y, z, qx, qy, qz, qw] = seven(pose);
    format!(
        "parameters:\n  \
           name: {}\n  \
           calibration_type: {kind}\n  \
           robot_base_frame: {base}\n  \
           robot_effector_frame: {effector}\n  \
           tracking_base_frame: {}\n  \
           tracking_marker_frame: handeye_target\n  \
           freehand_robot_movement: true\n  \
           move_group_namespace: /\n  \
           move_group: manipulator\n\
         transform:\n  \
           translation:\n    x: {x}\n    y: {y}\n    z: {z}\n  \
           rotation:\n    x: {qx}\n    y: {qy}\n    z: {qz}\n    w: {qw}\n",
        pose.name,
        in_yaml(pose.child)
    )
}

/// A name as YAML: in quotation marks where it would be read as something else.
fn in_yaml(name: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-/".contains(c);
    let begins = name.starts_with(|c: char| c.is_ascii_alphabetic());
    match begins && name.chars().all(is_plain) {
        true => name.into(),
        false => serde_json::Value::from(name).to_string(),
    }
}

pub(super) fn moveit(pose: &CameraPose) -> String {
    format!(
        "<launch>\n  \
           <!-- The rpy in the comment uses the extrinsic XYZ convention, which is the same as is used in a URDF. -->\n  \
           <!-- xyz=\"{}\" rpy=\"{}\" -->\n  \
           <node pkg=\"tf2_ros\" type=\"static_transform_publisher\" name=\"camera_link_broadcaster\"\n      \
               args=\"{} {} {}\" />\n\
         </launch>\n",
        seven(pose)[..3].join(" "),
        rpy(pose),
        seven(pose).join(" "),
        escape(pose.parent),
        escape(pose.child),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{export::tests::example, robot::Units, tree::Tree, units::*};

    #[test]
    fn quotes_in_a_name_do_not_end_a_launch_files_text() {
        let launch = ros2_launch(&CameraPose { parent: "it's", ..example() });
        assert!(launch.contains(r"'--frame-id', 'it\'s',"), "{launch}");
    }

    #[test]
    fn urdf_angles_turn_about_the_fixed_axes() {
        let text = urdf(&example());
        let document = roxmltree::Document::parse(&text).unwrap();
        let origin = document.descendants().find(|n| n.has_tag_name("origin")).unwrap();
        let read = |key: &str| -> Vec<f64> {
            origin.attribute(key).unwrap().split(' ').map(|w| w.parse().unwrap()).collect()
        };
        let notation = Notation::named("euler-xyz-extrinsic").unwrap();
        let units = Units { length: LengthUnit::Metre, angle: AngleUnit::Radian };
        let values = [read("xyz"), read("rpy")].concat();
        let again = notation.pose(&values, units).unwrap();
        assert!(again.rotation.angle_to(&example().parent_from_child.rotation) < 1e-7);
        assert_eq!(again.translation, example().parent_from_child.translation);
    }

    #[test]
    fn easy_handeye2_finds_its_keys() {
        let tree: Tree = serde_saphyr::from_str(&easy_handeye(&example())).unwrap();
        let kind = tree.get("parameters").and_then(|p| p.get("calibration_type"));
        assert_eq!(kind.and_then(Tree::text), Some("eye_on_base"));
        let rotation = tree.get("transform").and_then(|t| t.get("rotation")).unwrap();
        let w = rotation.get("w").and_then(Tree::number).unwrap();
        assert!((w - example().parent_from_child.rotation.w).abs() < 1e-12);
    }

    #[test]
    fn names_that_yaml_would_read_otherwise_are_quoted() {
        assert_eq!(in_yaml("camera_color_optical_frame"), "camera_color_optical_frame");
        assert_eq!(in_yaml("a: b # c\n"), "\"a: b # c\\n\"");
        assert_eq!(in_yaml("7"), "\"7\"");
    }

    #[test]
    fn launch_files_name_parent_before_child() {
        assert!(moveit(&example()).contains(" base_link camera_optical_frame\" />"));
        assert!(roxmltree::Document::parse(&moveit(&example())).is_ok());
        let launch = ros2_launch(&example());
        assert!(launch.contains("'--frame-id', 'base_link',\n"), "{launch}");
        assert!(launch.contains("'--z', '1.0e-7',\n"), "{launch}");
    }
}
