//! Bar charts and histograms as SVG.

use std::fmt::Write;

use super::escape;

/// One bar, with an optional second value drawn as a tick.
pub struct Bar {
    /// Below the bar.
    pub name: String,
    /// Height.
    pub value: f64,
    /// Tick.
    pub second: Option<f64>,
}

const WIDTH: f64 = 1000.0;
const HEIGHT: f64 = 190.0;
const LEFT: f64 = 46.0;
const BOTTOM: f64 = 34.0;
/// Half a number at the end of an axis.
const RIGHT: f64 = 14.0;
const TOP: f64 = 22.0;

/// Bars side by side, with a scale.
pub fn bars(all: &[Bar], unit: &str, names: (&str, &str)) -> String {
    let most = all.iter().flat_map(|b| [b.value, b.second.unwrap_or(0.0)]).fold(0.0, f64::max);
    if all.is_empty() || !(most > 0.0 && most.is_finite()) {
        return String::new();
    }
    let step = nice(most / 4.0);
    let top = (most / step).ceil() * step;
    let y = |v: f64| HEIGHT - BOTTOM - v / top * (HEIGHT - BOTTOM - TOP);
    let mut svg = format!("<svg class=\"plot\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\">");
    for k in 0..=(top / step).round() as usize {
        let v = k as f64 * step;
        let _ = write!(
            svg,
            "<line x1=\"{LEFT}\" x2=\"{WIDTH}\" y1=\"{y:.1}\" y2=\"{y:.1}\" stroke=\"var(--line)\"/>\
             <text x=\"{x}\" y=\"{ty:.1}\" text-anchor=\"end\" fill=\"var(--soft)\">{v}</text>",
            y = y(v),
            x = LEFT - 6.0,
            ty = y(v) + 4.0,
            v = tidy(v)
        );
    }
    let slot = (WIDTH - LEFT) / all.len() as f64;
    let every = (all.len() as f64 / (940.0 / widest(all))).ceil().max(1.0) as usize;
    for (k, bar) in all.iter().enumerate() {
        let x = LEFT + (k as f64 + 0.18) * slot;
        svg += &one(bar, x, 0.64 * slot, &y, k % every == 0);
    }
    svg += &legend(unit, names);
    svg + "</svg>"
}

/// Room a name takes, px of the plot.
fn widest(all: &[Bar]) -> f64 {
    all.iter().map(|b| b.name.chars().count()).max().unwrap_or(1) as f64 * 6.5 + 8.0
}

fn one(bar: &Bar, x: f64, width: f64, y: &impl Fn(f64) -> f64, named: bool) -> String {
    let (top, base) = (y(bar.value), y(0.0));
    let mut svg = format!(
        "<rect x=\"{x:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{:.1}\" fill=\"var(--blue)\" rx=\"1.5\"><title>{}: {:.3}</title></rect>",
        base - top,
        escape(&bar.name),
        bar.value
    );
    if let Some(second) = bar.second {
        let at = y(second);
        let _ = write!(
            svg,
            "<line x1=\"{:.1}\" x2=\"{:.1}\" y1=\"{at:.1}\" y2=\"{at:.1}\" stroke=\"#d97a00\" stroke-width=\"2.5\"/>",
            x - 2.0,
            x + width + 2.0
        );
    }
    if named {
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"var(--soft)\">{}</text>",
            x + width / 2.0,
            base + 15.0,
            escape(&bar.name)
        );
    }
    svg
}

fn legend(unit: &str, names: (&str, &str)) -> String {
    let mut svg = format!(
        "<rect x=\"{x}\" y=\"3\" width=\"11\" height=\"11\" fill=\"var(--blue)\"/><text x=\"{t}\" y=\"13\" fill=\"var(--ink)\">{}, {unit}</text>",
        names.0,
        x = LEFT,
        t = LEFT + 17.0
    );
    if !names.1.is_empty() {
        let x = LEFT + 150.0;
        let _ = write!(
            svg,
            "<line x1=\"{x}\" x2=\"{}\" y1=\"9\" y2=\"9\" stroke=\"#d97a00\" stroke-width=\"2.5\"/><text x=\"{}\" y=\"13\" fill=\"var(--ink)\">{}, {unit}</text>",
            x + 13.0,
            x + 19.0,
            names.1
        );
    }
    svg
}

/// 1, 2 or 5 times a power of ten, at least `v`.
pub fn nice(v: f64) -> f64 {
    let power = 10f64.powf(v.log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * power).find(|s| *s >= v * 0.999).unwrap_or(power)
}

