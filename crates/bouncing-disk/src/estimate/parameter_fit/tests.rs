use std::f64::consts::{PI, TAU};

use bouncing_disk_core::numerics::elementary::exp;
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::sweep::InstructionSet;
use bouncing_disk_core::{Phase, Unobserved};

use super::measured_transient::RunPreload;
use super::*;
use crate::estimate::measured_speeds::{MeasuredRun, MeasuredSpeeds};
use crate::estimate::parameter_fit::weights::Weights;
use crate::motor::batch::shared_orbit::transients::shared_transients;
use crate::motor::data_sheet::traps::low_period_traps;
use crate::motor::rotor::transient::{TransientSettings, transient};
use crate::parameters::contact::Contact;
use crate::testing::{Noise, check_stops, refused};

const FRICTION: FitRange = FitRange { parameter: FitParameter::Friction, low: 0.05, high: 1.0 };
const TWIST: FitRange = FitRange { parameter: FitParameter::TwistAmplitude, low: 2e-5, high: 2e-4 };
const LAG: FitRange = FitRange { parameter: FitParameter::PhaseLag, low: -0.8, high: 0.8 };
const RESTITUTION: FitRange = FitRange { parameter: FitParameter::Restitution, low: 0.2, high: 0.8 };
const AMPLITUDE: FitRange = FitRange { parameter: FitParameter::Amplitude, low: 3e-9, high: 3e-8 };

/// Of the motor that synthetic runs are of, where its data sheet has 0.1.
const TRUE_FRICTION: f64 = 0.2;

const PRELOADS: [f64; 3] = [5.0, 9.8, 15.0];

fn settings() -> ParameterFitSettings {
    ParameterFitSettings { members: 48, ..ParameterFitSettings::default() }
}

fn built() -> Motor {
    Motor::paper_70_khz().with(|sheet| sheet.friction = TRUE_FRICTION).expect("legal")
}

/// Synthetic: a run of this motor at a preload, from a random phase, with independent errors of its speeds.
fn synthetic(motor: &Motor, acceleration: f64, duration: f64, error: f64, seed: u64) -> MeasuredTransient {
    let mut generator = SplitMix64::new(seed);
    let phase = Phase::new(TAU * generator.unit()).expect("legal");
    let seed_of_run = generator.next_number();
    let settings =
        TransientSettings { duration, intervals: 160, seed: seed_of_run, ..TransientSettings::default() };
    let motor = motor.with(|sheet| sheet.preload_acceleration = Some(acceleration)).expect("legal");
    let curve = transient(motor.system(), phase, &settings, &Unobserved).expect("no failure");
    let mut noise = Noise::new(seed ^ 0xABCD);
    let speeds = curve.speeds.iter().map(|speed| speed + error * noise.normal()).collect();
    measured(acceleration, curve.times, speeds, Some(error))
}

fn measured(
    acceleration: f64,
    times: Vec<f64>,
    speeds: Vec<f64>,
    speed_error: Option<f64>,
) -> MeasuredTransient {
    let runs = MeasuredSpeeds::new(vec![MeasuredRun { member: 0, times, speeds }]).expect("legal");
    MeasuredTransient { preload: RunPreload::Acceleration(acceleration), runs, speed_error }
}

fn at_all_preloads(duration: f64, seed: u64) -> Vec<MeasuredTransient> {
    PRELOADS.iter().zip(seed..).map(|(&g, seed)| synthetic(&built(), g, duration, 0.2, seed)).collect()
}

fn fit(transients: &[MeasuredTransient], ranges: &[FitRange]) -> Result<ParameterFit, FitError> {
    ParameterFit::new(&Motor::paper_70_khz(), transients, ranges, &settings(), &Unobserved)
}

/// How many of the intervals of the friction alone hold the truth.
fn covered_by_friction(trials: u64) -> u64 {
    let holds = |trial: u64| {
        let fit = fit(&[synthetic(&built(), 9.8, 0.8, 0.2, 1_000 * trial)], &[FRICTION]);
        let estimate = fit.ok().and_then(|fit| fit.estimate(FitParameter::Friction));
        u64::from(estimate.is_some_and(|friction| friction.contains(TRUE_FRICTION)))
    };
    (1..=trials).map(holds).sum()
}

