//! Hand-eye calibration by quaternions and singular vectors.
//!
//! `a x = x b` for the quaternions of a motion; dropping the scalar parts, which only state that
//! both rotate by the same angle, it is `G x = 0` with
//!
//! ```text
//! G = [ 0      -(a - b)ᵀ ]
//!     [ a - b  [a + b]ₓ  ]
//! ```
//!
//! whose common null vector over the motions from each capture to the next is `x`. The position is
//! linear least squares over the same motions.
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone. Small rotations from
//! each capture to the next weigh little even where the captures differ much.
//!
//! J. Chou and M. Kamel, *Finding the position and orientation of a sensor on a robot manipulator
//! using quaternions*, IJRR 10(3), 1991.

use nalgebra::Matrix4;

use super::{
    moments,
    moments::Translations,
    shared::{open, place},
};
use crate::{Error, HandEye, PosePair, math::jacobi};

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = moments::seen(pairs)?;
    let (mut form, mut motions) = (Matrix4::zeros(), Translations::zeros());
    for two in all.windows(2) {
        let a = moments::vector(&moments::between(&two[1].a, &two[0].a));
        let b = moments::vector(&moments::between(&two[1].b, &two[0].b));
        let mut g = Matrix4::zeros();
        g.fixed_view_mut::<3, 1>(1, 0).copy_from(&(a - b));
        g.fixed_view_mut::<1, 3>(0, 1).copy_from(&(b - a).transpose());
        g.fixed_view_mut::<3, 3>(1, 1).copy_from(&(a + b).cross_matrix());
        form += g.transpose() * g;
        motions.add(&two[0], &two[1], 1.0);
    }
    let (values, vectors) = jacobi::eigen(&form);
    if !(values[2] - values[3] > jacobi::NO_GAP * values[0]) {
        return Err(open("the rotations between captures do not fix the camera's rotation"));
    }
    let rotation = jacobi::rotation_of(&vectors.column(3).into_owned());
    Ok(place(pairs, moments::with_position(rotation, &motions)?))
}
