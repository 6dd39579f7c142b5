//! From scans without a board to poses of a target: of the still scene that they show, or of an object of
//! known shape in them.
//!
//! Scans are read, cut into pieces of their surface and dropped one by one on a few threads; the pieces are
//! kept, since every scan meets several others.

use handeye::{
    Observation, Scan, Session, TargetPose,
    calibrate::beside::Measuring,
    calibrate::result::{SceneKind, ScenePair, SceneResult},
    register::{
        DenseConfig, Stop, Surface, register_surfaces,
        scene::{self, Placed, graph::Link},
    },
};
use nalgebra::Isometry3;

use crate::{
    CaptureSource, Dataset, Error, Place, Shape,
    error::malformed,
    measure::Measured,
    parallel::{self, all_cores},
};

/// What an object is called where two scans would have their names.
const OBJECT: &str = "object";
/// Windows of an object and of a scan that are farther apart are not compared, m: with more, the far side of
/// a part a few centimetres thick, which no camera sees, would be drawn to its near side.
const OBJECT_GATE_M: f64 = 0.02;
/// A scan, or an object, that cannot be compared.
const NO_SURFACE: &str =
    "shows no surface: its points are too few, lie on a line, or lie far from all others";

/// Places every scan; `progress` is told how many of how many are read, then how many pairs are registered.
pub(crate) fn measure(
    dataset: &Dataset,
    shape: &Shape,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Measured, Error> {
    let object = object(dataset, shape)?;
    let mut not_found = vec![];
    let (mut seen, mut surfaces) = (vec![], vec![]);
    for (capture, surface) in dataset.captures.iter().zip(surfaces_of(dataset, progress)?) {
        match surface {
            Ok(surface) => {
                seen.push(capture);
                surfaces.push(surface);
            }
            Err(reason) => not_found.push((capture.id.clone(), reason)),
        }
    }
    let mounts: Vec<Isometry3<f64>> =
        seen.iter().map(|c| *dataset.setup.anchor_from_mount(c.base_from_flange).iso()).collect();
    let config = DenseConfig { threads: all_cores(), ..DenseConfig::default() };
    let placed = match (shape, &object) {
        (Shape::Scene { guess }, _) => {
            let guess = guess.as_ref().map(|pose| pose.iso());
            scene::place(&surfaces, &mounts, guess, &config, progress)
        }
        (Shape::Object { .. }, Some(object)) => {
            let config = DenseConfig { max_correspondence_distance_m: OBJECT_GATE_M, ..config };
            scene::place_object(object, &surfaces, &mounts, &config, progress)
        }
        (Shape::Object { .. }, None) => Placed { poses: vec![None; seen.len()], links: vec![] },
    };
    let all = Scans { seen: &seen, dataset, placed: &placed, kind: kind(shape) };
    not_found.extend(all.not_placed());
    Ok(Measured {
        session: session(dataset, &all),
        camera_rms_px: None,
        noticed: Measuring {
            warnings: dataset.warnings.clone(),
            not_found,
            colour_step: None,
            scene: Some(all.result()),
        },
    })
}

fn kind(shape: &Shape) -> SceneKind {
    match shape {
        Shape::Scene { .. } => SceneKind::Scene,
        Shape::Object { .. } => SceneKind::Object,
    }
}

/// The surface of the object, where there is one.
fn object(dataset: &Dataset, shape: &Shape) -> Result<Option<Surface>, Error> {
    let Shape::Object { model, length_unit } = shape else { return Ok(None) };
    let points = dataset.object(model, *length_unit)?;
    let surface = Surface::of(&points, all_cores()).ok_or_else(|| {
        malformed(Place::file(model), NO_SURFACE, "give the mesh of a part, or a dense scan of it")
    })?;
    Ok(Some(surface))
}

/// The surface in each capture's scan, or why there is none.
fn surfaces_of(
    dataset: &Dataset,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<Result<Surface, String>>, Error> {
    let captures = &dataset.captures;
    let scans = captures.iter().filter_map(|c| c.scan.as_deref());
    let threads = parallel::threads(scans);
    let look = |k: usize| surface_of(dataset, &captures[k]);
    // results, and the first error, in the order of the captures
    parallel::in_order_told(captures.len(), threads, progress, look).into_iter().collect()
}

fn surface_of(
    dataset: &Dataset,
    capture: &CaptureSource,
) -> Result<Result<Surface, String>, Error> {
    let Some(path) = &capture.scan else { return Ok(Err("it has no scan".into())) };
    let scan = dataset
        .scan(path)
        .map_err(|e| Error::Capture { id: capture.id.clone(), source: Box::new(e) })?;
    Ok(Surface::of(&scan, 1).ok_or_else(|| format!("its scan {NO_SURFACE}")))
}

/// The captures whose scans show a surface, and where those lie.
struct Scans<'a> {
    seen: &'a [&'a CaptureSource],
    dataset: &'a Dataset,
    placed: &'a Placed,
    kind: SceneKind,
}

