//! A point of the platform's cycle, and time as a whole number of cycles and a phase.

use core::f64::consts::TAU;

use crate::numerics::elementary::{sin_cos, wrapped_angle};
use crate::numerics::error::Error;
use crate::numerics::stored::read_checked;

/// A phase of the platform's cycle: the angle tau in [0, 2 pi) with its sine and cosine.
///
/// The three are kept together because the solver finds all three at an impact: an orbit that carries the
/// pair need not recompute it at the next launch. The carried pair may differ from [`sin_cos`] of the angle,
/// in the last place after a flight of more than half a radian. So a chaotic orbit continues bit for bit only
/// from all three numbers.
///
/// The drift between angle and pair is bounded. A flight of more than half a radian evaluates the pair again,
/// so that it agrees with the angle to 7e-16. A shorter flight rotates its initial pair, and both pair and
/// angle are rounded: each further flight in an unbroken sequence of short ones adds at most 7e-16. The
/// measured drift is 8e-13 after 1e7 flights, as expected for roundings of either sign. An attachment begins
/// a new pair, so a sequence is one chatter: about a hundred flights at restitution 0.5.
///
/// All three numbers are stored, so that an orbit resumes bit for bit from a deserialised phase.
/// Deserialising checks that the angle is in [0, 2 pi) and the pair within 1e-9 of its sine and cosine.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedPhase"))]
pub struct Phase {
    angle: f64,
    sin: f64,
    cos: f64,
}

/// The angle in radians.
impl core::fmt::Display for Phase {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        core::fmt::Display::fmt(&self.angle, formatter)?;
        formatter.write_str(" rad")
    }
}

/// The largest accepted difference between a deserialised pair and the sine and cosine of its angle: far more
/// than any orbit's drift, far less than the difference to another angle.
pub(crate) const PAIR_TOLERANCE: f64 = 1.0e-9;

read_checked!(Phase as UncheckedPhase { angle: f64, sin: f64, cos: f64 });

impl Phase {
    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        let Self { angle, sin, cos } = *self;
        let illegal = |field, value, legal| Err(Error::OutOfRange { field, value, legal });
        if !(0.0..TAU).contains(&angle) {
            return illegal("angle of a phase", angle, "[0, 2 pi) (rad)");
        }
        let own = sin_cos(angle);
        for (field, value, own) in [("sine of a phase", sin, own.0), ("cosine of a phase", cos, own.1)] {
            // NaN is never near.
            let near = (value - own).abs() <= PAIR_TOLERANCE;
            if !near {
                return illegal(field, value, "within 1e-9 of the value at its angle");
            }
        }
        Ok(())
    }

    /// The phase at `angle` radians; any finite angle is reduced to [0, 2 pi).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the angle is not finite.
    pub fn new(angle: f64) -> Result<Self, Error> {
        if !angle.is_finite() {
            return Err(Error::OutOfRange { field: "phase", value: angle, legal: "finite (rad)" });
        }
        Ok(Self::of_angle(wrapped_angle(angle)))
    }

    /// The phase at an angle that is known to lie in [0, 2 pi).
    #[doc(hidden)]
    #[must_use]
    #[inline]
    pub fn of_angle(angle: f64) -> Self {
        let (sin, cos) = sin_cos(angle);
        Self { angle, sin, cos }
    }

    /// A copy number by number: reading as a whole a value that was just written in parts causes a stall.
    #[inline(always)]
    pub(crate) const fn in_parts(self) -> Self {
        Self::from_parts(self.angle, self.sin, self.cos)
    }

    /// A phase from its three numbers.
    // The model rotates phases with it.
    #[doc(hidden)]
    #[must_use]
    #[inline(always)]
    pub const fn from_parts(angle: f64, sin: f64, cos: f64) -> Self {
        Self { angle, sin, cos }
    }

    /// The angle tau in radians, in [0, 2 pi).
    #[must_use]
    #[inline(always)]
    pub const fn angle(&self) -> f64 {
        self.angle
    }

    /// The angle as a fraction of the period, tau / 2 pi, in [0, 1).
    #[must_use]
    pub fn cycles(&self) -> f64 {
        self.angle / TAU
    }

    /// sin tau.
    #[must_use]
    #[inline(always)]
    pub const fn sin(&self) -> f64 {
        self.sin
    }

    /// cos tau.
    #[must_use]
    #[inline(always)]
    pub const fn cos(&self) -> f64 {
        self.cos
    }
}

#[cfg(all(test, feature = "serde"))]
mod tests {
    use super::*;

    #[test]
    fn a_phase_is_read_with_all_its_bits_and_legal() {
        let turned = Phase { sin: Phase::of_angle(0.5).sin.next_up().next_up(), ..Phase::of_angle(0.5) };
        let text = serde_json::to_string(&turned).expect("writes");
        let read = serde_json::from_str::<Phase>(&text).expect("legal");
        let bits = |of: Phase| [of.angle, of.sin, of.cos].map(f64::to_bits);
        assert_eq!(bits(read), bits(turned));
        for (angle, sin, cos, complaint) in [
            ("6.283185307179587", "0.0", "1.0", "angle of a phase"),
            ("-1e-300", "0.0", "1.0", "angle of a phase"),
            ("0.0", "1.1e-9", "1.0", "sine of a phase"),
            ("0.0", "0.0", "-1.0", "cosine of a phase"),
        ] {
            let text = format!(r#"{{"angle":{angle},"sin":{sin},"cos":{cos}}}"#);
            let error = serde_json::from_str::<Phase>(&text).expect_err(&text).to_string();
            assert!(error.contains(complaint), "{error}");
        }
    }
}
