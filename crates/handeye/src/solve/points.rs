//! A camera that sees one point, a ball's centre, from many robot poses:
//!
//! ```text
//! A_i X c_i = p        A = anchor_from_mount, X = mount_from_camera, c = the centre in the camera
//! ```
//!
//! For a given rotation of `X` its translation and `p` are linear. All 24 turns of a cube start a
//! least-squares fit, so no start is asked for; what is farther from the truth than 63 degrees is
//! nearer to another turn. With many captures the fit of some few tells which captures agree (least
//! median of squares). The last fit weighs each capture by the covariance of its centre and by one
//! more variance, the robot's, that makes the residuals as large as expected:
//!
//! ```text
//! V_i = R_A R_X S_i R_Xᵀ R_Aᵀ + σ² I          Σ rᵀ V⁻¹ r = 3 K - 9
//! ```
//!
//! P. Rousseeuw, *Least median of squares regression*, JASA 79, 1984.

use nalgebra::{Matrix3, Matrix6, Rotation3, SMatrix, SVector, Vector3, Vector6};

use crate::{
    Anchor, Camera, Error, Mount, Point, Pose,
    math::{
        lie,
        linalg::{self, FREE_SIGMA, median},
        optimize::{self, Damping, Problem, Rules, Singular, Tried},
        random::Random,
        subsets::{self, Draw},
    },
};

/// One capture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointView {
    /// Where the robot was.
    pub anchor_from_mount: Pose<Anchor, Mount>,
    /// Where the camera saw the point.
    pub in_camera: Point<Camera>,
    /// Covariance of that, m².
    pub covariance: Matrix3<f64>,
}

/// Camera and point, and how sure they are.
#[derive(Debug, Clone, PartialEq)]
pub struct PointFit {
    /// Where the camera sits.
    pub mount_from_camera: Pose<Mount, Camera>,
    /// Where the point is.
    pub in_anchor: Point<Anchor>,
    /// Covariance of both: rotation (rad) and translation (m) of the camera, perturbed on the right,
    /// and the point (m, in the anchor). What nothing tells has a standard deviation of ten.
    pub covariance: SMatrix<f64, 9, 9>,
    /// What the robot adds to each centre, standard deviation per axis, m.
    pub robot_sigma_m: f64,
    /// Which captures agree.
    pub agrees: Vec<bool>,
    /// Distance of each capture's centre from the point, m.
    pub residuals_m: Vec<f64>,
    /// Equations minus unknowns.
    pub degrees_of_freedom: f64,
}

/// Four captures have twelve equations for nine unknowns.
pub const FEWEST: usize = 4;
/// From so many captures on, some few tell which ones agree.
const MANY: usize = 7;
/// Captures in a trial.
const IN_TRIAL: usize = 5;
/// Trials: with a third of the captures wrong, five of them are right in one trial of eight.
const TRIALS: usize = 60;
/// A capture farther off than this (squared, standard deviations of three axes: one of 1e5) does not
/// agree.
const FAR: f64 = 26.0;
/// Captures up to this many medians off agree with a trial.
const NEAR: f64 = 3.5;
/// Steps of a fit from a start, and of the last one.
const STEPS: (usize, usize) = (12, 40);
/// Of a fit with noises held still.
const RULES: Rules = Rules {
    most_steps: STEPS.1,
    damping: Damping { least: 1e-12, most: 1e8, ..Damping::from(1e-6) },
    slack: 1e-12,
    singular: Singular::Ends,
};
/// A step this small (rad and m alike) is the last.
const STEP: f64 = 1e-12;
/// Rounds of fit, noise and agreement.
const ROUNDS: usize = 6;
/// Least standard deviation of a centre, m.
const LEAST_SIGMA: f64 = 1e-7;

type Nine = SMatrix<f64, 9, 9>;

#[derive(Clone, Copy)]
struct State {
    x: Pose<Mount, Camera>,
    p: Vector3<f64>,
}

