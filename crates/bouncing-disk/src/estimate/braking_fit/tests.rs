//! Friction from synthetic braking curves, made of known parameters and seeded noise.

use super::*;
use crate::testing::{Noise, refused};

const ROTOR: BrakingRotor =
    BrakingRotor { normal_force: 0.5, mass: 0.05, contact_radius: 0.002, gyration_radius: 0.01 };

/// m a_g^2 = 5e-6 kg m^2 times 20 rad/s^2 over a_e N = 1e-3 N m.
const FRICTION: f64 = 0.1;
const DECELERATION: f64 = 20.0;

fn times(points: u32, step: f64) -> Vec<f64> {
    (0..points).map(|i| f64::from(i) * step).collect()
}

/// From 50 rad/s to the standstill at 2.5 s.
fn braking(time: f64) -> f64 {
    (50.0 - DECELERATION * time).max(0.0)
}

fn refusal(times: &[f64], speed: impl Fn(f64) -> f64) -> FitRefusal {
    let speeds: Vec<f64> = times.iter().map(|&time| speed(time)).collect();
    match BrakingFit::new(times, &speeds, &ROTOR) {
        Err(FitError::Refused(reason)) => reason,
        other => panic!("{other:?}"),
    }
}

#[test]
fn intervals_of_synthetic_curves_cover_the_friction() {
    let even = |_: f64| 1.0;
    // Noise of a tacho grows with the speed; that of an encoder, or of the stick at the end, where it is
    // small.
    let with_speed = |time: f64| 0.05 * braking(time);
    let against_speed = |time: f64| 2.0 - 0.035 * braking(time);
    let in_burst = |time: f64| if (0.9..1.5).contains(&time) { 3.0 } else { 0.3 };
    type Scatter<'s> = &'s dyn Fn(f64) -> f64;
    let cases: [(u32, f64, f64, Scatter<'_>); 10] = [
        // With and without a standstill, with and without memory, and few points.
        (300, 0.01, 0.0, &even),
        (200, 0.01, 0.0, &even),
        (40, 0.06, 0.0, &even),
        (600, 0.005, 0.6, &even),
        (3_000, 0.001, 0.9, &even),
        (100, 0.02, 0.0, &with_speed),
        (100, 0.02, 0.0, &against_speed),
        (200, 0.02, 0.0, &in_burst),
        (25, 0.08, 0.0, &with_speed),
        (600, 0.004, 0.6, &with_speed),
    ];
    for (points, step, memory, scatter) in cases {
        let times = times(points, step);
        let mut covered = 0;
        for seed in 1..=100 {
            let noise = Noise::new(31 * seed).correlated(times.len(), memory);
            let own = times.iter().zip(noise);
            let speeds: Vec<f64> = own.map(|(&time, noise)| braking(time) + scatter(time) * noise).collect();
            // A trial that is refused covers nothing.
            let fit = BrakingFit::new(&times, &speeds, &ROTOR);
            covered += u32::from(fit.is_ok_and(|fit| fit.friction.contains(FRICTION)));
        }
        println!("{points} points, memory {memory}: {covered}");
        assert!(covered >= 90, "{points} {memory}: {covered}");
    }
}

#[test]
fn the_standstill_is_left_out() {
    let times = times(1_000, 0.01);
    for sign in [1.0, -1.0] {
        let speeds: Vec<f64> = times.iter().map(|&time| sign * braking(time)).collect();
        let fit = BrakingFit::new(&times, &speeds, &ROTOR).expect("fitted");
        assert!((fit.friction.value / FRICTION - 1.0).abs() < 1e-12, "{fit:?}");
        assert!((fit.deceleration.value / DECELERATION - 1.0).abs() < 1e-12, "{fit:?}");
        // 95 % of the speed are gone at 2.375 s.
        assert!((fit.sliding_until - 2.37).abs() < 1e-9 && fit.points == 238, "{fit:?}");
        assert!((fit.correlation_time - 0.01).abs() < 1e-9 && fit.residual < 1e-12, "{fit:?}");
    }
    // The same curve that ends while the disk slides, on a late clock.
    let late: Vec<f64> = times[..100].iter().map(|time| time + 1e5).collect();
    let speeds: Vec<f64> = times[..100].iter().map(|&time| braking(time)).collect();
    let fit = BrakingFit::new(&late, &speeds, &ROTOR).expect("fitted");
    assert!((fit.friction.value / FRICTION - 1.0).abs() < 1e-9 && fit.points == 100, "{fit:?}");
}

/// The error of a slope of independent points is sigma/sqrt(Sxx), its interval that of Student with n - 2
/// degrees.
#[test]
fn the_interval_of_independent_points_is_the_textbooks() {
    let times = times(100, 0.01);
    let mut noise = Noise::new(12);
    let speeds: Vec<f64> = times.iter().map(|&time| braking(time) + noise.normal()).collect();
    let fit = BrakingFit::new(&times, &speeds, &ROTOR).expect("fitted");
    let spread: f64 = times.iter().map(|time| (time - 0.495) * (time - 0.495)).sum();
    let sigma = fit.residual * (100.0_f64 / 98.0).sqrt();
    let expected = 1.984_467 * sigma / spread.sqrt();
    let own = 0.5 * (fit.deceleration.high - fit.deceleration.low);
    // What the correlation of the sample adds by chance is in the interval, too.
    assert!(own >= 0.999 * expected && own < 1.4 * expected, "{own} {expected}");
}

#[test]
fn curves_that_do_not_brake_straight_are_refused() {
    let ordinary = times(100, 0.01);
    assert!(matches!(refusal(&ordinary, |_| 0.0), FitRefusal::NotBraking { .. }));
    assert!(matches!(refusal(&ordinary, |_| 20.0), FitRefusal::NotBraking { .. }));
    assert!(
        matches!(refusal(&ordinary, |time| 20.0 * time), FitRefusal::NotBraking { deceleration, .. } if deceleration < -19.0)
    );
    assert!(matches!(refusal(&ordinary, |time| 5.0 + 20.0 * time), FitRefusal::NotBraking { .. }));
    // Air brakes a fast disk as its speed.
    let slowing =
        refusal(&times(400, 0.01), |time| 50.0 * bouncing_disk_core::numerics::elementary::exp(-time));
    assert!(matches!(slowing, FitRefusal::NotStraight { .. } | FitRefusal::Correlated { .. }), "{slowing:?}");
    let mut noise = Noise::new(8);
    let speeds: Vec<f64> = times(400, 0.01)
        .iter()
        .map(|time| 50.0 * bouncing_disk_core::numerics::elementary::exp(-time) + 5.0 * noise.normal())
        .collect();
    let curved = BrakingFit::new(&times(400, 0.01), &speeds, &ROTOR).expect_err("curved");
    assert!(
        matches!(curved, FitError::Refused(FitRefusal::NotStraight { first_half, last_half }) if first_half > last_half),
        "{curved:?}"
    );
    // It turns on for a while before anything brakes it.
    let late = refusal(&times(400, 0.01), |time| 30.0 - DECELERATION * (time - 1.5).clamp(0.0, 1.4));
    assert!(matches!(late, FitRefusal::NotStraight { .. } | FitRefusal::Correlated { .. }), "{late:?}");
    // Seven points slide.
    assert!(
        matches!(refusal(&times(40, 0.34), braking), FitRefusal::TooFewPoints { least: 8, points } if points < 8)
    );
    let few = [0.0, 1.0, 2.0];
    assert!(matches!(refusal(&few, |time| 3.0 - time), FitRefusal::TooFewPoints { .. }));
    // Noise hides the fall.
    let mut noise = Noise::new(5);
    let speeds: Vec<f64> = ordinary.iter().map(|time| 30.0 - time + 5.0 * noise.normal()).collect();
    let hidden = BrakingFit::new(&ordinary, &speeds, &ROTOR).expect_err("hidden");
    assert!(
        matches!(hidden, FitError::Refused(FitRefusal::NotBraking { low, .. }) if low < 0.0),
        "{hidden:?}"
    );
}

#[test]
fn braking_curves_of_any_size_are_fitted() {
    let ordinary = times(300, 0.01);
    let mut noise = Noise::new(5);
    let speeds: Vec<f64> = ordinary.iter().map(|&time| braking(time) + noise.normal()).collect();
    let expected = BrakingFit::new(&ordinary, &speeds, &ROTOR).expect("fitted");
    for (time, speed) in
        [(1e150, 1e150), (1e-160, 1e-160), (1.0, 1e200), (1.0, 1e-200), (1e-9, -1.0), (1e100, 1.0)]
    {
        let own_times: Vec<f64> = ordinary.iter().map(|value| value * time).collect();
        let own_speeds: Vec<f64> = speeds.iter().map(|value| value * speed).collect();
        // A heavier rotor brakes more slowly by the same friction.
        let mass = ROTOR.mass * time / speed.abs();
        let fit = BrakingFit::new(&own_times, &own_speeds, &BrakingRotor { mass, ..ROTOR }).expect("fitted");
        for (own, expected) in [
            (fit.friction.value, expected.friction.value),
            (fit.friction.low, expected.friction.low),
            (fit.friction.high, expected.friction.high),
        ] {
            assert!((own / expected - 1.0).abs() < 1e-6, "{time} {speed}: {own} {expected}");
        }
    }
    let many = times(1_000_000, 3e-6);
    let speeds: Vec<f64> = many.iter().map(|&time| braking(time) + noise.normal()).collect();
    let fit = BrakingFit::new(&many, &speeds, &ROTOR).expect("fitted");
    assert!(fit.friction.contains(FRICTION) && (fit.points as f64 / 791_667.0 - 1.0).abs() < 0.01, "{fit:?}");
}

#[test]
fn what_is_illegal_of_a_curve_or_a_rotor_is_refused() {
    let times = times(100, 0.01);
    let speeds: Vec<f64> = times.iter().map(|&time| braking(time)).collect();
    let of_rotor = |rotor| BrakingFit::new(&times, &speeds, &rotor);
    let slowed = |rotor: BrakingRotor| rotor.friction(-20.0);
    // A square that vanishes, and with it the friction did.
    let tiny = BrakingRotor { gyration_radius: 1e-170, ..ROTOR };
    for (name, rotor) in [
        ("normal_force", BrakingRotor { normal_force: 0.0, ..ROTOR }),
        ("mass", BrakingRotor { mass: -1.0, ..ROTOR }),
        ("contact_radius", BrakingRotor { contact_radius: f64::NAN, ..ROTOR }),
        ("contact_radius", BrakingRotor { contact_radius: 0.0, ..ROTOR }),
        ("gyration_radius", BrakingRotor { gyration_radius: f64::INFINITY, ..ROTOR }),
        ("moment of inertia", tiny),
    ] {
        refused(name, [rotor], of_rotor);
        refused(name, [rotor], slowed);
    }
    let product = "contact radius times normal force";
    refused(product, [BrakingRotor { contact_radius: 1e-320, ..ROTOR }], slowed);
    // It overflows, and the friction vanished.
    refused(product, [BrakingRotor { contact_radius: 1e160, normal_force: 1e160, ..ROTOR }], slowed);
    refused("angular_acceleration", [20.0, f64::NAN], |acceleration| ROTOR.friction(acceleration));
    let of_curve = |(times, speeds): (&[f64], &[f64])| BrakingFit::new(times, speeds, &ROTOR);
    refused("number of points of the speed curve", [(&[][..], &[][..])], of_curve);
    refused("number of speeds", [(&times[..], &speeds[..99])], of_curve);
    let with = |values: &[f64], value: f64| {
        let mut values = values.to_vec();
        values[50] = value;
        values
    };
    refused("speed", [(&times[..], &with(&speeds, f64::NAN)[..])], of_curve);
    refused("times of the speed curve", [(&with(&times, times[49])[..], &speeds[..])], of_curve);
}

#[test]
fn eq_17_on_round_numbers() {
    assert!((ROTOR.friction(-DECELERATION).expect("legal") - FRICTION).abs() < 1e-15);
    assert!(ROTOR.friction(0.0).expect("legal").abs() <= 0.0);
}
