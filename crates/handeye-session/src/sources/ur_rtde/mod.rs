//! A robot of Universal Robots, by the real-time data exchange (RTDE) of its controller, TCP port 30004.
//!
//! ```text
//! connect ─▶ V protocol 2, else 1 ─▶ O timestamp, actual_q, actual_TCP_pose, tcp_offset, robot_mode ─▶ S ─▶ U U U ...
//! base_from_flange = base_from_tcp · flange_from_tcp⁻¹,      flange_from_tcp = tcp_offset
//! ```
//!
//! Nothing is installed on the controller. Whatever ends a connection, it is made again, for ever; what goes wrong is said
//! once for each outage. There is no request that writes to the robot (`package.rs` has all that there are).
//!
//! Source: Universal Robots, "Real-Time Data Exchange (RTDE) Guide".

mod outage;
mod package;
mod recipe;

use std::{
    net::{TcpStream, ToSocketAddrs},
    str::FromStr,
    thread,
    time::{Duration, Instant},
};

use self::{
    outage::Outage,
    package::{CONTROLLER, DATA, OUTPUTS, PROTOCOL, Request, START, Wire},
    recipe::{FREQUENCY_HZ, Recipe, RobotState},
};
use super::outlet::Outlet;
use crate::engine::rest::RobotSample;

/// The port of RTDE.
const PORT: u16 = 30004;
/// Poses are handed on no closer than this, s: protocol 1 sends 125 a second.
const CLOSEST_S: f64 = 0.03;

/// Where a robot is, and how patiently it is asked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UrRobot {
    /// Name or address of its controller.
    pub host: String,
    /// Port of RTDE.
    pub port: u16,
    /// Before the next attempt to connect.
    pub pause: Duration,
    /// A robot that sends nothing new for so long is lost.
    pub silence: Duration,
}

impl UrRobot {
    /// A robot that is asked every second, and lost after two.
    pub fn new(host: impl Into<String>, port: u16) -> Self {
        let (pause, silence) = (Duration::from_secs(1), Duration::from_secs(2));
        Self { host: host.into(), port, pause, silence }
    }

    /// Host and port, for people.
    fn name(&self) -> String {
        match self.host.contains(':') {
            true => format!("[{}]:{}", self.host, self.port),
            false => format!("{}:{}", self.host, self.port),
        }
    }
}

impl FromStr for UrRobot {
    type Err = String;

    /// `HOST`, `HOST:PORT`, `[IPv6]:PORT` or an IPv6 address alone.
    ///
    /// # Errors
    /// No host, or a port that is none.
    fn from_str(text: &str) -> Result<Self, String> {
        let (host, port) = match (text.strip_prefix('['), text.split_once(':')) {
            (Some(rest), _) => {
                let (host, after) = rest.split_once(']').ok_or("`]` is missing after `[`")?;
                (host, after.strip_prefix(':').or_else(|| after.is_empty().then_some("30004")))
            }
            (None, Some((host, port))) if !port.contains(':') => (host, Some(port)),
            (None, _) => (text, Some("30004")),
        };
        if host.is_empty() || host.contains(char::is_whitespace) {
            return Err("give the robot's name or address, such as 192.168.1.5".into());
        }
        let number = port.and_then(|port| port.parse().ok()).filter(|port| *port > 0);
        let wrong = || format!("the port is a number up to 65535; RTDE has {PORT}");
        Ok(Self::new(host, number.ok_or_else(wrong)?))
    }
}

/// Hands over the robot's poses from now on, 25 a second.
pub fn stream(robot: UrRobot, outlet: Outlet) {
    thread::spawn(move || {
        let mut follower = Follower { robot, outlet, reported: vec![] };
        while let Err(outage) = follower.follow() {
            if !follower.tell(&outage) {
                return;
            }
            thread::sleep(follower.robot.pause);
        }
    });
}

/// Follows a robot through all outages.
struct Follower {
    robot: UrRobot,
    outlet: Outlet,
    /// What was said of this outage already.
    reported: Vec<&'static str>,
}

