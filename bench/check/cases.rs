//! Simulated datasets with one mistake each, as files, and whether `check` names the mistake.

#[path = "plant.rs"]
mod plant;

use std::{
    f64::consts::PI,
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

use handeye::{Camera, Pose, Session, Setup, Target, math::random::Random, simulate::Cell};
use handeye_io::{
    Dataset, MANIFEST,
    checkup::{self, Explanation},
    robot::{Notation, Units},
    units::{AngleUnit, LengthUnit},
};
use nalgebra::{Isometry3, UnitQuaternion, Vector3};

type Iso = Isometry3<f64>;

/// A mistake that is planted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mistake {
    None,
    RobotInverted,
    BoardInverted,
    SetupExchanged,
    EulerOrder,
    VectorAsEuler,
    EulerAsVector,
    QuaternionOrder,
    DegreesRadians,
    MillimetresMetres,
    RotationsTransposed,
    AxisMirrored,
    BaseLeftHanded,
    SquareSizeFar,
    SquareSizeNear,
    OrderShifted,
    OrderReversed,
    PicturesExchanged,
    RobotPoseFrozen,
    CameraStill,
    CaptureRepeated,
    TargetMoved,
    CameraMoved,
    BothInverted,
    HalfPixel,
}

use Mistake as M;

/// Every mistake.
pub const MISTAKES: [Mistake; 24] = [
    M::RobotInverted,
    M::BoardInverted,
    M::SetupExchanged,
    M::EulerOrder,
    M::VectorAsEuler,
    M::EulerAsVector,
    M::QuaternionOrder,
    M::DegreesRadians,
    M::MillimetresMetres,
    M::RotationsTransposed,
    M::AxisMirrored,
    M::BaseLeftHanded,
    M::SquareSizeFar,
    M::SquareSizeNear,
    M::OrderShifted,
    M::OrderReversed,
    M::PicturesExchanged,
    M::RobotPoseFrozen,
    M::CameraStill,
    M::CaptureRepeated,
    M::TargetMoved,
    M::CameraMoved,
    M::BothInverted,
    M::HalfPixel,
];

/// What can be told of a mistake.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tellable {
    /// One explanation.
    Alone,
    /// Several that amount to the same.
    AmongOthers,
    /// Nothing: the captures agree as well as without it.
    Nothing,
}

impl Mistake {
    pub fn name(self) -> &'static str {
        match self {
            M::None => "none",
            M::RobotInverted => "robot poses inverted",
            M::BoardInverted => "board poses inverted",
            M::SetupExchanged => "eye-in-hand taken for eye-to-hand, or back",
            M::EulerOrder => "Euler order or sense",
            M::VectorAsEuler => "rotation vector read as Euler angles",
            M::EulerAsVector => "Euler angles read as rotation vector",
            M::QuaternionOrder => "quaternion order",
            M::DegreesRadians => "degrees and radians",
            M::MillimetresMetres => "millimetres and metres",
            M::RotationsTransposed => "rotations transposed",
            M::AxisMirrored => "one axis of the positions mirrored",
            M::BaseLeftHanded => "robot base left-handed",
            M::SquareSizeFar => "square size 6 to 15 % wrong",
            M::SquareSizeNear => "square size 2 to 4 % wrong",
            M::OrderShifted => "order shifted",
            M::OrderReversed => "order reversed",
            M::PicturesExchanged => "two pictures exchanged",
            M::RobotPoseFrozen => "robot pose frozen",
            M::CameraStill => "picture stored twice",
            M::CaptureRepeated => "capture repeated",
            M::TargetMoved => "target moved in mid-session",
            M::CameraMoved => "camera moved in mid-session",
            M::BothInverted => "robot and board poses inverted",
            M::HalfPixel => "half a pixel of offset",
        }
    }

    /// Whether so many captures tell it: a wrong one needs four right ones and a majority against
    /// it, and a board that moved is told by two captures that agree on where it went.
    pub fn tellable(self, captures: usize) -> Tellable {
        use Tellable::{Alone, AmongOthers, Nothing};
        match self {
            M::None | M::BothInverted | M::HalfPixel => Nothing,
            M::RobotInverted | M::BoardInverted | M::SetupExchanged | M::SquareSizeNear => {
                AmongOthers
            }
            M::PicturesExchanged | M::TargetMoved | M::CameraMoved if captures < 7 => Nothing,
            M::OrderShifted | M::OrderReversed if captures < 5 => Nothing,
            _ => Alone,
        }
    }
}

