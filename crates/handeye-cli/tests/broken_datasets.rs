//! Broken datasets end with exit code 1 (3 where they can be read but tell nothing), a message that
//! says where, what, and what to do, and no half-written result.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

mod folder;

use folder::{Folder, handeye};

/// A dataset that can be read; its images show nothing.
const MANIFEST: &str = "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n";
const POSES: &str = "0.1,0.2,0.3,0.1,0.2,0.3\n0.2,0.2,0.3,0.1,0.2,0.3\n0.3,0.2,0.3,0.1,0.2,0.4\n";

/// A file's name and its content: text, `@missing`, `@folder`, or `@png 640x480`.
type File = (&'static str, &'static str);
/// What is broken, the files that differ, exit code, and the message: all that stands behind
/// `error: `, or the first reason of the verdict.
type Case = (&'static str, &'static [File], i32, &'static str);

#[rustfmt::skip]
const CASES: &[Case] = &[
    ("no setup", &[("handeye.toml", "\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml:1: missing field `setup`; write setup = \"eye-in-hand\" where the robot carries the camera, or setup = \"eye-to-hand\" where it carries the target, above all tables"),
    ("unknown setup", &[("handeye.toml", "setup = \"eye-on-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml:1: unknown variant `eye-on-hand`, expected `eye-in-hand` or `eye-to-hand`; did you mean eye-in-hand?"),
    ("unknown key", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\nlenght_unit = \"m\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml:11: unknown field `lenght_unit`, expected one of `poses`, `field`, `notation`, `length_unit`, `angle_unit`, `rows`, `columns`, `skip_header`, `direction`, `frame`, `tool`, `dh`, `urdf`; did you mean length_unit?"),
    ("key twice", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n[images]\nfiles = \"x\"\n")], 1, "handeye.toml:20: duplicate key; correct the manifest"),
    ("no TOML", &[("handeye.toml", "= =\n")], 1, "handeye.toml:1: extra `=`, expected nothing; correct the manifest"),
    ("empty manifest", &[("handeye.toml", "")], 1, "handeye.toml: the file is empty; record it again"),
    ("no manifest", &[("handeye.toml", "@missing")], 1, "handeye.toml: does not exist; check the name and the folder"),
    ("manifest is a folder", &[("handeye.toml", "@folder")], 1, "handeye.toml: is not a file; name a file here"),
    ("one-row board", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 1\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml:2 [target]: target: 9 x 1 inner corners; a board needs at least 2 x 2 (one row of corners does not fix its pose)"),
    ("board in metres", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 0.02\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml:2 [target]: target: square_mm = 0.02 mm is no board's size; is it in millimetres?"),
    ("square of negative size", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = -20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml:2 [target]: target: square_mm = -20 must be a positive length in mm"),
    ("square of no number", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = nan\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml:2 [target]: target: square_mm = NaN must be a positive length in mm"),
    ("immense board", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 4000000000\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml:2 [target]: target: 4000000000 x 6 corners are more than 100000"),
    ("no target", &[("handeye.toml", "setup = \"eye-in-hand\"\n\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml: target is missing; which board does the camera see? ([target] kind = ...)"),
    ("unknown target", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"dots\"\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml:3: unknown variant `dots`, expected one of `checkerboard`, `charuco`, `tag`, `circle-grid`, `asymmetric-circle-grid`, `modified-circle-grid`, `aprilgrid`, `tag-grid`, `sphere`; correct the manifest"),
    ("no robot", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml: robot is missing; where are the robot's poses? ([robot] poses = ...)"),
    ("no notation", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml:7: robot.notation is missing; how are the poses written? (ur, kuka, abb, matrix4x4, quaternion-xyzw, joints, ...)"),
    ("unknown notation", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"kukka\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, r#"handeye.toml:9 [robot.notation]: the notation "kukka" is not known; did you mean kuka? there are matrix4x4, quaternion-xyzw, quaternion-wxyz, rotation-vector, ur, ur-rpy, kuka, fanuc, abb, yaskawa, kawasaki, staubli, doosan, denso, joints, and euler-<axes>-intrinsic or euler-<axes>-extrinsic"#),
    ("no direction", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, r#"handeye.toml:7: robot.direction is missing; do the poses take points of the flange into the base ("base_from_flange": where the flange is, what controllers show), or the other way ("flange_from_base")?"#),
    ("no length unit", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"rotation-vector\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, r#"handeye.toml:7: robot.length_unit is missing; are the positions in "m", "mm", "cm" or "inch"?"#),
    ("no poses", &[("poses.csv", "@missing")], 1, "poses.csv: does not exist; check the name and the folder"),
    ("empty poses", &[("poses.csv", "")], 1, "poses.csv: the file is empty; record it again"),
    ("poses are a folder", &[("poses.csv", "@folder")], 1, "poses.csv: is not a file; name a file here"),
    ("poses without numbers", &[("poses.csv", "# nothing\n")], 1, "poses.csv: holds no numbers; record it again"),
    ("NaN", &[("poses.csv", "0.1,0.2,0.3,0.1,0.2,0.3\n0.2,0.2,0.3,0.1,0.2,0.3\n0.1,nan,0.3,0.1,0.2,0.3\n")], 1, "poses.csv:3: NaN is not a finite number; remove the record or exclude its capture"),
    ("infinity", &[("poses.csv", "0.1,0.2,0.3,0.1,0.2,0.3\n0.2,0.2,0.3,0.1,0.2,0.3\n0.1,inf,0.3,0.1,0.2,0.3\n")], 1, "poses.csv:3: inf is not a finite number; remove the record or exclude its capture"),
    ("a word", &[("poses.csv", "0.1,0.2,0.3,0.1,0.2,0.3\n0.2,0.2,0.3,0.1,0.2,0.3\n0.1,0.2,up,0.1,0.2,0.3\n")], 1, r#"poses.csv:3: "up" is not a number; correct the file, or say which columns = [..] hold the numbers"#),
    ("cut line", &[("poses.csv", "0.1,0.2,0.3,0.1,0.2,0.3\n0.2,0.2,0.3,0.1,0.2,0.3\n0.1,0.2,0.3\n")], 1, "poses.csv:3: has 3 values, but ur takes 6; in the order x y z rx ry rz; say which with columns = [..]"),
    ("decimal comma", &[("poses.csv", "0.1,0.2,0.3,0.1,0.2,0.3\n0.2,0.2,0.3,0.1,0.2,0.3\n0,1;0,2;0,3;0,1;0,2;0,3\n")], 1, "poses.csv:3: numbers with a decimal comma; write them with a decimal point"),
    ("fewer poses than images", &[("poses.csv", "0.1,0.2,0.3,0.1,0.2,0.3\n")], 1, r#"handeye.toml:12 [images.files]: 1 robot poses but 3 images; select with rows = "first..last", complete the data, or pair by number with [captures] pairing = "number""#),
    ("more poses than images", &[("poses.csv", "0.1,0.2,0.3,0.1,0.2,0.3\n0.2,0.2,0.3,0.1,0.2,0.3\n0.3,0.2,0.3,0.1,0.2,0.4\n0.1,0.2,0.3,0.1,0.2,0.3\n0.2,0.2,0.3,0.1,0.2,0.3\n0.3,0.2,0.3,0.1,0.2,0.4\n")], 1, r#"handeye.toml:12 [images.files]: 6 robot poses but 3 images; select with rows = "first..last", complete the data, or pair by number with [captures] pairing = "number""#),
    ("zero quaternion", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"quaternion-xyzw\"\nlength_unit = \"m\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n"), ("poses.csv", "1,2,3,0,0,0,1\n1,2,3,0,0,0,0\n1,2,3,0,0,0,1\n")], 1, "poses.csv:2: the quaternion's length is 0.000000, not 1; correct the file, the notation or its column order"),
    ("quaternion not of length one", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"quaternion-xyzw\"\nlength_unit = \"m\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n"), ("poses.csv", "1,2,3,0,0,0,1\n1,2,3,0,0,0,2\n1,2,3,0,0,0,1\n")], 1, "poses.csv:2: the quaternion's length is 2.000000, not 1; correct the file, the notation or its column order"),
    ("swapped quaternion", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"quaternion-xyzw\"\nlength_unit = \"m\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n"), ("poses.csv", "0,0,0,1,1,2,3\n0,0,0,1,1,2,3\n0,0,0,1,1,2,3\n")], 1, "poses.csv:1: the rotation stands before the position: the first four numbers are a unit quaternion, the last four are none; say which columns hold position and quaternion, in this order: columns = [5, 6, 7, 1, 2, 3, 4], counted on by one where the first column is a name"),
    ("NaN quaternion", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"quaternion-xyzw\"\nlength_unit = \"m\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n"), ("poses.csv", "1,2,3,nan,0,0,1\n1,2,3,0,0,0,1\n1,2,3,0,0,0,1\n")], 1, "poses.csv:1: NaN is not a finite number; remove the record or exclude its capture"),
    ("millimetres for metres", &[("poses.csv", "100,200,300,0.1,0.2,0.3\n200,200,300,0.1,0.2,0.3\n300,200,300,0.1,0.2,0.4\n")], 3, "the robot poses lie up to 469 m from the base: were millimetres read as metres? check the length unit"),
    ("degrees for radians", &[("poses.csv", "0.1,0.2,0.3,10,20,30\n0.2,0.2,0.3,10,20,30\n0.3,0.2,0.3,10,120,40\n")], 3, "0 usable captures, at least 3 are needed: take 10 to 15, the robot tilted by 30 degrees and more about two axes"),
    ("rows beyond the end", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\nrows = \"2..9\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, r#"poses.csv: has 3 records, but rows = "2..9" are asked for; rows count from 1 and include both ends"#),
    ("no images", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"pic_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, r#"handeye.toml:12 [images.files]: no file matches "pic_*.png" below .; check the name and the folder"#),
    ("image of one pixel", &[("img_2.png", "@png 1x1")], 1, "img_2.png: the image is only 1 x 1 pixels; is it the right file?"),
    ("no image", &[("img_2.png", "this is text")], 1, "img_2.png: is not an image; PNG, JPEG, TIFF and BMP can be read"),
    ("empty image", &[("img_2.png", "")], 1, "img_2.png: the file is empty; record it again"),
    ("image of another size", &[("img_2.png", "@png 320x240")], 1, "img_2.png: the image is 320 x 240 pixels, the camera was calibrated at 640 x 480; give `resized` in [camera], or intrinsics for this size"),
    ("excluded twice over", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n[captures]\nexclude = [\"img_9\"]\n")], 1, "handeye.toml:21 [captures.exclude]: there is no capture img_9; did you mean img_1?"),
    ("half a camera", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nfx = 600.0\n")], 1, "handeye.toml:13 [camera]: fy is missing; which value did the calibration find?"),
    ("negative focal length", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = -600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n")], 1, "handeye.toml:13 [camera]: camera: fx = -600, fy = 600 must be positive focal lengths in pixels"),
    ("camera file without camera", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nfile = \"cam.json\"\n"), ("cam.json", r#"{"a": 1}"#)], 1, "cam.json: holds no camera; fx fy cx cy, or a matrix named camera_matrix, cameraMatrix, camera_matrix_, Camera_Matrix, K, k, are looked for"),
    ("camera file missing", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nfile = \"cam.json\"\n")], 1, "cam.json: does not exist; check the name and the folder"),
    ("no scans", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n[scans]\nfiles = \"s_*.ply\"\nlength_unit = \"mm\"\n")], 1, r#"handeye.toml:21 [scans.files]: no file matches "s_*.ply" below .; check the name and the folder"#),
    ("cloud without points", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n[scans]\nfiles = \"s_*.ply\"\nlength_unit = \"mm\"\n"), ("s_1.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n"), ("s_2.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n"), ("s_3.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n")], 3, "0 usable captures, at least 3 are needed: take 10 to 15, the robot tilted by 30 degrees and more about two axes"),
    ("wrong number of scans", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n[scans]\nfiles = \"s_*.ply\"\nlength_unit = \"mm\"\n"), ("s_1.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n")], 1, r#"handeye.toml:21 [scans.files]: 3 robot poses but 1 scans; select with rows = "first..last", complete the data, or pair by number with [captures] pairing = "number""#),
    ("placement twice", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n[[placements]]\nid = \"A\"\n[[placements]]\nid = \"A\"\n")], 1, "handeye.toml:20 [placements]: two placements are called A; give each a name of its own"),
    ("corner that is not there", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n[touches]\nkind = \"tip\"\nlength_unit = \"mm\"\npoints = [{ corner = 54, values = [1.0, 2.0, 3.0] }]\n")], 1, "handeye.toml:23 [touches.points]: the target has no corner 54; ids count from 0, row by row: these look counted from 1, so take one off each"),
    ("touch without unit", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n[touches]\nkind = \"tip\"\npoints = [{ corner = 1, values = [1.0, 2.0, 3.0] }]\n")], 1, r#"handeye.toml:20: touches.length_unit is missing; are the tip's coordinates in "m" or in "mm"?"#),
    ("workspace in the wrong frame", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n[workspace]\nframe = \"base\"\nminimum_mm = [0.0, 0.0, 0.0]\nmaximum_mm = [1.0, 1.0, 1.0]\n")], 1, "handeye.toml: [workspace] of an eye-in-hand camera must be given in the camera frame: where in its view will parts lie when they are picked?"),
    ("no noise", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[images]\nfiles = \"img_*.png\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n[noise]\nimage_px = 0.0\n")], 1, "handeye.toml:21 [noise.image_px]: 0 is not positive; correct it, or leave it out"),
    ("cloud without points under a board that was found", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[corners]\nfiles = \"c_*.csv\"\npixel_origin = \"centre\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n[scans]\nfiles = \"s_*.ply\"\nlength_unit = \"mm\"\n"), ("c_1.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n"), ("c_2.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n"), ("c_3.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n"), ("s_1.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n"), ("s_2.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n"), ("s_3.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n")], 1, "s_1.ply: the scan holds no point; record it again, or exclude its capture"),
    ("cut cloud under a board that was found", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[corners]\nfiles = \"c_*.csv\"\npixel_origin = \"centre\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n[scans]\nfiles = \"s_*.ply\"\nlength_unit = \"mm\"\n"), ("c_1.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n"), ("c_2.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n"), ("c_3.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n"), ("s_1.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n"), ("s_2.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n"), ("s_3.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n")], 1, "s_1.ply: is cut short: the header promises 1 points; copy or record it again"),
    ("corner twice", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[corners]\nfiles = \"c_*.csv\"\npixel_origin = \"centre\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n"), ("c_1.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n"), ("c_2.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n8,1,1\n"), ("c_3.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n")], 1, "c_2.csv:6: corner 8 appears twice; remove one of the lines"),
    ("corner of no number", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[corners]\nfiles = \"c_*.csv\"\npixel_origin = \"centre\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n"), ("c_1.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n"), ("c_2.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n9,nan,1\n"), ("c_3.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n")], 1, "c_2.csv:6: NaN is not a finite number; remove the record or exclude its capture"),
    ("corner beyond the board", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[corners]\nfiles = \"c_*.csv\"\npixel_origin = \"centre\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n"), ("c_1.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n"), ("c_2.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n54,1,1\n"), ("c_3.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n")], 1, "c_2.csv:6: the target has no corner 54; ids count from 0, row by row; as declared the target has 9 x 6 corners, 0 to 53: correct [target] or the list"),
    ("corners of unknown origin", &[("handeye.toml", "setup = \"eye-in-hand\"\n[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n[robot]\nposes = \"poses.csv\"\nnotation = \"ur\"\ndirection = \"base_from_flange\"\n[corners]\nfiles = \"c_*.csv\"\n[camera]\nwidth = 640\nheight = 480\nfx = 600.0\nfy = 600.0\ncx = 320.0\ncy = 240.0\n"), ("c_1.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n"), ("c_2.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n"), ("c_3.csv", "id,x,y\n0,100,100\n8,400,110\n45,90,300\n53,410,310\n")], 1, r#"handeye.toml:11: corners.pixel_origin is missing; is (0, 0) the "centre" of the first pixel (OpenCV's convention) or its "corner"?"#),
    ("images without a board", &[], 3, "0 usable captures, at least 3 are needed: take 10 to 15, the robot tilted by 30 degrees and more about two axes"),
];

