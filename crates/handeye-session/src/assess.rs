//! What the captures in a session's folder are worth, by the functions that `handeye calibrate` and `handeye plan` use: the
//! folder is read, measured (each file once) and calibrated, and the next view is planned.

use handeye::{
    Base, Calibration, Camera, Config, Flange, HandEye, ImageCorner, Intrinsics, Observation, Pose,
    Session, Setup, Target, Verdict,
    calibrate::result::JudgedFinding,
    findings::severity::Severity,
    nalgebra::Vector2,
    tools::{
        held_out::{self, HeldOutTest},
        plan::{NextView, TouchNoise},
        verify::{self, Verification},
    },
};
use handeye_io::{
    CellSettings, Error, SessionFolder, Urdf,
    calibrate::calibrate_measured,
    measure::{self, Measurements},
    plan::{self, PlanOptions},
};

/// What the captures are worth.
#[derive(Debug, Clone)]
pub struct Assessment {
    /// The calibration of the captures; a verdict is part of it.
    pub calibration: Calibration,
    /// What was measured in each capture.
    pub measured: Vec<MeasuredCapture>,
    /// What was measured in the image of each placement.
    pub placements: Vec<MeasuredCapture>,
    /// The camera with which it was measured.
    pub camera: Option<Intrinsics>,
    /// The view to take next.
    pub next: Option<ProposedView>,
    /// Why there is none.
    pub no_next: Option<String>,
    /// Whether the captures are enough for the tolerance.
    pub enough: bool,
    /// What the verification views say of it, or why they say nothing; `None` without any.
    pub verification: Option<Result<HeldOutTest, String>>,
    /// What touches that verify say of it, or why they say nothing; `None` without any.
    pub touch_test: Option<Result<TouchTest, String>>,
}

/// Touches that a calibration was not made with.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchTest {
    /// Their names, as they stand in the folder.
    pub ids: Vec<String>,
    /// What they say.
    pub found: Verification,
    /// How likely they are as far off or farther where the calibration holds.
    pub chance: f64,
    /// RMS of their distances that was expected, mm.
    pub expected_mm: f64,
}

impl TouchTest {
    /// Whether the touches agree with the calibration.
    pub fn agrees(&self) -> bool {
        self.chance >= verify::LEAST_CHANCE
    }

    /// Root mean square of their distances, mm.
    pub fn rms_mm(&self) -> f64 {
        self.found.rms * 1e3
    }

    /// How far a touch was from where it was predicted, mm.
    pub fn distance_mm(&self, id: &str) -> Option<f64> {
        let k = self.ids.iter().position(|own| own == id)?;
        Some(self.found.differences[k].difference.norm() * 1e3)
    }
}

/// The code of a last capture that does not agree with the others.
const LAST_CAPTURE_DISPLACED: &str = "last-capture-displaced";

/// What was measured in the files of a folder.
#[derive(Default)]
pub struct Measured {
    captures: Measurements,
    verification: Measurements,
}

/// What was measured in a capture.
#[derive(Debug, Clone)]
pub struct MeasuredCapture {
    /// Its name.
    pub id: String,
    /// Its corners.
    pub corners: Vec<ImageCorner>,
    /// Found minus predicted by the calibration, px; none where it is not known.
    pub residuals: Vec<Vector2<f64>>,
}

/// A view to take, and how it looks.
#[derive(Debug, Clone, PartialEq)]
pub struct ProposedView {
    /// Where the robot is to go.
    pub base_from_flange: Pose<Base, Flange>,
    /// Its joint values there, where the arm is known.
    pub joints: Option<Vec<f64>>,
    /// Where the target is to be seen.
    pub camera_from_target: Pose<Camera, Target>,
    /// Where its corners are to be seen, px.
    pub corners: Vec<Vector2<f64>>,
    /// How it looks, and what it brings.
    pub reason: String,
    /// The expected error (95 %) before it, mm.
    pub before_mm: Option<f64>,
    /// And after it.
    pub after_mm: Option<f64>,
}

/// What the next view is to be like.
#[derive(Debug, Clone, Copy, Default)]
pub struct NextWanted<'a> {
    /// Poses that nobody goes to (again).
    pub not_near: &'a [Pose<Base, Flange>],
    /// Whether one is wanted although the captures are enough, as one that verifies them.
    pub goes_on: bool,
    /// The joint values of now (rad, m): it is one then that the arm of the folder's model reaches. Without them it is near
    /// poses that were reached.
    pub joints: Option<&'a [f64]>,
}

