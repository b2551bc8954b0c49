//! The restitution of viscoelastic bodies.

use core::fmt;

use super::RestitutionLaw;
use crate::numerics::elementary::pow;
use crate::numerics::error::{Error, within};
use crate::numerics::stored::read_checked;

/// Largest number of Newton steps to the fifth root of the restitution. Started to the right of the root of a
/// convex function, they never pass the root; at most 7 were needed.
const NEWTON_STEPS: u32 = 20;

/// The restitution of viscoelastic bodies in Hertzian contact: at low speed 1 - r is proportional to
/// |w_A|^(1/5) (Kuwabara and Kono 1987).
///
/// r is the solution in (0, 1] of r + x r^(3/5) = 1, with x proportional to |w_A|^(1/5): it agrees with the
/// exact series 1 - x + (3/5) x^2 (Ramirez et al. 1999) to this order, and falls towards 0 as |w_A|^(-1/3) at
/// high speed. The derivation is in docs/numerics-dynamics.md.
///
/// ```
/// use bouncing_disk_core::map::{KuwabaraKono, RestitutionLaw};
///
/// // Half of the speed is left at |w_A| = 2 g/omega, more of it at lower speeds.
/// let law = KuwabaraKono::new(0.5, 2.0)?;
/// assert!((law.restitution(2.0) - 0.5).abs() < 1e-15);
/// assert!(law.restitution(0.02) > 0.7 && law.restitution(0.0) == 1.0);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedLaw"))]
pub struct KuwabaraKono {
    reference_restitution: f64,
    reference_speed: f64,
    /// x at speed 1: x = scale |w_A|^(1/5).
    #[cfg_attr(feature = "serde", serde(skip))]
    scale: f64,
}

read_checked!(KuwabaraKono as UncheckedLaw {
    reference_restitution: f64,
    reference_speed: f64
} => KuwabaraKono::new);

impl KuwabaraKono {
    /// The law with the restitution `reference_restitution` in (0, 1) at the impact speed `reference_speed` >
    /// 0 (units of g/omega: a speed in m/s times omega/g).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a number outside its range.
    pub fn new(reference_restitution: f64, reference_speed: f64) -> Result<Self, Error> {
        let least = f64::from_bits(1);
        let below_one = 1.0 - f64::EPSILON / 2.0;
        within("reference_restitution", reference_restitution, least, below_one, "(0, 1)")?;
        within("reference_speed", reference_speed, least, f64::MAX, "(0, inf) (units of g/omega)")?;
        let x = (1.0 - reference_restitution) / pow(reference_restitution, 0.6);
        Ok(Self { reference_restitution, reference_speed, scale: x / pow(reference_speed, 0.2) })
    }

    /// The restitution at [`Self::reference_speed`].
    #[must_use]
    pub const fn reference_restitution(&self) -> f64 {
        self.reference_restitution
    }

    /// The impact speed (units of g/omega) at which the restitution is [`Self::reference_restitution`].
    #[must_use]
    pub const fn reference_speed(&self) -> f64 {
        self.reference_speed
    }

    /// x of r + x r^(3/5) = 1; if it overflows, the largest double, which leaves no rebound.
    fn dissipation(&self, impact_speed: f64) -> f64 {
        let x = self.scale * pow(impact_speed, 0.2);
        if x > f64::MAX { f64::MAX } else { x }
    }
}

/// The fifth root y of the restitution: the solution of y^5 + x y^3 = 1, whose left side grows with y and is
/// convex.
fn fifth_root(x: f64) -> f64 {
    // Both values are to the right of the root: there y^5 + x y^3 is 1 + x and 1 + y^5.
    let mut y = if x <= 1.0 { 1.0 } else { pow(x, -1.0 / 3.0) };
    for _ in 0..NEWTON_STEPS {
        let square = y * y;
        // Divided by y^2, so that a large x does not overflow. (y^5 + x y^3 - 1)/(5 y^4 + 3 x y^2)
        let next = y - (y * (square + x) - 1.0 / square) / (5.0 * square + 3.0 * x);
        // This also ends the loop if the numbers are NaN.
        if next < y {
            y = next;
        } else {
            break;
        }
    }
    y
}

impl RestitutionLaw for KuwabaraKono {
    fn restitution(&self, impact_speed: f64) -> f64 {
        let y = fifth_root(self.dissipation(impact_speed));
        let square = y * y;
        square * square * y
    }

    /// -r/(|w_A| (5 r^(2/5)/x + 3)); -inf at speed 0.
    fn derivative(&self, impact_speed: f64) -> f64 {
        let x = self.dissipation(impact_speed);
        let y = fifth_root(x);
        let square = y * y;
        let share = 1.0 / (5.0 * (square / x) + 3.0);
        // The share is multiplied first: the speed alone may be too small a divisor.
        if impact_speed > 0.0 { -(square * square * y * share) / impact_speed } else { f64::NEG_INFINITY }
    }

    /// With r/(1 - r) = r^(2/5)/x <= 1/x the integral is at most (5/4) |w_A|/x.
    fn rebound_sum(&self, impact_speed: f64) -> Option<f64> {
        if impact_speed > 0.0 {
            Some(1.25 * (impact_speed / self.dissipation(impact_speed)))
        } else {
            Some(0.0)
        }
    }
}

/// `0.5 at 2 g/omega (Kuwabara-Kono)`.
impl fmt::Display for KuwabaraKono {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (restitution, speed) = (self.reference_restitution, self.reference_speed);
        write!(formatter, "{restitution} at {speed} g/omega (Kuwabara-Kono)")
    }
}
