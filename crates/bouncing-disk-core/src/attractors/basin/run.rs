//! Basin computations that may be stopped, stored and resumed.

#[cfg(feature = "serde")]
mod stored;

use super::starts::Cells;
use super::{BasinSettings, Basins, Grid, KnownOrbit, Label, MAX_CELLS, UNDECIDED, check_known};
use crate::map::impact_map::ImpactMap;
use crate::numerics::error::{Error, room_for};
use crate::run::{Observer, Watch, in_parallel, threads};

/// A computation of basins on a grid: its input, and the rows that are finished.
///
/// A run that is stopped, written, read and resumed gives the labels of one uninterrupted call, bit for
/// bit, for any number of threads. It stores the map, the grid, the known orbits, the settings and the
/// labels of the finished rows; deserialising checks that they fit together.
///
/// It knows periodic attractors only; where there are others, `Attractors::basins_of_rows` makes a grid in
/// parts. Read from JSON it is the same if `serde_json` has its feature `float_roundtrip`.
///
/// [`Observer`] shows an example.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "stored::StoredRun", into = "stored::StoredRun"))]
pub struct BasinRun {
    map: ImpactMap,
    grid: Grid,
    known: Vec<KnownOrbit>,
    settings: BasinSettings,
    /// Labels of all cells; [`UNDECIDED`] in rows that are not finished.
    labels: Vec<Label>,
    /// Which rows are finished.
    finished: Vec<bool>,
}

impl BasinRun {
    /// A run with no row finished.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for more than 250 known orbits; [`Error::NotAnOrbit`] for one of another map;
    /// [`Error::TooLarge`] for a grid of more than [`MAX_CELLS`] cells or than there is memory for.
    pub fn new(
        map: ImpactMap,
        grid: Grid,
        known: &[KnownOrbit],
        settings: BasinSettings,
    ) -> Result<Self, Error> {
        check_known(known, |orbit| map.check_orbit(orbit))?;
        let (columns, rows) = (grid.phase().cells(), grid.speed().cells());
        // The system provides these zeros at once; writing those of a large grid would take seconds without a
        // call of the observer. The first line checks that there is room for them.
        drop(room_for::<Label>("cells of a grid", columns as u64 * rows as u64, MAX_CELLS)?);
        let labels = vec![UNDECIDED; columns * rows];
        Ok(Self { map, grid, known: known.to_vec(), settings, labels, finished: vec![false; rows] })
    }

    /// Labels the rows that are not finished. Finished rows stay, also when this call returns an error. The
    /// items of the observer are rows; each thread works on some thousand cells, which the next
    /// call restarts.
    ///
    /// # Errors
    /// [`Error::Stopped`] if the observer breaks; those of [`crate::Vibration::first_impact`].
    pub fn advance(&mut self, observer: &dyn Observer) -> Result<(), Error> {
        let watch = Watch::begin(observer, self.done(), self.total())?;
        let outcome = self.label_rows(&watch);
        let rows = self.labels.chunks_exact_mut(self.grid.phase().cells());
        for (row, _) in rows.zip(&self.finished).filter(|(_, finished)| !**finished) {
            // Rows that were not begun are left alone: writing all of a large grid takes as long.
            if row.iter().any(|label| *label != UNDECIDED) {
                row.fill(UNDECIDED);
            }
        }
        match outcome {
            // After one thread got the order to stop, others may have finished further rows, or even all.
            Err(Error::Stopped { .. }) if !self.is_done() => {
                Err(Error::Stopped { done: self.done(), total: self.total() })
            }
            Ok(()) | Err(Error::Stopped { .. }) => {
                watch.end();
                Ok(())
            }
            Err(error) => Err(error),
        }
    }

    /// [`Self::advance`] for the rows of this range alone, as far as they exist: a part of a grid that is
    /// divided over several machines. For the observer, all other rows count as finished.
    ///
    /// # Errors
    /// Those of [`Self::advance`].
    pub fn advance_rows(
        &mut self,
        rows: core::ops::Range<usize>,
        observer: &dyn Observer,
    ) -> Result<(), Error> {
        let elsewhere = |(row, finished): (usize, &bool)| (!finished && !rows.contains(&row)).then_some(row);
        let elsewhere: Vec<usize> = self.finished.iter().enumerate().filter_map(elsewhere).collect();
        for row in &elsewhere {
            self.finished[*row] = true;
        }
        let outcome = self.advance(observer);
        for row in elsewhere {
            self.finished[row] = false;
        }
        outcome
    }

    fn label_rows(&mut self, watch: &Watch<'_>) -> Result<(), Error> {
        let threads = threads();
        let cells = Cells::new(self.grid, &mut self.labels, &mut self.finished, threads, watch)?;
        let lanes = cells.count().div_ceil(threads);
        let (map, known, settings) = (&self.map, &self.known, self.settings);
        let work = || map.label_cells(&cells, known, settings, lanes).inspect_err(|_| cells.give_up());
        in_parallel(threads, |_| work()).into_iter().collect()
    }

    /// The map.
    #[must_use]
    pub const fn map(&self) -> &ImpactMap {
        &self.map
    }

    /// The grid.
    #[must_use]
    pub const fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The known orbits.
    #[must_use]
    pub fn known(&self) -> &[KnownOrbit] {
        &self.known
    }

    /// The settings.
    #[must_use]
    pub const fn settings(&self) -> BasinSettings {
        self.settings
    }

    /// The labels of a row, by phase; `None` if it is not finished or does not exist.
    #[must_use]
    pub fn row(&self, index: usize) -> Option<&[Label]> {
        let finished = self.finished.get(index).is_some_and(|finished| *finished);
        finished.then(|| self.labels.chunks_exact(self.grid.phase().cells()).nth(index)).flatten()
    }

    /// Number of finished rows.
    #[must_use]
    pub fn done(&self) -> u64 {
        self.finished.iter().filter(|finished| **finished).count() as u64
    }

    /// Number of rows.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.finished.len() as u64
    }

    /// Whether all rows are finished.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.done() == self.total()
    }

    /// The basins.
    ///
    /// # Errors
    /// [`Error::Stopped`] if a row is not finished, which [`Self::is_done`] shows.
    pub fn into_basins(self) -> Result<Basins, Error> {
        if !self.is_done() {
            return Err(Error::Stopped { done: self.done(), total: self.total() });
        }
        Ok(Basins { columns: self.grid.phase().cells(), labels: self.labels })
    }

    /// The labels of all cells, [`UNDECIDED`] in rows that are not finished.
    pub(crate) fn into_labels(self) -> Vec<Label> {
        self.labels
    }
}

#[cfg(test)]
mod tests;
