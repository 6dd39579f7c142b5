//! Captures of few places: what a robot errs by at a place it errs by in all captures near it, and ten captures there
//! tell no more of the camera's pose than one.
//!
//! Whether the errors belong to the places is seen in the residuals `r` of an answer: of captures `i` at places `g`, with
//! the mean `r_g` of each place,
//!
//! ```text
//! F = (Σ_g n_g |r_g|² / (3 m - 6)) / (Σ_i |r_i - r_g|² / 3 (n - m))
//! ```
//!
//! for the three parts of a position, or of a rotation, of `n` captures at `m` places. Where both scatter alike, all
//! captures count; where places differ by more than chance allows, of each place one counts.
//!
//! The model of errors by place ([`crate::calibrate::robot`]) cannot stand for this. Given a length of 20 mm and
//! 0.03 rad, and all captures, it states variances on the cells below of which the squared error is 7.7 times (median;
//! 1.2 times where one of each place counts): five places tell too little of two levels beside twelve unknowns, and
//! what looks at single captures takes the error of a place for captures that were moved, exchanged or wrong.
//!
//! R. A. Fisher, *Statistical Methods for Research Workers*, 1925 (intraclass correlation).

use nalgebra::{Vector3, Vector6};

use crate::calibrate::captures::repeated::Uncounted;
use crate::{
    Calibration, HandEye, Observation, PosePair,
    math::{lie, statistics},
    model::{residual::Residual, session::Session},
    solve::least_squares,
};

/// Robot poses this close are one place.
const NEAR: Residual = Residual { angle: 1e-2, distance: 6e-3 };
/// Part of the captures that must lie near others: below it, places make no difference.
const LEAST_SHARE: f64 = 0.25;
/// Scatter below this within a place, rad and m alike, is as good as none: no robot errs by less, and rounding does.
const EXACT: f64 = 1e-5;
/// Chance of an F as large where errors do not belong to places.
const IMPROBABLE: f64 = 1e-3;

/// The session without captures whose errors are those of another one at the same place, as an answer shows them.
pub(crate) fn take_out(session: &Session, found: &Calibration) -> (Session, Uncounted) {
    let all_count = || (session.clone(), Uncounted::none());
    let Some(hand_eye) = found.hand_eye.hand_eye() else { return all_count() };
    // rejected ones as well: where places differ, captures of one agree with each other alone
    let places = places(&session.observations);
    if !errors_belong_to(&places, |i| residual(session, &hand_eye, i)) {
        return all_count();
    }
    let first_of = |i: usize| places.iter().find(|p| p[1..].contains(&i)).map(|p| p[0]);
    let (mut kept, mut out) = (vec![], vec![]);
    for (i, capture) in session.observations.iter().enumerate() {
        match first_of(i) {
            Some(first) => {
                out.push((capture.clone(), session.observations[first].capture.clone()));
            }
            None => kept.push(capture.clone()),
        }
    }
    (Session { observations: kept, ..session.clone() }, Uncounted::of_one_place(out))
}

/// Captures in groups about the first of each place.
fn places(all: &[Observation]) -> Vec<Vec<usize>> {
    let near = |a: usize, b: usize| {
        Residual::are_within(&all[a].base_from_flange, &all[b].base_from_flange, NEAR)
    };
    let mut places: Vec<Vec<usize>> = vec![];
    for i in (0..all.len()).filter(|i| !all[*i].candidates.is_empty()) {
        match places.iter_mut().find(|p| near(p[0], i)) {
            Some(place) => place.push(i),
            None => places.push(vec![i]),
        }
    }
    places
}

/// The residual of a capture, of its candidates the nearest one's.
fn residual(session: &Session, hand_eye: &HandEye, i: usize) -> Option<Vector6<f64>> {
    let o = &session.observations[i];
    let anchor_from_mount = session.setup.anchor_from_mount(o.base_from_flange);
    let of = |camera_from_target| {
        least_squares::residual(hand_eye, &PosePair { anchor_from_mount, camera_from_target })
    };
    let all = o.candidates.iter().map(|c| of(c.camera_from_target));
    all.min_by(|a, b| a.norm().total_cmp(&b.norm()))
}

