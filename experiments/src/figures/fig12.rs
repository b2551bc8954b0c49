//! Fig. 12: transient speed curves of long-period and low-period chattering.

mod compute;
mod data;
mod draw;

use bouncing_disk::core::ChatterPolicy;

pub(crate) use self::data::Fig12Data;
use self::data::{Lines, LowPeriod};
use super::shared::alike::AlikeMotor;
use super::shared::motor::{DEFINITIONS, LOW_PERIOD_FLIGHTS, RobustCycle, by_definition_words};
use crate::claims::{Cases, Claim, Verdict};
use crate::experiment::{ExperimentError, Paper, named};

/// Fig. 12.
pub(crate) fn fig12(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("motors that print alike", compute::SEED);
    let data = &compute::compute(fig.quality, fig.progress)?;
    fig.caption(caption(data));
    fig.parameters(parameters(data));
    fig.claims(vec![
        case(data, 0, "section5.long_period_case"),
        case(data, 1, "section5.low_period_case"),
        exponential(data),
        linear(data),
        abrupt(data),
        lines(data),
    ]);
    fig.draw(draw::draw(data));
    fig.data(data)
}

fn caption(data: &Fig12Data) -> String {
    let (long, low) = (&data.long_period, &data.low_period);
    format!(
        "Speed transients of the motor of Table III that nothing perturbs. (a)–(c) A = {:e} m, g = {} m/s²: long-period \
         chattering, one orbit of many between which the last places of the inputs choose; (d)–(f) g = {} m/s² and the amplitude that stands in (d), {:.1e} of the printed one \
         away from it, the nearest that was found with a low-period cycle of more than one flight which they do not choose ({}). (a), (d) Speed during each \
         flight; dashed: exponential fit, and what the impulses of one cycle predict. (b) Speed and (c), (f) height of the rotor in the blue windows, (f) over \
         three cycles; (e) speed during each flight of ten cycles, dots of one colour for the same flight of every cycle, which form lines. At the printed \
         amplitude itself the length of the cycle is a matter of rounding.",
        data.cases.amplitudes_m[0],
        long.motor.preload_acceleration_m_per_s2,
        low.motor.preload_acceleration_m_per_s2,
        low.amplitude_offset.abs(),
        low.robust_cycle.map_or_else(String::new, RobustCycle::words),
    )
}

fn parameters(data: &Fig12Data) -> Vec<(String, String)> {
    let motor = &data.long_period.motor;
    let own = [
        ("ω/2π", format!("{} Hz", motor.frequency_hz)),
        ("Γ of (a)–(c)", format!("{:.2}", data.long_period.axial_forcing)),
        ("Γ of (d)–(f)", format!("{:.2}", data.low_period.axial_forcing)),
        ("low period", format!("at most {} long flights from rest to rest", data.low_period_flights)),
        ("relaunch perturbation", "none".to_owned()),
        ("orbits judged for (a)–(c)", data.alike[0].inputs.clone()),
        ("orbits judged for (d)–(f)", data.alike[1].inputs.clone()),
    ];
    [motor.shared_inputs(), named(own)].concat()
}

/// So many orbits are enough for a verdict under another definition.
const ENOUGH: usize = 20;

/// That the orbits of a case are of long period (the first), or of low period.
fn case(data: &Fig12Data, case: usize, key: &str) -> Claim {
    let alike = &data.alike[case];
    let cases =
        |most: usize| Cases::of(alike.motors.iter().map(|motor| motor.cycle.is_low(most) == (case == 1)));
    let others = DEFINITIONS.map(cases);
    Claim::printed_statement(
        key,
        cases(LOW_PERIOD_FLIGHTS),
        format!(
            "orbits with {}: the last places choose the cycle. Low period is at most {LOW_PERIOD_FLIGHTS} flights of more than half a period; it holds, with other numbers of flights, for {}",
            alike.inputs,
            by_definition_words(others)
        ),
    )
    .by_definition(&others.map(Cases::sampled))
}

