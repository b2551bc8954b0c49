//! The cells of a grid, distributed in shares to the threads, and start by start to their lanes.

use std::sync::{Mutex, PoisonError};

use super::screen::{Judge, LabelMasks};
use super::{Grid, Label};
use crate::flight::platform::phase::Phase;
use crate::numerics::error::Error;
use crate::run::{Watch, WorkCount};
use crate::sweep::lockstep::lanes::{Batch, LANES, Lanes};

use core::f64::consts::PI;

/// Largest number of cells in a share, except for longer rows: enough that a thread seldom waits for the next
/// share, few enough for the threads to finish together.
const SHARE: usize = 1_024;

/// A block of rows of the grid: the first row, and the labels.
pub(super) struct Share<'l> {
    pub(super) first_row: usize,
    pub(super) labels: &'l mut [Label],
}

/// The cells of a grid in unfinished rows, whose labels are written share by share.
pub(super) struct Cells<'l> {
    pub(super) phases: Vec<Phase>,
    /// Impact speeds of the rows.
    pub(super) speeds: Vec<f64>,
    shares: Mutex<std::vec::IntoIter<Share<'l>>>,
    finished: Mutex<&'l mut [bool]>,
    count: usize,
    pub(super) watch: &'l Watch<'l>,
}

/// The unfinished rows, in shares of neighbouring rows.
fn shares<'l>(
    mut labels: &'l mut [Label],
    finished: &[bool],
    columns: usize,
    rows_of_share: usize,
) -> Vec<Share<'l>> {
    let (mut shares, mut row) = (Vec::new(), 0);
    while row < finished.len() {
        let open = finished[row..].iter().take(rows_of_share).take_while(|finished| !**finished).count();
        let (own, rest) = labels.split_at_mut(open.max(1) * columns);
        if open > 0 {
            shares.push(Share { first_row: row, labels: own });
        }
        labels = rest;
        row += open.max(1);
    }
    shares
}

impl<'l> Cells<'l> {
    pub(super) fn new(
        grid: Grid,
        labels: &'l mut [Label],
        finished: &'l mut [bool],
        threads: usize,
        watch: &'l Watch<'l>,
    ) -> Result<Self, Error> {
        let (columns, rows) = (grid.phase().cells(), grid.speed().cells());
        let phases = (0..columns).map(|column| Phase::new(grid.impact_angle(column)));
        let count = columns * finished.iter().filter(|finished| !**finished).count();
        let share = SHARE.min(count.div_ceil(threads));
        let shares = shares(labels, finished, columns, (share / columns).max(1));
        Ok(Self {
            phases: phases.collect::<Result<_, _>>()?,
            speeds: (0..rows).map(|row| grid.speed().centre(row) * PI).collect(),
            shares: Mutex::new(shares.into_iter()),
            finished: Mutex::new(finished),
            count,
            watch,
        })
    }

    pub(super) const fn count(&self) -> usize {
        self.count
    }

    /// The next share that no thread has taken.
    pub(super) fn take(&self) -> Option<Share<'l>> {
        self.shares.lock().unwrap_or_else(PoisonError::into_inner).next()
    }

    /// Removes all remaining shares, after a failure.
    pub(super) fn give_up(&self) {
        while self.take().is_some() {}
    }

    /// Notes that all cells of a share have their labels.
    pub(super) fn rows_done(&self, share: &Share<'_>) {
        let rows = share.labels.len() / self.phases.len();
        let mut finished = self.finished.lock().unwrap_or_else(PoisonError::into_inner);
        finished[share.first_row..][..rows].fill(true);
        self.watch.finish(rows as u64);
    }
}

/// A cell of the shares that a thread has taken.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    share: u32,
    index: u32,
}

impl Cell {
    pub(super) const NONE: Self = Self { share: 0, index: 0 };
}

