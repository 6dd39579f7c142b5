//! Targets on paper in true scale, and images with what was found in them.

mod letters;
mod marked;
mod pdf;
mod svg;

use handeye::{
    TargetModel,
    model::print::{self, Art, Shape},
};

pub use marked::{Marks, marked};
pub use pdf::pdf;
pub use svg::svg;

/// A sheet of paper, upright. Millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct Paper {
    /// `a4`, or `210x297`.
    pub name: String,
    /// Extent to the right.
    pub width: f64,
    /// Extent downwards.
    pub height: f64,
}

/// Papers by name, the smallest first.
const PAPERS: [(&str, f64, f64); 6] = [
    ("letter", 215.9, 279.4),
    ("a4", 210.0, 297.0),
    ("a3", 297.0, 420.0),
    ("a2", 420.0, 594.0),
    ("a1", 594.0, 841.0),
    ("a0", 841.0, 1189.0),
];

/// Why a target is not drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DrawingError {
    /// No paper has that name.
    #[error(
        "there is no paper {0:?}; write a4, a3, a2, a1, a0, letter, or a size in mm such as 300x400"
    )]
    UnknownPaper(String),
    /// The target is larger than the paper.
    #[error(
        "the target needs {width:.0} x {height:.0} mm with its rim and the ruler, more than {paper} has; {advice}"
    )]
    TooLarge {
        /// Extent of target, rim and ruler.
        width: f64,
        /// The same, downwards.
        height: f64,
        /// The paper's name.
        paper: String,
        /// What to do.
        advice: String,
    },
    /// No such target.
    #[error(transparent)]
    Target(#[from] handeye::Error),
}

impl Paper {
    /// The paper of a name, or of a size in mm: `a4`, `300x400`.
    ///
    /// # Errors
    /// [`DrawingError::UnknownPaper`].
    pub fn named(name: &str) -> Result<Self, DrawingError> {
        let lower = name.to_lowercase();
        let known = PAPERS.iter().find(|p| p.0 == lower).map(|p| (p.1, p.2));
        let (width, height) = known
            .or_else(|| size(&lower))
            .ok_or_else(|| DrawingError::UnknownPaper(name.into()))?;
        Ok(Self { name: lower, width, height })
    }

    fn turned(&self) -> Self {
        Self { name: self.name.clone(), width: self.height, height: self.width }
    }

    fn holds(&self, (width, height): (f64, f64)) -> bool {
        width <= self.width && height <= self.height
    }

    /// This way or turned, as the target lies on it.
    fn around(&self, needed: (f64, f64)) -> Option<Self> {
        [self.clone(), self.turned()].into_iter().find(|p| p.holds(needed))
    }
}

fn size(text: &str) -> Option<(f64, f64)> {
    let (width, height) = text.split_once('x')?;
    let side = |s: &str| s.trim().parse().ok().filter(|v| (10.0..=10_000.0).contains(v));
    Some((side(width)?, side(height)?))
}

/// Words on a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// Left end of the base line.
    pub x: f64,
    /// Base line.
    pub y: f64,
    /// Height of the letters' em.
    pub size: f64,
    /// ASCII only.
    pub text: String,
}

/// A sheet with everything on it. Millimetres from its top left, y down.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Extent to the right.
    pub width: f64,
    /// Extent downwards.
    pub height: f64,
    /// All that is black.
    pub shapes: Vec<Shape>,
    /// All that is written.
    pub texts: Vec<Text>,
}

/// Printers leave this white, mm.
const MARGIN: f64 = 5.0;
/// Height of ruler and caption, mm.
const FOOTER: f64 = 14.0;
/// Length of the ruler, mm.
const RULER: f64 = 100.0;
/// Thickness of the ruler's lines, mm.
const LINE: f64 = 0.2;
/// Size of the letters, mm.
const LETTERS: f64 = 2.6;

/// The target on a paper, upright or turned, with a ruler and a caption.
///
/// # Errors
/// A target that does not fit; the message names the smallest paper that does.
pub fn sheet(target: &TargetModel, paper: &Paper) -> Result<Sheet, DrawingError> {
    let art = print::art(target)?;
    let needed = needed(&art);
    let Some(paper) = paper.around(needed) else { return Err(too_large(needed, paper)) };
    let left = 0.5 * (paper.width - art.width);
    let free = paper.height - needed.1;
    let top = art.white_rim.max(MARGIN) + 0.5 * free;
    let mut sheet = Sheet {
        width: paper.width,
        height: paper.height,
        shapes: art.shapes.iter().map(|s| moved(s, left, top)).collect(),
        texts: vec![],
    };
    let footer = paper.height - MARGIN - FOOTER;
    draw_ruler(&mut sheet, MARGIN, footer);
    for (k, line) in [target.in_words(), ADVICE.into()].into_iter().enumerate() {
        let y = footer + 10.0 + 3.4 * k as f64;
        sheet.texts.push(Text { x: MARGIN, y, size: LETTERS, text: line });
    }
    Ok(sheet)
}

