//! What findings do to an answer.

use handeye::{
    Calibration, Pose, Setup, Verdict, Warning,
    calibrate::findings::{findings, reservation},
    findings::severity::Severity,
    unjudged,
};

fn result(verdict: Verdict, warnings: &[(&str, &str)], reasons: &[&str]) -> Calibration {
    let mut result = unjudged(Setup::EyeInHand, Pose::identity());
    result.verdict = verdict;
    result.warnings = warnings.iter().map(|(c, m)| Warning::new(c, *m)).collect();
    result.reasons = reasons.iter().map(|r| (*r).to_owned()).collect();
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
