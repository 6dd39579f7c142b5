//! Captures that repeat one another: what the robot misses at a place, it misses in all of them. Of each place one
//! counts; as independent captures they would promise an accuracy that nobody has measured.

use crate::{
    Observation, TargetPose,
    calibrate::{
        flow::{limits::SAME_VIEW, views},
        result::Calibration,
    },
    findings::CaptureFinding,
    model::{names::natural, residual::Residual, session::Session},
};

/// Robot poses this close are one place. Nobody moves by less; what a robot reads of itself varies by less.
const SAME_PLACE: Residual = Residual { angle: 3e-4, distance: 1e-4 };

/// Captures that do not count, each with the name of the one that does.
pub(crate) struct Uncounted {
    captures: Vec<(Observation, String)>,
    finding: fn(Vec<String>) -> CaptureFinding,
    /// What one capture does to the one that counts.
    does: &'static str,
}

/// Takes out all but the first capture of each place.
pub(crate) fn take_out(session: &mut Session) -> Uncounted {
    let (mut kept, mut all) = (Vec::<Observation>::new(), vec![]);
    for capture in session.observations.drain(..) {
        match kept.iter().find(|first| repeats(first, &capture)) {
            Some(first) => all.push((capture, first.capture.clone())),
            None => kept.push(capture),
        }
    }
    session.observations = kept;
    Uncounted {
        captures: all,
        finding: |captures| CaptureFinding::Repeated { captures },
        does: "repeats",
    }
}

fn repeats(first: &Observation, other: &Observation) -> bool {
    let is_one_place =
        Residual::are_within(&first.base_from_flange, &other.base_from_flange, SAME_PLACE);
    let alike = |seen: &TargetPose, again: &TargetPose| {
        let (seen, again) = (&seen.camera_from_target, &again.camera_from_target);
        Residual::between(seen, again).is_within(SAME_VIEW)
    };
    let of_views =
        first.candidates.iter().any(|seen| other.candidates.iter().any(|again| alike(seen, again)));
    is_one_place && (of_views || is_one_ball(first, other))
}

/// Whether two captures, of scans alone, have the centre of a ball at one place.
fn is_one_ball(first: &Observation, other: &Observation) -> bool {
    let bare = first.candidates.is_empty() && other.candidates.is_empty();
    let [seen, again] = [first, other].map(|o| o.surface.first().map(|c| c.in_camera.vector()));
    let apart = seen.zip(again).map(|(a, b)| (a - b).norm());
    bare && apart.is_some_and(|d| d < SAME_VIEW.distance)
}

impl Uncounted {
    /// All captures count.
    pub(crate) fn none() -> Self {
        Self::of_one_place(vec![])
    }

    /// Captures beside which others were taken, with the robot's error at that place.
    pub(crate) fn of_one_place(captures: Vec<(Observation, String)>) -> Self {
        Self {
            captures,
            finding: |captures| CaptureFinding::OfOnePlace { captures },
            does: "was taken beside",
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.captures.is_empty()
    }

    /// The result with these captures put back into it, as some that do not count.
    pub(crate) fn put_back(self, result: Calibration) -> Calibration {
        let Self { captures, finding, does } = self;
        if captures.is_empty() {
            return result;
        }
        let names = captures.iter().map(|(o, _)| o.capture.clone()).collect();
        let mut all = result.captures.clone();
        for (capture, first) in captures {
            let mut report = views::first_report(&capture);
            report.used = false;
            report.reason =
                Some(format!("{does} capture {first}: one capture of each pose counts"));
            let at = all.iter().position(|c| natural(&c.id, &report.id).is_gt());
            all.insert(at.unwrap_or(all.len()), report);
        }
        Calibration { captures: all, ..result.noting([finding(names)]) }
    }
}
