//! Closed forms: hand-eye calibration without a start value, a file per paper. A new one is its file and, here, its
//! module, its variant of [`Method`] and its row; a page of the book describes it.
//!
//! `A X = Y B` methods take the pairs as they are; `A X = X B` methods take relative motions
//! between pairs and compute `anchor_from_target` afterwards. Every method is linear in the number of
//! captures: sums over all motions come from moments of single captures (`moments.rs`), and where
//! they cannot, the number of motions per capture is bounded.

pub mod andreff;
mod chou_kamel;
pub mod consensus;
mod daniilidis;
mod dornaika_horaud;
pub(crate) mod few_axes;
mod graduated;
mod half_turns;
mod horaud_dornaika;
mod kronecker;
pub mod least_squares;
mod li;
mod lu_chou;
mod moments;
pub mod motions;
mod park_martin;
pub mod points;
mod shah;
mod shared;
mod shiu_ahmad;
mod tabb;
mod tsai_lenz;
mod wu;
mod zhuang;

use crate::{Error, HandEye, PosePair};
pub use least_squares::View;
pub(crate) use motions::check;
pub(crate) use shared::too_few;
pub use shared::{FEWEST_POSES, place_target};

/// A published closed form.
///
/// None has a single answer for rotations about one axis only or for none at all; nearly none for
/// half turns alone. What else leaves a method without one is said beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// Shah 2013, `A X = Y B` by the Kronecker product.
    Shah,
    /// Park and Martin 1994, `A X = X B` by logarithms.
    ParkMartin,
    /// Daniilidis 1999, `A X = X B` by dual quaternions.
    Daniilidis,
    /// Tsai and Lenz 1989, `A X = X B` by modified Rodrigues vectors, of motions by 17 to 116
    /// degrees where there are enough.
    TsaiLenz,
    /// Shiu and Ahmad 1989, `A X = X B` by one angle per motion; keeps the noise of one axis whole.
    ShiuAhmad,
    /// Chou and Kamel 1991, `A X = X B` by quaternions.
    ChouKamel,
    /// Horaud and Dornaika 1995, `A X = X B` by quaternions, rotation first.
    HoraudDornaika,
    /// Horaud and Dornaika 1995, `A X = X B`, rotation and position together, rad beside m.
    HoraudDornaikaNonlinear,
    /// Andreff, Horaud and Espiau 2001, `A X = X B` by one linear system; not for a mount that
    /// stays in its place.
    Andreff,
    /// Andreff, Horaud and Espiau 2001, with the camera's positions in an unknown unit; the answer
    /// is in metres, [`andreff::solve_with_scale`] gives the unit too. Not for a mount or a camera
    /// that stays in its place.
    AndreffScaled,
    /// Lu and Chou 1995, `A X = X B` in the eight-space of quaternions.
    LuChou,
    /// Wu, Sun, Wang and Liu 2020, `A X = X B` by rotations of four-space; half turns weigh nothing.
    Wu,
    /// Zhuang, Roth and Sudhakar 1994, `A X = Y B` by parts of quaternions; poses turned from their
    /// mean by more than 174 degrees are left out.
    Zhuang,
    /// Dornaika and Horaud 1998, `A X = Y B` by quaternions.
    DornaikaHoraud,
    /// Li, Wang and Wu 2010, `A X = Y B` by one linear system; not for a mount that stays in its
    /// place.
    Li,
    /// Tabb and Ahmad Yousef 2017, `A X = Y B` by their cost `c₁ = Σ ‖A X - Y B‖²`, m.
    TabbAhmadYousefC1,
    /// Tabb and Ahmad Yousef 2017, `A X = Y B` by their cost `c₂ = Σ ‖A - Y B X⁻¹‖²`,
    /// m.
    TabbAhmadYousefC2,
}

/// The equation that a method solves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// `A X = Y B`, of the pairs as they are.
    AxYb,
    /// `A X = X B`, of motions between pairs.
    AxXb,
}

