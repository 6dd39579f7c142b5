//! What the scans say: depth by colour, the flatness of the board, images against scans.

use std::fmt::Write;

use handeye::{
    Calibration,
    calibrate::result::{
        BoardDeviation, ColourStepResult, FlatnessResult, FramesResult, SceneKind, ScenePair,
    },
};

use super::{capital, escape, section};

/// More pairs that slide are not written out.
const MOST_SLIDING: usize = 6;

/// How scans were placed without a board; empty where there was one.
pub(super) fn scene(c: &Calibration) -> String {
    let Some(scene) = c.scans.as_ref().and_then(|scans| scans.scene.as_ref()) else {
        return String::new();
    };
    let title = match scene.kind {
        SceneKind::Scene => "Scene",
        SceneKind::Object => "Object",
    };
    let rows: String = scene.pairs.iter().map(pair).collect();
    let content = format!(
        "<p>{}.</p>{}<details><summary>Each pair</summary><div class=\"scroll\"><table><tr><th>this</th>\
         <th>in the scan of</th><th>lies on<br>it, %</th><th>agrees,<br>%</th><th>apart,<br>RMS mm</th>\
         <th class=\"words\">why it does not count</th></tr>{rows}</table></div><p class=\"note\">Lies on it: \
         share of the first that the second shows as well. Agrees: of the places where both show something, \
         the share at which it is the same.</p></details>",
        capital(&scene.sentence(c.captures.len())),
        sliding(&scene.pairs),
    );
    section(title, "", &content)
}

fn pair(p: &ScenePair) -> String {
    let class = if p.used { "" } else { "out" };
    format!(
        "<tr class=\"{class}\"><td>{}</td><td>{}</td><td>{:.0}</td><td>{:.0}</td><td>{}</td>\
         <td class=\"words\">{}</td></tr>",
        escape(&p.source),
        escape(&p.target),
        100.0 * p.overlap,
        100.0 * p.agreement,
        super::mm(p.rms_mm),
        p.reason.as_deref().map_or(String::new(), escape)
    )
}

/// What the common surface of pairs does not tell.
fn sliding(pairs: &[ScenePair]) -> String {
    let all: Vec<&ScenePair> = pairs.iter().filter(|p| !p.undetermined.is_empty()).collect();
    if all.is_empty() {
        return String::new();
    }
    let item = |p: &&ScenePair| {
        let free = escape(&p.undetermined.join("; "));
        format!("<li>{} in {}: {free}</li>", escape(&p.source), escape(&p.target))
    };
    let items: String = all.iter().take(MOST_SLIDING).map(item).collect();
    let more = match all.len().saturating_sub(MOST_SLIDING) {
        0 => String::new(),
        more => format!("<li>and {more} more</li>"),
    };
    format!(
        "<h3>What is not determined</h3><p>In {} of {} pairs the overlap does not constrain all directions; they do not \
         count. Free are</p><ul>{items}{more}</ul>",
        all.len(),
        pairs.len()
    )
}

/// Empty where there are no scans.
pub(super) fn scans(c: &Calibration) -> String {
    let Some(scans) = &c.scans else { return String::new() };
    let content = [
        scans.colour_step.as_ref().map(colour_step),
        scans.flatness.as_ref().map(flatness),
        scans.frames.as_ref().map(frames),
    ];
    let content: String = content.into_iter().flatten().collect();
    if content.is_empty() { content } else { section("Scans", "", &content) }
}

fn colour_step(step: &ColourStepResult) -> String {
    let used = if step.applied {
        "It was taken off the points on black. A flat board cannot tell which colour is right; \
         white is the reference."
    } else {
        "That is not more than noise; nothing was taken off."
    };
    let vary = if step.applied && step.spread_mm > 0.0 {
        format!(" From capture to capture it varies by {:.3} mm.", step.spread_mm)
    } else {
        String::new()
    };
    format!(
        "<h3>Black and white</h3><p>Scans read black <b>{:+.3} &plusmn; {:.3} mm</b> farther than white, \
         in {} captures. {used}{vary}</p>",
        step.black_minus_white_mm,
        step.sigma_mm,
        step.captures.len()
    )
}

fn flatness(f: &FlatnessResult) -> String {
    let row = |c: &handeye::calibrate::result::CaptureFlatness| {
        format!(
            "<tr><td>{}</td><td>{:.3}</td><td>{:.3}</td><td>{:.3}</td></tr>",
            super::escape(&c.id),
            c.rms_mm,
            c.peak_to_valley_mm,
            c.sigma_mm
        )
    };
    let rows: String = f.captures.iter().map(row).collect();
    format!(
        "<h3>Flatness of the board</h3><p>All captures together put the corners {:.3} mm (RMS) off one plane. The \
         surface of second order through them is <b>{:.3} &plusmn; {:.3} mm</b> from its highest to its lowest \
         corner; the chance that noise alone looks so is {}.</p>{}\
         <details><summary>Each capture</summary><table><tr><th>capture</th><th>off a plane,<br>RMS mm</th>\
         <th>surface, highest<br>to lowest, mm</th><th>&plusmn;</th></tr>{rows}</table></details>",
        f.rms_mm,
        f.peak_to_valley_mm,
        f.sigma_mm,
        chance(f.chance),
        map(&f.map)
    )
}

fn chance(p: f64) -> String {
    if p < 1e-4 { "below 0.0001".into() } else { format!("{p:.4}") }
}

