//! How easy the orbits are to reach: along the period-1 window, beyond the merging, from rest; and where the attractor that the paper
//! does not mention comes from.

use std::f64::consts::PI;

use bouncing_disk::core::attractors::{ATTACHED, BasinSettings, FIRST_ORBIT, UNDECIDED};
use bouncing_disk::core::orbits::follow_attractor;
use bouncing_disk::core::sweep::survival_times;
use bouncing_disk::core::{ChatterPolicy, ImpactState, Launch, Phase, Unobserved};
use serde::Serialize;

use super::basins::{Other, Panel, grid, period_one, start};
use super::{WINDOW_TOP, forcing_text};
use crate::claims::paper::SectionFour;
use crate::claims::{Claim, all};
use crate::experiment::{ExperimentError, Paper};
use crate::figures::shared::numbers::extent;
use crate::figures::shared::{FORCING_RANGE, map, map_in_parallel};

/// Forcings from that of panel (a) to that of (b).
const ALONG_WINDOW: u32 = 16;
/// The tops of the windows in which shares are taken: every whole one from where speeds of period 1 (1.33)
/// are well inside.
const TOPS: [usize; 7] = [2, 3, 4, 5, 6, 7, 8];
/// Impacts after which a start along the window belongs neither to period 1 nor to chattering.
const LONGEST_ALONG: u32 = 4_000;
/// Impacts after which a start beyond the crisis counts as one that never comes to rest. The transients of
/// some hundred impacts that the crisis leaves are over by far.
const LONGEST_BEYOND: u32 = 20_000;
/// Phases between separation and its mirror image at which a disk at rest is let go, too: there the platform
/// falls away.
const REST_PHASES: u32 = 64;
/// Longest period (impacts) that is recognised, and how well two rounds agree.
const LONGEST_PERIOD: usize = 256;
/// See [`LONGEST_PERIOD`].
const REPEATS_WITHIN: f64 = 1.0e-6;
/// Deep within a basin: no other start below this |w_A Γ/(ωA)|, a fiftieth of the window. The results are far
/// from it on either side.
const DEEP: f64 = 0.1;
/// Steps of Γ in which the further attractor of panel (b) is followed, and impacts in each.
const TRACE_STEP: f64 = 2.0e-5;
/// See [`TRACE_STEP`].
const TRACE_IMPACTS: usize = 500;
/// How far it is followed at most; it is lost long before.
const TRACE_REACH: f64 = 0.03;

/// How large the basins are at one Γ of the period-1 window.
#[derive(Serialize)]
struct Easiness {
    axial_forcing: f64,
    shares: Vec<TopShares>,
}

/// Shares of the window [0, top].
#[derive(Clone, Copy, Serialize)]
struct TopShares {
    top: f64,
    period_one: f64,
    chattering: f64,
}

/// The basins of the period-1 and the chattering orbit along the period-1 window.
pub(super) fn along_window(
    fig: &mut Paper<'_>,
    section: &SectionFour,
    panels: [&Panel; 2],
) -> Result<(), ExperimentError> {
    let [first, last, ..] = section.axial_forcings_of_fig7;
    let (rows, columns) = fig.quality.choose((80, 40), (240, 90));
    let forcing = |index| first + (last - first) * f64::from(index) / f64::from(ALONG_WINDOW - 1);
    let along = map_in_parallel(&(0..ALONG_WINDOW).map(forcing).collect::<Vec<_>>(), |&axial_forcing| {
        let map = map(axial_forcing, section.restitution)?;
        let known: Vec<_> = period_one(&map)?.into_iter().collect();
        let highest = TOPS[TOPS.len() - 1];
        let settings = BasinSettings { max_impacts: LONGEST_ALONG, policy: ChatterPolicy::Complete };
        let basins = map.basins(grid(highest as f64, rows, columns)?, &known, settings, &Unobserved)?;
        let shares = TOPS.map(|top| {
            let cells = &basins.labels()[..columns * (rows * top / highest)];
            let share = |label| cells.iter().filter(|own| **own == label).count() as f64 / cells.len() as f64;
            TopShares { top: top as f64, period_one: share(FIRST_ORBIT), chattering: share(ATTACHED) }
        });
        Ok(Easiness { axial_forcing, shares: shares.to_vec() })
    })?;
    fig.claims(ease(&along, &panels));
    fig.record("along_window", &along)
}

