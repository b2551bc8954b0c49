//! A sweep of a motor with a journal, and the files of its result.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

use bouncing_disk_core::{ChatterPolicy, Observer, Progress};
use serde_json::json;

use crate::motor::data_sheet::Motor;
use crate::motor::operation::point::Operation;
use crate::motor::operation::settings::OperatingSettings;
use crate::motor::sweep::MotorSweep;
use crate::motor::sweep::result::MotorSweepResult;
use crate::motor::sweep::run::MotorSweepRun;
use crate::store::complete_file::write_complete;
use crate::store::error::StorageError;
use crate::store::journal::{JOURNAL, Journal};
use crate::store::provenance::{Format, Provenance};

/// The format of a [`MotorSweepResult`] as JSON and CSV. Its provenance has the motor and the settings.
const MOTOR_SWEEP: Format = Format { name: "bouncing-disk motor sweep", version: 1, oldest: 1 };

/// Says where a sweep comes from.
fn provenance(
    format: Format,
    motor: &Motor,
    settings: &OperatingSettings,
) -> Result<Provenance, StorageError> {
    let of_motor = Provenance::new(format).with("motor", motor)?.with("settings", settings)?;
    Ok(of_motor.with_seed(settings.seed).with_chatter_policy(ChatterPolicy::Complete))
}

impl MotorSweep {
    /// [`Self::run`] with a [`Journal`]: each group of cells ([`Self::groups`]) is appended when it is
    /// finished, and those that an earlier call has appended, in a process that was stopped or killed at any time, are
    /// taken from there. The result is that of one call without a journal, bit for bit. The items of the observer
    /// are the cells.
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use std::sync::atomic::{AtomicU32, Ordering};
    ///
    /// use bouncing_disk::core::Progress;
    /// use bouncing_disk::{
    ///     Motor, MotorField, MotorSweep, OperatingSettings, StorageError, SweepAxis, Unobserved,
    /// };
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
    /// Those of [`Journal::open`] and [`Journal::append`]: a journal of another sweep is refused by the name of what
    /// differs. Those of [`MotorSweepRun::advance`], in [`StorageError::Model`]; what other groups have is in the
    /// journal then.
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
            // What cannot be written need not be computed.
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
        let of_motor = provenance(JOURNAL, self.motor(), self.settings())?;
        of_motor.with("computation", "sweep of a motor")?.with("axes", self.axes())
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

impl MotorSweepResult {
    /// Where this result comes from: the motor, the settings, the seed and the policy.
    ///
    /// # Errors
    /// [`StorageError::NotStorable`] for what JSON cannot hold; there is no such number in a result that was computed.
    pub fn provenance(&self) -> Result<Provenance, StorageError> {
        provenance(MOTOR_SWEEP, self.motor(), self.settings())
    }

    /// The result as JSON, to the last bit: an object with the `provenance`, in it the motor and the settings, the `axes`
    /// and the `cells` row by row.
    ///
    /// # Errors
    /// Those of [`Self::provenance`].
    pub fn to_json(&self) -> Result<String, StorageError> {
        let failed = |source| StorageError::NotStorable { what: "the result of a sweep".to_owned(), source };
        let content = json!({ "provenance": self.provenance()?, "axes": self.axes(), "cells": self.cells() });
        let text = serde_json::to_string_pretty(&content).map_err(failed)?;
        Ok(text + "\n")
    }

    /// Writes [`Self::to_json`] to a file. A file of that name is replaced, as a whole or not at all.
    ///
    /// # Errors
    /// Those of [`Self::to_json`]; [`StorageError::Io`] if the system refuses.
    pub fn write_json(&self, path: impl AsRef<Path>) -> Result<(), StorageError> {
        write_complete(path.as_ref(), self.to_json()?.as_bytes())
    }

    /// Writes the table of [`Self::to_csv`] to a file, behind a first line that says where it comes from:
    /// `# provenance: ` and JSON. A file of that name is replaced, as a whole or not at all.
    ///
    /// # Errors
    /// Those of [`Self::provenance`]; [`StorageError::Io`] if the system refuses.
    #[cfg(feature = "csv")]
    pub fn write_csv(&self, path: impl AsRef<Path>) -> Result<(), StorageError> {
        let failed = |source| StorageError::NotStorable { what: "a provenance".to_owned(), source };
        let provenance = serde_json::to_string(&self.provenance()?).map_err(failed)?;
        let text = format!("# provenance: {provenance}\n{}", self.to_csv());
        write_complete(path.as_ref(), text.as_bytes())
    }
}

#[cfg(test)]
mod tests;
