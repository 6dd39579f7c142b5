//! Patches of pixels that are darker than their surroundings, by their convex hulls.

use nalgebra::Vector2;

use crate::GrayImage;

/// A pixel is dark when it is this much darker than the mean around it, grey values.
const DARKER: u32 = 5;

/// Hulls of the connected dark patches at least `least` px wide and high that do not touch the
/// image's edge. Dark is what is darker than the mean of a square of half width `radius`; with
/// `shrunk`, dark pixels beside bright ones do not count, so that patches that touch come apart.
pub(super) fn hulls(
    image: &GrayImage,
    radius: usize,
    least: f64,
    shrunk: bool,
) -> Vec<Vec<Vector2<f64>>> {
    let (width, height) = (image.width(), image.height());
    if image.values().is_empty() {
        return vec![];
    }
    let mut dark = dark(image, radius);
    if shrunk {
        dark = without_rim(&dark, width);
    }
    let joined = Joined::new(&dark, width);
    let large = |b: &Bounds| {
        let inside = b.left > 0 && b.top > 0 && b.right + 1 < width && b.bottom + 1 < height;
        let size = (b.right.saturating_sub(b.left)).min(b.bottom.saturating_sub(b.top));
        inside && size as f64 > 0.5 * least
    };
    joined.patches(large).iter().map(|rows| hull(rows)).collect()
}

/// Which pixels are darker than the mean of the square around them, by sums that move along.
fn dark(image: &GrayImage, radius: usize) -> Vec<bool> {
    let (width, height) = (image.width(), image.height());
    let grey: Vec<u8> = image.values().iter().map(|v| (v + 0.5) as u8).collect();
    let row = |y: usize| &grey[y * width..][..width];
    let across = |k: usize, size: usize| (k + radius).min(size - 1) + 1 - k.saturating_sub(radius);
    let counts: Vec<u32> = (0..width).map(|x| across(x, width) as u32).collect();
    let mut columns = vec![0_u32; width];
    (0..radius.min(height)).for_each(|y| add(&mut columns, row(y)));
    // sums from the left, as far as the square reaches on either side
    let mut sums = vec![0_u32; width + 2 * radius + 1];
    let mut dark = vec![false; width * height];
    for (y, out) in dark.chunks_exact_mut(width).enumerate() {
        if y + radius < height {
            add(&mut columns, row(y + radius));
        }
        if y > radius {
            let gone = row(y - radius - 1);
            columns.iter_mut().zip(gone).for_each(|(sum, v)| *sum -= u32::from(*v));
        }
        let mut sum = 0_u32;
        for (total, column) in sums[radius + 1..].iter_mut().zip(&columns) {
            sum = sum.wrapping_add(*column);
            *total = sum;
        }
        sums[radius + 1 + width..].fill(sum);
        let rows = across(y, height) as u32;
        let ends = sums.iter().zip(&sums[2 * radius + 1..]);
        for (((out, grey), count), (left, right)) in
            out.iter_mut().zip(row(y)).zip(&counts).zip(ends)
        {
            *out = (u32::from(*grey) + DARKER) * (count * rows) < right.wrapping_sub(*left);
        }
    }
    dark
}

fn add(columns: &mut [u32], row: &[u8]) {
    columns.iter_mut().zip(row).for_each(|(sum, v)| *sum += u32::from(*v));
}

/// The dark pixels that have dark ones on all eight sides.
fn without_rim(dark: &[bool], width: usize) -> Vec<bool> {
    let mut along = vec![false; dark.len()];
    for (out, row) in along.chunks_exact_mut(width).zip(dark.chunks_exact(width)) {
        for (out, three) in out[1..].iter_mut().zip(row.windows(3)) {
            *out = three[0] & three[1] & three[2];
        }
    }
    let mut inner = vec![false; dark.len()];
    let n = dark.len().saturating_sub(2 * width);
    let (above, here, below) = (&along[..n], &along[width..][..n], &along[2 * width..]);
    for (out, ((a, b), c)) in inner[width..].iter_mut().zip(above.iter().zip(here).zip(below)) {
        *out = a & b & c;
    }
    inner
}

/// Dark pixels side by side in a row: row, first and last column.
type Run = (usize, usize, usize);

struct Bounds {
    left: usize,
    right: usize,
    top: usize,
    bottom: usize,
}

/// Dark runs, row by row, each with another one of its patch; the first of a patch has itself.
struct Joined {
    runs: Vec<Run>,
    other: Vec<usize>,
}

impl Joined {
    fn new(dark: &[bool], width: usize) -> Self {
        let mut joined = Self { runs: vec![], other: vec![] };
        let mut above = 0..0;
        for (y, row) in dark.chunks_exact(width).enumerate() {
            let first = joined.runs.len();
            let mut x = 0;
            while let Some(white) = row[x..].iter().position(|dark| *dark) {
                let left = x + white;
                let length = row[left..].iter().position(|dark| !dark).unwrap_or(width - left);
                joined.push((y, left, left + length - 1), &mut above);
                x = left + length;
            }
            above = first..joined.runs.len();
        }
        joined
    }

    /// Adds a run, and joins it with those above that it touches.
    fn push(&mut self, run: Run, above: &mut std::ops::Range<usize>) {
        let own = self.runs.len();
        self.runs.push(run);
        self.other.push(own);
        while above.start < above.end && self.runs[above.start].2 < run.1 {
            above.start += 1;
        }
        for k in above.clone().take_while(|&k| self.runs[k].1 <= run.2).collect::<Vec<_>>() {
            let (a, b) = (self.first(k), self.first(own));
            self.other[a.max(b)] = a.min(b);
        }
    }

