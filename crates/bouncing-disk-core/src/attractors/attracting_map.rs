//! The trait of maps whose attractors and basins can be searched for; it extends [`BouncingMap`].

use core::f64::consts::{PI, TAU};
use core::ops::{ControlFlow, Range};

use super::basin::{
    BasinSettings, Basins, Grid, KnownOrbit, Label, MAX_CELLS, UNDECIDED, check_known, check_rows,
    flights_of_label, label_of_start,
};
use crate::chatter::policy::ChatterPolicy;
use crate::flight::platform::phase::Phase;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::{Error, room_for};
use crate::orbits::periodic::catalogue::OrbitSearch;
use crate::orbits::periodic::{PeriodicOrbit, Stability, belonging, newton, phase_difference};
use crate::run::{Observer, Watch, in_parallel};
use crate::sweep::bouncing_map::BouncingMap;
use crate::sweep::{SweepEvent, sweep};

/// Largest number of one-impact orbits tried as candidates, longest flights first.
const MOST_PERIOD_ONE: u64 = 10_000;

/// Phases at which a disk is put on a drive, to find the phases at which rests end.
const PUT_ON: u32 = 64;

/// Impacts after which a start that was seen to rest is abandoned.
const MOST_TO_REST: u32 = 1 << 16;

/// Phase difference (rad) below which two rests end at the same phase.
const SAME_END: f64 = 1.0e-9;

/// The phases at which the rests of one orbit end, until one repeats.
struct RestEnds {
    rests: bool,
    /// Impacts left to the orbit.
    left: u32,
    phases: Vec<Phase>,
    /// The smallest of the repeating phases (rad).
    cycle: Option<f64>,
}

fn same_end(one: f64, other: f64) -> bool {
    phase_difference(one, other).abs() <= SAME_END
}

impl RestEnds {
    const fn new(left: u32) -> Self {
        Self { rests: false, left, phases: Vec::new(), cycle: None }
    }

    fn see(&mut self, event: &SweepEvent) -> ControlFlow<()> {
        let end = match event {
            SweepEvent::Impact(_) if self.left == 0 => return ControlFlow::Break(()),
            SweepEvent::Impact(_) => {
                self.left -= 1;
                return ControlFlow::Continue(());
            }
            SweepEvent::Attachment(rest) => {
                (self.rests, self.left) = (true, MOST_TO_REST);
                match rest.separation {
                    Some((phase, _)) => phase,
                    None => return ControlFlow::Continue(()),
                }
            }
            SweepEvent::Separation(_) | SweepEvent::Kick(_) if !self.rests => return ControlFlow::Break(()),
            SweepEvent::Separation(change) | SweepEvent::Kick(change) => change.phase,
        };
        let first = self.phases.iter().position(|phase| same_end(phase.angle(), end.angle()));
        let Some(first) = first else {
            self.phases.push(end);
            let more = self.phases.len() < PUT_ON as usize;
            return if more { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
        };
        let smallest = self.phases[first..].iter().fold(TAU, |least, phase| least.min(phase.angle()));
        self.cycle = Some(smallest);
        ControlFlow::Break(())
    }

    /// Whether the first rests of both end at the same phase, or both end on the same cycle.
    fn is_same(&self, other: &Self) -> bool {
        let first = match (self.phases.first(), other.phases.first()) {
            (Some(one), Some(other)) => same_end(one.angle(), other.angle()),
            (one, other) => one.is_none() && other.is_none(),
        };
        first || self.cycle.zip(other.cycle).is_some_and(|(one, other)| same_end(one, other))
    }
}

/// A map whose attractors and basins are computed.
pub trait AttractingMap: BouncingMap {
    /// The work of an impact, in units of a flight above a sine; the budget of a search is divided by it.
    const WORK: u64 = 32;

    /// The speed (units of g/omega) that no impact of an attractor exceeds. For a compliant contact it is the
    /// speed of the fastest start of a search.
    fn impact_speed_bound(&self) -> f64;

    /// The speed that no impact of an attractor at this phase exceeds.
    fn impact_speed_bound_at(&self, _phase: Phase) -> f64 {
        self.impact_speed_bound()
    }

    /// Passes to `add` the orbits known in closed form that may attract, until `add` fails.
    ///
    /// # Errors
    /// Errors of `add`.
    #[doc(hidden)]
    fn closed_forms(&self, _add: &mut dyn FnMut(PeriodicOrbit) -> Result<(), Error>) -> Result<(), Error> {
        Ok(())
    }

