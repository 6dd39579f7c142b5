//! Whether something moved during the session: captures that disagree as one block, and a step or a slow slip in those
//! that agree.
//!
//! Captures come in the order in which they were taken. A movement by a twist `δ`, of the camera or of the target,
//! moves the residuals of the captures before it,
//!
//! ```text
//! r_i ≈ s_i J_i δ        s_i = 1 before a step, and 0 after; falling evenly from 1 to 0 for a slip
//! ```
//!
//! with `J_i` the Jacobian by the camera's or the target's pose, so that `X` is where the camera is at the end. Each
//! hypothesis is one linear fit beside that without movement, each with its own noise `s` of rotations and positions;
//! they are weighed by their restricted likelihood, and the error of the answer is widened by how far it would be off
//! under each,
//!
//! ```text
//! w_m ∝ π_m |N_m|^(-1/2) Π s^(-3n)        e² = Σ w_m |X_m - X_0|²
//! ```
//!
//! Captures that were rejected one after the other and agree on one displacement may be right: the camera or the target
//! moved, or the robot errs at that place. The stated error then reaches as far.

mod linear;

use nalgebra::{Cholesky, Matrix6, SMatrix, SymmetricEigen, Vector3, Vector6};

use super::masked::IMPROBABLE;
use crate::{
    Anchor, Mount, Pose,
    calibrate::{
        flow::{evidence::Evidence, limits::VERY_MANY, views::Captures},
        result::{matrix, rows},
    },
    estimate::JointFit,
    findings::movement::{Movement, MovementKind},
    math::{lie, linalg::root_mean, statistics},
    register::rigid_fit::point_jacobian,
    solve::{consensus::Consensus, least_squares},
};

pub(super) use linear::PRIOR;
pub(crate) use linear::Row;
use linear::{SIDES, Side, Sums, Used, Weighed, linear, weighed};

/// Fewest captures one after the other that are a block.
const FEWEST_IN_BLOCK: usize = 3;
/// Fewest captures that tell a movement from noise.
const FEWEST: usize = 8;
/// A movement is named from this probability on.
pub(super) const NAMED: f64 = 0.95;
/// A rotation counts against a position by this lever when neighbours are looked for, m.
const LEVER: f64 = 0.3;
/// A block whose captures have their nearest neighbour in the block this often lies at a place of its own.
const OF_ITS_OWN: f64 = 0.8;
/// Captures that follow one another by at most this part of all are taken shortly after one another.
const SHORTLY: usize = 12;
/// A session in which the nearest capture was taken shortly before or after this often went from place to place.
const IN_ORDER: f64 = 0.5;

/// A movement that captures agree on is at most about as large, per axis: rad and m alike.
const MOST: f64 = 0.1;

/// The 95 % point over its root mean square, of how far an answer is off that was moved by a twist.
pub(super) const WIDE: f64 = 1.6;

/// The captures of a session in their order, as one answer sees them.
pub(crate) struct Recorded<'a> {
    pub names: Vec<&'a str>,
    pub poses: Vec<Pose<Anchor, Mount>>,
    pub agrees: Vec<bool>,
    /// Of captures that show the target.
    pub rows: Vec<Option<Row>>,
    /// Equations that a capture has: six of a pose, three of a point.
    pub equations: usize,
    pub degrees_of_freedom: f64,
}

/// A movement that may have been, and what it does to the camera's pose.
pub(crate) struct Suspected {
    pub(crate) movement: Movement,
    /// Mean square of how far the pose of the camera from views alone would be off (rad and m, perturbed on the
    /// right).
    spread: Matrix6<f64>,
    /// What the views say of that pose.
    information: Matrix6<f64>,
    /// Where the camera saw the target, in its own frame.
    pub(crate) seen: Vec<Vector3<f64>>,
}

