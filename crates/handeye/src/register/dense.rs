//! Registration of two scans, organised or in any order.
//!
//! From a start that is right to some centimetres and degrees; others around it are tried as well, and the
//! answer is given with what speaks for and against it.

use nalgebra::{Isometry3, Matrix6};

use super::{
    descent::Descent,
    freedom::Freedom,
    global,
    icp::Stop,
    rivals::{self, Opinions, Rival},
    search::{Evidence, Search},
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
    pub places: Vec<Isometry3<f64>>,
    pub note: String,
}

/// Windows that are asked for their opinion of the answer.
const ASKED: f64 = 5000.0;
/// With less agreement, something is wrong.
const AGREEING: f64 = 0.9;
/// Shifts and turns.
const ALL_MOTIONS: usize = 6;
/// A place that was found is improved by matches within so many times the spread of a window.
const NEARBY: f64 = 3.0;
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
        places: vec![],
        note: String::new(),
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
    let mut descent = Descent::new(source, target, config);
    let mut gate = config.max_correspondence_distance_m;
    let mut starts = vec![*start];
    let search = config.global.then(|| Search::new(source, target, config.threads)).flatten();
    let places = search.as_ref().map_or(vec![], Search::places);
    if search.is_some() {
        starts.clear();
        starts.extend(places.first().map(|place| place.target_from_source));
        gate = gate.min(NEARBY * source.spread.max(target.spread));
    } else if config.global {
        starts = global::starts(source, target, config.threads);
    } else if config.restarts {
        starts.extend(rivals::around(start, &source.middle, 0.5 * gate));
    }
    let from = (!config.global).then_some(start);
    let rivals = rivals::answers(&descent, &starts, from, gate)?;
    let mut reached = rivals[0].reached.clone();
    let at_best = if search.is_some() { starts[0] } else { reached.target_from_source };
    descent.nearby(&mut reached)?;
    descent.fine(&mut reached)?;
    let sigma = descent.sigma;
    let freedom = Freedom::of(&descent, &reached.target_from_source);
    let (directions, free) = freedom.directions();
    let (mut undetermined, mut reasons) = (vec![], vec![]);
    if free == ALL_MOTIONS {
        // there is no surface that leaves all free: the matches say nothing where they are
        reasons.push(stuck(config));
    } else if free > 0 {
        let columns: Vec<_> = (0..free).map(|k| directions.column(k).into_owned()).collect();
        undetermined = freedom.named(&columns, source.radius());
        // once more from the start, along the other directions alone
        let mut rest = directions;
        rest.columns_mut(0, free).fill(0.0);
        descent.along = Some(rest);
        reached.target_from_source = if config.global { at_best } else { *start };
        descent.afar(&mut reached, gate)?;
        descent.fine(&mut reached)?;
    }
    let at = reached.target_from_source;
    let mut found = Dense {
        verdict: Verdict::Accepted,
        reasons,
        undetermined,
        target_from_source: at,
        covariance: freedom.covariance(&at).filter(|_| free == 0),
        iterations: reached.iterations,
        stop: reached.stop,
        inlier_fraction: reached.inliers / reached.all,
        size: None,
        agreement: Opinions::of(&descent, &at, ASKED, sigma).agreeing(),
        rms_m: reached.rms_m,
        sigma,
        places: vec![],
        note: String::new(),
    };
    if free == 0 {
        found.size = Size::of(&mut descent, &at);
    }
    judge(&mut found, source, &rivals);
    if let Some(search) = &search {
        if std::env::var_os("HANDEYE_SEARCH_DEBUG").is_some() {
            for p in &places { eprintln!("{:?} {:.3}", p.evidence, search.apart(&p.target_from_source, &found.target_from_source)); }
            eprintln!("end {:?}", search.evidence(&found.target_from_source));
        }
        let e = search.evidence(&found.target_from_source);
        let f = |e: &Evidence| format!("ex {:.2} of {:.2} con {:.2} mis {:.2} sc {:.0}", e.explained, e.of_scan, e.contradicted, e.missing, e.score);
        found.note = format!("{} / {} 2nd {:.2} ap {:.3}", f(&e), f(&places[0].evidence), places.get(1).map_or(0.0, |p| p.evidence.score / places[0].evidence.score), search.apart(&places[0].target_from_source, &found.target_from_source));
        found.places = places.iter().filter(|p| p.evidence.score > 0.96 * places[0].evidence.score).map(|p| p.target_from_source).collect();
    }
    Ok(found)
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

fn judge(found: &mut Dense, source: &Surface, rivals: &[Rival]) {
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
    found.verdict = match (found.reasons.is_empty(), found.undetermined.is_empty()) {
        (false, _) => Verdict::Rejected,
        (true, false) => Verdict::Undetermined,
        (true, true) => Verdict::Accepted,
    };
    if !found.undetermined.is_empty() {
        found
            .reasons
            .push(format!("the common surface leaves free: {}", found.undetermined.join("; ")));
    }
}

#[cfg(test)]
mod tests;
