//! Files of a folder that belong together, and the pattern that names them.

use std::{
    fs,
    path::{Path, PathBuf},
};

use handeye::model::names::natural;

use crate::{
    MANIFEST,
    error::Error,
    files::{extension, matches, runs},
};

/// Folders deeper than this are not looked into.
const DEEPEST: usize = 3;
/// Most files that are looked at.
const MOST_FILES: usize = 20_000;
/// What this program writes is no measurement.
const OWN: [&str; 4] = [MANIFEST, "truth.json", "calibration.json", "report.html"];

/// Files whose names differ in their numbers only.
#[derive(Debug, Clone)]
pub(super) struct Group {
    /// What the manifest calls them.
    pub(super) pattern: String,
    /// Their names below the folder, in natural order.
    pub(super) members: Vec<PathBuf>,
}

impl Group {
    pub(super) fn extension(&self) -> String {
        extension(&self.members[0])
    }

    /// Whether the name says so.
    pub(super) fn is_called(&self, words: &[&str]) -> bool {
        let name = self.pattern.to_lowercase();
        words.iter().any(|word| name.contains(word))
    }

    /// `3 files`.
    pub(super) fn size(&self) -> String {
        match self.members.len() {
            1 => "1 file".into(),
            n => format!("{n} files"),
        }
    }
}

/// All files below a folder, in groups; the largest first.
pub(super) fn groups(folder: &Path) -> Result<Vec<Group>, Error> {
    let mut paths = Vec::new();
    list(folder, folder, 0, &mut paths)?;
    let mut sets = by_key(paths.iter().cloned().map(|p| vec![p]).collect(), |p| {
        slashed(p.parent().unwrap_or(Path::new(""))) + "/" + &without_digits(&name(p))
    });
    // one file in each of several folders: pose_00/data.json, pose_01/data.json
    let (singles, several) = sets.drain(..).partition(|s: &Vec<PathBuf>| s.len() == 1);
    sets = several;
    sets.extend(by_key(singles, |p| without_digits(&slashed(p))));
    let group = |members: Vec<PathBuf>| Group { pattern: pattern(&members, &paths), members };
    let mut groups: Vec<Group> = sets.into_iter().map(group).collect();
    groups.sort_by_key(|g| std::cmp::Reverse(g.members.len()));
    Ok(groups)
}

fn list(folder: &Path, root: &Path, depth: usize, into: &mut Vec<PathBuf>) -> Result<(), Error> {
    let read = |source| Error::Read { path: folder.into(), source };
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).map_err(read)?.flatten().map(|e| e.path()).collect();
    entries.sort_by(|a, b| natural(&a.to_string_lossy(), &b.to_string_lossy()));
    for path in entries {
        let own = name(&path).starts_with('.') || OWN.contains(&name(&path).as_str());
        if path.is_dir() && depth < DEEPEST {
            list(&path, root, depth + 1, into)?;
        } else if path.is_file() && !own && into.len() < MOST_FILES {
            into.push(path.strip_prefix(root).unwrap_or(&path).to_path_buf());
        }
    }
    Ok(())
}

/// Sets of one key put together, in the order in which they came.
fn by_key(sets: Vec<Vec<PathBuf>>, key: impl Fn(&Path) -> String) -> Vec<Vec<PathBuf>> {
    let mut at = std::collections::HashMap::new();
    let mut together: Vec<Vec<PathBuf>> = Vec::new();
    for set in sets {
        let k = *at.entry(key(&set[0])).or_insert(together.len());
        if k == together.len() {
            together.push(vec![]);
        }
        together[k].extend(set);
    }
    together
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

fn slashed(path: &Path) -> String {
    path.to_string_lossy().replace('\\', "/")
}

fn is_number(run: &str) -> bool {
    run.starts_with(|c: char| c.is_ascii_digit())
}

fn without_digits(name: &str) -> String {
    runs(name).into_iter().map(|run| if is_number(run) { "#" } else { run }).collect()
}

/// A star for each number that differs; question marks where a star would take other files, too.
fn pattern(members: &[PathBuf], all: &[PathBuf]) -> String {
    let names: Vec<String> = members.iter().map(|p| slashed(p)).collect();
    let split: Vec<Vec<&str>> = names.iter().map(|n| runs(n)).collect();
    let with = |wild: &dyn Fn(usize) -> String| -> String {
        let run = |k: usize| {
            if split.iter().all(|s| s[k] == split[0][k]) { split[0][k].into() } else { wild(k) }
        };
        (0..split[0].len()).map(run).collect()
    };
    let stars = with(&|_| "*".into());
    let alike = |k: usize| split.iter().all(|s| s[k].len() == split[0][k].len());
    let takes_others = all.iter().any(|p| covers(&stars, &slashed(p)) && !members.contains(p));
    if !takes_others {
        return stars;
    }
    with(&|k| if alike(k) { "?".repeat(split[0][k].len()) } else { "*".into() })
}

fn covers(pattern: &str, path: &str) -> bool {
    let (pattern, path): (Vec<&str>, Vec<&str>) =
        (pattern.split('/').collect(), path.split('/').collect());
    pattern.len() == path.len() && pattern.iter().zip(path).all(|(p, n)| matches(p, n))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(names: &[&str]) -> String {
        let all: Vec<PathBuf> =
            ["i/001.png", "i/002.png", "i/place-1.png", "p_00/d.json", "p_01/d.json"]
                .map(PathBuf::from)
                .to_vec();
        pattern(&names.iter().map(PathBuf::from).collect::<Vec<_>>(), &all)
    }

    #[test]
    fn a_pattern_takes_its_own_files_and_no_others() {
        assert_eq!(named(&["i/001.png", "i/002.png"]), "i/???.png");
        assert_eq!(named(&["p_00/d.json", "p_01/d.json"]), "p_*/d.json");
        assert_eq!(named(&["i/place-1.png"]), "i/place-1.png");
    }
}
