//! The fields that a controller is asked for, and what their values say.

use handeye::{
    Base, Flange, Pose, Tool,
    nalgebra::{Isometry3, Vector3},
};

use super::outage::Outage;

/// How often values come, where that can be said. Every controller's rate is a multiple of it.
pub(super) const FREQUENCY_HZ: f64 = 25.0;
/// Names and types of the fields, in the order of their values.
const FIELDS: [(&str, &str); 5] = [
    ("timestamp", "DOUBLE"),
    ("actual_q", "VECTOR6D"),
    ("actual_TCP_pose", "VECTOR6D"),
    (TOOL, "VECTOR6D"),
    ("robot_mode", "INT32"),
];
/// The field that old software does not have.
const TOOL: &str = "tcp_offset";
/// The type of a field that a controller does not have.
const NOT_FOUND: &str = "NOT_FOUND";
/// No value of joints (rad) or poses (m, rad) is as large.
const LARGEST: f64 = 1e3;
/// Modes of the robot in which its joints know where they are: idle, back-driven, running.
const POWERED: std::ops::RangeInclusive<i32> = 5..=7;

/// What was agreed on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Recipe {
    /// Its number, in protocol 2.
    id: Option<u8>,
}

/// Where the robot is.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RobotState {
    /// When, s, by the controller's clock.
    pub(super) controller_s: f64,
    /// The joints, rad.
    pub(super) joints: [f64; 6],
    base_from_tcp: Pose<Base, Tool>,
    flange_from_tcp: Pose<Flange, Tool>,
    mode: i32,
}

impl Recipe {
    /// The names of the fields, as they are asked for.
    pub(super) fn names() -> String {
        FIELDS.map(|(name, _)| name).join(",")
    }

    /// What the controller answered to these names.
    ///
    /// # Errors
    /// Fields that it does not have, or has as something else.
    pub(super) fn agreed(
        protocol: u16,
        answer: &[u8],
        software: Option<String>,
    ) -> Result<Self, Outage> {
        let short = || Outage::Garbled("an answer without the types of the fields".into());
        let (id, types) = match (protocol, answer) {
            (1, _) => (None, answer),
            (_, [id, types @ ..]) => (Some(*id), types),
            _ => return Err(short()),
        };
        let types = std::str::from_utf8(types).map_err(|_| short())?;
        let types: Vec<&str> = types.split(',').map(|t| t.trim_matches(['\0', ' '])).collect();
        if types.len() != FIELDS.len() {
            return Err(short());
        }
        let fields = || FIELDS.into_iter().zip(&types);
        let missing: Vec<&str> =
            fields().filter(|(_, got)| **got == NOT_FOUND).map(|((name, _), _)| name).collect();
        match missing[..] {
            [] => {}
            [TOOL] => return Err(Outage::NoTool(software)),
            _ => {
                return Err(Outage::Fields(
                    format!("does not send {}", missing.join(", ")),
                    software,
                ));
            }
        }
        match fields().find(|((_, kind), got)| kind != *got) {
            None => Ok(Self { id }),
            Some(((name, kind), _)) => {
                Err(Outage::Fields(format!("sends {name} otherwise than as {kind}"), software))
            }
        }
    }

    /// The values of a package; `None` where they are of another recipe.
    ///
    /// # Errors
    /// Values of another length than agreed on, or that no robot has.
    pub(super) fn read(&self, body: &[u8]) -> Result<Option<RobotState>, Outage> {
        let body = match (self.id, body) {
            (None, _) => body,
            (Some(id), [first, rest @ ..]) if *first == id => rest,
            (Some(_), _) => return Ok(None),
        };
        let state = values(body).ok_or_else(|| {
            Outage::Garbled(format!("{} bytes of values, other than agreed on", body.len()))
        })?;
        match state.is_sane() {
            true => Ok(Some(state)),
            false => Err(Outage::Garbled("numbers that are no pose of a robot".into())),
        }
    }
}

fn values(body: &[u8]) -> Option<RobotState> {
    let (time, rest) = body.split_first_chunk()?;
    let (joints, rest) = six(rest)?;
    let (pose, rest) = six(rest)?;
    let (offset, rest) = six(rest)?;
    Some(RobotState {
        controller_s: f64::from_be_bytes(*time),
        joints,
        base_from_tcp: pose_of(&pose),
        flange_from_tcp: pose_of(&offset),
        mode: i32::from_be_bytes(rest.try_into().ok()?),
    })
}

fn six(bytes: &[u8]) -> Option<([f64; 6], &[u8])> {
    let (own, rest) = bytes.split_at_checked(48)?;
    let mut numbers = [0.0; 6];
    for (number, eight) in numbers.iter_mut().zip(own.chunks_exact(8)) {
        *number = f64::from_be_bytes(eight.try_into().ok()?);
    }
    Some((numbers, rest))
}

/// x y z (m) and a rotation vector (rad).
fn pose_of<A, B>([x, y, z, rx, ry, rz]: &[f64; 6]) -> Pose<A, B> {
    Pose::claim(Isometry3::new(Vector3::new(*x, *y, *z), Vector3::new(*rx, *ry, *rz)))
}

impl RobotState {
    /// Where the flange is.
    pub(super) fn base_from_flange(&self) -> Pose<Base, Flange> {
        self.base_from_tcp * self.flange_from_tcp.inverse()
    }

    /// Whether the arm is powered, so that its joints tell where they are.
    pub(super) fn knows_joints(&self) -> bool {
        POWERED.contains(&self.mode)
    }

    fn is_sane(&self) -> bool {
        let is_small = |x: &f64| x.abs() < LARGEST; // and a number
        let poses = [
            (self.base_from_tcp.translation(), self.base_from_tcp.is_finite()),
            (self.flange_from_tcp.translation(), self.flange_from_tcp.is_finite()),
        ];
        self.controller_s.is_finite()
            && self.joints.iter().all(is_small)
            && poses.iter().all(|(at, finite)| *finite && at.iter().all(is_small))
    }
}
