//! Corners that were touched, and the boards that were laid into the view for it.

use handeye::{Base, Flange, Point, Pose, Touch, nalgebra::Vector3};

use super::{Line, PLACEMENTS, SessionFolder, StoredPlacement, StoredTouch};
use crate::{Error, FIXED_BOARD, PlacementSource, Writing, error::unusable};

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

/// A corner that is touched.
#[derive(Debug, Clone, Copy)]
pub struct NewTouch<'a> {
    /// Of the board of which placement, where those are touched.
    pub placement: Option<&'a str>,
    /// Which.
    pub corner: u32,
    /// Whether it verifies the answer, which is not made with it.
    pub verifies: bool,
    /// Where the flange is.
    pub base_from_flange: Pose<Base, Flange>,
    /// The numbers from which that was read, where they were typed.
    pub typed: &'a [f64],
    /// When, s.
    pub time_s: f64,
}

impl SessionFolder {
    /// Boards that lie in the view to be touched, in the order in which they were laid there.
    pub fn placements(&self) -> Vec<&StoredPlacement> {
        self.journal.placements()
    }

    /// The name of the placement that was made last, also where it was deleted since.
    pub fn laid_last(&self) -> Option<&str> {
        self.journal.placed().last().map(|placement| &placement.id[..])
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

    /// Corners that were touched, in the order in which they were, also those that verify the answer.
    pub fn touches(&self) -> Vec<&StoredTouch> {
        self.journal.touches()
    }

    /// Those that the answer is made with.
    pub(super) fn touches_used(&self) -> Vec<&StoredTouch> {
        self.touches().into_iter().filter(|touch| !touch.verifies).collect()
    }

    /// Boards that the answer is made with: a board whose touches verify it is none of them.
    pub(super) fn placements_used(&self) -> Vec<&StoredPlacement> {
        self.placements().into_iter().filter(|p| !self.is_verifying(p)).collect()
    }

    fn is_verifying(&self, placement: &StoredPlacement) -> bool {
        let on_it = |touch: &&StoredTouch| touch.placement.as_ref() == Some(&placement.id);
        self.touches().into_iter().filter(on_it).any(|touch| touch.verifies)
    }

    /// The boards whose touches verify the answer.
    pub(super) fn placements_verifying(&self) -> Vec<PlacementSource> {
        let file = |name: &Option<String>| name.as_ref().map(|name| self.root.join(name));
        let all = self.placements().into_iter().filter(|p| self.is_verifying(p));
        all.map(|p| PlacementSource {
            id: p.id.clone(),
            image: file(&p.image),
            scan: file(&p.scan),
            corners: None,
            camera_from_target: None,
        })
        .collect()
    }

    /// Touches that verify the answer, with the positions of the tip.
    pub(super) fn touches_verifying(&self) -> Vec<Touch> {
        let Some(tip_mm) = self.settings.tip_mm else { return vec![] };
        let tip = Point::<Flange>::from_vector(Vector3::from(tip_mm) * 1e-3);
        let all = self.touches().into_iter().filter(|touch| touch.verifies);
        all.map(|t| Touch {
            placement: t.placement.clone().unwrap_or_else(|| FIXED_BOARD.into()),
            corner: t.corner,
            in_base: t.base_from_flange * tip,
            base_from_flange: Some(t.base_from_flange),
            joints: vec![],
        })
        .collect()
    }

    /// Stores a touch of a corner, with the flange there; returns its name.
    ///
    /// # Errors
    /// A corner that the board has not, a placement that is not there, or that has touches of the other kind; a folder that
    /// cannot be written.
    pub fn touch(&mut self, touch: &NewTouch) -> Result<String, Error> {
        let NewTouch { placement, corner, verifies, base_from_flange, typed, time_s } = *touch;
        if self.settings.target.corner(corner).is_none() {
            return Err(unusable(&self.root, format!("the board has no corner {corner}")));
        }
        if let Some(name) =
            placement.filter(|name| !self.placements().iter().any(|p| p.id == *name))
        {
            return Err(unusable(&self.root, format!("has no placement {name}")));
        }
        let others = self.touches().into_iter().any(|t| {
            t.verifies != verifies && placement.is_some() && t.placement.as_deref() == placement
        });
        if others {
            let what = "has touches that verify the answer and touches that it is made with: lay the board elsewhere for the others";
            return Err(unusable(
                &self.root,
                format!("placement {} {what}", placement.unwrap_or("")),
            ));
        }
        let id = format!("t{:02}", self.journal.touched().len() + 1);
        self.journal.append(Line::Touch(StoredTouch {
            id: id.clone(),
            corner,
            placement: placement.map(Into::into),
            verifies,
            base_from_flange,
            typed: typed.to_vec(),
            time_s,
        }))?;
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
