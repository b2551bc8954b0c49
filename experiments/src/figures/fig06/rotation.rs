//! The statements of the paper about the rotation in Fig. 6: Eq. (16), the two motions, mean speeds.

use std::f64::consts::TAU;

use bouncing_disk::core::numerics::elementary::cos;

use super::data::{Fig06Data, Slice};
use crate::claims::judging::trend;
use crate::claims::{self as claim, Cases, Claim, Kind};
use crate::figures::shared::numbers;
pub(super) use crate::figures::shared::numbers::extent;

/// Rounding of stored phases and speeds (1e-6) seen through the slopes of Eq. (16), and the slow convergence
/// to the orbit next to a doubling.
const STORED: f64 = 1.0e-5;

pub(super) fn claims(data: &Fig06Data) -> Vec<Claim> {
    let mut claims = map_parameters(data);
    claims.extend(period_one_turns(data));
    claims.extend(rotation(data));
    claims.extend(period_two(data));
    claims.extend(mean_speeds(data));
    claims
}

/// The phase, the angular speeds of (c) and (d) at the period-1 orbits, by rising Γ.
pub(super) fn period_ones(data: &Fig06Data) -> Vec<(&Slice, f64)> {
    let ones = data.followed.iter().filter(|slice| slice.period == Some(1));
    ones.filter_map(|slice| Some((slice, TAU * slice.impact_phase_cycles.first()?))).collect()
}

/// How far numbers that are no angles extend.
pub(super) fn width(values: &[f64]) -> f64 {
    let (low, high) = extent(values.iter().copied());
    high - low
}

/// The map and its parameters.
fn map_parameters(data: &Fig06Data) -> Vec<Claim> {
    let dimension = &data.dimension;
    let ratios: Vec<String> = data
        .torque_ratios
        .iter()
        .map(|of| format!("{}: Γ_T = {:.4e}, ratio {:.4e}", of.system, of.angular_forcing, of.ratio))
        .collect();
    let (weakest, strongest) = extent(data.transfers.iter().map(|of| of.share_in_impacts));
    // The attractor transfers all of it in impacts, by its choice: the orbits from rest decide.
    let from_rest: Vec<f64> =
        data.transfers.iter().filter(|of| of.from_rest).map(|of| of.share_in_impacts).collect();
    let mean_from_rest =
        (!from_rest.is_empty()).then(|| from_rest.iter().sum::<f64>() / from_rest.len() as f64);
    vec![
        Claim::printed("section4.map_parameters", dimension.rank as f64).note(format!(
            "rank of the derivatives of {} numbers of the next collisions by the {} inputs of a system in SI units",
            dimension.outcomes,
            dimension.parameters.len(),
        )),
        Claim::printed_statement(
            "section4.meaning_of_angular_forcing",
            claim::all(&data.torque_ratios, |of| of.ratio.total_cmp(&of.angular_forcing).is_eq()),
            format!(
                "the torque for the platform's largest angular acceleration over the frictional torque of the preload is π times Γ_T: {}",
                ratios.join("; ")
            ),
        ),
        Claim::printed_statement(
            "section4.transfer_in_impacts",
            mean_from_rest.map_or_else(Cases::default, Cases::of_share),
            format!(
                "of the sizes of all angular impulses, impacts transfer {:.3} on the mean over the orbits of the disk from rest, {weakest:.3} to {strongest:.3} by orbit; \
                 in the motor of Table III {:.3}",
                mean_from_rest.unwrap_or(f64::NAN),
                data.motor_share_in_impacts.unwrap_or(f64::NAN),
            ),
        ),
    ]
}

