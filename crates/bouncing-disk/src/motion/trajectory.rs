//! A recorded motion that can be evaluated at any time.

use std::cmp::Ordering;

use bouncing_disk_core::{RestitutionLaw, read_checked};

use crate::error::{Error, check};
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::Engine;
use crate::motion::event::EventRecord;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::state::Snapshot;
use crate::parameters::dimensionless::DimensionlessSystem;

/// The events of a motion up to some point, and the motion between them.
///
/// The times of one that is read do not run back.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedTrajectory"))]
pub struct Trajectory {
    system: DimensionlessSystem,
    start: PhaseTime,
    records: Vec<EventRecord>,
}

read_checked!(Trajectory as UncheckedTrajectory {
    system: DimensionlessSystem,
    start: PhaseTime,
    records: Vec<EventRecord>,
});

impl Trajectory {
    /// Checks what is read.
    fn check(&self) -> Result<(), Error> {
        let mut last = self.start;
        for EventRecord { time, segment, .. } in &self.records {
            for time in [segment.start, *time] {
                let later = time.order(&last) != Ordering::Less;
                check(later, "time of an event (periods)", time.cycles(), "not before the event before")?;
                last = time;
            }
        }
        Ok(())
    }

    /// Runs `engine` on until `last` is true of an event, which is still recorded, or until it ends.
    ///
    /// A disk that bounces or slips for ever needs a `last` that becomes true.
    ///
    /// # Errors
    /// Those of [`Engine::advance`].
    pub fn record<L: RestitutionLaw>(
        engine: &mut Engine<L>,
        mut last: impl FnMut(&EventRecord) -> bool,
    ) -> Result<Self, Error> {
        let mut trajectory = Self { system: *engine.system(), start: engine.time(), records: Vec::new() };
        while let Some(record) = engine.advance()? {
            trajectory.records.push(record);
            if last(&record) {
                break;
            }
        }
        Ok(trajectory)
    }

    /// The system.
    #[must_use]
    pub const fn system(&self) -> &DimensionlessSystem {
        &self.system
    }

    /// The events.
    #[must_use]
    pub fn records(&self) -> &[EventRecord] {
        &self.records
    }

    /// The start.
    #[must_use]
    pub const fn start(&self) -> PhaseTime {
        self.start
    }

    /// The last event; the start if there is none.
    #[must_use]
    pub fn end(&self) -> PhaseTime {
        self.records.last().map_or(self.start, |record| record.time)
    }

    /// Energy balance of the whole motion.
    #[must_use]
    pub fn ledger(&self) -> EnergyLedger {
        self.records.iter().map(|record| record.ledger).sum()
    }

    /// Disk and platform at `time`; just after the event where an event is. `None` outside the recorded motion.
    #[must_use]
    pub fn at(&self, time: PhaseTime) -> Option<Snapshot> {
        if time.order(&self.start) == Ordering::Less || time.order(&self.end()) == Ordering::Greater {
            return None;
        }
        let index = self.records.partition_point(|record| record.time.order(&time) != Ordering::Greater);
        let Some(record) = self.records.get(index) else {
            let last = self.records.last()?;
            let mut snapshot = last.segment.state_after(&self.system, last.span);
            (snapshot.time, snapshot.disk) = (last.time, last.after);
            return Some(snapshot);
        };
        Some(record.segment.state_after(&self.system, time.since(&record.segment.start)))
    }

    /// Disk and platform at those of `times` that lie within the recorded motion.
    pub fn sample(&self, times: impl IntoIterator<Item = PhaseTime>) -> impl Iterator<Item = Snapshot> {
        times.into_iter().filter_map(|time| self.at(time))
    }

    /// Disk and platform at `count` >= 2 instants at equal distances from the start to the end.
    pub fn uniform(&self, count: usize) -> impl Iterator<Item = Snapshot> {
        let total = self.end().since(&self.start).radians();
        let steps = count.saturating_sub(1).max(1);
        self.sample((0..=steps).map(move |step| {
            if step == steps {
                self.end()
            } else {
                self.start.after(PhaseSpan::from_radians(total * (step as f64 / steps as f64)))
            }
        }))
    }
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::{ChatterPolicy, Phase};

