//! `report.html`: one self-contained page that tells a person what was found and how sure it is.
//!
//! Everything but the 3D view is plain HTML and SVG made here, so that the page reads and prints
//! without a script; nothing is loaded from anywhere. Other pages are made of the same parts: a touch test,
//! a registration, and what `handeye view` shows.

mod arm;
mod base64;
mod cell;
mod colours;
mod dataset;
mod diversity;
mod headline;
mod image_plane;
mod map;
mod origin;
mod picture;
mod plot;
mod predicted;
mod registration;
mod scans;
mod scene;
mod shown;
mod touch_test;

use std::fmt::Write;

use handeye::{
    Calibration, Intrinsics, Setup, Verdict,
    calibrate::{
        findings::{self},
        result::{Candidate, CaptureResult},
    },
    findings::severity::Severity,
};

pub use cell::{CaptureScan, CellData, base_from_camera};
pub use dataset::{calibration_html, dataset_html};
pub use picture::{MarkedCorner, Picture};
pub use registration::{NamedCloud, Registration, registration_html};
pub use shown::{Shown, Thing, ThingCount, shown_html};
pub use touch_test::{TouchTest, touch_test_html};

use crate::xml::escape;

/// What the page shows.
pub struct Report<'a> {
    /// Name of the data set.
    pub title: String,
    /// The result.
    pub calibration: &'a Calibration,
    /// The camera that was used.
    pub camera: Option<&'a Intrinsics>,
    /// What stands in the cell.
    pub cell: CellData,
    /// The transform in notations the user knows: name and text.
    pub notations: Vec<(String, String)>,
    /// Images with their corners.
    pub pictures: Vec<Picture>,
    /// The corners of all captures that are used.
    pub corners: Vec<MarkedCorner>,
}

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("shared.js");

/// The whole page.
pub fn html(report: &Report) -> String {
    let c = report.calibration;
    let mut body = headline::verdict(report);
    if c.verdict == Verdict::Rejected {
        // the reasons first; its numbers below them, crossed out
        body += &found(c);
        body += &captures(c);
        body += &touches(c);
        body += &refused(&(transform(report) + &candidates(c) + &predicted::predicted_error(c)));
    } else {
        body += &transform(report);
        body += &found(c);
        body += &candidates(c);
        body += &captures(c);
        body += &touches(c);
    }
    body += &view(report);
    if c.verdict != Verdict::Rejected {
        body += &predicted::predicted_error(c);
    }
    body += &arm::arm(c);
    body += &arm::correction(c);
    body += &scans::scene(c);
    body += &scans::scans(c);
    body += &diversity::diversity(c);
    let size = report.camera.map(|camera| (camera.width, camera.height));
    body += &image_plane::image_plane(&report.corners, size);
    body += &picture::pictures(&report.pictures);
    body += &origin::origin(c);
    page(
        ("Hand-eye calibration", &report.title),
        &body,
        &format!(
            "Lengths in mm, angles in degrees. A covariance is written in the camera's axes at the camera.{}",
            c.run_id.as_ref().map_or(String::new(), |id| format!(" Run {}.", escape(id)))
        ),
    )
}

/// A page of this kind and name.
fn page((kind, title): (&str, &str), body: &str, footer: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\
         <title>{title} - {}</title><style>{STYLE}</style></head>\n<body><main>\
         <h1>{kind} &middot; {title}</h1>{body}\
         <footer>handeye {version}. {footer}</footer></main><script>{SCRIPT}</script></body></html>\n",
        kind.to_lowercase(),
        title = escape(title),
        version = env!("CARGO_PKG_VERSION"),
    )
}

