//! `handeye tcp`: where the tip of a tool sits, from flange poses with the tip on one point.

use clap::Args;
use handeye::{
    Error, Verdict, Warning,
    tools::pivot::{self, Lengths, Pivot},
};
use handeye_io::{RobotPoses, read_robot_poses};
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use crate::{
    args::{GlobalArgs, PosesArgs},
    failure::Failure,
    output, poses,
};

/// Arguments of `tcp`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye tcp pivot.csv --notation kuka --direction base_from_flange\n\
\x20 handeye tcp pivot.json --field 'poses.*.flange' \\\n\
\x20     --notation euler-xyz-extrinsic --length-unit mm --direction base_from_flange --json\n\
\x20 handeye tcp pivot.toml\n\
\n\
Lead the tip onto one fixed point from 6 to 10 directions, 30 degrees and more apart, and \
save the flange pose each time. pivot.toml holds the same keys as the [robot] of a manifest.")]
pub struct TcpArgs {
    /// The poses.
    #[command(flatten)]
    pub poses: PosesArgs,
    /// Maximum RMS distance of the tip from the fixed point; above it the result is rejected.
    #[arg(long, default_value_t = 2.0)]
    pub limit_mm: f64,
}

#[derive(Serialize)]
struct InMillimetres {
    rms_mm: f64,
    max_mm: f64,
}

impl From<Lengths> for InMillimetres {
    fn from(l: Lengths) -> Self {
        Self { rms_mm: l.rms * 1e3, max_mm: l.max * 1e3 }
    }
}

#[derive(Serialize)]
struct PoseResult<'a> {
    id: &'a str,
    used: bool,
    residual_mm: f64,
    difference_mm: [f64; 3],
    held_out_mm: Option<f64>,
}

#[derive(Serialize)]
struct Answer<'a> {
    verdict: Verdict,
    reasons: &'a [String],
    tip_in_flange_m: [Option<f64>; 3],
    /// m², in the flange.
    covariance: Option<[[f64; 3]; 3]>,
    point_in_base_m: [Option<f64>; 3],
    point_covariance: Option<[[f64; 3]; 3]>,
    sigma_mm: Option<f64>,
    residual: Option<InMillimetres>,
    held_out: Option<InMillimetres>,
    poses: Vec<PoseResult<'a>>,
    rejected: Vec<&'a str>,
    undetermined: &'a [String],
    warnings: Vec<Warning>,
}

pub fn run(args: &TcpArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    if !(args.limit_mm > 0.0) {
        return Err(Failure::Usage("--limit-mm must be positive".into()));
    }
    let robot = read_robot_poses(&poses::described(&args.poses)?)?;
    match pivot::pivot(&robot.base_from_flange, args.limit_mm * 1e-3) {
        Ok(found) => Ok(tell(&answer(&robot, &found), global)),
        Err(Error::NotDetermined { what }) => {
            let (reasons, all) = ([what], ["the tip in the flange, in all directions".into()]);
            Ok(tell(&no_answer(&robot, &reasons, &all), global))
        }
        Err(error) => Err(Failure::from(error).in_file(&args.poses.poses)),
    }
}

/// Prints the answer; returns the exit code.
fn tell(answer: &Answer, global: &GlobalArgs) -> u8 {
    if global.json {
        output::json(answer);
    } else {
        output::warn(&answer.warnings, global);
        output::print(&text(answer));
    }
    if answer.verdict == Verdict::Accepted { 0 } else { 3 }
}

/// Poses that can be read but tell nothing.
fn no_answer<'a>(
    robot: &RobotPoses,
    reasons: &'a [String],
    undetermined: &'a [String],
) -> Answer<'a> {
    Answer {
        verdict: Verdict::Undetermined,
        reasons,
        tip_in_flange_m: [None; 3],
        covariance: None,
        point_in_base_m: [None; 3],
        point_covariance: None,
        sigma_mm: None,
        residual: None,
        held_out: None,
        poses: vec![],
        rejected: vec![],
        undetermined,
        warnings: robot.warnings.clone(),
    }
}

