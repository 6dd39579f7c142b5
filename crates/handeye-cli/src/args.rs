//! The command line, typed.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use handeye_io::{plan::UrdfOption, units::LengthUnit};

use crate::boards::Board;

/// Hand-eye calibration: the pose of the camera on the robot flange or in the robot base, with its uncertainty.
///
/// A folder of captures goes in; a transform comes out, with its uncertainty, a verdict, and the
/// evidence. Exit codes: 0 accepted, 1 the input cannot be used, 2 wrong command line, 3 rejected
/// or undetermined (the result is still written), 4 with --strict: accepted with findings that
/// changed the answer.
#[derive(Parser)]
#[command(name = "handeye", version, max_term_width = 80)]
pub struct Program {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// How to talk.
    #[command(flatten)]
    pub global: GlobalArgs,
}

/// Options of every command.
#[derive(Args, Clone)]
pub struct GlobalArgs {
    /// Print one JSON document on standard output and nothing else there.
    #[arg(long, global = true)]
    pub json: bool,
    /// No progress, no warnings.
    #[arg(long, short, global = true)]
    pub quiet: bool,
}

/// Commands.
#[derive(Subcommand)]
pub enum Command {
    /// Calibrate from a folder of captures with a manifest `handeye.toml`.
    Calibrate(CalibrateArgs),
    /// Solve for the transform from pairs of robot and target poses.
    Solve(Box<crate::solve::SolveArgs>),
    /// Find mistakes in a dataset: notation, units, direction, order, target size, outliers.
    Check(CheckArgs),
    /// Export a result in the format of a robot controller, ROS, OpenCV or another program.
    Export(ExportArgs),
    /// Write a first `handeye.toml` for a folder, with the questions that its files leave open.
    Init(crate::init::InitArgs),
    /// Import a dataset or result of another program (easy_handeye2, MoveIt, Zivid, HALCON, ...).
    Import(crate::import::ImportArgs),
    /// Show the contents of a ROS bag, or extract a folder of captures from it.
    Bag(Box<crate::bag::BagArgs>),
    /// Draw a board to print, in true scale.
    Target(Box<TargetArgs>),
    /// Compare several results of one cell: do they agree?
    #[command(visible_alias = "repeat")]
    Compare(crate::compare::CompareArgs),
    /// Plan the views to take next: poses of the robot, what each brings, and corners to touch.
    Plan(Box<crate::plan::PlanArgs>),
    /// A guided live calibration in the browser: what to show, where to drive next, whether it is good, when it is enough.
    #[cfg(feature = "session")]
    Session(Box<crate::session::SessionArgs>),
    /// Calibrate a tool tip (TCP position) from flange poses with the tip on one fixed point (pivot calibration).
    Tcp(crate::tcp::TcpArgs),
    /// Correct robot poses for the pose-dependent robot error that a calibration has estimated.
    Compensate(Box<crate::compensate::CompensateArgs>),
    /// Verify a calibration with touched points: distance between the tool tip and the camera's prediction.
    Verify(VerifyArgs),
    /// Register one scan to another: ICP with a covariance and a verdict.
    Register(RegisterArgs),
    /// Write a page that shows scans, meshes, calibrations and registrations in 3D.
    View(ViewArgs),
    /// Detect the target's corners in images.
    Detect(DetectArgs),
    /// Write a simulated dataset whose truth is known.
    Simulate(Box<crate::simulate::SimulateArgs>),
    /// Calibrate a small built-in dataset and print the path of the report.
    Demo(crate::demo::DemoArgs),
    /// Write completions for a shell.
    #[command(after_help = "Example:\n\
\x20 handeye completions bash > ~/.local/share/bash-completion/completions/handeye")]
    Completions {
        /// Which shell.
        shell: Shell,
    },
}

/// What a script wants of a result.
#[derive(Args)]
pub struct Acceptance {
    /// Accept only if the predicted error (95 %) is below this [default: what a manifest says, or 10].
    #[arg(long, value_name = "MM")]
    pub max_error_mm: Option<f64>,
    /// Exit code 4 if the result is accepted with findings that changed the answer.
    #[arg(long)]
    pub strict: bool,
    /// Print one line, for a log, instead of the summary.
    #[arg(long)]
    pub oneline: bool,
}