/// The verdict in a word of its kind, its reasons, and figures with their names.
fn judgement(
    (verdict, word): (Verdict, &str),
    reasons: &[String],
    accuracy: &str,
    facts: &[(String, String)],
) -> String {
    let class = match verdict {
        Verdict::Accepted if word == RESERVED => "reserved",
        Verdict::Accepted => "accepted",
        Verdict::Rejected => "rejected",
        Verdict::Undetermined => "undetermined",
    };
    let sentence = |(k, reason): (usize, &String)| {
        let (reason, tag) = (capital(&escape(reason)), if k == 0 { "div" } else { "p" });
        let class = if k == 0 { " class=\"sentence\"" } else { "" };
        format!("<{tag}{class}>{reason}.</{tag}>")
    };
    let reasons: String = reasons.iter().enumerate().map(sentence).collect();
    let fact = |(value, name): &(String, String)| {
        format!("<div class=\"fact\"><b>{value}</b><span>{}</span></div>", escape(name))
    };
    let facts: String = facts.iter().map(fact).collect();
    format!(
        "<section class=\"verdict {class}\"><div class=\"word\">{word}</div>{reasons}{accuracy}\
         <div class=\"facts\">{facts}</div></section>\n"
    )
}

/// The word for an answer that is accepted with a finding that changes it.
const RESERVED: &str = "Accepted, with a reservation";

/// The word for a verdict.
fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Accepted => "Accepted",
        Verdict::Rejected => "Rejected",
        Verdict::Undetermined => "Undetermined",
    }
}

fn section(title: &str, class: &str, content: &str) -> String {
    format!("<section class=\"{class}\"><h2>{}</h2>{content}</section>\n", escape(title))
}

fn mm(value: Option<f64>) -> String {
    value.map_or("&ndash;".into(), |v| format!("{v:.3}"))
}

fn deg(value: Option<f64>) -> String {
    value.map_or("&ndash;".into(), |v| format!("{v:.3}"))
}

/// Numbers of an answer that is not to be used: crossed out, and not to be selected.
fn refused(content: &str) -> String {
    format!(
        "<div class=\"refused\"><p class=\"note\">Rejected: these numbers are shown to find out what went wrong, and not \
         to be used.</p>{content}</div>\n"
    )
}

/// The warnings of a result; those that change the answer stand out.
fn found(c: &Calibration) -> String {
    let all = findings::findings(c);
    // what is a reason against the answer stands at the top already
    let of_warnings = all.iter().skip(all.len() - c.warnings.len()).zip(&c.warnings);
    let of_warnings = of_warnings.filter(|(_, w)| !c.is_reason(w));
    let item = |(f, _): (&handeye::calibrate::result::JudgedFinding, _)| {
        let class = match f.severity {
            Severity::Info => "info",
            Severity::ChangesAnswer => "changes",
            Severity::Rejects => "rejects",
        };
        format!(
            "<li class=\"{class}\">{} <code>{}</code></li>",
            capital(&escape(&f.message)),
            escape(&f.code)
        )
    };
    let items: String = of_warnings.map(item).collect();
    if items.is_empty() {
        return items;
    }
    section("What to look at", "", &format!("<ul class=\"warnings\">{items}</ul>"))
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or(String::new(), |c| c.to_uppercase().chain(chars).collect())
}

fn transform(report: &Report) -> String {
    let c = report.calibration;
    let words = match c.setup {
        Setup::EyeInHand => "eye-in-hand: it takes points of the camera to the flange",
        Setup::EyeToHand => "eye-to-hand: it takes points of the camera to the robot's base",
    };
    let Some(pose) = &c.hand_eye.mount_from_camera else {
        let missing = match &c.undetermined[..] {
            [] => String::new(),
            all => format!(" Not determined: {}.", escape(&all.join(", "))),
        };
        let mut content = format!("<p>No transform is given.{missing}</p>");
        if let Some(known) = &c.determined {
            let lines = escape(&known.lines().join("\n"));
            let _ = write!(content, "<h3>What is determined</h3><pre>{lines}</pre>");
        }
        return section(&c.name, "", &content);
    };
    let m = pose.matrix();
    let row = |i: usize| {
        format!(
            "{:12.8} {:12.8} {:12.8} {:12.4}\n",
            m[(i, 0)],
            m[(i, 1)],
            m[(i, 2)],
            m[(i, 3)] * 1e3
        )
    };
    let matrix = format!("{}{}{}{:12} {:12} {:12} {:12}", row(0), row(1), row(2), 0, 0, 0, 1);
    let mut content = format!("<p>Camera on the {}, {words}.</p>", c.setup.mount());
    let _ = write!(
        content,
        "<div class=\"two\"><div><h3>4 x 4, translation in mm</h3><pre class=\"matrix\">{matrix}</pre>{}</div><div>{}</div></div>",
        sigmas(c),
        in_notations(&report.notations)
    );
    section(&c.name, "", &content)
}

