//! The chattering orbit: its cycle, and the end of the single tosses.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use bouncing_disk::core::numerics::roots::bracket_of_width;
use bouncing_disk::core::sweep::{SweepEvent, sweep};
use bouncing_disk::core::{ChatterPolicy, Error, ImpactMap, Launch, OrbitEvent, Unobserved, Vibration};
use bouncing_disk::motion::PAPER_CHATTER;
use bouncing_disk::parameters::DimensionlessSystem;
use bouncing_disk::toss::{ChatteringCycle, LONG_FLIGHT, MultiTossSettings, TossOrbit, multi_toss};

use super::data::{Chatter, SingleTosses, Slice};
use super::slices::{Inputs, Systems, slice, start};
use crate::claims::judging::trend;
use crate::claims::paper::SectionFour;
use crate::experiment::ExperimentError;
use crate::figures::shared::map;

/// An orbit that has not attached after so many impacts does not chatter.
const LONGEST_CYCLE: usize = 20_000;

/// The cycles of a disk that has been at rest, at each Γ; `None` where it never leaves or does not come to
/// rest again.
pub(super) fn cycles(
    forcings: &[f64],
    restitution: f64,
    policy: ChatterPolicy,
) -> Result<Vec<Option<ChatteringCycle>>, Error> {
    let mut orbits = Vec::new();
    let mut cycles = vec![None; forcings.len()];
    let mut leaving = Vec::new();
    for (index, &forcing) in forcings.iter().enumerate() {
        let map = ImpactMap::new(Vibration::from_axial_forcing(forcing)?, restitution)?;
        if let Some(leaves) = map.vibration().separation_phase() {
            orbits.push(map.orbit_from_launch(Launch::new(leaves, 0.0)?, policy));
            leaving.push(index);
        }
    }
    let walked = sweep(
        &orbits,
        |_| (ChatteringCycle::default(), false),
        |(cycle, rests), event| match event {
            SweepEvent::Impact(landing) => {
                cycle.impacts += 1;
                cycle.platform_periods += landing.turns;
                cycle.long_flights += usize::from(landing.duration > LONG_FLIGHT);
                if cycle.impacts < LONGEST_CYCLE { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            }
            SweepEvent::Attachment(rest) => {
                cycle.platform_periods +=
                    rest.accumulation.turns + rest.separation.map_or(0, |(_, turns)| turns);
                *rests = true;
                ControlFlow::Break(())
            }
            _ => ControlFlow::Break(()),
        },
        &Unobserved,
    )?;
    for (index, (cycle, rests)) in leaving.into_iter().zip(walked) {
        cycles[index] = rests.then_some(cycle);
    }
    Ok(cycles)
}

/// How a disk that leaves the platform from rest comes to rest again.
struct ToRest {
    /// Durations (radians) and impact speeds.
    flights: Vec<(f64, f64)>,
    /// The time of rest (radians).
    time: f64,
}

/// `None` where the disk does not leave or does not come to rest.
fn to_rest(map: &ImpactMap, policy: ChatterPolicy) -> Result<Option<ToRest>, ExperimentError> {
    let Some(leaves) = map.vibration().separation_phase() else { return Ok(None) };
    let mut orbit = map.orbit_from_launch(Launch::new(leaves, 0.0)?, policy);
    let (mut flights, mut time) = (Vec::new(), 0.0);
    while flights.len() < LONGEST_CYCLE {
        match orbit.advance()? {
            Some(OrbitEvent::Impact(impact)) => {
                time += impact.duration();
                flights.push((impact.duration(), -impact.velocity));
            }
            Some(OrbitEvent::Attachment(rest)) => {
                return Ok(Some(ToRest { flights, time: time + rest.accumulation.duration }));
            }
            _ => return Ok(None),
        }
    }
    Ok(None)
}

/// How a disk from rest comes to rest at each Γ.
pub(super) fn chatters(forcings: &[f64], restitution: f64) -> Result<Vec<Chatter>, ExperimentError> {
    let chatter = |&axial_forcing: &f64| -> Result<Option<Chatter>, ExperimentError> {
        let map = map(axial_forcing, restitution)?;
        let (Some(cut), Some(rests)) =
            (to_rest(&map, PAPER_CHATTER)?, to_rest(&map, ChatterPolicy::Complete)?)
        else {
            return Ok(None);
        };
        let long = cut.flights.iter().rposition(|(duration, _)| *duration > LONG_FLIGHT);
        let chatter = &cut.flights[long.map_or(0, |long| long + 1)..];
        let falls = |of: fn(&(f64, f64)) -> f64| {
            trend(chatter.iter().enumerate().map(|(impact, flight)| (impact as f64, of(flight))), -1.0)
        };
        Ok(Some(Chatter {
            axial_forcing,
            impacts: chatter.len(),
            slower: falls(|flight| flight.1),
            shorter: falls(|flight| flight.0),
            rests_at_cycles: rests.time / TAU,
            cut_at_cycles: cut.time / TAU,
        }))
    };
    forcings.iter().map(chatter).filter_map(Result::transpose).collect()
}

fn tosses(system: &DimensionlessSystem, settings: MultiTossSettings) -> Result<TossOrbit, ExperimentError> {
    multi_toss(*system, start(system, None, true)?, settings, &Unobserved).map_err(ExperimentError::model)
}

/// The impacts of the chattering orbit, if the disk has a chattering `cycle` at this forcing.
pub(super) fn chattering_slice(
    axial_forcing: f64,
    cycle: Option<ChatteringCycle>,
    inputs: Inputs,
    settings: MultiTossSettings,
) -> Result<Option<Slice>, ExperimentError> {
    let Some(cycle) = cycle else {
        return Ok(None);
    };
    let systems = Systems::at(axial_forcing, inputs)?;
    let linear = tosses(&systems.linear, settings)?;
    let semielliptical = tosses(&systems.semielliptical, settings)?;
    let slice = slice(axial_forcing, inputs, &linear, &semielliptical);
    Ok(Some(Slice { period: Some(cycle.impacts), platform_periods: Some(cycle.platform_periods), ..slice }))
}

/// Where the chattering orbit stops being a chain of single tosses, looked for on `forcings` with their
/// cycles and bisected.
pub(super) fn single_tosses(
    forcings: &[(f64, Option<ChatteringCycle>)],
    section: &SectionFour,
    policy: ChatterPolicy,
) -> Result<SingleTosses, ExperimentError> {
    let (restitution, printed_end) = (section.restitution, section.single_tosses_end);
    let is_single = |cycle: &Option<ChatteringCycle>| cycle.is_some_and(|cycle| cycle.is_single_toss());
    let (mut last, mut first_other) = (f64::NAN, printed_end);
    for (forcing, cycle) in
        forcings.iter().filter(|(forcing, _)| *forcing * PI > 1.0 && *forcing < printed_end)
    {
        if is_single(cycle) {
            last = *forcing;
        } else {
            first_other = *forcing;
            break;
        }
    }
    // A NaN (no Γ at all) ends the loop at once.
    let (last, first_other) = bracket_of_width(last, first_other, 1.0e-9, |forcing| {
        let cycle = cycles(&[forcing], restitution, policy)?;
        Ok::<_, ExperimentError>(cycle.iter().all(is_single))
    })?;
    let beyond: Vec<f64> =
        (0..200).map(|i| first_other + (printed_end - first_other) * (f64::from(i) + 0.5) / 200.0).collect();
    let beyond = cycles(&beyond, restitution, policy)?;
    let periods: Vec<u64> = beyond.iter().flatten().map(|cycle| cycle.platform_periods).collect();
    let singles = beyond.iter().flatten().filter(|cycle| cycle.is_single_toss()).count();
    Ok(SingleTosses {
        last,
        first_other,
        share_beyond: singles as f64 / beyond.len() as f64,
        periods_beyond: periods.into_iter().min(),
    })
}
