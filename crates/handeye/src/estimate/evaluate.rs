//! How good an answer is: on the captures it was made from, and on captures it has not seen.

use serde::{Deserialize, Serialize};

use crate::{
    Error, HandEye, Intrinsics, Observation, PosePair, Setup, TargetModel,
    estimate::predict::Volume,
    math::{linalg::root_mean, parallel},
    model::residual::Residual,
    solve::{self, Method, View, least_squares, motions},
};

/// Residual in rotation and translation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, Default)]
pub struct RmsResidual {
    /// Root mean square angle; null where no rotations were compared.
    pub rotation_rms_deg: Option<f64>,
    /// Root mean square distance at the target's first corner.
    pub translation_rms_mm: Option<f64>,
    /// Over all corners, by projecting them through the robot poses; null without images.
    #[serde(default)]
    pub reprojection_rms_px: Option<f64>,
}

/// What the poses can determine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Diversity {
    /// Captures used.
    pub captures: usize,
    /// Largest rotation between two of them.
    pub largest_rotation_deg: f64,
    /// Spread of the rotation axes: eigenvalues of their scatter, largest is one.
    pub axis_spread: [f64; 3],
    /// Extent of the robot positions.
    pub travel_mm: [f64; 3],
}

/// A way from captures to an answer.
#[derive(Debug, Clone, PartialEq)]
pub enum Estimator {
    /// A published closed form.
    ClosedForm(Method),
    /// Least squares over both unknowns; 1 rad of residual costs as much as 0.1 m.
    LeastSquares,
}

/// Weight of rotation against translation in plain least squares, m per rad.
const METRES_PER_RAD: f64 = 0.1;

impl Estimator {
    /// The answer from these captures.
    ///
    /// # Errors
    /// As [`solve::solve`].
    pub fn estimate(&self, views: &[View], start: &HandEye) -> Result<HandEye, Error> {
        let pairs = || views.iter().map(|v| v.pair).collect::<Vec<_>>();
        match self {
            Estimator::ClosedForm(method) => solve::solve(&pairs(), *method),
            Estimator::LeastSquares => {
                Ok(least_squares::fit_fixed_weights(views, start, METRES_PER_RAD))
            }
        }
    }
}

/// Up to this many captures are left out one at a time; of more, every tenth together.
const ONE_AT_A_TIME: usize = 30;

/// Which captures are left out together.
pub fn folds(count: usize) -> Vec<Vec<usize>> {
    if count <= ONE_AT_A_TIME {
        return (0..count).map(|i| vec![i]).collect();
    }
    (0..10).map(|k| (k..count).step_by(10).collect()).collect()
}

/// Leave-one-out residual of every capture.
pub type HeldOut = Vec<Option<Residual>>;

/// The residual of every capture under an answer that was made without it; `None` where the
/// captures that remain do not determine one.
pub fn held_out(estimator: &Estimator, views: &[View], start: &HandEye, threads: usize) -> HeldOut {
    each_left_out(views, threads, |rest, left_out| {
        let answer = estimator.estimate(&rest, start).ok()?;
        Some(left_out.iter().map(|view| answer.loop_residual(&view.pair)).collect())
    })
}

/// What a fit of the other views misses of the views of each fold: `missed(others, left_out)`.
pub(crate) fn each_left_out(
    views: &[View],
    threads: usize,
    missed: impl Fn(Vec<View>, &[&View]) -> Option<Vec<Residual>> + Sync,
) -> HeldOut {
    let mut found = vec![None; views.len()];
    if views.len() <= solve::FEWEST_POSES {
        return found;
    }
    let folds = folds(views.len());
    let of_fold = |k: usize| {
        let is_kept = |i: &usize| !folds[k].contains(i);
        let rest = (0..views.len()).filter(is_kept).map(|i| views[i].clone()).collect();
        let left_out: Vec<&View> = folds[k].iter().map(|i| &views[*i]).collect();
        missed(rest, &left_out)
    };
    let all = parallel::in_order(folds.len(), threads, of_fold);
    for (fold, residuals) in folds.iter().zip(all) {
        for (i, residual) in fold.iter().zip(residuals.into_iter().flatten()) {
            found[*i] = Some(residual);
        }
    }
    found
}

