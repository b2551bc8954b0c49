//! How steady speed and stall torque depend on the parameters.

use bouncing_disk::core::numerics::elementary::ln;

use super::data::{
    Draw, Fig13Data, Parameter, Quantity, Sensitivity, SweepPoint, cosine_fit, extent, low_period_words,
    read, speed, stall, stall_over_limit, sweep, trend_change,
};
use crate::claims::{Cases, Claim};
use crate::figures::shared::numbers::{self, StraightLine};

/// An exponent this near to 1 counts as proportional.
const PROPORTIONAL_WITHIN: f64 = 0.1;

/// Why α̇_ss/t_c can be above the limit.
const NO_ACCELERATION: &str = "an initial slope of a fit that is no acceleration";

/// A change over the range by more than this share is significant.
const SIGNIFICANT: f64 = 0.3;

/// The least and the largest value of a parameter that is varied.
fn range(data: &Fig13Data, parameter: Parameter) -> (f64, f64) {
    extent(sweep(data, parameter).into_iter().flat_map(|sweep| &sweep.points).map(|point| point.value))
}

/// Whether a power law of this exponent changes by less than a significant share over the range of a
/// parameter.
fn is_insignificant(data: &Fig13Data, parameter: Parameter, exponent: f64) -> bool {
    let (low, high) = range(data, parameter);
    exponent.abs() * ln(high / low) < ln(1.0 + SIGNIFICANT)
}

/// Least share of the variance that a curve explains to be called that curve.
const EXPLAINED: f64 = 0.95;

pub(super) fn cosine(data: &Fig13Data) -> Claim {
    let top = data.motor.peak_angular_speed_rad_per_s;
    let ratio: Vec<_> = read(data, Parameter::PhaseLag, speed)
        .into_iter()
        .map(|(angle, speed)| (angle, speed / top))
        .collect();
    let nothing = (f64::NAN, f64::NAN);
    let (factor, explained) = cosine_fit(&ratio).unwrap_or(nothing);
    let (stall_factor, stall_explained) =
        cosine_fit(&read(data, Parameter::PhaseLag, stall)).unwrap_or(nothing);
    let draws = &data.alike.draws;
    let is_cosine = |share: Option<f64>| share.is_some_and(|share| share >= EXPLAINED);
    let speeds = Cases::of(draws.iter().map(|draw| is_cosine(draw.speed_cosine)));
    let stalls = Cases::of(draws.iter().map(|draw| is_cosine(draw.stall_cosine)));
    Claim::printed_statement(
        "section5.cosine_of_phase_lag",
        explained >= EXPLAINED && stall_explained >= EXPLAINED,
        format!(
            "whether a cosine of θ explains {:.0} % of the variance: steady speed/(ωΦ) = {factor:.3} cos θ explains {:.2} %, stall acceleration = {stall_factor:.1} cos θ {:.2} %. Of single orbits \
             the speed follows one for {}, α̇_ss/t_c for {}",
            100.0 * EXPLAINED,
            100.0 * explained,
            100.0 * stall_explained,
            speeds.words(),
            stalls.words(),
        ),
    )
    .single_orbits(Cases::of(draws.iter().map(|draw| is_cosine(draw.speed_cosine) && is_cosine(draw.stall_cosine))))
}

/// The exponent of a parameter in a mean that the figure draws, those of motors on a low-period cycle among
/// them.
fn exponent(data: &Fig13Data, parameter: Parameter, of: Quantity) -> f64 {
    numbers::median_exponent(read(data, parameter, of)).unwrap_or(f64::NAN)
}

pub(super) fn amplitude(data: &Fig13Data) -> Claim {
    let [of_speed, of_stall] = [speed as Quantity, stall].map(|of| exponent(data, Parameter::Amplitude, of));
    let small = |exponent: f64| is_insignificant(data, Parameter::Amplitude, exponent);
    let single = agreement(data, Parameter::Amplitude, |of| {
        [of.speed_exponent, of.stall_exponent].into_iter().all(|one| one.is_some_and(small))
    });
    Claim::printed_statement(
        "section5.amplitude_insensitivity",
        small(of_speed) && small(of_stall),
        format!(
            "whether the powers of A change by less than {:.0} % over its range: exponents {of_speed:+.3} of the speed and {of_stall:+.3} of α̇_ss/t_c, {}; single orbits at the three printed \
             amplitudes",
            100.0 * SIGNIFICANT,
            low_period_words(data, Parameter::Amplitude),
        ),
    )
    .cause("short cycles in the sweep of A")
    .single_orbits(single)
}

/// The agreement of the motors that print alike on what a parameter changes.
fn agreement(data: &Fig13Data, parameter: Parameter, holds: impl Fn(&Sensitivity) -> bool) -> Cases {
    let draws = data.alike.draws.iter();
    Cases::of(draws.map(|draw| draw.sensitivity(parameter).is_some_and(&holds)))
}

