//! Which targets cannot be told apart when one picture shows both.

use std::{mem::discriminant, ops::Range};

use crate::model::target::kinds::TargetModel;

impl TargetModel {
    /// Which markers of which dictionary are on the board.
    fn markers(&self) -> Option<(String, Range<u64>)> {
        self.family(|family| {
            let (dictionary, first, count) = family.markers()?;
            Some((dictionary.to_owned(), u64::from(first)..u64::from(first) + count))
        })
    }

    /// Why two targets in one picture cannot be told apart; `None` if they can be. A picture does
    /// not tell sizes in millimetres: boards that differ in nothing else look the same.
    pub fn mistaken_for(&self, other: &TargetModel) -> Option<String> {
        if let (Some((name, own)), Some((others_name, others))) = (self.markers(), other.markers())
        {
            let (from, to) = (own.start.max(others.start), own.end.min(others.end));
            let shared = series(&name) == series(&others_name) && from < to;
            return shared.then(|| {
                let which = match to - from {
                    1 => format!("marker {from}"),
                    _ => format!("markers {from} to {}", to - 1),
                };
                format!("both have {which} of {name}: give one of them another first_id")
            });
        }
        let sorted = |(a, b): (u32, u32)| (a.min(b), a.max(b));
        let alike = discriminant(self) == discriminant(other)
            && sorted(self.grid()) == sorted(other.grid());
        let what = "both look the same: give one of them another number of corners, or markers";
        alike.then(|| what.into())
    }
}

/// The smaller dictionaries of one size of OpenCV's are the beginnings of the larger ones:
/// `DICT_6X6_50` of `DICT_6X6_250`.
fn series(dictionary: &str) -> &str {
    let is_count = |end: &str| !end.is_empty() && end.bytes().all(|b| b.is_ascii_digit());
    match dictionary.rsplit_once('_') {
        Some((front, end)) if is_count(end) => front,
        _ => dictionary,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn target(json: &str) -> TargetModel {
        serde_json::from_str(json).unwrap()
    }

    fn charuco(dictionary: &str, first_id: u32) -> TargetModel {
        target(&format!(
            r#"{{"kind":"charuco","squares_x":5,"squares_y":7,"square_mm":20,"marker_mm":15,"dictionary":"{dictionary}","first_id":{first_id}}}"#
        ))
    }

    #[test]
    fn boards_with_markers_of_their_own_differ() {
        let one = charuco("DICT_6X6_50", 0);
        // 35 squares hold 17 markers
        assert_eq!(one.mistaken_for(&charuco("DICT_6X6_250", 17)), None);
        assert_eq!(one.mistaken_for(&charuco("DICT_5X5_50", 0)), None);
        let message = one.mistaken_for(&charuco("DICT_6X6_250", 16)).unwrap();
        assert!(message.starts_with("both have marker 16 of DICT_6X6_50"), "{message}");
        let tag = target(r#"{"kind":"tag","dictionary":"DICT_6X6_50","id":3,"size_mm":40}"#);
        assert!(tag.mistaken_for(&one).is_some());
        let grid = |family: &str| {
            target(&format!(
                r#"{{"kind":"aprilgrid","tags_x":2,"tags_y":2,"tag_mm":20,"spacing":0.3,"family":"{family}"}}"#
            ))
        };
        assert_eq!(grid("36h10").mistaken_for(&grid("36h11")), None);
        assert!(grid("36h11").mistaken_for(&grid("36h11")).is_some());
    }

    #[test]
    fn boards_without_markers_differ_by_their_numbers_of_corners() {
        let board =
            |columns, rows, square_mm| TargetModel::Checkerboard { columns, rows, square_mm };
        assert_eq!(board(9, 6, 20.0).mistaken_for(&board(8, 6, 20.0)), None);
        assert!(board(9, 6, 20.0).mistaken_for(&board(6, 9, 30.0)).is_some());
        let circles = TargetModel::CircleGrid { columns: 9, rows: 6, pitch_mm: 20.0 };
        assert_eq!(board(9, 6, 20.0).mistaken_for(&circles), None);
        assert_eq!(board(9, 6, 20.0).mistaken_for(&charuco("DICT_6X6_50", 0)), None);
    }
}
