//! Letters of dots, for images.

use image::{Rgb, RgbImage};

/// Dots from the left of a letter to that of the next.
pub(super) const ADVANCE: i64 = 6;
/// Rows of dots, two of them below the line.
pub(super) const ROWS: i64 = 9;
const COLUMNS: i64 = 5;

/// Small letters, digits and what stands between numbers; anything else is a gap. Rows from the
/// top, the leftmost dot the highest of five bits.
#[rustfmt::skip]
const GLYPHS: [(char, [u8; 9]); 38] = [
    ('0', [14, 17, 19, 21, 25, 17, 14, 0, 0]),
    ('1', [4, 12, 4, 4, 4, 4, 14, 0, 0]),
    ('2', [14, 17, 1, 6, 8, 16, 31, 0, 0]),
    ('3', [14, 17, 1, 6, 1, 17, 14, 0, 0]),
    ('4', [2, 6, 10, 18, 31, 2, 2, 0, 0]),
    ('5', [31, 16, 30, 1, 1, 17, 14, 0, 0]),
    ('6', [6, 8, 16, 30, 17, 17, 14, 0, 0]),
    ('7', [31, 1, 2, 4, 8, 8, 8, 0, 0]),
    ('8', [14, 17, 17, 14, 17, 17, 14, 0, 0]),
    ('9', [14, 17, 17, 15, 1, 2, 12, 0, 0]),
    ('.', [0, 0, 0, 0, 0, 12, 12, 0, 0]),
    (',', [0, 0, 0, 0, 0, 12, 4, 8, 0]),
    ('a', [0, 0, 14, 1, 15, 17, 15, 0, 0]),
    ('b', [16, 16, 30, 17, 17, 17, 30, 0, 0]),
    ('c', [0, 0, 14, 17, 16, 17, 14, 0, 0]),
    ('d', [1, 1, 15, 17, 17, 17, 15, 0, 0]),
    ('e', [0, 0, 14, 17, 31, 16, 14, 0, 0]),
    ('f', [6, 9, 8, 28, 8, 8, 8, 0, 0]),
    ('g', [0, 0, 15, 17, 17, 17, 15, 1, 14]),
    ('h', [16, 16, 30, 17, 17, 17, 17, 0, 0]),
    ('i', [4, 0, 12, 4, 4, 4, 14, 0, 0]),
    ('j', [2, 0, 6, 2, 2, 2, 2, 18, 12]),
    ('k', [16, 16, 18, 20, 24, 20, 18, 0, 0]),
    ('l', [12, 4, 4, 4, 4, 4, 14, 0, 0]),
    ('m', [0, 0, 26, 21, 21, 21, 21, 0, 0]),
    ('n', [0, 0, 30, 17, 17, 17, 17, 0, 0]),
    ('o', [0, 0, 14, 17, 17, 17, 14, 0, 0]),
    ('p', [0, 0, 30, 17, 17, 17, 30, 16, 16]),
    ('q', [0, 0, 15, 17, 17, 17, 15, 1, 1]),
    ('r', [0, 0, 22, 25, 16, 16, 16, 0, 0]),
    ('s', [0, 0, 15, 16, 14, 1, 30, 0, 0]),
    ('t', [8, 8, 28, 8, 8, 9, 6, 0, 0]),
    ('u', [0, 0, 17, 17, 17, 19, 13, 0, 0]),
    ('v', [0, 0, 17, 17, 17, 10, 4, 0, 0]),
    ('w', [0, 0, 17, 17, 21, 21, 10, 0, 0]),
    ('x', [0, 0, 17, 10, 4, 10, 17, 0, 0]),
    ('y', [0, 0, 17, 17, 17, 17, 15, 1, 14]),
    ('z', [0, 0, 31, 2, 4, 8, 31, 0, 0]),
];

/// How text is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pen {
    /// Side of a dot, px.
    pub dot: i64,
    /// Of the letters.
    pub colour: Rgb<u8>,
    /// Of a rim around them, one dot wide.
    pub rim: Option<Rgb<u8>>,
}

/// Width of a text in dots.
pub(super) fn width(text: &str) -> i64 {
    ADVANCE * text.chars().count() as i64 - (ADVANCE - COLUMNS)
}

/// Writes with the top left dot of the text at a pixel. What is outside of the image is left out.
pub(super) fn write(picture: &mut RgbImage, (x, y): (i64, i64), text: &str, pen: Pen) {
    let dots: Vec<(i64, i64)> = dots(text).collect();
    for (offset, colour) in [(1, pen.rim), (0, Some(pen.colour))] {
        let Some(colour) = colour else { continue };
        for (column, row) in &dots {
            let at = |k: i64| (k - offset) * pen.dot;
            let side = (2 * offset + 1) * pen.dot;
            square(picture, (x + at(*column), y + at(*row)), side, colour);
        }
    }
}

fn dots(text: &str) -> impl Iterator<Item = (i64, i64)> {
    text.chars().enumerate().flat_map(|(k, letter)| {
        let rows = GLYPHS.iter().find(|g| g.0 == letter).map_or([0; 9], |g| g.1);
        let set = move |(row, column): &(i64, i64)| rows[*row as usize] >> (4 - column) & 1 == 1;
        let all = (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| (row, column)));
        all.filter(set).map(move |(row, column)| (ADVANCE * k as i64 + column, row))
    })
}

/// Fills a square; what is outside of the image is left out.
pub(super) fn square(picture: &mut RgbImage, (x, y): (i64, i64), side: i64, colour: Rgb<u8>) {
    let (width, height) = (i64::from(picture.width()), i64::from(picture.height()));
    for y in y.max(0)..(y + side).min(height) {
        for x in x.max(0)..(x + side).min(width) {
            picture.put_pixel(x as u32, y as u32, colour);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_have_their_width_and_stay_in_the_picture() {
        let (white, black) = (Rgb([255; 3]), Rgb([0; 3]));
        let pen = Pen { dot: 2, colour: white, rim: None };
        let mut picture = RgbImage::new(100, 30);
        write(&mut picture, (4, 4), "x 10", pen);
        let columns: Vec<u32> =
            (0..100).filter(|x| (0..30).any(|y| *picture.get_pixel(*x, y) == white)).collect();
        assert_eq!(columns.first(), Some(&4));
        // the last digit has no dots in its last column
        assert_eq!(columns.last(), Some(&(4 + 2 * width("x 10") as u32 - 1)));
        for at in [(-7, -5), (95, 28), (1000, 1000)] {
            write(&mut picture, at, "8", Pen { rim: Some(black), ..pen });
        }
    }
}
