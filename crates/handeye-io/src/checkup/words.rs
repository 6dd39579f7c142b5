//! Mistakes in words.

use handeye::{
    Setup, TargetModel,
    diagnose::{
        TargetScale,
        explain::{Fault, Order},
    },
};

use super::Case;
use crate::dataset::Rereading;

/// For programs.
pub(super) fn code(fault: &Fault) -> &'static str {
    match fault {
        Fault::Reading(_) => "reading",
        Fault::Order(_) => "order",
        Fault::Exchanged(_) => "captures-exchanged",
        Fault::Scale(_) => "target-size",
        Fault::TargetMoved(..) => "target-moved",
        Fault::CameraMoved(..) => "camera-moved",
        Fault::RobotStill(_) => "robot-pose-frozen",
        Fault::CameraStill(_) => "camera-still",
        Fault::Repeated(_) => "captures-repeated",
        Fault::Disagreeing(_) => "captures-disagree",
    }
}

/// Names of the captures concerned.
pub(super) fn captures(case: &Case, fault: &Fault) -> Vec<String> {
    let named = |i: &usize| case.names[*i].clone();
    match fault {
        Fault::Exchanged(pairs) => pairs.iter().flat_map(|(i, j)| [named(i), named(j)]).collect(),
        Fault::TargetMoved(i, j) | Fault::CameraMoved(i, j) => {
            (*i..=*j).map(|k| named(&k)).collect()
        }
        Fault::RobotStill(all)
        | Fault::CameraStill(all)
        | Fault::Repeated(all)
        | Fault::Disagreeing(all) => all.iter().map(named).collect(),
        Fault::Reading(_) | Fault::Order(_) | Fault::Scale(_) => vec![],
    }
}

/// For people.
pub(super) fn message(case: &Case, fault: &Fault) -> String {
    let names = captures(case, fault).join(", ");
    let run = |i: usize, j: usize| match i == j {
        true => format!("capture {}", case.names[i]),
        false => format!("captures {} to {}", case.names[i], case.names[j]),
    };
    match fault {
        Fault::Reading(k) => case.robot[*k].words.clone(),
        Fault::Order(Order::Shifted(k)) => format!(
            "pictures and robot poses are in different orders: each picture belongs to the robot \
             pose {k} further on, counted round (picture {} to robot pose {}); correct the order \
             of the files",
            case.names[0],
            k + 1
        ),
        Fault::Order(Order::Reversed) => "pictures and robot poses are in opposite orders: the \
             first picture belongs to the last robot pose; correct the order of the files"
            .into(),
        Fault::Exchanged(_) => format!(
            "the pictures of these captures are exchanged: {names}; exchange the files, or leave \
             them out"
        ),
        Fault::Scale(s) => format!(
            "the target is {:.4} +- {:.4} times as large as declared{}: measure it",
            s.value,
            s.sigma,
            declared_size(case)
                .map_or(String::new(), |mm| format!(" ({:.3} mm, not {mm} mm)", mm * s.value)),
        ),
        Fault::TargetMoved(i, j) => format!(
            "the target lay elsewhere during {}: it was moved in the session; leave them out",
            run(*i, *j)
        ),
        Fault::CameraMoved(i, j) => format!(
            "the camera sat elsewhere on the {} during {}: it was moved in the session; leave \
             them out",
            case.setup.mount(),
            run(*i, *j)
        ),
        Fault::RobotStill(_) => format!(
            "these captures have one and the same robot pose, but the camera saw the target move: \
             the pose was not read anew; leave them out: {names}"
        ),
        Fault::CameraStill(_) => format!(
            "these captures show the target in the same place, but the robot moved: pictures were \
             stored twice, or target and camera ride together: {names}"
        ),
        Fault::Repeated(_) => {
            format!("these captures repeat one another and add nothing new: {names}")
        }
        Fault::Disagreeing(_) => format!(
            "these captures agree with no others, and no single mistake explains them; look at \
             their pictures and robot poses, or leave them out: {names}"
        ),
    }
}

/// The other way to see a wrong size.
pub(super) fn robot_scale(s: &TargetScale) -> String {
    format!(
        "the robot moves {:.4} +- {:.4} times as far as it says, and the target is as declared",
        1.0 / s.value,
        s.sigma / s.value.powi(2)
    )
}

/// As a manifest calls it.
pub(super) fn setup(setup: Setup) -> &'static str {
    match setup {
        Setup::EyeInHand => "eye-in-hand",
        Setup::EyeToHand => "eye-to-hand",
    }
}

/// What a direction says of the cell, for its user to judge; `distance` in m.
pub(super) fn on_flange(setup: Setup, distance: f64) -> String {
    let what = match setup {
        Setup::EyeInHand => "camera",
        Setup::EyeToHand => "target",
    };
    format!("(the {what} then sits {distance:.2} m from the flange)")
}

/// What else is wrong beside the direction.
pub(super) fn besides(robot: &Rereading) -> String {
    match robot.words_without_direction.as_str() {
        "" => String::new(),
        words => format!("; but {words}"),
    }
}

fn declared_size(case: &Case) -> Option<f64> {
    case.target.as_ref().map(TargetModel::pitch_m).map(|m| (m * 1e6).round() / 1e3)
}
