//! The chattering orbit: how it comes to rest, beside the followed attractor, and where its single tosses end.

use std::f64::consts::{PI, TAU};

use bouncing_disk::core::numerics::roots::bracket_of_width;
use bouncing_disk::core::sweep::orbit_diagram;
use bouncing_disk::core::{ChatterPolicy, ImpactMap, Launch, Orbit, OrbitEvent, Unobserved};
use bouncing_disk::motion::PAPER_CHATTER;
use bouncing_disk::toss::{ChatteringCycle, LONG_FLIGHT};
use serde::Serialize;

use super::SAMPLED;
use super::diagram::{Diagram, LONGEST_CYCLE, Slice, cycles, sampled};
use super::doublings::{in_closed_form, multiplier};
use crate::claims::judging::trend;
use crate::claims::{Cases, Claim, Kind, all, any, paper};
use crate::experiment::{ExperimentError, Paper};
use crate::figures::shared::numbers::{distance, extent};
use crate::figures::shared::{map, map_in_parallel};

/// Impacts after which the motion of a disk that has not come to rest is recorded.
const SETTLING: usize = 20_000;
/// Longest period (impacts) of an orbit that it may have settled on, and how well two rounds of it agree.
const LONGEST_PERIOD: usize = 256;
/// See [`LONGEST_PERIOD`].
const REPEATS_WITHIN: f64 = 1.0e-6;
/// Impacts over which it is then looked at.
const SETTLED: usize = 1_000;
/// How well two rounds agree, and an orbit is off another one, that cannot be told apart in the picture: the width of a dot, in
/// periods.
const DRAWN_WITHIN: f64 = 3.0e-3;
/// A restitution and a Γ below 1/π at which a disk goes on bouncing that has been thrown up.
const BELOW_SEPARATION: (f64, f64) = (0.55, 0.304);
/// Two times of rest (periods) that differ by less than this are one: the paper's cut leaves out what a disk
/// of the cut's speed does.
const SAME_REST: f64 = 1.0e-4;
/// Γ between the end of the single tosses and the printed one at which cycles are taken.
const BEYOND: u32 = 200;

/// The orbit of a disk that leaves the platform from rest; `None` if it does not leave.
fn from_rest(map: &ImpactMap, policy: ChatterPolicy) -> Result<Option<Orbit>, ExperimentError> {
    let Some(leaves) = map.vibration().separation_phase() else { return Ok(None) };
    Ok(Some(map.orbit_from_launch(Launch::new(leaves, 0.0)?, policy)))
}

/// A disk from rest that bounces for ever.
#[derive(Serialize)]
pub(super) struct Bouncing {
    axial_forcing: f64,
    /// Impacts in one round of the periodic orbit that it has settled on; `None` if it is on none.
    period: Option<usize>,
    /// The same if two rounds need to agree only as well as the picture shows.
    drawn_period: Option<usize>,
    /// Pairs of successive impacts, in runs of flights of less than half a period, whose later impact is slower, and pairs whose
    /// later flight is shorter.
    slower: Cases,
    shorter: Cases,
    /// Whether it is on another attractor than the followed one.
    separate: bool,
}

impl Bouncing {
    /// The key feature of chattering in the paper's words, which does not need a rest: rapid collisions with decaying impact
    /// velocity and flight duration.
    fn chatters(&self) -> bool {
        self.separate && mostly(self.slower) && mostly(self.shorter)
    }
}

fn mostly(pairs: Cases) -> bool {
    2 * pairs.holding > pairs.tried
}

/// The pairs of flights in which the impact speed, or the duration, falls.
fn falls(flights: &[(f64, f64)], of: fn(&(f64, f64)) -> f64) -> Cases {
    trend(flights.iter().enumerate().map(|(impact, flight)| (impact as f64, of(flight))), -1.0)
}

