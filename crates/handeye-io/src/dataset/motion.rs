//! Captures of a robot that did not stop for them: its poses over time, and when each capture was taken.

use std::{collections::BTreeMap, path::Path};

use handeye::{Base, Flange, Motion, Pose, Stamped};

use super::{
    CaptureSource,
    manifest::{MotionSpec, Source},
    poses::{self, Named, TIME_NAMES},
};
use crate::{
    error::{Error, malformed},
    files,
    table::Layout,
};

/// The usual name of the file of times.
pub(crate) const TIMES: &str = "times.csv";

/// Reads the times, and gives every capture its own and the robot's pose that the clocks as they are say.
pub(super) fn of(
    spec: &MotionSpec,
    robot: &[Named<Pose<Base, Flange>>],
    captures: &mut [CaptureSource],
    source: &Source,
    root: &Path,
) -> Result<Motion, Error> {
    let joints = robot.iter().filter(|r| !r.joints.is_empty());
    let joints: Vec<_> = joints
        .filter_map(|r| Some(Stamped { time_s: r.time_s?, pose: r.joints.clone() }))
        .collect();
    let robot: Vec<Stamped<Pose<Base, Flange>>> =
        robot.iter().map(stamped).collect::<Result<_, _>>()?;
    let place = source.place("motion.times");
    let known = times(&spec.times, source, root)?;
    for capture in captures {
        let Some(time) = known.get(plain(&capture.id)) else {
            let what = format!("{} has no time of the capture {}", spec.times, capture.id);
            let advice =
                "give every capture a line: its name, without the ending, and its time in seconds";
            return Err(malformed(place, what, advice));
        };
        capture.time_s = Some(*time);
        if let Some(near) = nearest(&robot, *time) {
            capture.base_from_flange = near;
        }
    }
    Ok(Motion { robot, joints })
}

fn stamped(named: &Named<Pose<Base, Flange>>) -> Result<Stamped<Pose<Base, Flange>>, Error> {
    match named.time_s {
        Some(time_s) if time_s.is_finite() => Ok(Stamped { time_s, pose: named.value }),
        _ => Err(malformed(
            named.place.clone(),
            "the robot's pose has no time, and [motion] says that it moved",
            "name a column time_s, in seconds",
        )),
    }
}

/// The times of a table with the columns `image` and `time_s`.
fn times(file: &str, source: &Source, root: &Path) -> Result<BTreeMap<String, f64>, Error> {
    let records = poses::records(file, &Layout::default(), root, &source.place("motion.times"))?;
    let mut all = BTreeMap::new();
    for record in records {
        let time = record.number_named(&TIME_NAMES).filter(|t| t.is_finite());
        let (Some(time), Some(id)) = (time, &record.id) else {
            let what = "is no name of a capture with its time";
            return Err(record.refuse(what, "write the columns image,time_s, the time in seconds"));
        };
        if all.insert(plain(&files::stem(Path::new(id))).to_owned(), time).is_some() {
            let what = format!("gives a second time to the capture {id}");
            return Err(record.refuse(what, "keep one line for each capture"));
        }
    }
    Ok(all)
}

/// A name without the leading zeros that a spreadsheet may have taken from a number.
fn plain(name: &str) -> &str {
    let is_number = !name.is_empty() && name.bytes().all(|b| b.is_ascii_digit());
    if is_number { name.trim_start_matches('0') } else { name }
}

/// The robot's pose at the time nearest to this.
fn nearest(robot: &[Stamped<Pose<Base, Flange>>], time_s: f64) -> Option<Pose<Base, Flange>> {
    let away = |s: &&Stamped<Pose<Base, Flange>>| (s.time_s - time_s).abs();
    robot.iter().min_by(|a, b| away(a).total_cmp(&away(b))).map(|s| s.pose)
}
