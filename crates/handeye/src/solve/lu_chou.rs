//! Hand-eye calibration in the eight-space of quaternions, rotation and position together.
//!
//! With `p = t x/2` beside the quaternion `x` of the camera, every motion gives eight equations,
//!
//! ```text
//! [ a - b     0     ] [ x ]
//! [ a' - b'   a - b ] [ p ] = 0          (a - b) x = a x - x b
//! ```
//!
//! linear in `(x, p)`. Least squares eliminates `p` and leaves a quadratic form of the unit vector
//! `x`. The part of `p` along `x` has no equation; the condition `xᵀp = 0` fixes it. The equations
//! of all motions, in both directions, enter through moments. The scalar parts of `a - b`, zero for
//! exact motions, are left out.
//!
//! Y.-C. Lu and J. Chou, *Eight-space quaternion approach for robotic hand-eye calibration*, IEEE
//! SMC 1995.

use nalgebra::Matrix4;

use super::{
    daniilidis::{Products, from_dual},
    jacobi, moments, open, place,
};
use crate::{Error, HandEye, PosePair};

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let all = moments::seen(pairs)?;
    let form = Products::new(&all).all_rows();
    let block = |i, j| form.fixed_view::<4, 4>(i, j).into_owned();
    let (upper, mixed, lower) = (block(0, 0), block(0, 4), block(4, 4));
    let (values, vectors) = jacobi::eigen(&lower);
    if !(values[2] - values[3] > 1e-13 * values[0]) {
        return Err(open("the rotations between captures do not fix the camera's rotation"));
    }
    // inverse off the null vector, which is x but for noise
    let inverse = (0..3).fold(Matrix4::zeros(), |sum, k| {
        sum + vectors.column(k) * vectors.column(k).transpose() / values[k]
    });
    let (_, left) = jacobi::eigen(&(upper - mixed * inverse * mixed.transpose()));
    let x = left.column(3).into_owned();
    let p = -inverse * mixed.transpose() * x;
    Ok(place(pairs, from_dual(&x, &(p - x * x.dot(&p)))))
}
