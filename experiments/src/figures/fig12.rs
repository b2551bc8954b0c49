//! Fig. 12: transient speed curves of long-period and low-period chattering.

mod picture;
mod shown;

use bouncing_disk::core::ChatterPolicy;
use serde::Serialize;

use self::shown::{LONG_RISES, flown, nearest_low_period, shown};
use super::shared::alike::{AlikeMotor, DRAWN, PrintedInputs, alike};
use super::shared::map_in_parallel;
use super::shared::motor::{
    Cycle, DEFINITIONS, LOW_PERIOD_FLIGHTS, MotorCase, RobustCycle, by_definition_words, by_each_definition,
};
use super::shared::numbers::median;
use crate::claims::{Cases, Claim, Verdict, paper};
use crate::experiment::{ExperimentError, Paper};

/// Seed of the inputs that print alike, and how many are drawn at most to find those of low period.
const SEED: u64 = 12;
const MOST_DRAWN: usize = 6_000;
/// So many orbits are enough for a verdict under another definition.
const ENOUGH: usize = 20;
/// Lines are told apart in a window of [`SEEN_CYCLES`] cycles where neighbours are this share of the rise in
/// it apart.
const SEEN_APART: f64 = 0.05;
/// See [`SEEN_APART`].
const SEEN_CYCLES: f64 = 10.0;

