use num_dual::{Dual64, DualNum};

use super::*;
use crate::map::restitution_law::kuwabara_kono::KuwabaraKono;
use crate::numerics::elementary::pow;
use crate::numerics::testing::stored;

/// Restitutions and speeds up to the limits of a double.
const RESTITUTIONS: [f64; 6] = [5.0e-324, 1.0e-300, 1.0e-3, 0.5, 0.999, 1.0 - f64::EPSILON / 2.0];
const SPEEDS: [f64; 9] =
    [5.0e-324, f64::MIN_POSITIVE, 1.0e-300, 1.0e-20, 1.0e-3, 1.0, 1.0e3, 1.0e150, f64::MAX];

/// The impact speed at which r + x r^(3/5) = 1 has the solution r: the inverse of the law.
fn speed_at(restitution: Dual64, (reference, speed): (f64, f64)) -> Dual64 {
    let x = |r: Dual64| (-r + 1.0) / r.powf(0.6);
    (x(restitution) / x(Dual64::from_re(reference))).powi(5) * speed
}

#[test]
fn the_restitution_and_its_derivative_invert_the_speed() {
    for reference in [(0.5, 1.0), (0.9, 1e-3), (0.2, 700.0), (0.01, 3.0)] {
        let law = KuwabaraKono::new(reference.0, reference.1).expect("legal");
        assert!((law.restitution(reference.1) - reference.0).abs() <= 4e-16);
        for k in 1..200 {
            let restitution = f64::from(k) / 200.0;
            let speed = speed_at(Dual64::from_re(restitution).derivative(), reference);
            let own = law.restitution(speed.re);
            assert!((own - restitution).abs() <= 1e-14 * restitution, "{own} {restitution}");
            // Near r = 1 the oracle's 1 - r is a difference.
            let product = law.derivative(speed.re) * speed.eps;
            assert!((product - 1.0).abs() <= 1e-12, "{product} {restitution}");
        }
    }
}

/// 1 - r = x - (3/5) x^2 + ..., x proportional to the fifth root of the speed.
#[test]
fn what_is_lost_at_low_speed_goes_with_its_fifth_root() {
    let law = KuwabaraKono::new(0.5, 1.0).expect("legal");
    let x_at_one = 0.5 / pow(0.5, 0.6);
    for (speed, x) in [(1e-5, 0.1 * x_at_one), (1e-10, 0.01 * x_at_one), (1e-15, 0.001 * x_at_one)] {
        let lost = 1.0 - law.restitution(speed);
        assert!((lost - (x - 0.6 * x * x)).abs() <= 0.4 * x * x * x + 1e-15, "{lost} {x}");
        assert!(
            (lost - (x - 0.6 * x * x)).abs() >= 1e-3 * x * x * x,
            "the third order is not that of the law"
        );
        // 32 times the speed, twice the loss.
        let faster = 1.0 - law.restitution(32.0 * speed);
        assert!((faster / lost - 2.0).abs() <= 2.0 * x, "{faster} {lost}");
    }
}

/// A viscoelastic impact integrated in time: xi'' = -xi^(3/2) - gamma xi^(1/2) xi' from xi = 0, xi' = 1 until
/// the force is zero. It is independent of the law.
fn integrated_restitution(gamma: f64) -> f64 {
    let force = |x: f64, v: f64| if x > 0.0 { -(x + gamma * v) * x.sqrt() } else { 0.0 };
    let step = 2.0e-5;
    let (mut x, mut v) = (0.0_f64, 1.0_f64);
    loop {
        let (a1, v1) = (force(x, v), v);
        let (a2, v2) = (force(x + 0.5 * step * v1, v + 0.5 * step * a1), v + 0.5 * step * a1);
        let (a3, v3) = (force(x + 0.5 * step * v2, v + 0.5 * step * a2), v + 0.5 * step * a2);
        let (a4, v4) = (force(x + step * v3, v + step * a3), v + step * a3);
        x += step / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
        v += step / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        if v < 0.0 && x + gamma * v <= 0.0 {
            return -v;
        }
    }
}

