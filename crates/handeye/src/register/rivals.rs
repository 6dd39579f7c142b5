//! Answers that other starts lead to, and which of them the scans speak for.
//!
//! A round of matching leads down from its start to the nearest answer, right or wrong, and its residuals
//! do not tell which: a block that came to lie beside its like is left out as if it were something else.
//! So starts around the given one are tried over few windows, and each answer is judged by all that the
//! scans say: a window that lies on the other surface speaks for it, one that would have hidden what the
//! other camera saw, or lies close beside a surface but not on it, against.

use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};

use super::{
    descent::{Descent, FEWEST, Reached},
    pair::LEAST,
    patch::Patch,
    surface::Surface,
};
use crate::{Error, math::parallel, register::options::DenseConfig};

/// Windows that are looked at first, from every start.
const TRIED: f64 = 500.0;
/// Times as many are judged.
const JUDGED: f64 = 3.0;
/// An answer is clearly better than another by so many standard deviations.
const CLEARLY: f64 = 6.0;
/// An answer that moves a window by more than so many times the gate is another start's.
const FARTHEST: f64 = 3.0;
/// Answers are improved by matches within so many times the spread of a window.
const NEARBY: f64 = 3.0;
/// From so many standard deviations on, it is doubted that a window lies on a surface; one more is neither for nor
/// against.
const DOUBTED: f64 = 2.0;
/// Beside a cloud's surface is within so many times the spread of a window.
const BESIDE: f64 = 1.0;
/// Fronts are the same where at least this share of the windows says so.
const ALIKE: f64 = 0.9;
/// Normals on a surface agree within 30 degrees.
const COSINE: f64 = 0.866;

/// What each window says of an answer: up to 1 for it, -1 against, 0 nothing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Opinions(Vec<f64>);

impl Opinions {
    /// Of about so many windows of each scan, which scatter `sigma` times as much as their points promise.
    pub fn of(descent: &Descent, at: &Isometry3<f64>, count: f64, sigma: f64) -> Self {
        let (source, target) = (descent.source, descent.target);
        let scale = sigma.max(1.0).powi(2);
        let fronts = Fronts::of(source, target, at, scale);
        let there = Sight::new(source, target, at, fronts);
        let back = Sight::new(target, source, &at.inverse(), fronts);
        let opinions = |sight: &Sight| -> Vec<f64> {
            sight.windows(count).map(|own| sight.opinion(own, scale)).collect()
        };
        Self([opinions(&there), opinions(&back)].concat())
    }

    pub fn sum(&self) -> f64 {
        self.0.iter().sum()
    }

    /// Share of those that say something that speak for it.
    pub(crate) fn agreeing(&self) -> f64 {
        let said = self.0.iter().filter(|c| **c != 0.0).count();
        let agreed = self.0.iter().filter(|c| **c > 0.0).count();
        agreed as f64 / said.max(1) as f64
    }

    /// By how many standard deviations more windows speak for this than for another.
    pub fn above(&self, other: &Self) -> f64 {
        deviations(self.0.iter().zip(&other.0).map(|(a, b)| a - b))
    }
}

/// A sum, by how far from zero chance would bring it.
fn deviations(differences: impl Iterator<Item = f64>) -> f64 {
    let (sum, squares) =
        differences.fold((0.0, 0.0), |(sum, squares), by| (sum + by, squares + by * by));
    if squares > 0.0 { sum / squares.sqrt() } else { 0.0 }
}

/// What is known of the sides from which both surfaces were seen.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fronts {
    /// Nothing.
    Unknown,
    /// Both grids have a camera.
    OfCameras,
    /// A cloud may have been seen from its origin, and where both lie on each other their fronts are the same.
    Alike,
}

impl Fronts {
    fn of(source: &Surface, target: &Surface, at: &Isometry3<f64>, scale: f64) -> Self {
        if source.is_facing && target.is_facing {
            return Fronts::OfCameras;
        }
        if !source.has_a_front() || !target.has_a_front() {
            return Fronts::Unknown;
        }
        let sight = Sight::new(source, target, at, Fronts::Unknown);
        let (mut alike, mut all) = (0.0, 0.0);
        for found in sight.windows(TRIED).filter_map(|own| sight.beside(own)) {
            if found.deviations(scale) < DOUBTED {
                all += 1.0;
                alike += f64::from(u8::from(found.cosine(Fronts::Alike) > 0.0));
            }
        }
        if all >= FEWEST && alike >= ALIKE * all { Fronts::Alike } else { Fronts::Unknown }
    }
}