/// Longer side of the map, units of the drawing.
const EDGE: f64 = 300.0;
/// Full colour is for deviations of so many times their own noise.
const BEYOND_NOISE: f64 = 6.0;
/// Around the outermost corners.
const MARGIN: f64 = 22.0;

/// The board with its corners as dots, blue towards the viewer, red away.
fn map(all: &[BoardDeviation]) -> String {
    let range = |f: fn(&BoardDeviation) -> f64| {
        let values = || all.iter().map(f);
        (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
    };
    let (x, y) = (range(|d| d.x_mm), range(|d| d.y_mm));
    let most = all.iter().map(|d| d.deviation_mm.abs()).fold(0.0, f64::max);
    let long = (x.1 - x.0).max(y.1 - y.0);
    if !(long > 0.0 && most > 0.0 && (long + most).is_finite()) {
        return String::new();
    }
    // what may be noise stays pale
    let most = all.iter().map(|d| BEYOND_NOISE * d.sigma_mm).fold(most, f64::max);
    let scale = EDGE / long;
    let radius = (0.42 * EDGE / (all.len() as f64).sqrt()).min(14.0);
    let (w, h) = ((x.1 - x.0) * scale + 2.0 * MARGIN, (y.1 - y.0) * scale + 2.0 * MARGIN);
    let mut svg = format!(
        "<svg viewBox=\"0 0 {w:.0} {h:.0}\" role=\"img\" aria-label=\"deviation of the board from a plane\" \
         style=\"max-width:{w:.0}px\"><rect width=\"{w:.0}\" height=\"{h:.0}\" fill=\"var(--wash)\"/>"
    );
    for d in all {
        let _ = write!(
            svg,
            "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"{radius:.1}\" fill=\"{}\"><title>{:+.3} &#177; {:.3} mm</title></circle>",
            MARGIN + (d.x_mm - x.0) * scale,
            MARGIN + (d.y_mm - y.0) * scale,
            colour(d.deviation_mm / most),
            d.deviation_mm,
            d.sigma_mm
        );
    }
    let steps: String = (-5..=5)
        .map(|k| format!("<i style=\"background:{}\"></i>", colour(f64::from(k) / 5.0)))
        .collect();
    format!(
        "<figure>{svg}</svg><figcaption>Mean deviation of every corner from the board's plane, as the viewer sees \
         the board: blue nearer, red farther.</figcaption></figure>\
         <p class=\"ramp\">{:.2} mm {steps} {most:.2} mm</p>",
        -most
    )
}

/// From blue over pale grey to red.
fn colour(share: f64) -> String {
    const ENDS: [[f64; 3]; 3] = [[40.0, 100.0, 180.0], [236.0, 238.0, 241.0], [176.0, 50.0, 30.0]];
    let end = if share < 0.0 { ENDS[0] } else { ENDS[2] };
    let s = share.abs().min(1.0);
    let mix = |c: usize| (ENDS[1][c] + (end[c] - ENDS[1][c]) * s) as u8;
    format!("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2))
}

fn frames(f: &FramesResult) -> String {
    let proven = |name: &str| {
        if f.proven.iter().any(|p| p == name) { "<b>more than noise</b>" } else { "within noise" }
    };
    let axes = |v: &[f64; 3], s: &[f64; 3], digits: usize| -> String {
        let one = |k: usize| format!("{:+.digits$} &plusmn; {:.digits$}", v[k], s[k]);
        format!("{}, {}, {}", one(0), one(1), one(2))
    };
    let row = |name: &str, value: String| {
        format!(
            "<tr><td class=\"words\">{name}</td><td class=\"words\">{value}</td><td class=\"words\">{}</td></tr>",
            proven(name)
        )
    };
    let rows =
        row("scale", format!("{:+.3} &plusmn; {:.3} %", f.scale * 100.0, f.sigma_scale * 100.0))
            + &row("tilt", axes(&f.tilt_deg, &f.sigma_tilt_deg, 3) + " degrees")
            + &row("shift", axes(&f.shift_mm, &f.sigma_shift_mm, 3) + " mm");
    format!(
        "<h3>Images against scans</h3><table><tr><th class=\"words\"></th><th class=\"words\">scan minus image, x, y, z of the \
         camera</th><th class=\"words\"></th></tr>{rows}</table><p class=\"note\">From the board's plane in both. What is more \
         than noise is estimated together; each of the others as if it came on top. The chance that frames that \
         agree look so is {}.</p>",
        chance(f.chance)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn board(height: f64) -> Vec<BoardDeviation> {
        let at = |k: usize| BoardDeviation {
            x_mm: (k % 3) as f64 * 20.0,
            y_mm: (k / 3) as f64 * 20.0,
            deviation_mm: height * ((k % 3) as f64 - 1.0),
            sigma_mm: 0.01,
        };
        (0..9).map(at).collect()
    }

    #[test]
    fn the_map_has_every_corner_nearer_blue_farther_red() {
        let svg = map(&board(0.5));
        assert_eq!(svg.matches("<circle").count(), 9);
        assert_eq!(svg.matches(&colour(-1.0)).count(), 4, "three corners and the scale");
        assert_eq!(svg.matches(&colour(1.0)).count(), 4);
        assert!(svg.contains("+0.500 &#177; 0.010 mm"), "{svg}");
    }

    #[test]
    fn no_deviations_no_map() {
        assert_eq!(map(&[]), "");
        assert_eq!(map(&board(f64::NAN)), "");
    }
}
