//! Many transients with a journal: a run that is killed goes on where it was.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

use bouncing_disk_core::numerics::digest::Digest;
use bouncing_disk_core::{Observer, Progress};

use super::error::StorageError;
use super::journal::Journal;
use super::provenance::Provenance;
use crate::error::Error;
use crate::motor::transient::SpeedCurve;
use crate::motor::transients::{TransientMember, TransientsRun};

/// [`transients`](crate::transients) with a [`Journal`]: each curve is appended when it is finished, and those
/// that an earlier call has appended, in a process that was stopped or killed at any time, are taken from there.
/// The curves are those of one call without a journal, bit for bit.
///
/// `key` is a provenance of the format [`JOURNAL`](crate::JOURNAL) that says what is computed; a digest of the
/// members is added to it, so that other members are refused. Errors of members are not stored: they are found
/// again. The items of the observer are the members.
///
/// # Errors
/// Those of [`Journal::open`] and [`Journal::append`]; an error of the core
/// ([`Stopped`](bouncing_disk_core::Error::Stopped)) if the observer breaks.
///
/// ```
/// use std::ops::ControlFlow;
/// use std::sync::atomic::{AtomicU32, Ordering};
///
/// use bouncing_disk::core::{Progress, Unobserved};
/// use bouncing_disk::{
///     JOURNAL, Provenance, StorageError, System, TransientSettings, ensemble_members, transients,
///     transients_with_journal,
/// };
///
/// # let path = std::env::temp_dir().join(format!("transients-example-{}", std::process::id()));
/// # let _ = std::fs::remove_file(&path);
/// let motor = System::motor();
/// let settings = TransientSettings { duration: 1.0, ..TransientSettings::default() };
/// let members = ensemble_members(&motor, &settings, 200)?;
/// let key = Provenance::new(JOURNAL)
///     .with("system", &motor)?
///     .with("settings", &settings)?
///     .with_seed(settings.seed)
///     .with_chatter_policy(settings.policy);
///
/// // Stopped on the way (or killed: that makes no difference).
/// let asked = AtomicU32::new(0);
/// let stop = |_: Progress| match asked.fetch_add(1, Ordering::Relaxed) {
///     0 => ControlFlow::Continue(()),
///     _ => ControlFlow::Break(()),
/// };
/// let stopped = transients_with_journal(&path, &key, &members, &stop);
/// assert!(matches!(stopped, Err(StorageError::Model(_))));
///
/// // It goes on where it was.
/// let go_on = |_: Progress| ControlFlow::Continue(());
/// let curves = transients_with_journal(&path, &key, &members, &go_on)?;
/// assert_eq!(curves, transients(&members, &Unobserved)?);
/// # std::fs::remove_file(&path).expect("removable");
/// # Ok::<(), StorageError>(())
/// ```
pub fn transients_with_journal(
    path: impl AsRef<Path>,
    key: &Provenance,
    members: &[TransientMember],
    observer: &dyn Observer,
) -> Result<Vec<Result<SpeedCurve, Error>>, StorageError> {
    let key = key.clone().with("members_digest", &digest(members)?)?;
    let (journal, finished) = Journal::open(path, &key, members.len())?;
    let mut run = TransientsRun::from(finished);
    let writer = Mutex::new(Writer { journal, failure: None });
    let outcome = run.advance_recording(
        members,
        // What cannot be written need not be computed.
        &|progress: Progress| {
            let failed = locked(&writer).failure.is_some();
            if failed { ControlFlow::Break(()) } else { observer.observe(progress) }
        },
        &|index, outcome| {
            if let Ok(curve) = outcome {
                locked(&writer).append(index, curve);
            }
        },
    );
    let Writer { journal, failure } = writer.into_inner().unwrap_or_else(PoisonError::into_inner);
    if let Some(error) = failure {
        return Err(error);
    }
    journal.sync()?;
    outcome?;
    Ok(run.into_results()?)
}

/// The journal, in which the threads write by turns.
struct Writer {
    journal: Journal<SpeedCurve>,
    failure: Option<StorageError>,
}

impl Writer {
    fn append(&mut self, index: usize, curve: &SpeedCurve) {
        if self.failure.is_none() {
            self.failure = self.journal.append(index, curve).err();
        }
    }
}

/// An observer of the caller that panics in another thread leaves it as it is.
fn locked(writer: &Mutex<Writer>) -> MutexGuard<'_, Writer> {
    writer.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A digest of all that the curves depend on.
fn digest(members: &[TransientMember]) -> Result<String, StorageError> {
    let mut digest = Digest::new();
    for (index, TransientMember { system, phase, settings }) in members.iter().enumerate() {
        let failed = |source| StorageError::NotStorable { what: format!("member {index}"), source };
        digest.bytes(&serde_json::to_vec(&(system, phase, settings)).map_err(failed)?);
    }
    Ok(digest.to_string())
}
