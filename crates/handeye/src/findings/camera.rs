//! Findings about intrinsics and the depth of scans.

use super::{Found, row::Row};
use crate::Intrinsics;

/// What is found about the camera.
#[derive(Debug, Clone, PartialEq)]
pub enum CameraFinding {
    /// The given intrinsics do not fit; the answer uses others.
    Refined {
        /// The parameters that moved.
        changed: Vec<Moved>,
        /// Whether the principal point alone moved, by half a pixel both ways.
        half_pixel: bool,
    },
    /// None were given, and the views of the target gave them.
    CalibratedFromViews {
        /// How they were found.
        calibrated: FromViews,
        /// As refined with the robot's poses, where the answer uses that.
        used: Option<Intrinsics>,
    },
    /// They were given without distortion, and the corners show one.
    Bends {
        /// The radial distortion.
        k1: f64,
        /// Its standard deviation.
        sigma: f64,
        /// RMS residual as given, px.
        rms_given_px: f64,
        /// RMS residual with it, px.
        rms_px: f64,
    },
    /// Scans read black at another depth than white.
    DepthByColour {
        /// Depth on black minus that on white, mm.
        black_minus_white_mm: f64,
        /// Its standard deviation.
        sigma_mm: f64,
        /// Noise of a corner's depth, mm.
        noise_mm: f64,
        /// Corners of all captures that have no depth because of it.
        corners_without_depth: usize,
    },
    /// The depth of scans is off; the answer takes it into account.
    DepthOff {
        /// Measured over true depth.
        scale: f64,
        /// Its standard deviation.
        sigma_scale: f64,
        /// What is read beside that, mm.
        bias_mm: f64,
        /// Its standard deviation.
        sigma_bias_mm: f64,
    },
}

/// Intrinsics from the views of the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FromViews {
    /// Views of the target.
    pub views: usize,
    /// RMS residual, px.
    pub rms_px: f64,
    /// Focal lengths, px.
    pub focal_px: [f64; 2],
}

/// A parameter of the intrinsics that is not as it was given, px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moved {
    /// `fx`, `fy`, `cx` or `cy`.
    pub name: &'static str,
    /// As given.
    pub from: f64,
    /// As found.
    pub to: f64,
    /// Standard deviation of what was found.
    pub sigma: f64,
}

impl Moved {
    /// Names of what was found and of its standard deviation, with unit.
    fn names(&self) -> [&'static str; 2] {
        match self.name {
            "fx" => ["fx_px", "sigma_fx_px"],
            "fy" => ["fy_px", "sigma_fy_px"],
            "cx" => ["cx_px", "sigma_cx_px"],
            _ => ["cy_px", "sigma_cy_px"],
        }
    }
}

/// A parameter has changed when it moved by more than so many standard deviations.
const CHANGED: f64 = 2.0;
/// Half a pixel is told from none, and from a whole one, within so many.
const CLEARLY: f64 = 3.0;

impl CameraFinding {
    /// The finding that intrinsics moved; `sigma` of fx, fy, cx and cy.
    pub fn refined(given: &Intrinsics, now: &Intrinsics, sigma: [f64; 4]) -> Self {
        let moved = |name, from, to, sigma| Moved { name, from, to, sigma };
        let all = [
            moved("fx", given.fx, now.fx, sigma[0]),
            moved("fy", given.fy, now.fy, sigma[1]),
            moved("cx", given.cx, now.cx, sigma[2]),
            moved("cy", given.cy, now.cy, sigma[3]),
        ];
        let changed = |m: &Moved| (m.to - m.from).abs() > CHANGED * m.sigma;
        Self::Refined {
            changed: all.iter().copied().filter(changed).collect(),
            half_pixel: is_half_a_pixel(&all),
        }
    }
}

const CAMERA_REFINED: Row = Row::changes(
    "camera-refined",
    "the answer uses refined intrinsics, not the given ones",
    "use the intrinsics in `camera` for your images too, or calibrate the camera again",
);
const CAMERA_CALIBRATED_FROM_VIEWS: Row = Row::info("camera-calibrated-from-views");
const CAMERA_BENDS: Row = Row::changes(
    "camera-bends",
    "the answer uses a distortion that was not given",
    "calibrate the camera's distortion",
);
const DEPTH_BY_COLOUR: Row = Row::changes(
    "depth-by-colour",
    "depth on black was corrected to that on white",
    "take a board of matt grey and white",
);
const DEPTH_OFF: Row = Row::changes(
    "depth-off",
    "the answer corrects the depth of the scans",
    "correct the points of this camera as `depth` says, or have its depth calibrated",
);

