//! Search without an initial guess: where a part lies in a scan.
//!
//! Pairs of surfels propose poses ([`pairs`]). Each is scored by how much of the scan it explains; the best are
//! aligned in a few steps and scored again, now also by what contradicts them: surfaces of the part that the camera
//! would have seen, or that are below a table ([`align`]). What is left are a few places, the best first.
//!
//! Lengths are shares of the part's radius, so that nothing depends on its size.

mod align;
mod edges;
mod field;
mod pairs;
mod planes;
mod shape;
mod sheets;
mod visible;

use nalgebra::{Isometry3, Matrix3, Matrix3x6, Matrix6, Point3, Translation3, Vector3};

use self::{
    align::{Scene, explained},
    field::Field,
    planes::Plane,
    shape::{Surfel, balanced, even, surfels, thinned},
    visible::RangeImage,
};
use super::surface::Surface;
use crate::math::{lie, linalg, parallel};

/// Surfels of the scan and of the part are so far apart.
const SCAN_APART: f64 = 0.04;
const PART_APART: f64 = 0.06;
/// Surfels in the coarse and in the fine field.
const COARSE: f64 = 0.04;
const FINE: f64 = 0.02;
/// Surfels of the scan and of the part of which pairs are made.
const PAIRED: (usize, usize) = (280, 420);
/// The longest pair.
const LONGEST: f64 = 1.1;
/// Pairs that propose poses.
const PROPOSING: usize = 110_000;
/// Surfels of the scan that score a proposal at first.
const SCORING: usize = 90;
/// Surfels and walls of the scan that align a proposal, at first and at last.
const ALIGNING: (usize, usize) = (160, 700);
/// Walls of the scan.
const WALLS: usize = 140;
/// Spread of a window of three surfels, over their distance.
const SPREAD: f64 = 0.866;
/// Proposals that are aligned.
const ALIGNED: usize = 1400;
/// Places that are aligned again.
const AGAIN: usize = 40;
/// Places in the end.
const PLACES: usize = 12;
/// A place that scores less than this share of the best is none.
const WORSE: f64 = 0.6;
/// Places differ by more.
const APART: f64 = 0.06;
/// Surfels lie on the part within these distances: proposed, aligned, and in the end.
const WITHIN: [f64; 3] = [0.06, 0.015, 0.008];
/// ... and no farther aside.
const ASIDE: [f64; 3] = [0.1, 0.05, 0.05];
/// What is flush with a face of the part within this distance of the part's box should have been of the part.
const BESIDE: f64 = 0.25;
/// The scan is registered within this margin of the part's box.
const NEAR: f64 = 0.05;
/// In the end they may be so many times the scatter of the scan's points apart.
const SCATTERED: f64 = 3.0;
/// Limits of matches in the steps of alignment.
const COARSE_STEPS: [f64; 4] = [0.08, 0.07, 0.06, 0.05];
const FINE_STEPS: [f64; 3] = [0.035, 0.03, 0.025];
const LAST_STEPS: [f64; 8] = [0.025, 0.02, 0.02, 0.015, 0.015, 0.012, 0.012, 0.01];

/// A place where the source may lie in the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    pub target_from_source: Isometry3<f64>,
    pub evidence: Evidence,
}

/// What speaks for a place and against it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Evidence {
    /// Share of the scan within the part's box, or flush with it beside the box, that lies on the part.
    pub explained: f64,
    /// Share of the scan that lies on the part, but for what is on planes wider than the part.
    pub of_scan: f64,
    /// Of the part's surface that the camera should see, the share at which it saw through it.
    pub contradicted: f64,
    /// ... and the share at which it measured nothing.
    pub missing: f64,
    /// Surfels explained, less those contradicted.
    pub score: f64,
}

/// A scan and a part, prepared for the search.
pub struct Search {
    part: Vec<Surfel>,
    coarse: Vec<Surfel>,
    fine: Vec<Surfel>,
    scan: Vec<Surfel>,
    seen: Vec<Surfel>,
    walls: Vec<Surfel>,
    planes: Vec<Plane>,
    /// Ends of the part's box.
    low: Vector3<f64>,
    high: Vector3<f64>,
    radius: f64,
    noise: f64,
    has_camera: bool,
    oriented: bool,
    scan_is_source: bool,
    threads: usize,
}

