//! Clouds and meshes as few bytes: places as 16-bit steps through their own box, in base64.

use std::collections::BTreeMap;

use handeye::register::KdTree;
use serde::Serialize;

use super::thin::{Cubes, thin};
use crate::report::base64::base64;

/// Most points of a cloud in a page: 1.2 MB.
pub const MOST_POINTS: usize = 150_000;
/// Most points of all clouds in a page: 4 MB.
pub const MOST_OF_ALL: usize = 500_000;
/// Most triangles of a mesh in a page.
pub const MOST_TRIANGLES: usize = 100_000;
/// The last step.
const STEPS: f64 = u16::MAX as f64;
/// Share of the points on either side of each axis that the view may leave outside.
const STRAYS: f64 = 0.01;
/// Fewer points have no strays.
const FEW: usize = 200;
/// Points that tell the distance between neighbours, and which neighbour does.
const ASKED: usize = 400;
const NEIGHBOUR: usize = 4;

/// Places of points; where many points would be on top of one another, fewer.
#[derive(Serialize)]
pub struct Packed {
    /// Points that are drawn.
    pub count: usize,
    /// Points, or triangles, that there were.
    #[serde(skip)]
    pub of: usize,
    low: [f64; 3],
    step: [f64; 3],
    cells: String,
    /// Numbers of corners of triangles, as many bytes each.
    #[serde(skip_serializing_if = "Option::is_none")]
    corners: Option<Corners>,
    /// Distance between neighbours, m.
    spacing: f64,
    /// Between the states, numbers from zero to one as 16 bits; the largest means none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    values: Vec<String>,
    /// Box around most points.
    pub focus: [[f64; 3]; 2],
}

#[derive(Serialize)]
struct Corners {
    bytes: u8,
    count: usize,
    numbers: String,
}

impl Packed {
    /// A cloud, of which at most so many points stay; `None` without points.
    pub fn cloud(points: &[[f32; 3]], most: usize) -> Option<Self> {
        let of = points.iter().filter(|p| p.iter().all(|x| x.is_finite())).count();
        let kept = thin(points, most);
        let kept: Vec<[f32; 3]> = kept.into_iter().map(|k| points[k as usize]).collect();
        Self::places(&kept, of)
    }

    /// A cloud that was thinned from so many points.
    pub fn thinned(points: &[[f32; 3]], of: usize) -> Option<Self> {
        Self::places(points, of)
    }

    /// A cloud that was thinned, with a number from 0 to 1 for each point in each state; NaN is none.
    pub fn valued(points: &[[f32; 3]], of: usize, values: &[Vec<f32>]) -> Option<Self> {
        let packed = |share: &f32| match share {
            share if share.is_finite() => (share.clamp(0.0, 1.0) * 65534.0).round() as u16,
            _ => u16::MAX,
        };
        let text = |all: &Vec<f32>| base64(&bytes(all.iter().map(packed)));
        let places = Self::places(points, of)?;
        Some(Self { values: values.iter().map(text).collect(), ..places })
    }

    /// A mesh; `None` without triangles. Of very many triangles the corners are drawn together.
    pub fn mesh(vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> Option<Self> {
        let (vertices, kept) = simplified(vertices, triangles, MOST_TRIANGLES);
        let numbers = || kept.iter().flatten();
        let corners = if vertices.len() <= usize::from(u16::MAX) {
            Corners { bytes: 2, count: 0, numbers: base64(&bytes(numbers().map(|k| *k as u16))) }
        } else {
            let wide: Vec<u8> = numbers().flat_map(|k| k.to_le_bytes()).collect();
            Corners { bytes: 4, count: 0, numbers: base64(&wide) }
        };
        let places = Self::places(&vertices, triangles.len()).filter(|_| !kept.is_empty())?;
        Some(Self { corners: Some(Corners { count: 3 * kept.len(), ..corners }), ..places })
    }

    /// Points or triangles that are drawn.
    pub fn shown(&self) -> usize {
        self.corners.as_ref().map_or(self.count, |c| c.count / 3)
    }

    /// Whether it has triangles.
    pub fn is_mesh(&self) -> bool {
        self.corners.is_some()
    }

    fn places(points: &[[f32; 3]], of: usize) -> Option<Self> {
        let first = points.first()?;
        let (mut low, mut high) = (first.map(f64::from), first.map(f64::from));
        for p in points {
            for k in 0..3 {
                low[k] = low[k].min(p[k].into());
                high[k] = high[k].max(p[k].into());
            }
        }
        let step: [f64; 3] = std::array::from_fn(|k| (high[k] - low[k]) / STEPS);
        let cell = |p: &[f32; 3], k: usize| match step[k] {
            step if step > 0.0 => ((f64::from(p[k]) - low[k]) / step).round() as u16,
            _ => 0,
        };
        let cells = points.iter().flat_map(|p| [0, 1, 2].map(|k| cell(p, k)));
        Some(Self {
            count: points.len(),
            of,
            low,
            step,
            cells: base64(&bytes(cells)),
            corners: None,
            spacing: spacing(points),
            values: vec![],
            focus: focus(points),
        })
    }
}

fn bytes(numbers: impl Iterator<Item = u16>) -> Vec<u8> {
    numbers.flat_map(u16::to_le_bytes).collect()
}

/// The usual distance to a near neighbour, m.
fn spacing(points: &[[f32; 3]]) -> f64 {
    let tree = KdTree::new(points);
    let near = |p: &[f32; 3]| tree.nearest_many(p, NEIGHBOUR, f32::INFINITY).last().copied();
    let every = points.len().div_ceil(ASKED).max(1);
    let mut all: Vec<f32> =
        points.iter().step_by(every).filter_map(near).map(|n| n.squared).collect();
    all.sort_unstable_by(f32::total_cmp);
    all.get(all.len() / 2).map_or(0.0, |squared| f64::from(*squared).sqrt())
}

/// A box around all but the strays.
fn focus(points: &[[f32; 3]]) -> [[f64; 3]; 2] {
    let strays = if points.len() < FEW { 0 } else { (points.len() as f64 * STRAYS) as usize };
    let mut ends = [[0.0; 3]; 2];
    for k in 0..3 {
        let mut along: Vec<f32> = points.iter().map(|p| p[k]).collect();
        let last = along.len() - 1;
        for (end, place) in [strays, last - strays].into_iter().enumerate() {
            ends[end][k] = (*along.select_nth_unstable_by(place, f32::total_cmp).1).into();
        }
    }
    ends
}

/// Larger cubes of space by this factor, until triangles are few enough.
const COARSER: f64 = 1.3;

/// Triangles between vertices that are there; where they are more than `most`, vertices of a small
/// cube of space become one, and triangles that have become edges are dropped.
fn simplified(
    vertices: &[[f32; 3]],
    triangles: &[[u32; 3]],
    most: usize,
) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let is_there =
        |k: &u32| vertices.get(*k as usize).is_some_and(|v| v.iter().all(|x| x.is_finite()));
    let whole: Vec<[u32; 3]> =
        triangles.iter().filter(|t| t.iter().all(is_there)).copied().collect();
    let mut edge = typical_edge(vertices, &whole);
    let mut kept = whole.clone();
    while kept.len() > most {
        edge *= COARSER;
        kept = joined(vertices, &whole, &Cubes::with_edge(vertices, edge));
    }
    renumbered(vertices, &kept)
}

