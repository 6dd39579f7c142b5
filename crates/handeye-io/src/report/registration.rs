//! The page of a registration: what was found, and how far the scans lie apart before and after.

use std::fmt::Write;

use handeye::{
    Warning,
    register::{Dense, Reference},
};
use nalgebra::{Isometry3, Matrix6};

use super::{
    capital, colours, escape, judgement, page, plot,
    scene::{Axes, Layer, MOST_POINTS, Packed, Scene, Values, grouped, thin},
    section, warnings, word,
};

/// Points with a name, in metres.
#[derive(Clone, Copy)]
pub struct NamedCloud<'a> {
    /// Such as that of its file.
    pub name: &'a str,
    /// In any order, also those that were not seen.
    pub points: &'a [[f32; 3]],
}

/// What the page shows.
pub struct Registration<'a> {
    /// The scan that was moved.
    pub source: NamedCloud<'a>,
    /// The scan that stayed.
    pub target: NamedCloud<'a>,
    /// `target_from_source` before.
    pub start: Isometry3<f64>,
    /// The answer.
    pub found: &'a Dense,
    /// What was compared.
    pub method: &'a str,
    /// Points farther from the target have no counterpart, m.
    pub gate_m: f64,
    /// For reading, preparing and registering, s.
    pub seconds: [f64; 3],
    /// What to know.
    pub warnings: &'a [Warning],
    /// Threads; the page is the same with any number.
    pub threads: usize,
}

/// Colours of the histogram.
const BEFORE: &str = "#e0861a";
const AFTER: &str = "#2f7fd1";
/// Share of the distances after within which the colours end.
const COLOURED: f64 = 0.95;
/// Colours end no sooner than at this share of the gate.
const FINEST: f64 = 1e-4;

/// The source's points that are shown, and how far they lie from the target.
struct Gaps {
    points: Vec<[f32; 3]>,
    /// Points that there were.
    of: usize,
    before: Vec<f32>,
    after: Vec<f32>,
}

impl Gaps {
    fn of(r: &Registration) -> Self {
        let all = r.source.points;
        let points: Vec<[f32; 3]> =
            thin(all, MOST_POINTS).into_iter().map(|k| all[k as usize]).collect();
        let reference = Reference::new(r.target.points);
        let gaps = |pose: &Isometry3<f64>| reference.gaps(&points, pose, r.gate_m, r.threads);
        let (before, after) = (gaps(&r.start), gaps(&r.found.target_from_source));
        let of = all.iter().filter(|p| p.iter().all(|x| x.is_finite())).count();
        Self { points, of, before, after }
    }
}

/// Distances that are known, mm.
fn in_mm(gaps: &[f32]) -> Vec<f64> {
    gaps.iter().filter(|g| g.is_finite()).map(|g| f64::from(*g) * 1e3).collect()
}

/// `None` of nothing.
fn rms(mm: &[f64]) -> Option<f64> {
    let mean = mm.iter().map(|g| g * g).sum::<f64>() / mm.len() as f64;
    Some(mean.sqrt()).filter(|rms| rms.is_finite())
}

/// The whole page.
pub fn registration_html(r: &Registration) -> String {
    let gaps = Gaps::of(r);
    let found = r.found;
    let body =
        judgement((found.verdict, word(found.verdict)), &reasons(found), "", &facts(found, &gaps))
            + &warnings(r.warnings)
            + &section("Both scans", "", &view(r, &gaps))
            + &section("Distances to the target", "", &distances(r, &gaps))
            + &section("target_from_source", "", &transform(found))
            + &section("How it went", "", &progress(r));
    let title = format!("{} in {}", r.source.name, r.target.name);
    page(
        ("Registration", &title),
        &body,
        "Lengths in mm, angles in degrees. target_from_source takes points of the source into the target; its \
         covariance is written in the source's axes at the source's origin.",
    )
}

fn reasons(found: &Dense) -> Vec<String> {
    if !found.reasons.is_empty() {
        return found.reasons.clone();
    }
    vec!["no other place that was tried fits as well, and the common surface leaves no direction free".into()]
}

