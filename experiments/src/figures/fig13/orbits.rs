//! Low-period cycles, and where in the cycle the collisions fall.

use std::f64::consts::{FRAC_PI_8, PI};

use bouncing_disk::core::numerics::elementary::ln;

use super::single_orbits::Prevalence;
use super::{ImpulsePhases, Study, SweepPoint};
use crate::claims::judging::trend;
use crate::claims::{Cases, Claim, Kind, all, any};
use crate::figures::shared::inputs::motor as inputs;
use crate::figures::shared::motor::LOW_PERIOD_FLIGHTS;
use crate::figures::shared::numbers::{Concentration, StraightLine, extent};

/// A quotient that changes by less than this share over two decades of A counts as constant.
const CONSTANT_WITHIN: f64 = 0.1;

/// The mean direction is "at τ = 0" within half of an eighth of the cycle; cos τ changes by less than a
/// thirteenth up to there.
const AT_ZERO: f64 = FRAC_PI_8;

pub(super) fn claims(study: &Study) -> Vec<Claim> {
    let prevalence = &study.alike.prevalence;
    let shares = study.alike.draws.iter().map(|draw| draw.share_of_exponential);
    let mean = shares.sum::<f64>() / study.alike.draws.len() as f64;
    let printed = study.motor.restitution;
    let lower = prevalence.iter().filter(|entry| entry.restitution < printed);
    let of_pairs = |share: &dyn Fn(&Prevalence) -> f64| {
        trend(prevalence.iter().map(|entry| (entry.restitution, share(entry))), -1.0)
    };
    let definitions = prevalence.first().map_or(0, |entry| entry.share_up_to.len());
    let by_flights: Vec<_> = (0..definitions)
        .map(|index| Kind::Trend.verdict(of_pairs(&|entry| entry.share_up_to[index].1)))
        .collect();
    let ends = prevalence.first().zip(prevalence.last());
    let falling = ends.map_or_else(String::new, |(first, last)| {
        let percent = |entry: &Prevalence| {
            format!("{:.0} % at ε = {}", 100.0 * entry.share_of_low_period, entry.restitution)
        };
        format!("{} to {}", percent(first), percent(last))
    });
    let [at_zero, falls] = phases_of_impulse(study);
    vec![
        prevalent(prevalence, study.alike.drawn),
        Claim::printed_statement(
            "section5.most_transients_exponential",
            Cases::of_share(mean),
            format!(
                "the exponential fits better than a linear rise to a constant for {:.0} % of {} single orbits at {} values of ε from 0 on",
                100.0 * mean,
                study.alike.drawn,
                prevalence.len(),
            ),
        ),
        Claim::printed_statement(
            "section5.smaller_restitution_gives_low_period",
            trend(prevalence.iter().map(|entry| (entry.restitution, entry.share_of_low_period)), -1.0),
            format!(
                "share of low period among {} motors whose inputs print alike: {falling}",
                study.alike.drawn
            ),
        )
        .by_definition(&by_flights),
        Claim::printed_statement(
            "section5.reduced_restitution",
            any(lower.clone(), |entry| entry.share_of_low_period > 0.5),
            format!(
                "up to {:.0} % of {} motors whose inputs print like Table III's are of low period at an ε below {printed}",
                100.0 * extent(lower.map(|entry| entry.share_of_low_period)).1,
                study.alike.drawn,
            ),
        ),
        at_zero,
        falls,
        slower_collisions(study),
        intervals(study),
        form(study),
    ]
}

/// ε at which a share that falls with ε crosses one half, between the values computed.
fn crossing(prevalence: &[Prevalence], share: impl Fn(&Prevalence) -> f64) -> f64 {
    let pair = prevalence.windows(2).rev().find(|pair| share(&pair[0]) >= 0.5 && share(&pair[1]) < 0.5);
    pair.map_or(f64::NAN, |pair| {
        let part = (share(&pair[0]) - 0.5) / (share(&pair[0]) - share(&pair[1]));
        pair[0].restitution + part * (pair[1].restitution - pair[0].restitution)
    })
}

/// The ε below which most motors are of low period, by the one definition, and by others.
fn prevalent(prevalence: &[Prevalence], drawn: usize) -> Claim {
    const KEY: &str = "section5.low_period_restitution";
    let counts = prevalence.first().map_or(&[][..], |entry| &entry.share_up_to);
    let of_count = |index: usize| move |entry: &Prevalence| entry.share_up_to[index].1;
    let by_flights: Vec<f64> = (0..counts.len()).map(|index| crossing(prevalence, of_count(index))).collect();
    let short = crossing(prevalence, |entry| entry.share_of_short);
    let words =
        counts.iter().zip(&by_flights).map(|((flights, _), crossing)| format!("{flights}: {crossing:.3}"));
    let verdicts = by_flights.iter().chain([&short]).map(|crossing| Claim::printed(KEY, *crossing).verdict);
    Claim::printed(KEY, crossing(prevalence, |entry| entry.share_of_low_period))
        .note(format!(
            "half of {drawn} orbits chatter with at most {LOW_PERIOD_FLIGHTS} long flights; {}",
            words.collect::<Vec<_>>().join(", ")
        ))
        .by_definition(&verdicts.collect::<Vec<_>>())
}

