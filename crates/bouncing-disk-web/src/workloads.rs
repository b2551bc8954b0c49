//! What is timed in WebAssembly and natively: impacts in lockstep (W1), and the basin W3 of the benchmarks of the core.

use bouncing_disk_core::attractors::{Axis, BasinSettings, Grid, KnownOrbit};
use bouncing_disk_core::sweep::{InstructionSet, OrbitBatch};
use bouncing_disk_core::{ChatterPolicy, Error, ImpactMap, ImpactState, Unobserved, Vibration};

/// Orbits in lockstep.
const ORBITS: usize = 1_024;

/// The workloads, ready to be run again and again.
#[derive(Debug)]
pub struct Workloads {
    orbits: OrbitBatch,
    map: ImpactMap,
    known: [KnownOrbit; 1],
}

impl Workloads {
    /// Both, the first with the vectors of WebAssembly or else the least that every machine of this kind has; `None` if
    /// the library refuses one of the parameters, which it does not.
    #[must_use]
    pub fn new() -> Option<Self> {
        let chaotic = ImpactMap::new(Vibration::from_axial_forcing(0.55).ok()?, 0.5).ok()?;
        let start = ImpactState::from_normalised(0.8, 1.3).ok()?;
        let mut state = start;
        let mut states = Vec::with_capacity(ORBITS);
        for _ in 0..ORBITS {
            state = chaotic.step(state).ok()?.into();
            states.push((chaotic, state));
        }
        let set =
            if cfg!(target_arch = "wasm32") { InstructionSet::Simd128 } else { InstructionSet::Baseline };
        let map = ImpactMap::new(Vibration::from_axial_forcing(0.5).ok()?, 0.5).ok()?;
        let orbit = map.settled_orbit(start, 4_000, 4, 1.0e-8, &Unobserved).ok()??;
        let radius = orbit.trapping_radius(&map, 64, &Unobserved).ok()?;
        Some(Self {
            orbits: OrbitBatch::with_instruction_set(states, set),
            map,
            known: [KnownOrbit::new(orbit, radius).ok()?],
        })
    }

    /// One more impact of each orbit, so many times; how many impacts that were.
    ///
    /// # Errors
    /// An orbit that has no next impact.
    pub fn impacts(&mut self, times: u32) -> Result<f64, Error> {
        for _ in 0..times {
            self.orbits.step()?;
        }
        Ok(f64::from(times) * ORBITS as f64)
    }

    /// The basin with so many cells a side; how many cells that were.
    ///
    /// # Errors
    /// Of a grid without cells, or too large.
    pub fn cells(&self, side: usize) -> Result<f64, Error> {
        let axis = |high| Axis::new(0.0, high, side);
        let settings = BasinSettings { max_impacts: 500, policy: ChatterPolicy::Complete };
        std::hint::black_box(self.map.basins(
            Grid::new(axis(1.0)?, axis(2.0)?)?,
            &self.known,
            settings,
            &Unobserved,
        )?);
        Ok(side as f64 * side as f64)
    }
}
