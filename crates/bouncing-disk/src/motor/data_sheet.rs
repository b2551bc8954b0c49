//! A motor as described by its data sheet: frequency in Hz, preload in N, load in N m. The sheet determines a
//! [`System`].
//!
//! Warnings point out unusual values (`warning.rs`), and a report describes the behaviour of the motor
//! (`report.rs`). Data sheets are read and written as JSON and TOML (`file.rs`). The table of the fields is
//! in `motor_field.rs`.

#[cfg(any(feature = "json", feature = "toml"))]
pub(crate) mod file;
pub(crate) mod motor_field;
pub(crate) mod parameters;
mod presets;
pub(crate) mod regime;
pub(crate) mod report;
mod rise_bound;
pub(crate) mod traps;
pub(crate) mod warning;

use std::f64::consts::{PI, SQRT_2, TAU};

use crate::error::{Error, check, finite, not_negative, positive, restitution};
use crate::motor::data_sheet::parameters::MotorParameters;
use crate::motor::data_sheet::rise_bound::highest_rise;
use crate::motor::stator::Stator;
use crate::parameters::contact::Contact;
use crate::parameters::dimensionless::DimensionlessSystem;
use crate::parameters::disk::DiskParameters;
use crate::parameters::load::LoadLaw;
use crate::parameters::platform::PlatformParameters;
use crate::parameters::stator::{GivenMotion, StatorModes};
use crate::parameters::system::{Beyond, System};

/// A motor with a legal data sheet: a [`System`] together with its mass and its preload as a force.
///
/// Printing shows quantities that follow from the data sheet without computing a motion; [`Motor::report`]
/// adds the regime.
///
/// ```
/// use bouncing_disk::Motor;
///
/// // The paper's motor pressed by a spring with 5 N instead of by its own weight.
/// let motor = Motor::paper_70_khz().with(|sheet| {
///     sheet.preload_acceleration = None;
///     sheet.preload_force = Some(5.0);
/// })?;
/// assert_eq!(motor.preload_acceleration().round(), 152.0);
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "MotorParameters", into = "MotorParameters"))]
pub struct Motor {
    parameters: MotorParameters,
    system: System,
    mass: f64,
    stator_motion: Stator,
}

impl Motor {
    /// The platform and the disk, without the motion of a table `[drive]` or the law of a table `[load]`.
    #[must_use]
    pub const fn system(&self) -> &System {
        &self.system
    }

    /// The data sheet, which can be changed and built again.
    #[must_use]
    pub const fn parameters(&self) -> &MotorParameters {
        &self.parameters
    }

    /// The motion of its stator.
    pub(crate) const fn stator_motion(&self) -> &Stator {
        &self.stator_motion
    }

    /// The system of a motor whose stator moves sinusoidally, with rigid impacts and a constant load.
    ///
    /// # Errors
    /// [`Error::YieldingStator`], [`Error::LoadLaw`], [`Error::DriveNotSine`] or [`Error::SoftContact`] for a
    /// motor of another kind.
    pub fn rigid_sine(&self) -> Result<&System, Error> {
        DimensionlessSystem::try_from(&self.system).map(|_| &self.system)
    }

    /// The same motor with another data sheet. To switch between alternatives, for example from a preload
    /// acceleration to a force, set the old one to `None`.
    ///
    /// # Errors
    /// The errors of [`MotorParameters::build`].
    pub fn with(&self, change: impl FnOnce(&mut MotorParameters)) -> Result<Self, Error> {
        let mut parameters = self.parameters.clone();
        change(&mut parameters);
        parameters.build()
    }

    /// Mass m of the rotor (kg), as given or computed from density and size.
    #[must_use]
    pub const fn mass(&self) -> f64 {
        self.mass
    }

    /// Moment of inertia m a_g^2 (kg m^2).
    #[must_use]
    pub fn inertia(&self) -> f64 {
        let gyration = self.system.disk().gyration_radius();
        self.mass * gyration * gyration
    }

    /// Preload as an acceleration g (m/s^2).
    #[must_use]
    pub const fn preload_acceleration(&self) -> f64 {
        self.system.disk().preload_acceleration()
    }

    /// Preload as a force m g (N).
    #[must_use]
    pub fn preload_force(&self) -> f64 {
        self.parameters.preload_force.unwrap_or_else(|| self.mass * self.preload_acceleration())
    }

    /// The stator, if it reacts to the rotor; without a rotor it moves as the platform of [`Self::system`].
    #[must_use]
    pub fn stator(&self) -> Option<StatorModes> {
        self.system.stator()
    }

