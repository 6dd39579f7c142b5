//! Nearest neighbours by kiddo, as `../trees.rs` asks them of handeye's tree, for `bench/registration/run.py`:
//!
//! ```text
//! cargo run --release -- FOLDER SCENE
//! ```

#[allow(dead_code)] // memory is not measured here
#[path = "../../clock.rs"]
mod clock;

use std::{env, fs, io, path::Path};

use kiddo::{Eytzinger, FlatVec, KdTree, SquaredEuclidean};
use serde_json::{Value, json};

/// On these scans, faster than its `ImmutableKdTree`.
type Tree = KdTree<f32, u32, Eytzinger, FlatVec<f32, u32, 3, 32>, 3, 32>;

/// Questions that registration asks have an answer within, m.
const NEAR_M: f32 = 0.01;

fn main() {
    let args: Vec<String> = env::args().collect();
    let [_, folder, name] = &args[..] else {
        panic!("usage: kiddo FOLDER SCENE, after run.py rendered SCENE into FOLDER")
    };
    let folder = Path::new(folder);
    let scene = folder.join(format!("{name}.json"));
    let text = fs::read_to_string(&scene).unwrap_or_else(|error| missing(&scene, &error));
    let known: Value = serde_json::from_str(&text).expect("a scene as render writes it");
    let truth: Vec<f64> = serde_json::from_value(known["truth"].clone()).expect("16 numbers");
    let moved = |p: [f32; 3]| {
        [0, 1, 2].map(|row| {
            let at = |k: usize| truth[4 * row + k];
            (at(0) * f64::from(p[0]) + at(1) * f64::from(p[1]) + at(2) * f64::from(p[2]) + at(3))
                as f32
        })
    };
    let target = seen(&folder.join(format!("{name}_target.f32")));
    let source = seen(&folder.join(format!("{name}_source.f32")));
    let all: Vec<[f32; 3]> = source.into_iter().map(moved).collect();
    let tree = built(&target);
    let near: Vec<[f32; 3]> = all.iter().filter(|p| nearest(&tree, p) < NEAR_M).copied().collect();
    let measured = json!({
        "points": target.len(),
        "questions": all.len(),
        "near": near.len(),
        "build_ms": clock::milliseconds(|| built(&target)),
        "near_ms": clock::milliseconds(|| distances(&tree, &near)),
        "all_ms": clock::milliseconds(|| distances(&tree, &all)),
        "mean_distance": distances(&tree, &all) / all.len() as f64,
    });
    println!("{measured}");
}

fn missing(file: &Path, error: &io::Error) -> ! {
    panic!("{}: {error}; render the scene first", file.display())
}

fn built(points: &[[f32; 3]]) -> Tree {
    Tree::new_from_slice(points).expect("a tree")
}

fn nearest(tree: &Tree, question: &[f32; 3]) -> f32 {
    tree.query(question).nearest_one::<SquaredEuclidean<f32>>().execute().distance.sqrt()
}

/// Their sum.
fn distances(tree: &Tree, questions: &[[f32; 3]]) -> f64 {
    questions.iter().map(|p| f64::from(nearest(tree, p))).sum()
}

/// Points of a file that were seen.
fn seen(file: &Path) -> Vec<[f32; 3]> {
    let bytes = fs::read(file).unwrap_or_else(|error| missing(file, &error));
    let (numbers, _) = bytes.as_chunks::<4>();
    let numbers: Vec<f32> = numbers.iter().map(|b| f32::from_le_bytes(*b)).collect();
    let (points, _) = numbers.as_chunks::<3>();
    points.iter().filter(|p| p.iter().all(|x| x.is_finite())).copied().collect()
}
