//! About where the camera sits, from motions of which some may be wrong.
//!
//! ```text
//! A X = X B    with  log R_A = R_X log R_B    and    (R_A - I) t_X = R_X t_B - t_A
//! ```
//!
//! Any two motions about different axes give an answer; that with which most others agree is taken, and fitted
//! to all of those.
//!
//! F. Park, B. Martin, *Robot sensor calibration: solving AX = XB on the Euclidean group*, IEEE T-RA 10(5),
//! 1994.

use nalgebra::{Isometry3, Matrix3, Translation3, Vector3};

use crate::math::{jacobi, lie, linalg};

/// A motion of the mount, and as the scans have it.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    pub a: Isometry3<f64>,
    pub b: Isometry3<f64>,
}

/// Robot and scans turn by angles that differ by no more, rad, ...
const TURNED: f64 = 0.02;
/// ... and move along the axis by lengths that differ by no more, m.
const MOVED_M: f64 = 0.015;
/// Below this angle there is no axis, rad.
const LEAST_TURN: f64 = 0.05;
/// Axes of two motions that give an answer differ by so much, as a sine.
const CROSSED: f64 = 0.25;
/// A motion agrees with a camera that predicts it within this angle, rad, ...
const AGREES_RAD: f64 = 0.02;
/// ... and distance, m.
const AGREES_M: f64 = 0.015;
/// Pairs of motions that are tried.
const MOST_TRIED: usize = 2000;
/// Fewer motions that agree are chance.
const FEWEST: usize = 3;

/// Why a motion in the scans cannot be the robot's: both must turn by one angle, and move along the axis by one
/// length, wherever the camera sits.
pub fn contradiction(a: &Isometry3<f64>, b: &Isometry3<f64>) -> Option<String> {
    let (turn_a, turn_b) = (lie::so3_log(&a.rotation), lie::so3_log(&b.rotation));
    let (angle_a, angle_b) = (turn_a.norm(), turn_b.norm());
    if (angle_a - angle_b).abs() > TURNED {
        return Some(format!(
            "the robot turned by {:.1} deg between them, the scans by {:.1} deg",
            angle_a.to_degrees(),
            angle_b.to_degrees()
        ));
    }
    let along = |t: &Isometry3<f64>, w: &Vector3<f64>| t.translation.vector.dot(&w.normalize());
    if angle_a.min(angle_b) < LEAST_TURN {
        return None;
    }
    let (along_a, along_b) = (along(a, &turn_a), along(b, &turn_b));
    ((along_a - along_b).abs() > MOVED_M).then(|| {
        format!(
            "the robot moved by {:.0} mm along the axis of its turn between them, the scans by {:.0} mm",
            1e3 * along_a,
            1e3 * along_b
        )
    })
}

/// About where the camera sits on its mount; `None` where the motions do not tell.
pub fn camera(all: &[Motion]) -> Option<Isometry3<f64>> {
    let mut best: Vec<Motion> = vec![];
    let pairs = all.len() * all.len().saturating_sub(1) / 2;
    for k in (0..pairs).step_by(pairs.div_ceil(MOST_TRIED).max(1)) {
        let (i, j) = pair(k);
        let Some(x) = fitted(&[all[i], all[j]]) else { continue };
        let agreeing = agreeing(all, &x);
        if agreeing.len() > best.len() {
            best = agreeing;
        }
    }
    if best.len() < FEWEST {
        return None;
    }
    let x = fitted(&best)?;
    fitted(&agreeing(all, &x)).or(Some(x))
}

/// The pair with this number, of (1, 0), (2, 0), (2, 1), (3, 0) ...
fn pair(k: usize) -> (usize, usize) {
    let mut i = ((1.0 + (1.0 + 8.0 * k as f64).sqrt()) / 2.0) as usize;
    // the root is rounded
    while i * (i - 1) / 2 > k {
        i -= 1;
    }
    while i * (i + 1) / 2 <= k {
        i += 1;
    }
    (i, k - i * (i - 1) / 2)
}

