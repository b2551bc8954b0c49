//! The energy balance of a disk: sources and losses.

use std::iter::Sum;
use std::ops::{Add, AddAssign};

/// Below this magnitude the terms of a balance have lost digits to underflow, so their residual is taken
/// relative to it.
const LEAST_MAGNITUDE: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// The energy balance of an interval, per unit mass.
///
/// Every entry is computed separately, from impulses and closed-form integrals, and none as the remainder of
/// the others. Hence the whole motion can be tested by checking that [`Self::axial_closure`] and
/// [`Self::rotary_closure`] vanish to rounding.
///
/// Axial entries are in units of (g/omega)^2, in which the kinetic energy is v^2/2 and the potential energy
/// is the height; rotary entries in units of (g a_e/(a_g omega))^2, in which the kinetic energy is q^2/2.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct EnergyLedger {
    /// Axial: work of the platform by normal forces and impulses.
    pub normal_work: f64,
    /// Axial: loss in restitution, including the loss by the paper's chattering cut.
    pub restitution_loss: f64,
    /// Axial: change of the kinetic energy.
    pub axial_kinetic_change: f64,
    /// Axial: change of the potential energy, including the spring of a compliant contact.
    pub potential_change: f64,
    /// Rotary: work of the platform by friction, in contact and in impacts.
    pub friction_work: f64,
    /// Rotary: loss in friction, in contact and in impacts.
    pub friction_loss: f64,
    /// Rotary: work done by the disk against the load.
    pub load_work: f64,
    /// Rotary: change of the kinetic energy.
    pub rotary_kinetic_change: f64,
    /// Sum of the magnitudes of all axial terms, including energy levels: the axial closure's rounding error
    /// is relative to it.
    pub axial_magnitude: f64,
    /// The same for the rotary terms.
    pub rotary_magnitude: f64,
}

impl EnergyLedger {
    /// Change of the axial energy minus the inflow: zero up to rounding.
    #[must_use]
    pub fn axial_closure(&self) -> f64 {
        (self.axial_kinetic_change + self.potential_change) - (self.normal_work - self.restitution_loss)
    }

    /// Change of the rotary energy minus the inflow: zero up to rounding.
    #[must_use]
    pub fn rotary_closure(&self) -> f64 {
        self.rotary_kinetic_change - (self.friction_work - self.friction_loss - self.load_work)
    }

    /// The larger of the two closures relative to the magnitudes of the terms; zero without terms, infinite
    /// if a term is not finite.
    #[must_use]
    pub fn relative_closure(&self) -> f64 {
        let relative = |closure: f64, magnitude: f64| {
            if closure.is_finite() && magnitude.is_finite() {
                closure.abs() / magnitude.max(LEAST_MAGNITUDE)
            } else {
                f64::INFINITY
            }
        };
        relative(self.axial_closure(), self.axial_magnitude)
            .max(relative(self.rotary_closure(), self.rotary_magnitude))
    }

    /// Records a change of the axial velocity and height.
    pub(crate) fn record_axial_change(&mut self, velocity: [f64; 2], height: [f64; 2]) {
        let [before, after] = velocity;
        self.axial_kinetic_change += 0.5 * (after - before) * (after + before);
        self.potential_change += height[1] - height[0];
        self.axial_magnitude += 0.5 * (before * before + after * after) + height[0].abs() + height[1].abs();
    }

    /// Records a change of the energy of the spring of a contact.
    pub(crate) fn record_spring(&mut self, [before, after]: [f64; 2]) {
        self.potential_change += after - before;
        self.axial_magnitude += before + after;
    }

    /// Accounts for the rounding of a platform velocity of up to `peak` that is recomputed at the end of a
    /// chatter.
    pub(crate) fn record_rounding(&mut self, peak: f64, velocity: f64) {
        self.axial_magnitude += peak * velocity.abs();
    }

    /// Records a change of the angular speed.
    pub(crate) fn record_rotary_change(&mut self, before: f64, after: f64) {
        self.rotary_kinetic_change += 0.5 * (after - before) * (after + before);
        self.rotary_magnitude += 0.5 * (before * before + after * after);
    }

    /// Records axial work of the platform and an axial loss.
    pub(crate) fn record_normal(&mut self, work: f64, loss: f64) {
        self.normal_work += work;
        self.restitution_loss += loss;
        self.axial_magnitude += work.abs() + loss.abs();
    }

    /// Records rotary work of the platform and a rotary loss; `magnitude` is the sum of the magnitudes of
    /// their terms.
    pub(crate) fn record_friction(&mut self, work: f64, loss: f64, magnitude: f64) {
        self.friction_work += work;
        self.friction_loss += loss;
        self.rotary_magnitude += magnitude;
    }

    /// Records work against the load.
    pub(crate) fn record_load(&mut self, work: f64, magnitude: f64) {
        self.load_work += work;
        self.rotary_magnitude += magnitude;
    }
}

impl AddAssign for EnergyLedger {
    fn add_assign(&mut self, other: Self) {
        self.normal_work += other.normal_work;
        self.restitution_loss += other.restitution_loss;
        self.axial_kinetic_change += other.axial_kinetic_change;
        self.potential_change += other.potential_change;
        self.friction_work += other.friction_work;
        self.friction_loss += other.friction_loss;
        self.load_work += other.load_work;
        self.rotary_kinetic_change += other.rotary_kinetic_change;
        self.axial_magnitude += other.axial_magnitude;
        self.rotary_magnitude += other.rotary_magnitude;
    }
}

impl Add for EnergyLedger {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl Sum for EnergyLedger {
    fn sum<I: Iterator<Item = Self>>(ledgers: I) -> Self {
        ledgers.fold(Self::default(), Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ledger_with_a_number_that_is_none_does_not_balance() {
        let balanced =
            EnergyLedger { axial_magnitude: 1.0, rotary_magnitude: 1.0, ..EnergyLedger::default() };
        assert!(balanced.relative_closure() <= 0.0);
        for broken in [
            EnergyLedger { normal_work: f64::NAN, ..balanced },
            EnergyLedger { rotary_magnitude: f64::NAN, ..balanced },
            EnergyLedger { axial_magnitude: f64::INFINITY, ..balanced },
            EnergyLedger { load_work: f64::INFINITY, ..balanced },
        ] {
            assert!(broken.relative_closure().is_infinite(), "{broken:?}");
        }
        let off = EnergyLedger { friction_loss: 0.5, rotary_magnitude: 2.0, ..balanced };
        assert!((off.relative_closure() - 0.25).abs() <= 0.0);
    }
}
