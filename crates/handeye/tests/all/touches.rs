//! Touches that cannot be registered, and registrations that pair the wrong corners.

use handeye::{
    Config, Error, Method, Session, Setup, Verdict, calibrate,
    estimate::{
        KnownNoise,
        predict::{Volume, difference},
        touch_pairs::{Registration, fit_touches},
    },
    register::IcpConfig,
    simulate::{Cell, Truth},
};
use nalgebra::{Vector3, Vector6};

use crate::problem::{pairs_of_touches, start};

const SETUPS: [Setup; 2] = [Setup::EyeInHand, Setup::EyeToHand];

/// A session whose touches are those of the corners for which `keep` holds (column, row of 9 x 6).
fn session(setup: Setup, keep: impl Fn(u32, u32) -> bool) -> (Session, Truth) {
    let placements = usize::from(setup == Setup::EyeToHand);
    let cell = Cell { placements, touches: 54, ..Cell::new(setup, 8) };
    let (mut session, truth) = cell.session(8).unwrap();
    session.touches.retain(|t| keep(t.corner % 9, t.corner / 9));
    (session, truth)
}

fn register(session: &Session, registration: Registration) -> Result<usize, Error> {
    let touched = pairs_of_touches(session);
    let all: Vec<_> = touched.iter().collect();
    let begin = start(session, Method::Shah).mount_from_camera;
    fit_touches(&all, &begin, registration).map(|fit| fit.wrong_matches)
}

fn has(found: &handeye::Calibration, candidate: &str) -> bool {
    found.candidates.iter().any(|c| c.name == candidate)
}

/// Eye-in-hand, each view shows the line from elsewhere, and together they determine the camera.
#[test]
fn touches_on_a_line_are_refused_by_name_and_still_serve_the_joint_fit() {
    let (session, truth) = session(Setup::EyeToHand, |_, row| row == 2);
    let refused = register(&session, Registration::Svd);
    assert!(matches!(refused, Err(Error::Collinear { .. })), "{refused:?}");
    let found = calibrate(&session, &Config::default()).unwrap();
    assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
    assert!(!has(&found, "two-step-svd") && !has(&found, "two-step-icp"));
    let warning = found.warnings.iter().find(|w| w.code == "touches-not-enough").unwrap();
    assert!(warning.message.contains("on one line"), "{}", warning.message);
    assert!(found.touches.iter().all(|t| t.used));
    let x = found.hand_eye.mount_from_camera.unwrap();
    let off = x.distance_to(&truth.hand_eye.mount_from_camera);
    assert!(off < 2e-3, "{off}");
}

#[test]
fn two_touches_are_refused_by_name() {
    for setup in SETUPS {
        let (session, _) = session(setup, |column, row| column % 8 == 0 && row == 2);
        let refused = register(&session, Registration::Svd);
        assert!(matches!(refused, Err(Error::TooFewPoints { found: 2, needed: 3 })));
        let found = calibrate(&session, &Config::default()).unwrap();
        assert!(!has(&found, "two-step-svd") && has(&found, "joint"), "{setup:?}");
    }
}

/// Corners are known by their ids. Neighbours serve one candidate, for comparison; it is never
/// chosen where they differ from what was touched.
#[test]
fn nearest_neighbours_that_are_other_corners_are_noticed() {
    let (session, _) = session(Setup::EyeToHand, |column, row| column < 4 && row < 4);
    let touched = pairs_of_touches(&session);
    let all: Vec<_> = touched.iter().collect();
    let near = start(&session, Method::Shah).mount_from_camera;
    let config = IcpConfig { max_correspondence_distance_m: 0.02, ..IcpConfig::default() };
    let right = fit_touches(&all, &near, Registration::Icp(config)).unwrap();
    assert_eq!(right.wrong_matches, 0);
    let next_corner = Vector6::new(0.0, 0.0, 0.0, 0.03, 0.0, 0.0);
    let far = near.retract(&next_corner);
    let wrong = fit_touches(&all, &far, Registration::Icp(config)).unwrap();
    assert!(wrong.wrong_matches > 0);
    assert!(wrong.mount_from_camera.distance_to(&right.mount_from_camera) > 5e-3);
    // known correspondences need no start
    let svd = |start| fit_touches(&all, start, Registration::Svd).unwrap().mount_from_camera;
    assert_eq!(svd(&near), svd(&far));
}

