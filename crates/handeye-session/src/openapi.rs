//! The published description of what the server answers, `openapi.json` (OpenAPI 3.1): what commands and answers hold is
//! derived from the types that read and write them.
//!
//! `HANDEYE_WRITE=1 cargo test -p handeye-session openapi` writes it anew.

use std::{collections::BTreeSet, fs};

use schemars::{JsonSchema, generate::SchemaSettings};
use serde_json::{Map, Value, json};

use crate::{
    engine::{
        Command,
        shown::{CaptureDetail, State},
    },
    server::routes,
};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/openapi.json");
const ABOUT: &str = "What `handeye session` answers. Its address, with port and token, is printed when it begins. Lengths are \
                     metres and angles radians, but where a name ends in a unit; poses are `a_from_b`: they take points of `b` \
                     to `a`.";
/// The end of a reference to a schema.
const SCHEMAS: &str = "#/components/schemas/";

fn reference(name: &str) -> Value {
    json!({ "$ref": format!("{SCHEMAS}{name}") })
}

fn content(kind: &str, schema: Value) -> Value {
    json!({ kind: { "schema": schema } })
}

/// An answer of this kind.
fn answer(what: &str, kind: &str, schema: Value) -> Value {
    json!({ "description": what, "content": content(kind, schema) })
}

fn file(what: &str, kind: &str) -> Value {
    answer(what, kind, json!({ "type": "string", "format": "binary" }))
}

fn error(what: &str) -> Value {
    answer(what, "application/json", reference("Error"))
}

/// The query does not hold what it should.
fn no_query() -> Value {
    answer(
        "A parameter is missing, or is not of its type.",
        "text/plain",
        json!({"type": "string"}),
    )
}

fn query(name: &str, what: &str, required: bool, schema: Value) -> Value {
    json!({ "name": name, "in": "query", "required": required, "description": what, "schema": schema })
}

fn after(what: &str) -> Value {
    query("after", what, false, json!({ "type": "integer", "minimum": 0 }))
}

/// An operation with the answers that every request may get.
fn operation(id: &str, what: &str, parameters: Vec<Value>, mut answers: Value) -> Value {
    for (status, refusal) in [
        ("401", "No token, or that of another session."),
        ("403", "The request comes from another page, or was sent to another host."),
        ("408", "The request did not come to its end within a minute."),
        ("413", "The request is larger than 1 MiB."),
    ] {
        answers[status] = error(refusal);
    }
    let mut operation = json!({ "operationId": id, "summary": what, "responses": answers });
    if !parameters.is_empty() {
        operation["parameters"] = parameters.into();
    }
    operation
}

fn page(id: &str, what: &str, kind: &str) -> Value {
    operation(id, what, vec![], json!({ "200": file(what, kind) }))
}

fn start() -> Value {
    let token = query(
        "token",
        "The token: the answer puts it into a cookie, which the page is asked for from then on.",
        false,
        json!({ "type": "string" }),
    );
    let answers = json!({
        "200": file("The page.", "text/html"),
        "303": {
            "description": "The token was right, and is in the cookie.",
            "headers": {
                "location": { "schema": { "const": "/" } },
                "set-cookie": { "schema": { "type": "string" } }
            }
        }
    });
    let mut start = operation("page", "The page for people.", vec![token], answers);
    start["security"] = json!([{ "token": [] }, {}]);
    start
}

fn state() -> Value {
    operation(
        "state",
        "The whole state of the session.",
        vec![after(
            "Answers as soon as the version is larger than this, after 20 s at the latest.",
        )],
        json!({
            "200": answer("The state.", "application/json", reference("State")),
            "400": no_query()
        }),
    )
}

fn command() -> Value {
    let done = json!({
        "type": "object",
        "properties": { "version": {
            "type": "integer", "minimum": 0,
            "description": "The version of the state in which the command was accepted; what it leads to comes with later ones."
        } },
        "required": ["version"],
        "additionalProperties": false
    });
    let mut operation = operation(
        "command",
        "Asks for something to be done.",
        vec![],
        json!({
            "200": answer("It is being done.", "application/json", done),
            "400": error("No command, or one that is wrong."),
            "409": error("Not now; the message says what comes first.")
        }),
    );
    operation["requestBody"] =
        json!({ "required": true, "content": content("application/json", reference("Command")) });
    operation
}

fn upload() -> Value {
    let mut operation = operation(
        "upload",
        "Hands over an image, in a session whose images are uploaded.",
        vec![],
        json!({
            "200": answer("It has come.", "application/json", json!({ "type": "object" })),
            "400": error("It is no image, or one that has come before."),
            "409": error("Images come by themselves, or another one is being uploaded.")
        }),
    );
    operation["responses"]["413"] = error("The image's file is larger than 128 MiB.");
    operation["requestBody"] = json!({
        "required": true,
        "description": "The image's file: PNG, JPEG, TIFF or BMP.",
        "content": { "application/octet-stream": { "schema": { "type": "string", "format": "binary" } } }
    });
    operation
}

