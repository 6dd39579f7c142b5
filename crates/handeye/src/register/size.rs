//! Whether two scans show things in one size.
//!
//! A camera whose depth is off by a percent, or a drawing of another version, comes to lie where as much is too large
//! as too small, and the rounds leave out what does not fit. So once more, from the answer, with a seventh unknown:
//! the source grows about its middle, a match is moved along its arm, and `J = [arm × m, m, arm · m]`.

use nalgebra::{Isometry3, SMatrix, SVector, Vector3};

use super::descent::Descent;
use crate::linalg;

type Vector7 = SVector<f64, 7>;
type Matrix7 = SMatrix<f64, 7, 7>;

/// Matches that are asked.
const ASKED: f64 = 5000.0;
/// Beyond so many standard deviations residuals do not count.
const TUKEY: f64 = 4.685;
/// Standard deviations in a median absolute deviation.
const MAD: f64 = 1.4826;
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
    tile: [i32; 3],
}

impl Size {
    /// Of an answer; `None` where the surfaces do not tell.
    pub fn of(descent: &mut Descent, at: &Isometry3<f64>) -> Option<Self> {
        let rows = rows(descent, at, 1.0 / (TILE * descent.target.spread));
        let mut x = Vector7::zeros();
        for _ in 0..MOST_ROUNDS {
            let limit = limit(&rows, &x);
            let (mut information, mut gradient) = (Matrix7::zeros(), Vector7::zeros());
            for (row, left, residual) in within(&rows, &x, limit) {
                information += row.jacobian * row.jacobian.transpose() * (left * left);
                gradient += row.jacobian * (left * left * residual);
            }
            let step = information.cholesky()?.solve(&gradient);
            x -= step;
            if step[6].abs() < SETTLED {
                break;
            }
        }
        let variance = variance(&rows, &x)?;
        Some(Self { ratio: 1.0 + x[6], sigma: variance.sqrt() })
    }

    /// Whether no rigid motion makes one of the other.
    pub fn differs(&self) -> bool {
        (self.ratio - 1.0).abs() > TOLERATED.max(SURE * self.sigma)
    }
}

/// Of the size, from what each tile pulls.
fn variance(rows: &[Row], x: &Vector7) -> Option<f64> {
    let mut slopes = Matrix7::zeros();
    let mut pulls: Vec<([i32; 3], Vector7)> = vec![];
    for (row, left, residual) in within(rows, x, limit(rows, x)) {
        let slope = left * (left - 4.0 * (1.0 - left));
        slopes += row.jacobian * row.jacobian.transpose() * slope;
        pulls.push((row.tile, row.jacobian * (left * left * residual)));
    }
    pulls.sort_by_key(|pull| pull.0);
    let inverse = slopes.cholesky()?.inverse();
    let tiles = pulls.chunk_by(|a, b| a.0 == b.0);
    let count = tiles.clone().count();
    let size = |v: Vector7| (inverse * v)[6].powi(2);
    let of_tiles: f64 = tiles.map(|tile| size(tile.iter().map(|pull| pull.1).sum())).sum();
    let of_rows: f64 = pulls.iter().map(|pull| size(pull.1)).sum();
    (count >= FEWEST_TILES).then(|| of_tiles.max(of_rows) * count as f64 / (count - 7) as f64)
}

fn rows(descent: &mut Descent, at: &Isometry3<f64>, per_m: f64) -> Vec<Row> {
    let mut rows = vec![];
    descent.each_nearby(at, ASKED, |found| {
        let deviation = found.variance.sqrt();
        let [a, b, c, d, e, f] = found.jacobian();
        let grows = Vector3::new(d, e, f).dot(&found.arm);
        rows.push(Row {
            jacobian: Vector7::from([a, b, c, d, e, f, grows]) / deviation,
            residual: found.residual() / deviation,
            tile: found.arm.map(|x| (x * per_m).floor() as i32).into(),
        });
    });
    rows
}

/// Residuals beyond do not count.
fn limit(rows: &[Row], x: &Vector7) -> f64 {
    let all = rows.iter().map(|row| (row.residual + row.jacobian.dot(x)).abs());
    TUKEY * MAD * linalg::median(all)
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
