//! The images: cases, and the truth about each image.

use std::{fs, path::Path};

use handeye::{
    GrayImage, TargetModel,
    math::random::Random,
    model::target::AprilTagFamily,
    simulate::{Clutter, Conditions, Glare, Occlusion, Optics, Pattern, Scene, Shape, TrueCorner},
};
use image::{ExtendedColorType, ImageEncoder, codecs::png};
use serde_json::{Value, json};

use crate::placing::{Distance, SIZES, Size, place};

/// One image, before it is drawn.
pub struct Picture {
    /// Table that it belongs to, and case there.
    table: &'static str,
    pub case: String,
    size: Size,
    pub target: TargetModel,
    /// Without one, the clutter alone is the image.
    scene: Option<Scene>,
    conditions: Conditions,
    optics: Optics,
    pub seed: u64,
    /// Another board of the same kind, as good an answer.
    twin: Option<Scene>,
}

fn checkerboard() -> TargetModel {
    TargetModel::Checkerboard { columns: 11, rows: 8, square_mm: 20.0 }
}

fn charuco() -> TargetModel {
    TargetModel::Charuco {
        squares_x: 9,
        squares_y: 7,
        square_mm: 20.0,
        marker_mm: 15.0,
        dictionary: "DICT_5X5_100".into(),
        legacy: false,
        first_id: 0,
    }
}

fn aprilgrid() -> TargetModel {
    TargetModel::Aprilgrid {
        tags_x: 6,
        tags_y: 6,
        tag_mm: 24.0,
        spacing: 0.3,
        family: AprilTagFamily::Tag36h11,
        first_id: 0,
        corner_squares: true,
        border_bits: 1,
    }
}

fn tag_grid() -> TargetModel {
    TargetModel::TagGrid {
        dictionary: "DICT_5X5_100".into(),
        tags_x: 7,
        tags_y: 5,
        tag_mm: 24.0,
        gap_mm: 8.0,
        first_id: 0,
    }
}

