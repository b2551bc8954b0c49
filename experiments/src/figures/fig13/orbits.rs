//! The effect of the orbits on steady speed and stall torque.

use std::f64::consts::{FRAC_PI_8, PI};

use bouncing_disk::core::numerics::elementary::ln;

use super::data::{
    Fig13Data, ID, Parameter, Prevalence, Quantity, SweepPoint, extent, read, speed, stall, sweep,
    sweep_points, words,
};
use crate::claims::judging::trend;
use crate::claims::{Cases, Claim, all, any};
use crate::figures::shared::motor::LOW_PERIOD_FLIGHTS;
use crate::figures::shared::numbers::{Concentration, StraightLine};

/// A quotient that changes by less than this share over two decades of A counts as constant.
const CONSTANT_WITHIN: f64 = 0.1;

/// ε at which a share that falls with ε crosses one half, between the values computed.
fn crossing(data: &Fig13Data, share: impl Fn(&Prevalence) -> f64) -> f64 {
    let pairs = data.alike.prevalence.windows(2).rev();
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

/// The ε below which most motors are of low period, by the one definition, and by others.
pub(super) fn prevalent(data: &Fig13Data) -> Claim {
    let alike = &data.alike;
    const KEY: &str = "section5.low_period_restitution";
    let counts = alike.prevalence.first().map_or(0, |entry| entry.share_up_to.len());
    let by_flights = (0..counts).map(|index| {
        let flights = alike.prevalence[0].share_up_to[index].0;
        (format!("{flights} flights"), crossing(data, |entry| up_to(entry, index)))
    });
    let definitions: Vec<(String, f64)> = by_flights
        .chain([("a hundredth of the rise time".to_owned(), crossing(data, |entry| entry.share_of_short))])
        .collect();
    let words = definitions.iter().map(|(name, crossing)| format!("{name}: {crossing:.3}"));
    let verdicts = definitions.iter().map(|(_, crossing)| Claim::printed(KEY, *crossing).verdict);
    Claim::printed(KEY, crossing(data, |entry| entry.share_of_low_period))
        .note(format!(
            "the ε at which half of {} single orbits are of low period, a chattering cycle of at most {LOW_PERIOD_FLIGHTS} flights of more than half a period; with other bounds: {}",
            alike.drawn,
            words.collect::<Vec<_>>().join("; ")
        ))
        .by_definition(&verdicts.collect::<Vec<_>>())
}

/// How often the exponential fits better, and that low period is the more common the smaller ε is.
pub(super) fn commonness(data: &Fig13Data) -> [Claim; 2] {
    let alike = &data.alike;
    let shares: Vec<f64> = alike.draws.iter().map(|draw| draw.share_of_exponential).collect();
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    let shares_of_low = alike.prevalence.iter().map(|entry| (entry.restitution, entry.share_of_low_period));
    [
        Claim::printed_statement(
            "section5.most_transients_exponential",
            Cases::of_share(mean),
            format!(
                "the exponential fits better than a linear rise to a constant for {:.0} % of {} single orbits at {} values of ε from 0 on",
                100.0 * mean,
                shares.len(),
                alike.prevalence.len(),
            ),
        ),
        Claim::printed_statement(
            "section5.smaller_restitution_gives_low_period",
            trend(shares_of_low, -1.0),
            format!("share of low period among {} motors that print alike", alike.drawn),
        ),
    ]
}

/// Low-period orbits at an ε below that of the paper's motor.
pub(super) fn reduced_restitution(data: &Fig13Data) -> Claim {
    let printed = data.motor.restitution;
    let lower = data.alike.prevalence.iter().filter(|entry| entry.restitution < printed);
    Claim::printed_statement(
        "section5.reduced_restitution",
        any(lower.clone(), |entry| entry.share_of_low_period > 0.5),
        format!(
            "up to {:.0} % of {} motors that print like Table III's are of low period at an ε below {printed}",
            100.0 * extent(lower.map(|entry| entry.share_of_low_period)).1,
            data.alike.drawn,
        ),
    )
}

/// The mean direction is "at τ = 0" within half of an eighth of the cycle; cos τ changes by less than a
/// thirteenth up to there.
const AT_ZERO: f64 = FRAC_PI_8;

/// The statements on where in the cycle the collisions fall. A chattering sequence has infinitely many: the
/// collisions that are counted are those that end a flight of more than half a period; all are weighed by
/// their impulse. The paper's argument is about cos τ, so that the measures are those of circular statistics,
/// the mean direction and the mean cosine; there is no width to choose.
pub(super) fn phases_of_impulse(data: &Fig13Data) -> [Claim; 2] {
    let both: Vec<Option<[Concentration; 2]>> =
        data.impulses.iter().map(|impulse| Some([impulse.impulse?, impulse.collisions?])).collect();
    let at_zero = all(&both, |pair| {
        pair.is_some_and(|pair| pair.iter().all(|of| of.mean_direction_rad.abs() <= AT_ZERO))
    });
    let falls = all(both.windows(2), |pair| {
        pair[0].zip(pair[1]).is_some_and(|(one, other)| {
            one.iter().zip(other).all(|(one, other)| one.mean_cosine() > other.mean_cosine())
        })
    });
    let listed = |of: fn(&Concentration) -> String| {
        let rows = data.impulses.iter().zip(&both).map(|(impulse, both)| {
            let words = both.map_or_else(
                || "none".to_owned(),
                |[impulse, collisions]| format!("{} and {}", of(&impulse), of(&collisions)),
            );
            format!("ε = {}: {words}", impulse.restitution)
        });
        rows.collect::<Vec<_>>().join("; ")
    };
    [
        Claim::printed_statement(
            "section5.collisions_at_zero_phase",
            at_zero,
            format!(
                "the mean directions of the normal impulse, and of the collisions that end a flight of more than half a period, are within π/8 of τ = 0: {}",
                listed(|of| format!("{:+.3}π", of.mean_direction_rad / PI)),
            ),
        ),
        Claim::printed_statement(
            "section5.concentration_falls_with_restitution",
            falls,
            format!(
                "the mean of cos τ, of the impulse and of these collisions, falls: {}",
                listed(|of| format!("{:.3}", of.mean_cosine())),
            ),
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
    Claim::printed_statement(
        "section5.slower_collisions",
        line.is_some_and(|line| line.slope - 2.0 * line.slope_error > 0.0),
        format!("mean impact speed grows with the exponent {} of A", words(line)),
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
    Claim::printed_statement(
        "section5.impulse_grows_with_speed",
        high - low <= CONSTANT_WITHIN * low,
        format!(
            "an impact that slides throughout has the impulse μ(1 + ε)w_A exactly; g ΔT/w_A of mean interval and mean speed is \
             {low:.3} to {high:.3} over two decades of A: 1 + ε, which the scaling leaves out"
        ),
    )
}

fn negative(slope: Option<f64>) -> bool {
    slope.is_some_and(|slope| slope < 0.0)
}

/// Both fall with ε.
pub(super) fn restitution_lowers_both(data: &Fig13Data) -> Claim {
    let draws = data.alike.draws.iter();
    let falls = [speed as Quantity, stall].map(|of| trend(read(data, Parameter::Restitution, of), -1.0));
    Claim::printed_statement(
        "section5.restitution_lowers_both",
        all(falls, |pairs| 2 * pairs.holding > pairs.tried),
        format!(
            "of all pairs of ε the speed falls in {}, α̇_ss/t_c in {}; of single orbits the signs of both slopes count",
            falls[0].words(),
            falls[1].words(),
        ),
    )
    .single_orbits(Cases::of(draws.map(|draw| negative(draw.speed_ratio_slope) && negative(draw.stall_over_limit_slope))))
}

/// Ĥ/ΔT ~ μ g (1 + ε).
pub(super) fn simplistic(data: &Fig13Data) -> Claim {
    let rises = data.alike.draws.iter().map(|draw| draw.stall_over_limit_rise);
    // 1 + ε over its value at the first ε, less 1.
    let rows = &data.alike.prevalence;
    let predicted = rows
        .first()
        .zip(rows.last())
        .map_or(f64::NAN, |(first, last)| (last.restitution - first.restitution) / (1.0 + first.restitution));
    let mean = StraightLine::through(&read(data, Parameter::Restitution, stall))
        .zip(rows.first().zip(rows.last()))
        .map(|(line, (first, last))| line.slope * (last.restitution - first.restitution) / line.intercept);
    Claim::printed_statement(
        "section5.scaling_fails_for_restitution",
        mean.map(|rise| rise < 0.5 * predicted),
        format!(
            "over the range of ε the scaling has α̇_ss/t_c rise by {:.0} %, its mean changes by {:.0} %: the time between impacts is (1 + ε)w_A/g, so that the factor cancels",
            100.0 * predicted,
            100.0 * mean.unwrap_or(f64::NAN),
        ),
    )
    .single_orbits(Cases::of(rises.map(|rise| rise.is_some_and(|rise| rise < 0.5 * predicted))))
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