impl State {
    fn residual(&self, v: &PointView) -> Vector3<f64> {
        (v.anchor_from_mount * (self.x * v.in_camera)).vector() - self.p
    }

    /// Of the residual, by a step of both.
    fn jacobian(&self, v: &PointView) -> SMatrix<f64, 3, 9> {
        let r = v.anchor_from_mount.rotation() * self.x.rotation();
        let mut j = SMatrix::<f64, 3, 9>::zeros();
        j.fixed_view_mut::<3, 3>(0, 0).copy_from(&(-r * lie::hat(&v.in_camera.vector())));
        j.fixed_view_mut::<3, 3>(0, 3).copy_from(&r);
        j.fixed_view_mut::<3, 3>(0, 6).copy_from(&-Matrix3::identity());
        j
    }

    fn moved(&self, step: &SVector<f64, 9>) -> Self {
        let delta: Vector6<f64> = step.fixed_rows::<6>(0).into_owned();
        Self { x: self.x.retract(&delta), p: self.p + step.fixed_rows::<3>(6) }
    }

    /// Variance of a capture's residual, m².
    fn noise(&self, v: &PointView, robot: f64) -> Matrix3<f64> {
        let r = v.anchor_from_mount.rotation() * self.x.rotation();
        r * v.covariance * r.transpose() + Matrix3::identity() * (robot + LEAST_SIGMA.powi(2))
    }
}

/// The residual (m, in the anchor) of a capture at an answer, its Jacobian by camera and point, and its noise.
pub(crate) fn equations_of(
    v: &PointView,
    fit: &PointFit,
) -> (Vector3<f64>, SMatrix<f64, 3, 9>, Matrix3<f64>) {
    let state = State { x: fit.mount_from_camera, p: fit.in_anchor.vector() };
    (state.residual(v), state.jacobian(v), state.noise(v, fit.robot_sigma_m.powi(2)))
}

/// Finds the camera and the point.
///
/// # Errors
/// [`Error::TooFewPoses`] below four captures; [`Error::NotDetermined`] where no camera explains
/// them.
pub(crate) fn fit_points(views: &[PointView]) -> Result<PointFit, Error> {
    if views.len() < FEWEST {
        let advice = "take 10 to 15, the robot turned about two axes between them".into();
        return Err(Error::TooFewPoses { found: views.len(), needed: FEWEST, advice });
    }
    let mut agrees = vec![true; views.len()];
    let mut state = consensus(views, &mut agrees)?;
    let mut robot = 0.0;
    for _ in 0..ROUNDS {
        let used = chosen(views, &agrees);
        state = descend(&used, state, Some(robot), STEPS.1);
        robot = robot_variance(&used, &state);
        if views.len() >= MANY {
            let near = |v: &PointView| distance(v, &state, robot) < FAR;
            let next: Vec<bool> = views.iter().map(near).collect();
            if 2 * next.iter().filter(|a| **a).count() > views.len() {
                agrees = next;
            }
        }
    }
    let used = chosen(views, &agrees);
    state = descend(&used, state, Some(robot), STEPS.1);
    let mut h = Weighted { views: &used, robot: Some(robot) }.normal(&state).h;
    (0..9).for_each(|k| h[(k, k)] += FREE_SIGMA.powi(-2));
    let covariance = linalg::inverse_spd(&nalgebra::DMatrix::from_column_slice(9, 9, h.as_slice()))
        .map_or_else(
            || Nine::identity() * FREE_SIGMA.powi(2),
            |c| Nine::from_column_slice(c.as_slice()),
        );
    Ok(PointFit {
        mount_from_camera: state.x,
        in_anchor: Point::from_vector(state.p),
        covariance,
        robot_sigma_m: robot.sqrt(),
        residuals_m: views.iter().map(|v| state.residual(v).norm()).collect(),
        degrees_of_freedom: 3.0 * used.len() as f64 - 9.0,
        agrees,
    })
}

