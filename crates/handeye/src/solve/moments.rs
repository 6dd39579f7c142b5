//! Sums over all motions between captures, from sums over the captures: linear in their number.
//!
//! A capture is written from the first: `A_i ← A_0⁻¹ A_i`, `B_i ← B_0⁻¹ B_i`; this leaves every
//! motion `A_ij = A_j⁻¹ A_i` as it is. What a paper sums over motions is bilinear in the two
//! captures of a motion, so the sum over all pairs factors into moments of single captures. For
//! quaternions `a_ij = a_j* a_i`, with `M = Σ_i a_i b_iᵀ = [μ rᵀ; c N]` (scalar first),
//!
//! ```text
//! Σ_{i<j} vec(a_ij) vec(b_ij)ᵀ = μ N - c rᵀ + cof N + N [r]ₓ - [c]ₓ N
//! Σ_{i<j} |Q(a_ij) x - W(b_ij) x|² = n² - |Sᵀ x|²              S = Σ_i Q(a_i)ᵀ W(b_i)
//! ```
//!
//! where `Q(a) x = a x` and `W(b) x = x b`. A quaternion and its negative are the same rotation:
//! the signs are chosen per capture such that `a_ij` and `b_ij` of every motion have scalar parts
//! of the same sign, by a vote of all captures. Chosen per motion, as is common, noise decides the
//! sign near a half turn, where the scalar part vanishes.

use nalgebra::{Isometry3, Matrix3, Matrix4, SMatrix, UnitQuaternion, Vector3, Vector4};

use super::shared::open;
use crate::{Error, PosePair, math::jacobi};

/// A capture seen from the first one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    /// Quaternion of the mount, scalar first.
    pub a: Vector4<f64>,
    /// Where the mount is, m.
    pub t_a: Vector3<f64>,
    /// Quaternion of the camera, scalar first.
    pub b: Vector4<f64>,
    /// Where the camera is, m.
    pub t_b: Vector3<f64>,
}

/// Votes below this do not tell a sign: every motion to the rest is a half turn.
const NO_VOTE: f64 = 1e-12;

/// The captures seen from the first, with signs of quaternions that agree.
///
/// # Errors
/// When half turns leave the signs open: then two rotations of the camera fit equally well.
pub(super) fn seen(pairs: &[PosePair]) -> Result<Vec<Seen>, Error> {
    let mut all = from_first(pairs);
    let mut votes = Matrix4::zeros();
    let mut open: Vec<usize> = (0..all.len()).collect();
    while !open.is_empty() {
        let before = open.len();
        open.retain(|&i| {
            let vote = all[i].b.dot(&(votes * all[i].a));
            let decided = i == 0 || vote.abs() > NO_VOTE;
            if decided {
                if vote < 0.0 {
                    all[i].b = -all[i].b;
                }
                votes += all[i].b * all[i].a.transpose();
            }
            !decided
        });
        if open.len() == before {
            return Err(Error::NotDetermined {
                what: "captures differ from the others by half turns only, and then two rotations \
                       of the camera fit equally well; add captures tilted by other angles"
                    .into(),
            });
        }
    }
    vote_again(&mut all, votes);
    Ok(all)
}

