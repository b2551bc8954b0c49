//! The spread over the tolerances of the inputs.
//!
//! In 16 runs at zero tolerances, the spread was zero in 7 cases, within one error of zero in 5 more, and
//! more than two errors from zero in 2. If each sample stopped when its own error was small, samples that
//! agree by chance would show spreads of up to 1.6 errors, at each of eight seeds. At 5 N the 40 kHz motor
//! (12 rad/s, radii of 12.5 and 10 mm) stalls at 3.715(21) mN m; the mean over the samples is 3.94(2) mN m,
//! their deviation 0.08(1), and their range 3.72 to 4.09.

use super::*;
use crate::testing::{check_stops, refused};
use bouncing_disk_core::Unobserved;

fn quick() -> OperatingSettings {
    OperatingSettings { relative_error: 0.1, members: 4, ..OperatingSettings::default() }
}

/// Samples with a known spread and known errors: the stated spread agrees with the true one within twice its
/// error.
#[test]
fn the_spread_of_known_draws_is_found() {
    let normal = |random: &mut SplitMix64| (0..12).map(|_| random.unit()).sum::<f64>() - 6.0;
    let (mut held, mut inside, mut trials) = (0, 0, 0);
    for true_spread in [0.0, 0.5, 2.0] {
        for seed in 0..100 {
            let mut random = SplitMix64::new(SplitMix64::seed_of_stream(seed, 1));
            let draws: Vec<Option<Drawn>> = (0..39)
                .map(|_| {
                    let own = 10.0 + true_spread * normal(&mut random);
                    let members = [0; MEMBERS_OF_DRAW].map(|_| own + normal(&mut random));
                    Some(Drawn::of(&members, &members))
                })
                .collect();
            let spread = InputSpread::of(&draws, 0).expect("finite").expect("many");
            let Estimate { value, standard_error } = spread.standard_deviation;
            held += u32::from((value - true_spread).abs() <= 2.0 * standard_error);
            let further = 10.0 + true_spread * normal(&mut random);
            inside += u32::from(spread.from_to[0] <= further && further <= spread.from_to[1]);
            trials += 1;
        }
    }
    assert!(held * 10 >= trials * 9 && inside * 10 >= trials * 9, "{held} {inside} {trials}");
    assert_eq!(InputSpread::of(&[None; 30], 3).expect("finite"), None);
}

/// A motor whose inputs are exactly known has no spread, whatever its statistical errors.
#[test]
fn a_motor_that_is_exactly_known_has_no_spread() {
    let exact = InputTolerance { preload: 0.0, amplitude: 0.0, perturbation_decades: 0.0, draws: 16 };
    let spread =
        Motor::paper_70_khz().speed_spreads(&[0.0], &quick(), &exact, &Unobserved).expect("no failure")[0];
    let spread = spread.expect("each draw turns");
    assert!(spread.standard_deviation.value < 0.01 * spread.mean.value, "{spread:?}");
}

/// Between 4.9 and 5.1 N this motor has speeds from 4 to 10 rad/s, although each is known to 0.04 rad/s.
#[test]
fn the_spread_of_a_motor_is_that_of_its_neighbours() {
    let motor = small_motor(5.0);
    let tolerance = InputTolerance { preload: 0.02, draws: 24, ..InputTolerance::default() };
    let loads = [0.0, 0.5 * motor.largest_torque(), 1.1 * motor.largest_torque()];
    let spreads = motor.speed_spreads(&loads, &quick(), &tolerance, &Unobserved).expect("no failure");
    let spread = spreads[0].expect("each draw turns");
    let [low, high] = spread.from_to;
    assert!(spread.standard_deviation.value > 2.0 * spread.standard_deviation.standard_error, "{spread:?}");
    assert!(high - low > 0.5 && spread.draws == 24 && spread.without == 0, "{spread:?}");
    assert_eq!(spreads[2], None);
    let again = motor.speed_spreads(&loads[..1], &quick(), &tolerance, &Unobserved).expect("no failure");
    assert_eq!(again[0].map(|spread| spread.draws), Some(24));
}

/// A motor of 40 kHz and 0.5 um under a preload (N).
fn small_motor(preload: f64) -> Motor {
    Motor::paper_70_khz()
        .with(|sheet| {
            (sheet.drive_frequency, sheet.amplitude, sheet.phase_lag) =
                (40e3, Some(0.5e-6), std::f64::consts::FRAC_PI_6);
            (sheet.peak_angular_speed, sheet.twist_amplitude) = (Some(12.0), None);
            (sheet.mass, sheet.density, sheet.rotor_radius) = (Some(0.020), None, None);
            (sheet.contact_radius, sheet.gyration_radius) = (12.5e-3, Some(10e-3));
            (sheet.preload_force, sheet.preload_acceleration) = (Some(preload), None);
            (sheet.friction, sheet.restitution) = (0.1, 0.5);
        })
        .expect("legal")
}

