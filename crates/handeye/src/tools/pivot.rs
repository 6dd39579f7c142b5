//! The tip of a tool from a pivot: the flange turns about a tip that stays on one point.
//!
//! ```text
//! R_i τ + t_i = p          [R_i  -I] (τ, p) = -t_i
//! ```
//!
//! with `base_from_flange = (R_i, t_i)`, the tip `τ` in the flange and the point `p` in the base:
//! linear least squares over all poses. What the rotations do not tell is the null space of
//! `Σ (R_i - R̄)ᵀ(R_i - R̄)`: poses that turn about one axis leave the tip along it free.
//!
//! Read the other way round (`flange_from_base`) the same poses obey the same equation with `τ` and
//! `p` exchanged, and with the same residuals: no pivot tells the direction of its poses.
//!
//! Poses that do not belong are found from the triples that fit best and are named by an F-test on
//! what the others predict. Z. Yaniv, *Which pivot calibration?*, SPIE Medical Imaging 9415, 2015;
//! R. Cook and S. Weisberg, *Residuals and Influence in Regression*, 1982, chapter 2.

use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, SMatrix, Vector3, Vector6};
use serde::Serialize;

use crate::{
    Base, Error, Flange, Point, Pose, Verdict,
    estimate::observability::axis_name,
    math::{linalg, statistics, subsets},
};

/// Fewest poses: with three a wrong one cannot be told from the others.
pub const FEWEST_POSES: usize = 4;
/// Standard deviation (m) beyond which a direction of the tip counts as not determined.
const FREE_M: f64 = 20e-3;
/// Root mean square turn (rad) below which a direction counts as not seen at all: 1 degree, what
/// the robot's own error makes of a turn about one axis.
const NO_TURN: f64 = 0.0175;
/// Chance that a good pose is called wrong, shared among all poses.
const FALSE_ALARM: f64 = 2e-3;
/// What poses are rounded to when they are written, m: no residual means less.
const ROUNDING_M: f64 = 1e-6;
/// Axes this much in a free direction are free themselves.
const TOUCHED_BY_FREE: f64 = 0.02;

/// Where the tip sits.
#[derive(Debug, Clone, PartialEq)]
pub struct Pivot {
    /// Whether it can be used.
    pub verdict: Verdict,
    /// Why, most important first.
    pub reasons: Vec<String>,
    /// The tip, of smallest length where a direction is free.
    pub tip_in_flange: Point<Flange>,
    /// Axes of the flange along which the tip is determined.
    pub tip_known: [bool; 3],
    /// Covariance (m²) of the tip in the flange, widened for few poses; `None` where one is free.
    pub tip_covariance: Option<Matrix3<f64>>,
    /// The point on which it stood.
    pub point_in_base: Point<Base>,
    /// Axes of the base along which the point is determined.
    pub point_known: [bool; 3],
    /// Covariance (m²) of the point in the base; `None` where one is free.
    pub point_covariance: Option<Matrix3<f64>>,
    /// Standard deviation (m, each axis) of one pose's tip about the point.
    pub sigma: f64,
    /// Tip minus point of every pose (m, in the base), also of poses that were left out.
    pub residuals: Vec<Vector3<f64>>,
    /// The same when the answer was made without the pose; `None` where that leaves it open.
    pub held_out: Vec<Option<Vector3<f64>>>,
    /// Poses that were left out.
    pub rejected: Vec<usize>,
    /// Directions that the poses leave free, in words.
    pub undetermined: Vec<String>,
}

/// Length of residuals, m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Lengths {
    /// Root mean square.
    pub rms: f64,
    /// Largest.
    pub max: f64,
}

impl Lengths {
    /// Of some differences; `None` of none.
    pub fn of(all: impl Iterator<Item = Vector3<f64>>) -> Option<Self> {
        let lengths: Vec<f64> = all.map(|d| d.norm()).collect();
        let square = lengths.iter().map(|l| l * l).sum::<f64>() / lengths.len() as f64;
        let max = lengths.iter().copied().fold(0.0, f64::max);
        (!lengths.is_empty()).then_some(Self { rms: square.sqrt(), max })
    }
}

impl Pivot {
    /// Residuals of the poses that were used.
    pub fn spread(&self) -> Option<Lengths> {
        Lengths::of(self.used().map(|i| self.residuals[i]))
    }

