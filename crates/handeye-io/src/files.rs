//! Reading with limits, natural order of names, patterns, and writing without halves.

use std::{
    fs::{self, File},
    io::{Read, Write},
    path::{Path, PathBuf},
};

use handeye::model::names::natural;

use crate::error::{Error, Place, malformed};

/// Largest binary file that is read: a 100-megapixel organised cloud fits.
const LARGEST_BYTES: u64 = 2 << 30;
/// Largest text file that is parsed as numbers.
const LARGEST_TEXT: u64 = 256 << 20;

/// The bytes of a file.
pub(crate) fn bytes(path: &Path) -> Result<Vec<u8>, Error> {
    bytes_up_to(path, LARGEST_BYTES)
}

fn bytes_up_to(path: &Path, limit: u64) -> Result<Vec<u8>, Error> {
    let read = |source| Error::Read { path: path.into(), source };
    let meta = fs::metadata(path).map_err(read)?;
    if !meta.is_file() {
        return Err(malformed(Place::file(path), "is not a file", "name a file here"));
    }
    if meta.len() > limit {
        return Err(Error::TooLarge {
            place: Place::file(path),
            what: "the file's size in bytes".into(),
            found: meta.len(),
            limit,
            advice: "is it the right file?".into(),
        });
    }
    let mut bytes = Vec::new();
    File::open(path).map_err(read)?.take(limit).read_to_end(&mut bytes).map_err(read)?;
    if bytes.is_empty() {
        return Err(malformed(Place::file(path), "the file is empty", "record it again"));
    }
    Ok(bytes)
}

/// The way from one folder to another, with slashes; both are complete paths.
pub(crate) fn relative(from: &Path, to: &Path) -> String {
    let (from, to): (Vec<_>, Vec<_>) = (from.components().collect(), to.components().collect());
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        return to.iter().collect::<PathBuf>().display().to_string(); // another drive
    }
    let up = from[shared..].iter().map(|_| "..".into());
    let down = to[shared..].iter().map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<String>>().join("/")
}

/// The text of a table: as [`text`], or as spreadsheets save it, UTF-16 with its mark, or one byte for a letter.
pub(crate) fn table_text(path: &Path) -> Result<String, Error> {
    let bytes = bytes_up_to(path, LARGEST_TEXT)?;
    let words = |word: fn([u8; 2]) -> u16| -> Vec<u16> {
        bytes[2..].chunks_exact(2).map(|two| word([two[0], two[1]])).collect()
    };
    match &bytes[..] {
        [0xff, 0xfe, ..] => Ok(String::from_utf16_lossy(&words(u16::from_le_bytes))),
        [0xfe, 0xff, ..] => Ok(String::from_utf16_lossy(&words(u16::from_be_bytes))),
        _ if str::from_utf8(&bytes).is_err() && !bytes.iter().any(|b| is_control(*b)) => {
            Ok(bytes.iter().map(|b| char::from(*b)).collect())
        }
        _ => in_utf8(bytes, path),
    }
}

/// Whether no text has it.
fn is_control(byte: u8) -> bool {
    byte < 0x20 && !matches!(byte, b'\t' | b'\n' | b'\r')
}

/// The text of a file, without a byte order mark.
pub(crate) fn text(path: &Path) -> Result<String, Error> {
    in_utf8(bytes_up_to(path, LARGEST_TEXT)?, path)
}

fn in_utf8(bytes: Vec<u8>, path: &Path) -> Result<String, Error> {
    let text = String::from_utf8(bytes).map_err(|_| {
        malformed(Place::file(path), "is not UTF-8 text", "save it as UTF-8 (or is it binary?)")
    })?;
    Ok(match text.strip_prefix('\u{feff}') {
        Some(rest) => rest.into(),
        None => text,
    })
}

