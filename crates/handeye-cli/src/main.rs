//! The `handeye` program.
fn main() {}
