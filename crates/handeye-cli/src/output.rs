//! What the terminal shows.

use std::{
    cell::RefCell,
    fmt::Write as _,
    io::{self, ErrorKind, IsTerminal, Write},
    path::Path,
    sync::atomic::{AtomicBool, Ordering},
};

use clap::CommandFactory;
use clap_complete::Shell;
use handeye::{
    Calibration, Verdict, Warning,
    calibrate::{findings, result::CaptureResult},
    estimate::certify::Certificate,
    quaternion_xyzw,
};
use serde::Serialize;

use crate::args::{GlobalArgs, Program};

/// Whether something could not be written to standard output.
static LOST: AtomicBool = AtomicBool::new(false);

thread_local! {
    /// What this thread prints, on standard output and standard error, where a caller wants to have it.
    static KEPT: RefCell<Option<[String; 2]>> = const { RefCell::new(None) };
}

/// Keeps what `run` prints in this thread: its value, standard output and standard error.
pub fn captured<T>(run: impl FnOnce() -> T) -> (T, String, String) {
    KEPT.set(Some(Default::default()));
    let value = run();
    let [out, err] = KEPT.take().unwrap_or_default();
    (value, out, err)
}

/// Whether it is kept for a caller: standard output (0) or standard error (1).
fn is_kept(stream: usize, text: std::fmt::Arguments) -> bool {
    KEPT.with_borrow_mut(|kept| match kept {
        Some(kept) => kept[stream].write_fmt(text).is_ok(),
        None => false,
    })
}

/// Writes to standard error; a reader that went away (`2>&1 | head`) is no error.
pub fn to_stderr(text: std::fmt::Arguments) {
    if !is_kept(1, text) {
        io::stderr().lock().write_fmt(text).ok();
    }
}

/// Writes a line to standard error.
macro_rules! note {
    ($($text:tt)*) => {
        $crate::output::to_stderr(format_args!("{}\n", format_args!($($text)*)))
    };
}
pub(crate) use note;

/// Writes to standard output; a reader that went away (`| head`) is no error.
pub fn print(text: &str) {
    if is_kept(0, format_args!("{text}")) {
        return;
    }
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            note!("error: standard output: {error}; the output is not complete");
            LOST.store(true, Ordering::Relaxed);
        }
        _ => {}
    }
}

/// Columns of a terminal that everybody has.
const WIDTH: usize = 80;

/// A path as one word of a shell.
pub fn word(path: &Path) -> String {
    let text = path.display().to_string();
    let is_plain = |c: char| c.is_alphanumeric() || "/\\._-+=:,@".contains(c);
    match !text.is_empty() && text.chars().all(is_plain) {
        true => text,
        false => format!("'{}'", text.replace('\'', r"'\''")),
    }
}

/// Lines of at most 80 columns; all but the first are indented as far as the first one's heading.
pub fn wrapped(heading: &str, text: &str) -> String {
    wrapped_to(heading, heading.chars().count(), text)
}

fn wrapped_to(heading: &str, indent: usize, text: &str) -> String {
    let (mut lines, mut line) = (String::new(), heading.to_owned());
    for (k, word) in text.split_whitespace().enumerate() {
        if k > 0 && line.chars().count() + word.chars().count() > WIDTH {
            lines += &format!("{}\n", line.trim_end());
            line = " ".repeat(indent);
        }
        line += &format!("{word} ");
    }
    format!("{lines}{}\n", line.trim_end())
}

/// Whether something that was printed got lost, such as on a full disk.
pub fn lost() -> bool {
    LOST.load(Ordering::Relaxed)
}

/// One JSON document on standard output.
pub fn json(value: &impl Serialize) {
    match serde_json::to_string_pretty(value) {
        Ok(text) => print(&(text + "\n")),
        Err(error) => note!("error: {error}"),
    }
}

/// Completions for a shell.
pub fn completions(shell: Shell) {
    let mut script = Vec::new(); // clap_complete panics where it cannot write
    clap_complete::generate(shell, &mut Program::command(), "handeye", &mut script);
    print(&String::from_utf8_lossy(&script));
}

