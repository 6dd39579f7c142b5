//! Patches of an image that could be circles: about where they are, how large and how bent.
//!
//! A pixel belongs to a patch where it differs from the mean of the square around it. Patches are
//! runs of such pixels that touch from row to row. Only a patch's outline counts, so a circle wider
//! than the square, of which a ring remains, is found too.

use nalgebra::{Matrix2, Vector2};

use crate::GrayImage;

/// A patch with the outline of an ellipse.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blob {
    /// Its centre, px.
    pub centre: Vector2<f64>,
    /// `S` of the ellipse `dᵀ S⁻¹ d = 1` with the same second moments, px².
    pub shape: Matrix2<f64>,
    /// Whether it is darker than its surroundings.
    pub dark: bool,
}

impl Blob {
    /// Product of the half axes, px².
    pub fn size(&self) -> f64 {
        self.shape.determinant().sqrt()
    }
}

/// A pixel must differ from the mean around it by this much, grey values ...
const LEAST_STEP: f64 = 5.0;
/// ... and by this many standard deviations of the noise.
const NOISE_STEPS: f64 = 3.0;
/// Neighbouring pixels' median difference over the noise's standard deviation.
const MEDIAN_DIFFERENCE: f64 = 0.954;
/// Half axes shorter than this (px) show no ellipse.
const SHORTEST_AXIS: f64 = 1.3;
/// Ratio of the axes of a circle seen at 80 degrees.
const MOST_OBLONG: f64 = 6.0;
/// An outline may leave its ellipse by this much (root mean square): px, and share of the shorter
/// half axis.
const ROUGH: (f64, f64) = (0.4, 0.05);
/// More patches than this are no image of a board; the largest are kept.
const MOST_BLOBS: usize = 4000;

/// All patches that could be circles; means are taken over squares of `2 radius + 1` pixels.
pub(super) fn blobs(image: &GrayImage, radius: usize) -> Vec<Blob> {
    let grey = image.to_u8();
    let step = LEAST_STEP.max(NOISE_STEPS * noise(&grey, image.width()));
    let mut runs = Runs::default();
    classify(&grey, image.width(), radius, step.round() as i32, |row| runs.add(row));
    let mut found = runs.blobs(image.width(), image.height());
    if found.len() > MOST_BLOBS {
        found.sort_by(|a, b| b.size().total_cmp(&a.size()));
        found.truncate(MOST_BLOBS);
    }
    found
}

/// Standard deviation of the noise: from the median difference between neighbours.
fn noise(grey: &[u8], width: usize) -> f64 {
    let mut counts = [0usize; 256];
    let pairs = grey.chunks_exact(width).step_by(3);
    for row in pairs {
        for pair in row.chunks_exact(2) {
            counts[usize::from(pair[0].abs_diff(pair[1]))] += 1;
        }
    }
    let half = counts.iter().sum::<usize>() / 2;
    let mut below = 0;
    let median = counts.iter().position(|&count| {
        below += count;
        below > half
    });
    median.unwrap_or(0) as f64 / MEDIAN_DIFFERENCE
}

/// What a pixel is, compared with its surroundings.
const SAME: u8 = 0;
const DARK: u8 = 1;
const LIGHT: u8 = 2;

/// Hands over row after row of classes.
fn classify(grey: &[u8], width: usize, radius: usize, step: i32, mut row: impl FnMut(&[u8])) {
    let height = grey.len() / width;
    let line = |y: usize| &grey[y * width..(y + 1) * width];
    let mut columns = vec![0i32; width];
    let mut classes = vec![SAME; width];
    let mut sums = vec![0i32; width];
    for y in 0..radius.min(height) {
        columns.iter_mut().zip(line(y)).for_each(|(sum, &g)| *sum += i32::from(g));
    }
    for y in 0..height {
        if y + radius < height {
            columns.iter_mut().zip(line(y + radius)).for_each(|(sum, &g)| *sum += i32::from(g));
        }
        if y > radius {
            let gone = line(y - radius - 1);
            columns.iter_mut().zip(gone).for_each(|(sum, &g)| *sum -= i32::from(g));
        }
        let tall = (y + radius + 1).min(height) - y.saturating_sub(radius);
        slide(&columns, radius, &mut sums);
        for (x, class) in classes.iter_mut().enumerate() {
            let wide = (x + radius + 1).min(width) - x.saturating_sub(radius);
            let count = (wide * tall) as i32;
            let beyond = i32::from(grey[y * width + x]) * count - sums[x];
            *class = if beyond < -step * count {
                DARK
            } else if beyond > step * count {
                LIGHT
            } else {
                SAME
            };
        }
        row(&classes);
    }
}

/// Sums over `2 radius + 1` neighbours, fewer at the ends.
fn slide(values: &[i32], radius: usize, sums: &mut [i32]) {
    let n = values.len();
    let mut sum: i32 = values[..radius.min(n)].iter().sum();
    for (x, out) in sums.iter_mut().enumerate() {
        if x + radius < n {
            sum += values[x + radius];
        }
        if x > radius {
            sum -= values[x - radius - 1];
        }
        *out = sum;
    }
}

/// Neighbouring pixels of one class in a row, ends included.
#[derive(Clone, Copy)]
struct Run {
    row: u32,
    left: u32,
    right: u32,
    class: u8,
    /// Another run of the patch, or itself.
    parent: u32,
}

/// Runs of an image, patches joined (union by path halving).
#[derive(Default)]
struct Runs {
    all: Vec<Run>,
    /// First run of the row before.
    before: usize,
    rows: u32,
}

