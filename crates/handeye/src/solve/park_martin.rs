//! Hand-eye calibration by logarithms.
//!
//! `A X = X B` for relative motions; with `α = log R_A`, `β = log R_B` the rotations obey
//! `α = R_X β`, so `R_X` is the rotation that best turns the `β` into the `α`:
//! `R_X = (MᵀM)^{-1/2} Mᵀ`, `M = Σ β αᵀ`, taken here as the rotation nearest to `Mᵀ`, which also
//! serves when `M` has rank two. Then `(R_A - I) t_X = R_X t_B - t_A` is linear in `t_X`.
//!
//! A logarithm does not factor: `M` is summed over all motions between up to 256 captures, and
//! above over those from each capture to 64 others. The position is over all motions always. Near a
//! half turn both logarithms are taken on the branch on which robot and camera agree.
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone.
//!
//! F. Park and B. Martin, *Robot sensor calibration: solving AX = XB on the Euclidean group*,
//! IEEE T-RA 10(5), 1994.

use nalgebra::Matrix3;

use super::{
    moments,
    moments::{Seen, Translations},
    shared::{open, place},
};
use crate::{Error, HandEye, PosePair, math::jacobi};

/// Up to this many captures all motions are used.
const ALL_UP_TO: usize = 256;
/// Motions from each of more captures.
const PARTNERS: usize = 64;

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = moments::seen(pairs)?;
    let rotation = jacobi::nearest_rotation(&logarithms(&all))
        .ok_or_else(|| open("the rotations between captures do not fix the camera's rotation"))?;
    let x = moments::with_position(rotation, &Translations::of_all(&all))?;
    Ok(place(pairs, x))
}

/// `Σ α βᵀ`.
fn logarithms(all: &[Seen]) -> Matrix3<f64> {
    let n = all.len();
    let mut sum = [[0.0; 3]; 3];
    if n <= ALL_UP_TO {
        for j in 1..n {
            for sooner in &all[..j] {
                add(&mut sum, sooner, &all[j]);
            }
        }
    } else {
        for i in 0..n {
            for k in 0..PARTNERS {
                add(&mut sum, &all[i], &all[(i + 1 + k * (n - 1) / PARTNERS) % n]);
            }
        }
    }
    Matrix3::from_fn(|i, j| sum[i][j])
}

#[inline]
fn add(sum: &mut [[f64; 3]; 3], i: &Seen, j: &Seen) {
    let (a, b) = (moments::between(&j.a, &i.a), moments::between(&j.b, &i.b));
    let branch = if a[0] + b[0] < 0.0 { -1.0 } else { 1.0 };
    let weight = angle_over_sine(branch * a[0]) * angle_over_sine(branch * b[0]);
    for k in 0..3 {
        let alpha = a[k + 1] * weight;
        for l in 0..3 {
            sum[k][l] += alpha * b[l + 1];
        }
    }
}

/// `θ / sin(θ/2)` as a polynomial of `w = cos(θ/2)`, good to 1e-7 for `w` from -0.25 (where noise
/// takes half turns) to 1. An error here changes weights, not the answer of exact motions.
#[inline]
fn angle_over_sine(w: f64) -> f64 {
    const POWERS: [f64; 11] = [
        3.141_592_833_125_188_6,
        -2.000_004_042_994_766,
        1.570_759_632_114_169_5,
        -1.332_927_839_997_393_4,
        1.178_597_517_634_778_5,
        -1.077_303_522_410_784_5,
        1.002_328_916_510_378_4,
        -0.865_651_585_442_882_2,
        0.582_971_868_875_606_7,
        -0.248_203_210_134_810_03,
        0.047_839_561_680_657_35,
    ];
    let w = w.max(-0.25);
    POWERS.iter().rev().fold(0.0, |sum, c| sum * w + c)
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_polynomial_is_the_angle_over_the_sine() {
        for k in 0..100 {
            let w = -0.25 + 1.249 * f64::from(k) / 100.0;
            let exact = 2.0 * w.acos() / (1.0 - w * w).sqrt();
            assert!((super::angle_over_sine(w) / exact - 1.0).abs() < 1e-7, "{w}");
        }
    }
}
