//! Which images become captures: one of each place where the robot stood still, or many of a robot in motion.

use handeye::math::lie;
use nalgebra::Vector6;

use super::{
    robot::{At, Robot},
    survey::Shot,
};

/// An image to be written, and where the robot was.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Moment {
    pub(super) shot: Shot,
    pub(super) at: At,
}

/// For how long before an image (s) the robot must have been at rest, and after it: exposures take time, and stamps
/// may be late.
const BEFORE_S: f64 = 0.3;
const AFTER_S: f64 = 0.1;
/// What of that a recording must have at its very ends.
const LEAST_S: f64 = 0.2;
/// Scans farther than this from their image (s) may show something else.
const SAME_REST_S: f64 = 10.0;
/// Farthest that a robot at rest is from where it is at the image (rad, m).
const REST: (f64, f64) = (2e-4, 2e-4);
/// Images whose robot poses differ by less (rad, m) show the same place.
const SAME_PLACE: (f64, f64) = (2e-3, 1e-3);
/// Length of path (m) that counts as one rad of turn.
const METRES_PER_RAD: f64 = 0.3;

/// One image of every place where the robot stood still: the middle one.
pub(super) fn still(shots: &[Shot], robot: &Robot) -> Vec<Moment> {
    let times = robot.times();
    let resting = |shot: &Shot| Some(Moment { shot: *shot, at: at_rest(shot, robot, &times)? });
    places(shots.iter().filter_map(resting))
}

/// Of images of the same place, one after the other, the middle one.
fn places(moments: impl IntoIterator<Item = Moment>) -> Vec<Moment> {
    let mut places: Vec<Vec<Moment>> = vec![];
    for moment in moments {
        match places.last_mut().filter(|place| near(&place[0].at, &moment.at, SAME_PLACE)) {
            Some(place) => place.push(moment),
            None => places.push(vec![moment]),
        }
    }
    places.into_iter().map(|place| place[place.len() / 2].clone()).collect()
}

/// Where the robot was at an image, if it was at rest.
fn at_rest(shot: &Shot, robot: &Robot, times: &[f64]) -> Option<At> {
    let here = robot.at(shot.time_s)?;
    // where the recording begins or ends, what there is of it counts
    let (begin, end) = (*times.first()?, *times.last()?);
    let (from, to) = ((shot.time_s - BEFORE_S).max(begin), (shot.time_s + AFTER_S).min(end));
    if to - from < LEAST_S {
        return None;
    }
    let rests = |t: f64| robot.at(t).is_some_and(|there| near(&here, &there, REST));
    let within = times[times.partition_point(|t| *t < from)..].iter().take_while(|t| **t <= to);
    (rests(from) && rests(to) && within.copied().all(rests)).then_some(here)
}

/// The scan nearest in time to an image of a robot that stood still, of those that it was at rest for at the same place.
pub(super) fn scan_beside(picture: &Moment, scans: &[Shot], robot: &Robot) -> Option<Shot> {
    let times = robot.times();
    let away = |s: &Shot| (s.time_s - picture.shot.time_s).abs();
    let mut near_in_time: Vec<&Shot> = scans.iter().filter(|s| away(s) <= SAME_REST_S).collect();
    near_in_time.sort_by(|a, b| away(a).total_cmp(&away(b)));
    let same =
        |s: &&&Shot| at_rest(s, robot, &times).is_some_and(|at| near(&picture.at, &at, REST));
    near_in_time.iter().find(same).map(|s| **s)
}

/// Images of a robot that stood still as somebody says, whose poses come too seldom to see that: of each the nearest pose.
pub(super) fn triggered(shots: &[Shot], robot: &Robot) -> Vec<Moment> {
    let one = |shot: &Shot| Some(Moment { shot: *shot, at: robot.nearest(shot.time_s)? });
    let mut all: Vec<Moment> = shots.iter().filter_map(one).collect();
    all.dedup_by(|b, a| near(&a.at, &b.at, SAME_PLACE));
    all
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

/// Up to `most` images, spread evenly over the robot's path, of each stretch the one where it is slowest.
pub(super) fn moving(shots: &[Shot], robot: &Robot, most: usize) -> Vec<Moment> {
    let known =
        shots.iter().filter_map(|shot| Some(Moment { shot: *shot, at: robot.at(shot.time_s)? }));
    // many images of one place tell no more than one: of a rest the middle one counts
    let known = places(known);
    if known.len() <= most {
        return known;
    }
    let length = |(turn, shift): (f64, f64)| turn + shift / METRES_PER_RAD;
    let mut path = vec![0.0];
    for pair in known.windows(2) {
        path.push(path[path.len() - 1] + length(apart(&pair[0].at, &pair[1].at)));
    }
    let most = most.max(1);
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

/// How fast the flange moves at an image, rad/s.
fn speed(robot: &Robot, moment: &Moment) -> f64 {
    let at = |by: f64| robot.at(moment.shot.time_s + by);
    let (Some(before), Some(after)) = (at(-STEP_S), at(STEP_S)) else { return f64::INFINITY };
    let v: Vector6<f64> = before.base_from_flange.local(&after.base_from_flange) / (2.0 * STEP_S);
    lie::omega(&v).norm() + lie::nu(&v).norm() / METRES_PER_RAD
}

/// Step of the derivative, s.
const STEP_S: f64 = 0.02;
