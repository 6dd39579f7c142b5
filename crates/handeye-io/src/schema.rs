//! The published schema of `handeye.toml`, derived from the types that read and write it.
//!
//! `HANDEYE_WRITE=1 cargo test -p handeye-io schema` writes it anew.

use std::{borrow::Cow, fs};

use schemars::{JsonSchema, Schema, SchemaGenerator, generate::SchemaSettings, json_schema};
use serde_json::{Map, Value, json};

use handeye::TargetModel;

use crate::{
    dataset::{Manifest, shapes::TargetSpec},
    target_file::SizeKeys,
};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/schema/handeye.schema.json");
const ABOUT: &str = "Manifest of a folder of captures for hand-eye calibration. Names of files are relative to the \
                     folder; * and ? are patterns, in natural order.";

/// Numbers that are positive, by their keys.
const POSITIVE: [&str; 23] = [
    "square_mm",
    "marker_mm",
    "size_mm",
    "pitch_mm",
    "tag_mm",
    "gap_mm",
    "spacing",
    "diameter_mm",
    "square_sigma_mm",
    "fx",
    "fy",
    "resized",
    "focal_sigma_px",
    "center_sigma_px",
    "depth_scale",
    "sigma_mm",
    "image_px",
    "robot_position_mm",
    "robot_rotation_deg",
    "depth_mm",
    "max_error_mm",
    "touch_mm",
    "tip_mm",
];
/// Counts that are one at least.
const COUNTS: [&str; 10] = [
    "columns",
    "rows",
    "squares_x",
    "squares_y",
    "tags_x",
    "tags_y",
    "width",
    "height",
    "border_bits",
    "bit_depth",
];
/// Of AprilTags.
const FAMILIES: [&str; 4] = ["16h5", "25h9", "36h10", "36h11"];
/// Other names of keys: of a key, those that are read too.
const ALIASES: [(&str, &[&str]); 3] = [
    ("convention", &["dh_convention"]),
    ("theta_offset", &["theta", "offset"]),
    ("joint_id", &["name"]),
];

impl JsonSchema for TargetSpec {
    fn schema_name() -> Cow<'static, str> {
        "Target".into()
    }

    /// A word, a board, or a list of boards with a name each.
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut model = TargetModel::json_schema(generator).to_value();
        let size = SizeKeys::json_schema(generator).to_value();
        let mut kinds = vec![json!({"enum": ["scene", "object"]})];
        for mut kind in model["oneOf"].take().as_array().cloned().unwrap_or_default() {
            for (key, schema) in size["properties"].as_object().into_iter().flatten() {
                kind["properties"][key] = schema.clone();
            }
            kinds.push(kind);
        }
        kinds.push(json!({
            "type": "array",
            "minItems": 1,
            "items": {
                "type": "object",
                "properties": {"name": {"type": "string"}, "kind": {"type": "string"}},
                "required": ["name", "kind"]
            }
        }));
        json_schema!({ "oneOf": kinds })
    }
}

/// What schemars does not know: TOML has no null, and some numbers have bounds of their own.
fn corrected(schema: &mut Value) {
    let Value::Object(object) = schema else {
        schema.as_array_mut().into_iter().flatten().for_each(corrected);
        return;
    };
    without_null(object);
    if let Some(Value::String(text)) = object.get_mut("description") {
        *text = text.replace('\n', " ");
    }
    if let Some(Value::Object(properties)) = object.get_mut("properties") {
        for (key, names) in ALIASES {
            let Some(schema) = properties.get(key).cloned() else { continue };
            properties.extend(names.iter().map(|name| (String::from(*name), schema.clone())));
        }
        properties.iter_mut().for_each(|(key, schema)| bounded(key, schema));
    }
    if let Some(Value::Array(required)) = object.get_mut("required") {
        // a convention may be called by its other name
        required.retain(|key| key != "convention");
    }
    object.values_mut().for_each(corrected);
}

fn without_null(object: &mut Map<String, Value>) {
    for key in ["format", "default"] {
        if object.get(key).is_some_and(|v| v.is_string() || v.is_null()) {
            object.remove(key);
        }
    }
    if let Some(Value::Array(types)) = object.get_mut("type") {
        types.retain(|t| t != "null");
        if let [only] = &types[..] {
            let only = only.clone();
            object.insert("type".into(), only);
        }
    }
    let Some(Value::Array(any)) = object.get_mut("anyOf") else { return };
    any.retain(|schema| *schema != json!({"type": "null"}));
    if let [Value::Object(only)] = &any[..] {
        let only = only.clone();
        object.remove("anyOf");
        object.extend(only);
    }
}

fn bounded(key: &str, schema: &mut Value) {
    let types = schema["type"].clone();
    let is = |wanted: &str| {
        types == wanted || types.as_array().is_some_and(|all| all.iter().any(|t| t == wanted))
    };
    if POSITIVE.contains(&key) && is("number") {
        schema["exclusiveMinimum"] = 0.into();
    }
    if COUNTS.contains(&key) && is("integer") {
        schema["minimum"] = 1.into();
    }
    match key {
        "bit_depth" => schema["maximum"] = 16.into(),
        "border_bits" => schema["maximum"] = 2.into(),
        "organised" => {
            let sides = schema["prefixItems"].as_array_mut().into_iter().flatten();
            sides.for_each(|side| side["minimum"] = 1.into());
        }
        _ => {}
    }
}

/// The text of the schema.
fn generated() -> String {
    let generator = SchemaSettings::draft2020_12().into_generator();
    let mut schema = generator.into_root_schema_for::<Manifest>().to_value();
    schema["title"] = "handeye.toml".into();
    schema["description"] = ABOUT.into();
    corrected(&mut schema);
    let prefixed = ["tag", "t"].map(|p| FAMILIES.map(|family| format!("{p}{family}"))).concat();
    if let Some(families) = schema["$defs"]["AprilTagFamily"]["oneOf"].as_array_mut() {
        families.push(json!({"enum": prefixed, "description": "The same, by their longer names."}));
    }
    format!("{schema:#}\n")
}

#[test]
fn the_published_schema_is_that_of_the_types() {
    let schema = generated();
    if std::env::var_os("HANDEYE_WRITE").is_some() {
        fs::write(FILE, &schema).unwrap();
    }
    let published = fs::read_to_string(FILE).unwrap();
    assert!(published == schema, "run it with HANDEYE_WRITE=1 to write {FILE} anew");
}
