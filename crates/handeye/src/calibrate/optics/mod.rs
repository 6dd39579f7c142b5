//! The camera's own parameters and the scale of its depth, found with the robot's help.
//!
//! A camera that was calibrated from these very views is as unsure as they are: its parameters stay
//! free in the fit. One that was given is believed, unless the whole of views and robot poses says
//! with confidence that it is off; the same holds for the depth of scans. What is found moves the
//! camera, all targets are posed anew, and the fit is linearised there again.

pub(crate) mod alternatives;
pub(crate) mod cluster_variance;
pub(crate) mod prior;
pub(crate) mod size;

use nalgebra::{DMatrix, Matrix3, Matrix6, SVector, Vector2, Vector3, Vector6};

use crate::{
    Camera, ImageCorner, Intrinsics, Observation, Pose, SurfaceCorner, Target, TargetModel,
    calibrate::{
        captures::residuals,
        flow::{
            config::Config,
            notes::Notes,
            views::{self, Views, views_problem},
        },
        optics::{
            alternatives::Alternatives,
            prior::{Declared, SIZE, unknown_depth, unknown_lens, unknown_shape, unknown_size},
        },
        result::{CameraResult, DepthResult},
    },
    detect::{
        self,
        sight::{
            CLOCK, DEPTH_BIAS, DEPTH_SCALE, LENS, PRINT, SHAPES, Sight, TARGET_SCALE, by_shape,
            corrected, lifted_again,
        },
    },
    estimate::{Extra, ExtraKind, JointFit},
    findings::{CameraFinding, TargetFinding},
    model::{camera::PARAMETERS, session::Session},
    register::rigid_fit::point_jacobian,
    solve::View,
};

/// What of camera and depth is free, and how far it has moved from what was given.
#[derive(Debug, Clone, Default)]
pub(crate) struct Optics {
    /// The unknowns; priors are relative to where camera and depth stand now.
    pub extras: Vec<Extra>,
    /// The target is larger than declared by this share.
    pub size: f64,
    /// The camera as it was given.
    given: Option<Intrinsics>,
    lens: SVector<f64, PARAMETERS>,
    focal: f64,
    depth_scale: f64,
    depth_bias_m: f64,
}

/// What of camera and depth is not as declared.
#[derive(Default)]
pub(crate) struct Refined {
    pub camera: Option<CameraResult>,
    pub depth: Option<DepthResult>,
    pub notes: Notes,
}

/// A move below this part of its standard deviation needs no further look.
const SETTLED: f64 = 0.1;
/// Sizes that differ by less than this share need no further look: poses are as good as linear in them.
const LINEAR_SIZE: f64 = 1e-2;
/// The same of a bias of depth, m.
const LINEAR_BIAS: f64 = 5e-4;
/// The same of focal lengths and principal point (share of the focal length), and of the distortion.
const LINEAR_LENS: f64 = 1e-3;
const LINEAR_DISTORTION: f64 = 5e-3;

/// Looks whether camera or depth must move; the session as it is then, or `None` where all stays.
pub(crate) fn moved_session(
    given: &Session,
    views: &Views,
    start: &crate::HandEye,
    optics: &Optics,
    config: &Config,
) -> Option<(Session, Optics)> {
    if optics.extras.is_empty() || views.session.camera.is_none() {
        return None;
    }
    let fit = fitted(views, &with_sights(views), &optics.extras, start, config)?;
    optics.moved_by(given, &fit)
}

fn fitted(
    views: &Views,
    sighted: &[View],
    extras: &[Extra],
    start: &crate::HandEye,
    config: &Config,
) -> Option<JointFit> {
    let problem = views_problem(views.session, sighted, extras);
    let fitted = Alternatives::of(views.session).fit(&problem, start, &config.known).ok()?;
    Some(fitted.fit)
}

impl Optics {
    /// The session where another fit, of the same unknowns, puts camera and depth; `None` where that
    /// is here.
    pub(crate) fn moved_by(&self, given: &Session, fit: &JointFit) -> Option<(Session, Optics)> {
        if self.is_settled(fit) {
            return None;
        }
        let mut next = self.clone();
        next.take(fit);
        let session = next.applied(given)?;
        Some((session, next))
    }

