//! Shapes of what stands in a cell, each in its own frame (m).

use handeye::{Intrinsics, TargetModel};
use nalgebra::Vector3;

use crate::report::scene::Body;

/// Width and opacity of boards: what was seen is drawn over where the result puts it.
const BOARD_LINE: (f64, f64) = (2.6, 0.7);
const SEEN_LINE: (f64, f64) = (1.3, 0.95);
const FRUSTUM_LINE: (f64, f64) = (1.5, 0.9);
/// How little of what is behind a board or a frustum it covers.
const GLASS: f64 = 0.13;
/// Black and white as they are printed.
const BLACK: &str = "#333b47";
const WHITE: &str = "#eceff3";
const BODY: &str = "#6d7a8b";
/// Corners of round things.
const ROUND: usize = 28;
/// Half the side of a target whose size is not known, m.
const UNKNOWN_M: f64 = 0.03;
/// More squares of a print are not drawn.
const MOST_SQUARES: u32 = 1500;

/// What people call such a target.
pub fn name(target: Option<&TargetModel>) -> &'static str {
    match target {
        None => "target",
        Some(TargetModel::Sphere { .. }) => "ball",
        Some(TargetModel::Tag { .. }) => "tag",
        Some(_) => "board",
    }
}

fn circle(radius: f64) -> Vec<Vector3<f64>> {
    let at = |k: usize| {
        let angle = k as f64 / ROUND as f64 * std::f64::consts::TAU;
        Vector3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
    };
    (0..ROUND).map(at).collect()
}

fn closed(points: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    points.iter().chain(points.first()).copied().collect()
}

/// A solid disc behind its face: a flange, and what a robot stands on.
pub fn disc(radius: f64, height: f64, colour: &str) -> Body {
    let mut body = Body::default();
    body.prism(&circle(radius), -height, 0.0, Some(colour));
    body
}

/// The face of a flange and its axes, by lines.
pub fn flange(radius: f64, axis: f64, colour: &str) -> Body {
    let mut body = Body::default();
    body.line(&closed(&circle(radius)), Some(colour), 1.2, 0.8);
    body.axes(axis);
    body
}

/// What the camera sees up to a depth, and a box behind its centre.
pub fn camera(camera: Option<&Intrinsics>, depth: f64, colour: Option<&str>) -> Body {
    let (x, y) = camera.map_or((0.35, 0.27), |k| {
        (0.5 * f64::from(k.width) / k.fx, 0.5 * f64::from(k.height) / k.fy)
    });
    let at = |u: f64, v: f64| Vector3::new(u, v, 1.0) * depth;
    let corners = [at(-x, -y), at(x, -y), at(x, y), at(-x, y)];
    let mut body = Body::default();
    for k in 0..4 {
        let edge = [Vector3::zeros(), corners[k], corners[(k + 1) % 4]];
        body.line(&edge, colour, FRUSTUM_LINE.0, FRUSTUM_LINE.1);
    }
    body.face(&corners, colour, GLASS);
    // which way is up in the image
    let (left, right, tip) = (at(-0.3 * x, -1.06 * y), at(0.3 * x, -1.06 * y), at(0.0, -1.35 * y));
    body.line(&[left, tip, right], colour, FRUSTUM_LINE.0, FRUSTUM_LINE.1);
    let (w, h) = (0.20 * depth, 0.15 * depth);
    let ring = [(-w, -h), (w, -h), (w, h), (-w, h)].map(|(x, y)| Vector3::new(x, y, 0.0));
    body.prism(&ring, -0.38 * depth, -0.06 * depth, Some(BODY));
    let lens: Vec<_> = circle(0.11 * depth);
    body.prism(&lens, -0.06 * depth, 0.02 * depth, Some(BODY));
    body
}

/// The outer edge of what is printed, once around.
fn edge(target: &TargetModel) -> Option<[Vector3<f64>; 4]> {
    let all = target.corners();
    let first = all.first()?.vector();
    let (low, high) = all
        .iter()
        .map(|p| p.vector())
        .fold((first, first), |(low, high), p| (low.inf(&p), high.sup(&p)));
    let margin = match target {
        TargetModel::Tag { size_mm, .. } => 0.2e-3 * size_mm,
        TargetModel::Aprilgrid { tag_mm, .. } | TargetModel::TagGrid { tag_mm, .. } => {
            0.3e-3 * tag_mm
        }
        _ => target.pitch_m(),
    };
    let at = |x: f64, y: f64| Vector3::new(x, y, 0.0);
    let (low, high) = (low.add_scalar(-margin), high.add_scalar(margin));
    Some([at(low.x, low.y), at(high.x, low.y), at(high.x, high.y), at(low.x, high.y)])
}

fn small_square() -> [Vector3<f64>; 4] {
    let s = UNKNOWN_M;
    [(-s, -s), (s, -s), (s, s), (-s, s)].map(|(x, y)| Vector3::new(x, y, 0.0))
}

/// Great circles of a ball, which has neither an edge nor corners.
fn ball(target: Option<&TargetModel>) -> Option<[Vec<Vector3<f64>>; 3]> {
    let Some(TargetModel::Sphere { diameter_mm }) = target else { return None };
    let radius = diameter_mm.map_or(UNKNOWN_M, |mm| 0.5e-3 * mm);
    let flat = circle(radius);
    let map = |f: fn(&Vector3<f64>) -> Vector3<f64>| flat.iter().map(f).collect();
    let upright = map(|p| Vector3::new(p.x, 0.0, p.y));
    let across = map(|p| Vector3::new(0.0, p.x, p.y));
    Some([flat, upright, across])
}

