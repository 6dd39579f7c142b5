//! `handeye verify`: does the robot find what the camera measures? The touch test.

use std::{fs, path::Path};

use handeye::{
    Calibration, Flange, Mount, Pose, Session, Setup, TargetPose, Verdict, Warning, calibration,
    verify::{
        self, ByPose, ChiSquare, LEAST_CHANCE, SHARE, Sighting, Test, Touched, Verification, Within,
    },
};
use handeye_io::{
    Dataset, MANIFEST, measure, read_touched_points,
    report::{TouchTest, touch_test_html},
    write_atomically,
};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use serde::Serialize;

use crate::{
    args::{Manners, VerifyArgs},
    export::read_calibration,
    failure::Failure,
    output,
    progress::Progress,
};

#[derive(Serialize)]
struct TouchResult {
    id: String,
    predicted_in_base_m: [f64; 3],
    difference_mm: [f64; 3],
    distance_mm: f64,
    expected_mm: Option<f64>,
    within: Option<bool>,
}

#[derive(Serialize)]
struct OffsetResult {
    mean_mm: [f64; 3],
    sigma_mm: [f64; 3],
    test: ChiSquare,
    without: Option<ChiSquare>,
}

#[derive(Serialize)]
struct Residual {
    rms_mm: f64,
    max_mm: f64,
    p95_at_most_mm: f64,
}

#[derive(Serialize)]
struct Answer {
    verdict: Verdict,
    reasons: Vec<String>,
    name: String,
    touches: Vec<TouchResult>,
    residual: Residual,
    agreement: Option<ChiSquare>,
    offset: Option<OffsetResult>,
    tolerance_mm: Option<f64>,
    within: Option<Within>,
    confidence: f64,
    touch_sigma_mm: f64,
    warnings: Vec<Warning>,
}

pub fn run(args: &VerifyArgs, manners: &Manners) -> Result<u8, Failure> {
    for (name, value) in [
        ("tolerance-mm", args.tolerance_mm.unwrap_or(1.0)),
        ("touch-noise-mm", args.touch_noise_mm),
        ("camera-noise-mm", args.camera_noise_mm),
    ] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(Failure::Usage(format!("--{name} must be positive")));
        }
    }
    let path = match args.calibration.is_dir() {
        true => args.calibration.join("calibration.json"),
        false => args.calibration.clone(),
    };
    let calibration = read_calibration(&path)?;
    let test = test(args, &calibration, &path, manners)?;
    let found = verify::verify(&test)?;
    let answer = answer(args, &calibration, &test, &found);
    if let Some(out) = &args.out {
        write(out, args, &answer, &found, manners)?;
    }
    if manners.json {
        output::json(&answer);
    } else {
        output::warn(&answer.warnings, manners);
        output::print(&text(&answer));
    }
    Ok(if answer.verdict == Verdict::Accepted { 0 } else { 3 })
}

/// What the robot's own error adds, as the calibration found it: rad and m, each axis.
fn robot_sigma(calibration: &Calibration) -> (f64, f64) {
    let of = |name: &str| calibration.error_budget.iter().find(|b| b.source == name);
    let rotation = of("robot rotation").and_then(|b| b.sigma_deg).unwrap_or(0.0).to_radians();
    (rotation, of("robot position").and_then(|b| b.sigma_mm).unwrap_or(0.0) * 1e-3)
}

fn test(
    args: &VerifyArgs,
    calibration: &Calibration,
    path: &Path,
    manners: &Manners,
) -> Result<Test, Failure> {
    let Some(mount_from_camera) = calibration.hand_eye.mount_from_camera else {
        let what = "holds no transform (the data did not determine it): there is nothing to test";
        return Err(Failure::input(path, what));
    };
    let (_, robot) = robot_sigma(calibration);
    let mut test = Test {
        mount_from_camera,
        covariance: calibration
            .hand_eye
            .covariance
            .mount_from_camera
            .as_ref()
            .map(calibration::matrix),
        poses: vec![],
        touch_sigma: (args.touch_noise_mm * 1e-3).hypot(robot),
        touches: vec![],
    };
    let is_dataset = args.touches.is_dir() || args.touches.extension().is_some_and(|e| e == "toml");
    if is_dataset {
        from_dataset(&args.touches, calibration, &mut test, manners)?;
    } else {
        from_file(&args.touches, args.camera_noise_mm * 1e-3, calibration, &mut test)?;
    }
    Ok(test)
}