/// A window, moved, and that of the other surface which is there.
struct Beside<'a> {
    own: &'a Patch,
    other: &'a Patch,
    /// From the other's mean to the moved one.
    apart: Vector3<f64>,
    /// The own normal, moved.
    n: Vector3<f64>,
}

impl Beside<'_> {
    /// Distance across the other, over the deviation of both.
    fn deviations(&self, scale: f64) -> f64 {
        let variance = scale * (self.own.variance + self.other.variance + LEAST);
        self.other.normal.dot(&self.apart).abs() / variance.sqrt()
    }

    /// Between both normals, each to its front.
    fn cosine(&self, fronts: Fronts) -> f64 {
        let cosine = self.n.dot(&self.other.normal);
        match fronts {
            Fronts::Unknown => cosine.abs(),
            Fronts::OfCameras => cosine,
            Fronts::Alike => cosine * front(self.own) * front(self.other),
        }
    }
}

/// 1 where a normal points towards the origin, -1 where it points away.
fn front(patch: &Patch) -> f64 {
    -patch.normal.dot(&patch.mean).signum()
}

/// The windows of a surface, moved, and those of the other that are beside them, or in front or behind.
struct Sight<'a> {
    from: &'a Surface,
    to: &'a Surface,
    r: Matrix3<f64>,
    t: Vector3<f64>,
    fronts: Fronts,
}

impl<'a> Sight<'a> {
    fn new(from: &'a Surface, to: &'a Surface, at: &Isometry3<f64>, fronts: Fronts) -> Self {
        let r = at.rotation.to_rotation_matrix().into_inner();
        Self { from, to, r, t: at.translation.vector, fronts }
    }

    fn beside(&self, own: &'a Patch) -> Option<Beside<'a>> {
        let (p, n) = (self.r * own.mean + self.t, self.r * own.normal);
        let mut found = self.to.find(&p, BESIDE * self.to.spread);
        if self.fronts == Fronts::Alike {
            found = found.or_else(|| self.to.see(&p));
        }
        let other = self.to.patches[found?].as_ref()?;
        Some(Beside { own, other, apart: p - other.mean, n })
    }

    /// About so many windows.
    fn windows(&self, count: f64) -> impl Iterator<Item = &'a Patch> {
        let from = self.from;
        let chosen = from.every(from.stride(count)).into_iter();
        chosen.filter_map(|k| from.patches[k as usize].as_ref())
    }

    fn opinion(&self, own: &'a Patch, scale: f64) -> f64 {
        let Some(found) = self.beside(own) else { return 0.0 };
        let opinion = 1.0 - (found.deviations(scale) - DOUBTED).clamp(0.0, 2.0);
        // a camera sees nothing through what is in front
        let off = found.other.normal.dot(&found.apart);
        let hidden = match self.fronts {
            Fronts::Unknown => self.to.is_facing && off < 0.0,
            Fronts::OfCameras => off < 0.0,
            Fronts::Alike => off * front(found.other) < 0.0,
        };
        let says_something =
            if opinion > 0.0 { found.cosine(self.fronts) >= COSINE } else { !hidden };
        if says_something { opinion } else { 0.0 }
    }
}

/// Around a start: turned and shifted in twelve directions, about the middle of the source.
pub fn around(start: &Isometry3<f64>, middle: &Vector3<f64>, reach_m: f64) -> Vec<Isometry3<f64>> {
    let golden = f64::midpoint(1.0, 5f64.sqrt());
    let corner = |k: usize| {
        let (a, b) = ([1.0, -1.0][k & 1], [golden, -golden][k >> 1 & 1]);
        let v = Vector3::new(0.0, a, b).normalize();
        Vector3::from_fn(|axis, _| v[(axis + k / 4) % 3])
    };
    let to = Translation3::from(*middle);
    (0..12)
        .map(|k| {
            let turn = UnitQuaternion::from_scaled_axis(corner(k) * TURN);
            let shift = Translation3::from(corner((5 * k + 3) % 12) * reach_m);
            start * to * shift * turn * to.inverse()
        })
        .collect()
}

