//! Kalibr's grid of AprilTags. Its rows are counted upwards, its origin is the bottom left of the first tag, and a tag's
//! corners are counted counter-clockwise from there.

use nalgebra::Vector2;

use crate::{
    Error, TargetModel,
    model::{
        dictionary::Dictionary,
        print::{self, Art, Shape},
        target::{
            check,
            family::{Family, Markers},
            kinds::{AprilTagFamily, Kind, PlacedTag},
            layout,
            look::{Look, Tags},
        },
        texture::Texture,
    },
};

/// The corners of a tag in OpenCV's order: the dictionary holds it upside down.
const UPSIDE_DOWN: [u32; 4] = [1, 0, 3, 2];
/// Corners of the unit square, from the bottom left.
const COUNTER_CLOCKWISE: [[f64; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
/// Gap over tag: larger ones are gaps in millimetres.
const WIDEST_SPACING: f64 = 2.0;
/// Largest border of a tag, bits.
const WIDEST_BORDER: u32 = 2;

pub(in crate::model::target) const KIND: Kind = Kind {
    name: "aprilgrid",
    example: || TargetModel::Aprilgrid {
        tags_x: 6,
        tags_y: 4,
        tag_mm: 24.0,
        spacing: 0.3,
        family: AprilTagFamily::Tag36h11,
        first_id: 0,
        corner_squares: true,
        border_bits: 1,
    },
    counts: &["tags_x", "tags_y"],
    help: "Kalibr's grid of so many AprilTags: columns x rows",
};

pub(in crate::model::target) struct Aprilgrid {
    pub tags_x: u32,
    pub tags_y: u32,
    pub tag_mm: f64,
    pub spacing: f64,
    pub family: AprilTagFamily,
    pub first_id: u32,
    pub corner_squares: bool,
    pub border_bits: u32,
}

impl Aprilgrid {
    /// Top left of the tag in a column and a row as the ids count them, m.
    fn tag_origin(&self, column: u32, row: u32) -> Vector2<f64> {
        let step = self.tag_mm * (1.0 + self.spacing);
        let (x, y) = (f64::from(column) * step, f64::from(row) * step);
        1e-3 * Vector2::new(x, -y - self.tag_mm)
    }

    fn gap_mm(&self) -> f64 {
        self.tag_mm * self.spacing
    }

    /// Squares where the gaps cross, those at the rim too.
    fn corner_squares(&self) -> impl Iterator<Item = Shape> {
        let gap = self.gap_mm();
        let step = self.tag_mm + gap;
        let (columns, rows) = (self.tags_x, self.tags_y);
        let at = move |k: u32| f64::from(k) * step;
        let square = move |(i, j)| Shape::Rectangle { x: at(i), y: at(j), width: gap, height: gap };
        (0..=rows).flat_map(move |j| (0..=columns).map(move |i| (i, j))).map(square)
    }
}

impl Family for Aprilgrid {
    fn look(&self) -> Look {
        Look::Tags(Tags {
            dictionary: self.family.dictionary().into(),
            first_id: self.first_id,
            border_bits: self.border_bits,
            gap: self.spacing,
            joined: self.corner_squares,
        })
    }

    fn grid(&self) -> (u32, u32) {
        (self.tags_x.saturating_mul(2), self.tags_y.saturating_mul(2))
    }

    fn lengths_mm(&self) -> Vec<(&'static str, f64)> {
        vec![("tag_mm", self.tag_mm)]
    }

    fn in_plane(&self, id: u32) -> Vector2<f64> {
        let tag = id / 4;
        let corner = Vector2::from(COUNTER_CLOCKWISE[id as usize % 4]);
        self.tag_origin(tag % self.tags_x, tag / self.tags_x) + corner * (1e-3 * self.tag_mm)
    }

    fn id_at(&self, column: u32, row: u32) -> u32 {
        layout::of_tag(self.tags_x, column, self.grid().1 - 1 - row)
    }

    fn tags(&self) -> Vec<PlacedTag> {
        let one = |t: u32| PlacedTag {
            marker: self.first_id + t,
            corners: UPSIDE_DOWN.map(|k| 4 * t + k),
            top_left: self.tag_origin(t % self.tags_x, t / self.tags_x),
            side: 1e-3 * self.tag_mm,
            turned: true,
        };
        (0..self.tags_x * self.tags_y).map(one).collect()
    }

    fn markers(&self) -> Option<Markers<'_>> {
        let count = u64::from(self.tags_x) * u64::from(self.tags_y);
        Some((self.family.dictionary(), self.first_id, count))
    }

    fn check_counts(&self) -> Result<(), Error> {
        check::tag_counts(self.tags_x, self.tags_y, self.grid())
    }

    fn check(&self) -> Result<(), Error> {
        let Self { spacing, border_bits, .. } = *self;
        if !(spacing > 0.0 && spacing <= WIDEST_SPACING) {
            return check::invalid(format!(
                "spacing = {spacing} must be the gap between tags divided by tag_mm, such as 0.3"
            ));
        }
        if !(1..=WIDEST_BORDER).contains(&border_bits) {
            return check::invalid(format!(
                "border_bits = {border_bits} must be 1, or 2 as in Kalibr's own drawings"
            ));
        }
        self.markers().map_or(Ok(()), check::markers)
    }

    fn art(&self, target: &TargetModel) -> Result<Art, Error> {
        let dictionary = print::named(self.family.dictionary())?;
        let mut art = print::tags(target, &dictionary, self.border_bits, self.gap_mm());
        if self.corner_squares {
            art.shapes.extend(self.corner_squares());
        }
        Ok(art)
    }

    fn texture(&self, target: &TargetModel) -> Option<Texture> {
        let dictionary = Dictionary::named(self.family.dictionary())?;
        let print = (self.border_bits, self.corner_squares);
        Some(Texture::tags(target, dictionary, self.spacing, print))
    }

    fn in_words(&self) -> String {
        let Self { tags_x, tags_y, tag_mm, first_id, .. } = self;
        format!(
            "Aprilgrid, {tags_x} x {tags_y} tags of {tag_mm} mm, gaps of {} mm, {} from {first_id}",
            (self.gap_mm() * 1e3).round() / 1e3,
            self.family.dictionary()
        )
    }
}
