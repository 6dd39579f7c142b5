//! Boards by the markers that are read in images: which dictionary, how many squares or tags, and how wide.
//!
//! Seen from a marker, along its own axes and in sides of it, its neighbours lie at whole steps: diagonally on a
//! ChArUco board, straight on a grid of tags. Every number of columns gives each marker a place; the right one explains
//! these steps.

use std::{
    cmp::Reverse,
    collections::{BTreeMap, BTreeSet},
};

use nalgebra::{Matrix3, Vector2};

use crate::{
    GrayImage, TargetModel,
    detect::{
        homography,
        markers::bilinear,
        tag::{Levels, Print, SeenTag, without_copies},
    },
    math::linalg::median,
    model::{print::marker_of_square, target::AprilTagFamily},
};

/// Dictionaries that boards are printed with; of OpenCV's four sizes the largest, of which the others are the beginning.
const DICTIONARIES: [&str; 5] =
    ["DICT_4X4_1000", "DICT_5X5_1000", "DICT_6X6_1000", "DICT_7X7_1000", "DICT_ARUCO_ORIGINAL"];
/// AprilTags.
const FAMILIES: [AprilTagFamily; 4] = [
    AprilTagFamily::Tag36h11,
    AprilTagFamily::Tag25h9,
    AprilTagFamily::Tag16h5,
    AprilTagFamily::Tag36h10,
];
/// Markers of the dictionaries of one size.
const SIZES: [u32; 3] = [50, 100, 250];
/// Neighbours are no farther away than this, in sides of a marker: across a square of a ChArUco board with small markers.
const NEIGHBOUR: f64 = 3.2;
/// Of a neighbour's coordinates the smaller one, over the larger one, from which on it lies diagonally.
const DIAGONAL: f64 = 0.5;
/// Steps that are looked at, at most.
const FAR: f64 = 2.3;
/// How far from whole steps markers may lie.
const WHOLE: f64 = 0.3;
/// Fewer markers do not tell a board.
const FEWEST_MARKERS: usize = 3;
/// Share of the steps that a board must explain.
const LEAST_EXPLAINED: f64 = 0.7;
/// Where a tag's border is black, from its side, in sides of it.
const BORDER: f64 = 0.05;
/// Most columns.
const MOST_COLUMNS: u32 = 64;

/// How the markers of a board are numbered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Numbering {
    /// In the white squares of a checkerboard, row by row; whether the first square is white.
    Squares { white_first: bool },
    /// Row by row from the top left.
    FromTop,
    /// Row by row from the bottom left, the markers standing on their heads.
    FromBottom,
}

/// A dictionary, and what tells its prints apart.
struct Dictionary {
    name: &'static str,
    family: Option<AprilTagFamily>,
    border_bits: u32,
}

/// What the markers of one dictionary show in all images.
struct Shown<'a> {
    /// Of each image.
    tags: &'a [Vec<SeenTag>],
    is_diagonal: bool,
    /// From marker to marker, in sides of a marker.
    step: f64,
}

/// From a marker to another one, in whole steps along the axes of the first.
#[derive(Clone, Copy)]
struct Step {
    from: u32,
    to: u32,
    by: (i32, i32),
}

/// The markers of one dictionary that are read in each image.
pub(super) struct Markers {
    dictionary: Dictionary,
    tags: Vec<Vec<SeenTag>>,
}

/// Boards that the markers in the images may belong to, at most one for each dictionary.
pub(super) fn boards(markers: &[Markers], images: &[&GrayImage]) -> Vec<TargetModel> {
    markers.iter().filter_map(|markers| board(markers, images)).collect()
}

/// Tags that stand alone in the images: those that enough of them show.
pub(super) fn single_tags(markers: &[Markers], least_images: f64) -> Vec<TargetModel> {
    let mut all = vec![];
    for Markers { dictionary, tags } in markers.iter().filter(|m| m.dictionary.border_bits == 1) {
        let mut images: BTreeMap<u32, usize> = BTreeMap::new();
        for seen in tags {
            let ids: BTreeSet<u32> = seen.iter().map(|tag| tag.id).collect();
            ids.into_iter().for_each(|id| *images.entry(id).or_default() += 1);
        }
        let shown = images.into_iter().filter(|(_, count)| *count as f64 >= least_images);
        all.extend(shown.map(|(id, _)| {
            let dictionary = named(dictionary.name, id);
            TargetModel::Tag { dictionary, id, size_mm: 1.0 }
        }));
    }
    all
}

