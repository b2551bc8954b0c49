//! Basins of the attractors found by a search.

use core::ops::{ControlFlow, Range};

use super::cells::VisitedCells;
use super::follow::SHARE_IN_CELLS;
use super::{Attractors, label_of};
use crate::attractors::attracting_map::AttractingMap;
use crate::attractors::basin::{
    ATTACHED, BasinSettings, Basins, Grid, KnownOrbit, Label, UNDECIDED, check_rows, settles,
};
use crate::map::impact_map::ImpactState;
use crate::numerics::error::Error;
use crate::run::{Observer, Progress, Unobserved};
use crate::sweep::{SweepEvent, sweep};

/// Further impacts of an undecided start, after the allowed ones, that are compared with the cells of
/// aperiodic attractors.
const COMPARED: u32 = 256;

/// Starts that are followed at a time, to limit the memory.
const AT_ONCE: usize = 1 << 14;

/// The tests that label a start.
struct Labels<'a, M> {
    map: &'a M,
    known: Vec<KnownOrbit>,
    cells: Vec<(Label, &'a VisitedCells)>,
    settings: BasinSettings,
}

/// A start on its way to its label.
struct OnItsWay {
    impacts: u32,
    /// Impacts in the cells of each attractor known by its cells.
    hits: Vec<u32>,
    label: Option<Label>,
}

impl<'a, M: AttractingMap> Labels<'a, M> {
    fn new(attractors: &'a Attractors<M>, settings: BasinSettings) -> Self {
        let recurrences = attractors.recurrences();
        Self {
            map: &attractors.map,
            known: attractors.known().cloned().collect(),
            cells: recurrences.map(|(number, own)| (label_of(number), &own.cells)).collect(),
            settings,
        }
    }

    /// Impacts after which a start is abandoned.
    fn allowed(&self) -> u32 {
        let compared = if self.cells.is_empty() { 0 } else { COMPARED };
        self.settings.max_impacts.saturating_add(compared)
    }

    fn see(&self, own: &mut OnItsWay, event: &SweepEvent) -> ControlFlow<()> {
        let SweepEvent::Impact(impact) = event else {
            own.label = Some(ATTACHED);
            return ControlFlow::Break(());
        };
        own.impacts += 1;
        own.label = settles(self.map, impact.state, &self.known, self.settings.policy);
        if own.label.is_some() {
            return ControlFlow::Break(());
        }
        if own.impacts > self.settings.max_impacts {
            for (hits, (_, cells)) in own.hits.iter_mut().zip(&self.cells) {
                *hits += u32::from(cells.contains(impact.state));
            }
        }
        if own.impacts >= self.allowed() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// The label of a start that has been followed: the attractor whose cells contain most of the last
    /// impacts, if at least half of them.
    fn label(&self, own: &OnItsWay) -> Label {
        if let Some(label) = own.label {
            return label;
        }
        let enough = (SHARE_IN_CELLS * f64::from(COMPARED)) as u32;
        let counted = own.hits.iter().zip(&self.cells).filter(|(hits, _)| **hits >= enough);
        let most = counted.fold(
            (0, UNDECIDED),
            |most, (hits, (label, _))| {
                if *hits > most.0 { (*hits, *label) } else { most }
            },
        );
        most.1
    }

    /// The labels of the starts, in order.
    fn of(&self, starts: &[ImpactState], observer: &dyn Observer) -> Result<Vec<Label>, Error> {
        let mut labels = Vec::with_capacity(starts.len());
        let mut open = Vec::new();
        for start in starts {
            match settles(self.map, *start, &self.known, self.settings.policy) {
                Some(label) => labels.push(label),
                None => {
                    open.push(labels.len());
                    labels.push(UNDECIDED);
                }
            }
        }
        if self.allowed() == 0 {
            return Ok(labels);
        }
        let orbits: Vec<_> =
            open.iter().map(|index| self.map.orbit(starts[*index], self.settings.policy)).collect();
        let followed = sweep(
            &orbits,
            |_| OnItsWay { impacts: 0, hits: vec![0; self.cells.len()], label: None },
            |own, event| self.see(own, event),
            observer,
        )?;
        for (index, own) in open.into_iter().zip(&followed) {
            // An orbit that ends without an event has never left the platform.
            let left = own.label.is_none() && own.impacts < self.allowed();
            labels[index] = if left { ATTACHED } else { self.label(own) };
        }
        Ok(labels)
    }

    /// Labels the cells of a grid with these indices.
    fn label_cells(
        &self,
        grid: &Grid,
        labels: &mut [Label],
        open: &[usize],
        rows: &Rows<'_>,
    ) -> Result<(), Error> {
        let columns = grid.phase().cells();
        for part in open.chunks(AT_ONCE) {
            let starts = part.iter().map(|index| start_of(grid, index / columns, index % columns));
            let starts = starts.collect::<Result<Vec<_>, _>>()?;
            let found = self.of(&starts, rows).map_err(|error| match error {
                Error::Stopped { .. } => Error::Stopped { done: rows.done, total: rows.total },
                other => other,
            })?;
            for (index, label) in part.iter().zip(found) {
                labels[*index] = label;
            }
        }
        Ok(())
    }
}

/// The start of a cell.
fn start_of(grid: &Grid, row: usize, column: usize) -> Result<ImpactState, Error> {
    ImpactState::from_normalised(grid.impact_angle(column), grid.speed().centre(row))
}

/// Reports the progress of a part to the observer of all rows, added to the finished rows.
struct Rows<'o> {
    observer: &'o dyn Observer,
    done: u64,
    total: u64,
}

