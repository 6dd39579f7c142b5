//! `handeye solve`: poses in, answer out.

use handeye::{Calibration, Config, Method};
use handeye_io::read_poses;

use crate::{
    args::{GlobalArgs, SolveArgs},
    failure::Failure,
    output,
};

pub fn run(args: &SolveArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let method = args.method.as_deref().map(method).transpose()?;
    let input = read_poses(&args.pairs)?;
    let calibration = input.calibrate(&Config { method, ..Config::default() })?;
    let calibration = if args.certify { calibration.certified() } else { calibration };
    show(&calibration, global);
    Ok(calibration.exit_code())
}

fn show(calibration: &Calibration, global: &GlobalArgs) {
    if global.json {
        output::json(calibration);
    } else {
        output::warnings(calibration, global);
        output::summary(calibration);
    }
}

/// The published method of that name.
pub fn method(name: &str) -> Result<Method, Failure> {
    Method::from_name(name).ok_or_else(|| {
        let known: Vec<&str> = Method::ALL.iter().map(|m| m.name()).collect();
        Failure::Usage(format!("no method {name:?}; there are {}", known.join(", ")))
    })
}
