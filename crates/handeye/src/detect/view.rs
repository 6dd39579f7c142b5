//! How the board's plane is seen, and where a circle's centre is in the image.
//!
//! The image of a circle's centre is not the centre of the circle's image. Seen at an angle the far
//! half of the circle is shorter than the near one; under perspective alone the image of the centre
//! is the pole of the horizon's image with respect to the ellipse `C`:
//!
//! ```text
//! x = C⁻¹ H⁻ᵀ (0, 0, 1)ᵀ
//! ```
//!
//! A lens that bends lines moves the two apart further. Both are taken into account at once: the
//! circle is drawn through the map from the board to the image, an ellipse is laid through the
//! points (for a homography exactly), and the difference between its centre and the image of the
//! circle's centre is taken off what was measured.
//!
//! The map is a homography followed by the lens. Without a camera's intrinsics the lens is one
//! coefficient of radial distortion about the middle of the image, fitted to the circles
//! themselves: that is enough for the bias, which is small.
//!
//! J. Heikkilä, *Geometric camera calibration using circular control points*, PAMI 22(10), 2000;
//! J. Mallon and P. Whelan, *Which pattern? Biasing aspects of planar calibration patterns and
//! detection methods*, Pattern Recognition Letters 28(8), 2007.

use nalgebra::{DMatrix, DVector, Matrix2, Matrix3, SMatrix, SVector, Vector2};

use crate::{Intrinsics, detect::homography};

/// A corner, or a circle's centre, on the board and in the image.
#[derive(Debug, Clone, Copy)]
pub struct Sighting {
    /// On the board, in units of its pitch.
    pub on_board: Vector2<f64>,
    /// px
    pub pixel: Vector2<f64>,
    /// px²
    pub covariance: Matrix2<f64>,
}

/// What bends lines after the homography.
#[derive(Debug, Clone, Copy)]
enum Lens<'a> {
    /// `p + k |p|² p`, with `p` from `centre` in units of `scale`.
    Radial { centre: Vector2<f64>, scale: f64, k: f64 },
    /// A camera; the homography leads to its undistorted rays.
    Known(&'a Intrinsics),
}

/// From the board's plane to the image.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    h: Matrix3<f64>,
    lens: Lens<'a>,
}

/// Fewer circles do not determine a distortion beside the homography.
const FEWEST_FOR_LENS: usize = 9;
/// Prior standard deviation of the distortion at the image's corner, as a share of the distance.
const LENS_PRIOR: f64 = 0.2;
/// Steps of the fit: it is nearly linear.
const STEPS: usize = 6;
/// Step of the central differences.
const DIFFERENCE: f64 = 1e-6;
/// Points on a circle that is drawn.
const POINTS: usize = 16;

impl<'a> View<'a> {
    /// The map that fits the circles best.
    pub fn fit(
        sightings: &[Sighting],
        (width, height): (usize, usize),
        camera: Option<&'a Intrinsics>,
    ) -> Option<Self> {
        let centre = 0.5 * Vector2::new(width as f64 - 1.0, height as f64 - 1.0);
        let lens = match camera {
            Some(camera) => Lens::Known(camera),
            None => Lens::Radial { centre, scale: centre.norm(), k: 0.0 },
        };
        let from: Vec<Vector2<f64>> = sightings.iter().map(|s| s.on_board).collect();
        let straight: Option<Vec<Vector2<f64>>> =
            sightings.iter().map(|s| lens.undone(&s.pixel)).collect();
        let start = Self { h: homography::fit(&from, &straight?)?, lens };
        start.refined(sightings)
    }