/// Eq. (16) and what it rests on.
fn period_one_turns(data: &Fig06Data) -> Vec<Claim> {
    let of = &data.period_one;
    let lags = || of.lags.iter();
    let (least, most) = extent(lags().map(|scan| scan.speed_of_elliptical));
    let ones = period_ones(data);
    let (low, high) = extent(ones.iter().map(|(_, phase)| *phase));
    let lag = data.semielliptical.phase_lag_rad;
    let miss = |(slice, phase): &(&Slice, f64)| {
        let linear = slice.linear_mean - cos(phase + data.linear.phase_lag_rad);
        linear.abs().max((slice.semielliptical_mean - cos(phase + lag)).abs())
    };
    let (_, worst) = extent(ones.iter().map(miss));
    vec![
        Claim::printed_statement(
            "section4.slip_vanishes",
            claim::all(Some(of.largest_tangential_speed).filter(|_| of.orbits > 0), |slip| slip < SETTLED),
            format!(
                "|w_T| in the last of {} impacts is at most {:.0e} ωΦ",
                of.impacts_each, of.largest_tangential_speed
            ),
        ),
        Claim::printed_statement(
            "section4.period_one_speed",
            claim::all(&ones, |one| miss(one) < STORED),
            format!(
                "largest deviation {worst:.1e} ωΦ at {} values of Γ, (c) and (d), whose phases are rounded to 1e-6 of a period",
                ones.len()
            ),
        ),
        Claim::printed_statement(
            "section4.maximum_speed",
            claim::all(lags(), |scan| {
                (scan.best_lag_rad + scan.impact_phase_rad).abs() <= 0.5 * scan.lag_step_rad
                    && (scan.speed_at_impact_phase - 1.0).abs() < SETTLED
            }),
            "of all lags tried the fastest is next to it",
        ),
        Claim::printed_statement(
            "section4.elliptical_not_optimal",
            claim::all(lags(), |scan| scan.speed_of_elliptical < scan.speed_at_impact_phase - SETTLED),
            format!("the disk turns with {least:.3} to {most:.3} ωΦ at θ = −π/2, and with ωΦ at θ = −τ_imp"),
        ),
        Claim::printed_statement(
            "section4.impact_phase_not_quarter",
            claim::all(&ones, |(_, phase)| numbers::distance(phase / TAU, 0.25) > STORED),
            format!("in period 1 τ_imp/2π runs from {:.4} to {:.4}", low / TAU, high / TAU),
        ),
    ]
}

/// A speed, as a share of ωΦ, that differs from another one by the rounding of some hundred impacts only.
const SETTLED: f64 = 1.0e-9;

/// How the rotation follows the vertical motion.
fn rotation(data: &Fig06Data) -> Vec<Claim> {
    let ones = period_ones(data);
    let steps = |key: &str, of: fn(&Slice) -> f64, sign: f64| {
        let pairs = trend(ones.iter().map(|(slice, _)| (slice.axial_forcing, of(slice))), sign);
        Claim::printed_statement(key, pairs, format!("in {} of all pairs of Γ", pairs.words()))
    };
    // The effect of half a unit of the last digit of the printed lag on the speed.
    let printed = crate::claims::catalogue::number("section4.semielliptical_phase_lag", 0);
    let least = printed.map_or(f64::NAN, |lag| cos(lag.half_unit));
    let reached = ones.last().map(|(slice, _)| slice.semielliptical_mean);
    vec![
        steps("section4.linear_falls", |slice| slice.linear_mean, -1.0),
        steps("section4.semielliptical_rises", |slice| slice.semielliptical_mean, 1.0),
        Claim::printed_statement(
            "section4.semielliptical_reaches_maximum",
            claim::all(reached, |speed| speed >= least),
            format!(
                "{:.7} ωΦ at the last period-1 orbit of (d), Γ = {:.4}; half a unit of the last digit of 0.26π lets it fall to {least:.7}",
                reached.unwrap_or(f64::NAN),
                ones.last().map_or(f64::NAN, |(slice, _)| slice.axial_forcing),
            ),
        ),
        slow_at_birth(data),
        oscillation(data),
        increasingly(data),
        tracking(data),
    ]
}

/// θ = −0.26π at the birth of the period-1 orbit, where τ_imp = 0 and Eq. (16) gives ωΦ cos θ.
fn slow_at_birth(data: &Fig06Data) -> Claim {
    let ones = period_ones(data);
    let at_birth = cos(data.semielliptical.phase_lag_rad);
    let fastest = extent(ones.iter().map(|(slice, _)| slice.semielliptical_mean)).1;
    Claim::printed_statement(
        "section4.semielliptical_slow_at_birth",
        claim::all(ones.first(), |(first, _)| {
            at_birth < cos(data.linear.phase_lag_rad)
                && first.semielliptical_mean < fastest.min(first.linear_mean)
        }),
        format!("{at_birth:.3} ωΦ at Γ = 1/3 by Eq. (16), against ωΦ with θ = 0"),
    )
}

