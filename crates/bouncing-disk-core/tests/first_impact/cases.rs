//! The stored cases: hard launches with high-precision answers, in `data/cases/first_impact.json`.
//!
//! The answers come from the oracle's conservative advancement alone, independent of all solvers of the
//! crate. Set `UPDATE_CASES=1` to rewrite the file.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::str::FromStr;

use bouncing_disk_core::flight::reference::first_impact_by_advancement;
use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use serde_json::Value;

use crate::launches::{self, Case, SplitMix};
use crate::oracle::{
    self, Exact, High, PHASE_FACTOR, PHASE_TOLERANCE, PRECISION, U, VELOCITY_FACTOR, high, low,
};
use crate::oracle::{DIP_FACTOR, two_pi};

/// Significant digits of the stored answers.
const DIGITS: usize = 40;

/// Allowed error of the reference solver in conditioning limits, in addition to [`PHASE_FACTOR`]: near a
/// graze its steps are shorter than the rounding of the gap allows.
const REFERENCE_FACTOR: f64 = 40.0;

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../data/cases/first_impact.json")
}

/// The launches to store: only clearly decidable ones.
fn launches() -> Vec<Case> {
    let mut random = SplitMix::new(2009);
    let mut cases = launches::TRAPS.to_vec();
    let mut add = |count: usize, next: &dyn Fn(&mut SplitMix) -> Option<Case>| {
        let end = cases.len() + count;
        while cases.len() < end {
            cases.extend(next(&mut random));
        }
    };
    add(70, &|random| launches::grazing_to(random, -11.0));
    add(45, &launches::slow_touch);
    add(40, &|random| Some(launches::separation(random)));
    add(35, &|random| Some(launches::boundary(random)));
    add(35, &|random| Some(launches::chattering(random)));
    add(15, &|random| Some(launches::whole_periods(random)));
    add(60, &|random| Some(launches::random(random)));
    cases
}

fn decimal(x: &High) -> String {
    let decimal = x.clone().with_base_and_precision::<10>(DIGITS).value();
    format!("{decimal:e}")
}

/// A double as JSON text that reads back as the same double.
fn number(x: f64) -> String {
    format!("{x:?}")
}

/// The expected content of the file; launches without one clear answer are omitted.
fn text() -> String {
    let mut lines = Vec::new();
    for case in launches() {
        let exact = Exact::new(&case);
        let Ok(solution) = exact.first_root() else { continue };
        if exact.smallest_dip_before(&solution.duration) < 100.0 * DIP_FACTOR {
            continue;
        }
        let angle = if case.separation { "null".into() } else { number(case.angle) };
        let mut line = String::new();
        write!(
            line,
            "    {{\"class\": \"{}\", \"peak_acceleration\": {}, \"launch_phase\": {angle}, \"relative_speed\": {}, ",
            case.class,
            number(case.peak),
            number(case.speed)
        )
        .unwrap();
        write!(
            line,
            "\"duration\": \"{}\", \"impact_phase\": \"{}\", \"velocity\": \"{}\", ",
            decimal(&solution.duration),
            decimal(&solution.phase),
            decimal(&solution.velocity)
        )
        .unwrap();
        write!(
            line,
            "\"phase_limit\": \"{:.3e}\", \"velocity_limit\": \"{:.3e}\"}}",
            solution.limits.phase, solution.limits.velocity
        )
        .unwrap();
        lines.push(line);
    }
    format!("{{\n  \"cases\": [\n{}\n  ]\n}}\n", lines.join(",\n"))
}

#[test]
fn the_file_is_what_the_oracle_says() {
    let text = text();
    if std::env::var_os("UPDATE_CASES").is_some() {
        std::fs::write(path(), &text).unwrap();
    }
    let stored = std::fs::read_to_string(path()).unwrap();
    for (line, (new, old)) in text.lines().zip(stored.lines()).enumerate() {
        assert_eq!(new, old, "line {} of {}; UPDATE_CASES=1 writes it anew", line + 1, path().display());
    }
    assert_eq!(text.len(), stored.len());
}

/// A stored case.
struct Stored {
    case: Case,
    phase: High,
    duration: High,
    velocity: High,
    phase_limit: f64,
    velocity_limit: f64,
}

