//! The crisis in which the followed attractor is lost to chattering, by bisection on survival.

use bouncing_disk::core::numerics::roots::bracket_of_width;
use bouncing_disk::core::orbits::follow_attractor;
use bouncing_disk::core::sweep::survival_times;
use bouncing_disk::core::{ChatterPolicy, ImpactState, Orbit, Unobserved};

use super::data::Merging;
use super::inputs::{Inputs, map};
use crate::experiment::ExperimentError;

/// Γ inside the chaotic range, where the starts of all trials lie on the attractor.
const SAFE_FORCING: f64 = 0.5555;
/// Γ at which the attractor is long gone.
const LOST_FORCING: f64 = 0.567;
/// Orbits tried.
const STARTS: usize = 8;
/// Width at which the bisection ends.
const BRACKET: f64 = 1.0e-7;

/// States on the followed attractor at [`SAFE_FORCING`].
pub(super) fn starts(first: ImpactState, inputs: Inputs) -> Result<Vec<ImpactState>, ExperimentError> {
    let Inputs { restitution, followed_from, .. } = inputs;
    let forcings = (0..).map(|i| followed_from + 1.0e-4 * f64::from(i)).take_while(|f| *f < SAFE_FORCING);
    let mut state = first;
    for followed in follow_attractor(restitution, forcings, first, 300, ChatterPolicy::Complete) {
        state = followed?.state;
    }
    let map = map(SAFE_FORCING, restitution)?;
    let mut states = Vec::new();
    while states.len() < STARTS {
        match map.state_after(state, 1_000, ChatterPolicy::Complete, &Unobserved)? {
            Some(next) => states.push(next),
            None => break,
        }
        state = states[states.len() - 1];
    }
    Ok(states)
}

/// The orbits of all starts at each Γ.
fn orbits(forcings: &[f64], starts: &[ImpactState], restitution: f64) -> Result<Vec<Orbit>, ExperimentError> {
    let mut orbits = Vec::with_capacity(forcings.len() * starts.len());
    for &forcing in forcings {
        let map = map(forcing, restitution)?;
        orbits.extend(starts.iter().map(|&start| map.orbit(start, ChatterPolicy::Complete)));
    }
    Ok(orbits)
}

/// The last bracket (survived, lost). Its few orbits are advanced one by one: the next Γ is known only when
/// they are done, and k bisections ahead at once are (2^k − 1)/k times as many orbits, which takes back most
/// of what lanes gain.
fn bracket(starts: &[ImpactState], restitution: f64, impacts: usize) -> Result<(f64, f64), ExperimentError> {
    bracket_of_width(SAFE_FORCING, LOST_FORCING, BRACKET, |forcing| {
        let orbits = orbits(&[forcing], starts, restitution)?;
        let lives = survival_times(&orbits, impacts, &Unobserved)?;
        Ok(lives.into_iter().all(|lived| lived == impacts))
    })
}

/// Locates the crisis of the attractor that is followed from `first`.
pub(super) fn merging(
    first: ImpactState,
    inputs: Inputs,
    impacts: usize,
) -> Result<Merging, ExperimentError> {
    let starts = starts(first, inputs)?;
    let restitution = inputs.restitution;
    let (whole, tenth) = rayon::join(
        || bracket(&starts, restitution, impacts),
        || bracket(&starts, restitution, impacts / 10),
    );
    let ((survived, lost), (survived_in_a_tenth, lost_in_a_tenth)) = (whole?, tenth?);
    let forcings: Vec<f64> = (0..16).map(|i| 0.5600 + 0.0001 * f64::from(i)).collect();
    let lives = survival_times(&orbits(&forcings, &starts, restitution)?, impacts / 10, &Unobserved)?;
    let mean_life_impacts = forcings
        .into_iter()
        .zip(lives.chunks(starts.len().max(1)))
        .map(|(forcing, lives)| (forcing, lives.iter().sum::<usize>() as f64 / lives.len() as f64))
        .collect();
    Ok(Merging {
        impacts,
        starts: starts.len(),
        survived,
        lost,
        survived_in_a_tenth,
        lost_in_a_tenth,
        mean_life_impacts,
    })
}
