//! Why no poses come from a robot, in sentences.

use std::{io, time::Duration};

/// Why no poses come.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Outage {
    /// No connection can be made.
    Unreachable(String),
    /// The connection has ended.
    Lost,
    /// Nothing new came for so long.
    Silent(Duration),
    /// What comes is not RTDE, or numbers that are none.
    Garbled(String),
    /// Fields are missing or of another type; of a controller with this software, where it says so.
    Fields(String, Option<String>),
    /// The offset of the tool's centre point is not reported; likewise.
    NoTool(Option<String>),
    /// The controller does not begin to send; what it said.
    Refused(String),
    /// The joints are not powered.
    Off,
}

impl Outage {
    /// A connection that could not be made.
    pub(super) fn unreachable(error: &io::Error) -> Self {
        Self::Unreachable(match error.kind() {
            io::ErrorKind::ConnectionRefused => "it refuses the connection".into(),
            io::ErrorKind::TimedOut | io::ErrorKind::WouldBlock => "it does not answer".into(),
            _ => error.to_string(),
        })
    }

    /// A fixed name.
    pub(super) fn code(&self) -> &'static str {
        match self {
            Self::Unreachable(_) => "robot-unreachable",
            Self::Lost => "robot-lost",
            Self::Silent(_) => "robot-silent",
            Self::Garbled(_) => "robot-garbled",
            Self::Fields(..) => "robot-fields",
            Self::NoTool(_) => "robot-tool",
            Self::Refused(_) => "robot-refused",
            Self::Off => "robot-off",
        }
    }

    /// What is wrong with the robot of this name.
    pub(super) fn message(&self, robot: &str) -> String {
        let of = |software: &Option<String>| match software {
            Some(software) => format!("the robot at {robot}, software {software},"),
            None => format!("the robot at {robot}"),
        };
        match self {
            Self::Unreachable(why) => format!("the robot at {robot} cannot be reached: {why}"),
            Self::Lost => format!("the robot at {robot} has closed the connection"),
            Self::Silent(time) => {
                format!("the robot at {robot} has sent nothing new for {} s", time.as_secs_f64())
            }
            Self::Garbled(what) => format!("what comes from {robot} is not RTDE: {what}"),
            Self::Fields(what, software) => format!("{} {what}", of(software)),
            Self::NoTool(software) => {
                format!(
                    "{} does not report its TCP: where the flange is stays unknown",
                    of(software)
                )
            }
            Self::Refused(said) if said.is_empty() => {
                format!("the robot at {robot} does not begin to send poses")
            }
            Self::Refused(said) => {
                format!("the robot at {robot} does not begin to send poses: {said}")
            }
            Self::Off => format!("the arm at {robot} is not powered: it does not know where it is"),
        }
    }

    /// What to do.
    pub(super) fn advice(&self) -> &'static str {
        match self {
            Self::Unreachable(_) => {
                "is this the address that the pendant shows under Network, is the controller on, and RTDE not disabled among its services? It is tried again every second"
            }
            Self::Lost => "is the controller being restarted? It is connected to again by itself",
            Self::Silent(_) => {
                "is the network cable plugged in? It is connected to again by itself"
            }
            Self::Garbled(_) => {
                "is this the address of the robot, and the port that of RTDE, 30004? It is tried again every second"
            }
            Self::Fields(..) => {
                "update the robot's software; or leave out --ur and type the poses that the pendant shows"
            }
            Self::NoTool(_) => {
                "update the robot's software; or set the TCP to zero on the pendant, leave out --ur, and type the poses that it shows"
            }
            Self::Refused(_) => "restart the controller; it is tried again every second",
            Self::Off => "switch the arm on at the pendant; poses come by themselves then",
        }
    }
}