/// Arguments of `calibrate`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye calibrate cell/\n\
\x20 handeye calibrate cell/ --out result --format ros2-launch,kuka\n\
\x20 handeye calibrate cell.toml --root /data/cell --json\n\
\x20 handeye calibrate cell/ --max-error-mm 0.5 --strict --oneline >> nightly.log")]
pub struct CalibrateArgs {
    /// Folder that contains `handeye.toml`, or the path of a manifest file.
    pub dataset: PathBuf,
    /// Folder that the file names in the manifest are relative to [default: the folder of the manifest].
    #[arg(long)]
    pub root: Option<PathBuf>,
    /// Folder for calibration.json, report.html and exports; created if it does not exist.
    #[arg(long, short)]
    pub out: Option<PathBuf>,
    /// Also export the transform in these formats (see `handeye export --format list`).
    #[arg(long, value_delimiter = ',', requires = "out")]
    pub format: Vec<String>,
    /// Use one published method by name instead of the joint fit (names: `handeye solve --help`).
    #[arg(long)]
    pub method: Option<String>,
    /// ICP on touched corners (candidate `two-step-icp` only): maximum number of iterations.
    #[arg(long, default_value_t = 50)]
    pub icp_max_iterations: usize,
    /// ICP on touched corners: maximum correspondence distance, mm.
    #[arg(long, default_value_t = 10.0)]
    pub icp_max_distance_mm: f64,
    /// ICP on touched corners: stop when an iteration changes the transform by less than this (rad, m).
    #[arg(long, default_value_t = 1e-9)]
    pub icp_epsilon: f64,
    /// What a script wants of the result.
    #[command(flatten)]
    pub acceptance: Acceptance,
}

/// Arguments of `export`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye export result/calibration.json --format kuka\n\
\x20 handeye export result/calibration.json -f urdf,ros2-launch,npy --out exports\n\
\x20 handeye export result -f urdf --child camera_link --urdf d435.urdf \\\n\
\x20     --optical camera_color_optical_frame\n\
\x20 handeye export --format list")]
pub struct ExportArgs {
    /// The calibration.json of a result, or its folder; or a pose that `import` wrote.
    pub calibration: Option<PathBuf>,
    /// What to write, one or several; `list` shows all.
    #[arg(long, short, required = true, value_delimiter = ',')]
    pub format: Vec<String>,
    /// Folder, or file for a single format; without it the text goes to standard output.
    #[arg(long, short)]
    pub out: Option<PathBuf>,
    /// Name of the parent frame [default: that of the result, or base or flange].
    #[arg(long)]
    pub parent: Option<String>,
    /// Name of the camera's optical frame, or of a frame fixed to the camera that the result knows, as
    /// camera_link [default: that of the result, or camera].
    #[arg(long)]
    pub child: Option<String>,
    /// URDF with the camera's links: where --child, a link of the camera's body, lies to the optical frame.
    #[arg(long, value_name = "FILE", requires = "child")]
    pub urdf: Option<PathBuf>,
    /// The URDF's link that is the camera's optical frame (x right, y down, z forward) [default: the frame that the
    /// result names].
    #[arg(long, value_name = "LINK", requires = "urdf")]
    pub optical: Option<String>,
    /// Export a result that was not accepted, too.
    #[arg(long)]
    pub force: bool,
}

