//! `handeye session`: a guided live calibration.

use std::{
    fs,
    net::{IpAddr, SocketAddr, TcpListener},
    path::PathBuf,
};

use clap::Args;
use handeye::{Setup, TargetModel};
use handeye_io::{
    CellSettings, Place, ScanSettings, SessionFolder, Writing, plan::UrdfOption, process,
    read_intrinsics, read_target, temporary_folder,
};
use handeye_session::{
    engine::shown::State,
    host::Host,
    live::{Camera, Cell, Live},
    script::{Action, Player},
    server::{Server, line},
    sources::{
        command,
        ur_rtde::UrRobot,
        virtual_cell::{Faults, VirtualCell},
    },
};

use crate::{
    args::{ArmArgs, GlobalArgs, Length},
    browser,
    failure::Failure,
    output,
};

/// Arguments of `session`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye session --virtual\n\
\x20 handeye session cell/ --images-from /mnt/camera --notation kuka --target board.toml\n\
\x20 handeye session cell/ --camera-command 'python grab.py {out}' --intrinsics camera.yaml\n\
\x20 handeye session cell/ --upload --notation abb\n\
\x20 handeye session cell/ --ur 192.168.1.5 --images-from /mnt/camera --target board.toml\n\
\x20 handeye session cell/ --ur 192.168.1.5 --urdf ur10e.urdf --base-link base --images-from /mnt/camera\n\
\x20 handeye session cell/ --virtual 7 --headless --script steps.json --json\n\
\n\
The folder is an ordinary dataset at any moment: `handeye calibrate FOLDER` gives the same result. Exit code of a script: \
that of its last result, 1 where a step was refused.")]
pub struct SessionArgs {
    /// Folder of the session: new, empty, or one that a session has written [default: a temporary folder].
    pub folder: Option<PathBuf>,
    /// A virtual cell in place of camera and robot, with this seed.
    #[arg(long = "virtual", value_name = "SEED", num_args = 0..=1, default_missing_value = "1")]
    pub seed: Option<u64>,
    /// Folder in which another program saves images; poses are typed on the page, or come by --ur or --robot.
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["seed", "camera_command"])]
    pub images_from: Option<PathBuf>,
    /// Command that takes an image and writes it to {out}; poses are typed on the page, or come by --ur or --robot.
    #[arg(long, value_name = "COMMAND", conflicts_with = "seed")]
    pub camera_command: Option<String>,
    /// Images are uploaded on the page (files, or the browser's own camera) or by HTTP; poses are typed, or come by --ur or
    /// --robot.
    #[arg(long, conflicts_with_all = ["seed", "images_from", "camera_command"])]
    pub upload: bool,
    /// A scan comes with each image, in m, cm, mm or inch: beside it in the folder under the same name, or written by the
    /// command to {scan} (PLY), {scan.pcd} and the like.
    #[arg(long, value_name = "UNIT", hide_possible_values = true, conflicts_with_all = ["seed", "upload"])]
    pub scan_unit: Option<Length>,
    /// A depth image comes with each image likewise ({scan.tif}, {scan.npy}): metres per unit of depth.
    #[arg(long, value_name = "METRES", conflicts_with_all = ["seed", "upload"])]
    pub depth_scale: Option<f64>,
    /// Who carries the camera: eye-in-hand (the robot, by default) or eye-to-hand.
    #[arg(long, value_name = "SETUP", value_parser = setup)]
    pub setup: Option<Setup>,
    /// Manifest or other TOML file with a `[target]` [default: a checkerboard, to be changed on the page].
    #[arg(long, value_name = "FILE", conflicts_with = "seed")]
    pub target: Option<PathBuf>,
    /// File of the camera's intrinsics [default: calibrated from the views].
    #[arg(long, value_name = "FILE", conflicts_with = "seed")]
    pub intrinsics: Option<PathBuf>,
    /// How poses are typed and shown, such as kuka or abb [default: ur].
    #[arg(long, value_name = "MAKER")]
    pub notation: Option<String>,
    /// Error that is tolerated (95 %) [default: 0.5].
    #[arg(long, value_name = "MM")]
    pub tolerance_mm: Option<f64>,
    /// Play a script in a virtual cell instead of serving a page.
    #[arg(long, requires = "script", requires = "seed")]
    pub headless: bool,
    /// JSON file with the steps of a script.
    #[arg(long, value_name = "FILE", requires = "headless")]
    pub script: Option<PathBuf>,
    /// Port of the page [default: one that is free].
    #[arg(long)]
    pub port: Option<u16>,
    /// Address on which other machines can open the page, such as 0.0.0.0.
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1")]
    pub listen: IpAddr,
    /// Universal Robots arm whose poses are read by RTDE, such as 192.168.1.5 (port 30004 where none is said); it cannot be
    /// moved by that.
    #[arg(long, value_name = "HOST[:PORT]", conflicts_with_all = ["seed", "robot"])]
    pub ur: Option<UrRobot>,
    /// Address and port at which the robot's own program asks, such as 0.0.0.0:7777; it sends lines like `pose 612.3 -4.1
    /// 233 10 20 -170`.
    #[arg(long, value_name = "ADDRESS:PORT", conflicts_with = "seed")]
    pub robot: Option<SocketAddr>,
    /// The robot's model; it is copied into the folder.
    #[command(flatten)]
    pub arm: ArmArgs,
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
    if args.depth_scale.is_some_and(|scale| !(scale > 0.0 && scale.is_finite())) {
        return Err(Failure::Usage("--depth-scale must be positive".into()));
    }
    if args.tolerance_mm.is_some_and(|mm| !(mm > 0.0 && mm.is_finite())) {
        return Err(Failure::Usage("--tolerance-mm must be positive".into()));
    }
    let path = args
        .folder
        .clone()
        .unwrap_or_else(|| temporary_folder().join(format!("handeye-session-{}", process())));
    let urdf = args.arm.option();
    // what is wrong in it is said before a folder is begun
    urdf.as_ref().map(UrdfOption::read).transpose()?;
    let cell = cell(args)?;
    let usual = match &cell {
        Cell::Virtual(cell) => cell.settings(),
        Cell::Hand(_) | Cell::Ur(..) => usual(),
    };
    let mut folder = SessionFolder::open(&path, Some(&with_options(usual.clone(), args)?))?;
    if matches!(cell, Cell::Virtual(_)) && !folder.settings().is_of_same_cell(&usual) {
        let what = "is the session of another cell: give the seed and setup that it began with";
        return Err(Failure::Usage(format!("{}: {what}", path.display())));
    }
    // what is said now comes before what was said when the session began
    let settings = with_options(folder.settings().clone(), args)?;
    if settings != *folder.settings() {
        folder.is_of_cell(&settings)?;
        folder.set(&settings)?;
    }
    if let Some(urdf) = &urdf {
        folder.use_urdf(urdf)?;
    }
    let cell = match (cell, folder.urdf()) {
        (Cell::Virtual(cell), Some(urdf)) => Cell::Virtual(Box::new(cell.with_arm(urdf.clone()))),
        (cell, _) => cell,
    };
    let host = Host::new(folder);
    scans_fit(args, &host)?;
    match (&args.script, cell) {
        (Some(script), Cell::Virtual(cell)) => play(&mut Player::new(host, *cell), script, global),
        (_, cell) => serve(Live::begin(host, cell), args, global),
    }
}

