//! Settings of a steady operation: the required accuracy of the mean speed, and the largest cost.

use bouncing_disk_core::read_checked;

use crate::error::{Error, check};

/// Allowed numbers of members of an ensemble, each with its own vertical motion. With fewer than four members
/// the standard error itself would be too uncertain.
const MEMBERS: std::ops::RangeInclusive<usize> = 4..=4096;

/// Settings for computing a steady operation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSettings"))]
pub struct OperatingSettings {
    /// The requested standard error of the mean speed, in [1e-6, 0.5]: a share of the motor's speed without
    /// load, or of the mean speed itself if that is larger. Default 0.01.
    ///
    /// Motors that are computed together on one vertical motion share one reference speed: the largest speed
    /// of the unloaded motors or, if all are loaded, the speed of the first motor without its load. A law of
    /// the load (table `[load]`) counts as a load. The reference is at least a hundredth of the platform's
    /// largest angular speed, and at least a hundredth of the change of speed that friction causes in a
    /// radian of phase. Otherwise the computation of a motor that hardly turns would never finish.
    pub relative_error: f64,
    /// Members of the ensemble, each with its own vertical motion, in [4, 4096]. Default 16.
    pub members: usize,
    /// Largest number of impacts of all members together, in [1, 1e15]; for a rotor that never bounces, the
    /// largest number of periods. If they are used up before the requested error is reached, the result is
    /// [`Operation::Unsettled`](crate::motor::Operation::Unsettled). Each member uses at least a dozen in any
    /// case. Default 20 million, which takes a few seconds.
    pub most_impacts: u64,
    /// Size of the relaunch perturbation in units of g/omega, in (0, 1]. It cannot be zero: without it the
    /// motor locks to a cycle selected by rounding, whose speed may be wrong by a third. Default 1e-3.
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