fn from_file(
    path: &Path,
    sigma: f64,
    calibration: &Calibration,
    test: &mut Test,
) -> Result<(), Failure> {
    for point in read_touched_points(path)? {
        let base_from_mount = match (calibration.setup, point.base_from_flange) {
            (Setup::EyeToHand, _) => Pose::identity(),
            (Setup::EyeInHand, Some(flange)) => flange.rename(),
            (Setup::EyeInHand, None) => {
                let what = format!(
                    "touch {}: the camera is on the flange: say where the flange was when it \
                     measured (flange_x_mm ... flange_qw)",
                    point.id
                );
                return Err(Failure::input(path, what));
            }
        };
        let mut sighting = Sighting {
            base_from_mount,
            in_camera: point.in_camera,
            covariance: Matrix3::identity() * sigma.powi(2),
            shared: vec![],
        };
        if calibration.setup == Setup::EyeInHand {
            let flange = shared_flange(test, base_from_mount.rename(), calibration);
            let in_mount = test.mount_from_camera * point.in_camera;
            sighting.shared.push((flange, verify::by_mount(&base_from_mount, &in_mount)));
        }
        test.touches.push(Touched {
            id: point.id,
            in_base: point.in_base,
            sightings: vec![sighting],
        });
    }
    Ok(())
}

/// The error of a flange pose, one for all that was seen from it.
fn shared_flange(
    test: &mut Test,
    flange: Pose<handeye::Base, Flange>,
    calibration: &Calibration,
) -> usize {
    let same = |t: &Touched| {
        let s = t.sightings.iter().find(|s| s.base_from_mount.rename::<_, Flange>() == flange)?;
        s.shared.first().map(|(number, _)| *number)
    };
    test.touches.iter().find_map(same).unwrap_or_else(|| {
        test.poses.push(robot_covariance(calibration));
        test.poses.len() - 1
    })
}

fn robot_covariance(calibration: &Calibration) -> Matrix6<f64> {
    let (r, t) = robot_sigma(calibration);
    let (r, t) = (r * r, t * t);
    Matrix6::from_diagonal(&Vector6::new(r, r, r, t, t, t))
}

fn from_dataset(
    path: &Path,
    calibration: &Calibration,
    test: &mut Test,
    manners: &Manners,
) -> Result<(), Failure> {
    let dataset = Dataset::open(path)?;
    let manifest = if path.is_dir() { path.join(MANIFEST) } else { path.into() };
    if dataset.setup != calibration.setup {
        return Err(Failure::input(manifest, "is of another setup than the calibration"));
    }
    if dataset.touches.is_empty() || dataset.target.is_none() {
        let what = "has no touches of a [target]: add [touches], or give a file of touched points";
        return Err(Failure::input(manifest, what));
    }
    let progress = Progress::new("reading captures", manners);
    let session = measure::measure(&dataset, &|done, all| progress.tell(done, all))?.session;
    drop(progress);
    if let Some(sigma) = dataset.noise.touch {
        test.touch_sigma = sigma.hypot(robot_sigma(calibration).1);
    }
    test.touches = session
        .touches
        .iter()
        .map(|t| Touched {
            id: format!("{} {}", t.placement, t.corner),
            in_base: t.in_base,
            sightings: vec![],
        })
        .collect();
    for (name, base_from_mount, candidates) in views(&session) {
        see(test, &session, &name, base_from_mount, &candidates, calibration);
    }
    Ok(())
}

/// Where a board was seen: its name, the mount, and the board's possible poses.
type BoardView = (String, Pose<handeye::Base, Mount>, Vec<TargetPose>);

fn views(session: &Session) -> Vec<BoardView> {
    let placed = session.placements.iter();
    match session.setup {
        Setup::EyeToHand => {
            placed.map(|p| (p.id.clone(), Pose::identity(), p.candidates.clone())).collect()
        }
        Setup::EyeInHand => {
            let name = session.touches.first().map(|t| t.placement.clone()).unwrap_or_default();
            let view = |o: &handeye::Observation| {
                (name.clone(), o.base_from_flange.rename(), o.candidates.clone())
            };
            session.observations.iter().map(view).collect()
        }
    }
}

