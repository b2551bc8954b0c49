//! Branches of periodic orbits over the forcing, stable and unstable.

mod over_forcing;
mod within;

use serde_json::json;

use crate::reply::{Refusal, Reply};
use crate::request::ImpactStart;

pub use over_forcing::{BranchInRange, branches_over_forcing};

/// How many branches there are in a window, and their bifurcations with the first impact of the orbit there. Numbers: rows
/// of the forcing, the phase (rad) and the normalised speed of one impact of an orbit on a branch, the number of the
/// branch, 1 where the orbit is stable, and the number of the line: one impact along one part of the branch. The rows of
/// a line follow each other.
pub(crate) fn answer(restitution: f64, [low, high]: [f64; 2]) -> Result<Reply, Refusal> {
    let found = branches_over_forcing(restitution, (low, high))?;
    let (mut numbers, mut lines) = (Vec::new(), 0.0);
    for (number, branch) in found.iter().enumerate() {
        for part in &branch.parts {
            for impact in 0..branch.impacts {
                for point in part {
                    let Some(state) = point.orbit.states.get(impact) else { continue };
                    let stable = f64::from(u8::from(point.is_stable()));
                    let (phase, speed) = (state.phase().angle(), state.normalised_speed());
                    numbers.extend([point.parameter, phase, speed, number as f64, stable, lines]);
                }
                lines += 1.0;
            }
        }
    }
    let bifurcations = found.iter().flat_map(|branch| &branch.bifurcations).filter_map(|one| {
        let ImpactStart { impact_phase, normalised_speed } = one.point.orbit.states.first()?.into();
        Some(json!({
            "kind": one.kind.name(),
            "axial_forcing": one.point.parameter,
            "impact_phase": impact_phase,
            "normalised_speed": normalised_speed,
        }))
    });
    let bifurcations: Vec<_> = bifurcations.collect();
    Reply::new(&json!({ "branches": found.len(), "bifurcations": bifurcations }), numbers, Vec::new())
}
