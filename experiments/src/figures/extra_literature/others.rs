//! What single sources state: speeds, impulses, periods, rests.

use std::ops::ControlFlow;

use bouncing_disk::core::elementary::ln;
use bouncing_disk::core::numerics::batch_means::BatchMeans;
use bouncing_disk::core::{ChatterPolicy, Orbit, SweepEvent, sweep};

use super::behaviour::{Behaviour, behaviours_of, counted, map, map_at, own_speed, starts, verdicts_after_rest, SETTINGS};
use super::catalogue::Entry;
use super::data::{Answer, rounded};
use super::windows::Window;
use super::{Answers, paper};

/// How the time from rest to rest grows as the restitution comes near 1.
pub(super) fn rest_to_rest(_: &Entry) -> Answers {
    const PEAK: f64 = 2.0;
    const RESTITUTIONS: [f64; 5] = [0.8, 0.9, 0.95, 0.98, 0.99];
    const IMPACTS: u64 = 40_000;
    let mut means = Vec::new();
    for restitution in RESTITUTIONS {
        let map = map(PEAK, restitution)?;
        let orbits: Vec<Orbit> =
            starts(&map, 6)?.iter().map(|(map, start)| map.orbit(*start, ChatterPolicy::Complete)).collect();
        // Impacts, periods in all, and rests.
        let counts = sweep(
            &orbits,
            |_| [0_u64; 3],
            |[impacts, periods, rests], event| {
                match event {
                    SweepEvent::Impact(landing) => {
                        *impacts += 1;
                        *periods += landing.turns;
                    }
                    SweepEvent::Attachment(rest) => {
                        *periods += rest.accumulation.turns + rest.separation.map_or(0, |(_, turns)| turns);
                        *rests += 1;
                    }
                    _ => return ControlFlow::Break(()),
                }
                if *impacts < IMPACTS { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            },
        )?;
        let sum = |index: usize| counts.iter().map(|count| count[index]).sum::<u64>();
        means.push((restitution, sum(1), sum(2)));
    }
    let mean = |(restitution, periods, rests): &(f64, u64, u64)| (1.0 / (1.0 - restitution), *periods as f64 / (*rests).max(1) as f64);
    let slopes: Vec<String> = means
        .windows(2)
        .filter(|pair| pair.iter().all(|(_, _, rests)| *rests > 0))
        .map(|pair| {
            let ((x, y), (next_x, next_y)) = (mean(&pair[0]), mean(&pair[1]));
            format!("{:.2}", ln(next_y / y) / ln(next_x / x))
        })
        .collect();
    let listed: Vec<String> = means
        .iter()
        .map(|at| format!("{} at r = {} ({})", rounded(mean(at).1, 3), at.0, counted(at.2, "rest")))
        .collect();
    let text = format!("P = {PEAK}: periods from rest to rest {}; local powers {}", listed.join(", "), slopes.join(", "));
    Ok(vec![(
        "exponent",
        Answer::nothing_printed(text)
            .because("the exponent is not legible in either copy; all periods over all rests of 36 starts with 40,000 impacts each"),
    )])
}

/// The strip of speeds of the reduced map.
pub(super) fn strip(_: &Entry) -> Answers {
    let fastest = super::speeds::fastest()?;
    let beyond: Vec<&super::speeds::Fastest> = fastest.iter().filter(|at| at.speed > at.reduced * (1.0 + 1e-9)).collect();
    let most = fastest.iter().map(|at| (at.speed / at.reduced, at)).max_by(|one, other| one.0.total_cmp(&other.0));
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
    let answer = Answer::statement(!ratios.is_empty() && largest < 1e-12, rounded(ratios.first().copied().unwrap_or(f64::NAN), 6))
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
    let (mut impacts, mut periods) = (Vec::new(), Vec::new());
    for behaviour in found.iter().flat_map(|at| at.iter()) {
        if let Behaviour::Periodic { impacts: own, platform_periods, .. } = behaviour {
            impacts.push(own);
            periods.push(platform_periods);
        }
    }
    let listed = |mut values: Vec<u64>| {
        values.sort_unstable();
        values.dedup();
        values.iter().map(u64::to_string).collect::<Vec<_>>().join(", ")
    };
    let text = format!("attracting orbits of {} impacts, in {} periods of the platform", listed(impacts), listed(periods));
    let window = Window::of(restitution, 3);
    let multipliers = map(0.5 * (window.birth + window.doubling), restitution)?
        .period_one_pair(3)
        .map(|pair| format!("{:.4}", pair.node.multipliers()));
    Ok(vec![
        (
            "periods",
            Answer::not_comparable(text).because(format!(
                "their frequencies are not in the text; {COLUMNS} values of P from 0.05 to 1.2 with 144 starts, followed for {} impacts each, in \
                 which orbits shrink by {:.0e}",
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
    let forcing = |column: u32| 1.0 / std::f64::consts::PI + 2.0 * (f64::from(column) + 0.5) / f64::from(COLUMNS);
    let maps = (0..COLUMNS).map(|column| map_at(forcing(column), 0.0)).collect::<Result<Vec<_>, _>>()?;
    let verdicts = verdicts_after_rest(&maps, SETTINGS)?;
    let mut first: Vec<(u64, u64, f64)> = Vec::new();
    for (column, verdict) in (0..COLUMNS).zip(&verdicts) {
        if let Behaviour::Chattering { long_flights, platform_periods } = Behaviour::of(verdict) {
            if !first.iter().any(|known| (known.0, known.1) == (long_flights, platform_periods)) {
                first.push((long_flights, platform_periods, forcing(column)));
            }
        }
    }
    let listed: Vec<String> = first
        .iter()
        .take(6)
        .map(|(flights, periods, forcing)| {
            format!("{} in {} from Γ = {}", counted(*flights, "long flight"), counted(*periods, "period"), rounded(*forcing, 3))
        })
        .collect();
    let text = format!("at r = 0 rounds with rest: {}", listed.join("; "));
    Ok(vec![("orbits", Answer::not_comparable(text).because("the abstract has no number, and a trimer is no disk"))])
}

/// The mean square speed under strong forcing.
pub(super) fn mean_square(entry: &Entry) -> Answers {
    const PEAKS: [f64; 3] = [50.0, 200.0, 1_000.0];
    const IMPACTS: usize = 3_000;
    const SKIPPED: usize = 200;
    let restitution = entry.input("restitution")?;
    let random_phase = (1.0 + restitution) / (2.0 * (1.0 - restitution));
    let weighted = (1.0 + 3.0 * restitution) / (2.0 * (1.0 - restitution));
    let (mut listed, mut holds, mut last) = (Vec::new(), true, f64::NAN);
    for peak in PEAKS {
        let map = map(peak, restitution)?;
        let orbits: Vec<Orbit> =
            starts(&map, 8)?.iter().map(|(map, start)| map.orbit(*start, ChatterPolicy::Complete)).collect();
        let mut squares = BatchMeans::default();
        for state in bouncing_disk::core::orbit_diagram(&orbits, SKIPPED, IMPACTS)?.iter().flatten() {
            let share = own_speed(&map, state) / peak;
            squares.push(share * share);
        }
        let (mean, error) = (squares.mean(), squares.standard_error());
        let (Some(mean), Some(error)) = (mean, error) else { return Err(paper::lost("mean square")) };
        holds &= (mean - random_phase).abs() < 5.0 * error;
        last = mean;
        listed.push(format!("{mean:.3} ± {error:.3} at P = {peak}"));
    }
    let answer = Answer::statement(holds, format!("over P²: {}, against {}", listed.join(", "), rounded(random_phase, 4)))
        .with_value(last)
        .because(format!(
            "impacts are not spread evenly over the phase: a rising platform is met more often. With a weight of the relative speed it \
             would be (1 + 3r)/(2(1 − r)) = {} for balls that are much faster than the platform (docs/numerics/dynamics.md)",
            rounded(weighted, 4)
        ));
    Ok(vec![("mean_square", answer)])
}
