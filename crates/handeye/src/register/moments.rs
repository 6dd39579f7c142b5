//! What a rigid fit needs to know of its pairs, by one pass over them.

use multiversion::multiversion;
use nalgebra::{Matrix3, Vector3};

use crate::math::gram::place;

/// Sums over pairs `(p, q)` about their centroids.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moments {
    /// How many pairs.
    pub weight: f64,
    pub p_mean: Vector3<f64>,
    pub q_mean: Vector3<f64>,
    /// `Σ (q - q̄)(p - p̄)ᵀ`.
    pub cross: Matrix3<f64>,
    /// `Σ (p - p̄)(p - p̄)ᵀ`.
    pub scatter: Matrix3<f64>,
    /// `Σ |q - q̄|²`.
    pub q_squared: f64,
}

impl Moments {
    /// `None` of no pairs; not finite where one is not.
    pub fn of(source: &[Vector3<f64>], target: &[Vector3<f64>]) -> Option<Self> {
        let (p_first, q_first) = (source.first()?, target.first()?);
        let sums = sums(source, target, &(*p_first, *q_first));
        Some(Self::about(p_first, q_first, &sums))
    }

    fn about(p_first: &Vector3<f64>, q_first: &Vector3<f64>, sums: &[f64; SUMS]) -> Self {
        let weight = sums[0];
        let (p, q) =
            (Vector3::from_column_slice(&sums[1..4]), Vector3::from_column_slice(&sums[4..7]));
        let [xx, xy, xz, yy, yz, zz] = std::array::from_fn(|k| sums[16 + k]);
        let scatter = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        Self {
            weight,
            p_mean: p_first + p / weight,
            q_mean: q_first + q / weight,
            cross: Matrix3::from_column_slice(&sums[7..16]) - q * p.transpose() / weight,
            scatter: scatter - p * p.transpose() / weight,
            q_squared: sums[22] - q.norm_squared() / weight,
        }
    }

    /// `Σ |p - p̄|²`.
    pub(crate) fn p_squared(&self) -> f64 {
        self.scatter.trace()
    }
}

/// `1, p, q, q pᵀ, p pᵀ, qᵀq`.
const SUMS: usize = 23;
/// Pairs are added in blocks of so many.
const BLOCK: usize = 16;
/// Sums that are kept apart until the end.
const LANES: usize = 4;

type First = (Vector3<f64>, Vector3<f64>);

/// Coordinates of some pairs, one after the other, and one for each pair; zero beyond the last pair.
struct Block {
    p: [[f64; BLOCK]; 3],
    q: [[f64; BLOCK]; 3],
    w: [f64; BLOCK],
}

impl Block {
    /// Relative to the first pair: far from the origin, squares lose digits.
    #[inline(always)]
    fn new(source: &[Vector3<f64>], target: &[Vector3<f64>], first: &First) -> Self {
        let (p, q) = (transposed(source, &first.0), transposed(target, &first.1));
        let mut w = [0.0; BLOCK];
        w[..source.len().min(BLOCK)].fill(1.0);
        Self { p, q, w }
    }

    #[inline(always)]
    fn add_to(&self, sums: &mut [[f64; LANES]; SUMS]) {
        let Self { p, q, w } = self;
        let ones = [1.0; BLOCK];
        add(&mut sums[0], w, &ones);
        for i in 0..3 {
            add(&mut sums[1 + i], &p[i], &ones);
            add(&mut sums[4 + i], &q[i], &ones);
            add(&mut sums[22], &q[i], &q[i]);
            for j in 0..3 {
                add(&mut sums[7 + 3 * j + i], &q[i], &p[j]);
            }
            for j in i..3 {
                add(&mut sums[16 + place::<3>(i, j)], &p[i], &p[j]);
            }
        }
    }
}

#[inline(always)]
fn transposed(points: &[Vector3<f64>], first: &Vector3<f64>) -> [[f64; BLOCK]; 3] {
    let mut block = [[0.0; BLOCK]; 3];
    if let Ok(points) = <&[Vector3<f64>; BLOCK]>::try_from(points) {
        for k in 0..BLOCK {
            for axis in 0..3 {
                block[axis][k] = points[k][axis] - first[axis];
            }
        }
    } else {
        for (k, point) in points.iter().enumerate().take(BLOCK) {
            for axis in 0..3 {
                block[axis][k] = point[axis] - first[axis];
            }
        }
    }
    block
}

#[inline(always)]
fn add(sum: &mut [f64; LANES], a: &[f64; BLOCK], b: &[f64; BLOCK]) {
    let mut lanes = *sum;
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for k in 0..LANES {
            lanes[k] += a[k] * b[k];
        }
    }
    *sum = lanes;
}

#[multiversion(targets("x86_64+avx2"))]
fn sums(source: &[Vector3<f64>], target: &[Vector3<f64>], first: &First) -> [f64; SUMS] {
    let mut sums = [[0.0; LANES]; SUMS];
    for (p, q) in source.chunks(BLOCK).zip(target.chunks(BLOCK)) {
        Block::new(p, q, first).add_to(&mut sums);
    }
    sums.map(|lanes| lanes.iter().sum())
}
