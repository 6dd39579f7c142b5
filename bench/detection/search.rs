//! Many hard images and many without a board, drawn and looked at in memory: what is found, and
//! what is wrong.

use std::{
    collections::BTreeMap,
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

use handeye::{ImageCorner, detect::detect, simulate::TrueCorner};
use serde_json::{Value, json};

use crate::pictures::{Picture, empty_of, hard, targets};

/// A corner farther from the truth is wrong, px.
const WRONG_PX: f64 = 2.0;

/// Counts of one case of one kind of target.
#[derive(Default)]
struct Tally {
    pictures: usize,
    boards: usize,
    /// Visible corners, and those of them that were found.
    visible: usize,
    right: usize,
    wrong: usize,
    /// Seeds of the images with something wrong.
    seeds: Vec<u64>,
}

impl Tally {
    fn add(&mut self, other: Tally) {
        self.pictures += other.pictures;
        self.boards += other.boards;
        self.visible += other.visible;
        self.right += other.right;
        self.wrong += other.wrong;
        self.seeds.extend(other.seeds);
    }

    fn json(&self) -> Value {
        json!({
            "pictures": self.pictures, "boards": self.boards, "visible": self.visible,
            "right": self.right, "wrong": self.wrong, "seeds": self.seeds,
        })
    }
}

type Key = (&'static str, &'static str, String);

/// `hard` images of each case and target, `empty` images for all targets together.
pub fn search(hard_count: usize, empty_count: usize) -> Value {
    let pictures: Vec<Picture> = hard(hard_count);
    let jobs = pictures.len() + empty_count;
    let (next, tallies) = (AtomicUsize::new(0), Mutex::new(BTreeMap::<Key, Tally>::new()));
    let work = || {
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            let found = match pictures.get(k) {
                Some(picture) => vec![one_hard(picture)],
                None if k < jobs => one_empty(k - pictures.len()),
                None => break,
            };
            let mut tallies = tallies.lock().expect("no panic while it is held");
            found.into_iter().for_each(|(key, tally)| tallies.entry(key).or_default().add(tally));
        }
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| (0..threads).for_each(|_| drop(scope.spawn(work))));
    let tallies = tallies.into_inner().expect("no panic while it was held");
    let row = |((table, kind, case), mut tally): (Key, Tally)| {
        tally.seeds.sort_unstable();
        json!({ "table": table, "kind": kind, "case": case, "tally": tally.json() })
    };
    tallies.into_iter().map(row).collect()
}

fn one_hard(picture: &Picture) -> (Key, Tally) {
    let found = detect(&picture.drawn(), &picture.target).unwrap_or_default();
    let judged = |truth: &Vec<TrueCorner>| judged(&found, truth);
    // of two boards alike, the better one counts
    let boards = picture.boards();
    let best = boards.iter().map(judged).min_by_key(|t| (t.wrong, usize::MAX - t.right));
    let tally = Tally { seeds: vec![], ..best.unwrap_or_default() };
    let seeds = if tally.wrong > 0 { vec![picture.seed] } else { vec![] };
    (("hard", picture.kind(), picture.case.clone()), Tally { seeds, ..tally })
}

fn judged(found: &[ImageCorner], truth: &[TrueCorner]) -> Tally {
    let visible = truth.iter().filter(|c| c.visible == Some(true));
    let is_right = |c: &&TrueCorner| {
        found.iter().any(|f| f.id == c.id && (f.pixel - c.pixel).norm() <= WRONG_PX)
    };
    let is_wrong = |f: &&ImageCorner| {
        let true_one = truth.iter().find(|c| c.id == f.id);
        true_one.is_none_or(|c| (f.pixel - c.pixel).norm() > WRONG_PX)
    };
    Tally {
        pictures: 1,
        boards: usize::from(!found.is_empty()),
        visible: visible.clone().count(),
        right: visible.filter(is_right).count(),
        wrong: found.iter().filter(is_wrong).count(),
        seeds: vec![],
    }
}

fn one_empty(k: usize) -> Vec<(Key, Tally)> {
    let drawn = empty_of(k, &targets()[0].1);
    let (image, seed) = (drawn.drawn(), drawn.seed);
    let look = |(kind, target): (&'static str, _)| {
        let boards = usize::from(detect(&image, &target).is_ok());
        let seeds = if boards > 0 { vec![seed] } else { vec![] };
        let tally = Tally { pictures: 1, boards, seeds, ..Tally::default() };
        (("empty", kind, drawn.case.clone()), tally)
    };
    targets().into_iter().map(look).collect()
}
