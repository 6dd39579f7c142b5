//! Touches in the form that the joint fit takes.

use crate::{
    Placement, Pose, PosePair, Setup, Target, TargetModel, Touch,
    calibrate::{
        captures::residuals,
        flow::views::Views,
        optics::{self, Optics},
    },
    detect::sight::by_shape,
    estimate::{JointFit, TouchedBoard, TouchedCorner},
    math::lie,
    solve::View,
};

/// Boards with their touches, and which touch of the session each corner is.
pub(crate) struct Boards {
    pub boards: Vec<TouchedBoard>,
    /// Per board and corner: the touch of the session.
    pub touches: Vec<Vec<usize>>,
}

/// Boards that were touched and that the camera saw.
pub(crate) fn boards(views: &Views, fit: &JointFit, optics: &Optics) -> Boards {
    let session = views.session;
    let Some(target) = &session.target else { return Boards { boards: vec![], touches: vec![] } };
    let mut found = Boards { boards: vec![], touches: vec![] };
    match session.setup {
        Setup::EyeInHand => {
            let all: Vec<usize> = (0..session.touches.len()).collect();
            found.add(None, target, &session.touches, &all);
        }
        Setup::EyeToHand => {
            let excess = match &session.camera {
                Some(camera) if !optics.extras.is_empty() => {
                    Some(optics::excess(session, target, camera))
                }
                _ => None,
            };
            for placement in &session.placements {
                let Some(seen) = seen(placement, views, fit, target, excess) else { continue };
                let own: Vec<usize> = (0..session.touches.len())
                    .filter(|&k| session.touches[k].placement == placement.id)
                    .collect();
                found.add(Some(seen), target, &session.touches, &own);
            }
        }
    }
    found
}

impl Boards {
    fn add(&mut self, seen: Option<View>, target: &TargetModel, touches: &[Touch], own: &[usize]) {
        let known: Vec<usize> =
            own.iter().copied().filter(|&k| target.corner(touches[k].corner).is_some()).collect();
        if known.is_empty() {
            return;
        }
        let middle = target.middle().vector();
        let corner_of = |t: &Touch| target.corner(t.corner).unwrap_or(target.reference()).vector();
        let corner = |&k: &usize| TouchedCorner {
            in_base: touches[k].in_base.vector(),
            base_from_flange: touches[k].base_from_flange,
            by_robot: None,
            in_target: corner_of(&touches[k]) - target.reference().vector(),
            by_shape: by_shape(&corner_of(&touches[k]), &middle),
        };
        self.boards.push(TouchedBoard { seen, corners: known.iter().map(corner).collect() });
        self.touches.push(known);
    }
}

/// The placement in the reading that puts its corners where they were touched; with an `excess`,
/// also what its corners know of the camera.
fn seen(
    placement: &Placement,
    views: &Views,
    fit: &JointFit,
    target: &TargetModel,
    excess: Option<Option<f64>>,
) -> Option<View> {
    let x = &fit.hand_eye.mount_from_camera;
    let chosen = residuals::oriented(placement, &views.session.touches, x, target);
    let pose = chosen.candidates.first()?;
    let carry = lie::adjoint(views.target_from_corner.inverse().iso());
    let own = &pose.camera_from_target;
    let sight = excess.and_then(|excess| {
        let (corners, surface) = (&chosen.corners, &chosen.surface);
        optics::sight_of_placement(views.session, excess, corners, surface, own)
    });
    let unused: Pose<crate::Anchor, crate::Mount> = Pose::identity();
    let about_corner: Pose<crate::Camera, Target> =
        pose.camera_from_target * views.target_from_corner;
    Some(View {
        pair: PosePair { anchor_from_mount: unused, camera_from_target: about_corner },
        covariance: pose.covariance.map(|c| carry * c * carry.transpose()),
        sight: sight.map(|s| s.carried(&carry).into()),
        by_robot: None,
    })
}
