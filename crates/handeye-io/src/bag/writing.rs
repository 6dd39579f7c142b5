//! The files of a dataset that comes from a bag, and the manifest that describes them.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::Path,
};

use handeye::calibrate::result::FrameNames;

use super::{
    Message, Tick,
    extract::{Capture, Extracted, Plan},
    frames,
    messages::{self, CameraInfo},
    pictures::{self, File},
    read,
    robot::{At, Robot},
    survey::{CLOUD, COMPRESSED, IMAGE},
    wire::Wire,
};
use crate::{
    MANIFEST, Targets,
    camera::CameraSpec,
    dataset::{
        Draft, TIMES,
        manifest::{ImagesSpec, MotionSpec, RobotDirection, RobotSpec, ScansSpec},
        shapes::TargetSpec,
    },
    error::{Error, unusable},
    import::WHO_CARRIES,
    robot::UrdfSpec,
    units::{AngleUnit, LengthUnit},
    write_atomically,
};

const CAMERA: &str = "camera.yaml";
const SCAN_CAMERA: &str = "scan_camera.yaml";
const ROBOT: &str = "robot.csv";
const URDF: &str = "robot.urdf";

/// Images or scans: also the name of their folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Images,
    Scans,
}

impl Kind {
    fn folder(self) -> &'static str {
        match self {
            Kind::Images => "images",
            Kind::Scans => "scans",
        }
    }
}

/// The ending of each file that was written, by capture and kind.
type Written = BTreeMap<(String, Kind), &'static str>;

/// Which cameras have files.
#[derive(Default)]
struct Cameras {
    image: bool,
    scan: bool,
}

pub(super) fn write(mut plan: Plan, folder: &Path, tick: &Tick) -> Result<Extracted, Error> {
    let written = pictures(&mut plan, folder, tick)?;
    keep_whole(&mut plan, &written, folder)?;
    let cameras = cameras(&mut plan, folder)?;
    robot_files(&plan, folder)?;
    let (text, questions) = manifest(&plan, &cameras, &written);
    write_atomically(&folder.join(MANIFEST), text.as_bytes())?;
    Ok(Extracted {
        captures: plan.captures.len(),
        moving: plan.moving,
        notes: plan.notes,
        questions,
    })
}

/// Which captures want which message.
type Wanted = BTreeMap<(String, usize), Vec<(String, Kind)>>;

fn wanted(plan: &Plan) -> Wanted {
    let mut all = Wanted::new();
    for Capture { name, moment, scan } in &plan.captures {
        if let Some(topic) = &plan.chosen.image {
            all.entry((topic.clone(), moment.shot.index))
                .or_default()
                .push((name.clone(), Kind::Images));
        }
        if let (Some(topic), Some(scan)) = (&plan.chosen.scan, scan) {
            all.entry((topic.clone(), scan.index)).or_default().push((name.clone(), Kind::Scans));
        }
    }
    all
}

/// Writes all images and scans in one more pass.
fn pictures(plan: &mut Plan, folder: &Path, tick: &Tick) -> Result<Written, Error> {
    let wanted = wanted(plan);
    let (mut counts, mut done, mut broken) =
        (BTreeMap::<String, usize>::new(), Written::new(), vec![]);
    read(plan.bag, tick, &mut |message| {
        let count = counts.entry(message.topic.into()).or_default();
        let index = *count;
        *count += 1;
        for (name, kind) in wanted.get(&(message.topic.into(), index)).into_iter().flatten() {
            match file(message, *kind) {
                Ok((ending, bytes)) => {
                    let path = folder.join(kind.folder()).join(format!("{name}.{ending}"));
                    let made = fs::create_dir_all(folder.join(kind.folder()));
                    made.map_err(|source| Error::Write { path: path.clone(), source })?;
                    write_atomically(&path, &bytes)?;
                    done.insert((name.clone(), *kind), ending);
                }
                Err(what) => {
                    broken.push(format!("message {} of {} {what}", index + 1, message.topic))
                }
            }
        }
        Ok(())
    })?;
    let Some(first) = broken.first() else { return Ok(done) };
    if done.is_empty() {
        return Err(unusable(plan.bag, format!("has no image that can be written: {first}")));
    }
    plan.notes
        .push(format!("{} images or scans cannot be read and are left out: {first}", broken.len()));
    Ok(done)
}