/// Looks for movement; `None` where nothing points to it and nothing has to be widened.
pub(crate) fn suspected(
    captures: &Captures,
    found: &Consensus,
    fit: &JointFit,
) -> Option<Suspected> {
    let nearest = |i: usize| {
        let all = (0..captures.readings[i].camera_from_target.len())
            .filter(|k| !found.agrees[i] || *k == found.reading[i])
            .filter_map(|k| row(captures, fit, i, k));
        all.min_by(|a, b| a.residual.norm().total_cmp(&b.residual.norm()))
    };
    suspected_in(&Recorded {
        names: captures.session.observations.iter().map(|o| o.capture.as_str()).collect(),
        poses: captures.readings.iter().map(|r| r.anchor_from_mount).collect(),
        agrees: found.agrees.clone(),
        rows: (0..found.agrees.len()).map(nearest).collect(),
        equations: 6,
        degrees_of_freedom: fit.degrees_of_freedom,
    })
}

/// The same of captures that are linearised already.
pub(crate) fn suspected_in(recorded: &Recorded) -> Option<Suspected> {
    let (movement, spread) = block(recorded).or_else(|| gradual(recorded))?;
    let rows = recorded.agreeing();
    let information = of_camera(&rows)?;
    Some(Suspected { movement, spread, information, seen: rows.iter().map(|r| r.1.seen).collect() })
}

impl Recorded<'_> {
    /// Captures that agree, and which they are.
    fn agreeing(&self) -> Vec<Used<'_>> {
        let seen = self.rows.iter().enumerate().filter(|(i, _)| self.agrees[*i]);
        seen.filter_map(|(i, row)| Some((i, row.as_ref()?))).collect()
    }
}

impl Suspected {
    /// The mean square of how far the answer would be off, of which views are one part: what else it rests on did not
    /// move. `stated` is its covariance.
    pub(crate) fn beside(&self, stated: &Matrix6<f64>) -> Option<Matrix6<f64>> {
        let root = Cholesky::new(*stated)?.l();
        let shares = SymmetricEigen::new(root.transpose() * self.information * root);
        let most = Matrix6::from_diagonal(&shares.eigenvalues.map(|share| share.clamp(0.0, 1.0)));
        let by_views = root * shares.eigenvectors * most * shares.eigenvectors.transpose();
        let off = by_views * root.try_inverse()?;
        Some(off * self.spread * off.transpose())
    }
}

/// What captures say of the camera's pose, whatever the target's is.
fn of_camera(rows: &[Used]) -> Option<Matrix6<f64>> {
    let normal: SMatrix<f64, 12, 12> =
        rows.iter().map(|(_, r)| r.jacobian.transpose() * r.jacobian).sum();
    let part = |i, j| normal.fixed_view::<6, 6>(i, j).into_owned();
    let of_target = Cholesky::new(part(6, 6))?;
    Some(part(0, 0) - part(0, 6) * of_target.solve(&part(6, 0)))
}

fn row(captures: &Captures, fit: &JointFit, i: usize, reading: usize) -> Option<Row> {
    let view = captures.view(i, reading);
    let (r, j) = least_squares::residual_with_jacobian(&fit.hand_eye, &view.pair);
    let covariance = fit.noise.covariance(&view, &fit.hand_eye, captures.session.setup);
    let root = Cholesky::new(covariance)?.l();
    Some(Row {
        residual: root.solve_lower_triangular(&r)?,
        jacobian: root.solve_lower_triangular(&j)?,
        seen: view.pair.camera_from_target.translation(),
    })
}

