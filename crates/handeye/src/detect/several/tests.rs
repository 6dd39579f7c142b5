use std::collections::BTreeMap;

use nalgebra::{Isometry3, Vector3};

use super::*;
use crate::{
    Pose,
    simulate::{Optics, Scene},
};

const WIDTH: usize = 640;
const HEIGHT: usize = 480;

fn target(json: &str) -> TargetModel {
    serde_json::from_str(json).unwrap()
}

fn checkerboard(columns: u32, rows: u32) -> TargetModel {
    TargetModel::Checkerboard { columns, rows, square_mm: 20.0 }
}

/// A ChArUco board with 9 x 6 inner corners.
fn charuco(first_id: u32) -> TargetModel {
    target(&format!(
        r#"{{"kind":"charuco","squares_x":10,"squares_y":7,"square_mm":20,"marker_mm":15,"dictionary":"DICT_5X5_100","first_id":{first_id}}}"#
    ))
}

/// The board in the middle of an image, `depth` metres away.
fn scene(target: &TargetModel, depth: f64) -> Scene {
    let corners = target.corners();
    let centre = corners.iter().map(|c| c.vector()).sum::<Vector3<f64>>() / corners.len() as f64;
    let turn = Isometry3::rotation(Vector3::new(0.3, -0.2, 0.0))
        * Isometry3::rotation(Vector3::new(0.0, 0.0, 0.25));
    let shift = Vector3::new(0.0, 0.0, depth) - turn * centre;
    Scene {
        target: target.clone(),
        camera_from_target: Pose::claim(Isometry3::from_parts(shift.into(), turn.rotation)),
        intrinsics: Intrinsics::pinhole(WIDTH as u32, HEIGHT as u32, 800.0, 800.0, 319.5, 239.5),
    }
}

/// An image of all boards, each in a tile of its own, two to a row; and where their corners are.
fn picture(boards: &[(TargetModel, f64)]) -> (GrayImage, Vec<BTreeMap<u32, Vector2<f64>>>) {
    let scenes: Vec<Scene> = boards.iter().map(|(t, depth)| scene(t, *depth)).collect();
    let tiles: Vec<GrayImage> = scenes.iter().map(|s| s.picture(&Optics::default(), 5)).collect();
    let (width, height) = (2 * WIDTH, tiles.len().div_ceil(2) * HEIGHT);
    let at = |i: usize| {
        let (x, y) = (i % width, i / width);
        let tile = tiles.get(y / HEIGHT * 2 + x / WIDTH);
        tile.map_or(120.0, |t| t.at(x % WIDTH, y % HEIGHT))
    };
    let origin = |k: usize| Vector2::new((k % 2 * WIDTH) as f64, (k / 2 * HEIGHT) as f64);
    let truth = |(k, s): (usize, &Scene)| {
        s.corners().into_iter().map(|(id, p)| (id, p + origin(k))).collect()
    };
    let image = GrayImage::new(width, height, (0..width * height).map(at).collect()).unwrap();
    (image, scenes.iter().enumerate().map(truth).collect())
}

fn assert_all(found: &Outcome, truth: &BTreeMap<u32, Vector2<f64>>, what: &str) {
    let corners = found.as_ref().unwrap_or_else(|e| panic!("{what}: {e}"));
    assert_eq!(corners.len(), truth.len(), "{what}");
    for c in corners {
        assert!((c.pixel - truth[&c.id]).norm() < 0.2, "{what}: corner {}", c.id);
    }
}

#[test]
fn each_board_is_found_beside_the_others() {
    let grid = target(
        r#"{"kind":"aprilgrid","tags_x":4,"tags_y":3,"tag_mm":24,"spacing":0.3,"family":"36h11"}"#,
    );
    let tag = target(r#"{"kind":"tag","dictionary":"DICT_6X6_250","id":7,"size_mm":60}"#);
    // the ChArUco board has as many corners as the first checkerboard, and is larger in the image
    let boards = [
        (checkerboard(9, 6), 0.5),
        (charuco(50), 0.4),
        (charuco(0), 0.45),
        (checkerboard(6, 5), 0.4),
        (grid, 0.3),
        (tag, 0.3),
    ];
    let (image, truth) = picture(&boards);
    let targets: Vec<&TargetModel> = boards.iter().map(|(t, _)| t).collect();
    let found = detect_several(&image, &targets, None);
    for (k, target) in targets.iter().enumerate() {
        assert_all(&found[k], &truth[k], &format!("{target:?}"));
    }
    // the order in which they are asked for does not matter
    let backwards: Vec<&TargetModel> = targets.iter().rev().copied().collect();
    let mut other = detect_several(&image, &backwards, None);
    other.reverse();
    assert_eq!(found, other);
}

#[test]
fn one_board_is_not_taken_for_another() {
    let (image, truth) = picture(&[(charuco(0), 0.4)]);
    let (plain, coded) = (checkerboard(9, 6), charuco(0));
    let found = detect_several(&image, &[&plain, &coded, &charuco(50)], None);
    assert_all(&found[1], &truth[0], "charuco");
    assert!(found[0].is_err() && found[2].is_err(), "{:?}", found[0]);
}

#[test]
fn a_small_checkerboard_is_found_beside_a_larger_one() {
    let boards = [(checkerboard(11, 8), 0.45), (checkerboard(7, 5), 0.55)];
    let (image, truth) = picture(&boards);
    for (k, (board, _)) in boards.iter().enumerate() {
        let found = super::super::detect(&image, board);
        assert_all(&found, &truth[k], &format!("{board:?}"));
    }
}
