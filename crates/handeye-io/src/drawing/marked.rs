//! A picture with the corners that were found in it.

use std::io::Cursor;

use handeye::{GrayImage, ImageCorner};
use image::{ImageFormat, Rgb, RgbImage};

/// Half the length of a cross, px.
const ARM: i64 = 5;
const CROSS: Rgb<u8> = Rgb([255, 40, 40]);
const FIRST: Rgb<u8> = Rgb([0, 120, 255]);
const DIGITS: Rgb<u8> = Rgb([0, 170, 60]);

/// Digits of 3 x 5 dots, rows from the top, the left dot the highest bit.
const GLYPHS: [[u8; 5]; 10] = [
    [7, 5, 5, 5, 7],
    [2, 6, 2, 2, 7],
    [7, 1, 7, 4, 7],
    [7, 1, 7, 1, 7],
    [5, 5, 7, 1, 1],
    [7, 4, 7, 1, 7],
    [7, 4, 7, 5, 7],
    [7, 1, 1, 2, 2],
    [7, 5, 7, 5, 7],
    [7, 5, 7, 1, 7],
];

/// The picture as PNG with a cross on each corner, blue on corner 0, and its id beside it.
pub fn marked(image: &GrayImage, corners: &[ImageCorner]) -> Vec<u8> {
    let (width, height) = (image.width() as u32, image.height() as u32);
    let grey = image.to_u8();
    let mut picture = RgbImage::from_fn(width, height, |x, y| {
        let v = grey[y as usize * width as usize + x as usize];
        Rgb([v, v, v])
    });
    for corner in corners {
        mark(&mut picture, corner);
    }
    let mut bytes = Cursor::new(Vec::new());
    // into memory, from a buffer of its own size: this cannot fail
    let _ = picture.write_to(&mut bytes, ImageFormat::Png);
    bytes.into_inner()
}

fn mark(picture: &mut RgbImage, corner: &ImageCorner) {
    let (x, y) = (corner.pixel.x.round() as i64, corner.pixel.y.round() as i64);
    let colour = if corner.id == 0 { FIRST } else { CROSS };
    for d in -ARM..=ARM {
        dot(picture, x + d, y, colour);
        dot(picture, x, y + d, colour);
    }
    for (k, digit) in corner.id.to_string().bytes().enumerate() {
        let glyph = GLYPHS[usize::from(digit - b'0')];
        write(picture, x + 3 + 4 * k as i64, y + 3, glyph);
    }
}

fn write(picture: &mut RgbImage, x: i64, y: i64, glyph: [u8; 5]) {
    for (row, bits) in (0..).zip(glyph) {
        for column in 0..3 {
            if bits >> (2 - column) & 1 == 1 {
                dot(picture, x + column, y + row, DIGITS);
            }
        }
    }
}

/// Dots outside of the picture are left out.
fn dot(picture: &mut RgbImage, x: i64, y: i64, colour: Rgb<u8>) {
    if let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y))
        && let Some(pixel) = picture.get_pixel_mut_checked(x, y)
    {
        *pixel = colour;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, Vector2};

    #[test]
    fn corners_at_the_rim_are_drawn_as_far_as_they_go() {
        let image = GrayImage::new(20, 10, vec![200.0; 200]).unwrap();
        let corner =
            |id, x, y| ImageCorner { id, pixel: Vector2::new(x, y), covariance: Matrix2::zeros() };
        let png = marked(&image, &[corner(0, 0.2, 0.4), corner(117, 18.6, 9.0)]);
        let picture = image::load_from_memory(&png).unwrap().to_rgb8();
        assert_eq!(*picture.get_pixel(0, 0), FIRST);
        assert_eq!(*picture.get_pixel(19, 9), CROSS);
        assert_eq!(*picture.get_pixel(10, 7), Rgb([200, 200, 200]));
    }
}
