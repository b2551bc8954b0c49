//! The followed attractor about the third to the fifth doubling, at finer steps of Γ.

use bouncing_disk::core::Unobserved;
use bouncing_disk::core::orbits::follow_attractor;
use bouncing_disk::core::sweep::orbit_diagram;
use bouncing_disk::motion::PAPER_CHATTER;
use serde::Serialize;

use super::crisis::rounded;
use super::diagram::Diagram;
use crate::experiment::{ExperimentError, Quality};
use crate::figures::shared::distinct_phases;

/// The doublings shown.
pub(super) const DOUBLINGS: std::ops::RangeInclusive<usize> = 3..=5;
/// Room before the first and after the last of them, over their distance.
const ROOM: (f64, f64) = (0.45, 0.17);
/// Impacts at each Γ before any is kept: next to a doubling an orbit attracts slowly.
const TRANSIENT: usize = 3_000;
/// Impacts at each Γ that are kept.
const IMPACTS: usize = 128;

/// The impact phases at one Γ.
#[derive(Serialize)]
pub(super) struct Column {
    pub(super) axial_forcing: f64,
    /// τ_imp/2π, each once, to six decimals.
    pub(super) impact_phase_cycles: Vec<f64>,
}

pub(super) fn columns(
    diagram: &Diagram,
    doublings: &[f64],
    quality: Quality,
) -> Result<Vec<Column>, ExperimentError> {
    let doubling = |n: usize| doublings.get(n - 1);
    let Some((first, last)) = doubling(*DOUBLINGS.start()).zip(doubling(*DOUBLINGS.end())) else {
        return Ok(Vec::new());
    };
    let (low, high) =
        (rounded(first - ROOM.0 * (last - first), 4), rounded(last + ROOM.1 * (last - first), 4));
    let below = diagram.walk.iter().rev().find(|at| at.axial_forcing <= low);
    let Some(from) = below.map(|at| at.state).or(diagram.first) else { return Ok(Vec::new()) };
    let steps = quality.choose(80, 480);
    let forcings = (0..=steps).map(|step| low + (high - low) * f64::from(step) / f64::from(steps));
    let restitution = diagram.inputs.restitution;
    let followed = follow_attractor(restitution, forcings, from, TRANSIENT, PAPER_CHATTER)
        .collect::<Result<Vec<_>, _>>()?;
    let orbits: Vec<_> = followed.iter().map(|at| at.map.orbit(at.state, PAPER_CHATTER)).collect();
    let states = orbit_diagram(&orbits, 0, IMPACTS, &Unobserved)?;
    let column = |(at, states): (&bouncing_disk::core::orbits::Followed, &Vec<_>)| Column {
        axial_forcing: at.axial_forcing,
        impact_phase_cycles: distinct_phases(states),
    };
    Ok(followed.iter().zip(&states).map(column).collect())
}