/// Starts that have been screened but not decided, one batch at a time.
pub(super) struct Starts<'c, 'l> {
    cells: &'c Cells<'l>,
    /// The shares taken, with the number of their cells without a label; completed shares make room for
    /// others.
    shares: Vec<(Share<'l>, usize)>,
    finished: Vec<usize>,
    /// The next cell to begin: its share, and its index, row and column there.
    current: usize,
    index: usize,
    row: usize,
    column: usize,
    batch: Batch,
    batch_cells: [Cell; LANES],
    verdicts: LabelMasks,
    /// Lanes of the batch not taken yet.
    open: Lanes,
    work: WorkCount<'c>,
}

impl<'c, 'l> Starts<'c, 'l> {
    pub(super) fn new(cells: &'c Cells<'l>, batch: Batch) -> Self {
        Self {
            cells,
            shares: Vec::new(),
            finished: Vec::new(),
            current: 0,
            index: 0,
            row: 0,
            column: 0,
            batch,
            batch_cells: [Cell::NONE; LANES],
            verdicts: LabelMasks::new(),
            open: Lanes::NONE,
            work: cells.watch.work(),
        }
    }

    /// Counts work for the observer.
    #[inline(always)]
    pub(super) fn spend(&mut self, flights: u64) -> Result<(), Error> {
        self.work.spend(flights)
    }

    /// Labels a cell.
    #[inline(always)]
    pub(super) fn settle(&mut self, cell: Cell, label: Label) {
        let (share, left) = &mut self.shares[cell.share as usize];
        share.labels[cell.index as usize] = label;
        *left -= 1;
        if *left == 0 {
            self.cells.rows_done(share);
            self.finished.push(cell.share as usize);
        }
    }

    /// The next start that is not decided at once: its cell, and its lane of [`Self::batch`]. Starts decided
    /// at once get their labels on the way. `None` once the call is stopped.
    #[inline(always)]
    pub(super) fn next(&mut self, judge: &Judge<'_>) -> Option<(Cell, usize)> {
        let lane = loop {
            if let Some(lane) = self.open.next() {
                break lane;
            }
            if self.cells.watch.is_stopped() {
                return None;
            }
            let count = self.fill();
            if count == 0 {
                return None;
            }
            if self.screen(judge, count).is_err() {
                // A start advances only after its first state has been fully judged.
                self.open = Lanes::NONE;
                return None;
            }
        };
        Some((self.batch_cells[lane], lane))
    }

    pub(super) const fn batch(&self) -> &Batch {
        &self.batch
    }

    /// Puts the next cells into the batch and returns their number.
    fn fill(&mut self) -> usize {
        for lane in 0..LANES {
            if self.column == self.cells.phases.len() {
                (self.row, self.column) = (self.row + 1, 0);
            }
            if self.shares.get(self.current).is_none_or(|(share, _)| self.index == share.labels.len()) {
                let Some(share) = self.cells.take() else { return lane };
                (self.index, self.row, self.column) = (0, share.first_row, 0);
                let cells = share.labels.len();
                self.current = self.finished.pop().unwrap_or(self.shares.len());
                match self.shares.get_mut(self.current) {
                    Some(finished) => *finished = (share, cells),
                    None => self.shares.push((share, cells)),
                }
            }
            let (phase, speed) = (self.cells.phases[self.column], self.cells.speeds[self.row]);
            self.batch.set_impact(lane, phase, -speed);
            self.batch_cells[lane] = Cell { share: self.current as u32, index: self.index as u32 };
            self.index += 1;
            self.column += 1;
        }
        LANES
    }

    /// Labels those lanes among the first `count` of the batch that are decided at once, and opens the
    /// others.
    fn screen(&mut self, judge: &Judge<'_>, count: usize) -> Result<(), Error> {
        let work = &mut self.work;
        judge.screen(self.batch.impacts(), &mut self.verdicts, |flights| work.spend(flights))?;
        self.open = Lanes::first(count);
        for lane in self.verdicts.settled & self.open {
            if self.verdicts.doubtful[lane] != 0 {
                self.work.spend(judge.work_of_doubt())?;
            }
            if let Some(label) = judge.label(&self.verdicts, &self.batch, lane) {
                self.settle(self.batch_cells[lane], label);
                self.open.remove(lane);
            }
        }
        Ok(())
    }
}