fn typical_edge(vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> f64 {
    let length = |t: &[u32; 3]| {
        let [a, b] = [t[0], t[1]].map(|k| vertices[k as usize].map(f64::from));
        (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
    };
    let every = triangles.len().div_ceil(ASKED).max(1);
    let mut lengths: Vec<f64> = triangles.iter().step_by(every).map(length).collect();
    lengths.sort_unstable_by(f64::total_cmp);
    lengths.get(lengths.len() / 2).copied().unwrap_or(0.0).max(f64::MIN_POSITIVE)
}

fn joined(vertices: &[[f32; 3]], triangles: &[[u32; 3]], cubes: &Cubes) -> Vec<[u32; 3]> {
    let mut middles: BTreeMap<u64, (f64, u32)> = BTreeMap::new();
    for k in triangles.iter().flatten() {
        let (number, off) = cubes.cube(&vertices[*k as usize]);
        let middle = middles.entry(number).or_insert((off, *k));
        if (off, *k) < *middle {
            *middle = (off, *k);
        }
    }
    let joined = |k: u32| middles[&cubes.cube(&vertices[k as usize]).0].1;
    let is_triangle = |[a, b, c]: &[u32; 3]| a != b && b != c && a != c;
    triangles.iter().map(|t| t.map(joined)).filter(is_triangle).collect()
}

/// Without the vertices that no triangle has.
fn renumbered(vertices: &[[f32; 3]], triangles: &[[u32; 3]]) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let mut numbers = vec![u32::MAX; vertices.len()];
    let mut used = vec![];
    let mut number = |k: u32| {
        let slot = &mut numbers[k as usize];
        if *slot == u32::MAX {
            *slot = used.len() as u32;
            used.push(vertices[k as usize]);
        }
        *slot
    };
    let triangles = triangles.iter().map(|t| t.map(&mut number)).collect();
    (used, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of so many steps a side, two triangles each.
    fn square(side: u32) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
        let n = side + 1;
        let vertices = (0..n * n).map(|k| [(k % n) as f32, (k / n) as f32, 1.0]).collect();
        let corner = |k: u32| k / side * n + k % side;
        let both = |k: u32| {
            let a = corner(k);
            [[a, a + 1, a + n], [a + 1, a + n + 1, a + n]]
        };
        (vertices, (0..side * side).flat_map(both).collect())
    }

    #[test]
    fn places_come_back_to_a_part_in_65_thousand_of_the_box() {
        let points = [[0.0, -2.0, 5.0], [1.0, 2.0, 5.0], [0.3, 1.7, 5.0]];
        let packed = Packed::cloud(&points, 9).unwrap();
        assert_eq!((packed.count, packed.low, packed.step[2]), (3, [0.0, -2.0, 5.0], 0.0));
        assert_eq!(packed.cells.len(), 24);
        assert!(packed.step[1] * STEPS - 4.0 < 1e-12);
    }

    #[test]
    fn a_mesh_of_too_many_triangles_keeps_its_shape_with_fewer() {
        let (vertices, triangles) = square(60);
        let (fewer, kept) = simplified(&vertices, &triangles, 1000);
        assert!(kept.len() <= 1000 && kept.len() > 100, "{}", kept.len());
        assert!(kept.iter().flatten().all(|k| (*k as usize) < fewer.len()));
        let area = |[a, b, c]: [u32; 3]| {
            let [a, b, c] = [a, b, c].map(|k| fewer[k as usize]);
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        };
        let whole: f32 = kept.iter().map(|t| area(*t)).sum();
        assert!(whole > 0.9 * 3600.0, "{whole}");
    }

    #[test]
    fn triangles_of_vertices_that_are_not_there_are_left_out() {
        let (vertices, mut triangles) = square(2);
        triangles.push([0, 1, 99]);
        let packed = Packed::mesh(&vertices, &triangles).unwrap();
        assert_eq!((packed.shown(), packed.of), (8, 9));
        assert!(Packed::mesh(&vertices, &[]).is_none());
        assert!(Packed::cloud(&[[f32::NAN; 3]], 9).is_none());
    }
}
