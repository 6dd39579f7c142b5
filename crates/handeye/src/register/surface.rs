//! A scan as pieces of its surface, each a plane through the points of a small window.
//!
//! An organised scan is cut into blocks of pixels, a cloud in any order into cubes; a window is a block
//! and its neighbours. The block tells the place and the window the normal: on a curved surface the mean of
//! a window lies beside it, by nine times as much as that of a block. Windows across
//! an edge in depth or a crease are no planes: their points scatter more than those of most others.

use nalgebra::{Isometry3, Vector3};

use super::{
    blocks, creases::Scatter, grid_view::GridView, kd_tree::KdTree, mesh_surface, outlook::Outlook,
    patch::Patch, voxels::Voxels,
};
use crate::{
    Error, Scan, TriangleMesh,
    math::{linalg, parallel},
};

/// Side of a block in a scan of 100 000 points, pixels. It grows with the power 0.4 of their number: finer
/// pixels go into quieter windows more than into smaller ones.
const SIDE: f64 = 2.2;
/// Points in a cube of a cloud of 100 000. They grow with the power 0.75 of the cloud's number.
const HELD: f64 = 5.0;
/// A surface of fewer pieces is none.
const FEWEST_PIECES: usize = 20;
/// Points in a cube of the smallest clouds.
const FEWEST: f64 = 2.0;
/// A window covers directions that pass its mean within so many times its spread.
const BESIDE: f64 = 2.5;
/// A window must have this share of the points of nine blocks.
const FILLED: f64 = 0.6;

/// A scan's windows that are planes.
pub struct Surface {
    /// Of an organised scan row by row, of a cloud one after the other.
    pub(super) patches: Vec<Option<Patch>>,
    /// Of the mean of all of them, m.
    pub(super) middle: Vector3<f64>,
    /// Spread of the points of a usual window along it, m.
    pub(super) spread: f64,
    /// Corners of a box around all of them: when the scan moves, none moves more than one of these.
    pub(super) corners: [Vector3<f64>; 8],
    /// Whether normals point to the side from which the surface was seen, or of a closed mesh outwards.
    pub(super) is_facing: bool,
    /// Share of the windows that were left by [`cropped`](Self::cropped).
    kept: f64,
    /// Windows along a row, of an organised scan.
    columns: Option<usize>,
    finder: Finder,
    /// Of a cloud that may have been seen from its origin.
    outlook: Option<Outlook>,
}

/// How windows near a place are found.
#[derive(Clone)]
enum Finder {
    /// In the direction from the camera.
    Camera(GridView),
    /// The nearest, by its number.
    Nearest(KdTree),
}

impl Surface {
    /// `None` where nothing in the scan is a surface.
    pub fn of(scan: &Scan, threads: usize) -> Option<Self> {
        Self::of_grid(scan, threads)
            .or_else(|| Self::of_cloud(scan.points(), threads))
            .filter(Self::has_enough)
    }

    /// Of a mesh on which points are laid so far apart, m; `None` where they are too few.
    ///
    /// # Errors
    /// A mesh too large to be covered.
    pub fn of_mesh(mesh: &TriangleMesh, spacing_m: f64) -> Result<Option<Self>, Error> {
        let mut patches = mesh_surface::patches(mesh, spacing_m)?;
        patches.retain(Option::is_some);
        let finder = Finder::Nearest(KdTree::new(&means(&patches)));
        let surface = Self { is_facing: mesh.is_closed(), ..Self::new(patches, finder, None) };
        Ok(Some(surface).filter(Self::has_enough))
    }

    /// Without the windows whose mean is elsewhere; `None` where too few are left.
    pub(super) fn cropped(&self, is_kept: impl Fn(&Vector3<f64>) -> bool) -> Option<Self> {
        let keep = |patch: &Option<Patch>| patch.filter(|p| is_kept(&p.mean));
        let patches: Vec<Option<Patch>> = self.patches.iter().map(keep).collect();
        let [all, left] =
            [&self.patches, &patches].map(|some| some.iter().flatten().count() as f64);
        let own = Self {
            spread: self.spread,
            is_facing: self.is_facing,
            kept: left / all.max(1.0),
            outlook: self.outlook.clone(),
            ..Self::new(patches, self.finder.clone(), self.columns)
        };
        Some(own).filter(Self::has_enough)
    }

    fn has_enough(&self) -> bool {
        self.patches.iter().flatten().count() >= FEWEST_PIECES
    }

    /// Of several scans, side by side.
    pub(crate) fn of_all(scans: &[&Scan], threads: usize) -> Vec<Option<Self>> {
        let each = threads.div_ceil(scans.len().max(1));
        parallel::in_order(scans.len(), threads, |k| Self::of(scans[k], each))
    }

    /// `None` where rows and columns are not those of a camera.
    fn of_grid(scan: &Scan, threads: usize) -> Option<Self> {
        if !scan.is_organised() {
            return None;
        }
        let points = scan.points().len() as f64;
        let side = ((SIDE * (points / 1e5).powf(0.4)) as usize).max(1);
        let reach = if side == 1 { 2 } else { 1 };
        let fewest = FILLED * (side * (2 * reach + 1)).pow(2) as f64;
        let (mut patches, size) = blocks::patches(scan, side, reach, fewest, threads);
        let scatter = Scatter::of(&patches, true);
        scatter.mend(&mut patches, |k| blocks::around(k, size));
        scatter.leave_out_rough(&mut patches);
        let finder = Finder::Camera(GridView::of(&patches, size)?);
        Some(Self::new(patches, finder, Some(size.0)))
    }

