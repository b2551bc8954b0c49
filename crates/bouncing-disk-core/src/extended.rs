//! Numbers of more digits than a double has (feature `extended`), and what needs them: the doubling cascade
//! to 25 digits, and the cycle of an orbit that comes to rest, in as many digits as it takes.

mod cascade;
mod exact_orbit;
mod fixed_point;
mod separation_cycle;

pub use self::cascade::{
    ExtendedDoubling, doubling_cascade, doubling_cascade_observed, feigenbaum_estimates,
    first_doubling_forcing,
};
pub use self::separation_cycle::{
    CycleBudget, DoublesCycle, SeparationCycle, SeparationOutcome, separation_cycle,
    separation_cycle_observed,
};
pub use crate::numerics::double_double::DoubleDouble;
