//! `handeye simulate`: a dataset whose truth is known.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use handeye::{
    Intrinsics, Setup, TargetModel,
    simulate::{ArmErrors, Cell, CellNoise, DepthSensor, Optics, Viewing},
};
use handeye_io::simulated::{self, ScanFormat, Writing};
use nalgebra::Vector3;
use serde_json::json;

use crate::{args::GlobalArgs, failure::Failure, output};

/// Arguments of `simulate`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye simulate cell && handeye calibrate cell\n\
\x20 handeye simulate cell --setup eye-to-hand --captures 20 \\\n\
\x20     --scans --scan-format ply\n\
\x20 handeye simulate cell --charuco 12x9 --square-mm 25 --marker-mm 18 \\\n\
\x20     --width 1280 --height 960\n\
\n\
The same options and seed give the same bytes. truth.json holds the answer. A folder is \
written over only if it holds nothing but an earlier simulation, unedited.")]
pub struct SimulateArgs {
    /// Folder for the dataset; it is made if need be.
    pub out: PathBuf,
    /// Random seed.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Where the camera is mounted.
    #[arg(long, value_enum, default_value = "eye-in-hand")]
    pub setup: SetupArg,
    /// Robot poses with an image.
    #[arg(long, default_value_t = 15)]
    pub captures: usize,
    /// Boards laid down to be touched (eye-to-hand) [default: 3].
    #[arg(long)]
    pub placements: Option<usize>,
    /// Corners touched on each of them (4), or on the one fixed board (12); 0 for none.
    #[arg(long)]
    pub touches: Option<usize>,
    /// Image width, px.
    #[arg(long, default_value_t = 1920)]
    pub width: u32,
    /// Image height, px.
    #[arg(long, default_value_t = 1200)]
    pub height: u32,
    /// Focal length, px [default: 0.94 image widths].
    #[arg(long)]
    pub focal_px: Option<f64>,
    /// Checkerboard, numbers of inner corners: 9x6.
    #[arg(long, value_name = "CxR", conflicts_with_all = ["charuco", "tag"])]
    pub checkerboard: Option<String>,
    /// ChArUco board, numbers of squares: 12x9.
    #[arg(long, value_name = "CxR", conflicts_with = "tag")]
    pub charuco: Option<String>,
    /// One tag of this id.
    #[arg(long, value_name = "ID")]
    pub tag: Option<u32>,
    /// A ball of this diameter, in scans alone; nothing is touched.
    #[arg(long, value_name = "MM", conflicts_with_all = ["checkerboard", "charuco", "tag", "no_images"])]
    pub sphere: Option<f64>,
    /// Side of a square; of a tag with --tag.
    #[arg(long, default_value_t = 30.0)]
    pub square_mm: f64,
    /// Side of a marker on a ChArUco board [default: 0.75 squares].
    #[arg(long)]
    pub marker_mm: Option<f64>,
    /// Markers of a ChArUco board, or of a tag.
    #[arg(long, default_value = "DICT_6X6_250")]
    pub dictionary: String,
    /// Largest tilt of the target against the camera.
    #[arg(long, default_value_t = 35.0)]
    pub tilt_deg: f64,
    /// Largest turn of the camera about its axis, either way.
    #[arg(long, default_value_t = 90.0)]
    pub spin_deg: f64,
    /// A six-axis arm that gives joint values, and is not built quite as its model says; takes the
    /// place of --robot-mm and --robot-deg.
    #[arg(long)]
    pub arm: bool,
    /// Robot position error, independent in every pose (3-D RMS).
    #[arg(long, default_value_t = 0.5)]
    pub robot_mm: f64,
    /// The same for rotations, about each axis.
    #[arg(long, default_value_t = 0.03)]
    pub robot_deg: f64,
    /// Error of the arm as it was built, smooth over the workspace and equal in equal poses (3-D
    /// RMS); --robot-mm is independent in every pose.
    #[arg(long, default_value_t = 0.0)]
    pub robot_systematic_mm: f64,
    /// The same for rotations, about each axis.
    #[arg(long, default_value_t = 0.0)]
    pub robot_systematic_deg: f64,
    /// Repeatability of the robot (3-D RMS).
    #[arg(long, default_value_t = 0.05)]
    pub repeatability_mm: f64,
    /// Error of every touch (3-D RMS).
    #[arg(long, default_value_t = 0.3)]
    pub touch_mm: f64,
    /// Error of the declared tool tip: distance from the true tip.
    #[arg(long, default_value_t = 0.0)]
    pub tip_mm: f64,
    /// Noise of corners, with --no-images.
    #[arg(long, default_value_t = 0.1)]
    pub corner_px: f64,
    /// Noise of images, of 255 grey values.
    #[arg(long, default_value_t = 2.0)]
    pub image_noise: f64,
    /// Noise of a depth at 1 m; it grows with the square of the distance.
    #[arg(long, default_value_t = 0.3)]
    pub depth_mm: f64,
    /// Scans read black farther than white by this, along the optical axis.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    pub black_step_mm: f64,
    /// The ends of the board lie this far behind its middle: it is bent.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    pub bow_mm: f64,
    /// The board was printed too long by this, along its x.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    pub print_x_percent: f64,
    /// The same along its y.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    pub print_y_percent: f64,
    /// Distances in scans are too large by this.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    pub scan_scale_percent: f64,
    /// Scans are turned against images by this, about the camera's x.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    pub scan_tilt_deg: f64,
    /// Scans are shifted against images by this, along the camera's x.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    pub scan_shift_mm: f64,
    /// No noise.
    #[arg(long)]
    pub exact: bool,
    /// Write scans as well.
    #[arg(long, conflicts_with = "no_images")]
    pub scans: bool,
    /// How scans are written; ply and pcd are organised clouds in metres.
    #[arg(long, value_enum, default_value = "depth-png")]
    pub scan_format: ScanFormatArg,
    /// Pixels of a scan per pixel of an image: 1, 0.5, ...
    #[arg(long, default_value_t = 1.0)]
    pub scan_scale: f64,
    /// Lists of corners instead of images.
    #[arg(long)]
    pub no_images: bool,
    /// Write into a folder that holds other files, or files of it that were edited.
    #[arg(long)]
    pub force: bool,
}