/// Refuses scans for some captures only, and a command that does not go with what is said of them.
fn scans_fit(args: &SessionArgs, host: &Host) -> Result<(), Failure> {
    let comes = host.state().settings.scans.is_some();
    let folder = host.path().display();
    let usage = |what: String| Err(Failure::Usage(what));
    match host.has_scans() {
        Some(true) if !comes => usage(format!(
            "{folder}: its captures have a scan each, in metres: say --scan-unit m, and give scans in metres"
        )),
        Some(false) if comes => usage(format!(
            "{folder}: its captures have no scans, and all have one or none: leave out --scan-unit and --depth-scale, or begin in a new folder"
        )),
        _ => match &args.camera_command {
            Some(line) if comes && command::scan_in(line).is_none() => usage(
                "--camera-command: where does it write the scan? It needs {scan} (PLY), or {scan.pcd} and the like".into(),
            ),
            Some(line) if !comes && command::scan_in(line).is_some() => {
                usage("--camera-command: in which unit are its scans? Say --scan-unit mm, or --depth-scale".into())
            }
            _ => Ok(()),
        },
    }
}

/// Where poses and images come from.
fn cell(args: &SessionArgs) -> Result<Cell, Failure> {
    match (args.seed, &args.images_from, &args.camera_command) {
        (Some(seed), ..) => {
            let setup = args.setup.unwrap_or(Setup::EyeInHand);
            let cell = VirtualCell::new(setup, seed, Faults::default());
            Ok(Cell::Virtual(Box::new(cell.map_err(|e| Failure::input("the virtual cell", e))?)))
        }
        (None, Some(folder), _) if !folder.is_dir() => {
            Err(Failure::Usage(format!("{} is not a folder", folder.display())))
        }
        (None, Some(folder), _) => Ok(real(args, Camera::Folder(folder.clone()))),
        (None, None, Some(command)) => Ok(real(args, Camera::Command(command.clone()))),
        (None, None, None) if args.upload => Ok(real(args, Camera::Upload)),
        (None, None, None) => {
            let what = "where do images come from? --virtual (to try it), --images-from FOLDER, --camera-command COMMAND, or --upload";
            Err(Failure::Usage(what.into()))
        }
    }
}

