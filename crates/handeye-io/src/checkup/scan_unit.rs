//! Whether the scans are in another unit than declared: they put the target so many times as far away as the images do.

use handeye::{Session, SurfaceCorner, detect, math::linalg::median};

use super::{Change, Explanation, amend};
use crate::{Dataset, measure::Measured, units::LengthUnit};

/// Units that scans come in.
const UNITS: [LengthUnit; 4] =
    [LengthUnit::Metre, LengthUnit::Millimetre, LengthUnit::Centimetre, LengthUnit::Inch];
/// A factor that is this near to that of two units is one: cameras and targets are better than that.
const ABOUT: f64 = 0.1;
/// Factors below this may be a target of another size: those of an inch and a centimetre, or of 10.
const AMBIGUOUS: f64 = 30.0;
/// Captures whose scans are read anew where none of them could be laid on the target.
const MOST_SCANS: usize = 3;
/// A factor of whole scans, which show other things than the target, is that of two units within this factor.
const ROUGHLY: f64 = 3.0;

/// The unit in which scans and images agree, where it is another one.
pub(crate) fn wrong_scan_unit(
    dataset: &Dataset,
    measured: &Measured,
    manifest: &str,
) -> Option<Explanation> {
    let ratio = of_corners(&measured.session);
    let (factor, is_rough) = match ratio {
        Some(ratio) => (ratio, false),
        None => (of_whole_scans(dataset, measured)?, true),
    };
    let declared = amend::value(manifest, "scans", "length_unit");
    let is_read = |unit: &LengthUnit| {
        declared.as_deref().is_none_or(|name| name.trim_matches('"') == unit.name())
    };
    let near = |(read, meant): &(LengthUnit, LengthUnit)| {
        let off = factor / (meant.metres() / read.metres());
        let limit = if is_rough { ROUGHLY } else { 1.0 + ABOUT };
        read != meant && off < limit && off * limit > 1.0
    };
    // metres and millimetres before centimetres: the usual two
    let pairs = UNITS.into_iter().filter(is_read).flat_map(|read| UNITS.map(|meant| (read, meant)));
    let (read, meant) = pairs.into_iter().find(near)?;
    Some(explanation(manifest, read, meant))
}

fn explanation(manifest: &str, read: LengthUnit, meant: LengthUnit) -> Explanation {
    let times = meant.metres() / read.metres();
    let (factor, nearer) = if times > 1.0 { (times, "nearer") } else { (1.0 / times, "farther") };
    let other = match factor < AMBIGUOUS {
        true => "; or the target's size is wrong by that factor: measure it",
        false => "",
    };
    let with_unit = amend::value(manifest, "scans", "length_unit").is_some();
    let scale = amend::value(manifest, "scans", "depth_scale").and_then(|v| v.parse::<f64>().ok());
    let (words, changes) = match (with_unit, scale) {
        (false, Some(scale)) => (
            format!("depth_scale is wrong by a factor of {factor}"),
            vec![change("depth_scale", format!("{:?}", scale * times))],
        ),
        _ => (
            format!("their points are in {}, not {}", meant.name(), read.name()),
            vec![change("length_unit", format!("\"{}\"", meant.name()))],
        ),
    };
    let message = format!(
        "the scans have another unit than declared: {words}. Read as declared, they put the target {factor} times \
         {nearer} than the images do{other}"
    );
    Explanation::new("scan-unit", message, changes)
}

fn change(key: &str, value: String) -> Change {
    Change { table: "scans", key: key.to_owned(), value }
}

/// How many times as far away as in the scans the target's corners are in the images (median).
fn of_corners(session: &Session) -> Option<f64> {
    let (target, camera) = (session.target.as_ref()?, session.camera.as_ref()?);
    let ratios: Vec<f64> = session
        .observations
        .iter()
        .filter(|o| !o.surface.is_empty())
        .filter_map(|o| {
            let pose = detect::target_poses(&o.corners, &[], target, camera).ok()?;
            let pose = pose.first()?.pose.camera_from_target;
            let ratio = |s: &SurfaceCorner| {
                let seen = (pose * target.corner(s.id)?).vector().norm();
                Some(seen / s.in_camera.vector().norm())
            };
            Some(median(o.surface.iter().filter_map(ratio)))
        })
        .collect();
    (!ratios.is_empty()).then(|| median(ratios))
}

/// The same of all points of some scans, of which the target is a part.
fn of_whole_scans(dataset: &Dataset, measured: &Measured) -> Option<f64> {
    let captures = dataset.captures.iter().zip(&measured.session.observations);
    let with_both = captures.filter_map(|(c, o)| Some((c.scan.as_ref()?, o.candidates.first()?)));
    let ratio = |(path, pose): (&std::path::PathBuf, &handeye::TargetPose)| {
        let scan = dataset.scan(path).ok()?;
        let depth = scan.points().iter().map(|p| f64::from(p[2])).filter(|z| z.is_finite());
        let seen = pose.camera_from_target.translation().norm();
        Some(seen / median(depth))
    };
    let ratios: Vec<f64> = with_both.take(MOST_SCANS).filter_map(ratio).collect();
    (!ratios.is_empty()).then(|| median(ratios)).filter(|r| r.is_finite() && *r > 0.0)
}
