//! The parameters of a disk on a platform, by name: what a file and `--set` have.

use bouncing_disk::{DiskParameters, PlatformParameters, System};

use super::document::{Entry, Value};
use super::setting::{Setting, unknown};
use crate::failure::Failure;

/// A parameter.
pub(super) struct Field {
    /// The table and the key: `disk.friction`.
    pub(super) path: &'static str,
    pub(super) unit: &'static str,
    pub(super) meaning: &'static str,
    /// What a file may leave out, for zero.
    optional: bool,
    pub(super) get: fn(&Sheet) -> f64,
    set: fn(&mut Sheet, f64),
}

/// The macro keeps a field's line short.
macro_rules! field {
    ($table:ident.$name:ident, $unit:literal, $optional:literal, $meaning:literal) => {
        Field {
            path: concat!(stringify!($table), ".", stringify!($name)),
            unit: $unit,
            meaning: $meaning,
            optional: $optional,
            get: |sheet| sheet.$table.$name,
            set: |sheet, value| sheet.$table.$name = value,
        }
    };
}

pub(super) const FIELDS: [Field; 10] = [
    field!(platform.amplitude, "m", false, "amplitude A of the height"),
    field!(platform.twist_amplitude, "rad", false, "amplitude Phi of the angle"),
    field!(platform.angular_frequency, "rad/s", false, "angular frequency omega"),
    field!(platform.phase_lag, "rad", false, "phase lag theta of the twist"),
    field!(disk.contact_radius, "m", false, "effective contact radius a_e"),
    field!(disk.gyration_radius, "m", false, "radius of gyration a_g"),
    field!(disk.friction, "1", false, "coefficient of friction mu"),
    field!(disk.restitution, "1", false, "coefficient of restitution, in [0, 1)"),
    field!(
        disk.preload_acceleration,
        "m/s^2",
        false,
        "preload acceleration g; gravity, where nothing else presses"
    ),
    field!(disk.load_acceleration, "rad/s^2", true, "angular deceleration by a load, T/(m a_g^2)"),
];

/// Where a value comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Origin {
    Line(usize),
    Set,
}

/// The parameters of a system, not yet checked, with the places that they come from.
#[derive(Debug, Clone)]
pub(super) struct Sheet {
    pub(super) platform: PlatformParameters,
    pub(super) disk: DiskParameters,
    origins: [Option<Origin>; FIELDS.len()],
}

impl From<&System> for Sheet {
    fn from(system: &System) -> Self {
        let (platform, disk) = (system.platform().parameters(), system.disk().parameters());
        Self { platform, disk, origins: [None; FIELDS.len()] }
    }
}

/// The key without its table.
pub(super) fn name(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}

impl Sheet {
    /// The parameters of a file, of which some may be missing.
    ///
    /// # Errors
    /// Names line and key.
    pub(super) fn of_entries(entries: Vec<Entry>) -> Result<Self, Failure> {
        // All of it is given by the file or set, which [`Self::check_given`] sees.
        let mut sheet = Self::from(&System::pizza_toss());
        sheet.disk.load_acceleration = 0.0;
        for Entry { key: table, line, value } in entries {
            let tables = ["platform", "disk"];
            if !tables.contains(&table.as_str()) {
                return Err(at(line, &unknown(&table, tables.into_iter())));
            }
            let Value::Table(keys) = value else {
                return Err(at(line, &format!("\"{table}\" must be a table of numbers")));
            };
            for entry in keys {
                sheet.read(&table, &entry)?;
            }
        }
        Ok(sheet)
    }

    /// Checks that all that is needed of a file is there, after what is set has been.
    ///
    /// # Errors
    /// Names the first parameter that is not.
    pub(super) fn check_given(&self) -> Result<(), Failure> {
        let mut needed = FIELDS.iter().zip(self.origins).filter(|(field, _)| !field.optional);
        match needed.find(|(_, origin)| origin.is_none()) {
            Some((field, _)) => Err(Failure::usage(format!("{} is not given", field.path))),
            None => Ok(()),
        }
    }

    fn read(&mut self, table: &str, entry: &Entry) -> Result<(), Failure> {
        let path = format!("{table}.{}", entry.key);
        let of_table = || FIELDS.iter().map(|field| field.path).filter(|path| path.starts_with(table));
        let Some(index) = FIELDS.iter().position(|field| field.path == path) else {
            return Err(at(entry.line, &unknown(&entry.key, of_table().map(name))));
        };
        match entry.value {
            Value::Number(value) => {
                (FIELDS[index].set)(self, value);
                self.origins[index] = Some(Origin::Line(entry.line));
                Ok(())
            }
            Value::Nothing => Ok(()),
            Value::Table(_) => Err(at(entry.line, &format!("\"{path}\" must be a number, and is a table"))),
            Value::Other(found) => {
                Err(at(entry.line, &format!("\"{path}\" must be a number, and is {found}")))
            }
        }
    }

