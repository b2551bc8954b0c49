use bouncing_disk_core::Unobserved;

use super::*;
use crate::motor::{OperatingSettings, TransientSettings};
use crate::parameters::contact::Contact;
use crate::parameters::stator::{StatorKind, StatorParameters};
use crate::testing::{in_volts, refused};

fn begun(motor: &Motor) -> Result<MotorSimulation, Error> {
    MotorSimulation::new(motor, MotorInputs::of(motor), SimulationSettings::default())
}

/// A motor whose stator has one mode that also twists, without a separate value for its twist, and a motor
/// whose stator has two modes.
fn twisting() -> [Motor; 2] {
    let change = |change: fn(&mut StatorParameters)| {
        in_volts().with(|sheet| sheet.stator.iter_mut().for_each(change)).expect("legal")
    };
    let one = change(|table| table.kind = StatorKind::AxialTwist);
    let two = change(|table| {
        table.kind = StatorKind::AxialAndTorsional;
        (table.inertia, table.torsional_quality) = (Some(2e-6), Some(200.0));
    });
    [one, two]
}

/// Motors with rigid contacts, with compliant contacts, and with each on a compliant stator; with one mode
/// that twists, under a load that depends on the speed, and with two modes.
fn motors() -> Vec<Motor> {
    let soft =
        |motor: &Motor| motor.with(|sheet| sheet.contact = Some(Contact::lasting(1e-5))).expect("legal");
    let (paper, volts) = (Motor::paper_70_khz(), in_volts());
    let [one, two] = twisting();
    let law = LoadLaw::fan(0.2, 5e-6, 3).expect("legal").with_inertia(1e-8).expect("legal");
    let fan = one.with(|sheet| sheet.load = Some(law)).expect("legal");
    vec![paper.clone(), soft(&paper), volts.clone(), soft(&volts), fan, two]
}

/// The time of each change, and the inputs from then on.
fn script(motor: &Motor) -> Vec<(f64, MotorInputs)> {
    let start = MotorInputs::of(motor);
    let loaded = MotorInputs { load_torque: 5e-6, ..start };
    let tuned = MotorInputs { drive_frequency: 1.001 * start.drive_frequency, ..loaded };
    let weak = MotorInputs { drive: 0.8 * start.drive, ..tuned };
    let off = MotorInputs { on: false, load_torque: 0.0, ..weak };
    vec![(0.0, start), (0.011, loaded), (0.02, tuned), (0.03, weak), (0.04, off), (0.05, start)]
}

/// The outputs at the changes, reached in `pieces` equal steps each.
fn run(motor: &Motor, pieces: u32) -> Vec<MotorOutputs> {
    let mut simulation = begun(motor).expect("legal");
    let mut script = script(motor);
    script.push((0.06, MotorInputs::of(motor)));
    let pair = |pair: &[(f64, MotorInputs)]| {
        let [(from, inputs), (to, _)] = pair else { unreachable!("pairs") };
        simulation.set_inputs(*inputs).expect("legal");
        let step = |piece: u32| from + (to - from) * f64::from(piece) / f64::from(pieces);
        (1..pieces).for_each(|piece| {
            simulation.advance(step(piece), &Unobserved).expect("no failure");
        });
        simulation.advance(*to, &Unobserved).expect("no failure")
    };
    script.windows(2).map(pair).collect()
}

#[test]
fn constant_inputs_give_the_same_bits_in_steps_of_any_length() {
    for motor in motors() {
        let (whole, pieces) = (run(&motor, 1), run(&motor, 137));
        assert!(whole[5].impacts > 50 && whole[0].speed > 0.01, "{whole:?}");
        for (one, other) in whole.iter().zip(&pieces) {
            let state = |outputs: &MotorOutputs| {
                let MotorOutputs { angle, speed, amplitude, current, .. } = *outputs;
                ([angle, speed, amplitude, current.unwrap_or_default()].map(f64::to_bits), outputs.impacts)
            };
            assert_eq!(state(one), state(other));
        }
    }
}

