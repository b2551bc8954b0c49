//! What single sources state: speeds, impulses, periods, rests.

use std::ops::ControlFlow;

use bouncing_disk::core::elementary::ln;
use bouncing_disk::core::numerics::batch_means::BatchMeans;
use bouncing_disk::core::{ChatterPolicy, Orbit, SweepEvent, orbit_diagram, sweep};

use super::behaviour::{
    Behaviour, SETTINGS, behaviours_of, counted, map, map_at, own_speed, starts, verdicts_after_rest,
};
use super::catalogue::Entry;
use super::data::{Answer, rounded};
use super::windows::Window;
use super::{Answers, paper};
use crate::experiment::ExperimentError;

/// What happened up to the last impact of an orbit.
#[derive(Clone, Copy, Default)]
struct Counted {
    impacts: u64,
    platform_periods: u64,
    rests: u64,
    impacts_at_last_rest: u64,
}

/// How the time from rest to rest grows as the restitution comes near 1.
pub(super) fn rest_to_rest(_: &Entry) -> Answers {
    const PEAK: f64 = 20.0;
    const RESTITUTIONS: [f64; 5] = [0.5, 0.6, 0.7, 0.8, 0.9];
    const IMPACTS: u64 = 20_000;
    let (mut means, mut trapped) = (Vec::new(), Vec::new());
    for restitution in RESTITUTIONS {
        let map = map(PEAK, restitution)?;
        let orbits: Vec<Orbit> =
            starts(&map, 6)?.iter().map(|(map, start)| map.orbit(*start, ChatterPolicy::Complete)).collect();
        let counts = sweep(
            &orbits,
            |_| Counted::default(),
            |count, event| {
                match event {
                    SweepEvent::Impact(landing) => {
                        count.impacts += 1;
                        count.platform_periods += landing.turns;
                    }
                    SweepEvent::Attachment(rest) => {
                        count.platform_periods +=
                            rest.accumulation.turns + rest.separation.map_or(0, |(_, turns)| turns);
                        count.rests += 1;
                        count.impacts_at_last_rest = count.impacts;
                    }
                    _ => return ControlFlow::Break(()),
                }
                if count.impacts < IMPACTS { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            },
        )?;
        let periods: u64 = counts.iter().map(|count| count.platform_periods).sum();
        let rests: u64 = counts.iter().map(|count| count.rests).sum();
        means.push((1.0 / (1.0 - restitution), periods as f64 / rests.max(1) as f64));
        trapped.push(counts.iter().filter(|count| 2 * count.impacts_at_last_rest < IMPACTS).count());
    }
    let slopes: Vec<String> = means
        .windows(2)
        .map(|pair| format!("{:.1}", ln(pair[1].1 / pair[0].1) / ln(pair[1].0 / pair[0].0)))
        .collect();
    let listed: Vec<String> = RESTITUTIONS
        .iter()
        .zip(&means)
        .map(|(restitution, (_, mean))| format!("{} at r = {restitution}", rounded(*mean, 3)))
        .collect();
    let text = format!(
        "no one power at P = {PEAK}: periods from rest to rest {}, powers between them {}",
        listed.join(", "),
        slopes.join(", ")
    );
    let reason = format!(
        "the exponent is not legible in either copy. All periods over all rests of 36 starts with {IMPACTS} impacts each; {} of these did not rest in \
         the second half at r = 0.9, where attractors without rest hold them or the time is too short",
        trapped.last().copied().unwrap_or_default()
    );
    Ok(vec![("exponent", Answer::nothing_printed(text).because(reason))])
}

/// The strip of speeds of the reduced map.
pub(super) fn strip(_: &Entry) -> Answers {
    let fastest = super::speeds::fastest()?;
    let beyond: Vec<&super::speeds::Fastest> =
        fastest.iter().filter(|at| at.speed > at.reduced * (1.0 + 1e-9)).collect();
    let most =
        fastest.iter().map(|at| (at.speed / at.reduced, at)).max_by(|one, other| one.0.total_cmp(&other.0));
    let text = most.map_or_else(String::new, |(share, at)| {
        format!(
            "own speeds up to {} of P (1 + r)/(1 − r), at r = {}, P = {}; beyond it in {} of {} maps",
            rounded(share, 3),
            at.restitution,
            at.peak_acceleration,
            beyond.len(),
            fastest.len()
        )
    });
    Ok(vec![(
        "strip",
        Answer::not_comparable(text).because(
            "the units of σ and v are not in the text; a map of Holmes' form would have this strip. The proven bound of the exact \
             map is that of docs/numerics/dynamics.md",
        ),
    )])
}

/// The impulse of the orbit with an impact every other period over that of every period.
pub(super) fn impulse_ratio(entry: &Entry) -> Answers {
    let (mut ratios, mut largest) = (Vec::new(), 0.0_f64);
    let printed = entry.printed("ratio")?.value;
    for tenth in 0..=9 {
        let restitution = f64::from(tenth) / 10.0;
        for factor in [1.0, 1.5, 4.0] {
            let map = map(factor * Window::of(restitution, 2).birth * (1.0 + 1e-12), restitution)?;
            if let Some((one, two)) = map.period_one_pair(1).zip(map.period_one_pair(2)) {
                let ratio = two.node.state.velocity() / one.node.state.velocity();
                largest = largest.max((ratio - printed).abs());
                ratios.push(ratio);
            }
        }
    }
    let answer = Answer::statement(
        !ratios.is_empty() && largest < 1e-12,
        rounded(ratios.first().copied().unwrap_or(f64::NAN), 6),
    )
    .because(format!("{} pairs of orbits: the relative speed is 2πk/(1 + r), whatever P", ratios.len()));
    Ok(vec![("ratio", answer)])
}

/// The periods that are found next to elastic impacts.
pub(super) fn periods(entry: &Entry) -> Answers {
    const COLUMNS: u32 = 12;
    let restitution = entry.input("restitution")?;
    let maps = (0..COLUMNS)
        .map(|column| map(0.05 + 1.15 * (f64::from(column) + 0.5) / f64::from(COLUMNS), restitution))
        .collect::<Result<Vec<_>, _>>()?;
    let found = behaviours_of(&maps, 12)?;
    let mut impacts = Vec::new();
    let mut longest = 0;
    for behaviour in found.iter().flat_map(|at| at.iter()) {
        if let Behaviour::Periodic { impacts: own, platform_periods, .. } = behaviour {
            impacts.push(own);
            longest = longest.max(platform_periods);
        }
    }
    impacts.sort_unstable();
    impacts.dedup();
    let printed = entry.statement("periods")?.printed.as_deref().unwrap_or_default();
    let stated: Vec<u64> = printed
        .split("Period-")
        .filter_map(|part| part.trim_end_matches(|c: char| !c.is_ascii_digit()).parse().ok())
        .collect();
    let listed = impacts.iter().map(u64::to_string).collect::<Vec<_>>().join(", ");
    let text = format!("attracting orbits of {listed} impacts, in up to {longest} periods of the platform");
    let all = !stated.is_empty() && stated.iter().all(|period| impacts.contains(period));
    let window = Window::of(restitution, 3);
    let multipliers = map(0.5 * (window.birth + window.doubling), restitution)?
        .period_one_pair(3)
        .map(|pair| format!("{:.4}", pair.node.multipliers()));
    Ok(vec![
        (
            "periods",
            Answer::statement(all, text).because(format!(
                "their frequencies are not in the text: {COLUMNS} values of P from 0.05 to 1.2 with 144 starts, followed for {} impacts each, in \
                 which distances from a focus shrink to {:.0e} of themselves",
                SETTINGS.transient + SETTINGS.impacts,
                bouncing_disk::core::elementary::pow(restitution, (SETTINGS.transient + SETTINGS.impacts) as f64)
            )),
        ),
        (
            "doubling",
            Answer::nothing_printed(format!(
                "born at P = {}, doubles at P = {}",
                rounded(window.birth, 6),
                rounded(window.doubling, 7)
            ))
            .with_value(window.doubling)
            .because(format!("multipliers half-way: {}", multipliers.unwrap_or_else(|| "none".to_owned()))),
        ),
    ])
}

/// Orbits with a rest in each round, of a ball that does not bounce.
pub(super) fn without_bounce(_: &Entry) -> Answers {
    const COLUMNS: u32 = 400;
    let forcing =
        |column: u32| 1.0 / std::f64::consts::PI + 2.0 * (f64::from(column) + 0.5) / f64::from(COLUMNS);
    let maps = (0..COLUMNS).map(|column| map_at(forcing(column), 0.0)).collect::<Result<Vec<_>, _>>()?;
    let verdicts = verdicts_after_rest(&maps, SETTINGS)?;
    let mut first: Vec<(u64, u64, f64)> = Vec::new();
    for (column, verdict) in (0..COLUMNS).zip(&verdicts) {
        if let Behaviour::Chattering { long_flights, platform_periods } = Behaviour::of(verdict)
            && !first.iter().any(|known| (known.0, known.1) == (long_flights, platform_periods))
        {
            first.push((long_flights, platform_periods, forcing(column)));
        }
    }
    let listed: Vec<String> = first
        .iter()
        .take(6)
        .map(|(flights, periods, forcing)| {
            format!(
                "{} in {} from Γ = {}",
                counted(*flights, "long flight"),
                counted(*periods, "period"),
                rounded(*forcing, 3)
            )
        })
        .collect();
    let text = format!("at r = 0 rounds with rest: {}", listed.join("; "));
    Ok(vec![(
        "orbits",
        Answer::not_comparable(text).because("the abstract has no number, and a trimer is no disk"),
    )])
}

/// The mean square speed under strong forcing.
pub(super) fn mean_square(entry: &Entry) -> Answers {
    const PEAKS: [f64; 3] = [50.0, 200.0, 1_000.0];
    const NEARLY_ELASTIC: f64 = 0.95;
    let restitution = entry.input("restitution")?;
    let random_phase = (1.0 + restitution) / (2.0 * (1.0 - restitution));
    let (mut listed, mut holds, mut last) = (Vec::new(), true, f64::NAN);
    for peak in PEAKS {
        let (mean, error) = mean_square_at(peak, restitution)?;
        holds &= (mean - random_phase).abs() < 5.0 * error;
        last = mean;
        listed.push(format!("{mean:.3} ± {error:.3} at P = {peak}"));
    }
    let nearly_elastic = mean_square_at(PEAKS[2], NEARLY_ELASTIC)?;
    let answer = Answer::statement(holds, format!("over P²: {}, against {}", listed.join(", "), rounded(random_phase, 4)))
        .with_value(last)
        .because(format!(
            "impacts are not spread evenly over the phase: a rising platform is met more often. Weighted with the relative speed, for balls that \
             are mostly faster than the platform, it is (1 + 3r)/(2(1 − r)), docs/numerics/dynamics.md: {} here, and {} at r = {NEARLY_ELASTIC}, where the map gives {:.1} ± \
             {:.1} and random phases {}",
            rounded(weighted(restitution), 4),
            rounded(weighted(NEARLY_ELASTIC), 4),
            nearly_elastic.0,
            nearly_elastic.1,
            rounded((1.0 + NEARLY_ELASTIC) / (2.0 * (1.0 - NEARLY_ELASTIC)), 4)
        ));
    Ok(vec![("mean_square", answer)])
}

/// The mean square with phases that are weighted by the relative speed, over P^2.
fn weighted(restitution: f64) -> f64 {
    (1.0 + 3.0 * restitution) / (2.0 * (1.0 - restitution))
}

/// The mean square of the own speed after an impact over P^2, and its standard error.
fn mean_square_at(peak: f64, restitution: f64) -> Result<(f64, f64), ExperimentError> {
    const IMPACTS: usize = 3_000;
    const SKIPPED: usize = 200;
    let map = map(peak, restitution)?;
    let orbits: Vec<Orbit> =
        starts(&map, 8)?.iter().map(|(map, start)| map.orbit(*start, ChatterPolicy::Complete)).collect();
    let mut squares = BatchMeans::default();
    for state in orbit_diagram(&orbits, SKIPPED, IMPACTS)?.iter().flatten() {
        let share = own_speed(&map, state) / peak;
        squares.push(share * share);
    }
    squares.mean().zip(squares.standard_error()).ok_or_else(|| paper::lost("mean square"))
}
