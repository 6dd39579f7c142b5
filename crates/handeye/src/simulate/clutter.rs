//! What is behind a board, or instead of one: drawn from a seed, without any board.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::{
    Conditions, Optics,
    canvas::{Canvas, Window},
    render::develop,
};
use crate::{
    GrayImage,
    math::random::Random,
    simulate::pattern::{Clutter, Pattern, hashed, noise_at},
};

/// Rectangles and the like per megapixel.
const THINGS_PER_MEGAPIXEL: f64 = 60.0;
/// Squares of a small checker, fewest and most along a side.
const SMALL_CHECKER: (f64, f64) = (3.0, 5.99);
/// A letter is this many dots wide and high, the gap included.
const LETTER: (i64, i64) = (6, 9);

impl Clutter {
    /// An image of nothing else.
    pub fn picture(&self, (width, height): (u32, u32), optics: &Optics, seed: u64) -> GrayImage {
        let margin = super::render::margin(optics);
        let window = Window::whole((width, height), margin);
        let paint = |canvas: &mut Canvas| self.paint(canvas, (width, height));
        let light = (&Conditions::default(), None);
        develop((&window, paint), (width, height), light, optics, seed)
    }

    /// Paints all of `canvas`, a part of an image of `size`.
    pub(super) fn paint(&self, canvas: &mut Canvas, size: (u32, u32)) {
        let mut random = Random::new(self.seed ^ 0xc1a7);
        let (width, height) = (f64::from(size.0), f64::from(size.1));
        match self.pattern {
            Pattern::Noise => noise(canvas, &mut random),
            Pattern::Grating => grating(canvas, &mut random),
            Pattern::Bricks => bricks(canvas, &mut random),
            Pattern::Text => {
                let paper = random.between(150.0, 230.0);
                canvas.paint(|_| Some(paper));
                let count = 4 + (random.bits() % 12) as usize;
                (0..count).for_each(|_| text(&mut random, width, height).paint(canvas));
            }
            Pattern::Things => {
                let ground = random.between(60.0, 180.0);
                canvas.paint(|_| Some(ground));
                let count = (THINGS_PER_MEGAPIXEL * width * height * 1e-6) as usize;
                for _ in 0..count.max(8) {
                    thing(&mut random, width, height).paint(canvas);
                }
            }
        }
    }
}

/// A direction, as a unit vector.
fn turned(random: &mut Random) -> Vector2<f64> {
    let (sine, cosine) = random.between(0.0, TAU).sin_cos();
    Vector2::new(cosine, sine)
}

fn noise(canvas: &mut Canvas, random: &mut Random) {
    let seed = random.bits();
    let (grain, contrast) = (random.between(1.5, 20.0), random.between(60.0, 220.0));
    canvas.paint(|at| {
        let octave = |k: i32| {
            let size = grain * f64::from(1 << k);
            noise_at(seed ^ k as u64, &(at / size)) - 0.5
        };
        Some(128.0 + contrast * (octave(0) + 0.7 * octave(2)))
    });
}

fn grating(canvas: &mut Canvas, random: &mut Random) {
    let along = turned(random);
    let (period, sharp) = (random.between(4.0, 60.0), random.bits().is_multiple_of(2));
    let (middle, contrast) = (random.between(90.0, 160.0), random.between(20.0, 90.0));
    canvas.paint(|at| {
        let wave = (TAU * at.dot(&along) / period).sin();
        Some(middle + contrast * if sharp { wave.signum() } else { wave })
    });
}

fn bricks(canvas: &mut Canvas, random: &mut Random) {
    let seed = random.bits();
    let along = turned(random);
    let across = Vector2::new(-along.y, along.x);
    let height = random.between(14.0, 60.0);
    let (length, mortar) = (height * random.between(1.0, 3.0), height * random.between(0.05, 0.2));
    let (dark, light) = (random.between(40.0, 110.0), random.between(130.0, 220.0));
    canvas.paint(|at| {
        let y = at.dot(&across) / height;
        let row = y.floor();
        let x = at.dot(&along) / length + 0.5 * row;
        let in_mortar = (y - row) * height < mortar || (x - x.floor()) * length < mortar;
        let brick = dark + 30.0 * hashed(seed, x.floor() as i64, row as i64);
        Some(if in_mortar { light } else { brick })
    });
}

