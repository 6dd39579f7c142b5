//! Mistakes in words.

use handeye::{
    Setup,
    mistakes::{
        self, TargetScale,
        score::{Fault, Order},
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

/// Whether a run of captures that ends with this one shows how things are now.
fn is_now(case: &Case, last: usize) -> bool {
    last + 1 == case.names.len()
}

/// The captures to leave out for a calibration of how things are now.
pub(super) fn obsolete(case: &Case, fault: &Fault) -> Vec<String> {
    match fault {
        Fault::CameraMoved(first, last) if is_now(case, *last) => case.names[..*first].to_vec(),
        _ => captures(case, fault),
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
            "images and robot poses are in different orders: each image belongs to the robot \
             pose {}; correct the order of the files",
            shift(&case.names, *k)
        ),
        Fault::Order(Order::Reversed) => "images and robot poses are in opposite orders: the \
             first image belongs to the last robot pose; correct the order of the files"
            .into(),
        Fault::Exchanged(_) => format!(
            "the images of these captures are exchanged: {names}; exchange the files, or leave \
             them out"
        ),
        Fault::Scale(size) => wrong_size(case, size),
        Fault::TargetMoved(i, j) => format!(
            "the target lay elsewhere during {}: it was moved in the session; leave them out",
            run(*i, *j)
        ),
        Fault::CameraMoved(i, j) if is_now(case, *j) => format!(
            "the camera was moved on the {} before capture {}; leave the captures before that out: the calibration \
             is to be for where the camera is now",
            case.setup.mount(),
            case.names[*i]
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
            "these captures show the target in the same place, but the robot moved: images were \
             stored twice, or target and camera ride together: {names}"
        ),
        Fault::Repeated(_) => {
            format!("these captures repeat one another, and of each place one counts: {names}")
        }
        Fault::Disagreeing(_) => format!(
            "these captures agree with no others, and no single mistake explains them; look at \
             their images and robot poses, or leave them out: {names}"
        ),
    }
}

/// A size that is not the declared one, or target poses in another unit.
fn wrong_size(case: &Case, s: &TargetScale) -> String {
    match (&case.target, unit(s.value)) {
        (Some(target), _) => mistakes::size_finding(s, target).message(),
        (None, Some(units)) => format!(
            "the target's poses count in another unit than the robot's: they are {:.4} times as large as they \
             would be in its unit ({units})",
            1.0 / s.value,
        ),
        (None, None) => format!(
            "the target is {:.4} +- {:.4} times as large as declared: measure it",
            s.value, s.sigma
        ),
    }
}

/// Where the robot pose of a picture stands when it is `k` captures further on, counted round; said
/// the shorter way.
fn shift(names: &[String], k: usize) -> String {
    let (n, places) = (names.len(), |k: usize| if k == 1 { "capture" } else { "captures" });
    if 2 * k > n {
        let back = n - k;
        let (picture, pose) = (&names[back], &names[0]);
        let example = format!("the image of capture {picture} to the robot pose of {pose}");
        return format!("{back} {} back, counted round ({example})", places(back));
    }
    let (picture, pose) = (&names[0], &names[k]);
    let example = format!("the image of capture {picture} to the robot pose of {pose}");
    format!("{k} {} further on, counted round ({example})", places(k))
}

/// What to do about a mistake that no value of a manifest corrects.
/// Without the captures concerned, `left` remain.
pub(super) fn by_hand(fault: &Fault, captures: &[String], left: usize) -> String {
    let names = captures.iter().map(|c| format!("{c:?}")).collect::<Vec<_>>().join(", ");
    let leaving_out = format!("[captures] exclude = [{names}]");
    match fault {
        Fault::Order(_) => "a manifest cannot shift one list against the other: put the files, or \
                            the lines of the robot's poses, into the right order, and check again"
            .into(),
        Fault::Exchanged(_) => format!(
            "a manifest cannot exchange images: exchange the files of each pair, or leave the \
             captures out with {leaving_out}"
        ),
        Fault::CameraStill(_) => {
            format!("take these captures again, or leave them out with {leaving_out}")
        }
        Fault::Repeated(_) => {
            "nothing needs correcting: a calibration counts one of each place".into()
        }
        Fault::Disagreeing(_) => format!(
            "which of these captures are wrong is for you to say: look at their images and robot \
             poses first; {leaving_out} leaves all of them out"
        ),
        Fault::Reading(_) => {
            "no key of a manifest says so: correct the numbers in the file of the \
                              robot's poses"
                .into()
        }
        Fault::Scale(_) => "no value of the manifest stands for it alone: measure the target, and \
                            have the robot's own scale checked if the size is right"
            .into(),
        Fault::TargetMoved(..) | Fault::CameraMoved(..) | Fault::RobotStill(_) => {
            format!("only {left} captures would be left: take them again")
        }
    }
}

/// Lengths that are in proportions like these are of two units.
const UNITS: [(f64, &str); 3] = [
    (1000.0, "millimetres and metres"),
    (10.0, "millimetres and centimetres"),
    (100.0, "centimetres and metres"),
];
/// A target is printed better than this.
const ABOUT: f64 = 0.03;

/// The two units that a size would be of.
fn unit(size: f64) -> Option<&'static str> {
    let is = |factor: f64| (size / factor - 1.0).abs() < ABOUT;
    UNITS.iter().find(|(factor, _)| is(*factor) || is(1.0 / factor)).map(|(_, units)| *units)
}

/// The other way to see a wrong size.
pub(super) fn robot_scale(s: &TargetScale) -> String {
    format!(
        "the robot moves {:.4} +- {:.4} times as far as it says, and the target is as declared",
        1.0 / s.value,
        s.sigma / s.value.powi(2)
    )
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shift_is_said_the_shorter_way() {
        let names: Vec<String> = (1..=15).map(|k| format!("{k:03}")).collect();
        let back = shift(&names, 14);
        assert!(back.starts_with("1 capture back"), "{back}");
        assert!(back.contains("the image of capture 002 to the robot pose of 001"), "{back}");
        let on = shift(&names, 2);
        assert!(on.starts_with("2 captures further on"), "{on}");
        assert!(on.contains("the image of capture 001 to the robot pose of 003"), "{on}");
    }
}
