use bouncing_disk_core::Unobserved;
use std::f64::consts::PI;

use bouncing_disk_core::numerics::elementary::sin;

use super::*;
use crate::motor::sensitivity::morris::{ElementaryEffects, elementary_effects};

/// A function of one point, for a batch of them.
fn batched(function: impl Fn(&[f64]) -> f64) -> impl FnMut(&[Vec<f64>]) -> Result<Vec<f64>, Error> {
    move |points| Ok(points.iter().map(|point| function(point)).collect())
}

fn holds(estimate: Estimate, truth: f64) -> bool {
    (estimate.value - truth).abs() <= 4.0 * estimate.standard_error + 1e-12
}

/// sin x + a sin^2 y + b z^4 sin x, whose variances are known (Ishigami and Homma 1990).
#[test]
fn the_function_of_ishigami_has_its_indices() {
    let (a, b) = (7.0, 0.1);
    let function = |at: &[f64]| {
        let z = at[2] * at[2];
        sin(at[0]) + a * sin(at[1]) * sin(at[1]) + b * z * z * sin(at[0])
    };
    let p4 = PI * PI * PI * PI;
    let x = 0.5 * (1.0 + b * p4 / 5.0) * (1.0 + b * p4 / 5.0);
    let y = a * a / 8.0;
    let xz = b * b * p4 * p4 * (1.0 / 18.0 - 1.0 / 50.0);
    let variance = x + y + xz;
    let truth = [(x, x + xz), (y, y), (0.0, xz)];
    let settings = SamplingSettings { rows: 4_000, seed: 3 };
    let indices = sobol_indices(batched(function), &[[-PI, PI]; 3], settings, &Unobserved).unwrap();
    for (indices, (first, total)) in indices.iter().zip(truth) {
        assert!(
            holds(indices.first, first / variance) && holds(indices.total, total / variance),
            "{indices:?}"
        );
        assert!(indices.first.standard_error < 0.05 && indices.total.standard_error < 0.05, "{indices:?}");
    }
}

/// The product of (|4 x - 2| + a)/(1 + a) over the unit cube (Saltelli and Sobol' 1995).
#[test]
fn the_g_function_has_its_indices() {
    let weights = [0.0, 1.0, 4.5, 99.0];
    let function = |at: &[f64]| {
        at.iter().zip(weights).map(|(x, a)| ((4.0 * x - 2.0).abs() + a) / (1.0 + a)).product::<f64>()
    };
    let partial = weights.map(|a: f64| 1.0 / (3.0 * (1.0 + a) * (1.0 + a)));
    let variance = partial.iter().map(|v| 1.0 + v).product::<f64>() - 1.0;
    let settings = SamplingSettings { rows: 4_000, seed: 11 };
    let indices = sobol_indices(batched(function), &[[0.0, 1.0]; 4], settings, &Unobserved).unwrap();
    for (own, indices) in indices.iter().enumerate() {
        let others: f64 = (0..4).filter(|other| *other != own).map(|other| 1.0 + partial[other]).product();
        assert!(holds(indices.first, partial[own] / variance), "{own} {indices:?}");
        assert!(holds(indices.total, partial[own] * others / variance), "{own} {indices:?}");
    }
}

/// The standard errors are those of samples with other seeds.
#[test]
fn the_errors_are_those_of_other_samples() {
    let function = |at: &[f64]| at[0] + at[0] * at[1];
    // Variances over the unit square: 9/4 x/12 ..., by hand: first 3/16, 1/48, both 1/144.
    let (first, second, both) = (2.25 / 12.0, 0.25 / 12.0, 1.0 / 144.0);
    let variance = first + second + both;
    let (mut inside, mut tried) = (0, 0);
    for seed in 0..50 {
        let settings = SamplingSettings { rows: 200, seed };
        let indices = sobol_indices(batched(function), &[[0.0, 1.0]; 2], settings, &Unobserved).unwrap();
        for (estimate, truth) in [
            (indices[0].first, first / variance),
            (indices[0].total, (first + both) / variance),
            (indices[1].first, second / variance),
            (indices[1].total, (second + both) / variance),
        ] {
            tried += 1;
            inside += u32::from((estimate.value - truth).abs() <= 1.96 * estimate.standard_error);
        }
    }
    assert_eq!(tried, 200);
    assert!((176..=200).contains(&inside), "{inside} of {tried}");
}

