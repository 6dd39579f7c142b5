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

use super::{
    settle::{self, Settled, Stand},
    unscaled,
};
use crate::{
    Calibration, Config, Error, Observation, Pose, Session, Stamped, Warning,
    calibrate::flow::{evidence::TIME_OFFSET, unknown::Unknown},
    findings::StreamFinding,
    model::session::Motion,
    solve::FEWEST_POSES,
};
use choose::Both;
pub use moving::joints_between;
pub use stream::Stream;

/// Captures with the robot's poses of their moments.
pub(crate) struct Synchronized {
    /// As many as are known; without the robot's record.
    pub session: Session,
    /// What is free about where it stands in the session.
    pub unknown: Unknown,
    /// Why the captures have no poses that can be right.
    pub failure: Option<Failure>,
    /// What had to be put right in the streams.
    cleaning: Vec<Warning>,
    /// Captures whose moments the robot's record does not hold.
    without: Vec<String>,
    /// Number of moments that were chosen of a stream; `None` where all captures are as they were given.
    chosen: Option<usize>,
    /// Number of moments of which they are.
    samples: usize,
    /// Correlation of neighbouring residuals.
    likeness: f64,
    /// Other offsets (s) that fit as well.
    rivals: Vec<f64>,
}

/// Why there is no offset.
pub(crate) struct Failure {
    pub error: Error,
    /// Whether the motions, which are the same at any offset, may say what they leave open.
    pub motions_may_tell: bool,
}

/// Finds the offset of the clocks, and the robot's pose at the moment of each capture: of poses that are a stream of
/// their own the moments that tell most, of other captures all of them.
///
/// # Errors
/// [`Error::NotFinite`] on times and poses that are no numbers, [`Error::TooFewSamples`] where a
/// stream is empty.
pub(crate) fn synchronize(
    session: &Session,
    motion: &Motion,
    config: &Config,
) -> Result<Synchronized, Error> {
    let both = both(session, motion)?;
    let is_stream = session.in_sequence;
    let mut cleaning = cleaned(&both.robot, "robot");
    cleaning.extend(is_stream.then(|| cleaned(&both.camera, "camera")).into_iter().flatten());
    let found = enough(&both).and_then(|()| settle_streams(&both, session.unknown_scale, config));
    let still = open::still(&both, found.as_ref().ok().map(|f| &f.0));
    let (settled, chosen, rivals) = match (found, still) {
        (Err(error @ Error::TooFewSamples { .. }), _) | (_, Some(error)) => {
            let failure = Failure { error, motions_may_tell: false };
            return Ok(failed(&both, session, failure, cleaning));
        }
        (Err(error), None) => {
            let failure = Failure { error, motions_may_tell: !session.unknown_scale };
            return Ok(failed(&both, session, failure, cleaning));
        }
        (Ok(found), None) => found,
    };
    let steady = open::clock_is_free(&both, &chosen, &settled);
    let Stand { offset, scale } = settled.stand;
    let (at_moments, without) = match is_stream {
        true => (moments(&both, &chosen, offset), vec![]),
        false => moving::captures(session, motion, &both, offset + both.epochs()),
    };
    let metric =
        if session.unknown_scale { unscaled::divided(&at_moments, scale) } else { at_moments };
    Ok(Synchronized {
        session: if steady { open::steadied(metric) } else { metric },
        unknown: Unknown {
            scale: session.unknown_scale.then_some(scale),
            time_offset_s: Some(offset + both.epochs()),
        },
        failure: None,
        cleaning,
        without,
        chosen: is_stream.then_some(chosen.len()),
        samples: if is_stream { both.samples() } else { both.camera.times.len() },
        likeness: choose::likeness(&settled, both.setup),
        rivals: if is_stream { rivals } else { vec![] },
    })
}

