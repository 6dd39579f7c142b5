//! Every kind of scan file gives the same points.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

use std::{
    fs::{self, File},
    path::{Path, PathBuf},
};

use handeye::Intrinsics;
use handeye_io::{ScanOptions, read_scan, units::LengthUnit};

/// Two rows of three points, mm; one missing.
const POINTS: [[f32; 3]; 6] = [
    [1.0, 2.0, 300.0],
    [2.0, 2.0, 301.5],
    [3.0, 2.0, 302.0],
    [1.0, 3.0, 303.0],
    [0.0, 0.0, 0.0],
    [3.0, 3.0, 305.25],
];

fn file(name: &str, content: impl AsRef<[u8]>) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("handeye-scans-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, content).unwrap();
    path
}

fn in_millimetres() -> ScanOptions {
    ScanOptions { length_unit: Some(LengthUnit::Millimetre), ..ScanOptions::default() }
}

/// The scan of a file is the six points, organised or not.
fn holds_the_points(path: &Path, options: &ScanOptions, organised: bool) {
    let scan = read_scan(path, options).unwrap();
    let size = if organised { (3, 2) } else { (6, 1) };
    assert_eq!((scan.width(), scan.height()), size, "{}", path.display());
    for (found, given) in scan.points().iter().zip(POINTS) {
        if given == [0.0; 3] {
            assert!(found.iter().all(|x| x.is_nan()));
        } else {
            assert!((0..3).all(|i| (found[i] - given[i] / 1000.0).abs() < 1e-7), "{found:?}");
        }
    }
}

fn bytes(of: impl Fn(f32) -> [u8; 4]) -> Vec<u8> {
    POINTS.iter().flatten().flat_map(|x| of(*x)).collect()
}

#[test]
fn ply_of_all_three_encodings() {
    let header = |format: &str, more: &str| {
        format!(
            "ply\nformat {format} 1.0\n{more}element vertex 6\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
        )
    };
    let text: String = POINTS.iter().map(|p| format!("{} {} {}\n", p[0], p[1], p[2])).collect();
    let ascii = file("a.ply", header("ascii", "") + &text);
    holds_the_points(&ascii, &in_millimetres(), false);
    holds_the_points(&ascii, &ScanOptions { organised: Some((3, 2)), ..in_millimetres() }, true);
    let grid = "obj_info num_cols 3\nobj_info num_rows 2\n";
    let little =
        [header("binary_little_endian", grid).into_bytes(), bytes(f32::to_le_bytes)].concat();
    holds_the_points(&file("l.ply", little), &in_millimetres(), true);
    let big = [header("binary_big_endian", "").into_bytes(), bytes(f32::to_be_bytes)].concat();
    holds_the_points(&file("b.ply", big), &in_millimetres(), false);
}

#[test]
fn ply_with_other_elements_and_properties_before_the_points() {
    let header = "ply\r\nformat binary_little_endian 1.0\r\nelement face 2\r\nproperty list uchar int vertex_indices\r\nelement vertex 6\r\nproperty uchar red\r\nproperty double z\r\nproperty float x\r\nproperty float y\r\nend_header\r\n";
    let mut content = header.as_bytes().to_vec();
    for face in [3u8, 4] {
        content.push(face);
        content.extend(vec![0u8; 4 * usize::from(face)]);
    }
    for [x, y, z] in POINTS {
        content.push(7);
        content.extend(f64::from(z).to_le_bytes());
        content.extend(x.to_le_bytes());
        content.extend(y.to_le_bytes());
    }
    holds_the_points(&file("faces.ply", content), &in_millimetres(), false);
}

/// LZF without any repetition: runs of at most 32 bytes, each after its length less one.
fn packed(bytes: &[u8]) -> Vec<u8> {
    let runs = bytes.chunks(32).flat_map(|run| [&[run.len() as u8 - 1], run].concat());
    runs.collect()
}

