//! Where in a document poses may stand.

use crate::{files::runs, tree::Tree};

/// Values of one shape at one kind of place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    /// The manifest's `field`.
    pub(super) path: String,
    /// How many places there are.
    pub(super) count: usize,
    /// How many numbers each holds.
    pub(super) numbers: usize,
}

/// Numbers of a pose: angles or joints, quaternions, matrices.
const OF_A_POSE: [usize; 4] = [6, 7, 12, 16];
/// Longer lists hold records, shorter ones the parts of one.
const MOST_PARTS: usize = 2;
/// Deeper documents are not looked into.
const DEEPEST: usize = 6;

/// All of them, those with most places first.
pub(super) fn fields(tree: &Tree) -> Vec<Field> {
    let mut all = Vec::new();
    look(tree, String::new(), 0, &mut all);
    all.sort_by_key(|f| std::cmp::Reverse(f.count));
    all
}

fn look(tree: &Tree, path: String, depth: usize, all: &mut Vec<Field>) {
    let numbers = values(tree);
    if let Some(numbers) = numbers.filter(|n| OF_A_POSE.contains(n)) {
        match all.iter_mut().find(|f| f.path == path && f.numbers == numbers) {
            Some(known) => known.count += 1,
            None => all.push(Field { path, count: 1, numbers }),
        }
        return;
    }
    if depth == DEEPEST {
        return;
    }
    let below = |step: String| if path.is_empty() { step } else { format!("{path}.{step}") };
    match tree {
        Tree::List(items) => items.iter().enumerate().for_each(|(k, item)| {
            let step = if items.len() > MOST_PARTS { "*".into() } else { k.to_string() };
            look(item, below(step), depth + 1, all);
        }),
        Tree::Map(entries) => {
            let alone =
                |key: &str| entries.iter().filter(|(k, _)| starred(k) == starred(key)).count() == 1;
            for (key, item) in entries {
                let step = if alone(key) { key.clone() } else { starred(key) };
                look(item, below(step), depth + 1, all);
            }
        }
        _ => {}
    }
}

/// Numbers of a list, or of a map of numbers.
fn values(tree: &Tree) -> Option<usize> {
    match tree {
        Tree::Map(entries) if tree.numbers().is_none() => {
            entries.iter().all(|(_, v)| matches!(v, Tree::Number(_))).then_some(entries.len())
        }
        Tree::List(_) | Tree::Map(_) => tree.numbers().map(|n| n.len()),
        _ => None,
    }
}

/// `T1_*` for `T1_17`.
fn starred(key: &str) -> String {
    let all = runs(key);
    match all.split_last() {
        Some((last, before)) if last.starts_with(|c: char| c.is_ascii_digit()) => {
            before.concat() + "*"
        }
        _ => key.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_are_found_wherever_they_stand() {
        let text = r#"{"robot": "x", "poses": [
            {"id": 1, "joints": {"a": 1, "b": 2, "c": 3, "d": 4, "e": 5, "f": 6}, "at": [1, 2, 3]},
            {"id": 2, "joints": {"a": 1, "b": 2, "c": 3, "d": 4, "e": 5, "f": 6}, "at": [1, 2, 3]},
            {"id": 3, "joints": {"a": 1, "b": 2, "c": 3, "d": 4, "e": 5, "f": 6}, "at": [1, 2, 3]}],
            "T1_0": [1, 2, 3, 4, 5, 6, 7], "T1_1": [1, 2, 3, 4, 5, 6, 7]}"#;
        let tree: Tree = serde_json::from_str(text).unwrap();
        let found = fields(&tree);
        let field = |path: &str, count, numbers| Field { path: path.into(), count, numbers };
        assert_eq!(found, [field("poses.*.joints", 3, 6), field("T1_*", 2, 7)]);
    }
}
