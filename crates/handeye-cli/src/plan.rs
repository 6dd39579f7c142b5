//! `handeye plan`: the views to take next, and the corners to touch.

use std::path::PathBuf;

use clap::Args;
use handeye::{
    Calibration, Verdict,
    tools::plan::{NextView, PlannedTouch},
};
use handeye_io::{
    Dataset, Writing,
    plan::{self, CellPlan, Maker, PlanOptions},
    write_atomically,
};
use serde_json::{Value, json};

use crate::{
    args::{ArmArgs, GlobalArgs},
    failure::Failure,
    output,
    progress::Progress,
};

/// Arguments of `plan`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye plan cell/ --tolerance-mm 0.35\n\
\x20 handeye plan cell/ --next --urdf ur10e.urdf --avoid boxes.toml\n\
\x20 handeye plan cell/ --count 12 --format kuka --out views.csv\n\
\x20 handeye plan cell/ --count 12 --program ur --out views.script\n\
\x20 handeye plan cell/ --touches\n\
\n\
Exit code 0: a plan, or the captures are enough; 1: no view is left, or too little is known. Poses are of the flange in \
the base; read them, and run them slowly: no plan knows all of a cell.")]
pub struct PlanArgs {
    /// Folder that contains `handeye.toml`, or the path of a manifest; at least one capture that shows the board.
    pub dataset: PathBuf,
    /// Folder that the file names in the manifest are relative to [default: the folder of the manifest].
    #[arg(long)]
    pub root: Option<PathBuf>,
    /// Largest number of views.
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u16).range(1..=200))]
    pub count: u16,
    /// Plan until the expected error (95 %) is below this [default: what the manifest says].
    #[arg(long, value_name = "MM")]
    pub tolerance_mm: Option<f64>,
    /// Only the most informative view.
    #[arg(long, conflicts_with = "count")]
    pub next: bool,
    /// Corners to touch as well.
    #[arg(long)]
    pub touches: bool,
    /// The robot's model.
    #[command(flatten)]
    pub arm: ArmArgs,
    /// Joint values now, degrees or mm, separated by commas [default: those of the last capture].
    #[arg(long, value_delimiter = ',', allow_negative_numbers = true, value_name = "DEG")]
    pub joints: Option<Vec<f64>>,
    /// TOML file of boxes in the cell and on the flange.
    #[arg(long, value_name = "FILE")]
    pub avoid: Option<PathBuf>,
    /// Least distance of the board from the camera [default: somewhat nearer than the captures].
    #[arg(long, value_name = "MM", requires = "farthest_mm")]
    pub nearest_mm: Option<f64>,
    /// Largest distance of the board from the camera.
    #[arg(long, value_name = "MM", requires = "nearest_mm")]
    pub farthest_mm: Option<f64>,
    /// Notation of the poses, such as kuka or ur [default: that of the dataset].
    #[arg(long, short, value_name = "MAKER")]
    pub format: Option<String>,
    /// Write a program of the robot instead: ur, kuka, fanuc or abb.
    #[arg(long, value_name = "MAKER", conflicts_with = "format")]
    pub program: Option<String>,
    /// File for the poses or the program [default: standard output].
    #[arg(long, short)]
    pub out: Option<PathBuf>,
}

pub fn run(args: &PlanArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let maker = args.program.as_deref().map(Maker::named).transpose().map_err(Failure::Usage)?;
    let dataset = match &args.root {
        Some(root) => Dataset::open_with_root(&args.dataset, root)?,
        None => Dataset::open(&args.dataset)?,
    };
    let writing = match &args.format {
        Some(name) => Some(Writing::of(name).map_err(Failure::Usage)?),
        None => dataset.notation.as_deref().and_then(|name| Writing::of(name).ok()),
    };
    let options = options(args, &dataset)?;
    let progress = Progress::new("reading captures", global);
    let found = plan::plan(&dataset, &options, &|done, all| progress.tell(done, all))?;
    drop(progress);
    let table = match maker {
        Some(maker) => plan::program(maker, &found.route),
        None => table(&found, writing.as_ref()),
    };
    if let Some(out) = &args.out {
        write_atomically(out, table.as_bytes())?;
    }
    if global.json {
        output::json(&document(&found, &options, writing.as_ref()));
        return Ok(0);
    }
    if !global.quiet {
        for note in &found.notes {
            output::note!("note: {note}");
        }
    }
    output::print(&summary(&found, &options));
    match &args.out {
        Some(out) if !global.quiet => output::print(&format!("written: {}\n", out.display())),
        Some(_) => {}
        None if found.route.views.is_empty() => {}
        None => output::print(&format!("\n{table}")),
    }
    Ok(0)
}

fn options(args: &PlanArgs, dataset: &Dataset) -> Result<PlanOptions, Failure> {
    let tolerance_mm = args.tolerance_mm.or(dataset.limits.max_error.map(|m| m * 1e3));
    let sound = |mm: f64| mm.is_finite() && mm > 0.0;
    let lengths = [args.tolerance_mm, args.nearest_mm, args.farthest_mm];
    if lengths.into_iter().flatten().any(|mm| !sound(mm)) {
        return Err(Failure::Usage(
            "tolerance and distances are positive numbers of millimetres".into(),
        ));
    }
    let urdf = args.arm.option();
    let metres = |mm: f64| mm * 1e-3;
    Ok(PlanOptions {
        count: if args.next { 1 } else { args.count.into() },
        tolerance_mm,
        urdf,
        avoid: args.avoid.clone(),
        now: args.joints.clone(),
        distances_m: args.nearest_mm.map(metres).zip(args.farthest_mm.map(metres)),
        touches: args.touches,
        ..PlanOptions::default()
    })
}

