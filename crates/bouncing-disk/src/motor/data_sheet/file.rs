//! Data sheets as text: a JSON object or a TOML table whose keys are the fields.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::{Deserialize, Deserializer, Error as _, MapAccess, Visitor};
use serde_json::Value;

use crate::error::Error;
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::{MotorField, UnknownMotorField};
use crate::motor::data_sheet::parameters::MotorParameters;
use crate::parameters::contact::Contact;
use crate::parameters::driven_platform::DriveParameters;
use crate::parameters::load::LoadLaw;
use crate::parameters::stator::StatorParameters;
use crate::sheet_text::{self, SheetTextError, distance};

/// Why the text of a data sheet does not define a motor.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotorFileError {
    /// The text is not valid JSON or TOML, or it contains an unknown or repeated key, or a value that is not
    /// a number.
    #[error("line {line}: {reason}")]
    Text {
        /// The line, from 1.
        line: usize,
        /// The column, from 1.
        column: usize,
        /// The parser's message, without control characters that could disturb a terminal.
        reason: String,
    },
    /// The data sheet can be read, but its values are not legal.
    #[error(transparent)]
    Illegal(#[from] Error),
}

impl From<SheetTextError> for MotorFileError {
    fn from(SheetTextError { line, column, reason }: SheetTextError) -> Self {
        Self::Text { line, column, reason }
    }
}

impl Motor {
    /// Reads a data sheet: a JSON object with the fields of
    /// [`MotorParameters`](crate::motor::MotorParameters), in SI units. `null` means the same as a missing
    /// field; a byte-order mark before the text is accepted.
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
    /// [`MotorFileError`] for a text that is not such an object, for unknown or repeated keys, for values
    /// that are not numbers, and for anything that
    /// [`MotorParameters::build`](crate::motor::MotorParameters::build) rejects.
    #[cfg(feature = "json")]
    pub fn from_json(text: &str) -> Result<Self, MotorFileError> {
        Self::from_json_with(text, &[])
    }

    /// [`Self::from_json`] with some values of the data sheet replaced; the replaced values are neither
    /// checked nor needed. A new value removes the alternatives that its field excludes
    /// ([`MotorField::set`]).
    ///
    /// # Errors
    /// The errors of [`Self::from_json`].
    #[cfg(feature = "json")]
    pub fn from_json_with(text: &str, changes: &[(MotorField, f64)]) -> Result<Self, MotorFileError> {
        Ok(motor_of(sheet_text::from_json(text)?, changes)?)
    }

    /// The data sheet in the form that [`Self::from_json`] reads, one field per line and exact to the last
    /// bit. For the units see [`MotorParameters`](crate::motor::MotorParameters), because JSON cannot state
    /// them.
    #[cfg(feature = "json")]
    #[must_use]
    pub fn to_json(&self) -> String {
        let sheet = self.parameters();
        let mut lines: Vec<_> =
            given(sheet).map(|(field, value)| format!("  \"{field}\": {value:?}")).collect();
        for (table, entries) in tables(sheet) {
            let entries: Vec<_> = entries.iter().map(|(key, value)| format!("\"{key}\": {value}")).collect();
            lines.push(format!("  \"{table}\": {{{}}}", entries.join(", ")));
        }
        format!("{{\n{}\n}}\n", lines.join(",\n"))
    }

    /// Reads a data sheet: a TOML table with the fields of
    /// [`MotorParameters`](crate::motor::MotorParameters), in SI units. A byte-order mark before the text is
    /// accepted.
    ///
    /// # Errors
    /// The errors of `Motor::from_json`.
    #[cfg(feature = "toml")]
    pub fn from_toml(text: &str) -> Result<Self, MotorFileError> {
        Self::from_toml_with(text, &[])
    }

