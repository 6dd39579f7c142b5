//! One ArUco or AprilTag marker; its corners are counted clockwise from the top left, as in OpenCV.

use nalgebra::Vector2;

use crate::{
    Error, TargetModel,
    model::{
        dictionary::Dictionary,
        print::{self, Art},
        target::{
            family::{Family, Markers},
            kinds::Kind,
            layout,
            look::Look,
        },
        texture::Texture,
    },
};

pub(in crate::model::target) const KIND: Kind = Kind {
    name: "tag",
    example: || TargetModel::Tag { dictionary: "DICT_5X5_100".into(), id: 3, size_mm: 60.0 },
    counts: &["id"],
    help: "One ArUco or AprilTag marker with this id",
};

pub(in crate::model::target) struct Tag<'a> {
    pub dictionary: &'a str,
    pub id: u32,
    pub size_mm: f64,
}

impl Family for Tag<'_> {
    fn look(&self) -> Look {
        Look::Tag { dictionary: self.dictionary.into(), id: self.id }
    }

    fn grid(&self) -> (u32, u32) {
        (2, 2)
    }

    fn lengths_mm(&self) -> Vec<(&'static str, f64)> {
        vec![("size_mm", self.size_mm)]
    }

    fn in_plane(&self, id: u32) -> Vector2<f64> {
        let corner = Vector2::from(layout::CLOCKWISE[id as usize]);
        corner.add_scalar(-0.5) * (1e-3 * self.size_mm)
    }

    fn id_at(&self, column: u32, row: u32) -> u32 {
        layout::of_tag(1, column, row)
    }

    fn markers(&self) -> Option<Markers<'_>> {
        Some((self.dictionary, self.id, 1))
    }

    fn check_counts(&self) -> Result<(), Error> {
        Ok(())
    }

    /// Its dictionary is asked for when it is drawn or looked for.
    fn check(&self) -> Result<(), Error> {
        Ok(())
    }

    fn art(&self, _: &TargetModel) -> Result<Art, Error> {
        let Self { id, size_mm, .. } = *self;
        let dictionary = print::named(self.dictionary)?;
        print::check_marker(&dictionary, id)?;
        Ok(Art {
            width: size_mm,
            height: size_mm,
            white_rim: print::cell(&dictionary, size_mm),
            shapes: print::marker(&dictionary, id, &print::Square::upright((0.0, 0.0), size_mm)),
            target_origin: (0.5 * size_mm, 0.5 * size_mm),
        })
    }

    fn texture(&self, _: &TargetModel) -> Option<Texture> {
        Some(Texture::tag(Dictionary::named(self.dictionary)?, self.id, self.size_mm))
    }

    fn in_words(&self) -> String {
        let Self { dictionary, id, size_mm } = self;
        format!("Tag {id} of {dictionary}, black square of {size_mm} mm")
    }
}
