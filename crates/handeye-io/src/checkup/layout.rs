//! Whether the images show another layout of the target than the declared one: squares counted for inner corners, sides
//! exchanged, another dictionary, tags numbered otherwise.
//!
//! Where corners were found elsewhere, a pose of the target must explain most of the lists; one of another size, or with
//! columns and rows exchanged, is tried where none does.
//!
//! Where the target is not found, or only small parts of it, a few images are searched for the targets that people
//! mean when they declare this one. A layout counts when most of these images show it, with clearly more corners than
//! the declared one. Where the captures contradict one another and nothing else explains it, more corners are enough:
//! of a board with markers a wrong layout may find a part that looks right.

use handeye::{
    GrayImage, ImageCorner, Intrinsics, TargetModel,
    detect::{self, NotFound, PosedTarget, target_poses},
};
use nalgebra::Vector2;

use super::{Change, Explanation};
use crate::{Dataset, measure::Measured};

/// Images that are searched.
const MOST_IMAGES: usize = 3;
/// Share of the images that must show another layout.
const MOST_SHOW: f64 = 0.6;
/// Share of the captures without the target from which on its layout is in doubt.
const MANY_MISSING: f64 = 0.5;
/// Median share of the target's corners below which its layout is in doubt: markers that happen to lie right.
const FEW_CORNERS: f64 = 0.5;
/// Another layout shows so many times as many corners as the declared one ...
const CLEARLY_MORE: f64 = 1.5;
/// ... or so many times, where the captures contradict the declared one.
const MORE: f64 = 1.01;
/// Share of its own corners that another layout must show.
const LEAST_SHARE: f64 = 0.5;
/// Lists of corners that are tried.
const MOST_LISTS: usize = 6;
/// A list with fewer corners fits too many layouts.
const FEWEST_LISTED: usize = 8;
/// A layout explains a list of corners to this share of their spread in the image ...
const MOST_RESIDUAL: f64 = 0.02;
/// ... all of them but this share.
const MOST_OUTLIERS: f64 = 0.1;
/// Dictionaries that boards are printed with.
const DICTIONARIES: [&str; 6] = [
    "DICT_4X4_1000",
    "DICT_5X5_1000",
    "DICT_6X6_1000",
    "DICT_7X7_1000",
    "DICT_ARUCO_ORIGINAL",
    "DICT_APRILTAG_36h11",
];

/// Another target, and what is wrong with the declared one.
struct Layout {
    target: TargetModel,
    /// What the images show, and what is declared.
    words: String,
    changes: Vec<Change>,
}

impl Layout {
    fn new(target: TargetModel, words: String, changes: &[(&str, String)]) -> Self {
        let change = |(key, value): &(&str, String)| Change {
            table: "target",
            key: (*key).to_owned(),
            value: value.clone(),
        };
        Self { target, words, changes: changes.iter().map(change).collect() }
    }
}

/// The layout that the images show in place of the declared one, where that is hardly found.
pub(super) fn layout_of_missing(dataset: &Dataset, measured: &Measured) -> Option<Explanation> {
    let declared = dataset.target.as_ref()?;
    layout_of_lists(dataset, measured, declared).or_else(|| {
        in_doubt(dataset, measured, declared).then(|| other_layout(dataset, CLEARLY_MORE))?
    })
}

/// The layout that lists of corners have in place of the declared one, where no images tell it.
fn layout_of_lists(
    dataset: &Dataset,
    measured: &Measured,
    declared: &TargetModel,
) -> Option<Explanation> {
    let camera = measured.session.camera.as_ref()?;
    let with_list = dataset.captures.iter().zip(&measured.session.observations);
    let lists: Vec<&[ImageCorner]> = with_list
        .filter(|(capture, o)| capture.corners.is_some() && o.corners.len() >= FEWEST_LISTED)
        .map(|(_, o)| &o.corners[..])
        .collect();
    let lists: Vec<_> = lists.iter().step_by(lists.len().div_ceil(MOST_LISTS).max(1)).collect();
    let fitting =
        |target: &TargetModel| lists.iter().filter(|list| fits(list, target, camera)).count();
    let own = fitting(declared);
    if lists.is_empty() || is_most(own, lists.len()) {
        return None;
    }
    let (count, layout) = alternatives(declared)
        .into_iter()
        .map(|layout| (fitting(&layout.target), layout))
        .reduce(|best, next| if next.0 > best.0 { next } else { best })?;
    let words = format!(
        "{} ({count} of {} lists of corners fit so, as declared {own})",
        layout.words,
        lists.len()
    );
    is_most(count, lists.len()).then(|| explanation(&layout, words))
}

