//! The axes of a sweep.

use crate::error::{Error, check, within_limit};
use crate::motor::data_sheet::motor_field::MotorField;
use crate::motor::data_sheet::parameters::MotorParameters;

/// Largest number of cells of a sweep, for example a map of 300 by 300.
pub const MAX_SWEEP_CELLS: usize = 100_000;

/// A parameter and its values, in any order, in the unit of the parameter. Values may repeat.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct SweepAxis {
    /// The field of the data sheet.
    pub parameter: MotorField,
    /// Its values, at least one; finite numbers in the unit of the field ([`MotorField::unit`]).
    pub values: Vec<f64>,
}

impl SweepAxis {
    /// An axis.
    #[must_use]
    pub const fn new(parameter: MotorField, values: Vec<f64>) -> Self {
        Self { parameter, values }
    }
}

/// Checks the axes independently of any motor.
pub(crate) fn check_axes(axes: &[SweepAxis]) -> Result<(), Error> {
    check((1..=2).contains(&axes.len()), "number of axes of a sweep", axes.len() as f64, "1 or 2")?;
    for axis in axes {
        if axis.values.is_empty() {
            return Err(Error::EmptyAxis { parameter: axis.parameter.name() });
        }
    }
    if let [one, other] = axes {
        let (one, other) = (one.parameter, other.parameter);
        if one == other {
            return Err(Error::RepeatedAxis { parameter: one.name() });
        }
        // One of them would clear the other's values.
        if one.excluded().contains(&other) || other.excluded().contains(&one) {
            return Err(Error::BothGiven { one: one.name(), other: other.name() });
        }
    }
    // Checked before any work is done for each value.
    within_limit("cells of a sweep", cells(axes), MAX_SWEEP_CELLS)?;
    for axis in axes {
        for &value in &axis.values {
            check(value.is_finite(), axis.parameter.name(), value, "finite")?;
        }
    }
    Ok(())
}

/// Number of cells.
pub(crate) fn cells(axes: &[SweepAxis]) -> usize {
    axes.iter().fold(1, |cells, axis| cells.saturating_mul(axis.values.len()))
}

/// The values of the axes in an existing cell; the last axis varies fastest.
pub(crate) fn values_of_cell(axes: &[SweepAxis], cell: usize) -> impl Iterator<Item = (MotorField, f64)> {
    let mut stride = cells(axes);
    axes.iter().filter_map(move |axis| {
        let count = axis.values.len().max(1);
        stride /= count;
        let value = axis.values.get(cell / stride.max(1) % count)?;
        Some((axis.parameter, *value))
    })
}

/// The data sheet of an existing cell.
pub(crate) fn sheet_of_cell(mut sheet: MotorParameters, axes: &[SweepAxis], cell: usize) -> MotorParameters {
    for (parameter, value) in values_of_cell(axes, cell) {
        parameter.set(&mut sheet, value);
    }
    sheet
}
