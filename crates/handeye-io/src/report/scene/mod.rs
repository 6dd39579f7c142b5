//! The 3D view: layers of lines, clouds and meshes, their data and the page's part that draws them.

mod pack;
mod thin;

use std::fmt::Write;

use nalgebra::{Isometry3, Vector3};
use serde::Serialize;

pub use self::{
    pack::{MOST_OF_ALL, MOST_POINTS, Packed},
    thin::thin,
};
use super::{
    base64::base64,
    colours::{self, hex},
    escape,
};

const VIEW: &str = include_str!("view.js");

/// Which way is up, and what front, top and side are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axes {
    /// Of a robot's base: z is up, x to the right as seen from the front.
    Base,
    /// Of a camera: y is down, and z away from it.
    Camera,
}

impl Axes {
    /// Right, away and up, seen from the front.
    fn basis(self) -> [[f64; 3]; 3] {
        match self {
            Self::Base => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Self::Camera => [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]],
        }
    }

    /// Along what colours may be given, and its name.
    fn rise(self) -> ([f64; 3], &'static str) {
        match self {
            Self::Base => ([0.0, 0.0, 1.0], "height"),
            Self::Camera => ([0.0, 0.0, 1.0], "depth"),
        }
    }

    /// Turn and height of the first look, radians: a base from a side, a camera's view nearly as it was.
    fn look(self) -> [f64; 2] {
        match self {
            Self::Base => [-0.75, 0.45],
            Self::Camera => [0.35, 0.3],
        }
    }
}

/// Everything a view draws.
pub struct Scene {
    /// Which way is up.
    pub axes: Axes,
    /// What is drawn, one over the other.
    pub layers: Vec<Layer>,
    /// Where layers are moved: names of their places, the first one first; none, or two.
    pub states: Vec<&'static str>,
    /// What the values of clouds mean.
    pub values: Option<Values>,
}

/// Numbers that colours tell.
#[derive(Clone, Copy)]
pub struct Values {
    /// What a value of one is, mm.
    pub most_mm: f64,
    /// Where the colours end at first, mm.
    pub top_mm: f64,
}

/// Something that can be switched off.
#[derive(Serialize)]
pub struct Layer {
    #[serde(skip)]
    name: String,
    /// Said beside the name.
    #[serde(skip)]
    note: String,
    colour: String,
    lines: Vec<Line>,
    labels: Vec<Label>,
    #[serde(skip_serializing_if = "Option::is_none")]
    shape: Option<Packed>,
    /// Of points that stand for something, px.
    #[serde(skip_serializing_if = "Option::is_none")]
    pixels: Option<f64>,
    /// Where it lies in each state, if not at the origin.
    places: Vec<Place>,
    is_shown: bool,
}

#[derive(Serialize)]
struct Line {
    points: Vec<[f64; 3]>,
    colour: String,
    width: f64,
    alpha: f64,
}

#[derive(Serialize)]
struct Label {
    at: [f64; 3],
    text: String,
}

#[derive(Serialize)]
struct Place {
    translation: [f64; 3],
    rotation: [f64; 4],
}

/// Colours of the axes x, y and z.
const AXES: [&str; 3] = ["#d0433a", "#2e9f55", "#3d74d8"];

impl Layer {
    /// Without anything in it.
    pub fn new(name: &str, colour: &str) -> Self {
        Self {
            name: name.into(),
            note: String::new(),
            colour: colour.into(),
            lines: vec![],
            labels: vec![],
            shape: None,
            pixels: None,
            places: vec![],
            is_shown: true,
        }
    }

    /// With points or triangles, and how many of them are shown.
    pub fn with(mut self, shape: Option<Packed>) -> Self {
        if let Some(shape) = &shape {
            let what = if shape.is_mesh() { "triangles" } else { "points" };
            let (shown, of) = (grouped(shape.shown()), grouped(shape.of));
            self.note = if shape.shown() == shape.of {
                format!("{of} {what}")
            } else {
                format!("{shown} of {of} {what} shown")
            };
        }
        Self { shape, ..self }
    }

    /// Lying there, in each state.
    pub fn placed(self, places: &[Isometry3<f64>]) -> Self {
        let place = |pose: &Isometry3<f64>| Place {
            translation: pose.translation.vector.into(),
            rotation: pose.rotation.coords.into(),
        };
        Self { places: places.iter().map(place).collect(), ..self }
    }