fn is_most(count: usize, of: usize) -> bool {
    count as f64 >= MOST_SHOW * of as f64
}

/// Whether a pose of the target explains a list of its corners.
fn fits(list: &[ImageCorner], target: &TargetModel, camera: &Intrinsics) -> bool {
    let centre = list.iter().map(|c| c.pixel).sum::<Vector2<f64>>() / list.len() as f64;
    let spread = list.iter().map(|c| (c.pixel - centre).norm_squared()).sum::<f64>();
    let spread = (spread / list.len() as f64).sqrt();
    let is_fit = |posed: &PosedTarget| {
        posed.rms_px < MOST_RESIDUAL * spread
            && (posed.left_out.len() as f64) < MOST_OUTLIERS * list.len() as f64
    };
    let known = list.iter().all(|corner| target.corner(corner.id).is_some());
    known
        && target_poses(list, &[], target, camera).is_ok_and(|all| all.first().is_some_and(is_fit))
}

/// The layout that the images show in place of the declared one, where the captures contradict one another.
pub(super) fn layout_of_contradicting(dataset: &Dataset) -> Option<Explanation> {
    other_layout(dataset, MORE)
}

fn other_layout(dataset: &Dataset, more: f64) -> Option<Explanation> {
    let declared = dataset.target.as_ref().filter(|t| !t.is_empty())?;
    let images = images(dataset);
    if images.is_empty() {
        return None;
    }
    let own: Vec<usize> = images.iter().map(|image| corners(dataset, image, declared)).collect();
    let mut all = alternatives(declared);
    all.extend(other_size(dataset, &images, declared));
    let best = all
        .iter()
        .filter_map(|layout| Some((shown(dataset, layout, &images, &own, more)?, layout)))
        .reduce(|best, next| if next.0.1 > best.0.1 { next } else { best })?;
    let as_declared = own.iter().filter(|n| **n > 0).count();
    let words = format!(
        "{} (found so in {} of {} images, as declared in {as_declared})",
        best.1.words,
        best.0.0,
        own.len()
    );
    Some(explanation(best.1, words))
}

fn explanation(layout: &Layout, message: String) -> Explanation {
    let by_hand = layout.changes.is_empty().then(|| "write [target] anew".to_owned());
    Explanation { by_hand, ..Explanation::new("target-layout", message, layout.changes.clone()) }
}

/// Whether most captures do not show the declared target, or only a small part of it.
fn in_doubt(dataset: &Dataset, measured: &Measured, declared: &TargetModel) -> bool {
    let found: Vec<usize> = measured
        .session
        .observations
        .iter()
        .zip(&dataset.captures)
        .filter(|(_, c)| c.image.is_some())
        .map(|(o, _)| o.corners.len())
        .collect();
    let missing = found.iter().filter(|n| **n == 0).count();
    let few = |n: &&usize| (**n as f64) < FEW_CORNERS * declared.len() as f64;
    let with_few = found.iter().filter(few).count();
    !found.is_empty()
        && (missing as f64 > MANY_MISSING * found.len() as f64 || 2 * with_few > found.len())
}

/// A few images, from all over the session.
fn images(dataset: &Dataset) -> Vec<GrayImage> {
    let paths: Vec<_> = dataset.captures.iter().filter_map(|c| c.image.as_ref()).collect();
    let step = paths.len().div_ceil(MOST_IMAGES).max(1);
    paths.iter().step_by(step).filter_map(|path| dataset.image(path).ok()).collect()
}

fn corners(dataset: &Dataset, image: &GrayImage, target: &TargetModel) -> usize {
    detect::detect_with(image, target, dataset.intrinsics.as_ref()).map_or(0, |c| c.len())
}

