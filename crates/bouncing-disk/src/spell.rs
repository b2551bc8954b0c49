//! The closed-form motion between two events, and its energy balance.

use bouncing_disk_core::Phase;
use serde::Serialize;

use crate::arc::{Arc, Term};
use crate::chatter::Chatter;
use crate::contact::Friction;
use crate::dimensionless::Dimensionless;
use crate::ledger::EnergyLedger;
use crate::phase_time::{PhaseSpan, PhaseTime};
use crate::state::{DiskState, Mode, PlatformState, SlipDirection, Snapshot};

/// The motion of the disk between two events, open at its end: it holds until the next event.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spell {
    /// The instant of the event before.
    pub start: PhaseTime,
    /// The state just after that event.
    pub state: DiskState,
    /// Launch speed of a chattering sequence that fills the spell (mode flight), in units of g/omega.
    pub chatter_speed: Option<f64>,
}

/// Change of the rotary state over a spell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Turn {
    /// Angular speed at the end.
    pub(crate) speed: f64,
    /// Change of the angle.
    pub(crate) angle: f64,
}

impl Spell {
    /// Disk and platform `fraction` of `span` after the start, `fraction` in [0, 1].
    #[must_use]
    pub fn evaluate(&self, system: &Dimensionless, span: PhaseSpan, fraction: f64) -> Snapshot {
        if fraction >= 1.0 {
            return self.state_after(system, span);
        }
        self.state_after(system, PhaseSpan::from_radians(fraction * span.radians()))
    }

    /// Disk and platform `span` after the start, on the assumption that no event comes before. A chatter speed that starts no
    /// chattering sequence in this system counts as none.
    #[must_use]
    pub fn state_after(&self, system: &Dimensionless, span: PhaseSpan) -> Snapshot {
        let span = span.normalised();
        let time = self.start.after(span);
        let platform = PlatformState::at(system, time.phase);
        // Any other sequence might never end.
        let chatters = |speed: &f64| {
            let vibration = system.vibration();
            let at = vibration.accumulation(self.start.phase, *speed, system.restitution());
            at.is_some_and(|at| at.duration > 0.0)
        };
        let disk = match (self.state.mode, self.chatter_speed.filter(chatters)) {
            (Mode::Flight, None) => self.flown(system, span),
            (Mode::Flight, Some(speed)) => self.chattered(system, speed, span),
            (Mode::Sticking | Mode::Sliding(_), _) => {
                let turn = contact_turn(system, &self.state, self.start.phase, time.phase, span);
                DiskState {
                    mode: self.state.mode,
                    height: platform.height,
                    axial_velocity: platform.axial_velocity,
                    angle: self.state.angle + turn.angle,
                    angular_speed: turn.speed,
                }
            }
        };
        Snapshot { time, disk, platform }
    }

    fn flown(&self, system: &Dimensionless, span: PhaseSpan) -> DiskState {
        let duration = span.radians();
        let turn = flight_turn(system, self.state.angular_speed, duration);
        DiskState {
            mode: Mode::Flight,
            height: self.state.height + duration * (self.state.axial_velocity - 0.5 * duration),
            axial_velocity: self.state.axial_velocity - duration,
            angle: self.state.angle + turn.angle,
            angular_speed: turn.speed,
        }
    }

    fn chattered(&self, system: &Dimensionless, speed: f64, span: PhaseSpan) -> DiskState {
        let duration = span.radians();
        let chatter = Chatter::new(system, self.start.phase, speed, self.state.angular_speed, duration);
        let turn = flight_turn(system, chatter.angular_speed, duration - chatter.time);
        let rest = duration - chatter.time;
        DiskState {
            mode: Mode::Flight,
            height: system.peak_acceleration() * chatter.pair.0
                + rest * (chatter.launch_velocity(system) - 0.5 * rest),
            axial_velocity: chatter.launch_velocity(system) - rest,
            angle: self.state.angle + (chatter.angle + turn.angle),
            angular_speed: turn.speed,
        }
    }
}

/// The rotary motion of a flight: only the load acts.
pub(crate) fn flight_turn(system: &Dimensionless, speed: f64, duration: f64) -> Turn {
    let lost = system.load() * duration;
    Turn { speed: speed - lost, angle: duration * (speed - 0.5 * lost) }
}

/// The rotary motion of a spell of contact that starts in `state`.
pub(crate) fn contact_turn(
    system: &Dimensionless,
    state: &DiskState,
    from: Phase,
    to: Phase,
    span: PhaseSpan,
) -> Turn {
    let arc = Arc::new(system.peak_acceleration(), from, span);
    match state.mode {
        Mode::Sliding(direction) => sliding_turn(system, direction, state.angular_speed, &arc),
        Mode::Sticking | Mode::Flight => {
            let (cosine, sine) = system.twist_components();
            Turn {
                speed: system.platform_angular_speed(to),
                angle: cosine * arc.sine_change + sine * arc.cosine_change,
            }
        }
    }
}

/// Sliding contact (Eq. 12): d(angular speed)/d tau = -s mu N - l with N = 1 - P sin tau, integrated.
fn sliding_turn(system: &Dimensionless, direction: SlipDirection, speed: f64, arc: &Arc) -> Turn {
    let t = arc.duration;
    let grip = direction.sign() * system.friction();
    let load = system.load();
    Turn {
        speed: speed - (grip * arc.force().value + load * t),
        angle: t * (speed - 0.5 * load * t) - grip * arc.force_twice().value,
    }
}

