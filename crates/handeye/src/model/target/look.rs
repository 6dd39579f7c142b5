//! What a target looks like in an image: that decides how it is looked for, not the name of its kind.

/// What there is to see of a target.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Look {
    /// Squares in black and white.
    Squares,
    /// The same, with markers in the white ones.
    MarkedSquares(MarkedSquares),
    /// One tag alone.
    Tag {
        /// OpenCV's name.
        dictionary: String,
        /// Which one.
        id: u32,
    },
    /// Several of them.
    Tags(Tags),
    /// Circles.
    Circles(Circles),
    /// A ball, which shows in scans only.
    Ball,
}

/// Squares with markers in the white ones.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MarkedSquares {
    /// Along x and y.
    pub squares: (u32, u32),
    /// Side of a marker over that of a square.
    pub share: f64,
    /// Whether the first square is white.
    pub white_first: bool,
    /// OpenCV's name.
    pub dictionary: String,
    /// The first marker.
    pub first_id: u32,
}

/// A grid of tags.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tags {
    /// OpenCV's name.
    pub dictionary: String,
    /// The first tag.
    pub first_id: u32,
    /// Width of a tag's black border.
    pub border_bits: u32,
    /// Gap between tags over the side of one.
    pub gap: f64,
    /// Whether black squares at their corners join them, so that they are a board of squares, too.
    pub joined: bool,
}

/// How circles are arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Circles {
    /// In rows and columns.
    Plain,
    /// Every second row is shifted.
    Asymmetric,
    /// The one at the bottom left is larger.
    WithLarger,
}