#[test]
fn intervals_of_the_friction_hold_the_truth() {
    assert!(covered_by_friction(6) >= 5);
}

/// A minute; the figures are in docs/numerics/motors.md, "Parameters from transients".
#[test]
#[ignore = "takes a minute"]
fn ninety_of_a_hundred_intervals_hold_the_truth() {
    let covered = covered_by_friction(100);
    println!("friction alone: {covered}");
    assert!(covered >= 90, "{covered}");
}

/// Minutes. Two parameters at three preloads: what is refused is told beside what is missed.
#[test]
#[ignore = "takes minutes"]
fn ninety_of_a_hundred_intervals_of_two_parameters_hold_the_truth() {
    let truths = [TRUE_FRICTION, FitParameter::TwistAmplitude.of(&built())];
    let (mut covered, mut refused, mut undetermined, mut either) = ([0; 2], 0, 0, 0);
    for trial in 1..=100 {
        let fit = match fit(&at_all_preloads(0.8, 1_000 * trial), &[FRICTION, TWIST]) {
            Ok(fit) => fit,
            Err(error) => {
                println!("{trial}: {error}");
                refused += 1;
                continue;
            }
        };
        undetermined += usize::from(!fit.undetermined.is_empty());
        let found = [FRICTION, TWIST].map(|range| fit.estimate(range.parameter));
        let holds = [0, 1].map(|k| found[k].is_some_and(|found| found.contains(truths[k])));
        if holds != [true; 2] {
            println!("{trial}: misfit {} of {}, {found:?}", fit.misfit, fit.degrees_of_freedom);
        }
        covered = [0, 1].map(|k| covered[k] + usize::from(holds[k]));
        either += usize::from(holds[0] || holds[1]);
    }
    println!("covered {covered:?}, one of them {either}, refused {refused}, undetermined {undetermined}");
    assert!(covered.iter().all(|&count| count >= 90), "{covered:?}");
}

/// A record that began before the switch-on or after it would have another friction: one clock of three
/// tells.
#[test]
fn a_clock_that_is_off_is_refused() {
    for off in [-0.05, 0.05] {
        let mut transients = at_all_preloads(0.8, 31);
        let run = &transients[1].runs.runs()[0];
        let times = run.times.iter().map(|time| time + off).collect();
        transients[1] = measured(PRELOADS[1], times, run.speeds.clone(), Some(0.2));
        let error = fit(&transients, &[FRICTION, TWIST]).expect_err("off");
        let FitError::Refused(FitRefusal::ShiftedClock { transient: 1, early, standard_error }) = error
        else {
            panic!("{error}")
        };
        // To first order.
        assert!((0.5..2.0).contains(&(-early / off)) && standard_error < 0.01, "{error}");
    }
}

#[test]
fn friction_and_twist_are_told_apart_by_three_preloads() {
    let fit = fit(&at_all_preloads(0.8, 7), &[FRICTION, TWIST]).expect("fitted");
    assert!(fit.undetermined.is_empty(), "{:?}", fit.undetermined);
    let (friction, twist) =
        (fit.estimate(FitParameter::Friction), fit.estimate(FitParameter::TwistAmplitude));
    let (friction, twist) = (friction.expect("determined"), twist.expect("determined"));
    assert!(friction.contains(TRUE_FRICTION) && friction.high < 1.3 * friction.low, "{friction:?}");
    assert!(twist.contains(FitParameter::TwistAmplitude.of(&built())), "{twist:?}");
    assert!((fit.motor.system().disk().friction() - friction.value).abs() <= 0.0);
    assert!((fit.motor.preload_acceleration() - Motor::paper_70_khz().preload_acceleration()).abs() <= 0.0);
    assert_eq!(fit.degrees_of_freedom, 16);
}