    /// Points that stand for something, as discs of so many pixels.
    pub fn dots(&mut self, points: &[[f32; 3]], pixels: f64) {
        (self.shape, self.pixels) = (Packed::cloud(points, MOST_POINTS), Some(pixels));
    }

    /// A line through points, m.
    pub fn line(&mut self, points: &[Vector3<f64>], width: f64, alpha: f64) {
        let colour = self.colour.clone();
        self.coloured_line(points, &colour, width, alpha);
    }

    fn coloured_line(&mut self, points: &[Vector3<f64>], colour: &str, width: f64, alpha: f64) {
        let points = points.iter().map(|p| (*p).into()).collect();
        self.lines.push(Line { points, colour: colour.into(), width, alpha });
    }

    /// Axes x red, y green, z blue, with a name at their origin if there is one.
    pub fn axes(&mut self, pose: &Isometry3<f64>, length: f64, name: &str) {
        let origin = pose.translation.vector;
        let (width, alpha) = if name.is_empty() { (1.4, 0.8) } else { (3.0, 1.0) };
        for (k, colour) in AXES.into_iter().enumerate() {
            let tip = origin + pose.rotation * Vector3::ith(k, length);
            self.coloured_line(&[origin, tip], colour, width, alpha);
        }
        if !name.is_empty() {
            self.labels.push(Label { at: origin.into(), text: name.into() });
        }
    }

    /// Named after a file, where there are several of the kind.
    pub fn name_after(&mut self, file: &str) {
        self.name = format!("{}, {file}", self.name);
    }

    /// Nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty() && self.shape.is_none()
    }

    /// How many points or triangles there are, and how many of them are drawn.
    pub fn count(&self) -> Option<(usize, usize)> {
        self.shape.as_ref().map(|shape| (shape.of, shape.shown()))
    }

    fn is_cloud(&self) -> bool {
        self.pixels.is_none() && self.shape.as_ref().is_some_and(|shape| !shape.is_mesh())
    }
}

/// Digits in groups of three.
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// What the script reads.
#[derive(Serialize)]
struct Data<'a> {
    basis: [[f64; 3]; 3],
    look: [f64; 2],
    rise: [f64; 3],
    layers: &'a [Layer],
    states: usize,
    /// Red, green and blue of the scale, from the least on.
    scale: String,
    missing: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    most_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    top_mm: Option<f64>,
}

impl Scene {
    /// The view as a part of a page, with its buttons and its legend.
    pub fn html(&self, described: &str) -> String {
        let data = Data {
            basis: self.axes.basis(),
            look: self.axes.look(),
            rise: self.axes.rise().0,
            layers: &self.layers,
            states: self.states.len(),
            scale: base64(&colours::scale().concat()),
            missing: colours::MISSING,
            most_mm: self.values.map(|v| v.most_mm),
            top_mm: self.values.map(|v| v.top_mm),
        };
        let Ok(json) = serde_json::to_string(&data) else { return String::new() };
        format!(
            "<figure class=\"scene\"><div class=\"stage\"><canvas class=\"solid\" tabindex=\"0\" role=\"img\" \
             aria-label=\"{}\"></canvas><canvas class=\"marks\" aria-hidden=\"true\"></canvas>{}{}\
             <p class=\"missing\">The 3D view needs a browser with scripts and WebGL 2, which this one does not \
             offer; everything else on this page is complete without it.</p></div>{}{}{}\
             <script type=\"application/json\" class=\"data\">{}</script></figure><script>{VIEW}</script>",
            escape(described),
            self.states(),
            self.buttons(),
            self.ramp(),
            self.legend(),
            HELP,
            json.replace("</", "<\\/")
        )
    }

    /// Before and after.
    fn states(&self) -> String {
        if self.states.len() < 2 {
            return String::new();
        }
        let button = |(k, name): (usize, &&str)| {
            let pressed = k + 1 == self.states.len();
            format!(
                "<button type=\"button\" data-state=\"{k}\" aria-pressed=\"{pressed}\">{name}</button>"
            )
        };
        let buttons: String = self.states.iter().enumerate().map(button).collect();
        format!("<div class=\"states bar\">{buttons}</div>")
    }

