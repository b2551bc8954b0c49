//! Motors by their data sheets.

use bouncing_disk::{
    Estimate, Motor, MotorParameters, OperatingPoint, OperatingSettings, Operation, Shortfall, Spread,
    System, TransientSettings, ensemble,
};
use serde::Serialize;

use crate::refusal::Refusal;
use crate::reply::Reply;
use crate::request::SystemParameters;

/// Most impacts of one answer: a second or two.
const MOST_IMPACTS: u64 = 5_000_000;

/// How far away a trap is told, as a relative change of the preload or the amplitude.
const TRAP_RANGE: f64 = 0.02;

#[derive(Debug, Serialize)]
struct ReportJson {
    axial_forcing: f64,
    angular_forcing: Option<f64>,
    regime: String,
    largest_torque: f64,
    warnings: Vec<String>,
    text: String,
    system: SystemParameters,
    mass: f64,
    trap: Option<TrapJson>,
}

#[derive(Debug, Serialize)]
struct TrapJson {
    preload_acceleration: f64,
    caught: bool,
    text: String,
}

pub(crate) fn report(sheet: MotorParameters) -> Result<Reply, Refusal> {
    let motor = sheet.build()?;
    let report = motor.report()?;
    let trap = motor.nearest_trap(TRAP_RANGE)?.map(|trap| {
        let caught = trap.relative_distance == 0.0;
        let [from, to] = trap.forcing_from_to;
        let where_it_is = if caught {
            "The motor is in a low-period trap".to_owned()
        } else {
            format!("A low-period trap is {:.3} % away", 100.0 * trap.relative_distance)
        };
        let text = format!("{where_it_is}: \u{393} from {from:.5} to {to:.5}");
        TrapJson { preload_acceleration: trap.preload_acceleration, caught, text }
    });
    Reply::short(&ReportJson {
        axial_forcing: report.axial_forcing,
        angular_forcing: report.angular_forcing,
        regime: report.regime.to_string(),
        largest_torque: report.largest_torque,
        warnings: report.warnings.iter().map(ToString::to_string).collect(),
        text: report.to_string(),
        system: motor.system().into(),
        mass: motor.mass(),
        trap,
    })
}

#[derive(Debug, Serialize)]
struct TransientJson {
    points: usize,
    steady_speed: Option<f64>,
    steady_speed_error: Option<f64>,
    time_constant: Option<f64>,
}

pub(crate) fn transient(
    sheet: MotorParameters,
    members: usize,
    rise_times: f64,
    points: usize,
    seed: u64,
) -> Result<Reply, Refusal> {
    let system = *sheet.build()?.system();
    let duration = rise_times * system.rise_time();
    let settings = TransientSettings { duration, intervals: points, seed, ..TransientSettings::default() };
    let runs = ensemble(&system, &settings, members)?;
    let times = runs.curves.first().map_or(&[][..], |curve| &curve.times);
    let mut numbers = Vec::with_capacity(3 * times.len());
    for (place, time) in times.iter().enumerate() {
        let speeds: Vec<f64> = runs.curves.iter().map(|curve| curve.speeds[place]).collect();
        let speed = Spread::of(&speeds)?;
        numbers.extend([*time, speed.mean, speed.standard_error]);
    }
    let finite = |number: f64| Some(number).filter(|number| number.is_finite());
    let json = TransientJson {
        points: times.len(),
        steady_speed: finite(runs.steady_speed.mean),
        steady_speed_error: finite(runs.steady_speed.standard_error),
        time_constant: finite(runs.time_constant.mean),
    };
    Reply::new(&json, numbers, Vec::new())
}

#[derive(Debug, Serialize)]
struct OperationsJson {
    shortfalls: Vec<Option<String>>,
}

