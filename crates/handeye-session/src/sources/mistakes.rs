//! What people get wrong in a cell, and what happens to it: for sessions that must notice.

use handeye::{Base, Camera, Flange, HandEye, Pose, Setup, Target, TargetModel};
use handeye_io::{CellSettings, Writing};

/// What is not as it is declared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mistake {
    /// Poses are written in one notation and read in another.
    Notation {
        /// How the robot writes them.
        written: &'static str,
        /// As what the session reads them.
        read: &'static str,
    },
    /// Lengths of poses are read so many times too long: inches for millimetres.
    Lengths(f64),
    /// The robot says where the base is in the flange.
    Inverted,
    /// Poses are those of the standstill before.
    Behind,
    /// The board's squares are so many times larger than is said.
    Square(f64),
    /// The camera's focal length is so many times longer than is said.
    FocalLength(f64),
    /// The intrinsics are of images half as large.
    OtherResolution,
    /// The board has a column of corners more than is said.
    OtherBoard,
    /// Poses never change.
    Frozen,
    /// The camera is not where it is said to be: the robot carries the board, not the camera, or the other way round.
    OtherSetup,
    /// Images are mirrored.
    Mirrored,
}

impl Mistake {
    /// What is declared of a cell that is really so.
    pub fn declared(&self, real: CellSettings) -> CellSettings {
        match (self, &real.target) {
            (Mistake::Square(factor), &TargetModel::Checkerboard { columns, rows, square_mm }) => {
                let square_mm = square_mm / factor;
                let target = TargetModel::Checkerboard { columns, rows, square_mm };
                CellSettings { target, ..real }
            }
            (Mistake::FocalLength(factor), _) => {
                let intrinsics = real.intrinsics.map(|mut camera| {
                    camera.fx /= factor;
                    camera.fy /= factor;
                    camera
                });
                CellSettings { intrinsics, ..real }
            }
            (Mistake::OtherBoard, &TargetModel::Checkerboard { columns, rows, square_mm }) => {
                let target = TargetModel::Checkerboard { columns: columns - 1, rows, square_mm };
                CellSettings { target, ..real }
            }
            (Mistake::OtherResolution, _) => {
                let intrinsics = real.intrinsics.map(|camera| camera.resized(0.5));
                CellSettings { intrinsics, ..real }
            }
            (Mistake::Notation { read, .. }, _) => {
                CellSettings { notation: (*read).to_owned(), ..real }
            }
            (Mistake::OtherSetup, _) => {
                let setup = match real.setup {
                    Setup::EyeInHand => Setup::EyeToHand,
                    Setup::EyeToHand => Setup::EyeInHand,
                };
                CellSettings { setup, guess: None, ..real }
            }
            _ => real,
        }
    }

    /// What the robot reports of a pose, as the session reads it.
    pub fn reported(&self, real: &Pose<Base, Flange>) -> Pose<Base, Flange> {
        match self {
            Mistake::Notation { written, read } => read_as(real, written, read),
            Mistake::Lengths(factor) => scaled(real, *factor),
            Mistake::Inverted => Pose::claim(real.iso().inverse()),
            _ => *real,
        }
    }

    /// Where the robot goes that is sent to a pose as the session has it.
    pub fn commanded(&self, pose: &Pose<Base, Flange>) -> Pose<Base, Flange> {
        match self {
            Mistake::Notation { written, read } => read_as(pose, read, written),
            Mistake::Lengths(factor) => scaled(pose, 1.0 / factor),
            Mistake::Inverted => Pose::claim(pose.iso().inverse()),
            _ => *pose,
        }
    }
}

fn read_as(pose: &Pose<Base, Flange>, written: &str, read: &str) -> Pose<Base, Flange> {
    let through = |written: &str, read: &str| -> Result<_, String> {
        let numbers = Writing::of(written)?.numbers(pose);
        let text: Vec<String> = numbers.iter().map(|x| format!("{x:.9}")).collect();
        Writing::of(read)?.typed(&text.join(" "))
    };
    // a pose that cannot be read is none that a session sees
    through(written, read).unwrap_or(*pose)
}

fn scaled(pose: &Pose<Base, Flange>, factor: f64) -> Pose<Base, Flange> {
    Pose::from_parts(&pose.rotation(), pose.translation() * factor)
}

/// What happens in the middle of a session.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event {
    /// Somebody knocks against the camera.
    CameraMoved(Pose<Camera, Camera>),
    /// Somebody moves or turns the board.
    BoardMoved(Pose<Target, Target>),
}

impl Event {
    /// Where camera and board sit afterwards.
    pub fn after(&self, mut places: HandEye) -> HandEye {
        match self {
            Event::CameraMoved(by) => places.mount_from_camera = places.mount_from_camera * *by,
            Event::BoardMoved(by) => places.anchor_from_target = places.anchor_from_target * *by,
        }
        places
    }
}
