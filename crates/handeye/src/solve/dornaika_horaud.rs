//! Robot-world / hand-eye by unit quaternions, linear.
//!
//! `a x = y b` for the quaternions of every pose, so
//!
//! ```text
//! Σ |Q(a) x - W(b) y|² = 2n - 2 xᵀ S y          S = Σ Q(a)ᵀ W(b)
//! ```
//!
//! is least for the leading singular vectors of `S`. The positions are linear least squares.
//!
//! Degenerate: rotations about one axis, none at all, and half turns alone, where the quaternions
//! have no sign on which robot and camera agree.
//!
//! F. Dornaika and R. Horaud, *Simultaneous robot-world and hand-eye calibration*, IEEE T-RA
//! 14(4), 1998.

use super::{moments, shared::open, zhuang::with_positions};
use crate::{Error, HandEye, PosePair, math::jacobi};

pub(super) fn solve(pairs: &[PosePair]) -> Result<HandEye, Error> {
    let s = moments::loops(&moments::seen(pairs)?);
    let y = jacobi::leading(&(s.transpose() * s))
        .ok_or_else(|| open("the rotations do not fix the camera's"))?;
    with_positions(pairs, &(s * y), &y)
}
