//! Solids that may collide: capsules for what moves, boxes for what stands in the cell, and how far they are apart.
//!
//! A capsule is all that is within `r` of a segment. Two are apart by the distance of their segments less both radii
//! (C. Ericson, *Real-Time Collision Detection*, 2005, section 5.1.9); the distance of a point of a segment from a box
//! is convex along the segment.

use nalgebra::{Isometry3, Point3, Vector3};

use crate::Error;

/// All that is within `radius` of a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capsule {
    /// One end of the segment, m.
    pub from: Vector3<f64>,
    /// The other end; the same for a ball.
    pub to: Vector3<f64>,
    /// Radius, m.
    pub radius: f64,
}

/// A box that may be turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cuboid {
    /// Where its middle is, and how it is turned.
    pub middle: Isometry3<f64>,
    /// Half of its edges, m.
    pub half: Vector3<f64>,
}

/// Halvings of the golden section: to a millionth of the segment's length.
const SECTIONS: usize = 29;
/// What is left of an interval: `(√5 - 1) / 2`.
const GOLDEN: f64 = 0.618_033_988_749_895;

impl Capsule {
    /// The same where a frame stands.
    pub fn placed(&self, at: &Isometry3<f64>) -> Capsule {
        let place = |p: &Vector3<f64>| (at * Point3::from(*p)).coords;
        Capsule { from: place(&self.from), to: place(&self.to), radius: self.radius }
    }

    /// The smallest one about the middle of a box that holds all of it.
    pub fn around(cuboid: &Cuboid) -> Capsule {
        let long = cuboid.half.imax();
        let across = Vector3::from_fn(|k, _| if k == long { 0.0 } else { cuboid.half[k] });
        let along = Vector3::from_fn(|k, _| if k == long { cuboid.half[k] } else { 0.0 });
        Capsule { from: -along, to: along, radius: across.norm() }.placed(&cuboid.middle)
    }

    /// One that holds all points: along the direction in which they spread most. `None` without any.
    pub fn holding(points: &[Vector3<f64>]) -> Option<Capsule> {
        let count = points.len() as f64;
        let mean = points.iter().sum::<Vector3<f64>>() / count;
        let spread = points.iter().map(|p| (p - mean) * (p - mean).transpose()).sum();
        let eigen = nalgebra::SymmetricEigen::new(spread);
        let axis = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
        let across = |p: &Vector3<f64>| (p - mean - axis * axis.dot(&(p - mean))).norm();
        let radius = points.iter().map(across).fold(0.0, f64::max);
        // an end cap reaches as far beyond the segment as the sphere does where the point lies
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for p in points {
            let reach = (radius * radius - across(p).powi(2)).max(0.0).sqrt();
            let along = axis.dot(&(p - mean));
            low = low.min(along + reach);
            high = high.max(along - reach);
        }
        let (low, high) =
            if low > high { (0.5 * (low + high), 0.5 * (low + high)) } else { (low, high) };
        let found = Capsule { from: mean + axis * low, to: mean + axis * high, radius };
        (count > 0.0 && found.is_finite()).then_some(found)
    }

    /// Distance of two surfaces, m; negative where they overlap.
    pub fn apart_from(&self, other: &Capsule) -> f64 {
        segments(self, other) - self.radius - other.radius
    }

