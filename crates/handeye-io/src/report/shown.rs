//! The page of `handeye view`: clouds, meshes and calibrations, each a layer.

use handeye::{Calibration, Warning};
use nalgebra::Isometry3;

use super::{
    CellData, cell, colours, escape, page,
    scene::{Axes, Layer, MOST_OF_ALL, MOST_POINTS, Packed, Scene, grouped},
    section, warnings,
};

/// Something to look at.
pub enum Thing<'a> {
    /// Points, m, in any order.
    Cloud {
        /// Such as that of its file.
        name: String,
        /// Also those that were not seen.
        points: &'a [[f32; 3]],
        /// Where its frame lies.
        place: Isometry3<f64>,
    },
    /// Triangles between vertices, m.
    Mesh {
        /// Such as that of its file.
        name: String,
        /// Corners of triangles.
        vertices: &'a [[f32; 3]],
        /// Numbers of vertices.
        triangles: &'a [[u32; 3]],
        /// Where its frame lies.
        place: Isometry3<f64>,
    },
    /// Base, flange poses, camera and targets, in the frame of the base.
    Calibration {
        /// Such as that of its file.
        name: String,
        /// With an answer.
        calibration: &'a Calibration,
        /// What its dataset adds, if that is known.
        data: CellData,
    },
}

/// What the page shows.
pub struct Shown<'a> {
    /// Of the page.
    pub title: String,
    /// One over the other.
    pub things: Vec<Thing<'a>>,
    /// Whether it is seen in the frame of a robot's base, or else of a camera.
    pub is_in_base: bool,
    /// How things were placed, a sentence each.
    pub notes: &'a [String],
    /// What to know.
    pub warnings: &'a [Warning],
}

/// How much there is of a thing, and how much of it is drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ThingCount {
    /// Its name.
    pub name: String,
    /// Points or triangles.
    pub what: &'static str,
    /// So many there are.
    pub of: usize,
    /// That are drawn.
    pub shown: usize,
}

/// The whole page, and how much of clouds and meshes is drawn.
pub fn shown_html(shown: &Shown) -> (String, Vec<ThingCount>) {
    let mut scene = Scene::new(if shown.is_in_base { Axes::Base } else { Axes::Camera }, vec![]);
    let mut counts = vec![];
    let several =
        shown.things.iter().filter(|t| matches!(t, Thing::Calibration { .. })).count() > 1;
    let clouds = shown.things.iter().filter(|t| matches!(t, Thing::Cloud { .. })).count();
    let most = MOST_POINTS.min(MOST_OF_ALL / clouds.max(1));
    for (k, thing) in shown.things.iter().enumerate() {
        let colour = colours::LAYERS[k % colours::LAYERS.len()];
        let made = thing.layers(colour, several, most, &mut scene);
        let count = |layer: &Layer| {
            layer.count().map(|(of, shown)| ThingCount {
                name: thing.name().into(),
                what: thing.parts(),
                of,
                shown,
            })
        };
        if !matches!(thing, Thing::Calibration { .. }) {
            counts.extend(made.iter().filter_map(count));
        }
        scene.layers.extend(made);
    }
    if several {
        // each has a scale of its own
        scene.residuals = None;
    }
    let notes: String = shown
        .notes
        .iter()
        .map(|note| format!("<p>{}.</p>", super::capital(&escape(note))))
        .collect();
    let body = section(&heading(shown), "", &(scene.html("the files that were given") + &notes))
        + &warnings(shown.warnings);
    (page(("View", &shown.title), &body, "Lengths in mm."), counts)
}

fn heading(shown: &Shown) -> String {
    match shown.things.as_slice() {
        [one] => one.name().into(),
        several => format!("{} files", grouped(several.len())),
    }
}

impl Thing<'_> {
    fn name(&self) -> &str {
        match self {
            Self::Cloud { name, .. } | Self::Mesh { name, .. } | Self::Calibration { name, .. } => {
                name
            }
        }
    }

    fn parts(&self) -> &'static str {
        if matches!(self, Self::Mesh { .. }) { "triangles" } else { "points" }
    }

    /// Its layers; the captures of a calibration go into the scene.
    fn layers(&self, colour: &str, is_named: bool, most: usize, scene: &mut Scene) -> Vec<Layer> {
        match self {
            Self::Cloud { name, points, place } => {
                vec![Layer::new(name, colour).with(Packed::cloud(points, most)).placed(&[*place])]
            }
            Self::Mesh { name, vertices, triangles, place } => {
                let mesh = Packed::mesh(vertices, triangles);
                vec![Layer::new(name, colour).with(mesh).placed(&[*place])]
            }
            Self::Calibration { name, calibration, data } => {
                let first = scene.captures.len();
                let Some(cell) = cell::cell(calibration, data, first) else { return vec![] };
                scene.captures.extend(cell.captures);
                (scene.residuals, scene.link_m) = (cell.residuals, cell.link_m);
                let mut layers = cell.layers;
                if is_named {
                    layers.iter_mut().for_each(|layer| layer.name_after(name));
                }
                layers
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_has_a_layer_for_each_thing_and_says_what_is_left_out() {
        let points: Vec<[f32; 3]> =
            (0..400_000).map(|k| [(k % 800) as f32 * 1e-3, (k / 800) as f32 * 1e-3, 1.0]).collect();
        let place = Isometry3::identity();
        let things = vec![
            Thing::Cloud { name: "plate.ply".into(), points: &points, place },
            Thing::Mesh {
                name: "corner.stl".into(),
                vertices: &[[0.0, 0.0, 0.9], [0.1, 0.0, 0.9], [0.0, 0.1, 0.8]],
                triangles: &[[0, 1, 2]],
                place,
            },
        ];
        let notes = ["each lies in its own frame".to_owned()];
        let shown =
            Shown { title: "two".into(), things, is_in_base: false, notes: &notes, warnings: &[] };
        let (page, counts) = shown_html(&shown);
        assert!(page.contains("plate.ply") && page.contains("1 triangles"));
        assert!(page.contains("Each lies in its own frame."));
        assert_eq!((counts[0].of, counts[1].shown), (400_000, 1));
        assert!(counts[0].shown <= 150_000 && counts[0].shown > 100_000, "{counts:?}");
        assert!(page.len() < 5_000_000, "{}", page.len());
    }
}
