//! All periodic orbits of few impacts, stable and unstable: a search that states its coverage
//! (docs/numerics-dynamics.md, "The search for periodic orbits").
//!
//! The starts cover all impact speeds up to sqrt(U^2 + 2 P (1 - sin tau)) + P cos tau, with U = M, the bound
//! on launch speeds. For orbits of at most K periods of the platform U may be smaller. A disk that lands
//! while rising is overtaken by the platform: 0 < V <= P, so u^2 <= P^2 + 4 P. Any other disk with u^2 > 4 P
//! lands with V <= -sqrt(u^2 - 4 P), after a flight of at least u + sqrt(u^2 - 4 P). If that is at most 2 pi
//! K, then u <= pi K + P/(pi K). U is the larger of these two bounds, and at most M.
//!
//! Coverage on 20 random maps (6 in the last line) with r 0.1 to 0.9 and Gamma 0.1 to 3; time on two cores:
//!
//! | most impacts, periods | starts | orbits found | by half the resolution | by one attempt | time for a map |
//! | --- | --- | --- | --- | --- | --- |
//! | 2, 4 | 96 x 96 | 196 | 196 | 0 | 0.15 s |
//! | 4, 4 | 48 x 48 | 391 | 344 | 26 | 0.10 s |
//! | 4, 4 | 96 x 96 | 402 | 381 | 12 | 0.25 s |
//! | 6, 6 | 96 x 96 | 956 | 700 | 160 | 0.56 s |

use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::{Error, within};
use crate::numerics::stored::read_checked;
use crate::orbits::periodic::PeriodicOrbit;
use crate::orbits::periodic::newton::{Attempt, MAX_STEPS, same_orbit};
use crate::run::{Observer, Watch, WorkCount, in_parallel};
use core::f64::consts::TAU;

/// The settings of a search for periodic orbits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedSearch"))]
pub struct OrbitSearch {
    max_impacts: usize,
    max_platform_periods: u64,
    phases: u32,
    speeds: u32,
}

read_checked!(OrbitSearch as UncheckedSearch {
    max_impacts: usize,
    max_platform_periods: u64,
    phases: u32,
    speeds: u32,
});

impl OrbitSearch {
    /// The largest number of impacts of an orbit.
    pub const MAX_IMPACTS: usize = 64;

    /// The largest number of platform periods of an orbit.
    pub const MAX_PLATFORM_PERIODS: u64 = 10_000;

    /// The largest number of starts along each axis.
    pub const MAX_STARTS: u32 = 4_096;

    /// A search, from 96 x 96 starts, for all orbits with at most `max_impacts` impacts (in [1, 64]) in at most
    /// `max_platform_periods` periods of the platform (in [1, 10000]).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for either number.
    pub fn new(max_impacts: usize, max_platform_periods: u64) -> Result<Self, Error> {
        let search = Self { max_impacts, max_platform_periods, phases: 96, speeds: 96 };
        search.check().map(|()| search)
    }

    /// The same search with these numbers of starts along the axes of phase and speed, each in [2, 4096].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for either number.
    pub fn with_starts(self, phases: u32, speeds: u32) -> Result<Self, Error> {
        let search = Self { phases, speeds, ..self };
        search.check().map(|()| search)
    }

    /// Checks a value that was deserialised.
    fn check(&self) -> Result<(), Error> {
        within("impacts of an orbit", self.max_impacts as f64, 1.0, Self::MAX_IMPACTS as f64, "[1, 64]")?;
        let most = Self::MAX_PLATFORM_PERIODS as f64;
        within("platform periods of an orbit", self.max_platform_periods as f64, 1.0, most, "[1, 10000]")?;
        for (field, starts) in
            [("starts along the phase", self.phases), ("starts along the speed", self.speeds)]
        {
            within(field, starts.into(), 2.0, Self::MAX_STARTS.into(), "[2, 4096]")?;
        }
        Ok(())
    }

    /// The largest number of impacts of an orbit.
    #[must_use]
    pub const fn max_impacts(&self) -> usize {
        self.max_impacts
    }

