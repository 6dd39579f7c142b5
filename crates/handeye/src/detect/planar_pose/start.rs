//! Two poses to start from, in closed form: those of a homography.

use nalgebra::{Matrix2, Matrix3, Rotation3, Vector2, Vector3};

/// Both rotations whose first two columns explain the homography's derivative at the origin.
///
/// With `R_v` turning the optical axis onto the ray `v` of the origin, `A` the 2 x 2 derivative seen
/// along that ray and `γ` its largest singular value, the upper part of `R_vᵀ R` is `A/γ` and its
/// third row `(b₁, b₂)` follows from unit columns at right angles, up to one common sign.
pub(crate) fn two_rotations(h: &Matrix3<f64>) -> Option<[Matrix3<f64>; 2]> {
    if h[(2, 2)].abs() < 1e-12 * h.norm() {
        return None;
    }
    let h = h / h[(2, 2)];
    let (p, q) = (h[(0, 2)], h[(1, 2)]);
    let j = Matrix2::new(
        h[(0, 0)] - h[(2, 0)] * p,
        h[(0, 1)] - h[(2, 1)] * p,
        h[(1, 0)] - h[(2, 0)] * q,
        h[(1, 1)] - h[(2, 1)] * q,
    );
    let ray = Vector3::new(p, q, 1.0);
    let r_v = Rotation3::rotation_between(&Vector3::z(), &ray)?.into_inner();
    let b = Matrix2::new(
        r_v[(0, 0)] - p * r_v[(2, 0)],
        r_v[(0, 1)] - p * r_v[(2, 1)],
        r_v[(1, 0)] - q * r_v[(2, 0)],
        r_v[(1, 1)] - q * r_v[(2, 1)],
    );
    let a = b.try_inverse()? * j;
    let gamma = (a.transpose() * a).symmetric_eigenvalues().max().sqrt();
    let upper = a / gamma;
    let (c1, c2) = (upper.column(0), upper.column(1));
    let b1 = (1.0 - c1.norm_squared()).max(0.0).sqrt();
    let b2 = (1.0 - c2.norm_squared()).max(0.0).sqrt() * if c1.dot(&c2) > 0.0 { -1.0 } else { 1.0 };
    let rotation = |sign: f64| {
        let x = Vector3::new(c1[0], c1[1], sign * b1);
        let y = Vector3::new(c2[0], c2[1], sign * b2);
        r_v * Matrix3::from_columns(&[x, y, x.cross(&y)])
    };
    let both = [rotation(1.0), rotation(-1.0)];
    both.iter().all(|r| r.iter().all(|x| x.is_finite())).then_some(both)
}

/// Translation for a given rotation: `x t_z - t_x = (R p)_x - x (R p)_z` for every point, in least
/// squares.
pub(super) fn translation(
    r: &Matrix3<f64>,
    from: &[Vector2<f64>],
    to: &[Vector2<f64>],
) -> Option<Vector3<f64>> {
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (a, n) in from.iter().zip(to) {
        let p = r * a.push(0.0);
        for (row, value) in [
            (Vector3::new(-1.0, 0.0, n.x), p.x - n.x * p.z),
            (Vector3::new(0.0, -1.0, n.y), p.y - n.y * p.z),
        ] {
            normal += row * row.transpose();
            right += row * value;
        }
    }
    normal.cholesky().map(|c| c.solve(&right))
}
