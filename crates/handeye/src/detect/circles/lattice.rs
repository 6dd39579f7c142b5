//! Which of the patches form a grid, and which circle of the target each one is.
//!
//! From a patch between two pairs of opposite neighbours a lattice grows, neighbour by neighbour,
//! each place predicted from the ones around it. Its two steps are a basis of the lattice, but seen
//! at an angle not always the board's rows and columns: of all changes of basis the one counts that
//! makes the labels fill the board.

use std::collections::{BTreeMap, VecDeque};

use nalgebra::Vector2;

use super::blobs::Blob;
use crate::{
    TargetModel,
    model::target::look::{Circles, Look},
};

/// Column and row in some basis.
pub(super) type Label = (i32, i32);

/// Patches by label.
#[derive(Debug, Clone, Default)]
pub(super) struct Lattice {
    pub blobs: BTreeMap<Label, usize>,
    /// Labels of patches that are larger than their neighbours.
    pub larger: Vec<Label>,
}

/// Neighbours of a patch that are looked at.
const NEIGHBOURS: usize = 16;
/// Sizes (products of the half axes) of neighbouring equal circles differ by this factor at most.
const ALIKE: f64 = 2.0;
/// The larger circle's size over the one that its neighbours lead to expect, at least ...
const LARGER: f64 = 1.5;
/// ... and over a neighbour's, at most.
const LARGEST: f64 = 8.0;
/// A neighbour may be this far from where it is expected, over the shorter of the two steps.
const ASTRAY: f64 = 0.3;
/// Steps of a basis enclose an angle with at least this sine.
const LEAST_SINE: f64 = 0.4;
/// A lattice of fewer patches is none.
const FEWEST: usize = 4;

/// All lattices, the largest first.
pub(super) fn lattices(blobs: &[Blob], with_larger: bool) -> Vec<Lattice> {
    let field = Field::new(blobs);
    let mut taken = vec![false; blobs.len()];
    let mut all = vec![];
    for seed in 0..blobs.len() {
        if taken[seed] {
            continue;
        }
        let Some(steps) = field.steps(seed) else { continue };
        let lattice = field.grown(seed, steps, with_larger);
        if lattice.blobs.len() >= FEWEST {
            lattice.blobs.values().for_each(|&b| taken[b] = true);
            all.push(lattice);
        }
    }
    all.sort_by_key(|l| std::cmp::Reverse(l.blobs.len()));
    all
}

/// Patches and their neighbours.
struct Field<'a> {
    blobs: &'a [Blob],
    neighbours: Vec<Vec<usize>>,
}

impl<'a> Field<'a> {
    fn new(blobs: &'a [Blob]) -> Self {
        let comparable = |a: &Blob, b: &Blob| {
            let ratio = b.size() / a.size();
            a.dark == b.dark && ratio < LARGEST && ratio * LARGEST > 1.0
        };
        let near = |k: usize| {
            let others = (0..blobs.len()).filter(|&i| i != k && comparable(&blobs[k], &blobs[i]));
            let mut all: Vec<(f64, usize)> =
                others.map(|i| ((blobs[i].centre - blobs[k].centre).norm_squared(), i)).collect();
            if all.len() > NEIGHBOURS {
                all.select_nth_unstable_by(NEIGHBOURS - 1, |a, b| {
                    a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
                });
                all.truncate(NEIGHBOURS);
            }
            all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            all.into_iter().map(|(_, i)| i).collect()
        };
        Self { blobs, neighbours: (0..blobs.len()).map(near).collect() }
    }

    fn at(&self, k: usize) -> Vector2<f64> {
        self.blobs[k].centre
    }

    fn ratio(&self, of: usize, to: usize) -> f64 {
        self.blobs[of].size() / self.blobs[to].size()
    }

    fn alike(&self, a: usize, b: usize) -> bool {
        let ratio = self.ratio(a, b);
        ratio < ALIKE && ratio * ALIKE > 1.0
    }

    /// The two shortest independent steps from a patch that lead to an equal one both ways.
    fn steps(&self, seed: usize) -> Option<(Vector2<f64>, Vector2<f64>)> {
        let near: Vec<usize> =
            self.neighbours[seed].iter().copied().filter(|&k| self.alike(seed, k)).collect();
        let step = |k: usize| self.at(k) - self.at(seed);
        let both_ways = |k: &usize| {
            let u = step(*k);
            near.iter().any(|&other| (step(other) + u).norm() < ASTRAY * u.norm())
        };
        let mut steps = near.iter().copied().filter(both_ways).map(step);
        let u = steps.next()?;
        let v = steps.find(|v| u.perp(v).abs() > LEAST_SINE * u.norm() * v.norm())?;
        Some(if u.perp(&v) > 0.0 { (u, v) } else { (u, -v) })
    }

