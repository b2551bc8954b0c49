//! A recorded motion that can be evaluated at any time.

use std::cmp::Ordering;

use bouncing_disk_core::map::RestitutionLaw;
use bouncing_disk_core::read_checked;

use crate::error::{Error, check};
use crate::motion::energy::EnergyLedger;
use crate::motion::engine::{Engine, SineGround};
use crate::motion::event::EventRecord;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::segment::Segment;
use crate::motion::state::Snapshot;
use crate::parameters::dimensionless::DimensionlessSystem;

/// The events of a motion up to some point and the motion between them; if no event follows, also the motion
/// up to some instant.
///
/// Deserialising checks that the times do not decrease.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedTrajectory"))]
pub struct Trajectory {
    system: DimensionlessSystem,
    start: PhaseTime,
    records: Vec<EventRecord>,
    /// The motion after the last event, if no further event follows, and its end.
    eventless: Option<(Segment, PhaseTime)>,
}

read_checked!(Trajectory as UncheckedTrajectory {
    system: DimensionlessSystem,
    start: PhaseTime,
    records: Vec<EventRecord>,
    eventless: Option<(Segment, PhaseTime)>,
});

impl Trajectory {
    /// Checks a deserialised trajectory.
    fn check(&self) -> Result<(), Error> {
        let mut last = self.start;
        let recorded = self.records.iter().map(|EventRecord { time, segment, .. }| [segment.start, *time]);
        let eventless = self.eventless.iter().map(|(segment, end)| [segment.start, *end]);
        for time in recorded.chain(eventless).flatten() {
            let later = time.order(&last) != Ordering::Less;
            check(later, "time of an event (periods)", time.cycles(), "not before the previous event")?;
            last = time;
        }
        Ok(())
    }

    /// Runs `engine` until `last` is true for an event, which is included, or until the motion ends.
    ///
    /// For a disk that bounces or slips for ever, `last` must eventually be true.
    ///
    /// # Errors
    /// The errors of [`Engine::advance`].
    pub fn record<L: RestitutionLaw>(
        engine: &mut Engine<SineGround<L>>,
        last: impl FnMut(&EventRecord) -> bool,
    ) -> Result<Self, Error> {
        let now = engine.time();
        Self::record_until(engine, now, last)
    }