fn live_image() -> Value {
    let mut image = file("The image, at most 1280 px wide.", "image/jpeg");
    image["headers"] = json!({ "x-frame": {
        "description": "Its number.", "schema": { "type": "integer", "minimum": 0 }
    } });
    operation(
        "live_image",
        "The newest image of the camera.",
        vec![after(
            "Answers as soon as the image's number is larger than this, after 5 s at the latest.",
        )],
        json!({
            "200": image,
            "204": { "description": "No such image has come." },
            "400": no_query()
        }),
    )
}

fn capture() -> Value {
    let name = json!({
        "name": "name", "in": "path", "required": true,
        "description": "The capture's name, with `.jpg` for its image and `.json` for what was measured in it.",
        "schema": { "type": "string", "pattern": r"^[vp]?[0-9]{1,4}\.(jpg|json)$" }
    });
    let mut found =
        answer("The image, or its corners.", "application/json", reference("CaptureDetail"));
    found["content"]["image/jpeg"] = json!({ "schema": { "type": "string", "format": "binary" } });
    operation(
        "capture",
        "The image of a capture, or its corners and their residuals.",
        vec![name],
        json!({ "200": found, "404": error("There is no such capture.") }),
    )
}

fn report() -> Value {
    operation(
        "report",
        "The report of the result.",
        vec![],
        json!({ "200": file("The report.", "text/html"), "404": error("No result is written yet.") }),
    )
}

fn formats() -> Value {
    let format = json!({
        "type": "object",
        "properties": { "name": { "type": "string" } },
        "required": ["name"],
        "additionalProperties": false
    });
    let all = json!({ "type": "array", "items": format });
    let answers = json!({ "200": answer("Their names.", "application/json", all) });
    operation("formats", "The formats in which a result can be exported.", vec![], answers)
}

fn export() -> Value {
    let mut exported = file("The file.", "application/octet-stream");
    exported["headers"] = json!({ "content-disposition": {
        "description": "Its usual name.", "schema": { "type": "string" }
    } });
    let refused = json!({
        "description": "No such format, or none is named.",
        "content": {
            "application/json": { "schema": reference("Error") },
            "text/plain": { "schema": { "type": "string" } }
        }
    });
    operation(
        "export",
        "The result in the notation of a robot or program.",
        vec![query("format", "A name out of `/api/formats`.", true, json!({ "type": "string" }))],
        json!({
            "200": exported,
            "400": refused,
            "409": error("There is no result, or none that is accepted.")
        }),
    )
}

fn paths() -> Value {
    let itself = answer("This document.", "application/json", json!({ "type": "object" }));
    let description =
        operation("description", "What the server answers.", vec![], json!({ "200": itself }));
    json!({
        "/": { "get": start() },
        "/session.js": { "get": page("script", "The script of the page.", "text/javascript") },
        "/session.css": { "get": page("style", "The style of the page.", "text/css") },
        "/api/openapi.json": { "get": description },
        "/api/state": { "get": state() },
        "/api/do": { "post": command() },
        "/api/image": { "post": upload() },
        "/api/live.jpg": { "get": live_image() },
        "/api/captures/{name}": { "get": capture() },
        "/api/report": { "get": report() },
        "/api/formats": { "get": formats() },
        "/api/export": { "get": export() }
    })
}

/// Schemas of what is written, by their names.
fn written() -> Map<String, Value> {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let settings = settings.with(|s| s.definitions_path = "/components/schemas".into());
    let mut generator = settings.into_generator();
    generator.subschema_for::<State>();
    generator.subschema_for::<CaptureDetail>();
    generator.take_definitions(true)
}

/// The schema of what is read, with all of it in one place.
fn read<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft2020_12().with(|s| {
        s.inline_subschemas = true;
        s.meta_schema = None;
    });
    settings.into_generator().into_root_schema_for::<T>().to_value()
}

/// Names and schemas of all commands.
fn commands() -> Vec<(String, Value)> {
    let all = read::<Command>()["oneOf"].take();
    let named = |command: &Value| {
        let name = command["properties"]["do"]["const"].as_str().unwrap_or_default();
        (name.to_owned(), command.clone())
    };
    all.as_array().into_iter().flatten().map(named).collect()
}

/// A schema without what is said of it.
fn bare(schema: &Value) -> Value {
    let mut bare = schema.clone();
    if let Value::Object(object) = &mut bare {
        object.remove("description");
    }
    bare
}

