//! Nearest neighbours: building a k-d tree, and asking it.

use std::path::Path;

use handeye::register::KdTree;
use nalgebra::Point3;
use serde_json::{Value, json};

use crate::{
    clock,
    scenes::{self, Order},
};

/// Questions that registration asks have an answer within, m.
const NEAR_M: f32 = 0.01;

/// The tree of the target's points, asked for the nearest of points of the source, in their true place and
/// row by row: of those that have one near, and of all.
pub fn trees(folder: &Path, name: &str) -> Value {
    let (pair, _) = scenes::load(folder, name, Order::Rows);
    let moved = |p: &[f32; 3]| -> [f32; 3] {
        let at = pair.target_from_source * Point3::from(*p).cast::<f64>();
        at.coords.map(|x| x as f32).into()
    };
    let all: Vec<[f32; 3]> = pair.source.points().iter().map(moved).collect();
    let points = pair.target.points();
    let tree = KdTree::new(points);
    let near: Vec<[f32; 3]> =
        all.iter().filter(|p| tree.nearest(p, NEAR_M).is_some()).copied().collect();
    json!({
        "points": points.len(),
        "questions": all.len(),
        "near": near.len(),
        "build_ms": clock::milliseconds(|| KdTree::new(points)),
        "near_ms": clock::milliseconds(|| distances(&tree, &near)),
        "all_ms": clock::milliseconds(|| distances(&tree, &all)),
        "mean_distance": distances(&tree, &all) / all.len() as f64,
    })
}

/// Their sum.
fn distances(tree: &KdTree, questions: &[[f32; 3]]) -> f64 {
    let nearest = |p: &[f32; 3]| tree.nearest(p, f32::INFINITY).map(|n| n.squared.sqrt());
    questions.iter().filter_map(nearest).map(f64::from).sum()
}
