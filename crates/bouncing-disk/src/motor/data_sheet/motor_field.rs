//! A field of a data sheet as a value: what a sweep varies.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use super::fields::{FIELDS, Field};
use super::nearest::{excerpt, nearest};
use super::parameters::MotorParameters;

/// A field of [`MotorParameters`], which is a number.
///
/// Printed, read and stored, it is the name of the field: `load_torque`.
///
/// ```
/// use bouncing_disk::MotorField;
///
/// let field: MotorField = "load_torque".parse()?;
/// assert_eq!((field, field.unit()), (MotorField::LoadTorque, "N m"));
/// let error = "load_torqe".parse::<MotorField>().expect_err("misspelt");
/// assert_eq!(
///     error.to_string(),
///     "a motor's data sheet has no field \"load_torqe\"; did you mean \"load_torque\"?"
/// );
/// # Ok::<(), bouncing_disk::UnknownMotorField>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "String", into = "&'static str"))]
pub enum MotorField {
    /// [`MotorParameters::drive_frequency`] (Hz).
    DriveFrequency,
    /// [`MotorParameters::amplitude`] A (m).
    Amplitude,
    /// [`MotorParameters::peak_angular_speed`] omega Phi (rad/s); takes the place of a twist amplitude.
    PeakAngularSpeed,
    /// [`MotorParameters::twist_amplitude`] Phi (rad); takes the place of a peak angular speed.
    TwistAmplitude,
    /// [`MotorParameters::phase_lag`] theta (rad).
    PhaseLag,
    /// [`MotorParameters::mass`] m (kg); takes the place of a density and the thickness that goes with it.
    Mass,
    /// [`MotorParameters::density`] (kg/m^3); takes the place of a mass.
    Density,
    /// [`MotorParameters::rotor_radius`] R (m).
    RotorRadius,
    /// [`MotorParameters::rotor_thickness`] (m).
    RotorThickness,
    /// [`MotorParameters::contact_radius`] a_e (m).
    ContactRadius,
    /// [`MotorParameters::gyration_radius`] a_g (m).
    GyrationRadius,
    /// [`MotorParameters::preload_force`] F (N); takes the place of a preload acceleration.
    PreloadForce,
    /// [`MotorParameters::preload_acceleration`] g (m/s^2); takes the place of a preload force.
    PreloadAcceleration,
    /// [`MotorParameters::spring_constant`] k (N/m). The motion does not depend on it.
    SpringConstant,
    /// [`MotorParameters::friction`] mu.
    Friction,
    /// [`MotorParameters::restitution`].
    Restitution,
    /// [`MotorParameters::load_torque`] T_L (N m).
    LoadTorque,
}

impl MotorField {
    /// All fields, in the order in which a data sheet is written.
    pub const ALL: [Self; 17] = [
        Self::DriveFrequency,
        Self::Amplitude,
        Self::PeakAngularSpeed,
        Self::TwistAmplitude,
        Self::PhaseLag,
        Self::Mass,
        Self::Density,
        Self::RotorRadius,
        Self::RotorThickness,
        Self::ContactRadius,
        Self::GyrationRadius,
        Self::PreloadForce,
        Self::PreloadAcceleration,
        Self::SpringConstant,
        Self::Friction,
        Self::Restitution,
        Self::LoadTorque,
    ];

    /// Its line of the table, which has the same order.
    const fn field(self) -> &'static Field {
        &FIELDS[self as usize]
    }

    /// The name of the field: `load_torque`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.field().name
    }

    /// Its unit as it is written: `N m`; `1` for a number without a unit.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        self.field().unit
    }

    /// Its value; `None` where an alternative, or nothing, is given.
    #[must_use]
    pub fn value(self, sheet: &MotorParameters) -> Option<f64> {
        (self.field().get)(sheet)
    }

    /// The fields that exclude this one: they are set to nothing when it is given a value.
    #[must_use]
    pub const fn excluded(self) -> &'static [Self] {
        match self {
            Self::PeakAngularSpeed => &[Self::TwistAmplitude],
            Self::TwistAmplitude => &[Self::PeakAngularSpeed],
            Self::Mass => &[Self::Density, Self::RotorThickness],
            Self::Density => &[Self::Mass],
            Self::PreloadForce => &[Self::PreloadAcceleration],
            Self::PreloadAcceleration => &[Self::PreloadForce],
            _ => &[],
        }
    }

    /// Gives it a value on a data sheet, and sets the fields that it excludes ([`Self::excluded`]) to nothing. Whether
    /// the value is legal is seen when the sheet is built.
    pub fn set(self, sheet: &mut MotorParameters, value: f64) {
        for field in self.excluded() {
            field.clear(sheet);
        }
        (self.field().set)(sheet, value);
    }

    /// Sets one of the fields that others exclude to nothing; these are optional.
    const fn clear(self, sheet: &mut MotorParameters) {
        match self {
            Self::PeakAngularSpeed => sheet.peak_angular_speed = None,
            Self::TwistAmplitude => sheet.twist_amplitude = None,
            Self::Mass => sheet.mass = None,
            Self::Density => sheet.density = None,
            Self::RotorThickness => sheet.rotor_thickness = None,
            Self::PreloadForce => sheet.preload_force = None,
            Self::PreloadAcceleration => sheet.preload_acceleration = None,
            _ => {}
        }
    }
}

