//! `handeye solve`: poses in, answer out.

use handeye::{
    Calibration, Config, Method, Warning,
    calibrate::{certificate::certify_result, findings},
};
use handeye_io::read_poses;

use crate::{
    args::{Manners, SolveArgs},
    failure::Failure,
    output,
};

pub fn run(args: &SolveArgs, manners: &Manners) -> Result<u8, Failure> {
    let method = args.method.as_deref().map(method).transpose()?;
    let input = read_poses(&args.pairs)?;
    let mut calibration = input.calibrate(&Config { method, ..Config::default() })?;
    if args.certify {
        certify(&mut calibration);
    }
    show(&calibration, manners);
    Ok(calibration.exit_code())
}

/// Adds the certificate, or a warning that says why there is none.
fn certify(calibration: &mut Calibration) {
    let message = match certify_result(calibration) {
        Ok(Some(found)) => {
            calibration.certificate = Some(found);
            return;
        }
        Ok(None) => "there is no answer, so there is nothing to certify".to_owned(),
        Err(error) => format!("the least-squares fit cannot be certified: {error}"),
    };
    calibration.warnings.push(Warning::new("not-certified", message));
    findings::record(calibration);
}

fn show(calibration: &Calibration, manners: &Manners) {
    if manners.json {
        output::json(calibration);
    } else {
        output::warnings(calibration, manners);
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