    /// Gauss-Newton on the distances in the image.
    fn refined(self, sightings: &[Sighting]) -> Option<Self> {
        let free = match self.lens {
            Lens::Radial { .. } if sightings.len() >= FEWEST_FOR_LENS => 9,
            _ => 8,
        };
        let mut view = self;
        for _ in 0..STEPS {
            let mut normal = DMatrix::<f64>::zeros(free, free);
            let mut gradient = DVector::<f64>::zeros(free);
            for s in sightings {
                let residual = s.pixel - view.pixel(&s.on_board)?;
                let jacobian = view.jacobian(&s.on_board, free)?;
                let weighted = jacobian.transpose() * s.covariance.try_inverse()?;
                normal += &weighted * &jacobian;
                gradient += &weighted * residual;
            }
            if free == 9 {
                let precision = LENS_PRIOR.powi(-2);
                normal[(8, 8)] += precision;
                gradient[8] -= precision * view.lens.coefficient();
            }
            let step = normal.cholesky()?.solve(&gradient);
            view = view.moved(step.as_slice());
        }
        view.h.iter().all(|x| x.is_finite()).then_some(view)
    }

    fn jacobian(&self, at: &Vector2<f64>, free: usize) -> Option<DMatrix<f64>> {
        let mut all = DMatrix::zeros(2, free);
        for k in 0..free {
            let mut step = [0.0; 9];
            step[k] = DIFFERENCE;
            let ahead = self.moved(&step[..free]).pixel(at)?;
            step[k] = -DIFFERENCE;
            let behind = self.moved(&step[..free]).pixel(at)?;
            all.set_column(k, &((ahead - behind) / (2.0 * DIFFERENCE)));
        }
        Some(all)
    }

    /// With other parameters: eight entries of the homography, relative to its rows' sizes, and the
    /// lens.
    fn moved(&self, step: &[f64]) -> Self {
        let mut next = *self;
        for (k, s) in step.iter().take(8).enumerate() {
            let row = self.h.row(k / 3).norm();
            next.h[(k / 3, k % 3)] += s * row;
        }
        if let (Some(dk), Lens::Radial { centre, scale, k }) = (step.get(8), self.lens) {
            next.lens = Lens::Radial { centre, scale, k: k + dk };
        }
        next
    }

    /// Where a point of the board is seen.
    pub fn pixel(&self, on_board: &Vector2<f64>) -> Option<Vector2<f64>> {
        let at = homography::apply(&self.h, on_board);
        let pixel = self.lens.seen(&at)?;
        pixel.iter().all(|x| x.is_finite()).then_some(pixel)
    }

    /// The ellipse that a circle is seen as: its centre minus the image of the circle's centre, and
    /// `S` of `dᵀ S⁻¹ d = 1`.
    pub fn circle(
        &self,
        centre: &Vector2<f64>,
        radius: f64,
    ) -> Option<(Vector2<f64>, Matrix2<f64>)> {
        let middle = self.pixel(centre)?;
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / POINTS as f64;
        let points: Option<Vec<Vector2<f64>>> = (0..POINTS)
            .map(|k| {
                let at = centre + radius * Vector2::new(angle(k).cos(), angle(k).sin());
                Some(self.pixel(&at)? - middle)
            })
            .collect();
        ellipse_through(&points?)
    }
}

impl Lens<'_> {
    fn seen(&self, at: &Vector2<f64>) -> Option<Vector2<f64>> {
        match self {
            Self::Radial { centre, scale, k } => {
                let p = (at - centre) / *scale;
                Some(centre + p * ((1.0 + k * p.norm_squared()) * scale))
            }
            Self::Known(camera) => camera.project(&at.push(1.0)),
        }
    }

    /// Where the pixel would be without the lens, from which the fit starts.
    fn undone(&self, pixel: &Vector2<f64>) -> Option<Vector2<f64>> {
        match self {
            Self::Radial { .. } => Some(*pixel),
            Self::Known(camera) => camera.undistort(pixel),
        }
    }

    fn coefficient(&self) -> f64 {
        if let Self::Radial { k, .. } = self { *k } else { 0.0 }
    }
}

