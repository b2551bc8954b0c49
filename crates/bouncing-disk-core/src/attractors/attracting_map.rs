//! What the search for final motions needs of a map beyond [`BouncingMap`].

use core::ops::Range;

use super::basin::{
    ATTACHED, BasinSettings, Basins, Grid, KnownOrbit, Label, MAX_CELLS, UNDECIDED, caught, check_known,
    check_rows, flights_of_label,
};
use crate::chatter::policy::ChatterPolicy;
use crate::map::driven_map::DrivenMap;
use crate::map::impact_map::{ImpactMap, ImpactState};
use crate::numerics::error::{Error, room_for};
use crate::orbits::periodic::belonging;
use crate::orbits::periodic::{PeriodicOrbit, Stability};
use crate::run::{Observer, Watch, in_parallel};
use crate::sweep::SweepEvent;
use crate::sweep::bouncing_map::{BouncingMap, BouncingOrbit as _};

/// A map whose basins of attraction are computed.
pub trait AttractingMap: BouncingMap {
    /// Checks that `orbit` is an orbit of this map: that each of its impacts leads to the next one.
    ///
    /// # Errors
    /// [`Error::NotAnOrbit`] and the others of [`ImpactMap::check_orbit`].
    fn check_orbit(&self, orbit: &PeriodicOrbit) -> Result<(), Error> {
        belonging::check(orbit, |state| self.step(state), |state| self.step_with_derivative(state))
    }

    /// Refuses an orbit of another map, and one that is not stable.
    ///
    /// # Errors
    /// Those of [`Self::check_orbit`]; [`Error::NotAttracting`].
    fn check_attracting(&self, orbit: &PeriodicOrbit) -> Result<(), Error> {
        self.check_orbit(orbit)?;
        if orbit.stability() != Stability::Stable {
            let spectral_radius = orbit.multipliers().spectral_radius();
            return Err(Error::NotAttracting { spectral_radius, trace_error: orbit.trace_error });
        }
        Ok(())
    }

    /// A radius (rad): every start within it of an impact of `orbit` is proven to end on the orbit.
    ///
    /// # Errors
    /// Those of [`Self::check_attracting`]; [`Error::NothingProven`] where no region is.
    fn proven_radius(&self, orbit: &PeriodicOrbit) -> Result<f64, Error> {
        self.check_attracting(orbit)?;
        Err(Error::NothingProven { region: 0.0 })
    }

    /// The label that an impact in `state` decides: near a known orbit, or (complete policy) certain to
    /// chatter to rest.
    fn settles(&self, state: ImpactState, known: &[KnownOrbit], policy: ChatterPolicy) -> Option<Label> {
        let rests = || policy == ChatterPolicy::Complete && self.chatters_to_rest_after(state);
        caught(known, state, self.speed_scale()).or_else(|| rests().then_some(ATTACHED))
    }

    /// The label of a start; `follow` is called before each flight.
    ///
    /// # Errors
    /// Those of a flight and of `follow`.
    fn label_of(
        &self,
        start: ImpactState,
        known: &[KnownOrbit],
        settings: BasinSettings,
        mut follow: impl FnMut() -> Result<(), Error>,
    ) -> Result<Label, Error> {
        if let Some(label) = self.settles(start, known, settings.policy) {
            return Ok(label);
        }
        let mut orbit = self.orbit(start, settings.policy);
        for _ in 0..settings.max_impacts {
            follow()?;
            match orbit.next_event()? {
                Some(SweepEvent::Impact(impact)) => {
                    if let Some(label) = self.settles(impact.state, known, settings.policy) {
                        return Ok(label);
                    }
                }
                Some(_) | None => return Ok(ATTACHED),
            }
        }
        Ok(UNDECIDED)
    }

    /// The labels of all cells of a grid, [`UNDECIDED`] outside of these rows, which are the items of the
    /// observer.
    ///
    /// # Errors
    /// Those of [`Self::basins_of_rows`].
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
                self.label_of(start, known, settings, || work.spend(flights))
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

    /// The basins on a grid: at rest, or the known orbit within whose radius an impact is the first to be (a radian
    /// counts as much as the [speed scale](BouncingMap::speed_scale)).
    ///
    /// The items of `observer` are the rows.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for more than 250 known orbits; [`Error::NotAnOrbit`] for one of another map;
    /// [`Error::TooLarge`] for a grid of more than [`MAX_CELLS`] cells or than there is memory for; those of a flight.
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
    /// [`Error::Unfitting`] for rows outside the grid, or no rows; the others as for [`Self::basins`].
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
    fn proven_radius(&self, orbit: &PeriodicOrbit) -> Result<f64, Error> {
        orbit.proven_radius(self)
    }

    /// In lanes.
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

impl AttractingMap for DrivenMap {}
