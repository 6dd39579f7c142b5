//! Poses of the robot and of the board, out of the tables that a manifest names.

use std::path::Path;

use handeye::{Base, Camera, Flange, Pose, Target, Tool, Warning, model::kinematics::Arm};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::{
    joints_beside::JointsBeside,
    manifest::{
        ArmSpec, BoardDirection, BoardPosesSpec, FileOr, PoseFrame, PoseTable, RobotDirection,
        RobotSpec, Source,
    },
};
use crate::{
    error::{Error, Place, malformed},
    files,
    robot::{ArmModel, Column, Notation, Quantity, Rotation, Units, Urdf, suspicious_values},
    table::{self, Layout, Record},
    units::{AngleUnit, farthest, too_far},
};

/// A pose and the name and place it has in its file.
#[derive(Debug, Clone)]
pub(super) struct Named<T> {
    pub(super) id: Option<String>,
    pub(super) place: Place,
    pub(super) value: T,
    /// Joint values behind the pose (rad, m); none where it was given as a pose.
    pub(super) joints: Vec<f64>,
    /// When it was (s), where the file says that.
    pub(super) time_s: Option<f64>,
}

/// Usual names of the column of times, in seconds.
pub(super) const TIME_NAMES: [&str; 5] = ["time_s", "time", "t", "timestamp", "stamp"];

/// The poses of a table, and what looked suspicious about them.
type Poses<T> = (Vec<Named<T>>, Vec<Warning>);

/// How the numbers of a table become a pose.
pub(super) enum Reading {
    Notation(Notation, Units),
    Joints(ArmModel, AngleUnit),
}

impl Reading {
    /// From the keys `notation`, `length_unit`, `angle_unit` and `dh` of the table `at`.
    pub(super) fn of(
        table: &PoseTable,
        at: &str,
        source: &Source,
        root: &Path,
    ) -> Result<Reading, Error> {
        let key = |name: &str| format!("{at}.{name}");
        let name = table.notation.as_deref().ok_or_else(|| {
            source.undeclared(
                &key("notation"),
                "how are the poses written? (ur, kuka, abb, matrix4x4, quaternion-xyzw, joints, ...)",
            )
        })?;
        if name == "joints" {
            return joints(table, at, source, root);
        }
        let notation = Notation::named(name).map_err(|known| {
            malformed(
                source.place(&key("notation")),
                format!("the notation \"{name}\" is not known"),
                known,
            )
        })?;
        let length = table.length_unit.or(notation.length_unit).ok_or_else(|| {
            let question = "are the positions in \"m\", \"mm\", \"cm\" or \"inch\"?";
            source.undeclared(&key("length_unit"), question)
        })?;
        let units = Units { length, angle: table.angle_unit.unwrap_or(notation.angle_unit) };
        Ok(Reading::Notation(notation, units))
    }

    /// The joint values (rad, m) among raw numbers; none where they are a pose.
    pub(super) fn joints(&self, numbers: &[f64]) -> Vec<f64> {
        match self {
            Reading::Notation(..) => vec![],
            Reading::Joints(model, unit) => model.in_si(numbers, *unit),
        }
    }

    /// The arm that these are the joint values of.
    pub(super) fn arm(&self) -> Option<&Arm> {
        match self {
            Reading::Notation(..) => None,
            Reading::Joints(model, _) => Some(&model.arm),
        }
    }

    fn is_matrix(&self) -> bool {
        matches!(self, Reading::Notation(n, _) if n.rotation == Rotation::Matrix)
    }

    /// The raw numbers of a record, in order.
    pub(super) fn numbers(&self, record: &Record) -> Result<Vec<f64>, Error> {
        match self {
            Reading::Notation(notation, _) => notation.numbers(record),
            Reading::Joints(model, _) => model.values(record),
        }
    }