    /// Residuals of the poses that were used, each against the answer of the others.
    pub fn held_out(&self) -> Option<Lengths> {
        let each: Option<Vec<_>> = self.used().map(|i| self.held_out[i]).collect();
        Lengths::of(each?.into_iter())
    }

    fn used(&self) -> impl Iterator<Item = usize> {
        (0..self.residuals.len()).filter(|i| !self.rejected.contains(i))
    }
}

/// Finds the tip. `most_spread` (m) is the root mean square distance of the tip from the point
/// beyond which the answer is rejected.
///
/// # Errors
/// [`Error::TooFewPoses`] below four, [`Error::NotFinite`] on NaN, [`Error::Invalid`] when a pose is
/// farther away than any robot reaches, [`Error::NotDetermined`] when the flange does not turn at all.
pub fn pivot(poses: &[Pose<Base, Flange>], most_spread: f64) -> Result<Pivot, Error> {
    check(poses)?;
    let all: Vec<usize> = (0..poses.len()).collect();
    if free_directions(&all, poses, 0.0).len() == 3 {
        let what = "the flange does not turn between the poses; turn it by 30 degrees and more \
                    about two axes, the tip on the point";
        return Err(Error::NotDetermined { what: what.into() });
    }
    let used = agreeing(poses);
    let fit = Fit::of(&used, poses);
    let free = free_directions(&used, poses, fit.sigma());
    let mut found = answer(poses, &used, &fit, &free);
    conclude(&mut found, most_spread);
    Ok(found)
}

fn check(poses: &[Pose<Base, Flange>]) -> Result<(), Error> {
    if poses.len() < FEWEST_POSES {
        return Err(Error::TooFewPoses {
            found: poses.len(),
            needed: FEWEST_POSES,
            advice:
                "lead the tip onto the same point from 6 to 10 directions, 30 degrees and more \
                     apart"
                    .into(),
        });
    }
    for (i, pose) in poses.iter().enumerate() {
        if !pose.is_finite() {
            return Err(Error::NotFinite { what: format!("pose {}", i + 1) });
        }
        if pose.is_too_far() {
            let what = format!("pose {} lies farther from the base than any robot reaches", i + 1);
            return Err(Error::Invalid(what));
        }
    }
    Ok(())
}

type Row = SMatrix<f64, 3, 6>;

/// `[R_i  -I]`.
fn row(pose: &Pose<Base, Flange>) -> Row {
    let mut row = Row::zeros();
    row.fixed_view_mut::<3, 3>(0, 0).copy_from(&pose.rotation());
    row.fixed_view_mut::<3, 3>(0, 3).copy_from(&-Matrix3::identity());
    row
}

/// Least squares over some poses, of smallest length where they leave a direction free.
struct Fit {
    tip_and_point: Vector6<f64>,
    /// `(JᵀJ)⁺`.
    inverse: Matrix6<f64>,
    sum_of_squares: f64,
    degrees_of_freedom: f64,
}

/// Singular values below this part of the largest are zero.
const SINGULAR: f64 = 1e-9;

impl Fit {
    fn of(used: &[usize], poses: &[Pose<Base, Flange>]) -> Self {
        // lengths from the middle of the flange positions: large coordinates cost digits
        let middle = middle(used, poses);
        let mut j = DMatrix::zeros(3 * used.len(), 6);
        let mut right = DVector::zeros(3 * used.len());
        for (k, &i) in used.iter().enumerate() {
            j.fixed_view_mut::<3, 6>(3 * k, 0).copy_from(&row(&poses[i]));
            right.fixed_rows_mut::<3>(3 * k).copy_from(&(middle - poses[i].translation()));
        }
        let svd = linalg::svd(&j);
        let (mut solution, mut inverse) = (DVector::zeros(6), DMatrix::zeros(6, 6));
        let mut rank = 0.0;
        for k in (0..6).filter(|&k| svd.s[k] > SINGULAR * svd.s[0]) {
            let v = svd.v.column(k);
            solution += v * (svd.u.column(k).dot(&right) / svd.s[k]);
            inverse += v * v.transpose() / svd.s[k].powi(2);
            rank += 1.0;
        }
        let sum_of_squares = (&j * &solution - &right).norm_squared();
        let mut tip_and_point = Vector6::from_column_slice(solution.as_slice());
        (0..3).for_each(|k| tip_and_point[3 + k] += middle[k]);
        Self {
            tip_and_point,
            inverse: Matrix6::from_column_slice(inverse.as_slice()),
            sum_of_squares,
            degrees_of_freedom: 3.0 * used.len() as f64 - rank,
        }
    }

