//! Basins of attraction on drives.

use core::f64::consts::PI;
use core::ops::Range;

use super::basin::{
    ATTACHED, BasinSettings, Basins, Grid, KnownOrbit, Label, MAX_CELLS, UNDECIDED, caught, check_known,
};
use crate::flight::platform::phase::Phase;
use crate::map::driven_map::DrivenMap;
use crate::map::impact_map::{ImpactState, OrbitEvent};
use crate::numerics::error::Error;
use crate::run::{Observer, Watch, in_parallel};

impl DrivenMap {
    /// The labels of all starts of a grid: at rest, or the known orbit within whose radius an impact is the
    /// first to be (a radian counts as much as the largest speed of the platform).
    ///
    /// The items of `observer` are the rows.
    ///
    /// # Errors
    /// [`Error::TooLarge`] beyond [`MAX_CELLS`]; [`Error::OutOfRange`] for more than 250 known orbits;
    /// [`Error::NotAnOrbit`] for one of another map; the first error of an orbit; [`Error::Stopped`].
    pub fn basins(
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
    /// [`Error::Unfitting`] for rows outside the grid; those of [`Self::basins`].
    pub fn basins_of_rows(
        &self,
        grid: Grid,
        rows: Range<usize>,
        known: &[KnownOrbit],
        settings: BasinSettings,
        observer: &dyn Observer,
    ) -> Result<Basins, Error> {
        check_known(known, |orbit| self.check_orbit(orbit))?;
        let (columns, expected) = (grid.phase().cells(), grid.speed().cells() as u64);
        if rows.end as u64 > expected {
            let what = "end of the rows of a grid";
            return Err(Error::Unfitting { what, found: rows.end as u64, expected });
        }
        let count = columns as u64 * rows.len() as u64;
        if count > MAX_CELLS {
            return Err(Error::TooLarge { what: "cells of basins", count, limit: MAX_CELLS });
        }
        let watch = Watch::begin(observer, 0, rows.len() as u64)?;
        let labels = in_parallel(rows.len(), |row| {
            let labels = (0..columns).map(|column| {
                watch.ask()?;
                let phase = Phase::new(grid.impact_angle(column))?;
                let start = ImpactState::new(phase, -PI * grid.speed().centre(rows.start + row))?;
                self.label(start, known, settings)
            });
            let labels = labels.collect::<Result<Vec<_>, Error>>();
            watch.finish(1);
            labels
        });
        let labels = labels.into_iter().collect::<Result<Vec<_>, _>>()?.concat();
        watch.end();
        Basins::of_labels(labels, columns)
    }

    fn label(
        &self,
        start: ImpactState,
        known: &[KnownOrbit],
        settings: BasinSettings,
    ) -> Result<Label, Error> {
        let speed = self.drive().bounds().speed;
        let mut impacts = 0;
        for event in self.orbit(start, settings.policy) {
            match event? {
                OrbitEvent::Impact(landing) => {
                    if let Some(label) = caught(known, landing.into(), speed) {
                        return Ok(label);
                    }
                    impacts += 1;
                    if impacts >= settings.max_impacts {
                        return Ok(UNDECIDED);
                    }
                }
                OrbitEvent::Attachment(_) => return Ok(ATTACHED),
                OrbitEvent::Separation(_) | OrbitEvent::Kick(_) => {}
            }
        }
        Ok(ATTACHED)
    }
}
