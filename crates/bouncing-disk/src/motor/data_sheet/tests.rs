//! The data sheet: its legal values, its warnings, and the derived quantities.

use std::f64::consts::{PI, TAU};
use std::mem::discriminant;

use bouncing_disk_core::chaos::lyapunov_exponents;
use bouncing_disk_core::numerics::elementary::exp;
use bouncing_disk_core::{ImpactMap, ImpactState, Launch, Unobserved, Vibration};
use proptest::prelude::*;

use super::*;
use crate::estimate::ensemble::TransientEnsemble;
use crate::estimate::measured_speeds::{MeasuredRun, MeasuredSpeeds};
use crate::motor::data_sheet::motor_field::MotorField;
use crate::motor::data_sheet::regime::{MotorRegime, regime};
use crate::motor::data_sheet::warning::MotorWarning;
use crate::motor::rotor::transient::TransientSettings;
use crate::parameters::dimensionless::{DimensionlessParameters, ForcingParameters};
use crate::testing::check_stops;

/// A motor with many traps: 40 kHz, 0.5 um, 20 g, 5 N, 12 rad/s, 30 degrees.
fn designers() -> MotorParameters {
    MotorParameters {
        drive_frequency: 40e3,
        amplitude: Some(0.5e-6),
        peak_angular_speed: Some(12.0),
        phase_lag: PI / 6.0,
        mass: Some(0.02),
        preload_force: Some(5.0),
        preload_acceleration: None,
        ..Motor::paper_70_khz().parameters().clone()
    }
}

/// A rotor given by density and size, with all optional fields.
fn disc() -> MotorParameters {
    MotorParameters {
        mass: None,
        density: Some(2_700.0),
        rotor_radius: Some(0.01),
        rotor_thickness: Some(0.005),
        gyration_radius: None,
        twist_amplitude: Some(4e-5),
        peak_angular_speed: None,
        spring_constant: Some(400.0),
        load_torque: 1e-5,
        ..designers()
    }
}

#[test]
fn the_preset_is_the_motor_of_table_iii_to_the_last_bit() {
    let motor = Motor::paper_70_khz();
    assert_eq!(motor.system(), &System::motor());
    // Also the signs of zeros, which compare equal.
    assert_eq!(format!("{:?}", motor.system()), format!("{:?}", System::motor()));
    assert!(motor.warnings().is_empty());
    assert!((motor.mass() - 0.0329).abs() < 1e-4, "{}", motor.mass());
    let fast = Motor::paper_184_khz();
    assert!(fast.warnings().is_empty());
    let forcing = fast.system().axial_forcing() / motor.system().axial_forcing();
    assert!((forcing - (184.0_f64 / 70.0) * (184.0 / 70.0)).abs() < 1e-13, "{forcing}");
    let same = fast.with(|sheet| sheet.drive_frequency = 70e3).expect("legal");
    assert_eq!(same, motor);
}

/// Exactly one of a pair of alternatives is required, whatever their values.
#[test]
fn alternatives_are_given_once() {
    type Set = fn(&mut MotorParameters, Option<f64>);
    let pairs: [(&str, Set, &str, Set); 3] = [
        (
            "peak_angular_speed",
            |sheet, value| sheet.peak_angular_speed = value,
            "twist_amplitude",
            |sheet, value| sheet.twist_amplitude = value,
        ),
        ("mass", |sheet, value| sheet.mass = value, "density", |sheet, value| sheet.density = value),
        (
            "preload_force",
            |sheet, value| sheet.preload_force = value,
            "preload_acceleration",
            |sheet, value| sheet.preload_acceleration = value,
        ),
    ];
    for (one, set_one, other, set_other) in pairs {
        let mut sheet = designers();
        set_one(&mut sheet, Some(1.0));
        set_other(&mut sheet, Some(1.0));
        assert_eq!(sheet.build(), Err(Error::BothGiven { one, other }));
        set_one(&mut sheet, None);
        set_other(&mut sheet, None);
        assert_eq!(sheet.build(), Err(Error::NeitherGiven { one, other }));
    }
    let sheet = MotorParameters { gyration_radius: None, ..designers() };
    assert_eq!(sheet.build(), Err(Error::NeitherGiven { one: "gyration_radius", other: "rotor_radius" }));
    for (sheet, field) in [
        (MotorParameters { rotor_radius: None, gyration_radius: Some(0.007), ..disc() }, "rotor_radius"),
        (MotorParameters { rotor_thickness: None, ..disc() }, "rotor_thickness"),
    ] {
        assert_eq!(sheet.build(), Err(Error::NotGiven { field }));
    }
    let unread = MotorParameters { rotor_thickness: Some(0.005), ..designers() };
    assert_eq!(unread.build(), Err(Error::BothGiven { one: "mass", other: "rotor_thickness" }));
}

#[test]
fn a_disc_has_the_mass_and_the_radius_of_gyration_of_a_solid_one() {
    let motor = disc().build().expect("legal");
    assert!((motor.mass() - 2_700.0 * PI * 1e-4 * 0.005).abs() < 1e-15);
    let gyration = motor.system().disk().gyration_radius();
    assert!((gyration * gyration - 0.5e-4).abs() < 1e-18);
    assert!((motor.inertia() - 0.5 * motor.mass() * 1e-4).abs() < 1e-18);
    let ring = motor.with(|sheet| sheet.gyration_radius = Some(0.0098)).expect("legal");
    assert!((ring.system().disk().gyration_radius() - 0.0098).abs() < 1e-18);
}

