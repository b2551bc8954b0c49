//! The kind of motion of a motor's stator, which determines how its rotor is computed.

use std::sync::Arc;

use crate::driven::DrivenSystem;
use crate::error::Error;
use crate::motor::data_sheet::parameters::MotorParameters;
use crate::parameters::dimensionless::DimensionlessParameters;
use crate::parameters::disk::Disk;
use crate::parameters::driven_platform::DrivenPlatform;
use crate::parameters::load::LoadLaw;
use crate::parameters::system::System;
use crate::stator::{LoadLine, StatorSystem};

/// The kind of motion of a motor's stator, with its system, chosen once when the sheet is built.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Stator {
    /// The prescribed sine of Eq. (1), with rigid impacts and a constant load.
    Sine,
    /// Prescribed waveforms, or compliant contacts.
    Driven(Arc<Prescribed>),
    /// A compliant stator, or a load that follows a law.
    Yielding(Arc<StatorSystem>),
}

/// A prescribed motion, and its system with the load, friction and phase lag of the sheet.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Prescribed {
    pub(crate) platform: DrivenPlatform,
    pub(crate) system: DrivenSystem,
}

impl Stator {
    /// The stator of a data sheet with this system and this rotor mass (kg).
    pub(crate) fn of(sheet: &MotorParameters, system: &System, mass: f64) -> Result<Self, Error> {
        let platform = DrivenPlatform::of_drive(*system.platform(), &sheet.drive)?;
        if sheet.stator.is_some() || sheet.load.is_some() {
            if !sheet.drive.is_sine() {
                let other = if sheet.stator.is_some() { "stator" } else { "load" };
                return Err(Error::BothGiven { one: "drive", other });
            }
            return Self::yielding(sheet.load, sheet.stator.is_some(), system, mass);
        }
        if sheet.drive.is_sine() && system.soft_contact().is_none() {
            return Ok(Self::Sine);
        }
        Self::prescribed(platform.with_contact(system.soft_contact()), system.disk())
    }

    /// A rotor on a platform that moves by waveforms, or with compliant contacts.
    pub(crate) fn prescribed(platform: DrivenPlatform, disk: &Disk) -> Result<Self, Error> {
        let system = DrivenSystem::new(&platform, disk)?;
        Ok(Self::Driven(Arc::new(Prescribed { platform, system })))
    }

    fn yielding(load: Option<LoadLaw>, yields: bool, system: &System, mass: f64) -> Result<Self, Error> {
        let system = on_shaft(system, load, mass)?;
        let mut own = StatorSystem::of_system(&system, mass)?;
        if let Some(load) = load {
            let stops = !load.drives_at(f64::NEG_INFINITY) || !load.drives_at(f64::MAX);
            if stops && !yields {
                return Err(Error::SwitchedMotion);
            }
            own = own.with_load(&lines(&load, 0.0, &system, mass))?;
        }
        Ok(Self::Yielding(Arc::new(own)))
    }

    /// This stator with the load, friction and phase lag of another motor.
    pub(crate) fn for_motor(&self, motor: &System) -> Result<Self, Error> {
        Ok(match self {
            Self::Sine => Self::Sine,
            Self::Driven(own) => {
                let (platform, system) = (own.platform.clone(), own.system.for_motor(&own.platform, motor)?);
                Self::Driven(Arc::new(Prescribed { platform, system }))
            }
            Self::Yielding(system) => Self::Yielding(Arc::new(system.with_base(motor.dimensionless())?)),
        })
    }

    /// This stator without the law of the load.
    pub(crate) fn without_law(&self) -> Result<Self, Error> {
        let Self::Yielding(system) = self else { return Ok(self.clone()) };
        Ok(Self::Yielding(Arc::new(system.without_law()?)))
    }

    /// Whether friction acts back on the height, so that each rotor has its own vertical motion.
    pub(crate) fn acts_back(&self) -> bool {
        matches!(self, Self::Yielding(system) if system.twists())
    }

    /// Whether its tape takes much longer to record than to replay, which is true of everything except rigid
    /// impacts on a sine.
    pub(crate) fn takes_long(&self) -> bool {
        match self {
            Self::Sine => false,
            Self::Driven(_) => true,
            Self::Yielding(system) => !system.twists() && (system.yields() || system.takes_time()),
        }
    }

    /// Whether the disk affects the stator's motion.
    pub(crate) fn yields(&self) -> bool {
        matches!(self, Self::Yielding(system) if system.yields())
    }

    /// Whether the velocity of the stator jumps.
    pub(crate) fn has_kinks(&self) -> bool {
        self.driven().is_some_and(|system| system.height().kinks().next().is_some())
    }

    /// Whether contacts on the stator are compliant.
    pub(crate) fn takes_time(&self) -> bool {
        match self {
            Self::Sine => false,
            Self::Driven(own) => own.system.compliance.is_some(),
            Self::Yielding(system) => system.takes_time(),
        }
    }

    /// The system of a stator that moves by waveforms, or with compliant contacts.
    pub(crate) fn driven(&self) -> Option<&DrivenSystem> {
        match self {
            Self::Driven(own) => Some(&own.system),
            Self::Sine | Self::Yielding(_) => None,
        }
    }

    /// The system of a compliant stator, or of a stator under a load that follows a law.
    pub(crate) fn yielded(&self) -> Option<&StatorSystem> {
        match self {
            Self::Yielding(system) => Some(system),
            Self::Sine | Self::Driven(_) => None,
        }
    }
}

/// The system with the inertia of the load on the shaft included in the disk.
pub(crate) fn on_shaft(system: &System, load: Option<LoadLaw>, mass: f64) -> Result<System, Error> {
    let shaft = load.map_or(0.0, |load| load.inertia()) / mass;
    system.with_disk(|disk| {
        disk.gyration_radius = (disk.gyration_radius * disk.gyration_radius + shaft).sqrt();
    })
}

/// A stator without its drive.
pub(crate) fn still(system: &StatorSystem) -> Result<StatorSystem, Error> {
    let base = system.base().parameters();
    system.with_base(&DimensionlessParameters { peak_acceleration: 0.0, twist_speed: 0.0, ..base }.build()?)
}

/// The pieces of a load at a time (s), on a disk of this mass.
pub(crate) fn lines(load: &LoadLaw, time: f64, system: &System, mass: f64) -> Vec<LoadLine> {
    let disk = system.disk();
    let torque = load.factor_at(time) / (mass * disk.preload_acceleration() * disk.contact_radius());
    let speed = system.scales().angular_speed;
    let mut lines = Vec::new();
    let mut reached = f64::NEG_INFINITY;
    while reached < f64::INFINITY {
        let segment = load.segment_at(reached);
        reached = segment.to;
        lines.push(LoadLine {
            from: segment.from / speed,
            to: segment.to / speed,
            torque: segment.torque * torque,
            slope: segment.slope * torque * speed,
        });
    }
    lines
}

#[cfg(test)]
mod tests;
