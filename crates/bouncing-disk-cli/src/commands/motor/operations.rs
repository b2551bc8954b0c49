//! `bouncing-disk motor stall`, `motor best` and `motor traps`: the load that stops the motor, the best of a
//! quantity, and the preloads at which the motor is locked to a short cycle.

use bouncing_disk::Motor;
use bouncing_disk::core::Unobserved;
use bouncing_disk::motor::{
    Best, BestSearch, Estimate, LEAST_TRAP_WIDTH, MotorField, OperatingSettings, QuantityBound, SearchRange,
    StallLoad, SweepQuantity, TrapRange,
};
use serde_json::Value;

use super::settings::{SettingsArgs, SpreadArgs, begin, lock_note, motion, named, needs_friction, state};
use crate::commands::prelude::*;

/// The arguments of a command that finds one operation of a motor.
#[derive(Debug, Clone, Args)]
pub(super) struct OperationArgs {
    #[command(flatten)]
    motor: MotorArgs,
    #[command(flatten)]
    settings: SettingsArgs,
    #[command(flatten)]
    output: OutputArgs,
}

impl OperationArgs {
    /// The motor, if the result can be written; `None` if the template was requested, and is now written.
    fn begin(&self, context: Context) -> Result<Option<Motor>> {
        begin(&self.motor, &self.output, false, None, context)
    }

    /// The inputs of the answer.
    fn job(motor: &Motor, settings: &OperatingSettings) -> Value {
        json!({ "motor": motor, "settings": settings })
    }
}

/// The load torque that stops the motor
#[derive(Debug, Args)]
#[command(after_help = "\
The true stall load is the torque at which the mean speed of the free rotor vanishes, not the paper's estimate from \
the run-up without load (see `bouncing-disk fit`). The blocked torque is the mean torque on a rotor held at rest; a \
free rotor oscillates about its mean speed and stops under another load. With the drive off, friction holds the \
rotor up to the holding torque mu m g a_e. Errors are standard errors at exactly these inputs. The spread is \
computed over motors whose preload and amplitude lie within the tolerance, with a relaunch perturbation within a \
decade. See docs/designing-a-motor.md.

Example:
  bouncing-disk motor stall motor.toml")]
pub(crate) struct StallArgs {
    #[command(flatten)]
    operation: OperationArgs,
    #[command(flatten)]
    spread: SpreadArgs,
}

pub(super) fn stall(args: &StallArgs, context: Context) -> Result<()> {
    let Some(motor) = args.operation.begin(context)? else { return Ok(()) };
    let settings = args.operation.settings.settings();
    needs_friction(&motor, "stall torque")?;
    let stall = motor.stall_load(&settings, &context.watch("motor stall"))?;
    let tolerance = args.spread.of(&motor, context);
    let watch = context.watch("motor stall: spread");
    let spread = tolerance.map(|tolerance| motor.stall_spread(&settings, &tolerance, &watch));
    let spread = spread.transpose()?.flatten();
    let mut list = Quantities::default();
    push_stall(&mut list, "", &stall);
    for other in &stall.others {
        push_stall(&mut list, "coexisting_", other);
    }
    if let Some(spread) = spread {
        list.push("spread", spread.standard_deviation.value, "N m");
        list.push("spread_error", spread.standard_deviation.standard_error, "N m");
        list.push("draws_from", spread.from_to[0], "N m");
        list.push("draws_to", spread.from_to[1], "N m");
        list.push("draws_in_a_trap", format!("{} of {}", spread.trapped, spread.draws + spread.without), "1");
    }
    list.push("holding_torque", motor.largest_torque(), "N m");
    list.push("share_of_largest_torque", stall.share, "1");
    list.push("surely_turns_at", stall.bracket[0], "N m");
    list.push("surely_driven_back_at", stall.bracket[1], "N m");
    list.push("no_load_speed", stall.no_load_speed.value, "rad/s");
    list.push("no_load_speed_error", stall.no_load_speed.standard_error, "rad/s");
    let mut job = OperationArgs::job(&motor, &settings);
    job["tolerance"] = json!(tolerance);
    let note = lock_note(&motor)?;
    let report = Report {
        provenance: provenance("bouncing-disk motor stall", &job)?,
        text: list.to_text() + &note,
        table: list.into_csv(),
        data: vec![("stall_load", stored(&stall)?), ("spread", stored(&spread)?)],
        figure: None,
    };
    report.deliver(&args.operation.output, context)
}

/// The motion of a rotor, the load that stops it in this motion, and its blocked torque.
fn push_stall(list: &mut Quantities, prefix: &str, stall: &StallLoad) {
    list.push(&format!("{prefix}motion"), named(stall.motion), "1");
    list.push(&format!("{prefix}stall_torque"), stall.torque.value, "N m");
    list.push(&format!("{prefix}stall_torque_error"), stall.torque.standard_error, "N m");
    if let Some(blocked) = stall.blocked_torque {
        list.push(&format!("{prefix}blocked_torque"), blocked.value, "N m");
        list.push(&format!("{prefix}blocked_torque_error"), blocked.standard_error, "N m");
    }
}

