//! Corners of the board that the robot touched, and points that camera and robot both know.

use std::path::Path;

use handeye::{Base, Camera, Correspondence, Flange, Point, Pose, Setup, TargetModel, Touch};

use super::{
    manifest::{
        PointPairsSpec, PointsSpec, PoseTable, RobotDirection, RobotSpec, Source, TouchKind,
        TouchPoint, TouchesSpec, fields,
    },
    poses::{Named, Reading, Reported, records, tool},
};
use crate::{
    error::{Error, Place, malformed},
    files,
    table::{Cell, Layout, Record},
    units::{LengthUnit, farthest, too_far},
};

/// Name of the one board of the views, where touches name no placement.
pub const FIXED_BOARD: &str = "board";

/// What touches are read with.
pub(super) struct TouchContext<'a> {
    pub(super) target: Option<&'a TargetModel>,
    pub(super) robot: Option<&'a RobotSpec>,
    pub(super) placements: Vec<String>,
    pub(super) source: &'a Source,
    pub(super) root: &'a Path,
}

enum Position {
    Tip(LengthUnit),
    Flange(Box<Reading>, Reported, Point<Flange>),
}

pub(super) fn read(spec: &TouchesSpec, context: &TouchContext) -> Result<Vec<Touch>, Error> {
    let position = position(spec, context)?;
    let mut records: Vec<Record> = spec.points.iter().map(|p| inline(p, context.source)).collect();
    if let Some(file) = &spec.file {
        let layout = Layout { fields: fields(&spec.field), ..Layout::default() };
        records.extend(crate::table::records(&context.root.join(file), &layout)?);
    }
    if records.is_empty() {
        return Err(context
            .source
            .undeclared("touches.file", "which file, or [[touches.points]], holds the touches?"));
    }
    records.iter().map(|record| touch(record, &position, context)).collect()
}

fn position(spec: &TouchesSpec, context: &TouchContext) -> Result<Position, Error> {
    let source = context.source;
    let kind = spec.kind.ok_or_else(|| {
        source.undeclared("touches.kind", "are the values the \"tip\" in the base, the \"flange-pose\" at contact, or \"joints\"?")
    })?;
    if kind == TouchKind::Tip {
        let unit = spec.length_unit.ok_or_else(|| {
            source.undeclared(
                "touches.length_unit",
                "are the tip's coordinates in \"m\" or in \"mm\"?",
            )
        })?;
        return Ok(Position::Tip(unit));
    }
    let tip = spec.tip.as_ref().ok_or_else(|| {
        source.undeclared(
            "touches.tip",
            "where is the tool's tip on the flange? ([touches.tip] in_flange_mm = [x, y, z])",
        )
    })?;
    let robot = context.robot.map(|r| r.with_arm(source)).transpose()?.unwrap_or_default();
    // poses in the notation of [robot] are what its poses are; others are those of the flange
    let reported = match context.robot {
        Some(robot) if kind == TouchKind::FlangePose && spec.notation.is_none() => Reported {
            direction: robot.direction.unwrap_or(RobotDirection::BaseFromFlange),
            flange_from_tool: tool(robot, source)?,
        },
        _ => Reported::flange(),
    };
    let (at, table) = match kind {
        TouchKind::Joints => ("robot", PoseTable { notation: Some("joints".into()), ..robot }),
        _ if spec.notation.is_none() => ("robot", robot),
        _ => (
            "touches",
            PoseTable {
                notation: spec.notation.clone(),
                length_unit: spec.length_unit,
                angle_unit: spec.angle_unit,
                ..robot
            },
        ),
    };
    let table = PoseTable {
        length_unit: spec.length_unit.or(table.length_unit),
        angle_unit: spec.angle_unit.or(table.angle_unit),
        ..table
    };
    let [x, y, z] = tip.in_flange_mm.map(|t| t / 1000.0);
    let reading = Box::new(Reading::of(&table, at, source, context.root)?);
    Ok(Position::Flange(reading, reported, Point::new(x, y, z)))
}

