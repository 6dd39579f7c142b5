//! Is the board flat? What its corners in the scans say, over all captures together.
//!
//! In capture `k` the corners lie at heights `h` above a plane, in board coordinates `(x, y)`,
//!
//! ```text
//! h = a_k + b_k x + c_k y + q₁ x² + q₂ xy + q₃ y² + noise
//! ```
//!
//! The plane belongs to the capture, the surface `q` to the board: with `Λ_k` the information on `q`
//! that is left when the plane is free, and `q_k` the capture's own surface,
//!
//! ```text
//! q = (Σ Λ_k)⁻¹ Σ Λ_k q_k          F = qᵀ Σ Λ_k q/(3 β²)         β² = Σ (q_k - q)ᵀ Λ_k (q_k - q)/(3 (K - 1))
//! ```
//!
//! The captures' own differences (R. Birge, Phys. Rev. 40, 1932) thus say how sure `q` is. A camera
//! that bends every flat surface alike cannot be told from a bent board, unless it is turned.

use nalgebra::{Matrix3, Matrix6, Point3, Vector2, Vector3, Vector6};

use super::thresholds::{IMPROBABLE_BEND, LEAST_BEND};
use crate::{
    TargetModel,
    detect::surface::tukey,
    math::{
        linalg::{median, root_mean},
        statistics::{self, MAD},
    },
};

/// A corner in a scan: its position on the board (m), in the camera (m), and covariance (m²).
pub type ScanCorner = (Vector2<f64>, Vector3<f64>, Matrix3<f64>);

/// Deviation of one surface from its plane, positive away from the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bend {
    /// Root mean square deviation of the corners from their plane, m; noise included.
    pub rms_m: f64,
    /// Highest minus lowest corner of the fitted quadratic surface, its own plane taken off, m.
    pub peak_to_valley_m: f64,
    /// Its standard deviation, m.
    pub sigma_m: f64,
    /// Chance that noise alone looks so bent.
    pub chance: f64,
}

/// The mean deviation of one place on the board.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// Place on the board, m.
    pub at: Vector2<f64>,
    /// Away from the camera, m.
    pub height_m: f64,
    /// Its standard deviation, m.
    pub sigma_m: f64,
}

/// What all captures say.
#[derive(Debug, Clone, PartialEq)]
pub struct Flatness {
    /// Of all captures together.
    pub board: Bend,
    /// Of each capture; `None` where its corners are too few.
    pub captures: Vec<Option<Bend>>,
    /// Mean deviation of every place that was seen.
    pub map: Vec<Deviation>,
    /// Typical standard deviation of one corner across the board, m.
    pub corner_sigma_m: f64,
}

impl Flatness {
    /// Whether the board is bent by more than noise shows, and more than boards are.
    pub fn is_bent(&self, target: &TargetModel) -> bool {
        self.board.chance < IMPROBABLE_BEND
            && self.board.peak_to_valley_m > LEAST_BEND * extent(target)
    }
}

/// From one end of a target's corners to the other, across (m).
pub fn extent(target: &TargetModel) -> f64 {
    let (low, high) = target.corners().iter().map(|c| c.vector()).fold(
        (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)),
        |(low, high), p| (low.inf(&p), high.sup(&p)),
    );
    (high - low).norm()
}

/// Fewer corners do not tell a surface of six coefficients.
const FEWEST_CORNERS: usize = 9;
/// Rounds of re-weighting.
const ROUNDS: usize = 4;

/// What one capture says.
struct Surface {
    /// Information on the curvature, the plane being free, with the scatter of the corners as it is.
    information: Matrix3<f64>,
    curvature: Vector3<f64>,
    /// Deviations from the plane that the curvature leaves free, and their variances.
    deviations: Vec<(Vector2<f64>, f64, f64)>,
}

/// Board coordinates with the corners between -1 and 1.
struct Scale {
    middle: Vector2<f64>,
    half: f64,
}

