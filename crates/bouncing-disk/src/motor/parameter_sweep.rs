//! Sweeps: a motor in steady operation over one or two of its parameters.
//!
//! The axes are in `parameter_sweep/axis.rs`, the groups of cells computed together in
//! `parameter_sweep/groups.rs`, and the run in `parameter_sweep/run.rs`. The results, as numbers and as a
//! table, are in `parameter_sweep/result.rs`, `parameter_sweep/quantity.rs` and
//! `parameter_sweep/csv_table.rs`.

pub(crate) mod axis;
#[cfg(feature = "csv")]
mod csv_table;
pub(crate) mod groups;
pub(crate) mod quantity;
pub(crate) mod result;
mod run;

use bouncing_disk_core::Observer;

use crate::error::{Error, check};
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::MotorField;
use crate::motor::operation::of_motor::operations;
use crate::motor::operation::point::OperatingRow;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::parameter_sweep::axis::{SweepAxis, cells, check_axes, sheet_of_cell};

/// A motor in steady operation over one or two parameters: curves and maps of speed, power and efficiency.
///
/// A sweep consists of one cell for each value of its axis, or for each pair of values of its two axes. The
/// cells are numbered row by row; the first axis counts the rows. Each cell is the motor's data sheet with
/// the values of the cell. Setting a parameter clears its alternative: in a sweep over `preload_force`, a
/// motor with a `preload_acceleration` keeps only the force ([`Self::replaced`] lists the cleared fields).
///
/// Cells with the same vertical motion (they differ only in load, friction, phase lag, twist, radii or mass)
/// are computed on one orbit, wherever they lie. A map of load and phase lag needs a single orbit, a map of
/// amplitude and load one for each amplitude. (On a compliant stator, cells with different masses have
/// separate orbits; if a mode of the stator twists, each cell has its own.) Cells on one orbit form a group,
/// of 256 cells at most, which runs until each of its cells is known well enough. A value in a cell therefore
/// depends on the rest of the group, within its standard error. The cells of a group share their
/// perturbations, so their differences are more precise than their values. A cell whose rotor acts back on
/// its stator may use a hundredth of the impacts that the settings allow, because computing such an impact
/// takes a hundred times as long.
///
/// Groups depend on the sweep alone. The results have the same bits for any number of threads.
///
/// ```
/// use bouncing_disk::core::Unobserved;
/// use bouncing_disk::Motor;
/// use bouncing_disk::motor::{MotorField, MotorSweep, OperatingSettings, SweepAxis, SweepQuantity};
///
/// let motor = Motor::paper_70_khz();
/// let loads = [0.0, 0.5, 1.5].map(|share| share * motor.largest_torque());
/// let sweep = MotorSweep::new(
///     motor,
///     vec![
///         SweepAxis::new(MotorField::Friction, vec![0.1, 0.2]),
///         SweepAxis::new(MotorField::LoadTorque, loads.to_vec()),
///     ],
///     OperatingSettings { relative_error: 0.05, ..OperatingSettings::default() },
/// )?;
/// // They share the vertical motion.
/// assert_eq!((sweep.cells(), sweep.groups().len()), (6, 1));
/// let speeds = sweep.run(&Unobserved)?.matrix(SweepQuantity::Speed);
/// assert!(speeds[0][0] > speeds[0][1] && speeds[0][1] < speeds[1][1]);
/// // The last load exceeds the torque of the smaller friction: there is no speed.
/// assert_eq!(speeds[0][2], None);
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MotorSweep {
    motor: Motor,
    axes: Vec<SweepAxis>,
    settings: OperatingSettings,
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "std::ops::Not::not"))]
    continued: bool,
    #[cfg_attr(feature = "serde", serde(skip_serializing))]
    groups: Vec<Vec<usize>>,
}