impl Observer for Rows<'_> {
    fn observe(&self, _: Progress) -> ControlFlow<()> {
        self.observer.observe(Progress { done: self.done, total: self.total })
    }
}

impl<M: AttractingMap> Attractors<M> {
    /// The label of one start: the label of its attractor ([`Self::label`]), or [`UNDECIDED`].
    ///
    /// Rests and periodic attractors are recognised as by
    /// [`ImpactMap::basin_label`](crate::ImpactMap::basin_label). A start that is undecided after
    /// [`BasinSettings::max_impacts`] is compared with the attractors known by their cells: it is followed
    /// for 256 more impacts, at least half of which must lie in the cells of one attractor.
    ///
    /// # Errors
    /// Errors of [`ImpactMap::basin_label`](crate::ImpactMap::basin_label).
    pub fn basin_label(&self, start: ImpactState, settings: BasinSettings) -> Result<Label, Error> {
        let labels = Labels::new(self, settings).of(&[start], &Unobserved)?;
        Ok(labels.first().copied().unwrap_or(UNDECIDED))
    }

    /// The basins on a grid, each cell with its [`Self::basin_label`]. A label depends only on its start, not
    /// on the window or the number of threads.
    ///
    /// The items of `observer` are the rows, each of which counts twice if there are attractors known by
    /// their cells.
    ///
    /// ```
    /// use bouncing_disk_core::attractors::{AttractorSearch, Axis, BasinSettings, FIRST_ORBIT, Grid};
    /// use bouncing_disk_core::{ImpactMap, Unobserved, Vibration};
    ///
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.45)?, 0.5)?;
    /// let found = map.attractors(&AttractorSearch::default(), &Unobserved)?;
    /// let grid = Grid::new(Axis::new(0.0, 1.0, 60)?, Axis::new(0.0, 3.0, 60)?)?;
    /// let basins = found.basins(grid, BasinSettings::default(), &Unobserved)?;
    /// let (low, high) = basins.share(FIRST_ORBIT).interval();
    /// assert!(low > 0.1 && high < 0.5);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// Errors of [`ImpactMap::basins`](crate::ImpactMap::basins).
    pub fn basins(
        &self,
        grid: Grid,
        settings: BasinSettings,
        observer: &dyn Observer,
    ) -> Result<Basins, Error> {
        let labelling = Labels::new(self, settings);
        let rows = grid.speed().cells() as u64;
        if labelling.cells.is_empty() {
            return self.map.basins(grid, &labelling.known, settings, observer);
        }
        let whole = |progress: Progress| observer.observe(Progress { total: 2 * rows, ..progress });
        let labels =
            self.map.labels_of_rows(grid, 0..grid.speed().cells(), &labelling.known, settings, &whole);
        let mut labels = labels.map_err(|error| match error {
            Error::Stopped { done, .. } => Error::Stopped { done, total: 2 * rows },
            other => other,
        })?;
        let open = (0..labels.len()).filter(|index| labels[*index] == UNDECIDED).collect::<Vec<_>>();
        let second = Rows { observer, done: rows, total: 2 * rows };
        labelling.label_cells(&grid, &mut labels, &open, &second)?;
        // The answer does not matter: nothing is left to stop.
        let _ = observer.observe(Progress { done: 2 * rows, total: 2 * rows });
        Basins::of_labels(labels, grid.phase().cells())
    }

    /// A block of rows of [`Self::basins`], with identical labels. A long computation can run in blocks of
    /// rows, on one machine or many; [`Basins::stacked`] joins them.
    ///
    /// The items of `observer` are these rows, each of which counts twice if there are attractors known by
    /// their cells.
    ///
    /// ```
    /// # use bouncing_disk_core::attractors::{AttractorSearch, Axis, BasinSettings, Basins, Grid};
    /// # use bouncing_disk_core::{ImpactMap, Unobserved, Vibration};
    /// let map = ImpactMap::new(Vibration::from_axial_forcing(0.55)?, 0.5)?;
    /// let found = map.attractors(&AttractorSearch::default(), &Unobserved)?;
    /// let (grid, settings) = (Grid::new(Axis::new(0.0, 1.0, 20)?, Axis::new(0.0, 3.0, 20)?)?, BasinSettings::default());
    /// let parts = [found.basins_of_rows(grid, 0..7, settings, &Unobserved)?, found.basins_of_rows(grid, 7..20, settings, &Unobserved)?];
    /// assert_eq!(Basins::stacked(parts)?, found.basins(grid, settings, &Unobserved)?);
    /// # Ok::<(), bouncing_disk_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Unfitting`] for rows outside the grid, or no rows; errors of [`Self::basins`].
    pub fn basins_of_rows(
        &self,
        grid: Grid,
        rows: Range<usize>,
        settings: BasinSettings,
        observer: &dyn Observer,
    ) -> Result<Basins, Error> {
        check_rows(grid, &rows)?;
        let width = grid.phase().cells();
        let labelling = Labels::new(self, settings);
        let count = rows.len() as u64;
        let recurrent = !labelling.cells.is_empty();
        // Each row counts twice if undecided starts are compared with cells.
        let total = if recurrent { 2 * count } else { count };
        let own = |progress: Progress| observer.observe(Progress { total, ..progress });
        let labels = self.map.labels_of_rows(grid, rows.clone(), &labelling.known, settings, &own);
        let mut labels = labels.map_err(|error| match error {
            Error::Stopped { done, .. } => Error::Stopped { done, total },
            other => other,
        })?;
        let cells = rows.start * width..rows.end * width;
        if recurrent {
            let open: Vec<_> = cells.clone().filter(|index| labels[*index] == UNDECIDED).collect();
            labelling.label_cells(&grid, &mut labels, &open, &Rows { observer, done: count, total })?;
            // The answer does not matter: nothing is left to stop.
            let _ = observer.observe(Progress { done: total, total });
        }
        labels.truncate(cells.end);
        labels.drain(..cells.start);
        Basins::of_labels(labels, width)
    }
}
