//! How well, and how long at most, a steady operation is computed.

use bouncing_disk_core::read_checked;

use crate::error::{Error, check};

/// Least and most vertical motions of an ensemble. A standard error of fewer than four members is itself hardly known.
const MEMBERS: std::ops::RangeInclusive<usize> = 4..=4096;

/// How a steady operation is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSettings"))]
pub struct OperatingSettings {
    /// The standard error of the mean speed that is asked for, relative to the speed without load, in [1e-6, 0.5]; of
    /// motors on one vertical motion, to the largest of theirs that were asked for without load, or the first one's; of
    /// a motor whose speed is less, relative to a hundredth of the platform's largest angular speed, or of what friction changes in
    /// a radian of phase. Default 0.01.
    pub relative_error: f64,
    /// Vertical motions that are averaged over, in [4, 4096]. Default 16.
    pub members: usize,
    /// Most impacts that all members together may take (periods, of a rotor that never bounces; a dozen of each member are
    /// always taken): where they are spent before the error is reached, the result is
    /// [`Operation::Unsettled`](crate::motor::Operation::Unsettled). In [1, 1e15]. Default 20 million, a few seconds.
    pub most_impacts: u64,
    /// Size of the relaunch perturbation in units of g/omega, in (0, 1]. It cannot be zero: without it the motor
    /// locks on a cycle that the rounding has chosen, whose speed may be wrong by a third. Default 1e-3.
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
