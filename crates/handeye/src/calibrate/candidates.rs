//! Every way to the answer, side by side, and the choice between them.

use nalgebra::{Matrix6, Vector3};

use super::{Config, agreement::Views, captures, verdict};
use crate::{
    Camera, Error, HandEye, Mount, Pose, PosePair, Setup, Target, Warning, Workspace,
    calibration::{Answer, Calibration, Candidate, Misfit, PoseCovariance, rows},
    diagnose,
    evaluate::{self, Estimator},
    predict::{self, Volume},
    refine::{self, PoseFit},
    solve::{self, Method, consensus::Consensus},
    touches::{self, Registration, TouchPairs},
};

/// Makes and judges all candidates, chooses one, and reports the touches.
pub(super) fn estimate<'a>(
    mut views: Views<'a>,
    found: &Consensus,
    config: &Config,
    result: &mut Calibration,
) -> Option<Views<'a>> {
    let setup = views.session.setup;
    result.diversity = Some(evaluate::diversity(&pairs_of(&views)));
    let mut fit =
        match refine::fit_estimating_noise(&views.views, &found.hand_eye, &config.known, setup) {
            Ok(fit) => fit,
            Err(error) => {
                result.reasons.push(error.to_string());
                result
                    .undetermined
                    .push(format!("the pose of the camera on the {}", setup.mount()));
                return None;
            }
        };
    captures::orient_target(&mut views, &mut fit);
    result.undetermined = diagnose::undetermined(&fit, setup);
    result.error_budget = verdict::budget(&fit);
    verdict::judge_scale(&views, &fit, config, result);
    let covariance = stated_covariance(&fit);
    let volume = volume(&views, &fit)?;
    let paired = captures::pair_touches(&views, &fit, result);
    let mut candidates = view_candidates(&views, &fit, &covariance, &volume, &paired, config);
    candidates.extend(touch_candidates(&views, &fit, &volume, &paired, config, result));
    if let Some((posterior, touched)) = fit_covariances(&covariance, &candidates) {
        compare_sources(&candidates, &posterior, &touched, result);
    }
    choose(candidates, &views, &volume, config, result);
    captures::report_touches(&views, &paired, result);
    Some(views)
}

/// A candidate with what its choice needs.
struct Judged {
    candidate: Candidate,
    mount_from_camera: Pose<Mount, Camera>,
    tre: Option<predict::PredictedTre>,
    covariance: Option<Matrix6<f64>>,
    /// Misfit of each capture when it was left out.
    held_out: Vec<Option<(f64, f64)>>,
}

/// Covariance of X and Y in their own frames, widened for noise estimated from few captures, and
/// for data that fit worse than their noise says.
fn stated_covariance(fit: &PoseFit) -> Option<refine::pose_fit::Matrix12> {
    let dof = fit.degrees_of_freedom;
    let misfit = if dof > 0.0 { (fit.chi_squared / dof).max(1.0) } else { 1.0 };
    fit.covariance.map(|c| c * (misfit * touches::small_sample(dof)))
}

fn blocks(covariance: &refine::pose_fit::Matrix12) -> (Matrix6<f64>, Matrix6<f64>) {
    (
        covariance.fixed_view::<6, 6>(0, 0).into_owned(),
        covariance.fixed_view::<6, 6>(6, 6).into_owned(),
    )
}

fn view_candidates(
    views: &Views,
    fit: &PoseFit,
    covariance: &Option<refine::pose_fit::Matrix12>,
    volume: &Volume,
    paired: &[TouchPairs],
    config: &Config,
) -> Vec<Judged> {
    let mut all: Vec<(String, Estimator)> = Method::ALL
        .into_iter()
        .map(|m| (format!("closed-form-{}", m.name()), Estimator::ClosedForm(m)))
        .collect();
    all.push(("least-squares".into(), Estimator::LeastSquares));
    all.push(("maximum-likelihood".into(), Estimator::MaximumLikelihood(config.known)));
    if let Some(method) = config.method {
        all.retain(|(_, e)| *e == Estimator::ClosedForm(method));
    }
    all.into_iter()
        .filter_map(|(name, estimator)| {
            view_candidate(views, fit, covariance, volume, paired, name, &estimator)
        })
        .collect()
}

