//! `handeye solve`: poses in, answer out.

use std::path::Path;

use handeye::{Calibration, Config, Method};
use handeye_io::{
    PosesFile,
    calibrate::{made_from_file, write_run},
    is_pairs_table, read_pairs_table, read_poses,
    report::calibration_html,
};

use crate::{
    args::{GlobalArgs, SolveArgs},
    calibrate::result_folder,
    failure::Failure,
    methods, output,
};

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
    match (is_pairs_table(&args.pairs), args.setup) {
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