/// A touch of the manifest as if it were a record of a file.
fn inline(point: &TouchPoint, source: &Source) -> Record {
    let number =
        |name: &str, value: Option<u32>| value.map(|v| (name.to_string(), Cell::Number(v.into())));
    let placement = point.placement.clone().map(|p| ("placement".to_string(), Cell::Text(p)));
    let labels = [
        placement,
        number("corner", point.corner),
        number("row", point.row),
        number("column", point.column),
    ];
    let values = point.values.iter().map(|v| (String::new(), Cell::Number(*v)));
    let (names, cells) = labels.into_iter().flatten().chain(values).unzip();
    Record { names, cells, by_header: false, id: None, place: source.place("touches.points") }
}

const LABELS: [&str; 6] = ["placement", "corner", "corner_id", "row", "column", "id"];

/// The record without the columns that say what was touched.
pub(crate) fn without_labels(record: &Record) -> Record {
    let name = |k: usize| record.names.get(k).cloned().unwrap_or_default();
    let is_label = |k: &usize| LABELS.contains(&name(*k).to_lowercase().as_str());
    let kept = (0..record.cells.len()).filter(|k| !is_label(k));
    let (names, cells): (Vec<String>, Vec<Cell>) =
        kept.map(|k| (name(k), record.cells[k].clone())).unzip();
    let named = names.iter().all(|n| !n.is_empty());
    Record { names: if named { names } else { vec![] }, cells, ..record.clone() }
}

fn touch(record: &Record, position: &Position, context: &TouchContext) -> Result<Touch, Error> {
    let values = without_labels(record);
    let (placement, corner) = (placement(record, context)?, corner(record, context)?);
    let (in_base, base_from_flange, joints) = match position {
        Position::Tip(unit) => (point(&values, *unit)?, None, vec![]),
        Position::Flange(reading, reported, tip_in_flange) => {
            let numbers = reading.numbers(&values)?;
            let written = reading.pose(&numbers, &record.place)?;
            let base_from_flange = reported.base_from_flange(written);
            let tip = base_from_flange * *tip_in_flange;
            (tip, Some(base_from_flange), reading.joints(&numbers))
        }
    };
    Ok(Touch { placement, corner, in_base, base_from_flange, joints })
}

fn point<F>(record: &Record, unit: LengthUnit) -> Result<Point<F>, Error> {
    let n = record.numbers(&[&["x", "x_mm"], &["y", "y_mm"], &["z", "z_mm"]], "a point")?;
    let [x, y, z] = [0, 1, 2].map(|k| unit.to_metres(n[k]));
    match farthest(&[x, y, z]) {
        Some(far) => {
            Err(record.refuse(too_far(far), "correct the number, or leave the record out"))
        }
        None => Ok(Point::new(x, y, z)),
    }
}

fn placement(record: &Record, context: &TouchContext) -> Result<String, Error> {
    let known = &context.placements;
    match (record.text_named(&["placement"]), &known[..]) {
        (Some(name), _) if known.contains(&name) || known.is_empty() => Ok(name),
        (Some(name), _) => Err(record.refuse(
            format!("there is no placement {name}"),
            format!("[[placements]] has {}", known.join(", ")),
        )),
        (None, []) => Ok(FIXED_BOARD.into()),
        (None, [only]) => Ok(only.clone()),
        (None, _) => {
            Err(record.refuse("does not say which placement was touched", "add a column placement"))
        }
    }
}

