//! A motor as part of a drive train, advanced step by step under inputs that may change between steps.

use std::f64::consts::TAU;

use bouncing_disk_core::numerics::elementary::{hypot, sin_cos};
use bouncing_disk_core::numerics::random::SplitMix64;
use bouncing_disk_core::run::Watch;
use bouncing_disk_core::{Observer, Phase};

use crate::driven::DrivenStart;
use crate::error::{Error, check, finite, moderate_not_negative};
use crate::motion::energy::EnergyLedger;
use crate::motion::event::{Event, SteeredMotion};
use crate::motion::phase_time::{PhaseSpan, PhaseTime};
use crate::motor::data_sheet::Motor;
use crate::motor::data_sheet::motor_field::MotorField;
use crate::motor::rotor::transient::FLIGHTS_OF_EVENT;
use crate::motor::stator::{Stator, lines, on_shaft, still};
use crate::parameters::load::LoadLaw;
use crate::parameters::scales::Scales;
use crate::parameters::stator::StatorKind;
use crate::stator::{StatorEngine, StatorLedger, StatorSystem};

/// If nothing has happened for this time (rad), a contact is followed from a new origin, so that evaluating
/// the motion at any time costs no more than following it for this time.
const REST: f64 = 64.0 * TAU;

/// The drive and the load of a motor between two changes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MotorInputs {
    /// Torque on the shaft (N m), in addition to a table `[load]`; a positive torque decelerates a positive
    /// rotation.
    pub load_torque: f64,
    /// Amplitude of the drive, in the unit of [`MotorInputs::drive_field`]; not negative.
    pub drive: f64,
    /// Frequency of the drive (Hz), positive.
    pub drive_frequency: f64,
    /// Whether the drive is on.
    pub on: bool,
}

impl MotorInputs {
    /// The inputs according to a data sheet, switched on.
    #[must_use]
    pub fn of(motor: &Motor) -> Self {
        let sheet = motor.parameters();
        Self {
            load_torque: motor.load_torque(),
            drive: Self::drive_field(motor).value(sheet).unwrap_or_default(),
            drive_frequency: sheet.drive_frequency,
            on: true,
        }
    }

    /// The field that drives a motor: the volts or the force of its stator, or the amplitude.
    #[must_use]
    pub fn drive_field(motor: &Motor) -> MotorField {
        let given = |field: &MotorField| field.value(motor.parameters()).is_some();
        [MotorField::StatorVolts, MotorField::StatorForce]
            .into_iter()
            .find(given)
            .unwrap_or(MotorField::Amplitude)
    }
}

/// Settings for the start of a simulation, with a rotor that lies on the stator at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SimulationSettings {
    /// Phase of the stator at the start (rad), finite.
    pub phase: f64,
    /// Size of the relaunch perturbation as in [`TransientSettings`](crate::motor::TransientSettings), in
    /// units of g/omega. Default 1e-3.
    pub relaunch_perturbation: f64,
    /// Seed of the perturbations. Default 1.
    pub seed: u64,
}

impl Default for SimulationSettings {
    fn default() -> Self {
        Self { phase: 0.0, relaunch_perturbation: 1.0e-3, seed: 1 }
    }
}

/// The state of a motor at an instant, and means since the previous instant.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MotorOutputs {
    /// Angle of the rotor (rad) since the start.
    pub angle: f64,
    /// Angular speed of the rotor (rad/s).
    pub speed: f64,
    /// Mean torque of the stator on rotor and shaft (N m) since the last call, or during the previous step if
    /// no time has passed: the load plus the torque that accelerates their inertia.
    pub shaft_torque: f64,
    /// Amplitude of the stator's height (m): that of the sine about the mean position, at the drive
    /// frequency, with the present height and velocity. The mean position is the static one under the preload
    /// and friction; in a flight of more than a period it is that of the free stator. The amplitude is
    /// constant in a steady motion without a rotor or under a rotor that lies on the stator; a bouncing rotor
    /// adds the harmonics of its impacts. With the drive off, the resonance of the mode replaces the drive
    /// frequency. For a prescribed motion, the prescribed amplitude.
    pub amplitude: f64,
    /// Amplitude of the current (A), with each mode represented by a sine as for [`Self::amplitude`]; `None`
    /// without a capacitance.
    pub current: Option<f64>,
    /// Mean power (W) since the last call that the drive supplies to the modes and to a prescribed motion.
    /// Without a prescribed motion, this is the real part of voltage times current.
    pub power: f64,
    /// Number of impacts since the start.
    pub impacts: u64,
}