impl Scale {
    fn of<'a>(all: impl Iterator<Item = &'a ScanCorner>) -> Option<Self> {
        let (low, high) = all.fold(
            (Vector2::repeat(f64::INFINITY), Vector2::repeat(f64::NEG_INFINITY)),
            |(low, high), f| (low.inf(&f.0), high.sup(&f.0)),
        );
        let half = 0.5 * (high - low).max();
        (half > 0.0 && half.is_finite()).then(|| Self { middle: 0.5 * (low + high), half })
    }

    fn basis(&self, at: &Vector2<f64>) -> Vector6<f64> {
        let p = (at - self.middle) / self.half;
        Vector6::new(1.0, p.x, p.y, p.x * p.x, p.x * p.y, p.y * p.y)
    }
}

/// The flatness of a board, from the corners of each capture; `None` where no capture tells.
pub fn flatness(captures: &[Vec<ScanCorner>]) -> Option<Flatness> {
    let scale = Scale::of(captures.iter().flatten())?;
    let surfaces: Vec<Option<Surface>> = captures.iter().map(|c| surface(c, &scale)).collect();
    let all: Vec<&Surface> = surfaces.iter().flatten().collect();
    let information: Matrix3<f64> = all.iter().map(|s| s.information).sum();
    let weighted: Vector3<f64> = all.iter().map(|s| s.information * s.curvature).sum();
    let covariance = information.cholesky()?.inverse();
    let curvature = covariance * weighted;
    let off = |s: &&Surface| {
        let d = s.curvature - curvature;
        d.dot(&(s.information * d))
    };
    let freedom = 3.0 * (all.len() as f64 - 1.0);
    let excess =
        if freedom > 0.0 { (all.iter().map(off).sum::<f64>() / freedom).max(1.0) } else { 1.0 };
    let map = map(&all);
    let places: Vec<Vector2<f64>> = map.iter().map(|d| d.at).collect();
    let rms_m = root_mean(map.iter().map(|d| d.height_m.powi(2))).unwrap_or(0.0);
    let f = curvature.dot(&(information * curvature)) / (3.0 * excess);
    let chance = if freedom > 0.0 {
        statistics::of_f(f, (3.0, freedom))
    } else {
        statistics::of_chi_square(3.0 * f, 3)
    };
    let board = bend(&curvature, &(covariance * excess), &places, &scale, (rms_m, chance));
    let captures = surfaces.iter().map(|s| s.as_ref().and_then(|s| own_bend(s, &scale))).collect();
    let variances = all.iter().flat_map(|s| s.deviations.iter().map(|d| d.2));
    Some(Flatness { board, captures, map, corner_sigma_m: median(variances).sqrt() })
}

fn own_bend(s: &Surface, scale: &Scale) -> Option<Bend> {
    let places: Vec<Vector2<f64>> = s.deviations.iter().map(|d| d.0).collect();
    let covariance = s.information.cholesky()?.inverse();
    let chi2 = s.curvature.dot(&(s.information * s.curvature));
    let rms_and_p = (
        root_mean(s.deviations.iter().map(|d| d.1.powi(2))).unwrap_or(0.0),
        statistics::of_chi_square(chi2, 3),
    );
    Some(bend(&s.curvature, &covariance, &places, scale, rms_and_p))
}

