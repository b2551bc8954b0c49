//! A motor's data sheet, read by the library.

use bouncing_disk::Motor;
use bouncing_disk::motor::MotorField;
use bouncing_disk::parameters::DriveParameters;

use super::{Described, Format, Setting, SourceArgs};
use crate::range::Words;

pub(crate) type MotorArgs = SourceArgs<Motor>;

fn changes(settings: &[Setting]) -> Result<Vec<(MotorField, f64)>, String> {
    let change = |(key, value): &Setting| match key.parse::<MotorField>() {
        Ok(field) => Ok((field, *value)),
        Err(unknown) => Err(unknown.to_string()),
    };
    settings.iter().map(change).collect()
}

impl Described for Motor {
    const PRESETS: Words<fn() -> Self> = &[
        ("paper-70-khz", "The motor of Table III at 70 kHz", Self::paper_70_khz),
        ("paper-184-khz", "The same at its second operating frequency, 184 kHz", Self::paper_184_khz),
    ];

    const HAS_LOAD: bool = true;

    fn read(text: &str, format: Format, settings: &[Setting]) -> Result<Self, String> {
        let changes = changes(settings)?;
        let read = match format {
            Format::Json => Self::from_json_with(text, &changes),
            Format::Toml => Self::from_toml_with(text, &changes),
        };
        read.map_err(|error| error.to_string())
    }

    fn drive(&self) -> &DriveParameters {
        &self.parameters().drive
    }

    fn tables(&self) -> [(&'static str, bool); 2] {
        let sheet = self.parameters();
        [("[contact]", sheet.contact.is_some()), ("[load]", sheet.load.is_some())]
    }

    fn template(&self) -> String {
        let sheet = self.parameters();
        let mut text = "# The data sheet of a motor. SI units.\n\n".to_owned();
        for field in MotorField::ALL.into_iter().filter(|field| !field.in_table()) {
            if let Some(value) = field.value(sheet) {
                text += &format!("{field} = {value:?} # {}\n", described(field));
            }
        }
        text += "\n# Other fields; give only one of the fields that state the same quantity.\n";
        let outside = |field: &MotorField| !field.in_table() && field.value(sheet).is_none();
        for field in MotorField::ALL.into_iter().filter(outside) {
            let excluded: Vec<&str> = field.excluded().iter().map(|other| other.name()).collect();
            let instead = if excluded.is_empty() {
                String::new()
            } else {
                format!("; instead of {}", excluded.join(", "))
            };
            text += &format!("# {field} = ... # {}{instead}\n", described(field));
        }
        text +=
            "\n# A compliant stator, driven by the amplitude above or, without it, by volts or a force.\n";
        // Numbers and words are the same text in JSON and in TOML.
        match serde_json::to_value(sheet.stator) {
            Ok(serde_json::Value::Object(table)) => {
                text += "[stator]\n";
                table.iter().for_each(|(field, value)| text += &format!("{field} = {value}\n"));
            }
            _ => text += STATOR,
        }
        text
    }
}

const STATOR: &str = "\
# [stator]
# mass = 0.05 # kg
# quality = 300
# volts = 20 # V
# resonance = 70e3 # Hz; anti_resonance too
# anti_resonance = 71e3
# capacitance = 1.2e-9 # F
";

/// The unit and meaning of a field.
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
        MotorField::PreloadForce => "total force F that presses the rotor onto the stator",
        MotorField::PreloadAcceleration => "preload acceleration g = F/m",
        MotorField::SpringConstant => "constant k of the preload spring",
        MotorField::Friction => "coefficient of friction mu",
        MotorField::Restitution => "coefficient of restitution, in [0, 1)",
        MotorField::LoadTorque => "load torque; a positive one decelerates a positive rotation",
        MotorField::ContactTime => "how long an impact lasts",
        MotorField::StatorMass => "effective mass M of the compliant stator",
        MotorField::StatorQuality => "its quality factor Q",
        MotorField::StatorResonance => "its resonance",
        MotorField::StatorTwistPerHeight => "twist over height of its mode, kappa",
        MotorField::StatorForce => "amplitude of the force that drives it",
        MotorField::StatorVolts => "amplitude of the voltage that drives it",
    };
    match field.unit() {
        "1" => meaning.to_owned(),
        unit => format!("{unit}: {meaning}"),
    }
}