/// One candidate from views alone. Its predicted error is that of the most likely answer plus, in
/// full, the distance of the two: given the views, that is its expected error.
fn view_candidate(
    views: &Views,
    fit: &PoseFit,
    covariance: &Option<refine::pose_fit::Matrix12>,
    volume: &Volume,
    paired: &[TouchPairs],
    name: String,
    estimator: &Estimator,
) -> Option<Judged> {
    let setup = views.session.setup;
    let answer = match estimator {
        Estimator::MaximumLikelihood(_) => fit.hand_eye,
        other => other.estimate(&views.views, &fit.hand_eye, setup).ok()?,
    };
    let x = answer.mount_from_camera;
    let tre = covariance.as_ref().map(|c| {
        predict::tre(volume, &blocks(c).0, predict::difference(&fit.hand_eye.mount_from_camera, &x))
    });
    let left_out = evaluate::held_out(estimator, &views.views, &fit.hand_eye, setup);
    let held_out = evaluate::rms(&left_out);
    let touch_rms = touches::touch_rms(paired, &x).map(|m| m * 1e3);
    let candidate = Candidate {
        name,
        hand_eye: stored(views, &answer, covariance.as_ref()),
        in_sample: evaluate::in_sample(&answer, &views.views),
        held_out,
        touch_rms_mm: touch_rms,
        held_out_mm: touch_rms.or(held_out.translation_rms_mm),
        predicted_tre_mm: tre.as_ref().map(|t| t.rms),
        note: None,
    };
    let covariance = covariance.as_ref().map(|c| blocks(c).0);
    Some(Judged { candidate, mount_from_camera: x, tre, covariance, held_out: left_out })
}

/// The answer for files: about the target's own origin again.
fn stored(
    views: &Views,
    answer: &HandEye,
    covariance: Option<&refine::pose_fit::Matrix12>,
) -> Answer {
    let carry = crate::lie::adjoint(views.target_from_corner.iso());
    let moved = answer.retarget(views.target_from_corner.inverse());
    Answer {
        mount_from_camera: Some(moved.mount_from_camera),
        anchor_from_target: Some(moved.anchor_from_target),
        covariance: PoseCovariance {
            mount_from_camera: covariance.map(|c| rows(&blocks(c).0)),
            anchor_from_target: covariance
                .map(|c| rows(&(carry * blocks(c).1 * carry.transpose()))),
        },
    }
}

fn touch_candidates(
    views: &Views,
    fit: &PoseFit,
    volume: &Volume,
    paired: &[TouchPairs],
    config: &Config,
    result: &mut Calibration,
) -> Vec<Judged> {
    if paired.is_empty() || config.method.is_some() {
        return vec![];
    }
    let kinds =
        [("two-step-svd", Registration::Svd), ("two-step-icp", Registration::Icp(config.icp))];
    let mut all = Vec::new();
    for (name, registration) in kinds {
        match touch_candidate(views, fit, volume, paired, name, registration) {
            Ok(mut judged) => {
                let placed = solve::place_target(&pairs_of(views), &judged.mount_from_camera);
                judged.candidate.in_sample = evaluate::in_sample(&placed, &views.views);
                judged.held_out = evaluate::placed_without(&views.views, &judged.mount_from_camera);
                judged.candidate.held_out = evaluate::rms(&judged.held_out);
                place_target(views, fit, &placed, &mut judged);
                all.push(judged);
            }
            Err(error) => result
                .warnings
                .push(Warning::new("touches-not-enough", format!("no {name} candidate: {error}"))),
        }
    }
    all
}

