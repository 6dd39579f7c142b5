//! Priors of print, scans and intrinsics, before anything was measured.
//!
//! Each is a mixture of normal distributions about what was declared: what a careful user has, and what goes wrong. The
//! components of a session are all combinations that are not too unlikely.

use crate::{
    Distortion, Intrinsics, TargetModel,
    detect::sight::{CLOCK, DEPTH_BIAS, DEPTH_SCALE, LENS, PRINT, TARGET_SCALE},
    estimate::{Extra, ExtraKind, Problem},
    model::session::{LensSigma, Session, TargetSize},
};

/// The target's size, as a share of the declared one.
pub(crate) const SIZE: ExtraKind = ExtraKind::Camera(TARGET_SCALE);
const SCALE: ExtraKind = ExtraKind::Camera(DEPTH_SCALE);
const BIAS: ExtraKind = ExtraKind::Camera(DEPTH_BIAS);
/// Components of the prior of a printed target. A plate that was manufactured or measured is right to 0.02 %; printers
/// and paper are off by some 0.5 %; "fit to page" and sizes that nobody measured by more. The feed of a printer may be
/// off by another share than its carriage, and paper that is not glued to a plate is bent.
const PRINTED: [(f64, Print); 6] = [
    (0.58, Print { size: 2e-4, aspect: EVEN, bend: FLAT }),
    (0.29, Print { size: 5e-3, aspect: EVEN, bend: FLAT }),
    (0.04, Print { size: 2.5e-2, aspect: EVEN, bend: FLAT }),
    (0.04, Print { size: 5e-3, aspect: UNEVEN, bend: FLAT }),
    (0.04, Print { size: 2e-4, aspect: EVEN, bend: BENT }),
    (0.01, Print { size: 2.5e-2, aspect: UNEVEN, bend: BENT }),
];
/// The same of one whose size was measured: nobody measures whether it is flat.
const MEASURED: [(f64, Print); 2] = [
    (0.95, Print { size: 0.0, aspect: EVEN, bend: FLAT }),
    (0.05, Print { size: 0.0, aspect: EVEN, bend: BENT }),
];
/// Standard deviations of y against x (share) of a print.
const EVEN: f64 = 1e-4;
const UNEVEN: f64 = 7e-3;
/// Standard deviations of the height at the ends of a target, as share of half its length.
const FLAT: f64 = 4e-4;
const BENT: f64 = 1.2e-2;
/// The same of the depth of scans: probability, standard deviations of its scale (share) and of its bias (m). Most
/// 3D cameras are within their calibration; some are cold or were calibrated long ago; few are far off.
const DEPTH: [(f64, f64, f64); 3] = [(0.7, 3e-4, 1e-4), (0.2, 3e-3, 1e-3), (0.1, 2e-2, 5e-3)];
/// The same of a given lens: well calibrated; its focus was turned, or its zoom, since then; its centre as well, after
/// a knock or with another crop; all of it, calibrated from few views or from one side; and far off, of a data sheet.
const GIVEN: [(f64, LensPrior); 5] = [
    (0.40, LensPrior { focal: 2e-4, aspect: 5e-5, centre: 2e-4, distortion: SURE }),
    (0.35, LensPrior { focal: 2.5e-3, aspect: 1e-4, centre: 5e-4, distortion: SURE }),
    (0.12, LensPrior { focal: 4e-3, aspect: 2e-4, centre: 4e-3, distortion: SURE }),
    (
        0.08,
        LensPrior {
            focal: 4e-3,
            aspect: 1e-3,
            centre: 4e-3,
            distortion: [0.02, 0.05, 1e-3, 1e-3, 0.05],
        },
    ),
    (
        0.05,
        LensPrior {
            focal: 1.5e-2,
            aspect: 3e-3,
            centre: 1.5e-2,
            distortion: [0.05, 0.1, 2e-3, 2e-3, 0.1],
        },
    ),
];
/// Distortion of a lens that was calibrated well.
const SURE: [f64; 5] = [1e-3, 3e-3, 5e-5, 5e-5, 3e-3];
/// One that these views alone have calibrated: nothing is known beyond what they say.
const OWN: LensPrior = LensPrior { focal: 0.3, aspect: 0.3, centre: 0.2, distortion: [1.0; 5] };
/// Combinations of components that are less likely than this beforehand are no part of the prior.
const LEAST_LIKELY: f64 = 3e-3;
/// Fewest corners that tell a board's shape.
const FEWEST_CORNERS: usize = 9;