#[test]
fn force_speed_and_torque_become_those_of_the_system() {
    let motor = MotorParameters { load_torque: 2e-4, ..designers() }.build().expect("legal");
    let (platform, disk) = (motor.system().platform(), motor.system().disk());
    assert!((platform.angular_frequency() - TAU * 40e3).abs() < 1e-9);
    assert!((platform.peak_angular_speed() - 12.0).abs() < 1e-14);
    // F/m, without an added weight.
    assert!((motor.preload_acceleration() - 250.0).abs() < 1e-12);
    assert!((motor.preload_force() - 5.0).abs() < 1e-15);
    // The largest torque: 5 N, 0.1, 1.25 mm.
    assert!((motor.largest_torque() - 6.25e-4).abs() < 1e-18);
    assert!((disk.load_acceleration() * motor.inertia() - 2e-4).abs() < 1e-18);
    assert!((motor.load_torque() - 2e-4).abs() < 1e-20);
    let accelerated = motor
        .with(|sheet| {
            sheet.preload_force = None;
            sheet.preload_acceleration = Some(250.0);
        })
        .expect("legal");
    assert!((accelerated.preload_force() - 5.0).abs() < 1e-14);
    assert_eq!(motor.static_deflection(), None);
    assert_eq!(motor.preload_change_bound(), None);
}

/// Every field at every limit of its range produces an error that names the field, or a motor without NaN.
#[test]
fn every_field_is_checked_at_every_seam() {
    // The quantities by which a combination is out of range.
    const COMBINED: [&str; 6] =
        ["twist_speed", "moment of inertia", "load", "load_acceleration", "friction", "twist_amplitude"];
    for base in [designers(), disc()] {
        let motor = base.build().expect("legal");
        for field in MotorField::ALL.into_iter().filter(|field| field.value(&base).is_some()) {
            for value in [
                f64::NAN,
                f64::INFINITY,
                f64::NEG_INFINITY,
                -1.0,
                -0.0,
                0.0,
                5e-324,
                1e-310,
                f64::MIN_POSITIVE,
                1e-160,
                1.0,
                1e160,
                f64::MAX,
            ] {
                let place = format!("{field} = {value:e}");
                match motor.with(|sheet| field.set(sheet, value)) {
                    Err(Error::OutOfRange { field: named, .. }) => {
                        let derived = named.contains(field.name())
                            || named.starts_with("unit of")
                            || COMBINED.contains(&named);
                        assert!(derived, "{place}: {named}");
                    }
                    Err(Error::Core(bouncing_disk_core::Error::OutOfRange { field: named, .. })) => {
                        assert!(named == "peak_acceleration", "{place}: {named}");
                    }
                    Err(error) => panic!("{place}: {error}"),
                    Ok(motor) => {
                        assert!(value.is_finite(), "{place}");
                        assert!(motor.mass() > 0.0 && motor.preload_force() > 0.0, "{place}");
                        assert!(motor.largest_torque().is_finite(), "{place}");
                        // Printing never fails.
                        assert!(!motor.to_string().is_empty());
                    }
                }
            }
            let negative = motor.with(|sheet| field.set(sheet, -1.0));
            assert_eq!(negative.is_ok(), ["phase_lag", "load_torque"].contains(&field.name()), "{field}");
        }
    }
}

/// The warnings of this data sheet, as text.
fn told(sheet: MotorParameters) -> Vec<String> {
    sheet.build().expect("legal").warnings().iter().map(ToString::to_string).collect()
}

#[test]
fn the_traps_of_units_are_told() {
    assert_eq!(told(designers()), [""; 0]);
    type Change = fn(&mut MotorParameters);
    let traps: [(&str, Change, &str); 15] = [
        ("drive_frequency", |sheet| sheet.drive_frequency = 40e3 * TAU, "an angular frequency in rad/s"),
        ("drive_frequency", |sheet| sheet.drive_frequency = 40e3 / TAU, "divided by 2 pi"),
        ("drive_frequency", |sheet| sheet.drive_frequency = 40.0, "in kHz"),
        (
            "preload_acceleration",
            |sheet| {
                sheet.preload_force = None;
                sheet.preload_acceleration = Some(5.0);
            },
            "a force in N",
        ),
        ("contact_radius", |sheet| sheet.contact_radius = 13.5, "in mm"),
        ("gyration_radius", |sheet| sheet.gyration_radius = Some(13.5), "in mm"),
        ("rotor_radius", |sheet| sheet.rotor_radius = Some(13.5), "in mm"),
        ("amplitude", |sheet| sheet.amplitude = Some(0.05), "in um"),
        ("amplitude", |sheet| sheet.amplitude = Some(5e-4), "in mm"),
        ("preload_force", |sheet| sheet.preload_force = Some(5e3), "in mN, or an acceleration"),
        ("preload_force", |sheet| sheet.preload_force = Some(3e5), "in mN"),
        ("mass", |sheet| sheet.mass = Some(20.0), "in g"),
        ("phase_lag", |sheet| sheet.phase_lag = -30.0, "in degrees"),
        ("peak_angular_speed", |sheet| sheet.peak_angular_speed = Some(3_000.0), "in rpm"),
        ("spring_constant", |sheet| sheet.spring_constant = Some(1e-3), "factor of 1000"),
    ];
    for (field, change, meant) in traps {
        let mut sheet = designers();
        change(&mut sheet);
        let told = told(sheet);
        assert!(
            told.iter().any(|text| text.starts_with(&format!("{field} = ")) && text.contains(meant)),
            "{field}: {told:?}"
        );
    }
}

