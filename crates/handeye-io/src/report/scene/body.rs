//! Rigid bodies of lines and faces, and the captures that they belong to.

use nalgebra::{Isometry3, Vector3};
use serde::Serialize;

/// Colours of the axes x, y and z.
const AXES: [&str; 3] = ["#d0433a", "#2e9f55", "#3d74d8"];
/// Points are written in steps of a micrometre.
const STEPS_PER_M: f64 = 1e6;
/// Dashes and gaps along a line, each.
const DASHES: usize = 5;

/// A capture that can be selected.
#[derive(Serialize)]
pub struct Mark {
    /// Its name.
    pub id: String,
    /// By its residual.
    pub colour: String,
    /// Whether the result rests on it.
    pub is_used: bool,
    /// Its residual, or why it was rejected.
    pub text: String,
    /// Where it is pointed at, in the frame of the view (m).
    pub at: [f64; 3],
    /// The robot's arm from the base to the flange; empty where it is not known.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub links: Vec<[f64; 3]>,
}

/// A line through points.
#[derive(Serialize)]
pub struct Line {
    points: Vec<[f64; 3]>,
    /// None: the colour of the capture.
    #[serde(skip_serializing_if = "Option::is_none")]
    colour: Option<String>,
    width: f64,
    alpha: f64,
}

/// A convex polygon.
#[derive(Serialize)]
struct Face {
    points: Vec<[f64; 3]>,
    /// None: the colour of the capture.
    #[serde(skip_serializing_if = "Option::is_none")]
    colour: Option<String>,
    alpha: f64,
}

/// Where something lies.
#[derive(Serialize)]
pub struct Place {
    translation: [f64; 3],
    rotation: [f64; 4],
    #[serde(skip_serializing_if = "Option::is_none")]
    capture: Option<usize>,
}

/// A shape in a frame of its own, drawn at one or more poses.
#[derive(Serialize, Default)]
pub struct Body {
    lines: Vec<Line>,
    faces: Vec<Face>,
    copies: Vec<Place>,
    /// Whether it is drawn only at the capture that is selected.
    is_for_selected: bool,
    /// Whether the view is fitted to other bodies only.
    is_aside: bool,
}

impl Line {
    /// Of this width, px; without a colour, in that of the capture.
    pub fn new(points: &[Vector3<f64>], colour: Option<&str>, width: f64, alpha: f64) -> Self {
        let points = points.iter().map(point).collect();
        Self { points, colour: colour.map(Into::into), width, alpha }
    }
}

impl From<&Isometry3<f64>> for Place {
    fn from(pose: &Isometry3<f64>) -> Self {
        Self {
            translation: pose.translation.vector.into(),
            rotation: pose.rotation.coords.into(),
            capture: None,
        }
    }
}

impl Body {
    /// A line, of this width (px) and opacity.
    pub fn line(&mut self, points: &[Vector3<f64>], colour: Option<&str>, width: f64, alpha: f64) {
        self.lines.push(Line::new(points, colour, width, alpha));
    }

    /// Thin axes.
    pub fn axes(&mut self, length: f64) {
        self.lines.extend(axes(&Isometry3::identity(), length, 1.4, 0.8));
    }

    /// A convex polygon; those with an opacity below one are seen through.
    pub fn face(&mut self, points: &[Vector3<f64>], colour: Option<&str>, alpha: f64) {
        let points = points.iter().map(point).collect();
        self.faces.push(Face { points, colour: colour.map(Into::into), alpha });
    }

    /// An upright prism between two heights.
    pub fn prism(&mut self, ring: &[Vector3<f64>], low: f64, high: f64, colour: Option<&str>) {
        let at = |p: &Vector3<f64>, z: f64| Vector3::new(p.x, p.y, z);
        for z in [low, high] {
            let face: Vec<_> = ring.iter().map(|p| at(p, z)).collect();
            self.face(&face, colour, 1.0);
        }
        for (k, p) in ring.iter().enumerate() {
            let next = &ring[(k + 1) % ring.len()];
            self.face(&[at(p, low), at(next, low), at(next, high), at(p, high)], colour, 1.0);
        }
    }

    /// Drawn there, for a capture or always.
    pub fn copy(&mut self, pose: &Isometry3<f64>, capture: Option<usize>) {
        self.copies.push(Place { capture, ..Place::from(pose) });
    }

    /// Drawn only at the capture that is selected.
    pub fn for_selected(self) -> Self {
        Self { is_for_selected: true, ..self }
    }

    /// With dashed lines and without faces, as rejected captures are drawn.
    pub fn dashed(&self) -> Self {
        let lines = self.lines.iter().flat_map(Line::dashes).collect();
        Self { lines, is_aside: true, ..Self::default() }
    }

    pub(super) fn is_somewhere(&self) -> bool {
        let is_blank = self.lines.is_empty() && self.faces.is_empty();
        !is_blank && !self.copies.is_empty()
    }
}

impl Line {
    fn dashes(&self) -> Vec<Line> {
        let of = |pair: &[[f64; 3]]| {
            let [a, b] = [pair[0], pair[1]].map(Vector3::from);
            let at = move |share: f64| a + (b - a) * share;
            let step = 1.0 / (2 * DASHES - 1) as f64;
            (0..DASHES).map(move |k| {
                let from = 2.0 * k as f64 * step;
                Line::new(&[at(from), at(from + step)], None, self.width, self.alpha)
            })
        };
        self.points.windows(2).flat_map(of).collect()
    }
}

/// Axes x red, y green, z blue.
pub fn axes(
    pose: &Isometry3<f64>,
    length: f64,
    width: f64,
    alpha: f64,
) -> impl Iterator<Item = Line> {
    let (origin, rotation) = (pose.translation.vector, pose.rotation);
    AXES.into_iter().enumerate().map(move |(k, colour)| {
        let tip = origin + rotation * Vector3::ith(k, length);
        Line::new(&[origin, tip], Some(colour), width, alpha)
    })
}

/// To a micrometre, and never minus zero.
pub fn point(p: &Vector3<f64>) -> [f64; 3] {
    let rounded = |x: f64| (x * STEPS_PER_M).round() / STEPS_PER_M + 0.0;
    [rounded(p.x), rounded(p.y), rounded(p.z)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rejected_capture_is_dashed_from_end_to_end() {
        let mut body = Body::default();
        body.line(&[Vector3::zeros(), Vector3::x()], Some("#123456"), 1.0, 1.0);
        body.face(&[Vector3::zeros(), Vector3::x(), Vector3::y()], None, 1.0);
        let dashed = body.dashed();
        assert_eq!((dashed.lines.len(), dashed.faces.len()), (DASHES, 0));
        assert_eq!(dashed.lines[0].points[0], [0.0; 3]);
        assert_eq!(dashed.lines[DASHES - 1].points[1], [1.0, 0.0, 0.0]);
        assert!(dashed.lines.iter().all(|line| line.colour.is_none()));
    }

    #[test]
    fn points_are_written_to_a_micrometre() {
        let text = serde_json::to_string(&point(&Vector3::new(0.123_456_78, -1e-9, 2.0))).unwrap();
        assert_eq!(text, "[0.123457,0.0,2.0]");
    }
}
