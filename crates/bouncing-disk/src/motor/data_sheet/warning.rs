//! Values of a data sheet that are legal but unlikely to be intended.

use std::fmt::{self, Display, Formatter};

use crate::display::{number, rough};
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::{Field, MotorField};
use crate::parameters::contact::estimate::{ContactStatement, ContactWarning};

/// A value is far outside the usual range if it differs from it by this factor.
const FAR: f64 = 1.0e3;

/// A bound on the change of the preload above this value causes a warning.
const LARGEST_CHANGE: f64 = 0.01;

/// A value that is legal but unlikely to be intended, or violates an assumption of the model
/// ([`Motor::warnings`]).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum MotorWarning {
    /// A value is outside the usual range of such motors, but inside it if read in another unit.
    OtherUnit {
        /// The field.
        field: &'static str,
        /// Its value.
        value: f64,
        /// The unit of the field.
        unit: &'static str,
        /// The least and the largest usual value for such motors.
        usual: (f64, f64),
        /// The reading that may have been intended: "a length in mm".
        meant: &'static str,
    },
    /// A value is a factor 1000 or more outside the usual range of such motors.
    FarOutside {
        /// The field.
        field: &'static str,
        /// Its value.
        value: f64,
        /// The unit of the field.
        unit: &'static str,
        /// The least and the largest usual value for such motors.
        usual: (f64, f64),
    },
    /// The contact radius or the radius of gyration is larger than the rotor.
    OutsideRotor {
        /// The field.
        field: &'static str,
        /// Its value (m).
        value: f64,
        /// The radius of the rotor (m).
        rotor_radius: f64,
    },
    /// The load exceeds the largest torque of the motor, so the load drives the rotor.
    Overload {
        /// The load torque (N m).
        load_torque: f64,
        /// mu m g a_e (N m).
        largest_torque: f64,
    },
    /// The spring's force may change by more than 1 % while the rotor flies; the engine keeps the force
    /// constant.
    PreloadChanges {
        /// The bound on the relative change ([`Motor::preload_change_bound`]).
        bound: f64,
    },
    /// A measured speed or rise time differs by a factor 100 from the drive's prediction
    /// ([`Motor::warnings_on`]).
    OtherScale {
        /// The fastest measured speed, or the time to reach half of this speed.
        measured: f64,
        /// The stator's largest speed omega Phi, or the shortest time in which friction can accelerate a
        /// rotor to this speed.
        drive: f64,
        /// The unit of both values: rad/s or s.
        unit: &'static str,
    },
    /// A warning about the duration of impacts; [`Motor::report`], which uses the impact speed, may add more
    /// such warnings.
    Contact(ContactWarning),
    /// Impacts on a compliant stator are rigid, although they last longer than a period or their duration is
    /// unknown.
    RigidOnModes {
        /// The contact time over the period, if it is known.
        periods: Option<f64>,
    },
    /// The stator does not lift a rotor that lies on it.
    NotLifted {
        /// The preload (N).
        preload_force: f64,
        /// The preload (N) below which the stator lifts the rotor
        /// ([`crate::parameters::StatorModes::lift_off_preload`]).
        lift_off_preload: f64,
    },
    /// The contacts of the motor are compliant, but a report computes the regime for rigid impacts.
    RigidRegime,
}

