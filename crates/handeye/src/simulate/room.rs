//! Things of simple shapes on a table, and what a 3D camera sees of them.

use nalgebra::{Isometry3, Vector3};

use crate::{Intrinsics, Scan, math::random::Random};

/// A simple shape, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Solid {
    /// A ball around the origin.
    Ball {
        /// Its radius.
        radius: f64,
    },
    /// A block around the origin.
    Block {
        /// Half its edges.
        half: [f64; 3],
    },
    /// A round bar along z, around the origin.
    Bar {
        /// Its radius.
        radius: f64,
        /// Half its length.
        half: f64,
    },
}

/// A shape at its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thing {
    /// What it is.
    pub solid: Solid,
    /// Where it is.
    pub room_from_thing: Isometry3<f64>,
}

/// Things.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Room {
    /// All of them.
    pub things: Vec<Thing>,
}

impl Room {
    /// A table with a board, blocks, balls and bars on it, within 0.3 m of the origin; z is up.
    pub fn of_a_cell(random: &mut Random) -> Self {
        let block = |half| Solid::Block { half };
        let at =
            |x: f64, y: f64, z: f64, turn: [f64; 3]| Isometry3::new([x, y, z].into(), turn.into());
        let mut room = Self::default();
        let mut put = |solid, room_from_thing| room.things.push(Thing { solid, room_from_thing });
        put(block([0.5, 0.4, 0.01]), at(0.0, 0.0, -0.01, [0.0; 3]));
        let lean = random.between(0.3, 0.8);
        put(
            block([0.1, 0.075, 0.003]),
            at(random.between(-0.1, 0.0), 0.12, 0.08, [lean, 0.0, 0.2]),
        );
        for _ in 0..6 {
            let (x, y) = (random.between(-0.25, 0.25), random.between(-0.2, 0.1));
            let turn = [0.0, 0.0, random.between(0.0, 3.0)];
            let size = random.between(0.02, 0.05);
            match (random.unit() * 3.0) as usize {
                0 => put(block([size, 0.7 * size, size]), at(x, y, size, turn)),
                1 => put(Solid::Ball { radius: size }, at(x, y, size, turn)),
                _ => put(Solid::Bar { radius: 0.6 * size, half: size }, at(x, y, size, turn)),
            }
        }
        room
    }

    /// What a camera sees from `room_from_camera`, each range off by a normal error (m) along its ray.
    pub fn scan(
        &self,
        room_from_camera: &Isometry3<f64>,
        intrinsics: &Intrinsics,
        sigma_m: f64,
        random: &mut Random,
    ) -> Scan {
        let (width, height) = (intrinsics.width as usize, intrinsics.height as usize);
        let views: Vec<Isometry3<f64>> =
            self.things.iter().map(|t| t.room_from_thing.inv_mul(room_from_camera)).collect();
        let mut points = Vec::with_capacity(width * height);
        for v in 0..height {
            for u in 0..width {
                let ray = intrinsics
                    .undistort(&[u as f64, v as f64].into())
                    .map(|n| n.push(1.0).normalize());
                let range = ray
                    .and_then(|ray| self.range(&views, &ray))
                    .map(|r| r + sigma_m * random.normal());
                let point = ray
                    .zip(range)
                    .map_or([f32::NAN; 3], |(ray, r)| (ray * r).map(|x| x as f32).into());
                points.push(point);
            }
        }
        Scan::new(width, height, points).expect("as many points as pixels")
    }

    /// From the camera to the first thing along a ray.
    fn range(&self, views: &[Isometry3<f64>], ray: &Vector3<f64>) -> Option<f64> {
        let hits = self.things.iter().zip(views).filter_map(|(thing, thing_from_camera)| {
            let from = thing_from_camera.translation.vector;
            thing.solid.range(&from, &(thing_from_camera.rotation * ray))
        });
        hits.min_by(f64::total_cmp)
    }
}

