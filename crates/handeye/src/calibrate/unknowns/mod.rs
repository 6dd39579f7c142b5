//! What bare poses may leave open beside both poses of the answer, and what is found of it before the captures are: the
//! unit of their distances ([`unscaled`]) and the offset of two clocks ([`streams`]).

mod settle;
pub mod streams;
pub(crate) mod unscaled;