/// Lets all captures vote on each sign, until none changes.
fn vote_again(all: &mut [Seen], mut votes: Matrix4<f64>) {
    for _ in 0..5 {
        let mut changed = false;
        for s in all.iter_mut() {
            if s.b.dot(&(votes * s.a)) < 1.0 - NO_VOTE {
                // its own vote is 1
                votes -= s.b * s.a.transpose() * 2.0;
                s.b = -s.b;
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
}

fn from_first(pairs: &[PosePair]) -> Vec<Seen> {
    let Some(first) = pairs.first() else { return Vec::new() };
    let a_0 = first.anchor_from_mount.inverse();
    pairs
        .iter()
        .map(|p| {
            let a = a_0 * p.anchor_from_mount;
            let b = first.camera_from_target * p.camera_from_target.inverse(); // B_0⁻¹ B_i
            Seen {
                a: scalar_first(&a.iso().rotation),
                t_a: a.translation(),
                b: scalar_first(&b.iso().rotation),
                t_b: b.translation(),
            }
        })
        .collect()
}

pub(super) fn scalar_first(q: &UnitQuaternion<f64>) -> Vector4<f64> {
    Vector4::new(q.w, q.i, q.j, q.k)
}

/// The vector part of a quaternion.
pub(super) fn vector(q: &Vector4<f64>) -> Vector3<f64> {
    Vector3::new(q[1], q[2], q[3])
}

/// `p* q`.
#[inline]
pub(super) fn between(p: &Vector4<f64>, q: &Vector4<f64>) -> Vector4<f64> {
    Vector4::new(
        p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3],
        p[0] * q[1] - p[1] * q[0] - p[2] * q[3] + p[3] * q[2],
        p[0] * q[2] - p[2] * q[0] - p[3] * q[1] + p[1] * q[3],
        p[0] * q[3] - p[3] * q[0] - p[1] * q[2] + p[2] * q[1],
    )
}

/// `p q`.
pub(super) fn product(p: &Vector4<f64>, q: &Vector4<f64>) -> Vector4<f64> {
    between(&Vector4::new(p[0], -p[1], -p[2], -p[3]), q)
}

/// `Q(p)`: `Q(p) x = p x`.
#[rustfmt::skip]
pub(super) fn left(p: &Vector4<f64>) -> Matrix4<f64> {
    Matrix4::new(
        p[0], -p[1], -p[2], -p[3],
        p[1],  p[0], -p[3],  p[2],
        p[2],  p[3],  p[0], -p[1],
        p[3], -p[2],  p[1],  p[0],
    )
}

/// `W(p)`: `W(p) x = x p`.
#[rustfmt::skip]
pub(super) fn right(p: &Vector4<f64>) -> Matrix4<f64> {
    Matrix4::new(
        p[0], -p[1], -p[2], -p[3],
        p[1],  p[0],  p[3], -p[2],
        p[2], -p[3],  p[0],  p[1],
        p[3],  p[2], -p[1],  p[0],
    )
}

/// Rotation matrix of a unit quaternion, scalar first.
#[rustfmt::skip]
pub(super) fn matrix(q: &Vector4<f64>) -> Matrix3<f64> {
    let (w, x, y, z) = (q[0], q[1], q[2], q[3]);
    Matrix3::new(
        1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y),
        2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x),
        2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y),
    )
}

/// `S = Σ Q(a)ᵀ W(b)`, with `S y = n x` for exact captures.
pub(super) fn loops(all: &[Seen]) -> Matrix4<f64> {
    all.iter().map(|s| left(&s.a).transpose() * right(&s.b)).sum()
}

/// `Σ_{i<j} vec(a_ij) vec(b_ij)ᵀ` from `M = Σ a_i b_iᵀ`.
pub(super) fn over_motions(m: &Matrix4<f64>) -> Matrix3<f64> {
    let n: Matrix3<f64> = m.fixed_view::<3, 3>(1, 1).into_owned();
    let c = Vector3::new(m[(1, 0)], m[(2, 0)], m[(3, 0)]);
    let r = Vector3::new(m[(0, 1)], m[(0, 2)], m[(0, 3)]);
    let (r0, r1, r2) = (n.row(0).transpose(), n.row(1).transpose(), n.row(2).transpose());
    let cofactors =
        Matrix3::from_columns(&[r1.cross(&r2), r2.cross(&r0), r0.cross(&r1)]).transpose();
    n * m[(0, 0)] - c * r.transpose() + cofactors + n * r.cross_matrix() - c.cross_matrix() * n
}

/// The same for products of two different moments: `f(M + N) - f(M) - f(N)`.
pub(super) fn over_motions_of_two(m: &Matrix4<f64>, n: &Matrix4<f64>) -> Matrix3<f64> {
    over_motions(&(m + n)) - over_motions(m) - over_motions(n)
}

/// `Σ_{i<j} vec(a_ij) vec(a_ij)ᵀ` of the mount: scatter of half chords, rad²/4 for small angles.
pub(super) fn axis_moment(pairs: &[PosePair]) -> Matrix3<f64> {
    let Some(first) = pairs.first() else { return Matrix3::zeros() };
    let inverse = first.anchor_from_mount.iso().rotation.inverse();
    let m: Matrix4<f64> = pairs
        .iter()
        .map(|p| scalar_first(&(inverse * p.anchor_from_mount.iso().rotation)))
        .map(|q| q * q.transpose())
        .sum();
    over_motions(&m)
}

/// The least-squares sums of `R_X t_B + (I - R_A) t_X = t_A` over motions.
#[derive(Debug, Clone, Copy)]
pub(super) struct Translations {
    /// `Σ t_B t_Bᵀ`.
    pub bb: Matrix3<f64>,
    /// `Σ t_B ⊗ (I - R_A)`.
    pub bt: SMatrix<f64, 9, 3>,
    /// `Σ (I - R_A)ᵀ (I - R_A)`.
    pub tt: Matrix3<f64>,
    /// `Σ t_A t_Bᵀ`.
    pub ab: Matrix3<f64>,
    /// `Σ (I - R_A)ᵀ t_A`.
    pub at: Vector3<f64>,
}