/// All codes of this subject.
pub(super) const ROWS: &[&Row] =
    &[&CAMERA_REFINED, &CAMERA_CALIBRATED_FROM_VIEWS, &CAMERA_BENDS, &DEPTH_BY_COLOUR, &DEPTH_OFF];

impl Found for CameraFinding {
    fn row(&self) -> &'static Row {
        match self {
            Self::Refined { .. } => &CAMERA_REFINED,
            Self::CalibratedFromViews { .. } => &CAMERA_CALIBRATED_FROM_VIEWS,
            Self::Bends { .. } => &CAMERA_BENDS,
            Self::DepthByColour { .. } => &DEPTH_BY_COLOUR,
            Self::DepthOff { .. } => &DEPTH_OFF,
        }
    }

    fn message(&self) -> String {
        match self {
            Self::Refined { changed, half_pixel } => format!(
                "the given intrinsics do not fit images and robot poses; refined: {}. The result uses the refined intrinsics (key `camera`); use them for your images too, or recalibrate the camera{}",
                in_words(changed),
                if *half_pixel { HALF } else { "" }
            ),
            Self::CalibratedFromViews { calibrated, used } => calibrated.message(used.as_ref()),
            Self::Bends { k1, sigma, rms_given_px, rms_px } => format!(
                "the camera is given without distortion, but the target's corners show one: k1 = {k1:.3} +- \
                 {sigma:.3} reduces their residual from {rms_given_px:.3} to {rms_px:.3} px RMS and is used; calibrate the camera with a board all over the image"
            ),
            Self::DepthByColour {
                black_minus_white_mm,
                sigma_mm,
                noise_mm,
                corners_without_depth,
            } => by_colour(*black_minus_white_mm, *sigma_mm, *noise_mm, *corners_without_depth),
            Self::DepthOff { scale, sigma_scale, bias_mm, sigma_bias_mm } => format!(
                "the depth of the scans is off by {:+.3} +- {:.3} % and {bias_mm:+.2} +- {sigma_bias_mm:.2} mm: the answer corrects it, and the points of this camera must be corrected too, z = (z' - {bias_mm:.3} \
                 mm)/{scale:.5}; let it warm up, and calibrate its depth",
                (scale - 1.0) * 100.0,
                sigma_scale * 100.0,
            ),
        }
    }

    fn headline(&self) -> Option<String> {
        match self {
            Self::Refined { changed, .. } => {
                let first = changed.first()?;
                Some(format!(
                    "the answer uses refined intrinsics ({} {:.2} -> {:.2} px), not the given ones",
                    first.name, first.from, first.to
                ))
            }
            Self::DepthOff { scale, bias_mm, .. } => Some(format!(
                "the answer corrects the depth of the scans ({:+.2} %, {bias_mm:+.2} mm)",
                (scale - 1.0) * 100.0
            )),
            Self::Bends { k1, .. } => {
                Some(format!("the answer uses a distortion that was not given (k1 = {k1:.3})"))
            }
            Self::DepthByColour { black_minus_white_mm, .. } => Some(format!(
                "depth on black, off by {black_minus_white_mm:+.2} mm, was corrected to that on white"
            )),
            Self::CalibratedFromViews { .. } => None,
        }
    }

    fn data(&self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Refined { changed, .. } => {
                changed.iter().flat_map(|m| m.names().into_iter().zip([m.to, m.sigma])).collect()
            }
            Self::CalibratedFromViews { calibrated, .. } => {
                vec![("views", calibrated.views as f64), ("rms_px", calibrated.rms_px)]
            }
            Self::Bends { k1, sigma, .. } => vec![("k1", *k1), ("sigma", *sigma)],
            Self::DepthByColour { black_minus_white_mm, sigma_mm, .. } => {
                vec![("black_minus_white_mm", *black_minus_white_mm), ("sigma_mm", *sigma_mm)]
            }
            Self::DepthOff { scale, sigma_scale, bias_mm, sigma_bias_mm } => vec![
                ("scale", *scale),
                ("sigma_scale", *sigma_scale),
                ("bias_mm", *bias_mm),
                ("sigma_bias_mm", *sigma_bias_mm),
            ],
        }
    }
}