/// A tip that is known narrows what the touches leave open; the same cells, told and not told.
#[test]
fn a_tip_that_is_known_makes_the_answer_better_and_surer() {
    let told = Config {
        known: KnownNoise { tip_m: Some(0.05e-3), ..KnownNoise::default() },
        ..Config::default()
    };
    let volume = Volume::of_box(
        &Vector3::new(-0.2, -0.15, 0.95),
        &Vector3::new(0.2, 0.15, 1.15),
        "the table",
    );
    let (mut squares, mut stated) = ([0.0; 2], [0.0; 2]);
    for seed in 0..6 {
        let cell = Cell { placements: 1, touches: 9, ..Cell::new(Setup::EyeToHand, 60 + seed) };
        let (session, truth) = cell.session(60 + seed).unwrap();
        for (k, config) in [&Config::default(), &told].into_iter().enumerate() {
            let found = calibrate(&session, config).unwrap();
            let x = found.hand_eye.mount_from_camera.unwrap();
            let off = difference(&truth.hand_eye.mount_from_camera, &x);
            squares[k] += volume.points.iter().map(|p| off(p).norm_squared()).sum::<f64>();
            stated[k] += found.predicted_tre_mm.unwrap().rms;
        }
    }
    // in one cell or another, a tip that can not be wrong leaves the robot in doubt instead
    assert!(stated[1] < stated[0], "{stated:?}");
    assert!(squares[1] < 0.7 * squares[0], "{squares:?}");
}

fn renamed(session: &Session, way: impl Fn(u32) -> u32) -> Session {
    let mut session = session.clone();
    session.touches.iter_mut().for_each(|t| t.corner = way(t.corner));
    session
}

#[test]
fn two_touches_exchanged_are_left_out_and_named() {
    for setup in SETUPS {
        let (session, _) = session(setup, |column, row| column % 4 == 0 && row % 5 == 0);
        let mut swapped = session.clone();
        let (a, b) = (swapped.touches[0].corner, swapped.touches[5].corner);
        (swapped.touches[0].corner, swapped.touches[5].corner) = (b, a);
        let found = calibrate(&swapped, &Config::default()).unwrap();
        assert_eq!(found.verdict, Verdict::Accepted, "{setup:?}: {:?}", found.reasons);
        let left_out = |corner: u32| corner == a || corner == b;
        assert!(found.touches.iter().all(|t| t.used != left_out(t.corner)), "{:?}", found.touches);
        let named = |corner: u32, other: u32| {
            let text = format!("the touch of corner {corner} of ");
            found.warnings.iter().any(|w| {
                w.code == "touch-rejected"
                    && w.message.starts_with(&text)
                    && w.message.ends_with(&format!("exchanged with that of corner {other}"))
            })
        };
        assert!(named(a, b) && named(b, a), "{setup:?}: {:?}", found.warnings);
    }
}

type Way = fn(u32) -> u32;

#[test]
fn touches_under_other_ids_contradict_the_views_and_the_way_of_counting_is_named() {
    for setup in SETUPS {
        let (session, _) = session(setup, |column, row| column % 4 == 0 && row % 5 == 0);
        let ways: [(&str, Way); 4] = [
            ("rotated by 180 degrees", |id| 53 - id),
            ("counted from 1", |id| (id + 1).min(53)),
            ("column by column", |id| id % 9 * 6 + id / 9),
            ("the other side", |id| id / 9 * 9 + 8 - id % 9),
        ];
        for (name, way) in ways {
            let found = calibrate(&renamed(&session, way), &Config::default()).unwrap();
            assert_eq!(found.verdict, Verdict::Rejected, "{setup:?} {name}");
            assert!(found.reasons[0].contains(name), "{setup:?} {name}: {:?}", found.reasons);
            assert!(found.touches.iter().all(|t| !t.used), "{setup:?} {name}");
        }
    }
}

