//! How steady speed and stall torque depend on the parameters.

use bouncing_disk::core::elementary::cos;

use super::data::{Draw, Fig13Data, Parameter, Sensitivity};
use super::sweeps::{
    Quantity, cosine_fit, elasticity, extent, low_period_words, read, speed, stall, sweep_points, words,
};
use crate::claim::{Agreement, Claim};
use crate::figures::motor_case::relative_range;
use crate::figures::regression::StraightLine;
use crate::figures::samples;

/// An exponent below this, with two standard errors, counts as no significant effect: over two decades of A the
/// quantity then changes by less than a factor 1.6.
const INSIGNIFICANT: f64 = 0.1;

/// An exponent this near to 1 counts as proportional.
const PROPORTIONAL_WITHIN: f64 = 0.1;

/// A change over the range by more than this share of the default value is significant.
const SIGNIFICANT: f64 = 0.3;

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
    let speeds = Agreement::of(draws.iter().map(|draw| is_cosine(draw.speed_cosine)));
    let stalls = Agreement::of(draws.iter().map(|draw| is_cosine(draw.stall_cosine)));
    let off = |point: &&(f64, f64)| (point.1 - factor * cos(point.0)).abs();
    let worst = ratio.iter().max_by(|one, other| off(one).total_cmp(&off(other)));
    Claim::printed_share(
        "section5.cosine_of_phase_lag",
        Agreement::of(draws.iter().map(|draw| is_cosine(draw.speed_cosine) && is_cosine(draw.stall_cosine))),
        format!(
            "whether a cosine of θ explains {:.0} % of the variance of steady speed and of α̇_ss/t_c, over {} lags, for {} motors that print alike and that nothing perturbs; of the \
             speed alone it does for {}, of α̇_ss/t_c for {}. In the figure, means over an ensemble: steady speed/(ωΦ) = {factor:.3} cos θ explains {:.2} % of the variance, stall acceleration = {stall_factor:.1} cos θ \
             {:.2} % of its. {} The curve is not even in θ, since the impulses do not fall evenly about τ = 0",
            100.0 * EXPLAINED,
            data.alike.phase_lags_rad.len(),
            draws.len(),
            speeds.words(),
            stalls.words(),
            100.0 * explained,
            100.0 * stall_explained,
            worst.map_or_else(String::new, |point| format!(
                "The speed ratio is farthest off at θ = {:.2}π, {:.3} against {:.3}.",
                point.0 / std::f64::consts::PI,
                point.1,
                factor * cos(point.0)
            )),
        ),
    )
}

pub(super) fn amplitude(data: &Fig13Data) -> Claim {
    let lines = [speed as Quantity, stall].map(|of| elasticity(data, Parameter::Amplitude, of));
    let range = |of: Quantity| {
        let values: Vec<f64> = read(data, Parameter::Amplitude, of).iter().map(|point| point.1).collect();
        100.0 * relative_range(&values)
    };
    let draws = &data.alike.draws;
    let small = |exponent: Option<f64>| exponent.is_some_and(|exponent| exponent.abs() < INSIGNIFICANT);
    let holds =
        draws.iter().map(|draw| small(draw.speed_amplitude_exponent) && small(draw.stall_amplitude_exponent));
    Claim::printed_share(
        "section5.amplitude_insensitivity",
        Agreement::of(holds),
        format!(
            "whether the exponents of A in both are below {INSIGNIFICANT} over the three printed amplitudes, for {} motors that print alike. Of the motors drawn in \
             the figure the exponents are {} (range {:.0} %) and {} (range {:.0} %), {}",
            draws.len(),
            words(lines[0]),
            range(speed),
            words(lines[1]),
            range(stall),
            low_period_words(data, Parameter::Amplitude),
        ),
    )
}

/// The agreement of the motors that print alike on what a parameter changes.
fn agreement(data: &Fig13Data, parameter: Parameter, holds: impl Fn(&Sensitivity) -> bool) -> Agreement {
    let draws = data.alike.draws.iter();
    Agreement::of(draws.map(|draw| draw.sensitivity(parameter).is_some_and(&holds)))
}

