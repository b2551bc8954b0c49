//! Taps compared with the engine, each from the same state: motors with contact times of 0.01 to 18 periods,
//! random systems, and releases and rotors in borderline cases.

use bouncing_disk_core::ChatterPolicy;
use bouncing_disk_core::numerics::elementary::{cos, exp, ln, sin};
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_drives::Drive;

use super::*;
use crate::driven::{DrivenEngine, DrivenStart};
use crate::motion::energy::EnergyLedger;
use crate::motion::event::{Event, Motion, SteeredMotion};
use crate::motion::phase_time::phase_at;

/// Times, speeds and energies of a tap agree to this share of their magnitudes (for energies, of the engine's
/// terms); each balance closes to a tenth of this share.
const AGREEMENT: f64 = 1.0e-11;

/// A system, with its contact time in periods.
#[derive(Debug, Clone, Copy)]
struct Case {
    peak: f64,
    twist: f64,
    lag: f64,
    load: f64,
    friction: f64,
    restitution: f64,
    periods: f64,
}

/// The motor of Table III.
const MOTOR: Case =
    Case { peak: 197.4, twist: 4.27e5, lag: 0.0, load: 0.0, friction: 1.0, restitution: 0.5, periods: 1.0 };

/// A rotor in the engine and in closed form, and the number of taps that were decided.
struct Pair {
    case: Case,
    engine: DrivenEngine,
    tapped: Tapped,
    taps: u64,
    decided: u64,
}

impl Tapped {
    /// Kinetic and potential energy.
    fn axial_energy(&self) -> f64 {
        let (vibration, [gap, velocity]) = (self.solver.vibration(), self.launch);
        let speed = vibration.velocity(self.time.phase) + velocity;
        0.5 * speed * speed + (vibration.height(self.time.phase) + gap) + self.solver.spring_energy(gap)
    }
}

impl Pair {
    fn new(case: Case) -> Self {
        let drive = |amplitude: f64, angle: f64| Drive::fourier(&[(amplitude, angle)]).expect("legal");
        let Case { friction, restitution, load, .. } = case;
        let (height, angle) = (drive(case.peak, 0.0), drive(case.twist, case.lag));
        let rigid = DrivenSystem { height, angle, friction, restitution, load, compliance: None };
        let system = rigid.with_contact_time(case.periods * TAU).expect("legal");
        let tapped = Tapped::new(std::iter::once(&system)).expect("a sine");
        let start = DrivenStart::Contact { phase: phase_at(0.3), angular_speed: 0.0 };
        let engine = DrivenEngine::new(system, start, ChatterPolicy::Complete).expect("legal");
        Self { case, engine, tapped, taps: 0, decided: 0 }
    }

    /// A tap from a release; `None` if the disk is not released again.
    fn tap(&mut self, time: PhaseTime, launch: [f64; 2], speed: f64) -> Option<()> {
        let Self { case, engine, tapped, .. } = self;
        engine.fly_from(time, launch, speed);
        tapped.begin(time, launch, std::iter::once(speed));
        let (energy, mut axial) = (tapped.axial_energy(), AxialWindow::default());
        let decided = tapped.tap(&mut axial).is_some();
        let (mut ledger, mut events) = (EnergyLedger::default(), Vec::new());
        while !matches!(events.last(), Some(Event::Separation)) && !engine.lies_for_ever() {
            let record = engine.advance().expect("no failure").expect("an event");
            ledger += record.ledger;
            events.push(record.event);
        }
        (self.taps, self.decided) = (self.taps + 1, self.decided + u64::from(decided));
        let (end, rotor) = (engine.state(), &tapped.rotors[0]);
        if decided {
            let (done, own) = (rotor.done.clone(), rotor.speed);
            let launched = engine.flight().expect("the engine releases the disk, too");
            let duration = engine.time().since(&time).radians();
            let fastest = 1.0 + case.twist + speed.abs() + case.load.abs() * duration;
            let velocity = 1.0 + case.peak + launch[1] + launched[1];
            let (size, twist) = (ledger.axial_magnitude, ledger.rotary_magnitude);
            // The impulse is a difference of the platform's speeds, with about eight roundings of each.
            let rounding = 16.0 * f64::EPSILON / AGREEMENT * case.friction * (1.0 + case.peak) * fastest;
            let kinetic = 0.5 * (own - speed) * (own + speed);
            let load = case.load * done.angle;
            let balance = tapped.axial_energy() - energy - axial.normal_work + axial.restitution_loss;
            let rotary = kinetic - done.friction_work + done.friction_loss + load;
            let errors = [
                (tapped.time.since(&time).radians() - duration, 1.0 + duration),
                (tapped.launch[1] - launched[1], velocity),
                (tapped.launch[0] - launched[0], velocity),
                (own - end.angular_speed, fastest),
                (done.angle - end.angle, (1.0 + duration) * fastest),
                (axial.normal_work - ledger.normal_work, size),
                (axial.restitution_loss - ledger.restitution_loss, size),
                (done.friction_work - ledger.friction_work, twist + rounding),
                (done.friction_loss - ledger.friction_loss, twist + rounding),
                (balance / AGREEMENT * 1e-12, size),
                (rotary / AGREEMENT * 1e-12, twist),
            ];
            let agree = errors.iter().all(|(error, size)| error.abs() <= AGREEMENT * size);
            assert!(agree, "{case:?} {time:?} {launch:?} {speed}\n{errors:?}\n{events:?}");
        }
        engine.flight().map(|_| ())
    }

