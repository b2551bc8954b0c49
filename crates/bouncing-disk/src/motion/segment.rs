//! The closed-form motion between two events.

use bouncing_disk_core::Launch;

use crate::motion::chatter::Chatter;
use crate::motion::energy::EnergyLedger;
use crate::motion::friction::Friction;
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motion::rotary_change::{change_in_contact, change_in_flight, contact_ledger, record_flight_load};
use crate::motion::state::{DiskState, Mode, PlatformState, Snapshot};
use crate::parameters::dimensionless::DimensionlessSystem;

/// The motion of the disk between two events, valid until the next event.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Segment {
    /// The instant of the previous event.
    pub start: PhaseTime,
    /// The state just after that event.
    pub state: DiskState,
    /// Launch speed of a chattering sequence that fills the segment (mode flight), in units of g/omega.
    pub chatter_speed: Option<f64>,
}

impl Segment {
    /// Disk and platform at the given `fraction`, in [0, 1], of `span` after the start.
    #[must_use]
    pub fn evaluate(&self, system: &DimensionlessSystem, span: PhaseSpan, fraction: f64) -> Snapshot {
        if fraction >= 1.0 {
            return self.state_after(system, span);
        }
        self.state_after(system, PhaseSpan::from_radians(fraction * span.radians()))
    }

    /// Disk and platform `span` after the start, assuming that no event comes before. A chatter speed that
    /// starts no chattering sequence in this system counts as `None`.
    #[must_use]
    pub fn state_after(&self, system: &DimensionlessSystem, span: PhaseSpan) -> Snapshot {
        let span = span.normalised();
        let time = self.start.after(span);
        let platform = PlatformState::at(system, time.phase);
        let disk = match (self.state.mode, self.chatter_of(system)) {
            (Mode::Flight, None) => self.flown(system, span),
            (Mode::Flight, Some(speed)) => self.chattered(system, speed, span),
            (Mode::Sticking | Mode::Sliding(_), _) => {
                let change = change_in_contact(
                    system,
                    self.state.mode,
                    self.state.angular_speed,
                    (self.start.phase, time.phase),
                    span,
                );
                DiskState {
                    mode: self.state.mode,
                    height: platform.height,
                    axial_velocity: platform.axial_velocity,
                    angle: self.state.angle + change.angle,
                    angular_speed: change.speed,
                }
            }
        };
        Snapshot { time, disk, platform }
    }

    /// The energy balance from the start to `span` later, assuming that no event comes before; for a whole
    /// segment it is [`EventRecord::ledger`](crate::EventRecord) without the impact that ends it. A chatter
    /// speed is treated as in [`Self::state_after`].
    #[must_use]
    pub fn ledger_after(&self, system: &DimensionlessSystem, span: PhaseSpan) -> EnergyLedger {
        let span = span.normalised();
        let end = self.state_after(system, span);
        let mut ledger = EnergyLedger::default();
        match (self.state.mode, self.chatter_of(system)) {
            (Mode::Sticking | Mode::Sliding(_), _) => {
                let phases = (self.start.phase, end.time.phase);
                let change =
                    change_in_contact(system, self.state.mode, self.state.angular_speed, phases, span);
                return contact_ledger(system, &Friction::new(system), &self.state, phases, span, &change);
            }
            (Mode::Flight, None) => {
                let change = change_in_flight(system.load(), self.state.angular_speed, span.radians());
                record_flight_load(&mut ledger, system.load(), self.state.angular_speed, &change);
            }
            (Mode::Flight, Some(speed)) => {
                let duration = span.radians();
                let chatter =
                    Chatter::new(system, self.start.phase, speed, self.state.angular_speed, duration);
                let change = change_in_flight(system.load(), chatter.angular_speed, duration - chatter.time);
                ledger = chatter.ledger;
                record_flight_load(&mut ledger, system.load(), chatter.angular_speed, &change);
                // The platform's velocity at the last impact is taken at a rounded phase.
                ledger.record_rounding(system.peak_acceleration(), chatter.launch_velocity(system));
            }
        }
        ledger.record_axial_change(
            [self.state.axial_velocity, end.disk.axial_velocity],
            [self.state.height, end.disk.height],
        );
        ledger
    }