/// A rotor that is still slow gets an acceleration that is friction's alone, whatever the stator's speed:
/// docs/numerics/motors.md.
#[test]
fn the_twist_is_named_where_the_rotor_is_still_slow() {
    let fit = fit(&[synthetic(&built(), 9.8, 0.04, 0.02, 3)], &[FRICTION, TWIST]).expect("fitted");
    let friction = fit.estimate(FitParameter::Friction).expect("determined");
    assert!(friction.contains(TRUE_FRICTION), "{friction:?}");
    assert_eq!(fit.estimate(FitParameter::TwistAmplitude), None);
    let [direction] = fit.undetermined.as_slice() else { panic!("{:?}", fit.undetermined) };
    assert!((direction.direction[1].1 - 1.0).abs() <= 0.0 && direction.direction[1].0 == TWIST.parameter);
    assert!(direction.direction[0].1.abs() < 0.1, "{direction:?}");
    // Along it the motor stays at its data sheet.
    let (own, sheet) = (TWIST.parameter.of(&fit.motor), TWIST.parameter.of(&Motor::paper_70_khz()));
    assert!((own / sheet - 1.0).abs() < 0.2, "{own} {sheet}");
}

/// The steady speed of a motor that needs many flights to reach it is the stator's times a number that does
/// not depend on friction.
#[test]
fn the_friction_is_named_where_the_speed_is_steady() {
    let mut late = synthetic(&built(), 9.8, 4.0, 0.2, 4);
    let run = &late.runs.runs()[0];
    let (times, speeds) = run.times.iter().zip(&run.speeds).filter(|&(&time, _)| time > 2.5).unzip();
    late = measured(9.8, times, speeds, Some(0.2));
    let sheet = built();
    let fit =
        ParameterFit::new(&sheet, &[late], &[FRICTION, TWIST], &settings(), &Unobserved).expect("fitted");
    assert_eq!(fit.estimate(FitParameter::Friction), None);
    let [direction] = fit.undetermined.as_slice() else { panic!("{:?}", fit.undetermined) };
    assert!((direction.direction[0].1 - 1.0).abs() <= 0.0, "{direction:?}");
    assert!(direction.direction[1].1.abs() < 0.2, "{direction:?}");
}

/// One transient is a speed and a time: three parameters that change just these leave a direction open. The
/// oracle is the model itself: two motors far apart along the direction have one transient, and such across
/// it have different ones.
#[test]
fn one_preload_leaves_a_direction_of_three_parameters_open() {
    let (runs, ranges) = ([synthetic(&built(), 9.8, 0.8, 0.2, 5)], [FRICTION, TWIST, LAG]);
    let fit = fit(&runs, &ranges).expect("fitted");
    let [open] = fit.undetermined.as_slice() else { panic!("{:?}", fit.undetermined) };
    assert_eq!(fit.estimate(FitParameter::PhaseLag), None);
    assert!((open.direction[2].1 - 1.0).abs() <= 0.0, "{open:?}");
    let settings = settings();
    let model = checked(&fit.motor, &runs, &ranges, &settings).expect("legal");
    let watch = Watch::begin(&Unobserved, 0, 1).expect("goes on");
    let places = ranges.iter().map(|range| range.place_of(range.parameter.of(&fit.motor)));
    let places = DVector::from_iterator(3, places);
    let along = ranges.iter().zip(&open.direction).map(|(range, (_, change))| change / range.half_width());
    let along = DVector::from_iterator(3, along).normalize();
    let across = DVector::from_vec(vec![1.0, 0.0, 0.0]);
    let across = (&across - &along * along.dot(&across)).normalize();
    let local = model.with_derivatives(&places, |_| true, &watch).expect("no failure");
    let weights = Weights::of(&model, &local).expect("positive");
    let changed = |direction: &DVector<f64>| {
        let both = [&places + direction * 0.3, &places - direction * 0.3];
        let members = model.members(&both, &watch).expect("no failure");
        weights.apply(&(model::mean_of(&members[0]) - model::mean_of(&members[1]))).norm()
    };
    let (along, across) = (changed(&along), changed(&across));
    println!("{along} {across}");
    assert!(along < 2.0 && across > 5.0 * along, "{along} {across}");
}