impl Display for MotorField {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that no field of a motor's data sheet has. It is shown as it is escaped in Rust, so that it cannot disturb a
/// terminal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownMotorField {
    name: String,
    nearest: Option<&'static str>,
}

impl UnknownMotorField {
    /// The name, shortened if it is long.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The field that is most like it; `None` if none is.
    #[must_use]
    pub const fn nearest(&self) -> Option<&'static str> {
        self.nearest
    }
}

impl Display for UnknownMotorField {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "a motor's data sheet has no field {:?}; ", self.name)?;
        match self.nearest {
            Some(nearest) => write!(f, "did you mean \"{nearest}\"?"),
            None => {
                f.write_str("it has ")?;
                MotorField::ALL
                    .iter()
                    .enumerate()
                    .try_for_each(|(index, field)| write!(f, "{}{field}", if index > 0 { ", " } else { "" }))
            }
        }
    }
}

impl std::error::Error for UnknownMotorField {}

impl FromStr for MotorField {
    type Err = UnknownMotorField;

    fn from_str(name: &str) -> Result<Self, UnknownMotorField> {
        let known = Self::ALL.into_iter().find(|field| field.name() == name);
        known.ok_or_else(|| UnknownMotorField { name: excerpt(name), nearest: nearest(name) })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Motor;

    #[test]
    fn the_fields_are_those_of_the_table() {
        assert_eq!(MotorField::ALL.len(), FIELDS.len());
        for (index, (field, line)) in MotorField::ALL.into_iter().zip(&FIELDS).enumerate() {
            assert_eq!((field as usize, field.name(), field.unit()), (index, line.name, line.unit));
            // `DriveFrequency` is `drive_frequency`.
            let plain = line.name.replace('_', "");
            assert_eq!(format!("{field:?}").to_lowercase(), plain);
            assert_eq!(field.to_string().parse(), Ok(field));
            let mut sheet = Motor::paper_70_khz().parameters();
            field.set(&mut sheet, 0.123);
            assert_eq!(field.value(&sheet), Some(0.123));
            for other in field.excluded() {
                assert_eq!(other.value(&sheet), None, "{field} {other}");
            }
        }
    }

    #[test]
    fn what_is_excluded_is_what_a_sheet_refuses_together() {
        // A sheet without alternatives, and the same with one of each pair.
        let full = || {
            let mut sheet = Motor::paper_70_khz().parameters();
            sheet.rotor_radius = Some(0.01);
            sheet
        };
        for field in MotorField::ALL {
            for other in MotorField::ALL {
                let mut sheet = full();
                if field == MotorField::Density || other == MotorField::Density {
                    sheet.mass = None;
                    sheet.rotor_thickness = Some(0.01);
                }
                // What a field sets to nothing can be given after it only by setting that to nothing again.
                field.set(&mut sheet, 0.01);
                (other.field().set)(&mut sheet, 0.01);
                let refused = matches!(sheet.build(), Err(crate::Error::BothGiven { .. }));
                let excludes = field.excluded().contains(&other);
                if excludes {
                    assert!(refused, "{field} {other}");
                }
            }
        }
    }

    #[test]
    fn an_unknown_name_is_told_what_was_meant() {
        for (name, nearest) in
            [("mu", Some("friction")), ("Friction", Some("friction")), ("", None), ("colour", None)]
        {
            let error = name.parse::<MotorField>().expect_err("unknown");
            assert_eq!((error.name(), error.nearest()), (name, nearest));
        }
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
