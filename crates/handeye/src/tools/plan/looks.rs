//! How the camera may look at the target: where in the image, from how far, tilted and turned. Candidates are spread evenly
//! over all of that.

use nalgebra::{Rotation3, Vector2, Vector3};

use crate::{Camera, Intrinsics, Point, Pose, Target, TargetModel, math::random::halton};

/// How a target is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Where its centre is in the image, px.
    pub centre: Vector2<f64>,
    /// How far the centre is along its ray, in units of the ray with z = 1: m.
    pub depth_m: f64,
    /// Angle between its normal and the optical axis, rad.
    pub tilt: f64,
    /// Direction of the axis about which it is tilted, in the image, rad.
    pub towards: f64,
    /// Turn about its own normal, rad.
    pub spin: f64,
}

/// What looks are offered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewing {
    /// Least distance of the target's centre, m: nearer, the image is not sharp.
    pub nearest_m: f64,
    /// Largest distance, m.
    pub farthest_m: f64,
    /// Largest angle between a line of sight and the target's normal, rad: flatter, corners are not found well.
    pub steepest: f64,
    /// Share of the image's sides that stays free around the target.
    pub margin: f64,
}

/// The centre of a look keeps these shares of the image's sides.
const KEPT: (f64, f64) = (0.15, 0.7);

impl Look {
    /// Where the target is then; `None` where the pixel is seen by no ray.
    pub fn pose(&self, camera: &Intrinsics, centre: &Vector3<f64>) -> Option<Pose<Camera, Target>> {
        let (sine, cosine) = self.towards.sin_cos();
        let rotation = Rotation3::new(Vector3::new(cosine, sine, 0.0) * self.tilt)
            * Rotation3::new(Vector3::z() * self.spin);
        let centre_in_camera = camera.ray(&self.centre)? * self.depth_m;
        Some(Pose::from_parts(rotation.matrix(), centre_in_camera - rotation * centre))
    }

    /// Its centre, drawn so near to the middle of the image that a square with the target's shorter side is whole in it at
    /// this depth (m).
    pub fn whole_at(
        &self,
        depth_m: f64,
        camera: &Intrinsics,
        outline: &[Vector3<f64>; 4],
    ) -> Vector2<f64> {
        let side = (outline[1] - outline[0]).norm().min((outline[2] - outline[1]).norm());
        let half_px = 0.5 * side * camera.fx.min(camera.fy) / depth_m;
        let drawn = |pixel: f64, side: u32| {
            let side = f64::from(side);
            let room = (1.0 - 2.0 * half_px / side).clamp(0.0, KEPT.1) / KEPT.1;
            0.5 * side - 0.5 + (pixel - 0.5 * side + 0.5) * room
        };
        Vector2::new(drawn(self.centre.x, camera.width), drawn(self.centre.y, camera.height))
    }
}

/// Largest angle between a line of sight and the target's normal, unless something else is known: 55 degrees.
pub const USUALLY_STEEPEST: f64 = 0.96;
/// Free share of the image, unless something else is known.
pub const USUAL_MARGIN: f64 = 0.03;
/// The target's longer side takes these shares of the image's shorter one, unless distances are known.
const USUAL_SHARES: (f64, f64) = (0.35, 0.85);

impl Viewing {
    /// Distances from which a target is neither small nor cut off.
    pub fn usual(camera: &Intrinsics, target: &TargetModel) -> Viewing {
        let corners = outline(target);
        let longest = |p: &Vector3<f64>| corners.iter().map(|q| (p - q).norm()).fold(0.0, f64::max);
        let side = corners.iter().map(longest).fold(1e-6, f64::max);
        let image = f64::from(camera.width.min(camera.height));
        let from = |share: f64| camera.fx.min(camera.fy) * side / (share * image);
        let (small, large) = USUAL_SHARES;
        Viewing {
            nearest_m: from(large),
            farthest_m: from(small),
            steepest: USUALLY_STEEPEST,
            margin: USUAL_MARGIN,
        }
    }
}

/// The four corners of the box around the target's corners, in the target.
pub fn outline(target: &TargetModel) -> [Vector3<f64>; 4] {
    let start = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    let corners = target.corners();
    let (low, high) =
        corners.iter().map(Point::vector).fold(start, |(low, high), p| (low.inf(&p), high.sup(&p)));
    let margin = 0.5 * target.pitch_m();
    let (low, high) = match corners.is_empty() {
        true => (Vector3::zeros(), Vector3::zeros()),
        false => (low.add_scalar(-margin), high.add_scalar(margin)),
    };
    [(low.x, low.y), (high.x, low.y), (high.x, high.y), (low.x, high.y)]
        .map(|(x, y)| Vector3::new(x, y, 0.0))
}

/// The middle of an outline.
pub fn middle(outline: &[Vector3<f64>; 4]) -> Vector3<f64> {
    (outline[0] + outline[2]) * 0.5
}

/// Numbers that tell one look from another.
pub const COORDINATES: usize = 6;

/// Looks number `k`, of any number of them spread evenly.
pub fn look(camera: &Intrinsics, viewing: &Viewing, k: usize) -> Look {
    let share = halton(k, COORDINATES);
    let (u, v, far) = (share[0], share[1], share[2]);
    let (tilt, towards, spin) = (share[3], share[4], share[5]);
    let turn = std::f64::consts::TAU;
    // near the border no target is whole: looks keep to the middle
    let pixel = |side: u32, share: f64| f64::from(side) * (KEPT.0 + KEPT.1 * share) - 0.5;
    Look {
        centre: Vector2::new(pixel(camera.width, u), pixel(camera.height, v)),
        depth_m: viewing.nearest_m + (viewing.farthest_m - viewing.nearest_m) * far,
        tilt: viewing.steepest * tilt,
        towards: turn * towards,
        spin: turn * (spin - 0.5),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_are_spread_over_image_distance_and_turns() {
        let camera = Intrinsics::pinhole(1920, 1200, 1800.0, 1800.0, 959.5, 599.5);
        let board = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 };
        let viewing = Viewing::usual(&camera, &board);
        // 9 x 6 squares of 30 mm, their diagonal 325 mm
        assert!(
            (0.5..0.6).contains(&viewing.nearest_m) && (1.3..1.5).contains(&viewing.farthest_m),
            "{viewing:?}"
        );
        let all: Vec<Look> = (0..1000).map(|k| look(&camera, &viewing, k)).collect();
        let mean = |of: &dyn Fn(&Look) -> f64| all.iter().map(of).sum::<f64>() / 1000.0;
        assert!((mean(&|l| l.centre.x) - 959.5).abs() < 5.0);
        assert!((mean(&|l| l.tilt) - 0.5 * viewing.steepest).abs() < 0.01);
        assert!(mean(&|l| l.spin).abs() < 0.02);
        // near enough that little of the image is left, its centre keeps to the middle
        let centres = |depth: f64| {
            let of = |l: &Look| (l.whole_at(depth, &camera, &outline(&board)) - l.centre).norm();
            all.iter().map(of).fold(0.0, f64::max)
        };
        assert!(centres(10.0) < 1e-9 && centres(0.3) > 100.0, "{} {}", centres(10.0), centres(0.3));
        let centre = middle(&outline(&board));
        assert!((centre - Vector3::new(0.12, 0.075, 0.0)).norm() < 1e-12);
        let seen = all[7].pose(&camera, &centre).unwrap() * Point::from_vector(centre);
        let pixel = camera.project(&seen.vector()).unwrap();
        assert!(
            (pixel - all[7].centre).norm() < 1e-9
                && (seen.vector().z - all[7].depth_m).abs() < 1e-12
        );
    }
}
