//! An alignment brought to an end over all windows, and what speaks against it.

use crate::{
    Error, Verdict,
    register::{
        DenseConfig, DenseMethod, Size, Stop, Surface,
        descent::{Descent, Reached},
        freedom::Freedom,
        rivals::{Opinions, Rival},
    },
};
use nalgebra::{Isometry3, Matrix6};

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
pub(crate) const ASKED: f64 = 5000.0;

/// With less agreement, something is wrong.
pub(crate) const AGREEING: f64 = 0.9;

/// Shifts and turns.
pub(crate) const ALL_MOTIONS: usize = 6;

/// With fewer matches, nothing is sure.
pub(crate) const OVERLAPPING: f64 = 0.05;

/// An answer over all windows; along motions that the common surface leaves free it stays where it is `held`.
pub(crate) fn refined(
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
pub(crate) fn stuck(config: &DenseConfig) -> String {
    let other = match config.method {
        DenseMethod::Symmetric => "",
        _ => "use `--method symmetric`, or ",
    };
    let start =
        if config.global { "scans with more shape in common" } else { "a better `--initial`" };
    format!(
        "registration converged to a local minimum, in which the correspondences determine less than they scatter: \
         {other}give {start}"
    )
}

/// What speaks against an answer.
pub(crate) fn add_reasons(found: &mut Dense, source: &Surface, rivals: &[Rival]) {
    if let [best, others @ ..] = rivals
        && !others.is_empty()
        && found.undetermined.is_empty()
    {
        let away = |r: &Rival| {
            source.moved(&r.reached.target_from_source, &best.reached.target_from_source)
        };
        let nearest = others.iter().map(away).fold(f64::INFINITY, f64::min);
        found.reasons.push(format!(
            "the scans fit equally well in {} other {}, the nearest {:.0} mm away: give a better `--initial`, or \
             scans whose overlap has more 3D shape",
            others.len(),
            if others.len() == 1 { "pose" } else { "poses" },
            1e3 * nearest
        ));
    }
    if found.stop == Stop::MaxIterations {
        found.reasons.push(format!(
            "no convergence after {} iterations: increase `--max-iterations`, or give a better `--initial`",
            found.iterations
        ));
    }
    if found.agreement < AGREEING {
        found.reasons.push(format!(
            "the aligned scans contradict each other in {:.0} % of their overlap (occlusion test): the initial guess is too far \
             off, or the scene changed between the scans",
            100.0 * (1.0 - found.agreement)
        ));
    }
    if let Some(size) = found.size.filter(Size::differs) {
        found.reasons.push(format!(
            "the target is {:.2} % {} than the source (+/- {:.2} %): check the depth scale and the \
             unit, and that both show the same version of the part",
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
            self.reasons.push(format!("the overlap does not constrain: {free}"));
        }
    }
}