impl MotorSweep {
    /// A sweep over one or two axes.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an illegal number of axes, a value that is not finite and illegal settings;
    /// [`Error::EmptyAxis`]; [`Error::RepeatedAxis`] and [`Error::BothGiven`] for two axes over one
    /// parameter, or over two that exclude each other; an error of the core
    /// ([`TooLarge`](bouncing_disk_core::Error::TooLarge)) for more than
    /// [`MAX_SWEEP_CELLS`](crate::motor::MAX_SWEEP_CELLS) cells; the errors of
    /// [`MotorParameters::build`](crate::motor::MotorParameters::build) for the first cell whose motor is not
    /// legal.
    pub fn new(motor: Motor, axes: Vec<SweepAxis>, settings: OperatingSettings) -> Result<Self, Error> {
        settings.check()?;
        check_axes(&axes)?;
        let motors =
            (0..cells(&axes)).map(|cell| sheet_of_cell(motor.parameters().clone(), &axes, cell).build());
        let groups = groups::of(motors, groups::most_cells(&settings))?;
        Ok(Self { motor, axes, settings, continued: false, groups })
    }

    /// This sweep over one axis as a continuation. The first cell starts from rest, and each further cell
    /// from the final state of the previous one, because the motion of a compliant stator and its rotor may
    /// depend on the history. To see hysteresis, let the values rise and fall again. The cells form one
    /// group. All other fields of the sheet are constant. In a sweep over the drive frequency these include
    /// the preload, the phase lag, and the volts, the force or the amplitude without a rotor, whichever the
    /// sheet states.
    ///
    /// The motions of disk and modes continue. The angular speeds of the rotors start again far below and far
    /// above, as in every cell, which bounds the remaining dependence on the start. After a runaway, a cell
    /// continues from the last cell with a mean speed. Members may end up in different steady states: the
    /// mean then belongs to no state, and its error is their scatter.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for two axes; [`Error::NotGiven`] for a motor without a table `[stator]`.
    pub fn continued(self) -> Result<Self, Error> {
        check(self.axes.len() == 1, "number of axes of a continued sweep", self.axes.len() as f64, "1")?;
        self.motor.stator().ok_or(Error::NotGiven { field: "the table stator of a continued sweep" })?;
        let groups = vec![(0..self.cells()).collect()];
        Ok(Self { continued: true, groups, ..self })
    }

    /// The operations of a group, in the order of its cells.
    ///
    /// # Errors
    /// The errors of [`Self::motor_of`] and of [`operations`], which reports that there is no motor if the
    /// group does not exist.
    pub fn operations(&self, group: usize, observer: &dyn Observer) -> Result<Vec<OperatingRow>, Error> {
        let cells = self.groups.get(group).map_or(&[][..], |cells| cells);
        let motors = cells.iter().map(|cell| self.motor_of(*cell)).collect::<Result<Vec<_>, Error>>()?;
        let settings = groups::settings_of_each(&motors, &self.settings);
        if !self.continued {
            return operations(&motors, &settings, observer);
        }
        let mut ends = None;
        let each = motors.into_iter().map(|motor| {
            let (operation, left) = motor.continued(ends.as_ref(), &settings, observer)?;
            ends = left.or(ends.take());
            Ok(operation)
        });
        each.collect()
    }

    /// The motor that is varied.
    #[must_use]
    pub const fn motor(&self) -> &Motor {
        &self.motor
    }

    /// The one or two axes.
    #[must_use]
    pub fn axes(&self) -> &[SweepAxis] {
        &self.axes
    }

    /// The settings for each cell.
    #[must_use]
    pub const fn settings(&self) -> &OperatingSettings {
        &self.settings
    }

    /// Number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        cells(&self.axes)
    }

    /// The groups of cells that are computed together, as cell indices. Each cell is in one group; the groups
    /// are in the order of their first cells.
    #[must_use]
    pub fn groups(&self) -> &[Vec<usize>] {
        &self.groups
    }

    /// Fields of the motor's data sheet that the axes replace by alternatives, and that are cleared in every
    /// cell.
    #[must_use]
    pub fn replaced(&self) -> Vec<MotorField> {
        let sheet = self.motor.parameters();
        let excluded = self.axes.iter().flat_map(|axis| axis.parameter.excluded());
        excluded.copied().filter(|field| field.value(sheet).is_some()).collect()
    }

    /// The motor of a cell.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a cell that does not exist.
    pub fn motor_of(&self, cell: usize) -> Result<Motor, Error> {
        if cell >= self.cells() {
            let legal = "below the number of cells";
            return Err(Error::OutOfRange { field: "cell of a sweep", value: cell as f64, legal });
        }
        sheet_of_cell(self.motor.parameters().clone(), &self.axes, cell).build()
    }
}

#[cfg(test)]
mod tests;
