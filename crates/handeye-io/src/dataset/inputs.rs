//! The files that a manifest names, whatever for.

use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
};

use toml::Value;

use super::manifest::Source;
use crate::{error::Place, files};

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
        Value::Table(table) => table.values().for_each(|value| gather(value, root, named)),
        _ => {}
    }
}
