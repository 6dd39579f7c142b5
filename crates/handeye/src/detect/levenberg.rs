//! Levenberg-Marquardt for models of what is seen in a patch of pixels.

use nalgebra::{Const, DimMin, SMatrix, SVector};

use crate::math::optimize::{self, Damping, End, Problem, Rules, Singular, Stop, Tried};

/// Rounding to 8 bits alone leaves this variance, grey values squared.
pub(super) const ROUNDING_VARIANCE: f64 = 1.0 / 12.0;
/// Most steps of a fit; it usually takes four.
const RULES: Rules = Rules {
    most_steps: 30,
    damping: Damping { most: 1e6, ..Damping::from(1e-3) },
    slack: 0.0,
    singular: Singular::Ends,
};
/// Damping below this hardly shortens a step.
const FREE: f64 = 0.05;

/// A model and its pixels at one set of parameters; `r = I - model`.
#[derive(Clone, Copy)]
pub(super) struct Linearised<const N: usize> {
    /// `JᵀJ`
    pub normal: SMatrix<f64, N, N>,
    /// `Jᵀr`
    pub gradient: SVector<f64, N>,
    /// `rᵀr`
    pub cost: f64,
    /// Pixels, each by the square of its weight.
    pub count: f64,
}

impl<const N: usize> Linearised<N> {
    /// By the sums of products of columns `m <= n` of `(J, r)`.
    pub fn of(product: impl Fn(usize, usize) -> f64, count: f64) -> Self {
        let normal = SMatrix::from_fn(|m, n| product(m.min(n), m.max(n)));
        let gradient = SVector::from_fn(|m, _| product(m, N));
        Self { normal, gradient, cost: product(N, N), count }
    }

    /// Of one pixel, from the residuals; `None` where there are no more pixels than parameters.
    pub fn variance(&self) -> Option<f64> {
        let freedom = self.count - N as f64;
        (freedom > 0.0).then(|| (self.cost / freedom).max(ROUNDING_VARIANCE))
    }

    /// Of the parameters, with pixels of some variance.
    pub fn covariance(&self, variance: f64) -> Option<SMatrix<f64, N, N>>
    where
        Const<N>: DimMin<Const<N>, Output = Const<N>>,
    {
        Some(self.normal.cholesky()?.inverse() * variance)
    }

    /// The step with some damping; parameter `fixed` stays.
    pub fn step(&self, damping: f64, fixed: Option<usize>) -> Option<SVector<f64, N>>
    where
        Const<N>: DimMin<Const<N>, Output = Const<N>>,
    {
        let (mut damped, mut gradient) = (self.normal, self.gradient);
        (0..N).for_each(|k| damped[(k, k)] *= 1.0 + damping);
        if let Some(fixed) = fixed {
            for k in (0..N).filter(|k| *k != fixed) {
                (damped[(fixed, k)], damped[(k, fixed)]) = (0.0, 0.0);
            }
            gradient[fixed] = 0.0;
        }
        Some(damped.cholesky()?.solve(&gradient))
    }
}

/// A parameter that stays between two values.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounded {
    pub parameter: usize,
    pub least: f64,
    pub most: f64,
}

impl Bounded {
    /// The logarithm of a blur (px) between two.
    pub fn blur(parameter: usize, (least_px, most_px): (f64, f64)) -> Self {
        Self { parameter, least: least_px.ln(), most: most_px.ln() }
    }

    /// Whether a step leads out of the range from its end: then the others must move alone.
    pub fn holds<const N: usize>(&self, at: &SVector<f64, N>, step: &SVector<f64, N>) -> bool {
        let (here, step) = (at[self.parameter], step[self.parameter]);
        (here <= self.least && step < 0.0) || (here >= self.most && step > 0.0)
    }

    /// The parameters after a step.
    pub fn after<const N: usize>(
        &self,
        at: &SVector<f64, N>,
        step: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        let mut next = at + step;
        next[self.parameter] = next[self.parameter].clamp(self.least, self.most);
        next
    }
}

/// Where a fit ended.
pub(super) struct Descent<const N: usize> {
    pub at: SVector<f64, N>,
    /// What is known there, or from before the last, short step.
    pub there: Linearised<N>,
    /// The last step that was taken.
    pub step: SVector<f64, N>,
    /// Whether that was short, or rounding forbade a better one.
    pub settled: bool,
}

