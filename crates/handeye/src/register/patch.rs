//! Planes through the points of a neighbourhood.
//!
//! Of `n` points with mean `m` and scatter `C = Σ (x - m)(x - m)ᵀ / n`, the normal is the eigenvector of the
//! smallest eigenvalue `λ`, which is the variance across the plane. Newton's method finds it from below,
//! where the characteristic polynomial rises and is concave: in a plane `λ` is small, and two steps do.

use std::ops::AddAssign;

use nalgebra::Vector3;

/// Number, sum, and sums of products `xx xy xz yy yz zz` of points.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sums {
    pub count: f64,
    pub first: [f64; 3],
    pub second: [f64; 6],
}

impl Sums {
    #[inline(always)]
    pub fn add(&mut self, [x, y, z]: [f64; 3]) {
        self.count += 1.0;
        let second = [x * x, x * y, x * z, y * y, y * z, z * z];
        (0..3).for_each(|k| self.first[k] += [x, y, z][k]);
        (0..6).for_each(|k| self.second[k] += second[k]);
    }
}

impl AddAssign<&Sums> for Sums {
    fn add_assign(&mut self, other: &Self) {
        self.count += other.count;
        (0..3).for_each(|k| self.first[k] += other.first[k]);
        (0..6).for_each(|k| self.second[k] += other.second[k]);
    }
}

/// A piece of a surface, seen by its window; [`mean`](Self::mean) may be that of its middle alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Patch {
    /// Mean of its points, m.
    pub mean: Vector3<f64>,
    /// Across it, of length one, towards the camera where that is known.
    pub normal: Vector3<f64>,
    /// Variance of its points across the plane, m².
    pub across: f64,
    /// Of its height, m²: of the mean of its points' errors.
    pub variance: f64,
    /// Harmonic mean of both variances along the plane, m².
    pub along: f64,
    /// Number of points of which it is the mean.
    pub held: f64,
    /// Number of points that tell the normal.
    pub count: f64,
}

impl Patch {
    /// Square of the cosine between its normal and the ray from the origin: 1 where it is seen from the front.
    pub(crate) fn facing(&self) -> f64 {
        self.normal.dot(&self.mean).powi(2) / self.mean.norm_squared().max(f64::MIN_POSITIVE)
    }
}

/// Most steps to the smallest eigenvalue.
const MOST_STEPS: usize = 20;
/// A step of less than this share of the trace is the last: what is left is its square.
const SETTLED: f64 = 1e-5;

impl Patch {
    /// With the place of its middle, which is the mean of so many points.
    pub fn about(self, middle: &Vector3<f64>, held: f64) -> Self {
        Self { mean: *middle, held, variance: self.across / held, ..self }
    }

    /// `None` of fewer than three points, and of points on a line.
    pub fn of(sums: &Sums) -> Option<Self> {
        let n = sums.count;
        if n < 3.0 {
            return None;
        }
        let share = 1.0 / n;
        let [x, y, z] = sums.first.map(|s| s * share);
        let [xx, xy, xz, yy, yz, zz] = sums.second.map(|s| s * share);
        let (xx, yy, zz) = (xx - x * x, yy - y * y, zz - z * z);
        let (xy, xz, yz) = (xy - x * y, xz - x * z, yz - y * z);
        let trace = xx + yy + zz;
        let minors = yy * zz - yz * yz + xx * zz - xz * xz + xx * yy - xy * xy;
        let determinant =
            xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
        // λ³ - trace λ² + minors λ - determinant, from zero
        let mut across = 0.0;
        for _ in 0..MOST_STEPS {
            let value = ((across - trace) * across + minors) * across - determinant;
            let slope = (3.0 * across - 2.0 * trace) * across + minors;
            if !(slope > 0.0) {
                break;
            }
            let step = value / slope;
            across -= step;
            if step.abs() <= SETTLED * trace {
                break;
            }
        }
        let across = across.max(0.0);
        let (a, b, c) = (xx - across, yy - across, zz - across);
        // rows of the adjugate of C - λ: all along the normal
        let rows = [
            Vector3::new(b * c - yz * yz, yz * xz - xy * c, xy * yz - b * xz),
            Vector3::new(yz * xz - xy * c, a * c - xz * xz, xy * xz - a * yz),
            Vector3::new(xy * yz - b * xz, xy * xz - a * yz, a * b - xy * xy),
        ];
        let lengths = rows.map(|row| row.norm_squared());
        let longest = (0..3).fold(0, |best, k| if lengths[k] > lengths[best] { k } else { best });
        let length = lengths[longest].sqrt();
        // the trace of the adjugate is the product of the other two eigenvalues, less λ each
        let (sum, product) = (trace - 3.0 * across, rows[0].x + rows[1].y + rows[2].z);
        let along = 2.0 * product / sum + across;
        (length > 0.0 && product > LINE * sum * sum).then(|| Self {
            mean: Vector3::new(x, y, z),
            normal: rows[longest] / length,
            across,
            variance: across / n,
            along,
            held: n,
            count: n,
        })
    }
}

/// Ratio of the variances along a plane below which points lie on a line.
const LINE: f64 = 0.01;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::Matrix3;

    fn sums(points: &[Vector3<f64>]) -> Sums {
        let mut sums = Sums::default();
        points.iter().for_each(|p| sums.add((*p).into()));
        sums
    }

    #[test]
    fn normal_and_variances_are_those_of_the_eigenvectors() {
        let mut random = Random::new(1);
        for across in [0.0, 1e-5, 1e-3, 5e-3] {
            for _ in 0..100 {
                let turn = nalgebra::UnitQuaternion::from_scaled_axis(random.normal3());
                let mut point = || {
                    let (a, b) = (random.between(-0.02, 0.02), random.between(-0.01, 0.01));
                    turn * Vector3::new(a, b, across * random.normal())
                        + Vector3::new(0.1, 0.2, 0.9)
                };
                let points: Vec<_> = (0..30).map(|_| point()).collect();
                let patch = Patch::of(&sums(&points)).unwrap();
                let mean = points.iter().sum::<Vector3<f64>>() / 30.0;
                let scatter: Matrix3<f64> =
                    points.iter().map(|p| (p - mean) * (p - mean).transpose() / 30.0).sum();
                let eigen = scatter.symmetric_eigen();
                let least = eigen.eigenvalues.imin();
                let mut values: Vec<f64> = eigen.eigenvalues.iter().copied().collect();
                values.sort_by(f64::total_cmp);
                let turned = eigen.eigenvectors.column(least).dot(&patch.normal).abs();
                assert!((patch.mean - mean).norm() < 1e-12);
                if values[1] > 2.0 * values[0] {
                    assert!((turned - 1.0).abs() < 1e-9, "{across} {turned}");
                    assert!((patch.across - values[0]).abs() < 1e-12, "{across}");
                    let inverse = 0.5 / (values[1] - values[0]) + 0.5 / (values[2] - values[0]);
                    assert!((patch.along - values[0] - 1.0 / inverse).abs() < 1e-12, "{across}");
                }
            }
        }
    }

    #[test]
    fn points_on_a_line_and_too_few_make_no_plane() {
        let line: Vec<_> = (0..9).map(|k| Vector3::new(0.1, 0.01 * f64::from(k), 1.0)).collect();
        assert!(Patch::of(&sums(&line)).is_none());
        assert!(Patch::of(&sums(&line[..2])).is_none());
        assert!(Patch::of(&sums(&[line[0]; 5])).is_none());
    }
}