pub(super) fn twist(data: &Fig13Data) -> Claim {
    Claim::printed_share(
        "section5.torque_independent_of_twist",
        agreement(data, Parameter::PeakAngularSpeed, |of| {
            of.stall_exponent.is_some_and(|exponent| exponent.abs() < INSIGNIFICANT)
        }),
        format!(
            "whether the exponent of ωΦ in α̇_ss/t_c is below {INSIGNIFICANT} from {} to {} rad/s, for {} motors that print alike and that nothing perturbs. In the figure, means over an \
             ensemble: exponent {}; that of the steady speed {}",
            data.alike.peak_angular_speeds_rad_per_s.first().copied().unwrap_or(f64::NAN),
            data.alike.peak_angular_speeds_rad_per_s.last().copied().unwrap_or(f64::NAN),
            data.alike.drawn,
            words(elasticity(data, Parameter::PeakAngularSpeed, stall)),
            words(elasticity(data, Parameter::PeakAngularSpeed, speed))
        ),
    )
}

pub(super) fn friction(data: &Fig13Data) -> Claim {
    let straight = StraightLine::through(&read(data, Parameter::Friction, stall));
    Claim::printed_share(
        "section5.torque_linear_in_friction",
        agreement(data, Parameter::Friction, |of| {
            of.stall_exponent.is_some_and(|exponent| (exponent - 1.0).abs() <= PROPORTIONAL_WITHIN)
                && of.stall_explained.is_some_and(|explained| explained >= EXPLAINED)
        }),
        format!(
            "whether the exponent of μ in α̇_ss/t_c is within {PROPORTIONAL_WITHIN} of 1 and a straight line explains {:.0} % of its variance, from μ = {} to {}, for {} motors that print alike and \
             that nothing perturbs. In the figure, means over an ensemble: exponent {}; straight line R² = {:.4}, intercept {:.2} rad/s²; the steady speed has the exponent {}",
            100.0 * EXPLAINED,
            data.alike.frictions.first().copied().unwrap_or(f64::NAN),
            data.alike.frictions.last().copied().unwrap_or(f64::NAN),
            data.alike.drawn,
            words(elasticity(data, Parameter::Friction, stall)),
            straight.map_or(f64::NAN, |line| line.explained),
            straight.map_or(f64::NAN, |line| line.intercept),
            words(elasticity(data, Parameter::Friction, speed)),
        ),
    )
}

/// What is read off the trend of a parameter.
type Change = fn(&Sensitivity) -> Option<f64>;

pub(super) fn speed_change(of: &Sensitivity) -> Option<f64> {
    of.speed_change
}

pub(super) fn stall_change(of: &Sensitivity) -> Option<f64> {
    of.stall_change
}

/// The medians over the motors that print alike of what each parameter changes.
fn medians(data: &Fig13Data, of: Change) -> String {
    let words = Parameter::ALL.into_iter().map(|parameter| {
        let draws = data.alike.draws.iter();
        let changes = draws.filter_map(|draw| draw.sensitivity(parameter).and_then(of));
        format!("{} {:.2}", parameter.symbol(), samples::median(changes).unwrap_or(f64::NAN))
    });
    words.collect::<Vec<_>>().join(", ")
}

/// How much a trend changes, in words.
const CHANGE: &str = "change along the trend over the range, a straight line (of A in its logarithm, of θ a cosine), relative to the motor as printed; the ranges are ours, those of A the \
    three printed amplitudes";

/// That the parameters `named` are those with the largest changes.
pub(super) fn most_sensitive(data: &Fig13Data, key: &str, of: Change, named: [Parameter; 3]) -> Claim {
    let holds = |draw: &Draw| {
        let mut changes: Vec<(Parameter, f64)> =
            draw.sensitivities.iter().filter_map(|one| Some((one.parameter, of(one)?))).collect();
        changes.sort_by(|one, other| other.1.total_cmp(&one.1));
        changes.len() == Parameter::ALL.len()
            && changes.iter().take(named.len()).all(|(parameter, _)| named.contains(parameter))
    };
    let lacks = |draw: &&Draw| draw.sensitivities.iter().any(|one| of(one).is_none());
    let incomplete = data.alike.draws.iter().filter(lacks).count();
    Claim::printed_share(
        key,
        Agreement::of(data.alike.draws.iter().map(holds)),
        format!(
            "whether the named three have the largest changes, for {} motors that print alike and that nothing perturbs ({} of them lack a value, since too few of their transients are fitted, and count \
             as not agreeing); medians: {}. {CHANGE}",
            data.alike.drawn,
            incomplete,
            medians(data, of)
        ),
    )
}

