//! Steady runs: energies, limits, shortfalls, and the validity of the stated errors.
//!
//! Coverage: of 100 ensembles with other seeds (16 members and 1 % unless stated), the number whose 95 %
//! intervals contain the mean of three long ensembles (64 members, 0.2 %), whose own error is added. The
//! scatter and the stated error are in rad/s; the load is divided by the largest torque.
//!
//! | motor | load | scatter | stated | hold |
//! | --- | --- | --- | --- | --- |
//! | Table III | 0 | 0.054 | 0.067 | 97 |
//! | | 0.5 | 0.037 | 0.047 | 98 |
//! | | 0.5, 4 members, 5 % | 0.156 | 0.193 | 94 |
//! | | 0.8, driven back | 0.055 | 0.062 | 92 |
//! | lag 0.5, forcing 3 | 0.5 | 0.078 | 0.123 | 100 |
//! | 40 kHz, 0.5 um, 5 N, 12 rad/s, lag 30 degrees | 0.5 | 0.055 | 0.054 | 92 |
//! | | 0.8 | 0.069 | 0.059 | 91 |
//!
//! For stall loads, the numbers at 40 kHz, compared with four runs of 64 members at 0.2 %, are 99 of 100 at 5
//! %, 95 at 2 % and 92 at 1 %. For Table III at 5 %, compared with three runs at 0.3 %, the number is 39 of 40.

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::numerics::elementary::{exp, hypot};
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::numerics::statistics::{NORMAL_975, mean};
use bouncing_disk_core::{ChatterPolicy, Phase, Unobserved};

use super::*;
use crate::estimate::{Spread, TransientEnsemble};
use crate::motion::EnergyLedger;
use crate::motor::tape::taped::Taped;
use crate::motor::{Estimate, TransientSettings};
use crate::testing::{check_stops, motor, refused, tried_motor};
use crate::{Engine, InitialCondition, Motor};

/// Mass of the rotor (kg); its value does not matter.
const MASS: f64 = 0.02;

/// This motor under a share of the largest mean torque of friction.
fn loaded(system: &System, share: f64) -> LoadedMotor<'static> {
    let unloaded = LoadedMotor::on_sine(*system, MASS, 0.0);
    unloaded.with_load(share * unloaded.largest_torque()).expect("legal")
}

