//! The joint fit against its own definition, written down once more: derivatives, the least cost,
//! and the noise it finds.

use handeye::{
    HandEye, Method, Setup,
    estimate::{
        Extra, ExtraKind, JointFit, KnownNoise, NoiseModel, Problem, Source, TouchedBoard,
        extra::{TIP_PRIOR, tip},
        fit_joint, joint,
    },
    math::lie,
    simulate::{ArmErrors, Cell, DepthSensor},
};
use nalgebra::{DMatrix, DVector, Vector3, Vector6};

use crate::problem::{problem, start};

const SETUPS: [Setup; 2] = [Setup::EyeInHand, Setup::EyeToHand];

/// A usual cell with a tip that is off, and the joint fit of all of it.
fn fitted(setup: Setup, seed: u64) -> (Problem, JointFit) {
    let mut cell = Cell { depth: Some(DepthSensor::default()), ..Cell::new(setup, seed) };
    cell.noise.tip_m = 0.5e-3;
    let (session, _) = cell.session(seed).unwrap();
    let problem = problem(&session, &tip(TIP_PRIOR));
    let fit = fit_joint(&problem, &start(&session, Method::Shah), &KnownNoise::default()).unwrap();
    (problem, fit)
}

/// The same with an arm of which five parameters may deviate.
fn fitted_with_arm(setup: Setup, seed: u64) -> (Problem, JointFit) {
    let mut cell = Cell { arm: Some(ArmErrors::default()), ..Cell::new(setup, seed) };
    (cell.noise.robot_absolute_m, cell.noise.robot_absolute_rad) = (0.0, 0.0);
    let (session, _) = cell.session(seed).unwrap();
    let arm = session.arm.as_ref().unwrap();
    let which = &arm.deviations()[3..8];
    let free = |k| Extra::about_zero(ExtraKind::Arm(k), 4e-4);
    let extras: Vec<Extra> = tip(TIP_PRIOR).into_iter().chain((0..which.len()).map(free)).collect();
    let mut problem = problem(&session, &extras);
    for (view, o) in problem.views.iter_mut().zip(&session.observations) {
        let flange = arm.by_deviations(&o.joints, which);
        // a step of the mount on the right of its place in the anchor
        let by = match setup {
            Setup::EyeInHand => flange,
            Setup::EyeToHand => {
                let carry = lie::adjoint(o.base_from_flange.iso());
                -DMatrix::from_column_slice(6, 6, carry.as_slice()) * flange
            }
        };
        view.by_robot = Some(by.into());
    }
    let corners = problem.boards.iter_mut().flat_map(|b| &mut b.corners);
    for (corner, touch) in corners.zip(&session.touches) {
        corner.by_robot = Some(arm.by_deviations(&touch.joints, which).into());
    }
    let fit = fit_joint(&problem, &start(&session, Method::Shah), &KnownNoise::default()).unwrap();
    (problem, fit)
}

/// The arm's deviations after a step.
fn arm_at(problem: &Problem, fit: &JointFit, step: &DVector<f64>) -> DVector<f64> {
    DVector::from_fn(problem.extras.len() - 3, |k, _| fit.values[3 + k] + step[15 + k])
}

/// `by · values` as a twist.
fn twist(by: Option<&std::sync::Arc<DMatrix<f64>>>, values: &DVector<f64>) -> Vector6<f64> {
    by.map_or_else(Vector6::zeros, |by| (&**by * values).fixed_rows::<6>(0).into_owned())
}

/// Where an answer is after a step of `(X, Y, tip, arm)`.
fn moved(fit: &JointFit, step: &DVector<f64>) -> (HandEye, Vector3<f64>) {
    let six = |k: usize| Vector6::from_fn(|i, _| step[k + i]);
    let HandEye { mount_from_camera, anchor_from_target } = fit.hand_eye;
    let at = HandEye {
        mount_from_camera: mount_from_camera.retract(&six(0)),
        anchor_from_target: anchor_from_target.retract(&six(6)),
    };
    (at, Vector3::from_fn(|k, _| fit.values[k] + step[12 + k]))
}

