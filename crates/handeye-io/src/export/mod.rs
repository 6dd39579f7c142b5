//! Results in the notations of other programs and of robots; conventions begin again here.

mod bodies;
mod middleware;
pub(crate) mod text;
mod vision;

pub use bodies::with_body;
use handeye::{Calibration, Setup};
use nalgebra::Isometry3;

use crate::robot::{self, Notation};

/// Where the camera sits, in the words of the program that shall read it.
#[derive(Debug, Clone)]
pub struct CameraPose<'a> {
    /// Name of the transform, such as `base_from_camera`.
    pub name: &'a str,
    /// `parent_from_child`, metres; the child is the camera.
    pub parent_from_child: Isometry3<f64>,
    /// Frame of the mount: the base or the flange.
    pub parent: &'a str,
    /// Frame of the camera.
    pub child: &'a str,
    /// Which of the two the mount is.
    pub setup: Setup,
}

/// Formats that name the frame of the child: of a body, the pose goes into no other.
const NAMING_FRAMES: [&str; 4] = ["ros2-launch", "urdf", "easy-handeye2", "moveit"];

/// Ends of names that ROS gives the bodies of cameras: x forward, not z as in the optical frame.
const BODY_ENDS: [&str; 2] = ["camera_link", "camera_base_link"];

impl<'a> CameraPose<'a> {
    /// Of a result; `None` where it determines none. Frames are called as asked, or as the result has them, or by what they
    /// are. A child that is fixed to the camera, such as `camera_link`, gets its own pose.
    ///
    /// # Errors
    /// A child that is called like the body of a camera, and it is not known how the optical frame lies in it.
    pub fn of(
        calibration: &'a Calibration,
        parent: Option<&'a str>,
        child: Option<&'a str>,
        formats: &[Format],
    ) -> Result<Option<Self>, String> {
        let Some(found) = calibration.hand_eye.mount_from_camera else { return Ok(None) };
        let frames = calibration.frames.as_ref();
        let optical = frames.and_then(|f| f.camera.as_deref());
        let mount = frames.and_then(|f| f.mount.as_deref());
        let bodies = frames.map_or(&[][..], |f| &f.bodies);
        let body = bodies.iter().find(|body| child == Some(&body.name));
        let child = child.or(optical).unwrap_or("camera");
        if body.is_none() && optical != Some(child) && BODY_ENDS.iter().any(|e| child.ends_with(e))
        {
            return Err(format!(
                "{child} is the name of a camera's body (x forward), and the result is the pose of its optical frame (z \
                 forward, x right): export it as {}, or say how the one lies in the other: \
                 --urdf the model that has both, or [[frames.bodies]] in handeye.toml (then calibrate again)",
                optical.unwrap_or("camera_optical_frame")
            ));
        }
        if body.is_some() && !formats.iter().all(Format::names_frames) {
            return Err(format!(
                "{child} is a frame fixed to the camera, and only {} say whose pose they hold; leave out --child for the others",
                NAMING_FRAMES.join(", ")
            ));
        }
        let from_body = body.map(|b| b.body_from_camera.iso().inverse());
        Ok(Some(Self {
            name: &calibration.name,
            parent_from_child: from_body.map_or(*found.iso(), |inverse| found.iso() * inverse),
            parent: parent.or(mount).unwrap_or(calibration.setup.mount()),
            child,
            setup: calibration.setup,
        }))
    }
}

/// What a result is written as.
#[derive(Debug, Clone)]
pub struct Format(Written);

#[derive(Debug, Clone)]
enum Written {
    /// As one of [`PROGRAMS`] reads it.
    Program(&'static Program),
    /// In a robot's or a generic notation.
    Robot(Notation),
}

/// What another program reads.
#[derive(Debug)]
struct Program {
    name: &'static str,
    /// What follows the name of the transform in the usual name of a file.
    ending: &'static str,
    content: Content,
}

#[derive(Debug)]
enum Content {
    Text(fn(&CameraPose) -> String),
    Bytes(fn(&CameraPose) -> Vec<u8>),
}

const fn text(name: &'static str, ending: &'static str, of: fn(&CameraPose) -> String) -> Program {
    Program { name, ending, content: Content::Text(of) }
}

/// In the order in which they are listed.
static PROGRAMS: [Program; 9] = [
    // a Python launch file with a static_transform_publisher
    text("ros2-launch", ".launch.py", middleware::ros2_launch),
    // a fixed joint for URDF or xacro; rpy about the fixed axes x, y, z
    text("urdf", ".urdf.xacro", middleware::urdf),
    // easy_handeye2's `.calib`
    text("easy-handeye2", ".calib", middleware::easy_handeye),
    // moveit_calibration's ROS 1 launch file
    text("moveit", ".launch", middleware::moveit),
    // OpenCV's FileStorage in YAML, metres
    text("opencv-yaml", "_opencv.yaml", vision::opencv),
    // Zivid's 4x4 YAML, millimetres
    text("zivid-yaml", "_zivid.yaml", vision::zivid),
    // HALCON's pose `.dat`: the camera is the parent, metres and degrees
    text("halcon", ".dat", vision::halcon),
    // NumPy's `.npy`, a 4x4 matrix, metres
    Program { name: "npy", ending: ".npy", content: Content::Bytes(npy) },
    // four lines of four numbers, metres; a generic notation too, and listed among those
    text("matrix4x4", ".txt", text::matrix),
];

impl Format {
    /// Names of all formats.
    pub fn names() -> Vec<&'static str> {
        let robots: Vec<_> = robot::names().collect();
        let programs = PROGRAMS.iter().map(|p| p.name).filter(|name| !robots.contains(name));
        programs.chain(robots.iter().copied()).collect()
    }