impl Translations {
    pub fn zeros() -> Self {
        Self {
            bb: Matrix3::zeros(),
            bt: SMatrix::zeros(),
            tt: Matrix3::zeros(),
            ab: Matrix3::zeros(),
            at: Vector3::zeros(),
        }
    }

    /// Over all motions from `i` to a later `j`. The sum over `i` of everything that belongs to
    /// one `j` comes from running sums of the captures before it.
    pub(crate) fn of_all(all: &[Seen]) -> Self {
        let mut sums = Self::zeros();
        let (mut n, mut s, mut m_a, mut m_b) =
            (0.0, Matrix3::zeros(), Vector3::zeros(), Vector3::zeros());
        let (mut m_bb, mut m_ab, mut m_br) =
            (Matrix3::zeros(), Matrix3::zeros(), [Matrix3::<f64>::zeros(); 3]);
        let mut m_ra = Vector3::zeros();
        for p in all {
            let (r_a, r_b, t_a, t_b) = (matrix(&p.a), matrix(&p.b), p.t_a, p.t_b);
            // Σ (t_bi - t_bj)(t_bi - t_bj)ᵀ and Σ (t_ai - t_aj)(t_bi - t_bj)ᵀ
            let bb =
                m_bb - t_b * m_b.transpose() - m_b * t_b.transpose() + t_b * t_b.transpose() * n;
            let ab =
                m_ab - t_a * m_b.transpose() - m_a * t_b.transpose() + t_a * t_b.transpose() * n;
            sums.bb += r_b.transpose() * bb * r_b;
            sums.ab += r_a.transpose() * ab * r_b;
            // Σ (t_bi - t_bj)_d R_jᵀ (R_j - R_i)
            let by_axis: [Matrix3<f64>; 3] = std::array::from_fn(|d| {
                r_a.transpose() * (r_a * (m_b[d] - n * t_b[d]) - m_br[d] + s * t_b[d])
            });
            for c in 0..3 {
                let block =
                    by_axis[0] * r_b[(0, c)] + by_axis[1] * r_b[(1, c)] + by_axis[2] * r_b[(2, c)];
                let mut view = sums.bt.fixed_view_mut::<3, 3>(3 * c, 0);
                view += block;
            }
            // Σ (R_j - R_i)ᵀ (t_ai - t_aj)
            sums.at += r_a.transpose() * (m_a - t_a * n) - m_ra + s.transpose() * t_a;
            let mixed = r_a.transpose() * s;
            sums.tt += Matrix3::identity() * (2.0 * n) - mixed - mixed.transpose();
            n += 1.0;
            s += r_a;
            m_a += t_a;
            m_b += t_b;
            m_bb += t_b * t_b.transpose();
            m_ab += t_a * t_b.transpose();
            m_ra += r_a.transpose() * t_a;
            for d in 0..3 {
                m_br[d] += r_a * t_b[d];
            }
        }
        sums
    }

    /// Adds the motion from `i` to `j`, `weight` times.
    pub fn add(&mut self, i: &Seen, j: &Seen, weight: f64) {
        let (a, b) = (motion(&i.a, &i.t_a, &j.a, &j.t_a), motion(&i.b, &i.t_b, &j.b, &j.t_b));
        let (r_a, t_a, t_b) = (matrix(&a.0), a.1, b.1);
        let lever = Matrix3::identity() - r_a;
        self.bb += t_b * t_b.transpose() * weight;
        self.ab += t_a * t_b.transpose() * weight;
        for c in 0..3 {
            let mut view = self.bt.fixed_view_mut::<3, 3>(3 * c, 0);
            view += lever * (t_b[c] * weight);
        }
        self.tt += lever.transpose() * lever * weight;
        self.at += lever.transpose() * t_a * weight;
    }

    /// `t_X` of least squares, once `R_X` is known.
    pub fn solve(&self, r_x: &Matrix3<f64>) -> Option<Vector3<f64>> {
        let x = SMatrix::<f64, 9, 1>::from_column_slice(r_x.as_slice());
        let rhs = self.at - self.bt.transpose() * x;
        let (values, vectors) = jacobi::eigen(&self.tt);
        let fixed = values[2] > NO_LEVER * values[0];
        let inverse = |v: Vector3<f64>| vectors * (vectors.transpose() * v).component_div(&values);
        let t = inverse(rhs);
        fixed.then(|| t + inverse(rhs - self.tt * t))
    }
}

/// Least over largest eigenvalue of `Σ (I - R_A)ᵀ (I - R_A)` below which a position is free.
pub(super) const NO_LEVER: f64 = 1e-13;

