//! States, times and energies of the dimensionless motion in SI units.

use crate::motion::energy::EnergyLedger;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::state::DiskState;
use crate::parameters::scales::Scales;

/// A [`DiskState`] in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SiState {
    /// Height (m).
    pub height: f64,
    /// Axial velocity (m/s).
    pub axial_velocity: f64,
    /// Angle (rad).
    pub angle: f64,
    /// Angular speed (rad/s).
    pub angular_speed: f64,
}

/// An [`EnergyLedger`] in SI units per unit mass (J/kg), with axial and rotary parts added if both exist.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SiEnergy {
    /// Work of the platform by normal forces and impulses.
    pub normal_work: f64,
    /// Work of the platform by friction.
    pub friction_work: f64,
    /// Loss in restitution.
    pub restitution_loss: f64,
    /// Loss in friction.
    pub friction_loss: f64,
    /// Work done against the load.
    pub load_work: f64,
    /// Change of the kinetic energy of the vertical motion.
    pub axial_kinetic_change: f64,
    /// Change of the potential energy.
    pub potential_change: f64,
    /// Change of the kinetic energy of the rotation.
    pub rotary_kinetic_change: f64,
}

impl Scales {
    /// Seconds from phase 0 of the first period to an instant.
    #[must_use]
    pub fn time_seconds(&self, time: PhaseTime) -> f64 {
        PhaseSpan { periods: time.periods, remainder: time.phase.angle() }.radians() * self.time
    }

    /// A duration in seconds.
    #[must_use]
    pub fn span_seconds(&self, span: PhaseSpan) -> f64 {
        span.radians() * self.time
    }

    /// A state in SI units.
    #[must_use]
    pub fn state(&self, state: &DiskState) -> SiState {
        SiState {
            height: state.height * self.length,
            axial_velocity: state.axial_velocity * self.velocity,
            angle: state.angle * self.angle,
            angular_speed: state.angular_speed * self.angular_speed,
        }
    }

    /// A ledger in SI units per unit mass.
    #[must_use]
    pub fn energy(&self, ledger: &EnergyLedger) -> SiEnergy {
        SiEnergy {
            normal_work: ledger.normal_work * self.axial_energy,
            friction_work: ledger.friction_work * self.rotary_energy,
            restitution_loss: ledger.restitution_loss * self.axial_energy,
            friction_loss: ledger.friction_loss * self.rotary_energy,
            load_work: ledger.load_work * self.rotary_energy,
            axial_kinetic_change: ledger.axial_kinetic_change * self.axial_energy,
            potential_change: ledger.potential_change * self.axial_energy,
            rotary_kinetic_change: ledger.rotary_kinetic_change * self.rotary_energy,
        }
    }
}

impl SiEnergy {
    /// The efficiency of a toss (Sec. III A): eta = (dE + E_0)/(W + E_0), the rotary kinetic energy gained by
    /// the disk divided by the energy put in by the platform. dE is [`Self::rotary_kinetic_change`] and W is
    /// [`Self::platform_work`]. E_0 (J/kg, not negative) is the rotary kinetic energy of the disk at the start,
    /// which the platform supplied as well; it is zero for a disk at rest. The efficiency is NaN if no energy
    /// was put in.
    #[must_use]
    pub fn efficiency(&self, initial_rotary_energy: f64) -> f64 {
        (self.rotary_kinetic_change + initial_rotary_energy) / (self.platform_work() + initial_rotary_energy)
    }

    /// Energy that the platform puts in: work by normal forces and by friction (J/kg).
    #[must_use]
    pub fn platform_work(&self) -> f64 {
        self.normal_work + self.friction_work
    }
}
