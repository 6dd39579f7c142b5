//! Touches that cannot be of the corners they name.
//!
//! The views say where every touched corner is, up to their own uncertainty and the tool tip's
//! offset, which is one for all. The offset on which most touches agree is looked for, each touch
//! proposing its own; the others touched something else. Where fewer than two thirds agree, either
//! the touches are wrong or the views are, and no answer can be trusted.
//!
//! This is the first of two gates: it has the images alone, before touches enter the fit. Finer outliers are rejected in
//! `views_and_touches.rs`, each by a fit of everything else.

use nalgebra::{Matrix3, Vector3};

use super::touched_boards::Boards;
use crate::{
    TargetModel,
    calibrate::flow::{notes::Notes, views::Views},
    estimate::{JointFit, Problem, TouchedBoard},
    findings::TouchFinding,
    math::linalg::{self, median},
};

/// Largest offset of a tip that is still taken for one, m.
const LARGEST_TIP: f64 = 60e-3;
/// What touching, tip and robot may add to the views' uncertainty, m per axis.
const SLACK: f64 = 2e-3;
/// Squared distance, three axes, beyond which a touch does not agree.
const AGREES: f64 = 25.0;

/// Median distance (m) between touches and views that no wrong corner makes.
const ELSEWHERE: f64 = 1.0;

/// One touch against what the views expect.
struct Expected {
    /// Its place in the session.
    touch: usize,
    /// Where it was touched minus where the views put the corner, in the base (m).
    residual: Vector3<f64>,
    /// Rotation of the flange; of the base where no flange was recorded.
    flange: Matrix3<f64>,
    /// Weight of the residual: the inverse of its covariance.
    weight: Matrix3<f64>,
}

impl Expected {
    fn distance(&self, tip: &Vector3<f64>) -> f64 {
        let r = self.residual + self.flange * tip;
        r.dot(&(self.weight * r))
    }
}

/// What does not agree.
pub(crate) struct WrongTouches {
    /// Touches of the session to leave out; where most contradict the views, all.
    pub which: Vec<usize>,
    /// What is said of each touch, or of all.
    pub notes: Notes,
}

/// Looks for wrong touches, by views alone: single ones, and all of them where fewer than two thirds agree.
pub(crate) fn find(
    views: &Views,
    boards: &Boards,
    problem: &Problem,
    fit: &JointFit,
) -> WrongTouches {
    let mut found = WrongTouches { which: vec![], notes: Notes::default() };
    let Some(target) = &views.session.target else { return found };
    let all = expected(boards, problem, fit);
    let (tip, agreeing) = consensus(&all);
    if agreeing == all.len() {
        return found;
    }
    let session = views.session;
    let outside = all.iter().filter(|e| !agrees(e, &tip));
    if 3 * agreeing >= 2 * all.len() {
        for e in outside {
            let touch = &session.touches[e.touch];
            let off = (e.residual + e.flange * tip).norm() * 1e3;
            let partner = exchanged(e, boards, &all, problem, fit, &tip);
            let finding = TouchFinding::Misplaced {
                corner: touch.corner,
                placement: touch.placement.clone(),
                off_mm: off,
                exchanged_with: partner.map(|k| session.touches[k].corner),
            };
            found.notes.note(finding);
            found.which.push(e.touch);
        }
        return found;
    }
    let off = median(all.iter().map(|e| e.residual.norm()));
    let answer = if let Some(how) = in_other_units(boards, problem, fit, all.len()) {
        how
    } else if let Some(how) = renamed(boards, target, problem, fit, all.len()) {
        format!("{how}: correct the corner ids of the touches")
    } else if off > ELSEWHERE {
        "check the length unit of [touches], the same for every column, and that they are in the \
         robot's base"
            .into()
    } else {
        "check corner ids and frame of the touches, and which placement each belongs to".into()
    };
    let off_mm = off * 1e3;
    found.notes = Notes::against(TouchFinding::Misread { answer, agreeing, of: all.len(), off_mm });
    found.which = all.iter().map(|e| e.touch).collect();
    found
}

