//! Bar charts as SVG.

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
            "<line x1=\"{LEFT}\" x2=\"{WIDTH}\" y1=\"{y:.1}\" y2=\"{y:.1}\" stroke=\"#e3e7ed\"/>\
             <text x=\"{x}\" y=\"{ty:.1}\" text-anchor=\"end\" fill=\"#5b6675\">{v}</text>",
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
        "<rect x=\"{x:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{:.1}\" fill=\"#1f6fb2\" rx=\"1.5\"><title>{}: {:.3}</title></rect>",
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
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"#5b6675\">{}</text>",
            x + width / 2.0,
            base + 15.0,
            escape(&bar.name)
        );
    }
    svg
}

fn legend(unit: &str, names: (&str, &str)) -> String {
    let mut svg = format!(
        "<rect x=\"{x}\" y=\"3\" width=\"11\" height=\"11\" fill=\"#1f6fb2\"/><text x=\"{t}\" y=\"13\" fill=\"#1c2430\">{}, {unit}</text>",
        names.0,
        x = LEFT,
        t = LEFT + 17.0
    );
    if !names.1.is_empty() {
        let x = LEFT + 150.0;
        let _ = write!(
            svg,
            "<line x1=\"{x}\" x2=\"{}\" y1=\"9\" y2=\"9\" stroke=\"#d97a00\" stroke-width=\"2.5\"/><text x=\"{}\" y=\"13\" fill=\"#1c2430\">{}, {unit}</text>",
            x + 13.0,
            x + 19.0,
            names.1
        );
    }
    svg
}

/// 1, 2 or 5 times a power of ten, at least `v`.
fn nice(v: f64) -> f64 {
    let power = 10f64.powf(v.log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * power).find(|s| *s >= v * 0.999).unwrap_or(power)
}

fn tidy(v: f64) -> String {
    let text = format!("{v:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
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
            "<text x=\"0\" y=\"{:.0}\" fill=\"#5b6675\">{name}</text><rect x=\"90\" y=\"{:.0}\" width=\"340\" height=\"13\" fill=\"#eef1f5\" rx=\"2\"/>\
             <rect x=\"90\" y=\"{:.0}\" width=\"{:.1}\" height=\"13\" fill=\"#1f6fb2\" rx=\"2\"/><text x=\"438\" y=\"{:.0}\" fill=\"#1c2430\">{v:.3}</text>",
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
    fn no_bars_no_plot() {
        assert_eq!(bars(&[], "mm", ("a", "")), "");
    }
}