/// How much more the speed varies at the small Γ_T, as Γ grows beyond period 4.
fn increasingly(data: &Fig06Data) -> Claim {
    let effects = &data.forcing_effects;
    let pairs =
        [0, 1].map(|lag| trend(effects.iter().map(|of| (of.axial_forcing, of.added_variation[lag])), 1.0));
    let grows = pairs.map(|pairs| Cases::from((pairs.tried > 0).then(|| 2 * pairs.holding > pairs.tried)));
    Claim::printed_statement(
        "section4.angular_forcing_matters_more",
        grows[1],
        format!(
            "by how much the standard deviation of the angular speed is larger at Γ_T = {} than at {}, at {} values of Γ from period 4 on: it grows with Γ in {} of all pairs with θ of (c), and in {} with that of (d)",
            data.semielliptical.angular_forcing,
            data.linear.angular_forcing,
            effects.len(),
            pairs[0].words(),
            pairs[1].words(),
        ),
    )
    .by_definition(&grows.map(|grows| Kind::Trend.verdict(grows)))
}

/// The range of angular speeds beyond period 4.
fn oscillation(data: &Fig06Data) -> Claim {
    let start = data.doublings.get(1).copied().unwrap_or(f64::NAN);
    let beyond: Vec<(f64, f64)> = data
        .followed
        .iter()
        .chain(&data.chattering)
        .filter(|slice| slice.axial_forcing > start)
        .map(|slice| (width(&slice.linear), width(&slice.semielliptical)))
        .collect();
    let (_, widest_linear) = extent(beyond.iter().map(|pair| pair.0));
    let (narrowest, widest) = extent(beyond.iter().map(|pair| pair.1));
    Claim::printed_statement(
        "section4.angular_forcing_steadies",
        claim::all(&beyond, |(linear, semielliptical)| linear < semielliptical),
        format!(
            "the angular speeds of one orbit extend over at most {widest_linear:.3} ωΦ in (c) and over {narrowest:.3} to {widest:.3} ωΦ in (d)"
        ),
    )
}

/// How far the speed after an impact is from that of the platform in the impact, on the mean over consecutive
/// impacts.
fn untracked(slice: &Slice, speeds: &[f64], lag: f64) -> Option<f64> {
    let misses: Vec<f64> = speeds
        .iter()
        .skip(1)
        .zip(&slice.impact_phase_cycles)
        .map(|(after, phase)| (after - cos(TAU * phase + lag)).abs())
        .collect();
    (!misses.is_empty()).then(|| misses.iter().sum::<f64>() / misses.len() as f64)
}

/// At small Γ_T the disk takes the platform's speed in every impact.
fn tracking(data: &Fig06Data) -> Claim {
    let start = data.doublings.get(1).copied().unwrap_or(f64::NAN);
    let pairs: Vec<(f64, f64)> = data
        .followed
        .iter()
        .filter(|slice| slice.axial_forcing > start)
        .filter_map(|slice| {
            let large = untracked(slice, &slice.linear, data.linear.phase_lag_rad)?;
            Some((large, untracked(slice, &slice.semielliptical, data.semielliptical.phase_lag_rad)?))
        })
        .collect();
    let (least, _) = extent(pairs.iter().map(|pair| pair.0));
    let (_, most) = extent(pairs.iter().map(|pair| pair.1));
    Claim::printed_statement(
        "section4.small_angular_forcing_tracks",
        claim::all(&pairs, |(large, small)| small < large),
        format!(
            "after an impact the disk is off the speed that the platform had in it by at most {most:.0e} ωΦ on the mean in (d), by at least {least:.4} ωΦ in (c)"
        ),
    )
}

/// The two impacts of a period-2 orbit: index of the one of large and of small |w_A|.
fn large_and_small(slice: &Slice) -> Option<[usize; 2]> {
    let [one, other] = slice.normalised_impact_speed[..] else { return None };
    Some(if one > other { [0, 1] } else { [1, 0] })
}