impl Runs {
    fn add(&mut self, classes: &[u8]) {
        let first = self.all.len();
        let mut above = self.before;
        let mut x = 0;
        while x < classes.len() {
            let class = classes[x];
            let end = x + classes[x..].iter().take_while(|&&c| c == class).count();
            if class != SAME {
                let index = self.all.len() as u32;
                let (left, right) = (x as u32, end as u32 - 1);
                self.all.push(Run { row: self.rows, left, right, class, parent: index });
                while above < first && self.all[above].right < left {
                    above += 1;
                }
                let mut touching = above;
                while touching < first && self.all[touching].left <= right {
                    if self.all[touching].class == class {
                        self.join(touching as u32, index);
                    }
                    touching += 1;
                }
            }
            x = end;
        }
        self.before = first;
        self.rows += 1;
    }

    fn root(&mut self, mut run: u32) -> u32 {
        while self.all[run as usize].parent != run {
            let parent = self.all[run as usize].parent;
            self.all[run as usize].parent = self.all[parent as usize].parent;
            run = parent;
        }
        run
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.all[a.max(b) as usize].parent = a.min(b);
    }

    /// The patches that could be circles, in the order of their first rows.
    fn blobs(mut self, width: usize, height: usize) -> Vec<Blob> {
        let roots: Vec<u32> = (0..self.all.len() as u32).map(|run| self.root(run)).collect();
        let mut starts = vec![0u32; self.all.len() + 1];
        roots.iter().for_each(|&root| starts[root as usize + 1] += 1);
        for k in 1..starts.len() {
            starts[k] += starts[k - 1];
        }
        let mut sorted = vec![0u32; roots.len()];
        let mut next = starts.clone();
        for (run, &root) in roots.iter().enumerate() {
            sorted[next[root as usize] as usize] = run as u32;
            next[root as usize] += 1;
        }
        let patches = starts.windows(2).filter(|w| w[1] > w[0] + 1);
        let mut rows = vec![];
        patches
            .filter_map(|w| {
                self.outline(&sorted[w[0] as usize..w[1] as usize], &mut rows);
                blob(&rows, self.all[sorted[w[0] as usize] as usize].class == DARK, (width, height))
            })
            .collect()
    }

    /// First and last pixel of each row of a patch.
    fn outline(&self, runs: &[u32], rows: &mut Vec<(u32, u32, u32)>) {
        rows.clear();
        for &run in runs {
            let run = self.all[run as usize];
            match rows.last_mut() {
                Some(last) if last.0 == run.row => {
                    last.1 = last.1.min(run.left);
                    last.2 = last.2.max(run.right);
                }
                _ => rows.push((run.row, run.left, run.right)),
            }
        }
    }
}

/// The ellipse of an outline, if it is one that lies inside the image.
fn blob(rows: &[(u32, u32, u32)], dark: bool, (width, height): (usize, usize)) -> Option<Blob> {
    let (top, bottom) = (rows.first()?.0, rows.last()?.0);
    let left = rows.iter().map(|r| r.1).min()?;
    let right = rows.iter().map(|r| r.2).max()?;
    let inside = left > 0 && top > 0 && right + 1 < width as u32 && bottom + 1 < height as u32;
    let (wide, tall) = (right - left + 1, bottom - top + 1);
    let too_large = 2 * wide as usize > width || 2 * tall as usize > height;
    if !inside || too_large || f64::from(wide.min(tall)) < 2.0 * SHORTEST_AXIS {
        return None;
    }
    let (area, centre, moments) = moments(rows);
    let shape = 4.0 * moments;
    let axes = shape.symmetric_eigenvalues();
    let (short, long) = (axes.min().sqrt(), axes.max().sqrt());
    if short.is_nan() || short < SHORTEST_AXIS || long > MOST_OBLONG * short {
        return None;
    }
    let full = area / (std::f64::consts::PI * short * long);
    let round = (full - 1.0).abs() < ROUGH.0 / short + ROUGH.1;
    (round && roughness(rows, &centre, &shape)? * short < ROUGH.0 + ROUGH.1 * short)
        .then_some(Blob { centre, shape, dark })
}

/// Area, centroid and second central moments of the pixels' squares within an outline.
fn moments(rows: &[(u32, u32, u32)]) -> (f64, Vector2<f64>, Matrix2<f64>) {
    let origin = Vector2::new(f64::from(rows[0].1), f64::from(rows[0].0));
    let (mut area, mut first, mut second) = (0.0, Vector2::zeros(), Matrix2::zeros());
    for &(y, left, right) in rows {
        let n = f64::from(right - left + 1);
        let at = Vector2::new(0.5 * (f64::from(left) + f64::from(right)), f64::from(y)) - origin;
        area += n;
        first += n * at;
        let own = Matrix2::new(n * n / 12.0, 0.0, 0.0, 1.0 / 12.0);
        second += n * (at * at.transpose() + own);
    }
    let mean = first / area;
    (area, origin + mean, second / area - mean * mean.transpose())
}

/// Root mean square of the outline's distance from its ellipse, relative to its radius there.
fn roughness(rows: &[(u32, u32, u32)], centre: &Vector2<f64>, shape: &Matrix2<f64>) -> Option<f64> {
    let inverse = shape.try_inverse()?;
    let inner = rows.get(1..rows.len() - 1).filter(|r| !r.is_empty()).unwrap_or(rows);
    let off = |x: f64, y: u32| {
        let d = Vector2::new(x, f64::from(y)) - centre;
        (d.dot(&(inverse * d)).sqrt() - 1.0).powi(2)
    };
    let sum: f64 = inner
        .iter()
        .map(|&(y, left, right)| off(f64::from(left) - 0.5, y) + off(f64::from(right) + 0.5, y))
        .sum();
    Some((sum / (2 * inner.len()) as f64).sqrt())
}