/// Whether any of the motors is locked to few impacts, where no fit could follow it.
fn is_trapped(motor: &Motor) -> bool {
    let verdicts = low_period_traps(motor, &PRELOADS, &Unobserved).expect("no failure");
    verdicts.iter().any(|verdict| verdict.is_trap)
}

/// Restitution changes the vertical motion, whose cycles make the response rough: the interval says so, holds
/// the truth, and does not hold the data sheet's value, from which the search began.
#[test]
fn a_restitution_is_found_with_the_error_of_its_rough_response() {
    assert!(!is_trapped(&built()));
    let sheet = built().with(|sheet| sheet.restitution = 0.3).expect("legal");
    let settings = ParameterFitSettings { members: 32, ..ParameterFitSettings::default() };
    let runs = at_all_preloads(0.4, 9);
    let fit = ParameterFit::new(&sheet, &runs, &[RESTITUTION], &settings, &Unobserved).expect("fitted");
    let found = fit.estimate(FitParameter::Restitution).expect("determined");
    assert!(found.contains(0.5) && !found.contains(0.3) && found.high < 0.65, "{found:?}");
    assert!(found.high - found.low > 0.05, "{found:?}");
}

/// At these preloads P is 130 to 390, where the speeds of neighbouring amplitudes scatter more than they
/// change. That is said: there is no interval, and the amplitude is named as undetermined.
#[test]
fn an_amplitude_that_its_rough_response_hides_is_named() {
    assert!(!is_trapped(&built()));
    let amplitude = FitParameter::Amplitude;
    let sheet = built().with(|sheet| sheet.amplitude = Some(1.4 * amplitude.of(&built()))).expect("legal");
    let settings = ParameterFitSettings { members: 32, ..ParameterFitSettings::default() };
    let runs = at_all_preloads(0.4, 9);
    let fit =
        ParameterFit::new(&sheet, &runs, &[AMPLITUDE], &settings, &Unobserved).expect("nothing to search");
    assert_eq!(fit.estimate(amplitude), None);
    let [open] = fit.undetermined.as_slice() else { panic!("{:?}", fit.undetermined) };
    assert_eq!(open.direction, [(amplitude, 1.0)]);
    // Half of the range is 1.15 in the logarithm; an error of half as much determines nothing.
    assert!(open.standard_error > 0.57, "{open:?}");
}