/// One component of the prior.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Component {
    pub log_probability: f64,
    /// Standard deviations of some unknowns.
    pub sigmas: Vec<(ExtraKind, f64)>,
    /// Which of them it takes to be as declared.
    pub declared: Declared<bool>,
}

/// Standard deviations of a print: of its size (share; 0 where the unknown's own counts), of y against x (share), and
/// of the height of its ends (share of half its length).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Print {
    size: f64,
    aspect: f64,
    bend: f64,
}

impl Print {
    fn declared(&self) -> Declared<bool> {
        let size = self.size <= PRINTED[0].1.size;
        let shape = self.aspect <= EVEN && self.bend <= FLAT;
        Declared { size, shape, ..AS_DECLARED }
    }

    /// Those of the unknowns of a target.
    fn sigmas(&self, half_length_m: f64) -> Vec<(ExtraKind, f64)> {
        let bend = 2.0 * self.bend / half_length_m.max(f64::MIN_POSITIVE);
        let shape = [self.aspect, bend, bend, bend];
        let of_shape =
            shape.into_iter().enumerate().map(|(k, s)| (ExtraKind::Camera(PRINT + k), s));
        Some((SIZE, self.size)).filter(|s| s.1 > 0.0).into_iter().chain(of_shape).collect()
    }
}

/// Of the target's size and shape, of the depth of scans, and of the lens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Declared<T> {
    pub size: T,
    pub shape: T,
    pub depth: T,
    pub lens: T,
}

/// Standard deviations of a lens: of its focal length and of the proportion of both (shares), of its principal point
/// (share of the width), and of its distortion.
#[derive(Debug, Clone, Copy, PartialEq)]
struct LensPrior {
    focal: f64,
    aspect: f64,
    centre: f64,
    distortion: [f64; 5],
}

impl LensPrior {
    /// As the user states it: what is not stated is that of a lens that was calibrated well.
    fn stated(sigma: LensSigma, camera: &Intrinsics) -> Self {
        let well = GIVEN[0].1;
        let focal = sigma.focal_px.map_or(well.focal, |px| px / camera.fx);
        let centre = sigma.center_px.map_or(well.centre, |px| px / width(camera));
        Self { focal, centre, ..well }
    }

    /// The unknowns of a camera about where it stands.
    fn unknowns(&self, camera: &Intrinsics) -> Vec<Extra> {
        let (focal, centre) = (self.focal, self.centre * width(camera));
        let mut all = vec![focal * camera.fx, self.aspect * camera.fy, centre, centre];
        if matches!(camera.distortion, Distortion::BrownConrady(_)) {
            all.extend(self.distortion);
        }
        let one = |(i, sigma)| Extra::about_zero(ExtraKind::Camera(LENS + i), sigma);
        all.into_iter().enumerate().map(one).collect()
    }
}

/// Width of the images, px.
fn width(camera: &Intrinsics) -> f64 {
    f64::from(camera.width.max(1)).max(camera.cx)
}

/// All is as declared.
const AS_DECLARED: Declared<bool> = Declared { size: true, shape: true, depth: true, lens: true };

/// A component for the target: probability, standard deviations, and what it takes to be as declared.
type Printing = (f64, Vec<(ExtraKind, f64)>, Declared<bool>);

/// The unknown size of the session's target, where its views tell sizes by their corners.
pub(crate) fn unknown_size(session: &Session) -> Option<Extra> {
    let printed = |t: &TargetModel| !t.is_empty();
    session.target.as_ref().filter(|t| printed(t))?;
    session.camera.as_ref()?;
    let seen = session.observations.iter().any(|o| !o.corners.is_empty());
    let sigma = match session.target_size {
        TargetSize::Printed => PRINTED[0].1.size,
        TargetSize::Measured(sigma) => sigma,
    };
    (seen && sigma > 0.0).then(|| Extra::about_zero(SIZE, sigma))
}

