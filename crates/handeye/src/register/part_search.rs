//! A part that was searched for, refined and judged.
//!
//! The residuals of a registration do not tell a wrong place, since what does not fit is an outlier. So what is left
//! unexplained counts against an answer: surfels of the scan inside the part's box that do not lie on the part, and
//! surfaces of the part that the camera should have seen and saw through. Another place that explains nearly as much
//! makes the answer undetermined: the part is symmetric, or what tells the places apart was not seen.

use nalgebra::{Isometry3, UnitQuaternion};

use super::{
    descent::Descent,
    rivals,
    search::{Evidence, Place, Search},
    surface::Surface,
};
use crate::{
    Error, Verdict,
    register::{
        finish::{Dense, add_reasons, refined},
        options::DenseConfig,
    },
};

/// Matches are looked for within so many times the spread of a window.
const NEARBY: f64 = 3.0;
/// Less of the scan within the part's box must not lie on the part.
const EXPLAINED: f64 = 0.8;
/// More of the part's visible surface must not be seen through.
const CONTRADICTED: f64 = 0.12;
/// More of the part's visible surface must not be missing in the scan.
const MISSING: f64 = 0.2;
/// Refinement must not move the part by more than this share of its radius, ...
const MOVED: f64 = 0.04;
/// ... nor leave less than this share of what was explained.
const KEPT: f64 = 0.93;
/// A place that explains at least this share of what the best explains is as good.
const EQUAL: f64 = 0.95;
/// The part's position must be known within this share of its radius: 95 % error, on average over its surface.
const PRECISE: f64 = 0.005;
/// From one standard deviation to 95 %.
const DEVIATIONS_95: f64 = 1.96;
/// Places that differ by a rotation about one point have no shift along its axis beyond this share of the radius.
const SYMMETRIC: f64 = 0.05;

/// Where the source lies in the target, of which one is a part.
///
/// # Errors
/// [`Error::TooFewPoints`] where the part is found nowhere.
pub fn registered(
    search: &Search,
    source: &Surface,
    target: &Surface,
    config: &DenseConfig,
) -> Result<Dense, Error> {
    let places = search.places();
    let Some(best) = places.first() else {
        return Err(Error::TooFewPoints { found: 0, needed: 1 });
    };
    let start = best.target_from_source;
    let gate = config.max_correspondence_distance_m.min(NEARBY * source.spread.max(target.spread));
    // a scan of much else is registered where the part is
    let cropped = search.cropped(source, &start);
    let source = cropped.as_ref().unwrap_or(source);
    let mut descent = Descent::new(source, target, config);
    let reached = rivals::answers(&descent, &[start], None, gate)?;
    let mut found = refined(&mut descent, &reached[0].reached, &start, gate)?;
    add_reasons(&mut found, source, &[]);
    let evidence = search.evidence(&found.target_from_source);
    found.explained = Some(evidence.explained);
    found.reasons.extend(against(&evidence, best, search.apart(&start, &found.target_from_source)));
    let equal = equal_places(&places);
    if !equal.is_empty() {
        found.places = [&[found.target_from_source], &equal[1..]].concat();
    }
    found.conclude();
    if !found.places.is_empty() {
        found.reasons.push(ambiguous(&found.places, search));
    }
    if found.verdict == Verdict::Accepted
        && let Some(reason) = imprecise(&found, search)
    {
        found.verdict = Verdict::Undetermined;
        found.reasons.push(reason);
    }
    Ok(found)
}

/// Says how well the part's position is determined, where that is not enough to call it found.
fn imprecise(found: &Dense, search: &Search) -> Option<String> {
    let covariance = found.covariance.as_ref()?;
    let error = DEVIATIONS_95 * search.deviation(&found.target_from_source, covariance);
    let share = error / search.radius();
    (share > PRECISE).then(|| {
        format!(
            "the surfaces in view determine the part's position only within {:.2} mm (95 %), {:.1} % of its radius: \
             scan it from a side that shows its edges or other faces too",
            1e3 * error,
            100.0 * share
        )
    })
}

/// What speaks against an answer that was refined from a place.
fn against(evidence: &Evidence, from: &Place, moved: f64) -> Vec<String> {
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    let mut reasons = vec![];
    if evidence.explained < EXPLAINED {
        reasons.push(format!(
            "{} of the scan where the part would be does not lie on the part: it is another part, another version, \
             or it is elsewhere",
            percent(1.0 - evidence.explained)
        ));
    }
    if evidence.contradicted > CONTRADICTED || evidence.missing > MISSING {
        reasons.push(format!(
            "of the part's surface that the scan should show, it shows what is behind at {}, and nothing at {}",
            percent(evidence.contradicted),
            percent(evidence.missing)
        ));
    }
    if moved > MOVED || evidence.score < KEPT * from.evidence.score {
        reasons.push(
            "refinement leaves the place that was found: surfaces are too thin or too small for the distance of \
             the points; give the part as a mesh, or a denser scan"
                .into(),
        );
    }
    reasons
}

/// All places that are as good as the best, if it is not the only one.
fn equal_places(places: &[Place]) -> Vec<Isometry3<f64>> {
    let best = places.first().map_or(0.0, |place| place.evidence.score);
    let equal: Vec<Isometry3<f64>> = places
        .iter()
        .filter(|place| place.evidence.score >= EQUAL * best)
        .map(|place| place.target_from_source)
        .collect();
    if equal.len() > 1 { equal } else { vec![] }
}

/// Says how the other places differ from the first.
fn ambiguous(places: &[Isometry3<f64>], search: &Search) -> String {
    let poses: Vec<Isometry3<f64>> = places.iter().map(|at| search.part_from_scan(at)).collect();
    let by = |other: &Isometry3<f64>| other * poses[0].inverse();
    let is_rotation = |by: &Isometry3<f64>| {
        let along = by.rotation.axis().map_or(0.0, |axis| by.translation.vector.dot(&axis).abs());
        along < SYMMETRIC * search.radius()
    };
    let mut angles: Vec<i64> = poses[1..].iter().map(|p| degrees(&by(p).rotation)).collect();
    angles.sort_unstable();
    angles.dedup();
    let list = angles.iter().map(i64::to_string).collect::<Vec<_>>().join(", ");
    let how = if poses[1..].iter().all(|p| is_rotation(&by(p))) {
        format!("rotated by {list} degrees from the first")
    } else {
        format!("rotated by {list} degrees from the first, or shifted")
    };
    format!(
        "the part fits equally well in {} places, listed in `places` ({how}): it is symmetric, it is there several \
         times, or what distinguishes them is not in view",
        places.len()
    )
}

fn degrees(rotation: &UnitQuaternion<f64>) -> i64 {
    rotation.angle().to_degrees().round() as i64
}

#[cfg(test)]
mod tests;
