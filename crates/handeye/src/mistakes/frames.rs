//! Do image and scan put the board at one position? Scale, tilt and shift between their frames.
//!
//! A plane is `m·p = 1`. The image's pose of the board has `m = n/(n·t)`, the scan's corners have
//! it as their plane. If the scan reads a point `p` of the image's frame at `(1 + σ) R p + t`, then
//! to first order in `σ`, `R = exp(ω)` and `t`
//!
//! ```text
//! m_scan - m_image = ω x m - σ m - m (m·t)
//! ```
//!
//! Boards in three directions and at several distances tell all seven. The noise of both planes is
//! known; where captures scatter more than that, it counts for as much more. Scale, tilt and shift
//! enter one after the other, the one that explains most first, for as long as one explains more than
//! noise can: so that a shift is not spread over all three.

use nalgebra::{Matrix3, Matrix3x6, Rotation3, SMatrix, SVector, Vector3};

use super::thresholds::{FEWEST, IMPROBABLE_FRAME, SEPARABLE};
use crate::{
    Camera, Pose, Target, TargetPose,
    math::{lie, statistics},
};

/// One capture's board, as image and scan see it.
pub struct TwoPlanes {
    /// `n/(n·t)` of the image's pose, 1/m, and covariance.
    pub image: (Vector3<f64>, Matrix3<f64>),
    /// The same of the scan.
    pub scan: (Vector3<f64>, Matrix3<f64>),
}

/// What the frames differ in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// `σ`.
    Scale,
    /// `ω`.
    Tilt,
    /// `t`.
    Shift,
}

impl Part {
    const ALL: [Self; 3] = [Self::Scale, Self::Tilt, Self::Shift];

    /// Its unknowns among the seven.
    fn range(self) -> std::ops::Range<usize> {
        match self {
            Self::Scale => 0..1,
            Self::Tilt => 1..4,
            Self::Shift => 4..7,
        }
    }
}

/// How scan and image differ.
#[derive(Debug, Clone, PartialEq)]
pub struct Frames {
    /// `σ, ω (rad), t (m)`: the scan's minus the image's. Parts that are proven are estimated
    /// together, with the others zero; each other one beside them.
    pub values: SVector<f64, 7>,
    /// Standard deviations.
    pub sigmas: SVector<f64, 7>,
    /// Covariance of the parts that are proven; zero in the others.
    pub covariance: SMatrix<f64, 7, 7>,
    /// Parts that are more than noise, the one that explains most first.
    pub proven: Vec<Part>,
    /// Whether the captures tell these parts from the others: each of them stands with all seven free.
    pub separable: bool,
    /// Chance that noise makes frames that agree differ so.
    pub chance: f64,
}

/// Times that the equations are made anew where the answer is.
const ITERATIONS: usize = 3;
/// Prior standard deviations of scale, tilt (rad) and shift (m): the frames of one camera lie in one housing.
const PRIOR: [f64; 7] = [0.05, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1];

type Seven = SMatrix<f64, 7, 7>;

struct Normal {
    h: Seven,
    g: SVector<f64, 7>,
    cost: f64,
}

impl Normal {
    /// Estimate of some unknowns with the others zero, their covariance, and the gain of the cost.
    fn solve(&self, which: &[usize]) -> Option<(SVector<f64, 7>, Seven, f64)> {
        let mut h = Seven::identity();
        let mut g = SVector::<f64, 7>::zeros();
        for &a in which {
            g[a] = self.g[a];
            for &b in which {
                h[(a, b)] = self.h[(a, b)];
            }
            h[(a, a)] += PRIOR[a].powi(-2);
        }
        let factor = h.cholesky()?;
        let x = factor.solve(&g);
        Some((x, factor.inverse(), g.dot(&x)))
    }
}

/// How the frames of images and scans differ; `None` where captures are too few.
pub fn frames(captures: &[TwoPlanes]) -> Option<Frames> {
    let mut near = SVector::zeros();
    let mut found = about(captures, &near)?;
    for _ in 0..ITERATIONS {
        near = found.values;
        Part::ALL
            .into_iter()
            .filter(|p| !found.proven.contains(p))
            .for_each(|p| p.range().for_each(|k| near[k] = 0.0));
        found = about(captures, &near)?;
    }
    Some(found)
}

