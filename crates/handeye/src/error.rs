//! What can be wrong with the data.

/// Why a computation has no answer, with what decided.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Not enough captures that can be used.
    #[error("{}, at least {needed} are needed: {advice}", usable(*found))]
    TooFewPoses {
        /// How many there are.
        found: usize,
        /// How many the method needs.
        needed: usize,
        /// What to do next.
        advice: String,
    },
    /// No view can be taken next; why those that came furthest cannot.
    #[error("{0}")]
    NoView(String),
    /// Not enough samples of a stream that can be used.
    #[error(
        "of the {stream} stream {found} samples at different times can be used, at least {needed} \
         are needed: record both streams while the robot moves and turns about two axes"
    )]
    TooFewSamples {
        /// `robot` or `camera`.
        stream: String,
        /// How many there are.
        found: usize,
        /// How many are needed.
        needed: usize,
    },
    /// Not enough point pairs.
    #[error("{found} point pairs, at least {needed} are needed")]
    TooFewPoints {
        /// How many there are.
        found: usize,
        /// How many the method needs.
        needed: usize,
    },
    /// The points lie on one line: the rotation about it is free.
    #[error(
        "the points lie on one line (spread across it is {ratio:.1e} of the spread along it): \
         the rotation about that line is not determined; add points away from it"
    )]
    Collinear {
        /// Second over first singular value of the point scatter.
        ratio: f64,
    },
    /// The motions leave part of the answer free.
    #[error("the motions do not determine the answer: {what}")]
    NotDetermined {
        /// The missing directions, in words.
        what: String,
    },
    /// A number that is NaN or infinite reached the core.
    #[error("{what} is not finite")]
    NotFinite {
        /// Which quantity.
        what: String,
    },
    /// A value that makes no sense.
    #[error("{0}")]
    Invalid(String),
}

fn usable(captures: usize) -> String {
    match captures {
        1 => "1 usable capture".into(),
        _ => format!("{captures} usable captures"),
    }
}
