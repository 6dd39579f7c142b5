//! `handeye compare`: do several calibrations of one cell agree?

use std::path::{Path, PathBuf};

use clap::Args;
use handeye::{
    Calibration, Camera, Mount, Pose, Setup,
    calibrate::result,
    quaternion_xyzw,
    tools::repeat::{
        Agreement, Repeat, Repetition, Scatter, repeat, scatter_at, scatter_of_rotation,
    },
};
use handeye_io::{pose_file, read_result, write_atomically};
use nalgebra::Vector3;
use serde::Serialize;

use crate::{
    args::GlobalArgs,
    difference::{Difference, chance, difference, far},
    failure::Failure,
    halves, output,
};

/// Arguments of `compare`.
#[derive(Args)]
#[command(after_help = "Examples:\n\
\x20 handeye compare monday/calibration.json tuesday/calibration.json\n\
\x20 handeye compare monday tuesday wednesday --out combined.json\n\
\x20 handeye compare cell\n\
\n\
For one dataset, the captures are split into two halves in three ways (every second capture, by robot position, earlier and later), and the two calibrations of each split are compared.\n\
\n\
Distances are from the combined result: `rms` is the root of their mean square, `max` the \
largest, `std dev` the standard deviation of a single result (n - 1 in the denominator): the \
repeatability of one calibration of this cell. In JSON: rms, max, axes, standard_deviation.\n\
\n\
Where results differ by more than their covariances allow, the covariance of the combined \
one is as large as their spread says.\n\
\n\
Exit code 0: the results agree within their covariances (p >= 0.01); 3: they do not, or \
cannot be tested because one states no covariance.")]
pub struct CompareArgs {
    /// The calibration.json of two or more results, or their folders; or poses that `import` wrote. Or one dataset.
    #[arg(required = true, num_args = 1..)]
    pub results: Vec<PathBuf>,
    /// Write the combined transform with its covariance as JSON, for `verify`, `export` and `view`.
    #[arg(long, short)]
    pub out: Option<PathBuf>,
    /// Of one dataset: folder that the file names in its manifest are relative to [default: the folder of the manifest].
    #[arg(long)]
    pub root: Option<PathBuf>,
}

/// With more results than this, pairs are too many to read.
const MOST_IN_TABLE: usize = 6;

/// Scatter with its unit in the name.
#[derive(Serialize)]
struct InUnits {
    rms: f64,
    max: f64,
    axes: [f64; 3],
    standard_deviation: f64,
}

impl InUnits {
    fn of(scatter: Scatter, unit: f64) -> Self {
        let axes = scatter.axes.map(|a| a * unit);
        Self {
            rms: scatter.rms * unit,
            max: scatter.max * unit,
            axes,
            standard_deviation: scatter.standard_deviation * unit,
        }
    }
}

/// How the answers differ.
#[derive(Serialize)]
struct Spread {
    camera_origin_mm: InUnits,
    half_a_metre_before_camera_mm: InUnits,
    rotation_deg: InUnits,
}

#[derive(Serialize)]
struct Combined {
    mount_from_camera: Pose<Mount, Camera>,
    covariance: Option<result::Rows>,
}

#[derive(Serialize)]
struct Answer {
    agree: Option<bool>,
    odd_one_out: Option<PathBuf>,
    test: Option<Agreement>,
    setup: Setup,
    name: String,
    combined: Combined,
    spread: Spread,
    from_mean: Vec<Difference>,
    pairs: Vec<Difference>,
}

pub fn run(args: &CompareArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    if let [dataset] = &args.results[..] {
        if args.out.is_some() {
            let what = "--out is for results: halves are compared, and the answer of all captures is that of calibrate";
            return Err(Failure::Usage(what.into()));
        }
        return halves::run(dataset, args.root.as_deref(), global);
    }
    if args.root.is_some() {
        return Err(Failure::Usage("--root is for one dataset, not for results".into()));
    }
    let read = |path: &PathBuf| read_result(path).map_err(Failure::from);
    let results = args.results.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    check_twice(&args.results)?;
    check_setups(&args.results, &results)?;
    let answers = args.results.iter().zip(&results).map(|(path, c)| repetition(path, c));
    let answers = answers.collect::<Result<Vec<_>, _>>()?;
    let found = repeat(&answers)?;
    let answer = answer(&args.results, &results[0], &answers, &found);
    if let Some(out) = &args.out {
        let covariance = found.covariance.as_ref().map(result::rows);
        let text = pose_file(results[0].setup, &found.mean, covariance.as_ref());
        write_atomically(out, text.as_bytes())?;
    }
    if global.json {
        output::json(&answer);
    } else {
        output::print(&table(&answer, args.results.len()));
    }
    Ok(if answer.agree == Some(true) { 0 } else { 3 })
}

fn check_twice(paths: &[PathBuf]) -> Result<(), Failure> {
    let real: Vec<PathBuf> =
        paths.iter().map(|p| p.canonicalize().unwrap_or_else(|_| p.clone())).collect();
    match (1..real.len()).find(|&k| real[..k].contains(&real[k])) {
        None => Ok(()),
        Some(k) => {
            let what = "is named twice; a result agrees with itself, which tells nothing";
            Err(Failure::input(&paths[k], what))
        }
    }
}

fn check_setups(paths: &[PathBuf], results: &[Calibration]) -> Result<(), Failure> {
    let first = &results[0];
    match results.iter().zip(paths).find(|(r, _)| r.setup != first.setup) {
        None => Ok(()),
        Some((other, path)) => {
            let what = format!(
                "is {}, but {} is {}; compare results of one cell",
                other.name,
                paths[0].display(),
                first.name
            );
            Err(Failure::input(path, what))
        }
    }
}

