//! A plain checkerboard.
//!
//! It looks the same after half a turn when its numbers of squares have an even sum; a square one with an odd number of
//! squares also after quarter turns.

use nalgebra::Vector2;

use crate::{
    Error, TargetModel,
    model::{
        print::{self, Art},
        target::{
            family::{Family, Turns},
            kinds::Kind,
            look::Look,
        },
        texture::Texture,
    },
};

pub(in crate::model::target) const KIND: Kind = Kind {
    name: "checkerboard",
    example: || TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 20.0 },
    counts: &["columns", "rows"],
    help: "Checkerboard of so many INNER corners: columns x rows",
};

pub(in crate::model::target) struct Checkerboard {
    pub columns: u32,
    pub rows: u32,
    pub square_mm: f64,
}

impl Family for Checkerboard {
    fn look(&self) -> Look {
        Look::Squares
    }

    fn grid(&self) -> (u32, u32) {
        (self.columns, self.rows)
    }

    fn lengths_mm(&self) -> Vec<(&'static str, f64)> {
        vec![("square_mm", self.square_mm)]
    }

    fn in_plane(&self, id: u32) -> Vector2<f64> {
        let (column, row) = (id % self.columns, id / self.columns);
        Vector2::new(f64::from(column), f64::from(row)) * (1e-3 * self.square_mm)
    }

    fn turns(&self) -> Turns {
        match () {
            () if self.columns == self.rows && self.columns.is_multiple_of(2) => Turns::Quarter,
            () if (self.columns + self.rows).is_multiple_of(2) => Turns::Half,
            () => Turns::None,
        }
    }

    fn art(&self, _: &TargetModel) -> Result<Art, Error> {
        let (across, down) = (self.columns + 1, self.rows + 1);
        Ok(print::checkerboard(across, down, self.square_mm, false, (1.0, 1.0)))
    }

    fn texture(&self, _: &TargetModel) -> Option<Texture> {
        let squares = (self.columns + 1, self.rows + 1);
        Some(Texture::squares(squares, self.square_mm, Vector2::new(1.0, 1.0)))
    }

    fn in_words(&self) -> String {
        let Self { columns, rows, square_mm } = self;
        format!("Checkerboard, {columns} x {rows} inner corners, squares of {square_mm} mm")
    }
}
