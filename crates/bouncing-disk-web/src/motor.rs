//! Motors by their data sheets.

use bouncing_disk::core::Unobserved;
use bouncing_disk::estimate::{FitError, FitSettings, RiseForm, Spread, TransientFit};
use bouncing_disk::motor::{
    Estimate, MotorParameters, OperatingSettings, TransientMember, TransientSettings,
};
use bouncing_disk::parameters::{ContactLaw, ContactStatement};
use bouncing_disk::{Error, Motor, System};
use serde_json::{Value, json};

use crate::reply::{Refusal, Reply};
use crate::request::{LoadsRequest, SystemParameters, TransientRequest};

/// Impacts that the search of a stall load may take: a second or two for most motors.
const FEW_IMPACTS: u64 = 5_000_000;

/// Largest number of impacts that a request may allow: those of the library's default.
const MOST_IMPACTS: u64 = 20_000_000;

/// The distance up to which a trap is reported, as a relative change of the preload or the amplitude.
const TRAP_RANGE: f64 = 0.02;

/// The report of a data sheet before anything turns, with its system. The trap is the nearest preload at which
/// the motor may be caught in a motion of few impacts; none is searched for with compliant contacts. For a compliant
/// stator, regime and forcing refer to its motion without a rotor.
pub(crate) fn report(sheet: MotorParameters) -> Result<Reply, Refusal> {
    let motor = motor_of(&sheet)?;
    let unloaded = match motor.stator() {
        Some(_) => MotorParameters::of_system(&motor.system().with_stator(None)?, motor.mass()).build()?,
        None => motor.clone(),
    };
    let report = unloaded.report(&Unobserved)?;
    let own = motor.stator_report();
    let warnings = if own.is_some() { motor.warnings() } else { report.warnings.clone() };
    let trap = if motor.rigid_sine().is_ok() { motor.nearest_trap(TRAP_RANGE, &Unobserved)? } else { None };
    Reply::short(&json!({
        "axial_forcing": report.axial_forcing,
        "angular_forcing": report.angular_forcing,
        "regime": report.regime.to_string(),
        "contact": ContactStatement::rows(report.contact.as_ref()),
        "largest_torque": report.largest_torque,
        "warnings": warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "text": own.map_or_else(|| report.to_string(), |own| own.to_string()),
        "yields": motor.stator().is_some(),
        "system": SystemParameters::from(motor.system()),
        "trap": trap,
    }))
}

/// The motor of a sheet. The page has no drives and constant loads.
fn motor_of(sheet: &MotorParameters) -> Result<Motor, Refusal> {
    let beyond = [("[drive]", !sheet.drive.is_sine()), ("[load]", sheet.load.is_some())];
    if let Some((table, _)) = beyond.into_iter().find(|(_, is_given)| *is_given) {
        return Err(Refusal::new("text", format!("a table {table} is for the command line and Python")));
    }
    Ok(sheet.build()?)
}

/// The form that fits a run-up best, an exponential or a ramp: its time constant, or the time at which the
/// straight rise ends (s), and the root mean square of its residuals (rad/s); or why there is none. Numbers:
/// rows of the time (s), the mean angular speed over the members and its standard error (rad/s).
pub(crate) fn transient(request: &TransientRequest) -> Result<Reply, Refusal> {
    let TransientRequest { ref sheet, members, rise_times, points: intervals, seed } = *request;
    let motor = motor_of(sheet)?;
    let system = *motor.system();
    let duration = rise_times * system.rise_time();
    let settings = TransientSettings { duration, intervals, seed, ..TransientSettings::default() };
    let runs = TransientMember::of_ensemble(&system, &settings, members)?;
    let curves = motor.transients(&runs, &Unobserved)?;
    let times = curves.first().map_or(&[][..], |curve| &curve.times);
    let mut numbers = Vec::new();
    for (place, time) in times.iter().enumerate() {
        let speeds: Vec<f64> = curves.iter().map(|curve| curve.speeds[place]).collect();
        let speed = Spread::of(&speeds)?;
        numbers.extend([*time, speed.mean, speed.standard_error]);
    }
    let (rise, refusal) = match TransientFit::new(&curves, &FitSettings::default()) {
        Ok(fit) => (Some(rise_of(&fit)), None),
        Err(FitError::Refused(reason)) => (None, Some(reason)),
        Err(FitError::Model(error)) => return Err(error.into()),
        Err(_) => (None, None),
    };
    Reply::new(&json!({ "points": times.len(), "rise": rise, "refusal": refusal }), numbers, Vec::new())
}