/// A turned rectangle with something in it.
struct Stamp {
    centre: Vector2<f64>,
    along: Vector2<f64>,
    half: Vector2<f64>,
    ink: Ink,
}

enum Ink {
    Flat(f64),
    Checker { cell: f64, greys: [f64; 2] },
    Letters { dot: f64, grey: f64, seed: u64 },
}

impl Stamp {
    fn paint(&self, canvas: &mut Canvas) {
        let reach = self.half.norm().ceil() as i64 + 1;
        let (x, y) = (self.centre.x.round() as i64, self.centre.y.round() as i64);
        let part = Window { left: x - reach, top: y - reach, right: x + reach, bottom: y + reach };
        let across = Vector2::new(-self.along.y, self.along.x);
        canvas.paint_in(&part, |at| {
            let off = at - self.centre;
            let own = Vector2::new(off.dot(&self.along), off.dot(&across));
            let inside = own.x.abs() < self.half.x && own.y.abs() < self.half.y;
            if inside { self.ink.at(&(own + self.half)) } else { None }
        });
    }
}

impl Ink {
    fn at(&self, own: &Vector2<f64>) -> Option<f64> {
        match self {
            Self::Flat(grey) => Some(*grey),
            Self::Checker { cell, greys } => {
                let odd = ((own.x / cell) as usize + (own.y / cell) as usize) % 2;
                Some(greys[odd])
            }
            Self::Letters { dot, grey, seed } => {
                let (i, j) = ((own.x / dot) as i64, (own.y / dot) as i64);
                let (x, y) = (i % LETTER.0, j % LETTER.1);
                let blank = x == LETTER.0 - 1 || y >= LETTER.1 - 2;
                let space = hashed(seed ^ 1, i / LETTER.0, j / LETTER.1) < 0.17;
                (!blank && !space && hashed(*seed, i, j) < 0.45).then_some(*grey)
            }
        }
    }
}

fn place(random: &mut Random, width: f64, height: f64) -> Vector2<f64> {
    Vector2::new(random.between(0.0, width), random.between(0.0, height))
}

fn text(random: &mut Random, width: f64, height: f64) -> Stamp {
    let dot = random.between(1.2, 5.0);
    let lines = 1.0 + (random.bits() % 8) as f64;
    let letters = 8.0 + (random.bits() % 30) as f64;
    let (dark, upright) = (random.between(10.0, 80.0), random.bits().is_multiple_of(2));
    let along = turned(random);
    Stamp {
        centre: place(random, width, height),
        along: if upright { Vector2::x() } else { along },
        half: 0.5 * dot * Vector2::new(letters * LETTER.0 as f64, lines * LETTER.1 as f64),
        ink: Ink::Letters { dot, grey: dark, seed: random.bits() },
    }
}

fn thing(random: &mut Random, width: f64, height: f64) -> Stamp {
    let kind = random.bits() % 8;
    let grey = random.between(5.0, 250.0);
    let (centre, along) = (place(random, width, height), turned(random));
    let side = |random: &mut Random, low: f64, high: f64| 0.5 * random.between(low, high);
    match kind {
        0..=2 => {
            let half = Vector2::new(side(random, 10.0, 240.0), side(random, 10.0, 240.0));
            Stamp { centre, along, half, ink: Ink::Flat(grey) }
        }
        3..=4 => {
            let half = Vector2::new(side(random, 60.0, 900.0), side(random, 1.0, 9.0));
            Stamp { centre, along, half, ink: Ink::Flat(grey) }
        }
        5 => text(random, width, height),
        _ => {
            let count = |r: &mut Random| r.between(SMALL_CHECKER.0, SMALL_CHECKER.1).floor();
            let cell = random.between(8.0, 40.0);
            let half = 0.5 * cell * Vector2::new(count(random), count(random));
            let greys = [random.between(5.0, 80.0), random.between(150.0, 250.0)];
            Stamp { centre, along, half, ink: Ink::Checker { cell, greys } }
        }
    }
}
