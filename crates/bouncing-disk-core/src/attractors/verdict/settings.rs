//! How long an orbit is followed for its verdict.

use crate::numerics::error::{Error, within};
use crate::orbits::periodic::MAX_PERIOD;
use crate::read_checked;

/// The largest tolerance of a return.
const LARGEST_TOLERANCE: f64 = 1.0e-2;

/// The fewest impacts that an exponent is measured over: batches of four.
const FEWEST_IMPACTS: f64 = 64.0;

/// How long an orbit is followed for its verdict, and how.
///
/// An orbit that repeats itself or rests is decided as soon as that is seen. The others are followed for
/// `transient` + `impacts` impacts; after a rest on a platform that falls away this begins anew, once.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSettings"))]
pub struct VerdictSettings {
    /// Impacts before the exponent is measured. Default 2,000.
    pub transient: u64,
    /// Impacts that the exponent is measured over, at least 64. Default 100,000.
    pub impacts: u64,
    /// The longest period that is looked for, in impacts, in [1, 4096]. Default 256. The proof of a period
    /// makes some fifty times as many flights at most, and 8,192 more, between two calls of an observer.
    pub longest_period: usize,
    /// How near an impact must come to an earlier one for a period to be tried (rad, and relative speed), in
    /// (0, 0.01]. Default 1e-7. It decides how soon a period is found; whether there is one is proved from
    /// there.
    pub tolerance: f64,
}

impl Default for VerdictSettings {
    fn default() -> Self {
        Self { transient: 2_000, impacts: 100_000, longest_period: 256, tolerance: 1.0e-7 }
    }
}

read_checked!(VerdictSettings as UncheckedSettings {
    transient: u64,
    impacts: u64,
    longest_period: usize,
    tolerance: f64,
});

impl VerdictSettings {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the field that is out of its range.
    pub fn check(&self) -> Result<(), Error> {
        within("impacts", self.impacts as f64, FEWEST_IMPACTS, f64::MAX, "at least 64")?;
        let longest = self.longest_period as f64;
        within("longest period", longest, 1.0, MAX_PERIOD as f64, "[1, 4096] impacts")?;
        let least = f64::from_bits(1);
        within("tolerance", self.tolerance, least, LARGEST_TOLERANCE, "(0, 0.01]")?;
        Ok(())
    }

    /// Impacts after which an orbit is left.
    pub(super) const fn allowed(&self) -> u64 {
        self.transient.saturating_add(self.impacts)
    }
}
