//! What a dataset adds to the cell of its calibration: the target, the camera, the arm and the scans.

use std::collections::BTreeMap;

use handeye::{Base, Calibration, Intrinsics, Point, TargetModel};

use crate::{CaptureSource, Dataset, Error, parallel, report::scene::thin};

/// Most points of all scans in a page: 2.4 MB.
const MOST_POINTS: usize = 300_000;
/// Most points of one scan.
const MOST_OF_ONE: usize = 60_000;
/// Most scans in a page; of more, evenly spread ones are shown.
const MOST_SCANS: usize = 60;
/// A scan is thinned from about so many times the points that stay: the others change nothing that is seen.
const THINNED_FROM: usize = 12;

/// What stands in a cell beside what the calibration says.
#[derive(Default)]
pub struct CellData {
    /// What the camera looks at.
    pub target: Option<TargetModel>,
    /// The camera.
    pub camera: Option<Intrinsics>,
    /// Where the tip was.
    pub touched: Vec<Point<Base>>,
    /// Points along the arm in the base frame, by the name of the capture.
    pub links: BTreeMap<String, Vec<[f64; 3]>>,
    /// Scans of captures.
    pub scans: Vec<CaptureScan>,
}

/// The scan of a capture, thinned, in the frame of the camera.
pub struct CaptureScan {
    /// Name of the capture.
    pub capture: String,
    /// Those that are shown.
    pub points: Vec<[f32; 3]>,
    /// How many there were.
    pub of: usize,
}

impl CellData {
    /// All but the scans.
    pub fn of(dataset: &Dataset, calibration: &Calibration) -> Self {
        let found = calibration.camera.as_ref().map(|c| c.intrinsics);
        let links = |source: &CaptureSource| {
            let arm = dataset.arm.as_ref().filter(|_| !source.joints.is_empty())?;
            let points = arm.along_links(&source.joints).into_iter();
            Some((source.id.clone(), points.map(Into::into).collect()))
        };
        Self {
            target: dataset.target.clone(),
            camera: found.or(dataset.intrinsics),
            touched: dataset.touches.iter().map(|t| t.in_base).collect(),
            links: dataset.captures.iter().filter_map(links).collect(),
            scans: vec![],
        }
    }

    /// With the scans of captures that the calibration used.
    ///
    /// # Errors
    /// The first scan that cannot be read.
    pub fn with_scans(self, dataset: &Dataset, calibration: &Calibration) -> Result<Self, Error> {
        let is_used = |source: &&CaptureSource| {
            calibration.captures.iter().any(|k| k.used && k.id == source.id)
        };
        let all: Vec<&CaptureSource> =
            dataset.captures.iter().filter(|c| c.scan.is_some()).filter(is_used).collect();
        let step = all.len().div_ceil(MOST_SCANS).max(1);
        let all: Vec<&CaptureSource> = all.into_iter().step_by(step).collect();
        let most = (MOST_POINTS / all.len().max(1)).min(MOST_OF_ONE);
        let read = |k: usize| -> Option<Result<CaptureScan, Error>> {
            let scan = dataset.scan(all[k].scan.as_ref()?);
            Some(scan.map(|scan| thinned(&all[k].id, scan.points(), most)))
        };
        let scans = parallel::in_order(all.len(), parallel::threads([]), read);
        let scans = scans.into_iter().flatten().collect::<Result<_, _>>()?;
        Ok(Self { scans, ..self })
    }
}

fn thinned(capture: &str, points: &[[f32; 3]], most: usize) -> CaptureScan {
    let finite = points.iter().filter(|p| p.iter().all(|x| x.is_finite()));
    let of = finite.clone().count();
    let step = (of / (THINNED_FROM * most).max(1)).max(1);
    let some: Vec<[f32; 3]> = finite.step_by(step).copied().collect();
    let points = thin(&some, most).into_iter().map(|k| some[k as usize]).collect();
    CaptureScan { capture: capture.into(), points, of }
}
