//! What is stored: where a file comes from, the journal of a long computation, and the files of a sweep.

mod complete_file;
pub(crate) mod error;
pub(crate) mod journal;
pub(crate) mod motor_sweep;
pub(crate) mod provenance;
