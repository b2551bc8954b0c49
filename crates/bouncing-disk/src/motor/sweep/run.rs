//! A sweep in progress, which can be stopped, stored and resumed.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use bouncing_disk_core::run::{Watch, in_parallel, threads};
use bouncing_disk_core::sweep::PartialResults;
use bouncing_disk_core::{Observer, Progress};

use crate::error::Error;
use crate::motor::operation::point::Operation;
use crate::motor::sweep::MotorSweep;
use crate::motor::sweep::result::MotorSweepResult;

/// A [`MotorSweep`] in progress: the groups of cells that are finished.
///
/// A run that is stopped, written, read and resumed gives the result of one uninterrupted
/// [`MotorSweep::run`], bit for bit, for any number of threads. The sweep is not stored: whoever resumes
/// supplies the same one.
///
/// ```
/// use std::ops::ControlFlow;
/// use std::sync::atomic::{AtomicU32, Ordering};
///
/// use bouncing_disk::core::Progress;
/// use bouncing_disk::{Motor, Unobserved};
/// use bouncing_disk::motor::{MotorField, MotorSweep, MotorSweepRun, OperatingSettings, SweepAxis};
///
/// let sweep = MotorSweep::new(
///     Motor::paper_70_khz(),
///     vec![SweepAxis::new(MotorField::Amplitude, vec![1e-8, 1.5e-8, 2e-8])],
///     OperatingSettings { relative_error: 0.1, members: 4, ..OperatingSettings::default() },
/// )?;
/// let mut run = MotorSweepRun::new(&sweep);
/// let asked = AtomicU32::new(0);
/// let stopped = run.advance(&sweep, &|_: Progress| match asked.fetch_add(1, Ordering::Relaxed) {
///     0..5 => ControlFlow::Continue(()),
///     _ => ControlFlow::Break(()),
/// });
/// assert!(stopped.is_err() && !run.is_done());
/// run.advance(&sweep, &Unobserved)?;
/// assert_eq!(run.into_result(&sweep)?, sweep.run(&Unobserved)?);
/// # Ok::<(), bouncing_disk::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct MotorSweepRun {
    groups: PartialResults<Vec<Operation>>,
}

/// A run that goes on from the groups that are finished.
impl From<PartialResults<Vec<Operation>>> for MotorSweepRun {
    fn from(groups: PartialResults<Vec<Operation>>) -> Self {
        Self { groups }
    }
}

impl MotorSweepRun {
    /// A run of a sweep with nothing finished.
    #[must_use]
    pub fn new(sweep: &MotorSweep) -> Self {
        Self { groups: PartialResults::new(sweep.groups().len()) }
    }

    /// Computes the groups that are not finished. Finished ones stay, also when this call returns an error.
    /// The items of the observer are cells; groups under way when it breaks are restarted by the next call.
    ///
    /// # Errors
    /// Errors of the core: [`Stopped`](bouncing_disk_core::Error::Stopped) if the observer breaks,
    /// [`Unfitting`](bouncing_disk_core::Error::Unfitting) for a sweep other than that of the run, if their
    /// groups differ in number or size. The error of the first group that fails: it is not finished, all
    /// others are.
    pub fn advance(&mut self, sweep: &MotorSweep, observer: &dyn Observer) -> Result<(), Error> {
        self.advance_recording(sweep, observer, &|_, _| {})
    }

    /// [`Self::advance`] that passes on the operations of each group as soon as it is finished, to be stored.
    /// `record` gets the index of the group; the threads that do the work call it, several at a
    /// time and in no certain order.
    ///
    /// # Errors
    /// Those of [`Self::advance`].
    pub fn advance_recording(
        &mut self,
        sweep: &MotorSweep,
        observer: &dyn Observer,
        record: &(dyn Fn(usize, &[Operation]) + Sync),
    ) -> Result<(), Error> {
        let open = self.open(sweep)?;
        let done: usize = self.groups.iter().map(|(_, cells)| cells.len()).sum();
        let watch = Watch::begin(observer, done as u64, sweep.cells() as u64)?;
        let next = AtomicUsize::new(0);
        let worker = || {
            let mut outcomes = Vec::new();
            while !watch.is_stopped()
                && let Some(&group) = open.get(next.fetch_add(1, Ordering::Relaxed))
            {
                let outcome = operations_of(sweep, group, &watch);
                if let Ok(cells) = &outcome {
                    record(group, cells);
                    watch.finish(cells.len() as u64);
                }
                outcomes.push((group, outcome));
            }
            outcomes
        };
        // The members of a group are spread over the threads themselves; the fewer groups are under way, the
        // less is lost by a stop.
        let workers = (GROUPS_PER_SHARE * threads()).div_ceil(sweep.settings().members);
        let workers = workers.min(threads()).min(open.len());
        let mut outcomes: Vec<_> = in_parallel(workers, |_| worker()).into_iter().flatten().collect();
        outcomes.sort_by_key(|(group, _)| *group);
        let mut failure = None;
        self.groups.extend(outcomes.into_iter().filter_map(|(group, outcome)| match outcome {
            Ok(cells) => Some((group, cells)),
            Err(error) => {
                if !matches!(error, Error::Core(bouncing_disk_core::Error::Stopped { .. })) {
                    failure.get_or_insert(error);
                }
                None
            }
        }));
        match failure {
            _ if self.is_done() => {
                watch.end();
                Ok(())
            }
            Some(error) if !watch.is_stopped() => Err(error),
            _ => Err(self.stopped(sweep)),
        }
    }