/// Where the camera is mounted.
#[derive(Clone, Copy, ValueEnum)]
pub enum SetupArg {
    /// On the robot flange; the target is fixed.
    EyeInHand,
    /// Fixed in the cell; the target is on the flange.
    EyeToHand,
}

impl From<SetupArg> for Setup {
    fn from(arg: SetupArg) -> Self {
        match arg {
            SetupArg::EyeInHand => Setup::EyeInHand,
            SetupArg::EyeToHand => Setup::EyeToHand,
        }
    }
}

/// How scans are written.
#[derive(Clone, Copy, ValueEnum)]
pub enum ScanFormatArg {
    /// Depth images of 16 bits, 0.1 mm a unit.
    DepthPng,
    /// Organised PLY.
    Ply,
    /// Organised PCD.
    Pcd,
}

impl From<ScanFormatArg> for ScanFormat {
    fn from(arg: ScanFormatArg) -> Self {
        match arg {
            ScanFormatArg::DepthPng => ScanFormat::DepthPng,
            ScanFormatArg::Ply => ScanFormat::Ply,
            ScanFormatArg::Pcd => ScanFormat::Pcd,
        }
    }
}

/// Most captures, placements or touches: more are mistakes.
const MOST: usize = 999;
/// Largest step, bow or shift of a scan, mm.
const MOST_FAULT_MM: f64 = 100.0;
/// Largest side of an image, px.
const LARGEST_PX: u32 = 10_000;

