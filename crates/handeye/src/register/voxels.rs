//! A cloud of points in any order, cut into cubes.
//!
//! Cubes are as large as it takes to hold some points of a surface each. Within its cube a point is
//! counted in whole steps of a 32768th of the edge: sums of whole numbers are the same in whatever order
//! the points come, and are carried over to a neighbouring cube without an error.

use nalgebra::Vector3;

use super::patch::{Patch, Sums};
use crate::math::parallel;

/// Steps along the edge of a cube, as a power of two.
const STEP_BITS: u32 = 15;
/// Steps along the edge of a cube.
const STEPS: i64 = 1 << STEP_BITS;
/// Cubes along an axis, as a power of two.
const CUBE_BITS: u32 = 21;
/// Points that tell the density of all.
const SAMPLE: usize = 1 << 14;
/// Points of the sample in a cube in which they are counted.
const COUNTED: f64 = 8.0;
/// Rounds in which their size is found.
const ROUNDS: usize = 4;
/// One in so many points, beyond each end of an axis, does not count for its length; none where the others lie at one
/// place.
const BEYOND: [usize; 2] = [20, usize::MAX];
/// Cubes that a thread works on at once.
const CHUNK: usize = 4096;
/// Cubes that are no neighbours.
const NOWHERE: u32 = u32::MAX;

/// Sums over the points of a cube, in steps from its middle.
#[derive(Debug, Clone, Copy, Default)]
struct Cube {
    key: u64,
    count: i64,
    first: [i64; 3],
    second: [i64; 6],
}

impl Cube {
    #[inline(always)]
    fn add(&mut self, steps: [i32; 3]) {
        let [x, y, z] = steps.map(i64::from);
        self.count += 1;
        let second = [x * x, x * y, x * z, y * y, y * z, z * z];
        (0..3).for_each(|k| self.first[k] += [x, y, z][k]);
        (0..6).for_each(|k| self.second[k] += second[k]);
    }

    /// Adds the points of a cube that lies `by` steps away.
    #[inline(always)]
    fn add_all(&mut self, other: &Self, by: [i64; 3]) {
        let (n, s) = (other.count, &other.first);
        self.count += n;
        (0..3).for_each(|k| self.first[k] += s[k] + n * by[k]);
        let mut k = 0;
        for a in 0..3 {
            for b in a..3 {
                self.second[k] += other.second[k] + by[a] * s[b] + by[b] * s[a] + n * by[a] * by[b];
                k += 1;
            }
        }
    }
}

/// Which cube a point is in.
#[derive(Debug, Clone, Copy)]
struct Lattice {
    origin: [f64; 3],
    /// Steps of a metre.
    per_m: f64,
}

impl Lattice {
    /// Key of the cube, and steps from its middle; `None` where it is not finite or too far away.
    #[inline(always)]
    fn place(&self, point: &[f32; 3]) -> Option<(u64, [i32; 3])> {
        const ALL: f64 = (1u64 << (STEP_BITS + CUBE_BITS)) as f64;
        /// Added to a lesser number, it leaves its whole part in the last bits.
        const WHOLE: f64 = (1u64 << 52) as f64;
        let (mut key, mut steps, mut inside) = (0, [0; 3], true);
        for k in (0..3).rev() {
            let along = (f64::from(point[k]) - self.origin[k]) * self.per_m + 0.5 * ALL;
            inside &= (0.0..ALL - 1.0).contains(&along);
            let whole = (along + WHOLE).to_bits() & ((1 << (STEP_BITS + CUBE_BITS)) - 1);
            key = key << CUBE_BITS | whole >> STEP_BITS;
            steps[k] = (whole & (STEPS as u64 - 1)) as i32 - STEPS as i32 / 2;
        }
        inside.then_some((key, steps))
    }

