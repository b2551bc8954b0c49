//! The labels of the cells of a grid.

use core::ops::Range;

use super::starts::Cells;
use super::{BasinSettings, Grid, KnownOrbit, Label, MAX_CELLS, UNDECIDED, check_known};
use crate::map::impact_map::ImpactMap;
use crate::numerics::error::{Error, room_for};
use crate::run::{Observer, Watch, in_parallel, threads};

impl ImpactMap {
    /// The labels of all cells of a grid, [`UNDECIDED`] outside `rows`, which are the items of the observer.
    ///
    /// # Errors
    /// Errors of [`Self::basins`].
    pub(crate) fn labels_of_rows(
        &self,
        grid: Grid,
        rows: Range<usize>,
        known: &[KnownOrbit],
        settings: BasinSettings,
        observer: &dyn Observer,
    ) -> Result<Vec<Label>, Error> {
        check_known(known, |orbit| self.check_orbit(orbit))?;
        let (columns, height) = (grid.phase().cells(), grid.speed().cells());
        // The system provides these zeros at once; writing the zeros of a large grid would take seconds
        // without a call of the observer. The first line checks that there is enough memory.
        drop(room_for::<Label>("cells of a grid", columns as u64 * height as u64, MAX_CELLS)?);
        let mut labels = vec![UNDECIDED; columns * height];
        let mut finished: Vec<bool> = (0..height).map(|row| !rows.contains(&row)).collect();
        let open = |finished: &[bool]| finished.iter().filter(|finished| !**finished).count() as u64;
        let total = open(&finished);
        let watch = Watch::begin(observer, 0, total)?;
        let threads = threads();
        let cells = Cells::new(grid, &mut labels, &mut finished, threads, &watch)?;
        let lanes = cells.count().div_ceil(threads);
        let work = || self.label_cells(&cells, known, settings, lanes).inspect_err(|_| cells.give_up());
        let outcome: Result<(), Error> = in_parallel(threads, |_| work()).into_iter().collect();
        drop(cells);
        let left = open(&finished);
        match outcome {
            Err(Error::Stopped { .. }) if left > 0 => Err(Error::Stopped { done: total - left, total }),
            // After one thread was told to stop, others may have finished all rows.
            Ok(()) | Err(Error::Stopped { .. }) => {
                watch.end();
                Ok(labels)
            }
            Err(error) => Err(error),
        }
    }
}

#[cfg(test)]
mod tests;