/// x = C1 gamma at speed 1, with C1 = 1.15344 of the exact series (docs/numerics-dynamics.md); the third
/// order differs from the law.
#[test]
fn the_law_has_two_orders_of_a_viscoelastic_impact() {
    for gamma in [0.01, 0.02, 0.05, 0.1, 0.2] {
        let x = 1.153_45 * gamma;
        let integrated = integrated_restitution(gamma);
        assert!((1.0 - integrated - (x - 0.6 * x * x)).abs() <= x * x * x + 2e-6, "{integrated} {x}");
        // The law through the impact with this x.
        let mut r = 1.0;
        for _ in 0..100 {
            r = 1.0 - x * pow(r, 0.6);
        }
        let law = KuwabaraKono::new(r, 1.0).expect("legal");
        let own = law.restitution(1.0);
        assert!((own - integrated).abs() <= x * x * x + 2e-6, "{own} {integrated} {x}");
    }
}

#[test]
fn the_law_is_legal_and_falls_up_to_the_limits_of_a_double() {
    for restitution in RESTITUTIONS {
        for reference_speed in SPEEDS {
            let law = KuwabaraKono::new(restitution, reference_speed).expect("legal");
            assert_eq!(restitution_of(&law, 0.0), Ok(1.0));
            assert_eq!(launch_slope(&law, 0.0), Ok(1.0));
            assert!(law.derivative(0.0) < 0.0 && law.rebound_sum(0.0) == Some(0.0));
            let mut last = 1.0;
            let mut sum = 0.0;
            for speed in SPEEDS {
                let r = restitution_of(&law, speed).expect("legal");
                assert!(r <= last, "{law:?} {speed:e}: {r} after {last}");
                last = r;
                let derivative = law.derivative(speed);
                assert!(derivative <= 0.0, "{law:?} {speed:e}: {derivative}");
                assert!(derivative.is_finite() || speed < f64::MIN_POSITIVE, "{law:?} {speed:e}");
                // The launch speed grows with the impact speed: its slope is at least 2/3 r.
                let slope = launch_slope(&law, speed).expect("finite");
                assert!(slope <= r && slope >= 0.66 * r, "{law:?} {speed:e}: {slope} {r}");
                let rebounds = law.rebound_sum(speed).expect("known");
                assert!(rebounds >= sum, "{law:?} {speed:e}: {rebounds} after {sum}");
                sum = rebounds;
            }
        }
    }
}

/// NaN as a speed has no restitution.
#[test]
fn no_restitution_for_no_speed() {
    let law = KuwabaraKono::new(0.5, 1.0).expect("legal");
    for speed in [f64::NAN, -1.0] {
        assert!(restitution_of(&law, speed).is_err() && law.derivative(speed).is_infinite());
    }
}

#[test]
fn laws_are_stored() {
    for restitution in RESTITUTIONS {
        let constant = Constant::new(restitution).expect("legal");
        assert_eq!(stored(&constant), constant);
        for speed in SPEEDS {
            let law = KuwabaraKono::new(restitution, speed).expect("legal");
            assert_eq!(stored(&law), law);
        }
    }
    let law = KuwabaraKono::new(0.5, 2.0).expect("legal");
    assert_eq!((law.reference_restitution(), law.reference_speed()), (0.5, 2.0));
    assert_eq!(law.to_string(), "0.5 at 2 g/omega (Kuwabara-Kono)");
}

#[cfg(feature = "serde")]
#[test]
fn a_law_that_is_read_is_legal() {
    for (text, told) in [
        (r#"{"reference_restitution":1.5,"reference_speed":1.0}"#, "reference_restitution = 1.5"),
        (r#"{"reference_restitution":0.5,"reference_speed":0.0}"#, "reference_speed = 0"),
        (r#"{"reference_restitution":0.5,"speed":1.0}"#, "speed"),
    ] {
        let refusal = serde_json::from_str::<KuwabaraKono>(text).expect_err("illegal").to_string();
        assert!(refusal.contains(told), "{refusal}");
    }
    assert!(serde_json::from_str::<Constant>("1.0").is_err());
    assert_eq!(serde_json::to_string(&Constant::new(0.5).expect("legal")).expect("writes"), "0.5");
}
