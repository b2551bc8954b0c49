//! Where the commands of motors have their data sheet from.

use std::path::{Path, PathBuf};

use bouncing_disk::{Motor, MotorField, MotorFileError};
use clap::{Args, ValueEnum};

use super::setting::Setting;
use super::{Format, Kind};
use crate::failure::Failure;
use crate::output::lines::complain;

/// The motors of the paper, by the names that the library has for them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum MotorPreset {
    /// The motor of Table III at 70 kHz
    #[value(name = "paper-70-khz")]
    Paper70Khz,
    /// The same at its second operating frequency, 184 kHz
    #[value(name = "paper-184-khz")]
    Paper184Khz,
}

impl MotorPreset {
    fn motor(self) -> Motor {
        match self {
            Self::Paper70Khz => Motor::paper_70_khz(),
            Self::Paper184Khz => Motor::paper_184_khz(),
        }
    }
}

/// A motor's data sheet.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Motor")]
pub(crate) struct MotorArgs {
    /// A data sheet, .toml or .json, in SI units; --template writes one
    #[arg(help_heading = None)]
    pub(crate) file: Option<PathBuf>,
    /// A motor of the paper, in place of a file
    #[arg(long, conflicts_with = "file", value_name = "NAME")]
    pub(crate) preset: Option<MotorPreset>,
    /// Gives a field of the data sheet another value: friction=0.2; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<Setting>,
    /// Writes the data sheet as a commented TOML file, to the terminal or with --out FILE.toml into a file,
    /// and computes nothing
    #[arg(long)]
    pub(crate) template: bool,
}

impl MotorArgs {
    /// The file that is read, if any.
    pub(crate) fn inputs(&self) -> Vec<&Path> {
        self.file.as_deref().into_iter().collect()
    }

    /// The motor; what is legal in its data sheet and yet unlikely to be meant is told, unless `quiet`.
    ///
    /// # Errors
    /// [`Failure::Usage`] names the file, the line and the key.
    pub(crate) fn motor(&self, quiet: bool) -> Result<Motor, Failure> {
        let motor = self.changed()?;
        if !quiet {
            motor.warnings().iter().for_each(|warning| complain!("warning: {warning}"));
        }
        Ok(motor)
    }

    /// What is set takes the place of what the file says before anything is checked, so that it can put a
    /// wrong file right.
    fn changed(&self) -> Result<Motor, Failure> {
        let field = |setting: &Setting| match setting.key.parse::<MotorField>() {
            Ok(field) => Ok((field, setting.value)),
            Err(unknown) => Err(Failure::usage(format!("--set: {unknown}"))),
        };
        let changes = self.set.iter().map(field).collect::<Result<Vec<_>, _>>()?;
        let Some(path) = &self.file else {
            let mut sheet = self.preset.unwrap_or(MotorPreset::Paper70Khz).motor().parameters();
            changes.iter().for_each(|(field, value)| field.set(&mut sheet, *value));
            let built = sheet.build().map_err(Failure::from);
            return built.map_err(|failure| failure.in_context("--set"));
        };
        let (text, format) = super::read(path, Kind::Motor)?;
        let read = match format {
            Format::Json => Motor::from_json_with(&text, &changes),
            Format::Toml => Motor::from_toml_with(&text, &changes),
        };
        read.map_err(|error| {
            // An illegal value may be that of a setting.
            let set = matches!(error, MotorFileError::Illegal(_)) && !changes.is_empty();
            let place =
                if set { format!("{} with --set", path.display()) } else { path.display().to_string() };
            Failure::usage(format!("{place}: {error}"))
        })
    }
}

/// The data sheet as a file that is read to the same motor, with comments.
pub(crate) fn template(motor: &Motor) -> String {
    let sheet = motor.parameters();
    let mut text = "# The data sheet of a motor. SI units.\n\n".to_owned();
    for field in MotorField::ALL {
        if let Some(value) = field.value(&sheet) {
            text += &format!("{field} = {value:?} # {}\n", described(field));
        }
    }
    text += "\n# What else there may be; of fields that say the same, only one.\n";
    for field in MotorField::ALL.into_iter().filter(|field| field.value(&sheet).is_none()) {
        let excluded: Vec<&str> = field.excluded().iter().map(|other| other.name()).collect();
        let instead = if excluded.is_empty() {
            String::new()
        } else {
            format!("; in place of {}", excluded.join(", "))
        };
        text += &format!("# {field} = ... # {}{instead}\n", described(field));
    }
    text
}

/// The unit of a field and what it is.
fn described(field: MotorField) -> String {
    let meaning = match field {
        MotorField::DriveFrequency => "drive frequency omega/(2 pi)",
        MotorField::Amplitude => "axial amplitude A of the stator",
        MotorField::PeakAngularSpeed => "largest angular speed omega Phi of the stator",
        MotorField::TwistAmplitude => "twist amplitude Phi of the stator",
        MotorField::PhaseLag => "phase lag theta of the twist",
        MotorField::Mass => "mass m of the rotor",
        MotorField::Density => "density of the rotor, with its radius and thickness",
        MotorField::RotorRadius => "outer radius of the rotor",
        MotorField::RotorThickness => "thickness of the rotor, a solid disc",
        MotorField::ContactRadius => "effective contact radius a_e",
        MotorField::GyrationRadius => "radius of gyration a_g",
        MotorField::PreloadForce => "all of the force F that presses the rotor onto the stator",
        MotorField::PreloadAcceleration => "preload acceleration g = F/m",
        MotorField::SpringConstant => "constant k of the spring that makes the preload",
        MotorField::Friction => "coefficient of friction mu",
        MotorField::Restitution => "coefficient of restitution, in [0, 1)",
        MotorField::LoadTorque => "load torque; a positive one decelerates a positive rotation",
    };
    match field.unit() {
        "1" => meaning.to_owned(),
        unit => format!("{unit}: {meaning}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn args(settings: &[&str]) -> MotorArgs {
        let set = settings.iter().map(|text| text.parse().unwrap()).collect();
        MotorArgs { file: None, preset: None, set, template: false }
    }

    #[test]
    fn a_template_is_read_to_the_same_motor() {
        for motor in [Motor::paper_70_khz(), Motor::paper_184_khz()] {
            assert_eq!(Motor::from_toml(&template(&motor)), Ok(motor));
        }
    }

    #[test]
    fn single_values_are_set_with_what_they_exclude() {
        let motor = args(&["preload_force=0.4", "friction=0.2"]).motor(true).unwrap();
        assert!((motor.preload_force() - 0.4).abs() < 1e-15);
        for (setting, told) in [
            ("frction=0.2", "did you mean \"friction\"?"),
            ("friction=-1", "--set: friction = -1 is outside"),
            ("friction=nan", "friction = NaN"),
        ] {
            let Err(Failure::Usage(text)) = args(&[setting]).motor(true) else { panic!("{setting}") };
            assert!(text.contains(told), "{setting}: {text}");
        }
    }
}
