//! The variables of a unit.

use bouncing_disk::Motor;
use bouncing_disk::motor::{MotorField, MotorInputs, MotorOutputs, SimulationSettings};

/// The use of a variable.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Role {
    Time,
    /// A number of the data sheet.
    Sheet(MotorField),
    Setting(fn(&mut SimulationSettings, f64)),
    Input(fn(&mut MotorInputs, f64)),
    Output(fn(&MotorOutputs) -> f64),
}

/// A variable; its index is its value reference.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Variable {
    pub(crate) name: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) description: &'static str,
    pub(crate) start: f64,
    pub(crate) role: Role,
}

/// The variables of a motor.
pub(crate) fn variables(motor: &Motor) -> Vec<Variable> {
    let (inputs, settings) = (MotorInputs::of(motor), SimulationSettings::default());
    let drive = MotorInputs::drive_field(motor);
    let of = |name, unit, description, start, role| Variable { name, unit, description, start, role };
    let mut all = vec![
        of("time", "s", "Time", 0.0, Role::Time),
        of(
            MotorField::LoadTorque.name(),
            "N m",
            "Torque of the load; a positive torque decelerates a positive rotation",
            inputs.load_torque,
            Role::Input(|inputs, value| inputs.load_torque = value),
        ),
        of(
            drive.name(),
            drive.unit(),
            "Amplitude of the drive",
            inputs.drive,
            Role::Input(|inputs, value| inputs.drive = value),
        ),
        of(
            MotorField::DriveFrequency.name(),
            "Hz",
            "Frequency of the drive",
            inputs.drive_frequency,
            Role::Input(|inputs, value| inputs.drive_frequency = value),
        ),
        of(
            "drive_on",
            "1",
            "The drive is on above 1/2",
            1.0,
            Role::Input(|inputs, value| inputs.on = value > 0.5),
        ),
        of("angle", "rad", "Angle of the rotor", 0.0, Role::Output(|at| at.angle)),
        of("speed", "rad/s", "Angular speed of the rotor", 0.0, Role::Output(|at| at.speed)),
        of(
            "shaft_torque",
            "N m",
            "Torque of the stator on rotor and shaft, a mean over the last step",
            0.0,
            Role::Output(|at| at.shaft_torque),
        ),
        of(
            "vibration_amplitude",
            "m",
            "Amplitude of the stator's height about its mean, at the frequency of the drive",
            0.0,
            Role::Output(|at| at.amplitude),
        ),
        of("power", "W", "Power of the drive, a mean over the last step", 0.0, Role::Output(|at| at.power)),
        of("impacts", "1", "Impacts since the start", 0.0, Role::Output(|at| at.impacts as f64)),
    ];
    if motor.stator().and_then(|stator| stator.circuit()?.capacitance).is_some() {
        let current = |at: &MotorOutputs| at.current.unwrap_or_default();
        let text = "Amplitude of the current about its mean, at the frequency of the drive";
        all.push(of("current", "A", text, 0.0, Role::Output(current)));
    }
    let given =
        MotorField::ALL.into_iter().filter_map(|field| Some((field, field.value(motor.parameters())?)));
    let inputs: Vec<_> = all.iter().map(|known| known.name).collect();
    for (field, value) in given.filter(|(field, _)| !inputs.contains(&field.name())) {
        all.push(of(field.name(), field.unit(), "Parameter of the data sheet", value, Role::Sheet(field)));
    }
    let phase = Role::Setting(|settings, value| settings.phase = value);
    all.push(of("start_phase", "rad", "Phase of the stator at the start", settings.phase, phase));
    let perturbation = Role::Setting(|settings, value| settings.relaunch_perturbation = value);
    let text = "Size of the perturbation of each separation, in units of g/omega";
    all.push(of("relaunch_perturbation", "1", text, settings.relaunch_perturbation, perturbation));
    let seed = Role::Setting(|settings, value| settings.seed = value as u64);
    all.push(of("seed", "1", "Seed of the perturbations", settings.seed as f64, seed));
    all
}
