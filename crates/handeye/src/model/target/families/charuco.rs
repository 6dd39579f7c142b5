//! A checkerboard with ArUco markers in its white squares.

use nalgebra::Vector2;

use crate::{
    Error, TargetModel,
    model::{
        dictionary::Dictionary,
        print::{self, Art},
        target::{
            check,
            family::{Family, Markers},
            kinds::Kind,
            look::{Look, MarkedSquares},
        },
        texture::Texture,
    },
};

pub(in crate::model::target) const KIND: Kind = Kind {
    name: "charuco",
    example: || TargetModel::Charuco {
        squares_x: 7,
        squares_y: 5,
        square_mm: 35.0,
        marker_mm: 26.0,
        dictionary: "DICT_5X5_100".into(),
        legacy: false,
        first_id: 0,
    },
    counts: &["squares_x", "squares_y"],
    help: "ChArUco board of so many squares: columns x rows",
};

pub(in crate::model::target) struct Charuco<'a> {
    pub squares_x: u32,
    pub squares_y: u32,
    pub square_mm: f64,
    pub marker_mm: f64,
    pub dictionary: &'a str,
    pub legacy: bool,
    pub first_id: u32,
}

impl Charuco<'_> {
    fn white_first(&self) -> bool {
        self.legacy && self.squares_y.is_multiple_of(2)
    }
}

impl Family for Charuco<'_> {
    fn look(&self) -> Look {
        Look::MarkedSquares(MarkedSquares {
            squares: (self.squares_x, self.squares_y),
            share: self.marker_mm / self.square_mm,
            white_first: self.white_first(),
            dictionary: self.dictionary.into(),
            first_id: self.first_id,
        })
    }

    fn grid(&self) -> (u32, u32) {
        (self.squares_x.saturating_sub(1), self.squares_y.saturating_sub(1))
    }

    fn lengths_mm(&self) -> Vec<(&'static str, f64)> {
        vec![("square_mm", self.square_mm), ("marker_mm", self.marker_mm)]
    }

    fn in_plane(&self, id: u32) -> Vector2<f64> {
        let (columns, _) = self.grid();
        let (column, row) = (f64::from(id % columns), f64::from(id / columns));
        Vector2::new(column + 1.0, row + 1.0) * (1e-3 * self.square_mm)
    }

    fn markers(&self) -> Option<Markers<'_>> {
        let squares = u64::from(self.squares_x) * u64::from(self.squares_y);
        Some((self.dictionary, self.first_id, squares / 2))
    }

    fn check(&self) -> Result<(), Error> {
        let Self { square_mm, marker_mm, .. } = self;
        if marker_mm >= square_mm {
            return check::invalid(format!(
                "marker_mm = {marker_mm} must be smaller than square_mm = {square_mm}"
            ));
        }
        self.markers().map_or(Ok(()), check::markers)
    }

    fn art(&self, _: &TargetModel) -> Result<Art, Error> {
        let Self { squares_x, squares_y, square_mm, marker_mm, .. } = *self;
        let white_first = self.white_first();
        let mut art = print::checkerboard(squares_x, squares_y, square_mm, white_first, (0.0, 0.0));
        let dictionary = print::named(self.dictionary)?;
        let inset = 0.5 * (square_mm - marker_mm);
        for (i, j) in (0..squares_y).flat_map(|j| (0..squares_x).map(move |i| (i, j))) {
            let (column, row) = (i as usize, j as usize);
            let marker = print::marker_of_square(column, row, squares_x as usize, white_first);
            let Some(k) = marker else { continue };
            let id = self.first_id.saturating_add(k);
            print::check_marker(&dictionary, id)?;
            let at = (f64::from(i) * square_mm + inset, f64::from(j) * square_mm + inset);
            let square = print::Square::upright(at, marker_mm);
            art.shapes.extend(print::marker(&dictionary, id, &square));
        }
        Ok(art)
    }

    fn texture(&self, _: &TargetModel) -> Option<Texture> {
        let squares = (self.squares_x, self.squares_y);
        let share = self.marker_mm / self.square_mm;
        let dictionary = Dictionary::named(self.dictionary)?;
        let board = Texture::squares(squares, self.square_mm, Vector2::zeros());
        Some(board.with_markers(dictionary, share, self.white_first(), self.first_id))
    }

    fn in_words(&self) -> String {
        let Self { squares_x, squares_y, square_mm, marker_mm, dictionary, .. } = self;
        let layout = if self.legacy { ", legacy layout" } else { "" };
        let from =
            if self.first_id > 0 { format!(" from {}", self.first_id) } else { String::new() };
        format!(
            "ChArUco, {squares_x} x {squares_y} squares of {square_mm} mm, markers of {marker_mm} mm, \
             {dictionary}{from}{layout}"
        )
    }
}
