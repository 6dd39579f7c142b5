//! Why captures do not belong, in words, and what would make them: offered, never done.
//!
//! An explanation restores a capture when its squared Mahalanobis distance under it, against a fit
//! that was made without the capture, is one that noise reaches, `d² < 16.8`, or
//! its misfit is as small as that of the captures that agree. It is named only
//! where no other one does.

use nalgebra::{Rotation3, Vector2, Vector3};

use super::doubt;
use crate::{
    Pose, Target, TargetModel,
    calibrate::{
        notes::Notes,
        result::CaptureResult,
        views::{Captures, FARTHEST},
    },
    estimate::JointFit,
    findings::{
        CaptureFinding,
        captures::{Cause, Other, Stands},
    },
    math::{lie, linalg::median},
    solve::{View, consensus::Consensus},
};

/// Squared distance that six axes of noise reach once in a hundred times.
const RESTORED: f64 = 16.8;
/// Times the typical misfit that still is a sign of an exchange, where the other half of it fits.
const NEARLY: f64 = 3.0;
/// Loops more open than this are not restored, whatever the noise: rad and m. Spares the test.
const BELIEVABLE: (f64, f64) = (0.2, 0.1);
/// Up to this share of captures that disagree, each is explained; beyond it, a chance fit to
/// another capture explains nothing.
const MOST_EXPLAINED: f64 = 0.5;
/// More captures than this are named in one sentence.
const MOST_WARNINGS: usize = 8;

/// What happened to a capture.
enum Reason {
    /// The board was read turned by so many degrees, about its middle or about a point of it (m).
    Turned(u32, Option<Vector2<f64>>),
    /// Its picture and that of the other one were exchanged.
    Exchanged(usize),
    /// Its picture fits the robot pose of the other one.
    Elsewhere(usize),
    /// It has the robot pose at which the other picture was taken.
    Stale(usize),
}

/// Captures that do not agree.
pub(super) struct Rejected {
    /// All captures of the session, those that do not agree with the reason.
    pub captures: Vec<CaptureResult>,
    /// Names of those that do not.
    pub names: Vec<String>,
    pub notes: Notes,
}

/// Names every capture that does not agree, with the likeliest reason.
pub(super) fn name(
    captures: &Captures,
    found: &Consensus,
    fit: Option<&JointFit>,
    mut reported: Vec<CaptureResult>,
) -> Rejected {
    let n = captures.readings.len();
    let wrong: Vec<usize> = (0..n)
        .filter(|&i| !found.agrees[i] && !captures.readings[i].camera_from_target.is_empty())
        .collect();
    let few = wrong.len() as f64 <= MOST_EXPLAINED * n as f64;
    let test = fit.filter(|_| few).map(|fit| {
        let typical = typical(captures, found);
        let mut test = Test { captures, found, fit, typical, half_turn: None };
        test.half_turn = test.common_half_turn(&wrong);
        test
    });
    let (mut names, mut notes) = (vec![], Notes::default());
    for &i in &wrong {
        let known = test.as_ref().and_then(|t| t.reason(i));
        let cause =
            known.map_or_else(|| disagreement(captures, found, i), |r| cause(captures, i, &r));
        reported[i].used = false;
        reported[i].reason = Some(cause.in_words());
        let capture = captures.session.observations[i].capture.clone();
        names.push(capture.clone());
        if wrong.len() <= MOST_WARNINGS || !matches!(cause, Cause::Disagrees { .. }) {
            notes.note(CaptureFinding::Rejected { capture, cause });
        }
    }
    if wrong.len() > MOST_WARNINGS {
        notes.note(CaptureFinding::ManyRejected { captures: names.clone(), of: n });
    }
    notes.add(doubt::doubt(captures, found, &wrong));
    Rejected { captures: reported, names, notes }
}

/// What happened to a capture.
fn cause(captures: &Captures, i: usize, reason: &Reason) -> Cause {
    let name = |j: usize| captures.session.observations[j].capture.clone();
    let other = |j: usize| Other {
        name: name(j),
        stands: match () {
            () if j == i + 1 => Stands::After,
            () if j + 1 == i => Stands::Before,
            () => Stands::Elsewhere,
        },
    };
    let seen = captures.session.read_from();
    match *reason {
        Reason::Turned(degrees, about) => Cause::TargetRotated {
            degrees,
            about_mm: about.map(|m| (m * 1e3).into()),
            has_corners: captures.session.target.is_some(),
        },
        Reason::Exchanged(j) => Cause::Exchanged { seen, with: name(j) },
        Reason::Elsewhere(j) => Cause::FitsPoseOf { seen, other: other(j) },
        Reason::Stale(j) => Cause::HasPoseOf { seen, other: other(j) },
    }
}

