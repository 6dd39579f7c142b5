//! What a search for a target ends in.

use crate::ImageCorner;

/// Why no target was found.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NotFound {
    /// Nothing fits into such an image.
    #[error("the image is {width} x {height} pixels, smaller than a board can be")]
    SmallImage {
        /// Pixels per row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// Nothing that looks like a board.
    #[error("no corners at all")]
    NoCorners,
    /// A part of the board only.
    #[error("{found} of {needed} corners found")]
    TooFew {
        /// Corners of the largest grid.
        found: usize,
        /// Corners of the board.
        needed: usize,
    },
    /// A grid of the wrong size.
    #[error(
        "a grid of {columns} x {rows} corners found, the board has {wanted_columns} x \
         {wanted_rows}: is the target declared as it is?"
    )]
    OtherSize {
        /// Columns of the grid.
        columns: u32,
        /// Rows of the grid.
        rows: u32,
        /// Columns of the board.
        wanted_columns: u32,
        /// Rows of the board.
        wanted_rows: u32,
    },
    /// A part of a checkerboard that may be any.
    #[error(
        "only {found} of {needed} corners are visible, and a partial checkerboard is ambiguous unless its border is \
         visible; show the whole board, or use ChArUco"
    )]
    PartOfBoard {
        /// Corners of the largest grid.
        found: usize,
        /// Corners of the board.
        needed: usize,
    },
    /// A grid whose markers could not be read.
    #[error(
        "{corners} corners found, but no marker of {dictionary} that belongs to the board: check \
         dictionary, numbers of squares and layout"
    )]
    NoMarkers {
        /// Corners of the largest grid.
        corners: usize,
        /// The declared dictionary.
        dictionary: String,
    },
    /// A grid whose markers are the board's, at other places than the declared ones.
    #[error(
        "{read} markers of the board were read, and at most {agreeing} of them lie as declared: check the numbers \
         of squares or tags (x and y may be exchanged), first_id and legacy"
    )]
    OtherLayout {
        /// Markers that were read.
        read: usize,
        /// Markers that the best placement of the board explains.
        agreeing: usize,
    },
    /// No dark square with the tag's bits in it.
    #[error("no tag {id} of {dictionary}: check dictionary and id; it needs white around it")]
    NoTag {
        /// The declared dictionary.
        dictionary: String,
        /// The declared tag.
        id: u32,
    },
    /// No tags that lie to one another as the board's do.
    #[error(
        "no tags of {dictionary} that lie as on the board: check dictionary, first_id, numbers of \
         tags and border_bits"
    )]
    NoTags {
        /// The declared dictionary.
        dictionary: String,
    },
    /// The tag was read, but could not be measured.
    #[error("tag {id} of {dictionary} is there, but its edges are too blurred or covered")]
    BlurredTag {
        /// The declared dictionary.
        dictionary: String,
        /// The declared tag.
        id: u32,
    },
    /// A dictionary that does not exist.
    #[error("unknown marker dictionary {0}")]
    UnknownDictionary(String),
    /// Circles that are not the board.
    #[error(
        "{found} circles found, but no grid of {columns} x {rows} among them: are columns, rows and the \
         kind right (circle-grid, asymmetric-circle-grid, modified-circle-grid)?"
    )]
    NoGrid {
        /// Circles of the largest group.
        found: usize,
        /// Columns of the board.
        columns: u32,
        /// Rows of the board.
        rows: u32,
    },
    /// A target whose corners must be imported.
    #[error("{0} cannot be detected yet: import its corners")]
    Unsupported(&'static str),
    /// A target without corners.
    #[error("a ball cannot be found in images: it is found in 3D scans only")]
    ScansOnly,
}

pub(crate) type Outcome = Result<Vec<ImageCorner>, NotFound>;

/// An outcome with more corners is worth more; of two failures the one that says more.
pub(crate) fn worth(outcome: &Outcome) -> (u32, usize) {
    match outcome {
        Ok(corners) => (2, corners.len()),
        Err(NotFound::TooFew { found, .. } | NotFound::PartOfBoard { found, .. }) => (1, *found),
        Err(NotFound::NoMarkers { corners, .. }) => (1, *corners),
        Err(NotFound::OtherLayout { read, .. }) => (1, *read),
        Err(NotFound::OtherSize { columns, rows, .. }) => (1, (columns * rows) as usize),
        Err(_) => (0, 0),
    }
}
