use std::collections::BTreeMap;

use nalgebra::{Isometry3, Vector2, Vector3};

use super::*;
use crate::{
    Camera, Distortion, Intrinsics, Pose, Target,
    detect::detect,
    math::random::Random,
    simulate::{Conditions, Occlusion, Optics, Scene, Shape},
};

fn grid(dictionary: &str, tags_x: u32, tags_y: u32) -> TargetModel {
    TargetModel::TagGrid {
        dictionary: dictionary.into(),
        tags_x,
        tags_y,
        tag_mm: 24.0,
        gap_mm: 8.0,
        first_id: 3,
    }
}

fn aprilgrid(border_bits: u32, corner_squares: bool) -> TargetModel {
    TargetModel::Aprilgrid {
        tags_x: 5,
        tags_y: 4,
        tag_mm: 24.0,
        spacing: 0.3,
        family: crate::model::target::kinds::AprilTagFamily::Tag36h11,
        first_id: 0,
        corner_squares,
        border_bits,
    }
}

/// In front of a lens with distortion, its middle `aside` of the axis (m).
fn placed(target: &TargetModel, turn: Vector3<f64>, depth: f64, aside: (f64, f64)) -> Scene {
    let corners = target.corners();
    let centre = corners.iter().map(|c| c.vector()).sum::<Vector3<f64>>() / corners.len() as f64;
    let turn = Isometry3::rotation(turn);
    let shift = Vector3::new(aside.0, aside.1, depth) - turn * centre;
    let mut brown = [0.0; 12];
    brown[..2].copy_from_slice(&[-0.15, 0.05]);
    let pinhole = Intrinsics::pinhole(800, 600, 900.0, 900.0, 399.5, 299.5);
    Scene {
        target: target.clone(),
        camera_from_target: Pose::claim(Isometry3::from_parts(shift.into(), turn.rotation)),
        intrinsics: Intrinsics { distortion: Distortion::BrownConrady(brown), ..pinhole },
    }
}

fn turned(random: &mut Random) -> Vector3<f64> {
    let mut between = |most: f64| random.between(-most, most);
    Vector3::new(between(0.5), between(0.5), between(3.1))
}

/// Largest distance between corners and truth, px.
fn farthest(scene: &Scene, found: &[ImageCorner]) -> f64 {
    let truth: BTreeMap<u32, Vector2<f64>> = scene.corners().into_iter().collect();
    found.iter().map(|c| (c.pixel - truth[&c.id]).norm()).fold(0.0, f64::max)
}

#[test]
fn grids_of_tags_are_found_in_every_turn() {
    let mut random = Random::new(5);
    for target in [
        grid("DICT_4X4_50", 5, 4),
        grid("DICT_6X6_250", 5, 4),
        grid("DICT_APRILTAG_36h11", 4, 3),
        aprilgrid(1, false),
        aprilgrid(2, false),
    ] {
        for k in 0..4 {
            let scene = placed(&target, turned(&mut random), 0.4, (0.0, 0.0));
            let found = detect(&scene.picture(&Optics::default(), k), &target).unwrap();
            assert_eq!(found.len(), target.len(), "{target:?} {k}");
            let farthest = farthest(&scene, &found);
            assert!(farthest < 0.1, "{target:?} {k}: {farthest}");
        }
    }
}

#[test]
fn small_tags_in_a_large_picture_are_found() {
    let target = grid("DICT_4X4_50", 5, 4);
    let mut scene = placed(&target, Vector3::new(0.2, 0.1, 0.4), 0.9, (0.1, -0.05));
    scene.intrinsics = Intrinsics::pinhole(1600, 1200, 900.0, 900.0, 799.5, 599.5);
    let found = detect(&scene.picture(&Optics::default(), 1), &target).unwrap();
    assert_eq!(found.len(), target.len());
    assert!(farthest(&scene, &found) < 0.2);
}

#[test]
fn a_part_of_a_grid_is_enough() {
    let target = grid("DICT_4X4_50", 5, 4);
    let scene = placed(&target, Vector3::new(0.2, 0.1, 0.4), 0.25, (0.09, 0.04));
    let found = detect(&scene.picture(&Optics::default(), 1), &target).unwrap();
    assert!((12..60).contains(&found.len()), "{}", found.len());
    assert!(farthest(&scene, &found) < 0.1);
}

/// A single tag of the board's dictionary.
fn tag(dictionary: &str, id: u32) -> TargetModel {
    TargetModel::Tag { dictionary: dictionary.into(), id, size_mm: 24.0 }
}