    /// The chatter speed if it starts a chattering sequence: any other sequence might never end.
    fn chatter_of(&self, system: &DimensionlessSystem) -> Option<f64> {
        self.chatter_speed.filter(|speed| {
            let launch = Launch::new(self.start.phase, *speed);
            let at = launch.ok().and_then(|launch| system.map().accumulation(launch));
            at.is_some_and(|at| at.duration > 0.0)
        })
    }

    fn flown(&self, system: &DimensionlessSystem, span: PhaseSpan) -> DiskState {
        let duration = span.radians();
        let change = change_in_flight(system.load(), self.state.angular_speed, duration);
        DiskState {
            mode: Mode::Flight,
            height: self.state.height + duration * (self.state.axial_velocity - 0.5 * duration),
            axial_velocity: self.state.axial_velocity - duration,
            angle: self.state.angle + change.angle,
            angular_speed: change.speed,
        }
    }

    fn chattered(&self, system: &DimensionlessSystem, speed: f64, span: PhaseSpan) -> DiskState {
        let duration = span.radians();
        let chatter = Chatter::new(system, self.start.phase, speed, self.state.angular_speed, duration);
        let change = change_in_flight(system.load(), chatter.angular_speed, duration - chatter.time);
        let rest = duration - chatter.time;
        DiskState {
            mode: Mode::Flight,
            height: system.peak_acceleration() * chatter.pair.0
                + rest * (chatter.launch_velocity(system) - 0.5 * rest),
            axial_velocity: chatter.launch_velocity(system) - rest,
            angle: self.state.angle + (chatter.angle + change.angle),
            angular_speed: change.speed,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use bouncing_disk_core::{ChatterPolicy, Phase};
    use proptest::prelude::*;

    use super::*;
    use crate::motion::engine::Engine;
    use crate::motion::initial_condition::InitialCondition;
    use crate::parameters::dimensionless::{DimensionlessParameters, ForcingParameters};
    use crate::testing;

    /// Largest rounding residue of a balance, relative to the magnitudes of its terms.
    const CLOSURE: f64 = 1e-12;

    fn system() -> DimensionlessSystem {
        ForcingParameters { axial_forcing: 0.48, angular_forcing: 2.0, phase_lag: 0.2, restitution: 0.5 }
            .build()
            .expect("legal")
    }

    fn spans() -> impl Iterator<Item = PhaseSpan> {
        [0, 1, 1 << 53, u64::MAX].into_iter().flat_map(|periods| {
            [0.0, 1.0, TAU, 7.0, -1.0, 1e20, 1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN]
                .map(|remainder| PhaseSpan { periods, remainder })
        })
    }

    /// In flight, sticking, sliding and in the middle of a chattering sequence.
    #[test]
    fn the_state_after_any_span_is_one() {
        let phase = Phase::new(4.0).expect("finite");
        let start = InitialCondition::Contact { phase, angular_speed: 0.5 };
        let mut engine = Engine::new(system(), start, ChatterPolicy::Complete).expect("legal");
        let (mut flights, mut chatters, mut contacts) = (0, 0, 0);
        for _ in 0..200 {
            let segment = engine.advance().expect("no failure").expect("goes on").segment;
            match (segment.state.mode, segment.chatter_speed) {
                (Mode::Flight, Some(_)) => chatters += 1,
                (Mode::Flight, None) => flights += 1,
                _ => contacts += 1,
            }
            for span in spans() {
                for snapshot in [
                    segment.state_after(&system(), span),
                    engine.state_after(span),
                    segment.evaluate(&system(), span, f64::NAN),
                    segment.evaluate(&system(), span, 0.5),
                ] {
                    let DiskState { height, axial_velocity, angle, angular_speed, .. } = snapshot.disk;
                    for number in [height, axial_velocity, angle, angular_speed, snapshot.platform.angle] {
                        assert!(number.is_finite(), "{segment:?} {span:?}");
                    }
                }
            }
        }
        assert!(flights > 10 && chatters > 10 && contacts > 10, "{flights} {chatters} {contacts}");
    }

    /// Such a sequence once never ended.
    #[test]
    fn a_chatter_speed_that_starts_no_chatter_counts_as_none() {
        let phase = Phase::new(1.0).expect("finite");
        let start = InitialCondition::Launch { phase, relative_speed: 1.0, angular_speed: 0.0 };
        let mut engine = Engine::new(system(), start, ChatterPolicy::Complete).expect("legal");
        let flight = engine.advance().expect("no failure").expect("lands").segment;
        let span = PhaseSpan { periods: 3, remainder: 1.0 };
        for speed in [f64::NAN, f64::INFINITY, -1.0, 1.0, 1e300] {
            let segment = Segment { chatter_speed: Some(speed), ..flight };
            assert_eq!(segment.state_after(&system(), span), flight.state_after(&system(), span), "{speed}");
        }
    }

    proptest! {
        /// In the middle of a flight, of a chatter and of contact, and from the last event on.
        #[test]
        fn energy_is_balanced_at_any_instant(
            (system, start, policy) in testing::motion(), fraction in 0.0..=1.0_f64,
        ) {
            let Ok(mut engine) = Engine::new(system, start, policy) else { return Ok(()) };
            for _ in 0..30 {
                let rest = engine.ledger_after(PhaseSpan::from_radians(0.0));
                prop_assert!(rest.relative_closure() <= CLOSURE, "{rest:?}");
                let Ok(Some(record)) = engine.advance() else { break };
                let span = PhaseSpan::from_radians(fraction * record.span.radians());
                let (segment, ledger) = (record.segment, record.segment.ledger_after(&system, span));
                prop_assert!(
                    ledger.relative_closure() <= CLOSURE,
                    "{:e} {segment:?} {span:?} {ledger:?}",
                    ledger.relative_closure(),
                );
                // The balance must equal the change of the disk's energy.
                let (now, then) = (segment.state_after(&system, span).disk, segment.state);
                let gained = 0.5 * (now.angular_speed * now.angular_speed - then.angular_speed * then.angular_speed);
                let size = 1.0 + now.angular_speed * now.angular_speed + then.angular_speed * then.angular_speed;
                let error = (ledger.rotary_kinetic_change - gained).abs();
                prop_assert!(error <= 1e-9 * size.max(ledger.rotary_magnitude), "{error:e} {ledger:?}");
            }
        }
    }

    /// A rotor that brakes on a platform at rest: the contact never ends, and friction absorbs all the lost
    /// energy.
    #[test]
    fn a_contact_without_end_loses_what_its_disk_loses() {
        let still = DimensionlessParameters {
            peak_acceleration: 1e-4,
            twist_speed: 0.0,
            phase_lag: 0.0,
            friction: 0.1,
            restitution: 0.5,
            load: 0.0,
        };
        let system = still.build().expect("legal");
        let start =
            InitialCondition::Contact { phase: Phase::new(0.0).expect("finite"), angular_speed: 50.0 };
        let engine = Engine::new(system, start, ChatterPolicy::Complete).expect("legal");
        for periods in [1, 20, 50] {
            let span = PhaseSpan { periods, remainder: 0.0 };
            let (ledger, now) = (engine.ledger_after(span), engine.state_after(span).disk.angular_speed);
            let lost = 0.5 * (50.0 - now) * (50.0 + now);
            assert!(now < 50.0 && (ledger.friction_loss - lost).abs() < 1e-12 * lost, "{ledger:?}");
        }
    }
}
