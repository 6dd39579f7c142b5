//! No file of the core uses one that uses it, however far around: what belongs to both stands in a file of its own.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::Path,
};

/// Modules by path (`calibrate::views`), with what they are made of.
type Modules = BTreeMap<String, String>;
/// Who uses whom.
type Uses = BTreeMap<String, BTreeSet<String>>;

/// All modules of a folder, without their tests and comments.
fn modules(folder: &Path, inside: &str, all: &mut Modules) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap();
        let below = if inside.is_empty() { stem.to_owned() } else { format!("{inside}::{stem}") };
        if path.is_dir() {
            modules(&path, &below, all);
        } else if path.extension().is_some_and(|e| e == "rs") && stem != "tests" {
            let text = fs::read_to_string(&path).unwrap();
            let product = text.split("#[cfg(test)]").next().unwrap();
            let code = product.lines().filter(|line| !line.trim_start().starts_with("//"));
            let name = if stem == "mod" { inside.to_owned() } else { below };
            all.insert(name, code.collect::<Vec<_>>().join("\n"));
        }
    }
}

/// The paths of a `use` tree: `a::{b, c::d}` is `a::b` and `a::c::d`.
fn unfolded(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some(open) = tree.find('{') else {
        return vec![tree.split(" as ").next().unwrap().trim().to_owned()];
    };
    let (head, inner) = (&tree[..open], &tree[open + 1..tree.rfind('}').unwrap()]);
    let (mut parts, mut depth, mut begins) = (vec![], 0, 0);
    for (k, c) in inner.char_indices() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if c == ',' && depth == 0 {
            parts.push(&inner[begins..k]);
            begins = k + 1;
        }
    }
    parts.push(&inner[begins..]);
    let parts = parts.into_iter().filter(|part| !part.trim().is_empty());
    parts.flat_map(unfolded).map(|path| format!("{head}{path}")).collect()
}

/// A path from the top of the crate; `None` for other crates.
fn absolute(path: &str, module: &str, modules: &Modules) -> Option<String> {
    let top = module == "lib";
    let mut base: Vec<&str> = if top { vec![] } else { module.split("::").collect() };
    let mut parts = path.split("::").peekable();
    match *parts.peek()? {
        "crate" => return Some(parts.skip(1).collect::<Vec<_>>().join("::")),
        "self" => drop(parts.next()),
        "super" => {
            while parts.next_if_eq(&"super").is_some() {
                base.pop();
            }
        }
        first if top && modules.contains_key(first) => {}
        first if modules.contains_key(&format!("{module}::{first}")) => {}
        _ => return None,
    }
    Some(base.into_iter().chain(parts).collect::<Vec<_>>().join("::"))
}

/// The `use` statements of some code: their trees, and whether they are public; and the code without them.
fn statements(code: &str) -> (Vec<(String, bool)>, String) {
    let (mut all, mut rest) = (vec![], String::new());
    let is_tree = |c: char| c.is_alphanumeric() || c.is_whitespace() || "_:{},*;".contains(c);
    for part in code.split_inclusive(';') {
        let at = part.match_indices("use ").map(|(at, _)| at).find(|&at| {
            let line = part[..at].rsplit('\n').next().unwrap().trim();
            let is_statement = part[at..].chars().all(is_tree); // and no words that begin a line of text
            is_statement
                && (line.is_empty()
                    || line == "pub"
                    || line.starts_with("pub(") && line.ends_with(')'))
        });
        match at {
            Some(at) => {
                let tree = part[at + 4..].trim_end_matches(';').to_owned();
                let line = part[..at].rsplit('\n').next().unwrap();
                all.push((tree, line.trim().starts_with("pub")));
                rest += &part[..at - line.len()];
            }
            None => rest += part,
        }
    }
    (all, rest)
}

/// Paths in the code itself that begin in another module: `super::a::b`, `crate::a::b`, `child::f`; who may see a thing,
/// `pub(in crate::a)`, is no use of it.
fn paths(code: &str) -> Vec<String> {
    let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let code = code.replace("pub(in crate::", "pub(in ");
    code.split(|c| !is_path(c)).filter(|word| word.contains("::")).map(String::from).collect()
}

/// Where names that a module hands on come from.
fn handed_on(modules: &Modules) -> BTreeMap<String, String> {
    let mut all = BTreeMap::new();
    for (module, code) in modules {
        for (tree, _) in statements(code).0.into_iter().filter(|(_, public)| *public) {
            for path in unfolded(&tree) {
                if let Some(from) = absolute(&path, module, modules) {
                    let name = path.rsplit("::").next().unwrap();
                    let top = if module == "lib" { String::new() } else { format!("{module}::") };
                    all.insert(format!("{top}{name}"), from);
                }
            }
        }
    }
    all
}

