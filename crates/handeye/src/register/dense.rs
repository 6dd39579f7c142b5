//! Registration of two scans, organised or in any order.
//!
//! From a start that is right to some centimetres and degrees; others around it are tried as well, and the
//! answer is given with what speaks for and against it.

use nalgebra::{Isometry3, Matrix6};

use super::{
    descent::{Descent, Reached},
    freedom::Freedom,
    global,
    icp::Stop,
    part_search,
    rivals::{self, Opinions, Rival},
    search::Search,
    size::Size,
    surface::Surface,
};
use crate::{Error, Scan, Verdict};

/// What is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DenseMethod {
    /// Distances along the mean of both normals (symmetric).
    #[default]
    Auto,
    /// Distances between places. Where surfaces are flat this creeps, and of dense clouds it holds on to places that
    /// are millimetres off: neighbours along the surface lie as near as the right one. That is rejected.
    PointToPoint,
    /// Distances along the target's normal.
    PointToPlane,
    /// Distances, by how windows are spread along and across both surfaces (generalised ICP).
    PlaneToPlane,
}

impl DenseMethod {
    /// Every method.
    pub const ALL: [DenseMethod; 4] = [
        DenseMethod::Auto,
        DenseMethod::PointToPoint,
        DenseMethod::PointToPlane,
        DenseMethod::PlaneToPlane,
    ];

    /// The name in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            DenseMethod::Auto => "auto",
            DenseMethod::PointToPoint => "point-to-point",
            DenseMethod::PointToPlane => "point-to-plane",
            DenseMethod::PlaneToPlane => "gicp",
        }
    }

    /// The method of that name.
    pub fn from_name(name: &str) -> Option<DenseMethod> {
        DenseMethod::ALL.into_iter().find(|method| method.name() == name)
    }
}

/// When to match and when to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DenseConfig {
    /// What is compared.
    pub method: DenseMethod,
    /// Windows farther apart are not compared, m.
    pub max_correspondence_distance_m: f64,
    /// Most rounds over all windows; and over some, from each start.
    pub max_iterations: usize,
    /// A round that moves no window by more is the last, m. Zero leaves that to what is known of the noise.
    pub transformation_epsilon_m: f64,
    /// A round that changes the RMS distance by no more than this share is the last.
    pub fitness_epsilon: f64,
    /// Whether starts around the given one are tried as well.
    pub restarts: bool,
    /// Whether to look for starts everywhere, and not near the given one.
    pub global: bool,
    /// Threads; the answer is the same with any number.
    pub threads: usize,
}

impl Default for DenseConfig {
    fn default() -> Self {
        Self {
            method: DenseMethod::Auto,
            max_correspondence_distance_m: 0.05,
            max_iterations: 60,
            transformation_epsilon_m: 0.0,
            fitness_epsilon: 0.0,
            restarts: true,
            global: false,
            threads: 1,
        }
    }
}

/// A registration of two scans.
#[derive(Debug, Clone, PartialEq)]
pub struct Dense {
    /// Whether to use it.
    pub verdict: Verdict,
    /// Why not.
    pub reasons: Vec<String>,
    /// Motions that the common surface leaves free, in the target frame; there the start remains, or with
    /// [`DenseConfig::global`] the place that was found.
    pub undetermined: Vec<String>,
    /// The whole transform, the start included.
    pub target_from_source: Isometry3<f64>,
    /// 6 x 6, rotation first, perturbed on the right (in the source frame); `None` where something is
    /// undetermined.
    pub covariance: Option<Matrix6<f64>>,
    /// Rounds over all windows, and over some.
    pub iterations: usize,
    /// Why it ended.
    pub stop: Stop,
    /// Share of the source's windows that have found a match which counts.
    pub inlier_fraction: f64,
    /// Of the windows where both scans show something, the share at which it is the same.
    pub agreement: f64,
    /// How much larger or smaller the target shows what both show; `None` where the surfaces do not tell.
    pub size: Option<Size>,
    /// RMS distance across the surface, of the matches, m.
    pub rms_m: f64,
    /// Deviation of the matches over that which the scatter of their points promises.
    pub sigma: f64,
    /// Of a part that was searched for: the share of the scan within the part's box that lies on the part.
    pub explained: Option<f64>,
    /// Where several places explain the scan equally well: all of them, this answer first; else none.
    pub places: Vec<Isometry3<f64>>,
}

