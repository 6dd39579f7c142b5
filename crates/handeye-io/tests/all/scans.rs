//! Every kind of scan file gives the same points.

use std::{
    fs::{self, File},
    path::{Path, PathBuf},
};

use e57::{E57Writer, Record, RecordDataType, RecordName, RecordValue, Transform, Translation};
use handeye::Intrinsics;
use handeye_io::{Known, ScanOptions, first_manifest, read_scan, scan_unit, units::LengthUnit};

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

// ---------------------------------------------------------------- text

#[test]
fn text_with_every_separator_and_with_or_without_names() {
    let lines = |between: &str, more: &str| -> String {
        let line = |p: &[f32; 3]| format!("{}{more}\n", p.map(|x| x.to_string()).join(between));
        POINTS.iter().map(line).collect()
    };
    let comma = |text: String| text.replace('.', ",");
    let quoted: String =
        POINTS.iter().map(|p| format!("\"{}\",\"{}\",\"{}\"\n", p[0], p[1], p[2])).collect();
    let cases = [
        ("blanks.xyz", lines(" ", "")),
        ("many_blanks.txt", lines("   ", " ").replace("\n", " \r\n")),
        ("tabs.asc", lines("\t", "\t7")),
        ("commas.csv", format!("x,y,z,name\n{}", lines(", ", ",a b"))),
        ("quoted.csv", format!("\"X\",\"Y\",\"Z\"\n{}", quoted)),
        ("semicolons.csv", format!("x;y;z;w\r\n{}", comma(lines(";", ";1.5")))),
        ("decimal_comma.txt", comma(lines("\t", "\t0.5"))),
        ("cloud_compare.asc", format!("//X Y Z R G B\n6\n{}", lines(" ", " 255 0 0"))),
        ("count.pts", format!("6\n{}", lines(" ", " -1024 10 20 30"))),
        ("bom.csv", format!("\u{feff}x,y,z\n{}", lines(",", ""))),
        (
            "remarks.xyz",
            format!(
                "# written by hand, x y z are in mm\n\n{}",
                lines(" ", " # seen").replacen("# seen", "// seen", 2)
            ),
        ),
        ("units.csv", format!("x_mm,y_mm,z_mm\n{}", lines(",", ""))),
        ("brackets.csv", format!("X [mm];Y [mm];Z [mm]\n{}", lines(";", ""))),
    ];
    for (name, text) in cases {
        let path = file(name, text);
        holds_the_points(&path, &in_millimetres(), false);
        holds_the_points(&path, &ScanOptions { organised: Some((3, 2)), ..in_millimetres() }, true);
    }
    let all = lines(" ", "");
    let (first, second) = all.split_at(all.find("3 2").unwrap());
    let twice = format!("2\n{first}4\n{second}");
    holds_the_points(&file("twice.pts", twice), &in_millimetres(), false);
}

#[test]
fn columns_of_text_are_found_by_their_names() {
    let turned: String =
        POINTS.iter().map(|p| format!("9,{},{},0.5,{}\n", p[2], p[0], p[1])).collect();
    for (name, names) in [("named.csv", "id,z,x,quality,y\n"), ("remark.csv", "# id, Z, X, q, Y\n")]
    {
        holds_the_points(&file(name, format!("{names}{turned}")), &in_millimetres(), false);
    }
}

#[test]
fn empty_values_and_nan_in_text_are_points_that_were_not_seen() {
    let text = "x,y,z,i\n1,2,300,1\n2,2,301.5,1\n3,2,302,1\n1,3,303,1\n,,,\n3,3,305.25,1\n";
    holds_the_points(&file("empty.csv", text), &in_millimetres(), false);
    for missing in ["nan nan nan", "1 NaN 3", "inf 1 2", "1 2 -inf"] {
        let text = format!("1 2 300\n2 2 301.5\n3 2 302\n1 3 303\n{missing}\n3 3 305.25");
        holds_the_points(&file("nan.xyz", text), &in_millimetres(), false);
    }
    let tabs = "1\t2\t300\n2\t2\t301.5\n3\t2\t302\n1\t3\t303\n\t1\t4\n3\t3\t305.25\n";
    holds_the_points(&file("empty.txt", tabs), &in_millimetres(), false);
}

