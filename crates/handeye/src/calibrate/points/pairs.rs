//! Point pairs alone: a registration and nothing else.

use nalgebra::{Matrix3, Vector3};

use crate::{
    Camera, Error, Mount, Pose,
    calibrate::{
        flow::{
            evidence::{Choice, Evidence, RestsOn},
            notes::Notes,
        },
        prediction::workpiece::workspace_volume,
        result::{Answer, Candidate, PoseCovariance, rows},
    },
    estimate::{
        evaluate::RmsResidual,
        predict::{self, Volume},
        touch_pairs::{self, Registration, TouchPairs},
    },
    findings::TouchFinding,
    model::session::Session,
};

/// What point pairs alone say.
pub(crate) fn from_points(session: &Session) -> Evidence {
    let touches = as_touches(session);
    let all: Vec<&TouchPairs> = touches.iter().collect();
    let found = match touch_pairs::fit_touches(&all, &Pose::identity(), Registration::Svd) {
        Ok(found) => found,
        Err(error) => {
            let what = match error {
                Error::Collinear { .. } => "rotation about the line of the points",
                _ => "the pose of the camera",
            };
            return Evidence {
                notes: Notes::undetermined(error, what.into()),
                ..Evidence::default()
            };
        }
    };
    let held_out = touch_pairs::held_out(&touches, &Pose::identity(), Registration::Svd);
    let volume = point_volume(session, &touches, &found.mount_from_camera);
    let tre = found.covariance.zip(volume).map(|(c, v)| predict::tre(&v, &c, |_| Vector3::zeros()));
    let mut notes = Notes::of(nearly_collinear(&touches));
    if held_out.is_none() && touches.len() > 3 {
        let what = "without one of the points the others lie on one line or are too few: the rotation rests on a single point that nothing checks; add points away from the line";
        notes.reasons.push(what.into());
        notes.rejects = true;
    }
    let candidate = candidate(&found, held_out, tre.as_ref().map(|t| t.rms));
    let choice = Choice {
        name: Some(candidate.name.clone()),
        rests_on: RestsOn::Touches,
        why: "point pairs alone have one answer: their rigid registration".into(),
        hand_eye: candidate.hand_eye,
        predicted_tre_mm: tre,
        residual: candidate.in_sample,
        held_out: candidate.held_out,
        seen: None,
    };
    let candidates = vec![candidate];
    Evidence { notes, choice: Some(choice), candidates, ..Evidence::default() }
}

/// Every point pair as a touch of its own.
fn as_touches(session: &Session) -> Vec<TouchPairs> {
    let one = |(k, pair): (usize, &crate::Correspondence)| TouchPairs {
        touch: k,
        placement: k.to_string(),
        pairs: vec![*pair],
        base_from_mount: vec![Pose::identity()],
        views: vec![],
        corner: Vector3::zeros(),
    };
    session.correspondences.iter().enumerate().map(one).collect()
}

fn candidate(
    found: &touch_pairs::TouchFit,
    held_out_m: Option<f64>,
    predicted_tre_mm: Option<f64>,
) -> Candidate {
    let residual = |m: Option<f64>| RmsResidual {
        translation_rms_mm: m.map(|m| m * 1e3),
        ..RmsResidual::default()
    };
    Candidate {
        name: "point-pairs-svd".into(),
        hand_eye: Answer {
            mount_from_camera: Some(found.mount_from_camera),
            anchor_from_target: None,
            covariance: PoseCovariance {
                mount_from_camera: found.covariance.as_ref().map(rows),
                anchor_from_target: None,
            },
        },
        in_sample: residual(Some(found.rms_m)),
        held_out: residual(held_out_m),
        touch_rms_mm: Some(found.rms_m * 1e3),
        held_out_mm: held_out_m.map(|m| m * 1e3),
        predicted_tre_mm,
        note: None,
    }
}

fn point_volume(
    session: &Session,
    touches: &[TouchPairs],
    x: &Pose<Mount, Camera>,
) -> Option<Volume> {
    match &session.workspace {
        Some(w) => Some(workspace_volume(session.setup, w, x)),
        None => touch_pairs::touched_volume(touches)
            .map(|v| Volume { name: "the box around the points".into(), ..v }),
    }
}

/// Spread across a line of points, over the spread along it, below which the user is warned.
const NEARLY_COLLINEAR: f64 = 0.22;

fn nearly_collinear(touches: &[TouchPairs]) -> Option<TouchFinding> {
    let points: Vec<Vector3<f64>> = touches.iter().map(|t| t.pairs[0].in_camera.vector()).collect();
    let mean = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let scatter: Matrix3<f64> = points.iter().map(|p| (p - mean) * (p - mean).transpose()).sum();
    let mut s: Vec<f64> =
        scatter.symmetric_eigen().eigenvalues.iter().map(|e| e.max(0.0).sqrt()).collect();
    s.sort_by(|a, b| b.total_cmp(a));
    let ratio = s[1] / s[0];
    (ratio < NEARLY_COLLINEAR).then_some(TouchFinding::NearlyCollinear { ratio })
}
