//! Placements: a robot that carries the board cannot touch it. With a camera beside the robot the board, or another of the same
//! kind, is laid into the view; one image shows where it lies, then its corners are touched.

use handeye::{ImageCorner, Setup};
use handeye_io::{StoredPlacement, StoredTouch};

use super::{
    Change, Effect, Engine, Flow, Problem, Refusal,
    obey::{later, wrong},
    rest::{self, Motion},
    shown::{Lying, PlacementShown},
    taking::{ANOTHER_IMAGE_PX, LOOKING_S, PATIENCE_S, Wish},
};
use crate::assess::MeasuredCapture;

/// A board nearer than this to where the carried one is expected is the carried one, mm.
const CARRIED_MM: f64 = 5.0;
/// So many touches of a placement, then another one brings more.
const ENOUGH_TOUCHES: usize = 4;

/// A board that somebody has laid into the view of a virtual cell's camera.
#[derive(Debug, Clone)]
pub(super) struct LyingBoard {
    /// The placement that shows it.
    placement: Option<String>,
}

impl Engine {
    /// Whether boards are laid into the view to be touched.
    pub(super) fn lays_boards(&self) -> bool {
        self.settings().setup == Setup::EyeToHand
    }

    /// The board whose corners are touched, to verify or not; `None` where none lies in the view for that, or the captures' own
    /// board is touched. One before a placement that was deleted is none: the board was laid elsewhere since.
    pub(super) fn newest_placement(&self, verifies: bool) -> Option<&StoredPlacement> {
        let newest = self.folder.placements.last()?;
        let lies = self.folder.laid_last.as_ref() == Some(&newest.id);
        Some(newest).filter(|newest| lies && self.is_for(newest, verifies))
    }

    /// Whether touches of a placement verify, or do not: those of one board are all of one kind.
    fn is_for(&self, placement: &StoredPlacement, verifies: bool) -> bool {
        let on_it = |t: &&StoredTouch| t.placement.as_ref() == Some(&placement.id);
        self.folder.touches.iter().filter(on_it).all(|touch| touch.verifies == verifies)
    }

    /// Takes the image of a board that was laid into the view, as soon as it stands.
    pub(super) fn place(&mut self) -> Result<Vec<Effect>, Refusal> {
        if !self.lays_boards() {
            return Err(wrong(
                "the board of the captures lies where it is touched: no other one is laid down",
            ));
        }
        self.may_touch()?;
        self.touches_now("boards are laid into the view in the steps `touch` and `verify`")?;
        if self.storing || self.assessing {
            return Err(later(
                "what came before is still being assessed: take the image then".into(),
            ));
        }
        if let Some(why) = self.placeable().ok().and_then(|frame| self.no_placement(frame)) {
            return Err(later(format!("no image of the board was taken: {why}")));
        }
        if self.wish.is_none() {
            self.wish = Some(Wish::of_placement(self.now));
        }
        self.forget_problem();
        Ok(self.wait())
    }

    /// In a virtual cell somebody lays a board into the view.
    pub(super) fn lay(&mut self) -> Result<Vec<Effect>, Refusal> {
        if !self.lays_boards() {
            return Err(wrong(
                "the board of the captures lies where it is touched: no other one is laid down",
            ));
        }
        self.may_touch()?;
        self.forget_images();
        (self.tip_to, self.lies) = (None, Some(LyingBoard { placement: None }));
        Ok(vec![Effect::Lay(true)])
    }

    /// And takes it away again.
    pub(super) fn take_away(&mut self) -> Vec<Effect> {
        if self.lies.take().is_none() {
            return vec![];
        }
        self.forget_images();
        vec![Effect::Lay(false)]
    }

    /// Images that came until now show another board.
    fn forget_images(&mut self) {
        self.images.clear();
        self.memory.image = None;
    }

    /// A placement was stored: it shows the board that lies there.
    pub(super) fn placed(&mut self, id: String) -> Change {
        if let Some(board) = &mut self.lies {
            board.placement = Some(id.clone());
        }
        Change::Placed(id)
    }

