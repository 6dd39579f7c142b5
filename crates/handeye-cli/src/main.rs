//! The `handeye` program: from a folder of captures to a camera-to-robot transform to trust.

mod args;
mod calibrate;
mod demo;
mod failure;
mod output;
mod progress;
mod report;
mod simulate;
mod solve;

use std::process::ExitCode;

use clap::Parser;

use args::{Command, Program};
use failure::Failure;

fn main() -> ExitCode {
    let program = Program::parse();
    match run(&program) {
        Ok(code) => ExitCode::from(code),
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::from(failure.exit_code())
        }
    }
}

fn run(program: &Program) -> Result<u8, Failure> {
    match &program.command {
        Command::Calibrate(args) => calibrate::run(args, &program.manners),
        Command::Solve(args) => solve::run(args, &program.manners),
        Command::Simulate(args) => simulate::run(args, &program.manners),
        Command::Demo(args) => demo::run(args, &program.manners),
        Command::Completions { shell } => {
            output::completions(*shell);
            Ok(0)
        }
    }
}
