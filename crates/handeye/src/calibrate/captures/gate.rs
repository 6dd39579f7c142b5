//! Which captures belong, judged by the noise that they show themselves.
//!
//! The consensus gates by the median residual, which is rough. Here every capture is judged by a fit
//! that has not seen it: its squared Mahalanobis distance, against noise estimated by restricted
//! likelihood from those that agree. Captures that are no outliers come back in; then the worst of
//! those inside goes out if it is one.

use super::masked::{IMPROBABLE, masked, outlier_limit};
use crate::{
    Setup,
    calibrate::flow::{config::Config, views::Captures},
    estimate::{self, JointFit, Problem, joint},
    solve::{FEWEST_POSES, View, consensus::Consensus},
};

/// Rounds of letting captures in and putting the worst out. Each round that puts one out may hold
/// another that was hidden behind it.
const ROUNDS: usize = 12;

/// Captures inside whose fit without them is tried in each round, the worst first.
const SUSPECTS: usize = 3;

/// The captures that belong, and the fit of them; `None` where they determine no answer.
pub(crate) fn gate(
    captures: &Captures,
    mut found: Consensus,
    config: &Config,
) -> (Consensus, Option<JointFit>) {
    let mut last = None;
    for _ in 0..ROUNDS {
        let Some(fit) = fit_of(captures, &found, &agreeing(&found), config) else { break };
        found.hand_eye = fit.hand_eye;
        let changed = readmit(captures, &mut found, &fit)
            || put_out(captures, &mut found, &fit, config)
            || unmask(captures, &mut found, &fit, config);
        last = Some(fit);
        if !changed {
            break;
        }
    }
    (found, last)
}

fn agreeing(found: &Consensus) -> Vec<usize> {
    (0..found.agrees.len()).filter(|&i| found.agrees[i]).collect()
}

fn fit_of(
    captures: &Captures,
    found: &Consensus,
    used: &[usize],
    config: &Config,
) -> Option<JointFit> {
    let views: Vec<View> = used.iter().map(|&i| captures.view(i, found.reading[i])).collect();
    estimate::fit_views(&views, &found.hand_eye, &config.known, captures.session.setup).ok()
}

/// A fit of other views, from one that is near.
fn refit(views: Vec<View>, near: &JointFit, setup: Setup, config: &Config) -> JointFit {
    let (boards, extras) = (vec![], vec![]);
    let problem = Problem { setup, views, boards, extras, known_position: None };
    joint::refit(&problem, near, &config.known)
}

/// Lets captures in, in their best reading, that are no outliers.
fn readmit(captures: &Captures, found: &mut Consensus, fit: &JointFit) -> bool {
    let limit = outlier_limit(IMPROBABLE, 1, fit.degrees_of_freedom);
    let mut changed = false;
    for i in (0..found.agrees.len()).filter(|&i| !found.agrees[i]).collect::<Vec<_>>() {
        let best = (0..captures.readings[i].camera_from_target.len())
            .filter_map(|k| {
                Some((k, fit.squared_mahalanobis(&captures.view(i, k), captures.session.setup)?))
            })
            .min_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((k, d2)) = best
            && d2 < limit
        {
            (found.reading[i], found.agrees[i], changed) = (k, true, true);
        }
    }
    changed
}

/// Rejects the worst capture if it is an outlier to a fit of the others.
fn put_out(captures: &Captures, found: &mut Consensus, fit: &JointFit, config: &Config) -> bool {
    let setup = captures.session.setup;
    let used = agreeing(found);
    if used.len() <= FEWEST_POSES + 1 {
        return false; // the rest would not tell its noise
    }
    let inside = |&i: &usize| {
        Some((fit.squared_mahalanobis(&captures.view(i, found.reading[i]), setup)?, i))
    };
    let mut suspects: Vec<(f64, usize)> = used.iter().filter_map(inside).collect();
    suspects.sort_by(|a, b| b.0.total_cmp(&a.0));
    let outlying = |&(_, i): &(f64, usize)| {
        let rest = used.iter().filter(|&&k| k != i);
        let rest = rest.map(|&k| captures.view(k, found.reading[k])).collect();
        let without = refit(rest, fit, setup, config);
        let d2 = without.squared_mahalanobis(&captures.view(i, found.reading[i]), setup)?;
        let excess = d2 / outlier_limit(IMPROBABLE, 1, without.degrees_of_freedom);
        (excess > 1.0).then_some((excess, i))
    };
    let worst =
        suspects.iter().take(SUSPECTS).filter_map(outlying).max_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((_, i)) = worst {
        found.agrees[i] = false;
    }
    worst.is_some()
}

/// Puts out captures that hid behind one another.
fn unmask(captures: &Captures, found: &mut Consensus, fit: &JointFit, config: &Config) -> bool {
    let used = agreeing(found);
    let view = |&i: &usize| captures.view(i, found.reading[i]);
    let views: Vec<View> = used.iter().map(view).collect();
    let setup = captures.session.setup;
    let hidden = masked(&views, fit, setup, |part, near| {
        refit(part.iter().map(|&k| views[k].clone()).collect(), near, setup, config)
    });
    hidden.iter().for_each(|&k| found.agrees[used[k]] = false);
    !hidden.is_empty()
}