impl Search {
    /// `None` where it is not known which of both is the part.
    pub fn new(source: &Surface, target: &Surface, threads: usize) -> Option<Self> {
        let scan_is_source = scan_is_source(source, target)?;
        let (scan, part) = if scan_is_source { (source, target) } else { (target, source) };
        let (seen, all) = (surfels(scan), surfels(part));
        let radius = all.iter().map(|s| (s.p - part.middle).norm()).fold(0.0, f64::max);
        let noise = linalg::median(scan.patches.iter().flatten().map(|p| p.across)).sqrt();
        let has_camera = scan.has_camera();
        let kept = thinned(&seen, SCAN_APART * radius);
        let within = (SCATTERED * noise).max(WITHIN[2] * radius);
        let (planes, kept) = planes::removed(&kept, 2.0 * radius, within, has_camera);
        let apart = scan.spread / SPREAD;
        let is_high = |s: &&Surfel| planes.iter().all(|p| p.height(&s.p).abs() >= within);
        let high: Vec<Surfel> = seen.iter().filter(is_high).copied().collect();
        let walls = edges::walls(&high, apart);
        Some(Self {
            part: thinned(&all, PART_APART * radius),
            coarse: thinned(&all, COARSE * radius),
            fine: thinned(&all, FINE * radius),
            scan: kept,
            seen,
            walls: even(&walls, WALLS),
            planes,
            low: all.iter().map(|s| s.p).reduce(|a, b| a.inf(&b))?,
            high: all.iter().map(|s| s.p).reduce(|a, b| a.sup(&b))?,
            radius,
            noise,
            has_camera,
            oriented: part.is_facing && has_camera,
            scan_is_source,
            threads,
        })
    }

