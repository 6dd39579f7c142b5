//! The robot's model: joint values of now, whether they lead to where the robot says that it is, and where its joints are.
//!
//! A robot that gives joint values is followed by them. Of another they are found by inverse kinematics of its pose, near
//! those before, so that the arm does not change its branch.

use handeye::{
    Base, Flange, Pose,
    model::{kinematics::CONSISTENT, residual::Residual},
    tools::plan::{ArmReach, Reach, Surroundings},
};
use handeye_io::Urdf;

use super::{Engine, Flow, FolderState, Problem, rest::RobotSample, shown::ArmView};
use crate::assess::{ProposedView, joint_numbers};

/// The arm at this moment.
#[derive(Debug, Clone, Default)]
pub(super) struct ArmNow {
    /// Joint values (rad, m) that lead to the last pose.
    values: Option<Vec<f64>>,
    /// The last ones that led to a pose.
    last: Option<Vec<f64>>,
    doubt: Option<Doubt>,
}

/// Why the model is not that of the robot.
#[derive(Debug, Clone)]
struct Doubt {
    /// When it was found, s.
    time_s: f64,
    problem: Problem,
    /// Whether the robot's own joint values are against it.
    is_measured: bool,
}

/// What takes long is looked for anew after so long, s.
const AGAIN_S: f64 = 1.0;
/// What to do about a model of something else.
const ANOTHER: &str = "give the URDF of this robot (--urdf), or its links that are base and flange for these poses (--base-link, --flange-link)";

impl ArmNow {
    /// Where the arm was at the last capture.
    pub(super) fn of_last_capture(folder: &FolderState) -> Self {
        let values = folder.arm.as_ref().zip(folder.captures.last()).and_then(|(urdf, last)| {
            match last.joints.len() == urdf.joint_names().len() {
                true => Some(last.joints.clone()),
                false => anywhere(urdf, &last.base_from_flange),
            }
        });
        Self { last: values.clone(), values, doubt: None }
    }

    /// After another pose of a robot that gives its joint values.
    fn measured(self, urdf: &Urdf, sample: &RobotSample) -> Self {
        let before = self.recent(sample).filter(|doubt| doubt.is_measured);
        let doubt = match before {
            Some(before) if !agrees(urdf, sample) => Some(before),
            _ => contradiction(urdf, sample),
        };
        let values = doubt.is_none().then(|| sample.joints.clone());
        Self { last: values.clone().or(self.last), values, doubt }
    }

    /// After another pose of a robot that gives none; where poses stream, not each of them is searched for.
    fn found(self, urdf: &Urdf, sample: &RobotSample, streams: bool) -> Self {
        let there = &sample.base_from_flange;
        let before = self.recent(sample).filter(|_| streams);
        let near = self.last.as_ref().and_then(|last| near(urdf, there, last));
        let values = match (near, &before) {
            (None, None) => anywhere(urdf, there),
            (near, _) => near,
        };
        let doubt = values.is_none().then(|| before.unwrap_or_else(|| unreached(sample)));
        Self { last: values.clone().or(self.last), values, doubt }
    }

    /// What was found a moment ago.
    fn recent(&self, sample: &RobotSample) -> Option<Doubt> {
        let is_recent = |doubt: &&Doubt| (0.0..AGAIN_S).contains(&(sample.time_s - doubt.time_s));
        self.doubt.as_ref().filter(is_recent).cloned()
    }
}

impl Engine {
    /// Follows the robot to another pose.
    pub(super) fn follow_arm(&mut self, sample: &RobotSample) {
        let Some(urdf) = self.folder.arm.clone() else { return };
        let before = std::mem::take(&mut self.arm);
        self.arm = match sample.joints.is_empty() {
            false => before.measured(&urdf, sample),
            true => before.found(&urdf, sample, self.sources.robot == Flow::Stream),
        };
    }

    /// Joint values that lead to where the robot is, rad or m.
    pub(super) fn joints_now(&self) -> Option<&[f64]> {
        self.arm.values.as_deref()
    }

    /// Why the model cannot be that of the robot whose joint values come.
    pub(super) fn arm_contradicts(&self) -> Option<String> {
        let doubt = self.arm.doubt.as_ref().filter(|doubt| doubt.is_measured)?;
        Some(format!("{}: {}", doubt.problem.message, doubt.problem.advice))
    }

    /// What is wrong with the model.
    pub(super) fn doubt_of_arm(&self) -> Option<Problem> {
        self.arm.doubt.as_ref().map(|doubt| doubt.problem.clone())
    }

