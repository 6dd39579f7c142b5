//! Kinds of backgrounds, and smooth noise.

use crate::math::random::Random;
use nalgebra::Vector2;

/// A background.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Clutter {
    /// What it is made of.
    pub pattern: Pattern,
    /// Which of its kind.
    pub seed: u64,
}

/// What a background is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pattern {
    /// Rectangles, lines, pieces of text and small checkers, one upon another.
    Things,
    /// Patches of random grey, from fine to coarse.
    Noise,
    /// Parallel bars, sharp or smooth.
    Grating,
    /// A brick wall.
    Bricks,
    /// Lines of something like letters.
    Text,
}

impl Pattern {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Things, Self::Noise, Self::Grating, Self::Bricks, Self::Text];

    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Things => "clutter",
            Self::Noise => "noise",
            Self::Grating => "grating",
            Self::Bricks => "brick wall",
            Self::Text => "text",
        }
    }
}

/// Smooth noise from 0 to 1 with a grain of size 1.
pub(crate) fn noise_at(seed: u64, at: &Vector2<f64>) -> f64 {
    let (i, j) = (at.x.floor(), at.y.floor());
    let smooth = |x: f64| x * x * (3.0 - 2.0 * x);
    let (x, y) = (smooth(at.x - i), smooth(at.y - j));
    let value = |di: i64, dj: i64| hashed(seed, i as i64 + di, j as i64 + dj);
    (value(0, 0) * (1.0 - x) + value(1, 0) * x) * (1.0 - y)
        + (value(0, 1) * (1.0 - x) + value(1, 1) * x) * y
}

/// A value from 0 to 1 for a whole place.
pub(crate) fn hashed(seed: u64, i: i64, j: i64) -> f64 {
    let place = (i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        ^ (j as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f);
    Random::new(seed ^ place).unit()
}