/// The power of the drive minus the losses, over a long time, agrees with an operating point, as do speed and
/// amplitude.
#[test]
fn long_runs_have_the_means_of_operating_points() {
    for motor in [Motor::paper_70_khz(), in_volts()] {
        let loaded = motor.with(|sheet| sheet.load_torque = 3e-6).expect("legal");
        let settings = OperatingSettings { relative_error: 0.05, ..OperatingSettings::default() };
        let known = crate::motor::operations(std::slice::from_ref(&loaded), &settings, &Unobserved)
            .expect("no failure");
        let known = known[0].steady().expect("steady");
        let mut simulation = begun(&loaded).expect("legal");
        let start = simulation.advance(5.0, &Unobserved).expect("no failure");
        let end = simulation.advance(65.0, &Unobserved).expect("no failure");
        let speed = (end.angle - start.angle) / 60.0;
        assert!((speed - known.speed.value).abs() < 0.1 * known.speed.value, "{speed} {:?}", known.speed);
        let power = known.stator.map_or(known.input_power, |stator| stator.drive_power).value;
        assert!((end.power - power).abs() < 0.1 * power, "{} {power}", end.power);
        let torque = 3e-6 + 1.0 / 60.0 * motor.inertia() * (end.speed - start.speed);
        assert!((end.shaft_torque - torque).abs() < 1e-10 * motor.largest_torque(), "{end:?} {torque}");
    }
}

/// A simulation agrees with a run-up under the same schedule of load and drive.
#[test]
fn inputs_act_as_the_table_of_a_load() {
    let law = LoadLaw::constant(-1e-5).expect("legal").with_inertia(1e-8).expect("legal");
    let law = law.with_factors(&[0.004], &[2.0]).expect("legal").with_drive(0.0, 0.008).expect("legal");
    let scheduled = in_volts().with(|sheet| sheet.load = Some(law)).expect("legal");
    let settings = TransientSettings { duration: 0.012, intervals: 3, ..TransientSettings::default() };
    let phase = Phase::new(0.0).expect("finite");
    let (curve, amplitudes) = scheduled.run_up(phase, &settings, &Unobserved).expect("no failure");
    let inertia = LoadLaw::constant(0.0).expect("legal").with_inertia(1e-8).expect("legal");
    let motor = in_volts().with(|sheet| sheet.load = Some(inertia)).expect("legal");
    let mut simulation = begun(&motor).expect("legal");
    let (mut angle, inputs) = (0.0, MotorInputs::of(&motor));
    for (index, (load_torque, on)) in [(-1e-5, true), (-2e-5, true), (-2e-5, false)].into_iter().enumerate() {
        simulation.set_inputs(MotorInputs { load_torque, on, ..inputs }).expect("legal");
        let end = simulation.advance(0.004 * (index + 1) as f64, &Unobserved).expect("no failure");
        let speed = (end.angle - angle) / 0.004;
        angle = end.angle;
        assert!((speed - curve.speeds[index]).abs() < 0.02 * speed.abs(), "{speed} {curve:?}");
        assert!((end.amplitude - amplitudes[index]).abs() < 1e-3 * end.amplitude, "{end:?} {amplitudes:?}");
    }
}

/// Under a rotor of negligible mass the circuit draws the same current and power as without one.
#[test]
fn the_current_is_that_of_the_circuit() {
    let motor = in_volts().with(|sheet| (sheet.mass, sheet.preload_force) = (Some(1e-12), Some(1e-11)));
    let motor = motor.expect("legal");
    let mut simulation = begun(&motor).expect("legal");
    let mut inputs = MotorInputs::of(&motor);
    for frequency in [70e3, 70.1e3, 69.9e3] {
        inputs.drive_frequency = frequency;
        simulation.set_inputs(inputs).expect("legal");
        // Until the ringing after the change has decayed.
        simulation.advance(simulation.time() + 0.05, &Unobserved).expect("no failure");
        let end = simulation.advance(simulation.time() + 0.01, &Unobserved).expect("no failure");
        let known =
            motor.stator().and_then(|stator| stator.electrical_input_at(std::f64::consts::TAU * frequency));
        let (current, power) =
            known.map(|known| (known.current.expect("known").0, known.power)).expect("a circuit");
        assert!((end.current.expect("known") - current).abs() < 1e-6 * current, "{end:?} {current}");
        assert!((end.power - power).abs() < 1e-3 * power, "{end:?} {power}");
    }
    inputs.on = false;
    simulation.set_inputs(inputs).expect("legal");
    let end = simulation.advance(simulation.time() + 0.1, &Unobserved).expect("no failure");
    assert!(end.current.expect("known") < 1e-9, "{end:?}");
}

