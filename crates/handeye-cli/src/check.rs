//! `handeye check`: what is wrong with a dataset? The mistake that explains it best, with evidence.

use std::path::{Path, PathBuf};

use handeye::mistakes::score::Score;
use handeye_io::{
    MANIFEST,
    checkup::{self, Checkup, Explanation},
};
use serde::Serialize;

use crate::{
    args::{CheckArgs, GlobalArgs},
    failure::Failure,
    output,
    progress::Progress,
};

#[derive(Serialize)]
struct Answer {
    #[serde(flatten)]
    found: Checkup,
    applied: Option<Applied>,
}

/// What was written.
#[derive(Serialize)]
struct Applied {
    /// Which explanation, counted from 1.
    explanation: usize,
    /// The manifest as it was.
    old_manifest: PathBuf,
}

pub fn run(args: &CheckArgs, global: &GlobalArgs) -> Result<u8, Failure> {
    let manifest = match args.dataset.is_dir() {
        true => args.dataset.join(MANIFEST),
        false => args.dataset.clone(),
    };
    let root = args.root.clone().or_else(|| manifest.parent().map(PathBuf::from));
    let progress = Progress::new("reading captures", global);
    let root = root.unwrap_or_default();
    let found = checkup::check(&manifest, &root, &|done, all| progress.tell(done, all))?;
    drop(progress);
    output::warn(&found.warnings, global);
    let applied = match args.apply {
        Some(which) => apply(&manifest, &root, &found, which)?,
        None => None,
    };
    let answer = Answer { found, applied };
    if global.json {
        output::json(&answer);
    } else {
        output::print(&text(&answer, args.apply));
    }
    Ok(if answer.found.ok { 0 } else { 3 })
}

/// Applies the explanation that the data single out, or the one that the user chose (from 1).
fn apply(
    manifest: &Path,
    root: &Path,
    found: &Checkup,
    which: usize,
) -> Result<Option<Applied>, Failure> {
    let chosen: Option<&Explanation> = match which {
        0 => found.decided(),
        k => found.explanations.get(k - 1),
    };
    if which > found.explanations.len() {
        let many = found.explanations.len();
        return Err(Failure::Usage(format!(
            "--apply={which}: there are {many} explanations; see them without --apply"
        )));
    }
    let Some(chosen) = chosen.filter(|e| !e.changes.is_empty()) else { return Ok(None) };
    let old_manifest = checkup::apply(manifest, root, chosen)?;
    Ok(Some(Applied { explanation: which.max(1), old_manifest }))
}

fn residual(score: Option<&Score>) -> String {
    score.map_or("no agreement at all".into(), |s| {
        let agree = if s.agree == 0 { "none".into() } else { s.agree.to_string() };
        format!("{:.2} mm, {:.3} degrees, {agree} agree", s.translation_mm, s.rotation_deg)
    })
}

/// Beyond this the factor itself says nothing.
const MANY_TIMES: f64 = 1e6;

fn closer(times: f64) -> String {
    match times {
        t if t > MANY_TIMES => {
            "combined residual more than a million times smaller than as declared".into()
        }
        t if t >= 100.0 => format!("combined residual {t:.0} times smaller than as declared"),
        t => format!("combined residual {t:.1} times smaller than as declared"),
    }
}

/// What speaks for an explanation.
fn evidence(declared: Option<&Score>, e: &Explanation) -> String {
    let Some(after) = &e.after else { return String::new() };
    let mut text = format!("    median residual  {}\n", residual(Some(after)));
    text += &match (e.p_value, declared) {
        (Some(p), _) => format!(
            "    evidence         p = {p:.1e} (probability in a dataset without this mistake)\n"
        ),
        (None, Some(d)) => {
            format!("    evidence         {}\n", closer(d.score / after.score))
        }
        (None, None) => String::new(),
    };
    text
}

/// For people, in 80 columns.
fn text(answer: &Answer, apply: Option<usize>) -> String {
    let a = &answer.found;
    let mut text = String::from("\n");
    text += &match (a.ok, a.explanations.is_empty()) {
        (true, _) => output::wrapped("", "No mistake found in the captures."),
        (false, true) => output::wrapped(
            "",
            "The captures do not agree, and none of the usual mistakes explains it: check the \
             target, the intrinsics, and that images and robot poses belong together.",
        ),
        (false, false) if a.alike > 1 => output::wrapped(
            "",
            &format!(
                "Cannot tell between these {}: they explain the captures equally well.",
                a.alike
            ),
        ),
        (false, false) => String::new(),
    };
    // with another target or unit than declared, captures are not compared at all
    if a.readings_tried > 0 || a.explanations.is_empty() {
        text += &format!("\n  as declared, of {} captures\n", a.captures);
        text += &format!("    median residual  {}\n", residual(a.declared.as_ref()));
    }
    for (k, e) in a.explanations.iter().enumerate() {
        text += "\n";
        text += &output::wrapped(&format!("{}  ", k + 1), &e.message);
        text += &evidence(a.declared.as_ref(), e);
        for c in &e.changes {
            let table = if c.table.is_empty() { String::new() } else { format!("[{}] ", c.table) };
            text += &format!("    {table}{} = {}\n", c.key, c.value);
        }
    }
    if let Some(r) = &a.runner_up {
        let what = format!("next best of {} alternatives tried: {}", a.readings_tried, r.message);
        text += "\n";
        text += &output::wrapped("   ", &what);
        text += &format!("    median residual  {}\n", residual(Some(&r.after)));
    }
    if !a.not_seen.is_empty() {
        text += "\n";
        text += &output::wrapped("  the target was not found in: ", &a.not_seen.join(", "));
    }
    text + &applied(answer, apply)
}

fn applied(answer: &Answer, apply: Option<usize>) -> String {
    let a = &answer.found;
    let Some(which) = apply else { return String::new() };
    match &answer.applied {
        Some(done) => {
            let changed: Vec<String> = a.explanations[done.explanation - 1]
                .changes
                .iter()
                .map(|c| format!("{} = {}", c.key, c.value))
                .collect();
            format!(
                "\nmanifest corrected: {}\nthe old one: {}\n",
                changed.join(", "),
                done.old_manifest.display()
            )
        }
        None if a.ok => "\nnothing applied: nothing is wrong\n".into(),
        None if which == 0 && a.alike > 1 => {
            "\nnothing applied: choose one of them, for example --apply=1\n".into()
        }
        None => {
            let chosen = a.explanations.get(which.max(1) - 1);
            let by_hand = chosen.and_then(|e| e.by_hand.as_deref());
            let why = by_hand.unwrap_or("no mistake was found that a manifest could correct");
            format!("\n{}", output::wrapped("", &format!("nothing applied: {why}")))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_factors_are_said_in_words() {
        assert_eq!(
            closer(388_105_634.0),
            "combined residual more than a million times smaller than as declared"
        );
        assert_eq!(
            closer(f64::INFINITY),
            "combined residual more than a million times smaller than as declared"
        );
        assert_eq!(closer(4321.9), "combined residual 4322 times smaller than as declared");
        assert_eq!(closer(3.16), "combined residual 3.2 times smaller than as declared");
    }
}
