//! `handeye register`: where one scan lies in another, or in a mesh.

use std::{
    fs,
    path::{Path, PathBuf},
    time::Instant,
};

use handeye::{
    Scan, TriangleMesh, Verdict, Warning,
    register::{DenseConfig, DenseMethod, Surface, register_surfaces},
};
use handeye_io::{
    Error, FoundPlace, RegistrationResult, ScanOptions, Transform, is_mesh, parallel, points_on,
    read_intrinsics, read_mesh, read_scan,
    report::{NamedCloud, Registration, registration_html},
    robot::rotation_near,
    scan_size, scan_unit, spacing_on,
    units::LengthUnit,
    write_atomically,
};
use nalgebra::{Isometry3, Matrix3, Quaternion, Translation3, UnitQuaternion};
use serde::{Deserialize, Serialize};

use crate::{
    args::{GlobalArgs, Reading, RegisterArgs},
    failure::Failure,
    output,
};

/// A scan that is wider than this, in its own unit, is taken to be in millimetres.
const WIDEST_M: f64 = 20.0;
/// The inner part of such a scan is wider than this: else a few points lie far from all others.
const INNER_M: f64 = 4.0;
/// One in so many points, at each end of an axis, is not asked how wide a scan is, and how wide its inner part is.
const BEYOND: (usize, usize) = (100, 10);
/// Rotations may be off by so much from one of length one.
const ROUNDED: f64 = 1e-3;

/// What `--initial` may hold.
#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "neither a transform {\"translation_m\": [x, y, z], \"rotation_xyzw\": [x, y, z, w]}, alone or \
                 as \"target_from_source\", nor a matrix of 4 rows"
)]
enum Initial {
    Named { target_from_source: Transform },
    Plain(Transform),
    Framed(Framed),
    Matrix([[f64; 4]; 4]),
}

/// A pose with the names of its frames, as `import` writes it.
#[derive(Deserialize)]
struct Framed {
    #[serde(rename = "to")]
    _to: String,
    #[serde(rename = "from")]
    _from: String,
    translation_m: [f64; 3],
    rotation_xyzw: [f64; 4],
}

#[derive(Serialize)]
struct Seconds {
    read: f64,
    prepare: f64,
    iterate: f64,
}

#[derive(Serialize)]
struct Answer {
    #[serde(flatten)]
    found: RegistrationResult,
    method: &'static str,
    points: [usize; 2],
    seconds: Seconds,
    warnings: Vec<Warning>,
}

pub fn run(args: &RegisterArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let config = config(args)?;
    let method = config.method.name();
    let inputs = [Some(&args.source), Some(&args.target), args.initial.as_ref()];
    if let Some(page) = &args.report {
        is_no_input(page, inputs.into_iter().flatten())?;
    }
    let start = args.initial.as_deref().map_or(Ok(Isometry3::identity()), initial)?;
    let mut warnings = vec![];
    let began = Instant::now();
    let source = read(&args.source, &args.reading, &mut warnings)?;
    let target = read(&args.target, &args.reading, &mut warnings)?;
    let read = began.elapsed();
    let surfaces = [surface(&source, config.threads)?, surface(&target, config.threads)?];
    let prepared = began.elapsed();
    let found = register_surfaces(&surfaces[0], &surfaces[1], &start, &config);
    if found.verdict == Verdict::Rejected && args.initial.is_none() && !args.global {
        let what = "no initial guess was given, so the identity was used: give --initial FILE, or search with --global";
        warnings.push(Warning::new("no-start", what));
    }
    let seconds = Seconds {
        read: read.as_secs_f64(),
        prepare: (prepared - read).as_secs_f64(),
        iterate: (began.elapsed() - prepared).as_secs_f64(),
    };
    if let Some(page) = &args.report {
        let html = registration_html(&Registration {
            source: NamedCloud { name: &name_of(&args.source), points: source.scan.points() },
            target: NamedCloud { name: &name_of(&args.target), points: target.scan.points() },
            start,
            found: &found,
            method,
            gate_m: config.max_correspondence_distance_m,
            seconds: [seconds.read, seconds.prepare, seconds.iterate],
            warnings: &warnings,
            threads: config.threads,
        });
        write_atomically(page, html.as_bytes())?;
    }
    let points = [&source, &target].map(|input| seen(input.scan.points()).count());
    let found = RegistrationResult::from(&found);
    let answer = Answer { found, method, points, seconds, warnings };
    if global.json {
        output::json(&answer);
    } else {
        output::warn(&answer.warnings, global);
        output::print(&text(&answer));
    }
    if let Some(page) = args.report.as_ref().filter(|_| !global.quiet) {
        crate::output::note!("report: {}", page.display());
    }
    Ok(if answer.found.verdict == Verdict::Accepted { 0 } else { 3 })
}

