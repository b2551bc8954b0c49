use super::*;
use crate::motor::fit_refusal::FitRefusal;
use crate::testing::Noise;

fn run(member: u32, noise: &mut Noise) -> MeasuredRun {
    let times: Vec<f64> = (0..100).map(|i| 0.04 * f64::from(i)).collect();
    let speeds = times
        .iter()
        .map(|time| 20.0 * (1.0 - bouncing_disk_core::elementary::exp(-time / 0.6)) + noise.normal())
        .collect();
    MeasuredRun { member, times, speeds }
}

fn field<T: std::fmt::Debug>(result: Result<T, Error>) -> &'static str {
    match result {
        Err(Error::OutOfRange { field, .. }) => field,
        other => panic!("{other:?}"),
    }
}

#[test]
fn one_run_is_fitted_by_its_residuals_and_several_by_their_scatter() {
    let mut noise = Noise::new(6);
    let runs: Vec<MeasuredRun> = (1..=6).map(|member| run(member, &mut noise)).collect();
    let settings = FitSettings::default();
    let one = MeasuredSpeeds::new(runs[..1].to_vec()).expect("legal");
    assert_eq!(one.fit(&settings), TransientFit::of_measured(&runs[0].times, &runs[0].speeds, &settings));
    let several = MeasuredSpeeds::new(runs.clone()).expect("legal");
    let speeds: Vec<&[f64]> = runs.iter().map(|run| run.speeds.as_slice()).collect();
    let fit = several.fit(&settings);
    assert_eq!(fit, TransientFit::of_runs(&runs[0].times, &speeds, &settings));
    assert_eq!(fit.expect("fitted").members, 6);
    let few = MeasuredSpeeds::new(runs[..2].to_vec()).expect("legal").fit(&settings);
    let reason = FitRefusal::TooFewMembers { members: 2, least: 5 };
    assert_eq!(few, Err(Error::FitRefused { reason }));
    let mut others = runs.clone();
    others[4].times[50] += 1e-3;
    assert_eq!(field(MeasuredSpeeds::new(others).expect("legal").fit(&settings)), "time of a run (s)");
    let mut others = runs;
    others[4].times.pop();
    others[4].speeds.pop();
    assert_eq!(field(MeasuredSpeeds::new(others).expect("legal").fit(&settings)), "number of times of a run");
}

/// An observer is heard of one run and of several, and changes no bit.
#[test]
fn a_fit_can_be_watched_and_stopped() {
    use std::ops::ControlFlow;
    use std::sync::atomic::{AtomicU64, Ordering};

    use bouncing_disk_core::Progress;

    let mut noise = Noise::new(6);
    let runs: Vec<MeasuredRun> = (1..=6).map(|member| run(member, &mut noise)).collect();
    let settings = FitSettings::default();
    for count in [1, 6] {
        let measured = MeasuredSpeeds::new(runs[..count].to_vec()).expect("legal");
        let calls = AtomicU64::new(0);
        let counted = |_: Progress| {
            calls.fetch_add(1, Ordering::Relaxed);
            ControlFlow::Continue(())
        };
        assert_eq!(measured.fit_observed(&settings, &counted), measured.fit(&settings));
        assert!(calls.into_inner() >= 2);
        let stopped = measured.fit_observed(&settings, &|_: Progress| ControlFlow::Break(()));
        assert!(matches!(stopped, Err(Error::Core(bouncing_disk_core::Error::Stopped { done: 0, .. }))));
    }
}

#[test]
fn each_run_brakes_by_its_own_friction() {
    let rotor = BrakingRotor { normal_force: 0.5, mass: 0.05, contact_radius: 0.002, gyration_radius: 0.01 };
    let run = |member: u32| {
        let times: Vec<f64> = (0..100).map(|i| 0.01 * f64::from(i)).collect();
        let speeds = times.iter().map(|time| 50.0 - 10.0 * f64::from(member) * time).collect();
        MeasuredRun { member, times, speeds }
    };
    let measured = MeasuredSpeeds::new(vec![run(1), run(2)]).expect("legal");
    let fits = measured.fit_braking(&rotor).expect("fitted");
    assert!((fits[0].friction.value - 0.05).abs() < 1e-12 && (fits[1].friction.value - 0.1).abs() < 1e-12);
    let measured = MeasuredSpeeds::new(vec![run(0), run(2)]).expect("legal");
    assert!(matches!(measured.fit_braking(&rotor), Err(Error::FitRefused { .. })));
}

#[test]
fn runs_that_cannot_be_fitted_do_not_exist() {
    let legal = run(3, &mut Noise::new(1));
    assert_eq!(field(MeasuredSpeeds::new(Vec::new())), "runs");
    assert_eq!(field(MeasuredSpeeds::new(vec![legal.clone(), legal.clone()])), "member");
    let spoilt = |change: &dyn Fn(&mut MeasuredRun)| {
        let mut run = legal.clone();
        change(&mut run);
        field(MeasuredSpeeds::new(vec![run]))
    };
    assert_eq!(spoilt(&|run| run.times.clear()), "number of points of the speed curve");
    assert_eq!(spoilt(&|run| run.speeds.truncate(5)), "number of speeds");
    assert_eq!(spoilt(&|run| run.speeds[9] = f64::NAN), "speed");
    assert_eq!(spoilt(&|run| run.times[9] = run.times[8]), "times of the speed curve");
    assert_eq!(spoilt(&|run| run.times[0] = -1e-300), "times of the speed curve");
}

#[cfg(feature = "serde")]
#[test]
fn measured_speeds_that_are_read_are_legal() {
    let measured = MeasuredSpeeds::new(vec![run(3, &mut Noise::new(1))]).expect("legal");
    let text = serde_json::to_string(&measured).expect("writes");
    assert_eq!(serde_json::from_str::<MeasuredSpeeds>(&text).expect("legal"), measured);
    assert!(serde_json::from_str::<MeasuredSpeeds>(&text.replace("[0.0,0.04", "[0.0,0.0")).is_err());
    assert!(serde_json::from_str::<MeasuredSpeeds>("{\"runs\":[]}").is_err());
}
