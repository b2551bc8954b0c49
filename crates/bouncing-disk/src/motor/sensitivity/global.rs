//! Global sensitivities of a motor: Sobol' indices and elementary effects over ranges of its parameters.

use bouncing_disk_core::{Observer, Progress};

use crate::error::Error;
use crate::motor::batch::shared_orbit::is_shared;
use crate::motor::data_sheet::Motor;
use crate::motor::operation::ensemble::{LoadedMotor, operate};
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::sensitivity::local::quantity_of;
use crate::motor::sensitivity::morris::{ElementaryEffects, elementary_effects};
use crate::motor::sensitivity::parameter::{SensitivityParameter, SensitivityQuantity};
use crate::motor::sensitivity::sobol::{SamplingSettings, SobolIndices, sobol_indices};

/// A parameter and the range over which it is spread.
pub type ParameterRange = (SensitivityParameter, [f64; 2]);

impl Motor {
    /// The share of each of these parameters in the variance of the steady speed or the stall torque, if
    /// all of them are spread evenly over their ranges; in their order.
    ///
    /// A point of the sample is one ensemble, with the seed of the settings: the rest of its scatter and the
    /// effect of low-period traps count with the parameters of the vertical motion, as an interaction with
    /// others.
    ///
    /// The items of `observer` are the rows of the sample.
    ///
    /// # Errors
    /// Those of [`sobol_indices`](crate::motor::sobol_indices), and of [`Motor::operating_point`] or
    /// [`Motor::stall_load`]; [`Error::Overpowered`] where a load is more than friction can hold. A parameter
    /// that is given twice takes its last value.
    pub fn sobol_indices(
        &self,
        quantity: SensitivityQuantity,
        ranges: &[ParameterRange],
        sampling: SamplingSettings,
        operating: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<Vec<SobolIndices>, Error> {
        let function = self.counted_values(quantity, ranges, sampling.rows, operating, observer);
        sobol_indices(function, &widths(ranges), sampling, observer)
    }

    /// The elementary effects (Morris) of these parameters on the steady speed (rad/s per range) or the stall
    /// torque (N m per range), in their order.
    ///
    /// The items of `observer` are the trajectories.
    ///
    /// # Errors
    /// Those of [`Self::sobol_indices`].
    pub fn elementary_effects(
        &self,
        quantity: SensitivityQuantity,
        ranges: &[ParameterRange],
        sampling: SamplingSettings,
        operating: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<Vec<ElementaryEffects>, Error> {
        let function = self.counted_values(quantity, ranges, sampling.rows, operating, observer);
        elementary_effects(function, &widths(ranges), sampling, observer)
    }

    /// [`Self::values`], which tells an observer the rows of the sample that are done.
    fn counted_values<'a>(
        &'a self,
        quantity: SensitivityQuantity,
        ranges: &'a [ParameterRange],
        rows: usize,
        operating: &'a OperatingSettings,
        observer: &'a dyn Observer,
    ) -> impl FnMut(&[Vec<f64>]) -> Result<Vec<f64>, Error> + 'a {
        let mut done = 0;
        move |points| {
            let within = |_: Progress| observer.observe(Progress { done, total: rows as u64 });
            let values = self.values(quantity, ranges, points, operating, &within);
            done += 1;
            values
        }
    }

    /// The quantity at points of a sample; points that share a vertical motion are computed on one.
    fn values(
        &self,
        quantity: SensitivityQuantity,
        ranges: &[ParameterRange],
        points: &[Vec<f64>],
        operating: &OperatingSettings,
        observer: &dyn Observer,
    ) -> Result<Vec<f64>, Error> {
        let motors = points
            .iter()
            .map(|point| {
                let mut pairs = ranges.iter().zip(point);
                pairs.try_fold(*self, |motor, ((parameter, _), value)| parameter.set(&motor, *value))
            })
            .collect::<Result<Vec<Self>, Error>>()?;
        let mut values = vec![f64::NAN; motors.len()];
        let mut left: Vec<usize> = (0..motors.len()).collect();
        while let Some(&first) = left.first() {
            let (group, rest): (Vec<usize>, Vec<usize>) = left
                .into_iter()
                .partition(|&index| is_shared(motors[index].system(), motors[first].system()));
            left = rest;
            if quantity == SensitivityQuantity::SteadySpeed {
                let loaded = group.iter().map(|&index| LoadedMotor::of(&motors[index]));
                let loaded = loaded.collect::<Result<Vec<_>, _>>()?;
                let operations = operate(&loaded, operating, observer)?.operations;
                for ((&index, operation), motor) in group.iter().zip(operations).zip(&loaded) {
                    let overpowered = Error::Overpowered { load: motor.load() };
                    values[index] = operation.point().ok_or(overpowered)?.speed.value;
                }
            } else {
                for index in group {
                    values[index] = quantity_of(&motors[index], quantity, operating, observer)?.value;
                }
            }
        }
        Ok(values)
    }
}

fn widths(ranges: &[ParameterRange]) -> Vec<[f64; 2]> {
    ranges.iter().map(|(_, range)| *range).collect()
}

#[cfg(test)]
mod tests;
