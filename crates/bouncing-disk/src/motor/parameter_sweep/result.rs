//! The result of a sweep.

use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::MotorField;
use crate::motor::operation::point::OperatingRow;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::parameter_sweep::axis::{SweepAxis, values_of_cell};
use crate::motor::parameter_sweep::quantity::SweepQuantity;

/// The operation of each cell of a [`MotorSweep`](crate::motor::MotorSweep), with the input of the
/// computation.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MotorSweepResult {
    motor: Motor,
    settings: OperatingSettings,
    axes: Vec<SweepAxis>,
    cells: Vec<OperatingRow>,
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "std::ops::Not::not"))]
    continued: bool,
}

impl MotorSweepResult {
    pub(crate) const fn new(
        motor: Motor,
        settings: OperatingSettings,
        axes: Vec<SweepAxis>,
        cells: Vec<OperatingRow>,
        continued: bool,
    ) -> Self {
        Self { motor, settings, axes, cells, continued }
    }

    /// `up` or `down`: the direction in which the value of a continued sweep changed before this cell; the
    /// first cell has the direction of the second. `None` for other sweeps.
    #[must_use]
    pub fn way(&self, cell: usize) -> Option<&'static str> {
        let values = &self.axes.first().filter(|_| self.continued)?.values;
        let [before, own] = [cell.max(1) - 1, cell.max(1)].map(|cell| values.get(cell));
        Some(if own < before { "down" } else { "up" })
    }

    /// The motor that was varied.
    #[must_use]
    pub const fn motor(&self) -> &Motor {
        &self.motor
    }

    /// The settings for each cell.
    #[must_use]
    pub const fn settings(&self) -> &OperatingSettings {
        &self.settings
    }

    /// The one or two axes.
    #[must_use]
    pub fn axes(&self) -> &[SweepAxis] {
        &self.axes
    }

    /// The operation of each cell, row by row: the first axis counts the rows. With a single axis each row
    /// contains one cell.
    #[must_use]
    pub fn cells(&self) -> &[OperatingRow] {
        &self.cells
    }

    /// The cells, each with its values in the order of the axes.
    pub fn iter(&self) -> impl Iterator<Item = (Vec<(MotorField, f64)>, &OperatingRow)> {
        self.cells.iter().enumerate().map(|(cell, operation)| {
            let values = values_of_cell(&self.axes, cell).collect();
            (values, operation)
        })
    }

    /// The rows of a map: for each value of the first axis the operations along the second one; with a single
    /// axis, one operation per row.
    pub fn rows(&self) -> impl Iterator<Item = &[OperatingRow]> {
        let columns = self.axes.get(1).map_or(1, |axis| axis.values.len());
        self.cells.chunks(columns.max(1))
    }

    /// The values of a quantity, however well they are known, as a matrix `[row][column]` like
    /// [`Self::rows`]. `None` for a runaway and for an undefined efficiency.
    #[must_use]
    pub fn matrix(&self, quantity: SweepQuantity) -> Vec<Vec<Option<f64>>> {
        let of = |row: &OperatingRow| quantity.of(row.operation()).map(|estimate| estimate.value);
        self.rows().map(|row| row.iter().map(of).collect()).collect()
    }
}
