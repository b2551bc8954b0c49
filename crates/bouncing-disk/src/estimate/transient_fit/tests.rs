//! Fits of synthetic curves with known parameters and seeded noise.
//!
//! Coverage: the number of 100 seeded intervals of steady speed, time constant and their quotient that contain
//! the truth (the tests require 90). Two numbers are for a start from rest and for any start, unless the row
//! lists cases:
//!
//! | curves | alpha_ss | t_c | alpha_ss/t_c |
//! | --- | --- | --- | --- |
//! | 5 members of 120 points | 96; 96 | 95; 97 | 95; 95 |
//! | 16 members | 92; 94 | 93; 97 | 94; 98 |
//! | one curve of 60 points | 96; 97 | 93; 94 | 94; 94 |
//! | one curve of 400 points | 96; 98 | 97; 98 | 98; 95 |
//! | one curve of 300 points, memory 0.6 | 98; 99 | 98; 97 | 96; 97 |
//! | one curve of 2500 points, memory 0.9 | 93; 96 | 93; 93 | 92; 93 |
//! | one curve of 100 points, noise that grows with time | 96; 96 | 96; 95 | 96; 97 |
//! | the same, noise that falls with time | 97; 96 | 97; 92 | 97; 92 |
//! | a clock 0.05 s early; a dead time of 0.02 s; of 0.2 s: five runs | 98; 98; 96 | 93; 95; 95 | 97; 95; 95 |
//! | a dead time of one row; of four rows with much noise: one run | 97; 98 | 95; 94 | 96; 94 |
//! | a start at half the steady speed, five runs; above it, one run | 98; 96 | 93; 94 | 95; 95 |

use super::*;
use crate::error::Error;
use crate::estimate::fit::RampFit;
use crate::testing::{Noise, check_stops, refused};

const STEADY: f64 = 20.0;
const CONSTANT: f64 = 0.6;

fn times(points: u32, duration: f64) -> Vec<f64> {
    (0..points).map(|i| (f64::from(i) + 0.5) * duration / f64::from(points)).collect()
}

fn rise(times: &[f64], steady: f64, constant: f64) -> Vec<f64> {
    times.iter().map(|time| steady * exponential(time / constant)).collect()
}

/// A member with its own steady speed and autocorrelated noise.
fn member(times: &[f64], noise: &mut Noise) -> Vec<f64> {
    let steady = STEADY * (1.0 + 0.05 * noise.normal());
    let scatter = noise.correlated(times.len(), 0.8);
    rise(times, steady, CONSTANT).iter().zip(scatter).map(|(speed, noise)| speed + 1.5 * noise).collect()
}

fn refusal(result: Result<TransientFit, FitError>) -> FitRefusal {
    match result {
        Err(FitError::Refused(reason)) => reason,
        other => panic!("{other:?}"),
    }
}

fn coverage(fit: impl FnMut(u64) -> Result<TransientFit, FitError>) -> [u32; 3] {
    coverage_of([STEADY, CONSTANT], fit)
}

/// How many of 100 fits contain the truth. A rejected fit counts as if it did; at least 80 must be accepted.
fn coverage_of(truth: [f64; 2], mut fit: impl FnMut(u64) -> Result<TransientFit, FitError>) -> [u32; 3] {
    let fits: Vec<TransientFit> = (1..=100).filter_map(|seed| fit(seed).ok()).collect();
    assert!(fits.len() >= 80, "{} fits of 100", fits.len());
    let mut covered = [100 - fits.len() as u32; 3];
    for fit in fits {
        for (count, (estimate, truth)) in covered.iter_mut().zip([
            (fit.steady_speed(), truth[0]),
            (fit.time_constant(), truth[1]),
            (fit.stall_acceleration(), truth[0] / truth[1]),
        ]) {
            *count += u32::from(estimate.contains(truth));
        }
    }
    covered
}

/// Settings for tests with many fits.
const FEW: FitSettings = FitSettings { resamples: 300, from_rest: false, ..FROM_REST };

/// Records a case in which fewer than 90 intervals contain the truth.
fn note(case: String, covered: [u32; 3], missed: &mut Vec<(String, [u32; 3])>) {
    println!("{case}: {covered:?}");
    if covered.iter().any(|&count| count < 90) {
        missed.push((case, covered));
    }
}