/// A line that was copied is no second measurement: it must not make the answer surer.
#[test]
fn a_touch_that_is_listed_several_times_counts_once() {
    let (session, _) = session(Setup::EyeToHand, |column, row| column % 8 == 0 && row % 5 == 0);
    let mut copied = session.clone();
    copied.touches.extend(vec![session.touches[0].clone(); 3]);
    let once = calibrate(&session, &Config::default()).unwrap();
    let mut found = calibrate(&copied, &Config::default()).unwrap();
    let repeated: Vec<_> = found.warnings.extract_if(.., |w| w.code == "touch-repeated").collect();
    found.findings.retain(|f| f.code != "touch-repeated");
    assert_eq!(repeated.len(), 1);
    assert!(repeated[0].message.contains("listed 4 times"), "{}", repeated[0].message);
    assert_eq!(once, found);
}

/// Millimetres in one column that is read as metres: the touches are to blame, not the poses.
#[test]
fn touches_that_lie_metres_from_the_views_are_blamed_themselves() {
    for setup in SETUPS {
        let (mut session, truth) = session(setup, |column, row| column % 8 == 0 && row % 5 == 0);
        for touch in &mut session.touches {
            let mut at = touch.in_base.vector();
            at.x *= 1e3;
            touch.in_base = handeye::Point::from_vector(at);
        }
        let found = calibrate(&session, &Config::default()).unwrap();
        assert_eq!(found.verdict, Verdict::Rejected);
        assert_eq!(found.reasons.len(), 1, "{:?}", found.reasons);
        assert!(found.reasons[0].contains("the length unit of [touches]"), "{:?}", found.reasons);
        assert!(found.touches.len() == session.touches.len() && !found.touches[0].used);
        let x = found.hand_eye.mount_from_camera.unwrap();
        assert!(
            x.distance_to(&truth.hand_eye.mount_from_camera) < 3e-3,
            "the views' answer stands"
        );
    }
}

/// A tip that is declared in metres where millimetres are asked for, a hand's breadth from the flange.
#[test]
fn a_tip_in_metres_is_told() {
    let (mut session, _) = session(Setup::EyeInHand, |column, row| column % 8 == 0 && row % 5 == 0);
    for touch in &mut session.touches {
        let flange = touch.base_from_flange.unwrap().translation();
        let tip = touch.in_base.vector() - flange;
        touch.in_base = handeye::Point::from_vector(flange + tip * 1e-3);
    }
    let found = calibrate(&session, &Config::default()).unwrap();
    assert!(
        found.reasons[0].contains("in_flange_mm of [touches.tip] seems to be in metres"),
        "{:?}",
        found.reasons
    );
}

#[test]
fn touches_in_another_unit_are_told_which() {
    let units = [("m", 1.0), ("cm", 1e-2), ("mm", 1e-3), ("inch", 25.4e-3)];
    for setup in SETUPS {
        let (right, _) = session(setup, |column, row| column % 8 == 0 && row % 5 == 0);
        for (read, meant) in units.iter().flat_map(|read| units.map(|meant| (*read, meant))) {
            let mut session = right.clone();
            let factor = read.1 / meant.1;
            for (k, touch) in session.touches.iter_mut().enumerate() {
                // tips themselves, or flange poses and a tip that has its own unit
                let flange = touch.base_from_flange.filter(|_| k % 2 == 0);
                let from = flange.map_or(Vector3::zeros(), |f| f.translation());
                let at = match flange {
                    Some(_) => touch.in_base.vector() + from * (factor - 1.0),
                    None => touch.in_base.vector() * factor,
                };
                touch.in_base = handeye::Point::from_vector(at);
                touch.base_from_flange = flange.map(|f| f.farther(factor));
            }
            let found = calibrate(&session, &Config::default()).unwrap();
            if read.0 == meant.0 {
                assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
                continue;
            }
            let told = format!("the touches agree if their unit is {}, not {}", meant.0, read.0);
            assert_eq!(found.verdict, Verdict::Rejected);
            assert!(found.reasons[0].contains(&told), "{told}: {:?}", found.reasons);
        }
    }
}
