//! What the result was made from.

use handeye::{Calibration, calibrate::result::InputFile};

use super::section;
use crate::xml::escape;

/// When, by what and from which files, folded.
pub(super) fn origin(c: &Calibration) -> String {
    let Some(version) = &c.version else { return String::new() };
    let created = c.created.as_ref().map_or(String::new(), |at| format!(" on {}", escape(at)));
    let of = c
        .dataset
        .as_ref()
        .map_or(String::new(), |name| format!(" from the data set {}", escape(name)));
    let parts = c.equipment.in_words();
    let equipment = match parts.is_empty() {
        true => String::new(),
        false => format!("<p>The cell: {}.</p>", escape(&parts.join("; "))),
    };
    let row = |file: &InputFile| {
        format!(
            "<tr><td>{}</td><td><code>{}</code></td></tr>",
            escape(&file.path),
            escape(&file.sha256)
        )
    };
    let rows: String = c.inputs.iter().map(row).collect();
    let content = format!(
        "<p>Made{created}{of} by handeye {}.</p>{equipment}<details><summary>{} files, with their SHA-256</summary>\
         <div class=\"scroll\"><table><tr><th>file</th><th>SHA-256</th></tr>{rows}</table></div></details>",
        escape(version),
        c.inputs.len(),
    );
    section("Origin", "", &content)
}