pub(crate) fn loads(
    sheet: MotorParameters,
    load_torques: &[f64],
    relative_error: f64,
    seed: u64,
) -> Result<Reply, Refusal> {
    let operations = sheet.build()?.torque_speed_curve(load_torques, &settings(relative_error, seed))?;
    let mut numbers = Vec::with_capacity(10 * operations.len());
    let mut shortfalls = Vec::with_capacity(operations.len());
    for operation in &operations {
        let (row, shortfall) = told(operation);
        numbers.extend(row);
        shortfalls.push(shortfall);
    }
    Reply::new(&OperationsJson { shortfalls }, numbers, Vec::new())
}

fn settings(relative_error: f64, seed: u64) -> OperatingSettings {
    OperatingSettings { relative_error, seed, most_impacts: MOST_IMPACTS, ..OperatingSettings::default() }
}

/// A row of a curve, and what it lacks.
fn told(operation: &Operation) -> ([f64; 10], Option<String>) {
    match operation {
        Operation::Steady(point) => (row(point, 0.0), None),
        Operation::Unsettled(point, shortfall) => (row(point, 1.0), Some(lacking(shortfall))),
        Operation::Runaway { load_torque, .. } => {
            let mut numbers = [f64::NAN; 10];
            (numbers[0], numbers[9]) = (*load_torque, 2.0);
            (numbers, Some("the load drives the rotor".to_owned()))
        }
        _ => ([f64::NAN; 10], Some("unknown".to_owned())),
    }
}

fn row(point: &OperatingPoint, status: f64) -> [f64; 10] {
    let none = Estimate { value: f64::NAN, standard_error: f64::NAN };
    let efficiency = point.efficiency.unwrap_or(none);
    let OperatingPoint { load_torque, speed, mechanical_power, input_power, .. } = point;
    [
        *load_torque,
        speed.value,
        speed.standard_error,
        mechanical_power.value,
        mechanical_power.standard_error,
        input_power.value,
        input_power.standard_error,
        efficiency.value,
        efficiency.standard_error,
        status,
    ]
}

fn lacking(shortfall: &Shortfall) -> String {
    match shortfall {
        Shortfall::Error { standard_error, wanted } => {
            format!(
                "the error of the speed is {standard_error:.3e} rad/s, and {wanted:.3e} rad/s was asked for"
            )
        }
        Shortfall::Drift { drift, standard_error } => {
            format!("the speed still drifts, by {drift:.3e} +- {standard_error:.3e} rad/s")
        }
        _ => "unknown".to_owned(),
    }
}

#[derive(Debug, Serialize)]
struct StallJson {
    torque: f64,
    torque_error: f64,
    bracket: [f64; 2],
    no_load_speed: f64,
    no_load_speed_error: f64,
}

pub(crate) fn stall(sheet: MotorParameters, relative_error: f64, seed: u64) -> Result<Reply, Refusal> {
    let stall = sheet.build()?.stall_load(&settings(relative_error, seed))?;
    Reply::short(&StallJson {
        torque: stall.torque.value,
        torque_error: stall.torque.standard_error,
        bracket: stall.bracket,
        no_load_speed: stall.no_load_speed.value,
        no_load_speed_error: stall.no_load_speed.standard_error,
    })
}

#[derive(Debug, Serialize)]
struct TextJson {
    text: String,
}

pub(crate) fn write(sheet: MotorParameters) -> Result<Reply, Refusal> {
    Reply::short(&TextJson { text: sheet.build()?.to_json() })
}

#[derive(Debug, Serialize)]
struct SheetJson {
    sheet: MotorParameters,
    system: SystemParameters,
    mass: f64,
}

impl SheetJson {
    fn of(motor: &Motor) -> Self {
        Self { sheet: motor.parameters(), system: motor.system().into(), mass: motor.mass() }
    }
}

pub(crate) fn read(text: &str) -> Result<Reply, Refusal> {
    Reply::short(&SheetJson::of(&Motor::from_json(text)?))
}

pub(crate) fn of_system(system: &System, mass: f64) -> Result<Reply, Refusal> {
    Reply::short(&SheetJson::of(&MotorParameters::of_system(system, mass).build()?))
}