    /// The groups that are not finished, if all others are those of this sweep.
    fn open(&self, sweep: &MotorSweep) -> Result<Vec<usize>, Error> {
        let open = self.groups.open(sweep.groups().len())?;
        for (group, cells) in self.groups.iter() {
            let (found, expected) = (cells.len() as u64, sweep.groups()[group].len() as u64);
            if found != expected {
                let what = "cells of a group of a sweep";
                return Err(bouncing_disk_core::Error::Unfitting { what, found, expected }.into());
            }
        }
        Ok(open)
    }

    fn stopped(&self, sweep: &MotorSweep) -> Error {
        let done: usize = self.groups.iter().map(|(_, cells)| cells.len()).sum();
        bouncing_disk_core::Error::Stopped { done: done as u64, total: sweep.cells() as u64 }.into()
    }

    /// The operations of the groups, as far as they are finished, in the order of [`MotorSweep::groups`].
    #[must_use]
    pub const fn groups(&self) -> &PartialResults<Vec<Operation>> {
        &self.groups
    }

    /// Whether all groups are finished.
    #[must_use]
    pub const fn is_done(&self) -> bool {
        self.groups.is_done()
    }

    /// The operation of each cell, row by row; `None` where it is not finished.
    ///
    /// # Errors
    /// An error of the core ([`Unfitting`](bouncing_disk_core::Error::Unfitting)) for a sweep other than that
    /// of the run.
    pub fn cells(&self, sweep: &MotorSweep) -> Result<Vec<Option<Operation>>, Error> {
        self.open(sweep)?;
        let mut all = vec![None; sweep.cells()];
        for (group, operations) in self.groups.iter() {
            for (&cell, operation) in sweep.groups()[group].iter().zip(operations) {
                all[cell] = Some(*operation);
            }
        }
        Ok(all)
    }

    /// The result of the sweep.
    ///
    /// # Errors
    /// Those of [`Self::cells`]; an error of the core ([`Stopped`](bouncing_disk_core::Error::Stopped)) if a
    /// group is not finished, which [`Self::is_done`] shows.
    pub fn into_result(self, sweep: &MotorSweep) -> Result<MotorSweepResult, Error> {
        let cells: Option<Vec<Operation>> = self.cells(sweep)?.into_iter().collect();
        let cells = cells.ok_or_else(|| self.stopped(sweep))?;
        Ok(MotorSweepResult::new(*sweep.motor(), *sweep.settings(), sweep.axes().to_vec(), cells))
    }
}

impl MotorSweep {
    /// Computes all cells, over the threads of rayon's pool with the feature `parallel`.
    ///
    /// The items of `observer` are the cells. A [`MotorSweepRun`] keeps the finished groups of a
    /// stopped call.
    ///
    /// # Errors
    /// Those of the flights, for the first group that fails: a [`MotorSweepRun`] keeps the others.
    pub fn run(&self, observer: &dyn Observer) -> Result<MotorSweepResult, Error> {
        let mut run = MotorSweepRun::new(self);
        run.advance(self, observer)?;
        run.into_result(self)
    }
}

fn operations_of(sweep: &MotorSweep, group: usize, watch: &Watch<'_>) -> Result<Vec<Operation>, Error> {
    let ask = |_: Progress| match watch.ask() {
        Ok(()) => ControlFlow::Continue(()),
        Err(_) => ControlFlow::Break(()),
    };
    sweep.operations(group, &ask)
}

/// Groups under way for each thread that their members alone would leave idle: members end at different
/// times.
const GROUPS_PER_SHARE: usize = 4;