/// The markers of every dictionary that are read without a wrong bit.
pub(super) fn read_all(images: &[&GrayImage]) -> Vec<Markers> {
    let plain = DICTIONARIES.map(|name| (name, None, 1)).into_iter();
    let tags = FAMILIES.into_iter().flat_map(|family| {
        [1, 2].map(|border_bits| (family.dictionary(), Some(family), border_bits))
    });
    let ways: Vec<_> = plain.chain(tags).collect();
    let print = |is_touching: bool| {
        let of = move |&(name, _, border): &(&'static str, _, u32)| {
            Print::new(name, border as usize, None, is_touching).ok()
        };
        ways.iter().filter_map(of).collect::<Vec<Print>>()
    };
    let (apart, touching) = (print(false), print(true));
    let mut all: Vec<Vec<Vec<SeenTag>>> = ways.iter().map(|_| vec![]).collect();
    for image in images {
        let levels = Levels::new(image);
        let read = levels.read_each(&apart).into_iter().zip(levels.read_each(&touching));
        for (all, (apart, touching)) in all.iter_mut().zip(read) {
            all.push(without_copies(&[apart, touching].concat()));
        }
    }
    let of = |((name, family, border_bits), tags)| Markers {
        dictionary: Dictionary { name, family, border_bits },
        tags,
    };
    ways.iter().copied().zip(all).map(of).collect()
}

/// The board that the markers of a dictionary belong to.
fn board(markers: &Markers, images: &[&GrayImage]) -> Option<TargetModel> {
    let Markers { dictionary, tags } = markers;
    let shown = Shown::of(tags)?;
    let steps = shown.steps();
    let ids: BTreeSet<u32> = steps.iter().map(|step| step.from).collect();
    if ids.len() < FEWEST_MARKERS {
        return None;
    }
    let numberings: &[Numbering] = match (shown.is_diagonal, dictionary.family) {
        (true, _) => {
            &[Numbering::Squares { white_first: false }, Numbering::Squares { white_first: true }]
        }
        (false, Some(_)) => &[Numbering::FromBottom, Numbering::FromTop],
        (false, None) => &[Numbering::FromTop],
    };
    let (least, most) = (*ids.first()?, *ids.last()?);
    let firsts = &BTreeSet::from([0, least]);
    let ways = numberings.iter().flat_map(|numbering| {
        let columns = 1..=MOST_COLUMNS;
        columns
            .flat_map(move |columns| firsts.iter().map(move |first| (*numbering, columns, *first)))
    });
    let placings = ways.filter_map(|(numbering, columns, first)| {
        let placed = Placed::new(numbering, columns, first, most)?;
        let explained = steps.iter().filter(|step| placed.explains(step)).count();
        // of equals the one without empty rows above
        Some(((explained, Reverse(placed.row(least))), placed))
    });
    let best = placings.reduce(|best, next| if next.0 > best.0 { next } else { best });
    let ((explained, _), placed) = best?;
    if (explained as f64) < LEAST_EXPLAINED * steps.len() as f64 {
        return None;
    }
    let right = steps.iter().filter(|step| placed.explains(step));
    let last = right.flat_map(|step| [step.from, step.to]).max()?;
    let mut target = placed.target(dictionary, shown.step, last);
    if let TargetModel::Aprilgrid { corner_squares, .. } = &mut target {
        *corner_squares = shown.has_corner_squares(images);
    }
    Some(target)
}

impl<'a> Shown<'a> {
    fn of(tags: &'a [Vec<SeenTag>]) -> Option<Self> {
        let nearest: Vec<Vector2<f64>> = tags.iter().flat_map(|tags| neighbours(tags)).collect();
        let diagonal = |v: &Vector2<f64>| v.abs().min() > DIAGONAL * v.abs().max();
        let is_diagonal = 2 * nearest.iter().filter(|v| diagonal(v)).count() > nearest.len();
        let alike = nearest.iter().filter(|v| diagonal(v) == is_diagonal);
        let root = if is_diagonal { 2.0_f64.sqrt() } else { 1.0 };
        let lengths: Vec<f64> = alike.map(|v| v.norm() / root).collect();
        (!lengths.is_empty()).then(|| Self { step: median(lengths), tags, is_diagonal })
    }

    /// Whether the gaps of a grid of tags cross in black squares, as most tags say.
    fn has_corner_squares(&self, images: &[&GrayImage]) -> bool {
        let tags = images
            .iter()
            .zip(self.tags)
            .flat_map(|(image, tags)| tags.iter().map(move |tag| (image, tag)));
        let said = tags.filter_map(|(image, tag)| has_corner_square(image, tag, self.step - 1.0));
        let (yes, no): (Vec<bool>, Vec<bool>) = said.partition(|is_black| *is_black);
        yes.len() > no.len()
    }

    /// Whole steps between markers that are near one another.
    fn steps(&self) -> Vec<Step> {
        let mut all = vec![];
        for tags in self.tags {
            for (a, b) in pairs(tags) {
                let Some(by) = offset(a, b).map(|v| v / self.step) else { continue };
                let whole = by.map(f64::round);
                if whole.norm() > 0.0 && by.norm() < FAR && (by - whole).amax() < WHOLE {
                    all.push(Step { from: a.id, to: b.id, by: (whole.x as i32, whole.y as i32) });
                }
            }
        }
        all
    }
}