/// The same from equations about `near`.
fn about(captures: &[TwoPlanes], near: &SVector<f64, 7>) -> Option<Frames> {
    let normal = normal(captures, near)?;
    let all: Vec<usize> = (0..7).collect();
    let (_, _, gain) = normal.solve(&all)?;
    let freedom = 3.0 * captures.len() as f64 - 7.0;
    let excess = ((normal.cost - gain) / freedom).max(1.0);
    let unknowns = |parts: &[Part]| parts.iter().flat_map(|p| p.range()).collect::<Vec<_>>();
    let gain_of = |parts: &[Part]| Some(normal.solve(&unknowns(parts))?.2 / excess);
    let mut proven: Vec<Part> = vec![];
    loop {
        let before = gain_of(&proven)?;
        let rest = Part::ALL.into_iter().filter(|p| !proven.contains(p));
        let improbable = |p: Part| {
            let after = gain_of(&[proven.as_slice(), &[p]].concat())?;
            Some((
                statistics::of_f(
                    (after - before) / p.range().len() as f64,
                    (p.range().len() as f64, freedom),
                ),
                p,
            ))
        };
        let best = rest.filter_map(improbable).min_by(|a, b| a.0.total_cmp(&b.0));
        match best {
            Some((chance, part)) if chance < IMPROBABLE_FRAME => proven.push(part),
            _ => break,
        }
    }
    let (mut values, mut sigmas) = (SVector::zeros(), SVector::zeros());
    for part in Part::ALL {
        let beside: Vec<Part> = if proven.contains(&part) {
            proven.clone()
        } else {
            [proven.as_slice(), &[part]].concat()
        };
        let (x, covariance, _) = normal.solve(&unknowns(&beside))?;
        for k in part.range() {
            (values[k], sigmas[k]) = (x[k], (covariance[(k, k)] * excess).sqrt());
        }
    }
    let (_, together, _) = normal.solve(&unknowns(&proven))?;
    let named = unknowns(&proven);
    let known = |i: usize, j: usize| named.contains(&i) && named.contains(&j);
    let covariance =
        SMatrix::from_fn(|i, j| if known(i, j) { together[(i, j)] * excess } else { 0.0 });
    let chance = statistics::of_f(gain / excess / 7.0, (7.0, freedom));
    let (free, of_all, _) = normal.solve(&all)?;
    let stands =
        |p: &Part| p.range().any(|k| free[k].abs() > SEPARABLE * (of_all[(k, k)] * excess).sqrt());
    let separable = proven.iter().all(stands);
    Some(Frames { values, sigmas, covariance, proven, separable, chance })
}

/// The equations about a difference of the frames that is near.
fn normal(captures: &[TwoPlanes], near: &SVector<f64, 7>) -> Option<Normal> {
    if captures.len() < FEWEST {
        return None;
    }
    let mut sum = Normal { h: Seven::zeros(), g: SVector::zeros(), cost: 0.0 };
    for c in captures {
        let m = moved(&c.image.0, near);
        let w = (c.scan.1 + c.image.1).cholesky()?.inverse();
        let mut j = SMatrix::<f64, 3, 7>::zeros();
        j.fixed_view_mut::<3, 1>(0, 0).copy_from(&-m);
        j.fixed_view_mut::<3, 3>(0, 1).copy_from(&-lie::hat(&m));
        j.fixed_view_mut::<3, 3>(0, 4).copy_from(&(-m * m.transpose()));
        let r = c.scan.0 - m + j * near;
        sum.h += j.transpose() * w * j;
        sum.g += j.transpose() * (w * r);
        sum.cost += r.dot(&(w * r));
    }
    sum.cost.is_finite().then_some(sum)
}

/// The plane as the scan has it: `R m/(1 + σ + t·R m)`.
fn moved(m: &Vector3<f64>, by: &SVector<f64, 7>) -> Vector3<f64> {
    let rotated = Rotation3::new(by.fixed_rows::<3>(1).into_owned()) * m;
    rotated / (1.0 + by[0] + rotated.dot(&by.fixed_rows::<3>(4)))
}

/// The plane of a board in the pose that an image tells; `None` without covariance.
pub fn plane_of_pose(pose: &TargetPose) -> Option<(Vector3<f64>, Matrix3<f64>)> {
    let p: &Pose<Camera, Target> = &pose.camera_from_target;
    let (r, t) = (p.rotation(), p.translation());
    let n: Vector3<f64> = r.column(2).into_owned();
    let d = n.dot(&t);
    // δn = R (ω x z), δd = δn·t + n·R ν
    let by_turn = -r * lie::hat(&Vector3::z());
    let mut j = Matrix3x6::zeros();
    let of_d = |by: Matrix3<f64>| n * (by.transpose() * t).transpose() / (d * d);
    j.fixed_view_mut::<3, 3>(0, 0).copy_from(&(by_turn / d - of_d(by_turn)));
    j.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-n * n.transpose() * r / (d * d)));
    let covariance = j * pose.covariance? * j.transpose();
    (d > 0.0 && covariance.iter().all(|x| x.is_finite())).then_some((n / d, covariance))
}

