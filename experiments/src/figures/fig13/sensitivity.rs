//! How steady speed and stall torque depend on the parameters. Each test is written once, over [`Effects`]: those of the means and
//! those of single orbits.

use bouncing_disk::core::numerics::elementary::ln;

use super::Study;
use super::effects::{Effects, Sensitivity, cosine_fit, speed, stall};
use crate::claims::{Cases, Claim, catalogue};
use crate::figures::shared::inputs::{Input, motor as inputs};
use crate::figures::shared::motor::MotorCase;
use crate::figures::shared::numbers::extent;

/// An exponent this near to 1 counts as proportional.
const PROPORTIONAL_WITHIN: f64 = 0.1;

/// A change over the range by more than this share is significant.
const SIGNIFICANT: f64 = 0.3;

/// Least share of the variance that a curve explains to be called that curve.
const EXPLAINED: f64 = 0.95;

pub(super) fn claims(study: &Study, persisting: &[(Input<MotorCase>, f64)]) -> Vec<Claim> {
    vec![
        cosine(study),
        amplitude(study),
        twist(study),
        friction(study),
        both(study),
        only_reduce(study, persisting),
        most_sensitive(
            study,
            "section5.speed_sensitivity",
            |of| of.speed_change,
            [inputs::PHASE_LAG, inputs::RESTITUTION, inputs::PEAK_ANGULAR_SPEED],
        ),
        most_sensitive(
            study,
            "section5.torque_sensitivity",
            |of| of.stall_change,
            [inputs::PHASE_LAG, inputs::RESTITUTION, inputs::FRICTION],
        ),
        restitution_lowers_both(study),
        simplistic(study),
    ]
}

/// A statement that the test decides: of the means, and of each single orbit.
#[track_caller]
fn judged(study: &Study, key: &str, holds: impl Fn(&Effects) -> bool, evidence: String) -> Claim {
    let draws = study.alike.draws.iter().map(&holds);
    Claim::printed_statement(key, holds(&study.mean), evidence).single_orbits(Cases::of(draws))
}

/// Those of the means with this parameter, if it was varied.
fn of(effects: &Effects, parameter: Input<MotorCase>, test: impl Fn(&Sensitivity) -> bool) -> bool {
    effects.parameter(parameter).is_some_and(test)
}

/// The least and the largest value of a parameter that is varied.
fn range(study: &Study, parameter: Input<MotorCase>) -> (f64, f64) {
    extent(study.points(parameter).iter().map(|point| point.value))
}

/// Whether a power law of this exponent changes by less than a significant share over the range of a
/// parameter.
fn is_insignificant(study: &Study, parameter: Input<MotorCase>, exponent: Option<f64>) -> bool {
    let (low, high) = range(study, parameter);
    exponent.is_some_and(|exponent| exponent.abs() * ln(high / low) < ln(1.0 + SIGNIFICANT))
}

/// The exponents of a parameter in the means of speed and stall torque, in words.
fn exponents(study: &Study, parameter: Input<MotorCase>) -> [String; 2] {
    let own = study.mean.parameter(parameter);
    let words = |exponent: Option<f64>| exponent.map_or_else(|| "none".to_owned(), |of| format!("{of:+.3}"));
    [own.and_then(|own| own.speed_exponent), own.and_then(|own| own.stall_exponent)].map(words)
}

fn cosine(study: &Study) -> Claim {
    let [.., by_lag, _, _] = &study.varied;
    let nothing = (f64::NAN, f64::NAN);
    let [(of_speed, speed_explained), (of_stall, stall_explained)] =
        [by_lag.points(speed), by_lag.points(stall)].map(|points| cosine_fit(&points).unwrap_or(nothing));
    let is_cosine = |share: Option<f64>| share.is_some_and(|share| share >= EXPLAINED);
    judged(
        study,
        "section5.cosine_of_phase_lag",
        |of| is_cosine(of.speed_cosine) && is_cosine(of.stall_cosine),
        format!(
            "{:.3} cos θ explains {:.1} % of the variance of speed/(ωΦ), {of_stall:.1} cos θ {:.1} % of that of α̇_ss/t_c; {:.0} % are required",
            of_speed / study.motor.peak_angular_speed_rad_per_s,
            100.0 * speed_explained,
            100.0 * stall_explained,
            100.0 * EXPLAINED,
        ),
    )
}