    use proptest::prelude::*;

    use super::*;
    use crate::motion::event::Event;
    use crate::motion::initial_condition::InitialCondition;
    use crate::motion::state::Mode;
    use crate::parameters::dimensionless::ForcingParameters;
    use crate::testing;

    fn recorded() -> Trajectory {
        let system =
            ForcingParameters { axial_forcing: 0.6, angular_forcing: 2.0, phase_lag: 0.2, restitution: 0.5 };
        let start = InitialCondition::Contact { phase: Phase::new(4.0).unwrap(), angular_speed: 0.0 };
        let mut engine = Engine::new(system.build().unwrap(), start, ChatterPolicy::Complete).unwrap();
        let mut attachments = 0;
        Trajectory::record(&mut engine, |record| {
            attachments += usize::from(matches!(record.event, Event::Attachment { .. }));
            attachments == 2
        })
        .unwrap()
    }

    #[test]
    fn a_trajectory_is_continuous_between_and_at_its_events() {
        let trajectory = recorded();
        assert!(matches!(trajectory.records().last().unwrap().event, Event::Attachment { .. }));
        for record in trajectory.records() {
            let at = trajectory.at(record.time).unwrap();
            assert_eq!(at.disk.mode, record.after.mode);
            assert!((at.disk.height - record.after.height).abs() < 1e-12);
            assert!((at.disk.angular_speed - record.after.angular_speed).abs() < 1e-12);
            assert!((at.disk.angle - record.after.angle).abs() < 1e-12);
        }
        let samples: Vec<_> = trajectory.uniform(2001).collect();
        assert_eq!(samples.len(), 2001);
        assert_eq!(samples[0].time, trajectory.start());
        assert_eq!(samples[2000].time, trajectory.end());
        let step = trajectory.end().since(&trajectory.start()).radians() / 2000.0;
        for pair in samples.windows(2) {
            // Height and angle never jump.
            assert!((pair[1].disk.height - pair[0].disk.height).abs() < 10.0 * step);
            assert!((pair[1].disk.angle - pair[0].disk.angle).abs() < 10.0 * step);
            assert!(pair[0].disk.height >= pair[0].platform.height - 1e-12);
        }
        assert!(samples.iter().any(|sample| sample.disk.mode == Mode::Flight));
        assert!(trajectory.ledger().relative_closure() < 1e-14);
    }

    #[test]
    fn nothing_is_known_outside_the_recorded_motion() {
        let trajectory = recorded();
        let late = trajectory.end().after(PhaseSpan::from_radians(1e-3));
        let early = PhaseTime::in_first_period(Phase::new(3.9).unwrap());
        assert!(trajectory.at(late).is_none() && trajectory.at(early).is_none());
        assert_eq!(trajectory.sample([early, trajectory.start(), late]).count(), 1);
    }

    proptest! {
        #[test]
        fn whatever_is_recorded_can_be_read((system, start, policy) in testing::motion()) {
            let Ok(mut engine) = Engine::new(system, start, policy) else { return Ok(()) };
            let start = engine.time();
            let mut trajectory = Trajectory { system, start, records: Vec::new() };
            while let Ok(Some(record)) = engine.advance() {
                prop_assert_eq!(record.check(), Ok(()));
                prop_assert_eq!(record.event.check(), Ok(()));
                prop_assert_eq!(record.before.check(), Ok(()));
                prop_assert_eq!(record.after.check(), Ok(()));
                prop_assert_eq!(record.ledger.check(), Ok(()));
                prop_assert_eq!(record.segment.check(), Ok(()));
                prop_assert_eq!(record.span.check(), Ok(()));
                trajectory.records.push(record);
                if trajectory.records.len() == 200 {
                    break;
                }
            }
            prop_assert_eq!(trajectory.check(), Ok(()));
        }
    }
}