fn stored() -> Vec<Stored> {
    let text = std::fs::read_to_string(path()).unwrap();
    let file: Value = serde_json::from_str(&text).unwrap();
    let parsed = |case: &Value| {
        let double = |key: &str| case[key].as_f64().unwrap();
        let string = |key: &str| case[key].as_str().unwrap().to_owned();
        let digits = |key: &str| {
            let decimal = FBig::<HalfEven, 10>::from_str(&string(key)).unwrap();
            decimal.with_base_and_precision::<2>(PRECISION).value()
        };
        Stored {
            case: Case {
                class: "stored",
                peak: double("peak_acceleration"),
                angle: case["launch_phase"].as_f64().unwrap_or(0.0),
                speed: double("relative_speed"),
                separation: case["launch_phase"].is_null(),
            },
            phase: digits("impact_phase"),
            duration: digits("duration"),
            velocity: digits("velocity"),
            phase_limit: string("phase_limit").parse().unwrap(),
            velocity_limit: string("velocity_limit").parse().unwrap(),
        }
    };
    file["cases"].as_array().unwrap().iter().map(parsed).collect()
}

/// Distance of two phases on the circle.
fn apart(angle: f64, phase: &High) -> f64 {
    let ahead = low(&(high(angle) - phase)).abs();
    ahead.min(low(&(two_pi() - high(ahead))).abs())
}

#[test]
fn the_solver_agrees_with_the_file() {
    let cases = stored();
    assert!(cases.len() >= 250);
    for stored in cases {
        let (vibration, launch) = oracle::launch(&stored.case);
        let impact = vibration.first_impact(launch).unwrap();
        let error = apart(impact.phase.angle(), &stored.phase);
        let limit = PHASE_TOLERANCE.max(PHASE_FACTOR * stored.phase_limit);
        assert!(error <= limit, "{:?}: phase {error:e} off, limit {limit:e}", stored.case);
        let duration = two_pi() * high(impact.periods as f64) + high(impact.remainder);
        let error = low(&(duration - &stored.duration)).abs();
        assert!(error <= limit, "{:?}: duration {error:e} off, limit {limit:e}", stored.case);
        let error = low(&(high(impact.velocity) - &stored.velocity)).abs();
        let limit = VELOCITY_FACTOR * stored.velocity_limit;
        assert!(error <= limit, "{:?}: velocity {error:e} off, limit {limit:e}", stored.case);
    }
}

#[test]
fn the_reference_solver_agrees_with_the_file() {
    for stored in stored() {
        let (vibration, launch) = oracle::launch(&stored.case);
        let impact = first_impact_by_advancement(&vibration, launch).unwrap();
        // Its time carries the rounding of the whole duration.
        let rounding = 16.0 * U * low(&stored.duration);
        let limit = PHASE_TOLERANCE + REFERENCE_FACTOR * stored.phase_limit + rounding;
        let error = apart(impact.impact_phase, &stored.phase);
        assert!(error <= limit, "{:?}: phase {error:e} off, limit {limit:e}", stored.case);
        let error = low(&(high(impact.duration) - &stored.duration)).abs();
        assert!(error <= limit, "{:?}: duration {error:e} off, limit {limit:e}", stored.case);
        let error = low(&(high(impact.velocity) - &stored.velocity)).abs();
        let limit = REFERENCE_FACTOR * stored.velocity_limit + (1.0 + stored.case.peak) * rounding;
        assert!(error <= limit, "{:?}: velocity {error:e} off, limit {limit:e}", stored.case);
    }
}

#[test]
fn the_two_solvers_agree() {
    let mut random = SplitMix::new(41);
    for _ in 0..20_000 {
        let case = launches::random(&mut random);
        let (vibration, launch) = oracle::launch(&case);
        let impact = vibration.first_impact(launch).unwrap();
        let other = first_impact_by_advancement(&vibration, launch).unwrap();
        let tolerance = 1.0e-9 * (1.0 + impact.duration());
        assert!((impact.duration() - other.duration).abs() <= tolerance, "{case:?}: {impact:?} {other:?}");
    }
}
