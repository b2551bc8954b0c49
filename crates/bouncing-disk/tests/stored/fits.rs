//! Ranges and settings of fitted parameters.

use bouncing_disk::*;
use serde_json::{Value, json};

use crate::round_trip::check;

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
