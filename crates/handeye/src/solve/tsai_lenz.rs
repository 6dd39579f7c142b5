//! Hand-eye calibration by modified Rodrigues vectors, rotation first.
//!
//! With `P = 2 sin(θ/2) n` of each motion and `P' = tan(θ_X/2) n_X`, `A X = X B` gives
//!
//! ```text
//! (P_A + P_B) × P' = P_B - P_A          (R_A - I) t_X = R_X t_B - t_A
//! ```
//!
//! both linear, solved by least squares over all motions. Motions with `|P|` below 0.3 (17 degrees)
//! or above 1.7 (116 degrees) tell little or nothing and are left out, among up to 256 captures;
//! among more, or where too little would remain, all are used, through their moments. `P'` is
//! infinite for a camera turned by 180 degrees: near there the camera frame is turned first.
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone.
//!
//! R. Tsai and R. Lenz, *A new technique for fully autonomous and efficient 3D robotics hand/eye
//! calibration*, IEEE T-RA 5(3), 1989.

use nalgebra::{Matrix3, Matrix4, UnitQuaternion, Vector3, Vector4};

use super::{
    moments,
    moments::{Seen, Translations},
    shared::{open, place},
};
use crate::{Error, HandEye, PosePair, math::jacobi};

/// Lengths of `P`, of robot and camera, between which a motion is used.
const LENGTHS: [f64; 2] = [0.3, 1.7];
/// Up to this many captures every motion is looked at.
const SELECT_UP_TO: usize = 256;
/// Length of `P'` above which the camera frame is turned first: `X` is rotated by 179 degrees.
const LONG: f64 = 114.6;

/// Least over largest eigenvalue of `Σ [s]ₓᵀ [s]ₓ` below which `P'` is not determined.
const NO_TURN: f64 = 1e-11;

/// Sums over motions: `Σ a aᵀ, Σ a bᵀ, Σ b bᵀ` of the vector parts, and the translations.
struct Sums {
    aa: Matrix3<f64>,
    ab: Matrix3<f64>,
    bb: Matrix3<f64>,
    translations: Translations,
}

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = moments::seen(pairs)?;
    let selected = if all.len() <= SELECT_UP_TO { of_selected(&all) } else { None };
    let x = match selected.and_then(|sums| solve_sums(&sums).ok()) {
        Some(x) => x,
        None => solve_sums(&of_all(&all))?,
    };
    Ok(place(pairs, x))
}

fn solve_sums(sums: &Sums) -> Result<nalgebra::Isometry3<f64>, Error> {
    let rotation = rotation(sums).ok_or_else(|| open("the rotations do not fix the camera's"))?;
    moments::with_position(rotation, &sums.translations)
}

/// In the camera's own frame, or where that is nearly turned by 180 degrees, in the best of three
/// frames turned by 180 degrees about an axis.
fn rotation(sums: &Sums) -> Option<UnitQuaternion<f64>> {
    let own = rodrigues(sums);
    if let Some(p) = own.filter(|p| p.norm() < LONG) {
        return Some(jacobi::rotation_of(&Vector4::new(1.0, p.x, p.y, p.z)));
    }
    let turns = [
        Vector3::new(1.0, -1.0, -1.0),
        Vector3::new(-1.0, 1.0, -1.0),
        Vector3::new(-1.0, -1.0, 1.0),
    ];
    let turned = turns.iter().enumerate().filter_map(|(axis, signs)| {
        let turn = Matrix3::from_diagonal(signs); // b = turn b'
        let sums = Sums { ab: sums.ab * turn, bb: turn * sums.bb * turn, ..*sums };
        let p = rodrigues(&sums)?;
        let mut half_turn = Vector4::zeros();
        half_turn[axis + 1] = 1.0;
        let x = moments::product(&Vector4::new(1.0, p.x, p.y, p.z), &half_turn);
        Some((p.norm(), jacobi::rotation_of(&x)))
    });
    turned.min_by(|l, r| l.0.total_cmp(&r.0)).map(|(_, x)| x)
}

/// `P'` of `[a + b]ₓ P' = b - a`; `None` when it is not determined.
fn rodrigues(sums: &Sums) -> Option<Vector3<f64>> {
    let both = sums.aa + sums.ab + sums.ab.transpose() + sums.bb; // Σ s sᵀ, s = a + b
    let normal = Matrix3::identity() * both.trace() - both; // Σ [s]ₓᵀ [s]ₓ
    let k = sums.ab - sums.ab.transpose();
    // Σ -s × (b - a) = Σ -2 a × b
    let rhs = -2.0 * Vector3::new(k[(1, 2)], k[(2, 0)], k[(0, 1)]);
    let (values, _) = jacobi::eigen(&normal);
    if !(values[2] > NO_TURN * values[0]) {
        return None;
    }
    moments::solve_spd(&normal, &rhs)
}

fn of_all(all: &[Seen]) -> Sums {
    let moment = |p: fn(&Seen) -> (Vector4<f64>, Vector4<f64>)| -> Matrix4<f64> {
        all.iter().map(p).map(|(p, q)| p * q.transpose()).sum()
    };
    Sums {
        aa: moments::over_motions(&moment(|s| (s.a, s.a))),
        ab: moments::over_motions(&moment(|s| (s.a, s.b))),
        bb: moments::over_motions(&moment(|s| (s.b, s.b))),
        translations: Translations::of_all(all),
    }
}

/// Over the motions of useful size: summed themselves, or all less the others, whichever are fewer.
fn of_selected(all: &[Seen]) -> Option<Sums> {
    let pairs = all.len() * (all.len() - 1) / 2;
    let (mut useful, mut useless) = (Vec::new(), Vec::new());
    let scalar = LENGTHS.map(|l| 1.0 - 0.25 * l * l); // squares of the scalar part
    let within = |w: f64| w * w <= scalar[0] && w * w >= scalar[1];
    for (j, later) in all.iter().enumerate() {
        for (i, sooner) in all[..j].iter().enumerate() {
            let use_it = within(later.a.dot(&sooner.a)) && within(later.b.dot(&sooner.b));
            if use_it { useful.push((i, j)) } else { useless.push((i, j)) }
        }
    }
    if useful.len() < 2 {
        return None;
    }
    let empty = || Sums {
        aa: Matrix3::zeros(),
        ab: Matrix3::zeros(),
        bb: Matrix3::zeros(),
        translations: Translations::zeros(),
    };
    let (mut sums, listed, weight) = if 2 * useful.len() <= pairs {
        (empty(), useful, 1.0)
    } else {
        (of_all(all), useless, -1.0)
    };
    for (i, j) in listed {
        let a = moments::vector(&moments::between(&all[j].a, &all[i].a));
        let b = moments::vector(&moments::between(&all[j].b, &all[i].b));
        sums.aa += a * a.transpose() * weight;
        sums.ab += a * b.transpose() * weight;
        sums.bb += b * b.transpose() * weight;
        sums.translations.add(&all[i], &all[j], weight);
    }
    Some(sums)
}
