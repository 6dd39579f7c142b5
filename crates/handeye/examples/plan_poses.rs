//! Which of the poses that a robot can reach should the captures be taken at, and what will the answer be worth?
//!
//!     cargo run --release -p handeye --example plan_poses

use handeye::{
    Error, Setup,
    estimate::predict::Volume,
    nalgebra::Vector3,
    simulate::Cell,
    tools::plan::{self, ExpectedNoise, Setting},
};

fn main() -> Result<(), Error> {
    // poses without collision, from your planner; here those of a simulated cell
    let cell = Cell { captures: 80, ..Cell::new(Setup::EyeInHand, 1) };
    let reachable = cell.record(1)?.truth.base_from_flange;

    // the box in which the gripper works, in the camera's frame (m)
    let (low, high) = (Vector3::new(-0.1, -0.1, 0.4), Vector3::new(0.1, 0.1, 0.6));
    let setting = Setting {
        setup: cell.setup,
        target: cell.target.clone(),
        camera: cell.intrinsics,
        hand_eye: cell.hand_eye, // about where camera and board sit: a drawing or a ruler will do
        noise: ExpectedNoise { robot_position_m: 0.3e-3, ..ExpectedNoise::default() },
        volume: Volume::of_box(&low, &high, "the gripper's workspace"),
    };
    let plan = plan::choose(&setting, &[], &reachable, 12)?;

    for (k, choice) in plan.choices.iter().enumerate() {
        let pose = reachable[choice.candidate];
        let error = match &choice.predicted_tre {
            Some(error) => format!("predicted error {:.3} mm (95 %)", error.p95),
            None => "not yet determined".into(),
        };
        let number = choice.candidate;
        println!(
            "{:2}. pose {number:2} at {:.3?} m: {error}",
            k + 1,
            pose.translation().as_slice()
        );
    }
    assert!(plan.undetermined.is_empty(), "{:?}", plan.undetermined);
    Ok(())
}
