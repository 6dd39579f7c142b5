//! Captures against what most of them agree on: what restores an outlier is a candidate for its cause.
//!
//! An explanation restores a capture when its residual is as small as that of the captures that agree, or, where they were
//! fitted, when its squared Mahalanobis distance against that fit is one that noise reaches: `d² < χ²₆(0.99) = 16.8`.

use super::{
    frozen::is_same_robot,
    score::agreeing,
    thresholds::{AS_GOOD, LEAST_TYPICAL, NEARLY, RESTORABLE, RESTORED},
};
use crate::{
    Setup,
    estimate::JointFit,
    model::residual::Residual,
    solve::{
        View,
        consensus::{Consensus, Readings},
    },
};

/// The captures of a session, those that agree and those that do not.
pub(crate) struct Outliers<'a> {
    captures: &'a [Readings],
    /// Every pose candidate of each capture, with its covariance where it is known.
    pub candidates: Vec<Vec<View>>,
    /// What most captures agree on.
    pub found: &'a Consensus,
    /// The fit of those, where there is one.
    fit: Option<(&'a JointFit, Setup)>,
    /// Residual of a capture that is as good as those that agree.
    pub typical: Residual,
}

impl<'a> Outliers<'a> {
    /// Captures against a fit of those that agree.
    pub fn new(
        captures: &'a [Readings],
        candidates: Vec<Vec<View>>,
        found: &'a Consensus,
        fit: Option<(&'a JointFit, Setup)>,
    ) -> Self {
        let inside = agreeing(found).into_iter().filter(|&i| !candidates[i].is_empty());
        let of = |i: usize| found.hand_eye.loop_residual(&candidates[i][found.reading[i]].pair);
        let inside: Vec<Residual> = inside.map(of).collect();
        let typical = Residual::median(&inside).at_least(LEAST_TYPICAL).times(AS_GOOD);
        Self { captures, candidates, found, fit, typical }
    }

    /// Captures against what they agree on, without a fit and its noise.
    pub fn unfitted(captures: &'a [Readings], found: &'a Consensus) -> Self {
        let of = |c: &Readings| {
            let with = |k| View::bare(c.pair(k));
            (0..c.camera_from_target.len()).map(with).collect()
        };
        Self::new(captures, captures.iter().map(of).collect(), found, None)
    }

    /// Captures that do not agree, of those that show the target.
    pub fn outside(&self) -> Vec<usize> {
        let n = self.candidates.len();
        (0..n).filter(|&i| !self.found.agrees[i] && !self.candidates[i].is_empty()).collect()
    }

    /// Whether the captures that agree were fitted, so that their noise is known.
    pub fn is_fitted(&self) -> bool {
        self.fit.is_some()
    }

    /// All captures but one.
    pub fn others(&self, i: usize) -> impl Iterator<Item = usize> + use<> {
        (0..self.candidates.len()).filter(move |&j| j != i)
    }

    /// Residual of a view under what most captures agree on.
    pub fn residual(&self, view: &View) -> Residual {
        self.found.hand_eye.loop_residual(&view.pair)
    }

    /// Whether a view fits as well as noise lets it.
    pub fn is_restored(&self, view: &View) -> bool {
        let residual = self.residual(view);
        let is_noise = |(fit, setup): (&JointFit, Setup)| {
            fit.squared_mahalanobis(view, setup).is_some_and(|d2| d2 < RESTORED)
        };
        residual.is_within(RESTORABLE)
            && (residual.is_within(self.typical) || self.fit.is_some_and(is_noise))
    }

    /// Whether image `i` fits the robot pose of capture `j`.
    pub fn fits(&self, i: usize, j: usize) -> bool {
        self.candidates[i].iter().any(|view| self.is_restored(&self.at(view, j)))
    }

    /// Whether image `i` fits the robot pose of capture `j` but for a residual that a worse one of those that agree might
    /// have.
    pub fn nearly_fits(&self, i: usize, j: usize) -> bool {
        let limit = self.typical.times(NEARLY);
        let mut residuals = self.candidates[i].iter().map(|view| self.residual(&self.at(view, j)));
        residuals.any(|r| r.is_within(limit) && r.is_within(RESTORABLE))
    }

    /// A view at the robot pose of capture `j`.
    fn at(&self, view: &View, j: usize) -> View {
        let mut moved = view.clone();
        moved.pair.anchor_from_mount = self.captures[j].anchor_from_mount;
        moved
    }

    /// Whether two captures have one robot pose.
    pub fn is_same_robot(&self, i: usize, j: usize) -> bool {
        is_same_robot(&self.captures[i], &self.captures[j])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        estimate::{self, KnownNoise},
        mistakes::tests::{agreed, in_order, shift, with_robot},
    };

    #[test]
    fn as_good_as_those_that_agree_is_three_times_their_median() {
        let right = in_order(12, 4);
        let found = agreed(&right);
        let outliers = Outliers::unfitted(&right.declared, &found);
        let mut view = outliers.candidates[0][found.reading[0]].clone();
        // a capture whose loop is open by so much along one axis
        let mut open = |distance: f64| {
            let p = &outliers.candidates[0][found.reading[0]].pair;
            let closing = found.hand_eye.loop_error(p).inverse();
            view.pair.camera_from_target =
                p.camera_from_target * closing * shift(distance, 0.0, 0.0);
            outliers.is_restored(&view)
        };
        let typical = outliers.typical.distance;
        assert!(open(0.95 * typical) && !open(1.05 * typical));
    }

    #[test]
    fn with_a_fit_noise_restores_what_is_farther_than_typical() {
        let right = in_order(12, 4);
        let found = agreed(&right);
        let unfitted = Outliers::unfitted(&right.declared, &found);
        let views: Vec<View> =
            (0..12).map(|i| unfitted.candidates[i][found.reading[i]].clone()).collect();
        let fit = estimate::fit_views(&views, &found.hand_eye, &KnownNoise::default(), right.setup);
        let fit = fit.unwrap();
        let fitted = Outliers::new(
            &right.declared,
            unfitted.candidates.clone(),
            &found,
            Some((&fit, right.setup)),
        );
        assert!(fitted.is_fitted() && !unfitted.is_fitted());
        assert!(views.iter().all(|view| fitted.is_restored(view)));
        let mut beyond = views[0].clone();
        beyond.pair.anchor_from_mount = shift(0.05, 0.0, 0.0) * beyond.pair.anchor_from_mount;
        assert!(!fitted.is_restored(&beyond));
    }

    #[test]
    fn captures_outside_are_those_that_show_the_target_and_do_not_agree() {
        let right = in_order(12, 4);
        let mut wrong = with_robot(&right, |k, c| match k {
            3 => shift(0.1, 0.2, 0.0) * c.anchor_from_mount,
            _ => c.anchor_from_mount,
        });
        wrong.declared[8].camera_from_target.clear();
        let found = agreed(&wrong);
        assert_eq!(Outliers::unfitted(&wrong.declared, &found).outside(), [3]);
    }
}
