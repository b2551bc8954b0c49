//! The circuit's closed forms compared with the two differential equations, their limits, and every invalid
//! input.

use std::f64::consts::{FRAC_PI_2, TAU};

use bouncing_disk_core::numerics::elementary::{cos, sin, sin_cos};
use bouncing_disk_core::numerics::random::SplitMix64;

use super::*;
use crate::testing::refused;

const OMEGA: f64 = TAU * 70e3;

/// 10 g, Q = 300 and 1 V with 2.4 N/V: 35 nm at resonance.
fn volts() -> StatorParameters {
    StatorParameters {
        mass: Some(0.01),
        quality: Some(300.0),
        volts: Some(1.0),
        force_per_volt: Some(2.4),
        capacitance: Some(1e-9),
        ..StatorParameters::default()
    }
}

/// The same with a torsional mode, driven by the same electrodes.
fn torsional() -> StatorParameters {
    StatorParameters {
        kind: StatorKind::AxialAndTorsional,
        inertia: Some(2e-8),
        torsional_quality: Some(200.0),
        torsional_resonance: Some(70.2e3),
        torque_per_volt: Some(-3e-3),
        ..volts()
    }
}

const GIVEN: GivenMotion =
    GivenMotion { angular_frequency: OMEGA, amplitude: None, twist_amplitude: None, phase_lag: 0.0 };

const TWISTING: GivenMotion = GivenMotion { twist_amplitude: Some(("twist_amplitude", 1e-4)), ..GIVEN };

/// q = `a` sin(omega t) + `b` cos(omega t), which solves M q'' + c q' + k q = F sin(omega t + phase): by Cramer's rule.
fn solved(mode: &VibrationMode, omega: f64, force: f64, phase: f64) -> [f64; 2] {
    let spring = mode.mass * mode.angular_frequency * mode.angular_frequency;
    let damper = mode.mass * mode.angular_frequency / mode.quality * omega;
    let rest = spring - mode.mass * omega * omega;
    let ([on, off], determinant) =
        ([cos(phase), sin(phase)].map(|part| force * part), rest * rest + damper * damper);
    [(rest * on + damper * off) / determinant, (rest * off - damper * on) / determinant]
}

/// Without a rotor the tip moves as specified, and current and power agree with the two equations, each at 16
/// instants of a period.
#[test]
fn the_closed_forms_solve_the_differential_equations() {
    let mut random = SplitMix64::new(0x57A7);
    for _ in 0..200 {
        let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
        let table = StatorParameters {
            mass: Some(between(1e-3, 1.0)),
            quality: Some(between(0.5, 50.0)),
            resonance: Some(between(50e3, 90e3)),
            volts: Some(between(0.1, 100.0)),
            torsional_quality: Some(between(0.5, 50.0)),
            torsional_resonance: Some(between(50e3, 90e3)),
            ..torsional()
        };
        let stator = table.build(GIVEN).expect("legal");
        let circuit = stator.circuit().expect("there");
        let motion = stator.motion();
        let per_volt = [circuit.force_per_volt, circuit.torque_per_volt];
        for (mode, (amplitude, lag)) in
            stator.modes().iter().zip([(motion.amplitude, 0.0), (motion.twist_amplitude, motion.phase_lag)])
        {
            let [a, b] = solved(mode, OMEGA, mode.force, mode.phase);
            let (sine, cosine) = sin_cos(lag);
            let off = (a - amplitude * cosine).abs().max((b - amplitude * sine).abs());
            assert!(off <= 1e-12 * amplitude, "{off:e} of {amplitude:e}");
        }
        assert!((stator.amplitude_at(OMEGA) / motion.amplitude - 1.0).abs() < 1e-14);
        for omega in [OMEGA, between(0.1, 3.0) * OMEGA] {
            let found = stator.electrical_input_at(omega).expect("a circuit");
            let (amplitude, lead) = found.current.expect("a capacitance");
            let moved = stator.modes().iter().zip(per_volt);
            let moved: Vec<_> =
                moved.map(|(mode, alpha)| (alpha, solved(mode, omega, alpha * circuit.volts, 0.0))).collect();
            let (mut power, mut size) = (0.0, 0.0_f64);
            for instant in 0..16 {
                let phase = TAU * f64::from(instant) / 16.0;
                let (sine, cosine) = sin_cos(phase);
                let mut current = 1e-9 * omega * circuit.volts * cosine;
                size = size.max(current.abs());
                for (alpha, [a, b]) in &moved {
                    current += alpha * omega * (a * cosine - b * sine);
                    size = size.max((alpha * omega * (a.abs() + b.abs())).abs());
                }
                assert!((current - amplitude * sin(phase + lead)).abs() <= 1e-12 * size);
                power += circuit.volts * sine * current / 16.0;
            }
            assert!((power - found.power).abs() <= 1e-12 * circuit.volts * size, "{power} {}", found.power);
        }
        // The supply provides the power that the modes lose.
        let lost =
            stator.modes().iter().zip([motion.amplitude, motion.twist_amplitude]).map(|(mode, moved)| {
                0.5 * mode.mass * mode.angular_frequency / mode.quality * (OMEGA * moved) * (OMEGA * moved)
            });
        let (lost, given) = (lost.sum::<f64>(), stator.electrical_input_at(OMEGA).expect("a circuit").power);
        assert!((lost / given - 1.0).abs() < 1e-12, "{lost} {given}");
    }
}

