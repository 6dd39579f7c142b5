//! The `handeye` program: from a folder of captures to a camera-to-robot transform to trust.

mod args;
mod calibrate;
mod demo;
mod detect;
mod export;
mod failure;
mod init;
mod output;
mod progress;
mod repeat;
mod report;
mod simulate;
mod solve;
mod target;

use std::process::ExitCode;

use clap::Parser;

use args::{Command, Program};
use failure::Failure;

fn main() -> ExitCode {
    let program = Program::parse();
    match run(&program) {
        Ok(_) if output::lost() => ExitCode::FAILURE,
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
        Command::Export(args) => export::run(args, &program.manners),
        Command::Init(args) => init::run(args, &program.manners),
        Command::Target(args) => target::run(args, &program.manners),
        Command::Repeat(args) => repeat::run(args, &program.manners),
        Command::Detect(args) => detect::run(args, &program.manners),
        Command::Simulate(args) => simulate::run(args, &program.manners),
        Command::Demo(args) => demo::run(args, &program.manners),
        Command::Completions { shell } => {
            output::completions(*shell);
            Ok(0)
        }
    }
}