fn disagreement(captures: &Captures, found: &Consensus, i: usize) -> Cause {
    let (angle, distance) = found.hand_eye.loop_misfit(&captures.pair(i, found.reading[i]));
    let reach = captures.session.observations[i].base_from_flange.translation().norm();
    Cause::Disagrees {
        distance_mm: distance * 1e3,
        angle_deg: angle.to_degrees(),
        out_of_reach_m: (reach > FARTHEST).then_some(reach),
    }
}

/// Explanations are tested against the fit of the captures that agree.
struct Test<'a> {
    captures: &'a Captures<'a>,
    found: &'a Consensus,
    fit: &'a JointFit,
    /// Misfit of a capture that is as good as those that agree, rad and m.
    typical: (f64, f64),
    /// The half turn of the board that restores most captures whose target poses came from
    /// elsewhere: nobody knows where on the board their origin is.
    half_turn: Option<Pose<Target, Target>>,
}

/// Three times the median misfit of those that agree: real noise has heavier tails than the
/// Gaussian that `d²` is made for.
fn typical(captures: &Captures, found: &Consensus) -> (f64, f64) {
    let used = (0..found.agrees.len()).filter(|&i| found.agrees[i]);
    let misfit = |i| found.hand_eye.loop_misfit(&captures.pair(i, found.reading[i]));
    let (angles, distances): (Vec<f64>, Vec<f64>) = used.map(misfit).unzip();
    (3.0 * median(angles).max(1e-3), 3.0 * median(distances).max(5e-4))
}

