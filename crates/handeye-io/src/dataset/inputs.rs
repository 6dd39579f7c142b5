//! The files that a manifest names, whatever for.

use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
};

use toml::Value;

use super::manifest::Source;
use crate::{error::Place, files};

/// Keys whose texts are not names of files.
const NO_FILES: [&str; 8] =
    ["field", "notation", "direction", "columns", "rows", "id", "name", "frames"];

/// The manifest, and every file that a text in it names; in the order of their paths.
pub(super) fn files(manifest: &Source, root: &Path) -> Vec<PathBuf> {
    let mut named = BTreeSet::new();
    if let Ok(table) = toml::from_str::<toml::Table>(&manifest.text) {
        gather(&Value::Table(table), root, &mut named);
    }
    std::iter::once(manifest.path.clone()).chain(named).collect()
}

fn gather(value: &Value, root: &Path, named: &mut BTreeSet<PathBuf>) {
    match value {
        Value::String(name) => {
            let found = files::expand(root, name, &Place::default()).unwrap_or_default();
            named.extend(found.into_iter().filter(|path| path.is_file()));
        }
        Value::Array(all) => all.iter().for_each(|value| gather(value, root, named)),
        Value::Table(table) => {
            let of_files = table.iter().filter(|(key, _)| !NO_FILES.contains(&key.as_str()));
            of_files.for_each(|(_, value)| gather(value, root, named));
        }
        _ => {}
    }
}
