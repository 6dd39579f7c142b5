//! ArUco and AprilTag markers, found by themselves: where their corners are, and how sure that is.
//!
//! Pixels darker than their surroundings form patches; the convex hull of a tag's black border is a
//! quadrilateral (`quads`), and the bits inside say which tag it is, and how it is turned. That
//! happens in the image made small first. In the image itself the four sides are measured
//! (`edge`); they meet in the corners (`sides`). Where blur does not leave the sides alone, the tag is
//! measured with all its bits (`whole`).

mod edge;
mod patches;
mod quads;
mod sides;
mod whole;

use nalgebra::{Matrix3, Vector2};

use super::{
    homography,
    markers::{Cells, Dictionary, Greys},
    pyramid::{Scaled, smoothed, stretched},
};
use crate::{GrayImage, ImageCorner, detect::outcome::NotFound};
use edge::{Surroundings, is_crowded, is_roomy};
pub(super) use quads::Quad;
use quads::{area, quads};
use sides::{approached, refined, seen_in_part};
use whole::{LINES, Pattern};

/// A cell of the tag (border and bits) must be this large, px.
const LEAST_CELL_PX: f64 = 1.6;
/// The same where tags touch other squares, from which they must be told.
const LEAST_TOUCHING_CELL_PX: f64 = 3.0;
/// White minus black, grey values, below which nothing is read.
const LEAST_CONTRAST: f64 = 8.0;
/// Share of the bits, and of the border's cells, that may be read wrong.
const MOST_WRONG: f64 = 0.12;
/// Rounds in which corners are measured, from a pixel away and from some tenths of one.
const ROUNDS: usize = 3;
const ROUNDS_WHEN_NEAR: usize = 2;
/// White around a tag that is no part of a board, cells.
const WHITE_AROUND_ONE: f64 = 1.0;
/// Blur of a tag whose sides were not found, in cells.
const BLURRED_CELLS: f64 = 0.25;
/// Longest side of the smallest image that is searched, px, at most.
const COARSEST: usize = 900;

/// The corners of tag `id` (top left, top right, bottom right, bottom left as printed).
///
/// # Errors
/// Why it was not found.
pub fn detect(image: &GrayImage, name: &str, id: u32) -> Result<Vec<ImageCorner>, NotFound> {
    let print = Print::new(name, 1, None, false)?;
    let mut blurred = false;
    let corners = Levels::new(image).search(|level, clear| {
        let best = best(print.read_all(level.image(), clear, [id]))?;
        let quad = level.original(&best.quad);
        let corners = level.refined(&SeenTag { quad, ..best }, &print);
        blurred |= corners.is_none();
        corners
    });
    let dictionary = || name.to_owned();
    match corners {
        Some(corners) => Ok(corners.into()),
        None if blurred => Err(NotFound::BlurredTag { dictionary: dictionary(), id }),
        None => Err(NotFound::NoTag { dictionary: dictionary(), id }),
    }
}

/// The tag that was read best, the largest of equals.
fn best(tags: Vec<SeenTag>) -> Option<SeenTag> {
    tags.into_iter()
        .min_by(|a, b| a.errors.cmp(&b.errors).then(area(&b.quad).total_cmp(&area(&a.quad))))
}

/// A tag in an image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SeenTag {
    /// Which marker.
    pub id: u32,
    /// Cells that were read wrong.
    pub errors: u32,
    /// Its corners to about a pixel, the marker's top left first.
    pub quad: Quad,
}

impl SeenTag {
    /// Area, px².
    pub fn area(&self) -> f64 {
        area(&self.quad)
    }
}

/// How tags are printed.
pub(super) struct Print {
    pub dictionary: Dictionary,
    /// Width of the black border, bits.
    border: usize,
    /// Width of the white around a tag, in cells.
    white: f64,
    /// Whether other black squares touch the tag's corners.
    pub touching: bool,
}

impl Print {
    /// Tags by the name of their dictionary, with a black border of so many cells and a white gap to the
    /// next tag, over their side; none for a tag alone.
    pub fn new(
        name: &str,
        border: usize,
        gap: Option<f64>,
        touching: bool,
    ) -> Result<Self, NotFound> {
        let dictionary =
            Dictionary::named(name).ok_or_else(|| NotFound::UnknownDictionary(name.into()))?;
        let cells = (dictionary.side() + 2 * border) as f64;
        let white = gap.map_or(WHITE_AROUND_ONE, |gap| gap * cells);
        Ok(Self { dictionary, border, white, touching })
    }

    /// Cells along a side.
    fn cells(&self) -> usize {
        self.dictionary.side() + 2 * self.border
    }

