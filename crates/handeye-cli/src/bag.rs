//! `handeye bag`: what a ROS bag holds, or a folder of captures out of it.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use handeye_io::{
    bag::{self, BagContents, BagOptions, Motion, RobotSource, Stamps},
    read_targets,
};

use crate::{args::GlobalArgs, failure::Failure, output, simulate::SetupArg};

/// Arguments of `bag`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye bag session.mcap\n\
\x20 handeye bag session.mcap --out cell --target board.toml --setup eye-in-hand \\\n\
\x20     --base base_link --flange tool0\n\
\x20 handeye calibrate cell\n\
\n\
MCAP and SQLite bags of ROS 2 and bags of ROS 1 are read, of a file or a folder, and also \
those that were not closed. The robot's pose is interpolated to the time of each image, \
never over a gap. Where the robot stood still, one image of each place is taken; otherwise \
many of the motion, and the time offset between camera and robot is estimated.")]
pub struct BagArgs {
    /// The bag: a file, or its folder.
    pub bag: PathBuf,
    /// Folder for the captures; without it, the bag's contents are shown.
    #[arg(long, short)]
    pub out: Option<PathBuf>,
    /// A TOML file with the `[target]` that the camera sees.
    #[arg(long)]
    pub target: Option<PathBuf>,
    /// Where the camera is mounted.
    #[arg(long, value_enum)]
    pub setup: Option<SetupArg>,
    /// Topic of the images, where there are several.
    #[arg(long, value_name = "TOPIC")]
    pub image: Option<String>,
    /// Topic of the depth images or clouds, where there are several.
    #[arg(long, value_name = "TOPIC")]
    pub depth: Option<String>,
    /// Topic of the camera's intrinsics, where it does not lie beside the images.
    #[arg(long, value_name = "TOPIC")]
    pub camera_info: Option<String>,
    /// Frame (or link of the model) of the robot's base.
    #[arg(long, value_name = "FRAME")]
    pub base: Option<String>,
    /// Frame (or link of the model) of the robot's flange.
    #[arg(long, value_name = "FRAME")]
    pub flange: Option<String>,
    /// Topic of poses of the flange in the base, in place of transforms.
    #[arg(long, value_name = "TOPIC", conflicts_with_all = ["base", "flange"])]
    pub pose: Option<String>,
    /// Joint values in place of transforms, of this topic where there are several; needs --base
    /// and --flange, and a URDF or a robot_description in the bag.
    #[arg(long, value_name = "TOPIC", num_args = 0..=1)]
    pub joints: Option<Option<String>>,
    /// The robot's model for --joints, where the bag has none.
    #[arg(long, value_name = "FILE", requires = "joints")]
    pub urdf: Option<PathBuf>,
    /// Whether the robot stood still for its images.
    #[arg(long, value_enum, default_value_t)]
    pub motion: MotionArg,
    /// Maximum number of images while the robot moves.
    #[arg(long, default_value_t = 150, value_parser = clap::value_parser!(u16).range(2..))]
    pub most: u16,
    /// Which time of a message counts: of its header, or of its recording.
    #[arg(long, value_enum, default_value_t)]
    pub stamps: StampsArg,
}

#[derive(Clone, Copy, Default, ValueEnum)]
pub enum MotionArg {
    /// Still where the robot stood still at six places and more.
    #[default]
    Auto,
    Still,
    Moving,
}

#[derive(Clone, Copy, Default, ValueEnum)]
pub enum StampsArg {
    #[default]
    Header,
    Recorded,
}

pub fn run(args: &BagArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    // a name that is mistyped is said before what options lack
    std::fs::metadata(&args.bag)
        .map_err(|source| handeye_io::Error::Read { path: args.bag.clone(), source })?;
    let Some(out) = &args.out else {
        show(&bag::contents(&args.bag, &|| ())?, global);
        return Ok(0);
    };
    let options = options(args)?;
    let done = bag::extract(&args.bag, out, &options, &|| ())?;
    if global.json {
        output::json(&done);
        return Ok(0);
    }
    let mut text = format!("{}: {} captures\n\n", out.display(), done.captures);
    text += &done.notes.iter().map(|n| output::wrapped("  ", n)).collect::<String>();
    text += &match done.questions.is_empty() {
        true => format!("\nnext: handeye calibrate {}\n", output::word(out)),
        false => {
            let all: String = done.questions.iter().map(|q| output::wrapped("  ", q)).collect();
            format!("\nanswer in {}:\n\n{all}", out.join(handeye_io::MANIFEST).display())
        }
    };
    output::print(&text);
    Ok(0)
}

fn options(args: &BagArgs) -> Result<BagOptions, Failure> {
    Ok(BagOptions {
        setup: args.setup.map(Into::into),
        target: args.target.as_deref().map(read_targets).transpose()?,
        image: args.image.clone(),
        depth: args.depth.clone(),
        camera: args.camera_info.clone(),
        robot: robot(args)?,
        urdf: args.urdf.clone(),
        motion: match args.motion {
            MotionArg::Auto => Motion::Auto,
            MotionArg::Still => Motion::Still,
            MotionArg::Moving => Motion::Moving,
        },
        most: usize::from(args.most),
        stamps: match args.stamps {
            StampsArg::Header => Stamps::Header,
            StampsArg::Recorded => Stamps::Recorded,
        },
    })
}

fn robot(args: &BagArgs) -> Result<RobotSource, Failure> {
    if let Some(topic) = args.pose.clone() {
        return Ok(RobotSource::Poses { topic });
    }
    let (Some(base), Some(flange)) = (args.base.clone(), args.flange.clone()) else {
        let what = format!(
            "say where the robot's poses are: --base FRAME and --flange FRAME, as --base base_link --flange tool0, or \
             --pose TOPIC; `handeye bag {}` shows the frames and topics",
            args.bag.display()
        );
        return Err(Failure::Usage(what));
    };
    Ok(match args.joints.clone() {
        Some(topic) => RobotSource::Joints { topic, base, flange },
        None => RobotSource::Frames { base, flange },
    })
}

fn show(contents: &BagContents, global: &GlobalArgs) {
    if global.json {
        output::json(contents);
        return;
    }
    let BagContents { topics, frames, joints, has_robot_description, broken } = contents;
    let mut text = String::from("topics\n");
    for (name, t) in topics {
        let about: Vec<&str> =
            [t.shape.as_deref(), t.frame.as_deref()].into_iter().flatten().collect();
        let about =
            if about.is_empty() { String::new() } else { format!(" ({})", about.join("; ")) };
        text += &output::wrapped("  ", &format!("{name}  {} x {}{about}", t.messages, t.kind));
    }
    if !frames.is_empty() {
        text += "\nframes\n";
        text += &frames.iter().map(|line| format!("  {line}\n")).collect::<String>();
    }
    for (topic, names) in joints {
        text += &format!("\njoints on {topic}\n{}", output::wrapped("  ", &names.join(", ")));
    }
    if *has_robot_description {
        text += "\nholds a model of the robot (robot_description)\n";
    }
    for what in broken {
        text += &format!("\n{}", output::wrapped("broken: ", what));
    }
    output::print(&text);
}