/// Windows that are asked for their opinion of the answer.
const ASKED: f64 = 5000.0;
/// With less agreement, something is wrong.
const AGREEING: f64 = 0.9;
/// Shifts and turns.
const ALL_MOTIONS: usize = 6;
/// With fewer matches, nothing is sure.
const OVERLAPPING: f64 = 0.05;

/// Registers two scans, from a start that is right to some centimetres and degrees.
///
/// # Errors
/// [`Error::Invalid`] where a scan shows no surface.
pub fn register(
    source: &Scan,
    target: &Scan,
    start: &Isometry3<f64>,
    config: &DenseConfig,
) -> Result<Dense, Error> {
    let names = ["source", "target"];
    let all: Result<Vec<Surface>, Error> = Surface::of_all(&[source, target], config.threads)
        .into_iter()
        .zip(names)
        .map(|(surface, name)| {
            surface.ok_or_else(|| Error::Invalid(format!("the {name} scan shows no surface")))
        })
        .collect();
    let all = all?;
    Ok(register_surfaces(&all[0], &all[1], start, config))
}

/// Registers the surfaces of two scans; where nothing can be compared, the start is rejected.
pub fn register_surfaces(
    source: &Surface,
    target: &Surface,
    start: &Isometry3<f64>,
    config: &DenseConfig,
) -> Dense {
    registered(source, target, start, config).unwrap_or_else(|error| Dense {
        verdict: Verdict::Rejected,
        reasons: vec![match error {
            Error::TooFewPoints { .. } => nothing_near(config),
            Error::NotDetermined { what } => what,
            other => other.to_string(),
        }],
        undetermined: vec![],
        target_from_source: *start,
        covariance: None,
        iterations: 0,
        stop: Stop::NoMatches,
        inlier_fraction: 0.0,
        agreement: 0.0,
        size: None,
        rms_m: f64::NAN,
        sigma: f64::NAN,
        explained: None,
        places: vec![],
    })
}

fn nothing_near(config: &DenseConfig) -> String {
    if config.global {
        return "the source was found nowhere in the target: give a start, or scans with more shape in common".into();
    }
    format!(
        "hardly anything of the source lies within {:.0} mm of the target: give a better start, or a larger \
         distance",
        1e3 * config.max_correspondence_distance_m
    )
}

fn registered(
    source: &Surface,
    target: &Surface,
    start: &Isometry3<f64>,
    config: &DenseConfig,
) -> Result<Dense, Error> {
    if config.global
        && let Some(search) = Search::new(source, target, config.threads)
    {
        return part_search::registered(&search, source, target, config);
    }
    let mut descent = Descent::new(source, target, config);
    let gate = config.max_correspondence_distance_m;
    let mut starts = vec![*start];
    if config.global {
        starts = global::starts(source, target, config.threads);
    } else if config.restarts {
        starts.extend(rivals::around(start, &source.middle, 0.5 * gate));
    }
    let from = (!config.global).then_some(start);
    let rivals = rivals::answers(&descent, &starts, from, gate)?;
    let best = &rivals[0].reached;
    let held = if config.global { best.target_from_source } else { *start };
    let mut found = refined(&mut descent, best, &held, gate)?;
    add_reasons(&mut found, source, &rivals);
    found.conclude();
    Ok(found)
}