    /// The largest number of platform periods of an orbit.
    #[must_use]
    pub const fn max_platform_periods(&self) -> u64 {
        self.max_platform_periods
    }

    /// Starts along the axis of the impact phase.
    #[must_use]
    pub const fn phases(&self) -> u32 {
        self.phases
    }

    /// Starts along the axis of the impact speed.
    #[must_use]
    pub const fn speeds(&self) -> u32 {
        self.speeds
    }
}

/// The coverage of a search, and the results of its starts.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct OrbitCoverage {
    /// The settings: limits and starts.
    pub search: OrbitSearch,
    /// The largest speed of a start: no impact of a periodic orbit is faster. It is
    /// [`ImpactMap::impact_speed_bound`], or less because the periods of the platform are limited (units of
    /// g/omega).
    pub impact_speed_bound: f64,
    /// The largest number of platform periods of an orbit with the largest number of impacts: if the limit of
    /// the search is not below it, the search omits no orbit because of its length.
    pub longest_platform_periods: u64,
    /// Starts, on a grid of cells over all phases and all impact speeds up to the bound.
    pub starts: u64,
    /// Starts whose orbit is proven to come to rest, or does not leave the platform, within the impacts of
    /// the longest orbit.
    pub resting_starts: u64,
    /// Initial parts of orbits tried as guesses.
    pub attempts: u64,
    /// Attempts that ended on a periodic orbit within the limits.
    pub converged: u64,
    /// Attempts that ended on a solution that is not a valid orbit: a disk at rest, no period of the
    /// platform, or more than the limit.
    pub refused: u64,
    /// Attempts whose Newton iteration did not converge.
    pub not_settled: u64,
    /// The number of orbits that are also found from only every other start along both axes: if all are, a
    /// grid of twice the spacing would have sufficed.
    pub found_by_coarser: u64,
    /// The number of orbits found by only a single attempt. Its share of `converged` estimates the share of
    /// further attempts that would find yet another orbit (Good and Turing).
    pub found_once: u64,
}

/// The periodic orbits found, and the coverage.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct OrbitsFound {
    /// Orbits of the map (no earlier impact ends a flight) that do not repeat a shorter one. They are sorted
    /// by number of impacts, then of platform periods, then by decreasing speed of their fastest impact,
    /// which comes first in each orbit.
    pub orbits: Vec<PeriodicOrbit>,
    /// The coverage.
    pub coverage: OrbitCoverage,
}

/// The results of the starts at one phase.
struct Row {
    catalogue: Catalogue,
    coverage: OrbitCoverage,
}