impl Form {
    /// Both.
    pub const ALL: [Form; 2] = [Form::AxYb, Form::AxXb];

    /// As it is written.
    pub fn equation(self) -> &'static str {
        match self {
            Form::AxYb => "A X = Y B",
            Form::AxXb => "A X = X B",
        }
    }
}

/// What there is to know of a method.
struct Row {
    method: Method,
    name: &'static str,
    source: &'static str,
    form: Form,
    solve: fn(&[PosePair]) -> Result<HandEye, Error>,
}

const fn row(
    method: Method,
    name: &'static str,
    source: &'static str,
    form: Form,
    solve: fn(&[PosePair]) -> Result<HandEye, Error>,
) -> Row {
    Row { method, name, source, form, solve }
}

/// A row for each method, in the order of [`Method`], the one recommended for a start first.
#[rustfmt::skip]
const METHODS: &[Row; 17] = &{
    use Form::{AxXb, AxYb};
    use Method as M;
    [
        row(M::Shah, "shah", "M. Shah, 2013", AxYb, shah::solve),
        row(M::ParkMartin, "park-martin", "F. Park, B. Martin, 1994", AxXb, park_martin::solve),
        row(M::Daniilidis, "daniilidis", "K. Daniilidis, 1999", AxXb, daniilidis::solve),
        row(M::TsaiLenz, "tsai-lenz", "R. Tsai, R. Lenz, 1989", AxXb, tsai_lenz::solve),
        row(M::ShiuAhmad, "shiu-ahmad", "Y. Shiu, S. Ahmad, 1989", AxXb, shiu_ahmad::solve),
        row(M::ChouKamel, "chou-kamel", "J. Chou, M. Kamel, 1991", AxXb, chou_kamel::solve),
        row(M::HoraudDornaika, "horaud-dornaika", "R. Horaud, F. Dornaika, 1995", AxXb, horaud_dornaika::solve),
        row(M::HoraudDornaikaNonlinear, "horaud-dornaika-nonlinear", "R. Horaud, F. Dornaika, 1995", AxXb, horaud_dornaika::solve_nonlinear),
        row(M::Andreff, "andreff", "N. Andreff, R. Horaud, B. Espiau, 2001", AxXb, andreff::solve),
        row(M::AndreffScaled, "andreff-scaled", "N. Andreff, R. Horaud, B. Espiau, 2001", AxXb, |p| Ok(andreff::scaled(p)?.hand_eye)),
        row(M::LuChou, "lu-chou", "Y. Lu, J. Chou, 1995", AxXb, lu_chou::solve),
        row(M::Wu, "wu", "J. Wu, Y. Sun, M. Wang, M. Liu, 2020", AxXb, wu::solve),
        row(M::Zhuang, "zhuang", "H. Zhuang, Z. Roth, R. Sudhakar, 1994", AxYb, zhuang::solve),
        row(M::DornaikaHoraud, "dornaika-horaud", "F. Dornaika, R. Horaud, 1998", AxYb, dornaika_horaud::solve),
        row(M::Li, "li", "A. Li, L. Wang, D. Wu, 2010", AxYb, li::solve),
        row(M::TabbAhmadYousefC1, "tabb-ahmad-yousef-c1", "A. Tabb, K. Ahmad Yousef, 2017", AxYb, tabb::solve_c1),
        row(M::TabbAhmadYousefC2, "tabb-ahmad-yousef-c2", "A. Tabb, K. Ahmad Yousef, 2017", AxYb, tabb::solve_c2),
    ]
};

/// The methods of the rows, which must be in their own order.
const fn all() -> [Method; METHODS.len()] {
    let mut all = [Method::Shah; METHODS.len()];
    let mut k = 0;
    while k < all.len() {
        all[k] = METHODS[k].method;
        assert!(all[k] as usize == k, "a row for each method, in the order of the enum");
        k += 1;
    }
    all
}

