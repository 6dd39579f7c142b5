//! Where in the image the corners lie, and by how much they are off: coverage, scatter and histogram.

use std::fmt::Write;

use super::{MarkedCorner, plot::nice, plot::tidy, section};

/// Most corners that are drawn; of more, every second, third ...
const MOST: usize = 3000;
/// Fields of the image along its width; across it as many of the same size.
const FIELDS: usize = 12;
/// Width of a figure.
const WIDTH: f64 = 320.0;
/// A residual beyond so many times the typical one is drawn as an exception.
const FAR: f64 = 4.0;
/// Bars of the histogram.
const BINS: usize = 31;
/// The histogram and the scatter end at so many times the root mean square.
const REACH: f64 = 4.0;

/// The section of the image plane; `size` of the images, px.
pub(super) fn image_plane(corners: &[MarkedCorner], size: Option<(u32, u32)>) -> String {
    let (Some((width, height)), false) = (size, corners.len() < 4) else { return String::new() };
    let (width, height) = (f64::from(width), f64::from(height));
    let square = |c: &MarkedCorner| c.dx * c.dx + c.dy * c.dy;
    let rms = (corners.iter().map(square).sum::<f64>() / (2 * corners.len()) as f64).sqrt();
    if !(width > 0.0 && height > 0.0 && rms > 0.0 && rms.is_finite()) {
        return String::new();
    }
    let shown: Vec<&MarkedCorner> =
        corners.iter().step_by(corners.len().div_ceil(MOST).max(1)).collect();
    let mean =
        |of: fn(&MarkedCorner) -> f64| corners.iter().map(of).sum::<f64>() / corners.len() as f64;
    let (fields, covered) = covered(corners, (width, height));
    let content = format!(
        "<div class=\"plane\">{}{}{}</div><p class=\"note\">All {} corners of the used captures. Left: where they \
         lie in the image of {width:.0} x {height:.0} pixels; distortion is known only where there are corners. Middle and \
         right: found minus predicted, from the target's own pose in each image; the rings are one and two times the RMS \
         of {rms:.3} px per axis, the mean is ({:+.3}, {:+.3}) px, the curve is that of a normal distribution.</p>",
        coverage(&shown, (width, height), &fields, covered),
        scatter(&shown, rms),
        histogram(corners, rms),
        corners.len(),
        mean(|c| c.dx),
        mean(|c| c.dy),
    );
    section("The image plane", "", &content)
}

/// Whether each field of the image has a corner, row by row, and the share that has.
fn covered(corners: &[MarkedCorner], (width, height): (f64, f64)) -> (Vec<Vec<bool>>, f64) {
    let side = width / FIELDS as f64;
    let rows = (height / side).round().max(1.0) as usize;
    let mut fields = vec![vec![false; FIELDS]; rows];
    for c in corners {
        let at = |v: f64, most: f64, count: usize| {
            ((v + 0.5) / most * count as f64).clamp(0.0, count as f64 - 1.0) as usize
        };
        fields[at(c.y, height, rows)][at(c.x, width, FIELDS)] = true;
    }
    let with = fields.iter().flatten().filter(|f| **f).count();
    let share = with as f64 / (rows * FIELDS) as f64;
    (fields, share)
}

fn coverage(
    shown: &[&MarkedCorner],
    (width, height): (f64, f64),
    fields: &[Vec<bool>],
    share: f64,
) -> String {
    let scale = WIDTH / width;
    let tall = height * scale;
    let (w, h) = (WIDTH / FIELDS as f64, tall / fields.len() as f64);
    let mut svg = format!(
        "<svg viewBox=\"-1 -1 {:.0} {:.0}\" role=\"img\"><rect width=\"{WIDTH}\" height=\"{tall:.1}\" fill=\"var(--wash)\" \
         stroke=\"var(--line)\"/>",
        WIDTH + 2.0,
        tall + 2.0
    );
    for (j, row) in fields.iter().enumerate() {
        for (i, _) in row.iter().enumerate().filter(|(_, has)| **has) {
            let _ = write!(
                svg,
                "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"var(--faint)\"/>",
                i as f64 * w,
                j as f64 * h
            );
        }
    }
    let dots = dots(shown.iter().map(|c| ((c.x + 0.5) * scale, (c.y + 0.5) * scale)));
    let _ = write!(svg, "<path d=\"{dots}\" class=\"dots\"/></svg>");
    figure(&svg, &format!("<b>Coverage</b> {:.0} % of the image's fields", 100.0 * share))
}

/// Points as one path.
fn dots(all: impl Iterator<Item = (f64, f64)>) -> String {
    all.fold(String::new(), |mut path, (x, y)| {
        let _ = write!(path, "M{x:.1} {y:.1}h0");
        path
    })
}

