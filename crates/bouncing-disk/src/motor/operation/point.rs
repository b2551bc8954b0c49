//! The steady operation of a motor under a load.

use bouncing_disk_core::numerics::statistics::{NORMAL_975, mean, standard_deviation};

use crate::error::{Error, finite, not_negative};
use crate::motor::operation::member::size_of_perturbation;
use crate::statistics::student_quantile;

/// A number estimated from independent runs, with its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Its standard error, defined as half of its 95 % interval divided by 1.96. It covers the scatter of a
    /// few members (Student's distribution) and, for a mean over time, a bound on the remainder of the
    /// start-up. For the speed of a motor whose stator has kinks, the error also covers the differences
    /// between members, because each start may then keep its own speed.
    pub standard_error: f64,
}

impl Estimate {
    /// This estimate in another unit, `factor` of which make one of the present unit.
    pub(crate) fn times(self, factor: f64) -> Self {
        Self { value: factor * self.value, standard_error: factor * self.standard_error }
    }

    /// The mean of independent values, at least one.
    pub(crate) fn of(values: &[f64]) -> Result<Self, Error> {
        let value = finite("estimate", mean(values))?;
        let standard_error = error_of_mean(values);
        Ok(Self { value, standard_error: not_negative("standard_error", standard_error)? })
    }

    /// The mean of the values of members with perturbations of three sizes; the error follows from the
    /// scatter about the mean at each size.
    pub(crate) fn of_decade(values: &[f64]) -> Result<Self, Error> {
        let sizes = by_perturbation(values);
        let (count, squares) = (values.len() as f64, sizes.iter().map(|own| squares_about_mean(own)));
        let (variance, freedom) = (squares.sum::<f64>(), count - sizes.len() as f64);
        let standard_error = (variance / freedom / count).sqrt() * (student_quantile(freedom) / NORMAL_975);
        Ok(Self { value: finite("estimate", mean(values))?, standard_error })
    }

    /// The mean of runs from two sides, with its distance from `one` of the sides as a bound on its bias.
    pub(crate) fn bounded_by(self, one: Self) -> Self {
        let bias = (one.value - self.value).abs();
        Self { standard_error: self.standard_error + bias / NORMAL_975, ..self }
    }

    /// The ratio of two means, with its error to first order; `None` if the divisor is not positive.
    pub(crate) fn of_ratio(dividends: &[f64], divisors: &[f64]) -> Option<Self> {
        let divisor = mean(divisors);
        let value = mean(dividends) / divisor;
        if !(divisor > 0.0 && value.is_finite()) {
            return None;
        }
        let rests: Vec<f64> =
            dividends.iter().zip(divisors).map(|(one, other)| one - value * other).collect();
        let standard_error = error_of_mean(&rests) / divisor;
        standard_error.is_finite().then_some(Self { value, standard_error })
    }
}

/// The standard error of the mean of independent values, defined such that 1.96 times this error is half of
/// Student's 95 % interval.
pub(crate) fn error_of_mean(values: &[f64]) -> f64 {
    let size = values.len() as f64;
    standard_deviation(values) / size.sqrt() * (student_quantile(size - 1.0) / NORMAL_975)
}

/// The values of members, grouped by the size of their perturbation.
pub(crate) fn by_perturbation(values: &[f64]) -> [Vec<f64>; 3] {
    [0, 1, 2].map(|size| {
        let own = values.iter().enumerate().filter(|(index, _)| size_of_perturbation(*index) == size);
        own.map(|(_, value)| *value).collect()
    })
}

fn squares_about_mean(values: &[f64]) -> f64 {
    let about = mean(values);
    values.iter().map(|value| (value - about) * (value - about)).sum()
}

#[cfg(feature = "serde")]
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// The vertical motion of the rotor in a steady operation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub enum AxialMotion {
    /// The motion was not found to repeat: means are over time and over an ensemble.
    Irregular {
        /// The life of the motion.
        life: Life,
    },
    /// The vertical motion repeats, as does the rotor: means are over one cycle.
    Periodic {
        /// Periods of the drive.
        periods: u64,
        /// Impacts per cycle.
        impacts: u64,
    },
    /// The rotor stays on the stator.
    Contact,
}

