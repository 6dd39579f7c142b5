//! Captures of a ball: one point in the camera each, and nothing of its rotation.
//!
//! The target's frame of a ball is at its centre and has the axes of the anchor.

use nalgebra::{Matrix6, SMatrix, Vector3, Vector6};

use crate::{
    Camera, Mount, Observation, Pose, PosePair,
    calibrate::{
        captures::movement::{self, Recorded, Row},
        flow::{
            evidence::{Choice, Evidence, RestsOn},
            limits::FEW,
            notes::Notes,
            unknown::Task,
            verdict,
            views::camera_in_words,
        },
        prediction::workpiece::workspace_volume,
        result::{Answer, BudgetEntry, Candidate, CaptureResult, PoseCovariance, rows},
    },
    estimate::{
        evaluate::{self, RmsResidual},
        predict::{self, PredictedTre, Volume},
        touch_pairs,
    },
    findings::{CaptureFinding, TouchFinding},
    math::linalg::median,
    mistakes,
    model::session::Session,
    solve::{
        self,
        points::{self, PointFit, PointView},
    },
};

/// Name of the method.
const METHOD: &str = "ball-least-squares";

/// What the centres of a ball say.
pub(crate) fn from_balls(session: &Session, task: &Task) -> Evidence {
    let seen: Vec<usize> =
        (0..session.observations.len()).filter(|&i| view(session, i).is_some()).collect();
    let views: Vec<PointView> = seen.iter().filter_map(|&i| view(session, i)).collect();
    let mut all = Evidence::of_captures(session, task.unknown.open());
    for (i, capture) in all.captures.iter_mut().enumerate() {
        capture.used = seen.contains(&i);
        capture.reason = (!capture.used).then(|| "no ball was found in its scan".to_owned());
    }
    let touched = (!session.touches.is_empty()).then_some(TouchFinding::OfABall);
    let method = task.config.method.map(solve::Method::name);
    let named = method.map(|method| CaptureFinding::MethodNotForBalls { method });
    all.notes = Notes::of(touched).then(Notes::of(named));
    match points::fit_points(&views) {
        Ok(fit) => {
            let found = conclude(session, &seen, &views, &fit, all);
            match movement::suspected_in(&recorded(session, (&seen, &views), &fit)) {
                Some(moved) => movement::covered(moved, found),
                None => found,
            }
        }
        Err(error) => {
            all.notes.add(Notes::undetermined(error, camera_in_words(session.setup)));
            all
        }
    }
}

/// One capture with its ball's centre.
fn view(session: &Session, i: usize) -> Option<PointView> {
    let o: &Observation = &session.observations[i];
    let ball = o.surface.first()?;
    Some(PointView {
        anchor_from_mount: session.setup.anchor_from_mount(o.base_from_flange),
        in_camera: ball.in_camera,
        covariance: ball.covariance,
    })
}

/// The captures in their order. The target's frame has the axes of the anchor: its rotation is held.
fn recorded<'a>(
    session: &'a Session,
    (seen, views): (&[usize], &[PointView]),
    fit: &PointFit,
) -> Recorded<'a> {
    let of = |i: usize| seen.iter().position(|k| *k == i);
    let count = session.observations.len();
    Recorded {
        names: session.observations.iter().map(|o| o.capture.as_str()).collect(),
        poses: session
            .observations
            .iter()
            .map(|o| session.setup.anchor_from_mount(o.base_from_flange))
            .collect(),
        agrees: (0..count).map(|i| of(i).is_some_and(|k| fit.agrees[k])).collect(),
        rows: (0..count).map(|i| row(&views[of(i)?], fit)).collect(),
        equations: 3,
        degrees_of_freedom: fit.degrees_of_freedom,
    }
}