#[test]
fn a_unit_in_the_names_of_columns_needs_no_declaration_and_bears_no_contradiction() {
    let text: String = POINTS.iter().map(|p| format!("{},{},{}\n", p[0], p[1], p[2])).collect();
    let said = file("said.csv", format!("x_mm,y_mm,z_mm\n{text}"));
    assert_eq!(scan_unit(&said), Some(LengthUnit::Millimetre));
    holds_the_points(&said, &ScanOptions::default(), false);
    let metres = ScanOptions { length_unit: Some(LengthUnit::Metre), ..ScanOptions::default() };
    let message = read_scan(&said, &metres).unwrap_err().to_string();
    assert!(message.contains("its columns are in mm, but m is declared"), "{message}");
    let silent = file("silent.csv", format!("x,y,z\n{text}"));
    assert_eq!(scan_unit(&silent), None);
    let question = read_scan(&silent, &ScanOptions::default()).unwrap_err().to_string();
    assert!(question.contains("length_unit is missing"), "{question}");
}

// ---------------------------------------------------------------- E57

/// One scan of an E57 file: a pose, and of each point its place (m) and more values.
type Values = Vec<Vec<RecordValue>>;

fn e57_file(name: &str, scans: &[(Option<Transform>, Vec<Record>, Values)]) -> PathBuf {
    let path = file(name, []);
    let mut writer = E57Writer::from_file(&path, "{whole}").unwrap();
    for (pose, records, values) in scans {
        let mut points = writer.add_pointcloud("{scan}", records.clone()).unwrap();
        points.set_transform(pose.clone());
        values.iter().for_each(|v| points.add_point(v.clone()).unwrap());
        points.finalize().unwrap();
    }
    writer.finalize().unwrap();
    path
}

const SINGLE: [Record; 3] =
    [Record::CARTESIAN_X_F32, Record::CARTESIAN_Y_F32, Record::CARTESIAN_Z_F32];

fn index(name: RecordName, max: i64) -> Record {
    Record { name, data_type: RecordDataType::Integer { min: 0, max } }
}

fn metres(p: &[f32; 3]) -> Vec<RecordValue> {
    p.iter().map(|x| RecordValue::Single(x / 1000.0)).collect()
}

#[test]
fn e57_of_one_scan_keeps_its_rows_and_columns_and_its_own_frame() {
    let mut records = SINGLE.to_vec();
    records.extend([
        index(RecordName::RowIndex, 1),
        index(RecordName::ColumnIndex, 2),
        index(RecordName::Intensity, 0), // a constant takes no bits
        Record::CARTESIAN_INVALID_STATE,
    ]);
    let value = |(k, p): (usize, &[f32; 3])| {
        let missing = i64::from(k == 4) * 2;
        let more = [(k / 3) as i64, (k % 3) as i64, 0, missing].map(RecordValue::Integer);
        [metres(if k == 4 { &[7.0; 3] } else { p }), more.to_vec()].concat()
    };
    // from the last to the first
    let values = POINTS.iter().enumerate().rev().map(value).collect();
    let pose =
        Transform { translation: Translation { x: 1.0, y: 2.0, z: 3.0 }, ..Transform::default() };
    let path = e57_file("grid.e57", &[(Some(pose), records, values)]);
    assert_eq!(scan_unit(&path), Some(LengthUnit::Metre));
    holds_the_points(&path, &ScanOptions::default(), true);
    // its unit is known: what is declared for other files does not matter
    holds_the_points(&path, &in_millimetres(), true);
}

#[test]
fn e57_of_several_scans_is_put_together_by_their_poses() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let pose = Transform {
        rotation: e57::Quaternion { w: half, x: 0.0, y: 0.0, z: half }, // x to y
        translation: Translation { x: 0.5, y: 0.0, z: 0.25 },
    };
    let values = || vec![metres(&[1.0, 2.0, 300.0]), metres(&[4.0, 5.0, 600.0])];
    let scans = [(None, SINGLE.to_vec(), values()), (Some(pose), SINGLE.to_vec(), values())];
    let scan = read_scan(&e57_file("several.e57", &scans), &ScanOptions::default()).unwrap();
    assert_eq!((scan.width(), scan.height()), (4, 1));
    let expected =
        [[0.001, 0.002, 0.3], [0.004, 0.005, 0.6], [0.498, 0.001, 0.55], [0.495, 0.004, 0.85]];
    for (found, expected) in scan.points().iter().zip(expected) {
        assert!((0..3).all(|i| (found[i] - expected[i]).abs() < 1e-6), "{found:?} {expected:?}");
    }
}

