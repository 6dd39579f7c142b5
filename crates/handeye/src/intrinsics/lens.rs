//! Radial distortion of a camera that was given without any: the target's own corners tell it.
//!
//! A flat target whose corners the pinhole cannot reach shows by how much the lens bends:
//!
//! ```text
//! S(k₁) = Σᵢ min_T Σⱼ |π(k₁, T pⱼ) - uᵢⱼ|²,      σ² = 2 S / (freedom S″)      at the least S
//! ```
//!
//! over the views `i` and their corners `j`, each view with its own pose `T`. `S` is nearly a
//! parabola in `k₁`, and its least is found as one. Poses of the robot have no part in it. Whether
//! the term is worth having is decided as for a camera calibrated from its views.
//!
//! G. Schwarz, *Estimating the dimension of a model*, 1978.

use crate::{
    Camera, Distortion, ImageCorner, Intrinsics, Pose, Target, TargetModel,
    detect::{PosedTarget, target_pose_near},
    intrinsics::{
        PRICE,
        adjustment::{Corner, linearised},
    },
    math::linalg::median,
};
use nalgebra::{Matrix6, Vector6};

/// What the corners say about a lens that was given as free of distortion.
#[derive(Debug, Clone, Copy)]
pub struct Bend {
    /// The given camera with `k1` added.
    pub intrinsics: Intrinsics,
    /// Radial distortion, no unit.
    pub k1: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// Root of the mean squared distance of corners and model as given, px.
    pub rms_given_px: f64,
    /// The same with `k1`.
    pub rms_px: f64,
}

/// Fewer equations beyond the unknowns prove nothing.
const FEWEST_FREE: f64 = 10.0;
/// Distances below this (px) are exact.
const EXACT_PX: f64 = 1e-3;
/// Half the width of a parabola; narrower ones would feel a view whose pose is not found.
const WIDTH: f64 = 0.04;
/// Parabolas, each about the least of the one before.
const ROUNDS: usize = 3;
/// Where the equations at the poses as given promise less than this share of the price, it is not reached.
const PROMISING: f64 = 0.25;
/// Place of `k1` among the parameters of a lens.
const K1: usize = 4;

/// The radial distortion that the views prove, if `given` has none and they do. `posed` is what
/// [`best_poses`](crate::detect::best_poses) finds in these views with the camera as given.
pub fn bend(
    views: &[&[ImageCorner]],
    posed: &[Option<PosedTarget>],
    target: &TargetModel,
    given: &Intrinsics,
) -> Option<Bend> {
    if !is_straight(given) {
        return None;
    }
    let views = Views::as_given(views, posed, target, given);
    let before = views.squares(0.0);
    let (corners, straight) = (before.len() as f64, before.iter().sum::<f64>());
    let freedom = 2.0 * corners - 6.0 * views.posed.len() as f64 - 1.0;
    if freedom < FEWEST_FREE || median(before).sqrt() < EXACT_PX {
        return None;
    }
    let gain = |bent: f64| corners * (straight / bent).ln();
    let price = PRICE * corners.ln();
    if gain(straight - views.promised_fall()?) < PROMISING * price {
        return None;
    }
    let total = |k1: f64| views.squares(k1).iter().sum::<f64>();
    let (k1, curvature) = least(total)?;
    let bent = total(k1);
    let intrinsics = with_k1(given, k1);
    let pays = gain(bent) > price && views.is_sound(&intrinsics);
    let rms = |sum: f64| (sum / corners).sqrt();
    pays.then(|| Bend {
        intrinsics,
        k1,
        sigma: (2.0 * bent / (freedom * curvature)).sqrt(),
        rms_given_px: rms(straight),
        rms_px: rms(bent),
    })
}

/// Given without any distortion: not measured, or images straightened beforehand.
fn is_straight(camera: &Intrinsics) -> bool {
    match camera.distortion {
        Distortion::None => true,
        Distortion::BrownConrady(k) => k.iter().all(|k| *k == 0.0),
        _ => false,
    }
}

fn with_k1(given: &Intrinsics, k1: f64) -> Intrinsics {
    let mut k = [0.0; 12];
    k[0] = k1;
    Intrinsics { distortion: Distortion::BrownConrady(k), ..*given }
}

/// Where `total` is least, and its second derivative there.
fn least(total: impl Fn(f64) -> f64) -> Option<(f64, f64)> {
    let (mut at, mut curvature) = (0.0, 0.0);
    for _ in 0..ROUNDS {
        let (below, here, above) = (total(at - WIDTH), total(at), total(at + WIDTH));
        curvature = (below + above - 2.0 * here) / (WIDTH * WIDTH);
        if !(curvature > 0.0) {
            return None;
        }
        let step = (below - above) / (2.0 * WIDTH) / curvature;
        at += step.clamp(-2.0 * WIDTH, 2.0 * WIDTH);
    }
    Some((at, curvature))
}

struct Views<'a> {
    /// Corners of each view, and the pose in which the camera as given sees them.
    posed: Vec<(&'a [ImageCorner], Pose<Camera, Target>)>,
    target: &'a TargetModel,
    given: &'a Intrinsics,
}