/// The two impacts of period 2 against the platform, in (c) and (d): |w_T| in the larger of them, and the
/// distances of the mean speed from the platform's speed in the impact of large and in that of small |w_A|.
fn two_impacts(data: &Fig06Data, twos: &[(&Slice, [usize; 2])]) -> (Vec<f64>, Vec<(f64, f64)>) {
    let of_motion = |speeds: &[f64], mean: f64, phases: &[f64], lag: f64, order: [usize; 2]| {
        let platform = |impact: usize| cos(TAU * phases[impact] + lag);
        // The larger of the two: Eq. (16) would have to hold in both.
        let miss = (0..2).map(|impact| (speeds[impact] - platform(impact)).abs()).fold(0.0, f64::max);
        let [large, small] = order.map(|impact| (mean - platform(impact)).abs());
        (miss, (large, small))
    };
    let all = twos.iter().flat_map(|(slice, order)| {
        let Slice { linear, linear_mean, semielliptical, semielliptical_mean, .. } = slice;
        let phases = &slice.impact_phase_cycles;
        [
            of_motion(linear, *linear_mean, phases, data.linear.phase_lag_rad, *order),
            of_motion(
                semielliptical,
                *semielliptical_mean,
                phases,
                data.semielliptical.phase_lag_rad,
                *order,
            ),
        ]
    });
    all.unzip()
}

/// The statements about the region of period 2.
fn period_two(data: &Fig06Data) -> Vec<Claim> {
    let twos: Vec<(&Slice, [usize; 2])> = between(data, 0, 1)
        .into_iter()
        .filter(|slice| slice.period == Some(2))
        .filter_map(|slice| Some((slice, large_and_small(slice)?)))
        .collect();
    let phases = |branch: usize| -> Vec<f64> {
        twos.iter().map(|(slice, order)| slice.impact_phase_cycles[order[branch]]).collect()
    };
    let (large, small) = (phases(0), phases(1));
    // Both branches stay within a quarter of a period, far from the seam at 0.
    let monotone =
        |phases: &[f64], sign: f64| claim::all(phases.windows(2), |pair| sign * (pair[1] - pair[0]) > 0.0);
    let (misses, distances) = two_impacts(data, &twos);
    let (least, most) = extent(misses.iter().copied());
    vec![
        Claim::printed_statement(
            "section4.period_two_branches",
            claim::all([monotone(&large, -1.0), monotone(&small, 1.0)].into_iter().flatten(), |holds| holds),
            format!("from each of {} values of Γ to the next", twos.len()),
        ),
        Claim::printed_statement(
            "section4.eq16_fails_in_period_two",
            claim::all(&misses, |miss| *miss > STORED),
            format!("the larger |w_T| of the two impacts is {least:.1e} to {most:.3} ωΦ in (c) and (d)"),
        ),
        Claim::printed_statement(
            "section4.large_branch_dominates",
            claim::all(&distances, |(large, small)| large < small),
            format!(
                "the mean speed against the platform's in the two impacts, at {} values of Γ",
                twos.len()
            ),
        ),
    ]
}

/// The slices between two doublings.
fn between(data: &Fig06Data, low: usize, high: usize) -> Vec<&Slice> {
    let at = |index: usize| data.doublings.get(index).copied().unwrap_or(f64::NAN);
    data.followed
        .iter()
        .filter(|slice| slice.axial_forcing > at(low) && slice.axial_forcing < at(high))
        .collect()
}