#[test]
fn illegal_inputs_are_refused_and_change_nothing() {
    let motor = in_volts();
    let mut simulation = begun(&motor).expect("legal");
    simulation.advance(0.001, &Unobserved).expect("no failure");
    let good = simulation.inputs();
    let set = |inputs| simulation.clone().set_inputs(inputs);
    refused("load_torque", [f64::NAN], |load_torque| set(MotorInputs { load_torque, ..good }));
    refused("stator.volts", [-1.0], |drive| set(MotorInputs { drive, ..good }));
    refused("drive_frequency", [0.0], |drive_frequency| set(MotorInputs { drive_frequency, ..good }));
    refused("time", [0.0005], |time| simulation.clone().advance(time, &Unobserved));
    let mut other = simulation.clone();
    assert!(other.set_inputs(MotorInputs { drive: -1.0, ..good }).is_err());
    assert_eq!(other.advance(0.002, &Unobserved), simulation.advance(0.002, &Unobserved));
}

/// A rotor that lies on a stator whose drive is off, and one that a load turns there, for a long time without
/// events.
#[test]
fn a_rest_of_an_hour_costs_little() {
    // A load with a slope is followed step by step.
    let motors = motors().into_iter().filter(|motor| motor.load().is_none());
    for (motor, load_torque) in motors.flat_map(|motor| [(motor.clone(), 0.0), (motor, 1e-3)]) {
        let mut simulation = begun(&motor).expect("legal");
        let inputs = MotorInputs { on: false, load_torque, ..MotorInputs::of(&motor) };
        simulation.set_inputs(inputs).expect("legal");
        simulation.advance(1.0, &Unobserved).expect("no failure");
        let start = simulation.advance(3599.0, &Unobserved).expect("no failure");
        let end = simulation.advance(3600.0, &Unobserved).expect("no failure");
        // Under the part of the load that friction cannot hold, the speed falls uniformly.
        let gained = -(load_torque - motor.largest_torque()).max(0.0) / motor.inertia();
        let (mean, change) = (end.angle - start.angle, end.speed - start.speed);
        assert!((change - gained).abs() <= 1e-9 * gained.abs() + 1e-12, "{start:?} {end:?} {gained}");
        assert!(
            (mean - 0.5 * (start.speed + end.speed)).abs() <= 1e-8 * mean.abs() + 1e-12,
            "{start:?} {end:?}"
        );
        assert!(load_torque > 0.0 || end.angle.abs() < 1.0, "{end:?}");
        let torque = load_torque.min(motor.largest_torque());
        assert!(
            (end.shaft_torque - torque).abs() <= 1e-9 * torque + 1e-30 && end.power.abs() < 1e-20,
            "{end:?} {torque}"
        );
    }
}

/// On a stator too slow to throw the rotor, friction on average balances the load, and the drive supplies the
/// power.
#[test]
fn a_rotor_that_creeps_has_the_power_of_its_operating_point() {
    let creeping = Motor::paper_70_khz().with(|sheet| {
        (sheet.amplitude, sheet.load_torque, sheet.contact_radius) = (Some(4e-11), 4e-5, 5e-3);
    });
    let creeping = creeping.expect("legal");
    let known =
        crate::motor::operations(std::slice::from_ref(&creeping), &OperatingSettings::default(), &Unobserved);
    let known = *known.expect("no failure")[0].steady().expect("steady");
    let mut simulation = begun(&creeping).expect("legal");
    let start = simulation.advance(2.5, &Unobserved).expect("no failure");
    let end = simulation.advance(2.7, &Unobserved).expect("no failure");
    let speed = (end.angle - start.angle) / 0.2;
    assert!((speed - known.speed.value).abs() < 0.01 * known.speed.value.abs(), "{speed} {known:?}");
    assert!(
        (end.power - known.input_power.value).abs() < 0.01 * known.input_power.value,
        "{end:?} {known:?}"
    );
    assert!((end.shaft_torque - 4e-5).abs() < 1e-7, "{end:?}");
}

/// If one mode also twists, half the voltage produces half the twist, and nothing jumps.
#[test]
fn the_twist_of_a_mode_follows_the_drive() {
    let [one, _] = twisting();
    let start = MotorInputs::of(&one);
    let twist = |inputs: MotorInputs| {
        let simulation = MotorSimulation::new(&one, inputs, SimulationSettings::default()).expect("legal");
        simulation.motor.system().platform().peak_angular_speed()
    };
    let whole = twist(start);
    assert!((twist(MotorInputs { drive: 0.5 * start.drive, ..start }) - 0.5 * whole).abs() < 1e-12 * whole);
    assert!(twist(MotorInputs { drive: 0.0, ..start }).abs() < 1e-12 * whole);
}

