use bouncing_disk_core::Unobserved;

use super::quantity::SweepQuantity;
use super::*;
use crate::motor::{MAX_SWEEP_CELLS, MotorSweepResult, OperatingRow, operations};
use crate::testing::{check_stops, refused};

/// Low accuracy, so that many cases can be tested.
fn rough() -> OperatingSettings {
    OperatingSettings {
        relative_error: 0.2,
        members: 4,
        most_impacts: 100_000,
        ..OperatingSettings::default()
    }
}

fn axis(parameter: MotorField, values: &[f64]) -> SweepAxis {
    SweepAxis::new(parameter, values.to_vec())
}

fn sweep(axes: &[SweepAxis]) -> Result<MotorSweep, Error> {
    MotorSweep::new(Motor::paper_70_khz(), axes.to_vec(), rough())
}

fn result(axes: &[SweepAxis]) -> MotorSweepResult {
    sweep(axes).and_then(|sweep| sweep.run(&Unobserved)).expect("no failure")
}

/// Shares of the largest torque; the last two overpower the motor.
fn loads(shares: &[f64]) -> SweepAxis {
    let largest = Motor::paper_70_khz().largest_torque();
    SweepAxis::new(MotorField::LoadTorque, shares.iter().map(|share| share * largest).collect())
}

/// Six groups, one of them with a motor that never bounces; all states except a drift occur.
fn mixed() -> MotorSweep {
    let amplitudes = [1e-8, 0.0, 1.5e-8, 1e-8, 2e-8, 4e-11, 3e-8];
    sweep(&[axis(MotorField::Amplitude, &amplitudes), loads(&[0.0, 0.5, 1.2])]).expect("legal")
}

/// Each row of a map of amplitude and load is the torque-speed curve at its amplitude, whichever of the two
/// axes is the load.
#[test]
fn the_rows_of_a_map_are_curves() {
    let (amplitudes, shares) = ([1e-8, 1.7e-8], [0.0, 0.3, 0.6, -0.2, 1.1]);
    let load = loads(&shares);
    let by_rows = result(&[axis(MotorField::Amplitude, &amplitudes), load.clone()]);
    let by_columns = result(&[load.clone(), axis(MotorField::Amplitude, &amplitudes)]);
    assert_eq!((by_rows.rows().count(), by_columns.rows().count()), (2, 5));
    for (row, amplitude) in amplitudes.into_iter().enumerate() {
        let motor = Motor::paper_70_khz().with(|sheet| sheet.amplitude = Some(amplitude)).expect("legal");
        let curve = motor.torque_speed_curve(&load.values, &rough(), &Unobserved).expect("no failure");
        assert_eq!(by_rows.rows().nth(row), Some(&curve[..]));
        let column: Vec<OperatingRow> = by_columns.rows().map(|cells| cells[row].clone()).collect();
        assert_eq!(column, curve);
    }
    assert_ne!(by_rows.cells()[0], by_rows.cells()[5]);
    let speeds = by_rows.matrix(SweepQuantity::Speed);
    assert_eq!(speeds[1][4], None);
    let matrix = by_columns.matrix(SweepQuantity::Speed);
    for (row, speeds) in speeds.iter().enumerate() {
        for (column, speed) in speeds.iter().enumerate() {
            assert_eq!(matrix[column][row].map(f64::to_bits), speed.map(f64::to_bits));
        }
    }
}

/// If all motors share one motion, a map is computed by a single call.
#[test]
fn a_map_of_one_motion_is_one_group() {
    let axes = [axis(MotorField::PhaseLag, &[0.0, 0.4, 3.5]), axis(MotorField::Friction, &[0.05, 0.1, 0.0])];
    let sweep = sweep(&axes).expect("legal");
    assert_eq!(sweep.groups(), [(0..9).collect::<Vec<_>>()]);
    let motors: Vec<Motor> = (0..9).map(|cell| sweep.motor_of(cell).expect("legal")).collect();
    let (fifth, last) = (motors[5].parameters(), motors[8].parameters());
    assert_eq!((fifth.phase_lag, fifth.friction, last.phase_lag, last.friction), (0.4, 0.0, 3.5, 0.0));
    let result = sweep.run(&Unobserved).expect("no failure");
    assert_eq!(result.cells(), operations(&motors, &rough(), &Unobserved).expect("no failure"));
    for ((values, _), motor) in result.iter().zip(&motors) {
        let sheet = motor.parameters();
        assert_eq!(values, [(MotorField::PhaseLag, sheet.phase_lag), (MotorField::Friction, sheet.friction)]);
    }
    refused("cell of a sweep", [9], |cell| sweep.motor_of(cell));
}