    /// Distance from the surface of a box, m; negative where they overlap.
    pub fn apart_from_box(&self, cuboid: &Cuboid) -> f64 {
        let inverse = cuboid.middle.inverse();
        let [from, to] = [self.from, self.to].map(|p| (inverse * Point3::from(p)).coords);
        let outside = |t: f64| {
            let p = from + (to - from) * t;
            (p.abs() - cuboid.half).map(|x| x.max(0.0)).norm()
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..SECTIONS {
            let (a, b) = (high - (high - low) * GOLDEN, low + (high - low) * GOLDEN);
            if outside(a) < outside(b) { high = b } else { low = a }
        }
        let ends = outside(0.0).min(outside(1.0));
        ends.min(outside(0.5 * (low + high))) - self.radius
    }

    fn is_finite(&self) -> bool {
        self.from.iter().chain(&self.to).all(|x| x.is_finite()) && self.radius.is_finite()
    }

    /// # Errors
    /// A capsule of numbers that are none, or of a negative radius.
    pub fn check(&self) -> Result<(), Error> {
        match self.is_finite() && self.radius >= 0.0 {
            true => Ok(()),
            false => Err(Error::Invalid("a capsule needs finite ends and a radius".into())),
        }
    }
}

impl Cuboid {
    /// # Errors
    /// A box of numbers that are none, or of edges that are not positive.
    pub fn check(&self) -> Result<(), Error> {
        let finite = self.middle.to_homogeneous().iter().all(|x| x.is_finite());
        match finite && self.half.iter().all(|x| x.is_finite() && *x > 0.0) {
            true => Ok(()),
            false => Err(Error::Invalid("a box needs a place and three positive edges".into())),
        }
    }
}

/// Distance of two segments.
fn segments(a: &Capsule, b: &Capsule) -> f64 {
    let (u, v, w) = (a.to - a.from, b.to - b.from, a.from - b.from);
    let (uu, vv, uv) = (u.norm_squared(), v.norm_squared(), u.dot(&v));
    let (uw, vw) = (u.dot(&w), v.dot(&w));
    let squared = uu * vv - uv * uv;
    let share = |x: f64, whole: f64| if whole > 0.0 { (x / whole).clamp(0.0, 1.0) } else { 0.0 };
    // nearest to b on the line of a, then on b to that, then on a again to where b ends
    let s = if squared > 1e-12 * uu * vv { share(uv * vw - vv * uw, squared) } else { 0.0 };
    let t = share(uv * s + vw, vv);
    let s = share(uv * t - uw, uu);
    (w + u * s - v * t).norm()
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;

    use super::*;
    use crate::math::random::Random;

    fn capsule(random: &mut Random) -> Capsule {
        Capsule { from: random.normal3(), to: random.normal3(), radius: 0.2 }
    }

    fn along(capsule: &Capsule, k: usize) -> Vector3<f64> {
        capsule.from + (capsule.to - capsule.from) * (k as f64 / 300.0)
    }

    #[test]
    fn capsules_are_as_far_apart_as_their_nearest_points() {
        let mut random = Random::new(1);
        for _ in 0..40 {
            let (a, b) = (capsule(&mut random), capsule(&mut random));
            let each = (0..=300).flat_map(|i| (0..=300).map(move |j| (i, j)));
            let nearest = each.map(|(i, j)| (along(&a, i) - along(&b, j)).norm());
            let tried = nearest.fold(f64::INFINITY, f64::min) - 0.4;
            let found = a.apart_from(&b);
            assert!(found <= tried + 1e-12 && found > tried - 0.02, "{found} {tried}");
            assert!((b.apart_from(&a) - found).abs() < 1e-12);
        }
        let ball = |x: f64| Capsule { from: Vector3::x() * x, to: Vector3::x() * x, radius: 0.5 };
        assert!((ball(0.0).apart_from(&ball(3.0)) - 2.0).abs() < 1e-15);
        // parallel ones, one beside the other
        let rod =
            |y: f64| Capsule { from: Vector3::y() * y, to: Vector3::new(1.0, y, 0.0), radius: 0.1 };
        assert!((rod(0.0).apart_from(&rod(1.0)) - 0.8).abs() < 1e-12);
    }

    #[test]
    fn a_capsule_is_as_far_from_a_turned_box_as_its_nearest_point() {
        let mut random = Random::new(2);
        for _ in 0..200 {
            let a = capsule(&mut random);
            let half = Vector3::new(0.3, 0.5, 0.8);
            let turn = UnitQuaternion::new(random.normal3());
            let cuboid =
                Cuboid { middle: Isometry3::from_parts(random.normal3().into(), turn), half };
            let from_box = |p: Vector3<f64>| {
                let inside = cuboid.middle.inverse() * Point3::from(p);
                (inside.coords.abs() - half).map(|x| x.max(0.0)).norm()
            };
            let tried = (0..=300).map(|k| from_box(along(&a, k))).fold(f64::INFINITY, f64::min);
            let found = a.apart_from_box(&cuboid) + a.radius;
            assert!(found <= tried + 1e-6 && found > tried - 0.02, "{found} {tried}");
        }
    }

    #[test]
    fn a_capsule_holds_the_box_or_the_points_that_it_is_made_of() {
        let mut random = Random::new(3);
        let outside =
            |c: &Capsule, p: Vector3<f64>| Capsule { from: p, to: p, radius: 0.0 }.apart_from(c);
        for _ in 0..20 {
            let turn = UnitQuaternion::new(random.normal3());
            let half = random.normal3().abs();
            let cuboid =
                Cuboid { middle: Isometry3::from_parts(random.normal3().into(), turn), half };
            let corner = |k: usize| {
                let sign = |axis: usize| if k >> axis & 1 == 0 { -half[axis] } else { half[axis] };
                (cuboid.middle * Point3::new(sign(0), sign(1), sign(2))).coords
            };
            let corners: Vec<Vector3<f64>> = (0..8).map(corner).collect();
            for capsule in [Capsule::around(&cuboid), Capsule::holding(&corners).unwrap()] {
                assert!(corners.iter().all(|p| outside(&capsule, *p) < 1e-9), "{capsule:?}");
            }
        }
        assert!(Capsule::holding(&[]).is_none());
    }
}