/// The transform in all notations, one at a time.
fn in_notations(all: &[(String, String)]) -> String {
    let one = |(k, (name, text)): (usize, &(String, String))| {
        let checked = if k == 0 { " checked" } else { "" };
        format!(
            "<input type=\"radio\" name=\"notation\" id=\"notation-{k}\"{checked}><label for=\"notation-{k}\">{}</label>\
             <div class=\"pane\"><button class=\"copy\" type=\"button\" hidden>Copy</button><pre>{}</pre></div>",
            escape(name),
            escape(text)
        )
    };
    let panes: String = all.iter().enumerate().map(one).collect();
    if panes.is_empty() {
        return panes;
    }
    format!("<h3>In the notation of</h3><div class=\"tabs\">{panes}</div>")
}

/// Rows of a table that are shown from the start, where there are clearly more.
const SHOWN_ROWS: usize = 10;
/// So many are all shown.
const FEW_ROWS: usize = 14;

/// A table with its rows, the worst first; of many, the rest is shown on demand.
fn folded(id: &str, head: &str, mut rows: Vec<Row>) -> String {
    rows.sort_by(|a, b| b.worse.total_cmp(&a.worse));
    let count = rows.len();
    let has_more = count > FEW_ROWS;
    let row = |(k, row): (usize, &Row)| {
        let more = if has_more && k >= SHOWN_ROWS { " more" } else { "" };
        let capture = row
            .capture
            .as_ref()
            .map_or(String::new(), |id| format!(" data-capture=\"{}\"", escape(id)));
        format!("<tr class=\"{}{more}\"{capture}>{}</tr>", row.class, row.cells)
    };
    let all: String = rows.iter().enumerate().map(row).collect();
    let switch = if has_more {
        format!(
            "<input type=\"checkbox\" id=\"all-{id}\"><label for=\"all-{id}\">all {count}, not only the worst {SHOWN_ROWS}</label>"
        )
    } else {
        String::new()
    };
    format!(
        "<div class=\"fold\">{switch}<div class=\"scroll\"><table><tr>{head}</tr>{all}</table></div></div>"
    )
}

/// A row of a table.
struct Row {
    /// The capture that it is of.
    capture: Option<String>,
    class: &'static str,
    cells: String,
    /// What it is sorted by: larger is worse.
    worse: f64,
}

fn sigmas(c: &Calibration) -> String {
    let Some(rows) = &c.hand_eye.covariance.mount_from_camera else {
        return "<p class=\"note\">Too little data to say how sure it is.</p>".into();
    };
    let s = |k: usize| rows[k][k].max(0.0).sqrt();
    format!(
        "<h3>One standard deviation, in the camera's axes</h3><table><tr><th></th><th>x</th><th>y</th><th>z</th></tr>\
         <tr><td>position, mm</td><td>{:.3}</td><td>{:.3}</td><td>{:.3}</td></tr>\
         <tr><td>rotation, degrees</td><td>{:.4}</td><td>{:.4}</td><td>{:.4}</td></tr></table>",
        s(3) * 1e3,
        s(4) * 1e3,
        s(5) * 1e3,
        s(0).to_degrees(),
        s(1).to_degrees(),
        s(2).to_degrees()
    )
}

fn warnings(all: &[handeye::Warning]) -> String {
    if all.is_empty() {
        return String::new();
    }
    let item = |w: &handeye::Warning| {
        format!("<li>{} <code>{}</code></li>", capital(&escape(&w.message)), escape(&w.code))
    };
    let items: String = all.iter().map(item).collect();
    section("What to look at", "", &format!("<ul class=\"warnings\">{items}</ul>"))
}

