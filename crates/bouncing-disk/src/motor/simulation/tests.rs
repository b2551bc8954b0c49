use bouncing_disk_core::Unobserved;

use super::*;
use crate::motor::{DrivenMotor, OperatingSettings, TransientSettings};
use crate::parameters::contact::Contact;
use crate::parameters::driven_platform::DriveParameters;
use crate::parameters::stator::{StatorKind, StatorParameters};
use crate::testing::in_volts;

fn begun(motor: &Motor) -> Result<MotorSimulation, Error> {
    MotorSimulation::new(motor, MotorInputs::of(motor), SimulationSettings::default())
}

/// The same on one mode that also twists, without the number of its twist, and on two modes.
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

/// Rigid, soft, and on a stator that yields with both; of one mode that twists under a load with a slope, and of two.
fn motors() -> Vec<Motor> {
    let soft =
        |motor: &Motor| motor.with(|sheet| sheet.contact = Some(Contact::lasting(1e-5))).expect("legal");
    let (paper, volts) = (Motor::paper_70_khz(), in_volts());
    let [one, two] = twisting();
    let law = LoadLaw::fan(0.2, 5e-6, 3).expect("legal").with_inertia(1e-8).expect("legal");
    let fan = one.with(|sheet| sheet.load = Some(law)).expect("legal");
    vec![paper, soft(&paper), volts, soft(&volts), fan, two]
}

/// The time of each change, and the inputs from it on.
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

/// The power of the drive, less the losses, over a long time is that of an operating point; so are speed and amplitude.
#[test]
fn long_runs_have_the_means_of_operating_points() {
    for motor in [Motor::paper_70_khz(), in_volts()] {
        let loaded = motor.with(|sheet| sheet.load_torque = 3e-6).expect("legal");
        let settings = OperatingSettings { relative_error: 0.05, ..OperatingSettings::default() };
        let known = crate::motor::operations(&[loaded], &settings, &Unobserved).expect("no failure");
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

/// Under the same schedule of load and drive as a run-up.
#[test]
fn inputs_act_as_the_table_of_a_load() {
    let law = LoadLaw::constant(-1e-5).expect("legal").with_inertia(1e-8).expect("legal");
    let law = law.with_factors(&[0.004], &[2.0]).expect("legal").with_drive(0.0, 0.008).expect("legal");
    let scheduled = in_volts().with(|sheet| sheet.load = Some(law)).expect("legal");
    let settings = TransientSettings { duration: 0.012, intervals: 3, ..TransientSettings::default() };
    let driven =
        DrivenMotor::where_needed(scheduled, &DriveParameters::default()).expect("legal").expect("needed");
    let phase = Phase::new(0.0).expect("finite");
    let (curve, amplitudes) = driven.run_up(phase, &settings, &Unobserved).expect("no failure");
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

/// Under a rotor that weighs next to nothing the circuit takes what it takes without one.
#[test]
fn the_current_is_that_of_the_circuit() {
    let motor = in_volts().with(|sheet| (sheet.mass, sheet.preload_force) = (Some(1e-12), Some(1e-11)));
    let motor = motor.expect("legal");
    let mut simulation = begun(&motor).expect("legal");
    let mut inputs = MotorInputs::of(&motor);
    for frequency in [70e3, 70.1e3, 69.9e3] {
        inputs.drive_frequency = frequency;
        simulation.set_inputs(inputs).expect("legal");
        // Until the ringing of the change is gone.
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
    let refused = |inputs| crate::testing::refused_field(simulation.clone().set_inputs(inputs));
    assert_eq!(refused(MotorInputs { load_torque: f64::NAN, ..good }), "load_torque");
    assert_eq!(refused(MotorInputs { drive: -1.0, ..good }), "stator.volts");
    assert_eq!(refused(MotorInputs { drive_frequency: 0.0, ..good }), "drive_frequency");
    let field = crate::testing::refused_field(simulation.clone().advance(0.0005, &Unobserved).map(|_| ()));
    assert_eq!(field, "time");
    let mut other = simulation.clone();
    assert!(other.set_inputs(MotorInputs { drive: -1.0, ..good }).is_err());
    assert_eq!(other.advance(0.002, &Unobserved), simulation.advance(0.002, &Unobserved));
}

/// A rotor that lies on a stator that is off, and one that a load turns there: nothing happens for a long time.
#[test]
fn a_rest_of_an_hour_costs_little() {
    // A load with a slope is followed.
    let motors = motors().into_iter().filter(|motor| motor.load().is_none());
    for (motor, load_torque) in motors.flat_map(|motor| [(motor, 0.0), (motor, 1e-3)]) {
        let mut simulation = begun(&motor).expect("legal");
        let inputs = MotorInputs { on: false, load_torque, ..MotorInputs::of(&motor) };
        simulation.set_inputs(inputs).expect("legal");
        simulation.advance(1.0, &Unobserved).expect("no failure");
        let start = simulation.advance(3599.0, &Unobserved).expect("no failure");
        let end = simulation.advance(3600.0, &Unobserved).expect("no failure");
        // What friction cannot hold falls evenly.
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

/// On a stator too slow to throw it: friction gives it on average what the load takes, and the drive what that costs.
#[test]
fn a_rotor_that_creeps_has_the_power_of_its_operating_point() {
    let creeping = Motor::paper_70_khz().with(|sheet| {
        (sheet.amplitude, sheet.load_torque, sheet.contact_radius) = (Some(4e-11), 4e-5, 5e-3);
    });
    let creeping = creeping.expect("legal");
    let known = crate::motor::operations(&[creeping], &OperatingSettings::default(), &Unobserved);
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

/// One mode does both: at half of the volts half of the twist, and nothing jumps.
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

/// Switched on from rest, a mode rings up; of a step that takes no time the means are those before.
#[test]
fn a_drive_that_is_off_at_the_start_rings_up() {
    let motor = in_volts();
    let off = MotorInputs { on: false, ..MotorInputs::of(&motor) };
    let mut simulation = MotorSimulation::new(&motor, off, SimulationSettings::default()).expect("legal");
    let start = simulation.advance(0.001, &Unobserved).expect("no failure");
    // The stator sags under the rotor.
    assert!(start.amplitude < 1e-10 && start.impacts == 0 && start.power == 0.0, "{start:?}");
    simulation.set_inputs(MotorInputs::of(&motor)).expect("legal");
    let early = simulation.advance(0.0015, &Unobserved).expect("no failure");
    let late = simulation.advance(0.03, &Unobserved).expect("no failure");
    assert!(early.amplitude < 0.5 * late.amplitude && late.power > 0.0, "{early:?} {late:?}");
    let again = simulation.advance(0.03, &Unobserved).expect("no failure");
    assert_eq!((again.power, again.shaft_torque), (late.power, late.shaft_torque));
}
