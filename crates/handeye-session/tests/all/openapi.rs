//! What the server answers is what `openapi.json` says.

use std::{
    collections::BTreeSet,
    fs,
    io::{Read, Write},
    net::{IpAddr, Ipv4Addr, TcpStream},
    path::PathBuf,
    sync::OnceLock,
    thread,
    time::Duration,
};

use handeye::Setup;
use handeye_io::SessionFolder;
use handeye_session::{
    engine::{Command, Step},
    host::Host,
    live::{Cell, Live},
    script::{Action, Player},
    server::Server,
    sources::virtual_cell::{Faults, VirtualCell},
};
use serde_json::{Map, Value, json};

use crate::new_folder;

/// A command of each kind.
const COMMANDS: &str = r#"[
    {"do": "confirm", "step": "cell"}, {"do": "go", "step": "touch"}, {"do": "go", "step": "verify"},
    {"do": "cell", "setup": "eye-in-hand", "tolerance_mm": 0.4}, {"do": "cell", "setup": null},
    {"do": "target", "target": {"kind": "checkerboard", "columns": 9, "rows": 6, "square_mm": 30.0}},
    {"do": "target", "target": {"kind": "charuco", "squares_x": 8, "squares_y": 6, "square_mm": 30.0,
                                "marker_mm": 22.0, "dictionary": "DICT_5X5_100"}},
    {"do": "camera", "intrinsics": null},
    {"do": "camera", "intrinsics": {"width": 640, "height": 480, "fx": 600, "fy": 600.5, "cx": 320, "cy": 240,
                                    "distortion": {"model": "kannala-brandt", "coefficients": [0, 0.1, 0, 0]}}},
    {"do": "notation", "name": "kuka"}, {"do": "notation", "name": "abb", "reread": true}, {"do": "take"},
    {"do": "automatic", "on": true}, {"do": "cancel"}, {"do": "grab"}, {"do": "pose", "text": "1 2 3 4 5 6"},
    {"do": "delete", "id": "001"}, {"do": "restore", "id": "001"}, {"do": "retake", "id": "001"}, {"do": "undo"},
    {"do": "skip"}, {"do": "skip", "why": "cannot reach"}, {"do": "tip", "in_flange_mm": [0, 0, 150.5]},
    {"do": "touch"}, {"do": "touch", "corner": 8}, {"do": "place"}, {"do": "untouch", "id": "t01"}, {"do": "finish"},
    {"do": "drive", "to": "next"}, {"do": "drive", "to": "placement"}, {"do": "jog", "move_mm": [0, 0, 5]}
]"#;

fn document() -> &'static Value {
    static DOCUMENT: OnceLock<Value> = OnceLock::new();
    let text = include_str!("../../openapi.json");
    DOCUMENT.get_or_init(|| serde_json::from_str(text).unwrap())
}

/// What a value has that its schema does not say.
fn faults(schema: &Value, value: &Value, at: &str) -> Vec<String> {
    if let Some(name) = schema["$ref"].as_str() {
        return faults(document().pointer(&name[1..]).unwrap(), value, at);
    }
    for one_of in ["oneOf", "anyOf"] {
        let Some(all) = schema[one_of].as_array() else { continue };
        let of_each: Vec<Vec<String>> = all.iter().map(|one| faults(one, value, at)).collect();
        let fitting = of_each.iter().filter(|faults| faults.is_empty()).count();
        if fitting != 1 {
            return vec![format!("{at}: fits to {fitting} of {one_of}: {of_each:?}")];
        }
    }
    let mut found = vec![];
    let types = &schema["type"];
    let is_of = |name: &Value| match name.as_str() {
        Some("object") => value.is_object(),
        Some("array") => value.is_array(),
        Some("string") => value.is_string(),
        Some("boolean") => value.is_boolean(),
        Some("null") => value.is_null(),
        Some("number") => value.is_number(),
        Some("integer") => value.is_u64() || value.is_i64(),
        other => panic!("{at}: the type {other:?}"),
    };
    let is_typed = match types {
        Value::Null => true,
        Value::Array(all) => all.iter().any(is_of),
        one => is_of(one),
    };
    let is_listed = |key: &str| schema[key].as_array().is_none_or(|all| all.contains(value));
    let is_const = schema.get("const").is_none_or(|only| only == value);
    if !(is_typed && is_const && is_listed("enum")) {
        found.push(format!("{at}: {value} is not of {schema}"));
    }
    if let Value::Object(object) = value {
        found.extend(of_object(schema, object, at));
    }
    for (k, item) in value.as_array().into_iter().flatten().enumerate() {
        let own = schema["prefixItems"].get(k).unwrap_or(&schema["items"]);
        found.extend(faults(own, item, &format!("{at}[{k}]")));
    }
    found
}

