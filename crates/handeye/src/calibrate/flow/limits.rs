//! What an answer must hold to be accepted: the thresholds of judgement, with the reason for each number. Those of
//! mistakes stand in [`mistakes::thresholds`](crate::mistakes::thresholds).

pub(crate) use crate::mistakes::thresholds::{
    BELIEVABLE, IMPROBABLE_SIZE, LEAST_SIZE_ERROR, SAME_VIEW,
};
use crate::model::residual::Residual;

/// Predicted error (95 %) beyond which an answer is rejected when the user named no limit, mm.
pub(crate) const MOST_PREDICTED_MM: f64 = 10.0;

/// Captures from which on a leave-one-out residual says something: what remains of fewer hardly determines an answer.
pub(crate) const FEWEST_HELD_OUT: usize = 5;

/// Share of the captures that must agree.
pub(crate) const LEAST_AGREEING: f64 = 0.5;

/// Fewest captures of which some may be rejected: three determine an answer and confirm nothing.
pub(crate) const FEWEST_CONFIRMED: usize = 4;

/// Fewer captures than this are answered with a warning: of so few a wrong one is not noticed.
pub(crate) const FEW: usize = 8;

/// Beyond so many captures a part of them tells what all do: searches that would take the square of their number, or many
/// fits of all, look at so many.
pub(crate) const VERY_MANY: usize = 200;

/// A second agreement with this share of the captures of the first leaves the question open.
pub(crate) const NEARLY_AS_MANY: f64 = 0.75;

/// Answers this close are the same. A second group in which only the target lay elsewhere, or was read flipped, says the
/// same of the camera.
pub(crate) const SAME_ANSWER: Residual = Residual { angle: 0.035, distance: 0.02 };

/// Wrong size of the target that is beyond any printer: the declared size or the focal length is wrong, and so is every
/// distance.
pub(crate) const MOST_SIZE_ERROR: f64 = 0.03;
