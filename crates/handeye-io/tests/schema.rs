//! The published JSON Schema names the keys that the manifest knows.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

use std::{collections::BTreeSet, fs};

use handeye_io::Dataset;
use serde_json::Value;

fn keys_of_schema(table: &str) -> BTreeSet<String> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/schema/handeye.schema.json");
    let schema: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let properties = match table {
        "" => &schema["properties"],
        table => &schema["properties"][table]["properties"],
    };
    properties.as_object().unwrap().keys().cloned().collect()
}

/// The keys that the message about an unknown one lists.
fn keys_of_manifest(table: &str) -> BTreeSet<String> {
    let path =
        std::env::temp_dir().join(format!("handeye-schema-{}-{table}.toml", std::process::id()));
    let header = if table.is_empty() { String::new() } else { format!("[{table}]\n") };
    fs::write(&path, format!("{header}unknown_key = 1\n")).unwrap();
    let message = Dataset::open(&path).unwrap_err().to_string();
    fs::remove_file(path).unwrap();
    message.split('`').skip(3).step_by(2).map(String::from).collect()
}

#[test]
fn the_schema_and_the_manifest_have_the_same_keys() {
    for table in [
        "",
        "scene",
        "object",
        "camera",
        "robot",
        "images",
        "scans",
        "board_poses",
        "corners",
        "point_pairs",
        "captures",
        "motion",
        "touches",
        "workspace",
        "noise",
    ] {
        assert_eq!(keys_of_schema(table), keys_of_manifest(table), "[{table}]");
    }
}