const ADVICE: &str = "Print at 100 %, measure the ruler: 100 mm. Then glue it onto something flat.";

fn needed(art: &Art) -> (f64, f64) {
    let rim = art.white_rim.max(MARGIN);
    let width = (art.width + 2.0 * rim).max(RULER + 4.0 * MARGIN);
    (width, rim + art.height + art.white_rim + FOOTER + MARGIN)
}

fn too_large(needed: (f64, f64), paper: &Paper) -> DrawingError {
    let fitting = PAPERS
        .iter()
        .map(|&(name, width, height)| Paper { name: name.into(), width, height })
        .find(|p| p.around(needed).is_some());
    let advice = match fitting {
        Some(p) => format!("{} fits", p.name),
        None => "no paper up to a0 fits: give a size in mm, or make the target smaller".into(),
    };
    DrawingError::TooLarge { width: needed.0, height: needed.1, paper: paper.name.clone(), advice }
}

fn moved(shape: &Shape, dx: f64, dy: f64) -> Shape {
    match *shape {
        Shape::Rectangle { x, y, width, height } => {
            Shape::Rectangle { x: x + dx, y: y + dy, width, height }
        }
        Shape::Disc { x, y, radius } => Shape::Disc { x: x + dx, y: y + dy, radius },
    }
}

/// A line from 0 to 100 mm with a tick each 10 mm, the middles of the ticks at the full
/// centimetres.
fn draw_ruler(sheet: &mut Sheet, left: f64, top: f64) {
    let half = 0.5 * LINE;
    let mut line = |x, y, width, height| {
        sheet.shapes.push(Shape::Rectangle { x, y, width, height });
    };
    line(left - half, top + 3.0, RULER + LINE, LINE);
    for k in 0..=10 {
        let height = if k % 5 == 0 { 3.0 } else { 2.0 };
        line(left + 10.0 * f64::from(k) - half, top + 3.0 - height, LINE, height);
    }
    for (mm, label) in [(0.0, "0"), (50.0, "50"), (100.0, "100 mm")] {
        let (x, y) = (left + mm, top + 6.2);
        sheet.texts.push(Text { x, y, size: LETTERS, text: label.into() });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn board(square_mm: f64) -> TargetModel {
        TargetModel::Checkerboard { columns: 9, rows: 6, square_mm }
    }

    #[test]
    fn the_paper_is_turned_where_the_board_needs_it() {
        let sheet = sheet(&board(25.0), &Paper::named("A4").unwrap()).unwrap();
        assert_eq!((sheet.width, sheet.height), (297.0, 210.0));
    }

    #[test]
    fn nothing_lies_in_the_margin_or_on_the_ruler() {
        let sheet = sheet(&board(20.0), &Paper::named("a4").unwrap()).unwrap();
        for shape in &sheet.shapes[..35] {
            let Shape::Rectangle { x, y, width, height } = *shape else { panic!("squares") };
            assert!(x >= MARGIN && x + width <= sheet.width - MARGIN);
            assert!(y >= MARGIN && y + height <= sheet.height - MARGIN - FOOTER);
        }
    }

    #[test]
    fn a_board_that_is_too_large_is_told_its_paper() {
        let message = sheet(&board(30.0), &Paper::named("a4").unwrap()).unwrap_err().to_string();
        assert_eq!(
            message,
            "the target needs 315 x 244 mm with its rim and the ruler, more than a4 has; a3 fits"
        );
        let message = sheet(&board(200.0), &Paper::named("a4").unwrap()).unwrap_err().to_string();
        assert!(
            message
                .ends_with("no paper up to a0 fits: give a size in mm, or make the target smaller")
        );
    }

    #[test]
    fn papers_have_names_or_sizes() {
        assert_eq!(Paper::named("300x400.5").unwrap().height, 400.5);
        for wrong in ["b7", "x", "0x5", "nanxnan", "-5x20"] {
            assert!(Paper::named(wrong).is_err(), "{wrong}");
        }
    }
}
