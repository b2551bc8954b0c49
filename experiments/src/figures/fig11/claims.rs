//! What the paper says about Fig. 11.

use std::f64::consts::FRAC_1_PI;

use super::data::{Fig11Data, Power, Trend};
use super::trends::{EXPONENT_WITHIN, OTHER_BOUNDS, SHARP};
use crate::claim::{Agreement, Claim, all};
use crate::figures::motor_case::perturbation_claim;

const ID: &str = "fig11";

const SECTION: &str = "Sec. V B";

/// An exponent of the stall torque above this is nearer to the trend (1) than to a plateau (0).
const NEARER_TO_TREND: f64 = 0.5;

/// A difference of more than so many standard errors is one.
const STANDARD_ERRORS: f64 = 3.0;

/// The two speeds of a mirrored motor are of opposite sign to this share of ωΦ: fits keep half of the digits.
const MIRRORED_WITHIN: f64 = 1e-6;

pub(super) fn claims(data: &Fig11Data) -> Vec<Claim> {
    let [default, second] = data.printed.frequencies_hz.map(|frequency| at_frequency(data, frequency));
    let mut claims = vec![
        Claim::printed_share(
            "section5.torque_proportional_to_preload",
            default.iter().map(|trend| trend.torque).sum::<Agreement>(),
            format!(
                "a motor agrees if its stall torque over preload is within {} % of the middle one of its curve{}; {}",
                100.0 * SHARP,
                other_bounds(&default, |trend| trend.torque_for_other_bounds),
                counted(&default, |trend| trend.torque)
            ),
        ),
        Claim::printed_share(
            "section5.speed_independent_of_preload",
            default.iter().map(|trend| trend.speed).sum::<Agreement>(),
            format!(
                "a motor agrees if its steady speed is within {} % of the middle one of its curve{}; {}",
                100.0 * SHARP,
                other_bounds(&default, |trend| trend.speed_for_other_bounds),
                counted(&default, |trend| trend.speed)
            ),
        ),
        same_trends(data, &default, &second),
        Claim::printed_share(
            "section5.no_sharp_fall",
            default.iter().map(|trend| trend.no_fall).sum::<Agreement>(),
            format!(
                "a motor below or above the preloads of the trends agrees if it is not slower by more than {} % than the middle of those inside: {}; \
                 without the motors on a low-period cycle {}",
                100.0 * SHARP,
                share_words(&default, |trend| trend.no_fall),
                share_words(&default, |trend| trend.no_fall_without),
            ),
        ),
        plateau(data, &default),
        Claim::printed_share(
            "section5.no_sharp_rise",
            second.iter().map(|trend| trend.no_rise_above).sum::<Agreement>(),
            format!(
                "a motor above the preloads of the trends agrees if it is not faster by more than {} % than the middle of those inside: {}",
                100.0 * SHARP,
                share_words(&second, |trend| trend.no_rise_above),
            ),
        ),
        reduced_twist(data),
        bouncing_ends(data),
        without_low_period_torque(data),
        without_low_period_speed(data),
        without_low_period_sharp(data),
        holes(data),
        still_bouncing(data),
        balance(data),
        estimate(data),
        mirrored(data),
    ];
    for (frequency, table) in data.printed.frequencies_hz.iter().zip(&data.perturbations) {
        let quantity = format!(
            "at {} kHz and the middle of the preloads the steady speed does not depend on the size of the relaunch perturbation",
            frequency / 1e3
        );
        claims.push(perturbation_claim(ID, &quantity, table));
    }
    claims
}

fn at_frequency(data: &Fig11Data, frequency_hz: f64) -> Vec<&Trend> {
    data.trends.iter().filter(|trend| trend.frequency_hz.total_cmp(&frequency_hz).is_eq()).collect()
}

/// How many agree, by amplitude, and what the motors on a low-period cycle have to do with it.
fn counted(trends: &[&Trend], of: fn(&Trend) -> Agreement) -> String {
    let sum = |count: fn(&Trend) -> usize| trends.iter().map(|trend| count(trend)).sum::<usize>();
    format!(
        "{}; of {} motors on a low-period cycle {} have speed and torque on the trend; {} motors have no stall torque, since no curve fits their transients",
        share_words(trends, of),
        sum(|trend| trend.low_period),
        sum(|trend| trend.low_period_on_trend),
        sum(|trend| trend.without_torque),
    )
}