/// The plane of a board through its corners in a scan, each with its covariance (m, m²).
pub fn plane_of_points(
    points: &[(Vector3<f64>, Matrix3<f64>)],
) -> Option<(Vector3<f64>, Matrix3<f64>)> {
    let count = points.len() as f64;
    let middle = points.iter().map(|p| p.0).sum::<Vector3<f64>>() / count;
    let mut m = middle / middle.norm_squared();
    let mut information = Matrix3::zeros();
    let mut excess = 1.0;
    for _ in 0..3 {
        let (mut a, mut b, mut cost) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
        for (p, s) in points {
            let w = m.dot(&(s * m)).max(f64::MIN_POSITIVE).recip();
            a += p * p.transpose() * w;
            b += p * w;
            cost += w * (m.dot(p) - 1.0).powi(2);
        }
        m = a.cholesky()?.solve(&b);
        information = a;
        excess = (cost / (count - 3.0).max(1.0)).max(1.0);
    }
    let covariance = information.cholesky()?.inverse() * excess;
    (points.len() > 3 && covariance.iter().all(|x| x.is_finite())).then_some((m, covariance))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::Matrix6;

    /// Boards seen by an image and a scan whose frame differs by `x`.
    fn captures(x: &SVector<f64, 7>, count: usize, seed: u64) -> Vec<TwoPlanes> {
        let mut random = Random::new(seed);
        let turn = Rotation3::new(Vector3::new(x[1], x[2], x[3]));
        let shift = Vector3::new(x[4], x[5], x[6]);
        let mut one = || {
            let rotation = Rotation3::new(random.normal3() * 0.35);
            let t = Vector3::new(0.0, 0.0, random.between(0.5, 0.9)) + random.normal3() * 0.05;
            let pose: Pose<Camera, Target> = Pose::from_parts(rotation.matrix(), t);
            let point = |k: usize| {
                let at = Vector3::new((k % 9) as f64 * 0.025, (k / 9) as f64 * 0.025, 0.0);
                (turn * (rotation * at + t)) * (1.0 + x[0]) + shift
            };
            let s = 1e-4;
            let scan: Vec<(Vector3<f64>, Matrix3<f64>)> = (0..54)
                .map(point)
                .map(|p| (p + random.normal3() * s, Matrix3::identity() * s * s))
                .collect();
            let sigmas = [1e-3, 1e-3, 2e-4, 5e-5, 5e-5, 2e-4];
            let covariance =
                Matrix6::from_diagonal(&nalgebra::Vector6::from(sigmas.map(|s| s * s)));
            let noise = nalgebra::Vector6::from(sigmas.map(|s| s * random.normal()));
            let seen = TargetPose {
                camera_from_target: pose.retract(&noise),
                covariance: Some(covariance),
            };
            TwoPlanes {
                image: plane_of_pose(&seen).unwrap(),
                scan: plane_of_points(&scan).unwrap(),
            }
        };
        (0..count).map(|_| one()).collect()
    }

    fn shifted(k: usize, by: f64) -> SVector<f64, 7> {
        let mut x = SVector::zeros();
        x[k] = by;
        x
    }

    #[test]
    fn frames_that_agree_prove_nothing() {
        for seed in 0..60 {
            let found = frames(&captures(&SVector::zeros(), 12, seed)).unwrap();
            assert!(found.proven.is_empty(), "{seed}: {found:?}");
        }
    }

    #[test]
    fn each_part_is_found_and_only_that() {
        for (k, by, part) in
            [(0, 0.006, Part::Scale), (1, 0.012, Part::Tilt), (4, 0.004, Part::Shift)]
        {
            for seed in 0..20 {
                let found = frames(&captures(&shifted(k, by), 14, seed)).unwrap();
                assert_eq!(found.proven, [part], "{seed}: {found:?}");
                let off = found.values[k] - by;
                assert!(off.abs() < 4.5 * found.sigmas[k], "{seed}: {off} {found:?}");
            }
        }
    }

    #[test]
    fn a_large_tilt_does_not_pass_for_a_scale() {
        let found = frames(&captures(&shifted(1, 0.1), 14, 1)).unwrap();
        assert_eq!(found.proven, [Part::Tilt], "{found:?}");
        assert!((found.values[1] - 0.1).abs() < 4.0 * found.sigmas[1], "{found:?}");
    }

    #[test]
    fn estimates_stay_inside_their_uncertainty() {
        let truth = SVector::<f64, 7>::from([0.004, 0.01, -0.006, 0.008, 0.004, -0.003, 0.005]);
        let (mut sum, mut count) = (0.0, 0.0);
        for seed in 0..60 {
            let found = frames(&captures(&truth, 25, seed)).unwrap();
            if found.proven.len() == 3 {
                let off = (found.values - truth).component_div(&found.sigmas);
                (sum, count) = (sum + off.norm_squared() / 7.0, count + 1.0);
            }
        }
        assert!(count > 20.0 && (0.7..1.35).contains(&(sum / count)), "{} of {count}", sum / count);
    }

    #[test]
    fn few_captures_tell_nothing() {
        assert_eq!(frames(&captures(&SVector::zeros(), 3, 1)), None);
    }
}