fn errors_belong_to(
    places: &[Vec<usize>],
    residual: impl Fn(usize) -> Option<Vector6<f64>>,
) -> bool {
    let count: usize = places.iter().map(Vec::len).sum();
    let near = count - places.len();
    let places: Vec<&Vec<usize>> = places.iter().filter(|p| p.len() > 1).collect();
    if (near as f64) < LEAST_SHARE * count as f64 || places.len() < 3 {
        return false;
    }
    let of = |part: fn(&Vector6<f64>) -> Vector3<f64>| {
        let (mut between, mut within) = (0.0, 0.0);
        for place in &places {
            let all: Vec<Vector3<f64>> =
                place.iter().filter_map(|&i| residual(i)).map(|r| part(&r)).collect();
            let mean = all.iter().sum::<Vector3<f64>>() / all.len().max(1) as f64;
            between += mean.norm_squared() * all.len() as f64;
            within += all.iter().map(|r| (r - mean).norm_squared()).sum::<f64>();
        }
        let degrees = (3.0 * places.len() as f64 - 6.0, 3.0 * near as f64);
        let f = (between / degrees.0) / (within / degrees.1).max(EXACT.powi(2));
        statistics::of_f(f, degrees) < IMPROBABLE
    };
    of(lie::omega) || of(lie::nu)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use nalgebra::{Isometry3, Matrix6};

    use super::*;
    use crate::{
        Base, Camera, Config, Flange, Mount, Pose, Setup, calibrate, math::random::Random,
    };

    const PLACES: usize = 5;
    /// The robot's error at a place, per axis: rad and m; and what a camera adds.
    const ROBOT: (f64, f64) = (5e-4, 3e-4);
    const CAMERA: (f64, f64) = (1e-4, 5e-5);

    fn twist(random: &mut Random, (turn, way): (f64, f64)) -> Isometry3<f64> {
        let (w, v) = (random.normal3() * turn, random.normal3() * way);
        Isometry3::new(v, w)
    }

    /// Captures at five places, three at each: the robot errs by place, or in each capture anew.
    fn session(seed: u64, by_place: bool) -> (Session, Pose<Mount, Camera>) {
        let mut random = Random::new(seed);
        let x: Isometry3<f64> = twist(&mut random, (0.5, 0.1));
        let y = Isometry3::new(Vector3::new(0.6, 0.1, 0.0), Vector3::zeros());
        let mut observations = vec![];
        for place in 0..PLACES {
            let about = Isometry3::new(Vector3::new(0.5, 0.0, 0.5), random.normal3() * 0.5)
                * twist(&mut random, (0.0, 0.1));
            let error = twist(&mut random, ROBOT);
            for k in 0..3 {
                let true_pose = about * twist(&mut random, (2e-3, 1e-3));
                let own = if by_place { error } else { twist(&mut random, ROBOT) };
                let seen = (true_pose * x).inverse() * y * twist(&mut random, CAMERA);
                observations.push(Observation::bare(
                    format!("{place}{k}"),
                    Pose::<Base, Flange>::claim(true_pose * own),
                    Pose::claim(seen),
                ));
            }
        }
        (Session::of_captures(Setup::EyeInHand, observations), Pose::claim(x))
    }

    /// Squared error of the answer over the stated covariance, median of some cells, over its expectation.
    fn normalised(by_place: bool) -> f64 {
        let of = |seed| {
            let (session, truth) = session(seed, by_place);
            let found = calibrate(&session, &Config::default()).unwrap();
            let told = found.warnings.iter().any(|w| w.code == "captures-of-one-place");
            assert_eq!(told, by_place, "seed {seed}: {:?}", found.warnings);
            assert_eq!(found.captures.len(), session.observations.len());
            let off = found.hand_eye.mount_from_camera.unwrap().local(&truth);
            let stated: Matrix6<f64> = crate::calibrate::result::matrix(
                &found.hand_eye.covariance.mount_from_camera.unwrap(),
            );
            off.dot(&(stated.try_inverse().unwrap() * off)) / 6.0
        };
        let mut all: Vec<f64> = (0..15).map(of).collect();
        all.sort_by(f64::total_cmp);
        println!("{all:.1?}");
        all[all.len() / 2]
    }

    #[test]
    fn captures_of_few_places_are_not_independent() {
        assert!(normalised(true) < 2.0);
    }

    #[test]
    fn captures_that_err_each_on_their_own_all_count() {
        assert!(normalised(false) < 2.0);
    }

    #[test]
    fn places_are_those_of_the_robot() {
        let (session, _) = session(1, true);
        let places = places(&session.observations);
        assert_eq!(
            places,
            (0..PLACES).map(|p| vec![3 * p, 3 * p + 1, 3 * p + 2]).collect::<Vec<_>>()
        );
    }
}
