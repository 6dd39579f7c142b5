//! Nearest neighbours among points.
//!
//! A k-d tree whose leaves hold the points themselves, coordinate by coordinate, so that a leaf is
//! searched without a branch. Every inner node halves the longest side of what it holds, at the
//! median; of many points a sample tells both. A query carries its distance from the boxes of the tree
//! along with it (S. Arya and D. Mount, *Algorithms for fast vector quantization*, DCC 1993) and looks into
//! no box that is farther away than what it has found.
//!
//! Points are `f32`, as cameras have them; the distances say which one is nearest, to rounding.

/// Points of a leaf.
const LEAF: usize = 32;
/// Of more points than this, a sample tells axis and median.
const MANY: usize = 400;
/// Points of the sample.
const SAMPLE: usize = 51;
/// Deeper than this, halves are exact: whatever the points, the tree stays below the most levels.
const SAMPLED_LEVELS: usize = 24;
const MOST_LEVELS: usize = 64;
/// Marks a leaf among the children.
const IS_LEAF: u32 = 1 << 31;

/// A point and its place in the input.
#[derive(Clone, Copy)]
struct Entry {
    at: [f32; 3],
    index: u32,
}

/// Left of `split` is nothing larger, right of it nothing smaller.
#[derive(Clone, Copy)]
struct Node {
    split: f32,
    axis: u32,
    children: [u32; 2],
}

/// Points by coordinate; the last ones may be missing, at an infinite distance.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Leaf {
    at: [[f32; LEAF]; 3],
    index: [u32; LEAF],
}

/// Points in an order in which near ones are found fast.
#[derive(Clone)]
pub struct KdTree {
    nodes: Vec<Node>,
    leaves: Vec<Leaf>,
    root: u32,
}

/// A point that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbour {
    /// Its place in the input.
    pub index: u32,
    /// Squared distance.
    pub squared: f32,
}

impl KdTree {
    /// Of all finite points; the others are left out.
    pub fn new(points: &[[f32; 3]]) -> Self {
        let finite = |(index, at): (usize, &[f32; 3])| {
            at.iter().all(|x| x.is_finite()).then_some(Entry { at: *at, index: index as u32 })
        };
        let mut entries: Vec<Entry> = points.iter().enumerate().filter_map(finite).collect();
        let leaves = entries.len() / (LEAF / 2) + 1;
        let mut tree =
            Self { nodes: Vec::with_capacity(leaves), leaves: Vec::with_capacity(leaves), root: 0 };
        tree.root = tree.build(&mut entries, 0);
        tree
    }

    fn build(&mut self, entries: &mut [Entry], level: usize) -> u32 {
        if entries.len() <= LEAF {
            self.leaves.push(Leaf::new(entries));
            return (self.leaves.len() - 1) as u32 | IS_LEAF;
        }
        let (axis, split, middle) = halve(entries, level);
        let at = self.nodes.len();
        self.nodes.push(Node { split, axis: axis as u32, children: [0; 2] });
        let (left, right) = entries.split_at_mut(middle);
        let children = [self.build(left, level + 1), self.build(right, level + 1)];
        self.nodes[at].children = children;
        at as u32
    }

    /// The nearest point closer than `within`.
    #[inline]
    pub fn nearest(&self, to: &[f32; 3], within: f32) -> Option<Neighbour> {
        let mut found = Neighbour { index: u32::MAX, squared: within * within };
        self.search(to, &mut found);
        (found.index != u32::MAX).then_some(found)
    }

    /// The `count` nearest points closer than `within`, nearest first.
    pub fn nearest_many(&self, to: &[f32; 3], count: usize, within: f32) -> Vec<Neighbour> {
        if count == 0 {
            return vec![];
        }
        let mut found = Several { all: Vec::with_capacity(count), count, limit: within * within };
        self.search(to, &mut found);
        found.all
    }

