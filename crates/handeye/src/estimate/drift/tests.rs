use super::{kalman::*, *};
use crate::{
    PosePair, Setup,
    estimate::{NoiseModel, drift::sequence::Side, noise::Sigma},
    math::{
        lie,
        linalg::{self, FREE_SIGMA},
        random::Random,
    },
    solve::{
        View,
        tests::{exact_pairs, truths},
    },
};

/// Steps of a walk and white noise, rad and m.
struct Errors {
    walk: (f64, f64),
    white: (f64, f64),
}

/// Views along a path, whose target drifts in the axes of the camera.
fn drifting(count: usize, seed: u64, errors: &Errors) -> Vec<PosePair> {
    let mut random = Random::new(seed);
    let mut normal = |(turn, shift): (f64, f64)| {
        lie::tangent(&(random.normal3() * turn), &(random.normal3() * shift))
    };
    let mut pairs = exact_pairs(&truths()[0], count);
    let mut drift = nalgebra::Isometry3::identity();
    for pair in &mut pairs {
        let carry = lie::adjoint(pair.camera_from_target.inverse().iso());
        drift *= lie::exp(&(carry * normal(errors.walk)));
        let seen = pair.camera_from_target.iso() * drift.inverse();
        pair.camera_from_target = crate::Pose::claim(seen).retract(&normal(errors.white));
    }
    pairs
}

fn sequence(pairs: Vec<PosePair>) -> Sequence {
    let after = vec![1.0; pairs.len()];
    let views = pairs.into_iter().map(View::bare).collect();
    Sequence { setup: Setup::EyeInHand, side: Side::Target, views, after, extras: vec![] }
}

const WALK: Errors = Errors { walk: (1e-3, 1e-3), white: (3e-4, 2e-4) };

fn fitted(sequence: &Sequence, free: Free) -> DriftFit {
    let (used, known) = (vec![true; sequence.views.len()], KnownNoise::default());
    let near = without_drift(sequence, &used, &truths()[0], &known).unwrap();
    fit_drift(sequence, &used, &near, &known, free).unwrap()
}

const SIDES: [Side; 2] = [Side::Target, Side::Camera];

/// Lines of a short sequence, one of them not used, and levels of noise and drift.
fn short(side: Side) -> (Sequence, Vec<Line>, Levels) {
    let mut sequence = Sequence { side, ..sequence(drifting(7, 5, &WALK)) };
    sequence.after = vec![0.0, 1.0, 0.5, 2.0, 1.0, 0.1, 1.4];
    let mut used = vec![true; 7];
    used[3] = false;
    let sigma = |source: Source| Sigma {
        source,
        sigma: if source.is_rotation() { 4e-4 } else { 3e-4 },
        uncertainty: None,
    };
    let bare = |s: &Source| !matches!(s, Source::Picture | Source::Touch);
    let noise = NoiseModel { sigmas: Source::ALL.into_iter().filter(bare).map(sigma).collect() };
    let drift = Drift { rotation: 1e-3, position: 8e-4, scale: 2e-3, memory: 5.0 };
    let lines = lines(&sequence, &used, &truths()[0], &DVector::zeros(0));
    (sequence, lines, Levels { noise, drift, free: true })
}

/// Covariance of all residuals side by side, from the definition of the drift.
fn dense(lines: &[Line], levels: &Levels) -> DMatrix<f64> {
    let n = lines.len();
    let mut all = DMatrix::zeros(6 * n, 6 * n);
    let mut own: Vec<Square> = vec![];
    for (k, line) in lines.iter().enumerate() {
        let phi = (-line.after / levels.drift.memory).exp();
        let fresh = spread(line, &levels.drift);
        own.push(match own.last() {
            None => fresh,
            Some(last) => last * phi * phi + fresh * (1.0 - phi * phi),
        });
        let mut forgotten = 1.0;
        for i in (0..=k).rev() {
            let block = line.see * (own[i] * forgotten) * lines[i].see.transpose();
            all.fixed_view_mut::<6, 6>(6 * k, 6 * i).copy_from(&block);
            all.fixed_view_mut::<6, 6>(6 * i, 6 * k).copy_from(&block.transpose());
            forgotten *= (-lines[i].after / levels.drift.memory).exp();
        }
        let noise = noise::covariance(&line.factor, &line.columns, &levels.noise.variances());
        let mut diagonal = all.fixed_view_mut::<6, 6>(6 * k, 6 * k);
        diagonal += noise;
    }
    all
}

fn rows_of(used: &[usize], m: &DMatrix<f64>) -> DMatrix<f64> {
    let at: Vec<usize> = used.iter().flat_map(|k| 6 * k..6 * k + 6).collect();
    m.select_rows(at.iter())
}

fn stacked(lines: &[Line], columns: std::ops::Range<usize>) -> DMatrix<f64> {
    let (start, width) = (columns.start, columns.len());
    DMatrix::from_fn(6 * lines.len(), width, |i, j| lines[i / 6].rows[(i % 6, start + j)])
}

#[test]
fn the_filter_has_the_restricted_likelihood_of_the_dense_covariance() {
    SIDES.into_iter().for_each(the_filter_is_dense_covariance);
}