impl ImpactMap {
    /// The periodic orbits of few impacts, stable and unstable.
    ///
    /// Orbits of one impact come from the closed form, and their list is complete. All others are found by
    /// Newton's method on all impacts at once. The guesses are the first 1, 2, ... impacts of orbits that
    /// start on a grid over all impacts that a periodic orbit can have ([`Self::impact_speed_bound`]). The
    /// exact map decides where a flight ends, so a converged solution is an orbit of the map. A search from a
    /// grid cannot prove that it is complete: [`OrbitCoverage`] states which starts were tried, and whether
    /// half the resolution would have found the same.
    ///
    /// Two orbits whose impacts agree within 1e-6 (rad, and relative speed) count as one; near a fold or a
    /// doubling they count as one if their [errors](PeriodicOrbit::position_error) overlap.
    ///
    /// The items of `observer` are the starts.
    ///
    /// ```
    /// # use bouncing_disk_core::orbits::OrbitSearch;
    /// # use bouncing_disk_core::{ImpactMap, Unobserved, Vibration};
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.5)?, 0.5)?;
    /// let found = map.periodic_orbits(&OrbitSearch::new(2, 2)?, &Unobserved)?;
    /// // Two orbits of one impact and three of two, of which one attracts: the first orbit has doubled its period to it.
    /// let attracts = |orbit: &&bouncing_disk_core::orbits::PeriodicOrbit| orbit.multipliers().spectral_radius() < 1.0;
    /// assert_eq!(found.orbits.len(), 5);
    /// assert_eq!(found.orbits.iter().filter(attracts).map(|orbit| orbit.period()).collect::<Vec<_>>(), [2]);
    /// assert_eq!(found.coverage.found_by_coarser, 5);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// Errors of [`Vibration::first_impact`](crate::Vibration::first_impact) except [`Error::NoLiftOff`].
    pub fn periodic_orbits(
        &self,
        search: &OrbitSearch,
        observer: &dyn Observer,
    ) -> Result<OrbitsFound, Error> {
        let watch = Watch::begin(observer, 0, u64::from(search.phases) * u64::from(search.speeds))?;
        let limits = Limits::new(self, search);
        let row = |column: usize| self.search_row(search, &limits, column as u32, watch.work());
        let rows = in_parallel(search.phases as usize, row).into_iter().collect::<Result<Vec<_>, _>>()?;
        let mut catalogue = Catalogue::default();
        let mut coverage = limits.coverage(search);
        for k in 1..=search.max_platform_periods {
            let Some(pair) = self.period_one_pair(k) else { break };
            for member in [pair.node, pair.saddle] {
                if let Some(orbit) = member.orbit(self)? {
                    // The closed form does not depend on the grid.
                    catalogue.add(orbit, 2, true);
                }
            }
        }
        for row in rows {
            catalogue.merge(row.catalogue);
            let of_row = row.coverage;
            coverage.starts += of_row.starts;
            coverage.resting_starts += of_row.resting_starts;
            coverage.attempts += of_row.attempts;
            coverage.converged += of_row.converged;
            coverage.refused += of_row.refused;
            coverage.not_settled += of_row.not_settled;
        }
        coverage.found_by_coarser = catalogue.found_by_coarser();
        coverage.found_once = catalogue.found_once();
        watch.end();
        Ok(OrbitsFound { orbits: catalogue.into_sorted(), coverage })
    }

    /// Searches from the starts of one phase.
    fn search_row(
        &self,
        search: &OrbitSearch,
        limits: &Limits,
        column: u32,
        mut work: WorkCount<'_>,
    ) -> Result<Row, Error> {
        // The count restarts with each row: without this call short rows would never call the observer, and
        // after a stop each further row would run until it did.
        work.watch().ask()?;
        let mut row = Row { catalogue: Catalogue::default(), coverage: limits.coverage(search) };
        let phase = Phase::new(TAU * (f64::from(column) + 0.5) / f64::from(search.phases))?;
        for level in 0..search.speeds {
            let share = (f64::from(level) + 0.5) / f64::from(search.speeds);
            let start = ImpactState::new(phase, -share * limits.impact_speed_at(self, phase))?;
            let coarser = column.is_multiple_of(2) && level.is_multiple_of(2);
            self.search_start(search, start, coarser, &mut row, &mut work)?;
            row.coverage.starts += 1;
            work.finish(1)?;
        }
        Ok(row)
    }

    /// Uses the orbit from one start, after each of its impacts, as a guess of a periodic orbit.
    fn search_start(
        &self,
        search: &OrbitSearch,
        start: ImpactState,
        coarser: bool,
        row: &mut Row,
        work: &mut WorkCount<'_>,
    ) -> Result<(), Error> {
        let (mut states, mut turns) = (vec![start], 0);
        for impacts in 1..=search.max_impacts {
            let last = states[impacts - 1];
            let next = match self.step(last) {
                _ if self.rests_after(last) => None,
                Ok(impact) => Some(impact),
                Err(Error::NoLiftOff { .. }) => None,
                Err(error) => return Err(error),
            };
            let Some(next) = next else {
                row.coverage.resting_starts += 1;
                break;
            };
            turns += next.turns;
            // A closing guess takes the same number of turns, to within one.
            if turns > search.max_platform_periods + 1 {
                break;
            }
            row.coverage.attempts += 1;
            work.spend((impacts * MAX_STEPS) as u64)?;
            match self.attempt(&states, search.max_platform_periods) {
                Attempt::Converged(orbit) => {
                    row.coverage.converged += 1;
                    row.catalogue.add(orbit, 1, coarser);
                }
                Attempt::Refused => row.coverage.refused += 1,
                Attempt::NotSettled => row.coverage.not_settled += 1,
            }
            states.push(next.into());
        }
        Ok(())
    }
}

