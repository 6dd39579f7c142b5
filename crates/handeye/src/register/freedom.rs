//! How well an answer is determined, and in which directions it is not.
//!
//! The normal equations of a plane determine all six directions, or seem to: noisy normals lean to all
//! sides, and a plane that slides on itself meets them all. What they would promise by their noise alone is
//! known, `N = Σ w s² K (I - m mᵀ) Kᵀ` with `K = [[p]ₓ; I]` and the variance `s²` of the normal `m`; a
//! direction in which the information `H` is not several times `N` is not determined. Where depth is wrong over
//! some width, normals lean more than the scatter of points promises: by how much, those that match tell.
//!
//! Residuals of neighbours are not independent: depth is wrong over some width, or the scan is bent. So
//! the surface is cut into tiles, and what each of them pulls, `Σ ψ J`, is compared with what its windows
//! would pull were they independent: along each axis of the covariance `A⁻¹ B A⁻¹`, with `A = Σ ψ' J Jᵀ`
//! and `B = Σ ψ² J Jᵀ` of Tukey's `ψ`, the ratio of the squares scales it, and nowhere less than the ratio
//! over all axes. A direction that a few edges hold is held by few tiles. Of the covariance that is told, `A` is
//! less what the noise of normals feigns.
//!
//! A. Gelfand et al., *Geometrically stable sampling for the ICP algorithm*, 3DIM 2003; P. Huber, *Robust
//! statistics*, 1981.

use nalgebra::{Isometry3, Matrix3, Matrix6, SymmetricEigen, Vector3, Vector6};

use super::{
    descent::{Descent, nothing},
    pair::Match,
    patch::Patch,
};
use crate::{
    math::{
        gram::{pairs, place},
        lie, linalg,
    },
    register::options::DenseMethod,
};

/// Directions with less than so many times the information of noise alone are not determined.
pub(crate) const DETERMINED: f64 = 1.9;
/// Planes and creases feign so many times the information that planes alone would.
pub(crate) const FEIGNED: f64 = 1.2;
/// Of a motion that is a shift, the turn moves the rim by less than this share, squared.
const TURNS: f64 = 0.05;
/// The narrowest tiles are so many times as wide as the spread of a window.
const TILE: f64 = 10.0;
/// They are made twice as wide so often, ...
const WIDER: usize = 2;
/// ... while there are so many: fewer say nothing of how much neighbours depend on each other.
const FEWEST_TILES: usize = 12;
/// Normals of exact surfaces differ by rounding, squared.
const LEAST_LEANING: f64 = 1e-10;
/// Share of the tiles' squares that an answer must leave for them to be compared along an axis.
const LEFT: f64 = 0.2;

/// Of an answer, in the target frame: a turn about the middle of the source, then a shift.
#[derive(Debug, Clone)]
pub(crate) struct Freedom {
    information: Matrix6<f64>,
    /// Squares of all pulls.
    pulls: Matrix6<f64>,
    /// Of what would be there without any shape.
    noise: Matrix6<f64>,
    /// Squares of what tiles pull, and what they would be if windows erred independently.
    pulled: Option<[Matrix6<f64>; 2]>,
    middle: Vector3<f64>,
}

/// Sums over matches whose windows lie in a tile.
#[derive(Debug, Clone, Copy)]
struct Tile {
    place: [i32; 3],
    /// `Σ ψ J`.
    pull: Vector6<f64>,
    /// `Σ ψ' J Jᵀ`.
    slopes: Triangle,
    /// `Σ ψ² J Jᵀ`.
    squares: Triangle,
}

impl Tile {
    fn at(place: [i32; 3]) -> Self {
        let none = Triangle::default();
        Self { place, pull: Vector6::zeros(), slopes: none, squares: none }
    }

    fn add(&mut self, other: &Self) {
        self.pull += other.pull;
        self.slopes.add(&other.slopes, 1.0);
        self.squares.add(&other.squares, 1.0);
    }
}

/// The upper triangle of a symmetric matrix.
#[derive(Debug, Clone, Copy, Default)]
struct Triangle([f64; pairs(6)]);

impl Triangle {
    /// Of a vector with itself.
    #[inline(always)]
    fn of(v: &[f64; 6]) -> Self {
        let mut all = Self::default();
        let mut next = 0;
        for a in 0..6 {
            for b in a..6 {
                all.0[next] = v[a] * v[b];
                next += 1;
            }
        }
        all
    }

