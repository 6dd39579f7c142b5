//! Grids of circles: which circle is which, where their centres are, and how sure that is.
//!
//! Patches with the outline of an ellipse (`blobs`) are joined into lattices (`lattice`), and a
//! lattice is the target if its labels fill it. Each circle's ellipse is then fitted to the image
//! (`ellipse`), and the centres of the ellipses are turned into images of the circles' centres by the
//! view of the board. A wrong labelling is worse than none: all circles must be found (of a grid with a
//! larger circle, half of them and that one), they must lie where one view of the board puts them,
//! and be as large as it says.

mod blobs;
mod ellipse;
mod lattice;

use std::collections::BTreeMap;

use nalgebra::{Matrix2, Vector2};

use super::{
    pyramid::Scaled,
    view::{Sighting, View},
};
use crate::{
    GrayImage, ImageCorner, Intrinsics, TargetModel, detect::outcome::NotFound,
    math::linalg::median,
};
use blobs::Blob;
use ellipse::{Ellipse, Rough};
use lattice::{Board, Lattice};

/// Larger images (px) are looked at halved first.
const LARGE: usize = 1_600_000;
/// Radii of the means that patches are compared with, as shares of the image's longer side: for
/// boards far away and near.
const MEANS: [f64; 2] = [0.02, 0.06];
/// Least radius of a mean, px.
const LEAST_RADIUS: usize = 8;
/// Lattices that are tried.
const MOST_LATTICES: usize = 4;
/// Rounds in which view and centres improve each other.
const ROUNDS: usize = 3;
/// A circle may lie this far from where the view puts it, over the distance to its nearest
/// neighbour, and px more.
const FARTHEST: (f64, f64) = (0.06, 0.3);
/// The same, root mean square of all.
const FAR: (f64, f64) = (0.02, 0.15);
/// A circle's size (product of half axes) over that of the others, as the view shows them.
const SIZES: (f64, f64) = (0.65, 1.55);
/// The larger circle's.
const LARGER_SIZES: (f64, f64) = (1.5, 12.0);

/// The centres of the target's circles in the order of their ids, without knowledge of the camera.
///
/// # Errors
/// Why they were not found.
pub fn detect(image: &GrayImage, target: &TargetModel) -> Result<Vec<ImageCorner>, NotFound> {
    detect_with(image, target, None)
}

/// The same, with the camera that took the image: the centres are then right for strong
/// distortion and large circles, too.
///
/// # Errors
/// Why they were not found.
pub fn detect_with(
    image: &GrayImage,
    target: &TargetModel,
    camera: Option<&Intrinsics>,
) -> Result<Vec<ImageCorner>, NotFound> {
    let board = Board::of(target).ok_or(NotFound::Unsupported("this target"))?;
    let sheet = Sheet { image, target, board, camera };
    let mut best = Err(NotFound::NoCorners);
    for scaled in Scaled::halves(image, |half| half.width() * half.height() <= LARGE) {
        for share in MEANS {
            let found = sheet.attempt(&scaled, share);
            if found.is_ok() {
                return found;
            }
            best = better(best, found);
        }
    }
    best
}

type Outcome = Result<Vec<ImageCorner>, NotFound>;

/// Of two failures the one that says more.
fn better(a: Outcome, b: Outcome) -> Outcome {
    let worth = |outcome: &Outcome| match outcome {
        Ok(_) => usize::MAX,
        Err(NotFound::OtherSize { columns, rows, .. }) => 2 * (columns * rows) as usize,
        Err(NotFound::NoGrid { found, .. } | NotFound::TooFew { found, .. }) => *found,
        Err(_) => 0,
    };
    if worth(&b) > worth(&a) { b } else { a }
}

/// What is looked for, and where.
struct Sheet<'a> {
    image: &'a GrayImage,
    target: &'a TargetModel,
    board: Board,
    camera: Option<&'a Intrinsics>,
}

