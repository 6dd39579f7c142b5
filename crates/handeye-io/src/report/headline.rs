//! What is read first: the verdict, the accuracy to expect and where, and the figures behind it.

use handeye::{Calibration, Verdict, calibrate::findings, estimate::predict::PredictedTre};

use super::{RESERVED, Report, escape, judgement, word};

/// Volumes that are those of the captures.
const SEEN: &str = "the box in which the camera saw";

/// The verdict of a calibration with its reasons.
pub(super) fn verdict(report: &Report) -> String {
    let c = report.calibration;
    let accepted = c.verdict == Verdict::Accepted;
    let reservation = findings::reservation(c).filter(|_| accepted);
    let word = if reservation.is_some() { RESERVED } else { word(c.verdict) };
    let expected = c.predicted_tre_mm.as_ref().filter(|_| accepted);
    // the reason of an accepted answer is its accuracy
    let reasons = if expected.is_some() { &[] } else { &c.reasons[..] };
    let sentences: Vec<String> = reservation.into_iter().chain(reasons.iter().cloned()).collect();
    let accuracy = expected.map_or(String::new(), |tre| accuracy(tre, c.max_error_mm));
    judgement((c.verdict, word), &sentences, &accuracy, &facts(c))
}

/// The accuracy to expect, where, and how near that is to the limit.
fn accuracy(tre: &PredictedTre, limit_mm: Option<f64>) -> String {
    let size = tre.map.as_ref().map(|map| {
        let side = |k: usize| format!("{:.0}", map.maximum_mm[k] - map.minimum_mm[k]);
        format!("{} x {} x {} mm", side(0), side(1), side(2))
    });
    let volume = match (tre.r#where.starts_with(SEEN), size) {
        (true, Some(size)) => format!("the calibrated volume, {size}"),
        (_, Some(size)) => format!("{}, {size}", tre.r#where),
        (_, None) => tre.r#where.clone(),
    };
    let once = tre.at_task_p95.filter(|mm| *mm > 1.01 * tre.p95).map_or(String::new(), |mm| {
        format!(
            "<p>A robot that moves to a point once: {mm:.2} mm (95 %), its own errors included.</p>"
        )
    });
    let bar = limit_mm.filter(|mm| *mm > 0.0).map_or(String::new(), |limit| {
        let share = (100.0 * tre.p95 / limit).clamp(0.5, 100.0);
        format!(
            "<div class=\"limit\" role=\"img\" aria-label=\"{:.2} of at most {limit} mm\"><i style=\"width:{share:.1}%\"></i></div>\
             <p class=\"note ends\"><span>0</span><span>accepted up to {limit} mm</span></p>",
            tre.p95
        )
    });
    format!(
        "<div class=\"sentence\">Expected accuracy {:.2} mm (95 %) in {}.</div>{bar}{once}",
        tre.p95,
        escape(&volume)
    )
}

fn facts(c: &Calibration) -> Vec<(String, String)> {
    let mut all = Vec::new();
    if let Some(tre) = c.predicted_tre_mm.as_ref().filter(|_| c.verdict != Verdict::Rejected) {
        all.push((format!("{:.2} mm", tre.rms), "predicted error, RMS".to_owned()));
    }
    if let Some(t) = c.held_out.translation_rms_mm {
        let r = c.held_out.rotation_rms_deg.map_or(String::new(), |r| format!(" / {r:.2}&deg;"));
        all.push((format!("{t:.2} mm{r}"), "leave-one-out residual, RMS".to_owned()));
    }
    if !c.captures.is_empty() {
        let used = c.captures.iter().filter(|k| k.used).count();
        all.push((format!("{used} of {}", c.captures.len()), "captures used".to_owned()));
        let unseen = c.captures.len() - used - c.rejected.len().min(c.captures.len() - used);
        for (count, name) in [(c.rejected.len(), "rejected"), (unseen, "without target")] {
            if count > 0 {
                all.push((count.to_string(), format!("captures {name}")));
            }
        }
    }
    if !c.touches.is_empty() {
        all.push((c.touches.len().to_string(), "touched corners".to_owned()));
    }
    all
}

#[cfg(test)]
mod tests {
    use handeye::estimate::predict::TreMap;

    use super::*;

    fn predicted(volume: &str, map: bool) -> PredictedTre {
        let map = map.then(|| TreMap {
            frame: "camera".into(),
            minimum_mm: [-100.0, -50.0, 400.0],
            maximum_mm: [100.0, 70.0, 700.4],
            slices: vec![],
        });
        PredictedTre { rms: 0.3, p95: 0.5, at_task_p95: Some(0.8), r#where: volume.into(), map }
    }

    #[test]
    fn the_accuracy_is_said_with_its_volume_and_shown_against_the_limit() {
        let seen = predicted("the box in which the camera saw the target", true);
        let text = accuracy(&seen, Some(10.0));
        let sentence =
            "Expected accuracy 0.50 mm (95 %) in the calibrated volume, 200 x 120 x 300 mm.";
        assert!(text.contains(sentence), "{text}");
        assert!(text.contains("width:5.0%") && text.contains("accepted up to 10 mm"), "{text}");
        assert!(text.contains("0.80 mm (95 %), its own errors included"), "{text}");
    }

    #[test]
    fn a_stated_workspace_keeps_its_name_and_without_a_limit_there_is_no_bar() {
        let text = accuracy(&predicted("the workspace", false), None);
        assert!(
            text.contains("(95 %) in the workspace.") && !text.contains("class=\"limit\""),
            "{text}"
        );
    }
}
