//! The offset between the frames of images and scans, found before the robot has its say.
//!
//! The board's plane in image and scan tells rotation and shift from one frame to the other
//! ([`crate::mistakes::frames`]), `scan_from_image = D`. Scans are then brought into the frame of the images, so that
//! both are fused, and the answer for the scans is
//!
//! ```text
//! X_scan = X_image D⁻¹        C_scan = Ad(D) C_image Ad(D)ᵀ + C_D
//! ```
//!
//! A corner in a scan is where the ray of its pixel meets the scanned plane, in the frame of the images: that holds
//! for scans whose pixels are those of the image and for those whose points were moved into another frame.

use nalgebra::{Isometry3, Matrix3, Matrix6, Vector3};

use super::seen_planes;
use crate::{
    Calibration, Camera, ImageCorner, Intrinsics, Mount, Pose, SurfaceCorner, TargetPose, Warning,
    calibrate::{
        flow::config::AnswerFrame,
        result::{Answer, Candidate, PoseCovariance, matrix, rows},
    },
    detect,
    estimate::predict::{self, PredictedTre},
    findings::{
        FramesFinding,
        frames::{Frame, OffsetOfScans},
    },
    math::{lie, linalg::median},
    mistakes::frames::{Frames, Part, frames},
    model::session::Session,
};

/// Offsets that move no point of the target by more than this are none, m.
const LEAST: f64 = 5e-5;
/// Scans that are shifted along the optical axis by less than this read a biased depth, m.
const LARGEST_BIAS: f64 = 5e-3;
/// Fewest corners that tell the plane of a board in a scan.
const FEWEST: usize = 4;

/// Where scans lie against images.
pub(crate) struct Offset {
    scan_from_image: Isometry3<f64>,
    /// Of a perturbation on the right, rotation first.
    covariance: Matrix6<f64>,
    /// Distance of the target, at which the offset is stated (m).
    distance: f64,
}

/// What images and scans say of their frames.
pub(crate) enum Found {
    /// They agree, or too few captures have both.
    Nothing,
    /// They differ by a rigid offset.
    Offset(Box<Offset>),
    /// They differ, and the captures do not tell by what.
    NotSeparable,
}

/// Looks for an offset.
pub(crate) fn find(session: &Session) -> Found {
    let Some(found) = frames(&seen_planes(session)) else { return Found::Nothing };
    let rigid: Vec<&Part> = found.proven.iter().filter(|p| **p != Part::Scale).collect();
    if rigid.is_empty() {
        return Found::Nothing;
    }
    let distance = distance(session);
    let offset = of(&found, distance);
    if offset.moves() < LEAST {
        return Found::Nothing;
    }
    if found.separable { Found::Offset(Box::new(offset)) } else { Found::NotSeparable }
}

fn of(found: &Frames, distance: f64) -> Offset {
    let part = |part: Part, first: usize| -> Vector3<f64> {
        let proven = found.proven.contains(&part);
        if proven { found.values.fixed_rows::<3>(first).into() } else { Vector3::zeros() }
    };
    let (turn, mut shift) = (part(Part::Tilt, 1), part(Part::Shift, 4));
    let mut covariance: Matrix6<f64> = found.covariance.fixed_view::<6, 6>(1, 1).into();
    if shift.z.abs() < LARGEST_BIAS {
        // a bias of depth, which the fit has among its unknowns
        shift.z = 0.0;
        covariance.fixed_rows_mut::<1>(5).fill(0.0);
        covariance.fixed_columns_mut::<1>(5).fill(0.0);
    }
    Offset { scan_from_image: Isometry3::new(shift, turn), covariance, distance }
}

/// Median distance of the target from the camera, m.
fn distance(session: &Session) -> f64 {
    let first = |o: &crate::Observation| Some(o.candidates.first()?.camera_from_target);
    median(session.observations.iter().filter_map(first).map(|p| p.translation().norm()))
}

impl Offset {
    /// By how much a point at the target's distance moves, m.
    fn moves(&self) -> f64 {
        let p = Vector3::z() * self.distance;
        (self.scan_from_image.transform_vector(&p) + self.scan_from_image.translation.vector - p)
            .norm()
    }

    /// The session with its scans in the frame of its images.
    pub(crate) fn taken_out(&self, session: &Session) -> Session {
        let mut session = session.clone();
        let (Some(camera), Some(target)) = (session.camera, session.target.clone()) else {
            return session;
        };
        let moved = |corners: &[ImageCorner], surface: &[SurfaceCorner]| {
            let seen: Vec<_> = corners.iter().map(|c| (c.id, c.pixel)).collect();
            self.in_image(surface, &seen, &camera)
        };
        // what was posed from images and scans together rests on a mixture of both frames
        let posed = |corners: &[ImageCorner], surface: &[SurfaceCorner], before: &[TargetPose]| {
            let poses = detect::target_poses(corners, surface, &target, &camera);
            poses.map_or(before.to_vec(), |poses| detect::with_symmetries(&poses, &target))
        };
        for o in session.observations.iter_mut().filter(|o| !o.corners.is_empty()) {
            o.surface = moved(&o.corners, &o.surface);
            o.candidates = posed(&o.corners, &o.surface, &o.candidates);
        }
        for p in session.placements.iter_mut().filter(|p| !p.corners.is_empty()) {
            p.surface = moved(&p.corners, &p.surface);
            p.candidates = posed(&p.corners, &p.surface, &p.candidates);
        }
        session
    }