/// Starts are turned by so much, rad.
const TURN: f64 = 0.14;

/// An answer, and what is said of it.
pub(crate) struct Rival {
    pub reached: Reached,
    pub opinions: Opinions,
}

/// Answers from these starts that lie near a place, the best first: it, and those of which it is not clear that they
/// are worse. With ever more windows, until it is clear or there are no more.
pub fn answers(
    descent: &Descent,
    starts: &[Isometry3<f64>],
    near: Option<&Isometry3<f64>>,
    gate: f64,
) -> Result<Vec<Rival>, Error> {
    let source = descent.source;
    let mut count = TRIED;
    let (mut all, mut sigma) = tried(descent, starts, gate, count, f64::INFINITY);
    let is_far =
        |r: &Rival, near| source.moved(near, &r.reached.target_from_source) > FARTHEST * gate;
    let found = all.len();
    all.retain(|r| near.is_none_or(|near| !is_far(r, near)));
    if all.is_empty() && found > 0 {
        let what = format!(
            "the scans fit only more than {:.0} mm away from the start: give a better one, or a larger distance",
            1e3 * FARTHEST * gate
        );
        return Err(Error::NotDetermined { what });
    }
    leave_out_worse(&mut all);
    while all.len() > 1 && source.stride(count) > 1 {
        count *= 4.0;
        let starts: Vec<_> = all.iter().map(|r| r.reached.target_from_source).collect();
        (all, sigma) = tried(descent, &starts, NEARBY * source.spread, count, sigma);
        leave_out_worse(&mut all);
    }
    if all.is_empty() {
        return Err(Error::TooFewPoints { found: 0, needed: FEWEST as usize });
    }
    Ok(all)
}

/// Where these starts lead to, in the order of the starts, and the least noise that was met.
fn tried(
    descent: &Descent,
    starts: &[Isometry3<f64>],
    gate: f64,
    count: f64,
    known: f64,
) -> (Vec<Rival>, f64) {
    let (source, config) = (descent.source, descent.config);
    // few windows are looked at: threads share the starts, and not each of them
    let alone = DenseConfig { threads: 1, ..*config };
    let from = |start: &Isometry3<f64>, sigma: f64| {
        let mut own = Descent::new(source, descent.target, &alone);
        own.sigma = sigma;
        let mut reached = Reached::start(start);
        own.coarse(&mut reached, gate, source.stride(count)).ok()?;
        Some((reached, own.sigma))
    };
    // what is known of the noise, if only by the first, limits the residuals of the others
    let (first, others) = starts.split_at(usize::from(known.is_infinite()).min(starts.len()));
    let mut all: Vec<_> = first.iter().map(|start| from(start, known)).collect();
    let sigma = all.iter().flatten().fold(known, |least, (_, sigma)| least.min(*sigma));
    all.extend(parallel::in_order(others.len(), config.threads, |k| from(&others[k], sigma)));
    let sigma = all.iter().flatten().fold(sigma, |least, (_, sigma)| least.min(*sigma));
    let mut places: Vec<Reached> = vec![];
    for (reached, _) in all.into_iter().flatten() {
        let at = reached.target_from_source;
        if places.iter().all(|r| source.moved(&r.target_from_source, &at) >= source.spread) {
            places.push(reached);
        }
    }
    let opinions = parallel::in_order(places.len(), config.threads, |k| {
        Opinions::of(descent, &places[k].target_from_source, JUDGED * count, sigma)
    });
    let rival = |(reached, opinions)| Rival { reached, opinions };
    (places.into_iter().zip(opinions).map(rival).collect(), sigma)
}

/// The best first, and none that is clearly worse.
fn leave_out_worse(all: &mut Vec<Rival>) {
    all.sort_by(|a, b| b.opinions.sum().total_cmp(&a.opinions.sum()));
    let is_worse = |r: &Rival| all[0].opinions.above(&r.opinions) > CLEARLY;
    let unclear = all.iter().position(is_worse).unwrap_or(all.len());
    all.truncate(unclear);
}
