//! Which corners to touch: on the one fixed board (eye-in-hand), or on boards laid where the camera sees them (eye-to-hand).
//!
//! A touch says where a corner `p` is in the base, up to the hand that led the tip, and to where the tip really is in the
//! flange, `b`, which all touches share:
//!
//! ```text
//! eye-in-hand   Y p = P + R_f b            eye-to-hand   X B p = P + R_f b,   B as the image shows it
//! ```

use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, SMatrix, Vector2, Vector3};

use super::{
    Planner, Setting, looks,
    planner::{ENOUGH, change},
};
use crate::{
    Camera, Point, Pose, Setup, Target, TargetModel,
    estimate::predict::PredictedTre,
    math::linalg::{self, FREE_SIGMA},
    register::rigid_fit::point_jacobian,
    solve::least_squares::Matrix12,
};

/// How well touches are made, standard deviations per axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TouchNoise {
    /// How well the tip is led onto a corner, m.
    pub touch_m: f64,
    /// How well the tip is known in the flange, m.
    pub tip_m: f64,
}

impl Default for TouchNoise {
    /// A careful hand, and a tip that a robot's own wizard has found.
    fn default() -> Self {
        Self { touch_m: 0.2e-3, tip_m: 0.5e-3 }
    }
}

/// A corner to touch.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedTouch {
    /// The number of the board laid into the cell, from 1; 0 is the one fixed board.
    pub placement: usize,
    /// Where that board is to lie, seen by the camera; `None` for the fixed one.
    pub camera_from_target: Option<Pose<Camera, Target>>,
    /// The corner.
    pub corner: u32,
    /// Expected error before, `None` where something is not determined.
    pub before: Option<PredictedTre>,
    /// Expected error with this touch.
    pub after: Option<PredictedTre>,
}

impl PlannedTouch {
    /// Which corner, and what it brings.
    pub fn reason(&self) -> String {
        let board = match self.placement {
            0 => "the board".to_owned(),
            k => format!("board {k}, laid where the camera sees it"),
        };
        let brings = change(self.before.as_ref(), self.after.as_ref());
        format!("corner {} of {board}: {brings}", self.corner)
    }
}

/// Where boards are laid: their centres as shares of the image's sides.
const LAID: [(f64, f64); 3] = [(0.3, 0.35), (0.7, 0.35), (0.5, 0.7)];
/// Corners that are considered on one board: the outermost ones, and some within.
const MOST_CORNERS: usize = 9;

/// Camera, target, boards that were laid, the tip: all unknowns of touches.
struct Unknowns {
    information: DMatrix<f64>,
}

/// The tip's three numbers stand behind `X` and `Y`.
const TIP: usize = 12;
const BOARDS: usize = 15;

impl Unknowns {
    fn of(captures: &Matrix12, noise: &TouchNoise) -> Unknowns {
        let mut information = DMatrix::zeros(BOARDS, BOARDS);
        information.view_mut((0, 0), (12, 12)).copy_from(captures);
        (TIP..BOARDS).for_each(|k| information[(k, k)] = noise.tip_m.powi(-2));
        Unknowns { information }
    }

    /// With one more board, whose pose the image determines.
    fn with_board(&self, of_image: &Matrix6<f64>) -> Unknowns {
        let old = self.information.nrows();
        let mut information = self.information.clone().resize(old + 6, old + 6, 0.0);
        information.view_mut((old, old), (6, 6)).copy_from(of_image);
        Unknowns { information }
    }

    /// With a touch that moves so with what is unknown: columns beginning at these numbers.
    fn touched(&self, parts: &[(usize, DMatrix<f64>)], sigma: f64) -> Unknowns {
        let mut j = DMatrix::zeros(3, self.information.nrows());
        for (at, part) in parts {
            j.view_mut((0, *at), (3, part.ncols())).copy_from(part);
        }
        Unknowns { information: &self.information + j.transpose() * j / (sigma * sigma) }
    }

    /// Information on `X` and `Y` once the rest is as unknown as it is.
    fn of_hand_eye(&self) -> Matrix12 {
        let rest = self.information.nrows() - 12;
        let own = self.information.view((0, 0), (12, 12)).into_owned();
        let cross = self.information.view((0, 12), (12, rest)).into_owned();
        let other = self.information.view((12, 12), (rest, rest)).into_owned();
        let eliminated =
            linalg::inverse_spd(&other).map(|inverse| &cross * inverse * cross.transpose());
        let sum = eliminated.map_or(own.clone(), |less| own - less);
        Matrix12::from_fn(|i, k| 0.5 * (sum[(i, k)] + sum[(k, i)]))
    }
}

/// Corners far from each other: each next one has the largest product of distances to those before
/// it (F. Leja's points), the first one is corner 0.
pub fn spread_corners(target: &TargetModel, count: usize) -> Vec<u32> {
    let at: Vec<Vector3<f64>> = target.corners().iter().map(Point::vector).collect();
    let mut chosen: Vec<usize> = Vec::new();
    while chosen.len() < count.min(at.len()) {
        let room = |k: usize| chosen.iter().map(|&c| (at[k] - at[c]).norm()).product::<f64>();
        let free = (0..at.len()).filter(|k| !chosen.contains(k));
        let next = free.rev().max_by(|&a, &b| room(a).total_cmp(&room(b)));
        chosen.extend(next);
    }
    chosen.into_iter().map(|k| k as u32).collect()
}

