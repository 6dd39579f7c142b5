//! What a program declares of its cell.

use handeye::{Intrinsics, Setup, TargetModel};
use handeye_io::{CellSettings, Error, Writing, intrinsics_from_json};

use super::{PushError, Size, refused};
use crate::engine::touch::tip;

/// What is declared of a cell: all of a new one, and of one that goes on what is to be otherwise.
#[derive(Debug, Clone, Default)]
pub struct Declared {
    /// Who carries the camera.
    pub setup: Option<Setup>,
    /// The board.
    pub target: Option<TargetModel>,
    /// The camera: the keys of `[camera]` of a manifest, as JSON. Without it the intrinsics are calibrated from the views.
    pub camera_json: Option<String>,
    /// Error that is tolerated (95 %), mm.
    pub tolerance_mm: Option<f64>,
    /// How poses are written: a name of a robot's notation.
    pub notation: Option<String>,
    /// Where the tip of the tool that touches corners is in the flange, mm.
    pub tip_mm: Option<[f64; 3]>,
}

/// Unless said otherwise, mm.
const TOLERANCE_MM: f64 = 0.5;
/// Unless said otherwise.
const NOTATION: &str = "ur";

impl Declared {
    /// The cell of a new session.
    pub(super) fn cell(&self) -> Result<CellSettings, PushError> {
        let (Some(setup), Some(target)) = (self.setup, self.target.clone()) else {
            return Err(refused("a new session needs to know setup and target".into()));
        };
        Ok(CellSettings {
            setup,
            target,
            intrinsics: None,
            tolerance_mm: TOLERANCE_MM,
            notation: NOTATION.into(),
            guess: None,
            tip_mm: None,
            scans: None,
            arm: None,
        })
    }

    /// Settings with what is declared; `size` is that of the images, where it is known.
    pub(super) fn over(
        &self,
        settings: &CellSettings,
        size: Option<Size>,
    ) -> Result<CellSettings, PushError> {
        if self.tolerance_mm.is_some_and(|mm| !(mm > 0.0 && mm.is_finite())) {
            return Err(refused("the tolerance is a positive number of millimetres".into()));
        }
        let notation = self.notation.clone().unwrap_or_else(|| settings.notation.clone());
        Writing::of(&notation)
            .map_err(|known| refused(format!("the notation {notation:?} is not known: {known}")))?;
        let target = self.target.clone().unwrap_or_else(|| settings.target.clone());
        target.check().map_err(|e| refused(e.to_string()))?;
        let given = self.camera_json.as_deref().map(|text| intrinsics(text, size)).transpose()?;
        Ok(CellSettings {
            setup: self.setup.unwrap_or(settings.setup),
            target,
            intrinsics: given.flatten().or(settings.intrinsics),
            tolerance_mm: self.tolerance_mm.unwrap_or(settings.tolerance_mm),
            notation,
            tip_mm: self.tip_mm.map(tip).transpose()?.or(settings.tip_mm),
            ..settings.clone()
        })
    }
}

/// Intrinsics; `None` where the size of their images is open.
fn intrinsics(text: &str, size: Option<Size>) -> Result<Option<Intrinsics>, Error> {
    match intrinsics_from_json(text, size) {
        Err(Error::Undeclared { key, .. }) if ["width", "height"].contains(&&key[..]) => Ok(None),
        found => found.map(Some),
    }
}
