//! What a robot does that does not know of its own errors.
//!
//! The camera sees a point `p`; it really lies at `X p`. The robot is asked for `m` instead, such that it really brings
//! its tool there: the tool is held as it was in the nearest touches (where none says how: as the target was in the
//! nearest captures), the flange is where it must be for that, and `m` is where the controller reports the tool then. `m` is
//! not a rigid motion of `p`; the answer for the robot as it is comes nearest to it over the volume, and what is left
//! adds to its error.

use nalgebra::{DMatrix, Isometry3, Matrix3, Matrix3xX, Matrix6, Vector3};

use crate::{
    Base, Camera, Flange, Mount, Pose, Setup,
    calibrate::flow::views::Views,
    estimate::{ExtraKind, JointFit, compensation::ByUnknowns, place::Place, predict::Volume},
    register::rigid_fit::{point_jacobian, rigid_fit},
};

/// The touches that a fit rests on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct UsedTouches<'a> {
    /// Those of the session behind the problem's boards, in their order.
    pub used: &'a [usize],
    /// Whether the tip was found to be wrong.
    pub wrong_tip: bool,
}

/// A robot whose flange is not where the controller reports it, as a fit has it.
pub(crate) trait Erring {
    /// The fit.
    fn fit(&self) -> &JointFit;

    /// Whether an unknown is one of its errors.
    fn is_own(&self, kind: ExtraKind) -> bool;

    /// Whether its error at a place follows from what is recorded there.
    fn knows(&self, at: &Place) -> bool;

    /// Where the controller reports the flange.
    fn reported(&self, at: &Place) -> Pose<Base, Flange>;

    /// Where the flange is.
    fn actual(&self, at: &Place) -> Pose<Base, Flange>;

    /// The place at which the flange is there, `near` another one; `None` where the arm does not reach.
    fn place_for(&self, flange: &Pose<Base, Flange>, near: &Place) -> Option<Place>;

    /// How its flange moves with each of its errors there, and how far it errs beside.
    fn errors(&self, at: &Place) -> ByUnknowns;

    /// Whether its controller gets the corrected tip; it goes on with the one that it has otherwise.
    fn corrects_tip(&self) -> bool;
}

/// Where a robot that does not know of its own errors must be sent, and what it misses then.
pub(crate) trait Reach {
    /// Where the robot must be asked to go for a point, minus where it lies; camera axes, m.
    fn shift(&self, p: &Vector3<f64>) -> Vector3<f64>;

    /// How far that differs from way to way, m².
    fn scatter(&self, p: &Vector3<f64>) -> Matrix3<f64>;

    /// Which share of what the robot errs from pose to pose is in that already.
    fn share_of_noise(&self) -> f64 {
        0.0
    }

    /// How that moves with the unknowns of the robot, by their number among all.
    fn by_unknowns(&self, p: &Vector3<f64>) -> Vec<(usize, Vector3<f64>)>;

    /// The answer that comes nearest, and its covariance for one of all unknowns.
    fn rigid(&self, covariance: &DMatrix<f64>) -> Option<(Pose<Mount, Camera>, Matrix6<f64>)>;
}

/// A point of the volume.
struct Goal {
    /// In the camera.
    p: Vector3<f64>,
    /// `m - X p`, in camera axes, mean and scatter over the ways to go there.
    shift: Vector3<f64>,
    scatter: Matrix3<f64>,
    /// How `m` moves with each error of the robot, in camera axes.
    by_own: Vec<Vector3<f64>>,
}

/// The volume as the robot reaches it with its tool.
pub(crate) struct ToolReach {
    goals: Vec<Goal>,
    /// Where the robot's errors stand among the unknowns.
    columns: Vec<usize>,
    x: Pose<Mount, Camera>,
}

/// The rigid answer that comes nearest to where a robot must be sent.
pub(crate) struct Nearest {
    pub x: Pose<Mount, Camera>,
    pub covariance: Matrix6<f64>,
    /// What the robot misses with it all over the volume, as a covariance of the answer.
    everywhere: Matrix6<f64>,
    /// The same as a mean variance per axis, m².
    pub variance: f64,
}