impl Sheet<'_> {
    fn attempt(&self, scaled: &Scaled, share: f64) -> Outcome {
        let longer = scaled.image.width().max(scaled.image.height()) as f64;
        let radius = ((share * longer) as usize).max(LEAST_RADIUS);
        let blobs: Vec<Blob> =
            blobs::blobs(&scaled.image, radius).iter().map(|b| in_original(b, scaled)).collect();
        let lattices = lattice::lattices(&blobs, self.board.has_larger());
        let mut best = Err(NotFound::NoCorners);
        for lattice in lattices.iter().take(MOST_LATTICES) {
            let found = self.read(&blobs, lattice);
            if found.is_ok() {
                return found;
            }
            best = better(best, found);
        }
        best
    }

    /// The lattice as the target.
    fn read(&self, blobs: &[Blob], lattice: &Lattice) -> Outcome {
        let ways = self.board.labelled(lattice);
        let first = |ids: &BTreeMap<u32, usize>| {
            ids.values().next().map_or(f64::INFINITY, |&b| blobs[b].centre.sum())
        };
        // of equal ways the one with the first circle nearest to the top left
        let ids = ways.into_iter().min_by(|a, b| first(a).total_cmp(&first(b)));
        let ids = ids.ok_or_else(|| self.unlike(lattice))?;
        let rough = ids.iter().map(|(&id, &b)| (id, blobs[b])).collect();
        self.measured(&rough)
    }

    /// Why a lattice is not the target.
    fn unlike(&self, lattice: &Lattice) -> NotFound {
        let (found, needed) = (lattice.blobs.len(), self.target.len());
        let (wanted_columns, wanted_rows) = self.target.grid();
        match self.board.other_size(lattice) {
            Some((columns, rows)) if (columns, rows) != (wanted_columns, wanted_rows) => {
                NotFound::OtherSize { columns, rows, wanted_columns, wanted_rows }
            }
            _ if found < needed => NotFound::TooFew { found, needed },
            _ => NotFound::NoGrid { found, columns: wanted_columns, rows: wanted_rows },
        }
    }

    /// Fits all circles, those that are missing too, and checks them against one view.
    fn measured(&self, rough: &BTreeMap<u32, Blob>) -> Outcome {
        let mut ellipses: BTreeMap<u32, Ellipse> = BTreeMap::new();
        for (&id, blob) in rough {
            if let Some(found) = self.fit(blob, rough, id) {
                ellipses.insert(id, found);
            }
        }
        self.complete(&mut ellipses, rough);
        let (found, needed) = (ellipses.len(), self.target.len());
        let enough = match self.board.larger() {
            Some(larger) => ellipses.contains_key(&larger) && 2 * found >= needed,
            None => found == needed,
        };
        if !enough {
            return Err(NotFound::TooFew { found, needed });
        }
        let (columns, rows) = self.target.grid();
        self.centres(&ellipses).ok_or(NotFound::NoGrid { found, columns, rows })
    }

    fn fit(&self, blob: &Blob, all: &BTreeMap<u32, Blob>, id: u32) -> Option<Ellipse> {
        let others = all.iter().filter(|(other, _)| **other != id).map(|(_, b)| b);
        let clear = clearance(blob, others)?;
        let Blob { centre, shape, dark } = *blob;
        ellipse::fit(self.image, &Rough { centre, shape, dark, clear })
    }

    /// Looks for missing circles where the others say they are.
    fn complete(&self, ellipses: &mut BTreeMap<u32, Ellipse>, rough: &BTreeMap<u32, Blob>) {
        let missing: Vec<u32> =
            (0..self.target.len() as u32).filter(|id| !ellipses.contains_key(id)).collect();
        let Some(dark) = rough.values().next().map(|b| b.dark) else { return };
        if missing.is_empty() {
            return;
        }
        let Some((view, radius)) = self.view(ellipses, &BTreeMap::new()) else { return };
        let expected = |id: u32| {
            let at = self.on_board(id)?;
            let radius = if self.board.larger() == Some(id) { return None } else { radius };
            let (bias, shape) = view.circle(&at, radius)?;
            Some(Blob { centre: view.pixel(&at)? + bias, shape, dark })
        };
        let mut all = rough.clone();
        all.extend(missing.iter().filter_map(|&id| Some((id, expected(id)?))));
        for id in missing {
            if let Some(found) = all.get(&id).and_then(|blob| self.fit(blob, &all, id)) {
                ellipses.insert(id, found);
            }
        }
    }

    /// The images of the circles' centres, if one view of the board explains them.
    fn centres(&self, ellipses: &BTreeMap<u32, Ellipse>) -> Option<Vec<ImageCorner>> {
        let mut biases = BTreeMap::new();
        for _ in 0..ROUNDS {
            let (view, radius) = self.view(ellipses, &biases)?;
            for (&id, ellipse) in ellipses {
                let at = self.on_board(id)?;
                let radius = if self.board.larger() == Some(id) {
                    self.radius_of(&view, &at, ellipse)?
                } else {
                    radius
                };
                biases.insert(id, view.circle(&at, radius)?.0);
            }
        }
        let (view, radius) = self.view(ellipses, &biases)?;
        self.agree(ellipses, &biases, &view, radius)?;
        let corner = |(&id, ellipse): (&u32, &Ellipse)| ImageCorner {
            id,
            pixel: ellipse.centre - biases[&id],
            covariance: ellipse.covariance,
        };
        Some(ellipses.iter().map(corner).collect())
    }

    /// The view of the board, and the radius of its circles in units of the pitch.
    fn view(
        &self,
        ellipses: &BTreeMap<u32, Ellipse>,
        biases: &BTreeMap<u32, Vector2<f64>>,
    ) -> Option<(View<'_>, f64)> {
        let sightings: Option<Vec<Sighting>> = ellipses
            .iter()
            .map(|(id, ellipse)| {
                let bias = biases.get(id).copied().unwrap_or_default();
                Some(Sighting {
                    on_board: self.on_board(*id)?,
                    pixel: ellipse.centre - bias,
                    covariance: ellipse.covariance + Matrix2::identity() * VIEW_VARIANCE,
                })
            })
            .collect();
        let size = (self.image.width(), self.image.height());
        let view = View::fit(&sightings?, size, self.camera)?;
        let radii: Vec<f64> = ellipses
            .iter()
            .filter(|(id, _)| self.board.larger() != Some(**id))
            .filter_map(|(id, ellipse)| self.radius_of(&view, &self.on_board(*id)?, ellipse))
            .collect();
        (!radii.is_empty()).then(|| (view, median(radii)))
    }

    /// The radius with which a circle is seen as large as it is.
    fn radius_of(&self, view: &View, at: &Vector2<f64>, ellipse: &Ellipse) -> Option<f64> {
        let (_, shape) = view.circle(at, SMALL)?;
        Some(SMALL * (ellipse.shape.determinant() / shape.determinant()).powf(0.25))
    }

    /// Places and sizes of all circles, as one view has them.
    fn agree(
        &self,
        ellipses: &BTreeMap<u32, Ellipse>,
        biases: &BTreeMap<u32, Vector2<f64>>,
        view: &View,
        radius: f64,
    ) -> Option<()> {
        let mut squares = 0.0;
        let mut least = f64::INFINITY;
        for (&id, ellipse) in ellipses {
            let at = self.on_board(id)?;
            let expected = view.pixel(&at)?;
            let off = (ellipse.centre - biases[&id] - expected).norm();
            let step = |x, y| Some((view.pixel(&(at + Vector2::new(x, y)))? - expected).norm());
            let pitch = step(0.1, 0.0)?.min(step(0.0, 0.1)?) * 10.0;
            let size = (self.radius_of(view, &at, ellipse)? / radius).powi(2);
            let larger = self.board.larger() == Some(id);
            let (low, high) = if larger { LARGER_SIZES } else { SIZES };
            if off > FARTHEST.0 * pitch + FARTHEST.1 || size < low || size > high {
                return None;
            }
            squares += off * off;
            least = least.min(pitch);
        }
        let rms = (squares / ellipses.len() as f64).sqrt();
        (rms < FAR.0 * least + FAR.1).then_some(())
    }

    /// A circle's place in units of the pitch.
    fn on_board(&self, id: u32) -> Option<Vector2<f64>> {
        Some(self.target.corner(id)?.vector().xy() / self.target.pitch_m())
    }
}