/// How many agree with other bounds than [`SHARP`].
fn other_bounds(trends: &[&Trend], of: fn(&Trend) -> [Agreement; 2]) -> String {
    let words = OTHER_BOUNDS.iter().enumerate().map(|(index, bound)| {
        let Agreement { holding, tried } = trends.iter().map(|trend| of(trend)[index]).sum::<Agreement>();
        format!("{holding} of {tried} with {:.0} %", 100.0 * bound)
    });
    format!(" ({})", words.collect::<Vec<_>>().join(", "))
}

fn share_words(trends: &[&Trend], of: fn(&Trend) -> Agreement) -> String {
    let words = trends.iter().map(|trend| {
        let Agreement { holding, tried } = of(trend);
        format!("{}: {holding} of {tried}", trend.name())
    });
    words.collect::<Vec<_>>().join(", ")
}

fn power_words(trends: &[&Trend], of: fn(&Trend) -> Option<Power>) -> String {
    let words = trends.iter().map(|trend| {
        let power = of(trend).map_or_else(|| "no fit".to_owned(), Power::words);
        format!("{} Hz, {}: {power}", trend.frequency_hz, trend.name())
    });
    words.collect::<Vec<_>>().join("; ")
}

/// That the exponents of speed and torque are the same at both frequencies, amplitude by amplitude.
fn same_trends(data: &Fig11Data, default: &[&Trend], second: &[&Trend]) -> Claim {
    let pairs: Vec<(&Trend, &Trend)> = default.iter().copied().zip(second.iter().copied()).collect();
    let exponents = |trend: &Trend| Some([trend.torque_exponent?, trend.speed_exponent?]);
    let alike = |one: &Trend, other: &Trend| {
        exponents(one).zip(exponents(other)).is_some_and(|(one, other)| {
            one.iter().zip(other).all(|(one, other)| (one - other).abs() <= EXPONENT_WITHIN)
        })
    };
    let words = pairs.iter().flat_map(|(one, other)| [one, other]).map(|trend| {
        let [torque, speed] = exponents(trend).unwrap_or([f64::NAN; 2]);
        format!("{} kHz, {}: {torque:+.3} and {speed:+.3}", 1e-3 * trend.frequency_hz, trend.name())
    });
    Claim::printed_statement(
        "section5.both_frequencies",
        all(&pairs, |(one, other)| alike(one, other)),
        format!(
            "whether the exponents of stall torque and steady speed against preload differ by at most {EXPONENT_WITHIN} between the frequencies at each A; medians over all \
             pairs of motors inside, those on a low-period cycle among them: {}. Without these: torque {}; speed {}. On the trend of their curve are at {} kHz {}; at {} kHz {}",
            words.collect::<Vec<_>>().join("; "),
            power_words(&data.trends.iter().collect::<Vec<_>>(), |trend| trend.torque_power),
            power_words(&data.trends.iter().collect::<Vec<_>>(), |trend| trend.speed_power),
            data.printed.frequencies_hz[0] / 1e3,
            counted(default, |trend| trend.both),
            data.printed.frequencies_hz[1] / 1e3,
            counted(second, |trend| trend.both),
        ),
    )
}

/// The stall torque above the preload of the measured plateau. A plateau belongs to a curve and not to a motor: next to its beginning the two differ by less than the scatter.
fn plateau(data: &Fig11Data, default: &[&Trend]) -> Claim {
    let exponents = default.iter().map(|trend| {
        let exponent = trend.high_torque_exponent.unwrap_or(f64::NAN);
        format!("{}: {exponent:.2}", trend.name())
    });
    let nearer = default.iter().map(|trend| trend.no_plateau).sum::<Agreement>();
    Claim::printed_statement(
        "section5.no_plateau",
        all(default, |trend| trend.high_torque_exponent.is_some_and(|exponent| exponent > NEARER_TO_TREND)),
        format!(
            "exponent of the stall torque above {} mN, 1 on the trend of its curve and 0 on a plateau, the median over all pairs of motors, those on a low-period cycle among them; above \
             {NEARER_TO_TREND} is nearer to the trend: {}; without these: {}. Motor by motor {} are nearer to the trend of their curve than to a plateau",
            1e3 * data.printed.plateau_n,
            exponents.collect::<Vec<_>>().join("; "),
            power_words(default, |trend| trend.high_torque_power_without),
            nearer.words(),
        ),
    )
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
}