/// A tool held somewhere.
struct Held {
    place: Place,
    /// The flange there, as it really is.
    rotation: Matrix3<f64>,
    /// The tool in the flange, as it is and as the controller has it, and where it was.
    tool: Vector3<f64>,
    controllers: Vector3<f64>,
    at: Vector3<f64>,
}

/// So many of the nearest ways to hold the tool are looked at.
const NEAREST: usize = 6;
/// So many captures stand for all from which the camera looks (eye-in-hand).
const VIEWS: usize = 8;

impl ToolReach {
    /// `None` where the robot reaches no point of the volume.
    pub fn new(views: &Views, robot: &impl Erring, volume: &Volume) -> Option<Self> {
        let work = Work::new(views, robot)?;
        let known: Vec<Option<Goal>> = volume.points.iter().map(|p| work.goal(p)).collect();
        let near = |p: &Vector3<f64>| {
            let reached = known.iter().flatten();
            reached.min_by(|a, b| (a.p - p).norm().total_cmp(&(b.p - p).norm()))
        };
        let one =
            |p: &Vector3<f64>| near(p).map(|k| Goal { p: *p, by_own: k.by_own.clone(), ..*k });
        let goals = volume.points.iter().map(one).collect::<Option<Vec<_>>>()?;
        let fit = robot.fit();
        let extras = fit.extras.iter().enumerate();
        let columns = extras.filter(|(_, e)| acts(robot, e.kind)).map(|(k, _)| 12 + k);
        Some(Self { goals, columns: columns.collect(), x: fit.hand_eye.mount_from_camera })
    }

    fn near(&self, p: &Vector3<f64>) -> Option<&Goal> {
        let far = |k: &Goal| (k.p - p).norm();
        self.goals.iter().min_by(|a, b| far(a).total_cmp(&far(b)))
    }

    /// The rigid answer that comes nearest.
    pub fn answer(&self, covariance: &DMatrix<f64>) -> Option<Nearest> {
        let from: Vec<Vector3<f64>> = self.goals.iter().map(|k| k.p).collect();
        let to: Vec<Vector3<f64>> = self.goals.iter().map(|k| k.p + k.shift).collect();
        let motion = rigid_fit(&from, &to).ok()?.target_from_source;
        let mut squares = Matrix6::zeros();
        let mut by_all = DMatrix::zeros(6, covariance.nrows());
        for goal in &self.goals {
            let j = point_jacobian(&goal.p);
            squares += j.transpose() * j;
            for (k, column) in self.columns.iter().zip(&goal.by_own) {
                let mut sum = by_all.column_mut(*k);
                sum += j.transpose() * column;
            }
        }
        by_all.view_mut((0, 0), (6, 6)).copy_from(&squares);
        let inverse = squares.try_inverse()?;
        let carry = DMatrix::from_column_slice(6, 6, inverse.as_slice()) * by_all;
        let own = &carry * covariance * carry.transpose();
        let (everywhere, variance) = self.missed(&motion, &inverse);
        let x = Pose::claim(self.x.iso() * motion);
        Some(Nearest { x, covariance: own.fixed_view::<6, 6>(0, 0).into(), everywhere, variance })
    }

    /// A covariance that predicts what the robot misses all over the volume, where it is sent by a rigid motion, and the
    /// mean variance per axis of that; `inverse` is that of `Σ JᵀJ` over it.
    fn missed(&self, motion: &Isometry3<f64>, inverse: &Matrix6<f64>) -> (Matrix6<f64>, f64) {
        let (mut sum, mut variance) = (Matrix6::zeros(), 0.0);
        let n = self.goals.len() as f64;
        for goal in &self.goals {
            let off = motion.transform_vector(&goal.p) + motion.translation.vector
                - (goal.p + goal.shift);
            let j = point_jacobian(&goal.p);
            let all = off * off.transpose() + goal.scatter;
            sum += j.transpose() * all * j;
            variance += all.trace() / (3.0 * n);
        }
        // a pose of six unknowns carries each of them to points of three: half of it is their share
        (inverse * sum * inverse * (0.5 * n), variance)
    }
}

