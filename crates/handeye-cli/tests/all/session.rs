//! Live sessions of a virtual cell, by HTTP and by a script: nothing confirmed is lost, and nobody else gets in.

use std::{
    fs,
    io::{BufRead, BufReader, Read, Write},
    net::TcpStream,
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use serde_json::{Value, json};

use crate::folder::{Folder, Run, handeye};

#[track_caller]
fn ends(run: Run, code: i32) -> Run {
    assert_eq!(run.code, code, "{}{}", run.stdout, run.stderr);
    run
}

/// Limits are for machines that are busy; nothing waits so long.
const PATIENCE: Duration = Duration::from_secs(120);

/// A session that serves.
struct Serving {
    process: Child,
    port: u16,
    token: String,
}

impl Serving {
    fn start(folder: &Path) -> Self {
        let mut process = Command::new(env!("CARGO_BIN_EXE_handeye"))
            .arg("session")
            .arg(folder)
            .args(["--virtual", "3", "--no-open", "--quiet"])
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let address = line.trim().strip_prefix("session: http://127.0.0.1:").expect(&line);
        let (port, token) = address.split_once("/?token=").unwrap();
        Self { port: port.parse().unwrap(), token: token.to_owned(), process }
    }

    /// Status, headers and body of a request's answer.
    fn raw(&self, request: &str) -> (u16, String, Vec<u8>) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut answer = vec![];
        stream.read_to_end(&mut answer).ok();
        let end = answer.windows(4).position(|w| w == b"\r\n\r\n").unwrap_or(answer.len());
        let head = String::from_utf8_lossy(&answer[..end]).into_owned();
        let status = head.split_whitespace().nth(1).and_then(|s| s.parse().ok()).unwrap_or(0);
        (status, head, answer.get(end + 4..).unwrap_or_default().to_vec())
    }

    fn get(&self, path: &str, headers: &str) -> (u16, String, Vec<u8>) {
        let host = format!("Host: 127.0.0.1:{}\r\n", self.port);
        let host = if headers.contains("Host:") { "" } else { &host };
        self.raw(&format!("GET {path} HTTP/1.1\r\n{host}Connection: close\r\n{headers}\r\n"))
    }

    fn signed(&self) -> String {
        format!("Authorization: Bearer {}\r\n", self.token)
    }

    fn state(&self) -> Value {
        let (status, _, body) = self.get("/api/state", &self.signed());
        assert_eq!(status, 200);
        serde_json::from_slice(&body).unwrap()
    }

    fn tell(&self, command: &Value) -> (u16, Value) {
        let (body, port) = (command.to_string(), self.port);
        let (status, _, answer) = self.raw(&format!(
            "POST /api/do HTTP/1.1\r\nHost: localhost:{port}\r\nConnection: close\r\n{}Content-Length: {}\r\n\r\n{body}",
            self.signed(),
            body.len()
        ));
        (status, serde_json::from_slice(&answer).unwrap_or_default())
    }

    /// Waits for a state.
    fn until(&self, what: &str, is_reached: impl Fn(&Value) -> bool) -> Value {
        let begin = Instant::now();
        loop {
            let state = self.state();
            if is_reached(&state) {
                return state;
            }
            assert!(begin.elapsed() < PATIENCE, "{what}: {state:#}");
            thread::sleep(Duration::from_millis(50));
        }
    }

    /// Confirms the steps up to the captures.
    fn begin(&self) {
        for step in ["cell", "camera", "robot", "board"] {
            self.until(step, |state| {
                state["steps"]
                    .as_array()
                    .unwrap()
                    .iter()
                    .any(|s| s["name"] == step && s["proven"] == true)
            });
            assert_eq!(self.tell(&json!({"do": "confirm", "step": step})).0, 200);
        }
    }
}

impl Drop for Serving {
    fn drop(&mut self) {
        self.process.kill().ok();
        self.process.wait().ok();
    }
}

