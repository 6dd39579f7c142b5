//! Levenberg-Marquardt for models of what is seen in a few hundred pixels.

use nalgebra::{Const, DimMin, SMatrix, SVector};

/// `JᵀJ`, `Jᵀr` and `rᵀr` of `r = I - model`.
pub(super) type Linearised<const N: usize> = (SMatrix<f64, N, N>, SVector<f64, N>, f64);

/// Where a fit ended.
pub(super) struct Descent<const N: usize> {
    pub at: SVector<f64, N>,
    pub normal: SMatrix<f64, N, N>,
    pub cost: f64,
    /// Whether the last step was short, or rounding forbade a better one.
    pub settled: bool,
}

/// Most steps of a fit; it usually takes four.
const MOST_STEPS: usize = 30;

/// Steps, each made `possible`, until one that makes the fit better is `short`. `None` where there is
/// no direction to go.
pub(super) fn descend<const N: usize>(
    start: SVector<f64, N>,
    linearise: impl Fn(&SVector<f64, N>) -> Option<Linearised<N>>,
    possible: impl Fn(&mut SVector<f64, N>),
    short: impl Fn(&SVector<f64, N>) -> bool,
) -> Option<Descent<N>>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    let mut at = start;
    let (mut normal, mut gradient, mut cost) = linearise(&at)?;
    let mut damping = 1e-3;
    let mut settled = false;
    for _ in 0..MOST_STEPS {
        let mut damped = normal;
        (0..N).for_each(|k| damped[(k, k)] *= 1.0 + damping);
        let step = damped.cholesky()?.solve(&gradient);
        let mut next = at + step;
        possible(&mut next);
        match linearise(&next) {
            Some((n, g, c)) if c <= cost => {
                (at, normal, gradient, cost) = (next, n, g, c);
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
    cost.is_finite().then_some(Descent { at, normal, cost, settled })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, Vector2};

    /// Rosenbrock's valley, as two residuals.
    fn valley(at: &Vector2<f64>) -> Option<Linearised<2>> {
        let r = Vector2::new(10.0 * (at.x * at.x - at.y), 1.0 - at.x);
        let j = Matrix2::new(-20.0 * at.x, 10.0, 1.0, 0.0);
        Some((j.transpose() * j, j.transpose() * r, r.norm_squared()))
    }

    #[test]
    fn a_bent_valley_is_followed_to_its_end() {
        let start = Vector2::new(0.0, 0.5);
        let found = descend(start, valley, |_| {}, |step| step.norm() < 1e-9).unwrap();
        assert!(found.settled && (found.at - Vector2::new(1.0, 1.0)).norm() < 1e-8);
    }

    #[test]
    fn what_is_not_possible_is_not_tried() {
        let most = |at: &mut Vector2<f64>| at.x = at.x.min(0.5);
        let found = descend(Vector2::zeros(), valley, most, |step| step.norm() < 1e-9).unwrap();
        assert!((found.at - Vector2::new(0.5, 0.25)).norm() < 1e-3, "{}", found.at);
    }

    #[test]
    fn without_a_direction_there_is_no_fit() {
        let flat = |_: &Vector2<f64>| Some((Matrix2::zeros(), Vector2::zeros(), 1.0));
        assert!(descend(Vector2::zeros(), flat, |_| {}, |_| true).is_none());
        assert!(descend(Vector2::zeros(), |_| None, |_| {}, |_| true).is_none());
    }
}