/// The best speed, torque, power or efficiency over one or two fields of the data sheet
#[derive(Debug, Args)]
#[command(after_help = "\
All other fields, including the load, are taken from the data sheet: for the largest torque at a speed, vary \
load_torque and bound the speed. If motions coexist, quantities refer to the motion that most rotors reach from rest. \
The value is measured at the optimum; its error includes a possible gain nearby. The range \"within 1 %\" is the \
range of a field over which the curve itself stays within 1 % of its best value; it is omitted if the curve is too \
rough. See docs/designing-a-motor.md.

Examples:
  bouncing-disk motor best motor.toml --of speed --over preload_force=2:10 --over phase_lag
  bouncing-disk motor best motor.toml --of torque --over load_torque=0:3e-3 --where 'speed>=5'")]
pub(crate) struct BestArgs {
    #[command(flatten)]
    operation: OperationArgs,
    /// The quantity to maximise: speed, torque, power, efficiency, or another of `motor sweep`
    #[arg(help_heading = OWN, long, value_name = "NAME", default_value = "speed")]
    of: SweepQuantity,
    /// A field of the data sheet and its range, FIELD=LOW:HIGH, at most two; phase_lag without a range covers a
    /// whole turn
    #[arg(help_heading = OWN, long, value_name = "FIELD=RANGE", required_unless_present = "template", value_parser = search_range)]
    over: Vec<SearchRange>,
    /// A bound, QUANTITY >= NUMBER or QUANTITY <= NUMBER; at most two
    #[arg(help_heading = OWN, long = "where", value_name = "BOUND")]
    bounds: Vec<QuantityBound>,
}

fn search_range(text: &str) -> Result<SearchRange, String> {
    let form = || format!("{text:?} is not a range; write FIELD=LOW:HIGH, such as preload_force=2:10");
    let (name, ends) = text.split_once('=').map_or((text, None), |(name, ends)| (name, Some(ends)));
    let field = name.trim().parse::<MotorField>().map_err(|unknown| unknown.to_string())?;
    let [low, high] = match ends {
        None if field == MotorField::PhaseLag => [0.0, std::f64::consts::TAU],
        Some(ends) => interval(ends)?,
        None => return Err(form()),
    };
    Ok(SearchRange { field, low, high })
}

pub(super) fn best(args: &BestArgs, context: Context) -> Result<()> {
    let Some(motor) = args.operation.begin(context)? else { return Ok(()) };
    let settings = args.operation.settings.settings();
    let sought = BestSearch { objective: args.of, ranges: args.over.clone(), bounds: args.bounds.clone() };
    let best = motor.best(&sought, &settings, &context.watch("motor best"))?;
    let mut list = Quantities::default();
    for own in &best.values {
        let (name, unit) = (own.field.name(), own.field.unit());
        list.push(name, own.value.value, unit);
        list.push(&format!("{name}_error"), own.value.standard_error, unit);
        if let Some([low, high]) = own.good_from_to {
            list.push(&format!("{name}_within_1_percent_from"), low, unit);
            list.push(&format!("{name}_within_1_percent_to"), high, unit);
        }
    }
    let mut push = |quantity: SweepQuantity, value: Estimate| {
        list.push(quantity.name(), value.value, quantity.unit());
        list.push(&format!("{}_error", quantity.name()), value.standard_error, quantity.unit());
    };
    push(args.of, best.value);
    for (bound, value) in args.bounds.iter().zip(&best.bounds) {
        push(bound.quantity, *value);
    }
    let operation = &best.row.branches[best.branch];
    list.push("motion", motion(operation), "1");
    list.push("state", state(operation), "1");
    let mut note = String::new();
    for own in &best.values {
        let name = own.field.name();
        if own.is_at_end {
            note += &format!(
                "the best {name} is at an end of its range; a wider range may contain a better one\n"
            );
        }
        if own.good_from_to.is_none() {
            note += &format!("the curve over {name} is too rough for a range within 1 %\n");
        }
    }
    if let Some(share) = trap_beside(&motor, &best)? {
        note += &format!(
            "a preload or amplitude {:.2} % away locks the motor to a short cycle; `motor traps` lists such values\n",
            100.0 * share
        );
    }
    if best.row.branches.len() > 1 {
        note += "other motions coexist there; `motor curve` lists them\n";
    }
    let mut job = OperationArgs::job(&motor, &settings);
    job["sought"] = json!(sought);
    let report = Report {
        provenance: provenance("bouncing-disk motor best", &job)?,
        text: list.to_text() + &note,
        table: list.into_csv(),
        data: vec![("best", stored(&best)?)],
        figure: None,
    };
    report.deliver(&args.operation.output, context)
}

