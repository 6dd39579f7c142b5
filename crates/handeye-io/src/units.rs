//! Units outside; inside all is metres and radians.

use handeye::frame::FARTHEST_M;
use serde::{Deserialize, Serialize};

/// A unit of length that files use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub enum LengthUnit {
    /// Metre.
    #[serde(rename = "m")]
    Metre,
    /// Centimetre.
    #[serde(rename = "cm")]
    Centimetre,
    /// Millimetre.
    #[serde(rename = "mm")]
    Millimetre,
    /// Inch, 25.4 mm.
    #[serde(rename = "inch")]
    Inch,
}

impl LengthUnit {
    /// One unit, in metres.
    pub fn metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Centimetre => 1e-2,
            Self::Millimetre => 1e-3,
            Self::Inch => 0.0254,
        }
    }

    /// A length in this unit, in metres. Dividing by a whole number rounds once only.
    pub fn to_metres(self, length: f64) -> f64 {
        match self {
            Self::Metre => length,
            Self::Centimetre => length / 100.0,
            Self::Millimetre => length / 1000.0,
            Self::Inch => length * 0.0254,
        }
    }

    /// The unit's sign.
    pub fn name(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Centimetre => "cm",
            Self::Millimetre => "mm",
            Self::Inch => "inch",
        }
    }
}

/// The largest of some coordinates (m), where it is too large for any robot and camera.
pub(crate) fn farthest(coordinates: &[f64]) -> Option<f64> {
    coordinates.iter().map(|x| x.abs()).filter(|x| *x > FARTHEST_M).reduce(f64::max)
}

/// What is wrong with it.
pub(crate) fn too_far(metres: f64) -> String {
    format!("a position {metres:.1e} m from the origin is beyond any robot and camera")
}

/// A unit of angle that files use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub enum AngleUnit {
    /// Radian.
    #[serde(rename = "rad")]
    Radian,
    /// Degree.
    #[serde(rename = "deg")]
    Degree,
}

impl AngleUnit {
    /// An angle in this unit, in radians.
    pub fn to_radians(self, angle: f64) -> f64 {
        match self {
            Self::Radian => angle,
            Self::Degree => angle.to_radians(),
        }
    }

    /// An angle in radians, in this unit.
    pub fn from_radians(self, angle: f64) -> f64 {
        match self {
            Self::Radian => angle,
            Self::Degree => angle.to_degrees(),
        }
    }
}
