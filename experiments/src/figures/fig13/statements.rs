//! What the paper says about Fig. 13.

use bouncing_disk::core::elementary::{cos, ln};

use super::data::{Fig13Data, Parameter, Prevalence, Sweep, SweepPoint};
use crate::claim::Claim;
use crate::figures::motor_case::{perturbation_words, relative_range};
use crate::figures::regression::StraightLine;
use crate::table::{Cell, Table};

const ID: &str = "fig13";
const SECTION: &str = "Sec. V C";

/// An exponent below this, with two standard errors, counts as no significant effect: over two decades of A the
/// quantity then changes by less than a factor 1.6.
const INSIGNIFICANT: f64 = 0.1;
/// An exponent this near to 1 counts as proportional.
const PROPORTIONAL_WITHIN: f64 = 0.1;
/// Least share of the variance that a curve explains to be called that curve.
const EXPLAINED: f64 = 0.95;

pub(super) fn caption(data: &Fig13Data) -> String {
    let left_out: usize = sweep_points(data).filter(|point| point.stall().is_none()).count();
    let low: usize = sweep_points(data).filter(|point| point.statistics.is_low_period()).count();
    format!(
        "Effect of varying (a) μ, (b) ε, (c) θ, (d) A and (e) ωΦ about the default values (μ = {}, ε = {}, θ = {}, A = {:e} m, \
         ωΦ = {} rad/s, g = {} m/s², {} kHz). Crosses, left scales: steady-state speed over ωΦ; dots, right scales: stall torque \
         as an acceleration. Mean and standard deviation of {} members over {} rise times, relaunch perturbation below {} \
         g/ω. Pale: {low} motors on a low-period cycle. {left_out} motors have no meaningful fit and no dot. Dotted: \
         what the phases of the normal impulse predict. (f) Distribution of the normal impulse over the cycle of the stator. \
         The paper's ranges are not in its text; these are ours.",
        data.motor.friction,
        data.motor.restitution,
        data.motor.phase_lag_rad,
        data.motor.amplitude_m,
        data.motor.peak_angular_speed_rad_per_s,
        data.motor.preload_acceleration_m_per_s2,
        data.motor.frequency_hz / 1e3,
        data.members,
        data.rises,
        data.relaunch_perturbation,
    )
}

pub(super) fn parameters(data: &Fig13Data) -> Vec<(String, String)> {
    let mut rows = Vec::new();
    for sweep in &data.sweeps {
        if let (Some(first), Some(last)) = (sweep.points.first(), sweep.points.last()) {
            let value = format!(
                "{:.3e} to {:.3e} {}, {} values",
                first.value,
                last.value,
                sweep.parameter.unit(),
                sweep.points.len()
            );
            rows.push((sweep.parameter.symbol().to_owned(), value));
        }
    }
    rows.push(("members".to_owned(), data.members.to_string()));
    rows.push(("duration".to_owned(), format!("{} ωΦ a_g²/(μ a_e g)", data.rises)));
    rows.push((
        "relaunch perturbation".to_owned(),
        format!("{} and {} g/ω", data.relaunch_perturbation, data.breaking_perturbation),
    ));
    rows
}

pub(super) fn table(data: &Fig13Data) -> Table {
    let mut table = Table::new([
        "parameter",
        "value (SI)",
        "steady speed / (omega Phi)",
        "its standard deviation",
        "stall acceleration (rad/s^2)",
        "its standard deviation (rad/s^2)",
        "members without fit",
        "low-period cycle",
        "speed ratio, cycles broken",
        "predicted speed ratio",
        "predicted stall acceleration (rad/s^2)",
    ]);
    for sweep in &data.sweeps {
        for point in &sweep.points {
            let (statistics, top) = (&point.statistics, point.peak_angular_speed_rad_per_s);
            let stall = statistics.stall_acceleration_rad_per_s2;
            table.push([
                sweep.parameter.symbol().into(),
                point.value.into(),
                point.speed_ratio().into(),
                (statistics.steady_speed_rad_per_s.deviation / top).into(),
                stall.map(|spread| spread.mean).into(),
                stall.map(|spread| spread.deviation).into(),
                Cell::Integer(statistics.unfitted as i64),
                if statistics.is_low_period() { statistics.cycle.words().into() } else { Cell::Empty },
                (point.broken.steady_speed_rad_per_s.mean / top).into(),
                point.predicted_speed_ratio.into(),
                point.predicted_stall_acceleration_rad_per_s2.into(),
            ]);
        }
    }
    table
}