/// The residual (rad, m) of every capture when the camera's place comes from elsewhere and the
/// target's place from the other captures.
pub(crate) fn placed_without(
    views: &[View],
    mount_from_camera: &crate::Pose<crate::Mount, crate::Camera>,
) -> HeldOut {
    let without = |i: usize| {
        let rest: Vec<PosePair> =
            (0..views.len()).filter(|j| *j != i).map(|j| views[j].pair).collect();
        let answer = solve::place_target(&rest, mount_from_camera);
        (!rest.is_empty()).then(|| answer.loop_residual(&views[i].pair))
    };
    (0..views.len()).map(without).collect()
}

/// Root mean squares of residuals; those that are missing are left out.
pub fn rms(residuals: &[Option<Residual>]) -> RmsResidual {
    let mean =
        |part: fn(&Residual) -> f64| root_mean(residuals.iter().flatten().map(|m| part(m).powi(2)));
    RmsResidual {
        rotation_rms_deg: mean(|m| m.angle).map(f64::to_degrees),
        translation_rms_mm: mean(|m| m.distance).map(|t| t * 1e3),
        reprojection_rms_px: None,
    }
}

/// Residual of all captures under one answer.
pub fn in_sample(answer: &HandEye, views: &[View]) -> RmsResidual {
    let all: Vec<_> = views.iter().map(|v| Some(answer.loop_residual(&v.pair))).collect();
    rms(&all)
}

/// RMS distance (px) of an image's corners to where answer and robot pose put them. The target
/// frame of `answer` is the target's own.
pub fn reprojection_px(
    answer: &HandEye,
    observation: &Observation,
    setup: Setup,
    target: &TargetModel,
    relabel: &[u32],
    camera: &Intrinsics,
) -> Option<f64> {
    let anchor_from_mount = setup.anchor_from_mount(observation.base_from_flange);
    let camera_from_target =
        (anchor_from_mount * answer.mount_from_camera).inverse() * answer.anchor_from_target;
    let distances = observation.corners.iter().filter_map(|c| {
        let corner = target.corner(*relabel.get(c.id as usize)?)?;
        let pixel = camera.project(&(camera_from_target * corner).vector())?;
        Some((pixel - c.pixel).norm_squared())
    });
    let (sum, count) = distances.fold((0.0, 0.0), |(s, n), d| (s + d, n + 1.0));
    (count > 0.0).then(|| f64::sqrt(sum / count))
}

/// What the motions between captures can determine.
pub fn diversity(pairs: &[PosePair]) -> Diversity {
    let mut spread: Vec<f64> =
        motions::axis_scatter(pairs).symmetric_eigen().eigenvalues.iter().copied().collect();
    spread.sort_by(|a, b| b.total_cmp(a));
    let most = spread[0].max(f64::MIN_POSITIVE);
    let largest = motions::motions(pairs).iter().map(|m| m.a.rotation.angle()).fold(0.0, f64::max);
    let volume = Volume::around(pairs.iter().map(PosePair::t_a), "");
    let travel = volume.map_or(nalgebra::Vector3::zeros(), |v| {
        v.points.last().zip(v.points.first()).map_or(nalgebra::Vector3::zeros(), |(b, a)| b - a)
    });
    Diversity {
        captures: pairs.len(),
        largest_rotation_deg: largest.to_degrees(),
        axis_spread: std::array::from_fn(|k| spread[k].max(0.0) / most),
        travel_mm: (travel * 1e3).into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::tests::{exact_pairs, truths};

    #[test]
    fn exact_captures_have_no_held_out_error() {
        let views: Vec<View> = exact_pairs(&truths()[0], 8).into_iter().map(View::bare).collect();
        for estimator in [Estimator::ClosedForm(Method::Shah), Estimator::LeastSquares] {
            let found = rms(&held_out(&estimator, &views, &truths()[0], 2));
            assert!(found.translation_rms_mm.unwrap() < 1e-6, "{estimator:?}");
        }
    }

    #[test]
    fn many_captures_are_left_out_in_ten_groups() {
        let folds = folds(88);
        assert_eq!(folds.len(), 10);
        let mut all: Vec<usize> = folds.concat();
        all.sort_unstable();
        assert_eq!(all, (0..88).collect::<Vec<_>>());
    }
}
