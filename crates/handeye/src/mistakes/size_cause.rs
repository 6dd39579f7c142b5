//! The usual mistakes about the size of a target, by the factor that each makes.

use super::thresholds::LIKE_FACTOR;
use crate::TargetModel;

/// True size over declared size, and the mistake.
const FACTORS: [(f64, &str); 8] = [
    (10.0, "the length was given in centimetres and counts as millimetres"),
    (0.1, "the declared length is ten times too large: millimetres were taken for centimetres"),
    (1e3, "the length was given in metres and counts as millimetres"),
    (
        1e-3,
        "the declared length is a thousand times too large: micrometres, or millimetres taken for metres",
    ),
    (25.4, "the length was given in inches and counts as millimetres"),
    (1.0 / 25.4, "the declared length is 25.4 times too large: millimetres were taken for inches"),
    (2.0, "half of the length was given"),
    (0.5, "twice the length was given: that of two squares, or of a circle grid's other pitch"),
];

/// The usual mistake that makes a target so many times as large as declared, in words.
pub fn cause_of_size(value: f64, target: &TargetModel) -> Option<String> {
    let is = |factor: f64| (value / factor - 1.0).abs() < LIKE_FACTOR;
    if let Some((_, words)) = FACTORS.into_iter().find(|(factor, _)| is(*factor)) {
        return Some(words.into());
    }
    let (columns, rows) = target.grid();
    [columns, rows].into_iter().filter(|n| *n > 2).find_map(|n| {
        let n = f64::from(n);
        // the whole width of n + 1 squares, divided by n corners; that of n - 1 squares between corners likewise
        let wrong = [(n / (n + 1.0), n + 1.0, n), (n / (n - 1.0), n - 1.0, n)];
        wrong.into_iter().find(|(factor, ..)| is(*factor)).map(|(_, right, counted)| {
            format!(
                "a length of {right:.0} squares was divided by {counted:.0}: squares and corners were mixed up"
            )
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_usual_mistakes_about_sizes_have_names() {
        let board = TargetModel::Checkerboard { columns: 9, rows: 6, square_mm: 30.0 };
        let cause = |value: f64| cause_of_size(value, &board).unwrap_or_default();
        assert!(cause(10.003).contains("centimetres"));
        assert!(cause(25.3).contains("inches"));
        assert!(cause(0.5).contains("two squares"));
        assert!(cause(9.0 / 8.0).contains("8 squares was divided by 9"));
        assert!(cause(6.0 / 7.0).contains("7 squares was divided by 6"));
        assert!(cause(0.0394).contains("taken for inches"));
        assert!(cause(1e-3).contains("thousand times"));
        assert_eq!(cause_of_size(1.05, &board), None);
    }
}
