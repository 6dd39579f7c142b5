//! `handeye solve`: poses in, answer out.

use std::path::{Path, PathBuf};

use clap::Args;
use handeye::{Calibration, Config, Method, solve::Form};
use handeye_io::{
    PosesFile,
    calibrate::{made_from_file, write_run},
    is_pairs_table, read_motions_table, read_pairs_table, read_poses,
    report::calibration_html,
};

use crate::{
    args::{Acceptance, GlobalArgs},
    calibrate::result_folder,
    failure::Failure,
    methods, output,
    simulate::SetupArg,
};

/// The help of `--method`: the names of published methods, by the equation that they solve.
fn published_methods() -> String {
    let named = |form: &Form| {
        let all = Method::ALL.into_iter().filter(|m| m.form() == *form).map(Method::name);
        format!("{}: {}", form.equation(), all.collect::<Vec<_>>().join(", "))
    };
    let forms: Vec<String> = Form::ALL.iter().map(named).collect();
    format!(
        "Take the answer of one published method on the captures that agree, in place of the best candidate; \
         several, or all, are compared in a table; {}",
        forms.join("; ")
    )
}

/// Arguments of `solve`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye solve pairs.json\n\
\x20 handeye solve pairs.json --method park-martin --json\n\
\x20 handeye solve pairs.csv --setup eye-to-hand --out result\n\
\x20 handeye solve pairs.json --method all\n\
\n\
pairs.json:\n\
\x20 {\"setup\": \"eye-in-hand\",\n\
\x20  \"pairs\": [{\"id\": \"01\",\n\
\x20    \"base_from_flange\":\n\
\x20      {\"translation_m\": [x, y, z], \"rotation_xyzw\": [x, y, z, w]},\n\
\x20    \"camera_from_target\":\n\
\x20      {\"translation_m\": [x, y, z], \"rotation_xyzw\": [x, y, z, w]}},\n\
\x20   ...]}\n\
\n\
or, instead of `pairs`, two streams by two clocks (camera time = robot time + \
time_offset_s):\n\
\x20  \"robot\":  [{\"time_s\": 0.00, \"base_from_flange\": {...}}, ...],\n\
\x20  \"camera\": [{\"time_s\": 0.01, \"camera_from_target\": {...}}, ...]\n\
\n\
or relative motions, A X = X B, of what carries the camera (eye-in-hand flange1_from_flange2, eye-to-hand \
base_from_flange1 flange2_from_base) and of the camera (camera_from_target1 target_from_camera2); the answer is \
judged `distance_m` (0.5) in front of it:\n\
\x20  \"motions\": [{\"A\": {...}, \"B\": {...}}, ...]\n\
\n\
Set `\"unknown_scale\": true` if the target distances have an unknown common scale (measured = \
scale * metric). Set `\"noise\": {\"robot_rotation_deg\": ..., \"robot_position_mm\": ...}` if you \
know the standard deviations of the robot, per axis.\n\
\n\
CSV, NPY and NPZ need --setup. A line of a CSV: base_from_flange and camera_from_target, each as \
x y z (m) and quaternion x y z w, or as the 16 numbers of a matrix, row by row; an id may come \
first. NPY: N x 2 x 4 x 4; NPZ: two arrays of N x 4 x 4 with these names. With --motions they hold A and B.")]
pub struct SolveArgs {
    /// JSON file with `setup` and `pairs`, `motions`, or `robot` and `camera`; or CSV, NPY or NPZ with pairs.
    pub pairs: PathBuf,
    /// Where the camera is mounted, for CSV, NPY and NPZ.
    #[arg(long, value_enum)]
    pub setup: Option<SetupArg>,
    /// CSV, NPY and NPZ hold relative motions A and B of A X = X B, not poses.
    #[arg(long)]
    pub motions: bool,
    /// Run published methods as published, by their names.
    #[arg(long, value_delimiter = ',', help = published_methods())]
    pub method: Vec<String>,
    /// Folder for calibration.json and report.html; created if it does not exist.
    #[arg(long, short)]
    pub out: Option<PathBuf>,
    /// What a script wants of the result.
    #[command(flatten)]
    pub acceptance: Acceptance,
    /// Try to prove that the least-squares solution is the global optimum.
    #[arg(long)]
    pub certify: bool,
}

pub fn run(args: &SolveArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let chosen = methods::named(&args.method)?;
    let input = read(args)?;
    let config = Config { max_error_mm: args.acceptance.max_error()?, ..Config::default() };
    if chosen.len() > 1 {
        let table = methods::compare(&input, &chosen, &config)?;
        let answer = if args.certify { table.answer.certified() } else { table.answer };
        let table = methods::Table { answer: made_from_file(answer, &args.pairs)?, ..table };
        let answer = finished(&table.answer, args, global)?;
        if global.json {
            output::json(&table);
        } else if !args.acceptance.oneline {
            methods::show(&table);
        }
        return Ok(answer);
    }
    let calibration = input.calibrate(&Config { method: chosen.first().copied(), ..config })?;
    let calibration = if args.certify { calibration.certified() } else { calibration };
    let calibration = made_from_file(calibration, &args.pairs)?;
    let code = finished(&calibration, args, global)?;
    if global.json {
        output::json(&calibration);
    }
    Ok(code)
}

/// JSON says of its setup itself; tables and arrays cannot.
fn read(args: &SolveArgs) -> Result<PosesFile, Failure> {
    let is_table = is_pairs_table(&args.pairs);
    if args.motions && !is_table {
        let what = "--motions is for CSV, TXT, NPY and NPZ; a JSON file has `motions`";
        return Err(Failure::Usage(what.into()));
    }
    match (is_table, args.setup) {
        (true, Some(setup)) if args.motions => Ok(read_motions_table(&args.pairs, setup.into())?),
        (true, Some(setup)) => Ok(read_pairs_table(&args.pairs, setup.into())?),
        (true, None) => {
            let what =
                "--setup is missing: eye-in-hand (the camera is on the flange) or eye-to-hand";
            Err(Failure::Usage(what.into()))
        }
        (false, Some(_)) => {
            let what = "--setup is for CSV, TXT, NPY and NPZ; a JSON file says it in `setup`";
            Err(Failure::Usage(what.into()))
        }
        (false, None) => Ok(read_poses(&args.pairs)?),
    }
}

/// Tells of the result and writes it, where that is asked; returns the exit code.
fn finished(c: &Calibration, args: &SolveArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    if args.acceptance.oneline && !global.json {
        output::print(&output::line(c, &args.pairs));
    } else if !global.json {
        output::warnings(c, global);
        output::summary(c);
    }
    if let Some(out) = &args.out {
        write(out, c, &args.pairs, global)?;
    }
    Ok(args.acceptance.exit_code(c))
}

fn write(out: &Path, c: &Calibration, pairs: &Path, global: &GlobalArgs) -> Result<(), Failure> {
    let folder = result_folder(out)?;
    let title = pairs.file_stem().unwrap_or_default().to_string_lossy();
    let page = calibration_html(&title, c);
    let written = write_run((out, &folder), None, c, &page, vec![])?;
    if !global.quiet {
        output::note!("report: {}", written.page.display());
    }
    Ok(())
}

/// The published method of that name.
pub fn method(name: &str) -> Result<Method, Failure> {
    Method::from_name(name).ok_or_else(|| {
        let known: Vec<&str> = Method::ALL.iter().map(|m| m.name()).collect();
        Failure::Usage(format!("no method {name:?}; there are {}", known.join(", ")))
    })
}
