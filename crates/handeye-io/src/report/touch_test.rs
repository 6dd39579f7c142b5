//! `verify.html`: the touch test as a page, in the style of the report.

use std::fmt::Write;

use handeye::{
    Verdict,
    tools::verify::{ChiSquare, Verification, Within},
};

use super::{escape, judgement, page, plot, section, warnings};

/// What the page shows.
pub struct TouchTest<'a> {
    /// Name of the calibration.
    pub title: String,
    /// Passed or not.
    pub verdict: Verdict,
    /// Why, most important first.
    pub reasons: &'a [String],
    /// What to know.
    pub warnings: &'a [handeye::Warning],
    /// Names of the touches.
    pub ids: Vec<String>,
    /// What the touches say.
    pub found: &'a Verification,
    /// The tolerance (mm) and who lies within.
    pub within: Option<(f64, Within)>,
}

/// The whole page.
pub fn touch_test_html(test: &TouchTest) -> String {
    let word = match test.verdict {
        Verdict::Accepted => "Passed",
        Verdict::Rejected => "Failed",
        Verdict::Undetermined => "Undetermined",
    };
    let body = judgement((test.verdict, word), test.reasons, "", &facts(test))
        + &warnings(test.warnings)
        + &touches(test)
        + &statistics(test);
    page(
        ("Touch test", &test.title),
        &body,
        "Lengths in mm, differences in the axes of the base: tip minus prediction.",
    )
}

fn facts(test: &TouchTest) -> Vec<(String, String)> {
    let f = test.found;
    let mut all = vec![
        (format!("{:.2} mm", f.rms * 1e3), "distance, RMS".to_owned()),
        (format!("{:.2} mm", f.max * 1e3), "largest distance".to_owned()),
        (format!("{:.2} mm", f.p95_at_most * 1e3), "95 % of points, 95 % confidence".to_owned()),
    ];
    if let Some((tolerance, within)) = test.within {
        let count = format!("{} of {}", within.count, f.differences.len());
        all.push((count, format!("touches within {tolerance} mm")));
    }
    all
}

fn touches(test: &TouchTest) -> String {
    let each = || test.ids.iter().zip(&test.found.differences);
    let bars: Vec<plot::Bar> = each()
        .map(|(id, d)| plot::Bar {
            name: id.clone(),
            value: d.difference.norm() * 1e3,
            second: d.expected.map(|e| e * 1e3),
        })
        .collect();
    let mut rows = String::new();
    for (id, d) in each() {
        let (v, p) = (d.difference * 1e3, d.predicted.vector() * 1e3);
        let expected = d.expected.map_or("&ndash;".into(), |e| format!("{:.3}", e * 1e3));
        let _ = write!(
            rows,
            "<tr><td>{}</td><td>{:.3}</td><td>{expected}</td><td>{:.3}</td><td>{:.3}</td><td>{:.3}</td>\
             <td>{:.2}</td><td>{:.2}</td><td>{:.2}</td></tr>",
            escape(id),
            v.norm(),
            v.x,
            v.y,
            v.z,
            p.x,
            p.y,
            p.z
        );
    }
    let content = format!(
        "{}<div class=\"scroll\"><table><tr><th>touch</th><th>distance</th><th>expected,<br>RMS</th>\
         <th>x</th><th>y</th><th>z</th><th>predicted<br>x</th><th>predicted<br>y</th><th>predicted<br>z</th></tr>{rows}</table></div>",
        plot::bars(&bars, "mm", ("distance", "expected"))
    );
    section("Touches", "long", &content)
}

fn statistics(test: &TouchTest) -> String {
    let (Some(all), Some(offset)) = (&test.found.agreement, &test.found.offset) else {
        let words = "<p>The calibration states no covariance: nothing says how far the touches may lie \
                     from it.</p>";
        return section("Against the stated uncertainty", "", words);
    };
    let row = |name: &str, c: &ChiSquare| {
        format!(
            "<tr><td>{name}</td><td>{:.1}</td><td>{}</td><td>{:.4}</td></tr>",
            c.chi_square, c.degrees_of_freedom, c.p_value
        )
    };
    let (m, s) = (offset.mean * 1e3, offset.sigma * 1e3);
    let without = offset.without.map_or(String::new(), |w| row("without the common offset", &w));
    let content = format!(
        "<table><tr><th></th><th>chi-square</th><th>expected</th><th>chance</th></tr>{}{}{without}</table>\
         <h3>Common offset</h3><table><tr><th></th><th>x</th><th>y</th><th>z</th></tr>\
         <tr><td>tip minus prediction</td><td>{:.3}</td><td>{:.3}</td><td>{:.3}</td></tr>\
         <tr><td>standard deviation</td><td>{:.3}</td><td>{:.3}</td><td>{:.3}</td></tr></table>\
         <p class=\"note\">An offset that is the same at every touch while the rest agrees points at the \
         tip, or at the thickness of what was touched.</p>",
        row("all touches", all),
        row("common offset", &offset.test),
        m.x,
        m.y,
        m.z,
        s.x,
        s.y,
        s.z
    );
    section("Against the stated uncertainty", "", &content)
}
