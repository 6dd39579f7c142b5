//! Whether two scans show things in one size.
//!
//! A camera whose depth is off by a percent, or a drawing of another version, comes to lie where as much is too large
//! as too small, and the rounds leave out what does not fit. So once more, from the answer, with a seventh unknown:
//! the source grows about its middle, a match is moved along its arm,
//!
//! ```text
//! J = K m    K = [[arm]ₓ; I; armᵀ]
//! ```
//!
//! Normals that lean feign the information `N = Σ w s² (K Kᵀ - J Jᵀ)`, and would hide a part of the difference: the
//! equations are `(Σ w J Jᵀ - N) x = -Σ w J r`.

use nalgebra::{Isometry3, Matrix3, SMatrix, SVector};

use super::{
    descent::{Descent, LEAST_SIGMA},
    freedom::{DETERMINED, FEIGNED, leaning, of_normal, usual},
    pair::Match,
};
use crate::math::{lie, linalg, statistics::SIGMAS_OF_MAD};

type Vector7 = SVector<f64, 7>;
type Matrix7 = SMatrix<f64, 7, 7>;

/// Matches that are asked.
const ASKED: f64 = 5000.0;
/// Beyond so many standard deviations residuals do not count.
const TUKEY: f64 = 4.685;
/// Most rounds.
const MOST_ROUNDS: usize = 30;
/// A round that changes the size by less is the last.
const SETTLED: f64 = 1e-6;
/// Tiles are so many times as wide as the spread of a window.
const TILE: f64 = 20.0;
/// Fewer tiles do not tell how much neighbours depend on each other.
const FEWEST_TILES: usize = 12;

/// A smaller difference may be that of two good scans.
const TOLERATED: f64 = 2e-3;
/// A difference is sure from so many standard deviations on.
const SURE: f64 = 4.0;

/// Of what the target shows, over that of what the source shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    /// 1 where both are of one size.
    pub ratio: f64,
    /// Its standard deviation, dependent neighbours accounted for.
    pub sigma: f64,
}

/// A match, over the deviation of its distance.
struct Row {
    jacobian: Vector7,
    residual: f64,
    /// What its normal's noise feigns, as that promises it.
    feigned: Matrix7,
    tile: [i32; 3],
}

impl Size {
    /// Of an answer; `None` where the surfaces do not tell.
    pub fn of(descent: &mut Descent, at: &Isometry3<f64>) -> Option<Self> {
        let rows = rows(descent, at);
        let mut x = Vector7::zeros();
        for _ in 0..MOST_ROUNDS {
            let limit = limit(&rows, &x);
            let (mut information, mut gradient) = (Matrix7::zeros(), Vector7::zeros());
            for (row, left, residual) in within(&rows, &x, limit) {
                let weight = left * left;
                information += row.information() * weight;
                gradient += row.pull(residual, &x) * weight;
            }
            let step = information.cholesky()?.solve(&gradient);
            x -= step;
            if step[6].abs() < SETTLED {
                let variance = variance(&rows, &x)?;
                return Some(Self { ratio: 1.0 + x[6], sigma: variance.sqrt() });
            }
        }
        None
    }

    /// Whether no rigid motion makes one of the other.
    pub fn differs(&self) -> bool {
        (self.ratio - 1.0).abs() > TOLERATED.max(SURE * self.sigma)
    }
}

impl Row {
    fn information(&self) -> Matrix7 {
        self.jacobian * self.jacobian.transpose() - self.feigned
    }

    fn pull(&self, residual: f64, x: &Vector7) -> Vector7 {
        self.jacobian * residual - self.feigned * x
    }
}

/// Of the size, from what each tile pulls; `None` where normals feign most of what is known of it.
fn variance(rows: &[Row], x: &Vector7) -> Option<f64> {
    let (mut slopes, mut feigned) = (Matrix7::zeros(), Matrix7::zeros());
    let mut pulls: Vec<([i32; 3], Vector7)> = vec![];
    for (row, left, residual) in within(rows, x, limit(rows, x)) {
        let slope = left * (left - 4.0 * (1.0 - left));
        slopes += row.information() * slope;
        feigned += row.feigned * slope;
        pulls.push((row.tile, row.pull(residual, x) * (left * left)));
    }
    pulls.sort_by_key(|pull| pull.0);
    let inverse = slopes.cholesky()?.inverse();
    // of the size alone, when the six others follow
    let [all, real] = [(slopes + feigned).cholesky()?.inverse(), inverse].map(|m| 1.0 / m[(6, 6)]);
    if real < (1.0 - 1.0 / DETERMINED) * all {
        return None;
    }
    let tiles = pulls.chunk_by(|a, b| a.0 == b.0);
    let count = tiles.clone().count();
    let size = |v: Vector7| (inverse * v)[6].powi(2);
    let of_tiles: f64 = tiles.map(|tile| size(tile.iter().map(|pull| pull.1).sum())).sum();
    let of_rows: f64 = pulls.iter().map(|pull| size(pull.1)).sum();
    (count >= FEWEST_TILES).then(|| of_tiles.max(of_rows) * count as f64 / (count - 7) as f64)
}

/// About [`ASKED`] matches; those of the descent are lost.
fn rows(descent: &mut Descent, at: &Isometry3<f64>) -> Vec<Row> {
    let per_m = 1.0 / (TILE * descent.target.spread);
    let (mut rows, mut leanings) = (vec![], vec![]);
    descent.each_nearby(at, ASKED, |found| {
        let deviation = found.variance.sqrt();
        let [a, b, c, d, e, f] = found.jacobian();
        let jacobian = Vector7::from([a, b, c, d, e, f, found.m.dot(&found.arm)]) / deviation;
        leanings.push(f64::from(leaning(&found)));
        rows.push(Row {
            feigned: feigned(&found) / found.variance
                - jacobian * jacobian.transpose() * of_mean(&found),
            jacobian,
            residual: found.residual() / deviation,
            tile: found.arm.map(|x| (x * per_m).floor() as i32).into(),
        });
    });
    if !rows.is_empty() {
        let usual = FEIGNED * usual(leanings);
        rows.iter_mut().for_each(|row| row.feigned *= usual);
    }
    rows
}

/// Variance of the mean of both normals, in each direction across it.
fn of_mean(found: &Match) -> f64 {
    0.25 * (of_normal(found.own) + of_normal(found.other))
}

/// `s² K Kᵀ`.
fn feigned(found: &Match) -> Matrix7 {
    let mut k = SMatrix::<f64, 7, 3>::zeros();
    k.fixed_view_mut::<3, 3>(0, 0).copy_from(&lie::hat(&found.arm));
    k.fixed_view_mut::<3, 3>(3, 0).copy_from(&Matrix3::identity());
    k.fixed_view_mut::<1, 3>(6, 0).copy_from(&found.arm.transpose());
    k * k.transpose() * of_mean(found)
}

/// Residuals beyond do not count.
fn limit(rows: &[Row], x: &Vector7) -> f64 {
    let all = rows.iter().map(|row| (row.residual + row.jacobian.dot(x)).abs());
    TUKEY * (SIGMAS_OF_MAD * linalg::median(all)).max(LEAST_SIGMA)
}

/// Rows that count, the share that is left of their weight (its root), and their residuals.
fn within<'a>(
    rows: &'a [Row],
    x: &'a Vector7,
    limit: f64,
) -> impl Iterator<Item = (&'a Row, f64, f64)> {
    rows.iter().filter_map(move |row| {
        let residual = row.residual + row.jacobian.dot(x);
        let left = 1.0 - (residual / limit).powi(2);
        (left > 0.0).then_some((row, left, residual))
    })
}