/// Refers to schemas that have a name already.
fn shared(schema: &mut Value, known: &Map<String, Value>) {
    let own = bare(schema);
    if let Some((name, _)) = known.iter().find(|(_, other)| bare(other) == own) {
        let what = schema["description"].take();
        *schema = reference(name);
        if what.is_string() {
            schema["description"] = what;
        }
        return;
    }
    match schema {
        Value::Object(object) => object.values_mut().for_each(|inner| shared(inner, known)),
        Value::Array(all) => all.iter_mut().for_each(|inner| shared(inner, known)),
        _ => {}
    }
}

/// What a command is called among the schemas.
fn component(command: &str) -> String {
    format!("do.{command}")
}

fn schemas() -> Map<String, Value> {
    let written = written();
    let mut schemas = written.clone();
    let (mut one_of, mut mapping) = (vec![], Map::new());
    for (name, mut schema) in commands() {
        let component = component(&name);
        shared(&mut schema, &written);
        one_of.push(reference(&component));
        mapping.insert(name, format!("{SCHEMAS}{component}").into());
        schemas.insert(component, schema);
    }
    let command = json!({
        "description": "Something to be done.",
        "oneOf": one_of,
        "discriminator": { "propertyName": "do", "mapping": mapping }
    });
    schemas.insert("Command".into(), command);
    let text = |what: &str| json!({ "type": "string", "description": what });
    let error = json!({
        "type": "object",
        "properties": { "error": {
            "type": "object",
            "properties": { "message": text("What is wrong."), "advice": text("What to do; may be empty.") },
            "required": ["message", "advice"],
            "additionalProperties": false
        } },
        "required": ["error"],
        "additionalProperties": false
    });
    schemas.insert("Error".into(), error);
    schemas
}

/// One line instead of the lines of a comment; and no formats that nobody else knows.
fn unwrapped(schema: &mut Value) {
    match schema {
        Value::Object(object) => {
            if object
                .get("format")
                .is_some_and(|f| f.as_str().is_some_and(|f| f.starts_with("uint")))
            {
                object.remove("format");
            }
            if let Some(Value::String(text)) = object.get_mut("description") {
                *text = text.replace('\n', " ");
            }
            object.values_mut().for_each(unwrapped);
        }
        Value::Array(all) => all.iter_mut().for_each(unwrapped),
        _ => {}
    }
}

/// The text of the document.
fn generated() -> String {
    let mut document = json!({
        "openapi": "3.1.0",
        "info": {
            "title": "handeye session",
            "version": env!("CARGO_PKG_VERSION"),
            "description": ABOUT,
            "license": { "name": "MIT OR Apache-2.0", "identifier": "MIT OR Apache-2.0" }
        },
        "servers": [{
            "url": "http://127.0.0.1:{port}",
            "description": "The session on this machine.",
            "variables": { "port": { "default": "8080", "description": "As `--port` says, or any that is free." } }
        }],
        "security": [{ "token": [] }],
        "paths": paths(),
        "components": {
            "securitySchemes": { "token": {
                "type": "http", "scheme": "bearer",
                "description": "The token in the address that the session prints."
            } },
            "schemas": schemas()
        }
    });
    unwrapped(&mut document);
    format!("{document:#}\n")
}

#[test]
fn the_published_document_is_that_of_the_types() {
    let document = generated();
    if std::env::var_os("HANDEYE_WRITE").is_some() {
        fs::write(FILE, &document).unwrap();
    }
    let published = fs::read_to_string(FILE).unwrap();
    assert!(published == document, "run it with HANDEYE_WRITE=1 to write {FILE} anew");
}

#[test]
fn it_describes_what_is_answered_and_nothing_else() {
    let paths = paths();
    let described: BTreeSet<&str> = paths.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(described, routes::paths().into_iter().collect());
}

#[test]
fn its_commands_are_those_that_are_read() {
    for (described, schema) in commands() {
        // a name that is not read is answered by a list of those that are
        let bare = serde_json::from_value::<Command>(json!({ "do": described }));
        let why = bare.err().map_or_else(String::new, |e| e.to_string());
        assert!(!why.contains("unknown variant"), "{described}: {why}");
        assert_eq!(schema["additionalProperties"], false, "{described}");
    }
    let why = serde_json::from_value::<Command>(json!({ "do": "?" })).unwrap_err().to_string();
    let read: BTreeSet<String> = why.split('`').skip(3).step_by(2).map(Into::into).collect();
    let described: BTreeSet<String> = commands().into_iter().map(|(name, _)| name).collect();
    assert_eq!(described, read, "{why}");
}
