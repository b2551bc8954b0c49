//! The rotation beyond period 1: mean speeds and branches in periods 2 and 4, and what Γ_T does to them.

use std::f64::consts::TAU;

use bouncing_disk::core::numerics::elementary::cos;
use bouncing_disk::estimate::Spread;
use serde::Serialize;

use super::diagram::{Diagram, Slice, sampled};
use super::period_one::STORED;
use super::{SAMPLED, listed};
use crate::claims::judging::trend;
use crate::claims::{Cases, Claim, Kind, all};
use crate::experiment::{ExperimentError, Paper};
use crate::figures::shared::map_in_parallel;
use crate::figures::shared::numbers::{distance, extent};

/// Angular speeds closer than this share of ωΦ look like one branch: dots of panel (d) are 0.6 points wide,
/// and ωΦ is 60 points long there.
const ONE_BRANCH: f64 = 0.01;

/// How far numbers that are no angles extend.
fn width(values: &[f64]) -> f64 {
    let (low, high) = extent(values.iter().copied());
    high - low
}

/// The statements about periods 2 and 4, and about Γ_T beyond; `crisis` ends the followed attractor.
pub(super) fn rotation(
    fig: &mut Paper<'_>,
    diagram: &Diagram,
    doublings: &[f64],
    crisis: f64,
) -> Result<(), ExperimentError> {
    let doubling = |n: usize| doublings.get(n - 1).copied().unwrap_or(f64::NAN);
    let period_two = diagram.between(doubling(1), doubling(2));
    let period_four = diagram.between(doubling(2), doubling(3));
    fig.claims(two_impacts(diagram, &period_two));
    fig.claims(mean_speeds(&period_two, &period_four));
    let four: Vec<&Slice> = period_four.into_iter().filter(|slice| slice.period == Some(4)).collect();
    let crossings = branch_crossings(&four);
    fig.claims(three_branches(&four, &crossings));
    fig.record("branch_crossings", &crossings)?;
    fig.claims(oscillation(diagram, doubling(2)));
    let effects = forcing_effects(diagram, doubling(2), crisis)?;
    fig.claim(increasingly(&effects));
    fig.record("forcing_effects", &effects)
}

/// The statements about the two impacts of period 2, those of large and of small |w_A|.
fn two_impacts(diagram: &Diagram, period_two: &[&Slice]) -> [Claim; 3] {
    // Index of the impact of large |w_A|.
    let twos: Vec<(&Slice, usize)> = period_two
        .iter()
        .filter(|slice| slice.period == Some(2) && slice.normalised_impact_speed.len() == 2)
        .map(|slice| {
            let speeds = &slice.normalised_impact_speed;
            (*slice, usize::from(speeds[1] >= speeds[0]))
        })
        .collect();
    // Both branches stay within a quarter of a period, far from the seam at 0.
    let monotone = |small: usize, sign: f64| {
        let phase = |(slice, large): &(&Slice, usize)| slice.impact_phase_cycles[large ^ small];
        all(twos.windows(2), |pair| sign * (phase(&pair[1]) - phase(&pair[0])) > 0.0)
    };
    // |w_T| in the larger of them, and the distances of the mean speed from the platform's speed in each.
    let of_motions = twos.iter().flat_map(|(slice, large)| {
        let [linear, semielliptical] = diagram.inputs.twists().map(|twist| twist.phase_lag_rad);
        let motion = |speeds: &[f64], mean: f64, lag: f64| {
            let platform = |impact: usize| cos(TAU * slice.impact_phase_cycles[impact] + lag);
            // The larger of the two: Eq. (16) would have to hold in both.
            let miss = (0..2).map(|impact| (speeds[impact] - platform(impact)).abs()).fold(0.0, f64::max);
            (miss, [*large, 1 - large].map(|impact| (mean - platform(impact)).abs()))
        };
        [
            motion(&slice.linear, slice.linear_mean, linear),
            motion(&slice.semielliptical, slice.semielliptical_mean, semielliptical),
        ]
    });
    let (misses, distances): (Vec<f64>, Vec<[f64; 2]>) = of_motions.unzip();
    let (least, most) = extent(misses.iter().copied());
    [
        Claim::printed_statement(
            "section4.period_two_branches",
            all([monotone(0, -1.0), monotone(1, 1.0)].into_iter().flatten(), |holds| holds),
            format!("from each of {} values of Γ to the next", twos.len()),
        ),
        Claim::printed_statement(
            "section4.eq16_fails_in_period_two",
            all(&misses, |miss| *miss > STORED),
            format!("the larger |w_T| of the two impacts is {least:.1e} to {most:.3} ωΦ in (c) and (d)"),
        ),
        Claim::printed_statement(
            "section4.large_branch_dominates",
            all(&distances, |[large, small]| large < small),
            format!("mean speed against the platform's in the two impacts, at {} values of Γ", twos.len()),
        ),
    ]
}