/// The time after which an irregular motion changes into another motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub enum Life {
    /// The mean life (s), from motions that were seen to end.
    Mean(Estimate),
    /// No motion was seen to end; the longest observation lasted for this time (s).
    NoneEndedIn(f64),
}

/// A motor in steady operation. All numbers are means over time and over the members of one ensemble of runs.
///
/// Energy is balanced: the input of platform and perturbation equals the mechanical power, the two losses and
/// the energy stored by the disk.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct OperatingPoint {
    /// Load torque T_L (N m); a positive torque decelerates a positive rotation. For a load that depends on
    /// the speed, this is the mean torque.
    pub load_torque: f64,
    /// Its standard error; `None` for a constant torque.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_zero"))]
    pub load_torque_error: f64,
    /// The vertical motion of the rotor.
    pub motion: AxialMotion,
    /// Mean angular speed (rad/s).
    pub speed: Estimate,
    /// Standard deviation of the speed over time (rad/s); `None` for a rotor that acts back on its stator.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub speed_deviation: Option<Estimate>,
    /// The range (rad/s) of the rotor's speed during 95 % of the time, or over a whole cycle if the motion
    /// repeats; `None` for a rotor that acts back on its stator.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub speed_range: Option<[Estimate; 2]>,
    /// Time constant (s) of the speed, from the slope of the torque-speed curve: the moment of inertia times
    /// the change of the speed with the load, up to the nearest other load of the same run. `None` if no
    /// other load has a different speed, as for a locked motor, and for a rotor that acts back on its stator.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub time_constant: Option<Estimate>,
    /// The speed (rad/s) between the two that the rotor may keep if the load decreases with the speed; a
    /// rotor that passes this speed changes to the other one.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub unstable_speed: Option<Estimate>,
    /// Mean torque (N m) of friction on a rotor that is held at rest; `None` for a rotor that acts back on
    /// its stator.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub blocked_torque: Option<Estimate>,
    /// Mechanical power, the mean of load torque times speed (W); negative if the load drives the motor.
    pub mechanical_power: Estimate,
    /// Power (W) that the platform supplies by normal forces and by friction.
    pub input_power: Estimate,
    /// Power lost in the restitution of impacts (W).
    pub restitution_loss: Estimate,
    /// Power lost in friction (W).
    pub friction_loss: Estimate,
    /// Mechanical power divided by the input power; `None` if there is no input power, or if the load drives
    /// the motor.
    pub efficiency: Option<Estimate>,
    /// Power supplied by the perturbations of the relaunches (W). This power does not belong to the motor,
    /// and must be small.
    pub perturbation_power: f64,
    /// Residual of the energy balance of all runs, relative to the larger of the energy supplied and the
    /// energy of a disk that moves with the platform: zero up to rounding.
    pub energy_residual: f64,
    /// Averaged time of all members together (s).
    pub averaged_time: f64,
    /// Time of each member that is omitted as start-up (s).
    pub start_up: f64,
    /// Number of impacts of all members together, without those of summed chattering sequences and of the
    /// start-up.
    pub impacts: u64,
    /// Additional quantities for a compliant stator.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub stator: Option<StatorPoint>,
}

/// The state of a compliant stator under a motor in steady operation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct StatorPoint {
    /// Amplitude of the axial mode under load (m): 2^(1/2) times the root mean square of its speed divided by
    /// the angular frequency of the drive. A sine of this amplitude loses the same power in the damping. A
    /// static sag is not included; motions at other frequencies contribute through their speed.
    pub amplitude: Estimate,
    /// Power that the drive supplies to the modes, and to a prescribed twist (W): for a drive in volts, the
    /// real part of voltage times current.
    pub drive_power: Estimate,
    /// Power lost in the damping of the modes (W).
    pub damping_loss: Estimate,
    /// Mechanical power divided by the drive's power; `None` if the load drives the motor.
    pub efficiency: Option<Estimate>,
}