impl Display for MotorWarning {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let n = number;
        match *self {
            Self::OtherUnit { field, value, unit, usual: (low, high), meant } => write!(
                f,
                "{field} = {} {unit} is outside the usual range of such motors, {} to {} {unit}: is it {meant}?",
                n(value),
                n(low),
                n(high)
            ),
            Self::FarOutside { field, value, unit, usual: (low, high) } => write!(
                f,
                "{field} = {} {unit} is more than a factor of 1000 outside the usual range of such motors, {} to \
                 {} {unit}",
                n(value),
                n(low),
                n(high)
            ),
            Self::OutsideRotor { field, value, rotor_radius } => {
                write!(f, "{field} = {} m is larger than rotor_radius = {} m", n(value), n(rotor_radius))
            }
            Self::Overload { load_torque, largest_torque } => write!(
                f,
                "the load torque at rest, {} N m, is more than the largest torque of the motor, mu m g a_e = {} N m",
                n(load_torque),
                n(largest_torque)
            ),
            Self::PreloadChanges { bound } => write!(
                f,
                "the preload may change by {} % in a flight (a bound); the model keeps it constant",
                rough(100.0 * bound)
            ),
            Self::Contact(warning) => warning.fmt(f),
            Self::RigidOnModes { periods } => {
                let long = periods.map_or_else(
                    || "their duration is unknown".to_owned(),
                    |periods| format!("they may last {} periods", rough(periods)),
                );
                write!(
                    f,
                    "impacts on the stator's modes are rigid, and {long}: the model fails if they last longer than \
                     a period; give contact.time"
                )
            }
            Self::NotLifted { preload_force, lift_off_preload } => write!(
                f,
                "the stator does not lift a rotor at rest: the preload is {} N, but must be below {} N",
                n(preload_force),
                n(lift_off_preload)
            ),
            Self::RigidRegime => f.write_str(
                "regime, flights and impact speed are computed with rigid impacts; transients and curves use \
                 contact.time",
            ),
            Self::OtherScale { measured, drive, unit } => {
                let quantity = if unit == "s" { "rise time" } else { "speed" };
                write!(
                    f,
                    "a measured {quantity} of {} {unit} differs by a factor of 100 from the value of the drive, {} \
                     {unit}: is it in another unit?",
                    n(measured),
                    n(drive)
                )
            }
        }
    }
}

impl Motor {
    /// Warnings for legal values of the data sheet that are unlikely to be intended, in the order of the
    /// fields, followed by combinations of fields. Zeros are assumed to be intended.
    ///
    /// A mistake cannot be detected if the number is also usual in the wrong unit, as when a frequency of
    /// 40e3 Hz is given but an angular frequency of 40e3 rad/s was intended.
    #[must_use]
    pub fn warnings(&self) -> Vec<MotorWarning> {
        let sheet = self.parameters();
        let mut warnings: Vec<_> = MotorField::ALL
            .into_iter()
            .filter_map(|field| of_field(field.field(), field.value(sheet)?))
            .collect();
        if let Some(rotor_radius) = sheet.rotor_radius {
            let disk = self.system().disk();
            let lengths =
                [("contact_radius", disk.contact_radius()), ("gyration_radius", disk.gyration_radius())];
            warnings.extend(
                lengths
                    .into_iter()
                    .filter(|(_, value)| *value > rotor_radius)
                    .map(|(field, value)| MotorWarning::OutsideRotor { field, value, rotor_radius }),
            );
        }
        let at_rest = self.load().map(|load| load.torque_at(0.0, 0.0));
        let (load_torque, largest_torque) = (at_rest.unwrap_or(self.load_torque()), self.largest_torque());
        if load_torque.abs() > largest_torque {
            warnings.push(MotorWarning::Overload { load_torque, largest_torque });
        }
        let changes = self.preload_change_bound().filter(|bound| *bound > LARGEST_CHANGE);
        warnings.extend(changes.map(|bound| MotorWarning::PreloadChanges { bound }));
        let contact = self.system().contact_statement(None);
        warnings.extend(contact.iter().flat_map(ContactStatement::warnings).map(MotorWarning::Contact));
        if let Some(stator) = self.stator().filter(|_| self.system().soft_contact().is_none()) {
            let periods = contact.and_then(|contact| contact.time_over_period).map(|range| range[1]);
            if periods.is_none_or(|periods| periods > 1.0) {
                warnings.push(MotorWarning::RigidOnModes { periods });
            }
            let (preload_force, most) = (self.preload_force(), stator.lift_off_preload(self.mass()));
            warnings.extend(
                most.filter(|most| preload_force >= *most)
                    .map(|lift_off_preload| MotorWarning::NotLifted { preload_force, lift_off_preload }),
            );
        }
        warnings
    }
}

fn of_field(field: &Field, value: f64) -> Option<MotorWarning> {
    let usual = field.usual?;
    let size = value.abs();
    let inside = |size: f64, (low, high): (f64, f64)| (low..=high).contains(&size);
    if size == 0.0 || inside(size, usual) {
        return None;
    }
    let Field { name, unit, .. } = *field;
    let meant = field.readings.iter().find(|reading| inside(size * reading.factor, reading.usual));
    meant.map_or_else(
        || {
            let far = size * FAR < usual.0 || size > usual.1 * FAR;
            far.then_some(MotorWarning::FarOutside { field: name, value, unit, usual })
        },
        |reading| Some(MotorWarning::OtherUnit { field: name, value, unit, usual, meant: reading.meant }),
    )
}
