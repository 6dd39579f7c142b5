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
            kinds::Kind,
            look::{Circles, Look},
        },
        texture::Texture,
    },
};

/// Diameter of a circle over the distance between neighbours.
const DISC_SHARE: f64 = 0.5;
/// Diameters of the usual and of the larger circle of ROS-Industrial's grid, over the distance
/// between neighbours: circles of 10 and 20 mm, 25 mm apart.
const MODIFIED_SHARES: (f64, f64) = (0.4, 0.8);

pub(in crate::model::target) const PLAIN: Kind = Kind {
    name: "circle-grid",
    example: || TargetModel::CircleGrid { columns: 7, rows: 5, pitch_mm: 20.0 },
    counts: &["columns", "rows"],
    help: "Grid of so many circles: columns x rows",
};
pub(in crate::model::target) const ASYMMETRIC: Kind = Kind {
    name: "asymmetric-circle-grid",
    example: || TargetModel::AsymmetricCircleGrid { columns: 4, rows: 11, pitch_mm: 20.0 },
    counts: &["columns", "rows"],
    help: "OpenCV's asymmetric grid: circles in a row x rows",
};
pub(in crate::model::target) const WITH_LARGER: Kind = Kind {
    name: "modified-circle-grid",
    example: || TargetModel::ModifiedCircleGrid { columns: 10, rows: 8, pitch_mm: 20.0 },
    counts: &["columns", "rows"],
    help: "ROS-Industrial's grid with one larger circle: columns x rows",
};

pub(in crate::model::target) struct CircleGrid {
    pub circles: Circles,
    pub columns: u32,
    pub rows: u32,
    pub pitch_mm: f64,
}

impl Family for CircleGrid {
    fn look(&self) -> Look {
        Look::Circles(self.circles)
    }

    fn grid(&self) -> (u32, u32) {
        (self.columns, self.rows)
    }

    fn lengths_mm(&self) -> Vec<(&'static str, f64)> {
        vec![("pitch_mm", self.pitch_mm)]
    }

    fn in_plane(&self, id: u32) -> Vector2<f64> {
        let (column, row) = (f64::from(id % self.columns), f64::from(id / self.columns));
        let at = match self.circles {
            Circles::Plain => Vector2::new(column, row),
            Circles::Asymmetric => Vector2::new(2.0 * column + row % 2.0, row),
            Circles::WithLarger => Vector2::new(column, row - f64::from(self.rows - 1)),
        };
        at * (1e-3 * self.pitch_mm)
    }

    fn turns(&self) -> Turns {
        match self.circles {
            Circles::Plain if self.columns == self.rows => Turns::Quarter,
            Circles::Plain => Turns::Half,
            Circles::Asymmetric if self.rows.is_multiple_of(2) => Turns::Half,
            Circles::Asymmetric | Circles::WithLarger => Turns::None,
        }
    }

    fn check_counts(&self) -> Result<(), Error> {
        check::counts(self.grid(), "circles", "one row of circles does not fix its pose")
    }

    fn disc_diameter_mm(&self, id: u32) -> f64 {
        let (usual, larger) = MODIFIED_SHARES;
        match self.circles {
            Circles::Plain => DISC_SHARE * self.pitch_mm,
            // the nearest neighbour is in the next row
            Circles::Asymmetric => DISC_SHARE * std::f64::consts::SQRT_2 * self.pitch_mm,
            Circles::WithLarger if id == (self.rows - 1) * self.columns => self.pitch_mm * larger,
            Circles::WithLarger => self.pitch_mm * usual,
        }
    }

    fn art(&self, target: &TargetModel) -> Result<Art, Error> {
        Ok(print::circles(target))
    }

    fn texture(&self, target: &TargetModel) -> Option<Texture> {
        Some(Texture::circles(target))
    }

    fn in_words(&self) -> String {
        let Self { columns, rows, pitch_mm, .. } = self;
        let (what, apart) = match self.circles {
            Circles::Plain => ("Circle grid", "centre to centre"),
            Circles::WithLarger => ("Circle grid with a larger one", "centre to centre"),
            Circles::Asymmetric => {
                return format!(
                    "Asymmetric circle grid, {rows} rows of {columns} circles, {pitch_mm} mm from row to row"
                );
            }
        };
        format!("{what}, {columns} x {rows} circles, {pitch_mm} mm from {apart}")
    }
}
