//! The check that a periodic orbit belongs to a map, shared by all functions that take both.

use glam::DMat2;

use super::newton::speed_scale;
use super::{MAX_PERIOD, PeriodicOrbit, phase_difference};
use crate::flight::launch::Impact;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::{Error, within};

/// Largest distance between the end of a step and the next impact of its orbit (rad, or relative to 1 + the
/// largest impact speed): the largest residual of a refined orbit, 1e-11, with a generous margin.
const CLOSES: f64 = 1.0e-9;

/// A generous bound on the rounding of an impact in the same units. A step magnifies this rounding by the
/// derivative of the map, near a graze to far more than [`CLOSES`].
const ROUNDING: f64 = 1.0e-14;

impl ImpactMap {
    /// Checks that `orbit` is an orbit of this map: that each of its impacts leads to the next one. Its
    /// multipliers and errors are not checked.
    ///
    /// All functions that take an orbit and a map make this check.
    ///
    /// ```
    /// # use bouncing_disk_core::{Error, ImpactMap, Vibration};
    /// let [own, other] = [0.45, 0.46].map(|forcing| ImpactMap::new(Vibration::from_axial_forcing(forcing)?, 0.5));
    /// let (own, other) = (own?, other?);
    /// let orbit = own.refine(&[own.period_one(1).expect("it exists")])?;
    /// assert_eq!(own.check_orbit(&orbit), Ok(()));
    /// let refused = other.check_orbit(&orbit);
    /// assert!(matches!(refused, Err(Error::NotAnOrbit { impact: 0, distance }) if distance > 1e-3));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotAnOrbit`] with the first impact that does not lead to the next one, and the distance;
    /// [`Error::OutOfRange`] for an orbit without impacts or with more than [`MAX_PERIOD`]; errors of
    /// [`Self::step`] except [`Error::NoLiftOff`].
    pub fn check_orbit(&self, orbit: &PeriodicOrbit) -> Result<(), Error> {
        check(orbit, |state| self.step(state), |state| self.step_with_derivative(state))
    }
}

/// The same check for any map with steps and a derivative.
///
/// # Errors
/// Errors of [`ImpactMap::check_orbit`].
pub fn check(
    orbit: &PeriodicOrbit,
    step: impl Fn(ImpactState) -> Result<Impact, Error>,
    step_with_derivative: impl Fn(ImpactState) -> Result<(Impact, DMat2), Error>,
) -> Result<(), Error> {
    let states = &orbit.states;
    within("impacts of a periodic orbit", states.len() as f64, 1.0, MAX_PERIOD as f64, "[1, 4096]")?;
    let scale = speed_scale(states);
    for (index, &state) in states.iter().enumerate() {
        let target = states[(index + 1) % states.len()];
        let distance = match step(state) {
            Ok(impact) => {
                let phase = phase_difference(impact.phase.angle(), target.phase().angle()).abs();
                phase.max((impact.velocity - target.velocity()).abs() / scale)
            }
            Err(Error::NoLiftOff { .. }) => f64::INFINITY,
            Err(error) => return Err(error),
        };
        // An impact on a kink has no derivative, and no orbit with one is ever returned.
        let magnified = || {
            step_with_derivative(state).map_or(0.0, |(_, by)| {
                let (by_phase, by_velocity) = (by.x_axis, by.y_axis);
                let of_phase = by_phase.x.abs() + by_velocity.x.abs() * scale;
                let of_velocity = by_phase.y.abs() / scale + by_velocity.y.abs();
                ROUNDING * of_phase.max(of_velocity)
            })
        };
        if !(distance <= CLOSES || distance <= CLOSES + magnified()) {
            return Err(Error::NotAnOrbit { impact: index, distance });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
