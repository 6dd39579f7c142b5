//! What is given to a planner.

use crate::{
    Base, Flange, Pose,
    tools::plan::{
        Setting,
        guess::{GuessSigma, Taken},
        looks::Viewing,
        reach::Reach,
    },
};

/// What is known of a cell, and what its robot reaches.
#[derive(Debug, Clone, PartialEq)]
pub struct Planner {
    /// The cell; its `hand_eye` is what is known of it by now.
    pub setting: Setting,
    /// How well the camera's pose is known beside the captures taken; `None` where it is known well.
    pub guess: Option<GuessSigma>,
    /// Captures that were taken.
    pub taken: Vec<Taken>,
    /// Poses in which the target was not found, or that the robot could not go to.
    pub failed: Vec<Pose<Base, Flange>>,
    /// From where the camera may look.
    pub viewing: Viewing,
    /// What the robot reaches.
    pub reach: Reach,
    /// Candidates that are compared.
    pub candidates: usize,
    /// Threads that share the work, 0 and 1 the caller's own alone; the views do not depend on how many they are.
    pub threads: usize,
}