fn file(message: &Message, kind: Kind) -> Result<File, String> {
    let mut wire = Wire::new(message.bytes, message.encoding)?;
    match (message.kind, kind) {
        (IMAGE, Kind::Images) => pictures::picture(&messages::image(&mut wire)?),
        (COMPRESSED, Kind::Images) => pictures::packed(&messages::compressed_image(&mut wire)?),
        (IMAGE, Kind::Scans) => pictures::depth(&messages::image(&mut wire)?),
        (COMPRESSED, Kind::Scans) => {
            pictures::packed_depth(&messages::compressed_image(&mut wire)?)
        }
        (CLOUD, Kind::Scans) => pictures::cloud(&messages::point_cloud(&mut wire)?),
        _ => Err(format!("is a {}", message.kind)),
    }
}

/// Leaves out captures of which not all could be written.
fn keep_whole(plan: &mut Plan, written: &Written, folder: &Path) -> Result<(), Error> {
    let kinds: Vec<Kind> = [(&plan.chosen.image, Kind::Images), (&plan.chosen.scan, Kind::Scans)]
        .into_iter()
        .filter_map(|(topic, kind)| topic.is_some().then_some(kind))
        .collect();
    let whole =
        |c: &Capture| kinds.iter().all(|kind| written.contains_key(&(c.name.clone(), *kind)));
    let (kept, dropped): (Vec<Capture>, Vec<Capture>) =
        std::mem::take(&mut plan.captures).into_iter().partition(whole);
    plan.captures = kept;
    for capture in dropped {
        for kind in &kinds {
            let Some(ending) = written.get(&(capture.name.clone(), *kind)) else { continue };
            let path = folder.join(kind.folder()).join(format!("{}.{ending}", capture.name));
            fs::remove_file(&path).map_err(|source| Error::Write { path, source })?;
        }
    }
    Ok(())
}

/// Writes the cameras' files.
fn cameras(plan: &mut Plan, folder: &Path) -> Result<Cameras, Error> {
    let chosen = plan.chosen.clone();
    let mut found = Cameras::default();
    if let (Some(topic), Some(image)) = (&chosen.image_camera, &chosen.image) {
        found.image = camera(plan, topic, image, &folder.join(CAMERA))?;
    }
    let is_own = chosen.scan_camera != chosen.image_camera;
    if let (Some(topic), Some(scan), true) = (&chosen.scan_camera, &chosen.scan, is_own) {
        found.scan = camera(plan, topic, scan, &folder.join(SCAN_CAMERA))?;
    }
    Ok(found)
}

fn camera(plan: &mut Plan, topic: &str, pictures: &str, path: &Path) -> Result<bool, Error> {
    let info = &plan.survey.cameras[topic];
    if info.matrix[0] == 0.0 {
        plan.notes.push(format!("{topic} is of a camera that is not calibrated, and is not used"));
        return Ok(false);
    }
    let rectified = pictures.split('/').any(|part| part.starts_with("image_rect"));
    if rectified && info.projection[0] == 0.0 {
        plan.notes.push(format!(
            "{pictures} is rectified, as its name says, and {topic} does not tell its projection (P): the camera is not used"
        ));
        return Ok(false);
    }
    if rectified {
        let text = format!(
            "{pictures} is rectified, as its name says: of {topic} the projection holds, without distortion"
        );
        plan.notes.push(text);
    }
    write_atomically(path, camera_yaml(info, rectified).as_bytes())?;
    Ok(true)
}