/// A mode that is switched on from rest rings up; for a step of zero duration the means are those of the
/// previous step.
#[test]
fn a_drive_that_is_off_at_the_start_rings_up() {
    let motor = in_volts();
    let off = MotorInputs { on: false, ..MotorInputs::of(&motor) };
    let mut simulation = MotorSimulation::new(&motor, off, SimulationSettings::default()).expect("legal");
    let start = simulation.advance(0.001, &Unobserved).expect("no failure");
    assert!(start.amplitude < 1e-20 && start.impacts == 0 && start.power == 0.0, "{start:?}");
    simulation.set_inputs(MotorInputs::of(&motor)).expect("legal");
    let early = simulation.advance(0.0015, &Unobserved).expect("no failure");
    let late = simulation.advance(0.03, &Unobserved).expect("no failure");
    assert!(early.amplitude < 0.5 * late.amplitude && late.power > 0.0, "{early:?} {late:?}");
    let again = simulation.advance(0.03, &Unobserved).expect("no failure");
    assert_eq!((again.power, again.shaft_torque), (late.power, late.shaft_torque));
}

/// Amplitude and current at the ends of these steps, which are an odd fraction of a period.
fn sampled(simulation: &mut MotorSimulation, steps: u32) -> Vec<[f64; 2]> {
    let part = 0.137 / simulation.inputs().drive_frequency;
    let begun = simulation.time();
    let mut at = |step: u32| {
        let end = simulation.advance(begun + part * f64::from(step), &Unobserved).expect("no failure");
        [end.amplitude, end.current.expect("a capacitance")]
    };
    (1..=steps).map(&mut at).collect()
}

/// Without a rotor, amplitude and current agree with the closed form, also off resonance.
#[test]
fn amplitude_and_current_are_constant_at_any_frequency_of_the_drive() {
    let motor = in_volts().with(|sheet| (sheet.mass, sheet.preload_force) = (Some(1e-14), Some(1e-13)));
    let motor = motor.expect("legal");
    let stator = motor.stator().expect("it yields");
    for drive_frequency in [70e3, 71e3, 80e3, 50e3] {
        let inputs = MotorInputs { drive_frequency, ..MotorInputs::of(&motor) };
        let mut simulation =
            MotorSimulation::new(&motor, inputs, SimulationSettings::default()).expect("legal");
        let omega = TAU * drive_frequency;
        let known = stator.electrical_input_at(omega).and_then(|input| input.current).expect("a capacitance");
        for [amplitude, current] in sampled(&mut simulation, 100) {
            assert!(
                (amplitude / stator.amplitude_at(omega) - 1.0).abs() < 1e-9,
                "{drive_frequency}: {amplitude}"
            );
            assert!((current / known.0 - 1.0).abs() < 1e-9, "{drive_frequency}: {current} {known:?}");
        }
    }
}

/// The amplitude is zero at rest under 100 N, on one mode and on two, under a load that friction balances,
/// and while the rotor coasts.
#[test]
fn a_static_sag_is_no_vibration() {
    let pressed = |motor: &Motor| motor.with(|sheet| sheet.preload_force = Some(100.0)).expect("legal");
    let begun = |motor: &Motor, inputs| {
        MotorSimulation::new(motor, inputs, SimulationSettings::default()).expect("legal")
    };
    let [one, two] = twisting();
    for motor in [in_volts(), one, two].iter().map(pressed) {
        for load_torque in [0.0, 0.5 * motor.largest_torque()] {
            let on = MotorInputs { load_torque, ..MotorInputs::of(&motor) };
            let off = MotorInputs { on: false, ..on };
            let (mut rests, mut runs) = (begun(&motor, off), begun(&motor, on));
            runs.advance(1e-3, &Unobserved).expect("no failure");
            runs.set_inputs(off).expect("legal");
            // Until the modes have rung down.
            runs.advance(1.0, &Unobserved).expect("no failure");
            for simulation in [&mut rests, &mut runs] {
                let sag = simulation.now.engine.state().modes[0][0] * simulation.unit.length;
                assert!(sag < -9e-9, "{sag}");
                for [amplitude, current] in sampled(simulation, 20) {
                    assert!(amplitude < 1e-19 && current < 1e-13, "{amplitude} {current}");
                }
            }
        }
    }
    let heavy = pressed(&twisting()[0]).with(|sheet| sheet.mass = Some(1e3)).expect("legal");
    let pushed =
        MotorInputs { load_torque: -3.0 * heavy.largest_torque(), on: false, ..MotorInputs::of(&heavy) };
    let mut coasts = begun(&heavy, pushed);
    coasts.advance(1.0, &Unobserved).expect("no failure");
    coasts.set_inputs(MotorInputs { load_torque: 0.0, ..pushed }).expect("legal");
    let end = coasts.advance(1.4, &Unobserved).expect("no failure");
    assert!(end.speed > 0.1 && end.amplitude < 1e-19, "{end:?}");
}

