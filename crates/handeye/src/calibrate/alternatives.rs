//! Priors that allow for a mistake: the declared value is right, or it is not, and then it is anywhere near.
//!
//! Such a prior is a mixture of normal distributions about what was declared, narrow ones and wide ones,
//!
//! ```text
//! p(x) = Σ_m π_m N(x; declared, σ_m²)        w_m ∝ π_m p(data | m)
//! ```
//!
//! Each component is one fit, and its evidence `p(data | m)` the restricted likelihood with the prior's determinant
//! in it (Laplace's approximation). The answer has the mean and the covariance of the posterior mixture,
//!
//! ```text
//! x̄ = Σ w_m x_m        C = Σ w_m (C_m + (x_m - x̄)(x_m - x̄)ᵀ)
//! ```
//!
//! so that it follows the declared value where the data do not contradict it, the data where they do, and is as
//! uncertain as the choice between them.
//!
//! J. Hoeting, D. Madigan, A. Raftery and C. Volinsky, *Bayesian model averaging: a tutorial*, Statistical Science
//! 14(4), 1999.

use nalgebra::{DMatrix, DVector};

use super::{LensSigma, Session, TargetSize, alike};
use crate::{
    Distortion, Error, HandEye, Intrinsics, TargetModel,
    detect::sight::{CLOCK, DEPTH_BIAS, DEPTH_SCALE, LENS, PRINT, TARGET_SCALE},
    refine::{self, Extra, ExtraKind, JointFit, KnownNoise, Problem},
};

/// The target's size, as a share of the declared one.
pub(super) const SIZE: ExtraKind = ExtraKind::Camera(TARGET_SCALE);

const SCALE: ExtraKind = ExtraKind::Camera(DEPTH_SCALE);
const BIAS: ExtraKind = ExtraKind::Camera(DEPTH_BIAS);

