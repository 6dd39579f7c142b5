//! Simulated datasets: what is written is read back, and nothing of others is touched.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye::{
    Config, Intrinsics, Setup, TargetModel, calibrate,
    model::verdict::Verdict,
    simulate::{Cell, CellNoise, DepthSensor},
};
use handeye_io::{
    Dataset,
    calibrate::calibrate_dataset,
    measure,
    simulated::{self, ScanFormat, Writing},
};

fn folder(name: &str) -> PathBuf {
    let folder =
        std::env::temp_dir().join(format!("handeye-simulated-{name}-{}", std::process::id()));
    fs::remove_dir_all(&folder).ok();
    folder
}

fn small(setup: Setup) -> Cell {
    Cell {
        intrinsics: Intrinsics::pinhole(640, 480, 600.0, 600.0, 319.5, 239.5),
        captures: 8,
        ..Cell::new(setup, 2)
    }
}

fn write(cell: &Cell, folder: &Path, with_images: bool) -> Vec<String> {
    write_as(cell, folder, Writing { images: with_images, scans: ScanFormat::DepthPng })
}

fn write_as(cell: &Cell, folder: &Path, writing: Writing) -> Vec<String> {
    simulated::write(&cell.record(5).unwrap(), folder, writing).unwrap()
}

/// Translation error of the chosen answer, mm.
fn error_mm(cell: &Cell, folder: &Path) -> f64 {
    let measured = measure::measure(&Dataset::open(folder).unwrap(), &|_, _| {}).unwrap();
    let found = calibrate(&measured.session, &Config::default()).unwrap();
    assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
    assert!(found.candidates.iter().any(|c| c.name == "two-step-svd"));
    let x = found.hand_eye.mount_from_camera.unwrap();
    x.distance_to(&cell.hand_eye.mount_from_camera) * 1e3
}

#[test]
fn exact_lists_of_corners_are_read_back_exactly() {
    for setup in [Setup::EyeInHand, Setup::EyeToHand] {
        let folder = folder(&format!("exact-{setup:?}"));
        let cell = Cell { noise: CellNoise::NONE, ..small(setup) };
        write(&cell, &folder, false);
        let error = error_mm(&cell, &folder);
        assert!(error < 1e-6, "{setup:?}: {error:.1e} mm");
        fs::remove_dir_all(folder).unwrap();
    }
}

/// A limit of the caller's holds where the manifest has none, and the manifest's comes first.
#[test]
fn limits_of_the_caller_hold_where_the_manifest_says_nothing() {
    let folder = folder("limits");
    write(&small(Setup::EyeInHand), &folder, false);
    let verdict = |max_error_mm| {
        let config = Config { max_error_mm, ..Config::default() };
        let dataset = Dataset::open(&folder).unwrap();
        calibrate_dataset(&dataset, &config, &|_, _| {}).unwrap().0.verdict
    };
    assert_eq!(verdict(None), Verdict::Accepted);
    assert_eq!(verdict(Some(1e-3)), Verdict::Rejected);
    let manifest = fs::read_to_string(folder.join("handeye.toml")).unwrap();
    fs::write(folder.join("handeye.toml"), manifest + "\n[limits]\nmax_error_mm = 10.0\n").unwrap();
    assert_eq!(verdict(Some(1e-3)), Verdict::Accepted);
    fs::remove_dir_all(folder).unwrap();
}

/// Of one camera whose intrinsics are to be estimated, images of two sizes are not.
#[test]
fn images_of_two_sizes_give_no_intrinsics() {
    let folder = folder("sizes");
    write(&small(Setup::EyeInHand), &folder, true);
    let manifest = fs::read_to_string(folder.join("handeye.toml")).unwrap();
    let (before, camera) = manifest.split_once("[camera]").unwrap();
    let after = camera.find("\n[").map_or("", |at| &camera[at..]);
    fs::write(folder.join("handeye.toml"), format!("{before}{after}")).unwrap();
    let dataset = Dataset::open(&folder).unwrap();
    let last = dataset.captures.last().unwrap().image.clone().unwrap();
    image::GrayImage::new(320, 240).save(&last).unwrap();
    let error = measure::measure(&dataset, &|_, _| {}).err().unwrap().to_string();
    assert!(error.contains("320 x 240 pixels, those before it are 640 x 480"), "{error}");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn pictures_and_scans_of_every_target_give_the_truth() {
    let charuco = TargetModel::Charuco {
        squares_x: 8,
        squares_y: 6,
        square_mm: 30.0,
        marker_mm: 22.0,
        dictionary: "DICT_4X4_50".into(),
        legacy: false,
        first_id: 0,
    };
    let tag = TargetModel::Tag { dictionary: "DICT_6X6_250".into(), id: 3, size_mm: 120.0 };
    let board = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 };
    for (k, (target, limit_mm)) in
        [(board, 0.5), (charuco, 0.5), (tag, 1.5)].into_iter().enumerate()
    {
        let folder = folder(&format!("rendered-{k}"));
        let depth = Some(DepthSensor::default());
        let noise = CellNoise { touch_m: 0.1e-3, ..CellNoise::NONE };
        let cell = Cell { target, noise, depth, scan_scale: 0.5, ..small(Setup::EyeToHand) };
        write(&cell, &folder, true);
        let error = error_mm(&cell, &folder);
        assert!(error < limit_mm, "{:?}: {error:.3} mm", cell.target);
        fs::remove_dir_all(folder).unwrap();
    }
}

