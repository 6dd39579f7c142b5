//! Imported corners that lie half a pixel from where the given camera has them.

use handeye::{ImageCorner, Intrinsics, TargetModel, Warning, intrinsics::pixel_origin};

use crate::PixelOrigin;

/// The warning that all corners of files lie half a pixel off, where the views prove it; `origin` is
/// what the manifest declares.
pub(crate) fn half_pixel(
    views: &[Vec<ImageCorner>],
    target: &TargetModel,
    given: &Intrinsics,
    origin: PixelOrigin,
) -> Option<Warning> {
    let found = pixel_origin::shift(views, target, given)?;
    let half = found.half_pixel()?;
    let sigma = found.covariance.diagonal().map(f64::sqrt);
    let text = format!(
        "the imported corners of {} views lie ({:+.2}, {:+.2}) +- ({:.2}, {:.2}) px from where the \
         given camera has them, which is half a pixel in x and y: {}",
        found.views,
        found.shift.x,
        found.shift.y,
        sigma.x,
        sigma.y,
        advice(half, origin)
    );
    Some(Warning::new("half-pixel", text))
}

fn advice(half: f64, origin: PixelOrigin) -> &'static str {
    match (half > 0.0, origin) {
        (true, PixelOrigin::Centre) => {
            "they count from the corner of the first pixel, as ChArUco corners of OpenCV 4.9 to 4.13 \
             do; say pixel_origin = \"corner\" in [corners], or find them with OpenCV 4.14; only if \
             they are right, add 0.5 to the camera's cx and cy"
        }
        (false, PixelOrigin::Corner) => {
            "they count from the centre of the first pixel already; say pixel_origin = \"centre\" in \
             [corners]; only if they are right, subtract 0.5 from the camera's cx and cy"
        }
        (true, PixelOrigin::Corner) => {
            "pixel_origin = \"corner\" in [corners] takes off less than they have; find them again \
             with another program, or add 0.5 to the camera's cx and cy if these count from \
             elsewhere"
        }
        (false, PixelOrigin::Centre) => {
            "the camera's cx and cy seem to count from the corner of the first pixel; if so, \
             subtract 0.5 from both"
        }
    }
}