    #[inline(always)]
    fn add(&mut self, other: &Self, weight: f64) {
        (0..pairs(6)).for_each(|k| self.0[k] += other.0[k] * weight);
    }

    fn whole(&self) -> Matrix6<f64> {
        Matrix6::from_fn(|a, b| self.0[place::<6>(a.min(b), a.max(b))])
    }
}

/// What the noise of normals feigns, `Σ w s² (K Kᵀ - J Jᵀ)`: for `K m = J`.
#[derive(Debug, Clone, Copy, Default)]
struct Feigned {
    weight: f64,
    arms: Vector3<f64>,
    products: Matrix3<f64>,
    jacobians: Triangle,
}

impl Feigned {
    #[inline(always)]
    fn add(&mut self, found: &Match, square: &Triangle, weight: f64, is_mean: bool) {
        let of_mean = || 0.25 * (of_normal(found.own) + of_normal(found.other));
        let weight = weight * if is_mean { of_mean() } else { of_normal(found.other) };
        self.weight += weight;
        self.arms += found.arm * weight;
        self.products += found.arm * found.arm.transpose() * weight;
        self.jacobians.add(square, weight);
    }

    fn add_all(&mut self, other: &Self) {
        self.weight += other.weight;
        self.arms += other.arms;
        self.products += other.products;
        self.jacobians.add(&other.jacobians, 1.0);
    }

    fn whole(&self) -> Matrix6<f64> {
        let hat = lie::hat(&self.arms);
        let one = Matrix3::identity();
        let mut all = -self.jacobians.whole();
        let mut part = |row, column, block: Matrix3<f64>| {
            let mut part = all.fixed_view_mut::<3, 3>(row, column);
            part += block;
        };
        part(0, 0, one * self.products.trace() - self.products);
        part(0, 3, hat);
        part(3, 0, hat.transpose());
        part(3, 3, one * self.weight);
        all
    }
}

/// Variance of a window's normal, in each direction across it.
#[inline(always)]
pub(crate) fn of_normal(patch: &Patch) -> f64 {
    patch.across / (patch.count * patch.along)
}

/// Squared difference of two normals, over what their scatter promises of it.
#[inline(always)]
pub(crate) fn leaning(found: &Match) -> f32 {
    let promised = 2.0 * (of_normal(found.own) + of_normal(found.other)) + LEAST_LEANING;
    ((found.turned - found.other.normal).norm_squared() / promised) as f32
}

/// Of what scatter promises, the multiple that is usual, and at least all.
pub fn usual(leanings: Vec<f64>) -> f64 {
    // of noise alone they are distributed exponentially; creases are few
    (linalg::median(leanings) / std::f64::consts::LN_2).max(1.0)
}

impl Freedom {
    pub fn of(descent: &Descent, at: &Isometry3<f64>) -> Self {
        let middle = descent.middle(at);
        let per_m = 1.0 / (TILE * descent.target.spread);
        let is_mean = descent.config.method != DenseMethod::PointToPlane;
        let parts = descent.chunks(|range| {
            let (mut runs, mut feigned, mut leanings) = (vec![], Feigned::default(), vec![]);
            descent.each_match(at, range, |found| {
                let residual = found.residual();
                let share = residual.abs() / descent.limit(found.variance.sqrt());
                if !(share < 1.0) {
                    return;
                }
                // psi and its slope, of Tukey's estimator
                let left = 1.0 - share * share;
                let slope = left * (left - 4.0 * share * share) / found.variance;
                let pull = residual * left * left / found.variance;
                let j = found.jacobian();
                let square = Triangle::of(&j);
                feigned.add(&found, &square, FEIGNED * slope, is_mean);
                leanings.push(leaning(&found));
                let tile = tile_at(&mut runs, found.arm.map(|x| (x * per_m).floor() as i32).into());
                tile.pull += Vector6::from(j) * pull;
                tile.slopes.add(&square, slope);
                tile.squares.add(&square, pull * pull);
            });
            (runs, feigned, leanings)
        });
        let (mut runs, mut feigned, mut leanings) = (vec![], Feigned::default(), vec![]);
        for part in parts {
            runs.extend(part.0);
            feigned.add_all(&part.1);
            leanings.extend(part.2.into_iter().map(f64::from));
        }
        let tiles = tiles(&runs);
        let mut all = Tile::at([0; 3]);
        tiles.iter().for_each(|tile| all.add(tile));
        let (information, pulls) = (all.slopes.whole(), all.squares.whole());
        let pulled = pulled(&tiles, &information, &pulls);
        let noise = feigned.whole() * usual(leanings);
        Self { information, pulls, noise, pulled, middle }
    }

