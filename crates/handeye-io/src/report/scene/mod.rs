//! The 3D view: layers of lines, clouds and meshes, their data and the page's part that draws them.

mod body;
mod layer;
mod pack;
mod thin;

use std::fmt::Write;

use serde::Serialize;

pub use self::{
    body::{Body, Mark},
    layer::Layer,
    pack::{MOST_OF_ALL, MOST_POINTS, Packed},
    thin::thin,
};
use super::{
    base64::base64,
    colours::{self, hex},
    escape,
};

/// Files that run one after the other for each figure, in one scope.
const VIEW: &str = concat!(
    "document.querySelectorAll(\"figure.scene\").forEach(function (figure) {\n\"use strict\";\n",
    include_str!("shaders.js"),
    include_str!("buffers.js"),
    include_str!("draw.js"),
    include_str!("labels.js"),
    include_str!("select.js"),
    include_str!("move.js"),
    "});\n"
);

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
    /// The captures that bodies and clouds belong to; each can be selected.
    pub captures: Vec<Mark>,
    /// What the colours of captures mean.
    pub residuals: Option<Residuals>,
    /// Radius of the links of a robot's arm, m.
    pub link_m: f64,
}

/// What the colours of captures mean.
#[derive(Clone, Copy)]
pub struct Residuals {
    /// The residual at the end of the scale.
    pub top: f64,
    /// Its unit.
    pub unit: &'static str,
}

/// Numbers that colours tell.
#[derive(Clone, Copy)]
pub struct Values {
    /// What a value of one is, mm.
    pub most_mm: f64,
    /// Where the colours end at first, mm.
    pub top_mm: f64,
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
    #[serde(skip_serializing_if = "<[Mark]>::is_empty")]
    captures: &'a [Mark],
    link_m: f64,
}

impl Scene {
    /// These layers, without states, values and captures.
    pub fn new(axes: Axes, layers: Vec<Layer>) -> Self {
        Self {
            axes,
            layers,
            states: vec![],
            values: None,
            captures: vec![],
            residuals: None,
            link_m: 0.0,
        }
    }

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
            captures: &self.captures,
            link_m: self.link_m,
        };
        let Ok(json) = serde_json::to_string(&data) else { return String::new() };
        format!(
            "<figure class=\"scene\"><div class=\"stage\"><canvas class=\"solid\" tabindex=\"0\" role=\"img\" \
             aria-label=\"{}\"></canvas><canvas class=\"marks\" aria-hidden=\"true\"></canvas>{}{}{}\
             <p class=\"missing\">The 3D view needs a browser with scripts and WebGL 2, which this one does not \
             offer; everything else on this page is complete without it.</p></div>{}{}{}\
             <script type=\"application/json\" class=\"data\">{}</script></figure><script>{VIEW}</script>",
            escape(described),
            self.states(),
            self.buttons(),
            if self.captures.is_empty() { "" } else { CARD },
            self.ramp() + &self.residual_ramp(),
            self.legend(),
            self.help(),
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
            let own = match (self.values, self.captures.as_slice()) {
                (Some(_), _) => "distance",
                (None, []) => "layer",
                (None, _) => "capture",
            };
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

    /// The scale of the residuals of captures.
    fn residual_ramp(&self) -> String {
        let Some(Residuals { top, unit }) = self.residuals else { return String::new() };
        let rejected = if self.captures.iter().all(|k| k.is_used) {
            ""
        } else {
            "<span><i class=\"dash\"></i>rejected capture</span>"
        };
        format!(
            "<div class=\"values residuals\"><span class=\"name\">residual of a capture</span>\
             <span class=\"ramp\"><i style=\"background:{}\"></i><span class=\"ticks\"><span>0</span>\
             <span>{}</span><span>{} {unit}</span></span></span><span>pale: within noise</span>{rejected}</div>",
            residual_gradient(),
            rounded(0.5 * top),
            rounded(top),
        )
    }

    /// One switch for all layers of a name.
    fn legend(&self) -> String {
        let mut entries = String::new();
        for (k, layer) in self.layers.iter().enumerate() {
            let same = |other: &&Layer| other.name == layer.name;
            if self.layers[..k].iter().any(|other| same(&other)) {
                continue;
            }
            let numbers: Vec<String> = (k..self.layers.len())
                .filter(|&n| same(&&self.layers[n]))
                .map(|n| n.to_string())
                .collect();
            let all: Vec<&Layer> = self.layers.iter().filter(same).collect();
            let note = match layer::note(&all) {
                note if note.is_empty() => note,
                note => format!(" <small>{}</small>", escape(&note)),
            };
            let swatch =
                if layer.is_by_residual { residual_gradient() } else { layer.colour.clone() };
            let _ = write!(
                entries,
                "<label><input type=\"checkbox\" data-layer=\"{}\" {}><i style=\"background:{swatch}\"></i>\
                 <span>{}{note}</span></label>",
                numbers.join(" "),
                if layer.is_shown { "checked" } else { "" },
                escape(&layer.name)
            );
        }
        format!("<div class=\"layers\">{entries}</div>")
    }

    /// What can be done by pointer and keys.
    fn help(&self) -> String {
        let (click, arrows) = if self.captures.is_empty() {
            ("", "arrows turn")
        } else {
            (
                "Click on a capture to select it, or on its row or image. ",
                "arrows select the next or the previous capture, Esc none, w a s d turn",
            )
        };
        format!(
            "<p class=\"note keys\">{click}Drag to turn, shift-drag or two fingers to move, wheel or pinch to zoom, \
             double-click to fit, or on a point of a cloud to turn about it. Keys: {arrows}, + and &minus; zoom, \
             1 2 3 views, f fit, p perspective. The small axes show x red, y green, z blue.</p>"
        )
    }
}

