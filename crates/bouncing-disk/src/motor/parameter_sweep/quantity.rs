//! The quantities that a sweep computes in each cell.

use std::str::FromStr;

use crate::motor::operation::point::{Estimate, OperatingRow, Operation};

/// A quantity of an operating point that is estimated with a standard error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum SweepQuantity {
    /// Mean angular speed (rad/s).
    Speed,
    /// Mean load torque (N m). Tables state the load torque for each row anyway, so it is not in
    /// [`Self::ALL`].
    Torque,
    /// Load torque times mean speed (W).
    MechanicalPower,
    /// Power supplied by the platform (W).
    InputPower,
    /// Power lost in restitution (W).
    RestitutionLoss,
    /// Power lost in friction (W).
    FrictionLoss,
    /// Mechanical power divided by the input power.
    Efficiency,
    /// Standard deviation of the speed over time (rad/s); see
    /// [`OperatingPoint::speed_deviation`](crate::motor::OperatingPoint::speed_deviation).
    SpeedDeviation,
    /// Lower end of the speed range (rad/s); see
    /// [`OperatingPoint::speed_range`](crate::motor::OperatingPoint::speed_range).
    SpeedLow,
    /// Upper end of the speed range (rad/s).
    SpeedHigh,
    /// Time constant of the speed (s); see
    /// [`OperatingPoint::time_constant`](crate::motor::OperatingPoint::time_constant).
    TimeConstant,
    /// Unstable speed (rad/s) between the two that a rotor may keep; see
    /// [`OperatingPoint::unstable_speed`](crate::motor::OperatingPoint::unstable_speed).
    UnstableSpeed,
    /// Mean torque on a rotor that is held at rest (N m); see
    /// [`OperatingPoint::blocked_torque`](crate::motor::OperatingPoint::blocked_torque).
    BlockedTorque,
    /// Amplitude of a compliant stator under load (m); see
    /// [`StatorPoint::amplitude`](crate::motor::StatorPoint::amplitude).
    StatorAmplitude,
    /// Power that the drive supplies to a compliant stator (W).
    DrivePower,
    /// Power lost in the damping of a compliant stator's modes (W).
    DampingLoss,
    /// Mechanical power divided by the drive's power.
    ElectricalEfficiency,
}

impl SweepQuantity {
    /// All quantities except `Torque` and those of a compliant stator, in the order of the columns of a
    /// table.
    pub const ALL: [Self; 12] = {
        let [a, b, c, d, e, f, g, h, i, j, k, l, ..] = Self::WITH_STATOR;
        [a, b, c, d, e, f, g, h, i, j, k, l]
    };

    /// All quantities, with those of a compliant stator last.
    pub const WITH_STATOR: [Self; 16] = [
        Self::Speed,
        Self::MechanicalPower,
        Self::InputPower,
        Self::RestitutionLoss,
        Self::FrictionLoss,
        Self::Efficiency,
        Self::SpeedDeviation,
        Self::SpeedLow,
        Self::SpeedHigh,
        Self::TimeConstant,
        Self::UnstableSpeed,
        Self::BlockedTorque,
        Self::StatorAmplitude,
        Self::DrivePower,
        Self::DampingLoss,
        Self::ElectricalEfficiency,
    ];

    /// The quantities of a table of these operations; quantities of a stator are included only if an
    /// operation states them.
    #[must_use]
    pub fn of_table(rows: &[OperatingRow]) -> &'static [Self] {
        let yields = |row: &OperatingRow| row.point().is_some_and(|point| point.stator.is_some());
        if rows.iter().any(yields) { &Self::WITH_STATOR } else { &Self::ALL }
    }

    /// The name of the quantity, for example `mechanical_power`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::Torque => "torque",
            Self::MechanicalPower => "mechanical_power",
            Self::InputPower => "input_power",
            Self::RestitutionLoss => "restitution_loss",
            Self::FrictionLoss => "friction_loss",
            Self::Efficiency => "efficiency",
            Self::SpeedDeviation => "speed_deviation",
            Self::SpeedLow => "speed_low",
            Self::SpeedHigh => "speed_high",
            Self::TimeConstant => "time_constant",
            Self::UnstableSpeed => "unstable_speed",
            Self::BlockedTorque => "blocked_torque",
            Self::StatorAmplitude => "stator_amplitude",
            Self::DrivePower => "drive_power",
            Self::DampingLoss => "damping_loss",
            Self::ElectricalEfficiency => "electrical_efficiency",
        }
    }

    /// The unit of the quantity: `rad/s`, `N m`, `s`, `W`, `m`, or `1` for a dimensionless number.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Speed | Self::SpeedDeviation | Self::SpeedLow | Self::SpeedHigh | Self::UnstableSpeed => {
                "rad/s"
            }
            Self::TimeConstant => "s",
            Self::Torque | Self::BlockedTorque => "N m",
            Self::StatorAmplitude => "m",
            Self::Efficiency | Self::ElectricalEfficiency => "1",
            _ => "W",
        }
    }

    /// The value of the quantity, however well it is known. `None` for a runaway, for an undefined
    /// efficiency, and for quantities of a compliant stator on a rigid one; also for deviation, range, time
    /// constant and blocked torque of a rotor that acts back on its stator.
    #[must_use]
    pub fn of(self, operation: &Operation) -> Option<Estimate> {
        let point = operation.point()?;
        match self {
            Self::Speed => Some(point.speed),
            Self::Torque => {
                Some(Estimate { value: point.load_torque, standard_error: point.load_torque_error })
            }
            Self::MechanicalPower => Some(point.mechanical_power),
            Self::InputPower => Some(point.input_power),
            Self::RestitutionLoss => Some(point.restitution_loss),
            Self::FrictionLoss => Some(point.friction_loss),
            Self::Efficiency => point.efficiency,
            Self::SpeedDeviation => point.speed_deviation,
            Self::SpeedLow => point.speed_range.map(|[low, _]| low),
            Self::SpeedHigh => point.speed_range.map(|[_, high]| high),
            Self::TimeConstant => point.time_constant,
            Self::UnstableSpeed => point.unstable_speed,
            Self::BlockedTorque => point.blocked_torque,
            Self::StatorAmplitude => Some(point.stator?.amplitude),
            Self::DrivePower => Some(point.stator?.drive_power),
            Self::DampingLoss => Some(point.stator?.damping_loss),
            Self::ElectricalEfficiency => point.stator?.efficiency,
        }
    }
}

impl FromStr for SweepQuantity {
    type Err = String;

    /// Parses the name, also with hyphens (`mechanical-power`); `power` is an alias of `mechanical_power`.
    fn from_str(name: &str) -> Result<Self, String> {
        let plain = name.trim().replace('-', "_");
        let plain = if plain == "power" { "mechanical_power" } else { &plain };
        let all = || std::iter::once(Self::Torque).chain(Self::WITH_STATOR);
        all().find(|own| own.name() == plain).ok_or_else(|| {
            let names: Vec<&str> = all().map(Self::name).collect();
            format!("there is no quantity {:?}; known are {}", name.trim(), names.join(", "))
        })
    }
}