fn operated(motors: &[LoadedMotor<'_>], settings: &OperatingSettings) -> Vec<Operation> {
    operate(motors, settings, &Unobserved)
        .expect("no failure")
        .rows
        .into_iter()
        .map(|row| *row.operation())
        .collect()
}

/// Over whole runs the energy supplied equals the sum of the work done, the losses and the stored energy. The
/// cases are loads that brake, that drive, and that nearly cause a runaway, on platforms of every strength,
/// with and without twist, friction and rebound.
#[test]
fn energy_is_balanced() {
    let settings = OperatingSettings {
        relative_error: 0.1,
        members: 4,
        most_impacts: 200_000,
        ..OperatingSettings::default()
    };
    let of = |amplitude: f64, restitution: f64| {
        motor(amplitude, 0.0).with_disk(|rotor| rotor.restitution = restitution).expect("legal")
    };
    let usual = System::motor().disk().restitution();
    for system in
        [of(1e-8, usual), tried_motor(), of(6e-11, usual), of(1e-12, usual), of(1e-8, 0.0), of(1e-8, 0.9)]
    {
        let mut motors: Vec<LoadedMotor<'_>> =
            [0.0, 0.3, 0.95, -0.4].iter().map(|&share| loaded(&system, share)).collect();
        let still = system.with_platform(|stator| stator.twist_amplitude = 0.0).expect("legal");
        motors.push(loaded(&still, 0.1));
        let slippery = system.with_disk(|rotor| rotor.friction = 0.0).expect("legal");
        motors.push(loaded(&slippery, 0.0));
        for operation in operated(&motors, &settings) {
            let point = operation.point().expect("none runs away");
            // Each impact, or event of a contact, rounds the energy of the rotor once, in the worst case
            // always in the same direction.
            let events = point.impacts.max(50_000);
            let rounding = events as f64 * f64::EPSILON;
            assert!(point.energy_residual < rounding, "{operation:?}");
            if operation.steady().is_some() {
                // The same holds for the means, apart from the energy that the disk has stored meanwhile.
                let put_in = point.input_power.value + point.perturbation_power;
                let out =
                    point.mechanical_power.value + point.restitution_loss.value + point.friction_loss.value;
                let size = put_in.abs().max(point.mechanical_power.value.abs());
                assert!((put_in - out).abs() <= 0.02 * size + 1e-20, "{operation:?}");
            }
            let power = point.load_torque * point.speed.value;
            assert!((point.mechanical_power.value - power).abs() <= 1e-9 * power.abs(), "{operation:?}");
        }
    }
}

/// Half a turn of lag reverses the motor, as if it were seen from below.
#[test]
fn half_a_circle_of_lag_turns_the_motor_round() {
    let settings = OperatingSettings { relative_error: 0.1, members: 4, ..OperatingSettings::default() };
    for base in [motor(1e-8, 0.0), tried_motor()] {
        for share in [0.0, 0.35] {
            let at = |lag: f64, share: f64| {
                loaded(&base.with_platform(|stator| stator.phase_lag = lag).expect("legal"), share)
            };
            let motors: Vec<LoadedMotor<'_>> =
                [0.0, 0.7, 2.0].iter().flat_map(|&lag| [at(lag, share), at(lag + PI, -share)]).collect();
            for pair in operated(&motors, &settings).chunks(2) {
                let speed = |index: usize| pair[index].point().expect("none runs away").speed.value;
                let scale = base.platform().peak_angular_speed();
                assert!((speed(0) + speed(1)).abs() < 1e-9 * scale, "{} {}", speed(0), speed(1));
            }
        }
    }
}

/// The mean torque of friction is at most mu m g a_e: a larger load runs away, to the last bit.
#[test]
fn a_load_above_the_largest_torque_of_friction_runs_away() {
    let settings = OperatingSettings { relative_error: 0.5, members: 4, ..OperatingSettings::default() };
    let base = tried_motor();
    let exact = |load: f64| {
        let scale = base.scales().angular_acceleration;
        let system = base.with_disk(|rotor| rotor.load_acceleration = load * scale).expect("legal");
        LoadedMotor::on_sine(system, MASS, f64::NAN)
    };
    let friction = base.dimensionless().friction();
    for load in [friction, 1.5 * friction, -friction, -2.0 * friction, 1e6] {
        let mut motor = exact(load);
        // Conversion of units may round the load below the friction.
        if motor.load().abs() < friction {
            motor = exact(load * (1.0 + 2.0 * f64::EPSILON));
        }
        let all = operated(&[loaded(&base, 0.1), motor], &settings);
        assert!(all[0].point().is_some());
        let Operation::Runaway { acceleration, .. } = all[1] else { panic!("{:?}", all[1]) };
        let expected = -(load.abs() - friction).copysign(load) * base.scales().angular_acceleration;
        assert!(
            (acceleration - expected).abs() <= 1e-12 * expected.abs().max(1.0),
            "{acceleration} {expected}"
        );
    }
    assert!(operated(&[exact(friction * 0.999)], &settings)[0].point().is_some());
    // Torques in N m are rounded: the largest one runs away, whatever its preload was computed from.
    for newtons in [1.0, 3.0, 5.0, 7.0, 10.0, 17.3] {
        let sheet = Motor::paper_70_khz().with(|sheet| {
            (sheet.preload_acceleration, sheet.preload_force) = (None, Some(newtons));
            (sheet.contact_radius, sheet.friction) = (0.0125, 0.1);
        });
        let sheet = sheet.expect("legal");
        for torque in [sheet.largest_torque(), newtons * 0.1 * 0.0125, 0.1 * (0.0125 * newtons)] {
            let operation = sheet.operating_point(torque, &settings, &Unobserved).expect("no failure");
            assert!(matches!(operation.operation(), Operation::Runaway { .. }), "{newtons} {operation:?}");
        }
    }
    // A rotor that nothing holds or drives stands exactly still. The least load runs away with it.
    let slippery = base.with_disk(|rotor| rotor.friction = 0.0).expect("legal");
    let still = LoadedMotor::on_sine(slippery, MASS, 0.0);
    let point = *operated(&[still], &settings)[0].steady().expect("steady");
    assert_eq!(point.speed, Estimate { value: 0.0, standard_error: 0.0 });
    let pushed = still.with_load(1e-12).expect("legal");
    assert!(matches!(operated(&[pushed], &settings)[0], Operation::Runaway { .. }));
}

/// The engine without perturbation locks to a cycle selected by rounding, with a perfect energy balance,
/// which a new user took for the motor's speed.
#[test]
fn the_cycle_of_the_rounding_is_not_mistaken_for_the_motor() {
    let settings = OperatingSettings::default();
    let motor = loaded(&tried_motor(), 0.2);
    let operation = operated(&[motor], &settings)[0];
    let point = operation.steady().expect("steady");
    let start = InitialCondition::Contact { phase: Phase::new(1.0).expect("finite"), angular_speed: 0.0 };
    let mut engine = Engine::new(motor.system, start, ChatterPolicy::Complete).expect("legal");
    let (mut ledger, mut begun) = (EnergyLedger::default(), None);
    for event in 0..60_000 {
        let record = engine.advance().expect("no failure").expect("it goes on");
        if event >= 20_000 {
            ledger += record.ledger;
            begun.get_or_insert((record.time, record.after.angle));
        }
    }
    let (time, angle) = begun.expect("it has begun");
    let units = motor.system.scales();
    let mean = (engine.state().angle - angle) / engine.time().since(&time).radians() * units.angular_speed;
    // 8.4 rad/s instead of 5.7, and no warning in its energies.
    assert!(ledger.relative_closure() < 1e-12);
    assert!((mean - point.speed.value).abs() > 20.0 * point.speed.standard_error, "{mean} {point:?}");
    assert!(point.speed.standard_error <= 0.01 * 8.0, "{point:?}");
    assert!(point.perturbation_power < 1e-6 * point.input_power.value, "{point:?}");
    let zero = OperatingSettings { relaunch_perturbation: 0.0, ..settings };
    refused("relaunch_perturbation", [zero], |zero| operate(&[motor], &zero, &Unobserved).map(|_| ()));
    // Ten times more or less perturbation, or other seeds, give the same within the errors, which are errors
    // of the mean.
    let mut deviations = Vec::new();
    for (relaunch_perturbation, seed) in [(1e-2, 1), (1e-4, 1), (1e-3, 2), (1e-3, 300), (1e-3, 4000)] {
        let other = OperatingSettings { relaunch_perturbation, seed, ..settings };
        let other = *operated(&[motor], &other)[0].point().expect("no runaway");
        let (one, another) = (other.speed.standard_error, point.speed.standard_error);
        let error = (one * one + another * another).sqrt();
        deviations.push((other.speed.value - point.speed.value) / error);
    }
    assert!(deviations.iter().all(|deviation| deviation.abs() < 4.0), "{deviations:?}");
}

/// The no-load end of the curve is the speed to which the transients rise.
#[test]
fn the_speed_without_load_is_that_of_the_transients() {
    let system = motor(1e-8, 0.0);
    let point =
        *operated(&[loaded(&system, 0.0)], &OperatingSettings::default())[0].steady().expect("steady");
    let long = TransientSettings { duration: 100.0, intervals: 100, ..TransientSettings::default() };
    let runs = TransientEnsemble::new(&system, &long, 16, &Unobserved).expect("no failure");
    let means: Vec<f64> = runs.curves.iter().map(|curve| curve.mean_over_last(0.7).expect("legal")).collect();
    let transient = Spread::of(&means).expect("finite");
    let (one, another) = (point.speed.standard_error, transient.standard_error);
    let error = (one * one + another * another).sqrt();
    let difference = point.speed.value - transient.mean;
    assert!(difference.abs() < 4.0 * error, "{point:?} {transient:?}");
    assert!(error < 0.01 * point.speed.value, "{error}");
}

#[test]
fn a_spent_budget_is_said() {
    let system = motor(1e-8, 0.0);
    let motor = loaded(&system, 0.2);
    let settings =
        OperatingSettings { relative_error: 1e-4, most_impacts: 1_000_000, ..OperatingSettings::default() };
    let operation = operated(&[motor], &settings)[0];
    let Operation::Unsettled(point, Shortfall::Error { standard_error, wanted }) = operation else {
        panic!("{operation:?}")
    };
    assert!(standard_error > wanted && (wanted / 21.4e-4 - 1.0).abs() < 0.05, "{operation:?}");
    // Windows are judged as if they were equally long, which they are up to one event.
    assert!((standard_error - point.speed.standard_error).abs() <= 0.01 * standard_error);
    assert_eq!(operation.steady(), None);
    assert_eq!(operation.point(), Some(&point));
    // If the load drives a rotor back faster than it turns without one, the error is a share of its own
    // speed.
    let motor = loaded(&system, 0.97);
    let operation = operated(&[motor], &OperatingSettings { members: 4, ..settings })[0];
    let Operation::Unsettled(point, Shortfall::Error { wanted, .. }) = operation else {
        panic!("{operation:?}")
    };
    assert!(point.speed.value < -25.0, "{point:?}");
    assert!((wanted / (1e-4 * point.speed.value.abs()) - 1.0).abs() < 0.05, "{operation:?}");
}

#[test]
fn operations_are_the_same_for_any_number_of_threads_and_can_be_stopped() {
    let motors: Vec<LoadedMotor<'_>> = (0..9).map(|k| loaded(&tried_motor(), 0.1 * f64::from(k))).collect();
    let settings = OperatingSettings { relative_error: 0.03, members: 5, ..OperatingSettings::default() };
    check_stops(20_000_000, |observer| operate(&motors, &settings, observer).map(|all| all.rows));
}

#[test]
fn illegal_settings_are_named() {
    let motors = [loaded(&tried_motor(), 0.1)];
    let usual = OperatingSettings::default();
    let with = |settings| operate(&motors, &settings, &Unobserved).map(|_| ());
    refused("relative_error", [0.0, f64::NAN], |relative_error| {
        with(OperatingSettings { relative_error, ..usual })
    });
    refused("members", [3, usize::MAX], |members| with(OperatingSettings { members, ..usual }));
    refused("most_impacts", [0], |most_impacts| with(OperatingSettings { most_impacts, ..usual }));
    refused("relaunch_perturbation", [-1.0, f64::NAN], |relaunch_perturbation| {
        with(OperatingSettings { relaunch_perturbation, ..usual })
    });
    let of = |motors: &[LoadedMotor<'_>]| operate(motors, &usual, &Unobserved).map(|_| ());
    refused("number of rotors", [()], |()| of(&[]));
    let many = vec![motors[0]; MAX_OPERATED_ROTORS / 16 + 1];
    let error = of(&many).expect_err("too many");
    assert!(matches!(error, Error::Core(bouncing_disk_core::Error::TooLarge { .. })), "{error}");
    refused("mass", [LoadedMotor { mass: 0.0, ..motors[0] }], |massless| of(&[massless]));
    let error = of(&[motors[0], loaded(&motor(1e-8, 0.0), 0.1)]).expect_err("not shared");
    assert!(matches!(error, Error::NotShared { .. }), "{error}");
}

/// If the platform hardly falls away, or the disk never comes to rest, the result is a number with its error,
/// or a shortfall.
#[test]
fn platforms_of_every_strength_are_judged() {
    let settings = OperatingSettings {
        relative_error: 0.2,
        members: 4,
        most_impacts: 50_000,
        ..OperatingSettings::default()
    };
    let base = System::motor();
    let unit = base.platform().amplitude() / base.peak_acceleration();
    for peak in [0.0, 0.5, 1.0, 1.0 + 1e-15, 1.0 + 1e-6, 1.5, 3.3, 100.0, 1e4] {
        for restitution in [0.0, 0.3, 0.99] {
            let system = base
                .with_platform(|stator| stator.amplitude = peak * unit)
                .and_then(|motor| motor.with_disk(|rotor| rotor.restitution = restitution))
                .expect("legal");
            for operation in operated(&[loaded(&system, 0.0), loaded(&system, 0.4)], &settings) {
                let point = operation.point().expect("none runs away");
                let platform = base.platform().peak_angular_speed();
                assert!(point.speed.value.abs() <= 1.5 * platform, "{peak} {restitution} {point:?}");
                assert!(point.energy_residual < 1e-9, "{peak} {restitution} {point:?}");
            }
        }
    }
}

mod searches {
    use super::*;
    use crate::motor::operation::stall_load::stall_load;

    /// Under the stall load the motor stands still; under slightly less it turns, and under slightly more it
    /// is driven back. The paper's estimate from the transient is another number.
    #[test]
    fn the_stall_load_is_bracketed_by_what_turns_and_what_does_not() {
        let settings = OperatingSettings::default();
        for (system, sign) in [(motor(1e-8, 0.0), 1.0), (tried_motor(), 1.0), (tried_motor(), -1.0)] {
            let turned = if sign > 0.0 { 0.0 } else { PI };
            let motor =
                loaded(&system.with_platform(|stator| stator.phase_lag += turned).expect("legal"), 0.0);
            let stall = stall_load(&motor, &settings, &Unobserved).expect("it turns");
            assert!(sign * stall.torque.value > 0.0, "{stall:?}");
            assert!((stall.share * motor.largest_torque() / stall.torque.value - 1.0).abs() < 1e-12);
            // With the members that found it the speed there vanishes: their noise is the same, and only the
            // lengths of the runs and the curvature of the speed between the ends differ. Two runs of which
            // one is the first half of the other differ by 0.7 of the error of the shorter one in the root
            // mean square.
            let [low, high] = stall.bracket;
            let loads = [low, stall.torque.value, high];
            let motors: Vec<LoadedMotor<'_>> =
                loads.iter().map(|&load| motor.with_load(load).expect("legal")).collect();
            let same = operated(&motors, &settings);
            let speed = |index: usize| same[index].point().expect("no runaway").speed.value;
            let slope = (speed(2) - speed(0)) / (high - low);
            let off = speed(1) / slope;
            assert!(off.abs() < 2.0 * stall.torque.standard_error, "{stall:?} is off by {off}");
            // The speeds are known to 1 % of the no-load speed, plus the effect of the perturbation.
            assert!(stall.torque.standard_error < 2e-2 * stall.torque.value.abs(), "{stall:?}");
            // Other members than those that found it.
            let others = OperatingSettings { seed: 77, ..settings };
            let all = operated(&motors, &others);
            let speed = |index: usize| all[index].point().expect("no runaway").speed;
            assert!(sign * speed(0).value > 0.0 && sign * speed(2).value < 0.0, "{stall:?} {all:?}");
            let slope = (speed(2).value - speed(0).value) / (high - low);
            let uncertain = speed(1).standard_error + (slope * stall.torque.standard_error).abs();
            assert!(speed(1).value.abs() < 4.0 * uncertain, "{stall:?} {:?}", speed(1));
            // The same from both sides.
            let from = |index: usize| loads[index] - speed(index).value / slope;
            let error = stall.torque.standard_error + (speed(0).standard_error / slope).abs();
            assert!((from(0) - from(2)).abs() < 4.0 * error, "{stall:?} {} {}", from(0), from(2));
        }
    }

    /// A motor at 1 nm has so many small impacts that the allowed number does not suffice to complete the
    /// start-up. The loads at which its speeds appeared to vanish once had stated errors of a ten-thousandth.
    #[test]
    fn a_stall_is_refused_where_speeds_still_drift() {
        let motor = loaded(&motor(1e-9, 0.0), 0.0);
        let settings = OperatingSettings { most_impacts: 100_000, ..OperatingSettings::default() };
        let error = stall_load(&motor, &settings, &Unobserved).expect_err("it drifts");
        assert!(matches!(error, Error::NotSettled { .. }), "{error}");
    }

    #[test]
    fn a_motor_that_does_not_turn_has_no_stall() {
        let settings =
            OperatingSettings { members: 4, most_impacts: 300_000, ..OperatingSettings::default() };
        let still = tried_motor().with_platform(|stator| stator.twist_amplitude = 0.0).expect("legal");
        let slippery = tried_motor().with_disk(|rotor| rotor.friction = 0.0).expect("legal");
        for system in [still, slippery] {
            let motor = LoadedMotor::on_sine(system, MASS, 0.0);
            let error = stall_load(&motor, &settings, &Unobserved).expect_err("it does not turn");
            assert!(matches!(error, Error::DoesNotTurn { .. }), "{error}");
        }
    }
}

/// However loose the requested error, the stated error is true: the speeds differ from those of long runs
/// with other seeds by no more than both errors allow. A start-up that was taken for a steady state once made
/// the speeds wrong by five errors.
#[test]
fn stated_errors_hold_where_loose_ones_are_asked_for() {
    let mut random = SplitMix64::new(7);
    let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
    let mut squares = Vec::new();
    for seed in 0..8 {
        let system = motor(1e-8 * between(0.5, 3.5), 0.0)
            .with_disk(|rotor| {
                rotor.restitution = between(0.1, 0.7);
                rotor.friction = between(0.05, 0.45);
            })
            .and_then(|motor| motor.with_platform(|stator| stator.phase_lag = between(-1.2, 1.2)))
            .expect("legal");
        let share = if seed % 3 == 0 { 0.3 } else { 0.0 };
        let speed = |relative_error: f64, seed: u64| {
            let settings = OperatingSettings { relative_error, seed, ..OperatingSettings::default() };
            let operation = operated(&[loaded(&system, share)], &settings)[0];
            // The effect of the perturbation may exceed the requested error.
            operation.point().unwrap_or_else(|| panic!("{operation:?}")).speed
        };
        let (loose, long) = (speed(0.5, seed), speed(0.02, 100 + seed));
        let error = hypot(loose.standard_error, long.standard_error);
        // A motor that locks to one motion, and is known far better than requested, is not judged.
        if error > 1e-4 * long.value.abs() {
            let errors = (loose.value - long.value) / error;
            assert!(errors.abs() < 4.0, "{system:?} {loose:?} {long:?}");
            squares.push(errors * errors);
        }
    }
    assert!(squares.len() >= 6 && mean(&squares) < 2.5, "{squares:?}");
}

/// The motor of Table III with a lag of 0.5 and a preload for a forcing of 3, under half of the largest
/// torque: 5.482(12) rad/s by `experiments/judge`, which shares no code with this crate. The load slows the
/// rise: when runs ended after a quarter of the unloaded rise time, speeds were once as low as 4.9 with a
/// stated error of 0.09.
#[test]
fn speeds_under_a_load_that_slows_the_rise_have_true_errors() {
    let peak = System::motor().peak_acceleration() * System::motor().disk().preload_acceleration();
    let system = motor(1e-8, 0.0)
        .with_disk(|rotor| rotor.preload_acceleration = peak / (3.0 * PI))
        .and_then(|motor| motor.with_platform(|stator| stator.phase_lag = 0.5))
        .expect("legal");
    let (mut within, tries) = (0, 12);
    for seed in 10..10 + tries {
        let settings =
            OperatingSettings { relative_error: 0.1, members: 4, seed, ..OperatingSettings::default() };
        let speed = operated(&[loaded(&system, 0.5)], &settings)[0].steady().expect("steady").speed;
        within += u64::from((speed.value - 5.482).abs() <= 1.96 * speed.standard_error);
    }
    assert!(within + 1 >= tries, "{within} of {tries}");
}

/// A rotor that is hit once in each period has the stator's speed after each impact, and the load slows the
/// rotor in flight. So the speed range is the loss in one flight, and the mean falls with the load as if the
/// time constant were half a period.
#[test]
fn a_locked_motor_has_the_range_and_the_time_constant_of_its_flights() {
    let base = System::motor();
    let unit = base.platform().amplitude() / base.peak_acceleration();
    let system = base
        .with_platform(|stator| stator.amplitude = 1.3 * unit)
        .and_then(|motor| motor.with_disk(|rotor| rotor.restitution = 0.5))
        .expect("legal");
    let period = TAU / system.platform().angular_frequency();
    let motors = [loaded(&system, 0.1), loaded(&system, 0.2)];
    // The locked branch is exact whatever error is asked for; the irregular one beside it is not looked at.
    let settings = OperatingSettings { members: 4, relative_error: 0.2, ..OperatingSettings::default() };
    let rows = operate(&motors, &settings, &Unobserved).expect("no failure").rows;
    for (motor, row) in motors.iter().zip(rows) {
        let points = row.branches.iter().filter_map(Operation::steady);
        let locked: Vec<_> = points
            .filter(|point| matches!(point.motion, AxialMotion::Periodic { periods: 1, impacts: 1 }))
            .collect();
        assert_eq!(locked.len(), 1, "{row:?}");
        let [low, high] = locked[0].speed_range.expect("one rotor for a tape");
        let lost = motor.system.disk().load_acceleration() * period;
        assert!(((high.value - low.value) / lost - 1.0).abs() < 1e-6, "{row:?}");
        assert!((0.5 * (high.value + low.value) / locked[0].speed.value - 1.0).abs() < 1e-9, "{row:?}");
        let constant = locked[0].time_constant.expect("another load");
        assert!((2.0 * constant.value / period - 1.0).abs() < 1e-3, "{constant:?} {period}");
    }
}

/// The speed of an irregular motion is nearly normally distributed about its mean.
#[test]
fn the_range_of_an_irregular_motion_has_its_deviation() {
    let system = motor(1e-8, 0.0);
    let motors = [loaded(&system, 0.0), loaded(&system, 0.2)];
    let row =
        operate(&motors, &OperatingSettings::default(), &Unobserved).expect("no failure").rows.remove(0);
    let point = row.point().expect("none runs away");
    let [low, high] = point.speed_range.expect("one rotor for a tape");
    let deviation = point.speed_deviation.expect("one rotor for a tape").value;
    assert!(((high.value - low.value) / (2.0 * NORMAL_975 * deviation) - 1.0).abs() < 0.2, "{point:?}");
}

/// Two rotors near the steady speed, on one vertical motion, approach each other by a factor e within the
/// time constant that follows from the slope of the torque-speed curve.
#[test]
fn the_time_constant_is_that_of_the_approach() {
    let system = motor(1e-8, 0.0);
    let motors = [loaded(&system, 0.0), loaded(&system, 0.05)];
    // With so few members all have the same perturbation size.
    let settings = OperatingSettings { members: 6, relative_error: 0.003, ..OperatingSettings::default() };
    let row = operate(&motors, &settings, &Unobserved).expect("no failure").rows.remove(0);
    let point = row.point().expect("none runs away");
    let constant = point.time_constant.expect("another load");
    let (scales, own) = (system.scales(), *system.dimensionless());
    let middle = point.speed.value / scales.angular_speed;
    let apart = 0.02 * middle;
    let watch = Watch::begin(&Unobserved, 0, 1).expect("goes on");
    let decay = |seed: u64| {
        let phase = starting_phase(1, seed as usize, 32).expect("finite");
        let source = Source::new(&Stator::Sine, &own, (phase, None), (1e-3, seed)).expect("legal");
        let rotor = || Stator::Sine.rotor(&own);
        let starts = [middle - apart, middle + apart].map(|speed| (rotor(), speed, 1.0));
        let mut pair = Taped::new(source, 128.0, starts.into_iter());
        let window = pair
            .next_window(constant.value / scales.time, &(1..=u64::MAX), &mut watch.work())
            .expect("no failure");
        let [low, high] = pair.speeds()[..] else { panic!("two rotors") };
        ((high - low) / (2.0 * apart), window.axial.duration * scales.time / constant.value)
    };
    let (left, times): (Vec<f64>, Vec<f64>) = (0..64).map(decay).unzip();
    // Rotors that meet stay together, so the mean of the remaining differences decays.
    let (found, expected) = (Estimate::of(&left).expect("finite"), exp(-mean(&times)));
    let error = hypot(found.standard_error, expected * (constant.standard_error / constant.value));
    assert!((found.value - expected).abs() < 3.0 * error && error < 0.1, "{found:?} {expected} {constant:?}");
}

/// A ball thrown in time with an elastic platform is thrown ever higher, so it has no steady mean.
#[test]
fn a_disk_that_stores_what_it_is_given_is_not_steady() {
    let settings = OperatingSettings {
        members: 8,
        most_impacts: 400_000,
        relative_error: 0.5,
        ..OperatingSettings::default()
    };
    let base = System::motor();
    let amplitude = 0.52 * PI * base.platform().amplitude() / base.peak_acceleration();
    let system = motor(amplitude, 0.0)
        .with_disk(|rotor| rotor.restitution = 1.0 - 1e-6)
        .and_then(|motor| motor.with_platform(|stator| stator.phase_lag = 0.0))
        .expect("legal");
    let operation = operated(&[loaded(&system, 0.0)], &settings)[0];
    assert_eq!(operation.steady(), None, "{operation:?}");
}