/// Energy balance of a flight, or of the flights of a chatter, as far as the load goes.
pub(crate) fn book_flight_load(ledger: &mut EnergyLedger, system: &Dimensionless, speed: f64, turn: &Turn) {
    let work = system.load() * turn.angle;
    ledger.book_rotary_change(speed, turn.speed);
    ledger.book_load(work, work.abs());
}

/// Energy balance of a spell of contact from `state` at `from` to `to`, where the disk has turned by `turn`.
pub(crate) fn contact_ledger(
    system: &Dimensionless,
    friction: &Friction,
    state: &DiskState,
    (from, to): (Phase, Phase),
    span: PhaseSpan,
    turn: &Turn,
) -> EnergyLedger {
    let mut ledger = EnergyLedger::default();
    let arc = Arc::new(system.peak_acceleration(), from, span);
    let peak = system.peak_acceleration();
    let (start, end) = (PlatformState::at(system, from), PlatformState::at(system, to));
    ledger.book_axial_change([start.axial_velocity, end.axial_velocity], [start.height, end.height]);
    // Integral of N P cos tau.
    ledger.book_normal(peak * arc.sine_change - peak * peak * arc.sine_cosine, 0.0);

    let load = system.load();
    ledger.book_rotary_change(state.angular_speed, turn.speed);
    let (cosine, sine) = system.twist_components();
    match state.mode {
        Mode::Sliding(direction) => {
            let mu = system.friction();
            // Where friction all but holds the load, the angle is a small difference of what each of them would give alone.
            let t = arc.duration;
            let angle_size =
                t * (state.angular_speed.abs() + 0.5 * load.abs() * t) + mu * arc.force_twice().size;
            ledger.book_load(load * turn.angle, load.abs() * angle_size);
            // Work of the platform: integral of -s mu N Q cos(tau + theta).
            let force = arc.force();
            let (force_cosine, force_sine) = (arc.force_cosine(), arc.force_sine());
            let platform: Term =
                [force.times(start.angular_speed), force_cosine.times(cosine), force_sine.times(-sine)]
                    .into_iter()
                    .sum();
            let work = -direction.sign() * mu * platform.value;
            // Loss: integral of mu N U.
            let (decay, own_cosine, own_sine) = friction.slip_law(direction);
            let slip = direction.sign() * (state.angular_speed - start.angular_speed);
            let slipped: Term = [
                force.times(slip),
                arc.force_moment().times(-decay),
                force_cosine.times(-own_cosine),
                force_sine.times(own_sine),
            ]
            .into_iter()
            .sum();
            ledger.book_friction(work, mu * slipped.value, mu * (platform.size + slipped.size));
        }
        Mode::Sticking | Mode::Flight => {
            ledger.book_load(load * turn.angle, (load * turn.angle).abs());
            // The friction torque is l + d(platform angular speed)/d tau: integrated times the platform's speed.
            let angle_change = cosine * arc.sine_change + sine * arc.cosine_change;
            let (before, after) = (start.angular_speed, end.angular_speed);
            let work = load * angle_change + 0.5 * (after - before) * (after + before);
            ledger.book_friction(work, 0.0, 0.5 * (before * before + after * after));
        }
    }
    ledger
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use bouncing_disk_core::ChatterPolicy;

    use super::*;
    use crate::dimensionless::ForcingParameters;
    use crate::engine::Engine;
    use crate::start::Start;

    fn system() -> Dimensionless {
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
        let start = Start::Contact { phase, angular_speed: 0.5 };
        let mut engine = Engine::new(system(), start, ChatterPolicy::Complete).expect("legal");
        let (mut flights, mut chatters, mut contacts) = (0, 0, 0);
        for _ in 0..200 {
            let spell = engine.advance().expect("no failure").expect("goes on").spell;
            match (spell.state.mode, spell.chatter_speed) {
                (Mode::Flight, Some(_)) => chatters += 1,
                (Mode::Flight, None) => flights += 1,
                _ => contacts += 1,
            }
            for span in spans() {
                for snapshot in [
                    spell.state_after(&system(), span),
                    engine.state_after(span),
                    spell.evaluate(&system(), span, f64::NAN),
                    spell.evaluate(&system(), span, 0.5),
                ] {
                    let DiskState { height, axial_velocity, angle, angular_speed, .. } = snapshot.disk;
                    for number in [height, axial_velocity, angle, angular_speed, snapshot.platform.angle] {
                        assert!(number.is_finite(), "{spell:?} {span:?}");
                    }
                }
            }
        }
        assert!(flights > 10 && chatters > 10 && contacts > 10, "{flights} {chatters} {contacts}");
    }

    /// The sequence never came to an end.
    #[test]
    fn a_chatter_speed_that_starts_no_chatter_counts_as_none() {
        let phase = Phase::new(1.0).expect("finite");
        let start = Start::Launch { phase, relative_speed: 1.0, angular_speed: 0.0 };
        let mut engine = Engine::new(system(), start, ChatterPolicy::Complete).expect("legal");
        let flight = engine.advance().expect("no failure").expect("lands").spell;
        let span = PhaseSpan { periods: 3, remainder: 1.0 };
        for speed in [f64::NAN, f64::INFINITY, -1.0, 1.0, 1e300] {
            let spell = Spell { chatter_speed: Some(speed), ..flight };
            assert_eq!(spell.state_after(&system(), span), flight.state_after(&system(), span), "{speed}");
        }
    }
}
