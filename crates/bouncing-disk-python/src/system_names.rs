//! What follows from the parameters of a system and has a range of its own, and from which of them.

use crate::names::{Name, derived, name};

/// The units of the two energies, the two speeds and the rest, by what they are made of.
const PLATFORM_AND_DISK: [&str; 5] =
    ["twist_amplitude", "angular_frequency", "contact_radius", "gyration_radius", "preload_acceleration"];
const TIME: [&str; 1] = ["angular_frequency"];
const LENGTH: [&str; 2] = ["angular_frequency", "preload_acceleration"];
const ANGLE: [&str; 4] = ["angular_frequency", "contact_radius", "gyration_radius", "preload_acceleration"];
const LOAD: [&str; 4] = ["load_acceleration", "contact_radius", "gyration_radius", "preload_acceleration"];

const UNITS: [Name; 9] = [
    derived("unit of time (s)", &TIME),
    derived("unit of length (m)", &LENGTH),
    derived("unit of velocity (m/s)", &LENGTH),
    derived("unit of angle (rad)", &ANGLE),
    derived("unit of angular speed (rad/s)", &ANGLE),
    derived("unit of angular acceleration (rad/s^2)", &ANGLE),
    derived("unit of axial energy (J/kg)", &LENGTH),
    derived("unit of rotary energy (J/kg)", &ANGLE),
    derived("load", &LOAD),
];

const fn with_units<const MORE: usize, const ALL: usize>(more: [Name; MORE]) -> [Name; ALL] {
    let mut all = [UNITS[0]; ALL];
    let mut place = 0;
    while place < ALL {
        all[place] = if place < MORE { more[place] } else { UNITS[place - MORE] };
        place += 1;
    }
    all
}

/// What follows from the arguments of `System`.
pub(crate) const DERIVED: [Name; 11] = with_units([
    derived("peak_acceleration", &["amplitude", "angular_frequency", "preload_acceleration"]),
    derived("twist_speed", &PLATFORM_AND_DISK),
]);

/// What follows from those of `System.from_stroke`.
pub(crate) const OF_STROKE: [Name; 13] = with_units([
    derived("peak_acceleration", &["stroke", "amplitude_angle", "angular_frequency", "preload_acceleration"]),
    derived("twist_speed", &["stroke", "angular_frequency", "gyration_radius", "preload_acceleration"]),
    derived("amplitude", &["stroke", "amplitude_angle"]),
    derived("twist_amplitude", &["stroke", "amplitude_angle", "contact_radius"]),
]);

/// What follows from those of `System.with_load_torque`: all else was legal before.
pub(crate) const OF_LOAD: [Name; 3] = [
    derived("load_acceleration", &["torque", "mass"]),
    derived("load", &["torque", "mass"]),
    derived("moment of inertia", &["mass", "self.gyration_radius"]),
];

/// The parameters in a dictionary of two.
pub(crate) const OF_PARTS: [Name; 21] = {
    const PARTS: [Name; 10] = [
        name("amplitude", &["platform.amplitude"]),
        name("twist_amplitude", &["platform.twist_amplitude"]),
        name("angular_frequency", &["platform.angular_frequency"]),
        name("phase_lag", &["platform.phase_lag"]),
        name("contact_radius", &["disk.contact_radius"]),
        name("gyration_radius", &["disk.gyration_radius"]),
        name("friction", &["disk.friction"]),
        name("restitution", &["disk.restitution"]),
        name("preload_acceleration", &["disk.preload_acceleration"]),
        name("load_acceleration", &["disk.load_acceleration"]),
    ];
    let mut all = [PARTS[0]; 21];
    let mut place = 0;
    while place < all.len() {
        all[place] = if place < PARTS.len() { PARTS[place] } else { DERIVED[place - PARTS.len()] };
        place += 1;
    }
    all
};

/// What follows from the arguments of `Motor`, with their alternatives.
pub(crate) const OF_MOTOR: [Name; MOTOR_NAMES] = [
    derived("peak_acceleration", &MOTOR_LIFT),
    derived("twist_speed", &MOTOR_TWIST),
    derived("preload_acceleration = preload_force/mass", &with_mass::<5>(&["preload_force"])),
    derived("preload_force = mass*preload_acceleration", &with_mass::<5>(&["preload_acceleration"])),
    derived("moment of inertia", &with_mass::<5>(&["gyration_radius"])),
    derived("load_acceleration", &MOTOR_LOAD),
    derived("load", &MOTOR_LOAD),
    derived("unit of time (s)", &["drive_frequency"]),
    derived("unit of length (m)", &MOTOR_LIFT),
    derived("unit of velocity (m/s)", &MOTOR_LIFT),
    derived("unit of angle (rad)", &MOTOR_TWIST),
    derived("unit of angular speed (rad/s)", &MOTOR_TWIST),
    derived("unit of angular acceleration (rad/s^2)", &MOTOR_TWIST),
    derived("unit of axial energy (J/kg)", &MOTOR_LIFT),
    derived("unit of rotary energy (J/kg)", &MOTOR_TWIST),
];
pub(crate) const MOTOR_NAMES: usize = 15;

/// What gives the mass of a rotor.
const MASS: [&str; 4] = ["mass", "density", "rotor_radius", "rotor_thickness"];
const MOTOR_LIFT: [&str; 8] =
    with_mass(&["amplitude", "drive_frequency", "preload_force", "preload_acceleration"]);
const MOTOR_TWIST: [&str; 11] = with_mass(&[
    "peak_angular_speed",
    "twist_amplitude",
    "drive_frequency",
    "contact_radius",
    "gyration_radius",
    "preload_force",
    "preload_acceleration",
]);
const MOTOR_LOAD: [&str; 9] =
    with_mass(&["load_torque", "contact_radius", "gyration_radius", "preload_force", "preload_acceleration"]);

/// Some arguments, and after them those that give the mass.
const fn with_mass<const ALL: usize>(others: &[&'static str]) -> [&'static str; ALL] {
    assert!(ALL == others.len() + MASS.len(), "one place for each");
    let mut all = [""; ALL];
    let mut place = 0;
    while place < ALL {
        all[place] = if place < others.len() { others[place] } else { MASS[place - others.len()] };
        place += 1;
    }
    all
}