/// How to compare.
fn config(args: &RegisterArgs) -> Result<DenseConfig, Failure> {
    let gate = args.max_distance_mm.unwrap_or(50.0);
    if !(gate > 0.0 && gate.is_finite()) {
        return Err(Failure::Usage("--max-distance-mm must be positive".into()));
    }
    if args.max_iterations == 0 {
        return Err(Failure::Usage("--max-iterations must be positive".into()));
    }
    Ok(DenseConfig {
        method: method(&args.method)?,
        max_correspondence_distance_m: gate * 1e-3,
        max_iterations: args.max_iterations,
        global: args.global,
        threads: parallel::all_cores(),
        ..DenseConfig::default()
    })
}

fn surface(input: &Input, threads: usize) -> Result<Surface, Failure> {
    let found = match &input.mesh {
        Some(mesh) => Surface::of_mesh(mesh, spacing_on(mesh))
            .map_err(|error| Failure::input(input.path, error.to_string()))?,
        None => Surface::of(&input.scan, threads),
    };
    found.ok_or_else(|| {
        let what =
            "shows no surface: its points are too few, lie on a line, or lie far from all others";
        Failure::input(input.path, what)
    })
}

/// A page that would take the place of what it shows is refused.
pub fn is_no_input<'a>(
    page: &Path,
    mut inputs: impl Iterator<Item = &'a PathBuf>,
) -> Result<(), Failure> {
    let Ok(there) = page.canonicalize() else { return Ok(()) };
    if inputs.any(|input| input.canonicalize().is_ok_and(|input| input == there)) {
        let what = format!("{} would be written over: name another page", page.display());
        return Err(Failure::Usage(what));
    }
    Ok(())
}

/// A file's name without its folder.
pub fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

fn method(name: &str) -> Result<DenseMethod, Failure> {
    DenseMethod::from_name(name).ok_or_else(|| {
        let names = DenseMethod::ALL.map(DenseMethod::name).join(", ");
        Failure::Usage(format!("no method {name:?}; there are {names}"))
    })
}

/// A start: a transform, an answer of this command, or a matrix.
pub fn initial(path: &Path) -> Result<Isometry3<f64>, Failure> {
    let text = fs::read_to_string(path).map_err(|error| Failure::unreadable(path, &error))?;
    let read: Initial =
        serde_json::from_str(&text).map_err(|error| Failure::in_json(path, &error, ""))?;
    let wrong = |what: &str| Failure::input(path, what.to_owned());
    let (t, rotation) = match read {
        Initial::Named { target_from_source: Transform { translation_m, rotation_xyzw } }
        | Initial::Plain(Transform { translation_m, rotation_xyzw })
        | Initial::Framed(Framed { translation_m, rotation_xyzw, .. }) => {
            let [x, y, z, w] = rotation_xyzw;
            let q = Quaternion::new(w, x, y, z);
            if !((q.norm() - 1.0).abs() < ROUNDED) {
                return Err(wrong("the rotation is no quaternion of length one (x, y, z, w)"));
            }
            (translation_m, UnitQuaternion::from_quaternion(q))
        }
        Initial::Matrix(m) => {
            let r = Matrix3::from_fn(|i, j| m[i][j]);
            let rotation = rotation_near(&r).ok().filter(|_| m[3] == [0.0, 0.0, 0.0, 1.0]);
            let Some(rotation) = rotation else {
                return Err(wrong(
                    "the matrix is no rigid transform: three rows of rotation and translation (m), then \
                     0 0 0 1",
                ));
            };
            ([m[0][3], m[1][3], m[2][3]], rotation)
        }
    };
    if !t.iter().all(|x| x.abs() < 1e6) {
        return Err(wrong("the translation is not in metres, or not finite"));
    }
    Ok(Isometry3::from_parts(Translation3::from(nalgebra::Vector3::from(t)), rotation))
}

