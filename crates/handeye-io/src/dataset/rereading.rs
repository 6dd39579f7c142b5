//! The robot's numbers as they stand in the files, read in every other way that there is.

use std::path::Path;

use handeye::{Base, Flange, Pose, Tool, mistakes::REACH};
use nalgebra::{Isometry3, Translation3, Vector3};

use super::{
    Dataset,
    manifest::{Manifest, RobotDirection, RobotSpec, Source},
    poses::{self, Reading},
};
use crate::{
    error::{Error, Place},
    files,
    robot::{Notation, Rotation, Units},
    table::Record,
    units::{AngleUnit, LengthUnit},
};

/// Another meaning of the robot's numbers.
#[derive(Debug, Clone)]
pub struct Rereading {
    /// In words.
    pub words: String,
    /// The same but for the direction; empty where nothing else differs.
    pub words_without_direction: String,
    /// Keys of `[robot]` and their values that say so; none where a manifest cannot.
    pub changes: Vec<(&'static str, String)>,
    /// Names of the file's columns in the order in which they are read, where the new notation
    /// would not find them, or others, by their names; otherwise empty.
    pub columns: Vec<String>,
    /// Where the flange was in each capture.
    pub base_from_flange: Vec<Pose<Base, Flange>>,
}

/// No angle in radians is larger than one turn.
const ONE_TURN: f64 = 6.4;

/// How six or seven numbers, or a matrix, become a pose.
#[derive(Debug, Clone, PartialEq)]
struct Way {
    notation: Notation,
    units: Units,
    inverted: bool,
}

/// Every other reading of the robot's numbers in a dataset.
///
/// # Errors
/// As [`Dataset::open`].
pub fn rereadings(
    manifest: &Path,
    root: &Path,
    dataset: &Dataset,
) -> Result<Vec<Rereading>, Error> {
    let source = Source { path: manifest.to_path_buf(), text: files::text(manifest)? };
    let parsed = Manifest::parse(&source)?;
    let Some(spec) = &parsed.robot else { return Ok(vec![]) };
    let (reading, records) = poses::records_of_robot(spec, &source, root)?;
    let numbers: Vec<Vec<f64>> =
        records.iter().map(|r| reading.numbers(r)).collect::<Result<_, _>>()?;
    let flange_from_tool = poses::tool(spec, &source)?;
    let chosen: Option<Vec<&[f64]>> =
        dataset.captures.iter().map(|c| Some(numbers.get(c.robot_record)?.as_slice())).collect();
    let Some(chosen) = chosen else { return Ok(vec![]) };
    let inverted = spec.direction == Some(RobotDirection::FlangeFromBase);
    let mut all = match &reading {
        Reading::Notation(notation, units) => {
            let declared = Way { notation: notation.clone(), units: *units, inverted };
            let mut all = notations(&declared, &chosen, records.first(), flange_from_tool);
            all.extend(angles_first(&declared, &chosen, records.first(), flange_from_tool));
            all
        }
        Reading::Joints(..) => joints(spec, &reading, &chosen, flange_from_tool)?,
    };
    all.extend(mirrored(dataset));
    Ok(all)
}

fn notations(
    declared: &Way,
    numbers: &[&[f64]],
    record: Option<&Record>,
    flange_from_tool: Pose<Flange, Tool>,
) -> Vec<Rereading> {
    let ways = ways(declared);
    let reread = |way: &Way| {
        let base_from_flange: Option<Vec<_>> =
            numbers.iter().map(|n| pose(way, n, flange_from_tool)).collect();
        let base_from_flange = base_from_flange?;
        let as_turned = Way { inverted: declared.inverted, ..way.clone() };
        plausible(way, declared, numbers, &base_from_flange).then_some(Rereading {
            words: words(declared, way),
            words_without_direction: words(declared, &as_turned),
            changes: changes(declared, way),
            columns: record.map_or_else(Vec::new, |r| columns(declared, way, r)),
            base_from_flange,
        })
    };
    ways.iter().filter(|way| *way != declared).filter_map(reread).collect()
}

/// The angles written before the position: three numbers each, in the other order.
fn angles_first(
    declared: &Way,
    numbers: &[&[f64]],
    record: Option<&Record>,
    flange_from_tool: Pose<Flange, Tool>,
) -> Vec<Rereading> {
    if !matches!(declared.notation.rotation, Rotation::Euler(..) | Rotation::Vector) {
        return vec![];
    }
    let exchanged: Vec<Vec<f64>> = numbers.iter().map(|n| [&n[3..], &n[..3]].concat()).collect();
    let exchanged: Vec<&[f64]> = exchanged.iter().map(Vec::as_slice).collect();
    let same = |way: &Way| {
        way.notation.rotation == declared.notation.rotation && way.inverted == declared.inverted
    };
    let reread = |way: &Way| {
        let base_from_flange: Option<Vec<_>> =
            exchanged.iter().map(|n| pose(way, n, flange_from_tool)).collect();
        let base_from_flange = base_from_flange?;
        if !plausible(way, declared, &exchanged, &base_from_flange) {
            return None;
        }
        let others = words(declared, way).replacen("the robot poses are ", "; and they are ", 1);
        let words = format!(
            "the angles stand before the positions in the robot poses: their columns are exchanged{others}"
        );
        Some(Rereading {
            words_without_direction: words.clone(),
            words,
            changes: changes(declared, way),
            columns: record.map_or_else(Vec::new, |r| exchanged_columns(declared, r)),
            base_from_flange,
        })
    };
    ways(declared).iter().filter(|way| same(way)).filter_map(reread).collect()
}

/// The columns of six numbers, the last three first: by their names, or by their numbers from 1.
fn exchanged_columns(declared: &Way, record: &Record) -> Vec<String> {
    let named = declared.notation.names_in(record);
    let first = 1 + record.cells.len().saturating_sub(6);
    let own = named.unwrap_or_else(|| (first..first + 6).map(|k| k.to_string()).collect());
    [&own[3..], &own[..3]].concat()
}

fn pose(way: &Way, numbers: &[f64], tool: Pose<Flange, Tool>) -> Option<Pose<Base, Flange>> {
    let iso = way.notation.pose(numbers, way.units).ok()?;
    let iso = if way.inverted { iso.inverse() } else { iso };
    Some(Pose::<Base, Tool>::claim(iso) * tool.inverse())
}

fn plausible(way: &Way, declared: &Way, numbers: &[&[f64]], poses: &[Pose<Base, Flange>]) -> bool {
    let reach = poses.iter().map(|p| p.translation().norm()).fold(0.0, f64::max);
    let reached = way.units.length == declared.units.length || (REACH.0..REACH.1).contains(&reach);
    let angles = matches!(way.notation.rotation, Rotation::Euler(..) | Rotation::Vector);
    let largest = numbers.iter().flat_map(|n| &n[3..]).fold(0.0, |m: f64, v| m.max(v.abs()));
    reached && !(angles && way.units.angle == AngleUnit::Radian && largest > ONE_TURN)
}

/// Every way to read as many numbers.
fn ways(declared: &Way) -> Vec<Way> {
    let mut all = Vec::new();
    for notation in alternatives(&declared.notation) {
        let angles: &[AngleUnit] = match notation.rotation {
            Rotation::Euler(..) | Rotation::Vector => &[AngleUnit::Radian, AngleUnit::Degree],
            _ => &[declared.units.angle],
        };
        for &angle in angles {
            for length in [
                LengthUnit::Metre,
                LengthUnit::Millimetre,
                LengthUnit::Centimetre,
                LengthUnit::Inch,
            ] {
                let units = Units { length, angle };
                let way = |inverted| Way { notation: notation.clone(), units, inverted };
                all.extend([way(false), way(true)]);
            }
        }
    }
    all
}

/// Notations of as many numbers, each rotation once, the declared one under its own name.
fn alternatives(declared: &Notation) -> Vec<Notation> {
    let named = |name: &str| Notation::named(name).ok();
    let mut all = vec![declared.clone()];
    let others: Vec<Notation> = match declared.rotation {
        Rotation::Matrix => vec![],
        Rotation::QuaternionXyzw | Rotation::QuaternionWxyz => {
            ["quaternion-xyzw", "quaternion-wxyz"].into_iter().filter_map(named).collect()
        }
        Rotation::Vector | Rotation::Euler(..) => {
            let axes = [
                "xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy", "zxz", "zyz",
            ];
            let euler = axes
                .into_iter()
                .flat_map(|a| ["extrinsic", "intrinsic"].map(|s| format!("euler-{a}-{s}")));
            let names: Vec<String> =
                ["rotation-vector".to_owned()].into_iter().chain(euler).collect();
            names.iter().filter_map(|n| named(n)).collect()
        }
    };
    let others = others.into_iter().filter(|n| n.rotation != declared.rotation);
    all.extend(others.map(by_maker));
    all
}

/// The notation under its maker's name, where one maker alone writes so.
fn by_maker(notation: Notation) -> Notation {
    match notation.makers()[..] {
        [maker] => Notation::named(maker).unwrap_or(notation),
        _ => notation,
    }
}

/// A notation's name, and the makers who write so where there are several.
fn called(notation: &Notation) -> String {
    match &notation.makers()[..] {
        makers @ [_, .., last] if !makers.contains(&notation.name.as_str()) => {
            let first = makers[..makers.len() - 1].join(", ");
            format!("{} (that of {first} and {last})", notation.name)
        }
        _ => notation.name.clone(),
    }
}

fn direction(inverted: bool) -> &'static str {
    if inverted { "flange_from_base" } else { "base_from_flange" }
}

