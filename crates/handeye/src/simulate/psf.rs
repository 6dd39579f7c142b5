//! Point spreads, sampled on the cells of the canvas.
//!
//! A spread with sharp edges (a disc, a streak) is a cloud of equal weights. Each of them is shared
//! out to the cells around it by the cubic of R. Keys, *Cubic convolution interpolation for digital
//! image processing*, IEEE TASSP 29(6), 1981: mass, centre and second moments of the cloud stay
//! exactly what they were.

use nalgebra::Vector2;

use super::Optics;

/// Points of the cloud per cell and direction.
const FINENESS: f64 = 8.0;
/// Cells that the cubic reaches to either side.
const CUBIC_REACH: i64 = 2;

/// How much of each cell around a pixel's centre reaches it. As many cells on either side.
pub(super) enum Kernel {
    /// The product of these weights, along rows and columns.
    Separable(Vec<f32>),
    /// Rows of weights.
    Square(Vec<Vec<f32>>),
}

impl Kernel {
    /// Lens, motion and the pixel's own extent, all in one.
    pub(super) fn of(optics: &Optics) -> Self {
        let cells = CELLS as f64;
        let mut line = aperture(cells * optics.aperture_px);
        if optics.blur_px > 0.0 {
            line = along_a_line(&gaussian(cells * optics.blur_px), &line);
        }
        let disc = (optics.defocus_px > 0.0).then(|| disc(cells * optics.defocus_px));
        let (length, direction) = (cells * optics.motion_px, optics.motion_rad);
        let streak = (length > 0.0).then(|| streak(length, direction));
        let field = match (disc, streak) {
            (None, None) => return Self::Separable(line.iter().map(|w| *w as f32).collect()),
            (Some(one), None) | (None, Some(one)) => one,
            (Some(one), Some(other)) => over_a_field(&one, &other),
        };
        let column: Vec<Vec<f64>> = line.iter().map(|w| vec![*w]).collect();
        let field = over_a_field(&over_a_field(&field, &[line]), &column);
        let row = |row: &Vec<f64>| row.iter().map(|w| *w as f32).collect();
        Self::Square(field.iter().map(row).collect())
    }

    /// Cells on either side.
    pub(super) fn reach(&self) -> usize {
        match self {
            Self::Separable(line) => line.len() / 2,
            Self::Square(rows) => rows.len() / 2,
        }
    }
}

/// Disc of `radius` cells: a lens out of focus.
fn disc(radius: f64) -> Vec<Vec<f64>> {
    let n = (radius * FINENESS).ceil().max(2.0 * FINENESS) as i64;
    let at = |k: i64| (k as f64 + 0.5) / n as f64 * radius;
    let grid = (-n..n).flat_map(|j| (-n..n).map(move |i| Vector2::new(at(i), at(j))));
    shared_out(&grid.filter(|p| p.norm() <= radius).collect::<Vec<_>>())
}

/// Streak of `length` cells along `direction` (rad, from x to y): a steady motion while the shutter
/// is open.
fn streak(length: f64, direction: f64) -> Vec<Vec<f64>> {
    let along = Vector2::new(direction.cos(), direction.sin()) * length;
    let n = (2.0 * length * FINENESS).ceil().max(FINENESS) as i64;
    let at = |k: i64| along * ((k as f64 + 0.5) / n as f64 - 0.5);
    shared_out(&(0..n).map(at).collect::<Vec<_>>())
}

/// A cloud of equal weights on the cells; their centre is that of the middle cell.
fn shared_out(cloud: &[Vector2<f64>]) -> Vec<Vec<f64>> {
    let farthest = cloud.iter().map(|p| p.amax()).fold(0.0, f64::max);
    let reach = farthest.ceil() as i64 + CUBIC_REACH;
    let side = (2 * reach + 1) as usize;
    let mut field = vec![vec![0.0; side]; side];
    for p in cloud {
        let (x, y) = (p.x.floor() as i64, p.y.floor() as i64);
        for j in y - CUBIC_REACH + 1..=y + CUBIC_REACH {
            let row = cubic(p.y - j as f64) / cloud.len() as f64;
            for i in x - CUBIC_REACH + 1..=x + CUBIC_REACH {
                field[(j + reach) as usize][(i + reach) as usize] += row * cubic(p.x - i as f64);
            }
        }
    }
    field
}

fn along_a_line(one: &[f64], other: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; one.len() + other.len() - 1];
    for (i, a) in one.iter().enumerate() {
        for (j, b) in other.iter().enumerate() {
            out[i + j] += a * b;
        }
    }
    out
}

fn over_a_field(one: &[Vec<f64>], other: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let columns = one[0].len() + other[0].len() - 1;
    let mut out = vec![vec![0.0; columns]; one.len() + other.len() - 1];
    for (i, a) in one.iter().enumerate() {
        for (j, b) in other.iter().enumerate() {
            let row = along_a_line(a, b);
            out[i + j].iter_mut().zip(row).for_each(|(sum, w)| *sum += w);
        }
    }
    out
}

/// Gaussian of `sigma` cells.
fn gaussian(sigma: f64) -> Vec<f64> {
    let reach = (4.0 * sigma).ceil() as i64;
    let weight = |k: i64| (-0.5 * (k as f64 / sigma).powi(2)).exp();
    let sum: f64 = (-reach..=reach).map(weight).sum();
    (-reach..=reach).map(|k| weight(k) / sum).collect()
}

