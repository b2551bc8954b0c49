//! Tosses: a single one, and many in a row.

pub(crate) mod multiple;
pub(crate) mod single;
