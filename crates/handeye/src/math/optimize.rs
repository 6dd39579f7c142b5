//! Nonlinear least squares by Levenberg's and Marquardt's damped steps.
//!
//! ```text
//! cost(x) = rᵀ W r        H = Jᵀ W J        g = Jᵀ W r
//! (H + λ diag H) δ = -g   x ← x ⊞ δ  where that lowers the cost (λ falls), else λ grows
//! ```
//!
//! A caller brings its unknowns and their equations as a [`Problem`]: how large these are, how the damped
//! ones are solved (with blocks, bounds or a round of refinement), and when its fit has converged. What
//! is common, the damping and what is done with a step, stands in [`descend`] alone, and what differs in
//! it between fits is in [`Rules`]. Nothing is allocated here: equations of a fixed size stay on the stack.
//!
//! K. Levenberg, *A method for the solution of certain non-linear problems in least squares*, Quart. Appl.
//! Math. 2, 1944; D. Marquardt, *An algorithm for least-squares estimation of nonlinear parameters*, J. SIAM
//! 11(2), 1963 (the damping scaled by the diagonal).

/// Unknowns and the equations that they are to fulfil.
pub(crate) trait Problem {
    /// Values of all unknowns.
    type Point;
    /// Normal equations and cost at one point.
    type Equations;
    /// A change of all unknowns.
    type Step;

    /// The equations at a point; `None` where the model has no value, which is worse than any cost.
    fn equations(&self, at: &Self::Point) -> Option<Self::Equations>;

    /// `rᵀ W r`.
    fn cost(&self, here: &Self::Equations) -> f64;

    /// `δ` of `(H + λ diag H) δ = -g`; `None` where that cannot be solved.
    fn step(&self, at: &Self::Point, here: &Self::Equations, damping: f64) -> Option<Self::Step>;

    /// `x ⊞ δ`.
    fn moved(&self, at: &Self::Point, step: &Self::Step) -> Self::Point;

    /// Whether the fit has converged with a step that was tried.
    fn is_last(&self, tried: &Tried<Self::Step>) -> bool;

    /// Whether a step is so short that it is taken, as the last one, without a look at the cost there;
    /// `begun` once a step was taken.
    fn is_trusted(&self, _step: &Self::Step, _damping: f64, _begun: bool) -> bool {
        false
    }
}

/// A step whose cost is known.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tried<'a, Step> {
    pub step: &'a Step,
    /// Cost before it.
    pub before: f64,
    /// Cost after it; infinite where the model has no value.
    pub after: f64,
    /// Whether it is taken.
    pub is_taken: bool,
}

/// `λ`: of the first step, ten times larger after each step that is of no use, a tenth after each that is
/// taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Damping {
    /// Of the first step; zero is the step of Gauss and Newton.
    pub start: f64,
    /// Below this it is raised to [`Damping::raised`] at once.
    pub negligible: f64,
    /// What negligible damping is raised to.
    pub raised: f64,
    /// It does not fall below this.
    pub least: f64,
    /// Where a step with more than this is of no use, none is.
    pub most: f64,
}

impl Damping {
    /// From a value above zero, as far down and up as there are numbers.
    pub const fn from(start: f64) -> Self {
        Self { start, negligible: 0.0, raised: start, least: 0.0, most: f64::INFINITY }
    }

    fn lower(&self, damping: f64) -> f64 {
        (damping * 0.1).max(self.least)
    }

    fn higher(&self, damping: f64) -> f64 {
        if damping < self.negligible { self.raised } else { damping * 10.0 }
    }
}

/// What is done where the damped equations cannot be solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Singular {
    /// There is no direction to go: the descent ends.
    Ends,
    /// More damping.
    IsDamped,
}

/// Rules of a descent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rules {
    /// Most steps that are tried.
    pub most_steps: usize,
    pub damping: Damping,
    /// By which share the cost may grow in a step that is taken: rounding.
    pub slack: f64,
    pub singular: Singular,
}

/// Why a descent ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stop {
    /// The last step tells so.
    Converged,
    /// No step makes it better, however short.
    NoBetter,
    /// The damped equations cannot be solved.
    Singular,
    /// All steps are used up.
    OutOfSteps,
}

/// Where a descent ended.
#[derive(Debug, Clone, Copy)]
pub(crate) struct End<Equations, Step> {
    /// The equations there; from before the last step where that one was trusted.
    pub there: Equations,
    /// The last step that was taken.
    pub step: Option<Step>,
    pub stop: Stop,
}

