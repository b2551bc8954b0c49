//! Elementary functions with the same bits on every processor.

pub mod elementary;