/// How `check` answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The mistake, alone.
    Named,
    /// The mistake, among others that fit alike.
    AmongOthers,
    /// Something is wrong, without naming it.
    Unexplained,
    /// Nothing is wrong.
    Unnoticed,
    /// Another mistake, which is called so.
    Wrong(&'static str),
}

/// A dataset that is about to be written.
struct Case {
    setup: Setup,
    notation: Notation,
    units: Units,
    /// As the robot says, base_from_flange.
    robot: Vec<Iso>,
    session: Session,
    /// What is written of the board, if no corners are.
    board: Option<Vec<Iso>>,
    square_mm: f64,
    stored_inverted: bool,
    declared: Declared,
}

/// What the manifest says; the truth where it says nothing else.
#[derive(Default)]
struct Declared {
    setup: Option<Setup>,
    notation: Option<Notation>,
    units: Option<Units>,
    robot_direction: bool,
    board_direction: bool,
    square_mm: Option<f64>,
    pixel_origin_corner: bool,
}

/// Codes that say that something is wrong, but not what.
const NAMES_NOTHING: [&str; 3] = ["captures-disagree", "no-clear-majority", "rejected"];

/// Plants a mistake in a cell with so many captures and asks for it.
pub fn ask(mistake: Mistake, seed: u64, captures: usize, folder: &Path) -> Outcome {
    let case = planted(mistake, seed, captures);
    let manifest = case.write(folder);
    let found = checkup::check(&manifest, folder, &|_, _| {});
    let Ok(found) = found else { return Outcome::Unexplained };
    let is_right = |e: &Explanation| case.is_right(mistake, e, folder);
    let first = &found.explanations[..found.alike.min(found.explanations.len())];
    match first {
        [] if found.ok => Outcome::Unnoticed,
        [] => Outcome::Unexplained,
        [only] if NAMES_NOTHING.contains(&only.code) => Outcome::Unexplained,
        [only] if is_right(only) => Outcome::Named,
        [other] => Outcome::Wrong(other.code),
        several if several.iter().any(is_right) => Outcome::AmongOthers,
        [other, ..] => Outcome::Wrong(other.code),
    }
}

fn cell(seed: u64, captures: usize) -> (Setup, Session) {
    let setup = if seed.is_multiple_of(2) { Setup::EyeInHand } else { Setup::EyeToHand };
    let cell = Cell { captures, touches: 0, placements: 0, ..Cell::new(setup, seed) };
    (setup, cell.session(seed + 1000).expect("a usual cell").0)
}

fn euler(random: &mut Random) -> Notation {
    const AXES: [&str; 12] =
        ["xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"];
    let axes = AXES[random.bits() as usize % AXES.len()];
    let sense = if random.bits().is_multiple_of(2) { "intrinsic" } else { "extrinsic" };
    named(&format!("euler-{axes}-{sense}"))
}

fn named(name: &str) -> Notation {
    Notation::named(name).expect("a notation")
}

fn planted(mistake: Mistake, seed: u64, n: usize) -> Case {
    let (setup, session) = cell(seed, n);
    let mut random = Random::new(seed.wrapping_mul(7919).wrapping_add(mistake as u64));
    let robot = session.observations.iter().map(|o| *o.base_from_flange.iso()).collect();
    let notation = match (mistake, random.bits() % 4) {
        (M::QuaternionOrder, k) => named(["quaternion-xyzw", "quaternion-wxyz"][k as usize % 2]),
        (M::VectorAsEuler, _) => named("rotation-vector"),
        (M::EulerOrder | M::EulerAsVector, _) => euler(&mut random),
        (M::DegreesRadians, 0 | 1) | (_, 0) => named("rotation-vector"),
        (M::DegreesRadians, _) | (_, 1 | 2) => euler(&mut random),
        _ => named("matrix4x4"),
    };
    let any = |random: &mut Random, n: usize| random.bits() as usize % n;
    let length = [LengthUnit::Metre, LengthUnit::Millimetre][any(&mut random, 2)];
    let angle = [AngleUnit::Radian, AngleUnit::Degree][any(&mut random, 2)];
    let bare = match mistake {
        M::BoardInverted | M::BothInverted => true,
        M::SquareSizeFar | M::SquareSizeNear | M::HalfPixel => false,
        _ => any(&mut random, 3) == 0,
    };
    let board = |s: &Session| -> Vec<Iso> {
        s.observations.iter().map(|o| *o.candidates[0].camera_from_target.iso()).collect()
    };
    let mut case = Case {
        setup,
        notation,
        units: Units { length, angle },
        robot,
        board: bare.then(|| board(&session)),
        session,
        square_mm: 30.0,
        stored_inverted: any(&mut random, 4) == 0,
        declared: Declared::default(),
    };
    plant::plant(mistake, &mut case, &mut random);
    case
}