    /// The law of a varying load, if the sheet states one instead of a load torque.
    #[must_use]
    pub const fn load(&self) -> Option<LoadLaw> {
        self.parameters.load
    }

    /// Load torque T_L (N m).
    #[must_use]
    pub const fn load_torque(&self) -> f64 {
        self.parameters.load_torque
    }

    /// mu m g a_e (N m): the mean torque if friction always acted in the same direction. The mean normal
    /// force equals the preload, whatever the motion, so no motor delivers more.
    #[must_use]
    pub fn largest_torque(&self) -> f64 {
        let disk = self.system.disk();
        disk.friction() * self.preload_force() * disk.contact_radius()
    }

    /// Static deflection of the preload's spring, F/k (m); `None` without a spring.
    #[must_use]
    pub fn static_deflection(&self) -> Option<f64> {
        self.parameters.spring_constant.map(|constant| self.preload_force() / constant)
    }

    /// A bound on the height of the rotor (m) above its position on the stator at mid-height. For a
    /// sinusoidal stator, the bound holds for all flights of a motor that starts from rest, and of every
    /// attractor (docs/numerics-dynamics.md, "A bound on flight heights").
    #[must_use]
    pub fn highest_rise(&self) -> f64 {
        let system = &self.system;
        highest_rise(system.peak_acceleration(), system.disk().restitution()) * system.scales().length
    }

    /// A bound on the relative change of the spring's force during a flight: k [`Self::highest_rise`]/F;
    /// `None` without a spring or with a [drive](MotorParameters::drive). The engine keeps the preload
    /// constant; above 1 % there is a warning.
    #[must_use]
    pub fn preload_change_bound(&self) -> Option<f64> {
        let is_sine = self.parameters.drive.is_sine();
        self.static_deflection().filter(|_| is_sine).map(|deflection| self.highest_rise() / deflection)
    }
}

/// Which alternative is given.
enum Alternative {
    One(f64),
    Other(f64),
}

