//! The `handeye` program: from a folder of captures to a camera-to-robot transform to trust.

use std::{env, process::ExitCode};

fn main() -> ExitCode {
    ExitCode::from(handeye_cli::main(env::args_os()))
}