/// Weights of the cells around a pixel's centre, as many on either side, whose sum is the mean over
/// `width` cells: differences of the integral up to the cells' borders, which the cubic interpolates
/// between them.
fn aperture(width: f64) -> Vec<f64> {
    let edge = 0.5 * width;
    let reach = edge.ceil() as i64 + CUBIC_REACH;
    let integral_to = |at: f64, cell: i64| -> f64 {
        (cell + 1..=reach + CUBIC_REACH).map(|border| cubic(at - border as f64)).sum()
    };
    let weight = |cell: i64| (integral_to(edge, cell) - integral_to(-edge, cell)) / width;
    let all: Vec<f64> = (-reach..reach).map(weight).collect();
    let empty = all.iter().take_while(|w| **w == 0.0).count();
    all[empty..all.len() - empty].to_vec()
}

/// Keys' interpolating cubic.
fn cubic(x: f64) -> f64 {
    let x = x.abs();
    if x < 1.0 {
        (1.5 * x - 2.5) * x * x + 1.0
    } else if x < 2.0 {
        ((2.5 - 0.5 * x) * x - 4.0) * x + 2.0
    } else {
        0.0
    }
}

/// Cells along each side of a pixel. What the optics do to an edge is exact where it lies on a border
/// of cells, and linear in its place between two.
pub(super) const CELLS: usize = 4;

#[cfg(test)]
mod tests {
    use super::*;

    /// Sum, centre and second moments (xx, xy, yy).
    fn moments(field: &[Vec<f64>]) -> [f64; 6] {
        let (middle, mut sums) = (0.5 * (field.len() - 1) as f64, [0.0; 6]);
        for (j, row) in field.iter().enumerate() {
            for (i, w) in row.iter().enumerate() {
                let (x, y) = (i as f64 - middle, j as f64 - middle);
                let terms = [1.0, x, y, x * x, x * y, y * y];
                sums.iter_mut().zip(terms).for_each(|(s, t)| *s += w * t);
            }
        }
        sums
    }

    fn assert_near(found: [f64; 6], wanted: [f64; 6], within: f64) {
        let off = found.iter().zip(wanted).map(|(f, w)| (f - w).abs()).fold(0.0, f64::max);
        assert!(off < within, "{found:?} {wanted:?}");
    }

    #[test]
    fn a_disc_has_the_moments_of_a_disc() {
        for radius in [2.0, 4.0, 9.0, 24.0] {
            let second = radius * radius / 4.0;
            let wanted = [1.0, 0.0, 0.0, second, 0.0, second];
            assert_near(moments(&disc(radius)), wanted, 5e-3 * (1.0 + second));
        }
    }

    #[test]
    fn a_streak_has_the_moments_of_a_line() {
        for (length, direction) in [(6.0, 0.0), (6.0, 0.7), (3.3, 2.0), (14.0, 1.2)] {
            let (sine, cosine) = f64::sin_cos(direction);
            let second = length * length / 12.0;
            let spread = [cosine * cosine, sine * cosine, sine * sine].map(|x| x * second);
            let wanted = [1.0, 0.0, 0.0, spread[0], spread[1], spread[2]];
            assert_near(moments(&streak(length, direction)), wanted, 1e-3 * (1.0 + second));
        }
    }

    #[test]
    fn an_aperture_is_the_mean_over_its_width() {
        assert_eq!(aperture(4.0), [0.25; 4]);
        for width in [4.0, 5.2, 6.0, 10.8] {
            let field = [aperture(width)];
            let middle = 0.5 * (field[0].len() - 1) as f64;
            let moment = |power: i32| -> f64 {
                let weights = field[0].iter().enumerate();
                weights.map(|(k, w)| w * (k as f64 - middle).powi(power)).sum()
            };
            // a cell's own width counts as well
            let second = moment(2) + 1.0 / 12.0;
            assert!((moment(0) - 1.0).abs() < 1e-9 && moment(1).abs() < 1e-9, "{field:?}");
            assert!((second - width * width / 12.0).abs() < 0.1, "{width}: {second}");
        }
    }

    #[test]
    fn the_variances_of_all_spreads_add() {
        let optics = Optics {
            blur_px: 0.9,
            defocus_px: 2.0,
            motion_px: 3.0,
            aperture_px: 2.0,
            ..Optics::default()
        };
        let Kernel::Square(rows) = Kernel::of(&optics) else { panic!("discs do not separate") };
        let wide = |row: &Vec<f32>| row.iter().map(|w| f64::from(*w)).collect();
        let [sum, x, y, xx, _, yy] = moments(&rows.iter().map(wide).collect::<Vec<_>>());
        let both = 0.9f64.powi(2) + 1.0 + (4.0 - 1.0 / 16.0) / 12.0;
        assert!((sum - 1.0).abs() < 1e-4 && x.abs() < 1e-4 && y.abs() < 1e-4, "{sum} {x} {y}");
        assert!((xx / 16.0 - both - 0.75).abs() < 0.01 && (yy / 16.0 - both).abs() < 0.01);
    }
}