#[test]
fn at_resonance_at_rest_and_at_the_anti_resonance_it_is_the_textbook() {
    let stator = volts().build(TWISTING).expect("legal");
    // alpha V Q/(M omega^2), with the force a quarter of a period ahead; F/k at rest.
    assert!((stator.motion().amplitude / (2.4 * 300.0 / (0.01 * OMEGA * OMEGA)) - 1.0).abs() < 1e-14);
    assert!((stator.modes()[0].phase - FRAC_PI_2).abs() < 1e-15);
    assert!((stator.amplitude_at(0.0) / (2.4 / (0.01 * OMEGA * OMEGA)) - 1.0).abs() < 1e-14);
    // At low frequency the capacitance is C_0 + alpha^2/k.
    let slow = stator.electrical_input_at(1e-3).expect("a circuit").current.expect("known");
    let whole = 1e-9 + 2.4 * 2.4 / (0.01 * OMEGA * OMEGA);
    assert!((slow.0 / (1e-3 * whole) - 1.0).abs() < 1e-12 && (slow.1 - FRAC_PI_2).abs() < 1e-9);
    // At the anti-resonance only the losses let a current flow: V omega C_0 omega omega_1/(Q (omega^2 -
    // omega_1^2)).
    let open = StatorParameters {
        force_per_volt: None,
        anti_resonance: Some(71e3),
        quality: Some(1e5),
        resonance: Some(70e3),
        ..volts()
    };
    let open = open.build(TWISTING).expect("legal");
    let current =
        |hertz: f64| open.electrical_input_at(TAU * hertz).expect("a circuit").current.expect("known").0;
    let left = 1.0 / (1e5 * (71.0 / 70.0 - 70.0 / 71.0));
    let known = open.circuit().expect("a circuit").volts * TAU * 71e3 * 1e-9 * left;
    assert!((current(71e3) / known - 1.0).abs() < 1e-6, "{} {known}", current(71e3));
    // With the computed force per volt it is the same stator.
    let same = StatorParameters { force_per_volt: open.circuit().map(|own| own.force_per_volt), ..volts() };
    let same = StatorParameters { quality: Some(1e5), resonance: Some(70e3), ..same };
    assert_eq!(same.build(TWISTING).expect("legal").modes(), open.modes());
}

/// Equivalent values of force, volts and amplitude describe the same stator.
#[test]
fn every_drive_gives_the_same_modes() {
    let stator = torsional().build(GIVEN).expect("legal");
    let (motion, circuit) = (stator.motion(), stator.circuit().expect("there"));
    let no_volts = StatorParameters { volts: None, ..torsional() };
    let twist = Some(("twist_amplitude", motion.twist_amplitude));
    let moved = GivenMotion { amplitude: Some(motion.amplitude), ..GIVEN };
    let twisted = GivenMotion { twist_amplitude: twist, phase_lag: motion.phase_lag, ..moved };
    for (table, given) in [
        (StatorParameters { force: Some(2.4), ..no_volts }, GIVEN),
        (no_volts, moved),
        (StatorParameters { torque_per_volt: None, ..no_volts }, twisted),
        (
            StatorParameters {
                torque_per_volt: None,
                torque: Some(3e-3),
                torque_phase: Some(PI),
                ..no_volts
            },
            moved,
        ),
    ] {
        let same = table.build(given).expect("legal");
        assert!((same.circuit().expect("there").volts - circuit.volts).abs() < 1e-14);
        for (one, other) in same.modes().iter().zip(stator.modes()) {
            let turned = (one.phase - other.phase) / TAU;
            assert!((one.force / other.force - 1.0).abs() < 1e-13 && (turned - turned.round()).abs() < 1e-13);
        }
        assert!((same.motion().twist_amplitude / motion.twist_amplitude - 1.0).abs() < 1e-13);
    }
    // A mode that moves axially and twists, by its kappa or by both motions.
    let twisting = StatorParameters { kind: StatorKind::AxialTwist, ..volts() };
    for (kappa, lag) in [(6e3, 0.0), (-6e3, PI)] {
        let by_kappa =
            StatorParameters { twist_per_height: Some(kappa), ..twisting }.build(GIVEN).expect("legal");
        let motion = by_kappa.motion();
        assert!((motion.phase_lag - lag).abs() < 1e-15 && !by_kappa.prescribes_twist());
        let twist_amplitude = Some(("twist_amplitude", motion.twist_amplitude));
        let by_twist =
            twisting.build(GivenMotion { twist_amplitude, phase_lag: lag, ..GIVEN }).expect("legal");
        assert!((by_twist.modes()[0].angle / kappa - 1.0).abs() < 1e-15 && by_twist.modes().len() == 1);
    }
    assert!(volts().build(TWISTING).expect("legal").prescribes_twist());
}