/// Moves `at` by damped steps that lower the cost, from where the equations are `here`.
pub(crate) fn descend<P: Problem>(
    problem: &P,
    at: &mut P::Point,
    mut here: P::Equations,
    rules: &Rules,
) -> End<P::Equations, P::Step> {
    let mut damping = rules.damping.start;
    let mut last = None;
    for _ in 0..rules.most_steps {
        let is_most = damping > rules.damping.most;
        let Some(step) = problem.step(at, &here, damping) else {
            if is_most || rules.singular == Singular::Ends {
                return End { there: here, step: last, stop: Stop::Singular };
            }
            damping = rules.damping.higher(damping);
            continue;
        };
        let next = problem.moved(at, &step);
        if problem.is_trusted(&step, damping, last.is_some()) {
            *at = next;
            return End { there: here, step: Some(step), stop: Stop::Converged };
        }
        let before = problem.cost(&here);
        let there = problem.equations(&next);
        let after = there.as_ref().map_or(f64::INFINITY, |there| problem.cost(there));
        let better = there.filter(|_| after <= before * (1.0 + rules.slack));
        let is_taken = better.is_some();
        let is_last = problem.is_last(&Tried { step: &step, before, after, is_taken });
        if let Some(there) = better {
            (*at, here, last) = (next, there, Some(step));
            damping = rules.damping.lower(damping);
        } else {
            damping = rules.damping.higher(damping);
        }
        if is_last {
            return End { there: here, step: last, stop: Stop::Converged };
        }
        if !is_taken && is_most {
            return End { there: here, step: last, stop: Stop::NoBetter };
        }
    }
    End { there: here, step: last, stop: Stop::OutOfSteps }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, Vector2};
    use std::cell::RefCell;

    const RULES: Rules = Rules {
        most_steps: 100,
        damping: Damping { most: 1e8, ..Damping::from(1e-3) },
        slack: 0.0,
        singular: Singular::Ends,
    };

    type Equations = (Matrix2<f64>, Vector2<f64>, f64);

    /// Rosenbrock's valley, as two residuals, left of `wall`; and the damping of all steps.
    struct Valley {
        wall: f64,
        short: f64,
        damped: RefCell<Vec<f64>>,
    }

    impl Valley {
        fn new() -> Self {
            Self { wall: f64::INFINITY, short: 1e-9, damped: RefCell::default() }
        }

        fn descend(&self, rules: &Rules) -> (Vector2<f64>, End<Equations, Vector2<f64>>) {
            let mut at = Vector2::new(0.0, 0.5);
            let here = self.equations(&at).unwrap();
            let end = descend(self, &mut at, here, rules);
            (at, end)
        }
    }

    impl Problem for Valley {
        type Point = Vector2<f64>;
        type Equations = Equations;
        type Step = Vector2<f64>;

        fn equations(&self, at: &Vector2<f64>) -> Option<Equations> {
            let r = Vector2::new(10.0 * (at.x * at.x - at.y), 1.0 - at.x);
            let j = Matrix2::new(20.0 * at.x, -10.0, -1.0, 0.0);
            (at.x < self.wall).then(|| (j.transpose() * j, j.transpose() * r, r.norm_squared()))
        }

        fn cost(&self, here: &Equations) -> f64 {
            here.2
        }

        fn step(&self, _: &Vector2<f64>, here: &Equations, damping: f64) -> Option<Vector2<f64>> {
            self.damped.borrow_mut().push(damping);
            let mut damped = here.0;
            (0..2).for_each(|k| damped[(k, k)] *= 1.0 + damping);
            Some(-damped.cholesky()?.solve(&here.1))
        }

        fn moved(&self, at: &Vector2<f64>, step: &Vector2<f64>) -> Vector2<f64> {
            at + step
        }

        fn is_last(&self, tried: &Tried<Vector2<f64>>) -> bool {
            tried.is_taken && tried.step.norm() < self.short
        }
    }

    #[test]
    fn a_bent_valley_is_followed_to_its_end() {
        let (at, end) = Valley::new().descend(&RULES);
        assert_eq!(end.stop, Stop::Converged);
        assert!((at - Vector2::new(1.0, 1.0)).norm() < 1e-8 && end.there.2 < 1e-16, "{at}");
        assert!(end.step.unwrap().norm() < 1e-9);
    }

    #[test]
    fn it_stops_when_its_steps_are_used_up() {
        let valley = Valley::new();
        let (at, end) = valley.descend(&Rules { most_steps: 3, ..RULES });
        assert_eq!((end.stop, valley.damped.borrow().len()), (Stop::OutOfSteps, 3));
        assert_eq!(valley.equations(&at), Some(end.there));
    }

    #[test]
    fn a_worse_step_is_rejected_and_damped() {
        let valley = Valley::new();
        let free = Rules { damping: Damping { negligible: 1e-9, ..Damping::from(1e-3) }, ..RULES };
        let free = Rules { damping: Damping { start: 0.0, ..free.damping }, ..free };
        let mut costs = vec![];
        for most_steps in 0..12 {
            costs.push(valley.descend(&Rules { most_steps, ..free }).1.there.2);
        }
        assert!(costs.windows(2).all(|c| c[1] <= c[0]), "{costs:?}");
        // the first step of Gauss and Newton goes far up the valley's side
        let damped = valley.damped.borrow();
        assert_eq!(costs[0], costs[1]);
        assert_eq!(damped[damped.len() - 11..][..2], [0.0, 1e-3]);
    }

    #[test]
    fn where_the_model_has_no_value_a_step_is_rejected() {
        let valley = Valley { wall: 0.5, ..Valley::new() };
        let (at, end) = valley.descend(&RULES);
        assert_eq!(end.stop, Stop::NoBetter);
        assert!(at.x < 0.5 && at.x > 0.499, "{at}");
        assert!(valley.damped.borrow().iter().all(|d| *d <= 1e10));
    }

    #[test]
    fn singular_equations_end_it_or_are_damped_to_the_end() {
        let flat = (Matrix2::zeros(), Vector2::zeros(), 1.0);
        for (singular, tries) in [(Singular::Ends, 1), (Singular::IsDamped, 13)] {
            let (valley, mut at) = (Valley::new(), Vector2::zeros());
            let end = descend(&valley, &mut at, flat, &Rules { singular, ..RULES });
            assert_eq!((end.stop, end.step), (Stop::Singular, None));
            assert_eq!(valley.damped.borrow().len(), tries, "{singular:?}");
        }
    }

    #[test]
    fn damping_falls_to_its_least_and_leaves_zero_in_one_step() {
        let rules = Damping { negligible: 1e-9, raised: 1e-6, least: 1e-3, ..Damping::from(0.0) };
        assert_eq!((rules.higher(0.0), rules.higher(1e-6)), (1e-6, 1e-6 * 10.0));
        assert_eq!((rules.lower(1.0), rules.lower(1e-3)), (0.1, 1e-3));
    }
}
