//! A disk on a platform: the parameters of the commands for tosses and orbits.

use bouncing_disk::System;
use bouncing_disk::parameters::{Contact, DriveParameters, StatorParameters};
use bouncing_disk::sheet_text;
use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::{Described, Format, Setting, SourceArgs};
use crate::range::Words;

pub(crate) type SystemArgs = SourceArgs<DrivenDisk>;

/// A disk on a platform, and the drive of the platform.
#[derive(Debug, Clone)]
pub(crate) struct DrivenDisk {
    pub(crate) system: System,
    pub(crate) drive: DriveParameters,
}

const PIZZA_TOSS: fn() -> DrivenDisk = || DrivenDisk::from(System::pizza_toss());
const MOTOR: fn() -> DrivenDisk = || DrivenDisk::from(System::motor());

impl From<System> for DrivenDisk {
    fn from(system: System) -> Self {
        Self { system, drive: DriveParameters::default() }
    }
}

/// The parameters: table and key, unit, meaning.
const FIELDS: [(&str, &str, &str); 11] = [
    ("platform.amplitude", "m", "amplitude A of the height"),
    ("platform.twist_amplitude", "rad", "amplitude Phi of the angle"),
    ("platform.angular_frequency", "rad/s", "angular frequency omega"),
    ("platform.phase_lag", "rad", "phase lag theta of the twist"),
    ("disk.contact_radius", "m", "effective contact radius a_e"),
    ("disk.gyration_radius", "m", "radius of gyration a_g"),
    ("disk.friction", "1", "coefficient of friction mu"),
    ("disk.restitution", "1", "coefficient of restitution, in [0, 1)"),
    ("disk.preload_acceleration", "m/s^2", "preload acceleration g; gravity if nothing else presses"),
    ("disk.load_acceleration", "rad/s^2", "angular deceleration by a load, T/(m a_g^2)"),
    ("contact.time", "s", "how long an impact lasts"),
];

/// A file, in which parameters given by --set may be missing.
#[derive(Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields, default, expecting = "the tables platform, disk, drive, contact and stator")]
struct File {
    platform: PlatformTable,
    disk: DiskTable,
    #[serde(skip_serializing)]
    drive: DriveParameters,
    #[serde(skip_serializing_if = "Option::is_none")]
    contact: Option<Contact>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stator: Option<StatorParameters>,
}

#[derive(Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields, default, expecting = "the table platform")]
struct PlatformTable {
    amplitude: Option<f64>,
    twist_amplitude: Option<f64>,
    angular_frequency: Option<f64>,
    phase_lag: Option<f64>,
}

#[derive(Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields, default, expecting = "the table disk")]
struct DiskTable {
    contact_radius: Option<f64>,
    gyration_radius: Option<f64>,
    friction: Option<f64>,
    restitution: Option<f64>,
    preload_acceleration: Option<f64>,
    load_acceleration: Option<f64>,
}

/// The tables of a file, or of a whole system.
fn tables(of: &impl Serialize) -> Result<Table, String> {
    Table::try_from(of).map_err(|error| error.to_string())
}

/// Sets values, and checks all.
fn build(mut tables: Table, settings: &[Setting]) -> Result<System, String> {
    let paths = FIELDS.map(|(path, ..)| path);
    for (key, value) in settings {
        let known = paths.iter().find(|path| *path == key).and_then(|path| path.split_once('.'));
        let Some((table, name)) = known else { return Err(sheet_text::unknown_key(key, &paths)) };
        // A time replaces materials.
        if table == "contact" {
            let law = tables.get(table).and_then(|contact| contact.get("law").cloned());
            tables.insert(
                table.to_owned(),
                law.map(|law| ("law".to_owned(), law)).into_iter().collect::<Table>().into(),
            );
        }
        if let Some(Value::Table(table)) = tables.get_mut(table) {
            table.insert(name.to_owned(), (*value).into());
        }
    }
    tables.try_into().map_err(|error| error.message().to_owned())
}

impl Described for DrivenDisk {
    const PRESETS: Words<fn() -> Self> = &[
        ("pizza-toss", "The pizza toss of Table I: a stroke of 0.25 m at 15 rad/s", PIZZA_TOSS),
        ("motor", "The motor of Table III at 70 kHz", MOTOR),
    ];

    fn read(text: &str, format: Format, settings: &[Setting]) -> Result<Self, String> {
        let file = match format {
            Format::Json => sheet_text::from_json::<File>(text),
            Format::Toml => sheet_text::from_toml(text),
        };
        let mut file = file.map_err(|error| error.to_string())?;
        // A file may leave it out.
        file.disk.load_acceleration.get_or_insert(0.0);
        file.drive.check().map_err(|error| error.to_string())?;
        let system = build(tables(&file)?, settings)?;
        Ok(Self { system, drive: file.drive })
    }

