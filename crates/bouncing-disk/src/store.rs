//! What is stored: where a file comes from, and the journal of a long computation.

pub(crate) mod error;
pub(crate) mod journal;
pub(crate) mod provenance;
