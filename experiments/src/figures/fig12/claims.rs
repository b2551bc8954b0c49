//! What the paper says about Fig. 12.

use super::data::{Alike, Fig12Data, LowPeriod, Reading, Rounding};
use crate::claim::{Agreement, Claim};
use crate::figures::alike::AlikeMotor;
use crate::figures::motor_case::perturbation_words;

const ID: &str = "fig12";
const SECTION: &str = "Sec. V C";

/// The printed low-period case: first reading, complete policy.
pub(super) fn printed_low(data: &Fig12Data) -> Option<&Reading> {
    let low = data.low_period.motor.preload_acceleration_m_per_s2;
    data.printed.iter().find(|reading| reading.preload_acceleration_m_per_s2.total_cmp(&low).is_eq())
}

fn readings(data: &Fig12Data) -> String {
    let words = data.printed.iter().map(|reading| {
        format!(
            "A = {:e} m, g = {} m/s², ω = {:.0} rad/s, {}: {}",
            reading.amplitude_m,
            reading.preload_acceleration_m_per_s2,
            reading.angular_frequency_rad_per_s,
            if reading.papers_cut { "paper's cut" } else { "chattering summed" },
            reading.cycle.words(),
        )
    });
    words.collect::<Vec<_>>().join("; ")
}

fn shares(rounding: &Rounding) -> String {
    let words =
        rounding.share_up_to.iter().map(|(flights, share)| format!("{:.0} % ≤ {flights}", 100.0 * share));
    format!(
        "at {} amplitudes about {:e} m, {:e} apart (g = {} m/s²), the cycles have {} long flights",
        rounding.amplitudes,
        rounding.amplitude_m,
        rounding.step,
        rounding.preload_acceleration_m_per_s2,
        words.collect::<Vec<_>>().join(", "),
    )
}

pub(super) fn claims(data: &Fig12Data) -> Vec<Claim> {
    let [long, low] = &data.alike;
    let case = |alike: &Alike| {
        let share = Agreement::of(alike.motors.iter().map(|motor| motor.cycle.is_low_period())).share();
        format!(
            "{} of {} motors that print alike ({}) are of low period, at most {} flights of more than half a period from rest to rest",
            percent(share),
            alike.motors.len(),
            alike.inputs,
            data.low_period_flights,
        )
    };
    vec![
        Claim::printed_share(
            "section5.long_period_case",
            Agreement::of(long.motors.iter().map(|motor| !motor.cycle.is_low_period())),
            format!("{}. At the printed digits: {}", case(long), readings(data)),
        )
        .note(exactly(data, 0, |motor| !motor.cycle.is_low_period())),
        Claim::printed_share(
            "section5.low_period_case",
            Agreement::of(low.motors.iter().map(|motor| motor.cycle.is_low_period())),
            format!(
                "{}. The last places of the arithmetic decide: {}. A relative change of {:.1e} gives the cycle of {} that is drawn. So \
                 the paper's low-period orbit is one that its own rounding may have chosen",
                case(low),
                data.rounding.iter().map(shares).collect::<Vec<_>>().join("; "),
                data.low_period.amplitude_offset,
                data.low_period.cycle.words(),
            ),
        )
        .note(exactly(data, 1, |motor| motor.cycle.is_low_period())),
        exponential(data),
        linear(data),
        abrupt(data),
        lines(data),
        uncommon(data),
    ]
}

/// For how many motors of a case it holds if what can be chosen is exactly as printed.
fn exactly(data: &Fig12Data, case: usize, holds: fn(&AlikeMotor) -> bool) -> String {
    let motors = data.exact_settings.get(case).map_or(&[][..], |alike| &alike.motors);
    format!(
        "with μ, ε, A and ωΦ exactly as printed it holds for {}",
        Agreement::of(motors.iter().map(holds)).words()
    )
}

fn percent(share: Option<f64>) -> String {
    share.map_or_else(|| "none".to_owned(), |share| format!("{:.1} %", 100.0 * share))
}

fn exponential(data: &Fig12Data) -> Claim {
    let fits = &data.long_period.fits;
    let motors = data.alike[0].motors.iter().filter(|motor| !motor.cycle.is_low_period());
    Claim::printed_share(
        "section5.exponential_in_long_period",
        Agreement::of(motors.map(AlikeMotor::is_exponential)),
        format!(
            "whether the exponential fits better than a linear rise to a constant, for the motors that print alike and are of long period. Of the \
             motor drawn the root mean square deviation from the exponential is {:.3} rad/s, from the other {:.3} rad/s",
            fits.exponential_residual_rad_per_s, fits.ramp_residual_rad_per_s
        ),
    )
}

