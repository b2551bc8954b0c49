//! How parameters are fitted to transients.

use crate::error::{Error, check};

/// How parameters are fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ParameterFitSettings {
    /// Computed members at each preload, in [24, 4096], from which the scatter of a run is known. Default
    /// 64.
    pub members: usize,
    /// Most windows of time over whose means a transient is compared, in [1, 12]. Each is twice as long as
    /// the one before. Default 6: the first one begins with the motor and ends at a 32nd of the duration.
    pub windows: usize,
    /// Size of the relaunch perturbation in units of g/omega, in (0, 1]. Default 1e-3.
    pub relaunch_perturbation: f64,
    /// Seed of the perturbations and of the resampling. Default 1.
    pub seed: u64,
    /// Most evaluations of all motors that the search may take, in [1, 10000]. Default 100. A derivative
    /// counts as one.
    pub most_evaluations: usize,
    /// Resampled fits, in [200, 100000]. Default 1000.
    pub resamples: usize,
    /// The largest accepted sum of weighted squares, as a multiple of the value that one of 10,000 sound
    /// fits exceeds, at least 1. Default 1. Above 1, the intervals of a fit that exceeds this value are
    /// wider by the root of the sum over its expectation.
    pub largest_misfit: f64,
}

impl Default for ParameterFitSettings {
    fn default() -> Self {
        Self {
            members: 64,
            windows: 6,
            relaunch_perturbation: 1e-3,
            seed: 1,
            most_evaluations: 100,
            resamples: 1_000,
            largest_misfit: 1.0,
        }
    }
}

impl ParameterFitSettings {
    pub(crate) fn check(&self) -> Result<(), Error> {
        let Self {
            members, windows, relaunch_perturbation, most_evaluations, resamples, largest_misfit, ..
        } = *self;
        check((24..=4096).contains(&members), "members", members as f64, "[24, 4096]")?;
        check((1..=12).contains(&windows), "windows", windows as f64, "[1, 12]")?;
        let perturbs = relaunch_perturbation > 0.0 && relaunch_perturbation <= 1.0;
        check(perturbs, "relaunch_perturbation", relaunch_perturbation, "(0, 1] (g/omega)")?;
        let most = most_evaluations as f64;
        check((1..=10_000).contains(&most_evaluations), "most_evaluations", most, "[1, 10000]")?;
        check((200..=100_000).contains(&resamples), "resamples", resamples as f64, "[200, 100000]")?;
        let is_multiple = largest_misfit >= 1.0 && largest_misfit.is_finite();
        check(is_multiple, "largest_misfit", largest_misfit, "[1, inf)")?;
        Ok(())
    }
}
