//! A target in a file of its own, or in a manifest.

use std::path::Path;

use handeye::TargetModel;
use serde::Deserialize;

use crate::{
    error::{Error, Place, malformed},
    files,
};

#[derive(Deserialize)]
struct WithTarget {
    target: TargetModel,
}

/// The target of a manifest, or of a file with the same keys under `[target]` or at its top.
///
/// # Errors
/// What cannot be read, is no target, or has dimensions that no board has.
pub fn read_target(path: &Path) -> Result<TargetModel, Error> {
    let text = files::text(path)?;
    let refuse = |e: toml::de::Error| {
        let line = e.span().map(|s| 1 + text[..s.start.min(text.len())].matches('\n').count());
        let what = e.message().trim().replace('\n', " ");
        malformed(Place { line, ..Place::file(path) }, what, ADVICE)
    };
    let table: toml::Table = toml::from_str(&text).map_err(refuse)?;
    let target = if table.contains_key("target") {
        toml::from_str::<WithTarget>(&text).map_err(refuse)?.target
    } else if table.contains_key("kind") {
        toml::from_str(&text).map_err(refuse)?
    } else {
        return Err(malformed(Place::file(path), "describes no target", ADVICE));
    };
    target.check().map_err(|source| Error::Values { place: Place::file(path), source })?;
    Ok(target)
}

const ADVICE: &str = "write kind = \"checkerboard\" (or charuco, aprilgrid, tag-grid, tag, circle-grid, asymmetric-circle-grid, modified-circle-grid, sphere) and its dimensions under [target]";

/// The lines of a manifest that describe a target.
pub fn target_toml(target: &TargetModel) -> String {
    // a flat table of numbers and short names: this cannot fail
    format!("[target]\n{}", toml::to_string(target).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn read(name: &str, text: &str) -> Result<TargetModel, String> {
        let folder = std::env::temp_dir().join(format!("handeye-target-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join(name);
        fs::write(&path, text).unwrap();
        let target = read_target(&path);
        fs::remove_file(&path).unwrap();
        target.map_err(|e| e.to_string().replace(&format!("{}/", folder.display()), ""))
    }

    #[test]
    fn what_is_written_is_read() {
        let board = TargetModel::Charuco {
            squares_x: 5,
            squares_y: 7,
            square_mm: 30.5,
            marker_mm: 22.0,
            dictionary: "DICT_6X6_250".into(),
            legacy: false,
        };
        assert_eq!(read("written.toml", &target_toml(&board)), Ok(board));
    }

    #[test]
    fn the_keys_stand_at_the_top_or_in_a_manifest() {
        let board = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 20.0 };
        let keys = "kind = \"checkerboard\"\ncolumns = 9\nrows = 6\nsquare_mm = 20.0\n";
        assert_eq!(read("top.toml", keys), Ok(board.clone()));
        let manifest = format!("setup = \"eye-in-hand\"\n[target]\n{keys}[robot]\nposes = \"p\"\n");
        assert_eq!(read("manifest.toml", &manifest), Ok(board));
    }

    #[test]
    fn what_is_no_target_is_refused() {
        for (name, text, expected) in [
            ("none.toml", "setup = 1\n", "none.toml: describes no target; write kind ="),
            ("cut.toml", "kind = \n", "cut.toml:1: "),
            (
                "row.toml",
                "kind = \"checkerboard\"\ncolumns = 9\nrows = 1\nsquare_mm = 20.0",
                "row.toml: target: 9 x 1 inner corners; a board needs at least 2 x 2",
            ),
            ("kind.toml", "[target]\nkind = \"chess\"\n", "kind.toml:2: unknown variant `chess`"),
        ] {
            let message = read(name, text).unwrap_err();
            assert!(message.starts_with(expected), "{message}");
        }
    }
}
