//! Writes good inputs for each fuzz target into `corpus/`, to begin with.

use std::{fs, io::Cursor, path::Path};

use e57::{E57Writer, Record, RecordDataType, RecordName, RecordValue};
use handeye::{
    GrayImage, Intrinsics, Pose, TargetModel,
    simulate::{DepthSensor, Optics, Scene},
};
use image::{GrayImage as Pixels, ImageBuffer, ImageFormat, Luma};
use nalgebra::{Matrix3, Vector3};

const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/corpus");
const SIZE: (u32, u32) = (120, 96);

fn main() {
    for (k, target) in handeye_fuzz::boards().iter().enumerate() {
        let picture = picture(target);
        let mut bytes = vec![k as u8, SIZE.0 as u8];
        bytes.extend(picture.to_u8());
        put("detect", &format!("target{k}"), &bytes);
    }
    let target = &handeye_fuzz::boards()[0];
    let pixels = Pixels::from_raw(SIZE.0, SIZE.1, picture(target).to_u8()).expect("all pixels");
    let kinds = [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Tiff, ImageFormat::Bmp];
    for (k, format) in kinds.into_iter().enumerate() {
        let mut bytes = Cursor::new(vec![]);
        pixels.write_to(&mut bytes, format).expect("into memory");
        put("image", &format!("kind{k}"), &[&[k as u8][..], bytes.get_ref()].concat());
    }
    scans(target);
    texts();
    imports();
    bags();
}

fn scene(target: &TargetModel) -> Scene {
    let middle = target.reference().vector();
    let away = Pose::from_parts(&Matrix3::identity(), Vector3::new(-middle.x, -middle.y, 0.12));
    let (width, height) = SIZE;
    let intrinsics = Intrinsics::pinhole(width, height, 160.0, 160.0, 59.5, 47.5);
    Scene { target: target.clone(), camera_from_target: away, intrinsics }
}

fn picture(target: &TargetModel) -> GrayImage {
    scene(target).picture(&Optics::default(), 1)
}

fn scans(target: &TargetModel) {
    let scan = scene(target).scan(&DepthSensor::default(), 1);
    let millimetres: Vec<u8> =
        scan.points().iter().map(|p| (p[2] * 1e3).min(252.0) as u8).collect();
    put("lift", "board", &[&[SIZE.0 as u8, 0][..], &millimetres].concat());
    let deep: Vec<u16> = scan.points().iter().map(|p| (p[2] * 1e3) as u16).collect();
    let deep = ImageBuffer::<Luma<u16>, _>::from_raw(SIZE.0, SIZE.1, deep).expect("all pixels");
    for (k, format) in [(4, ImageFormat::Png), (5, ImageFormat::Tiff)] {
        let mut bytes = Cursor::new(vec![]);
        deep.write_to(&mut bytes, format).expect("into memory");
        put("scan", &format!("kind{k}"), &[&[k][..], bytes.get_ref()].concat());
    }
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n4 5 6\n7 8 9\n";
    let pcd = "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA ascii\n1 2 3\n4 5 6\n7 8 9\n";
    let mut binary = ply.replace("ascii", "binary_little_endian").into_bytes();
    binary.truncate(binary.len() - "1 2 3\n4 5 6\n7 8 9\n".len());
    binary.extend([0x3f; 36]);
    let mut pcd_binary =
        pcd.replace("DATA ascii\n1 2 3\n4 5 6\n7 8 9\n", "DATA binary\n").into_bytes();
    pcd_binary.extend([0x3f; 36]);
    for (k, name, bytes) in [
        (0, "ply", ply.as_bytes()),
        (0, "ply_binary", &binary),
        (1, "pcd", pcd.as_bytes()),
        (1, "pcd_binary", &pcd_binary),
    ] {
        put("scan", name, &[&[k][..], bytes].concat());
    }
    put("scan", "npy", &[&[2][..], &npy("'<f4'", "2, 2, 3", &[0x3f; 48])].concat());
    lists();
    meshes();
    put("scan", "e57", &[&[11][..], &e57()].concat());
    // from 128 on with checksums made right
    put("scan", "e57_checked", &[&[11 + 9 * 15][..], &e57()].concat());
    put("scan", "zdf", &[&[12][..], include_bytes!("../../points.zdf")].concat());
}

/// Points in text.
fn lists() {
    for (k, name, text) in [
        (6, "xyz", "# x y z\n1 2 3\n4 5 6\nnan nan nan\n7 8 9\n"),
        (7, "csv", "id,x_mm,y_mm,z_mm\n1,2,3,4\n2,,,\n3,5,6,7\n"),
        (8, "asc", "//X Y Z R G B\n2\n1 2 3 4 5 6\n7 8 9 1 2 3\n"),
        (9, "txt", "x;y;z\n1,5;2,5;3\n\"4\";5;6\n"),
        (10, "pts", "2\n1 2 3 -5 1 2 3\n4 5 6 -5 1 2 3\n1\n7 8 9 -5 1 2 3\n"),
    ] {
        put("scan", name, &[&[k][..], text.as_bytes()].concat());
    }
}