pub fn run(args: &SimulateArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let cell = cell(args)?;
    let recording = cell.record(args.seed).map_err(|e| Failure::Usage(e.to_string()))?;
    if let Some(foreign) = simulated::foreign(&args.out).filter(|_| !args.force) {
        let what = "was not written by `simulate`, or was edited since: name another folder for \
                    the dataset, or say --force to write over what has the same name";
        return Err(Failure::in_the_way(foreign, what));
    }
    let writing = Writing { images: !args.no_images, scans: args.scan_format.into() };
    let names = simulated::write(&recording, &args.out, writing)?;
    if global.json {
        output::json(&json!({"folder": args.out, "files": names}));
    } else if !global.quiet {
        let folder = args.out.display();
        output::print(&format!("{} files in {folder}; the truth is in truth.json\n", names.len()));
    }
    Ok(0)
}

fn cell(args: &SimulateArgs) -> Result<Cell, Failure> {
    let setup = args.setup.into();
    let usual = Cell::new(setup, args.seed);
    let placements = args.placements.unwrap_or(usual.placements);
    let touches = args.touches.unwrap_or(usual.touches);
    let touches = if args.sphere.is_some() { 0 } else { touches };
    check(args, placements, touches)?;
    let placements = if setup == Setup::EyeInHand || touches == 0 { 0 } else { placements };
    let depth = DepthSensor {
        sigma_at_1m: zero_if(args.exact, args.depth_mm) * 1e-3,
        black_step_m: args.black_step_mm * 1e-3,
        scale: args.scan_scale_percent * 1e-2,
        turn_rad: Vector3::x() * args.scan_tilt_deg.to_radians(),
        shift_m: Vector3::x() * args.scan_shift_mm * 1e-3,
        // a ball lies on the table
        table_behind_m: args.sphere.map_or(usual_table(), |mm| 0.5e-3 * mm),
        ..DepthSensor::default()
    };
    Ok(Cell {
        target: target(args)?,
        intrinsics: intrinsics(args),
        viewing: Viewing {
            tilt_rad: args.tilt_deg.to_radians(),
            spin_rad: args.spin_deg.to_radians(),
            ..usual.viewing
        },
        noise: noise(args),
        arm: args.arm.then(|| arm(args)),
        depth: (args.scans || args.sphere.is_some()).then_some(depth),
        scan_scale: args.scan_scale,
        bow_mm: args.bow_mm,
        print_scale: [args.print_x_percent / 100.0, args.print_y_percent / 100.0],
        optics: Optics { noise: zero_if(args.exact, args.image_noise), ..usual.optics },
        captures: args.captures,
        placements,
        touches,
        ..usual
    })
}

fn check(args: &SimulateArgs, placements: usize, touches: usize) -> Result<(), Failure> {
    let usage = |what: String| Err(Failure::Usage(what));
    for (name, count) in
        [("captures", args.captures), ("placements", placements), ("touches", touches)]
    {
        if count > MOST {
            return usage(format!("--{name} {count}: at most {MOST}"));
        }
    }
    if args.captures == 0 {
        return usage("--captures 0: nothing to record".into());
    }
    if !(1..=LARGEST_PX).contains(&args.width) || !(1..=LARGEST_PX).contains(&args.height) {
        return usage(format!("images have 1 to {LARGEST_PX} pixels a side"));
    }
    if !(0.05..=1.0).contains(&args.scan_scale) {
        return usage("--scan-scale is between 0.05 and 1".into());
    }
    if !(0.0..=80.0).contains(&args.tilt_deg) || !(0.0..=180.0).contains(&args.spin_deg) {
        return usage("--tilt-deg is between 0 and 80, --spin-deg between 0 and 180".into());
    }
    let noise = [
        ("robot-mm", args.robot_mm),
        ("robot-deg", args.robot_deg),
        ("robot-systematic-mm", args.robot_systematic_mm),
        ("robot-systematic-deg", args.robot_systematic_deg),
        ("repeatability-mm", args.repeatability_mm),
        ("touch-mm", args.touch_mm),
        ("tip-mm", args.tip_mm),
        ("corner-px", args.corner_px),
        ("image-noise", args.image_noise),
        ("depth-mm", args.depth_mm),
    ];
    let faults = [
        ("black-step-mm", args.black_step_mm, MOST_FAULT_MM),
        ("bow-mm", args.bow_mm, MOST_FAULT_MM),
        ("print-x-percent", args.print_x_percent, 50.0),
        ("print-y-percent", args.print_y_percent, 50.0),
        ("scan-scale-percent", args.scan_scale_percent, 50.0),
        ("scan-tilt-deg", args.scan_tilt_deg, 45.0),
        ("scan-shift-mm", args.scan_shift_mm, MOST_FAULT_MM),
    ];
    if let Some((name, value, most)) = faults.iter().find(|(_, v, most)| !(v.abs() <= *most)) {
        return usage(format!("--{name} {value}: at most {most} either way"));
    }
    match noise.iter().find(|(_, v)| !(v.is_finite() && *v >= 0.0)) {
        Some((name, value)) => usage(format!("--{name} {value}: must not be negative")),
        None => Ok(()),
    }
}