    /// From steps about the middle of a cube to metres.
    fn metres(&self, key: u64, steps: &Vector3<f64>) -> Vector3<f64> {
        let half = f64::from(1 << (CUBE_BITS - 1));
        Vector3::from_fn(|k, _| {
            let cube = (key >> (CUBE_BITS * k as u32) & ((1 << CUBE_BITS) - 1)) as f64 - half;
            self.origin[k] + ((cube + 0.5) * STEPS as f64 + steps[k]) / self.per_m
        })
    }
}

/// All cubes that hold points, sorted by their keys.
#[derive(Debug, Clone)]
pub(crate) struct Voxels {
    lattice: Lattice,
    cubes: Vec<Cube>,
}

impl Voxels {
    /// With about so many points in a cube. `None` of fewer than three finite points, and of points at one
    /// place.
    pub fn of(points: &[[f32; 3]], held: f64, threads: usize) -> Option<Self> {
        let lattice = lattice(points, held)?;
        let share = points.len().div_ceil(threads.max(1)).max(1);
        let parts = parallel::in_order(points.len().div_ceil(share), threads, |k| {
            let mut table = Table::new(lattice);
            table.add(&points[share * k..points.len().min(share * (k + 1))]);
            table.sorted()
        });
        Some(Self { lattice, cubes: parts.into_iter().reduce(merged)? })
    }

    /// For each cube the plane through its points and those of its 26 neighbours, about the mean of its own;
    /// `None` where there are fewer than `fewest`, or no plane.
    pub(crate) fn patches(&self, fewest: f64, threads: usize) -> Vec<Option<Patch>> {
        let count = self.cubes.len();
        let parts = parallel::in_order(count.div_ceil(CHUNK), threads, |k| {
            let range = CHUNK * k..count.min(CHUNK * (k + 1));
            let mut rows = Rows::at(&self.cubes, self.cubes[range.start].key);
            range
                .map(|k| self.patch(k, &rows.around(self.cubes[k].key), fewest))
                .collect::<Vec<_>>()
        });
        parts.concat()
    }

    fn patch(&self, k: usize, around: &[[u32; 3]; 9], fewest: f64) -> Option<Patch> {
        let own = &self.cubes[k];
        let mut window = Cube::default();
        for (row, cubes) in around.iter().enumerate() {
            for (x, other) in cubes.iter().enumerate() {
                if *other != NOWHERE {
                    let by = [x, row % 3, row / 3].map(|step| (step as i64 - 1) * STEPS);
                    window.add_all(&self.cubes[*other as usize], by);
                }
            }
        }
        if (window.count as f64) < fewest {
            return None;
        }
        let sums = Sums {
            count: window.count as f64,
            first: window.first.map(|s| s as f64),
            second: window.second.map(|s| s as f64),
        };
        let held = own.count as f64;
        let middle = Vector3::from(own.first.map(|s| s as f64)) / held;
        let patch = Patch::of(&sums)?.about(&middle, held);
        let squared = self.lattice.per_m * self.lattice.per_m;
        Some(Patch {
            mean: self.lattice.metres(own.key, &patch.mean),
            across: patch.across / squared,
            variance: patch.variance / squared,
            along: patch.along / squared,
            ..patch
        })
    }
}

/// A place beside each cube in turn, in nine rows around it.
struct Rows<'a> {
    cubes: &'a [Cube],
    /// The first cube of each row that is not before the place.
    next: [usize; 9],
}

impl<'a> Rows<'a> {
    fn at(cubes: &'a [Cube], key: u64) -> Self {
        let next = std::array::from_fn(|row| {
            let first = Self::first(key, row);
            cubes.partition_point(|cube| cube.key < first)
        });
        Self { cubes, next }
    }

    /// The key before the middle of a row.
    #[inline(always)]
    fn first(key: u64, row: usize) -> u64 {
        let step = |by: usize, axis: u32| (by as u64).wrapping_sub(1) << (CUBE_BITS * axis);
        // keys at the very rim wrap around: nothing is there
        key.wrapping_add(step(row % 3, 1)).wrapping_add(step(row / 3, 2)).wrapping_sub(1)
    }

