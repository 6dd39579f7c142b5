//! Pixels that are as bright, or as dark, as an image can have them.

/// White and black of an image.
const LIMITS: (f32, f32) = (254.5, 0.5);
/// A pixel this near to a limit may be on it but for noise: if only those that noise takes off it
/// counted, all would err to the same side.
const NEAR: f32 = 10.0;
/// What a pixel beyond a limit counts: hardly anything, but not nothing, or greys that no other pixel
/// tells would be free.
const BEYOND: f32 = 5e-3;

/// Whether a pixel is at a limit.
#[inline(always)]
pub(super) fn is_saturated(grey: f32) -> bool {
    grey >= LIMITS.0 || grey <= LIMITS.1
}

/// Weight of a residual: a saturated pixel does not say how far beyond the limit the light is that a
/// model has there.
#[inline(always)]
pub(super) fn share_within(grey: f32, model: f32) -> f32 {
    let white = model > LIMITS.0 && grey >= LIMITS.0 - NEAR;
    let black = model < LIMITS.1 && grey <= LIMITS.1 + NEAR;
    if white || black { BEYOND } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use crate::detect::detect;
    use crate::simulate::{Conditions, Glare, Optics, Scene};
    use crate::{Intrinsics, Pose, TargetModel};
    use nalgebra::Isometry3;

    fn targets() -> [TargetModel; 2] {
        let dictionary = "DICT_5X5_100".into();
        [
            TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 20.0 },
            TargetModel::TagGrid {
                dictionary,
                tags_x: 6,
                tags_y: 4,
                tag_mm: 24.0,
                gap_mm: 8.0,
                first_id: 0,
            },
        ]
    }

    /// Share of the visible corners that are found, the largest error of these (px), and their mean
    /// square over their covariances.
    fn figures(target: &TargetModel, conditions: &Conditions, optics: &Optics) -> (f64, f64, f64) {
        let (mut seen, mut found_ones) = (0.0, 0.0);
        let (mut largest, mut normalised) = (0.0f64, 0.0);
        for k in 0..4 {
            let turn = [0.2, -0.3, 0.3 * f64::from(k)].into();
            let scene = Scene {
                target: target.clone(),
                camera_from_target: Pose::claim(Isometry3::new([-0.09, -0.06, 0.4].into(), turn)),
                intrinsics: Intrinsics::pinhole(800, 600, 900.0, 900.0, 399.5, 299.5),
            };
            let image = scene.picture_under(conditions, optics, k as u64);
            let found = detect(&image, target).unwrap();
            let truth = scene.corners_under(conditions, optics);
            for c in truth.iter().filter(|c| c.visible == Some(true)) {
                seen += 1.0;
                if let Some(corner) = found.iter().find(|f| f.id == c.id) {
                    let e = corner.pixel - c.pixel;
                    found_ones += 1.0;
                    largest = largest.max(e.norm());
                    normalised += e.dot(&(corner.covariance.try_inverse().unwrap() * e)) / 2.0;
                }
            }
        }
        (found_ones / seen, largest, normalised / found_ones)
    }

    #[test]
    fn overexposed_boards_have_their_corners_where_they_are() {
        for (target, farthest) in targets().iter().zip([0.06, 0.4]) {
            let optics = Optics { white: 330.0, black: 60.0, ..Optics::default() };
            let (share, largest, normalised) = figures(target, &Conditions::default(), &optics);
            println!("{share:.3} {largest:.3} px, normalised {normalised:.2}");
            assert!(share > 0.99 && largest < farthest && normalised < 1.7, "{target:?}");
        }
    }

    #[test]
    fn corners_beside_glare_stay_within_their_covariance() {
        let glare = Some(Glare { share: 1.0 / 3.0, at: [0.4, 0.6] });
        let conditions = Conditions { glare, ..Conditions::default() };
        for (target, least) in targets().iter().zip([0.9, 0.85]) {
            let (share, largest, normalised) = figures(target, &conditions, &Optics::default());
            println!("{share:.3} {largest:.3} px, normalised {normalised:.2}");
            assert!(share > least && largest < 1.0 && normalised < 2.5, "{target:?}");
        }
    }
}