fn unit(angle: AngleUnit) -> &'static str {
    match angle {
        AngleUnit::Radian => "rad",
        AngleUnit::Degree => "deg",
    }
}

/// What differs from what is declared, as keys of `[robot]`.
fn changes(declared: &Way, way: &Way) -> Vec<(&'static str, String)> {
    let mut all = Vec::new();
    let renamed = declared.notation.rotation != way.notation.rotation;
    if renamed {
        all.push(("notation", way.notation.name.clone()));
    }
    if renamed || declared.units.length != way.units.length {
        all.push(("length_unit", way.units.length.name().into()));
    }
    let has_angles = matches!(way.notation.rotation, Rotation::Euler(..) | Rotation::Vector);
    if has_angles && (renamed || declared.units.angle != way.units.angle) {
        all.push(("angle_unit", unit(way.units.angle).into()));
    }
    if declared.inverted != way.inverted {
        all.push(("direction", direction(way.inverted).into()));
    }
    all
}

/// The columns as the declared notation reads them, where the other one would read them otherwise.
fn columns(declared: &Way, way: &Way, record: &Record) -> Vec<String> {
    let own = declared.notation.names_in(record);
    if way.notation.names_in(record) == own { vec![] } else { own.unwrap_or_default() }
}

fn words(declared: &Way, way: &Way) -> String {
    let mut parts = Vec::new();
    if declared.notation.rotation != way.notation.rotation {
        let new = called(&way.notation);
        parts.push(format!("written as {new}, not {}", declared.notation.name));
    }
    if declared.units.length != way.units.length {
        let (new, old) = (way.units.length.name(), declared.units.length.name());
        parts.push(format!("in {new}, not {old}"));
    }
    let has_angles = matches!(way.notation.rotation, Rotation::Euler(..) | Rotation::Vector);
    if has_angles && declared.units.angle != way.units.angle {
        let (new, old) = (unit(way.units.angle), unit(declared.units.angle));
        parts.push(format!("with angles in {new}, not {old}"));
    }
    if declared.inverted != way.inverted {
        parts.push(format!("{}, not {}", direction(way.inverted), direction(declared.inverted)));
    }
    if parts.is_empty() {
        return String::new();
    }
    format!("the robot poses are {}", parts.join(", and "))
}