    /// What is free: the size of a target whose views tell it, the depth of its scans, and the lens.
    pub(crate) fn of(session: &Session) -> Self {
        let of_target = unknown_size(session).into_iter().chain(unknown_depth(session));
        let extras = of_target.chain(unknown_lens(session)).chain(unknown_shape(session)).collect();
        let focal = session.camera.map_or(1.0, |c| c.fx);
        Self { extras, focal, given: session.camera, ..Self::default() }
    }

    fn is_settled(&self, fit: &JointFit) -> bool {
        let near = |e: &Extra| {
            fit.extra(e.kind).is_none_or(|(x, s)| {
                let linear = match e.kind {
                    SIZE | ExtraKind::Camera(DEPTH_SCALE) => LINEAR_SIZE,
                    ExtraKind::Camera(DEPTH_BIAS) => LINEAR_BIAS,
                    ExtraKind::Camera(n) if (LENS..LENS + 4).contains(&n) => {
                        LINEAR_LENS * self.focal
                    }
                    ExtraKind::Camera(n) if (LENS + 4..CLOCK).contains(&n) => LINEAR_DISTORTION,
                    // deviations from a shape are as good as linear
                    ExtraKind::Camera(n) if n >= PRINT => f64::INFINITY,
                    _ => 0.0,
                };
                x.abs() < SETTLED * s || x.abs() < linear
            })
        };
        self.extras.iter().all(near)
    }

    /// Moves to where the fit puts camera and depth.
    fn take(&mut self, fit: &JointFit) {
        let at = |which: usize| fit.extra(ExtraKind::Camera(which)).map_or(0.0, |x| x.0);
        self.lens += SVector::from_fn(|i, _| at(LENS + i));
        self.size = (1.0 + self.size) * (1.0 + at(TARGET_SCALE)) - 1.0;
        let (scale, bias) = (at(DEPTH_SCALE), at(DEPTH_BIAS));
        self.depth_bias_m += (1.0 + self.depth_scale) * bias;
        self.depth_scale = (1.0 + self.depth_scale) * (1.0 + scale) - 1.0;
        for extra in &mut self.extras {
            extra.prior_mean = match extra.kind {
                ExtraKind::Camera(DEPTH_SCALE) => -self.depth_scale,
                ExtraKind::Camera(DEPTH_BIAS) => -self.depth_bias_m,
                ExtraKind::Camera(TARGET_SCALE) => 1.0 / (1.0 + self.size) - 1.0,
                ExtraKind::Camera(which) if which < CLOCK => -self.lens[which - LENS],
                _ => 0.0,
            };
        }
    }

    /// The session as camera and depth are now.
    fn applied(&self, given: &Session) -> Option<Session> {
        let mut session = given.clone();
        let camera = given.camera?.moved(&self.lens);
        let target = &given.target.as_ref()?.resized(1.0 + self.size);
        camera.check().ok()?;
        session.camera = Some(camera);
        session.target = Some(target.clone());
        let from = given.camera?;
        let correct = |s: &[SurfaceCorner], corners: &[ImageCorner]| {
            let lifted = lifted_again(s, corners, &from, &camera);
            corrected(&lifted, self.depth_scale, self.depth_bias_m)
        };
        session.observations.iter_mut().for_each(|o| o.surface = correct(&o.surface, &o.corners));
        session.placements.iter_mut().for_each(|p| p.surface = correct(&p.surface, &p.corners));
        let excess = excess(&session, target, &camera);
        let posed = |corners: &[_], surface: &[_]| {
            let poses =
                detect::target_poses_with(corners, surface, target, &camera, excess).ok()?;
            Some(detect::with_symmetries(&poses, target))
        };
        for o in session.observations.iter_mut().filter(|o| !o.corners.is_empty()) {
            o.candidates = posed(&o.corners, &o.surface)?;
        }
        for p in session.placements.iter_mut().filter(|p| !p.corners.is_empty()) {
            p.candidates = posed(&p.corners, &p.surface)?;
        }
        Some(session)
    }

