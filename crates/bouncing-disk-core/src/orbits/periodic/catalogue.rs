//! Distinct periodic orbits, and how often each was found.

use super::PeriodicOrbit;
use super::newton::same_orbit;

/// An orbit of a [`Catalogue`].
#[derive(Debug, Clone)]
struct Entry {
    orbit: PeriodicOrbit,
    /// Sum of the impact velocities, which does not depend on where the orbit begins.
    sum: f64,
    found: u64,
    by_coarser: bool,
}

/// Distinct orbits in the order in which they were found first.
#[derive(Debug, Clone, Default)]
pub(super) struct Catalogue {
    entries: Vec<Entry>,
}

impl Catalogue {
    /// Adds an orbit that was found so often, unless it is known.
    pub(super) fn add(&mut self, orbit: PeriodicOrbit, found: u64, by_coarser: bool) {
        let sum = orbit.states.iter().fold(0.0, |sum, state| sum + state.velocity());
        self.insert(Entry { orbit, sum, found, by_coarser });
    }

    /// Adds all orbits of another catalogue.
    pub(super) fn merge(&mut self, other: Self) {
        for entry in other.entries {
            self.insert(entry);
        }
    }

    fn insert(&mut self, entry: Entry) {
        // The sums differ by twice what the comparison of the impacts allows at most.
        let room = 2.0 * (entry.orbit.period() as f64 + entry.sum.abs());
        let known = self.entries.iter_mut().find(|known| {
            let errors = known.orbit.position_error + entry.orbit.position_error;
            (known.sum - entry.sum).abs() <= room * errors && same_orbit(&known.orbit, &entry.orbit)
        });
        match known {
            Some(known) => {
                known.found += entry.found;
                known.by_coarser |= entry.by_coarser;
            }
            None => self.entries.push(entry),
        }
    }

    /// How many were found from a coarser grid, too.
    pub(super) fn found_by_coarser(&self) -> u64 {
        self.entries.iter().filter(|entry| entry.by_coarser).count() as u64
    }

    /// How many were found once.
    pub(super) fn found_once(&self) -> u64 {
        self.entries.iter().filter(|entry| entry.found == 1).count() as u64
    }

    /// The orbits by impacts, platform periods, falling speed of the first impact, phase of the first impact.
    pub(super) fn into_sorted(self) -> Vec<PeriodicOrbit> {
        let mut orbits: Vec<_> = self.entries.into_iter().map(|entry| entry.orbit).collect();
        orbits.sort_by(|a, b| {
            let (first, second) = (a.states[0], b.states[0]);
            (a.period(), a.platform_periods)
                .cmp(&(b.period(), b.platform_periods))
                .then(first.velocity().total_cmp(&second.velocity()))
                .then(first.phase().angle().total_cmp(&second.phase().angle()))
        });
        orbits
    }
}