fn amplitude(study: &Study) -> Claim {
    let [of_speed, of_stall] = exponents(study, inputs::AMPLITUDE);
    let small = |exponent| is_insignificant(study, inputs::AMPLITUDE, exponent);
    judged(
        study,
        "section5.amplitude_insensitivity",
        |effects| of(effects, inputs::AMPLITUDE, |of| small(of.speed_exponent) && small(of.stall_exponent)),
        format!(
            "exponents {of_speed} of A in the speed and {of_stall} in α̇_ss/t_c: less than {:.0} % over the range; single orbits at the three printed amplitudes",
            100.0 * SIGNIFICANT,
        ),
    )
    .cause("short cycles in the sweep of A")
}

fn twist(study: &Study) -> Claim {
    let [of_speed, of_stall] = exponents(study, inputs::PEAK_ANGULAR_SPEED);
    judged(
        study,
        "section5.torque_independent_of_twist",
        |effects| {
            of(effects, inputs::PEAK_ANGULAR_SPEED, |of| {
                is_insignificant(study, inputs::PEAK_ANGULAR_SPEED, of.stall_exponent)
            })
        },
        format!(
            "exponent {of_stall} of ωΦ in α̇_ss/t_c: less than {:.0} % over the range; in the speed {of_speed}",
            100.0 * SIGNIFICANT
        ),
    )
}

fn friction(study: &Study) -> Claim {
    let [of_speed, of_stall] = exponents(study, inputs::FRICTION);
    let linear = |of: &Sensitivity| {
        of.stall_exponent.is_some_and(|exponent| (exponent - 1.0).abs() <= PROPORTIONAL_WITHIN)
            && of.stall_explained.is_some_and(|explained| explained >= EXPLAINED)
    };
    let explained = study.mean.parameter(inputs::FRICTION).and_then(|of| of.stall_explained);
    judged(
        study,
        "section5.torque_linear_in_friction",
        |effects| of(effects, inputs::FRICTION, linear),
        format!(
            "exponent {of_stall} of μ in α̇_ss/t_c, a line explains {:.2} %; in the speed {of_speed}",
            100.0 * explained.unwrap_or(f64::NAN)
        ),
    )
}

/// The same effects over the one range that the paper prints, that of the measured ε; the others are not printed.
fn over_printed_range(study: &Study, effects: &Effects) -> Effects {
    let (low, high) = range(study, inputs::RESTITUTION);
    let printed = catalogue::number("section5.estimated_restitution", 0).ok();
    let width = 2.0 * printed.and_then(|printed| printed.uncertainty).unwrap_or(f64::NAN);
    let mut over = effects.clone();
    for own in over.sensitivities.iter_mut().filter(|own| own.parameter == inputs::RESTITUTION) {
        let shrink = |change: Option<f64>| change.map(|change| width / (high - low) * change);
        (own.speed_change, own.stall_change) = (shrink(own.speed_change), shrink(own.stall_change));
    }
    over
}

/// A number that is read off the trend of a parameter.
type Change = fn(&Sensitivity) -> Option<f64>;

/// The change by ε, in words.
fn by_restitution(effects: &Effects, change: Change) -> String {
    let own = effects.parameter(inputs::RESTITUTION).and_then(change);
    own.map_or_else(|| "none".to_owned(), |own| format!("{own:.2}"))
}

/// [`judged`]; no data if the range of ε decides.
#[track_caller]
fn judged_by_range(study: &Study, key: &str, holds: impl Fn(&Effects) -> bool, evidence: String) -> Claim {
    let printed = Cases::from(holds(&over_printed_range(study, &study.mean))).sampled();
    let draws = study.alike.draws.iter().map(&holds);
    Claim::printed_statement(key, holds(&study.mean), evidence)
        .by_definition(&[printed])
        .single_orbits(Cases::of(draws))
}

