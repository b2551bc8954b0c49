//! The best hand motion of a toss (Sec. III) under constraints, and its robustness to errors of the inputs.
//!
//! The search (`search.rs`) is deterministic; docs/numerics/design.md has its premises, and how its result
//! is certified.

pub(crate) mod constraints;
mod hand;
pub(crate) mod robustness;
mod search;

use bouncing_disk_core::Observer;
use bouncing_disk_core::numerics::elementary::tan;
use bouncing_disk_core::run::Watch;

use crate::error::Error;
use crate::parameters::stroke::Stroke;
use crate::parameters::system::System;
use crate::toss::design::constraints::{TossCertificate, TossConstraints};
use crate::toss::design::hand::{Evaluation, flight_height, turns};
use crate::toss::design::search::search;
use crate::toss::single::TossPerformance;

/// The best hand motion, and its toss.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TossDesign {
    /// The given constraints.
    pub constraints: TossConstraints,
    /// The hand motion.
    pub hand: Stroke,
    /// L = a_e Phi/A, the tangent of the amplitude angle.
    pub amplitude_ratio: f64,
    /// The objective, over the range of friction: rad/s, a share, or turns.
    pub value: f64,
    /// The toss at the middle of the range of friction.
    pub toss: TossPerformance,
    /// How high the dough flies above the place where it leaves the hand (m).
    pub flight_height: f64,
    /// Turns until it is back there, at the middle of the range of friction.
    pub turns: f64,
    /// How the optimum is certified.
    pub certificate: TossCertificate,
}

impl TossDesign {
    /// The dough on the hand that was found, with the friction in the middle of its range: the system of
    /// [`Self::toss`].
    ///
    /// # Errors
    /// Those of [`System::new`], for a design that was changed or deserialised.
    pub fn system(&self) -> Result<System, Error> {
        let TossConstraints { dough, friction, .. } = self.constraints;
        crate::toss::design::hand::system(self.hand, dough, crate::toss::design::hand::middle(friction))
    }
}

/// The hand motion that is best under these constraints: its frequency, its amplitude angle and its phase
/// lag.
///
/// The items of `observer` are steps of the search.
///
/// ```
/// # use bouncing_disk::core::Unobserved;
/// use bouncing_disk::toss::{TossConstraints, best_toss};
///
/// // The dough of Table I, on hands whose flour makes the friction uncertain, no higher than half a metre.
/// let constraints = TossConstraints {
///     friction: [0.5, 0.7],
///     angular_frequency: [10.0, 16.0],
///     highest_flight: Some(0.5),
///     ..TossConstraints::pizza_toss()
/// };
/// let design = best_toss(&constraints, &Unobserved)?;
/// assert!(design.value > 15.0 && design.flight_height < 0.5 + 1e-9);
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
///
/// # Errors
/// [`Error::OutOfRange`] names the illegal number; [`Error::NeverLeaves`] if the dough does not leave the
/// hand at any of the frequencies, with c omega^2/g at the highest; those of
/// [`single_toss`](crate::toss::single_toss).
pub fn best_toss(constraints: &TossConstraints, observer: &dyn Observer) -> Result<TossDesign, Error> {
    constraints.check()?;
    let watch = Watch::begin(observer, 0, crate::toss::design::search::STAGES)?;
    let found = search(constraints, &watch)?;
    let hand = found.hand;
    let evaluation = Evaluation::new(constraints, hand)?;
    let toss = evaluation.middle;
    let design = TossDesign {
        constraints: *constraints,
        hand: hand.stroke(constraints),
        amplitude_ratio: tan(hand.amplitude_angle),
        value: evaluation.value,
        flight_height: flight_height(&toss, constraints.gravity()),
        turns: turns(&toss, constraints.gravity()),
        toss,
        certificate: found.certificate,
    };
    watch.end();
    Ok(design)
}

#[cfg(test)]
mod tests;
