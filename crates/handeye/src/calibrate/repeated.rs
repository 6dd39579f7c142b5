//! Captures that repeat one another: what the robot misses at a place, it misses in all of them. Of each place one
//! counts; as independent captures they would promise an accuracy that nobody has measured.

use super::{Session, agreement, natural};
use crate::{Observation, Warning, calibration::Calibration};

/// Robot poses this close are one place: rad and m. Nobody moves by less; what a robot reads of itself varies by less.
const SAME_PLACE: (f64, f64) = (3e-4, 1e-4);
/// Target poses this close show the same.
const SAME_VIEW: (f64, f64) = (3e-3, 1e-3);
/// So many are named.
const NAMED: usize = 6;

/// Captures that do not count, each with the name of the one that does.
pub(crate) struct Repeated(Vec<(Observation, String)>);

/// Takes out all but the first capture of each place.
pub(crate) fn take_out(session: &mut Session) -> Repeated {
    let (mut kept, mut all) = (Vec::<Observation>::new(), vec![]);
    for capture in session.observations.drain(..) {
        match kept.iter().find(|first| repeats(first, &capture)) {
            Some(first) => all.push((capture, first.capture.clone())),
            None => kept.push(capture),
        }
    }
    session.observations = kept;
    Repeated(all)
}

fn repeats(first: &Observation, other: &Observation) -> bool {
    let (a, b) = (&first.base_from_flange, &other.base_from_flange);
    a.distance_to(b) < SAME_PLACE.1
        && a.angle_to(b) < SAME_PLACE.0
        && first.candidates.iter().any(|seen| {
            other.candidates.iter().any(|again| {
                let (a, b) = (&seen.camera_from_target, &again.camera_from_target);
                a.distance_to(b) < SAME_VIEW.1 && a.angle_to(b) < SAME_VIEW.0
            })
        })
}

impl Repeated {
    /// Puts them back into the result, as captures that do not count.
    pub(crate) fn report(self, result: &mut Calibration) {
        if self.0.is_empty() {
            return;
        }
        let names: Vec<&str> = self.0.iter().take(NAMED).map(|(o, _)| o.capture.as_str()).collect();
        let more = match self.0.len() - names.len() {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let message = format!(
            "captures {}{more} repeat others: the same robot pose, and the same view. What the robot misses there is the \
             same in all of them, so of each place one counts",
            names.join(", ")
        );
        result.warnings.push(Warning::new("captures-repeated", message));
        for (capture, first) in self.0 {
            let mut report = agreement::first_report(&capture);
            report.used = false;
            report.reason = Some(format!("repeats capture {first}: of each place one counts"));
            let at = result.captures.iter().position(|c| natural(&c.id, &report.id).is_gt());
            result.captures.insert(at.unwrap_or(result.captures.len()), report);
        }
    }
}
