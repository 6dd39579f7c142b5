//! Each guard of the rest gate by itself: in a session several of them catch the same fault.

use handeye::{
    Base, Flange, ImageCorner, Pose,
    nalgebra::{Matrix2, Matrix3, Vector2, Vector3},
};
use handeye_session::engine::rest::{self, ImageSample, Memory, Motion, Rest, RobotSample};

/// A robot that stops at time 0, and images of which the first that shows it there comes at `image_stands_s`.
struct Stream {
    creep_m_s: f64,
    creep_px_s: f64,
    image_stands_s: f64,
    known_delay_s: Option<f64>,
}

const STILL: Stream =
    Stream { creep_m_s: 0.0, creep_px_s: 0.0, image_stands_s: 0.0, known_delay_s: Some(0.0) };

impl Stream {
    /// How it is judged at `now`.
    fn judged(&self, now: f64) -> Rest {
        let mut memory = Memory::default();
        let mut last = None;
        for tick in -25..=(now / 0.04).round() as i32 {
            let now = f64::from(tick) * 0.04;
            let from = |k: i32| f64::from(k) * 0.04 > now - 5.0;
            let robot: Vec<_> = (-25..=tick)
                .filter(|k| from(*k))
                .map(|k| self.robot(f64::from(k) * 0.04))
                .collect();
            let images: Vec<_> =
                (-25..=tick).filter(|k| from(*k) && k % 5 == 0).map(|k| self.image(k)).collect();
            last = Some(rest::judge((&robot, &images), &mut memory, self.known_delay_s, now));
        }
        last.unwrap()
    }

    fn robot(&self, time_s: f64) -> RobotSample {
        let x = if time_s < 0.0 { 0.2 * time_s } else { self.creep_m_s * time_s };
        let base_from_flange: Pose<Base, Flange> =
            Pose::from_parts(&Matrix3::identity(), Vector3::new(x, 0.0, 0.5));
        RobotSample { time_s, base_from_flange, typed: vec![], joints: vec![] }
    }

    fn image(&self, tick: i32) -> ImageSample {
        let time_s = f64::from(tick) * 0.04;
        let since = time_s - self.image_stands_s;
        let x = if since < 0.0 { 400.0 * since } else { self.creep_px_s * since };
        let corner = |id: u32| ImageCorner {
            id,
            pixel: Vector2::new(x + 40.0 * f64::from(id % 6), 40.0 * f64::from(id / 6)),
            covariance: Matrix2::identity() * 0.03 * 0.03,
        };
        let corners = Ok((0..24).map(corner).collect());
        ImageSample { frame: (tick + 100) as u64, time_s, size: (640, 480), corners }
    }
}

fn moves(motion: &Motion, said: &str) -> bool {
    matches!(motion, Motion::Moves(why) if why.contains(said))
}

#[test]
fn what_stands_is_taken() {
    let rest = STILL.judged(1.0);
    assert!(rest.ready.is_ok(), "{rest:?}");
}

#[test]
fn a_robot_that_creeps_moves_whatever_its_image_does() {
    let rest = Stream { creep_m_s: 0.2e-3, ..STILL }.judged(3.0);
    assert!(moves(&rest.robot, "moves 0.2 mm/s"), "{rest:?}");
    assert!(matches!(rest.image, Motion::Stands(_)) && rest.ready.is_err(), "{rest:?}");
}

#[test]
fn an_image_that_creeps_moves_whatever_the_robot_says() {
    let rest = Stream { creep_px_s: 0.6, ..STILL }.judged(3.0);
    assert!(moves(&rest.image, "moves 0."), "{rest:?}");
    assert!(matches!(rest.robot, Motion::Stands(_)) && rest.ready.is_err(), "{rest:?}");
}

#[test]
fn an_image_of_before_the_standstill_is_not_taken() {
    // arrives 0.8 s late, as is known: the images that stand are those of 0.8 s and later
    let late = Stream { known_delay_s: Some(0.8), image_stands_s: -0.2, ..STILL };
    let why = late.judged(0.72).ready.unwrap_err();
    assert!(why.contains("before the standstill"), "{why}");
    assert!(late.judged(1.2).ready.is_ok());
}

#[test]
fn an_image_that_stood_already_is_of_another_pose() {
    // delay not known, and the image has not seen the motion yet
    let stale = Stream { image_stands_s: -0.8, known_delay_s: None, ..STILL };
    let why = stale.judged(2.0).ready.unwrap_err();
    assert!(why.contains("an earlier pose"), "{why}");
}

#[test]
fn while_the_delay_is_not_known_both_stand_for_a_while() {
    let unknown = Stream { known_delay_s: None, ..STILL };
    let why = unknown.judged(1.2).ready.unwrap_err();
    assert!(why.contains("not known yet"), "{why}");
    assert!(unknown.judged(2.0).ready.is_ok());
}

#[test]
fn the_delay_is_how_much_later_the_image_stood() {
    let late = Stream { image_stands_s: 0.6, ..STILL };
    let rest = late.judged(2.0);
    let robot: Vec<_> = (-25..=50).map(|k| late.robot(f64::from(k) * 0.04)).collect();
    let images: Vec<_> = (-25..=50).filter(|k| k % 5 == 0).map(|k| late.image(k)).collect();
    let delay = rest::delay(&rest, &robot, &images).unwrap();
    assert!((delay - 0.6).abs() < 0.21, "{delay}");
}
