//! How steady speed and stall torque depend on the parameters.

use bouncing_disk::core::elementary::cos;

use super::data::{Fig13Data, Parameter, SweepPoint};
use super::reading::{
    Reading, elasticity, extent, low_period_words, read, speed, stall, sweep_points, tenths, words,
};
use crate::claim::{Agreement, Claim, all};
use crate::figures::motor_case::relative_range;
use crate::figures::regression::StraightLine;

/// An exponent below this, with two standard errors, counts as no significant effect: over two decades of A the
/// quantity then changes by less than a factor 1.6.
const INSIGNIFICANT: f64 = 0.1;

/// An exponent this near to 1 counts as proportional.
const PROPORTIONAL_WITHIN: f64 = 0.1;

/// A change over the range by more than this share of the default value is significant.
const SIGNIFICANT: f64 = 0.3;

/// Least share of the variance that a curve explains to be called that curve.
const EXPLAINED: f64 = 0.95;

/// y = c cos θ by least squares: c, and the share of the variance that it explains.
fn cosine_fit(points: &[(f64, f64)]) -> (f64, f64) {
    let (mut products, mut squares) = (0.0, 0.0);
    for (angle, value) in points {
        products += cos(*angle) * value;
        squares += cos(*angle) * cos(*angle);
    }
    let factor = products / squares;
    let mean = points.iter().map(|point| point.1).sum::<f64>() / points.len() as f64;
    let (mut rest, mut all) = (0.0, 0.0);
    for (angle, value) in points {
        let (off, from_mean) = (value - factor * cos(*angle), value - mean);
        rest += off * off;
        all += from_mean * from_mean;
    }
    (factor, 1.0 - rest / all)
}

pub(super) fn cosine(data: &Fig13Data) -> Claim {
    let top = data.motor.peak_angular_speed_rad_per_s;
    let ratio: Vec<_> = read(data, Parameter::PhaseLag, speed)
        .into_iter()
        .map(|(angle, speed)| (angle, speed / top))
        .collect();
    let (factor, explained) = cosine_fit(&ratio);
    let (stall_factor, stall_explained) = cosine_fit(&read(data, Parameter::PhaseLag, stall));
    let off = |point: &&(f64, f64)| (point.1 - factor * cos(point.0)).abs();
    let worst = ratio.iter().max_by(|one, other| off(one).total_cmp(&off(other)));
    Claim::printed_statement(
        "section5.cosine_of_phase_lag",
        explained >= EXPLAINED,
        format!(
            "steady speed/(ωΦ) = {factor:.3} cos θ explains {:.2} % of the variance, stall acceleration = {stall_factor:.1} cos θ \
             {:.2} % of its; {} The curve is not even in θ, since the impulses do not fall evenly about τ = 0",
            100.0 * explained,
            100.0 * stall_explained,
            worst.map_or_else(String::new, |point| format!(
                "the speed ratio is farthest off at θ = {:.2}π, {:.3} against {:.3}.",
                point.0 / std::f64::consts::PI,
                point.1,
                factor * cos(point.0)
            )),
        ),
    )
}

