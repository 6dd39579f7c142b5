use std::collections::BTreeMap;

use nalgebra::{Isometry3, Matrix2, Vector3};

use super::*;
use crate::{
    Intrinsics, Pose,
    detect::detect,
    math::random::Random,
    model::target::kinds::AprilTagFamily,
    simulate::{Conditions, Occlusion, Optics, Scene, Shape},
};

/// A board of 5 x 4 tags, the side of a tag about `tag_px` wide, tilted up to 45 degrees.
fn scene(tag_px: f64, border_bits: u32, random: &mut Random) -> Scene {
    let target = TargetModel::Aprilgrid {
        tags_x: 5,
        tags_y: 4,
        tag_mm: 24.0,
        spacing: 0.3,
        family: AprilTagFamily::Tag36h11,
        first_id: 0,
        corner_squares: true,
        border_bits,
    };
    let corners = target.corners();
    let centre = corners.iter().map(|c| c.vector()).sum::<Vector3<f64>>() / corners.len() as f64;
    let (tilt, axis) = (random.between(0.0, 0.78), random.between(0.0, std::f64::consts::TAU));
    let turn = Isometry3::rotation(Vector3::new(tilt * axis.cos(), tilt * axis.sin(), 0.0))
        * Isometry3::rotation(Vector3::z() * random.between(-0.52, 0.52));
    let focal = 1000.0;
    let shift = Vector3::new(0.0, 0.0, 0.024 * focal / tag_px) - turn * centre;
    Scene {
        target,
        camera_from_target: Pose::claim(Isometry3::from_parts(shift.into(), turn.rotation)),
        intrinsics: Intrinsics::pinhole(800, 600, focal, focal, 399.5, 299.5),
    }
}

/// Errors (px) of all corners of six images, and their covariances.
fn errors(tag_px: f64, border_bits: u32, optics: &Optics) -> Vec<(Vector2<f64>, Matrix2<f64>)> {
    let mut random = Random::new(42);
    let mut all = vec![];
    for seed in 0..6 {
        let scene = scene(tag_px, border_bits, &mut random);
        let truth: BTreeMap<u32, Vector2<f64>> = scene.corners().into_iter().collect();
        let found = detect(&scene.picture(optics, seed), &scene.target).unwrap();
        all.extend(found.iter().map(|c| (c.pixel - truth[&c.id], c.covariance)));
    }
    all
}

#[test]
fn corners_of_aprilgrids_are_as_sure_as_they_say() {
    // tag px, bits of its border, blur px, noise, goal px
    let cases = [
        (95.0, 1, 0.6, 1.5, 0.006),
        (80.0, 1, 0.9, 2.5, 0.011),
        (50.0, 1, 0.7, 2.0, 0.011),
        (50.0, 2, 0.7, 2.0, 0.011),
        (80.0, 1, 1.0, 8.0, 0.037),
    ];
    for (tag_px, border_bits, blur_px, noise, goal) in cases {
        let errors = errors(tag_px, border_bits, &Optics { blur_px, noise, ..Optics::default() });
        let count = errors.len() as f64;
        let rms = (errors.iter().map(|e| e.0.norm_squared()).sum::<f64>() / count).sqrt();
        let one = |(e, c): &(Vector2<f64>, Matrix2<f64>)| e.dot(&(c.try_inverse().unwrap() * e));
        let ratio = errors.iter().map(one).sum::<f64>() / (2.0 * count);
        let case = format!("{tag_px} {border_bits} {blur_px} {noise}: {count} {rms:.4} {ratio:.3}");
        assert!(count > 430.0 && rms < goal, "{case}");
        assert!((0.9..1.15).contains(&ratio), "{case}");
    }
}

#[test]
fn what_hides_a_half_of_an_aprilgrid_is_not_taken_for_a_part_of_it() {
    let mut random = Random::new(7);
    for k in 0..4_u32 {
        let scene = scene(80.0, 1, &mut random);
        let shape = Shape::Side { share: 0.5, towards_rad: 1.5 * f64::from(k) };
        let occlusion = Some(Occlusion { shape, grey: 120.0, seed: u64::from(k) });
        let conditions = Conditions { occlusion, ..Conditions::default() };
        let optics = Optics::default();
        let found = detect(&scene.picture_under(&conditions, &optics, 1), &scene.target).unwrap();
        let truth: BTreeMap<u32, Vector2<f64>> = scene.corners().into_iter().collect();
        let visible = scene.corners_under(&conditions, &optics);
        let visible = visible.iter().filter(|c| c.visible == Some(true)).count();
        let wrong = found.iter().filter(|c| (c.pixel - truth[&c.id]).norm() > 2.0).count();
        assert!(
            found.len() + 4 >= visible && wrong == 0,
            "{k}: {} of {visible}, {wrong}",
            found.len()
        );
    }
}
