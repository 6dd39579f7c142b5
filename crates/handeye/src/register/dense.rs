//! Registration of two scans, organised or in any order.

use nalgebra::{Isometry3, Matrix6};

use super::{
    descent::Descent,
    freedom::Freedom,
    icp::Stop,
    rivals::{self, Opinions},
    surface::Surface,
};
use crate::{Error, Scan};

/// When to match and when to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DenseConfig {
    /// Windows farther apart are not compared, m.
    pub max_correspondence_distance_m: f64,
    /// Most rounds.
    pub max_iterations: usize,
    /// Threads; the answer is the same with any number.
    pub threads: usize,
}

impl Default for DenseConfig {
    fn default() -> Self {
        Self { max_correspondence_distance_m: 0.05, max_iterations: 60, threads: 1 }
    }
}

/// A registration of two scans.
#[derive(Debug, Clone, PartialEq)]
pub struct Dense {
    /// The whole transform, the start included.
    pub target_from_source: Isometry3<f64>,
    /// 6 x 6, rotation first, perturbed on the right (in the source frame).
    pub covariance: Option<Matrix6<f64>>,
    /// Rounds over all windows, and over some.
    pub iterations: usize,
    /// Why it ended.
    pub stop: Stop,
    /// Share of the source's windows that have found a match which counts.
    pub inlier_fraction: f64,
    /// RMS distance across the surface, of the matches, m.
    pub rms_m: f64,
}

/// Windows that are looked at first.
const COARSE: f64 = 1500.0;

