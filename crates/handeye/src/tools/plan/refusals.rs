//! Why no more views are found, in words.

use super::{collision::Collision, reach::Unreached};
use crate::Error;

/// Why no more views are found.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Refusals {
    /// Looks from where the target is not seen as a whole for sure.
    pub unseen: usize,
    /// Looks too like captures that were taken, or to places that failed.
    pub alike: usize,
    /// Poses that the robot does not reach.
    pub unreached: usize,
    /// Poses in collision, or to which the path is.
    pub colliding: usize,
    /// The first collision.
    pub collision: Option<Collision>,
}

impl Refusals {
    pub(super) fn note(&mut self, why: Unreached) {
        match why {
            Unreached::TooFar => self.unreached += 1,
            Unreached::Collides(collision) => {
                self.colliding += 1;
                self.collision.get_or_insert(collision);
            }
        }
    }

    /// Why those that came furthest came no further, in words.
    pub(super) fn reason(&self) -> String {
        let Refusals { unseen, alike, unreached, colliding, collision } = self;
        let (all, tried) = (unseen + alike + unreached + colliding, unreached + colliding);
        if tried > 0 && unreached >= colliding {
            format!(
                "the robot does not reach {unreached} of {tried} poses that would show the target: move the board nearer \
                 to the middle of its workspace"
            )
        } else if tried > 0 {
            let which = collision
                .as_ref()
                .map_or(String::new(), |c| format!(" ({} and {})", c.part, c.with));
            format!(
                "{colliding} of {tried} poses that would show the target are in collision, or the path to them is{which}: move the \
                 board, or correct the shapes"
            )
        } else if unseen >= alike {
            format!(
                "in {unseen} of {all} candidate views the camera would not surely see the whole target: take the first \
                 captures near the present pose, or allow other distances"
            )
        } else {
            format!(
                "{alike} of {all} candidate views are like captures that were taken, or that failed"
            )
        }
    }

    pub(super) fn error(&self) -> Error {
        Error::NoView(self.reason())
    }
}
