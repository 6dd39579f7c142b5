//! From a dataset to a plan: what is known of the cell by now, what its robot reaches, and the views that come next.

mod avoid;
mod programs;

use std::path::{Path, PathBuf};

use handeye::{
    Base, Calibration, Config, Flange, HandEye, Intrinsics, Pose, Session, TargetModel, Verdict,
    estimate::predict::Volume,
    model::kinematics::Arm,
    nalgebra::{Quaternion, UnitQuaternion, Vector3},
    tools::plan::{
        ArmReach, ENOUGH, ExpectedNoise, FEWEST_ENOUGH, GuessSigma, NearReach, PlannedTouch,
        Planner, Reach, Route, Setting, Surroundings, Taken, TouchNoise, USUAL_CANDIDATES,
        USUALLY_NEAR, Viewing,
    },
};

use crate::{
    Dataset, Error, Place, WorkspaceFrame,
    calibrate::calibrate_dataset,
    dataset::Guess,
    error::{malformed, unusable},
    parallel,
    robot::{self, Urdf},
};
pub use programs::{Maker, program};

/// What is asked for.
#[derive(Debug, Clone, Default)]
pub struct PlanOptions {
    /// Largest number of views.
    pub count: usize,
    /// Views are added until the expected error (95 %, mm) is below this.
    pub tolerance_mm: Option<f64>,
    /// The robot's URDF, where the manifest names none, and its links for base and flange.
    pub urdf: Option<UrdfOption>,
    /// A file of what stands in the cell.
    pub avoid: Option<PathBuf>,
    /// Joint values now, degrees or mm; those of the last capture unless given.
    pub now: Option<Vec<f64>>,
    /// Least and largest distance of the board from the camera, m.
    pub distances_m: Option<(f64, f64)>,
    /// Whether corners to touch are planned as well.
    pub touches: bool,
    /// Whether views are planned near poses that were reached, although the manifest names a model of the arm.
    pub without_arm: bool,
    /// Poses that nobody goes to (again): nothing near them is planned.
    pub failed: Vec<Pose<Base, Flange>>,
}

/// A URDF that the command line names.
#[derive(Debug, Clone)]
pub struct UrdfOption {
    /// The file.
    pub file: PathBuf,
    /// The link that is the robot's base.
    pub base: String,
    /// The link that is its flange.
    pub flange: String,
}

impl UrdfOption {
    /// The arm.
    ///
    /// # Errors
    /// As [`Urdf::read`].
    pub fn read(&self) -> Result<Urdf, Error> {
        Urdf::read(&self.file, &self.base, &self.flange)
    }
}

/// A plan, and what it rests on.
#[derive(Debug, Clone)]
pub struct CellPlan {
    /// Views to take.
    pub route: Route,
    /// Corners to touch.
    pub touches: Vec<PlannedTouch>,
    /// The calibration of the captures so far, where they determine one.
    pub calibration: Option<Calibration>,
    /// Whether the captures that were taken are accurate enough for the tolerance.
    pub enough: bool,
    /// Names of the arm's joints, where it is known and names them.
    pub joint_names: Vec<String>,
    /// Which of its joints are prismatic.
    pub prismatic: Vec<bool>,
    /// The capture at whose pose the ways begin, unless joint values of now were given.
    pub begins_at: Option<String>,
    /// What to know of the plan.
    pub notes: Vec<String>,
}

/// Where captures determine camera and target, the guess says nearly nothing: standard deviations.
const NEARLY_NOTHING: GuessSigma = GuessSigma { rotation_rad: 0.5, position_m: 0.5 };
/// How far a camera may be along a direction that is free.
const PARTLY_KNOWN: GuessSigma = GuessSigma { rotation_rad: 0.1, position_m: 0.3 };
/// So much nearer and farther than in the captures so far the target is seen sharply.
const FOCUS: (f64, f64) = (0.75, 1.3);
/// Of the image, the part in which objects are looked for, where nothing says where the robot works.
const WORKED: f64 = 0.35;