#[test]
fn input_that_means_nothing_is_refused_by_name() {
    let sheet = Motor::paper_70_khz();
    let times: Vec<f64> = (1..=20).map(|i| 0.01 * f64::from(i)).collect();
    let speeds: Vec<f64> = times.iter().map(|time| 10.0 * time).collect();
    let good = measured(9.8, times.clone(), speeds.clone(), None);
    let fit_of = |transient| fit(&[transient], &[FRICTION]);
    refused("does not change", [measured(9.8, times.clone(), vec![0.0; 20], None)], fit_of);
    refused("7 points", [measured(9.8, times[..7].to_vec(), speeds[..7].to_vec(), None)], fit_of);
    // That the times rise is checked where runs are made.
    let unsorted = MeasuredRun { member: 0, times: vec![0.1, 0.3, 0.2], speeds: vec![1.0; 3] };
    refused("times of the speed curve", [vec![unsorted]], MeasuredSpeeds::new);
    // 2000 m/s^2 hold the rotor on the stator.
    refused("never leaves", [measured(2e3, times.clone(), speeds.clone(), None)], fit_of);
    let bad = [0.0, -1.0, f64::NAN, f64::INFINITY];
    refused("preload", bad, |preload| fit_of(measured(preload, times.clone(), speeds.clone(), None)));
    refused("preload", bad, |preload| {
        fit_of(MeasuredTransient { preload: RunPreload::Force(preload), ..good.clone() })
    });
    refused("speed_error", [-1.0, f64::NAN, f64::INFINITY, 1e200], |error| {
        fit_of(measured(9.8, times.clone(), speeds.clone(), Some(error)))
    });
    let huge = speeds.iter().map(|speed| 1e200 * speed * speed).collect();
    refused("square of a measured speed", [measured(9.8, times.clone(), huge, None)], fit_of);
    let over = |range| fit(std::slice::from_ref(&good), &[range]);
    let from_to = |(low, high)| over(FitRange { low, high, ..FRICTION });
    refused("friction", [(0.0, 1.0), (-1.0, 1.0), (0.5, 1.0), (0.01, 0.05)], from_to);
    refused("friction", [(f64::NAN, 1.0), (0.05, f64::INFINITY)], from_to);
    refused("upper end of a range", [(0.1, 0.1), (1.0, 0.05)], from_to);
    let restitutions = [FitRange { high: 1.0, ..RESTITUTION }, FitRange { low: -0.1, ..RESTITUTION }];
    refused("restitution", restitutions, over);
    let around = FitRange { low: -PI, high: 1.1 * PI, ..LAG };
    refused("width of the range of the phase lag", [around], over);
    for (low, high) in [(0.0, 1.0), (0.1, 1e9)] {
        over(contact_range(low, high)).expect_err("refused");
    }
    let transients = [good];
    refused("number of fitted parameters", [[]], |ranges: [FitRange; 0]| fit(&transients, &ranges));
    refused("friction", [[FRICTION, FRICTION]], |ranges| fit(&transients, &ranges));
    refused("number of transients", [()], |()| fit(&[], &[FRICTION]));
    // Legal with rigid impacts only.
    let inelastic = [contact_range(0.5, 1.0), FitRange { low: 0.0, ..RESTITUTION }];
    refused("restitution of a contact that takes time = 0", [inelastic], |ranges| fit(&transients, &ranges));
    let d = ParameterFitSettings::default();
    let with = |settings| ParameterFit::new(&sheet, &transients, &[FRICTION], &settings, &Unobserved);
    refused("members", [23], |members| with(ParameterFitSettings { members, ..d }));
    refused("windows", [0, 13], |windows| with(ParameterFitSettings { windows, ..d }));
    refused("relaunch_perturbation", [0.0, f64::NAN], |relaunch_perturbation| {
        with(ParameterFitSettings { relaunch_perturbation, ..d })
    });
    refused("most_evaluations", [0], |most| with(ParameterFitSettings { most_evaluations: most, ..d }));
    refused("resamples", [199], |resamples| with(ParameterFitSettings { resamples, ..d }));
    refused("largest_misfit", [0.5, f64::INFINITY], |largest_misfit| {
        with(ParameterFitSettings { largest_misfit, ..d })
    });
}

#[test]
fn a_fit_that_describes_nothing_is_refused_with_its_numbers() {
    let run = synthetic(&built(), 9.8, 0.8, 0.2, 6);
    let times = run.runs.runs()[0].times.clone();
    // Half of the true friction is the most that is allowed.
    let narrow = FitRange { high: 0.11, ..FRICTION };
    let error = fit(std::slice::from_ref(&run), &[narrow]).expect_err("at the end");
    assert!(
        matches!(
            error,
            FitError::Refused(
                FitRefusal::AtRangeEnd { parameter: FitParameter::Friction, .. } | FitRefusal::Misfit { .. }
            )
        ),
        "{error}"
    );
    // A speed that falls.
    let falling = times.iter().map(|time| 20.0 - 20.0 * time).collect();
    let error = fit(&[measured(9.8, times, falling, None)], &[FRICTION]).expect_err("no run-up");
    assert!(matches!(error, FitError::Refused(_)), "{error}");
    let settings = ParameterFitSettings { most_evaluations: 2, ..settings() };
    let error = ParameterFit::new(&Motor::paper_70_khz(), &[run], &[FRICTION], &settings, &Unobserved)
        .expect_err("too few");
    assert_eq!(error, FitError::Refused(FitRefusal::NotConverged { evaluations: 2 }));
}