const PICTURE: &str = "@png 640x480";

fn dataset(folder: &Folder, changed: &[File]) {
    let standard = [
        ("handeye.toml", MANIFEST),
        ("poses.csv", POSES),
        ("img_1.png", PICTURE),
        ("img_2.png", PICTURE),
        ("img_3.png", PICTURE),
    ];
    for (name, content) in standard.iter().filter(|s| changed.iter().all(|c| c.0 != s.0)) {
        folder.put(&format!("cell/{name}"), content);
    }
    for (name, content) in changed {
        folder.put(&format!("cell/{name}"), content);
    }
}

/// What went otherwise than expected.
fn wrong(&(name, changed, code, message): &Case) -> Option<String> {
    let folder = Folder::new();
    dataset(&folder, changed);
    let run = handeye(&folder, &["calibrate", "cell", "--out", "out", "--json"]);
    let files = folder.list("out");
    let (found, expected_files): (String, &[&str]) = match code {
        3 => (
            run.json()["reasons"][0].as_str().unwrap().into(),
            &["calibration.json", "report.html"],
        ),
        _ => (run.error(), &[]),
    };
    let found = found.replace("cell/", "").replace("cell", ".");
    let fine = run.code == code && found == message && files == expected_files;
    (!fine).then(|| {
        format!(
            "{name}: exit {}, files {files:?}\n  found    {found}\n  expected {message}",
            run.code
        )
    })
}

#[test]
fn broken_datasets_are_refused_and_leave_nothing_behind() {
    assert!(CASES.len() >= 40);
    let wrong: Vec<String> = CASES.iter().filter_map(wrong).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn an_output_folder_that_cannot_be_made_is_named() {
    let folder = Folder::new();
    dataset(&folder, &[]);
    folder.put("file", "in the way");
    let run = handeye(&folder, &["calibrate", "cell", "--out", "file/out", "--quiet"]);
    assert_eq!(run.code, 1);
    assert!(run.error().starts_with("file/out: cannot be made: "), "{}", run.stderr);
}

#[test]
fn a_file_that_cannot_be_written_leaves_nothing_half_done() {
    let folder = Folder::new();
    dataset(&folder, &[]);
    folder.put("out/calibration.json", "@folder");
    let run = handeye(&folder, &["calibrate", "cell", "--out", "out", "--quiet"]);
    assert_eq!(run.code, 1);
    assert!(run.error().starts_with("out/calibration.json: cannot be written: "), "{}", run.stderr);
    assert_eq!(folder.list("out"), ["calibration.json"]);
}
