//! A session of a virtual cell without a page: commands from a file, with a clock of its own, so that an hour takes a minute
//! and the same script gives the same bytes.
//!
//! ```json
//! [{"do": "confirm", "step": "cell"},
//!  {"repeat": [{"do": "drive", "to": "next"}, {"do": "take"}], "until": "enough", "most": 30},
//!  {"do": "finish"}]
//! ```

use std::collections::VecDeque;

use serde::Deserialize;

use crate::{
    engine::{Command, Effect, Engine, Input, Sources, shown::State},
    host::{Host, drive},
    sources::{
        outlet::{CameraImage, RecentImages, Wanted},
        virtual_cell::{VirtualCamera, VirtualCell},
    },
};

/// A line of a script.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Action {
    /// A command, as by HTTP.
    Command(Command),
    /// Actions until something is reached.
    Repeat {
        /// The actions.
        repeat: Vec<Action>,
        /// Until when.
        until: Until,
        /// So many times at most.
        #[serde(default = "most")]
        most: usize,
    },
    /// Time that goes by.
    Wait {
        /// s
        wait_s: f64,
    },
}

/// When a repetition ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Until {
    /// The captures are enough for the tolerance.
    Enough,
    /// As often as is said.
    Done,
}

fn most() -> usize {
    100
}

/// A session with a virtual cell and a clock of its own.
pub struct Player {
    engine: Engine,
    host: Host,
    cell: VirtualCell,
    camera: VirtualCamera,
    images: RecentImages,
    now: f64,
    frame: u64,
    inputs: VecDeque<Input>,
}

/// Time between two poses of the robot, s.
const TICK_S: f64 = 0.04;
/// Poses for each image: five images a second.
const TICKS: u64 = 5;
/// After a motion by hand everything stands again, s.
const SETTLED_S: f64 = 4.0;
/// An action that takes longer has failed, s.
const PATIENCE_S: f64 = 60.0;

impl Player {
    /// A session in a folder.
    pub fn new(host: Host, cell: VirtualCell) -> Self {
        let folder = host.state();
        let (engine, effects) = Engine::new(folder, Sources::VIRTUAL);
        let (images, inputs) = (RecentImages::default(), VecDeque::new());
        let camera = VirtualCamera::default();
        let mut player = Self { engine, host, cell, camera, images, now: 0.0, frame: 0, inputs };
        player.perform(effects);
        player.pass(1.0);
        player
    }

    /// What is shown.
    pub fn state(&self) -> State {
        let path = self.host.path();
        let title = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        self.engine.view(&path.display().to_string(), &title)
    }

    /// Its clock, s.
    pub fn now(&self) -> f64 {
        self.now
    }

    /// The cell, whose truth is known.
    pub fn cell(&self) -> &VirtualCell {
        &self.cell
    }

    /// Somebody drives the robot by hand to where the camera sees the board, whatever the session expects.
    ///
    /// # Errors
    /// A cell that shows nothing of its board.
    pub fn show_board(&mut self, number: usize) -> Result<(), handeye::Error> {
        self.cell.show_board(number, self.now)?;
        self.pass(SETTLED_S);
        Ok(())
    }

    /// Plays actions in order.
    ///
    /// # Errors
    /// A command that is refused, with the number of its action.
    pub fn play(&mut self, actions: &[Action]) -> Result<(), String> {
        for (k, action) in actions.iter().enumerate() {
            self.act(action).map_err(|why| format!("action {}: {why}", k + 1))?;
        }
        Ok(())
    }

    fn act(&mut self, action: &Action) -> Result<(), String> {
        match action {
            Action::Command(command) => self.command(command.clone()),
            Action::Wait { wait_s } => {
                self.pass(*wait_s);
                Ok(())
            }
            Action::Repeat { repeat, until, most } => {
                for _ in 0..*most {
                    let enough = self.state().progress.is_some_and(|p| p.enough);
                    if *until == Until::Enough && enough {
                        break;
                    }
                    self.play(repeat)?;
                }
                Ok(())
            }
        }
    }

    /// A command, and the time that it takes.
    ///
    /// # Errors
    /// Why it is refused.
    pub fn command(&mut self, command: Command) -> Result<(), String> {
        let effects =
            self.engine.step(Input::Command(command.clone())).map_err(|e| e.to_string())?;
        self.perform(effects);
        let begin = self.now;
        if matches!(command, Command::Drive { .. } | Command::Jog { .. }) {
            self.pass(TICK_S * TICKS as f64); // the robot begins to move
        }
        while self.is_busy(&command) {
            self.pass(TICK_S * TICKS as f64);
            if self.now - begin > PATIENCE_S {
                return Err(format!("{command:?} took longer than {PATIENCE_S} s"));
            }
        }
        Ok(())
    }

    fn is_busy(&self, command: &Command) -> bool {
        let state = self.state();
        match command {
            Command::Take | Command::Place => state.taking.is_some() || state.assessing,
            Command::Drive { .. } | Command::Jog { .. } => !state.robot.stands,
            _ => state.assessing,
        }
    }

    /// Lets time go by: poses and images come.
    pub fn pass(&mut self, seconds: f64) {
        let end = self.now + seconds;
        while self.now < end {
            self.now += TICK_S;
            self.inputs.push_back(Input::Robot(self.cell.sample(self.now)));
            self.frame += 1;
            if self.frame.is_multiple_of(TICKS) {
                let image = self.camera.image(&self.cell, self.now, self.frame);
                self.images.keep(self.frame, CameraImage::in_memory(image.clone()));
                let found = Wanted::of(self.engine.settings());
                let found = found.found_in(&image, self.frame, self.now);
                self.inputs.push_back(Input::Image(found));
            }
            self.inputs.push_back(Input::Clock(self.now));
            self.drain();
        }
    }

    fn drain(&mut self) {
        while let Some(input) = self.inputs.pop_front() {
            // only commands are refused, and those do not come this way
            let effects = self.engine.step(input).unwrap_or_default();
            self.perform(effects);
        }
    }

    fn perform(&mut self, effects: Vec<Effect>) {
        for effect in effects {
            if drive(&self.cell, &effect, self.now) {
                continue;
            }
            let image = effect.frame().and_then(|frame| self.images.get(frame));
            self.inputs.extend(self.host.perform(effect, image));
        }
        self.drain();
    }
}