/// An answer over all windows; along motions that the common surface leaves free it stays where it is `held`.
pub(super) fn refined(
    descent: &mut Descent,
    from: &Reached,
    held: &Isometry3<f64>,
    gate: f64,
) -> Result<Dense, Error> {
    let mut reached = from.clone();
    descent.nearby(&mut reached)?;
    descent.fine(&mut reached)?;
    let sigma = descent.sigma;
    let freedom = Freedom::of(descent, &reached.target_from_source);
    let (directions, free) = freedom.directions();
    let (mut undetermined, mut reasons) = (vec![], vec![]);
    if free == ALL_MOTIONS {
        // there is no surface that leaves all free: the matches say nothing where they are
        reasons.push(stuck(descent.config));
    } else if free > 0 {
        let columns: Vec<_> = (0..free).map(|k| directions.column(k).into_owned()).collect();
        undetermined = freedom.named(&columns, descent.source.radius());
        // once more, along the other directions alone
        let mut rest = directions;
        rest.columns_mut(0, free).fill(0.0);
        descent.along = Some(rest);
        reached.target_from_source = *held;
        descent.afar(&mut reached, gate)?;
        descent.fine(&mut reached)?;
    }
    let at = reached.target_from_source;
    Ok(Dense {
        verdict: Verdict::Rejected,
        reasons,
        undetermined,
        target_from_source: at,
        covariance: freedom.covariance(&at).filter(|_| free == 0),
        iterations: reached.iterations,
        stop: reached.stop,
        inlier_fraction: reached.inliers / reached.all,
        agreement: Opinions::of(descent, &at, ASKED, sigma).agreeing(),
        size: if free == 0 { Size::of(descent, &at) } else { None },
        rms_m: reached.rms_m,
        sigma,
        explained: None,
        places: vec![],
    })
}

/// Matches that hold one another where they are, in no place that is right.
fn stuck(config: &DenseConfig) -> String {
    let other = match config.method {
        DenseMethod::Auto => "",
        _ => "take the method auto, or ",
    };
    let start = if config.global { "scans with more shape in common" } else { "a better start" };
    format!(
        "it stopped in a local minimum, where its matches tell less than they scatter: {other}give {start}"
    )
}

/// What speaks against an answer.
pub(super) fn add_reasons(found: &mut Dense, source: &Surface, rivals: &[Rival]) {
    if let [best, others @ ..] = rivals
        && !others.is_empty()
        && found.undetermined.is_empty()
    {
        let away = |r: &Rival| {
            source.moved(&r.reached.target_from_source, &best.reached.target_from_source)
        };
        let nearest = others.iter().map(away).fold(f64::INFINITY, f64::min);
        found.reasons.push(format!(
            "the scans fit about as well in {} other {}, the nearest {:.0} mm away: give a better start, or \
             scans with more shape in common",
            others.len(),
            if others.len() == 1 { "place" } else { "places" },
            1e3 * nearest
        ));
    }
    if found.stop == Stop::MaxIterations {
        found.reasons.push(format!(
            "the rounds were used up, and it still moved ({} in all)",
            found.iterations
        ));
    }
    if found.agreement < AGREEING {
        found.reasons.push(format!(
            "of the places where both scans show something, it differs at {:.0} %: the start may be too far \
             off, or things were moved between the scans",
            100.0 * (1.0 - found.agreement)
        ));
    }
    if let Some(size) = found.size.filter(Size::differs) {
        found.reasons.push(format!(
            "the target shows things {:.2} % {} than the source (+/- {:.2} %): see to the scale of the depth, to the \
             unit, and that both show the same thing in the same version",
            100.0 * (size.ratio - 1.0).abs(),
            if size.ratio > 1.0 { "larger" } else { "smaller" },
            100.0 * size.sigma
        ));
    }
    if found.inlier_fraction < OVERLAPPING {
        found.reasons.push(format!(
            "only {:.1} % of the source lies on the target",
            100.0 * found.inlier_fraction
        ));
    }
}

impl Dense {
    /// The verdict that follows from the reasons, from what is free and from how many places there are.
    pub(super) fn conclude(&mut self) {
        let is_one = self.undetermined.is_empty() && self.places.is_empty();
        self.verdict = match (self.reasons.is_empty(), is_one) {
            (false, _) => Verdict::Rejected,
            (true, false) => Verdict::Undetermined,
            (true, true) => Verdict::Accepted,
        };
        if !self.undetermined.is_empty() {
            let free = self.undetermined.join("; ");
            self.reasons.push(format!("the common surface leaves free: {free}"));
        }
    }
}

#[cfg(test)]
mod tests;
