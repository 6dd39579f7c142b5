//! The noise of every source from the residuals, and what each contributes to the information.

use std::ops::AddAssign;

use nalgebra::{DMatrix, DVector, SMatrix, SVector, Vector6};

use super::super::{
    joint::{PRIOR_TOUCHES, PRIOR_VIEWS},
    noise::{KnownNoise, NoiseModel, Sigma, Source},
};
use crate::{
    estimate::{
        noise::LEAST_SIGMA,
        system::state::{BoardBlock, Level, System, ViewNoise},
    },
    math::linalg,
};

impl System {
    /// One step of Fisher's scoring on every component that is not known; the largest relative
    /// change of a standard deviation.
    pub(crate) fn update_noise(
        &self,
        noise: &mut NoiseModel,
        prior: &NoiseModel,
        known: &KnownNoise,
    ) -> f64 {
        let Some(root) = self.covariance_root() else { return 0.0 };
        let moments = self.moments(&root);
        let free: Vec<usize> = (0..noise.sigmas.len())
            .filter(|&k| known.sigma(noise.sigmas[k].source).is_none())
            .collect();
        let n = free.len();
        let (mut score, mut information) = (DVector::zeros(n), DMatrix::zeros(n, n));
        for (row, &k) in free.iter().enumerate() {
            let Sigma { source, sigma, .. } = noise.sigmas[k];
            let theta = sigma * sigma;
            let first = prior.sigmas[k].sigma;
            let i = source.index();
            let (by_prior, of_prior) = prior_score(source, sigma / first);
            score[row] = 0.5 * theta * (moments.found[i] - moments.expected[i]) + by_prior;
            information[(row, row)] += of_prior;
            for (column, &l) in free.iter().enumerate() {
                let other = noise.sigmas[l];
                let t = moments.information[(i, other.source.index())];
                information[(row, column)] += 0.5 * theta * other.sigma.powi(2) * t;
            }
        }
        let Some(inverse) = linalg::inverse_spd(&information) else { return 0.0 };
        let step = &inverse * score;
        let mut largest: f64 = 0.0;
        for (row, &k) in free.iter().enumerate() {
            let s = &mut noise.sigmas[k];
            let change = (0.5 * step[row].clamp(-2.0, 2.0)).exp();
            s.sigma = (s.sigma * change).max(LEAST_SIGMA);
            s.uncertainty = Some(0.5 * inverse[(row, row)].max(0.0).sqrt());
            if s.sigma > LEAST_SIGMA {
                // a level is as uncertain as its few unknowns leave it
                let slack = if s.source.is_level() { LEVEL_SLACK } else { 1.0 };
                largest = largest.max((change - 1.0).abs() / slack);
            }
        }
        largest
    }

    /// Both sides of the REML equations, and their information, by number of the source.
    fn moments(&self, root: &DMatrix<f64>) -> Moments {
        let mut sum = Moments::default();
        // what the unknowns take away of each equation
        let spent = &self.jacobian * root;
        for (i, view) in self.views.iter().enumerate() {
            sum.add_view(view, &self.residual.fixed_rows::<6>(6 * i).into(), &spent, 6 * i);
        }
        let covariance = root * root.transpose();
        for block in &self.boards {
            sum.add_board(block, &covariance);
        }
        for level in &self.levels {
            sum.add_level(
                level,
                self,
                &(&spent * root.select_rows(&level.which).transpose()),
                &covariance,
            );
        }
        sum
    }

    /// The information as a sum over the sources whose noise it weighs; `None` stands for priors.
    pub fn shares(&self, noise: &NoiseModel) -> Vec<(Option<Source>, DMatrix<f64>)> {
        let p = self.h.nrows();
        let share = |source: Source, theta: f64| {
            let mut m = DMatrix::zeros(p, p);
            for (i, view) in self.views.iter().enumerate() {
                for (c, own) in view.columns.iter().enumerate() {
                    if *own == source {
                        let rows = self.jacobian.fixed_rows::<6>(6 * i);
                        let through = rows.tr_mul(&view.factor.column(c));
                        m.ger(theta, &through, &through, 1.0);
                    }
                }
            }
            for block in &self.boards {
                let vj = block.cholesky.solve(&block.rows.jacobian);
                for (_, shape) in block.rows.shapes.iter().filter(|(own, _)| *own == source) {
                    m += vj.tr_mul(&(shape * &vj)) * theta;
                }
            }
            m
        };
        let mut all: Vec<(Option<Source>, DMatrix<f64>)> = noise
            .sigmas
            .iter()
            .map(|s| (Some(s.source), share(s.source, s.sigma * s.sigma)))
            .collect();
        for level in &self.levels {
            if let Some((_, m)) = all.iter_mut().find(|(s, _)| *s == Some(level.source)) {
                level.which.iter().for_each(|&k| m[(k, k)] += level.variance.recip());
            }
        }
        if let Some((_, m)) = all.iter_mut().find(|(s, _)| *s == Some(Source::Picture)) {
            let n = self.sights.information.nrows();
            m.view_mut((12, 12), (n, n)).add_assign(&self.sights.information);
        }
        let rest = all.iter().fold(self.h.clone(), |rest, (_, m)| rest - m);
        all.push((None, rest));
        all
    }
}

