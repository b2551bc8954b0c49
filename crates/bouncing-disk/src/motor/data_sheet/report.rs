//! Whether a data sheet makes sense: what follows from it, and what the motor does.

use std::fmt::{self, Display, Formatter};

use bouncing_disk_core::Observer;

use crate::display::rough;
use crate::error::Error;
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::facts::{Facts, write_warnings};
use crate::motor::data_sheet::regime::{MotorRegime, regime};
use crate::motor::data_sheet::warning::MotorWarning;

/// What follows from a data sheet, and what the motor does ([`Motor::report`]). Printed, it has several
/// lines.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MotorReport {
    /// Axial forcing parameter Gamma = A omega^2/(pi g).
    pub axial_forcing: f64,
    /// Angular forcing parameter Gamma_T = a_g^2 Phi omega^2/(a_e pi g mu); `None` without friction.
    pub angular_forcing: Option<f64>,
    /// P = A omega^2/g, the stator's largest acceleration in units of the preload acceleration.
    pub peak_acceleration: f64,
    /// What the rotor does up and down.
    pub regime: MotorRegime,
    /// Mean number of the stator's periods in a flight, over the flights longer than half a period: of the
    /// short ones a chatter has infinitely many. From a perturbed motion of 20 000 to 200 000 impacts. `None`
    /// where no flight is that long.
    pub periods_per_flight: Option<f64>,
    /// mu m g a_e (N m), which no motor exceeds in the mean.
    pub largest_torque: f64,
    /// Static deflection of the preload's spring (m); `None` without a spring.
    pub static_deflection: Option<f64>,
    /// A bound on the relative change of the preload in a flight, which the model keeps constant; `None`
    /// without a spring ([`Motor::preload_change_bound`]).
    pub preload_change_bound: Option<f64>,
    /// What is unlikely to be meant.
    pub warnings: Vec<MotorWarning>,
}

impl Motor {
    /// Follows the rotor for 20 000 to 300 000 impacts, which takes a few to some 100 ms, and says what it
    /// does.
    ///
    /// The items of `observer` are the impacts of up to three motions, each counted from 0.
    ///
    /// # Errors
    /// Those of the core, for a flight that lasts longer than it can count.
    pub fn report(&self, observer: &dyn Observer) -> Result<MotorReport, Error> {
        let (regime, periods_per_flight) = regime(self.system().dimensionless(), observer)?;
        let Facts {
            axial_forcing,
            angular_forcing,
            peak_acceleration,
            largest_torque,
            static_deflection,
            preload_change_bound,
        } = Facts::of(self);
        Ok(MotorReport {
            axial_forcing,
            angular_forcing,
            peak_acceleration,
            regime,
            periods_per_flight,
            largest_torque,
            static_deflection,
            preload_change_bound,
            warnings: self.warnings(),
        })
    }
}

/// Several lines, without a line end after the last one.
impl Display for MotorReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let facts = Facts {
            axial_forcing: self.axial_forcing,
            angular_forcing: self.angular_forcing,
            peak_acceleration: self.peak_acceleration,
            largest_torque: self.largest_torque,
            static_deflection: self.static_deflection,
            preload_change_bound: self.preload_change_bound,
        };
        facts.write_forcing(f)?;
        write!(f, "\nregime: {}", self.regime)?;
        if let Some(periods) = self.periods_per_flight {
            write!(f, "\na flight lasts {} periods in the mean", rough(periods))?;
        }
        facts.write_rest(f)?;
        write_warnings(f, &self.warnings)
    }
}