fn facts(found: &Dense, gaps: &Gaps) -> Vec<(String, String)> {
    let mut all = vec![];
    let mut say = |value: String, name: &str| all.push((value, name.to_owned()));
    if let Some(share) = found.explained {
        // what is around the part belongs to something else
        if found.rms_m.is_finite() {
            let mm = 1e3 * found.rms_m;
            say(format!("{mm:.3} mm"), "RMS distance of the points that lie on the part");
        }
        say(format!("{:.0} %", 100.0 * share), "of the scan in the part's box lies on the part");
    } else if let Some(mm) = rms(&in_mm(&gaps.after)) {
        // the same number as in the table below
        say(format!("{mm:.3} mm"), "RMS distance of all points with a counterpart");
    }
    say(format!("{:.0} %", 100.0 * found.inlier_fraction), "of the source on the target");
    if found.rms_m.is_finite() {
        say(format!("{:.1} %", 100.0 * found.agreement), "agree where both see");
    }
    if let Some(size) = &found.size {
        let (percent, sigma) = (100.0 * (size.ratio - 1.0), 100.0 * size.sigma);
        say(format!("{percent:+.2} &plusmn; {sigma:.2} %"), "size in the target, over the source");
    }
    if let Some(c) = &found.covariance {
        let largest =
            |first: usize| (0..3).map(|k| c[(first + k, first + k)].sqrt()).fold(0.0, f64::max);
        let (mm, deg) = (1e3 * largest(3), largest(0).to_degrees());
        say(format!("{mm:.3} mm / {deg:.4}&deg;"), "standard deviation, worst axis");
    }
    all
}

fn view(r: &Registration, gaps: &Gaps) -> String {
    let after = in_mm(&gaps.after);
    let gate = 1e3 * r.gate_m;
    let typical = plot::quantile(&after, COLOURED).unwrap_or(0.5 * gate).max(FINEST * gate);
    let values = Values { most_mm: gate, top_mm: plot::nice(typical).min(gate) };
    let share = |all: &[f32]| all.iter().map(|g| g / r.gate_m as f32).collect();
    let shares = [share(&gaps.before), share(&gaps.after)];
    let target = Layer::new(&format!("target: {}", r.target.name), colours::QUIET)
        .with(Packed::cloud(r.target.points, MOST_POINTS));
    let source = Layer::new(&format!("source: {}", r.source.name), AFTER)
        .with(Packed::valued(&gaps.points, gaps.of, &shares))
        .placed(&[r.start, r.found.target_from_source]);
    let scene = Scene {
        states: vec!["before", "after"],
        values: Some(values),
        ..Scene::new(Axes::Camera, vec![target, source])
    };
    scene.html("the target, and the source before and after")
}

fn distances(r: &Registration, gaps: &Gaps) -> String {
    let (before, after) = (in_mm(&gaps.before), in_mm(&gaps.after));
    let series = |name, colour, values| plot::Series { name, colour, values };
    let all = [series("before", BEFORE, &before[..]), series("after", AFTER, &after[..])];
    let row = |name: &str, gaps: &[f64], of: usize| {
        let at = |share: f64| match plot::quantile(gaps, share) {
            Some(mm) => format!("{mm:.3}"),
            None => "&ndash;".into(),
        };
        let rms = rms(gaps).map_or("&ndash;".into(), |mm| format!("{mm:.3}"));
        let counterpart = 100.0 * gaps.len() as f64 / of.max(1) as f64;
        format!(
            "<tr><td>{name}</td><td>{}</td><td>{rms}</td><td>{}</td><td>{}</td><td>{counterpart:.1} %</td></tr>",
            at(0.5),
            at(0.95),
            at(0.99)
        )
    };
    let of = gaps.points.len();
    format!(
        "<div class=\"scroll\">{}</div><div class=\"scroll\"><table><tr><th></th><th>median</th><th>RMS</th><th>95 %</th><th>99 %</th>\
         <th>with a counterpart</th></tr>{}{}</table></div><p class=\"note\">Of {} points of the source, evenly \
         spread in space: how far each lies from the plane through the target's points around the nearest \
         one. Points farther than {:.0} mm, and those beside the rim of the target, have no counterpart. The \
         scale of the plot is logarithmic, and each area is drawn to its own height. Outliers count here as well; {}.</p>",
        plot::histogram(&all, 1e3 * r.gate_m, "mm"),
        row("before", &before, of),
        row("after", &after, of),
        grouped(of),
        1e3 * r.gate_m,
        matches(r.found)
    )
}

