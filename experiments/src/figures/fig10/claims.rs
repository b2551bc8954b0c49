//! What the paper says about Fig. 10.

use std::f64::consts::PI;

use super::data::{Alike, Fig10Data};
use crate::catalogue;
use crate::claim::{Agreement, Claim, all};
use crate::figures::alike::{AlikeMotor, INTERVALS};
use crate::figures::motor_case::{LOW_PERIOD_FLIGHTS, perturbation_claim};
use crate::figures::samples;

const ID: &str = "fig10";

pub(super) fn claims(data: &Fig10Data) -> Vec<Claim> {
    let mut claims = axial_forcings(data);
    claims.extend(transients(data));
    claims.push(perturbation_claim(
        ID,
        "Table III's motor: the steady speed does not depend on the size of the relaunch perturbation",
        &data.perturbations,
    ));
    claims
}

fn axial_forcings(data: &Fig10Data) -> Vec<Claim> {
    let merging = catalogue::number("section4.merging", 0).map_or(f64::NAN, |printed| printed.value);
    let motors = data.alike.motors.iter().flatten();
    let lowest = motors.clone().map(|motor| motor.axial_forcing).fold(f64::INFINITY, f64::min);
    vec![
        Claim::printed("section1.own_motor_axial_forcing", data.own_motor_axial_forcing)
            .note("ω read as 2π · 70 kHz, which this number confirms"),
        Claim::printed("section1.tsujino_axial_forcing", data.tsujino_axial_forcing).note(format!(
            "A ω²/g without the factor π is {:.1}, which rounds to the printed value: the π of the definition was left out",
            data.tsujino_peak_acceleration
        )),
        Claim::statement(
            ID,
            "Sec. I",
            "both motors that Sec. I names operate with Γ > 1/π",
            data.own_motor_axial_forcing.min(data.tsujino_axial_forcing) * PI > 1.0,
            format!("Γ = {:.2} and {:.2}", data.own_motor_axial_forcing, data.tsujino_axial_forcing),
        ),
        Claim::printed_share(
            "section4.motor_regime",
            Agreement::of(motors.map(|motor| motor.axial_forcing > merging)),
            format!("of all motors that print like Table III's at the three A the lowest Γ is {lowest:.2}"),
        ),
    ]
}

fn percent(value: f64) -> String {
    format!("{:.1} %", 100.0 * value)
}

/// The middle of some numbers, NaN of none: in words, and in comparisons that must fail then.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    samples::median(values).unwrap_or(f64::NAN)
}

fn transients(data: &Fig10Data) -> Vec<Claim> {
    let alike = &data.alike;
    let shares = |holds: fn(&AlikeMotor) -> bool| {
        let each = alike.motors.iter().map(|motors| {
            let agreement = Agreement::of(motors.iter().map(holds));
            agreement.share().map_or_else(|| "none".to_owned(), percent)
        });
        each.collect::<Vec<_>>().join(", ")
    };
    let medians = |of: fn(&AlikeMotor) -> f64| {
        alike.motors.iter().map(|motors| median(motors.iter().map(of))).collect::<Vec<f64>>()
    };
    let over =
        format!("motors that print alike ({}; nothing perturbs them), at 10⁻⁹, 10⁻⁸, 10⁻⁷ m", alike.inputs);
    let oscillations = medians(|motor| motor.oscillation).into_iter();
    let oscillations =
        oscillations.map(|value| format!("{:.2} %", 100.0 * value)).collect::<Vec<_>>().join(", ");
    let rates = medians(|motor| motor.impacts_per_s);
    let rises = |of: fn(&AlikeMotor) -> f64| {
        move |draw: [&AlikeMotor; 3]| draw.windows(2).all(|pair| of(pair[0]) < of(pair[1]))
    };
    let judged = |key: &str, holds: &dyn Fn([&AlikeMotor; 3]) -> bool, evidence: String| {
        let over = |alike: &Alike| Agreement::of(alike.draws().map(holds));
        let exactly = over(&data.exact_settings);
        Claim::printed_share(key, over(alike), evidence)
            .note(format!("with μ, ε, A and ωΦ exactly as printed it holds for {}", exactly.words()))
    };
    vec![
        judged(
            "section5.exponential_transients",
            &|draw| draw.into_iter().all(AlikeMotor::is_exponential),
            format!(
                "whether at all three A the exponential fits better than a linear rise to a constant; {over} it does for {} of the motors one \
                 by one. {}",
                shares(AlikeMotor::is_exponential),
                exception(data),
            ),
        ),
        judged(
            "section5.oscillation_grows",
            &rises(|motor| motor.oscillation),
            format!(
                "standard deviation of the speed (averaged over 1/{INTERVALS} of the time) from its straight line in the second half of the transient; median over {over}, as a share of ωΦ: \
                 {oscillations}"
            ),
        ),
        long_period_oscillates(data),
        judged(
            "section5.frequent_collisions",
            &rises(|motor| -motor.impacts_per_s),
            format!(
                "median number of impacts a second of {over}: {}",
                rates.iter().map(|rate| format!("{rate:.0}")).collect::<Vec<_>>().join(", ")
            ),
        ),
        judged(
            "section5.long_period_chattering",
            &|draw| draw.into_iter().all(|motor| !motor.cycle.is_low_period()),
            format!(
                "{} of {over}, are of low period (at most {LOW_PERIOD_FLIGHTS} flights of more than half a period from rest to rest)",
                shares(|motor| motor.cycle.is_low_period()),
            ),
        ),
    ]
}

