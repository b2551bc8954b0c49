//! Data sheets as TOML: one table, whose keys are the fields.

use std::fmt::Write as _;

use toml::de::{DeTable, DeValue};

use super::{Lines, MotorFileError, Value, excerpt, given, motor_of, without_mark};
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::MotorField;

impl Motor {
    /// Reads a data sheet: a table with the fields of [`MotorParameters`](crate::MotorParameters), in SI
    /// units. A byte-order mark before the text is accepted.
    ///
    /// # Errors
    /// As `Motor::from_json`. A key that is there twice is an error of the format,
    /// [`MotorFileError::Syntax`].
    pub fn from_toml(text: &str) -> Result<Self, MotorFileError> {
        Self::from_toml_with(text, &[])
    }

    /// [`Self::from_toml`] of a data sheet with other values in place of some of its own, which are neither
    /// checked nor needed then. A value excludes what its field excludes ([`MotorField::set`]).
    ///
    /// ```
    /// use bouncing_disk::{Motor, MotorField};
    ///
    /// let text = Motor::paper_70_khz().to_toml().replace("friction = 0.1", "friction = -0.1");
    /// assert!(Motor::from_toml(&text).is_err());
    /// let motor = Motor::from_toml_with(&text, &[(MotorField::Friction, 0.2)])?;
    /// assert_eq!(motor.parameters().friction, 0.2);
    /// # Ok::<(), bouncing_disk::MotorFileError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Self::from_toml`], without the line where an error is about a value that was not read.
    pub fn from_toml_with(text: &str, changes: &[(MotorField, f64)]) -> Result<Self, MotorFileError> {
        let text = without_mark(text);
        let table = DeTable::parse(text).map_err(|error| refusal(text, &error))?;
        // In the order of the text, so that the first fault is told.
        let mut entries: Vec<_> = table.get_ref().iter().collect();
        entries.sort_unstable_by_key(|(key, _)| key.span().start);
        let mut lines = Lines::new(text);
        let entries = entries.into_iter().map(|(key, value)| {
            (key.get_ref().clone().into_owned(), lines.at(key.span().start), number(value.get_ref()))
        });
        motor_of(entries, changes)
    }

    /// The data sheet as [`Self::from_toml`] reads it, to the last bit, with the units as comments.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        for (name, value, unit) in given(&self.parameters()) {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{name} = {value:?} # {unit}");
        }
        text
    }
}

fn refusal(text: &str, error: &toml::de::Error) -> MotorFileError {
    let place = error.span().map_or(0, |span| span.start);
    let (before, after) = text.split_at_checked(place).unwrap_or((text, ""));
    let begun = before.rsplit('\n').next().unwrap_or_default();
    let rest = after.lines().next().unwrap_or_default();
    MotorFileError::Syntax {
        format: "TOML",
        line: Lines::new(text).at(place),
        column: begun.chars().count() + 1,
        // The line holds the key, which the reader does not always name.
        reason: format!("{} in: {}", error.message(), excerpt(&format!("{begun}{rest}"))),
    }
}

/// What a value is. Numbers may be written as integers, with any radix, and with underscores.
fn number(value: &DeValue<'_>) -> Value {
    match value {
        DeValue::Integer(integer) => {
            let (digits, radix) = (integer.as_str(), integer.radix());
            let read = if radix == 10 {
                digits.parse().ok()
            } else {
                u64::from_str_radix(digits, radix).ok().map(|whole| whole as f64)
            };
            read.map_or(Value::Other("an integer that is too large"), Value::Number)
        }
        DeValue::Float(float) => float.as_str().parse().map_or(Value::Other("no number"), Value::Number),
        DeValue::String(_) => Value::Other("a text"),
        DeValue::Boolean(_) => Value::Other("true or false"),
        DeValue::Datetime(_) => Value::Other("a date or a time"),
        DeValue::Array(_) => Value::Other("a list"),
        DeValue::Table(_) => Value::Other("a table"),
    }
}
