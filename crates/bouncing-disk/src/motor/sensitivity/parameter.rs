//! The parameters and the quantities of a motor's sensitivities.

use crate::error::Error;
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::MotorField;

/// A quantity of a motor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum SensitivityQuantity {
    /// The mean speed under the load of the data sheet (rad/s).
    SteadySpeed,
    /// The load torque (N m) that stops the motor: the true stall. The load of the data sheet has no effect.
    StallTorque,
}

/// A parameter of a motor that is varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum SensitivityParameter {
    /// Coefficient of friction mu.
    Friction,
    /// Largest angular speed omega Phi of the stator (rad/s).
    PeakAngularSpeed,
    /// Phase lag theta (rad).
    PhaseLag,
    /// Contact radius a_e (m).
    ContactRadius,
    /// Radius of gyration a_g (m).
    GyrationRadius,
    /// Load torque T_L (N m).
    LoadTorque,
    /// Axial amplitude A (m), at constant twist.
    Amplitude,
    /// Preload acceleration g (m/s^2).
    Preload,
    /// Coefficient of restitution.
    Restitution,
    /// Drive frequency (Hz), at constant largest angular speed of the stator.
    DriveFrequency,
}

impl SensitivityParameter {
    /// All parameters.
    pub const ALL: [Self; 10] = [
        Self::Friction,
        Self::PeakAngularSpeed,
        Self::PhaseLag,
        Self::ContactRadius,
        Self::GyrationRadius,
        Self::LoadTorque,
        Self::Amplitude,
        Self::Preload,
        Self::Restitution,
        Self::DriveFrequency,
    ];

    /// The field of the data sheet.
    const fn field(self) -> MotorField {
        match self {
            Self::Friction => MotorField::Friction,
            Self::PeakAngularSpeed => MotorField::PeakAngularSpeed,
            Self::PhaseLag => MotorField::PhaseLag,
            Self::ContactRadius => MotorField::ContactRadius,
            Self::GyrationRadius => MotorField::GyrationRadius,
            Self::LoadTorque => MotorField::LoadTorque,
            Self::Amplitude => MotorField::Amplitude,
            Self::Preload => MotorField::PreloadAcceleration,
            Self::Restitution => MotorField::Restitution,
            Self::DriveFrequency => MotorField::DriveFrequency,
        }
    }

    /// The name of the parameter: the field's name, or `preload`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        if matches!(self, Self::Preload) { "preload" } else { self.field().name() }
    }

    /// Whether the vertical motion is independent of the parameter, so that all its values share one orbit.
    #[must_use]
    pub const fn shares_vertical_motion(self) -> bool {
        !matches!(self, Self::Amplitude | Self::Preload | Self::Restitution | Self::DriveFrequency)
    }

    /// The value of the parameter for a motor.
    #[must_use]
    pub fn of(self, motor: &Motor) -> f64 {
        let (platform, disk) = (motor.system().platform(), motor.system().disk());
        match self {
            Self::Friction => disk.friction(),
            Self::PeakAngularSpeed => platform.peak_angular_speed(),
            Self::PhaseLag => platform.phase_lag(),
            Self::ContactRadius => disk.contact_radius(),
            Self::GyrationRadius => disk.gyration_radius(),
            Self::LoadTorque => motor.load_torque(),
            Self::Amplitude => platform.amplitude(),
            Self::Preload => motor.preload_acceleration(),
            Self::Restitution => disk.restitution(),
            Self::DriveFrequency => motor.parameters().drive_frequency,
        }
    }

    /// The motor with another value of the parameter, which replaces an alternative in the data sheet.
    ///
    /// # Errors
    /// The errors of [`MotorParameters::build`](crate::motor::MotorParameters::build).
    pub fn set(self, motor: &Motor, value: f64) -> Result<Motor, Error> {
        let speed = motor.system().platform().peak_angular_speed();
        motor.with(|sheet| {
            self.field().set(sheet, value);
            if self == Self::DriveFrequency {
                MotorField::PeakAngularSpeed.set(sheet, speed);
            }
        })
    }
}

impl std::fmt::Display for SensitivityParameter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}