    /// [`Self::from_toml`] with some values of the data sheet replaced; the replaced values are neither
    /// checked nor needed. A new value removes the alternatives that its field excludes
    /// ([`MotorField::set`]).
    ///
    /// ```
    /// use bouncing_disk::Motor;
    /// use bouncing_disk::motor::MotorField;
    ///
    /// let text = Motor::paper_70_khz().to_toml().replace("friction = 0.1", "friction = -0.1");
    /// assert!(Motor::from_toml(&text).is_err());
    /// let motor = Motor::from_toml_with(&text, &[(MotorField::Friction, 0.2)])?;
    /// assert_eq!(motor.parameters().friction, 0.2);
    /// # Ok::<(), bouncing_disk::motor::MotorFileError>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`Self::from_toml`].
    #[cfg(feature = "toml")]
    pub fn from_toml_with(text: &str, changes: &[(MotorField, f64)]) -> Result<Self, MotorFileError> {
        Ok(motor_of(sheet_text::from_toml(text)?, changes)?)
    }

    /// The data sheet in the form that [`Self::from_toml`] reads, exact to the last bit, with the units as
    /// comments.
    #[cfg(feature = "toml")]
    #[must_use]
    pub fn to_toml(&self) -> String {
        let sheet = self.parameters();
        let lines = given(sheet).map(|(field, value)| format!("{field} = {value:?} # {}\n", field.unit()));
        let tables = tables(sheet).map(|(table, entries)| {
            let entries = entries.iter().map(|(key, value)| format!("{key} = {}\n", inline(value)));
            format!("[{table}]\n{}", entries.collect::<String>())
        });
        lines.chain(tables).collect()
    }
}

/// The tables of a data sheet.
const TABLES: [&str; 4] = ["drive", "contact", "stator", "load"];

/// The fields and tables that a text contains, with their values; `None` for `null`.
#[derive(Default)]
struct Given {
    fields: BTreeMap<MotorField, Option<f64>>,
    drive: Option<DriveParameters>,
    contact: Option<Contact>,
    stator: Option<StatorParameters>,
    load: Option<LoadLaw>,
}

/// A key of a data sheet.
#[derive(Clone, Copy, serde::Deserialize)]
#[serde(try_from = "String")]
enum Key {
    Field(MotorField),
    /// A table, by its index in [`TABLES`].
    Table(usize),
}

impl TryFrom<String> for Key {
    type Error = UnknownMotorField;

    fn try_from(name: String) -> Result<Self, UnknownMotorField> {
        let near = |table: &str| distance(&name.to_ascii_lowercase(), table) < 2;
        let of_table = |table: &str| name.strip_prefix(table).is_some_and(|rest| rest.starts_with('.'));
        match TABLES.iter().position(|table| near(table) || of_table(table)) {
            Some(index) if name == TABLES[index] => Ok(Self::Table(index)),
            Some(index) => Err(UnknownMotorField::new(&name, Some(TABLES[index]))),
            None => name.parse().map(Self::Field),
        }
    }
}

impl<'de> Deserialize<'de> for Given {
    fn deserialize<D: Deserializer<'de>>(reader: D) -> Result<Self, D::Error> {
        reader.deserialize_map(Entries)
    }
}

/// Reads an object, and rejects a repeated key.
struct Entries;

impl<'de> Visitor<'de> for Entries {
    type Value = Given;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object with the fields of a motor")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Given, A::Error> {
        let mut given = Given::default();
        while let Some(key) = map.next_key::<Key>()? {
            let (name, twice) = match key {
                Key::Field(field) => (field.name(), given.fields.insert(field, map.next_value()?).is_some()),
                Key::Table(0) => ("drive", given.drive.replace(map.next_value()?).is_some()),
                Key::Table(1) => ("contact", given.contact.replace(map.next_value()?).is_some()),
                Key::Table(3) => ("load", given.load.replace(map.next_value()?).is_some()),
                Key::Table(_) => ("stator", given.stator.replace(map.next_value()?).is_some()),
            };
            if twice {
                return Err(A::Error::custom(format_args!("the key \"{name}\" occurs twice")));
            }
        }
        Ok(given)
    }
}