/// From no residual to the largest one.
fn residual_gradient() -> String {
    let stops: Vec<String> = colours::residual_scale().into_iter().step_by(9).map(hex).collect();
    format!("linear-gradient(90deg,{})", stops.join(","))
}

/// With two digits that count.
fn rounded(value: f64) -> String {
    if !(value > 0.0) {
        return "0".into();
    }
    let digits = (1.0 - value.log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.digits$}")
}

/// The capture that is selected: its name, its residual, its image, and the ways to its row.
const CARD: &str = "<div class=\"card\" aria-live=\"polite\" hidden><button type=\"button\" class=\"close\" title=\"Select none (Esc)\" \
aria-label=\"Select none\">&times;</button><b></b><span class=\"text\"></span><div class=\"thumb\"></div><div class=\"go\">\
<button type=\"button\" data-step=\"-1\" title=\"Previous capture (left arrow)\" aria-label=\"Previous capture\">&lsaquo;</button>\
<button type=\"button\" data-step=\"1\" title=\"Next capture (right arrow)\" aria-label=\"Next capture\">&rsaquo;</button>\
<button type=\"button\" data-to=\"tr\">Table row</button><button type=\"button\" data-to=\"figure\">Image</button></div></div>";

const VIEWS: &str = "<div class=\"bar\"><button type=\"button\" data-view=\"front\" title=\"From the front (1)\">Front</button>\
<button type=\"button\" data-view=\"top\" title=\"From above (2)\">Top</button>\
<button type=\"button\" data-view=\"side\" title=\"From the right (3)\">Side</button></div>\
<div class=\"bar\"><button type=\"button\" data-view=\"fit\" title=\"All of it (f)\">Fit</button>\
<button type=\"button\" data-view=\"perspective\" aria-pressed=\"true\" title=\"Near things larger (p)\">Perspective</button></div>";

#[cfg(test)]
mod tests {
    use super::*;

    fn cloud() -> Layer {
        Layer::new("a <cloud>", colours::LAYERS[0])
            .with(Packed::cloud(&[[0.0, 0.0, 1.0], [0.1, 0.0, 1.0]], 9))
    }

    fn scene(layers: Vec<Layer>) -> Scene {
        Scene::new(Axes::Camera, layers)
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
