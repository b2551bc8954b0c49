//! What the paper says about Fig. 12.

use super::data::{Fig12Data, Reading, Rounding, Shown};
use crate::claim::Claim;
use crate::figures::motor_case::perturbation_words;

const ID: &str = "fig12";
const SECTION: &str = "Sec. V C";

/// A straight line and the transition count as predicted within this share.
const PREDICTED_WITHIN: f64 = 0.05;

pub(super) fn caption(data: &Fig12Data) -> String {
    let (long, low) = (&data.long_period, &data.low_period);
    format!(
        "Speed transients of the motor of Table III that nothing perturbs. (a)–(c) A = {:e} m, g = {} m/s²: long-period \
         chattering ({}); (d)–(f) g = {} m/s² and A = {:e} m to within a relative {:.1e}, the nearest amplitude with a \
         low-period cycle of more than one flight ({}). (a), (d) Speed during each flight; dashed: exponential fit, and \
         what the impulses of one cycle predict. (b), (e) Speed and (c), (f) height of the rotor in the blue windows; in \
         (d)–(f) three cycles. At the printed amplitude itself the low-period case has a cycle of {}.",
        data.cases.amplitudes_m[0],
        long.motor.preload_acceleration_m_per_s2,
        long.cycle.words(),
        low.motor.preload_acceleration_m_per_s2,
        data.cases.amplitudes_m[1],
        low.amplitude_offset.abs(),
        low.cycle.words(),
        printed_low(data).map_or_else(String::new, |reading| reading.cycle.words()),
    )
}

pub(super) fn parameters(data: &Fig12Data) -> Vec<(String, String)> {
    let motor = &data.long_period.motor;
    let pair = |name: &str, value: String| (name.to_owned(), value);
    vec![
        pair("μ", motor.friction.to_string()),
        pair("ε", motor.restitution.to_string()),
        pair("θ", format!("{} rad", motor.phase_lag_rad)),
        pair("ωΦ", format!("{} rad/s", motor.peak_angular_speed_rad_per_s)),
        pair("ω/2π", format!("{} Hz", motor.frequency_hz)),
        pair("Γ of (a)–(c)", format!("{:.2}", data.long_period.axial_forcing)),
        pair("Γ of (d)–(f)", format!("{:.2}", data.low_period.axial_forcing)),
        pair("low period", format!("at most {} long flights from rest to rest", data.low_period_flights)),
        pair("relaunch perturbation", "none".to_owned()),
    ]
}

/// The printed low-period case: first reading, complete policy.
fn printed_low(data: &Fig12Data) -> Option<&Reading> {
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
    let (long, low) = (&data.long_period, &data.low_period);
    vec![
        Claim::printed_statement(
            "section5.long_period_case",
            !long.cycle.is_low_period(),
            format!("classified by the collisions of the unperturbed motor: {}", readings(data)),
        ),
        Claim::printed_statement(
            "section5.low_period_case",
            printed_low(data).is_some_and(|reading| reading.cycle.is_low_period()),
            format!(
                "{}. The last places of the arithmetic decide: {}. A relative change of {:.1e} gives the cycle of {} that is \
                 drawn. So the paper's low-period orbit is one that its own rounding may have chosen",
                readings(data),
                data.rounding.iter().map(shares).collect::<Vec<_>>().join("; "),
                low.amplitude_offset,
                low.cycle.words(),
            ),
        ),
        exponential(long),
        linear(low),
        abrupt(low),
        lines(low),
        uncommon(data),
        smallest_of_fig10(data),
    ]
}

fn exponential(long: &Shown) -> Claim {
    let fits = &long.fits;
    Claim::printed_statement(
        "section5.exponential_in_long_period",
        fits.exponential_residual_rad_per_s < fits.ramp_residual_rad_per_s,
        format!(
            "root mean square deviation from the exponential {:.3} rad/s, from a linear rise to a constant {:.3} rad/s",
            fits.exponential_residual_rad_per_s, fits.ramp_residual_rad_per_s
        ),
    )
}

