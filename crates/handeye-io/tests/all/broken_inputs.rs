//! Broken inputs are refused with a message that says where, what, and what to do; nothing panics.

use std::{
    fs,
    path::{Path, PathBuf},
    sync::atomic::{AtomicUsize, Ordering},
};

use handeye::Intrinsics;
use handeye_io::{Dataset, ScanOptions, read_image, read_intrinsics, read_scan, units::LengthUnit};

/// A folder of its own for a test, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let n = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("handeye-broken-{}-{n}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
    fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, content).unwrap();
        path
    }
    /// A message with this folder's name cut off.
    fn message(&self, error: &dyn std::error::Error) -> String {
        let folder = format!("{}/", self.0.display());
        error.to_string().replace(&folder, "").replace(&*self.0.to_string_lossy(), ".")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.0).ok();
    }
}

fn png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::GrayImage::new(width, height).write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// A PNG whose header promises a size that is not there.
fn png_with_header(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = png(16, 16);
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let crc = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&crc.to_be_bytes());
    bytes
}

fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, byte: &u8| {
        (0..8).fold(crc ^ u32::from(*byte), |c, _| {
            if c & 1 == 1 { 0xedb8_8320 ^ (c >> 1) } else { c >> 1 }
        })
    };
    !bytes.iter().fold(!0, step)
}

/// Each part of a working manifest, to be replaced by a broken one.
struct Manifest {
    setup: &'static str,
    target: &'static str,
    robot: &'static str,
    images: &'static str,
    more: &'static str,
}

const WORKING: Manifest = Manifest {
    setup: "setup = \"eye-in-hand\"",
    target: "[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0",
    robot: "[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"",
    images: "[images]\nfiles = \"img_*.png\"",
    more: "",
};

const POSES: &str = "0.1,0.2,0.3,0.1,0.2,0.3\n0.2,0.2,0.3,0.1,0.2,0.3\n0.3,0.2,0.3,0.1,0.2,0.4\n";

/// Opens a folder with a manifest, poses and three images.
fn open(manifest: &Manifest, poses: &str) -> Result<Dataset, String> {
    let folder = Folder::new();
    let Manifest { setup, target, robot, images, more } = manifest;
    folder.write("handeye.toml", format!("{setup}\n{target}\n{robot}\n{images}\n{more}\n"));
    folder.write("poses.csv", poses);
    for i in 1..=3 {
        folder.write(&format!("img_{i}.png"), png(640, 480));
    }
    Dataset::open(&folder.0).map_err(|e| folder.message(&e))
}

#[test]
fn the_working_folder_works() {
    assert_eq!(open(&WORKING, POSES).unwrap().captures.len(), 3);
}