#[test]
fn elementary_effects_are_slopes() {
    let function = |at: &[f64]| 3.0 * at[0] - 2.0 * at[1] + at[2] * at[3];
    let settings = SamplingSettings { rows: 200, seed: 5 };
    let ranges = [[0.0, 2.0], [-1.0, 3.0], [-1.0, 1.0], [-1.0, 1.0]];
    let effects = elementary_effects(batched(function), &ranges, settings, &Unobserved).unwrap();
    for (effects, slope) in effects.iter().zip([6.0, -8.0]) {
        let ElementaryEffects { mean, mean_size, deviation } = *effects;
        assert!((mean.value - slope).abs() < 1e-12 && (mean_size.value - slope.abs()).abs() < 1e-12);
        assert!(deviation.value < 1e-12 && mean.standard_error < 1e-12, "{effects:?}");
    }
    // The effect of z is 2 y over its range, with y even on the levels or a step away: mean zero, by the
    // error it says.
    for effects in &effects[2..] {
        assert!(holds(effects.mean, 0.0) && effects.deviation.value > 0.8, "{effects:?}");
        assert!(effects.mean_size.value > 0.8 && effects.mean_size.value < 1.5, "{effects:?}");
    }
}

#[test]
fn what_does_not_change_has_no_share() {
    let settings = SamplingSettings { rows: 8, seed: 0 };
    let indices = sobol_indices(batched(|_| 7.0), &[[0.0, 1.0]; 2], settings, &Unobserved).unwrap();
    for indices in indices {
        for estimate in [indices.first, indices.total] {
            assert!(estimate.value.abs() <= 0.0 && estimate.standard_error.abs() <= 0.0, "{indices:?}");
        }
    }
    // A range without width does not change anything, either.
    let indices =
        sobol_indices(batched(|at| at[0] + at[1]), &[[0.0, 1.0], [5.0; 2]], settings, &Unobserved).unwrap();
    assert!(indices[1].total.value.abs() <= 0.0 && (indices[0].total.value - 1.0).abs() < 0.8, "{indices:?}");
    assert!(!indices[0].total.standard_error.is_nan());
}

#[test]
fn samples_that_are_none_are_refused_by_name() {
    let of = |ranges: &[[f64; 2]], rows: usize| {
        let settings = SamplingSettings { rows, seed: 0 };
        sobol_indices(batched(|at| at[0]), ranges, settings, &Unobserved).expect_err("illegal").to_string()
    };
    for (ranges, rows, name) in [
        (vec![], 8, "number of ranges"),
        (vec![[0.0, 1.0]; 65], 8, "number of ranges"),
        (vec![[0.0, 1.0]], 7, "rows"),
        (vec![[0.0, 1.0]], 0, "rows"),
        (vec![[0.0, 1.0]], 1_000_001, "rows"),
        (vec![[f64::NAN, 1.0]], 8, "range (low)"),
        (vec![[0.0, f64::INFINITY]], 8, "range (high)"),
        (vec![[1.0, 0.0]], 8, "range (high)"),
        (vec![[-1e308, 1e308]], 8, "range (width)"),
    ] {
        assert!(of(&ranges, rows).contains(name), "{name}: {}", of(&ranges, rows));
    }
    let settings = SamplingSettings { rows: 8, seed: 0 };
    let error =
        sobol_indices(batched(|_| f64::NAN), &[[0.0, 1.0]], settings, &Unobserved).expect_err("no number");
    assert!(error.to_string().contains("value"), "{error}");
    let few = |points: &[Vec<f64>]| Ok(vec![0.0; points.len() - 1]);
    assert!(sobol_indices(few, &[[0.0, 1.0]], settings, &Unobserved).is_err());
    let own = Error::NotGiven { field: "anything" };
    assert_eq!(sobol_indices(|_| Err(own), &[[0.0, 1.0]], settings, &Unobserved), Err(own));
    assert_eq!(elementary_effects(|_| Err(own), &[[0.0, 1.0]], settings, &Unobserved), Err(own));
    let stop = |_: bouncing_disk_core::Progress| std::ops::ControlFlow::Break(());
    assert!(sobol_indices(batched(|at| at[0]), &[[0.0, 1.0]], settings, &stop).is_err());
}