fn corner(record: &Record, context: &TouchContext) -> Result<u32, Error> {
    let number = |names: &[&str]| record.number_named(names);
    let corner =
        match (number(&["corner", "corner_id", "id"]), number(&["row"]), number(&["column"])) {
            (Some(corner), _, _) => corner,
            (None, Some(_), Some(_)) if context.target.is_none() => {
                return Err(record.refuse(
                    "names a corner by row and column, but no target is declared",
                    "declare [target], or name corners by their ids in a column corner",
                ));
            }
            (None, Some(row), Some(column)) => {
                let (columns, rows) = context.target.map(TargetModel::grid).unwrap_or_default();
                if row >= f64::from(rows) || column >= f64::from(columns) {
                    return Err(record.refuse(
                        format!(
                            "row {row}, column {column} are not on a board of {columns} x {rows}"
                        ),
                        if row < f64::from(columns) && column < f64::from(rows) {
                            "rows and columns count from 0; are row and column exchanged?"
                        } else {
                            "rows and columns count from 0; are they counted from 1?"
                        },
                    ));
                }
                // a fraction stays one, and is refused below
                let whole =
                    row.fract() == 0.0 && column.fract() == 0.0 && row >= 0.0 && column >= 0.0;
                let id = context.target.filter(|_| whole);
                let id = id.and_then(|target| target.id_at(column as u32, row as u32));
                id.map_or(row * f64::from(columns) + column, f64::from)
            }
            _ => {
                return Err(record.refuse(
                    "does not say which corner was touched",
                    "add a column corner, or row and column",
                ));
            }
        };
    let count = context.target.map_or(u32::MAX as usize, TargetModel::len);
    if corner < 0.0 || corner.fract() != 0.0 || corner >= count as f64 {
        let advice = if corner == count as f64 {
            "ids count from 0, row by row: these look counted from 1, so take one off each"
        } else {
            "ids count from 0, row by row: are they counted column by column, or on another board?"
        };
        return Err(record.refuse(format!("the target has no corner {corner}"), advice));
    }
    Ok(corner as u32)
}

/// Points that the camera measured and the robot knows, in the mount's frame.
pub(super) fn correspondences(
    spec: &PointPairsSpec,
    setup: Setup,
    robot: &[Named<Pose<Base, Flange>>],
    source: &Source,
    root: &Path,
) -> Result<Vec<Correspondence>, Error> {
    let in_camera: Vec<Point<Camera>> = points(&spec.camera, "point_pairs.camera", source, root)?;
    let in_base: Vec<Point<Base>> = points(&spec.robot, "point_pairs.robot", source, root)?;
    let place = || source.place("point_pairs");
    if in_camera.len() != in_base.len() {
        return Err(mismatch(
            place(),
            in_camera.len(),
            "points of the camera",
            in_base.len(),
            "points of the robot",
        ));
    }
    if setup == Setup::EyeInHand && robot.len() != in_base.len() {
        return Err(mismatch(
            place(),
            in_base.len(),
            "points",
            robot.len(),
            "robot poses ([robot] is needed for eye-in-hand)",
        ));
    }
    let pair = |(i, (in_camera, in_base)): (usize, (Point<Camera>, Point<Base>))| {
        let in_mount = match setup {
            Setup::EyeToHand => in_base.rename(),
            Setup::EyeInHand => (robot[i].value.inverse() * in_base).rename(),
        };
        Correspondence { in_camera, in_mount }
    };
    Ok(in_camera.into_iter().zip(in_base).enumerate().map(pair).collect())
}

fn points<F>(
    spec: &PointsSpec,
    at: &str,
    source: &Source,
    root: &Path,
) -> Result<Vec<Point<F>>, Error> {
    let unit = spec.length_unit.ok_or_else(|| {
        source
            .undeclared(&format!("{at}.length_unit"), "are the coordinates in \"m\" or in \"mm\"?")
    })?;
    let layout =
        Layout { fields: fields(&spec.field), columns: spec.columns.clone(), ..Layout::default() };
    let place = source.place(&format!("{at}.file"));
    if files::extension(Path::new(&spec.file)).is_empty() {
        return Err(malformed(
            place,
            format!("\"{}\" names no kind of file", spec.file),
            "CSV, TXT, JSON, YAML, NPY and NPZ can be read",
        ));
    }
    records(&spec.file, &layout, root, &place)?.iter().map(|r| point(r, unit)).collect()
}

pub(super) fn mismatch(
    place: Place,
    left: usize,
    left_name: &str,
    right: usize,
    right_name: &str,
) -> Error {
    Error::CountMismatch {
        place,
        left,
        left_name: left_name.into(),
        right,
        right_name: right_name.into(),
        advice: "select with rows = \"first..last\", complete the data, or pair by number with \
                 [captures] pairing = \"number\""
            .into(),
    }
}