#[test]
fn a_fit_can_be_watched_and_stopped_and_has_one_result() {
    let run = [synthetic(&built(), 9.8, 0.2, 0.2, 8)];
    let (sheet, settings) = (Motor::paper_70_khz(), ParameterFitSettings { members: 24, ..settings() });
    let items = settings.most_evaluations as u64;
    check_stops(items, |observer| {
        ParameterFit::new(&sheet, &run, &[FRICTION, AMPLITUDE], &settings, observer)
    });
}

/// For an even number of degrees the tail of chi-squared is a finite sum, that of a Poisson distribution.
#[test]
fn a_rare_misfit_is_that_of_one_fit_in_ten_thousand() {
    for pairs in [2, 5, 10, 30] {
        let half = 0.5 * rare_misfit(f64::from(2 * pairs));
        let (mut term, mut sum) = (1.0, 0.0);
        for k in 1..=pairs {
            sum += term;
            term *= half / f64::from(k);
        }
        let tail = exp(-half) * sum;
        assert!((0.7e-4..1.1e-4).contains(&tail), "{pairs}: {tail}");
    }
}

/// A short run-up with much friction, of impacts that last for some periods: rigid ones for zero.
fn soft(periods: f64, lag: f64) -> Motor {
    let sheet =
        Motor::paper_70_khz().with(|sheet| (sheet.friction, sheet.phase_lag) = (1.0, lag)).expect("legal");
    lasting(&sheet, periods)
}

fn lasting(motor: &Motor, periods: f64) -> Motor {
    let time = periods / 70e3;
    motor.with(|sheet| sheet.contact = (time > 0.0).then(|| Contact::lasting(time))).expect("legal")
}

/// Contact times in periods.
fn contact_range(low: f64, high: f64) -> FitRange {
    FitRange { parameter: FitParameter::ContactTime, low: low / 70e3, high: high / 70e3 }
}

/// Synthetic.
fn soft_run(motor: &Motor, duration: f64, seed: u64) -> MeasuredTransient {
    let mut generator = SplitMix64::new(seed);
    let phase = Phase::new(TAU * generator.unit()).expect("legal");
    let settings = TransientSettings {
        duration,
        intervals: 160,
        seed: generator.next_number(),
        ..TransientSettings::default()
    };
    let watch = Watch::begin(&Unobserved, 0, 1).expect("goes on");
    let curve =
        shared_transients(&[*motor.system()], phase, &settings, InstructionSet::best(), &mut watch.work());
    let curve = curve.expect("no failure").remove(0);
    let mut noise = Noise::new(seed ^ 0xABCD);
    let speeds = curve.speeds.iter().map(|speed| speed + 0.2 * noise.normal()).collect();
    measured(motor.preload_acceleration(), curve.times, speeds, Some(0.2))
}

fn fit_soft(sheet: &Motor, run: MeasuredTransient, ranges: &[FitRange]) -> Result<ParameterFit, FitError> {
    let settings = ParameterFitSettings { members: 24, ..ParameterFitSettings::default() };
    ParameterFit::new(sheet, &[run], ranges, &settings, &Unobserved)
}

#[test]
fn intervals_of_the_contact_time_hold_the_truth() {
    let (sheet, settings) = (soft(0.0, 0.0), ParameterFitSettings { members: 24, ..settings() });
    let (run, range) = (|seed| [soft_run(&soft(1.0, 0.0), 0.1, seed)], [contact_range(0.8, 2.0)]);
    let (first, watch) = (run(0), Watch::begin(&Unobserved, 0, 1).expect("goes on"));
    let model = checked(&sheet, &first, &range, &settings).expect("legal");
    // The candidates are those of all runs.
    let mut scan = contact_time::Scan::over(range[0], &model, &watch).expect("no failure");
    let covered = (1..=20).filter(|&seed| {
        let run = run(seed);
        let measured = checked(&sheet, &run, &range, &settings).expect("legal").measured();
        scan.refine(&measured, &watch).expect("no failure");
        let accepted = scan.accepted(&measured, sample_widening(&model), &watch).expect("goes on");
        let times = scan.times(&accepted);
        let [AcceptedRange { low: Some(low), high: Some(high), .. }] = times[..] else { panic!("{times:?}") };
        assert!(high < 1.1 * low, "{times:?}");
        (low..=high).contains(&(1.0 / 70e3))
    });
    let covered = covered.count();
    assert!(covered >= 18, "{covered}");
}

