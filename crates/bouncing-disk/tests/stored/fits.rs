//! Parameters fitted to transients, and what they are fitted to.

use bouncing_disk::*;
use serde_json::{Value, json};

use crate::round_trip::{check, refused};

fn estimate(parameter: FitParameter, nominal: f64, ends: Option<(f64, f64)>) -> ParameterEstimate {
    let interval = |(low, high): (f64, f64)| IntervalEstimate { value: 0.5 * (low + high), low, high };
    ParameterEstimate { parameter, nominal, estimate: ends.map(interval) }
}

fn fit() -> ParameterFit {
    let direction = UndeterminedDirection {
        direction: vec![(FitParameter::Friction, -1.0 / 3.0), (FitParameter::PhaseLag, 1.0)],
        standard_error: f64::INFINITY,
    };
    ParameterFit {
        parameters: vec![
            estimate(FitParameter::Friction, 0.1, Some((0.19, 0.22))),
            estimate(FitParameter::PhaseLag, 0.5, None),
        ],
        undetermined: vec![direction],
        motor: Motor::paper_70_khz().with(|sheet| sheet.friction = 0.205).expect("legal"),
        misfit: 4.0 / 3.0,
        degrees_of_freedom: 5,
        evaluations: 17,
    }
}

#[test]
fn ranges_and_settings() {
    let friction = FitRange { parameter: FitParameter::Friction, low: 0.05, high: 1.0 / 3.0 };
    check(
        &friction,
        &[
            ("/low", json!(0.0), "friction = 0"),
            ("/low", json!(0.5), "upper end of a range"),
            ("/high", json!(0.05), "upper end of a range"),
            ("/parameter", json!("Mass"), "Mass"),
            ("/high", Value::Null, "null"),
        ],
    );
    let restitution = FitRange { parameter: FitParameter::Restitution, low: 0.0, high: 0.9 };
    check(
        &restitution,
        &[("/high", json!(1.0), "restitution = 1"), ("/low", json!(-1e-300), "restitution = -1e-300")],
    );
    let lag = FitRange { parameter: FitParameter::PhaseLag, low: -3.0, high: 3.0 };
    check(&lag, &[("/high", json!(3.3), "width of the range of the phase lag")]);
    let settings = ParameterFitSettings { seed: u64::MAX, ..ParameterFitSettings::default() };
    check(
        &settings,
        &[
            ("/members", json!(23), "members"),
            ("/members", json!(4097), "members"),
            ("/windows", json!(0), "windows"),
            ("/windows", json!(13), "windows"),
            ("/relaunch_perturbation", json!(0.0), "relaunch_perturbation"),
            ("/relaunch_perturbation", json!(1.5), "relaunch_perturbation"),
            ("/most_evaluations", json!(0), "most_evaluations"),
            ("/resamples", json!(199), "resamples"),
            ("/largest_misfit", json!(0.5), "largest_misfit"),
            ("/seed", json!(-1), "-1"),
        ],
    );
}

#[test]
fn estimates_and_directions() {
    let amplitude = estimate(FitParameter::Amplitude, 1.0e-8, Some((5.0e-324, 3.0e-8)));
    check(
        &amplitude,
        &[
            ("/nominal", json!(0.0), "nominal = 0"),
            ("/estimate/low", json!(0.0), "low = 0"),
            ("/estimate/low", json!(2.0e-8), "low = 2e-8"),
            ("/estimate/high", json!(0.0), "high = 0"),
        ],
    );
    let restitution = estimate(FitParameter::Restitution, 0.5, Some((0.0, 0.75)));
    check(
        &restitution,
        &[
            ("/nominal", json!(1.0), "nominal = 1"),
            ("/estimate/low", json!(-0.1), "low = -0.1"),
            ("/estimate/high", json!(1.0), "high = 1"),
        ],
    );
    check(&estimate(FitParameter::PhaseLag, -7.0, None), &[("/nominal", Value::Null, "null")]);
    for standard_error in [5.0e-324, 2.5, f64::INFINITY] {
        let direction = UndeterminedDirection { standard_error, ..fit().undetermined[0].clone() };
        check(
            &direction,
            &[
                ("/standard_error", json!(0.0), "standard_error = 0"),
                ("/standard_error", json!(-1.0), "standard_error = -1"),
                ("/direction", json!([]), "direction"),
                ("/direction/0/1", json!(-1.5), "direction = -1.5"),
                ("/direction/1/1", json!(0.5), "direction = 0.5"),
                ("/direction/1/1", json!(-1.0), "direction = -0.3"),
                ("/direction/1/0", json!("Friction"), "friction = 2"),
            ],
        );
    }
}

#[test]
fn a_fit() {
    check(
        &fit(),
        &[
            ("/parameters", json!([]), "parameters"),
            ("/parameters/1/parameter", json!("Friction"), "friction = 2"),
            ("/parameters/0/nominal", json!(-0.1), "nominal = -0.1"),
            ("/undetermined/0/direction", json!([["Friction", 1.0]]), "direction = 1"),
            ("/undetermined/0/direction/0/0", json!("Amplitude"), "direction = 2"),
            ("/undetermined/0/standard_error", json!(0.0), "standard_error"),
            ("/motor/friction", json!(-1.0), "friction"),
            ("/misfit", json!(-1.0), "misfit"),
            ("/evaluations", json!(0), "evaluations"),
            ("/degrees_of_freedom", json!(-1), "-1"),
        ],
    );
    let mut crowded = fit();
    crowded.undetermined = vec![crowded.undetermined[0].clone(); 3];
    let text = serde_json::to_string(&crowded).expect("writes");
    let refusal = serde_json::from_str::<ParameterFit>(&text).expect_err("three of two").to_string();
    assert!(refusal.contains("undetermined = 3"), "{refusal}");
}

/// What JSON cannot hold, a binary format can.
#[test]
fn numbers_that_are_none_are_refused() {
    for bad in [f64::NAN, f64::INFINITY] {
        refused(&ParameterFit { misfit: bad, ..fit() }, "misfit");
        let mut spoilt = fit();
        spoilt.undetermined[0].direction[0].1 = -bad;
        refused(&spoilt, "direction");
        let mut spoilt = fit();
        spoilt.parameters[1].nominal = bad;
        refused(&spoilt, "nominal");
        refused(&MeasuredTransient { speed_error: Some(bad), ..transient() }, "speed_error");
        refused(&MeasuredTransient { preload: RunPreload::Force(bad), ..transient() }, "preload");
    }
    let mut spoilt = fit();
    spoilt.undetermined[0].standard_error = f64::NAN;
    refused(&spoilt, "standard_error");
}

fn transient() -> MeasuredTransient {
    let times: Vec<f64> = (0..8).map(|k| 0.01 * f64::from(k + 1)).collect();
    let speeds = times.iter().map(|time| 20.0 * time / 3.0).collect();
    MeasuredTransient {
        preload: RunPreload::Acceleration(9.8),
        runs: MeasuredSpeeds::new(vec![MeasuredRun { member: 3, times, speeds }]).expect("legal"),
        speed_error: Some(0.1),
    }
}

#[test]
fn transients() {
    check(
        &transient(),
        &[
            ("/preload", json!({ "Acceleration": 0.0 }), "preload"),
            ("/preload", json!({ "Force": -1.0 }), "preload"),
            ("/speed_error", json!(-0.1), "speed_error"),
            ("/runs/runs/0/times/1", json!(0.0), "time"),
        ],
    );
    check(&MeasuredTransient { preload: RunPreload::Force(2.0), speed_error: None, ..transient() }, &[]);
}