/// The usual ranges end at the documented values, as does the range beyond which a value is far outside.
#[test]
fn warnings_begin_where_they_are_said_to() {
    let of = |constant: f64| {
        let stiff = MotorParameters { spring_constant: Some(constant), ..designers() };
        let warnings = stiff.build().expect("legal").warnings();
        warnings.iter().any(|warning| matches!(warning, MotorWarning::FarOutside { .. }))
    };
    assert!(!of(10.0) && !of(1e7) && !of(0.01) && !of(1e10));
    assert!(of(0.01_f64.next_down()) && of(1e10_f64.next_up()) && of(5e-324) && of(1e300));
    let readings = |force: f64| {
        let motor = MotorParameters { preload_force: Some(force), ..designers() }.build().expect("legal");
        motor.warnings().len()
    };
    assert_eq!([0.1, 500.0, 500.0_f64.next_up()].map(readings), [0, 0, 1]);
    // Nothing moves, nothing rubs: assumed to be intended.
    let still = MotorParameters {
        amplitude: Some(0.0),
        peak_angular_speed: Some(0.0),
        friction: 0.0,
        restitution: 0.0,
        ..designers()
    };
    assert_eq!(told(still), [""; 0]);
    let motor = designers().build().expect("legal");
    let overloaded = |torque: f64| motor.with(|sheet| sheet.load_torque = torque).expect("legal").warnings();
    let largest = motor.largest_torque();
    assert!(overloaded(largest).is_empty() && overloaded(-largest).is_empty());
    for torque in [largest.next_up(), -1.0] {
        let warnings = overloaded(torque);
        assert!(matches!(warnings[..], [MotorWarning::Overload { .. }]), "{warnings:?}");
    }
    let narrow = MotorParameters { rotor_radius: Some(1e-3), ..designers() };
    let named: Vec<_> = told(narrow).iter().map(|text| text[..8].to_owned()).collect();
    assert_eq!(named, ["contact_", "gyration"]);
}

#[test]
fn a_spring_that_is_too_stiff_for_the_flights_is_told() {
    let motor = designers().build().expect("legal");
    let rise = motor.highest_rise();
    // k rise/F = 1 %.
    let soft = 0.01 * 5.0 / rise;
    let bound = |constant: f64| {
        let motor = motor.with(|sheet| sheet.spring_constant = Some(constant)).expect("legal");
        (motor.preload_change_bound().expect("a spring"), motor.warnings())
    };
    let (gentle, none) = bound(0.999 * soft);
    assert!(gentle < 0.01 && gentle > 0.0099 && none.is_empty(), "{gentle} {none:?}");
    let (hard, told) = bound(1.001 * soft);
    assert!(hard > 0.01 && told == [MotorWarning::PreloadChanges { bound: hard }], "{hard} {told:?}");
    let motor = motor.with(|sheet| sheet.spring_constant = Some(2_000.0)).expect("legal");
    assert!((motor.static_deflection().expect("a spring") - 2.5e-3).abs() < 1e-17);
    // The formula evaluated by hand, in SI: V = (U + r sqrt(U^2 + 4 A g (1-r)/(1+r)))/(1-r), with U = A
    // omega.
    let (speed, g, r): (f64, f64, f64) = (0.5e-6 * TAU * 40e3, 250.0, 0.5);
    let launch = (speed + r * (speed * speed + 4.0 * 0.5e-6 * g * (1.0 - r) / (1.0 + r)).sqrt()) / (1.0 - r);
    let expected = 0.5e-6 + launch * launch / (2.0 * g);
    assert!((rise / expected - 1.0).abs() < 1e-10, "{rise} {expected}");
}

fn regime_of(axial_forcing: f64, restitution: f64) -> MotorRegime {
    let system =
        ForcingParameters { axial_forcing, angular_forcing: 1.0, phase_lag: 0.0, restitution }.build();
    regime(&system.expect("legal"), &Unobserved).expect("no failure").0
}

#[test]
fn a_stator_that_never_falls_away_throws_nothing() {
    let at = |peak_acceleration: f64| {
        let system = DimensionlessParameters {
            peak_acceleration,
            twist_speed: 1.0,
            phase_lag: 0.0,
            friction: 0.1,
            restitution: 0.5,
            load: 0.0,
        };
        regime(&system.build().expect("legal"), &Unobserved).expect("no failure")
    };
    for gentle in [0.0, 5e-324, 0.5, 1.0] {
        assert_eq!(at(gentle), (MotorRegime::NoLiftOff, None), "{gentle}");
    }
    for lively in [1.0_f64.next_up(), 1.0 + 1e-9, 1.01] {
        let (regime, _) = at(lively);
        assert!(
            matches!(regime, MotorRegime::LowPeriodChattering(cycle) if cycle.is_single_toss()),
            "{lively}: {regime:?}"
        );
    }
}

