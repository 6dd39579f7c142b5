//! The error function and its slope, fast enough for every pixel of a fit.
//!
//! `erf(x) = 1 - (a₁t + a₂t² + a₃t³ + a₄t⁴ + a₅t⁵) exp(-x²)`, `t = 1/(1 + px)`, to 1.5e-7 before rounding:
//! M. Abramowitz and I. Stegun, *Handbook of Mathematical Functions*, 1964, 7.1.26. There is no branch
//! in it, so that several pixels are computed at once.

use std::f32::consts::{FRAC_2_SQRT_PI, LN_2, LOG2_E};

const P: f32 = 0.327_591_1;
const A: [f32; 5] = [0.254_829_6, -0.284_496_74, 1.421_413_7, -1.453_152, 1.061_405_4];

/// `erf(x)` and `erf'(x)`.
#[inline(always)]
pub(super) fn erf(x: f32) -> (f32, f32) {
    let size = x.abs();
    let gauss = exp_of_minus(size * size);
    let t = 1.0 / (1.0 + P * size);
    let series = t * (A[0] + t * (A[1] + t * (A[2] + t * (A[3] + t * A[4]))));
    ((1.0 - series * gauss).copysign(x), FRAC_2_SQRT_PI * gauss)
}

/// Added to a number, it leaves the nearest integer in the lowest bits.
const ROUND: f32 = 12_582_912.0;
/// Exponents below this are zero for every purpose. The square of this power of two is still a normal
/// number: processors compute with subnormal ones a hundred times slower.
const LEAST_EXPONENT: f32 = -50.0;

/// `exp(-u)` of `u >= 0`: `2^n 2^f` with an integer `n` and `|f| <= 1/2`.
#[inline(always)]
fn exp_of_minus(u: f32) -> f32 {
    let exponent = (-u * LOG2_E).max(LEAST_EXPONENT);
    let rounded = exponent + ROUND;
    let z = (exponent - (rounded - ROUND)) * LN_2;
    let series = 1.0
        + z * (1.0
            + z * (0.5 + z * (1.0 / 6.0 + z * (1.0 / 24.0 + z * (1.0 / 120.0 + z / 720.0)))));
    let power = f32::from_bits((rounded.to_bits() << 23).wrapping_add(1f32.to_bits()));
    power * series
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::function::erf::erf as reference;

    #[test]
    fn values_and_slopes_are_those_of_the_error_function() {
        for k in -3000..=3000 {
            let x = f64::from(k) * 2e-3;
            let (value, slope) = erf(x as f32);
            assert!((f64::from(value) - reference(x)).abs() < 1e-6, "{x}: {value}");
            let wanted = std::f64::consts::FRAC_2_SQRT_PI * (-x * x).exp();
            assert!((f64::from(slope) - wanted).abs() < 4e-7, "{x}: {slope}");
        }
        assert_eq!(erf(1e6).0, 1.0);
        assert!(erf(1e6).1 < 1e-14 && erf(1e6).1.powi(2).is_normal());
        assert!(erf(f32::NAN).0.is_nan());
    }
}
