//! The motor: its data sheet, one rotor and many, its steady operation under a load, sweeps and sensitivities of it, and
//! the balance of the impulses that drive it.

pub(crate) mod batch;
pub(crate) mod data_sheet;
pub(crate) mod impulse;
pub(crate) mod operation;
pub(crate) mod rotor;
pub(crate) mod sensitivity;
pub(crate) mod sweep;