/// One capture as a pose whose rotation misses nothing and holds that of the target.
fn row(view: &PointView, fit: &PointFit) -> Option<Row> {
    let (e, j, noise) = points::equations_of(view, fit);
    let root = noise.cholesky()?.l();
    let (e, j) = (root.solve_lower_triangular(&e)?, root.solve_lower_triangular(&j)?);
    let mut residual = Vector6::zeros();
    residual.fixed_rows_mut::<3>(3).copy_from(&e);
    let mut jacobian = SMatrix::<f64, 6, 12>::zeros();
    jacobian.fixed_view_mut::<3, 3>(0, 6).fill_with_identity();
    jacobian.fixed_view_mut::<3, 6>(3, 0).copy_from(&j.fixed_columns::<6>(0));
    jacobian.fixed_view_mut::<3, 3>(3, 9).copy_from(&j.fixed_columns::<3>(6));
    Some(Row { residual, jacobian, seen: view.in_camera.vector() })
}

fn conclude(
    session: &Session,
    seen: &[usize],
    views: &[PointView],
    fit: &PointFit,
    all: Evidence,
) -> Evidence {
    let missed = points::held_out(views, fit);
    let (captures, rejected) = with_residuals(seen, (views, fit), &missed, all.captures);
    let pairs: Vec<PosePair> =
        views.iter().zip(&fit.agrees).filter(|(_, a)| **a).map(|(v, _)| pair(v, fit)).collect();
    let used = pairs.len();
    let few = (used < FEW).then_some(CaptureFinding::Few { used, of_a_ball: true });
    let factor = touch_pairs::small_sample(fit.degrees_of_freedom);
    let covariance = fit.covariance * factor;
    let own: Matrix6<f64> = covariance.fixed_view::<6, 6>(0, 0).into_owned();
    let free = mistakes::free_of(&own, &fit.mount_from_camera.rotation());
    let undetermined = mistakes::in_words(&free, &pairs, session.setup);
    let nothing_left = "nothing is left to judge the noise by: take more captures";
    let unjudged = fit.degrees_of_freedom < 1.0 && undetermined.is_empty();
    let reasons = unjudged.then(|| nothing_left.to_owned()).into_iter().collect();
    let open = Notes { reasons, undetermined, rejects: unjudged, ..Notes::of(few) };
    let determined = (!free.is_empty()).then(|| verdict::determined(&fit.mount_from_camera, &free));
    let volume = volume(session, views, &fit.mount_from_camera);
    let tre =
        volume.filter(|_| factor.is_finite()).map(|v| predict::tre(&v, &own, |_| Vector3::zeros()));
    let mut of_target = Matrix6::zeros();
    of_target.fixed_view_mut::<3, 3>(3, 3).copy_from(&covariance.fixed_view::<3, 3>(6, 6));
    let answer = Answer {
        mount_from_camera: Some(fit.mount_from_camera),
        anchor_from_target: Some(Pose::from_parts(
            &nalgebra::Matrix3::identity(),
            fit.in_anchor.vector(),
        )),
        covariance: PoseCovariance {
            mount_from_camera: Some(rows(&own)),
            anchor_from_target: Some(rows(&of_target)),
        },
    };
    let (choice, candidate) = chosen(answer, (fit, &missed), tre);
    Evidence {
        notes: all.notes.then(open),
        captures,
        rejected,
        diversity: Some(evaluate::diversity(&pairs)),
        determined,
        choice: Some(choice),
        candidates: vec![candidate],
        error_budget: budget(fit, views),
        ..Evidence::default()
    }
}

/// The answer, which is the only candidate.
fn chosen(
    hand_eye: Answer,
    (fit, missed): (&PointFit, &[Option<f64>]),
    tre: Option<PredictedTre>,
) -> (Choice, Candidate) {
    let agreeing = fit.residuals_m.iter().zip(&fit.agrees).filter(|(_, a)| **a).map(|(m, _)| *m);
    let in_sample = residual(agreeing);
    let held_out = residual(missed.iter().flatten().copied());
    let candidate = Candidate {
        name: METHOD.into(),
        hand_eye,
        in_sample,
        held_out,
        touch_rms_mm: None,
        held_out_mm: held_out.translation_rms_mm,
        predicted_tre_mm: tre.as_ref().map(|t| t.rms),
        note: None,
    };
    let choice = Choice {
        name: Some(METHOD.into()),
        rests_on: RestsOn::Views,
        why: "centres of a ball have one answer: the camera that puts them all at one place".into(),
        hand_eye,
        predicted_tre_mm: tre,
        residual: in_sample,
        held_out,
        seen: None,
    };
    (choice, candidate)
}

