//! The fastest impacts of the exact map beside bounds on them.

use bouncing_disk::core::{ChatterPolicy, Orbit, orbit_diagram};

use super::behaviour::{map, own_speed, starts};
use crate::experiment::ExperimentError;

/// Impacts that are passed over, and that are looked at.
const TRANSIENT: usize = 300;
const RECORDED: usize = 300;

/// The largest own speed after an impact that lasts, over a grid of starts, and what bounds it (units of g/omega).
#[derive(Clone, Copy, Debug)]
pub(super) struct Fastest {
    pub(super) restitution: f64,
    pub(super) peak_acceleration: f64,
    pub(super) speed: f64,
    /// M of docs/numerics/dynamics.md.
    pub(super) proven: f64,
    /// (1 + 3r)/(1 - r) P.
    pub(super) rebuilt: f64,
    /// (1 + r)/(1 - r) P, which holds for the high-bounce map.
    pub(super) reduced: f64,
}

/// Over 5 restitutions and 10 peak accelerations.
pub(super) fn fastest() -> Result<Vec<Fastest>, ExperimentError> {
    const RESTITUTIONS: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];
    const PEAKS: [f64; 10] = [0.2, 0.5, 0.8, 1.0, 1.2, 1.5, 2.0, 4.0, 8.0, 20.0];
    let mut all = Vec::new();
    for restitution in RESTITUTIONS {
        for peak_acceleration in PEAKS {
            let map = map(peak_acceleration, restitution)?;
            let orbits: Vec<Orbit> = starts(&map, 6)?
                .iter()
                .map(|(map, start)| map.orbit(*start, ChatterPolicy::Complete))
                .collect();
            let impacts = orbit_diagram(&orbits, TRANSIENT, RECORDED)?;
            let speeds = impacts.iter().flatten().map(|state| own_speed(&map, state).abs());
            all.push(Fastest {
                restitution,
                peak_acceleration,
                speed: speeds.fold(0.0, f64::max),
                proven: map.launch_speed_bound(),
                rebuilt: (1.0 + 3.0 * restitution) / (1.0 - restitution) * peak_acceleration,
                reduced: (1.0 + restitution) / (1.0 - restitution) * peak_acceleration,
            });
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_orbit_is_faster_than_both_bounds() {
        let all = fastest().expect("computed");
        assert_eq!(all.len(), 50);
        for at in &all {
            assert!(at.speed <= at.proven && at.speed <= at.rebuilt, "{at:?}");
        }
        // The test could not fail if nothing moved.
        assert!(all.iter().any(|at| at.speed > 0.5 * at.proven));
    }
}
