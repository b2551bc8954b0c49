//! The errors of stored files. They are separate from [`Error`], which can be copied and compared, because
//! system errors cannot.

use std::io;
use std::path::PathBuf;

use crate::error::Error;

/// An error of a stored file. Every variant names the file; excerpts of files are escaped as in Rust, so that
/// they cannot disturb a terminal.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StorageError {
    /// The operating system reports an error.
    #[error("cannot {action} {path:?}")]
    Io {
        /// The attempted action: open, lock, read, write.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// Another process, or another journal of this process, is writing to the file.
    #[error("{path:?} is locked: another process writes to it")]
    Busy {
        /// The file.
        path: PathBuf,
    },
    /// A file of a newer format than this version supports.
    #[error(
        "{file:?} has version {found} of the format \"{format}\" (written by {written_by:?}), newer than \
         version {newest}, the newest that {} {} reads: read it with the newer program",
        env!("CARGO_PKG_NAME"),
        env!("CARGO_PKG_VERSION")
    )]
    NewerFormat {
        /// The file.
        file: PathBuf,
        /// The name of the format.
        format: &'static str,
        /// The version of the format of the file.
        found: u32,
        /// Program and version that wrote it.
        written_by: String,
        /// The newest supported version of the format.
        newest: u32,
    },
    /// A file of an older format than this version reads.
    #[error(
        "{file:?} has version {found} of the format \"{format}\" (written by {written_by:?}); the oldest that \
         is still read is version {oldest}"
    )]
    OlderFormat {
        /// The file.
        file: PathBuf,
        /// The name of the format.
        format: &'static str,
        /// The version of the format of the file.
        found: u32,
        /// Program and version that wrote it.
        written_by: String,
        /// The oldest supported version of the format.
        oldest: u32,
    },
    /// A file of another format, or not a file of this project.
    #[error("{file:?} is not a file of the format \"{expected}\": its format is {found:?}")]
    OtherFormat {
        /// The file.
        file: PathBuf,
        /// The name of the expected format.
        expected: &'static str,
        /// The name of the format of the file; empty if it names none.
        found: String,
    },
    /// The provenance in a file is incomplete or malformed.
    #[error("the provenance in {file:?} cannot be read")]
    Provenance {
        /// The file.
        file: PathBuf,
        /// The cause and its position.
        source: serde_json::Error,
    },
    /// A journal of another computation.
    #[error(
        "{path:?} is the journal of another computation: its {field} is {found}, but {expected} is requested"
    )]
    OtherKey {
        /// The file.
        path: PathBuf,
        /// The first field that differs: `provenance.parameters.settings.duration`.
        field: String,
        /// The value in the file, as JSON.
        found: String,
        /// The requested value, as JSON.
        expected: String,
    },
    /// A line was changed after it was written.
    #[error("line {line} of {path:?} was changed after it was written; delete this line to read the others")]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
    },
    /// A line contains no result of the requested kind.
    #[error("line {line} of {path:?} is not a result of this computation")]
    Result {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// The cause and its position.
        source: serde_json::Error,
    },
    /// A value that cannot be read back from JSON, such as a number that is not finite.
    #[error("{what} cannot be stored")]
    NotStorable {
        /// The value: `the parameter "system"`, `the result of item 17`.
        what: String,
        /// The cause.
        source: serde_json::Error,
    },
    /// The computation has no item of this index.
    #[error("item {index} does not exist: there are only {items} items")]
    NoSuchItem {
        /// The index of the item.
        index: usize,
        /// Number of items.
        items: usize,
    },
    /// An error of the model, or of the core, which includes a stop by the observer.
    #[error(transparent)]
    Model(#[from] Error),
}

impl From<bouncing_disk_core::Error> for StorageError {
    fn from(error: bouncing_disk_core::Error) -> Self {
        Self::Model(error.into())
    }
}