/// Compared with the results of the core and the paper for these parameters, each obtained in another way.
#[test]
fn regimes_are_those_that_are_known() {
    let low = |regime: &MotorRegime| matches!(regime, MotorRegime::LowPeriodChattering(_));
    assert!(low(&regime_of(0.48, 0.5)), "{:?}", regime_of(0.48, 0.5));
    // Without restitution every impact ends a round.
    assert!(low(&regime_of(60.0, 0.0)), "{:?}", regime_of(60.0, 0.0));
    // A periodic motion without rest, which the core finds by iteration and refinement.
    for (forcing, restitution) in [(0.7, 0.3), (1.0, 0.5)] {
        let vibration = Vibration::from_axial_forcing(forcing).expect("legal");
        let map = ImpactMap::new(vibration, restitution).expect("legal");
        let start = Launch::new(vibration.separation_phase().expect("P > 1"), 0.0).expect("legal");
        let impact = vibration.first_impact(start).expect("lands");
        let orbit = map
            .settled_orbit(impact.into(), 10_000, 64, 1e-9, &Unobserved)
            .expect("no failure")
            .expect("periodic");
        let expected =
            MotorRegime::Periodic { impacts: orbit.period(), platform_periods: orbit.platform_periods };
        assert_eq!(regime_of(forcing, restitution), expected);
    }
    // A long cycle of rests, with 4393 impacts without perturbation, and a periodic motion that settles
    // slowly.
    let vertical = |peak_acceleration: f64, restitution: f64| {
        let system = ForcingParameters {
            axial_forcing: peak_acceleration / PI,
            angular_forcing: 1.0,
            phase_lag: 0.0,
            restitution,
        };
        regime(&system.build().expect("legal"), &Unobserved).expect("no failure").0
    };
    let long = vertical(1.5, 0.9);
    assert!(matches!(long, MotorRegime::LongChattering { rests: 1.., .. }), "{long:?}");
    assert_eq!(vertical(1.05, 0.999), MotorRegime::Periodic { impacts: 2, platform_periods: 8 });
    // Chaos, with an exponent that the core's sweep finds from another start.
    let map = ImpactMap::new(Vibration::from_axial_forcing(5.0).expect("legal"), 0.9).expect("legal");
    let state = ImpactState::from_normalised(1.0, 30.0).expect("legal");
    let expected = lyapunov_exponents(&[(map, state)], 100, 5_000, &Unobserved).expect("no failure")[0]
        .expect("no rest");
    let MotorRegime::Chaotic { lyapunov_exponent } = regime_of(5.0, 0.9) else {
        panic!("{:?}", regime_of(5.0, 0.9))
    };
    assert!((lyapunov_exponent / expected - 1.0).abs() < 0.1, "{lyapunov_exponent} {expected}");
}

/// The mean time between rests agrees with that of the ensembles, which use other code and other random
/// numbers.
#[test]
fn the_paper_s_motor_rests_as_often_as_its_ensemble() {
    let motor = Motor::paper_70_khz();
    let MotorRegime::LongChattering { platform_periods, rests } =
        motor.report(&Unobserved).expect("no failure").regime
    else {
        panic!("{:?}", motor.report(&Unobserved))
    };
    let settings = TransientSettings { duration: 5.0, intervals: 10, ..TransientSettings::default() };
    let runs = TransientEnsemble::new(motor.system(), &settings, 8, &Unobserved).expect("no failure");
    let separations: u64 = runs.curves.iter().map(|curve| curve.separations).sum();
    let expected = 8.0 * 5.0 * 70e3 / separations as f64;
    // Waiting times scatter by about their mean.
    let tolerance = 4.0 / (rests as f64).sqrt();
    assert!(tolerance < 0.4, "{rests}");
    assert!((platform_periods / expected - 1.0).abs() < tolerance, "{platform_periods} {expected} {rests}");
}

#[test]
fn reports_tell_what_there_is() {
    let motor = disc().build().expect("legal");
    let report = motor.report(&Unobserved).expect("no failure");
    let text = report.to_string();
    for line in
        ["Gamma = ", "Gamma_T = ", "P = ", "regime: ", "a flight lasts ", "largest torque", "deflection"]
    {
        assert!(text.contains(line), "{line}: {text}");
    }
    assert_eq!(report.warnings, motor.warnings());
    for warning in &report.warnings {
        assert!(text.contains(&format!("\nwarning: {warning}")), "{text}");
    }
    // The motor itself prints the lines of the report without the motion.
    for line in motor.to_string().lines() {
        assert!(text.lines().any(|other| other == line), "{line}: {text}");
    }
    let slippery = motor.with(|sheet| sheet.friction = 0.0).expect("legal");
    assert!(slippery.to_string().contains("Gamma_T = infinite"), "{slippery}");
    let plain = designers().build().expect("legal").report(&Unobserved).expect("no failure");
    assert!(!plain.to_string().contains("spring") && !plain.to_string().contains("warning"), "{plain}");
}

#[test]
fn a_report_can_be_stopped() {
    let motor = designers().build().expect("legal");
    check_stops(None, |observer| motor.report(observer));
}

