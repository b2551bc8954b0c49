//! Data sheets as text: what JSON and TOML have in common, and the errors that name key and line.
//!
//! A format gives the keys with their values and lines (`file/json.rs`, `file/toml.rs`); what they mean is
//! decided here, once for both.

#[cfg(feature = "json")]
mod json;
#[cfg(feature = "toml")]
mod toml;

use std::fmt::{self, Display, Formatter};

use crate::error::Error;
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::fields::FIELDS;
use crate::motor::data_sheet::motor_field::MotorField;
use crate::motor::data_sheet::nearest::{excerpt, nearest};
use crate::motor::data_sheet::parameters::MotorParameters;

/// What can go wrong with the text of a data sheet. Every variant says where; keys are shown as they are
/// escaped in Rust, so that none can disturb a terminal.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum MotorFileError {
    /// The text is not of its format.
    Syntax {
        /// The name of the format.
        format: &'static str,
        /// The line, from 1.
        line: usize,
        /// The column, from 1.
        column: usize,
        /// What the reader of the format reports.
        reason: String,
    },
    /// A key that a data sheet does not have.
    UnknownKey {
        /// The key, shortened if it is long.
        key: String,
        /// Its line, from 1.
        line: usize,
        /// The known key that is most like it; `None` if none is.
        nearest: Option<&'static str>,
    },
    /// A key that is there twice.
    Repeated {
        /// The key.
        key: &'static str,
        /// The line of the second one, from 1.
        line: usize,
        /// The line of the first one.
        first_line: usize,
    },
    /// A value that is no number.
    NotANumber {
        /// The key.
        key: &'static str,
        /// Its line, from 1.
        line: usize,
        /// What is there: "a text".
        found: &'static str,
    },
    /// The data sheet can be read, and is not legal.
    Illegal {
        /// The line of the key that the error names, from 1; `None` where it is not in the text.
        line: Option<usize>,
        /// Why.
        error: Error,
    },
}

impl Display for MotorFileError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Syntax { format, line, column, reason } => {
                write!(f, "line {line}, column {column}: no {format}: {}", reason.escape_debug())
            }
            Self::UnknownKey { key, line, nearest: Some(nearest) } => {
                write!(f, "line {line}: the key {key:?} is unknown; did you mean \"{nearest}\"?")
            }
            Self::UnknownKey { key, line, nearest: None } => {
                write!(f, "line {line}: the key {key:?} is unknown; the known ones are ")?;
                FIELDS.iter().enumerate().try_for_each(|(index, field)| {
                    write!(f, "{}{}", if index > 0 { ", " } else { "" }, field.name)
                })
            }
            Self::Repeated { key, line, first_line } => {
                write!(f, "line {line}: the key \"{key}\" is there already, in line {first_line}")
            }
            Self::NotANumber { key, line, found } => {
                write!(f, "line {line}: \"{key}\" must be a number, and is {found}")
            }
            Self::Illegal { line: Some(line), error } => write!(f, "line {line}: {error}"),
            Self::Illegal { line: None, error } => error.fmt(f),
        }
    }
}

impl std::error::Error for MotorFileError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Illegal { error, .. } => Some(error),
            _ => None,
        }
    }
}

/// A value of a file.
#[derive(Debug, Clone, Copy)]
enum Value {
    Number(f64),
    /// Where a format has a word for it.
    #[cfg_attr(not(feature = "json"), allow(dead_code, reason = "TOML has no null"))]
    Nothing,
    /// "a text"
    Other(&'static str),
}

/// The motor of these keys and values, each with its line, in the order of the file, and of the `changes`,
/// which take the place of what the file says before anything is checked.
fn motor_of(
    entries: impl Iterator<Item = (String, usize, Value)>,
    changes: &[(MotorField, f64)],
) -> Result<Motor, MotorFileError> {
    let mut lines = [None; FIELDS.len()];
    let mut given = [false; FIELDS.len()];
    let mut sheet = EMPTY;
    for (key, line, value) in entries {
        let Some(index) = FIELDS.iter().position(|field| field.name == key) else {
            return Err(MotorFileError::UnknownKey { nearest: nearest(&key), key: excerpt(&key), line });
        };
        let field = &FIELDS[index];
        if let Some(first_line) = lines[index].replace(line) {
            return Err(MotorFileError::Repeated { key: field.name, line, first_line });
        }
        match value {
            Value::Number(number) => {
                (field.set)(&mut sheet, number);
                given[index] = true;
            }
            Value::Nothing => {}
            Value::Other(found) => return Err(MotorFileError::NotANumber { key: field.name, line, found }),
        }
    }
    for (field, value) in changes {
        field.set(&mut sheet, *value);
        // What is illegal of it is not in the file.
        lines[*field as usize] = None;
        given[*field as usize] = true;
    }
    let illegal = |error| {
        let line =
            named(&error).and_then(|name| lines[FIELDS.iter().position(|field| field.name == name)?]);
        MotorFileError::Illegal { line, error }
    };
    for (field, given) in FIELDS.iter().zip(given) {
        if field.needed && !given {
            return Err(illegal(Error::NotGiven { field: field.name }));
        }
    }
    sheet.build().map_err(illegal)
}

/// A sheet on which nothing is written yet. What is needed and not given is found before anybody sees a NaN.
const EMPTY: MotorParameters = MotorParameters {
    drive_frequency: f64::NAN,
    amplitude: f64::NAN,
    peak_angular_speed: None,
    twist_amplitude: None,
    phase_lag: 0.0,
    mass: None,
    density: None,
    rotor_radius: None,
    rotor_thickness: None,
    contact_radius: f64::NAN,
    gyration_radius: None,
    preload_force: None,
    preload_acceleration: None,
    spring_constant: None,
    friction: f64::NAN,
    restitution: f64::NAN,
    load_torque: 0.0,
};

/// The field that an error is about, where it is one; of two the second, of several the one that is most
/// likely wrong.
fn named(error: &Error) -> Option<&'static str> {
    match *error {
        Error::OutOfRange { field: "load" | "load_acceleration" | "torque", .. } => Some("load_torque"),
        Error::OutOfRange { field, .. } => Some(field),
        Error::BothGiven { other, .. } => Some(other),
        // P = A omega^2/g.
        Error::Core(bouncing_disk_core::Error::OutOfRange { field: "peak_acceleration", .. }) => {
            Some("amplitude")
        }
        _ => None,
    }
}

/// The text without a byte-order mark, which some editors put before it.
fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

/// Finds the lines of places that do not go back, each part of the text read once.
#[derive(Debug)]
struct Lines<'a> {
    text: &'a str,
    place: usize,
    line: usize,
}

impl<'a> Lines<'a> {
    const fn new(text: &'a str) -> Self {
        Self { text, place: 0, line: 1 }
    }

    /// The line of the byte at `place`, from 1.
    fn at(&mut self, place: usize) -> usize {
        let between = self.text.as_bytes().get(self.place..place).unwrap_or_default();
        self.line += between.iter().filter(|byte| **byte == b'\n').count();
        self.place = self.place.max(place);
        self.line
    }
}

/// What is given in a data sheet, with its units, in the order of the fields.
fn given(sheet: &MotorParameters) -> impl Iterator<Item = (&'static str, f64, &'static str)> {
    FIELDS.iter().filter_map(|field| Some((field.name, (field.get)(sheet)?, field.unit)))
}

#[cfg(test)]
mod tests;