    /// The pose of raw numbers; `a_from_b` is what the table's direction says.
    pub(super) fn pose(&self, numbers: &[f64], place: &Place) -> Result<Isometry3<f64>, Error> {
        let advice = "correct the file, the notation or its column order";
        let iso = match self {
            Reading::Notation(notation, units) => {
                notation.pose(numbers, *units).map_err(|what| {
                    match other_order(notation, numbers) {
                        Some((why, advice)) => malformed(place.clone(), why, advice),
                        None => malformed(place.clone(), what, advice),
                    }
                })?
            }
            Reading::Joints(model, unit) => *model.base_from_flange(numbers, *unit).iso(),
        };
        match farthest(iso.translation.vector.as_slice()) {
            Some(far) => Err(malformed(place.clone(), too_far(far), advice)),
            None => Ok(iso),
        }
    }
}

/// A quaternion's length, or a matrix's last row, is right within this.
const RIGHT: f64 = 1e-3;

/// The other order in which numbers that are no pose would be one: what it is, and what to do.
fn other_order(notation: &Notation, numbers: &[f64]) -> Option<(&'static str, &'static str)> {
    let length = |n: &[f64]| n.iter().map(|x| x * x).sum::<f64>().sqrt();
    match notation.rotation {
        Rotation::QuaternionXyzw | Rotation::QuaternionWxyz
            if numbers.len() == 7 && (length(&numbers[..4]) - 1.0).abs() < RIGHT =>
        {
            Some((
                "the rotation stands before the position: the first four numbers are a unit quaternion, the \
                 last four are none",
                "say which columns hold position and quaternion, in this order: columns = [5, 6, 7, 1, 2, 3, 4], \
                 counted on by one where the first column is a name",
            ))
        }
        Rotation::Matrix if numbers.len() == 16 => {
            let column = [numbers[3], numbers[7], numbers[11], numbers[15]];
            let is_last = |n: &[f64]| length(&[n[0], n[1], n[2], n[3] - 1.0]) < RIGHT;
            let is_transposed = is_last(&column) && !is_last(&numbers[12..]);
            is_transposed.then_some((
                "the matrix is transposed: 0 0 0 1 is its last column, not its last row",
                "write it row by row, or say the order of its numbers: columns = [1, 5, 9, 13, 2, 6, 10, 14, 3, \
                 7, 11, 15, 4, 8, 12, 16]",
            ))
        }
        _ => None,
    }
}

fn joints(table: &PoseTable, at: &str, source: &Source, root: &Path) -> Result<Reading, Error> {
    let place = source.place(&format!("{at}.dh"));
    let model = match &table.arm {
        Some(ArmSpec::Dh(FileOr::File(file))) => ArmModel::read(&root.join(file))?,
        Some(ArmSpec::Dh(FileOr::Inline(spec))) => ArmModel::from_spec(spec, &place)?,
        Some(ArmSpec::Urdf(spec)) => {
            ArmModel::of_urdf(&Urdf::read(&root.join(&spec.file), &spec.base, &spec.flange)?)
        }
        None => {
            let question = "which Denavit-Hartenberg parameters has the robot? (a JSON file, or [robot.dh]; or \
                            urdf = { file, base, flange })";
            return Err(source.undeclared(&format!("{at}.dh"), question));
        }
    };
    let unit = table.angle_unit.ok_or_else(|| {
        source.undeclared(
            &format!("{at}.angle_unit"),
            "are the joint angles in \"deg\" or in \"rad\"?",
        )
    })?;
    Ok(Reading::Joints(model, unit))
}

/// The records of a file, or one record of each file of a pattern.
pub(super) fn records(
    pattern: &str,
    layout: &Layout,
    root: &Path,
    place: &Place,
) -> Result<Vec<Record>, Error> {
    let paths = files::expand(root, pattern, place)?;
    if files::is_pattern(pattern) {
        return table::record_per_file(&paths, layout);
    }
    table::records(&paths[0], layout)
}

