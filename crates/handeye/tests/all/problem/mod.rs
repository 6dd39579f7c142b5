//! A session as the joint fit takes it.

use handeye::{
    Placement, Pose, PosePair, Session, Setup, TargetPose,
    estimate::{Extra, Problem, TouchedBoard, TouchedCorner},
    solve::View,
};

fn view(anchor_from_mount: Pose<handeye::Anchor, handeye::Mount>, seen: &[TargetPose]) -> View {
    let pair = PosePair { anchor_from_mount, camera_from_target: seen[0].camera_from_target };
    View { covariance: seen[0].covariance, ..View::bare(pair) }
}

/// Every capture.
pub fn views(session: &Session) -> Vec<View> {
    let one = |o: &handeye::Observation| {
        view(session.setup.anchor_from_mount(o.base_from_flange), &o.candidates)
    };
    session.observations.iter().map(one).collect()
}

fn board(session: &Session, name: &str, placement: Option<&Placement>) -> TouchedBoard {
    let target = session.target.as_ref().unwrap();
    let own = session.touches.iter().filter(|t| t.placement == name);
    let corner = |t: &handeye::Touch| TouchedCorner {
        in_base: t.in_base.vector(),
        base_from_flange: t.base_from_flange,
        by_robot: None,
        in_target: target.corner(t.corner).unwrap().vector(),
        by_shape: Default::default(),
    };
    TouchedBoard {
        seen: placement.map(|p| view(Pose::identity(), &p.candidates)),
        corners: own.map(corner).collect(),
    }
}

/// Every capture and touch, with these unknowns beside both poses.
pub fn problem(session: &Session, extras: &[Extra]) -> Problem {
    let boards = match session.setup {
        Setup::EyeInHand => vec![board(session, "board", None)],
        Setup::EyeToHand => {
            session.placements.iter().map(|p| board(session, &p.id, Some(p))).collect()
        }
    };
    Problem {
        setup: session.setup,
        views: views(session),
        boards: if session.touches.is_empty() { vec![] } else { boards },
        extras: extras.to_vec(),
        known_position: None,
    }
}

/// Both poses by a closed form.
pub fn start(session: &Session, method: handeye::Method) -> handeye::HandEye {
    let pairs: Vec<PosePair> = views(session).iter().map(|v| v.pair).collect();
    handeye::solve::solve(&pairs, method).unwrap()
}

/// The same with the loop closed the other way round, `A⁻¹ Y = X B⁻¹`: then the target's place in
/// the camera enters, not the camera's place in the target, which the error of the target's tilt
/// moves by the whole distance.
pub fn start_turned(session: &Session, method: handeye::Method) -> handeye::HandEye {
    let turned = |v: &View| PosePair {
        anchor_from_mount: v.pair.anchor_from_mount.inverse().rename(),
        camera_from_target: v.pair.camera_from_target.inverse().rename(),
    };
    let pairs: Vec<PosePair> = views(session).iter().map(turned).collect();
    let found = handeye::solve::solve(&pairs, method).unwrap();
    handeye::HandEye {
        mount_from_camera: found.anchor_from_target.rename(),
        anchor_from_target: found.mount_from_camera.rename(),
    }
}

/// Corners as the camera has them with those touched (both in m).
pub fn pairs_of_touches(session: &Session) -> Vec<handeye::estimate::touch_pairs::TouchPairs> {
    let target = session.target.as_ref().unwrap();
    let seen: Vec<_> = session.observations.iter().collect();
    let (paired, missing) = handeye::estimate::touch_pairs::pair_touches(
        session.setup,
        target,
        &seen,
        &session.placements,
        &session.touches,
    );
    assert!(missing.is_empty());
    paired
}
