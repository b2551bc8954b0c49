//! Settings and motor of a steady operation.

use crate::commands::prelude::*;
use bouncing_disk::Motor;
use bouncing_disk::core::Unobserved;
use bouncing_disk::core::numerics::statistics::NORMAL_975;
use bouncing_disk::motor::{
    AxialMotion, Estimate, InputTolerance, Life, OperatingRow, OperatingSettings, Operation, Shortfall,
    SweepQuantity,
};
use bouncing_disk_plot::rounded;

/// The settings of the library, with its defaults.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Accuracy")]
pub(super) struct SettingsArgs {
    /// Requested standard error of the mean speed, relative to this speed or, if it is larger, the no-load speed
    #[arg(long, allow_hyphen_values = true, value_name = "SHARE", default_value_t = OperatingSettings::default().relative_error)]
    relative_error: f64,
    /// Number of vertical motions to average over
    #[arg(long, allow_negative_numbers = true, value_name = "N", default_value_t = OperatingSettings::default().members)]
    members: usize,
    /// Largest number of impacts of all members together
    #[arg(long, allow_negative_numbers = true, value_name = "N", default_value_t = OperatingSettings::default().most_impacts)]
    most_impacts: u64,
    /// Size of the relaunch perturbation, in units of g/omega
    #[arg(long, alias = "perturbation", allow_hyphen_values = true, value_name = "SIZE", default_value_t = OperatingSettings::default().relaunch_perturbation)]
    relaunch_perturbation: f64,
    /// Seed of the perturbations
    #[arg(long, allow_negative_numbers = true, value_name = "SEED", default_value_t = OperatingSettings::default().seed)]
    seed: u64,
}

impl SettingsArgs {
    pub(super) fn settings(&self) -> OperatingSettings {
        OperatingSettings {
            relative_error: self.relative_error,
            members: self.members,
            most_impacts: self.most_impacts,
            relaunch_perturbation: self.relaunch_perturbation,
            seed: self.seed,
        }
    }
}

/// The tolerance of the inputs, for the spread.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Spread")]
pub(super) struct SpreadArgs {
    /// Relative tolerance of preload and amplitude over which the spread is computed
    #[arg(long, allow_hyphen_values = true, value_name = "SHARE", default_value_t = InputTolerance::default().preload)]
    tolerance: f64,
    /// Motors sampled within the tolerance
    #[arg(long, allow_negative_numbers = true, value_name = "N", default_value_t = InputTolerance::default().draws)]
    draws: usize,
    /// Omits the spread, which takes up to ten times as long as the rest
    #[arg(long)]
    no_spread: bool,
}

impl SpreadArgs {
    /// The tolerance of the spread, which, like the regime, exists only for rigid impacts on the sine.
    pub(super) fn of(&self, motor: &Motor, context: Context) -> Option<InputTolerance> {
        let tolerance = self.tolerance();
        if motor.rigid_sine().is_err() && tolerance.is_some() {
            context.note("no spread over the tolerances: it needs a prescribed sine and rigid impacts");
        }
        tolerance.filter(|_| motor.rigid_sine().is_ok())
    }

    fn tolerance(&self) -> Option<InputTolerance> {
        let Self { tolerance, draws, no_spread } = *self;
        let own =
            InputTolerance { preload: tolerance, amplitude: tolerance, draws, ..InputTolerance::default() };
        (!no_spread).then_some(own)
    }
}

/// The motor, with warnings of legal but unlikely values in its data sheet.
pub(super) fn begin(
    motor: &MotorArgs,
    output: &OutputArgs,
    picture: bool,
    grid: Option<&GridArgs>,
    context: Context,
) -> Result<Option<Motor>> {
    let given = motor.begin(output, picture, grid, context)?;
    let warnings = given.iter().flat_map(Motor::warnings);
    warnings.for_each(|warning| context.note(&format!("warning: {warning}")));
    Ok(given)
}