/// The second one.
fn bouncing_ends(data: &Fig11Data) -> Claim {
    let end = &data.end_of_bouncing;
    let [low, high] = end.restitutions;
    Claim::printed_share(
        "section5.bouncing_ends",
        end.at_rest,
        format!(
            "rotors with ε = {low} to {high} and Γ from 0 to 1/π, launched at random phases with up to {:.0} g/ω: {} of {} come to rest for good, after {} impacts \
             at most. A periodic orbit, which needs no separation from rest, exists for part of these ε and Γ only and attracts few starts",
            end.largest_launch_speed, end.at_rest.holding, end.at_rest.tried, end.most_impacts
        ),
    )
}

fn still_bouncing(data: &Fig11Data) -> Claim {
    let end = &data.end_of_bouncing;
    let coexisting = &end.coexisting;
    Claim::statement(
        ID,
        SECTION,
        "a rotor that bounces already can go on bouncing at Γ < 1/π if ε is large enough",
        coexisting.bounces && coexisting.axial_forcing < FRAC_1_PI,
        format!(
            "the period-1 orbit needs Γ > (1 − ε)/(1 + ε), less than 1/π = {FRAC_1_PI:.4} for ε > {:.4}; at ε = {} and Γ = {:.4} a rotor launched on it bounces after {} \
             impacts",
            end.threshold_restitution, coexisting.restitution, coexisting.axial_forcing, coexisting.impacts
        ),
    )
}

fn without_low_period_torque(data: &Fig11Data) -> Claim {
    let holds = |trend: &Trend| {
        trend.torque_power.is_some_and(|power| (power.exponent - 1.0).abs() <= EXPONENT_WITHIN)
    };
    let trends: Vec<&Trend> = data.trends.iter().collect();
    Claim::statement(
        ID,
        SECTION,
        "without the motors on a low-period cycle the stall torque is proportional to preload at every amplitude and both frequencies",
        all(&trends, |trend| holds(trend)),
        format!(
            "exponent of stall acceleration against preload, within {EXPONENT_WITHIN} of 1: {}",
            power_words(&trends, |trend| trend.torque_power)
        ),
    )
}

fn without_low_period_speed(data: &Fig11Data) -> Claim {
    let holds = |trend: &Trend| {
        trend
            .speed_power
            .is_some_and(|power| power.exponent.abs() + 2.0 * power.standard_error <= EXPONENT_WITHIN)
    };
    let trends: Vec<&Trend> = data.trends.iter().collect();
    Claim::statement(
        ID,
        SECTION,
        "without the motors on a low-period cycle the steady speed does not depend on preload at any amplitude and frequency",
        all(&trends, |trend| holds(trend)),
        format!(
            "exponent of steady speed against preload, within {EXPONENT_WITHIN} of 0 with two standard errors: {}",
            power_words(&trends, |trend| trend.speed_power)
        ),
    )
}

fn without_low_period_sharp(data: &Fig11Data) -> Claim {
    let trends: Vec<&Trend> = data.trends.iter().collect();
    let whole = |agreement: Agreement| agreement.tried > 0 && agreement.holding == agreement.tried;
    let speeds = trends.iter().filter_map(|trend| {
        trend.outside_without_rad_per_s.map(|[slow, fast]| {
            format!(
                "{} Hz, {}: {slow:.1} to {fast:.1} rad/s, inside {:.1}",
                trend.frequency_hz,
                trend.name(),
                trend.median_speed_rad_per_s
            )
        })
    });
    let speeds = speeds.collect::<Vec<_>>().join("; ");
    Claim::statement(
        ID,
        SECTION,
        "without the motors on a low-period cycle no steady speed falls sharply at low or high preload, or rises sharply at high preload",
        all(&trends, |trend| whole(trend.no_fall_without) && whole(trend.no_rise_above_without)),
        format!("steady speeds outside the preloads of the trends: {speeds}"),
    )
}

