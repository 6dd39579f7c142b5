//! How the camera turns points into pixels.
//!
//! Normalised coordinates `x = X/Z, y = Y/Z`, `r² = x² + y²`. Brown-Conrady with rational and thin
//! prism terms, in OpenCV's order `k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4`:
//!
//! ```text
//! x' = x (1 + k1 r² + k2 r⁴ + k3 r⁶)/(1 + k4 r² + k5 r⁴ + k6 r⁶) + 2 p1 x y + p2 (r² + 2 x²) + s1 r² + s2 r⁴
//! y' = y (same)                                            + p1 (r² + 2 y²) + 2 p2 x y + s3 r² + s4 r⁴
//! ```
//!
//! Kannala-Brandt ("fisheye", "equidistant"): `θ = atan r`, `θ' = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸)`,
//! `(x', y') = θ'/r (x, y)`. Pixel `u = fx x' + cx, v = fy y' + cy`; the centre of the top-left pixel
//! is (0, 0).
//!
//! D. Brown 1971; J. Kannala and S. Brandt, IEEE TPAMI 28(8), 2006.

use nalgebra::{Matrix2, Matrix2x3, SMatrix, SVector, Vector2, Vector3};
use serde::{Deserialize, Serialize};

use crate::Error;

/// Lens distortion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "model", content = "coefficients", rename_all = "kebab-case")]
pub enum Distortion {
    /// None: a pinhole.
    None,
    /// OpenCV's order `k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4`, zeros where not used.
    BrownConrady([f64; 12]),
    /// `k1 k2 k3 k4`.
    KannalaBrandt([f64; 4]),
}

/// Intrinsic parameters of a camera, in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Intrinsics {
    /// Image width.
    pub width: u32,
    /// Image height.
    pub height: u32,
    /// Focal length along x.
    pub fx: f64,
    /// Focal length along y.
    pub fy: f64,
    /// Principal point, x; the centre of the first pixel is 0.
    pub cx: f64,
    /// Principal point, y.
    pub cy: f64,
    /// Lens distortion.
    pub distortion: Distortion,
}

/// Parameters that a calibration fits: `fx fy cx cy k1 k2 p1 p2 k3`.
pub const PARAMETERS: usize = 9;
/// All of a camera's parameters: `fx fy cx cy` and up to twelve coefficients of its lens.
pub(crate) const LENS_PARAMETERS: usize = 16;

/// Undistortion stops when the step is below this (normalised units, about 1e-9 px).
const UNDISTORT_STEP: f64 = 1e-13;

impl Intrinsics {
    /// A pinhole without distortion.
    pub fn pinhole(width: u32, height: u32, fx: f64, fy: f64, cx: f64, cy: f64) -> Self {
        Self { width, height, fx, fy, cx, cy, distortion: Distortion::None }
    }

    /// Refuses values that no camera has.
    pub fn check(&self) -> Result<(), Error> {
        let all = [self.fx, self.fy, self.cx, self.cy];
        if all.iter().chain(self.coefficients()).any(|x| !x.is_finite()) {
            return Err(Error::NotFinite { what: "a camera parameter".into() });
        }
        if self.fx <= 0.0 || self.fy <= 0.0 {
            return Err(Error::Invalid(format!(
                "camera: fx = {}, fy = {} must be positive focal lengths in pixels",
                self.fx, self.fy
            )));
        }
        Ok(())
    }

    /// Distortion coefficients of the model in use.
    pub fn coefficients(&self) -> &[f64] {
        match &self.distortion {
            Distortion::None => &[],
            Distortion::BrownConrady(k) => k,
            Distortion::KannalaBrandt(k) => k,
        }
    }

    /// The same camera after the image was resized by `factor` (pixel centres at integers).
    pub fn resized(&self, factor: f64) -> Self {
        let shift = |c: f64| (c + 0.5) * factor - 0.5;
        let size = |n: u32| (f64::from(n) * factor).round() as u32;
        Self {
            width: size(self.width),
            height: size(self.height),
            fx: self.fx * factor,
            fy: self.fy * factor,
            cx: shift(self.cx),
            cy: shift(self.cy),
            distortion: self.distortion,
        }
    }

    /// Pixel of a point in the camera frame (m); `None` behind or at the camera's plane.
    pub fn project(&self, p: &Vector3<f64>) -> Option<Vector2<f64>> {
        (p.z > 1e-9).then(|| self.pixel(&self.distort(&Vector2::new(p.x / p.z, p.y / p.z)).0))
    }