/// The report is the same each time, because it keeps no state and its perturbations have a fixed seed. It
/// does not depend on the rotation.
#[test]
fn reports_do_not_depend_on_what_turns() {
    let motor = designers().build().expect("legal");
    let report = motor.report(&Unobserved).expect("no failure");
    assert_eq!(motor.report(&Unobserved).expect("no failure"), report);
    let turned = motor
        .with(|sheet| {
            sheet.friction = 0.7;
            sheet.phase_lag = 2.0;
            sheet.peak_angular_speed = Some(100.0);
            sheet.load_torque = 1e-4;
        })
        .expect("legal");
    let other = turned.report(&Unobserved).expect("no failure");
    assert_eq!((other.regime, other.periods_per_flight), (report.regime, report.periods_per_flight));
}

#[test]
fn errors_and_warnings_are_of_one_kind_each() {
    let both = Error::BothGiven { one: "mass", other: "density" };
    let neither = Error::NeitherGiven { one: "mass", other: "density" };
    assert_ne!(discriminant(&both), discriminant(&neither));
    for (error, words) in [
        (both, ["both mass", "and density"]),
        (neither, ["neither mass", "nor density"]),
        (Error::NotGiven { field: "friction" }, ["friction", "not given"]),
    ] {
        let text = error.to_string();
        assert!(words.iter().all(|word| text.contains(word)), "{text}");
    }
}

#[cfg(feature = "json")]
mod stored {
    use super::*;

    fn through_serde(motor: &Motor) {
        let text = serde_json::to_string(motor).expect("writes");
        assert_eq!(serde_json::from_str::<Motor>(&text).expect("legal"), *motor);
        // The output of serde is a data sheet, too.
        assert_eq!(Motor::from_json(&text), Ok(motor.clone()));
        let mut binary = Vec::new();
        ciborium::into_writer(motor, &mut binary).expect("writes");
        assert_eq!(ciborium::from_reader::<Motor, _>(&*binary).expect("legal"), *motor);
    }

    #[test]
    fn what_serde_reads_is_checked() {
        for sheet in [designers(), disc()] {
            through_serde(&sheet.build().expect("legal"));
        }
        let text = Motor::paper_70_khz().to_json();
        for (from, to, complaint) in [
            ("0.5", "1.5", "restitution"),
            ("\"load_torque\"", "\"load_torqe\"", "load_torqe"),
            ("\"preload_acceleration\"", "\"spring_constant\"", "preload_force"),
            ("\"friction\": 0.1,", "", "friction"),
        ] {
            let error = serde_json::from_str::<Motor>(&text.replace(from, to)).expect_err(to);
            assert!(error.to_string().contains(complaint), "{error}");
        }
    }
}

#[cfg(feature = "toml")]
#[test]
fn a_unit_in_a_data_sheet_is_refused_in_words_of_data_sheets() {
    let text = Motor::paper_70_khz().to_toml();
    for (frequency, complaint) in [
        ("drive_frequency = 40 kHz", "a number without a unit"),
        ("drive_frequency = \"40 kHz\"", "expected a number"),
    ] {
        let lines =
            text.lines().map(|line| if line.starts_with("drive_frequency") { frequency } else { line });
        let error = Motor::from_toml(&lines.collect::<Vec<_>>().join("\n")).expect_err(frequency).to_string();
        assert!(error.contains(complaint) && error.starts_with("line 1:"), "{error}");
    }
}

proptest! {
    /// A data sheet that is written and read again has the same bits.
    #[test]
    fn files_are_exact(
        frequency in 1e3_f64..1e6, amplitude in 0.0_f64..1e-5, lag in -10.0_f64..10.0, mass in 1e-4_f64..1.0,
        force in 1e-3_f64..1e3, spring in proptest::option::of(1.0_f64..1e9), friction in 0.0_f64..1.0,
        restitution in 0.0_f64..0.99, torque in -1.0_f64..1.0, by_density in any::<bool>(),
    ) {
        let base = if by_density { disc() } else { MotorParameters { mass: Some(mass), ..designers() } };
        let sheet = MotorParameters {
            drive_frequency: frequency, amplitude: Some(amplitude), phase_lag: lag, preload_force: Some(force),
            spring_constant: spring, friction, restitution, load_torque: torque, ..base
        };
        let Ok(motor) = sheet.build() else { return Ok(()) };
        #[cfg(feature = "json")]
        prop_assert_eq!(Motor::from_json(&motor.to_json()), Ok(motor.clone()));
        #[cfg(feature = "toml")]
        prop_assert_eq!(Motor::from_toml(&motor.to_toml()), Ok(motor.clone()));
        prop_assert_eq!(motor.parameters(), &sheet);
    }
}

