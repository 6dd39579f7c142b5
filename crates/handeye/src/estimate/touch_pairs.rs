//! The two-step refinement: touched corners registered to the corners that the camera measured.
//!
//! Eye-to-hand: a board lies still, the camera measures its corners (`cam_Pi`), the tip touches
//! some (`base_Pi`), and the two sets are registered. Eye-in-hand: the fixed board is measured from
//! every view, so every touch pairs with one point a view, carried to the flange by that view's
//! robot pose: `min Σ_ij |G_i⁻¹ b_j - X p_ij|²`. (A correction in the base from one view alone is
//! not a property of the camera: it depends on the view.)
//!
//! Registering is no refinement of the start: with known correspondences the answer does not
//! depend on it, and its residual says nothing about its accuracy. Whether it is better than the
//! start is decided by prediction and by touches that were left out.

use nalgebra::{Matrix6, Vector3};

use crate::{
    Camera, Correspondence, Error, Mount, Observation, Placement, Point, Pose, Session, Setup,
    TargetModel, Touch,
    estimate::predict,
    findings::TouchFinding,
    math::linalg,
    register::{self, IcpConfig, Stop},
};

/// One touch with the points of the camera that it pairs with.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchPairs {
    /// Its place in the list of touches.
    pub touch: usize,
    /// Its placement.
    pub placement: String,
    /// The same corner as the camera saw it, once a view.
    pub pairs: Vec<Correspondence>,
    /// Where the robot carried the camera in each pair: takes the mount to the base.
    pub base_from_mount: Vec<Pose<crate::Base, Mount>>,
    /// Which view each pair was seen from; empty where the robot did not move the camera.
    pub views: Vec<usize>,
    /// The touched corner, about the point at which residuals are stated.
    pub corner: Vector3<f64>,
}

/// Takes out touches that repeat another one number by number: a line that was copied is no second
/// measurement. Returns a warning for each touch that was listed several times.
pub fn each_once(touches: &mut Vec<Touch>) -> Vec<TouchFinding> {
    let mut kept: Vec<(Touch, usize)> = Vec::new();
    for touch in touches.drain(..) {
        match kept.iter_mut().find(|(t, _)| *t == touch) {
            Some((_, count)) => *count += 1,
            None => kept.push((touch, 1)),
        }
    }
    let repeated = |(touch, count): &(Touch, usize)| TouchFinding::Repeated {
        corner: touch.corner,
        placement: touch.placement.clone(),
        count: *count,
    };
    let findings = kept.iter().filter(|(_, count)| *count > 1).map(repeated).collect();
    touches.extend(kept.into_iter().map(|(touch, _)| touch));
    findings
}

/// Placements that touches name, and boards in the cell, where the one board of the views is touched.
pub fn placements_ignored(session: &Session) -> Option<TouchFinding> {
    let mut names: Vec<String> = session.touches.iter().map(|t| t.placement.clone()).collect();
    names.extend(session.placements.iter().map(|p| p.id.clone()));
    names.sort();
    names.dedup();
    let several = names.len() > 1 || !session.placements.is_empty();
    let ignored = session.setup == Setup::EyeInHand && !session.touches.is_empty() && several;
    ignored.then_some(TouchFinding::PlacementsIgnored { names })
}

/// Pairs every touch with what the camera measured. Touches whose corner no view shows are left
/// out; the second list names them.
pub fn pair_touches(
    setup: Setup,
    target: &TargetModel,
    observations: &[&Observation],
    placements: &[Placement],
    touches: &[Touch],
) -> (Vec<TouchPairs>, Vec<usize>) {
    let (mut paired, mut missing) = (Vec::new(), Vec::new());
    for (k, touch) in touches.iter().enumerate() {
        let found = match setup {
            Setup::EyeInHand => in_hand(target, observations, touch),
            Setup::EyeToHand => to_hand(target, placements, touch),
        };
        let corner = target.corner(touch.corner).map(|c| c.vector() - target.reference().vector());
        match corner {
            Some(corner) if !found.is_empty() => paired.push(TouchPairs {
                touch: k,
                placement: touch.placement.clone(),
                pairs: found.iter().map(|f| f.0).collect(),
                base_from_mount: found.iter().map(|f| f.1).collect(),
                views: found.iter().filter_map(|f| f.2).collect(),
                corner,
            }),
            _ => missing.push(k),
        }
    }
    (paired, missing)
}

type Pair = (Correspondence, Pose<crate::Base, Mount>, Option<usize>);

fn to_hand(target: &TargetModel, placements: &[Placement], touch: &Touch) -> Vec<Pair> {
    let placement = placements.iter().filter(|p| p.id == touch.placement);
    let measured = placement.filter_map(|p| {
        let pose = p.candidates.first().map(|t| t.camera_from_target);
        camera_point(target, &p.surface, pose, touch.corner)
    });
    measured
        .map(|in_camera| {
            (Correspondence { in_camera, in_mount: touch.in_base.rename() }, Pose::identity(), None)
        })
        .collect()
}