    /// The periodic orbits that a search finds.
    ///
    /// # Errors
    /// [`Error::Stopped`] if the observer stops the search.
    #[doc(hidden)]
    fn orbits_found(
        &self,
        search: &OrbitSearch,
        observer: &dyn Observer,
    ) -> Result<Vec<PeriodicOrbit>, Error>;

    /// The periodic orbit near `guess`, with its least period.
    ///
    /// # Errors
    /// Errors of [`BouncingMap::refine`].
    #[doc(hidden)]
    fn prime_orbit(&self, guess: &[ImpactState]) -> Result<PeriodicOrbit, Error> {
        newton::prime_orbit(guess, |guess| self.refine(guess), PeriodicOrbit::determinant)
    }

    /// Starts that come to rest, from those seen and from a disk placed on the platform: one for each phase
    /// at which the first rest ends, and one for each cycle of rests.
    ///
    /// # Errors
    /// Errors of a flight.
    #[doc(hidden)]
    fn to_rests(&self, seen: &[ImpactState], observer: &dyn Observer) -> Result<Vec<ImpactState>, Error> {
        let put_on = (0..PUT_ON).map(|k| {
            let phase = Phase::of_angle(TAU * (f64::from(k) + 0.5) / f64::from(PUT_ON));
            ImpactState::of_impact(phase, 0.0)
        });
        let starts: Vec<_> = put_on.chain(seen.iter().copied()).collect();
        let orbits: Vec<_> = starts.iter().map(|start| self.orbit(*start, ChatterPolicy::Complete)).collect();
        let ends = sweep(
            &orbits,
            // A disk that leaves as soon as it is placed has not rested.
            |index| RestEnds::new(if index < PUT_ON as usize { 0 } else { MOST_TO_REST }),
            RestEnds::see,
            observer,
        )?;
        let mut found: Vec<(RestEnds, ImpactState)> = Vec::new();
        for (start, ends) in starts.into_iter().zip(ends) {
            if ends.rests && !found.iter().any(|(known, _)| known.is_same(&ends)) {
                found.push((ends, start));
            }
        }
        Ok(found.into_iter().map(|(_, start)| start).collect())
    }

    /// Checks that `orbit` is an orbit of this map: that each of its impacts leads to the next one.
    ///
    /// # Errors
    /// [`Error::NotAnOrbit`] and other errors of [`ImpactMap::check_orbit`].
    fn check_orbit(&self, orbit: &PeriodicOrbit) -> Result<(), Error> {
        belonging::check(orbit, |state| self.step(state), |state| self.step_with_derivative(state))
    }

    /// Checks that `orbit` is a stable orbit of this map.
    ///
    /// # Errors
    /// Errors of [`Self::check_orbit`]; [`Error::NotAttracting`].
    fn check_attracting(&self, orbit: &PeriodicOrbit) -> Result<(), Error> {
        self.check_orbit(orbit)?;
        if orbit.stability() != Stability::Stable {
            let spectral_radius = orbit.multipliers().spectral_radius();
            return Err(Error::NotAttracting { spectral_radius, trace_error: orbit.trace_error });
        }
        Ok(())
    }

    /// A radius (rad) around each impact of `orbit` within which every start provably ends on the orbit.
    ///
    /// # Errors
    /// Errors of [`Self::check_attracting`]; [`Error::NothingProven`] if no region can be proven.
    fn proven_radius(&self, orbit: &PeriodicOrbit) -> Result<f64, Error> {
        self.check_attracting(orbit)?;
        Err(Error::NothingProven { region: 0.0 })
    }

    /// The labels of all cells of a grid, [`UNDECIDED`] outside `rows`, which are the items of the observer.
    ///
    /// # Errors
    /// Errors of [`Self::basins_of_rows`].
    fn labels_of_rows(
        &self,
        grid: Grid,
        rows: Range<usize>,
        known: &[KnownOrbit],
        settings: BasinSettings,
        observer: &dyn Observer,
    ) -> Result<Vec<Label>, Error> {
        check_known(known, |orbit| self.check_orbit(orbit))?;
        check_rows(grid, &rows)?;
        let (columns, height) = (grid.phase().cells(), grid.speed().cells());
        drop(room_for::<Label>("cells of a grid", columns as u64 * height as u64, MAX_CELLS)?);
        let mut labels = vec![UNDECIDED; columns * height];
        let watch = Watch::begin(observer, 0, rows.len() as u64)?;
        let found = in_parallel(rows.len(), |row| {
            let (mut work, flights) = (watch.work(), flights_of_label(known));
            let speed = grid.speed().centre(rows.start + row);
            let row = (0..columns).map(|column| {
                watch.ask()?;
                let start = ImpactState::from_normalised(grid.impact_angle(column), speed)?;
                label_of_start(self, start, known, settings, || work.spend(flights))
            });
            let row = row.collect::<Result<Vec<_>, Error>>();
            watch.finish(1);
            row
        });
        for (row, found) in rows.zip(found) {
            labels[row * columns..][..columns].copy_from_slice(&found?);
        }
        watch.end();
        Ok(labels)
    }

