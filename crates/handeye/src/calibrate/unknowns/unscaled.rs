//! Target poses whose distances are known up to one factor: `measured = scale * metric`.
//!
//! A camera that reconstructs the scene, or a target of unknown size, gives rotations and
//! directions but no metres; the robot's motions do. A first factor comes from the linear system of
//! Andreff, Horaud and Espiau, over all captures and over small sets of them, the one that most
//! captures agree with; then it is one more unknown of the joint fit, without a prior,
//! which is linearised anew until it stays. Where the mount only turns about one point, or hardly
//! moves, the factor goes along with the camera's position, and both are called undetermined.
//!
//! N. Andreff, R. Horaud and B. Espiau, *Robot hand-eye calibration using structure-from-motion*,
//! IJRR 20(3), 2001.

use super::settle::{self, Captures, Stand};
use crate::{
    Config, Error, PosePair, Session,
    math::subsets::{self, Draw},
    solve::{FEWEST_POSES, andreff},
};

/// Refuses what has a unit of its own.
pub(crate) fn check(session: &Session) -> Result<(), Error> {
    let bare = session.target.is_none()
        && session.touches.is_empty()
        && session.correspondences.is_empty();
    if bare {
        return Ok(());
    }
    Err(Error::Invalid(
        "an unknown scale is for bare target poses: a target of known size, touches and points \
         have their unit"
            .into(),
    ))
}

/// The session in metres, and the factor that was taken out of its distances.
pub(crate) fn in_metres(session: &Session, config: &Config) -> Result<(Session, f64), Error> {
    let pairs = pairs(session);
    let at = |stand: Stand| Captures {
        pairs: pairs.iter().map(|p| p.farther(1.0 / stand.scale)).collect(),
        velocities: None,
    };
    let start = Stand { offset: 0.0, scale: first_scale(&pairs)? };
    let settled = settle::settle(start, true, session.setup, &config.known, at)?;
    let scale = settled.stand.scale;
    Ok((divided(session, scale), scale))
}

/// The session with a factor taken out of its distances.
pub(crate) fn divided(session: &Session, scale: f64) -> Session {
    let mut session = session.clone();
    for pose in session.observations.iter_mut().flat_map(|o| &mut o.candidates) {
        pose.camera_from_target = pose.camera_from_target.farther(1.0 / scale);
    }
    session
}

fn pairs(session: &Session) -> Vec<PosePair> {
    let pair = |o: &crate::Observation| {
        Some(PosePair {
            anchor_from_mount: session.setup.anchor_from_mount(o.base_from_flange),
            camera_from_target: o.candidates.first()?.camera_from_target,
        })
    };
    session.observations.iter().filter_map(pair).collect()
}

/// Small sets that are drawn; with 40 % wrong captures one in eight sets of four is clean.
const DRAWS: usize = 60;
/// Captures in a small set: one more than needed.
const DRAWN: usize = FEWEST_POSES + 1;

/// `measured / metric` as most captures have it.
///
/// # Errors
/// As [`andreff::solve_with_scale`].
pub(crate) fn first_scale(pairs: &[PosePair]) -> Result<f64, Error> {
    let whole = andreff::solve_with_scale(pairs);
    let small =
        draws(pairs.len()).filter_map(|set| andreff::solve_with_scale(&set.map(|i| pairs[i])).ok());
    let score = |s: &andreff::Scaled| {
        let metric: Vec<PosePair> = pairs.iter().map(|p| p.farther(s.scale)).collect();
        settle::residual(&s.hand_eye, &metric)
    };
    let all = whole.clone().ok().into_iter().chain(small);
    let best = all.map(|s| (score(&s), s)).min_by(|a, b| a.0.total_cmp(&b.0));
    match best {
        Some((_, best)) => Ok(1.0 / best.scale),
        None => whole.map(|s| 1.0 / s.scale),
    }
}