/// Captures left out one after the other that agree with one another, and the square of what they are displaced by.
fn block(recorded: &Recorded) -> Option<(Movement, Matrix6<f64>)> {
    let agrees = &recorded.agrees;
    let seen: Vec<usize> = (0..agrees.len()).filter(|&i| recorded.rows[i].is_some()).collect();
    let runs = seen.chunk_by(|&a, &b| agrees[a] == agrees[b]);
    let longest = runs.filter(|run| !agrees[run[0]]).max_by_key(|run| run.len())?;
    if longest.len() < FEWEST_IN_BLOCK {
        return None;
    }
    let rows: Vec<&Row> = longest.iter().filter_map(|&i| recorded.rows[i].as_ref()).collect();
    let explained: Vec<(Side, Vector6<f64>)> =
        SIDES.into_iter().filter_map(|side| Some((side, common(&rows, side, recorded)?))).collect();
    let &(side, delta) = explained.first()?;
    let at_end = longest.last() == seen.last();
    let at_a_place = is_at_a_place(&recorded.poses, longest, &seen);
    let name = |i: usize| recorded.names[i].to_owned();
    let distance = match side {
        Side::Camera => {
            root_mean(rows.iter().map(|row| displaced(&delta, &row.seen).powi(2))).unwrap_or(0.0)
        }
        Side::Target => lie::nu(&delta).norm(),
    };
    let other = |s: Side| explained.iter().any(|(side, _)| *side == s);
    let movement = Movement {
        kind: MovementKind::Block,
        camera: other(Side::Camera),
        target: other(Side::Target),
        first: name(*longest.first()?),
        last: name(*longest.last()?),
        at_end,
        at_a_place,
        displacement_mm: distance * 1e3,
        rotation_deg: lie::omega(&delta).norm().to_degrees(),
        probability: 1.0,
        widened_mm: 0.0,
    };
    let spread = if other(Side::Camera) {
        delta * delta.transpose()
    } else if at_a_place {
        in_any_direction(&delta)
    } else {
        // the target moved: where the camera sits does not depend on it
        Matrix6::zeros()
    };
    Some((movement, spread))
}

/// The square of a displacement as large in whichever direction: what a robot errs by at a place, a tool there misses.
fn in_any_direction(delta: &Vector6<f64>) -> Matrix6<f64> {
    let (turn, way) = (lie::omega(delta).norm_squared() / 3.0, lie::nu(delta).norm_squared() / 3.0);
    Matrix6::from_diagonal(&Vector6::new(turn, turn, turn, way, way, way))
}

/// The displacement on which captures agree within their noise.
fn common(rows: &[&Row], side: Side, recorded: &Recorded) -> Option<Vector6<f64>> {
    let mut normal = Matrix6::identity() * MOST.powi(-2);
    let mut right = Vector6::zeros();
    for row in rows {
        let j = row.by(side);
        normal += j.transpose() * j;
        right += j.transpose() * row.residual;
    }
    let delta = -(Cholesky::new(normal)?.solve(&right));
    let left: f64 = rows.iter().map(|r| (r.residual + r.by(side) * delta).norm_squared()).sum();
    let equations = (recorded.equations * (rows.len() - 1)) as f64;
    let chance =
        statistics::of_f(left / equations, (equations, recorded.degrees_of_freedom.max(1.0)));
    (chance > IMPROBABLE).then_some(delta)
}

/// Whether robot poses of a block lie among themselves, and not between the others.
fn is_at_a_place(poses: &[Pose<Anchor, Mount>], block: &[usize], seen: &[usize]) -> bool {
    let own = |i: &&usize| nearest(poses, **i, seen).is_some_and(|j| block.contains(&j));
    block.iter().filter(own).count() as f64 >= OF_ITS_OWN * block.len() as f64
}

/// Whether the robot went from place to place, so that what changes with time changes with place as well: the capture
/// that lies nearest was taken shortly before or after.
fn is_in_order_of_place(poses: &[Pose<Anchor, Mount>], seen: &[usize]) -> bool {
    let shortly = (seen.len() / SHORTLY).max(1);
    let soon = |(k, i): &(usize, &usize)| {
        nearest(poses, **i, seen)
            .and_then(|near| seen.iter().position(|j| *j == near))
            .is_some_and(|other| other.abs_diff(*k) <= shortly)
    };
    // of very many, some tell it
    let asked: Vec<(usize, &usize)> =
        seen.iter().enumerate().step_by(seen.len().div_ceil(VERY_MANY)).collect();
    asked.iter().filter(|asked| soon(asked)).count() as f64 >= IN_ORDER * asked.len() as f64
}

/// The capture whose robot pose lies nearest.
fn nearest(poses: &[Pose<Anchor, Mount>], i: usize, seen: &[usize]) -> Option<usize> {
    let apart = |j: usize| {
        let (a, b) = (&poses[i], &poses[j]);
        a.distance_to(b).hypot(LEVER * a.angle_to(b))
    };
    let others = seen.iter().copied().filter(|j| *j != i);
    others.min_by(|a, b| apart(*a).total_cmp(&apart(*b)))
}