    fn tables(&self) -> [(&'static str, bool); 2] {
        let system = &self.system;
        [("[contact]", system.contact().is_some()), ("[stator]", system.stator().is_some())]
    }

    fn drive(&self) -> &DriveParameters {
        &self.drive
    }

    fn template(&self) -> String {
        let tables = tables(&self.system).unwrap_or_default();
        let mut text = "# A disk on a platform that vibrates and twists. SI units.\n".to_owned();
        let mut last = "";
        for (path, unit, meaning) in FIELDS.into_iter().filter(|(path, ..)| *path != "contact.time") {
            let (table, name) = path.split_once('.').unwrap_or_default();
            if table != last {
                text += &format!("\n[{table}]\n");
                last = table;
            }
            let unit = if unit == "1" { String::new() } else { format!("{unit}: ") };
            let value = tables.get(table).and_then(|table| table.get(name)?.as_float()).unwrap_or_default();
            text += &format!("{name} = {value:?} # {unit}{meaning}\n");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bouncing_disk::parameters::ContactLaw;

    fn read(text: &str, format: Format) -> Result<System, String> {
        DrivenDisk::read(text, format, &[]).map(|own| own.system)
    }

    #[test]
    fn both_formats_give_the_same_system() {
        for system in [System::pizza_toss(), System::motor()] {
            assert_eq!(read(&DrivenDisk::from(system).template(), Format::Toml), Ok(system));
            assert_eq!(read(&serde_json::to_string(&system).unwrap(), Format::Json), Ok(system));
        }
    }

    #[test]
    fn a_contact_is_read_with_its_system() {
        let with =
            |entry: &str| read(&format!("{}[contact]\n{entry}\n", PIZZA_TOSS().template()), Format::Toml);
        assert_eq!(
            with("time = 0.02").map(|system| system.soft_contact()),
            Ok(Some((ContactLaw::Damper, 0.02)))
        );
        assert!(with("time = 0").unwrap_err().contains("contact.time = 0 is outside"));
        let known = "is unknown; the known ones are steel, aluminium, ";
        assert!(with("materials = ['cheese', 'skin']").unwrap_err().contains(known));
    }

    #[test]
    fn faults_are_reported_with_line_and_key() {
        let template = PIZZA_TOSS().template();
        let changed = |from: &str, to: &str| template.replace(from, to);
        let line = 1 + template.lines().position(|line| line.starts_with("friction")).unwrap();
        let toml = |to: &str| (changed("friction = 0.6", to), Format::Toml);
        let table = |to: &str| (to.to_owned(), Format::Toml);
        let json = |text: &str| (text.to_owned(), Format::Json);
        for ((text, format), told) in [
            (toml("fricton = 0.6"), "the key \"fricton\" is unknown; did you mean \"friction\"?"),
            (toml("friction = '0.6'"), "invalid type: string \"0.6\", expected a number"),
            (toml("friction = {}"), "invalid type: map, expected a number"),
            (toml("friction = "), ""),
        ] {
            let why = read(&text, format).unwrap_err();
            assert!(why.starts_with(&format!("line {line}: {told}")), "{text}: {why}");
        }
        for ((text, format), told) in [
            (toml("friction = nan"), "friction = NaN is outside its legal range"),
            (toml(""), "missing field `friction`"),
            (table(&changed("[disk]", "[disc]")), "did you mean \"disk\"?"),
            (table("disk = 1"), "line 1: invalid type: integer `1`, expected the table disk"),
            (table(""), "missing field"),
            (json(""), "line 1: EOF while parsing a value"),
            (json("[1]"), "line 1: invalid type: integer `1`, expected the table platform"),
            (json("{\n\"disk\": {\"friction\": 1,\n}"), "line 3: "),
            (json("{\"disk\": {\n\"friction\": 1,\n\"friction\": 2}}"), "line 3: duplicate field `friction`"),
            (json("{\"disk\": {\"a\\u001b[2J\": 1}}"), "the key \"a\\u{1b}[2J\" is unknown"),
        ] {
            let why = read(&text, format).unwrap_err();
            assert!(why.contains(told), "{text}: {why}");
        }
        // The load may be missing, and nothing is the same as no key.
        assert!(read(&changed("\nload_acceleration", "\n# load"), Format::Toml).is_ok());
        let stored = serde_json::to_string(&System::pizza_toss()).unwrap();
        let nothing = stored.replace("\"load_acceleration\":0.0", "\"load_acceleration\":null");
        assert!(nothing != stored && read(&nothing, Format::Json).is_ok());
    }
}