    /// Pixel and its Jacobian with respect to the point.
    pub(crate) fn project_with_jacobian(
        &self,
        p: &Vector3<f64>,
    ) -> Option<(Vector2<f64>, Matrix2x3<f64>)> {
        if p.z <= 1e-9 {
            return None;
        }
        let n = Vector2::new(p.x / p.z, p.y / p.z);
        let (d, d_n) = self.distort(&n);
        let n_p = Matrix2x3::new(1.0, 0.0, -n.x, 0.0, 1.0, -n.y) / p.z;
        let f = Matrix2::new(self.fx, 0.0, 0.0, self.fy);
        Some((self.pixel(&d), f * d_n * n_p))
    }

    fn pixel(&self, d: &Vector2<f64>) -> Vector2<f64> {
        Vector2::new(self.fx * d.x + self.cx, self.fy * d.y + self.cy)
    }

    /// Distorted normalised coordinates of undistorted ones, with the Jacobian.
    pub(crate) fn distort(&self, n: &Vector2<f64>) -> (Vector2<f64>, Matrix2<f64>) {
        match &self.distortion {
            Distortion::None => (*n, Matrix2::identity()),
            Distortion::BrownConrady(k) => brown_conrady(k, n),
            Distortion::KannalaBrandt(k) => kannala_brandt(k, n),
        }
    }

    /// Undistorted normalised coordinates `(X/Z, Y/Z)` of a pixel, by Newton's method.
    /// `None` where the distortion model folds over (outside the calibrated field).
    pub(crate) fn undistort(&self, pixel: &Vector2<f64>) -> Option<Vector2<f64>> {
        let d = Vector2::new((pixel.x - self.cx) / self.fx, (pixel.y - self.cy) / self.fy);
        let mut n = match &self.distortion {
            Distortion::KannalaBrandt(k) => kannala_brandt_start(k, &d)?,
            _ => d,
        };
        for _ in 0..50 {
            let (at, j) = self.distort(&n);
            if !(j.determinant() > 1e-6) {
                return None;
            }
            let step = j.try_inverse()? * (d - at);
            // a long step leaves the field in which the polynomial means anything
            n += step * (0.5 / step.norm().max(0.5));
            if step.norm() < UNDISTORT_STEP {
                return Some(n);
            }
        }
        let (at, _) = self.distort(&n);
        ((d - at).norm() < 1e-9).then_some(n)
    }

    /// Derivative of a point's pixel by `f a cx cy k1 k2 p1 p2 k3`: `f` changes `fx`, and `fy` in proportion, `a`
    /// changes `fy` beyond that (a focal length is often off, the shape of the pixels hardly ever). Those of the
    /// distortion are Brown-Conrady's, and zero for a lens of another model.
    pub(crate) fn by_parameters(&self, point: &Vector3<f64>) -> SMatrix<f64, 2, PARAMETERS> {
        let all = self.by_lens(point);
        let mut j = all.fixed_columns::<PARAMETERS>(0).into_owned();
        j.set_column(0, &(all.column(0) + all.column(1) * (self.fy / self.fx)));
        if let Distortion::KannalaBrandt(_) = self.distortion {
            j.columns_mut(4, 5).fill(0.0);
        }
        j
    }

    /// Derivative of a point's pixel by `fx fy cx cy` and the coefficients of the lens in the order
    /// of [`Distortion`]; of a pinhole as if it were of Brown-Conrady's model.
    pub(crate) fn by_lens(&self, point: &Vector3<f64>) -> SMatrix<f64, 2, LENS_PARAMETERS> {
        let n = Vector2::new(point.x / point.z, point.y / point.z);
        let (d, _) = self.distort(&n);
        let mut j = SMatrix::<f64, 2, LENS_PARAMETERS>::zeros();
        (j[(0, 0)], j[(1, 1)], j[(0, 2)], j[(1, 3)]) = (d.x, d.y, 1.0, 1.0);
        let (x, y, r2) = (n.x, n.y, n.norm_squared());
        let (fx, fy) = (self.fx, self.fy);
        let outward = Vector2::new(fx * x, fy * y);
        let k = match self.distortion {
            Distortion::BrownConrady(k) => k,
            Distortion::None => [0.0; 12],
            Distortion::KannalaBrandt(_) => {
                let r = r2.sqrt();
                let theta = r.atan();
                // θ/r is 1 in the middle
                let mut power = if r > 0.0 { theta / r } else { 1.0 };
                for column in 4..8 {
                    power *= theta * theta;
                    j.set_column(column, &(outward * power));
                }
                return j;
            }
        };
        let top = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
        let bottom = 1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
        let radial = outward * (r2 / bottom);
        for (column, power) in [(4, 1.0), (5, r2), (8, r2 * r2)] {
            j.set_column(column, &(radial * power));
            let below = if column == 8 { 11 } else { column + 5 };
            j.set_column(below, &(radial * (-power * top / bottom)));
        }
        j.set_column(6, &Vector2::new(fx * 2.0 * x * y, fy * (r2 + 2.0 * y * y)));
        j.set_column(7, &Vector2::new(fx * (r2 + 2.0 * x * x), fy * 2.0 * x * y));
        (j[(0, 12)], j[(0, 13)]) = (fx * r2, fx * r2 * r2);
        (j[(1, 14)], j[(1, 15)]) = (fy * r2, fy * r2 * r2);
        j
    }