    /// What camera, depth and shape of the target turned out to be, where they are not as declared.
    pub(crate) fn refined(
        &self,
        session: &Session,
        fit: &JointFit,
        as_declared: Declared<f64>,
    ) -> Refined {
        let mut found = Refined::default();
        if (session.camera_from_views || as_declared.lens < 0.5)
            && self.is_free(LENS)
            && let Some(camera) = session.camera
        {
            let camera = refined_camera(&camera, fit);
            if let (Some(given), false) = (&self.given, session.camera_from_views) {
                let sigmas = [camera.sigma_fx, camera.sigma_fy, camera.sigma_cx, camera.sigma_cy];
                found.notes.note(CameraFinding::refined(given, &camera.intrinsics, sigmas));
            }
            found.camera = Some(camera);
        }
        if as_declared.shape < 0.5 {
            found.notes.add(Notes::of(shape_findings(session, fit)));
        }
        found.depth = self.depth(fit).filter(|_| as_declared.depth < 0.5);
        if let Some(DepthResult { scale, sigma_scale, bias_mm, sigma_bias_mm }) = found.depth {
            found.notes.note(CameraFinding::DepthOff {
                scale,
                sigma_scale,
                bias_mm,
                sigma_bias_mm,
            });
        }
        found
    }

    /// The depth of scans as the fit has it, where it is free.
    fn depth(&self, fit: &JointFit) -> Option<DepthResult> {
        let (s, sigma_scale) = fit.extra(ExtraKind::Camera(DEPTH_SCALE))?;
        let (b, sigma_b) = fit.extra(ExtraKind::Camera(DEPTH_BIAS))?;
        let scale = (1.0 + self.depth_scale) * (1.0 + s) - 1.0;
        let bias_mm = (self.depth_bias_m + (1.0 + self.depth_scale) * b) * 1e3;
        Some(DepthResult { scale: 1.0 + scale, sigma_scale, bias_mm, sigma_bias_mm: sigma_b * 1e3 })
    }

    fn is_free(&self, which: usize) -> bool {
        self.extras.iter().any(|e| e.kind == ExtraKind::Camera(which))
    }
}

/// The camera as the fit has it.
pub(crate) fn camera_of(camera: &Intrinsics, fit: &JointFit) -> Intrinsics {
    let at = |i: usize| fit.extra(ExtraKind::Camera(LENS + i)).map_or(0.0, |x| x.0);
    camera.moved(&SVector::from_fn(|i, _| at(i)))
}

/// The same, with its uncertainty.
fn refined_camera(camera: &Intrinsics, fit: &JointFit) -> CameraResult {
    let at = |i: usize| fit.extra(ExtraKind::Camera(LENS + i)).unwrap_or((0.0, 0.0));
    let sigma = |i: usize| at(i).1;
    let share = camera.fy / camera.fx;
    let both = covariance(fit, LENS, LENS + 1);
    let fy = (share * sigma(0)).powi(2) + sigma(1).powi(2) + 2.0 * share * both;
    CameraResult {
        intrinsics: camera_of(camera, fit),
        sigma_fx: sigma(0),
        sigma_fy: fy.max(0.0).sqrt(),
        sigma_cx: sigma(2),
        sigma_cy: sigma(3),
    }
}

/// Covariance of two parameters; zero where one of them is not free.
fn covariance(fit: &JointFit, a: usize, b: usize) -> f64 {
    let row = |which| {
        let k = fit.extras.iter().position(|e| e.kind == ExtraKind::Camera(which))?;
        Some(12 + k)
    };
    let both = fit.covariance.as_ref().zip(row(a).zip(row(b)));
    both.map_or(0.0, |(c, at)| c[at])
}

/// Deviations of a shape that are this many standard deviations long are told.
const CLEARLY: f64 = 3.0;

/// In which way the target is not as its description has it.
fn shape_findings(session: &Session, fit: &JointFit) -> Vec<TargetFinding> {
    let Some(target) = &session.target else { return vec![] };
    let at = |k: usize| fit.extra(ExtraKind::Camera(PRINT + k));
    let mut all = vec![];
    if let Some((share, sigma)) = at(0).filter(|(x, s)| x.abs() > CLEARLY * s) {
        all.push(TargetFinding::Uneven { share, sigma });
    }
    let values: Vec<(f64, f64)> = (1..SHAPES).filter_map(at).collect();
    let scanned = session.observations.iter().any(|o| !o.surface.is_empty());
    // scans tell it directly, and have a word of their own for it
    if values.iter().any(|(x, s)| x.abs() > CLEARLY * s) && values.len() + 1 == SHAPES && !scanned {
        let middle = target.middle().vector();
        let height = |c: &crate::Point<Target>| {
            let by = by_shape(&c.vector(), &middle);
            (1..SHAPES).map(|k| by[(2, k)] * values[k - 1].0).sum::<f64>() * 1e3
        };
        let heights: Vec<f64> = target.corners().iter().map(height).collect();
        let most = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = heights.iter().copied().fold(f64::INFINITY, f64::min);
        all.push(TargetFinding::Bent { peak_to_valley_mm: most - least });
    }
    all
}