/// Heights of one capture's corners, and the surface through them.
fn surface(corners: &[ScanCorner], scale: &Scale) -> Option<Surface> {
    if corners.len() < FEWEST_CORNERS {
        return None;
    }
    let (middle, normal) = plane_of(corners)?;
    let heights: Vec<(Vector6<f64>, f64, f64)> = corners
        .iter()
        .map(|(at, p, s)| (scale.basis(at), normal.dot(&(p - middle)), normal.dot(&(s * normal))))
        .filter(|(_, h, v)| h.is_finite() && *v > 0.0)
        .collect();
    let mut weights: Vec<f64> = heights.iter().map(|h| h.2.recip()).collect();
    let mut found = (Matrix6::zeros(), Vector6::zeros());
    let mut excess = 1.0;
    for _ in 0..ROUNDS {
        let (mut a, mut b) = (Matrix6::zeros(), Vector6::zeros());
        for ((row, h, _), w) in heights.iter().zip(&weights) {
            a += row * row.transpose() * *w;
            b += row * (w * h);
        }
        found = (a, a.cholesky()?.solve(&b));
        let off: Vec<f64> =
            heights.iter().map(|(row, h, v)| (h - row.dot(&found.1)) / v.sqrt()).collect();
        let scatter = (median(off.iter().map(|o| o.abs())) / MAD).max(1.0);
        excess = scatter * scatter;
        let reweighted = off.iter().zip(&heights).map(|(o, h)| tukey(o / scatter) / h.2);
        weights = reweighted.collect();
    }
    let (plane, own, cross) = (
        found.0.fixed_view::<3, 3>(0, 0).into_owned(),
        found.0.fixed_view::<3, 3>(3, 3).into_owned(),
        found.0.fixed_view::<3, 3>(0, 3).into_owned(),
    );
    let carried = plane.cholesky()?.solve(&cross);
    let curvature: Vector3<f64> = found.1.fixed_rows::<3>(3).into_owned();
    // the plane that fits best when there is no curvature
    let flat: Vector3<f64> = found.1.fixed_rows::<3>(0) + carried * curvature;
    let deviations = corners.iter().zip(&heights).zip(&weights).filter(|(_, w)| **w > 0.0);
    let deviations = deviations
        .map(|((c, (row, h, v)), _)| (c.0, h - row.fixed_rows::<3>(0).dot(&flat), *v))
        .collect();
    let information = (own - cross.transpose() * carried) / excess;
    Some(Surface { information, curvature, deviations })
}

/// Middle and normal, away from the camera, of the plane through points.
fn plane_of(corners: &[ScanCorner]) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let middle = corners.iter().map(|c| c.1).sum::<Vector3<f64>>() / corners.len() as f64;
    let scatter: Matrix3<f64> =
        corners.iter().map(|c| (c.1 - middle) * (c.1 - middle).transpose()).sum();
    let eigen = scatter.symmetric_eigen();
    let least = eigen.eigenvalues.imin();
    let normal = eigen.eigenvectors.column(least).into_owned();
    let finite = Point3::from(middle).iter().chain(normal.iter()).all(|x| x.is_finite());
    finite.then(|| (middle, if normal.dot(&middle) < 0.0 { -normal } else { normal }))
}

/// Extremes of the quadratic surface over some places.
fn bend(
    curvature: &Vector3<f64>,
    covariance: &Matrix3<f64>,
    places: &[Vector2<f64>],
    scale: &Scale,
    (rms_m, chance): (f64, f64),
) -> Bend {
    let rows = without_plane(places, scale);
    let height = |row: &Vector3<f64>| row.dot(curvature);
    let order = |a: &&Vector3<f64>, b: &&Vector3<f64>| height(a).total_cmp(&height(b));
    let ends = rows.iter().max_by(order).zip(rows.iter().min_by(order));
    let (peak_to_valley_m, sigma_m) = ends.map_or((0.0, 0.0), |(high, low)| {
        let d = high - low;
        (d.dot(curvature), d.dot(&(covariance * d)).max(0.0).sqrt())
    });
    Bend { rms_m, peak_to_valley_m, sigma_m, chance }
}

/// The quadratic terms at some places, the plane through them taken off.
fn without_plane(places: &[Vector2<f64>], scale: &Scale) -> Vec<Vector3<f64>> {
    let rows: Vec<Vector6<f64>> = places.iter().map(|p| scale.basis(p)).collect();
    let (mut a, mut b) = (Matrix3::zeros(), Matrix3::zeros());
    for row in &rows {
        let plane = row.fixed_rows::<3>(0);
        a += plane * plane.transpose();
        b += plane * row.fixed_rows::<3>(3).transpose();
    }
    let carried = a.cholesky().map_or_else(Matrix3::zeros, |c| c.solve(&b));
    rows.iter()
        .map(|row| row.fixed_rows::<3>(3) - carried.transpose() * row.fixed_rows::<3>(0))
        .collect()
}

