//! The `handeye` program: from a folder of captures to a camera-to-robot transform to trust.

mod args;
mod bag;
mod boards;
mod calibrate;
mod check;
mod compare;
mod compensate;
mod demo;
mod detect;
mod difference;
mod export;
mod failure;
mod halves;
mod import;
mod init;
mod output;
mod poses;
mod progress;
mod register;
mod simulate;
mod solve;
mod target;
mod tcp;
mod verify;
mod view;

use std::{env, process::ExitCode};

use clap::Parser;
use serde_json::json;

use args::{Command, Program};
use failure::Failure;

fn main() -> ExitCode {
    let program = match Program::try_parse() {
        Ok(program) => program,
        Err(error) => return not_a_command(&error),
    };
    match run(&program) {
        Ok(_) if output::lost() => ExitCode::FAILURE,
        Ok(code) => ExitCode::from(code),
        Err(failure) => {
            failure.tell(program.global.json);
            ExitCode::from(failure.exit_code())
        }
    }
}

/// Help that was asked for, or a command line that is wrong.
fn not_a_command(error: &clap::Error) -> ExitCode {
    if error.use_stderr() && env::args_os().any(|word| word == "--json") {
        let text = error.render().to_string();
        let message = text.split("\n\n").next().unwrap_or_default().trim_start_matches("error: ");
        let words: Vec<&str> = message.split_whitespace().collect();
        output::json(&json!({ "error": Failure::Usage(words.join(" ")).json() }));
    }
    error.exit()
}

fn run(program: &Program) -> Result<u8, Failure> {
    match &program.command {
        Command::Calibrate(args) => calibrate::run(args, &program.global),
        Command::Solve(args) => solve::run(args, &program.global),
        Command::Export(args) => export::run(args, &program.global),
        Command::Init(args) => init::run(args, &program.global),
        Command::Import(args) => import::run(args, &program.global),
        Command::Bag(args) => bag::run(args, &program.global),
        Command::Target(args) => target::run(args, &program.global),
        Command::Compare(args) => compare::run(args, &program.global),
        Command::Compensate(args) => compensate::run(args, &program.global),
        Command::Tcp(args) => tcp::run(args, &program.global),
        Command::Verify(args) => verify::run(args, &program.global),
        Command::Check(args) => check::run(args, &program.global),
        Command::Register(args) => register::run(args, &program.global),
        Command::View(args) => view::run(args, &program.global),
        Command::Detect(args) => detect::run(args, &program.global),
        Command::Simulate(args) => simulate::run(args, &program.global),
        Command::Demo(args) => demo::run(args, &program.global),
        Command::Completions { shell } => {
            output::completions(*shell);
            Ok(0)
        }
    }
}
