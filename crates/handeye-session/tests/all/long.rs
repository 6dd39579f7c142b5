//! A session that stands open for a working day.

use std::fs;

use handeye::{Setup, math::random::Random};
use handeye_session::{
    engine::{Command, Engine, FolderState, Input, Sources, Step, rest::ImageSample},
    sources::virtual_cell::{Faults, VirtualCell},
};

const HOURS: usize = 8;
/// Poses a second, and images.
const POSES: usize = 25;
const IMAGES: usize = 5;
/// The robot drives somewhere else so often, s.
const DRIVES: usize = 40;

/// Memory that this process holds, MB.
fn held_mb() -> Option<f64> {
    let pages: f64 =
        fs::read_to_string("/proc/self/statm").ok()?.split(' ').nth(1)?.parse().ok()?;
    Some(pages * 4096.0 / 1e6)
}

#[test]
fn eight_hours_of_poses_and_images_take_no_memory() {
    let cell = VirtualCell::new(Setup::EyeInHand, 1, Faults::default()).unwrap();
    let folder = FolderState::new(cell.settings());
    let mut engine = Engine::new(folder, Sources::VIRTUAL).0;
    let mut random = Random::new(1);
    let mut after_each_hour = vec![];
    let mut largest = 0;
    for second in 0..HOURS * 3600 {
        let begin = second as f64;
        if second % DRIVES == 0 {
            cell.jog([random.normal(), random.normal(), 0.0], [0.0; 3], begin);
        }
        for k in 0..POSES {
            let now = begin + k as f64 / POSES as f64;
            engine.step(Input::Robot(cell.sample(now))).unwrap();
            if k % (POSES / IMAGES) == 0 {
                let corners = Ok(cell.corners(now, &mut random));
                let frame = (second * POSES + k) as u64;
                let image = ImageSample { frame, time_s: now, size: (1280, 800), corners };
                engine.step(Input::Image(image)).unwrap();
            }
        }
        engine.step(Input::Clock(begin + 1.0)).unwrap();
        let state = serde_json::to_string(&engine.view("", "")).unwrap();
        largest = largest.max(state.len());
        if second == 10 {
            for step in [Step::Cell, Step::Camera, Step::Robot, Step::Board] {
                engine.step(Input::Command(Command::Confirm { step })).unwrap();
            }
        }
        if (second + 1) % 3600 == 0 {
            after_each_hour.push(held_mb());
        }
    }
    println!("MB after each hour: {after_each_hour:.1?}; largest state {largest} bytes");
    assert!(largest < 100_000, "{largest} bytes");
    let (Some(first), Some(last)) = (after_each_hour[0], after_each_hour[HOURS - 1]) else {
        return println!("how much memory is held is not known here");
    };
    // beside what other tests of this process hold
    assert!(last < first + 100.0, "{first} MB after one hour, {last} MB after {HOURS}");
}