fn matches(found: &Dense) -> String {
    if found.rms_m.is_finite() {
        format!("without them, the RMS residual of the matches is {:.3} mm", 1e3 * found.rms_m)
    } else {
        "there are no matches".into()
    }
}

fn deviations(covariance: &Matrix6<f64>) -> String {
    let s = |k: usize, scale: f64| covariance[(k, k)].sqrt() * scale;
    let deg = 1f64.to_degrees();
    format!(
        "<h3>One standard deviation, in the source's axes</h3><table><tr><th></th><th>x</th><th>y</th><th>z</th></tr>\
         <tr><td>position, mm</td><td>{:.4}</td><td>{:.4}</td><td>{:.4}</td></tr>\
         <tr><td>rotation, degrees</td><td>{:.5}</td><td>{:.5}</td><td>{:.5}</td></tr></table>",
        s(3, 1e3),
        s(4, 1e3),
        s(5, 1e3),
        s(0, deg),
        s(1, deg),
        s(2, deg)
    )
}

fn transform(found: &Dense) -> String {
    let pose = &found.target_from_source;
    let m = pose.to_homogeneous();
    let mut matrix = String::new();
    for i in 0..3 {
        let _ = writeln!(
            matrix,
            "{:12.8} {:12.8} {:12.8} {:12.4}",
            m[(i, 0)],
            m[(i, 1)],
            m[(i, 2)],
            1e3 * m[(i, 3)]
        );
    }
    let _ = write!(matrix, "{:12} {:12} {:12} {:12}", 0, 0, 0, 1);
    let (t, q) = (pose.translation.vector * 1e3, pose.rotation.coords);
    let mut content = format!(
        "<div class=\"two\"><div><h3>4 x 4, translation in mm</h3><pre>{matrix}</pre></div><div>\
         <h3>translation, mm; quaternion x y z w</h3><pre>{:.4} {:.4} {:.4}\n{:.8} {:.8} {:.8} {:.8}</pre></div></div>",
        t.x, t.y, t.z, q.x, q.y, q.z, q.w
    );
    if let Some(covariance) = &found.covariance {
        content += &deviations(covariance);
    }
    if !found.places.is_empty() {
        let row = |at: &Isometry3<f64>| {
            let (t, q) = (at.translation.vector * 1e3, at.rotation.coords);
            format!(
                "{:.4} {:.4} {:.4}   {:.8} {:.8} {:.8} {:.8}\n",
                t.x, t.y, t.z, q.x, q.y, q.z, q.w
            )
        };
        let rows: String = found.places.iter().map(row).collect();
        let _ = write!(
            content,
            "<h3>Equally good places: translation, mm; quaternion x y z w</h3><pre>{rows}</pre>"
        );
    }
    if !found.undetermined.is_empty() {
        let item = |words: &String| format!("<li>{}</li>", capital(&escape(words)));
        let items: String = found.undetermined.iter().map(item).collect();
        let _ = write!(
            content,
            "<h3>Not determined</h3><ul>{items}</ul><p class=\"note\">Along these motions the answer is no \
             better than its start; they are in the target's axes.</p>"
        );
    }
    content
}

