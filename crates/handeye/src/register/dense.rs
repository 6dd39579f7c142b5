//! Registration of two scans, organised or in any order.
//!
//! From a start that is right to some centimetres and degrees; others around it are tried as well, and the
//! answer is given with what speaks for and against it.

use nalgebra::{Isometry3, Matrix6};

use super::{
    descent::Descent,
    freedom::Freedom,
    icp::Stop,
    rivals::{self, Opinions, Rival},
    surface::Surface,
};
use crate::{Error, Scan, Verdict};

/// What is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DenseMethod {
    /// Distances along the mean of both normals (symmetric).
    #[default]
    Auto,
    /// Distances between places.
    PointToPoint,
    /// Distances along the target's normal.
    PointToPlane,
    /// Distances, by how windows are spread along and across both surfaces (generalised ICP).
    PlaneToPlane,
}

/// When to match and when to stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DenseConfig {
    /// What is compared.
    pub method: DenseMethod,
    /// Windows farther apart are not compared, m.
    pub max_correspondence_distance_m: f64,
    /// Most rounds over all windows; and over some, from each start.
    pub max_iterations: usize,
    /// A round that moves no window by more is the last, m. Zero leaves that to what is known of the noise.
    pub transformation_epsilon_m: f64,
    /// A round that changes the RMS distance by no more than this share is the last.
    pub fitness_epsilon: f64,
    /// Whether starts around the given one are tried as well.
    pub restarts: bool,
    /// Threads; the answer is the same with any number.
    pub threads: usize,
}

impl Default for DenseConfig {
    fn default() -> Self {
        Self {
            method: DenseMethod::Auto,
            max_correspondence_distance_m: 0.05,
            max_iterations: 60,
            transformation_epsilon_m: 0.0,
            fitness_epsilon: 0.0,
            restarts: true,
            threads: 1,
        }
    }
}

/// A registration of two scans.
#[derive(Debug, Clone, PartialEq)]
pub struct Dense {
    /// Whether to use it.
    pub verdict: Verdict,
    /// Why not.
    pub reasons: Vec<String>,
    /// Motions that the common surface leaves free, in the target frame; there the start remains.
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
    /// RMS distance across the surface, of the matches, m.
    pub rms_m: f64,
    /// Deviation of the matches over that which the scatter of their points promises.
    pub sigma: f64,
}

/// Windows that are asked for their opinion of the answer.
const ASKED: f64 = 5000.0;
/// With less agreement, something is wrong.
const AGREEING: f64 = 0.8;
/// With fewer matches, nothing is sure.
const OVERLAPPING: f64 = 0.05;

/// Registers two scans, from a start that is right to some centimetres and degrees.
///
/// # Errors
/// [`Error::Invalid`] where a scan shows no surface.
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
    Ok(register_surfaces(&source, &target, start, config))
}

/// Registers the surfaces of two scans; where nothing can be compared, the start is rejected.
pub fn register_surfaces(
    source: &Surface,
    target: &Surface,
    start: &Isometry3<f64>,
    config: &DenseConfig,
) -> Dense {
    registered(source, target, start, config).unwrap_or_else(|_| Dense {
        verdict: Verdict::Rejected,
        reasons: vec![format!(
            "hardly anything of the source lies within {:.0} mm of the target: give a better start, or a \
             larger distance",
            1e3 * config.max_correspondence_distance_m
        )],
        undetermined: vec![],
        target_from_source: *start,
        covariance: None,
        iterations: 0,
        stop: Stop::NoMatches,
        inlier_fraction: 0.0,
        agreement: 0.0,
        rms_m: f64::NAN,
        sigma: f64::NAN,
    })
}

fn registered(
    source: &Surface,
    target: &Surface,
    start: &Isometry3<f64>,
    config: &DenseConfig,
) -> Result<Dense, Error> {
    let mut descent = Descent::new(source, target, config);
    let gate = config.max_correspondence_distance_m;
    let mut starts = vec![*start];
    if config.restarts {
        starts.extend(rivals::around(start, &source.middle, 0.5 * gate));
    }
    let rivals = rivals::answers(&mut descent, &starts, gate)?;
    let mut reached = rivals[0].reached.clone();
    descent.nearby(&mut reached)?;
    descent.fine(&mut reached, gate)?;
    let sigma = descent.sigma;
    let freedom = Freedom::of(&descent, &reached.target_from_source);
    let (directions, free) = freedom.directions();
    let mut undetermined = vec![];
    if free > 0 {
        let columns: Vec<_> = (0..free).map(|k| directions.column(k).into_owned()).collect();
        undetermined = freedom.named(&columns, source.radius());
        // once more from the start, along the other directions alone
        let mut rest = directions;
        rest.columns_mut(0, free).fill(0.0);
        descent.along = Some(rest);
        reached.target_from_source = *start;
        descent.afar(&mut reached, gate)?;
        descent.fine(&mut reached, gate)?;
    }
    let at = reached.target_from_source;
    let mut found = Dense {
        verdict: Verdict::Accepted,
        reasons: vec![],
        undetermined,
        target_from_source: at,
        covariance: freedom.covariance(&at).filter(|_| free == 0),
        iterations: reached.iterations,
        stop: reached.stop,
        inlier_fraction: reached.inliers / reached.all,
        agreement: Opinions::of(&descent, &at, ASKED, sigma).agreeing(),
        rms_m: reached.rms_m,
        sigma,
    };
    judge(&mut found, source, &rivals);
    Ok(found)
}

