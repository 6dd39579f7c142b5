//! The manifests of real data open and yield what the data's descriptions say.
//!
//! The data lie in `HANDEYE_TEST_DATA` (default: `shared/data` beside the repository); a set that
//! is not there is skipped, and says so.

use std::path::{Path, PathBuf};

use handeye::{Setup, math::linalg};
use handeye_io::{Dataset, Error};
use nalgebra::Vector3;

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn data() -> PathBuf {
    std::env::var_os("HANDEYE_TEST_DATA")
        .map_or_else(|| repository().join("../shared/data"), PathBuf::from)
}

/// The opened set, or `None` with a printed reason.
fn open(set: &str) -> Option<Dataset> {
    let folder = if set.starts_with("ur5_kluzior") { "ur5_kluzior" } else { set };
    if !data().join(folder).is_dir() {
        println!("skipped: no {folder} in {}", data().display());
        return None;
    }
    let manifest = repository().join(format!("crates/handeye-cli/tests/real/{set}.toml"));
    let opened: Result<Dataset, Error> = Dataset::open_with_root(&manifest, &data());
    Some(opened.unwrap_or_else(|e| panic!("{set}: {e}")))
}

#[test]
fn every_set_has_as_many_captures_as_its_description_says() {
    for (set, captures, images, boards) in [
        ("rct_charuco", 16, 16, 0),
        ("visp_franka_eih", 8, 8, 0),
        ("visp_franka_eth", 8, 8, 0),
        ("tabb_ds1", 88, 88, 0),
        ("ur3_cam1", 40, 40, 0),
        ("ur5_kluzior_1651", 49, 49, 0),
        ("ur5_kluzior_1710", 55, 55, 0),
        ("ur5_kluzior_1734", 53, 53, 0),
        ("ur5_kluzior_1745", 52, 52, 0),
        ("franka_realsense_eih", 6, 6, 0),
        ("franka_charuco_poses", 12, 0, 12),
        ("camodocal_transpair", 11, 0, 11),
        ("moveit_samples", 50, 0, 50),
        ("mycobot_eih", 15, 15, 0),
        ("xema_eih", 8, 8, 0),
    ] {
        let Some(dataset) = open(set) else { continue };
        let with_image = dataset.captures.iter().filter(|c| c.image.is_some()).count();
        let with_pose = dataset.captures.iter().filter(|c| c.camera_from_target.is_some()).count();
        assert_eq!(
            (dataset.captures.len(), with_image, with_pose),
            (captures, images, boards),
            "{set}"
        );
        assert!(dataset.warnings.is_empty(), "{set}: {:?}", dataset.warnings);
        assert!(dataset.captures.iter().all(|c| c.base_from_flange.is_finite()));
    }
}

#[test]
fn images_and_poses_are_paired_in_natural_order() {
    let Some(dataset) = open("rct_charuco") else { return };
    let second = &dataset.captures[2];
    assert_eq!(second.id, "2");
    let Some(path) = &second.image else { panic!("no image") };
    assert_eq!((dataset.image(path).unwrap().width(), dataset.setup), (1600, Setup::EyeToHand));
    let first = dataset.captures[0].base_from_flange;
    let expected = Vector3::new(0.113074204220918, 0.5892802789268905, 0.652673790716681);
    assert!((first.translation() - expected).norm() < 1e-15);
}

#[test]
fn intrinsics_are_those_of_the_pictures() {
    if let Some(dataset) = open("ur3_cam1") {
        let camera = dataset.intrinsics.unwrap();
        assert_eq!((camera.width, camera.height), (1280, 720));
        assert!((camera.fx - 1572.9338514293024 * 2.0 / 3.0).abs() < 1e-9);
    }
    if let Some(dataset) = open("ur5_kluzior_1651") {
        let camera = dataset.intrinsics.unwrap();
        assert_eq!((camera.width, camera.height), (640, 480));
        assert!((camera.coefficients()[4] + 0.627477296).abs() < 1e-6);
    }
    if let Some(dataset) = open("visp_franka_eih") {
        assert_eq!(dataset.intrinsics.unwrap().fx, 607.5931396484375);
    }
}