/// Joint angles in the other unit, and the other direction.
fn joints(
    spec: &RobotSpec,
    reading: &Reading,
    numbers: &[&[f64]],
    flange_from_tool: Pose<Flange, Tool>,
) -> Result<Vec<Rereading>, Error> {
    let Reading::Joints(model, declared) = reading else { return Ok(vec![]) };
    let turned = spec.direction == Some(RobotDirection::FlangeFromBase);
    let mut all = Vec::new();
    for angle in [AngleUnit::Radian, AngleUnit::Degree] {
        for inverted in [false, true] {
            if (angle, inverted) == (*declared, turned) {
                continue;
            }
            let mut base_from_flange = Vec::new();
            for n in numbers {
                let iso = Reading::Joints(model.clone(), angle).pose(n, &Place::default())?;
                let iso = if inverted { iso.inverse() } else { iso };
                base_from_flange.push(Pose::<Base, Tool>::claim(iso) * flange_from_tool.inverse());
            }
            let (mut words, mut changes) = (vec![], vec![]);
            if angle != *declared {
                words.push(format!("the joint angles are in {}", unit(angle)));
                changes.push(("angle_unit", unit(angle).to_owned()));
            }
            let words_without_direction = words.join("");
            if inverted != turned {
                words.push(format!("the robot poses are {}", direction(inverted)));
                changes.push(("direction", direction(inverted).to_owned()));
            }
            let words = words.join(", and ");
            let columns = vec![];
            all.push(Rereading {
                words,
                words_without_direction,
                changes,
                columns,
                base_from_flange,
            });
        }
    }
    Ok(all)
}

