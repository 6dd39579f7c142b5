//! Records of a JSON, YAML or XML document, found by a path like `poses.*.joint_angles_deg`.
//!
//! Segments are apart by dots; a segment is a key, an index from 0, or a pattern: `*` takes every
//! element of a list and every key of a map, `T1_*` every key that starts so. Keys come in natural
//! order.

use std::path::Path;

use super::{Cell, Layout, Record, lines::ID_NAMES};
use handeye::model::names::natural;

use crate::{
    error::{Error, Place, malformed, nearest},
    files::{is_pattern, matches},
    tree::Tree,
};

/// A value that a path leads to.
#[derive(Clone)]
struct Found<'a> {
    tree: &'a Tree,
    path: String,
    id: Option<String>,
}

pub(super) fn records(path: &Path, layout: &Layout) -> Result<Vec<Record>, Error> {
    let tree = Tree::read(path)?;
    if layout.fields.is_empty() {
        let whole = if is_list_of_records(&tree) { "*" } else { "" };
        return select(&tree, whole, path)?.into_iter().map(|f| record(f, path)).collect();
    }
    let mut all: Option<Vec<Record>> = None;
    for field in &layout.fields {
        let found = select(&tree, field, path)?;
        let part = found.into_iter().map(|f| record(f, path)).collect::<Result<Vec<_>, _>>()?;
        all = Some(match all {
            None => part,
            Some(before) => side_by_side(before, part, layout, path)?,
        });
    }
    Ok(all.unwrap_or_default())
}

/// A list whose elements are maps, or hold enough numbers for a pose each.
fn is_list_of_records(tree: &Tree) -> bool {
    let Tree::List(items) = tree else { return false };
    items
        .iter()
        .all(|item| matches!(item, Tree::Map(_)) || item.numbers().is_some_and(|n| n.len() >= 6))
}

fn side_by_side(
    left: Vec<Record>,
    right: Vec<Record>,
    layout: &Layout,
    path: &Path,
) -> Result<Vec<Record>, Error> {
    if left.len() != right.len() {
        return Err(Error::CountMismatch {
            place: Place::file(path),
            left: left.len(),
            left_name: format!("values of {}", layout.fields[0]),
            right: right.len(),
            right_name: "values of a field beside it".into(),
            advice: "all fields must name the same records".into(),
        });
    }
    let pair = |(l, r): (Record, Record)| {
        let id = l.id.clone();
        Record { id, ..super::joined(vec![l, r]) }
    };
    Ok(left.into_iter().zip(right).map(pair).collect())
}

fn select<'a>(tree: &'a Tree, field: &str, path: &Path) -> Result<Vec<Found<'a>>, Error> {
    let mut found = vec![Found { tree, path: String::new(), id: None }];
    for segment in field.split('.').filter(|s| !s.is_empty()) {
        let next: Vec<Found> = found.iter().flat_map(|f| step(f, segment)).collect();
        if next.is_empty() {
            return Err(nothing_there(&found, segment, field, path));
        }
        found = next;
    }
    Ok(found)
}

fn step<'a>(from: &Found<'a>, segment: &str) -> Vec<Found<'a>> {
    let path = |key: &str| {
        if from.path.is_empty() { key.to_string() } else { format!("{}.{key}", from.path) }
    };
    match from.tree {
        Tree::List(items) if segment == "*" => {
            let item = |(i, tree): (usize, &'a Tree)| Found {
                tree,
                path: path(&i.to_string()),
                id: own_id(tree).or_else(|| from.id.clone()),
            };
            items.iter().enumerate().map(item).collect()
        }
        Tree::List(items) => {
            let item = segment.parse::<usize>().ok().and_then(|i| items.get(i));
            item.map(|tree| Found { tree, path: path(segment), id: from.id.clone() })
                .into_iter()
                .collect()
        }
        Tree::Map(entries) => {
            let mut hits: Vec<_> = entries.iter().filter(|(k, _)| matches(segment, k)).collect();
            hits.sort_by(|a, b| natural(&a.0, &b.0));
            let id = |key: &String| {
                if is_pattern(segment) { Some(key.clone()) } else { from.id.clone() }
            };
            hits.into_iter()
                .map(|(key, tree)| Found { tree, path: path(key), id: id(key) })
                .collect()
        }
        _ => vec![],
    }
}

