//! Dimensions that no target has.

use crate::model::target::kinds::TargetModel;
use crate::{Error, model::dictionary::Dictionary};

/// Most corners a board may declare; larger counts are mistakes or attacks.
const MOST_CORNERS: u64 = 100_000;
/// Gap over tag: larger ones are gaps in millimetres.
const WIDEST_SPACING: f64 = 2.0;
/// Largest border of a tag, bits.
const WIDEST_BORDER: u32 = 2;

impl TargetModel {
    /// Refuses dimensions that no target has, and more tags than a dictionary has.
    ///
    /// # Errors
    /// What is wrong, and what it should be.
    pub fn check(&self) -> Result<(), Error> {
        self.check_counts()?;
        for (name, length) in self.lengths_mm() {
            check_length(name, length)?;
        }
        match self {
            Self::Charuco { square_mm, marker_mm, .. } if marker_mm >= square_mm => invalid(
                format!("marker_mm = {marker_mm} must be smaller than square_mm = {square_mm}"),
            ),
            Self::Charuco { dictionary, .. } => self.check_tags(dictionary),
            Self::Aprilgrid { spacing, border_bits, family, .. } => {
                check_spacing(*spacing)?;
                check_border(*border_bits)?;
                self.check_tags(family.dictionary())
            }
            Self::TagGrid { dictionary, .. } => self.check_tags(dictionary),
            _ => Ok(()),
        }
    }

    fn check_counts(&self) -> Result<(), Error> {
        let (columns, rows) = self.grid();
        let (what, fewest) = match self {
            Self::Tag { .. } | Self::Sphere { .. } => return Ok(()),
            Self::Aprilgrid { tags_x, tags_y, .. } | Self::TagGrid { tags_x, tags_y, .. }
                if *tags_x < 1 || *tags_y < 1 =>
            {
                return invalid(format!("{tags_x} x {tags_y} tags; a board needs at least 1 x 1"));
            }
            _ if self.has_circles() => ("circles", "one row of circles does not fix its pose"),
            _ => ("inner corners", "one row of corners does not fix its pose"),
        };
        if columns < 2 || rows < 2 {
            return invalid(format!(
                "{columns} x {rows} {what}; a board needs at least 2 x 2 ({fewest})"
            ));
        }
        if u64::from(columns) * u64::from(rows) > MOST_CORNERS {
            return invalid(format!("{columns} x {rows} corners are more than {MOST_CORNERS}"));
        }
        Ok(())
    }

    fn lengths_mm(&self) -> Vec<(&'static str, f64)> {
        match *self {
            Self::Checkerboard { square_mm, .. } => vec![("square_mm", square_mm)],
            Self::Charuco { square_mm, marker_mm, .. } => {
                vec![("square_mm", square_mm), ("marker_mm", marker_mm)]
            }
            Self::Tag { size_mm, .. } => vec![("size_mm", size_mm)],
            Self::CircleGrid { pitch_mm, .. }
            | Self::AsymmetricCircleGrid { pitch_mm, .. }
            | Self::ModifiedCircleGrid { pitch_mm, .. } => vec![("pitch_mm", pitch_mm)],
            Self::Aprilgrid { tag_mm, .. } => vec![("tag_mm", tag_mm)],
            Self::TagGrid { tag_mm, gap_mm, .. } => vec![("tag_mm", tag_mm), ("gap_mm", gap_mm)],
            Self::Sphere { diameter_mm } => {
                diameter_mm.map(|d| ("diameter_mm", d)).into_iter().collect()
            }
        }
    }

    /// Every tag of the board must be in the dictionary.
    fn check_tags(&self, name: &str) -> Result<(), Error> {
        let Some((_, range)) = self.markers() else { return Ok(()) };
        let Some(dictionary) = Dictionary::named(name) else {
            return invalid(format!(
                "the dictionary {name:?} is not known; write OpenCV's name, such as DICT_4X4_50, \
                 DICT_6X6_250 or DICT_APRILTAG_36h11"
            ));
        };
        let last = range.end.saturating_sub(1);
        if range.end > dictionary.len() as u64 {
            return invalid(format!(
                "markers {} to {last} are needed, but {name} ends at {}: take fewer markers or a \
                 larger dictionary",
                range.start,
                dictionary.len().saturating_sub(1)
            ));
        }
        Ok(())
    }
}

fn invalid(what: String) -> Result<(), Error> {
    Err(Error::Invalid(format!("target: {what}")))
}

fn check_length(name: &str, length: f64) -> Result<(), Error> {
    if !(length.is_finite() && length > 0.0) {
        return invalid(format!("{name} = {length} must be a positive length in mm"));
    }
    if !(0.1..=5000.0).contains(&length) {
        return invalid(format!("{name} = {length} mm is no board's size; is it in millimetres?"));
    }
    Ok(())
}

fn check_spacing(spacing: f64) -> Result<(), Error> {
    if spacing > 0.0 && spacing <= WIDEST_SPACING {
        return Ok(());
    }
    invalid(format!(
        "spacing = {spacing} must be the gap between tags divided by tag_mm, such as 0.3"
    ))
}

fn check_border(bits: u32) -> Result<(), Error> {
    if (1..=WIDEST_BORDER).contains(&bits) {
        return Ok(());
    }
    invalid(format!("border_bits = {bits} must be 1, or 2 as in Kalibr's own drawings"))
}
