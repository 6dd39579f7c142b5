//! Dimensions that no target has.

use super::kinds::TargetModel;
use crate::{Error, model::dictionary::Dictionary};

/// Most corners a board may declare; larger counts are mistakes or attacks.
const MOST_CORNERS: u64 = 100_000;

impl TargetModel {
    /// Refuses dimensions that no target has, and more tags than a dictionary has.
    ///
    /// # Errors
    /// What is wrong, and what it should be.
    pub fn check(&self) -> Result<(), Error> {
        self.family(|family| {
            family.check_counts()?;
            for (name, length) in family.lengths_mm() {
                check_length(name, length)?;
            }
            family.check()
        })
    }
}

/// A board needs two columns and two rows of what it has.
pub(super) fn counts((columns, rows): (u32, u32), what: &str, fewest: &str) -> Result<(), Error> {
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

/// A grid of tags needs one of them.
pub(super) fn tag_counts(tags_x: u32, tags_y: u32, grid: (u32, u32)) -> Result<(), Error> {
    if tags_x < 1 || tags_y < 1 {
        return invalid(format!("{tags_x} x {tags_y} tags; a board needs at least 1 x 1"));
    }
    counts(grid, "inner corners", "one row of corners does not fix its pose")
}

/// Every tag of the board must be in the dictionary.
pub(super) fn markers((name, first, count): (&str, u32, u64)) -> Result<(), Error> {
    let Some(dictionary) = Dictionary::named(name) else {
        return invalid(format!(
            "the dictionary {name:?} is not known; write OpenCV's name, such as DICT_4X4_50, \
             DICT_6X6_250 or DICT_APRILTAG_36h11"
        ));
    };
    let end = u64::from(first) + count;
    if end > dictionary.len() as u64 {
        return invalid(format!(
            "markers {first} to {} are needed, but {name} ends at {}: take fewer markers or a \
             larger dictionary",
            end.saturating_sub(1),
            dictionary.len().saturating_sub(1)
        ));
    }
    Ok(())
}

pub(super) fn invalid(what: String) -> Result<(), Error> {
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
