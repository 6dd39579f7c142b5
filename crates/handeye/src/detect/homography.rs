//! The map between two planes: `λ (x', y', 1)ᵀ = H (x, y, 1)ᵀ`.
//!
//! Direct linear transform on points moved to their centroid and scaled to mean distance √2: the
//! rows `(x y 1 0 0 0 -x'x -x'y -x')` and `(0 0 0 x y 1 -y'x -y'y -y')` times the nine entries of
//! `H` vanish, so `H` is the eigenvector of the least eigenvalue of their 9 x 9 normal matrix.
//!
//! R. Hartley and A. Zisserman, *Multiple View Geometry*, 2nd ed. 2004, algorithm 4.2.

use nalgebra::{Matrix3, SMatrix, SVector, Vector2, Vector3};

/// The two least eigenvalues must differ by this ratio, or four points in general position are
/// missing.
const DETERMINED: f64 = 1e-9;

/// Homography that takes `from` to `to`; `None` if the points (at least four, no three on a line)
/// do not determine it.
pub fn fit(from: &[Vector2<f64>], to: &[Vector2<f64>]) -> Option<Matrix3<f64>> {
    if from.len() < 4 || from.len() != to.len() {
        return None;
    }
    let (n_from, n_to) = (normalisation(from)?, normalisation(to)?);
    let mut normal = SMatrix::<f64, 9, 9>::zeros();
    for (a, b) in from.iter().zip(to) {
        let (p, q) = (n_from * a.push(1.0), n_to * b.push(1.0));
        for (row, value) in [(0, q.x), (3, q.y)] {
            let mut r = SVector::<f64, 9>::zeros();
            r.fixed_rows_mut::<3>(row).copy_from(&p);
            r.fixed_rows_mut::<3>(6).copy_from(&(-p * value));
            normal.ger(1.0, &r, &r, 1.0);
        }
    }
    let h = least_eigenvector(&normal)?;
    let normalised = Matrix3::from_row_slice(h.as_slice());
    let h = n_to.try_inverse()? * normalised * n_from;
    h.iter().all(|x| x.is_finite()).then(|| h / h.norm())
}

fn least_eigenvector(normal: &SMatrix<f64, 9, 9>) -> Option<SVector<f64, 9>> {
    if normal.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let eigen = normal.symmetric_eigen();
    let mut order: Vec<usize> = (0..9).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    let determined = eigen.eigenvalues[order[1]] > DETERMINED * eigen.eigenvalues[order[8]];
    determined.then(|| eigen.eigenvectors.column(order[0]).into_owned())
}

fn normalisation(points: &[Vector2<f64>]) -> Option<Matrix3<f64>> {
    let count = points.len() as f64;
    let centre = points.iter().sum::<Vector2<f64>>() / count;
    let spread = points.iter().map(|p| (p - centre).norm()).sum::<f64>() / count;
    let s = std::f64::consts::SQRT_2 / spread;
    (spread > 0.0 && s.is_finite())
        .then(|| Matrix3::new(s, 0.0, -s * centre.x, 0.0, s, -s * centre.y, 0.0, 0.0, 1.0))
}

/// Where the homography that takes the first points of all pairs to their second ones takes the
/// origin, and the variance of that over the variance of the second points' coordinates. `None` if the
/// pairs do not tell.
///
/// With `H₃₃ = 1` the origin goes to `(H₁₃, H₂₃)`, two of eight unknowns of a linear system.
pub fn origin(pairs: &[(Vector2<f64>, Vector2<f64>)]) -> Option<(Vector2<f64>, f64)> {
    let count = pairs.len() as f64;
    let middle = pairs.iter().map(|p| p.1).sum::<Vector2<f64>>() / count;
    let scale = pairs.iter().map(|p| p.0.amax()).fold(0.0, f64::max).recip();
    let there = pairs.iter().map(|p| (p.1 - middle).amax()).fold(0.0, f64::max).recip();
    let mut normal = SMatrix::<f64, 8, 8>::zeros();
    let mut right = SVector::<f64, 8>::zeros();
    for (a, b) in pairs {
        let (p, q) = ((a * scale).push(1.0), (b - middle) * there);
        let products = p * p.transpose();
        for (row, value) in [(0, q.x), (3, q.y)] {
            add(&mut normal, (row, row), &products);
            let mixed = products.fixed_view::<3, 2>(0, 0) * -value;
            let mut block = normal.fixed_view_mut::<3, 2>(row, 6);
            block += mixed;
            let mut part = right.fixed_rows_mut::<3>(row);
            part += p * value;
        }
        let mut last = normal.fixed_view_mut::<2, 2>(6, 6);
        last += products.fixed_view::<2, 2>(0, 0) * q.norm_squared();
        let mut part = right.fixed_rows_mut::<2>(6);
        part -= p.xy() * q.norm_squared();
    }
    normal.fill_lower_triangle_with_upper_triangle();
    let solver = normal.cholesky()?;
    let h = solver.solve(&right);
    let of_x = solver.solve(&SVector::<f64, 8>::ith(2, 1.0))[2];
    let of_y = solver.solve(&SVector::<f64, 8>::ith(5, 1.0))[5];
    let at = middle + Vector2::new(h[2], h[5]) / there;
    let spread = of_x.max(of_y);
    (at.iter().all(|x| x.is_finite()) && spread.is_finite()).then_some((at, spread))
}