/// Totals since the start (SI).
#[derive(Debug, Clone, Copy, Default)]
struct Totals {
    /// Time (s).
    time: f64,
    /// Work of the drive (J).
    work: f64,
    /// Angular impulse of the load (N m s).
    load: f64,
    speed: f64,
    impacts: u64,
}

/// The motion just after an event. The next event is found in advance, so that it does not depend on the
/// requested times.
#[derive(Debug, Clone)]
struct Ahead {
    engine: StatorEngine,
    generator: SplitMix64,
    totals: Totals,
}

/// A motor that is advanced step by step. For constant inputs the motion does not depend on the steps, to the
/// last bit. A clone stores the state.
///
/// A change of the inputs takes effect at once. The motion of modes is continuous. A prescribed motion jumps,
/// and the rotor keeps its distance from the stator and its relative speed. A change of the frequency keeps
/// the phase that the stator's motion would have without a rotor, so the phase of the voltage jumps. A twist
/// that the sheet prescribes has its full amplitude whenever the drive is on, whatever the amplitude of the
/// drive.
///
/// ```
/// use bouncing_disk::Motor;
/// use bouncing_disk::core::Unobserved;
/// use bouncing_disk::motor::{MotorInputs, MotorSimulation, SimulationSettings};
///
/// let motor = Motor::paper_70_khz();
/// let running = MotorInputs::of(&motor);
/// let mut simulation = MotorSimulation::new(&motor, running, SimulationSettings::default())?;
/// let early = simulation.advance(0.1, &Unobserved)?;
/// assert!(early.speed > 0.0);
/// simulation.set_inputs(MotorInputs { on: false, load_torque: 1e-5, ..running })?;
/// assert!(simulation.advance(0.2, &Unobserved)?.speed < early.speed);
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct MotorSimulation {
    sheet: Motor,
    inputs: MotorInputs,
    /// The sheet under these inputs, its units, and the inertia of rotor and shaft (kg m^2).
    motor: Motor,
    unit: Scales,
    inertia: f64,
    perturbation: f64,
    /// The time at which these inputs began (s), and the corresponding instant of the engine.
    began: (f64, PhaseTime),
    /// Just after the last event.
    now: Ahead,
    next: Option<Ahead>,
    /// The totals at the last call.
    last: Totals,
    /// Torque and power over the last step of non-zero duration.
    means: [f64; 2],
}

impl MotorSimulation {
    /// A motor whose rotor lies at rest at time 0. Its stator has long moved under these inputs without the
    /// rotor; with the drive off, the stator is at rest under the rotor.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for illegal inputs and settings; [`Error::LoadInTime`] for a table `[load]` that
    /// depends on time (change the inputs instead); [`Error::BothGiven`] for a contact with hysteresis.
    pub fn new(motor: &Motor, inputs: MotorInputs, settings: SimulationSettings) -> Result<Self, Error> {
        let perturbation = moderate_not_negative("relaunch_perturbation", settings.relaunch_perturbation)?;
        motor.parameters().drive.sine()?;
        if motor.load().is_some_and(|load| load.next_change_after(f64::NEG_INFINITY).is_some()) {
            return Err(Error::LoadInTime);
        }
        let sheet = motor.with(|sheet| {
            sheet.load_torque = 0.0;
            let Some((table, own)) = sheet.stator.as_mut().zip(motor.stator()) else { return };
            // Otherwise these would change with the inputs.
            table.resonance.get_or_insert(sheet.drive_frequency);
            match table.kind {
                StatorKind::Axial => {}
                StatorKind::AxialAndTorsional => {
                    table.torsional_resonance.get_or_insert(sheet.drive_frequency);
                }
                StatorKind::AxialTwist => {
                    table.twist_per_height = Some(own.modes()[0].angle);
                    (sheet.peak_angular_speed, sheet.twist_amplitude, sheet.phase_lag) = (None, None, 0.0);
                }
            }
        })?;
        let built = built(&sheet, &inputs)?;
        let start = DrivenStart::Contact { phase: Phase::new(settings.phase)?, angular_speed: 0.0 };
        let mut engine = StatorEngine::new(built.system, start)?;
        if !inputs.on {
            engine.calm();
        }
        let began = (0.0, engine.time());
        let generator = SplitMix64::new(settings.seed);
        let now = Ahead { engine, generator, totals: Totals::default() };
        let (unit, inertia) = (built.unit, built.inertia);
        let (last, means) = (Totals::default(), [0.0; 2]);
        Ok(Self {
            sheet,
            inputs,
            motor: built.motor,
            unit,
            inertia,
            perturbation,
            began,
            now,
            next: None,
            last,
            means,
        })
    }

