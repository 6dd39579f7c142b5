//! What of a given lens has changed, in words.

use crate::{Calibration, Intrinsics, Session, Warning, calibrate::result::CameraResult};

/// A parameter has changed when it moved by more than so many standard deviations.
const CHANGED: f64 = 2.0;
/// Half a pixel is told from none, and from a whole one, within so many.
const CLEARLY: f64 = 3.0;

/// A parameter: its name, what was given, what was found, and the standard deviation of that.
type Moved = (&'static str, f64, f64, f64);

/// Says in the warning of a lens that was moved which of its parameters changed.
pub(super) fn tell(session: &Session, result: &mut Calibration) {
    let (Some(given), Some(found)) = (session.camera, &result.camera) else { return };
    let message = message(&given, found);
    let of_lens = |w: &&mut Warning| w.code == "camera-refined";
    if let Some(warning) = result.warnings.iter_mut().find(of_lens) {
        warning.message = message;
    }
}

fn message(given: &Intrinsics, found: &CameraResult) -> String {
    let now = &found.intrinsics;
    let all: [Moved; 4] = [
        ("fx", given.fx, now.fx, found.sigma_fx),
        ("fy", given.fy, now.fy, found.sigma_fy),
        ("cx", given.cx, now.cx, found.sigma_cx),
        ("cy", given.cy, now.cy, found.sigma_cy),
    ];
    let changed = |(_, from, to, sigma): &&Moved| (to - from).abs() > CHANGED * sigma;
    let words: Vec<String> = all
        .iter()
        .filter(changed)
        .map(|(name, from, to, sigma)| format!("{name} {from:.2} -> {to:.2} (+- {sigma:.2}) px"))
        .collect();
    let what = match words.is_empty() {
        true => "its distortion has changed, focal lengths and principal point have not".into(),
        false => words.join(", "),
    };
    let half = if is_half_a_pixel(&all) { HALF } else { "" };
    format!(
        "pictures and robot poses fit together only with another lens than the one given: {what}; it \
         is used here and stands in the result: use it for pictures too, or calibrate the camera again\
         {half}"
    )
}

const HALF: &str = ". Half a pixel in x and y: cx and cy as given seem to count from the corner of the \
                    first pixel where the target's corners count from its centre, or the other way \
                    round; if so, correct them";

/// Whether the principal point alone has moved, by half a pixel both ways.
fn is_half_a_pixel([fx, fy, cx, cy]: &[Moved; 4]) -> bool {
    let stands = |(_, from, to, sigma): &Moved| (to - from).abs() < CLEARLY * sigma;
    let half = |(_, from, to, sigma): &Moved, by: f64| {
        let off = to - from;
        CLEARLY * sigma < by.abs() && (off - by).abs() < CLEARLY * sigma
    };
    stands(fx) && stands(fy) && [0.5, -0.5].into_iter().any(|by| half(cx, by) && half(cy, by))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Distortion;

    fn given() -> Intrinsics {
        Intrinsics {
            width: 1920,
            height: 1200,
            fx: 1800.0,
            fy: 1800.0,
            cx: 960.0,
            cy: 600.0,
            distortion: Distortion::None,
        }
    }

    fn told(intrinsics: Intrinsics) -> String {
        let found =
            CameraResult { intrinsics, sigma_fx: 0.2, sigma_fy: 0.2, sigma_cx: 0.1, sigma_cy: 0.1 };
        message(&given(), &found)
    }

    #[test]
    fn only_what_changed_is_told() {
        let longer = told(Intrinsics { fx: 1805.0, fy: 1800.1, ..given() });
        assert!(longer.contains("fx 1800.00 -> 1805.00 (+- 0.20) px; it is used"), "{longer}");
        assert!(!longer.contains("fy") && !longer.contains("cx"), "{longer}");
        let bent = told(given());
        assert!(bent.contains("its distortion has changed"), "{bent}");
    }

    #[test]
    fn half_a_pixel_is_named() {
        let half = told(Intrinsics { cx: 959.45, cy: 599.56, ..given() });
        assert!(half.contains("cx 960.00 -> 959.45") && half.contains("Half a pixel"), "{half}");
        for other in [
            Intrinsics { cx: 959.5, cy: 600.5, ..given() },
            Intrinsics { cx: 959.5, ..given() },
            Intrinsics { cx: 959.5, cy: 599.5, fx: 1803.0, ..given() },
        ] {
            assert!(!told(other).contains("Half a pixel"), "{other:?}");
        }
    }
}