fn ease(along: &[Easiness], panels: &[&Panel]) -> [Claim; 2] {
    let at = |top: usize| along.iter().filter_map(move |at| Some((at.axial_forcing, *at.shares.get(top)?)));
    // By the top of the window: the Γ with the largest share of the period-1 orbit.
    let largest = |top| at(top).max_by(|one, other| one.1.period_one.total_cmp(&other.1.period_one));
    let best: Vec<f64> = (0..TOPS.len()).filter_map(largest).map(|(forcing, _)| forcing).collect();
    let (first, last) = extent(along.iter().map(|at| at.axial_forcing));
    let shares = (0..TOPS.len()).flat_map(at).map(|(_, of)| (of.chattering, of.period_one));
    let shares: Vec<(f64, f64)> = shares.collect();
    let of_panels = panels.iter().map(|panel| (panel.shares.chattering, panel.shares.attractor));
    let (least, _) = extent(shares.iter().map(|(chattering, period_one)| chattering - period_one));
    [
        Claim::printed_statement(
            "section4.semielliptical_is_easiest",
            all(&best, |forcing| *forcing >= last),
            format!(
                "of {} Γ from {first} to {last} it has the largest share of period 1 in each of {} windows",
                along.len(),
                best.len()
            ),
        ),
        Claim::printed_statement(
            "section4.chattering_is_easier",
            all(shares.iter().copied().chain(of_panels), |(chattering, period_one)| chattering > period_one),
            format!(
                "at {} Γ, in {} windows, by {:.1} % of the window at least",
                along.len(),
                best.len(),
                100.0 * least
            ),
        ),
    ]
}

/// The starts at one Γ beyond the merging.
#[derive(Serialize)]
struct Beyond {
    axial_forcing: f64,
    /// Starts, on a square grid over the window, and those of them that have not come to rest after `impacts`.
    starts: usize,
    not_at_rest: usize,
    impacts: u32,
    /// Impacts in one round of what the first of them has settled on; `None` if there is none or it does not repeat.
    period: Option<usize>,
}

/// The starts that do not come to rest, from the printed Γ of the merging to the end of the diagram of
/// Fig. 6; `panel` is (e).
pub(super) fn beyond(
    fig: &mut Paper<'_>,
    section: &SectionFour,
    cells: usize,
    panel: &Panel,
) -> Result<(), ExperimentError> {
    let (first, last) = (section.merging, FORCING_RANGE.1);
    let (step, side) = fig.quality.choose((5.0e-4, 8), (2.0e-4, 16));
    let count = ((last - first) / step).round() as u32;
    let forcings: Vec<f64> = (0..=count).map(|index| first + step * f64::from(index)).collect();
    let beyond = map_in_parallel(&forcings, |&axial_forcing| {
        let map = map(axial_forcing, section.restitution)?;
        let grid = grid(WINDOW_TOP, side, side)?;
        let settings = BasinSettings { max_impacts: LONGEST_BEYOND, policy: ChatterPolicy::Complete };
        let basins = map.basins(grid, &[], settings, &Unobserved)?;
        let open = |label: &u8| *label == UNDECIDED;
        let mut period = None;
        if let Some(index) = basins.labels().iter().position(open) {
            let from = start(&grid, index / side, index % side)?;
            let longest = LONGEST_BEYOND as usize;
            if let Some(state) = map.state_after(from, longest, ChatterPolicy::Complete, &Unobserved)? {
                period = map.period_of(state, LONGEST_PERIOD, REPEATS_WITHIN)?;
            }
        }
        Ok(Beyond {
            axial_forcing,
            starts: side * side,
            not_at_rest: basins.labels().iter().filter(|label| open(label)).count(),
            impacts: LONGEST_BEYOND,
            period,
        })
    })?;
    let never = || beyond.iter().filter(|at| at.not_at_rest > 0);
    let (lowest, highest) = extent(never().map(|at| at.axial_forcing));
    let (_, share) = extent(never().map(|at| at.not_at_rest as f64 / at.starts as f64));
    fig.claim(Claim::printed_statement(
        "section4.basin_fills_plane",
        (panel.shares.chattering - 1.0).abs() < f64::EPSILON,
        format!(
            "in (e) {:.0} of {} cells come to rest. At {} of {} Γ beyond the merging, {lowest:.4} to {highest:.4}, up to {:.1} % of {} starts never do",
            panel.shares.chattering * (cells * cells) as f64,
            cells * cells,
            never().count(),
            beyond.len(),
            100.0 * share,
            side * side,
        ),
    ));
    fig.record("beyond", &beyond)
}

/// Disks at rest on the platform, let go at phases where it falls away.
#[derive(Serialize)]
struct Rest {
    axial_forcing: f64,
    starts: usize,
    come_to_rest: usize,
}