/// Extension in lower case, empty without one.
pub(crate) fn extension(path: &Path) -> String {
    path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// File name without extension.
pub(crate) fn stem(path: &Path) -> String {
    path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default()
}

/// The last number in a name: 7 for `img_007_cam`.
pub(crate) fn last_number(name: &str) -> Option<u64> {
    let digits = name.trim_end_matches(|c: char| !c.is_ascii_digit());
    let start = digits.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    digits[start..].parse().ok()
}

/// Maximal runs of digits and of other characters.
pub(crate) fn runs(name: &str) -> Vec<&str> {
    let mut runs = Vec::new();
    let mut start = 0;
    let digit = |i: usize| name.as_bytes()[i].is_ascii_digit();
    for i in 1..name.len() {
        if name.is_char_boundary(i) && digit(i) != digit(i - 1) {
            runs.push(&name[start..i]);
            start = i;
        }
    }
    runs.push(&name[start..]);
    runs
}

/// Whether a pattern of `*` and `?` covers a name.
pub(crate) fn matches(pattern: &str, name: &str) -> bool {
    let (p, n): (Vec<char>, Vec<char>) = (pattern.chars().collect(), name.chars().collect());
    let (mut i, mut j, mut star) = (0, 0, None);
    while j < n.len() {
        if i < p.len() && p[i] == '*' {
            star = Some((i, j));
            i += 1;
        } else if i < p.len() && (p[i] == '?' || p[i] == n[j]) {
            (i, j) = (i + 1, j + 1);
        } else if let Some((at, taken)) = star {
            (i, j, star) = (at + 1, taken + 1, Some((at, taken + 1)));
        } else {
            return false;
        }
    }
    p[i..].iter().all(|c| *c == '*')
}

/// Whether a name is a pattern.
pub(crate) fn is_pattern(name: &str) -> bool {
    name.contains(['*', '?'])
}

/// Files below `root` that a pattern names, in natural order; `place` is where the pattern stands.
pub(crate) fn expand(root: &Path, pattern: &str, place: &Place) -> Result<Vec<PathBuf>, Error> {
    if !is_pattern(pattern) {
        let path = root.join(pattern);
        fs::metadata(&path).map_err(|source| Error::Read { path: path.clone(), source })?;
        return Ok(vec![path]);
    }
    let mut found = vec![root.to_path_buf()];
    for segment in pattern.split(['/', '\\']).filter(|s| !s.is_empty() && *s != ".") {
        found = found.iter().flat_map(|folder| children(folder, segment)).collect();
    }
    found.retain(|path| path.is_file());
    found.sort_by(|a, b| natural(&a.to_string_lossy(), &b.to_string_lossy()));
    if found.is_empty() {
        let (place, pattern) = (place.clone(), pattern.to_string());
        return Err(Error::NoFiles { place, pattern, root: root.into() });
    }
    Ok(found)
}

fn children(folder: &Path, segment: &str) -> Vec<PathBuf> {
    if !is_pattern(segment) {
        let child = folder.join(segment);
        return if child.exists() { vec![child] } else { vec![] };
    }
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .filter(|e| matches(segment, &e.file_name().to_string_lossy()))
        .map(|e| e.path())
        .collect()
}

/// A number that no other process on this machine has; a program in a browser is alone.
pub fn process() -> u32 {
    if cfg!(target_family = "wasm") { 1 } else { std::process::id() }
}

/// The folder for temporary files.
pub fn temporary_folder() -> PathBuf {
    if cfg!(target_family = "wasm") { "/tmp".into() } else { std::env::temp_dir() }
}

/// Writes a file whole or not at all: a temporary file in the same folder, synced, then renamed.
///
/// # Errors
/// [`Error::Write`]; the temporary file is removed and an older file stays as it was.
pub fn write_atomically(path: &Path, content: &[u8]) -> Result<(), Error> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let temporary = path.with_file_name(format!(".{name}.{}.part", process()));
    write_and_rename(&temporary, path, content).map_err(|source| {
        fs::remove_file(&temporary).ok();
        Error::Write { path: path.into(), source }
    })
}

fn write_and_rename(temporary: &Path, path: &Path, content: &[u8]) -> std::io::Result<()> {
    let mut file = File::create(temporary)?;
    file.write_all(content)?;
    file.sync_all()?;
    fs::rename(temporary, path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_count_two_before_ten() {
        let mut names = ["img_10", "img_2", "img_1", "b", "img_02"];
        names.sort_by(|a, b| natural(a, b));
        assert_eq!(names, ["b", "img_1", "img_02", "img_2", "img_10"]);
    }

    #[test]
    fn a_star_covers_any_run_of_characters() {
        for (pattern, name, covered) in [
            ("T1_*", "T1_10", true),
            ("img*_cam1.png", "img3_cam1.png", true),
            ("img*_cam1.png", "img3_cam2.png", false),
            ("*a*b", "xaxxbab", true),
            ("?", "", false),
            ("*", "", true),
        ] {
            assert_eq!(matches(pattern, name), covered, "{pattern} {name}");
        }
    }

    #[test]
    fn the_last_number_of_a_name_is_its_number() {
        assert_eq!(last_number("cam1_img_007"), Some(7));
        assert_eq!(last_number("img12_cam"), Some(12));
        assert_eq!(last_number("none"), None);
    }

    #[test]
    fn a_failed_write_leaves_nothing_behind() {
        let folder = std::env::temp_dir().join(format!("handeye-atomic-{}", std::process::id()));
        fs::create_dir_all(folder.join("taken")).unwrap();
        assert!(write_atomically(&folder.join("taken"), b"x").is_err());
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        write_atomically(&folder.join("new"), b"x").unwrap();
        assert_eq!(fs::read(folder.join("new")).unwrap(), b"x");
        fs::remove_dir_all(folder).unwrap();
    }
}