    fn surroundings(&self) -> Surroundings {
        let cells = self.cells() as f64;
        let clear = self.white.min(self.border as f64);
        Surroundings { cells, clear, bows: [0.0; 4] }
    }

    /// What a tag looks like, if it is not too large.
    fn pattern(&self, id: u32) -> Option<Pattern> {
        let cells = self.cells();
        let black = |row: usize, column: usize| {
            let inside = row < cells && column < cells;
            let at = (column, row);
            inside && self.dictionary.is_cell_black(id, self.border as u32, false, at)
        };
        let cell = |row: usize, column: usize| f32::from(u8::from(black(row, column)));
        let row = |row: usize| std::array::from_fn(|column| cell(row, column));
        let black = std::array::from_fn(row);
        (cells < LINES).then_some(Pattern { cells, black, white: self.white })
    }

    /// The corners of a tag by its sides, or by all of it where these are not alone.
    fn measure(
        &self,
        image: &GrayImage,
        tag: &SeenTag,
        bows: [f64; 4],
        rounds: usize,
    ) -> Option<[ImageCorner; 4]> {
        let around = Surroundings { bows, ..self.surroundings() };
        let sides = refined(image, &tag.quad, &around, rounds);
        let cell = tag.area().sqrt() / around.cells;
        let (quad, blur_px) = match &sides {
            Some(found) if !is_crowded(&found.quad(), &around, found.blur_px) => {
                return Some(found.corners);
            }
            Some(found) => (found.quad(), found.blur_px),
            None if is_roomy(cell) => return None,
            None => (tag.quad, BLURRED_CELLS * cell),
        };
        whole::fit(image, &quad, &self.pattern(tag.id)?, bows, blur_px)
    }

    /// All tags with one of `ids` in an image, once for each dark patch. Patches are looked for in
    /// `clear`.
    pub fn read_all(
        &self,
        image: &GrayImage,
        clear: &GrayImage,
        ids: impl IntoIterator<Item = u32> + Clone,
    ) -> Vec<SeenTag> {
        let cell = if self.touching { LEAST_TOUCHING_CELL_PX } else { LEAST_CELL_PX };
        let found = quads(clear, cell * self.cells() as f64, self.touching);
        found.iter().filter_map(|quad| self.read(image, quad, ids.clone())).collect()
    }

    /// The tag in a quadrilateral, as it is seen or sharpened.
    pub fn read(
        &self,
        image: &GrayImage,
        quad: &Quad,
        ids: impl IntoIterator<Item = u32> + Clone,
    ) -> Option<SeenTag> {
        let side = self.dictionary.side();
        let h: Matrix3<f64> = homography::from_unit_square(quad);
        let at = |x: f64, y: f64| homography::apply(&h, &Vector2::new(x, y));
        let greys = Greys::of(image, (side, self.border), at)?;
        let seen = greys.read();
        if seen.contrast < LEAST_CONTRAST {
            return None;
        }
        let most = |cells: usize| (MOST_WRONG * cells as f64) as u32;
        let rim = self.cells() * self.cells() - side * side;
        let reading = |cells: Cells| {
            let read = || self.dictionary.read(cells.code, ids.clone(), most(side * side));
            let reading = if cells.border_errors <= most(rim) { read() } else { None }?;
            Some((reading, reading.errors + cells.border_errors))
        };
        let (reading, errors) = reading(seen).or_else(|| reading(greys.sharpened().read()))?;
        let quad = std::array::from_fn(|k| quad[(k + reading.turns) % 4]);
        Some(SeenTag { id: reading.id, errors, quad })
    }
}

/// An image and its halves, halves of these and so on.
pub(super) struct Levels<'a> {
    /// The smallest first.
    all: Vec<Scaled<'a>>,
}

impl<'a> Levels<'a> {
    pub fn new(image: &'a GrayImage) -> Self {
        let small = |half: &GrayImage| half.width().max(half.height()) <= COARSEST;
        Self { all: Scaled::halves(image, small).collect() }
    }

    /// The markers that are read without a wrong bit, in any of the images, for each way of printing; px of the
    /// original. All ways touch other squares, or none does.
    pub fn read_each(&self, prints: &[Print]) -> Vec<Vec<SeenTag>> {
        let Some(touching) = prints.first().map(|print| print.touching) else { return vec![] };
        let cell = if touching { LEAST_TOUCHING_CELL_PX } else { LEAST_CELL_PX };
        let fewest = prints.iter().map(Print::cells).min().unwrap_or(0);
        let mut all: Vec<Vec<SeenTag>> = prints.iter().map(|_| vec![]).collect();
        for level in (0..self.all.len()).map(|at| Level { levels: self, at }) {
            let found = quads(level.image(), cell * fewest as f64, touching);
            for (print, seen) in prints.iter().zip(&mut all) {
                let ids = 0..print.dictionary.len() as u32;
                let read =
                    found.iter().filter_map(|quad| print.read(level.image(), quad, ids.clone()));
                let right = read.filter(|tag| tag.errors == 0);
                seen.extend(
                    right.map(|tag| SeenTag { quad: level.approached(&tag.quad, print), ..tag }),
                );
            }
        }
        all.iter().map(|seen| without_copies(seen)).collect()
    }