#[test]
fn a_measurement_in_another_unit_is_found_by_the_drive() {
    let motor = Motor::paper_70_khz();
    let rise = |times_in: f64, speeds_in: f64| {
        let times: Vec<f64> = (0..100).map(|k| 0.05 * f64::from(k) * times_in).collect();
        let speeds =
            times.iter().map(|time| 21.5 * speeds_in * (1.0 - exp(-time / (0.85 * times_in)))).collect();
        let speeds = MeasuredSpeeds::new(vec![MeasuredRun { member: 0, times, speeds }]).expect("legal");
        motor.warnings_on(&speeds).iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(rise(1.0, 1.0), [""; 0]);
    let [time] = &rise(1e3, 1.0)[..] else { panic!("one") };
    assert!(
        time.contains("rise time of 600 s") && time.ends_with("0.972 s: is it in another unit?"),
        "{time}"
    );
    let [speed] = &rise(1.0, 1e-3)[..] else { panic!("one") };
    assert!(speed.starts_with("a measured speed of 0.02"), "{speed}");
    // A stator that does not twist gives no scale.
    let still = motor.with(|sheet| sheet.peak_angular_speed = Some(0.0)).expect("legal");
    assert_eq!(
        still.warnings_on(
            &MeasuredSpeeds::new(vec![MeasuredRun {
                member: 0,
                times: vec![0.0, 1.0, 2.0],
                speeds: vec![0.0, 5.0, 6.0]
            }])
            .expect("legal")
        ),
        []
    );
}

/// One stator of each kind and drive, on the motor of Table III.
fn yielding() -> Vec<Motor> {
    use crate::parameters::stator::{StatorKind, StatorParameters};
    let axial = StatorParameters { mass: Some(0.01), quality: Some(300.0), ..StatorParameters::default() };
    let force = StatorParameters { force: Some(0.7), resonance: Some(70.1e3), ..axial };
    let volts = StatorParameters { volts: Some(0.3), force_per_volt: Some(2.4), ..axial };
    let circuit = StatorParameters {
        force_per_volt: None,
        resonance: Some(69.9e3),
        anti_resonance: Some(71.3e3),
        capacitance: Some(1.1e-9),
        ..volts
    };
    let twisting =
        StatorParameters { kind: StatorKind::AxialTwist, twist_per_height: Some(-6.7e3), ..circuit };
    let torsional = StatorParameters {
        kind: StatorKind::AxialAndTorsional,
        inertia: Some(2e-8),
        torsional_quality: Some(200.0),
        torsional_resonance: Some(70.2e3),
        ..circuit
    };
    let torque = StatorParameters { torque: Some(1e-3), torque_phase: Some(0.4), ..torsional };
    let both = StatorParameters { torque_per_volt: Some(-3e-3), ..torsional };
    let motor = |table: StatorParameters| {
        let built = Motor::paper_70_khz().with(|sheet| {
            sheet.stator = Some(table);
            let [lifts, twists] = table.computes();
            sheet.amplitude = sheet.amplitude.filter(|_| lifts.is_none());
            sheet.peak_angular_speed = sheet.peak_angular_speed.filter(|_| twists.is_none());
        });
        built.expect("legal")
    };
    [axial, force, volts, circuit, twisting, torsional, torque, both].map(motor).to_vec()
}

/// A sheet, its files and its system have the same stator, to the last bit, and derived values follow the
/// sheet.
#[test]
fn a_stator_is_read_as_it_is_written() {
    for motor in yielding() {
        let (stator, platform) = (motor.stator().expect("yields"), motor.system().platform());
        assert_eq!(stator.motion(), platform.parameters());
        #[cfg(feature = "json")]
        {
            assert_eq!(Motor::from_json(&motor.to_json()), Ok(motor.clone()));
            let text = serde_json::to_string(&motor).expect("writes");
            assert_eq!(serde_json::from_str::<Motor>(&text).expect("reads"), motor);
            let text = serde_json::to_string(motor.system()).expect("writes");
            assert_eq!(serde_json::from_str::<System>(&text).expect("reads"), *motor.system());
        }
        #[cfg(feature = "toml")]
        assert_eq!(Motor::from_toml(&motor.to_toml()), Ok(motor.clone()));
        let again = MotorParameters::of_system(motor.system(), motor.mass()).build().expect("legal");
        assert!(
            (again.stator().expect("yields").motion().amplitude / platform.amplitude() - 1.0).abs() < 1e-13
        );
        // Twice the force, and other inconsistent changes of the system.
        let sheet = motor.parameters();
        for field in [MotorField::StatorVolts, MotorField::StatorForce] {
            let Some(value) = field.value(sheet) else { continue };
            let double = motor.with(|sheet| field.set(sheet, 2.0 * value)).expect("legal");
            assert!((double.system().platform().amplitude() / platform.amplitude() - 2.0).abs() < 1e-15);
            let other = motor.system().with_platform(|platform| platform.amplitude *= 2.0);
            assert_eq!(other, Err(Error::BothGiven { one: "amplitude", other: field.name() }));
        }
        if stator.parameters().computes()[1].is_some() {
            let other = motor.system().with_platform(|platform| platform.twist_amplitude *= 2.0);
            assert!(matches!(other, Err(Error::BothGiven { one: "twist_amplitude", .. })), "{other:?}");
        }
        let still = motor.with(|sheet| MotorField::Amplitude.set(sheet, 3e-9)).expect("legal");
        assert!((still.stator().expect("yields").motion().amplitude - 3e-9).abs() < 1e-24);
    }
}

#[cfg(feature = "toml")]
#[test]
fn a_load_is_read_as_it_is_written() {
    let law = LoadLaw::fan(20.0, 1e-6, 7).and_then(|law| law.with_factors(&[0.1, 0.3], &[0.7, 0.0]));
    let law = law.and_then(|law| law.with_inertia(1e-7)?.with_drive(0.05, 0.4)).expect("legal");
    // Only a compliant stator can be switched on and off.
    let constant = LoadLaw::constant(1e-7).expect("legal");
    for (motor, load) in [(yielding()[0].clone(), law), (Motor::paper_70_khz(), constant)] {
        let motor = motor.with(|sheet| sheet.load = Some(load)).expect("legal");
        assert_eq!(motor.load(), Some(load));
        assert_eq!(Motor::from_toml(&motor.to_toml()), Ok(motor.clone()));
        assert_eq!(Motor::from_json(&motor.to_json()), Ok(motor));
    }
    let sheet = Motor::paper_70_khz().to_toml();
    for (load, told) in [
        ("", "number of load.speeds = 0 is outside its legal range [1, 16]"),
        ("torques = [1.0]", "load.speeds has 0 entries and load.torques 1: they need the same length"),
        (
            "speeds = [1]\ntorques = [1, 2]",
            "load.speeds has 1 entry and load.torques 2: they need the same length",
        ),
        (
            "speeds = [1]\ntorques = [1]\ntimes = [0, 1]\nfactors = [1]",
            "load.times has 2 entries and load.factors 1: they need the same length",
        ),
        ("speeds = [1, 0]\ntorques = [1, 0]", "load.speeds = 0 is not legal: it must be finite and greater"),
        (
            "speeds = [0]\ntorques = [0]\noff = nan",
            "load.off = NaN is not legal: it must be after load.on (s)",
        ),
        ("speeds = [0]\ntorques = [0]\non = nan", "load.on = NaN is outside its legal range [-inf, inf) (s)"),
        ("speds = [0]", "\"speds\" is unknown; did you mean \"speeds\"?"),
        ("speeds = 1", "a list"),
    ] {
        let error = Motor::from_toml(&format!("{sheet}[load]\n{load}\n")).expect_err(load).to_string();
        assert!(error.contains(told), "{load}: {error}");
    }
}

#[cfg(feature = "toml")]
#[test]
fn faults_of_a_table_stator_are_told() {
    let text = yielding()[3].to_toml();
    for (from, to, told) in [
        ("[stator]", "[statr]", "did you mean \"stator\"?"),
        ("[stator]", "[stator]\nmas = 1", "\"mas\" is unknown; did you mean \"mass\"?"),
        ("\"axial\"", "\"axail\"", "did you mean \"axial\"?"),
        ("friction = ", "amplitude = 1e-8\nfriction = ", "both amplitude and stator.volts are given"),
        ("anti_resonance = 71300.0", "anti_resonance = 69e3", "stator.anti_resonance = 69000 is not legal"),
        ("friction = ", "'stator.mass' = 1\nfriction = ", "did you mean \"stator\"?"),
        ("quality = 300.0", "quality = 0.3", "stator.quality = 0.3 is outside its legal range [0.5, 1e5]"),
        (
            "quality = 300.0",
            "quality = 1e6",
            "stator.quality = 1000000 is outside its legal range [0.5, 1e5]",
        ),
    ] {
        assert!(text.contains(from), "{from}\n{text}");
        let error = Motor::from_toml(&text.replace(from, to)).expect_err(to).to_string();
        assert!(error.contains(told), "{to}: {error}");
    }
    // In volts the amplitude of the sheet is removed, and nothing is given to compute another one from.
    let table = "[stator]\nmass = 0.05\nquality = 300.0\n";
    let by_amplitude = format!("{}{table}", Motor::paper_70_khz().to_toml());
    let volts = Motor::from_toml_with(&by_amplitude, &[(MotorField::StatorVolts, 20.0)]);
    assert_eq!(
        volts.expect_err("no force per volt").to_string(),
        "stator.volts needs stator.force_per_volt, or stator.anti_resonance with stator.capacitance; specify the drive once: \
         amplitude (no rotor, at the drive frequency), stator.force or stator.volts"
    );
    let prescribed = Motor::paper_70_khz().to_toml().replace("amplitude = 1e-8", "");
    assert_eq!(Motor::from_toml(&prescribed), Err(Error::NotGiven { field: "amplitude" }.into()));
}

/// A prescribed motion cannot be switched off; the statements of a report do not depend on the load.
#[test]
fn a_load_on_a_motion_that_is_prescribed() {
    let motor = Motor::paper_70_khz();
    let fan = LoadLaw::fan(20.0, 1e-6, 5).and_then(|fan| fan.with_inertia(1e-7)).expect("legal");
    let with = |load| motor.with(|sheet| sheet.load = Some(load)).expect("legal");
    for [on, off] in [[0.0, f64::INFINITY], [f64::NEG_INFINITY, 1.0]] {
        let refused = motor.with(|sheet| sheet.load = fan.with_drive(on, off).ok());
        assert_eq!(refused, Err(Error::SwitchedMotion));
        assert!(!Error::SwitchedMotion.to_string().contains("NaN"));
    }
    assert_eq!(with(fan).report(&Unobserved), motor.report(&Unobserved));
    let heavy = with(LoadLaw::constant(-2.0 * motor.largest_torque()).expect("legal")).warnings();
    assert!(heavy.iter().any(|warning| matches!(warning, MotorWarning::Overload { .. })), "{heavy:?}");
}

/// No analysis treats a compliant stator as a prescribed one, or ignores a varying load.
#[test]
fn what_needs_a_prescribed_motion_refuses_a_stator_that_yields() {
    use crate::motor::operation::settings::OperatingSettings;
    use crate::motor::{TransientMember, low_period_traps, transient, transients};
    use crate::toss::{InitialSpin, single_toss};
    let motor = yielding()[0].clone();
    let (settings, run_up) = (OperatingSettings::default(), TransientSettings::default());
    let soft = motor.with(|sheet| MotorField::ContactTime.set(sheet, 1e-5)).expect("legal");
    let phase = bouncing_disk_core::Phase::new(0.0).expect("legal");
    let fan = LoadLaw::fan(20.0, 1e-6, 5).ok();
    let loaded = Motor::paper_70_khz().with(|sheet| sheet.load = fan).expect("legal");
    let both = loaded.with(|sheet| sheet.load_torque = 1e-9);
    assert_eq!(both, Err(Error::BothGiven { one: "load_torque", other: "load" }));
    for (motor, told) in
        [(motor, Error::YieldingStator), (soft, Error::YieldingStator), (loaded, Error::LoadLaw)]
    {
        let refused = |error: Option<Error>| assert_eq!(error, Some(told));
        refused(motor.report(&Unobserved).err().or((told == Error::LoadLaw).then_some(told)));
        refused(motor.trap_verdict().err());
        refused(low_period_traps(&motor, &[9.8], &Unobserved).err());
        refused(motor.nearest_trap(0.1, &Unobserved).err());
        refused(motor.trap_ranges([9.0, 10.0], 0.05, &settings, &Unobserved).err());
        refused(transient(motor.system(), phase, &run_up, &Unobserved).err());
        let member = TransientMember { system: *motor.system(), phase, settings: run_up };
        refused(transients(&[member], &Unobserved).expect("not stopped").remove(0).err());
        refused(single_toss(motor.system(), InitialSpin::AbsoluteRest).err());
    }
}

/// The preload above which a rotor in steady contact is no longer lifted agrees with the engine, also off
/// resonance.
#[test]
fn the_preload_that_is_not_lifted_is_that_of_the_engine() {
    use crate::motion::phase_time::PhaseTime;
    use crate::motion::state::{DiskState, Mode};
    use crate::parameters::stator::StatorParameters;
    use crate::stator::{StatorEngine, StatorState, StatorSystem};
    for (mass, quality, f) in
        [(10.0, 300.0, 1.0), (0.3, 50.0, 1.02), (10.0, 300.0, 1.001), (100.0, 20.0, 0.97)]
    {
        let motor = |preload: Option<f64>| {
            let built = Motor::paper_70_khz().with(|sheet| {
                (sheet.amplitude, sheet.mass, sheet.peak_angular_speed) = (Some(1e-7), Some(0.03), Some(0.0));
                (sheet.density, sheet.rotor_radius, sheet.rotor_thickness) = (None, None, None);
                sheet.preload_force = preload;
                sheet.preload_acceleration = sheet.preload_acceleration.filter(|_| preload.is_none());
                sheet.stator = Some(StatorParameters {
                    mass: Some(0.03 * mass),
                    quality: Some(quality),
                    resonance: Some(f * sheet.drive_frequency),
                    ..StatorParameters::default()
                });
            });
            built.expect("legal")
        };
        let limit = motor(None).stator_report().expect("yields").lift_off_preload.expect("axial");
        for (factor, lifts) in [(1.0 + 1e-9, false), (1.0 - 1e-9, true)] {
            let motor = motor(Some(limit * factor));
            let warns = motor.warnings().iter().any(|own| matches!(own, MotorWarning::NotLifted { .. }));
            assert_ne!(warns, lifts);
            let system = StatorSystem::of_system(motor.system(), motor.mass()).expect("legal");
            // The steady motion of the pair is the imaginary part of P K/(K - 1) exp(i tau), minus the sag.
            let (re, im) = (mass * (f * f - 1.0), mass * f / quality);
            let (pair, peak) = (re - 1.0, motor.system().peak_acceleration());
            let share = peak / (pair * pair + im * im);
            let at_zero =
                [share * (im * pair - re * im) - 1.0 / (mass * f * f), share * (re * pair + im * im)];
            let disk = DiskState {
                mode: Mode::Sticking,
                height: 0.0,
                axial_velocity: 0.0,
                angle: 0.0,
                angular_speed: 0.0,
            };
            let from = StatorState { disk, modes: [at_zero, [0.0; 2]] };
            let phase = bouncing_disk_core::Phase::new(0.0).expect("finite");
            let engine = StatorEngine::of_state(system, PhaseTime::in_first_period(phase), from);
            let next = engine.and_then(|mut engine| engine.advance()).expect("no failure");
            assert_eq!(next.is_some(), lifts, "{mass} {quality} {f} {factor} {next:?}");
        }
    }
}

/// Rigid impacts on modes are not a valid model of contacts that last longer than a period.
#[test]
fn rigid_impacts_on_a_stator_that_yields_are_warned_of() {
    let warned = |contact: Option<Contact>| {
        let motor = yielding()[0].with(|sheet| sheet.contact = contact).expect("legal");
        let mut warnings = motor.warnings().into_iter();
        warnings.find_map(
            |own| if let MotorWarning::RigidOnModes { periods } = own { Some(periods) } else { None },
        )
    };
    assert_eq!(warned(None), Some(None));
    assert_eq!(warned(Some(Contact::lasting(1e-5))), None);
    let ball = |speed: f64| Contact { speed: Some(speed), mass: None, ..Contact::PAPER };
    assert!(warned(Some(ball(5.8e-3))).is_some_and(|periods| periods.is_some_and(|periods| periods > 1.0)));
    assert_eq!(warned(Some(Contact { mass: None, speed: None, ..Contact::PAPER })), Some(None));
}