/// Weighted means of the deviations, place by place.
fn map(surfaces: &[&Surface]) -> Vec<Deviation> {
    let mut all: Vec<(Vector2<f64>, f64, f64)> =
        surfaces.iter().flat_map(|s| s.deviations.iter().copied()).collect();
    let order = |a: &Vector2<f64>, b: &Vector2<f64>| a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x));
    all.sort_by(|a, b| order(&a.0, &b.0));
    all.chunk_by(|a, b| a.0 == b.0)
        .map(|chunk| {
            let total: f64 = chunk.iter().map(|d| d.2.recip()).sum();
            let sum: f64 = chunk.iter().map(|d| d.1 / d.2).sum();
            Deviation { at: chunk[0].0, height_m: sum / total, sigma_m: total.sqrt().recip() }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    /// Captures of a 9 x 6 board, 25 mm apart, with `bow` (m) at the ends of x, seen at random.
    fn captures(bow: impl Fn(f64, f64) -> f64, sigma: f64, seed: u64) -> Vec<Vec<ScanCorner>> {
        let mut random = Random::new(seed);
        let mut one = || {
            let turn = nalgebra::Rotation3::new(random.normal3() * 0.3);
            let shift = Vector3::new(0.0, 0.0, 0.6) + random.normal3() * 0.05;
            let mut corner = |k: usize| {
                let at = Vector2::new((k % 9) as f64 * 0.025, (k / 9) as f64 * 0.025);
                let z = bow(at.x / 0.1 - 1.0, at.y / 0.0625 - 1.0);
                let p = turn * (at.push(z) - Vector3::new(0.1, 0.06, 0.0)) + shift;
                let noise = p.normalize() * random.normal() * sigma;
                let s = p * p.transpose() / p.norm_squared() * sigma * sigma;
                (at, p + noise, s + Matrix3::identity() * 1e-14)
            };
            (0..54).map(&mut corner).collect()
        };
        (0..12).map(|_| one()).collect()
    }

    #[test]
    fn a_flat_board_is_flat() {
        let mut improbable = 0;
        for seed in 0..40 {
            let found = flatness(&captures(|_, _| 0.0, 1e-4, seed)).unwrap();
            improbable += usize::from(found.board.chance < 0.05);
            assert!(found.board.chance > 1e-4, "{found:?}");
        }
        assert!(improbable < 7, "{improbable} of 40 at 5 %");
    }

    #[test]
    fn a_bow_is_measured_within_its_uncertainty() {
        for seed in 0..20 {
            let found = flatness(&captures(|x, _| 3e-4 * x * x, 1e-4, seed)).unwrap();
            let off = found.board.peak_to_valley_m - 3e-4;
            assert!(off.abs() < 4.0 * found.board.sigma_m, "{:?}", found.board);
            assert!(found.board.chance < 1e-6 && found.board.sigma_m < 2e-5, "{:?}", found.board);
        }
    }

    #[test]
    fn a_twist_is_seen_and_a_corner_that_flies_is_not() {
        let mut all = captures(|x, y| 2e-4 * x * y, 5e-5, 3);
        all[0][5].1 *= 1.05;
        let found = flatness(&all).unwrap();
        assert!((found.board.peak_to_valley_m - 4e-4).abs() < 5e-5, "{:?}", found.board);
        let corner = found.map.iter().find(|d| d.at == Vector2::zeros()).unwrap();
        assert!((corner.height_m - 2e-4).abs() < 6e-5, "{corner:?}");
    }

    #[test]
    fn few_corners_tell_nothing() {
        assert_eq!(flatness(&[vec![]]), None);
        let four: Vec<ScanCorner> = captures(|_, _| 0.0, 1e-4, 1)[0][..4].to_vec();
        assert_eq!(flatness(&[four]), None);
    }
}