    fn grown(
        &self,
        seed: usize,
        steps: (Vector2<f64>, Vector2<f64>),
        with_larger: bool,
    ) -> Lattice {
        let mut lattice = Lattice { blobs: BTreeMap::from([((0, 0), seed)]), larger: vec![] };
        let mut used = vec![false; self.blobs.len()];
        used[seed] = true;
        let mut open = VecDeque::from([(0, 0)]);
        while let Some(from) = open.pop_front() {
            for d in DIRECTIONS {
                let label = (from.0 + d.0, from.1 + d.1);
                if lattice.blobs.contains_key(&label) {
                    continue;
                }
                let Some(k) = self.next(&lattice, (from, d), steps, &used) else { continue };
                let alike = self.alike(k, lattice.blobs[&from]);
                if !(alike || with_larger) {
                    continue;
                }
                used[k] = true;
                lattice.blobs.insert(label, k);
                if alike {
                    open.push_back(label);
                }
            }
        }
        if with_larger {
            let labels = lattice.blobs.keys().copied();
            lattice.larger = labels.filter(|l| self.is_larger(&lattice, *l)).collect();
        }
        lattice
    }

    /// The patch one step from a label: of the same size or larger.
    fn next(
        &self,
        lattice: &Lattice,
        (from, d): (Label, Label),
        steps: (Vector2<f64>, Vector2<f64>),
        used: &[bool],
    ) -> Option<usize> {
        let here = *lattice.blobs.get(&from)?;
        let there = self.predicted(lattice, from, d, steps);
        let step = (there - self.at(here)).norm();
        let off = |k: &usize| (self.at(*k) - there).norm();
        let free = self.neighbours[here].iter().copied().filter(|&k| !used[k]);
        let k = free.min_by(|a, b| off(a).total_cmp(&off(b)))?;
        let near = off(&k) < ASTRAY * step.min(self.shorter_step(lattice, from, steps));
        let size = self.alike(k, here) || (ALIKE..LARGEST).contains(&self.ratio(k, here));
        (near && size).then_some(k)
    }

    /// Whether a patch is larger than the two before it lead to expect: perspective changes sizes,
    /// but step by step.
    fn is_larger(&self, lattice: &Lattice, label: Label) -> bool {
        let at = |d: Label, n: i32| lattice.blobs.get(&(label.0 - n * d.0, label.1 - n * d.1));
        let beyond = DIRECTIONS.iter().filter_map(|&d| {
            let (k, one, two) = (*at(d, 0)?, *at(d, 1)?, *at(d, 2)?);
            Some(self.ratio(k, one) / self.ratio(one, two))
        });
        let least = beyond.fold(f64::INFINITY, f64::min);
        least.is_finite() && least > LARGER
    }

    fn shorter_step(
        &self,
        lattice: &Lattice,
        at: Label,
        steps: (Vector2<f64>, Vector2<f64>),
    ) -> f64 {
        let here = lattice.blobs.get(&at).map(|&k| self.at(k));
        let around = DIRECTIONS.iter().filter_map(|d| {
            let other = lattice.blobs.get(&(at.0 + d.0, at.1 + d.1))?;
            Some((self.at(*other) - here?).norm())
        });
        around.fold(f64::INFINITY, f64::min).min(2.0 * steps.0.norm().max(steps.1.norm()))
    }

    /// Where a label's patch is expected: in line with the two before it, or else the mean of what
    /// the one before and the rows beside say.
    fn predicted(
        &self,
        lattice: &Lattice,
        from: Label,
        d: Label,
        steps: (Vector2<f64>, Vector2<f64>),
    ) -> Vector2<f64> {
        let at = |i: i32, j: i32| {
            // i steps on from the label, j steps aside
            let label = (from.0 + i * d.0 + j * d.1, from.1 + i * d.1 + j * d.0);
            lattice.blobs.get(&label).map(|&k| self.at(k))
        };
        let here = at(0, 0).unwrap_or_default();
        let mut guesses = vec![];
        if let Some(behind) = at(-1, 0) {
            let last = here - behind;
            if let Some(before) = at(-2, 0) {
                return here + last * growth((behind - before).norm(), last.norm());
            }
            guesses.push(here + last);
        }
        for side in [1, -1] {
            if let (Some(beside), Some(ahead)) = (at(0, side), at(1, side)) {
                guesses.push(here + ahead - beside);
            }
        }
        if guesses.is_empty() {
            return here + steps.0 * f64::from(d.0) + steps.1 * f64::from(d.1);
        }
        guesses.iter().sum::<Vector2<f64>>() / guesses.len() as f64
    }
}