/// How many of the motors of low period have a property.
fn low_period(found: &LowPeriod, holds: fn(&AlikeMotor) -> bool) -> Agreement {
    Agreement::of(found.motors.iter().map(holds))
}

fn linear(data: &Fig12Data) -> Claim {
    let (fits, prediction) = (&data.low_period.fits, &data.low_period.prediction);
    let found = &data.alike_of_low_period;
    Claim::printed_share(
        "section5.linear_rise",
        low_period(found, |motor| !motor.is_exponential()),
        format!(
            "whether a linear rise to a constant fits better than the exponential, for the first {} of low period in {} motors that print alike. \
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
}

fn abrupt(data: &Fig12Data) -> Claim {
    let (fits, prediction) = (&data.low_period.fits, &data.low_period.prediction);
    let found = &data.alike_of_low_period;
    Claim::printed_share(
        "section5.abrupt_steady_state",
        low_period(found, AlikeMotor::stops_abruptly),
        format!(
            "whether the time from nine tenths of the last speed to all but a fiftieth of it, over that to one half, is nearer to the 0.16 of a \
             linear rise to a constant than to the 2.3 of an exponential, for {} motors of low period that print alike. Of the motor drawn the impulses \
             predict as the steady speed that of the stator at the impact where those below and above balance, {:.3} rad/s, reached within 2 % after {:.3} s; \
             simulated {:.3} rad/s after {} s",
            found.motors.len(),
            prediction.steady_speed_rad_per_s,
            prediction.reached_s,
            fits.last_speed_rad_per_s,
            fits.reached_s.map_or_else(|| "no".to_owned(), |time| format!("{time:.3}")),
        ),
    )
}

/// Lines are told apart in a window of [`SEEN_CYCLES`] cycles where neighbours are this share of the rise in it apart.
const SEEN_APART: f64 = 0.05;
/// See [`SEEN_APART`].
const SEEN_CYCLES: f64 = 10.0;

fn lines(data: &Fig12Data) -> Claim {
    let found = &data.alike_of_low_period;
    let seen = found.lines.iter().map(|lines| lines.gap_over_gain >= SEEN_APART * SEEN_CYCLES);
    let several = found.lines.iter().filter(|lines| lines.flights > 1).count();
    let mut gaps: Vec<f64> = found.lines.iter().map(|lines| lines.gap_over_peak_angular_speed).collect();
    gaps.sort_by(f64::total_cmp);
    let (middle, widest) = (gaps.get(gaps.len() / 2), gaps.last());
    let impacts = &data.low_period.prediction.impacts;
    let words = impacts.iter().map(|(phase, share, level)| format!("({phase:.4}, {share:.3}, {level:+.3})"));
    Claim::printed_share(
        "section5.multiple_lines",
        Agreement::of(seen),
        format!(
            "whether the speeds of the flights form at least two lines that stand apart by a twentieth of what the speed rises in ten cycles, as panel (e) shows \
             them, for {} motors of low period that print alike; {several} of them have more than one flight in a cycle. On the scale of the whole transient nothing \
             is seen: neighbouring lines are {:.2} % of ωΦ apart on the median, {:.2} % at most. Impacts of the cycle drawn with at least 1 % of its impulse (τ/2π, \
             share, cos(τ + θ)): {}",
            found.lines.len(),
            100.0 * middle.copied().unwrap_or(f64::NAN),
            100.0 * widest.copied().unwrap_or(f64::NAN),
            words.collect::<Vec<_>>().join(" "),
        ),
    )
}

/// Why low-period orbits have not been seen in motors.
fn uncommon(data: &Fig12Data) -> Claim {
    let broken = data.perturbations.iter().find(|effect| !effect.statistics.locked);
    let silent = data.perturbations.first();
    Claim::statement(
        ID,
        SECTION,
        "real motors operate where low-period chattering is uncommon",
        data.rounding.iter().all(|rounding| {
            rounding
                .share_up_to
                .iter()
                .any(|(flights, share)| *flights == data.low_period_flights && *share < 0.5)
        }) && broken.is_some()
            && silent.is_some_and(|effect| effect.statistics.locked),
        format!(
            "{}; the cycle of (d)–(f) survives no relaunch perturbation of {} g/ω or more. Steady speed (rad/s) and stall \
             acceleration (rad/s²) by perturbation (g/ω): {}",
            data.rounding.iter().map(shares).collect::<Vec<_>>().join("; "),
            broken.map_or_else(
                || "any size".to_owned(),
                |effect| format!("{:e}", effect.relaunch_perturbation)
            ),
            perturbation_words(&data.perturbations),
        ),
    )
}