/// Arguments of `target`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye target --checkerboard 11x8 --square-mm 20 --out board.pdf\n\
\x20 handeye target --charuco 7x5 --square-mm 35 --marker-mm 26 \\\n\
\x20     --dictionary DICT_5X5_100 --out board.svg --paper a3\n\
\x20 handeye target --aprilgrid 6x6 --tag-mm 24 --out board.pdf\n\
\x20 handeye target cell/handeye.toml --out board.pdf --paper 600x500")]
pub struct TargetArgs {
    /// A manifest or another TOML file with a `[target]`.
    #[arg(group = "kind")]
    pub target: Option<PathBuf>,
    /// The board that an option names.
    #[command(flatten)]
    pub board: Board,
    /// Side of a square.
    #[arg(long)]
    pub square_mm: Option<f64>,
    /// Side of a ChArUco board's markers.
    #[arg(long)]
    pub marker_mm: Option<f64>,
    /// OpenCV's name of the markers, such as DICT_6X6_250.
    #[arg(long)]
    pub dictionary: Option<String>,
    /// Family of an aprilgrid's tags: 16h5, 25h9, 36h10 or 36h11.
    #[arg(long, value_name = "NAME", default_value = "36h11")]
    pub family: String,
    /// Side of the black square of a grid's tags.
    #[arg(long)]
    pub tag_mm: Option<f64>,
    /// Gap between an aprilgrid's tags over the side of a tag.
    #[arg(long, value_name = "RATIO", default_value_t = 0.3)]
    pub spacing: f64,
    /// Gap between the tags of a tag grid.
    #[arg(long)]
    pub gap_mm: Option<f64>,
    /// The first tag of a grid, or marker of a ChArUco board.
    #[arg(long, value_name = "ID", default_value_t = 0)]
    pub first_id: u32,
    /// Width of the black border of an aprilgrid's tags, bits; Kalibr's own drawings have 2.
    #[arg(long, value_name = "BITS", default_value_t = 1)]
    pub border_bits: u32,
    /// No black squares where the gaps of an aprilgrid cross.
    #[arg(long)]
    pub no_corner_squares: bool,
    /// ChArUco layout of OpenCV before 4.6.
    #[arg(long)]
    pub legacy: bool,
    /// Side of the single marker's black square.
    #[arg(long)]
    pub size_mm: Option<f64>,
    /// Distance between the centres of neighbouring circles; in an asymmetric grid between rows.
    #[arg(long)]
    pub pitch_mm: Option<f64>,
    /// The drawing, .pdf or .svg; a .toml with the `[target]` is written beside it.
    #[arg(long, short)]
    pub out: PathBuf,
    /// a4, a3, a2, a1, a0, letter, or a size in mm such as 300x400.
    #[arg(long, default_value = "a4")]
    pub paper: String,
}

/// Arguments of `detect`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye detect images/*.png --target handeye.toml\n\
\x20 handeye detect 01.png --target board.toml --draw found --json\n\
\x20 handeye detect *.png --target circles.toml --camera camera.yaml")]
pub struct DetectArgs {
    /// PNG, JPEG, TIFF or BMP images.
    #[arg(required = true)]
    pub images: Vec<PathBuf>,
    /// A manifest or another TOML file with a `[target]`, or with several `[[target]]`, each with a
    /// name.
    #[arg(long, short)]
    pub target: PathBuf,
    /// Folder for images with the corners, their ids and their residuals, magnified, drawn in.
    #[arg(long)]
    pub draw: Option<PathBuf>,
    /// The camera's intrinsics, in any file that a manifest may name: circles are found where their
    /// centres are, and residuals include the distortion.
    #[arg(long)]
    pub camera: Option<PathBuf>,
    /// Which camera, in a file of several.
    #[arg(long, requires = "camera")]
    pub camera_name: Option<String>,
}