impl WrongTouches {
    /// The boards without these touches.
    pub(crate) fn remove_from(&self, boards: &mut Boards) {
        for (board, touches) in boards.boards.iter_mut().zip(&mut boards.touches) {
            let keep: Vec<bool> = touches.iter().map(|k| !self.which.contains(k)).collect();
            let mut keeps = keep.iter();
            board.corners.retain(|_| *keeps.next().unwrap_or(&true));
            let mut keeps = keep.iter();
            touches.retain(|_| *keeps.next().unwrap_or(&true));
        }
        let touched: Vec<bool> = boards.touches.iter().map(|t| !t.is_empty()).collect();
        let mut some = touched.iter();
        boards.boards.retain(|_| *some.next().unwrap_or(&true));
        boards.touches.retain(|t| !t.is_empty());
    }
}

fn expected(boards: &Boards, problem: &Problem, fit: &JointFit) -> Vec<Expected> {
    let mut all = vec![];
    for (board, touches) in boards.boards.iter().zip(&boards.touches) {
        let Some(expectations) = fit.expected_touches(problem, board) else { continue };
        for ((corner, &touch), (residual, covariance)) in
            board.corners.iter().zip(touches).zip(expectations)
        {
            let spread = covariance + Matrix3::identity() * SLACK.powi(2);
            let Some(weight) = linalg::invert_spd(&spread) else { continue };
            let flange = corner.base_from_flange.map_or_else(Matrix3::identity, |f| f.rotation());
            all.push(Expected { touch, residual, flange, weight });
        }
    }
    all
}

fn agrees(e: &Expected, tip: &Vector3<f64>) -> bool {
    e.distance(tip) < AGREES
}

/// The offset of the tip on which most touches agree, and how many; of equals the smallest.
fn consensus(all: &[Expected]) -> (Vector3<f64>, usize) {
    let count = |tip: &Vector3<f64>| all.iter().filter(|e| agrees(e, tip)).count();
    let proposals = all.iter().map(|e| -(e.flange.transpose() * e.residual));
    let zero = (Vector3::zeros(), count(&Vector3::zeros()));
    proposals.filter(|tip| tip.norm() < LARGEST_TIP).fold(zero, |best, tip| {
        let agreeing = count(&tip);
        let nearer = agreeing == best.1 && tip.norm() < best.0.norm();
        if agreeing > best.1 || nearer { (tip, agreeing) } else { best }
    })
}

/// The touch of the same board that fits this one's corner, while this one fits its.
fn exchanged(
    e: &Expected,
    boards: &Boards,
    all: &[Expected],
    problem: &Problem,
    fit: &JointFit,
    tip: &Vector3<f64>,
) -> Option<usize> {
    let b = boards.touches.iter().position(|t| t.contains(&e.touch))?;
    let own = boards.touches[b].iter().position(|k| *k == e.touch)?;
    let wrong = |k: &usize| all.iter().any(|o| o.touch == *k && !agrees(o, tip));
    boards.touches[b].iter().enumerate().find_map(|(other, k)| {
        if other == own || !wrong(k) {
            return None;
        }
        let mut board = boards.boards[b].clone();
        let (mine, theirs) = (board.corners[own].in_target, board.corners[other].in_target);
        (board.corners[own].in_target, board.corners[other].in_target) = (theirs, mine);
        let swapped = Boards { boards: vec![board], touches: vec![boards.touches[b].clone()] };
        let both = expected(&swapped, problem, fit);
        (agrees(both.get(own)?, tip) && agrees(both.get(other)?, tip)).then_some(*k)
    })
}

/// Units of length, m.
const UNITS: [(&str, f64); 4] = [("m", 1.0), ("cm", 1e-2), ("mm", 1e-3), ("inch", 25.4e-3)];