#[test]
fn depth_aligned_to_the_picture_becomes_points() {
    let Some(dataset) = open("franka_realsense_eih") else { return };
    let path = dataset.captures[0].scan.as_ref().unwrap();
    let scan = dataset.scan(path).unwrap();
    assert_eq!((scan.width(), scan.height()), (1920, 1080));
    let point = scan.at(960, 540).unwrap();
    assert!((0.2..2.0).contains(&point.z), "{point}");
}

#[test]
fn points_of_the_flange_are_converted_to_metres() {
    let Some(dataset) = open("photoneo_flange") else { return };
    assert_eq!((dataset.correspondences.len(), dataset.captures.len()), (6, 0));
    let first = &dataset.correspondences[0];
    assert!((first.in_camera.xyz().z - 0.726_765_075_683_593_8).abs() < 1e-15);
    assert!((first.in_mount.xyz().x - 0.5280254928541637).abs() < 1e-15);
}

/// Robot and board turn by the same angle between two captures, wherever the camera sits.
#[test]
fn robot_and_board_turn_by_the_same_angles() {
    for (set, most_deg) in
        [("franka_charuco_poses", 0.5), ("camodocal_transpair", 1.5), ("moveit_samples", 1.5)]
    {
        let Some(dataset) = open(set) else { continue };
        let mut apart: Vec<f64> = vec![];
        for pair in dataset.captures.windows(2) {
            let robot = pair[0].base_from_flange.angle_to(&pair[1].base_from_flange);
            let [a, b] = [&pair[0], &pair[1]].map(|c| c.camera_from_target.unwrap());
            apart.push((robot - a.angle_to(&b)).abs().to_degrees());
        }
        let median = linalg::median(apart);
        assert!(median < most_deg, "{set}: {median} deg");
    }
}

#[test]
fn joints_through_the_nominal_model_stay_within_reach() {
    let Some(dataset) = open("ur3_cam1") else { return };
    for capture in &dataset.captures {
        let reach = capture.base_from_flange.translation().norm();
        assert!((0.1..0.7).contains(&reach), "{}: {reach}", capture.id);
    }
}

#[test]
fn the_clouds_of_the_flange_are_read_alike_from_ply_and_pcd() {
    let folder = data().join("photoneo_flange");
    if !folder.is_dir() {
        println!("skipped: no {}", folder.display());
        return;
    }
    let options = handeye_io::ScanOptions {
        length_unit: Some(handeye_io::units::LengthUnit::Millimetre),
        ..Default::default()
    };
    let sample = folder.join("2019-06-14-sample");
    let ply = handeye_io::read_scan(&sample.join("01_tool_valid.ply"), &options).unwrap();
    let pcd = handeye_io::read_scan(&sample.join("01_tool_valid.pcd"), &options).unwrap();
    assert_eq!((ply.width(), ply.height()), (11_500, 1));
    for (a, b) in ply.points().iter().zip(pcd.points()) {
        assert!((0..3).all(|i| (a[i] - b[i]).abs() < 1e-6), "{a:?} {b:?}");
    }
    let packed =
        handeye_io::read_scan(&folder.join("flange_ground_truth/flange_franka.pcd"), &options)
            .unwrap();
    assert_eq!(packed.points().len(), 83_793);
}

/// Corners that OpenCV's ArucoDetector finds, its order and its pixels (refined by cornerSubPix).
const OPENCV_TAGS: [(usize, [(f64, f64); 4]); 2] = [
    (0, [(346.56, 271.31), (479.17, 281.38), (477.70, 420.34), (337.61, 408.35)]),
    (3, [(434.78, 210.89), (319.52, 344.38), (180.91, 219.57), (311.29, 81.93)]),
];

#[test]
fn tags_have_their_corners_in_the_order_of_opencv() {
    let Some(dataset) = open("visp_franka_eth") else { return };
    let target = dataset.target.as_ref().unwrap();
    for (k, wanted) in OPENCV_TAGS {
        let image = dataset.image(dataset.captures[k].image.as_ref().unwrap()).unwrap();
        let found = handeye::detect::detect(&image, target).unwrap();
        for (corner, (x, y)) in found.iter().zip(wanted) {
            let off = (corner.pixel.x - x).hypot(corner.pixel.y - y);
            assert!(off < 0.5, "image {k}: corner {} is {off:.2} px away", corner.id);
        }
    }
}