/// The module in which a path ends, names that were handed on followed to where they come from.
fn defined_in(path: &str, modules: &Modules, handed: &BTreeMap<String, String>) -> Option<String> {
    let mut path = path.to_owned();
    for _ in 0..5 {
        let parts: Vec<&str> = path.split("::").collect();
        let prefix = |n: usize| parts[..n].join("::");
        let known = (1..=parts.len()).rev().find(|&n| modules.contains_key(&prefix(n)));
        let name = prefix((known.unwrap_or(0) + 1).min(parts.len()));
        match handed.get(&name) {
            Some(from) if known != Some(parts.len()) => path = from.clone(),
            _ => return known.map(prefix),
        }
    }
    None
}

fn uses(modules: &Modules) -> Uses {
    let handed = handed_on(modules);
    let mut all = Uses::new();
    for (module, code) in modules.iter().filter(|(name, _)| *name != "lib") {
        let (trees, rest) = statements(code);
        // a module that hands on names of its own parts does not use them by that
        let own = format!("{module}::");
        let trees = trees.iter().flat_map(|(tree, public)| {
            let of_part = |path: &String| {
                *public && absolute(path, module, modules).is_some_and(|p| p.starts_with(&own))
            };
            unfolded(tree).into_iter().filter(move |path| !of_part(path)).collect::<Vec<_>>()
        });
        let paths = trees.chain(paths(&rest));
        let absolute = paths.filter_map(|path| absolute(&path, module, modules));
        let used = absolute.filter_map(|path| defined_in(&path, modules, &handed));
        all.insert(module.clone(), used.filter(|used| used != module).collect());
    }
    all
}

/// Modules that are used, in one step or more, by what they use.
fn in_circles(uses: &Uses) -> Vec<String> {
    let reaches_itself = |start: &&String| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![*start]);
        while let Some(module) = open.pop() {
            for used in uses.get(module).into_iter().flatten() {
                if used == *start {
                    return true;
                }
                if seen.insert(used) {
                    open.push(used);
                }
            }
        }
        false
    };
    uses.keys().filter(reaches_itself).cloned().collect()
}

#[test]
fn no_file_uses_one_that_uses_it() {
    let mut all = Modules::new();
    modules(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), "", &mut all);
    assert!(all.len() > 200, "{} files", all.len());
    let found = uses(&all);
    assert!(
        found["calibrate"].contains("calibrate::captures::agreement"),
        "{:?}",
        found["calibrate"]
    );
    assert_eq!(in_circles(&found), Vec::<String>::new());
}

/// The first two names of a module's path: `calibrate::flow` of `calibrate::flow::views`.
fn room(module: &str) -> String {
    module.splitn(3, "::").take(2).collect::<Vec<_>>().join("::")
}

#[test]
fn the_flow_has_few_rooms_and_none_uses_one_that_uses_it() {
    let mut all = Modules::new();
    modules(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), "", &mut all);
    let mut rooms = Uses::new();
    for (module, used) in uses(&all) {
        let own = room(&module);
        let others = used.iter().map(|m| room(m)).filter(|other| *other != own);
        rooms.entry(own.clone()).or_default().extend(others);
    }
    let of_the_flow = rooms.keys().filter(|room| room.starts_with("calibrate::")).count();
    assert!((5..=12).contains(&of_the_flow), "{of_the_flow} rooms in calibrate/");
    let circles = in_circles(&rooms).into_iter().filter(|room| room.starts_with("calibrate"));
    assert_eq!(circles.collect::<Vec<_>>(), Vec::<String>::new());
}

#[test]
fn circles_are_found_through_parents_and_names_that_were_handed_on() {
    let files = [
        ("lib", "pub use room::Thing;"),
        ("room", "mod inner;\nmod other;\npub use inner::Thing;\nfn f() { other::g() }"),
        ("room::inner", "pub struct Thing;\npub(in crate::room) fn h() {}"),
        ("room::other", "use crate::Thing;\npub fn g() {}"),
    ];
    let with = |path: &str, code: &str| {
        let mut all: Modules = files.map(|(p, c)| (p.into(), c.into())).into();
        all.insert(path.into(), code.into());
        in_circles(&uses(&all))
    };
    assert_eq!(with("room::inner", files[2].1), Vec::<String>::new());
    let through_a_name = with("room::inner", "use super::other::g;\npub struct Thing;");
    assert_eq!(through_a_name, ["room::inner", "room::other"]);
    let through_the_parent = with("room::other", "use super::f;\npub fn g() {}");
    assert_eq!(through_the_parent, ["room", "room::other"]);
}
