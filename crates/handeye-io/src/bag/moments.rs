//! Which pictures become captures: one of each place where the robot stood still, or many of a robot in motion.

use handeye::lie;
use nalgebra::Vector6;

use super::{
    robot::{At, Robot},
    survey::Shot,
};

/// A picture to be written, and where the robot was.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Moment {
    pub(super) shot: Shot,
    pub(super) at: At,
}

/// For how long before a picture (s) the robot must have been at rest, and after it: exposures take time, and stamps
/// may be late.
const BEFORE_S: f64 = 0.3;
const AFTER_S: f64 = 0.1;
/// Farthest that a robot at rest is from where it is at the picture (rad, m).
const REST: (f64, f64) = (2e-4, 2e-4);
/// Pictures whose robot poses differ by less (rad, m) show the same place.
const SAME_PLACE: (f64, f64) = (2e-3, 1e-3);
/// Length of path (m) that counts as one rad of turn.
const METRES_PER_RAD: f64 = 0.3;

/// One picture of every place where the robot stood still: the middle one.
pub(super) fn still(shots: &[Shot], robot: &Robot) -> Vec<Moment> {
    let times = robot.times();
    let mut places: Vec<Vec<Moment>> = vec![];
    for shot in shots {
        let Some(at) = at_rest(shot, robot, &times) else { continue };
        let moment = Moment { shot: *shot, at };
        match places.last_mut().filter(|place| near(&place[0].at, &moment.at, SAME_PLACE)) {
            Some(place) => place.push(moment),
            None => places.push(vec![moment]),
        }
    }
    places.into_iter().map(|place| place[place.len() / 2].clone()).collect()
}

/// Where the robot was at a picture, if it was at rest.
fn at_rest(shot: &Shot, robot: &Robot, times: &[f64]) -> Option<At> {
    let here = robot.at(shot.time_s)?;
    let (from, to) = (shot.time_s - BEFORE_S, shot.time_s + AFTER_S);
    let first = times.partition_point(|t| *t < from);
    // where the recording begins or ends, what there is of it counts
    let within = times[first..].iter().take_while(|t| **t <= to);
    let rests = |t: &f64| robot.at(*t).is_some_and(|there| near(&here, &there, REST));
    let mut any = false;
    let all = within.inspect(|_| any = true).all(rests);
    (all && any).then_some(here)
}

fn near(a: &At, b: &At, limit: (f64, f64)) -> bool {
    let (turn, shift) = apart(a, b);
    turn < limit.0 && shift < limit.1
}

/// By how much the flange turned (rad) and moved (m).
fn apart(a: &At, b: &At) -> (f64, f64) {
    let (a, b) = (a.base_from_flange.iso(), b.base_from_flange.iso());
    (lie::angle(&a.rotation, &b.rotation), (a.translation.vector - b.translation.vector).norm())
}

/// Up to `most` pictures, spread evenly over the robot's path, of each stretch the one where it is slowest.
pub(super) fn moving(shots: &[Shot], robot: &Robot, most: usize) -> Vec<Moment> {
    let known =
        shots.iter().filter_map(|shot| Some(Moment { shot: *shot, at: robot.at(shot.time_s)? }));
    let known: Vec<Moment> = known.collect();
    if known.len() <= most {
        return known;
    }
    let length = |(turn, shift): (f64, f64)| turn + shift / METRES_PER_RAD;
    let mut path = vec![0.0];
    for pair in known.windows(2) {
        path.push(path[path.len() - 1] + length(apart(&pair[0].at, &pair[1].at)));
    }
    let cell = path[path.len() - 1] / most as f64;
    let number = |k: usize| if cell > 0.0 { ((path[k] / cell) as usize).min(most - 1) } else { 0 };
    let speeds: Vec<f64> = known.iter().map(|m| speed(robot, m)).collect();
    let all: Vec<usize> = (0..known.len()).collect();
    let slowest = |c: &[usize]| {
        c.iter().copied().min_by(|i, j| speeds[*i].total_cmp(&speeds[*j]).then(i.cmp(j)))
    };
    all.chunk_by(|i, j| number(*i) == number(*j))
        .filter_map(slowest)
        .map(|k| known[k].clone())
        .collect()
}

/// How fast the flange moves at a picture, rad/s.
fn speed(robot: &Robot, moment: &Moment) -> f64 {
    let at = |by: f64| robot.at(moment.shot.time_s + by);
    let (Some(before), Some(after)) = (at(-STEP_S), at(STEP_S)) else { return f64::INFINITY };
    let v: Vector6<f64> = before.base_from_flange.local(&after.base_from_flange) / (2.0 * STEP_S);
    lie::omega(&v).norm() + lie::nu(&v).norm() / METRES_PER_RAD
}

/// Step of the derivative, s.
const STEP_S: f64 = 0.02;