    /// The values of `Self::by_lens`' parameters; zeros where the lens has none.
    pub fn values(&self) -> SVector<f64, LENS_PARAMETERS> {
        let plain = [self.fx, self.fy, self.cx, self.cy];
        let mut all = plain.iter().chain(self.coefficients());
        SVector::from_fn(|_, _| all.next().copied().unwrap_or(0.0))
    }

    /// The camera with these differences added to `Self::by_parameters`' parameters.
    pub fn moved(&self, d: &SVector<f64, PARAMETERS>) -> Self {
        let mut all = SVector::<f64, LENS_PARAMETERS>::zeros();
        all.rows_mut(0, PARAMETERS).copy_from(d);
        all[1] += d[0] * (self.fy / self.fx);
        if let Distortion::KannalaBrandt(_) = self.distortion {
            all.rows_mut(4, 5).fill(0.0);
        }
        self.moved_lens(&all)
    }

    /// The camera with these differences added to [`Self::by_lens`]' parameters.
    pub(crate) fn moved_lens(&self, d: &SVector<f64, LENS_PARAMETERS>) -> Self {
        fn added<const N: usize>(mut k: [f64; N], d: &SVector<f64, LENS_PARAMETERS>) -> [f64; N] {
            k.iter_mut().zip(d.iter().skip(4)).for_each(|(k, d)| *k += d);
            k
        }
        let distortion = match self.distortion {
            Distortion::None if d.rows(4, 12).iter().all(|x| *x == 0.0) => Distortion::None,
            Distortion::None => Distortion::BrownConrady(added([0.0; 12], d)),
            Distortion::BrownConrady(k) => Distortion::BrownConrady(added(k, d)),
            Distortion::KannalaBrandt(k) => Distortion::KannalaBrandt(added(k, d)),
        };
        Self {
            fx: self.fx + d[0],
            fy: self.fy + d[1],
            cx: self.cx + d[2],
            cy: self.cy + d[3],
            distortion,
            ..*self
        }
    }

    /// Ray `(X/Z, Y/Z, 1)` through a pixel.
    pub fn ray(&self, pixel: &Vector2<f64>) -> Option<Vector3<f64>> {
        self.undistort(pixel).map(|n| Vector3::new(n.x, n.y, 1.0))
    }
}

fn brown_conrady(k: &[f64; 12], n: &Vector2<f64>) -> (Vector2<f64>, Matrix2<f64>) {
    let [k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4] = *k;
    let (x, y) = (n.x, n.y);
    let r2 = x * x + y * y;
    let (top, bottom) =
        (1.0 + r2 * (k1 + r2 * (k2 + r2 * k3)), 1.0 + r2 * (k4 + r2 * (k5 + r2 * k6)));
    let radial = top / bottom;
    let d_top = k1 + r2 * (2.0 * k2 + 3.0 * r2 * k3);
    let d_bottom = k4 + r2 * (2.0 * k5 + 3.0 * r2 * k6);
    let d_radial = (d_top - radial * d_bottom) / bottom; // by r²
    let out = Vector2::new(
        x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x) + r2 * (s1 + s2 * r2),
        y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y + r2 * (s3 + s4 * r2),
    );
    let (g, h) = (s1 + 2.0 * s2 * r2, s3 + 2.0 * s4 * r2);
    let jacobian = Matrix2::new(
        radial + 2.0 * x * x * d_radial + 2.0 * p1 * y + 6.0 * p2 * x + 2.0 * x * g,
        2.0 * x * y * d_radial + 2.0 * p1 * x + 2.0 * p2 * y + 2.0 * y * g,
        2.0 * x * y * d_radial + 2.0 * p1 * x + 2.0 * p2 * y + 2.0 * x * h,
        radial + 2.0 * y * y * d_radial + 6.0 * p1 * y + 2.0 * p2 * x + 2.0 * y * h,
    );
    (out, jacobian)
}