fn mean_speeds(data: &Fig06Data) -> Vec<Claim> {
    let period_two = between(data, 0, 1);
    let period_four = between(data, 1, 2);
    let trend = |of: fn(&Slice) -> f64, sign: f64| {
        let points = |slices: &[&Slice]| {
            slices.iter().map(|slice| (slice.axial_forcing, of(slice))).collect::<Vec<_>>()
        };
        let goes = trend(points(&period_two), sign);
        // An extremum at the doubling: it has turned in the nearer half of the period-4 region.
        let turned = trend(points(&period_four[..period_four.len().div_ceil(2)]), -sign);
        let value = |slice: Option<&&Slice>| slice.map_or(f64::NAN, |slice| of(slice));
        let slope = |slices: &[&Slice]| match slices {
            [first, .., last] => (of(last) - of(first)) / (last.axial_forcing - first.axial_forcing),
            _ => f64::NAN,
        };
        let nearest = &period_two[period_two.len().saturating_sub(period_four.len())..];
        let evidence = format!(
            "mean speed/(ωΦ) {:.4} just above Γ_1, {:.4} just below Γ_2, {:.4} just below Γ_3; slopes {:+.1} before Γ_2 and {:+.1} after it, \
             over as wide a range of Γ as period 4 has",
            value(period_two.first()),
            value(period_two.last()),
            value(period_four.last()),
            slope(nearest),
            slope(&period_four),
        );
        (goes, turned, evidence)
    };
    let (rises, rise_ends, rise) = trend(|slice| slice.linear_mean, 1.0);
    let (falls, fall_ends, fall) = trend(|slice| slice.semielliptical_mean, -1.0);
    let mut claims = vec![
        Claim::printed_statement("section4.linear_rises_in_period_two", rises, rise.as_str()),
        Claim::printed_statement("section4.linear_turns_at_period_four", rise_ends, rise),
        Claim::printed_statement("section4.semielliptical_falls_in_period_two", falls, fall.as_str()),
        Claim::printed_statement("section4.semielliptical_turns_at_period_four", fall_ends, fall)
            .note("where it does not turn it has a kink there: a falling mean falls on, more slowly")
            .cause("a kink called an extremum"),
    ];
    claims.extend(three_branches(data, &period_four));
    claims
}

/// Angular speeds closer than this share of ωΦ look like one branch: dots of panel (d) are 0.6 points wide,
/// and ωΦ is 60 points long there.
const ONE_BRANCH: f64 = 0.01;

/// The two impacts of an orbit with the nearest speeds in (d): their distance there, and in the plane of
/// phase (periods) and
/// |w_A Γ/(ωA)|.
fn nearest_speeds(slice: &Slice) -> Option<(f64, f64)> {
    let speeds = &slice.semielliptical;
    let pairs = (0..speeds.len()).flat_map(|one| (one + 1..speeds.len()).map(move |other| (one, other)));
    let (one, other) = pairs
        .min_by(|a, b| (speeds[a.0] - speeds[a.1]).abs().total_cmp(&(speeds[b.0] - speeds[b.1]).abs()))?;
    let phases = &slice.impact_phase_cycles;
    let axial = &slice.normalised_impact_speed;
    let apart = numbers::distance(phases[one], phases[other]).max((axial[one] - axial[other]).abs());
    Some(((speeds[one] - speeds[other]).abs(), apart))
}

/// Two of the four branches of (d) cross or touch.
fn three_branches(data: &Fig06Data, period_four: &[&Slice]) -> [Claim; 2] {
    let four: Vec<(f64, f64)> = period_four
        .iter()
        .filter(|slice| slice.period == Some(4))
        .filter_map(|slice| nearest_speeds(slice))
        .collect();
    let alike: Vec<&(f64, f64)> = four.iter().filter(|(gap, _)| *gap < ONE_BRANCH).collect();
    let (nearest, _) = extent(alike.iter().map(|(_, apart)| *apart));
    let crossings: Vec<String> =
        data.branch_crossings.iter().map(|forcing| format!("{forcing:.4}")).collect();
    [
        Claim::printed_statement(
            "section4.three_branches",
            // It appears so over most of the region, not at a point.
            claim::all(Some(alike.len()).filter(|_| !four.is_empty()), |alike| 2 * alike > four.len()),
            format!(
                "two of the four speeds lie within {ONE_BRANCH} ωΦ of each other, which is the width of a dot, at {} of {} values of Γ; two branches \
                 cross at Γ = {}",
                alike.len(),
                four.len(),
                if crossings.is_empty() { "none".to_owned() } else { crossings.join(", ") },
            ),
        ),
        Claim::printed_statement(
            "section4.projection_hides_branch",
            claim::all(&alike, |(gap, apart)| *apart > ONE_BRANCH && apart > gap),
            format!(
                "where two of the four speeds look alike, their impacts are at least {nearest:.3} apart in τ_imp/2π or |w_A Γ/(ωA)|; next to the doubling, between these values of Γ, \
                 both branches of a new pair begin in one impact, and are one without any projection"
            ),
        ),
    ]
}