    fn of_cloud(points: &[[f32; 3]], threads: usize) -> Option<Self> {
        let held = (HELD * (points.len() as f64 / 1e5).powf(0.75)).max(FEWEST);
        let voxels = Voxels::of(points, held, threads)?;
        let mut patches = voxels.patches(FILLED * 9.0 * held, threads);
        Scatter::of(&patches, false).leave_out_rough(&mut patches);
        patches.retain(Option::is_some);
        let finder = Finder::Nearest(KdTree::new(&means(&patches)));
        let surface = Self::new(patches, finder, None);
        Some(Self { outlook: Outlook::of(&surface.patches, surface.spread), ..surface })
    }

    fn new(patches: Vec<Option<Patch>>, finder: Finder, columns: Option<usize>) -> Self {
        let count = patches.iter().flatten().count() as f64;
        let sum: Vector3<f64> = patches.iter().flatten().map(|p| p.mean).sum();
        let spread = linalg::median(patches.iter().flatten().map(|p| p.along)).sqrt();
        let middle = sum / count.max(1.0);
        let corners = corners(&patches);
        let is_facing = columns.is_some();
        let (kept, outlook) = (1.0, None);
        Self { patches, middle, spread, corners, is_facing, kept, columns, finder, outlook }
    }

    /// A window near a place, the nearest or that in the same direction.
    #[inline(always)]
    pub(super) fn find(&self, p: &Vector3<f64>, within: f64) -> Option<usize> {
        match &self.finder {
            Finder::Camera(view) => view.find(&self.patches, p),
            Finder::Nearest(tree) => {
                let found = tree.nearest(&p.map(|x| x as f32).into(), within as f32)?;
                Some(found.index as usize)
            }
        }
    }

    /// Whether there is a side from which all of it was seen, or may have been.
    pub(super) fn has_a_front(&self) -> bool {
        self.is_facing || self.outlook.is_some()
    }

    /// Whether all of it was seen from the origin, as it seems.
    pub(super) fn has_camera(&self) -> bool {
        self.columns.is_some() || self.outlook.is_some()
    }

    /// The window that would hide what is at a place, or be hidden by it.
    pub(super) fn see(&self, p: &Vector3<f64>) -> Option<usize> {
        let found = self.outlook.as_ref()?.find(p)?;
        let mean = self.patches[found].as_ref()?.mean;
        // a window tells nothing of directions beside it
        let beside = (p * (mean.z / p.z) - mean).norm();
        (beside <= BESIDE * self.spread).then_some(found)
    }

    /// Share of its windows, moved by `other_from_self`, that have one of the other's within a distance (m); of
    /// about so many windows that are asked.
    pub(crate) fn share_near(
        &self,
        other: &Self,
        other_from_self: &Isometry3<f64>,
        within: f64,
        count: f64,
    ) -> f64 {
        let asked = self.every(self.stride(count));
        let is_near = |k: &&u32| {
            self.patches[**k as usize].as_ref().is_some_and(|own| {
                let p = other_from_self.transform_point(&own.mean.into()).coords;
                let found = other.find(&p, within).and_then(|k| other.patches[k].as_ref());
                found.is_some_and(|patch| (patch.mean - p).norm() <= within)
            })
        };
        asked.iter().filter(is_near).count() as f64 / asked.len().max(1) as f64
    }

    /// Numbers of the windows in every so manieth row and column.
    pub(super) fn every(&self, stride: usize) -> Vec<u32> {
        let is_there = |k: &usize| self.patches[*k].is_some();
        let count = self.patches.len();
        let found: Vec<usize> = match self.columns {
            Some(columns) => (0..count)
                .step_by(columns * stride)
                .flat_map(|row| (row..row + columns).step_by(stride))
                .filter(is_there)
                .collect(),
            None => (0..count).step_by(stride * stride).filter(is_there).collect(),
        };
        found.into_iter().map(|k| k as u32).collect()
    }

    /// The stride at which there are about so many windows.
    pub(super) fn stride(&self, count: f64) -> usize {
        (self.kept * self.patches.len() as f64 / count).sqrt().ceil().max(1.0) as usize
    }

    /// Of the farthest window from the middle, m.
    pub(super) fn radius(&self) -> f64 {
        self.corners.iter().map(|p| (p - self.middle).norm()).fold(0.0, f64::max)
    }

    /// Farthest distance between two places of a window.
    pub(super) fn moved(&self, a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
        let between = |p: &Vector3<f64>| {
            let p = (*p).into();
            (a.transform_point(&p) - b.transform_point(&p)).norm()
        };
        self.corners.iter().map(between).fold(0.0, f64::max)
    }
}

fn means(patches: &[Option<Patch>]) -> Vec<[f32; 3]> {
    patches.iter().flatten().map(|p| p.mean.map(|x| x as f32).into()).collect()
}

fn corners(patches: &[Option<Patch>]) -> [Vector3<f64>; 8] {
    let all = || patches.iter().flatten().map(|p| p.mean);
    let low = all().reduce(|a, b| a.inf(&b)).unwrap_or_default();
    let high = all().reduce(|a, b| a.sup(&b)).unwrap_or_default();
    std::array::from_fn(|k| Vector3::from_fn(|axis, _| [low, high][k >> axis & 1][axis]))
}
