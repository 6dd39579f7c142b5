//! Which measurement of the target to trust: its picture, its scan, or both together.
//!
//! Both are fused by default. But a lens that is not calibrated well, or a depth camera with a
//! bias, spoils the fusion, and neither can tell which of them is wrong. The robot can: where they
//! are far apart, the whole calibration runs with either alone as well, and the least predicted
//! error wins, which contains the misfit of picture, scan and robot.

use nalgebra::Vector3;

use super::Session;
use crate::{
    ImageCorner, Intrinsics, Pose, SurfaceCorner, TargetModel, TargetPose, Warning,
    calibration::{Calibration, Verdict},
    detect, lie,
    linalg::median,
    register,
};

/// What a target pose is made from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Source {
    Both,
    Picture,
    Scan,
}

/// Fewest corners in a scan that make a pose.
const FEWEST: usize = 4;

/// Runs the calibration on every source there is and keeps the best.
pub(super) fn best_source(session: &Session, run: impl Fn(&Session) -> Calibration) -> Calibration {
    let both = run(session);
    let scans = session.observations.iter().filter(|o| o.surface.len() >= FEWEST).count();
    let (Some(target), Some(camera)) = (&session.target, &session.camera) else { return both };
    if 2 * scans < session.observations.len() || scans == 0 {
        return both;
    }
    let gap = gap(session, target, camera);
    if gap.0 < WORTH_TELLING.0 && gap.1 < WORTH_TELLING.1 {
        return both;
    }
    let mut all = vec![(Source::Both, both)];
    for source in [Source::Picture, Source::Scan] {
        all.push((source, run(&restricted(session, source, target, camera))));
    }
    let score = |c: &Calibration| {
        let usable = c.verdict == Verdict::Accepted;
        (!usable, c.predicted_tre_mm.as_ref().map_or(f64::INFINITY, |t| t.rms))
    };
    let best = (0..all.len())
        .min_by(|&i, &j| {
            let ((a, x), (b, y)) = (score(&all[i].1), score(&all[j].1));
            a.cmp(&b).then(x.total_cmp(&y))
        })
        .unwrap_or(0);
    let (source, mut result) = all.swap_remove(best);
    warn(&mut result, source, gap);
    result
}

fn restricted(
    session: &Session,
    source: Source,
    target: &TargetModel,
    camera: &Intrinsics,
) -> Session {
    let mut session = session.clone();
    for o in &mut session.observations {
        if let Some(poses) = poses(&o.corners, &o.surface, source, target, camera) {
            o.candidates = poses;
        }
    }
    for p in &mut session.placements {
        if let Some(poses) = poses(&p.corners, &p.surface, source, target, camera) {
            p.candidates = poses;
        }
    }
    session
}

fn poses(
    corners: &[ImageCorner],
    surface: &[SurfaceCorner],
    source: Source,
    target: &TargetModel,
    camera: &Intrinsics,
) -> Option<Vec<TargetPose>> {
    if surface.len() < FEWEST {
        return None;
    }
    let posed = match source {
        Source::Both => return None,
        Source::Picture => detect::target_poses(corners, &[], target, camera).ok()?,
        Source::Scan => {
            let pose = scan_pose(surface, target)?;
            // the same shape as the picture's, for its symmetries
            vec![detect::PosedTarget {
                pose,
                cost: 0.0,
                rms_px: 0.0,
                excess_px: 0.0,
                left_out: vec![],
            }]
        }
    };
    Some(detect::with_symmetries(&posed, target))
}

/// The target's pose from its corners in the scan alone.
fn scan_pose(surface: &[SurfaceCorner], target: &TargetModel) -> Option<TargetPose> {
    let (model, seen): (Vec<Vector3<f64>>, Vec<Vector3<f64>>) = surface
        .iter()
        .filter_map(|c| Some((target.corner(c.id)?.vector(), c.in_camera.vector())))
        .unzip();
    let fit = register::rigid_fit(&model, &seen).ok()?;
    Some(TargetPose {
        camera_from_target: Pose::claim(fit.target_from_source),
        covariance: fit.covariance,
    })
}

/// Median angle (rad) and distance (m, at the target's middle) between the poses that picture and
/// scan give.
fn gap(session: &Session, target: &TargetModel, camera: &Intrinsics) -> (f64, f64) {
    let middle =
        target.corners().iter().map(|c| c.vector()).sum::<Vector3<f64>>() / target.len() as f64;
    let (angles, distances): (Vec<f64>, Vec<f64>) = session
        .observations
        .iter()
        .filter_map(|o| {
            let near = |p: &TargetPose| {
                let start = &p.camera_from_target;
                Some(detect::sighted(&o.corners, &[], target, camera, None, start)?.0)
            };
            let picture: Vec<detect::PosedTarget> = o.candidates.iter().filter_map(near).collect();
            let scan = scan_pose(&o.surface, target)?.camera_from_target;
            let apart = |p: &detect::PosedTarget| {
                let p = p.pose.camera_from_target;
                let at = |q: &nalgebra::Isometry3<f64>| {
                    q.transform_vector(&middle) + q.translation.vector
                };
                (
                    lie::angle(&p.iso().rotation, &scan.iso().rotation),
                    (at(p.iso()) - at(scan.iso())).norm(),
                )
            };
            picture.iter().map(apart).min_by(|a, b| a.0.total_cmp(&b.0))
        })
        .unzip();
    (median(angles), median(distances))
}

/// Disagreement of picture and scan that is worth a look at either, and telling: 0.5 degrees, 2 mm.
const WORTH_TELLING: (f64, f64) = (0.0087, 0.002);

fn warn(result: &mut Calibration, source: Source, (angle, distance): (f64, f64)) {
    let used = match source {
        Source::Both => "both are used together",
        Source::Picture => "only the pictures are used",
        Source::Scan => "only the scans are used",
    };
    result.warnings.push(Warning::new(
        "picture-and-scan-disagree",
        format!(
            "picture and scan put the target {:.1} mm and {:.2} degrees apart (median): check the \
             lens distortion of the picture's intrinsics and the depth camera's warm-up and \
             calibration; {used}, which predicts the least error",
            distance * 1e3,
            angle.to_degrees()
        ),
    ));
}
