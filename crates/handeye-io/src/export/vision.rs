//! Vision libraries: OpenCV, Zivid, HALCON.

use handeye::Setup;

use super::{CameraPose, DEGREES, METRES, MILLIMETRES, matrix_row, numbers, row_major};
use crate::robot::Notation;

pub(super) fn opencv(pose: &CameraPose) -> String {
    let matrix = row_major(&pose.parent_from_child);
    let rows: Vec<String> = matrix.chunks(4).map(|row| matrix_row(row, METRES, ", ")).collect();
    format!(
        "%YAML:1.0\n---\n{}: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   data: [ {} ]\n",
        pose.name,
        rows.join(", ")
    )
}

pub(super) fn zivid(pose: &CameraPose) -> String {
    let mut matrix = row_major(&pose.parent_from_child);
    for i in [3, 7, 11] {
        matrix[i] *= 1000.0;
    }
    let row = |row| format!("    - [{}]", matrix_row(row, MILLIMETRES, ", "));
    let rows: Vec<String> = matrix.chunks(4).map(row).collect();
    format!(
        "__version__:\n  serializer: 1\n  data: 1\nFloatMatrix:\n  Data:\n{}\n",
        rows.join("\n")
    )
}

/// HALCON's results have the camera as the parent: `camera_from_base` (its `BaseInCamPose`) or
/// `camera_from_flange` (`ToolInCamPose`), as Rp+T, gba, point.
pub(super) fn halcon(pose: &CameraPose) -> String {
    let inverse = pose.parent_from_child.inverse();
    let values = Notation::named("euler-xyz-intrinsic")
        .map(|n| n.values(&inverse, n.own_units()))
        .unwrap_or_default();
    format!(
        "# 3D POSE PARAMETERS: rotation and translation\n\n\
         # {}_from_{}: {} in {}, HALCON's {}\n\n\
         # Used representation type:\nf 0\n\n\
         # Rotation angles [deg] or Rodriguez-vector:\nr {}\n\n\
         # Translational vector (x y z [m]):\nt {}\n",
        pose.child,
        pose.parent,
        pose.parent,
        pose.child,
        in_halcon(pose.setup),
        numbers(&values[3..], DEGREES, " "),
        numbers(&values[..3], METRES, " "),
    )
}

/// What HALCON's calibrate_hand_eye calls this pose.
fn in_halcon(setup: Setup) -> &'static str {
    match setup {
        Setup::EyeInHand => "ToolInCamPose",
        Setup::EyeToHand => "BaseInCamPose",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{export::tests::example, tree::Tree};

    #[test]
    fn opencv_and_zivid_hold_the_matrix_in_their_units() {
        let tree: Tree = serde_saphyr::from_str(&opencv(&example())).unwrap();
        let matrix = tree.get("base_from_camera").and_then(Tree::numbers).unwrap();
        let exact = row_major(&example().parent_from_child);
        assert!(matrix.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-12), "{matrix:?}");
        let tree: Tree = serde_saphyr::from_str(&zivid(&example())).unwrap();
        let matrix = tree.get("FloatMatrix").and_then(Tree::numbers).unwrap();
        assert_eq!((matrix[3], matrix[7]), (500.0, -250.0));
    }

    #[test]
    fn halcon_has_the_camera_as_parent() {
        let text = halcon(&example());
        let heading = "# camera_optical_frame_from_base_link: base_link in camera_optical_frame, \
                       HALCON's BaseInCamPose\n";
        assert!(text.contains(heading), "{text}");
        let line = |key: &str| -> Vec<f64> {
            let line = text.lines().find_map(|l| l.strip_prefix(key)).unwrap();
            line.split(' ').map(|w| w.parse().unwrap()).collect()
        };
        let notation = Notation::named("euler-xyz-intrinsic").unwrap();
        let values = [line("t "), line("r ")].concat();
        let again = notation.pose(&values, notation.own_units()).unwrap();
        let apart = again * example().parent_from_child;
        assert!(apart.translation.vector.norm() < 1e-9 && apart.rotation.angle() < 1e-7);
    }
}
