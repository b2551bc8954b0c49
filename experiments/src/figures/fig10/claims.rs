//! The statements of the paper about Fig. 10.

use super::data::{Fig10Data, Transient};
use crate::claims::{Cases, Claim, all, catalogue};
use crate::figures::shared::alike::{AlikeMotor, INTERVALS};
use crate::figures::shared::motor::{DEFINITIONS, LOW_PERIOD_FLIGHTS, by_definition_words};
use crate::figures::shared::numbers::median;

pub(super) fn claims(data: &Fig10Data) -> Vec<Claim> {
    let mut claims = axial_forcings(data);
    claims.extend(transients(data));
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
            all(ensembles, |panel| panel.relative_exponential_residual < panel.relative_ramp_residual),
            format!(
                "the exponential fits better than a linear rise to a constant at all three A: residuals {} % and {} % of the steady speed, mean of the members; of {single} it does for {}",
                listed(|panel| panel.relative_exponential_residual, 1e2),
                listed(|panel| panel.relative_ramp_residual, 1e2),
                shares(AlikeMotor::is_exponential),
            ),
        )
        .single_orbits(over(&|draw| draw.into_iter().all(AlikeMotor::is_exponential))),
        Claim::printed_statement(
            "section5.oscillation_grows",
            mean_rises(|panel| panel.oscillation),
            format!(
                "standard deviation of the speed (averaged over 1/{INTERVALS} of the time) from its straight line in the second half, as a share of ωΦ, mean of the members: {} %; \
                 of single orbits the same",
                listed(|panel| panel.oscillation, 1e2),
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
        transient_chaos(data),
    ]
}

fn long_period(data: &Fig10Data) -> Claim {
    let by_draw = |most| {
        Cases::of(data.alike.draws().map(|draw| draw.into_iter().all(|motor| !motor.cycle.is_low(most))))
    };
    let others = DEFINITIONS.map(by_draw);
    Claim::printed_statement(
        "section5.long_period_chattering",
        by_draw(LOW_PERIOD_FLIGHTS),
        format!(
            "over single orbits ({}); low period is at most {LOW_PERIOD_FLIGHTS} flights of more than half a period from rest to rest. With other numbers of flights it holds for {}",
            data.alike.inputs,
            by_definition_words(others),
        ),
    )
    .by_definition(&others.map(Cases::sampled))
}

/// Chaos that a rest ends.
fn transient_chaos(data: &Fig10Data) -> Claim {
    let between = &data.alike.between_rests;
    let words = between.iter().map(|of| {
        format!(
            "{:e} m: {}, by a factor e^{:.1} an impact over {:.0} impacts (medians)",
            of.amplitude_m,
            of.grows.words(),
            of.growth_per_impact.unwrap_or(f64::NAN),
            of.impacts.unwrap_or(f64::NAN),
        )
    });
    Claim::printed_statement(
        "section5.transient_chaos",
        between.iter().map(|of| of.grows).sum::<Cases>(),
        format!(
            "motors in which a small perturbation of the vertical motion grows between two rests as in a chaotic attractor: {}; the rest ends it",
            words.collect::<Vec<_>>().join("; "),
        ),
    )
}

/// Motors of long period must oscillate more than the middle one of those of low period at their amplitude.
fn long_period_oscillates(data: &Fig10Data) -> Claim {
    let middles = |most: usize| {
        data.alike.motors.each_ref().map(|motors| {
            let low = motors.iter().filter(|motor| motor.cycle.is_low(most));
            // A comparison with NaN fails.
            median(low.map(|motor| motor.oscillation)).unwrap_or(f64::NAN)
        })
    };
    let by_draw = |most: usize| {
        let middles = middles(most);
        let draws = data.alike.draws().filter_map(|draw| {
            let long = draw.into_iter().zip(middles).filter(|(motor, _)| !motor.cycle.is_low(most));
            all(long, |(motor, middle)| motor.oscillation > middle)
        });
        Cases::of(draws)
    };
    let others = DEFINITIONS.map(by_draw);
    Claim::printed_statement(
        "section5.oscillation_from_long_period",
        by_draw(LOW_PERIOD_FLIGHTS),
        format!(
            "a draw agrees if at every A at which it is of long period its speed varies more than that of the middle motor of low period; with low period up to another number of \
             flights than {LOW_PERIOD_FLIGHTS} that holds for {}",
            by_definition_words(others),
        ),
    )
    .by_definition(&others.map(Cases::sampled))
}