fn progress(r: &Registration) -> String {
    let seen = |cloud: &NamedCloud| {
        grouped(cloud.points.iter().filter(|p| p.iter().all(|x| x.is_finite())).count())
    };
    let [read, prepare, iterate] = r.seconds;
    let rows: String = [
        ("source", format!("{}, {} points", escape(r.source.name), seen(&r.source))),
        ("target", format!("{}, {} points", escape(r.target.name), seen(&r.target))),
        ("method", escape(r.method)),
        ("largest distance of a match", format!("{:.1} mm", 1e3 * r.gate_m)),
        ("rounds", r.found.iterations.to_string()),
        ("reading", format!("{read:.2} s")),
        ("preparing the surfaces", format!("{prepare:.2} s")),
        ("registering", format!("{iterate:.2} s")),
    ]
    .map(|(name, value)| format!("<tr><td>{name}</td><td class=\"words\">{value}</td></tr>"))
    .concat();
    format!("<table>{rows}</table>")
}

#[cfg(test)]
mod tests {
    use super::*;
    use handeye::{Verdict, register::Stop};

    /// A wave of 200 x 120 mm.
    fn wave() -> Vec<[f32; 3]> {
        let point = |k: usize| {
            let (x, y) = ((k % 200) as f32 * 1e-3, (k / 200) as f32 * 1e-3);
            [x, y, 0.6 + 0.01 * (20.0 * x).sin()]
        };
        (0..24_000).map(point).collect()
    }

    fn found(shift: f64) -> Dense {
        Dense {
            verdict: Verdict::Accepted,
            reasons: vec![],
            undetermined: vec![],
            target_from_source: Isometry3::translation(0.0, 0.0, shift),
            covariance: None,
            iterations: 7,
            stop: Stop::Converged,
            inlier_fraction: 0.9,
            agreement: 0.99,
            size: None,
            rms_m: 1e-4,
            sigma: 1.0,
            explained: None,
            places: vec![],
        }
    }

    fn registration<'a>(
        points: &'a [[f32; 3]],
        found: &'a Dense,
        threads: usize,
    ) -> Registration<'a> {
        Registration {
            source: NamedCloud { name: "source.ply", points },
            target: NamedCloud { name: "target <1>.ply", points },
            start: Isometry3::translation(0.0, 0.0, 3e-3),
            found,
            method: "symmetric",
            gate_m: 0.02,
            seconds: [0.1, 0.2, 0.3],
            warnings: &[],
            threads,
        }
    }

    #[test]
    fn distances_before_and_after_are_those_of_a_known_shift() {
        let (points, found) = (wave(), found(1e-4));
        let gaps = Gaps::of(&registration(&points, &found, 1));
        let median = |gaps: &[f32]| plot::quantile(&in_mm(gaps), 0.5).unwrap();
        // across a wave that leans by up to 11 degrees
        assert!((median(&gaps.before) - 3.0).abs() < 0.06, "{}", median(&gaps.before));
        assert!((median(&gaps.after) - 0.1).abs() < 0.002, "{}", median(&gaps.after));
        assert_eq!(gaps.of, 24_000);
    }

    #[test]
    fn the_page_says_what_was_found_and_is_the_same_with_any_number_of_threads() {
        let (points, found) = (wave(), found(0.0));
        let page = registration_html(&registration(&points, &found, 1));
        for words in
            ["Accepted", "target: target &lt;1&gt;.ply", "24\u{202f}000 points", "data-state"]
        {
            assert!(page.contains(words), "{words}");
        }
        assert!(page == registration_html(&registration(&points, &found, 3)));
    }

    #[test]
    fn the_headline_is_the_number_of_the_table() {
        let (points, found) = (wave(), found(5e-3));
        let page = registration_html(&registration(&points, &found, 1));
        let rms = rms(&in_mm(&Gaps::of(&registration(&points, &found, 1)).after)).unwrap();
        assert_eq!(page.matches(&format!("{rms:.3}")).count(), 2, "{rms}");
    }

    #[test]
    fn a_page_of_scans_that_do_not_meet_has_no_distances() {
        let (points, mut nothing) = (wave(), found(5.0));
        nothing.rms_m = f64::NAN;
        nothing.verdict = Verdict::Rejected;
        nothing.reasons = vec!["hardly anything of the source lies there".into()];
        let mut apart = registration(&points, &nothing, 1);
        apart.start = nothing.target_from_source;
        let page = registration_html(&apart);
        assert!(page.contains("Rejected") && page.contains("0.0 %") && !page.contains("NaN"));
    }
}
