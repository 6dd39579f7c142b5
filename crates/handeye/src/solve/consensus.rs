//! Which captures agree, and which reading of each: consensus over minimal sets.
//!
//! A capture may offer several target poses: relabelings of a symmetric board, the two solutions
//! of a planar one. The robot decides. Triples of captures are drawn (without luck: the sequence
//! is fixed), every combination of their readings that the conjugation invariants allow is solved,
//! and each answer is judged on all captures by
//!
//! ```text
//! score = Σ_i min_over_readings log(1 + d_i²)        d² = (angle/σ_r)² + (distance/σ_t)²
//! ```
//!
//! of the loop `Y⁻¹ A X C`. The logarithm makes wrong captures cheap and needs no noise level.
//! A motion's rotation angle is the same for robot and camera (`A X = X B`): a combination whose
//! angles differ is not worth solving. The best answer is polished on the captures that agree, and
//! hardened by `graduated`.
//!
//! M. Fischler and R. Bolles, *Random sample consensus*, CACM 24(6), 1981.

use crate::{
    Anchor, Camera, Error, HandEye, Mount, Pose, PosePair, Target,
    math::{
        linalg::median,
        subsets::{self, Draw},
    },
    model::residual::Residual,
    solve::{
        self, FEWEST_POSES, Method, View, few_axes, graduated::graduated, half_turns,
        least_squares::fit_fixed_weights, motions,
    },
};

/// One capture with every reading of its image.
#[derive(Debug, Clone, PartialEq)]
pub struct Readings {
    /// Where the robot was.
    pub anchor_from_mount: Pose<Anchor, Mount>,
    /// Where the target may have been.
    pub camera_from_target: Vec<Pose<Camera, Target>>,
}

impl Readings {
    /// The capture with one of its readings.
    pub(crate) fn pair(&self, reading: usize) -> PosePair {
        PosePair {
            anchor_from_mount: self.anchor_from_mount,
            camera_from_target: self.camera_from_target[reading],
        }
    }
}

/// What most captures agree on.
#[derive(Debug, Clone, PartialEq)]
pub struct Consensus {
    /// The answer of the captures that agree.
    pub hand_eye: HandEye,
    /// Which reading of each capture fits best.
    pub reading: Vec<usize>,
    /// Whether that reading agrees with the others.
    pub agrees: Vec<bool>,
}

/// Angles of one motion, seen by robot and camera, that are still taken for the same. Images of
/// a tilted board are good to 3 degrees even when the lens is not calibrated. 8 degrees.
const SAME_ANGLE: f64 = 0.14;
/// Rotation that counts as one unit of residual in the score: 0.3 degrees.
const UNIT_ANGLE: f64 = 0.3 / 180.0 * std::f64::consts::PI;
/// Distance that counts as one unit of residual in the score, m.
const UNIT_DISTANCE: f64 = 2e-3;
/// Triples drawn; with 40 % wrong captures 20 are enough for one clean triple in 99 of 100 cases.
const DRAWS: usize = 200;
/// Combinations of readings solved per triple, best invariants first.
const MOST_COMBINATIONS: usize = 16;
/// Weight of rotation against translation in the local fits, m per rad.
const METRES_PER_RAD: f64 = 0.3;

