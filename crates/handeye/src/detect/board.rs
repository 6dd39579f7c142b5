//! A target found in an image: which corner of it each one in the image is.

use super::{
    checkerboard, circles,
    coded::Coded,
    grid::Grid,
    mesh,
    pyramid::{Scaled, smoothed},
    strays::without_strays,
    tag, tags,
};
use crate::{
    GrayImage, ImageCorner, Intrinsics, TargetModel,
    detect::outcome::{NotFound, Outcome, worth},
    model::target::look::Look,
};

/// Smallest side of an image (px) with a board of 2 x 2 corners in it.
pub(super) const SMALLEST_IMAGE: usize = 24;

/// The target's corners in an image, in the order of their ids. Pixels; the centre of the top-left
/// pixel is (0, 0).
///
/// Of a board with markers a part is enough; of a checkerboard a part that can lie on it in one way
/// only, such as all of a side and the two beside it.
///
/// # Errors
/// Why it was not found.
pub fn detect(image: &GrayImage, target: &TargetModel) -> Result<Vec<ImageCorner>, NotFound> {
    detect_with(image, target, None)
}

/// The same, with the camera that took the image, if it is known: centres of circles are then right
/// for strong distortion and large circles, too. Corners do not need it.
///
/// # Errors
/// Why it was not found.
pub fn detect_with(
    image: &GrayImage,
    target: &TargetModel,
    camera: Option<&Intrinsics>,
) -> Result<Vec<ImageCorner>, NotFound> {
    let (width, height) = (image.width(), image.height());
    if width.min(height) < SMALLEST_IMAGE {
        return Err(NotFound::SmallImage { width, height });
    }
    let found = match target.look() {
        Look::Tag { dictionary, id } => return tag::detect(image, &dictionary, id),
        Look::Circles(_) => return circles::detect_with(image, target, camera),
        Look::Ball => return Err(NotFound::ScansOnly),
        Look::Tags(print) if !print.joined => tags::Board::new(target, &print)?.detect(image),
        Look::Tags(_) | Look::Squares | Look::MarkedSquares(_) => {
            search(image, target, &|grids| grids)
        }
    };
    without_strays(found, target, (width, height), camera)
}

/// Looks for a board among the grids of corners of the image, as far as `free` leaves them.
pub(super) fn search(
    image: &GrayImage,
    target: &TargetModel,
    free: &dyn Fn(Vec<Grid>) -> Vec<Grid>,
) -> Outcome {
    let family = Family::of(target)?;
    let is_complete =
        |outcome: &Outcome| outcome.as_ref().is_ok_and(|corners| corners.len() == target.len());
    let mut best = Err(NotFound::NoCorners);
    for level in levels(image) {
        let found: Vec<Grid> = mesh::grids(&smoothed(&level.image));
        let grids = found.iter().map(|g| g.map(|p| level.original(p))).collect();
        let found = family.label(image, &free(grids));
        let improved = worth(&found) > worth(&best);
        if improved {
            best = found;
        }
        // in the smallest images markers and small squares may be hard to read
        let fine = level.image.width().max(level.image.height()) > FINE;
        if is_complete(&best) || (best.is_ok() && !improved && fine) {
            break;
        }
    }
    match family {
        Family::Coded(board) if !is_complete(&best) => board.with_tags(image, best),
        _ => best,
    }
}

/// Longest side of the smallest level, px, at most.
const COARSEST: usize = 450;
/// A board of which a part is found is looked for in larger images up to this side, px, at least.
const FINE: usize = 900;
/// Larger images (px) are not doubled: their squares are large enough, and memory is finite.
const MOST_TO_DOUBLE: usize = 4_000_000;

/// The image at half sizes, the smallest first, and last doubled.
fn levels(image: &GrayImage) -> impl Iterator<Item = Scaled<'_>> {
    let halves = Scaled::halves(image, |half| half.width().max(half.height()) <= COARSEST);
    let small = image.width() * image.height() <= MOST_TO_DOUBLE;
    let doubled = small.then_some(image).into_iter().map(Scaled::doubled);
    halves.chain(doubled)
}