fn in_hand(target: &TargetModel, observations: &[&Observation], touch: &Touch) -> Vec<Pair> {
    observations
        .iter()
        .enumerate()
        .filter_map(|(view, o)| {
            let pose = o.candidates.first().map(|t| t.camera_from_target);
            let in_camera = camera_point(target, &o.surface, pose, touch.corner)?;
            let in_flange = o.base_from_flange.inverse() * touch.in_base;
            let pair = Correspondence { in_camera, in_mount: in_flange.rename() };
            Some((pair, o.base_from_flange.rename(), Some(view)))
        })
        .collect()
}

/// The corner in the camera frame: measured by the scan where there is one, else from the board's
/// fitted pose: the frame of the scan is the one that the result is for.
fn camera_point(
    target: &TargetModel,
    surface: &[crate::SurfaceCorner],
    pose: Option<Pose<Camera, crate::Target>>,
    corner: u32,
) -> Option<Point<Camera>> {
    let fitted = || Some(pose? * target.corner(corner)?);
    let measured = surface.iter().find(|c| c.id == corner).map(|c| c.in_camera);
    measured.or_else(fitted)
}

/// Which registration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Registration {
    /// Known correspondences, in closed form.
    Svd,
    /// Nearest neighbours, iterated from a start.
    Icp(IcpConfig),
}

/// A registration of touches.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchFit {
    /// The whole transform; a start is already contained in it.
    pub mount_from_camera: Pose<Mount, Camera>,
    /// From the scatter of the touches; `None` with three.
    pub covariance: Option<Matrix6<f64>>,
    /// RMS distance.
    pub rms_m: f64,
    /// Rounds and reason of stopping, of an ICP.
    pub stop: Option<(usize, Stop)>,
    /// Matches of an ICP that paired a touch with another corner.
    pub wrong_matches: usize,
}

/// Registers the camera's points to the touched ones.
///
/// # Errors
/// As [`register::rigid_fit()`].
pub fn fit_touches(
    touches: &[&TouchPairs],
    start: &Pose<Mount, Camera>,
    registration: Registration,
) -> Result<TouchFit, Error> {
    let pairs = || touches.iter().flat_map(|t| &t.pairs);
    let source: Vec<Vector3<f64>> = pairs().map(|p| p.in_camera.vector()).collect();
    let target: Vec<Vector3<f64>> = pairs().map(|p| p.in_mount.vector()).collect();
    if touches.len() < 3 {
        return Err(Error::TooFewPoints { found: touches.len(), needed: 3 });
    }
    let mut stop = None;
    let mut wrong_matches = 0;
    let fit = match registration {
        Registration::Svd => register::rigid_fit(&source, &target)?,
        Registration::Icp(config) => {
            let icp = register::point_to_point(&source, &target, start.iso(), &config)?;
            stop = Some((icp.iterations, icp.stop));
            wrong_matches = icp.matches.iter().enumerate().filter(|(i, m)| **m != Some(*i)).count();
            icp.fit
        }
    };
    Ok(TouchFit {
        mount_from_camera: Pose::claim(fit.target_from_source),
        covariance: touch_covariance(touches, &Pose::claim(fit.target_from_source)),
        rms_m: fit.rms_m,
        stop,
        wrong_matches,
    })
}

/// Covariance by the error of one touch. The pairs of one touch share its error, so each touch
/// counts once: its pairs' equations are averaged.
fn touch_covariance(touches: &[&TouchPairs], x: &Pose<Mount, Camera>) -> Option<Matrix6<f64>> {
    let k = touches.len() as f64;
    if k < 4.0 {
        return None;
    }
    let (mut information, mut squares) = (Matrix6::zeros(), 0.0);
    for touch in touches {
        let n = touch.pairs.len() as f64;
        let r: Vector3<f64> = touch.pairs.iter().map(|p| residual(x, p)).sum::<Vector3<f64>>() / n;
        squares += r.norm_squared();
        for p in &touch.pairs {
            let j = register::rigid_fit::point_jacobian(&p.in_camera.vector());
            information += j.transpose() * j / n;
        }
    }
    let sigma2 = squares / (3.0 * k - 6.0);
    linalg::invert_spd(&information).map(|c| c * (sigma2 * small_sample(3.0 * k - 6.0)))
}

/// One view's part in the error of touches: where it saw the target, and the covariance of its
/// residual (robot and camera together) in the target's axes at the reference point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ViewNoise {
    /// Rotation of the target in the camera.
    pub camera_from_target: nalgebra::Matrix3<f64>,
    /// 6 x 6, rotation first.
    pub covariance: Matrix6<f64>,
}