    /// What is found first: in the smallest image, or else in a larger one, or else with the
    /// images smoothed and stretched, where patches are looked for in the second image.
    pub fn search<T>(&self, mut find: impl FnMut(&Level, &GrayImage) -> Option<T>) -> Option<T> {
        let levels = || (0..self.all.len()).map(|at| Level { levels: self, at });
        let plain = levels().find_map(|level| find(&level, level.image()));
        plain.or_else(|| {
            levels().find_map(|level| find(&level, &stretched(&smoothed(level.image()))))
        })
    }
}

/// One of the images.
pub(super) struct Level<'a> {
    levels: &'a Levels<'a>,
    at: usize,
}

impl Level<'_> {
    fn scaled(&self) -> &Scaled<'_> {
        &self.levels.all[self.at]
    }

    /// This image and the larger ones.
    pub(crate) fn and_larger(&self) -> impl Iterator<Item = Level<'_>> {
        (self.at..self.levels.all.len()).map(|at| Level { levels: self.levels, at })
    }

    /// The image.
    pub fn image(&self) -> &GrayImage {
        &self.scaled().image
    }

    /// The corners of a quadrilateral found here, in the original: to some tenths of this
    /// image's pixel where its sides are clear.
    pub(crate) fn approached(&self, quad: &Quad, print: &Print) -> Quad {
        let near = approached(self.image(), quad, &print.surroundings());
        self.original(&near.unwrap_or(*quad))
    }

    /// A quadrilateral of this image, in the original.
    fn original(&self, quad: &Quad) -> Quad {
        quad.each_ref().map(|p| self.scaled().original(p))
    }

    /// A quadrilateral of the original, in this image.
    pub(crate) fn reduced(&self, quad: &Quad) -> Quad {
        quad.each_ref().map(|p| self.scaled().reduced(p))
    }

    /// The corners of a tag of the original, measured in the original.
    fn refined(&self, tag: &SeenTag, print: &Print) -> Option<[ImageCorner; 4]> {
        let (original, smaller) = self.levels.all[self.at..].split_last()?;
        let quad = nearer(&tag.quad, smaller, print);
        print.measure(&original.image, &SeenTag { quad, ..*tag }, [0.0; 4], ROUNDS)
    }

    /// The corners of a quadrilateral that was approached here, to some tenths of the original's
    /// pixel.
    pub fn nearer(&self, quad: &Quad, print: &Print) -> Quad {
        nearer(quad, &self.levels.all[self.at + 1..], print)
    }

    /// The corners of a tag of the original that is near already; the lens bends its sides by `bows`.
    pub fn measured(
        &self,
        tag: &SeenTag,
        print: &Print,
        bows: [f64; 4],
    ) -> Option<[ImageCorner; 4]> {
        print.measure(&self.levels.all.last()?.image, tag, bows, ROUNDS_WHEN_NEAR)
    }

    /// The corners of such a quadrilateral that can be seen, where nothing was read in it.
    pub(crate) fn seen_in_part(
        &self,
        quad: &Quad,
        print: &Print,
        bows: [f64; 4],
    ) -> [Option<ImageCorner>; 4] {
        let around = Surroundings { bows, ..print.surroundings() };
        let original = self.levels.all.last();
        original.map_or([None; 4], |level| seen_in_part(&level.image, quad, &around))
    }
}

/// A quadrilateral of the original; from image to image it comes nearer to the truth.
fn nearer(quad: &Quad, levels: &[Scaled], print: &Print) -> Quad {
    let around = print.surroundings();
    let step = |quad: Quad, level: &Scaled| {
        let start = quad.each_ref().map(|p| level.reduced(p));
        let near = approached(&level.image, &start, &around);
        near.map_or(quad, |near| near.each_ref().map(|p| level.original(p)))
    };
    levels.iter().fold(*quad, step)
}

