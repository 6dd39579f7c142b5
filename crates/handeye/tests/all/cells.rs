//! Whole calibrations of cells whose truth is known.

use handeye::{
    Calibration, Config, LensSigma, Method, Setup, TargetSize, calibrate,
    calibrate::result::matrix,
    math::linalg::invert_spd,
    model::verdict::Verdict,
    simulate::{Cell, CellNoise, DepthSensor, Truth},
};

const SETUPS: [Setup; 2] = [Setup::EyeInHand, Setup::EyeToHand];

fn solved(cell: &Cell, seed: u64) -> (Calibration, Truth) {
    let (session, truth) = cell.session(seed).unwrap();
    (calibrate(&session, &Config::default()).unwrap(), truth)
}

#[test]
fn exact_cells_give_the_truth_by_every_candidate() {
    for setup in SETUPS {
        for depth in [None, Some(DepthSensor { sigma_at_1m: 0.0, ..DepthSensor::default() })] {
            let cell = Cell { noise: CellNoise::NONE, depth, ..Cell::new(setup, 4) };
            let (found, truth) = solved(&cell, 1);
            assert_eq!(found.verdict, Verdict::Accepted, "{setup:?} {:?}", found.reasons);
            assert!(found.candidates.iter().any(|c| c.name == "two-step-svd"));
            assert!(found.candidates.iter().any(|c| c.name == "two-step-icp"));
            for candidate in &found.candidates {
                let x = candidate.hand_eye.mount_from_camera.unwrap();
                let off = truth.hand_eye.mount_from_camera.local(&x).norm();
                assert!(off < 1e-9, "{setup:?} {} is off by {off:.1e}", candidate.name);
            }
        }
    }
}

/// `ξᵀ Σ⁻¹ ξ / 6` of `mount_from_camera`.
fn normalised_error_squared(found: &Calibration, truth: &Truth) -> f64 {
    let x = found.hand_eye.mount_from_camera.unwrap();
    let covariance = matrix(&found.hand_eye.covariance.mount_from_camera.unwrap());
    let xi = x.local(&truth.hand_eye.mount_from_camera);
    xi.dot(&(invert_spd(&covariance).unwrap() * xi)) / 6.0
}

/// The mean over cells with a robot as in the field, 0.5 mm and 0.03 degrees off in every pose, whose lens and board
/// are declared as exactly as they are simulated.
fn mean_normalised_error_squared(setup: Setup, cells: u64) -> f64 {
    let each = (0..cells).map(|seed| {
        let cell = Cell { placements: 0, touches: 0, ..Cell::new(setup, seed) };
        let (mut session, truth) = cell.session(1000 + seed).unwrap();
        session.target_size = TargetSize::Measured(1e-5);
        session.lens_sigma = Some(LensSigma { focal_px: Some(0.02), center_px: Some(0.02) });
        let found = calibrate(&session, &Config::default()).unwrap();
        normalised_error_squared(&found, &truth)
    });
    each.sum::<f64>() / cells as f64
}

fn assert_consistent(cells: u64) {
    for setup in SETUPS {
        let mean = mean_normalised_error_squared(setup, cells);
        println!("{setup:?}: normalised error squared {mean:.3} over {cells} cells");
        assert!((0.8..1.25).contains(&mean), "{setup:?}: {mean:.3}");
    }
}

#[test]
fn errors_are_as_large_as_the_stated_covariance() {
    assert_consistent(60);
}

#[test]
#[ignore = "a minute"]
fn errors_are_as_large_as_the_stated_covariance_in_many_cells() {
    assert_consistent(200);
}

/// With touches the chosen answer may be the two-step one, whose touches share the views' errors.
/// Five copies of every capture, some of them with noise of the camera alone, are worth little more than one.
#[test]
fn captures_that_repeat_one_another_count_once() {
    let cell = Cell { touches: 0, ..Cell::new(Setup::EyeToHand, 5) };
    let (session, truth) = cell.session(6).unwrap();
    let once = calibrate(&session, &Config::default()).unwrap();
    let mut repeated = session.clone();
    for copy in 1..5 {
        for observation in &session.observations {
            let mut again = observation.clone();
            again.capture = format!("{}-{copy}", observation.capture);
            repeated.observations.push(again);
        }
    }
    let found = calibrate(&repeated, &Config::default()).unwrap();
    assert_eq!(found.hand_eye, once.hand_eye);
    assert_eq!(found.captures.len(), 5 * session.observations.len());
    assert_eq!(found.captures.iter().filter(|c| c.used).count(), session.observations.len());
    let warning = found.warnings.iter().find(|w| w.code == "captures-repeated").unwrap();
    assert!(
        warning.message.contains("001-1") && warning.message.contains("more repeat others"),
        "{}",
        warning.message
    );
    assert!(normalised_error_squared(&found, &truth) < 4.0);
    assert!(found.rejected.is_empty());
}

