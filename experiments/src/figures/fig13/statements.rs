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
/// A change over the range by more than this share of the default value is significant.
const SIGNIFICANT: f64 = 0.3;
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
    let mut claims = vec![
        cosine(data),
        amplitude(data),
        twist(data),
        friction(data),
        both(data),
        speed_limit(data),
        torque_limit(data),
        slower_collisions(data),
        intervals(data),
        restitution_lowers_both(data),
        simplistic(data),
        form(data),
    ];
    claims.extend(prevalent(data));
    claims.extend(phases_of_impulse(data));
    claims.push(most_sensitive(
        data,
        "section5.speed_sensitivity",
        speed,
        [Parameter::PhaseLag, Parameter::Restitution, Parameter::PeakAngularSpeed],
    ));
    claims.push(most_sensitive(
        data,
        "section5.torque_sensitivity",
        stall,
        [Parameter::PhaseLag, Parameter::Restitution, Parameter::Friction],
    ));
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

/// ε at which a share that falls with ε crosses one half, between the values computed.
fn crossing(data: &Fig13Data, share: impl Fn(&Prevalence) -> f64) -> f64 {
    let pairs = data.prevalence.windows(2).rev();
    pairs
        .filter(|pair| share(&pair[0]) >= 0.5 && share(&pair[1]) < 0.5)
        .map(|pair| {
            let part = (share(&pair[0]) - 0.5) / (share(&pair[0]) - share(&pair[1]));
            pair[0].restitution + part * (pair[1].restitution - pair[0].restitution)
        })
        .next()
        .unwrap_or(f64::NAN)
}

/// The share of cycles with at most the flights of this index of the counts.
fn up_to(entry: &Prevalence, index: usize) -> f64 {
    entry.share_up_to.get(index).map_or(f64::NAN, |share| share.1)
}

fn prevalent(data: &Fig13Data) -> Vec<Claim> {
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
    const KEY: &str = "section5.low_period_restitution";
    let mut claims = vec![Claim::printed(KEY, crossing(data, |entry| entry.share_of_short)).note(format!(
        "the ε at which half of the unperturbed motors, with amplitudes that round to the default, have a cycle of at most a \
         hundredth of the rise time, so that the speed rises in lines. The paper does not say what low period is. Shares: {}",
        rows.collect::<Vec<_>>().join("; ")
    ))];
    let counts = data.prevalence.first().map_or(0, |entry| entry.share_up_to.len());
    for index in 0..counts {
        let flights = data.prevalence[0].share_up_to[index].0;
        let quantity = format!("the same for cycles of at most {flights} flights");
        claims.push(Claim::reading(ID, KEY, quantity, crossing(data, |entry| up_to(entry, index))));
    }
    claims
}