#[test]
fn e57_numbers_of_every_kind_are_unpacked() {
    let scaled = |name| Record {
        name,
        data_type: RecordDataType::ScaledInteger {
            min: -5000,
            max: 700_000,
            scale: 1e-6,
            offset: 0.0,
        },
    };
    let whole = |x: f32| RecordValue::ScaledInteger((f64::from(x) * 1e3).round() as i64);
    let records = vec![
        Record::CARTESIAN_Y_F64,
        scaled(RecordName::CartesianX),
        index(RecordName::Intensity, 5),
        scaled(RecordName::CartesianZ),
    ];
    // enough of them for several packets
    let many = 50_000;
    let value = |k: usize| {
        let p = POINTS[k % 6];
        let y = RecordValue::Double(f64::from(p[1]) / 1000.0);
        vec![y, whole(p[0]), RecordValue::Integer((k % 6) as i64), whole(p[2])]
    };
    let path = e57_file("kinds.e57", &[(None, records, (0..many).map(value).collect())]);
    let scan = read_scan(&path, &ScanOptions::default()).unwrap();
    assert_eq!(scan.points().len(), many);
    for (k, found) in scan.points().iter().enumerate() {
        let given = POINTS[k % 6];
        let is_missing = given == [0.0; 3];
        assert_eq!(found[0].is_nan(), is_missing);
        let near = |i: usize| (found[i] - given[i] / 1000.0).abs() < 1e-6;
        assert!(is_missing || (0..3).all(near), "{k}: {found:?}");
    }
}

#[test]
fn e57_in_ranges_and_angles_is_turned_into_points() {
    let records = vec![
        Record::SPHERICAL_RANGE_F64,
        Record::SPHERICAL_AZIMUTH_F64,
        Record::SPHERICAL_ELEVATION_F64,
    ];
    let angles = [2.0, 0.3, -0.2].map(RecordValue::Double).to_vec();
    let path = e57_file("angles.e57", &[(None, records, vec![angles])]);
    let scan = read_scan(&path, &ScanOptions::default()).unwrap();
    let found = scan.at(0, 0).unwrap();
    let (flat, up) = (2.0 * 0.2f64.cos(), -2.0 * 0.2f64.sin());
    let expected = nalgebra::Vector3::new(flat * 0.3f64.cos(), flat * 0.3f64.sin(), up);
    assert!((found - expected).norm() < 1e-6, "{found}");
}

#[test]
fn e57_points_that_share_a_place_of_the_grid_stay_a_list() {
    let mut records = SINGLE.to_vec();
    records.extend([index(RecordName::RowIndex, 9), index(RecordName::ColumnIndex, 9)]);
    let at = |row: i64, column: i64| {
        [metres(&POINTS[0]), [row, column].map(RecordValue::Integer).to_vec()].concat()
    };
    for (name, values) in [
        ("shared.e57", vec![at(0, 0), at(1, 1), at(0, 0)]),
        ("sparse.e57", vec![at(0, 0), at(9, 9), at(5, 0)]),
    ] {
        let path = e57_file(name, &[(None, records.clone(), values)]);
        let scan = read_scan(&path, &ScanOptions::default()).unwrap();
        assert_eq!((scan.width(), scan.height()), (3, 1), "{name}");
    }
}

/// Changes some text of the same length in an E57 file, and the checksums of its pages.
fn changed(path: &Path, name: &str, from: &str, to: &str) -> PathBuf {
    assert_eq!(from.len(), to.len());
    let whole = fs::read(path).unwrap();
    let mut content: Vec<u8> = whole.chunks(1024).flat_map(|page| page[..1020].to_vec()).collect();
    while let Some(at) = content.windows(from.len()).position(|w| w == from.as_bytes()) {
        content[at..at + from.len()].copy_from_slice(to.as_bytes());
    }
    let page = |page: &[u8]| [page, &crc32c(page).to_be_bytes()].concat();
    file(name, content.chunks(1020).flat_map(page).collect::<Vec<u8>>())
}

