//! What findings do to an answer, and that every code is listed and explained.

use std::{collections::BTreeSet, fs, path::Path};

use handeye::{
    Calibration, Pose, Setup, Verdict, Warning,
    calibrate::findings::{findings, reservation},
    findings::{
        TouchFinding,
        severity::{Severity, codes},
    },
    unjudged,
};

fn result(verdict: Verdict, warnings: &[(&str, &str)], reasons: &[&str]) -> Calibration {
    let mut result = unjudged(Setup::EyeInHand, Pose::identity(), None);
    result.verdict = verdict;
    result.warnings = warnings.iter().map(|(c, m)| Warning::new(c, *m)).collect();
    result.reasons = reasons.iter().map(|r| (*r).to_owned()).collect();
    result.findings = findings(&result);
    result
}

#[test]
fn an_answer_that_a_finding_changes_is_accepted_with_a_reservation() {
    let warnings = [("few-captures", "few"), ("tip-off", "off"), ("tip-off", "once more")];
    let found = result(Verdict::Accepted, &warnings, &["95 of 100 points"]);
    let severities: Vec<Severity> = findings(&found).iter().map(|f| f.severity).collect();
    assert_eq!(severities, [Severity::Info, Severity::ChangesAnswer, Severity::ChangesAnswer]);
    let said = reservation(&found);
    assert_eq!(said.as_deref(), Some("Accepted, but: the answer corrects the tool's tip"));
    assert_eq!(reservation(&result(Verdict::Accepted, &warnings[..1], &[])), None);
    assert_eq!(reservation(&result(Verdict::Rejected, &warnings, &[])), None);
}

#[test]
fn reasons_against_an_answer_are_findings_that_reject_and_are_said_once() {
    let warnings = [("target-scale", "2 % larger"), ("few-captures", "few")];
    let found = result(Verdict::Rejected, &warnings, &["2 % larger", "too imprecise"]);
    let all: Vec<(String, Severity)> =
        findings(&found).into_iter().map(|f| (f.code, f.severity)).collect();
    let expected = [
        ("rejected", Severity::Rejects),
        ("target-scale", Severity::Rejects),
        ("few-captures", Severity::Info),
    ];
    assert_eq!(all, expected.map(|(code, severity)| (code.to_owned(), severity)));
}

#[test]
fn the_numbers_of_a_finding_stand_in_its_headline_and_in_its_data() {
    let mut found = result(Verdict::Accepted, &[], &[]);
    let tip = TouchFinding::TipOff {
        offset_mm: [0.0, 3.0, -4.0],
        in_flange: true,
        p_value: 1e-6,
        squares: None,
    };
    found.warnings.push(tip.into());
    found.findings = findings(&found);
    let words = Some("Accepted, but: the answer corrects the tool's tip by 5.00 mm");
    assert_eq!(reservation(&found).as_deref(), words);
    assert_eq!(found.findings[0].data["z_mm"], -4.0);
    // a result that was written and read back says the same
    let read: Calibration = serde_json::from_str(&serde_json::to_string(&found).unwrap()).unwrap();
    assert_eq!(read, found);
    assert_eq!(reservation(&read).as_deref(), words);
}

#[test]
fn what_would_reject_and_did_not_is_said_in_its_own_words() {
    let warnings = [("no-clear-majority", "half of the captures say otherwise")];
    let found = result(Verdict::Accepted, &warnings, &[]);
    let said = reservation(&found);
    assert_eq!(said.as_deref(), Some("Accepted, but: half of the captures say otherwise"));
}

/// What stands between two marks, wherever they stand in a text.
fn between<'a>(text: &'a str, open: &'a str, close: &'a str) -> impl Iterator<Item = &'a str> {
    text.split(open).skip(1).filter_map(move |rest| rest.split(close).next())
}

#[test]
fn every_code_of_a_subject_is_in_its_list() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/findings");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let on_one_line = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let texts: Vec<String> =
        files.map(|path| on_one_line(fs::read_to_string(path).unwrap())).collect();
    let rows = texts.iter().flat_map(|text| between(text, ": Row = Row::", ";"));
    let written: Vec<&str> = rows.map(|row| between(row, "\"", "\"").next().unwrap()).collect();
    let listed: BTreeSet<&str> = codes().collect();
    assert_eq!(written.iter().copied().collect::<BTreeSet<_>>(), listed);
    assert_eq!(written.len(), listed.len(), "two rows have one code");
    assert_eq!(codes().count(), listed.len(), "a code is listed twice");
}

#[test]
fn every_code_has_an_entry_in_the_book() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../book/src/trouble/codes.md");
    let page = fs::read_to_string(page).unwrap();
    let missing: Vec<&str> =
        codes().filter(|code| !page.contains(&format!("\n### `{code}`\n"))).collect();
    assert!(missing.is_empty(), "{missing:?}");
}