/// The usual tolerance of a motor's preload and amplitude.
const USUALLY_KNOWN: f64 = 0.01;

/// The distance of the nearest trap from an optimum, if it is within the usual tolerance; known only for
/// rigid impacts on a sine.
fn trap_beside(motor: &Motor, best: &Best) -> Result<Option<f64>> {
    let best =
        motor.with(|sheet| best.values.iter().for_each(|own| own.field.set(sheet, own.value.value)))?;
    if best.rigid_sine().is_err() {
        return Ok(None);
    }
    Ok(best.nearest_trap(USUALLY_KNOWN, &Unobserved)?.map(|trap| trap.relative_distance.abs()))
}

/// Ranges of the preload that trap the motor, with the speed inside
#[derive(Debug, Args)]
#[command(after_help = "\
A motor in a trap repeats a short cycle of flights and rest, at a speed that may differ much from the speed outside \
the trap. A motor whose preload is known to 1 % lies in a given trap of relative width w with a probability of up to \
50 w: 2.5 % for a width of 0.0005, the default least width. Speeds are given near both edges and in the middle of the \
range, under the load of the data sheet. See docs/designing-a-motor.md.

Example:
  bouncing-disk motor traps motor.toml --from 4 --to 6")]
pub(crate) struct TrapsArgs {
    #[command(flatten)]
    operation: OperationArgs,
    /// Least preload (N); by default 0.9 times the preload of the motor
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "FORCE")]
    from: Option<f64>,
    /// Largest preload (N); by default 1.1 times the preload of the motor
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "FORCE")]
    to: Option<f64>,
    /// Least width of a range, relative to the preload
    #[arg(help_heading = OWN, long, allow_hyphen_values = true, value_name = "SHARE", default_value_t = LEAST_TRAP_WIDTH)]
    least_width: f64,
}

pub(super) fn traps(args: &TrapsArgs, context: Context) -> Result<()> {
    let Some(motor) = args.operation.begin(context)? else { return Ok(()) };
    let settings = args.operation.settings.settings();
    let (own, mass) = (motor.preload_force(), motor.mass());
    let preload_from_to = [args.from.unwrap_or(0.9 * own), args.to.unwrap_or(1.1 * own)];
    let [from, to] = preload_from_to.map(|force| force / mass);
    let watch = context.watch("motor traps");
    let traps = motor.trap_ranges([from, to], args.least_width, &settings, &watch)?;
    let speed = |trap: &TrapRange, at: usize| trap.operations[at].point().map(|point| point.speed);
    let columns = Columns::<TrapRange>::new()
        .column("preload_from", "N", move |trap| mass * trap.preload_from_to[0])
        .column("preload_to", "N", move |trap| mass * trap.preload_from_to[1])
        .column("relative_width", "%", |trap| 100.0 * trap.relative_width)
        .column("long_flights", "1", |trap| trap.verdict.cycle.map(|cycle| cycle.long_flights as f64))
        .column("platform_periods", "1", |trap| trap.verdict.cycle.map(|cycle| cycle.platform_periods as f64))
        .column("state", "1", |trap| state(trap.operations[1].operation()))
        .column("lower_speed", "rad/s", move |trap| speed(trap, 0).map(|speed| speed.value))
        .column("middle_speed", "rad/s", move |trap| speed(trap, 1).map(|speed| speed.value))
        .column("upper_speed", "rad/s", move |trap| speed(trap, 2).map(|speed| speed.value))
        .column("speed_error", "rad/s", move |trap| speed(trap, 1).map(|speed| speed.standard_error));
    let job = json!({
        "motor": motor,
        "settings": settings,
        "preload_from_to": preload_from_to,
        "least_width": args.least_width,
    });
    let report = Report {
        provenance: provenance("bouncing-disk motor traps", &job)?,
        text: columns.to_text(&traps),
        data: vec![("traps", stored(&traps)?)],
        table: columns.csv_of(traps),
        figure: None,
    };
    report.deliver(&args.operation.output, context)
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    /// A preload known to within 1 % is somewhere in an interval of 2 %.
    #[test]
    fn the_help_of_traps_has_the_probability_of_the_least_width() {
        let mut line = crate::commands::CommandLine::command();
        let traps = line.find_subcommand_mut("motor").and_then(|motor| motor.find_subcommand_mut("traps"));
        let help = traps.unwrap().render_long_help().to_string();
        let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
        let interval = 1.01 - 0.99;
        let said = format!(
            "up to {:.0} w: {:.1} % for a width of {LEAST_TRAP_WIDTH}",
            1.0 / interval,
            100.0 * LEAST_TRAP_WIDTH / interval
        );
        assert!(words.contains(&said), "{said}: {words}");
    }
}
