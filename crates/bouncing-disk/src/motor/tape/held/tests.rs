//! Held amplitudes for 40 kHz, 60 g, Q = 200 and contacts of 0.56 periods, compared with fourth-order
//! integration in small steps, with the amplitude held and free:
//!
//! | preload | held (nm) | small steps, held (nm) | small steps, free (nm) |
//! | --- | --- | --- | --- |
//! | 12 N | 5.923 | 5.9235 | 5.9235 |
//! | 8 N | 6.35 | 6.3423, 13.366 (unstable) | 6.3458, 16.27 |
//! | 7 N | 7.33, 11.14 (unstable) | 7.2946, 11.161 (unstable) | |
//!
//! At 8 N the branch with the unstable amplitude is lost on the way up; the run from the nearby minimum of
//! the drive (13.1 nm) reaches the state at 16.3 nm.

use bouncing_disk_core::Unobserved;
use bouncing_disk_core::run::Watch;

use super::*;
use crate::Motor;
use crate::motor::{AxialMotion, MotorParameters, OperatingPoint, OperatingRow, OperatingSettings};
use crate::parameters::contact::Contact;
use crate::parameters::stator::StatorParameters;
use crate::stator::StatorEngine;

/// A motor of 40 kHz on a stator of 60 g, quality 200 and 20 V, with contacts of 0.56 periods.
fn in_volts(newtons: f64, change: impl Fn(&mut MotorParameters, &mut StatorParameters)) -> Motor {
    let mut table = StatorParameters {
        mass: Some(0.06),
        quality: Some(200.0),
        resonance: Some(40e3),
        anti_resonance: Some(40.6e3),
        capacitance: Some(2e-9),
        volts: Some(20.0),
        ..StatorParameters::default()
    };
    let sheet = |sheet: &mut MotorParameters| {
        (sheet.drive_frequency, sheet.amplitude) = (40e3, None);
        (sheet.peak_angular_speed, sheet.twist_amplitude) = (Some(12.0), None);
        (sheet.mass, sheet.density, sheet.rotor_radius) = (Some(0.020), None, None);
        (sheet.contact_radius, sheet.gyration_radius) = (12.5e-3, Some(10e-3));
        (sheet.preload_force, sheet.preload_acceleration) = (Some(newtons), None);
        (sheet.friction, sheet.restitution) = (0.1, 0.5);
        sheet.contact = Some(Contact::lasting(14e-6));
        change(sheet, &mut table);
        sheet.stator = Some(table);
    };
    Motor::paper_70_khz().with(sheet).expect("legal")
}

fn rigid(sheet: &mut MotorParameters, _: &mut StatorParameters) {
    sheet.contact = None;
}

/// A resonance so sharp that the stator rings for 32,000 periods, with the same amplitude without a rotor.
fn sharp(_: &mut MotorParameters, table: &mut StatorParameters) {
    (table.quality, table.volts) = (Some(1e5), Some(0.04));
}

/// A stator 2000 times as heavy as the rotor, with the same amplitude without the rotor.
fn heavy(_: &mut MotorParameters, table: &mut StatorParameters) {
    (table.mass, table.volts) = (Some(40.0), Some(20.0 * (40.0_f64 / 0.06).sqrt()));
}

/// The held amplitudes, also in nm, and the stator without friction.
fn held(motor: &Motor) -> (Vec<Held>, Vec<(f64, bool)>, StatorSystem) {
    let system = motor.on_shaft().expect("legal");
    let still = system.with_disk(|disk| disk.friction = 0.0).expect("legal");
    let stator = motor.stator_motion().for_motor(&still).expect("legal");
    let own = stator.yielded().expect("it yields").clone();
    let watch = Watch::begin(&Unobserved, 0, 1).expect("goes on");
    let found = held_amplitudes(&own, (1e-3, 1), &mut watch.work()).expect("no failure");
    let unit = 1e9 * system.scales().length;
    let amplitudes = found.iter().map(|one| (unit * one.amplitude, one.is_stable)).collect();
    (found, amplitudes, own)
}

/// A held amplitude is a start for a run, not a result, so an error of this share is acceptable.
const START: f64 = 5e-3;

/// A program with fourth-order steps (1000 per period), which holds the amplitude and bisects brackets, finds
/// the same amplitudes, including unstable ones.
#[test]
fn held_amplitudes_are_those_of_small_steps() {
    let at_seven = [(7.2946, true), (11.1613, false)];
    for (newtons, known) in [(7.0, &at_seven[..]), (8.0, &[(6.3423, true)])] {
        let (_, found, _) = held(&in_volts(newtons, |_, _| {}));
        for &(amplitude, is_stable) in known {
            let is_it = |one: &&(f64, bool)| one.1 == is_stable && (one.0 / amplitude - 1.0).abs() < START;
            assert!(found.iter().any(|one| is_it(&one)), "{newtons}: {found:?}");
        }
    }
    // It lies on the stator: the amplitude of their joint linear motion.
    let (_, found, _) = held(&in_volts(12.0, |_, _| {}));
    assert!((found[0].0 / 5.9235 - 1.0).abs() < 1e-4, "{found:?}");
}

