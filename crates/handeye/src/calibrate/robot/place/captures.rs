//! Captures and touches as places of the robot, and what its errors mean there.

use nalgebra::{Matrix6, Vector3};

use crate::{
    HandEye, Point, Setup, Target, Workspace,
    calibrate::flow::views::Views,
    estimate::{
        JointFit, Problem, Source,
        compensation::ByPlace as Errors,
        place::{self, Kernel, Place, Waves},
        projection,
    },
};

/// Half the size of a target of unknown size, m: an error of the robot's rotation moves its points by so much times the
/// angle.
const HALF_SIZE: f64 = 0.07;

/// Where the robot is in captures, then in touches.
pub(crate) fn places(views: &Views, touches: &[usize]) -> Vec<Place> {
    let captured = views.used.iter().map(|o| Place::new(&o.base_from_flange, &o.joints));
    let touched = touches.iter().map(|&k| &views.session.touches[k]);
    let touched =
        touched.filter_map(|t| Some(Place::new(&t.base_from_flange?, &t.joints).touching()));
    captured.chain(touched).collect()
}

/// The problem with the strengths of the waves over its [`places`] among its unknowns.
pub(crate) fn with_waves(
    (views, touches): (&Views, &[usize]),
    problem: &Problem,
    waves: &Waves,
) -> Problem {
    let setup = views.session.setup;
    let mut wider = problem.clone();
    let mut rows = waves.at.row_iter().map(|row| row.transpose());
    for ((view, o), row) in wider.views.iter_mut().zip(&views.used).zip(&mut rows) {
        view.by_robot = Some(place::of_view(setup, &o.base_from_flange, &row).into());
    }
    let corners = wider.boards.iter_mut().flat_map(|b| &mut b.corners);
    for ((corner, &k), row) in corners.zip(touches).zip(rows) {
        corner.by_robot = views.session.touches[k]
            .base_from_flange
            .map(|flange| place::of_view(Setup::EyeInHand, &flange, &row).into());
    }
    wider.extras.extend(waves.extras(0));
    wider
}

/// Errors by place as a fit has them.
pub(crate) fn errors(views: &Views, kernel: Kernel, waves: &Waves, fit: &JointFit) -> Errors {
    let arm = match kernel {
        Kernel::Joints(_) => views.session.arm.clone(),
        Kernel::Pose { .. } => None,
    };
    let own: Vec<f64> = (0..fit.extras.len())
        .filter(|&k| fit.extras[k].kind.level().is_some())
        .map(|k| fit.values[k])
        .collect();
    let sigma = |source| fit.noise.sigma(source).unwrap_or(0.0);
    Errors {
        kernel,
        waves: waves.by_about.row_iter().map(|row| row.iter().copied().collect()).collect(),
        about: waves.about.clone(),
        strengths: own.chunks_exact(6).map(|six| std::array::from_fn(|k| six[k])).collect(),
        level: [sigma(Source::PlaceRotation), sigma(Source::PlacePosition)],
        arm,
    }
}

/// How many poses of the robot are in the way of one point: a camera on the flange looks from one, and the tool goes to
/// another one.
pub(crate) fn poses(setup: Setup) -> f64 {
    match setup {
        Setup::EyeInHand => 2.0,
        Setup::EyeToHand => 1.0,
    }
}

/// What a residual costs: the mean square over points of the target.
pub(crate) fn metric(views: &Views) -> Matrix6<f64> {
    projection::metric(&points(views))
}

/// Fewest captures in a workspace that stand for the poses in it.
const FEWEST_AT_WORK: usize = 8;

/// The captures that are like the robot's work: those whose target lies in the workspace where one is given and enough of
/// them do, else all.
pub(crate) fn work(views: &Views, hand_eye: &HandEye) -> Vec<usize> {
    let all: Vec<usize> = (0..views.views.len()).collect();
    let Some(Workspace { minimum, maximum }) = &views.session.workspace else { return all };
    let points = points(views);
    let middle = points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64;
    let is_inside = |i: &usize| {
        let pair = &views.views[*i].pair;
        let seen = pair.camera_from_target * Point::from_vector(middle);
        let at = match views.session.setup {
            Setup::EyeToHand => (hand_eye.mount_from_camera * seen).vector(),
            Setup::EyeInHand => seen.vector(),
        };
        (0..3).all(|k| minimum[k] <= at[k] && at[k] <= maximum[k])
    };
    let inside: Vec<usize> = all.iter().copied().filter(is_inside).collect();
    if inside.len() < FEWEST_AT_WORK { all } else { inside }
}

/// Points of the target, about the origin of the residuals.
fn points(views: &Views) -> Vec<Vector3<f64>> {
    match &views.session.target {
        Some(target) => {
            let back = views.target_from_corner.inverse();
            let own = |c: &Point<Target>| (back * *c).vector();
            target.corners().iter().map(own).collect()
        }
        None => {
            let sides = [-HALF_SIZE, HALF_SIZE];
            let edges = sides.iter().flat_map(|x| sides.map(|y| (*x, y)));
            edges.flat_map(|(x, y)| sides.map(|z| Vector3::new(x, y, z))).collect()
        }
    }
}