fn amplitude(data: &Fig13Data) -> Claim {
    let lines = [speed as Reading, stall].map(|of| elasticity(data, Parameter::Amplitude, of));
    let range = |of: Reading| {
        let values: Vec<f64> = read(data, Parameter::Amplitude, of).iter().map(|point| point.1).collect();
        100.0 * relative_range(&values)
    };
    let low = sweep(data, Parameter::Amplitude)
        .map_or(0, |sweep| sweep.points.iter().filter(|point| point.statistics.is_low_period()).count());
    Claim::printed_statement(
        "section5.amplitude_insensitivity",
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

fn friction(data: &Fig13Data) -> Claim {
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

/// The change of a reading over the range of each parameter, relative to the default value; largest first.
fn changes(data: &Fig13Data, of: Reading) -> Vec<(Parameter, f64)> {
    let default = of(&default_point(data)).unwrap_or(f64::NAN);
    let mut changes: Vec<(Parameter, f64)> = Parameter::ALL
        .into_iter()
        .map(|parameter| {
            let (low, high) = extent(read(data, parameter, of).iter().map(|point| point.1));
            (parameter, (high - low) / default)
        })
        .collect();
    changes.sort_by(|one, other| other.1.total_cmp(&one.1));
    changes
}

/// Smallest and largest value.
fn extent(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
}

/// That the parameters `named` are those with the largest changes.
fn most_sensitive(data: &Fig13Data, key: &str, of: Reading, named: [Parameter; 3]) -> Claim {
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
        changes.iter().take(named.len()).all(|(parameter, _)| named.contains(parameter)),
        format!(
            "change over the range drawn, relative to the default value: {ranked} (low-period motors left out). The ranges are \
             ours"
        ),
    )
}

/// That only θ and ε change both the steady speed, in units of ωΦ or not, and the stall torque.
fn both(data: &Fig13Data) -> Claim {
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
        both == [Parameter::Restitution, Parameter::PhaseLag],
        format!(
            "changes of more than {SIGNIFICANT} of the default value in both: {}",
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

fn speed_limit(data: &Fig13Data) -> Claim {
    let ratio = sweep_points(data).map(|point| point.speed_ratio().abs()).fold(0.0, f64::max);
    Claim::printed_statement(
        "section5.speed_limit",
        ratio <= 1.0,
        format!("largest steady speed over {} motors: {ratio:.3} ωΦ", sweep_points(data).count()),
    )
}

/// The quotient α̇_ss/t_c against the acceleration that friction can give.
fn torque_limit(data: &Fig13Data) -> Claim {
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
    Claim::statement(
        ID,
        SECTION,
        "the quotient α̇_ss/t_c stays below the limit μ a_e g/a_g² of the stall torque",
        share <= 1.0,
        format!(
            "two standard errors below the mean it is {share:.3} of the limit at {place}. The normal impulse per time is the weight, \
             whatever the orbit, so no motor accelerates faster than the limit; but where the speed rises in lines rather than \
             exponentially, at small ε, the fit makes more of α̇_ss/t_c than any acceleration"
        ),
    )
}

fn phases_of_impulse(data: &Fig13Data) -> [Claim; 2] {
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
    let rows = rows.collect::<Vec<_>>().join("; ");
    [
        Claim::printed_statement(
            "section5.collisions_at_zero_phase",
            shares.iter().all(|share| *share > 0.25),
            format!(
                "{rows}. The peak before τ = 0 is where the first flight after a rest, of about Γ periods, ends"
            ),
        ),
        Claim::printed_statement(
            "section5.concentration_falls_with_restitution",
            shares.windows(2).all(|pair| pair[0] > pair[1]),
            rows,
        ),
    ]
}

/// Small A: slower collisions, and more of them.
fn slower_collisions(data: &Fig13Data) -> Claim {
    let points = sweep(data, Parameter::Amplitude).map_or(&[][..], |sweep| &sweep.points);
    let chaotic: Vec<&SweepPoint> = points.iter().filter(|point| !point.statistics.is_low_period()).collect();
    let logarithms: Vec<_> =
        chaotic.iter().map(|point| (ln(point.value), ln(point.mean_impact_speed_m_per_s))).collect();
    let line = StraightLine::through(&logarithms);
    let rows = chaotic
        .iter()
        .step_by(chaotic.len().saturating_sub(1).max(1))
        .map(|point| format!("{:.3e} m: {:.3e} m/s", point.value, point.mean_impact_speed_m_per_s));
    Claim::printed_statement(
        "section5.slower_collisions",
        line.is_some_and(|line| line.slope - 2.0 * line.slope_error > 0.0),
        format!(
            "mean impact speed grows with the exponent {} of A: {}",
            words(line),
            rows.collect::<Vec<_>>().join(", ")
        ),
    )
}

/// ΔT ~ w_A/g: the quotient is 1 + ε, where all the impulse comes in impacts.
fn intervals(data: &Fig13Data) -> Claim {
    let scaled = |point: &SweepPoint| {
        data.motor.preload_acceleration_m_per_s2 * point.mean_impact_interval_s
            / point.mean_impact_speed_m_per_s
    };
    let chaotic = |parameter: Parameter| {
        let points = sweep(data, parameter).map_or(&[][..], |sweep| &sweep.points);
        points.iter().filter(|point| !point.statistics.is_low_period())
    };
    let (low, high) = extent(chaotic(Parameter::Amplitude).map(scaled));
    let by_restitution = chaotic(Parameter::Restitution)
        .map(|point| format!("{:.2}: {:.2}", point.value, scaled(point)))
        .collect::<Vec<_>>()
        .join(", ");
    Claim::printed_statement(
        "section5.impulse_grows_with_speed",
        high - low <= PROPORTIONAL_WITHIN * low,
        format!(
            "an impact that slides throughout has the impulse μ(1 + ε)w_A exactly; g ΔT/w_A of mean interval and mean speed is \
             {low:.3} to {high:.3} over two decades of A. By ε it is {by_restitution}: the factor is 1 + ε, which the scaling leaves out"
        ),
    )
}

/// Both fall with ε, low-period cycles broken.
fn restitution_lowers_both(data: &Fig13Data) -> Claim {
    let points = sweep(data, Parameter::Restitution).map_or(&[][..], |sweep| &sweep.points);
    let speeds: Vec<_> =
        points.iter().map(|point| (point.value, point.broken.steady_speed_rad_per_s.mean)).collect();
    let lines = [StraightLine::through(&speeds), broken_stall(data)];
    Claim::printed_statement(
        "section5.restitution_lowers_both",
        lines.iter().all(|line| line.is_some_and(|line| line.slope + 2.0 * line.slope_error < 0.0)),
        format!(
            "slopes against ε over the whole range, low-period cycles broken by perturbations of {} g/ω: {} rad/s and {} rad/s²",
            data.breaking_perturbation,
            words(lines[0]),
            words(lines[1]),
        ),
    )
}

/// The straight line through stall acceleration against ε, low-period cycles broken.
fn broken_stall(data: &Fig13Data) -> Option<StraightLine> {
    let points = sweep(data, Parameter::Restitution).map_or(&[][..], |sweep| &sweep.points).iter();
    let read = points.filter_map(|point| {
        point.broken.stall_acceleration_rad_per_s2.map(|spread| (point.value, spread.mean))
    });
    StraightLine::through(&read.collect::<Vec<_>>())
}

/// Ĥ/ΔT ~ μ g (1 + ε).
fn simplistic(data: &Fig13Data) -> Claim {
    let line = broken_stall(data);
    Claim::printed_statement(
        "section5.scaling_fails_for_restitution",
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
