//! One flight: launch, impact, and the first impact of Eq. (11).

pub(crate) mod bounds;
pub(crate) mod drop;
pub(crate) mod first_impact;
pub(crate) mod gap;
mod graze_margin;
pub(crate) mod impact;
pub(crate) mod launch;
pub mod reference;
