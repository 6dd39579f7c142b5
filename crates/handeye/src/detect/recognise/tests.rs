use nalgebra::{Matrix3, Vector3, Vector6};

use super::*;
use crate::{
    Intrinsics, Pose,
    math::random::Random,
    simulate::{Optics, Scene},
};

/// Pictures of a board that is turned, tilted and moved.
fn pictures(target: &TargetModel, count: u64) -> Vec<GrayImage> {
    let picture = |seed: u64| {
        let mut random = Random::new(seed + 40);
        let mut any = |w: f64| random.between(-w, w);
        let away = Pose::from_parts(&Matrix3::identity(), Vector3::new(any(0.01), any(0.01), 0.42));
        let turn = Vector6::new(any(0.3), any(0.3), any(3.1), 0.0, 0.0, 0.0);
        let middle = target.middle().vector();
        let back = Vector6::new(0.0, 0.0, 0.0, -middle.x, -middle.y, 0.0);
        let scene = Scene {
            target: target.clone(),
            camera_from_target: away.retract(&turn).retract(&back),
            intrinsics: Intrinsics::pinhole(900, 700, 900.0, 900.0, 449.5, 349.5),
        };
        scene.picture(&Optics::default(), seed)
    };
    (0..count).map(picture).collect()
}

fn target(json: &str) -> TargetModel {
    serde_json::from_str(json).unwrap()
}

/// Recognises a board in its pictures: the same one, its lengths in proportion.
fn assert_recognised(json: &str) {
    let wanted = target(json);
    let found = recognise(&pictures(&wanted, 3)).unwrap_or_else(|| panic!("nothing for {json}"));
    let text = |target: &TargetModel| {
        let value = serde_json::to_value(target).unwrap();
        let rounded = |(key, value): (String, serde_json::Value)| {
            let float = value.as_f64().filter(|_| value.is_f64());
            (key, float.map_or(value, |x| ((x * 50.0).round() / 50.0).into()))
        };
        value.as_object().cloned().unwrap().into_iter().map(rounded).collect::<Vec<_>>()
    };
    let unit = 1e-3 / wanted.pitch_m();
    assert_eq!(text(&found.target), text(&wanted.resized(unit)));
    assert!(found.images >= 2, "{} images", found.images);
}

#[test]
fn boards_with_markers_are_recognised() {
    for json in [
        r#"{"kind":"charuco","squares_x":9,"squares_y":6,"square_mm":28,"marker_mm":21,"dictionary":"DICT_5X5_50"}"#,
        r#"{"kind":"charuco","squares_x":7,"squares_y":10,"square_mm":25,"marker_mm":15,"dictionary":"DICT_4X4_50","legacy":true}"#,
        r#"{"kind":"charuco","squares_x":8,"squares_y":7,"square_mm":28,"marker_mm":21,"dictionary":"DICT_6X6_100","first_id":28}"#,
        r#"{"kind":"aprilgrid","tags_x":6,"tags_y":5,"tag_mm":30,"spacing":0.3,"family":"36h11"}"#,
        r#"{"kind":"aprilgrid","tags_x":5,"tags_y":4,"tag_mm":30,"spacing":0.3,"family":"36h11","border_bits":2}"#,
        r#"{"kind":"aprilgrid","tags_x":5,"tags_y":4,"tag_mm":30,"spacing":0.4,"family":"25h9","corner_squares":false}"#,
        r#"{"kind":"tag-grid","dictionary":"DICT_6X6_50","tags_x":6,"tags_y":4,"tag_mm":30,"gap_mm":9}"#,
        r#"{"kind":"tag","dictionary":"DICT_APRILTAG_36h11","id":17,"size_mm":100}"#,
    ] {
        assert_recognised(json);
    }
}

#[test]
fn boards_without_markers_are_recognised() {
    for json in [
        r#"{"kind":"checkerboard","columns":9,"rows":6,"square_mm":24}"#,
        r#"{"kind":"checkerboard","columns":11,"rows":8,"square_mm":20}"#,
        r#"{"kind":"circle-grid","columns":9,"rows":6,"pitch_mm":26}"#,
        r#"{"kind":"asymmetric-circle-grid","columns":4,"rows":11,"pitch_mm":15}"#,
    ] {
        assert_recognised(json);
    }
}

#[test]
fn pictures_without_a_board_show_none() {
    let mut random = Random::new(3);
    let noise: Vec<f32> = (0..640 * 480).map(|_| random.between(0.0, 255.0) as f32).collect();
    let noise = GrayImage::new(640, 480, noise).unwrap();
    let flat = GrayImage::new(640, 480, vec![90.0; 640 * 480]).unwrap();
    let strip =
        |width: usize, height| GrayImage::new(width, height, vec![90.0; width * height]).unwrap();
    assert_eq!(recognise(&[noise, flat, strip(1, 3000), strip(24, 60_000), strip(0, 0)]), None);
    assert_eq!(recognise(&[]), None);
}

#[test]
fn a_board_in_too_few_pictures_is_none() {
    let mut all =
        pictures(&target(r#"{"kind":"checkerboard","columns":9,"rows":6,"square_mm":24}"#), 1);
    for _ in 0..2 {
        all.push(GrayImage::new(900, 700, vec![90.0; 630_000]).unwrap());
    }
    assert_eq!(recognise(&all), None);
}