/// A disk that lies on the stator has its linear motion from the start, in every period to rounding.
#[test]
fn a_disk_that_lies_on_the_stator_starts_on_its_steady_motion() {
    type Change = fn(&mut MotorParameters, &mut StatorParameters);
    let changes: [Change; 4] = [
        |_, _| {},
        rigid,
        sharp,
        |sheet, table| {
            rigid(sheet, table);
            sharp(sheet, table);
        },
    ];
    for change in changes {
        let (found, _, system) = held(&in_volts(12.0, change));
        let free = system.base().peak_acceleration();
        let (time, state) = found[0].start(DiskStart::OnMotion(0.5));
        let mut engine = StatorEngine::of_state(system, time, state).expect("legal");
        let start = engine.state().modes[0];
        assert!(engine.advance().expect("no failure").is_none() || engine.lies_for_ever());
        for periods in [1.0, 40.0] {
            let now = engine.state_after(periods * std::f64::consts::TAU).1.modes[0];
            for (one, other) in now.into_iter().zip(start) {
                assert!((one - other).abs() < 1e-12 * free, "{now:?} {start:?}");
            }
        }
    }
}

/// On a heavy stator the amplitude stays at the held value only with the right phase of the drive; a wrong
/// phase would be half corrected within 40 periods.
#[test]
fn a_run_on_a_held_amplitude_keeps_it() {
    let (found, _, system) = held(&in_volts(5.0, heavy));
    let own = found.iter().find(|one| one.is_stable).expect("there");
    let (time, state) = own.start(DiskStart::OnMotion(0.0));
    let mut engine = StatorEngine::of_state(system, time, state).expect("legal");
    while engine.time().periods < 40 {
        engine.advance().expect("no failure").expect("it goes on");
        let (phase, [place, speed]) = (engine.time().phase.angle(), engine.state().modes[0]);
        let (sin, cos) = sin_cos(phase + own.ahead);
        let off = hypot(place + own.sag - own.amplitude * sin, speed - own.amplitude * cos);
        assert!(off < 3e-3 * own.amplitude, "{off} of {}", own.amplitude);
    }
}

fn operated(motor: &Motor, load: f64) -> OperatingRow {
    motor.operating_point(load, &OperatingSettings::default(), &Unobserved).expect("no failure")
}

/// Whether a point has this speed (rad/s) and amplitude (nm), each within an error.
fn is_at(point: &OperatingPoint, speed: [f64; 2], amplitude: [f64; 2]) -> bool {
    let own = 1e9 * point.stator.expect("it yields").amplitude.value;
    (point.speed.value - speed[0]).abs() < speed[1] && (own - amplitude[0]).abs() < amplitude[1]
}

/// Amplitudes and speeds from fourth-order integration of stator and rotor in small steps, under 2 mN m.
#[test]
fn operations_on_a_stator_that_yields_are_those_of_small_steps() {
    let lies = operated(&in_volts(12.0, |_, _| {}), 2e-3);
    let point = lies.steady().expect("settled");
    assert_eq!(lies.branches.len(), 1, "{lies:?}");
    assert!(is_at(point, [5.63, 0.03], [5.9235, 1e-3]), "{point:?}");
    // Two states, depending on the start.
    let both = operated(&in_volts(8.0, |_, _| {}), 2e-3);
    let points: Vec<_> = both.branches.iter().map(|own| own.steady().expect("settled")).collect();
    assert!(points.iter().any(|own| is_at(own, [7.291, 0.03], [6.3458, 1e-3])), "{both:?}");
    assert!(points.iter().any(|own| is_at(own, [7.496, 0.03], [16.30, 0.15])), "{both:?}");
    assert_eq!(points.len(), 2);
}

/// Integration in small steps, from rest, reaches these states only after hundreds of thousands of periods.
#[test]
fn stators_that_ring_for_long_settle() {
    let row = operated(&in_volts(5.0, sharp), 0.0);
    let point = row.steady().expect("settled");
    assert!(point.motion == AxialMotion::Contact && is_at(point, [0.046, 1e-3], [0.0120, 1e-4]), "{row:?}");
    let row = operated(&in_volts(5.0, heavy), 0.0);
    let points: Vec<_> = row.branches.iter().map(|own| own.steady().expect("settled")).collect();
    assert!(points.iter().any(|own| is_at(own, [3.0, 0.05], [504.992, 5e-3])), "{row:?}");
    assert!(points.iter().any(|own| is_at(own, [8.4, 0.2], [504.73, 0.03])), "{row:?}");
}

/// With rigid impacts on a stator of 20 rotor masses and quality 1000, the motion is irregular at either of
/// two amplitudes. By integration in small steps these are 4.977 nm (from rest) and 45.8(1.1) nm, with speeds
/// of 9.140 and 8.75(4) rad/s.
#[test]
fn irregular_motions_on_two_amplitudes_are_two_branches() {
    let motor = in_volts(5.0, |sheet, table| {
        sheet.contact = None;
        (table.mass, table.quality) = (Some(0.4), Some(1000.0));
        (table.volts, table.force) = (None, Some(6.5));
        (table.anti_resonance, table.capacitance) = (None, None);
    });
    let settings = OperatingSettings { relative_error: 0.05, ..OperatingSettings::default() };
    let row = motor.operating_point(0.0, &settings, &Unobserved).expect("no failure");
    let points: Vec<_> = row.branches.iter().map(|own| own.steady().expect("settled")).collect();
    assert!(points.len() == 2, "{row:?}");
    for (point, amplitude, speed) in [(points[0], 4.977, 9.140), (points[1], 45.8, 8.75)] {
        let known = point.stator.expect("it yields").amplitude;
        let within = (1e9 * known.value - amplitude).abs() < 1.96 * (1e9 * known.standard_error) + 2.2;
        assert!(within && matches!(point.motion, AxialMotion::Irregular { .. }), "{row:?}");
        assert!((point.speed.value - speed).abs() < 1.96 * point.speed.standard_error + 0.08, "{row:?}");
    }
}
