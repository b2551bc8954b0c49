//! A check of a data sheet: its derived quantities, and the behaviour of the motor.

use std::fmt::{self, Display, Formatter};

use bouncing_disk_core::Observer;

use crate::display::{number, rough};
use crate::error::Error;
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::regime::{MotorRegime, regime};
use crate::motor::data_sheet::warning::MotorWarning;
use crate::parameters::contact::estimate::ContactStatement;

/// The derived quantities of a data sheet, and the behaviour of the motor ([`Motor::report`]). It prints as
/// several lines.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MotorReport {
    /// Axial forcing parameter Gamma = A omega^2/(pi g).
    pub axial_forcing: f64,
    /// Angular forcing parameter Gamma_T = a_g^2 Phi omega^2/(a_e pi g mu); `None` without friction.
    pub angular_forcing: Option<f64>,
    /// P = A omega^2/g, the stator's largest acceleration in units of the preload acceleration.
    pub peak_acceleration: f64,
    /// The vertical motion of the rotor.
    pub regime: MotorRegime,
    /// Mean number of the stator's periods in a flight, over the flights longer than half a period, as a
    /// chatter has infinitely many short ones. From a perturbed motion of 20 000 to 200 000 impacts. `None`
    /// where no flight is that long.
    pub periods_per_flight: Option<f64>,
    /// Mean speed of the impacts that end these flights (m/s).
    pub impact_speed: Option<f64>,
    /// How long these impacts last; `None` if the data sheet does not have what that needs.
    pub contact: Option<ContactStatement>,
    /// mu m g a_e (N m), which no motor exceeds in the mean.
    pub largest_torque: f64,
    /// Static deflection of the preload's spring (m); `None` without a spring.
    pub static_deflection: Option<f64>,
    /// A bound on the relative change of the preload in a flight, which the model keeps constant; `None`
    /// without a spring ([`Motor::preload_change_bound`]).
    pub preload_change_bound: Option<f64>,
    /// Values that are unlikely to be intended.
    pub warnings: Vec<MotorWarning>,
}

impl Motor {
    /// Follows the rotor for 20 000 to 300 000 impacts, which takes a few to some 100 ms, and reports its
    /// motion.
    ///
    /// The items of `observer` are the impacts of up to three motions, each counted from 0.
    ///
    /// # Errors
    /// [`Error::YieldingStator`]; those of the core, for a flight longer than it can count.
    pub fn report(&self, observer: &dyn Observer) -> Result<MotorReport, Error> {
        self.system().prescribed()?;
        let (regime, flight) = regime(self.system().dimensionless(), observer)?;
        let system = self.system();
        let impact_speed = flight.map(|mean| mean.impact_speed * system.scales().velocity);
        let contact = system.contact_statement(impact_speed);
        let mut warnings = self.warnings();
        for warning in contact.iter().flat_map(ContactStatement::warnings).map(MotorWarning::Contact) {
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
        warnings.extend(system.soft_contact().map(|_| MotorWarning::RigidRegime));
        Ok(MotorReport {
            axial_forcing: system.axial_forcing(),
            angular_forcing: system.angular_forcing(),
            peak_acceleration: system.peak_acceleration(),
            regime,
            periods_per_flight: flight.map(|mean| mean.periods),
            impact_speed,
            contact,
            largest_torque: self.largest_torque(),
            static_deflection: self.static_deflection(),
            preload_change_bound: self.preload_change_bound(),
            warnings,
        })
    }
}

/// Several lines, without a line end after the last one.
impl Display for MotorReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write_forcing(f, self.axial_forcing, self.angular_forcing, self.peak_acceleration)?;
        write!(f, "\nregime: {}", self.regime)?;
        if let Some(periods) = self.periods_per_flight {
            write!(f, "\na flight lasts {} periods in the mean", rough(periods))?;
        }
        for (name, value) in ContactStatement::rows(self.contact.as_ref()) {
            write!(f, "\n{}: {value}", name.replace('_', " "))?;
        }
        write_torque_and_spring(f, self.largest_torque, self.static_deflection, self.preload_change_bound)?;
        write_warnings(f, &self.warnings)
    }
}

/// Several lines, without a line end after the last one.
impl Display for Motor {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let system = self.system();
        write_forcing(f, system.axial_forcing(), system.angular_forcing(), system.peak_acceleration())?;
        let (deflection, bound) = (self.static_deflection(), self.preload_change_bound());
        write_torque_and_spring(f, self.largest_torque(), deflection, bound)?;
        write_warnings(f, &self.warnings())
    }
}

/// The forcing parameters, on one line.
fn write_forcing(f: &mut Formatter<'_>, axial: f64, angular: Option<f64>, peak: f64) -> fmt::Result {
    let angular = angular.map_or("infinite (no friction)".to_owned(), |forcing| number(forcing).to_string());
    write!(f, "Gamma = {}, Gamma_T = {angular}, P = {} g", number(axial), number(peak))
}

/// Torque and spring, on lines of their own.
fn write_torque_and_spring(
    f: &mut Formatter<'_>,
    largest_torque: f64,
    static_deflection: Option<f64>,
    preload_change_bound: Option<f64>,
) -> fmt::Result {
    write!(f, "\nlargest torque mu m g a_e = {} N m", number(largest_torque))?;
    if let Some(deflection) = static_deflection {
        write!(f, "\nstatic deflection of the spring = {} m", number(deflection))?;
    }
    if let Some(bound) = preload_change_bound {
        let change = rough(100.0 * bound);
        write!(f, "\nthe preload is kept constant; in a flight it changes by at most {change} %")?;
    }
    Ok(())
}

/// Each warning on a line of its own.
fn write_warnings(f: &mut Formatter<'_>, warnings: &[MotorWarning]) -> fmt::Result {
    warnings.iter().try_for_each(|warning| write!(f, "\nwarning: {warning}"))
}
