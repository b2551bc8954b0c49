//! Optima compared with independent grids of 400 points along one field, or 20 by 20 over two. Of 60 ranges
//! of random motors (25 points in each, three times as accurate), 59 contain only points within 1 % of their
//! best, and one contains points up to 1.1 % below it.

use std::f64::consts::PI;

use bouncing_disk_core::Unobserved;

use super::line::jackknife;
use super::*;
use crate::motor::MotorParameters;
use crate::parameters::contact::Contact;
use crate::testing::{check_stops, refused};

fn range(field: MotorField, low: f64, high: f64) -> SearchRange {
    SearchRange { field, low, high }
}

fn sought(objective: SweepQuantity, ranges: &[SearchRange], bounds: &[&str]) -> BestSearch {
    let bounds = bounds.iter().map(|bound| bound.parse().expect("a bound")).collect();
    BestSearch { objective, ranges: ranges.to_vec(), bounds }
}

/// A motor of 40 kHz whose rotor, with contacts of 0.77 periods, is tapped once per period, so that its
/// curves are exact and smooth.
fn tapped() -> Motor {
    let sheet = |sheet: &mut MotorParameters| {
        (sheet.drive_frequency, sheet.amplitude) = (40e3, Some(0.5e-6));
        (sheet.peak_angular_speed, sheet.twist_amplitude) = (Some(12.0), None);
        (sheet.mass, sheet.density, sheet.rotor_radius) = (Some(0.020), None, None);
        (sheet.contact_radius, sheet.gyration_radius) = (12.5e-3, Some(10e-3));
        (sheet.preload_force, sheet.preload_acceleration) = (Some(5.0), None);
        sheet.contact = Some(Contact::lasting(19.25e-6));
    };
    Motor::paper_70_khz().with(sheet).expect("legal")
}

fn quick() -> OperatingSettings {
    OperatingSettings {
        relative_error: 0.1,
        members: 8,
        most_impacts: 200_000,
        ..OperatingSettings::default()
    }
}

fn best(motor: &Motor, sought: &BestSearch) -> Best {
    motor.best(sought, &OperatingSettings::default(), &Unobserved).expect("found")
}

fn value(motor: &Motor, quantity: SweepQuantity, set: impl FnOnce(&mut MotorParameters)) -> f64 {
    let motor = motor.with(set).expect("legal");
    let row = motor.operating_point(motor.load_torque(), &OperatingSettings::default(), &Unobserved);
    quantity.of(row.expect("no failure").operation()).expect("known").value
}

/// Compared with the curve itself: no lag on a grid is better, and both ends of the range are within 1 %, but
/// not much more.
#[test]
fn the_best_lag_is_not_beaten_and_its_range_holds() {
    let motor = tapped();
    let found = best(&motor, &sought(SweepQuantity::Speed, &[range(MotorField::PhaseLag, 0.0, TAU)], &[]));
    let speed = |lag: f64| value(&motor, SweepQuantity::Speed, |sheet| sheet.phase_lag = lag);
    let most = (0..60).map(|k| speed(TAU * f64::from(k) / 60.0)).fold(0.0, f64::max);
    assert!(most <= found.value.value + NORMAL_975 * found.value.standard_error, "{most} {found:?}");
    let own = found.values[0];
    let [low, high] = own.good_from_to.expect("smooth");
    assert!(!own.is_at_end && low < own.value.value && own.value.value < high, "{own:?}");
    for lag in [low, own.value.value, high] {
        assert!(speed(lag) >= 0.99 * found.value.value, "{lag} {found:?}");
    }
    let width = high - low;
    assert!(speed(low - 0.2 * width) < 0.99 * most && speed(high + 0.2 * width) < 0.99 * most, "{own:?}");
    // The circle has no ends.
    let turned = best(&motor, &sought(SweepQuantity::Speed, &[range(MotorField::PhaseLag, -PI, PI)], &[]));
    let off = (turned.values[0].value.value - own.value.value).abs();
    assert!(off < 2.0 * (turned.values[0].value.standard_error + own.value.standard_error), "{off}");
    // A range that ends earlier has its best value at the end.
    let short = range(MotorField::PhaseLag, own.value.value + 0.3, 2.0);
    let short = best(&motor, &sought(SweepQuantity::Speed, &[short], &[])).values[0];
    assert!(short.is_at_end && (short.value.value - own.value.value - 0.3).abs() < 0.02, "{short:?}");
}

