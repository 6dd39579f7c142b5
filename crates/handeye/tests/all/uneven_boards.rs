//! Boards that are not as they are declared, and no scan shows it.

use handeye::{Calibration, Config, Setup, Verdict, calibrate, simulate::Cell};

const SETUPS: [Setup; 2] = [Setup::EyeInHand, Setup::EyeToHand];

/// The calibration of a cell with such a board, and how far off it is (mm).
fn solved(setup: Setup, seed: u64, print_scale: [f64; 2], bow_mm: f64) -> (Calibration, f64) {
    let usual = Cell::new(setup, seed);
    let cell = Cell { placements: 0, touches: 0, print_scale, bow_mm, ..usual };
    let (session, truth) = cell.session(seed).unwrap();
    let found = calibrate(&session, &Config::default()).unwrap();
    assert_eq!(found.verdict, Verdict::Accepted, "{setup:?} {seed} {:?}", found.reasons);
    let x = found.hand_eye.mount_from_camera.unwrap();
    let off = truth.hand_eye.mount_from_camera.distance_to(&x) * 1e3;
    (found, off)
}

fn warned(found: &Calibration, code: &str) -> bool {
    found.warnings.iter().any(|w| w.code == code)
}

#[test]
fn an_uneven_print_is_named_and_does_little_harm() {
    for setup in SETUPS {
        for (seed, share) in [(1, 0.005), (2, -0.005), (3, 0.01)] {
            let (found, off) = solved(setup, seed, [0.0, share], 0.0);
            println!("{setup:?} {share}: {off:.2} mm");
            assert!(warned(&found, "board-uneven"), "{setup:?} {share} {:?}", found.warnings);
            // without it in the model 3 mm and more
            assert!(off < 1.5, "{setup:?} {share}: {off:.2} mm");
        }
    }
}

#[test]
fn a_bent_board_is_named_and_does_little_harm() {
    for setup in SETUPS {
        for (seed, bow_mm) in [(1, 1.0), (2, -1.0), (3, 2.0)] {
            let (found, off) = solved(setup, seed, [0.0; 2], bow_mm);
            println!("{setup:?} {bow_mm}: {off:.2} mm");
            assert!(warned(&found, "board-bent"), "{setup:?} {bow_mm} {:?}", found.warnings);
            assert!(off < 1.2, "{setup:?} {bow_mm}: {off:.2} mm");
        }
    }
}

#[test]
fn a_right_board_is_not_blamed() {
    for setup in SETUPS {
        for seed in 10..20 {
            let (found, _) = solved(setup, seed, [0.0; 2], 0.0);
            let blamed = warned(&found, "board-uneven") || warned(&found, "board-bent");
            assert!(!blamed, "{setup:?} {seed} {:?}", found.warnings);
        }
    }
}
