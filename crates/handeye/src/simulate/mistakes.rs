//! What people and programs get wrong while they take captures.
//!
//! A session is spoilt in place, capture by capture; what was spoilt is told, so that a test can
//! compare with the answer of the captures that are left.

use nalgebra::{Isometry3, Rotation3, UnitQuaternion, Vector3};

use crate::{
    Base, Camera, Flange, ImageCorner, Observation, Point, Pose, Session, Target, detect,
    math::random::Random,
};

/// One kind of mistake.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mistake {
    /// The board was read turned by half a turn.
    Turned,
    /// Two captures have each other's robot pose.
    Exchanged,
    /// The robot pose is that of the capture before: read too early.
    Stale,
    /// The corners are one column off, or the pose is far off.
    WrongDetection,
    /// The other solution of a planar target: its normal mirrored at the line of sight.
    Mirrored,
    /// From one capture to another, each has the robot pose of the capture after it.
    Shifted,
    /// The robot was not at rest yet: where it says it is, it is off by 3 to 10 mm, up to a degree.
    Moving,
}

impl Mistake {
    /// Every kind.
    pub const ALL: [Mistake; 7] = [
        Mistake::Turned,
        Mistake::Exchanged,
        Mistake::Stale,
        Mistake::WrongDetection,
        Mistake::Mirrored,
        Mistake::Shifted,
        Mistake::Moving,
    ];

    /// Words for tables.
    pub fn name(self) -> &'static str {
        match self {
            Mistake::Turned => "board turned",
            Mistake::Exchanged => "captures exchanged",
            Mistake::Stale => "stale robot pose",
            Mistake::WrongDetection => "wrong detection",
            Mistake::Mirrored => "mirrored pose",
            Mistake::Shifted => "run off by one",
            Mistake::Moving => "robot not at rest",
        }
    }
}

/// Spoils up to `most` captures with mistakes drawn from `kinds`; which ones, and by what, in the
/// order of the captures. Nothing is spoilt twice.
pub fn spoil(
    session: &mut Session,
    kinds: &[Mistake],
    most: usize,
    random: &mut Random,
) -> Vec<(usize, Mistake)> {
    let robot: Vec<Pose<Base, Flange>> =
        session.observations.iter().map(|o| o.base_from_flange).collect();
    let mut spoilt: Vec<(usize, Mistake)> = Vec::new();
    for _ in 0..MOST_DRAWS {
        if spoilt.len() >= most || kinds.is_empty() {
            break;
        }
        let kind = kinds[below(random, kinds.len())];
        let chosen = choose(kind, session.observations.len(), most - spoilt.len(), random);
        if chosen.is_empty() || chosen.iter().any(|i| spoilt.iter().any(|(k, _)| k == i)) {
            continue;
        }
        commit(session, kind, &chosen, &robot, random);
        spoilt.extend(chosen.into_iter().map(|i| (i, kind)));
    }
    spoilt.sort_unstable();
    spoilt
}

/// Captures are drawn until enough are spoilt, this many times at most.
const MOST_DRAWS: usize = 1000;

fn below(random: &mut Random, n: usize) -> usize {
    (random.bits() % n.max(1) as u64) as usize
}

/// Which captures one mistake spoils: one, a pair, or a run; none where that does not fit.
fn choose(kind: Mistake, n: usize, most: usize, random: &mut Random) -> Vec<usize> {
    let i = below(random, n);
    match kind {
        Mistake::Exchanged => {
            let j = below(random, n);
            if i == j || most < 2 { vec![] } else { vec![i, j] }
        }
        Mistake::Stale if i == 0 => vec![],
        Mistake::Shifted => {
            let length = 1 + below(random, most);
            if i + length < n { (i..i + length).collect() } else { vec![] }
        }
        _ if n == 0 => vec![],
        _ => vec![i],
    }
}

fn commit(
    session: &mut Session,
    kind: Mistake,
    chosen: &[usize],
    robot: &[Pose<Base, Flange>],
    random: &mut Random,
) {
    for (k, &i) in chosen.iter().enumerate() {
        match kind {
            Mistake::Exchanged => {
                session.observations[i].base_from_flange = robot[chosen[1 - k]];
            }
            Mistake::Stale => session.observations[i].base_from_flange = robot[i - 1],
            Mistake::Shifted => session.observations[i].base_from_flange = robot[i + 1],
            Mistake::Turned => relabel(session, i, |id, grid| Some(grid.0 * grid.1 - 1 - id)),
            Mistake::WrongDetection if random.unit() < 0.5 => {
                relabel(session, i, |id, grid| ((id + 1) % grid.0 != 0).then_some(id + 1));
            }
            Mistake::WrongDetection => {
                let turn = random.normal3() * GARBAGE.0;
                let shift = random.normal3() * GARBAGE.1;
                let step = Isometry3::new(shift, turn);
                move_target(session, i, |_| step);
            }
            Mistake::Mirrored => move_target(session, i, mirrored),
            Mistake::Moving => {
                let (near, far) = MOVED_M;
                let shift = random.normal3().normalize() * (near + (far - near) * random.unit());
                let turn = random.normal3().normalize() * (MOST_TURNED * random.unit());
                let step = Isometry3::new(shift, turn);
                session.observations[i].base_from_flange = Pose::claim(robot[i].iso() * step);
            }
        }
    }
}