/// Warnings, to standard error.
pub fn warnings(calibration: &Calibration, global: &GlobalArgs) {
    warn(&calibration.warnings, global);
}

/// The same, of any result.
pub fn warn(warnings: &[Warning], global: &GlobalArgs) {
    if global.quiet {
        return;
    }
    for warning in warnings {
        let text = wrapped_to(&format!("warning [{}]: ", warning.code), 2, &warning.message);
        to_stderr(format_args!("{text}"));
    }
}

/// Colour, only where a person reads.
fn paint(text: &str, code: &str) -> String {
    let is_kept = KEPT.with_borrow(Option::is_some);
    if !is_kept && io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none() {
        format!("\x1b[{code}m{text}\x1b[0m")
    } else {
        text.to_owned()
    }
}

/// The verdict's word.
pub fn verdict(v: Verdict) -> String {
    verdict_as(v, name(v))
}

fn name(v: Verdict) -> &'static str {
    match v {
        Verdict::Accepted => "ACCEPTED",
        Verdict::Rejected => "REJECTED",
        Verdict::Undetermined => "UNDETERMINED",
    }
}

/// The colour between green and red.
const AMBER: &str = "1;33";

/// Another word in the verdict's colour.
pub fn verdict_as(v: Verdict, word: &str) -> String {
    let colour = match v {
        Verdict::Accepted => "1;32",
        Verdict::Rejected => "1;31",
        Verdict::Undetermined => AMBER,
    };
    paint(word, colour)
}

/// The result for people, in 80 columns.
pub fn summary(c: &Calibration) {
    let reservation = findings::reservation(c);
    let word = match &reservation {
        Some(_) => paint("ACCEPTED", AMBER),
        None => verdict(c.verdict),
    };
    let mut text = format!("\n{word}\n");
    text += &reservation.map_or(String::new(), |said| wrapped("  ", &said));
    text += &c.reasons.iter().map(|reason| wrapped("  ", reason)).collect::<String>();
    text += &transform(c);
    text += &candidates(c);
    text += &c.certificate.as_ref().map_or(String::new(), certificate);
    if let Some(scene) = c.scans.as_ref().and_then(|scans| scans.scene.as_ref()) {
        text += "\n";
        text += &wrapped("", &scene.sentence(c.captures.len()));
    }
    text += &captures(c);
    print(&text);
}