#[test]
fn broken_manifests_are_refused_by_line() {
    let robot = |robot| Manifest { robot, ..WORKING };
    let target = |target| Manifest { target, ..WORKING };
    let more = |more| Manifest { more, ..WORKING };
    let cases: Vec<(&str, Manifest, &str)> = vec![
        (
            "no setup",
            Manifest { setup: "", ..WORKING },
            "handeye.toml:1: missing field `setup`; write setup = \"eye-in-hand\" where the robot carries the camera, or setup = \"eye-to-hand\" where it carries the target, above all tables",
        ),
        (
            "unknown setup",
            Manifest { setup: "setup = \"eye-in-hnd\"", ..WORKING },
            "handeye.toml:1: unknown variant `eye-in-hnd`, expected `eye-in-hand` or `eye-to-hand`; did you mean eye-in-hand?",
        ),
        (
            "wrong type",
            Manifest { setup: "setup = 3", ..WORKING },
            "handeye.toml:1: wanted string or table; correct the manifest",
        ),
        (
            "unknown key",
            robot("[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\nlenght_unit = \"m\""),
            "did you mean length_unit?",
        ),
        (
            "unknown key's line",
            robot("[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\nlenght_unit = \"m\""),
            "handeye.toml:10: unknown field `lenght_unit`",
        ),
        (
            "key twice",
            more("[images]\nfiles = \"x\""),
            "handeye.toml:13: duplicate key; correct the manifest",
        ),
        ("no TOML", more("= ="), "handeye.toml:13: "),
        (
            "unit",
            robot(
                "[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\nlength_unit = \"furlong\"\ndirection = \"base_from_flange\"",
            ),
            "handeye.toml:10: unknown variant `furlong`, expected one of `m`, `cm`, `mm`, `inch`; correct the manifest",
        ),
        (
            "one-row board",
            target("[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 1\nsquare_mm = 20.0"),
            "handeye.toml:2 [target]: target: 9 x 1 inner corners; a board needs at least 2 x 2 (one row of corners does not fix its pose)",
        ),
        (
            "board in metres",
            target("[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 0.02"),
            "handeye.toml:2 [target]: target: square_mm = 0.02 mm is no board's size; is it in millimetres?",
        ),
        (
            "marker too large",
            target(
                "[target]\nkind = \"charuco\"\nsquares_x = 5\nsquares_y = 7\nsquare_mm = 20.0\nmarker_mm = 20.0\ndictionary = \"DICT_6X6_250\"",
            ),
            "handeye.toml:2 [target]: target: marker_mm = 20 must be smaller than square_mm = 20",
        ),
        (
            "no target",
            target(""),
            "handeye.toml: target is missing; which board does the camera see? ([target] kind = ...)",
        ),
        (
            "no robot",
            robot(""),
            "handeye.toml: robot is missing; where are the robot's poses? ([robot] poses = ...)",
        ),
        (
            "no notation",
            robot("[robot]\nposes = \"poses.csv\"\ndirection = \"base_from_flange\""),
            "handeye.toml:7: robot.notation is missing; how are the poses written?",
        ),
        (
            "unknown notation",
            robot(
                "[robot]\nposes = \"poses.csv\"\nnotation = \"kukka\"\ndirection = \"base_from_flange\"",
            ),
            "handeye.toml:9 [robot.notation]: the notation \"kukka\" is not known; did you mean kuka?",
        ),
        (
            "no direction",
            robot("[robot]\nposes = \"poses.csv\"\nnotation = \"ur\""),
            "handeye.toml:7: robot.direction is missing; do the poses take points of the flange into the base",
        ),
        (
            "no length unit",
            robot(
                "[robot]\nposes = \"poses.csv\"\nnotation = \"rotation-vector\"\ndirection = \"base_from_flange\"",
            ),
            "handeye.toml:7: robot.length_unit is missing; are the positions in \"m\", \"mm\", \"cm\" or \"inch\"?",
        ),
        (
            "no DH",
            robot(
                "[robot]\nposes = \"poses.csv\"\nnotation = \"joints\"\ndirection = \"base_from_flange\"",
            ),
            "handeye.toml:7: robot.dh is missing; which Denavit-Hartenberg parameters has the robot?",
        ),
        (
            "missing poses",
            robot(
                "[robot]\nposes = \"pose.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"",
            ),
            "pose.csv: does not exist; check the name and the folder",
        ),
        (
            "missing images",
            Manifest { images: "[images]\nfiles = \"image_*.png\"", ..WORKING },
            "handeye.toml:12 [images.files]: no file matches \"image_*.png\" below .; check the name and the folder",
        ),
        (
            "rows beyond the end",
            robot(
                "[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\nrows = \"2..9\"",
            ),
            "poses.csv: has 3 records, but rows = \"2..9\" are asked for; rows count from 1 and include both ends",
        ),
        (
            "fewer rows than images",
            robot(
                "[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\nrows = \"1..2\"",
            ),
            "handeye.toml:13 [images.files]: 2 robot poses but 3 images; select with rows",
        ),
        (
            "no range",
            robot(
                "[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\nrows = \"all\"",
            ),
            "handeye.toml:11 [robot.rows]: rows = \"all\" is no range; write rows = \"1..52\"",
        ),
        (
            "tool without frame",
            robot(
                "[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\ntool = { translation_mm = [0.0, 0.0, 1.0], rotation_xyzw = [0.0, 0.0, 0.0, 1.0] }",
            ),
            "handeye.toml:7: robot.frame is missing; [robot.tool] is given",
        ),
        (
            "excluded name",
            more("[captures]\nexclude = [\"img_4\"]"),
            "handeye.toml:14 [captures.exclude]: there is no capture img_4; did you mean img_1?",
        ),
        (
            "placement twice",
            more("[[placements]]\nid = \"A\"\n[[placements]]\nid = \"A\""),
            "handeye.toml:13 [placements]: two placements are called A; give each a name of its own",
        ),
        (
            "zero noise",
            more("[noise]\nimage_px = 0.0"),
            "handeye.toml:14 [noise.image_px]: 0 is not positive; correct it, or leave it out",
        ),
        (
            "empty box",
            more(
                "[workspace]\nframe = \"base\"\nminimum_mm = [0.0, 0.0, 0.0]\nmaximum_mm = [1.0, 1.0, 0.0]",
            ),
            "handeye.toml:13 [workspace]: minimum_mm is not below maximum_mm; give two opposite corners of the box",
        ),
        (
            "half a camera",
            more("[camera]\nfx = 600.0"),
            "handeye.toml:13 [camera]: fy is missing; which value did the calibration find?",
        ),
        (
            "another image size",
            more(
                "[camera]\nwidth = 1280\nheight = 960\nfx = 600.0\nfy = 600.0\ncx = 640.0\ncy = 480.0",
            ),
            "the intrinsics are for 1280 x 960 pixels, but the images have 640 x 480; if the images were resized, say resized = 0.5000",
        ),
        (
            "touch kind",
            more("[touches]\npoints = [{ corner = 1, values = [1.0, 2.0, 3.0] }]"),
            "handeye.toml:13: touches.kind is missing;",
        ),
        (
            "touch unit",
            more("[touches]\nkind = \"tip\"\npoints = [{ corner = 1, values = [1.0, 2.0, 3.0] }]"),
            "handeye.toml:13: touches.length_unit is missing; are the tip's coordinates in \"m\" or in \"mm\"?",
        ),
        (
            "touched corner",
            more(
                "[touches]\nkind = \"tip\"\nlength_unit = \"mm\"\npoints = [{ corner = 54, values = [1.0, 2.0, 3.0] }]",
            ),
            "handeye.toml:16 [touches.points]: the target has no corner 54; ids count from 0, row by row",
        ),
        (
            "touch without corner",
            more(
                "[touches]\nkind = \"tip\"\nlength_unit = \"mm\"\npoints = [{ values = [1.0, 2.0, 3.0] }]",
            ),
            "does not say which corner was touched; add a column corner, or row and column",
        ),
    ];
    let mut wrong = Vec::new();
    for (name, manifest, expected) in cases {
        let message = open(&manifest, POSES).err().unwrap_or_else(|| panic!("{name} was accepted"));
        if !message.contains(expected) {
            wrong.push(format!("{name}:\n  found    {message}\n  expected {expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn broken_poses_are_refused_by_line() {
    let last = |line: &str| format!("0.1,0.2,0.3,0.1,0.2,0.3\n0.2,0.2,0.3,0.1,0.2,0.3\n{line}\n");
    for (name, poses, expected) in [
        ("empty", String::new(), "poses.csv: the file is empty; record it again"),
        ("comments only", "# nothing\n".into(), "poses.csv: holds no numbers; record it again"),
        (
            "NaN",
            last("0.1,nan,0.3,0.1,0.2,0.3"),
            "poses.csv:3: NaN is not a finite number; remove the record or exclude its capture",
        ),
        (
            "infinity",
            last("0.1,inf,0.3,0.1,0.2,0.3"),
            "poses.csv:3: inf is not a finite number; remove the record or exclude its capture",
        ),
        (
            "a word",
            last("0.1,0.2,0.3,x1y,0.2,0.3"),
            "poses.csv:3: \"x1y\" is not a number; correct the file, or say which columns = [..] hold the numbers",
        ),
        (
            "cut line",
            last("0.1,0.2,0.3"),
            "poses.csv:3: has 3 values, but ur takes 6; in the order x y z rx ry rz; say which with columns = [..]",
        ),
        (
            "decimal comma",
            last("0,1;0,2;0,3;0,1;0,2;0,3"),
            "poses.csv:1: has commas between its values, but numbers of other lines have decimal commas; write all lines alike",
        ),
        ("too few", "0.1,0.2,0.3,0.1,0.2,0.3\n".into(), "1 robot poses but 3 images"),
        (
            "unknown header",
            format!("x,q,r,s,t,u\n{POSES}"),
            "poses.csv:2: ur needs a value named y, but the names are x, q, r, s, t, u; say which columns = [..] are meant, in the notation's order",
        ),
        (
            "header of another width",
            format!("x,y,z,rx,ry,rz,t\n{POSES}"),
            "poses.csv:2: 6 values, but the header names 7; complete the line",
        ),
    ] {
        let message = open(&WORKING, &poses).err().unwrap_or_else(|| panic!("{name} was accepted"));
        assert!(message.contains(expected), "{name}:\n  found    {message}\n  expected {expected}");
    }
    let quaternions = Manifest {
        robot: "[robot]\nposes = \"poses.csv\"\nnotation = \"quaternion-xyzw\"\nlength_unit = \"m\"\ndirection = \"base_from_flange\"",
        ..WORKING
    };
    let message = open(&quaternions, "1,2,3,0,0,0,1\n1,2,3,0,0,0,0\n1,2,3,0,0,0,1\n").unwrap_err();
    assert_eq!(
        message,
        "poses.csv:2: the quaternion's length is 0.000000, not 1; correct the file, the notation or its column order"
    );
}

#[test]
fn broken_pictures_are_refused() {
    let folder = Folder::new();
    let cases: Vec<(&str, Vec<u8>, &str)> = vec![
        ("empty.png", vec![], "empty.png: the file is empty; record it again"),
        (
            "text.png",
            b"hello, this is text".to_vec(),
            "text.png: is not an image; PNG, JPEG, TIFF and BMP can be read",
        ),
        ("cut.png", png(64, 64)[..60].to_vec(), "cut.png: the image cannot be decoded ("),
        ("one.png", png(1, 1), "one.png: the image is only 1 x 1 pixels; is it the right file?"),
        (
            "huge.png",
            png_with_header(10_000, 10_000),
            "huge.png: the number of pixels (10000 x 10000) is 100000000, more than the limit of 64000000; is the file damaged?",
        ),
        ("vast.png", png_with_header(0x7fff_ffff, 0x7fff_ffff), "vast.png: "),
        ("lie.png", png_with_header(4000, 4000), "lie.png: the image cannot be decoded ("),
        ("cut.jpg", vec![0xff, 0xd8, 0xff, 0xe0, 0, 16], "cut.jpg: the image cannot be decoded ("),
        ("cut.bmp", b"BM\x00\x00\x00\x00".to_vec(), "cut.bmp: the image cannot be decoded ("),
        (
            "cut.tiff",
            b"II*\x00\x08\x00\x00\x00\xff\xff".to_vec(),
            "cut.tiff: the image cannot be decoded (",
        ),
    ];
    for (name, content, expected) in cases {
        let path = folder.write(name, content);
        let message = folder.message(&read_image(&path, None).unwrap_err());
        assert!(
            message.starts_with(expected),
            "{name}:\n  found    {message}\n  expected {expected}"
        );
    }
    let message = folder.message(&read_image(&folder.0.join("none.png"), None).unwrap_err());
    assert_eq!(message, "none.png: does not exist; check the name and the folder");
    let message = folder.message(&read_image(&folder.0, None).unwrap_err());
    assert_eq!(message, ".: is not a file; name a file here");
}

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";

#[test]
fn broken_scans_are_refused() {
    let folder = Folder::new();
    let millimetres =
        ScanOptions { length_unit: Some(LengthUnit::Millimetre), ..ScanOptions::default() };
    let gridded = ScanOptions { organised: Some((3, 3)), ..millimetres };
    let depth = ScanOptions {
        depth_scale: Some(0.001),
        intrinsics: Some(Intrinsics::pinhole(64, 64, 60.0, 60.0, 32.0, 32.0)),
        ..ScanOptions::default()
    };
    let pcd = |data: &str, points: &str| {
        format!(
            "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {points}\nHEIGHT 1\nPOINTS {points}\nDATA {data}\n"
        )
    };
    let cases: Vec<(&str, Vec<u8>, ScanOptions, &str)> = vec![
        ("empty.ply", vec![], millimetres, "empty.ply: the file is empty; record it again"),
        (
            "text.ply",
            b"hello".to_vec(),
            millimetres,
            "text.ply: is not a PLY file with a complete header; export it as PLY again",
        ),
        (
            "cut.ply",
            PLY.into(),
            millimetres,
            "cut.ply: is cut short: the header promises 2 points; copy or record it again",
        ),
        (
            "word.ply",
            format!("{PLY}1 2 x\n1 2 3\n").into(),
            millimetres,
            "word.ply: is cut short: the header promises 2 points; copy or record it again",
        ),
        (
            "zeros.ply",
            format!("{PLY}0 0 0\n0 0 0\n").into(),
            millimetres,
            "zeros.ply: the scan holds no point; record it again, or exclude its capture",
        ),
        (
            "unit.ply",
            format!("{PLY}1 2 3\n1 2 3\n").into(),
            ScanOptions::default(),
            "unit.ply: length_unit is missing; are the coordinates of the points in \"m\" or in \"mm\"?",
        ),
        (
            "grid.ply",
            format!("{PLY}1 2 3\n1 2 3\n").into(),
            gridded,
            "grid.ply: holds 2 points, not 3 x 3; correct organised = [width, height], or leave it out",
        ),
        (
            "many.ply",
            PLY.replace("vertex 2", "vertex 4000000000").into(),
            millimetres,
            "many.ply: the number of points is 4000000000, more than the limit of 100000000; is the file damaged?",
        ),
        (
            "flat.ply",
            PLY.replace("property float z\n", "").into(),
            millimetres,
            "flat.ply: its vertices have no x, y and z; export it as PLY again",
        ),
        (
            "cut.pcd",
            pcd("binary", "100").into(),
            millimetres,
            "cut.pcd: is cut short: the header promises 100 points; copy or record it again",
        ),
        (
            "packed.pcd",
            format!("{}\u{1}\u{0}\u{0}\u{0}", pcd("binary_compressed", "100")).into(),
            millimetres,
            "packed.pcd: is cut short: the header promises 100 points; copy or record it again",
        ),
        (
            "kind.pcd",
            pcd("zipped", "1").into(),
            millimetres,
            "kind.pcd: its DATA is \"zipped\"; export it as PCD 0.7 again",
        ),
        (
            "none.pcd",
            pcd("ascii", "0").into(),
            millimetres,
            "none.pcd: the scan holds no point; record it again, or exclude its capture",
        ),
        (
            "eight.png",
            png(64, 64),
            depth,
            "eight.png: is no depth image: it is not grey with 16 bits; save depth as a 16-bit grey PNG",
        ),
        (
            "cut.npy",
            b"\x93NUMPY\x01\x00\x10\x00".to_vec(),
            depth,
            "cut.npy: is not an .npy array; save it again with numpy.save",
        ),
        (
            "cut.npz",
            b"PK\x03\x04".to_vec(),
            depth,
            "cut.npz: is not a complete .npz archive; save it again with numpy.savez",
        ),
        (
            "cut.tiff",
            b"II*\x00\x08\x00\x00\x00\xff\xff".to_vec(),
            depth,
            "cut.tiff: the TIFF cannot be decoded (",
        ),
        ("scan.zdf", b"CDF".to_vec(), millimetres, "scan.zdf: cannot be read as ZDF ("),
        (
            "scan.las",
            b"LASF".to_vec(),
            millimetres,
            "scan.las: scans of kind \".las\" cannot be read; PLY, PCD, E57, ZDF, XYZ, TXT, CSV, ASC, PTS, NPY, NPZ, and depth in PNG and TIFF can; export one of them",
        ),
        (
            "unit.xyz",
            b"1 2 3\n".to_vec(),
            ScanOptions::default(),
            "unit.xyz: length_unit is missing; are the coordinates of the points in \"m\" or in \"mm\"?",
        ),
        (
            "two.xyz",
            b"1 2\n3 4\n".to_vec(),
            millimetres,
            "two.xyz:1: has 2 values, but a point takes x, y and z; is it a list of points?",
        ),
        (
            "less.csv",
            b"x,y,z,i\n1,2,3,4\n\n1,2,3\n".to_vec(),
            millimetres,
            "less.csv:4: has 3 values, but the lines before have 4; complete the line or remove it (comments begin with #)",
        ),
        (
            "named.csv",
            b"x,y,z,i\n1,2,3\n".to_vec(),
            millimetres,
            "named.csv:2: has 3 values, but 4 columns are named; name every column, or none",
        ),
        (
            "names.csv",
            b"id,row,column\n1,2,3\n".to_vec(),
            millimetres,
            "names.csv:1: is neither a point nor a line that names the columns x, y and z; remove it, or begin it with #",
        ),
        (
            "word.txt",
            b"1 2 3\n1 2 three\n".to_vec(),
            millimetres,
            "word.txt:2: \"three\" is not a number; correct the line or remove it",
        ),
        (
            "decimal.xyz",
            b"1,5 2,5 3,5\n".to_vec(),
            millimetres,
            "decimal.xyz:1: has numbers with a decimal comma, apart by blanks or commas; write a decimal point, or put semicolons between the columns",
        ),
        (
            "less.pts",
            b"3\n1 2 3\n4 5 6\n".to_vec(),
            millimetres,
            "less.pts: is cut short: the header promises 3 points; copy or record it again",
        ),
        (
            "more.pts",
            b"1\n1 2 3\n4 5 6\n".to_vec(),
            millimetres,
            "more.pts: promises 1 points, but holds 2; correct the number in its first line, or remove that line",
        ),
        (
            "absurd.pts",
            b"4000000000\n1 2 3\n".to_vec(),
            millimetres,
            "absurd.pts: the number of points is 4000000000, more than the limit of 100000000; is the file damaged?",
        ),
        (
            "many.pts",
            b"99000000\n1 2 3\n".to_vec(),
            millimetres,
            "many.pts: is cut short: the header promises 99000000 points; copy or record it again",
        ),
        (
            "nothing.csv",
            b"x,y,z\n# no point\n".to_vec(),
            millimetres,
            "nothing.csv: the scan holds no point; record it again, or exclude its capture",
        ),
        (
            "binary.xyz",
            vec![0, 159, 146, 150, 0, 1, 2, 3],
            millimetres,
            "binary.xyz:1: is neither a point nor a line that names the columns",
        ),
    ];
    for (name, content, options, expected) in cases {
        let path = folder.write(name, content);
        let message = folder.message(
            &read_scan(&path, &options).err().unwrap_or_else(|| panic!("{name} was accepted")),
        );
        assert!(
            message.starts_with(expected),
            "{name}:\n  found    {message}\n  expected {expected}"
        );
    }
}

#[test]
fn broken_cameras_are_refused() {
    let folder = Folder::new();
    for (name, content, expected) in [
        ("cut.json", "{\"fx\": 1,", "cut.json:1: is not JSON: EOF while parsing"),
        (
            "none.json",
            "{\"x\": 1}",
            "none.json: holds no camera; fx fy cx cy, or a matrix named camera_matrix,",
        ),
        ("deep.json", &"[".repeat(100_000), "deep.json:1: is not JSON: recursion limit exceeded"),
        ("deep.yaml", &"[".repeat(100_000), "deep.yaml"),
        ("bad.xml", "<a><b></a>", "bad.xml:1: is not XML:"),
        (
            "odd.yaml",
            "camera_matrix: {rows: 3, cols: 3, data: [1, 0, 2, 0, 1, 2, 0, 1, 1]}",
            "odd.yaml [camera]: is no camera matrix; it is fx 0 cx, 0 fy cy, 0 0 1",
        ),
        (
            "zero.json",
            "{\"fx\": 0, \"fy\": 1, \"cx\": 1, \"cy\": 1}",
            "zero.json: camera: fx = 0, fy = 1 must be positive focal lengths in pixels",
        ),
        (
            "fov.yaml",
            "{\"fx\": 9, \"fy\": 9, \"cx\": 1, \"cy\": 1, \"distortion_model\": fov, \"D\": [0.9]}",
            "fov.yaml: the distortion model \"fov\" is not known;",
        ),
        (
            "six.json",
            "{\"fx\": 9, \"fy\": 9, \"cx\": 1, \"cy\": 1, \"D\": [1, 2, 3, 4, 5, 6]}",
            "six.json: 6 distortion coefficients; 4, 5, 8 or 12 in OpenCV's order are understood (a tilted sensor is not)",
        ),
    ] {
        let path = folder.write(name, content);
        let message = folder.message(&read_intrinsics(&path, None, Some((640, 480))).unwrap_err());
        assert!(
            message.starts_with(expected),
            "{name}:\n  found    {message}\n  expected {expected}"
        );
    }
}

#[test]
fn a_file_that_may_not_be_read_says_so() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    let path = folder.write("secret.png", png(64, 64));
    fs::set_permissions(&path, fs::Permissions::from_mode(0o000)).unwrap();
    if fs::read(&path).is_ok() {
        println!("skipped: this user may read everything");
        return;
    }
    let message = folder.message(&read_image(&path, None).unwrap_err());
    assert_eq!(message, "secret.png: may not be read; check its permissions");
}

#[test]
fn a_file_cut_anywhere_never_panics() {
    let folder = Folder::new();
    let pieces: Vec<(&str, Vec<u8>)> = vec![
        ("a.png", png(32, 32)),
        ("a.ply", format!("{PLY}1 2 3\n4 5 6\n").into()),
        ("a.pcd", b"VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary_compressed\n\x10\x00\x00\x00\x18\x00\x00\x00\x0f0123456789abcdef".to_vec()),
    ];
    let options = ScanOptions { length_unit: Some(LengthUnit::Metre), ..ScanOptions::default() };
    for (name, whole) in pieces {
        for end in 0..whole.len() {
            let path = folder.write(name, &whole[..end]);
            let _ = (read_image(&path, None), read_scan(&path, &options));
        }
    }
}

/// Numbers that look random and are the same every time.
fn scrambled(seed: u64) -> impl Iterator<Item = usize> {
    let next = |s: &u64| {
        Some(s.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407))
    };
    std::iter::successors(Some(seed), next).skip(1).map(|s| (s >> 33) as usize)
}

#[test]
fn files_with_damaged_bytes_never_panic() {
    let folder = Folder::new();
    let npy =
        b"\x93NUMPY\x01\x00\x3b\x00{'descr': '<f4', 'fortran_order': True, 'shape': (2, 2, 3)}\n"
            .to_vec();
    let pieces: Vec<(&str, Vec<u8>)> = vec![
        ("a.png", png(32, 32)),
        ("a.npy", [npy, vec![7; 48]].concat()),
        ("a.ply", format!("{PLY}1 2 3\n4 5 6\n").into()),
        (
            "l.ply",
            [PLY.replace("ascii", "binary_little_endian").into_bytes(), vec![9; 24]].concat(),
        ),
        (
            "a.json",
            b"{\"fx\": 1, \"fy\": 1, \"cx\": 1, \"cy\": 1, \"D\": [[1, 2, 3, 4, 5]]}".to_vec(),
        ),
        (
            "a.yaml",
            b"K: {rows: 3, data: [1, 0, 2, 0, 1, 2, 0, 0, 1]}\nD: [1, 2, 3, 4, 5]\n".to_vec(),
        ),
        (
            "a.xml",
            b"<r><camera><model><px>1</px><u0>1</u0><kud>0</kud></model></camera></r>".to_vec(),
        ),
        (
            "handeye.toml",
            format!("{}\n{}\n{}\n", WORKING.setup, WORKING.target, WORKING.robot).into(),
        ),
    ];
    let options = ScanOptions { length_unit: Some(LengthUnit::Metre), ..ScanOptions::default() };
    for (name, whole) in pieces {
        let mut random = scrambled(whole.len() as u64);
        for _ in 0..400 {
            let mut bytes = whole.clone();
            for (at, value) in random.by_ref().zip(scrambled(7)).take(3) {
                let end = bytes.len();
                bytes[at % end] = (at >> 8 ^ value) as u8;
            }
            let path = folder.write(name, bytes);
            let _ = (read_image(&path, None), read_scan(&path, &options));
            let _ = (read_intrinsics(&path, None, None), Dataset::open(&path));
        }
    }
}

#[test]
fn init_asks_what_the_files_do_not_prove() {
    let folder = Folder::new();
    fs::create_dir(folder.0.join("images")).unwrap();
    for i in 1..=3 {
        folder.write(&format!("images/img_{i}.png"), png(8, 8));
    }
    folder.write("poses.csv", POSES);
    let handeye_io::FirstManifest { text, questions } =
        handeye_io::first_manifest(&folder.0, &handeye_io::Known::default()).unwrap();
    assert!(text.contains("files = \"images/img_*.png\"  # 3 files"), "{text}");
    assert!(text.contains("poses = \"poses.csv\""), "{text}");
    assert!(text.contains("# direction = \"base_from_flange\"\n"), "{text}");
    for question in questions {
        let line = text.lines().nth(question.line - 1).unwrap();
        let start = line.strip_prefix("# QUESTION: ").unwrap();
        assert!(question.text.starts_with(start), "{line}");
    }
    folder.write("handeye.toml", text);
    let message = folder.message(&Dataset::open(Path::new(&folder.0)).unwrap_err());
    assert!(message.starts_with("handeye.toml:"), "{message}");
}
