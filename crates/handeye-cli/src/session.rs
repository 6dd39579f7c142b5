//! `handeye session`: a guided live calibration.

use std::{fs, net::IpAddr, path::PathBuf};

use clap::Args;
use handeye::Setup;
use handeye_io::{Place, SessionFolder, process, temporary_folder};
use handeye_session::{
    engine::view::State,
    host::Host,
    live::Live,
    script::{Action, Player},
    server::Server,
    sources::virtual_cell::{Faults, VirtualCell},
};

use crate::{args::GlobalArgs, browser, failure::Failure, output};

/// Arguments of `session`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye session --virtual\n\
\x20 handeye session cell/ --virtual 7 --no-open\n\
\x20 handeye session cell/ --virtual --headless --script steps.json --json\n\
\n\
The folder is an ordinary dataset at any moment: `handeye calibrate FOLDER` gives the same result. Exit code of a script: \
that of its last result, 1 where a step was refused.")]
pub struct SessionArgs {
    /// Folder of the session: new, empty, or one that a session has written [default: a temporary folder].
    pub folder: Option<PathBuf>,
    /// A virtual cell in place of camera and robot, with this seed.
    #[arg(long = "virtual", value_name = "SEED", num_args = 0..=1, default_missing_value = "1", required = true)]
    pub seed: Option<u64>,
    /// Setup of the virtual cell: eye-in-hand or eye-to-hand.
    #[arg(long, value_name = "SETUP", default_value = "eye-in-hand", value_parser = setup)]
    pub setup: Setup,
    /// Play a script instead of serving a page.
    #[arg(long, requires = "script")]
    pub headless: bool,
    /// JSON file with the steps of a script.
    #[arg(long, value_name = "FILE", requires = "headless")]
    pub script: Option<PathBuf>,
    /// Port of the page [default: one that is free].
    #[arg(long, default_value_t = 0)]
    pub port: u16,
    /// Address on which other machines can open the page, such as 0.0.0.0.
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1")]
    pub listen: IpAddr,
    /// Do not open a browser.
    #[arg(long)]
    pub no_open: bool,
}

fn setup(name: &str) -> Result<Setup, String> {
    match name {
        "eye-in-hand" => Ok(Setup::EyeInHand),
        "eye-to-hand" => Ok(Setup::EyeToHand),
        other => Err(format!("{other} is neither eye-in-hand nor eye-to-hand")),
    }
}

pub fn run(args: &SessionArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let path = args
        .folder
        .clone()
        .unwrap_or_else(|| temporary_folder().join(format!("handeye-session-{}", process())));
    let seed = args.seed.unwrap_or(1);
    let cell = VirtualCell::new(args.setup, seed, Faults::default())
        .map_err(|e| Failure::input("the virtual cell", e))?;
    let folder = SessionFolder::open(&path, Some(&cell.settings()))?;
    if *folder.settings() != cell.settings() && folder.settings().guess != cell.settings().guess {
        let what = "is the session of another cell: give the seed and setup that it began with";
        return Err(Failure::Usage(format!("{}: {what}", path.display())));
    }
    let host = Host::new(folder);
    match &args.script {
        Some(script) => play(&mut Player::new(host, cell), script, global),
        None => serve(Live::begin(host, cell), args, global),
    }
}

fn play(player: &mut Player, script: &PathBuf, global: &GlobalArgs) -> Result<u8, Failure> {
    let text = fs::read_to_string(script)
        .map_err(|source| handeye_io::Error::Read { path: script.clone(), source })?;
    let actions: Vec<Action> = serde_json::from_str(&text).map_err(|e| {
        let (what, advice) =
            (format!("is no script: {e}"), "it is a list of commands like {\"do\": \"take\"}");
        handeye_io::Error::Malformed { place: Place::file(script), what, advice: advice.into() }
    })?;
    let played = player.play(&actions);
    let state = player.state();
    if global.json {
        output::json(&state);
    } else {
        output::print(&summary(&state));
    }
    if let Err(why) = played {
        return Err(Failure::Usage(format!("{}: {why}", script.display())));
    }
    let accepted = state.progress.is_some_and(|p| p.verdict == handeye::Verdict::Accepted);
    Ok(if accepted { 0 } else { 3 })
}

fn summary(state: &State) -> String {
    let mut text = format!("{} captures in {}\n", state.captures.len(), state.folder);
    for (count, mm) in state.progress.iter().flat_map(|p| &p.history) {
        text += &format!("  after {count}: {mm:.2} mm (95 %)\n");
    }
    text + &state.say + "\n"
}

fn serve(live: Live, args: &SessionArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let no_port = |e: std::io::Error| {
        Failure::Usage(format!("cannot listen on {} port {}: {e}", args.listen, args.port))
    };
    let folder = live.folder().display().to_string();
    let server = Server::bind(live, args.listen, args.port).map_err(no_port)?;
    let address = server.address().map_err(no_port)?;
    if !global.quiet {
        output::note!("folder: {folder}");
        if !args.listen.is_loopback() {
            output::note!(
                "other machines on the network can open the page with the token in its address"
            );
        }
    }
    output::print(&format!("session: {address}\n"));
    if !args.no_open {
        browser::open_address(&address);
    }
    server.serve().map_err(no_port)?;
    Ok(0)
}
