//! What the orbits do to steady speed and stall torque.

use bouncing_disk::core::elementary::ln;

use super::data::{Fig13Data, Parameter, Prevalence, SweepPoint};
use super::reading::{extent, sweep, sweep_points, words};
use super::statements::ID;
use crate::claim::Claim;
use crate::figures::regression::StraightLine;

/// A quotient that changes by less than this share over two decades of A counts as constant.
const CONSTANT_WITHIN: f64 = 0.1;

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

pub(super) fn prevalent(data: &Fig13Data) -> Vec<Claim> {
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

pub(super) fn phases_of_impulse(data: &Fig13Data) -> [Claim; 2] {
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
pub(super) fn slower_collisions(data: &Fig13Data) -> Claim {
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
pub(super) fn intervals(data: &Fig13Data) -> Claim {
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
        high - low <= CONSTANT_WITHIN * low,
        format!(
            "an impact that slides throughout has the impulse μ(1 + ε)w_A exactly; g ΔT/w_A of mean interval and mean speed is \
             {low:.3} to {high:.3} over two decades of A. By ε it is {by_restitution}: the factor is 1 + ε, which the scaling leaves out"
        ),
    )
}

/// Both fall with ε, low-period cycles broken.
pub(super) fn restitution_lowers_both(data: &Fig13Data) -> Claim {
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
pub(super) fn simplistic(data: &Fig13Data) -> Claim {
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
pub(super) fn form(data: &Fig13Data) -> Claim {
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
