//! Candidates for the next view: of many looks at the target, those that show it as a whole, with what they would tell.

use nalgebra::{Matrix6, SMatrix, Vector3};

use super::known::Planner;
use crate::{
    Base, Camera, Flange, Point, Pose, Setup, Target,
    math::{lie, linalg, parallel, random::halton},
    model::residual::Residual,
    register::rigid_fit::point_jacobian,
    solve::least_squares::Matrix12,
    tools::plan::{
        Setting, alike,
        looks::{self, Viewing},
        reach::{ArmReach, Reach},
        refusals::Refusals,
    },
};

/// The target is seen as a whole when this many standard deviations of its predicted place leave it in the image.
const SURE: f64 = 2.0;
/// Around a pose that failed nothing is tried again, rad and m.
const NOT_AGAIN: Residual = Residual { angle: 0.15, distance: 0.06 };
/// So many looks are drawn for each that is to be compared, where few are seen.
const DRAWS: usize = 12;
/// The same of an arm that cannot turn its flange as it likes: each takes a search for joint values.
const DRAWS_OF_FEW_JOINTS: usize = 8;
/// Looks that the threads share before it is asked whether they are enough.
const AT_ONCE: usize = 256;

/// A candidate, and its information.
pub(super) struct Offer {
    pub(super) base_from_flange: Pose<Base, Flange>,
    pub(super) information: Matrix12,
}

/// What comes of a look at the target.
enum Outcome {
    /// A candidate.
    Offered(Box<Offer>),
    /// It does not show the whole target for sure.
    Unseen,
    /// It is too like a capture that was taken, or a place that failed.
    Alike,
    /// The robot does not reach it.
    TooFar,
}

/// What all looks have in common.
struct Sought {
    outline: [Vector3<f64>; 4],
    /// Of camera and target, where their places are not known well.
    covariance: Option<Matrix12>,
}

impl Planner {
    /// All candidates that show the target, with their information.
    pub(super) fn offers(&self, information: &Matrix12, refusals: &mut Refusals) -> Vec<Offer> {
        let covariance = linalg::invert_spd(information).unwrap_or_else(Matrix12::zeros);
        // without a guess the place of both is known as well as it has to be
        let covariance = self.guess.map(|_| covariance);
        let sought = Sought { outline: looks::outline(&self.setting.target), covariance };
        let draws = if self.reach.has_few_joints() { DRAWS_OF_FEW_JOINTS } else { DRAWS };
        let most = self.candidates * draws;
        let (mut all, mut begun) = (vec![], 0);
        while begun < most && all.len() < self.candidates {
            let count = AT_ONCE.min(most - begun);
            let look = |k: usize| self.outcome(begun + k, &sought);
            for outcome in parallel::in_order(count, self.threads, look) {
                // the same ones, however many were looked at by then
                if all.len() == self.candidates {
                    break;
                }
                match outcome {
                    Outcome::Offered(offer) => all.push(*offer),
                    Outcome::Unseen => refusals.unseen += 1,
                    Outcome::Alike => refusals.alike += 1,
                    Outcome::TooFar => refusals.unreached += 1,
                }
            }
            begun += count;
        }
        all
    }

    /// What comes of look number `k`.
    fn outcome(&self, k: usize, sought: &Sought) -> Outcome {
        let Some(base_from_flange) = self.drawn(k, &sought.outline) else { return Outcome::Unseen };
        if self.is_known(&base_from_flange) {
            return Outcome::Alike;
        }
        if !self.is_seen(&base_from_flange, sought) {
            return Outcome::Unseen;
        }
        if self.reach.is_surely_too_far(&base_from_flange) {
            return Outcome::TooFar;
        }
        match self.setting.information(&base_from_flange) {
            Some(information) => {
                Outcome::Offered(Box::new(Offer { base_from_flange, information }))
            }
            None => Outcome::Unseen,
        }
    }

    /// Candidate number `k`: a look at the target.
    fn drawn(&self, k: usize, outline: &[Vector3<f64>; 4]) -> Option<Pose<Base, Flange>> {
        let Setting { hand_eye, setup, camera, .. } = &self.setting;
        match &self.reach {
            Reach::Arm(arm) if self.reach.has_few_joints() => {
                self.drawn_by_few_joints(arm, k, outline)
            }
            _ => {
                let look = looks::look(camera, &self.viewing, k);
                let camera_from_target = look.pose(camera, &looks::middle(outline))?;
                Some(hand_eye.base_from_flange(*setup, &camera_from_target))
            }
        }
    }

