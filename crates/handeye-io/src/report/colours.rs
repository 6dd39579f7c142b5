//! Colours of things and of numbers.
//!
//! The scale of numbers is drawn in OKLCh (B. Ottosson, *A perceptual color space for image processing*,
//! 2020): its lightness rises evenly from the least to the largest, so that equal steps look equal, also to
//! the colour-blind and in grey; its hue goes from blue through green to yellow.

/// Colours of layers, one after the other; they keep apart on light and on dark paper.
pub const LAYERS: [&str; 8] =
    ["#2f7fd1", "#e08a1e", "#2f9e6e", "#c2557a", "#7b6fd0", "#2aa3b5", "#a8842c", "#c8553d"];
/// What others are compared with: no colour of the scale, and no grey.
pub const QUIET: &str = "#c9a294";
/// Numbers that are missing.
pub const MISSING: &str = "#9a9a9a";

/// Steps of the scale.
pub const STEPS: usize = 64;
/// Lightness, chroma and hue (degrees) of the least and of the largest number.
const LEAST: [f64; 3] = [0.44, 0.17, 277.0];
const LARGEST: [f64; 3] = [0.90, 0.17, 98.0];

/// The same of residuals of captures: grey where they are within noise, and an orange red for the worst.
const QUIET_RESIDUAL: [f64; 3] = [0.74, 0.025, 60.0];
const WORST_RESIDUAL: [f64; 3] = [0.60, 0.22, 36.0];
/// Captures that were rejected.
pub const REJECTED: &str = "#9a5fd0";

/// Steps in which chroma is taken off.
const FADING: f64 = 5e-4;

/// Colours from the least to the largest number.
pub fn scale() -> Vec<[u8; 3]> {
    steps(LEAST, LARGEST)
}

/// Colours of residuals, from none to the worst.
pub fn residual_scale() -> Vec<[u8; 3]> {
    steps(QUIET_RESIDUAL, WORST_RESIDUAL)
}

/// The colour of a residual by its share of the scale.
pub fn residual(share: f64) -> String {
    hex(at(share.clamp(0.0, 1.0), QUIET_RESIDUAL, WORST_RESIDUAL))
}

fn steps(least: [f64; 3], largest: [f64; 3]) -> Vec<[u8; 3]> {
    (0..STEPS).map(|k| at(k as f64 / (STEPS - 1) as f64, least, largest)).collect()
}

/// As style sheets write it.
pub fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn at(share: f64, least: [f64; 3], largest: [f64; 3]) -> [u8; 3] {
    let [lightness, mut chroma, hue] =
        std::array::from_fn(|k| least[k] + (largest[k] - least[k]) * share);
    // towards grey, until a screen can show it
    loop {
        let linear = linear_rgb(lightness, chroma, hue.to_radians());
        if chroma < FADING || linear.iter().all(|v| (-1e-3..=1.001).contains(v)) {
            return linear.map(|v| (255.0 * gamma(v.clamp(0.0, 1.0))).round() as u8);
        }
        chroma -= FADING;
    }
}

fn linear_rgb(lightness: f64, chroma: f64, hue: f64) -> [f64; 3] {
    let (a, b) = (chroma * hue.cos(), chroma * hue.sin());
    let l = (lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
    let m = (lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
    let s = (lightness - 0.089_484_177_5 * a - 1.291_485_548 * b).powi(3);
    [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701 * s,
    ]
}

/// sRGB's curve.
fn gamma(v: f64) -> f64 {
    if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn residuals_are_pale_within_noise_and_the_worst_is_saturated() {
        let spread = |c: &[u8; 3]| c.iter().max().unwrap() - c.iter().min().unwrap();
        let all = residual_scale();
        assert!(spread(&all[0]) < 30 && spread(&all[STEPS - 1]) > 150, "{all:?}");
        assert_eq!(residual(2.0), hex(all[STEPS - 1]));
    }

    #[test]
    fn white_is_white_and_larger_numbers_are_lighter() {
        let white = linear_rgb(1.0, 0.0, 0.0);
        assert!(white.iter().all(|v| (v - 1.0).abs() < 1e-6), "{white:?}");
        let channel = |v: u8| (f64::from(v) / 255.0).powf(2.2);
        let luminance = |[r, g, b]: &[u8; 3]| {
            0.2126 * channel(*r) + 0.7152 * channel(*g) + 0.0722 * channel(*b)
        };
        let all: Vec<f64> = scale().iter().step_by(3).map(luminance).collect();
        assert!(all.windows(2).all(|pair| pair[1] > pair[0]), "{all:?}");
    }
}