    #[inline]
    fn search(&self, to: &[f32; 3], found: &mut impl Found) {
        let mut waiting = [(0u32, 0.0f32, [0.0f32; 3]); MOST_LEVELS];
        let mut count = 0;
        let (mut child, mut squared, mut off) = (self.root, 0.0f32, [0.0f32; 3]);
        loop {
            while child & IS_LEAF == 0 {
                let node = &self.nodes[child as usize];
                let axis = (node.axis & 3) as usize % 3;
                let beyond = to[axis] - node.split;
                let right = usize::from(beyond > 0.0);
                let farther = squared - off[axis] * off[axis] + beyond * beyond;
                if farther < found.limit() {
                    let mut other = off;
                    other[axis] = beyond;
                    waiting[count] = (node.children[1 - right], farther, other);
                    count += 1;
                }
                child = node.children[right];
            }
            found.look(&self.leaves[(child & !IS_LEAF) as usize], to);
            loop {
                if count == 0 {
                    return;
                }
                count -= 1;
                if waiting[count].1 < found.limit() {
                    (child, squared, off) = waiting[count];
                    break;
                }
            }
        }
    }
}

impl Leaf {
    fn new(entries: &[Entry]) -> Self {
        let mut leaf = Self { at: [[f32::INFINITY; LEAF]; 3], index: [u32::MAX; LEAF] };
        for (k, entry) in entries.iter().enumerate() {
            (0..3).for_each(|axis| leaf.at[axis][k] = entry.at[axis]);
            leaf.index[k] = entry.index;
        }
        leaf
    }

    #[inline(always)]
    fn squared(&self, to: &[f32; 3]) -> [f32; LEAF] {
        let mut squared = [0.0; LEAF];
        for k in 0..LEAF {
            let (x, y, z) = (self.at[0][k] - to[0], self.at[1][k] - to[1], self.at[2][k] - to[2]);
            squared[k] = x * x + y * y + z * z;
        }
        squared
    }
}

/// What a query keeps of the leaves it comes to.
trait Found {
    /// Only points closer than this are of use, squared.
    fn limit(&self) -> f32;
    fn look(&mut self, leaf: &Leaf, to: &[f32; 3]);
}

impl Found for Neighbour {
    #[inline(always)]
    fn limit(&self) -> f32 {
        self.squared
    }

    #[inline(always)]
    fn look(&mut self, leaf: &Leaf, to: &[f32; 3]) {
        let squared = leaf.squared(to);
        let mut least = squared;
        let mut width = LEAF / 2;
        while width > 0 {
            for k in 0..width {
                least[k] = if least[k] < least[k + width] { least[k] } else { least[k + width] };
            }
            width /= 2;
        }
        if least[0] < self.squared {
            let at = squared.iter().position(|s| *s == least[0]).unwrap_or(0);
            *self = Neighbour { index: leaf.index[at], squared: least[0] };
        }
    }
}

struct Several {
    all: Vec<Neighbour>,
    count: usize,
    limit: f32,
}

impl Found for Several {
    fn limit(&self) -> f32 {
        self.limit
    }

    fn look(&mut self, leaf: &Leaf, to: &[f32; 3]) {
        for (squared, index) in leaf.squared(to).into_iter().zip(leaf.index) {
            if squared < self.limit {
                let place = self.all.partition_point(|other| other.squared <= squared);
                self.all.truncate(self.count - 1);
                self.all.insert(place, Neighbour { index, squared });
                if self.all.len() == self.count {
                    self.limit = self.all[self.count - 1].squared;
                }
            }
        }
    }
}

/// Axis and place of a split, and how many entries are on its left.
fn halve(entries: &mut [Entry], level: usize) -> (usize, f32, usize) {
    if entries.len() > MANY && level < SAMPLED_LEVELS {
        let step = entries.len() / SAMPLE;
        let sample: [[f32; 3]; SAMPLE] = std::array::from_fn(|k| entries[k * step + step / 2].at);
        let axis = widest(sample.iter());
        let mut values = sample.map(|at| at[axis]);
        values.sort_unstable_by(f32::total_cmp);
        let split = values[SAMPLE / 2];
        let middle = partition(entries, axis, split);
        if middle > entries.len() / 8 && middle < entries.len() - entries.len() / 8 {
            return (axis, split, middle);
        }
    }
    let axis = widest(entries.iter().map(|e| &e.at));
    let middle = entries.len() / 2;
    let by = |a: &Entry, b: &Entry| a.at[axis].total_cmp(&b.at[axis]);
    let split = entries.select_nth_unstable_by(middle, by).1.at[axis];
    (axis, split, middle)
}