/// The poses as a table, in a notation or in metres and quaternions.
fn table(found: &CellPlan, writing: Option<&Writing>) -> String {
    let usual = Writing::of("quaternion-xyzw").ok();
    let Some(writing) = writing.or(usual.as_ref()) else { return String::new() };
    let stops = found.route.stops();
    writing.table(stops.iter().map(|stop| (&stop.name[..], &stop.station.base_from_flange)))
}

fn document(found: &CellPlan, options: &PlanOptions, writing: Option<&Writing>) -> Value {
    let p95 =
        |error: &Option<handeye::estimate::predict::PredictedTre>| error.as_ref().map(|e| e.p95);
    let pose = |view: &NextView| {
        json!({
            "base_from_flange": view.station.base_from_flange,
            "joints_rad": view.station.joints,
            "camera_from_target": view.camera_from_target,
            "reason": view.reason(),
            "predicted_p95_mm": p95(&view.after),
            "via_start": view.via_start,
            "numbers": writing.map(|w| w.numbers(&view.station.base_from_flange)),
        })
    };
    let touch = |touch: &PlannedTouch| {
        json!({
            "placement": touch.placement,
            "camera_from_target": touch.camera_from_target,
            "corner": touch.corner,
            "reason": touch.reason(),
            "predicted_p95_mm": p95(&touch.after),
        })
    };
    let now = found.calibration.as_ref().and_then(|c| c.predicted_tre_mm.as_ref());
    json!({
        "poses": found.route.views.iter().map(pose).collect::<Vec<_>>(),
        "touches": found.touches.iter().map(touch).collect::<Vec<_>>(),
        "enough": found.enough,
        "undetermined": found.route.undetermined,
        "stopped": found.route.stopped,
        "begins_at": found.begins_at,
        "start": found.route.start.as_ref().map(|start| json!({
            "base_from_flange": start.base_from_flange,
            "joints_rad": start.joints,
        })),
        "verdict": found.calibration.as_ref().map(|c| c.verdict),
        "p95_mm": now.map(|error| error.p95),
        "predicted_p95_mm": p95(&found.route.expected),
        "tolerance_mm": options.tolerance_mm,
        "columns": writing.map(Writing::names),
        "joint_names": found.joint_names,
        "notes": found.notes,
    })
}

/// What is known now, what the views bring, and how far that goes.
fn summary(found: &CellPlan, options: &PlanOptions) -> String {
    let text = found.calibration.as_ref().map_or(String::new(), now);
    if found.enough {
        let mm = options.tolerance_mm.unwrap_or_default();
        return text + &format!("enough for the tolerance of {mm} mm: no more views are needed\n");
    }
    let touches = (1..).zip(&found.touches);
    let touches =
        touches.map(|(k, touch): (usize, _)| format!("{k:3}. touch {}\n", touch.reason()));
    text + &expected(found, options.tolerance_mm) + &views(found) + &touches.collect::<String>()
}

fn now(calibration: &Calibration) -> String {
    let used = calibration.captures.iter().filter(|c| c.used).count();
    let error = calibration.predicted_tre_mm.as_ref().map(|error| error.p95);
    let now = match (calibration.verdict, error) {
        (Verdict::Undetermined, _) | (_, None) => "does not determine the answer yet".to_owned(),
        (_, Some(mm)) => format!("states an error of {mm:.2} mm (95 %)"),
    };
    format!("now: the calibration of {used} captures {now}\n")
}

/// The error once all views are taken.
fn expected(found: &CellPlan, tolerance: Option<f64>) -> String {
    let count = found.route.views.len();
    let Some(p95) = found.route.expected.as_ref().map(|error| error.p95) else {
        return format!("{count} views\n");
    };
    let enough = tolerance.map_or(String::new(), |mm| {
        let not = if p95 <= mm { "" } else { "not yet " };
        format!(": {not}within the tolerance of {mm} mm")
    });
    format!("{count} views, then about {p95:.2} mm (95 %){enough}\n")
}

fn views(found: &CellPlan) -> String {
    let mut text = String::new();
    let views = &found.route.views;
    if let Some(why) = &found.route.stopped {
        text += &format!("no more views: {why}\n");
    }
    if let Some(capture) = found.begins_at.as_ref().filter(|_| !views.is_empty()) {
        text +=
            &format!("the ways begin where the robot stood at capture {capture}: go there first\n");
    }
    for (k, view) in views.iter().enumerate() {
        let detour = if view.via_start { " (go back to the first pose before)" } else { "" };
        text += &format!("{:3}. {}{detour}\n", k + 1, view.reason());
        if let Some(joints) = &view.station.joints {
            text += &format!("     joints {}\n", joint_values(joints, &found.prismatic));
        }
    }
    if !found.route.undetermined.is_empty() {
        text +=
            &format!("not determined by these views: {}\n", found.route.undetermined.join(", "));
    }
    text
}

/// In degrees, or millimetres for joints that slide.
fn joint_values(joints: &[f64], prismatic: &[bool]) -> String {
    let shown = |(value, prismatic): (&f64, &bool)| match prismatic {
        true => format!("{:.1} mm", value * 1e3),
        false => format!("{:.1}°", value.to_degrees()),
    };
    joints.iter().zip(prismatic).map(shown).collect::<Vec<_>>().join("  ")
}