/// A scan, or points laid over a mesh.
struct Input<'a> {
    path: &'a Path,
    scan: Scan,
    mesh: Option<TriangleMesh>,
}

/// Reads a scan, or a mesh, in the unit that was said or that its width tells.
fn read<'a>(
    path: &'a Path,
    args: &Reading,
    warnings: &mut Vec<Warning>,
) -> Result<Input<'a>, Failure> {
    if !is_mesh(path) {
        return Ok(Input { path, scan: read_points(path, args, warnings)?, mesh: None });
    }
    let mesh = read_triangles(path, args, warnings)?;
    let scan = points_on(&mesh).map_err(|error| Failure::input(path, error.to_string()))?;
    Ok(Input { path, scan, mesh: Some(mesh) })
}

/// Reads a scan.
pub fn read_points(
    path: &Path,
    args: &Reading,
    warnings: &mut Vec<Warning>,
) -> Result<Scan, Failure> {
    let intrinsics = match &args.camera {
        Some(camera) => Some(read_intrinsics(camera, None, scan_size(path)?)?),
        None => None,
    };
    let unit = scan_unit(path).or(args.length_unit.map(LengthUnit::from));
    let options = ScanOptions {
        length_unit: unit.or(intrinsics.is_none().then_some(LengthUnit::Metre)),
        depth_scale: args.depth_scale,
        organised: None,
        intrinsics,
    };
    let scan = read_scan(path, &options).map_err(undeclared)?;
    // what a depth image says of its unit, its scale says
    if unit.is_some() || intrinsics.is_some() || !is_in_millimetres(scan.points(), path, warnings) {
        return Ok(scan);
    }
    Scan::new(scan.width(), scan.height(), from_millimetres(scan.points()))
        .ok_or_else(|| Failure::input(path, "has no points"))
}

/// Reads a mesh.
pub fn read_triangles(
    path: &Path,
    args: &Reading,
    warnings: &mut Vec<Warning>,
) -> Result<TriangleMesh, Failure> {
    let unit = args.length_unit.map(LengthUnit::from);
    let mesh = read_mesh(path, Some(unit.unwrap_or(LengthUnit::Metre)))?;
    // most vertices may be those of one hole
    let width = width(mesh.vertices(), usize::MAX);
    if unit.is_some() || width <= WIDEST_M {
        return Ok(mesh);
    }
    assume_millimetres(width, path, warnings);
    TriangleMesh::new(from_millimetres(mesh.vertices()), mesh.triangles().to_vec())
        .map_err(|error| Failure::input(path, error.to_string()))
}

/// Points too far apart for metres are in millimetres, and that is said.
fn is_in_millimetres(points: &[[f32; 3]], path: &Path, warnings: &mut Vec<Warning>) -> bool {
    let width = width(points, BEYOND.0);
    if width <= WIDEST_M || self::width(points, BEYOND.1) <= INNER_M {
        return false;
    }
    assume_millimetres(width, path, warnings);
    true
}

fn assume_millimetres(width: f64, path: &Path, warnings: &mut Vec<Warning>) {
    warnings.push(Warning::new(
        "unit-assumed",
        format!(
            "{}: it is {width:.0} units wide, which is taken for millimetres: say --length-unit m if they \
             are metres",
            path.display()
        ),
    ));
}

fn from_millimetres(points: &[[f32; 3]]) -> Vec<[f32; 3]> {
    points.iter().map(|p| p.map(|x| x * 1e-3)).collect()
}

/// Names the option where a manifest would have a key.
fn undeclared(error: Error) -> Failure {
    let Error::Undeclared { place, key, question } = &error else { return error.into() };
    let option = match key.as_str() {
        "depth_scale" => "--depth-scale",
        "length_unit" => "--length-unit",
        _ => "--camera",
    };
    Failure::input(
        &place.file,
        format!("{option} is missing: {}", question.replace(" (or [camera])", "")),
    )
}

fn seen(points: &[[f32; 3]]) -> impl Iterator<Item = &[f32; 3]> {
    points.iter().filter(|p| p[0].is_finite())
}

