//! Corners that a program's tool touches, and boards that are laid into the view for that.

use super::{
    PUSH_S, PushError, Pushed, PushedPose, PushedSession, can_be, refused, size_of, there,
};
use crate::{
    engine::{Command, Input, Step},
    sources::outlet::{CameraImage, Wanted},
};

impl PushedSession {
    /// Takes a touch: the flange was here with the tip at a corner, which is the one that the state proposes unless said. Stores
    /// it, assesses all, and returns its name.
    ///
    /// # Errors
    /// No captures yet, no tip, no placement where the robot carries the board, a corner that the board does not have, a pose
    /// that cannot be or was not read anew, a folder that cannot be written.
    pub fn touch(&mut self, pose: PushedPose, corner: Option<u32>) -> Result<String, PushError> {
        let now = self.now + PUSH_S;
        let mut engine = self.at(Step::Touch)?;
        engine.step(Input::Clock(now))?;
        engine.step(there(pose, now))?;
        can_be(&engine, &[Step::Robot])?;
        let effects = engine.step(Input::Command(Command::Touch { corner }))?;
        (self.engine, self.now) = (engine, now);
        let taken = self.perform(effects, None)?.taken;
        taken.ok_or_else(|| refused("no touch was taken".into()))
    }

    /// Takes a touch out.
    ///
    /// # Errors
    /// A name that no touch has; a folder that cannot be written.
    pub fn untouch(&mut self, id: &str) -> Result<(), PushError> {
        let effects = self.engine.step(Input::Command(Command::Untouch { id: id.into() }))?;
        self.perform(effects, None).map(|_| ())
    }

    /// Takes the image of a board that lies still in the view of a camera beside the robot, to be touched. Where the flange is at
    /// that moment need not be said; then a board that the robot carries may be taken for one that lies.
    ///
    /// # Errors
    /// No captures yet, a camera on the robot, a board that lies as before or is the one that the robot carries, an image of
    /// another size, a folder that cannot be written.
    pub fn place(
        &mut self,
        image: CameraImage,
        pose: Option<PushedPose>,
    ) -> Result<Pushed, PushError> {
        self.has_size(size_of(&image))?;
        let (now, frame) = (self.now + PUSH_S, self.frame + 1);
        let mut engine = self.at(Step::Touch)?;
        engine.step(Input::Clock(now))?;
        if let Some(pose) = pose {
            engine.step(there(pose, now))?;
            can_be(&engine, &[Step::Robot])?;
        }
        let found = Wanted::of(engine.settings()).found_in(&image.grey, frame, now);
        engine.step(Input::Image(found))?;
        can_be(&engine, &[Step::Camera])?;
        let effects = engine.step(Input::Command(Command::Place))?;
        (self.engine, self.now, self.frame) = (engine, now, frame);
        match self.perform(effects, Some(image))?.taken {
            Some(id) => Ok(Pushed::Taken(id)),
            // the board was not found
            None => match self.state().problem {
                Some(problem) => Ok(Pushed::Unseen(problem.message)),
                None => Err(refused("no image of the board was taken".into())),
            },
        }
    }
}
