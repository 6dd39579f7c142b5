//! A printed target is the target: what the PDF shows is found, complete and in true scale.

use std::{fs, process::Command};

use handeye::{GrayImage, ImageCorner, TargetModel, detect};
use handeye_io::{
    drawing::{Paper, pdf, sheet},
    read_image,
};

const DPI: f64 = 150.0;

/// No lens is as sharp as a drawing: smooths by 1 4 6 4 1 along rows and columns.
fn through_a_lens(image: &GrayImage) -> GrayImage {
    let along = |image: &GrayImage, (dx, dy): (i64, i64)| {
        let at = |x: i64, y: i64| {
            let x = x.clamp(0, image.width() as i64 - 1);
            image.at(x as usize, y.clamp(0, image.height() as i64 - 1) as usize)
        };
        let smooth = |(x, y): (i64, i64)| {
            let weights = [1.0, 4.0, 6.0, 4.0, 1.0];
            let sum = (-2..=2).zip(weights).map(|(k, w)| w * at(x + k * dx, y + k * dy));
            sum.sum::<f32>() / 16.0
        };
        let (w, h) = (image.width() as i64, image.height() as i64);
        let values = (0..h).flat_map(|y| (0..w).map(move |x| (x, y))).map(smooth).collect();
        GrayImage::new(image.width(), image.height(), values).unwrap()
    };
    along(&along(image, (1, 0)), (0, 1))
}

/// Corners in the target's page, rendered by poppler; `None` where it is not installed.
fn corners_on_paper(name: &str, target: &TargetModel, paper: &str) -> Option<Vec<ImageCorner>> {
    let stem = std::env::temp_dir().join(format!("handeye-print-{}-{name}", std::process::id()));
    let (page, picture) = (stem.with_extension("pdf"), stem.with_extension("png"));
    let sheet = sheet(target, &Paper::named(paper).unwrap()).unwrap();
    fs::write(&page, pdf(&sheet, name)).unwrap();
    let rendered = Command::new("pdftoppm")
        .args(["-png", "-gray", "-singlefile", "-r", &DPI.to_string()])
        .args([&page, &stem])
        .output();
    let found = match rendered {
        Err(error) => {
            println!("skipped: pdftoppm (poppler-utils) does not run: {error}");
            None
        }
        Ok(output) => {
            assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
            let image = read_image(&picture, None).unwrap();
            assert_eq!(image.width(), (sheet.width / 25.4 * DPI).ceil() as usize);
            Some(detect::detect(&through_a_lens(&image), target).unwrap())
        }
    };
    fs::remove_file(&page).ok();
    fs::remove_file(&picture).ok();
    found
}

fn check(name: &str, target: &TargetModel, paper: &str) {
    let Some(corners) = corners_on_paper(name, target, paper) else { return };
    let ids: Vec<u32> = corners.iter().map(|c| c.id).collect();
    assert_eq!(ids, (0..target.len() as u32).collect::<Vec<_>>(), "{name}: all corners");
    let (first, last) = (&corners[0], &corners[corners.len() - 1]);
    let in_pixels = |id: u32| target.corner(id).unwrap().vector() * 1e3 / 25.4 * DPI;
    let drawn = (in_pixels(last.id) - in_pixels(first.id)).xy();
    let found = last.pixel - first.pixel;
    let error = (found - drawn).norm() / drawn.norm();
    println!("{name}: {:.4} % off over the diagonal", 100.0 * error);
    assert!(error < 1e-3, "{name}: {found:?} instead of {drawn:?}");
}

#[test]
fn a_printed_checkerboard_is_found_in_true_scale() {
    let board = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 25.0 };
    check("checkerboard", &board, "a4");
    let board = TargetModel::Checkerboard { columns: 6, rows: 9, square_mm: 17.3 };
    check("upright", &board, "letter");
}

#[test]
fn a_printed_charuco_board_is_found_in_true_scale() {
    for (name, squares_x, squares_y, dictionary, legacy) in [
        ("charuco", 5, 7, "DICT_6X6_250", false),
        ("even", 8, 6, "DICT_4X4_50", false),
        ("legacy", 5, 8, "DICT_5X5_100", true),
        ("april", 7, 5, "DICT_APRILTAG_36h11", false),
    ] {
        let board = TargetModel::Charuco {
            squares_x,
            squares_y,
            square_mm: 30.0,
            marker_mm: 22.0,
            dictionary: dictionary.into(),
            legacy,
            first_id: 0,
        };
        check(name, &board, "a3");
    }
}

#[test]
fn printed_grids_of_circles_are_found_in_true_scale() {
    let pitch_mm = 20.0;
    let grid = TargetModel::CircleGrid { columns: 9, rows: 6, pitch_mm };
    check("circles", &grid, "a4");
    let grid = TargetModel::AsymmetricCircleGrid { columns: 4, rows: 11, pitch_mm };
    check("asymmetric", &grid, "a4");
    let grid = TargetModel::ModifiedCircleGrid { columns: 10, rows: 8, pitch_mm };
    check("modified", &grid, "a4");
}
