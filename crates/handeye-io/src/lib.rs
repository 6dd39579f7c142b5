//! Files in and out.

pub mod report;
