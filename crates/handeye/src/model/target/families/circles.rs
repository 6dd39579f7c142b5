//! Grids of circles: plain, OpenCV's asymmetric one, and ROS-Industrial's with one larger circle.
//!
//! A plain one looks the same after half a turn, a square one after quarter turns, an asymmetric one after half a turn if
//! its number of rows is even, one with a larger circle never.

use nalgebra::Vector2;

use crate::{
    Error, TargetModel,
    model::{
        print::{self, Art},
        target::{
            check,
            family::{Family, Turns},
        },
        texture::Texture,
    },
};

/// Diameter of a circle over the distance between neighbours.
const DISC_SHARE: f64 = 0.5;
/// Diameters of the usual and of the larger circle of ROS-Industrial's grid, over the distance
/// between neighbours: circles of 10 and 20 mm, 25 mm apart.
const MODIFIED_SHARES: (f64, f64) = (0.4, 0.8);

pub(in crate::model::target) struct CircleGrid {
    pub columns: u32,
    pub rows: u32,
    pub pitch_mm: f64,
}

pub(in crate::model::target) struct AsymmetricCircleGrid {
    pub columns: u32,
    pub rows: u32,
    pub pitch_mm: f64,
}

pub(in crate::model::target) struct ModifiedCircleGrid {
    pub columns: u32,
    pub rows: u32,
    pub pitch_mm: f64,
}

fn check_counts(grid: (u32, u32)) -> Result<(), Error> {
    check::counts(grid, "circles", "one row of circles does not fix its pose")
}

/// Column and row of an id.
fn place(id: u32, columns: u32) -> (f64, f64) {
    (f64::from(id % columns), f64::from(id / columns))
}

impl Family for CircleGrid {
    fn grid(&self) -> (u32, u32) {
        (self.columns, self.rows)
    }

    fn pitch_mm(&self) -> f64 {
        self.pitch_mm
    }

    fn lengths_mm(&self) -> Vec<(&'static str, f64)> {
        vec![("pitch_mm", self.pitch_mm)]
    }

    fn resized(&self, factor: f64) -> TargetModel {
        let Self { columns, rows, pitch_mm } = *self;
        TargetModel::CircleGrid { columns, rows, pitch_mm: pitch_mm * factor }
    }

    fn in_plane(&self, id: u32) -> Vector2<f64> {
        let (column, row) = place(id, self.columns);
        Vector2::new(column, row) * (1e-3 * self.pitch_mm)
    }

    fn turns(&self) -> Turns {
        if self.columns == self.rows { Turns::Quarter } else { Turns::Half }
    }

    fn check_counts(&self) -> Result<(), Error> {
        check_counts(self.grid())
    }

    fn disc_diameter_mm(&self, _: u32) -> f64 {
        DISC_SHARE * self.pitch_mm
    }

    fn art(&self, target: &TargetModel) -> Result<Art, Error> {
        Ok(print::circles(target))
    }

    fn texture(&self, target: &TargetModel) -> Option<Texture> {
        Some(Texture::circles(target))
    }

    fn in_words(&self) -> String {
        let Self { columns, rows, pitch_mm } = self;
        format!("Circle grid, {columns} x {rows} circles, {pitch_mm} mm from centre to centre")
    }
}

impl Family for AsymmetricCircleGrid {
    fn grid(&self) -> (u32, u32) {
        (self.columns, self.rows)
    }

    fn pitch_mm(&self) -> f64 {
        self.pitch_mm
    }

    fn lengths_mm(&self) -> Vec<(&'static str, f64)> {
        vec![("pitch_mm", self.pitch_mm)]
    }

    fn resized(&self, factor: f64) -> TargetModel {
        let Self { columns, rows, pitch_mm } = *self;
        TargetModel::AsymmetricCircleGrid { columns, rows, pitch_mm: pitch_mm * factor }
    }

    fn in_plane(&self, id: u32) -> Vector2<f64> {
        let (column, row) = place(id, self.columns);
        Vector2::new(2.0 * column + row % 2.0, row) * (1e-3 * self.pitch_mm)
    }

    fn turns(&self) -> Turns {
        if self.rows.is_multiple_of(2) { Turns::Half } else { Turns::None }
    }

    fn check_counts(&self) -> Result<(), Error> {
        check_counts(self.grid())
    }

    /// The nearest neighbour is in the next row.
    fn disc_diameter_mm(&self, _: u32) -> f64 {
        DISC_SHARE * std::f64::consts::SQRT_2 * self.pitch_mm
    }

    fn art(&self, target: &TargetModel) -> Result<Art, Error> {
        Ok(print::circles(target))
    }

    fn texture(&self, target: &TargetModel) -> Option<Texture> {
        Some(Texture::circles(target))
    }

    fn in_words(&self) -> String {
        let Self { columns, rows, pitch_mm } = self;
        format!(
            "Asymmetric circle grid, {rows} rows of {columns} circles, {pitch_mm} mm from row to row"
        )
    }
}

impl Family for ModifiedCircleGrid {
    fn grid(&self) -> (u32, u32) {
        (self.columns, self.rows)
    }

    fn pitch_mm(&self) -> f64 {
        self.pitch_mm
    }

    fn lengths_mm(&self) -> Vec<(&'static str, f64)> {
        vec![("pitch_mm", self.pitch_mm)]
    }

    fn resized(&self, factor: f64) -> TargetModel {
        let Self { columns, rows, pitch_mm } = *self;
        TargetModel::ModifiedCircleGrid { columns, rows, pitch_mm: pitch_mm * factor }
    }

    fn in_plane(&self, id: u32) -> Vector2<f64> {
        let (column, row) = place(id, self.columns);
        Vector2::new(column, row - f64::from(self.rows - 1)) * (1e-3 * self.pitch_mm)
    }

    fn check_counts(&self) -> Result<(), Error> {
        check_counts(self.grid())
    }

    fn disc_diameter_mm(&self, id: u32) -> f64 {
        let (usual, larger) = MODIFIED_SHARES;
        self.pitch_mm * if id == (self.rows - 1) * self.columns { larger } else { usual }
    }

    fn art(&self, target: &TargetModel) -> Result<Art, Error> {
        Ok(print::circles(target))
    }

    fn texture(&self, target: &TargetModel) -> Option<Texture> {
        Some(Texture::circles(target))
    }

    fn in_words(&self) -> String {
        let Self { columns, rows, pitch_mm } = self;
        format!(
            "Circle grid with a larger one, {columns} x {rows} circles, {pitch_mm} mm from centre to centre"
        )
    }
}
