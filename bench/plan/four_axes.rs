//! An arm whose flange only turns about the vertical: what it reports has no tilt, where it really stands has a little; its
//! tip is led onto corners in the same way.

use handeye::{
    Base, Flange, Point, Pose, Session, Touch,
    math::random::Random,
    simulate::{Cell, CellNoise},
    tools::plan::{ArmReach, Station},
};
use nalgebra::{Rotation3, Vector3, Vector6};

/// How well its tip is known, m per axis: all touches share that error, whatever they are of.
pub const TIP_M: f64 = 1e-4;
/// A probe that reaches down to the board, m.
pub const TIP: Vector3<f64> = Vector3::new(0.004, -0.007, 0.42);
/// Joint values drawn at random in search of views.
const DRAWS: usize = 400_000;

/// Where it really is when it reports this.
fn real(says: &Pose<Base, Flange>, noise: &CellNoise, random: &mut Random) -> Pose<Base, Flange> {
    let turn = random.normal3() * noise.robot_absolute_rad;
    let shift = random.normal3() * noise.robot_absolute_m / 3f64.sqrt();
    says.retract(&Vector6::new(turn.x, turn.y, turn.z, shift.x, shift.y, shift.z))
}

/// What is measured when it reports these poses, and these corners are touched.
pub fn session(
    cell: &Cell,
    reported: &[Pose<Base, Flange>],
    touched: &[u32],
    seed: u64,
) -> Session {
    let noise = cell.noise;
    let mut random = Random::new(seed ^ 0x5ca2a);
    let poses: Vec<_> = reported.iter().map(|says| real(says, &noise, &mut random)).collect();
    let exact = CellNoise { robot_absolute_m: 0.0, robot_absolute_rad: 0.0, ..noise };
    let exact = Cell { captures: poses.len(), noise: exact, ..cell.clone() };
    let recording = exact.record_at(&poses, seed).expect("a recording");
    let mut session = recording.session();
    for (observation, says) in session.observations.iter_mut().zip(reported) {
        observation.base_from_flange = *says;
    }
    let tip = recording.believed_tip();
    let mut random = Random::new(seed ^ 0x70c4);
    let touch = |corner: &u32| {
        let at = cell.hand_eye.anchor_from_target.rename::<Base, _>()
            * cell.target.corner(*corner).expect("a corner");
        let led = at.vector() + random.normal3() * (noise.touch_m / 3f64.sqrt());
        let down = Rotation3::new(Vector3::x() * std::f64::consts::PI);
        let turned = Rotation3::new(Vector3::z() * random.between(-1.5, 1.5)) * down;
        let above = Pose::from_parts(turned.matrix(), Vector3::zeros());
        let off = (real(&above, &noise, &mut random) * Point::from_vector(TIP)).vector();
        let says = Pose::from_parts(turned.matrix(), led - off);
        Touch {
            placement: "board".into(),
            corner: *corner,
            in_base: says * tip,
            base_from_flange: Some(says),
            joints: vec![],
        }
    };
    session.touches = touched.iter().map(touch).collect();
    session
}

/// Stations at random joint values that show the whole board.
pub fn random_stations(
    reach: &ArmReach,
    cell: &Cell,
    most: usize,
    random: &mut Random,
) -> Vec<Station> {
    let drawn = (0..DRAWS).filter_map(|_| {
        let joints: Vec<f64> = reach.limits.iter().map(|(l, h)| random.between(*l, *h)).collect();
        let base_from_flange = reach.arm.base_from_flange(&joints);
        let is_free = cell.shows_target_at(&base_from_flange)
            && reach.surroundings.collision(&reach.arm, &joints).is_none();
        is_free.then_some(Station { base_from_flange, joints: Some(joints) })
    });
    drawn.take(most).collect()
}
