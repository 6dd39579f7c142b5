//! Poses that no answer was made from: how far is the rigid answer off there, beside plain least squares?
//!
//! `cargo run --release -p handeye-bench --bin held_out -- DATA [FILE.md] MANIFEST...`
//!
//! DATA is the folder that the manifests' files are in. Of every set, captures are held out one by one, by place (five
//! groups of robot positions) and by time (five parts one after another), the rest is calibrated as bare pose pairs, and
//! the held-out ones are predicted. Captures that a calibration of all rejects as outliers are not used at all.

#[path = "../plain.rs"]
mod plain;
#[path = "../section.rs"]
mod section;

use std::{env, path::Path};

use handeye::{
    Anchor, Base, Calibration, Config, Flange, HandEye, Observation, Point, Pose, PosePair,
    Session, Setup, Target, calibrate,
};
use handeye_io::{Dataset, calibrate::calibrate_dataset};
use nalgebra::Vector3;

/// Points of the target at which errors are taken lie so far from its middle, m.
const LEVER: f64 = 0.1;
/// Groups by place, and parts in time.
const GROUPS: usize = 5;
/// Fewest captures of a set of which one is held out, and of one that is divided.
const FEWEST: (usize, usize) = (7, 10);

const HEAD: &str = "## Held-out poses

Measured sets as bare pose pairs: one capture after another is held out, or one of five groups of robot positions, or
one of five parts in time (from ten captures on); the rest is calibrated, and predicts the held-out poses. Errors are in mm,
root mean square at points 100 mm from the middle of the target.

- *plain*: least squares, rotations weighted by 100 mm; *handeye*: the rigid answer; *ratio*: of both.
- *corrected*: with what was learnt of the robot's errors by place, where that is offered.
- *none*: parts without an answer, which count for neither.

| set | captures | held out | plain | handeye | ratio | corrected | none |
|---|---|---|---|---|---|---|---|
";

fn main() {
    let words: Vec<String> = env::args().skip(1).collect();
    let (manifests, others): (Vec<_>, Vec<_>) = words.iter().partition(|w| w.ends_with(".toml"));
    let root = others.first().expect("the folder of the data");
    let mut rows = String::new();
    for manifest in manifests {
        let row = of_set(Path::new(manifest), Path::new(root));
        print!("{row}");
        rows += &row;
    }
    if let Some(file) = others.get(1) {
        section::write(file, "held-out", &format!("{HEAD}{rows}"));
    }
}

/// The rows of a set.
fn of_set(manifest: &Path, root: &Path) -> String {
    let name = manifest.file_stem().unwrap_or_default().to_string_lossy();
    let dataset = Dataset::open_with_root(manifest, root).expect("a manifest");
    let all = calibrate_dataset(&dataset, &config(), &|_, _| {});
    let (found, session) = all.expect("a dataset that can be used");
    let session = counted(&found, &session);
    let n = session.observations.len();
    if n < FEWEST.0 {
        return String::new();
    }
    let ways = [
        ("each alone", (0..n).map(|k| vec![k]).collect()),
        ("by place", by_place(&session)),
        (
            "in time",
            (0..GROUPS).map(|g| (g * n / GROUPS..(g + 1) * n / GROUPS).collect()).collect(),
        ),
    ];
    let row = |(way, parts): &(&str, Vec<Vec<usize>>)| {
        let [plain, own, corrected, none] = missed(&session, parts);
        let ratio = own / plain;
        format!(
            "| {name} | {n} | {way} | {plain:.2} | {own:.2} | {ratio:.2} | {corrected:.2} | {none} |\n"
        )
    };
    let ways = if n < FEWEST.1 { &ways[..1] } else { &ways[..] };
    ways.iter().map(row).collect()
}

fn config() -> Config {
    Config { max_error_mm: Some(1e3), ..Config::default() }
}

/// The captures that count, as pose pairs to the middle of the target.
fn counted(found: &Calibration, session: &Session) -> Session {
    let corners = session.target.as_ref().map(|t| t.corners());
    let middle = corners.map_or(Vector3::zeros(), |all| {
        all.iter().map(Point::vector).sum::<Vector3<f64>>() / all.len() as f64
    });
    let centre = Pose::<Target, Target>::from_parts(&nalgebra::Matrix3::identity(), middle);
    let pairs = plain::as_pairs(session, |o| {
        let own = found.captures.iter().find(|c| c.used && c.id == o.capture)?;
        let seen = own.camera_from_target.or(o.candidates.first().map(|c| c.camera_from_target))?;
        Some(seen * centre)
    });
    Session { arm: None, touches: vec![], placements: vec![], ..pairs }
}