fn rise_of(fit: &TransientFit) -> Value {
    let ramp = fit.ramp.as_ref().filter(|_| fit.form == RiseForm::Ramp);
    let rise = ramp.unwrap_or(&fit.exponential);
    json!({ "form": fit.form, "constant": rise.constant, "residual": rise.residual })
}

/// The library's operations under each load.
pub(crate) fn loads(request: &LoadsRequest) -> Result<Reply, Refusal> {
    let LoadsRequest { sheet, load_torques, relative_error, most_impacts, seed } = request;
    let settings = settings(*relative_error, *most_impacts, *seed)?;
    Reply::short(&motor_of(sheet)?.torque_speed_curve(load_torques, &settings, &Unobserved)?)
}

fn settings(relative_error: f64, most_impacts: u64, seed: u64) -> Result<OperatingSettings, Refusal> {
    if most_impacts > MOST_IMPACTS {
        return Err(Refusal::out_of_range("most_impacts", most_impacts as f64, "[1, 20000000]"));
    }
    Ok(OperatingSettings { relative_error, seed, most_impacts, ..OperatingSettings::default() })
}

/// A motor that does not turn without a load has no stall load, which is an answer and no failure.
pub(crate) fn stall(sheet: MotorParameters, relative_error: f64, seed: u64) -> Result<Reply, Refusal> {
    let motor = motor_of(&sheet)?;
    let (torque, speed) = match motor.stall_load(&settings(relative_error, FEW_IMPACTS, seed)?, &Unobserved) {
        Ok(stall) => (Some(stall.torque), stall.no_load_speed),
        Err(Error::DoesNotTurn { speed, standard_error }) => {
            (None, Estimate { value: speed, standard_error })
        }
        Err(error) => return Err(error.into()),
    };
    Reply::short(&json!({
        "torque": torque.map(|torque| torque.value),
        "torque_error": torque.map(|torque| torque.standard_error),
        "no_load_speed": speed.value,
        "no_load_speed_error": speed.standard_error,
    }))
}

/// The page has only one law of compliant contacts, and only constant loads.
pub(crate) fn read(text: &str) -> Result<Reply, Refusal> {
    let motor = Motor::from_json(text).map_err(|error| Refusal::new("text", error.to_string()))?;
    let motor = motor_of(motor.parameters())?;
    if let Some((ContactLaw::Hysteresis, _)) = motor.system().soft_contact() {
        let message = "contact.law = \"hysteresis\" is for the command line and Python: contacts on the page have a damper";
        return Err(Refusal::new("text", message.to_owned()));
    }
    sheet_of(&motor)
}

/// The sheet of a system and a mass (kg), with the load as a torque.
pub(crate) fn of_system(system: &System, mass: f64) -> Result<Reply, Refusal> {
    sheet_of(&MotorParameters::of_system(system, mass).build()?)
}

/// The text is what the command line and Python read.
fn sheet_of(motor: &Motor) -> Result<Reply, Refusal> {
    let system = SystemParameters::from(motor.system());
    let (sheet, text) = (motor.parameters(), motor.to_json());
    Reply::short(&json!({ "sheet": sheet, "text": text, "system": system, "mass": motor.mass() }))
}
