//! OpenCV's `GridBoard` of markers. Its rows are counted downwards, its origin is the top left of the first marker, and
//! a marker's corners are counted clockwise from there.

use nalgebra::Vector2;

use crate::{
    Error, TargetModel,
    model::{
        dictionary::Dictionary,
        print::{self, Art},
        target::{
            check,
            family::{Family, Markers},
            kinds::{Kind, PlacedTag},
            layout,
            look::{Look, Tags},
        },
        texture::Texture,
    },
};

pub(in crate::model::target) const KIND: Kind = Kind {
    name: "tag-grid",
    example: || TargetModel::TagGrid {
        dictionary: "DICT_5X5_100".into(),
        tags_x: 5,
        tags_y: 4,
        tag_mm: 30.0,
        gap_mm: 8.0,
        first_id: 0,
    },
    counts: &["tags_x", "tags_y"],
    help: "OpenCV's grid of so many markers: columns x rows",
};

pub(in crate::model::target) struct TagGrid<'a> {
    pub dictionary: &'a str,
    pub tags_x: u32,
    pub tags_y: u32,
    pub tag_mm: f64,
    pub gap_mm: f64,
    pub first_id: u32,
}

impl TagGrid<'_> {
    /// Top left of the marker in a column and a row, m.
    fn tag_origin(&self, column: u32, row: u32) -> Vector2<f64> {
        let step = self.tag_mm + self.gap_mm;
        1e-3 * Vector2::new(f64::from(column) * step, f64::from(row) * step)
    }
}

impl Family for TagGrid<'_> {
    fn look(&self) -> Look {
        Look::Tags(Tags {
            dictionary: self.dictionary.into(),
            first_id: self.first_id,
            border_bits: 1,
            gap: self.gap_mm / self.tag_mm,
            joined: false,
        })
    }

    fn grid(&self) -> (u32, u32) {
        (self.tags_x.saturating_mul(2), self.tags_y.saturating_mul(2))
    }

    fn lengths_mm(&self) -> Vec<(&'static str, f64)> {
        vec![("tag_mm", self.tag_mm), ("gap_mm", self.gap_mm)]
    }

    fn in_plane(&self, id: u32) -> Vector2<f64> {
        let tag = id / 4;
        let corner = Vector2::from(layout::CLOCKWISE[id as usize % 4]);
        self.tag_origin(tag % self.tags_x, tag / self.tags_x) + corner * (1e-3 * self.tag_mm)
    }

    fn id_at(&self, column: u32, row: u32) -> u32 {
        layout::of_tag(self.tags_x, column, row)
    }

    fn tags(&self) -> Vec<PlacedTag> {
        let one = |t: u32| PlacedTag {
            marker: self.first_id + t,
            corners: [0, 1, 2, 3].map(|k| 4 * t + k),
            top_left: self.tag_origin(t % self.tags_x, t / self.tags_x),
            side: 1e-3 * self.tag_mm,
            turned: false,
        };
        (0..self.tags_x * self.tags_y).map(one).collect()
    }

    fn markers(&self) -> Option<Markers<'_>> {
        let count = u64::from(self.tags_x) * u64::from(self.tags_y);
        Some((self.dictionary, self.first_id, count))
    }

    fn check_counts(&self) -> Result<(), Error> {
        check::tag_counts(self.tags_x, self.tags_y, self.grid())
    }

    fn art(&self, target: &TargetModel) -> Result<Art, Error> {
        Ok(print::tags(target, &print::named(self.dictionary)?, 1, self.gap_mm))
    }

    fn texture(&self, target: &TargetModel) -> Option<Texture> {
        let dictionary = Dictionary::named(self.dictionary)?;
        Some(Texture::tags(target, dictionary, self.gap_mm / self.tag_mm, (1, false)))
    }

    fn in_words(&self) -> String {
        let Self { dictionary, tags_x, tags_y, tag_mm, gap_mm, first_id } = self;
        format!(
            "Tag grid, {tags_x} x {tags_y} tags of {tag_mm} mm, gaps of {gap_mm} mm, {dictionary} \
             from {first_id}"
        )
    }
}
