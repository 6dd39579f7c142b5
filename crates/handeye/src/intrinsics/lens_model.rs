//! What a lens's model has of parameters, and which of them are fitted.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::{Distortion, Intrinsics, model::camera::LENS_PARAMETERS};

/// The model of a lens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum LensModel {
    /// Brown-Conrady's `k1 k2 p1 p2 k3`, of them what pays.
    #[default]
    BrownConrady,
    /// The same and `k4 k5 k6`, the polynomial below it.
    Rational,
    /// The same and `s1 s2 s3 s4`, for lenses that are tilted.
    ThinPrism,
    /// Kannala-Brandt's `k1 k2 k3 k4`: fisheye.
    KannalaBrandt,
}

/// The first parameter of a thin prism.
const PRISM: usize = 12;
pub(super) const NAMES: [&str; LENS_PARAMETERS] = [
    "fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4",
];

/// Parameters that are fitted: leading ones, and the thin prism's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Free {
    pub leading: usize,
    prism: bool,
}

impl Free {
    pub(crate) const PINHOLE: Self = Self::leading(4);

    const fn leading(leading: usize) -> Self {
        Self { leading, prism: false }
    }

    const fn with_prism(leading: usize) -> Self {
        Self { leading, prism: true }
    }

    /// In the order of [`Intrinsics::by_lens`].
    pub fn parameters(self) -> Vec<usize> {
        let prism = if self.prism { PRISM } else { LENS_PARAMETERS };
        (0..self.leading).chain(prism..LENS_PARAMETERS).collect()
    }
}

impl LensModel {
    /// What is tried, from the pinhole on.
    pub(super) fn ladder(self) -> Vec<Free> {
        let (leading, more): (&[usize], &[Free]) = match self {
            Self::BrownConrady => (&[4, 5, 6, 8, 9], &[]),
            Self::Rational => (&[4, 5, 6, 8, 9, 12], &[]),
            Self::ThinPrism => {
                (&[4, 5, 6, 8, 9], &[Free::with_prism(9), Free::leading(12), Free::with_prism(12)])
            }
            Self::KannalaBrandt => (&[4, 5, 6, 7, 8], &[]),
        };
        leading.iter().map(|n| Free::leading(*n)).chain(more.iter().copied()).collect()
    }

    /// Without any distortion of its own.
    pub(super) fn plain(self) -> Distortion {
        match self {
            Self::KannalaBrandt => Distortion::KannalaBrandt([0.0; 4]),
            _ => Distortion::BrownConrady([0.0; 12]),
        }
    }
}

/// The parameters that a camera has.
pub(super) fn free_in(camera: &Intrinsics) -> Free {
    match camera.distortion {
        Distortion::None => Free::PINHOLE,
        Distortion::KannalaBrandt(_) => Free::leading(8),
        Distortion::BrownConrady(k) => {
            let some = |range: Range<usize>| k[range].iter().any(|k| *k != 0.0);
            let leading = if some(5..8) { 12 } else { 4 + if some(0..5) { 5 } else { 0 } };
            Free { leading, prism: some(8..12) }
        }
    }
}