#[test]
fn pcd_of_all_three_encodings() {
    let header = |data: &str| {
        format!(
            "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 2\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 6\nDATA {data}\n"
        )
    };
    let text: String = POINTS.iter().map(|p| format!("{} {} {}\n", p[0], p[1], p[2])).collect();
    holds_the_points(&file("a.pcd", header("ascii") + &text), &in_millimetres(), true);
    let binary = [header("binary").into_bytes(), bytes(f32::to_le_bytes)].concat();
    holds_the_points(&file("b.pcd", binary), &in_millimetres(), true);
    let by_field: Vec<u8> =
        (0..3).flat_map(|i| POINTS.iter().flat_map(move |p| p[i].to_le_bytes())).collect();
    let small = packed(&by_field);
    let sizes =
        [(small.len() as u32).to_le_bytes(), (by_field.len() as u32).to_le_bytes()].concat();
    let compressed = [header("binary_compressed").into_bytes(), sizes, small].concat();
    holds_the_points(&file("c.pcd", compressed), &in_millimetres(), true);
}

fn npy(descr: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}\n");
    let length = (header.len() as u16).to_le_bytes();
    [b"\x93NUMPY\x01\x00".as_slice(), &length, header.as_bytes(), data].concat()
}

#[test]
fn points_of_numpy_files_are_organised_by_their_shape() {
    let data = bytes(f32::to_le_bytes);
    holds_the_points(&file("o.npy", npy("<f4", "(2, 3, 3)", &data)), &in_millimetres(), true);
    holds_the_points(&file("u.npy", npy("<f4", "(6, 3)", &data)), &in_millimetres(), false);
}

#[test]
fn depth_of_png_tiff_and_numpy_becomes_the_same_scan() {
    let (width, height) = (16u32, 12u32);
    let depth: Vec<u16> =
        (0..width * height).map(|i| if i == 5 { 0 } else { 500 + i as u16 }).collect();
    let options = ScanOptions {
        depth_scale: Some(0.001),
        intrinsics: Some(Intrinsics::pinhole(width, height, 20.0, 20.0, 7.5, 5.5)),
        ..ScanOptions::default()
    };
    let png = file("d.png", []);
    let picture = image::ImageBuffer::<image::Luma<u16>, _>::from_raw(width, height, depth.clone());
    picture.unwrap().save(&png).unwrap();
    let raw: Vec<u8> = depth.iter().flat_map(|d| d.to_le_bytes()).collect();
    let npy = file("d.npy", npy("<u2", "(12, 16)", &raw));
    let metres: Vec<f32> = depth.iter().map(|d| f32::from(*d) * 0.001).collect();
    let float = file("d.tiff", []);
    let mut tiff = tiff::encoder::TiffEncoder::new(File::create(&float).unwrap()).unwrap();
    tiff.write_image::<tiff::encoder::colortype::Gray32Float>(width, height, &metres).unwrap();
    let whole = file("w.tiff", []);
    let mut tiff = tiff::encoder::TiffEncoder::new(File::create(&whole).unwrap()).unwrap();
    tiff.write_image::<tiff::encoder::colortype::Gray16>(width, height, &depth).unwrap();

    let in_metres = ScanOptions { depth_scale: Some(1.0), ..options };
    let scan = read_scan(&png, &options).unwrap();
    assert!(scan.at(5, 0).is_none());
    let point = scan.at(15, 11).unwrap();
    assert!((point.z - 0.691).abs() < 1e-6 && (point.x - 0.691 * 7.5 / 20.0).abs() < 1e-6);
    for (path, options) in [(&npy, &options), (&whole, &options), (&float, &in_metres)] {
        let other = read_scan(path, options).unwrap();
        for (a, b) in scan.points().iter().zip(other.points()) {
            assert!((0..3).all(|i| a[i].is_nan() && b[i].is_nan() || (a[i] - b[i]).abs() < 1e-6));
        }
    }
    let question = read_scan(&npy, &ScanOptions { depth_scale: None, ..options }).unwrap_err();
    assert!(question.to_string().ends_with("d.npy: depth_scale is missing; how many metres is one unit of its whole numbers? (0.001 for millimetres)"));
    let no_camera = read_scan(&npy, &ScanOptions { intrinsics: None, ..options }).unwrap_err();
    assert!(no_camera.to_string().contains("[scans.camera] is missing"), "{no_camera}");
}
