//! The fields of a data sheet: their names, units and symbols, and their usual values for such motors.
//!
//! A number causes a warning (`MotorWarning`) if it is more than a factor 1000 outside these ranges, or if it
//! is outside but would be inside when read in another unit. The ranges are orders of magnitude, not
//! statistics of motors. Zeros are accepted. A number that is outside by less than a factor 1000 and fits no
//! other unit causes no warning; an example is the paper's smallest preload, 80 mN.
//!
//! | field | usual | why | other units |
//! | --- | --- | --- | --- |
//! | `drive_frequency` | 20 to 200 kHz | above hearing; the paper: 70 and 184 kHz | kHz, rad/s, divided by 2 pi |
//! | `amplitude` | 1 nm to 10 um | the paper: 1 to 100 nm; Tsujino's motor a few um | um, nm, mm |
//! | `peak_angular_speed` | 0.1 to 1000 rad/s | the paper: 30 rad/s | rpm |
//! | `twist_amplitude` | 1e-7 to 1e-2 rad | these speeds over these frequencies | |
//! | `phase_lag` | -2 pi to 2 pi | an angle | degrees |
//! | `mass` | 0.1 g to 1 kg | the paper: a ball of 20 mm, 33 g | g |
//! | `stator.mass` | 0.1 g to 1 kg | as the rotor | g |
//! | `stator.resonance` | 20 to 200 kHz | as the drive | kHz |
//! | `density` | 1 to 20 g/cm^3 | polymers to tungsten | g/cm^3 |
//! | radii, thickness | 0.1 to 100 mm | rotors that one can hold; the paper: 1.25 and 6.3 mm | mm |
//! | `preload_force` | 0.1 to 500 N | the paper: 80 to 280 mN; travelling-wave motors about 100 N | mN, m/s^2 |
//! | `preload_acceleration` | 9.8 to 1e5 m/s^2 | from the rotor's weight to 100 N on 1 g | N |
//! | `spring_constant` | 10 to 1e7 N/m | these forces, deflections from 10 um to 10 mm and more | |
//! | `friction` | 0.01 to 1 | lubricated to dry | |
//!
//! The paper's own scan of the preload, 0.1 to 10 m/s^2, causes a warning below 9.8, because 5 N entered as 5
//! m/s^2 looks the same. A mistake goes undetected if the number is also usual in the wrong unit, as when 40
//! 000 rad/s is entered as 40 kHz.

use std::f64::consts::{PI, TAU};
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use crate::motor::data_sheet::parameters::MotorParameters;
use crate::parameters::contact::Contact;
use crate::parameters::stator::StatorParameters;
use crate::sheet_text::{nearest, unknown};

/// Another unit that may have been intended.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reading {
    /// The other meaning: "a length in mm".
    pub(crate) meant: &'static str,
    /// Factor from the number to the unit of `usual`.
    pub(crate) factor: f64,
    /// The usual values for such motors in the other meaning.
    pub(crate) usual: (f64, f64),
}

/// One field.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Field {
    pub(crate) name: &'static str,
    pub(crate) unit: &'static str,
    /// The usual values for such motors; `None` if there is no rule.
    pub(crate) usual: Option<(f64, f64)>,
    /// Other units that may have been intended.
    pub(crate) readings: &'static [Reading],
    pub(crate) get: fn(&MotorParameters) -> Option<f64>,
    /// Sets the field; `None` clears an optional field, and leaves any other field unchanged.
    pub(crate) set: fn(&mut MotorParameters, Option<f64>),
    /// Whether a file must contain the field.
    #[cfg(any(feature = "json", feature = "toml"))]
    pub(crate) needed: bool,
    /// The paper's symbol, and other names under which a user may look for the field.
    also: &'static [&'static str],
}

const FREQUENCIES: (f64, f64) = (2.0e4, 2.0e5);
const LENGTHS: (f64, f64) = (1.0e-4, 0.1);
const FORCES: (f64, f64) = (0.1, 500.0);
/// The lower end is for a rotor that rests on its stator under its own weight.
const ACCELERATIONS: (f64, f64) = (9.8, 1.0e5);
const AMPLITUDES: (f64, f64) = (1.0e-9, 1.0e-5);
const MASSES: (f64, f64) = (1.0e-4, 1.0);
const TURN: (f64, f64) = (0.0, TAU);