/// The unknown shape of the session's target: of boards with corners enough to tell it, and that do not look the same
/// turned by a quarter, which would exchange x and y.
pub(crate) fn unknown_shape(session: &Session) -> Vec<Extra> {
    let Some(target) = session.target.as_ref().filter(|t| t.len() >= FEWEST_CORNERS) else {
        return vec![];
    };
    if unknown_size(session).is_none() || target.symmetries().len() > 2 {
        return vec![];
    }
    let of_shape = |(kind, sigma)| Extra::about_zero(kind, sigma);
    let shape = Print { size: 0.0, ..PRINTED[0].1 };
    shape.sigmas(half_length(target)).into_iter().map(of_shape).collect()
}

/// From the middle of a target to its farthest corner, m.
fn half_length(target: &TargetModel) -> f64 {
    let middle = target.middle().vector();
    target.corners().iter().map(|c| (c.vector() - middle).norm()).fold(0.0, f64::max)
}

/// The unknown scale and bias of the depth of the session's scans.
pub(crate) fn unknown_depth(session: &Session) -> Vec<Extra> {
    let both = session.camera.is_some() && session.target.is_some();
    let scanned = both && session.observations.iter().any(|o| !o.surface.is_empty());
    let (_, scale, bias) = DEPTH[0];
    let all = [Extra::about_zero(SCALE, scale), Extra::about_zero(BIAS, bias)];
    if scanned { all.to_vec() } else { vec![] }
}

/// The lens of the session's camera: what calibrations leave open, or all where it was calibrated from these views.
pub(crate) fn unknown_lens(session: &Session) -> Vec<Extra> {
    let (Some(camera), Some(_)) = (&session.camera, &session.target) else { return vec![] };
    if !session.observations.iter().any(|o| !o.corners.is_empty()) {
        return vec![];
    }
    if !session.camera_from_views {
        let declared =
            session.lens_sigma.map_or(GIVEN[0].1, |sigma| LensPrior::stated(sigma, camera));
        return declared.unknowns(camera);
    }
    let mut all = OWN.unknowns(camera);
    if let Distortion::BrownConrady(k) = camera.distortion {
        // terms that the calibration from the views did not pay for stay out
        let paid = |e: &Extra| !matches!(e.kind, ExtraKind::Camera(n) if n >= LENS + 4 && k[n - LENS - 4] == 0.0);
        all.retain(paid);
    }
    all
}

/// Whether an unknown is one that all captures tell together: of the target, of the depth of scans, of the lens.
pub(crate) fn is_shared(kind: ExtraKind) -> bool {
    matches!(kind, ExtraKind::Camera(which) if which != CLOCK)
}

impl Component {
    pub(crate) fn tightened(&self, excess: f64) -> Self {
        let mut tight = self.clone();
        tight.sigmas.iter_mut().for_each(|(_, sigma)| *sigma /= excess.sqrt());
        tight
    }

    pub(crate) fn applied(&self, problem: &Problem) -> Problem {
        let mut problem = problem.clone();
        for extra in &mut problem.extras {
            if let Some((_, sigma)) = self.sigmas.iter().find(|(kind, _)| *kind == extra.kind) {
                extra.prior_sigma = *sigma;
            }
        }
        problem
    }
}

