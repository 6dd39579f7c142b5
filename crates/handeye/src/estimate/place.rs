//! Errors of the robot that belong to the place where it is: a Gaussian process over its poses.
//!
//! Links, joint zeros, gears and bending make an arm err alike where it stands alike. The error is a twist `e` at the
//! flange, along the axes of the base; each of its six components is a Gaussian process with one covariance over the
//! places `g = (p, R)`,
//!
//! ```text
//! κ(g, g') = exp(-½ (|p - p'|²/l_p² + |R - R'|²/(2 l_r²)))         (Frobenius norm: positive definite)
//! ```
//!
//! and, where joint values are known, `κ(q, q') = 1/n Σ_j exp(-2 sin²((q_j - q'_j)/2)/l²)`. A pivoted Cholesky
//! decomposition `K ≈ L Lᵀ` over the places turns it into `e(g) = Σ_k l_k(g) b_k` with independent `b_k`, a few waves
//! that go into the joint fit as unknowns ([`ExtraKind::PlaceTurn`], [`ExtraKind::PlaceShift`]) with a believed size
//! that is estimated as any noise is.
//!
//! C. Rasmussen and C. Williams, *Gaussian Processes for Machine Learning*, MIT Press 2006; H. Harbrecht, M. Peters and
//! R. Schneider, *On the low-rank approximation by the pivoted Cholesky decomposition*, Applied Numerical Mathematics
//! 62, 2012.

use nalgebra::{DMatrix, DVector, Matrix6};
use serde::{Deserialize, Serialize};

use super::{
    JointFit, Problem, Sigma, Source,
    extra::{Extra, ExtraKind},
    joint,
};
use crate::{Base, Flange, Pose, Setup, math::lie};

/// Where the robot is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// What the robot says.
    pub base_from_flange: Pose<Base, Flange>,
    /// Its joint values (rad); none where they are not known.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<f64>,
    /// Whether its tool touches something there.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub touches: bool,
}

impl Place {
    /// The flange in the base, and the joint values (rad) where they are known.
    pub fn new(base_from_flange: &Pose<Base, Flange>, joints: &[f64]) -> Self {
        Self { base_from_flange: *base_from_flange, joints: joints.to_vec(), touches: false }
    }

    /// The same where its tool touches something.
    pub fn touching(self) -> Self {
        Self { touches: true, ..self }
    }

    /// Whether joint values are known.
    pub fn has_joints(&self) -> bool {
        !self.joints.is_empty()
    }
}

/// How errors at two places go together.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kernel {
    /// By the distance of the flange (m) and its turn (rad) over which errors change.
    Pose {
        /// Metres.
        #[serde(rename = "distance_m")]
        distance: f64,
        /// Radians.
        #[serde(rename = "angle_rad")]
        angle: f64,
    },
    /// By the joint values, each on its own: errors change over this angle, rad.
    Joints(f64),
}

impl Kernel {
    /// Those that are tried where only poses are known, from short to long.
    pub const OF_POSES: [Self; 3] = [
        Self::Pose { distance: 0.3, angle: 0.8 },
        Self::Pose { distance: 0.6, angle: 1.6 },
        Self::Pose { distance: 1.2, angle: 3.2 },
    ];
    /// That of joint values.
    pub const OF_JOINTS: Self = Self::Joints(1.0);

    /// Correlation of the errors at two places.
    pub fn at(&self, a: &Place, b: &Place) -> f64 {
        let alike = if a.touches == b.touches { 1.0 } else { TOUCHING };
        alike
            * match self {
                Self::Pose { distance, angle } => {
                    let (a, b) = (&a.base_from_flange, &b.base_from_flange);
                    let way = (a.translation() - b.translation()).norm_squared() / distance.powi(2);
                    let turn = (a.rotation() - b.rotation()).norm_squared() / (2.0 * angle.powi(2));
                    (-0.5 * (way + turn)).exp()
                }
                Self::Joints(length) => {
                    let one = |(p, q): (&f64, &f64)| {
                        (-2.0 * (0.5 * (p - q)).sin().powi(2) / length.powi(2)).exp()
                    };
                    let sum: f64 = a.joints.iter().zip(&b.joints).map(one).sum();
                    sum / a.joints.len().max(1) as f64
                }
            }
    }
}

/// Correlation of the errors of one place with and without a tool that touches something: it loads the arm, and nothing
/// says by how much.
const TOUCHING: f64 = 0.5;
/// Waves stop where they carry all but this part of the variance, on average: the rest is as good as noise.
const LEFT: f64 = 0.05;
/// Most waves.
const MOST: usize = 12;
/// Most places that the waves are about.
const MOST_ABOUT: usize = 40;

