//! Independent orbits of impact maps, advanced together.

use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::Error;
use crate::sweep::lockstep::lanes::{Batch, FlightScheduler, InstructionSet, LANES, Purpose};

/// Independent orbits of the impact map, each advanced by one impact at a time; the states have the same bits
/// as with [`ImpactMap::step`], but are computed several times faster than one by one.
///
/// ```
/// use bouncing_disk_core::sweep::OrbitBatch;
/// use bouncing_disk_core::{ImpactMap, ImpactState, Vibration};
///
/// let map = ImpactMap::new(Vibration::from_axial_forcing(0.55)?, 0.5)?;
/// let starts = (0..100)
///     .map(|k| ImpactState::from_normalised(0.8, 1.3 + 1e-9 * f64::from(k)))
///     .collect::<Result<Vec<_>, _>>()?;
/// let mut batch = OrbitBatch::new(starts.iter().map(|&start| (map, start)));
/// batch.step()?;
/// assert_eq!(batch.state(7), Some(map.step(starts[7])?.into()));
/// # Ok::<(), bouncing_disk_core::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct OrbitBatch {
    scheduler: Box<FlightScheduler>,
    batches: Vec<Batch>,
    len: usize,
}

impl OrbitBatch {
    /// Orbits that each start with an impact of their own map, computed with the best instructions of this
    /// processor.
    pub fn new(starts: impl IntoIterator<Item = (ImpactMap, ImpactState)>) -> Self {
        Self::with_instruction_set(starts, InstructionSet::best())
    }

    #[doc(hidden)]
    /// [`Self::new`] with other instructions; the states do not depend on them. The next lower set replaces
    /// one that the processor lacks.
    pub fn with_instruction_set(
        starts: impl IntoIterator<Item = (ImpactMap, ImpactState)>,
        set: InstructionSet,
    ) -> Self {
        let mut batch = Self {
            scheduler: Box::new(FlightScheduler::new(set, Purpose::Orbits)),
            batches: Vec::new(),
            len: 0,
        };
        for (map, state) in starts {
            let lane = batch.len % LANES;
            if lane == 0 {
                batch.batches.push(Batch::new(*map.vibration()));
            }
            if let Some(batch) = batch.batches.last_mut() {
                batch.set_platform(lane, *map.vibration());
                batch.set_impact(lane, state.phase(), state.velocity());
                batch.set_restitution(lane, map.restitution());
            }
            batch.len += 1;
        }
        batch
    }

    /// Number of orbits.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no orbits.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The last impact of an orbit; `None` if there is no such orbit.
    #[must_use]
    pub fn state(&self, index: usize) -> Option<ImpactState> {
        let batch = self.batches.get(index / LANES)?;
        (index < self.len).then(|| batch.impact_state(index % LANES))
    }

    /// Advances every orbit to its next impact.
    ///
    /// # Errors
    /// The error of the first orbit without a next impact (see [`ImpactMap::step`]); this orbit keeps its
    /// state, the others advance.
    pub fn step(&mut self) -> Result<(), Error> {
        let (mut first, mut failed) = (None, Vec::new());
        self.scheduler.fly(&mut self.batches, self.len, |index, error| {
            failed.push(index);
            first.get_or_insert(error);
        });
        for index in failed {
            self.batches[index / LANES].stay(index % LANES);
        }
        first.map_or(Ok(()), Err)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::platform::phase::Phase;
    use crate::flight::platform::vibration::Vibration;
    use crate::numerics::testing::golden_spread;
    use core::f64::consts::TAU;

    fn bits(state: ImpactState) -> [u64; 4] {
        let phase = state.phase();
        [phase.angle(), phase.sin(), phase.cos(), state.velocity()].map(f64::to_bits)
    }

    /// Flights around the longest allowed duration, at otherwise ordinary launches.
    #[test]
    fn the_longest_flights_are_those_of_single_orbits() {
        let map = ImpactMap::new(Vibration::new(2.0).expect("legal"), 0.5).expect("legal");
        let mut failed = 0;
        for block in 0..20_u64 {
            let starts: Vec<_> = (0..LANES as u64)
                .map(|lane| {
                    let k = LANES as u64 * block + lane;
                    let phase = Phase::new(TAU * golden_spread(13 * k)).expect("finite");
                    // A launch with half of this speed flies for twice as long.
                    let speed = 1.6e9 * if block % 2 == 0 { 0.97 } else { 0.99 + 0.02 * golden_spread(k) };
                    ImpactState::new(phase, -speed).expect("legal")
                })
                .collect();
            let mut batch = OrbitBatch::new(starts.iter().map(|&start| (map, start)));
            let alone: Vec<_> = starts.iter().map(|&start| map.step(start)).collect();
            let first = alone.iter().find_map(|step| step.as_ref().err().cloned());
            assert_eq!(batch.step().err(), first);
            for (lane, (step, start)) in alone.into_iter().zip(&starts).enumerate() {
                failed += u32::from(step.is_err());
                let expected = step.map_or(*start, Into::into);
                assert_eq!(bits(batch.state(lane).expect("exists")), bits(expected), "{start:?}");
            }
        }
        assert!((100..1_180).contains(&failed), "{failed}");
    }
}