/// Whether the gaps beside a marker cross in a black square, rather than in the white of the gaps.
fn has_corner_square(image: &GrayImage, tag: &SeenTag, gap: f64) -> Option<bool> {
    let at = |x: f64, y: f64| {
        let h = homography::from_unit_square(&tag.quad);
        bilinear(image, &homography::apply(&h, &Vector2::new(x, y)))
    };
    let out = 1.0 + 0.5 * gap;
    let (black, white) = (at(0.5, BORDER)?, at(0.5, out)?);
    Some(at(out, out)? < 0.5 * (black + white))
}

/// From each marker to the one that is nearest.
fn neighbours(tags: &[SeenTag]) -> Vec<Vector2<f64>> {
    let nearest = |a: &SeenTag| {
        let others = tags.iter().filter(|b| b.id != a.id).filter_map(|b| offset(a, b));
        others.filter(|v| v.norm() < NEIGHBOUR).min_by(|a, b| a.norm().total_cmp(&b.norm()))
    };
    tags.iter().filter_map(nearest).collect()
}

fn pairs(tags: &[SeenTag]) -> impl Iterator<Item = (&SeenTag, &SeenTag)> {
    tags.iter().flat_map(move |a| tags.iter().filter(|b| b.id != a.id).map(move |b| (a, b)))
}

/// From the middle of one marker to that of another, along the axes of the first and in sides of it.
fn offset(from: &SeenTag, to: &SeenTag) -> Option<Vector2<f64>> {
    let middle = Vector2::new(0.5, 0.5);
    let pixel = homography::apply(&homography::from_unit_square(&to.quad), &middle);
    let back: Matrix3<f64> = homography::from_unit_square(&from.quad).try_inverse()?;
    let at = homography::apply(&back, &pixel) - middle;
    at.iter().all(|x| x.is_finite()).then_some(at)
}

/// The places of markers on a board with so many columns.
struct Placed {
    numbering: Numbering,
    columns: u32,
    first: u32,
    /// By marker; along the marker's own axes.
    places: BTreeMap<u32, (i32, i32)>,
}

impl Placed {
    /// `None` where such a board has no marker.
    fn new(numbering: Numbering, columns: u32, first: u32, most: u32) -> Option<Self> {
        let count = (most + 1).checked_sub(first)?;
        let (n, wide) = (columns as i32, columns as usize);
        let places = match numbering {
            Numbering::Squares { white_first } => {
                // a column alone has a marker in every second row
                let squares =
                    (0..2 * count as usize + 2).flat_map(|j| (0..wide).map(move |i| (i, j)));
                let marked = squares.filter_map(|(i, j)| {
                    Some((marker_of_square(i, j, wide, white_first)?, (i as i32, j as i32)))
                });
                marked.take(count as usize).collect::<Vec<_>>()
            }
            Numbering::FromTop => (0..count).map(|k| (k, (k as i32 % n, k as i32 / n))).collect(),
            Numbering::FromBottom => {
                (0..count).map(|k| (k, (-(k as i32 % n), k as i32 / n))).collect()
            }
        };
        let places = places.into_iter().map(|(k, place)| (first + k, place)).collect();
        Some(Self { numbering, columns, first, places })
    }

    fn explains(&self, step: &Step) -> bool {
        let (from, to) = (self.places.get(&step.from), self.places.get(&step.to));
        from.zip(to).is_some_and(|(a, b)| (b.0 - a.0, b.1 - a.1) == step.by)
    }

    fn row(&self, id: u32) -> u32 {
        self.places.get(&id).map_or(0, |place| place.1 as u32)
    }

    /// The board whose last marker is `last`, with so many sides of a marker from one to the next.
    fn target(&self, dictionary: &Dictionary, step: f64, last: u32) -> TargetModel {
        let (columns, rows, first_id) = (self.columns, self.row(last) + 1, self.first);
        let gap = (step - 1.0).max(0.01);
        match (self.numbering, dictionary.family) {
            (Numbering::Squares { white_first }, _) => TargetModel::Charuco {
                squares_x: columns,
                // the first square is white only where the rows are even in number
                squares_y: if white_first { rows.next_multiple_of(2) } else { rows },
                square_mm: 1.0,
                marker_mm: 1.0 / step,
                dictionary: named(dictionary.name, last),
                legacy: white_first,
                first_id,
            },
            (Numbering::FromBottom, Some(family)) => TargetModel::Aprilgrid {
                tags_x: columns,
                tags_y: rows,
                tag_mm: 1.0,
                spacing: gap,
                family,
                first_id,
                corner_squares: true,
                border_bits: dictionary.border_bits,
            },
            (Numbering::FromTop | Numbering::FromBottom, _) => TargetModel::TagGrid {
                dictionary: named(dictionary.name, last),
                tags_x: columns,
                tags_y: rows,
                tag_mm: 1.0,
                gap_mm: gap,
                first_id,
            },
        }
    }
}

/// The smallest dictionary of a size that has a marker.
fn named(largest: &str, id: u32) -> String {
    let smaller = largest.strip_suffix("_1000").and_then(|front| {
        SIZES.iter().find(|count| id < **count).map(|count| format!("{front}_{count}"))
    });
    smaller.unwrap_or_else(|| largest.into())
}
