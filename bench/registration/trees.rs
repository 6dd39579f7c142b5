//! Nearest neighbours: building a k-d tree, and asking it.

use std::path::Path;

use handeye::register::KdTree;
use nalgebra::Point3;
use serde_json::{Value, json};

use crate::{
    clock,
    scenes::{self, Order},
};

/// The tree of the target's points, asked for the nearest of each point of the source, in its true place;
/// the questions go row by row.
pub fn trees(folder: &Path, name: &str) -> Value {
    let (pair, _) = scenes::load(folder, name, Order::Rows);
    let moved = |p: &[f32; 3]| -> [f32; 3] {
        let at = pair.target_from_source * Point3::from(*p).cast::<f64>();
        at.coords.map(|x| x as f32).into()
    };
    let questions: Vec<[f32; 3]> = pair.source.points().iter().map(moved).collect();
    let points = pair.target.points();
    let tree = KdTree::new(points);
    let distances = || -> f64 {
        let nearest = |p: &[f32; 3]| tree.nearest(p, f32::INFINITY).map(|n| n.squared.sqrt());
        questions.iter().filter_map(nearest).map(f64::from).sum()
    };
    json!({
        "points": points.len(),
        "questions": questions.len(),
        "build_ms": clock::milliseconds(|| KdTree::new(points)),
        "ask_ms": clock::milliseconds(distances),
        "mean_distance": distances() / questions.len() as f64,
    })
}
