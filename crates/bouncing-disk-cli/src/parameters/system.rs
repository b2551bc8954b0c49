//! Where the commands of tosses and orbits have their disk and platform from.

use std::path::{Path, PathBuf};

use bouncing_disk::System;
use clap::{Args, ValueEnum};

use super::Kind;
use super::document::entries;
use super::setting::Setting;
use super::sheet::{FIELDS, Sheet};
use crate::failure::Failure;

/// The systems of the paper, by the names that the library has for them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SystemPreset {
    /// The pizza toss of Table I: a stroke of 0.25 m at 15 rad/s
    PizzaToss,
    /// The motor of Table III at 70 kHz
    Motor,
}

impl SystemPreset {
    fn system(self) -> System {
        match self {
            Self::PizzaToss => System::pizza_toss(),
            Self::Motor => System::motor(),
        }
    }
}

/// Disk and platform.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Disk and platform")]
pub(crate) struct SystemArgs {
    /// A file of parameters, .toml or .json, in SI units; --template writes one
    #[arg(help_heading = None)]
    pub(crate) file: Option<PathBuf>,
    /// Parameters of the paper, in place of a file
    #[arg(long, conflicts_with = "file", value_name = "NAME")]
    pub(crate) preset: Option<SystemPreset>,
    /// Gives a parameter another value, in the unit of the file: disk.friction=0.2; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<Setting>,
    /// Writes the parameters as a commented TOML file, to the terminal or with --out FILE.toml into a file,
    /// and computes nothing
    #[arg(long)]
    pub(crate) template: bool,
}

impl SystemArgs {
    /// The file that is read, if any.
    pub(crate) fn inputs(&self) -> Vec<&Path> {
        self.file.as_deref().into_iter().collect()
    }

    /// Whether a system is asked for; otherwise it is the default, the pizza toss.
    pub(crate) fn is_given(&self) -> bool {
        self.file.is_some() || self.preset.is_some() || !self.set.is_empty()
    }

    /// The system.
    ///
    /// # Errors
    /// [`Failure::Usage`] names the file, the line and the key.
    pub(crate) fn system(&self) -> Result<System, Failure> {
        let Some(path) = &self.file else {
            let mut sheet = Sheet::from(&self.preset.unwrap_or(SystemPreset::PizzaToss).system());
            sheet.set(&self.set)?;
            return sheet.build();
        };
        let (text, format) = super::read(path, Kind::System)?;
        let read = || {
            let mut sheet = Sheet::of_entries(entries(&text, format).map_err(Failure::usage)?)?;
            sheet.set(&self.set)?;
            sheet.check_given()?;
            sheet.build()
        };
        read().map_err(|failure| failure.in_context(&path.display().to_string()))
    }
}

/// The parameters of a system as a file that is read to the same system, with comments.
pub(crate) fn template(system: &System) -> String {
    let sheet = Sheet::from(system);
    let mut text = "# A disk on a platform that vibrates and twists. SI units.\n".to_owned();
    let mut last = "";
    for field in &FIELDS {
        let (table, name) = field.path.split_once('.').unwrap_or_default();
        if table != last {
            text += &format!("\n[{table}]\n");
            last = table;
        }
        let unit = if field.unit == "1" { String::new() } else { format!("{}: ", field.unit) };
        text += &format!("{name} = {:?} # {unit}{}\n", (field.get)(&sheet), field.meaning);
    }
    text
}
