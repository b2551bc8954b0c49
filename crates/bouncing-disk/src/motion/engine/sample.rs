//! States at equidistant times, instead of a full record, of a long motion.

use std::cmp::Ordering;

use bouncing_disk_core::Observer;
use bouncing_disk_core::map::RestitutionLaw;
use bouncing_disk_core::run::Watch;

use crate::error::{Error, check, room_for};
use crate::motion::engine::{Engine, SineGround};
use crate::motion::phase_time::PhaseSpan;
use crate::motion::state::Snapshot;

/// Largest number of states that [`Engine::sample`] returns; each takes about 100 bytes.
pub const MAX_SAMPLES: usize = 1 << 24;

/// Largest number of periods of the platform for which [`Engine::sample`] follows a motion. With an impact in
/// each period this takes many minutes; no instant is rounded by more than a millionth of a period.
pub const MAX_SAMPLED_PERIODS: u64 = 1 << 30;

/// The cost of an event, in flights: one that ends a chatter takes longer than a flight.
const FLIGHTS_OF_EVENT: u64 = 4;

impl<L: RestitutionLaw> Engine<SineGround<L>> {
    /// Disk and platform at `count` equidistant instants, from now to `span` later inclusive. Events are not
    /// stored, so a long motion takes no more memory than a short one. Afterwards the engine is just
    /// after the first event at or after the last instant.
    ///
    /// At an event, the state is the one just after it, as in [`Trajectory::at`](crate::Trajectory::at). A
    /// disk that rests for ever is followed as well.
    ///
    /// The observer's items are the periods of the platform.
    ///
    /// ```
    /// use bouncing_disk::core::{ChatterPolicy, Phase, Unobserved};
    /// use bouncing_disk::{Engine, InitialCondition, System};
    /// use bouncing_disk::motion::PhaseSpan;
    /// use bouncing_disk::toss::TOSS_START;
    ///
    /// let start = InitialCondition::Contact { phase: Phase::new(TOSS_START)?, angular_speed: 0.0 };
    /// let mut engine = Engine::new(System::pizza_toss(), start, ChatterPolicy::Complete)?;
    /// let states = engine.sample(PhaseSpan { periods: 10, remainder: 0.0 }, 401, &Unobserved)?;
    /// assert_eq!((states.len(), states[400].time.periods - states[0].time.periods), (401, 10));
    /// # Ok::<(), bouncing_disk::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for fewer than two instants, or more than [`MAX_SAMPLED_PERIODS`]; an error of
    /// the core for more than [`MAX_SAMPLES`] instants or insufficient memory; the errors of
    /// [`Self::advance`].
    pub fn sample(
        &mut self,
        span: PhaseSpan,
        count: usize,
        observer: &dyn Observer,
    ) -> Result<Vec<Snapshot>, Error> {
        let span = span.normalised();
        check(count >= 2, "instants of a motion", count as f64, "at least 2")?;
        check(span.periods <= MAX_SAMPLED_PERIODS, "periods", span.periods as f64, "[0, 1073741824]")?;
        let mut states: Vec<Snapshot> = room_for("instants of a motion", count, MAX_SAMPLES)?;
        let (start, total, last) = (self.now, span.radians(), count - 1);
        let end = start.after(span);
        let instant = |index: usize| {
            if index >= last {
                return end;
            }
            let time = start.after(PhaseSpan::from_radians(total * (index as f64 / last as f64)));
            // Rounding must not put an instant past the end.
            if time.order(&end) == Ordering::Greater { end } else { time }
        };
        let watch = Watch::begin(observer, 0, span.periods)?;
        let mut work = watch.work();
        loop {
            let (segment, record) = self.advance_towards(&end)?;
            let until = record.map(|record| record.time);
            // Up to the event, or all remaining instants if no further event follows.
            while states.len() < count {
                let time = instant(states.len());
                if until.is_some_and(|until| time.order(&until) != Ordering::Less) {
                    break;
                }
                // Use the instant itself, as the sum of the segment's start and the offset is rounded.
                let state = segment.state_after(&self.system, time.since(&segment.start));
                states.push(Snapshot { time, ..state });
            }
            if states.len() == count {
                break;
            }
            watch.set_done(self.now.since(&start).periods.min(span.periods));
            work.spend(FLIGHTS_OF_EVENT)?;
        }
        watch.end();
        Ok(states)
    }
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::Unobserved;
    use std::ops::ControlFlow;