/// The waves of a process over some places.
#[derive(Debug, Clone, PartialEq)]
pub struct Waves {
    /// The waves, a row for each of the given places.
    pub(crate) at: DMatrix<f64>,
    /// The places that they are about.
    pub(crate) about: Vec<Place>,
    /// How much the correlation with each of those, a row, adds to each wave.
    pub(crate) by_about: DMatrix<f64>,
}

impl Waves {
    /// Waves over these places, as many as tell whether there are any.
    pub fn new(kernel: Kernel, places: &[Place]) -> Self {
        Self::at_most(kernel, places, MOST, LEFT)
    }

    /// The same and more of them, as many as tell how the robot errs elsewhere.
    pub fn fine(kernel: Kernel, places: &[Place]) -> Self {
        Self::at_most(kernel, places, 2 * MOST, 0.4 * LEFT)
    }

    fn at_most(kernel: Kernel, places: &[Place], most: usize, least: f64) -> Self {
        let (all, pivots) = pivoted_cholesky(kernel, places);
        let m = all.ncols();
        let eigen = all.tr_mul(&all).symmetric_eigen();
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        let mut left = places.len() as f64;
        order.retain(|&k| {
            let is_kept = left > least * places.len() as f64;
            left -= eigen.eigenvalues[k];
            is_kept
        });
        order.truncate(most);
        let waves = eigen.eigenvectors.select_columns(&order);
        let triangle = all.select_rows(&pivots);
        let by_about = triangle.transpose().solve_upper_triangular(&waves).unwrap_or(waves.clone());
        let about = pivots.iter().map(|&i| places[i].clone()).collect();
        Self { at: all * waves, about, by_about }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.at.ncols()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The unknowns: six a wave, rotation first; their columns begin at `first`.
    pub fn extras(&self, first: usize) -> Vec<Extra> {
        let kind = |k: usize| {
            if k % 6 < 3 {
                ExtraKind::PlaceTurn(first + k)
            } else {
                ExtraKind::PlaceShift(first + k)
            }
        };
        (0..6 * self.len()).map(|k| Extra::about_zero(kind(k), 1.0)).collect()
    }
}

/// `L` with `K ≈ L Lᵀ`, column by column, and the place of each: next is always that of which least is known.
fn pivoted_cholesky(kernel: Kernel, places: &[Place]) -> (DMatrix<f64>, Vec<usize>) {
    let n = places.len();
    let mut left = DVector::repeat(n, 1.0);
    let (mut columns, mut pivots): (Vec<DVector<f64>>, Vec<usize>) = (vec![], vec![]);
    while columns.len() < MOST_ABOUT.min(n) && left.sum() > 0.1 * LEFT * n as f64 {
        let pivot = left.imax();
        let scale = left[pivot].sqrt();
        let column = DVector::from_fn(n, |i, _| {
            let known: f64 = columns.iter().map(|c| c[i] * c[pivot]).sum();
            (kernel.at(&places[i], &places[pivot]) - known) / scale
        });
        left.zip_apply(&column, |l, c| *l = (*l - c * c).max(0.0));
        left[pivot] = 0.0;
        columns.push(column);
        pivots.push(pivot);
    }
    (DMatrix::from_fn(n, columns.len(), |i, k| columns[k][i]), pivots)
}

/// How a twist in the axes of the base, at the flange, moves the flange: perturbed on the right.
pub(crate) fn of_flange(flange: &Pose<Base, Flange>) -> Matrix6<f64> {
    let back = flange.rotation().transpose();
    let mut m = Matrix6::zeros();
    m.fixed_view_mut::<3, 3>(0, 0).copy_from(&back);
    m.fixed_view_mut::<3, 3>(3, 3).copy_from(&back);
    m
}

/// How `anchor_from_mount` of a view moves with each unknown: six rows, perturbed on the right.
pub fn of_view(setup: Setup, flange: &Pose<Base, Flange>, waves: &DVector<f64>) -> DMatrix<f64> {
    let m = of_anchor(setup, flange);
    let mut all = DMatrix::zeros(6, 6 * waves.len());
    for (k, size) in waves.iter().enumerate() {
        all.fixed_view_mut::<6, 6>(0, 6 * k).copy_from(&(m * *size));
    }
    all
}

/// How `anchor_from_mount` moves with a twist at the flange along the axes of the base.
fn of_anchor(setup: Setup, flange: &Pose<Base, Flange>) -> Matrix6<f64> {
    match setup {
        Setup::EyeInHand => of_flange(flange),
        // (F exp(ξ))⁻¹ = F⁻¹ exp(-Ad(F) ξ)
        Setup::EyeToHand => -lie::adjoint(flange.iso()) * of_flange(flange),
    }
}

/// By how much the logarithm of the likelihood would gain by errors by place that are small, from the score of their
/// levels at zero: with `Q = Uᵀ P U` and `q = Uᵀ P r` of the columns `U` of the waves, `s = ½ (|q|² - tr Q)` for each of
/// both levels, `I = ½ |Q|²`, and the gain is the maximum of `sᵀx - ½ xᵀ I x` over levels that are not negative.
/// `problem` is that of `fit` with waves among its unknowns, after all others.
pub(crate) fn expected_gain(problem: &Problem, fit: &JointFit) -> Option<f64> {
    let p = fit.information.nrows();
    let mut noise = fit.noise.clone();
    for source in [Source::PlaceRotation, Source::PlacePosition] {
        noise.sigmas.push(Sigma { source, sigma: 1.0, uncertainty: None });
    }
    let (h, g) = joint::normal_equations(problem, &JointFit { noise, ..fit.clone() });
    let n = h.nrows() - p;
    // the prior size of one is no data
    let own = h.view((p, p), (n, n)) - DMatrix::identity(n, n);
    let cross = h.view((p, 0), (n, p));
    let through = cross * fit.covariance.as_ref()?;
    let q = g.rows(p, n) - &through * g.rows(0, p);
    let by_all = own - through * cross.transpose();
    let level = |k: usize| usize::from(k % 6 >= 3);
    let (mut score, mut information) = ([0.0; 2], [[0.0; 2]; 2]);
    for k in 0..n {
        score[level(k)] += 0.5 * (q[k] * q[k] - by_all[(k, k)]);
        for l in 0..n {
            information[level(k)][level(l)] += 0.5 * by_all[(k, l)].powi(2);
        }
    }
    Some(most_gain(score, information))
}

/// The maximum of `sᵀx - ½ xᵀ I x` over `x` of two numbers that are not negative.
fn most_gain(s: [f64; 2], i: [[f64; 2]; 2]) -> f64 {
    let alone = |k: usize| s[k].max(0.0).powi(2) / (2.0 * i[k][k]);
    let determinant = i[0][0] * i[1][1] - i[0][1] * i[1][0];
    let x = (i[1][1] * s[0] - i[0][1] * s[1]) / determinant;
    let y = (i[0][0] * s[1] - i[1][0] * s[0]) / determinant;
    let both = if x > 0.0 && y > 0.0 { 0.5 * (s[0] * x + s[1] * y) } else { 0.0 };
    alone(0).max(alone(1)).max(both)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn places(n: usize, seed: u64) -> Vec<Place> {
        let mut random = Random::new(seed);
        let mut one = || {
            let (turn, shift) = (random.normal3() * 0.4, random.normal3() * 0.2);
            let pose = Pose::identity().retract(&lie::tangent(&turn, &shift));
            Place::new(&pose, &[turn.x, shift.y, turn.z])
        };
        (0..n).map(|_| one()).collect()
    }

    #[test]
    fn waves_carry_the_covariance_of_the_places() {
        let all = places(25, 1);
        for kernel in Kernel::OF_POSES.into_iter().chain([Kernel::OF_JOINTS]) {
            let waves = Waves::new(kernel, &all);
            let by_waves = &waves.at * waves.at.transpose();
            let off = DMatrix::from_fn(25, 25, |i, j| kernel.at(&all[i], &all[j])) - by_waves;
            assert!(off.diagonal().min() > -1e-9, "{}", off.diagonal().min());
            let carried = off.diagonal().sum() <= 0.05 * 25.0;
            assert!(carried || waves.len() == MOST, "{} waves", waves.len());
            let again = |i: usize| {
                let near = waves.about.iter().map(|p| kernel.at(&all[i], p));
                waves.by_about.tr_mul(&DVector::from_iterator(waves.about.len(), near))
            };
            let off = (0..25).map(|i| (again(i) - waves.at.row(i).transpose()).amax());
            assert!(off.fold(0.0, f64::max) < 1e-9);
        }
    }

    #[test]
    fn the_gain_of_two_levels_is_the_best_of_both_and_of_each() {
        assert!((most_gain([2.0, -1.0], [[1.0, 0.0], [0.0, 1.0]]) - 2.0).abs() < 1e-12);
        assert!((most_gain([2.0, 2.0], [[1.0, 0.0], [0.0, 1.0]]) - 4.0).abs() < 1e-12);
        assert_eq!(most_gain([-2.0, -1.0], [[1.0, 0.5], [0.5, 1.0]]), 0.0);
    }
}