    /// Whether a file of it names the camera's frame, so that a body's pose is not taken for that of the optical frame.
    pub fn names_frames(&self) -> bool {
        matches!(&self.0, Written::Program(program) if NAMING_FRAMES.contains(&program.name))
    }

    /// The format of a name; `Err` says which there are.
    pub fn named(name: &str) -> Result<Format, String> {
        if let Some(program) = PROGRAMS.iter().find(|p| p.name.eq_ignore_ascii_case(name)) {
            return Ok(Format(Written::Program(program)));
        }
        let notation = Notation::named(name);
        notation
            .map(|notation| Format(Written::Robot(notation)))
            .map_err(|_| format!("there are {}", Self::names().join(", ")))
    }

    /// The usual name of a file with this content.
    pub fn file_name(&self, pose: &str) -> String {
        match &self.0 {
            Written::Program(program) => format!("{pose}{}", program.ending),
            Written::Robot(notation) => format!("{pose}_{}.txt", notation.name),
        }
    }
}

/// The content of a file of the given format.
pub fn render(pose: &CameraPose, format: &Format) -> Vec<u8> {
    match &format.0 {
        Written::Robot(notation) => text::robot(pose, notation).into_bytes(),
        Written::Program(Program { content: Content::Text(of), .. }) => of(pose).into_bytes(),
        Written::Program(Program { content: Content::Bytes(of), .. }) => of(pose),
    }
}

fn npy(pose: &CameraPose) -> Vec<u8> {
    crate::npy::encode(&[4, 4], &row_major(&pose.parent_from_child))
}

/// The sixteen numbers of the homogeneous matrix.
fn row_major(pose: &Isometry3<f64>) -> Vec<f64> {
    pose.to_homogeneous().transpose().iter().copied().collect()
}

/// Digits after the point: a nanometre, and what makes less of a difference at a metre's distance.
/// More would show rounding errors of the arithmetic, and no reader needs them.
const METRES: i32 = 9;
const MILLIMETRES: i32 = 6;
/// Of quaternions, matrices and angles in radians.
const TURNS: i32 = 12;
const DEGREES: i32 = 10;

/// A number that every reader takes for the same double: `1.0e-7`, never `1e-7` (text in YAML 1.1).
fn number(x: f64, decimals: i32) -> String {
    let scale = 10f64.powi(decimals);
    // the zero makes -0.0 positive
    let text = format!("{:?}", (x * scale).round() / scale + 0.0);
    let Some((mantissa, exponent)) = text.split_once('e') else { return text };
    let point = if mantissa.contains('.') { "" } else { ".0" };
    let sign = if exponent.starts_with('-') { "" } else { "+" };
    format!("{mantissa}{point}e{sign}{exponent}")
}

fn numbers(values: &[f64], decimals: i32, separator: &str) -> String {
    values.iter().map(|v| number(*v, decimals)).collect::<Vec<_>>().join(separator)
}

/// A line of a homogeneous matrix: three numbers of the rotation, and one of the position.
fn matrix_row(row: &[f64], decimals: i32, separator: &str) -> String {
    let Some((position, turn)) = row.split_last() else { return String::new() };
    numbers(turn, TURNS, separator) + separator + &number(*position, decimals)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use nalgebra::{Translation3, UnitQuaternion, Vector3};

    pub(crate) fn example() -> CameraPose<'static> {
        CameraPose {
            name: "base_from_camera",
            parent_from_child: Isometry3::from_parts(
                Translation3::new(0.5, -0.25, 1e-7),
                UnitQuaternion::new(Vector3::new(0.1, -2.0, 0.7)),
            ),
            parent: "base_link",
            child: "camera_optical_frame",
            setup: Setup::EyeToHand,
        }
    }

    #[test]
    fn numbers_are_doubles_for_every_reader() {
        for (x, text) in [
            (1e-7, "1.0e-7"),
            (2.5e-9, "2.5e-9"),
            (1e20, "1.0e+20"),
            (-0.0, "0.0"),
            (-1e-17, "0.0"),
            (1.0, "1.0"),
        ] {
            assert_eq!(number(x, TURNS), text);
        }
    }

    #[test]
    fn no_text_shows_the_rounding_errors_of_doubles() {
        let turn = UnitQuaternion::new(Vector3::new(0.1, -2.0, 0.7));
        let place = Translation3::new(0.1 + 0.2, -1.0 / 3.0, 1e-13);
        let pose =
            CameraPose { parent_from_child: Isometry3::from_parts(place, turn), ..example() };
        for name in Format::names().into_iter().filter(|name| *name != "npy") {
            let text = String::from_utf8(render(&pose, &Format::named(name).unwrap())).unwrap();
            let digit = |c: char| c.is_ascii_digit() || c == '.';
            let longest = text.split(|c| !digit(c)).map(|w| w.len()).max().unwrap();
            // "0." or "123.", and the digits behind
            assert!(longest <= 2 + TURNS as usize, "{name}: {text}");
        }
        let urdf = String::from_utf8(render(&pose, &Format::named("urdf").unwrap())).unwrap();
        assert!(urdf.contains("xyz=\"0.3 -0.333333333 0.0\""), "{urdf}");
    }

    #[test]
    fn every_format_has_a_name_and_content() {
        for name in Format::names() {
            let format = Format::named(name).unwrap();
            assert!(!render(&example(), &format).is_empty(), "{name}");
            assert!(format.file_name("x").starts_with('x'));
        }
        assert!(Format::named("word").unwrap_err().starts_with("there are ros2-launch,"));
    }
}