/// Arguments of `register`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye register scan.ply reference.ply\n\
\x20 handeye register scan.zdf part.stl --length-unit mm --global\n\
\x20 handeye register a.pcd b.pcd --initial guess.json --max-distance-mm 20\n\
\x20 handeye register 01.png 02.png --camera camera.yaml --depth-scale 0.001 --json\n\
\x20 handeye register scan.ply reference.ply --report registration.html\n\
\n\
target_from_source takes points of SOURCE into TARGET; so does --initial, and the answer \
contains it. guess.json: {\"translation_m\": [x, y, z], \"rotation_xyzw\": [x, y, z, w]}, or \
a matrix of 4 rows.\n\
\n\
Exit code 0: accepted; 3: rejected, or not determined by what both scans show.")]
pub struct RegisterArgs {
    /// The scan to be moved: PLY, PCD, E57, ZDF, XYZ, TXT, CSV, ASC, PTS, NPY, NPZ, or depth in PNG or TIFF;
    /// or a mesh: STL, OBJ, PLY with faces.
    pub source: PathBuf,
    /// The scan or mesh that stays.
    pub target: PathBuf,
    /// symmetric, point-to-point, point-to-plane or gicp.
    #[arg(long, default_value = "symmetric")]
    pub method: String,
    /// JSON file with the initial guess of target_from_source [default: identity; without a guess use --global].
    #[arg(long)]
    pub initial: Option<PathBuf>,
    /// Search for the source everywhere in the target, without an initial guess. Of a symmetric part
    /// all equivalent poses are listed.
    #[arg(long, conflicts_with = "initial")]
    pub global: bool,
    /// Maximum correspondence distance; about the largest error of the initial guess [default: 50].
    #[arg(long)]
    pub max_distance_mm: Option<f64>,
    /// Maximum number of iterations, with all points, and with a subset from each initial guess.
    #[arg(long, default_value_t = 60)]
    pub max_iterations: usize,
    /// A page with the verdict, both scans in 3D before and after, and their distances.
    #[arg(long, value_name = "PAGE.html")]
    pub report: Option<PathBuf>,
    /// How the scans are read.
    #[command(flatten)]
    pub reading: Reading,
}

/// What files of scans do not say.
#[derive(Args)]
pub struct Reading {
    /// Unit of the points, where the file does not say it (E57 and ZDF do) [default: mm for what is wider than
    /// 20 units, else m].
    #[arg(long)]
    pub length_unit: Option<Length>,
    /// Metres per unit of a depth image, such as 0.001.
    #[arg(long)]
    pub depth_scale: Option<f64>,
    /// Intrinsics of the depth images, in any file that a manifest may name.
    #[arg(long)]
    pub camera: Option<PathBuf>,
}

/// Arguments of `view`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye view scan.ply\n\
\x20 handeye view scan.zdf part.stl --length-unit mm --out both.html\n\
\x20 handeye view scan.ply result/calibration.json\n\
\x20 handeye view dataset result\n\
\x20 handeye register a.ply b.ply --json > found.json\n\
\x20 handeye view a.ply b.ply found.json\n\
\n\
The page needs neither a network nor anything beside it. Every file is a layer that can be \
switched off. Scans lie in their own frame, which is the camera's. Two kinds of JSON files \
move them, and the page says so: an answer of `handeye register --json` moves the first scan \
into the second, and one eye-to-hand calibration.json moves all scans into the frame of the \
robot's base; one of a camera on the flange moves scans that have the names of its captures. The \
folder of a dataset is shown with its result: target, arm, and all scans in the frame of the base. At most 150 000 points of a scan are shown, and 500 000 of all, evenly spread.")]
pub struct ViewArgs {
    /// Scans and meshes as `register` reads them, the folder of a dataset, a calibration.json or a pose that `import` wrote, an
    /// answer of `handeye register --json`.
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// The page; one that is there is written over.
    #[arg(long, short, default_value = "view.html", value_name = "PAGE")]
    pub out: PathBuf,
    /// How the scans are read.
    #[command(flatten)]
    pub reading: Reading,
}

/// The model of a robot's arm.
#[derive(Args)]
pub struct ArmArgs {
    /// The robot's URDF: joint values within limits, and no collisions of its links.
    #[arg(long, value_name = "FILE")]
    pub urdf: Option<PathBuf>,
    /// The URDF's link that is the robot's base.
    #[arg(long, value_name = "LINK", default_value = "base_link", requires = "urdf")]
    pub base_link: String,
    /// The URDF's link that is the robot's flange.
    #[arg(long, value_name = "LINK", default_value = "tool0", requires = "urdf")]
    pub flange_link: String,
}

impl ArmArgs {
    /// What it names.
    pub fn option(&self) -> Option<UrdfOption> {
        self.urdf.clone().map(|file| UrdfOption {
            file,
            base: self.base_link.clone(),
            flange: self.flange_link.clone(),
        })
    }
}

/// A unit of length.
#[derive(Clone, Copy, clap::ValueEnum)]
pub enum Length {
    /// Metres.
    M,
    /// Millimetres.
    Mm,
    /// Centimetres.
    Cm,
    /// Inches.
    Inch,
}