/// How far a robot that is not at rest has to go, least and most (m).
const MOVED_M: (f64, f64) = (3e-3, 10e-3);
/// How far it has to turn at most, rad.
const MOST_TURNED: f64 = 0.0175;

/// Spread of poses that are far off: rad and m per axis.
const GARBAGE: (f64, f64) = (0.15, 0.03);

/// Gives the corners of a capture other names, and finds the target's pose anew.
fn relabel(session: &mut Session, i: usize, name: impl Fn(u32, (u32, u32)) -> Option<u32>) {
    let (Some(target), Some(camera)) = (session.target.clone(), session.camera) else { return };
    let grid = target.grid();
    let o: &mut Observation = &mut session.observations[i];
    let renamed = |c: &ImageCorner| Some(ImageCorner { id: name(c.id, grid)?, ..*c });
    o.corners = o.corners.iter().filter_map(renamed).collect();
    o.corners.sort_by_key(|c| c.id);
    o.surface.retain_mut(|c| name(c.id, grid).map(|id| c.id = id).is_some());
    o.candidates = detect::target_poses(&o.corners, &o.surface, &target, &camera)
        .map_or(vec![], |poses| detect::with_symmetries(&poses, &target));
}

/// Moves what was measured of the target with it, each corner keeping its noise; what the camera
/// would not see there is gone.
fn move_measurements(
    session: &mut Session,
    i: usize,
    before: &Pose<Camera, Target>,
    after: &Pose<Camera, Target>,
) {
    let (Some(target), Some(camera)) = (session.target.clone(), session.camera) else { return };
    let o: &mut Observation = &mut session.observations[i];
    let seen = |id: u32| {
        let corner = target.corner(id)?;
        Some(((*before * corner).vector(), (*after * corner).vector()))
    };
    o.corners.retain_mut(|c| {
        let Some((was, is)) = seen(c.id) else { return false };
        let (Some(from), Some(to)) = (camera.project(&was), camera.project(&is)) else {
            return false;
        };
        c.pixel += to - from;
        true
    });
    o.surface.retain_mut(|c| {
        let Some((was, is)) = seen(c.id) else { return false };
        c.in_camera = Point::from_vector(c.in_camera.vector() + is - was);
        true
    });
}

/// A pose turned about the target's centre and shifted, in the axes of the camera.
fn stepped(pose: &Pose<Camera, Target>, step: &Isometry3<f64>) -> Pose<Camera, Target> {
    let rotation = step.rotation.to_rotation_matrix().into_inner() * pose.rotation();
    Pose::from_parts(&rotation, pose.translation() + step.translation.vector)
}

/// Moves the target of a capture about its centre, in the axes of the camera: its pose, and what
/// was measured of it.
fn move_target(
    session: &mut Session,
    i: usize,
    by: impl Fn(&Pose<Camera, Target>) -> Isometry3<f64>,
) {
    if let Some(first) = session.observations[i].candidates.first() {
        let pose = first.camera_from_target;
        move_measurements(session, i, &pose, &stepped(&pose, &by(&pose)));
    }
    for candidate in &mut session.observations[i].candidates {
        let pose = candidate.camera_from_target;
        candidate.camera_from_target = stepped(&pose, &by(&pose));
    }
}

/// The turn that mirrors the target's normal at the line of sight.
fn mirrored(pose: &Pose<Camera, Target>) -> Isometry3<f64> {
    let normal: Vector3<f64> = pose.rotation().column(2).into_owned();
    let sight = pose.translation().normalize();
    let other = sight * (2.0 * sight.dot(&normal)) - normal;
    let turn = Rotation3::rotation_between(&normal, &other).unwrap_or_else(Rotation3::identity);
    Isometry3::from_parts(Vector3::zeros().into(), UnitQuaternion::from_rotation_matrix(&turn))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Setup, simulate::Cell};

    fn clean() -> Session {
        Cell::new(Setup::EyeInHand, 3).session(3).unwrap().0
    }

    #[test]
    fn only_what_is_named_is_spoilt() {
        for kind in Mistake::ALL {
            let (before, mut after) = (clean(), clean());
            let spoilt = spoil(&mut after, &[kind], 4, &mut Random::new(1));
            assert_eq!(spoilt.len(), 4, "{kind:?}");
            for (i, (a, b)) in before.observations.iter().zip(&after.observations).enumerate() {
                assert_eq!(a != b, spoilt.iter().any(|(k, _)| *k == i), "{kind:?} {i}");
            }
        }
    }

    #[test]
    fn a_mirrored_pose_keeps_the_tilt_against_the_line_of_sight() {
        let pose = clean().observations[0].candidates[0].camera_from_target;
        let normal = pose.rotation().column(2).into_owned();
        let there = mirrored(&pose).rotation * normal;
        let sight = pose.translation().normalize();
        assert!((sight.dot(&normal) - sight.dot(&there)).abs() < 1e-12);
        assert!((normal - there).norm() > 0.05);
    }
}
