//! Levenberg-Marquardt on a problem of a few parameters.
//!
//! `(H + λ diag H + ε tr H) δ = -g`; a step that does not raise the cost is taken and lowers `λ`, any other raises it.
//!
//! D. Marquardt, J. Soc. Indust. Appl. Math. 11(2), 1963.

use nalgebra::{SMatrix, SVector};

/// Normal matrix, gradient and cost at a state.
pub(crate) type Linearised<const N: usize> = (SMatrix<f64, N, N>, SVector<f64, N>, f64);

/// Damping at first, and its range.
const DAMPING: (f64, f64, f64) = (1e-6, 1e-12, 1e9);

/// When a descent ends, and what it forgives.
pub(crate) struct Descent {
    /// Most steps.
    pub steps: usize,
    /// A shorter step is the last one.
    pub shortest: f64,
    /// Share by which the cost may rise: its rounding.
    pub slack: f64,
    /// `ε`, for problems with free directions.
    pub floor: f64,
}

impl Descent {
    /// The state at the end, its cost, and whether every system of equations could be solved.
    pub(crate) fn run<S, const N: usize>(
        &self,
        start: S,
        linearise: impl Fn(&S) -> Linearised<N>,
        moved: impl Fn(&S, &SVector<f64, N>) -> S,
    ) -> (S, f64, bool) {
        let mut state = start;
        let (mut normal, mut gradient, mut cost) = linearise(&state);
        let (mut damping, least, most) = DAMPING;
        for _ in 0..self.steps {
            let floor = self.floor * normal.trace();
            let mut damped = normal;
            (0..N).for_each(|k| damped[(k, k)] += damping * normal[(k, k)] + floor);
            let Some(factor) = damped.cholesky() else { return (state, cost, false) };
            let step = -factor.solve(&gradient);
            let next = moved(&state, &step);
            let (h, g, c) = linearise(&next);
            if c <= cost * (1.0 + self.slack) {
                (state, normal, gradient, cost) = (next, h, g, c);
                damping = (damping * 0.1).max(least);
            } else {
                damping *= 10.0;
            }
            if step.norm() < self.shortest || damping > most {
                break;
            }
        }
        (state, cost, true)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix1, Vector1};

    use super::*;

    #[test]
    fn a_root_is_found_from_afar() {
        let residual = |x: &f64| (x.exp() - 2.0, x.exp());
        let linearise = |x: &f64| {
            let (r, j) = residual(x);
            (Matrix1::new(j * j), Vector1::new(j * r), r * r)
        };
        let descent = Descent { steps: 50, shortest: 1e-14, slack: 0.0, floor: 0.0 };
        let (x, cost, is_solved) = descent.run(3.0, linearise, |x, step| x + step[0]);
        assert!(is_solved && cost < 1e-25 && (x - 2f64.ln()).abs() < 1e-12, "{x}");
    }
}