fn read(
    table: &PoseTable,
    at: &str,
    source: &Source,
    root: &Path,
) -> Result<Poses<Isometry3<f64>>, Error> {
    let reading = Reading::of(table, at, source, root)?;
    let place = source.place(&format!("{at}.poses"));
    let layout = table.layout(reading.is_matrix(), at, source)?;
    let records = records(&table.poses, &layout, root, &place)?;
    let numbers: Vec<Vec<f64>> =
        records.iter().map(|r| reading.numbers(r)).collect::<Result<_, _>>()?;
    let beside = match (&reading, &table.arm) {
        (Reading::Notation(..), Some(ArmSpec::Urdf(spec))) => {
            Some(JointsBeside::of(spec, (table.angle_unit, at), (source, root))?)
        }
        _ => None,
    };
    let pose = |(record, numbers): (Record, &Vec<f64>)| {
        let value = reading.pose(numbers, &record.place)?;
        let joints = match &beside {
            Some(beside) => beside.values(&record)?,
            None => reading.joints(numbers),
        };
        let time_s = record.number_named(&TIME_NAMES);
        Ok(Named { id: record.id, place: record.place, value, joints, time_s })
    };
    let poses = records.into_iter().zip(&numbers).map(pose).collect::<Result<_, Error>>()?;
    let warnings = match &reading {
        Reading::Notation(notation, units) => suspicious_values(&numbers, notation, *units, &place),
        Reading::Joints(..) => vec![],
    };
    Ok((poses, warnings))
}

/// The robot's poses as they stand in their files, and how they are read.
pub(super) fn records_of_robot(
    spec: &RobotSpec,
    source: &Source,
    root: &Path,
) -> Result<(Reading, Vec<Record>), Error> {
    let table = spec.with_arm(source)?;
    let reading = Reading::of(&table, "robot", source, root)?;
    let layout = table.layout(reading.is_matrix(), "robot", source)?;
    let records = records(&table.poses, &layout, root, &source.place("robot.poses"))?;
    Ok((reading, records))
}

/// What the poses of `[robot]` are.
pub(super) struct Reported {
    pub(super) direction: RobotDirection,
    pub(super) flange_from_tool: Pose<Flange, Tool>,
}

impl Reported {
    /// Poses of the flange in the base.
    pub(super) fn flange() -> Self {
        let direction = RobotDirection::BaseFromFlange;
        Self { direction, flange_from_tool: Pose::identity() }
    }

    /// The pose of the flange, from one as it is written.
    pub(super) fn base_from_flange(&self, written: Isometry3<f64>) -> Pose<Base, Flange> {
        let iso = match self.direction {
            RobotDirection::BaseFromFlange => written,
            RobotDirection::FlangeFromBase => written.inverse(),
        };
        Pose::<Base, Tool>::claim(iso) * self.flange_from_tool.inverse()
    }
}

/// What the robot reported, one per record.
pub(super) fn of_robot(
    spec: &RobotSpec,
    source: &Source,
    root: &Path,
) -> Result<Poses<Pose<Base, Flange>>, Error> {
    let direction = spec.direction.ok_or_else(|| {
        source.undeclared(
            "robot.direction",
            "do the poses take points of the flange into the base (\"base_from_flange\": where the \
             flange is, what controllers show), or the other way (\"flange_from_base\")?",
        )
    })?;
    let reported = Reported { direction, flange_from_tool: tool(spec, source)? };
    let (poses, warnings) = read(&spec.with_arm(source)?, "robot", source, root)?;
    let convert = |named: Named<Isometry3<f64>>| Named {
        value: reported.base_from_flange(named.value),
        id: named.id,
        place: named.place,
        joints: named.joints,
        time_s: named.time_s,
    };
    Ok((poses.into_iter().map(convert).collect(), warnings))
}

/// How the robot's poses are written; `None` where joint values stand for them.
pub(super) fn writing(
    spec: &RobotSpec,
    source: &Source,
    root: &Path,
) -> Result<Option<Writing>, Error> {
    let flange_from_tool = tool(spec, source)?;
    match Reading::of(&spec.with_arm(source)?, "robot", source, root)? {
        Reading::Joints(..) => Ok(None),
        Reading::Notation(notation, units) => {
            let inverted = spec.direction == Some(RobotDirection::FlangeFromBase);
            Ok(Some(Writing { notation, units, inverted, flange_from_tool }))
        }
    }
}