    /// Joint values at a view, rad or m.
    pub(super) fn joints_at(&self, view: &ProposedView) -> Option<Vec<f64>> {
        let urdf = self.folder.arm.as_ref()?;
        let now = self.joints_now()?;
        view.joints.clone().or_else(|| near(urdf, &view.base_from_flange, now))
    }

    /// Joint values in degrees or mm.
    pub(super) fn joint_numbers(&self, values: &[f64]) -> Vec<f64> {
        match &self.folder.arm {
            Some(urdf) if urdf.joint_names().len() == values.len() => joint_numbers(values, urdf),
            _ => values.iter().map(|value| value.to_degrees()).collect(),
        }
    }

    pub(super) fn arm_view(&self) -> Option<ArmView> {
        let urdf = self.folder.arm.as_ref()?;
        let unit = |is_prismatic: bool| if is_prismatic { "mm" } else { "°" };
        let points = |values: &[f64]| urdf.points(values).iter().map(point).collect();
        let next = self.next().and_then(|next| self.joints_at(next));
        Some(ArmView {
            joints: urdf.joint_names().to_vec(),
            units: urdf.prismatic().into_iter().map(unit).collect(),
            measured: self.robot.back().is_some_and(|sample| !sample.joints.is_empty()),
            points: self.joints_now().map(points),
            next_points: next.as_deref().map(points),
        })
    }
}

/// A tenth of a millimetre is more than a page shows.
fn point(p: &nalgebra::Vector3<f64>) -> [f64; 3] {
    [p.x, p.y, p.z].map(|v| (v * 1e4).round() / 1e4)
}

/// Joint values within limits that lead to a pose, near others.
fn near(urdf: &Urdf, there: &Pose<Base, Flange>, now: &[f64]) -> Option<Vec<f64>> {
    let (arm, limits) = (urdf.arm().clone(), urdf.limits().to_vec());
    let surroundings = Surroundings::default();
    let reach = Reach::Arm(ArmReach { arm, limits, now: now.to_vec(), surroundings });
    reach.station(there, &[]).ok()?.joints
}

/// The same, wherever they are.
fn anywhere(urdf: &Urdf, there: &Pose<Base, Flange>) -> Option<Vec<f64>> {
    ArmReach::joints_somewhere(urdf.arm(), urdf.limits(), there)
}

/// Whether the robot's joint values lead to where it says that it is.
fn agrees(urdf: &Urdf, sample: &RobotSample) -> bool {
    sample.joints.len() == urdf.joint_names().len()
        && is_there(&urdf.arm().base_from_flange(&sample.joints), sample)
}

fn is_there(base_from_flange: &Pose<Base, Flange>, sample: &RobotSample) -> bool {
    Residual::between(base_from_flange, &sample.base_from_flange).is_within(CONSISTENT)
}

/// What the robot's joint values say against the model.
fn contradiction(urdf: &Urdf, sample: &RobotSample) -> Option<Doubt> {
    if agrees(urdf, sample) {
        return None;
    }
    let (given, own) = (sample.joints.len(), urdf.joint_names().len());
    let other = || urdf.links_that_agree(&sample.joints, |pose| is_there(pose, sample));
    let (message, advice) = match given == own {
        false => (
            format!("the robot gives {given} joint values, its model (URDF) has {own} joints"),
            ANOTHER.into(),
        ),
        true => (apart(urdf, sample), other().map_or(ANOTHER.into(), links)),
    };
    let problem = Problem { code: "arm-contradicts".into(), message, advice };
    Some(Doubt { time_s: sample.time_s, problem, is_measured: true })
}

fn apart(urdf: &Urdf, sample: &RobotSample) -> String {
    let there = urdf.arm().base_from_flange(&sample.joints);
    let apart = Residual::between(&there, &sample.base_from_flange);
    format!(
        "by its model (URDF) the robot's joint values lead to a flange that is {:.0} mm and {:.1} degrees from where the robot \
         says that it is",
        apart.distance * 1e3,
        apart.angle.to_degrees()
    )
}

fn links((base, flange): (String, String)) -> String {
    format!(
        "between its links {base} and {flange} they agree: give --base-link {base} --flange-link {flange}"
    )
}

/// No joint values lead to where a robot is that gives none.
fn unreached(sample: &RobotSample) -> Doubt {
    let problem = Problem {
        code: "arm-does-not-reach".into(),
        message:
            "no joint values within the limits of the robot's model (URDF) lead to where the flange is"
                .into(),
        advice: ANOTHER.into(),
    };
    Doubt { time_s: sample.time_s, problem, is_measured: false }
}