fn add(normal: &mut SMatrix<f64, 8, 8>, at: (usize, usize), block: &Matrix3<f64>) {
    let mut part = normal.fixed_view_mut::<3, 3>(at.0, at.1);
    part += block;
}

/// Image of a point; not finite at the horizon.
pub fn apply(h: &Matrix3<f64>, at: &Vector2<f64>) -> Vector2<f64> {
    let p: Vector3<f64> = h * at.push(1.0);
    p.xy() / p.z
}

/// The homography from the unit square's corners (0,0), (1,0), (1,1), (0,1) to a quadrilateral.
///
/// P. Heckbert, *Fundamentals of texture mapping*, 1989, section 2.2.3.
pub(crate) fn from_unit_square(quad: &[Vector2<f64>; 4]) -> Matrix3<f64> {
    let [p0, p1, p2, p3] = quad;
    let sum = p0 - p1 + p2 - p3;
    let (d1, d2) = (p1 - p2, p3 - p2);
    let area = d1.perp(&d2);
    let (g, h) = (sum.perp(&d2) / area, d1.perp(&sum) / area);
    let (x, y) = (p1 - p0 + p1 * g, p3 - p0 + p3 * h);
    Matrix3::new(x.x, y.x, p0.x, x.y, y.y, p0.y, g, h, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn truth() -> Matrix3<f64> {
        Matrix3::new(320.0, 12.0, 400.0, -30.0, 290.0, 310.0, 0.08, -0.11, 1.0)
    }

    fn grid() -> Vec<Vector2<f64>> {
        (0..12).map(|k| Vector2::new(f64::from(k % 4), f64::from(k / 4)) * 0.1).collect()
    }

    #[test]
    fn exact_points_give_the_truth() {
        let to: Vec<_> = grid().iter().map(|p| apply(&truth(), p)).collect();
        let h = fit(&grid(), &to).unwrap();
        for (a, b) in grid().iter().zip(&to) {
            assert!((apply(&h, a) - b).norm() < 1e-9);
        }
    }

    #[test]
    fn the_origin_goes_where_the_homography_takes_it() {
        let centre = Vector2::new(0.17, 0.08);
        let pairs: Vec<_> = grid().iter().map(|p| (p - centre, apply(&truth(), p))).collect();
        let (at, spread) = origin(&pairs).unwrap();
        assert!((at - apply(&truth(), &centre)).norm() < 1e-9);
        assert!((0.05..1.0).contains(&spread), "{spread}");
        let outside: Vec<_> = pairs.iter().map(|p| (p.0.add_scalar(1.0), p.1)).collect();
        assert!(origin(&outside).unwrap().1 > 10.0 * spread);
        let line: Vec<_> = pairs.iter().map(|p| (Vector2::repeat(p.0.x), p.1)).collect();
        assert!(origin(&line).is_none() && origin(&[]).is_none());
    }

    #[test]
    fn points_on_a_line_determine_nothing() {
        let line: Vec<_> = (0..9).map(|k| Vector2::new(f64::from(k), 2.0 * f64::from(k))).collect();
        let to: Vec<_> = line.iter().map(|p| apply(&truth(), p)).collect();
        assert!(fit(&line, &to).is_none());
        assert!(fit(&[Vector2::zeros(); 5], &[Vector2::zeros(); 5]).is_none());
    }

    #[test]
    fn the_unit_square_goes_to_the_quadrilateral() {
        let quad =
            [(1.0, 2.0), (7.0, 1.0), (8.0, 9.0), (0.0, 6.0)].map(|(x, y)| Vector2::new(x, y));
        let h = from_unit_square(&quad);
        for (corner, wanted) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].iter().zip(&quad) {
            let seen = apply(&h, &Vector2::new(corner.0, corner.1));
            assert!((seen - wanted).norm() < 1e-12);
        }
    }
}