fn sweep_points(data: &Fig13Data) -> impl Iterator<Item = &SweepPoint> {
    data.sweeps.iter().flat_map(|sweep| &sweep.points)
}

fn sweep(data: &Fig13Data, parameter: Parameter) -> Option<&Sweep> {
    data.sweeps.iter().find(|sweep| sweep.parameter == parameter)
}

/// What is read from a point: the steady speed in rad/s, or the stall acceleration.
type Reading = fn(&SweepPoint) -> Option<f64>;

fn speed(point: &SweepPoint) -> Option<f64> {
    Some(point.statistics.steady_speed_rad_per_s.mean)
}

fn stall(point: &SweepPoint) -> Option<f64> {
    point.stall()
}

/// The points that no low-period cycle governs, as (value, reading).
fn read(data: &Fig13Data, parameter: Parameter, of: Reading) -> Vec<(f64, f64)> {
    let points = sweep(data, parameter).map_or(&[][..], |sweep| &sweep.points);
    let chaotic = points.iter().filter(|point| !point.statistics.is_low_period());
    chaotic.filter_map(|point| of(point).map(|value| (point.value, value))).collect()
}

/// Elasticity: the exponent of a power law through all positive points.
fn elasticity(data: &Fig13Data, parameter: Parameter, of: Reading) -> Option<StraightLine> {
    let points: Vec<(f64, f64)> = read(data, parameter, of)
        .into_iter()
        .filter(|(value, reading)| *value > 0.0 && *reading > 0.0)
        .map(|(value, reading)| (ln(value), ln(reading)))
        .collect();
    StraightLine::through(&points)
}

fn words(line: Option<StraightLine>) -> String {
    line.map_or_else(|| "no fit".to_owned(), |line| format!("{:+.3} ± {:.3}", line.slope, line.slope_error))
}

pub(super) fn claims(data: &Fig13Data) -> Vec<Claim> {
    let mut claims = vec![cosine(data), prevalent(data), amplitude(data), twist(data), friction(data)];
    claims.push(most_sensitive(
        data,
        "the steady speed is most sensitive to θ, ε and ωΦ",
        speed,
        [Parameter::PhaseLag, Parameter::Restitution, Parameter::PeakAngularSpeed],
    ));
    claims.push(most_sensitive(
        data,
        "the stall torque is most sensitive to θ, ε and μ",
        stall,
        [Parameter::PhaseLag, Parameter::Restitution, Parameter::Friction],
    ));
    claims.extend([limits(data), concentrated(data), simplistic(data), form(data)]);
    for motor in &data.perturbations {
        let effects: Vec<_> =
            motor.effects.iter().filter(|effect| effect.relaunch_perturbation >= 1e-5).collect();
        let speeds: Vec<f64> =
            effects.iter().map(|effect| effect.statistics.steady_speed_rad_per_s.mean).collect();
        claims.push(Claim::statement(
            ID,
            "our ensemble",
            format!(
                "at ε = {} the steady speed does not depend on the relaunch perturbation from 1e-5 to 1e-1 g/ω (within 5 %)",
                motor.restitution
            ),
            relative_range(&speeds) <= 0.05,
            format!(
                "steady speed (rad/s), stall acceleration (rad/s²) by perturbation: {}. Low-period cycles, where they are common, \
                 survive small perturbations and not large ones",
                perturbation_words(&motor.effects)
            ),
        ));
    }
    claims
}

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

