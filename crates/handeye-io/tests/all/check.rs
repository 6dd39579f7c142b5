//! Simulated datasets with one mistake each, as files: the right explanation comes first, what data
//! cannot tell is not claimed, and a clean dataset raises no alarm.

#[allow(dead_code, reason = "the benchmark uses the rest")]
#[path = "../../../../bench/check/cases.rs"]
mod cases;

use cases::{MISTAKES, Mistake, Tellable, row};

/// Cases of each mistake: every number of captures but three.
const CASES: u64 = 9;

fn folder(name: &str) -> std::path::PathBuf {
    std::env::temp_dir().join(format!("handeye-check-{name}-{}", std::process::id()))
}

#[test]
fn the_right_explanation_comes_first() {
    let folder = folder("check-mistakes");
    let (mut all, mut right) = (0, 0);
    for mistake in MISTAKES {
        let row = row(mistake, CASES, &folder);
        println!("{:<44} {row:?}", mistake.name());
        assert_eq!(row.untellable.0, row.untellable.1, "{}: {row:?}", mistake.name());
        if mistake.tellable(cases::CAPTURES.1) != Tellable::Nothing {
            assert!(row.tellable.0 > 0, "{} was not asked", mistake.name());
        }
        all += row.tellable.0;
        right += row.tellable.1;
    }
    std::fs::remove_dir_all(&folder).ok();
    assert!(right * 100 >= all * 99, "{right} of {all}");
}

#[test]
fn a_clean_dataset_raises_no_alarm() {
    let folder = folder("check-clean");
    let row = row(Mistake::None, 100, &folder);
    std::fs::remove_dir_all(&folder).ok();
    assert_eq!(row.untellable, (100, 100), "{row:?}");
}