fn the_filter_is_dense_covariance(side: Side) {
    let (sequence, lines, levels) = short(side);
    let used: Vec<usize> = (0..lines.len()).filter(|&k| lines[k].used).collect();
    let v = rows_of(&used, &rows_of(&used, &dense(&lines, &levels)).transpose());
    let (r, j) = (rows_of(&used, &stacked(&lines, 0..1)), rows_of(&used, &stacked(&lines, 1..13)));
    let root = v.cholesky().unwrap();
    let h = j.transpose() * root.solve(&j) + DMatrix::identity(12, 12) * FREE_SIGMA.powi(-2);
    let g = j.transpose() * root.solve(&r);
    let h_root = h.clone().cholesky().unwrap();
    let log = |m: &DMatrix<f64>| 2.0 * m.diagonal().iter().map(|d| d.ln()).sum::<f64>();
    let least = (r.transpose() * root.solve(&r) - g.transpose() * h_root.solve(&g))[(0, 0)];
    let wanted = -0.5 * (log(&root.l()) + log(&h_root.l()) + least);
    let filtered = filter(&lines, &levels);
    let found = filtered.log_likelihood(&sequence, &DVector::zeros(0));
    assert!((found - wanted).abs() < 1e-6 * wanted.abs(), "{found} {wanted}");
    let (information, gradient) = filtered.normal(&sequence, &DVector::zeros(0));
    assert!((&information - &h).norm() < 1e-6 * h.norm());
    assert!((gradient - g.column(0)).norm() < 1e-6 * h.norm());
}

#[test]
fn a_view_left_out_is_missed_as_by_the_dense_covariance() {
    SIDES.into_iter().for_each(views_left_out_are_missed);
}

fn views_left_out_are_missed(side: Side) {
    let (_, lines, levels) = short(side);
    let (v, r) = (dense(&lines, &levels), stacked(&lines, 0..1));
    let slow = smooth(&lines, &levels);
    for k in 0..lines.len() {
        let others: Vec<usize> = (0..lines.len()).filter(|&i| i != k && lines[i].used).collect();
        let to_others = rows_of(&others, &rows_of(&[k], &v).transpose());
        let inner = rows_of(&others, &rows_of(&others, &v).transpose());
        let weights = inner.cholesky().unwrap().solve(&to_others);
        let missed = rows_of(&[k], &r) - weights.transpose() * rows_of(&others, &r);
        let own = rows_of(&[k], &rows_of(&[k], &v).transpose());
        let spread = own - weights.transpose() * to_others;
        let surprise = missed.dot(&spread.cholesky().unwrap().solve(&missed));
        let missed_there = lines[k].to_target * missed.fixed_view::<6, 1>(0, 0);
        assert!((slow[k].left_out - missed_there).norm() < 1e-9, "view {k}");
        assert!((slow[k].squared_mahalanobis / surprise - 1.0).abs() < 1e-5, "view {k}");
    }
}

#[test]
fn with_drift_the_answer_is_better_and_honest() {
    let (mut with, mut without, mut surprise) = (0.0, 0.0, 0.0);
    let trials = 12;
    for seed in 0..trials {
        let sequence = sequence(drifting(50, seed, &WALK));
        let truth = truths()[0].mount_from_camera;
        let (plain, found) = (fitted(&sequence, Free::Nothing), fitted(&sequence, Free::Pose));
        assert!(found.fit.log_likelihood > plain.fit.log_likelihood + 20.0, "seed {seed}");
        let miss = found.fit.hand_eye.mount_from_camera.local(&truth);
        let own = found.fit.pose_covariance().unwrap().fixed_view::<6, 6>(0, 0).into_owned();
        surprise += miss.dot(&(linalg::invert_spd(&own).unwrap() * miss));
        with += lie::nu(&miss).norm_squared();
        without += plain.fit.hand_eye.mount_from_camera.distance_to(&truth).powi(2);
    }
    assert!(with < 0.5 * without, "{with} {without}");
    let mean = surprise / (6 * trials) as f64;
    assert!((0.5..1.8).contains(&mean), "{mean}");
}

#[test]
fn independent_errors_show_no_drift() {
    for seed in 0..6 {
        let errors = Errors { walk: (0.0, 0.0), white: (1e-3, 5e-4) };
        let sequence = sequence(drifting(30, seed, &errors));
        let (plain, found) = (fitted(&sequence, Free::Nothing), fitted(&sequence, Free::Pose));
        let gain = found.fit.log_likelihood - plain.fit.log_likelihood;
        assert!(gain < 8.0, "seed {seed}: {gain}");
    }
}

#[test]
fn lists_that_do_not_match_are_named() {
    let sequence = sequence(drifting(5, 1, &WALK));
    let known = KnownNoise::default();
    let near = without_drift(&sequence, &[true; 5], &truths()[0], &known).unwrap();
    let fit = |s: &Sequence, used: &[bool]| fit_drift(s, used, &near, &known, Free::Pose);
    assert!(fit(&sequence, &[true; 4]).is_err());
    let mut late = sequence.clone();
    late.after[2] = f64::NAN;
    let error = fit(&late, &[true; 5]).unwrap_err().to_string();
    assert_eq!(error, "the time before view 3 must not be negative");
    assert!(fit(&sequence, &[true, true, false, false, false]).is_err());
}