    /// Cubes around a key, which must not be less than that before.
    #[inline(always)]
    fn around(&mut self, key: u64) -> [[u32; 3]; 9] {
        let mut around = [[NOWHERE; 3]; 9];
        for (row, cubes) in around.iter_mut().enumerate() {
            let first = Self::first(key, row);
            let next = &mut self.next[row];
            while self.cubes.get(*next).is_some_and(|cube| cube.key < first) {
                *next += 1;
            }
            for (k, cube) in self.cubes[*next..].iter().take(3).enumerate() {
                let place = cube.key.wrapping_sub(first);
                if place < 3 {
                    cubes[place as usize] = (*next + k) as u32;
                }
            }
        }
        around
    }
}

/// Cubes in the order in which they came, found by their keys.
struct Table {
    lattice: Lattice,
    cubes: Vec<Cube>,
    /// Keys and numbers of cubes, at places that their keys tell.
    slots: Vec<(u64, u32)>,
}

/// Points that are looked up before the first of them is added: memory answers all at once.
const BATCH: usize = 32;

impl Table {
    fn new(lattice: Lattice) -> Self {
        Self { lattice, cubes: vec![], slots: vec![(0, NOWHERE); 1 << 10] }
    }

    fn add(&mut self, points: &[[f32; 3]]) {
        let mut last = (u64::MAX, 0);
        let mut found = [(0u32, [0i32; 3]); BATCH];
        for batch in points.chunks(BATCH) {
            let mut count = 0;
            for point in batch {
                let Some((key, steps)) = self.lattice.place(point) else { continue };
                if key != last.0 {
                    last = (key, self.find(key));
                }
                found[count] = (last.1, steps);
                count += 1;
            }
            for (number, steps) in &found[..count] {
                self.cubes[*number as usize].add(*steps);
            }
        }
    }

    #[inline(always)]
    fn find(&mut self, key: u64) -> u32 {
        let slot = self.slot(key);
        let found = self.slots[slot].1;
        if found != NOWHERE {
            return found;
        }
        let number = self.cubes.len() as u32;
        self.slots[slot] = (key, number);
        self.cubes.push(Cube { key, ..Cube::default() });
        if 2 * self.cubes.len() > self.slots.len() {
            self.grow();
        }
        number
    }

    /// Where a cube's number is, or belongs.
    #[inline(always)]
    fn slot(&self, key: u64) -> usize {
        let mask = self.slots.len() - 1;
        let mut slot = (scrambled(key) >> 32) as usize & mask;
        while self.slots[slot].1 != NOWHERE && self.slots[slot].0 != key {
            slot = (slot + 1) & mask;
        }
        slot
    }

    #[cold]
    fn grow(&mut self) {
        self.slots = vec![(0, NOWHERE); 4 * self.slots.len()];
        for (number, cube) in self.cubes.iter().enumerate() {
            let slot = self.slot(cube.key);
            self.slots[slot] = (cube.key, number as u32);
        }
    }

    fn sorted(self) -> Vec<Cube> {
        let mut order: Vec<(u64, u32)> =
            self.cubes.iter().enumerate().map(|(k, cube)| (cube.key, k as u32)).collect();
        order.sort_unstable();
        order.into_iter().map(|(_, k)| self.cubes[k as usize]).collect()
    }
}

/// Two sorted lists in one.
fn merged(one: Vec<Cube>, other: Vec<Cube>) -> Vec<Cube> {
    let mut all = Vec::with_capacity(one.len().max(other.len()));
    let (mut one, mut other) = (one.into_iter().peekable(), other.into_iter().peekable());
    while let (Some(a), Some(b)) = (one.peek(), other.peek()) {
        match a.key.cmp(&b.key) {
            std::cmp::Ordering::Less => all.extend(one.next()),
            std::cmp::Ordering::Greater => all.extend(other.next()),
            std::cmp::Ordering::Equal => {
                let mut sum = *a;
                sum.add_all(b, [0; 3]);
                all.push(sum);
                one.next();
                other.next();
            }
        }
    }
    all.extend(one);
    all.extend(other);
    all
}