/// Without a bound the best preload is the smallest one; with a bound it is the one that just satisfies it.
#[test]
fn a_bound_is_kept() {
    let motor = tapped();
    let preload = [range(MotorField::PreloadForce, 3.0, 9.0)];
    let free = best(&motor, &sought(SweepQuantity::Speed, &preload, &[]));
    let bound = 0.5
        * (value(&motor, SweepQuantity::BlockedTorque, |sheet| sheet.preload_force = Some(3.0))
            + value(&motor, SweepQuantity::BlockedTorque, |sheet| sheet.preload_force = Some(9.0)));
    let text = format!("blocked_torque >= {bound}");
    let bounded = best(&motor, &sought(SweepQuantity::Speed, &preload, &[&text]));
    assert!(
        bounded.value.value <= free.value.value + 3.0 * free.value.standard_error,
        "{free:?} {bounded:?}"
    );
    assert!(bounded.bounds[0].value >= bound * (1.0 - 1e-3), "{bounded:?}");
    let other = best(
        &motor,
        &sought(SweepQuantity::Torque, &[range(MotorField::LoadTorque, 0.0, 4e-3)], &["speed >= 2"]),
    );
    assert!((other.bounds[0].value - 2.0).abs() < 0.05, "{other:?}");
}

#[test]
fn what_is_nowhere_is_told() {
    let motor = Motor::paper_70_khz();
    let friction = [range(MotorField::Friction, 0.1, 0.3)];
    let run = |sought: &BestSearch| motor.best(sought, &quick(), &Unobserved);
    let error = run(&sought(SweepQuantity::Speed, &friction, &["speed >= 1e3"])).expect_err("too fast");
    assert!(matches!(error, Error::NotKept { quantity: "speed", is_least: true, .. }), "{error}");
    // Without a load there is no power.
    let error = run(&sought(SweepQuantity::MechanicalPower, &friction, &[])).expect_err("no load");
    assert!(matches!(error, Error::NotPositive { quantity: "mechanical_power", .. }), "{error}");
    let slippery = motor.with(|sheet| sheet.friction = 0.0).expect("legal");
    let lag = range(MotorField::PhaseLag, 0.0, TAU);
    let error = slippery.best(&sought(SweepQuantity::Speed, &[lag], &[]), &quick(), &Unobserved);
    let error = error.expect_err("nothing turns it");
    assert!(matches!(error, Error::NotPositive { quantity: "speed", .. }), "{error}");
    // No stator is compliant.
    let error = run(&sought(SweepQuantity::DrivePower, &friction, &[])).expect_err("no drive");
    assert!(matches!(error, Error::NotPositive { quantity: "drive_power", .. }), "{error}");
}

#[test]
fn searches_that_are_none_are_refused_by_name() {
    let motor = Motor::paper_70_khz();
    let lag = range(MotorField::PhaseLag, 0.0, 1.0);
    let run = |sought: BestSearch| motor.best(&sought, &quick(), &Unobserved);
    let of = |ranges: &[SearchRange]| run(sought(SweepQuantity::Speed, ranges, &[]));
    refused("number of axes of a sweep", [vec![], vec![lag; 3]], |ranges| of(&ranges));
    refused("upper end of a range", [1.0, 0.5, f64::NEG_INFINITY], |low| {
        of(&[range(MotorField::Friction, low.max(0.1), 0.1)])
    });
    refused("friction", [f64::NAN, f64::INFINITY, -0.1], |high| {
        of(&[range(MotorField::Friction, -0.2, high)])
    });
    refused("number of bounds", [()], |()| run(sought(SweepQuantity::Speed, &[lag], &["speed >= 1"; 3])));
    for text in ["speed", "speed > 5", "speed >= x", "speed >= inf", "sped >= 5", ">= 5"] {
        assert!(text.parse::<QuantityBound>().is_err(), "{text}");
    }
    assert_eq!(
        "mechanical-power <= 0.5".parse::<QuantityBound>().map(|own| own.to_string()),
        Ok("mechanical_power <= 0.5".to_owned())
    );
}

