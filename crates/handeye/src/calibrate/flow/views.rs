//! Captures and views as the stages hand them on: with their readings, about the target's first corner.

use crate::{
    Camera, Observation, Pose, PosePair, Setup, Target,
    calibrate::result::CaptureResult,
    estimate::{Extra, Problem},
    model::session::Session,
    solve::{View, consensus::Readings},
};

/// What the views of a session say, once readings are chosen.
pub(crate) struct Views<'a> {
    pub session: &'a Session,
    /// Observations that are used, in order.
    pub used: Vec<&'a Observation>,
    /// The same as pose pairs about the target's first corner, so that residuals are those there.
    pub views: Vec<View>,
    /// The target frame about its first corner, seen from the target's own.
    pub target_from_corner: Pose<Target, Target>,
    /// Which observations of the session they are.
    pub indices: Vec<usize>,
}

/// What is not determined where nothing is, in words.
pub(crate) fn camera_in_words(setup: Setup) -> String {
    format!("the pose of the camera on the {}", setup.mount())
}

pub(crate) fn first_report(o: &Observation) -> CaptureResult {
    let reason = o.candidates.is_empty().then(|| "the target was not found in it".to_owned());
    CaptureResult {
        id: o.capture.clone(),
        used: reason.is_none(),
        reason,
        base_from_flange: o.base_from_flange,
        camera_from_target: o.candidates.first().map(|c| c.camera_from_target),
        corners: o.corners.len(),
        corners_3d: o.surface.len(),
        residual_px: None,
        reprojection_px: None,
        residual_mm: None,
        residual_deg: None,
        held_out_mm: None,
        held_out_deg: None,
    }
}

/// All captures of a session with their readings about the target's first corner.
pub(crate) struct Captures<'a> {
    pub session: &'a Session,
    pub readings: &'a [Readings],
    /// The target frame about its first corner, seen from the target's own.
    pub target_from_corner: Pose<Target, Target>,
}

impl Captures<'_> {
    /// One capture as the fits see it: pose and covariance moved to the target's first corner.
    pub fn view(&self, i: usize, reading: usize) -> View {
        let carry = crate::math::lie::adjoint(self.target_from_corner.inverse().iso());
        let covariance = self.session.observations[i].candidates[reading].covariance;
        View {
            pair: self.pair(i, reading),
            covariance: covariance.map(|c| carry * c * carry.transpose()),
            sight: None,
            by_robot: None,
        }
    }

    /// Every pose candidate of each capture.
    pub fn candidates(&self) -> Vec<Vec<View>> {
        let of = |i: usize| {
            let count = self.readings[i].camera_from_target.len();
            (0..count).map(|k| self.view(i, k)).collect()
        };
        (0..self.readings.len()).map(of).collect()
    }

    /// Robot pose and target pose of one capture.
    pub fn pair(&self, i: usize, reading: usize) -> PosePair {
        PosePair {
            anchor_from_mount: self.readings[i].anchor_from_mount,
            camera_from_target: self.readings[i].camera_from_target[reading],
        }
    }
}

pub(crate) fn pairs_of(views: &Views) -> Vec<PosePair> {
    views.views.iter().map(|v| v.pair).collect()
}

/// The chosen pose of a view, about the target's own origin.
pub(crate) fn own_pose(v: &View, views: &Views) -> Pose<Camera, Target> {
    v.pair.camera_from_target * views.target_from_corner.inverse()
}

/// Views alone.
pub(crate) fn views_problem(session: &Session, views: &[View], extras: &[Extra]) -> Problem {
    Problem {
        setup: session.setup,
        views: views.to_vec(),
        boards: vec![],
        extras: extras.to_vec(),
        known_position: session.known_position,
    }
}