    fn buttons(&self) -> String {
        let mut bars = VIEWS.to_owned();
        if self.layers.iter().any(Layer::is_cloud) {
            let own = if self.values.is_some() { "distance" } else { "layer" };
            let _ = write!(
                bars,
                "<div class=\"bar\"><button type=\"button\" data-size=\"0.8\" title=\"Smaller points (,)\">&minus;</button>\
                 <span>points</span><button type=\"button\" data-size=\"1.25\" title=\"Larger points (.)\">+</button></div>\
                 <div class=\"bar\"><button type=\"button\" data-paint=\"own\" aria-pressed=\"true\">by {own}</button>\
                 <button type=\"button\" data-paint=\"rise\" aria-pressed=\"false\">by {}</button></div>",
                self.axes.rise().1
            );
        }
        format!("<div class=\"bars\">{bars}</div>")
    }

    /// The scale of the values, and where it ends.
    fn ramp(&self) -> String {
        let Some(values) = self.values else { return String::new() };
        let stops: Vec<String> = colours::scale().into_iter().step_by(7).map(hex).collect();
        format!(
            "<div class=\"values\"><span class=\"name\">distance to the target</span>\
             <span class=\"ramp\"><i style=\"background:linear-gradient(90deg,{})\"></i>\
             <span class=\"ticks\"></span></span>\
             <label>colours end at <input type=\"range\" min=\"0\" max=\"100\" value=\"50\" \
             aria-label=\"where the colours end\"> <output>{:.2} mm</output></label>\
             <span><i class=\"dot\" style=\"background:{}\"></i>no counterpart</span></div>",
            stops.join(","),
            values.top_mm,
            colours::MISSING
        )
    }

    fn legend(&self) -> String {
        let entry = |(k, layer): (usize, &Layer)| {
            let note = match layer.note.as_str() {
                "" => String::new(),
                note => format!(" <small>{}</small>", escape(note)),
            };
            format!(
                "<label><input type=\"checkbox\" data-layer=\"{k}\" {}><i style=\"background:{}\"></i>\
                 <span>{}{note}</span></label>",
                if layer.is_shown { "checked" } else { "" },
                layer.colour,
                escape(&layer.name)
            )
        };
        let entries: String = self.layers.iter().enumerate().map(entry).collect();
        format!("<div class=\"layers\">{entries}</div>")
    }
}

const VIEWS: &str = "<div class=\"bar\"><button type=\"button\" data-view=\"front\" title=\"From the front (1)\">Front</button>\
<button type=\"button\" data-view=\"top\" title=\"From above (2)\">Top</button>\
<button type=\"button\" data-view=\"side\" title=\"From the right (3)\">Side</button></div>\
<div class=\"bar\"><button type=\"button\" data-view=\"fit\" title=\"All of it (f)\">Fit</button>\
<button type=\"button\" data-view=\"perspective\" aria-pressed=\"true\" title=\"Near things larger (p)\">Perspective</button></div>";

const HELP: &str = "<p class=\"note keys\">Drag to turn, shift-drag or two fingers to move, wheel or pinch to zoom, double-click on a \
point to turn about it. Keys: arrows, + and &minus;, 1 2 3, f, p. The small axes show x red, y green, z blue.</p>";

#[cfg(test)]
mod tests {
    use super::*;

    fn cloud() -> Layer {
        Layer::new("a <cloud>", colours::LAYERS[0])
            .with(Packed::cloud(&[[0.0, 0.0, 1.0], [0.1, 0.0, 1.0]], 9))
    }

    fn scene(layers: Vec<Layer>) -> Scene {
        Scene { axes: Axes::Camera, layers, states: vec![], values: None }
    }

    #[test]
    fn a_view_names_its_layers_and_loads_nothing() {
        let html = scene(vec![cloud()]).html("two points");
        assert!(html.contains("a &lt;cloud&gt; <small>2 points</small>"));
        assert!(!html.contains("http"), "a page loads nothing");
    }

    #[test]
    fn states_are_buttons_and_the_last_is_pressed() {
        let mut scene = scene(vec![cloud()]);
        assert!(!scene.html("").contains("data-state="));
        scene.states = vec!["before", "after"];
        assert!(scene.html("").contains("data-state=\"1\" aria-pressed=\"true\">after"));
    }

    #[test]
    fn digits_stand_in_groups_of_three() {
        let plain = |n| grouped(n).replace('\u{202f}', " ");
        assert_eq!([0, 999, 1000, 1234567].map(plain), ["0", "999", "1 000", "1 234 567"]);
    }
}