    fn tip(&self) -> Vector3<f64> {
        self.tip_and_point.fixed_rows::<3>(0).into()
    }

    fn point(&self) -> Vector3<f64> {
        self.tip_and_point.fixed_rows::<3>(3).into()
    }

    /// Tip minus point.
    fn residual(&self, pose: &Pose<Base, Flange>) -> Vector3<f64> {
        pose.rotation() * self.tip() + pose.translation() - self.point()
    }

    fn sigma(&self) -> f64 {
        (self.sum_of_squares / self.degrees_of_freedom.max(1.0)).sqrt()
    }

    fn least_variance(&self) -> f64 {
        self.sigma().max(ROUNDING_M).powi(2)
    }

    /// Chance of a residual as large at a pose that was not used, if it belongs.
    fn chance(&self, pose: &Pose<Base, Flange>) -> f64 {
        let (e, j) = (self.residual(pose), row(pose));
        let spread = Matrix3::identity() + j * self.inverse * j.transpose();
        let square = linalg::invert_spd(&spread).map_or(0.0, |w| e.dot(&(w * e)));
        let f = square / 3.0 / self.least_variance();
        statistics::of_f(f, (3.0, self.degrees_of_freedom))
    }
}

fn middle(used: &[usize], poses: &[Pose<Base, Flange>]) -> Vector3<f64> {
    used.iter().map(|&i| poses[i].translation()).sum::<Vector3<f64>>() / used.len().max(1) as f64
}

/// The poses that belong to one point: from the best triple outwards, then tested one by one.
fn agreeing(poses: &[Pose<Base, Flange>]) -> Vec<usize> {
    let all: Vec<usize> = (0..poses.len()).collect();
    let limit = FALSE_ALARM / poses.len() as f64;
    let whole = without_outliers(all, poses, limit);
    let core = grown(best_core(poses), poses, limit);
    let core = without_outliers(core, poses, limit);
    // the larger agreement; of equals the closer one
    let spread = |used: &[usize]| Fit::of(used, poses).sigma();
    let tells = |used: &[usize]| 2 * used.len() > poses.len() && used.len() >= 3;
    if tells(&core) && core.len() < whole.len() && excludes(&core, &whole, poses) {
        return core;
    }
    if tells(&core) && core.len() == whole.len() && spread(&core) < spread(&whole) {
        return core;
    }
    whole
}

/// Whether the poses beyond the core are too far from it, for the best of all cores of its size.
fn excludes(core: &[usize], whole: &[usize], poses: &[Pose<Base, Flange>]) -> bool {
    let (few, all) = (Fit::of(core, poses), Fit::of(whole, poses));
    let more = all.degrees_of_freedom - few.degrees_of_freedom;
    let added = (all.sum_of_squares - few.sum_of_squares).max(0.0) / more.max(1.0);
    let degrees = (more.max(1.0), few.degrees_of_freedom.max(1.0));
    let chance = statistics::of_f(added / few.least_variance(), degrees);
    chance * choices(whole.len(), core.len()) < FALSE_ALARM
}

/// How many subsets of `k` there are of `n`.
fn choices(n: usize, k: usize) -> f64 {
    (0..k).map(|i| (n - i) as f64 / (i + 1) as f64).product()
}

/// Takes out the least probable pose until all that are left are probable.
fn without_outliers(mut used: Vec<usize>, poses: &[Pose<Base, Flange>], limit: f64) -> Vec<usize> {
    while used.len() >= FEWEST_POSES {
        let chance = |&k: &usize| {
            let others: Vec<usize> = used.iter().copied().filter(|&i| i != k).collect();
            let fit = Fit::of(&others, poses);
            (k, fit.chance(&poses[k]), fit.sum_of_squares)
        };
        let tested: Vec<_> = used.iter().map(chance).collect();
        // the one whose absence helps most: chances may all be zero
        let Some(worst) = tested.iter().min_by(|a, b| a.2.total_cmp(&b.2)) else { break };
        if worst.1 >= limit {
            break;
        }
        let gone = worst.0;
        used.retain(|&i| i != gone);
    }
    used
}