/// The next step over the last one, of four equidistant points seen in perspective: their cross
/// ratio is 4/3.
fn growth(before: f64, last: f64) -> f64 {
    let next = (before + last) / (3.0 * before - last);
    if next.is_finite() && next > 0.0 { next.clamp(0.5, 2.0) } else { 2.0 }
}

const DIRECTIONS: [Label; 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

// ---------------------------------------------------------------- the board's own labels

/// Entries of a change of basis up to this; a board at 75 degrees needs 2.
const LARGEST_ENTRY: i32 = 3;
/// Share of the circles that must be in the lattice; the others are looked for where they belong.
const LEAST_SHARE: f64 = 0.8;
/// Outliers beside a board, over its circles, at most: more are a board of another size ...
const MOST_OUTLIERS: f64 = 0.15;
/// ... or as many as these, beside a small board.
const FEW_OUTLIERS: f64 = 3.0;
/// Share of the circles of a board with a larger one.
const LEAST_SHARE_WITH_LARGER: f64 = 0.5;

/// The circles' places on a board, as integers.
#[derive(Debug, Clone, Copy)]
pub(super) struct Board {
    columns: i32,
    rows: i32,
    kind: Circles,
}

impl Board {
    /// Of a grid of circles; `None` for other targets.
    pub fn of(target: &TargetModel) -> Option<Self> {
        let kind = match target.look() {
            Look::Circles(circles) => circles,
            Look::Squares
            | Look::MarkedSquares(_)
            | Look::Tag { .. }
            | Look::Tags(_)
            | Look::Ball => return None,
        };
        let (columns, rows) = target.grid();
        Some(Self { columns: columns as i32, rows: rows as i32, kind })
    }

    /// Whether one circle is larger.
    pub(crate) fn has_larger(&self) -> bool {
        self.kind == Circles::WithLarger
    }

    /// The larger circle's id.
    pub fn larger(&self) -> Option<u32> {
        self.has_larger().then(|| ((self.rows - 1) * self.columns) as u32)
    }

    /// Every way in which a lattice is the board: ids of the patches.
    pub fn labelled(&self, lattice: &Lattice) -> Vec<BTreeMap<u32, usize>> {
        changes_of_basis().filter_map(|m| self.labelled_by(lattice, m)).collect()
    }

    fn labelled_by(&self, lattice: &Lattice, m: [i32; 4]) -> Option<BTreeMap<u32, usize>> {
        let places: Vec<(Label, usize)> =
            lattice.blobs.iter().map(|(l, &blob)| (self.place(m, *l), blob)).collect();
        let (low, high) = bounds(places.iter().map(|p| p.0))?;
        let (wide, tall) = (high.0 - low.0, high.1 - low.1);
        let (most_wide, most_tall) = self.extent();
        let (origin, share) = if self.has_larger() {
            let [larger] = lattice.larger[..] else { return None };
            if self.place(m, larger) != (low.0, high.1) || wide > most_wide || tall > most_tall {
                return None;
            }
            ((low.0, high.1 - most_tall), LEAST_SHARE_WITH_LARGER)
        } else if (wide, tall) == (most_wide, most_tall) {
            (low, LEAST_SHARE)
        } else {
            return self.among_outliers(&places, (low, high));
        };
        let ids: Option<BTreeMap<u32, usize>> = places
            .iter()
            .map(|(p, blob)| Some((self.id((p.0 - origin.0, p.1 - origin.1))?, *blob)))
            .collect();
        let all = (self.columns * self.rows) as f64;
        ids.filter(|ids| ids.len() as f64 >= share * all)
    }

    /// The board in a lattice that reaches beyond it because circles beside the board joined: the one place where
    /// all its circles are there, with too few outliers around it for another row or column.
    fn among_outliers(
        &self,
        places: &[(Label, usize)],
        (low, high): (Label, Label),
    ) -> Option<BTreeMap<u32, usize>> {
        let (wide, tall) = self.extent();
        let (last_x, last_y) = (high.0 - wide, high.1 - tall);
        let mut found = None;
        for origin in (low.1..=last_y).flat_map(|y| (low.0..=last_x).map(move |x| (x, y))) {
            let Some(ids) = self.whole_at(places, origin) else { continue };
            if found.is_some() {
                return None; // two places: it is a larger board
            }
            found = Some(ids);
        }
        found
    }

    /// All circles of a board whose top left is at `origin`, if what lies around it are mere outliers.
    fn whole_at(&self, places: &[(Label, usize)], origin: Label) -> Option<BTreeMap<u32, usize>> {
        let mut ids = BTreeMap::new();
        let (mut in_columns, mut in_rows) = (BTreeMap::new(), BTreeMap::new());
        for (place, blob) in places {
            let (x, y) = (place.0 - origin.0, place.1 - origin.1);
            match self.id((x, y)) {
                Some(id) => drop(ids.insert(id, *blob)),
                None => {
                    *in_columns.entry(x).or_insert(0) += 1;
                    *in_rows.entry(y).or_insert(0) += 1;
                }
            }
        }
        let all = self.columns * self.rows;
        let outliers = places.len() - ids.len();
        // places of a column, and of a row, of an asymmetric grid: in every second row or column
        let column = if self.kind == Circles::Asymmetric { self.rows / 2 } else { self.rows };
        let (wide, tall) = self.extent();
        let outside = |(line, count): (&i32, &i32), last: i32, length: i32| {
            (0..=last).contains(line) || 2 * count < length
        };
        let are_outliers = outliers as f64 <= (MOST_OUTLIERS * f64::from(all)).max(FEW_OUTLIERS)
            && in_columns.iter().all(|c| outside(c, wide, column))
            && in_rows.iter().all(|r| outside(r, tall, self.columns));
        (ids.len() as i32 == all && are_outliers).then_some(ids)
    }

    /// A label in the board's own directions, in columns and rows; of an asymmetric grid in units
    /// of its pitch.
    fn place(&self, m: [i32; 4], (i, j): Label) -> Label {
        let (s, t) = (m[0] * i + m[1] * j, m[2] * i + m[3] * j);
        if self.kind == Circles::Asymmetric { (s - t, s + t) } else { (s, t) }
    }

    fn extent(&self) -> (i32, i32) {
        let across =
            if self.kind == Circles::Asymmetric { 2 * self.columns - 1 } else { self.columns - 1 };
        (across, self.rows - 1)
    }

    /// The circle at a place counted from the board's top left.
    fn id(&self, (x, y): Label) -> Option<u32> {
        let column = if self.kind == Circles::Asymmetric {
            (x + y).rem_euclid(2).eq(&0).then(|| (x - y.rem_euclid(2)) / 2)?
        } else {
            x
        };
        let inside = (0..self.columns).contains(&column) && (0..self.rows).contains(&y) && x >= 0;
        inside.then(|| (y * self.columns + column) as u32)
    }

    /// Columns and rows of the board of this kind that a lattice is, whatever its size.
    pub fn other_size(&self, lattice: &Lattice) -> Option<(u32, u32)> {
        changes_of_basis().find_map(|m| {
            let places = lattice.blobs.keys().map(|l| self.place(m, *l));
            let (low, high) = bounds(places)?;
            let (wide, tall) = (high.0 - low.0, high.1 - low.1);
            let columns = if self.kind == Circles::Asymmetric { (wide + 1) / 2 } else { wide + 1 };
            let other = Self { columns, rows: tall + 1, kind: self.kind };
            let full = lattice.blobs.len() as i64 == i64::from(columns) * i64::from(tall + 1);
            let fits = full && columns > 1 && tall > 0 && other.labelled_by(lattice, m).is_some();
            fits.then_some((columns as u32, (tall + 1) as u32))
        })
    }
}

/// Integer matrices of determinant 1, row by row, the simplest first.
fn changes_of_basis() -> impl Iterator<Item = [i32; 4]> {
    let n = LARGEST_ENTRY;
    let side = (2 * n + 1) as usize;
    let entry = move |k: usize| k as i32 - n;
    let all = (0..side.pow(4)).map(move |k| {
        [k % side, k / side % side, k / side.pow(2) % side, k / side.pow(3)].map(entry)
    });
    let mut sound: Vec<[i32; 4]> = all.filter(|m| m[0] * m[3] - m[1] * m[2] == 1).collect();
    sound.sort_by_key(|m| m.iter().map(|e| e * e).sum::<i32>());
    sound.into_iter()
}

fn bounds(labels: impl Iterator<Item = Label>) -> Option<(Label, Label)> {
    labels.fold(None, |so_far, l| {
        let (low, high) = so_far.unwrap_or((l, l));
        Some(((low.0.min(l.0), low.1.min(l.1)), (high.0.max(l.0), high.1.max(l.1))))
    })
}