/// Finds the largest agreement between captures.
///
/// # Errors
/// Fewer than three captures; none that agree; a robot that does not move. Rotations about one axis
/// only, or none, are no error here: the answer is one of those that fit.
pub fn consensus(captures: &[Readings]) -> Result<Consensus, Error> {
    let readable: Vec<usize> =
        (0..captures.len()).filter(|&i| !captures[i].camera_from_target.is_empty()).collect();
    let first: Vec<PosePair> = readable.iter().map(|&i| captures[i].pair(0)).collect();
    if first.len() < FEWEST_POSES {
        return Err(solve::too_few(first.len()));
    }
    let axes = motions::check_axes(&first);
    let mut best: Option<(f64, HandEye)> = None;
    for triple in triples(readable.len()) {
        let triple = triple.map(|k| readable[k]);
        for start in hypotheses(captures, triple, axes.is_ok()) {
            let score = score(captures, &start);
            if best.is_none_or(|(s, _)| score < s) {
                best = Some((score, start));
            }
        }
    }
    let (_, start) = best.ok_or_else(|| axes.err().unwrap_or_else(no_agreement))?;
    let polished = settle(captures, polish(captures, start)).0;
    let hardened = harden(captures, &polished.hand_eye);
    // on equal terms the first one stands
    let better = score(captures, &hardened) < SURELY_LESS * score(captures, &polished.hand_eye);
    Ok(if better { settle(captures, hardened).0 } else { polished })
}

/// Part of a score below which another one is less for more reasons than rounding.
const SURELY_LESS: f64 = 1.0 - 1e-6;

/// The answer of truncated least squares near one that is polished, at the noise that its median
/// residual tells.
fn harden(captures: &[Readings], hand_eye: &HandEye) -> HandEye {
    let (found, sigma) = settle(captures, *hand_eye);
    let readable = (0..captures.len()).filter(|&i| !captures[i].camera_from_target.is_empty());
    let views: Vec<View> =
        readable.map(|i| View::bare(captures[i].pair(found.reading[i]))).collect();
    graduated(&views, hand_eye, sigma, GATE)
}

fn no_agreement() -> Error {
    Error::NotDetermined {
        what: "no three captures agree on a camera pose: the robot's motions and the \
               camera's have different rotation angles. Are the images and the robot poses of \
               the same captures, in the same order, and the poses read in the right notation?"
            .into(),
    }
}

/// All triples of few captures, some of many.
fn triples(n: usize) -> Vec<[usize; 3]> {
    if subsets::count(n, 3) <= DRAWS {
        return subsets::all(n).collect();
    }
    subsets::drawn(n, DRAWS, Draw::DISTINCT).collect()
}

/// Answers of one triple, for the combinations of readings that its motions allow. Where the
/// rotations have fewer than two axes, one of the answers that fit.
fn hypotheses(captures: &[Readings], triple: [usize; 3], two_axes: bool) -> Vec<HandEye> {
    let [i, j, k] = triple.map(|c| &captures[c]);
    let mut allowed: Vec<(f64, [PosePair; 3])> = Vec::new();
    for a in 0..i.camera_from_target.len() {
        for b in 0..j.camera_from_target.len() {
            let (first, second) = (i.pair(a), j.pair(b));
            let Some(one) = angle_residual(&first, &second) else { continue };
            for c in 0..k.camera_from_target.len() {
                let third = k.pair(c);
                let (Some(two), Some(three)) =
                    (angle_residual(&first, &third), angle_residual(&second, &third))
                else {
                    continue;
                };
                allowed.push((one + two + three, [first, second, third]));
            }
        }
    }
    allowed.sort_by(|x, y| x.0.total_cmp(&y.0));
    allowed.truncate(MOST_COMBINATIONS);
    let answers = |(_, pairs): &(f64, [PosePair; 3])| -> Vec<HandEye> {
        if !two_axes {
            return few_axes::solve(pairs).into_iter().collect();
        }
        let shah = solve::solve(pairs, Method::Shah).ok();
        shah.into_iter().chain(half_turns::solve(pairs)).collect()
    };
    allowed.iter().flat_map(answers).collect()
}

/// By how much robot and camera disagree on the angle of one motion; `None` when beyond belief.
fn angle_residual(i: &PosePair, j: &PosePair) -> Option<f64> {
    let m = motions::motion(i, j);
    let residual = (m.a.rotation.angle() - m.b.rotation.angle()).abs();
    (residual < SAME_ANGLE).then_some(residual)
}

