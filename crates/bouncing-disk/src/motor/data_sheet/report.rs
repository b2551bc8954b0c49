//! A check of a data sheet: derived quantities, and the behaviour of the motor.

use std::f64::consts::TAU;
use std::fmt::{self, Display, Formatter};

use bouncing_disk_core::Observer;

use crate::display::{number, rough};
use crate::error::Error;
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::regime::{MotorRegime, regime};
use crate::motor::data_sheet::warning::MotorWarning;
use crate::parameters::contact::estimate::ContactStatement;
use crate::stator::StatorSystem;

/// The derived quantities of a data sheet, and the behaviour of the motor ([`Motor::report`]). The report
/// prints as several lines.
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
    /// Mean duration of the flights longer than half a period, in periods of the stator; a chatter has
    /// infinitely many shorter flights. The mean is measured on a perturbed motion of 20 000 to 200 000
    /// impacts. `None` if no flight is that long.
    pub periods_per_flight: Option<f64>,
    /// Mean speed of the impacts that end these flights (m/s).
    pub impact_speed: Option<f64>,
    /// Duration of these impacts; `None` if the data sheet lacks the required values.
    pub contact: Option<ContactStatement>,
    /// mu m g a_e (N m), the largest mean torque of any motor.
    pub largest_torque: f64,
    /// Static deflection of the preload's spring (m); `None` without a spring.
    pub static_deflection: Option<f64>,
    /// A bound on the relative change of the preload during a flight, which the model keeps constant; `None`
    /// without a spring ([`Motor::preload_change_bound`]).
    pub preload_change_bound: Option<f64>,
    /// Values that are unlikely to be intended.
    pub warnings: Vec<MotorWarning>,
}

impl Motor {
    /// Follows the rotor for 20 000 to 300 000 impacts, which takes from a few to about 100 ms, and reports
    /// its motion. Of all results, only the warning of an overload depends on the load.
    ///
    /// The observer's items are the impacts of up to three motions, each counted from 0.
    ///
    /// # Errors
    /// [`Error::YieldingStator`] for a compliant stator, for which there is [`Self::stator_report`];
    /// [`Error::DriveNotSine`]; the core's error for a flight longer than it can count.
    pub fn report(&self, observer: &dyn Observer) -> Result<MotorReport, Error> {
        if self.stator().is_some() {
            return Err(Error::YieldingStator);
        }
        self.parameters().drive.sine()?;
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

/// Quantities that follow from the table `[stator]` of a data sheet without computing a motion
/// ([`Motor::stator_report`]). The report prints as several lines, the last of which describe the motor.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct StatorReport {
    motor: Motor,
    /// Effective mass M of the axial mode divided by the mass m of the rotor.
    pub mass_ratio: f64,
    /// Amplitude of the height without a rotor (m).
    pub amplitude: f64,
    /// Amplitude F_0 of the force that drives the axial mode (N).
    pub force: f64,
    /// Amplitude of the voltage (V); `None` without a circuit, like `current` and `power`.
    pub volts: Option<f64>,
    /// Amplitude of the current without a rotor (A); also `None` without a capacitance.
    pub current: Option<f64>,
    /// Power that the circuit draws without a rotor (W).
    pub power: Option<f64>,
    /// The preload (N) above which a rotor at rest is no longer lifted
    /// ([`StatorModes::lift_off_preload`](crate::parameters::StatorModes::lift_off_preload)); also `None` for
    /// compliant contacts.
    pub lift_off_preload: Option<f64>,
    /// The contact time of the sheet, which is for a rigid platform, in periods of the drive.
    pub contact_periods: Option<f64>,
    /// The contact time on this stator, whose modes recoil, in periods of the drive, and the restitution
    /// there.
    pub isolated_contact: Option<[f64; 2]>,
}

impl StatorReport {
    /// Name, value and unit of all known quantities.
    pub fn rows(&self) -> impl Iterator<Item = (&'static str, f64, &'static str)> {
        let rows = [
            ("mass_ratio", Some(self.mass_ratio), "1"),
            ("amplitude_without_rotor", Some(self.amplitude), "m"),
            ("force", Some(self.force), "N"),
            ("volts", self.volts, "V"),
            ("current_without_rotor", self.current, "A"),
            ("power_without_rotor", self.power, "W"),
            ("lift_off_preload", self.lift_off_preload, "N"),
            ("contact_time_over_period", self.contact_periods, "1"),
            ("contact_time_on_this_stator_over_period", self.isolated_contact.map(|own| own[0]), "1"),
            ("restitution_on_this_stator", self.isolated_contact.map(|own| own[1]), "1"),
        ];
        rows.into_iter().filter_map(|(name, value, unit)| Some((name, value?, unit)))
    }
}

impl Motor {
    /// The quantities that follow from the table `[stator]`; `None` without one.
    #[must_use]
    pub fn stator_report(&self) -> Option<StatorReport> {
        let stator = self.stator()?;
        let electrical = stator.electrical_input_at(stator.motion().angular_frequency);
        let rigid = self.system().soft_contact().is_none();
        let own = self.stator_motion().yielded();
        Some(StatorReport {
            motor: self.clone(),
            mass_ratio: stator.modes()[0].mass / self.mass(),
            amplitude: stator.motion().amplitude,
            force: stator.modes()[0].force,
            volts: stator.circuit().map(|circuit| circuit.volts),
            current: electrical.and_then(|input| input.current).map(|(amplitude, _)| amplitude),
            power: electrical.map(|input| input.power),
            lift_off_preload: stator.lift_off_preload(self.mass()).filter(|_| rigid),
            contact_periods: own.and_then(|own| Some(own.contact_time()? / TAU)),
            isolated_contact: own
                .and_then(StatorSystem::isolated_contact)
                .map(|[time, kept]| [time / TAU, kept]),
        })
    }
}

impl Display for StatorReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (name, value, unit) in self.rows() {
            let unit = if unit == "1" { "" } else { unit };
            writeln!(f, "{}", format!("{} = {} {unit}", name.replace('_', " "), number(value)).trim_end())?;
        }
        self.motor.fmt(f)
    }
}

/// Prints several lines, without a newline after the last one.
impl Display for MotorReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write_forcing(f, self.axial_forcing, self.angular_forcing, self.peak_acceleration)?;
        write!(f, "\nregime: {}", self.regime)?;
        if let Some(periods) = self.periods_per_flight {
            write!(f, "\na flight lasts {} periods on average", rough(periods))?;
        }
        for (name, value) in ContactStatement::rows(self.contact.as_ref()) {
            write!(f, "\n{}: {value}", name.replace('_', " "))?;
        }
        write_torque_and_spring(f, self.largest_torque, self.static_deflection, self.preload_change_bound)?;
        write_warnings(f, &self.warnings)
    }
}

/// Prints several lines, without a newline after the last one.
impl Display for Motor {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let system = self.system();
        write_forcing(f, system.axial_forcing(), system.angular_forcing(), system.peak_acceleration())?;
        if self.stator().is_some() {
            // A rotor slows its stator down.
            f.write_str(" (without rotor)")?;
        }
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

/// Torque and spring, on separate lines.
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

/// Each warning on a separate line.
fn write_warnings(f: &mut Formatter<'_>, warnings: &[MotorWarning]) -> fmt::Result {
    warnings.iter().try_for_each(|warning| write!(f, "\nwarning: {warning}"))
}
