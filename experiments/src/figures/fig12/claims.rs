//! What the paper says about Fig. 12.

use super::data::{Fig12Data, Lines, LowPeriod};
use crate::claims::{Cases, Claim, Verdict};
use crate::figures::alike::AlikeMotor;
use crate::figures::motor_case::{DEFINITIONS, LOW_PERIOD_FLIGHTS};

/// So many orbits are enough for a verdict under another definition.
const ENOUGH: usize = 20;

fn is_low(motor: &AlikeMotor, most: usize) -> bool {
    motor.cycle.chattering_flights().is_some_and(|flights| flights <= most)
}

pub(super) fn claims(data: &Fig12Data) -> Vec<Claim> {
    vec![
        case(data, 0, "section5.long_period_case"),
        case(data, 1, "section5.low_period_case"),
        exponential(data),
        linear(data),
        abrupt(data),
        lines(data),
    ]
}

/// That the orbits of a case are of long period (the first), or of low period.
fn case(data: &Fig12Data, case: usize, key: &str) -> Claim {
    let alike = &data.alike[case];
    let cases = |most: usize| Cases::of(alike.motors.iter().map(|motor| is_low(motor, most) == (case == 1)));
    let others = DEFINITIONS.map(cases);
    let words = DEFINITIONS.iter().zip(others).map(|(most, cases)| format!("{most}: {}", cases.words()));
    Claim::printed_statement(
        key,
        cases(LOW_PERIOD_FLIGHTS),
        format!(
            "A and g are printed, and the last places of the amplitude choose the cycle: {}; low period is at most {LOW_PERIOD_FLIGHTS} flights of more than half a period from \
             rest to rest. With other numbers of flights it holds for {}",
            alike.inputs,
            words.collect::<Vec<_>>().join("; ")
        ),
    )
    .by_definition(&others.map(Cases::sampled))
}

/// The verdicts on the orbits of a case that are of low period, or not, under the other definitions.
fn under_definitions(data: &Fig12Data, case: usize, holds: fn(&AlikeMotor) -> bool) -> Vec<Verdict> {
    let orbits =
        |most: usize| data.alike[case].motors.iter().filter(move |motor| is_low(motor, most) == (case == 1));
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
            fits.exponential_residual_rad_per_s, fits.ramp_residual_rad_per_s
        ),
    )
    .by_definition(&under_definitions(data, 0, AlikeMotor::is_exponential))
}

/// How many of the motors of low period have a property.
fn low_period(found: &LowPeriod, holds: fn(&AlikeMotor) -> bool) -> Cases {
    Cases::of(found.motors.iter().map(holds))
}

fn linear(data: &Fig12Data) -> Claim {
    let (fits, prediction) = (&data.low_period.fits, &data.low_period.prediction);
    let found = &data.alike_of_low_period;
    Claim::printed_statement(
        "section5.linear_rise",
        low_period(found, |motor| !motor.is_exponential()),
        format!(
            "whether a linear rise to a constant fits better than the exponential, for the first {} orbits of low period of {} with amplitudes that round to the printed one. \
             Of the motor drawn the deviation from a linear rise is {:.3}, from an exponential {:.3} rad/s; the line through the whole rise has \
             the slope {:.4} ± {:.4} rad/s² and lies {:.2} rad/s off at most: the rise consists of straight pieces. The first has {:.4} rad/s². The \
             normal impulse of a cycle is the weight times its duration (off by {:.0e}), of which the share {:.4} net pushes forwards \
             where cos(τ + θ) > 0: that slope is μ a_e g/a_g² = {:.4} rad/s² times the share, {:.4} rad/s²",
            found.motors.len(),
            found.drawn,
            fits.ramp_residual_rad_per_s,
            fits.exponential_residual_rad_per_s,
            fits.slope_rad_per_s2,
            fits.slope_error_rad_per_s2,
            fits.farthest_from_line_rad_per_s,
            fits.first_slope_rad_per_s2,
            prediction.balance.abs(),
            prediction.net_share_at_rest,
            data.low_period.largest_acceleration_rad_per_s2,
            prediction.slope_rad_per_s2,
        ),
    )
    .by_definition(&under_definitions(data, 1, |motor| !motor.is_exponential()))
}

fn abrupt(data: &Fig12Data) -> Claim {
    let (fits, prediction) = (&data.low_period.fits, &data.low_period.prediction);
    let found = &data.alike_of_low_period;
    Claim::printed_statement(
        "section5.abrupt_steady_state",
        low_period(found, AlikeMotor::stops_abruptly),
        format!(
            "whether the time from nine tenths of the last speed to all but a fiftieth of it, over that to one half, is nearer to the 0.16 of a \
             linear rise to a constant than to the 2.3 of an exponential, for {} orbits of low period. Of the motor drawn the impulses \
             predict as the steady speed that of the stator at the impact where those below and above balance, {:.3} rad/s, reached within 2 % after {:.3} s; \
             simulated {:.3} rad/s after {} s",
            found.motors.len(),
            prediction.steady_speed_rad_per_s,
            prediction.reached_s,
            fits.last_speed_rad_per_s,
            fits.reached_s.map_or_else(|| "no".to_owned(), |time| format!("{time:.3}")),
        ),
    )
    .by_definition(&under_definitions(data, 1, AlikeMotor::stops_abruptly))
}

/// Lines are told apart in a window of [`SEEN_CYCLES`] cycles where neighbours are this share of the rise in it apart.
const SEEN_APART: f64 = 0.05;
/// See [`SEEN_APART`].
const SEEN_CYCLES: f64 = 10.0;

fn lines(data: &Fig12Data) -> Claim {
    let found = &data.alike_of_low_period;
    let is_seen = |lines: &Lines| lines.gap_over_gain >= SEEN_APART * SEEN_CYCLES;
    let seen = Cases::of(found.lines.iter().map(is_seen));
    let several = found.lines.iter().filter(|lines| lines.flights > 1).count();
    let mut gaps: Vec<f64> = found.lines.iter().map(|lines| lines.gap_over_peak_angular_speed).collect();
    gaps.sort_by(f64::total_cmp);
    let (middle, widest) = (gaps.get(gaps.len() / 2), gaps.last());
    let impacts = &data.low_period.prediction.impacts;
    let words = impacts.iter().map(|(phase, share, level)| format!("({phase:.4}, {share:.3}, {level:+.3})"));
    Claim::printed_statement(
        "section5.multiple_lines",
        is_seen(&data.drawn_lines),
        format!(
            "whether the speeds of the flights of the motor drawn form at least two lines that stand apart by a twentieth of what the speed rises in ten cycles, as \
             panel (e) shows them. Of other orbits of low period {} do, where {several} of {} have more than one flight in a cycle. On the scale of the whole \
             transient no lines are seen: neighbouring lines are {:.2} % of ωΦ apart on the median, {:.2} % at most. Impacts of the cycle drawn with at least 1 % of its impulse (τ/2π, \
             share, cos(τ + θ)): {}",
            seen.words(),
            found.lines.len(),
            100.0 * middle.copied().unwrap_or(f64::NAN),
            100.0 * widest.copied().unwrap_or(f64::NAN),
            words.collect::<Vec<_>>().join(" "),
        ),
    )
}