/// How a robot's poses are written.
#[derive(Debug, Clone)]
pub struct Writing {
    notation: Notation,
    units: Units,
    inverted: bool,
    flange_from_tool: Pose<Flange, Tool>,
}

impl Writing {
    /// Poses of the flange in the base in a notation of this name, in the maker's units.
    ///
    /// # Errors
    /// Which names there are.
    pub fn of(name: &str) -> Result<Writing, String> {
        let notation = Notation::named(name)?;
        let units = notation.own_units();
        Ok(Writing { notation, units, inverted: false, flange_from_tool: Pose::identity() })
    }

    /// The names of a pose's numbers, in order.
    pub fn names(&self) -> Vec<&'static str> {
        self.notation.columns.iter().filter_map(|c| c.names.first().copied()).collect()
    }

    /// Their units, in order; empty for numbers without one.
    pub fn units(&self) -> Vec<&'static str> {
        let unit = |column: &Column| match column.quantity {
            Quantity::Length => self.units.length.name(),
            Quantity::Angle if self.units.angle == AngleUnit::Degree => "°",
            Quantity::Angle => "rad",
            Quantity::Plain => "",
        };
        self.notation.columns.iter().map(unit).collect()
    }

    /// A pose of the flange as it is typed from a pendant.
    ///
    /// # Errors
    /// What was read instead.
    pub fn typed(&self, text: &str) -> Result<Pose<Base, Flange>, String> {
        self.pose(&self.typed_numbers(text)?)
    }

    /// The numbers of a pose that is typed, in order.
    ///
    /// # Errors
    /// What was read instead.
    pub fn typed_numbers(&self, text: &str) -> Result<Vec<f64>, String> {
        self.notation.typed(text)
    }

    /// The pose of the flange that has these numbers.
    ///
    /// # Errors
    /// Numbers of no pose.
    pub fn pose(&self, values: &[f64]) -> Result<Pose<Base, Flange>, String> {
        let count = self.notation.columns.len();
        if values.len() != count {
            let name = &self.notation.name;
            return Err(format!("{name} has {count} numbers, these are {}", values.len()));
        }
        let written = self.notation.pose(values, self.units)?;
        if let Some(far) = farthest(written.translation.vector.as_slice()) {
            let unit = self.units.length.name();
            return Err(format!(
                "{far:.0} m is farther than any robot reaches: lengths of {} are in {unit}",
                self.notation.name
            ));
        }
        let written = if self.inverted { written.inverse() } else { written };
        let base_from_tool: Pose<Base, Tool> = Pose::claim(written);
        Ok(base_from_tool * self.flange_from_tool.inverse())
    }

    /// A pose of the flange as numbers, in order.
    pub fn numbers(&self, base_from_flange: &Pose<Base, Flange>) -> Vec<f64> {
        let written = *(*base_from_flange * self.flange_from_tool).iso();
        let written = if self.inverted { written.inverse() } else { written };
        self.notation.values(&written, self.units)
    }

    /// A table with a line for each pose, under the names of columns; it is read as it was written.
    pub fn table<'a>(
        &self,
        poses: impl IntoIterator<Item = (&'a str, &'a Pose<Base, Flange>)>,
    ) -> String {
        let mut text = format!("id,{}\n", self.names().join(","));
        for (id, pose) in poses {
            let numbers = self.numbers(pose).into_iter().map(|x| format!("{x:.9}"));
            text += &format!("{id},{}\n", numbers.collect::<Vec<_>>().join(","));
        }
        text
    }
}

/// The arm, where the robot's poses are those of its flange by its own joints, or a URDF is given beside them.
pub(super) fn arm(spec: &RobotSpec, source: &Source, root: &Path) -> Result<Option<Arm>, Error> {
    if !by_joints(spec) {
        return Ok(urdf(spec, root)?.map(|urdf| urdf.arm().clone()));
    }
    let table = spec.with_arm(source)?;
    Ok(Reading::of(&table, "robot", source, root)?.arm().cloned())
}

