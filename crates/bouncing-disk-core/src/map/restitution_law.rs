//! Laws of restitution: the share of its speed that the disk keeps in an impact, and the trait for your own
//! laws. Derived in docs/numerics-dynamics.md.

use core::fmt::{self, Debug, Display};

use crate::numerics::error::{Error, within};

pub(crate) mod kuwabara_kono;

/// A law of restitution: the share of the relative axial speed that is left after an impact.
///
/// [`Constant`] is the paper's law, [`KuwabaraKono`](crate::map::KuwabaraKono) is for viscoelastic bodies.
/// Your own law needs two methods:
///
/// ```
/// use bouncing_disk_core::map::RestitutionLaw;
/// use bouncing_disk_core::{ImpactMap, ImpactState, Vibration};
///
/// /// r = 1/(1 + v).
/// #[derive(Debug, Clone, Copy)]
/// struct Softening;
///
/// impl RestitutionLaw for Softening {
///     fn restitution(&self, impact_speed: f64) -> f64 {
///         1.0 / (1.0 + impact_speed)
///     }
///     fn derivative(&self, impact_speed: f64) -> f64 {
///         let restitution = self.restitution(impact_speed);
///         -restitution * restitution
///     }
/// }
///
/// let map = ImpactMap::with_law(Vibration::from_axial_forcing(0.55)?, Softening);
/// let impact = map.step(ImpactState::from_normalised(0.8, 1.3)?)?;
/// assert!(impact.velocity < 0.0);
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
///
/// The same speed must always have the same restitution, and every impact checks that it lies in [0, 1].
/// There are no further checks: a law may grow with the speed, or jump.
pub trait RestitutionLaw: Clone + Debug {
    /// The coefficient of restitution, in [0, 1], of an impact with the relative axial speed |w_A| >= 0
    /// (units of g/omega).
    ///
    /// A value outside this range, or NaN, ends the motion with [`Error::IllegalRestitution`] at that impact.
    fn restitution(&self, impact_speed: f64) -> f64;

    /// The derivative of [`Self::restitution`] with respect to the speed (units of omega/g). At speeds below
    /// the smallest normal number, in particular 0, it may be infinite: only its product with the speed
    /// matters, which then counts as 0.
    fn derivative(&self, impact_speed: f64) -> f64;

    /// A bound on the sum of all launch speeds after an impact at this speed on a platform at rest, until the
    /// disk rests. For a law that does not grow with the speed, it is the integral of r/(1 - r) over the speeds
    /// from 0 to this one, or anything larger. It bounds the error of a cut
    /// ([`ImpactMap::comes_to_rest_within`](crate::ImpactMap::comes_to_rest_within)).
    ///
    /// `None`, the default, is for a law that may grow with the speed or is unknown: its cuts have no error
    /// bound.
    fn rebound_sum(&self, _impact_speed: f64) -> Option<f64> {
        None
    }

    /// The restitution if it is the same at every speed and known to be legal. Only [`Constant`] returns one.
    /// The closed forms of a chatter rely on this, so no other crate can name the argument.
    #[doc(hidden)]
    #[inline(always)]
    fn constant(&self, _: Internal) -> Option<f64> {
        None
    }
}

/// Only this crate can name this type, so no other crate can override a method with an argument of this type.
#[derive(Debug, Clone, Copy)]
pub struct Internal;

/// The same restitution at every speed, in [0, 1): the paper's law.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "f64", into = "f64"))]
pub struct Constant(f64);

impl Constant {
    /// The law with this restitution in [0, 1).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a restitution outside [0, 1).
    pub fn new(restitution: f64) -> Result<Self, Error> {
        within("restitution", restitution, 0.0, 1.0 - f64::EPSILON / 2.0, "[0, 1)")?;
        Ok(Self(restitution))
    }

    /// The restitution.
    #[must_use]
    #[inline(always)]
    pub const fn value(&self) -> f64 {
        self.0
    }
}

impl TryFrom<f64> for Constant {
    type Error = Error;

    fn try_from(restitution: f64) -> Result<Self, Error> {
        Self::new(restitution)
    }
}

impl From<Constant> for f64 {
    fn from(law: Constant) -> Self {
        law.0
    }
}

/// The number alone.
impl Display for Constant {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        Display::fmt(&self.0, formatter)
    }
}

impl RestitutionLaw for Constant {
    #[inline(always)]
    fn restitution(&self, _impact_speed: f64) -> f64 {
        self.0
    }

    #[inline(always)]
    fn derivative(&self, _impact_speed: f64) -> f64 {
        0.0
    }

    fn rebound_sum(&self, impact_speed: f64) -> Option<f64> {
        Some(self.0 * impact_speed / (1.0 - self.0))
    }

    #[inline(always)]
    fn constant(&self, _: Internal) -> Option<f64> {
        Some(self.0)
    }
}

/// The restitution of `law` at an impact speed, checked.
#[inline(always)]
pub(crate) fn restitution_of<L: RestitutionLaw>(law: &L, impact_speed: f64) -> Result<f64, Error> {
    if let Some(restitution) = law.constant(Internal) {
        return Ok(restitution);
    }
    let restitution = law.restitution(impact_speed);
    if (0.0..=1.0).contains(&restitution) {
        Ok(restitution)
    } else {
        Err(Error::IllegalRestitution { restitution, impact_speed })
    }
}

/// The derivative of the launch speed r(v) v with respect to the impact speed v; for a constant law, the
/// restitution.
pub(crate) fn launch_slope<L: RestitutionLaw>(law: &L, impact_speed: f64) -> Result<f64, Error> {
    let restitution = restitution_of(law, impact_speed)?;
    if law.constant(Internal).is_some() || impact_speed < f64::MIN_POSITIVE {
        return Ok(restitution);
    }
    let slope = restitution + impact_speed * law.derivative(impact_speed);
    if slope.is_finite() {
        Ok(slope)
    } else {
        Err(Error::OutOfRange {
            field: "derivative of the launch speed by the impact speed",
            value: slope,
            legal: "finite, because a law of restitution needs a derivative at every speed above 0",
        })
    }
}

#[cfg(test)]
mod tests;