fn judge(found: &mut Dense, source: &Surface, rivals: &[Rival]) {
    if let [best, others @ ..] = rivals
        && !others.is_empty()
        && found.undetermined.is_empty()
    {
        let away = |r: &Rival| {
            source.moved(&r.reached.target_from_source, &best.reached.target_from_source)
        };
        let nearest = others.iter().map(away).fold(f64::INFINITY, f64::min);
        found.reasons.push(format!(
            "the scans fit about as well in {} other {}, the nearest {:.0} mm away: give a better start, or \
             scans with more shape in common",
            others.len(),
            if others.len() == 1 { "place" } else { "places" },
            1e3 * nearest
        ));
    }
    if found.stop == Stop::MaxIterations {
        found.reasons.push(format!("the rounds were used up ({})", found.iterations));
    }
    if found.agreement < AGREEING {
        found.reasons.push(format!(
            "of the places where both scans show something, it differs at {:.0} %: the start may be too far \
             off, or things were moved between the scans",
            100.0 * (1.0 - found.agreement)
        ));
    }
    if found.inlier_fraction < OVERLAPPING {
        found.reasons.push(format!(
            "only {:.1} % of the source lies on the target",
            100.0 * found.inlier_fraction
        ));
    }
    found.verdict = match (found.reasons.is_empty(), found.undetermined.is_empty()) {
        (false, _) => Verdict::Rejected,
        (true, false) => Verdict::Undetermined,
        (true, true) => Verdict::Accepted,
    };
    if !found.undetermined.is_empty() {
        found
            .reasons
            .push(format!("the common surface leaves free: {}", found.undetermined.join("; ")));
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::{
        Intrinsics, lie, linalg,
        simulate::{Random, Room, Solid, Thing},
    };

    const PI: f64 = std::f64::consts::PI;

    fn above(x: f64, y: f64, turn: [f64; 3]) -> Isometry3<f64> {
        let down = Isometry3::new([x, y, 0.8].into(), [PI, 0.0, 0.0].into());
        down * Isometry3::new(Vector3::zeros(), turn.into())
    }

    /// Two scans of a cell from different sides, with 0.5 mm of noise, and the truth.
    fn scans_of(
        width: u32,
        seed: u64,
        lens: impl Fn(Intrinsics) -> Intrinsics,
    ) -> (Scan, Scan, Isometry3<f64>) {
        let mut random = Random::new(seed);
        let room = Room::of_a_cell(&mut random);
        let (one, other) =
            (above(0.05, -0.1, [0.12, 0.05, 0.1]), above(-0.1, 0.15, [-0.15, -0.1, -0.1]));
        let lens = lens(camera(width));
        let source = room.scan(&one, &lens, 5e-4, &mut random);
        let target = room.scan(&other, &lens, 5e-4, &mut random);
        (source, target, other.inv_mul(&one))
    }

    fn camera(width: u32) -> Intrinsics {
        let (height, f) = (width * 3 / 4, f64::from(width));
        Intrinsics::pinhole(width, height, f, f, 0.5 * f - 0.5, 0.375 * f - 0.5)
    }

    fn scans(seed: u64, lens: impl Fn(Intrinsics) -> Intrinsics) -> (Scan, Scan, Isometry3<f64>) {
        scans_of(240, seed, lens)
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
            assert_eq!((found.stop, found.verdict), (Stop::Converged, Verdict::Accepted));
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
        let found = register(&source, &target, &away, &DenseConfig::default()).unwrap();
        assert_eq!((found.verdict, found.stop), (Verdict::Rejected, Stop::NoMatches));
        assert_eq!(found.target_from_source, away);
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
            let (source, target, truth) = scans_of(366, seed, |k| k);
            let start = off(&truth, &mut Random::new(100 + seed));
            let with = |order: u64, threads| {
                let (source, target) = (shuffled(&source, order), shuffled(&target, order + 1));
                let config = DenseConfig { threads, ..DenseConfig::default() };
                register(&source, &target, &start, &config).unwrap()
            };
            let found = with(1, 1);
            assert_eq!(found, with(3, 2));
            assert_eq!((found.stop, found.verdict), (Stop::Converged, Verdict::Accepted));
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
    fn every_method_comes_to_the_same_place() {
        let (source, target, truth) = scans(1, |k| k);
        let start = off(&truth, &mut Random::new(8));
        let methods = [
            (DenseMethod::Auto, 0.3),
            (DenseMethod::PointToPlane, 0.4),
            (DenseMethod::PlaneToPlane, 1.5),
            (DenseMethod::PointToPoint, 20.0),
        ];
        for (method, mm) in methods {
            let config = DenseConfig { method, restarts: false, ..DenseConfig::default() };
            let found = register(&source, &target, &start, &config).unwrap();
            let (turn, shift) = errors(&truth, &found.target_from_source);
            assert!(turn < 0.5 * mm && shift < mm, "{method:?}: {turn} deg, {shift} mm");
        }
    }

    /// Starts up to 30 mm and 10 degrees off, from random sides: right or refused.
    #[test]
    fn no_answer_is_silently_wrong() {
        let (mut right, mut error, mut runs) = (0, 0.0, 0);
        for seed in 0..24 {
            let mut random = Random::new(1000 + seed);
            let room = Room::of_a_cell(&mut random);
            let mut some = |s: f64| random.between(-s, s);
            let mut view = || above(some(0.15), some(0.15), [some(0.2), some(0.2), some(0.3)]);
            let (one, other) = (view(), view());
            let source = room.scan(&one, &camera(240), 5e-4, &mut random);
            let target = room.scan(&other, &camera(240), 5e-4, &mut random);
            let truth = other.inv_mul(&one);
            let turn = random.normal3().normalize() * 10f64.to_radians();
            let to = Isometry3::translation(0.0, 0.0, 0.8);
            let away = Isometry3::new(random.normal3().normalize() * 0.03, turn);
            let start = truth * to * away * to.inverse();
            let found = register(&source, &target, &start, &DenseConfig::default()).unwrap();
            runs += 1;
            if found.verdict != Verdict::Accepted {
                assert!(!found.reasons.is_empty());
                continue;
            }
            let (turn, shift) = errors(&truth, &found.target_from_source);
            assert!(turn < 0.3 && shift < 1.5, "{seed}: {turn} deg, {shift} mm");
            right += 1;
            let off = lie::log(&truth.inv_mul(&found.target_from_source));
            error += off.dot(&(found.covariance.unwrap().try_inverse().unwrap() * off)) / 6.0;
        }
        println!("{right} of {runs}, normalised error {}", error / f64::from(right));
        assert!(right >= 18, "{right}");
        assert!((0.6..1.8).contains(&(error / f64::from(right))), "{}", error / f64::from(right));
    }

    /// A camera turned a little about what it looks at, which is alone in the room.
    fn undetermined(solid: Solid, turn: [f64; 3]) -> Vec<String> {
        let room_from_thing = Isometry3::new(Vector3::zeros(), turn.into());
        let thing = Thing { solid, room_from_thing };
        let room = Room { things: vec![thing] };
        let mut random = Random::new(9);
        let one = Isometry3::new([0.0, 0.0, 0.8].into(), [PI, 0.0, 0.0].into());
        let source = room.scan(&one, &camera(240), 3e-4, &mut random);
        let target = room.scan(&one, &camera(240), 3e-4, &mut random);
        let start = Isometry3::new([1e-3, -2e-3, 1e-3].into(), [2e-3, 1e-3, -3e-3].into());
        let found = register(&source, &target, &start, &DenseConfig::default()).unwrap();
        if found.undetermined.is_empty() {
            assert_eq!(found.verdict, Verdict::Accepted, "{:?}", found.reasons);
        } else {
            assert_eq!(found.verdict, Verdict::Undetermined, "{:?}", found.reasons);
            assert_eq!(found.covariance, None);
        }
        found.undetermined
    }

    fn shifts_and_turns(named: &[String]) -> (usize, usize) {
        let shifts = named.iter().filter(|n| n.starts_with("a shift")).count();
        (shifts, named.len() - shifts)
    }

    #[test]
    fn what_slides_on_itself_is_named() {
        let plane = undetermined(Solid::Block { half: [2.0, 2.0, 0.01] }, [0.0; 3]);
        assert_eq!(shifts_and_turns(&plane), (2, 1), "{plane:?}");
        assert!(plane[2].starts_with("a turn about (0.00, 0.00, 1.00)"), "{plane:?}");
        let ball = undetermined(Solid::Ball { radius: 0.2 }, [0.0; 3]);
        assert_eq!(shifts_and_turns(&ball), (0, 3), "{ball:?}");
        let bar = undetermined(Solid::Bar { radius: 0.1, half: 1.0 }, [0.0, PI / 2.0, 0.0]);
        assert!(bar[0].starts_with("a shift along (1.00, 0.00"), "{bar:?}");
        let block = undetermined(Solid::Block { half: [0.15, 0.15, 0.15] }, [0.7, 0.6, 0.0]);
        assert!(block.is_empty(), "{block:?}");
    }
}