impl Follower {
    /// Connects, and hands over poses until nobody listens any more.
    ///
    /// # Errors
    /// Why no further poses come.
    fn follow(&mut self) -> Result<(), Outage> {
        let mut wire = Wire::new(connect(&self.robot)?, self.robot.silence);
        let recipe = agree(&mut wire, Instant::now() + self.robot.silence)?;
        let (mut newest, mut handed): (Option<f64>, Option<f64>) = (None, None);
        let mut heard = Instant::now();
        loop {
            let package = wire.next(heard + self.robot.silence)?;
            let state = match package.kind {
                DATA => recipe.read(&package.body)?,
                _ => None,
            };
            // the controller's clock goes on, or what comes is no new measurement
            let Some(state) = state.filter(|s| newest != Some(s.controller_s)) else {
                if heard.elapsed() > self.robot.silence {
                    return Err(Outage::Silent(self.robot.silence));
                }
                continue;
            };
            (newest, heard) = (Some(state.controller_s), Instant::now());
            if handed.is_some_and(|at| (0.0..CLOSEST_S).contains(&(state.controller_s - at))) {
                continue;
            }
            handed = newest;
            if !self.hand_over(&state) {
                return Ok(());
            }
        }
    }

    /// Whether anybody still listens.
    fn hand_over(&mut self, state: &RobotState) -> bool {
        if !state.knows_joints() {
            return self.tell(&Outage::Off);
        }
        self.reported.clear();
        self.outlet.robot(RobotSample {
            time_s: self.outlet.now(),
            base_from_flange: state.base_from_flange(),
            typed: vec![],
            joints: state.joints.to_vec(),
        })
    }

    /// Says what is wrong, once for each outage; whether anybody still listens.
    fn tell(&mut self, outage: &Outage) -> bool {
        // an arm that is still off is reported again after other trouble, for that was mended
        let is_reported = match outage {
            Outage::Off => self.reported.last() == Some(&outage.code()),
            _ => self.reported.contains(&outage.code()),
        };
        if is_reported {
            return self.outlet.is_heard();
        }
        self.reported.push(outage.code());
        self.outlet.trouble(outage.code(), outage.message(&self.robot.name()), outage.advice())
    }
}

fn connect(robot: &UrRobot) -> Result<TcpStream, Outage> {
    let addresses = (&robot.host[..], robot.port)
        .to_socket_addrs()
        .map_err(|_| Outage::Unreachable("no machine of this name is known".into()))?;
    let mut why = Outage::Unreachable("no machine of this name is known".into());
    for address in addresses {
        match TcpStream::connect_timeout(&address, robot.silence) {
            Ok(stream) => return Ok(stream),
            Err(error) => why = Outage::unreachable(&error),
        }
    }
    Err(why)
}

/// Agrees on protocol and fields, and lets the data begin. Each request waits for the answer to the one before it, as in the
/// maker's own client: not everything that speaks RTDE takes two at once.
fn agree(wire: &mut Wire, until: Instant) -> Result<Recipe, Outage> {
    wire.send(&Request::Protocol(2))?;
    let protocol = match wire.answer(PROTOCOL, until)?[..] {
        [1] => 2,
        [0] => 1, // what every controller speaks, unasked
        _ => return Err(Outage::Garbled("an answer of another length than asked for".into())),
    };
    wire.send(&Request::Controller)?;
    wire.answer(CONTROLLER, until)?;
    wire.send(&Request::Outputs {
        names: &Recipe::names(),
        frequency_hz: (protocol == 2).then_some(FREQUENCY_HZ),
    })?;
    let types = wire.answer(OUTPUTS, until)?;
    let recipe = Recipe::agreed(protocol, &types, wire.software())?;
    wire.send(&Request::Start)?;
    match wire.answer(START, until)?[..] {
        [1] => Ok(recipe),
        _ => Err(Outage::Refused(wire.said().into())),
    }
}
