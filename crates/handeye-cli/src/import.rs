//! `handeye import`: what other programs recorded or found, described by a file of ours.

use std::{
    fs,
    path::{Path, PathBuf},
};

use clap::Args;
use handeye_io::{Declared, Direction, import, write_atomically};
use serde_json::json;

use crate::{
    args::{GlobalArgs, Length},
    failure::Failure,
    output,
    simulate::SetupArg,
};

/// Arguments of `import`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye import cell.samples.yaml && handeye calibrate .\n\
\x20 handeye import pose_samples.json --setup eye-to-hand\n\
\x20 handeye import flange.csv board.csv --setup eye-in-hand \\\n\
\x20     --direction base_from_flange\n\
\x20 handeye import kinhec/ --sequence temporal-000001\n\
\x20 handeye import old.calib\n\
\x20 handeye verify flange_from_camera.json touches.csv --tolerance-mm 1\n\
\n\
Data sets get a manifest, handeye.toml: samples of easy_handeye2 and moveit_calibration, \
cal_data.yaml of robot_cal_tools, sets of industrial_calibration, manifests of \
calibration-rs, Tabb's layout, Zivid's, folders of HALCON's poses.\n\
\n\
Trajectories of robot and camera, \
 lines of t x y z qx qy qz qw (s, m; apart by commas or blanks), and KinHEC become \
JSON for `solve`. Name both files, or a folder with the two. Of their directions one must be \
declared; the data prove the other.\n\
\n\
Results become the camera's pose as JSON, for `verify`, \
`export`, `compare` and `view`: easy_handeye, easy_handeye2, launch files of \
moveit_calibration and ROS 2, Zivid, OpenCV, HALCON, Mech-Mind.\n\
\n\
Other folders: handeye init.")]
pub struct ImportArgs {
    /// File or folder to import; for two trajectories, the robot's file.
    pub source: PathBuf,
    /// The camera's trajectory.
    pub camera: Option<PathBuf>,
    /// Where the camera is mounted, where the files do not say it.
    #[arg(long, value_enum)]
    pub setup: Option<SetupArg>,
    /// Direction of the poses, where the files do not state it: base_from_flange (where the flange is),
    /// camera_from_target (what OpenCV's solvePnP gives), of a result flange_from_camera or
    /// base_from_camera; or the other way round.
    #[arg(long, value_delimiter = ',', value_name = "A_FROM_B")]
    pub direction: Vec<String>,
    /// Which sequence of a KinHEC folder.
    #[arg(long, value_name = "ID")]
    pub sequence: Option<String>,
    /// Unit of positions, where neither the file nor its program says it.
    #[arg(long)]
    pub length_unit: Option<Length>,
    /// File or folder to write, if not beside the source.
    #[arg(long, short)]
    pub out: Option<PathBuf>,
    /// Overwrite an existing file.
    #[arg(long)]
    pub force: bool,
}

pub fn run(args: &ImportArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let imported = import(&args.source, &declared(args)?)?;
    let folder = args.out.as_deref().unwrap_or(&imported.folder);
    let ending = Path::new(&imported.name).extension();
    let is_file = args.out.is_some() && !folder.is_dir() && folder.extension() == ending;
    let path = if is_file { folder.to_path_buf() } else { folder.join(&imported.name) };
    if path.exists() && !args.force {
        let what = "is there already; to write over it: --force";
        return Err(Failure::in_the_way(path, what));
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    if !folder.as_os_str().is_empty() {
        fs::create_dir_all(folder).map_err(|e| Failure::no_folder(folder, e))?;
    }
    write_atomically(&path, imported.text_in(folder)?.as_bytes())?;
    let next = imported.next.replace("{}", &output::word(&path));
    if global.json {
        let key = if imported.name == handeye_io::MANIFEST { "manifest" } else { "file" };
        output::json(&json!({
            "layout": imported.layout,
            key: path,
            "questions": imported.questions,
            "notes": imported.notes,
            "next": next,
        }));
        return Ok(0);
    }
    let mut text = format!("{}: {} is written", imported.layout, path.display());
    text += if imported.questions.is_empty() { "\n" } else { "; answer in it:\n\n" };
    let lines = imported.questions.iter().chain(&imported.notes);
    text += &lines.map(|line| output::wrapped("  ", line)).collect::<String>();
    if imported.questions.is_empty() {
        text += &format!("\nnext: {next}\n");
    }
    output::print(&text);
    Ok(0)
}

fn declared(args: &ImportArgs) -> Result<Declared, Failure> {
    let direction = |name: &String| {
        Direction::named(name)
            .map_err(|e| Failure::Usage(format!("--direction {name} is not known; {e}")))
    };
    Ok(Declared {
        setup: args.setup.map(Into::into),
        camera: args.camera.clone(),
        directions: args.direction.iter().map(direction).collect::<Result<_, _>>()?,
        sequence: args.sequence.clone(),
        length_unit: args.length_unit.map(Into::into),
    })
}
