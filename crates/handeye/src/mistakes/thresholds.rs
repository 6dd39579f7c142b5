//! When evidence counts: every threshold of this room, with the reason for its number.
//!
//! Residuals are compared as angle and distance, each with a limit of its own; scores are in units of [`UNIT`], the error
//! of an industrial robot. Factors and shares have no unit. How much is searched stands beside each search.

use crate::model::residual::Residual;

/// The residual that counts as one: what an industrial robot with a calibrated camera shows.
pub(crate) const UNIT: Residual = Residual::of(0.05, 0.7);
/// Median residual beyond which captures agree on nothing: twice that of the poorest measured cell in working order.
pub(crate) const BELIEVABLE: Residual = Residual::of(2.5, 15.0);

/// An explanation must lower the score to this part of the declared one: with a third, none of a thousand sets in order is
/// called wrong (`handeye check` in BENCHMARK.md).
pub(crate) const EXPLAINS: f64 = 1.0 / 3.0;
/// Explanations whose scores differ by less than this factor cannot be told apart.
pub(crate) const ALIKE: f64 = 1.5;
/// Fewest captures that contradict a mistake: three determine an answer and confirm nothing.
pub const FEWEST: usize = 4;

/// Fewer captures than this may fit an inversion by chance.
pub(crate) const FEWEST_TO_JUDGE: usize = 5;
/// Of so few only a score as large as an inversion brings is to be explained: 10 mm.
pub(crate) const LARGE: f64 = 14.0;
/// A score up to this is rounding, and there is nothing to explain: a tenth of a micrometre.
pub(crate) const ROUNDING: f64 = 1.5e-4;
/// Median difference between the angles of robot and camera motions beyond which a convention is dropped unfitted: 5
/// degrees (rad). Images of a tilted board are good to 3 even where the lens is not calibrated.
pub(crate) const SIFTED: f64 = 0.087;

/// Flanges nearer to the base than this in all captures, or farther, tell another unit (m): the reach of arms is 0.3 to 4.
pub const REACH: (f64, f64) = (0.05, 6.0);
/// No robot on a track or gantry comes this far (m), and no camera that sees a board is so far from it.
pub(crate) const FARTHEST: f64 = 20.0;

/// A size wrong by less is within what printers and lenses do.
pub(crate) const LEAST_SIZE_ERROR: f64 = 0.005;
/// Chance of such a size when the declared one is right, below which it is called wrong: one set in a thousand.
pub(crate) const IMPROBABLE_SIZE: f64 = 1e-3;
/// A size that is uncertain by more than this share says nothing.
pub(crate) const MOST_UNCERTAIN: f64 = 0.1;
/// Share of the captures that agree once the size is right: outliers beside a wrong size are few.
pub(crate) const MOST_AGREE: f64 = 0.6;
/// A size is a known factor away from the declared one within this share: a print is better.
pub(crate) const LIKE_FACTOR: f64 = 0.01;

/// Times the median residual of those that agree within which a capture is as good as they are: real noise has heavier
/// tails than the Gaussian that a squared Mahalanobis distance is made for.
pub(crate) const AS_GOOD: f64 = 3.0;
/// That median is taken for this at least: rounding in stored poses.
pub(crate) const LEAST_TYPICAL: Residual = Residual { angle: 1e-3, distance: 5e-4 };
/// Squared Mahalanobis distance that six axes of noise reach once in a hundred times (chi-square).
pub(crate) const RESTORED: f64 = 16.8;
/// Loops more open than this are not restored, whatever the noise; spares the test.
pub(crate) const RESTORABLE: Residual = Residual { angle: 0.2, distance: 0.1 };
/// Times as far off as a good capture that still is a sign of an exchange, where the other half of it fits.
pub(crate) const NEARLY: f64 = 3.0;
/// A pose that one capture alone tells has its error at the end of the arm between camera and target: so many times the
/// residual of captures that were fitted together.
pub(crate) const ONE_FOR_ALL: f64 = 5.0;
/// Up to this share of captures that disagree each is explained; beyond it a chance fit to another one explains nothing.
pub(crate) const MOST_EXPLAINED: f64 = 0.5;
/// More captures than this share that agree with no others are said.
pub(crate) const MOST_OUTLIERS: f64 = 0.15;

/// Robot poses this close are one: a robot that holds still reports it so.
pub(crate) const SAME_ROBOT: Residual = Residual { angle: 1e-4, distance: 1e-4 };
/// Target poses this close show the same image: noise of detection.
pub(crate) const SAME_VIEW: Residual = Residual { angle: 3e-3, distance: 1e-3 };
/// A motion beyond this is none of noise, of robot or camera.
pub(crate) const MOTION: Residual = Residual { angle: 0.03, distance: 0.01 };

/// Chance of noise below which a board is called bent.
pub(crate) const IMPROBABLE_BEND: f64 = 1e-4;
/// A bend below this part of the board's size is what boards are sold with.
pub(crate) const LEAST_BEND: f64 = 5e-4;
/// Chance of noise below which scale, tilt or shift between images and scans is proven: three parts are asked for.
pub(crate) const IMPROBABLE_FRAME: f64 = 1e-5;
/// A part is separable from the others where it is so many standard deviations when all are free.
pub(crate) const SEPARABLE: f64 = 3.0;
