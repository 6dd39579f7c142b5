//! The command line, typed.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;

/// Hand-eye calibration: where the camera sits on the robot, and how sure that is.
///
/// A folder of captures goes in; a transform comes out, with its uncertainty, a verdict, and the
/// evidence. Exit codes: 0 accepted, 1 the input cannot be used, 2 wrong command line, 3 rejected
/// or undetermined (the result is still written).
#[derive(Parser)]
#[command(version, max_term_width = 90)]
pub struct Program {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// How to talk.
    #[command(flatten)]
    pub manners: Manners,
}

/// Options of every command.
#[derive(Args, Clone)]
pub struct Manners {
    /// Print one JSON document on standard output and nothing else there.
    #[arg(long, global = true)]
    pub json: bool,
    /// No progress, no warnings.
    #[arg(long, short, global = true)]
    pub quiet: bool,
}

/// Commands.
#[derive(Subcommand)]
pub enum Command {
    /// Calibrate from a folder of captures with a manifest `handeye.toml`.
    Calibrate(CalibrateArgs),
    /// Solve for the transform from pairs of robot and target poses in a JSON file.
    Solve(SolveArgs),
    /// Write a simulated dataset whose truth is known.
    Simulate(Box<crate::simulate::SimulateArgs>),
    /// Calibrate a small dataset inside the program, and show the report's place.
    Demo(crate::demo::DemoArgs),
    /// Write completions for a shell.
    #[command(
        after_help = "Example:\n  handeye completions bash > ~/.local/share/bash-completion/completions/handeye"
    )]
    Completions {
        /// Which shell.
        shell: Shell,
    },
}

/// Arguments of `solve`.
#[derive(Args)]
#[command(
    after_help = "Example:\n  handeye solve pairs.json\n  handeye solve pairs.json --method park-martin --json\n\n\
pairs.json:\n  {\"setup\": \"eye-in-hand\",\n   \"pairs\": [{\"id\": \"01\",\n     \"base_from_flange\":   {\"translation_m\": [x, y, z], \"rotation_xyzw\": [x, y, z, w]},\n     \"camera_from_target\": {\"translation_m\": [x, y, z], \"rotation_xyzw\": [x, y, z, w]}}, ...]}"
)]
pub struct SolveArgs {
    /// JSON file with `setup` and `pairs`.
    pub pairs: PathBuf,
    /// Run one published method as published: shah, park-martin, daniilidis.
    #[arg(long)]
    pub method: Option<String>,
}

/// Arguments of `calibrate`.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  handeye calibrate cell/\n  handeye calibrate cell/ --out result --format ros2 --format kuka\n  handeye calibrate cell.toml --root /data/cell --json"
)]
pub struct CalibrateArgs {
    /// Folder with `handeye.toml`, or a manifest.
    pub dataset: PathBuf,
    /// Where the manifest's names are relative to, if not to its own folder.
    #[arg(long)]
    pub root: Option<PathBuf>,
    /// Folder for calibration.json, report.html and exports; it is made if need be.
    #[arg(long, short)]
    pub out: Option<PathBuf>,
    /// Run one published method as published: shah, park-martin, daniilidis.
    #[arg(long)]
    pub method: Option<String>,
    /// Nearest-neighbour candidate of the two-step refinement: most iterations.
    #[arg(long, default_value_t = 50)]
    pub icp_max_iterations: usize,
    /// The same: matches farther apart are dropped, mm.
    #[arg(long, default_value_t = 10.0)]
    pub icp_max_distance_mm: f64,
    /// The same: it stops when a round changes less than this (rad, m).
    #[arg(long, default_value_t = 1e-9)]
    pub icp_epsilon: f64,
}