    /// Follows this number of consecutive taps, with perturbations.
    fn follow(&mut self, taps: u64) {
        let mut random = SplitMix64::new(7);
        while self.engine.flight().is_none() {
            if self.engine.lies_for_ever() || self.engine.advance().expect("no failure").is_none() {
                return;
            }
        }
        for _ in 0..taps {
            let launch = self.engine.flight().expect("a release");
            if self.tap(self.engine.time(), launch, self.engine.state().angular_speed).is_none() {
                return;
            }
            self.engine.perturb_launch(1e-3 * random.unit());
        }
    }
}

/// A random number whose logarithm is uniformly distributed.
fn between(random: &mut SplitMix64, low: f64, high: f64) -> f64 {
    low * exp(random.unit() * ln(high / low))
}

#[test]
fn nearly_all_taps_of_motors_are_decided_and_those_of_the_engine() {
    for periods in [0.01, 0.05, 0.2, 0.5, 0.6, 0.8, 1.0, 2.0, 3.0, 18.0] {
        for (lag, load) in [(0.0, 0.0), (-1.5, 0.02), (-0.7, 0.99)] {
            let mut pair = Pair::new(Case { periods, lag, load, ..MOTOR });
            pair.follow(300);
            assert!(pair.taps == 300 && pair.decided >= 290, "{periods} {lag} {}", pair.decided);
        }
    }
}

#[test]
fn taps_of_any_system_are_those_of_the_engine() {
    let (mut random, mut decided, mut taps) = (SplitMix64::new(3), 0, 0);
    let critical = exp(-2.0);
    for index in 0..200 {
        let restitutions =
            [0.02, 0.98, critical, critical * (1.0 + 1e-9), critical * 0.97, 0.001, 0.999, 0.5];
        let restitution =
            restitutions.get(index % 16).copied().unwrap_or_else(|| 0.02 + 0.96 * random.unit());
        let peak = if index % 5 == 0 {
            1.0 + between(&mut random, 1e-4, 1.0)
        } else {
            between(&mut random, 1.0, 1e4)
        };
        let mut pair = Pair::new(Case {
            peak,
            restitution,
            periods: between(&mut random, 0.01, 5.0),
            twist: between(&mut random, 1.0, 1e6),
            lag: 6.0 * random.unit() - 3.0,
            load: random.unit() - 0.5,
            friction: [0.0, 1.0, 0.3][index % 3],
        });
        pair.follow(60);
        (decided, taps) = (decided + pair.decided, taps + pair.taps);
    }
    assert!(taps > 5_000 && decided > taps / 2, "{decided} {taps}");
}