/// How a place moves with a pose perturbed on the right, `R [-[p]ₓ, I]`.
fn by_pose(rotation: &Matrix3<f64>, p: &Vector3<f64>) -> DMatrix<f64> {
    let j: SMatrix<f64, 3, 6> = rotation * point_jacobian(p);
    DMatrix::from_fn(3, 6, |i, k| j[(i, k)])
}

impl Planner {
    /// Corners to touch, each of which lowers the expected error most beside those before it; no more than `most`, and no
    /// further once the expected error (95 %) is so far below a tolerance (mm) as that of views is to be: [`ENOUGH`].
    pub fn touches(
        &self,
        most: usize,
        noise: &TouchNoise,
        tolerance_mm: Option<f64>,
    ) -> Vec<PlannedTouch> {
        let here = self.refined();
        // the robot errs where it touches as it does where it takes captures
        let sigma = noise.touch_m.hypot(here.setting.noise.robot_position_m);
        let nothing = Matrix12::identity() * FREE_SIGMA.powi(-2);
        let mut unknowns = Unknowns::of(&(nothing + here.of_taken()), noise);
        let place = |id: &u32| Some((*id, here.setting.target.corner(*id)?.vector()));
        let spread = spread_corners(&here.setting.target, MOST_CORNERS);
        let corners: Vec<(u32, Vector3<f64>)> = spread.iter().filter_map(place).collect();
        let places: Vec<(usize, Option<Pose<Camera, Target>>)> = match here.setting.setup {
            Setup::EyeInHand => vec![(0, None)],
            Setup::EyeToHand => {
                let laid = LAID.iter().filter_map(|share| here.setting.laid(&here, *share));
                laid.enumerate().map(|(k, view)| (k + 1, Some(view))).collect()
            }
        };
        let count = here.taken.len();
        let mut all: Vec<PlannedTouch> = vec![];
        for (placement, view) in places {
            let mut board = 0;
            if let Some(view) = &view {
                let Some(of_image) = here.setting.of_picture(view) else { continue };
                board = unknowns.information.nrows();
                unknowns = unknowns.with_board(&of_image);
            }
            let mut free = corners.clone();
            while !free.is_empty() && all.len() < most {
                let before = here.setting.expected(&unknowns.of_hand_eye(), count);
                let is_enough = before
                    .as_ref()
                    .is_some_and(|b| tolerance_mm.is_some_and(|mm| b.p95 <= ENOUGH * mm));
                if is_enough {
                    return all;
                }
                let tried = free.iter().map(|(_, p)| {
                    unknowns.touched(&here.setting.by_touch(view.as_ref(), p, board), sigma)
                });
                let told = |u: &Unknowns| {
                    u.information.clone().cholesky().map_or(f64::NEG_INFINITY, |c| {
                        c.l_dirty().diagonal().iter().map(|d| d.ln()).sum()
                    })
                };
                let all_tried: Vec<Unknowns> = tried.collect();
                let gains = DVector::from_iterator(all_tried.len(), all_tried.iter().map(told));
                let best = gains.imax();
                let (corner, _) = free.remove(best);
                unknowns = Unknowns { information: all_tried[best].information.clone() };
                let after = here.setting.expected(&unknowns.of_hand_eye(), count);
                let camera_from_target = view;
                all.push(PlannedTouch { placement, camera_from_target, corner, before, after });
            }
        }
        all
    }
}

impl Setting {
    /// Where a board lies that is seen nearly straight on at this place of the image, in the middle of the distances.
    fn laid(&self, planner: &Planner, (u, v): (f64, f64)) -> Option<Pose<Camera, Target>> {
        let (camera, viewing) = (&self.camera, &planner.viewing);
        let pixel = Vector2::new(u * f64::from(camera.width), v * f64::from(camera.height));
        let look = looks::Look {
            centre: pixel,
            depth_m: 0.5 * (viewing.nearest_m + viewing.farthest_m),
            tilt: 0.0,
            towards: 0.0,
            spin: 0.0,
        };
        look.pose(camera, &looks::middle(&looks::outline(&self.target)))
    }

    /// How a touch of the corner at `p` moves with what is unknown.
    fn by_touch(
        &self,
        view: Option<&Pose<Camera, Target>>,
        p: &Vector3<f64>,
        board: usize,
    ) -> Vec<(usize, DMatrix<f64>)> {
        // the tip is led in the same way each time, so that its error stays the same in the base
        let tip = (TIP, -DMatrix::identity(3, 3));
        match view {
            None => {
                let y = self.hand_eye.anchor_from_target;
                vec![(6, by_pose(&y.rotation(), p)), tip]
            }
            Some(view) => {
                let x = self.hand_eye.mount_from_camera;
                let in_camera = (*view * Point::from_vector(*p)).vector();
                let of_board = x.rotation() * view.rotation();
                vec![(0, by_pose(&x.rotation(), &in_camera)), tip, (board, by_pose(&of_board, p))]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outer_corners_are_touched_first() {
        let board = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 };
        let mut first = spread_corners(&board, 4);
        first.sort_unstable();
        assert_eq!(first, [0, 8, 45, 53]);
    }
}