/// The file in which that arm is described, where it is a URDF.
pub(super) fn urdf(spec: &RobotSpec, root: &Path) -> Result<Option<Urdf>, Error> {
    let is_of_flange = by_joints(spec) || !has_joints_for_poses(spec);
    let Some(urdf) = spec.urdf.as_ref().filter(|_| is_of_flange) else { return Ok(None) };
    Urdf::read(&root.join(&urdf.file), &urdf.base, &urdf.flange).map(Some)
}

fn by_joints(spec: &RobotSpec) -> bool {
    spec.direction == Some(RobotDirection::BaseFromFlange)
        && spec.frame != Some(PoseFrame::Tool)
        && has_joints_for_poses(spec)
}

fn has_joints_for_poses(spec: &RobotSpec) -> bool {
    spec.notation.as_deref() == Some("joints")
}

/// The tool whose poses are recorded; the flange itself unless the manifest says otherwise.
pub(super) fn tool(spec: &RobotSpec, source: &Source) -> Result<Pose<Flange, Tool>, Error> {
    if spec.frame.is_none() && source.waits_for("frame") {
        let question = "are these the poses of the \"flange\", or of the active \"tool\"?";
        return Err(source.undeclared("robot.frame", question));
    }
    match (spec.frame.unwrap_or_default(), &spec.tool) {
        (PoseFrame::Flange, None) => Ok(Pose::identity()),
        (PoseFrame::Flange, Some(_)) => Err(source.undeclared(
            "robot.frame",
            "[robot.tool] is given: are the poses those of the \"flange\" or of the \"tool\"?",
        )),
        (PoseFrame::Tool, None) => Err(source.undeclared(
            "robot.tool",
            "where is the tool on the flange? (translation_mm and rotation_xyzw)",
        )),
        (PoseFrame::Tool, Some(tool)) => {
            let [x, y, z, w] = tool.rotation_xyzw;
            let q = Quaternion::new(w, x, y, z);
            let finite = tool.translation_mm.iter().all(|t| t.is_finite());
            if !finite || !(0.999..=1.001).contains(&q.norm()) {
                let what = format!(
                    "the quaternion's length is {}, not 1, or a number is not finite",
                    q.norm()
                );
                return Err(malformed(source.place("robot.tool"), what, "correct the tool"));
            }
            let translation = Translation3::from(tool.translation_mm.map(|t| t / 1000.0));
            Ok(Pose::claim(Isometry3::from_parts(translation, UnitQuaternion::from_quaternion(q))))
        }
    }
}

/// Poses of the board that someone else's detector found.
pub(super) fn of_board(
    spec: &BoardPosesSpec,
    source: &Source,
    root: &Path,
) -> Result<Poses<Pose<Camera, Target>>, Error> {
    let (poses, warnings) = read(&spec.table(), "board_poses", source, root)?;
    let convert = |n: Named<Isometry3<f64>>| {
        let value = board_pose(n.value, spec, source)?;
        Ok(Named { value, id: n.id, place: n.place, joints: vec![], time_s: n.time_s })
    };
    Ok((poses.into_iter().map(convert).collect::<Result<_, Error>>()?, warnings))
}

/// A pose in the direction that [board_poses] declares.
pub(super) fn board_pose(
    iso: Isometry3<f64>,
    spec: &BoardPosesSpec,
    source: &Source,
) -> Result<Pose<Camera, Target>, Error> {
    match spec.direction {
        Some(BoardDirection::CameraFromTarget) => Ok(Pose::claim(iso)),
        Some(BoardDirection::TargetFromCamera) => Ok(Pose::claim(iso.inverse())),
        None => Err(source.undeclared(
            "board_poses.direction",
            "do the poses take points of the board into the camera (\"camera_from_target\", what \
             OpenCV's solvePnP gives), or the other way (\"target_from_camera\")?",
        )),
    }
}
