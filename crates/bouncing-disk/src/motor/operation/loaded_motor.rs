//! A motor and its stator under a load torque.

use crate::driven::DrivenSystem;
use bouncing_disk_core::run::Watch;

use crate::error::Error;
use crate::motor::operation::point::{Estimate, Operation};
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::operation::survey::Survey;
use crate::motor::stator::Stator;
use crate::parameters::dimensionless::{DimensionlessParameters, DimensionlessSystem};
use crate::parameters::system::System;
use crate::stator::StatorSystem;

/// Relative rounding error, from about ten operations, of a load that was computed from the largest torque of
/// friction in other units.
const LOAD_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Number of members per motor in a search.
const FEWEST: usize = 4;

/// A motor under a load, on a shared vertical motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LoadedMotor<'a> {
    /// Rotor, shaft and sine of the sheet.
    pub(crate) system: System,
    /// The largest speeds of the stator.
    pub(crate) fastest: LargestSpeeds,
    /// The stator, with the load, friction and phase lag of `system`.
    pub(crate) stator: &'a Stator,
    /// Mass m (kg).
    pub(crate) mass: f64,
    /// Load torque T_L (N m) as given, from which the system's load is computed.
    pub(crate) load_torque: f64,
    /// The known vertical motions, which do not depend on load, friction or lag.
    pub(crate) surveyed: Option<&'a Survey>,
    /// Whether only the motion that most rotors reach from rest is required.
    pub(crate) first_only: bool,
}

/// The largest speeds of a stator, which set the scale of starts and errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LargestSpeeds {
    /// Largest speeds of the height (g/omega) and of the angle (g a_e/(a_g^2 omega)).
    pub(crate) height: f64,
    pub(crate) angle: f64,
    /// Largest speed of the angle (rad/s).
    pub(crate) angular_speed: f64,
}

impl LargestSpeeds {
    /// The largest speeds of a system's sine.
    pub(crate) fn of_sine(system: &System) -> Self {
        let own = system.dimensionless();
        let angular_speed = system.platform().peak_angular_speed();
        Self { height: own.peak_acceleration(), angle: own.twist_speed(), angular_speed }
    }

    /// The largest speeds of drives for the platform and the disk of a system.
    pub(crate) fn of_drives(system: &System, driven: &DrivenSystem) -> Self {
        let (disk, scales, frequency) =
            (system.disk(), system.scales(), system.platform().angular_frequency());
        let preload = disk.preload_acceleration();
        let inertia = disk.gyration_radius() * disk.gyration_radius() / (disk.contact_radius() * preload);
        let amplitude = driven.height().bounds().speed * scales.length;
        let angular_speed = frequency * (driven.angle().bounds().speed * scales.angle);
        Self {
            height: amplitude * frequency * frequency / preload,
            angle: inertia * angular_speed * frequency,
            angular_speed,
        }
    }
}

impl LoadedMotor<'_> {
    /// The motor's dimensionless parameters, with the largest speeds of its stator instead of the sine's.
    pub(super) fn dimensionless(&self) -> Result<DimensionlessSystem, Error> {
        let LargestSpeeds { height, angle, .. } = self.fastest;
        let own = self.system.dimensionless().parameters();
        DimensionlessParameters { peak_acceleration: height, twist_speed: angle, ..own }.build()
    }

    /// The motor's vertical motions; `None` under the same conditions as for [`Survey::of`].
    pub(super) fn survey(&self, seed: u64, watch: &Watch<'_>) -> Result<Option<Survey>, Error> {
        if self.stator.acts_back() {
            return Ok(None);
        }
        Survey::of(&self.stator.for_motor(&self.system)?, &self.dimensionless()?, seed, watch)
    }

    /// The same motor under another load torque (N m).
    pub(crate) fn with_load(&self, load_torque: f64) -> Result<Self, Error> {
        let disk = self.system.disk().parameters().with_load_torque(load_torque, self.mass)?;
        Ok(Self { system: System::new(*self.system.platform(), disk.build()?)?, load_torque, ..*self })
    }

    /// The load torque in units of m g a_e.
    pub(crate) const fn load(&self) -> f64 {
        self.system.dimensionless().load()
    }

    /// Whether a mean speed differs from zero by more than four standard errors, and by more than rounding.
    pub(crate) fn turns(&self, speed: Estimate) -> bool {
        self.turns_by(4.0, speed)
    }

    /// The same for this number of standard errors.
    pub(crate) fn turns_by(&self, errors: f64, speed: Estimate) -> bool {
        let rounding = 1e-6 * self.fastest.angular_speed;
        speed.value.abs() > (errors * speed.standard_error).max(rounding)
    }

    /// Settings for one of the many motors of a search, with fewer members if each has its own motion.
    pub(crate) fn for_search(&self, settings: &OperatingSettings) -> OperatingSettings {
        let members = if self.stator.acts_back() { FEWEST } else { settings.members };
        OperatingSettings { members: members.min(settings.members), ..*settings }
    }

    /// The unit of torque, m g a_e (N m).
    pub(super) fn torque_unit(&self) -> f64 {
        let disk = self.system.disk();
        self.mass * disk.preload_acceleration() * disk.contact_radius()
    }

    /// The largest mean torque of friction, mu m g a_e (N m).
    pub(crate) fn largest_torque(&self) -> f64 {
        let disk = self.system.disk();
        disk.friction() * self.mass * disk.preload_acceleration() * disk.contact_radius()
    }

    /// The stator's system, if the stator is compliant or the load follows a law.
    pub(super) fn yielding(&self) -> Option<&StatorSystem> {
        self.stator.yielded()
    }

    /// The torque that the load's law adds to the load torque; infinite if it depends on the speed.
    pub(super) fn law(&self) -> f64 {
        self.yielding().map_or(0.0, |own| own.constant_law().unwrap_or(f64::INFINITY))
    }

    /// The torque (N m) of load and law together on a rotor that begins to turn forwards.
    pub(super) fn torque_at_rest(&self) -> f64 {
        let law = self.yielding().and_then(|own| own.lines.iter().find(|line| line.to > 0.0));
        law.map_or(self.load_torque, |line| line.torque * self.torque_unit())
    }

    /// Whether there is neither a load torque nor a law.
    pub(super) fn is_unloaded(&self) -> bool {
        self.load() == 0.0 && self.law() == 0.0
    }

    /// Whether the load accelerates the rotor for ever: in units of m g a_e, the load exceeds the coefficient
    /// of friction, or equals it up to the rounding of torques in other units. The mean normal force equals
    /// the preload, so friction cannot supply more, whatever the motion. False for a load that depends on the
    /// speed, for which this is not known.
    pub(super) fn runs_away(&self) -> bool {
        let system = self.system.dimensionless();
        let load = system.load() + self.law();
        load.is_finite() && load != 0.0 && load.abs() >= system.friction() * (1.0 - LOAD_ROUNDING)
    }

    pub(super) fn runaway(&self) -> Operation {
        let system = self.system.dimensionless();
        let load = system.load() + self.law();
        let beyond = (load.abs() - system.friction()).max(0.0);
        let scale = self.system.scales().angular_acceleration;
        Operation::Runaway {
            load_torque: self.load_torque + self.law() * self.torque_unit(),
            largest_torque: self.largest_torque(),
            acceleration: -beyond.copysign(load) * scale,
        }
    }
}