/// A cell with this camera, and the robot that is named or whose poses are typed.
fn real(args: &SessionArgs, camera: Camera) -> Cell {
    match &args.ur {
        Some(robot) => Cell::Ur(robot.clone(), camera),
        None => Cell::Hand(camera),
    }
}

/// A cell of which nothing is said; the page asks.
fn usual() -> CellSettings {
    CellSettings {
        setup: Setup::EyeInHand,
        target: TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 },
        intrinsics: None,
        tolerance_mm: 0.5,
        notation: "ur".into(),
        guess: None,
        tip_mm: None,
        scans: None,
        arm: None,
    }
}

/// Settings with what the command line says.
fn with_options(settings: CellSettings, args: &SessionArgs) -> Result<CellSettings, Failure> {
    let notation = args.notation.clone().unwrap_or_else(|| settings.notation.clone());
    Writing::of(&notation).map_err(Failure::Usage)?;
    let intrinsics = match &args.intrinsics {
        Some(file) => Some(read_intrinsics(file, None, None)?),
        None => settings.intrinsics,
    };
    let target = args.target.as_deref().map(read_target).transpose()?;
    let scans = match (args.scan_unit, args.depth_scale) {
        (None, None) => settings.scans,
        (unit, depth_scale) => {
            Some(ScanSettings { length_unit: unit.map(Into::into), depth_scale })
        }
    };
    Ok(CellSettings {
        scans,
        setup: args.setup.unwrap_or(settings.setup),
        target: target.unwrap_or_else(|| settings.target.clone()),
        intrinsics,
        tolerance_mm: args.tolerance_mm.unwrap_or(settings.tolerance_mm),
        notation,
        ..settings
    })
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
        return Err(Failure::input(script, why));
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
        let port = args.port.map_or("any port".into(), |port| format!("port {port}"));
        Failure::Usage(format!("cannot listen on {}, {port}: {e}", args.listen))
    };
    let folder = live.folder().display().to_string();
    if let Some(address) = args.robot {
        let listener = TcpListener::bind(address).map_err(|e| no_robot(address, &e))?;
        let at = listener.local_addr().map_err(|e| no_robot(address, &e))?;
        line::listen(live.clone(), listener).map_err(|e| no_robot(address, &e))?;
        output::print(&format!("robot: {at}\n"));
    }
    let server = Server::bind(live, args.listen, args.port.unwrap_or(0)).map_err(no_port)?;
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

fn no_robot(address: SocketAddr, error: &std::io::Error) -> Failure {
    Failure::Usage(format!("cannot listen for the robot on {address}: {error}"))
}