#[test]
fn values_may_be_few_alike_unsorted_and_extreme() {
    let one = result(&[axis(MotorField::Amplitude, &[1e-8])]);
    assert_eq!((one.cells().len(), one.matrix(SweepQuantity::Efficiency).len()), (1, 1));
    let alone = Motor::paper_70_khz().operating_point(0.0, &rough(), &Unobserved).expect("no failure");
    assert_eq!(one.cells(), std::slice::from_ref(&alone));
    let values = [2e-8, 1e-8, 2e-8, 0.0, -0.0, 5e-324];
    let many = result(&[axis(MotorField::Amplitude, &values)]);
    assert_eq!(many.cells()[0], many.cells()[2]);
    assert_eq!(many.cells()[1], alone);
    assert!(many.matrix(SweepQuantity::Speed).iter().flatten().all(Option::is_some));
    // The sign of zero does not make another motion.
    assert_eq!(many.cells()[3], many.cells()[4]);
}

#[test]
fn axes_that_are_none_are_refused_with_the_reason() {
    use MotorField::*;
    let of = |axes: Vec<SweepAxis>| sweep(&axes);
    let axes = [Friction, PhaseLag, Restitution].map(|field| axis(field, &[0.1]));
    refused("number of axes of a sweep", [0, 3], |count| sweep(&axes[..count]));
    refused(Error::EmptyAxis { parameter: "mass" }, [vec![axis(Mass, &[])]], of);
    let second = vec![axis(Mass, &[1.0]), axis(Friction, &[])];
    refused(Error::EmptyAxis { parameter: "friction" }, [second], of);
    let twice = vec![axis(Mass, &[1.0]), axis(Mass, &[2.0])];
    refused(Error::RepeatedAxis { parameter: "mass" }, [twice], of);
    let ones = |(one, other)| vec![axis(one, &[1.0]), axis(other, &[1.0])];
    for (one, other) in
        [(PreloadForce, PreloadAcceleration), (TwistAmplitude, PeakAngularSpeed), (Mass, Density)]
    {
        for (one, other) in [(one, other), (other, one)] {
            refused(Error::BothGiven { one: one.name(), other: other.name() }, [ones((one, other))], of);
        }
    }
    let both = Error::BothGiven { one: "rotor_thickness", other: "mass" };
    refused(both, [ones((RotorThickness, Mass))], of);
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    refused("load_torque", bad, |value| sweep(&[axis(LoadTorque, &[0.0, value])]));
    for (field, value, told) in [
        (Friction, -0.1, "friction = -0.1 is"),
        (Restitution, 1.0, "restitution = 1 is"),
        (PreloadForce, 0.0, "preload_force = 0 is"),
        (Mass, -1e-3, "mass = -0.001 is"),
    ] {
        refused(told, [vec![axis(PhaseLag, &[0.0, 1.0]), axis(field, &[0.2, value])]], of);
    }
    // Additional values that a value needs are named, too.
    refused(Error::NotGiven { field: "rotor_radius" }, [vec![axis(Density, &[7850.0])]], of);
    refused("members", [OperatingSettings { members: 1, ..rough() }], |settings| {
        MotorSweep::new(Motor::paper_70_khz(), vec![axis(Friction, &[0.1])], settings)
    });
}

