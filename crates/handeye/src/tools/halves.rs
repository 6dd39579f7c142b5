//! Does one half of a session's captures say what the other half says?
//!
//! The captures are divided in three ways, and each half is calibrated alone. Every second capture: the halves have the
//! same places and the same times, so errors that belong to these are in both, and only noise is seen. By place: what the
//! robot misses at some places is in one half. In time: what moves or drifts is in one half. Halves that differ by more
//! than their covariances allow ([`repeat`]) state too small an error.

use serde::Serialize;

use crate::{
    Calibration, Camera, Config, Error, Mount, Observation, Pose, Session, Verdict,
    calibrate::{calibrate, result},
    estimate::place::{Kernel, Place},
};

use super::repeat::{Agreement, LEAST_CHANCE, Repetition, repeat};

/// How captures are divided into halves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Division {
    /// Every second one.
    Alternating,
    /// Those that are near one end of where the robot was, and those near the other one.
    ByPlace,
    /// The earlier and the later ones.
    InTime,
}

/// One way to divide them, and what the halves say.
#[derive(Debug, Clone, PartialEq)]
pub struct Halves {
    /// Which way.
    pub division: Division,
    /// Names of the captures in each half.
    pub captures: [Vec<String>; 2],
    /// What each half alone is judged as.
    pub verdicts: [Verdict; 2],
    /// Where each half alone has the camera; `None` where it leaves that open.
    pub mount_from_camera: [Option<Pose<Mount, Camera>>; 2],
    /// Whether they agree; `None` where one states no covariance.
    pub agreement: Option<Agreement>,
}

/// Fewest captures in a half: fewer state no error that could be tested.
const FEWEST: usize = 6;
/// Over which distance two places of the robot are apart.
const APART: Kernel = Kernel::OF_POSES[1];

/// Calibrates the halves of a session. Touched points are left out: they would be in both.
///
/// # Errors
/// Fewer than twelve captures that show the target; what [`calibrate()`] does not take.
pub fn halves(session: &Session, config: &Config) -> Result<Vec<Halves>, Error> {
    let mut session = session.in_order_of_time();
    session.observations.retain(|o| !o.candidates.is_empty() || !o.surface.is_empty());
    session.touches.clear();
    session.placements.clear();
    let found = session.observations.len();
    if found < 2 * FEWEST {
        let advice = "halves of fewer state no error that could be tested; take more captures";
        return Err(Error::TooFewPoses { found, needed: 2 * FEWEST, advice: advice.into() });
    }
    let by_place =
        session.motion.is_none().then(|| (Division::ByPlace, near(&session.observations)));
    let divided = [
        Some((Division::Alternating, (0..found).step_by(2).collect())),
        by_place,
        Some((Division::InTime, (0..found / 2).collect())),
    ];
    let divided: Vec<(Division, Vec<usize>)> = divided.into_iter().flatten().collect();
    divided.iter().map(|(way, first)| compared(&session, config, *way, first)).collect()
}

/// Whether no way to divide the captures shows more than chance does; `None` where none does and one could not be tested.
pub fn agree(halves: &[Halves]) -> Option<bool> {
    // the least of several chances is small by chance more often
    let least = LEAST_CHANCE / halves.len().max(1) as f64;
    let tested = || halves.iter().filter_map(|h| h.agreement.as_ref());
    if tested().any(|a| a.p_value < least) {
        return Some(false);
    }
    (tested().count() == halves.len()).then_some(true)
}

/// The half whose captures are nearer to one of the two that are farthest apart.
fn near(observations: &[Observation]) -> Vec<usize> {
    let place = |o: &Observation| Place::new(&o.base_from_flange, &[]);
    let places: Vec<Place> = observations.iter().map(place).collect();
    let n = places.len();
    let far = |i: usize, j: usize| 1.0 - APART.at(&places[i], &places[j]);
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    let ends = pairs.max_by(|&(a, b), &(c, d)| far(a, b).total_cmp(&far(c, d)));
    let (one, other) = ends.unwrap_or((0, n - 1));
    let nearer = |k: usize| far(k, one) - far(k, other);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| nearer(a).total_cmp(&nearer(b)));
    let mut half = order[..n / 2].to_vec();
    half.sort_unstable();
    half
}