/// The motor described by a text and the `changes`, which replace values of the text before any check.
fn motor_of(
    Given { mut fields, drive, contact, stator, load }: Given,
    changes: &[(MotorField, f64)],
) -> Result<Motor, Error> {
    let drive = drive.unwrap_or_default();
    let mut sheet = MotorParameters { contact, stator, load, drive, ..MotorParameters::EMPTY };
    for (field, value) in &fields {
        (field.field().set)(&mut sheet, *value);
    }
    for (field, value) in changes {
        field.set(&mut sheet, *value);
        fields.insert(*field, Some(*value));
    }
    for field in MotorField::ALL {
        if field.field().needed && fields.get(&field).copied().flatten().is_none() {
            return Err(Error::NotGiven { field: field.name() });
        }
    }
    sheet.build()
}

/// The fields of a data sheet outside its tables, in their order.
fn given(sheet: &MotorParameters) -> impl Iterator<Item = (MotorField, f64)> {
    let fields = MotorField::ALL.into_iter().filter(|field| !field.in_table());
    fields.filter_map(|field| Some((field, field.value(sheet)?)))
}

/// A value as TOML on one line: like JSON, except for the keys of tables.
#[cfg(feature = "toml")]
fn inline(value: &Value) -> String {
    let Value::Object(keys) = value else { return value.to_string() };
    let keys: Vec<_> = keys.iter().map(|(key, value)| format!("{key} = {}", inline(value))).collect();
    format!("{{ {} }}", keys.join(", "))
}

/// The tables of the sheet, with keys and values as in a file.
fn tables(sheet: &MotorParameters) -> impl Iterator<Item = (&'static str, Vec<(String, Value)>)> {
    // `Debug` writes `Some(1.0)` and names of variants; serde writes text that can be read back.
    fn entries(table: &impl serde::Serialize) -> Vec<(String, Value)> {
        match serde_json::to_value(table) {
            Ok(Value::Object(keys)) => keys.into_iter().filter(|(_, value)| !value.is_null()).collect(),
            _ => Vec::new(),
        }
    }
    let drive = (!sheet.drive.is_sine()).then(|| ("drive", entries(&sheet.drive)));
    let contact = sheet.contact.as_ref().map(|table| ("contact", entries(table)));
    let stator = sheet.stator.as_ref().map(|table| ("stator", entries(table)));
    let load = sheet.load.as_ref().map(|table| ("load", entries(table)));
    drive.into_iter().chain(contact).chain(stator).chain(load)
}

#[cfg(test)]
mod tests {
    //! Correct and incorrect texts, as people and programs write them.

    use super::*;

    type Read = fn(&str, &[(MotorField, f64)]) -> Result<Motor, MotorFileError>;
    type Write = fn(&[(&str, &str)]) -> String;

    /// For both formats: how a text is read, and how lines are written.
    fn formats() -> Vec<(Read, Write)> {
        vec![
            #[cfg(feature = "json")]
            (Motor::from_json_with, |lines| {
                let lines: Vec<_> = lines.iter().map(|(key, value)| format!("\"{key}\": {value}")).collect();
                format!("{{\n{}\n}}", lines.join(",\n"))
            }),
            #[cfg(feature = "toml")]
            (Motor::from_toml_with, |lines| {
                let lines = lines.iter().map(|(key, value)| format!("\"{key}\" = {value}\n"));
                format!("# A motor.\n{}", lines.collect::<String>())
            }),
        ]
    }

    const LINES: [(&str, &str); 9] = [
        ("drive_frequency", "40e3"),
        ("amplitude", "5e-7"),
        ("peak_angular_speed", "12"),
        ("mass", "0.02"),
        ("contact_radius", "1.25e-3"),
        ("gyration_radius", "6.3e-3"),
        ("preload_force", "5"),
        ("friction", "0.1"),
        ("restitution", "0.5"),
    ];