impl<'a> Views<'a> {
    /// The views that have a pose.
    fn as_given(
        views: &[&'a [ImageCorner]],
        posed: &[Option<PosedTarget>],
        target: &'a TargetModel,
        given: &'a Intrinsics,
    ) -> Self {
        let of_views = views.iter().zip(posed);
        let posed = of_views.filter_map(|(c, p)| Some((*c, p.as_ref()?.pose.camera_from_target)));
        Self { posed: posed.collect(), target, given }
    }

    /// Squared distances (px²) of all corners and the model with this `k1`, each view at its best
    /// pose.
    fn squares(&self, k1: f64) -> Vec<f64> {
        let camera = with_k1(self.given, k1);
        let of_view = |(corners, start): &(&'a [ImageCorner], Pose<Camera, Target>)| {
            let near = || target_pose_near(corners, self.target, &camera, start);
            let pose = if k1 == 0.0 { *start } else { near()?.pose.camera_from_target };
            let square = |c: &ImageCorner| {
                let pixel = camera.project(&(pose * self.target.corner(c.id)?).vector())?;
                Some((pixel - c.pixel).norm_squared())
            };
            Some(corners.iter().filter_map(square).collect::<Vec<f64>>())
        };
        self.posed.iter().filter_map(of_view).flatten().collect()
    }

    /// By how much the squares would fall, were the model linear at the poses as given: in `k1`, with each view's own
    /// pose taken out.
    fn promised_fall(&self) -> Option<f64> {
        let camera = with_k1(self.given, 0.0);
        let (mut slope, mut curvature) = (0.0, 0.0);
        for (corners, pose) in &self.posed {
            let (mut normal, mut across) = (Matrix6::zeros(), Vector6::zeros());
            let (mut gradient, mut own) = (Vector6::zeros(), (0.0, 0.0));
            for c in *corners {
                let Some(in_target) = self.target.corner(c.id) else { continue };
                let corner = Corner::of(c, in_target.vector());
                let (r, by_lens, by_pose) = linearised(&camera, pose.iso(), &corner)?;
                let by_k1 = by_lens.column(K1);
                normal += by_pose.transpose() * by_pose;
                across += by_pose.transpose() * by_k1;
                gradient += by_pose.transpose() * r;
                own = (own.0 + by_k1.dot(&r), own.1 + by_k1.norm_squared());
            }
            let Some(normal) = normal.cholesky() else { continue };
            let through = normal.solve(&across);
            slope += own.0 - through.dot(&gradient);
            curvature += own.1 - through.dot(&across);
        }
        (curvature > 0.0).then(|| slope * slope / curvature)
    }

    /// The distortion does not fold over where the corners are.
    fn is_sound(&self, camera: &Intrinsics) -> bool {
        let mut corners = self.posed.iter().flat_map(|(corners, _)| *corners);
        corners.all(|c| camera.undistort(&c.pixel).is_some())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Camera, Pose, Target, detect::best_poses, math::random::Random};
    use nalgebra::{Matrix2, Vector2};

    const SIGMA_PX: f64 = 0.05;

    fn pinhole() -> Intrinsics {
        Intrinsics::pinhole(640, 480, 600.0, 600.0, 319.5, 239.5)
    }

    fn tag() -> TargetModel {
        TargetModel::Tag { dictionary: "DICT_APRILTAG_36h11".into(), id: 1, size_mm: 48.0 }
    }

    /// Twelve views of a tag in all parts of the image.
    fn views(camera: &Intrinsics, seed: u64) -> Vec<Vec<ImageCorner>> {
        let mut random = Random::new(seed);
        let mut view = |_| {
            let turn = [(); 3].map(|()| random.between(-0.5, 0.5));
            let at = [random.between(-0.08, 0.08), random.between(-0.05, 0.05), 0.24];
            let pose: Pose<Camera, Target> =
                Pose::claim(nalgebra::Isometry3::new(at.into(), turn.into()));
            let corner = |(id, p): (usize, crate::Point<Target>)| {
                let noise = Vector2::new(random.normal(), random.normal()) * SIGMA_PX;
                let pixel = camera.project(&(pose * p).vector()).unwrap() + noise;
                let covariance = Matrix2::identity() * SIGMA_PX * SIGMA_PX;
                ImageCorner { id: id as u32, pixel, covariance }
            };
            tag().corners().into_iter().enumerate().map(corner).collect()
        };
        (0..12).map(&mut view).collect()
    }

    fn told(views: &[Vec<ImageCorner>], given: &Intrinsics) -> Option<Bend> {
        let views: Vec<&[ImageCorner]> = views.iter().map(Vec::as_slice).collect();
        bend(&views, &best_poses(&views, &tag(), given, 1), &tag(), given)
    }

    #[test]
    fn tags_tell_the_distortion_that_was_not_declared() {
        let (mut sum, count) = (0.0, 60);
        for seed in 0..count {
            let found = told(&views(&with_k1(&pinhole(), 0.1), seed), &pinhole()).unwrap();
            assert!((found.k1 - 0.1).abs() < 0.04, "{found:?}");
            assert!(found.rms_px < found.rms_given_px, "{found:?}");
            sum += ((found.k1 - 0.1) / found.sigma).powi(2);
        }
        let mean = sum / count as f64;
        assert!((0.4..2.0).contains(&mean), "{mean}");
    }

    #[test]
    fn a_lens_that_does_not_bend_stays_as_given() {
        let false_alarms = (0..20).filter(|&s| told(&views(&pinhole(), s), &pinhole()).is_some());
        assert!(false_alarms.count() <= 1);
    }

    #[test]
    fn a_declared_distortion_is_believed() {
        let bent = with_k1(&pinhole(), 0.1);
        assert!(told(&views(&bent, 0), &with_k1(&pinhole(), 0.02)).is_none());
    }
}
