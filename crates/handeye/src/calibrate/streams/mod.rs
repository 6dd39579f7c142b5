//! Two streams of poses by two clocks: the offset of the clocks, and the calibration.
//!
//! `stream` (poses between samples, gaps) → `offset` (which offsets make robot and camera turn
//! alike) → `choose` (views spread over the motion) → a fit with the offset as one more unknown,
//! linearised anew until it stays → `open` (is that motion, or noise?) → [`crate::calibrate()`] with
//! the offset free about that.
//!
//! ```text
//! camera time = robot time + offset
//! ```
//!
//! The epochs of the two clocks need not have anything in common.

mod choose;
mod moving;
mod offset;
mod open;
mod stream;

use std::collections::BTreeMap;

use nalgebra::Vector6;

use crate::{
    Base, Calibration, Camera, Config, Error, Flange, Observation, Pose, Session, Setup, Target,
    Warning,
    calibrate::{
        self,
        settle::{self, Settled, Stand},
        unscaled,
    },
    calibrate_sequence,
    findings::StreamFinding,
    solve::FEWEST_POSES,
};
use choose::Both;
pub use moving::calibrate_moving;
pub use stream::{Stamped, Stream};

/// Robot and camera poses, each by its own clock, in any order.
#[derive(Debug, Clone, PartialEq)]
pub struct Streams {
    /// Who carries the camera.
    pub setup: Setup,
    /// What the robot reported.
    pub robot: Vec<Stamped<Pose<Base, Flange>>>,
    /// Where the camera saw the target.
    pub camera: Vec<Stamped<Pose<Camera, Target>>>,
    /// Whether distances to the target are known up to one factor only.
    pub unknown_scale: bool,
}

/// Calibrates from two streams. The result tells the offset of the clocks and its standard
/// deviation; captures are named by camera time.
///
/// # Errors
/// [`Error::NotFinite`] on times and poses that are no numbers, [`Error::TooFewSamples`] where a
/// stream is empty. Fewer samples than needed end in a verdict.
pub fn calibrate_streams(streams: &Streams, config: &Config) -> Result<Calibration, Error> {
    let both = both(streams)?;
    let mut warnings = cleaning(&both.robot, "robot");
    warnings.extend(cleaning(&both.camera, "camera"));
    let found = enough(&both).and_then(|()| settle_streams(&both, streams.unknown_scale, config));
    let still = open::still(&both, found.as_ref().ok().map(|f| &f.0));
    let mut result = match found {
        Err(error @ Error::TooFewSamples { .. }) => nothing(&both, streams, &error),
        _ if let Some(still) = still => nothing(&both, streams, &still),
        Ok((settled, chosen, rivals)) => {
            let likeness = choose::likeness(&settled, both.setup);
            let steady = open::clock_is_free(&both, &chosen, &settled);
            let unknown = (streams.unknown_scale, steady);
            let mut result = finish(&both, &chosen, settled.stand, unknown, config)?;
            warnings.extend(told(&result, chosen.len(), both.samples(), likeness));
            if result.time_offset_s.is_none() {
                unscaled::name(&mut result.undetermined, OFFSET);
            } else {
                warnings.extend(ambiguous(&rivals));
            }
            result
        }
        Err(error) => without_offset(&both, streams, config, &error)?,
    };
    result.warnings.splice(0..0, warnings);
    Ok(result)
}

/// What is undetermined, in words.
const OFFSET: &str = "time offset between camera and robot";

fn both(streams: &Streams) -> Result<Both, Error> {
    fn bare<A, B>(all: &[Stamped<Pose<A, B>>], name: &str) -> Result<Stream, Error> {
        if let Some(k) = all.iter().position(|s| !s.pose.is_finite()) {
            return Err(Error::NotFinite { what: format!("pose of {name} sample {}", k + 1) });
        }
        let one = |s: &Stamped<Pose<A, B>>| Stamped { time_s: s.time_s, pose: *s.pose.iso() };
        match all.len() {
            0 => Err(too_few(name, 0)),
            _ => Stream::new(&all.iter().map(one).collect::<Vec<_>>(), name),
        }
    }
    Ok(Both {
        setup: streams.setup,
        robot: bare(&streams.robot, "robot")?,
        camera: bare(&streams.camera, "camera")?,
    })
}

fn too_few(stream: &str, found: usize) -> Error {
    Error::TooFewSamples { stream: stream.into(), found, needed: FEWEST_POSES }
}

/// Refuses streams of fewer samples than captures are needed.
fn enough(both: &Both) -> Result<(), Error> {
    for (stream, name) in [(&both.robot, "robot"), (&both.camera, "camera")] {
        if stream.times.len() < FEWEST_POSES {
            return Err(too_few(name, stream.times.len()));
        }
    }
    Ok(())
}

