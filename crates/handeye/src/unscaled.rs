//! Target poses whose distances are known up to one factor: `measured = scale * metric`.
//!
//! A camera that reconstructs the scene, or a target of unknown size, gives rotations and
//! directions but no metres; the robot's motions do. A first factor comes from the linear system of
//! Andreff, Horaud and Espiau, over all captures and over small sets of them, the one that most
//! captures agree with; then it is one more unknown of the joint fit, with no belief beforehand,
//! which is linearised anew until it stays. Where the mount only turns about one point, or hardly
//! moves, the factor goes along with the camera's position, and both are called undetermined.
//!
//! N. Andreff, R. Horaud and B. Espiau, *Robot hand-eye calibration using structure-from-motion*,
//! IJRR 20(3), 2001.

use crate::{
    Calibration, Config, Error, Pose, PosePair, Session,
    calibrate::{
        self,
        settle::{self, Captures, Stand},
    },
    solve::{FEWEST_POSES, andreff},
};

/// Calibrates from bare target poses in an unknown unit. The answer, and all poses in the result,
/// are in metres; `scale` is the factor.
///
/// # Errors
/// As [`calibrate::calibrate`]; also when the session holds pictures, scans or touches, which have a
/// unit.
pub fn calibrate_unscaled(session: &Session, config: &Config) -> Result<Calibration, Error> {
    let bare = session.target.is_none()
        && session.touches.is_empty()
        && session.correspondences.is_empty();
    if !bare {
        return Err(Error::Invalid(
            "an unknown scale is for bare target poses: a target of known size, touches and points \
             have their unit"
                .into(),
        ));
    }
    let session = calibrate::in_order(session);
    let pairs = pairs(&session);
    let at = |stand: Stand| Captures {
        pairs: pairs.iter().map(|p| metric(p, stand.scale)).collect(),
        velocities: None,
    };
    let settled = first_scale(&pairs).and_then(|scale| {
        let start = Stand { offset: 0.0, scale };
        settle::settle(start, true, session.setup, &config.known, at)
    });
    match settled {
        Ok(settled) => calibrate_at(&session, settled.stand.scale, config),
        Err(error) => undetermined(&session, &error),
    }
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

/// The result with this factor taken out and free from there on.
pub(crate) fn calibrate_at(
    session: &Session,
    scale: f64,
    config: &Config,
) -> Result<Calibration, Error> {
    let mut session = session.clone();
    for pose in session.observations.iter_mut().flat_map(|o| &mut o.candidates) {
        pose.camera_from_target = shrunk(&pose.camera_from_target, scale);
    }
    let mut config = config.clone();
    config.unknown.scale = true;
    let mut result = calibrate::calibrate(&session, &config)?;
    match result.scale_sigma {
        Some(sigma) => {
            result.scale = result.scale.map(|s| s * scale);
            result.scale_sigma = Some(sigma * scale);
        }
        None => {
            result.scale = None;
            name(&mut result.undetermined, SCALE);
        }
    }
    Ok(result)
}

/// What is undetermined, in words.
pub(crate) const SCALE: &str = "scale of the measured distances";

/// Names what is undetermined, once.
pub(crate) fn name(undetermined: &mut Vec<String>, what: &str) {
    if !undetermined.iter().any(|u| u == what) {
        undetermined.push(what.into());
    }
}

/// The result without an answer.
pub(crate) fn undetermined(session: &Session, error: &Error) -> Result<Calibration, Error> {
    let mut result = calibrate::without_answer(session)?;
    result.scale = None;
    result.reasons.push(error.to_string());
    let camera = format!("the pose of the camera on the {}", session.setup.mount());
    result.undetermined.extend([SCALE.into(), camera]);
    Ok(result)
}

/// The pair in metres.
pub(crate) fn metric(pair: &PosePair, scale: f64) -> PosePair {
    PosePair { camera_from_target: shrunk(&pair.camera_from_target, scale), ..*pair }
}

fn shrunk<A, B>(pose: &Pose<A, B>, scale: f64) -> Pose<A, B> {
    let mut iso = *pose.iso();
    iso.translation.vector /= scale;
    Pose::claim(iso)
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
    let sets = draws(pairs.len()).into_iter();
    let small = sets.filter_map(|set| {
        let some: Vec<PosePair> = set.into_iter().map(|i| pairs[i]).collect();
        andreff::solve_with_scale(&some).ok()
    });
    let score = |s: &andreff::Scaled| {
        let metric: Vec<PosePair> = pairs.iter().map(|p| self::metric(p, 1.0 / s.scale)).collect();
        settle::misfit(&s.hand_eye, &metric)
    };
    let all = whole.clone().ok().into_iter().chain(small);
    let best = all.map(|s| (score(&s), s)).min_by(|a, b| a.0.total_cmp(&b.0));
    match best {
        Some((_, best)) => Ok(1.0 / best.scale),
        None => whole.map(|s| 1.0 / s.scale),
    }
}

/// A fixed pseudo-random choice of small sets.
fn draws(n: usize) -> Vec<[usize; DRAWN]> {
    if n <= DRAWN {
        return vec![];
    }
    let mut random = crate::simulate::Random::new(n as u64);
    let mut draw = || {
        let mut set: [usize; DRAWN] =
            std::array::from_fn(|_| ((random.unit() * n as f64) as usize).min(n - 1));
        set.sort_unstable();
        set
    };
    let all = (0..DRAWS).map(|_| draw());
    all.filter(|s| s.windows(2).all(|w| w[0] != w[1])).collect()
}
