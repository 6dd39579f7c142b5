//! `handeye compensate`: poses of a robot that errs by place, corrected.

use std::path::{Path, PathBuf};

use clap::Args;
use handeye::{
    Base, Flange, Pose,
    calibrate::result::{BlockGain, CompensationResult},
    estimate::compensation::{Compensation, Corrected},
};
use handeye_io::{RobotPoses, read_result, read_robot_poses, write_atomically};
use serde::Serialize;

use crate::{
    args::{GlobalArgs, PosesArgs},
    failure::Failure,
    output, poses,
};

/// Arguments of `compensate`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye compensate picks.csv --result result --notation kuka \\\n\
\x20     --direction base_from_flange\n\
\x20 handeye compensate picks.csv -r result --notation ur \\\n\
\x20     --direction base_from_flange --out send.csv\n\
\n\
POSES are desired flange poses, computed with the transform of the result. The output contains the poses to command so that the flange reaches the desired poses. Exit code 0: corrected; 3: \
the result offers no correction.")]
pub struct CompensateArgs {
    /// The poses.
    #[command(flatten)]
    pub poses: PosesArgs,
    /// calibration.json, or the folder that holds it.
    #[arg(long, short)]
    pub result: PathBuf,
    /// POSES are poses that the robot reported (such as those of new captures): write the true flange poses.
    #[arg(long)]
    pub reported: bool,
    /// File to write, in the notation of POSES [default: standard output].
    #[arg(long, short)]
    pub out: Option<PathBuf>,
}

#[derive(Serialize)]
struct Answer<'a> {
    /// `command` or `actual`.
    kind: &'static str,
    offered: bool,
    reason: Option<String>,
    /// The gain on captures left out, mm.
    by_place: Option<BlockGain>,
    by_time: Option<BlockGain>,
    columns: Vec<&'static str>,
    poses: Vec<PoseResult<'a>>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct PoseResult<'a> {
    id: &'a str,
    base_from_flange: serde_json::Value,
    /// In the notation of the input.
    numbers: Vec<f64>,
    step_mm: f64,
    step_deg: f64,
    /// Standard deviations per axis.
    sigma_mm: f64,
    sigma_deg: f64,
    inside: bool,
}

pub fn run(args: &CompensateArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let calibration = read_result(&args.result)?;
    let robot = read_robot_poses(&poses::described(&args.poses)?)?;
    let Some(written) = &robot.written else {
        let what = "holds joint values; give the poses of the flange";
        return Err(Failure::input(&args.poses.poses, what));
    };
    output::warn(&robot.warnings, global);
    let found = calibration.compensation.as_ref();
    let model = match calibration.correction() {
        Ok(model) => model,
        Err(why) => {
            let reason = format!("{}: {why}", args.result.display());
            not_offered(found, reason, args, global);
            return Ok(3);
        }
    };
    let corrected: Vec<Corrected> =
        robot.base_from_flange.iter().map(|pose| correct(model, args, pose)).collect();
    let names = robot.names.iter().map(String::as_str);
    let table = written.table(names.zip(corrected.iter().map(|c| &c.base_from_flange)));
    if let Some(out) = &args.out {
        write_atomically(out, table.as_bytes())?;
    }
    if global.json {
        output::json(&answer(args, found, &robot, &corrected));
    } else {
        if args.out.is_none() {
            output::print(&table);
        }
        tell(args.out.as_deref(), found, &robot, &corrected, global);
    }
    Ok(0)
}

fn correct(model: &Compensation, args: &CompensateArgs, pose: &Pose<Base, Flange>) -> Corrected {
    if args.reported { model.actual(pose) } else { model.command(pose) }
}

