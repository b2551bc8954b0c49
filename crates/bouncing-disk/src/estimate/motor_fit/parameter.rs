//! The motor parameters that can be fitted, and their coordinates.

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::elementary::{exp, ln};

use crate::error::{Error, check, finite, positive};
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::MotorField;
use crate::motor::data_sheet::parameters::MotorParameters;

/// A motor parameter that transients or catalogue points may determine.
///
/// Its coordinate is its natural logarithm for a positive parameter, and the parameter itself if that may be
/// zero or negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum FitParameter {
    /// Coefficient of friction mu. Coordinate: its logarithm.
    Friction,
    /// Coefficient of restitution epsilon. Coordinate: itself.
    Restitution,
    /// Phase lag theta of the twist (rad). Coordinate: itself.
    PhaseLag,
    /// Axial amplitude A of the stator (m). Coordinate: its logarithm.
    Amplitude,
    /// Twist amplitude Phi of the stator (rad), even if the data sheet states the peak angular speed omega
    /// Phi. Coordinate: its logarithm.
    TwistAmplitude,
    /// Duration of an isolated impact (s); zero if impacts are rigid. Coordinate: its logarithm.
    ContactTime,
    /// Effective mass M of a compliant stator (kg). Coordinate: its logarithm.
    StatorMass,
    /// Quality factor Q of a compliant stator, in [0.5, 1e5]. Coordinate: its logarithm.
    StatorQuality,
    /// Twist per height kappa of the stator's mode (rad/m). Coordinate: itself.
    TwistPerHeight,
}

impl FitParameter {
    /// All of them, in their usual order.
    pub const ALL: [Self; 9] = [
        Self::Friction,
        Self::Restitution,
        Self::PhaseLag,
        Self::Amplitude,
        Self::TwistAmplitude,
        Self::ContactTime,
        Self::StatorMass,
        Self::StatorQuality,
        Self::TwistPerHeight,
    ];

    /// The field of the data sheet.
    pub(crate) const fn field(self) -> MotorField {
        match self {
            Self::Friction => MotorField::Friction,
            Self::Restitution => MotorField::Restitution,
            Self::PhaseLag => MotorField::PhaseLag,
            Self::Amplitude => MotorField::Amplitude,
            Self::TwistAmplitude => MotorField::TwistAmplitude,
            Self::ContactTime => MotorField::ContactTime,
            Self::StatorMass => MotorField::StatorMass,
            Self::StatorQuality => MotorField::StatorQuality,
            Self::TwistPerHeight => MotorField::StatorTwistPerHeight,
        }
    }

    /// The name of the field of [`MotorParameters`].
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.field().name()
    }

    /// Its unit in writing: `rad`; `1` for a dimensionless number.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        self.field().unit()
    }

    /// Its value for a motor (SI); NaN for a field of a stator if the motor has none.
    #[must_use]
    pub fn of(self, motor: &Motor) -> f64 {
        let (stator, rotor) = (motor.system().platform(), motor.system().disk());
        match self {
            Self::Friction => rotor.friction(),
            Self::Restitution => rotor.restitution(),
            Self::PhaseLag => stator.phase_lag(),
            Self::Amplitude => stator.amplitude(),
            Self::TwistAmplitude => stator.twist_amplitude(),
            Self::ContactTime => motor.system().soft_contact().map_or(0.0, |(_, time)| time),
            _ => self.field().value(motor.parameters()).unwrap_or(f64::NAN),
        }
    }

    pub(crate) const fn is_size(self) -> bool {
        !matches!(self, Self::Restitution | Self::PhaseLag | Self::TwistPerHeight)
    }

    pub(crate) fn coordinate(self, value: f64) -> f64 {
        if self.is_size() { ln(value) } else { value }
    }

    pub(crate) fn value(self, coordinate: f64) -> f64 {
        if self.is_size() { exp(coordinate) } else { coordinate }
    }

    /// Checks that a motor may have this value.
    pub(crate) fn check(self, field: &'static str, value: f64) -> Result<f64, Error> {
        if self.is_size() {
            positive(field, value)
        } else if self == Self::Restitution {
            check((0.0..1.0).contains(&value), field, value, "[0, 1)")
        } else {
            finite(field, value)
        }
    }

    /// Writes a value into a data sheet.
    pub(crate) fn set(self, sheet: &mut MotorParameters, value: f64) {
        match sheet.peak_angular_speed {
            Some(_) if self == Self::TwistAmplitude => {
                sheet.peak_angular_speed = Some(value * (TAU * sheet.drive_frequency));
            }
            _ => self.field().set(sheet, value),
        }
    }
}

impl std::fmt::Display for FitParameter {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.name())
    }
}

/// A parameter to fit, and its possible range.
///
/// The range also defines "determined": a direction is undetermined if the data leave more than half of the
/// ranges open along it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FitRange {
    /// The parameter.
    pub parameter: FitParameter,
    /// Lower end (SI): positive, or in [0, 1) for the restitution, or finite for the phase lag. Contact times below a
    /// tenth of a period count as rigid.
    pub low: f64,
    /// Upper end (SI), above the lower one, below 1 for the restitution, at most a turn above for the phase
    /// lag.
    pub high: f64,
}

impl FitRange {
    fn check(&self) -> Result<(), Error> {
        let Self { parameter, low, high } = *self;
        for end in [low, high] {
            parameter.check(parameter.name(), end)?;
        }
        check(self.half_width() > 0.0, "upper end of a range", high, "above its lower end")?;
        if parameter == FitParameter::PhaseLag {
            check(high - low <= TAU, "width of the range of the phase lag", high - low, "(0, 2 pi] (rad)")?;
        }
        Ok(())
    }

    /// Checks the range, and that it contains the data sheet's value, except for the contact time, which is
    /// scanned.
    pub(crate) fn check_for(&self, motor: &Motor) -> Result<(), Error> {
        self.check()?;
        let Self { parameter, low, high } = *self;
        let nominal = parameter.of(motor);
        check(
            parameter == FitParameter::ContactTime || nominal >= low && nominal <= high,
            parameter.name(),
            nominal,
            "within the range of the search",
        )?;
        Ok(())
    }

    /// The midpoint of the coordinate's range.
    fn middle(&self) -> f64 {
        0.5 * (self.parameter.coordinate(self.low) + self.parameter.coordinate(self.high))
    }

    /// Half the width of the coordinate's range.
    pub(crate) fn half_width(&self) -> f64 {
        0.5 * (self.parameter.coordinate(self.high) - self.parameter.coordinate(self.low))
    }

    /// The value at a position in the range, from -1 to 1; beyond the ends, the value at the end.
    pub(crate) fn value_at(&self, place: f64) -> f64 {
        let coordinate = self.middle() + self.half_width() * place.clamp(-1.0, 1.0);
        self.parameter.value(coordinate).clamp(self.low, self.high)
    }
}

/// Checks that there are ranges, that the motor has their parameters, and that no parameter is repeated.
pub(crate) fn check_ranges(motor: &Motor, ranges: &[FitRange]) -> Result<(), Error> {
    check(!ranges.is_empty(), "number of fitted parameters", 0.0, "[1, 9]")?;
    for (k, range) in ranges.iter().enumerate() {
        range.check_for(motor)?;
        let again = ranges[..k].iter().filter(|before| before.parameter == range.parameter).count();
        check(again == 0, range.parameter.name(), (again + 1) as f64, "fitted once")?;
    }
    Ok(())
}
