//! The statements of the paper about Fig. 11.

use super::data::{Fig11Data, Trend};
use super::trends::{EXPONENT_WITHIN, SHARP};
use crate::claims::{Cases, Claim, all};

/// An exponent of the stall torque above this is nearer to the trend (1) than to a plateau (0).
const NEARER_TO_TREND: f64 = 0.5;

/// A difference of more than so many standard errors is one.
const STANDARD_ERRORS: f64 = 3.0;

pub(super) fn claims(data: &Fig11Data) -> Vec<Claim> {
    let [default, second] = data.printed.frequencies_hz.map(|frequency| at_frequency(data, frequency));
    let total =
        |trends: &[&Trend], of: fn(&Trend) -> Cases| trends.iter().map(|trend| of(trend)).sum::<Cases>();
    let near = |exponent: Option<f64>, of: f64| {
        exponent.is_some_and(|exponent| (exponent - of).abs() <= EXPONENT_WITHIN)
    };
    vec![
        Claim::printed_statement(
            "section5.torque_proportional_to_preload",
            all(&default, |trend| near(trend.torque_exponent, 1.0)),
            format!(
                "whether the exponent of stall torque against preload is within {EXPONENT_WITHIN} of 1 at each A: {}; a single motor agrees if its torque over preload is \
                 within {} % of the middle one of its curve",
                words(&default, |trend| trend.torque_exponent),
                100.0 * SHARP,
            ),
        )
        .single_orbits(total(&default, |trend| trend.torque)),
        Claim::printed_statement(
            "section5.speed_independent_of_preload",
            all(&default, |trend| near(trend.speed_exponent, 0.0)),
            format!(
                "whether the exponent of steady speed against preload is within {EXPONENT_WITHIN} of 0 at each A: {}; a single motor agrees if its speed is within {} % of the \
                 middle one of its curve",
                words(&default, |trend| trend.speed_exponent),
                100.0 * SHARP,
            ),
        )
        .single_orbits(total(&default, |trend| trend.speed)),
        Claim::printed_statement(
            "section5.both_frequencies",
            all(default.iter().chain(&second), |trend| near(trend.torque_exponent, 1.0) && near(trend.speed_exponent, 0.0)),
            format!(
                "whether both exponents are within {EXPONENT_WITHIN} of 1 and 0 at both frequencies; at the second: {} and {}; a single motor agrees if it is on both trends. The measured \
                 points are not in the text",
                words(&second, |trend| trend.torque_exponent),
                words(&second, |trend| trend.speed_exponent),
            ),
        )
        .single_orbits([&default, &second].into_iter().map(|trends| total(trends, |trend| trend.both)).sum()),
        Claim::printed_statement(
            "section5.no_sharp_fall",
            all(default.iter().flat_map(|trend| trend.outside_over_inside), |ratio| ratio >= 1.0 - SHARP),
            format!(
                "middle steady speed of the lowest and of the highest quarter of the motors beside the preloads of the trends, over that inside, at each A: {}; a sharp change is one of more than {} %",
                ratios(&default),
                100.0 * SHARP
            ),
        )
        .single_orbits(total(&default, |trend| trend.no_fall)),
        Claim::printed_statement(
            "section5.no_plateau",
            all(&default, |trend| trend.high_torque_exponent.is_some_and(|exponent| exponent > NEARER_TO_TREND)),
            format!(
                "exponent of the stall torque above {} mN, 1 on the trend and 0 on a plateau: {}; a single motor agrees if it is nearer to the trend of its curve",
                1e3 * data.printed.plateau_n,
                words(&default, |trend| trend.high_torque_exponent),
            ),
        )
        .single_orbits(total(&default, |trend| trend.no_plateau)),
        Claim::printed_statement(
            "section5.no_sharp_rise",
            all(&second, |trend| trend.outside_over_inside[1] <= 1.0 + SHARP),
            format!("middle steady speed of the lowest and of the highest quarter of the motors beside the preloads of the trends, over that inside, at each A: {}", ratios(&second)),
        )
        .single_orbits(total(&second, |trend| trend.no_rise_above)),
        reduced_twist(data),
        bouncing_ends(data),
    ]
}

fn at_frequency(data: &Fig11Data, frequency_hz: f64) -> Vec<&Trend> {
    data.trends.iter().filter(|trend| trend.frequency_hz.total_cmp(&frequency_hz).is_eq()).collect()
}

/// Exponents, medians over all pairs of motors of a curve, by amplitude.
fn words(trends: &[&Trend], of: fn(&Trend) -> Option<f64>) -> String {
    let words = trends.iter().map(|trend| {
        let exponent = of(trend).map_or_else(|| "none".to_owned(), |exponent| format!("{exponent:+.3}"));
        format!("{}: {exponent}", trend.name())
    });
    words.collect::<Vec<_>>().join(", ")
}

fn ratios(trends: &[&Trend]) -> String {
    let words = trends.iter().map(|trend| {
        let [below, above] = trend.outside_over_inside;
        format!("{}: {below:.3} and {above:.3}", trend.name())
    });
    words.collect::<Vec<_>>().join(", ")
}

/// The first of the paper's explanations of what the simulations do not show.
fn reduced_twist(data: &Fig11Data) -> Claim {
    let [printed, reduced] = data.reduced_twist.steady_speeds_rad_per_s;
    let [full, part] = data.reduced_twist.peak_angular_speeds_rad_per_s;
    let error = (printed.standard_error * printed.standard_error
        + reduced.standard_error * reduced.standard_error)
        .sqrt();
    let torques = data.reduced_twist.stall_accelerations_rad_per_s2.map_or_else(String::new, |[one, other]| {
        format!(
            "; the stall acceleration is {:.2} ± {:.2} rad/s² instead of {:.2} ± {:.2}, so that it explains no plateau of the torque",
            other.mean, other.standard_error, one.mean, one.standard_error
        )
    });
    Claim::printed_statement(
        "section5.reduced_twist_lowers_speed",
        printed.mean - reduced.mean > STANDARD_ERRORS * error,
        format!(
            "the default motor at full preload turns at {:.2} ± {:.2} rad/s with ωΦ = {full} rad/s and at {:.2} ± {:.2} with {part}, {:.3} of it{torques}. Whether the \
             stator's twist falls with preload is beyond the model",
            printed.mean,
            printed.standard_error,
            reduced.mean,
            reduced.standard_error,
            reduced.mean / printed.mean,
        ),
    )
    .single_orbits(data.reduced_twist.slower)
}

/// The second one. A statement about the motor, whose restitution is an estimate.
fn bouncing_ends(data: &Fig11Data) -> Claim {
    let end = &data.end_of_bouncing;
    let [low, high] = end.restitutions;
    let coexisting = &end.coexisting;
    Claim::printed_statement(
        "section5.bouncing_ends",
        end.at_rest,
        format!(
            "of rotors with ε = {low} to {high} and Γ from 0 to 1/π, launched at random, {} come to rest for good. \"Can\" is right: period 1 needs Γ > (1 − ε)/(1 + ε) only, less than \
             1/π for ε > {:.4}, and at ε = {} and Γ = {:.4} rotors launched on it, or with 1 % more or less speed, {} after {} impacts. At the ε = 0.5 of Table III none bounces on",
            end.at_rest.words(),
            end.threshold_restitution,
            coexisting.restitution,
            coexisting.axial_forcing,
            if coexisting.bounces { "bounce" } else { "rest" },
            coexisting.impacts
        ),
    )
}
