//! Long calls: they release the interpreter's lock, Ctrl-C stops them, and they report progress to a
//! callable.
//!
//! A pool of threads does the work. The calling thread waits, wakes up a few times in every 0.2 s,
//! lets Python handle its signals, and calls the callable. So the callable runs only on the calling
//! thread, as progress bars and notebooks expect, and no computing thread waits for the
//! interpreter.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::time::Duration;

use bouncing_disk::estimate::FitError;
use bouncing_disk::{Error, Observer, Progress};
use pyo3::exceptions::PyTypeError;
use pyo3::intern;
use pyo3::prelude::*;

use crate::arguments::Arguments;
use crate::{errors, threads};

/// How often signals are handled, and the callable is called.
const INTERVAL: Duration = Duration::from_millis(40);

/// The state that the computing threads share with the waiting one.
#[derive(Default)]
struct Watched {
    done: AtomicU64,
    total: AtomicU64,
    stop: AtomicBool,
}

impl Observer for Watched {
    fn observe(&self, progress: Progress) -> ControlFlow<()> {
        // Calls of several threads come in any order.
        self.done.fetch_max(progress.done, Ordering::Relaxed);
        self.total.store(progress.total, Ordering::Relaxed);
        if self.stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl Watched {
    /// Lets Python handle its signals, and reports the progress of the call to the callable.
    fn look(&self, progress: Option<&Py<PyAny>>) -> PyResult<()> {
        Python::attach(|py| {
            py.check_signals()?;
            let (done, total) = (self.done.load(Ordering::Relaxed), self.total.load(Ordering::Relaxed));
            if let Some(progress) = progress
                && total > 0
            {
                progress.call1(py, (done, total))?;
            }
            Ok(())
        })
    }
}

/// What a long call computes.
type Work<'a> = Box<dyn FnOnce(&dyn Observer) -> Result<(), FitError> + Send + 'a>;

impl Arguments<'_> {
    /// Runs `work` on a pool of threads until it is done, Ctrl-C is pressed or `progress` raises.
    pub(crate) fn run<T: Send>(
        &self,
        work: impl FnOnce(&dyn Observer) -> Result<T, Error> + Send,
    ) -> PyResult<T> {
        self.run_fit(work)
    }

    /// The same for a fit, which may be rejected.
    pub(crate) fn run_fit<T: Send, E: Into<FitError> + Send>(
        &self,
        work: impl FnOnce(&dyn Observer) -> Result<T, E> + Send,
    ) -> PyResult<T> {
        let mut value = None;
        self.watch(Box::new(|observer| {
            value = Some(work(observer).map_err(Into::into)?);
            Ok(())
        }))?;
        value.ok_or_else(errors::defect)
    }

    /// The common body of these functions for all kinds of results, because it takes long to compile.
    fn watch(&self, work: Work<'_>) -> PyResult<()> {
        let py = self.py();
        let progress = self.0.get_item(intern!(py, "progress"))?.filter(|callable| !callable.is_none());
        if progress.as_ref().is_some_and(|callable| !callable.is_callable()) {
            return Err(PyTypeError::new_err("progress must be a callable or None"));
        }
        let progress = progress.map(Bound::unbind);
        let watched = Watched::default();
        let callable = progress.as_ref();
        let outcome = py.detach(|| {
            let pool = threads::Borrowed::take()?;
            let (sender, finished) = sync_channel(1);
            let mut interruption = None;
            let mut result = None;
            let (shared, result_of) = (&watched, &mut result);
            pool.in_place_scope(|scope| {
                scope.spawn(move |_| {
                    *result_of = Some(catch_unwind(AssertUnwindSafe(|| work(shared))));
                    // The receiver exists: it waits until this is done.
                    let _ = sender.send(());
                });
                while let Err(RecvTimeoutError::Timeout) = finished.recv_timeout(INTERVAL) {
                    if interruption.is_none()
                        && let Err(error) = shared.look(callable)
                    {
                        shared.stop.store(true, Ordering::Relaxed);
                        interruption = Some(error);
                    }
                }
            });
            match (interruption, result) {
                (Some(error), _) => Err(error),
                (None, Some(Ok(result))) => Ok(result),
                (None, Some(Err(_)) | None) => Err(errors::defect()),
            }
        })?;
        outcome.map_err(|error| self.refused(error))?;
        if let Some(progress) = progress {
            // No items means all are done.
            let total = watched.total.load(Ordering::Relaxed);
            progress.call1(py, (total, total))?;
        }
        Ok(())
    }
}

/// Runs work of microseconds on the calling thread.
pub(crate) fn short<T>(call: &Arguments<'_>, work: impl FnOnce() -> Result<T, Error>) -> PyResult<T> {
    caught(work)?.map_err(|error| call.refused(error))
}

/// The outcome of `work`, whose panic is a defect.
#[inline]
pub(crate) fn caught<T>(work: impl FnOnce() -> Result<T, Error>) -> PyResult<Result<T, Error>> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|_| errors::defect())
}