/// Spreads a number over all bits.
///
/// S. Vigna's variant 13 of D. Stafford's mixers.
#[inline(always)]
fn scrambled(key: u64) -> u64 {
    let key = (key ^ key >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let key = (key ^ key >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    key ^ key >> 31
}

/// With cubes that hold about so many points. A sample tells the size of the surface; whether a point
/// belongs to it, its coordinates decide and not its place in the list.
fn lattice(points: &[[f32; 3]], held: f64) -> Option<Lattice> {
    let bits = (points.len() / SAMPLE).max(1).ilog2();
    let (mut sample, mut finite) = (Vec::with_capacity(4 * SAMPLE), 0.0);
    for point in points {
        let [x, y, z] = point.map(f32::to_bits);
        // not finite either where one of the three is not
        let is_finite = (point[0] + point[1] + point[2]).is_finite();
        // nor is a pixel without depth, which some write as zeros
        let is_point = is_finite && *point != [0.0; 3];
        finite += f64::from(u8::from(is_point));
        let mixed = (x ^ y.rotate_left(11) ^ z.rotate_left(21)).wrapping_mul(0x9e37_79b9);
        if is_point && mixed.unbounded_shr(32 - bits) == 0 {
            sample.push(*point);
        }
    }
    if sample.len() < 3 {
        return None;
    }
    let extents = BEYOND.map(|beyond| extent(&sample, beyond));
    let (origin, longest) = extents.into_iter().find(|(_, longest)| *longest > 0.0)?;
    let mut edge = longest / 64.0;
    for _ in 0..ROUNDS {
        let cubes = occupied(&sample, &Lattice { origin, per_m: STEPS as f64 / edge });
        edge *= (COUNTED * cubes / sample.len() as f64).sqrt();
    }
    edge *= (held / COUNTED * sample.len() as f64 / finite).sqrt();
    Some(Lattice { origin, per_m: STEPS as f64 / edge })
}

/// Middle and longest side of a box without one in so many points beyond each side.
fn extent(points: &[[f32; 3]], one_in: usize) -> ([f64; 3], f64) {
    let beyond = points.len() / one_in;
    let sides: [(f64, f64); 3] = std::array::from_fn(|axis| {
        let mut values: Vec<f32> = points.iter().map(|p| p[axis]).collect();
        let high = values.len() - 1 - beyond;
        let mut end = |k| f64::from(*values.select_nth_unstable_by(k, f32::total_cmp).1);
        (end(beyond), end(high))
    });
    let length = sides.map(|(low, high)| high - low);
    (sides.map(|(low, high)| 0.5 * (low + high)), length.into_iter().fold(0.0, f64::max))
}

fn occupied(points: &[[f32; 3]], lattice: &Lattice) -> f64 {
    let mut keys: Vec<u64> = points.iter().filter_map(|p| Some(lattice.place(p)?.0)).collect();
    keys.sort_unstable();
    // what is alone is no surface
    keys.chunk_by(|a, b| a == b).filter(|cube| cube.len() > 1).count().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_written_as_zeros_do_not_hide_the_others() {
        let at = |k: usize| [(k % 100) as f32 * 1e-3, (k / 100) as f32 * 1e-3, 0.5];
        let points: Vec<[f32; 3]> = (0..10_000).map(at).chain(vec![[0.0; 3]; 300_000]).collect();
        let voxels = Voxels::of(&points, 5.0, 1).unwrap();
        assert!(voxels.cubes.len() > 500, "{}", voxels.cubes.len());
    }
}