impl From<Length> for LengthUnit {
    fn from(length: Length) -> Self {
        match length {
            Length::M => Self::Metre,
            Length::Mm => Self::Millimetre,
            Length::Cm => Self::Centimetre,
            Length::Inch => Self::Inch,
        }
    }
}

/// A file of robot poses, and how it is written.
#[derive(Args)]
pub struct PosesArgs {
    /// File of flange poses, or a pattern; or a TOML file with a `[robot]`.
    pub poses: PathBuf,
    /// How the poses are written: ur, kuka, matrix4x4, euler-xyz-extrinsic, ...
    #[arg(long)]
    pub notation: Option<String>,
    /// base_from_flange (where the flange is) or flange_from_base.
    #[arg(long)]
    pub direction: Option<String>,
    /// m, mm, cm or inch [default: the maker's].
    #[arg(long)]
    pub length_unit: Option<String>,
    /// deg or rad [default: the notation's].
    #[arg(long)]
    pub angle_unit: Option<String>,
    /// Where the numbers stand in a JSON, YAML or XML file, such as 'poses.*.flange'.
    #[arg(long, value_delimiter = ',')]
    pub field: Vec<String>,
    /// First and last record, such as 1..5.
    #[arg(long)]
    pub rows: Option<String>,
    /// Columns in the notation's order, by number from 1 or by name.
    #[arg(long, value_delimiter = ',')]
    pub columns: Vec<String>,
    /// Lines before the table.
    #[arg(long, default_value_t = 0)]
    pub skip_header: u32,
}

/// Arguments of `verify`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye verify result touches.csv --tolerance-mm 1\n\
\x20 handeye verify result/calibration.json new-touches/ --out result --json\n\
\n\
touches.csv, a line for each touch (the flange where a camera on it measured):\n\
\x20 id,camera_x_mm,camera_y_mm,camera_z_mm,touched_x_mm,touched_y_mm,touched_z_mm\n\
\x20   [,flange_x_mm,flange_y_mm,flange_z_mm,\n\
\x20    flange_qx,flange_qy,flange_qz,flange_qw]\n\
\n\
Exit code 0: passed; 3: failed. With --tolerance-mm, 95 % of the touches must lie within it; \
without, the touches must agree with the uncertainty that the calibration states (p >= \
0.01).")]
pub struct VerifyArgs {
    /// calibration.json, or the folder that holds it; or a pose that `import` wrote.
    pub calibration: PathBuf,
    /// CSV or JSON file of points seen and touched; or a dataset with touches that are new.
    pub touches: PathBuf,
    /// Largest distance between tip and prediction that the job allows.
    #[arg(long)]
    pub tolerance_mm: Option<f64>,
    /// Standard deviation of touching a point with the tip, per axis.
    #[arg(long, default_value_t = 0.2)]
    pub touch_noise_mm: f64,
    /// Standard deviation of the camera's points in the file, per axis.
    #[arg(long, default_value_t = 0.2)]
    pub camera_noise_mm: f64,
    /// Folder for verify.html; created if it does not exist.
    #[arg(long, short)]
    pub out: Option<PathBuf>,
}

/// Arguments of `check`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye check cell/\n\
\x20 handeye check cell/ --apply\n\
\x20 handeye check cell.toml --root /data/cell --json\n\
\n\
Reads the robot's numbers in every notation, unit and direction, in other orders, and with \
another size of the target, and says which explains the captures best. --apply writes the \
manifest of the best explanation and keeps the old one as handeye.toml.bak; where several \
fit equally well, choose one by its number (--apply=2).\n\
\n\
Exit code 0: nothing is wrong; 3: something is.")]
pub struct CheckArgs {
    /// Folder that contains `handeye.toml`, or the path of a manifest file.
    pub dataset: PathBuf,
    /// Folder that the file names in the manifest are relative to [default: the folder of the manifest].
    #[arg(long)]
    pub root: Option<PathBuf>,
    /// Write the corrected manifest; a number chooses one of several explanations that fit equally well.
    #[arg(long, value_name = "NUMBER", num_args = 0..=1, require_equals = true, default_missing_value = "0")]
    pub apply: Option<usize>,
}