/// Adds the target's place to a registration of touches. With `Y_i = A_i X C_i` averaged over the
/// views, `cov(Y) = J cov(X) Jᵀ + Σ S_i/N²`, `J = Σ Ad(C_i⁻¹)/N`, and `S_i` the noise of one view.
fn place_target(views: &Views, fit: &PoseFit, placed: &HandEye, judged: &mut Judged) {
    let n = views.views.len() as f64;
    let carry = |v: &refine::View| crate::lie::adjoint(v.pair.camera_from_target.inverse().iso());
    let j = views.views.iter().map(carry).sum::<Matrix6<f64>>() / n;
    let setup = views.session.setup;
    let noise = |v: &refine::View| fit.noise.covariance(v, &fit.hand_eye, setup);
    let own = views.views.iter().map(noise).sum::<Matrix6<f64>>() / (n * n);
    let to_origin = crate::lie::adjoint(views.target_from_corner.iso());
    let answer = &mut judged.candidate.hand_eye;
    answer.anchor_from_target = stored(views, placed, None).anchor_from_target;
    answer.covariance.anchor_from_target = judged
        .covariance
        .map(|x| rows(&(to_origin * (j * x * j.transpose() + own) * to_origin.transpose())));
}

fn pairs_of(views: &Views) -> Vec<PosePair> {
    views.views.iter().map(|v| v.pair).collect()
}

/// Noise of every view as the touches see it.
fn view_noise(views: &Views, fit: &PoseFit) -> Vec<touches::ViewNoise> {
    let one = |v: &refine::View| touches::ViewNoise {
        camera_from_target: v.pair.camera_from_target.rotation(),
        covariance: fit.noise.covariance(v, &fit.hand_eye, views.session.setup),
    };
    views.views.iter().map(one).collect()
}

fn touch_candidate(
    views: &Views,
    fit: &PoseFit,
    volume: &Volume,
    paired: &[TouchPairs],
    name: &str,
    registration: Registration,
) -> Result<Judged, Error> {
    let all: Vec<&TouchPairs> = paired.iter().collect();
    let start = fit.hand_eye.mount_from_camera;
    let found = touches::fit_touches(&all, &start, registration)?;
    let x = found.mount_from_camera;
    let shared = touches::view_covariance(paired, &view_noise(views, fit));
    let covariance = found.covariance.map(|c| c + shared.unwrap_or_else(Matrix6::zeros));
    let tre = covariance.map(|c| predict::tre(volume, &c, |_| Vector3::zeros()));
    let wrong = found.wrong_matches;
    let note = match (registration, found.stop) {
        (Registration::Icp(_), Some((rounds, stop))) => Some(format!(
            "{rounds} iterations, {stop:?}; {} of the matches are other corners than were touched",
            wrong
        )),
        _ if found.covariance.is_none() => {
            Some("three touches leave nothing to judge their error by; touch more".into())
        }
        _ => None,
    };
    // nearest neighbours that differ from the touched corners prove the match wrong
    let usable = wrong == 0;
    Ok(Judged {
        candidate: Candidate {
            name: name.into(),
            hand_eye: Answer {
                mount_from_camera: Some(x),
                anchor_from_target: None,
                covariance: PoseCovariance {
                    mount_from_camera: covariance.as_ref().map(rows),
                    anchor_from_target: None,
                },
            },
            in_sample: Misfit::default(),
            held_out: Misfit::default(),
            touch_rms_mm: touches::touch_rms(paired, &x).map(|m| m * 1e3),
            held_out_mm: touches::held_out(paired, &start, registration).map(|m| m * 1e3),
            predicted_tre_mm: tre.as_ref().filter(|_| usable).map(|t| t.rms),
            note,
        },
        mount_from_camera: x,
        tre: tre.filter(|_| usable),
        covariance,
        held_out: vec![],
    })
}

fn fit_covariances(
    covariance: &Option<refine::pose_fit::Matrix12>,
    candidates: &[Judged],
) -> Option<(Matrix6<f64>, Matrix6<f64>)> {
    let touch = candidates.iter().find(|c| c.candidate.name == "two-step-svd")?.covariance?;
    Some((blocks(covariance.as_ref()?).0, touch))
}

/// Chance of a disagreement between views and touches below which it is called systematic.
const CONFLICT: f64 = 0.001;