fn agreeing(all: &[Motion], x: &Isometry3<f64>) -> Vec<Motion> {
    all.iter().filter(|m| agrees(&(m.a * x).inv_mul(&(x * m.b)))).copied().collect()
}

/// Whether two poses that differ by this are one, as far as robots and first guesses are right.
pub fn agrees(off: &Isometry3<f64>) -> bool {
    off.rotation.angle() < AGREES_RAD && off.translation.vector.norm() < AGREES_M
}

/// Least squares; `None` of motions about one axis.
fn fitted(motions: &[Motion]) -> Option<Isometry3<f64>> {
    let turns: Vec<_> = motions
        .iter()
        .map(|m| (lie::so3_log(&m.a.rotation), lie::so3_log(&m.b.rotation)))
        .collect();
    let scatter: Matrix3<f64> = turns.iter().map(|(a, _)| a * a.transpose()).sum();
    let (_, axes, _) = linalg::svd3(&scatter);
    if axes[1] < CROSSED * CROSSED * axes[0] || axes[0] < LEAST_TURN * LEAST_TURN {
        return None;
    }
    let mut h: Matrix3<f64> = turns.iter().map(|(a, b)| a * b.transpose()).sum();
    // two axes leave a mirror image: what is square to both turns as well
    for (k, (a, b)) in turns.iter().enumerate() {
        for (c, d) in &turns[..k] {
            h += a.cross(c) * b.cross(d).transpose();
        }
    }
    let rotation = jacobi::nearest_rotation(&h)?;
    let r = rotation.to_rotation_matrix();
    let (mut information, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for m in motions {
        let left = m.a.rotation.to_rotation_matrix().into_inner() - Matrix3::identity();
        information += left.transpose() * left;
        right += left.transpose() * (r * m.b.translation.vector - m.a.translation.vector);
    }
    let t = linalg::invert_spd(&information)? * right;
    Some(Isometry3::from_parts(Translation3::from(t), rotation))
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector6;

    use super::*;
    use crate::math::random::Random;

    fn some(random: &mut Random, turn: f64, shift: f64) -> Isometry3<f64> {
        let (w, v) = (random.normal3() * turn, random.normal3() * shift);
        lie::exp(&Vector6::new(w.x, w.y, w.z, v.x, v.y, v.z))
    }

    #[test]
    fn wrong_motions_do_not_move_the_camera() {
        let mut random = Random::new(4);
        let x = some(&mut random, 1.0, 0.1);
        let mut motions = vec![];
        for k in 0..12 {
            let a = some(&mut random, 0.3, 0.1);
            let b = if k % 3 == 0 { some(&mut random, 0.3, 0.1) } else { x.inverse() * a * x };
            motions.push(Motion { a, b });
        }
        let found = camera(&motions).unwrap();
        assert!(lie::log(&x.inv_mul(&found)).norm() < 1e-9);
    }

    #[test]
    fn turns_about_one_axis_do_not_tell() {
        let mut random = Random::new(5);
        let x = some(&mut random, 1.0, 0.1);
        let turn =
            |k: i32| Isometry3::new([0.1, 0.02, 0.3].into(), [0.0, 0.0, 0.2 * f64::from(k)].into());
        let motions: Vec<_> =
            (1..6).map(turn).map(|a| Motion { a, b: x.inverse() * a * x }).collect();
        assert!(camera(&motions).is_none());
    }

    #[test]
    fn a_motion_that_turns_otherwise_is_named() {
        let mut random = Random::new(6);
        let x = some(&mut random, 1.0, 0.1);
        let a = some(&mut random, 0.3, 0.1);
        assert_eq!(contradiction(&a, &(x.inverse() * a * x)), None);
        let other = Isometry3::rotation([0.1, 0.0, 0.0].into()) * a;
        assert!(contradiction(&other, &(x.inverse() * a * x)).unwrap().contains("turned by"));
    }
}
