//! Corners that were touched, and the boards that were laid into the view for it.

use handeye::{Base, Flange, Pose};

use super::{Line, PLACEMENTS, SessionFolder, StoredPlacement, StoredTouch};
use crate::{Error, Writing, error::unusable};

/// No session has more placements.
const MOST_PLACEMENTS: usize = 99;

/// The image of a board that lies in the view.
#[derive(Debug, Clone)]
pub struct NewPlacement<'a> {
    /// When it was taken, s.
    pub image_time_s: Option<f64>,
    /// The image's file: its ending (`png`) and its bytes.
    pub image: Option<(&'a str, &'a [u8])>,
    /// The scan's file likewise, in metres where the file does not say it.
    pub scan: Option<(&'a str, &'a [u8])>,
}

impl SessionFolder {
    /// Boards that lie in the view to be touched, in the order in which they were laid there.
    pub fn placements(&self) -> Vec<&StoredPlacement> {
        self.journal.placements()
    }

    /// Names of placements and touches that were deleted.
    pub fn deleted_beside(&self) -> Vec<&str> {
        let placements = self.journal.deleted_placements().into_iter().map(|p| &p.id[..]);
        placements.chain(self.journal.deleted_touches().into_iter().map(|t| &t.id[..])).collect()
    }

    /// Stores the image of a board that lies in the view, to be touched; what it returns, its name, is never used for
    /// another.
    ///
    /// # Errors
    /// As [`SessionFolder::take`].
    pub fn place(&mut self, placement: &NewPlacement) -> Result<String, Error> {
        let number = self.journal.placed().len() + 1;
        if number > MOST_PLACEMENTS {
            return Err(unusable(
                &self.root,
                format!("has {MOST_PLACEMENTS} placements of the board already"),
            ));
        }
        let id = format!("p{number:02}");
        let image_time_s = placement.image_time_s;
        let files = [placement.image, placement.scan];
        self.store_files(&id, (PLACEMENTS, PLACEMENTS), files, |[image, scan]| {
            Line::Place(StoredPlacement { id: id.clone(), image, scan, image_time_s })
        })?;
        Ok(id)
    }

    /// Corners that were touched, in the order in which they were.
    pub fn touches(&self) -> Vec<&StoredTouch> {
        self.journal.touches()
    }

    /// Stores a touch of a corner, of the board of a placement where those are touched, with the flange there, a pose that
    /// was read from the `typed` numbers if there are any; returns its name.
    ///
    /// # Errors
    /// A corner that the board has not, a placement that is not there; a folder that cannot be written.
    pub fn touch(
        &mut self,
        (placement, corner): (Option<&str>, u32),
        (base_from_flange, typed): (Pose<Base, Flange>, &[f64]),
        time_s: f64,
    ) -> Result<String, Error> {
        if self.settings.target.corner(corner).is_none() {
            return Err(unusable(&self.root, format!("the board has no corner {corner}")));
        }
        if let Some(name) =
            placement.filter(|name| !self.placements().iter().any(|p| p.id == *name))
        {
            return Err(unusable(&self.root, format!("has no placement {name}")));
        }
        let id = format!("t{:02}", self.journal.touched().len() + 1);
        let (placement, typed) = (placement.map(Into::into), typed.to_vec());
        let touch =
            StoredTouch { id: id.clone(), corner, placement, base_from_flange, typed, time_s };
        self.journal.append(Line::Touch(touch))?;
        self.settle()?;
        Ok(id)
    }

    /// Takes a touch out.
    ///
    /// # Errors
    /// No such touch; a folder that cannot be written.
    pub fn untouch(&mut self, id: &str) -> Result<(), Error> {
        if !self.touches().iter().any(|touch| touch.id == id) {
            return Err(unusable(&self.root, format!("has no touch {id}")));
        }
        self.journal.append(Line::Untouch(id.into()))?;
        self.settle()
    }

    /// The table of touches: that of poses, with placement and corner in front.
    pub(super) fn table_of(&self, touches: &[&StoredTouch]) -> String {
        let has_placements = touches.iter().any(|touch| touch.placement.is_some());
        let name = |touch: &&StoredTouch| match &touch.placement {
            Some(placement) => format!("{placement},{}", touch.corner),
            None => touch.corner.to_string(),
        };
        let corners: Vec<String> = touches.iter().map(name).collect();
        let poses =
            corners.iter().zip(touches).map(|(corner, t)| (&corner[..], &t.base_from_flange));
        let head = if has_placements { "placement,corner," } else { "corner," };
        let table = Writing::of(&self.settings.notation).map(|writing| writing.table(poses));
        table.map_or_else(|_| String::new(), |table| table.replacen("id,", head, 1))
    }
}