/// What the user said, and what is known of prints, scans and lenses; the widest component is the last.
pub(crate) fn components(session: &Session) -> Vec<Component> {
    let printed = match session.target_size {
        // without a target of a declared size a free scale has a prior of its own
        _ if unknown_size(session).is_none() => &[][..],
        TargetSize::Measured(_) => &MEASURED[..],
        TargetSize::Printed => &PRINTED[..],
    };
    let half_length = session.target.as_ref().map_or(0.0, half_length);
    let printed: Vec<Printing> = match printed {
        [] => vec![(1.0, vec![], AS_DECLARED)],
        all => {
            all.iter().map(|(p, print)| (*p, print.sigmas(half_length), print.declared())).collect()
        }
    };
    let scanned = session.observations.iter().any(|o| !o.surface.is_empty());
    let depth = if scanned { &DEPTH[..] } else { &DEPTH[..1] };
    let lens: Vec<(f64, Vec<Extra>)> = match &session.camera {
        Some(camera)
            if !session.camera_from_views
                && session.lens_sigma.is_none()
                && !unknown_lens(session).is_empty() =>
        {
            GIVEN.iter().map(|(p, sigma)| (*p, sigma.unknowns(camera))).collect()
        }
        _ => vec![(1.0, vec![])],
    };
    let given = lens.len();
    let mut all = vec![];
    for (i, (of_print, print, declared)) in printed.iter().enumerate() {
        for (j, (of_depth, scale, bias)) in depth.iter().enumerate() {
            for (k, (of_lens, lens)) in lens.iter().enumerate() {
                let widest = i + 1 == printed.len() && j + 1 == depth.len() && k + 1 == given;
                if of_print * of_depth * of_lens < LEAST_LIKELY && !widest {
                    continue;
                }
                let kinds = [(SCALE, *scale), (BIAS, *bias)];
                let lens = lens.iter().map(|e| (e.kind, e.prior_sigma));
                all.push(Component {
                    log_probability: (of_print * of_depth * of_lens).ln(),
                    sigmas: print.iter().copied().chain(kinds).chain(lens).collect(),
                    declared: Declared { depth: j == 0, lens: k == 0, ..*declared },
                });
            }
        }
    }
    all
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use crate::{
        Setup,
        simulate::{Cell, DepthSensor},
    };

    fn session(depth: Option<DepthSensor>) -> Session {
        let usual = Cell::new(Setup::EyeInHand, 1);
        let cell = Cell { captures: 6, touches: 0, depth, ..usual };
        cell.session(1).unwrap().0
    }

    #[test]
    fn the_components_are_nearly_all_of_the_prior_and_the_widest_is_the_last() {
        for depth in [None, Some(DepthSensor::default())] {
            let all = components(&session(depth));
            let sum: f64 = all.iter().map(|c| c.log_probability.exp()).sum();
            // without scans nothing is asked of their depth
            let whole = if depth.is_some() { 1.0 } else { DEPTH[0].0 };
            assert!((0.9 * whole..=whole + 1e-9).contains(&sum), "{sum} of {whole}");
            assert!(all.len() <= 80, "{}", all.len());
            let widest = all.last().unwrap();
            for (kind, sigma) in all.iter().flat_map(|c| &c.sigmas) {
                let most = widest.sigmas.iter().find(|s| s.0 == *kind).unwrap().1;
                assert!(sigma <= &most, "{kind:?}: {sigma} after {most}");
            }
        }
    }

    #[test]
    fn what_the_user_measured_is_no_question() {
        let mut session = session(None);
        session.target_size = TargetSize::Measured(1e-4);
        session.lens_sigma = Some(LensSigma { focal_px: Some(0.5), center_px: None });
        let all = components(&session);
        assert!(all.iter().all(|c| c.declared.size && c.declared.lens));
        assert!(all.iter().all(|c| c.sigmas.iter().all(|(kind, _)| *kind != SIZE)));
        let lens = unknown_lens(&session);
        assert_eq!(lens[0].prior_sigma, 0.5);
        assert_eq!(unknown_size(&session).unwrap().prior_sigma, 1e-4);
    }

    #[test]
    fn a_shape_is_asked_of_boards_that_can_tell_it() {
        let mut session = session(None);
        assert_eq!(unknown_shape(&session).len(), 4);
        // the same turned by a quarter: x and y could be exchanged from view to view
        session.target = Some(TargetModel::CircleGrid { columns: 7, rows: 7, pitch_mm: 20.0 });
        assert!(unknown_shape(&session).is_empty());
        session.camera = None;
        assert!(unknown_lens(&session).is_empty());
    }
}