fn view_residual(at: &HandEye, view: &handeye::solve::View, arm: &DVector<f64>) -> DVector<f64> {
    let HandEye { mount_from_camera, anchor_from_target } = *at;
    let anchor_from_mount =
        view.pair.anchor_from_mount.retract(&twist(view.by_robot.as_ref(), arm));
    let anchor_from_camera = anchor_from_mount * mount_from_camera;
    let expected = anchor_from_camera.inverse() * anchor_from_target;
    let r = lie::log((view.pair.camera_from_target.inverse() * expected).iso());
    DVector::from_column_slice(r.as_slice())
}

/// Tip minus corner, all of one board.
fn touch_residual(
    at: &HandEye,
    tip: &Vector3<f64>,
    arm: &DVector<f64>,
    board: &TouchedBoard,
) -> DVector<f64> {
    let base_from_board = match &board.seen {
        Some(view) => at.mount_from_camera.iso() * view.pair.camera_from_target.iso(),
        None => *at.anchor_from_target.iso(),
    };
    let mut e = DVector::zeros(3 * board.corners.len());
    for (k, corner) in board.corners.iter().enumerate() {
        let flange = corner.base_from_flange.unwrap();
        let held = flange.inverse().rotation() * (corner.in_base - flange.translation());
        let flange = flange.retract(&twist(corner.by_robot.as_ref(), arm));
        let touched = flange.rotation() * (held + tip) + flange.translation();
        let there = base_from_board.transform_point(&corner.in_target.into()).coords;
        e.rows_mut(3 * k, 3).copy_from(&(touched - there));
    }
    e
}

/// `θ_touch I + θ_position I + θ_rotation diag(l lᵀ) + θ_picture G S Gᵀ` at an answer.
fn touch_covariance(at: &HandEye, noise: &NoiseModel, board: &TouchedBoard) -> DMatrix<f64> {
    let n = 3 * board.corners.len();
    let variance = |s: Source| noise.sigma(s).unwrap().powi(2);
    let own = variance(Source::Touch) + variance(Source::RobotPosition);
    let mut v = DMatrix::identity(n, n) * own;
    let mut by_board = DMatrix::zeros(n, 6);
    for (k, corner) in board.corners.iter().enumerate() {
        if let Some(flange) = &corner.base_from_flange {
            let lever = lie::hat(&(corner.in_base - flange.translation()));
            let turned = lever * lever.transpose() * variance(Source::RobotRotation);
            let mut block = v.view_mut((3 * k, 3 * k), (3, 3));
            block += turned;
        }
        if let Some(view) = &board.seen {
            let r = at.mount_from_camera.rotation() * view.pair.camera_from_target.rotation();
            by_board.view_mut((3 * k, 0), (3, 3)).copy_from(&(-r * lie::hat(&corner.in_target)));
            by_board.view_mut((3 * k, 3), (3, 3)).copy_from(&r);
        }
    }
    if let Some(view) = &board.seen {
        v +=
            &by_board * view.covariance.unwrap() * by_board.transpose() * variance(Source::Picture);
    }
    v
}

/// Everything that a fit weighs: residuals, each divided by a root of its covariance at the answer.
struct Definition {
    problem: Problem,
    fit: JointFit,
    roots: Vec<DMatrix<f64>>,
}

impl Definition {
    fn new(problem: Problem, fit: JointFit) -> Self {
        let at = &fit.hand_eye;
        let of_view = |v| {
            let s = fit.noise.covariance(v, at, problem.setup);
            DMatrix::from_column_slice(6, 6, s.as_slice())
        };
        let of_board = |b| touch_covariance(at, &fit.noise, b);
        let all = problem.views.iter().map(of_view).chain(problem.boards.iter().map(of_board));
        let roots = all.map(|s| s.cholesky().unwrap().l()).collect();
        Self { problem, fit, roots }
    }

