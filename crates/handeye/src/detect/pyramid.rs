//! Images made easier to read: halved, doubled, smoothed, stretched.

use std::borrow::Cow;

use multiversion::multiversion;
use nalgebra::Vector2;

use crate::GrayImage;

/// An image and how its pixels map back: `original = (at + 0.5) * factor - 0.5`.
pub(crate) struct Scaled<'a> {
    /// The new image.
    pub image: Cow<'a, GrayImage>,
    factor: f64,
}

impl<'a> Scaled<'a> {
    /// The image itself.
    pub fn same(image: &'a GrayImage) -> Self {
        Self { image: Cow::Borrowed(image), factor: 1.0 }
    }

    /// Half as large, each pixel the mean of four.
    pub(crate) fn halved(&self) -> Self {
        let (width, height) = (self.image.width() / 2, self.image.height() / 2);
        let full = self.image.width();
        let mut values = vec![0.0; width * height];
        for (row, pair) in
            values.chunks_exact_mut(width.max(1)).zip(self.image.values().chunks_exact(2 * full))
        {
            halve(row, pair.split_at(full));
        }
        let image = GrayImage::new(width, height, values).expect("as many values as pixels");
        Self { image: Cow::Owned(image), factor: 2.0 * self.factor }
    }

    /// The image and its halves, halves of these and so on, until one is `small_enough`, or so narrow that its half is
    /// none; the smallest first.
    pub fn halves(
        image: &'a GrayImage,
        small_enough: impl Fn(&GrayImage) -> bool,
    ) -> impl Iterator<Item = Self> {
        let mut all = vec![Self::same(image)];
        while let Some(last) = all.last()
            && !small_enough(&last.image)
            && last.image.width().min(last.image.height()) > 1
        {
            all.push(last.halved());
        }
        all.into_iter().rev()
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
        Self { image: Cow::Owned(draw(2 * width, 2 * height, linear)), factor: 0.5 }
    }

    /// A pixel of this image, in the original.
    pub(crate) fn original(&self, at: &Vector2<f64>) -> Vector2<f64> {
        at.add_scalar(0.5) * self.factor - Vector2::repeat(0.5)
    }

    /// A pixel of the original, in this image.
    pub(crate) fn reduced(&self, at: &Vector2<f64>) -> Vector2<f64> {
        at.add_scalar(0.5) / self.factor - Vector2::repeat(0.5)
    }
}

/// Smoothed with the binomial kernel 1 4 6 4 1 in both directions (standard deviation 1 px).
pub(crate) fn smoothed(image: &GrayImage) -> GrayImage {
    let (width, height) = (image.width(), image.height());
    let mut padded = vec![0.0; width + 4];
    let mut across = |y: usize, out: &mut [f32]| {
        let row = &image.values()[y * width..(y + 1) * width];
        padded[2..width + 2].copy_from_slice(row);
        padded[..2].fill(row[0]);
        padded[width + 2..].fill(row[width - 1]);
        let at = |k: usize| &padded[k..][..width];
        binomial(out, [at(0), at(1), at(2), at(3), at(4)]);
    };
    // rows smoothed across, the last five
    let mut rows: [Vec<f32>; 5] = std::array::from_fn(|_| vec![0.0; width]);
    let mut next = 0;
    let mut values = vec![0.0; width * height];
    for (y, out) in values.chunks_exact_mut(width.max(1)).enumerate() {
        while next < height.min(y + 3) {
            across(next, &mut rows[next % 5]);
            next += 1;
        }
        let at = |d: usize| &rows[(y + d).saturating_sub(2).min(height - 1) % 5][..];
        binomial(out, [at(0), at(1), at(2), at(3), at(4)]);
    }
    GrayImage::new(width, height, values).expect("as many values as pixels")
}

#[multiversion(targets("x86_64+avx2"))]
fn halve(row: &mut [f32], (upper, lower): (&[f32], &[f32])) {
    let (upper, lower) = (upper.as_chunks::<2>().0, lower.as_chunks::<2>().0);
    for (out, (u, l)) in row.iter_mut().zip(upper.iter().zip(lower)) {
        *out = 0.25 * ((u[0] + u[1]) + (l[0] + l[1]));
    }
}

#[multiversion(targets("x86_64+avx2"))]
fn binomial(out: &mut [f32], [a, b, c, d, e]: [&[f32]; 5]) {
    let n = out.len();
    let (a, b, c, d, e) = (&a[..n], &b[..n], &c[..n], &d[..n], &e[..n]);
    for k in 0..n {
        out[k] = (1.0 / 16.0) * ((a[k] + e[k]) + 4.0 * (b[k] + d[k]) + 6.0 * c[k]);
    }
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
        for scaled in [Scaled::same(&ramp()).halved(), Scaled::doubled(&ramp())] {
            let at = Vector2::new(5.0, 4.0);
            let original = scaled.original(&at);
            let expected = 5.0 * original.x + 3.0 * original.y;
            assert!((f64::from(scaled.image.at(5, 4)) - expected).abs() < 1e-4);
            assert!((scaled.reduced(&original) - at).norm() < 1e-12);
        }
    }

    #[test]
    fn smoothing_keeps_a_ramp() {
        assert!((smoothed(&ramp()).at(7, 6) - ramp().at(7, 6)).abs() < 1e-4);
    }
}