fn usual_table() -> f64 {
    DepthSensor::default().table_behind_m
}

fn zero_if(exact: bool, value: f64) -> f64 {
    if exact { 0.0 } else { value }
}

/// An arm's errors take the place of those of a robot that only gives poses.
fn arm(args: &SimulateArgs) -> ArmErrors {
    if args.exact { ArmErrors::NONE } else { ArmErrors::default() }
}

fn noise(args: &SimulateArgs) -> CellNoise {
    if args.exact {
        return CellNoise::NONE;
    }
    CellNoise {
        robot_repeatability_m: args.repeatability_mm * 1e-3,
        robot_repeatability_rad: 0.0,
        robot_absolute_m: zero_if(args.arm, args.robot_mm) * 1e-3,
        robot_absolute_rad: zero_if(args.arm, args.robot_deg).to_radians(),
        robot_systematic_m: args.robot_systematic_mm * 1e-3,
        robot_systematic_rad: args.robot_systematic_deg.to_radians(),
        corner_px: args.corner_px,
        touch_m: args.touch_mm * 1e-3,
        tip_m: args.tip_mm * 1e-3,
    }
}

fn intrinsics(args: &SimulateArgs) -> Intrinsics {
    let (width, height) = (f64::from(args.width), f64::from(args.height));
    let f = args.focal_px.unwrap_or(0.9375 * width);
    Intrinsics::pinhole(args.width, args.height, f, f, 0.5 * (width - 1.0), 0.5 * (height - 1.0))
}

fn target(args: &SimulateArgs) -> Result<TargetModel, Failure> {
    let dictionary = args.dictionary.clone();
    let square_mm = args.square_mm;
    let target = if let Some(mm) = args.sphere {
        TargetModel::Sphere { diameter_mm: Some(mm) }
    } else if let Some(id) = args.tag {
        TargetModel::Tag { dictionary, id, size_mm: square_mm }
    } else if let Some(size) = &args.charuco {
        let (squares_x, squares_y) = size_of(size)?;
        let marker_mm = args.marker_mm.unwrap_or(0.75 * square_mm);
        TargetModel::Charuco {
            squares_x,
            squares_y,
            square_mm,
            marker_mm,
            dictionary,
            legacy: false,
            first_id: 0,
        }
    } else {
        let (columns, rows) = size_of(args.checkerboard.as_deref().unwrap_or("9x6"))?;
        TargetModel::Checkerboard { columns, rows, square_mm }
    };
    target.check().map_err(|e| Failure::Usage(e.to_string()))?;
    let known = handeye::detect::markers::Dictionary::named(&args.dictionary).is_some();
    if known {
        Ok(target)
    } else {
        Err(Failure::Usage(format!("no dictionary {}", args.dictionary)))
    }
}

fn size_of(text: &str) -> Result<(u32, u32), Failure> {
    let size = text.split_once('x').and_then(|(c, r)| Some((c.parse().ok()?, r.parse().ok()?)));
    size.ok_or_else(|| Failure::Usage(format!("{text:?} is no size like 9x6")))
}