fn repetition(path: &Path, result: &Calibration) -> Result<Repetition, Failure> {
    let mount_from_camera = result.hand_eye.mount_from_camera.ok_or_else(|| {
        let what = "holds no transform (the data did not determine it); leave it out";
        Failure::input(path, what)
    })?;
    let covariance = result.hand_eye.covariance.mount_from_camera.as_ref().map(result::matrix);
    Ok(Repetition { mount_from_camera, covariance })
}

fn answer(
    paths: &[PathBuf],
    first: &Calibration,
    answers: &[Repetition],
    found: &Repeat,
) -> Answer {
    let pose = |k: usize| &answers[k].mount_from_camera;
    let all = 0..answers.len();
    let pairs = all.clone().flat_map(|a| (a + 1..answers.len()).map(move |b| (a, b)));
    let mm = |p: &Vector3<f64>| InUnits::of(scatter_at(p, answers, &found.mean), 1e3);
    let rotation = scatter_of_rotation(answers, &found.mean);
    Answer {
        agree: found.agreement.map(|a| a.is_given()),
        odd_one_out: found.odd_one_out.map(|k| paths[k].clone()),
        test: found.agreement,
        setup: first.setup,
        name: first.name.clone(),
        combined: Combined {
            mount_from_camera: found.mean,
            covariance: found.covariance.as_ref().map(result::rows),
        },
        spread: Spread {
            camera_origin_mm: mm(&Vector3::zeros()),
            half_a_metre_before_camera_mm: mm(&far()),
            rotation_deg: InUnits::of(rotation, 1_f64.to_degrees()),
        },
        from_mean: all.map(|k| difference(&paths[k..=k], &found.mean, pose(k))).collect(),
        pairs: pairs
            .map(|(a, b)| Difference {
                results: vec![paths[a].clone(), paths[b].clone()],
                ..difference(&[], pose(a), pose(b))
            })
            .collect(),
    }
}

/// For people, in 80 columns.
fn table(a: &Answer, count: usize) -> String {
    let mut text = format!("\n{}\n\n", sentence(a));
    let t = a.combined.mount_from_camera.translation() * 1e3;
    let [i, j, k, w] = quaternion_xyzw(&a.combined.mount_from_camera.iso().rotation);
    text += &format!("{}, combined of {count} results\n", a.name);
    text += &format!("  translation  {:11.3} {:11.3} {:11.3}   mm\n", t.x, t.y, t.z);
    text += &format!("  quaternion   {i:11.7} {j:11.7} {k:11.7} {w:11.7}   x y z w\n");
    text += &format!(
        "\n  {:<27}{:>8}{:>8}{:>9}{:>8}{:>8}{:>10}\n",
        "distance from the combined", "rms", "max", "rms x", "rms y", "rms z", "std dev"
    );
    text += &line("camera origin, mm", &a.spread.camera_origin_mm, 3);
    text += &line("0.5 m before the camera, mm", &a.spread.half_a_metre_before_camera_mm, 3);
    text += &line("rotation, degrees", &a.spread.rotation_deg, 4);
    text += &format!("\n  {:<31}{:>12}{:>14}{:>14}\n", "", "origin", "0.5 m before", "rotation");
    let numbered = |k: usize| format!("{}  {}", k + 1, shortened(&a.from_mean[k].results[0]));
    for (k, d) in a.from_mean.iter().enumerate() {
        text += &row(&numbered(k), d);
    }
    if count <= MOST_IN_TABLE {
        let index = |p: &PathBuf| 1 + a.from_mean.iter().take_while(|d| d.results[0] != *p).count();
        for d in &a.pairs {
            text += &row(&format!("{} - {}", index(&d.results[0]), index(&d.results[1])), d);
        }
    }
    text
}

fn sentence(a: &Answer) -> String {
    let Some(test) = &a.test else {
        return "NOT TESTED  a result states no covariance, so nothing says how far they may differ"
            .into();
    };
    let verdict = match (a.agree, &a.odd_one_out) {
        _ if test.is_of_shared_errors() => {
            "AGREE  the results differ by less than their covariances: they share errors (of\n       lens, target or robot), and the covariance of the combined one keeps these"
                .into()
        }
        (Some(true), _) => "AGREE  the results differ no more than their covariances allow".into(),
        (_, None) => {
            let what = "DISAGREE  the results differ by more than their covariances allow;";
            format!("{what}\n       the covariance of the combined one is as large as they spread")
        }
        (_, Some(odd)) => {
            format!("DISAGREE  {} is the odd one out:\n       the others agree", shortened(odd))
        }
    };
    format!(
        "{verdict}\n       chi-square {:.1} at {} degrees of freedom, {}",
        test.chi_square,
        test.degrees_of_freedom,
        chance(test.p_value)
    )
}

fn line(name: &str, s: &InUnits, digits: usize) -> String {
    let [x, y, z] = s.axes;
    format!(
        "  {name:<27}{:>8.digits$}{:>8.digits$}{x:>9.digits$}{y:>8.digits$}{z:>8.digits$}\
         {:>10.digits$}\n",
        s.rms, s.max, s.standard_deviation
    )
}

fn row(name: &str, d: &Difference) -> String {
    format!(
        "  {name:<31}{:>9.3} mm{:>11.3} mm{:>10.4} deg\n",
        d.camera_origin_mm, d.half_a_metre_before_camera_mm, d.rotation_deg
    )
}

/// The end of a path that fits into its column.
fn shortened(path: &Path) -> String {
    const WIDTH: usize = 26;
    let whole: Vec<char> = path.to_string_lossy().chars().collect();
    match whole.len() > WIDTH {
        true => format!("..{}", whole[whole.len() - WIDTH + 2..].iter().collect::<String>()),
        false => whole.into_iter().collect(),
    }
}
