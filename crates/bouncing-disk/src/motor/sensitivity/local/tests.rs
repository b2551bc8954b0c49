//! Local sensitivities.
//!
//! Coverage: of 100 runs with other seeds, the number whose 95 % intervals contain the mean over all runs,
//! for the steady speed at the default settings. The contact radius behaves like friction, and twist
//! inversely. For the motor of Table III: friction 96, lag 92, radius of gyration 98, load 95. For 40 kHz,
//! 0.5 um, 5 N, radii of 12.5 and 10 mm: friction 92, lag 94, radius of gyration 92, load 94, amplitude 96,
//! preload 94, restitution 92, frequency 97. When the step with the least error was selected instead, the
//! intervals contained the mean in only 11 of 14 runs.

use SensitivityParameter as P;
use bouncing_disk_core::Unobserved;

use super::*;
use crate::testing::{check_stops, refused};

fn quick() -> SensitivitySettings {
    let operating = OperatingSettings { relative_error: 0.05, members: 8, ..OperatingSettings::default() };
    SensitivitySettings { operating, half_range: 0.2, points: 8 }
}

fn near(one: &LocalSensitivity, truth: f64) -> bool {
    (one.derivative.value - truth).abs() <= 4.0 * one.derivative.standard_error + 1e-6
}

/// Parameters whose exponents dimensional analysis relates.
const RELATED: [P; 5] =
    [P::Friction, P::PeakAngularSpeed, P::ContactRadius, P::GyrationRadius, P::LoadTorque];

/// Consequences of dimensional analysis: the rotary motion depends on friction, twist and radii only through
/// mu and Q = a_g^2 Phi omega^2 /(a_e g), and the speed without load is Q times a function of Q/mu.
#[test]
fn exponents_of_the_speed_obey_the_units() {
    let motor = Motor::paper_70_khz();
    let speed = motor
        .local_sensitivities(SensitivityQuantity::SteadySpeed, &RELATED, &quick(), &Unobserved)
        .expect("turns");
    let [friction, twist, contact, gyration, load] = speed.try_into().expect("as many as parameters");
    // Speed = omega Phi f(a_g^2 omega Phi/(mu a_e)).
    assert!(near(&twist, 1.0 - friction.derivative.value), "{twist:?} {friction:?}");
    assert!(near(&contact, friction.derivative.value), "{contact:?} {friction:?}");
    assert!(near(&gyration, -2.0 * friction.derivative.value), "{gyration:?} {friction:?}");
    assert!(load.derivative.value < -0.3, "{load:?}");
    // The speed does not depend on friction (Fig. 13).
    assert!(friction.derivative.value.abs() < 0.1, "{friction:?}");
    for one in [friction, twist, contact, gyration, load] {
        assert!(one.derivative.standard_error < 0.1, "{one:?}");
        let SensitivityMethod::SharedMotion { scatter, curvature } = one.method else { panic!("{one:?}") };
        let error = (scatter * scatter + curvature * curvature).sqrt();
        assert!((error - one.derivative.standard_error).abs() < 1e-12, "{one:?}");
    }
}

/// The stall torque is mu m g a_e times a function of Q/mu.
#[test]
fn exponents_of_the_stall_obey_the_units() {
    let motor = Motor::paper_70_khz();
    let stall = motor
        .local_sensitivities(SensitivityQuantity::StallTorque, &RELATED, &quick(), &Unobserved)
        .expect("turns");
    let [friction, twist, contact, gyration, load] = stall.try_into().expect("as many as parameters");
    assert!(near(&friction, 1.0 - twist.derivative.value), "{twist:?} {friction:?}");
    assert!(near(&contact, 1.0 - twist.derivative.value), "{contact:?} {twist:?}");
    assert!(near(&gyration, 2.0 * twist.derivative.value), "{gyration:?} {twist:?}");
    assert!(load.derivative.value.abs() < 1e-9, "{load:?}");
    assert!((friction.derivative.value - 1.0).abs() < 0.1, "{friction:?}");
}