/// Distance of each capture that agrees from where the others put the point, m; `None` for the rest,
/// and where the others are too few.
pub fn held_out(views: &[PointView], fit: &PointFit) -> Vec<Option<f64>> {
    let robot = fit.robot_sigma_m.powi(2);
    let one = |k: usize| {
        let kept = |i: &usize| fit.agrees[*i] && *i != k;
        let others: Vec<PointView> = (0..views.len()).filter(kept).map(|i| views[i]).collect();
        if !fit.agrees[k] || others.len() < FEWEST {
            return None;
        }
        let start = State { x: fit.mount_from_camera, p: fit.in_anchor.vector() };
        let state = descend(&others, start, Some(robot), STEPS.1);
        Some(state.residual(&views[k]).norm())
    };
    (0..views.len()).map(one).collect()
}

fn chosen(views: &[PointView], agrees: &[bool]) -> Vec<PointView> {
    views.iter().zip(agrees).filter(|(_, a)| **a).map(|(v, _)| *v).collect()
}

fn distance(v: &PointView, state: &State, robot: f64) -> f64 {
    let r = state.residual(v);
    state.noise(v, robot).cholesky().map_or(f64::INFINITY, |c| r.dot(&c.solve(&r)))
}

/// The answer that most captures agree on, to begin with.
fn consensus(views: &[PointView], agrees: &mut [bool]) -> Result<State, Error> {
    let undetermined = || Error::NotDetermined { what: "no camera explains the captures".into() };
    if views.len() < MANY {
        return from_all_starts(views).ok_or_else(undetermined);
    }
    let off = |s: &State| median(views.iter().map(|v| s.residual(v).norm()));
    let trial = |few: [usize; IN_TRIAL]| {
        from_all_starts(&few.map(|k| views[k])).map(|state| (off(&state), state))
    };
    let draw = Draw::Shuffled(Random::new(views.len() as u64));
    let trials = subsets::drawn(views.len(), TRIALS, draw);
    let best = trials.filter_map(trial).min_by(|a, b| a.0.total_cmp(&b.0));
    let (_, state) = best.ok_or_else(undetermined)?;
    // a trial of few captures misses the others by more than their noise: nobody right is left out
    let limit = NEAR * off(&state) + LEAST_SIGMA;
    agrees.iter_mut().zip(views).for_each(|(a, v)| *a = state.residual(v).norm() <= limit);
    Ok(state)
}

/// The best fit from every turn of a cube, all centres weighing alike.
fn from_all_starts(views: &[PointView]) -> Option<State> {
    let fits = cube_turns().into_iter().filter_map(|r| {
        let state = descend(views, with_rotation(views, &r)?, None, STEPS.0);
        let cost: f64 = views.iter().map(|v| state.residual(v).norm_squared()).sum();
        cost.is_finite().then_some((cost, state))
    });
    fits.min_by(|a, b| a.0.total_cmp(&b.0)).map(|f| f.1)
}

/// The 24 rotations that take a cube to itself.
fn cube_turns() -> Vec<Matrix3<f64>> {
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let signed: Vec<Vector3<f64>> = axes.iter().flat_map(|a| [*a, -a]).collect();
    let pairs = signed.iter().flat_map(|a| signed.iter().map(move |b| (*a, *b)));
    pairs
        .filter(|(a, b)| a.dot(b) == 0.0)
        .map(|(a, b)| Matrix3::from_columns(&[a, b, a.cross(&b)]))
        .collect()
}

/// Translation and point that go best with a rotation: `R_A t - p = -(R_A R c + t_A)`.
fn with_rotation(views: &[PointView], r: &Matrix3<f64>) -> Option<State> {
    let (mut h, mut g) = (Matrix6::identity() * 1e-9, Vector6::zeros());
    for v in views {
        let ra = v.anchor_from_mount.rotation();
        let mut j = SMatrix::<f64, 3, 6>::zeros();
        j.fixed_view_mut::<3, 3>(0, 0).copy_from(&ra);
        j.fixed_view_mut::<3, 3>(0, 3).copy_from(&-Matrix3::identity());
        let right = -(ra * (r * v.in_camera.vector()) + v.anchor_from_mount.translation());
        h += j.transpose() * j;
        g += j.transpose() * right;
    }
    let x = h.cholesky()?.solve(&g);
    let rotation = Rotation3::from_matrix_unchecked(*r);
    let pose = Pose::from_parts(rotation.matrix(), x.fixed_rows::<3>(0).into_owned());
    Some(State { x: pose, p: x.fixed_rows::<3>(3).into_owned() })
}