/// How far a displacement of the camera moves where it saw the target, m.
pub(super) fn displaced(delta: &Vector6<f64>, seen: &Vector3<f64>) -> f64 {
    (lie::omega(delta).cross(seen) + lie::nu(delta)).norm()
}

/// A step or a slip in the captures that agree, and the mean square of what it displaces the camera's pose by.
fn gradual(recorded: &Recorded) -> Option<(Movement, Matrix6<f64>)> {
    let rows = &recorded.agreeing();
    let n = rows.len();
    if n < FEWEST {
        return None;
    }
    let sums = Sums::of(rows, |_| 1.0);
    let still = linear(n, &sums, None)?;
    let all = weighed(rows, &sums, &still);
    let none = (1.0 - PRIOR).ln();
    let most = all.iter().map(|w| w.0).fold(none, f64::max);
    let sum = (none - most).exp() + all.iter().map(|w| (w.0 - most).exp()).sum::<f64>();
    let weight = |log: f64| (log - most).exp() / sum;
    let spread = |(log, _, fit): &Weighed| {
        let by = Vector6::from_fn(|k, _| fit.solution[k] - still.solution[k]);
        by * by.transpose() * weight(*log)
    };
    let probability = all.iter().map(|w| weight(w.0)).sum::<f64>();
    let side = |s: Side| {
        all.iter().filter(|w| w.1.side == s).map(|w| weight(w.0)).sum::<f64>()
            > (1.0 - NAMED) * probability
    };
    let (_, best, of_best) = all.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    let delta = Vector6::from_fn(|k, _| of_best.solution[12 + k]);
    let distance = match best.side {
        Side::Camera => root_mean(rows.iter().map(|(_, row)| displaced(&delta, &row.seen).powi(2)))
            .unwrap_or(0.0),
        Side::Target => lie::nu(&delta).norm(),
    };
    let name = |k: usize| recorded.names[rows[k].0].to_owned();
    let seen: Vec<usize> = rows.iter().map(|row| row.0).collect();
    let movement = Movement {
        kind: if best.step.is_some() { MovementKind::Step } else { MovementKind::Slip },
        camera: side(Side::Camera),
        target: side(Side::Target),
        first: name(best.step.unwrap_or(0)),
        last: name(n - 1),
        at_end: true,
        at_a_place: is_in_order_of_place(&recorded.poses, &seen),
        displacement_mm: distance * 1e3,
        rotation_deg: lie::omega(&delta).norm().to_degrees(),
        probability,
        widened_mm: 0.0,
    };
    Some((movement, all.iter().map(spread).sum()))
}

