//! The predicted error: where it is how large, what it comes from, what would help.

use handeye::{
    Calibration, Verdict,
    calibrate::result::{Advice, BudgetEntry},
};

use super::{escape, map, mm, section};

pub(super) fn predicted_error(c: &Calibration) -> String {
    let content = [slices(c), sources(c), advice(c)].concat();
    if content.is_empty() { content } else { section("Predicted error", "", &content) }
}

fn slices(c: &Calibration) -> String {
    let Some(map) = c.predicted_tre_mm.as_ref().and_then(|t| t.map.as_ref()) else {
        return String::new();
    };
    let slices = map::slices(map);
    if slices.is_empty() {
        return slices;
    }
    let of_robot = match c.robot_errors() {
        Some(_) => {
            " Errors of the robot that depend on its pose, and that no fixed transform can correct, are included."
        }
        None => "",
    };
    format!(
        "<p>Three slices through the middle of the box, in the {} frame; 95 of 100 points of that place are predicted to be \
         off by less than the colour says.{of_robot} Blank is where the camera does not see.</p>{slices}",
        escape(&map.frame)
    )
}

fn sources(c: &Calibration) -> String {
    if c.error_budget.is_empty() {
        return String::new();
    }
    let row = |b: &BudgetEntry| {
        format!(
            "<tr><td>{}</td><td class=\"words\">{}</td><td>{}</td></tr>",
            escape(&b.source),
            escape(&b.sigma),
            mm(b.at_workpiece_mm)
        )
    };
    let rows: String = c.error_budget.iter().map(row).collect();
    format!(
        "<h3>Where it comes from</h3><table><tr><th>source</th><th class=\"words\">one standard deviation, \
         as the data tell</th><th>part of the predicted<br>error, RMS mm</th></tr>{rows}</table>\
         <p class=\"note\">Parts add up in squares.</p>"
    )
}

fn advice(c: &Calibration) -> String {
    let (Some(now), false) = (&c.predicted_tre_mm, c.advice.is_empty()) else {
        return String::new();
    };
    // what an answer not to be used predicts says nothing
    if c.verdict == Verdict::Rejected {
        let item = |a: &Advice| format!("<li>{}</li>", escape(&a.change));
        let items: String = c.advice.iter().map(item).collect();
        return format!("<h3>What would help</h3><ul>{items}</ul>");
    }
    let item = |a: &Advice| {
        let gain = (1.0 - a.predicted_tre_mm / now.rms).max(0.0) * 100.0;
        format!(
            "<li>{}: <b>{:.2} mm</b> ({gain:.0} % less)</li>",
            escape(&a.change),
            a.predicted_tre_mm
        )
    };
    let items: String = c.advice.iter().map(item).collect();
    format!(
        "<h3>What would help</h3><p>Predicted now: <b>{:.2} mm</b> RMS. It would be with</p><ul>{items}</ul>",
        now.rms
    )
}