/// Adds one view of a board to the touches of it, in the reading that fits them best.
fn see(
    test: &mut Test,
    session: &Session,
    name: &str,
    base_from_mount: Pose<handeye::Base, Mount>,
    candidates: &[TargetPose],
    calibration: &Calibration,
) {
    let Some(target) = &session.target else { return };
    let base_from_camera = base_from_mount * test.mount_from_camera;
    let touched: Vec<usize> =
        (0..session.touches.len()).filter(|&k| session.touches[k].placement == name).collect();
    let corner = |k: usize| target.corner(session.touches[k].corner);
    let misfit = |pose: &TargetPose| -> f64 {
        let of = |&k: &usize| {
            let there = base_from_camera * pose.camera_from_target * corner(k)?;
            Some((there.vector() - session.touches[k].in_base.vector()).norm())
        };
        touched.iter().filter_map(of).sum()
    };
    let best = candidates.iter().min_by(|a, b| misfit(a).total_cmp(&misfit(b)));
    let Some(pose) = best else { return };
    let board = test.poses.len();
    test.poses.push(pose.covariance.unwrap_or_else(Matrix6::zeros));
    let flange = (session.setup == Setup::EyeInHand).then(|| {
        test.poses.push(robot_covariance(calibration));
        board + 1
    });
    for k in touched {
        let Some(on_board) = corner(k) else { continue };
        let in_camera = pose.camera_from_target * on_board;
        let by_board: ByPose =
            verify::by_board(&base_from_camera, &pose.camera_from_target, &on_board);
        let in_mount = test.mount_from_camera * in_camera;
        let by_flange = flange.map(|f| (f, verify::by_mount(&base_from_mount, &in_mount)));
        let shared = [(board, by_board)].into_iter().chain(by_flange).collect();
        test.touches[k].sightings.push(Sighting {
            base_from_mount,
            in_camera,
            covariance: Matrix3::zeros(),
            shared,
        });
    }
}

fn answer(args: &VerifyArgs, c: &Calibration, test: &Test, found: &Verification) -> Answer {
    let within = args.tolerance_mm.map(|t| found.within(t * 1e-3));
    let mm = |v: Vector3<f64>| (v * 1e3).into();
    let touch = |(t, d): (&Touched, &verify::Difference)| TouchResult {
        id: t.id.clone(),
        predicted_in_base_m: d.predicted.vector().into(),
        difference_mm: mm(d.difference),
        distance_mm: d.difference.norm() * 1e3,
        expected_mm: d.expected.map(|e| e * 1e3),
        within: args.tolerance_mm.map(|t| d.difference.norm() * 1e3 <= t),
    };
    let (verdict, reasons) = conclude(args, found, within);
    Answer {
        verdict,
        reasons,
        name: c.name.clone(),
        touches: test.touches.iter().zip(&found.differences).map(touch).collect(),
        residual: Residual {
            rms_mm: found.rms * 1e3,
            max_mm: found.max * 1e3,
            p95_at_most_mm: found.p95_at_most * 1e3,
        },
        agreement: found.agreement,
        offset: found.offset.map(|o| OffsetResult {
            mean_mm: mm(o.mean),
            sigma_mm: mm(o.sigma),
            test: o.test,
            without: o.without,
        }),
        tolerance_mm: args.tolerance_mm,
        within,
        confidence: verify::CONFIDENCE,
        touch_sigma_mm: test.touch_sigma * 1e3,
        warnings: warnings(c, found),
    }
}

fn conclude(
    args: &VerifyArgs,
    found: &Verification,
    within: Option<Within>,
) -> (Verdict, Vec<String>) {
    let disagrees = found.agreement.is_some_and(|a| a.p_value < LEAST_CHANCE);
    let all = found.differences.len();
    match (args.tolerance_mm, within) {
        (Some(tolerance), Some(w)) => {
            let passed = w.share >= SHARE;
            let verdict = if passed { Verdict::Accepted } else { Verdict::Rejected };
            let counted = format!("{} of {all} touches lie within {tolerance} mm", w.count);
            let bound = format!(
                "with 95 % confidence at least {:.0} % of all points lie within {tolerance} mm; \
                 59 touches, all within, would show 95 %",
                100.0 * w.at_least
            );
            let wanted = "95 % are wanted".to_owned();
            match passed {
                true => (verdict, vec![counted, bound]),
                false => (verdict, vec![format!("only {counted}; {wanted}")]),
            }
        }
        _ if found.agreement.is_none() => (
            Verdict::Undetermined,
            vec!["the calibration states no covariance and no --tolerance-mm is given".into()],
        ),
        _ if disagrees => (
            Verdict::Rejected,
            vec!["the touches lie farther from their predictions than the calibration says".into()],
        ),
        _ => (
            Verdict::Accepted,
            vec!["the touches lie where they were predicted, within the stated uncertainty".into()],
        ),
    }
}