/// The stated error widened by what the movement leaves open, and the movement where it is probable.
pub(crate) fn covered(found: Suspected, mut evidence: Evidence) -> Evidence {
    let mut movement = found.movement.clone();
    if let Some(choice) = &mut evidence.choice {
        let stated = &mut choice.hand_eye.covariance.mount_from_camera;
        if let Some(own) = stated.as_ref().map(matrix)
            && let Some(spread) = found.beside(&own)
        {
            let squares = found.seen.iter().map(|p| {
                let j = point_jacobian(p);
                (j * spread * j.transpose()).trace()
            });
            movement.widened_mm = root_mean(squares).unwrap_or(0.0) * 1e3;
            *stated = Some(rows(&(own + spread)));
        }
        choice.predicted_tre_mm =
            choice.predicted_tre_mm.take().map(|tre| tre.widened(movement.widened_mm, WIDE));
    }
    let movement = (movement.probability >= NAMED).then_some(movement);
    Evidence { movement, ..evidence }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::*;
    use crate::{
        Base, Calibration, Config, Flange, Session, Setup, Verdict, calibrate, simulate::Cell,
    };
    use nalgebra::{Isometry3, Vector3};

    const SETUP: Setup = Setup::EyeToHand;

    /// A cell whose camera moves by a share of `mm` (m: mm/1000) in the captures before its end.
    fn moving(
        seed: u64,
        mm: f64,
        share: impl Fn(usize, usize) -> f64,
    ) -> (Session, Pose<crate::Mount, crate::Camera>) {
        let cell = Cell { touches: 0, ..Cell::new(SETUP, seed) };
        let (mut session, truth) = cell.session(seed).unwrap();
        let n = session.observations.len();
        for (k, o) in session.observations.iter_mut().enumerate() {
            let by = Vector3::new(0.6, -0.64, 0.48) * (mm * 1e-3 * share(k, n));
            // the base moves against the camera
            let moved = Isometry3::new(by, Vector3::zeros()) * o.base_from_flange.iso();
            o.base_from_flange = Pose::<Base, Flange>::claim(moved);
        }
        (session, truth.hand_eye.mount_from_camera)
    }

    fn found(seed: u64, mm: f64, share: impl Fn(usize, usize) -> f64) -> (Calibration, f64) {
        let (session, truth) = moving(seed, mm, share);
        let found = calibrate(&session, &Config::default()).unwrap();
        let off = found.hand_eye.mount_from_camera.unwrap().distance_to(&truth) * 1e3;
        (found, off)
    }

    fn halfway(k: usize, n: usize) -> f64 {
        f64::from(u8::from(2 * k >= n))
    }

    #[test]
    fn what_stands_still_is_not_said_to_move() {
        for seed in 0..12 {
            let (found, _) = found(seed, 0.0, |_, _| 0.0);
            assert_eq!(found.movement, None, "seed {seed}");
            assert_eq!(found.verdict, Verdict::Accepted);
        }
    }

    #[test]
    fn after_a_bump_the_answer_is_where_the_camera_is_now() {
        for seed in 0..6 {
            // before the bump all is shifted against the truth, after it nothing
            let (found, off) = found(seed, 8.0, |k, n| 1.0 - halfway(k, n));
            let said = found.warnings.iter().any(|w| w.code == "camera-moved")
                || found.verdict == Verdict::Rejected;
            assert!(said, "seed {seed}: {:?}", found.warnings);
            if found.verdict == Verdict::Accepted {
                assert!(
                    off < found.predicted_tre_mm.as_ref().unwrap().p95 * 1.5,
                    "seed {seed}: {off}"
                );
                assert!(found.captures.len() > found.captures.iter().filter(|c| c.used).count());
            }
        }
    }

    #[test]
    fn touches_from_before_a_bump_do_not_hold_the_answer_back() {
        for seed in 0..6 {
            let cell = Cell { captures: 18, ..Cell::new(SETUP, seed) };
            let (mut session, truth) = cell.session(seed).unwrap();
            let by = Isometry3::translation(3e-3, -3.2e-3, 2.4e-3);
            for o in &mut session.observations[10..] {
                o.base_from_flange = Pose::<Base, Flange>::claim(by * o.base_from_flange.iso());
            }
            let found = calibrate(&session, &Config::default()).unwrap();
            let now = Pose::claim(by * truth.hand_eye.mount_from_camera.iso());
            if found.verdict == Verdict::Accepted {
                let off = found.hand_eye.mount_from_camera.unwrap().distance_to(&now) * 1e3;
                let stated = found.predicted_tre_mm.as_ref().unwrap().p95;
                assert!(off < 1.5 * stated, "seed {seed}: {off} {stated} {:?}", found.warnings);
                let is_of_the_end = found.warnings.iter().any(|w| w.code == "camera-moved");
                assert!(!is_of_the_end || found.touches.iter().all(|t| !t.used), "seed {seed}");
            }
        }
    }

    #[test]
    fn a_slip_is_named_and_covered() {
        for seed in 0..6 {
            let (found, off) = found(seed, 4.0, |k, n| 1.0 - k as f64 / (n - 1) as f64);
            let moved = found.movement.as_ref().unwrap();
            assert!(moved.camera && moved.probability > NAMED, "seed {seed}: {moved:?}");
            assert!(off < found.predicted_tre_mm.as_ref().unwrap().p95 * 1.5, "seed {seed}: {off}");
        }
    }
}