fn candidates(c: &Calibration) -> String {
    if c.candidates.is_empty() {
        return String::new();
    }
    let row = |k: &Candidate| {
        let class = if c.chosen.as_deref() == Some(k.name.as_str()) { "chosen" } else { "" };
        format!(
            "<tr class=\"{class}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            escape(&k.name),
            mm(k.in_sample.translation_rms_mm),
            deg(k.in_sample.rotation_rms_deg),
            mm(k.held_out.translation_rms_mm),
            mm(k.touch_rms_mm),
            mm(k.held_out_mm),
            mm(k.predicted_tre_mm),
        )
    };
    let rows: String = c.candidates.iter().map(row).collect();
    let notes: String = c
        .candidates
        .iter()
        .filter_map(|k| {
            Some(format!(
                "<p class=\"note\">{}: {}.</p>",
                escape(&k.name),
                escape(k.note.as_ref()?)
            ))
        })
        .collect();
    let table = format!(
        "<div class=\"scroll\"><table><tr><th>candidate</th><th>captures<br>in sample, mm</th><th>in sample,<br>degrees</th>\
         <th>captures<br>held out, mm</th><th>touches,<br>mm</th><th>not seen<br>before, mm</th><th>predicted<br>at work, mm</th></tr>{rows}</table></div>\
         {notes}<p>{}.</p><p class=\"note\">All figures are root mean squares. The residual of what an answer was made from never \
         chooses: it falls whenever more is fitted, also when the answer gets worse. In sample: with all captures. Held out: \
         each capture by an answer that has not seen it. Touches: distance of the touched points. Not seen before: on \
         captures or touches that were left out, which decides. At work: in the volume of the headline.</p>",
        capital(&escape(&c.why))
    );
    section("Candidates side by side", "", &table)
}

/// Whether the camera did not look at a scene or an object instead.
fn has_board(c: &Calibration) -> bool {
    c.scans.as_ref().is_none_or(|scans| scans.scene.is_none())
}

fn captures(c: &Calibration) -> String {
    if c.captures.is_empty() {
        return String::new();
    }
    let bars: Vec<plot::Bar> = c
        .captures
        .iter()
        .filter(|k| k.used)
        .map(|k| plot::Bar {
            name: k.id.clone(),
            value: k.residual_mm.unwrap_or(0.0),
            second: k.held_out_mm,
        })
        .collect();
    let has_images = c.captures.iter().any(|k| k.corners > 0);
    let rows = c.captures.iter().map(|k| capture_row(k, has_images)).collect();
    let (of_images, explained) = if has_images { OF_IMAGES } else { ("", "") };
    let head = format!(
        "<th>capture</th>{of_images}<th>residual,<br>mm</th><th>residual,<br>degrees</th><th>held out,<br>mm</th>\
         <th class=\"words\">why not used</th>"
    );
    let content = format!(
        "{}{}<p class=\"note\">Rejected captures first, then the largest residuals. {explained}Residual: by how much \
         robot and camera disagree on the position of the target's {}. Held out: the same with an answer that has not \
         seen the capture.</p>",
        wide(&plot::bars(&bars, "mm", ("residual", "held out"))),
        folded("captures", &head, rows),
        if has_board(c) { "first corner" } else { "origin" }
    );
    section("Captures", "long", &content)
}

/// Columns of captures with images, and what they are.
const OF_IMAGES: (&str, &str) = (
    "<th>corners</th><th>own pose,<br>px</th><th>through the<br>robot, px</th>",
    "Corners: how many were found. Own pose: RMS distance of the corners from the target at the pose that this image \
     alone gives. Through the robot: the same at the pose that robot and answer give. ",
);

