//! Which surfel of the part is near a place and faces the same way, in one step.
//!
//! A grid of cells over the part; for each of six directions of the normal a cell holds the surfel nearest to its
//! middle. So both sides of a thin sheet have their own.

use nalgebra::Vector3;

use super::shape::Surfel;

/// A normal is in the class of an axis from this component on.
const IN_CLASS: f64 = 0.45;
/// Most cells, of all classes.
const MOST_CELLS: f64 = 1.2e7;
/// No surfel.
const NOWHERE: u32 = u32::MAX;

pub struct Field<'a> {
    surfels: &'a [Surfel],
    low: Vector3<f64>,
    per_m: f64,
    size: [usize; 3],
    classes: usize,
    cells: Vec<u32>,
}

impl<'a> Field<'a> {
    /// With cells of this edge; surfels are found from so far away, m.
    pub fn new(surfels: &'a [Surfel], edge: f64, reach: f64, oriented: bool) -> Self {
        let margin = Vector3::repeat(reach + edge);
        let all = || surfels.iter().map(|s| s.p);
        let low = all().reduce(|a, b| a.inf(&b)).unwrap_or_default() - margin;
        let high = all().reduce(|a, b| a.sup(&b)).unwrap_or_default() + margin;
        let classes = if oriented { 6 } else { 3 };
        let count = (high - low).map(|x| x / edge).product() * classes as f64;
        let edge = edge * (count / MOST_CELLS).cbrt().max(1.0);
        let size: [usize; 3] = (high - low).map(|x| (x / edge) as usize + 1).into();
        let cells = vec![NOWHERE; size.iter().product::<usize>() * classes];
        let mut field = Self { surfels, low, per_m: 1.0 / edge, size, classes, cells };
        let mut nearest = vec![f32::INFINITY; field.cells.len()];
        for k in 0..surfels.len() {
            field.enter(k, (reach / edge).ceil() as i32, &mut nearest);
        }
        field
    }

    fn enter(&mut self, k: usize, steps: i32, nearest: &mut [f32]) {
        let surfel = self.surfels[k];
        let at = (surfel.p - self.low) * self.per_m;
        let middle = at.map(|x| x as i32);
        for step in 0..(2 * steps + 1).pow(3) {
            let side = 2 * steps + 1;
            let cell = middle + Vector3::new(step % side, step / side % side, step / side / side)
                - Vector3::repeat(steps);
            let inside = (0..3).all(|a| cell[a] >= 0 && (cell[a] as usize) < self.size[a]);
            if !inside {
                continue;
            }
            let off = (cell.map(f64::from).add_scalar(0.5) - at).norm_squared() as f32;
            let place = self.place(cell.map(|x| x as usize).into());
            for class in 0..self.classes {
                let sign = if class < 3 { 1.0 } else { -1.0 };
                let component = surfel.n[class % 3] * sign;
                let component = if self.classes == 3 { component.abs() } else { component };
                if component > IN_CLASS && off < nearest[place + class] {
                    nearest[place + class] = off;
                    self.cells[place + class] = k as u32;
                }
            }
        }
    }

    #[inline(always)]
    fn place(&self, cell: [usize; 3]) -> usize {
        ((cell[2] * self.size[1] + cell[1]) * self.size[0] + cell[0]) * self.classes
    }

    /// The middle of its box.
    pub fn middle(&self) -> Vector3<f64> {
        self.low + Vector3::from(self.size.map(|n| n as f64)) * (0.5 / self.per_m)
    }

    /// A surfel near a place whose normal is in the same class.
    #[inline(always)]
    pub fn find(&self, p: &Vector3<f64>, n: &Vector3<f64>) -> Option<&'a Surfel> {
        let at = (p - self.low) * self.per_m;
        let mut cell = [0; 3];
        for a in 0..3 {
            if !(at[a] >= 0.0) || at[a] >= self.size[a] as f64 {
                return None;
            }
            cell[a] = at[a] as usize;
        }
        let axis = n.iamax();
        let class = if self.classes == 6 && n[axis] < 0.0 { axis + 3 } else { axis };
        let k = self.cells[self.place(cell) + class];
        (k != NOWHERE).then(|| &self.surfels[k as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two sides of a sheet, 1 mm apart.
    fn sheet() -> Vec<Surfel> {
        let side = |z: f64, n: f64| {
            (0..400).map(move |k| Surfel {
                p: Vector3::new((k % 20) as f64, (k / 20) as f64, z) * 1e-3,
                n: Vector3::z() * n,
            })
        };
        side(0.0, -1.0).chain(side(1.0, 1.0)).collect()
    }

    #[test]
    fn the_side_of_a_sheet_that_faces_the_same_way_is_found() {
        let surfels = sheet();
        let field = Field::new(&surfels, 1e-3, 3e-3, true);
        let p = Vector3::new(7.2e-3, 9.1e-3, 0.4e-3);
        for sign in [1.0, -1.0] {
            let found = field.find(&p, &(Vector3::z() * sign)).unwrap();
            assert!(found.n.z * sign > 0.9 && (found.p - p).xy().norm() < 1e-3, "{found:?}");
        }
        assert!(field.find(&p, &Vector3::x()).is_none());
        assert!(field.find(&Vector3::repeat(0.05), &Vector3::z()).is_none());
    }
}