    /// Gives single parameters other values.
    ///
    /// # Errors
    /// Names the key.
    pub(super) fn set(&mut self, settings: &[Setting]) -> Result<(), Failure> {
        for Setting { key, value } in settings {
            let Some(index) = FIELDS.iter().position(|field| field.path == key) else {
                // Who leaves out the table is told the whole path.
                let known = FIELDS.iter().map(|field| field.path);
                let meant = FIELDS
                    .iter()
                    .find(|field| name(field.path) == key)
                    .map_or(key.as_str(), |field| field.path);
                let text = unknown(meant, known);
                let text = if meant == key {
                    text
                } else {
                    format!("the key \"{key}\" is unknown; did you mean \"{meant}\"?")
                };
                return Err(Failure::usage(format!("--set: {text}")));
            };
            (FIELDS[index].set)(self, *value);
            self.origins[index] = Some(Origin::Set);
        }
        Ok(())
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// Names the parameter, and where its value comes from.
    pub(super) fn build(&self) -> Result<System, Failure> {
        let built = (|| System::new(self.platform.build()?, self.disk.build()?))();
        built.map_err(|error| match error {
            bouncing_disk::Error::OutOfRange { field, .. } => self.located(field, &error.to_string()),
            // P = A omega^2/g.
            bouncing_disk::Error::Core(bouncing_disk::core::Error::OutOfRange {
                field: "peak_acceleration",
                ..
            }) => self.located("amplitude", &error.to_string()),
            other => other.into(),
        })
    }

    fn located(&self, field: &str, text: &str) -> Failure {
        let origin =
            FIELDS.iter().position(|own| name(own.path) == field).and_then(|index| self.origins[index]);
        match origin {
            Some(Origin::Line(line)) => at(line, text),
            Some(Origin::Set) => Failure::usage(format!("--set: {text}")),
            None => Failure::usage(text),
        }
    }
}

fn at(line: usize, text: &str) -> Failure {
    Failure::usage(format!("line {line}: {text}"))
}

#[cfg(test)]
mod tests {
    use super::super::Format;
    use super::super::document::entries;
    use super::super::system::template;
    use super::*;

    fn read(text: &str) -> Result<System, Failure> {
        let sheet = Sheet::of_entries(entries(text, Format::Toml).map_err(Failure::usage)?)?;
        sheet.check_given()?;
        sheet.build()
    }

    fn told(result: Result<System, Failure>) -> String {
        match result {
            Err(Failure::Usage(text)) => text,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_template_is_read_to_the_same_system() {
        for system in [System::pizza_toss(), System::motor()] {
            assert_eq!(read(&template(&system)).unwrap(), system);
        }
    }

    #[test]
    fn faults_are_told_with_key_and_line() {
        let text = template(&System::pizza_toss());
        let line = 1 + text.lines().position(|line| line.starts_with("friction")).unwrap();
        for (from, to, expected) in [
            ("friction = 0.6", "fricton = 0.6", "the key \"fricton\" is unknown; did you mean \"friction\"?"),
            ("friction = 0.6", "friction = -1", "friction = -1 is outside its legal range"),
            ("friction = 0.6", "friction = nan", "friction = NaN is outside"),
            ("friction = 0.6", "friction = inf", "friction = inf is outside"),
            ("friction = 0.6", "friction = '0.6'", "\"disk.friction\" must be a number, and is a text"),
            ("friction = 0.6", "friction = {}", "must be a number, and is a table"),
        ] {
            let text = told(read(&text.replace(from, to)));
            assert!(text.starts_with(&format!("line {line}: ")) && text.contains(expected), "{to}: {text}");
        }
        assert!(told(read(&text.replace("[disk]", "[disc]"))).contains("did you mean \"disk\"?"));
        assert!(told(read(&text.replace("friction = 0.6", ""))).contains("disk.friction is not given"));
        assert!(told(read("disk = 1")).contains("line 1: \"disk\" must be a table"));
        assert!(told(read("")).contains("platform.amplitude is not given"));
        // What has a default may be missing.
        assert!(read(&text.replace("\nload_acceleration", "\n# load")).is_ok());
    }

    #[test]
    fn single_values_are_set_and_checked() {
        let set = |key: &str, value| {
            let mut sheet = Sheet::from(&System::pizza_toss());
            sheet.set(&[Setting { key: key.to_owned(), value }])?;
            sheet.build()
        };
        assert!((set("disk.friction", 0.2).unwrap().disk().friction() - 0.2).abs() < 1e-15);
        assert!(told(set("disk.friction", f64::NAN)).starts_with("--set: friction = NaN"));
        assert!(told(set("disk.fricton", 0.2)).ends_with("did you mean \"disk.friction\"?"));
        assert!(told(set("friction", 0.2)).ends_with("did you mean \"disk.friction\"?"));
        assert!(told(set("platform.amplitude", 1e12)).starts_with("--set: peak_acceleration"));
    }
}
