//! The units of the dimensionless system, and the way back to SI.

use serde::Serialize;

use crate::disk::Disk;
use crate::error::Error;
use crate::ledger::EnergyLedger;
use crate::phase_time::{PhaseSpan, PhaseTime};
use crate::platform::Platform;
use crate::state::DiskState;

/// The SI values of the units of the dimensionless system.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Scales {
    /// Unit of time 1/omega (s).
    pub time: f64,
    /// Unit of length g/omega^2 (m).
    pub length: f64,
    /// Unit of axial velocity g/omega (m/s); also of the axial impulse per unit mass.
    pub velocity: f64,
    /// Unit of angle g a_e/(a_g omega)^2 (rad).
    pub angle: f64,
    /// Unit of angular speed g a_e/(a_g^2 omega) (rad/s); also of the angular impulse per moment of inertia.
    pub angular_speed: f64,
    /// Unit of angular acceleration g a_e/a_g^2 (rad/s^2).
    pub angular_acceleration: f64,
    /// Unit of axial energy per unit mass (g/omega)^2 (J/kg).
    pub axial_energy: f64,
    /// Unit of rotary energy per unit mass (g a_e/(a_g omega))^2 (J/kg).
    pub rotary_energy: f64,
}

/// A [`DiskState`] in SI units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
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

/// An [`EnergyLedger`] in SI units per unit mass (J/kg), axial and rotary parts together where both have one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
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
    pub(crate) fn new(platform: &Platform, disk: &Disk) -> Self {
        let omega = platform.angular_frequency();
        let preload = disk.preload_acceleration();
        let velocity = preload / omega;
        let gyration = disk.gyration_radius();
        let angular_acceleration = preload * disk.contact_radius() / (gyration * gyration);
        let angular_speed = angular_acceleration / omega;
        let rim_speed = angular_speed * gyration;
        Self {
            time: 1.0 / omega,
            length: velocity / omega,
            velocity,
            angle: angular_speed / omega,
            angular_speed,
            angular_acceleration,
            axial_energy: velocity * velocity,
            rotary_energy: rim_speed * rim_speed,
        }
    }

    /// Checks that no unit is zero, denormal or infinite: numbers in SI would lose their digits in it, and times would stand
    /// still.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let units = [
            ("unit of time (s)", self.time),
            ("unit of length (m)", self.length),
            ("unit of velocity (m/s)", self.velocity),
            ("unit of angle (rad)", self.angle),
            ("unit of angular speed (rad/s)", self.angular_speed),
            ("unit of angular acceleration (rad/s^2)", self.angular_acceleration),
            ("unit of axial energy (J/kg)", self.axial_energy),
            ("unit of rotary energy (J/kg)", self.rotary_energy),
        ];
        match units.into_iter().find(|(_, value)| !value.is_normal()) {
            Some((field, value)) => Err(Error::OutOfRange { field, value, legal: "[2.3e-308, 1.7e308]" }),
            None => Ok(()),
        }
    }

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
    /// Energy that the platform puts in: work by normal forces and by friction (J/kg).
    #[must_use]
    pub fn platform_work(&self) -> f64 {
        self.normal_work + self.friction_work
    }
}
