//! What the user wants of a calibration.

use crate::{estimate::noise::KnownNoise, register::IcpConfig, solve::Method};

/// What the user wants of a calibration.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Config {
    /// A published method to run as published, instead of choosing among candidates.
    pub method: Option<Method>,
    /// Parameters of the nearest-neighbour candidate of the two-step refinement.
    pub icp: IcpConfig,
    /// Noise figures that are known.
    pub known: KnownNoise,
    /// Accept only where the predicted error (95 % of the points in the workspace) is below this, mm.
    pub max_error_mm: Option<f64>,
    /// In which camera frame the answer is, that of images or of scans, where the two do not agree.
    pub answer_frame: AnswerFrame,
    /// How many threads may fit what is left after each capture at once; 0 and 1 are the caller's own. The answer is the same.
    pub threads: usize,
}

/// The camera frame in which the answer is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AnswerFrame {
    /// That of the scans, where there are any.
    #[default]
    Scan,
    /// That of the images.
    Image,
}
