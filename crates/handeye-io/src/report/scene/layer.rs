//! Something of a view that can be switched off.

use nalgebra::{Isometry3, Vector3};
use serde::Serialize;

use super::{
    body::{Body, Line, Place, axes, point},
    grouped,
    pack::{MOST_POINTS, Packed},
};

/// Something that can be switched off; layers of one name are switched together.
#[derive(Serialize)]
pub struct Layer {
    #[serde(skip)]
    pub(super) name: String,
    pub(super) colour: String,
    lines: Vec<Line>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    bodies: Vec<Body>,
    labels: Vec<Label>,
    #[serde(skip_serializing_if = "Option::is_none")]
    shape: Option<Packed>,
    /// Of points that stand for something, px.
    #[serde(skip_serializing_if = "Option::is_none")]
    pixels: Option<f64>,
    /// Where it lies in each state, if not at the origin.
    places: Vec<Place>,
    /// The capture that its cloud is of.
    #[serde(skip_serializing_if = "Option::is_none")]
    capture: Option<usize>,
    pub(super) is_shown: bool,
    /// Whether the view is fitted to other layers only.
    is_ground: bool,
    /// Whether the links of the robot's arm belong to it.
    has_links: bool,
    #[serde(skip)]
    pub(super) is_by_residual: bool,
}

#[derive(Serialize)]
struct Label {
    at: [f64; 3],
    text: String,
    /// Shown with this capture only.
    #[serde(skip_serializing_if = "Option::is_none")]
    capture: Option<usize>,
}

impl Layer {
    /// Without anything in it.
    pub fn new(name: &str, colour: &str) -> Self {
        Self {
            name: name.into(),
            colour: colour.into(),
            lines: vec![],
            bodies: vec![],
            labels: vec![],
            shape: None,
            pixels: None,
            places: vec![],
            capture: None,
            is_shown: true,
            is_ground: false,
            has_links: false,
            is_by_residual: false,
        }
    }

    /// With points or triangles, and how many of them are shown.
    pub fn with(self, shape: Option<Packed>) -> Self {
        Self { shape, ..self }
    }

    /// Lying there, in each state.
    pub fn placed(self, places: &[Isometry3<f64>]) -> Self {
        Self { places: places.iter().map(Place::from).collect(), ..self }
    }

    /// Switched off at first.
    pub fn hidden(self) -> Self {
        Self { is_shown: false, ..self }
    }

    /// Below everything else: the view is not fitted to it.
    pub fn ground(self) -> Self {
        Self { is_ground: true, ..self }
    }

    /// Switches the links of the robot's arm as well.
    pub fn with_links(self) -> Self {
        Self { has_links: true, ..self }
    }

    /// In the colours of the residuals of its captures.
    pub fn by_residual(self) -> Self {
        Self { is_by_residual: true, ..self }
    }

    /// With a cloud of this capture.
    pub fn of_capture(self, capture: usize) -> Self {
        Self { capture: Some(capture), ..self }
    }

    /// Points that stand for something, as discs of so many pixels.
    pub fn dots(&mut self, points: &[[f32; 3]], pixels: f64) {
        (self.shape, self.pixels) = (Packed::cloud(points, MOST_POINTS), Some(pixels));
    }

    /// A line through points, m.
    pub fn line(&mut self, points: &[Vector3<f64>], width: f64, alpha: f64) {
        self.lines.push(Line::new(points, Some(&self.colour), width, alpha));
    }

    /// A rigid body; nothing without copies.
    pub fn body(&mut self, body: Body) {
        if body.is_somewhere() {
            self.bodies.push(body);
        }
    }

    /// Thick axes x red, y green, z blue.
    pub fn axes(&mut self, pose: &Isometry3<f64>, length: f64) {
        self.lines.extend(axes(pose, length, 3.0, 1.0));
    }

    /// A name at a point, shown always or with one capture only.
    pub fn label(&mut self, at: &Vector3<f64>, text: &str, capture: Option<usize>) {
        self.labels.push(Label { at: point(at), text: text.into(), capture });
    }

    /// Named after a file, where there are several of the kind.
    pub fn name_after(&mut self, file: &str) {
        self.name = format!("{}, {file}", self.name);
    }

    /// Nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty() && self.bodies.is_empty() && self.shape.is_none() && !self.has_links
    }

    /// How many points or triangles there are, and how many of them are drawn.
    pub fn count(&self) -> Option<(usize, usize)> {
        self.shape.as_ref().map(|shape| (shape.of, shape.shown()))
    }

    pub(super) fn is_cloud(&self) -> bool {
        self.pixels.is_none() && self.shape.as_ref().is_some_and(|shape| !shape.is_mesh())
    }
}

/// How many points or triangles layers have, and how many of them are shown; empty where they have none or where these
/// only stand for something.
pub(super) fn note(layers: &[&Layer]) -> String {
    let shapes = || layers.iter().filter(|l| l.pixels.is_none()).filter_map(|l| l.shape.as_ref());
    let Some(first) = shapes().next() else { return String::new() };
    let what = if first.is_mesh() { "triangles" } else { "points" };
    let of: usize = shapes().map(|shape| shape.of).sum();
    match shapes().map(Packed::shown).sum() {
        shown if shown == of => format!("{} {what}", grouped(of)),
        shown => format!("{} of {} {what} shown", grouped(shown), grouped(of)),
    }
}
