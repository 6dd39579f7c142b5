//! A manifest with other values: its comments and all other lines stay as they are.

use std::path::{Path, PathBuf};

use super::{Change, Explanation};
use crate::{Dataset, Error, Place, dataset::Source, error::malformed, files};

/// Sizes that a manifest may declare.
const SIZES: [&str; 6] = ["square_mm", "marker_mm", "tag_mm", "pitch_mm", "size_mm", "diameter_mm"];
/// Old manifests that are kept, at most.
const MOST_BACKUPS: usize = 100;

/// Writes a manifest with an explanation's changes, and keeps the old one beside it; returns the
/// old one's name. Measured files are not touched. Names in the manifest are relative to `root`.
///
/// # Errors
/// A manifest in which the changes have no place of their own (inline tables, dotted keys), one
/// that could not be read with them, and what cannot be written.
pub fn apply(manifest: &Path, root: &Path, explanation: &Explanation) -> Result<PathBuf, Error> {
    let text = files::text(manifest)?;
    let corrected = explanation.changes.iter().fold(text.clone(), |text, c| amended(&text, c));
    let source = Source { path: manifest.to_path_buf(), text: corrected.clone() };
    if let Err(e) = Dataset::of_source(source, root) {
        let lines: Vec<String> = explanation
            .changes
            .iter()
            .map(|c| format!("[{}] {} = {}", c.table, c.key, c.value))
            .collect();
        return Err(malformed(
            Place::file(manifest),
            format!("cannot be corrected line by line ({e})"),
            format!("write by hand: {}", lines.join(", ")),
        ));
    }
    let backup = (0..MOST_BACKUPS)
        .map(|k| if k == 0 { "toml.bak".to_owned() } else { format!("toml.bak{k}") })
        .map(|ending| manifest.with_extension(ending))
        .find(|p| !p.exists())
        .ok_or_else(|| {
            let what = format!("{MOST_BACKUPS} old manifests lie beside it");
            malformed(Place::file(manifest), what, "remove the .bak files")
        })?;
    files::write_atomically(&backup, text.as_bytes())?;
    files::write_atomically(manifest, corrected.as_bytes())?;
    Ok(backup)
}

/// The lines of a table: after its header, up to the next one.
fn lines_of(lines: &[String], table: &str) -> Option<std::ops::Range<usize>> {
    let is_header = |line: &String| {
        let line = line.split('#').next().unwrap_or_default().trim();
        line.strip_prefix('[').and_then(|l| l.strip_suffix(']')).is_some_and(|l| l.trim() == table)
    };
    let first = if table.is_empty() { 0 } else { lines.iter().position(is_header)? + 1 };
    let next = (first..lines.len()).find(|&k| lines[k].trim_start().starts_with('['));
    Some(first..next.unwrap_or(lines.len()))
}

fn line_with(lines: &[String], table: &str, key: &str) -> Option<usize> {
    let is_key =
        |line: &str| line.split_once('=').is_some_and(|(k, _)| k.trim().trim_matches('"') == key);
    lines_of(lines, table)?.find(|&k| is_key(&lines[k]))
}

fn lines(text: &str) -> Vec<String> {
    text.lines().map(String::from).collect()
}

/// The value of a key, as TOML, where it stands on a line of its own.
pub(super) fn value(text: &str, table: &str, key: &str) -> Option<String> {
    let lines = lines(text);
    let line = &lines[line_with(&lines, table, key)?];
    Some(line.split_once('=')?.1.split('#').next()?.trim().to_owned())
}

/// A manifest with one value changed or added.
fn amended(text: &str, change: &Change) -> String {
    let Change { table, key, value } = change;
    let mut lines = lines(text);
    if let Some(at) = line_with(&lines, table, key) {
        let comment = lines[at].split_once('#').map_or(String::new(), |(_, c)| format!("  #{c}"));
        lines[at] = format!("{key} = {value}{comment}");
    } else {
        if lines_of(&lines, table).is_none() {
            lines.extend([String::new(), format!("[{table}]")]);
        }
        let at = lines_of(&lines, table).map_or(lines.len(), |l| l.start);
        lines.insert(at, format!("{key} = {value}"));
    }
    let ending = if text.contains("\r\n") { "\r\n" } else { "\n" };
    lines.join(ending) + ending
}

/// Captures that are left out, beside those that are already.
pub(super) fn excluding(text: &str, captures: &[String]) -> Vec<Change> {
    let declared = value(text, "captures", "exclude").unwrap_or("[]".into());
    let parsed: Option<toml::Table> = toml::from_str(&format!("all = {declared}")).ok();
    let mut all =
        parsed.and_then(|table| table.get("all")?.as_array().cloned()).unwrap_or_default();
    all.extend(captures.iter().map(|id| toml::Value::String(id.clone())));
    let value = toml::Value::Array(all).to_string();
    vec![Change { table: "captures", key: "exclude".into(), value }]
}

/// Every size of the target, times `scale`.
pub(super) fn resized(text: &str, scale: f64) -> Vec<Change> {
    let size = |key: &&str| {
        let declared = value(text, "target", key)?.parse::<f64>().ok()?;
        let value = format!("{:?}", (declared * scale * 1e4).round() / 1e4);
        Some(Change { table: "target", key: (*key).into(), value })
    };
    SIZES.iter().filter_map(size).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(text: &str, table: &'static str, key: &str, value: &str) -> String {
        amended(text, &Change { table, key: key.into(), value: value.into() })
    }

    #[test]
    fn a_key_is_replaced_or_added_in_its_table() {
        let text = "setup = \"eye-in-hand\"\n\n[robot]\nposes = \"a\"\nnotation = \"ur\" # pendant\n\n[images]\nfiles = \"b\"\n";
        let changed = with(text, "robot", "notation", "\"kuka\"");
        assert!(changed.contains("notation = \"kuka\"  # pendant\n"), "{changed}");
        let added = with(&changed, "robot", "angle_unit", "\"deg\"");
        assert!(added.contains("[robot]\nangle_unit = \"deg\"\nposes"), "{added}");
        let setup = with(&added, "", "setup", "\"eye-to-hand\"");
        assert!(setup.starts_with("setup = \"eye-to-hand\"\n"), "{setup}");
        assert!(with("a = 1\r\n", "robot", "b", "2").ends_with("\r\n[robot]\r\nb = 2\r\n"));
    }

    #[test]
    fn captures_are_left_out_beside_others() {
        let ids = ["006".to_owned(), "a \"b\"".to_owned()];
        for (text, count) in [("", 2), ("[captures]\nexclude = [\"001\"] # dark\n", 3)] {
            let changed = amended(text, &excluding(text, &ids)[0]);
            let read: toml::Table = toml::from_str(&changed).unwrap();
            let all = read["captures"]["exclude"].as_array().unwrap();
            assert_eq!((all.len(), all[count - 1].as_str()), (count, Some("a \"b\"")), "{changed}");
        }
    }

    #[test]
    fn sizes_of_the_target_alone_change() {
        let text = "[board]\nsize_mm = 3.0\n[target] # a board\nsquare_mm = 20.0 # printed\n";
        let changes = resized(text, 1.1);
        assert_eq!(changes.len(), 1);
        assert_eq!((changes[0].key.as_str(), changes[0].value.as_str()), ("square_mm", "22.0"));
    }
}