/// Components of the prior of a printed target. A plate that was manufactured or measured is right to 0.02 %; printers
/// and paper are off by some 0.5 %; "fit to page" and sizes that nobody measured by more. The feed of a printer may be
/// off by another share than its carriage, and paper that is not glued to a plate is bent.
const PRINTED: [(f64, Print); 6] = [
    (0.70, Print { size: 2e-4, aspect: EVEN, bend: FLAT }),
    (0.17, Print { size: 5e-3, aspect: EVEN, bend: FLAT }),
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
    (0.50, LensPrior { focal: 2e-4, aspect: 5e-5, centre: 2e-4, distortion: SURE }),
    (0.25, LensPrior { focal: 2.5e-3, aspect: 1e-4, centre: 5e-4, distortion: SURE }),
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
        0.06,
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
/// A component of less weight than this changes neither mean nor covariance.
const NEGLIGIBLE: f64 = 1e-4;

/// One component of the prior.
#[derive(Debug, Clone, PartialEq)]
struct Component {
    log_probability: f64,
    /// Standard deviations of some unknowns.
    sigmas: Vec<(ExtraKind, f64)>,
    /// Which of them it takes to be as declared.
    declared: Declared<bool>,
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
pub(super) struct Declared<T> {
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

/// The prior of what was declared of the target; without components that of the extras themselves.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Alternatives(Vec<Component>);

/// Width of the pictures, px.
fn width(camera: &Intrinsics) -> f64 {
    f64::from(camera.width.max(1)).max(camera.cx)
}

/// A fit under all components.
pub(super) struct Averaged {
    /// The problem with the likeliest component as its prior.
    pub problem: Problem,
    /// Mean and covariance over all components.
    pub fit: JointFit,
    /// Posterior probabilities that what was declared is right.
    pub as_declared: Declared<f64>,
}

/// All is as declared.
const AS_DECLARED: Declared<bool> = Declared { size: true, shape: true, depth: true, lens: true };
/// A component for the target: probability, standard deviations, and what it takes to be as declared.
type Printing = (f64, Vec<(ExtraKind, f64)>, Declared<bool>);
/// What was declared is not in question.
const NO_DOUBT: Declared<f64> = Declared { size: 1.0, shape: 1.0, depth: 1.0, lens: 1.0 };

/// The unknown size of the session's target, where its views tell sizes by their corners.
pub(super) fn unknown_size(session: &Session) -> Option<Extra> {
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
pub(super) fn unknown_shape(session: &Session) -> Vec<Extra> {
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
pub(super) fn unknown_depth(session: &Session) -> Vec<Extra> {
    let both = session.camera.is_some() && session.target.is_some();
    let scanned = both && session.observations.iter().any(|o| !o.surface.is_empty());
    let (_, scale, bias) = DEPTH[0];
    let all = [Extra::about_zero(SCALE, scale), Extra::about_zero(BIAS, bias)];
    if scanned { all.to_vec() } else { vec![] }
}

/// The lens of the session's camera: what calibrations leave open, or all where it was calibrated from these views.
pub(super) fn unknown_lens(session: &Session) -> Vec<Extra> {
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
fn is_shared(kind: ExtraKind) -> bool {
    matches!(kind, ExtraKind::Camera(which) if which != CLOCK)
}

impl Alternatives {
    /// What the user said of the target's size, and what is known of scans.
    pub(super) fn of(session: &Session) -> Self {
        let printed = match session.target_size {
            // without a target of a declared size a free scale has a prior of its own
            _ if unknown_size(session).is_none() => &[][..],
            TargetSize::Measured(_) => &MEASURED[..],
            TargetSize::Printed => &PRINTED[..],
        };
        let half_length = session.target.as_ref().map_or(0.0, half_length);
        let printed: Vec<Printing> = match printed {
            [] => vec![(1.0, vec![], AS_DECLARED)],
            all => all
                .iter()
                .map(|(p, print)| (*p, print.sigmas(half_length), print.declared()))
                .collect(),
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
        Self(all)
    }

    /// The components, where the problem has unknowns that they concern.
    fn components(&self, problem: &Problem) -> &[Component] {
        if problem.extras.iter().any(|e| is_shared(e.kind)) { &self.0 } else { &[] }
    }

    /// Fits the problem under every component.
    ///
    /// # Errors
    /// As [`refine::fit_joint`].
    pub(super) fn fit(
        &self,
        problem: &Problem,
        start: &HandEye,
        known: &KnownNoise,
    ) -> Result<Averaged, Error> {
        self.average(problem, |problem| refine::fit_joint(problem, start, known))
    }

    /// The same from an answer that is near.
    pub(super) fn refit(&self, problem: &Problem, near: &JointFit, known: &KnownNoise) -> Averaged {
        let fitted = |p: &Problem| Ok(refine::joint::refit(p, near, known));
        self.average(problem, fitted).unwrap_or_else(|_: Error| Averaged {
            problem: problem.clone(),
            fit: refine::joint::refit(problem, near, known),
            as_declared: NO_DOUBT,
        })
    }

    fn average(
        &self,
        problem: &Problem,
        fit: impl Fn(&Problem) -> Result<JointFit, Error>,
    ) -> Result<Averaged, Error> {
        let components = self.components(problem);
        if components.is_empty() {
            return Ok(Averaged {
                problem: problem.clone(),
                fit: fit(problem)?,
                as_declared: NO_DOUBT,
            });
        }
        // the noise is that of the widest prior: a mistake would otherwise pass for noise, and likelihoods under
        // different noise do not compare
        let widest = components.last().map_or_else(|| problem.clone(), |c| c.applied(problem));
        let reference = fit(&widest)?;
        let excess = alike::excess(&widest, &reference, is_shared);
        let mut all = Vec::with_capacity(components.len());
        for component in components {
            // what is as good as `excess` times less data is, in the unknowns, a prior that much tighter
            let tight = component.tightened(excess).applied(problem);
            let mut found = refine::joint::refit_under_noise_of(&tight, &reference);
            let evidence = found.log_likelihood + for_unknown_noise(&found, &reference, excess);
            let problem = component.applied(problem);
            found.extras.clone_from(&problem.extras);
            widen(&mut found, excess);
            all.push((component.log_probability + evidence, problem, found));
        }
        let declared = |which: fn(&Declared<bool>) -> bool, weights: &[f64]| {
            let narrow = components.iter().zip(weights).filter(|(c, _)| which(&c.declared));
            narrow.map(|(_, w)| w).sum::<f64>()
        };
        let most = all.iter().map(|a| a.0).fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = all.iter().map(|a| (a.0 - most).exp()).sum();
        let weights: Vec<f64> = all.iter().map(|a| (a.0 - most).exp() / sum).collect();
        let best = (0..all.len()).max_by(|&i, &j| all[i].0.total_cmp(&all[j].0)).unwrap_or(0);
        let fits: Vec<(f64, &JointFit)> =
            weights.iter().copied().zip(all.iter().map(|a| &a.2)).collect();
        let fit = mixture(&fits, best);
        let as_declared = Declared {
            size: declared(|d| d.size, &weights),
            shape: declared(|d| d.shape, &weights),
            depth: declared(|d| d.depth, &weights),
            lens: declared(|d| d.lens, &weights),
        };
        Ok(Averaged { problem: all[best].1.clone(), fit, as_declared })
    }
}

/// Share of the equations that tell the noise of one kind, of rotations or of positions.
const OF_ONE_NOISE: f64 = 0.5;

/// What the likelihood of a fit that costs `Δ` more gains where the noise is an estimate, of `ν` equations: integrated
/// over the noise, `exp(-Δ/2)` is `(1 + Δ/ν)^(-ν/2)`. Of both there is as much less as captures err alike.
fn for_unknown_noise(fit: &JointFit, reference: &JointFit, excess: f64) -> f64 {
    let more = (fit.cost - reference.cost).max(0.0);
    let equations = (OF_ONE_NOISE * reference.degrees_of_freedom).max(1.0);
    0.5 * more - 0.5 * equations * (more / excess / equations).ln_1p()
}

/// Widens the covariance of what all captures tell together, and of what depends on it:
/// `C + (λ-1) C_u C_uu⁻¹ C_uᵀ`.
fn widen(fit: &mut JointFit, excess: f64) {
    let which: Vec<usize> =
        (0..fit.extras.len()).filter(|k| is_shared(fit.extras[*k].kind)).map(|k| 12 + k).collect();
    let Some(covariance) = &mut fit.covariance else { return };
    let cross = covariance.select_columns(&which);
    let own = cross.select_rows(&which);
    if let Some(cholesky) = own.cholesky() {
        *covariance += &cross * cholesky.solve(&cross.transpose()) * (excess - 1.0);
    }
}

impl Component {
    fn tightened(&self, excess: f64) -> Self {
        let mut tight = self.clone();
        tight.sigmas.iter_mut().for_each(|(_, sigma)| *sigma /= excess.sqrt());
        tight
    }

    fn applied(&self, problem: &Problem) -> Problem {
        let mut problem = problem.clone();
        for extra in &mut problem.extras {
            if let Some((_, sigma)) = self.sigmas.iter().find(|(kind, _)| *kind == extra.kind) {
                extra.prior_sigma = *sigma;
            }
        }
        problem
    }
}

/// Mean and covariance of a mixture of answers, about the `best` of them.
fn mixture(fits: &[(f64, &JointFit)], best: usize) -> JointFit {
    let about = fits[best].1;
    let counts = |(w, f): &&(f64, &JointFit)| *w > NEGLIGIBLE && f.covariance.is_some();
    let parts: Vec<(f64, DVector<f64>, &DMatrix<f64>)> = fits
        .iter()
        .filter(counts)
        .filter_map(|(w, f)| Some((*w, difference(about, f), f.covariance.as_ref()?)))
        .collect();
    let total: f64 = parts.iter().map(|p| p.0).sum();
    if parts.len() < 2 || about.covariance.is_none() {
        return about.clone();
    }
    let n = parts[0].1.len();
    let mean = parts.iter().fold(DVector::zeros(n), |m, (w, d, _)| m + d * (w / total));
    let spread = |c: DMatrix<f64>, (w, d, own): &(f64, DVector<f64>, &DMatrix<f64>)| {
        let off = d - &mean;
        c + (*own + &off * off.transpose()) * (w / total)
    };
    let covariance = parts.iter().fold(DMatrix::zeros(n, n), spread);
    let mut averaged = about.clone();
    averaged.hand_eye = HandEye {
        mount_from_camera: about
            .hand_eye
            .mount_from_camera
            .retract(&mean.fixed_rows::<6>(0).into()),
        anchor_from_target: about
            .hand_eye
            .anchor_from_target
            .retract(&mean.fixed_rows::<6>(6).into()),
    };
    averaged.values += mean.rows(12, n - 12);
    averaged.covariance = Some(covariance);
    averaged
}

/// Tangent from one answer to another: both poses and the extras.
fn difference(from: &JointFit, to: &JointFit) -> DVector<f64> {
    let x = from.hand_eye.mount_from_camera.local(&to.hand_eye.mount_from_camera);
    let y = from.hand_eye.anchor_from_target.local(&to.hand_eye.anchor_from_target);
    let values = &to.values - &from.values;
    let all = x.iter().chain(y.iter()).chain(values.iter()).copied();
    DVector::from_iterator(12 + values.len(), all)
}
