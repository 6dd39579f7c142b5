//! A proof that no other pair of poses fits `A X = Y B` better in the sense of least squares.
//!
//! The cost is chordal in rotation and isotropic,
//! `Σ arm²/2 ‖R_A R_X - R_Y R_B‖² + ‖R_A t_X + t_A - R_Y t_B - t_Y‖²`, arm = [`ARM`]. Its minimum
//! is sought from a start, and a lower bound that holds for all rotations is raised towards it (`dual`).
//! Where the two meet, the minimum is global; where they do not, nothing is claimed. The
//! maximum-likelihood answer weighs its data otherwise and is not this minimum: the certificate says
//! how far apart they are.

mod dual;
mod quadratic;

use serde::{Deserialize, Serialize};

use crate::{
    Error, HandEye, PosePair,
    solve::{self},
};
pub use quadratic::ARM;
use quadratic::{Cost, Rotations};

/// Relative gap up to which bound and cost count as one.
const CLOSED: f64 = 1e-6;
/// Costs below this part of the form's trace are rounding: gaps are relative to it at least. It is
/// a residual of about 0.1 mm.
const LEAST_COST: f64 = 1e-8;

/// What is proven of the least-squares fit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// Whether no other pair of poses fits better.
    pub certified: bool,
    /// Cost minus proven lower bound, relative to the cost.
    pub gap: f64,
    /// Smallest eigenvalue of the dual matrix over the mean eigenvalue of the cost; not negative,
    /// but for rounding, where the proof stands.
    pub min_eigenvalue: f64,
    /// The fit that this is about.
    pub least_squares: HandEye,
    /// Angle between its camera and the reported one's, degrees.
    pub rotation_to_answer_deg: f64,
    /// Distance between the two, mm.
    pub translation_to_answer_mm: f64,
}

/// Tries to prove that the least-squares minimum next to `answer` is the global one.
///
/// # Errors
/// As [`solve::solve`] on pairs that are too few, do not rotate, or are not finite.
pub fn certify(pairs: &[PosePair], answer: &HandEye) -> Result<Certificate, Error> {
    solve::check(pairs)?;
    if !(answer.mount_from_camera.is_finite() && answer.anchor_from_target.is_finite()) {
        return Err(Error::NotFinite { what: "the answer to certify".into() });
    }
    let cost = Cost::of(pairs);
    let rotations = Rotations::of(answer).polished(&cost);
    let bound = dual::bound(&cost.q, &rotations.z());
    let at = cost.at(&rotations);
    let gap = (at - bound.least_cost) / at.max(LEAST_COST * cost.q.trace());
    let least_squares = cost.hand_eye(&rotations);
    let (found, reported) = (&least_squares.mount_from_camera, &answer.mount_from_camera);
    Ok(Certificate {
        certified: gap <= CLOSED,
        gap,
        min_eigenvalue: bound.min_eigenvalue,
        least_squares,
        rotation_to_answer_deg: found.angle_to(reported).to_degrees(),
        translation_to_answer_mm: found.distance_to(reported) * 1e3,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Pose,
        math::{lie::tangent, random::Random},
        solve::tests::{assert_same, exact_pairs, pose, truths},
    };

    /// Fifteen pairs with noise of these sizes (rad, m per axis) on both sides.
    fn noisy(truth: &HandEye, seed: u64, rotation: f64, position: f64) -> Vec<PosePair> {
        let mut random = Random::new(seed);
        let mut off = || tangent(&(random.normal3() * rotation), &(random.normal3() * position));
        let mut pairs = exact_pairs(truth, 15);
        for pair in &mut pairs {
            pair.anchor_from_mount = pair.anchor_from_mount.retract(&off());
            pair.camera_from_target = pair.camera_from_target.retract(&off());
        }
        pairs
    }

    #[test]
    fn exact_data_are_certified() {
        for truth in truths() {
            let found = certify(&exact_pairs(&truth, 12), &truth).unwrap();
            assert!(found.certified, "{found:?}");
            assert_same(found.least_squares.mount_from_camera, truth.mount_from_camera, "X");
        }
    }

    #[test]
    fn noisy_data_are_certified_up_to_30_mm_and_2_degrees() {
        let mut worst: f64 = 0.0;
        for level in 0..8 {
            for seed in 0..6 {
                let size = f64::from(level + 1) / 8.0;
                let (rotation, position) = (1.8_f64.to_radians() * size, 30e-3 * size);
                let truth = truths()[seed as usize];
                let pairs = noisy(&truth, 100 * level as u64 + seed, rotation, position);
                let found = certify(&pairs, &truth).unwrap();
                assert!(found.certified, "{level} {seed}: {found:?}");
                worst = worst.max(found.gap);
            }
        }
        assert!(worst < 1e-8, "{worst}");
    }

    /// Turns about one axis but for a few degrees, hardly any travel: a camera turned the other way
    /// round nearly fits as well.
    fn nearly_one_axis(truth: &HandEye) -> Vec<PosePair> {
        let one = |k: u32| {
            let s = f64::from(k);
            let anchor_from_mount = pose(
                [0.01 * s.sin(), 0.0, 0.5],
                [0.1 * (1.3 * s).sin(), 0.1 * (2.1 * s).cos(), 0.9 * s],
            );
            let seen = (anchor_from_mount * truth.mount_from_camera).inverse();
            PosePair { anchor_from_mount, camera_from_target: seen * truth.anchor_from_target }
        };
        (0..7).map(one).collect()
    }

    #[test]
    fn a_minimum_that_is_not_global_is_not_certified() {
        let mut random = Random::new(5);
        let pairs = nearly_one_axis(&truths()[0]);
        let best = certify(&pairs, &truths()[0]).unwrap();
        let mut wrong = 0;
        for _ in 0..30 {
            let mut any = || nalgebra::Isometry3::new(random.normal3(), random.normal3() * 2.0);
            let start = HandEye {
                mount_from_camera: Pose::claim(any()),
                anchor_from_target: Pose::claim(any()),
            };
            let found = certify(&pairs, &start).unwrap();
            let same = found
                .least_squares
                .mount_from_camera
                .angle_to(&best.least_squares.mount_from_camera)
                < 1e-6;
            assert_eq!(found.certified, same, "{found:?}");
            wrong += u32::from(!same);
        }
        assert!(wrong > 0, "no start led to another minimum");
    }

    #[test]
    fn pairs_that_cannot_be_solved_cannot_be_certified() {
        assert!(certify(&exact_pairs(&truths()[0], 2), &truths()[0]).is_err());
    }
}