/// What lens model and print typically leave in a corner, px.
pub(crate) fn excess(session: &Session, target: &TargetModel, camera: &Intrinsics) -> Option<f64> {
    let pictures = session.observations.iter().map(|o| (&o.corners[..], &o.candidates[..]));
    let placed = session.placements.iter().map(|p| (&p.corners[..], &p.candidates[..]));
    let all = pictures.chain(placed).filter(|(corners, _)| !corners.is_empty());
    detect::typical_excess_near(all, target, camera)
}

/// The views, each with what its corners know of camera and depth.
pub(crate) fn with_sights(views: &Views) -> Vec<View> {
    let (Some(target), Some(camera)) = (&views.session.target, &views.session.camera) else {
        return views.views.clone();
    };
    let excess = excess(views.session, target, camera);
    let one = |(o, v): (&&Observation, &View)| {
        let own = views::own_pose(v, views);
        let map = residuals::relabelling(o, &own, target);
        let sight = sight_of(o, &map, target, camera, excess, &own);
        let carry = crate::math::lie::adjoint(views.target_from_corner.inverse().iso());
        View { sight: sight.map(|s| s.carried(&carry).into()), ..v.clone() }
    };
    views.used.iter().zip(&views.views).map(one).collect()
}

fn sight_of(
    o: &Observation,
    map: &[u32],
    target: &TargetModel,
    camera: &Intrinsics,
    excess: Option<f64>,
    pose: &Pose<Camera, Target>,
) -> Option<Sight> {
    let corners = detect::relabelled(&o.corners, map);
    let renamed = |c: &SurfaceCorner| Some(SurfaceCorner { id: *map.get(c.id as usize)?, ..*c });
    let surface: Vec<SurfaceCorner> = o.surface.iter().filter_map(renamed).collect();
    detect::sighted(&corners, &surface, target, camera, excess, pose).map(|(_, sight)| sight)
}

/// What the image of a placement knows of camera and depth.
pub(crate) fn sight_of_placement(
    session: &Session,
    excess: Option<f64>,
    corners: &[crate::ImageCorner],
    surface: &[SurfaceCorner],
    pose: &Pose<Camera, Target>,
) -> Option<Sight> {
    let (target, camera) = (session.target.as_ref()?, session.camera.as_ref()?);
    detect::sighted(corners, surface, target, camera, excess, pose).map(|(_, sight)| sight)
}

/// Step of the numerical derivative by a lens parameter, as part of its standard deviation.
const DERIVATIVE_STEP: f64 = 1e-2;

/// Share of the points that are measured by another lens, or depth, than the answer was found with, for the
/// probability that these are as declared: none where they surely are, and all where that is open. Where another one was
/// found, it stands in the result to be used; but who knows by what the points will be measured?
fn elsewhere(as_declared: f64) -> f64 {
    const OPEN: f64 = 0.15;
    ((1.0 - as_declared) / OPEN).min(1.0)
}

/// By what the points are measured that the answer is for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeasuredBy {
    /// All distances are in one unknown unit, which points in the camera then share.
    pub unit_is_free: bool,
    /// Probabilities that lens and depth are as declared, and the points will be measured by just these.
    pub as_declared: Declared<f64>,
}