/// Rejects a motor without friction: only rounding would turn it.
pub(super) fn needs_friction(motor: &Motor, sought: &str) -> Result<()> {
    let told = || format!("without friction the largest torque is 0, so there is no {sought}");
    (motor.largest_torque() != 0.0).then_some(()).ok_or_else(|| Failure::Usage(told()))
}

/// A line on a locked motor, whose errors are tiny and hold at exactly its inputs.
pub(super) fn lock_note(motor: &Motor) -> Result<String> {
    if motor.rigid_sine().is_err() {
        return Ok(String::new());
    }
    let regime = motor.report(&Unobserved)?.regime;
    let note = "the errors hold at exactly these inputs; `motor traps` lists such preloads";
    Ok(if regime.is_locked() { format!("\nlocked ({regime}): {note}") } else { String::new() })
}

/// The state of a motor.
pub(super) const fn state(operation: &Operation) -> &'static str {
    match operation {
        Operation::Steady(_) => "steady",
        Operation::Unsettled(_, Shortfall::Start { .. }) => "depends-on-start",
        Operation::Unsettled(..) => "unsettled",
        Operation::Runaway { .. } => "runaway",
        _ => "unknown",
    }
}

/// The vertical motion of a rotor.
pub(super) fn motion(operation: &Operation) -> Option<String> {
    operation.point().map(|point| named(point.motion))
}

/// The name of a vertical motion.
pub(super) fn named(motion: AxialMotion) -> String {
    match motion {
        AxialMotion::Periodic { periods, impacts } => format!("{impacts} in {periods}"),
        AxialMotion::Contact => "contact".to_owned(),
        _ => "irregular".to_owned(),
    }
}

/// The life of an irregular motion as text: its mean life, or a lower bound.
pub(super) fn shown_life(operation: &Operation) -> Option<String> {
    match operation.point()?.motion {
        AxialMotion::Irregular { life: Life::Mean(life) } => Some(rounded(life.value, 3)),
        AxialMotion::Irregular { life: Life::NoneEndedIn(time) } => Some(format!("> {}", rounded(time, 3))),
        _ => None,
    }
}

/// The mean life (s) of an irregular motion, if some ended.
pub(super) fn life(operation: &Operation) -> Option<f64> {
    match operation.point()?.motion {
        AxialMotion::Irregular { life: Life::Mean(life) } => Some(life.value),
        _ => None,
    }
}

/// Columns with deviation, range and time constant of the speed, the blocked torque, and the amplitude and
/// powers of a compliant stator, if one of the operations has them.
pub(super) fn with_details<R: 'static>(
    columns: Columns<R>,
    rows: &[OperatingRow],
    of: fn(&R) -> &Operation,
) -> Columns<R> {
    let is_known = |quantity: &SweepQuantity| {
        let mut operations = rows.iter().flat_map(|row| &row.branches);
        operations.any(|operation| quantity.of(operation).is_some())
    };
    let details = [
        SweepQuantity::SpeedDeviation,
        SweepQuantity::SpeedLow,
        SweepQuantity::SpeedHigh,
        SweepQuantity::TimeConstant,
        SweepQuantity::UnstableSpeed,
        SweepQuantity::BlockedTorque,
    ];
    let own = details.into_iter().filter(is_known);
    let of_stator = SweepQuantity::of_table(rows).iter().skip(SweepQuantity::ALL.len()).copied();
    own.chain(of_stator).fold(columns, |columns, quantity| {
        let (unit, scale) = shown_unit(quantity);
        columns.column(quantity.name(), unit, move |row| {
            quantity.of(of(row)).map(|estimate| scale * estimate.value)
        })
    })
}

/// The displayed unit of a quantity, and its factor: efficiencies in percent.
pub(super) fn shown_unit(quantity: SweepQuantity) -> (&'static str, f64) {
    match quantity.unit() {
        "1" => ("%", 100.0),
        unit => (unit, 1.0),
    }
}

/// A value, and half the width of its 95 % interval, for a picture.
pub(super) fn interval(estimate: Estimate) -> (f64, f64) {
    (estimate.value, NORMAL_975 * estimate.standard_error)
}