impl Synchronized {
    /// What to know about clocks and captures, beside their result.
    pub fn findings(&self, result: &Calibration) -> Vec<Warning> {
        if self.failure.is_some() {
            return self.cleaning.clone();
        }
        let captures = self.without.clone();
        let without =
            (!captures.is_empty()).then_some(StreamFinding::WithoutRobotPose { captures });
        let (chosen, of) = (self.chosen.unwrap_or(result.captures.len()), self.samples);
        let offset = result.time_offset_s.zip(result.time_offset_sigma_s);
        let ambiguous = offset.filter(|_| !self.rivals.is_empty());
        let offset = offset.map_or(StreamFinding::OffsetUndetermined, |(offset_s, sigma_s)| {
            StreamFinding::Offset { offset_s, sigma_s, chosen, of }
        });
        let correlation = self.likeness;
        let alike = (correlation > 0.0).then_some(StreamFinding::NeighboursAlike { correlation });
        let others_s = self.rivals.clone();
        let ambiguous = ambiguous.map(|_| StreamFinding::OffsetAmbiguous { others_s });
        let all = without.into_iter().chain([offset]).chain(alike).chain(ambiguous);
        self.cleaning.iter().cloned().chain(all.map(Warning::from)).collect()
    }
}

/// Captures of streams with no offset: at any, their motions are the same.
fn failed(
    both: &Both,
    session: &Session,
    failure: Failure,
    cleaning: Vec<Warning>,
) -> Synchronized {
    let start = starts(both).first().copied().unwrap_or(0.0);
    let chosen = choose::choose(both, start, choose::MOST_VIEWS);
    let of_motions = Session { in_sequence: false, ..moments(both, &chosen, start) };
    let motions_may_tell = failure.motions_may_tell && !of_motions.observations.is_empty();
    Synchronized {
        session: of_motions,
        unknown: Unknown { scale: session.unknown_scale.then_some(1.0), time_offset_s: Some(0.0) },
        failure: Some(Failure { motions_may_tell, ..failure }),
        cleaning,
        without: vec![],
        chosen: None,
        samples: 0,
        likeness: 0.0,
        rivals: vec![],
    }
}

/// The result where no offset was found: `plain` says what the motions leave open, `error` why.
pub(crate) fn without_offset(plain: Calibration, error: &Error) -> Calibration {
    let error = error.to_string();
    let rest = plain.reasons.iter().filter(|r| **r != error).cloned();
    let reasons = std::iter::once(error.clone()).chain(rest).collect();
    let undetermined = [plain.undetermined.clone(), vec![TIME_OFFSET.into()]].concat();
    Calibration { reasons, undetermined, time_offset_s: None, ..plain }.recorded()
}

/// Both streams, the captures that show the target being one.
fn both(session: &Session, motion: &Motion) -> Result<Both, Error> {
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
    let seen = |o: &Observation| {
        let pose = o.candidates.first()?.camera_from_target;
        Some(Stamped { time_s: o.time_s?, pose })
    };
    let camera: Vec<_> = session.observations.iter().filter_map(seen).collect();
    Ok(Both {
        setup: session.setup,
        robot: bare(&motion.robot, "robot")?,
        camera: bare(&camera, "camera")?,
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
fn cleaned(stream: &Stream, name: &'static str) -> Vec<Warning> {
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

/// Starts whose residual is within this factor, and this much, of the least fit alike: a motion that
/// repeats. The second is a residual of 0.3 mm.
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
        match residual_at(both, start, unknown_scale) {
            Ok(residual) => ranked.push((residual, start)),
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
        what: "no time offset makes the rotations of robot and camera agree for long enough: one of them does not \
               move, moves at a constant speed, or they were not recorded together"
            .into(),
    }))
}

/// How well a few views agree at an offset.
fn residual_at(both: &Both, offset: f64, unknown_scale: bool) -> Result<f64, Error> {
    let chosen = choose::choose(both, offset, FEW_VIEWS);
    let mut pairs = both.captures(&chosen, offset, 1.0).pairs;
    if unknown_scale {
        let scale = unscaled::first_scale(&pairs)?;
        pairs = both.captures(&chosen, offset, scale).pairs;
    }
    settle::agreement(&pairs).map(|found| settle::residual(&found.hand_eye, &pairs))
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

/// The captures of some moments at an offset, named by camera time, with the velocity of the mount in each.
fn moments(both: &Both, chosen: &[usize], offset: f64) -> Session {
    let capture = |moment: choose::Moment| Observation {
        time_s: Some(moment.camera_time_s),
        velocity: Some(both.mount_velocity(&moment)),
        ..Observation::bare(
            format!("{:.6} s", moment.camera_time_s),
            Pose::claim(moment.robot),
            Pose::claim(moment.camera),
        )
    };
    let all = chosen.iter().filter_map(|&k| both.moment(k, offset));
    Session { in_sequence: true, ..Session::of_captures(both.setup, all.map(capture).collect()) }
}

#[cfg(test)]
mod tests;