/// Covariance (m²), in camera axes, of where a point of the camera lands, for a covariance of `X`,
/// `Y` and the extras. What images locate moves with the lens: a point keeps its pixel, and its
/// distance follows its size in the image. What scans locate moves with their depth, and all with
/// the unit of distances where that is free (the size of the calibration target is not the unit of
/// what is measured later). These errors go along with that of `X`, as do `more`:
/// numbers of unknowns, and how the point moves with them.
pub(crate) fn spread(
    (views, measured): (&Views, MeasuredBy),
    extras: &[Extra],
    covariance: &DMatrix<f64>,
    p: &Vector3<f64>,
    mut more: Vec<(usize, Vector3<f64>)>,
) -> Option<Matrix3<f64>> {
    let scanned = views.session.observations.iter().any(|o| !o.surface.is_empty());
    let camera = views.session.camera.as_ref();
    let moves = |which: usize| match which {
        TARGET_SCALE => measured.unit_is_free,
        which if which >= CLOCK => false,
        other => scanned == (other < LENS),
    };
    let mut of_camera = vec![];
    for (k, extra) in extras.iter().enumerate() {
        let ExtraKind::Camera(which) = extra.kind else { continue };
        if !moves(which) {
            continue;
        }
        let sigma = covariance[(12 + k, 12 + k)].sqrt();
        let column = match which {
            TARGET_SCALE => *p,
            DEPTH_SCALE => -p,
            DEPTH_BIAS => -p / p.z,
            lens => camera.and_then(|c| by_lens(c, p, lens - LENS, sigma)).unwrap_or_default(),
        };
        if which == TARGET_SCALE { &mut more } else { &mut of_camera }.push((12 + k, column));
    }
    let own: Matrix6<f64> = covariance.fixed_view::<6, 6>(0, 0).into_owned();
    let j = point_jacobian(p);
    let with = |free: &[(usize, Vector3<f64>)]| {
        let mut s = j * own * j.transpose();
        for (k, by_k) in free {
            let cross: Vector6<f64> = covariance.fixed_view::<6, 1>(0, *k).into_owned();
            let mixed = j * cross * by_k.transpose();
            s += mixed + mixed.transpose();
            for (l, by_l) in free {
                s += by_k * by_l.transpose() * covariance[(*k, *l)];
            }
        }
        s
    };
    // a point that does not come from this very camera has no error in common with the answer
    let (located, known) = (with(&[&more[..], &of_camera[..]].concat()), with(&more));
    let far = if known.trace() > located.trace() { known } else { located };
    let own = if scanned { measured.as_declared.depth } else { measured.as_declared.lens };
    let doubt = elsewhere(own);
    let s = located * (1.0 - doubt) + far * doubt;
    s.iter().all(|x| x.is_finite()).then_some(s)
}

/// Whether a point of the camera lies in its image.
pub(crate) fn in_picture(camera: &Intrinsics, p: &Vector3<f64>) -> bool {
    let inside = |x: f64, size: u32| (-0.5..=f64::from(size) - 0.5).contains(&x);
    let known = camera.width > 0 && camera.height > 0;
    let seen = |u: Vector2<f64>| !known || inside(u.x, camera.width) && inside(u.y, camera.height);
    camera.project(p).filter(|u| seen(*u)).is_some_and(|u| comes_from(camera, &u, p))
}

/// A pixel's ray that misses a point by more (rad) is another one: beyond the corners that told the distortion, its
/// polynomial may fold far directions back into the image.
const SAME_RAY: f64 = 1e-3;

/// Whether a pixel's ray leads to the point.
fn comes_from(camera: &Intrinsics, pixel: &Vector2<f64>, p: &Vector3<f64>) -> bool {
    camera.ray(pixel).is_some_and(|ray| ray.angle(p) < SAME_RAY)
}

/// How a point of the camera moves with one parameter of the lens, its pixel and its size in the
/// image being what they are.
fn by_lens(
    camera: &Intrinsics,
    p: &Vector3<f64>,
    which: usize,
    sigma: f64,
) -> Option<Vector3<f64>> {
    let pixel = camera.project(p).filter(|_| in_picture(camera, p))?;
    let step = DERIVATIVE_STEP * sigma;
    let size = |c: &Intrinsics, n: &Vector2<f64>| {
        (c.fx * c.fy * c.distort(n).1.determinant()).abs().sqrt()
    };
    let here = size(camera, &Vector2::new(p.x / p.z, p.y / p.z));
    let seen = |by: f64| {
        let mut d = SVector::<f64, PARAMETERS>::zeros();
        d[which] = by;
        let other = camera.moved(&d);
        let n = other.undistort(&pixel)?;
        Some(n.push(1.0) * (p.z * size(&other, &n) / here))
    };
    Some((seen(step)? - seen(-step)?) / (2.0 * step))
}