/// Least-squares fit of samples at equidistant times in a period: the amplitude of a constant plus a sine.
fn fitted(samples: &[(f64, f64)]) -> f64 {
    let part = |of: fn((f64, f64)) -> f64| {
        2.0 / samples.len() as f64
            * samples.iter().map(|&(phase, value)| value * of(sin_cos(phase))).sum::<f64>()
    };
    hypot(part(|(sin, _)| sin), part(|(_, cos)| cos))
}

/// Under a rotor, amplitude and current agree with a least-squares fit to each period of the motion: to
/// rounding if the rotor lies on the stator, and up to harmonics if it is tapped in each period.
#[test]
fn amplitude_and_current_are_those_of_a_fit_to_the_motion() {
    const SAMPLES: u32 = 64;
    let changed = |change: fn(&mut StatorParameters), preload_force: f64| {
        let motor = in_volts().with(|sheet| {
            sheet.stator.iter_mut().for_each(change);
            sheet.preload_force = Some(preload_force);
        });
        motor.expect("legal")
    };
    let soft = |motor: &Motor, time: f64| {
        motor.with(|sheet| sheet.contact = Some(Contact::lasting(time))).expect("legal")
    };
    let lies = changed(|table| table.volts = Some(0.4), 0.3);
    let sags = changed(|table| (table.quality, table.volts) = (Some(20.0), Some(150.0)), 20.0);
    let motors = [
        (lies.clone(), 1e-9),
        (soft(&lies, 3e-6), 1e-9),
        (soft(&in_volts(), 1e-5), 1e-3),
        (soft(&sags, 1e-5), 1e-3),
    ];
    for (motor, share) in motors {
        for drive_frequency in [70e3, 71e3] {
            let inputs = MotorInputs { drive_frequency, ..MotorInputs::of(&motor) };
            let mut simulation =
                MotorSimulation::new(&motor, inputs, SimulationSettings::default()).expect("legal");
            simulation.advance(0.2, &Unobserved).expect("no failure");
            let circuit = simulation.motor.stator().and_then(|stator| stator.circuit()).expect("in volts");
            let Scales { length, velocity, .. } = simulation.unit;
            let charging = circuit.capacitance.expect("known") * circuit.volts * TAU * drive_frequency;
            for period in 0..16 {
                let (mut heights, mut currents, mut stated) = (Vec::new(), Vec::new(), Vec::new());
                for sample in 0..SAMPLES {
                    let periods = f64::from(period) + f64::from(sample) / f64::from(SAMPLES);
                    let time = 0.2 + periods / drive_frequency;
                    let outputs = simulation.advance(time, &Unobserved).expect("no failure");
                    let at = simulation.at(time);
                    let phase = at.engine.time().phase.angle();
                    let [place, speed] = at.engine.state().modes[0];
                    heights.push((phase, place * length));
                    let charging = charging * sin_cos(phase + circuit.phase).1;
                    currents.push((phase, charging + circuit.force_per_volt * speed * velocity));
                    stated.push([outputs.amplitude, outputs.current.expect("a capacitance")]);
                }
                let fits = [fitted(&heights), fitted(&currents)];
                for (k, fit) in fits.into_iter().enumerate() {
                    let mean = stated.iter().map(|own| own[k]).sum::<f64>() / f64::from(SAMPLES);
                    assert!((mean / fit - 1.0).abs() < share, "{drive_frequency}: {mean} {fit}");
                }
            }
        }
    }
}