/// The motion at a Γ above 1/π where a disk from rest does not come to rest again.
fn bounce(diagram: &Diagram, axial_forcing: f64) -> Result<Option<Bouncing>, ExperimentError> {
    let map = map(axial_forcing, diagram.inputs.restitution)?;
    let Some(orbit) = from_rest(&map, PAPER_CHATTER)? else { return Ok(None) };
    let settled = orbit_diagram(&[orbit], SETTLING, 1, &Unobserved)?.concat();
    let Some(&state) = settled.first() else { return Ok(None) };
    let (mut flights, mut orbit) = (Vec::new(), map.orbit(state, PAPER_CHATTER));
    while flights.len() < SETTLED
        && let Some(OrbitEvent::Impact(impact)) = orbit.advance()?
    {
        flights.push((impact.duration(), -impact.velocity));
    }
    let runs = || flights.split(|(duration, _)| *duration > LONG_FLIGHT);
    let followed =
        diagram.followed.iter().find(|slice| slice.axial_forcing.to_bits() == axial_forcing.to_bits());
    let phase = state.phase().cycles();
    let near = |own: &f64| distance(*own, phase) <= DRAWN_WITHIN;
    let separate = followed.is_none_or(|slice| !slice.impact_phase_cycles.iter().any(near));
    Ok(Some(Bouncing {
        axial_forcing,
        period: map.period_of(state, LONGEST_PERIOD, REPEATS_WITHIN)?,
        drawn_period: map.period_of(state, LONGEST_PERIOD, DRAWN_WITHIN)?,
        slower: runs().map(|run| falls(run, |flight| flight.1)).sum(),
        shorter: runs().map(|run| falls(run, |flight| flight.0)).sum(),
        separate,
    }))
}

/// The Γ above 1/π where a disk from rest does not come to rest again.
pub(super) fn bouncing(diagram: &Diagram) -> Result<Vec<Bouncing>, ExperimentError> {
    let restless = diagram.cycles.iter().filter(|(forcing, cycle)| *forcing * PI > 1.0 && cycle.is_none());
    let forcings: Vec<f64> = restless.map(|(forcing, _)| *forcing).collect();
    Ok(map_in_parallel(&forcings, |forcing| bounce(diagram, *forcing))?.into_iter().flatten().collect())
}

/// The durations (radians) and impact speeds of flights, and the time of the rest that ends them (radians).
type ToRest = (Vec<(f64, f64)>, f64);

/// From a rest to the next one; `None` if there is none.
fn to_rest(map: &ImpactMap, policy: ChatterPolicy) -> Result<Option<ToRest>, ExperimentError> {
    let Some(mut orbit) = from_rest(map, policy)? else { return Ok(None) };
    let (mut flights, mut time) = (Vec::new(), 0.0);
    while flights.len() < LONGEST_CYCLE {
        match orbit.advance()? {
            Some(OrbitEvent::Impact(impact)) => {
                time += impact.duration();
                flights.push((impact.duration(), -impact.velocity));
            }
            Some(OrbitEvent::Attachment(rest)) => {
                return Ok(Some((flights, time + rest.accumulation.duration)));
            }
            _ => return Ok(None),
        }
    }
    Ok(None)
}

/// The last impacts of a disk from rest before it comes to rest again: those that end flights of less than
/// half a period.
#[derive(Serialize)]
struct Chatter {
    axial_forcing: f64,
    /// Impacts up to the paper's cut.
    impacts: usize,
    /// Pairs of successive impacts whose later impact is slower, and pairs whose later flight is shorter.
    slower: Cases,
    shorter: Cases,
    /// The time of rest (periods), from the separation on, with infinitely many impacts summed, and with the
    /// paper's cut.
    rests_at_cycles: f64,
    cut_at_cycles: f64,
}

/// How a disk from rest comes to rest again.
fn chatter(axial_forcing: f64, restitution: f64) -> Result<Option<Chatter>, ExperimentError> {
    let map = map(axial_forcing, restitution)?;
    let cut = to_rest(&map, PAPER_CHATTER)?;
    let Some(((flights, cut), (_, rests))) = cut.zip(to_rest(&map, ChatterPolicy::Complete)?) else {
        return Ok(None);
    };
    let long = flights.iter().rposition(|(duration, _)| *duration > LONG_FLIGHT);
    let chatter = &flights[long.map_or(0, |long| long + 1)..];
    Ok(Some(Chatter {
        axial_forcing,
        impacts: chatter.len(),
        slower: falls(chatter, |flight| flight.1),
        shorter: falls(chatter, |flight| flight.0),
        rests_at_cycles: rests / TAU,
        cut_at_cycles: cut / TAU,
    }))
}