#[test]
fn threads_change_no_bit_and_a_stop_is_told() {
    let motor = Motor::paper_70_khz();
    let sought =
        sought(SweepQuantity::Speed, &[range(MotorField::Friction, 0.1, 0.3)], &["input_power >= 0"]);
    check_stops(None, |observer| motor.best(&sought, &quick(), observer));
}

/// An irregular motion with contacts of 0.28 periods. All seeds once produced the same bits.
#[test]
fn seeds_tell_the_error_of_irregular_contacts() {
    let motor = tapped().with(|sheet| sheet.contact = Some(Contact::lasting(7e-6))).expect("legal");
    let speeds: Vec<Estimate> = (1..=12)
        .map(|seed| {
            let settings = OperatingSettings { seed, ..quick() };
            let row = motor.operating_point(0.0, &settings, &Unobserved).expect("no failure");
            SweepQuantity::Speed.of(row.operation()).expect("known")
        })
        .collect();
    let mean = speeds.iter().map(|own| own.value).sum::<f64>() / 12.0;
    let squares: f64 = speeds.iter().map(|own| (own.value - mean) * (own.value - mean)).sum();
    let stated: f64 = speeds.iter().map(|own| own.standard_error * own.standard_error).sum::<f64>() / 12.0;
    let ratio = (squares / 11.0 / stated).sqrt();
    assert!(ratio > 0.3 && ratio < 1.7, "{ratio} {speeds:?}");
}

/// Near 78 N a cycle of 8.7 rad/s and an irregular motion of 0.2 rad/s coexist, and the seed decides which
/// one is listed first. The optimum was once located for the cycle, but reported with the speed of the other
/// motion.
#[test]
fn of_coexisting_motions_the_one_that_was_found_is_stated() {
    let sheet = |sheet: &mut MotorParameters| {
        (sheet.drive_frequency, sheet.amplitude) = (31_911.337_759_061_85, Some(2.436_465_212_058_693e-7));
        (sheet.peak_angular_speed, sheet.twist_amplitude) = (Some(10.703_530_750_561_804), None);
        (sheet.mass, sheet.density, sheet.rotor_radius) = (Some(0.012_263_541_983_854_051), None, None);
        (sheet.contact_radius, sheet.gyration_radius) = (12.5e-3, Some(10e-3));
        (sheet.preload_force, sheet.preload_acceleration) = (Some(78.0), None);
        (sheet.friction, sheet.restitution) = (0.279_542_349_134_693, 0.714_411_380_773_895_4);
        sheet.phase_lag = 6.097_745_439_201_264;
    };
    let motor = Motor::paper_70_khz().with(sheet).expect("legal");
    let preloads = range(MotorField::PreloadForce, 77.9, 78.1);
    let found = motor.best(&sought(SweepQuantity::Speed, &[preloads], &[]), &quick(), &Unobserved);
    let found = found.expect("found");
    assert!(found.value.value > 8.0 && found.row.branches.len() > 1 && found.branch > 0, "{found:?}");
}

/// Compared with the closed form for a mean, Student's error from the scatter of the values.
#[test]
fn the_jackknife_of_a_mean_is_its_error() {
    let values = [1.0, 4.0, 2.0, 8.0, 5.0, 7.0, 3.0, 6.0];
    let sum: f64 = values.iter().sum();
    let without: Vec<[f64; 3]> = values.iter().map(|own| [0.0, (sum - own) / 7.0, 0.0]).collect();
    let expected = crate::motor::operation::point::error_of_mean(&values);
    assert!((jackknife(&without, 1) - expected).abs() < 1e-14);
}
