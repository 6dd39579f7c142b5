//! What cameras, robots and teach pendants write, as handeye's types; results and reports back.
//!
//! Units and conventions convert here, once: inside all is metres, radians and `a_from_b`. What a
//! file does not prove and the user did not declare is refused with the question to answer.

mod error;
mod files;
mod npy;
pub mod robot;
mod table;
mod tree;
pub mod units;
mod xml;

pub use error::{Error, Place};
pub use files::write_atomically;