/// `d²` of one reading, in units of residual.
fn distance(hand_eye: &HandEye, pair: &PosePair) -> f64 {
    let e = hand_eye.loop_error(pair);
    (e.iso().rotation.angle() / UNIT_ANGLE).powi(2)
        + e.translation().norm_squared() / UNIT_DISTANCE.powi(2)
}

/// The reading that fits best, and its `d²`.
fn best_reading(capture: &Readings, hand_eye: &HandEye) -> Option<(usize, f64)> {
    (0..capture.camera_from_target.len())
        .map(|k| (k, distance(hand_eye, &capture.pair(k))))
        .min_by(|x, y| x.1.total_cmp(&y.1))
}

fn score(captures: &[Readings], hand_eye: &HandEye) -> f64 {
    captures.iter().filter_map(|c| best_reading(c, hand_eye)).map(|(_, d2)| d2.ln_1p()).sum()
}

/// Rounds of re-fitting to the captures that agree.
const ROUNDS: usize = 10;

/// Fits to the better half, then to all that agree, until nothing changes.
fn polish(captures: &[Readings], start: HandEye) -> HandEye {
    let mut hand_eye = start;
    let mut last = Vec::new();
    for round in 0..ROUNDS {
        let chosen = if round == 0 {
            better_half(captures, &hand_eye)
        } else {
            agreeing(captures, &hand_eye)
        };
        if chosen == last || chosen.len() < FEWEST_POSES {
            break;
        }
        let views: Vec<View> =
            chosen.iter().map(|&(i, k)| View::bare(captures[i].pair(k))).collect();
        hand_eye = fit_fixed_weights(&views, &hand_eye, METRES_PER_RAD);
        last = chosen;
    }
    hand_eye
}

fn better_half(captures: &[Readings], hand_eye: &HandEye) -> Vec<(usize, usize)> {
    let mut all: Vec<(usize, usize, f64)> = captures
        .iter()
        .enumerate()
        .filter_map(|(i, c)| best_reading(c, hand_eye).map(|(k, d2)| (i, k, d2)))
        .collect();
    all.sort_by(|x, y| x.2.total_cmp(&y.2));
    all.truncate((all.len() / 2 + 1).max(FEWEST_POSES));
    all.sort_unstable_by_key(|x| x.0);
    all.into_iter().map(|(i, k, _)| (i, k)).collect()
}

fn agreeing(captures: &[Readings], hand_eye: &HandEye) -> Vec<(usize, usize)> {
    let (found, _) = settle(captures, *hand_eye);
    (0..captures.len()).filter(|&i| found.agrees[i]).map(|i| (i, found.reading[i])).collect()
}

/// Residual, in robust standard deviations, beyond which a capture does not agree with the others.
/// Real robots and lenses have heavier tails than Gaussian noise, and a capture that is only
/// somewhat worse than the rest still informs: wrong ones are usually tens of these away.
const GATE: f64 = 7.0;
/// Least standard deviations that the gate assumes: rounding in stored poses. Per axis.
const LEAST: Residual = Residual { angle: 2e-4, distance: 1e-4 };