fn meshes() {
    let corners = [[0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]];
    let mut stl = vec![b' '; 80];
    stl.extend(2u32.to_le_bytes());
    for _ in 0..2 {
        stl.extend([0; 12]);
        stl.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        stl.extend([0; 2]);
    }
    put("scan", "stl", &[&[13][..], &stl].concat());
    let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0.5\nendloop\nendfacet\n";
    let text = format!("solid a\n{facet}{facet}endsolid a\n");
    put("scan", "stl_text", &[&[13][..], text.as_bytes()].concat());
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 1/1 2/1/1 3//1 -1\n";
    put("scan", "obj", &[&[14][..], obj.as_bytes()].concat());
    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    let text = header("ascii") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    put("scan", "ply_faces", &[&[0][..], text.as_bytes()].concat());
    let mut binary = header("binary_little_endian").into_bytes();
    binary.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    binary.push(3);
    binary.extend([0u32, 1, 2].iter().flat_map(|v| v.to_le_bytes()));
    put("scan", "ply_faces_binary", &[&[0][..], &binary].concat());
}

/// Two scans, one with rows and columns and a number that takes no bits.
fn e57() -> Vec<u8> {
    let mut bytes = Cursor::new(vec![]);
    let mut writer = E57Writer::new(&mut bytes, "{whole}").expect("into memory");
    let whole = |name, max| Record { name, data_type: RecordDataType::Integer { min: 0, max } };
    let mut records =
        vec![Record::CARTESIAN_X_F32, Record::CARTESIAN_Y_F32, Record::CARTESIAN_Z_F64];
    for more in [0, 4] {
        if more > 0 {
            records.extend([
                whole(RecordName::RowIndex, 1),
                whole(RecordName::ColumnIndex, 2),
                whole(RecordName::Intensity, 0),
                Record::CARTESIAN_INVALID_STATE,
            ]);
        }
        let mut points = writer.add_pointcloud("{scan}", records.clone()).expect("records");
        for k in 0..6i64 {
            let mut values = vec![
                RecordValue::Single(k as f32),
                RecordValue::Single(1.5),
                RecordValue::Double(2.5),
            ];
            values
                .extend([k / 3, k % 3, 0, k / 5].map(RecordValue::Integer).into_iter().take(more));
            points.add_point(values).expect("a point");
        }
        points.finalize().expect("into memory");
    }
    writer.finalize().expect("into memory");
    drop(writer);
    bytes.into_inner()
}

/// A file of numpy.
fn npy(kind: &str, shape: &str, values: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': {kind}, 'fortran_order': False, 'shape': ({shape}), }}");
    let mut bytes = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
    bytes.extend(format!("{header:<117}\n").into_bytes());
    bytes.extend(values);
    bytes
}

fn texts() {
    let camera = r#"{"width": 640, "height": 480, "fx": 600, "fy": 601, "cx": 320, "cy": 240, "distortion_model": "brown-conrady", "distortion": [0.1, 0, 0, 0, 0]}"#;
    put("camera", "json", &[&[1][..], camera.as_bytes()].concat());
    let yaml = "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [600., 0., 320., 0., 600., 240., 0., 0., 1.]\ndistortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: [0.1, 0., 0., 0., 0.]\n";
    put("camera", "yaml", &[&[0][..], yaml.as_bytes()].concat());
    let ros = "image_width: 640\nimage_height: 480\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [600, 0, 320, 0, 600, 240, 0, 0, 1]\ndistortion_model: plumb_bob\n";
    put("camera", "ros", &[&[0][..], ros.as_bytes()].concat());
    let xml = "<?xml version=\"1.0\"?><opencv_storage><K type_id=\"opencv-matrix\"><rows>3</rows><cols>3</cols><dt>d</dt><data>600. 0. 320. 0. 600. 240. 0. 0. 1.</data></K><image_width>640</image_width><image_height>480</image_height></opencv_storage>";
    put("camera", "xml", &[&[2][..], xml.as_bytes()].concat());
    let csv = "id,x,y,z,a,b,c\n01,100,200,300,10,20,30\n02,150,210,280,-10,15,40\n";
    for notation in 0..8 {
        put("poses", &format!("csv{notation}"), &[&[notation, 0][..], csv.as_bytes()].concat());
    }
    let json = r#"[{"id": "01", "x": 1, "y": 2, "z": 3, "a": 1, "b": 2, "c": 3}]"#;
    put("poses", "json", &[&[1, 2][..], json.as_bytes()].concat());
    let yaml = "01:\n  x: 1\n  y: 2\n  z: 3\n  qx: 0\n  qy: 0\n  qz: 0\n  qw: 1\n";
    put("poses", "yaml", &[&[5, 3][..], yaml.as_bytes()].concat());
    let identity: Vec<u8> =
        (0..16).flat_map(|k| f64::from(u8::from(k % 5 == 0)).to_le_bytes()).collect();
    put("poses", "npy", &[&[4, 5][..], &npy("'<f8'", "1, 4, 4", &identity)].concat());
    // programs of robots, in files of any text
    for (notation, name, text) in [
        (
            1,
            "krl",
            "DEFDAT P\nDECL E6POS XP1={X 514.8,Y -20.1,Z 700,A 90,B 0.5,C 180,S 2,T 10}\nENDDAT\n",
        ),
        (
            2,
            "tp",
            "/POS\nP[1:\"a\"]{\n GP1:\n UF : 0,\tX = 514.8 mm,\tY = -20.1 mm,\tZ = 700 mm,\n W = 0 deg,\tP = 0.5 deg,\tR = 90 deg\n};\n/END\n",
        ),
        (
            3,
            "rapid",
            "CONST robtarget p10:=[[514.8,-20.1,700],[0,0.7071068,0.7071068,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n",
        ),
        (7, "inform", "//POS\n///POSTYPE BASE\nC00001=514.8,-20.1,700,180,0.5,90\n"),
    ] {
        put("poses", name, &[&[notation, 1][..], text.as_bytes()].concat());
    }
    put("touches", "csv", &[&[0][..], b"corner,x,y,z\n0,1,2,3\n5,4,5,6\n"].concat());
    let target = "[target]\nkind = \"checkerboard\"\ncolumns = 4\nrows = 3\nsquare_mm = 10.0\n";
    put("touches", "target", &[&[3][..], target.as_bytes()].concat());
    let manifest = format!(
        "setup = \"eye-to-hand\"\n\n{target}\n[camera]\nfile = \"camera.json\"\n\n[robot]\nposes = \"poses.csv\"\nnotation = \"kuka\"\ndirection = \"base_from_flange\"\n\n[images]\nfiles = \"*.png\"\n"
    );
    put("manifest", "plain", manifest.as_bytes());
}

