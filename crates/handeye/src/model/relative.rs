//! Relative motions, `A X = X B`: how the camera's carrier moved between two moments, and how the camera did.

use crate::{Base, Camera, Flange, Mount, Observation, Pose, Session, Setup, Target};

/// Two motions between the same moments. Eye-in-hand `mount_motion` is `flange₁_from_flange₂` and eye-to-hand
/// `base_from_flange₁ · flange₂_from_base`; `camera_motion` is `camera_from_target₁ · target_from_camera₂`, which is
/// `camera₁_from_camera₂` where the target stays in its place.
#[derive(Debug, Clone, PartialEq)]
pub struct RelativeMotion {
    /// What it is called.
    pub id: String,
    /// `A`.
    pub mount_motion: Pose<Mount, Mount>,
    /// `B`.
    pub camera_motion: Pose<Camera, Camera>,
}

impl RelativeMotion {
    /// Where motions say nothing else, the answer is judged so far in front of the camera, m.
    pub const DISTANCE_M: f64 = 0.5;
}

/// The name of the capture from which all motions begin.
pub const START: &str = "start";

impl Session {
    /// The captures that relative motions are equal to: all begin at a common start, where the flange is in the base's
    /// origin and the target `distance_m` in front of the camera. `mount_from_camera` is that of the motions;
    /// `anchor_from_target` is that start's, and the answer is judged around it.
    pub fn of_motions(setup: Setup, motions: Vec<RelativeMotion>, distance_m: f64) -> Self {
        let start = nalgebra::Isometry3::translation(0.0, 0.0, distance_m);
        let capture = |motion: RelativeMotion| {
            let mount = motion.mount_motion.iso();
            let base_from_flange: Pose<Base, Flange> = Pose::claim(match setup {
                Setup::EyeInHand => *mount,
                Setup::EyeToHand => mount.inverse(),
            });
            let camera_from_target: Pose<Camera, Target> =
                Pose::claim(motion.camera_motion.iso().inverse() * start);
            Observation::bare(motion.id, base_from_flange, camera_from_target)
        };
        let begin = Observation::bare(START.into(), Pose::identity(), Pose::claim(start));
        let all = std::iter::once(begin).chain(motions.into_iter().map(capture)).collect();
        Self::of_captures(setup, all)
    }
}
