use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

use super::*;
use crate::numerics::error::Error;
use crate::numerics::random::SplitMix64;

type High = FBig<HalfEven, 2>;

/// The exact number, with precision to spare for the operations of the oracle.
fn exact(x: DoubleDouble) -> High {
    let part = |x: f64| High::try_from(x).unwrap().with_precision(500).value();
    part(x.high) + part(x.low)
}

/// The error of a number relative to a size.
fn error(x: DoubleDouble, expected: &High, size: f64) -> f64 {
    ((exact(x) - expected).to_f64().value() / size).abs()
}

/// Numbers of many sizes and both signs, with 106 bits.
fn random_number(random: &mut SplitMix64, decades: f64) -> DoubleDouble {
    let size = libm::exp10(decades * (2.0 * random.unit() - 1.0));
    let high = size * (2.0 * random.unit() - 1.0);
    DoubleDouble::from(high) + DoubleDouble::from(high * 1.1e-16 * (2.0 * random.unit() - 1.0))
}

#[test]
fn the_four_operations_and_the_root_have_a_hundred_bits() {
    let mut random = SplitMix64::new(1);
    for _ in 0..2_000 {
        let (a, b) = (random_number(&mut random, 30.0), random_number(&mut random, 30.0));
        let (x, y) = (exact(a), exact(b));
        let sum = &x + &y;
        assert!(error(a + b, &sum, sum.to_f64().value()) < 1.3e-31, "{a:?} + {b:?}");
        let near = a + DoubleDouble::from(a.high * 1e-20) * b / b.abs();
        let difference = exact(near) - &x;
        assert!(error(near - a, &difference, difference.to_f64().value()) < 1.3e-31, "{near:?} - {a:?}");
        let product = &x * &y;
        assert!(error(a * b, &product, product.to_f64().value()) < 1.3e-31, "{a:?} * {b:?}");
        let quotient = &x / &y;
        assert!(error(a / b, &quotient, quotient.to_f64().value()) < 1.3e-31, "{a:?} / {b:?}");
        let root = a.abs().sqrt();
        let square = exact(root) * exact(root);
        assert!(error(a.abs(), &square, a.high) < 1.3e-31, "{a:?}");
        assert!(root.is_finite() && root.high.to_bits() == (root.high + root.low).to_bits(), "{root:?}");
    }
}

#[test]
fn sine_and_cosine_have_thirty_one_digits() {
    let mut random = SplitMix64::new(2);
    for k in 0..400 {
        let mut x = random_number(&mut random, 1.0);
        // Near every multiple of an eighth of a turn, where quadrant and series change.
        if k % 2 == 0 {
            x = DoubleDouble::PI * DoubleDouble::from(0.25 * f64::from(k / 2 - 100))
                + x * x * DoubleDouble::from(1e-18);
        }
        let (sin, cos) = x.sin_cos();
        let (s, c) = exact(x).sin_cos();
        assert!(error(sin, &s, 1.0) < 2e-32, "sin {x}: {:e}", error(sin, &s, 1.0));
        assert!(error(cos, &c, 1.0) < 2e-32, "cos {x}: {:e}", error(cos, &c, 1.0));
    }
    let (sin, cos) = DoubleDouble::ZERO.sin_cos();
    assert_eq!((sin, cos), (DoubleDouble::ZERO, DoubleDouble::ONE));
}

#[test]
fn what_is_outside_the_range_is_no_number() {
    for x in [f64::NAN, f64::INFINITY, -f64::INFINITY, LARGEST_ANGLE] {
        let (sin, cos) = DoubleDouble::from(x).sin_cos();
        assert!(!sin.is_finite() && !cos.is_finite(), "{x}");
    }
    assert!(DoubleDouble::from(LARGEST_ANGLE.next_down()).sin_cos().0.is_finite());
    assert!(!DoubleDouble::from(-1.0).sqrt().is_finite());
    assert_eq!(DoubleDouble::ZERO.sqrt(), DoubleDouble::ZERO);
    assert!(!(DoubleDouble::ONE / DoubleDouble::ZERO).is_finite());
}

/// The constants agree with the oracle to the last bit.
#[test]
fn constants_are_rounded_from_more_digits() {
    let pi = High::pi(500);
    assert!(error(DoubleDouble::PI, &pi, 1.0) < 2.0 * HALF_PI[2].abs() * 1.001);
    let mut factorial = High::from(1).with_precision(500).value();
    for k in 2..=29_u32 {
        factorial *= High::from(k);
        let (high, low) = INVERSE_FACTORIALS[k as usize - 2];
        let inverse = High::from(1).with_precision(500).value() / &factorial;
        assert!(error(DoubleDouble { high, low }, &inverse, high) < 1.3e-32, "{k}");
    }
}

#[test]
fn digits_are_written_as_they_are() {
    let pi = "3.14159265358979323846264338327950288419716939937510";
    assert_eq!(format!("{:.31}", DoubleDouble::PI), &pi[..33]);
    assert_eq!(format!("{:.0}", DoubleDouble::PI), "3");
    assert_eq!(format!("{:.5}", -DoubleDouble::PI), "-3.14159");
    // The tail may have the other sign, and a carry run through.
    let below_one = DoubleDouble::ONE - DoubleDouble::from(1e-25);
    assert_eq!(format!("{below_one:.26}"), "0.99999999999999999999999990");
    assert_eq!(format!("{below_one:.20}"), "1.00000000000000000000");
    assert_eq!(format!("{:.2}", DoubleDouble::from(9.999)), "10.00");
    assert_eq!(format!("{:.3}", DoubleDouble::ZERO), "0.000");
    assert_eq!(DoubleDouble::from(0.25).to_string(), "0.250000000000000000000000000000000");
    assert_eq!(DoubleDouble::from(1e22).to_string(), "10000000000000000000000.0000000000");
    assert_eq!(DoubleDouble::from(f64::NAN).to_string(), "NaN");
    assert_eq!(DoubleDouble::from(5e-324).to_string().len(), 2 + 324 + 32);
}

#[test]
fn what_is_written_is_read() {
    let mut random = SplitMix64::new(3);
    for _ in 0..300 {
        let x = random_number(&mut random, 20.0);
        let read: DoubleDouble = x.to_string().parse().expect("a number");
        assert!(error(read, &exact(x), x.high) < 4e-32, "{x}");
    }
    let read = |text: &str| text.parse::<DoubleDouble>();
    let tenth = DoubleDouble::ONE / DoubleDouble::from(10.0);
    for text in
        ["0.1", ".1", "1e-1", "+0.1", "0.01e1", "100E-3", "0.1000000000000000000000000000000000000000000000"]
    {
        assert_eq!(read(text), Ok(tenth), "{text}");
    }
    assert_eq!(read("-0.1"), Ok(-tenth));
    assert_eq!(read("0e999999999"), Ok(DoubleDouble::ZERO));
    assert_eq!(read("1."), Ok(DoubleDouble::ONE));
    for (text, at) in
        [("", 0), ("-", 1), (".", 1), ("1x", 1), ("1.2.3", 3), ("e5", 0), ("1e", 2), ("1e1.5", 2), ("nan", 0)]
    {
        assert_eq!(read(text), Err(Error::NoDecimal { at }), "{text}");
    }
    for text in ["1e281", "1e-251", "1e2147483647", "1e-2147483648"] {
        assert!(matches!(read(text), Err(Error::OutOfRange { .. })), "{text}");
    }
}
