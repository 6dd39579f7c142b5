//! The `handeye` program as a library: [`main`] is all of it, on the terminal; [`captured`] the same for a program that
//! wants to read what it prints. The command of the Python package is this, too.

mod args;
mod bag;
mod boards;
mod browser;
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
mod methods;
mod output;
mod plan;
mod poses;
mod progress;
mod register;
#[cfg(feature = "session")]
mod session;
mod simulate;
mod solve;
mod target;
mod tcp;
mod verify;
mod view;

use std::ffi::OsString;

use clap::Parser;
use serde_json::json;

use args::{Command, Program};
use failure::Failure;

/// Runs a command line, the program's name its first word; returns the exit code.
pub fn main<W: Into<OsString> + Clone>(words: impl IntoIterator<Item = W>) -> u8 {
    let words: Vec<OsString> = words.into_iter().map(Into::into).collect();
    let program = match Program::try_parse_from(&words) {
        Ok(program) => program,
        Err(error) => return not_a_command(&error, &words),
    };
    match run(&program) {
        Ok(_) if output::lost() => 1,
        Ok(code) => code,
        Err(failure) => {
            failure.tell(program.global.json);
            failure.exit_code()
        }
    }
}

/// What a command has printed, and its exit code.
pub struct Captured {
    /// 0 accepted, 1 the input cannot be used, 2 wrong command line, 3 rejected or undetermined, 4 with
    /// `--strict` accepted with findings that changed the answer.
    pub code: u8,
    /// Standard output: with `--json` one document.
    pub out: String,
    /// Standard error: warnings and messages.
    pub err: String,
}

/// Runs a command line in this thread, and hands over what it prints.
pub fn captured<W: Into<OsString> + Clone>(words: impl IntoIterator<Item = W>) -> Captured {
    let (code, out, err) = output::captured(|| main(words));
    Captured { code, out, err }
}

/// Help that was asked for, or a command line that is wrong.
fn not_a_command(error: &clap::Error, words: &[OsString]) -> u8 {
    let text = error.render().to_string();
    if !error.use_stderr() {
        output::print(&text);
        return u8::from(output::lost());
    }
    if words.iter().any(|word| word == "--json") {
        let message = text.split("\n\n").next().unwrap_or_default().trim_start_matches("error: ");
        let words: Vec<&str> = message.split_whitespace().collect();
        output::json(&json!({ "error": Failure::Usage(words.join(" ")).json() }));
    }
    output::to_stderr(format_args!("{text}"));
    2
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
        Command::Plan(args) => plan::run(args, &program.global),
        #[cfg(feature = "session")]
        Command::Session(args) => session::run(args, &program.global),
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