/// A CSV of numbers, a pose a line.
fn lines(notation: &Notation, units: Units, inverted: bool, poses: &[Iso]) -> String {
    let mut text = String::new();
    for pose in poses {
        let pose = if inverted { pose.inverse() } else { *pose };
        let numbers: Vec<String> =
            notation.values(&pose, units).iter().map(|x| format!("{x:.9}")).collect();
        text += &(numbers.join(",") + "\n");
    }
    text
}

/// Answers to one mistake.
#[derive(Debug, Default, Clone)]
pub struct Row {
    /// Cases that can be told alone or among others, and those answered so.
    pub tellable: (usize, usize),
    /// Cases that cannot be told, and those in which nothing wrong was claimed.
    pub untellable: (usize, usize),
    /// Seeds and captures of the other cases, and what was answered.
    pub missed: Vec<(u64, usize, Outcome)>,
}

/// Fewest and most captures.
pub const CAPTURES: (usize, usize) = (4, 15);

/// Asks for a mistake in so many cells, of 4 to 15 captures.
pub fn row(mistake: Mistake, cases: u64, folder: &Path) -> Row {
    let mut row = Row::default();
    for seed in 0..cases {
        // five and twelve have no common factor: every number of captures comes
        let n = CAPTURES.0 + (seed as usize * 5) % (CAPTURES.1 - CAPTURES.0 + 1);
        let outcome = ask(mistake, seed, n, folder);
        let tellable = mistake.tellable(n);
        let good = match tellable {
            Tellable::Alone => outcome == Outcome::Named,
            Tellable::AmongOthers => matches!(outcome, Outcome::Named | Outcome::AmongOthers),
            Tellable::Nothing if mistake == M::None => outcome == Outcome::Unnoticed,
            Tellable::Nothing => !matches!(outcome, Outcome::Wrong(_)),
        };
        let count = match tellable {
            Tellable::Nothing => &mut row.untellable,
            _ => &mut row.tellable,
        };
        count.0 += 1;
        count.1 += usize::from(good);
        if !good {
            row.missed.push((seed, n, outcome));
        }
    }
    row
}

impl Case {
    /// Writes the dataset; returns its manifest.
    fn write(&self, folder: &Path) -> PathBuf {
        fs::remove_dir_all(folder).ok();
        fs::create_dir_all(folder.join("corners")).expect("a folder for the cases");
        let file = |name: &str, text: String| {
            fs::write(folder.join(name), text).expect("a file of a case");
        };
        file("robot.csv", lines(&self.notation, self.units, self.stored_inverted, &self.robot));
        match &self.board {
            Some(board) => {
                let units = Units { length: LengthUnit::Metre, angle: AngleUnit::Radian };
                file("board.csv", lines(&named("quaternion-xyzw"), units, false, board));
            }
            None => {
                for (k, o) in self.session.observations.iter().enumerate() {
                    let mut text = String::from("id,x,y\n");
                    for c in &o.corners {
                        let _ = writeln!(text, "{},{:?},{:?}", c.id, c.pixel.x, c.pixel.y);
                    }
                    file(&format!("corners/{:03}.csv", k + 1), text);
                }
            }
        }
        file(MANIFEST, self.manifest());
        folder.join(MANIFEST)
    }

