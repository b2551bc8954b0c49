//! Numbers of more digits than a double has (feature `extended`), and what needs them: the doubling cascade
//! to 25 digits.

mod cascade;

pub use self::cascade::{ExtendedDoubling, doubling_cascade, feigenbaum_estimates, first_doubling_forcing};
pub use crate::numerics::double_double::DoubleDouble;