impl Reach for ToolReach {
    fn shift(&self, p: &Vector3<f64>) -> Vector3<f64> {
        self.near(p).map_or_else(Vector3::zeros, |k| k.shift)
    }

    fn scatter(&self, p: &Vector3<f64>) -> Matrix3<f64> {
        self.near(p).map_or_else(Matrix3::zeros, |k| k.scatter)
    }

    fn by_unknowns(&self, p: &Vector3<f64>) -> Vec<(usize, Vector3<f64>)> {
        let of = |k: &Goal| self.columns.iter().copied().zip(k.by_own.iter().copied()).collect();
        self.near(p).map_or_else(Vec::new, of)
    }

    /// That no rigid motion comes nearer is in the covariance: as if the answer were another one at every place, by as
    /// much as the robot misses it there.
    fn rigid(&self, covariance: &DMatrix<f64>) -> Option<(Pose<Mount, Camera>, Matrix6<f64>)> {
        let Nearest { x, covariance, everywhere, .. } = self.answer(covariance)?;
        Some((x, covariance + everywhere))
    }
}

/// A shift, how it moves with the robot's errors, and the variance per axis (m²) that does not follow from these.
struct Sample {
    shift: Vector3<f64>,
    by_own: Vec<Vector3<f64>>,
    rest: f64,
}

/// The robot, and how its tool was held.
struct Work<'a, R> {
    robot: &'a R,
    x: Pose<Mount, Camera>,
    held: Vec<Held>,
    /// From where the camera looks; nowhere where it stands still.
    views: Vec<Option<Viewpoint>>,
}

/// A place from which the camera looks.
struct Viewpoint {
    reported: Pose<Base, Flange>,
    actual: Pose<Base, Flange>,
    errors: ByUnknowns,
}

impl<'a, R: Erring> Work<'a, R> {
    fn new(views: &Views, robot: &'a R) -> Option<Self> {
        let (setup, fit) = (views.session.setup, robot.fit());
        let x = fit.hand_eye.mount_from_camera;
        let tip =
            Vector3::from_fn(|k, _| fit.extra(ExtraKind::Tip(k)).map_or(0.0, |t: (f64, f64)| t.0));
        let uncorrected = if robot.corrects_tip() { Vector3::zeros() } else { tip };
        let hold = |place: Place, tool: Vector3<f64>, controllers: Vector3<f64>| {
            let flange = robot.actual(&place);
            let at = flange.rotation() * tool + flange.translation();
            Held { place, rotation: flange.rotation(), tool, controllers, at }
        };
        let touched = views.session.touches.iter().filter_map(|t| {
            let flange = t.base_from_flange?;
            let place = Place::new(&flange, &t.joints).touching();
            let tool = (flange.inverse() * t.in_base).vector() + tip;
            robot.knows(&place).then(|| hold(place, tool, tool - uncorrected))
        });
        let seen = views.used.iter().map(|o| Place::new(&o.base_from_flange, &o.joints));
        let mut held: Vec<Held> = touched.collect();
        if held.is_empty() {
            // the target is the tool, or as long as the camera's place on the flange
            let tool = match setup {
                Setup::EyeToHand => fit.hand_eye.anchor_from_target.translation(),
                Setup::EyeInHand => x.translation(),
            };
            held = seen.clone().map(|place| hold(place, tool, tool)).collect();
        }
        let viewpoint = |place: Place| Viewpoint {
            reported: robot.reported(&place),
            actual: robot.actual(&place),
            errors: robot.errors(&place),
        };
        let views: Vec<Option<Viewpoint>> = match setup {
            Setup::EyeToHand => vec![None],
            Setup::EyeInHand => {
                let step = views.used.len().div_ceil(VIEWS).max(1);
                seen.step_by(step).map(|place| Some(viewpoint(place))).collect()
            }
        };
        (!held.is_empty()).then_some(Self { robot, x, held, views })
    }