    /// The first run of a patch.
    fn first(&mut self, mut k: usize) -> usize {
        while self.other[k] != k {
            self.other[k] = self.other[self.other[k]];
            k = self.other[k];
        }
        k
    }

    /// The rows of all patches with these bounds: row, first and last column.
    fn patches(mut self, wanted: impl Fn(&Bounds) -> bool) -> Vec<Vec<Run>> {
        let firsts: Vec<usize> = (0..self.runs.len()).map(|k| self.first(k)).collect();
        let mut bounds: Vec<Option<Bounds>> = self.runs.iter().map(|_| None).collect();
        for (&(y, left, right), &first) in self.runs.iter().zip(&firsts) {
            let b = bounds[first].get_or_insert(Bounds { left, right, top: y, bottom: y });
            (b.left, b.right, b.bottom) = (b.left.min(left), b.right.max(right), y);
        }
        let mut place = vec![None; self.runs.len()];
        let mut patches: Vec<Vec<Run>> = vec![];
        for (&(y, left, right), &first) in self.runs.iter().zip(&firsts) {
            if !bounds[first].as_ref().is_some_and(&wanted) {
                continue;
            }
            let at = *place[first].get_or_insert_with(|| {
                patches.push(vec![]);
                patches.len() - 1
            });
            match patches[at].last_mut() {
                Some(row) if row.0 == y => row.2 = right,
                _ => patches[at].push((y, left, right)),
            }
        }
        patches
    }
}

/// Convex hull, clockwise in the image (A. Andrew, *Another efficient algorithm for convex hulls
/// in two dimensions*, 1979).
fn hull(rows: &[Run]) -> Vec<Vector2<f64>> {
    let ends = |&(y, left, right): &Run| [left, right].map(|x| Vector2::new(x as f64, y as f64));
    let points: Vec<Vector2<f64>> = rows.iter().flat_map(ends).collect();
    let mut whole = half_hull(points.iter().copied());
    whole.extend(half_hull(points.iter().rev().copied()));
    whole
}

/// The hull of points sorted by rows, down its right side; the last point is left out.
fn half_hull(points: impl Iterator<Item = Vector2<f64>>) -> Vec<Vector2<f64>> {
    let mut kept: Vec<Vector2<f64>> = Vec::new();
    for p in points {
        while let [.., a, b] = kept[..]
            && (b - a).perp(&(p - b)) <= 0.0
        {
            kept.pop();
        }
        kept.push(p);
    }
    kept.pop();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    fn noise(width: usize, height: usize) -> GrayImage {
        let mut random = Random::new(3);
        let values = (0..width * height).map(|_| random.between(0.0, 255.0).round() as f32);
        GrayImage::new(width, height, values.collect()).unwrap()
    }

    #[test]
    fn dark_is_what_is_darker_than_the_mean_around_it() {
        let (width, height) = (37, 23);
        let image = noise(width, height);
        for radius in [1, 4, 11, 60] {
            let found = dark(&image, radius);
            for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
                let near =
                    |k: usize, size: usize| k.saturating_sub(radius)..(k + radius + 1).min(size);
                let all = near(y, height).flat_map(|j| near(x, width).map(move |i| (i, j)));
                let (mut sum, mut count) = (0.0, 0.0);
                all.for_each(|(i, j)| (sum, count) = (sum + image.at(i, j), count + 1.0));
                let wanted = image.at(x, y) + 5.0 < sum / count;
                assert_eq!(found[y * width + x], wanted, "{x} {y}, radius {radius}");
            }
        }
    }

    fn picture(rows: &[&str]) -> GrayImage {
        let values =
            rows.iter().flat_map(|r| r.bytes().map(|b| if b == b'#' { 0.0 } else { 200.0 }));
        GrayImage::new(rows[0].len(), rows.len(), values.collect()).unwrap()
    }

    #[test]
    fn arms_of_one_patch_are_joined_and_what_touches_the_edge_is_none() {
        let image = picture(&[
            "............#",
            "..#..#......#",
            "..#..#..##..#",
            "..####..##..#",
            ".............",
        ]);
        let found = hulls(&image, 3, 1.0, false);
        assert_eq!(found.len(), 2);
        let corners = [(2.0, 1.0), (5.0, 1.0), (5.0, 3.0), (2.0, 3.0)];
        assert!(corners.iter().all(|&(x, y)| found[0].contains(&Vector2::new(x, y))), "{found:?}");
        assert_eq!(found[1].len(), 4);
    }

    #[test]
    fn squares_that_touch_come_apart() {
        let grey = |k: usize| {
            let (x, y) = (k % 40, k / 40);
            let dark = (5..16).contains(&x) && (5..16).contains(&y)
                || (15..26).contains(&x) && (15..26).contains(&y);
            if dark { 0.0 } else { 200.0 }
        };
        let image = GrayImage::new(40, 40, (0..1600).map(grey).collect()).unwrap();
        assert_eq!(hulls(&image, 12, 4.0, false).len(), 1);
        let apart = hulls(&image, 12, 4.0, true);
        assert_eq!(apart.len(), 2);
        assert!(apart[0].contains(&Vector2::new(6.0, 6.0)), "{apart:?}");
    }
}