#[test]
fn there_may_be_so_many_cells_and_no_more() {
    let values = vec![0.1; MAX_SWEEP_CELLS];
    let many = sweep(&[axis(MotorField::PhaseLag, &values)]).expect("just as many as there may be");
    assert_eq!(many.groups().len(), MAX_SWEEP_CELLS.div_ceil(256));
    let too_many = |axes: &[SweepAxis], cells: u64| {
        let (what, limit) = ("cells of a sweep", MAX_SWEEP_CELLS as u64);
        let error = bouncing_disk_core::Error::TooLarge { what, count: cells, limit };
        assert_eq!(sweep(axes), Err(Error::Core(error)));
    };
    let one_more: Vec<f64> = values.iter().copied().chain([0.1]).collect();
    too_many(&[axis(MotorField::PhaseLag, &one_more)], 100_001);
    too_many(&[axis(MotorField::PhaseLag, &values), axis(MotorField::Friction, &values)], 10_000_000_000);
}

#[test]
fn an_alternative_takes_the_place_of_the_other_one() {
    let motor = Motor::paper_70_khz();
    let force = motor.preload_force();
    let sweep = sweep(&[axis(MotorField::PreloadForce, &[force, 2.0 * force])]).expect("legal");
    assert_eq!(sweep.replaced(), [MotorField::PreloadAcceleration]);
    let second = sweep.motor_of(1).expect("legal");
    assert_eq!(second.parameters().preload_acceleration, None);
    assert!((second.preload_acceleration() / motor.preload_acceleration() - 2.0).abs() < 1e-15);
    // The motor itself is unchanged, and a field that it already has is not replaced.
    assert_eq!(*sweep.motor(), motor);
    let own = MotorSweep::new(motor, vec![axis(MotorField::PreloadAcceleration, &[9.8])], rough());
    assert_eq!(own.expect("legal").replaced(), []);
}

#[test]
fn threads_change_no_bit_and_a_stop_is_told() {
    let sweep = mixed();
    assert_eq!(sweep.groups().len(), 6);
    let (_, done) = check_stops(21, |observer| sweep.run(observer));
    assert!(done.iter().any(|&done| 0 < done && done < 21), "{done:?}");
}

/// A motor whose flights are too long to be followed does not affect others.
#[test]
fn a_group_that_fails_leaves_the_others() {
    let motor = Motor::paper_70_khz().with(|sheet| sheet.restitution = 0.99).expect("legal");
    let axes = vec![axis(MotorField::Amplitude, &[1e-8, 5e-3, 2e-8, 4.9e-3])];
    let sweep = MotorSweep::new(motor, axes, rough()).expect("legal");
    let alone =
        |cell: usize| sweep.motor_of(cell).expect("legal").operating_point(0.0, &rough(), &Unobserved);
    let failure = alone(1).expect_err("too violent");
    let too_long =
        |error: &Error| matches!(error, Error::Core(bouncing_disk_core::Error::FlightTooLong { .. }));
    assert!(too_long(&failure), "{failure}");
    assert!(alone(3).is_err_and(|error| too_long(&error) && error != failure));
    let groups = [0, 1, 2, 3].map(|group| sweep.operations(group, &Unobserved).ok());
    assert_eq!(groups, [0, 1, 2, 3].map(|cell| alone(cell).ok().map(|own| vec![own])));
    assert_eq!(sweep.run(&Unobserved), Err(failure));
}

#[test]
fn the_operations_of_another_sweep_are_refused() {
    let sweep = sweep(&[axis(MotorField::Friction, &[0.1])]).expect("legal");
    let groups = vec![sweep.operations(0, &Unobserved).expect("turns")];
    assert_eq!(sweep.result(&groups), sweep.run(&Unobserved));
    let unfitting =
        |what, found, expected| Error::Core(bouncing_disk_core::Error::Unfitting { what, found, expected });
    assert_eq!(sweep.result(&[]), Err(unfitting("groups of a sweep", 0, 1)));
    assert_eq!(sweep.result(&[Vec::new()]), Err(unfitting("cells of a group of a sweep", 0, 1)));
}