fn of_object(schema: &Value, object: &Map<String, Value>, at: &str) -> Vec<String> {
    let required = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let missing = required.filter(|key| !object.contains_key(*key));
    let mut found: Vec<String> = missing.map(|key| format!("{at}.{key} is missing")).collect();
    for (key, inner) in object {
        let at = format!("{at}.{key}");
        match (schema["properties"].get(key), &schema["additionalProperties"]) {
            (Some(own), _) => found.extend(faults(own, inner, &at)),
            (None, others @ Value::Object(_)) => found.extend(faults(others, inner, &at)),
            // nothing is said of what this document itself holds
            (None, _) if schema["properties"].is_null() => {}
            (None, _) => found.push(format!("{at} is not described")),
        }
    }
    found
}

#[test]
fn commands_that_are_read_are_described_and_the_others_are_not() {
    let commands: Vec<Value> = serde_json::from_str(COMMANDS).unwrap();
    let schema = json!({ "$ref": "#/components/schemas/Command" });
    for command in &commands {
        assert_eq!(faults(&schema, command, "command"), [""; 0]);
        let read: Command = serde_json::from_value(command.clone()).unwrap();
        let written = serde_json::to_value(&read).unwrap();
        assert_eq!(faults(&schema, &written, "command"), [""; 0], "{written}");
    }
    let shown: BTreeSet<&str> = commands.iter().filter_map(|c| c["do"].as_str()).collect();
    let mapping = &document()["components"]["schemas"]["Command"]["discriminator"]["mapping"];
    let described: BTreeSet<&str> = mapping.as_object().unwrap().keys().map(|k| &k[..]).collect();
    assert_eq!(shown, described);
    for wrong in [
        json!({"do": "fly"}),
        json!({"do": "confirm", "step": "cell", "now": true}),
        json!({"do": "confirm"}),
        json!({"do": "confirm", "step": "roof"}),
        json!({"do": "tip", "in_flange_mm": "high"}),
        json!({"take": true}),
    ] {
        assert!(!faults(&schema, &wrong, "command").is_empty(), "{wrong}");
        assert!(serde_json::from_value::<Command>(wrong.clone()).is_err(), "{wrong}");
    }
}

/// A session that is served, of a folder with a result.
struct Serving {
    address: String,
    token: String,
    live: Live,
    root: PathBuf,
}

/// An answer: its status, the kind of its content, and that.
struct Answer {
    status: u16,
    kind: String,
    headers: String,
    body: Vec<u8>,
}

impl Serving {
    fn new() -> Self {
        let root = new_folder();
        let cell = || VirtualCell::new(Setup::EyeInHand, 3, Faults::default()).unwrap();
        let open = || SessionFolder::open(&root, Some(&cell().settings())).unwrap();
        let mut player = Player::new(Host::new(open()), cell());
        let script = r#"[{"do": "confirm", "step": "cell"}, {"do": "confirm", "step": "camera"},
            {"do": "confirm", "step": "robot"}, {"do": "confirm", "step": "board"}, {"do": "take"},
            {"repeat": [{"do": "drive", "to": "next"}, {"do": "take"}], "until": "enough", "most": 30},
            {"do": "go", "step": "touch"}, {"do": "drive", "to": "touch"}, {"wait_s": 5}, {"do": "touch"},
            {"do": "delete", "id": "002"}, {"do": "restore", "id": "002"}, {"do": "delete", "id": "001"},
            {"do": "restore", "id": "001"}, {"do": "finish"}]"#;
        player.play(&serde_json::from_str::<Vec<Action>>(script).unwrap()).unwrap();
        drop(player);
        let live = Live::begin(Host::new(open()), Cell::Virtual(Box::new(cell())));
        let server = Server::bind(live.clone(), IpAddr::V4(Ipv4Addr::LOCALHOST), 0).unwrap();
        let address = server.address().unwrap();
        let (address, token) = address["http://".len()..].split_once("/?token=").unwrap();
        let (address, token) = (address.to_owned(), token.to_owned());
        thread::spawn(move || server.serve());
        Self { address, token, live, root }
    }

    fn ask(&self, method: &str, path: &str, token: &str, body: &str) -> Answer {
        let mut stream = TcpStream::connect(&self.address).unwrap();
        let request = format!(
            "{method} {path} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nAuthorization: Bearer {token}\r\nContent-Length: {}\r\n\r\n{body}",
            self.address,
            body.len()
        );
        stream.write_all(request.as_bytes()).unwrap();
        let mut answer = vec![];
        stream.read_to_end(&mut answer).unwrap();
        let end = answer.windows(4).position(|w| w == b"\r\n\r\n").unwrap();
        let headers = String::from_utf8(answer[..end].to_vec()).unwrap().to_lowercase();
        let kind = headers.lines().find_map(|line| line.strip_prefix("content-type: "));
        let kind = kind.unwrap_or_default().split(';').next().unwrap_or_default().to_owned();
        let status = headers.split(' ').nth(1).unwrap().parse().unwrap();
        Answer { status, kind, headers, body: answer[end + 4..].to_vec() }
    }

    /// Asks with the token, and compares the answer with what is said of it.
    fn check(&self, method: &str, path: &str, of: &str, body: &str) -> Answer {
        let answer = self.ask(method, path, &self.token, body);
        let operation = &document()["paths"][of][method.to_lowercase()];
        described(operation, &answer, &format!("{method} {path}"));
        answer
    }
}