    /// Directions, of which the first ones are not determined; and how many those are.
    pub fn directions(&self) -> (Matrix6<f64>, usize) {
        // without any noise, that of rounding
        let least = Matrix6::from_diagonal(&nothing(&self.information));
        let root = (self.noise + least).cholesky().and_then(|c| c.l().try_inverse());
        let Some(inverse) = root else { return (Matrix6::identity(), 6) };
        let ratio = inverse * self.information * inverse.transpose();
        let eigen = SymmetricEigen::new((ratio + ratio.transpose()) * 0.5);
        let columns = inverse.transpose() * eigen.eigenvectors;
        let is_free = |k: usize| !(eigen.eigenvalues[k] >= DETERMINED);
        let mut order: Vec<(bool, usize)> = (0..6).map(|k| (!is_free(k), k)).collect();
        order.sort_unstable();
        let free = order.iter().filter(|(is_fixed, _)| !is_fixed).count();
        (Matrix6::from_fn(|row, k| columns[(row, order[k].1)]), free)
    }

    /// In words, each of these columns (or of others that span the same), in the target frame.
    pub fn named(&self, columns: &[Vector6<f64>], radius_m: f64) -> Vec<String> {
        let scale = |v: &Vector6<f64>| {
            Vector6::new(v[0] * radius_m, v[1] * radius_m, v[2] * radius_m, v[3], v[4], v[5])
        };
        let mut space: Vec<Vector6<f64>> = columns.iter().map(scale).collect();
        orthonormalise(&mut space);
        let mut turning = Matrix6::zeros();
        for (a, v) in space.iter().enumerate() {
            for (b, w) in space.iter().enumerate() {
                turning[(a, b)] = lie::omega(v).dot(&lie::omega(w));
            }
        }
        let eigen = SymmetricEigen::new(turning);
        let mut order: Vec<usize> =
            (0..6).filter(|k| is_of(&eigen.eigenvectors, *k, space.len())).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let motion = |k: &usize| -> Vector6<f64> {
            space.iter().enumerate().map(|(a, v)| v * eigen.eigenvectors[(a, *k)]).sum()
        };
        order.iter().map(|k| self.name(&motion(k), eigen.eigenvalues[*k], radius_m)).collect()
    }

    /// Of a motion whose turn is scaled by the radius, and makes up this share of it.
    fn name(&self, motion: &Vector6<f64>, turning: f64, radius_m: f64) -> String {
        let (turn, shift) = (lie::omega(motion) / radius_m, lie::nu(motion));
        if turning < TURNS {
            return format!("a shift along {}", direction(&shift));
        }
        let axis = self.middle + turn.cross(&shift) / turn.norm_squared();
        let [x, y, z] = (axis * 1e3).map(|x| if x.abs() < 0.5 { 0.0 } else { x }).into();
        format!("a turn about {} through ({x:.0}, {y:.0}, {z:.0}) mm", direction(&turn))
    }

    /// Of the answer whose information has this inverse, in the target frame.
    fn inflated(&self, inverse: &Matrix6<f64>) -> Matrix6<f64> {
        let independent = inverse * self.pulls * inverse;
        let Some([squares, expected]) = &self.pulled else { return independent };
        let all = (inverse * squares).trace() / (inverse * expected).trace();
        // turns as shifts at the end of an arm: axes depend on units
        let of = |k| self.information.fixed_view::<3, 3>(k, k).trace();
        let arm = (of(0) / of(3)).sqrt();
        let scaled = |by: f64| Matrix6::from_diagonal(&Vector6::new(by, by, by, 1.0, 1.0, 1.0));
        let mut axes = SymmetricEigen::new(scaled(arm) * independent * scaled(arm));
        for k in 0..6 {
            let v = inverse * scaled(arm) * axes.eigenvectors.column(k);
            let (square, left) = (v.dot(&(squares * v)), v.dot(&(expected * v)));
            // what holds on to one tile leaves it nothing that could be compared
            let is_held_by_many = left > LEFT * v.dot(&(self.pulls * v));
            let own = if is_held_by_many { square / left } else { 1.0 };
            axes.eigenvalues[k] *= own.max(all).max(1.0);
        }
        scaled(1.0 / arm) * axes.recompose() * scaled(1.0 / arm)
    }

