//! The rigid answer for an arm that is not as its model says, where nothing tells how the tool is held: the one that fits
//! best where the captures are ([`crate::estimate::projection`]).

use nalgebra::{DMatrix, Matrix3, Matrix6, Vector3};

use super::{arm::ArmFit, place};
use crate::{
    Camera, Mount, Pose, Setup,
    calibrate::{flow::views::Views, prediction::reach::Reach},
    estimate::{ExtraKind, projection::Projection},
    register::rigid_fit::point_jacobian,
};

/// The answer, and what the robot misses with it.
pub(crate) struct BestRigid {
    projection: Projection,
    /// Where the deviations stand among the extras.
    deviations: Vec<usize>,
    x: Pose<Mount, Camera>,
    /// Variance per axis (m²) of what the robot misses at one pose.
    missed: f64,
    setup: Setup,
}

impl BestRigid {
    /// `None` where the captures do not determine it.
    pub(crate) fn new(views: &Views, arm: &ArmFit) -> Option<Self> {
        let (fit, metric) = (&arm.fit, place::metric(views));
        let number = |k: usize| match fit.extras[k].kind {
            ExtraKind::Arm(which) => Some(which),
            _ => None,
        };
        let deviations: Vec<usize> =
            (0..fit.extras.len()).filter(|&k| number(k).is_some()).collect();
        let (mut values, whole) = (fit.values.clone(), arm.values());
        for &k in &deviations {
            values[k] = number(k).and_then(|which| whole.get(which)).copied().unwrap_or(values[k]);
        }
        let projection = Projection::new(
            (&arm.problem, fit),
            &values,
            &metric,
            &place::work(views, &fit.hand_eye),
        )?;
        let missed = projection.missed_once(fit, &metric);
        let (x, setup) = (fit.hand_eye.mount_from_camera, views.session.setup);
        Some(Self { projection, deviations, x, missed, setup })
    }
}

impl Reach for BestRigid {
    fn shift(&self, p: &Vector3<f64>) -> Vector3<f64> {
        point_jacobian(p) * self.projection.step.fixed_rows::<6>(0)
    }

    fn scatter(&self, p: &Vector3<f64>) -> Matrix3<f64> {
        let j = point_jacobian(p);
        let sampling = self.projection.sampling.fixed_view::<6, 6>(0, 0);
        j * sampling * j.transpose()
            + Matrix3::identity() * (place::poses(self.setup) * self.missed)
    }

    fn share_of_noise(&self) -> f64 {
        1.0
    }

    fn by_unknowns(&self, p: &Vector3<f64>) -> Vec<(usize, Vector3<f64>)> {
        let by = point_jacobian(p) * self.projection.carry.fixed_rows::<6>(0);
        self.deviations.iter().map(|&k| (12 + k, by.column(k).into_owned())).collect()
    }

    fn rigid(&self, covariance: &DMatrix<f64>) -> Option<(Pose<Mount, Camera>, Matrix6<f64>)> {
        let x = self.x.retract(&self.projection.step.fixed_rows::<6>(0).into_owned());
        Some((x, self.projection.covariance(covariance).fixed_view::<6, 6>(0, 0).into()))
    }
}