fn one_of(
    one: (&'static str, Option<f64>),
    other: (&'static str, Option<f64>),
) -> Result<Alternative, Error> {
    match (one.1, other.1) {
        (Some(value), None) => Ok(Alternative::One(value)),
        (None, Some(value)) => Ok(Alternative::Other(value)),
        (None, None) => Err(Error::NeitherGiven { one: one.0, other: other.0 }),
        (Some(_), Some(_)) => Err(Error::BothGiven { one: one.0, other: other.0 }),
    }
}

impl MotorParameters {
    /// Checks the ranges and the alternatives.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] with the field, its value and its legal range; [`Error::NeitherGiven`] and
    /// [`Error::BothGiven`] for two fields of which exactly one is needed; [`Error::NotGiven`] for the radius
    /// or thickness that a density needs. The errors of [`System::new`] if the combination is out of range.
    pub fn build(&self) -> Result<Motor, Error> {
        self.check_ranges()?;
        self.drive.check()?;
        let angular_frequency = TAU * self.drive_frequency;
        check(
            angular_frequency.is_normal(),
            "drive_frequency",
            self.drive_frequency,
            "[3.6e-309, 2.8e307] (Hz)",
        )?;
        let platform = self.platform(angular_frequency)?;
        let mass = self.rotor_mass()?;
        let gyration_radius = match (self.gyration_radius, self.rotor_radius) {
            (Some(gyration), _) => gyration,
            (None, Some(radius)) => radius / SQRT_2,
            (None, None) => {
                return Err(Error::NeitherGiven { one: "gyration_radius", other: "rotor_radius" });
            }
        };
        let preload = one_of(
            ("preload_force", self.preload_force),
            ("preload_acceleration", self.preload_acceleration),
        )?;
        let preload_acceleration = match preload {
            Alternative::One(force) => {
                let acceleration = force / mass;
                positive("preload_acceleration = preload_force/mass", acceleration)?
            }
            Alternative::Other(acceleration) => acceleration,
        };
        let force = mass * preload_acceleration;
        check(force.is_normal(), "preload_force = mass*preload_acceleration", force, "a normal number (N)")?;
        let rotor = DiskParameters {
            contact_radius: self.contact_radius,
            gyration_radius,
            friction: self.friction,
            restitution: self.restitution,
            preload_acceleration,
            load_acceleration: 0.0,
        };
        let rotor = rotor.with_load_torque(self.load_torque, mass)?;
        let contact = self.contact.map(|contact| match (contact.mass, contact.time) {
            (Some(_), _) => Err(Error::BothGiven { one: "mass", other: "contact.mass" }),
            (None, Some(_)) => Ok(contact),
            (None, None) => Ok(Contact { mass: Some(mass), ..contact }),
        });
        let system = System::new(platform.build()?, rotor.build()?)?;
        let mut system = system.with_contact(contact.transpose()?)?.with_stator(self.stator)?;
        if self.load.is_some() && self.load_torque != 0.0 {
            return Err(Error::BothGiven { one: "load_torque", other: "load" });
        }
        if self.load.is_some() {
            system.beyond = Beyond::Load;
        } else if !self.drive.is_sine() {
            system.beyond = Beyond::Drive;
        }
        let stator_motion = Stator::of(self, &system, mass)?;
        Ok(Motor { parameters: self.clone(), system, mass, stator_motion })
    }

    /// The motion without a rotor, as stated in the sheet or computed from its stator.
    fn platform(&self, angular_frequency: f64) -> Result<PlatformParameters, Error> {
        let twist = one_of(
            ("peak_angular_speed", self.peak_angular_speed),
            ("twist_amplitude", self.twist_amplitude),
        );
        let twist = match twist {
            Ok(Alternative::One(speed)) => Ok(("peak_angular_speed", speed / angular_frequency)),
            Ok(Alternative::Other(amplitude)) => Ok(("twist_amplitude", amplitude)),
            Err(error) => Err(error),
        };
        let (amplitude, phase_lag) = (self.amplitude, self.phase_lag);
        let Some(stator) = self.stator else {
            let amplitude = amplitude.ok_or(Error::NotGiven { field: "amplitude" })?;
            let (_, twist_amplitude) = twist?;
            return Ok(PlatformParameters { amplitude, twist_amplitude, angular_frequency, phase_lag });
        };
        let twist_amplitude = match twist {
            Err(Error::NeitherGiven { .. }) => None,
            twist => Some(twist?),
        };
        let given = GivenMotion { angular_frequency, amplitude, twist_amplitude, phase_lag };
        Ok(stator.build(given)?.motion())
    }

    /// Checks each field separately.
    fn check_ranges(&self) -> Result<(), Error> {
        positive("drive_frequency", self.drive_frequency)?;
        finite("phase_lag", self.phase_lag)?;
        positive("contact_radius", self.contact_radius)?;
        not_negative("friction", self.friction)?;
        restitution(self.restitution)?;
        finite("load_torque", self.load_torque)?;
        for (field, value) in [
            ("amplitude", self.amplitude),
            ("peak_angular_speed", self.peak_angular_speed),
            ("twist_amplitude", self.twist_amplitude),
        ] {
            value.map(|value| not_negative(field, value)).transpose()?;
        }
        for (field, value) in [
            ("mass", self.mass),
            ("density", self.density),
            ("rotor_radius", self.rotor_radius),
            ("rotor_thickness", self.rotor_thickness),
            ("gyration_radius", self.gyration_radius),
            ("preload_force", self.preload_force),
            ("preload_acceleration", self.preload_acceleration),
            ("spring_constant", self.spring_constant),
        ] {
            value.map(|value| positive(field, value)).transpose()?;
        }
        Ok(())
    }

    /// The mass (kg), as given or computed for a solid disc. An unused thickness is an error.
    fn rotor_mass(&self) -> Result<f64, Error> {
        match one_of(("mass", self.mass), ("density", self.density))? {
            Alternative::One(_) if self.rotor_thickness.is_some() => {
                Err(Error::BothGiven { one: "mass", other: "rotor_thickness" })
            }
            Alternative::One(mass) => Ok(mass),
            Alternative::Other(density) => {
                let radius = self.rotor_radius.ok_or(Error::NotGiven { field: "rotor_radius" })?;
                let thickness = self.rotor_thickness.ok_or(Error::NotGiven { field: "rotor_thickness" })?;
                let mass = density * PI * radius * radius * thickness;
                check(
                    mass.is_normal(),
                    "mass = density*pi*rotor_radius^2*rotor_thickness",
                    mass,
                    "[2.3e-308, 1.7e308] (kg)",
                )
            }
        }
    }
}

impl TryFrom<MotorParameters> for Motor {
    type Error = Error;

    fn try_from(parameters: MotorParameters) -> Result<Self, Error> {
        parameters.build()
    }
}

impl From<Motor> for MotorParameters {
    fn from(motor: Motor) -> Self {
        motor.parameters
    }
}

impl From<&Motor> for System {
    fn from(motor: &Motor) -> Self {
        motor.system
    }
}

#[cfg(test)]
mod tests;