fn answer<'a>(robot: &'a RobotPoses, found: &'a Pivot) -> Answer<'a> {
    let known =
        |v: Vector3<f64>, known: [bool; 3]| std::array::from_fn(|k| known[k].then_some(v[k]));
    let rows = |m: Matrix3<f64>| std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)]));
    let pose = |(k, id): (usize, &'a String)| PoseResult {
        id,
        used: !found.rejected.contains(&k),
        residual_mm: found.residuals[k].norm() * 1e3,
        difference_mm: (found.residuals[k] * 1e3).into(),
        held_out_mm: found.held_out[k].map(|d| d.norm() * 1e3),
    };
    Answer {
        verdict: found.verdict,
        reasons: &found.reasons,
        tip_in_flange_m: known(found.tip_in_flange.vector(), found.tip_known),
        covariance: found.tip_covariance.map(rows),
        point_in_base_m: known(found.point_in_base.vector(), found.point_known),
        point_covariance: found.point_covariance.map(rows),
        sigma_mm: Some(found.sigma * 1e3),
        residual: found.spread().map(Into::into),
        held_out: found.held_out().map(Into::into),
        poses: robot.names.iter().enumerate().map(pose).collect(),
        rejected: found.rejected.iter().map(|&k| robot.names[k].as_str()).collect(),
        undetermined: &found.undetermined,
        warnings: warnings(robot, found),
    }
}

fn warnings(robot: &RobotPoses, found: &Pivot) -> Vec<Warning> {
    let mut all = robot.warnings.clone();
    for &k in &found.rejected {
        let (name, mm) = (&robot.names[k], found.residuals[k].norm() * 1e3);
        let message = format!(
            "pose {name} is rejected as an outlier: its tip lies {mm:.1} mm from the point of the others; was \
             the tip on the point?"
        );
        all.push(Warning::new("pose-left-out", message));
    }
    let (tip, point) = (found.tip_in_flange.vector().norm(), found.point_in_base.vector().norm());
    if found.undetermined.is_empty() && tip > point {
        let message = format!(
            "the tip would be {tip:.2} m from the flange and {point:.2} m from the base: are the \
             poses written the other way round? A pivot fits both directions"
        );
        all.push(Warning::new("direction-suspicious", message));
    }
    all
}

/// For people, in 80 columns.
fn text(a: &Answer) -> String {
    let mut text = format!("\n{}\n", output::verdict(a.verdict));
    text += &a.reasons.iter().map(|reason| output::wrapped("  ", reason)).collect::<String>();
    let sigmas = |covariance: Option<[[f64; 3]; 3]>| {
        covariance.map_or(String::new(), |c| {
            let [x, y, z] = [0, 1, 2].map(|k| c[k][k].max(0.0).sqrt() * 1e3);
            format!("  one sigma    {x:11.3} {y:11.3} {z:11.3}   mm\n")
        })
    };
    let line = |name: &str, v: [Option<f64>; 3]| {
        let [x, y, z] = v.map(|x| x.map_or("-".into(), |x| format!("{:.3}", x * 1e3)));
        format!("  {name:<13}{x:>11} {y:>11} {z:>11}   mm\n")
    };
    text += &format!("\ntip in the flange\n{}", line("x y z", a.tip_in_flange_m));
    text += &sigmas(a.covariance);
    text += &format!("\npoint in the base\n{}", line("x y z", a.point_in_base_m));
    text += &sigmas(a.point_covariance);
    if a.poses.is_empty() {
        return text;
    }
    text += &format!("\n  {:<20}{:>14}{:>14}\n", "pose", "residual", "held out");
    for pose in &a.poses {
        let left_out = pose.held_out_mm.map_or("-".into(), |mm| format!("{mm:.3} mm"));
        let mark = if pose.used { "" } else { "  not used" };
        text += &format!("  {:<20}{:>11.3} mm{left_out:>14}{mark}\n", pose.id, pose.residual_mm);
    }
    text += &last_line("root mean square", a, |l| l.rms_mm);
    text += &last_line("largest", a, |l| l.max_mm);
    text
}

fn last_line(name: &str, a: &Answer, length: fn(&InMillimetres) -> f64) -> String {
    let mm = |l: &Option<InMillimetres>| {
        l.as_ref().map_or("-".into(), |l| format!("{:.3} mm", length(l)))
    };
    format!("  {name:<20}{:>14}{:>14}\n", mm(&a.residual), mm(&a.held_out))
}