    fn scene(&self) -> Scene<'_> {
        Scene {
            scan: &self.scan,
            walls: &self.walls,
            part: &self.part,
            part_area: (PART_APART / SCAN_APART).powi(2),
            planes: &self.planes,
            view: if self.has_camera { RangeImage::new(&self.seen) } else { None },
            oriented: self.oriented,
        }
    }

    /// Places of the source in the target, the best first.
    pub fn places(&self) -> Vec<Place> {
        let r = self.radius;
        let coarse = Field::new(&self.coarse, COARSE * r, ASIDE[0] * r, self.oriented);
        let fine = Field::new(&self.fine, FINE * r, ASIDE[1] * r, self.oriented);
        let scene = self.scene();
        let proposed = self.proposed(&coarse);
        let some = even(&self.scan, ALIGNING.0);
        let steps = |limits: &[f64]| limits.iter().map(|x| x * r).collect::<Vec<_>>();
        let (first, second) = (steps(&COARSE_STEPS), steps(&FINE_STEPS));
        let aligned = self.each(&proposed, |at| {
            let at = scene.aligned(&coarse, at, &some, &first)?;
            let at = scene.aligned(&fine, &at, &some, &second)?;
            Some((scene.score(&fine, &at, WITHIN[1] * r, ASIDE[1] * r).total(), at))
        });
        let again = self.distinct(aligned, AGAIN);
        let (more, last) = (even(&self.scan, ALIGNING.1), steps(&LAST_STEPS));
        let at_last = self.each(&again, |(_, at)| scene.aligned(&fine, at, &more, &last));
        let at_last = self.each(&at_last, |at| Some((self.evidence_of(&scene, &fine, at), *at)));
        let scored = at_last.iter().map(|(evidence, at)| (evidence.score, *at)).collect();
        let kept = self.distinct(scored, PLACES);
        let place = |(score, at): &(f64, Isometry3<f64>)| {
            let evidence = at_last.iter().find(|found| found.1 == *at)?.0;
            let target_from_source = self.target_from_source(at);
            (*score > WORSE * kept[0].0).then_some(Place { target_from_source, evidence })
        };
        let mut places: Vec<Place> = kept.iter().filter_map(place).collect();
        let others = self.other_faces(&places, |at| scene.aligned(&fine, at, &more, &last));
        places.extend(others.into_iter().map(|at| Place {
            target_from_source: self.target_from_source(&at),
            evidence: self.evidence_of(&scene, &fine, &at),
        }));
        // the first of equals stays the first
        places.sort_by(|a, b| b.evidence.score.total_cmp(&a.evidence.score));
        places
    }

    /// Where the best place ends that is moved from one face of a sheet to the other, where it is not known which way
    /// surfaces face. `aligned` improves where the scan lies in the part.
    fn other_faces(
        &self,
        places: &[Place],
        aligned: impl Fn(&Isometry3<f64>) -> Option<Isometry3<f64>>,
    ) -> Vec<Isometry3<f64>> {
        let Some(best) = places.first().filter(|_| !self.oriented) else { return vec![] };
        let best = self.target_from_source(&best.target_from_source);
        let mut found: Vec<Isometry3<f64>> = vec![];
        for step in sheets::steps(&self.fine, self.radius, self.within()) {
            let Some(at) = aligned(&(Translation3::from(step) * best)) else { continue };
            let apart = |other: &Isometry3<f64>| self.moved(other, &at) > 0.5 * step.norm();
            if apart(&best) && found.iter().all(apart) {
                found.push(at);
            }
        }
        found
    }

    /// Surfels lie on the part within this distance in the end, m.
    fn within(&self) -> f64 {
        (SCATTERED * self.noise).max(WITHIN[2] * self.radius)
    }

    /// Poses of pairs that explain most.
    fn proposed(&self, field: &Field) -> Vec<Isometry3<f64>> {
        let r = self.radius;
        let pool = [&self.scan[..], &self.walls[..]].concat();
        let scan = balanced(&pool, PAIRED.0, self.oriented);
        let part = balanced(&self.coarse, PAIRED.1, self.oriented);
        let pairs = |some: &[Surfel]| pairs::pairs(some, LONGEST * r, self.oriented);
        let matches = pairs::matches(&pairs(&scan), &pairs(&part), PROPOSING);
        let scoring = [
            even(&self.scan, SCORING / 2),
            even(&balanced(&self.scan, SCORING / 2, self.oriented), SCORING / 2),
        ]
        .concat();
        let two = |all: &[Surfel], [i, j]: [u16; 2]| [all[usize::from(i)], all[usize::from(j)]];
        let chunk = matches.len().div_ceil(64).max(1);
        let parts = parallel::in_order(matches.len().div_ceil(chunk), self.threads, |k| {
            let range = chunk * k..matches.len().min(chunk * (k + 1));
            let proposed = matches[range]
                .iter()
                .flat_map(|(a, b)| pairs::poses(two(&scan, *a), two(&part, *b), self.oriented));
            proposed
                .map(|at| {
                    let [within, aside] = [WITHIN[0] * r, ASIDE[0] * r];
                    (explained(field, &scoring, &at, within, aside, self.oriented), at)
                })
                .collect::<Vec<_>>()
        });
        let mut scored = parts.concat();
        scored.sort_by_key(|(score, _)| std::cmp::Reverse(*score));
        scored.truncate(ALIGNED);
        scored.into_iter().map(|(_, at)| at).collect()
    }

    fn each<A: Sync, B: Send>(&self, all: &[A], work: impl Fn(&A) -> Option<B> + Sync) -> Vec<B> {
        let parts = parallel::in_order(all.len().div_ceil(8), self.threads, |k| {
            all[8 * k..all.len().min(8 * k + 8)].iter().filter_map(&work).collect::<Vec<_>>()
        });
        parts.into_iter().flatten().collect()
    }

    /// The best of those that lie near one another.
    fn distinct(
        &self,
        mut all: Vec<(f64, Isometry3<f64>)>,
        most: usize,
    ) -> Vec<(f64, Isometry3<f64>)> {
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut kept: Vec<(f64, Isometry3<f64>)> = vec![];
        for (score, at) in all {
            if kept.iter().all(|other| self.moved(&other.1, &at) > APART * self.radius) {
                kept.push((score, at));
            }
            if kept.len() == most {
                break;
            }
        }
        kept
    }

    /// Farthest distance between two places of a surfel of the part, about.
    fn moved(&self, a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
        let (a, b) = (a.inverse(), b.inverse());
        let step = (self.part.len() / 24).max(1);
        let between =
            |s: &Surfel| (a.transform_point(&s.p.into()) - b.transform_point(&s.p.into())).norm();
        self.part.iter().step_by(step).map(between).fold(0.0, f64::max)
    }

    /// Whether a place of the scan is in the box around the part, or within a margin (m) of it.
    fn is_in_box(&self, part_from_scan: &Isometry3<f64>, p: &Vector3<f64>, margin: f64) -> bool {
        let p = part_from_scan.transform_point(&(*p).into()).coords;
        let margin = Vector3::repeat(margin);
        (p - self.low + margin).min() >= 0.0 && (self.high + margin - p).min() >= 0.0
    }

    /// Whether a surfel of the scan is beside the part's box, and goes on from a face of the part where it ends.
    fn continues(&self, field: &Field, part_from_scan: &Isometry3<f64>, s: &Surfel) -> bool {
        if !self.is_in_box(part_from_scan, &s.p, BESIDE * self.radius) {
            return false;
        }
        let (r, t) = shape::parts(part_from_scan);
        let s = s.moved(&r, &t);
        let at_end = s.p.sup(&self.low).inf(&self.high);
        let found = field.find(&at_end, &s.n);
        found.is_some_and(|end| (s.p - end.p).dot(&end.n).abs() < self.within())
    }

    /// The scan near a place of the part, if it is the source.
    pub fn cropped(&self, source: &Surface, at: &Isometry3<f64>) -> Option<Surface> {
        let margin = NEAR * self.radius;
        let is_near = |p: &Vector3<f64>| self.is_in_box(at, p, margin);
        let is_high =
            |p: &Vector3<f64>| self.planes.iter().all(|plane| plane.height(p) > self.within());
        self.scan_is_source.then(|| source.cropped(|p| is_near(p) && is_high(p))).flatten()
    }

    /// The part's radius, m.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Standard deviation (3-D, m) of the part's surface, RMS over all of it, of a covariance that is perturbed on
    /// the right, rotation first.
    pub fn deviation(&self, target_from_source: &Isometry3<f64>, covariance: &Matrix6<f64>) -> f64 {
        let back = target_from_source.inverse();
        let variance = |s: &Surfel| {
            let p = if self.scan_is_source { back * Point3::from(s.p) } else { s.p.into() };
            let mut jacobian = Matrix3x6::zeros();
            jacobian.fixed_view_mut::<3, 3>(0, 0).copy_from(&-lie::hat(&p.coords));
            jacobian.fixed_view_mut::<3, 3>(0, 3).copy_from(&Matrix3::identity());
            (jacobian * covariance * jacobian.transpose()).trace()
        };
        (self.part.iter().map(variance).sum::<f64>() / self.part.len() as f64).sqrt()
    }

    /// Where the scan lies in the part.
    pub(crate) fn part_from_scan(&self, target_from_source: &Isometry3<f64>) -> Isometry3<f64> {
        self.target_from_source(target_from_source)
    }

    /// From where the scan lies in the part, or back.
    fn target_from_source(&self, part_from_scan: &Isometry3<f64>) -> Isometry3<f64> {
        if self.scan_is_source { *part_from_scan } else { part_from_scan.inverse() }
    }

    /// What speaks for and against a place, to the finest that the scan tells.
    pub fn evidence(&self, target_from_source: &Isometry3<f64>) -> Evidence {
        let field =
            Field::new(&self.fine, FINE * self.radius, ASIDE[1] * self.radius, self.oriented);
        let at = self.target_from_source(target_from_source);
        self.evidence_of(&self.scene(), &field, &at)
    }

    fn evidence_of(&self, scene: &Scene, field: &Field, at: &Isometry3<f64>) -> Evidence {
        let score = scene.score(field, at, self.within(), ASIDE[2] * self.radius);
        let is_inside =
            |s: &&Surfel| self.is_in_box(at, &s.p, self.within()) || self.continues(field, at, s);
        let inside = self.scan.iter().filter(is_inside).count().max(1) as f64;
        let should = (score.seen + score.contradicted + score.missing).max(1.0);
        Evidence {
            explained: score.explained / inside,
            of_scan: score.explained / self.scan.len().max(1) as f64,
            contradicted: score.contradicted / should,
            missing: score.missing / should,
            score: score.total(),
        }
    }

    /// Farthest that a place of the part lies from where another pose has it, over the part's radius.
    pub fn apart(&self, a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
        self.moved(&self.target_from_source(a), &self.target_from_source(b)) / self.radius
    }
}

/// Whether the scan is the source, and the target the part; `None` where that is not known.
fn scan_is_source(source: &Surface, target: &Surface) -> Option<bool> {
    match (source.has_camera(), target.has_camera()) {
        (true, true) => None,
        (true, false) => Some(true),
        (false, true) => Some(false),
        (false, false) if source.is_facing != target.is_facing => Some(target.is_facing),
        (false, false) => Some(source.radius() > target.radius()),
    }
}