/// Chooses readings for a given answer and gates captures by the median residual; also the standard
/// deviations (per axis) that this tells.
fn settle(captures: &[Readings], hand_eye: HandEye) -> (Consensus, Residual) {
    let best: Vec<Option<(usize, f64)>> =
        captures.iter().map(|c| best_reading(c, &hand_eye)).collect();
    let parts: Vec<Option<Residual>> = captures
        .iter()
        .zip(&best)
        .map(|(c, b)| b.map(|(k, _)| hand_eye.loop_residual(&c.pair(k))))
        .collect();
    let sigma = |part: fn(&Residual) -> f64, least: f64| {
        // the median of a chi-distributed length with three degrees of freedom is 1.538 sigma;
        // few captures are fitted closer than they are (Rousseeuw and Leroy 1987, section 5.1)
        let lengths: Vec<f64> = parts.iter().flatten().map(part).collect();
        let few = 1.0 + 5.0 / (lengths.len() as f64 - 2.0).max(1.0);
        (few * median(lengths) / 1.538).max(least)
    };
    let sigma = Residual {
        angle: sigma(|r| r.angle, LEAST.angle),
        distance: sigma(|r| r.distance, LEAST.distance),
    };
    let agrees = |r: &Option<Residual>| r.is_some_and(|r| r.over(sigma) < GATE);
    let found = Consensus {
        hand_eye,
        reading: best.iter().map(|b| b.map_or(0, |(k, _)| k)).collect(),
        agrees: parts.iter().map(agrees).collect(),
    };
    (found, sigma)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::tests::{assert_same, exact_pairs, pose, truths};
    use std::f64::consts::PI;

    /// Exact captures whose image may also be read turned by half a turn about the board's
    /// middle; the wrong reading comes first in every third capture.
    fn symmetric(count: usize) -> Vec<Readings> {
        let turned: Pose<Target, Target> = pose([0.2, 0.15, 0.0], [0.0, 0.0, PI]);
        exact_pairs(&truths()[0], count)
            .iter()
            .enumerate()
            .map(|(i, p)| {
                let mut readings = vec![p.camera_from_target, p.camera_from_target * turned];
                if i % 3 == 1 {
                    readings.swap(0, 1);
                }
                Readings { anchor_from_mount: p.anchor_from_mount, camera_from_target: readings }
            })
            .collect()
    }

    #[test]
    fn half_turns_of_the_board_are_resolved_by_the_robot() {
        let found = consensus(&symmetric(12)).unwrap();
        assert!(found.agrees.iter().all(|a| *a));
        assert_same(found.hand_eye.mount_from_camera, truths()[0].mount_from_camera, "X");
        let first = found.reading[0];
        for (i, reading) in found.reading.iter().enumerate() {
            assert_eq!((reading + usize::from(i % 3 == 1)) % 2, first, "capture {i}");
        }
    }

    #[test]
    fn captures_a_half_turn_apart_agree() {
        for truth in truths() {
            let readings = |p: &PosePair| Readings {
                anchor_from_mount: p.anchor_from_mount,
                camera_from_target: vec![p.camera_from_target],
            };
            let captures: Vec<Readings> =
                half_turns::tests::half_turns(&truth).iter().map(readings).collect();
            let found = consensus(&captures).unwrap();
            assert!(found.agrees.iter().all(|a| *a));
            assert_same(found.hand_eye.mount_from_camera, truth.mount_from_camera, "X");
        }
    }

    #[test]
    fn exchanged_captures_do_not_agree() {
        let mut captures = symmetric(15);
        for c in &mut captures {
            c.camera_from_target.truncate(1);
        }
        let mut captures: Vec<Readings> =
            captures.into_iter().enumerate().filter(|(i, _)| i % 3 != 1).map(|(_, c)| c).collect();
        let swapped = captures[2].camera_from_target.clone();
        captures[2].camera_from_target = captures[7].camera_from_target.clone();
        captures[7].camera_from_target = swapped;
        let found = consensus(&captures).unwrap();
        let wrong: Vec<usize> = (0..captures.len()).filter(|&i| !found.agrees[i]).collect();
        assert_eq!(wrong, [2, 7]);
        assert_same(found.hand_eye.mount_from_camera, truths()[0].mount_from_camera, "X");
    }

    #[test]
    fn captures_in_a_wrong_order_agree_on_nothing() {
        let mut captures = symmetric(8);
        let last = captures[7].anchor_from_mount;
        for i in (1..8).rev() {
            captures[i].anchor_from_mount = captures[i - 1].anchor_from_mount;
        }
        captures[0].anchor_from_mount = last;
        let agreed = consensus(&captures).map(|c| c.agrees.iter().filter(|a| **a).count());
        assert!(agreed.is_err() || agreed.is_ok_and(|n| n < 5));
    }
}
