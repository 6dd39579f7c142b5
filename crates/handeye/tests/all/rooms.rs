//! The rooms of the core stand in reading order, and use nothing that comes after them.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

/// From the ground up.
const ORDER: [&str; 14] = [
    "error",
    "math",
    "frame",
    "model",
    "findings",
    "detect",
    "intrinsics",
    "solve",
    "register",
    "estimate",
    "mistakes",
    "calibrate",
    "tools",
    "simulate",
];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let nested = |path: PathBuf| if path.is_dir() { sources(&path) } else { vec![path] };
    entries.flat_map(nested).filter(|path| path.extension().is_some_and(|e| e == "rs")).collect()
}

/// What a file is made of, without its tests and comments.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    let product = text.split("#[cfg(test)]").next().unwrap();
    product
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .collect::<Vec<_>>()
        .join("\n")
}

/// The names behind a prefix such as `use crate::`, `{` and nested braces unfolded to their first parts.
fn named_after<'a>(code: &'a str, prefix: &str) -> Vec<&'a str> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let mut names = vec![];
    for (at, _) in code.match_indices(prefix) {
        let rest = &code[at + prefix.len()..];
        if !rest.starts_with('{') {
            names.push(rest.split(|c| !is_name(c)).next().unwrap());
            continue;
        }
        let mut depth = 0;
        let mut begins = 1;
        for (k, c) in rest.char_indices() {
            depth += i32::from(c == '{') - i32::from(c == '}');
            if depth == 0 || (c == ',' && depth == 1) {
                names.push(rest[begins..k].trim().split(|c| !is_name(c)).next().unwrap());
                begins = k + 1;
            }
            if depth == 0 {
                break;
            }
        }
    }
    names.into_iter().filter(|name| !name.is_empty()).collect()
}

/// Which room the names at the top of the crate come from.
fn at_the_top(source: &Path) -> BTreeMap<String, &'static str> {
    let lib = code(&source.join("lib.rs"));
    let of = |room: &&'static str| {
        let from = format!("pub use {room}::");
        let one = |part: &str| -> Vec<String> {
            let statement = part.split(';').next().unwrap();
            let names = statement.split(|c: char| !c.is_alphanumeric() && c != '_');
            names.map(String::from).collect()
        };
        lib.split(&from).skip(1).flat_map(one).map(|name| (name, *room)).collect::<Vec<_>>()
    };
    ORDER.iter().flat_map(of).collect()
}

#[test]
fn no_room_uses_a_later_one() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let top = at_the_top(&source);
    let mut upward = BTreeSet::new();
    for path in sources(&source) {
        let inside = path.strip_prefix(&source).unwrap();
        let name = inside.iter().next().unwrap().to_str().unwrap().trim_end_matches(".rs");
        if name == "lib" || path.file_stem().is_some_and(|stem| stem == "tests") {
            continue;
        }
        let own = ORDER.iter().position(|room| *room == name);
        let own = own.unwrap_or_else(|| panic!("{name} is a new room: where does it stand?"));
        for used in named_after(&code(&path), "crate::") {
            let room = top.get(used).copied().unwrap_or(used);
            if ORDER.iter().position(|r| *r == room).is_some_and(|k| k > own) {
                upward.insert(format!("{} uses {room}::{used}", inside.display()));
            }
        }
    }
    assert!(upward.is_empty(), "{upward:#?}");
}