/// The checksum of Castagnoli's polynomial.
fn crc32c(bytes: &[u8]) -> u32 {
    let bit = |crc: u32| if crc & 1 == 1 { crc >> 1 ^ 0x82F6_3B78 } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| bit(crc)))
}

#[test]
fn broken_e57_is_refused() {
    let values: Values = POINTS.iter().map(metres).collect();
    let good = e57_file("good.e57", &[(None, SINGLE.to_vec(), values)]);
    let bytes = fs::read(&good).unwrap();
    let mut flipped = bytes.clone();
    flipped[60] ^= 1;
    let constant = |name| Record {
        name,
        data_type: RecordDataType::ScaledInteger { min: 1, max: 2, scale: 1.0, offset: 0.0 },
    };
    let constants =
        [RecordName::CartesianX, RecordName::CartesianY, RecordName::CartesianZ].map(constant);
    let one = vec![RecordValue::ScaledInteger(1); 3];
    let promise = "recordCount=\"6\"";
    let cases = [
        (file("no.e57", "ASTM-E57"), "cannot be read as E57 ("),
        (file("cut.e57", &bytes[..bytes.len() - 1024]), "cannot be read as E57 ("),
        (file("part.e57", &bytes[..bytes.len() - 7]), "cannot be read as E57 ("),
        (file("flipped.e57", flipped), "cannot be read as E57 ("),
        (
            changed(&good, "more.e57", promise, "recordCount=\"9\""),
            "is cut short: the header promises 9 points; copy or record it again",
        ),
        (changed(&good, "none.e57", promise, "recordCount=\"0\""), "the scan holds no point"),
        (changed(&good, "axes.e57", "<cartesianX", "<cartesianQ"), "cannot be read as E57 ("),
        (
            changed(
                &e57_file("two.e57", &[(None, constants.to_vec(), vec![one; 2])]),
                "constant.e57",
                "maximum=\"2\"",
                "maximum=\"1\"",
            ),
            "is cut short: the header promises 2 points; copy or record it again",
        ),
    ];
    for (path, expected) in cases {
        let error = read_scan(&path, &ScanOptions::default()).err();
        let message =
            error.unwrap_or_else(|| panic!("{} was accepted", path.display())).to_string();
        let start = format!("{}: {expected}", path.display());
        assert!(message.starts_with(&start), "{message}\n{start}");
    }
    let many: Values = (0..5000).map(|k| metres(&[1.0, 2.0, 3.0 + k as f32])).collect();
    let many = e57_file("many.e57", &[(None, SINGLE.to_vec(), many)]);
    let absurd = changed(&many, "absurd.e57", "recordCount=\"5000\"", "recordCount=\"9999\"");
    let message = read_scan(&absurd, &ScanOptions::default()).unwrap_err().to_string();
    assert!(message.contains("the header promises 9999 points"), "{message}");
}

#[test]
fn a_first_manifest_names_scans_of_every_kind_and_asks_for_a_unit_only_where_none_is_known() {
    let root = file("x", []).parent().unwrap().join("first");
    let lines: String = (0..1000).map(|k| format!("{k} 1.5 600.25\n")).collect();
    for (kind, content, is_asked) in [
        ("e57", "", false),
        ("zdf", "", false),
        ("xyz", "1 2 3\n", true),
        ("asc", "//x_mm y_mm z_mm\n1 2 3\n", false),
        ("pts", "1\n1 2 3 4\n", true),
        ("txt", &lines, true),
    ] {
        let folder = root.join(kind);
        fs::create_dir_all(&folder).unwrap();
        for k in 1..4 {
            fs::write(folder.join(format!("scan_{k}.{kind}")), content).unwrap();
        }
        let manifest = first_manifest(&folder, &Known::default()).unwrap().text;
        assert!(manifest.contains(&format!("[scans]\nfiles = \"scan_*.{kind}\"")), "{manifest}");
        assert_eq!(manifest.contains("are the points in"), is_asked, "{manifest}");
    }
}