/// Differences on shared motions, compared with motors that are operated one by one.
#[test]
fn differences_are_those_of_whole_operations() {
    let motor = Motor::paper_70_khz()
        .with(|sheet| {
            sheet.phase_lag = 0.9;
            sheet.load_torque = 4e-6;
        })
        .expect("legal");
    let lag = motor
        .local_sensitivities(SensitivityQuantity::SteadySpeed, &[P::PhaseLag], &quick(), &Unobserved)
        .expect("turns")[0];
    let settings = OperatingSettings { relative_error: 0.005, ..OperatingSettings::default() };
    let at = |lag: f64| {
        let motor = P::PhaseLag.set(&motor, lag).expect("legal");
        quantity_of(&motor, SensitivityQuantity::SteadySpeed, &settings, &Unobserved).expect("turns")
    };
    let (up, own, down) = (at(1.0), at(0.9), at(0.8));
    let expected = (up.value - down.value) / (0.2 * own.value);
    let error = 5.0 * (up.standard_error + down.standard_error) / own.value;
    assert!(
        (lag.derivative.value - expected).abs() < 4.0 * lag.derivative.standard_error + error,
        "{lag:?} {expected}"
    );
    assert!(lag.derivative.value < -0.5, "{lag:?}");
}

/// The speed depends on neither the preload nor the amplitude (Sec. V).
#[test]
fn the_speed_is_fitted_over_a_range_of_the_vertical_motion() {
    let motor = Motor::paper_70_khz();
    let parameters = [P::Preload, P::Amplitude];
    let speed = motor
        .local_sensitivities(SensitivityQuantity::SteadySpeed, &parameters, &quick(), &Unobserved)
        .expect("turns");
    for one in &speed {
        let SensitivityMethod::Regression { points, traps, scatter } = one.method else { panic!("{one:?}") };
        assert!(points + traps == 8 && scatter < 0.2, "{one:?}");
        assert!(one.derivative.value.abs() < 0.2 + 3.0 * one.derivative.standard_error, "{one:?}");
    }
}

/// The stall torque is proportional to the preload.
#[test]
fn the_stall_is_fitted_over_a_range_of_preloads() {
    let motor = Motor::paper_70_khz();
    // A wide range makes up for rough stalls, which are cheap.
    let operating = OperatingSettings { relative_error: 0.1, members: 4, ..quick().operating };
    let settings = SensitivitySettings { operating, half_range: 0.7, ..quick() };
    let stall = motor
        .local_sensitivities(SensitivityQuantity::StallTorque, &[P::Preload], &settings, &Unobserved)
        .expect("turns")[0];
    let Estimate { value, standard_error } = stall.derivative;
    assert!((value - 1.0).abs() < 3.0 * standard_error && standard_error < 0.15, "{stall:?}");
}

#[test]
fn lines_have_the_errors_of_textbooks() {
    let line = RegressionLine::through(&[-1.0, 0.0, 1.0, 2.0], &[1.0, 3.0, 4.0, 8.0]);
    // By hand: residuals 0.3, 0.1, -1.1, 0.7 about 2.9 + 2.2 x, with variance 1.8/2; squares of the offsets
    // 5. The interval is Student's with two degrees of freedom.
    assert!((line.slope - 2.2).abs() < 1e-14 && (line.centre - 2.9).abs() < 1e-14);
    assert!(
        (line.scatter - 0.9_f64.sqrt()).abs() < 1e-14
            && (line.slope_error - 0.18_f64.sqrt() * 4.302_652_729_911_28 / NORMAL_975).abs() < 1e-14
    );
}