/// Normal matrix, gradient and cost.
struct Normal {
    h: Nine,
    g: SVector<f64, 9>,
    cost: f64,
}

/// Captures, each with its noise and the robot's variance; `None` weighs all alike.
struct Weighted<'a> {
    views: &'a [PointView],
    robot: Option<f64>,
}

impl Weighted<'_> {
    /// Infinite cost where a noise is none.
    fn normal(&self, s: &State) -> Normal {
        let mut sum = Normal { h: Nine::zeros(), g: SVector::zeros(), cost: 0.0 };
        for v in self.views {
            let (e, j) = (s.residual(v), s.jacobian(v));
            let noise = self.robot.map_or_else(Matrix3::identity, |robot| s.noise(v, robot));
            let Some(factor) = noise.cholesky() else {
                return Normal { cost: f64::INFINITY, ..sum };
            };
            sum.h += j.transpose() * factor.solve(&j);
            sum.g += j.transpose() * factor.solve(&e);
            sum.cost += e.dot(&factor.solve(&e));
        }
        sum
    }
}

impl Problem for Weighted<'_> {
    type Point = State;
    type Equations = Normal;
    type Step = SVector<f64, 9>;

    fn equations(&self, at: &State) -> Option<Normal> {
        Some(self.normal(at))
    }

    fn cost(&self, here: &Normal) -> f64 {
        here.cost
    }

    fn step(&self, _: &State, here: &Normal, damping: f64) -> Option<SVector<f64, 9>> {
        let mut damped = here.h;
        let floor = 1e-12 * here.h.trace();
        (0..9).for_each(|k| damped[(k, k)] += damping * here.h[(k, k)] + floor);
        Some(-damped.cholesky()?.solve(&here.g))
    }

    fn moved(&self, at: &State, step: &SVector<f64, 9>) -> State {
        at.moved(step)
    }

    fn is_last(&self, tried: &Tried<SVector<f64, 9>>) -> bool {
        tried.step.norm() < STEP
    }
}

fn descend(views: &[PointView], start: State, robot: Option<f64>, most_steps: usize) -> State {
    let problem = Weighted { views, robot };
    let mut state = start;
    let here = problem.normal(&state);
    optimize::descend(&problem, &mut state, here, &Rules { most_steps, ..RULES });
    state
}