/// Covariance that the views add to a registration of touches (eye-in-hand): all touches paired in
/// one view share that view's error, however many there are.
///
/// With `J_ij` the Jacobian of pair `(i, j)`, `H = Σ JᵀJ` and `B_i = Σ_j J_ijᵀ R_i [-[P_j]ₓ, I]`,
/// the covariance is `H⁻¹ (Σ_i B_i S_i B_iᵀ) H⁻¹`.
pub(crate) fn view_covariance(touches: &[TouchPairs], views: &[ViewNoise]) -> Option<Matrix6<f64>> {
    let mut information = Matrix6::zeros();
    let mut shares = vec![Matrix6::zeros(); views.len()];
    for touch in touches {
        for (pair, &view) in touch.pairs.iter().zip(&touch.views) {
            let (share, noise) = (shares.get_mut(view)?, views.get(view)?);
            let j = register::rigid_fit::point_jacobian(&pair.in_camera.vector());
            let moved = register::rigid_fit::point_jacobian(&touch.corner);
            information += j.transpose() * j;
            *share += j.transpose() * (noise.camera_from_target * moved);
        }
    }
    let inverse = linalg::invert_spd(&information)?;
    let middle: Matrix6<f64> =
        shares.iter().zip(views).map(|(b, v)| b * v.covariance * b.transpose()).sum();
    Some(inverse * middle * inverse)
}

/// Mean square of a t-distributed error over that of a normal one: the variance was estimated
/// from few equations.
pub(crate) fn small_sample(degrees_of_freedom: f64) -> f64 {
    if degrees_of_freedom > 2.5 { degrees_of_freedom / (degrees_of_freedom - 2.0) } else { 5.0 }
}

fn residual(x: &Pose<Mount, Camera>, pair: &Correspondence) -> Vector3<f64> {
    let predicted: Point<Mount> = *x * pair.in_camera;
    x.rotation().transpose() * (pair.in_mount.vector() - predicted.vector())
}

/// Tip minus predicted corner, in the base, averaged over the views that show it (m).
pub(crate) fn touch_error(touch: &TouchPairs, x: &Pose<Mount, Camera>) -> Vector3<f64> {
    let each = touch.pairs.iter().zip(&touch.base_from_mount).map(|(p, base_from_mount)| {
        let predicted: Point<Mount> = *x * p.in_camera;
        base_from_mount.rotation() * (p.in_mount.vector() - predicted.vector())
    });
    each.sum::<Vector3<f64>>() / touch.pairs.len().max(1) as f64
}

/// RMS distance of touches to prediction, m; `None` of none.
pub fn touch_rms(touches: &[TouchPairs], x: &Pose<Mount, Camera>) -> Option<f64> {
    let sum: f64 = touches.iter().map(|t| touch_error(t, x).norm_squared()).sum();
    (!touches.is_empty()).then(|| (sum / touches.len() as f64).sqrt())
}

/// RMS distance of touches that were left out, m: one placement at a time where the rest still
/// holds three touches off a line, one touch at a time otherwise. `None` when too few remain.
pub fn held_out(
    touches: &[TouchPairs],
    start: &Pose<Mount, Camera>,
    registration: Registration,
) -> Option<f64> {
    by_placement(touches, start, registration).or_else(|| {
        let groups: Vec<Vec<usize>> = (0..touches.len()).map(|k| vec![k]).collect();
        leave_out(touches, &groups, start, registration)
    })
}

fn by_placement(
    touches: &[TouchPairs],
    start: &Pose<Mount, Camera>,
    registration: Registration,
) -> Option<f64> {
    let mut names: Vec<&str> = touches.iter().map(|t| t.placement.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    if names.len() < 2 {
        return None;
    }
    let members =
        |name: &&str| (0..touches.len()).filter(|&k| touches[k].placement == **name).collect();
    let groups: Vec<Vec<usize>> = names.iter().map(members).collect();
    leave_out(touches, &groups, start, registration)
}

fn leave_out(
    touches: &[TouchPairs],
    groups: &[Vec<usize>],
    start: &Pose<Mount, Camera>,
    registration: Registration,
) -> Option<f64> {
    let mut sum = 0.0;
    for group in groups {
        let rest: Vec<&TouchPairs> =
            (0..touches.len()).filter(|k| !group.contains(k)).map(|k| &touches[k]).collect();
        let fit = fit_touches(&rest, start, registration).ok()?;
        sum += group
            .iter()
            .map(|&k| touch_error(&touches[k], &fit.mount_from_camera).norm_squared())
            .sum::<f64>();
    }
    Some((sum / touches.len() as f64).sqrt())
}

/// The volume around the touched corners, in the camera frame.
pub(crate) fn touched_volume(touches: &[TouchPairs]) -> Option<predict::Volume> {
    let points = touches.iter().flat_map(|t| &t.pairs).map(|p| p.in_camera.vector());
    predict::Volume::around(points, "the box around the touched corners")
}