/// Differences (mm) this close are of the same touch.
const SAME_MM: f64 = 1e-3;

fn warnings(c: &Calibration, found: &Verification) -> Vec<Warning> {
    let mut all = Vec::new();
    let used = |d: &verify::Difference| {
        c.touches.iter().any(|t| t.used && (t.difference_mm - d.difference * 1e3).norm() < SAME_MM)
    };
    if found.differences.iter().filter(|d| used(d)).count() * 2 > found.differences.len() {
        let message = "the calibration was made with these touches: they cannot test it; touch \
                       other points";
        all.push(Warning::new("touches-not-new", message));
    }
    if let (true, Some(o)) = (found.is_shifted(), &found.offset) {
        let m = o.mean * 1e3;
        let message = format!(
            "all touches are off by about the same ({:.2}, {:.2}, {:.2}) mm in the base, and \
             nothing else: check the tip (handeye tcp) and the thickness of what was touched",
            m.x, m.y, m.z
        );
        all.push(Warning::new("common-offset", message));
    } else if let Some(a) = found.agreement.filter(|a| a.p_value < LEAST_CHANCE) {
        let message = format!(
            "the touches are off by more than calibration and touches say of themselves \
             (chi-square {:.1} where {} is expected): the stated uncertainty is too small",
            a.chi_square, a.degrees_of_freedom
        );
        all.push(Warning::new("uncertainty-understated", message));
    }
    all
}

fn write(
    out: &Path,
    args: &VerifyArgs,
    answer: &Answer,
    found: &Verification,
    manners: &Manners,
) -> Result<(), Failure> {
    fs::create_dir_all(out).map_err(|e| Failure::no_folder(out, e))?;
    let page = touch_test_html(&TouchTest {
        title: args.calibration.display().to_string(),
        verdict: answer.verdict,
        reasons: &answer.reasons,
        warnings: &answer.warnings,
        ids: answer.touches.iter().map(|t| t.id.clone()).collect(),
        found,
        within: args.tolerance_mm.zip(answer.within),
    });
    let path = out.join("verify.html");
    write_atomically(&path, page.as_bytes())?;
    if !manners.quiet {
        eprintln!("report: {}", path.display());
    }
    Ok(())
}

/// For people, in 80 columns.
fn text(a: &Answer) -> String {
    let word = match a.verdict {
        Verdict::Accepted => "PASSED",
        Verdict::Rejected => "FAILED",
        Verdict::Undetermined => "UNDETERMINED",
    };
    let mut text = format!("\n{}\n", output::verdict_as(a.verdict, word));
    text += &a.reasons.iter().map(|reason| output::wrapped("  ", reason)).collect::<String>();
    text += &format!(
        "\n  {:<18}{:>10}{:>10}{:>11}{:>10}{:>10}   mm\n",
        "touch", "distance", "expected", "x", "y", "z"
    );
    for t in &a.touches {
        let expected = t.expected_mm.map_or("-".into(), |e| format!("{e:.3}"));
        let [x, y, z] = t.difference_mm;
        let mark = if t.within == Some(false) { " *" } else { "" };
        text += &format!(
            "  {:<18}{:>10.3}{expected:>10}{x:>11.3}{y:>10.3}{z:>10.3}{mark}\n",
            t.id, t.distance_mm
        );
    }
    let r = &a.residual;
    text += &format!("\n  root mean square {:.3} mm, largest {:.3} mm\n", r.rms_mm, r.max_mm);
    text += &output::wrapped(
        "  ",
        &format!(
            "with 95 % confidence, 95 of 100 points are off by less than {:.3} mm",
            r.p95_at_most_mm
        ),
    );
    if let Some(c) = &a.agreement {
        text += &format!(
            "  chi-square {:.1} where {} is expected: p = {:.4}\n",
            c.chi_square, c.degrees_of_freedom, c.p_value
        );
    }
    if let Some(o) = &a.offset {
        let [x, y, z] = o.mean_mm;
        text +=
            &format!("  common offset ({x:.3}, {y:.3}, {z:.3}) mm: p = {:.4}\n", o.test.p_value);
    }
    text
}