/// As ROS keeps its cameras in files, for the part of the sensor and the binning that the images have.
fn camera_yaml(info: &CameraInfo, rectified: bool) -> String {
    let [left, top, height, width] = info.region.map(f64::from);
    let [bin_x, bin_y] = info.binning.map(|b| f64::from(b.max(1)));
    let (p, k) = (&info.projection, &info.matrix);
    let [fx, cx, fy, cy] =
        if rectified { [p[0], p[2], p[5], p[6]] } else { [k[0], k[2], k[4], k[5]] };
    let size = |whole: u32, part: f64, bin: f64| {
        ((if part > 0.0 { part } else { f64::from(whole) }) / bin) as u32
    };
    // the centre of a pixel of several lies between theirs
    let centre = |c: f64, start: f64, bin: f64| (c - start + 0.5) / bin - 0.5;
    let matrix = [
        fx / bin_x,
        0.0,
        centre(cx, left, bin_x),
        0.0,
        fy / bin_y,
        centre(cy, top, bin_y),
        0.0,
        0.0,
        1.0,
    ];
    let distortion = if rectified { vec![] } else { info.distortion.clone() };
    let list = |all: &[f64]| all.iter().map(|v| format!("{v:?}")).collect::<Vec<_>>().join(", ");
    format!(
        "image_width: {}\nimage_height: {}\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [{}]\ndistortion_model: {}\n\
         distortion_coefficients:\n  rows: 1\n  cols: {}\n  data: [{}]\n",
        size(info.width, width, bin_x),
        size(info.height, height, bin_y),
        list(&matrix),
        if distortion.is_empty() { "none" } else { &info.distortion_model },
        distortion.len(),
        list(&distortion)
    )
}

/// Writes the robot's poses: one a capture, or, of a robot in motion, all there are beside the images' times.
fn robot_files(plan: &Plan, folder: &Path) -> Result<(), Error> {
    let columns = match plan.robot.urdf() {
        Some(urdf) => urdf.joint_names().join(","),
        None => "x,y,z,qx,qy,qz,qw".into(),
    };
    if let Some(urdf) = plan.robot.urdf() {
        write_atomically(&folder.join(URDF), urdf.text().as_bytes())?;
    }
    let text = if plan.moving {
        let times =
            plan.captures.iter().map(|c| format!("{},{:.9}\n", c.name, c.moment.shot.time_s));
        let times = format!("image,time_s\n{}", times.collect::<String>());
        write_atomically(&folder.join(TIMES), times.as_bytes())?;
        format!("time_s,{columns}\n{}", stream(&plan.robot))
    } else {
        let lines = plan.captures.iter().map(|c| format!("{},{}\n", c.name, numbers(&c.moment.at)));
        format!("id,{columns}\n{}", lines.collect::<String>())
    };
    write_atomically(&folder.join(ROBOT), text.as_bytes())
}

fn stream(robot: &Robot) -> String {
    let line = |time: f64| Some(format!("{time:.9},{}\n", numbers(&robot.at(time)?)));
    robot.times().into_iter().filter_map(line).collect()
}

fn numbers(at: &At) -> String {
    let pose = at.base_from_flange.iso();
    let (t, q) = (pose.translation.vector, pose.rotation.coords);
    let all = if at.joints.is_empty() {
        vec![t.x, t.y, t.z, q.x, q.y, q.z, q.w]
    } else {
        at.joints.clone()
    };
    all.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
}

