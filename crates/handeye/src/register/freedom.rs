//! How well an answer is determined, and in which directions it is not.
//!
//! The normal equations of a plane determine all six directions, or seem to: noisy normals lean to all
//! sides, and a plane that slides on itself meets them all. What they would promise by their noise alone is
//! known, `N = Σ w s² K (I - m mᵀ) Kᵀ` with `K = [[p]ₓ; I]` and the variance `s²` of the normal `m`; a
//! direction in which the information `H` is not several times `N` is not determined.
//!
//! Residuals of neighbours are not independent: depth is wrong over some width, or the scan is bent. So
//! the surface is cut into tiles, and what each of them pulls, `Σ ψ J`, is compared with what its windows
//! would pull were they independent: the ratio of the squares scales the covariance `A⁻¹ B A⁻¹`, with
//! `A = Σ ψ' J Jᵀ` and `B = Σ ψ² J Jᵀ` of Tukey's `ψ`.
//!
//! A. Gelfand et al., *Geometrically stable sampling for the ICP algorithm*, 3DIM 2003; P. Huber, *Robust
//! statistics*, 1981.

use nalgebra::{Isometry3, Matrix3, Matrix6, SMatrix, SymmetricEigen, Vector3, Vector6};

use super::{descent::Descent, pair::Match};
use crate::lie;

/// Directions with less than so many times the information of noise alone are not determined.
const DETERMINED: f64 = 1.9;
/// Planes and creases feign so many times the information that planes alone would.
const FEIGNED: f64 = 1.4;
/// Of a motion that is a shift, the turn moves the rim by less than this share, squared.
const TURNS: f64 = 0.05;
/// Tiles are so many times as wide as the spread of a window.
const TILE: f64 = 10.0;
/// Fewer tiles say nothing of how much neighbours depend on each other.
const FEWEST_TILES: usize = 8;

/// Of an answer, in the target frame: a turn about the middle of the source, then a shift.
#[derive(Debug, Clone)]
pub struct Freedom {
    information: Matrix6<f64>,
    /// Squares of all pulls.
    pulls: Matrix6<f64>,
    /// Of what would be there without any shape.
    noise: Matrix6<f64>,
    /// Variance over that of windows which err independently.
    pub inflation: f64,
    middle: Vector3<f64>,
}

/// What a window in some tile pulls.
#[derive(Debug, Clone, Copy)]
struct Pull {
    tile: [i32; 3],
    j: Vector6<f64>,
    pull: f64,
    /// By how much less, where it has followed.
    slope: f64,
}

impl Freedom {
    pub fn of(descent: &Descent, at: &Isometry3<f64>) -> Self {
        let middle = descent.middle(at);
        let per_m = 1.0 / (TILE * descent.target.spread);
        let parts = descent.chunks(|range| {
            let mut sums = [Matrix6::zeros(); 3];
            let mut pulls = vec![];
            descent.each_match(at, range, |found| {
                let residual = found.residual();
                let share = residual.abs() / descent.limit(found.variance.sqrt());
                if share >= 1.0 {
                    return;
                }
                // psi and its slope, of Tukey's estimator
                let left = 1.0 - share * share;
                let slope = left * (left - 4.0 * share * share);
                let j = Vector6::from(found.jacobian());
                let pull = residual * left * left / found.variance;
                sums[0] += j * j.transpose() * (slope / found.variance);
                sums[1] += j * j.transpose() * (pull * pull);
                sums[2] += of_normals(&found) * (FEIGNED * slope / found.variance);
                let tile = found.arm.map(|x| (x * per_m).floor() as i32).into();
                pulls.push(Pull { tile, j, pull, slope: slope / found.variance });
            });
            (sums, pulls)
        });
        let (mut sums, mut pulls) = ([Matrix6::zeros(); 3], vec![]);
        for part in parts {
            (0..3).for_each(|k| sums[k] += part.0[k]);
            pulls.extend(part.1);
        }
        let inflation = inflation(pulls, &sums[0], &sums[1]).unwrap_or(1.0).max(1.0);
        Self { information: sums[0], pulls: sums[1], noise: sums[2], inflation, middle }
    }

    /// Directions, of which the first ones are not determined; and how many those are.
    pub fn directions(&self) -> (Matrix6<f64>, usize) {
        // without any noise, that of rounding
        let least = Matrix6::from_diagonal(&self.information.diagonal().map(|x| 1e-12 * x + 1e-30));
        let root = (self.noise + least).cholesky().and_then(|c| c.l().try_inverse());
        let Some(inverse) = root else { return (Matrix6::identity(), 6) };
        let ratio = inverse * self.information * inverse.transpose();
        let eigen = SymmetricEigen::new((ratio + ratio.transpose()) * 0.5);
        let columns = inverse.transpose() * eigen.eigenvectors;
        let is_free = |k: usize| eigen.eigenvalues[k] < DETERMINED;
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
        let [x, y, z] = (axis * 1e3).into();
        format!("a turn about {} through ({x:.0}, {y:.0}, {z:.0}) mm", direction(&turn))
    }

    /// 6 x 6, rotation first, perturbed on the right (in the source frame).
    pub fn covariance(&self, at: &Isometry3<f64>) -> Option<Matrix6<f64>> {
        // what the noise of normals feigns is no information
        let inverse = (self.information - self.noise).cholesky()?.inverse();
        let covariance = inverse * self.pulls * inverse * self.inflation;
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

/// Information that the noise of a match's normals feigns, per weight.
fn of_normals(found: &Match) -> Matrix6<f64> {
    let variance = |p: &super::patch::Patch| p.across / (p.count * p.along);
    let s = 0.25 * (variance(found.own) + variance(found.other));
    let mut k = SMatrix::<f64, 6, 3>::zeros();
    k.fixed_view_mut::<3, 3>(0, 0).copy_from(&lie::hat(&found.arm));
    k.fixed_view_mut::<3, 3>(3, 0).copy_from(&Matrix3::identity());
    k * (Matrix3::identity() - found.m * found.m.transpose()) * k.transpose() * s
}

/// Squares of what tiles pull, over those expected of windows that err independently; both in all directions
/// alike. The answer follows each tile, and so leaves it less: `E = B_t - L B_t - B_t Lᵀ + L B Lᵀ`, `L = A_t A⁻¹`.
fn inflation(mut pulls: Vec<Pull>, a: &Matrix6<f64>, b: &Matrix6<f64>) -> Option<f64> {
    let inverse = a.cholesky()?.inverse();
    pulls.sort_by_key(|pull| pull.tile);
    let (mut squares, mut expected, mut tiles) = (0.0, 0.0, 0);
    for tile in pulls.chunk_by(|a, b| a.tile == b.tile) {
        let (mut sum, mut own) = (Vector6::zeros(), [Matrix6::zeros(); 2]);
        for p in tile {
            sum += p.j * p.pull;
            let square = p.j * p.j.transpose();
            own[0] += square * p.slope;
            own[1] += square * (p.pull * p.pull);
        }
        let followed = own[0] * inverse;
        let less = followed * own[1];
        let left = own[1] - less - less.transpose() + followed * b * followed.transpose();
        squares += sum.dot(&(inverse * sum));
        expected += (inverse * left).trace();
        tiles += 1;
    }
    (tiles >= FEWEST_TILES && expected > 0.0).then_some(squares / expected)
}