    /// What lies in the view of a virtual cell's camera.
    pub(super) fn lying(&self, verifies: bool) -> Lying {
        let newest = self.newest_placement(verifies).map(|newest| &newest.id);
        match &self.lies {
            None => Lying::Nothing,
            // the placement of one that lies there may have been deleted
            Some(board) if newest.is_some() && board.placement.as_ref() == newest => Lying::Placed,
            Some(_) => Lying::New,
        }
    }

    /// Whether the tip of a virtual cell's tool can be led to a corner.
    pub(super) fn may_drive_to_board(&self) -> Result<(), Refusal> {
        self.may_touch_board()?;
        let first = match self.lying(self.touches_verify()) {
            Lying::Nothing => "lay a board into the view (`drive` to `placement`)",
            Lying::New => "take the image of the board that was laid down (`place`)",
            Lying::Placed => return Ok(()),
        };
        match self.lays_boards() {
            true => Err(later(format!("there is no corner to be touched: first {first}"))),
            false => Ok(()),
        }
    }

    /// Takes the image that is waited for.
    pub(super) fn fulfil_placement(&mut self) -> Vec<Effect> {
        let frame = match self.placeable() {
            Ok(frame) => frame,
            Err(why) => return self.wait_for_placement(why),
        };
        if let Some(why) = self.no_placement(frame) {
            return self.refuse_placement(&why);
        }
        let delay = self.delay().unwrap_or(0.0);
        let Some(image) = self.images.iter().find(|image| image.frame == frame) else {
            return vec![];
        };
        let image_time_s = image.time_s - delay;
        (self.wish, self.storing, self.problem) = (None, true, None);
        self.note_image(frame);
        vec![Effect::StorePlacement { frame, image_time_s }]
    }

    /// The number of the image that may show a placement, or what is still missing.
    fn placeable(&self) -> Result<u64, String> {
        let newest = self.images.back().ok_or("no image has come yet")?;
        if self.sources.camera == Flow::Stream {
            return match &self.rest.image {
                Motion::Stands(_) => Ok(newest.frame),
                Motion::Moves(why) => Err(why.clone()),
            };
        }
        let asked = self.wish.as_ref().map_or(self.now, |wish| wish.since);
        let is_own = !self.sources.takes_images || newest.time_s > asked;
        if self.is_used_image(newest.frame) || !is_own {
            return Err("waiting for an image of the board as it lies".into());
        }
        match &newest.corners {
            Ok(_) => Ok(newest.frame),
            Err(why) => Err(format!("the board is not found: {why}")),
        }
    }

    fn wait_for_placement(&mut self, why: String) -> Vec<Effect> {
        let streams = self.sources.camera == Flow::Stream;
        let (fresh, unseen) = self.images.back().map_or((false, false), |image| {
            (!self.is_used_image(image.frame), image.corners.is_err())
        });
        let Some(wish) = &mut self.wish else { return vec![] };
        let waited = self.now - wish.since;
        let is_over = match streams {
            true => waited > PATIENCE_S || (unseen && waited > LOOKING_S),
            // of a camera that takes images on demand, one that came before was not asked for
            false => {
                let came = self.images.back().map_or(f64::NEG_INFINITY, |image| image.time_s);
                fresh && unseen && (!self.sources.takes_images || came > wish.since)
            }
        };
        wish.why.clone_from(&why);
        match is_over {
            true => self.refuse_placement(&why),
            false => self.grab_placement(),
        }
    }

    /// Asks for the image, where that can be asked for.
    fn grab_placement(&mut self) -> Vec<Effect> {
        if self.grabbing || !self.sources.takes_images {
            return vec![];
        }
        self.grabbing = true;
        vec![Effect::Grab]
    }

    fn refuse_placement(&mut self, why: &str) -> Vec<Effect> {
        self.wish = None;
        if self.sources.camera == Flow::Single
            && let Some(frame) = self.images.back().map(|image| image.frame)
        {
            self.note_image(frame);
        }
        self.problem = Some(Problem {
            code: "not-placed".into(),
            message: format!("no image of the board was taken: {why}"),
            advice: "see that the whole board lies still in the view, with no other board beside it, and take the image again".into(),
        });
        vec![]
    }