impl Scans<'_> {
    fn pose(&self, id: &str) -> Option<TargetPose> {
        let at = self.seen.iter().position(|c| c.id == id)?;
        self.placed.poses[at]
    }

    /// Why captures have no place, by name.
    fn not_placed(&self) -> Vec<(String, String)> {
        let numbers = (0..self.seen.len()).filter(|k| self.placed.poses[*k].is_none());
        numbers.map(|k| (self.seen[k].id.clone(), self.why_not_placed(k))).collect()
    }

    /// Of the pairs of a scan the one with most in common tells best what is missing.
    fn why_not_placed(&self, scan: usize) -> String {
        let common = |link: &&Link| link.found.inlier_fraction * link.found.agreement;
        let own = self.placed.links.iter().filter(|l| l.source == scan || l.target == scan);
        let Some(best) = own.max_by(|a, b| common(a).total_cmp(&common(b))) else {
            return match self.kind {
                SceneKind::Scene => "it overlaps too little with every other scan".into(),
                SceneKind::Object => "the object was not looked for in it".into(),
            };
        };
        let may_slide = best.found.undetermined.is_empty() && self.kind == SceneKind::Scene;
        if let Some(free) = may_slide.then(|| self.slides(scan)).flatten() {
            return format!("its surface does not constrain {free}");
        }
        let why = self.why_not(best);
        let why = why.as_deref().unwrap_or("the scans that fit pairwise form no connected group");
        match self.kind {
            SceneKind::Object => format!("the object was not found in it: {why}"),
            SceneKind::Scene => {
                let other = if best.source == scan { best.target } else { best.source };
                format!("not even its pair with {} counts: {why}", self.seen[other].id)
            }
        }
    }

    /// Why a pair does not count, to people who gave no start.
    fn why_not(&self, link: &Link) -> Option<String> {
        let why = link.left_out.clone()?;
        Some(match (link.found.stop, self.kind) {
            (Stop::NoMatches, SceneKind::Scene) => "they show hardly anything in common".into(),
            (Stop::NoMatches, SceneKind::Object) => {
                "it is out of view, or too little of its shape is seen".into()
            }
            _ => why,
        })
    }

    /// What a scan alone leaves free, however it is compared; it is read once more for that.
    fn slides(&self, scan: usize) -> Option<String> {
        slides(&self.dataset.scan(self.seen[scan].scan.as_ref()?).ok()?)
    }

    fn result(&self) -> SceneResult {
        SceneResult {
            kind: self.kind,
            placed: self.placed.poses.iter().flatten().count(),
            pairs: self.placed.links.iter().map(|link| self.pair(link)).collect(),
        }
    }

    fn pair(&self, link: &Link) -> ScenePair {
        let id = |k: usize| self.seen[k].id.clone();
        ScenePair {
            source: match self.kind {
                SceneKind::Scene => id(link.source),
                SceneKind::Object => OBJECT.into(),
            },
            target: id(link.target),
            overlap: link.found.inlier_fraction,
            agreement: link.found.agreement,
            rms_mm: Some(link.found.rms_m * 1e3).filter(|mm| mm.is_finite()),
            used: link.left_out.is_none(),
            reason: self.why_not(link),
            undetermined: link.found.undetermined.clone(),
        }
    }
}

/// What a scan leaves free that lies on itself: no other scan of the same could tell more. Its points are
/// parted, so that the noise of one half is not that of the other.
fn slides(scan: &Scan) -> Option<String> {
    let halves = [half(scan, 0)?, half(scan, 1)?];
    let config = DenseConfig { threads: all_cores(), restarts: false, ..DenseConfig::default() };
    let found = register_surfaces(&halves[0], &halves[1], &Isometry3::identity(), &config);
    (!found.undetermined.is_empty()).then(|| found.undetermined.join("; "))
}

/// The surface of every second point, or column.
fn half(scan: &Scan, first: usize) -> Option<Surface> {
    let (columns, rows) = (scan.width() / 2, scan.height());
    let of_row =
        |row: usize| (0..columns).map(move |k| scan.points()[row * scan.width() + 2 * k + first]);
    let points = (0..rows).flat_map(of_row).collect();
    Surface::of(&Scan::new(columns, rows, points)?, all_cores())
}

fn session(dataset: &Dataset, all: &Scans) -> Session {
    let observe = |c: &CaptureSource| Observation {
        candidates: all.pose(&c.id).into_iter().collect(),
        ..c.observation()
    };
    dataset.session(dataset.captures.iter().map(observe).collect())
}
