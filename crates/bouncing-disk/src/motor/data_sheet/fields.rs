//! The fields of a data sheet: their names, units and symbols, and what such motors have. The ranges and
//! where they come from are in docs/numerics/motors.md, "What such motors have".

use std::f64::consts::{PI, TAU};

use crate::motor::data_sheet::parameters::MotorParameters;

/// How a number would be read if it had been meant in another unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reading {
    /// What it would be: "a length in mm".
    pub(super) meant: &'static str,
    /// What the number is multiplied by.
    pub(super) factor: f64,
    /// What such motors have, in the unit that it then has.
    pub(super) usual: (f64, f64),
}

/// One field.
#[derive(Debug, Clone, Copy)]
pub(super) struct Field {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    /// What such motors have, without the sign; `None` where nothing is said.
    pub(super) usual: Option<(f64, f64)>,
    /// Other units in which the number may have been meant.
    pub(super) readings: &'static [Reading],
    pub(super) get: fn(&MotorParameters) -> Option<f64>,
    pub(super) set: fn(&mut MotorParameters, f64),
    /// Whether a file must have it.
    #[cfg(any(feature = "json", feature = "toml"))]
    pub(super) needed: bool,
    /// The paper's symbol, and other names under which it may be looked for.
    pub(super) also: &'static [&'static str],
}

const FREQUENCIES: (f64, f64) = (2.0e4, 2.0e5);
const LENGTHS: (f64, f64) = (1.0e-4, 0.1);
const FORCES: (f64, f64) = (0.1, 500.0);
/// From the weight of a rotor that stands on its stator.
const ACCELERATIONS: (f64, f64) = (9.8, 1.0e5);
const AMPLITUDES: (f64, f64) = (1.0e-9, 1.0e-5);
const MASSES: (f64, f64) = (1.0e-4, 1.0);
const TURN: (f64, f64) = (0.0, TAU);

const MILLIMETRES: &[Reading] = &[Reading { meant: "a length in mm", factor: 1.0e-3, usual: LENGTHS }];

/// The macro keeps a field's line short; `$get` is what holds the value, plain or optional.
macro_rules! field {
    ($name:ident: $kind:tt, $unit:literal, $usual:expr, $readings:expr, $also:expr) => {
        Field {
            name: stringify!($name),
            unit: $unit,
            usual: $usual,
            readings: $readings,
            get: field!(@get $kind $name),
            set: field!(@set $kind $name),
            #[cfg(any(feature = "json", feature = "toml"))]
            needed: field!(@needed $kind),
            also: $also,
        }
    };
    (@get optional $name:ident) => { |sheet| sheet.$name };
    (@get $kind:ident $name:ident) => { |sheet| Some(sheet.$name) };
    (@set optional $name:ident) => { |sheet, value| sheet.$name = Some(value) };
    (@set $kind:ident $name:ident) => { |sheet, value| sheet.$name = value };
    (@needed needed) => { true };
    (@needed $kind:ident) => { false };
}

/// All fields, in the order in which they are written.
pub(super) const FIELDS: [Field; 17] = [
    field!(drive_frequency: needed, "Hz", Some(FREQUENCIES), &[
        Reading { meant: "a frequency in kHz", factor: 1.0e3, usual: FREQUENCIES },
        Reading { meant: "an angular frequency in rad/s", factor: 1.0 / TAU, usual: FREQUENCIES },
        Reading { meant: "a frequency that was divided by 2 pi", factor: TAU, usual: FREQUENCIES },
    ], &["omega", "angular_frequency", "f"]),
    field!(amplitude: needed, "m", Some(AMPLITUDES), &[
        Reading { meant: "an amplitude in um", factor: 1.0e-6, usual: AMPLITUDES },
        Reading { meant: "an amplitude in nm", factor: 1.0e-9, usual: AMPLITUDES },
        // Above those of the others, which are nearer to what is meant where both fit.
        Reading { meant: "an amplitude in mm", factor: 1.0e-3, usual: AMPLITUDES },
    ], &["A", "axial_amplitude"]),
    field!(peak_angular_speed: optional, "rad/s", Some((0.1, 1.0e3)), &[
        Reading { meant: "a speed in rpm", factor: TAU / 60.0, usual: (0.1, 1.0e3) },
    ], &["platform_speed", "stator_speed", "rotary_speed"]),
    field!(twist_amplitude: optional, "rad", Some((1.0e-7, 1.0e-2)), &[], &["Phi"]),
    field!(phase_lag: optional_with_default, "rad", Some(TURN), &[
        Reading { meant: "an angle in degrees", factor: PI / 180.0, usual: TURN },
    ], &["theta"]),
    field!(mass: optional, "kg", Some(MASSES), &[
        Reading { meant: "a mass in g", factor: 1.0e-3, usual: MASSES },
    ], &["m", "rotor_mass"]),
    field!(density: optional, "kg/m^3", Some((1.0e3, 2.0e4)), &[
        Reading { meant: "a density in g/cm^3", factor: 1.0e3, usual: (1.0e3, 2.0e4) },
    ], &["rho"]),
    field!(rotor_radius: optional, "m", Some(LENGTHS), MILLIMETRES, &["R", "radius"]),
    field!(rotor_thickness: optional, "m", Some(LENGTHS), MILLIMETRES, &["height"]),
    field!(contact_radius: needed, "m", Some(LENGTHS), MILLIMETRES, &["a_e"]),
    field!(gyration_radius: optional, "m", Some(LENGTHS), MILLIMETRES, &["a_g"]),
    field!(preload_force: optional, "N", Some(FORCES), &[
        // Nearly all of these are usual as mN, too.
        Reading { meant: "a force in mN, or an acceleration in m/s^2", factor: 1.0, usual: ACCELERATIONS },
        Reading { meant: "a force in mN", factor: 1.0e-3, usual: FORCES },
    ], &["F", "N", "preload"]),
    field!(preload_acceleration: optional, "m/s^2", Some(ACCELERATIONS), &[
        Reading { meant: "a force in N", factor: 1.0, usual: FORCES },
    ], &["g"]),
    field!(spring_constant: optional, "N/m", Some((10.0, 1.0e7)), &[], &["k", "stiffness"]),
    field!(friction: needed, "1", Some((0.01, 1.0)), &[], &["mu"]),
    field!(restitution: needed, "1", None, &[], &["epsilon", "e", "eps"]),
    field!(load_torque: optional_with_default, "N m", None, &[], &["T_L", "load", "torque"]),
];