/// What an element calls itself.
fn own_id(tree: &Tree) -> Option<String> {
    match tree.any(&ID_NAMES)? {
        Tree::Text(text) => Some(text.clone()),
        Tree::Number(x) => Some(x.to_string()),
        _ => None,
    }
}

fn nothing_there(found: &[Found], segment: &str, field: &str, path: &Path) -> Error {
    let keys: Vec<&str> = match found.first().map(|f| f.tree) {
        Some(Tree::Map(entries)) => entries.iter().map(|(k, _)| k.as_str()).collect(),
        _ => vec![],
    };
    let advice = match (nearest(segment, keys.iter().copied()), found.first().map(|f| f.tree)) {
        (Some(near), _) => format!("did you mean {near}?"),
        (None, Some(Tree::List(items))) => {
            format!("there is a list of {} here: use * or an index", items.len())
        }
        _ if keys.is_empty() => "there is a single value here".into(),
        _ => format!("the keys here are {}", keys[..keys.len().min(12)].join(", ")),
    };
    malformed(Place::field(path, field), format!("nothing is called {segment}"), advice)
}

fn record(found: Found, path: &Path) -> Result<Record, Error> {
    let mut named = Vec::new();
    if let Some(numbers) = found.tree.numbers() {
        named.extend(numbers.into_iter().map(|x| (String::new(), Cell::Number(x))));
    } else {
        flatten(found.tree, "", &mut named);
    }
    let place =
        if found.path.is_empty() { Place::file(path) } else { Place::field(path, found.path) };
    if named.is_empty() {
        return Err(malformed(place, "holds no values", "correct the file or the field"));
    }
    let all_named = named.iter().all(|(name, _)| !name.is_empty());
    let (names, cells): (Vec<String>, Vec<Cell>) = named.into_iter().unzip();
    Ok(Record {
        cells,
        names: if all_named { names } else { vec![] },
        by_header: false,
        id: found.id,
        place,
    })
}

/// Leaves of nested maps, each under the dotted path of its keys.
fn flatten(tree: &Tree, name: &str, into: &mut Vec<(String, Cell)>) {
    match tree {
        Tree::Number(x) => into.push((name.into(), Cell::Number(*x))),
        Tree::Text(text) => into.push((name.into(), Cell::Text(text.clone()))),
        Tree::Bool(_) | Tree::Null => {}
        Tree::List(items) => items.iter().for_each(|item| flatten(item, name, into)),
        Tree::Map(entries) => {
            for (key, value) in entries {
                let path = if name.is_empty() { key.clone() } else { format!("{name}.{key}") };
                flatten(value, &path, into);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree() -> Tree {
        serde_json::from_str(
            r#"{"T_10": [1, 2], "T_2": [[3], [4]], "poses": [{"id": 7, "q": {"x": 1, "y": 2}}]}"#,
        )
        .unwrap()
    }

    fn cells(field: &str) -> Vec<Record> {
        let tree = tree();
        let found = select(&tree, field, Path::new("a.json")).unwrap();
        found.into_iter().map(|f| record(f, Path::new("a.json")).unwrap()).collect()
    }

    #[test]
    fn a_pattern_takes_keys_in_natural_order() {
        let records = cells("T_*");
        assert_eq!(records[0].cells, [Cell::Number(3.0), Cell::Number(4.0)]);
        assert_eq!(records[1].id.as_deref(), Some("T_10"));
    }

    #[test]
    fn named_values_keep_their_names_and_their_place() {
        let records = cells("poses.*.q");
        assert_eq!(records[0].names, ["x", "y"]);
        assert_eq!(records[0].id.as_deref(), Some("7"));
        assert_eq!(records[0].place.to_string(), "a.json [poses.0.q]");
    }

    #[test]
    fn a_path_that_leads_nowhere_names_the_nearest_key() {
        let tree = tree();
        let error = select(&tree, "pose.*.q", Path::new("a.json")).err().unwrap();
        assert_eq!(
            error.to_string(),
            "a.json [pose.*.q]: nothing is called pose; did you mean poses?"
        );
    }
}
