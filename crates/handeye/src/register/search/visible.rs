//! What a scan shows in which direction from its camera: its surfels, the nearest of each direction.

use nalgebra::{Vector2, Vector3};

use super::shape::Surfel;

/// Cells are so many times as wide as surfels lie apart.
const WIDE: f64 = 1.3;
/// Most cells for each surfel.
const MOST: usize = 60;

/// What a camera says of a place on the part's surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sight {
    /// The scan shows a surface there.
    Seen,
    /// The scan shows only what is behind it: it would have hidden that.
    Contradicted,
    /// Something in front hides it.
    Hidden,
    /// Nothing was measured in that direction, in the middle of the scan or outside of it.
    Missing,
}

/// Depths along rays.
pub(crate) struct RangeImage {
    low: Vector2<f64>,
    per_unit: f64,
    size: [usize; 2],
    depth: Vec<f32>,
}

impl RangeImage {
    /// Of all surfels of a scan, in the frame of its camera.
    pub fn new(surfels: &[Surfel]) -> Option<Self> {
        let ray = |s: &&Surfel| s.p.z > 0.0;
        let all = || surfels.iter().filter(ray).map(|s| s.p.xy() / s.p.z);
        let low = all().reduce(|a, b| a.inf(&b))?;
        let high = all().reduce(|a, b| a.sup(&b))?;
        let apart = spacing(surfels)?;
        let per_unit = 1.0 / (WIDE * apart);
        let size: [usize; 2] = ((high - low) * per_unit).map(|x| x as usize + 1).into();
        if size[0].checked_mul(size[1])? > MOST * surfels.len() {
            return None;
        }
        let mut image = Self { low, per_unit, size, depth: vec![f32::INFINITY; size[0] * size[1]] };
        for s in surfels.iter().filter(ray) {
            if let Some([x, y]) = image.cell(&s.p) {
                let held = &mut image.depth[y * size[0] + x];
                *held = held.min(s.p.z as f32);
            }
        }
        Some(image)
    }

    fn cell(&self, p: &Vector3<f64>) -> Option<[usize; 2]> {
        let at = (p.xy() / p.z - self.low) * self.per_unit;
        let inside = (0..2).all(|a| at[a] >= 0.0 && at[a] < self.size[a] as f64);
        (p.z > 0.0 && inside).then(|| [at.x as usize, at.y as usize])
    }

    /// Of a place on a surface that faces the camera; depths agree within a distance, m.
    pub fn sight(&self, p: &Vector3<f64>, within: f64) -> Sight {
        let Some([x, y]) = self.cell(p) else { return Sight::Missing };
        let (mut nearer, mut farther, mut nothing) = (0, 0, 0);
        for row in y.saturating_sub(1)..(y + 2).min(self.size[1]) {
            for column in x.saturating_sub(1)..(x + 2).min(self.size[0]) {
                let off = f64::from(self.depth[row * self.size[0] + column]) - p.z;
                if off.is_infinite() {
                    nothing += 1;
                } else if off.abs() <= within {
                    return Sight::Seen;
                } else if off < 0.0 {
                    nearer += 1;
                } else {
                    farther += 1;
                }
            }
        }
        if nearer > 0 {
            Sight::Hidden
        } else if farther > nothing {
            Sight::Contradicted
        } else {
            Sight::Missing
        }
    }
}

/// Between the rays of neighbours, from their number and where they lie; `None` of too few.
fn spacing(surfels: &[Surfel]) -> Option<f64> {
    // area of surfels as seen, by how many coarse cells hold some
    let all: Vec<Vector2<f64>> =
        surfels.iter().filter(|s| s.p.z > 0.0).map(|s| s.p.xy() / s.p.z).collect();
    let low = all.iter().copied().reduce(|a, b| a.inf(&b))?;
    let high = all.iter().copied().reduce(|a, b| a.sup(&b))?;
    let mut apart = ((high - low).x * (high - low).y / all.len() as f64).sqrt();
    for _ in 0..4 {
        let edge = 3.0 * apart;
        let mut cells: Vec<[i32; 2]> =
            all.iter().map(|d| ((d - low) / edge).map(|x| x as i32).into()).collect();
        cells.sort_unstable();
        cells.dedup();
        apart = edge * (cells.len() as f64 / all.len() as f64).sqrt();
    }
    (apart.is_finite() && apart > 0.0).then_some(apart)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_in_front_of_a_scan_contradicts_it_and_what_is_behind_is_hidden() {
        let at = |n: usize| (n as f64 - 24.5) * 2e-3;
        let wall: Vec<Surfel> = (0..2500)
            .map(|k| Surfel { p: Vector3::new(at(k % 50), at(k / 50), 0.5), n: -Vector3::z() })
            .collect();
        let view = RangeImage::new(&wall).unwrap();
        let sight = |x: f64, z: f64| view.sight(&Vector3::new(x, 0.003, z), 1e-3);
        assert_eq!(sight(0.01, 0.5003), Sight::Seen);
        assert_eq!(sight(0.01, 0.48), Sight::Contradicted);
        assert_eq!(sight(0.01, 0.52), Sight::Hidden);
        assert_eq!(sight(0.2, 0.48), Sight::Missing);
    }
}