    fn residuals(&self, step: &DVector<f64>) -> DVector<f64> {
        let (at, tip) = moved(&self.fit, step);
        let arm = arm_at(&self.problem, &self.fit, step);
        let views = self.problem.views.iter().map(|v| view_residual(&at, v, &arm));
        let boards = self.problem.boards.iter().map(|b| touch_residual(&at, &tip, &arm, b));
        let divided = views
            .chain(boards)
            .zip(&self.roots)
            .map(|(r, root)| root.solve_lower_triangular(&r).unwrap());
        let mut all: Vec<f64> = divided.flat_map(|r| r.as_slice().to_vec()).collect();
        let extras = tip.iter().chain(&arm).zip(&self.problem.extras);
        all.extend(extras.map(|(x, e)| x / e.prior_sigma));
        all.into()
    }

    /// Jacobian by central differences, and the residuals.
    fn differences(&self) -> (DMatrix<f64>, DVector<f64>) {
        let n = 12 + self.problem.extras.len();
        let column = |k: usize| {
            let mut step = DVector::zeros(n);
            step[k] = STEP;
            (self.residuals(&step) - self.residuals(&-step)) / (2.0 * STEP)
        };
        let columns: Vec<DVector<f64>> = (0..n).map(column).collect();
        (DMatrix::from_columns(&columns), self.residuals(&DVector::zeros(n)))
    }
}

/// rad, m.
const STEP: f64 = 1e-6;

#[test]
fn the_information_is_that_of_numeric_derivatives() {
    for setup in SETUPS {
        informed(fitted(setup, 4), 1e-6);
        // the arm's deviations are linearised where they start, not where they end
        informed(fitted_with_arm(setup, 4), 2e-3);
    }
}

fn informed((problem, fit): (Problem, JointFit), tolerance: f64) {
    let setup = problem.setup;
    let definition = Definition::new(problem, fit);
    let (j, _) = definition.differences();
    let (numeric, stated) = (j.transpose() * &j, &definition.fit.information);
    for a in 0..numeric.nrows() {
        for b in 0..numeric.ncols() {
            let size = (numeric[(a, a)] * numeric[(b, b)]).sqrt();
            let off = (numeric[(a, b)] - stated[(a, b)]).abs() / size;
            assert!(off < tolerance, "{setup:?} ({a}, {b}): {off:.1e}");
        }
    }
}

/// In units of the answer's own standard deviations.
#[test]
fn at_the_answer_the_cost_has_no_slope() {
    for setup in SETUPS {
        for seed in [4, 5, 6] {
            let (problem, fit) = fitted(setup, seed);
            let covariance = fit.covariance.clone().unwrap();
            let own = fit.gradient.dot(&(&covariance * &fit.gradient)).sqrt();
            assert!(own < 1e-5, "{setup:?} {seed}: {own:.1e}");
            let (j, r) = Definition::new(problem, fit).differences();
            let slope = j.transpose() * r;
            let numeric = slope.dot(&(covariance * &slope)).sqrt();
            assert!(numeric < 1e-5, "{setup:?} {seed}: {numeric:.1e}");
        }
    }
}

fn views_alone(setup: Setup, seed: u64, scans: bool) -> (handeye::Session, Cell) {
    let depth = scans.then(DepthSensor::default);
    let cell = Cell { placements: 0, touches: 0, depth, ..Cell::new(setup, 600 + seed) };
    (cell.session(seed).unwrap().0, cell)
}

fn scaled(noise: &NoiseModel, factor: f64) -> NoiseModel {
    let mut noise = noise.clone();
    noise.sigmas.iter_mut().for_each(|s| s.sigma *= factor);
    noise
}

