//! Findings about the target's size and shape.

use super::{Found, row::Row};

/// What is found about the target.
#[derive(Debug, Clone, PartialEq)]
pub enum TargetFinding {
    /// It has another size than declared.
    Size(Size),
    /// Distances that were measured elsewhere are of another scale than the robot's.
    Distances {
        /// True over measured distances.
        value: f64,
        /// Its standard deviation.
        sigma: f64,
    },
    /// Under another size most captures agree, which they do not under the declared one.
    ExplainsAll(Size),
    /// It is longer or shorter along its y than its x makes it.
    Uneven {
        /// By which share.
        share: f64,
        /// Its standard deviation.
        sigma: f64,
    },
    /// The corners in the images say that it is bent.
    Bent {
        /// From its highest to its lowest corner, mm.
        peak_to_valley_mm: f64,
    },
    /// The scans say that it is bent.
    NotFlat {
        /// Captures whose scans say so.
        captures: usize,
        /// From its highest to its lowest corner, mm.
        peak_to_valley_mm: f64,
        /// Its standard deviation.
        sigma_mm: f64,
    },
}

/// A size that is not the declared one.
#[derive(Debug, Clone, PartialEq)]
pub struct Size {
    /// Found over declared.
    pub value: f64,
    /// Its standard deviation.
    pub sigma: f64,
    /// The declared pitch, mm.
    pub declared_mm: f64,
    /// The usual mistake that makes it.
    pub cause: Option<String>,
    /// Whether it is beyond what a printer does.
    pub beyond_printing: bool,
    /// Which size the answer uses.
    pub answer: SizeOfAnswer,
}

/// Which size of the target an answer uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SizeOfAnswer {
    /// The estimated one.
    Estimated,
    /// The declared one.
    Declared,
    /// The declared one, which the user has measured.
    Measured,
}

impl TargetFinding {
    /// What was seen and where, with its numbers.
    pub fn message(&self) -> String {
        match self {
            Self::Size(size) => size.message(),
            Self::ExplainsAll(size) => size.as_explanation(),
            Self::Distances { value, sigma } => match units_of(*value) {
                Some(units) => format!(
                    "target poses and robot poses have different length units ({units}): distances to the target are \
                     {:.4} times too large",
                    1.0 / value
                ),
                None => format!(
                    "the robot's motions say that distances to the target are {:.2} +- {:.2} % {} than measured: the \
                     unit or the scale of the measurements, or the robot's own scale, is wrong",
                    (value - 1.0).abs() * 100.0,
                    sigma * 100.0,
                    if *value > 1.0 { "longer" } else { "shorter" }
                ),
            },
            Self::Uneven { share, sigma } => format!(
                "the board is {:.2} +- {:.2} % {} along y than along x: the answer uses that shape; measure the print along both sides, and use a print with the same square size in x and y",
                share.abs() * 100.0,
                sigma * 100.0,
                if *share > 0.0 { "longer" } else { "shorter" }
            ),
            Self::Bent { peak_to_valley_mm } => format!(
                "the corners in the images show that the board is bent by {peak_to_valley_mm:.2} mm from its highest \
                 to its lowest corner: the answer uses that shape; lay it on a flat plate and check it with a \
                 straight edge"
            ),
            Self::NotFlat { captures, peak_to_valley_mm, sigma_mm } => format!(
                "in the scans of {captures} captures the board is bent by {peak_to_valley_mm:.3} +- {sigma_mm:.3} mm \
                 from its highest to its lowest corner: lay it on a flat plate and check it with a straight edge; if it is flat, the 3D camera distorts flat surfaces"
            ),
        }
    }
}

const TARGET_SIZE_CONTRADICTED: Row = Row::changes(
    "target-size-contradicted",
    "the captures contradict the measured size of the target, which the answer uses",
    "measure the target again; if it is right, the focal length or the robot's own scale is wrong",
);
const TARGET_SCALE: Row = Row::changes(
    "target-scale",
    "the answer uses the estimated size of the target, not the declared one",
    "measure the target and declare its size",
);
const BOARD_UNEVEN: Row = Row::changes(
    "board-uneven",
    "the answer uses a board that is longer or shorter along y, not the declared one",
    "measure the print along both sides, and print it again or have a plate made",
);
const BOARD_BENT: Row = Row::changes(
    "board-bent",
    "the answer uses a bent board, not a flat one",
    "glue the board to a flat plate",
);
const BOARD_NOT_FLAT: Row = Row::info("board-not-flat");

/// All codes of this subject.
pub(super) const ROWS: &[&Row] =
    &[&TARGET_SIZE_CONTRADICTED, &TARGET_SCALE, &BOARD_UNEVEN, &BOARD_BENT, &BOARD_NOT_FLAT];