    /// The same of an arm that cannot turn its flange as it likes: the target's centre is where the look has it, turned as the
    /// joints allow.
    fn drawn_by_few_joints(
        &self,
        arm: &ArmReach,
        k: usize,
        outline: &[Vector3<f64>; 4],
    ) -> Option<Pose<Base, Flange>> {
        let Setting { hand_eye, setup, camera, .. } = &self.setting;
        let look = looks::look(camera, &self.viewing, k);
        let shares = halton(k, looks::COORDINATES + arm.limits.len());
        let start = arm.within_limits(&shares[looks::COORDINATES..]);
        let centre = Point::from_vector(looks::middle(outline));
        // few joints rarely have every distance to offer: that of where they start is kept
        let view = hand_eye.camera_from_target(*setup, &arm.arm.base_from_flange(&start));
        let depth = (view * centre).vector().z;
        let Viewing { nearest_m, farthest_m, .. } = self.viewing;
        let is_usual = (nearest_m..=farthest_m).contains(&depth);
        let depth = if is_usual { depth } else { look.depth_m };
        let pixel = look.whole_at(depth, camera, outline);
        let seen = Point::from_vector(camera.ray(&pixel)? * depth);
        let of_target = (hand_eye.anchor_from_target * centre).vector();
        let of_camera = (hand_eye.mount_from_camera * seen).vector();
        match setup {
            Setup::EyeInHand => arm.leading(&of_camera, &of_target, &start),
            Setup::EyeToHand => arm.leading(&of_target, &of_camera, &start),
        }
    }

    fn is_known(&self, pose: &Pose<Base, Flange>) -> bool {
        self.taken.iter().any(|t| alike(&t.base_from_flange, pose))
            || self.failed.iter().any(|f| Residual::between(f, pose).is_within(NOT_AGAIN))
    }

    /// Whether the whole target is in the image, not too flat and sharp, as far as its place is known.
    fn is_seen(&self, pose: &Pose<Base, Flange>, Sought { outline, covariance }: &Sought) -> bool {
        let Setting { camera, .. } = &self.setting;
        let view = self.setting.pair(pose).camera_from_target;
        let (rotation, v) = (view.rotation(), &self.viewing);
        let depth = (view * Point::from_vector(looks::middle(outline))).vector().z;
        if !(v.nearest_m..=v.farthest_m).contains(&depth) {
            return false;
        }
        let of_view = covariance.as_ref().map(|s| view_covariance(&view, s));
        let size = [f64::from(camera.width), f64::from(camera.height)];
        outline.iter().all(|p| {
            let seen = (view * Point::from_vector(*p)).vector();
            let flat = rotation.column(2).dot(&seen) < v.steepest.cos() * seen.norm();
            let Some((pixel, by_point)) = camera.project_with_jacobian(&seen) else { return false };
            let by_pose: SMatrix<f64, 3, 6> = rotation * point_jacobian(p);
            let j = by_point * by_pose;
            let off = of_view.map_or([0.0; 2], |s| {
                let s = j * s * j.transpose();
                [s[(0, 0)], s[(1, 1)]].map(|variance| SURE * variance.max(0.0).sqrt())
            });
            let inside = |k: usize| {
                let margin = v.margin * size[k] + off[k];
                pixel[k] > margin && pixel[k] < size[k] - 1.0 - margin
            };
            !flat && inside(0) && inside(1)
        })
    }
}

/// Covariance of where the target will be seen, in the target: `δB = -Ad(B⁻¹) δX + δY`.
fn view_covariance(view: &Pose<Camera, Target>, covariance: &Matrix12) -> Matrix6<f64> {
    let mut j = SMatrix::<f64, 6, 12>::zeros();
    j.fixed_view_mut::<6, 6>(0, 0).copy_from(&-lie::adjoint(view.inverse().iso()));
    j.fixed_view_mut::<6, 6>(0, 6).fill_with_identity();
    j * covariance * j.transpose()
}
