//! An instance of the unit: the calls that are legal in each state, and their actions.

use bouncing_disk::Motor;
use bouncing_disk::core::Unobserved;
use bouncing_disk::motor::{MotorInputs, MotorOutputs, MotorSimulation, SimulationSettings};

use crate::variables::{Role, Variable, variables};

/// A communication point must equal the end of the last step within this share of the step and the rounding of
/// the times.
const SAME_POINT: f64 = 1.0e-9;

/// 2^53: above it, a double cannot represent every whole number.
const MOST_SEED: f64 = 9_007_199_254_740_992.0;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Mode {
    Instantiated,
    Initialization,
    Step,
    Terminated,
}

/// An independent motor; its clone serves as a stored state.
#[derive(Debug, Clone)]
pub(crate) struct Instance {
    motor: Motor,
    variables: Vec<Variable>,
    /// The values of the variables; entries for outputs have no meaning.
    values: Vec<f64>,
    mode: Mode,
    start: f64,
    /// The simulation with its outputs, once the parameters are known.
    running: Option<(MotorSimulation, MotorOutputs)>,
}

impl Instance {
    pub(crate) fn new(motor: &Motor) -> Self {
        let variables = variables(motor);
        let values = variables.iter().map(|variable| variable.start).collect();
        Self { motor: motor.clone(), variables, values, mode: Mode::Instantiated, start: 0.0, running: None }
    }

    pub(crate) fn reset(&mut self) -> Result<(), String> {
        *self = Self::new(&self.motor);
        Ok(())
    }

    fn to(&mut self, from: &[Mode], to: Mode) -> Result<(), String> {
        if !from.contains(&self.mode) {
            return Err(format!("this call is not legal in the state {:?}", self.mode));
        }
        self.mode = to;
        Ok(())
    }

    pub(crate) fn enter_initialization(&mut self, start: f64) -> Result<(), String> {
        if !start.is_finite() {
            return Err(format!("startTime = {start:?} is not finite"));
        }
        self.to(&[Mode::Instantiated], Mode::Initialization)?;
        self.start = start;
        Ok(())
    }

    pub(crate) fn exit_initialization(&mut self) -> Result<(), String> {
        if self.mode == Mode::Initialization {
            self.started()?;
        }
        self.to(&[Mode::Initialization], Mode::Step)
    }

    pub(crate) fn terminate(&mut self) -> Result<(), String> {
        self.to(&[Mode::Step], Mode::Terminated)
    }

    fn variable(&self, reference: u32) -> Result<&Variable, String> {
        let found = self.variables.get(reference as usize);
        found.ok_or_else(|| format!("there is no variable with the reference {reference}"))
    }

    pub(crate) fn set(&mut self, reference: u32, value: f64) -> Result<(), String> {
        let Variable { name, role, .. } = *self.variable(reference)?;
        let early = matches!(self.mode, Mode::Instantiated | Mode::Initialization);
        match role {
            Role::Time | Role::Output(_) => return Err(format!("{name} cannot be set")),
            Role::Sheet(_) | Role::Setting(_) if !early => {
                return Err(format!("the parameter {name} can be set until the initialisation ends"));
            }
            Role::Input(_) if self.mode == Mode::Terminated => {
                return Err(format!("{name} cannot be set after the termination"));
            }
            _ => {}
        }
        if !value.is_finite() {
            return Err(format!("{name} = {value:?} is not finite"));
        }
        if name == "seed" && !(value.fract() == 0.0 && (0.0..=MOST_SEED).contains(&value)) {
            return Err(format!("seed = {value:?} is not a whole number in [0, 2^53]"));
        }
        self.values[reference as usize] = value;
        if early {
            self.running = None;
        }
        Ok(())
    }

    pub(crate) fn get(&mut self, reference: u32) -> Result<f64, String> {
        match self.variable(reference)?.role {
            Role::Time => Ok(self.start + self.running.as_ref().map_or(0.0, |(motor, _)| motor.time())),
            Role::Output(_) if self.mode == Mode::Instantiated => {
                Err("outputs are available only after the initialisation has begun".to_owned())
            }
            Role::Output(of) => self.started().map(|(_, outputs)| of(outputs)),
            _ => Ok(self.values[reference as usize]),
        }
    }

    fn inputs(&self, from: MotorInputs) -> MotorInputs {
        let mut inputs = from;
        for (variable, value) in self.variables.iter().zip(&self.values) {
            if let Role::Input(set) = variable.role {
                set(&mut inputs, *value);
            }
        }
        inputs
    }

    /// The motion, which starts here if it has not started yet.
    fn started(&mut self) -> Result<&mut (MotorSimulation, MotorOutputs), String> {
        if self.running.is_none() {
            let mut settings = SimulationSettings::default();
            let mut changes = Vec::new();
            for (variable, value) in self.variables.iter().zip(&self.values) {
                match variable.role {
                    Role::Setting(set) => set(&mut settings, *value),
                    Role::Sheet(field) if value.to_bits() != variable.start.to_bits() => {
                        changes.push((field, *value));
                    }
                    _ => {}
                }
            }
            let motor =
                self.motor.with(|sheet| changes.iter().for_each(|(field, value)| field.set(sheet, *value)));
            let motor = motor.map_err(|error| error.to_string())?;
            let begin = || {
                let inputs = self.inputs(MotorInputs::of(&motor));
                let mut simulation = MotorSimulation::new(&motor, inputs, settings)?;
                let outputs = simulation.advance(0.0, &Unobserved)?;
                Ok((simulation, outputs))
            };
            self.running = Some(begin().map_err(|error: bouncing_disk::Error| error.to_string())?);
        }
        self.running.as_mut().ok_or_else(|| "the motor has not started".to_owned())
    }

    /// Advances from a communication point by a step and returns the time reached.
    pub(crate) fn step(&mut self, point: f64, step: f64) -> Result<f64, String> {
        self.to(&[Mode::Step], Mode::Step)?;
        let (start, reached) = (self.start, self.get(0)?);
        let size = SAME_POINT * step.abs() + 4.0 * f64::EPSILON * (point.abs() + reached.abs());
        let follows = (point - reached).abs() <= size && step >= 0.0;
        if !follows {
            return Err(format!(
                "the step of {step:?} s at {point:?} s does not continue the previous one, which ended at {reached:?} s"
            ));
        }
        let running = self.running.as_ref().ok_or("the motor has not started")?;
        let inputs = self.inputs(running.0.inputs());
        let (simulation, outputs) = self.started()?;
        let going = simulation.set_inputs(inputs).and_then(|()| {
            let until = (point + step - start).max(simulation.time());
            simulation.advance(until, &Unobserved)
        });
        *outputs = going.map_err(|error| error.to_string())?;
        self.get(0)
    }
}

#[cfg(test)]
mod tests;
