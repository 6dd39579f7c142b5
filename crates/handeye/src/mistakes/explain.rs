//! The mistake that explains bad data best: readings, order, size, and captures that do not belong.
//!
//! A reading of the stored numbers is judged by the loop `E = Y⁻¹ A X C` that the captures close
//! under it:
//!
//! ```text
//! d² = (angle(E) / 0.05°)² + (|t(E)| / 0.7 mm)²        score² = exp(mean ln(1 + d²)) - 1
//! ```
//!
//! The mean of the logarithm hears every capture and lets none shout: a few wrong ones cost little,
//! a reading that fits three captures alone costs much. Rotation and translation must both count:
//! permuting Euler axes conjugates every rotation by a fixed one, which `X` takes up, and only the
//! translations tell. What `X` cannot take up are the invariants of `A X = X B`: the motions of
//! robot and camera have the same angle and the same pitch (H. Chen, *A screw motion approach to
//! uniqueness analysis of head-eye geometry*, CVPR 1991); they sift readings and orders without a
//! fit.
//!
//! No data tell robot poses inverted from the camera on the other body, nor, where target poses
//! came from elsewhere, from those inverted: `A⁻¹ X = Y B` is `A Y = X B⁻¹`. An axis of the base
//! mirrored is any other one mirrored, turned.

use nalgebra::Vector3;

pub use super::size::{rescaled, size};
use super::{
    size::wrong_size,
    strays::{repeats, strays},
};
use crate::{
    PosePair,
    math::{lie, linalg::median},
    mistakes::score::{
        FEWEST, Fault, Finding, Order, Score, UNIT_ANGLE, UNIT_DISTANCE, combined, pair, scored,
    },
    solve::{self, Method, consensus::Readings, few_axes, motions},
};

/// An explanation must lower the score to this part of the declared one.
pub const EXPLAINS: f64 = 1.0 / 3.0;
/// Explanations whose scores differ by less than this factor cannot be told apart.
pub const ALIKE: f64 = 1.5;
/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// The captures as declared; `None` when they agree on nothing at all.
    pub declared: Option<Score>,
    /// Explanations, best first.
    pub findings: Vec<Finding>,
    /// How many of the first explanations the data cannot tell apart.
    pub alike: usize,
    /// The best reading or order beside them: how far the others are away.
    pub runner_up: Option<(Fault, Score)>,
}

/// Looks for mistakes. `readings` are other meanings of the same numbers, as many captures each.
pub fn explain(declared: &[Readings], readings: &[Vec<Readings>]) -> Diagnosis {
    let as_declared = scored(declared);
    let before = as_declared.as_ref().map_or(f64::INFINITY, |(s, _)| s.score);
    let mut wholesale = judged_readings(readings, before);
    wholesale.extend(orders(declared));
    let size = wrong_size(declared, as_declared.as_ref());
    wholesale.extend(size.clone());
    wholesale.sort_by(|a, b| after(a).total_cmp(&after(b)));
    let best = wholesale.first().map_or(f64::INFINITY, after);
    let explains = best < EXPLAINS * before;
    let fits_alike = |f: &Finding| explains && after(f) < (ALIKE * best).min(EXPLAINS * before);
    let (mut findings, rest): (Vec<_>, Vec<_>) = wholesale.into_iter().partition(fits_alike);
    let alike = findings.len();
    let (repeated, still): (Vec<_>, Vec<_>) =
        repeats(declared).into_iter().partition(|f| matches!(f.fault, Fault::Repeated(_)));
    let singled_out = !findings.is_empty();
    findings.extend(still.clone());
    if !singled_out {
        // a size that is wrong by a little explains a little
        findings.extend(size);
    }
    findings.extend(repeated);
    if !singled_out && still.is_empty() {
        findings.extend(as_declared.iter().flat_map(|(_, found)| strays(declared, found)));
    }
    let runner_up = rest
        .iter()
        .find(|f| !matches!(f.fault, Fault::Scale(_)))
        .and_then(|f| Some((f.fault.clone(), f.after?)));
    Diagnosis {
        declared: as_declared.map(|(s, _)| s),
        alike: alike.max(usize::from(!findings.is_empty())),
        findings,
        runner_up,
    }
}

fn after(finding: &Finding) -> f64 {
    finding.after.map_or(f64::INFINITY, |s| s.score)
}

/// Readings that are fitted in full, best first by their quick scores.
const MOST_FITTED: usize = 8;
/// Quick scores beyond this part of the declared one are not worth a fit, unless all are bad.
const WORTH_A_FIT: f64 = 3.0;

