//! One run at a time writes in a folder.

use std::fs::{File, TryLockError};
use std::io::{self, ErrorKind};
use std::path::Path;
use std::time::{Duration, Instant};

/// The time between two looks whether the folder is free: a set of files is written in some tens of
/// milliseconds.
const PAUSE: Duration = Duration::from_millis(5);

/// Whether this run is alone in the folder.
#[derive(Debug)]
pub(super) enum Lock {
    /// It is, until this is dropped or the process ends in whatever way.
    Held {
        /// The system keeps the lock as long as this is open.
        _file: File,
    },
    /// The file system has no locks.
    Unknown,
    /// Another run has been writing in it all the time.
    Busy,
}

/// Waits until no other run writes in the folder, but no longer than `longest`.
///
/// The lock is on the folder itself, where the system can lock one: nothing is left behind, it ends with the
/// process, and the runs of one machine see it even where the folder lies on a network. Those of another
/// machine do not; all that they can do is to remove a partial file, which is then written again. Every
/// writer opens the folder anew, so that threads of one process wait for each other, too.
pub(super) fn hold(folder: &Path, longest: Duration) -> io::Result<Lock> {
    let file = open(folder)?;
    let start = Instant::now();
    loop {
        match file.try_lock() {
            Ok(()) => return Ok(Lock::Held { _file: file }),
            Err(TryLockError::WouldBlock) if start.elapsed() >= longest => return Ok(Lock::Busy),
            Err(TryLockError::WouldBlock) => std::thread::sleep(PAUSE),
            Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Interrupted => {}
            Err(TryLockError::Error(_)) => return Ok(Lock::Unknown),
        }
    }
}

#[cfg(unix)]
fn open(folder: &Path) -> io::Result<File> {
    File::open(folder)
}

/// Elsewhere a folder cannot be opened as a file. The file stays: to remove it would let two runs lock
/// different ones.
#[cfg(not(unix))]
fn open(folder: &Path) -> io::Result<File> {
    File::options().create(true).truncate(false).write(true).open(folder.join(".lock"))
}