fn cosine(data: &Fig13Data) -> Claim {
    let top = data.motor.peak_angular_speed_rad_per_s;
    let ratio: Vec<_> = read(data, Parameter::PhaseLag, speed)
        .into_iter()
        .map(|(angle, speed)| (angle, speed / top))
        .collect();
    let (factor, explained) = cosine_fit(&ratio);
    let (stall_factor, stall_explained) = cosine_fit(&read(data, Parameter::PhaseLag, stall));
    let off = |point: &&(f64, f64)| (point.1 - factor * cos(point.0)).abs();
    let worst = ratio.iter().max_by(|one, other| off(one).total_cmp(&off(other)));
    Claim::statement(
        ID,
        SECTION,
        "the results for θ correspond to a cosine curve",
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

fn prevalent(data: &Fig13Data) -> Claim {
    let limit = data.figures.low_period_prevalent_below_restitution;
    let most = |entry: &Prevalence| entry.share_of_short > 0.5;
    // A grid value equal to the limit belongs to neither side.
    let holds = data
        .prevalence
        .iter()
        .filter(|entry| (entry.restitution - limit).abs() > 0.01)
        .all(|entry| most(entry) == (entry.restitution < limit));
    let rows = data.prevalence.iter().map(|entry| {
        let shares =
            entry.share_up_to.iter().map(|(flights, share)| format!("{:.0} % ≤ {flights}", 100.0 * share));
        format!(
            "ε = {:.2}: {:.0} % (flights in a cycle: {}; median {})",
            entry.restitution,
            100.0 * entry.share_of_short,
            shares.collect::<Vec<_>>().join(", "),
            entry.median_flights.map_or_else(|| "more".to_owned(), |flights| flights.to_string()),
        )
    });
    Claim::statement(
        ID,
        SECTION,
        "when ε < 0.5, low-period chattering becomes the prevalent behaviour",
        holds,
        format!(
            "share of unperturbed motors, with amplitudes that round to the default, whose cycle takes at most a hundredth of the \
             rise time, so that the speed rises in lines: {}",
            rows.collect::<Vec<_>>().join("; ")
        ),
    )
}

fn amplitude(data: &Fig13Data) -> Claim {
    let lines = [speed as Reading, stall].map(|of| elasticity(data, Parameter::Amplitude, of));
    let range = |of: Reading| {
        let values: Vec<f64> = read(data, Parameter::Amplitude, of).iter().map(|point| point.1).collect();
        100.0 * relative_range(&values)
    };
    let low = sweep(data, Parameter::Amplitude)
        .map_or(0, |sweep| sweep.points.iter().filter(|point| point.statistics.is_low_period()).count());
    Claim::statement(
        ID,
        SECTION,
        "steady speed and stall torque are not affected significantly by A over two orders of magnitude",
        lines
            .iter()
            .all(|line| line.is_some_and(|line| line.slope.abs() + 2.0 * line.slope_error < INSIGNIFICANT)),
        format!(
            "exponents {} (range {:.0} %) and {} (range {:.0} %); {low} low-period motors left out",
            words(lines[0]),
            range(speed),
            words(lines[1]),
            range(stall),
        ),
    )
}

fn twist(data: &Fig13Data) -> Claim {
    let line = elasticity(data, Parameter::PeakAngularSpeed, stall);
    Claim::statement(
        ID,
        SECTION,
        "the stall torque is independent of ωΦ",
        line.is_some_and(|line| line.slope.abs() + 2.0 * line.slope_error < INSIGNIFICANT),
        format!(
            "exponent {}; that of the steady speed {}",
            words(line),
            words(elasticity(data, Parameter::PeakAngularSpeed, speed))
        ),
    )
}

fn friction(data: &Fig13Data) -> Claim {
    let line = elasticity(data, Parameter::Friction, stall);
    let straight = StraightLine::through(&read(data, Parameter::Friction, stall));
    Claim::statement(
        ID,
        SECTION,
        "linear relationship between μ and the stall torque",
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

/// Ranks the parameters by the relative change over their ranges.
fn most_sensitive(data: &Fig13Data, quantity: &str, of: Reading, named: [Parameter; 3]) -> Claim {
    let mut changes: Vec<(Parameter, f64)> = Parameter::ALL
        .into_iter()
        .map(|parameter| {
            let values: Vec<f64> = read(data, parameter, of).iter().map(|point| point.1).collect();
            let (low, high) =
                values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &value| {
                    (low.min(value), high.max(value))
                });
            let default = match of(&default_point(data)) {
                Some(value) if value > 0.0 => value,
                _ => f64::NAN,
            };
            (parameter, (high - low) / default)
        })
        .collect();
    changes.sort_by(|one, other| other.1.total_cmp(&one.1));
    let ranked = changes.iter().map(|(parameter, change)| {
        let local = elasticity(data, *parameter, of);
        let exponent = if *parameter == Parameter::PhaseLag {
            String::new()
        } else {
            format!(", exponent {}", words(local))
        };
        format!("{} {:.2}{exponent}", parameter.symbol(), change)
    });
    let ranked = ranked.collect::<Vec<_>>().join("; ");
    Claim::statement(
        ID,
        SECTION,
        quantity,
        changes.iter().take(named.len()).all(|(parameter, _)| named.contains(parameter)),
        format!(
            "change over the range drawn, relative to the default value: {ranked} (low-period motors left out)"
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
    }
}

fn limits(data: &Fig13Data) -> Claim {
    let ratio = sweep_points(data).map(|point| point.speed_ratio().abs()).fold(0.0, f64::max);
    let limit = |sweep: &Sweep, point: &SweepPoint| {
        sweep.parameter.set(&data.motor, point.value).largest_acceleration()
    };
    let share = data
        .sweeps
        .iter()
        .flat_map(|sweep| sweep.points.iter().map(move |point| (sweep, point)))
        .filter_map(|(sweep, point)| {
            let spread = point.statistics.stall_acceleration_rad_per_s2?;
            Some((spread.mean.abs() - 2.0 * spread.standard_error) / limit(sweep, point))
        })
        .fold(0.0, f64::max);
    Claim::statement(
        ID,
        SECTION,
        "the maximum values of steady speed and stall torque are set by ωΦ and μ",
        ratio <= 1.0 && share <= 1.0,
        format!(
            "largest steady speed {ratio:.3} ωΦ; largest stall acceleration, two standard errors below the mean, {share:.3} \
             μ a_e g/a_g²: the normal impulse per time is the weight, whatever the orbit"
        ),
    )
}

fn concentrated(data: &Fig13Data) -> Claim {
    let shares: Vec<f64> = data.impulses.iter().map(|impulse| impulse.share_near_zero).collect();
    let rows = data.impulses.iter().map(|impulse| {
        let parts = impulse.shares.len();
        let peak = impulse.shares.iter().enumerate().max_by(|one, other| one.1.total_cmp(other.1));
        format!(
            "ε = {}: {:.1} % of the normal impulse within π/4 of τ = 0 (25 % if even), most at τ = {:.2}π, {:.1} % in contact",
            impulse.restitution,
            100.0 * impulse.share_near_zero,
            peak.map_or(f64::NAN, |(part, _)| (2.0 * part as f64 + 1.0) / parts as f64 - 1.0),
            100.0 * impulse.contact_share,
        )
    });
    Claim::statement(
        ID,
        SECTION,
        "collisions are concentrated at τ ≈ 0, and less so when ε is increased",
        shares.iter().all(|share| *share > 0.25) && shares.windows(2).all(|pair| pair[0] > pair[1]),
        rows.collect::<Vec<_>>().join("; "),
    )
}

/// Ĥ/ΔT ~ μ g (1 + ε).
fn simplistic(data: &Fig13Data) -> Claim {
    let points: Vec<(f64, f64)> = sweep(data, Parameter::Restitution)
        .map_or(&[][..], |sweep| &sweep.points)
        .iter()
        .filter_map(|point| {
            point.broken.stall_acceleration_rad_per_s2.map(|spread| (point.value, spread.mean))
        })
        .collect();
    let line = StraightLine::through(&points);
    Claim::statement(
        ID,
        SECTION,
        "the scaling Ĥ/ΔT ~ μ g(1 + ε) fails to predict the effect of ε",
        line.is_some_and(|line| line.slope + 2.0 * line.slope_error < 0.0),
        format!(
            "the stall acceleration (low-period cycles broken by perturbations of {} g/ω) falls with ε by {} rad/s², where the scaling \
             has it rise from ε = 0 to 0.9 by 90 %. The interval between impacts is not w_A/g: the normal impulse (1 + ε)w_A per \
             time equals the weight for any ε, so the factor 1 + ε cancels, and ε acts only through the phases of the impulse",
            data.breaking_perturbation,
            line.map_or_else(
                || "?".to_owned(),
                |line| format!("{:.1} ± {:.1}", -line.slope, line.slope_error)
            ),
        ),
    )
}

/// How well the phases of the impulse predict all points.
fn form(data: &Fig13Data) -> Claim {
    let chaotic = sweep_points(data).filter(|point| !point.statistics.is_low_period());
    let off: Vec<f64> =
        chaotic.map(|point| (point.speed_ratio() - point.predicted_speed_ratio).abs()).collect();
    let (worst, count) = (off.iter().copied().fold(0.0, f64::max), off.len());
    let root_mean_square = (off.iter().map(|value| value * value).sum::<f64>() / count as f64).sqrt();
    Claim::statement(
        ID,
        "our derivation",
        "the steady speed is ωΦ times the impulse-weighted median of cos(τ + θ)",
        root_mean_square <= 0.05,
        format!(
            "over {count} motors the speed ratio is off by {root_mean_square:.3} (root mean square), {worst:.3} at most"
        ),
    )
}