/// Boards that are measured. A new kind is one more line here and one in `run.py`.
pub fn targets() -> [(&'static str, TargetModel); 4] {
    [
        ("checkerboard", checkerboard()),
        ("charuco", charuco()),
        ("aprilgrid", aprilgrid()),
        ("tag-grid", tag_grid()),
    ]
}

/// Point spreads of the accuracy tables; the noise is `Optics`' own, 2 grey values.
fn spreads() -> [(&'static str, Optics); 5] {
    let sharp = Optics { blur_px: 0.0, ..Optics::default() };
    let motion_rad = 0.6;
    [
        ("Gaussian 0.7 px", Optics { blur_px: 0.7, ..sharp }),
        ("Gaussian 1.5 px", Optics { blur_px: 1.5, ..sharp }),
        ("box 2 px", Optics { aperture_px: 2.0, ..sharp }),
        ("disc 2 px", Optics { defocus_px: 2.0, ..sharp }),
        ("motion 3 px", Optics { motion_px: 3.0, motion_rad, ..sharp }),
    ]
}

/// Contrast over noise.
const SNRS: [f64; 5] = [10.0, 20.0, 50.0, 100.0, 200.0];
/// Steepest tilt of the accuracy tables, degrees.
const STEEPEST_DEG: f64 = 60.0;
/// How far the board's middle is from the image's, and how much of the image it fills.
const ASIDE: f64 = 0.05;
const FILL: f64 = 0.8;

impl Picture {
    fn of(table: &'static str, case: &str, size: Size, target: &TargetModel, seed: u64) -> Self {
        Self {
            table,
            case: case.into(),
            size,
            target: target.clone(),
            scene: None,
            conditions: Conditions::default(),
            optics: Optics::default(),
            seed,
            twin: None,
        }
    }

    pub fn drawn(&self) -> GrayImage {
        match (&self.scene, &self.conditions.clutter) {
            (Some(scene), _) => scene.picture_under(&self.conditions, &self.optics, self.seed),
            (None, clutter) => {
                let clutter = clutter.unwrap_or(Clutter { pattern: Pattern::Noise, seed: 0 });
                clutter.picture((self.size.width, self.size.height), &self.optics, self.seed)
            }
        }
    }

    /// Name of the kind of target.
    pub fn kind(&self) -> &'static str {
        targets().into_iter().find(|(_, t)| *t == self.target).map_or("", |(kind, _)| kind)
    }

    /// The corners of the boards that may be found.
    pub fn boards(&self) -> Vec<Vec<TrueCorner>> {
        let board = |s: &Scene| s.corners_under(&self.conditions, &self.optics);
        self.scene.iter().chain(&self.twin).map(board).collect()
    }

    fn truth(&self, file: &str) -> Value {
        let corner = |c: &TrueCorner| json!([c.id, c.pixel.x, c.pixel.y, c.visible]);
        let board = |b: &Vec<TrueCorner>| -> Vec<Value> { b.iter().map(corner).collect() };
        let boards: Vec<_> = self.boards().iter().map(board).collect();
        json!({
            "file": file, "table": self.table, "case": self.case, "size": self.size.name,
            "target": self.target, "noise": self.optics.noise,
            "contrast": self.optics.white - self.optics.black, "boards": boards,
        })
    }
}

/// Boards tilted evenly from 0 to 60 degrees under every spread, in images of every size.
fn accuracy(count: usize) -> Vec<Picture> {
    let mut all = vec![];
    for (kind, target) in targets() {
        for (s, size) in SIZES.into_iter().enumerate() {
            let plain = kind == "checkerboard";
            let pictures = if size.width > 4000 { count.div_ceil(2) } else { count };
            for (k, (name, optics)) in spreads().into_iter().enumerate() {
                if plain || k % 2 == 0 {
                    let seed = 1000 * (10 * s + k) as u64;
                    let pose = |i: usize| steps(i, pictures);
                    all.extend((0..pictures).map(|i| Picture {
                        optics,
                        ..tilted(("accuracy", name), size, &target, seed + i as u64, pose(i))
                    }));
                }
            }
        }
    }
    all
}

/// Even steps from 0 to the steepest tilt, rad.
fn steps(i: usize, count: usize) -> f64 {
    STEEPEST_DEG.to_radians() * (i as f64 + 0.5) / count as f64
}

fn tilted(
    (table, case): (&'static str, &str),
    size: Size,
    target: &TargetModel,
    seed: u64,
    tilt: f64,
) -> Picture {
    let mut random = Random::new(seed);
    let scene = place(target, size, (Distance::Fill(FILL), tilt, ASIDE), &mut random);
    Picture { scene: Some(scene), ..Picture::of(table, case, size, target, seed) }
}

/// The same scenes with less and less noise.
fn noises(count: usize) -> Vec<Picture> {
    let one = |snr: f64, i: usize| {
        let case = format!("{snr}");
        let picture =
            tilted(("noise", &case), SIZES[0], &checkerboard(), 90_000 + i as u64, steps(i, count));
        let optics = Optics::default();
        Picture {
            optics: Optics { noise: (optics.white - optics.black) / snr, ..optics },
            ..picture
        }
    };
    SNRS.into_iter().flat_map(|snr| (0..count).map(move |i| one(snr, i))).collect()
}

/// What makes an image of the finding tables hard.
const HARD: [&str; 8] = [
    "half hidden",
    "tilt 70 degrees",
    "small squares",
    "glare",
    "defocus 4 px",
    "contrast 20",
    "two boards",
    "clutter",
];
/// Small squares, px: markers take more.
const SMALL_PX: [f64; 2] = [12.0, 22.0];

pub fn hard(count: usize) -> Vec<Picture> {
    let mut all = vec![];
    for (t, (_, target)) in targets().into_iter().enumerate() {
        for (k, case) in HARD.into_iter().enumerate() {
            let seed = 200_000 + (100_000 * t + 10_000 * k) as u64;
            all.extend((0..count).map(|i| hard_one(case, &target, seed + i as u64, i)));
        }
    }
    all
}

fn hard_one(case: &'static str, target: &TargetModel, seed: u64, i: usize) -> Picture {
    let mut random = Random::new(seed);
    let markers = !matches!(target, TargetModel::Checkerboard { .. });
    let tilt = match case {
        "tilt 70 degrees" => 70.0,
        _ => random.between(0.0, 40.0),
    };
    let (distance, aside) = match case {
        "small squares" => (Distance::Square(SMALL_PX[usize::from(markers)]), 0.15),
        "tilt 70 degrees" => (Distance::Fill(0.9), 0.0),
        "two boards" => (Distance::Fill(0.5), 0.0),
        _ => (Distance::Fill(random.between(0.5, 0.85)), 0.05),
    };
    let mut picture = Picture::of("hard", case, SIZES[0], target, seed);
    let scene = place(target, SIZES[0], (distance, f64::to_radians(tilt), aside), &mut random);
    let c = &mut picture.conditions;
    match case {
        "half hidden" => {
            let towards_rad = random.between(0.0, std::f64::consts::TAU);
            let shape = Shape::Side { share: 0.5, towards_rad };
            c.occlusion = Some(Occlusion { shape, grey: random.between(50.0, 200.0), seed });
        }
        "glare" => {
            let at = [random.between(0.1, 0.9), random.between(0.1, 0.9)];
            c.glare = Some(Glare { share: 1.0 / 3.0, at });
        }
        "defocus 4 px" => picture.optics.defocus_px = 4.0,
        "contrast 20" => (picture.optics.black, picture.optics.white) = (100.0, 120.0),
        "clutter" => c.clutter = Some(Clutter { pattern: Pattern::Things, seed }),
        _ => {}
    }
    picture.scene = Some(scene);
    if case == "two boards" {
        two_boards(&mut picture, &mut random, i.is_multiple_of(2));
    }
    picture
}

/// Moves the board to the left and puts another to the right: the same board again, or one of
/// another size.
fn two_boards(picture: &mut Picture, random: &mut Random, twin: bool) {
    let Some(scene) = &mut picture.scene else { return };
    let tilt = random.between(0.0, 0.6);
    let other = if twin { scene.target.clone() } else { smaller(&scene.target) };
    let mut beside = place(&other, picture.size, (Distance::Fill(0.45), tilt, 0.0), random);
    beside.intrinsics = scene.intrinsics;
    let aside = |s: &mut Scene, share: f64| {
        let depth = (s.camera_from_target * s.target.reference()).vector().z;
        let shift = share * f64::from(s.intrinsics.width) / s.intrinsics.fx * depth;
        let moved = nalgebra::Isometry3::translation(shift, 0.0, 0.0);
        s.camera_from_target =
            handeye::Pose::<handeye::Camera, handeye::Camera>::claim(moved) * s.camera_from_target;
    };
    aside(scene, -0.25);
    aside(&mut beside, 0.25);
    picture.conditions.others = vec![(other, beside.camera_from_target)];
    picture.twin = twin.then_some(beside);
}

fn smaller(target: &TargetModel) -> TargetModel {
    match target {
        TargetModel::Checkerboard { .. } => {
            TargetModel::Checkerboard { columns: 8, rows: 5, square_mm: 20.0 }
        }
        _ => TargetModel::Checkerboard { columns: 7, rows: 6, square_mm: 20.0 },
    }
}

/// Images without any board: each pattern in turn.
fn empty(count: usize) -> Vec<Picture> {
    let of = |target: TargetModel| (0..count).map(move |i| empty_of(i, &target));
    targets().into_iter().flat_map(|(_, target)| of(target)).collect()
}

pub fn empty_of(i: usize, target: &TargetModel) -> Picture {
    let pattern = Pattern::ALL[i % Pattern::ALL.len()];
    let seed = 500_000 + i as u64;
    let mut picture = Picture::of("empty", pattern.name(), SIZES[0], target, seed);
    picture.conditions.clutter = Some(Clutter { pattern, seed });
    picture
}

/// Writes images and truth.
pub fn render(folder: &Path, accurate: usize, difficult: usize, none: usize) {
    fs::create_dir_all(folder).expect("a folder that can be made");
    let all = [accuracy(accurate), noises(accurate), hard(difficult), empty(none)];
    let mut truths = vec![];
    for (k, picture) in all.into_iter().flatten().enumerate() {
        let file = format!("{k:05}.png");
        fs::write(folder.join(&file), packed(&picture.drawn())).expect("space for a picture");
        truths.push(picture.truth(&file));
    }
    let text = serde_json::to_string(&truths).expect("finite numbers");
    fs::write(folder.join("truth.json"), text).expect("space for the truth");
}

/// Packed little: noise does not pack, and time is dear.
fn packed(image: &GrayImage) -> Vec<u8> {
    let mut bytes = vec![];
    let (fast, filter) = (png::CompressionType::Fast, png::FilterType::NoFilter);
    let encoder = png::PngEncoder::new_with_quality(&mut bytes, fast, filter);
    let (width, height) = (image.width() as u32, image.height() as u32);
    let written = encoder.write_image(&image.to_u8(), width, height, ExtendedColorType::L8);
    written.expect("a picture of the size of its bytes, into memory");
    bytes
}
