//! Data sheets as JSON: one object, whose keys are the fields.

use std::fmt;

use serde::de::{Deserializer as _, MapAccess, Visitor};
use serde_json::value::RawValue;

use super::{Lines, MotorFileError, Value, excerpt, given, motor_of, without_mark};
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::MotorField;

impl Motor {
    /// Reads a data sheet: an object with the fields of [`MotorParameters`](crate::MotorParameters), in SI
    /// units. `null` is the same as a field that is not there, a byte-order mark before the text is accepted.
    ///
    /// ```
    /// use bouncing_disk::Motor;
    ///
    /// let text = Motor::paper_70_khz().to_json().replace("load_torque", "load_torqe");
    /// let error = Motor::from_json(&text).expect_err("misspelt");
    /// assert_eq!(error.to_string(), "line 12: the key \"load_torqe\" is unknown; did you mean \"load_torque\"?");
    /// ```
    ///
    /// # Errors
    /// [`MotorFileError`] for a text that is no such object, keys that are unknown or there twice, values
    /// that are no numbers, and what [`MotorParameters::build`](crate::MotorParameters::build) refuses; with
    /// the line.
    pub fn from_json(text: &str) -> Result<Self, MotorFileError> {
        Self::from_json_with(text, &[])
    }

    /// [`Self::from_json`] of a data sheet with other values in place of some of its own, which are neither
    /// checked nor needed then. A value excludes what its field excludes ([`MotorField::set`]).
    ///
    /// # Errors
    /// As [`Self::from_json`], without the line where an error is about a value that was not read.
    pub fn from_json_with(text: &str, changes: &[(MotorField, f64)]) -> Result<Self, MotorFileError> {
        let text = without_mark(text);
        let mut reader = serde_json::Deserializer::from_str(text);
        let entries = reader
            .deserialize_map(Entries)
            .and_then(|entries| reader.end().map(|()| entries))
            .map_err(|error| refusal(&error))?;
        let mut lines = Lines::new(text);
        let entries = entries.into_iter().map(|(key, raw)| {
            // A raw value is a part of the text: its place is the distance of the two.
            let place = raw.get().as_ptr() as usize - text.as_ptr() as usize;
            (key, lines.at(place), value(raw.get()))
        });
        motor_of(entries, changes)
    }

    /// The data sheet as [`Self::from_json`] reads it, one field a line, to the last bit. The units are those
    /// of [`MotorParameters`](crate::MotorParameters); JSON has no place for them.
    #[must_use]
    pub fn to_json(&self) -> String {
        let lines: Vec<_> =
            given(&self.parameters()).map(|(name, value, _)| format!("  \"{name}\": {value:?}")).collect();
        format!("{{\n{}\n}}\n", lines.join(",\n"))
    }
}

fn refusal(error: &serde_json::Error) -> MotorFileError {
    let whole = error.to_string();
    // The reader appends the place, which has fields of its own here.
    let place = format!(" at line {} column {}", error.line(), error.column());
    MotorFileError::Syntax {
        format: "JSON",
        // Before the first letter the reader counts from 0.
        line: error.line().max(1),
        column: error.column().max(1),
        reason: excerpt(whole.strip_suffix(&place).unwrap_or(&whole)),
    }
}

/// What the text of a value is; it is legal JSON.
fn value(text: &str) -> Value {
    match text.as_bytes().first() {
        Some(b'"') => Value::Other("a text"),
        Some(b'{') => Value::Other("an object"),
        Some(b'[') => Value::Other("a list"),
        Some(b't' | b'f') => Value::Other("true or false"),
        Some(b'n') => Value::Nothing,
        // Every number of JSON is one of Rust. One that no double holds becomes infinite, which no range
        // contains.
        _ => text.parse().map_or(Value::Other("no number"), Value::Number),
    }
}

/// All keys and values of an object, also those that are there twice.
struct Entries;

impl<'de> Visitor<'de> for Entries {
    type Value = Vec<(String, &'de RawValue)>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object with the fields of a motor")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut entries = Vec::new();
        while let Some(entry) = map.next_entry()? {
            entries.push(entry);
        }
        Ok(entries)
    }
}