/// The mean speeds in period 2, and whether they turn at period 4.
fn mean_speeds(period_two: &[&Slice], period_four: &[&Slice]) -> [Claim; 4] {
    // An extremum at the doubling: the speed has turned in the nearer half of the period-4 region.
    let near = &period_four[..period_four.len().div_ceil(2)];
    let claims = |keys: [&str; 2], of: fn(&Slice) -> f64, sign: f64| {
        let go = |slices: &[&Slice], sign: f64| {
            trend(slices.iter().map(|slice| (slice.axial_forcing, of(slice))), sign)
        };
        let value = |slice: Option<&&Slice>| slice.map_or(f64::NAN, |slice| of(slice));
        let slope = |slices: &[&Slice]| match slices {
            [first, .., last] => (of(last) - of(first)) / (last.axial_forcing - first.axial_forcing),
            _ => f64::NAN,
        };
        let before = &period_two[period_two.len().saturating_sub(period_four.len())..];
        let speeds = [period_two.first(), period_two.last(), period_four.last()].map(value);
        let words = format!(
            "mean speed/(ωΦ) {} from Γ_1 over Γ_2 to Γ_3; slope {:+.1} just before Γ_2, {:+.1} after it",
            listed(speeds.iter().map(|speed| format!("{speed:.4}"))),
            slope(before),
            slope(period_four),
        );
        [
            Claim::printed_statement(keys[0], go(period_two, sign), words.as_str()),
            Claim::printed_statement(keys[1], go(near, -sign), words),
        ]
    };
    let [rises, rise_ends] = claims(
        ["section4.linear_rises_in_period_two", "section4.linear_turns_at_period_four"],
        |slice| slice.linear_mean,
        1.0,
    );
    let [falls, fall_ends] = claims(
        ["section4.semielliptical_falls_in_period_two", "section4.semielliptical_turns_at_period_four"],
        |slice| slice.semielliptical_mean,
        -1.0,
    );
    [
        rises,
        rise_ends,
        falls,
        fall_ends.note("a kink: it continues to fall").cause("a kink called an extremum"),
    ]
}

/// The Γ at which two branches of the period-4 orbit have the same speed in (d), between two slices each.
fn branch_crossings(four: &[&Slice]) -> Vec<f64> {
    let mut crossings = Vec::new();
    let mut before: Option<(f64, Vec<[f64; 3]>)> = None;
    for slice in four {
        let of_impact = |i: usize| {
            [slice.impact_phase_cycles[i], slice.normalised_impact_speed[i], slice.semielliptical[i]]
        };
        let mut impacts: Vec<[f64; 3]> = (0..slice.semielliptical.len()).map(of_impact).collect();
        if let Some((forcing, last)) = &before {
            // A round may begin with any of its impacts: the one that continues the branches.
            let apart = |shift: usize| -> f64 {
                let pairs = last.iter().zip(impacts.iter().cycle().skip(shift));
                pairs.map(|(a, b)| distance(a[0], b[0]) + (a[1] - b[1]).abs()).sum()
            };
            let shift = (0..impacts.len()).min_by(|a, b| apart(*a).total_cmp(&apart(*b))).unwrap_or_default();
            impacts.rotate_left(shift);
            for (one, other) in pairs(impacts.len()) {
                let was = last[other][2] - last[one][2];
                let is = impacts[other][2] - impacts[one][2];
                if (was < 0.0) != (is < 0.0) {
                    crossings.push(forcing + (slice.axial_forcing - forcing) * was / (was - is));
                }
            }
        }
        before = Some((slice.axial_forcing, impacts));
    }
    crossings
}