    /// The basins on a grid: each start comes to rest, or belongs to the known orbit whose radius its impacts
    /// enter first (a radian counts as much as the [speed scale](BouncingMap::speed_scale)).
    ///
    /// The items of `observer` are the rows.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for more than 250 known orbits; [`Error::NotAnOrbit`] for an orbit of another
    /// map; [`Error::TooLarge`] for a grid of more than [`MAX_CELLS`] cells or too large for the memory;
    /// errors of a flight.
    fn basins(
        &self,
        grid: Grid,
        known: &[KnownOrbit],
        settings: BasinSettings,
        observer: &dyn Observer,
    ) -> Result<Basins, Error> {
        self.basins_of_rows(grid, 0..grid.speed().cells(), known, settings, observer)
    }

    /// [`Self::basins`] of some rows of the grid.
    ///
    /// # Errors
    /// [`Error::Unfitting`] for rows outside the grid, or no rows; errors of [`Self::basins`].
    fn basins_of_rows(
        &self,
        grid: Grid,
        rows: Range<usize>,
        known: &[KnownOrbit],
        settings: BasinSettings,
        observer: &dyn Observer,
    ) -> Result<Basins, Error> {
        check_rows(grid, &rows)?;
        let columns = grid.phase().cells();
        let mut labels = self.labels_of_rows(grid, rows.clone(), known, settings, observer)?;
        labels.truncate(rows.end * columns);
        labels.drain(..rows.start * columns);
        Basins::of_labels(labels, columns)
    }
}

impl AttractingMap for ImpactMap {
    const WORK: u64 = 1;

    fn impact_speed_bound(&self) -> f64 {
        self.impact_speed_bound()
    }

    fn impact_speed_bound_at(&self, phase: Phase) -> f64 {
        self.impact_speed_bound_at(phase)
    }

    /// The one-impact nodes.
    fn closed_forms(&self, add: &mut dyn FnMut(PeriodicOrbit) -> Result<(), Error>) -> Result<(), Error> {
        let (r, forcing) = (self.restitution(), self.vibration().axial_forcing());
        // A node attracts from its birth to its doubling: this holds for the longest flights, down to a
        // certain number of periods.
        let longest = ((1.0 + r) * forcing / (1.0 - r)) as u64;
        let longest = longest.saturating_add(1);
        for k in (longest.saturating_sub(MOST_PERIOD_ONE).max(1)..=longest).rev() {
            let Some(pair) = self.period_one_pair(k) else { continue };
            let Some(orbit) = pair.node.orbit(self)? else { continue };
            // All orbits with shorter flights have also doubled.
            if orbit.stability() == Stability::Unstable {
                break;
            }
            add(orbit)?;
        }
        Ok(())
    }

    fn orbits_found(
        &self,
        search: &OrbitSearch,
        observer: &dyn Observer,
    ) -> Result<Vec<PeriodicOrbit>, Error> {
        Ok(self.periodic_orbits(search, observer)?.orbits)
    }

    fn prime_orbit(&self, guess: &[ImpactState]) -> Result<PeriodicOrbit, Error> {
        self.prime_orbit(guess)
    }

    /// One start, at the lowest point of the platform: all rests end at the same phase.
    fn to_rests(&self, _seen: &[ImpactState], _observer: &dyn Observer) -> Result<Vec<ImpactState>, Error> {
        Ok(vec![ImpactState::of_impact(Phase::new(1.5 * PI)?, 0.0)])
    }

    fn proven_radius(&self, orbit: &PeriodicOrbit) -> Result<f64, Error> {
        orbit.proven_radius(self)
    }

    /// Labels rows in lockstep lanes.
    fn labels_of_rows(
        &self,
        grid: Grid,
        rows: Range<usize>,
        known: &[KnownOrbit],
        settings: BasinSettings,
        observer: &dyn Observer,
    ) -> Result<Vec<Label>, Error> {
        self.labels_of_rows(grid, rows, known, settings, observer)
    }
}