/// The longest side of a box without one in so many points beyond each side.
fn width(points: &[[f32; 3]], one_in: usize) -> f64 {
    let beyond = seen(points).count() / one_in;
    (0..3).fold(0.0, |widest, axis| {
        let mut values: Vec<f32> = seen(points).map(|p| p[axis]).collect();
        let Some(last) = values.len().checked_sub(1 + beyond) else { return widest };
        let high = *values.select_nth_unstable_by(last, f32::total_cmp).1;
        let low = *values.select_nth_unstable_by(beyond, f32::total_cmp).1;
        f64::max(widest, f64::from(high) - f64::from(low))
    })
}

fn text(a: &Answer) -> String {
    let three = |v: &[f64; 3]| v.map(|x| format!("{x:12.3}")).join("");
    let mut text = format!("\n{}\n", output::verdict(a.found.verdict));
    text += &a.found.reasons.iter().map(|reason| output::wrapped("  ", reason)).collect::<String>();
    let pose = &a.found.target_from_source;
    let q = pose.rotation_xyzw.map(|x| format!("{x:12.6}")).join("");
    text += &format!(
        "\ntarget from source\n  translation  {}   mm\n  quaternion   {q}   x y z w\n",
        three(&pose.translation_m.map(|x| 1e3 * x))
    );
    text += &places(&a.found.places);
    if let (Some(mm), Some(deg)) = (&a.found.sigma_mm, &a.found.sigma_deg) {
        text += &format!(
            "  one sigma    {}   mm\n               {}   deg, in the source's axes\n",
            three(mm),
            three(deg)
        );
    }
    let Some(rms) = a.found.rms_mm else { return text };
    if let (Some(ratio), Some(sigma)) = (a.found.size_ratio, a.found.size_sigma) {
        let (percent, sigma) = (100.0 * (ratio - 1.0), 100.0 * sigma);
        text += &format!(
            "  size         {percent:+12.3} %, one sigma {sigma:.3} %; target over source\n"
        );
    }
    text += "\n";
    text + &output::wrapped(
        "",
        &format!(
            "{:.0} % of the source lies on the target, with an RMS residual of {:.3} mm (matches, without \
             outliers); where both show something, {:.1} % agree.{} {} rounds ({}). Read in {:.2} s, prepared in {:.2} s, registered in {:.2} s.",
            100.0 * a.found.inlier_fraction,
            rms,
            100.0 * a.found.agreement,
            explained(a.found.explained),
            a.found.iterations,
            a.found.stop,
            a.seconds.read,
            a.seconds.prepare,
            a.seconds.iterate,
        ),
    )
}

/// Those after the first, which is the answer.
fn places(all: &[FoundPlace]) -> String {
    let row = |place: &FoundPlace| {
        let Transform { translation_m, rotation_xyzw } = &place.target_from_source;
        let t = translation_m.map(|x| format!("{:10.3}", 1e3 * x)).join("");
        let q = rotation_xyzw.map(|x| format!("{x:10.5}")).join("");
        format!("  {t}{q}\n")
    };
    if all.is_empty() {
        return String::new();
    }
    format!(
        "\nequally good places: mm; x y z w\n{}\n",
        all.iter().skip(1).map(row).collect::<String>()
    )
}

fn explained(share: Option<f64>) -> String {
    share.map_or(String::new(), |share| {
        format!(" Of the scan in the part's box, {:.0} % lies on the part.", 100.0 * share)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on a square of this side, at this height.
    fn square(count: usize, side: f32, z: f32) -> impl Iterator<Item = [f32; 3]> {
        let at = move |k: usize| (k as f32 * 0.754_877_7) % 1.0 * side;
        (0..count).map(move |k| [at(k), at(3 * k), z])
    }

    fn in_millimetres(points: &[[f32; 3]]) -> bool {
        is_in_millimetres(points, Path::new("scan.ply"), &mut vec![])
    }

    #[test]
    fn the_unit_is_that_of_most_points() {
        let part: Vec<_> = square(9000, 18.0, 600.0).chain(square(1000, 600.0, 640.0)).collect();
        assert!(in_millimetres(&part), "a small part on a wide floor");
        assert!(in_millimetres(&square(9000, 22.0, 300.0).collect::<Vec<_>>()), "a small part");
        let strays = || square(300, 60.0, 65.535);
        let scan: Vec<_> = square(9000, 0.8, 0.6).chain(strays()).collect();
        assert!(!in_millimetres(&scan), "a scan in metres with pixels at the end of their range");
        assert!(!in_millimetres(&[]), "nothing");
    }
}