/// The slopes of odd polynomials with this number of terms are exact, and least squares approximate those of
/// polynomials with more terms.
#[test]
fn slopes_are_those_of_odd_polynomials() {
    let slope = |terms: usize, fifth: f64| {
        let value = |x: f64| 2.0 * x - 3.0 * x * x * x + fifth * x * x * x * x * x;
        slope_weights(terms).iter().zip(STEPS).map(|(weight, step)| weight * value(step)).sum::<f64>()
    };
    assert!((slope(2, 0.0) - 2.0).abs() < 1e-13 && (slope(3, 7.0) - 2.0).abs() < 1e-12);
    assert!((slope(1, 0.0) - 2.0).abs() > 0.05 && (slope(2, 7.0) - 2.0).abs() < 2e-3);
}

#[test]
fn what_has_no_sensitivity_is_refused() {
    let motor = Motor::paper_70_khz();
    let of = |motor: &Motor, parameters: &[P], settings: &SensitivitySettings| {
        motor.local_sensitivities(SensitivityQuantity::SteadySpeed, parameters, settings, &Unobserved)
    };
    assert_eq!(of(&motor, &[], &quick()), Ok(Vec::new()));
    // Zero has no logarithm.
    for parameter in [P::Restitution, P::Friction] {
        let zero = parameter.set(&motor, 0.0).expect("legal");
        let error = of(&zero, &[parameter], &quick()).expect_err("zero");
        assert!(matches!(error, Error::OutOfRange { field, .. } if field == parameter.name()), "{error}");
    }
    // A lag at which the motor does not turn.
    let still = P::PeakAngularSpeed.set(&motor, 0.0).expect("legal");
    let error = of(&still, &[P::Friction], &quick()).expect_err("still");
    assert!(matches!(error, Error::DoesNotTurn { .. }), "{error}");
    // A load that one of the differences would take beyond the limit.
    let loaded = P::LoadTorque.set(&motor, 0.97 * motor.largest_torque()).expect("legal");
    let error = of(&loaded, &[P::LoadTorque], &quick()).expect_err("runs away");
    assert!(matches!(error, Error::Overpowered { .. }), "{error}");
    let with = |settings| of(&motor, &[P::Friction], &settings);
    refused("half_range", [0.0, f64::NAN, 2.1], |half_range| {
        with(SensitivitySettings { half_range, ..quick() })
    });
    refused("points", [4, 10_001], |points| with(SensitivitySettings { points, ..quick() }));
    // A plastic rotor repeats a ramp whatever the preload, so no points are left for a line.
    let plastic = P::Restitution.set(&motor, 0.0).expect("legal");
    let error = of(&plastic, &[P::Preload], &quick()).expect_err("traps");
    assert!(matches!(error, Error::TooFewMotors { left, traps, needed: 5 } if left + traps == 8), "{error}");
}

#[test]
fn sensitivities_can_be_stopped() {
    let operating = OperatingSettings { relative_error: 0.2, members: 4, ..OperatingSettings::default() };
    let (motor, settings) = (Motor::paper_70_khz(), SensitivitySettings { operating, ..quick() });
    for parameter in [P::Friction, P::Preload] {
        check_stops(None, |observer| {
            motor.local_sensitivities(SensitivityQuantity::SteadySpeed, &[parameter], &settings, observer)
        });
    }
}

/// A parameter that is set is read back, and the others are unchanged.
#[test]
fn parameters_are_set_one_by_one() {
    let motor = Motor::paper_70_khz().with(|sheet| sheet.load_torque = 1e-6).expect("legal");
    for parameter in P::ALL {
        let value = if parameter == P::PhaseLag { 0.3 } else { 1.25 * parameter.of(&motor) };
        let changed = parameter.set(&motor, value).expect("legal");
        for other in P::ALL {
            let expected = if other == parameter { value } else { other.of(&motor) };
            assert!((other.of(&changed) - expected).abs() <= 1e-14 * expected.abs(), "{parameter} {other}");
        }
        assert_eq!(
            parameter.shares_vertical_motion(),
            crate::motor::batch::shared_orbit::is_shared(motor.system(), changed.system()),
            "{parameter}"
        );
        assert!(parameter.set(&motor, f64::NAN).is_err(), "{parameter}");
    }
}