/// The range of the starts.
struct Limits {
    /// Bound on the disk's own speed after an impact.
    launch_speed: f64,
    /// The resulting bound on the impact speed.
    impact_speed: f64,
    longest_platform_periods: u64,
}

impl Limits {
    fn new(map: &ImpactMap, search: &OrbitSearch) -> Self {
        let p = map.vibration().peak_acceleration();
        // A disk with u^2 > P^2 + 4 P lands falling, after at least u + sqrt(u^2 - 4 P): within K periods
        // only if u <= pi K + P/(pi K).
        let longest = TAU * search.max_platform_periods as f64;
        let falling = if longest * longest > 4.0 * p { 0.5 * longest + 2.0 * p / longest } else { 0.0 };
        let within_periods = falling.max((p * (p + 4.0)).sqrt());
        let together = search.max_impacts as f64 * map.flight_duration_bound() / TAU;
        let launch_speed = map.launch_speed_bound().min(within_periods);
        Self {
            launch_speed,
            impact_speed: (launch_speed * launch_speed + 4.0 * p).sqrt() + p,
            // Saturates if it exceeds every number of periods.
            longest_platform_periods: together.floor() as u64,
        }
    }

    /// The bound on the impact speed at this phase: the disk lands at the platform's height there.
    fn impact_speed_at(&self, map: &ImpactMap, phase: Phase) -> f64 {
        let p = map.vibration().peak_acceleration();
        let landing = (self.launch_speed * self.launch_speed + 2.0 * p * (1.0 - phase.sin())).sqrt();
        (landing + p * phase.cos()).max(0.0)
    }

    /// The empty coverage.
    fn coverage(&self, search: &OrbitSearch) -> OrbitCoverage {
        OrbitCoverage {
            search: *search,
            impact_speed_bound: self.impact_speed,
            longest_platform_periods: self.longest_platform_periods,
            starts: 0,
            resting_starts: 0,
            attempts: 0,
            converged: 0,
            refused: 0,
            not_settled: 0,
            found_by_coarser: 0,
            found_once: 0,
        }
    }
}

/// An orbit of a [`Catalogue`].
#[derive(Debug, Clone)]
struct Entry {
    orbit: PeriodicOrbit,
    /// Sum of the impact velocities, which does not depend on the first impact.
    sum: f64,
    found: u64,
    by_coarser: bool,
}

/// Distinct orbits in the order of discovery.
#[derive(Debug, Clone, Default)]
pub struct Catalogue {
    entries: Vec<Entry>,
}

impl Catalogue {
    /// Adds an orbit that was found `found` times, or adds to its count if it is known.
    pub fn add(&mut self, orbit: PeriodicOrbit, found: u64, by_coarser: bool) {
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
        // The sums differ by at most twice the difference that the comparison of the impacts allows.
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

    /// The number of orbits also found from the coarser grid.
    pub(super) fn found_by_coarser(&self) -> u64 {
        self.entries.iter().filter(|entry| entry.by_coarser).count() as u64
    }

    /// The number of orbits found once.
    pub(super) fn found_once(&self) -> u64 {
        self.entries.iter().filter(|entry| entry.found == 1).count() as u64
    }

    /// The orbits by impacts, platform periods, decreasing speed of the first impact, phase of the first
    /// impact.
    pub(super) fn into_sorted(self) -> Vec<PeriodicOrbit> {
        self.into_sorted_with(Vec::new())
    }

    /// The same orbits merged with others that are not in the catalogue.
    pub fn into_sorted_with(self, mut orbits: Vec<PeriodicOrbit>) -> Vec<PeriodicOrbit> {
        orbits.extend(self.entries.into_iter().map(|entry| entry.orbit));
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

#[cfg(test)]
mod tests;