/// What had to be put right in a stream.
fn cleaning(stream: &Stream, name: &'static str) -> Vec<Warning> {
    let (c, stream, gaps) = (stream.cleaned, name, (stream.gaps(), stream.limit()));
    let found = [
        (c.unsorted, StreamFinding::Unsorted { stream, count: c.unsorted }),
        (c.repeated, StreamFinding::Repeated { stream, count: c.repeated }),
        (c.conflicting, StreamFinding::Conflicting { stream, count: c.conflicting }),
        (
            gaps.0,
            StreamFinding::Gaps {
                stream,
                count: gaps.0,
                limit_s: gaps.1,
                times_median: stream::GAP,
            },
        ),
    ];
    found.into_iter().filter(|(count, _)| *count > 0).map(|(_, f)| f.into()).collect()
}

/// Offsets to try, camera minus robot, both counted from their first samples: those that make the
/// two turn alike, and the clocks as they are where they have time in common.
fn starts(both: &Both) -> Vec<f64> {
    let mut all = offset::candidates(&both.robot, &both.camera);
    let as_given = both.robot.epoch - both.camera.epoch;
    if as_given < both.camera.duration() && -as_given < both.robot.duration() {
        all.push(as_given);
    }
    all
}

/// Views that tell good starts from bad ones.
const FEW_VIEWS: usize = 40;

/// Starts whose misfit is within this factor, and this much, of the least fit alike: a motion that
/// repeats. The second is a misfit of 0.3 mm.
const ALIKE: f64 = 1.5;
const ALIKE_ANYWAY: f64 = 0.02;

/// Offset and scale settled from the best start, with the samples that are its views, and other
/// offsets (s) that fit alike.
fn settle_streams(
    both: &Both,
    unknown_scale: bool,
    config: &Config,
) -> Result<(Settled, Vec<usize>, Vec<f64>), Error> {
    let mut first_error = None;
    let mut ranked: Vec<(f64, f64)> = vec![];
    for start in starts(both) {
        match misfit_at(both, start, unknown_scale) {
            Ok(misfit) => ranked.push((misfit, start)),
            Err(error) => first_error = first_error.or(Some(error)),
        }
    }
    let least = ranked.iter().map(|r| r.0).fold(f64::INFINITY, f64::min);
    // those that fit alike stay in their order: the first has most in common
    let (alike, mut others): (Vec<_>, Vec<_>) =
        ranked.into_iter().partition(|r| r.0 <= ALIKE * least + ALIKE_ANYWAY);
    others.sort_by(|a, b| a.0.total_cmp(&b.0));
    let rivals = |chosen: f64| {
        let other = alike.iter().map(|r| r.1).filter(|o| (o - chosen).abs() > both.apart());
        other.map(|o| o + both.epochs()).collect::<Vec<f64>>()
    };
    for &(_, start) in alike.iter().chain(&others) {
        match settle_from(both, start, unknown_scale, config) {
            Ok((settled, chosen)) => return Ok((settled, chosen, rivals(start))),
            Err(error) => first_error = first_error.or(Some(error)),
        }
    }
    Err(first_error.unwrap_or(Error::NotDetermined {
        what: "at no time offset do robot and camera turn alike for long enough: either does not \
               move, moves at a constant speed, or they were not recorded together"
            .into(),
    }))
}

/// How well a few views agree at an offset.
fn misfit_at(both: &Both, offset: f64, unknown_scale: bool) -> Result<f64, Error> {
    let chosen = choose::choose(both, offset, FEW_VIEWS);
    let mut pairs = both.captures(&chosen, offset, 1.0).pairs;
    if unknown_scale {
        let scale = unscaled::first_scale(&pairs)?;
        pairs = both.captures(&chosen, offset, scale).pairs;
    }
    settle::agreement(&pairs).map(|found| settle::misfit(&found.hand_eye, &pairs))
}

/// Settles offset and scale from a first offset, with fewer views as long as neighbours err alike.
fn settle_from(
    both: &Both,
    start: f64,
    unknown_scale: bool,
    config: &Config,
) -> Result<(Settled, Vec<usize>), Error> {
    let mut stand = Stand { offset: start, scale: 1.0 };
    let mut most = choose::MOST_VIEWS;
    loop {
        let chosen = choose::choose(both, stand.offset, most);
        let at = |s: Stand| both.captures(&chosen, s.offset, s.scale);
        if unknown_scale {
            stand.scale = unscaled::first_scale(&at(Stand { scale: 1.0, ..stand }).pairs)?;
        }
        let found = settle::settle(stand, unknown_scale, both.setup, &config.known, at)?;
        let fewer = chosen.len().min(most) / 2;
        if fewer < choose::FEWEST_VIEWS || choose::likeness(&found, both.setup) == 0.0 {
            return Ok((found, chosen));
        }
        (stand, most) = (found.stand, fewer);
    }
}

