//! Pictures made easier to read: halved, doubled, smoothed, stretched.

use nalgebra::Vector2;

use crate::GrayImage;

/// A picture and how its pixels map back: `original = (at + 0.5) * factor - 0.5`.
pub struct Scaled {
    /// The new picture.
    pub image: GrayImage,
    factor: f64,
}

impl Scaled {
    /// The picture itself.
    pub fn same(image: GrayImage) -> Self {
        Self { image, factor: 1.0 }
    }

    /// Half as large, each pixel the mean of four.
    pub fn halved(image: &GrayImage) -> Self {
        let (width, height) = (image.width() / 2, image.height() / 2);
        let mean = |(x, y): (usize, usize)| {
            let row = |y| image.at(2 * x, y) + image.at(2 * x + 1, y);
            0.25 * (row(2 * y) + row(2 * y + 1))
        };
        Self { image: draw(width, height, mean), factor: 2.0 }
    }

    /// Half as large once more.
    pub fn halved_again(&self) -> Self {
        let half = Self::halved(&self.image);
        Self { factor: half.factor * self.factor, ..half }
    }

    /// Twice as large, linear between pixels.
    pub fn doubled(image: &GrayImage) -> Self {
        let (width, height) = (image.width(), image.height());
        let near = |k: usize, n: usize| {
            // the doubled pixel lies a quarter towards the neighbour on its side
            let own = k / 2;
            (own, if k.is_multiple_of(2) { own.saturating_sub(1) } else { (own + 1).min(n - 1) })
        };
        let linear = |(x, y): (usize, usize)| {
            let ((a, b), (c, d)) = (near(x, width), near(y, height));
            let row = |y| 0.75 * image.at(a, y) + 0.25 * image.at(b, y);
            0.75 * row(c) + 0.25 * row(d)
        };
        Self { image: draw(2 * width, 2 * height, linear), factor: 0.5 }
    }

    /// A pixel of this picture, in the original.
    pub fn original(&self, at: &Vector2<f64>) -> Vector2<f64> {
        at.add_scalar(0.5) * self.factor - Vector2::repeat(0.5)
    }
}

/// Smoothed with the binomial kernel 1 4 6 4 1 in both directions (standard deviation 1 px).
pub fn smoothed(image: &GrayImage) -> GrayImage {
    let (width, height) = (image.width(), image.height());
    const KERNEL: [(isize, f32); 5] =
        [(-2, 1.0 / 16.0), (-1, 0.25), (0, 0.375), (1, 0.25), (2, 1.0 / 16.0)];
    let clamp = |k: usize, d: isize, n: usize| k.saturating_add_signed(d).min(n - 1);
    let rows = draw(width, height, |(x, y)| {
        KERNEL.iter().map(|&(d, w)| w * image.at(clamp(x, d, width), y)).sum()
    });
    draw(width, height, |(x, y)| {
        KERNEL.iter().map(|&(d, w)| w * rows.at(x, clamp(y, d, height))).sum()
    })
}

/// Share of the pixels that may become black, and white, in `stretched`.
const CLIPPED: f64 = 0.005;

/// Contrast stretched to the full range.
pub fn stretched(image: &GrayImage) -> GrayImage {
    let mut sorted: Vec<f32> = image.values().iter().step_by(7).copied().collect();
    sorted.sort_by(f32::total_cmp);
    let at = |share: f64| sorted[((sorted.len() - 1) as f64 * share) as usize];
    let (low, high) = (at(CLIPPED), at(1.0 - CLIPPED));
    let gain = 255.0 / (high - low).max(1.0);
    draw(image.width(), image.height(), |(x, y)| ((image.at(x, y) - low) * gain).clamp(0.0, 255.0))
}

fn draw(width: usize, height: usize, grey: impl Fn((usize, usize)) -> f32) -> GrayImage {
    let values = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(grey).collect();
    GrayImage::new(width, height, values).expect("as many values as pixels")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp() -> GrayImage {
        draw(16, 12, |(x, y)| 5.0 * x as f32 + 3.0 * y as f32)
    }

    #[test]
    fn a_ramp_keeps_its_place_when_scaled() {
        for scaled in [Scaled::halved(&ramp()), Scaled::doubled(&ramp())] {
            let at = Vector2::new(5.0, 4.0);
            let original = scaled.original(&at);
            let expected = 5.0 * original.x + 3.0 * original.y;
            assert!((f64::from(scaled.image.at(5, 4)) - expected).abs() < 1e-4);
        }
    }

    #[test]
    fn smoothing_keeps_a_ramp() {
        assert!((smoothed(&ramp()).at(7, 6) - ramp().at(7, 6)).abs() < 1e-4);
    }
}
