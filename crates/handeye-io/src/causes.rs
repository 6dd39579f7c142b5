//! One cause for several warnings. A board that is bent, or a scan that reads black elsewhere than white, also moves the
//! lens, the depth, or pictures against scans, as far as it is bent or off itself; that is said with the cause, and not
//! once more as if it were a fault of its own.

use handeye::{
    Calibration, Intrinsics, Session, calibrate::result::ScanResult, math::linalg::median,
    mistakes::flatness,
};

/// Warnings that a cause explains, and their words beside it.
const EFFECTS: [(&str, &str); 5] = [
    ("camera-refined", "another lens than the one given"),
    ("depth-off", "depth that is off"),
    ("picture-and-scan-scale", "scans of another scale than pictures"),
    ("picture-and-scan-tilt", "scans turned against pictures"),
    ("picture-and-scan-shift", "scans shifted against pictures"),
];

/// Says with a cause what it explains, and only there.
pub(crate) fn tell(result: &mut Calibration, session: &Session) {
    let Some(scans) = result.scans.clone() else { return };
    let bend = scans.flatness.as_ref().map_or(0.0, |f| f.peak_to_valley_mm);
    let step = scans.colour_step.as_ref().map_or(0.0, |s| s.black_minus_white_mm.abs());
    for (cause, size_mm) in [("board-not-flat", bend), ("depth-by-colour", step)] {
        let Some(at) = result.warnings.iter().position(|w| w.code == cause) else { continue };
        let explained: Vec<(&str, &str)> = EFFECTS
            .into_iter()
            .filter(|(code, _)| result.warnings.iter().any(|w| w.code == *code))
            .filter(|(code, _)| {
                effect_mm(code, result, session, &scans).is_some_and(|e| e < size_mm)
            })
            .collect();
        if explained.is_empty() {
            continue;
        }
        let words: Vec<&str> = explained.iter().map(|(_, words)| *words).collect();
        result.warnings[at].message += &format!(
            "; it also looks like {}, no farther off than this explains, and the answer takes that into \
             account: mend this first",
            words.join(" and ")
        );
        result.warnings.retain(|w| explained.iter().all(|(code, _)| w.code != *code));
    }
}

/// How far a warning's effect moves what the camera sees of the board, mm.
fn effect_mm(
    code: &str,
    result: &Calibration,
    session: &Session,
    scans: &ScanResult,
) -> Option<f64> {
    let seen = result.captures.iter().filter_map(|c| c.camera_from_target);
    let distance = median(seen.map(|pose| pose.translation().z)) * 1e3;
    let target = session.target.as_ref()?;
    let norm = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    match code {
        "camera-refined" => {
            let now = result.camera.as_ref()?.intrinsics;
            Some(lens_moved(&session.camera?, &now) * distance)
        }
        "depth-off" => {
            let depth = result.depth.as_ref()?;
            Some(((depth.scale - 1.0) * distance + depth.bias_mm).abs())
        }
        "picture-and-scan-scale" => Some(scans.frames.as_ref()?.scale.abs() * distance),
        "picture-and-scan-tilt" => {
            let tilt = norm(&scans.frames.as_ref()?.tilt_deg).to_radians();
            Some(tilt * flatness::extent(target) * 1e3)
        }
        "picture-and-scan-shift" => Some(norm(&scans.frames.as_ref()?.shift_mm)),
        _ => None,
    }
}

/// By how much directions, and the distances that they tell, differ between two lenses.
fn lens_moved(given: &Intrinsics, now: &Intrinsics) -> f64 {
    let focal = (now.fx / given.fx - 1.0).abs().max((now.fy / given.fy - 1.0).abs());
    let centre = ((now.cx - given.cx) / given.fx).hypot((now.cy - given.cy) / given.fy);
    focal.max(centre)
}