/// The half of the poses that the best triple predicts best.
fn best_core(poses: &[Pose<Base, Flange>]) -> Vec<usize> {
    let half = (poses.len() / 2 + 1).max(3);
    let mut best: Option<(f64, Vec<usize>)> = None;
    for triple in triples(poses.len()) {
        let fit = Fit::of(&triple, poses);
        let mut all: Vec<(f64, usize)> =
            poses.iter().enumerate().map(|(i, p)| (fit.residual(p).norm(), i)).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.truncate(half);
        let mut core: Vec<usize> = all.into_iter().map(|(_, i)| i).collect();
        core.sort_unstable();
        let cost = Fit::of(&core, poses).sum_of_squares;
        if best.as_ref().is_none_or(|(c, _)| cost < *c) {
            best = Some((cost, core));
        }
    }
    best.map_or_else(|| (0..poses.len()).collect(), |(_, core)| core)
}

/// Most triples that are tried.
const MOST_TRIPLES: usize = 400;

/// All triples of few poses, evenly taken ones of many.
fn triples(n: usize) -> impl Iterator<Item = [usize; 3]> {
    subsets::all(n).step_by((subsets::count(n, 3) / MOST_TRIPLES).max(1))
}

/// Takes in the most probable pose until none is left that belongs.
fn grown(mut core: Vec<usize>, poses: &[Pose<Base, Flange>], limit: f64) -> Vec<usize> {
    loop {
        let fit = Fit::of(&core, poses);
        let outside = (0..poses.len()).filter(|i| !core.contains(i));
        let next = outside
            .map(|i| (i, fit.chance(&poses[i])))
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .filter(|(_, chance)| *chance >= limit);
        match next {
            Some((i, _)) => core.push(i),
            None => break,
        }
    }
    core.sort_unstable();
    core
}

/// Directions of the tip, in the flange, that the turns of the poses do not tell.
fn free_directions(used: &[usize], poses: &[Pose<Base, Flange>], sigma: f64) -> Vec<Vector3<f64>> {
    let n = used.len() as f64;
    let mean = used.iter().map(|&i| poses[i].rotation()).sum::<Matrix3<f64>>() / n;
    let moment = |i: &usize| {
        let d = poses[*i].rotation() - mean;
        d.transpose() * d
    };
    let eigen = used.iter().map(moment).sum::<Matrix3<f64>>().symmetric_eigen();
    let free = |k: &usize| {
        let turned = eigen.eigenvalues[*k].max(0.0);
        turned < n * NO_TURN.powi(2) || sigma > FREE_M * turned.sqrt()
    };
    (0..3).filter(free).map(|k| eigen.eigenvectors.column(k).into_owned()).collect()
}

fn answer(poses: &[Pose<Base, Flange>], used: &[usize], fit: &Fit, free: &[Vector3<f64>]) -> Pivot {
    let mean_rotation =
        used.iter().map(|&i| poses[i].rotation()).sum::<Matrix3<f64>>() / used.len() as f64;
    let free_in_base: Vec<Vector3<f64>> =
        free.iter().filter_map(|d| (mean_rotation * d).try_normalize(1e-9)).collect();
    let known = |directions: &[Vector3<f64>]| {
        std::array::from_fn(|k| {
            directions.iter().all(|d: &Vector3<f64>| d[k].abs() < TOUCHED_BY_FREE)
        })
    };
    let covariance = fit.inverse * fit.sigma().powi(2) * few(fit.degrees_of_freedom);
    let block =
        |k: usize| free.is_empty().then(|| covariance.fixed_view::<3, 3>(k, k).into_owned());
    let held_out = |i: usize| {
        let others: Vec<usize> = used.iter().copied().filter(|&k| k != i).collect();
        let fit = Fit::of(&others, poses);
        let open =
            others.len() < 3 || free_directions(&others, poses, fit.sigma()).len() > free.len();
        (!open).then(|| fit.residual(&poses[i]))
    };
    Pivot {
        verdict: Verdict::Accepted,
        reasons: vec![],
        tip_in_flange: Point::from_vector(fit.tip()),
        tip_known: known(free),
        tip_covariance: block(0),
        point_in_base: Point::from_vector(fit.point()),
        point_known: known(&free_in_base),
        point_covariance: block(3),
        sigma: fit.sigma(),
        residuals: poses.iter().map(|p| fit.residual(p)).collect(),
        held_out: (0..poses.len()).map(held_out).collect(),
        rejected: (0..poses.len()).filter(|i| !used.contains(i)).collect(),
        undetermined: free
            .iter()
            .map(|d| format!("the tip along {} of flange", axis_name(d)))
            .collect(),
    }
}