/// Positions with an axis turned round, whole poses in a left-handed frame, rotations transposed:
/// no key of a manifest says so.
fn mirrored(dataset: &Dataset) -> Vec<Rereading> {
    let with = |words: &str, change: &dyn Fn(&Isometry3<f64>) -> Isometry3<f64>| Rereading {
        words: words.into(),
        words_without_direction: words.into(),
        changes: vec![],
        columns: vec![],
        base_from_flange: dataset
            .captures
            .iter()
            .map(|c| Pose::claim(change(c.base_from_flange.iso())))
            .collect(),
    };
    let sign = |words: &str, sign: Vector3<f64>| {
        with(words, &|iso| {
            let t = iso.translation.vector.component_mul(&sign);
            Isometry3::from_parts(Translation3::from(t), iso.rotation)
        })
    };
    let axis = |k: usize| {
        let mut signs = Vector3::repeat(1.0);
        signs[k] = -1.0;
        sign(&format!("{} of the robot positions has the wrong sign", ["x", "y", "z"][k]), signs)
    };
    let left_handed = "an axis of the robot's base frame is mirrored (x, y or z: the data cannot tell), or the \
         images are";
    let transposed = "the rotations of the robot poses turn the other way: they are transposed, \
                      or their angles have the wrong sign";
    (0..3)
        .map(axis)
        .chain([
            sign(left_handed, Vector3::repeat(-1.0)),
            with(transposed, &|iso| Isometry3::from_parts(iso.translation, iso.rotation.inverse())),
        ])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_named_where_another_notation_would_look_for_others() {
        let record = |names: &[&str]| Record {
            names: names.iter().map(|n| (*n).to_owned()).collect(),
            cells: vec![],
            by_header: true,
            id: None,
            place: Place::default(),
        };
        let way = |name: &str| {
            let notation = Notation::named(name).unwrap();
            Way { units: notation.own_units(), notation, inverted: false }
        };
        let of =
            |from: &str, to: &str, names: &[&str]| columns(&way(from), &way(to), &record(names));
        let angles = ["capture", "X", "Y", "Z", "A", "B", "C"];
        assert_eq!(of("kuka", "rotation-vector", &angles), angles[1..]);
        assert!(of("kuka", "kuka", &angles).is_empty());
        // found by their names in either order, so the names must not decide
        let parts = ["x", "y", "z", "qx", "qy", "qz", "qw"];
        assert_eq!(of("quaternion-xyzw", "quaternion-wxyz", &parts), parts);
        assert!(of("quaternion-xyzw", "quaternion-wxyz", &[]).is_empty());
    }

    #[test]
    fn makers_are_named_where_they_are_known() {
        let way = |name: &str| {
            let notation = Notation::named(name).unwrap();
            Way { units: notation.own_units(), notation, inverted: false }
        };
        let told = |declared: &str, rotation: &str| {
            let declared = way(declared);
            let rotation = Notation::named(rotation).unwrap().rotation;
            let all = ways(&declared);
            let found = all.iter().find(|w| {
                w.notation.rotation == rotation && w.units == declared.units && !w.inverted
            });
            let found = found.unwrap();
            (words(&declared, found), changes(&declared, found)[0].1.clone())
        };
        let (words, notation) = told("fanuc", "kuka");
        assert_eq!(words, "the robot poses are written as kuka, not fanuc");
        assert_eq!(notation, "kuka");
        let (words, notation) = told("kuka", "denso");
        let expected =
            "written as euler-xyz-extrinsic (that of fanuc, yaskawa and denso), not kuka";
        assert!(words.ends_with(expected), "{words}");
        assert_eq!(notation, "euler-xyz-extrinsic");
        assert_eq!(told("kuka", "ur").1, "ur");
    }

    #[test]
    fn six_numbers_are_read_as_a_vector_or_as_any_angles() {
        let notation = Notation::named("kuka").unwrap();
        let units = notation.own_units();
        let declared = Way { notation, units, inverted: false };
        let all = ways(&declared);
        assert_eq!(all.len(), 25 * 2 * 4 * 2);
        assert!(all.contains(&declared));
        let other = all.iter().find(|w| w.notation.name == "ur" && w.inverted).unwrap();
        let keys: Vec<&str> = changes(&declared, other).iter().map(|c| c.0).collect();
        assert_eq!(keys, ["notation", "length_unit", "angle_unit", "direction"]);
    }
}