/// The variance (m²) that makes the residuals as large as expected.
fn robot_variance(views: &[PointView], state: &State) -> f64 {
    let freedom = 3.0 * views.len() as f64 - 9.0;
    let cost = |robot: f64| views.iter().map(|v| distance(v, state, robot)).sum::<f64>();
    if freedom <= 0.0 || cost(0.0) <= freedom {
        return 0.0;
    }
    let squares: f64 = views.iter().map(|v| state.residual(v).norm_squared()).sum();
    let (mut low, mut high) = (0.0, squares / freedom);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if cost(middle) > freedom { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    fn truth() -> (Pose<Mount, Camera>, Vector3<f64>) {
        let x = Pose::identity().retract(&Vector6::new(1.9, -0.8, 1.1, 0.06, -0.03, 0.05));
        (x, Vector3::new(0.55, 0.05, 0.02))
    }

    /// Captures of a ball from all around, or turning about one axis only.
    fn captures(
        count: usize,
        noise: f64,
        turn: impl Fn(&mut Random) -> Vector3<f64>,
        seed: u64,
    ) -> Vec<PointView> {
        let (x, p) = truth();
        let mut random = Random::new(seed);
        let mut one = || {
            let c = Vector3::new(0.0, 0.0, 0.6) + random.normal3() * 0.08;
            let rotation = Rotation3::new(turn(&mut random));
            // A = T(p) R: then A X c = p
            let shift = p - rotation * (x * Point::<Camera>::from_vector(c)).vector();
            let seen = c + random.normal3() * noise;
            PointView {
                anchor_from_mount: Pose::from_parts(rotation.matrix(), shift),
                in_camera: Point::from_vector(seen),
                covariance: Matrix3::identity() * (0.5 * noise).max(1e-9).powi(2),
            }
        };
        (0..count).map(|_| one()).collect()
    }

    fn all_around(random: &mut Random) -> Vector3<f64> {
        random.normal3() * 0.6
    }

    #[test]
    fn exact_captures_give_the_truth() {
        let (x, p) = truth();
        for count in [4, 5, 6, 12] {
            for seed in 0..10 {
                let fit = fit_points(&captures(count, 0.0, all_around, seed)).unwrap();
                let off = x.local(&fit.mount_from_camera).norm();
                assert!(off < 1e-8, "{count} {seed}: {off}");
                assert!((fit.in_anchor.vector() - p).norm() < 1e-8);
            }
        }
    }

    #[test]
    fn errors_stay_inside_the_covariance() {
        let (x, _) = truth();
        let (mut sum, count) = (0.0, 60);
        for seed in 0..count {
            let fit = fit_points(&captures(15, 5e-4, all_around, seed)).unwrap();
            let e = x.local(&fit.mount_from_camera);
            let own: Matrix6<f64> = fit.covariance.fixed_view::<6, 6>(0, 0).into_owned();
            sum += e.dot(&(own.try_inverse().unwrap() * e)) / 6.0;
            assert!((2e-4..8e-4).contains(&fit.robot_sigma_m), "{}", fit.robot_sigma_m);
        }
        let ratio = sum / f64::from(count as u32);
        assert!((0.75..1.3).contains(&ratio), "{ratio}");
    }

    #[test]
    fn wrong_captures_are_left_out() {
        let (x, _) = truth();
        for seed in 0..10 {
            let mut views = captures(14, 2e-4, all_around, seed);
            for k in [1, 5, 9] {
                views[k].in_camera = Point::from_vector(
                    views[k].in_camera.vector() + Vector3::new(0.03, -0.02, 0.04),
                );
            }
            let fit = fit_points(&views).unwrap();
            let left_out: Vec<usize> = (0..14).filter(|k| !fit.agrees[*k]).collect();
            assert_eq!(left_out, [1, 5, 9], "{seed}");
            let off = x.local(&fit.mount_from_camera);
            assert!(off.fixed_rows::<3>(3).norm() < 2e-3, "{seed}: {off}");
            let missed = held_out(&views, &fit);
            assert!(missed[0].unwrap() < 2e-3 && missed[1].is_none());
        }
    }

    #[test]
    fn what_the_motions_do_not_tell_is_free() {
        let about_z = |random: &mut Random| Vector3::z() * random.normal();
        let never = |_: &mut Random| Vector3::zeros();
        for seed in 0..5 {
            let one_axis = fit_points(&captures(12, 2e-4, about_z, seed)).unwrap();
            let none = fit_points(&captures(12, 2e-4, never, seed)).unwrap();
            let largest = |fit: &PointFit| {
                let s: Matrix3<f64> = fit.covariance.fixed_view::<3, 3>(3, 3).into_owned();
                let mut all: Vec<f64> =
                    s.symmetric_eigenvalues().iter().map(|v| v.sqrt()).collect();
                all.sort_by(f64::total_cmp);
                all
            };
            let sigmas = largest(&one_axis);
            assert!(sigmas[2] > 1.0 && sigmas[1] < 0.01, "{sigmas:?}");
            assert!(largest(&none)[0] > 1.0);
        }
    }

    #[test]
    fn three_captures_are_too_few() {
        let error = fit_points(&captures(3, 0.0, all_around, 1)).unwrap_err();
        assert!(matches!(error, Error::TooFewPoses { found: 3, needed: 4, .. }));
    }
}