#[test]
fn views_check_the_camera_that_is_given() {
    let folder = folder("camera");
    write(&Cell { captures: 12, ..small(Setup::EyeInHand) }, &folder, false);
    let manifest = folder.join("handeye.toml");
    let text = fs::read_to_string(&manifest).unwrap();
    let measured = |camera: &str| {
        let (before, rest) = text.split_once("[camera]\n").unwrap();
        let after = rest.find("\n[").map_or("", |at| &rest[at..]);
        fs::write(&manifest, format!("{before}[camera]\n{camera}{after}")).unwrap();
        measure::measure(&Dataset::open(&folder).unwrap(), &|_, _| {}).unwrap()
    };
    let given = |fx: f64, calibrate: &str| {
        let values = "width = 640\nheight = 480\nfy = 600.0\ncx = 319.5\ncy = 239.5\n";
        measured(&format!("{values}fx = {fx:.1}\n{calibrate}"))
    };
    let says =
        |m: &measure::Measured, code: &str| m.noticed.warnings.iter().any(|w| w.code == code);
    let asked = "calibrate = \"brown-conrady\"\n";
    assert!(!says(&given(600.0, asked), "camera-disagrees"));
    assert!(says(&given(615.0, asked), "camera-disagrees"));
    assert!(!says(&given(615.0, ""), "camera-disagrees"), "only where it is asked for");
    let open = measured("width = 640\nheight = 480\ncalibrate = \"kannala-brandt\"\n");
    assert!(says(&open, "camera-calibrated-from-views"));
    let found = open.session.camera.unwrap();
    assert!(matches!(found.distortion, handeye::Distortion::KannalaBrandt(_)), "{found:?}");
    fs::remove_dir_all(folder).unwrap();
}

/// Adds to both coordinates of all corners in the lists of a folder.
fn shift_corners(folder: &Path, by_px: f64) {
    let lists = fs::read_dir(folder.join("corners")).unwrap();
    for path in lists.map(|entry| entry.unwrap().path()) {
        let text = fs::read_to_string(&path).unwrap();
        let mut lines = text.lines();
        let header = lines.next().unwrap();
        let shifted = |line: &str| {
            let n: Vec<f64> = line.split(',').map(|n| n.parse().unwrap()).collect();
            format!("\n{},{},{}", n[0], n[1] + by_px, n[2] + by_px)
        };
        fs::write(&path, format!("{header}{}\n", lines.map(shifted).collect::<String>())).unwrap();
    }
}