/// The fate of a disk at rest on the platform, at any phase; `panels` are (a) and (b).
pub(super) fn from_rest(
    fig: &mut Paper<'_>,
    section: &SectionFour,
    panels: [&Panel; 2],
) -> Result<(), ExperimentError> {
    let rest = map_in_parallel(&section.axial_forcings_of_fig7, |&axial_forcing| {
        let map = map(axial_forcing, section.restitution)?;
        let mut orbits = Vec::new();
        if let Some(leaves) = map.vibration().separation_phase() {
            // At all other phases it stays until the first of these.
            let falling = PI - 2.0 * leaves.angle();
            for index in 0..REST_PHASES {
                let angle = leaves.angle() + falling * f64::from(index) / f64::from(REST_PHASES);
                let phase = if index == 0 { leaves } else { Phase::new(angle)? };
                orbits.push(map.orbit_from_launch(Launch::new(phase, 0.0)?, ChatterPolicy::Complete));
            }
        }
        let longest = LONGEST_BEYOND as usize;
        let lives = survival_times(&orbits, longest, &Unobserved)?;
        let come_to_rest = lives.into_iter().filter(|lived| *lived < longest).count();
        Ok(Rest { axial_forcing, starts: orbits.len(), come_to_rest })
    })?;
    let depths = panels.map(|panel| panel.lowest_not_chattering);
    let words = depths.map(|low| low.map_or("any".to_owned(), |low| format!("{low:.3}")));
    let [come, starts] =
        [|at: &Rest| at.come_to_rest, |at: &Rest| at.starts].map(|of| rest.iter().map(of).sum::<usize>());
    fig.claim(Claim::printed_statement(
        "section4.rest_chatters",
        all(depths, |low| low.is_none_or(|low| low > DEEP)),
        format!(
            "every start slower than |w_A Γ/(ωA)| = {} chatters in (a), {} in (b); deep is more than {DEEP}. Of disks at rest at the five Γ, {come} of {starts} come to rest again",
            words[0], words[1],
        ),
    ));
    fig.record("rest", &rest)
}

/// An attractor followed in Γ.
#[derive(Serialize)]
struct Traced {
    step: f64,
    /// Lowest Γ to which it can be followed, and impacts in one round there.
    appears: f64,
    period_where_it_appears: Option<usize>,
    /// Highest Γ with half of the impacts that it has in the panel; it doubles its period within a step above.
    doubles: Option<f64>,
    /// Highest Γ to which it can be followed.
    lost: f64,
}

/// Where the further attractor of panel (b) comes from and where it is lost.
fn traced(axial_forcing: f64, other: &Other, restitution: f64) -> Result<Option<Traced>, ExperimentError> {
    let Some(&(cycles, speed)) = other.impacts.first() else { return Ok(None) };
    let first = ImpactState::from_normalised(2.0 * PI * cycles, speed)?;
    let steps = (TRACE_REACH / TRACE_STEP) as u32;
    // Γ and period as far as it can be followed: to a rest, or to the period-1 orbit.
    let trace = |direction: f64| -> Result<Vec<(f64, Option<usize>)>, ExperimentError> {
        let forcings = (0..=steps).map(|step| axial_forcing + direction * TRACE_STEP * f64::from(step));
        let mut passed = Vec::new();
        for at in follow_attractor(restitution, forcings, first, TRACE_IMPACTS, ChatterPolicy::Complete) {
            let at = at?;
            let period = at.map.period_of(at.state, LONGEST_PERIOD, REPEATS_WITHIN)?;
            if period == Some(1) {
                break;
            }
            passed.push((at.axial_forcing, period));
        }
        Ok(passed)
    };
    let (down, up) = rayon::join(|| trace(-1.0), || trace(1.0));
    let (down, up) = (down?, up?);
    let undoubled = |(_, period): &&(f64, Option<usize>)| *period == Some(other.impacts.len() / 2);
    Ok(down.last().zip(up.last()).map(|(lowest, highest)| Traced {
        step: TRACE_STEP,
        appears: lowest.0,
        period_where_it_appears: lowest.1,
        doubles: down.iter().find(undoubled).map(|at| at.0),
        lost: highest.0,
    }))
}

/// The further attractor of panel (b).
pub(super) fn third_attractor(
    fig: &mut Paper<'_>,
    restitution: f64,
    panel: &Panel,
) -> Result<(), ExperimentError> {
    let other = panel.others.first();
    let traced = other.map(|other| traced(panel.axial_forcing, other, restitution)).transpose()?.flatten();
    let words = other.map_or_else(String::new, |other| {
        format!(
            "{} impacts in {} periods, largest multiplier {:.3}; it holds {:.2} % of the window",
            other.impacts.len(),
            other.platform_periods,
            other.spectral_radius,
            100.0 * panel.shares.other,
        )
    });
    let followed = traced.as_ref().map_or_else(String::new, |of| {
        format!(
            "; followed from Γ = {:.5} ({} impacts) over a doubling at {:.5} to {:.5}",
            of.appears,
            of.period_where_it_appears.unwrap_or_default(),
            of.doubles.unwrap_or(f64::NAN),
            of.lost
        )
    });
    fig.claim(Claim::statement(
        "fig07",
        "Fig. 7(b)",
        &format!(
            "at Γ = {} there is an attractor that is neither the chattering orbit nor that of period 1",
            forcing_text(panel.axial_forcing)
        ),
        other.is_some(),
        words + &followed,
    ));
    fig.record("traced", &traced)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_orbit_is_easiest_without_data() {
        assert!(ease(&[], &[]).iter().all(Claim::lacks_data));
    }
}
