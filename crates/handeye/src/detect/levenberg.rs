//! Levenberg-Marquardt for models of what is seen in a patch of pixels.

use nalgebra::{Const, DimMin, SMatrix, SVector};

/// Rounding to 8 bits alone leaves this variance, grey values squared.
pub(super) const ROUNDING_VARIANCE: f64 = 1.0 / 12.0;
/// Most steps of a fit; it usually takes four.
const MOST_STEPS: usize = 30;
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
    let mut there = linearise(&at)?;
    let mut damping = 1e-3;
    let mut last = None;
    let mut settled = false;
    for _ in 0..MOST_STEPS {
        let mut step = there.step(damping, None)?;
        if bounded.holds(&at, &step) {
            step = there.step(damping, Some(bounded.parameter))?;
        }
        let next = bounded.after(&at, &step);
        if last.is_some() && damping < FREE && short(&step) {
            (at, last, settled) = (next, Some(step), true);
            break;
        }
        match linearise(&next) {
            Some(better) if better.cost <= there.cost => {
                (at, there, last) = (next, better, Some(step));
                damping *= 0.1;
                settled = short(&step);
            }
            // rounding: no step makes it better
            _ if damping > 1e6 => settled = true,
            _ => damping *= 10.0,
        }
        if settled {
            break;
        }
    }
    let step = last.unwrap_or_else(SVector::zeros);
    there.cost.is_finite().then_some(Descent { at, there, step, settled })
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