/// The statements on where in the cycle the collisions fall. The paper does not say which count and with what weight: all of
/// them as they come, up to its cut of a chatter, those that end a flight of more than half a period, or all by their impulse.
/// Its argument is about cos τ, so that the measures are those of circular statistics, the mean direction and the mean
/// cosine; there is no width to choose.
fn phases_of_impulse(study: &Study) -> [Claim; 2] {
    let readings = |impulse: &ImpulsePhases| Some([impulse.impulse?, impulse.landings?, impulse.collisions?]);
    let all_readings: Option<Vec<[Concentration; 3]>> = study.impulses.iter().map(readings).collect();
    let all_readings = all_readings.unwrap_or_default();
    const READINGS: [&str; 3] = ["impulse", "after long flights", "all collisions"];
    let listed = |of: &dyn Fn(&Concentration) -> String| {
        let words = READINGS.iter().enumerate().map(|(index, name)| {
            let values: Vec<_> = all_readings.iter().map(|of_one| of(&of_one[index])).collect();
            format!("{name} {}", values.join(", "))
        });
        words.collect::<Vec<_>>().join("; ")
    };
    let reading = |index: usize| all_readings.iter().map(move |of_one| of_one[index]);
    let at_zero = |index: usize| all(reading(index), |of| of.mean_direction_rad.abs() <= AT_ZERO);
    let falls = |index: usize| {
        trend(
            study.impulses.iter().map(|of| of.restitution).zip(reading(index).map(|of| of.mean_cosine())),
            -1.0,
        )
    };
    [
        Claim::printed_statement(
            "section5.collisions_at_zero_phase",
            at_zero(0),
            format!(
                "directions within π/8 of 0 by ε: {}",
                listed(&|of| format!("{:+.2}π", of.mean_direction_rad / PI)),
            ),
        )
        .by_definition(&[1, 2].map(|index| Kind::Comparison.verdict(Cases::from(at_zero(index))))),
        Claim::printed_statement(
            "section5.concentration_falls_with_restitution",
            falls(0),
            format!("mean cos τ by ε: {}", listed(&|of| format!("{:.3}", of.mean_cosine())),),
        )
        .by_definition(&[1, 2].map(|index| Kind::Trend.verdict(falls(index)))),
    ]
}

/// Small A: slower collisions, and more of them.
fn slower_collisions(study: &Study) -> Claim {
    let chaotic = study.chaotic(inputs::AMPLITUDE);
    let logarithms = chaotic.map(|point| (ln(point.value), ln(point.mean_impact_speed_m_per_s)));
    let line = StraightLine::through(&logarithms.collect::<Vec<_>>());
    let words = line
        .map_or_else(|| "no fit".to_owned(), |line| format!("{:+.3} ± {:.3}", line.slope, line.slope_error));
    Claim::printed_statement(
        "section5.slower_collisions",
        line.is_some_and(|line| line.slope - 2.0 * line.slope_error > 0.0),
        format!("mean impact speed grows with the exponent {words} of A"),
    )
}

/// ΔT ~ w_A/g: the quotient is 1 + ε, where all the impulse comes in impacts.
fn intervals(study: &Study) -> Claim {
    let scaled = |point: &SweepPoint| {
        study.motor.preload_acceleration_m_per_s2 * point.mean_impact_interval_s
            / point.mean_impact_speed_m_per_s
    };
    let (low, high) = extent(study.chaotic(inputs::AMPLITUDE).map(scaled));
    Claim::printed_statement(
        "section5.impulse_grows_with_speed",
        high - low <= CONSTANT_WITHIN * low,
        format!(
            "an impact that slides throughout has the impulse μ(1 + ε)w_A exactly; g ΔT/w_A of mean interval and mean speed is \
             {low:.3} to {high:.3} over two decades of A: 1 + ε, which the scaling leaves out"
        ),
    )
}

/// How well the phases of the impulse predict all points.
fn form(study: &Study) -> Claim {
    let chaotic = study.all_points().filter(|point| !point.statistics.is_low_period());
    let off: Vec<f64> =
        chaotic.map(|point| (point.speed_ratio() - point.predicted_speed_ratio).abs()).collect();
    let (worst, count) = (off.iter().copied().fold(0.0, f64::max), off.len());
    let root_mean_square = (off.iter().map(|value| value * value).sum::<f64>() / count as f64).sqrt();
    Claim::statement(
        "fig13",
        "our derivation",
        "the steady speed is ωΦ times the impulse-weighted median of cos(τ + θ)",
        root_mean_square <= 0.05,
        format!(
            "over {count} motors the speed ratio is off by {root_mean_square:.3} (root mean square), {worst:.3} at most"
        ),
    )
}
