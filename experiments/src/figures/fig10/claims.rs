//! What the paper says about Fig. 10.

use super::{Fig10Data, Transient};
use crate::claims::catalogue;
use crate::claims::{Cases, Claim, all};
use crate::figures::alike::{AlikeMotor, INTERVALS};
use crate::figures::motor_case::{DEFINITIONS, LOW_PERIOD_FLIGHTS, perturbation_claim};
use crate::figures::numbers;

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
        ))
        .cause("the π of Γ left out"),
        Claim::printed_statement(
            "section4.motor_regime",
            Cases::of(motors.map(|motor| motor.axial_forcing > merging)),
            format!("of all motors that print like Table III's at the three A the lowest Γ is {lowest:.2}"),
        ),
    ]
}

fn percent(value: f64) -> String {
    format!("{:.1} %", 100.0 * value)
}

/// The middle of some numbers, NaN of none: in words, and in comparisons that must fail then.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    numbers::median(values).unwrap_or(f64::NAN)
}

fn transients(data: &Fig10Data) -> Vec<Claim> {
    let alike = &data.alike;
    let shares = |holds: fn(&AlikeMotor) -> bool| {
        let each = alike.motors.iter().map(|motors| {
            let agreement = Cases::of(motors.iter().map(holds));
            agreement.share().map_or_else(|| "none".to_owned(), percent)
        });
        each.collect::<Vec<_>>().join(", ")
    };
    let single = format!("single orbits at 10⁻⁹, 10⁻⁸, 10⁻⁷ m ({}; nothing perturbs them)", alike.inputs);
    let ensembles = data.readings.first().map_or(&[][..], |reading| &reading.panels);
    let listed = |of: fn(&Transient) -> f64, scale: f64| {
        ensembles.iter().map(|panel| format!("{:.3}", scale * of(panel))).collect::<Vec<_>>().join(", ")
    };
    let mean_rises =
        |of: fn(&Transient) -> f64| all(ensembles.windows(2), |pair| of(&pair[0]) < of(&pair[1]));
    let rises = |of: fn(&AlikeMotor) -> f64| {
        move |draw: [&AlikeMotor; 3]| draw.windows(2).all(|pair| of(pair[0]) < of(pair[1]))
    };
    let over = |holds: &dyn Fn([&AlikeMotor; 3]) -> bool| Cases::of(alike.draws().map(holds));
    vec![
        Claim::printed_statement(
            "section5.exponential_transients",
            all(ensembles, |panel| panel.relative_oscillation < panel.relative_ramp_residual),
            format!(
                "whether the exponential fits better than a linear rise to a constant at all three A; residuals over the steady speed, mean of the members: {} % \
                 and {} %; of {single} it does for {}. {}",
                listed(|panel| panel.relative_oscillation, 1e2),
                listed(|panel| panel.relative_ramp_residual, 1e2),
                shares(AlikeMotor::is_exponential),
                exception(data),
            ),
        )
        .single_orbits(over(&|draw| draw.into_iter().all(AlikeMotor::is_exponential))),
        Claim::printed_statement(
            "section5.oscillation_grows",
            mean_rises(|panel| panel.relative_oscillation),
            format!(
                "deviation of the members from their fits, over the steady speed: {} %; of a single orbit the standard deviation of the speed (averaged over 1/{INTERVALS} \
                 of the time) from its straight line in the second half",
                listed(|panel| panel.relative_oscillation, 1e2),
            ),
        )
        .single_orbits(over(&rises(|motor| motor.oscillation))),
        long_period_oscillates(data),
        Claim::printed_statement(
            "section5.frequent_collisions",
            mean_rises(|panel| -panel.impacts_per_s),
            format!("impacts a millisecond at 10⁻⁹, 10⁻⁸, 10⁻⁷ m, those of summed chatters not counted: {}", listed(|panel| panel.impacts_per_s, 1e-3)),
        )
        .single_orbits(over(&rises(|motor| -motor.impacts_per_s))),
        long_period(data),
    ]
}

/// Low period under the definitions that are tried: cycles of at most so many flights.
fn is_low(motor: &AlikeMotor, most: usize) -> bool {
    motor.cycle.chattering_flights().is_some_and(|flights| flights <= most)
}

fn long_period(data: &Fig10Data) -> Claim {
    let by_draw =
        |most| Cases::of(data.alike.draws().map(|draw| draw.into_iter().all(|motor| !is_low(motor, most))));
    let others = DEFINITIONS.map(by_draw);
    let words = DEFINITIONS.iter().zip(others).map(|(most, cases)| format!("{most}: {}", cases.words()));
    Claim::printed_statement(
        "section5.long_period_chattering",
        by_draw(LOW_PERIOD_FLIGHTS),
        format!(
            "over single orbits ({}); low period is at most {LOW_PERIOD_FLIGHTS} flights of more than half a period from rest to rest. With other numbers of flights it holds for {}",
            data.alike.inputs,
            words.collect::<Vec<_>>().join("; "),
        ),
    )
    .by_definition(&others.map(Cases::sampled))
}

/// Motors of long period must oscillate more than the middle one of those of low period at their amplitude.
fn long_period_oscillates(data: &Fig10Data) -> Claim {
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
        Cases::of(draws)
    };
    let others = DEFINITIONS.map(by_draw);
    let words = DEFINITIONS.iter().zip(others).map(|(most, cases)| format!("{most}: {}", cases.words()));
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
    Claim::printed_statement(
        "section5.oscillation_from_long_period",
        by_draw(LOW_PERIOD_FLIGHTS),
        format!(
            "a draw agrees if at every A at which it is of long period its speed varies more than that of the middle motor of low period; with low period up to another number of \
             flights than {LOW_PERIOD_FLIGHTS} that holds for {}. Median standard deviation of the speed from its straight line in the second half of the transient, as a share of ωΦ, of \
             motors of long and of low period at 10⁻⁹, 10⁻⁸, 10⁻⁷ m: {}",
            words.collect::<Vec<_>>().join("; "),
            amplitudes.join("; "),
        ),
    )
    .by_definition(&others.map(Cases::sampled))
}

/// The cycle at exactly 9.8 m/s².
fn exception(data: &Fig10Data) -> String {
    let exception = &data.exception;
    format!(
        "At A = {:e} m and exactly g = {} m/s², A ω²/g is {:.6} times 2π² and the motor repeats a cycle of {}, its speed rising linearly \
         (deviation {:.3} rad/s, from the exponential {:.3} rad/s): an exception that ends at g = {:.4} and {:.4} m/s², {:.1e} of g wide",
        exception.amplitude_m,
        exception.preload_acceleration_m_per_s2,
        exception.peak_acceleration_over_two_pi_squared,
        exception.robust_cycle.words(),
        exception.ramp_residual_rad_per_s,
        exception.exponential_residual_rad_per_s,
        exception.lowest_preload_acceleration_m_per_s2,
        exception.highest_preload_acceleration_m_per_s2,
        exception.relative_width,
    )
}
