//! What is fed with broken input, and what these targets share.

pub mod targets;

use std::{env, fs, path::PathBuf, process};

/// The folder that `run.sh` made, else a temporary one of this process alone.
pub fn folder() -> PathBuf {
    let own = || env::temp_dir().join(format!("handeye-fuzz-{}", process::id()));
    let folder = env::var_os("HANDEYE_FUZZ_FOLDER").map_or_else(own, PathBuf::from);
    fs::create_dir_all(&folder).expect("a temporary folder can be made");
    folder
}

/// A file of these bytes; the first byte chooses one of the extensions.
pub fn file(data: &[u8], extensions: &[&str]) -> Option<PathBuf> {
    let (first, rest) = data.split_first()?;
    let extension = extensions[usize::from(*first) % extensions.len()];
    let path = folder().join(format!("input.{extension}"));
    fs::write(&path, rest).expect("a temporary file can be written");
    Some(path)
}

/// An error must be told in words that are not empty.
pub fn told<T>(result: Result<T, handeye_io::Error>) -> Option<T> {
    result.map_err(|error| assert!(!error.to_string().trim().is_empty())).ok()
}

/// A small one of every kind of target.
pub fn boards() -> Vec<handeye::TargetModel> {
    [
        r#"{"kind":"checkerboard","columns":4,"rows":3,"square_mm":10.0}"#,
        r#"{"kind":"charuco","squares_x":5,"squares_y":4,"square_mm":10.0,"marker_mm":7.0,"dictionary":"DICT_4X4_50"}"#,
        r#"{"kind":"tag","dictionary":"DICT_4X4_50","id":1,"size_mm":30.0}"#,
        r#"{"kind":"aprilgrid","tags_x":2,"tags_y":2,"tag_mm":20.0,"spacing":0.3,"family":"36h11"}"#,
        r#"{"kind":"tag-grid","tags_x":2,"tags_y":2,"tag_mm":20.0,"gap_mm":5.0,"dictionary":"DICT_4X4_50"}"#,
        r#"{"kind":"circle-grid","columns":4,"rows":3,"pitch_mm":10.0}"#,
        r#"{"kind":"asymmetric-circle-grid","columns":3,"rows":5,"pitch_mm":10.0}"#,
        r#"{"kind":"modified-circle-grid","columns":5,"rows":5,"pitch_mm":10.0}"#,
    ]
    .map(|text| serde_json::from_str(text).expect("a target"))
    .to_vec()
}