/// The end of the single-toss pattern of the chattering orbit.
#[derive(Serialize)]
pub(super) struct SingleTosses {
    /// Largest Γ of the bisection with one cycle per period of the platform, smallest without.
    last: f64,
    first_other: f64,
    /// Share of the Γ from there to 0.52 at which the disk comes to rest once in every period.
    share_beyond: f64,
    /// Fewest periods of the platform in a cycle from there to 0.52, over the Γ that chatter.
    periods_beyond: Option<u64>,
}

/// Where the chattering orbit stops being a chain of single tosses, looked for in the diagram and bisected.
pub(super) fn single_tosses(diagram: &Diagram) -> Result<Option<SingleTosses>, ExperimentError> {
    let restitution = diagram.inputs.restitution;
    let printed_end = paper::section_four()?.single_tosses_end;
    let is_single = |cycle: &Option<ChatteringCycle>| cycle.is_some_and(|cycle| cycle.is_single_toss());
    let (mut last, mut first_other) = (None, printed_end);
    for (forcing, cycle) in &diagram.cycles {
        if *forcing * PI > 1.0 && *forcing < printed_end {
            if !is_single(cycle) {
                first_other = *forcing;
                break;
            }
            last = Some(*forcing);
        }
    }
    let Some(last) = last else { return Ok(None) };
    let (last, first_other) = bracket_of_width(last, first_other, 1.0e-9, |forcing| {
        Ok::<_, ExperimentError>(cycles(&[forcing], restitution)?.iter().all(is_single))
    })?;
    let place = |i: u32| first_other + (printed_end - first_other) * (f64::from(i) + 0.5) / f64::from(BEYOND);
    let beyond = cycles(&(0..BEYOND).map(place).collect::<Vec<_>>(), restitution)?;
    let singles = beyond.iter().filter(|cycle| is_single(cycle)).count();
    Ok(Some(SingleTosses {
        last,
        first_other,
        share_beyond: singles as f64 / beyond.len() as f64,
        periods_beyond: beyond.iter().flatten().map(|cycle| cycle.platform_periods).min(),
    }))
}