/// All pairs of indices.
fn pairs(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count).flat_map(|other| (0..other).map(move |one| (one, other)))
}

/// The two impacts of an orbit with the nearest speeds in (d): their distance there, and in the plane of
/// phase (periods) and |w_A Γ/(ωA)|.
fn nearest_speeds(slice: &Slice) -> Option<(f64, f64)> {
    let (phases, speeds) = (&slice.impact_phase_cycles, &slice.normalised_impact_speed);
    let gap = |(one, other): (usize, usize)| (slice.semielliptical[one] - slice.semielliptical[other]).abs();
    let nearest = pairs(slice.semielliptical.len()).min_by(|a, b| gap(*a).total_cmp(&gap(*b)))?;
    let (one, other) = nearest;
    Some((gap(nearest), distance(phases[one], phases[other]).max((speeds[one] - speeds[other]).abs())))
}

/// Two of the four branches of (d) cross or touch.
fn three_branches(four: &[&Slice], crossings: &[f64]) -> [Claim; 2] {
    let nearest: Vec<(f64, f64)> = four.iter().filter_map(|slice| nearest_speeds(slice)).collect();
    let alike: Vec<&(f64, f64)> = nearest.iter().filter(|(gap, _)| *gap < ONE_BRANCH).collect();
    let (least, _) = extent(alike.iter().map(|(_, apart)| *apart));
    [
        Claim::printed_statement(
            "section4.three_branches",
            // It appears so over most of the region, not at a point.
            all(Some(alike.len()).filter(|_| !nearest.is_empty()), |alike| 2 * alike > nearest.len()),
            format!(
                "two of the four speeds lie within {ONE_BRANCH} ωΦ, a dot's width, at {} of {} values of Γ; branches cross at Γ = {}",
                alike.len(),
                nearest.len(),
                listed(crossings.iter().map(|forcing| format!("{forcing:.4}"))),
            ),
        ),
        Claim::printed_statement(
            "section4.projection_hides_branch",
            all(&alike, |(gap, apart)| *apart > ONE_BRANCH && apart > gap),
            format!(
                "impacts whose speeds look alike are at least {least:.3} apart in τ_imp/2π or |w_A Γ/(ωA)| at the Γ drawn"
            ),
        ),
    ]
}

/// How far the speed after an impact is from that of the platform in the impact, on the mean over consecutive
/// impacts.
fn untracked(slice: &Slice, speeds: &[f64], lag: f64) -> Option<f64> {
    let impacts = speeds.iter().skip(1).zip(&slice.impact_phase_cycles);
    let misses: Vec<f64> = impacts.map(|(after, phase)| (after - cos(TAU * phase + lag)).abs()).collect();
    (!misses.is_empty()).then(|| misses.iter().sum::<f64>() / misses.len() as f64)
}

/// The range of the angular speeds beyond the second doubling, and how closely they follow the platform.
fn oscillation(diagram: &Diagram, start: f64) -> [Claim; 2] {
    let beyond = |slices: &[Slice]| -> Vec<Slice> {
        slices.iter().filter(|slice| slice.axial_forcing > start).cloned().collect()
    };
    let followed = beyond(&diagram.followed);
    let widths: Vec<(f64, f64)> = followed
        .iter()
        .chain(&beyond(&diagram.chattering))
        .map(|slice| (width(&slice.linear), width(&slice.semielliptical)))
        .collect();
    let (least, most) = extent(widths.iter().map(|(linear, semielliptical)| semielliptical / linear));
    let [linear, semielliptical] = diagram.inputs.twists().map(|twist| twist.phase_lag_rad);
    let tracked = |slice: &Slice| {
        Some((
            untracked(slice, &slice.linear, linear)?,
            untracked(slice, &slice.semielliptical, semielliptical)?,
        ))
    };
    let misses: Vec<(f64, f64)> = followed.iter().filter_map(tracked).collect();
    [
        Claim::printed_statement(
            "section4.angular_forcing_steadies",
            all(&widths, |(linear, semielliptical)| linear < semielliptical),
            format!(
                "the speeds of one orbit extend over {least:.1} to {most:.0} times as much in (d) as in (c), at {} orbits",
                widths.len(),
            ),
        ),
        Claim::printed_statement(
            "section4.small_angular_forcing_tracks",
            all(&misses, |(large, small)| small < large),
            format!(
                "after an impact the disk's speed differs from the platform's by {:.0e} ωΦ at most in (d), {:.4} ωΦ at least in (c), means of each orbit",
                extent(misses.iter().map(|pair| pair.1)).1,
                extent(misses.iter().map(|pair| pair.0)).0,
            ),
        ),
    ]
}