    #[test]
    fn faults_are_told_with_key_and_line() {
        for (read, write) in formats() {
            let motor = read(&write(&LINES), &[]).expect("legal");
            assert!((motor.preload_acceleration() - 250.0).abs() < 1e-12);
            assert_eq!((motor.load_torque(), motor.parameters().phase_lag), (0.0, 0.0));
            for text in [
                format!("\u{feff}{}", write(&LINES)),
                write(&LINES).replace('\n', "\r\n"),
                format!("\n\n{}\n", write(&LINES)),
            ] {
                assert_eq!(read(&text, &[]), Ok(motor.clone()), "{text:?}");
            }
            let replaced = |key: &str, with: (&'static str, &'static str)| {
                let changed = LINES.map(|line| if line.0 == key { with } else { line });
                let error = read(&write(&changed), &[]).expect_err(with.0);
                let line = LINES.iter().position(|line| line.0 == key).expect("there") + 2;
                (error.clone(), error.to_string(), format!("line {line}: "))
            };
            // A fault of the text is reported with its line, and the key or the value.
            for (key, with, told) in [
                ("contact_radius", ("contact_radus", "1"), "did you mean \"contact_radius\"?"),
                ("friction", ("colour", "1"), "\"colour\" is unknown; the known ones are drive_frequency"),
                ("friction", ("friction", "\"0.1\""), "0.1"),
                ("friction", ("friction", "true"), "true"),
                ("friction", ("friction", "[0.1]"), ""),
                ("friction", ("mass", "1"), ""),
                // A key that would colour a terminal.
                ("friction", ("\\u001b[31m", "1"), "unknown"),
            ] {
                let (error, text, line) = replaced(key, with);
                assert!(matches!(error, MotorFileError::Text { .. }), "{error:?}");
                assert!(text.starts_with(&line) && text.contains(told), "{text} {line}");
                assert!(!text.contains('\u{1b}'), "{text:?}");
            }
            for value in ["-1", "-1e-320", "0"] {
                let (error, text, _) = replaced("mass", ("mass", value));
                let named = matches!(error, MotorFileError::Illegal(Error::OutOfRange { field: "mass", .. }));
                assert!(named && text.starts_with("mass = "), "{text}");
            }
            for index in 0..LINES.len() {
                let mut less = LINES.to_vec();
                let (key, _) = less.remove(index);
                let error = read(&write(&less), &[]).expect_err(key);
                assert!(
                    matches!(error, MotorFileError::Illegal(_)) && error.to_string().contains(key),
                    "{error}"
                );
            }
            let both = Error::BothGiven { one: "preload_force", other: "preload_acceleration" };
            let more = [&LINES[..], &[("preload_acceleration", "250")]].concat();
            assert_eq!(read(&write(&more), &[]), Err(both.into()));
        }
    }

    #[cfg(feature = "toml")]
    #[test]
    fn a_drive_is_read_and_written() {
        use crate::parameters::driven_platform::Waveform;

        let sheet = Motor::paper_70_khz().to_toml();
        let refused = |drive: &str| {
            let found = Motor::from_toml(&format!("{sheet}[drive]\n{drive}\n"));
            found.expect_err(drive).to_string()
        };
        for (drive, told) in [
            ("hight = 'sine'", "\"hight\" is unknown; did you mean \"height\"?"),
            ("height = 'triangel'", "\"triangel\" is not a shape; write \"sine\", \"triangle\""),
            ("then = 'rest'", "drive.then is not a key: a drive is one motion that repeats"),
            ("height = { fourier = [[nan, 0]] }", "height: the harmonic is not finite"),
            ("angle = { pieces = [[1, [0, 1, 0, 0]]] }", "the angle jumps by -1.0 amplitudes where piece 0"),
            ("height = { pieces = [] }", "sum of the durations of the pieces = 0"),
        ] {
            let text = refused(drive);
            assert!(text.contains(told), "{drive}: {text}");
        }
        for (key, told) in [("drives = 1", "\"drive\""), ("drive = 1", "expected the table drive")] {
            let error = Motor::from_toml(&format!("{key}\n{sheet}")).expect_err(key);
            assert!(error.to_string().contains(told), "{error}");
        }
        let legal = |drive| format!("{sheet}[drive]\nheight = \"{drive}\"\n");
        let shapes = [
            Waveform::Triangle,
            Waveform::Sawtooth(0.3),
            Waveform::Fourier(vec![(1.0, 0.0), (0.1, 1e-3)]),
            Waveform::Pieces(vec![(0.5, [0.0, 1.0, 0.0, 0.0]), (0.5, [0.5, -1.0, 0.0, 0.0])]),
        ];
        for shape in shapes {
            let motor = Motor::paper_70_khz().with(|sheet| sheet.drive.height = shape).expect("legal");
            assert_eq!(Motor::from_toml(&motor.to_toml()).as_ref(), Ok(&motor), "{}", motor.to_toml());
            assert_eq!(Motor::from_json(&motor.to_json()).as_ref(), Ok(&motor), "{}", motor.to_json());
        }
        assert_eq!(Motor::from_toml(&legal("sine")), Ok(Motor::paper_70_khz()));
    }