/// Variance of Student's t: how much wider an answer is whose noise came from few residuals.
fn few(degrees_of_freedom: f64) -> f64 {
    if degrees_of_freedom > 2.0 { degrees_of_freedom / (degrees_of_freedom - 2.0) } else { 10.0 }
}

fn conclude(found: &mut Pivot, most_spread: f64) {
    let spread = found.spread().map_or(0.0, |s| s.rms);
    if spread > most_spread {
        found.verdict = Verdict::Rejected;
        found.reasons.push(format!(
            "the RMS distance of the tip from the fixed point is {:.2} mm, more than {:.2} mm",
            spread * 1e3,
            most_spread * 1e3
        ));
    }
    if 2 * found.rejected.len() >= found.residuals.len() {
        found.verdict = Verdict::Rejected;
        found.reasons.push(format!(
            "only {} of {} poses agree on one point",
            found.residuals.len() - found.rejected.len(),
            found.residuals.len()
        ));
    }
    if found.verdict == Verdict::Accepted && !found.undetermined.is_empty() {
        found.verdict = Verdict::Undetermined;
        found.reasons.push(format!(
            "the poses turn too little across one axis: {} is not determined; tilt the flange by \
             30 degrees and more about a second axis",
            found.undetermined.join(" and ")
        ));
    }
    if found.verdict == Verdict::Accepted {
        found.reasons.push(format!(
            "the tip stays within {:.2} mm (root mean square) of one point",
            spread * 1e3
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use nalgebra::{Isometry3, Translation3, UnitQuaternion};
    use statrs::distribution::{ContinuousCDF, FisherSnedecor};

    /// Spread of the tip (root mean square distance, m) beyond which nobody led it onto one point.
    const MOST_SPREAD_M: f64 = 2e-3;

    const TIP: [f64; 3] = [0.004, -0.007, 0.182];
    const POINT: [f64; 3] = [0.6, -0.2, 0.05];

    /// A flange that holds its tip, off by normal deviates, on the point; turned by these radians
    /// (standard deviation) about its axes.
    fn poses(
        count: usize,
        turn: [f64; 3],
        sigma: f64,
        random: &mut Random,
    ) -> Vec<Pose<Base, Flange>> {
        let down = UnitQuaternion::from_scaled_axis(Vector3::x() * std::f64::consts::PI);
        let one = |_| {
            let w = random.normal3().component_mul(&Vector3::from(turn));
            let rotation = down * UnitQuaternion::from_scaled_axis(w);
            let tip = Vector3::from(POINT) + random.normal3() * sigma;
            let t = tip - rotation * Vector3::from(TIP);
            Pose::claim(Isometry3::from_parts(Translation3::from(t), rotation))
        };
        (0..count).map(one).collect()
    }

    #[test]
    fn exact_poses_give_the_tip() {
        let found = pivot(&poses(4, [0.4; 3], 0.0, &mut Random::new(1)), MOST_SPREAD_M).unwrap();
        assert!((found.tip_in_flange.vector() - Vector3::from(TIP)).norm() < 1e-9);
        assert!((found.point_in_base.vector() - Vector3::from(POINT)).norm() < 1e-9);
        assert_eq!((found.verdict, found.rejected.len()), (Verdict::Accepted, 0));
    }

    #[test]
    fn a_position_beyond_any_robot_is_refused() {
        for far in [1e7, 1e160, 1e200] {
            let mut all = poses(8, [0.4; 3], 3e-4, &mut Random::new(1));
            all[3] = Pose::claim(Isometry3::translation(far, 0.0, 0.0));
            let error = pivot(&all, 1e-2).unwrap_err().to_string();
            assert!(error.starts_with("pose 4 lies farther"), "{error}");
        }
    }

    #[test]
    fn moving_the_base_moves_only_the_point() {
        let all = poses(6, [0.4; 3], 3e-4, &mut Random::new(2));
        let moved: Pose<Base, Base> =
            Pose::claim(Isometry3::new(Vector3::new(1.0, -2.0, 0.3), Vector3::new(0.2, 0.7, -1.1)));
        let other: Vec<_> = all.iter().map(|p| moved * *p).collect();
        let (a, b) = (pivot(&all, 1e-2).unwrap(), pivot(&other, 1e-2).unwrap());
        assert!((a.tip_in_flange.vector() - b.tip_in_flange.vector()).norm() < 1e-9);
        assert!(((moved * a.point_in_base).vector() - b.point_in_base.vector()).norm() < 1e-9);
    }

    #[test]
    fn the_other_direction_fits_as_well_with_tip_and_point_exchanged() {
        let all = poses(6, [0.4; 3], 3e-4, &mut Random::new(3));
        let turned: Vec<_> = all.iter().map(|p| p.inverse().rename()).collect();
        let (a, b) = (pivot(&all, 1e-2).unwrap(), pivot(&turned, 1e-2).unwrap());
        assert!((a.sigma - b.sigma).abs() < 1e-12);
        assert!((a.tip_in_flange.vector() - b.point_in_base.vector()).norm() < 1e-9);
    }

    /// The covariance is that of Student's t: 95 of 100 errors lie within the F-limit.
    #[test]
    fn the_error_stays_inside_the_covariance() {
        for count in [5, 8, 20] {
            let mut random = Random::new(count as u64);
            let dof = 3.0 * count as f64 - 6.0;
            let law = FisherSnedecor::new(3.0, dof);
            let limit = 3.0 / few(dof) * law.unwrap().inverse_cdf(0.95);
            let mut inside = |_: &i32| {
                let found = pivot(&poses(count, [0.6; 3], 4e-4, &mut random), 1e-2).unwrap();
                let e = found.tip_in_flange.vector() - Vector3::from(TIP);
                e.dot(&(found.tip_covariance.unwrap().try_inverse().unwrap() * e)) < limit
            };
            let inside = (0..400).filter(|k| inside(k)).count();
            assert!((368..394).contains(&inside), "{count} poses: {inside} of 400 inside 95 %");
        }
    }

    #[test]
    fn poses_that_left_the_point_are_named_and_good_ones_are_not() {
        let (mut missed, mut falsely) = (0, 0);
        for seed in 0..200 {
            let mut random = Random::new(seed);
            let mut all = poses(8, [0.4; 3], 3e-4, &mut random);
            falsely += pivot(&all, 1e-2).unwrap().rejected.len();
            let off = Isometry3::translation(0.008, -0.004, 0.003);
            all[2] = Pose::claim(off * all[2].iso());
            all[5] = Pose::claim(off.inverse() * all[5].iso());
            missed += usize::from(pivot(&all, 1e-2).unwrap().rejected != [2, 5]);
        }
        assert!(missed <= 4 && falsely <= 4, "{missed} missed, {falsely} called wrong in vain");
    }

    #[test]
    fn turns_about_one_axis_leave_the_tip_along_it_free() {
        for sigma in [0.0, 3e-4] {
            let all = poses(8, [0.0, 0.0, 1.0], sigma, &mut Random::new(5));
            let found = pivot(&all, 1e-2).unwrap();
            assert_eq!(found.verdict, Verdict::Undetermined);
            assert_eq!(found.tip_known, [true, true, false]);
            assert_eq!(found.point_known, [true, true, false]);
            assert_eq!(found.undetermined, ["the tip along z of flange"]);
            assert!((found.tip_in_flange.vector().xy() - Vector3::from(TIP).xy()).norm() < 1e-3);
        }
    }

    #[test]
    fn a_tip_that_was_not_held_is_rejected() {
        let all = poses(8, [0.4; 3], 5e-3, &mut Random::new(6));
        assert_eq!(pivot(&all, MOST_SPREAD_M).unwrap().verdict, Verdict::Rejected);
    }

    #[test]
    fn a_flange_that_does_not_turn_is_refused() {
        let all = poses(5, [0.0; 3], 1e-4, &mut Random::new(7));
        assert!(matches!(pivot(&all, 1e-2), Err(Error::NotDetermined { .. })));
        assert!(matches!(pivot(&all[..3], 1e-2), Err(Error::TooFewPoses { .. })));
    }
}