#[test]
fn a_session_with_a_name_twice_or_a_number_that_is_none_is_refused() {
    let (session, _) = Cell::new(Setup::EyeToHand, 5).session(6).unwrap();
    let refusal = |change: &dyn Fn(&mut handeye::Session)| {
        let mut session = session.clone();
        change(&mut session);
        calibrate(&session, &Config::default()).unwrap_err().to_string()
    };
    let twice = refusal(&|s| s.observations[1].capture = s.observations[0].capture.clone());
    assert!(twice.contains("give each a name of its own"), "{twice}");
    let time = refusal(&|s| s.observations[1].time_s = Some(f64::NAN));
    assert!(time.contains("is not a finite number"), "{time}");
    let touch = refusal(&|s| s.touches[0].in_base = handeye::Point::new(f64::NAN, 0.0, 0.0));
    assert!(touch.contains("is not a finite number"), "{touch}");
}

/// Where the robot is better than the images, closed forms are far from the likeliest answer.
#[test]
fn a_method_asked_for_by_name_states_its_own_error() {
    for method in [Method::Shah, Method::TsaiLenz, Method::Andreff] {
        let config = Config { method: Some(method), ..Config::default() };
        let mut sum = 0.0;
        for trial in 0..8 {
            let usual = Cell::new(Setup::EyeInHand, 3000 + trial);
            let noise = CellNoise {
                corner_px: 1.0,
                robot_absolute_m: 2e-5,
                robot_absolute_rad: 1e-4,
                ..usual.noise
            };
            let (session, truth) = Cell { noise, ..usual }.session(40 + trial).unwrap();
            let found = calibrate(&session, &config).unwrap();
            sum += normalised_error_squared(&found, &truth) / 8.0;
        }
        // 1/6 at least: its distance from the likeliest answer is all of its covariance in one direction
        assert!((0.17..1.6).contains(&sum), "{}: {sum:.2}", method.name());
    }
}

fn mean_with_touches(setup: Setup, cells: u64) -> f64 {
    let each = (0..cells).map(|seed| {
        let (found, truth) = solved(&Cell::new(setup, seed), 2000 + seed);
        assert!(found.hand_eye.covariance.anchor_from_target.is_some());
        normalised_error_squared(&found, &truth)
    });
    let mean = each.sum::<f64>() / cells as f64;
    println!("{setup:?} with touches: normalised error squared {mean:.3} over {cells} cells");
    mean
}

#[test]
fn the_chosen_answer_states_its_error_with_touches_too() {
    for setup in SETUPS {
        let mean = mean_with_touches(setup, 25);
        // the standard error of the mean of 25 is 0.12
        assert!((0.65..1.4).contains(&mean), "{setup:?}: {mean:.3}");
    }
}

#[test]
#[ignore = "two minutes"]
fn the_chosen_answer_states_its_error_with_touches_in_many_cells() {
    for setup in SETUPS {
        let mean = mean_with_touches(setup, 200);
        assert!((0.8..1.25).contains(&mean), "{setup:?}: {mean:.3}");
    }
}

#[test]
fn the_order_of_captures_and_touches_changes_no_byte() {
    for setup in SETUPS {
        let (session, _) = Cell::new(setup, 7).session(7).unwrap();
        let mut turned = session.clone();
        turned.observations.reverse();
        turned.touches.reverse();
        turned.placements.reverse();
        let bytes = |s| serde_json::to_string(&calibrate(s, &Config::default()).unwrap()).unwrap();
        assert_eq!(bytes(&session), bytes(&turned), "{setup:?}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_result() {
    let eye_to_hand = Cell::new(Setup::EyeToHand, 21);
    // more captures than are left out one at a time, and boards and touches beside them
    let many = Cell { captures: 36, ..Cell::new(Setup::EyeInHand, 22) };
    for cell in [eye_to_hand, many] {
        let (session, _) = cell.session(23).unwrap();
        let by = |threads| {
            let config = Config { threads, ..Config::default() };
            format!("{:?}", calibrate(&session, &config).unwrap())
        };
        assert!(by(1).contains("held_out_mm: Some"));
        assert_eq!(by(1), by(5));
    }
}