fn compared(
    session: &Session,
    config: &Config,
    division: Division,
    first: &[usize],
) -> Result<Halves, Error> {
    let half = |is_first: bool| {
        let mut half = session.clone();
        let all = session.observations.iter().enumerate();
        let own = all.filter(|(k, _)| first.binary_search(k).is_ok() == is_first);
        half.observations = own.map(|(_, o)| o.clone()).collect();
        let names: Vec<String> = half.observations.iter().map(|o| o.capture.clone()).collect();
        Ok::<_, Error>((names, calibrate(&half, config)?))
    };
    let ((one, a), (other, b)) = (half(true)?, half(false)?);
    let answers = repetition(&a).zip(repetition(&b));
    let agreement = match answers {
        Some((a, b)) => repeat(&[a, b])?.agreement,
        None => None,
    };
    Ok(Halves {
        division,
        captures: [one, other],
        verdicts: [a.verdict, b.verdict],
        mount_from_camera: [a.hand_eye.mount_from_camera, b.hand_eye.mount_from_camera],
        agreement,
    })
}

fn repetition(result: &Calibration) -> Option<Repetition> {
    Some(Repetition {
        mount_from_camera: result.hand_eye.mount_from_camera?,
        covariance: Some(result::matrix(result.hand_eye.covariance.mount_from_camera.as_ref()?)),
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::{Setup, simulate::Cell};

    fn session(captures: usize) -> Session {
        let cell = Cell { touches: 0, captures, ..Cell::new(Setup::EyeToHand, 4) };
        cell.session(4).unwrap().0
    }

    #[test]
    fn halves_of_a_cell_that_errs_by_chance_alone_agree() {
        let found = halves(&session(24), &Config::default()).unwrap();
        let ways: Vec<_> = found.iter().map(|h| h.division).collect();
        assert_eq!(ways, [Division::Alternating, Division::ByPlace, Division::InTime]);
        assert!(found.iter().all(|h| h.captures.iter().all(|c| c.len() == 12)));
        assert_eq!(agree(&found), Some(true), "{found:?}");
    }

    #[test]
    fn a_camera_that_was_moved_between_two_halves_is_seen_in_time_and_not_by_every_second_capture()
    {
        let moved: Pose<Camera, Camera> =
            Pose::claim(nalgebra::Isometry3::translation(0.002, 0.0, 0.0));
        let mut session = session(24).in_order();
        for (k, o) in session.observations.iter_mut().enumerate() {
            o.corners.clear();
            o.surface.clear();
            for candidate in o.candidates.iter_mut().filter(|_| k >= 12) {
                candidate.camera_from_target = moved * candidate.camera_from_target;
            }
        }
        let mut found = halves(&session, &Config::default()).unwrap();
        assert_eq!(agree(&found), Some(false));
        let p = |h: &Halves| h.agreement.unwrap().p_value;
        assert!(p(&found[0]) > 0.01 && p(&found[2]) < 1e-4, "{found:?}");
        // one way that cannot be tested does not hide another one that contradicts
        found[1].agreement = None;
        assert_eq!(agree(&found), Some(false));
        found.truncate(2);
        assert_eq!(agree(&found), None);
    }

    #[test]
    fn too_few_captures_have_no_halves() {
        let error = halves(&session(11), &Config::default()).unwrap_err();
        assert!(error.to_string().contains("12"), "{error}");
    }

    #[test]
    fn halves_by_place_are_two_ends() {
        let all = session(24).in_order().observations;
        let half = near(&all);
        let x = |k: usize| all[k].base_from_flange.translation();
        let middle =
            |of: &[usize]| of.iter().map(|&k| x(k)).sum::<Vector3<f64>>() / of.len() as f64;
        let rest: Vec<usize> = (0..24).filter(|k| !half.contains(k)).collect();
        let apart = (middle(&half) - middle(&rest)).norm();
        let alternating: Vec<usize> = (0..24).step_by(2).collect();
        let others: Vec<usize> = (1..24).step_by(2).collect();
        assert!(apart > 2.0 * (middle(&alternating) - middle(&others)).norm(), "{apart}");
    }
}