fn by_colour(black_minus_white_mm: f64, sigma_mm: f64, noise_mm: f64, lost: usize) -> String {
    let farther = if black_minus_white_mm > 0.0 { "farther" } else { "nearer" };
    let lost = match lost {
        0 => String::new(),
        n => format!(
            "; {n} corners of all captures have no depth, because too few points of one colour are around them"
        ),
    };
    format!(
        "the scans measure black {:.3} +- {sigma_mm:.3} mm {farther} than white (noise of a corner: {noise_mm:.3} mm); points on black were corrected. A flat board cannot tell which colour is right: the depth on white is the reference, and the result is valid for surfaces that the camera measures like white{lost}",
        black_minus_white_mm.abs()
    )
}

impl FromViews {
    fn message(&self, used: Option<&Intrinsics>) -> String {
        let Self { views, rms_px, focal_px: [fx, fy] } = self;
        let used = used.map_or(String::new(), |used| {
            format!(
                ". The answer uses the camera refined with the robot's poses: fx = {:.2} px, fy = {:.2} px, cx = \
                 {:.2} px, cy = {:.2} px",
                used.fx, used.fy, used.cx, used.cy
            )
        });
        format!(
            "no intrinsics given: calibrated from {views} images, {rms_px:.3} px RMS, fx = {fx:.2} px, fy = {fy:.2} px; \
             a separate calibration, with the board all over the image, is better{used}"
        )
    }
}

fn in_words(changed: &[Moved]) -> String {
    let one = |m: &Moved| format!("{} {:.2} -> {:.2} (+- {:.2}) px", m.name, m.from, m.to, m.sigma);
    match changed {
        [] => "the distortion alone, focal lengths and principal point are as given".into(),
        _ => changed.iter().map(one).collect::<Vec<_>>().join(", "),
    }
}

const HALF: &str = ". Both moved by half a pixel: the given cx and cy seem to count from the corner of the first pixel and the target's corners from its centre, or the other way round; if so, correct them";

/// Whether the principal point alone has moved, by half a pixel both ways.
fn is_half_a_pixel([fx, fy, cx, cy]: &[Moved; 4]) -> bool {
    let stands = |m: &Moved| (m.to - m.from).abs() < CLEARLY * m.sigma;
    let half = |m: &Moved, by: f64| {
        let off = m.to - m.from;
        CLEARLY * m.sigma < by.abs() && (off - by).abs() < CLEARLY * m.sigma
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

    fn told(now: Intrinsics) -> String {
        CameraFinding::refined(&given(), &now, [0.2, 0.2, 0.1, 0.1]).message()
    }

    #[test]
    fn only_what_changed_is_told() {
        let longer = told(Intrinsics { fx: 1805.0, fy: 1800.1, ..given() });
        assert!(
            longer.contains("refined: fx 1800.00 -> 1805.00 (+- 0.20) px. The result uses"),
            "{longer}"
        );
        assert!(!longer.contains("fy") && !longer.contains("cx"), "{longer}");
        let bent = told(given());
        assert!(bent.contains("the distortion alone"), "{bent}");
    }

    #[test]
    fn half_a_pixel_is_named() {
        let half = told(Intrinsics { cx: 959.45, cy: 599.56, ..given() });
        assert!(half.contains("cx 960.00 -> 959.45") && half.contains("half a pixel"), "{half}");
        for other in [
            Intrinsics { cx: 959.5, cy: 600.5, ..given() },
            Intrinsics { cx: 959.5, ..given() },
            Intrinsics { cx: 959.5, cy: 599.5, fx: 1803.0, ..given() },
        ] {
            assert!(!told(other).contains("half a pixel"), "{other:?}");
        }
    }

    #[test]
    fn the_headline_carries_the_number() {
        let longer = Intrinsics { fx: 1805.0, ..given() };
        let headline = CameraFinding::refined(&given(), &longer, [0.2; 4]).headline();
        let words =
            "the answer uses refined intrinsics (fx 1800.00 -> 1805.00 px), not the given ones";
        assert_eq!(headline.as_deref(), Some(words));
        assert_eq!(CameraFinding::refined(&given(), &given(), [0.2; 4]).headline(), None);
    }
}