/// Motors of long period must oscillate more than the middle one of those of low period at their amplitude.
fn long_period_oscillates(data: &Fig10Data) -> Claim {
    // What low period is, is not printed: the definition used everywhere decides, and others are shown.
    let is_low = |motor: &AlikeMotor, most: usize| {
        motor.cycle.chattering_flights().is_some_and(|flights| flights <= most)
    };
    let middles = |most: usize| {
        data.alike.motors.each_ref().map(|motors| {
            let low = motors.iter().filter(|motor| is_low(motor, most));
            median(low.map(|motor| motor.oscillation))
        })
    };
    let by_draw = |most: usize| {
        let middles = middles(most);
        let draws = data.alike.draws().filter_map(|draw| {
            let long = draw.into_iter().zip(middles).filter(|(motor, _)| !is_low(motor, most));
            all(long, |(motor, middle)| motor.oscillation > middle)
        });
        Agreement::of(draws)
    };
    let others = [2, 8, 16, 32].map(|most| format!("{most}: {}", by_draw(most).words()));
    let amplitudes = data.alike.motors.each_ref().map(|motors| {
        let of = |low: bool| {
            let chosen = motors.iter().filter(move |motor| is_low(motor, LOW_PERIOD_FLIGHTS) == low);
            chosen.map(|motor| 100.0 * motor.oscillation).collect::<Vec<f64>>()
        };
        let (long, low) = (of(false), of(true));
        format!(
            "{:.3} % ({} motors) and {:.3} % ({}, up to {:.3} %)",
            median(long.iter().copied()),
            long.len(),
            median(low.iter().copied()),
            low.len(),
            low.iter().copied().fold(0.0, f64::max),
        )
    });
    Claim::printed_share(
        "section5.oscillation_from_long_period",
        by_draw(LOW_PERIOD_FLIGHTS),
        format!(
            "a draw agrees if at every A at which it is of long period its speed varies more than that of the middle motor of low period; with low period up to another number of \
             flights than {LOW_PERIOD_FLIGHTS} that holds for {}. Median standard deviation of the speed from its straight line in the second half of the transient, as a share of ωΦ, of \
             motors of long and of low period at 10⁻⁹, 10⁻⁸, 10⁻⁷ m: {}",
            others.join("; "),
            amplitudes.join("; "),
        ),
    )
}

/// The cycle at exactly 9.8 m/s².
fn exception(data: &Fig10Data) -> String {
    let exception = &data.exception;
    let others = exception
        .others
        .iter()
        .map(|other| format!("g = {}: {}", other.preload_acceleration_m_per_s2, other.cycle.words()));
    format!(
        "At A = {:e} m and exactly g = {} m/s², A ω²/g is {:.6} times 2π² and the motor repeats a cycle of {}, its speed rising linearly \
         (deviation {:.3} rad/s, from the exponential {:.3} rad/s): an exception that ends at g = {:.7} and {:.7} m/s², {:.1e} of g wide. {}",
        exception.amplitude_m,
        exception.preload_acceleration_m_per_s2,
        exception.peak_acceleration_over_two_pi_squared,
        exception.cycle.words(),
        exception.ramp_residual_rad_per_s,
        exception.exponential_residual_rad_per_s,
        exception.lowest_preload_acceleration_m_per_s2,
        exception.highest_preload_acceleration_m_per_s2,
        exception.relative_width,
        others.collect::<Vec<_>>().join("; "),
    )
}