    /// 6 x 6, rotation first, perturbed on the right (in the source frame).
    pub fn covariance(&self, at: &Isometry3<f64>) -> Option<Matrix6<f64>> {
        // what the noise of normals feigns is no information
        let inverse = (self.information - self.noise).cholesky()?.inverse();
        let covariance = self.inflated(&inverse);
        let back = at.rotation.to_rotation_matrix().into_inner().transpose();
        let mut a = Matrix6::zeros();
        a.fixed_view_mut::<3, 3>(0, 0).copy_from(&back);
        // v = Rᵀ (s - ω x (middle - t))
        let arm = lie::hat(&(self.middle - at.translation.vector));
        a.fixed_view_mut::<3, 3>(3, 0).copy_from(&(back * arm));
        a.fixed_view_mut::<3, 3>(3, 3).copy_from(&back);
        Some(a * covariance * a.transpose())
    }
}

/// Whether an eigenvector is one of the first dimensions, and not of those that are not used.
fn is_of(eigenvectors: &Matrix6<f64>, k: usize, dimensions: usize) -> bool {
    (0..dimensions).map(|a| eigenvectors[(a, k)].powi(2)).sum::<f64>() > 0.5
}

fn orthonormalise(space: &mut [Vector6<f64>]) {
    for k in 0..space.len() {
        for other in 0..k {
            let before = space[other];
            let along = before.dot(&space[k]);
            space[k] -= before * along;
        }
        space[k].normalize_mut();
    }
}

/// Of a vector, of which the largest coordinate is positive.
fn direction(v: &Vector3<f64>) -> String {
    let sign = v[v.iamax()].signum();
    // no minus before what is rounded to zero
    let [x, y, z] = (v.normalize() * sign).map(|x| if x.abs() < 5e-3 { 0.0 } else { x }).into();
    format!("({x:.2}, {y:.2}, {z:.2})")
}

/// The last run of matches in one tile, or the first of another.
fn tile_at(runs: &mut Vec<Tile>, place: [i32; 3]) -> &mut Tile {
    if runs.last().is_none_or(|last| last.place != place) {
        runs.push(Tile::at(place));
    }
    let last = runs.len() - 1;
    &mut runs[last]
}

/// As wide as they may be.
fn tiles(runs: &[Tile]) -> Vec<Tile> {
    let mut tiles = joined(runs);
    for _ in 0..WIDER {
        let halved = |tile: &Tile| Tile { place: tile.place.map(|k| k.div_euclid(2)), ..*tile };
        let wider = joined(&tiles.iter().map(halved).collect::<Vec<_>>());
        if wider.len() < FEWEST_TILES {
            break;
        }
        tiles = wider;
    }
    tiles
}

/// Runs of the same tile in one.
fn joined(runs: &[Tile]) -> Vec<Tile> {
    let mut order: Vec<usize> = (0..runs.len()).collect();
    order.sort_by_key(|k| runs[*k].place);
    let mut tiles = vec![];
    for k in order {
        tile_at(&mut tiles, runs[k].place).add(&runs[k]);
    }
    tiles
}

/// Squares of what tiles pull, and those expected of windows that err independently. The answer follows each tile,
/// and so leaves it less: `E = B_t - L B_t - B_t Lᵀ + L B Lᵀ`, `L = A_t A⁻¹`.
fn pulled(tiles: &[Tile], a: &Matrix6<f64>, b: &Matrix6<f64>) -> Option<[Matrix6<f64>; 2]> {
    let inverse = a.cholesky()?.inverse();
    let (mut squares, mut expected) = (Matrix6::zeros(), Matrix6::zeros());
    for tile in tiles {
        let followed = tile.slopes.whole() * inverse;
        let own = tile.squares.whole();
        let less = followed * own;
        expected += own - less - less.transpose() + followed * b * followed.transpose();
        squares += tile.pull * tile.pull.transpose();
    }
    (tiles.len() >= FEWEST_TILES).then_some([squares, expected])
}
