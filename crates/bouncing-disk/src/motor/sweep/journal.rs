//! A sweep of a motor with a journal.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

use bouncing_disk_core::{ChatterPolicy, Observer, Progress};

use crate::motor::operation::point::Operation;
use crate::motor::sweep::MotorSweep;
use crate::motor::sweep::result::MotorSweepResult;
use crate::motor::sweep::run::MotorSweepRun;
use crate::store::error::StorageError;
use crate::store::journal::{JOURNAL, Journal};
use crate::store::provenance::Provenance;

impl MotorSweep {
    /// [`Self::run`] with a [`Journal`]: each group of cells ([`Self::groups`]) is appended when it is
    /// finished, and those appended by an earlier call, in a process that was stopped or killed at any time,
    /// are read from it. The result is that of one call without a journal, bit for bit. The items of the
    /// observer are the cells.
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use std::sync::atomic::{AtomicU32, Ordering};
    ///
    /// use bouncing_disk::core::Progress;
    /// use bouncing_disk::{Motor, Unobserved};
    /// use bouncing_disk::motor::{MotorField, MotorSweep, OperatingSettings, SweepAxis};
    /// use bouncing_disk::store::StorageError;
    ///
    /// # let path = std::env::temp_dir().join(format!("sweep-example-{}", std::process::id()));
    /// # let _ = std::fs::remove_file(&path);
    /// let sweep = MotorSweep::new(
    ///     Motor::paper_70_khz(),
    ///     vec![SweepAxis::new(MotorField::Amplitude, vec![1e-8, 1.5e-8, 2e-8])],
    ///     OperatingSettings { relative_error: 0.1, members: 4, ..OperatingSettings::default() },
    /// )?;
    /// // Stopped on the way (or killed: that makes no difference).
    /// let stop = |progress: Progress| match progress.done {
    ///     0 => ControlFlow::Continue(()),
    ///     _ => ControlFlow::Break(()),
    /// };
    /// let stopped = sweep.run_with_journal(&path, &stop);
    /// assert!(matches!(stopped, Err(StorageError::Model(_))));
    ///
    /// // It goes on where it was.
    /// assert_eq!(sweep.run_with_journal(&path, &Unobserved)?, sweep.run(&Unobserved)?);
    /// # std::fs::remove_file(&path).expect("removable");
    /// # Ok::<(), StorageError>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Journal::open`] and [`Journal::append`]: a journal of another sweep is refused, naming the
    /// difference. Those of [`MotorSweepRun::advance`], in [`StorageError::Model`]; the other groups are then
    /// in the journal.
    pub fn run_with_journal(
        &self,
        path: impl AsRef<Path>,
        observer: &dyn Observer,
    ) -> Result<MotorSweepResult, StorageError> {
        let (journal, finished) = Journal::open(path, &self.key()?, self.groups().len())?;
        let mut run = MotorSweepRun::from(finished);
        let writer = Mutex::new(Writer { journal, failure: None });
        let outcome = run.advance_recording(
            self,
            // A result that cannot be written need not be computed.
            &|progress: Progress| {
                let failed = locked(&writer).failure.is_some();
                if failed { ControlFlow::Break(()) } else { observer.observe(progress) }
            },
            &|group, operations| locked(&writer).append(group, operations),
        );
        let Writer { journal, failure } = writer.into_inner().unwrap_or_else(PoisonError::into_inner);
        if let Some(error) = failure {
            return Err(error);
        }
        journal.sync()?;
        outcome?;
        Ok(run.into_result(self)?)
    }

    /// All that the result depends on.
    fn key(&self) -> Result<Provenance, StorageError> {
        Ok(Provenance::new(JOURNAL)
            .with("motor", self.motor())?
            .with("settings", self.settings())?
            .with("computation", "sweep of a motor")?
            .with("axes", self.axes())?
            .with_seed(self.settings().seed)
            .with_chatter_policy(ChatterPolicy::Complete))
    }
}

/// The journal, in which the threads write by turns.
struct Writer {
    journal: Journal<Vec<Operation>>,
    failure: Option<StorageError>,
}

impl Writer {
    fn append(&mut self, group: usize, operations: &[Operation]) {
        if self.failure.is_none() {
            self.failure = self.journal.append(group, &operations.to_vec()).err();
        }
    }
}

/// An observer of the caller that panics in another thread leaves it as it is.
fn locked(writer: &Mutex<Writer>) -> MutexGuard<'_, Writer> {
    writer.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests;