/// Each tag once where several patches show it; the best come first.
pub(super) fn without_copies(seen: &[SeenTag]) -> Vec<SeenTag> {
    let mut kept: Vec<SeenTag> = vec![];
    for tag in seen {
        let centre = |tag: &SeenTag| tag.quad.iter().sum::<Vector2<f64>>() / 4.0;
        let copy = |other: &SeenTag| {
            other.id == tag.id && (centre(other) - centre(tag)).norm_squared() < 0.25 * tag.area()
        };
        if !kept.iter().any(copy) {
            kept.push(*tag);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Intrinsics, Pose, TargetModel,
        math::random::Random,
        simulate::{Optics, Scene},
    };

    const NAMES: [&str; 3] = ["DICT_APRILTAG_36h11", "DICT_6X6_250", "DICT_4X4_50"];

    fn scene(name: &str, id: u32, seed: u64) -> Scene {
        let mut random = Random::new(seed);
        let turn =
            [random.between(-0.6, 0.6), random.between(-0.6, 0.6), random.between(-3.1, 3.1)];
        let at =
            [random.between(-0.05, 0.05), random.between(-0.05, 0.05), random.between(0.3, 0.6)];
        let dictionary = name.into();
        Scene {
            target: TargetModel::Tag { dictionary, id, size_mm: 48.0 },
            camera_from_target: Pose::claim(nalgebra::Isometry3::new(at.into(), turn.into())),
            intrinsics: Intrinsics::pinhole(640, 480, 600.0, 600.0, 319.5, 239.5),
        }
    }

    #[test]
    fn a_rendered_tag_is_found_where_it_is_however_it_is_turned() {
        for (k, name) in NAMES.iter().cycle().take(24).enumerate() {
            let scene = scene(name, k as u32, k as u64);
            let image = scene.picture(&Optics::default(), k as u64);
            let found = detect(&image, name, k as u32).unwrap();
            for (corner, (id, exact)) in found.iter().zip(scene.corners()) {
                let off = (corner.pixel - exact).norm();
                assert!(corner.id == id && off < 0.2, "{name} {k}: corner {id} is {off:.3} px off");
            }
        }
    }

    #[test]
    fn errors_stay_inside_the_covariance() {
        let (mut sum, mut count) = (0.0, 0.0);
        for k in 0..40 {
            let scene = scene(NAMES[0], 7, 100 + k);
            let image = scene.picture(&Optics::default(), k);
            for (corner, (_, exact)) in
                detect(&image, NAMES[0], 7).unwrap().iter().zip(scene.corners())
            {
                let e = corner.pixel - exact;
                sum += e.dot(&(corner.covariance.try_inverse().unwrap() * e)) / 2.0;
                count += 1.0;
            }
        }
        let mean = sum / count;
        println!("normalised error squared {mean:.2}");
        assert!((0.7..1.5).contains(&mean), "{mean}");
    }

    /// Root mean square of the corners' errors (px, per axis), and their mean square over their
    /// covariances.
    fn figures(optics: &Optics) -> (f64, f64) {
        let (mut squares, mut normalised, mut count) = (0.0, 0.0, 0.0);
        for k in 0..40 {
            let scene = scene(NAMES[0], 7, 200 + k);
            let found = detect(&scene.picture(optics, k), NAMES[0], 7).unwrap();
            for (corner, (_, exact)) in found.iter().zip(scene.corners()) {
                let e = corner.pixel - exact;
                squares += e.norm_squared();
                normalised += e.dot(&(corner.covariance.try_inverse().unwrap() * e));
                count += 2.0;
            }
        }
        ((squares / count).sqrt(), normalised / count)
    }

    #[test]
    fn blur_and_noise_are_in_the_covariance() {
        for (blur_px, noise) in [(0.4, 1.0), (0.8, 1.0), (0.8, 4.0), (1.5, 2.0)] {
            let (rms, mean) = figures(&Optics { blur_px, noise, ..Optics::default() });
            println!("blur {blur_px} noise {noise}: {rms:.4} px, normalised {mean:.2}");
            assert!((0.7..1.5).contains(&mean), "blur {blur_px}, noise {noise}: {mean}");
        }
    }

    #[test]
    fn another_tag_is_not_taken_for_the_wanted_one() {
        let image = scene(NAMES[0], 7, 1).picture(&Optics::default(), 1);
        assert!(detect(&image, NAMES[0], 8).is_err());
        assert!(detect(&image, NAMES[1], 7).is_err());
        assert!(detect(&image, "DICT_9X9", 7).is_err());
    }

    #[test]
    fn an_empty_picture_shows_no_tag() {
        let image = GrayImage::new(200, 100, vec![77.0; 20_000]).unwrap();
        let message = detect(&image, NAMES[0], 3).unwrap_err().to_string();
        assert!(message.contains("no tag 3 of DICT_APRILTAG_36h11"), "{message}");
    }
}
