//! Pairs of scans of a simulated cell, and their files.

use std::{
    f64::consts::PI,
    fs::{self, File},
    io::{BufReader, Read},
    path::Path,
};

use handeye::{Intrinsics, Scan, math::random::Random, simulate::Room};
use nalgebra::{Isometry3, Matrix4, Vector3};
use serde_json::{Value, json};

/// Normal error of a range, m.
pub const NOISE_M: f64 = 5e-4;
/// From the camera to the middle of the scene, m.
pub const DISTANCE_M: f64 = 0.8;
/// How far off the start of the rendered scenes is.
const START_TURN_DEG: f64 = 1.0;
const START_SHIFT_M: f64 = 5e-3;
/// Bytes of a point in a file.
const POINT_BYTES: usize = 12;

/// Two scans of a room.
pub struct Pair {
    pub source: Scan,
    pub target: Scan,
    pub target_from_source: Isometry3<f64>,
}

/// In which order the points of a scan are given.
#[derive(Clone, Copy)]
pub enum Order {
    /// Row by row, one for each pixel.
    Organised,
    /// Row by row, those that were seen.
    Rows,
    /// Those that were seen, in any order.
    Shuffled,
}

/// A camera that looks down at the table from beside its middle, turned by a rotation vector.
pub fn camera_above(x: f64, y: f64, turn: [f64; 3]) -> Isometry3<f64> {
    let above = Isometry3::new([x, y, DISTANCE_M].into(), [PI, 0.0, 0.0].into());
    above * Isometry3::new(Vector3::zeros(), turn.into())
}

/// What both cameras see.
pub fn scans(
    room: &Room,
    (width, height): (u32, u32),
    source: &Isometry3<f64>,
    target: &Isometry3<f64>,
    random: &mut Random,
) -> Pair {
    let middle = |pixels: u32| (f64::from(pixels) - 1.0) / 2.0;
    let focal = f64::from(width);
    let intrinsics =
        Intrinsics::pinhole(width, height, focal, focal, middle(width), middle(height));
    Pair {
        source: room.scan(source, &intrinsics, NOISE_M, random),
        target: room.scan(target, &intrinsics, NOISE_M, random),
        target_from_source: target.inv_mul(source),
    }
}

/// The truth, turned and shifted about the middle of the scene in a random direction.
pub fn start_near(
    truth: &Isometry3<f64>,
    turn_deg: f64,
    shift_m: f64,
    random: &mut Random,
) -> Isometry3<f64> {
    let turn = random.normal3().normalize() * turn_deg.to_radians();
    let shift = random.normal3().normalize() * shift_m;
    let middle = Isometry3::translation(0.0, 0.0, DISTANCE_M);
    truth * middle * Isometry3::new(shift, turn) * middle.inverse()
}

/// The points that were seen, row by row or shuffled.
pub fn cloud(scan: &Scan, order: Order) -> Scan {
    let seen = scan.points().iter().filter(|p| p.iter().all(|x| x.is_finite()));
    let mut points: Vec<[f32; 3]> = match order {
        Order::Organised => return scan.clone(),
        Order::Rows | Order::Shuffled => seen.copied().collect(),
    };
    if matches!(order, Order::Shuffled) {
        let mut random = Random::new(1);
        for k in (1..points.len()).rev() {
            points.swap(k, (random.unit() * (k + 1) as f64) as usize);
        }
    }
    Scan::new(points.len(), 1, points).expect("a row of points")
}

/// Writes a pair of scans that share a part of the room, and what is known of them.
pub fn render(folder: &Path, size: (u32, u32), seed: u64) {
    let mut random = Random::new(seed);
    let room = Room::of_a_cell(&mut random);
    let source = camera_above(0.05, -0.1, [0.12, 0.05, 0.1]);
    let target = camera_above(-0.1, 0.15, [-0.15, -0.1, -0.1]);
    let pair = scans(&room, size, &source, &target, &mut random);
    let truth = pair.target_from_source;
    let start = start_near(&truth, START_TURN_DEG, START_SHIFT_M, &mut random);
    let name = format!("{}_{seed}", size.0);
    let known =
        json!({ "width": size.0, "height": size.1, "truth": rows(&truth), "start": rows(&start) });
    write(&folder.join(format!("{name}.json")), known.to_string().as_bytes());
    for (scan, role) in [(&pair.source, "source"), (&pair.target, "target")] {
        let bytes: Vec<u8> = scan.points().iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        write(&folder.join(format!("{name}_{role}.f32")), &bytes);
    }
}

fn write(file: &Path, bytes: &[u8]) {
    fs::write(file, bytes).expect("space for the scenes");
}

/// A rendered scene and its start; of clouds, only the points that were seen enter memory.
pub fn load(folder: &Path, name: &str, order: Order) -> (Pair, Isometry3<f64>) {
    let text = fs::read_to_string(folder.join(format!("{name}.json"))).expect("a rendered scene");
    let known: Value = serde_json::from_str(&text).expect("a scene as render writes it");
    let size = |key: &str| known[key].as_u64().expect("a size") as usize;
    let read = |role: &str| {
        let file = folder.join(format!("{name}_{role}.f32"));
        let organised = matches!(order, Order::Organised);
        let points = points(&file, organised);
        let (width, height) =
            if organised { (size("width"), size("height")) } else { (points.len(), 1) };
        let scan = Scan::new(width, height, points).expect("as many points as pixels");
        if matches!(order, Order::Shuffled) { cloud(&scan, order) } else { scan }
    };
    let pair = Pair {
        source: read("source"),
        target: read("target"),
        target_from_source: pose(&known["truth"]),
    };
    (pair, pose(&known["start"]))
}

/// Points of a file: all of them, or those that were seen.
fn points(file: &Path, all: bool) -> Vec<[f32; 3]> {
    let mut reader = BufReader::new(File::open(file).expect("a rendered scan"));
    let mut bytes = [0; POINT_BYTES];
    let count = fs::metadata(file).map_or(0, |m| m.len() as usize / POINT_BYTES);
    let mut points = Vec::with_capacity(count);
    while reader.read_exact(&mut bytes).is_ok() {
        let at = |k: usize| f32::from_le_bytes([0, 1, 2, 3].map(|b| bytes[4 * k + b]));
        let point = [at(0), at(1), at(2)];
        if all || point.iter().all(|x| x.is_finite()) {
            points.push(point);
        }
    }
    points
}

/// A transform as 16 numbers, row by row.
pub fn rows(pose: &Isometry3<f64>) -> Vec<f64> {
    pose.to_homogeneous().transpose().iter().copied().collect()
}

fn pose(rows: &Value) -> Isometry3<f64> {
    let numbers: Vec<f64> = serde_json::from_value(rows.clone()).expect("16 numbers");
    nalgebra::try_convert(Matrix4::from_row_slice(&numbers)).expect("a rigid transform")
}