/// The manifest's text, and what it asks.
fn manifest(plan: &Plan, cameras: &Cameras, written: &Written) -> (String, Vec<String>) {
    let mut draft = Draft::new();
    let bag = plan.bag.file_name().unwrap_or_default().to_string_lossy();
    draft.head(format!("ROS bag {bag}"));
    for (what, topic) in [("images", &plan.chosen.image), ("scans", &plan.chosen.scan)] {
        let about = topic.as_ref().and_then(|t| Some((t, plan.survey.topics.get(t)?)));
        if let Some((topic, about)) = about {
            let frame = about.frame.as_deref().unwrap_or("?");
            draft.head(format!("{what}: {topic}, in the frame {frame}"));
        }
    }
    draft.head(format!("robot: {}", plan.options.robot));
    draft.set_setup(plan.options.setup, WHO_CARRIES);
    let mut questions = vec![];
    if plan.options.setup.is_none() {
        questions.push(WHO_CARRIES.into());
    }
    questions.extend(target(plan, &mut draft));
    draft.note("frames", "as the bag calls them: for exports");
    draft.manifest.frames = Some(frame_names(plan));
    draft.manifest.camera = cameras.image.then(|| CameraSpec::of_file(CAMERA));
    draft.manifest.robot = Some(robot(plan));
    draft.manifest.images = plan
        .chosen
        .image
        .is_some()
        .then(|| ImagesSpec::of(format!("images/*.{}", ending(written, Kind::Images))));
    draft.manifest.scans = plan.chosen.scan.is_some().then(|| scans(cameras, written));
    if plan.moving {
        draft.note("motion", "the robot moved: robot and camera keep time, each by its own clock");
        draft.manifest.motion = Some(MotionSpec { times: TIMES.into() });
    }
    (draft.written().0, questions)
}

fn frame_names(plan: &Plan) -> FrameNames {
    let topic = plan.chosen.image.as_ref().or(plan.chosen.scan.as_ref());
    let optical = topic.and_then(|t| plan.survey.topics.get(t)?.frame.as_deref());
    frames::names(plan.survey, &plan.options.robot, plan.options.setup, optical)
}

/// Describes the target, or returns what must be asked of it.
fn target(plan: &Plan, draft: &mut Draft) -> Option<String> {
    let Some(targets) = &plan.options.target else {
        let question = "which board does the camera see? ([target] kind = ...)";
        draft.ask_target(question);
        return Some(question.into());
    };
    draft.manifest.target = Some(TargetSpec::Boards(targets.clone()));
    let is_one = matches!(targets, Targets::One(..));
    (!is_one).then(|| "which of the targets is it? ([captures] target = \"NAME\")".into())
}

fn robot(plan: &Plan) -> RobotSpec {
    let table = RobotSpec {
        poses: ROBOT.into(),
        direction: Some(RobotDirection::BaseFromFlange),
        ..RobotSpec::default()
    };
    let Some(urdf) = plan.robot.urdf() else {
        return RobotSpec {
            notation: Some("quaternion-xyzw".into()),
            length_unit: Some(LengthUnit::Metre),
            ..table
        };
    };
    let (base, flange) = urdf.links();
    RobotSpec {
        notation: Some("joints".into()),
        angle_unit: Some(AngleUnit::Radian),
        urdf: Some(UrdfSpec { file: URDF.into(), base: base.into(), flange: flange.into() }),
        ..table
    }
}

/// The ending that all files of a kind have, or `*`.
fn ending(written: &Written, kind: Kind) -> &'static str {
    let all: BTreeSet<&'static str> =
        written.iter().filter(|((_, k), _)| *k == kind).map(|(_, ending)| *ending).collect();
    match all.len() {
        0 | 1 => all.first().copied().unwrap_or("png"),
        _ => "*",
    }
}

fn scans(cameras: &Cameras, written: &Written) -> ScansSpec {
    let ending = ending(written, Kind::Scans);
    let is_depth = ending == "png";
    ScansSpec {
        files: format!("scans/*.{ending}"),
        length_unit: (!is_depth).then_some(LengthUnit::Metre),
        depth_scale: is_depth.then_some(pictures::DEPTH_SCALE),
        camera: cameras.scan.then(|| CameraSpec::of_file(SCAN_CAMERA)),
        ..ScansSpec::default()
    }
}
