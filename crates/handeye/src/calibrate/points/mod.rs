//! Sessions without images of a target: point pairs ([`pairs`]) and captures of a ball ([`balls`]).

pub(crate) mod balls;
pub(crate) mod pairs;
