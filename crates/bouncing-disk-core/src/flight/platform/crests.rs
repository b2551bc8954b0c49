//! The crests of the platform: which launches clear the first of them for certain.

use core::f64::consts::TAU;

use crate::numerics::elementary::CREST;

/// Share of 1 + P by which the gaps and speeds of [`Crests`] and of the bounds of a flight exceed a tie: far more than their
/// rounding.
pub(crate) const CLEAR: f64 = 1.0e-9;

/// Share of 1 + P by which a disk at the crest must be faster than one that falls past it.
const CLEAR_FALL: f64 = 1.0e-5;

/// What decides whether launches clear the first crest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crests {
    /// Time from the separation to the crest (rad).
    pub(crate) separation_to_crest: f64,
    /// A disk that has at least this speed at the crest has not been slower than the platform since the separation.
    pub(crate) rising_speed: f64,
}

impl Crests {
    pub(crate) const fn new(peak: f64, separation_angle: f64, separation_speed: f64) -> Self {
        let separation_to_crest = CREST - separation_angle;
        Self {
            separation_to_crest,
            rising_speed: (separation_speed - separation_to_crest) + CLEAR * (1.0 + peak),
        }
    }

    /// Whether a launch is certain not to be hit before the first crest, unless within half a radian
    /// (docs/numerics/lockstep.md, "Tests that are certain when they answer"): `disk_speed` is that at launch, `arc_speed` the one, negative, with
    /// which it comes down to the height of the crests, not a number where it stays below.
    #[inline(always)]
    pub(crate) fn surely_cleared(&self, peak: f64, angle: f64, disk_speed: f64, arc_speed: f64) -> bool {
        let ahead = CREST - angle;
        let crest = ahead + if ahead > 0.0 { 0.0 } else { TAU };
        let speed = disk_speed - crest;
        let above = speed - arc_speed >= CLEAR_FALL * (1.0 + peak);
        (crest <= self.separation_to_crest) | (above & ((speed <= 0.0) | (speed >= self.rising_speed)))
    }
}