fn residual(values: impl Iterator<Item = f64>) -> RmsResidual {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, n), v| (sum + v * v, n + 1.0));
    let rms = (count > 0.0).then(|| (sum / count).sqrt() * 1e3);
    RmsResidual { translation_rms_mm: rms, ..RmsResidual::default() }
}

fn budget(fit: &PointFit, views: &[PointView]) -> Vec<BudgetEntry> {
    let per_axis = |v: &PointView| (v.covariance.trace() / 3.0).sqrt() * 1e3;
    let scan = median(views.iter().map(per_axis));
    let one = |source: &str, mm: f64| BudgetEntry {
        source: source.into(),
        sigma: format!("{mm:.3} mm"),
        sigma_mm: Some(mm),
        sigma_deg: None,
        sigma_uncertainty: None,
        at_workpiece_mm: None,
    };
    vec![
        one("robot, at the ball", fit.robot_sigma_m * 1e3),
        one("centre of the ball in a scan", scan),
    ]
}

/// The capture as a pose, the ball's axes being those of the anchor.
fn pair(v: &PointView, fit: &PointFit) -> PosePair {
    let turn = v.anchor_from_mount.rotation() * fit.mount_from_camera.rotation();
    let camera_from_target = Pose::from_parts(&turn.transpose(), v.in_camera.vector());
    PosePair { anchor_from_mount: v.anchor_from_mount, camera_from_target }
}

/// The captures with their residuals, and the names of those that do not agree.
fn with_residuals(
    seen: &[usize],
    (views, fit): (&[PointView], &PointFit),
    missed: &[Option<f64>],
    mut captures: Vec<CaptureResult>,
) -> (Vec<CaptureResult>, Vec<String>) {
    let mut rejected = vec![];
    for (k, &i) in seen.iter().enumerate() {
        let capture = &mut captures[i];
        capture.camera_from_target = Some(pair(&views[k], fit).camera_from_target);
        capture.residual_mm = Some(fit.residuals_m[k] * 1e3);
        capture.held_out_mm = missed[k].map(|m| m * 1e3);
        capture.used = fit.agrees[k];
        if !capture.used {
            let mm = fit.residuals_m[k] * 1e3;
            capture.reason = Some(format!("its ball is {mm:.1} mm from where the others put it"));
            rejected.push(capture.id.clone());
        }
    }
    (captures, rejected)
}

