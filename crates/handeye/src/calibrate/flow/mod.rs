//! What the stages hand on, and what is made of it in the end: the wishes of the user and what is unknown beside both
//! poses ([`config`], [`unknown`]), captures as views ([`views`]), what was noticed ([`notes`]) and found ([`evidence`]),
//! the thresholds of judgement ([`limits`]), and the one place that makes a result of it ([`verdict`]).

pub(crate) mod config;
pub(crate) mod evidence;
pub(crate) mod limits;
pub(crate) mod notes;
pub(crate) mod unknown;
pub(crate) mod verdict;
pub(crate) mod views;