/// Fig. 12.
pub(crate) fn fig12(fig: &mut Paper<'_>) -> Result<(), ExperimentError> {
    fig.chattering(ChatterPolicy::Complete);
    fig.seed("motors that print alike", SEED);
    fig.progress.start(4, "cases");
    let cases = paper::chattering_cases()?;
    let motor = |case: usize| -> Result<MotorCase, ExperimentError> {
        Ok(MotorCase {
            amplitude_m: cases.amplitudes_m[case],
            preload_acceleration_m_per_s2: cases.preload_accelerations_m_per_s2[case],
            ..MotorCase::table_three()?
        })
    };
    // The low-period case at the amplitude nearest to the printed one that repeats a robust low-period cycle of more than one flight.
    let near = nearest_low_period(&motor(1)?)?;
    fig.progress.advance(1);
    let long = shown(motor(0)?, cases.amplitudes_m[0])?;
    fig.progress.advance(1);
    let low = shown(near, cases.amplitudes_m[1])?;
    let drawn_lines = lines(&near, near.cycle(ChatterPolicy::Complete)?)?;
    fig.progress.advance(1);
    let count = fig.quality.choose(DRAWN / 10, DRAWN);
    let of_case = |amplitude, preload| -> Result<PrintedInputs, ExperimentError> {
        PrintedInputs::table_three()?.amplitude(amplitude)?.preload_acceleration(preload)
    };
    let inputs = [
        of_case("section5.amplitude_of_long_period", "section5.preload_acceleration_of_long_period")?,
        of_case("section5.amplitude_of_low_period", "section5.preload_acceleration_of_low_period")?,
    ];
    let drawn = |inputs: &PrintedInputs| {
        let motors = alike(&inputs.drawn(count, SEED), LONG_RISES)?;
        Ok::<_, ExperimentError>(Alike { inputs: inputs.words(), motors })
    };
    let [long_alike, low_alike] = inputs.each_ref().map(drawn);
    let orbits = [long_alike?, low_alike?];
    let around = inputs[1].rounded_amplitude("section5.amplitude_of_low_period")?;
    let found = first_of_low_period(&around, count)?;
    fig.progress.advance(1);

    fig.claim(case(&orbits, 0, "section5.long_period_case"));
    fig.claim(case(&orbits, 1, "section5.low_period_case"));
    let of_long_period = orbits[0].motors.iter().filter(|motor| !motor.cycle.is_low_period());
    fig.claim(
        Claim::printed_statement(
            "section5.exponential_in_long_period",
            Cases::of(of_long_period.map(AlikeMotor::is_exponential)),
            format!(
                "the exponential fits better than a linear rise to a constant; in (a) they are {:.3} and {:.3} rad/s off",
                long.fits.exponential.residual, long.fits.ramp_residual_rad_per_s
            ),
        )
        .by_definition(&under_definitions(&orbits, 0, AlikeMotor::is_exponential)),
    );
    let of_low_period = |holds: fn(&AlikeMotor) -> bool| Cases::of(found.motors.iter().map(holds));
    fig.claim(
        Claim::printed_statement(
            "section5.linear_rise",
            of_low_period(|motor| !motor.is_exponential()),
            format!(
                "a linear rise to a constant fits better than the exponential; {} low-period orbits of {} sampled. In (d) the rise is within {:.2} rad/s of a line",
                found.motors.len(),
                found.drawn,
                low.fits.farthest_from_line_rad_per_s,
            ),
        )
        .by_definition(&under_definitions(&orbits, 1, |motor| !motor.is_exponential())),
    );
    fig.claim(
        Claim::printed_statement(
            "section5.abrupt_steady_state",
            of_low_period(AlikeMotor::stops_abruptly),
            "the time from 90 to 98 % of the last speed, over that to 50 %, is nearer to the 0.16 of a ramp than to the 2.3 of an exponential",
        )
        .by_definition(&under_definitions(&orbits, 1, AlikeMotor::stops_abruptly)),
    );
    let is_seen = |lines: &Lines| lines.gap_over_gain >= SEEN_APART * SEEN_CYCLES;
    fig.claim(Claim::printed_statement(
        "section5.multiple_lines",
        is_seen(&drawn_lines),
        format!(
            "in (e) the lines are a twentieth of the rise in ten cycles apart, as in {} other orbits; over the whole transient the median distance is {:.2} % of ωΦ",
            Cases::of(found.lines.iter().map(is_seen)).words(),
            100.0 * median(found.lines.iter().map(|lines| lines.gap_over_peak_angular_speed)).unwrap_or(f64::NAN),
        ),
    ));

    fig.parameters(long.motor.shared_inputs());
    fig.parameter("ω/2π", format!("{} Hz", long.motor.frequency_hz));
    fig.parameter("Γ of (a)–(c)", format!("{:.2}", long.axial_forcing));
    fig.parameter("Γ of (d)–(f)", format!("{:.2}", low.axial_forcing));
    fig.parameter("low period", format!("at most {LOW_PERIOD_FLIGHTS} long flights from rest to rest"));
    fig.parameter("relaunch perturbation", "none");
    fig.parameter("orbits judged for (a)–(c)", &orbits[0].inputs);
    fig.parameter("orbits judged for (d)–(f)", &orbits[1].inputs);
    fig.caption(format!(
        "Speed transients of the motor of Table III, unperturbed. (a)–(c) A = {:e} m, g = {} m/s²: long-period chattering. (d)–(f) \
         g = {} m/s²: low-period chattering ({}) at an amplitude {:.1e} (relative) from the printed one, at which rounding selects the \
         cycle. (a), (d) Speed during each flight; dashed: exponential fit, and the prediction from the impulses of one cycle. \
         (b) Speed and (c), (f) height of the rotor in the blue windows. (e) Speed during each flight of ten cycles.",
        long.motor.amplitude_m,
        long.motor.preload_acceleration_m_per_s2,
        low.motor.preload_acceleration_m_per_s2,
        low.robust_cycle.map_or_else(String::new, RobustCycle::words),
        low.amplitude_offset.abs(),
    ));
    fig.draw(picture::draw([&long, &low], cases.amplitudes_m));
    fig.record("cases", &cases)?;
    fig.record("long_period", &long)?;
    fig.record("low_period", &low)?;
    fig.record("low_period_flights", &LOW_PERIOD_FLIGHTS)?;
    fig.record("alike", &orbits)?;
    fig.record("drawn_lines", &drawn_lines)?;
    fig.record("alike_of_low_period", &found)
}

/// Motors whose inputs all print like the paper's.
#[derive(Serialize)]
struct Alike {
    /// The ranges drawn from.
    inputs: String,
    motors: Vec<AlikeMotor>,
}