    fn in_image(
        &self,
        surface: &[SurfaceCorner],
        seen: &[(u32, nalgebra::Vector2<f64>)],
        camera: &Intrinsics,
    ) -> Vec<SurfaceCorner> {
        let points: Vec<Vector3<f64>> =
            surface.iter().map(|c| self.inverse(&c.in_camera.vector())).collect();
        let Some(normal) = normal(&points) else { return surface.to_vec() };
        let turn = self.scan_from_image.rotation.inverse().to_rotation_matrix();
        let moved = |(c, p): (&SurfaceCorner, &Vector3<f64>)| {
            let pixel = seen.iter().find(|(id, _)| *id == c.id).map(|(_, pixel)| pixel);
            let ray = pixel.and_then(|pixel| camera.ray(pixel));
            let at = match ray {
                Some(ray) if ray.dot(&normal).abs() > 1e-3 => {
                    ray * (p.dot(&normal) / ray.dot(&normal))
                }
                _ => *p,
            };
            let covariance = turn.matrix() * c.covariance * turn.matrix().transpose();
            SurfaceCorner { in_camera: crate::Point::from_vector(at), covariance, ..*c }
        };
        surface.iter().zip(&points).map(moved).collect()
    }

    fn inverse(&self, p: &Vector3<f64>) -> Vector3<f64> {
        self.scan_from_image
            .inverse_transform_vector(&(p - self.scan_from_image.translation.vector))
    }

    /// The answer for the frame of the scans, from that for the images.
    pub(crate) fn in_scan_frame(&self, image: &Calibration) -> Calibration {
        let moved = |answer: &Answer| {
            let covariance = answer.covariance.mount_from_camera;
            Answer {
                mount_from_camera: answer.mount_from_camera.map(|x| self.pose(&x)),
                covariance: PoseCovariance {
                    mount_from_camera: covariance.map(|c| rows(&self.spread(&matrix(&c)))),
                    ..answer.covariance
                },
                ..*answer
            }
        };
        let candidate = |c: &Candidate| Candidate { hand_eye: moved(&c.hand_eye), ..c.clone() };
        let own = predict::point_covariance(&(Vector3::z() * self.distance), &self.covariance);
        let tre = image.predicted_tre_mm.clone().map(|tre| {
            let widened = tre.widened((own.trace() * 1e6).sqrt(), WIDE);
            PredictedTre { map: None, ..widened }
        });
        let finding = image.hand_eye.mount_from_camera.map(|x| self.warning(&x, AnswerFrame::Scan));
        let result = Calibration {
            candidates: image.candidates.iter().map(candidate).collect(),
            hand_eye: moved(&image.hand_eye),
            predicted_tre_mm: tre,
            ..image.clone()
        };
        result.noting_first(finding)
    }

    fn pose(&self, image: &Pose<Mount, Camera>) -> Pose<Mount, Camera> {
        Pose::claim(image.iso() * self.scan_from_image.inverse())
    }

    fn spread(&self, image: &Matrix6<f64>) -> Matrix6<f64> {
        let carry = lie::adjoint(&self.scan_from_image);
        carry * image * carry.transpose() + self.covariance
    }

    /// What was found, and the answer in the other frame.
    pub(crate) fn warning(&self, image: &Pose<Mount, Camera>, frame: AnswerFrame) -> Warning {
        let other = match frame {
            AnswerFrame::Scan => *image,
            AnswerFrame::Image => self.pose(image),
        };
        FramesFinding::Offset {
            scans_are: self.found(),
            at_target_mm: self.moves() * 1e3,
            answer: match frame {
                AnswerFrame::Scan => Frame::Scans,
                AnswerFrame::Image => Frame::Images,
            },
            other_position_mm: (other.translation() * 1e3).into(),
        }
        .into()
    }

    /// Why the answer is that of the scans alone.
    pub(crate) fn not_confirmed(&self, scans: &Calibration, moved: &Calibration) -> Warning {
        let own = scans.hand_eye.mount_from_camera;
        let apart = own.zip(moved.hand_eye.mount_from_camera).map(|(a, b)| a.distance_to(&b) * 1e3);
        let apart_mm = apart.unwrap_or(f64::NAN);
        FramesFinding::OffsetNotConfirmed { scans_seem: self.found(), apart_mm }.into()
    }

    /// The parts of the difference that the captures prove.
    fn found(&self) -> OffsetOfScans {
        let largest = |rows: std::ops::Range<usize>| {
            rows.map(|k| self.covariance[(k, k)].max(0.0).sqrt()).fold(0.0, f64::max)
        };
        let d = self.scan_from_image.translation.vector * 1e3;
        let turn = self.scan_from_image.rotation.scaled_axis().map(f64::to_degrees);
        let shifts = d != Vector3::zeros();
        let turns = turn != Vector3::zeros();
        OffsetOfScans {
            shift_mm: shifts.then(|| (d.into(), largest(3..6) * 1e3)),
            rotation_deg: turns.then(|| (turn.into(), largest(0..3).to_degrees())),
        }
    }
}

/// The 95 % point of an error over its root mean square, of a direction that is one of three.
const WIDE: f64 = 1.7;

/// Normal of the plane through points.
fn normal(points: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    if points.len() < FEWEST {
        return None;
    }
    let middle = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let scatter: Matrix3<f64> =
        points.iter().map(|p| (p - middle) * (p - middle).transpose()).sum();
    let eigen = scatter.symmetric_eigen();
    let least = eigen.eigenvalues.imin();
    Some(eigen.eigenvectors.column(least).into_owned())
}
