//! Where poses and images come from. A source gives what it measures with its time, and has no way to move a robot; only
//! the robot of a virtual cell, which stands in no room, can be driven.

pub mod command;
pub mod folder;
pub mod mistakes;
pub mod outlet;
pub mod scan;
pub mod upload;
pub mod ur_rtde;
pub mod virtual_cell;