/// A model of a patch of pixels, a parameter between bounds, and what a short step is.
struct Fit<'a, const N: usize, F, S> {
    linearise: F,
    bounded: &'a Bounded,
    short: S,
}

impl<const N: usize, F, S> Problem for Fit<'_, N, F, S>
where
    F: Fn(&SVector<f64, N>) -> Option<Linearised<N>>,
    S: Fn(&SVector<f64, N>) -> bool,
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    type Point = SVector<f64, N>;
    type Equations = Linearised<N>;
    type Step = SVector<f64, N>;

    fn equations(&self, at: &SVector<f64, N>) -> Option<Linearised<N>> {
        (self.linearise)(at)
    }

    fn cost(&self, here: &Linearised<N>) -> f64 {
        here.cost
    }

    fn step(
        &self,
        at: &SVector<f64, N>,
        here: &Linearised<N>,
        damping: f64,
    ) -> Option<SVector<f64, N>> {
        let step = here.step(damping, None)?;
        if self.bounded.holds(at, &step) {
            return here.step(damping, Some(self.bounded.parameter));
        }
        Some(step)
    }

    fn moved(&self, at: &SVector<f64, N>, step: &SVector<f64, N>) -> SVector<f64, N> {
        self.bounded.after(at, step)
    }

    fn is_last(&self, tried: &Tried<SVector<f64, N>>) -> bool {
        tried.is_taken && (self.short)(tried.step)
    }

    fn is_trusted(&self, step: &SVector<f64, N>, damping: f64, begun: bool) -> bool {
        begun && damping < FREE && (self.short)(step)
    }
}

/// Steps until one is `short`, the first excepted. `None` where there is no direction to go.
pub(super) fn descend<const N: usize>(
    start: SVector<f64, N>,
    linearise: impl Fn(&SVector<f64, N>) -> Option<Linearised<N>>,
    bounded: &Bounded,
    short: impl Fn(&SVector<f64, N>) -> bool,
) -> Option<Descent<N>>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    let mut at = start;
    let fit = Fit::<N, _, _> { linearise, bounded, short };
    let here = fit.equations(&at)?;
    let End { there, step, stop } = optimize::descend(&fit, &mut at, here, &RULES);
    let step = step.unwrap_or_else(SVector::zeros);
    // rounding may forbid a better step
    let settled = matches!(stop, Stop::Converged | Stop::NoBetter);
    let is_answer = stop != Stop::Singular && there.cost.is_finite();
    is_answer.then_some(Descent { at, there, step, settled })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, Vector2};

    const FREE: Bounded = Bounded { parameter: 0, least: f64::NEG_INFINITY, most: f64::INFINITY };

    /// Rosenbrock's valley, as two residuals.
    fn valley(at: &Vector2<f64>) -> Option<Linearised<2>> {
        let r = Vector2::new(10.0 * (at.x * at.x - at.y), 1.0 - at.x);
        let j = Matrix2::new(-20.0 * at.x, 10.0, 1.0, 0.0);
        let (normal, gradient) = (j.transpose() * j, j.transpose() * r);
        Some(Linearised { normal, gradient, cost: r.norm_squared(), count: 2.0 })
    }

    #[test]
    fn a_bent_valley_is_followed_to_its_end() {
        let start = Vector2::new(0.0, 0.5);
        let found = descend(start, valley, &FREE, |step| step.norm() < 1e-9).unwrap();
        assert!(found.settled && (found.at - Vector2::new(1.0, 1.0)).norm() < 1e-8);
    }

    #[test]
    fn at_the_end_of_a_range_the_other_parameter_moves_alone() {
        let bounded = Bounded { most: 0.5, ..FREE };
        let found = descend(Vector2::zeros(), valley, &bounded, |step| step.norm() < 1e-9).unwrap();
        assert!((found.at - Vector2::new(0.5, 0.25)).norm() < 1e-6, "{}", found.at);
    }

    #[test]
    fn without_a_direction_there_is_no_fit() {
        let flat = |_: &Vector2<f64>| {
            let (normal, gradient) = (Matrix2::zeros(), Vector2::zeros());
            Some(Linearised { normal, gradient, cost: 1.0, count: 9.0 })
        };
        assert!(descend(Vector2::zeros(), flat, &FREE, |_| true).is_none());
        assert!(descend(Vector2::zeros(), |_| None, &FREE, |_| true).is_none());
    }
}