/// Small sets spread over all captures; none where these are no more than one set.
fn draws(n: usize) -> impl Iterator<Item = [usize; DRAWN]> {
    subsets::drawn(n, if n > DRAWN { DRAWS } else { 0 }, Draw::Even)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Calibration, HandEye, Observation, Pose, Setup, Verdict, calibrate,
        math::{lie, random::Random},
        solve::{
            Method,
            tests::{exact_pairs, noisy_pairs, pose, truths},
        },
    };

    fn session(setup: Setup, pairs: &[PosePair], scale: f64) -> Session {
        let observation = |(k, p): (usize, &PosePair)| {
            let robot = match setup {
                Setup::EyeInHand => p.anchor_from_mount.rename(),
                Setup::EyeToHand => p.anchor_from_mount.inverse().rename(),
            };
            Observation::bare(format!("{k:02}"), robot, p.camera_from_target.farther(scale))
        };
        Session {
            unknown_scale: true,
            in_sequence: true,
            ..Session::of_captures(setup, pairs.iter().enumerate().map(observation).collect())
        }
    }

    fn solved(session: &Session) -> Calibration {
        calibrate(session, &Config::default()).unwrap()
    }

    fn miss(found: &Calibration, truth: &HandEye) -> f64 {
        found.hand_eye.mount_from_camera.unwrap().distance_to(&truth.mount_from_camera)
    }

    #[test]
    fn exact_poses_in_any_unit_give_metres() {
        for setup in [Setup::EyeInHand, Setup::EyeToHand] {
            for truth in truths() {
                for scale in [0.001, 0.3, 1.0, 1000.0] {
                    let found = solved(&session(setup, &exact_pairs(&truth, 15), scale));
                    assert_eq!(found.verdict, Verdict::Accepted);
                    assert!((found.scale.unwrap() / scale - 1.0).abs() < 1e-6);
                    assert!(miss(&found, &truth) < 1e-6);
                    let y = found.hand_eye.anchor_from_target.unwrap();
                    assert!(y.distance_to(&truth.anchor_from_target) < 1e-6);
                }
            }
        }
    }

    #[test]
    fn under_noise_the_error_of_the_scale_stays_inside_its_sigma() {
        let (mut squares, trials) = (0.0, 40);
        for seed in 0..trials {
            let mut random = Random::new(seed);
            let mut pairs = exact_pairs(&truths()[0], 20);
            for pair in &mut pairs {
                let off = lie::tangent(&(random.normal3() * 2e-3), &(random.normal3() * 2e-3));
                pair.camera_from_target = pair.camera_from_target.retract(&off);
            }
            let found = solved(&session(Setup::EyeInHand, &pairs, 0.2));
            squares += ((found.scale.unwrap() - 0.2) / found.scale_sigma.unwrap()).powi(2);
        }
        let mean = squares / trials as f64;
        assert!((0.5..1.8).contains(&mean), "{mean}");
    }

    #[test]
    fn wrong_captures_do_not_spoil_the_scale() {
        let mut pairs = noisy_pairs(&truths()[0], 20);
        for k in [1, 6, 11, 16] {
            pairs[k].camera_from_target =
                pose([0.1, 0.2, 0.4 + 0.1 * k as f64], [0.1, 2.0, k as f64]);
        }
        let found = solved(&session(Setup::EyeInHand, &pairs, 5.0));
        assert!((found.scale.unwrap() / 5.0 - 1.0).abs() < 0.02, "{:?}", found.scale);
        assert_eq!(found.rejected, ["01", "06", "11", "16"]);
    }

    #[test]
    fn a_mount_that_only_turns_about_a_point_leaves_the_scale_open() {
        for noise in [0.0, 5e-4] {
            let mut random = Random::new(3);
            let mut pairs = exact_pairs(&truths()[0], 20);
            for pair in &mut pairs {
                let mut iso = *pair.anchor_from_mount.iso();
                iso.translation.vector = nalgebra::Vector3::new(0.5, 0.1, 0.6);
                pair.anchor_from_mount = Pose::claim(iso);
                let seen = (pair.anchor_from_mount * truths()[0].mount_from_camera).inverse()
                    * truths()[0].anchor_from_target;
                let off = lie::tangent(&(random.normal3() * noise), &(random.normal3() * noise));
                pair.camera_from_target = seen.retract(&off);
            }
            let found = solved(&session(Setup::EyeInHand, &pairs, 2.0));
            assert_eq!(found.verdict, Verdict::Undetermined, "{noise}: {:?}", found.reasons);
            assert_eq!((found.scale, found.hand_eye.mount_from_camera), (None, None));
            assert!(
                found.undetermined.iter().any(|u| u.contains("scale")),
                "{:?}",
                found.undetermined
            );
        }
    }

    #[test]
    fn a_method_that_finds_the_scale_reports_its_own() {
        let pairs = noisy_pairs(&truths()[0], 15);
        let named = |method: Method| Config { method: Some(method), ..Config::default() };
        let own = 3.0 / andreff::solve_with_scale(&pairs).unwrap().scale;
        let metric = Session { unknown_scale: false, ..session(Setup::EyeInHand, &pairs, 1.0) };
        let session = session(Setup::EyeInHand, &pairs, 3.0);
        let by = |method| calibrate(&session, &named(method)).unwrap().scale.unwrap();
        assert!((by(Method::AndreffScaled) / own - 1.0).abs() < 1e-9);
        let likeliest = solved(&session).scale.unwrap();
        assert!((by(Method::Shah) / likeliest - 1.0).abs() < 1e-12);
        assert!((likeliest / own - 1.0).abs() > 1e-6);
        // it takes its factor out even where nobody calls the scale unknown
        let found = calibrate(&metric, &named(Method::AndreffScaled)).unwrap();
        assert!((found.scale.unwrap() * 3.0 / own - 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_order_of_the_captures_does_not_matter() {
        let one = session(Setup::EyeInHand, &noisy_pairs(&truths()[0], 12), 3.0);
        let mut other = one.clone();
        other.observations.reverse();
        assert_eq!(solved(&one), solved(&other));
    }
}