fn away(x: f64, y: f64, depth: f64) -> Pose<Camera, Target> {
    Pose::claim(Isometry3::translation(x, y, depth))
}

#[test]
fn a_tag_that_lies_beside_the_board_is_not_the_boards() {
    let board = grid("DICT_4X4_50", 3, 2);
    // the image shows tags 4 and 5 twice: on the board and beside it
    let scene = placed(&board, Vector3::new(0.1, 0.0, 0.1), 0.4, (-0.06, 0.0));
    let tags = [(4, 0.0), (5, 0.05)].map(|(id, y)| (tag("DICT_4X4_50", id), away(0.1, y, 0.4)));
    let conditions = Conditions { others: tags.into(), ..Conditions::default() };
    let image = scene.picture_under(&conditions, &Optics::default(), 1);
    let found = detect(&image, &board).unwrap();
    assert_eq!(found.len(), board.len());
    assert!(farthest(&scene, &found) < 0.1);
}

#[test]
fn tags_that_lie_otherwise_than_on_the_board_are_none() {
    let mut scene = placed(&tag("DICT_4X4_50", 4), Vector3::zeros(), 0.4, (0.0, 0.0));
    let other = (tag("DICT_4X4_50", 5), away(0.0, 0.05, 0.4));
    let conditions = Conditions { others: vec![other], ..Conditions::default() };
    let picture = |scene: &Scene| scene.picture_under(&conditions, &Optics::default(), 1);
    let board = grid("DICT_4X4_50", 3, 2);
    let error = detect(&picture(&scene), &board).unwrap_err();
    assert_eq!(error, NotFound::NoTags { dictionary: "DICT_4X4_50".into() });
    // where tag 5 has its place beside tag 4, both are found
    scene.camera_from_target = away(-0.032, 0.05, 0.4);
    assert_eq!(detect(&picture(&scene), &board).map(|c| c.len()), Ok(8));
}

#[test]
fn a_tag_alone_must_have_many_bits() {
    for (dictionary, enough) in
        [("DICT_4X4_50", false), ("DICT_5X5_50", true), ("DICT_APRILTAG_36h11", true)]
    {
        let scene = placed(&tag(dictionary, 4), Vector3::zeros(), 0.4, (0.0, 0.0));
        let found = detect(&scene.picture(&Optics::default(), 1), &grid(dictionary, 3, 2));
        assert_eq!(found.is_ok(), enough, "{dictionary}: {found:?}");
        if let Ok(corners) = found {
            let ids: Vec<u32> = corners.iter().map(|c| c.id).collect();
            assert_eq!(ids, [4, 5, 6, 7], "the second tag of the board");
        }
    }
}

#[test]
fn two_tags_alone_that_contradict_each_other_are_none() {
    let dictionary = "DICT_APRILTAG_36h11";
    let scene = placed(&tag(dictionary, 4), Vector3::zeros(), 0.4, (0.0, 0.0));
    let other = (tag(dictionary, 5), away(0.03, 0.06, 0.5));
    let conditions = Conditions { others: vec![other], ..Conditions::default() };
    let image = scene.picture_under(&conditions, &Optics::default(), 1);
    assert!(detect(&image, &grid(dictionary, 3, 2)).is_err());
}

#[test]
fn errors_stay_inside_the_covariance() {
    let target = grid("DICT_6X6_250", 5, 4);
    let mut random = Random::new(11);
    let (mut normalised, mut count) = (0.0, 0.0);
    for k in 0..12 {
        let scene = placed(&target, turned(&mut random), 0.32, (0.0, 0.0));
        let found = detect(&scene.picture(&Optics::default(), k), &target).unwrap();
        let truth: BTreeMap<u32, Vector2<f64>> = scene.corners().into_iter().collect();
        for corner in &found {
            let e = corner.pixel - truth[&corner.id];
            normalised += e.dot(&(corner.covariance.try_inverse().unwrap() * e));
            count += 2.0;
        }
    }
    println!("normalised error squared {:.2}", normalised / count);
    assert!(
        count > 1800.0 && (0.85..1.2).contains(&(normalised / count)),
        "{}",
        normalised / count
    );
}