/// The calibration at an offset, with everything free about it; of a steady motion with its mean
/// velocity.
fn finish(
    both: &Both,
    chosen: &[usize],
    stand: Stand,
    (unknown_scale, steady): (bool, bool),
    config: &Config,
) -> Result<Calibration, Error> {
    let Moving { session, velocities, times } = session(both, chosen, stand.offset);
    let mut config = config.clone();
    config.unknown.velocities = if steady { open::steadied(&velocities) } else { velocities };
    let mut result = if unknown_scale {
        unscaled::calibrate_at(&session, stand.scale, &times, &config)?
    } else {
        calibrate_sequence(&session, &times, &config)?
    };
    result.time_offset_s = match result.time_offset_sigma_s {
        Some(_) => result.time_offset_s.map(|later| stand.offset + later + both.epochs()),
        None => None,
    };
    Ok(result)
}

/// The captures at an offset, named by camera time.
struct Moving {
    session: Session,
    /// How the mount moves in each.
    velocities: BTreeMap<String, Vector6<f64>>,
    /// By the camera's clock, s.
    times: BTreeMap<String, f64>,
}

fn session(both: &Both, chosen: &[usize], offset: f64) -> Moving {
    let (mut velocities, mut times) = (BTreeMap::new(), BTreeMap::new());
    let mut observations = vec![];
    for moment in chosen.iter().filter_map(|&k| both.moment(k, offset)) {
        let capture = format!("{:.6} s", moment.camera_time_s);
        velocities.insert(capture.clone(), both.mount_velocity(&moment));
        times.insert(capture.clone(), moment.camera_time_s);
        let (robot, camera) = (Pose::claim(moment.robot), Pose::claim(moment.camera));
        observations.push(Observation::bare(capture, robot, camera));
    }
    let session = Session::of_captures(both.setup, observations);
    Moving { session, velocities, times }
}

/// The result where no offset could be found: what the data leave open is named.
fn without_offset(
    both: &Both,
    streams: &Streams,
    config: &Config,
    error: &Error,
) -> Result<Calibration, Error> {
    // at any offset the motions are the same: the calibration names what they leave open
    let start = starts(both).first().copied().unwrap_or(0.0);
    let chosen = choose::choose(both, start, choose::MOST_VIEWS);
    let session = session(both, &chosen, start).session;
    if session.observations.is_empty() {
        return Ok(nothing(both, streams, error));
    }
    let mut result = if streams.unknown_scale {
        unscaled::undetermined(&session, error)
    } else {
        let mut result = calibrate::calibrate(&session, config)?;
        result.reasons.retain(|r| *r != error.to_string());
        result.reasons.insert(0, error.to_string());
        result
    };
    result.time_offset_s = None;
    unscaled::name(&mut result.undetermined, OFFSET);
    Ok(result)
}

/// The result of streams that say nothing, and why.
fn nothing(both: &Both, streams: &Streams, error: &Error) -> Calibration {
    let start = starts(both).first().copied().unwrap_or(0.0);
    let chosen = choose::choose(both, start, choose::MOST_VIEWS);
    let session = session(both, &chosen, start).session;
    let mut result = calibrate::without_answer(&session);
    if streams.unknown_scale {
        result.scale = None;
        unscaled::name(&mut result.undetermined, unscaled::SCALE);
    }
    result.reasons.push(error.to_string());
    unscaled::name(&mut result.undetermined, &unscaled::camera(&session));
    result.time_offset_s = None;
    unscaled::name(&mut result.undetermined, OFFSET);
    result
}

/// A finding where the motion repeats.
fn ambiguous(rivals: &[f64]) -> Option<Warning> {
    let others_s = rivals.to_vec();
    (!rivals.is_empty()).then(|| StreamFinding::OffsetAmbiguous { others_s }.into())
}

/// What to know about the offset and the views.
fn told(result: &Calibration, chosen: usize, samples: usize, likeness: f64) -> Vec<Warning> {
    let offset = result.time_offset_s.zip(result.time_offset_sigma_s);
    let offset = offset.map_or(StreamFinding::OffsetUndetermined, |(offset_s, sigma_s)| {
        StreamFinding::Offset { offset_s, sigma_s, chosen, of: samples }
    });
    let alike = StreamFinding::NeighboursAlike { correlation: likeness };
    let alike = (likeness > 0.0).then_some(alike);
    [offset].into_iter().chain(alike).map(Warning::from).collect()
}

#[cfg(test)]
mod tests;