/// The axis along which points are spread most.
fn widest<'a>(points: impl Iterator<Item = &'a [f32; 3]>) -> usize {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for at in points {
        for axis in 0..3 {
            low[axis] = if at[axis] < low[axis] { at[axis] } else { low[axis] };
            high[axis] = if at[axis] > high[axis] { at[axis] } else { high[axis] };
        }
    }
    let spread = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
    let larger = usize::from(spread[1] > spread[0]);
    if spread[2] > spread[larger] { 2 } else { larger }
}

/// Puts entries below `split` first; returns their number.
fn partition(entries: &mut [Entry], axis: usize, split: f32) -> usize {
    let mut below = 0;
    for k in 0..entries.len() {
        // known before anything moves: no entry has to wait for the one before
        let is_below = entries[k].at[axis] < split;
        entries.swap(k, below);
        below += usize::from(is_below);
    }
    below
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn squared(a: &[f32; 3], b: &[f32; 3]) -> f32 {
        (0..3).map(|k| (a[k] - b[k]).powi(2)).sum()
    }

    /// Points of a surface, with noise; some at the same place, some missing.
    fn surface(random: &mut Random, count: usize) -> Vec<[f32; 3]> {
        let point = |k: usize| {
            let (x, y) = (random.between(-0.3, 0.3), random.between(-0.2, 0.2));
            let z = 0.8 + 0.2 * (7.0 * x).sin() * (5.0 * y).cos() + 5e-4 * random.normal();
            match k % 10 {
                3 => [0.1, 0.05, 0.8],
                7 => [f32::NAN; 3],
                _ => [x as f32, y as f32, z as f32],
            }
        };
        (0..count).map(point).collect()
    }

    fn by_trying_all(points: &[[f32; 3]], to: &[f32; 3], within: f32) -> Vec<f32> {
        let near = |d: &f32| *d < within * within;
        let mut all: Vec<f32> = points.iter().map(|p| squared(p, to)).filter(near).collect();
        all.sort_by(f32::total_cmp);
        all
    }

    #[test]
    fn the_nearest_points_are_those_that_trying_all_finds() {
        let mut random = Random::new(1);
        for count in [0, 1, 2, 15, 16, 17, 100, 401, 5000] {
            let points = surface(&mut random, count);
            let tree = KdTree::new(&points);
            for _ in 0..200 {
                let to = std::array::from_fn(|k| {
                    (random.between(-0.4, 0.4) + if k == 2 { 0.8 } else { 0.0 }) as f32
                });
                for within in [f32::INFINITY, 0.05, 1e-3] {
                    let expected = by_trying_all(&points, &to, within);
                    let found = tree.nearest(&to, within);
                    assert_eq!(found.map(|n| n.squared), expected.first().copied());
                    if let Some(found) = found {
                        assert_eq!(squared(&points[found.index as usize], &to), found.squared);
                    }
                    let many = tree.nearest_many(&to, 7, within);
                    let lengths: Vec<f32> = many.iter().map(|n| n.squared).collect();
                    assert_eq!(lengths, expected[..expected.len().min(7)]);
                    assert!(
                        many.iter().all(|n| squared(&points[n.index as usize], &to) == n.squared)
                    );
                }
            }
        }
    }

    #[test]
    fn points_at_one_place_and_on_a_line_make_a_tree() {
        let one = vec![[1.0, 2.0, 3.0]; 100_000];
        assert_eq!(KdTree::new(&one).nearest(&[1.0, 2.0, 3.5], 1.0).unwrap().squared, 0.25);
        assert_eq!(KdTree::new(&one).nearest_many(&[1.0, 2.0, 3.5], 20, 1.0).len(), 20);
        let line: Vec<[f32; 3]> = (0..50_000u16).map(|k| [(k as f32).powi(2), 0.0, 0.0]).collect();
        assert_eq!(KdTree::new(&line).nearest(&[100.4, 0.0, 0.0], 1.0).unwrap().index, 10);
    }

    #[test]
    fn what_is_not_finite_is_near_nothing() {
        let tree = KdTree::new(&[[f32::NAN; 3], [f32::INFINITY, 0.0, 0.0]]);
        assert!(tree.nearest(&[0.0; 3], f32::INFINITY).is_none());
        let tree = KdTree::new(&[[0.0; 3]]);
        assert!(tree.nearest(&[f32::NAN, 0.0, 0.0], f32::INFINITY).is_none());
        assert!(tree.nearest_many(&[0.0; 3], 0, 1.0).is_empty());
    }
}