/// The statements about the chattering orbit; `crisis` ends the followed attractor.
pub(super) fn chattering(
    fig: &mut Paper<'_>,
    diagram: &Diagram,
    single: Option<&SingleTosses>,
    bouncing: &[Bouncing],
    crisis: f64,
) -> Result<(), ExperimentError> {
    let section = paper::section_four()?;
    let periodic: Vec<&Slice> = diagram.followed.iter().filter(|slice| slice.period.is_some()).collect();
    let restless = |slice: &Slice| {
        bouncing.iter().find(|at| at.axial_forcing.to_bits() == slice.axial_forcing.to_bits())
    };
    let never: Vec<&Bouncing> = periodic.iter().filter_map(|slice| restless(slice)).collect();
    fig.claim(
        Claim::printed_statement(
            "section4.coexistence",
            all(&periodic, |slice| diagram.rests_beside(slice) || restless(slice).is_some_and(Bouncing::chatters)),
            format!(
                "at {} Γ with a periodic orbit; at {} of them a disk from rest never rests, and in {} its later rapid collision is slower. Next to chaos it does not chatter at {} Γ",
                periodic.len(),
                never.len(),
                never.iter().map(|at| at.slower).sum::<Cases>().words(),
                bouncing.iter().filter(|at| !at.chatters()).count(),
            ),
        )
        .cause("a disk from rest that never rests again"),
    );
    let chattering = bouncing.iter().filter(|at| at.chatters());
    let repeats =
        diagram.chattering.iter().map(|_| true).chain(chattering.map(|at| at.drawn_period.is_some()));
    let repeats = Cases::of(repeats);
    fig.claim(
        Claim::printed_statement(
            "section4.chattering_is_periodic",
            (repeats.tried > 0).then(|| mostly(repeats)),
            format!(
                "after a rest the cycle repeats for ever; without one up to {LONGEST_PERIOD} impacts may repeat within a dot's width: in all at {} of {} Γ",
                repeats.holding, repeats.tried,
            ),
        ),
    );
    let (restitution, axial_forcing) = BELOW_SEPARATION;
    let radius = multiplier(axial_forcing, restitution)?;
    // "Remain" may mean a disk in contact, which no acceleration below g lifts, or one that returns to it.
    let returns = Kind::Always.verdict(Cases::from(radius.is_none_or(|radius| radius >= 1.0)));
    fig.claim(
        Claim::printed_statement(
            "section1.no_bouncing",
            axial_forcing * PI < 1.0,
            format!(
                "a disk in contact stays there; one thrown up at ε = {restitution} and Γ = {axial_forcing} keeps bouncing: period 1 attracts (multipliers {:.2}) from Γ = {:.3} on",
                radius.unwrap_or(f64::NAN),
                in_closed_form(restitution),
            ),
        )
        .by_definition(&[returns]),
    );
    fig.record("not_chattering", &bouncing)?;
    fig.claim(
        Claim::printed_statement(
            "section4.single_tosses_end",
            single.map(|single| single.first_other >= section.single_tosses_end),
            single.map_or_else(String::new, |single| {
                format!(
                    "a rest in every period up to Γ = {:.6}; from there to {} at {:.0} % of the Γ, and a cycle takes {} periods or more",
                    single.last,
                    section.single_tosses_end,
                    100.0 * single.share_beyond,
                    single.periods_beyond.map_or("no".to_owned(), |periods| periods.to_string()),
                )
            }),
        )
        .cause("single tosses end earlier, at Γ = 0.5085"),
    );
    fig.record("single_tosses", &single)?;

    let ones = diagram.period_ones();
    fig.claim(Claim::printed_statement(
        "section4.rest_never_reaches_period_one",
        all(&ones, |one| diagram.rests_beside(one)),
        format!(
            "at {} of {} values of Γ with an attracting period-1 orbit a disk that leaves from rest comes to rest again, and so for ever",
            ones.iter().filter(|one| diagram.rests_beside(one)).count(),
            ones.len()
        ),
    ));
    // By rising Γ.
    let cycles =
        || diagram.chattering.iter().filter_map(|slice| Some((slice.axial_forcing, slice.platform_periods?)));
    let grows = trend(cycles().map(|(forcing, periods)| (forcing, periods as f64)), 1.0);
    fig.claim(Claim::printed_statement(
        "section4.chattering_grows_complex",
        grows,
        format!("the higher Γ of a pair has the longer cycle in {}", grows.words()),
    ));
    let low = section.axial_forcings_of_fig7[2];
    let longest = cycles().filter(|(forcing, _)| *forcing <= low).map(|(_, periods)| periods).max();
    let after: Vec<u64> =
        cycles().filter(|(forcing, _)| *forcing > crisis).map(|(_, periods)| periods).collect();
    fig.claim(Claim::printed_statement(
        "section4.longer_cycles",
        all(&after, |periods| longest.is_some_and(|longest| *periods > longest)),
        format!(
            "cycles take at most {} periods of the platform up to Γ = {low}, at least {} beyond the merging",
            longest.unwrap_or_default(),
            after.iter().min().copied().unwrap_or_default(),
        ),
    ));
    decay(fig, diagram)
}

/// How the chattering sequences of a disk from rest end.
fn decay(fig: &mut Paper<'_>, diagram: &Diagram) -> Result<(), ExperimentError> {
    let mut chatters = Vec::new();
    for forcing in sampled(SAMPLED, &diagram.resting()) {
        chatters.extend(chatter(forcing, diagram.inputs.restitution)?);
    }
    let [slower, shorter]: [Cases; 2] =
        [chatters.iter().map(|of| of.slower).sum(), chatters.iter().map(|of| of.shorter).sum()];
    fig.claim(Claim::printed_statement(
        "section4.chattering_decays",
        (slower.tried.min(shorter.tried) > 0).then(|| mostly(slower) && mostly(shorter)),
        format!(
            "of all pairs of impacts in the last flights of less than half a period the later one is slower in {}, its flight shorter in {}",
            slower.words(),
            shorter.words(),
        ),
    ));
    let off = |of: &Chatter| (of.cut_at_cycles - of.rests_at_cycles).abs();
    fig.claim(Claim::printed_statement(
        "section4.rest_in_finite_time",
        any(&chatters, |of| off(of) < SAME_REST),
        format!(
            "infinitely many flights have a finite sum, from which the paper's cut differs by {:.0e} of a period at most at {} values of Γ",
            extent(chatters.iter().map(off)).1,
            chatters.len(),
        ),
    ));
    fig.record("chatters", &chatters)
}