/// While the preload rises and falls, a hard rotor on a heavy stator keeps its motion (tapped once per
/// period, or at rest) where both motions are steady. A single point from rest agrees with the way down; from
/// a launch, the engine keeps the taps.
#[test]
fn a_continued_sweep_keeps_what_the_rotor_does() {
    use crate::driven::DrivenStart;
    use crate::motion::event::SteeredMotion;
    use crate::parameters::StatorParameters;
    use crate::stator::{StatorEngine, StatorSystem};
    use bouncing_disk_core::Phase;

    let plain = Motor::paper_70_khz();
    let quality = 30.0;
    let table = StatorParameters {
        mass: Some(5.0 * quality * plain.mass()),
        quality: Some(quality),
        ..StatorParameters::default()
    };
    let motor = plain.with(|sheet| (sheet.stator, sheet.restitution) = (Some(table), 0.9)).expect("legal");
    let omega = plain.system().platform().angular_frequency();
    let preloads = [2.0, 1.5, 1.2, 0.95, 0.85, 0.7, 0.5, 0.7, 0.95].map(|peak| 1e-8 * omega * omega / peak);
    let settings = OperatingSettings {
        relative_error: 0.02,
        members: 8,
        most_impacts: 40_000,
        ..OperatingSettings::default()
    };
    let field = MotorField::PreloadAcceleration;
    let sweep = MotorSweep::new(motor.clone(), vec![SweepAxis::new(field, preloads.to_vec())], settings);
    let sweep = sweep.and_then(MotorSweep::continued).expect("legal");
    assert_eq!(sweep.groups(), [[0, 1, 2, 3, 4, 5, 6, 7, 8]]);
    let found = sweep.run(&Unobserved).expect("no failure");
    let point = |cell: usize| *found.cells()[cell].point().expect("no runaway");
    for (up, down) in [(3, 8), (5, 7)] {
        let (up, down) = (point(up), point(down));
        let apart = up.speed.value - down.speed.value;
        assert!(apart > 4.0 * (up.speed.standard_error + down.speed.standard_error), "{up:?} {down:?}");
        let amplitudes = [up, down].map(|point| point.stator.expect("it yields").amplitude.value / 1e-8);
        assert!(amplitudes[0] < 0.9 && amplitudes[1] > 0.95, "{amplitudes:?}");
        assert!(up.energy_residual < 1e-9 && down.energy_residual < 1e-9);
    }
    // From rest.
    let pressed = sweep.motor_of(5).expect("legal");
    let alone = pressed.torque_speed_curve(&[0.0], &settings, &Unobserved).expect("no failure");
    let (alone, down) = (alone[0].point().expect("no runaway").speed, point(7).speed);
    assert!((alone.value - down.value).abs() < 0.02 * down.value, "{alone:?} {down:?}");
    // From a launch at the speed with which a rotor returns after a period.
    let system = StatorSystem::of_system(pressed.system(), pressed.mass()).expect("legal");
    let start = |phase: f64| DrivenStart::Launch {
        phase: Phase::new(phase).expect("finite"),
        relative_speed: std::f64::consts::TAU * 0.9 / 1.9,
        angular_speed: 0.0,
    };
    let taps = (0..20).any(|k| {
        let mut engine = StatorEngine::new(system.clone(), start(0.1 * f64::from(k))).expect("legal");
        let mut last = 0.0;
        for _ in 0..3_000 {
            let Some(record) = engine.advance_within(100.0).expect("no failure") else { return false };
            last = record.span.radians();
        }
        let amplitude =
            engine.amplitude_after(0.0).expect("it moves in height") * pressed.system().scales().length;
        let known = point(5).stator.expect("it yields").amplitude.value;
        (last / std::f64::consts::TAU - 1.0).abs() < 1e-3 && (amplitude / known - 1.0).abs() < 0.1
    });
    assert!(taps, "no launch leads to taps");
    // Two axes, and a rigid stator.
    let two = vec![SweepAxis::new(field, vec![1.0]), SweepAxis::new(MotorField::Friction, vec![0.1])];
    assert!(MotorSweep::new(motor, two, settings).and_then(MotorSweep::continued).is_err());
    let prescribed = MotorSweep::new(plain, vec![SweepAxis::new(field, vec![1.0])], settings);
    assert!(matches!(prescribed.and_then(MotorSweep::continued), Err(Error::NotGiven { .. })));
}