/// Score of `log θ` by the prior of a standard deviation that is `ratio` times the first one, and its information.
fn prior_score(source: Source, ratio: f64) -> (f64, f64) {
    if source.is_level() {
        return (-0.5 * ratio, 0.25 * ratio);
    }
    let captures = if source == Source::Touch { PRIOR_TOUCHES } else { PRIOR_VIEWS };
    let equations = source.axes() * captures;
    let first_over_now = ratio.powi(-2);
    (0.5 * equations * (first_over_now - 1.0), 0.5 * equations * first_over_now.max(1.0))
}

/// Levels may still change by so many times more than noise when both have converged.
const LEVEL_SLACK: f64 = 10.0;

const SOURCES: usize = Source::ALL.len();

#[derive(Default)]
struct Moments {
    found: SVector<f64, SOURCES>,
    expected: SVector<f64, SOURCES>,
    information: SMatrix<f64, SOURCES, SOURCES>,
}

impl Moments {
    fn add_view(
        &mut self,
        view: &ViewNoise,
        residual: &Vector6<f64>,
        spent: &DMatrix<f64>,
        row: usize,
    ) {
        let u = view.factor.transpose() * residual;
        let traces = view.factor.transpose() * view.factor;
        for (c, source) in view.columns.iter().enumerate() {
            let i = source.index();
            let f: [f64; 6] = view.factor.column(c).into_owned().into();
            let taken: f64 = spent
                .as_slice()
                .chunks_exact(spent.nrows())
                .map(|column| dot(&f, &column[row..row + 6]).powi(2))
                .sum();
            self.found[i] += u[c] * u[c];
            self.expected[i] += traces[(c, c)] - taken;
            for (d, other) in view.columns.iter().enumerate() {
                self.information[(i, other.index())] += traces[(c, d)].powi(2);
            }
        }
    }

    /// Unknowns of one level: what they are, and what they leave open, against their priors; `through` is
    /// `J C_b`.
    fn add_level(
        &mut self,
        level: &Level,
        system: &System,
        through: &DMatrix<f64>,
        covariance: &DMatrix<f64>,
    ) {
        let (i, theta) = (level.source.index(), level.variance);
        let open: f64 = level.which.iter().map(|&k| covariance[(k, k)]).sum();
        self.found[i] += level.squares / theta.powi(2);
        self.expected[i] += (level.which.len() as f64 - open / theta) / theta;
        for other in &system.levels {
            let both = theta * other.variance;
            let square = |k: usize, l: usize| {
                let own = if k == l { 1.0 } else { 0.0 };
                (own - covariance[(k, l)] / both.sqrt()).powi(2)
            };
            let of = |k: usize| other.which.iter().map(|&l| square(k, l)).sum::<f64>();
            let sum: f64 = level.which.iter().map(|&k| of(k)).sum();
            self.information[(i, other.source.index())] += sum / both;
        }
        for (v, view) in system.views.iter().enumerate() {
            let by_noise = view.factor.tr_mul(&through.rows(6 * v, 6));
            for (c, noise) in view.columns.iter().enumerate() {
                let both = by_noise.row(c).norm_squared() / theta.powi(2);
                self.information[(i, noise.index())] += both;
                self.information[(noise.index(), i)] += both;
            }
        }
    }

    fn add_board(&mut self, block: &BoardBlock, covariance: &DMatrix<f64>) {
        let inverse = block.cholesky.inverse();
        let u = &inverse * &block.rows.residual;
        let vj = &inverse * &block.rows.jacobian;
        let products: Vec<DMatrix<f64>> =
            block.rows.shapes.iter().map(|(_, g)| &inverse * g).collect();
        for ((source, g), product) in block.rows.shapes.iter().zip(&products) {
            let i = source.index();
            self.found[i] += u.dot(&(g * &u));
            self.expected[i] += product.trace() - (covariance * vj.tr_mul(&(g * &vj))).trace();
            for ((other, _), second) in block.rows.shapes.iter().zip(&products) {
                let trace = product.component_mul(&second.transpose()).sum();
                self.information[(i, other.index())] += trace;
            }
        }
    }
}

fn dot(a: &[f64; 6], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