/// The first motors of low period of a longer sequence of those that print alike.
#[derive(Serialize)]
struct LowPeriod {
    /// Motors drawn to find them.
    drawn: usize,
    motors: Vec<AlikeMotor>,
    /// The lines that each speed forms.
    lines: Vec<Lines>,
}

/// The lines on which the speeds of the flights of a low-period cycle lie while the rotor is slow: one for
/// each flight of the cycle.
#[derive(Serialize)]
struct Lines {
    flights: usize,
    /// Largest distance of neighbouring lines, over what the speed gains in a cycle.
    gap_over_gain: f64,
    /// The same over ωΦ.
    gap_over_peak_angular_speed: f64,
}

/// The first `count` motors of low period that are drawn.
fn first_of_low_period(inputs: &PrintedInputs, count: usize) -> Result<LowPeriod, ExperimentError> {
    let drawn = inputs.drawn(MOST_DRAWN.min(30 * count), SEED);
    let cycles = map_in_parallel(&drawn, |motor| motor.cycle(ChatterPolicy::Complete))?;
    let found: Vec<usize> =
        (0..drawn.len()).filter(|&index| cycles[index].is_low_period()).take(count).collect();
    let chosen: Vec<MotorCase> = found.iter().map(|&index| drawn[index]).collect();
    Ok(LowPeriod {
        drawn: found.last().map_or(drawn.len(), |last| last + 1),
        lines: map_in_parallel(&found, |&index| lines(&drawn[index], cycles[index]))?,
        motors: alike(&chosen, LONG_RISES)?,
    })
}

/// The lines of a low-period cycle, from two rounds of it right after the start.
fn lines(motor: &MotorCase, cycle: Cycle) -> Result<Lines, ExperimentError> {
    let flights = cycle.flights().unwrap_or_default();
    let (times, speeds) = flown(motor, 3 * flights, f64::INFINITY)?;
    // The first round begins with a rest that is not of the cycle.
    let points: Vec<(f64, f64)> = times.into_iter().zip(speeds).skip(flights).collect();
    let (Some(&(began, first)), Some(&(again, second))) = (points.first(), points.get(flights)) else {
        return Ok(Lines { flights, gap_over_gain: 0.0, gap_over_peak_angular_speed: 0.0 });
    };
    let gain = second - first;
    let mut offsets: Vec<f64> = points[..flights]
        .iter()
        .map(|(time, speed)| speed - gain * (time - began) / (again - began))
        .collect();
    offsets.sort_by(f64::total_cmp);
    let gap = offsets.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    // A cycle that drives the rotor neither way gains nothing, and its lines lie level.
    let gap_over_gain = if gain == 0.0 { 0.0 } else { gap / gain.abs() };
    Ok(Lines {
        flights,
        gap_over_gain,
        gap_over_peak_angular_speed: gap / motor.peak_angular_speed_rad_per_s,
    })
}

/// That the orbits of a case are of long period (the first), or of low period.
fn case(orbits: &[Alike; 2], case: usize, key: &str) -> Claim {
    let motors = &orbits[case].motors;
    let cases = |most: usize| Cases::of(motors.iter().map(|motor| motor.cycle.is_low(most) == (case == 1)));
    let shares = by_each_definition(cases);
    Claim::printed_statement(
        key,
        cases(LOW_PERIOD_FLIGHTS),
        format!("by the most flights of a low period: {}", by_definition_words(&shares)),
    )
    .by_shares(&shares)
}

/// The verdicts on the orbits of a case that are of low period, or not, under the other definitions.
fn under_definitions(orbits: &[Alike; 2], case: usize, holds: fn(&AlikeMotor) -> bool) -> Vec<Verdict> {
    let chosen =
        |most: usize| orbits[case].motors.iter().filter(move |motor| motor.cycle.is_low(most) == (case == 1));
    let cases = DEFINITIONS.map(|most| Cases::of(chosen(most).map(holds)));
    cases.into_iter().filter(|cases| cases.tried >= ENOUGH).map(Cases::sampled).collect()
}