    /// Why an image is none of a board that was newly laid down.
    fn no_placement(&self, frame: u64) -> Option<String> {
        let image = self.images.iter().find(|image| image.frame == frame)?;
        let corners = image.corners.as_ref().ok()?;
        if let Some(id) = self.lies_as_before(corners) {
            return Some(format!(
                "the board still lies as in placement {id}: touch its corners, or lay it elsewhere first"
            ));
        }
        (self.is_as_captured(corners) || self.is_carried(corners)).then(|| {
            "this is the board that the robot carries: drive it out of the view or take it off, and lay the board that is to be touched into the view".into()
        })
    }

    /// The newest placement, where the board has not moved since.
    fn lies_as_before(&self, corners: &[ImageCorner]) -> Option<&str> {
        let id = &self.folder.placements.last()?.id;
        let before = self.assessed.as_ref()?.placements.iter().find(|found| found.id == *id)?;
        is_as_in(before, corners).then_some(&id[..])
    }

    /// Whether the board is where the newest capture shows it.
    fn is_as_captured(&self, corners: &[ImageCorner]) -> bool {
        let newest = self.folder.captures.last().zip(self.assessed.as_ref());
        let seen = newest.and_then(|(c, a)| a.measured.iter().find(|found| found.id == c.id));
        seen.is_some_and(|before| is_as_in(before, corners))
    }

    /// Whether corners are where those of the board are expected that the robot carries.
    fn is_carried(&self, corners: &[ImageCorner]) -> bool {
        let (Some(assessed), Some(robot)) = (&self.assessed, self.robot.back()) else {
            return false;
        };
        let off_mm = assessed.off_carried_board(&robot.base_from_flange, self.settings(), corners);
        off_mm.is_some_and(|mm| mm < CARRIED_MM)
    }

    /// What to do where a board has to be laid down before corners are touched.
    pub(super) fn say_laying(&self, verifies: bool) -> Option<&'static str> {
        let is_gone = self.sources.is_virtual && self.lying(verifies) != Lying::Placed;
        let none = is_gone || self.newest_placement(verifies).is_none();
        (self.lays_boards() && none).then_some("Lay the board, or another of the same kind, into the view, so that the tool reaches it, and take its image.")
    }

    /// What to do next where a board has to be laid down, or should be.
    pub(super) fn say_placement(&self, corner: u32) -> Option<String> {
        if let Some(wish) = self.wish.as_ref().filter(|wish| wish.is_placement) {
            return Some(say_waiting(wish));
        }
        if let Some(what) = self.say_laying(false) {
            return Some(what.into());
        }
        let newest = self.newest_placement(false).filter(|_| self.lays_boards())?;
        let touched = self.touches_of(&newest.id);
        (touched >= ENOUGH_TOUCHES).then(|| {
            format!("Lay the board elsewhere into the view, best at another height, and take its image. Or touch corner {corner} as well, or finish.")
        })
    }

    fn touches_of(&self, placement: &str) -> usize {
        let on_it = |touch: &&StoredTouch| touch.placement.as_deref() == Some(placement);
        self.folder.touches.iter().filter(on_it).count()
    }

    pub(super) fn placements_shown(&self, verifies: bool) -> Vec<PlacementShown> {
        let shown = |placement: &StoredPlacement| PlacementShown {
            id: placement.id.clone(),
            touches: self.touches_of(&placement.id),
        };
        self.folder.placements.iter().filter(|p| self.is_for(p, verifies)).map(shown).collect()
    }
}

/// What is said while the image of a board is waited for.
pub(super) fn say_waiting(wish: &Wish) -> String {
    let why = if wish.why.is_empty() { "waiting for a standstill" } else { &wish.why };
    format!("The image of the board is to be taken: {why}.")
}

/// Whether an image shows the board where one before has it.
fn is_as_in(before: &MeasuredCapture, corners: &[ImageCorner]) -> bool {
    rest::moved(&before.corners, corners).is_some_and(|px| px < ANOTHER_IMAGE_PX)
}