#[test]
fn intervals_of_synthetic_ensembles_cover_the_truth() {
    let times = times(120, 4.0);
    let mut missed = Vec::new();
    for (members, from_rest) in [(LEAST_MEMBERS, true), (LEAST_MEMBERS, false), (16, true), (16, false)] {
        let covered = coverage(|seed| {
            let runs = ensemble(&times, members, 1_000 * members as u64 + seed);
            fit_runs(&times, &runs, &FitSettings { seed, from_rest, ..FEW })
        });
        note(format!("{members} members, from rest {from_rest}"), covered, &mut missed);
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

/// Noise that is white, correlated, or grows along the curve; few rows, a short curve; with and without
/// knowledge of the start.
#[test]
fn intervals_of_synthetic_measurements_cover_the_truth() {
    let even = |_: f64| 1.0;
    let grows = |time: f64| 0.2 + 0.5 * time;
    let falls = |time: f64| 0.2 + 4.0 * bouncing_disk_core::numerics::elementary::exp(-time / 0.3);
    type Scatter<'s> = &'s dyn Fn(f64) -> f64;
    let cases: [(f64, u32, f64, Scatter<'_>); 7] = [
        (0.0, 60, 4.0, &even),
        (0.0, 24, 2.4, &even),
        (0.0, 400, 4.0, &even),
        (0.6, 300, 4.0, &even),
        (0.9, 1_200, 4.0, &even),
        (0.0, 100, 4.0, &grows),
        (0.0, 100, 4.0, &falls),
    ];
    let mut missed = Vec::new();
    for (memory, points, duration, scatter) in cases {
        for from_rest in [true, false] {
            let times = times(points, duration);
            let covered = coverage(|seed| {
                let noise = Noise::new(777 * seed).correlated(times.len(), memory);
                let speeds = rise(&times, STEADY, CONSTANT);
                let own = speeds.iter().zip(noise).zip(&times);
                let speeds: Vec<f64> =
                    own.map(|((speed, noise), time)| speed + scatter(*time) * noise).collect();
                let settings = FitSettings { seed, from_rest, least_duration: 2.0, ..FEW };
                fit_one(&times, &speeds, &settings)
            });
            let case = format!("memory {memory}, {points} points, {duration} s, from rest {from_rest}");
            note(case, covered, &mut missed);
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

/// A clock that is early or late, a dead time, rows before the switch-on, a start in the middle of the rise,
/// for one run and for five.
#[test]
fn the_start_of_a_record_does_not_mislead_its_fit() {
    const OWN: [f64; 2] = [21.5, 0.85];
    let clock: Vec<f64> = (0..=100).map(|i| 0.05 * f64::from(i)).collect();
    // The clock's reading at the start of the rise, the first row, and the speed at the start.
    let mut missed = Vec::new();
    for (zero, first, speed, members, noise) in [
        (-0.05, 0.0, 0.0, 5, 0.15),
        (0.02, 0.0, 0.0, 5, 0.15),
        (0.05, 0.0, 0.0, 1, 0.15),
        (0.2, 0.0, 0.0, 5, 0.15),
        (0.2, 0.0, 0.0, 1, 1.0),
        (1.0e5, 1.0e5 - 0.3, 0.0, 1, 0.15),
        (0.0, 0.0, 10.0, 5, 0.15),
        (0.0, 0.0, 30.0, 1, 1.0),
        (0.1, -0.1, 10.0, 1, 1.0),
    ] {
        let times: Vec<f64> = clock.iter().map(|time| first + time).collect();
        let mut found = [0.0; 3];
        let covered = coverage_of(OWN, |seed| {
            let mut random = Noise::new(31 * seed);
            let rise = |&time: &f64| {
                let since = (time - zero).max(0.0);
                OWN[0] - (OWN[0] - speed) * bouncing_disk_core::numerics::elementary::exp(-since / OWN[1])
            };
            let mut run = || times.iter().map(|time| rise(time) + noise * random.normal()).collect();
            let runs: Vec<Vec<f64>> = (0..members).map(|_| run()).collect();
            let fit = fit_runs(&times, &runs, &FitSettings { seed, ..FEW });
            if let Ok(fit) = fit {
                found[0] += 0.01 * fit.time_constant().value;
                found[1] += 0.01 * (fit.time_constant().high - fit.time_constant().low);
                found[2] += 0.01 * (fit.speed(zero + 0.5) - rise(&(zero + 0.5)));
            }
            fit
        });
        note(
            format!("{zero} {first} {speed}, {members} runs, noise {noise}: {found:?}"),
            covered,
            &mut missed,
        );
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

const FROM_REST: FitSettings =
    FitSettings { resamples: 1_000, seed: 1, least_duration: 3.0, largest_residual: 0.1, from_rest: true };

fn ensemble(times: &[f64], members: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut noise = Noise::new(seed);
    (0..members).map(|_| member(times, &mut noise)).collect()
}

fn fit_runs(times: &[f64], runs: &[Vec<f64>], settings: &FitSettings) -> Result<TransientFit, FitError> {
    TransientFit::of_measured(
        &runs.iter().map(|run| (times, run.as_slice())).collect::<Vec<_>>(),
        settings,
        &Unobserved,
    )
}

fn fit_one(times: &[f64], speeds: &[f64], settings: &FitSettings) -> Result<TransientFit, FitError> {
    TransientFit::of_measured(&[(times, speeds)], settings, &Unobserved)
}

/// The oracle is the golden-section search, which shares no step with the grid.
#[test]
fn the_grid_finds_the_fits_of_the_search() {
    let times = times(200, 4.0);
    let watch = Watch::begin(&Unobserved, 0, 1).expect("goes on");
    for (start, seed) in [(0.3, 1), (0.6, 2), (1.5, 3)] {
        for (shape, is_ramp) in [(exponential as fn(f64) -> f64, false), (ramp, true)] {
            let grid = ShapeGrid::new(start, shape, Start::FromRest);
            let curve = member(&times, &mut Noise::new(seed));
            let mut moments = [0.0; shape_grid::MOMENTS];
            let shapes = grid.at(&times, 0.0, &mut watch.work()).expect("goes on");
            shapes.add_curve(&[0.0; 200], 1.0, &mut moments);
            let of_speeds = &mut moments[shape_grid::SPEEDS..];
            shapes.add_speeds(0, &curve[..70], 1.0, of_speeds);
            shapes.add_speeds(70, &curve[70..], 1.0, of_speeds);
            let found = grid.best(&moments).expect("within the grid");
            let (steady, constant) = if is_ramp {
                let fit = RampFit::new(&times, &curve).expect("legal");
                (fit.steady_speed, fit.rise_time)
            } else {
                let fit = ExponentialFit::new(&times, &curve, &Unobserved).expect("legal");
                (fit.steady_speed, fit.time_constant)
            };
            let by_constant = found.log_constant - bouncing_disk_core::numerics::elementary::ln(constant);
            let by_steady = found.steady / steady - 1.0;
            // A ramp has a kink at every point, so its gain is not a parabola there.
            let tolerance = if is_ramp { 5e-3 } else { 1e-4 };
            assert!(
                by_constant.abs() < tolerance && by_steady.abs() < tolerance,
                "{by_constant} {by_steady}"
            );
        }
    }
}

#[test]
fn the_mean_curve_is_what_is_fitted() {
    let times = times(120, 4.0);
    let runs = ensemble(&times, 9, 5);
    let fit = fit_runs(&times, &runs, &FROM_REST).expect("fitted");
    let mean: Vec<f64> = (0..times.len()).map(|i| runs.iter().map(|run| run[i]).sum::<f64>() / 9.0).collect();
    let plain = ExponentialFit::new(&times, &mean, &Unobserved).expect("legal");
    assert!((fit.steady_speed().value / plain.steady_speed - 1.0).abs() < 1e-12);
    assert!((fit.time_constant().value / plain.time_constant - 1.0).abs() < 1e-6);
    assert!((fit.stall_acceleration().value / plain.stall_acceleration() - 1.0).abs() < 1e-6);
    assert!((fit.exponential.residual / plain.residual - 1.0).abs() < 1e-9);
    assert_eq!((fit.members, fit.points, fit.form), (9, 120, RiseForm::Exponential));
    assert!((fit.duration - times[119]).abs() <= 0.0);
    for estimate in [fit.steady_speed(), fit.time_constant(), fit.stall_acceleration()] {
        assert!(estimate.low < estimate.value && estimate.value < estimate.high, "{estimate:?}");
    }
    // The same runs as curves of an ensemble.
    let curves: Vec<SpeedCurve> = runs
        .iter()
        .map(|run| SpeedCurve { times: times.clone(), speeds: run.clone(), impacts: 900, separations: 100 })
        .collect();
    assert_eq!(TransientFit::new(&curves, &FROM_REST), Ok(fit));
    // The same bits if repeated, others for another seed.
    assert_eq!(fit_runs(&times, &runs, &FROM_REST), Ok(fit));
    let other = fit_runs(&times, &runs, &FitSettings { seed: 2, ..FROM_REST }).expect("fitted");
    assert_ne!(other, fit);
    assert!((other.steady_speed().high - fit.steady_speed().high).abs() < 0.2);
}

/// Four times as many members halve an interval, apart from Student's quantile.
#[test]
fn intervals_narrow_with_the_root_of_the_members() {
    let times = times(120, 4.0);
    let width = |members: usize| {
        let fits = (0..20).map(|seed| {
            let fit = fit_runs(&times, &ensemble(&times, members, seed), &FROM_REST);
            let steady = fit.expect("fitted").steady_speed();
            steady.high - steady.low
        });
        fits.sum::<f64>() / 20.0
    };
    let ratio = width(32) / width(128);
    assert!((1.7..2.4).contains(&ratio), "{ratio}");
}

#[test]
fn a_ramp_is_told_from_an_exponential() {
    let times = times(150, 4.0);
    let mut noise = Noise::new(9);
    let runs: Vec<Vec<f64>> = (0..8)
        .map(|_| times.iter().map(|time| STEADY * (time / 1.1).min(1.0) + 0.2 * noise.normal()).collect())
        .collect();
    for settings in [FROM_REST, FitSettings::default()] {
        let fit = fit_runs(&times, &runs, &settings).expect("fitted");
        assert_eq!(fit.form, RiseForm::Ramp);
        let ramp = fit.ramp.expect("fitted");
        assert!(ramp.constant.contains(1.1) && ramp.steady_speed.contains(STEADY), "{ramp:?}");
        assert!(ramp.stall_acceleration.contains(STEADY / 1.1), "{ramp:?}");
        // The better form is stated and plotted; it rises no more than the curve beyond its plateau.
        assert_eq!(fit.better(), &ramp);
        for time in times.iter().filter(|time| **time >= fit.start_time) {
            let own = STEADY * (time / 1.1).min(1.0);
            assert!((fit.better_speed(*time) - own).abs() < 0.3, "{time}");
        }
        assert!(fit.exponential.steady_speed.low > STEADY, "{:?}", fit.exponential);
    }
}

#[test]
fn curves_that_mean_nothing_are_refused_with_the_reason() {
    let of_times = |times: &[f64], speed: &dyn Fn(f64) -> f64| {
        let speeds: Vec<f64> = times.iter().map(|&time| speed(time)).collect();
        let settings = FitSettings::default();
        let by_members = refusal(fit_runs(times, &vec![speeds.clone(); 5], &settings));
        let by_one = refusal(fit_one(times, &speeds, &settings));
        assert_eq!(std::mem::discriminant(&by_members), std::mem::discriminant(&by_one), "{by_one:?}");
        by_members
    };
    let of = |speed: &dyn Fn(f64) -> f64| of_times(&times(100, 4.0), speed);
    assert_eq!(of(&|_| 0.0), FitRefusal::NoRise);
    assert!(
        matches!(of(&|time| 3.0 * time), FitRefusal::AtSearchLimit { time_constant, .. } if time_constant > 380.0)
    );
    assert!(matches!(of(&|time| -3.0 * time), FitRefusal::AtSearchLimit { .. }));
    assert_eq!(of(&|_| 7.0), FitRefusal::NoRise);
    assert!(matches!(
        of(&|time| STEADY * exponential(time / 2.0)),
        FitRefusal::TooShort { time_constant, least: 3.0, .. } if (time_constant - 2.0).abs() < 0.01
    ));
    assert!(matches!(
        of(&|time| STEADY * exponential(time / 0.08)),
        FitRefusal::TooCoarse { points: 2 | 3, least: 4, .. }
    ));
    assert!(matches!(
        of(&|time| 10.0 + 5.0 * sin(20.0 * time) - 10.0 * exponential(-0.0) - 10.0 * (1.0 - exponential(time))),
        FitRefusal::Residual { largest, .. } if largest <= 0.1
    ));
    let few = &times(7, 4.0);
    assert_eq!(of_times(few, &|time| time), FitRefusal::TooFewPoints { points: 7, least: 8 });
}

fn sin(x: f64) -> f64 {
    bouncing_disk_core::numerics::elementary::sin(x)
}

#[test]
fn a_curve_is_long_enough_from_the_least_duration_on() {
    let times = times(120, 4.0);
    let runs = ensemble(&times, 8, 3);
    let fit = fit_runs(&times, &runs, &FROM_REST).expect("fitted");
    let ratio = fit.duration / fit.time_constant().value;
    let with = |least_duration: f64| fit_runs(&times, &runs, &FitSettings { least_duration, ..FROM_REST });
    assert_eq!(with(ratio * (1.0 - 1e-12)), Ok(fit));
    assert!(matches!(refusal(with(ratio * (1.0 + 1e-12))), FitRefusal::TooShort { .. }));
    let residual = fit.exponential.residual / fit.steady_speed().value;
    let with =
        |largest_residual: f64| fit_runs(&times, &runs, &FitSettings { largest_residual, ..FROM_REST });
    assert_eq!(with(residual * (1.0 + 1e-12)), Ok(fit));
    assert!(matches!(refusal(with(residual * (1.0 - 1e-12))), FitRefusal::Residual { .. }));
}

#[test]
fn scatter_that_hides_the_constant_is_refused() {
    let times = times(40, 4.0);
    let settings = FitSettings { largest_residual: 1.0, least_duration: 1.0, ..FROM_REST };
    let (mut too_short, mut undetermined) = (0, 0);
    for seed in 0..10 {
        let mut noise = Noise::new(seed);
        let mut runs = |constant: f64, scatter: f64| -> Vec<Vec<f64>> {
            let curve = rise(&times, STEADY, constant);
            let mut own = || curve.iter().map(|speed| speed + scatter * noise.normal()).collect();
            (0..6).map(|_| own()).collect()
        };
        // The mean curve seems long enough, but may be too short.
        let members = runs(2.8, 5.0);
        let mean: Vec<f64> = (0..40).map(|i| members.iter().map(|run| run[i]).sum::<f64>() / 6.0).collect();
        let fitted = ExponentialFit::new(&times, &mean, &Unobserved).expect("legal").time_constant;
        match fit_runs(&times, &members, &settings) {
            Err(FitError::Refused(FitRefusal::TooShort { least, time_constant, duration })) => {
                assert!(least <= 1.0 && time_constant >= duration && duration > 3.9, "{time_constant}");
                too_short += u32::from(fitted < duration);
            }
            Err(FitError::Refused(_)) => {}
            Err(other) => panic!("{other:?}"),
            Ok(fit) => assert!(fit.time_constant().high < fit.duration, "{fit:?}"),
        }
        if let Err(FitError::Refused(FitRefusal::Undetermined { astray, resamples })) =
            fit_runs(&times, &runs(1.0, 40.0), &settings)
        {
            assert!(astray > 10 && resamples == 1_000, "{astray}");
            undetermined += 1;
        }
    }
    println!("{too_short} {undetermined}");
    assert!(too_short > 0 && undetermined > 0, "{too_short} {undetermined}");
}

#[test]
fn a_plateau_that_is_a_flight_is_refused() {
    let times = times(100, 4.0);
    let curve = |impacts: u64| SpeedCurve {
        times: times.clone(),
        speeds: rise(&times, STEADY, CONSTANT),
        impacts,
        separations: 1,
    };
    let fit = |impacts: u64| TransientFit::new(&vec![curve(impacts); 5], &FitSettings::default());
    assert!(
        matches!(refusal(fit(5)), FitRefusal::TooFewFlights { flights, .. } if (0.8..1.0).contains(&flights))
    );
    assert!(fit(20).is_ok());
    // Runs without a count of flights.
    let still = SpeedCurve { separations: 0, ..curve(0) };
    assert!(TransientFit::new(&vec![still; 5], &FitSettings::default()).is_ok());
}

#[test]
fn residuals_that_never_forget_are_refused() {
    let times = times(400, 4.0);
    let speeds: Vec<f64> = rise(&times, STEADY, CONSTANT)
        .iter()
        .zip(&times)
        .map(|(speed, time)| speed + sin(1.5 * time))
        .collect();
    let refused = refusal(fit_one(&times, &speeds, &FitSettings::default()));
    assert!(matches!(refused, FitRefusal::Correlated { points: 400, .. }), "{refused:?}");
}

#[test]
fn curves_of_any_size_have_intervals() {
    let ordinary = times(400, 4.0);
    let settings = FitSettings { resamples: 200, ..FitSettings::default() };
    let runs = ensemble(&ordinary, 6, 8);
    let expected = fit_runs(&ordinary, &runs, &settings).expect("fitted");
    let measured = fit_one(&ordinary, &runs[0], &settings).expect("fitted");
    for (time, speed) in
        [(1.0, 1e300), (1.0, -1e-300), (1e300, 1.0), (1e-290, 1.0), (1e-5, 1e250), (1e200, 1e-200)]
    {
        let times: Vec<f64> = ordinary.iter().map(|value| value * time).collect();
        let runs: Vec<Vec<f64>> =
            runs.iter().map(|run| run.iter().map(|value| value * speed).collect()).collect();
        let near = |own: IntervalEstimate, expected: IntervalEstimate, unit: f64| {
            let (low, high) = if unit > 0.0 { (own.low, own.high) } else { (own.high, own.low) };
            for (own, expected) in [(own.value, expected.value), (low, expected.low), (high, expected.high)] {
                assert!((own / unit / expected - 1.0).abs() < 1e-5, "{time} {speed}: {own} {expected}");
            }
        };
        let of_runs = fit_runs(&times, &runs, &settings).expect("fitted");
        let of_one = fit_one(&times, &runs[0], &settings).expect("fitted");
        for (own, expected) in [(of_runs, expected), (of_one, measured)] {
            near(own.steady_speed(), expected.steady_speed(), speed);
            near(own.time_constant(), expected.time_constant(), time);
        }
    }
    // A stall acceleration that a double cannot represent.
    let times: Vec<f64> = ordinary.iter().map(|value| value * 1e-200).collect();
    let runs: Vec<Vec<f64>> =
        runs.iter().map(|run| run.iter().map(|value| value * 1e200).collect()).collect();
    assert!(matches!(fit_runs(&times, &runs, &settings), Err(FitError::Model(Error::OutOfRange { .. }))));
}

#[test]
fn a_curve_without_scatter_has_an_interval_next_to_nothing() {
    let times = times(200, 4.0);
    let speeds = rise(&times, STEADY, CONSTANT);
    for fit in [
        fit_runs(&times, &vec![speeds.clone(); 8], &FitSettings::default()).expect("fitted"),
        fit_one(&times, &speeds, &FitSettings::default()).expect("fitted"),
    ] {
        let steady = fit.steady_speed();
        assert!(
            steady.high - steady.low < 1e-4 * STEADY && (steady.value / STEADY - 1.0).abs() < 1e-6,
            "{fit:?}"
        );
    }
}

#[test]
fn many_points_and_members_are_condensed() {
    // An ensemble with more members than groups, and a curve with more points than are fitted.
    let few = times(60, 4.0);
    let runs = ensemble(&few, 1_300, 6);
    let fit = fit_runs(&few, &runs, &FROM_REST).expect("fitted");
    assert!(fit.members == 1_300 && fit.steady_speed().contains(STEADY), "{fit:?}");
    let width = fit.steady_speed().high - fit.steady_speed().low;
    // The speed scatters by 5 % between members, and the noise of each adds little.
    let expected = 2.0 * 1.96 * 0.05 * STEADY / 1_300.0_f64.sqrt();
    assert!((0.8..1.6).contains(&(width / expected)), "{width} {expected}");
    let many = times(1_000_000, 4.0);
    let mut noise = Noise::new(2);
    let speeds: Vec<f64> = rise(&many, STEADY, CONSTANT).iter().map(|speed| speed + noise.normal()).collect();
    let fit = fit_one(&many, &speeds, &FROM_REST).expect("fitted");
    assert_eq!(fit.points, 1_000_000);
    assert!(fit.steady_speed().contains(STEADY) && fit.time_constant().contains(CONSTANT), "{fit:?}");
    assert!(fit.steady_speed().high - fit.steady_speed().low < 0.02);
}

#[test]
fn a_fit_can_be_stopped_and_its_observer_changes_nothing() {
    let times = times(120, 4.0);
    let runs = ensemble(&times, 16, 3);
    let runs: Vec<_> = runs.iter().map(|run| (times.as_slice(), run.as_slice())).collect();
    let settings = FitSettings { resamples: 4_000, ..FitSettings::default() };
    let (asked, _) = check_stops(8_000, |observer| TransientFit::of_measured(&runs, &settings, observer));
    assert!(asked > 8, "{asked}");
}

#[test]
fn illegal_curves_and_settings_are_named() {
    let times = times(100, 4.0);
    let runs = ensemble(&times, 6, 1);
    let d = FitSettings::default();
    let both = |told: &str, settings: &[FitSettings]| {
        refused(told, settings, |settings| fit_runs(&times, &runs, settings));
        refused(told, settings, |settings| fit_one(&times, &runs[0], settings));
    };
    both("resamples", &[0, 199, 100_001].map(|resamples| FitSettings { resamples, ..d }));
    let durations = [0.99, f64::NAN, f64::INFINITY];
    both("least_duration", &durations.map(|least_duration| FitSettings { least_duration, ..d }));
    let residuals = [0.0, -1.0, f64::NAN];
    both("largest_residual", &residuals.map(|largest_residual| FitSettings { largest_residual, ..d }));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut runs = runs.clone();
        runs[5][99] = bad;
        refused("speed", [()], |()| fit_runs(&times, &runs, &d));
        refused("speed", [()], |()| fit_one(&times, &runs[5], &d));
        let mut times = times.clone();
        times[99] = bad;
        refused("times of the speed curve", [()], |()| fit_runs(&times, &runs[..5], &d));
    }
    refused("number of speeds", [&times[..99]], |times| fit_runs(times, &runs, &d));
    refused("number of points of the speed curve", [()], |()| fit_one(&[], &[], &d));
    for members in [0, 2, LEAST_MEMBERS - 1] {
        let reason = FitRefusal::TooFewMembers { members, least: 5 };
        refused(reason, [()], |()| fit_runs(&times, &runs[..members], &d));
    }
    refused(FitRefusal::TooFewMembers { members: 0, least: 5 }, [()], |()| TransientFit::new(&[], &d));
    let curve = SpeedCurve { times: times.clone(), speeds: runs[0].clone(), impacts: 0, separations: 0 };
    let mut members = vec![curve; 5];
    members[3].times[7] *= 1.0 + f64::EPSILON;
    refused("time of a member (s)", [&members[..]], |members| TransientFit::new(members, &d));
    members[3].times.pop();
    refused("number of times", [&members[..]], |members| TransientFit::new(members, &d));
}

#[test]
fn a_refusal_says_why_with_its_numbers() {
    let error = FitError::Refused(FitRefusal::TooShort { duration: 0.01, time_constant: 0.0155, least: 3.0 });
    assert_eq!(
        error.to_string(),
        "the curve is not fitted: its duration of 0.01 s is less than 3.0 times the time constant, which may be \
         0.0155 s: take a longer one"
    );
}

/// The trial constants end at the largest double.
#[test]
fn a_record_that_ends_at_the_largest_times_ends_the_search() {
    let mut times = times(60, 5.0);
    times[59] = 1e308;
    let speeds = rise(&times, 20.0, 0.85);
    // Without a limit on the search this call would not return.
    let _ = TransientFit::of_measured(&[(times.as_slice(), speeds.as_slice())], &FEW, &Unobserved);
}