const fn reading(meant: &'static str, factor: f64, usual: (f64, f64)) -> Reading {
    Reading { meant, factor, usual }
}

const MILLIMETRES: &[Reading] = &[reading("a length in mm", 1.0e-3, LENGTHS)];

/// A table of a data sheet, some of whose keys are fields.
trait FieldTable: Copy + Default + PartialEq {
    /// The part of the table that remains if one of these keys is set to a new value.
    fn kept(self) -> Self;
}

impl FieldTable for Contact {
    /// A contact time replaces materials.
    fn kept(self) -> Self {
        Self { law: self.law, ..Self::default() }
    }
}

impl FieldTable for StatorParameters {
    fn kept(self) -> Self {
        self
    }
}

/// Writes a key of a table; a table without keys is removed.
fn write<T: FieldTable>(table: &mut Option<T>, key: fn(&mut T) -> &mut Option<f64>, value: Option<f64>) {
    let mut new = table.unwrap_or_default();
    if value.is_some() {
        new = new.kept();
    }
    *key(&mut new) = value;
    *table = (new != T::default()).then_some(new);
}

/// Defines the enum and the table of its fields, in the order in which a data sheet is written.
macro_rules! motor_fields {
    ($($(#[$doc:meta])* $variant:ident, $name:ident $(. $key:ident)?: $kind:ident, $unit:literal, $usual:expr, $readings:expr, $also:expr;)*) => {
        /// A numerical field of [`MotorParameters`].
        ///
        /// It is printed, read and stored as the name of the field, for example `load_torque`.
        ///
        /// ```
        /// use bouncing_disk::motor::MotorField;
        ///
        /// let field: MotorField = "load_torque".parse()?;
        /// assert_eq!((field, field.unit()), (MotorField::LoadTorque, "N m"));
        /// let error = "load_torqe".parse::<MotorField>().expect_err("misspelt");
        /// assert_eq!(
        ///     error.to_string(),
        ///     "the key \"load_torqe\" is unknown; did you mean \"load_torque\"?"
        /// );
        /// # Ok::<(), bouncing_disk::motor::UnknownMotorField>(())
        /// ```
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(try_from = "String", into = "&'static str"))]
        pub enum MotorField {
            $($(#[$doc])* $variant,)*
        }

        const FIELDS: &[Field] = &[$(Field {
            name: concat!(stringify!($name) $(, ".", stringify!($key))?),
            unit: $unit,
            usual: $usual,
            readings: $readings,
            get: motor_fields!(@get $kind $name $($key)?),
            set: motor_fields!(@set $kind $name $($key)?),
            #[cfg(any(feature = "json", feature = "toml"))]
            needed: motor_fields!(@needed $kind),
            also: $also,
        }),*];

        impl MotorField {
            /// All fields, in the order in which a data sheet is written.
            pub const ALL: [Self; FIELDS.len()] = [$(Self::$variant),*];
        }
    };
    (@get optional $name:ident $key:ident) => { |sheet| sheet.$name.and_then(|table| table.$key) };
    (@get optional $name:ident) => { |sheet| sheet.$name };
    (@get $kind:ident $name:ident) => { |sheet| Some(sheet.$name) };
    (@set optional $name:ident $key:ident) => {
        |sheet, value| write(&mut sheet.$name, |table| &mut table.$key, value)
    };
    (@set optional $name:ident) => { |sheet, value| sheet.$name = value };
    (@set $kind:ident $name:ident) => { |sheet, value| sheet.$name = value.unwrap_or(sheet.$name) };
    (@needed needed) => { true };
    (@needed $kind:ident) => { false };
}

motor_fields! {
    /// [`MotorParameters::drive_frequency`] (Hz).
    DriveFrequency, drive_frequency: needed, "Hz", Some(FREQUENCIES), &[
        reading("a frequency in kHz", 1.0e3, FREQUENCIES),
        reading("an angular frequency in rad/s", 1.0 / TAU, FREQUENCIES),
        reading("a frequency that was divided by 2 pi", TAU, FREQUENCIES),
    ], &["omega", "angular_frequency", "f"];
    /// [`MotorParameters::amplitude`] A (m); replaces force and volts of the stator.
    Amplitude, amplitude: optional, "m", Some(AMPLITUDES), &[
        reading("an amplitude in um", 1.0e-6, AMPLITUDES),
        reading("an amplitude in nm", 1.0e-9, AMPLITUDES),
        // Placed last because, if another reading fits as well, that one is likelier.
        reading("an amplitude in mm", 1.0e-3, AMPLITUDES),
    ], &["A", "axial_amplitude"];
    /// [`MotorParameters::peak_angular_speed`] omega Phi (rad/s); replaces a twist amplitude.
    PeakAngularSpeed, peak_angular_speed: optional, "rad/s", Some((0.1, 1.0e3)), &[
        reading("a speed in rpm", TAU / 60.0, (0.1, 1.0e3)),
    ], &["platform_speed", "stator_speed", "rotary_speed"];
    /// [`MotorParameters::twist_amplitude`] Phi (rad); replaces a peak angular speed.
    TwistAmplitude, twist_amplitude: optional, "rad", Some((1.0e-7, 1.0e-2)), &[], &["Phi"];
    /// [`MotorParameters::phase_lag`] theta (rad).
    PhaseLag, phase_lag: optional_with_default, "rad", Some(TURN), &[
        reading("an angle in degrees", PI / 180.0, TURN),
    ], &["theta"];
    /// [`MotorParameters::mass`] m (kg); replaces a density and its thickness.
    Mass, mass: optional, "kg", Some(MASSES), &[reading("a mass in g", 1.0e-3, MASSES)], &["m", "rotor_mass"];
    /// [`MotorParameters::density`] (kg/m^3); replaces a mass.
    Density, density: optional, "kg/m^3", Some((1.0e3, 2.0e4)), &[
        reading("a density in g/cm^3", 1.0e3, (1.0e3, 2.0e4)),
    ], &["rho"];
    /// [`MotorParameters::rotor_radius`] R (m).
    RotorRadius, rotor_radius: optional, "m", Some(LENGTHS), MILLIMETRES, &["R", "radius"];
    /// [`MotorParameters::rotor_thickness`] (m).
    RotorThickness, rotor_thickness: optional, "m", Some(LENGTHS), MILLIMETRES, &["height"];
    /// [`MotorParameters::contact_radius`] a_e (m).
    ContactRadius, contact_radius: needed, "m", Some(LENGTHS), MILLIMETRES, &["a_e"];
    /// [`MotorParameters::gyration_radius`] a_g (m).
    GyrationRadius, gyration_radius: optional, "m", Some(LENGTHS), MILLIMETRES, &["a_g"];
    /// [`MotorParameters::preload_force`] F (N); replaces a preload acceleration.
    PreloadForce, preload_force: optional, "N", Some(FORCES), &[
        // Nearly all of these values are usual in mN, too.
        reading("a force in mN, or an acceleration in m/s^2", 1.0, ACCELERATIONS),
        reading("a force in mN", 1.0e-3, FORCES),
    ], &["F", "N", "preload"];
    /// [`MotorParameters::preload_acceleration`] g (m/s^2); replaces a preload force.
    PreloadAcceleration, preload_acceleration: optional, "m/s^2", Some(ACCELERATIONS), &[
        reading("a force in N", 1.0, FORCES),
    ], &["g"];
    /// [`MotorParameters::spring_constant`] k (N/m). The motion does not depend on it.
    SpringConstant, spring_constant: optional, "N/m", Some((10.0, 1.0e7)), &[], &["k", "stiffness"];
    /// [`MotorParameters::friction`] mu.
    Friction, friction: needed, "1", Some((0.01, 1.0)), &[], &["mu"];
    /// [`MotorParameters::restitution`].
    Restitution, restitution: needed, "1", None, &[], &["epsilon", "e", "eps"];
    /// [`MotorParameters::load_torque`] T_L (N m).
    LoadTorque, load_torque: optional_with_default, "N m", None, &[], &["T_L", "load", "torque"];
    /// [`Contact::time`] of [`MotorParameters::contact`] (s); replaces materials, geometry and sizes. In a
    /// file the key is in the table `[contact]`.
    ContactTime, contact.time: optional, "s", None, &[], &["contact_duration"];
    /// [`StatorParameters::mass`] M of [`MotorParameters::stator`] (kg). In a file the key is in the table
    /// `[stator]`.
    StatorMass, stator.mass: optional, "kg", Some(MASSES), &[reading("a mass in g", 1.0e-3, MASSES)], &["M"];
    /// [`StatorParameters::quality`] Q.
    StatorQuality, stator.quality: optional, "1", None, &[], &["Q"];
    /// [`StatorParameters::resonance`] (Hz).
    StatorResonance, stator.resonance: optional, "Hz", Some(FREQUENCIES), &[
        reading("a frequency in kHz", 1.0e3, FREQUENCIES),
    ], &["f_r", "omega_1"];
    /// [`StatorParameters::twist_per_height`] kappa (rad/m).
    StatorTwistPerHeight, stator.twist_per_height: optional, "rad/m", None, &[], &["kappa"];
    /// [`StatorParameters::force`] (N); replaces amplitude and volts.
    StatorForce, stator.force: optional, "N", None, &[], &[];
    /// [`StatorParameters::volts`] (V); replaces amplitude and force.
    StatorVolts, stator.volts: optional, "V", None, &[], &["V", "voltage"];
}

impl MotorField {
    /// The row of the table of fields, which has the same order.
    pub(crate) const fn field(self) -> &'static Field {
        &FIELDS[self as usize]
    }

    /// The name of the field, for example `load_torque`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.field().name
    }

    /// The unit as text, for example `N m`; `1` for a dimensionless number.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        self.field().unit
    }

    /// The value in a data sheet; `None` if the sheet states an alternative or no value.
    #[must_use]
    pub fn value(self, sheet: &MotorParameters) -> Option<f64> {
        (self.field().get)(sheet)
    }

    /// The fields that this field excludes, and that are cleared when it is set.
    #[must_use]
    pub const fn excluded(self) -> &'static [Self] {
        match self {
            Self::Amplitude => &[Self::StatorForce, Self::StatorVolts],
            Self::StatorForce => &[Self::Amplitude, Self::StatorVolts],
            Self::StatorVolts => &[Self::Amplitude, Self::StatorForce],
            Self::PeakAngularSpeed => &[Self::TwistAmplitude],
            Self::TwistAmplitude => &[Self::PeakAngularSpeed],
            Self::Mass => &[Self::Density, Self::RotorThickness],
            Self::Density => &[Self::Mass],
            Self::PreloadForce => &[Self::PreloadAcceleration],
            Self::PreloadAcceleration => &[Self::PreloadForce],
            _ => &[],
        }
    }

    /// Whether the field is in a table of a file.
    #[must_use]
    pub fn in_table(self) -> bool {
        self.name().contains('.')
    }

    /// Writes a value into a data sheet and clears the fields that this field excludes ([`Self::excluded`]).
    /// [`MotorParameters::build`] checks the value.
    pub fn set(self, sheet: &mut MotorParameters, value: f64) {
        for field in self.excluded() {
            (field.field().set)(sheet, None);
        }
        (self.field().set)(sheet, Some(value));
    }
}