impl Method {
    /// Every method, the one recommended for a start first.
    pub const ALL: [Method; METHODS.len()] = all();

    /// The few that a calibration compares with each other when nothing else is asked for.
    pub(crate) const CANDIDATES: [Method; 3] =
        [Method::Shah, Method::ParkMartin, Method::Daniilidis];

    fn row(self) -> &'static Row {
        &METHODS[self as usize]
    }

    /// The name in files and on the command line.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Who published it, and when.
    pub fn source(self) -> &'static str {
        self.row().source
    }

    /// The equation that it solves.
    pub fn form(self) -> Form {
        self.row().form
    }

    /// The method of that name.
    pub fn from_name(name: &str) -> Option<Method> {
        Method::ALL.into_iter().find(|m| m.name().eq_ignore_ascii_case(name))
    }
}

/// Solves `A X = Y B` over all pairs with one published method.
///
/// # Errors
/// [`Error::TooFewPoses`] below three pairs, [`Error::NotDetermined`] when all rotations are about
/// one axis or the method has no single answer, [`Error::NotFinite`] on NaN.
pub fn solve(pairs: &[PosePair], method: Method) -> Result<HandEye, Error> {
    check(pairs)?;
    let hand_eye = (method.row().solve)(pairs)?;
    if hand_eye.mount_from_camera.is_finite() && hand_eye.anchor_from_target.is_finite() {
        Ok(hand_eye)
    } else {
        Err(Error::NotDetermined { what: format!("{} found no finite answer", method.name()) })
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::{Anchor, Mount, Pose};
    use nalgebra::{Isometry3, Vector3, Vector6};
    use std::f64::consts::PI;

    pub(crate) fn pose<A, B>(t: [f64; 3], axis_angle: [f64; 3]) -> Pose<A, B> {
        Pose::claim(Isometry3::new(Vector3::from(t), Vector3::from(axis_angle)))
    }

    pub(crate) fn truths() -> Vec<HandEye> {
        [
            [0.1, -0.3, 1.5],
            [0.0, 0.0, 0.0],
            [PI, 0.0, 0.0],
            [0.0, PI, 0.0],
            [0.0, 0.0, -PI],
            [2.2, 2.2, 0.1],
        ]
        .into_iter()
        .map(|axis_angle| HandEye {
            mount_from_camera: pose([0.05, -0.02, 0.11], axis_angle),
            anchor_from_target: pose([0.8, 0.1, 0.02], [0.02, 3.0, -0.1]),
        })
        .collect()
    }

    pub(crate) fn exact_pairs(truth: &HandEye, count: usize) -> Vec<PosePair> {
        (0..count)
            .map(|s| s as f64)
            .map(|s| {
                let t = [0.5 + 0.05 * s.sin(), 0.1 * s.cos(), 0.6 + 0.02 * (2.1 * s).sin()];
                let r = [0.6 * s.sin(), 2.8 + 0.4 * (1.3 * s).cos(), 0.8 * (0.7 * s).sin()];
                let anchor_from_mount = pose::<Anchor, Mount>(t, r);
                let anchor_from_camera = anchor_from_mount * truth.mount_from_camera;
                PosePair {
                    anchor_from_mount,
                    camera_from_target: anchor_from_camera.inverse() * truth.anchor_from_target,
                }
            })
            .collect()
    }

    #[track_caller]
    pub(crate) fn assert_same<A, B>(found: Pose<A, B>, wanted: Pose<A, B>, what: &str) {
        let (angle, distance) = (found.angle_to(&wanted), found.distance_to(&wanted));
        assert!(distance < 1e-9, "{what}: translation off by {distance} m");
        assert!(angle < 1e-9, "{what}: rotation off by {angle} rad");
    }

    /// Exact pairs with a tenth of a degree and half a millimetre of fixed disturbance.
    pub(crate) fn noisy_pairs(truth: &HandEye, count: usize) -> Vec<PosePair> {
        let mut pairs = exact_pairs(truth, count);
        for (k, pair) in pairs.iter_mut().enumerate() {
            let wave = |i: usize, size: f64| size * (7.3 * k as f64 + 2.9 * i as f64).sin();
            let by = Vector6::from_fn(|i, _| wave(i, if i < 3 { 2e-3 } else { 5e-4 }));
            pair.camera_from_target = pair.camera_from_target.retract(&by);
        }
        pairs
    }

    /// No step of 1e-4 along one of the first `freedoms` directions of X and Y lowers the cost.
    #[track_caller]
    pub(crate) fn assert_least(best: &HandEye, freedoms: usize, cost: impl Fn(&HandEye) -> f64) {
        for k in 0..freedoms {
            for size in [-1e-4, 1e-4] {
                let (mut moved, by) = (*best, Vector6::ith(k % 6, size));
                if k < 6 {
                    moved.mount_from_camera = moved.mount_from_camera.retract(&by);
                } else {
                    moved.anchor_from_target = moved.anchor_from_target.retract(&by);
                }
                assert!(cost(&moved) > cost(best), "direction {k}");
            }
        }
    }

    #[test]
    fn exact_pairs_give_the_truth() {
        for method in Method::ALL {
            for (k, truth) in truths().iter().enumerate() {
                for count in [3, 4, 12, 80] {
                    let what = format!("{} truth {k} with {count} poses", method.name());
                    let found = solve(&exact_pairs(truth, count), method).expect(&what);
                    assert_same(found.mount_from_camera, truth.mount_from_camera, &what);
                    assert_same(found.anchor_from_target, truth.anchor_from_target, &what);
                }
            }
        }
    }

    /// Re-measuring the same scene from another origin must move the target, and only the target.
    #[test]
    fn moving_the_anchor_moves_only_the_target() {
        let new_from_old: Pose<Anchor, Anchor> = pose([1.0, -2.0, 0.3], [0.2, 0.7, -1.1]);
        for method in Method::ALL {
            let truth = truths()[0];
            let mut pairs = exact_pairs(&truth, 12);
            for pair in &mut pairs {
                pair.anchor_from_mount = new_from_old * pair.anchor_from_mount;
            }
            let found = solve(&pairs, method).unwrap();
            assert_same(found.mount_from_camera, truth.mount_from_camera, method.name());
            let moved = new_from_old * truth.anchor_from_target;
            assert_same(found.anchor_from_target, moved, method.name());
        }
    }

    #[test]
    fn rotations_about_one_axis_are_refused_by_name() {
        let truth = truths()[0];
        let pairs: Vec<PosePair> = (0..10)
            .map(|k| {
                let k = f64::from(k);
                let anchor_from_mount =
                    pose::<Anchor, Mount>([0.3 + 0.03 * k, 0.1, 0.5], [0.0, 0.0, 0.3 * k]);
                let anchor_from_camera = anchor_from_mount * truth.mount_from_camera;
                PosePair {
                    anchor_from_mount,
                    camera_from_target: anchor_from_camera.inverse() * truth.anchor_from_target,
                }
            })
            .collect();
        for method in Method::ALL {
            let error = solve(&pairs, method).unwrap_err();
            assert!(error.to_string().contains("about one axis"), "{error}");
        }
    }

    #[test]
    fn two_poses_are_too_few() {
        let pairs = exact_pairs(&truths()[0], 2);
        assert!(matches!(
            solve(&pairs, Method::Shah),
            Err(Error::TooFewPoses { found: 2, needed: 3, .. })
        ));
    }

    #[test]
    fn nan_is_named() {
        let mut pairs = exact_pairs(&truths()[0], 5);
        let nan = Vector6::new(0.0, 0.0, 0.0, f64::NAN, 0.0, 0.0);
        pairs[3].anchor_from_mount = pairs[3].anchor_from_mount.retract(&nan);
        let error = solve(&pairs, Method::Shah).unwrap_err();
        assert_eq!(error.to_string(), "pose pair 4 is not finite");
    }
}
