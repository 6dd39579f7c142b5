//! A registration as JSON.

use handeye::{
    Verdict,
    calibrate::result::{Rows, rows},
    quaternion_xyzw,
    register::{Dense, Stop},
};
use nalgebra::Isometry3;
use serde::{Deserialize, Serialize};

/// A rigid transform.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Transform {
    /// m.
    pub translation_m: [f64; 3],
    /// A unit quaternion.
    pub rotation_xyzw: [f64; 4],
}

/// One of several equally good places.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FoundPlace {
    /// The whole transform.
    pub target_from_source: Transform,
}

/// Where one scan lies in another.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RegistrationResult {
    /// Whether to use it.
    pub verdict: Verdict,
    /// Why not.
    pub reasons: Vec<String>,
    /// The whole transform, the start included.
    pub target_from_source: Transform,
    /// In the source frame; null where something is undetermined.
    pub covariance: Option<Rows>,
    /// Along the source's axes.
    pub sigma_mm: Option<[f64; 3]>,
    /// About them.
    pub sigma_deg: Option<[f64; 3]>,
    /// Motions that the common surface leaves free.
    pub undetermined: Vec<String>,
    /// Rounds.
    pub iterations: usize,
    /// Why they ended.
    pub stop: &'static str,
    /// Share of the source that lies on the target.
    pub inlier_fraction: f64,
    /// Of the places where both show something, the share at which it is the same.
    pub agreement: f64,
    /// Size of what the target shows over that of what the source shows.
    pub size_ratio: Option<f64>,
    /// Its standard deviation.
    pub size_sigma: Option<f64>,
    /// Of a part that was searched for: the share of the scan within the part's box that lies on the part.
    pub explained: Option<f64>,
    /// Where several places explain the scan equally well: all of them, the answer first; else none.
    pub places: Vec<FoundPlace>,
    /// RMS residual of the matches that count (without outliers).
    pub rms_mm: Option<f64>,
    /// Deviation of the distances over that which the scatter of the points promises.
    pub residual_sigma: Option<f64>,
}

fn transform(pose: &Isometry3<f64>) -> Transform {
    Transform {
        translation_m: pose.translation.vector.into(),
        rotation_xyzw: quaternion_xyzw(&pose.rotation),
    }
}

impl From<&Dense> for RegistrationResult {
    fn from(found: &Dense) -> Self {
        let pose = &found.target_from_source;
        let sigma = |first: usize, scale: f64| {
            let of = |c: nalgebra::Matrix6<f64>| {
                std::array::from_fn(|k| c[(first + k, first + k)].sqrt() * scale)
            };
            found.covariance.map(of)
        };
        Self {
            verdict: found.verdict,
            reasons: found.reasons.clone(),
            target_from_source: transform(pose),
            covariance: found.covariance.as_ref().map(rows),
            sigma_mm: sigma(3, 1e3),
            sigma_deg: sigma(0, 1f64.to_degrees()),
            undetermined: found.undetermined.clone(),
            iterations: found.iterations,
            stop: match found.stop {
                Stop::Converged => "converged",
                Stop::Fitness => "fitness",
                Stop::NoMatches => "no-matches",
                Stop::MaxIterations => "max-iterations",
            },
            inlier_fraction: found.inlier_fraction,
            agreement: found.agreement,
            size_ratio: found.size.map(|size| size.ratio),
            size_sigma: found.size.map(|size| size.sigma),
            explained: found.explained,
            places: found
                .places
                .iter()
                .map(|at| FoundPlace { target_from_source: transform(at) })
                .collect(),
            rms_mm: Some(found.rms_m * 1e3).filter(|x| x.is_finite()),
            residual_sigma: Some(found.sigma).filter(|x| x.is_finite()),
        }
    }
}