/// That the parameters `named` are those with the largest changes.
fn most_sensitive(study: &Study, key: &str, change: Change, named: [Input<MotorCase>; 3]) -> Claim {
    let are_largest = |effects: &Effects| {
        let mut changes: Vec<_> =
            effects.sensitivities.iter().filter_map(|own| Some((own.parameter, change(own)?))).collect();
        changes.sort_by(|one, other| other.1.total_cmp(&one.1));
        changes.len() == inputs::PANELS.len()
            && changes.iter().take(named.len()).all(|(parameter, _)| named.contains(parameter))
    };
    let words = study
        .mean
        .sensitivities
        .iter()
        .map(|own| format!("{} {:.2}", own.parameter.symbol, change(own).unwrap_or(f64::NAN)));
    judged_by_range(
        study,
        key,
        are_largest,
        format!(
            "changes: {}; over the printed range of ε {}",
            words.collect::<Vec<_>>().join(", "),
            by_restitution(&over_printed_range(study, &study.mean), change),
        ),
    )
}

/// That only θ and ε change both the steady speed and the stall torque.
fn both(study: &Study) -> Claim {
    let significant = |change: Option<f64>| change.is_some_and(|change| change > SIGNIFICANT);
    let only_named = |effects: &Effects| {
        effects.sensitivities.iter().all(|own| {
            let named = [inputs::RESTITUTION, inputs::PHASE_LAG].contains(&own.parameter);
            (significant(own.speed_change) && significant(own.stall_change)) == named
        })
    };
    let printed = over_printed_range(study, &study.mean);
    let words = |effects: &Effects| {
        let [speed, stall] = [|of: &Sensitivity| of.speed_change, |of: &Sensitivity| of.stall_change]
            .map(|change| by_restitution(effects, change));
        format!("{speed} and {stall}")
    };
    judged_by_range(
        study,
        "section5.both_sensitivity",
        only_named,
        format!(
            "ε changes speed and torque by {} over our range, by {} over the printed one",
            words(&study.mean),
            words(&printed)
        ),
    )
}

/// Whether θ and ε leave steady speed and stall torque below the maxima that ωΦ and μ set, wherever the transient is exponential;
/// `persisting` are the places where the means, and those of motors next to them, do not.
fn only_reduce(study: &Study, persisting: &[(Input<MotorCase>, f64)]) -> Claim {
    let [_, by_restitution, by_lag, ..] = &study.varied;
    let readings = || [by_restitution, by_lag].into_iter().flat_map(|sweep| &sweep.readings);
    let ramps = readings().filter(|reading| {
        !reading.is_exponential && reading.stall_over_limit.is_some_and(|stall| stall.abs() > 1.0)
    });
    let places: Vec<_> =
        persisting.iter().map(|(parameter, value)| format!("{} = {value:.2}", parameter.symbol)).collect();
    Claim::printed_statement(
        "section5.only_reduce",
        persisting.is_empty(),
        format!(
            "speeds up to {:.3} ωΦ; torques up to {:.2} μ a_e g/a_g², above it at and next to {}; {} ramps not counted",
            extent(readings().map(|reading| reading.speed_ratio.abs())).1,
            extent(readings().filter(|reading| reading.is_exponential).filter_map(|reading| reading.stall_over_limit)).1,
            if places.is_empty() { "none".to_owned() } else { places.join(", ") },
            ramps.count(),
        ),
    )
    .cause("a fitted slope that is no acceleration")
    .single_orbits(study.alike.prevalence.iter().map(|entry| entry.within_limit).sum())
}

/// Both fall with ε.
fn restitution_lowers_both(study: &Study) -> Claim {
    let [speeds, stalls] = study.mean.falls;
    judged(
        study,
        "section5.restitution_lowers_both",
        |of| of.falls.iter().all(|pairs| 2 * pairs.holding > pairs.tried),
        format!("of all pairs of ε the speed falls in {}, α̇_ss/t_c in {}", speeds.words(), stalls.words()),
    )
}

/// Ĥ/ΔT ~ μ g (1 + ε).
fn simplistic(study: &Study) -> Claim {
    // 1 + ε over its value at the first ε, less 1.
    let (first, last) = range(study, inputs::RESTITUTION);
    let predicted = (last - first) / (1.0 + first);
    judged(
        study,
        "section5.scaling_fails_for_restitution",
        |of| of.stall_over_limit_rise.is_some_and(|rise| rise < 0.5 * predicted),
        format!(
            "over the range of ε the scaling raises α̇_ss/t_c by {:.0} %, its mean changes by {:.0} %: the interval is (1 + ε)w_A/g, and the factor cancels",
            100.0 * predicted,
            100.0 * study.mean.stall_over_limit_rise.unwrap_or(f64::NAN),
        ),
    )
}
