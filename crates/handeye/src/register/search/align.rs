//! How well a pose of the part explains a scan, and steps that improve it.
//!
//! What is explained is counted in surfels of the scan, each an equal area: those that lie on the part. What
//! contradicts is counted in surfels of the part: those that the camera would have seen in front of what it saw, and
//! those below a table. Steps are those of point-to-plane registration, with matches from a [`Field`].

use nalgebra::{Isometry3, Matrix6, Vector3, Vector6};

use super::{
    field::Field,
    planes::Plane,
    shape::{Surfel, parts},
    visible::{RangeImage, Sight},
};
use crate::{math::linalg, register::descent::moved};

/// Normals of a surfel and that on which it lies agree within 32 degrees.
const FLUSH: f64 = 0.85;
/// Surfels of the part that face the camera at a flatter angle than this cosine may not have been measured.
const GRAZING: f64 = 0.3;
/// What is missing in a scan counts as this share of what contradicts it: shiny and dark places are missing too.
const MISSING: f64 = 0.35;
/// Share of the information in all directions that is added in each: what a plane leaves free stays.
const HELD: f64 = 1e-4;
/// A wall that stands for an outline counts as this share of a surfel.
const OUTLINE: f64 = 0.4;

/// All that is known of the scan and the part.
pub struct Scene<'a> {
    /// Surfels of the scan that may be the part's, and walls at the ends of its surfaces.
    pub scan: &'a [Surfel],
    pub walls: &'a [Surfel],
    /// Surfels of the part, evenly spread.
    pub part: &'a [Surfel],
    /// Area of a surfel of the part over that of one of the scan.
    pub part_area: f64,
    pub planes: &'a [Plane],
    pub view: Option<RangeImage>,
    /// Whether normals of both point to the outside.
    pub oriented: bool,
}

/// What a pose explains and contradicts, in surfels of the scan.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Score {
    pub explained: f64,
    pub contradicted: f64,
    pub missing: f64,
    /// Surfels of the part that should be seen, and are.
    pub seen: f64,
}

impl Score {
    pub fn total(&self) -> f64 {
        self.explained - self.contradicted - MISSING * self.missing
    }
}

/// Whether a surfel of the scan, moved into the part's frame, lies on the part.
#[inline(always)]
pub(crate) fn on_part(field: &Field, s: &Surfel, within: f64, aside: f64, oriented: bool) -> bool {
    let Some(found) = field.find(&s.p, &s.n) else { return false };
    let off = s.p - found.p;
    let across = off.dot(&found.n);
    let cosine = s.n.dot(&found.n);
    let cosine = if oriented { cosine } else { cosine.abs() };
    cosine > FLUSH && across.abs() < within && off.norm_squared() < aside * aside
}

/// How many of some surfels of the scan lie on the part.
pub fn explained(
    field: &Field,
    scan: &[Surfel],
    part_from_scan: &Isometry3<f64>,
    within: f64,
    aside: f64,
    oriented: bool,
) -> usize {
    let (r, t) = parts(part_from_scan);
    scan.iter().filter(|s| on_part(field, &s.moved(&r, &t), within, aside, oriented)).count()
}

impl Scene<'_> {
    /// Distances within which the scan's surfels lie on the part, and depths agree, m.
    pub fn score(
        &self,
        field: &Field,
        part_from_scan: &Isometry3<f64>,
        within: f64,
        aside: f64,
    ) -> Score {
        let count = explained(field, self.scan, part_from_scan, within, aside, self.oriented);
        let mut score = Score { explained: count as f64, ..Score::default() };
        let (r, t) = parts(&part_from_scan.inverse());
        for s in self.part {
            let s = s.moved(&r, &t);
            if self.planes.iter().any(|plane| plane.height(&s.p) < -2.0 * within) {
                score.contradicted += self.part_area;
                continue;
            }
            let Some(view) = &self.view else { continue };
            let cosine = -s.n.dot(&s.p) / s.p.norm().max(f64::MIN_POSITIVE);
            if cosine < GRAZING {
                continue;
            }
            match view.sight(&s.p, within / cosine) {
                Sight::Seen => score.seen += self.part_area,
                Sight::Contradicted => score.contradicted += self.part_area,
                Sight::Missing => score.missing += self.part_area,
                Sight::Hidden => {}
            }
        }
        score
    }

    /// Steps of point-to-plane registration; matches count up to a distance that shrinks to `within`, m.
    pub fn aligned(
        &self,
        field: &Field,
        start: &Isometry3<f64>,
        scan: &[Surfel],
        limits: &[f64],
    ) -> Option<Isometry3<f64>> {
        let mut at = *start;
        for limit in limits {
            let (r, t) = parts(&at);
            let (mut information, mut gradient) = (Matrix6::zeros(), Vector6::zeros());
            let middle = field.middle();
            let mut add = |s: &Surfel, weight: f64| {
                let s = s.moved(&r, &t);
                let Some(found) = field.find(&s.p, &s.n) else { return };
                let off = (s.p - found.p).dot(&found.n);
                let cosine = s.n.dot(&found.n);
                let cosine = if self.oriented { cosine } else { cosine.abs() };
                let share = off / limit;
                if cosine < FLUSH || share.abs() >= 1.0 {
                    return;
                }
                let arm = s.p - middle;
                let turn = arm.cross(&found.n);
                let j = Vector6::new(turn.x, turn.y, turn.z, found.n.x, found.n.y, found.n.z);
                let weight = weight * (1.0 - share * share).powi(2);
                information += j * j.transpose() * weight;
                gradient += j * (off * weight);
            };
            scan.iter().for_each(|s| add(s, 1.0));
            self.walls.iter().for_each(|s| add(s, OUTLINE));
            at = moved_by(&at, &information, &gradient, &middle)?;
        }
        Some(at)
    }
}

/// A step of least squares, about the middle of the part; short where nothing says how far.
fn moved_by(
    at: &Isometry3<f64>,
    information: &Matrix6<f64>,
    gradient: &Vector6<f64>,
    middle: &Vector3<f64>,
) -> Option<Isometry3<f64>> {
    let of = |k| information.fixed_view::<3, 3>(k, k).trace() * HELD + f64::MIN_POSITIVE;
    let (turn, shift) = (of(0), of(3));
    let held = Matrix6::from_diagonal(&Vector6::new(turn, turn, turn, shift, shift, shift));
    let step = -linalg::invert_spd(&(information + held))? * gradient;
    Some(moved(at, &step, middle))
}