    fn goal(&self, p: &Vector3<f64>) -> Option<Goal> {
        let mut all: Vec<Sample> = vec![];
        for view in &self.views {
            let there = self.in_base(view.as_ref(), p);
            let mut near: Vec<&Held> = self.held.iter().collect();
            near.sort_by(|a, b| (a.at - there).norm().total_cmp(&(b.at - there).norm()));
            let ways = near.iter().take(NEAREST);
            all.extend(ways.filter_map(|h| self.sample(view.as_ref(), h, p, &there)));
        }
        let n = all.len() as f64;
        let shift = all.iter().map(|s| s.shift).sum::<Vector3<f64>>() / n;
        let off = |s: &Sample| {
            (s.shift - shift) * (s.shift - shift).transpose() + Matrix3::identity() * s.rest
        };
        let scatter = all.iter().map(off).sum::<Matrix3<f64>>() / n;
        let by_own = (0..all.first()?.by_own.len())
            .map(|k| all.iter().map(|s| s.by_own[k]).sum::<Vector3<f64>>() / n)
            .collect();
        Some(Goal { p: *p, shift, scatter, by_own })
    }

    /// The same with the tip before, where it acts: turned into the base like this.
    fn with_tip(&self, by_own: Matrix3xX<f64>, rotation: &Matrix3<f64>) -> Matrix3xX<f64> {
        let extras = &self.robot.fit().extras;
        let is_tip = |kind| matches!(kind, ExtraKind::Tip(_)) && acts(self.robot, kind);
        let n = extras.iter().filter(|e| is_tip(e.kind)).count();
        let mut all = by_own.insert_columns(0, n, 0.0);
        all.view_mut((0, 0), (3, n)).copy_from(&rotation.columns(0, n));
        all
    }

    fn in_base(&self, view: Option<&Viewpoint>, p: &Vector3<f64>) -> Vector3<f64> {
        let on_mount = self.x.rotation() * p + self.x.translation();
        view.map_or(on_mount, |view| carried(&view.actual, &on_mount))
    }

    /// One way to go there.
    fn sample(
        &self,
        view: Option<&Viewpoint>,
        held: &Held,
        p: &Vector3<f64>,
        there: &Vector3<f64>,
    ) -> Option<Sample> {
        let robot = self.robot;
        let flange = Pose::from_parts(&held.rotation, there - held.rotation * held.tool);
        let place = robot.place_for(&flange, &held.place)?;
        let reported = carried(&robot.reported(&place), &held.controllers);
        let errors = robot.errors(&place);
        let reached = held.rotation * point_jacobian(&held.tool) * &errors.unknowns;
        let reached = self.with_tip(reached, &held.rotation);
        let on_mount = self.x.rotation() * p + self.x.translation();
        let of_tool = carried_variance(errors.rest(), &held.tool);
        let (m, by, rest) = match view {
            None => (reported, -reached, of_tool),
            Some(view) => {
                let moved = view.actual.rotation() * point_jacobian(&on_mount);
                let seen = moved * &view.errors.unknowns;
                let seen = self.with_tip(seen, &Matrix3::zeros());
                let back = view.reported.rotation().transpose();
                let rest = of_tool + carried_variance(view.errors.rest(), &on_mount);
                (back * (reported - view.reported.translation()), back * (seen - reached), rest)
            }
        };
        let to_camera = self.x.rotation().transpose();
        let by = to_camera * by;
        let by_own = by.column_iter().map(Into::into).collect();
        Some(Sample { shift: to_camera * (m - on_mount), by_own, rest })
    }
}

/// Whether an unknown moves where the robot goes: one of its errors, or of a tip that is not corrected.
fn acts(robot: &impl Erring, kind: ExtraKind) -> bool {
    robot.is_own(kind) || (matches!(kind, ExtraKind::Tip(_)) && !robot.corrects_tip())
}

fn carried<A>(pose: &Pose<A, Flange>, p: &Vector3<f64>) -> Vector3<f64> {
    pose.rotation() * p + pose.translation()
}

/// Variance per axis of a point so far from a flange whose rotation and position have these.
fn carried_variance([turn, shift]: [f64; 2], p: &Vector3<f64>) -> f64 {
    // two of three axes turn a point
    shift + turn * p.norm_squared() * 2.0 / 3.0
}