fn volume(session: &Session, views: &[PointView], x: &Pose<Mount, Camera>) -> Option<Volume> {
    match &session.workspace {
        Some(w) => Some(workspace_volume(session.setup, w, x)),
        None => {
            let centres = views.iter().map(|v| v.in_camera.vector());
            Volume::around(centres, "the box in which the camera saw the ball")
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use nalgebra::{Matrix3, Rotation3};

    use super::*;
    use crate::{
        Calibration, Config, Point, Setup, SurfaceCorner, TargetModel, Verdict, calibrate,
        math::random::Random,
    };

    const COUNT: usize = 64;
    /// Scatter of the robot's positions, m.
    const ROBOT: f64 = 2e-4;

    /// Captures of a block.
    const BLOCK: std::ops::Range<usize> = 20..28;

    /// A ball seen from many places, the robot displaced by `off` (m) in a block of captures, all of them from places
    /// `apart` (rad, per axis).
    fn session(seed: u64, off: f64, apart: f64) -> Session {
        let mut random = Random::new(seed);
        let x: Pose<Mount, Camera> =
            Pose::identity().retract(&Vector6::new(1.9, -0.8, 1.1, 0.06, -0.03, 0.05));
        let ball = Vector3::new(0.55, 0.05, 0.02);
        let mut one = |k: usize| {
            let (inside, c) = (BLOCK.contains(&k), random.normal3());
            let (c, turn) = match inside {
                true => (c * (0.16 * apart), Vector3::x() + random.normal3() * apart),
                false => (c * 0.08, random.normal3() * 0.5),
            };
            let c = c + Vector3::new(0.0, 0.0, 0.6);
            let rotation = *Rotation3::new(turn).matrix();
            let off = if inside { off } else { 0.0 };
            let at = ball - rotation * (x * Point::<Camera>::from_vector(c)).vector();
            let at = at + random.normal3() * ROBOT + Vector3::x() * off;
            let surface = vec![SurfaceCorner {
                id: 0,
                in_camera: Point::from_vector(c + random.normal3() * 1e-4),
                covariance: Matrix3::identity() * 1e-8,
            }];
            let pose = Pose::from_parts(&rotation, at);
            let bare = Observation::bare(format!("{k:02}"), pose, Pose::identity());
            Observation { surface, candidates: vec![], ..bare }
        };
        let observations = (0..COUNT).map(&mut one).collect();
        let target = Some(TargetModel::Sphere { diameter_mm: Some(40.0) });
        Session { target, ..Session::of_captures(Setup::EyeInHand, observations) }
    }

    fn codes(found: &Calibration) -> Vec<&str> {
        found.warnings.iter().map(|w| w.code.as_str()).collect()
    }

    #[test]
    fn a_ball_that_stands_still_is_not_said_to_move() {
        for seed in 0..8 {
            let session = session(seed, 0.0, 0.5);
            let found = calibrate(&session, &Config::default()).unwrap();
            assert!(codes(&found).is_empty(), "seed {seed}: {:?}", codes(&found));
            assert_eq!(found.verdict, Verdict::Accepted);
        }
    }

    #[test]
    fn captures_of_a_ball_that_repeat_one_another_count_once() {
        let once = session(3, 0.0, 0.5);
        let mut twice = once.clone();
        twice.observations.extend(once.observations.iter().map(|o| {
            let capture = format!("{} again", o.capture);
            Observation { capture, ..o.clone() }
        }));
        let [once, twice] = [once, twice].map(|s| calibrate(&s, &Config::default()).unwrap());
        assert_eq!(once.hand_eye, twice.hand_eye);
        assert_eq!(codes(&twice), ["captures-repeated"]);
    }

    #[test]
    fn captures_of_a_ball_that_are_rejected_together_are_named() {
        for seed in 0..4 {
            let found = calibrate(&session(seed, 3e-3, 0.5), &Config::default()).unwrap();
            assert!(codes(&found).contains(&"captures-displaced"), "{:?}", codes(&found));
            let moved = found.movement.as_ref().unwrap();
            assert_eq!((moved.first.as_str(), moved.last.as_str()), ("20", "27"));
            assert!((2.0..4.0).contains(&moved.displacement_mm), "{}", moved.displacement_mm);
            assert_eq!(found.rejected.len(), BLOCK.len());
            // from everywhere, displaced in the base alike: the ball moved, and the camera's pose does not depend on it
            assert!(moved.target && !moved.camera && moved.widened_mm == 0.0, "{moved:?}");
        }
    }

    #[test]
    fn where_the_robot_may_err_at_a_place_the_stated_error_covers_it() {
        for seed in 0..4 {
            let found = calibrate(&session(seed, 3e-3, 0.02), &Config::default()).unwrap();
            let moved = found.movement.as_ref().unwrap();
            assert!(moved.at_a_place, "{moved:?}");
            let stated = found.predicted_tre_mm.as_ref().unwrap();
            assert!(stated.p95 > 3.0, "{}", stated.p95);
        }
    }

    #[test]
    fn a_camera_that_slips_while_it_looks_at_a_ball_is_named() {
        for seed in 0..4 {
            let mut session = session(seed, 0.0, 0.5);
            for (k, o) in session.observations.iter_mut().enumerate() {
                let along = o.base_from_flange.rotation() * Vector3::x();
                let slip = along * (2e-3 * k as f64 / COUNT as f64);
                let at = o.base_from_flange.translation() + slip;
                o.base_from_flange = Pose::from_parts(&o.base_from_flange.rotation(), at);
            }
            let found = calibrate(&session, &Config::default()).unwrap();
            assert!(codes(&found).contains(&"moved-during-session"), "{:?}", codes(&found));
            assert!(found.movement.as_ref().unwrap().camera);
        }
    }
}