#[test]
fn imported_corners_that_are_half_a_pixel_off_are_told_the_pixel_origin() {
    let folder = folder("half-pixel");
    // narrow views of a small board tell it only where corners are exact
    let noise = CellNoise { corner_px: 0.005, ..CellNoise::default() };
    let cell = Cell { captures: 25, noise, ..small(Setup::EyeInHand) };
    write(&cell, &folder, false);
    let manifest = folder.join("handeye.toml");
    let text = fs::read_to_string(&manifest).unwrap();
    let said = |origin: &str| {
        let declared = format!("pixel_origin = \"{origin}\"");
        fs::write(&manifest, text.replace("pixel_origin = \"centre\"", &declared)).unwrap();
        let measured = measure::measure(&Dataset::open(&folder).unwrap(), &|_, _| {}).unwrap();
        let warning = measured.noticed.warnings.into_iter().find(|w| w.code == "half-pixel");
        warning.map(|w| w.message)
    };
    assert_eq!(said("centre"), None);
    let message = said("corner").unwrap();
    assert!(message.contains("say pixel_origin = \"centre\" in [corners]"), "{message}");
    shift_corners(&folder, 0.5);
    let message = said("centre").unwrap();
    assert!(message.contains("say pixel_origin = \"corner\" in [corners]"), "{message}");
    assert_eq!(said("corner"), None);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn one_of_several_targets_is_used() {
    let folder = folder("several");
    let cell = small(Setup::EyeToHand);
    write(&cell, &folder, false);
    let manifest = folder.join("handeye.toml");
    let text = fs::read_to_string(&manifest).unwrap();
    let other = "[[target]]\nname = \"table\"\nkind = \"tag\"\ndictionary = \"DICT_6X6_250\"\nid = 1\nsize_mm = 40\n\n";
    let several = text.replace("[target]\n", &format!("{other}[[target]]\nname = \"flange\"\n"));
    fs::write(&manifest, &several).unwrap();
    let message = Dataset::open(&folder).unwrap_err().to_string();
    let expected = "captures.target is missing, with 2 targets; name one of table, flange";
    assert!(message.contains(expected), "{message}");
    fs::write(&manifest, format!("{several}\n[captures]\ntarget = \"flange\"\n")).unwrap();
    let dataset = Dataset::open(&folder).unwrap();
    assert_eq!(dataset.target.as_ref(), Some(&cell.target));
    assert_eq!(dataset.other_targets.len(), 1);
    assert!(error_mm(&cell, &folder) < 2.0);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    let (a, b) = (folder("bytes-a"), folder("bytes-b"));
    let cell = Cell { captures: 1, depth: Some(DepthSensor::default()), ..small(Setup::EyeInHand) };
    let names = write(&cell, &a, true);
    assert_eq!(names, write(&cell, &b, true));
    for name in names {
        assert_eq!(fs::read(a.join(&name)).unwrap(), fs::read(b.join(&name)).unwrap(), "{name}");
    }
    fs::remove_dir_all(a).unwrap();
    fs::remove_dir_all(b).unwrap();
}

#[test]
fn only_an_earlier_simulation_is_cleared() {
    let folder = folder("clear");
    write(&small(Setup::EyeToHand), &folder, false);
    fs::write(folder.join("mine.txt"), "keep").unwrap();
    assert!(simulated::clear(&folder).unwrap());
    assert!(folder.join("mine.txt").exists() && !folder.join("robot.csv").exists());
    assert!(!simulated::clear(&folder).unwrap());
    let outside = r#"{"format": "handeye-simulation-1", "files": ["../x", "/etc/passwd"]}"#;
    fs::write(folder.join(simulated::TRUTH), outside).unwrap();
    assert!(simulated::clear(&folder).unwrap());
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn scans_of_every_format_hold_the_same_points() {
    let cell = Cell {
        captures: 2,
        depth: Some(DepthSensor::default()),
        scan_scale: 0.25,
        ..small(Setup::EyeInHand)
    };
    let scans = [ScanFormat::DepthPng, ScanFormat::Ply, ScanFormat::Pcd].map(|scans| {
        let folder = folder(&format!("scans-{scans:?}"));
        write_as(&cell, &folder, Writing { images: true, scans });
        let dataset = Dataset::open(&folder).unwrap();
        let scan = dataset.scan(dataset.captures[1].scan.as_ref().unwrap()).unwrap();
        fs::remove_dir_all(folder).unwrap();
        scan
    });
    let [depth, ply, pcd] = &scans;
    assert_eq!((ply.width(), ply.height()), (160, 120));
    let bits = |s: &handeye::Scan| -> Vec<u32> {
        s.points().iter().flatten().map(|x| x.to_bits()).collect()
    };
    assert_eq!(bits(ply), bits(pcd));
    for (a, b) in depth.points().iter().zip(ply.points()) {
        assert_eq!(a[2].is_nan(), b[2].is_nan());
        assert!(a[2].is_nan() || (a[2] - b[2]).abs() < 1e-4, "{a:?} {b:?}");
    }
}

#[test]
fn a_file_that_was_edited_or_added_is_noticed() {
    let folder = folder("foreign");
    assert_eq!(simulated::foreign(&folder), None);
    write(&small(Setup::EyeToHand), &folder, false);
    assert_eq!(simulated::foreign(&folder), None);
    let manifest = folder.join("handeye.toml");
    let text = fs::read_to_string(&manifest).unwrap();
    fs::write(&manifest, text.clone() + "# mine\n").unwrap();
    assert_eq!(simulated::foreign(&folder), Some(manifest.clone()));
    fs::write(&manifest, text).unwrap();
    fs::write(folder.join("corners/mine.txt"), "keep").unwrap();
    assert_eq!(simulated::foreign(&folder), Some(folder.join("corners/mine.txt")));
    fs::remove_dir_all(folder).unwrap();
}