impl Drop for Serving {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.root).ok();
    }
}

fn described(operation: &Value, answer: &Answer, at: &str) {
    let at = format!("{at}, {}", answer.status);
    let said = operation["responses"].get(answer.status.to_string()).expect(&at);
    for header in said["headers"].as_object().into_iter().flat_map(Map::keys) {
        assert!(answer.headers.contains(&format!("\n{header}: ")), "{at}: {}", answer.headers);
    }
    match said["content"].as_object() {
        None => assert!(answer.body.is_empty(), "{at}"),
        Some(kinds) => {
            let kind = kinds.get(&answer.kind).expect(&at);
            if answer.kind == "application/json" {
                let value: Value = serde_json::from_slice(&answer.body).unwrap();
                let found = faults(&kind["schema"], &value, &at);
                assert!(found.is_empty(), "{found:#?}");
            }
        }
    }
}

/// Waits until the captures are assessed, an image has come, and there is a next view: one that verifies the captures.
fn settled(live: &Live) {
    let state = || -> Value { serde_json::from_str(&live.shown().borrow().json).unwrap() };
    while live.command_blocking(Command::Go { step: Step::Verify }).is_err() {
        thread::sleep(Duration::from_millis(50));
    }
    let is_ready = || {
        let state = state();
        let all = ["progress", "next"].iter().all(|part| state[part].is_object());
        all && state["camera"]["found"].is_string()
    };
    while !is_ready() {
        thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn answers_are_as_they_are_described() {
    let serving = Serving::new();
    let state = "/api/state";
    serving.check("GET", state, state, "");
    settled(&serving.live);
    let get = |path: &str, of: &str| serving.check("GET", path, of, "");
    let full: Value = serde_json::from_slice(&get(state, state).body).unwrap();
    let parts = ["next", "progress", "touch", "virtual_cell"];
    assert!(parts.iter().all(|part| full[part].is_object()), "{full:#}");
    assert!(full["captures"].as_array().unwrap().len() > 3);

    let all = document()["paths"].as_object().unwrap();
    for (of, operations) in all {
        let path = of.replace("{name}", "001.json");
        for method in ["GET", "POST"] {
            let is_described = operations.get(method.to_lowercase()).is_some();
            if is_described {
                serving.check(method, &path, of, "{}");
                let answer = serving.ask(method, &path, "0", "{}");
                assert_eq!(answer.status, 401, "{path}");
                described(&operations[method.to_lowercase()], &answer, &path);
            } else {
                let answer = serving.ask(method, &path, &serving.token, "{}");
                assert_eq!(answer.status, 405, "{method} {path}");
            }
        }
    }
    let (captures, export) = ("/api/captures/{name}", "/api/export");
    for (path, of, status) in [
        ("/api/captures/001.jpg", captures, 200),
        ("/api/captures/001.json", captures, 200),
        ("/api/captures/777.json", captures, 404),
        ("/api/live.jpg", "/api/live.jpg", 200),
        ("/api/live.jpg?after=x", "/api/live.jpg", 400),
        ("/api/live.jpg?after=999999", "/api/live.jpg", 204),
        ("/api/state?after=x", state, 400),
        ("/api/report", "/api/report", 200),
        ("/api/export?format=ros2-launch", export, 200),
        ("/api/export?format=nothing", export, 400),
        ("/api/export", export, 400),
    ] {
        assert_eq!(get(path, of).status, status, "{path}");
    }
    let signed = serving.ask("GET", &format!("/?token={}", serving.token), "", "");
    described(&all["/"]["get"], &signed, "/?token=");
    assert_eq!(signed.status, 303);
    for (command, status) in [
        (r#"{"do": "go", "step": "capture"}"#, 200),
        (r#"{"do": "delete", "id": "099"}"#, 400),
        (r#"{"do": "confirm", "step": "cell"}"#, 409),
        ("no command", 400),
        (r#"{"do": "undo", "twice": true}"#, 400),
    ] {
        let answer = serving.check("POST", "/api/do", "/api/do", command);
        assert_eq!(answer.status, status, "{command}");
    }
}
