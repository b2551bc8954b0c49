//! The members of an ensemble: transients of one motor, each with its own phase and seed.

use std::f64::consts::TAU;

use bouncing_disk_core::Phase;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::WorkCount;

use crate::error::{Error, check, room_for, within_limit};
use crate::motor::rotor::transient::{SpeedCurve, TransientSettings};
use crate::parameters::system::System;

/// Largest number of members of an ensemble.
pub const MAX_MEMBERS: usize = 1_000_000;

/// Largest number of speeds of all members of an ensemble together; they and their times fill a gigabyte.
pub const MAX_SPEEDS: usize = 1 << 26;

/// The arguments of one [`transient`](crate::motor::transient()).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TransientMember {
    /// The motor.
    pub system: System,
    /// Phase of the stator at which it starts to vibrate.
    pub phase: Phase,
    /// Duration, sampling, perturbation and seed.
    pub settings: TransientSettings,
}

impl TransientMember {
    /// The members of a [`TransientEnsemble`](crate::estimate::TransientEnsemble): `members` >= 1 transients
    /// with consecutive seeds from `settings.seed`, and with starting phases spread evenly over the cycle
    /// from one that the seed selects. Independent ensembles need seeds that differ by at least `members`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there is no member or a setting is illegal; an error of the core for more than
    /// [`MAX_MEMBERS`] members, more than [`MAX_SPEEDS`] speeds in total or insufficient memory.
    pub fn of_ensemble(
        system: &System,
        settings: &TransientSettings,
        members: usize,
    ) -> Result<Vec<Self>, Error> {
        settings.check_for(&system.scales())?;
        check(members > 0, "members", 0.0, "[1, 1000000]")?;
        let mut starts = room_for("members of an ensemble", members, MAX_MEMBERS)?;
        // The computation reserves the memory for them.
        within_limit("speeds of an ensemble", members.saturating_mul(settings.intervals), MAX_SPEEDS)?;
        let member = |index: usize| -> Result<Self, Error> {
            let phase = starting_phase(settings.seed, index, members)?;
            let seed = SplitMix64::new(settings.seed.wrapping_add(index as u64)).next_number();
            Ok(Self { system: *system, phase, settings: TransientSettings { seed, ..*settings } })
        };
        for index in 0..members {
            starts.push(member(index)?);
        }
        Ok(starts)
    }

    /// The transient of one member, as computed by [`transient`](crate::motor::transient()).
    pub(crate) fn alone(&self, work: &mut WorkCount<'_>) -> Result<SpeedCurve, Error> {
        SpeedCurve::alone(&self.system, self.phase, &self.settings, work)
    }
}

/// The starting phase of the member with this index. The phases are spread evenly over the cycle and rotated
/// by an angle that the seed selects, because a few phases are only a sample. The seed 1 rotates by half a
/// step, away from all special phases. Each further seed adds the golden ratio times a step, so that a few
/// seeds are also spread evenly.
pub(crate) fn starting_phase(seed: u64, index: usize, members: usize) -> Result<Phase, Error> {
    /// 2^64 over the golden ratio.
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    let turn = seed.wrapping_sub(1).wrapping_mul(GOLDEN).wrapping_add(1 << 63) >> 11;
    let step = turn as f64 / (1_u64 << 53) as f64;
    Ok(Phase::new(TAU * (index as f64 + step) / members as f64)?)
}

/// Rotation (turns) selected by the seed for phases spread by [`golden_share`], zero for the seed 1.
pub(crate) fn turn_of_seed(seed: u64) -> f64 {
    /// 2^64 (sqrt(2) - 1), which is unrelated to the golden ratio.
    const SILVER: u64 = 0x6a09_e667_f3bc_c908;
    (seed.wrapping_sub(1).wrapping_mul(SILVER) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Numbers that fill (0, 1) evenly.
pub(crate) fn golden_share(index: usize) -> f64 {
    (index as f64 * 0.618_033_988_749_894_8).fract()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A single member starts at a different phase for each seed, and these phases are spread evenly.
    #[test]
    fn the_starting_phase_is_one_of_the_seed() {
        let mut phases: Vec<f64> =
            (1..=21).map(|seed| starting_phase(seed, 0, 1).expect("finite").angle() / TAU).collect();
        assert!((phases[0] - 0.5).abs() <= 0.0);
        phases.sort_by(f64::total_cmp);
        assert!(
            phases.windows(2).all(|pair| pair[1] - pair[0] > 0.5 / 21.0 && pair[1] - pair[0] < 2.0 / 21.0)
        );
        for (index, seed) in [(0, 0), (3, 7), (7, u64::MAX)] {
            let share = starting_phase(seed, index, 8).expect("finite").angle() / TAU * 8.0 - index as f64;
            assert!((0.0..=1.0).contains(&share), "{share}");
        }
    }
}
