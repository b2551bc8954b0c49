//! How a motion starts, in SI units.

use bouncing_disk::core::Phase;
use bouncing_disk::{Error, InitialCondition, Scales, System};

use crate::names::{Name, name};
use crate::real::{Real, optional};

/// The arguments of a start.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Start {
    /// Phase of the platform (rad).
    pub(crate) phase: f64,
    /// Angular speed of the disk (rad/s); that of the platform if there is none.
    pub(crate) angular_speed: Option<f64>,
    /// Height above the platform (m); on it if there is none.
    pub(crate) gap: Option<f64>,
    /// Axial velocity relative to the platform (m/s).
    pub(crate) relative_velocity: Option<f64>,
}

impl Start {
    /// The arguments of a call.
    pub(crate) fn new(
        phase: Real,
        angular_speed: Option<Real>,
        gap: Option<Real>,
        relative_velocity: Option<Real>,
    ) -> Self {
        Self {
            phase: phase.0,
            angular_speed: optional(angular_speed),
            gap: optional(gap),
            relative_velocity: optional(relative_velocity),
        }
    }

    /// What the library, which has other units, calls them.
    pub(crate) fn names(&self, system: &System) -> [Name; 4] {
        let Scales { angular_speed, length, velocity: speed, .. } = system.scales();
        let given = |number: Option<f64>| number.unwrap_or(f64::NAN);
        let velocity = given(self.relative_velocity);
        [
            name("angular_speed", &["angular_speed"])
                .given(given(self.angular_speed))
                .unit(angular_speed, "rad/s"),
            name("gap", &["gap"]).given(given(self.gap)).unit(length, "m"),
            name("relative_velocity", &["relative_velocity"]).given(velocity).unit(speed, "m/s"),
            name("relative_speed", &["relative_velocity"]).given(velocity).unit(speed, "m/s"),
        ]
    }

    /// The start of a system.
    pub(crate) fn condition(&self, system: &System) -> Result<InitialCondition, Error> {
        let (scales, phase) = (system.scales(), Phase::new(self.phase)?);
        let angular_speed = match self.angular_speed {
            Some(speed) => speed / scales.angular_speed,
            None => system.dimensionless().platform_angular_speed(phase),
        };
        let velocity = self.relative_velocity.map(|velocity| velocity / scales.velocity);
        Ok(match (self.gap, velocity) {
            (None, None) => InitialCondition::Contact { phase, angular_speed },
            (None, Some(relative_speed)) => InitialCondition::Launch { phase, relative_speed, angular_speed },
            (Some(gap), velocity) => InitialCondition::Flight {
                phase,
                gap: gap / scales.length,
                relative_velocity: velocity.unwrap_or(0.0),
                angular_speed,
            },
        })
    }
}