/// The targets that are found by their grid of corners.
enum Family<'a> {
    Checkerboard(&'a TargetModel),
    Coded(Coded<'a>),
}

impl<'a> Family<'a> {
    fn of(target: &'a TargetModel) -> Result<Self, NotFound> {
        match target.look() {
            Look::Squares => Ok(Self::Checkerboard(target)),
            Look::MarkedSquares(print) => Ok(Self::Coded(Coded::charuco(target, &print)?)),
            Look::Tags(print) if print.joined => Ok(Self::Coded(Coded::tags(target, &print)?)),
            // these were looked for before
            Look::Tags(_) | Look::Tag { .. } | Look::Circles(_) | Look::Ball => {
                Err(NotFound::Unsupported("this target"))
            }
        }
    }

    fn label(&self, image: &GrayImage, grids: &[Grid]) -> Outcome {
        match self {
            _ if grids.is_empty() => Err(NotFound::NoCorners),
            Self::Checkerboard(target) => checkerboard::label(image, grids, target),
            Self::Coded(board) => board.label(image, grids),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Distortion, Intrinsics, Pose};
    use crate::{
        math::random::Random,
        simulate::{Optics, Scene},
    };
    use nalgebra::{Matrix3, Vector2, Vector3, Vector6};
    use std::collections::BTreeMap;

    fn charuco(squares_x: u32, squares_y: u32, legacy: bool) -> TargetModel {
        TargetModel::Charuco {
            squares_x,
            squares_y,
            square_mm: 20.0,
            marker_mm: 14.0,
            dictionary: "DICT_5X5_100".into(),
            legacy,
            first_id: 0,
        }
    }

    fn checkerboard(columns: u32, rows: u32) -> TargetModel {
        TargetModel::Checkerboard { columns, rows, square_mm: 20.0 }
    }

    /// The board in the middle of the image, turned in its plane by `roll` and tilted a little.
    fn scene(target: &TargetModel, roll: f64, depth: f64) -> Scene {
        let corners = target.corners();
        let centre =
            corners.iter().map(|c| c.vector()).sum::<Vector3<f64>>() / corners.len() as f64;
        let turn = Vector6::new(0.0, 0.0, roll, 0.0, 0.0, 0.0);
        let tilt = Vector6::new(0.3, -0.2, 0.0, 0.0, 0.0, 0.0);
        let away = Pose::from_parts(&Matrix3::identity(), Vector3::new(0.0, 0.0, depth));
        let back = Vector6::new(0.0, 0.0, 0.0, -centre.x, -centre.y, 0.0);
        let brown = [-0.15, 0.05, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let pinhole = Intrinsics::pinhole(800, 600, 900.0, 900.0, 399.5, 299.5);
        Scene {
            target: target.clone(),
            camera_from_target: away.retract(&tilt).retract(&turn).retract(&back),
            intrinsics: Intrinsics { distortion: Distortion::BrownConrady(brown), ..pinhole },
        }
    }

    /// Largest distance between corners and truth, px.
    fn farthest(scene: &Scene, found: &[ImageCorner]) -> f64 {
        let truth: BTreeMap<u32, Vector2<f64>> = scene.corners().into_iter().collect();
        found.iter().map(|c| (c.pixel - truth[&c.id]).norm()).fold(0.0, f64::max)
    }

    #[test]
    fn every_turn_of_an_unambiguous_checkerboard_keeps_its_ids() {
        let target = checkerboard(9, 6);
        for k in 0..8 {
            let scene = scene(&target, 0.8 * f64::from(k), 0.45);
            let found = detect(&scene.picture(&Optics::default(), k as u64), &target).unwrap();
            assert_eq!(found.len(), 54);
            assert!(farthest(&scene, &found) < 0.1, "turn {k}: {}", farthest(&scene, &found));
        }
    }

    #[test]
    fn a_symmetric_checkerboard_is_found_up_to_its_symmetry() {
        for target in [checkerboard(8, 6), checkerboard(7, 7), checkerboard(6, 6)] {
            for k in 0..4 {
                let scene = scene(&target, 0.2 + 1.5 * f64::from(k), 0.45);
                let found = detect(&scene.picture(&Optics::default(), 1), &target).unwrap();
                let maps = target.symmetries();
                let all = maps.iter().map(|map| super::super::relabelled(&found, map));
                let least = all.map(|c| farthest(&scene, &c)).fold(f64::INFINITY, f64::min);
                assert!(found.len() == target.len() && least < 0.1, "{target:?} {k}: {least}");
            }
        }
    }

    #[test]
    fn both_charuco_layouts_are_found_in_every_turn() {
        for target in
            [charuco(7, 5, false), charuco(6, 8, false), charuco(6, 8, true), charuco(7, 6, true)]
        {
            for k in 0..4 {
                let scene = scene(&target, 0.3 + 1.6 * f64::from(k), 0.4);
                let found = detect(&scene.picture(&Optics::default(), 2), &target).unwrap();
                assert_eq!(found.len(), target.len(), "{target:?} turn {k}");
                assert!(farthest(&scene, &found) < 0.1, "{target:?} {k}");
            }
        }
    }

    fn aprilgrid(border_bits: u32) -> TargetModel {
        let toml = format!(
            r#"{{"kind":"aprilgrid","tags_x":5,"tags_y":4,"tag_mm":24.0,"spacing":0.3,"family":"36h11","border_bits":{border_bits}}}"#
        );
        serde_json::from_str(&toml).unwrap()
    }

    #[test]
    fn aprilgrids_are_found_in_every_turn() {
        for target in [aprilgrid(1), aprilgrid(2)] {
            for k in 0..4 {
                let scene = scene(&target, 0.3 + 1.6 * f64::from(k), 0.3);
                let found = detect(&scene.picture(&Optics::default(), 2), &target).unwrap();
                let farthest = farthest(&scene, &found);
                assert_eq!(found.len(), target.len(), "{target:?} turn {k}: {farthest}");
                // as near as in the middle: bits of the tags are no part of a corner at the rim
                assert!(farthest < 0.05, "{target:?} {k}: {farthest}");
            }
        }
    }

    #[test]
    fn a_part_of_a_charuco_board_is_enough() {
        let target = charuco(9, 7, false);
        let mut scene = scene(&target, 0.1, 0.35);
        let aside = Pose::from_parts(&Matrix3::identity(), Vector3::new(0.12, 0.05, 0.0));
        scene.camera_from_target = aside * scene.camera_from_target;
        let found = detect(&scene.picture(&Optics::default(), 3), &target).unwrap();
        assert!(found.len() > 10 && found.len() < 48, "{}", found.len());
        assert!(farthest(&scene, &found) < 0.15);
    }

    #[test]
    fn the_wrong_layout_or_dictionary_is_named() {
        let picture = scene(&charuco(6, 8, false), 0.1, 0.4).picture(&Optics::default(), 4);
        let mut other = charuco(6, 8, false);
        if let TargetModel::Charuco { dictionary, .. } = &mut other {
            *dictionary = "DICT_7X7_100".into();
        }
        let error = detect(&picture, &other).unwrap_err();
        assert!(error.to_string().contains("no marker of DICT_7X7_100"), "{error}");
        if let TargetModel::Charuco { dictionary, .. } = &mut other {
            *dictionary = "DICT_NONSENSE".into();
        }
        assert_eq!(
            detect(&picture, &other),
            Err(NotFound::UnknownDictionary("DICT_NONSENSE".into()))
        );
    }

    #[test]
    fn a_board_of_another_size_is_named() {
        let picture = scene(&checkerboard(9, 6), 0.1, 0.45).picture(&Optics::default(), 5);
        let error = detect(&picture, &checkerboard(7, 5)).unwrap_err();
        assert!(error.to_string().contains("9 x 6"), "{error}");
        let error = detect(&picture, &checkerboard(11, 8)).unwrap_err();
        assert!(error.to_string().starts_with("only 54 of 88 corners are visible"), "{error}");
    }

    #[test]
    fn a_hidden_corner_hides_no_board() {
        let target = checkerboard(9, 6);
        let scene = scene(&target, 0.1, 0.45);
        let picture = scene.picture(&Optics::default(), 6);
        let hidden = scene.corners()[22].1;
        let (width, height) = (picture.width(), picture.height());
        let values = picture.values().iter().enumerate().map(|(k, v)| {
            let at = Vector2::new((k % width) as f64, (k / width) as f64);
            if (at - hidden).norm() < 12.0 { 250.0 } else { *v }
        });
        let picture = GrayImage::new(width, height, values.collect()).unwrap();
        let found = detect(&picture, &target).unwrap();
        assert!(found.len() >= 53 - 4 && found.iter().all(|c| c.id != 22), "{}", found.len());
        assert!(farthest(&scene, &found) < 0.2);
    }

    #[test]
    fn pictures_without_a_board_say_so() {
        let target = checkerboard(9, 6);
        let dot = GrayImage::new(1, 1, vec![7.0]).unwrap();
        let error = detect(&dot, &target).unwrap_err().to_string();
        assert_eq!(error, "the image is 1 x 1 pixels, smaller than a board can be");
        for (width, height) in [(24, 24), (25, 301), (640, 480)] {
            let flat = GrayImage::new(width, height, vec![128.0; width * height]).unwrap();
            assert_eq!(detect(&flat, &target), Err(NotFound::NoCorners));
            let mut random = Random::new(9);
            let noise = (0..width * height).map(|_| random.between(0.0, 255.0) as f32).collect();
            assert!(detect(&GrayImage::new(width, height, noise).unwrap(), &target).is_err());
        }
        // halves of a strip end before nothing is left of them
        let strip = GrayImage::new(24, 60_000, vec![128.0; 24 * 60_000]).unwrap();
        assert_eq!(detect(&strip, &target), Err(NotFound::NoCorners));
        let broken = GrayImage::new(64, 64, vec![f32::NAN; 4096]).unwrap();
        assert!(detect(&broken, &charuco(7, 5, false)).is_err());
    }

    /// A checkerboard of whole black and white pixels, as a rasterised print has it.
    fn raster(columns: usize, rows: usize, cell: f64, margin: f64) -> GrayImage {
        let size = |n: usize| (2.0 * margin + cell * (n + 1) as f64).ceil() as usize;
        let (width, height) = (size(columns), size(rows));
        let index = |x: usize| ((x as f64 + 0.5 - margin) / cell).floor() as i64;
        let grey = |x: usize, y: usize| {
            let inside = |k: i64, n: usize| (0..=n as i64).contains(&k);
            let board = inside(index(x), columns) && inside(index(y), rows);
            if board && (index(x) + index(y)) % 2 == 0 { 0.0 } else { 255.0 }
        };
        let pixels = (0..width * height).map(|k| grey(k % width, k / width)).collect();
        GrayImage::new(width, height, pixels).unwrap()
    }

    #[test]
    fn a_perfectly_sharp_print_shows_all_corners() {
        for cell in [20.0, 29.53, 47.24, 59.06, 118.11, 147.64, 177.17] {
            for margin in [30.0, 59.37, 100.5] {
                let image = raster(8, 5, cell, margin);
                let found = detect(&image, &checkerboard(8, 5)).map(|c| c.len());
                assert_eq!(found, Ok(40), "cells of {cell} px, margin of {margin} px");
            }
        }
    }
}