#[test]
fn pictures_without_tags_have_none() {
    let target = grid("DICT_4X4_50", 5, 4);
    let mut random = Random::new(9);
    let noise = (0..640 * 480).map(|_| random.between(0.0, 255.0) as f32).collect();
    let none = Err(NotFound::NoTags { dictionary: "DICT_4X4_50".into() });
    assert_eq!(detect(&GrayImage::new(640, 480, noise).unwrap(), &target), none);
    let broken = GrayImage::new(64, 64, vec![f32::NAN; 4096]).unwrap();
    assert_eq!(detect(&broken, &target), none);
}

/// The image with grey discs on the left and right side of every tag.
fn with_broken_sides(scene: &Scene) -> GrayImage {
    let picture = scene.picture(&Optics::default(), 4);
    let at: BTreeMap<u32, Vector2<f64>> = scene.corners().into_iter().collect();
    let sides =
        |tag: u32| [(0, 3), (1, 2)].map(|(a, b)| (at[&(4 * tag + a)] + at[&(4 * tag + b)]) * 0.5);
    let discs: Vec<Vector2<f64>> = (0..at.len() as u32 / 4).flat_map(sides).collect();
    let (width, height) = (picture.width(), picture.height());
    let values = picture.values().iter().enumerate().map(|(k, v)| {
        let p = Vector2::new((k % width) as f64, (k / width) as f64);
        if discs.iter().any(|disc| (disc - p).norm() < 4.0) { 120.0 } else { *v }
    });
    GrayImage::new(width, height, values.collect()).unwrap()
}

#[test]
fn an_aprilgrid_whose_edges_are_broken_is_found_by_its_tags() {
    for border_bits in [1, 2] {
        let target = aprilgrid(border_bits, true);
        let scene = placed(&target, Vector3::new(0.2, -0.1, 0.3), 0.3, (0.0, 0.0));
        let picture = with_broken_sides(&scene);
        let rough = Board::of(&target).unwrap().unwrap().rough(&picture);
        assert!(rough.len() >= 60, "{} corners of tags", rough.len());
        let found = detect(&picture, &target).unwrap();
        assert!(found.len() >= 70, "{}", found.len());
        assert!(farthest(&scene, &found) < 0.1, "{}", farthest(&scene, &found));
    }
}

#[test]
fn grids_of_tags_are_found_out_of_focus_and_from_the_side() {
    let target = grid("DICT_5X5_100", 5, 4);
    let defocused = Optics { blur_px: 0.3, defocus_px: 4.0, ..Optics::default() };
    // tilt, optics, corners, farthest px
    let cases = [
        (0.2, defocused, 76, 0.15),
        (1.1, Optics::default(), 76, 0.1),
        (1.2, Optics::default(), 76, 0.15),
    ];
    for (tilt, optics, least, most) in cases {
        let scene = placed(&target, Vector3::new(tilt, -0.1, 0.1), 0.32, (0.0, 0.0));
        let found = detect(&scene.picture(&optics, 4), &target).unwrap();
        let farthest = farthest(&scene, &found);
        println!("{tilt}: {} corners, {farthest:.3} px", found.len());
        assert!(found.len() >= least && farthest < most, "{tilt}: {} {farthest}", found.len());
    }
}

#[test]
fn of_tags_that_are_hidden_in_part_the_corners_in_sight_are_found() {
    let mut random = Random::new(9);
    let target = grid("DICT_5X5_100", 6, 5);
    let mut in_part = 0;
    for k in 0..4_u32 {
        let scene = placed(&target, turned(&mut random), 0.45, (0.0, 0.0));
        let shape = Shape::Side { share: 0.5, towards_rad: 1.3 * f64::from(k) };
        let occlusion = Some(Occlusion { shape, grey: 150.0, seed: u64::from(k) });
        let conditions = Conditions { occlusion, ..Conditions::default() };
        let optics = Optics::default();
        let image = scene.picture_under(&conditions, &optics, u64::from(k));
        let found = detect(&image, &target).unwrap();
        let truth = scene.corners_under(&conditions, &optics);
        for c in &found {
            let true_one = truth.iter().find(|t| t.id == c.id).unwrap();
            let off = (c.pixel - true_one.pixel).norm();
            assert!(true_one.visible != Some(false) && off < 2.0, "{k} {}: {off}", c.id);
        }
        let mut of_tag: BTreeMap<u32, usize> = BTreeMap::new();
        found.iter().for_each(|c| *of_tag.entry(c.id / 4).or_default() += 1);
        in_part += of_tag.values().filter(|count| **count < 4).count();
    }
    assert!(in_part >= 4, "{in_part} tags seen in part");
}