fn linear(low: &Shown) -> Claim {
    let (fits, prediction) = (&low.fits, &low.prediction);
    Claim::printed_statement(
        "section5.linear_rise",
        fits.ramp_residual_rad_per_s < fits.exponential_residual_rad_per_s
            && (fits.slope_rad_per_s2 / prediction.slope_rad_per_s2 - 1.0).abs() <= PREDICTED_WITHIN,
        format!(
            "deviation from a linear rise {:.3}, from an exponential {:.3} rad/s; slope {:.4} ± {:.4} rad/s² over the first half \
             of the rise. The normal impulse of a cycle is the weight times its duration (off by {:.0e}), of which the share \
             {:.4} net pushes forwards where cos(τ + θ) > 0: the slope is μ a_e g/a_g² = {:.4} rad/s² times that, {:.4} rad/s²",
            fits.ramp_residual_rad_per_s,
            fits.exponential_residual_rad_per_s,
            fits.slope_rad_per_s2,
            fits.slope_error_rad_per_s2,
            prediction.balance.abs(),
            prediction.net_share_at_rest,
            low.largest_acceleration_rad_per_s2,
            prediction.slope_rad_per_s2,
        ),
    )
}

fn abrupt(low: &Shown) -> Claim {
    let (fits, prediction) = (&low.fits, &low.prediction);
    let reached = fits.reached_s;
    Claim::printed_statement(
        "section5.abrupt_steady_state",
        reached.is_some_and(|time| (time / prediction.reached_s - 1.0).abs() <= PREDICTED_WITHIN)
            && (fits.last_speed_rad_per_s / prediction.steady_speed_rad_per_s - 1.0).abs()
                <= PREDICTED_WITHIN,
        format!(
            "the steady speed is that of the stator at the impact where the impulses below and above balance, {:.3} rad/s, reached \
             within 2 % after {:.3} s; simulated {:.3} rad/s after {} s",
            prediction.steady_speed_rad_per_s,
            prediction.reached_s,
            fits.last_speed_rad_per_s,
            reached.map_or_else(|| "no".to_owned(), |time| format!("{time:.3}")),
        ),
    )
}

fn lines(low: &Shown) -> Claim {
    let impacts = &low.prediction.impacts;
    let words = impacts.iter().map(|(phase, share, level)| format!("({phase:.4}, {share:.3}, {level:+.3})"));
    let both_ways = impacts.iter().any(|impact| impact.2 > 0.0) && impacts.len() > 1;
    let levels = |rest: usize| {
        let flights = low.cycle.flights().unwrap_or(1).max(1);
        low.flight_speed_rad_per_s.iter().skip(rest).step_by(flights).take(2).copied().collect::<Vec<f64>>()
    };
    let rises: Vec<f64> = (0..low.cycle.flights().unwrap_or(0))
        .filter_map(|rest| match levels(rest)[..] {
            [first, second] => Some(second - first),
            _ => None,
        })
        .collect();
    Claim::printed_statement(
        "section5.multiple_lines",
        both_ways && rises.len() > 1,
        format!(
            "{} flights in a cycle, each with its own line; impacts with at least 1 % of the impulse of a cycle (τ/2π, share, \
             cos(τ + θ)): {}",
            rises.len(),
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

fn smallest_of_fig10(data: &Fig12Data) -> Claim {
    Claim::statement(
        ID,
        "Fig. 10(a)",
        "the motor of Fig. 10(a) is not on a low-period orbit",
        !data.smallest_of_fig10.is_low_period(),
        format!(
            "at A ω²/g = {:.3} = 2π² its cycle has {}: low-period chattering at parameters that the paper shows as exponential",
            data.smallest_of_fig10_peak_acceleration,
            data.smallest_of_fig10.words(),
        ),
    )
}
