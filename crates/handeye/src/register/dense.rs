//! Registration of two scans, organised or in any order.
//!
//! From a start that is right to some centimetres and degrees; others around it are tried as well, and the
//! answer is given with what speaks for and against it.

use nalgebra::Isometry3;

use super::{
    descent::Descent,
    global,
    icp::Stop,
    part_search,
    rivals::{self},
    search::Search,
    surface::Surface,
};
use crate::{
    Error, Scan, Verdict,
    register::{
        finish::{Dense, add_reasons, refined},
        options::DenseConfig,
    },
};

/// Registers two scans, from a start that is right to some centimetres and degrees.
///
/// # Errors
/// [`Error::Invalid`] where a scan shows no surface.
pub fn register(
    source: &Scan,
    target: &Scan,
    start: &Isometry3<f64>,
    config: &DenseConfig,
) -> Result<Dense, Error> {
    let names = ["source", "target"];
    let all: Result<Vec<Surface>, Error> = Surface::of_all(&[source, target], config.threads)
        .into_iter()
        .zip(names)
        .map(|(surface, name)| {
            surface.ok_or_else(|| Error::Invalid(format!("the {name} scan shows no surface")))
        })
        .collect();
    let all = all?;
    Ok(register_surfaces(&all[0], &all[1], start, config))
}

/// Registers the surfaces of two scans; where nothing can be compared, the start is rejected.
pub fn register_surfaces(
    source: &Surface,
    target: &Surface,
    start: &Isometry3<f64>,
    config: &DenseConfig,
) -> Dense {
    registered(source, target, start, config).unwrap_or_else(|error| Dense {
        verdict: Verdict::Rejected,
        reasons: vec![match error {
            Error::TooFewPoints { .. } => nothing_near(config),
            Error::NotDetermined { what } => what,
            other => other.to_string(),
        }],
        undetermined: vec![],
        target_from_source: *start,
        covariance: None,
        iterations: 0,
        stop: Stop::NoMatches,
        inlier_fraction: 0.0,
        agreement: 0.0,
        size: None,
        rms_m: f64::NAN,
        sigma: f64::NAN,
        explained: None,
        places: vec![],
    })
}

fn nothing_near(config: &DenseConfig) -> String {
    if config.global {
        return "the source was found nowhere in the target: give a start, or scans with more shape in common".into();
    }
    format!(
        "hardly anything of the source lies within {:.0} mm of the target: give a better start, or a larger \
         distance",
        1e3 * config.max_correspondence_distance_m
    )
}

fn registered(
    source: &Surface,
    target: &Surface,
    start: &Isometry3<f64>,
    config: &DenseConfig,
) -> Result<Dense, Error> {
    if config.global
        && let Some(search) = Search::new(source, target, config.threads)
    {
        return part_search::registered(&search, source, target, config);
    }
    let mut descent = Descent::new(source, target, config);
    let gate = config.max_correspondence_distance_m;
    let mut starts = vec![*start];
    if config.global {
        starts = global::starts(source, target, config.threads);
    } else if config.restarts {
        starts.extend(rivals::around(start, &source.middle, 0.5 * gate));
    }
    let from = (!config.global).then_some(start);
    let rivals = rivals::answers(&descent, &starts, from, gate)?;
    let best = &rivals[0].reached;
    let held = if config.global { best.target_from_source } else { *start };
    let mut found = refined(&mut descent, best, &held, gate)?;
    add_reasons(&mut found, source, &rivals);
    found.conclude();
    Ok(found)
}

#[cfg(test)]
mod tests;