/// At 6 N the motor locks: its speed has almost no error, but differs from that of neighbouring motors. At 2
/// N its stall load is practically the largest torque.
#[test]
fn a_locked_motor_has_a_spread_and_a_stall_at_the_limit_an_error() {
    let motor = small_motor(6.0);
    assert!(motor.report(&Unobserved).expect("no failure").regime.is_locked());
    let settings = OperatingSettings { most_impacts: 1_000_000, ..quick() };
    let speed =
        motor.operating_point(0.0, &settings, &Unobserved).expect("no failure").point().expect("turns").speed;
    let tolerance = InputTolerance { draws: 16, ..InputTolerance::default() };
    let spread = motor.speed_spreads(&[0.0], &settings, &tolerance, &Unobserved).expect("no failure")[0]
        .expect("all turn");
    assert!(spread.standard_deviation.value > 20.0 * speed.standard_error, "{speed:?} {spread:?}");
    let motor = small_motor(2.0);
    let stall = motor.stall_load(&settings, &Unobserved).expect("it turns");
    let [below, above] = stall.bracket;
    assert!(stall.share > 0.95 && above <= motor.largest_torque() * (1.0 + 1e-12), "{stall:?}");
    assert!(below < stall.torque.value && stall.torque.value <= above, "{stall:?}");
    assert!(stall.torque.standard_error < 0.01 * stall.torque.value, "{stall:?}");
}

#[test]
fn tolerances_that_are_none_are_refused() {
    let motor = Motor::paper_70_khz();
    let usual = InputTolerance::default();
    let of = |tolerance| motor.stall_spread(&quick(), &tolerance, &Unobserved);
    refused("tolerance of the preload", [-0.1], |preload| of(InputTolerance { preload, ..usual }));
    refused("tolerance of the amplitude", [f64::NAN], |amplitude| of(InputTolerance { amplitude, ..usual }));
    refused("perturbation_decades", [7.0], |decades| {
        of(InputTolerance { perturbation_decades: decades, ..usual })
    });
    refused("draws", [7, usize::MAX], |draws| of(InputTolerance { draws, ..usual }));
}

#[test]
fn a_spread_can_be_stopped() {
    let (motor, tolerance) =
        (Motor::paper_70_khz(), InputTolerance { draws: 8, ..InputTolerance::default() });
    check_stops(None, |observer| motor.speed_spreads(&[0.0], &quick(), &tolerance, observer));
}

/// The operation of a rotor that never leaves the stator, which friction and lag turn, is exact and known at
/// once; without lag the rotor does not turn.
#[test]
fn a_motor_that_is_never_thrown_is_answered_at_once() {
    let began = std::time::Instant::now();
    let settings = OperatingSettings::default();
    let still = Motor::paper_70_khz().with(|sheet| sheet.amplitude = Some(4e-11)).expect("legal");
    assert!(matches!(still.stall_load(&settings, &Unobserved), Err(Error::DoesNotTurn { .. })));
    // The rotor slides, and is dragged along when the stator presses harder. For the normal force 1 - P sin
    // tau, the share S(x) of the half-cycle in which cos(tau + theta) > x is, with c = acos x, (c + P sin c
    // sin theta)/pi; it balances at 1/2.
    let lag: f64 = 0.9;
    let motor = still.with(|sheet| sheet.phase_lag = lag).expect("legal");
    let point =
        *motor.operating_point(0.0, &settings, &Unobserved).expect("no failure").steady().expect("steady");
    let peak = motor.system().peak_acceleration();
    let (mut low, mut high) = (-1.0_f64, 1.0_f64);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let angle = bouncing_disk_core::numerics::elementary::acos(middle);
        let share = (angle
            + peak * (1.0 - middle * middle).sqrt() * bouncing_disk_core::numerics::elementary::sin(lag))
            / std::f64::consts::PI;
        if share > 0.5 { low = middle } else { high = middle }
    }
    let expected = low * motor.system().platform().peak_angular_speed();
    assert!((point.speed.value / expected - 1.0).abs() < 1e-4, "{point:?} {expected}");
    assert!(point.speed.standard_error < 1e-5 * expected && point.energy_residual < 1e-9, "{point:?}");
    let stall = motor.stall_load(&settings, &Unobserved).expect("it turns");
    // S(0) of the same normal force.
    let share = 2.0 * peak * bouncing_disk_core::numerics::elementary::sin(lag) / std::f64::consts::PI;
    assert!((stall.share - share).abs() < 2e-3, "{stall:?} {share}");
    // In units of torque it is proportional to the amplitude alone; a tolerance of 1 % on either side has a
    // deviation of 1 %/sqrt(3).
    let tolerance = InputTolerance { draws: 12, ..InputTolerance::default() };
    let spread =
        motor.stall_spread(&settings, &tolerance, &Unobserved).expect("no failure").expect("each turns");
    let Estimate { value, standard_error } = spread.standard_deviation;
    let expected = 0.01 / 3.0_f64.sqrt() * stall.torque.value;
    assert!((value - expected).abs() < 3.0 * standard_error.max(0.05 * expected), "{spread:?} {expected}");
    assert!(began.elapsed() < std::time::Duration::from_secs(60));
}