/// Registers two scans, from a start that is right to some centimetres and degrees.
///
/// # Errors
/// [`Error::TooFewPoints`] where nothing can be compared, [`Error::NotDetermined`] where the common surface
/// leaves a direction free.
pub fn register(
    source: &Scan,
    target: &Scan,
    start: &Isometry3<f64>,
    config: &DenseConfig,
) -> Result<Dense, Error> {
    let surface = |scan: &Scan, name| {
        Surface::of(scan, config.threads)
            .ok_or_else(|| Error::Invalid(format!("the {name} scan shows no surface")))
    };
    let (source, target) = (surface(source, "source")?, surface(target, "target")?);
    let mut descent = Descent::new(&source, &target, config);
    let gate = config.max_correspondence_distance_m;
    let mut starts = vec![*start];
    starts.extend(rivals::around(start, &source.middle, 0.5 * gate));
    let rivals = rivals::answers(&mut descent, &starts, gate);
    let best = rivals.first().ok_or(Error::TooFewPoints { found: 0, needed: 20 })?;
    if std::env::var("SHOW").is_ok() {
        for r in &rivals {
            println!(
                "   {:.3} {:.0} {:?} {:.1} sd {:.2} mm",
                r.opinions.agreeing(),
                r.opinions.sum(),
                r.reached.iterations,
                best.opinions.above(&r.opinions),
                1e3 * source.moved(&r.reached.target_from_source, &best.reached.target_from_source)
            );
        }
    }
    if rivals.len() > 1 {
        return Err(Error::Invalid(format!("{} answers", 2)));
    }
    let mut reached = best.reached.clone();
    descent.coarse(&mut reached, 3.0 * source.spread, source.stride(COARSE))?;
    descent.fine(&mut reached, gate)?;
    let freedom = Freedom::of(&descent, &reached.target_from_source);
    let (_, free) = freedom.directions().ok_or(Error::TooFewPoints { found: 0, needed: 20 })?;
    let opinions = Opinions::of(&descent, &reached.target_from_source, 5000.0);
    if std::env::var("SHOW").is_ok() {
        println!("   agreeing {:.3}", opinions.agreeing());
    }
    if free > 0 {
        return Err(Error::Invalid(format!("{free} directions free")));
    }
    if source.moved(start, &reached.target_from_source) > 3.0 * gate {
        return Err(Error::Invalid("far from the start".into()));
    }
    Ok(Dense {
        covariance: freedom.covariance(&reached.target_from_source),
        target_from_source: reached.target_from_source,
        iterations: reached.iterations,
        stop: reached.stop,
        inlier_fraction: reached.inliers / reached.all,
        rms_m: reached.rms_m,
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::{
        Intrinsics, lie, linalg,
        simulate::{Random, Room},
    };

    const PI: f64 = std::f64::consts::PI;

    fn above(x: f64, y: f64, turn: [f64; 3]) -> Isometry3<f64> {
        let down = Isometry3::new([x, y, 0.8].into(), [PI, 0.0, 0.0].into());
        down * Isometry3::new(Vector3::zeros(), turn.into())
    }

    /// Two scans of a cell from different sides, with 0.5 mm of noise, and the truth.
    fn scans(seed: u64, lens: impl Fn(Intrinsics) -> Intrinsics) -> (Scan, Scan, Isometry3<f64>) {
        let mut random = Random::new(seed);
        let room = Room::of_a_cell(&mut random);
        let (one, other) =
            (above(0.05, -0.1, [0.12, 0.05, 0.1]), above(-0.1, 0.15, [-0.15, -0.1, -0.1]));
        let intrinsics = lens(Intrinsics::pinhole(240, 180, 240.0, 240.0, 119.5, 89.5));
        let source = room.scan(&one, &intrinsics, 5e-4, &mut random);
        let target = room.scan(&other, &intrinsics, 5e-4, &mut random);
        (source, target, other.inv_mul(&one))
    }

    fn off(truth: &Isometry3<f64>, random: &mut Random) -> Isometry3<f64> {
        let turn = random.normal3().normalize() * 1f64.to_radians();
        truth * Isometry3::new(random.normal3().normalize() * 5e-3, turn)
    }

    /// Degrees, and mm at the middle of the table.
    fn errors(truth: &Isometry3<f64>, found: &Isometry3<f64>) -> (f64, f64) {
        let middle = Vector3::new(0.0, 0.0, 0.8).into();
        let apart = (truth.transform_point(&middle) - found.transform_point(&middle)).norm();
        (lie::angle(&truth.rotation, &found.rotation).to_degrees(), 1e3 * apart)
    }

    #[test]
    fn two_scans_of_a_cell_are_brought_together() {
        let (mut turned, mut shifted) = (vec![], vec![]);
        for seed in 0..6 {
            let (source, target, truth) = scans(seed, |k| k);
            let start = off(&truth, &mut Random::new(100 + seed));
            let found = register(&source, &target, &start, &DenseConfig::default()).unwrap();
            assert_eq!(found.stop, Stop::Converged);
            assert!(found.inlier_fraction > 0.4, "{}", found.inlier_fraction);
            let (turn, shift) = errors(&truth, &found.target_from_source);
            assert!(turn < 0.1 && shift < 0.4, "{seed}: {turn} deg, {shift} mm");
            turned.push(turn);
            shifted.push(shift);
        }
        let (turn, shift) = (linalg::median(turned), linalg::median(shifted));
        println!("{turn:.4} deg, {shift:.3} mm");
        assert!(turn < 0.04 && shift < 0.15, "{turn} deg, {shift} mm");
    }

    #[test]
    fn a_lens_that_distorts_does_not_matter() {
        let barrel = |k: Intrinsics| Intrinsics {
            distortion: crate::Distortion::BrownConrady([
                -0.2, 0.05, 1e-3, -1e-3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
            ]),
            ..k
        };
        let (source, target, truth) = scans(1, barrel);
        let start = off(&truth, &mut Random::new(5));
        let found = register(&source, &target, &start, &DenseConfig::default()).unwrap();
        let (turn, shift) = errors(&truth, &found.target_from_source);
        assert!(turn < 0.05 && shift < 0.2, "{turn} deg, {shift} mm");
    }

    #[test]
    fn the_answer_does_not_depend_on_the_number_of_threads() {
        let (source, target, truth) = scans(2, |k| k);
        let start = off(&truth, &mut Random::new(6));
        let with = |threads| {
            register(&source, &target, &start, &DenseConfig { threads, ..DenseConfig::default() })
                .unwrap()
        };
        assert_eq!(with(1), with(2));
        assert_eq!(with(1), with(7));
    }

    #[test]
    fn moving_the_target_moves_only_the_answer() {
        let (source, target, truth) = scans(3, |k| k);
        let start = off(&truth, &mut Random::new(7));
        let plain = register(&source, &target, &start, &DenseConfig::default()).unwrap();
        let turn = Isometry3::new(Vector3::zeros(), [0.0, 0.0, PI / 2.0].into());
        // a quarter turn of the picture: rows become columns
        let (width, height) = (target.width(), target.height());
        let point = |k: usize| {
            let (x, y) = (k % height, k / height);
            let [px, py, pz] = target.points()[(height - 1 - x) * width + y];
            [-py, px, pz]
        };
        let turned = Scan::new(height, width, (0..width * height).map(point).collect()).unwrap();
        let found = register(&source, &turned, &(turn * start), &DenseConfig::default()).unwrap();
        let (degrees, mm) = errors(&(turn * plain.target_from_source), &found.target_from_source);
        // the blocks are others
        assert!(degrees < 0.02 && mm < 0.1, "{degrees} deg, {mm} mm");
    }

    #[test]
    fn scans_of_different_things_are_refused() {
        let (source, target, truth) = scans(4, |k| k);
        let away = Isometry3::translation(0.0, 0.0, 1.0) * truth;
        let error = register(&source, &target, &away, &DenseConfig::default()).unwrap_err();
        assert!(matches!(error, Error::TooFewPoints { .. }), "{error}");
        let nothing = Scan::new(4, 1, vec![[f32::NAN; 3]; 4]).unwrap();
        let error = register(&nothing, &target, &truth, &DenseConfig::default()).unwrap_err();
        assert!(error.to_string().contains("source scan"), "{error}");
    }

    /// The points that were seen, in any order.
    fn shuffled(scan: &Scan, seed: u64) -> Scan {
        let mut random = Random::new(seed);
        let mut points: Vec<[f32; 3]> =
            scan.points().iter().filter(|p| p[0].is_finite()).copied().collect();
        for k in (1..points.len()).rev() {
            points.swap(k, (random.unit() * (k + 1) as f64) as usize);
        }
        Scan::new(points.len(), 1, points).unwrap()
    }

    #[test]
    fn clouds_are_brought_together_whatever_the_order_of_their_points() {
        let (mut turned, mut shifted) = (vec![], vec![]);
        for seed in 0..6 {
            let (source, target, truth) = scans(seed, |k| k);
            let start = off(&truth, &mut Random::new(100 + seed));
            let with = |order: u64, threads| {
                let (source, target) = (shuffled(&source, order), shuffled(&target, order + 1));
                let config = DenseConfig { threads, ..DenseConfig::default() };
                register(&source, &target, &start, &config).unwrap()
            };
            let found = with(1, 1);
            assert_eq!(found, with(3, 2));
            assert_eq!(found.stop, Stop::Converged);
            let (turn, shift) = errors(&truth, &found.target_from_source);
            assert!(turn < 0.1 && shift < 0.4, "{seed}: {turn} deg, {shift} mm");
            turned.push(turn);
            shifted.push(shift);
        }
        let (turn, shift) = (linalg::median(turned), linalg::median(shifted));
        println!("{turn:.4} deg, {shift:.3} mm");
        assert!(turn < 0.04 && shift < 0.15, "{turn} deg, {shift} mm");
    }
}