fn not_offered(
    found: Option<&CompensationResult>,
    reason: String,
    args: &CompensateArgs,
    global: &GlobalArgs,
) {
    if !global.json {
        output::note!("{reason}");
        return;
    }
    output::json(&Answer {
        kind: kind(args),
        offered: false,
        reason: Some(reason),
        by_place: found.map(|c| c.by_place),
        by_time: found.map(|c| c.by_time),
        columns: vec![],
        poses: vec![],
        warnings: vec![],
    });
}

fn kind(args: &CompensateArgs) -> &'static str {
    if args.reported { "actual" } else { "command" }
}

fn mm(x: f64) -> String {
    format!("{x:.3}")
}

fn answer<'a>(
    args: &CompensateArgs,
    found: Option<&CompensationResult>,
    robot: &'a RobotPoses,
    corrected: &[Corrected],
) -> Answer<'a> {
    let one = |((id, given), c): ((&'a String, _), &Corrected)| PoseResult {
        id,
        base_from_flange: serde_json::json!(c.base_from_flange),
        numbers: robot.written.as_ref().map_or_else(Vec::new, |w| w.numbers(&c.base_from_flange)),
        step_mm: c.base_from_flange.distance_to(given) * 1e3,
        step_deg: c.base_from_flange.angle_to(given).to_degrees(),
        sigma_mm: c.sigma_m() * 1e3,
        sigma_deg: c.sigma_rad().to_degrees(),
        inside: c.is_inside(),
    };
    Answer {
        kind: kind(args),
        offered: true,
        reason: None,
        by_place: found.map(|c| c.by_place),
        by_time: found.map(|c| c.by_time),
        columns: robot.written.as_ref().map_or_else(Vec::new, handeye_io::Writing::names),
        poses: robot.names.iter().zip(&robot.base_from_flange).zip(corrected).map(one).collect(),
        warnings: outside(robot, corrected).into_iter().collect(),
    }
}

/// What to know of poses where the robot was not seen.
fn outside(robot: &RobotPoses, corrected: &[Corrected]) -> Option<String> {
    let all = robot.names.iter().zip(corrected);
    let names: Vec<&str> =
        all.filter(|(_, c)| !c.is_inside()).map(|(name, _)| name.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "{} of {} poses lie outside of where the robot was seen, and are hardly corrected: {}",
            names.len(),
            corrected.len(),
            shortened(&names)
        )
    })
}

/// Most names that are listed.
const MOST_NAMES: usize = 8;

fn shortened(names: &[&str]) -> String {
    let listed = names[..names.len().min(MOST_NAMES)].join(", ");
    if names.len() > MOST_NAMES { format!("{listed}, ...") } else { listed }
}

/// For people, beside the table.
fn tell(
    out: Option<&Path>,
    found: Option<&CompensationResult>,
    robot: &RobotPoses,
    corrected: &[Corrected],
    global: &GlobalArgs,
) {
    if global.quiet {
        return;
    }
    if let Some(what) = outside(robot, corrected) {
        output::note!("warning: {what}");
    }
    let rms = |of: &dyn Fn(&Corrected) -> f64| {
        (corrected.iter().map(|c| of(c).powi(2)).sum::<f64>() / corrected.len().max(1) as f64)
            .sqrt()
    };
    let steps = robot.base_from_flange.iter().zip(corrected);
    let step = steps.map(|(given, c)| c.base_from_flange.distance_to(given)).fold(0.0, f64::max);
    output::note!(
        "{} poses corrected by up to {} mm; standard deviation {} mm per axis",
        corrected.len(),
        mm(step * 1e3),
        mm(rms(&Corrected::sigma_m) * 1e3)
    );
    if let Some(c) = found {
        output::note!(
            "captures left out in blocks: {} mm RMS instead of {} (by place), {} instead of {} (by time)",
            mm(c.by_place.corrected_mm),
            mm(c.by_place.rigid_mm),
            mm(c.by_time.corrected_mm),
            mm(c.by_time.rigid_mm)
        );
    }
    if let Some(out) = out {
        output::note!("written to {}", out.display());
    }
}