/// Assesses a folder with captures.
///
/// # Errors
/// A folder that cannot be read.
pub fn assess(
    folder: &SessionFolder,
    before: &mut Measured,
    NextWanted { not_near, goes_on, joints }: NextWanted,
) -> Result<Assessment, Error> {
    let dataset = folder.dataset()?;
    let measured = measure::measure_again(&dataset, &mut before.captures, &|_, _| {})?;
    let calibration = calibrate_measured(&dataset, &measured, &Config::default())?;
    let session = &measured.session;
    let plan = |tolerance_mm| {
        let failed = not_near.to_vec();
        let now = joints.zip(folder.urdf()).map(|(values, urdf)| joint_numbers(values, urdf));
        let without_arm = now.is_none();
        let options = PlanOptions {
            count: 1,
            tolerance_mm,
            failed,
            now,
            without_arm,
            ..PlanOptions::default()
        };
        match plan::plan_after(&dataset, calibration.clone(), session, &options) {
            Ok(plan) => (plan.route.views.into_iter().next(), plan.route.stopped, plan.enough),
            Err(error) => (None, Some(error.without_place()), false),
        }
    };
    let (mut next, mut no_next, enough) = plan(Some(folder.settings().tolerance_mm));
    if goes_on && next.is_none() {
        (next, no_next, _) = plan(None);
    }
    let Verified { views: verification, touches: touch_test, placements: placed } =
        verified(folder, (&calibration, session), &mut before.verification);
    let next = next.map(|view| ProposedView::planned(&view, session));
    let camera = session.camera;
    let placements = measured_placements(session).into_iter().chain(placed).collect();
    let measured = measured_captures(session, &calibration);
    Ok(Assessment {
        calibration,
        measured,
        placements,
        camera,
        next,
        no_next,
        enough,
        verification,
        touch_test,
    })
}

/// Joint values (rad, m) in degrees, and millimetres of prismatic joints.
pub fn joint_numbers(values: &[f64], urdf: &Urdf) -> Vec<f64> {
    let number = |(value, is_prismatic): (&f64, bool)| match is_prismatic {
        true => value * 1e3,
        false => value.to_degrees(),
    };
    values.iter().zip(urdf.prismatic()).map(number).collect()
}

/// What views and touches that verify say of the captures' calibration, or why they say nothing.
#[derive(Default)]
struct Verified {
    views: Option<Result<HeldOutTest, String>>,
    touches: Option<Result<TouchTest, String>>,
    /// In images of boards that were touched for it.
    placements: Vec<MeasuredCapture>,
}

fn verified(
    folder: &SessionFolder,
    (calibration, session): (&Calibration, &Session),
    before: &mut Measurements,
) -> Verified {
    let has_views = !folder.verification().is_empty();
    let ids: Vec<String> =
        folder.touches().into_iter().filter(|t| t.verifies).map(|t| t.id.clone()).collect();
    if !has_views && ids.is_empty() {
        return Verified::default();
    }
    let measured = folder
        .verification_dataset(session.camera)
        .and_then(|dataset| measure::measure_again(&dataset, before, &|_, _| {}));
    let seen = match measured {
        Ok(measured) => measured.session,
        Err(e) => {
            let why = e.to_string();
            let touches = (!ids.is_empty()).then(|| Err(why.clone()));
            return Verified { views: has_views.then_some(Err(why)), touches, placements: vec![] };
        }
    };
    let views = has_views.then(|| {
        held_out::test(calibration, session, &seen.observations).ok_or_else(|| {
            "the captures determine no transform, too few of them are used, or the views show no board".to_owned()
        })
    });
    let touches = (!ids.is_empty())
        .then(|| touch_test(ids, (calibration, session), &seen, folder.settings()));
    Verified { views, touches, placements: measured_placements(&seen) }
}

/// Without views of their own, touches of the captures' board are tested against where the captures show it.
fn touch_test(
    ids: Vec<String>,
    (calibration, session): (&Calibration, &Session),
    seen: &Session,
    settings: &CellSettings,
) -> Result<TouchTest, String> {
    let none = || "the captures determine no transform".to_owned();
    let mut test =
        verify::of_calibration(calibration, TouchNoise::default().touch_m).ok_or_else(none)?;
    let mut seen = seen.clone();
    if settings.setup == Setup::EyeInHand && seen.observations.is_empty() {
        let is_used =
            |o: &&Observation| calibration.captures.iter().any(|c| c.used && c.id == o.capture);
        seen.observations = session.observations.iter().filter(is_used).cloned().collect();
    }
    verify::add_boards(&mut test, calibration, &seen);
    let found = verify::verify(&test).map_err(|e| e.to_string())?;
    let chance = found.agreement.ok_or("the calibration states no covariance")?.p_value;
    let squares = found.differences.iter().filter_map(|d| d.expected).map(|m| (m * 1e3).powi(2));
    let expected_mm = (squares.sum::<f64>() / found.differences.len() as f64).sqrt();
    Ok(TouchTest { ids, found, chance, expected_mm })
}

impl Assessment {
    /// The error that the calibration states (95 %), mm; `None` where it determines none, or is wrong.
    pub fn p95_mm(&self) -> Option<f64> {
        let is_known =
            self.calibration.verdict == Verdict::Accepted || self.calibration.is_only_imprecise();
        self.calibration.predicted_tre_mm.as_ref().filter(|_| is_known).map(|error| error.p95)
    }