/// A capture in the table of captures.
fn capture_row(k: &CaptureResult, has_images: bool) -> Row {
    let of_image = format!(
        "<td>{}</td><td>{}</td><td>{}</td>",
        k.corners,
        mm(k.residual_px),
        mm(k.reprojection_px)
    );
    let cells = format!(
        "<td>{}</td>{}<td>{}</td><td>{}</td><td>{}</td><td class=\"words\">{}</td>",
        escape(&k.id),
        if has_images { of_image } else { String::new() },
        mm(k.residual_mm),
        deg(k.residual_deg),
        mm(k.held_out_mm),
        k.reason.as_deref().map_or(String::new(), escape)
    );
    let residual = k.held_out_mm.or(k.residual_mm).unwrap_or(0.0);
    let (class, worse) = if k.used { ("", residual) } else { ("out", f64::INFINITY) };
    Row { capture: Some(k.id.clone()), class, cells, worse }
}

/// A plot that keeps its size on a narrow screen, and scrolls.
fn wide(plot: &str) -> String {
    if plot.is_empty() { String::new() } else { format!("<div class=\"scroll\">{plot}</div>") }
}

fn touches(c: &Calibration) -> String {
    if c.touches.is_empty() {
        return String::new();
    }
    let bars: Vec<plot::Bar> = c
        .touches
        .iter()
        .map(|t| plot::Bar {
            name: format!("{} {}", t.capture, t.corner),
            value: t.residual_mm,
            second: None,
        })
        .collect();
    let row = |t: &handeye::calibrate::result::TouchResult| {
        let d = t.difference_mm;
        let cells = format!(
            "<td>{}</td><td>{}</td><td>{:.3}</td><td>{:.3}</td><td>{:.3}</td><td>{:.3}</td>",
            escape(&t.capture),
            t.corner,
            t.residual_mm,
            d.x,
            d.y,
            d.z
        );
        Row { capture: None, class: "", cells, worse: t.residual_mm }
    };
    let head = "<th>placement</th><th>corner</th><th>distance, mm</th><th>x, mm</th><th>y, mm</th><th>z, mm</th>";
    let content = format!(
        "{}{}<p class=\"note\">Tip minus corner as the answer predicts it, in the base frame, the largest distance first{}.</p>",
        wide(&plot::bars(&bars, "mm", ("distance", ""))),
        folded("touches", head, c.touches.iter().map(row).collect()),
        if c.touches.iter().any(|t| t.used) {
            "; the answer was made with these touches"
        } else {
            "; the answer has not seen these touches"
        }
    );
    section("Touches", "", &content)
}

fn view(report: &Report) -> String {
    let c = report.calibration;
    let Some(scene) = cell::scene(c, &report.cell) else {
        return String::new();
    };
    section("The cell", "", &scene.html("robot base, flange poses, camera and targets"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(count: usize) -> Vec<Row> {
        let row = |k: usize| Row {
            capture: None,
            class: "",
            cells: format!("<td>{k}</td>"),
            worse: k as f64,
        };
        (0..count).map(row).collect()
    }

    #[test]
    fn of_many_rows_the_worst_are_shown_and_the_others_on_demand() {
        let table = folded("captures", "<th>capture</th>", rows(20));
        assert_eq!(table.matches("<tr class=\" more\">").count(), 10);
        let worst = table.find("<td>19</td>").unwrap();
        assert!(worst < table.find(" more").unwrap() && worst < table.find("<td>3</td>").unwrap());
        assert!(table.contains("for=\"all-captures\">all 20, not only the worst 10<"));
    }

    #[test]
    fn few_rows_are_all_shown() {
        let table = folded("captures", "<th>capture</th>", rows(14));
        assert!(!table.contains("checkbox") && !table.contains(" more"));
    }

    #[test]
    fn one_notation_is_chosen_and_all_can_be_copied() {
        let all = ["ur", "kuka"].map(|name| (name.to_owned(), format!("<{name}>")));
        let tabs = in_notations(&all);
        assert_eq!(tabs.matches(" checked").count(), 1);
        assert_eq!(tabs.matches("class=\"copy\"").count(), 2);
        assert!(tabs.contains("<pre>&lt;kuka&gt;</pre>"));
        assert!(in_notations(&[]).is_empty());
    }
}