impl Display for MotorField {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that is not a field of a motor's data sheet. The name is printed with escapes as in Rust, so that
/// it cannot disturb a terminal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownMotorField(String);

impl UnknownMotorField {
    pub(crate) fn new(name: &str, nearest: Option<&str>) -> Self {
        Self(format!("the key {}", unknown(name, nearest, &MotorField::ALL.map(MotorField::name))))
    }
}

impl Display for UnknownMotorField {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for UnknownMotorField {}

impl FromStr for MotorField {
    type Err = UnknownMotorField;

    fn from_str(name: &str) -> Result<Self, UnknownMotorField> {
        let known = Self::ALL.into_iter().find(|field| field.name() == name);
        known.ok_or_else(|| UnknownMotorField::new(name, nearest_field(name)))
    }
}

impl TryFrom<String> for MotorField {
    type Error = UnknownMotorField;

    fn try_from(name: String) -> Result<Self, UnknownMotorField> {
        name.parse()
    }
}

impl From<MotorField> for &'static str {
    fn from(field: MotorField) -> Self {
        field.name()
    }
}

/// The known key most similar to this one: the key with this symbol or alternative name, otherwise the key
/// with the most similar spelling.
fn nearest_field(key: &str) -> Option<&'static str> {
    let named = FIELDS.iter().find(|field| field.also.contains(&key)).map(|field| field.name);
    named.or_else(|| nearest(key, &MotorField::ALL.map(MotorField::name)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Motor;

    #[test]
    fn the_fields_are_those_of_the_table() {
        for (index, field) in MotorField::ALL.into_iter().enumerate() {
            assert_eq!(field as usize, index);
            // `DriveFrequency` is `drive_frequency`.
            let plain = field.name().replace(['_', '.'], "");
            assert_eq!(format!("{field:?}").to_lowercase(), plain);
            assert_eq!(field.to_string().parse(), Ok(field));
            let mut sheet = Motor::paper_70_khz().parameters().clone();
            field.set(&mut sheet, 0.123);
            assert_eq!(field.value(&sheet), Some(0.123));
            for other in field.excluded() {
                assert_eq!(other.value(&sheet), None, "{field} {other}");
                // Fields exclude each other exactly if a sheet rejects them together.
                let mut sheet = Motor::paper_70_khz().parameters().clone();
                sheet.rotor_radius = Some(0.01);
                if [field, *other].contains(&MotorField::Density) {
                    sheet.mass = None;
                    sheet.rotor_thickness = Some(0.01);
                }
                field.set(&mut sheet, 0.01);
                (other.field().set)(&mut sheet, Some(0.01));
                assert!(matches!(sheet.build(), Err(crate::Error::BothGiven { .. })), "{field} {other}");
            }
        }
    }

    #[test]
    fn an_unknown_name_is_told_what_was_meant() {
        for field in FIELDS {
            for place in 0..field.name.len() {
                let mut less = field.name.to_owned();
                less.remove(place);
                assert_eq!(nearest_field(&less), Some(field.name), "{less}");
            }
        }
        for (key, expected) in [
            ("load_torqe", Some("load_torque")),
            ("load", Some("load_torque")),
            ("a_e", Some("contact_radius")),
            ("mu", Some("friction")),
            ("Friction", Some("friction")),
            ("A", Some("amplitude")),
            ("g", Some("preload_acceleration")),
            ("Drive-Frequency", Some("drive_frequency")),
            ("frequency", Some("drive_frequency")),
            ("friction_coefficient", Some("friction")),
            ("colour", None),
            ("x", None),
            ("", None),
            ("€€€", None),
        ] {
            assert_eq!(nearest_field(key), expected, "{key}");
        }
        assert_eq!(nearest_field(&"load_torque".repeat(10)), None);
        let error = "\u{1b}[2J".repeat(100).parse::<MotorField>().expect_err("unknown");
        let text = error.to_string();
        assert!(!text.contains('\u{1b}') && text.len() < 900 && text.contains("load_torque"), "{text}");
    }

    #[cfg(feature = "json")]
    #[test]
    fn stored_it_is_its_name() {
        let text = serde_json::to_string(&MotorField::ALL).expect("writes");
        assert!(text.starts_with("[\"drive_frequency\",\"amplitude\","), "{text}");
        assert_eq!(serde_json::from_str::<Vec<MotorField>>(&text).expect("reads"), MotorField::ALL);
        let error = serde_json::from_str::<MotorField>("\"frction\"").expect_err("unknown");
        assert!(error.to_string().contains("did you mean \"friction\"?"), "{error}");
    }
}