/// Radius (pitches) of a circle that is seen as its neighbourhood is.
const SMALL: f64 = 0.1;
/// What the view does not know of: paper that is not flat, lenses (px²).
const VIEW_VARIANCE: f64 = 1e-4;

fn in_original(blob: &Blob, scaled: &Scaled) -> Blob {
    let centre = scaled.original(&blob.centre);
    let factor = (scaled.original(&Vector2::new(1.0, 0.0)) - scaled.original(&Vector2::zeros())).x;
    Blob { centre, shape: blob.shape * (factor * factor), dark: blob.dark }
}

/// How far the nearest edge of another circle is from a circle's centre, in its own radii.
fn clearance<'a>(blob: &Blob, others: impl Iterator<Item = &'a Blob>) -> Option<f64> {
    let inverse = blob.shape.try_inverse()?;
    let edge = |other: &Blob| {
        let d = other.centre - blob.centre;
        d.dot(&(inverse * d)).sqrt() - (other.size() / blob.size()).sqrt()
    };
    Some(others.map(edge).fold(f64::INFINITY, f64::min).clamp(1.0, WIDEST_CLEARANCE))
}

/// Circles on a board are never farther apart, in radii.
const WIDEST_CLEARANCE: f64 = 6.0;

#[cfg(test)]
mod tests;
