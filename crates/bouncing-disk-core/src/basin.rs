//! Basins of attraction of the impact map on a grid of impact phases and speeds.

mod lockstep;
mod screen;
mod starts;

use serde::{Deserialize, Serialize};

use crate::chatter::ChatterPolicy;
use crate::error::{Error, within};
use crate::map::{ImpactMap, ImpactState, OrbitEvent};
use crate::periodic::PeriodicOrbit;
use starts::Cells;

/// What became of a start: one byte a cell.
pub type Label = u8;
/// Neither at rest nor near a known orbit after the allowed number of impacts: undecided, or on a chaotic attractor.
pub const UNDECIDED: Label = 0;
/// The disk came to rest on the platform: the basin of the chattering orbit.
pub const ATTACHED: Label = 1;
/// The first known periodic orbit; the next ones count up from here.
pub const FIRST_ORBIT: Label = 2;

/// One axis of a grid: `cells` cells of equal width from `low` to `high`, each stood for by its centre.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    low: f64,
    high: f64,
    cells: usize,
}

impl Axis {
    /// An axis from `low` < `high` with `cells` >= 1 cells.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an empty, reversed or non-finite axis.
    pub fn new(low: f64, high: f64, cells: usize) -> Result<Self, Error> {
        within("axis low end", low, f64::MIN, f64::MAX, "finite")?;
        if !(high > low && high.is_finite()) {
            return Err(Error::OutOfRange {
                field: "axis high end",
                value: high,
                legal: "finite and above the low end",
            });
        }
        within("axis cells", cells as f64, 1.0, 100_000.0, "[1, 100000]")?;
        Ok(Self { low, high, cells })
    }

    /// Low end.
    #[must_use]
    pub const fn low(&self) -> f64 {
        self.low
    }

    /// High end.
    #[must_use]
    pub const fn high(&self) -> f64 {
        self.high
    }

    /// Number of cells.
    #[must_use]
    pub const fn cells(&self) -> usize {
        self.cells
    }

    /// Centre of cell `index`.
    #[must_use]
    pub fn centre(&self, index: usize) -> f64 {
        self.low + (self.high - self.low) * ((index as f64 + 0.5) / self.cells as f64)
    }
}

/// A grid of starts: impact phase in periods (tau_imp/2 pi) and normalised impact speed |w_A Gamma/(omega A)|.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Impact phase in periods.
    pub phase: Axis,
    /// Normalised impact speed |w|/pi, >= 0.
    pub speed: Axis,
}

impl Grid {
    /// A grid; the speed axis must not be negative.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for negative speeds.
    pub fn new(phase: Axis, speed: Axis) -> Result<Self, Error> {
        within("lowest normalised speed", speed.low(), 0.0, f64::MAX, "[0, inf)")?;
        Ok(Self { phase, speed })
    }
}

/// An attracting periodic orbit and how near a start must come to count as caught.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownOrbit {
    /// The orbit.
    pub orbit: PeriodicOrbit,
    /// Radius in radians (a radian counts as much as the speed P): see [`PeriodicOrbit::trapping_radius`].
    pub radius: f64,
}

/// How long a start is followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct BasinSettings {
    /// Impacts after which a start is left [`UNDECIDED`].
    pub max_impacts: u32,
    /// What ends a chattering sequence.
    pub policy: ChatterPolicy,
}

impl Default for BasinSettings {
    fn default() -> Self {
        Self { max_impacts: 2_000, policy: ChatterPolicy::Complete }
    }
}

/// Labels of a grid, row by row (speed), lowest speed first; in a row by phase.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Basins {
    labels: Vec<Label>,
    columns: usize,
}

impl Basins {
    /// All labels: `phase.cells()` per row, rows by rising speed.
    #[must_use]
    pub fn labels(&self) -> &[Label] {
        &self.labels
    }

    /// The labels of one row.
    ///
    /// Empty if there is no such row.
    #[must_use]
    pub fn row(&self, index: usize) -> &[Label] {
        self.labels.chunks_exact(self.columns).nth(index).unwrap_or(&[])
    }

    /// The share of cells with this label.
    #[must_use]
    pub fn fraction(&self, label: Label) -> f64 {
        self.labels.iter().filter(|&&own| own == label).count() as f64 / self.labels.len() as f64
    }
}

impl ImpactMap {
    /// What becomes of one start: [`ATTACHED`], the index of a known orbit + [`FIRST_ORBIT`], or [`UNDECIDED`].
    ///
    /// # Errors
    /// Those of [`crate::Vibration::first_impact`].
    pub fn basin_label(
        &self,
        start: ImpactState,
        known: &[KnownOrbit],
        settings: BasinSettings,
    ) -> Result<Label, Error> {
        let settles = |state: ImpactState| self.settles(state, known, settings.policy);
        if let Some(label) = settles(start) {
            return Ok(label);
        }
        let mut orbit = self.orbit(start, settings.policy);
        for _ in 0..settings.max_impacts {
            match orbit.advance()? {
                Some(OrbitEvent::Impact(impact)) => {
                    if let Some(label) = settles(impact.into()) {
                        return Ok(label);
                    }
                }
                Some(OrbitEvent::Stick(_)) | None => return Ok(ATTACHED),
            }
        }
        Ok(UNDECIDED)
    }

    /// The label that an impact in `state` decides: near a known orbit, or (complete policy) certain to chatter to rest.
    pub(crate) fn settles(
        &self,
        state: ImpactState,
        known: &[KnownOrbit],
        policy: ChatterPolicy,
    ) -> Option<Label> {
        let scale = self.vibration().peak_acceleration();
        let caught = known.iter().position(|known| known.orbit.distance(state, scale) <= known.radius);
        if let Some(index) = caught {
            return Some(FIRST_ORBIT + index as Label);
        }
        let speed = -self.restitution() * state.velocity();
        let rests = policy == ChatterPolicy::Complete
            && self.vibration().chatters_to_rest(state.phase(), speed, self.restitution());
        rests.then_some(ATTACHED)
    }

    /// The basins on a grid. `row_done` is called after every finished row (from any thread, in any order).
    ///
    /// The labels are the same for any number of threads.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for more than 250 known orbits; those of [`crate::Vibration::first_impact`].
    pub fn basins(
        &self,
        grid: Grid,
        known: &[KnownOrbit],
        settings: BasinSettings,
        row_done: impl Fn() + Sync,
    ) -> Result<Basins, Error> {
        within("number of known orbits", known.len() as f64, 0.0, 250.0, "[0, 250]")?;
        let columns = grid.phase.cells();
        let mut labels = vec![UNDECIDED; columns * grid.speed.cells()];
        #[cfg(feature = "parallel")]
        let threads = rayon::current_num_threads();
        #[cfg(not(feature = "parallel"))]
        let threads = 1;
        let cells = Cells::new(grid, &mut labels, threads, row_done)?;
        let lanes = cells.count().div_ceil(threads);
        let work = || self.label_cells(&cells, known, settings, lanes).inspect_err(|_| cells.give_up());
        #[cfg(feature = "parallel")]
        {
            use rayon::prelude::*;
            (0..threads).into_par_iter().with_max_len(1).try_for_each(|_| work())?;
        }
        #[cfg(not(feature = "parallel"))]
        work()?;
        Ok(Basins { labels, columns })
    }
}