/// In how many images a layout is seen, and with how many corners, where that is clearly more than as declared.
fn shown(
    dataset: &Dataset,
    layout: &Layout,
    images: &[GrayImage],
    own: &[usize],
    more: f64,
) -> Option<(usize, usize)> {
    let least = LEAST_SHARE * layout.target.len() as f64;
    let (mut count, mut sum, mut open) = (0, 0, images.len());
    for (image, own) in images.iter().zip(own) {
        let found = corners(dataset, image, &layout.target);
        open -= 1;
        if found as f64 >= least.max(more * *own as f64) {
            (count, sum) = (count + 1, sum + found);
        }
        if ((count + open) as f64) < MOST_SHOW * images.len() as f64 {
            return None;
        }
    }
    Some((count, sum))
}

/// What people mean when they declare such a target.
fn alternatives(declared: &TargetModel) -> Vec<Layout> {
    match declared {
        TargetModel::Checkerboard { columns, rows, .. } => sizes(declared, *columns, *rows),
        TargetModel::CircleGrid { columns, rows, pitch_mm } => {
            let (columns, rows, pitch_mm) = (*columns, *rows, *pitch_mm);
            let other = TargetModel::AsymmetricCircleGrid { columns, rows, pitch_mm };
            let mut all = sizes(declared, columns, rows);
            all.push(other_circles(other, "asymmetric-circle-grid"));
            all
        }
        TargetModel::AsymmetricCircleGrid { columns, rows, pitch_mm } => {
            let (columns, rows, pitch_mm) = (*columns, *rows, *pitch_mm);
            let mut all = sizes(declared, columns, rows);
            let other = TargetModel::CircleGrid { columns, rows, pitch_mm };
            all.push(other_circles(other, "circle-grid"));
            all
        }
        TargetModel::Charuco { .. } => charuco(declared),
        TargetModel::Aprilgrid { .. } => aprilgrid(declared),
        _ => vec![],
    }
}

/// The same kind of grid with other numbers of columns and rows.
fn of_size(declared: &TargetModel, columns: u32, rows: u32) -> TargetModel {
    let mut target = declared.clone();
    match &mut target {
        TargetModel::Checkerboard { columns: c, rows: r, .. }
        | TargetModel::CircleGrid { columns: c, rows: r, .. }
        | TargetModel::AsymmetricCircleGrid { columns: c, rows: r, .. }
        | TargetModel::ModifiedCircleGrid { columns: c, rows: r, .. } => (*c, *r) = (columns, rows),
        _ => {}
    }
    target
}

fn resized(declared: &TargetModel, columns: u32, rows: u32) -> Layout {
    let (own_columns, own_rows) = declared.grid();
    let is_board = matches!(declared, TargetModel::Checkerboard { .. });
    let what = if is_board { "inner corners" } else { "circles" };
    let squares = (columns + 1, rows + 1) == (own_columns, own_rows)
        || (rows + 1, columns + 1) == (own_columns, own_rows);
    let advice = if squares && is_board { ": count inner corners, not squares" } else { "" };
    let words = format!(
        "the images show {columns} x {rows} {what}, not {own_columns} x {own_rows} as declared{advice}"
    );
    let changes = [("columns", columns.to_string()), ("rows", rows.to_string())];
    Layout::new(of_size(declared, columns, rows), words, &changes)
}

/// Grids with a column or a row more or fewer, and with both exchanged.
fn sizes(declared: &TargetModel, columns: u32, rows: u32) -> Vec<Layout> {
    let (c, r) = (columns, rows);
    let near = [
        (c.saturating_sub(1), r.saturating_sub(1)),
        (r, c),
        (r.saturating_sub(1), c.saturating_sub(1)),
        (c + 1, r + 1),
        (c.saturating_sub(1), r),
        (c, r.saturating_sub(1)),
        (c + 1, r),
        (c, r + 1),
    ];
    let sound =
        |&(columns, rows): &(u32, u32)| columns > 1 && rows > 1 && (columns, rows) != (c, r);
    near.into_iter().filter(sound).map(|(c, r)| resized(declared, c, r)).collect()
}

/// The size that the search itself reports, whatever it is.
fn other_size(dataset: &Dataset, images: &[GrayImage], declared: &TargetModel) -> Option<Layout> {
    let camera = dataset.intrinsics.as_ref();
    images.iter().find_map(|image| match detect::detect_with(image, declared, camera) {
        Err(NotFound::OtherSize { columns, rows, .. }) => Some(resized(declared, columns, rows)),
        _ => None,
    })
}