pub(super) fn twist(data: &Fig13Data) -> Claim {
    let mean = exponent(data, Parameter::PeakAngularSpeed, stall);
    let small = |exponent: f64| is_insignificant(data, Parameter::PeakAngularSpeed, exponent);
    let single = agreement(data, Parameter::PeakAngularSpeed, |of| of.stall_exponent.is_some_and(small));
    Claim::printed_statement(
        "section5.torque_independent_of_twist",
        small(mean),
        format!(
            "whether the power of ωΦ in α̇_ss/t_c changes by less than {:.0} % over its range: exponent {mean:+.3}; that of the steady speed is {:+.3}",
            100.0 * SIGNIFICANT,
            exponent(data, Parameter::PeakAngularSpeed, speed)
        ),
    )
    .single_orbits(single)
}

pub(super) fn friction(data: &Fig13Data) -> Claim {
    let mean = exponent(data, Parameter::Friction, stall);
    let explained = StraightLine::through(&read(data, Parameter::Friction, stall))
        .map_or(f64::NAN, |line| line.explained);
    let linear = |exponent: f64, explained: f64| {
        (exponent - 1.0).abs() <= PROPORTIONAL_WITHIN && explained >= EXPLAINED
    };
    let single = agreement(data, Parameter::Friction, |of| {
        of.stall_exponent
            .zip(of.stall_explained)
            .is_some_and(|(exponent, explained)| linear(exponent, explained))
    });
    Claim::printed_statement(
        "section5.torque_linear_in_friction",
        linear(mean, explained),
        format!(
            "whether the exponent of μ in α̇_ss/t_c is within {PROPORTIONAL_WITHIN} of 1 and a straight line explains {:.0} % of the variance: {mean:+.3} and {:.2} %; the exponent in the steady \
             speed is {:+.3}",
            100.0 * EXPLAINED,
            100.0 * explained,
            exponent(data, Parameter::Friction, speed),
        ),
    )
    .single_orbits(single)
}

/// The numbers that are read off the trend of a parameter.
type Change = fn(&Sensitivity) -> Option<f64>;

pub(super) fn speed_change(of: &Sensitivity) -> Option<f64> {
    of.speed_change
}

pub(super) fn stall_change(of: &Sensitivity) -> Option<f64> {
    of.stall_change
}

/// The effect of each parameter on the means that the figure draws, by the same measure as in a single orbit.
fn mean_changes(data: &Fig13Data, of: Quantity, default: Option<f64>) -> Vec<(Parameter, f64)> {
    let change = |parameter: Parameter| {
        let points = read(data, parameter, of);
        (
            parameter,
            trend_change(parameter, &points)
                .zip(default)
                .map_or(f64::NAN, |(change, default)| (change / default).abs()),
        )
    };
    Parameter::ALL.map(change).to_vec()
}

fn mean_speed_changes(data: &Fig13Data) -> Vec<(Parameter, f64)> {
    mean_changes(data, speed, Some(data.default.steady_speed_rad_per_s.mean))
}

fn mean_stall_changes(data: &Fig13Data) -> Vec<(Parameter, f64)> {
    mean_changes(data, stall, data.default.stall_acceleration_rad_per_s2.map(|spread| spread.mean))
}

fn change_words(changes: &[(Parameter, f64)]) -> String {
    let words = changes.iter().map(|(parameter, change)| format!("{} {change:.2}", parameter.symbol()));
    words.collect::<Vec<_>>().join(", ")
}

/// The effect of ε, in words.
fn of_restitution(changes: &[(Parameter, f64)]) -> String {
    let own = changes.iter().find(|(parameter, _)| *parameter == Parameter::Restitution);
    own.map_or_else(|| "none".to_owned(), |(_, change)| format!("{change:.2}"))
}

/// The same changes over the one range that the paper prints, that of the measured ε; the others are not
/// printed.
fn over_printed_range(data: &Fig13Data, changes: &[(Parameter, f64)]) -> Vec<(Parameter, f64)> {
    let (low, high) = range(data, Parameter::Restitution);
    let printed = crate::claims::catalogue::number("section5.estimated_restitution", 0);
    let width = 2.0 * printed.ok().and_then(|printed| printed.uncertainty).unwrap_or(f64::NAN);
    let share = |parameter| if parameter == Parameter::Restitution { width / (high - low) } else { 1.0 };
    changes.iter().map(|&(parameter, change)| (parameter, share(parameter) * change)).collect()
}

/// Whether the parameters `named` are those with the largest changes.
fn are_largest(mut changes: Vec<(Parameter, f64)>, named: [Parameter; 3]) -> bool {
    changes.sort_by(|one, other| other.1.total_cmp(&one.1));
    changes.len() == Parameter::ALL.len()
        && changes.iter().take(named.len()).all(|(parameter, _)| named.contains(parameter))
}