/// Plans the next views of a cell.
///
/// # Errors
/// A dataset or file that cannot be used; a camera or target of which too little is known; no view that is left.
pub fn plan(
    dataset: &Dataset,
    options: &PlanOptions,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<CellPlan, Error> {
    let config = Config { max_error_mm: options.tolerance_mm, ..Config::default() };
    let (calibration, session) = calibrate_dataset(dataset, &config, progress)?;
    plan_after(dataset, calibration, &session, options)
}

/// The same after captures that are calibrated.
///
/// # Errors
/// As [`plan`].
pub fn plan_after(
    dataset: &Dataset,
    calibration: Calibration,
    session: &Session,
    options: &PlanOptions,
) -> Result<CellPlan, Error> {
    let place = Place::file(&dataset.manifest);
    let refused = |source| Error::Values { place: place.clone(), source };
    let (planner, joint_names, mut notes) = planner(dataset, &calibration, session, options)?;
    let enough = options.tolerance_mm.is_some_and(|mm| is_enough(&calibration, mm));
    let count = if enough { 0 } else { options.count };
    let route = planner.route(count, options.tolerance_mm).map_err(refused)?;
    let touches = match options.touches {
        true => planner.touches(MOST_TOUCHES, &touch_noise(dataset), options.tolerance_mm),
        false => vec![],
    };
    if !enough && !route.undetermined.is_empty() && touches.is_empty() {
        notes.push(format!(
            "not determined even by all these views: {}; touched corners determine it (--touches)",
            route.undetermined.join(", ")
        ));
    }
    let known = calibration.hand_eye.mount_from_camera.is_some();
    let calibration = known.then_some(calibration);
    let last = session.observations.last().filter(|_| options.now.is_none());
    let begins_at = last.map(|o| o.capture.clone());
    let prismatic = match &planner.reach {
        Reach::Arm(reach) => reach.arm.joints.iter().map(|joint| joint.prismatic).collect(),
        Reach::Near(_) => vec![],
    };
    Ok(CellPlan { route, touches, calibration, enough, joint_names, prismatic, begins_at, notes })
}

/// Whether an accepted calibration states so little, from so many captures, that it holds for the tolerance (mm).
fn is_enough(calibration: &Calibration, tolerance_mm: f64) -> bool {
    let used = calibration.captures.iter().filter(|c| c.used).count();
    let stated = calibration.predicted_tre_mm.as_ref().map(|error| error.p95);
    calibration.verdict == Verdict::Accepted
        && used >= FEWEST_ENOUGH
        && stated.is_some_and(|mm| mm <= ENOUGH * tolerance_mm)
}

/// Touches that are planned.
const MOST_TOUCHES: usize = 12;
/// Depth of a corner in the scan, where nothing says it, m.
const USUAL_DEPTH_M: f64 = 0.5e-3;

fn touch_noise(dataset: &Dataset) -> TouchNoise {
    let usual = TouchNoise::default();
    TouchNoise {
        touch_m: dataset.noise.touch.unwrap_or(usual.touch_m),
        tip_m: dataset.noise.tip.unwrap_or(usual.tip_m),
    }
}

/// What is known of the cell.
fn planner(
    dataset: &Dataset,
    calibration: &Calibration,
    session: &Session,
    options: &PlanOptions,
) -> Result<(Planner, Vec<String>, Vec<String>), Error> {
    let manifest = &dataset.manifest;
    let target = dataset.target.clone().ok_or_else(|| {
        unusable(manifest, "names no board ([target]): a plan needs to know what is looked at")
    })?;
    let camera = session.camera.or(dataset.intrinsics).ok_or_else(|| {
        unusable(
            manifest,
            "has no intrinsics yet: give [camera], or take captures until they can be calibrated",
        )
    })?;
    let (taken, mut failed) = taken(calibration, session);
    failed.extend_from_slice(&options.failed);
    let answer = &calibration.hand_eye;
    let (hand_eye, guess) = match (answer.mount_from_camera, answer.anchor_from_target) {
        (Some(mount_from_camera), Some(anchor_from_target)) => {
            (HandEye { mount_from_camera, anchor_from_target }, NEARLY_NOTHING)
        }
        _ => {
            let guess = partly(calibration).or(dataset.guess);
            let guess = guess.ok_or_else(|| no_guess(manifest, taken.len()))?;
            let anchor_from_target = Pose::identity();
            (
                HandEye { mount_from_camera: guess.mount_from_camera, anchor_from_target },
                guess.sigma,
            )
        }
    };
    let viewing = viewing(&camera, &target, &taken, options);
    let setting = Setting {
        setup: dataset.setup,
        camera,
        hand_eye,
        noise: noise(dataset, calibration),
        volume: volume(dataset, &camera, &viewing, &hand_eye),
        target,
    };
    let (reach, joint_names, notes) = reach(dataset, session, options)?;
    let candidates = USUAL_CANDIDATES;
    let guess = Some(guess);
    let threads = parallel::threads([]);
    let planner = Planner { setting, guess, taken, failed, viewing, reach, candidates, threads };
    Ok((planner, joint_names, notes))
}

/// The determined part of an answer that is not wholly determined, as with a robot of four axes.
fn partly(calibration: &Calibration) -> Option<Guess> {
    let known = calibration.determined.as_ref()?;
    let ([x, y, z, w], across) = (known.rotation_xyzw?, known.translation_across_m?);
    let rotation = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
    let at = rotation.to_rotation_matrix().into_inner();
    let mount_from_camera = Pose::from_parts(&at, Vector3::from(across));
    Some(Guess { mount_from_camera, sigma: PARTLY_KNOWN })
}

fn no_guess(manifest: &Path, captures: usize) -> Error {
    Error::Undeclared {
        place: Place::file(manifest),
        key: "guess".into(),
        question: format!(
            "roughly where does the camera sit? {captures} captures do not determine it yet: [guess] translation_mm = [x, y, z], \
             optical_axis = [x, y, z], image_x = [x, y, z] (in the flange where the robot carries the camera, else in the base)"
        ),
    }
}

/// Captures that were taken and used, and poses from where the target was not found.
fn taken(calibration: &Calibration, session: &Session) -> (Vec<Taken>, Vec<Pose<Base, Flange>>) {
    let (mut taken, mut failed) = (vec![], vec![]);
    for capture in &calibration.captures {
        let seen = session.observations.iter().find(|o| o.capture == capture.id);
        let first = seen.and_then(|o| o.candidates.first()).map(|c| c.camera_from_target);
        let base_from_flange = capture.base_from_flange;
        match (capture.used, capture.camera_from_target.or(first)) {
            (_, None) => failed.push(base_from_flange),
            (true, Some(camera_from_target)) => {
                taken.push(Taken { base_from_flange, camera_from_target })
            }
            (false, Some(camera_from_target))
                if calibration.hand_eye.mount_from_camera.is_none() =>
            {
                taken.push(Taken { base_from_flange, camera_from_target });
            }
            (false, Some(_)) => {}
        }
    }
    (taken, failed)
}

fn viewing(
    camera: &Intrinsics,
    target: &TargetModel,
    taken: &[Taken],
    options: &PlanOptions,
) -> Viewing {
    let usual = Viewing::usual(camera, target);
    if let Some((nearest_m, farthest_m)) = options.distances_m {
        return Viewing { nearest_m, farthest_m, ..usual };
    }
    let middle = target.middle();
    let depth = |t: &Taken| (t.camera_from_target * middle).vector().z;
    let depths: Vec<f64> = taken.iter().map(depth).filter(|z| *z > 0.0).collect();
    let low = depths.iter().copied().fold(f64::INFINITY, f64::min);
    let high = depths.iter().copied().fold(0.0, f64::max);
    if depths.is_empty() {
        return usual;
    }
    // what was seen is in focus; what is usual only where it is near that
    let nearest_m = (low * FOCUS.0).max(usual.nearest_m.min(low));
    let farthest_m = (high * FOCUS.1).min(usual.farthest_m.max(high)).max(nearest_m * 1.05);
    Viewing { nearest_m, farthest_m, ..usual }
}

fn noise(dataset: &Dataset, calibration: &Calibration) -> ExpectedNoise {
    let usual = ExpectedNoise::default();
    let robot = calibration.error_budget.iter().find(|entry| entry.source == "robot");
    let rotation = robot.and_then(|entry| entry.sigma_deg).map(f64::to_radians);
    let position = robot.and_then(|entry| entry.sigma_mm).map(|mm| mm * 1e-3);
    let known = &dataset.noise;
    let has_scans = dataset.captures.iter().any(|c| c.scan.is_some());
    ExpectedNoise {
        robot_rotation_rad: known.robot_rotation.or(rotation).unwrap_or(usual.robot_rotation_rad),
        robot_position_m: known.robot_position.or(position).unwrap_or(usual.robot_position_m),
        corner_px: known.image_px.unwrap_or(usual.corner_px),
        depth_at_1m: has_scans.then_some(known.depth.unwrap_or(USUAL_DEPTH_M)),
    }
}

/// Where the robot works: the box of the manifest, or what the camera sees between the distances.
fn volume(dataset: &Dataset, camera: &Intrinsics, viewing: &Viewing, hand_eye: &HandEye) -> Volume {
    if let Some(w) = &dataset.workspace {
        let volume = Volume::of_box(
            &w.corners.minimum,
            &w.corners.maximum,
            "the workspace box of the manifest",
        );
        return match w.frame {
            WorkspaceFrame::Camera => volume,
            WorkspaceFrame::Base => {
                volume.seen_from(&hand_eye.mount_from_camera.iso().inverse(), dataset.setup.mount())
            }
        };
    }
    let middle = 0.5 * (viewing.nearest_m + viewing.farthest_m);
    let half = |pixels: u32, f: f64| WORKED * f64::from(pixels) / f * middle;
    let (x, y) = (half(camera.width, camera.fx), half(camera.height, camera.fy));
    let (low, high) =
        (Vector3::new(-x, -y, viewing.nearest_m), Vector3::new(x, y, viewing.farthest_m));
    Volume::of_box(&low, &high, "the box in which the camera sees sharply")
}

/// What the robot reaches, the names of its joints, and what to know of it.
fn reach(
    dataset: &Dataset,
    session: &Session,
    options: &PlanOptions,
) -> Result<(Reach, Vec<String>, Vec<String>), Error> {
    let avoided = options.avoid.as_deref().map(avoid::read).transpose()?.unwrap_or_default();
    let surroundings = Surroundings {
        parts: avoided.carried,
        obstacles: avoided.obstacles,
        clearance_m: avoided.clearance_m,
        ignored: vec![],
    };
    let named = options.urdf.as_ref().map(UrdfOption::read).transpose()?;
    let own = dataset.urdf.clone().filter(|_| !options.without_arm);
    if let Some(urdf) = named.or(own) {
        let (parts, notes) = robot::parts(&urdf, urdf.path());
        let surroundings =
            Surroundings { parts: [surroundings.parts, parts].concat(), ..surroundings };
        let names = urdf.joint_names().to_vec();
        let arm =
            arm_reach(urdf.arm().clone(), urdf.limits().to_vec(), surroundings, session, options)?;
        return Ok((Reach::Arm(arm), names, notes));
    }
    if let Some(arm) = dataset.arm.as_ref().filter(|_| !options.without_arm) {
        let turn = std::f64::consts::TAU;
        let limits = vec![(-turn, turn); arm.joints.len()];
        let notes = vec!["the arm's limits and shapes are not known (no URDF): only joint values are found, no collisions of links".into()];
        return Ok((
            Reach::Arm(arm_reach(arm.clone(), limits, surroundings, session, options)?),
            vec![],
            notes,
        ));
    }
    let stood: Vec<_> = session.observations.iter().map(|o| o.base_from_flange).collect();
    let notes = vec![format!(
        "the arm is not known (no URDF): poses keep within {:.0} mm and {:.0} degrees of one in which the robot has stood",
        USUALLY_NEAR.distance * 1e3,
        USUALLY_NEAR.angle.to_degrees()
    )];
    Ok((Reach::Near(NearReach { stood, within: USUALLY_NEAR, surroundings }), vec![], notes))
}

fn arm_reach(
    arm: Arm,
    limits: Vec<(f64, f64)>,
    surroundings: Surroundings,
    session: &Session,
    options: &PlanOptions,
) -> Result<ArmReach, Error> {
    let stood: Vec<Vec<f64>> = session
        .observations
        .iter()
        .map(|o| o.joints.clone())
        .filter(|joints| joints.len() == arm.joints.len())
        .collect();
    let now = match (&options.now, stood.last()) {
        (Some(now), _) => {
            let si = |(joint, value): (&handeye::model::kinematics::Joint, &f64)| match joint
                .prismatic
            {
                true => value * 1e-3,
                false => value.to_radians(),
            };
            if now.len() != arm.joints.len() {
                let what = format!("{} joint values for {} joints", now.len(), arm.joints.len());
                return Err(malformed(
                    Place::file(Path::new("--joints")),
                    what,
                    "give one for each joint",
                ));
            }
            arm.joints.iter().zip(now).map(si).collect()
        }
        (None, Some(last)) => last.clone(),
        (None, None) => {
            let there = session.observations.last().map(|o| o.base_from_flange);
            there.and_then(|there| ArmReach::joints_somewhere(&arm, &limits, &there)).ok_or_else(|| {
                malformed(
                    Place::file(Path::new("--urdf")),
                    "no joint values within the limits lead to the pose of the last capture",
                    "give the joint values of now (--joints), or another link of the URDF as base or flange (--base-link, \
                     --flange-link)",
                )
            })?
        }
    };
    let here = [stood, vec![now.clone()]].concat();
    let surroundings = surroundings.ignoring_neighbours(&arm, &limits, &here);
    Ok(ArmReach { arm, limits, now, surroundings })
}
