use super::*;
use crate::estimate::refusal::FitRefusal;
use crate::testing::{Noise, check_stops, refused};
use bouncing_disk_core::Unobserved;

fn run(member: u32, noise: &mut Noise) -> MeasuredRun {
    let times: Vec<f64> = (0..100).map(|i| 0.04 * f64::from(i)).collect();
    let speeds = times
        .iter()
        .map(|time| {
            20.0 * (1.0 - bouncing_disk_core::numerics::elementary::exp(-time / 0.6)) + noise.normal()
        })
        .collect();
    MeasuredRun { member, times, speeds }
}

#[test]
fn one_run_is_fitted_by_its_residuals_and_several_by_their_scatter() {
    let mut noise = Noise::new(6);
    let runs: Vec<MeasuredRun> = (1..=6).map(|member| run(member, &mut noise)).collect();
    let settings = FitSettings::default();
    let one = MeasuredSpeeds::new(runs[..1].to_vec()).expect("legal");
    assert_eq!(
        one.fit(&settings, &Unobserved),
        TransientFit::of_measured(&[(&runs[0].times, &runs[0].speeds)], &settings, &Unobserved)
    );
    let several = MeasuredSpeeds::new(runs.clone()).expect("legal");
    let fit = several.fit(&settings, &Unobserved);
    assert_eq!(fit.expect("fitted").members, 6);
    let few = MeasuredSpeeds::new(runs[..2].to_vec()).expect("legal").fit(&settings, &Unobserved);
    let reason = FitRefusal::TooFewMembers { members: 2, least: 5 };
    assert_eq!(few, Err(FitError::Refused(reason)));
}

/// The same rise, sampled at different instants and for a different duration in each run.
#[test]
fn repeats_with_times_and_lengths_of_their_own_are_fitted_together() {
    let mut covered = [0; 2];
    for seed in 1..=100 {
        let mut noise = Noise::new(seed);
        let runs = (0..6).map(|member| {
            let (step, rows) = (0.03 + 0.004 * f64::from(member), 90 - 4 * member);
            let jitter =
                |i: u32| 0.3 * crate::testing::golden_spread(1_000 * seed + 100 * u64::from(member + i));
            let times: Vec<f64> = (0..rows).map(|i| step * (f64::from(i) + jitter(i))).collect();
            let steady = 20.0 + 0.3 * noise.normal();
            let speed =
                |time: &f64| steady * (1.0 - bouncing_disk_core::numerics::elementary::exp(-time / 0.6));
            let speeds = times.iter().map(|time| speed(time) + 0.5 * noise.normal()).collect();
            MeasuredRun { member, times, speeds }
        });
        let runs = MeasuredSpeeds::new(runs.collect()).expect("legal");
        let fit = runs.fit(&FitSettings { seed, ..FitSettings::default() }, &Unobserved).expect("fitted");
        assert_eq!((fit.members, fit.points), (6, 90 + 86 + 82 + 78 + 74 + 70));
        covered[0] += u32::from(fit.steady_speed().contains(20.0));
        covered[1] += u32::from(fit.time_constant().contains(0.6));
    }
    println!("{covered:?}");
    assert!(covered.iter().all(|&count| count >= 90), "{covered:?}");
}

/// An observer is called for one run and for several, and does not change the result.
#[test]
fn a_fit_can_be_watched_and_stopped() {
    let mut noise = Noise::new(6);
    let runs: Vec<MeasuredRun> = (1..=6).map(|member| run(member, &mut noise)).collect();
    let settings = FitSettings::default();
    for count in [1, 6] {
        let measured = MeasuredSpeeds::new(runs[..count].to_vec()).expect("legal");
        check_stops(2 * settings.resamples as u64, |observer| measured.fit(&settings, observer));
    }
}

#[test]
fn runs_that_cannot_be_fitted_do_not_exist() {
    let legal = run(3, &mut Noise::new(1));
    refused("runs", [Vec::new()], MeasuredSpeeds::new);
    refused("member", [vec![legal.clone(), legal.clone()]], MeasuredSpeeds::new);
    let spoilt = |change: fn(&mut MeasuredRun)| {
        let mut run = legal.clone();
        change(&mut run);
        MeasuredSpeeds::new(vec![run])
    };
    refused("number of points of the speed curve", [()], |()| spoilt(|run| run.times.clear()));
    refused("number of speeds", [()], |()| spoilt(|run| run.speeds.truncate(5)));
    refused("speed", [()], |()| spoilt(|run| run.speeds[9] = f64::NAN));
    refused("times of the speed curve", [()], |()| spoilt(|run| run.times[9] = run.times[8]));
}
