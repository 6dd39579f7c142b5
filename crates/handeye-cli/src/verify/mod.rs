//! `handeye verify`: does the robot find what the camera measures? The touch test.

mod test;

use std::{fs, path::Path};

use handeye::{
    Calibration, Verdict, Warning,
    tools::verify::{self, ChiSquare, LEAST_CHANCE, SHARE, Test, Touched, Verification, Within},
};
use handeye_io::{
    read_result,
    report::{TouchTest, touch_test_html},
    write_atomically,
};
use nalgebra::Vector3;
use serde::Serialize;

use crate::{
    args::{GlobalArgs, VerifyArgs},
    failure::Failure,
    output,
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

pub fn run(args: &VerifyArgs, global: &GlobalArgs) -> Result<u8, Failure> {
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
    let calibration = read_result(&path)?;
    let (test, mut warnings) = test::test(args, &calibration, &path, global)?;
    let found = verify::verify(&test)?;
    warnings.splice(..0, of_its_own(&calibration));
    let mut answer = answer(args, &calibration, &test, &found);
    answer.warnings.splice(..0, warnings);
    if let Some(out) = &args.out {
        write(out, args, &answer, &found, global)?;
    }
    if global.json {
        output::json(&answer);
    } else {
        output::warn(&answer.warnings, global);
        output::print(&text(&answer));
    }
    Ok(if answer.verdict == Verdict::Accepted { 0 } else { 3 })
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
    let (verdict, reasons) = with_its_own(c, conclude(args, found, within));
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
                "{all} touches show, with 95 % confidence, that at least {:.0} % of all points lie within \
                 {tolerance} mm; to show it of 95 % of all points, use 59 touches, all of them within {tolerance} mm",
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

/// The calibration's own verdict, in words, where it is not accepted. A pose that comes from elsewhere has none: of that
/// the touches alone decide.
fn own_verdict(c: &Calibration) -> Option<String> {
    let word = match c.verdict {
        _ if c.is_unjudged() => return None,
        Verdict::Accepted => return None,
        Verdict::Rejected => "rejected",
        Verdict::Undetermined => "undetermined",
    };
    let why = c.reasons.first().map_or(String::new(), |reason| format!(" ({reason})"));
    Some(format!("the calibration's own verdict is {word}{why}"))
}

/// The verdict with the calibration's own: touches in one place do not outweigh data that
/// contradict themselves.
fn with_its_own(
    c: &Calibration,
    (verdict, mut reasons): (Verdict, Vec<String>),
) -> (Verdict, Vec<String>) {
    match own_verdict(c) {
        Some(own) if verdict == Verdict::Accepted => {
            reasons.insert(
                0,
                format!("{own}: touches that agree do not replace an accepted calibration"),
            );
            (Verdict::Undetermined, reasons)
        }
        _ => (verdict, reasons),
    }
}

fn of_its_own(c: &Calibration) -> Option<Warning> {
    if c.is_unjudged() {
        let message = "this pose was imported without calibration data: the touches alone test it, and only near the \
                       touched points";
        return Some(Warning::new("not-judged", message));
    }
    let message =
        format!("{}: correct that first, calibrate anew, and test again", own_verdict(c)?);
    Some(Warning::new("calibration-not-accepted", message))
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
            "the distances at the touches are larger than the stated uncertainty of calibration and touches \
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
    global: &GlobalArgs,
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
    if !global.quiet {
        crate::output::note!("report: {}", path.display());
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
        "\n  {:<18}{:>10}{:>15}{:>11}{:>10}{:>10}   mm\n",
        "touch", "distance", "predicted RMS", "x", "y", "z"
    );
    for t in &a.touches {
        let expected = t.expected_mm.map_or("-".into(), |e| format!("{e:.3}"));
        let [x, y, z] = t.difference_mm;
        let mark = if t.within == Some(false) { " *" } else { "" };
        text += &format!(
            "  {:<18}{:>10.3}{expected:>15}{x:>11.3}{y:>10.3}{z:>10.3}{mark}\n",
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
