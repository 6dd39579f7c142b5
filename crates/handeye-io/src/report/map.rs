//! The predicted error as coloured slices through the volume in which the answer is used.

use std::fmt::Write;

use handeye::estimate::predict::{TreMap, TreSlice};

const AXES: [&str; 3] = ["x", "y", "z"];
/// Size of the longer edge of a slice, units of the drawing.
const EDGE: f64 = 240.0;
/// Room for the scale left of a slice, and below it.
const MARGIN: (f64, f64) = (44.0, 40.0);
/// Shorter edges are drawn at least this long, or thin boxes would show nothing.
const LEAST_EDGE: f64 = 60.0;

/// Three slices side by side, coloured from the least to the largest error.
pub fn slices(map: &TreMap) -> String {
    let cells = || map.slices.iter().flat_map(|s| s.p95_mm.iter().flatten().flatten());
    let low = cells().copied().fold(f64::INFINITY, f64::min);
    let high = cells().copied().fold(0.0, f64::max);
    if !(low.is_finite() && high > 0.0) {
        return String::new();
    }
    let figures: String = map.slices.iter().map(|s| slice(map, s, (low, high))).collect();
    format!("<div class=\"maps\">{figures}</div>{}", legend(low, high))
}

/// Pale to dark, readable in print and by the colour-blind.
fn colour(share: f64) -> String {
    const STOPS: [[f64; 3]; 4] =
        [[240.0, 246.0, 252.0], [143.0, 190.0, 226.0], [240.0, 160.0, 60.0], [160.0, 30.0, 20.0]];
    let at = share.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let k = (at.floor() as usize).min(STOPS.len() - 2);
    let mix = |c: usize| (STOPS[k][c] + (STOPS[k + 1][c] - STOPS[k][c]) * (at - k as f64)) as u8;
    format!("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2))
}

/// Errors of nearly one size are not spread over all colours.
fn share(value: f64, (low, high): (f64, f64)) -> f64 {
    (value - low) / (high - low).max(0.2 * high)
}

fn slice(map: &TreMap, s: &TreSlice, range: (f64, f64)) -> String {
    let [a, b] = s.axes;
    let length = |axis: usize| map.maximum_mm[axis] - map.minimum_mm[axis];
    let scale = EDGE / length(a).max(length(b)).max(f64::MIN_POSITIVE);
    let (width, height) =
        ((length(a) * scale).max(LEAST_EDGE), (length(b) * scale).max(LEAST_EDGE));
    let (w, h) = (width + MARGIN.0 + 12.0, height + MARGIN.1 + 10.0);
    let mut svg =
        format!("<svg viewBox=\"0 0 {w:.0} {h:.0}\" role=\"img\" style=\"max-width:{w:.0}px\">");
    let rows = s.p95_mm.len().max(1) as f64;
    for (i, row) in s.p95_mm.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            let Some(value) = value else { continue };
            let columns = row.len() as f64;
            let _ = write!(
                svg,
                "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"{}\"><title>{value:.2} mm</title></rect>",
                MARGIN.0 + width * j as f64 / columns,
                10.0 + height * (rows - 1.0 - i as f64) / rows,
                width / columns + 0.3,
                height / rows + 0.3,
                colour(share(*value, range)),
            );
        }
    }
    let _ = write!(
        svg,
        "<rect x=\"{x}\" y=\"10\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"none\" stroke=\"var(--soft)\"/>\
         <text x=\"{x}\" y=\"{ty:.1}\" fill=\"var(--soft)\">{:.0}</text>\
         <text x=\"{right:.1}\" y=\"{ty:.1}\" text-anchor=\"end\" fill=\"var(--soft)\">{:.0}</text>\
         <text x=\"{middle:.1}\" y=\"{ly:.1}\" text-anchor=\"middle\" fill=\"var(--ink)\">{}, mm</text>\
         <text x=\"{lx}\" y=\"{bottom:.1}\" text-anchor=\"end\" fill=\"var(--soft)\">{:.0}</text>\
         <text x=\"{lx}\" y=\"20\" text-anchor=\"end\" fill=\"var(--soft)\">{:.0}</text>\
         <text x=\"{lx}\" y=\"{half:.1}\" text-anchor=\"end\" fill=\"var(--ink)\">{}</text></svg>",
        map.minimum_mm[a],
        map.maximum_mm[a],
        AXES[a],
        map.minimum_mm[b],
        map.maximum_mm[b],
        AXES[b],
        x = MARGIN.0,
        lx = MARGIN.0 - 5.0,
        ty = height + 24.0,
        ly = height + 42.0,
        right = MARGIN.0 + width,
        middle = MARGIN.0 + width / 2.0,
        bottom = height + 8.0,
        half = 14.0 + height / 2.0,
    );
    let across = 3 - a - b;
    let at = 0.5 * (map.minimum_mm[across] + map.maximum_mm[across]);
    format!("<figure>{svg}<figcaption>{} = {at:.0} mm</figcaption></figure>", AXES[across])
}

fn legend(low: f64, high: f64) -> String {
    let steps: String = (0..=10)
        .map(|k| {
            let value = low + (high - low) * f64::from(k) / 10.0;
            format!("<i style=\"background:{}\"></i>", colour(share(value, (low, high))))
        })
        .collect();
    format!("<p class=\"ramp\">{low:.2} mm {steps} {high:.2} mm</p>")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(value: f64) -> TreMap {
        TreMap {
            frame: "camera".into(),
            minimum_mm: [0.0, 0.0, 500.0],
            maximum_mm: [400.0, 200.0, 900.0],
            slices: vec![TreSlice {
                axes: [0, 2],
                p95_mm: vec![vec![Some(value), None], vec![Some(2.0 * value), Some(value)]],
            }],
        }
    }

    #[test]
    fn a_slice_shows_what_the_camera_sees_and_no_more() {
        let html = slices(&map(0.5));
        assert_eq!(html.matches("<title>").count(), 3);
        assert!(html.contains("y = 100 mm") && html.contains("1.00 mm"), "{html}");
    }

    #[test]
    fn no_errors_no_map() {
        assert_eq!(slices(&map(f64::NAN)), "");
    }
}