pub(super) fn amplitude(data: &Fig13Data) -> Claim {
    let lines = [speed as Reading, stall].map(|of| elasticity(data, Parameter::Amplitude, of));
    let range = |of: Reading| {
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

pub(super) fn twist(data: &Fig13Data) -> Claim {
    let line = elasticity(data, Parameter::PeakAngularSpeed, stall);
    Claim::printed_statement(
        "section5.torque_independent_of_twist",
        line.is_some_and(|line| line.slope.abs() + 2.0 * line.slope_error < INSIGNIFICANT),
        format!(
            "exponent {}; that of the steady speed {}",
            words(line),
            words(elasticity(data, Parameter::PeakAngularSpeed, speed))
        ),
    )
}

pub(super) fn friction(data: &Fig13Data) -> Claim {
    let line = elasticity(data, Parameter::Friction, stall);
    let straight = StraightLine::through(&read(data, Parameter::Friction, stall));
    Claim::printed_statement(
        "section5.torque_linear_in_friction",
        line.is_some_and(|line| (line.slope - 1.0).abs() <= PROPORTIONAL_WITHIN)
            && straight.is_some_and(|line| line.explained >= EXPLAINED),
        format!(
            "exponent {}; straight line R² = {:.4}, intercept {:.2} rad/s²; the steady speed has the exponent {}",
            words(line),
            straight.map_or(f64::NAN, |line| line.explained),
            straight.map_or(f64::NAN, |line| line.intercept),
            words(elasticity(data, Parameter::Friction, speed)),
        ),
    )
}

/// The change of a reading over the range of each parameter, relative to the default value; largest first. From the lowest to the highest tenth, with
/// all motors in: a few of a short cycle, which lie at isolated values, do not make a parameter one that matters.
fn changes(data: &Fig13Data, of: Reading) -> Vec<(Parameter, f64)> {
    let default = of(&default_point(data)).unwrap_or(f64::NAN);
    let mut changes: Vec<(Parameter, f64)> = Parameter::ALL
        .into_iter()
        .filter_map(|parameter| {
            let values: Vec<f64> = read(data, parameter, of).iter().map(|point| point.1).collect();
            tenths(&values).map(|(low, high)| (parameter, (high - low) / default))
        })
        .collect();
    changes.sort_by(|one, other| other.1.total_cmp(&one.1));
    changes
}

/// That the parameters `named` are those with the largest changes.
pub(super) fn most_sensitive(data: &Fig13Data, key: &str, of: Reading, named: [Parameter; 3]) -> Claim {
    let changes = changes(data, of);
    let ranked = changes.iter().map(|(parameter, change)| {
        let exponent = if *parameter == Parameter::PhaseLag {
            String::new()
        } else {
            format!(", exponent {}", words(elasticity(data, *parameter, of)))
        };
        format!("{} {change:.2}{exponent}", parameter.symbol())
    });
    let ranked = ranked.collect::<Vec<_>>().join("; ");
    Claim::printed_statement(
        key,
        all(changes.iter().take(named.len()), |(parameter, _)| named.contains(parameter)),
        format!(
            "change over the range drawn, from the lowest to the highest tenth of all motors, relative to the default value: {ranked}. \
             The ranges are ours"
        ),
    )
}

/// That only θ and ε change both the steady speed, in units of ωΦ or not, and the stall torque.
pub(super) fn both(data: &Fig13Data) -> Claim {
    let (speeds, stalls) = (changes(data, speed), changes(data, stall));
    let significant = |changes: &[(Parameter, f64)], parameter: Parameter| {
        changes.iter().any(|(other, change)| *other == parameter && *change > SIGNIFICANT)
    };
    let both: Vec<Parameter> = Parameter::ALL
        .into_iter()
        .filter(|parameter| significant(&speeds, *parameter) && significant(&stalls, *parameter))
        .collect();
    Claim::printed_statement(
        "section5.both_sensitivity",
        (!speeds.is_empty() && !stalls.is_empty())
            .then(|| both == [Parameter::Restitution, Parameter::PhaseLag]),
        format!(
            "changes of more than {SIGNIFICANT} of the default value in both, from the lowest to the highest tenth of all motors: {}",
            both.iter().map(|parameter| parameter.symbol()).collect::<Vec<_>>().join(", ")
        ),
    )
}

/// The default motor as a point.
fn default_point(data: &Fig13Data) -> SweepPoint {
    SweepPoint {
        value: f64::NAN,
        peak_angular_speed_rad_per_s: data.motor.peak_angular_speed_rad_per_s,
        statistics: data.default,
        broken: data.default,
        predicted_speed_ratio: f64::NAN,
        predicted_stall_acceleration_rad_per_s2: None,
        impulse_share_near_zero: f64::NAN,
        mean_impact_speed_m_per_s: f64::NAN,
        mean_impact_interval_s: f64::NAN,
    }
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