/// Releases with almost no speed, and rotors at the extremes of the platform's speed or at its speed at the
/// touch or the release.
#[test]
fn taps_on_seams_are_those_of_the_engine_or_left_to_it() {
    let mut random = SplitMix64::new(5);
    let (mut decided, mut taps) = (0, 0);
    for index in 0..60 {
        let periods = [0.01, 0.1, 0.5, 1.0, 2.0][index % 5];
        let mut pair = Pair::new(Case { periods, lag: 6.0 * random.unit() - 3.0, ..MOTOR });
        for _ in 0..20 {
            let time = PhaseTime::in_first_period(phase_at(TAU * random.unit()));
            let velocity = between(&mut random, 1e-12, 400.0);
            let gap = pair.tapped.solver.gap_at_release(velocity);
            let launch = [gap, velocity + [0.0, 1e-12, 1e-6, 1e-3][index % 4]];
            let mut speeds = vec![0.0, 2.0 * MOTOR.twist];
            for near in [1e-9, 1e-6, 1e-5, 3e-5] {
                speeds.extend(
                    [-1.0 - near, near - 1.0, 1.0 - near, 1.0 + near].map(|share| share * MOTOR.twist),
                );
            }
            if let Some(touch) = pair.tapped.solver.flight(time.phase, launch[0], launch[1])
                && let Some(tap) = pair.tapped.solver.contact(&touch)
            {
                for (at, gained) in [(tap.start, 0.0), (tap.end, pair.tapped.solver.impulse(&tap.end))] {
                    let there = -pair.tapped.rotors[0].slip(0.0, at.sin, at.cos);
                    let gained =
                        gained - if gained == 0.0 { 0.0 } else { pair.tapped.solver.impulse(&tap.start) };
                    for off in [-1e-6, -1e-8, -1e-10, 0.0, 1e-10, 1e-8, 1e-6] {
                        let speed = there + off * MOTOR.twist;
                        speeds.extend([speed, speed - gained, speed + gained]);
                    }
                }
            }
            for speed in speeds {
                pair.tap(time, launch, speed);
            }
        }
        (decided, taps) = (decided + pair.decided, taps + pair.taps);
    }
    assert!(decided > taps / 2, "{decided} {taps}");
}

/// The closed form and the engine compared with steps of 1/2000 of a period that use only the law of the
/// force, sliding friction and flight.
#[test]
fn a_motor_turns_as_small_steps_say() {
    for periods in [0.8, 2.0, 5.0] {
        let mut pair = Pair::new(Case { periods, lag: -0.3, ..MOTOR });
        pair.follow(3_000);
        let compliance = *pair.engine.system().compliance.as_ref().expect("soft").compliance();
        let (from, launch) = (pair.engine.time(), pair.engine.flight().expect("a release"));
        let start = pair.engine.state().angular_speed;
        for _ in 0..50 {
            let launch = pair.engine.flight().expect("a release");
            pair.tap(pair.engine.time(), launch, pair.engine.state().angular_speed).expect("a tap");
        }
        let rate = |t: f64, [y, v, q]: [f64; 3]| {
            let force = (-compliance.stiffness() * y - compliance.damping() * v).max(0.0);
            let force = if y <= 0.0 { force } else { 0.0 };
            [v, MOTOR.peak * sin(t) - 1.0 + force, -(q - MOTOR.twist * cos(t - 0.3)).signum() * force]
        };
        let span = pair.engine.time().since(&from).radians();
        let steps = (span / TAU * 2_000.0).ceil();
        let h = span / steps;
        let mut x = [launch[0], launch[1], start];
        for step in 0..steps as u32 {
            let t = from.phase.angle() + h * f64::from(step);
            let along = |k: [f64; 3], by: f64| [0, 1, 2].map(|i| x[i] + by * k[i]);
            let a = rate(t, x);
            let b = rate(t + 0.5 * h, along(a, 0.5 * h));
            let c = rate(t + 0.5 * h, along(b, 0.5 * h));
            let d = rate(t + h, along(c, h));
            x = [0, 1, 2].map(|i| x[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
        }
        let end = pair.engine.state().angular_speed;
        let off = (x[2] - end) / (end - start);
        assert!(off.abs() < 1e-3, "{periods}: {start} {end} {} {off:e}", x[2]);
    }
}

/// Releases after which the force nearly or actually returns and ends again within a radian, near a release
/// after which this happens before the touch.
#[test]
fn the_force_may_set_in_again_and_end_before_the_touch() {
    let mut random = SplitMix64::new(11);
    let mut pair = Pair::new(Case {
        peak: 1.188_519_49,
        restitution: 0.804_360_370_609_722,
        periods: 0.808_261_185_596_879_6,
        twist: 100.0,
        ..MOTOR
    });
    for index in 0..300 {
        let off = if index == 0 { 0.0 } else { 0.1 };
        let phase = 5.921_427_226_317_031 + off * (random.unit() - 0.5);
        let velocity = 0.787_019_819_925_675_5 + off * (random.unit() - 0.5);
        let launch = [pair.tapped.solver.gap_at_release(velocity), velocity];
        pair.tap(PhaseTime::in_first_period(phase_at(phase)), launch, 200.0);
    }
    assert!(pair.decided > 50, "{}", pair.decided);
}
