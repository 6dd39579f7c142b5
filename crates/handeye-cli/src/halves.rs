//! `handeye compare` of one dataset: do the halves of its captures agree?

use std::path::Path;

use handeye::{
    Config, Setup, Verdict,
    tools::{
        halves::{self, Division, Halves},
        repeat::Agreement,
    },
};
use handeye_io::{Dataset, calibrate::halves_of_dataset, read_result};
use serde::Serialize;

use crate::{
    args::GlobalArgs,
    difference::{Difference, chance, difference},
    failure::Failure,
    output,
    progress::Progress,
};

#[derive(Serialize)]
struct Answer {
    agree: Option<bool>,
    setup: Setup,
    captures: usize,
    halves: Vec<One>,
}

/// One way to divide the captures.
#[derive(Serialize)]
struct One {
    division: Division,
    captures: [Vec<String>; 2],
    verdicts: [Verdict; 2],
    /// Of the second half's answer from the first one's; null where one is not determined.
    difference: Option<Difference>,
    test: Option<Agreement>,
}

pub fn run(path: &Path, root: Option<&Path>, global: &GlobalArgs) -> Result<u8, Failure> {
    if path.extension().is_some_and(|e| e == "json") || read_result(path).is_ok() {
        let what = "is one result: name another one, or the folder of the captures, of which halves are compared";
        return Err(Failure::Usage(format!("{}: {what}", path.display())));
    }
    let dataset = match root {
        Some(root) => Dataset::open_with_root(path, root)?,
        None => Dataset::open(path)?,
    };
    let progress = Progress::new("reading captures", global);
    let found =
        halves_of_dataset(&dataset, &Config::default(), &|done, all| progress.tell(done, all))?;
    drop(progress);
    let answer = Answer {
        agree: halves::agree(&found),
        setup: dataset.setup,
        captures: found.first().map_or(0, |h| h.captures.iter().map(Vec::len).sum()),
        halves: found.iter().map(one).collect(),
    };
    if global.json {
        output::json(&answer);
    } else {
        output::print(&table(&answer));
    }
    Ok(if answer.agree == Some(true) { 0 } else { 3 })
}

fn one(h: &Halves) -> One {
    let [a, b] = &h.mount_from_camera;
    One {
        division: h.division,
        captures: h.captures.clone(),
        verdicts: h.verdicts,
        difference: a.as_ref().zip(b.as_ref()).map(|(a, b)| difference(&[], a, b)),
        test: h.agreement,
    }
}

/// For people, in 80 columns.
fn table(a: &Answer) -> String {
    let mut text = format!("\n{}\n\n", sentence(a));
    text += &format!(
        "  {:<27}{:>9}{:>15}{:>12}   {}\n",
        format!("halves of {} captures", a.captures),
        "origin",
        "0.5 m before",
        "rotation",
        "chance"
    );
    for one in &a.halves {
        let name = match one.division {
            Division::Alternating => "every second capture",
            Division::ByPlace => "by place of the robot",
            Division::InTime => "earlier and later",
        };
        text += &match (&one.difference, &one.test) {
            (Some(d), test) => format!(
                "  {name:<27}{:>6.3} mm{:>12.3} mm{:>8.4} deg   {}\n",
                d.camera_origin_mm,
                d.half_a_metre_before_camera_mm,
                d.rotation_deg,
                test.map_or("not tested".into(), |t| chance(t.p_value))
            ),
            (None, _) => format!("  {name:<27}a half leaves the transform open\n"),
        };
    }
    text
}

fn sentence(a: &Answer) -> String {
    let worst = a.halves.iter().filter(|h| h.test.is_some());
    let worst = worst.min_by(|a, b| p_value(a).total_cmp(&p_value(b)));
    match (a.agree, worst.map(|h| h.division)) {
        (Some(true), _) => "AGREE  halves of the captures differ no more than their covariances allow".into(),
        (None, _) | (_, None) => {
            "NOT TESTED  a half of the captures leaves the transform or its error open;\n       take more captures".into()
        }
        (_, Some(Division::Alternating)) => {
            "DISAGREE  every second capture gives another transform than the rest: the stated\n       error is too small for the noise of this cell".into()
        }
        (_, Some(Division::ByPlace)) => {
            "DISAGREE  captures at one end of the robot's places give another transform than\n       those at the other end: the stated error holds only where the captures are".into()
        }
        (_, Some(Division::InTime)) => {
            "DISAGREE  the earlier captures give another transform than the later ones: something\n       moved or drifted; fasten camera and target, and take the captures again".into()
        }
    }
}

fn p_value(one: &One) -> f64 {
    one.test.map_or(1.0, |t| t.p_value)
}
