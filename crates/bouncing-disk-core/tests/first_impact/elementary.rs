//! The elementary functions against the oracle.

use std::f64::consts::{PI, TAU};

use bouncing_disk_core::numerics::elementary;

use crate::launches::SplitMix;
use crate::oracle::{self, High, PRECISION, high, low, two_pi};

/// Largest absolute error of the sine and cosine pair, as documented at [`elementary::sin_cos`].
const PAIR_ERROR: f64 = 1.3e-16;

/// The same for arguments up to 1e5, whose reduction rounds more.
const LARGE_PAIR_ERROR: f64 = 1.5e-16;

#[test]
fn the_sine_of_the_oracle_is_that_of_dashu() {
    let mut random = SplitMix::new(31);
    for k in 0..300 {
        let x = if k < 200 { random.uniform(0.0, 4.0 * PI) } else { random.decades(-12.0, 6.0) };
        let (s, c) = oracle::sin_cos(&high(x));
        let (sin, cos) = high(x).sin_cos();
        let tolerance = 1.0e-70;
        assert!(low(&(s - sin)).abs() < tolerance && low(&(c - cos)).abs() < tolerance, "at {x}");
    }
}

/// The largest absolute error of the pair at arguments from `next`.
fn largest_pair_error(arguments: u32, mut next: impl FnMut() -> f64) -> f64 {
    let mut largest = 0.0_f64;
    for _ in 0..arguments {
        let x = next();
        let (s, c) = oracle::sin_cos(&high(x.abs()));
        let s = if x < 0.0 { -s } else { s };
        let (sin, cos) = elementary::sin_cos(x);
        largest = largest.max(low(&(s - high(sin))).abs()).max(low(&(c - high(cos))).abs());
    }
    largest
}

#[test]
fn sin_cos_of_small_arguments() {
    let mut random = SplitMix::new(32);
    let error = largest_pair_error(50_000, || random.uniform(-20.0, 20.0));
    assert!(error <= PAIR_ERROR, "{error:e}");
}

#[test]
fn sin_cos_of_large_arguments() {
    let mut random = SplitMix::new(33);
    let error = largest_pair_error(50_000, || random.uniform(0.0, 1.0e5));
    assert!(error <= LARGE_PAIR_ERROR, "{error:e}");
}

#[test]
fn sin_cos_next_to_multiples_of_a_quarter_turn() {
    let mut random = SplitMix::new(34);
    let mut k = 0.0;
    let error = largest_pair_error(12_000, || {
        k += 1.0;
        k * (0.5 * PI) * (1.0 + random.sign() * random.decades(-17.0, -5.0))
    });
    assert!(error <= LARGE_PAIR_ERROR, "{error:e}");
    let error = largest_pair_error(2_000, || random.sign() * random.decades(5.0, 9.0));
    assert!(error <= LARGE_PAIR_ERROR, "{error:e}");
}

#[test]
fn sin_cos_of_tiny_arguments_is_relative() {
    let mut random = SplitMix::new(35);
    for _ in 0..2000 {
        let x = random.decades(-200.0, -0.2);
        let (s, _) = oracle::sin_cos(&high(x));
        let error = low(&(&s - high(elementary::sin_cos(x).0))).abs();
        assert!(error <= 1.0e-15 * low(&s) || x < 1.0e-60, "{error:e} at {x:e}");
    }
    assert_eq!(elementary::sin_cos(0.0), (0.0, 1.0));
}

/// Whether `value` is within a few units in the last place of the high-precision `exact`.
fn close(value: f64, exact: &High) -> bool {
    low(&(high(value) - exact)).abs() <= 4.0e-16 * low(exact).abs()
}

#[test]
fn the_rest_is_close() {
    let mut random = SplitMix::new(36);
    for _ in 0..200 {
        let x = random.uniform(-1.0, 1.0);
        assert!(close(elementary::asin(x), &high(x).asin()), "asin {x}");
        assert!(close(elementary::acos(x), &high(x).acos()), "acos {x}");
        let x = random.sign() * random.decades(-5.0, 2.0);
        assert!(close(elementary::atan(x), &high(x).atan()), "atan {x}");
        assert!(close(elementary::tan(x), &high(x).tan()), "tan {x}");
        assert!(close(elementary::exp(x), &high(x).exp()), "exp {x}");
        assert!(close(elementary::exp_m1(x), &high(x).exp_m1()), "exp_m1 {x}");
        let x = x.abs();
        assert!(close(elementary::ln(x), &high(x).ln()), "ln {x}");
        assert!(close(elementary::hypot(x, 1.0), &(high(x) * high(x) + high(1.0)).sqrt()), "hypot {x}");
        assert!(close(elementary::pow(x, 1.25), &high(x).powf(&high(1.25))), "pow {x}");
        assert!(close(elementary::atan2(x, 2.0), &(high(x) / high(2.0)).atan()), "atan2 {x}");
    }
}

#[test]
fn angles_are_wrapped() {
    let mut random = SplitMix::new(37);
    for _ in 0..2000 {
        let x = random.sign() * random.decades(-18.0, 6.0);
        let wrapped = elementary::wrapped_angle(x);
        assert!((0.0..TAU).contains(&wrapped), "{x}");
        // Turns of the double nearest to 2 pi, whose multiples are not quite whole turns.
        let turns = ((high(x) - high(wrapped)) / two_pi()).with_precision(PRECISION).value();
        let off = low(&(&turns - high(low(&turns).round()))).abs();
        assert!(off <= 1.0e-15 + 1.0e-16 * x.abs(), "{x}: {off:e}");
    }
    assert_eq!(elementary::wrapped_angle(TAU).to_bits(), 0);
    assert!(elementary::wrapped_angle(-1.0e-20) < TAU);
}