/// Why a steady operation did not reach the requested accuracy within the allowed impacts.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub enum Shortfall {
    /// The standard error of the mean speed is too large.
    Error {
        /// The error reached (rad/s).
        standard_error: f64,
        /// The requested error (rad/s).
        wanted: f64,
    },
    /// The speed, or the amplitude of a compliant stator, still drifts: the early and the late part of the
    /// average differ, or the average depends on the initial speed.
    Drift {
        /// The late mean minus the early one (rad/s), or the excess speed of rotors that started from far
        /// above. A drift of the amplitude is converted as if the speed were proportional to it.
        drift: f64,
        /// The standard error of this difference (rad/s).
        standard_error: f64,
    },
    /// Each start keeps its own speed, as on some stators with kinks: there is no unique steady speed.
    Start {
        /// The largest difference (rad/s) between the speed from one start and the mean over starts.
        spread: f64,
        /// The standard error of the mean over starts (rad/s).
        standard_error: f64,
    },
    /// The disk still stores energy: the input power does not equal output and losses.
    PowerBalance {
        /// The stored power (W); negative if the disk releases energy.
        stored_power: f64,
        /// The input power (W).
        input_power: f64,
    },
}

/// The outcome for a motor under a load.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub enum Operation {
    /// The motor turns steadily, and its speed is known to the requested accuracy.
    Steady(OperatingPoint),
    /// The motor was not followed for long enough. The values are the operating point as far as it is known,
    /// and the shortfall.
    Unsettled(OperatingPoint, Shortfall),
    /// The load overpowers the motor: it accelerates the rotor for ever, and there is no mean speed.
    Runaway {
        /// Load torque T_L (N m).
        load_torque: f64,
        /// The largest mean torque mu m g a_e of friction (N m), whatever the motion.
        largest_torque: f64,
        /// The acceleration (rad/s^2) to which the rotor tends, due to the part of the load that friction
        /// cannot balance.
        acceleration: f64,
    },
}

impl Operation {
    pub(crate) fn point_mut(&mut self) -> Option<&mut OperatingPoint> {
        match self {
            Self::Steady(point) | Self::Unsettled(point, _) => Some(point),
            Self::Runaway { .. } => None,
        }
    }

    /// The operating point, if it is known to the requested accuracy.
    #[must_use]
    pub const fn steady(&self) -> Option<&OperatingPoint> {
        match self {
            Self::Steady(point) => Some(point),
            Self::Unsettled(..) | Self::Runaway { .. } => None,
        }
    }

    /// The operating point, however well it is known; `None` for a runaway.
    #[must_use]
    pub const fn point(&self) -> Option<&OperatingPoint> {
        match self {
            Self::Steady(point) | Self::Unsettled(point, _) => Some(point),
            Self::Runaway { .. } => None,
        }
    }

    /// The load torque T_L (N m).
    #[must_use]
    pub const fn load_torque(&self) -> f64 {
        match self {
            Self::Steady(point) | Self::Unsettled(point, _) => point.load_torque,
            Self::Runaway { load_torque, .. } => *load_torque,
        }
    }
}

/// The coexisting operations of a motor under one load.
///
/// Most motors have a single operation. With contacts of about half a period, or on a compliant stator, the
/// rotor may have several vertical motions, each with its own speed; the start decides which of them is
/// reached.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct OperatingRow {
    /// At least one operation; the first is the operation that most rotors reach from rest.
    pub branches: Vec<Operation>,
}

impl OperatingRow {
    /// The operation of most rotors that started from rest.
    #[must_use]
    pub fn operation(&self) -> &Operation {
        &self.branches[0]
    }

    /// Whether a rotor that starts from rest finally turns against its load; without a load, whether it
    /// turns. `None` if the errors leave this open.
    #[must_use]
    pub fn starts(&self) -> Option<bool> {
        let Some(point) = self.point() else { return Some(false) };
        let drives = if point.load_torque == 0.0 {
            Estimate { value: point.speed.value.abs(), ..point.speed }
        } else {
            point.mechanical_power
        };
        let within = NORMAL_975 * drives.standard_error;
        if drives.value > within {
            Some(true)
        } else if drives.value < -within || drives.value == 0.0 {
            Some(false)
        } else {
            None
        }
    }

    /// [`Operation::steady`] of [`Self::operation`].
    #[must_use]
    pub fn steady(&self) -> Option<&OperatingPoint> {
        self.operation().steady()
    }

    /// [`Operation::point`] of [`Self::operation`].
    #[must_use]
    pub fn point(&self) -> Option<&OperatingPoint> {
        self.operation().point()
    }

    /// The load torque T_L (N m).
    #[must_use]
    pub fn load_torque(&self) -> f64 {
        self.operation().load_torque()
    }
}