/// Quaternion and translation of the motion from `i` to `j`.
pub(super) fn motion(
    q_i: &Vector4<f64>,
    t_i: &Vector3<f64>,
    q_j: &Vector4<f64>,
    t_j: &Vector3<f64>,
) -> (Vector4<f64>, Vector3<f64>) {
    (between(q_j, q_i), matrix(q_j).transpose() * (t_i - t_j))
}

/// `X` from its rotation, with the position of least squares over `motions`.
pub(super) fn with_position(
    rotation: UnitQuaternion<f64>,
    motions: &Translations,
) -> Result<Isometry3<f64>, Error> {
    let t = motions
        .solve(&rotation.to_rotation_matrix().into_inner())
        .ok_or_else(|| open("the motions do not fix the camera's position"))?;
    Ok(Isometry3::from_parts(t.into(), rotation))
}

/// Cholesky solution of a small symmetric system, refined once.
pub(super) fn solve_spd<const N: usize>(
    m: &SMatrix<f64, N, N>,
    rhs: &SMatrix<f64, N, 1>,
) -> Option<SMatrix<f64, N, 1>> {
    let factor = cholesky(m)?;
    let x = substitute(&factor, rhs);
    Some(x + substitute(&factor, &(rhs - m * x)))
}

/// Pivots this small beside the diagonal they started from count as zero.
const NO_PIVOT: f64 = 1e-13;

/// Lower `L` with `L Lᵀ = m`; `None` when `m` is singular.
fn cholesky<const N: usize>(m: &SMatrix<f64, N, N>) -> Option<SMatrix<f64, N, N>> {
    let mut l = *m;
    for k in 0..N {
        let pivot = l[(k, k)];
        if !(pivot > NO_PIVOT * m[(k, k)]) {
            return None;
        }
        let root = pivot.sqrt();
        for i in k..N {
            l[(i, k)] /= root;
        }
        for j in k + 1..N {
            let factor = l[(j, k)];
            for i in j..N {
                l[(i, j)] -= l[(i, k)] * factor;
            }
        }
    }
    Some(l)
}

fn substitute<const N: usize>(
    l: &SMatrix<f64, N, N>,
    rhs: &SMatrix<f64, N, 1>,
) -> SMatrix<f64, N, 1> {
    let mut x = *rhs;
    for k in 0..N {
        x[k] /= l[(k, k)];
        for i in k + 1..N {
            x[i] -= l[(i, k)] * x[k];
        }
    }
    for k in (0..N).rev() {
        for i in k + 1..N {
            x[k] -= l[(i, k)] * x[i];
        }
        x[k] /= l[(k, k)];
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::tests::{noisy_pairs, truths};

    fn motions(all: &[Seen]) -> impl Iterator<Item = (&Seen, &Seen)> {
        (1..all.len()).flat_map(move |j| all[..j].iter().map(move |i| (i, &all[j])))
    }

    #[test]
    fn moments_of_captures_are_sums_over_all_motions() {
        let all = seen(&noisy_pairs(&truths()[0], 9)).unwrap();
        let by_moments = over_motions(&all.iter().map(|s| s.a * s.b.transpose()).sum());
        let one_by_one: Matrix3<f64> = motions(&all)
            .map(|(i, j)| vector(&between(&j.a, &i.a)) * vector(&between(&j.b, &i.b)).transpose())
            .sum();
        assert!((by_moments - one_by_one).norm() < 1e-13 * one_by_one.norm());
    }

    #[test]
    fn the_form_of_loops_is_the_sum_over_all_motions() {
        let all = seen(&noisy_pairs(&truths()[0], 9)).unwrap();
        let s = loops(&all);
        let n = all.len() as f64;
        let one_by_one: Matrix4<f64> = motions(&all)
            .map(|(i, j)| left(&between(&j.a, &i.a)) - right(&between(&j.b, &i.b)))
            .map(|g| g.transpose() * g)
            .sum();
        let by_moments = Matrix4::identity() * (n * n) - s * s.transpose();
        assert!((by_moments - one_by_one).norm() < 1e-13 * n * n);
    }

    #[test]
    fn translations_of_all_motions_are_those_of_each() {
        let all = seen(&noisy_pairs(&truths()[0], 9)).unwrap();
        let by_moments = Translations::of_all(&all);
        let mut one_by_one = Translations::zeros();
        motions(&all).for_each(|(i, j)| one_by_one.add(i, j, 1.0));
        assert!((by_moments.bb - one_by_one.bb).norm() < 1e-12);
        assert!((by_moments.bt - one_by_one.bt).norm() < 1e-12);
        assert!((by_moments.tt - one_by_one.tt).norm() < 1e-12);
        assert!((by_moments.ab - one_by_one.ab).norm() < 1e-12);
        assert!((by_moments.at - one_by_one.at).norm() < 1e-12);
    }
}
