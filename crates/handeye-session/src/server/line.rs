//! A robot's own program as the one who asks: lines of text over TCP, which every controller that has sockets can send.
//!
//! ```text
//! robot ─▶ hello                          ◀─ ok handeye kuka
//! robot ─▶ pose 612.3 -4.1 233 10 20 -170 ◀─ ok 003 0.620 next 598.1 ...     the capture, the error (95 %, mm), the next pose
//!                                         ◀─ enough 012 0.410                no further pose is needed
//!                                         ◀─ error the board is not found    no capture was taken: the pose may be sent again
//! robot ─▶ next                           ◀─ next 598.1 ... | none | enough
//! ```
//!
//! The robot stands while it waits for the answer, so its pose is that of the image. Numbers are those of the session's
//! notation. One robot at a time; it can take captures, and nothing else.

use std::{
    io::{self, BufRead, BufReader, Write},
    net::{TcpListener, TcpStream},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    thread,
    time::{Duration, Instant},
};

use serde_json::Value;

use crate::{engine::Command, live::Live};

/// No line is longer, bytes.
const LONGEST: u64 = 1024;
/// A capture that takes longer has failed.
const PATIENCE: Duration = Duration::from_secs(120);
/// The problem that does not keep a capture from being taken.
const LATE: &str = "image-late";
/// How often the state is looked at.
const POLL: Duration = Duration::from_millis(30);

/// Serves robots from now on.
///
/// # Errors
/// A socket that cannot be used.
pub fn listen(live: Live, listener: TcpListener) -> io::Result<()> {
    listener.set_nonblocking(false)?;
    let taken = Arc::new(AtomicBool::new(false));
    thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            let (live, taken) = (live.clone(), taken.clone());
            thread::spawn(move || {
                if taken.swap(true, Ordering::AcqRel) {
                    answer(&stream, "error another robot is connected").ok();
                    return;
                }
                // a robot that hangs up is gone, and may come back
                talk(&live, &stream).ok();
                taken.store(false, Ordering::Release);
            });
        }
    });
    Ok(())
}

fn answer(mut stream: &TcpStream, line: &str) -> io::Result<()> {
    // an answer is one line, whatever it quotes
    let line: String = line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    stream.write_all((line + "\n").as_bytes())
}

fn talk(live: &Live, stream: &TcpStream) -> io::Result<()> {
    let mut reader = BufReader::new(stream);
    loop {
        let mut line = Vec::new();
        let read = io::Read::take(&mut reader, LONGEST).read_until(b'\n', &mut line)?;
        if read == 0 {
            return Ok(());
        }
        if line.last() != Some(&b'\n') {
            return match read as u64 == LONGEST {
                true => answer(stream, "error a line of more than 1024 bytes"),
                false => Ok(()), // half a line, and the end: nothing was asked
            };
        }
        let text = String::from_utf8_lossy(&line);
        let said = obey(live, text.trim());
        answer(stream, &said.unwrap_or_else(|why| format!("error {why}")))?;
    }
}

fn obey(live: &Live, line: &str) -> Result<String, String> {
    let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    match word.to_ascii_lowercase().as_str() {
        "hello" => Ok(format!("ok handeye {}", text(&state(live)["cell"]["notation"]))),
        "pose" => capture(live, rest.trim()),
        "next" => Ok(next(&state(live))),
        _ => Err("the lines are: hello, next, pose and its numbers".into()),
    }
}

/// Takes a capture of this pose, and waits for what it is worth.
fn capture(live: &Live, pose: &str) -> Result<String, String> {
    let before = state(live);
    let (count, refused) = (captures(&before), refusals(&before));
    let tell = |command| live.command_blocking(command).map_err(|e| e.to_string());
    tell(Command::Pose { text: pose.into() })?;
    tell(Command::Take)?;
    let begin = Instant::now();
    let mut seen = before["version"].as_u64().unwrap_or(0);
    while begin.elapsed() < PATIENCE {
        let state = state(live);
        let version = state["version"].as_u64().unwrap_or(0);
        if version > seen {
            seen = version;
            if captures(&state) > count && state["assessing"] == false {
                return Ok(worth(&state));
            }
            let has_trouble = state["problem"].is_object() && state["problem"]["code"] != LATE;
            if refusals(&state) > refused || (has_trouble && state["taking"].is_null()) {
                return Err(text(&state["problem"]["message"]).to_owned());
            }
        }
        thread::sleep(POLL);
    }
    tell(Command::Cancel)?;
    Err(format!("no capture after {} s", PATIENCE.as_secs()))
}

fn worth(state: &Value) -> String {
    let all = match state["step"] == "verify" {
        true => &state["verify"]["views"],
        false => &state["captures"],
    };
    let id = all.as_array().and_then(|all| all.last()).map_or("", |c| text(&c["id"]));
    let error = match state["progress"]["p95_mm"].as_f64() {
        Some(mm) => format!("{mm:.3}"),
        None => "-".into(),
    };
    match state["progress"]["enough"] == true {
        true => format!("enough {id} {error}"),
        false => format!("ok {id} {error} {}", next(state)),
    }
}

fn next(state: &Value) -> String {
    if state["progress"]["enough"] == true {
        return "enough".into();
    }
    let Some(numbers) = state["next"]["numbers"].as_array() else { return "none".into() };
    let numbers = numbers.iter().filter_map(Value::as_f64).map(|x| format!(" {x:.6}"));
    format!("next{}", numbers.collect::<String>())
}

fn state(live: &Live) -> Value {
    serde_json::from_str(&live.shown().borrow().json).unwrap_or_default()
}

/// Captures, and views that verify them.
fn captures(state: &Value) -> usize {
    let count = |all: &Value| all.as_array().map_or(0, Vec::len);
    count(&state["captures"]) + count(&state["verify"]["views"])
}

fn refusals(state: &Value) -> usize {
    state["refused"].as_array().map_or(0, Vec::len)
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}