fn judged_readings(readings: &[Vec<Readings>], before: f64) -> Vec<Finding> {
    let mut quick: Vec<(f64, usize)> =
        readings.iter().enumerate().map(|(k, r)| (quick_score(r), k)).collect();
    quick.sort_by(|a, b| a.0.total_cmp(&b.0));
    // boards that look the same turned round, and wrong captures, spoil the quick score: then fit all
    let spoilt = readings.iter().flatten().any(|c| c.camera_from_target.len() > 1)
        && quick.first().is_some_and(|q| q.0 > before.min(10.0));
    let worth =
        |(k, q): (usize, &(f64, usize))| spoilt || (k < MOST_FITTED && q.0 < WORTH_A_FIT * before);
    let chosen = quick.iter().enumerate().filter(|&(k, q)| worth((k, q)));
    let judge = |(_, &(_, k)): (usize, &(f64, usize))| {
        let captures = &readings[k];
        if spoilt && angle_misfit(captures) > SIFTED {
            return None;
        }
        let (score, _) = scored(captures)?;
        Some(Finding { fault: Fault::Reading(k), after: Some(score) })
    };
    chosen.filter_map(judge).collect()
}

/// Median difference of the angles of robot and camera motions beyond which a reading is dropped
/// without a fit: 5 degrees.
const SIFTED: f64 = 0.087;

/// One closed form over all captures in their first readings; a robot of one axis has its own.
fn quick_score(captures: &[Readings]) -> f64 {
    let pairs: Vec<PosePair> =
        captures.iter().filter(|c| !c.camera_from_target.is_empty()).map(|c| pair(c, 0)).collect();
    let found = solve::solve(&pairs, Method::Shah).ok().or_else(|| few_axes::solve(&pairs));
    let Some(found) = found else { return f64::INFINITY };
    let error = |p: &PosePair| {
        let e = found.loop_error(p);
        (e.iso().rotation.angle(), e.translation().norm())
    };
    combined(&pairs.iter().map(error).collect::<Vec<_>>())
}

/// Captures in pairs at which the invariants are taken, at most.
const MOST_INVARIANTS: usize = 400;

/// Median over motions of the difference between the robot's angle and the camera's, rad.
fn angle_misfit(captures: &[Readings]) -> f64 {
    let n = captures.len();
    let all: Vec<(usize, usize)> = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).collect();
    let step = (all.len() / MOST_INVARIANTS).max(1);
    let misfit = |&(i, j): &(usize, usize)| {
        let (a, b) = (&captures[i], &captures[j]);
        let robot = a.anchor_from_mount.angle_to(&b.anchor_from_mount);
        let turns = a.camera_from_target.iter().flat_map(|x| {
            b.camera_from_target
                .iter()
                .map(move |y| lie::angle(&x.iso().rotation.inverse(), &y.iso().rotation.inverse()))
        });
        turns.map(|camera| (robot - camera).abs()).reduce(f64::min)
    };
    median(all.iter().step_by(step).filter_map(misfit))
}

/// Median misfit of both invariants, in units of the score, with picture `i` at robot pose
/// `order(i)`; the first readings alone.
fn invariant_misfit(captures: &[Readings], order: Order) -> f64 {
    let n = captures.len();
    let at = |i: usize| {
        Some(PosePair {
            anchor_from_mount: captures[order.robot_of(i, n)].anchor_from_mount,
            camera_from_target: *captures[i].camera_from_target.first()?,
        })
    };
    let pairs: Vec<PosePair> = (0..n).filter_map(at).collect();
    let misfit = |m: &motions::Motion| {
        let (wa, wb) = (lie::so3_log(&m.a.rotation), lie::so3_log(&m.b.rotation));
        let angle = (wa.norm() - wb.norm()) / UNIT_ANGLE;
        let pitch = |w: &Vector3<f64>, t: &Vector3<f64>| {
            w.try_normalize(0.05).map_or(0.0, |axis| axis.dot(t))
        };
        let pitch = pitch(&wa, &m.a.translation.vector) - pitch(&wb, &m.b.translation.vector);
        angle.hypot(pitch / UNIT_DISTANCE)
    };
    median(motions::motions(&pairs).iter().map(misfit))
}

/// Orders that are fitted in full, best invariants first.
const MOST_ORDERS: usize = 3;

fn orders(captures: &[Readings]) -> Vec<Finding> {
    let n = captures.len();
    if n < FEWEST {
        return vec![];
    }
    let shifts = (1..n).map(Order::Shifted);
    let mut all: Vec<(f64, Order)> = shifts
        .chain([Order::Reversed])
        .map(|order| (invariant_misfit(captures, order), order))
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let judge = |&(_, order): &(f64, Order)| {
        let (score, _) = scored(&reordered(captures, order))?;
        Some(Finding { fault: Fault::Order(order), after: Some(score) })
    };
    all.iter().take(MOST_ORDERS).filter_map(judge).collect()
}

/// Captures with their robot poses in another order.
pub fn reordered(captures: &[Readings], order: Order) -> Vec<Readings> {
    let n = captures.len();
    let with = |i: usize| Readings {
        anchor_from_mount: captures[order.robot_of(i, n)].anchor_from_mount,
        camera_from_target: captures[i].camera_from_target.clone(),
    };
    (0..n).map(with).collect()
}