/// What the trends' holes are.
fn holes(data: &Fig11Data) -> Claim {
    let holes = &data.holes;
    let range = |extent: Option<[f64; 2]>, digits: usize| {
        extent.map_or_else(|| "none".to_owned(), |[low, high]| format!("{low:.digits$} to {high:.digits$}"))
    };
    let slower = holes
        .one_flight_speeds_rad_per_s
        .zip(holes.other_speeds_rad_per_s)
        .map(|([_, fastest], [slowest, _])| fastest < slowest);
    Claim::statement(
        ID,
        SECTION,
        "motors on a chattering cycle of a single flight turn more slowly than all that are on no low-period cycle",
        slower,
        format!(
            "{} of {} motors are on a low-period cycle, {} of them of a single flight: it lasts about Γ periods, and where the \
             fraction of Γ is {} it ends near τ = π, where the stator recedes as fast as the rotor \
             falls. Such a rotor lands softly, rides up with the stator through a half cycle in which cos τ takes both \
             signs equally, and hardly turns: {} rad/s; all on a low-period cycle {} rad/s, all others {} rad/s",
            holes.low_period,
            holes.motors,
            holes.one_flight,
            range(holes.one_flight_fractions, 3),
            range(holes.one_flight_speeds_rad_per_s, 1),
            range(holes.low_period_speeds_rad_per_s, 1),
            range(holes.other_speeds_rad_per_s, 1),
        ),
    )
}

fn stall_words(data: &Fig11Data) -> String {
    let words = data
        .stalls
        .iter()
        .map(|at| format!("{} kHz, {:.0} mN: {}", at.frequency_hz / 1e3, at.preload_mn, at.stall.words()));
    words.collect::<Vec<_>>().join("; ")
}

fn balance(data: &Fig11Data) -> Claim {
    Claim::statement(
        ID,
        "this work",
        "the load torque that stalls the motor is μ a_e m g S(0), S(0) the net share of the normal impulse that pushes a rotor at rest forwards",
        all(&data.stalls, |at| at.stall.balance_deviation() <= STANDARD_ERRORS),
        format!(
            "load torques over m a_g² at which the mean speed over {} rise times is zero, {} members each: {}. Friction can give {:.1e} of the stator's largest angular \
             acceleration at most, so that it nowhere holds the rotor at rest",
            data.stalls.first().map_or(0.0, |at| at.stall.rises),
            data.stalls.first().map_or(0, |at| at.stall.members),
            stall_words(data),
            data.stalls.iter().map(|at| at.stall.hold_share).fold(0.0, f64::max),
        ),
    )
}

fn estimate(data: &Fig11Data) -> Claim {
    let [least, most] = data.estimate_over_balance;
    Claim::statement(
        ID,
        "Sec. V C",
        "α̇_ss/t_c is the acceleration by the torque that stalls the motor",
        all(&data.stalls, |at| at.stall.estimate_off.abs() <= STANDARD_ERRORS * at.stall.estimate_off_error),
        format!(
            "the paper calls the initial slope of the fitted exponential the stall torque. {}. Over all motors of the figure in the range of the trends, without those on a \
             low-period cycle, α̇_ss/t_c is {least:.2} to {most:.2}, on average {:.2}, of (μ a_e g/a_g²) S(0)",
            stall_words(data),
            data.mean_estimate_over_balance,
        ),
    )
}

/// The direction of the rotor.
fn mirrored(data: &Fig11Data) -> Claim {
    let [one, other] = data.mirrored.steady_speeds_rad_per_s;
    Claim::statement(
        ID,
        "Fig. 11 caption",
        "a phase lag shifted by π turns the same motor as fast the other way",
        (one.mean + other.mean).abs() <= MIRRORED_WITHIN * data.motor.peak_angular_speed_rad_per_s
            && one.mean.abs() > STANDARD_ERRORS * one.standard_error,
        format!(
            "at {} kHz and {:.0} mN: {:.3} rad/s with θ = {}, {:.3} rad/s with θ = {:.4}. Such a lag of the second resonance would explain its direction; the paper does not \
             give one",
            data.printed.frequencies_hz[1] / 1e3,
            data.mirrored.preload_mn,
            one.mean,
            data.mirrored.phase_lags_rad[0],
            other.mean,
            data.mirrored.phase_lags_rad[1],
        ),
    )
    .identity()
}
