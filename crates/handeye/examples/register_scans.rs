//! Two scans of one scene, taken from different poses, are brought together.
//!
//!     cargo run --release -p handeye --example register_scans

use handeye::{
    Error, Intrinsics, Verdict,
    math::random::Random,
    nalgebra::{Isometry3, Vector3},
    register::{DenseConfig, register},
    simulate::Room,
};

fn main() -> Result<(), Error> {
    // your scans come from files (handeye_io::read_scan) or a camera; these are of a simulated cell
    let mut random = Random::new(4);
    let room = Room::of_a_cell(&mut random);
    let camera = Intrinsics::pinhole(320, 240, 300.0, 300.0, 159.5, 119.5);
    // 0.8 m above the table and looking down; then moved by 7 cm and turned by 3.5 degrees
    let half_turn = Vector3::new(std::f64::consts::PI, 0.0, 0.0);
    let room_from_target = Isometry3::new(Vector3::new(0.0, 0.0, 0.8), half_turn);
    let motion = Isometry3::new(Vector3::new(0.06, -0.03, 0.02), Vector3::new(0.02, 0.05, -0.03));
    let room_from_source = room_from_target * motion;
    let target = room.scan(&room_from_target, &camera, 0.5e-3, &mut random);
    let source = room.scan(&room_from_source, &camera, 0.5e-3, &mut random);

    // about where the source is: some centimetres and degrees off will do
    let start = Isometry3::new(Vector3::new(0.04, -0.02, 0.01), Vector3::new(0.0, 0.03, -0.01));
    let found = register(&source, &target, &start, &DenseConfig::default())?;

    println!("{:?}: {}", found.verdict, found.reasons.join("; "));
    println!(
        "target_from_source: {:.4?} m",
        found.target_from_source.translation.vector.as_slice()
    );
    println!("agreement {:.0} %, residual {:.2} mm", 100.0 * found.agreement, 1e3 * found.rms_m);
    let truth = room_from_target.inv_mul(&room_from_source);
    let off = truth.inv_mul(&found.target_from_source).translation.vector.norm();
    println!("off the truth by {:.3} mm", 1e3 * off);
    assert_eq!(found.verdict, Verdict::Accepted);
    Ok(())
}