/// The other kind of grid of circles.
fn other_circles(target: TargetModel, kind: &str) -> Layout {
    let words = format!("the images show the other kind of grid: {kind}");
    Layout::new(target, words, &[("kind", format!("\"{kind}\""))])
}

fn charuco(declared: &TargetModel) -> Vec<Layout> {
    let TargetModel::Charuco { squares_x, squares_y, dictionary, legacy, .. } = declared else {
        return vec![];
    };
    let (x, y) = (*squares_x, *squares_y);
    let with = |new_x: u32, new_y: u32, new_dictionary: &str, new_legacy: bool| {
        let mut target = declared.clone();
        if let TargetModel::Charuco { squares_x, squares_y, dictionary, legacy, .. } = &mut target {
            (*squares_x, *squares_y, *legacy) = (new_x, new_y, new_legacy);
            *dictionary = new_dictionary.to_owned();
        }
        target
    };
    let sized = |(new_x, new_y): (u32, u32), why: &str| {
        let words =
            format!("the images show {new_x} x {new_y} squares, not {x} x {y} as declared: {why}");
        let changes = [("squares_x", new_x.to_string()), ("squares_y", new_y.to_string())];
        Layout::new(with(new_x, new_y, dictionary, *legacy), words, &changes)
    };
    let mut all = vec![
        sized((y, x), "squares_x and squares_y are exchanged"),
        sized((x + 1, y + 1), "count squares, not inner corners"),
        sized((y + 1, x + 1), "count squares, not inner corners, squares_x along x"),
    ];
    let words = format!(
        "the board has the layout of OpenCV {}: legacy = {}",
        if *legacy { "4.6 and later" } else { "before 4.6" },
        !legacy
    );
    let changes = [("legacy", (!legacy).to_string())];
    all.push(Layout::new(with(x, y, dictionary, !legacy), words, &changes));
    all.extend(DICTIONARIES.iter().filter(|name| *name != dictionary).map(|name| {
        let words = format!("the markers are of {name}, not of {dictionary} as declared");
        Layout::new(with(x, y, name, *legacy), words, &[("dictionary", format!("\"{name}\""))])
    }));
    all
}

/// An AprilGrid with other numbers of tags, and as declared but for one thing.
fn aprilgrid(declared: &TargetModel) -> Vec<Layout> {
    let &TargetModel::Aprilgrid {
        tags_x,
        tags_y,
        tag_mm,
        spacing,
        family,
        first_id,
        border_bits,
        ..
    } = declared
    else {
        return vec![];
    };
    let mut all = vec![];
    if tags_x != tags_y {
        all.push(with_tags(declared, tags_y, tags_x, "tags_x and tags_y are exchanged"));
    }
    let mut bordered = declared.clone();
    if let TargetModel::Aprilgrid { border_bits, .. } = &mut bordered {
        *border_bits = 3 - (*border_bits).clamp(1, 2);
    }
    let words = format!(
        "the tags have a black border of {} bits, not {border_bits} as declared",
        3 - border_bits.clamp(1, 2)
    );
    let changes = [("border_bits", (3 - border_bits.clamp(1, 2)).to_string())];
    all.push(Layout::new(bordered, words, &changes));
    let dictionary = family.dictionary().to_owned();
    let gap_mm = spacing * tag_mm;
    let grid = TargetModel::TagGrid { dictionary, tags_x, tags_y, tag_mm, gap_mm, first_id };
    let words = format!(
        "the tags are numbered from the top left, row by row, and not from the bottom left as those of an \
         AprilGrid: declare kind = \"tag-grid\" with dictionary = \"{}\", tag_mm and gap_mm = {gap_mm}",
        family.dictionary()
    );
    all.push(Layout::new(grid, words, &[]));
    all
}

fn with_tags(declared: &TargetModel, new_x: u32, new_y: u32, why: &str) -> Layout {
    let mut target = declared.clone();
    let mut own = (0, 0);
    if let TargetModel::Aprilgrid { tags_x, tags_y, .. } = &mut target {
        own = (*tags_x, *tags_y);
        (*tags_x, *tags_y) = (new_x, new_y);
    }
    let words = format!(
        "the ids of the tags contradict the layout: the images show {new_x} x {new_y} tags, not {} x {} as \
         declared: {why}",
        own.0, own.1
    );
    let changes = [("tags_x", new_x.to_string()), ("tags_y", new_y.to_string())];
    Layout::new(target, words, &changes)
}