/// That the parameters `named` are those with the largest changes of the steady speed, or of the stall
/// torque.
pub(super) fn most_sensitive(data: &Fig13Data, key: &str, of: Change, named: [Parameter; 3]) -> Claim {
    let means =
        if key == "section5.speed_sensitivity" { mean_speed_changes(data) } else { mean_stall_changes(data) };
    let single = |draw: &Draw| {
        are_largest(
            draw.sensitivities.iter().filter_map(|one| Some((one.parameter, of(one)?))).collect(),
            named,
        )
    };
    let printed = over_printed_range(data, &means);
    Claim::printed_statement(
        key,
        are_largest(means.clone(), named),
        format!(
            "{CHANGE}: {}; over the measured range of ε it is {}",
            change_words(&means),
            of_restitution(&printed),
        ),
    )
    .by_definition(&[Cases::from(are_largest(printed, named)).sampled()])
    .single_orbits(Cases::of(data.alike.draws.iter().map(single)))
}

/// How much a trend changes, in words.
const CHANGE: &str = "change along the trend over our ranges, relative to the default motor";

/// That only θ and ε change both the steady speed and the stall torque.
pub(super) fn both(data: &Fig13Data) -> Claim {
    let named = |parameter| matches!(parameter, Parameter::Restitution | Parameter::PhaseLag);
    let significant = |change: Option<f64>| change.is_some_and(|change| change > SIGNIFICANT);
    let single = |draw: &Draw| {
        Parameter::ALL.into_iter().all(|parameter| {
            let of = draw.sensitivity(parameter);
            of.is_some_and(|of| significant(of.speed_change) && significant(of.stall_change))
                == named(parameter)
        })
    };
    let (speeds, stalls) = (mean_speed_changes(data), mean_stall_changes(data));
    let holds = |speeds: &[(Parameter, f64)], stalls: &[(Parameter, f64)]| {
        speeds.iter().zip(stalls).all(|((parameter, speed), (_, stall))| {
            (*speed > SIGNIFICANT && *stall > SIGNIFICANT) == named(*parameter)
        })
    };
    let printed = [&speeds, &stalls].map(|changes| over_printed_range(data, changes));
    Claim::printed_statement(
        "section5.both_sensitivity",
        holds(&speeds, &stalls),
        format!(
            "θ and ε, and no other, change both by more than {SIGNIFICANT}; {CHANGE}: steady speed {}; α̇_ss/t_c {}. Over the measured range of ε that changes them by {} and {}",
            change_words(&speeds),
            change_words(&stalls),
            of_restitution(&printed[0]),
            of_restitution(&printed[1])
        ),
    )
    .by_definition(&[Cases::from(holds(&printed[0], &printed[1])).sampled()])
    .single_orbits(Cases::of(data.alike.draws.iter().map(single)))
}

/// The quotient α̇_ss/t_c against the acceleration that friction can give, where the paper defines it: for exponential transients.
pub(super) fn torque_limit(data: &Fig13Data) -> Claim {
    let cases: Cases = data.alike.prevalence.iter().map(|entry| entry.within_limit).sum();
    Claim::printed_statement(
        "section5.torque_limit",
        cases,
        format!(
            "α̇_ss/t_c stays below μ a_e g/a_g² for {} of the single orbits with an exponential transient, over ε from 0 on; where the speed rises in lines the initial slope of the fit is no \
             acceleration",
            cases.words(),
        ),
    )
    .cause(NO_ACCELERATION)
}

/// Whether θ and ε leave the means of both below the maxima that ωΦ and μ set, wherever they are drawn.
pub(super) fn only_reduce(data: &Fig13Data) -> Claim {
    let points = [Parameter::PhaseLag, Parameter::Restitution].into_iter().flat_map(|parameter| {
        let points = sweep(data, parameter).map_or(&[][..], |sweep| &sweep.points);
        points.iter().map(move |point| (parameter, point))
    });
    let points: Vec<(Parameter, &SweepPoint)> = points.collect();
    let over = |(parameter, point): &(Parameter, &SweepPoint)| stall_over_limit(data, *parameter, point);
    let fastest = extent(points.iter().map(|(_, point)| point.speed_ratio().abs())).1;
    let above: Vec<_> = points.iter().filter(|of| over(of).is_some_and(|over| over > 1.0)).collect();
    let places =
        above.iter().map(|(parameter, point)| format!("{} = {:.2}", parameter.symbol(), point.value));
    Claim::printed_statement(
        "section5.only_reduce",
        crate::claims::all(&points, |of| of.1.speed_ratio().abs() <= 1.0 && over(of).is_none_or(|over| over <= 1.0)),
        format!(
            "the means of {} motors with other θ and ε: speeds up to {fastest:.3} ωΦ; α̇_ss/t_c above μ a_e g/a_g² at {} of them, up to {:.2} of it{}",
            points.len(),
            above.len(),
            extent(points.iter().filter_map(over)).1,
            if above.is_empty() { String::new() } else { format!(": {}", places.collect::<Vec<_>>().join(", ")) },
        ),
    )
    .cause(NO_ACCELERATION)
}