impl Found for TargetFinding {
    fn row(&self) -> &'static Row {
        match self {
            Self::Size(Size { answer: SizeOfAnswer::Measured, .. }) => &TARGET_SIZE_CONTRADICTED,
            Self::Size(_) | Self::Distances { .. } | Self::ExplainsAll(_) => &TARGET_SCALE,
            Self::Uneven { .. } => &BOARD_UNEVEN,
            Self::Bent { .. } => &BOARD_BENT,
            Self::NotFlat { .. } => &BOARD_NOT_FLAT,
        }
    }

    fn message(&self) -> String {
        TargetFinding::message(self)
    }

    fn headline(&self) -> Option<String> {
        match self {
            Self::Size(size) if size.answer == SizeOfAnswer::Estimated => Some(format!(
                "the answer uses the estimated size of the target ({:.3} mm), not the declared one ({:.3} mm)",
                size.value * size.declared_mm,
                size.declared_mm
            )),
            Self::Size(size) if size.answer == SizeOfAnswer::Measured => Some(format!(
                "the answer uses the measured size of the target ({:.2} mm), but {:.2} mm fits the captures",
                size.declared_mm,
                size.value * size.declared_mm
            )),
            Self::Uneven { share, .. } => Some(format!(
                "the answer uses a board that is {:.2} % {} along y, not the declared one",
                share.abs() * 100.0,
                if *share > 0.0 { "longer" } else { "shorter" }
            )),
            Self::Bent { peak_to_valley_mm } => Some(format!(
                "the answer uses a board that is bent by {peak_to_valley_mm:.2} mm, not a flat one"
            )),
            _ => None,
        }
    }

    fn data(&self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Size(size) | Self::ExplainsAll(size) => vec![
                ("value", size.value),
                ("sigma", size.sigma),
                ("declared_mm", size.declared_mm),
                ("found_mm", size.value * size.declared_mm),
            ],
            Self::Distances { value, sigma } => vec![("value", *value), ("sigma", *sigma)],
            Self::Uneven { share, sigma } => vec![("share", *share), ("sigma", *sigma)],
            Self::Bent { peak_to_valley_mm } => vec![("peak_to_valley_mm", *peak_to_valley_mm)],
            Self::NotFlat { peak_to_valley_mm, sigma_mm, .. } => {
                vec![("peak_to_valley_mm", *peak_to_valley_mm), ("sigma_mm", *sigma_mm)]
            }
        }
    }
}

/// Lengths in proportions like these are of two units.
const UNITS: [(f64, &str); 3] = [
    (1000.0, "millimetres and metres"),
    (10.0, "millimetres and centimetres"),
    (100.0, "centimetres and metres"),
];
/// Within this share: targets and cameras are better than that.
const ABOUT: f64 = 0.03;

/// The two units that a scale would be of.
fn units_of(scale: f64) -> Option<&'static str> {
    let is = |factor: f64| (scale / factor - 1.0).abs() < ABOUT;
    UNITS.iter().find(|(factor, _)| is(*factor) || is(1.0 / factor)).map(|(_, units)| *units)
}

impl Size {
    fn message(&self) -> String {
        let Self { value, sigma, declared_mm, .. } = self;
        let (percent, sigma) = ((value - 1.0).abs() * 100.0, sigma * 100.0);
        let which = if *value > 1.0 { "larger" } else { "smaller" };
        let size = format!("{:.3} mm instead of {declared_mm:.3} mm", declared_mm * value);
        if self.beyond_printing {
            return format!(
                "the target is {percent:.1} +- {sigma:.1} % {which} than declared ({size}){}; measure it, and correct \
                 [target]. If the declared size is right, the focal length or the robot's own scale is wrong",
                self.because()
            );
        }
        match self.answer {
            SizeOfAnswer::Estimated => format!(
                "the target is {percent:.2} +- {sigma:.2} % {which} than declared ({size}): the answer uses the estimated size; measure the print with a caliper and declare the measured size. If the declared size is right, the focal \
                 length or the robot's own scale is wrong"
            ),
            _ => format!(
                "the data say that the target is {percent:.2} +- {sigma:.2} % {which} than declared ({size}), but it \
                 is declared as measured, and the answer uses the declared size: the focal length or the robot's own \
                 scale is wrong"
            ),
        }
    }

    fn as_explanation(&self) -> String {
        let declared = (self.declared_mm * 1e3).round() / 1e3;
        format!(
            "the target is {:.4} +- {:.4} times as large as declared ({:.3} mm instead of {declared} mm){}; measure \
             it, and correct it",
            self.value,
            self.sigma,
            declared * self.value,
            self.because()
        )
    }

    fn because(&self) -> String {
        self.cause.as_ref().map_or(String::new(), |cause| format!(": {cause}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(value: f64, answer: SizeOfAnswer) -> Size {
        Size { value, sigma: 1e-3, declared_mm: 30.0, cause: None, beyond_printing: false, answer }
    }

    #[test]
    fn the_size_that_the_answer_uses_is_in_the_headline() {
        let estimated = TargetFinding::Size(size(0.98, SizeOfAnswer::Estimated));
        assert_eq!(estimated.row().code, "target-scale");
        let words = "the answer uses the estimated size of the target (29.400 mm), not the declared one (30.000 mm)";
        assert_eq!(estimated.headline().as_deref(), Some(words));
        let measured = TargetFinding::Size(size(0.98, SizeOfAnswer::Measured));
        assert_eq!(measured.row().code, "target-size-contradicted");
        assert!(measured.headline().is_some_and(|h| h.contains("29.40 mm fits the captures")));
    }

    #[test]
    fn a_size_beyond_printing_is_said_with_its_cause() {
        let cause = Some("centimetres taken for inches".to_owned());
        let wrong = Size { beyond_printing: true, cause, ..size(1.5, SizeOfAnswer::Declared) };
        let words = TargetFinding::Size(wrong.clone()).message();
        assert!(
            words.contains("50.0 +- 0.1 % larger than declared (45.000 mm instead of 30.000 mm)"),
            "{words}"
        );
        assert!(words.contains(": centimetres taken for inches; measure it"), "{words}");
        let words = TargetFinding::ExplainsAll(wrong).message();
        assert!(words.contains("(45.000 mm instead of 30 mm): centimetres"), "{words}");
    }
}