fn scatter(shown: &[&MarkedCorner], rms: f64) -> String {
    let (middle, side) = (WIDTH / 2.0, WIDTH);
    let unit = (middle - 14.0) / (REACH * rms);
    let mut svg = format!(
        "<svg viewBox=\"0 0 {side} {side}\" role=\"img\"><path d=\"M0 {middle}H{side}M{middle} 0V{side}\" stroke=\"var(--line)\"/>"
    );
    for k in [1.0, 2.0] {
        let _ = write!(
            svg,
            "<circle cx=\"{middle}\" cy=\"{middle}\" r=\"{:.1}\" fill=\"none\" stroke=\"var(--soft)\" stroke-dasharray=\"3 3\"/>",
            k * rms * unit
        );
    }
    let far = |c: &&&MarkedCorner| c.dx.hypot(c.dy) > FAR * rms;
    let at = |c: &&MarkedCorner| {
        let end = |v: f64| (middle + v * unit).clamp(3.0, side - 3.0);
        (end(c.dx), end(c.dy))
    };
    let (exceptions, usual): (Vec<_>, Vec<_>) = shown.iter().partition(far);
    let _ = write!(svg, "<path d=\"{}\" class=\"dots\"/>", dots(usual.into_iter().map(at)));
    let _ =
        write!(svg, "<path d=\"{}\" class=\"dots far\"/>", dots(exceptions.into_iter().map(at)));
    let tick = nice(REACH * rms / 3.0);
    let x = middle + tick * unit;
    let _ = write!(
        svg,
        "<path d=\"M{x:.1} {:.1}v8\" stroke=\"var(--soft)\"/><text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" \
         fill=\"var(--soft)\">{} px</text></svg>",
        middle - 4.0,
        middle + 18.0,
        tidy(tick)
    );
    figure(&svg, "<b>Residuals</b> of the corners, right and down")
}

fn histogram(corners: &[MarkedCorner], rms: f64) -> String {
    let mut counts = [0usize; BINS];
    for v in corners.iter().flat_map(|c| [c.dx, c.dy]) {
        let place = (v / rms + REACH) / (2.0 * REACH) * BINS as f64;
        counts[place.clamp(0.0, BINS as f64 - 1.0) as usize] += 1;
    }
    let (tall, bottom) = (WIDTH, 24.0);
    let step = 2.0 * REACH / BINS as f64;
    // density of a normal distribution, as counts of a bar
    let normal = |z: f64| {
        2.0 * corners.len() as f64 * step * (-0.5 * z * z).exp()
            / (2.0 * std::f64::consts::PI).sqrt()
    };
    let most = counts.iter().map(|c| *c as f64).fold(normal(0.0), f64::max);
    let y = |count: f64| (tall - bottom) - count / most * (tall - bottom - 6.0);
    let mut svg = format!("<svg viewBox=\"0 0 {WIDTH} {tall}\" role=\"img\">");
    let wide = WIDTH / BINS as f64;
    for (k, count) in counts.iter().enumerate() {
        let top = y(*count as f64);
        let _ = write!(
            svg,
            "<rect x=\"{:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"var(--blue)\" fill-opacity=\".45\"/>",
            k as f64 * wide + 0.5,
            wide - 1.0,
            tall - bottom - top
        );
    }
    let line: Vec<String> = (0..=64)
        .map(|k| {
            let z = REACH * (f64::from(k) / 32.0 - 1.0);
            format!("{:.1},{:.1}", (z / REACH + 1.0) * WIDTH / 2.0, y(normal(z)))
        })
        .collect();
    let _ = write!(
        svg,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"var(--soft)\" stroke-width=\"1.5\"/>",
        line.join(" ")
    );
    for (z, anchor) in [(-REACH, "start"), (0.0, "middle"), (REACH, "end")] {
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\" fill=\"var(--soft)\">{:.2} px</text>",
            (z / REACH + 1.0) * WIDTH / 2.0,
            tall - 6.0,
            z * rms
        );
    }
    figure(&(svg + "</svg>"), "<b>Histogram</b> of both components")
}

fn figure(svg: &str, caption: &str) -> String {
    format!("<figure>{svg}<figcaption>{caption}</figcaption></figure>")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners(count: usize) -> Vec<MarkedCorner> {
        let one = |k: usize| {
            let t = k as f64;
            let (dx, dy) = ((7.0 * t).sin() * 0.05, (11.0 * t).cos() * 0.05);
            MarkedCorner { x: (37.0 * t) % 320.0, y: (23.0 * t) % 240.0, dx, dy }
        };
        (0..count).map(one).collect()
    }

    #[test]
    fn half_of_an_image_with_corners_is_covered_by_half() {
        let (_, share) = covered(&corners(2000), (640.0, 240.0));
        assert!((share - 0.5).abs() < 0.05, "{share}");
    }

    #[test]
    fn many_corners_make_no_large_page_and_far_ones_stand_out() {
        let mut all = corners(50_000);
        all[0].dx = 3.0;
        let page = image_plane(&all, Some((640, 480)));
        assert!(page.len() < 200_000, "{}", page.len());
        assert!(page.contains("class=\"dots far\"") && page.contains("All 50000 corners"));
        assert!(image_plane(&all[..3], Some((640, 480))).is_empty());
        assert!(image_plane(&all, None).is_empty());
    }
}