    use bouncing_disk_core::{ChatterPolicy, Phase, Progress};
    use proptest::prelude::*;

    use super::*;
    use crate::motion::initial_condition::InitialCondition;
    use crate::motion::trajectory::Trajectory;
    use crate::parameters::system::System;
    use crate::testing::{self, refused};
    use crate::toss::single::TOSS_START;

    const fn periods(periods: u64) -> PhaseSpan {
        PhaseSpan { periods, remainder: 0.0 }
    }

    fn toss() -> Engine {
        let start =
            InitialCondition::Contact { phase: Phase::new(TOSS_START).expect("legal"), angular_speed: 0.0 };
        Engine::new(System::pizza_toss(), start, ChatterPolicy::Complete).expect("legal")
    }

    #[test]
    fn the_instants_are_equally_far_apart_and_none_is_past_the_end() {
        for (span, count) in [(periods(10), 401), (periods(1), 2), (periods(3), 7), (periods(0), 3)] {
            let states = toss().sample(span, count, &Unobserved).expect("legal");
            assert_eq!(states.len(), count);
            let start = toss().time();
            assert_eq!((states[0].time, states[count - 1].time), (start, start.after(span)));
            let step = span.radians() / (count - 1) as f64;
            for (index, state) in states.iter().enumerate() {
                let since = state.time.since(&start).radians();
                assert!((since - step * index as f64).abs() < 1e-12 * (1.0 + since), "{span:?} {index}");
            }
        }
    }

    #[test]
    fn a_disk_that_rests_for_ever_is_followed_to_the_end() {
        let system = System::pizza_toss().with_platform(|platform| platform.amplitude = 0.0).expect("legal");
        let start = InitialCondition::Contact { phase: Phase::new(1.0).expect("legal"), angular_speed: 0.0 };
        let mut engine = Engine::new(system, start, ChatterPolicy::Complete).expect("legal");
        let states = engine.sample(periods(100), 50, &Unobserved).expect("legal");
        assert!(states.iter().all(|state| state.disk.height.abs() <= 0.0));
        assert_eq!(states[49].time.periods, 100);
    }

    #[test]
    fn what_is_too_much_is_refused_and_what_is_long_can_be_stopped() {
        let sample = |(span, count)| toss().sample(span, count, &Unobserved);
        refused("instants of a motion", [(periods(1), 0), (periods(1), 1)], sample);
        refused("periods", [(periods(MAX_SAMPLED_PERIODS + 1), 2), (PhaseSpan::LONGEST, 2)], sample);
        let too_large = bouncing_disk_core::Error::TooLarge {
            what: "instants of a motion",
            count: MAX_SAMPLES as u64 + 1,
            limit: MAX_SAMPLES as u64,
        };
        refused(Error::from(too_large), [(periods(1), MAX_SAMPLES + 1)], sample);
        let soon = |progress: Progress| {
            if progress.done > 1_000 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let Err(Error::Core(bouncing_disk_core::Error::Stopped { done, total })) =
            toss().sample(periods(MAX_SAMPLED_PERIODS), 2, &soon)
        else {
            panic!("not stopped")
        };
        assert!(done > 1_000 && done < 100_000 && total == MAX_SAMPLED_PERIODS, "{done} {total}");
    }

    proptest! {
        /// The states equal those of a recorded motion at the same instants, to the last bit.
        #[test]
        fn states_are_those_of_the_trajectory(
            (system, start, policy) in testing::motion(), count in 2..40_usize, span in 0..6_u64,
        ) {
            let Ok(mut engine) = Engine::new(system, start, policy) else { return Ok(()) };
            let end = engine.time().after(periods(span));
            let mut again = engine.clone();
            let Ok(states) = engine.sample(periods(span), count, &Unobserved) else {
                return Ok(());
            };
            let recorded = Trajectory::record(&mut again, |record| record.time.order(&end) == Ordering::Greater);
            let recorded = recorded.expect("as before");
            for state in states.iter().filter(|state| state.time.order(&recorded.end()) == Ordering::Less) {
                let at = recorded.at(state.time).map(|at| (at.disk, at.platform));
                prop_assert_eq!(at, Some((state.disk, state.platform)));
            }
        }
    }
}