impl Test<'_> {
    /// `None` where nothing known restores the capture.
    fn reason(&self, i: usize) -> Option<Reason> {
        let turned = self.turned(i);
        let mut elsewhere: Vec<usize> = self.others(i).filter(|&j| self.fits(i, j)).collect();
        // the robot pose of two captures is one explanation; neighbours are likelier
        elsewhere.sort_by_key(|&j| (!self.fits(j, i), j.abs_diff(i) != 1, j));
        if let Some(&first) = elsewhere.first() {
            elsewhere.retain(|&j| j == first || !self.same_robot(j, first));
        }
        if turned.is_none()
            && let Some(j) = self.partner(i)
        {
            return Some(Reason::Exchanged(j));
        }
        match (turned, elsewhere.as_slice()) {
            (Some((degrees, about)), []) => Some(Reason::Turned(degrees, about)),
            (None, &[j]) => Some(Reason::Elsewhere(j)),
            (None, []) => self.whose_robot_pose(i).map(Reason::Stale),
            _ => None,
        }
    }

    fn others(&self, i: usize) -> impl Iterator<Item = usize> + use<> {
        (0..self.captures.readings.len()).filter(move |&j| j != i)
    }

    /// Whether picture `i` fits the robot pose of capture `j`.
    fn fits(&self, i: usize, j: usize) -> bool {
        let readings = self.captures.readings;
        (0..readings[i].camera_from_target.len()).any(|k| {
            let mut view = self.captures.view(i, k);
            view.pair.anchor_from_mount = readings[j].anchor_from_mount;
            self.restored(&view)
        })
    }

    /// The capture outside with which `i` looks exchanged: one picture fits the other's robot pose,
    /// and the other one nearly.
    fn partner(&self, i: usize) -> Option<usize> {
        let outside = self.others(i).filter(|&j| !self.found.agrees[j]);
        let exchanged = |&j: &usize| {
            self.fits(i, j) && self.nearly_fits(j, i) || self.nearly_fits(i, j) && self.fits(j, i)
        };
        outside.filter(exchanged).min_by_key(|&j| (j.abs_diff(i), j))
    }

    /// Whether picture `i` is at the robot pose of capture `j` but for a misfit that a worse one of
    /// those that agree might have.
    fn nearly_fits(&self, i: usize, j: usize) -> bool {
        let readings = self.captures.readings;
        (0..readings[i].camera_from_target.len()).any(|k| {
            let mut pair = self.captures.view(i, k).pair;
            pair.anchor_from_mount = readings[j].anchor_from_mount;
            let (angle, distance) = self.fit.hand_eye.loop_misfit(&pair);
            angle < BELIEVABLE.0.min(NEARLY * self.typical.0)
                && distance < BELIEVABLE.1.min(NEARLY * self.typical.1)
        })
    }

    fn restored(&self, view: &View) -> bool {
        let (angle, distance) = self.fit.hand_eye.loop_misfit(&view.pair);
        angle < BELIEVABLE.0
            && distance < BELIEVABLE.1
            && (angle < self.typical.0 && distance < self.typical.1
                || self
                    .fit
                    .surprise(view, self.captures.session.setup)
                    .is_some_and(|d2| d2 < RESTORED))
    }

    /// By how many degrees the board must be turned, if one turn restores the capture, and about
    /// which point where that is not the middle of its corners.
    fn turned(&self, i: usize) -> Option<(u32, Option<Vector2<f64>>)> {
        self.turned_about_centre(i).map(|degrees| (degrees, None)).or_else(|| {
            let turn =
                self.half_turn.filter(|turn| self.is_bare(i) && self.fits_turned(i, turn))?;
            // the point that stays where it is, in the target's own frame
            let corner = self.captures.target_from_corner.translation().xy();
            Some((180, Some(0.5 * turn.translation().xy() + corner)))
        })
    }

    fn turned_about_centre(&self, i: usize) -> Option<u32> {
        let target = self.captures.session.target.as_ref()?;
        let corner = self.captures.target_from_corner;
        let fits = |degrees: &u32| {
            self.fits_turned(i, &(corner.inverse() * turn_about_centre(target, *degrees) * corner))
        };
        let (columns, rows) = target.grid();
        let turns: &[u32] = if columns == rows { &[180, 90, 270] } else { &[180] };
        turns.iter().copied().find(fits)
    }

    fn fits_turned(&self, i: usize, turn: &Pose<Target, Target>) -> bool {
        let carry = lie::adjoint(turn.inverse().iso());
        (0..self.captures.readings[i].camera_from_target.len()).any(|k| {
            let mut view = self.captures.view(i, k);
            view.pair.camera_from_target = view.pair.camera_from_target * *turn;
            view.covariance = view.covariance.map(|c| carry * c * carry.transpose());
            self.restored(&view)
        })
    }

    /// Whether the target poses of a capture came from elsewhere.
    fn is_bare(&self, i: usize) -> bool {
        let o = &self.captures.session.observations[i];
        o.corners.is_empty() && o.surface.is_empty()
    }

    /// A half turn in the board's plane, about a point that is the same for all: each capture
    /// outside proposes its own, and the one that restores most is taken.
    fn common_half_turn(&self, wrong: &[usize]) -> Option<Pose<Target, Target>> {
        let bare: Vec<usize> = wrong.iter().copied().filter(|&i| self.is_bare(i)).collect();
        let restores = |turn: &Pose<Target, Target>| {
            bare.iter().filter(|&&i| self.fits_turned(i, turn)).count()
        };
        bare.iter()
            .filter_map(|&i| self.half_turn_of(i))
            .map(|turn| (restores(&turn), turn))
            .filter(|(count, _)| *count > 0)
            .reduce(|best, next| if next.0 > best.0 { next } else { best })
            .map(|(_, turn)| turn)
    }

    /// The half turn in the board's plane that lies nearest to a capture's misfit. It may be about
    /// any point that the camera could have in view.
    fn half_turn_of(&self, i: usize) -> Option<Pose<Target, Target>> {
        (0..self.captures.readings[i].camera_from_target.len()).find_map(|k| {
            let pair = self.captures.pair(i, k);
            let misfit = self.fit.hand_eye.loop_error(&pair);
            let t = misfit.translation();
            let turn = Pose::from_parts(half_turn().matrix(), Vector3::new(t.x, t.y, 0.0));
            let in_view = t.norm() < 2.0 * pair.camera_from_target.translation().norm();
            (in_view && misfit.angle_to(&turn) < BELIEVABLE.0).then_some(turn)
        })
    }

    /// The capture whose picture fits the robot pose of `i`: the one before rather than another.
    fn whose_robot_pose(&self, i: usize) -> Option<usize> {
        let taken = |&j: &usize| self.fits(j, i);
        self.others(i).filter(taken).min_by_key(|&j| (j + 1 != i, j.abs_diff(i), j))
    }

    fn same_robot(&self, i: usize, j: usize) -> bool {
        let readings = self.captures.readings;
        let (a, b) = (&readings[i].anchor_from_mount, &readings[j].anchor_from_mount);
        a.angle_to(b) < SAME_ROBOT.0 && a.distance_to(b) < SAME_ROBOT.1
    }
}

/// Robot poses this close are one place: a robot that holds still reports it so. rad and m.
const SAME_ROBOT: (f64, f64) = (1e-4, 1e-4);

fn half_turn() -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI)
}

/// The target turned in its plane about the middle of its corners: `target_from_turned`.
fn turn_about_centre(target: &TargetModel, degrees: u32) -> Pose<Target, Target> {
    let corners = target.corners();
    let centre = corners.iter().map(crate::Point::vector).sum::<Vector3<f64>>()
        / corners.len().max(1) as f64;
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), f64::from(degrees).to_radians());
    Pose::from_parts(turn.matrix(), centre - turn * centre)
}