#[test]
#[ignore = "takes a minute"]
fn a_contact_time_is_found_beside_a_friction_from_a_rigid_data_sheet() {
    let sheet = soft(0.0, 0.0).with(|sheet| sheet.friction = 0.8).expect("legal");
    let ranges = [FitRange { low: 0.5, high: 2.0, ..FRICTION }, contact_range(0.95, 1.05)];
    let fit = fit_soft(&sheet, soft_run(&soft(1.0, 0.0), 0.1, 1), &ranges).expect("fitted");
    let found = [FRICTION.parameter, FitParameter::ContactTime].map(|parameter| fit.estimate(parameter));
    let [friction, time] = found.map(|found| found.expect("determined"));
    assert!(friction.contains(1.0) && friction.high < 1.3 * friction.low, "{fit}");
    assert!(
        time.contains(1.0 / 70e3) && (FitParameter::ContactTime.of(&fit.motor) - time.value).abs() <= 0.0
    );
    assert_eq!(fit.parameters[1].nominal.to_bits(), 0);
}

/// Eight evaluations are enough at one of two times; three at none.
#[test]
fn a_time_at_which_the_search_does_not_converge_is_not_excluded() {
    let run = [soft_run(&soft(1.0, 0.0), 0.1, 1)];
    let ranges = [FitRange { low: 0.5, high: 2.0, ..FRICTION }, contact_range(0.97, 1.0)];
    let fit = |most_evaluations| {
        let settings = ParameterFitSettings { members: 24, most_evaluations, ..settings() };
        ParameterFit::new(&soft(0.0, 0.0), &run, &ranges, &settings, &Unobserved)
    };
    let open = fit(8).expect("fitted");
    assert_eq!(
        open.contact_times,
        [AcceptedRange { parameter: FitParameter::ContactTime, low: None, high: None }]
    );
    assert_eq!(ranges.map(|range| open.estimate(range.parameter)), [None; 2]);
    let error = fit(3).expect_err("too few");
    assert!(matches!(error, FitError::Refused(FitRefusal::NotConverged { evaluations: 6 })), "{error}");
}

#[test]
fn short_contacts_have_an_upper_bound_only() {
    for periods in [0.0, 0.05] {
        let fit =
            fit_soft(&soft(1.0, 0.0), soft_run(&soft(periods, 0.0), 0.1, 2), &[contact_range(0.01, 1.5)])
                .expect("fitted");
        assert_eq!(fit.estimate(FitParameter::ContactTime), None);
        assert!(fit.contact_times[0].low.is_none(), "{fit}");
        assert!(fit.contact_times[0].high.is_some_and(|high| high > 0.1 / 70e3), "{fit}");
    }
}

/// The steady speed of rigid impacts is twice as high: there is no friction for which it is right.
#[test]
fn a_friction_is_found_on_contacts_that_take_time_and_not_on_rigid_ones() {
    let truth = soft(1.0, 0.0);
    let range = FitRange { high: 3.0, ..FRICTION };
    let sheet = truth.with(|sheet| sheet.friction = 0.7).expect("legal");
    let fit = fit_soft(&sheet, soft_run(&truth, 0.1, 3), &[range]).expect("fitted");
    let found = fit.estimate(FitParameter::Friction).expect("determined");
    assert!(found.contains(1.0) && found.high < 1.2 * found.low, "{fit}");
    let error = fit_soft(&lasting(&sheet, 0.0), soft_run(&truth, 0.4, 3), &[range]).expect_err("too slow");
    assert!(
        matches!(error, FitError::Refused(FitRefusal::Misfit { .. } | FitRefusal::AtRangeEnd { .. })),
        "{error}"
    );
}
