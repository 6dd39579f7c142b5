//! Candidates that rest on the touches alone: touched corners registered to those that the camera saw.

use nalgebra::Matrix6;

use super::judge::{Judge, Judged};
use crate::{
    Error, HandEye,
    calibrate::{
        flow::{
            config::Config,
            evidence::RestsOn,
            notes::Notes,
            views::{Views, pairs_of},
        },
        prediction::answers::stored,
        result::{Answer, Candidate, PoseCovariance, rows},
    },
    estimate::{
        JointFit, evaluate,
        touch_pairs::{self, Registration, TouchPairs},
    },
    findings::TouchFinding,
    solve::{self, View},
};

impl Judge<'_> {
    pub(super) fn touch_candidates(&self, fit: &JointFit, config: &Config) -> (Vec<Judged>, Notes) {
        if self.paired.is_empty() || config.method.is_some() {
            return <_>::default();
        }
        let kinds =
            [("two-step-svd", Registration::Svd), ("two-step-icp", Registration::Icp(config.icp))];
        let (mut all, mut notes) = (vec![], Notes::default());
        for (name, registration) in kinds {
            match self.touch_candidate(fit, name, registration) {
                Ok(judged) => all.push(judged),
                Err(error) => {
                    let (candidate, error) = (name.to_owned(), error.to_string());
                    notes.note(TouchFinding::NotEnough { candidate, error });
                }
            }
        }
        (all, notes)
    }

    fn touch_candidate(
        &self,
        fit: &JointFit,
        name: &str,
        registration: Registration,
    ) -> Result<Judged, Error> {
        let (views, paired) = (self.views, self.paired);
        let all: Vec<&TouchPairs> = paired.iter().collect();
        let start = fit.hand_eye.mount_from_camera;
        let found = touch_pairs::fit_touches(&all, &start, registration)?;
        let x = found.mount_from_camera;
        let shared = touch_pairs::view_covariance(paired, &view_noise(views, fit));
        let covariance =
            found.covariance.map(|c| self.of_camera(c + shared.unwrap_or_else(Matrix6::zeros), &x));
        // nearest neighbours that differ from the touched corners prove the match wrong
        let predicted = self.workpiece.predicted_rms_mm(&x);
        let placed = solve::place_target(&pairs_of(views), &x);
        let held_out = evaluate::placed_without(&views.views, &x);
        let candidate = Candidate {
            name: name.into(),
            hand_eye: stored_registration(views, fit, &placed, covariance.as_ref()),
            in_sample: evaluate::in_sample(&placed, &views.views),
            held_out: evaluate::rms(&held_out),
            touch_rms_mm: touch_pairs::touch_rms(paired, &x).map(|m| m * 1e3),
            held_out_mm: touch_pairs::held_out(paired, &start, registration).map(|m| m * 1e3),
            predicted_tre_mm: predicted.filter(|_| found.wrong_matches == 0),
            note: registration_note(&found),
        };
        Ok(Judged { rests_on: RestsOn::Touches, candidate, held_out, seen: None })
    }
}

fn registration_note(found: &touch_pairs::TouchFit) -> Option<String> {
    match found.stop {
        Some((rounds, stop)) => Some(format!(
            "{rounds} iterations, {stop:?}; {} of the matches are other corners than were touched",
            found.wrong_matches
        )),
        None if found.covariance.is_none() => {
            Some("three touches leave nothing to judge their error by; touch more".into())
        }
        None => None,
    }
}

/// A registration of touches and the target's place that follows. With `Y_i = A_i X C_i` averaged
/// over the views, `cov(Y) = J cov(X) Jᵀ + Σ S_i/N²`, `J = Σ Ad(C_i⁻¹)/N`, and `S_i` the noise of
/// one view.
pub(super) fn stored_registration(
    views: &Views,
    fit: &JointFit,
    placed: &HandEye,
    covariance: Option<&Matrix6<f64>>,
) -> Answer {
    let n = views.views.len() as f64;
    let carry = |v: &View| crate::math::lie::adjoint(v.pair.camera_from_target.inverse().iso());
    let j = views.views.iter().map(carry).sum::<Matrix6<f64>>() / n;
    let setup = views.session.setup;
    let noise = |v: &View| fit.noise.covariance(v, &fit.hand_eye, setup);
    let own = views.views.iter().map(noise).sum::<Matrix6<f64>>() / (n * n);
    let to_origin = crate::math::lie::adjoint(views.target_from_corner.iso());
    let place =
        |x: &Matrix6<f64>| to_origin * (j * x * j.transpose() + own) * to_origin.transpose();
    Answer {
        covariance: PoseCovariance {
            mount_from_camera: covariance.map(rows),
            anchor_from_target: covariance.map(|x| rows(&place(x))),
        },
        ..stored(views, placed, None)
    }
}

/// Noise of every view as the touches see it.
fn view_noise(views: &Views, fit: &JointFit) -> Vec<touch_pairs::ViewNoise> {
    let one = |v: &View| touch_pairs::ViewNoise {
        camera_from_target: v.pair.camera_from_target.rotation(),
        covariance: fit.noise.covariance(v, &fit.hand_eye, views.session.setup),
    };
    views.views.iter().map(one).collect()
}
