//! What the page says of the workload W3, with the same definition as in `crates/bouncing-disk-core/benches/basin.rs`.

use std::f64::consts::TAU;

use bouncing_disk_core::{ChatterPolicy, ImpactMap, ImpactState, OrbitEvent, PeriodicOrbit, Vibration};

use super::table::{digits, with_commas};

const AXIAL_FORCING: f64 = 0.5;
const RESTITUTION: f64 = 0.5;
/// Cells a side.
const CELLS: usize = 300;
const MAX_IMPACTS: usize = 500;
/// The distance from the orbit at which a cell counts as caught without the proof that it is.
const NEAR: f64 = 0.1;

/// How many cells end where, after how many impacts.
#[derive(Default)]
struct Ends {
    attached: usize,
    caught: usize,
    undecided: usize,
    impacts: usize,
    /// Impacts without the proofs of rest and of capture.
    followed: usize,
}

/// Map, known orbit and the radius within which it catches.
fn definition() -> anyhow::Result<(ImpactMap, PeriodicOrbit, f64)> {
    let map = ImpactMap::new(Vibration::from_axial_forcing(AXIAL_FORCING)?, RESTITUTION)?;
    let start = ImpactState::from_normalised(0.8, 1.3)?;
    let Some(orbit) = map.settled_orbit(start, 4_000, 4, 1.0e-8)? else {
        anyhow::bail!("the map of W3 has no periodic orbit")
    };
    let Some(radius) = orbit.trapping_radius(&map, 64) else {
        anyhow::bail!("the periodic orbit of W3 attracts nothing")
    };
    Ok((map, orbit, radius))
}

/// The names of the places in the page, and what stands there.
pub(super) fn places() -> anyhow::Result<Vec<(&'static str, String)>> {
    let (map, orbit, radius) = definition()?;
    let ends = ends(&map, &orbit, radius)?;
    let mean = |impacts: usize| digits(impacts as f64 / (CELLS * CELLS) as f64);
    let impact = |state: &ImpactState| format!("τ = {} with v = {}", state.phase().angle(), state.velocity());
    Ok(vec![
        ("w3_peak", map.vibration().peak_acceleration().to_string()),
        ("w3_orbit", orbit.states.iter().map(impact).collect::<Vec<_>>().join(" and at\n")),
        ("w3_radius", format!("{radius:.4}")),
        ("w3_cells", with_commas(CELLS * CELLS)),
        ("w3_attached", with_commas(ends.attached)),
        ("w3_caught", with_commas(ends.caught)),
        ("w3_undecided", with_commas(ends.undecided)),
        ("w3_impacts", mean(ends.impacts)),
        ("w3_followed", mean(ends.followed)),
    ])
}

/// Follows every cell one impact at a time.
fn ends(map: &ImpactMap, orbit: &PeriodicOrbit, radius: f64) -> anyhow::Result<Ends> {
    let peak = map.vibration().peak_acceleration();
    let mut ends = Ends::default();
    let centre = |index: usize| (index as f64 + 0.5) / CELLS as f64;
    for (column, row) in (0..CELLS * CELLS).map(|cell| (cell % CELLS, cell / CELLS)) {
        let start = ImpactState::from_normalised(TAU * centre(column), 2.0 * centre(row))?;
        let (mut state, mut impacts) = (start, 0);
        loop {
            let speed = -map.restitution() * state.velocity();
            if map.vibration().chatters_to_rest(state.phase(), speed, map.restitution()) {
                ends.attached += 1;
            } else if orbit.distance(state, peak) <= radius {
                ends.caught += 1;
            } else if impacts == MAX_IMPACTS {
                ends.undecided += 1;
            } else {
                state = map.step(state)?.into();
                impacts += 1;
                continue;
            }
            break;
        }
        ends.impacts += impacts;
        if orbit.distance(start, peak) <= NEAR {
            continue;
        }
        for event in map.orbit(start, ChatterPolicy::Complete).take(MAX_IMPACTS) {
            let OrbitEvent::Impact(impact) = event? else { break };
            ends.followed += 1;
            if orbit.distance(impact.into(), peak) <= NEAR {
                break;
            }
        }
    }
    Ok(ends)
}

#[cfg(test)]
mod tests {
    use bouncing_disk_core::{ATTACHED, Axis, BasinSettings, Grid, KnownOrbit, UNDECIDED};

    use super::*;

    #[test]
    fn cells_followed_by_hand_end_as_in_the_basin() {
        let (map, orbit, radius) = definition().expect("attracts");
        let ends = ends(&map, &orbit, radius).expect("no failure");
        let axis = |high| Axis::new(0.0, high, CELLS).expect("legal axis");
        let grid = Grid::new(axis(1.0), axis(2.0)).expect("legal grid");
        let settings = BasinSettings { max_impacts: MAX_IMPACTS as u32, policy: ChatterPolicy::Complete };
        let basins = map
            .basins(grid, &[KnownOrbit::new(orbit, radius).expect("legal")], settings)
            .expect("no failure");
        let labels = basins.labels();
        let count = |label| labels.iter().filter(|&&own| own == label).count();
        assert_eq!((ends.attached, ends.undecided), (count(ATTACHED), count(UNDECIDED)));
        assert_eq!(ends.attached + ends.caught + ends.undecided, labels.len());
        assert!(0 < ends.impacts && ends.impacts < ends.followed, "{} {}", ends.impacts, ends.followed);
    }
}