/// Mean of the robot's noise found over the true one (rotation, position).
fn noise_found(setup: Setup, trials: u64) -> (f64, f64) {
    let mut sum = (0.0, 0.0);
    for seed in 0..trials {
        let (session, cell) = views_alone(setup, seed, true);
        let problem = problem(&session, &[]);
        let known = KnownNoise::default();
        let fit = fit_joint(&problem, &start(&session, Method::Shah), &known).unwrap();
        let [low, high] = [0.2, 5.0].map(|factor| {
            let astray = JointFit { noise: scaled(&fit.noise, factor), ..fit.clone() };
            joint::refit(&problem, &astray, &known).noise
        });
        for s in &low.sigmas {
            let ratio = high.sigma(s.source).unwrap() / s.sigma;
            assert!((ratio - 1.0).abs() < 0.01, "{:?} {ratio}", s.source);
        }
        let n = &cell.noise;
        let rotation = n.robot_absolute_rad.hypot(n.robot_repeatability_rad);
        let position = n.robot_absolute_m.hypot(n.robot_repeatability_m) / 3f64.sqrt();
        sum.0 += low.sigma(Source::RobotRotation).unwrap() / rotation;
        sum.1 += low.sigma(Source::RobotPosition).unwrap() / position;
    }
    (sum.0 / trials as f64, sum.1 / trials as f64)
}

/// Where the camera is far from the flange, the turning robot moves what it sees by more than its
/// position errs, and the prior, which knows the residual alone, has the position's noise too large.
#[test]
fn the_robots_noise_is_found_from_a_start_five_times_off() {
    for (setup, most) in [(Setup::EyeToHand, 1.25), (Setup::EyeInHand, 1.5)] {
        let (rotation, position) = noise_found(setup, 30);
        println!("{setup:?}: found over true: rotation {rotation:.3}, position {position:.3}");
        assert!((0.87..1.1).contains(&rotation), "{rotation}");
        assert!((0.9..most).contains(&position), "{position}");
    }
}

/// Mean of the least cost over the number of equations less that of unknowns, for noise that is
/// known.
fn cost_over_expected(trials: u64, scans: bool) -> f64 {
    let one = |seed: u64| {
        let (session, cell) = views_alone(SETUPS[seed as usize % 2], seed, scans);
        let n = &cell.noise;
        let known = KnownNoise {
            robot_rotation_rad: Some(n.robot_absolute_rad.hypot(n.robot_repeatability_rad)),
            robot_position_m: Some(n.robot_absolute_m.hypot(n.robot_repeatability_m) / 3f64.sqrt()),
            touch_m: None,
            tip_m: None,
        };
        let problem = problem(&session, &[]);
        let fit = fit_joint(&problem, &start(&session, Method::Shah), &known).unwrap();
        fit.chi_squared / fit.degrees_of_freedom
    };
    (0..trials).map(one).sum::<f64>() / trials as f64
}

#[test]
fn the_least_cost_is_as_large_as_the_noise_says() {
    let found = cost_over_expected(40, false);
    println!("cost over degrees of freedom: {found:.4}");
    // 78 degrees of freedom a fit: the standard error of the mean of 40 is 0.025
    assert!((found - 1.0).abs() < 0.075, "{found}");
}

#[test]
#[ignore = "a minute"]
fn the_least_cost_is_as_large_as_the_noise_says_to_a_hundredth() {
    // corners of image and scan share the error of the pixel, and count as if they did not
    for (scans, most) in [(false, 0.01), (true, 0.05)] {
        let found = cost_over_expected(1000, scans);
        println!("scans {scans}: cost over degrees of freedom {found:.4}");
        assert!((found - 1.0).abs() < most, "{found}");
    }
}

/// An unknown that nothing tells of keeps its belief and changes no other.
#[test]
fn a_tip_that_nothing_touches_with_stays_as_it_was_believed() {
    let (session, _) = views_alone(Setup::EyeInHand, 1, true);
    let begin = start(&session, Method::Shah);
    let known = KnownNoise::default();
    let alone = fit_joint(&problem(&session, &[]), &begin, &known).unwrap();
    let unused: Vec<Extra> = tip(TIP_PRIOR).to_vec();
    let with = fit_joint(&problem(&session, &unused), &begin, &known).unwrap();
    let (value, sigma) = with.extra(ExtraKind::Tip(0)).unwrap();
    assert!(value.abs() < 1e-12 && (sigma / TIP_PRIOR - 1.0).abs() < 1e-9);
    let x = with.hand_eye.mount_from_camera;
    assert!(alone.hand_eye.mount_from_camera.local(&x).norm() < 1e-9);
}