fn kannala_brandt(k: &[f64; 4], n: &Vector2<f64>) -> (Vector2<f64>, Matrix2<f64>) {
    let r2 = n.norm_squared();
    let r = r2.sqrt();
    if r < 1e-8 {
        return (*n, Matrix2::identity());
    }
    let theta = r.atan();
    let t2 = theta * theta;
    let bent = theta * (1.0 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
    let d_bent = 1.0 + t2 * (3.0 * k[0] + t2 * (5.0 * k[1] + t2 * (7.0 * k[2] + t2 * 9.0 * k[3])));
    let scale = bent / r;
    // d(scale)/dr = (bent' / (1 + r²) - scale) / r
    let d_scale = (d_bent / (1.0 + r2) - scale) / r;
    (n * scale, Matrix2::identity() * scale + (n * n.transpose()) * (d_scale / r))
}

/// Start of the inversion: `θ' = |d|` solved for `θ`.
fn kannala_brandt_start(k: &[f64; 4], d: &Vector2<f64>) -> Option<Vector2<f64>> {
    let bent = d.norm();
    if bent < 1e-8 {
        return Some(*d);
    }
    let mut theta = bent.min(1.5);
    for _ in 0..20 {
        let t2 = theta * theta;
        let f = theta * (1.0 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3])))) - bent;
        let slope =
            1.0 + t2 * (3.0 * k[0] + t2 * (5.0 * k[1] + t2 * (7.0 * k[2] + t2 * 9.0 * k[3])));
        if slope < 1e-3 {
            return None;
        }
        theta = (theta - f / slope).clamp(0.0, 1.56);
    }
    Some(d * (theta.tan() / bent))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cameras() -> Vec<Intrinsics> {
        let base = Intrinsics::pinhole(1920, 1200, 1800.0, 1790.0, 955.3, 602.1);
        let brown = [-0.31, 0.12, 1e-3, -7e-4, -0.02, 0.01, -0.02, 0.003, 1e-3, -4e-4, 6e-4, 2e-4];
        vec![
            base,
            Intrinsics { distortion: Distortion::BrownConrady(brown), ..base },
            Intrinsics {
                distortion: Distortion::KannalaBrandt([-0.02, 0.01, -0.003, 1e-4]),
                ..base
            },
        ]
    }

    fn points() -> Vec<Vector3<f64>> {
        let mut all = vec![Vector3::new(0.0, 0.0, 1.0)];
        for (x, y, z) in
            [(0.3, -0.2, 0.9), (-0.45, 0.28, 1.0), (0.05, 0.31, 0.7), (1e-10, 0.0, 2.0)]
        {
            all.push(Vector3::new(x, y, z));
        }
        all
    }

    #[test]
    fn undistort_undoes_distort() {
        for camera in cameras() {
            for p in points() {
                let n = camera.undistort(&camera.project(&p).unwrap()).unwrap();
                assert!((n - Vector2::new(p.x / p.z, p.y / p.z)).norm() < 1e-11, "{camera:?} {p}");
            }
        }
    }

    #[test]
    fn jacobian_matches_central_differences() {
        for camera in cameras() {
            for p in points() {
                let (_, analytic) = camera.project_with_jacobian(&p).unwrap();
                for k in 0..3 {
                    let mut step = Vector3::zeros();
                    step[k] = 1e-5;
                    let ahead = camera.project(&(p + step)).unwrap();
                    let behind = camera.project(&(p - step)).unwrap();
                    let numeric = (ahead - behind) / 2e-5;
                    assert!((analytic.column(k) - numeric).norm() < 1e-4, "{camera:?} {p}");
                }
            }
        }
    }

    #[test]
    fn a_point_behind_the_camera_has_no_pixel() {
        assert!(cameras()[0].project(&Vector3::new(0.0, 0.0, -1.0)).is_none());
    }

    #[test]
    fn resizing_moves_pixels_by_their_centres() {
        let camera = cameras()[1];
        let (p, half) = (points()[1], camera.resized(0.5));
        let (full, small) = (camera.project(&p).unwrap(), half.project(&p).unwrap());
        assert!(((full.add_scalar(0.5)) * 0.5 - small.add_scalar(0.5)).norm() < 1e-9);
    }
}