    /// The present inputs.
    #[must_use]
    pub const fn inputs(&self) -> MotorInputs {
        self.inputs
    }

    /// The time of the last call (s).
    #[must_use]
    pub const fn time(&self) -> f64 {
        self.last.time
    }

    /// Changes the inputs from now on; equal inputs change nothing. After an error the inputs are unchanged.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for illegal inputs, and the errors of [`Motor::with`].
    pub fn set_inputs(&mut self, inputs: MotorInputs) -> Result<(), Error> {
        if inputs == self.inputs {
            return Ok(());
        }
        let built = built(&self.sheet, &inputs)?;
        self.now = self.at(self.last.time);
        let faster = self.unit.time / built.unit.time;
        self.now.engine.switch_units(0.0, built.system, faster);
        (self.motor, self.unit, self.inertia) = (built.motor, built.unit, built.inertia);
        (self.inputs, self.next) = (inputs, None);
        self.began = (self.last.time, self.now.engine.time());
        Ok(())
    }

    /// Advances to a time (s) after the start, which must not be before that of the last call.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a time before that of the last call; the errors of
    /// [`StatorEngine::advance`]. After an error the motor is in the state after the last call.
    pub fn advance(&mut self, time: f64, observer: &dyn Observer) -> Result<MotorOutputs, Error> {
        let watch = Watch::begin(observer, 0, 1)?;
        let mut work = watch.work();
        check(finite("time", time)? >= self.last.time, "time", time, "at or after the last one (s)")?;
        let until = (time - self.began.0) / self.unit.time;
        let before = self.now.clone();
        loop {
            if self.next.is_none() {
                let found = work.spend(FLIGHTS_OF_EVENT).map_err(Error::from).and_then(|()| self.found());
                match found {
                    Ok(next) => self.next = next,
                    Err(error) => {
                        self.now = before;
                        return Err(error);
                    }
                }
            }
            let comes = |next: &mut Ahead| next.engine.time().since(&self.began.1).radians() <= until;
            match self.next.take_if(comes) {
                Some(next) => self.now = next,
                None => break,
            }
        }
        watch.end();
        let at = self.at(time);
        let outputs = self.outputs(&at);
        (self.last, self.means) = (at.totals, [outputs.shaft_torque, outputs.power]);
        Ok(outputs)
    }

    /// The motion after the next event, or after a piece of a contact; `None` for a rotor that lies for ever.
    fn found(&mut self) -> Result<Option<Ahead>, Error> {
        let mut next = self.now.clone();
        let limit = if next.engine.launches() { f64::INFINITY } else { REST };
        let record = match next.engine.advance_within(limit)? {
            Some(record) => record,
            None if next.engine.skip_periods(0).is_some() => {
                // It is now known to lie for ever.
                self.now = next;
                return Ok(None);
            }
            None => next.engine.pause(REST),
        };
        self.add(&mut next.totals, &record.ledger, &record.stator, 1.0);
        if matches!(record.event, Event::Impact { .. } | Event::Recontact) {
            next.totals.impacts += 1;
        }
        if record.event.is_relaunch() {
            next.engine.perturb_launch(self.perturbation * next.generator.unit());
        }
        Ok(Some(next))
    }

    /// Adds these totals the given number of times.
    fn add(&self, totals: &mut Totals, disk: &EnergyLedger, stator: &StatorLedger, times: f64) {
        let (mass, unit) = (times * self.motor.mass(), &self.unit);
        let axial = disk.normal_work + (stator.drive_work - stator.disk_work);
        totals.work += mass * (axial * unit.axial_energy + disk.friction_work * unit.rotary_energy);
        totals.load += times * self.inertia * unit.angular_speed * stator.load_impulse;
    }