fn names(state: &Value) -> Vec<String> {
    let captures = state["captures"].as_array().unwrap();
    captures.iter().map(|c| c["id"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn a_session_killed_at_twenty_moments_loses_nothing_that_was_confirmed() {
    let folder = Folder::new();
    let cell: PathBuf = folder.0.join("cell");
    let mut confirmed: Vec<String> = vec![];
    for moment in 0..20u64 {
        let serving = Serving::start(&cell);
        let state = serving.state();
        assert_eq!(names(&state), confirmed, "after kill {moment}");
        if state["step"] == "cell" {
            serving.begin();
        }
        // a capture is being taken, whose moment differs from kill to kill
        serving.until("the robot stands", |state| state["robot"]["stands"] == true);
        assert_eq!(serving.tell(&json!({"do": "take"})).0, 200);
        if moment % 2 == 0 {
            serving.until("a capture", |state| names(state).len() > confirmed.len());
            serving.tell(&json!({"do": "jog", "turn_deg": [4.0, -3.0, 5.0]}));
            thread::sleep(Duration::from_millis(37 * moment));
        } else {
            // as it is stored, or just before: it may be there or not, but whole
            thread::sleep(Duration::from_millis(1200 + 61 * moment));
        }
        let seen = names(&serving.state());
        drop(serving); // SIGKILL
        // the folder can be used as it is, by other programs
        let listed = fs::read_to_string(cell.join("robot.csv")).unwrap();
        seen.iter()
            .for_each(|id| assert!(listed.contains(&format!("\n{id},")), "{id} of {listed}"));
        let serving = Serving::start(&cell);
        let after = names(&serving.state());
        assert!(after.starts_with(&seen), "{seen:?} {after:?}");
        confirmed = after;
        drop(serving);
        for id in &confirmed {
            assert!(cell.join(format!("images/{id}.png")).is_file(), "{id}");
        }
    }
    assert!(confirmed.len() >= 10, "{confirmed:?}");
    let run = handeye(&folder, &["check", "cell", "--json"]);
    assert!(run.code != 1, "{}{}", run.stdout, run.stderr);
}

#[test]
fn nobody_else_gets_into_a_session() {
    let folder = Folder::new();
    let serving = Serving::start(&folder.0.join("cell"));
    let signed = serving.signed();
    for (path, headers, status) in [
        ("/api/state", String::new(), 401),
        ("/", String::new(), 401),
        ("/?token=0123456789abcdef0123456789abcdef", String::new(), 401),
        ("/api/state", "Authorization: Bearer 1234\r\n".into(), 401),
        ("/api/state", format!("{signed}Origin: http://evil.example\r\n"), 403),
        ("/api/state", format!("{signed}Origin: null\r\n"), 403),
        ("/api/state", format!("{signed}Host: evil.example:{}\r\n", serving.port), 403),
        ("/api/captures/..%2f..%2fhandeye.toml", signed.clone(), 404),
        ("/api/captures/../../handeye.toml", signed.clone(), 404),
        ("/api/captures/%2e%2e%2fhandeye.jpg", signed.clone(), 404),
        ("/api/captures/000.jpg", signed.clone(), 404),
        ("/..%2f..%2fetc%2fpasswd", signed.clone(), 404),
        ("/api/report", signed.clone(), 404),
        ("/api/export?format=kuka", signed.clone(), 409),
        ("/api/export?format=robo", signed.clone(), 400),
        ("/api/state?after=x", signed.clone(), 400),
        ("/api/state", signed.clone(), 200),
        ("/", signed.clone(), 200),
        ("/session.js", signed.clone(), 200),
        ("/session.css", signed.clone(), 200),
    ] {
        assert_eq!(serving.get(path, &headers).0, status, "{path} {headers}");
    }
    // the token is exchanged for a cookie, which opens the page
    let (status, head, _) = serving.get(&format!("/?token={}", serving.token), "");
    assert_eq!(status, 303);
    assert!(head.contains("HttpOnly; SameSite=Strict"), "{head}");
    let cookie = head.lines().find_map(|l| l.strip_prefix("set-cookie: ")).unwrap();
    let cookie = format!("Cookie: other=1; {}\r\n", cookie.split(';').next().unwrap());
    let (status, head, page) = serving.get("/", &cookie);
    assert_eq!(status, 200);
    assert!(head.contains("script-src 'self'") && !head.contains("unsafe-inline"), "{head}");
    assert!(String::from_utf8(page).unwrap().contains("session.js"));

    for (command, status) in [
        (json!({"do": "fly"}), 400),
        (json!([1, 2]), 400),
        (json!({"do": "take"}), 409),
        (json!({"do": "finish"}), 409),
        (json!({"do": "cell", "tolerance_mm": -1.0}), 400),
        (json!({"do": "cell", "tolerance_mm": 0.4}), 200),
    ] {
        let (found, answer) = serving.tell(&command);
        assert_eq!(found, status, "{command} {answer}");
    }
    // a body that is too large is not read to its end
    let (port, huge) = (serving.port, 1u64 << 30);
    let head = format!(
        "POST /api/do HTTP/1.1\r\nHost: localhost:{port}\r\nConnection: close\r\n{signed}Content-Length: {huge}\r\n\r\n"
    );
    assert_eq!(serving.raw(&head).0, 413);
}

#[test]
fn a_hundred_slow_connections_do_not_stop_a_session() {
    let folder = Folder::new();
    let serving = Serving::start(&folder.0.join("cell"));
    let slow: Vec<TcpStream> = (0..100)
        .map(|_| {
            let mut stream = TcpStream::connect(("127.0.0.1", serving.port)).unwrap();
            stream.write_all(b"GET /api/state HTTP/1.1\r\nHost: 127").unwrap();
            stream
        })
        .collect();
    serving.begin();
    serving.until("the captures", |state| state["step"] == "capture");
    drop(slow);
}

#[test]
fn a_script_plays_a_session_and_the_folder_gives_the_same_bytes() {
    let folder = Folder::new();
    let script = r#"[{"do": "confirm", "step": "cell"}, {"do": "confirm", "step": "camera"},
        {"do": "confirm", "step": "robot"}, {"do": "confirm", "step": "board"}, {"do": "take"},
        {"repeat": [{"do": "drive", "to": "next"}, {"do": "take"}], "until": "enough", "most": 30},
        {"do": "finish"}]"#;
    fs::write(folder.0.join("steps.json"), script).unwrap();
    let words = ["session", "cell", "--virtual", "3", "--headless", "--script", "steps.json"];
    let run = ends(handeye(&folder, &words), 0);
    assert!(run.stdout.contains("Accepted"), "{}", run.stdout);
    ends(handeye(&folder, &["calibrate", "cell", "--out", "again", "--quiet"]), 0);
    let bytes = |name: &str| fs::read(folder.0.join(name).join("calibration.json")).unwrap();
    assert_eq!(bytes("cell/result"), bytes("again"));

    // it is another cell, no script, or nothing is said of the camera
    for (words, said) in [
        (&["session", "cell", "--virtual", "4", "--no-open"][..], "session of another cell"),
        (&["session", "new"], "where do images come from?"),
        (&["session", "new", "--images-from", "nowhere"], "is not a folder"),
        (&["session", "new", "--ur", "ur5"], "where do images come from?"),
        (&["session", "new", "--ur", "ur5:0"], "the port is a number"),
        (&["session", "new", "--ur", "ur5", "--virtual"], "cannot be used with"),
        (
            &["session", "new", "--virtual", "--headless", "--script", "cell/robot.csv"],
            "is no script",
        ),
        (&["session", "new", "--virtual", "--tolerance-mm", "0"], "must be positive"),
    ] {
        let run = handeye(&folder, words);
        assert!(run.stderr.contains(said) && run.code != 0, "{words:?}: {}", run.stderr);
    }
}
