//! The accuracy and the largest cost of a steady operation.

use bouncing_disk_core::read_checked;

use crate::error::{Error, check};

/// Least and most vertical motions of an ensemble. A standard error of fewer than four members is itself hardly known.
const MEMBERS: std::ops::RangeInclusive<usize> = 4..=4096;

/// How a steady operation is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSettings"))]
pub struct OperatingSettings {
    /// The requested standard error of the mean speed, relative to the speed without load, in [1e-6, 0.5];
    /// for motors on one vertical motion, relative to the largest speed of those without load, or that of the
    /// first; for slower motors, relative to a hundredth of the platform's largest angular speed, or of the
    /// change by friction in a radian of phase. Default 0.01.
    pub relative_error: f64,
    /// Vertical motions to average over, in [4, 4096]. Default 16.
    pub members: usize,
    /// Most impacts that all members together may take (periods, for a rotor that never bounces; each member
    /// always takes a dozen): if they are spent before the error is reached, the result is
    /// [`Operation::Unsettled`](crate::motor::Operation::Unsettled). In [1, 1e15]. Default 20 million, a few seconds.
    pub most_impacts: u64,
    /// Size of the relaunch perturbation in units of g/omega, in (0, 1]. It cannot be zero: without it the
    /// motor locks on a cycle chosen by rounding, whose speed may be wrong by a third. Default 1e-3.
    pub relaunch_perturbation: f64,
    /// Seed of the perturbations. Default 1.
    pub seed: u64,
}

impl Default for OperatingSettings {
    fn default() -> Self {
        Self {
            relative_error: 0.01,
            members: 16,
            most_impacts: 20_000_000,
            relaunch_perturbation: 1e-3,
            seed: 1,
        }
    }
}

impl OperatingSettings {
    pub(crate) fn check(&self) -> Result<(), Error> {
        let Self { relative_error, members, most_impacts, relaunch_perturbation, seed: _ } = *self;
        check((1e-6..=0.5).contains(&relative_error), "relative_error", relative_error, "[1e-6, 0.5]")?;
        check(MEMBERS.contains(&members), "members", members as f64, "[4, 4096]")?;
        let impacts = most_impacts as f64;
        check(
            (1..=1_000_000_000_000_000).contains(&most_impacts),
            "most_impacts",
            impacts,
            "[1, 1000000000000000]",
        )?;
        let perturbs = relaunch_perturbation > 0.0 && relaunch_perturbation <= 1.0;
        check(perturbs, "relaunch_perturbation", relaunch_perturbation, "(0, 1] (g/omega)")?;
        Ok(())
    }
}

read_checked!(OperatingSettings as UncheckedSettings {
    relative_error: f64,
    members: usize,
    most_impacts: u64,
    relaunch_perturbation: f64,
    seed: u64,
});
