//! How far off points will be where the answer is used: what the tool reaches ([`reach`]), the predicted error there
//! ([`workpiece`]), where it comes from ([`budget`]), and answers with their covariance as results state them
//! ([`answers`]).

pub(crate) mod answers;
pub(crate) mod budget;
pub(crate) mod reach;
pub(crate) mod workpiece;