/// The unit of the touches, or of the tool's tip, with which two thirds of the touches agree, in words.
fn in_other_units(
    boards: &Boards,
    problem: &Problem,
    fit: &JointFit,
    count: usize,
) -> Option<String> {
    let agreeing = |of_flange: f64, of_tip: f64| {
        let resized = |board: &TouchedBoard| {
            let mut board = board.clone();
            for corner in &mut board.corners {
                let flange = corner.base_from_flange.map_or(Vector3::zeros(), |f| f.translation());
                let tip = corner.in_base - flange;
                corner.in_base = match corner.base_from_flange {
                    Some(_) => flange * of_flange + tip * of_tip,
                    None => corner.in_base * of_flange,
                };
                corner.base_from_flange = corner.base_from_flange.map(|f| f.farther(of_flange));
            }
            board
        };
        let boards = Boards {
            boards: boards.boards.iter().map(resized).collect(),
            touches: boards.touches.clone(),
        };
        consensus(&expected(&boards, problem, fit)).1
    };
    let enough = |agreeing: usize| 3 * agreeing >= 2 * count;
    let pairs = UNITS.into_iter().flat_map(|read| UNITS.map(|meant| (read, meant)));
    let others = pairs.filter(|(read, meant)| read.0 != meant.0);
    let best = others
        .map(|(read, meant)| (agreeing(meant.1 / read.1, 1.0), read.0, meant.0))
        .reduce(|best, next| if next.0 > best.0 { next } else { best })?;
    if enough(best.0) {
        let (_, read, meant) = best;
        return Some(format!(
            "the touches agree if their unit is {meant}, not {read}: correct length_unit of [touches]"
        ));
    }
    enough(agreeing(1.0, 1e3)).then(|| {
        "in_flange_mm of [touches.tip] seems to be in metres (multiplied by 1000, the touches agree): give it in millimetres"
            .into()
    })
}

/// A way of counting corners, in words, and the right id of a corner counted so.
type Way<'a> = (&'static str, &'a dyn Fn(u32) -> Option<u32>);

/// A way of counting the corners with which two thirds of the touches agree.
fn renamed(
    boards: &Boards,
    target: &TargetModel,
    problem: &Problem,
    fit: &JointFit,
    count: usize,
) -> Option<&'static str> {
    let (columns, rows) = target.grid();
    let last = (columns * rows).checked_sub(1)?;
    let by_columns = |id: u32| Some((id % rows) * columns + id / rows);
    let other_way = |id: u32| Some(id / columns * columns + (columns - 1 - id % columns));
    let ways: [Way; 5] = [
        ("the board is rotated by 180 degrees against the ids of the touches", &|id| {
            last.checked_sub(id)
        }),
        ("the corners are counted from 1, and ids count from 0", &|id| id.checked_sub(1)),
        ("the corner ids of the touches are one too small", &|id| Some(id + 1)),
        ("the corners are counted column by column, and ids count row by row", &by_columns),
        ("the columns are counted from the other side of the board", &other_way),
    ];
    let reference = target.reference().vector();
    let id_of = |p: &Vector3<f64>| {
        (0..=last).find(|id| {
            target.corner(*id).is_some_and(|c| (c.vector() - reference - p).norm() < 1e-9)
        })
    };
    ways.into_iter().find_map(|(name, way)| {
        let rename = |board: &TouchedBoard| {
            let mut board = board.clone();
            for corner in &mut board.corners {
                let id = way(id_of(&corner.in_target)?)?;
                corner.in_target = target.corner(id)?.vector() - reference;
            }
            Some(board)
        };
        let renamed: Option<Vec<TouchedBoard>> = boards.boards.iter().map(rename).collect();
        let all =
            expected(&Boards { boards: renamed?, touches: boards.touches.clone() }, problem, fit);
        (3 * consensus(&all).1 >= 2 * count).then_some(name)
    })
}