/// Centre and `S` of the ellipse through points around the origin: least squares of
/// `A x² + B x y + C y² + D x + E y = 1` on points scaled to size one.
fn ellipse_through(points: &[Vector2<f64>]) -> Option<(Vector2<f64>, Matrix2<f64>)> {
    let size = points.iter().map(|p| p.norm()).fold(0.0, f64::max);
    let spread = points.iter().map(|p| p * p.transpose()).sum::<Matrix2<f64>>();
    // into a frame in which they are nearly a circle
    let round = (spread * (2.0 / points.len() as f64)).cholesky()?.l();
    let into = round.try_inverse()?;
    let (mut normal, mut right) = (SMatrix::<f64, 5, 5>::zeros(), SVector::<f64, 5>::zeros());
    for p in points {
        let q = into * p;
        let row = SVector::<f64, 5>::from([q.x * q.x, q.x * q.y, q.y * q.y, q.x, q.y]);
        normal.ger(1.0, &row, &row, 1.0);
        right += row;
    }
    let conic = normal.cholesky()?.solve(&right);
    let q = Matrix2::new(conic[0], 0.5 * conic[1], 0.5 * conic[1], conic[2]);
    let inverse = q.try_inverse()?;
    let centre = -0.5 * inverse * Vector2::new(conic[3], conic[4]);
    let level = 1.0 + centre.dot(&(q * centre));
    let shape = round * (inverse * level) * round.transpose();
    (size > 0.0 && shape.iter().all(|x| x.is_finite())).then(|| (round * centre, shape))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tilted() -> Matrix3<f64> {
        Matrix3::new(40.0, 3.0, 400.0, -5.0, 30.0, 310.0, 0.004, -0.02, 1.0)
    }

    fn grid() -> Vec<Vector2<f64>> {
        (0..80).map(|k| Vector2::new(f64::from(k % 10), f64::from(k / 10))).collect()
    }

    #[test]
    fn the_ellipse_of_a_homography_has_the_centre_of_its_conic() {
        let h = tilted();
        let lens = Lens::Radial { centre: Vector2::zeros(), scale: 1.0, k: 0.0 };
        let view = View { h, lens };
        let at = Vector2::new(3.0, 5.0);
        let r = 0.4;
        // C = H⁻ᵀ (circle) H⁻¹
        let circle =
            Matrix3::new(1.0, 0.0, -at.x, 0.0, 1.0, -at.y, -at.x, -at.y, at.norm_squared() - r * r);
        let back = h.try_inverse().unwrap();
        let conic = back.transpose() * circle * back;
        let middle =
            -conic.fixed_view::<2, 2>(0, 0).try_inverse().unwrap() * conic.fixed_view::<2, 1>(0, 2);
        let (bias, shape) = view.circle(&at, r).unwrap();
        let expected = middle - view.pixel(&at).unwrap();
        assert!((bias - expected).norm() < 1e-9 && expected.norm() > 0.01, "{bias} {expected}");
        // the pole of the horizon is the image of the centre
        let horizon = back.transpose() * nalgebra::Vector3::z();
        let pole = conic.try_inverse().unwrap() * horizon;
        assert!((pole.xy() / pole.z - view.pixel(&at).unwrap()).norm() < 1e-9);
        assert!(shape.determinant() > 0.0);
    }

    #[test]
    fn exact_centres_give_the_homography_and_the_lens() {
        let lens = Lens::Radial { centre: Vector2::new(400.0, 300.0), scale: 500.0, k: -0.08 };
        let truth = View { h: tilted(), lens };
        let sightings: Vec<Sighting> = grid()
            .into_iter()
            .map(|on_board| Sighting {
                on_board,
                pixel: truth.pixel(&on_board).unwrap(),
                covariance: Matrix2::identity() * 1e-4,
            })
            .collect();
        let found = View::fit(&sightings, (801, 601), None).unwrap();
        for s in &sightings {
            assert!((found.pixel(&s.on_board).unwrap() - s.pixel).norm() < 1e-3);
        }
        assert!((found.lens.coefficient() + 0.08).abs() < 1e-3);
    }
}