/// Groups of captures near one another: each belongs to the nearest of five that are far apart.
fn by_place(session: &Session) -> Vec<Vec<usize>> {
    let at: Vec<Vector3<f64>> =
        session.observations.iter().map(|o| o.base_from_flange.translation()).collect();
    let mut seeds = vec![0];
    while seeds.len() < GROUPS {
        let away = |k: &usize| {
            seeds.iter().map(|s| (at[*s] - at[*k]).norm()).fold(f64::INFINITY, f64::min)
        };
        let far = (0..at.len()).max_by(|a, b| away(a).total_cmp(&away(b)));
        seeds.push(far.unwrap_or(0));
    }
    let nearest = |k: usize| {
        let to = |g: &usize| (at[seeds[*g]] - at[k]).norm();
        (0..GROUPS).min_by(|a, b| to(a).total_cmp(&to(b)))
    };
    let group = |g: usize| (0..at.len()).filter(|k| nearest(*k) == Some(g)).collect();
    (0..GROUPS).map(group).filter(|part: &Vec<usize>| !part.is_empty()).collect()
}

/// What plain least squares, the answer and the corrected robot miss of held-out parts, mm RMS, and how many
/// parts have no answer.
fn missed(session: &Session, parts: &[Vec<usize>]) -> [f64; 4] {
    let (mut sums, mut count, mut none) = ([0.0; 3], 0.0, 0.0);
    for part in parts {
        let Some(one) = of_part(session, part) else {
            none += 1.0;
            continue;
        };
        count += part.len() as f64;
        (0..3).for_each(|k| sums[k] += one[k]);
    }
    let [plain, own, corrected] = sums.map(|s| f64::sqrt(s / count) * 1e3);
    [plain, own, corrected, none]
}

/// Sums of squares over the captures of one part.
fn of_part(session: &Session, part: &[usize]) -> Option<[f64; 3]> {
    let mut rest = session.clone();
    let mut k = 0;
    rest.observations.retain(|_| {
        k += 1;
        !part.contains(&(k - 1))
    });
    let found = calibrate(&rest, &config()).ok()?;
    let own = HandEye {
        mount_from_camera: found.hand_eye.mount_from_camera?,
        anchor_from_target: found.hand_eye.anchor_from_target?,
    };
    let pairs: Vec<PosePair> = rest.observations.iter().map(|o| pair(session.setup, o)).collect();
    let plain = plain::fitted(&pairs, &own, LEVER);
    let model = found.compensation.as_ref().and_then(|c| c.model.as_ref());
    let mut sums = [0.0; 3];
    for &k in part {
        let held_out = pair(session.setup, &session.observations[k]);
        sums[0] += off(&plain, &held_out);
        sums[1] += off(&own, &held_out);
        sums[2] += match model {
            Some(model) => {
                let reported: Pose<Base, Flange> = session.observations[k].base_from_flange;
                let there = model.actual(&reported).base_from_flange;
                let anchor_from_mount = session.setup.anchor_from_mount(there);
                let rigid = HandEye {
                    mount_from_camera: model.rigid,
                    anchor_from_target: model.anchor_from_target,
                };
                off(&rigid, &PosePair { anchor_from_mount, ..held_out })
            }
            None => off(&own, &held_out),
        };
    }
    Some(sums)
}

fn pair(setup: Setup, o: &Observation) -> PosePair {
    PosePair {
        anchor_from_mount: setup.anchor_from_mount(o.base_from_flange),
        camera_from_target: o.candidates[0].camera_from_target,
    }
}

/// Mean square of what is missed at points around the target's middle, m^2.
fn off(h: &HandEye, pair: &PosePair) -> f64 {
    let seen: Pose<Anchor, Target> =
        pair.anchor_from_mount * h.mount_from_camera * pair.camera_from_target;
    let at = [(LEVER, 0.0), (0.0, LEVER), (-LEVER, 0.0), (0.0, -LEVER)];
    let one = |(x, y): (f64, f64)| {
        let p: Point<Target> = Point::from_vector(Vector3::new(x, y, 0.0));
        ((seen * p).vector() - (h.anchor_from_target * p).vector()).norm_squared()
    };
    at.into_iter().map(one).sum::<f64>() / at.len() as f64
}
