//! Sessions as bare pose pairs, and plain least squares over them, which answers are compared with.

use handeye::{
    Camera, HandEye, Observation, Pose, PosePair, Session, Target, TargetPose, solve::least_squares,
};
use nalgebra::{DMatrix, DVector, Vector6};

/// The session as pose pairs from elsewhere: where `seen` has the target, and nothing else of the images.
pub fn as_pairs(
    session: &Session,
    seen: impl Fn(&Observation) -> Option<Pose<Camera, Target>>,
) -> Session {
    let bare = |o: &Observation| {
        let seen = TargetPose { camera_from_target: seen(o)?, covariance: None };
        Some(Observation { corners: vec![], surface: vec![], candidates: vec![seen], ..o.clone() })
    };
    Session {
        target: None,
        camera: None,
        observations: session.observations.iter().filter_map(bare).collect(),
        ..session.clone()
    }
}

/// Least squares of the residual, rotations weighted by `lever`.
pub fn fitted(pairs: &[PosePair], start: &HandEye, lever: f64) -> HandEye {
    let mut at = *start;
    let residual = |h: &HandEye| {
        let one = |p: &PosePair| {
            let mut r = least_squares::residual(h, p);
            r.fixed_rows_mut::<3>(0).scale_mut(lever);
            r
        };
        DVector::from_iterator(
            6 * pairs.len(),
            pairs.iter().flat_map(|p| one(p).iter().copied().collect::<Vec<_>>()),
        )
    };
    let moved = |h: &HandEye, d: &DVector<f64>| HandEye {
        mount_from_camera: h.mount_from_camera.retract(&Vector6::from_fn(|i, _| d[i])),
        anchor_from_target: h.anchor_from_target.retract(&Vector6::from_fn(|i, _| d[6 + i])),
    };
    for _ in 0..8 {
        let r = residual(&at);
        let mut j = DMatrix::zeros(r.len(), 12);
        for k in 0..12 {
            let mut d = DVector::zeros(12);
            d[k] = 1e-6;
            let plus = residual(&moved(&at, &d));
            d[k] = -1e-6;
            j.set_column(k, &((plus - residual(&moved(&at, &d))) / 2e-6));
        }
        let h = j.tr_mul(&j);
        let Some(c) = h.cholesky() else { break };
        at = moved(&at, &-c.solve(&j.tr_mul(&r)));
    }
    at
}