    /// The view of a capture, to be taken again; `None` where the target was not found in it.
    pub fn view_of(&self, id: &str) -> Option<ProposedView> {
        let capture = self.calibration.captures.iter().find(|c| c.id == id)?;
        let measured = self.measured.iter().find(|m| m.id == id)?;
        Some(ProposedView {
            base_from_flange: capture.base_from_flange,
            joints: None,
            camera_from_target: capture.camera_from_target?,
            corners: measured.corners.iter().map(|c| c.pixel).collect(),
            reason: format!("as capture {id} was taken"),
            before_mm: None,
            after_mm: None,
        })
    }

    /// How far corners are, at most, from those of the board that the robot carries, where the answer expects it with the flange
    /// there, mm at its distance; `None` where none is expected in the image.
    pub fn off_carried_board(
        &self,
        base_from_flange: &Pose<Base, Flange>,
        cell: &CellSettings,
        corners: &[ImageCorner],
    ) -> Option<f64> {
        let (answer, camera) = (&self.calibration.hand_eye, self.camera?);
        let hand_eye = HandEye {
            mount_from_camera: answer.mount_from_camera?,
            anchor_from_target: answer.anchor_from_target?,
        };
        let seen = hand_eye.camera_from_target(cell.setup, base_from_flange);
        let pixel = |id: u32| camera.project(&(seen * cell.target.corner(id)?).vector());
        let by_id = corners.iter().map(|c| Some((c.pixel - pixel(c.id)?).norm()));
        let by_id: Option<f64> = by_id.map(|px| px.unwrap_or(f64::INFINITY)).reduce(f64::max);
        // of a board that looks alike from two sides, ids may be those of the other side
        let all: Vec<Vector2<f64>> = (0..cell.target.len() as u32).filter_map(pixel).collect();
        let nearest = |c: &ImageCorner| {
            all.iter().map(|p| (c.pixel - p).norm()).fold(f64::INFINITY, f64::min)
        };
        let is_whole = corners.len() == all.len();
        let by_place = corners.iter().map(nearest).reduce(f64::max).filter(|_| is_whole);
        let mm_per_px = seen.translation().z * 1e3 / camera.fx;
        Some(by_id?.min(by_place.unwrap_or(f64::INFINITY)) * mm_per_px)
    }

    /// What the captures say against one another, or against what is declared of them; `None` where more captures are all
    /// that is missing.
    /// With the code of the finding that is the first to speak against the result, where there is one.
    pub fn contradiction(&self) -> Option<(&str, Option<&str>)> {
        let result = &self.calibration;
        let is_wrong = result.verdict == Verdict::Rejected && !result.is_only_imprecise();
        let why = result.reasons.first().filter(|_| is_wrong)?;
        let rejects = |f: &&JudgedFinding| f.severity == Severity::Rejects && f.code != "rejected";
        let finding = result.findings.iter().find(rejects);
        Some((why, finding.map(|finding| finding.code.as_str())))
    }

    /// Whether it is only the last capture that speaks against the others: something may have been moved before it.
    pub fn is_open_at_end(&self) -> bool {
        self.calibration.findings.iter().any(|finding| finding.code == LAST_CAPTURE_DISPLACED)
    }
}

impl ProposedView {
    fn planned(view: &NextView, session: &Session) -> Self {
        let seen = session.camera.zip(session.target.as_ref());
        let corners = seen.map_or(vec![], |(camera, target)| {
            let pixel = |c: &handeye::Point<Target>| {
                camera.project(&(view.camera_from_target * *c).vector())
            };
            target.corners().iter().filter_map(pixel).collect()
        });
        Self {
            base_from_flange: view.station.base_from_flange,
            joints: view.station.joints.clone(),
            camera_from_target: view.camera_from_target,
            corners,
            reason: view.reason(),
            before_mm: view.before.as_ref().map(|error| error.p95),
            after_mm: view.after.as_ref().map(|error| error.p95),
        }
    }
}

fn measured_captures(session: &Session, calibration: &Calibration) -> Vec<MeasuredCapture> {
    let one = |o: &handeye::Observation| {
        let result = calibration.captures.iter().find(|c| c.id == o.capture);
        let seen = result.and_then(|c| c.camera_from_target);
        let residuals = seen.map_or(vec![], |pose| residuals(session, &pose, &o.corners));
        MeasuredCapture { id: o.capture.clone(), corners: o.corners.clone(), residuals }
    };
    session.observations.iter().map(one).collect()
}

fn measured_placements(session: &Session) -> Vec<MeasuredCapture> {
    let one = |p: &handeye::Placement| MeasuredCapture {
        id: p.id.clone(),
        corners: p.corners.clone(),
        residuals: vec![],
    };
    session.placements.iter().map(one).collect()
}

fn residuals(
    session: &Session,
    camera_from_target: &Pose<Camera, Target>,
    corners: &[ImageCorner],
) -> Vec<Vector2<f64>> {
    let (Some(camera), Some(target)) = (session.camera, &session.target) else { return vec![] };
    let off = |c: &ImageCorner| {
        let there = *camera_from_target * target.corner(c.id)?;
        Some(c.pixel - camera.project(&there.vector())?)
    };
    corners.iter().map(|c| off(c).unwrap_or_else(Vector2::zeros)).collect()
}
