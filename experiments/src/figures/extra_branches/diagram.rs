//! The orbit diagram under the branches.

use bouncing_disk::PAPER_CHATTER;
use bouncing_disk::core::{Error, Followed, ImpactState, Launch, Orbit, follow_attractor, orbit_diagram};

use super::branches::map;
use super::data::Column;

/// How many impacts are left out and drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lengths {
    pub(super) transient: usize,
    pub(super) examined: usize,
}

/// Γ of the columns.
pub(super) fn forcings((low, high): (f64, f64), columns: usize) -> Vec<f64> {
    (0..columns).map(|i| low + (high - low) * i as f64 / (columns - 1) as f64).collect()
}

/// The attractor that begins as one impact every k periods, at the forcings above its birth, until it is
/// lost.
pub(super) fn followed(
    restitution: f64,
    k: u64,
    forcings: &[f64],
    lengths: Lengths,
) -> Result<Vec<Followed>, Error> {
    let birth = k as f64 * (1.0 - restitution) / (1.0 + restitution);
    let above: Vec<f64> = forcings.iter().copied().filter(|forcing| *forcing > birth + 0.002).collect();
    let Some(first) = above.first() else { return Ok(Vec::new()) };
    let Some(start) = map(*first, restitution)?.period_one(k) else { return Ok(Vec::new()) };
    follow_attractor(restitution, above, start, lengths.transient, PAPER_CHATTER).collect()
}

/// The impacts of what is followed.
pub(super) fn columns_of(followed: &[Followed], lengths: Lengths) -> Result<Vec<Column>, Error> {
    let orbits: Vec<Orbit> = followed.iter().map(|at| at.map.orbit(at.state, PAPER_CHATTER)).collect();
    let forcings: Vec<f64> = followed.iter().map(|at| at.axial_forcing).collect();
    columns(&forcings, &orbits, 0, lengths.examined)
}

/// The impacts of a disk that leaves the platform from rest.
pub(super) fn from_rest(restitution: f64, forcings: &[f64], lengths: Lengths) -> Result<Vec<Column>, Error> {
    let (mut leaving, mut orbits) = (Vec::new(), Vec::new());
    for &forcing in forcings {
        let map = map(forcing, restitution)?;
        if let Some(phase) = map.vibration().separation_phase() {
            leaving.push(forcing);
            orbits.push(map.orbit_from_launch(Launch::new(phase, 0.0)?, PAPER_CHATTER));
        }
    }
    columns(&leaving, &orbits, lengths.transient, lengths.examined)
}

fn columns(
    forcings: &[f64],
    orbits: &[Orbit],
    transient: usize,
    examined: usize,
) -> Result<Vec<Column>, Error> {
    let diagram = orbit_diagram(orbits, transient, examined)?;
    let six_decimals = |state: &ImpactState| (state.phase().cycles() * 1e6).round() / 1e6;
    let column = |(forcing, states): (&f64, Vec<ImpactState>)| {
        let mut phases: Vec<f64> = states.iter().map(six_decimals).collect();
        // A periodic orbit repeats its impacts: each is kept once.
        phases.sort_by(f64::total_cmp);
        phases.dedup();
        Column { axial_forcing: *forcing, impact_phase_cycles: phases }
    };
    Ok(forcings.iter().zip(diagram).map(column).collect())
}