    fn manifest(&self) -> String {
        let d = &self.declared;
        let setup = match d.setup.unwrap_or(self.setup) {
            Setup::EyeInHand => "eye-in-hand",
            Setup::EyeToHand => "eye-to-hand",
        };
        let units = d.units.unwrap_or(self.units);
        let robot = ["base_from_flange", "flange_from_base"];
        let board = ["camera_from_target", "target_from_camera"];
        let mut text = format!(
            "setup = \"{setup}\"\n[robot]\nposes = \"robot.csv\"\nnotation = \"{}\"\n\
             length_unit = \"{}\"\nangle_unit = \"{}\"\ndirection = \"{}\"\n",
            d.notation.as_ref().unwrap_or(&self.notation).name,
            units.length.name(),
            if units.angle == AngleUnit::Degree { "deg" } else { "rad" },
            robot[usize::from(self.stored_inverted != d.robot_direction)],
        );
        text += &match self.board {
            Some(_) => format!(
                "[board_poses]\nposes = \"board.csv\"\nnotation = \"quaternion-xyzw\"\n\
                 length_unit = \"m\"\ndirection = \"{}\"\n",
                board[usize::from(d.board_direction)]
            ),
            None => format!(
                "[target]\nkind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = {:?}\n\
                 [camera]\nwidth = 1920\nheight = 1200\nfx = 1800.0\nfy = 1800.0\ncx = 959.5\n\
                 cy = 599.5\ndistortion_model = \"none\"\n[corners]\nfiles = \"corners/*.csv\"\n\
                 pixel_origin = \"{}\"\n[noise]\nimage_px = 0.1\n",
                d.square_mm.unwrap_or(self.square_mm),
                if d.pixel_origin_corner { "corner" } else { "centre" }
            ),
        };
        text
    }

    fn is_right(&self, mistake: Mistake, e: &Explanation, folder: &Path) -> bool {
        match mistake {
            M::SquareSizeFar | M::SquareSizeNear => self.is_right_size(e),
            M::RotationsTransposed => e.message.contains("transposed"),
            M::AxisMirrored => e.message.contains("wrong sign") && !e.message.contains("angles"),
            M::BaseLeftHanded => e.message.contains("base frame is mirrored"),
            M::OrderShifted => e.code == "order" && e.message.contains("different orders"),
            M::OrderReversed => e.code == "order" && e.message.contains("opposite orders"),
            M::PicturesExchanged => e.code == "captures-exchanged" && e.captures.len() == 2,
            M::RobotPoseFrozen => e.code == "robot-pose-frozen" && e.captures.len() == 2,
            M::CameraStill => e.code == "camera-still" && e.captures.len() == 2,
            M::CaptureRepeated => e.code == "captures-repeated" && e.captures.len() == 2,
            M::TargetMoved => e.code == "target-moved",
            M::CameraMoved => e.code == "camera-moved",
            _ => !e.changes.is_empty() && self.is_truth_with(e, folder),
        }
    }

    /// The true size, rounded to the 0.1 micrometres of a manifest, inside the stated uncertainty.
    fn is_right_size(&self, e: &Explanation) -> bool {
        const MOST_ERROR: f64 = 0.02; // a quarter of the least deviation planted alone
        let size = e.changes.iter().find(|c| c.key == "square_mm");
        size.and_then(|c| c.value.parse::<f64>().ok())
            .is_some_and(|mm| (mm / self.square_mm - 1.0).abs() < MOST_ERROR)
    }

    /// Whether the corrected manifest reads what was measured.
    fn is_truth_with(&self, e: &Explanation, folder: &Path) -> bool {
        let manifest = folder.join("corrected.toml");
        fs::copy(folder.join(MANIFEST), &manifest).expect("a file of a case");
        if checkup::apply(&manifest, folder, e).is_err() {
            return false;
        }
        let read = Dataset::open(&manifest);
        fs::remove_file(folder.join("corrected.toml.bak")).ok();
        let Ok(read) = read else { return false };
        let near = |a: &Iso, b: &Iso| {
            a.rotation.angle_to(&b.rotation) < 1e-5
                && (a.translation.vector - b.translation.vector).norm() < 1e-5
        };
        let robot =
            read.captures.iter().zip(&self.robot).all(|(c, p)| near(c.base_from_flange.iso(), p));
        let board = self
            .board
            .iter()
            .flatten()
            .zip(&read.captures)
            .all(|(p, c)| c.camera_from_target.is_some_and(|read| near(read.iso(), p)));
        read.setup == self.setup && robot && board
    }
}