/// What other programs write; the first byte chooses the ending.
fn imports() {
    let line = |k: f64| format!("{k}, 0.1, {}, 0.3, 0, 0, 0.6, 0.8\n", 0.2 * k);
    let csv: String = (0..12).map(|k| line(f64::from(k) * 0.1)).collect();
    let easy = "parameters: {calibration_type: eye_on_base}\ntransform:\n  translation: {x: 1, y: 2, z: 3}\n  rotation: {x: 0, y: 0, z: 0, w: 1}\n";
    let zivid =
        "FloatMatrix:\n  Data: [[1, 0, 0, 100], [0, 1, 0, 200], [0, 0, 1, 300], [0, 0, 0, 1]]\n";
    let launch =
        "<launch><node type=\"static_transform_publisher\" args=\"1 2 3 0 0 0 1 a b\"/></launch>";
    let python = "Node(executable='static_transform_publisher', arguments=['--x', '1', '--qw', '1', '--frame-id', 'a', '--child-frame-id', 'b'])";
    let rust = "topology = \"single_cam_handeye\"\n_unresolved = [\"target\"]\n[[cameras]]\nid = \"a\"\nimages = { kind = \"glob\", pattern = \"*.png\" }\n[target]\nkind = \"chessboard\"\nrows = 6\ncols = 9\nsquare_size_m = 0.03\n[robot_poses]\npath = \"p.csv\"\nformat = \"csv\"\ncolumns = { tx = \"x\", ty = \"y\", tz = \"z\", rotation = [\"a\"] }\n[pose_convention]\ntransform = \"t_base_tcp\"\nrotation_format = \"quat_xyzw\"\ntranslation_units = \"mm\"\n";
    let pose = r#"{"to": "base", "from": "camera", "translation_m": [1, 2, 3], "rotation_xyzw": [0, 0, 0, 1]}"#;
    for (k, name, text) in [
        (1, "csv", csv.as_str()),
        (2, "tum", &csv.replace(',', " ")),
        (2, "mech_mind", "ExtrinsicParameters:\n1,2,3,1,0,0,0\n"),
        (3, "pose", pose),
        (4, "easy", easy),
        (4, "zivid", zivid),
        (7, "launch", launch),
        (9, "python", python),
        (10, "halcon", "f 0\nr 0 0 90\nt 1 0 0\n"),
        (11, "calibration_rs", rust),
    ] {
        put("import", name, &[&[k][..], text.as_bytes()].concat());
    }
    put("import", "parquet", &[&[0][..], include_bytes!("../../sequence.parquet")].concat());
}

fn put(target: &str, name: &str, bytes: &[u8]) {
    let folder = Path::new(CORPUS).join(target);
    fs::create_dir_all(&folder).expect("a folder can be made");
    fs::write(folder.join(name), bytes).expect("a file can be written");
}

/// Of six images and two places, as other programs write them.
fn bags() {
    for (k, bytes) in [
        (0, &include_bytes!("../../bags/small.mcap")[..]),
        (1, include_bytes!("../../bags/small.db3")),
        (2, include_bytes!("../../bags/small.bag")),
        (3, include_bytes!("../../bags/small.urdf")),
    ] {
        put("bag", &format!("kind{k}"), &[&[k][..], bytes].concat());
    }
}