impl Solid {
    /// Where a ray enters.
    fn range(&self, from: &Vector3<f64>, ray: &Vector3<f64>) -> Option<f64> {
        let first = |near: f64, far: f64| (near <= far && near > 0.0).then_some(near);
        match *self {
            Self::Ball { radius } => {
                let (near, far) = round(from, ray, radius)?;
                first(near, far)
            }
            Self::Block { half } => {
                let (near, far) = (0..3)
                    .map(|k| slab(from[k], ray[k], half[k]))
                    .fold((f64::NEG_INFINITY, f64::INFINITY), |all, one| {
                        (all.0.max(one.0), all.1.min(one.1))
                    });
                first(near, far)
            }
            Self::Bar { radius, half } => {
                let across = |v: &Vector3<f64>| Vector3::new(v.x, v.y, 0.0);
                let side = round(&across(from), &across(ray), radius)?;
                let ends = slab(from.z, ray.z, half);
                first(side.0.max(ends.0), side.1.min(ends.1))
            }
        }
    }
}

/// Where a line is within `radius` of the origin.
fn round(from: &Vector3<f64>, along: &Vector3<f64>, radius: f64) -> Option<(f64, f64)> {
    let (a, b) = (along.norm_squared(), from.dot(along));
    let root = (b * b - a * (from.norm_squared() - radius * radius)).sqrt();
    (root >= 0.0).then(|| ((-b - root) / a, (-b + root) / a))
}

/// Where a coordinate is within `half` of zero.
fn slab(from: f64, along: f64, half: f64) -> (f64, f64) {
    let (a, b) = ((-half - from) / along, (half - from) / along);
    (a.min(b), a.max(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(solid: Solid, from: [f64; 3], ray: [f64; 3]) -> Option<f64> {
        solid.range(&from.into(), &Vector3::from(ray).normalize())
    }

    #[test]
    fn rays_end_where_things_begin() {
        let ball = Solid::Ball { radius: 0.1 };
        assert!((range(ball, [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]).unwrap() - 0.9).abs() < 1e-12);
        assert_eq!(range(ball, [0.2, 0.0, -1.0], [0.0, 0.0, 1.0]), None);
        assert_eq!(range(ball, [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]), None);
        let block = Solid::Block { half: [0.1, 0.2, 0.3] };
        assert!((range(block, [-1.0, 0.1, 0.1], [1.0, 0.0, 0.0]).unwrap() - 0.9).abs() < 1e-12);
        assert_eq!(range(block, [-1.0, 0.3, 0.1], [1.0, 0.0, 0.0]), None);
        let bar = Solid::Bar { radius: 0.1, half: 0.3 };
        assert!((range(bar, [-1.0, 0.0, 0.2], [1.0, 0.0, 0.0]).unwrap() - 0.9).abs() < 1e-12);
        assert!((range(bar, [0.05, 0.0, 1.0], [0.0, 0.0, -1.0]).unwrap() - 0.7).abs() < 1e-12);
        assert_eq!(range(bar, [-1.0, 0.0, 0.4], [1.0, 0.0, 0.0]), None);
    }

    #[test]
    fn a_scan_shows_the_table_where_it_is() {
        let room = Room::of_a_cell(&mut Random::new(1));
        let intrinsics = Intrinsics::pinhole(60, 40, 60.0, 60.0, 29.5, 19.5);
        let above = Isometry3::new([0.0, 0.0, 0.8].into(), [std::f64::consts::PI, 0.0, 0.0].into());
        let scan = room.scan(&above, &intrinsics, 0.0, &mut Random::new(2));
        let heights = scan.points().iter().filter(|p| p[0].is_finite()).map(|p| 0.8 - p[2]);
        let (mut table, mut things) = (0, 0);
        for height in heights {
            assert!(height > -1e-6, "{height}");
            if height < 1e-6 { table += 1 } else { things += 1 }
        }
        assert!(table > 1000 && things > 100, "{table} {things}");
    }
}
