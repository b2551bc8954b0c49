//! Chattering: the sum of a sequence of impacts without end, the proof that a disk comes to rest by one, and what is done with it.

pub(crate) mod accumulation;
pub(crate) mod expansion;
pub(crate) mod impact_series;
pub(crate) mod policy;
pub(crate) mod rest_proof;
