//! The quantities that a sweep computes in each cell.

use crate::motor::operation::point::{Estimate, Operation};

/// A quantity of an operating point that is an estimate with a standard error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum SweepQuantity {
    /// Mean angular speed (rad/s).
    Speed,
    /// Load torque times mean speed (W).
    MechanicalPower,
    /// Power that the platform puts in (W).
    InputPower,
    /// Power lost in restitution (W).
    RestitutionLoss,
    /// Power lost in friction (W).
    FrictionLoss,
    /// Mechanical power over the power put in.
    Efficiency,
}

impl SweepQuantity {
    /// All quantities, in the order of the columns of a table.
    pub const ALL: [Self; 6] = [
        Self::Speed,
        Self::MechanicalPower,
        Self::InputPower,
        Self::RestitutionLoss,
        Self::FrictionLoss,
        Self::Efficiency,
    ];

    /// Its name: `mechanical_power`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::MechanicalPower => "mechanical_power",
            Self::InputPower => "input_power",
            Self::RestitutionLoss => "restitution_loss",
            Self::FrictionLoss => "friction_loss",
            Self::Efficiency => "efficiency",
        }
    }

    /// Its unit: `rad/s`, `W`, or `1` for a number without a unit.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Speed => "rad/s",
            Self::MechanicalPower | Self::InputPower | Self::RestitutionLoss | Self::FrictionLoss => "W",
            Self::Efficiency => "1",
        }
    }

    /// Its value, however well it is known; `None` for a runaway and for an undefined efficiency.
    #[must_use]
    pub fn of(self, operation: &Operation) -> Option<Estimate> {
        let point = operation.point()?;
        match self {
            Self::Speed => Some(point.speed),
            Self::MechanicalPower => Some(point.mechanical_power),
            Self::InputPower => Some(point.input_power),
            Self::RestitutionLoss => Some(point.restitution_loss),
            Self::FrictionLoss => Some(point.friction_loss),
            Self::Efficiency => point.efficiency,
        }
    }
}