fn compare_sources(
    candidates: &[Judged],
    views: &Matrix6<f64>,
    touched: &Matrix6<f64>,
    result: &mut Calibration,
) {
    let of = |name: &str| candidates.iter().find(|c| c.candidate.name == name);
    let (Some(a), Some(b)) = (of("maximum-likelihood"), of("two-step-svd")) else { return };
    let found =
        touches::consistency((&a.mount_from_camera, views), (&b.mount_from_camera, touched));
    let Some((_, p)) = found else { return };
    if p < CONFLICT {
        let gap = a.candidate.touch_rms_mm.unwrap_or(f64::NAN);
        result.warnings.push(Warning::new(
            "views-and-touches-disagree",
            format!(
                "views and touches disagree: the touched corners lie {gap:.2} mm (RMS) from where \
                 the views put them, p = {p:.1e}; check the tool tip first, then the robot's \
                 calibration"
            ),
        ));
    }
}

/// The least predicted error wins; the residual has no say.
fn choose(
    candidates: Vec<Judged>,
    views: &Views,
    volume: &Volume,
    config: &Config,
    result: &mut Calibration,
) {
    let best = candidates.iter().filter(|c| c.tre.is_some()).min_by(|a, b| by_prediction(a, b)).or(
        candidates
            .iter()
            .rfind(|c| config.method.is_none() || c.candidate.name.starts_with("closed")),
    );
    if let Some(best) = best {
        result.method = best.candidate.name.clone();
        result.chosen = Some(best.candidate.name.clone());
        result.why = why(best, &candidates, volume, config);
        result.hand_eye = best.candidate.hand_eye;
        result.predicted_tre_mm = best.tre.clone();
        result.residual = best.candidate.in_sample;
        result.held_out = best.candidate.held_out;
        for (&i, left_out) in views.indices.iter().zip(&best.held_out) {
            result.captures[i].held_out_deg = left_out.map(|h| h.0.to_degrees());
            result.captures[i].held_out_mm = left_out.map(|h| h.1 * 1e3);
        }
    }
    result.candidates = candidates.into_iter().map(|c| c.candidate).collect();
}

fn by_prediction(a: &Judged, b: &Judged) -> std::cmp::Ordering {
    let rms = |c: &Judged| c.tre.as_ref().map_or(f64::INFINITY, |t| t.rms);
    rms(a).total_cmp(&rms(b))
}

fn why(best: &Judged, all: &[Judged], volume: &Volume, config: &Config) -> String {
    if let Some(method) = config.method {
        return format!("{} was asked for by name", method.name());
    }
    let Some(tre) = &best.tre else { return "no candidate has a predicted error".into() };
    let others: Vec<String> = all
        .iter()
        .filter(|c| c.candidate.name != best.candidate.name)
        .filter_map(|c| Some(format!("{} {:.2} mm", c.candidate.name, c.tre.as_ref()?.rms)))
        .collect();
    format!(
        "{} has the least predicted error in {}: {:.2} mm (the others: {})",
        best.candidate.name,
        volume.name,
        tre.rms,
        others.join(", ")
    )
}

/// Where the answer will be used, in the camera frame.
fn volume(views: &Views, fit: &PoseFit) -> Option<Volume> {
    if let Some(w) = &views.session.workspace {
        return Some(workspace_volume(views.session.setup, w, &fit.hand_eye.mount_from_camera));
    }
    let Some(target) = &views.session.target else {
        let origin = [crate::Point::new(0.0, 0.0, 0.0)];
        let name = "the box around the target's origin in all poses";
        return diagnose::seen_volume(&pairs_of(views), &origin, name);
    };
    let corners: Vec<crate::Point<Target>> =
        target.corners().iter().map(|c| views.target_from_corner.inverse() * *c).collect();
    diagnose::seen_volume(&pairs_of(views), &corners, "the box in which the camera saw the target")
}

pub(super) fn workspace_volume(setup: Setup, w: &Workspace, x: &Pose<Mount, Camera>) -> Volume {
    let volume = Volume::of_box(&w.minimum, &w.maximum, "the workspace box of the manifest");
    match setup {
        Setup::EyeInHand => volume, // declared in the camera frame
        Setup::EyeToHand => {
            let camera_from_mount = x.iso().inverse();
            volume.map(|p| {
                camera_from_mount.transform_vector(p) + camera_from_mount.translation.vector
            })
        }
    }
}