pub fn tidy(v: f64) -> String {
    let text = format!("{v:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Numbers of one kind in a histogram.
pub struct Series<'a> {
    /// In the legend.
    pub name: &'a str,
    /// Of its area and its line.
    pub colour: &'a str,
    /// Positive ones; those below the axis are not drawn.
    pub values: &'a [f64],
}

/// Bins of a histogram for each decade of its axis.
const BINS: f64 = 16.0;
/// Share of each series that may lie below the axis.
const BELOW: f64 = 0.03;

/// How often values occur, on an axis of powers of ten that ends at `most`; each series to its own height.
/// Empty without values.
pub fn histogram(all: &[Series], most: f64, unit: &str) -> String {
    let starts = all.iter().filter_map(|s| quantile(s.values, BELOW));
    let least = 0.5 * nice(starts.fold(f64::INFINITY, f64::min).max(most * 1e-5));
    let (low, high) = (least.log10(), most.log10());
    if all.iter().all(|s| s.values.is_empty()) || !(high > low) {
        return String::new();
    }
    let count = ((high - low) * BINS).ceil() as usize;
    let bin = |v: &f64| {
        let place = (v.log10() - low) / (high - low) * count as f64;
        (place >= 0.0).then(|| (place as usize).min(count - 1))
    };
    let shares = |series: &Series| {
        let mut shares = vec![0.0f64; count];
        series.values.iter().filter_map(bin).for_each(|k| shares[k] += 1.0);
        let highest = shares.iter().copied().fold(1.0, f64::max);
        shares.iter().map(|share| share / highest).collect()
    };
    let shares: Vec<Vec<f64>> = all.iter().map(shares).collect();
    let x = |at: f64| LEFT + (WIDTH - LEFT - RIGHT) * (at - low) / (high - low);
    let y = |share: f64| HEIGHT - BOTTOM - share * (HEIGHT - BOTTOM - TOP - 8.0);
    let mut svg = format!("<svg class=\"plot\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\">");
    svg += &decades(low, most, unit, &x);
    for (k, (series, shares)) in all.iter().zip(&shares).enumerate() {
        svg += &area(shares, series.colour, low + (high - low) / count as f64, low, &x, &y);
        let at = LEFT + 170.0 * k as f64;
        let _ = write!(
            svg,
            "<rect x=\"{at}\" y=\"3\" width=\"11\" height=\"11\" rx=\"2\" fill=\"{}\"/>\
             <text x=\"{}\" y=\"13\" fill=\"var(--ink)\">{}</text>",
            series.colour,
            at + 17.0,
            escape(series.name)
        );
    }
    svg + "</svg>"
}

/// The value below which such a share of all lies.
pub fn quantile(values: &[f64], share: f64) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted.get(((sorted.len() as f64 * share) as usize).min(sorted.len().max(1) - 1)).copied()
}

/// Lines at 1, 2 and 5 times the powers of ten.
fn decades(low: f64, most: f64, unit: &str, x: &impl Fn(f64) -> f64) -> String {
    let mut svg = String::new();
    let mut power = 10f64.powf(low.floor());
    let is_inside = |v: &f64| v.log10() > low - 1e-9 && *v <= 1.001 * most;
    while power <= most {
        for value in [power, 2.0 * power, 5.0 * power].into_iter().filter(is_inside) {
            let _ = write!(
                svg,
                "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{TOP}\" y2=\"{bottom}\" stroke=\"var(--line)\"/>\
                 <text x=\"{x:.1}\" y=\"{text}\" text-anchor=\"middle\" fill=\"var(--soft)\">{value}</text>",
                x = x(value.log10()),
                bottom = HEIGHT - BOTTOM,
                text = HEIGHT - BOTTOM + 15.0,
                value = tidy(value)
            );
        }
        power *= 10.0;
    }
    let _ = write!(
        svg,
        "<text x=\"{WIDTH}\" y=\"{}\" text-anchor=\"end\" fill=\"var(--soft)\">{unit}</text>",
        HEIGHT - 4.0
    );
    svg
}

fn area(
    shares: &[f64],
    colour: &str,
    second: f64,
    first: f64,
    x: &impl Fn(f64) -> f64,
    y: &impl Fn(f64) -> f64,
) -> String {
    let mut path = format!("M{:.1} {:.1}", x(first), y(0.0));
    for (k, share) in shares.iter().enumerate() {
        let right = first + (second - first) * (k + 1) as f64;
        let _ = write!(path, "V{:.1}H{:.1}", y(*share), x(right));
    }
    let _ = write!(path, "V{:.1}", y(0.0));
    format!(
        "<path d=\"{path}\" fill=\"{colour}\" fill-opacity=\"0.35\" stroke=\"{colour}\" stroke-width=\"1.6\"/>"
    )
}

/// Shares of one as lying bars.
pub fn shares(all: &[(&str, f64)]) -> String {
    let height = 22.0 * all.len() as f64 + 4.0;
    let mut svg = format!(
        "<svg class=\"plot\" style=\"max-width:520px\" viewBox=\"0 0 520 {height}\" role=\"img\">"
    );
    for (k, (name, v)) in all.iter().enumerate() {
        let y = 22.0 * k as f64;
        let _ = write!(
            svg,
            "<text x=\"0\" y=\"{:.0}\" fill=\"var(--soft)\">{name}</text><rect x=\"90\" y=\"{:.0}\" width=\"340\" height=\"13\" fill=\"var(--faint)\" rx=\"2\"/>\
             <rect x=\"90\" y=\"{:.0}\" width=\"{:.1}\" height=\"13\" fill=\"var(--blue)\" rx=\"2\"/><text x=\"438\" y=\"{:.0}\" fill=\"var(--ink)\">{v:.3}</text>",
            y + 14.0,
            y + 4.0,
            y + 4.0,
            340.0 * v.clamp(0.0, 1.0),
            y + 14.0
        );
    }
    svg + "</svg>"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_round_numbers() {
        assert_eq!(nice(0.13), 0.2);
        assert_eq!(nice(2.0), 2.0);
        assert_eq!(nice(0.4), 0.5);
    }

    #[test]
    fn a_histogram_has_an_axis_of_powers_of_ten_and_an_area_for_each_series() {
        let (few, many) = ([0.02, 0.03, 0.05], [3.0, 4.0, 20.0, 90.0]);
        let series = |name, values| Series { name, colour: "#123456", values };
        let svg = histogram(&[series("after", &few[..]), series("before", &many[..])], 50.0, "mm");
        assert_eq!(svg.matches("<path").count(), 2);
        assert!(svg.contains(">0.01<") && svg.contains(">50<") && !svg.contains(">100<"), "{svg}");
        assert_eq!(histogram(&[series("after", &[])], 50.0, "mm"), "");
        assert_eq!(quantile(&many, 0.5), Some(20.0));
    }

    #[test]
    fn no_bars_no_plot() {
        assert_eq!(bars(&[], "mm", ("a", "")), "");
    }
}
