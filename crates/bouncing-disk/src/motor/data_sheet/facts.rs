//! What follows from a data sheet without computing a motion, as lines of text.

use std::fmt::{self, Display, Formatter};

use crate::display::{number, rough};
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::warning::MotorWarning;

/// The numbers that a motor and its report both print.
pub(crate) struct Facts {
    pub(crate) axial_forcing: f64,
    pub(crate) angular_forcing: Option<f64>,
    pub(crate) peak_acceleration: f64,
    pub(crate) largest_torque: f64,
    pub(crate) static_deflection: Option<f64>,
    pub(crate) preload_change_bound: Option<f64>,
}

impl Facts {
    pub(crate) fn of(motor: &Motor) -> Self {
        let system = motor.system();
        Self {
            axial_forcing: system.axial_forcing(),
            angular_forcing: system.angular_forcing(),
            peak_acceleration: system.peak_acceleration(),
            largest_torque: motor.largest_torque(),
            static_deflection: motor.static_deflection(),
            preload_change_bound: motor.preload_change_bound(),
        }
    }

    /// The forcing parameters, on one line.
    pub(crate) fn write_forcing(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "Gamma = {}, Gamma_T = ", number(self.axial_forcing))?;
        match self.angular_forcing {
            Some(forcing) => number(forcing).fmt(f)?,
            None => f.write_str("infinite (no friction)")?,
        }
        write!(f, ", P = {} g", number(self.peak_acceleration))
    }

    /// Torque and spring, on lines of their own.
    pub(crate) fn write_rest(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "\nlargest torque mu m g a_e = {} N m", number(self.largest_torque))?;
        if let Some(deflection) = self.static_deflection {
            write!(f, "\nstatic deflection of the spring = {} m", number(deflection))?;
        }
        if let Some(bound) = self.preload_change_bound {
            write!(
                f,
                "\nthe preload is kept constant; in a flight it changes by at most {} %",
                rough(100.0 * bound)
            )?;
        }
        Ok(())
    }
}

/// Each warning on a line of its own.
pub(crate) fn write_warnings(f: &mut Formatter<'_>, warnings: &[MotorWarning]) -> fmt::Result {
    warnings.iter().try_for_each(|warning| write!(f, "\nwarning: {warning}"))
}

/// Several lines, without a line end after the last one.
impl Display for Motor {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let facts = Facts::of(self);
        facts.write_forcing(f)?;
        facts.write_rest(f)?;
        write_warnings(f, &self.warnings())
    }
}