    #[cfg(feature = "toml")]
    #[test]
    fn a_contact_is_read_as_it_is_written() {
        let motor = Motor::paper_70_khz().with(|sheet| sheet.contact = Some(Contact::PAPER)).expect("legal");
        assert_eq!(Motor::from_toml(&motor.to_toml()), Ok(motor.clone()));
        assert_eq!(Motor::from_json(&motor.to_json()), Ok(motor.clone()));
        for (from, to, told) in [
            ("\"steel\"", "\"stel\"", "\"stel\" is unknown; did you mean \"steel\"?"),
            ("\"steel\"", "\"cheese\"", "\"cheese\" is unknown; the known ones are steel, aluminium, "),
            ("[contact]", "[contacts]", "did you mean \"contact\"?"),
            ("ball_radius = 0.01", "ball_radius = -0.01", "contact.ball_radius = -0.01 is outside"),
            ("ball_radius", "ball_radus", "did you mean \"ball_radius\"?"),
        ] {
            let error = Motor::from_toml(&motor.to_toml().replace(from, to)).expect_err(to).to_string();
            assert!(error.contains(told), "{to}: {error}");
        }
    }

    /// Only the replacement is checked: the replaced value may be illegal, missing, or one of two
    /// alternatives.
    #[test]
    fn changes_come_before_the_checks() {
        for (read, write) in formats() {
            let motor = read(&write(&LINES), &[]).expect("legal");
            let with = |friction: &'static str| {
                LINES.map(|line| if line.0 == "friction" { ("friction", friction) } else { line })
            };
            let change = (MotorField::Friction, 0.1);
            assert_eq!(read(&write(&with("-1")), &[change]), Ok(motor.clone()));
            let missing: Vec<_> = LINES.into_iter().filter(|(name, _)| *name != "friction").collect();
            assert_eq!(read(&write(&missing), &[change]), Ok(motor.clone()));
            // If a field is changed several times, the last change counts.
            assert_eq!(
                read(&write(&with("0.5")), &[(MotorField::Friction, -7.0), change]),
                Ok(motor.clone())
            );
            // Both alternatives are present, and one is set again.
            let both = [&with("0.3")[..], &[("preload_acceleration", "250")]].concat();
            assert!(read(&write(&both), &[]).is_err());
            let expected = motor.with(|sheet| MotorField::PreloadForce.set(sheet, 0.4));
            let set = [(MotorField::PreloadForce, 0.4), change];
            assert_eq!(read(&write(&both), &set).ok(), expected.ok());
            for (text, change) in
                [("0.3", (MotorField::Friction, -1.0)), ("-1", (MotorField::Amplitude, 1e-8))]
            {
                let error = read(&write(&with(text)), &[change]).expect_err("negative");
                let named =
                    matches!(error, MotorFileError::Illegal(Error::OutOfRange { field: "friction", .. }));
                assert!(named, "{error}");
            }
            assert!(read("}", &[change]).is_err());
        }
    }

    #[cfg(feature = "json")]
    #[test]
    fn every_number_of_json_is_judged() {
        for (text, expected) in
            [("", (1, 1)), ("{\n\"mass\": }", (2, 9)), ("[1, 2]", (1, 1)), ("{} x", (1, 4))]
        {
            let error = Motor::from_json(text).expect_err(text);
            let MotorFileError::Text { line, column, ref reason } = error else { panic!("{text}: {error}") };
            assert_eq!((line, column), expected, "{text}: {error}");
            assert!(!reason.contains("at line"), "{error}");
        }
        let deep = format!("{{\"mass\": {}1{}}}", "[".repeat(100_000), "]".repeat(100_000));
        for text in [
            "null",
            "1",
            "\"mass\"",
            "{\"mass\": 01}",
            "{\"mass\": NaN}",
            "{mass: 1}",
            "{\"mass\": 1,}",
            deep.as_str(),
        ] {
            assert!(matches!(Motor::from_json(text), Err(MotorFileError::Text { .. })));
        }
        let (motor, text) = (Motor::paper_70_khz(), Motor::paper_70_khz().to_json());
        let with = |from: &str, to: &str| {
            assert!(text.contains(from));
            Motor::from_json(&text.replace(from, to))
        };
        // Numbers that exceed doubles at either end, and a missing value.
        let error = with("\"load_torque\": 0.0", "\"load_torque\": 1e999").expect_err("infinite").to_string();
        assert!(error.starts_with("line 12: "), "{error}");
        for value in ["\"load_torque\": 1e-999", "\"load_torque\": null", "\"rotor_radius\": null"] {
            assert_eq!(with("\"load_torque\": 0.0", value), Ok(motor.clone()));
        }
        let error = with("\"friction\": 0.1", "\"friction\": null");
        assert_eq!(error, Err(Error::NotGiven { field: "friction" }.into()));
        // Escapes in a key stand for ordinary letters.
        assert_eq!(with("\"friction\"", "\"\\u0066riction\""), Ok(motor));
        let long = with("\"friction\"", &format!("\"{}\"", "friction".repeat(1_000)));
        assert!(long.expect_err("unknown").to_string().len() < 600);
    }

    #[cfg(feature = "toml")]
    #[test]
    fn every_number_of_toml_is_judged() {
        let (motor, text) = (Motor::paper_70_khz(), Motor::paper_70_khz().to_toml());
        assert!(text.contains("drive_frequency = 70000.0 # Hz\n"), "{text}");
        for form in ["70_000", "70_000.0", "7e4", "+70000", "0x11170", "70e3"] {
            assert_eq!(Motor::from_toml(&text.replace("70000.0", form)), Ok(motor.clone()), "{form}");
        }
        for form in [
            "nan",
            "inf",
            "-inf",
            "1e999",
            "0",
            "-0x1",
            "2009-11-23",
            "{ Hz = 7 }",
            "'70'",
            "7,0",
            "7.0.0",
            "",
        ] {
            assert!(Motor::from_toml(&text.replace("70000.0", form)).is_err(), "{form}");
        }
        for (from, to) in [("phase_lag", "friction"), ("friction = 0.1", "friction")] {
            let changed = text.replace(from, to);
            let error = Motor::from_toml(&changed).expect_err(to);
            let MotorFileError::Text { line, .. } = error else { panic!("{to}: {error}") };
            assert!(changed.lines().nth(line - 1).expect("there").contains("friction"), "{to}: {error}");
        }
        assert_eq!(Motor::from_toml(""), Err(Error::NotGiven { field: "drive_frequency" }.into()));
        let error = Motor::from_toml(&format!("{text}[motor]\n")).expect_err("a table").to_string();
        assert!(error.contains("\"motor\""), "{error}");
    }
}
