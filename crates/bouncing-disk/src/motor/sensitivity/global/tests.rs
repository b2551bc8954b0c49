use SensitivityParameter as P;
use bouncing_disk_core::Unobserved;

use super::*;

fn quick() -> OperatingSettings {
    OperatingSettings { relative_error: 0.1, members: 4, ..OperatingSettings::default() }
}

/// Fig. 13: twist and lag make the speed, friction does not; the indices add up to the variance.
#[test]
fn twist_and_lag_make_the_speed() {
    let motor = Motor::paper_70_khz();
    let ranges = [(P::Friction, [0.2, 0.4]), (P::PeakAngularSpeed, [20.0, 40.0]), (P::PhaseLag, [-0.8, 0.8])];
    let sampling = SamplingSettings { rows: 48, seed: 1 };
    let of = SensitivityQuantity::SteadySpeed;
    let [friction, twist, lag] = motor
        .sobol_indices(of, &ranges, sampling, &quick(), &Unobserved)
        .expect("turns")
        .try_into()
        .expect("three");
    assert!(friction.total.value < 0.05, "{friction:?}");
    assert!(twist.first.value > 0.4 && lag.total.value > 0.05, "{twist:?} {lag:?}");
    let sum = friction.first.value + twist.first.value + lag.first.value;
    assert!((sum - 1.0).abs() < 0.25, "{sum}");
    let [friction, twist, lag] = motor
        .elementary_effects(of, &ranges, SamplingSettings { rows: 8, seed: 1 }, &quick(), &Unobserved)
        .expect("turns")
        .try_into()
        .expect("three");
    assert!(twist.mean.value > 8.0 && twist.mean.value < 20.0, "{twist:?}");
    assert!(friction.mean_size.value < 0.3 * twist.mean_size.value, "{friction:?}");
    assert!(lag.mean_size.value > friction.mean_size.value, "{lag:?}");
}

/// Points of a row that share a vertical motion are put on one, wherever they stand.
#[test]
fn the_order_of_the_points_does_not_matter() {
    let motor = Motor::paper_70_khz();
    let ranges = [(P::Preload, [9.0, 10.0]), (P::PhaseLag, [0.0, 1.0])];
    let points: Vec<Vec<f64>> =
        [[9.1, 0.1], [9.9, 0.5], [9.1, 0.5], [9.9, 0.1]].iter().map(|point| point.to_vec()).collect();
    let of = SensitivityQuantity::SteadySpeed;
    let values = motor.values(of, &ranges, &points, &quick(), &Unobserved).expect("turns");
    for pair in [[0, 2], [1, 3]] {
        let alone: Vec<Vec<f64>> = pair.iter().map(|&index: &usize| points[index].clone()).collect();
        let alone = motor.values(of, &ranges, &alone, &quick(), &Unobserved).expect("turns");
        assert_eq!(
            pair.map(|index| values[index].to_bits()).to_vec(),
            alone.iter().map(|v| v.to_bits()).collect::<Vec<_>>()
        );
    }
}

#[test]
fn ranges_that_leave_what_is_legal_are_refused() {
    let motor = Motor::paper_70_khz();
    let sampling = SamplingSettings { rows: 8, seed: 1 };
    let of = SensitivityQuantity::SteadySpeed;
    for (range, name) in [
        ((P::Restitution, [1.0, 1.5]), "restitution"),
        ((P::Friction, [-2.0, -1.0]), "friction"),
        ((P::Preload, [0.0, 0.0]), "preload_acceleration"),
        ((P::Amplitude, [f64::NAN, 1.0]), "range (low)"),
    ] {
        assert_eq!(
            crate::testing::refused_field(motor.sobol_indices(of, &[range], sampling, &quick(), &Unobserved)),
            name
        );
    }
    let heavy = [(P::LoadTorque, [2.0, 3.0].map(|share| share * motor.largest_torque()))];
    let error = motor.elementary_effects(of, &heavy, sampling, &quick(), &Unobserved).expect_err("runs away");
    assert!(matches!(error, Error::Overpowered { .. }), "{error}");
    let stop = |_: Progress| std::ops::ControlFlow::Break(());
    let ranges = [(P::PhaseLag, [0.0, 1.0])];
    assert!(motor.sobol_indices(of, &ranges, sampling, &quick(), &stop).is_err());
}