/// By how much the angular speeds of the impacts vary more at the small Γ_T than at the large one.
#[derive(Serialize)]
struct ForcingEffect {
    axial_forcing: f64,
    /// Difference of the standard deviations, as shares of ωΦ, with the phase lags of (c) and of (d).
    added_variation: [f64; 2],
}

/// From the slice drawn and that of the same vertical motion with the angular forcings of (c) and (d) exchanged.
fn forcing_effect(drawn: &Slice, exchanged: &Slice) -> Option<ForcingEffect> {
    let variation = |speeds: &[f64]| Spread::of(speeds).ok().map(|spread| spread.deviation);
    let (large, small) = (&drawn.linear, &drawn.semielliptical);
    Some(ForcingEffect {
        axial_forcing: drawn.axial_forcing,
        added_variation: [
            variation(&exchanged.linear)? - variation(large)?,
            variation(small)? - variation(&exchanged.semielliptical)?,
        ],
    })
}

/// From the period-4 bifurcation on: of the followed attractor, and beyond the crisis of the disk from rest.
fn forcing_effects(
    diagram: &Diagram,
    period_four: f64,
    crisis: f64,
) -> Result<Vec<ForcingEffect>, ExperimentError> {
    let (inputs, settings) = (diagram.inputs.exchanged(), diagram.settings);
    let followed = diagram.on_attractor().iter().zip(&diagram.followed);
    let followed: Vec<_> = followed
        .filter(|(at, _)| at.axial_forcing > period_four)
        .map(|(at, drawn)| (Some(at.state), drawn))
        .collect();
    let beyond: Vec<_> = diagram
        .chattering
        .iter()
        .filter(|slice| slice.axial_forcing > crisis)
        .map(|drawn| (None, drawn))
        .collect();
    let cases = [sampled(SAMPLED, &followed), sampled(SAMPLED, &beyond)].concat();
    let effects = map_in_parallel(&cases, |(state, drawn)| {
        let exchanged = Slice::of(drawn.axial_forcing, *state, inputs, settings)?;
        Ok(exchanged.and_then(|exchanged| forcing_effect(drawn, &exchanged)))
    })?;
    Ok(effects.into_iter().flatten().collect())
}

/// How much more the speed varies at the small Γ_T, as Γ grows beyond period 4.
fn increasingly(effects: &[ForcingEffect]) -> Claim {
    let pairs =
        [0, 1].map(|lag| trend(effects.iter().map(|of| (of.axial_forcing, of.added_variation[lag])), 1.0));
    let percent =
        |pairs: Cases| pairs.share().map_or("none".to_owned(), |share| format!("{:.1} %", 100.0 * share));
    let grows = pairs.map(|pairs| Cases::from((pairs.tried > 0).then(|| 2 * pairs.holding > pairs.tried)));
    Claim::printed_statement(
        "section4.angular_forcing_matters_more",
        grows[1],
        format!(
            "a small Γ_T spreads the speed more at the higher Γ in {} of pairs with θ of (c), {} with that of (d)",
            percent(pairs[0]),
            percent(pairs[1]),
        ),
    )
    .by_definition(&grows.map(|grows| Kind::Trend.verdict(grows)))
}