/// The plate of a target, seen through; a ball as circles.
pub fn plate(target: Option<&TargetModel>, colour: Option<&str>) -> Body {
    let mut body = Body::default();
    let (width, alpha) = BOARD_LINE;
    if let Some(circles) = ball(target) {
        circles.iter().for_each(|c| body.line(&closed(c), colour, width, alpha));
        return body;
    }
    let edge = target.and_then(edge).unwrap_or_else(small_square);
    body.line(&closed(&edge), colour, width, alpha);
    body.face(&edge, colour, GLASS);
    body
}

/// The outline of a target by its outermost corners.
pub fn outline(target: Option<&TargetModel>) -> Body {
    let mut body = Body::default();
    let (width, alpha) = SEEN_LINE;
    if let Some(circles) = ball(target) {
        circles.iter().for_each(|c| body.line(&closed(c), None, width, alpha));
        return body;
    }
    let points = target.map_or_else(
        || small_square().to_vec(),
        |t| t.outline().iter().filter_map(|&id| t.corner(id)).map(|p| p.vector()).collect(),
    );
    body.line(&closed(&points), None, width, alpha);
    body
}

/// What is printed on a target, in squares; empty for balls and unknown targets.
pub fn print(target: Option<&TargetModel>) -> Body {
    let mut body = Body::default();
    let Some((target, edge)) = target.and_then(|t| Some((t, edge(t)?))) else { return body };
    match target {
        TargetModel::Checkerboard { .. } | TargetModel::Charuco { .. } => {
            chequers(&mut body, target);
        }
        _ => {
            body.face(&edge, Some(WHITE), 1.0);
            for (shape, side) in marks(target).iter().flat_map(|m| [(m, 1.0), (m, -1.0)]) {
                // above the plate, on either side of it
                let lifted: Vec<_> = shape
                    .iter()
                    .map(|p| p + Vector3::z() * side * 0.02 * target.pitch_m())
                    .collect();
                body.face(&lifted, Some(BLACK), 1.0);
            }
        }
    }
    body
}

/// The squares around all inner corners.
fn chequers(body: &mut Body, target: &TargetModel) {
    let (columns, rows) = target.grid();
    let (Some(origin), pitch) = (target.corner(0).map(|p| p.vector()), target.pitch_m()) else {
        return;
    };
    if (columns + 1) * (rows + 1) > MOST_SQUARES {
        return;
    }
    let along = |from: Option<u32>, axis: Vector3<f64>| {
        let next = from.and_then(|id| target.corner(id)).map(|p| p.vector() - origin);
        next.filter(|step| step.norm() > 0.0).map_or(axis * pitch, |step| step.normalize() * pitch)
    };
    let (x, y) = (along(target.id_at(1, 0), Vector3::x()), along(target.id_at(0, 1), Vector3::y()));
    let start = target.id_at(0, 0).and_then(|id| target.corner(id)).map_or(origin, |p| p.vector());
    for row in 0..=rows {
        for column in 0..=columns {
            let low = start + x * (f64::from(column) - 1.0) + y * (f64::from(row) - 1.0);
            let colour = if (row + column) % 2 == 0 { BLACK } else { WHITE };
            body.face(&[low, low + x, low + x + y, low + y], Some(colour), 1.0);
        }
    }
}

/// Tags as squares, circles as octagons.
fn marks(target: &TargetModel) -> Vec<Vec<Vector3<f64>>> {
    let corners: Vec<Vector3<f64>> = target.corners().iter().map(|p| p.vector()).collect();
    let has_tags = matches!(
        target,
        TargetModel::Tag { .. } | TargetModel::Aprilgrid { .. } | TargetModel::TagGrid { .. }
    );
    if has_tags {
        return corners.chunks_exact(4).map(<[_]>::to_vec).collect();
    }
    if corners.len() > MOST_SQUARES as usize {
        return vec![];
    }
    let ring: Vec<_> = circle(0.3 * target.pitch_m()).into_iter().step_by(4).collect();
    corners.iter().map(|middle| ring.iter().map(|p| middle + p).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn json(body: &Body) -> String {
        serde_json::to_string(body).unwrap()
    }

    #[test]
    fn a_checkerboard_has_its_squares_and_one_more_than_corners_each_way() {
        let target = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 };
        let print = json(&print(Some(&target)));
        assert_eq!(print.matches(BLACK).count() + print.matches(WHITE).count(), 70);
        assert!(
            print.contains("[-0.03,-0.03,0.0]") && print.contains("[0.27,0.18,0.0]"),
            "{print}"
        );
        let edge = edge(&target).unwrap();
        assert!((edge[2] - Vector3::new(0.27, 0.18, 0.0)).norm() < 1e-12);
    }

    #[test]
    fn tags_and_circles_are_drawn_on_both_sides() {
        let tag = TargetModel::Tag { dictionary: "DICT_6X6_250".into(), id: 0, size_mm: 100.0 };
        assert_eq!(json(&print(Some(&tag))).matches(BLACK).count(), 2);
        let grid = TargetModel::CircleGrid { columns: 4, rows: 3, pitch_mm: 20.0 };
        assert_eq!(json(&print(Some(&grid))).matches(BLACK).count(), 24);
        let ball = TargetModel::Sphere { diameter_mm: Some(40.0) };
        assert!(!json(&print(Some(&ball))).contains("colour"));
        assert!(json(&plate(Some(&ball), None)).contains("0.02"));
    }
}