#[test]
fn what_is_wrong_is_told_by_its_field() {
    type Change = fn(&mut StatorParameters);
    let out_of_range: [(&str, Change); 17] = [
        ("stator.mass", |table| table.mass = Some(0.0)),
        ("stator.mass", |table| table.mass = Some(-0.01)),
        ("stator.mass", |table| table.mass = Some(f64::NAN)),
        ("stator.quality", |table| table.quality = Some(0.499)),
        ("stator.quality", |table| table.quality = Some(f64::INFINITY)),
        ("stator.resonance", |table| table.resonance = Some(0.0)),
        ("angular frequency of the stator (rad/s)", |table| table.resonance = Some(f64::MAX)),
        ("stator.volts", |table| table.volts = Some(-1.0)),
        ("force of the stator (N, or N m)", |table| table.volts = Some(1e-310)),
        ("stator.force_per_volt", |table| table.force_per_volt = Some(0.0)),
        ("stator.capacitance", |table| table.capacitance = Some(0.0)),
        ("stator.inertia", |table| table.inertia = Some(0.0)),
        ("stator.torsional_quality", |table| table.torsional_quality = Some(0.4)),
        ("stator.torsional_resonance", |table| table.torsional_resonance = Some(-1.0)),
        ("stator.torque_per_volt", |table| table.torque_per_volt = Some(f64::NAN)),
        ("stator.anti_resonance", |table| {
            (table.force_per_volt, table.anti_resonance) = (None, Some(70e3));
        }),
        ("stator.anti_resonance", |table| {
            (table.force_per_volt, table.anti_resonance, table.resonance) = (None, Some(71e3), Some(72e3));
        }),
    ];
    let with = |change: Change| {
        let mut table = torsional();
        change(&mut table);
        table
    };
    for (field, change) in out_of_range {
        refused(field, [change], |change| with(change).build(GIVEN));
    }
    let not_given = |field| Error::NotGiven { field };
    let both = |one, other| Error::BothGiven { one, other };
    let no_circuit = |field| Error::NoForcePerVolt { field };
    let cases: [(Error, Change); 17] = [
        (not_given("stator.mass"), |table| table.mass = None),
        (not_given("stator.quality"), |table| table.quality = None),
        (not_given("stator.inertia"), |table| table.inertia = None),
        (not_given("stator.torsional_quality"), |table| table.torsional_quality = None),
        (not_given("stator.capacitance"), |table| {
            (table.force_per_volt, table.anti_resonance, table.capacitance) = (None, Some(71e3), None);
        }),
        (no_circuit("stator.volts"), |table| table.force_per_volt = None),
        (no_circuit("stator.capacitance"), |table| {
            (table.force_per_volt, table.volts, table.force, table.torque_per_volt) =
                (None, None, Some(1.0), None);
        }),
        (both("stator.force", "stator.volts"), |table| table.force = Some(1.0)),
        (both("stator.force_per_volt", "stator.anti_resonance"), |table| table.anti_resonance = Some(71e3)),
        (both("stator.torque", "stator.torque_per_volt"), |table| table.torque = Some(1.0)),
        (both("stator.torque_phase", "stator.torque_per_volt"), |table| table.torque_phase = Some(1.0)),
        (not_given("stator.torque"), |table| {
            (table.torque_per_volt, table.torque_phase) = (None, Some(1.0));
        }),
        (both("another stator.kind", "stator.twist_per_height"), |table| table.twist_per_height = Some(1.0)),
        (both("another stator.kind", "stator.inertia"), |table| table.kind = StatorKind::Axial),
        (both("another stator.kind", "stator.inertia"), |table| table.kind = StatorKind::AxialTwist),
        (Error::NeitherGiven { one: "amplitude", other: "stator.volts" }, |table| table.volts = None),
        (Error::NeitherGiven { one: "peak_angular_speed", other: "twist_amplitude" }, |table| {
            table.torque_per_volt = None;
        }),
    ];
    for (error, change) in cases {
        assert_eq!(with(change).build(GIVEN), Err(error));
    }
    let amplitude = GivenMotion { amplitude: Some(1e-8), ..GIVEN };
    assert_eq!(torsional().build(amplitude), Err(both("amplitude", "stator.volts")));
    assert_eq!(torsional().build(TWISTING), Err(both("twist_amplitude", "stator.torque_per_volt")));
    let lagging = GivenMotion { phase_lag: 0.1, ..GIVEN };
    assert_eq!(torsional().build(lagging), Err(both("phase_lag", "stator.torque_per_volt")));
    let twisting = StatorParameters { kind: StatorKind::AxialTwist, ..volts() };
    refused("phase_lag", [0.1], |phase_lag| twisting.build(GivenMotion { phase_lag, ..TWISTING }));
    let off = StatorParameters { volts: Some(0.0), ..twisting };
    assert_eq!(off.build(TWISTING), Err(not_given("stator.twist_per_height")));
    assert!(StatorParameters { twist_per_height: Some(1.0), ..off }.build(GIVEN).is_ok());
}