/// That only θ and ε change both the steady speed and the stall torque.
pub(super) fn both(data: &Fig13Data) -> Claim {
    let significant = |change: Option<f64>| change.is_some_and(|change| change > SIGNIFICANT);
    let holds = |draw: &Draw| {
        Parameter::ALL.into_iter().all(|parameter| {
            let both = draw
                .sensitivity(parameter)
                .is_some_and(|of| significant(of.speed_change) && significant(of.stall_change));
            both == matches!(parameter, Parameter::Restitution | Parameter::PhaseLag)
        })
    };
    Claim::printed_share(
        "section5.both_sensitivity",
        Agreement::of(data.alike.draws.iter().map(holds)),
        format!(
            "whether θ and ε, and no other, change both by more than {SIGNIFICANT}, for {} motors that print alike and that nothing perturbs; medians of the change of the steady speed: {}; of \
             α̇_ss/t_c: {}. {CHANGE}",
            data.alike.drawn,
            medians(data, speed_change),
            medians(data, stall_change)
        ),
    )
}

pub(super) fn speed_limit(data: &Fig13Data) -> Claim {
    let ratio = sweep_points(data).map(|point| point.speed_ratio().abs()).fold(0.0, f64::max);
    let draws = &data.alike.draws;
    let largest = extent(draws.iter().map(|draw| draw.largest_speed_ratio)).1;
    Claim::printed_share(
        "section5.speed_limit",
        Agreement::of(draws.iter().map(|draw| draw.largest_speed_ratio <= 1.0 && ratio <= 1.0)),
        format!(
            "largest steady speed of the {} motors drawn in the figure: {ratio:.3} ωΦ; of the motors that print alike, at all ε: {largest:.3} ωΦ",
            sweep_points(data).count()
        ),
    )
}

/// The quotient α̇_ss/t_c against the acceleration that friction can give.
pub(super) fn torque_limit(data: &Fig13Data) -> Claim {
    let mut largest = (0.0, String::new());
    for sweep in &data.sweeps {
        for point in &sweep.points {
            let Some(spread) = point.statistics.stall_acceleration_rad_per_s2 else { continue };
            let limit = sweep.parameter.set(&data.motor, point.value).largest_acceleration();
            let share = (spread.mean.abs() - 2.0 * spread.standard_error) / limit;
            if share > largest.0 {
                largest = (share, format!("{} = {:.3}", sweep.parameter.symbol(), point.value));
            }
        }
    }
    let (share, place) = largest;
    let alike = &data.alike;
    let above = alike
        .prevalence
        .iter()
        .map(|entry| format!("ε = {:.2}: {}", entry.restitution, entry.within_limit.words()));
    let everywhere = Agreement::of(alike.draws.iter().map(|draw| draw.largest_stall_over_limit <= 1.0));
    Claim::printed_share(
        "section5.torque_limit",
        alike.prevalence.iter().map(|entry| entry.within_limit).sum(),
        format!(
            "whether α̇_ss/t_c stays below μ a_e g/a_g², for all motors that settle at {} values of ε from 0 to {:.1} and {} draws of the other inputs ({}). By ε: {}. Below it at \
             every ε: {} of the draws. In the figure the largest quotient is, two standard errors below the mean, {share:.3} of the limit at {place}. The normal impulse per time is the \
             weight, whatever the orbit, so no motor accelerates faster than the limit; but where the speed rises in lines rather than exponentially, at \
             small ε, the fit makes more of α̇_ss/t_c than any acceleration",
            alike.prevalence.len(),
            alike.prevalence.last().map_or(f64::NAN, |entry| entry.restitution),
            alike.drawn,
            alike.inputs,
            above.collect::<Vec<_>>().join("; "),
            everywhere.words(),
        ),
    )
}