    /// [`Self::record`], which then follows the disk until `end` if it sticks or slides for ever, or for so
    /// long that the next event cannot be located.
    ///
    /// # Errors
    /// The errors of [`Self::record`].
    pub fn record_until<L: RestitutionLaw>(
        engine: &mut Engine<SineGround<L>>,
        end: PhaseTime,
        mut last: impl FnMut(&EventRecord) -> bool,
    ) -> Result<Self, Error> {
        let (system, start) = (*engine.system(), engine.time());
        let mut trajectory = Self { system, start, records: Vec::new(), eventless: None };
        loop {
            let is_before_end = engine.time().order(&end) == Ordering::Less;
            let next = if is_before_end {
                let (segment, record) = engine.advance_towards(&end)?;
                trajectory.eventless = record.is_none().then_some((segment, end));
                record
            } else {
                engine.advance()?
            };
            let Some(record) = next else { return Ok(trajectory) };
            trajectory.records.push(record);
            if last(&record) {
                return Ok(trajectory);
            }
        }
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

    /// The end of a motion without further events; otherwise the last event, or the start if there is none.
    #[must_use]
    pub fn end(&self) -> PhaseTime {
        let last = self.records.last().map_or(self.start, |record| record.time);
        self.eventless.map_or(last, |(_, end)| end)
    }

    /// Energy balance of the whole motion.
    #[must_use]
    pub fn ledger(&self) -> EnergyLedger {
        let eventless = self
            .eventless
            .map(|(segment, end)| segment.ledger_after(&self.system, end.since(&segment.start)));
        self.records.iter().map(|record| record.ledger).chain(eventless).sum()
    }

    /// Disk and platform at `time`; at an event, just after it. `None` outside the recorded motion.
    #[must_use]
    pub fn at(&self, time: PhaseTime) -> Option<Snapshot> {
        if time.order(&self.start) == Ordering::Less || time.order(&self.end()) == Ordering::Greater {
            return None;
        }
        let index = self.records.partition_point(|record| record.time.order(&time) != Ordering::Greater);
        let Some(record) = self.records.get(index) else {
            if let Some((segment, _)) = self.eventless {
                return Some(segment.state_after(&self.system, time.since(&segment.start)));
            }
            let last = self.records.last()?;
            let mut snapshot = last.segment.state_after(&self.system, last.span);
            (snapshot.time, snapshot.disk) = (last.time, last.after);
            return Some(snapshot);
        };
        Some(record.segment.state_after(&self.system, time.since(&record.segment.start)))
    }

    /// Disk and platform at each of `times` within the recorded motion.
    pub fn sample(&self, times: impl IntoIterator<Item = PhaseTime>) -> impl Iterator<Item = Snapshot> {
        times.into_iter().filter_map(|time| self.at(time))
    }

    /// Disk and platform at `count` >= 2 equidistant instants from the start to the end.
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
    use bouncing_disk_core::Unobserved;
    use bouncing_disk_core::{ChatterPolicy, Phase};

    use proptest::prelude::*;

    use super::*;
    use crate::motion::event::Event;
    use crate::motion::initial_condition::InitialCondition;
    use crate::motion::state::Mode;
    use crate::parameters::DimensionlessParameters;
    use crate::parameters::dimensionless::ForcingParameters;
    use crate::{DiskParameters, PlatformParameters, System, testing};

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

    /// Loads, frictions and twists for which no further event happens. The speeds follow from Eq. (4): with the
    /// load l and the friction k (rad/s^2) a sliding disk decelerates at l -+ k, and without friction only the
    /// load acts.
    #[test]
    fn motions_without_events_are_followed_to_their_end() {
        let of = |amplitude: f64, twist_amplitude: f64, friction: f64, load: f64, speed: f64, end: f64| {
            let platform =
                PlatformParameters { angular_frequency: 100.0, amplitude, twist_amplitude, phase_lag: 0.0 };
            let (contact_radius, gyration_radius) = (0.1, 0.07);
            let disk = DiskParameters {
                contact_radius,
                gyration_radius,
                friction,
                restitution: 0.5,
                preload_acceleration: 9.81,
                load_acceleration: load,
            };
            let system = System::new(platform.build().unwrap(), disk.build().unwrap()).unwrap();
            let scales = system.scales();
            let phase = Phase::new(0.5).unwrap();
            let start = InitialCondition::Contact { phase, angular_speed: speed / scales.angular_speed };
            let engine = Engine::new(system, start, ChatterPolicy::Complete).unwrap();
            let span = PhaseSpan::from_radians(100.0);
            let until = engine.time().after(span);
            let motion = Trajectory::record_until(&mut engine.clone(), until, |_| false).unwrap();
            assert_eq!(motion.end(), until);
            assert!(motion.check().is_ok() && motion.ledger().relative_closure() < 1e-12);
            let last = motion.at(until).unwrap();
            assert_eq!(engine.clone().sample(span, 2, &Unobserved).unwrap()[1], last);
            let found = last.disk.angular_speed * scales.angular_speed;
            assert!((found - end).abs() <= 1e-12 * end.abs(), "{friction} {load} {speed}: {found} {end}");
            motion.records().len()
        };
        let friction = 0.3 * 9.81 * 0.1 / (0.07 * 0.07);
        // The load exceeds friction: the disk slides for ever, from rest or after it has stopped.
        assert_eq!(of(0.0, 0.0, 0.3, 120.12, 0.0, friction - 120.12), 0);
        let stop = 50.0 / (120.12 + friction);
        assert_eq!(of(0.0, 0.0, 0.3, 120.12, 50.0, (1.0 - stop) * (friction - 120.12)), 1);
        // The load is smaller: the disk stops and sticks for ever, and a slight motion of the platform does
        // not change this.
        assert_eq!(of(0.0, 0.0, 0.3, 30.0, 10.0, 0.0), 1);
        assert_eq!(of(1e-5, 0.0, 0.3, 30.0, 0.0, 0.0), 0);
        // Without friction only the load acts; without load, nothing.
        assert_eq!(of(0.0, 0.0, 0.0, 5.0, 3.0, -2.0), 1);
        assert_eq!(of(5e-4, 0.0, 0.0, 0.0, 3.0, 3.0), 0);
        // A slip that ends after more periods than a phase can be followed.
        assert_eq!(of(0.0, 0.0, 1e-12, 0.0, 10.0, 10.0 - 1e-12 / 0.3 * friction), 0);
    }

    /// Without friction a twist does not affect the disk, which keeps its speed to the bit.
    #[test]
    fn no_friction_leaves_a_speed_as_it_is() {
        let slippery = DimensionlessParameters {
            peak_acceleration: 0.6,
            twist_speed: 2.0,
            phase_lag: 0.2,
            friction: 0.0,
            restitution: 0.5,
            load: 0.0,
        };
        let start = InitialCondition::Contact { phase: Phase::new(4.0).unwrap(), angular_speed: 0.3 };
        let mut engine = Engine::new(slippery.build().unwrap(), start, ChatterPolicy::Complete).unwrap();
        let mut events = 0;
        let motion = Trajectory::record(&mut engine, |_| {
            events += 1;
            events == 50
        })
        .unwrap();
        assert!(
            motion.records().iter().all(|record| record.after.angular_speed.to_bits() == 0.3_f64.to_bits())
        );
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
            let mut trajectory = Trajectory { system, start, records: Vec::new(), eventless: None };
            while let Ok(Some(record)) = engine.advance() {
                for crate::motion::DiskState { height, axial_velocity, angle, angular_speed, .. } in [record.before, record.after] {
                    prop_assert!([height, axial_velocity, angle, angular_speed].map(f64::is_finite) == [true; 4]);
                }
                prop_assert!(record.axial_impulse.is_finite() && record.angular_impulse.is_finite());
                let EnergyLedger { axial_magnitude, rotary_magnitude, .. } = record.ledger;
                prop_assert!(axial_magnitude >= 0.0 && rotary_magnitude >= 0.0 && record.ledger.load_work.is_finite());
                prop_assert!(record.segment.chatter_speed.unwrap_or(0.0) >= 0.0);
                prop_assert!((0.0..=std::f64::consts::TAU).contains(&record.span.remainder));
                if let Event::Impact { axial_impact_velocity, .. } = record.event {
                    prop_assert!(axial_impact_velocity <= 0.0);
                }
                trajectory.records.push(record);
                if trajectory.records.len() == 200 {
                    break;
                }
            }
            prop_assert_eq!(trajectory.check(), Ok(()));
        }
    }
}