/// The verdicts on the orbits of a case that are of low period, or not, under the other definitions.
fn under_definitions(data: &Fig12Data, case: usize, holds: fn(&AlikeMotor) -> bool) -> Vec<Verdict> {
    let orbits = |most: usize| {
        data.alike[case].motors.iter().filter(move |motor| motor.cycle.is_low(most) == (case == 1))
    };
    let cases = DEFINITIONS.map(|most| Cases::of(orbits(most).map(holds)));
    cases.into_iter().filter(|cases| cases.tried >= ENOUGH).map(Cases::sampled).collect()
}

fn exponential(data: &Fig12Data) -> Claim {
    let fits = &data.long_period.fits;
    let motors = data.alike[0].motors.iter().filter(|motor| !motor.cycle.is_low_period());
    Claim::printed_statement(
        "section5.exponential_in_long_period",
        Cases::of(motors.map(AlikeMotor::is_exponential)),
        format!(
            "whether the exponential fits better than a linear rise to a constant, for the orbits of long period. Of the \
             motor drawn the root mean square deviation from the exponential is {:.3} rad/s, from the other {:.3} rad/s",
            fits.exponential.residual, fits.ramp_residual_rad_per_s
        ),
    )
    .by_definition(&under_definitions(data, 0, AlikeMotor::is_exponential))
}

/// How many of the motors of low period have a property.
fn low_period(found: &LowPeriod, holds: fn(&AlikeMotor) -> bool) -> Cases {
    Cases::of(found.motors.iter().map(holds))
}

fn linear(data: &Fig12Data) -> Claim {
    let fits = &data.low_period.fits;
    let found = &data.alike_of_low_period;
    Claim::printed_statement(
        "section5.linear_rise",
        low_period(found, |motor| !motor.is_exponential()),
        format!(
            "a linear rise to a constant fits better than the exponential, of the first {} orbits of low period of {} whose amplitudes round to the printed one. The rise of the \
             motor drawn consists of straight pieces, {:.2} rad/s off one line at most",
            found.motors.len(),
            found.drawn,
            fits.farthest_from_line_rad_per_s,
        ),
    )
    .by_definition(&under_definitions(data, 1, |motor| !motor.is_exponential()))
}

fn abrupt(data: &Fig12Data) -> Claim {
    let found = &data.alike_of_low_period;
    Claim::printed_statement(
        "section5.abrupt_steady_state",
        low_period(found, AlikeMotor::stops_abruptly),
        format!(
            "the time from nine tenths of the last speed to all but a fiftieth of it, over that to one half, is nearer to the 0.16 of a \
             linear rise to a constant than to the 2.3 of an exponential; {} orbits of low period",
            found.motors.len(),
        ),
    )
    .by_definition(&under_definitions(data, 1, AlikeMotor::stops_abruptly))
}

/// Lines are told apart in a window of [`SEEN_CYCLES`] cycles where neighbours are this share of the rise in
/// it apart.
const SEEN_APART: f64 = 0.05;

/// See [`SEEN_APART`].
const SEEN_CYCLES: f64 = 10.0;

fn lines(data: &Fig12Data) -> Claim {
    let found = &data.alike_of_low_period;
    let is_seen = |lines: &Lines| lines.gap_over_gain >= SEEN_APART * SEEN_CYCLES;
    let seen = Cases::of(found.lines.iter().map(is_seen));
    let mut gaps: Vec<f64> = found.lines.iter().map(|lines| lines.gap_over_peak_angular_speed).collect();
    gaps.sort_by(f64::total_cmp);
    Claim::printed_statement(
        "section5.multiple_lines",
        is_seen(&data.drawn_lines),
        format!(
            "the speeds of the flights of the motor drawn form at least two lines that stand apart by a twentieth of what the speed rises in ten cycles, as \
             panel (e) shows; so do those of {} other orbits of low period. On the scale of the whole transient neighbouring lines are {:.2} % of ωΦ apart on the median",
            seen.words(),
            100.0 * gaps.get(gaps.len() / 2).copied().unwrap_or(f64::NAN),
        ),
    )
}