    /// The motion at a time before the next event.
    fn at(&self, time: f64) -> Ahead {
        let mut at = self.now.clone();
        let until = self.began.1.after(PhaseSpan::from_radians((time - self.began.0) / self.unit.time));
        let periods = until.since(&at.engine.time()).periods;
        if self.next.is_none()
            && let Some(one) = at.engine.skip_periods(periods)
        {
            self.add(&mut at.totals, &one.ledger, &one.stator, periods as f64);
        }
        let record = at.engine.pause(until.since(&at.engine.time()).radians());
        self.add(&mut at.totals, &record.ledger, &record.stator, 1.0);
        at.totals.time = time;
        at.totals.speed = record.after.disk.angular_speed * self.unit.angular_speed;
        at
    }

    fn outputs(&self, at: &Ahead) -> MotorOutputs {
        let (unit, totals, state) = (&self.unit, &at.totals, at.engine.state());
        let passed = totals.time - self.last.time;
        let mean = |change: f64, before: f64| if passed > 0.0 { change / passed } else { before };
        let gained = self.inertia * (totals.speed - self.last.speed);
        let prescribed = if self.inputs.on { self.motor.system().platform().amplitude() } else { 0.0 };
        MotorOutputs {
            angle: state.disk.angle * unit.angle,
            speed: totals.speed,
            shaft_torque: mean(gained + (totals.load - self.last.load), self.means[0]),
            amplitude: at.engine.amplitude_after(0.0).map_or(prescribed, |amplitude| amplitude * unit.length),
            current: self.current(&at.engine),
            power: mean(totals.work - self.last.work, self.means[1]),
            impacts: totals.impacts,
        }
    }

    /// The amplitude of C_0 dV/dt plus each mode's force per volt times its speed; each term is a sine, given
    /// by its values now and a quarter of a period later.
    fn current(&self, engine: &StatorEngine) -> Option<f64> {
        let stator = self.motor.stator()?;
        let circuit = stator.circuit()?;
        let capacitance = circuit.capacitance?;
        let volts = if self.inputs.on { capacitance * circuit.volts } else { 0.0 };
        let (sin, cos) = sin_cos(engine.time().phase.angle() + circuit.phase);
        let (mut now, mut later) = (volts * cos, -volts * sin);
        for (vibration, (mode, per_volt)) in engine
            .vibration_after(0.0)
            .into_iter()
            .zip(stator.modes().iter().zip([circuit.force_per_volt, circuit.torque_per_volt]))
        {
            let unit = if mode.height == 0.0 { self.unit.angle } else { self.unit.length };
            now += per_volt * unit * vibration.speed;
            later -= per_volt * unit * vibration.frequency * vibration.distance;
        }
        Some(hypot(now, later) / self.unit.time)
    }
}

/// A motor under its inputs.
struct Built {
    motor: Motor,
    system: StatorSystem,
    unit: Scales,
    inertia: f64,
}

fn built(sheet: &Motor, inputs: &MotorInputs) -> Result<Built, Error> {
    let load_torque = finite("load_torque", inputs.load_torque)?;
    let field = MotorInputs::drive_field(sheet);
    let motor = sheet.with(|sheet| {
        field.set(sheet, inputs.drive);
        sheet.drive_frequency = inputs.drive_frequency;
    })?;
    let shafted = on_shaft(motor.system(), motor.load(), motor.mass())?;
    let system = match motor.stator_motion() {
        Stator::Yielding(own) => (**own).clone(),
        Stator::Sine | Stator::Driven(_) => StatorSystem::of_system(&shafted, motor.mass())?,
    };
    let law = motor.load().map_or_else(|| LoadLaw::constant(0.0), Ok)?;
    let mut lines = lines(&law, 0.0, &shafted, motor.mass());
    let torque = load_torque / (motor.preload_force() * shafted.disk().contact_radius());
    lines.iter_mut().for_each(|line| line.torque += torque);
    let system = if inputs.on { system } else { still(&system)? };
    let inertia = motor.inertia() + law.inertia();
    Ok(Built { motor, system: system.with_load(&lines)?, unit: shafted.scales(), inertia })
}

#[cfg(test)]
mod tests;