/// The result in one line, for logs: the verdict, the predicted error or the first reason, captures, and what it is of.
pub fn line(c: &Calibration, of: &Path) -> String {
    let error = c.predicted_tre_mm.as_ref().map(|tre| format!("{:.3} mm (95 %)", tre.p95));
    let said = match c.verdict {
        Verdict::Accepted => {
            findings::reservation(c).map(|s| s.replacen("Accepted, but", "but", 1))
        }
        _ => c.reasons.first().cloned(),
    };
    let used = c.captures.iter().filter(|k| k.used).count();
    let captures =
        (!c.captures.is_empty()).then(|| format!("{used} of {} captures", c.captures.len()));
    let parts = [
        Some(name(c.verdict).to_owned()),
        error,
        captures,
        Some(self::word(of)),
        c.run_id.clone(),
        said,
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    parts.join("  ").replace('\n', " ") + "\n"
}

/// How many captures the answer rests on, and the names of all others.
fn captures(c: &Calibration) -> String {
    if c.captures.is_empty() {
        return String::new();
    }
    let used = c.captures.iter().filter(|k| k.used).count();
    let mut text = format!("\n{used} of {} captures used\n", c.captures.len());
    if !c.rejected.is_empty() {
        text += &wrapped("rejected: ", &c.rejected.join(", "));
    }
    let is_unseen = |k: &&CaptureResult| !k.used && !c.rejected.contains(&k.id);
    let unseen: Vec<&str> = c.captures.iter().filter(is_unseen).map(|k| k.id.as_str()).collect();
    if !unseen.is_empty() {
        let why = if used + c.rejected.len() == 0 { "not used: " } else { "without target: " };
        text += &wrapped(why, &unseen.join(", "));
    }
    text
}

fn transform(c: &Calibration) -> String {
    let Some(pose) = &c.hand_eye.mount_from_camera else {
        if c.undetermined.is_empty() {
            return String::new();
        }
        let mut text = "\n".to_owned() + &wrapped("not determined: ", &c.undetermined.join(", "));
        for line in c.determined.iter().flat_map(|d| d.lines()) {
            text += &wrapped("determined: ", &line);
        }
        return text;
    };
    let t = pose.translation() * 1e3;
    let [i, j, k, w] = quaternion_xyzw(&pose.iso().rotation);
    let use_it = if c.verdict == Verdict::Rejected { "; rejected: do not use it" } else { "" };
    let mut text = format!("\n{}  ({}{use_it})\n", c.name, c.method);
    text += &format!("  translation  {:11.3} {:11.3} {:11.3}   mm\n", t.x, t.y, t.z);
    text += &format!("  quaternion   {i:11.7} {j:11.7} {k:11.7} {w:11.7}   x y z w\n");
    if let Some(rows) = &c.hand_eye.covariance.mount_from_camera {
        let s = |k: usize| rows[k][k].max(0.0).sqrt();
        text += &format!(
            "  one sigma    {:11.3} {:11.3} {:11.3}   mm, in the camera's axes\n",
            s(3) * 1e3,
            s(4) * 1e3,
            s(5) * 1e3
        );
        text += &format!(
            "               {:11.4} {:11.4} {:11.4}   degrees about them\n",
            s(0).to_degrees(),
            s(1).to_degrees(),
            s(2).to_degrees()
        );
    }
    text + &unknowns(c)
}

/// What is proven of the least-squares fit.
fn certificate(c: &Certificate) -> String {
    let said = if c.certified {
        format!("no other pair of poses fits better by least squares (relative gap {:.0e})", c.gap)
    } else {
        format!(
            "not proven: another pair of poses may fit better by least squares (relative gap {:.0e})",
            c.gap
        )
    };
    let apart = format!(
        "; that fit is {:.3} mm and {:.4} degrees from the answer",
        c.translation_to_answer_mm, c.rotation_to_answer_deg
    );
    "\n".to_owned() + &wrapped("certificate: ", &(said + &apart))
}

/// Time offset and scale, where they were estimated.
fn unknowns(c: &Calibration) -> String {
    let mut text = String::new();
    if let (Some(offset), Some(sigma)) = (c.time_offset_s, c.time_offset_sigma_s) {
        text += &format!("  time offset  {offset:11.6} +- {sigma:.6} s, camera minus robot\n");
    }
    match (c.scale, c.scale_sigma) {
        (Some(scale), Some(sigma)) => {
            text += &format!("  scale        {scale:11.6} +- {sigma:.6}, measured over metric\n");
        }
        (Some(scale), None) if scale != 1.0 => {
            text += &format!("  scale        {scale:11.6}, measured over metric\n");
        }
        _ => {}
    }
    text
}

fn candidates(c: &Calibration) -> String {
    if c.candidates.is_empty() {
        return String::new();
    }
    // of captures both columns before, so that they compare; touches have one of their own
    let touched = !c.touches.is_empty();
    let line = |mark: &str, name: &str, [own, out, touches, tre]: [&str; 4]| {
        let touches = if touched { format!("{touches:>12}") } else { String::new() };
        format!("{mark} {name:<26}{own:>12}{out:>13}{touches}{tre:>15}\n")
    };
    let head = ["in sample", "held out", "touches", "predicted RMS"];
    let mut text = "\n".to_owned() + &line(" ", "candidate", head);
    for k in &c.candidates {
        let mark = if c.chosen.as_deref() == Some(k.name.as_str()) { ">" } else { " " };
        let touches = k.held_out_mm.filter(|_| k.touch_rms_mm.is_some());
        let figures = [
            k.in_sample.translation_rms_mm,
            k.held_out.translation_rms_mm,
            touches,
            k.predicted_tre_mm,
        ];
        let figures = figures.map(mm);
        text += &line(mark, &k.name, figures.each_ref().map(String::as_str));
    }
    text
}

fn mm(value: Option<f64>) -> String {
    value.map_or("-".into(), |v| format!("{v:.3} mm"))
}
